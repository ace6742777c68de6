//! The jets of infinitesimal isometries at a point: the linear equations that curvature imposes on
//! them, and their bracket.

use crate::Error;
use crate::algebra::frame::formula;
use crate::geometry::connection::Connection;
use crate::geometry::metric::Metric;
use affinor_tensors::linear::{Echelon, Row};
use affinor_tensors::stop::checkpoint;
use affinor_tensors::{Field, Scalar, Tensor};
use std::collections::BTreeMap;

/// The largest rank of a derivative of the curvature, which is the largest rank of a tensor.
const MAX_RANK: usize = 8;

/// The curvature and its covariant derivatives at a point, with all slots lower, and the metric.
pub(super) struct AtPoint<S> {
    /// The metric `g_ij` and its inverse.
    pub metric: Metric<S>,
    /// `R_ijkl`, `nabla_m R_ijkl`, ...
    pub derivatives: Vec<Tensor<S>>,
}

/// The jets that satisfy the equations of an order, and the dimensions at all orders before.
pub(super) struct Jets<S> {
    /// The basis in reduced echelon form. Columns: `K^i`, then `A_ij` for `i < j`, and for
    /// homotheties the factor.
    pub space: Echelon<S>,
    /// The dimension before all equations, then after those of `R`, `nabla R`, ...
    pub dimensions: Vec<usize>,
    /// Whether the last two dimensions are equal.
    pub is_stable: bool,
}

/// The curvature and as many derivatives as the next order needs, `order + 2` tensors, in the frame
/// of the connection.
pub(super) fn derivatives<S: Field + Scalar>(
    connection: &Connection<S>,
    metric: &Metric<S>,
    known: &mut Vec<Tensor<S>>,
    count: usize,
) -> Result<(), Error> {
    if known.is_empty() {
        let operands = [("g", metric.components()), ("R", connection.curvature())];
        known.push(formula("g_im R^m_jkl -> _ij[kl]", &operands));
    }
    while known.len() < count {
        checkpoint();
        known.push(connection.nabla(&known[known.len() - 1])?);
    }
    Ok(())
}

/// The largest order whose equations need only tensors of allowed rank.
pub(super) const MAX_ORDER: usize = MAX_RANK - 5;

/// The columns of a jet.
#[derive(Clone, Copy)]
pub(super) struct Columns {
    pub n: usize,
    pub homothetic: bool,
}

impl Columns {
    /// The number of unknowns.
    pub fn count(self) -> usize {
        self.n * (self.n + 1) / 2 + usize::from(self.homothetic)
    }

    /// The column of `A_ij` for `i < j`.
    fn rotation(self, i: usize, j: usize) -> usize {
        self.n + i * (2 * self.n - i - 1) / 2 + j - i - 1
    }

    /// The column of `A_ij` with its sign; `None` for `i = j`.
    fn signed<S: Scalar>(self, i: usize, j: usize, value: S) -> Option<(usize, S)> {
        match i.cmp(&j) {
            std::cmp::Ordering::Less => Some((self.rotation(i, j), value)),
            std::cmp::Ordering::Greater => Some((self.rotation(j, i), -value)),
            std::cmp::Ordering::Equal => None,
        }
    }
}

/// The equations `L_K nabla^s R = 0` for the unknown jet, where the vector field has the covariant
/// derivative `nabla_j K^i = -A^i_j + c delta^i_j`:
///
/// ```text
/// K^m nabla_m T_a... - T_m... A^m_a - ... + (rank - 2) c T_a... = 0,   T = nabla^s R
/// ```
pub(super) fn equations<S: Field + Scalar>(
    columns: Columns,
    metric: &Metric<S>,
    tensor: &Tensor<S>,
    derivative: &Tensor<S>,
) -> Vec<Row<S>> {
    let (n, rank) = (tensor.dimension(), tensor.rank());
    let mut rows: BTreeMap<Vec<usize>, Row<S>> = BTreeMap::new();
    // the symmetries of the curvature make the other rows redundant
    let is_needed = |at: &[usize]| {
        let [i, j, k, l] = [4, 3, 2, 1].map(|back| at[rank - back]);
        i < j && k < l && (i, j) <= (k, l)
    };
    for (at, value) in derivative.components().filter(|(at, _)| is_needed(&at[1..])) {
        rows.entry(at[1..].to_vec()).or_default().push((at[0], value.clone()));
    }
    let letters = &"abcdefgh"[..rank];
    for (slot, letter) in letters.chars().enumerate() {
        let lower: String = letters.chars().map(|l| if l == letter { 'm' } else { l }).collect();
        let text = format!("T_{lower} g^mp -> {}", upper_at(letters, slot));
        let raised = formula(&text, &[("T", tensor), ("g", metric.inverse())]);
        for (at, value) in raised.components() {
            let mut row = at.to_vec();
            for a in 0..n {
                row[slot] = a;
                if is_needed(&row)
                    && let Some(entry) = columns.signed(at[slot], a, -value.clone())
                {
                    rows.entry(row.clone()).or_default().push(entry);
                }
            }
        }
    }
    if columns.homothetic {
        let weight = S::from_i64(rank as i64 - 2);
        for (at, value) in tensor.components().filter(|(at, _)| is_needed(at)) {
            let entry = (columns.count() - 1, weight.clone() * value);
            rows.entry(at.to_vec()).or_default().push(entry);
        }
    }
    rows.into_values().collect()
}

/// The notation of a tensor with one upper slot `p` in place of a letter.
fn upper_at(letters: &str, slot: usize) -> String {
    let index = |(at, letter): (usize, char)| match at == slot {
        true => "^p".to_string(),
        false => format!("_{letter}"),
    };
    letters.chars().enumerate().map(index).collect()
}

