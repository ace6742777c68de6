//! Factorizations in noncompact groups, where `theta(g) = g^-*` and `a` is positive definite.
//!
//! - `GL(n,F)`: the singular value decomposition with adapted vectors.
//! - Groups of a Hermitian form: of the blocks `g11 = u1 cosh(h) v1^*`, `g21 = u2 sinh(h) v1^*`,
//!   `g12 = u1 sinh(h) v2^*`, `g22 = u2 cosh(h) v2^*`, a singular value decomposition of `g21` finds
//!   `u2`, `v1` and `h`. The columns of `g11 v1` and of `g22^* u2` are orthogonal and not small, so
//!   that orthonormalization finds `u1` and `v2`.
//! - `Sp(2n,R)`: singular vectors of the values `s > 1`; their pairs belong to `1/s`. If all values
//!   are below 2, the Cayley transform of `g g^T` is in `p` and bounded.

use super::compact::between;
use super::flat::{hermitian, odd, opposite_eigenvectors, singular};
use super::pair::{Kind, SymmetricPair};
use super::structure::{Matrix, Structure, Vector, eigenvectors, embedded, paired};
use crate::group::matrices::TOLERANCE;
use affinor_tensors::stop::checkpoint;
use nalgebra::Complex;

/// `k1`, the coordinates of `a`, and `k2`, for an element in the order of [`SymmetricPair::inside`].
///
/// # Errors
/// The determinant of an element of the group of a Hermitian form, if it should be 1 and is not.
/// It is computed from `k1` and `k2`, because elimination in `g` loses accuracy.
pub(super) fn factor(
    pair: &SymmetricPair,
    g: &Matrix,
) -> Result<(Matrix, Vec<f64>, Matrix), Complex<f64>> {
    let structure = pair.structure();
    let mut found = match pair.kind {
        Kind::Indefinite(_) => hyperbolic(structure, g),
        Kind::RealSymplectic => symplectic(structure, g),
        _ => linear(structure, g),
    };
    if pair.has_sum_zero()
        && let Some((last, others)) = found.coordinates.split_last_mut()
    {
        // the smallest singular value has the largest relative error
        *last = -others.iter().sum::<f64>();
    }
    if pair.is_special && !structure.is_paired {
        if matches!(pair.kind, Kind::Indefinite(_)) {
            let determinant = phase(structure, &found.left) * phase(structure, &found.right).conj();
            let rounding = 10.0 * f64::EPSILON * g.norm_squared();
            if (determinant - Complex::ONE).norm() > TOLERANCE + rounding {
                return Err(determinant);
            }
        }
        found.choose_determinants(structure);
    }
    let k2 = structure.assemble(&found.right, structure.size()).adjoint();
    Ok((structure.assemble(&found.left, structure.size()), found.coordinates, k2))
}

/// The columns of `k1` and of `k2^*`, and the coordinates of `a`.
struct Polar {
    left: Vec<Vector>,
    right: Vec<Vector>,
    coordinates: Vec<f64>,
}

impl Polar {
    /// Sorts vectors by decreasing coordinate.
    fn sorted(cells: Vec<(f64, Vector, Vector)>) -> Self {
        let mut cells = cells;
        cells.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut polar = Polar { left: vec![], right: vec![], coordinates: vec![] };
        for (x, left, right) in cells {
            polar.coordinates.push(x);
            polar.left.push(left);
            polar.right.push(right);
        }
        polar
    }

    /// Multiplies vectors by phases, such that `k1` and `k2` have determinant 1.
    fn choose_determinants(&mut self, structure: Structure) {
        let (n, first, r) = (structure.count, structure.first, self.coordinates.len());
        // columns whose common phases commute with `a`, of the smallest singular values
        let columns = if first == n {
            // each column belongs to a coordinate
            vec![n - 1]
        } else if r < first || r < n - first {
            vec![if r < first { first - 1 } else { n - 1 }]
        } else if structure.is_real {
            vec![r - 1]
        } else {
            vec![r - 1, first + r - 1]
        };
        let is_plane = first < n && r == first && r == n - first;
        let left = phase(structure, &self.left);
        multiply(&mut self.left, &columns, left.conj());
        multiply(&mut self.right, &columns, left.conj());
        if structure.is_real {
            if is_plane && left.re < 0.0 {
                // a sign of one vector of a plane is a sign of the coordinate
                self.coordinates[r - 1] = -self.coordinates[r - 1];
            }
            return;
        }
        // the determinant of g may differ from 1 by rounding errors
        let right = phase(structure, &self.right);
        multiply(&mut self.right, &columns, right.conj());
    }
}

/// Multiplies the product of some vectors by a phase.
fn multiply(vectors: &mut [Vector], columns: &[usize], phase: Complex<f64>) {
    let share = if columns.len() == 2 { phase.sqrt() } else { phase };
    columns.iter().for_each(|&at| vectors[at] *= share);
}

