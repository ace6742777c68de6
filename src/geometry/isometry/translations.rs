//! Translations of coordinates as symmetries: they show how symmetry fields depend on the coordinate.

use super::Found;
use super::point::Point;
use super::residue::Residue;
use super::sample::geometry_at;
use crate::Error;
use crate::geometry::chart::Fields;
use affinor_tensors::linear::Echelon;
use affinor_tensors::{Field, Notation, Ring, Symbolic, Tensor};
use num_traits::{One, Zero};

/// How the symmetry fields depend on a coordinate on which the metric does not depend: the matrix of
/// `[d/dx, .]` on the symmetry algebra at the sample point.
#[derive(Clone, Debug)]
pub(super) struct Translation {
    pub coordinate: String,
    /// The matrix by rows; its columns are the images of the basis.
    pub matrix: Vec<Vec<Residue>>,
    /// Values of the parameters at the sample point.
    pub values: Vec<(String, Residue)>,
}

/// The translations along the coordinates on which the metric does not depend.
pub(super) fn translations(
    found: &Found<Residue>,
    fields: &Fields<Symbolic>,
    components: &Tensor<Symbolic>,
    point: &mut Point,
) -> Result<Vec<Translation>, Error> {
    let coordinates = fields.chart().coordinates();
    let n = coordinates.len();
    let (connection, metric) = geometry_at(fields, components, point, 1)?;
    let is_known = |name: &String| coordinates.contains(name);
    let values = point.values().into_iter().filter(|(name, _)| !is_known(name));
    let values: Vec<(String, Residue)> =
        values.filter_map(|(name, value)| Some((name, Residue::of(&value)?))).collect();
    let mut all = vec![];
    for (at, coordinate) in coordinates.iter().enumerate() {
        let depends = |value: &Symbolic| !Notation::derivative(value, coordinate).vanishes();
        if components.components().any(|(_, value)| depends(value)) {
            continue;
        }
        // nabla_j K_i for K = d/dx
        let slope = |i: usize, j: usize| {
            (0..n).fold(Residue::zero(), |sum, m| {
                let lower = metric.components().get(&[i, m]).value();
                sum + lower * connection.affinities().get(&[m, j, at]).value()
            })
        };
        let mut jet = vec![(at, Residue::one())];
        for (column, (i, j)) in (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).enumerate() {
            let value = slope(i, j);
            jet.push((n + column, if found.is_conformal { value } else { -value }));
        }
        let nonzero = jet.into_iter().filter(|(_, value)| !value.vanishes());
        let Some(own) = found.jets.space.coordinates(nonzero) else { continue };
        let d = found.dimension();
        let mut matrix = vec![vec![Residue::zero(); d]; d];
        for (j, k, i, value) in &found.structure {
            matrix[*i][*k] = matrix[*i][*k] + own[*j] * *value;
            matrix[*i][*j] = matrix[*i][*j] + -(own[*k] * *value);
        }
        all.push(Translation { coordinate: coordinate.clone(), matrix, values: values.clone() });
    }
    Ok(all)
}

impl Translation {
    fn rank(rows: &[Vec<Residue>]) -> usize {
        let mut span = Echelon::new();
        for row in rows {
            let row = row.iter().cloned().enumerate().filter(|(_, v)| !v.vanishes());
            // a field has no other non-units
            let _ = span.insert(row);
        }
        span.rank()
    }

    fn product(&self, rows: &[Vec<Residue>]) -> Vec<Vec<Residue>> {
        let n = rows.len();
        let entry = |i: usize, j: usize| {
            (0..n).fold(Residue::zero(), |sum, m| sum + rows[i][m] * self.matrix[m][j])
        };
        (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
    }

    /// The degree of the polynomials by which the fields depend on the coordinate.
    fn degree(&self) -> usize {
        let mut power = self.matrix.clone();
        let mut rank = self.matrix.len();
        for degree in 0..=2 {
            let next = Self::rank(&power);
            if next == rank {
                return degree.max(1) - 1;
            }
            rank = next;
            power = self.product(&power);
        }
        2
    }

    /// Whether a number is the square of an eigenvalue.
    fn has_square(&self, square: Residue) -> bool {
        let mut rows = self.product(&self.matrix);
        for (i, row) in rows.iter_mut().enumerate() {
            row[i] = row[i] + -square;
        }
        Self::rank(&rows) < rows.len()
    }

    /// The functions of the coordinate, each with its weight.
    pub fn functions(&self) -> Vec<(usize, Symbolic)> {
        let x = Symbolic::parameter(&self.coordinate);
        let power = |degree: usize| (degree, num_traits::pow(x.clone(), degree));
        let mut all: Vec<_> = (0..=self.degree()).map(power).collect();
        let mut factors = vec![(Symbolic::one(), Residue::one())];
        for (name, value) in &self.values {
            let parameter = Symbolic::parameter(name);
            if let (Some(inverse), Some(residue)) = (parameter.recip(), value.recip()) {
                factors.push((inverse, residue));
            }
            factors.push((parameter, *value));
        }
        for (factor, value) in factors {
            let square = value * value;
            let argument = x.clone() * &factor;
            let mut add = |name: &str, argument: &Symbolic| {
                let function = <Symbolic as Notation>::function(name, argument).ok();
                all.extend(function.map(|function| (1, function)));
            };
            if self.has_square(-square) {
                add("sin", &argument);
                add("cos", &argument);
            }
            if self.has_square(square) {
                add("exp", &argument);
                add("exp", &-argument);
            }
        }
        all
    }
}
