//! Trajectories of problems: attitude and body momentum.

use super::{Figure, Panel, Role};
use affinor::Error;
use affinor::mechanics::Inertia;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

/// The number of intervals on an ellipse.
const SAMPLES: u32 = 96;
/// Orthogonality tolerance of an attitude. Rows may have few digits; a picture resolves a pixel.
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
    /// [`Error::NoColumn`].
    pub fn column(&self, name: &str) -> Result<Vec<f64>, Error> {
        let at = self.columns.iter().position(|column| column == name);
        let at = at.ok_or_else(|| Error::NoColumn { name: name.into() })?;
        Ok(self.rows.iter().map(|row| row[at]).collect())
    }

    pub(super) fn vectors(&self, names: [&str; 3]) -> Result<Vec<Vector3<f64>>, Error> {
        let [x, y, z] = names.map(|name| self.column(name));
        let (x, y, z) = (x?, y?, z?);
        Ok((0..x.len()).map(|k| Vector3::new(x[k], y[k], z[k])).collect())
    }

    /// The rotation matrices, by their entries or by quaternions.
    pub(super) fn attitudes(&self) -> Result<Vec<Matrix3<f64>>, Error> {
        if let (Ok(w), Ok(v)) = (self.column("qw"), self.vectors(["qx", "qy", "qz"])) {
            let turn = |(w, v): (f64, Vector3<f64>)| {
                let q = nalgebra::Quaternion::from_parts(w, v);
                affinor::group::rotation::matrix(&nalgebra::UnitQuaternion::new_normalize(q))
            };
            return Ok(w.into_iter().zip(v).map(turn).collect());
        }
        let rows = [["g11", "g12", "g13"], ["g21", "g22", "g23"], ["g31", "g32", "g33"]];
        let [a, b, c] = rows.map(|names| self.vectors(names));
        let (a, b, c) = (a?, b?, c?);
        let matrix = |k: usize| {
            let r = Matrix3::from_rows(&[a[k], b[k], c[k]].map(|row| row.transpose()));
            let off = (r.transpose() * r - Matrix3::identity()).amax();
            if off < TOLERANCE && r.determinant() > 0.0 {
                return Ok(r);
            }
            let reason = format!("in row {} `g^T g` is off the identity by {off:.1e}", k + 1);
            Err(Error::Invalid { what: "rotation", reason })
        };
        (0..a.len()).map(matrix).collect()
    }
}

/// The body axes on the unit sphere in space: the columns `R E_i` of the attitude.
///
/// # Errors
/// [`Error::NoColumn`] for a trajectory without an attitude; [`Error::Invalid`] for elements that are not rotations.
pub fn attitude(run: &RunRows) -> Result<Figure, Error> {
    let attitudes = run.attitudes()?;
    let mut panel = Panel::new("", 1.0, ["X", "Y", "Z"]);
    for i in 0..3 {
        let points: Vec<_> = attitudes.iter().map(|r| r.column(i).into_owned()).collect();
        let tip = points.last().copied().unwrap_or_default();
        let axis = ["E₁", "E₂", "E₃"][i];
        let caption = format!("body axis {axis} (arrow at the final time)");
        panel.path(Role::Frame(i), &caption, points);
        panel.arrow(Role::Frame(i), [&format!("R {axis}"), ""], [Vector3::zeros(), tip]);
    }
    Ok(Figure { title: format!("{}: body axes in space", run.name), panels: vec![panel] })
}

/// The body momentum `H` on the sphere of its norm, and the energy ellipsoid. A free motion follows their intersection,
/// the polhode.
///
/// # Errors
/// [`Error::NoColumn`] for a trajectory without `H1`, `H2`, `H3`.
pub fn momentum(run: &RunRows, inertia: &Inertia) -> Result<Figure, Error> {
    let points = run.vectors(["H1", "H2", "H3"])?;
    let start = points.first().copied().unwrap_or_default();
    let longest = points.iter().map(|h| h.norm()).fold(0.0, f64::max);
    let radius = if longest > 0.0 { longest } else { 1.0 };
    let (axes, moments) = (inertia.axes(), inertia.moments());
    let mut panel = Panel::new("", radius, ["H₁", "H₂", "H₃"]);
    // semi-axes of H . J^-1 H = 2 E
    let energy = inertia.energy(&start);
    let half = moments.map(|moment| (2.0 * energy * moment).sqrt());
    let around = |k: u32| (TAU * f64::from(k) / f64::from(SAMPLES)).sin_cos();
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        let (a, b) = (axes.column(i) * half[i], axes.column(j) * half[j]);
        let ellipse = (0..=SAMPLES).map(around).map(|(sin, cos)| a * cos + b * sin).collect();
        let caption = "energy ellipsoid";
        panel.curve(Role::Guide, ["", caption], vec![ellipse]);
    }
    panel.path(Role::Motion, "body momentum H", points);
    Ok(Figure { title: format!("{}: body momentum", run.name), panels: vec![panel] })
}