/// The determinant of vectors, normalized to modulus 1.
fn phase(structure: Structure, vectors: &[Vector]) -> Complex<f64> {
    let determinant = structure.assemble(vectors, structure.size()).determinant();
    match structure.is_real {
        true => Complex::new(determinant.re.signum(), 0.0),
        false => determinant.unscale(determinant.norm()),
    }
}

fn linear(structure: Structure, g: &Matrix) -> Polar {
    // scaling avoids overflow of squares
    let scale = g.camax();
    let g = g.unscale(scale);
    let found = singular(&g, structure, structure);
    let cells = found.left.into_iter().zip(found.right).map(|(u, v)| {
        let value = u.dotc(&(&g * &v)).re;
        (value.ln() + scale.ln(), u, v)
    });
    Polar::sorted(cells.collect())
}

fn hyperbolic(structure: Structure, g: &Matrix) -> Polar {
    let (first, second) = (structure.indices(true), structure.indices(false));
    let block = |rows: &[usize], columns: &[usize]| g.select_rows(rows).select_columns(columns);
    let right = structure.with_counts(structure.first, 0);
    let left = structure.with_counts(structure.count - structure.first, 0);
    let lower = between(&block(&second, &first), right);
    let found = singular(&lower, right, left);
    let count = right.count.min(left.count);
    let sine = |(u, v): (&Vector, &Vector)| u.dotc(&(&lower * v)).re;
    let pairs = found.left.iter().zip(&found.right).take(count);
    let mut sines: Vec<(f64, usize)> = pairs.map(sine).zip(0..).collect();
    sines.sort_by(|a, b| b.0.total_cmp(&a.0));
    let sorted = |vectors: &[Vector]| -> Vec<Vector> {
        let order = sines.iter().map(|(_, at)| *at).chain(count..vectors.len());
        order.map(|at| vectors[at].clone()).collect()
    };
    let (u2, v1) = (sorted(&found.left), sorted(&found.right));
    let images =
        |m: Matrix, vectors: &[Vector]| -> Vec<Vector> { vectors.iter().map(|v| &m * v).collect() };
    let u1 = right.orthonormalize(&images(block(&first, &first), &v1));
    let v2 = left.orthonormalize(&images(block(&second, &second).adjoint(), &u2));
    let whole = |firsts: &[Vector], seconds: &[Vector]| -> Vec<Vector> {
        let size = structure.size();
        let one = firsts.iter().map(|v| embedded(v, &first, size));
        one.chain(seconds.iter().map(|v| embedded(v, &second, size))).collect()
    };
    Polar {
        left: whole(&u1, &u2),
        right: whole(&v1, &v2),
        coordinates: sines.iter().map(|(value, _)| value.asinh()).collect(),
    }
}

/// Singular values above this limit separate vectors from their pairs.
const SEPARATED: f64 = 1.4;

fn symplectic(structure: Structure, g: &Matrix) -> Polar {
    let (mut left, mut right): (Vec<Vector>, Vec<Vector>) = (vec![], vec![]);
    let size = structure.size();
    loop {
        checkpoint();
        let taken = left.len();
        let (mut p, mut q) = (left.clone(), right.clone());
        structure.complete(&mut p, structure.count);
        structure.complete(&mut q, structure.count);
        let (p, q) = (p.split_off(taken), q.split_off(taken));
        if p.is_empty() {
            break;
        }
        let (columns, rows) = (structure.assemble(&p, size), structure.assemble(&q, size));
        let rest = columns.ad_mul(&(g * &rows));
        let square = &rest * rest.adjoint();
        let inner = structure.with_counts(p.len(), 0);
        let all = eigenvectors(&square, true);
        let value = |v: &Vector| v.dotc(&(&square * v)).re;
        let largest = all.first().map_or(1.0, value);
        let limit = (0.25 * largest.sqrt()).max(SEPARATED);
        let is_last = largest <= 4.0;
        let vectors = if is_last {
            let one = Matrix::identity(square.nrows(), square.ncols());
            let below = (&square + &one).lu();
            let z = below.solve(&(&square - &one)).unwrap_or_else(|| square.clone());
            let mut vectors = opposite_eigenvectors(&odd(&hermitian(&z)), inner);
            for v in &mut vectors {
                if value(v) < 1.0 {
                    *v = paired(v);
                }
            }
            vectors.sort_by(|a, b| value(b).total_cmp(&value(a)));
            vectors
        } else {
            let count = all.iter().take_while(|v| value(v).sqrt() >= limit).count();
            let mut vectors = vec![];
            inner.extend(&mut vectors, all.into_iter().take(count).collect(), count.min(p.len()));
            vectors
        };
        for v in vectors {
            let image = &rows * rest.ad_mul(&v);
            left.push(structure.orthonormal(&columns * v, &left));
            right.push(structure.orthonormal(image, &right));
        }
    }
    let cells = left.into_iter().zip(right).map(|(u, v)| {
        let value = u.dotc(&(g * &v)).re;
        (value.ln(), u, v)
    });
    Polar::sorted(cells.collect())
}