/// Solves the equations order by order, until the dimension is the same at two successive orders,
/// or `least`. `tensors(k)` returns the values of the metric and of `k` tensors.
pub(super) fn solve<S: Field + Scalar>(
    columns: Columns,
    least: usize,
    mut tensors: impl FnMut(usize) -> Result<AtPoint<S>, Error>,
) -> Result<(Jets<S>, AtPoint<S>), Error> {
    let count = columns.count();
    let mut span = Echelon::new();
    let mut dimensions = vec![count];
    let mut point = tensors(2)?;
    let mut is_stable = false;
    for order in 0..=MAX_ORDER {
        if point.derivatives.len() < order + 2 {
            point = tensors(order + 2)?;
        }
        let [tensor, derivative] = [&point.derivatives[order], &point.derivatives[order + 1]];
        for row in equations(columns, &point.metric, tensor, derivative) {
            checkpoint();
            if span.rank() == count {
                break;
            }
            span.insert(row)?;
        }
        let dimension = count - span.rank();
        is_stable = dimensions.last() == Some(&dimension) || dimension <= least;
        dimensions.push(dimension);
        if is_stable {
            break;
        }
    }
    let mut space = Echelon::new();
    for row in span.nullspace(count) {
        space.insert(row)?;
    }
    Ok((Jets { space, dimensions, is_stable }, point))
}

/// A jet as a vector `K^i` and an endomorphism `A^i_j`, the part `c` of a homothety included.
struct Jet<S> {
    k: Vec<S>,
    a: Vec<Vec<S>>,
}

impl<S: Field + Scalar> Jet<S> {
    fn new(columns: Columns, metric: &Metric<S>, row: &Row<S>) -> Self {
        let n = columns.n;
        let mut values = vec![S::zero(); columns.count()];
        row.iter().for_each(|(at, value)| values[*at] = value.clone());
        let mut a = vec![vec![S::zero(); n]; n];
        for (at, raise) in metric.inverse().components() {
            for (j, entry) in a[at[0]].iter_mut().enumerate() {
                if let Some((column, sign)) = columns.signed(at[1], j, S::one()) {
                    let term = values[column].clone() * &sign * raise;
                    *entry = entry.clone() + &term;
                }
            }
        }
        if columns.homothetic {
            let factor = &values[columns.count() - 1];
            for (i, row) in a.iter_mut().enumerate() {
                row[i] = row[i].clone() - factor;
            }
        }
        values.truncate(n);
        Jet { k: values, a }
    }
}

/// The structure constants `(j, k, i, c^i_jk)` of the jets in the basis of their space, by the
/// bracket of vector fields, with `R` the curvature:
///
/// ```text
/// [(K, A), (K', A')] = (A K' - A' K, [A, A'] - R(K, K'))
/// ```
///
/// Returns `None` if a bracket lies outside the space.
pub(super) fn structure<S: Field + Scalar>(
    columns: Columns,
    jets: &Echelon<S>,
    point: &AtPoint<S>,
) -> Option<Vec<(usize, usize, usize, S)>> {
    let n = columns.n;
    let all: Vec<Jet<S>> =
        jets.rows().iter().map(|row| Jet::new(columns, &point.metric, row)).collect();
    let g = point.metric.components();
    let sum = |terms: &mut dyn Iterator<Item = S>| terms.fold(S::zero(), |sum, term| sum + &term);
    let mut constants = vec![];
    for (j, x) in all.iter().enumerate() {
        for (k, y) in all.iter().enumerate().skip(j + 1) {
            checkpoint();
            let mut row: Row<S> = vec![];
            for i in 0..n {
                let terms =
                    (0..n).map(|m| x.a[i][m].clone() * &y.k[m] - &(y.a[i][m].clone() * &x.k[m]));
                row.push((i, sum(&mut terms.into_iter())));
            }
            // [A, A']^i_j, lowered, and R_ijkl K^k K'^l
            let commutator = |i: usize, l: usize| {
                sum(&mut (0..n)
                    .map(|m| x.a[i][m].clone() * &y.a[m][l] - &(y.a[i][m].clone() * &x.a[m][l])))
            };
            let commutators: Vec<Vec<S>> =
                (0..n).map(|i| (0..n).map(|l| commutator(i, l)).collect()).collect();
            let mut rotation = vec![vec![S::zero(); n]; n];
            for (at, value) in g.components() {
                for l in at[0] + 1..n {
                    let term = value.clone() * &commutators[at[1]][l];
                    rotation[at[0]][l] = rotation[at[0]][l].clone() + &term;
                }
            }
            for (at, value) in point.derivatives[0].components().filter(|(at, _)| at[0] < at[1]) {
                let term = value.clone() * &x.k[at[2]] * &y.k[at[3]];
                rotation[at[0]][at[1]] = rotation[at[0]][at[1]].clone() - &term;
            }
            for (i, values) in rotation.into_iter().enumerate() {
                for (l, value) in values.into_iter().enumerate().skip(i + 1) {
                    row.push((columns.rotation(i, l), value));
                }
            }
            let coordinates = jets.coordinates(row.into_iter().filter(|(_, v)| !v.vanishes()))?;
            let nonzero = coordinates.into_iter().enumerate().filter(|(_, v)| !v.vanishes());
            constants.extend(nonzero.map(|(i, value)| (j, k, i, value)));
        }
    }
    Some(constants)
}

/// The number of basis vectors with a nonzero vector `K`: the dimension of the orbit.
pub(super) fn orbit<S: Field + Scalar>(columns: Columns, jets: &Echelon<S>) -> usize {
    jets.pivots().iter().filter(|pivot| **pivot < columns.n).count()
}
