//! The translations of a matrix group, computed from its algebra.

use crate::algebra::SparseBracket;
use crate::numerics::least_squares::least_squares;
use affinor_tensors::Tensor;
use nalgebra::{DMatrix, DVector};

/// The relative rounding error of a sum.
const ROUNDING: f64 = 1e-10;

/// The largest number of unknowns in the equations for a complement.
const UNKNOWNS: usize = 400;

/// The projection onto the kernel `V` of the Killing form along a complementary subalgebra `K`. It
/// exists if `V` is abelian and has such a subalgebra, as for `se(n) = so(n) + R^n`, `iso(p,q)`,
/// `aff(1)`, and direct sums of a semisimple algebra and `R^n`. Returns `None` for other algebras,
/// and if `V = 0`.
///
/// For any complement `C` of `V`, the subalgebra `K` is the graph of a map `f: C -> V`. Because `V`
/// is abelian, the graph contains `[c + f c, d + f d]` if `v + [c, f d] - [d, f c] = f e` for
/// `[c, d] = e + v`. These equations are linear in `f`.
pub(super) fn translations(structure: &Tensor<f64>) -> Option<DMatrix<f64>> {
    let n = structure.dimension();
    let constants = SparseBracket::of_tensor(structure);
    let fused = |sum: f64, a: f64, b: f64| sum + a * b;
    let size = structure.components().fold(0.0, |size: f64, (_, c)| size.max(c.abs()));
    let killing = constants.killing(0.0, fused).concat();
    let killing = DMatrix::from_vec(n, n, killing);
    let (inside, outside) = kernel(killing, size * size * n as f64)?;
    let bracket = |x: &DVector<f64>, y: &DVector<f64>| {
        DVector::from_vec(constants.bracket(x.as_slice(), y.as_slice(), 0.0, fused))
    };
    let is_zero = |x: &DVector<f64>| x.amax() <= ROUNDING * size;
    let pairs = || inside.iter().flat_map(|x| inside.iter().map(move |y| (x, y)));
    if !pairs().all(|(x, y)| is_zero(&bracket(x, y))) {
        return None;
    }
    let (p, q) = (outside.len(), inside.len());
    if p * q > UNKNOWNS {
        return None;
    }
    // both bases are orthonormal, and orthogonal to each other
    let on = |basis: &[DVector<f64>], x: &DVector<f64>| -> Vec<f64> {
        basis.iter().map(|b| b.dot(x)).collect()
    };
    let acts: Vec<DMatrix<f64>> = outside
        .iter()
        .map(|c| {
            let images: Vec<f64> =
                inside.iter().flat_map(|v| on(&inside, &bracket(c, v))).collect();
            DMatrix::from_vec(q, q, images)
        })
        .collect();
    // the unknown f^v_c has the number c q + v
    let count = p * p.saturating_sub(1) / 2 * q;
    let (mut matrix, mut right) = (DMatrix::zeros(count, p * q), DVector::zeros(count));
    let mut row = 0;
    for c in 0..p {
        for d in c + 1..p {
            let image = bracket(&outside[c], &outside[d]);
            let (e, v) = (on(&outside, &image), on(&inside, &image));
            for at in 0..q {
                for other in 0..q {
                    matrix[(row, d * q + other)] += acts[c][(at, other)];
                    matrix[(row, c * q + other)] -= acts[d][(at, other)];
                }
                for (b, share) in e.iter().enumerate() {
                    matrix[(row, b * q + at)] -= share;
                }
                right[row] = -v[at];
                row += 1;
            }
        }
    }
    let f = if right.iter().all(|x| x.abs() <= ROUNDING * size) {
        DVector::zeros(p * q)
    } else {
        let f = least_squares(&matrix, &right);
        if (&matrix * &f - &right).amax() > ROUNDING * size * (1.0 + f.amax()) {
            return None;
        }
        f
    };
    // the projection P maps x = c + v to v - f c
    let mut projection = DMatrix::zeros(n, n);
    for (at, v) in inside.iter().enumerate() {
        projection += v * v.transpose();
        for (b, c) in outside.iter().enumerate() {
            projection -= v * c.transpose() * f[b * q + at];
        }
    }
    // rounds entries near 0 or 1 to exactly 0 or 1
    Some(projection.map(|x| if (x - x.round()).abs() <= ROUNDING { x.round() } else { x }))
}

/// Orthonormal bases of the kernel of a symmetric matrix and of its complement. They consist of
/// standard basis vectors where these span the spaces. Returns `None` if the kernel is 0.
#[allow(clippy::type_complexity, reason = "two bases")]
fn kernel(matrix: DMatrix<f64>, size: f64) -> Option<(Vec<DVector<f64>>, Vec<DVector<f64>>)> {
    let n = matrix.nrows();
    let unit = |i: usize| DVector::from_fn(n, |k, _| f64::from(i == k));
    let zeros: Vec<usize> = (0..n).filter(|&i| matrix.row(i).amax() <= ROUNDING * size).collect();
    let eigen = matrix.symmetric_eigen();
    let is_kernel = |i: usize| eigen.eigenvalues[i].abs() <= ROUNDING * size;
    let count = (0..n).filter(|&i| is_kernel(i)).count();
    if count == 0 {
        return None;
    }
    if count == zeros.len() {
        let (inside, outside) = (0..n).partition::<Vec<_>, _>(|i| zeros.contains(i));
        return Some((
            inside.into_iter().map(unit).collect(),
            outside.into_iter().map(unit).collect(),
        ));
    }
    let column = |i: usize| eigen.eigenvectors.column(i).into_owned();
    let (inside, outside) = (0..n).partition::<Vec<_>, _>(|&i| is_kernel(i));
    Some((inside.into_iter().map(column).collect(), outside.into_iter().map(column).collect()))
}
