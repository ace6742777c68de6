//! The rows of a trajectory in memory. Columns are found by their names.

use affinor::Error;
use nalgebra::{Matrix3, Vector3};

/// The orthogonality tolerance of an attitude. It is large, because rows may have few digits, and a
/// picture resolves only pixels.
const TOLERANCE: f64 = 1e-3;

/// The rows of a trajectory, with the names of their columns.
#[derive(Clone, Debug, PartialEq)]
pub struct RunRows {
    /// The name of the problem.
    pub name: String,
    /// The names of the columns.
    pub columns: Vec<String>,
    /// The rows, one for each time.
    pub rows: Vec<Vec<f64>>,
}

impl RunRows {
    /// The values of a column.
    ///
    /// # Errors
    /// [`Error::Name`] if there is no column with this name.
    pub fn column(&self, name: &str) -> Result<Vec<f64>, Error> {
        let at = self.columns.iter().position(|column| column == name);
        let at = at.ok_or_else(|| Error::Name(format!("the run has no column {name}")))?;
        Ok(self.rows.iter().map(|row| row[at]).collect())
    }

    /// Vectors whose components are the values of three columns.
    ///
    /// # Errors
    /// [`Error::Name`] if there is no column with one of the names.
    pub fn vectors(&self, names: [&str; 3]) -> Result<Vec<Vector3<f64>>, Error> {
        let [x, y, z] = names.map(|name| self.column(name));
        let (x, y, z) = (x?, y?, z?);
        Ok((0..x.len()).map(|k| Vector3::new(x[k], y[k], z[k])).collect())
    }

    /// The rotation matrices, computed from columns of their entries or of quaternions. `factor` is
    /// the number of a factor of a product.
    ///
    /// # Errors
    /// [`Error::Name`]; [`Error::Invalid`] for entries that are not a rotation.
    pub fn attitudes(&self, factor: Option<usize>) -> Result<Vec<Matrix3<f64>>, Error> {
        let quaternions = self.column(&column_of("qw", factor));
        if let (Ok(w), Ok(v)) = (quaternions, self.of_factor(["qx", "qy", "qz"], factor)) {
            let turn = |(w, v): (f64, Vector3<f64>)| {
                let q = nalgebra::Quaternion::from_parts(w, v);
                affinor::group::rotation::matrix(&nalgebra::UnitQuaternion::new_normalize(q))
            };
            return Ok(w.into_iter().zip(v).map(turn).collect());
        }
        let rows = [["g11", "g12", "g13"], ["g21", "g22", "g23"], ["g31", "g32", "g33"]];
        let [a, b, c] = rows.map(|names| self.of_factor(names, factor));
        let (a, b, c) = (a?, b?, c?);
        let matrix = |k: usize| {
            let r = Matrix3::from_rows(&[a[k], b[k], c[k]].map(|row| row.transpose()));
            let off = (r.transpose() * r - Matrix3::identity()).amax();
            if off < TOLERANCE && r.determinant() > 0.0 {
                return Ok(r);
            }
            let reason = format!("in row {} `g^T g` differs from the identity by {off:.1e}", k + 1);
            Err(Error::Invalid { what: "rotation", reason })
        };
        (0..a.len()).map(matrix).collect()
    }

    /// The positions: the last column of the matrix (`g14`, `g24`, `g34`) if the rows have it,
    /// otherwise the coordinates `x`, `y`, `z`.
    /// `factor` is the number of a factor of a product.
    ///
    /// # Errors
    /// [`Error::Name`].
    pub fn positions(&self, factor: Option<usize>) -> Result<Vec<Vector3<f64>>, Error> {
        let entries = self.of_factor(["g14", "g24", "g34"], factor);
        entries.or_else(|_| self.of_factor(["x", "y", "z"], factor))
    }

    fn of_factor(
        &self,
        names: [&str; 3],
        factor: Option<usize>,
    ) -> Result<Vec<Vector3<f64>>, Error> {
        let names = names.map(|name| column_of(name, factor));
        self.vectors([&names[0], &names[1], &names[2]])
    }
}

/// The name of a column for an element. For a factor of a product, the name ends in the number of
/// the factor, as in `qw_2`.
pub fn column_of(name: &str, factor: Option<usize>) -> String {
    factor.map_or(name.into(), |number| format!("{name}_{number}"))
}
