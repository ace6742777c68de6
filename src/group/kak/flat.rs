//! Adapted bases in which an element of `p` is in a maximal abelian subspace.
//!
//! Each level uses the eigenvectors of `B^* B` only for singular values near the largest one, so
//! that squaring loses at most two bits. The next level is on the orthogonal complement, where the
//! matrix is smaller.

use super::structure::{Eigenvector, Matrix, Structure, Vector, eigenvectors, paired};
use affinor_tensors::stop::checkpoint;
use nalgebra::Complex;

/// Singular values above this share of the largest one belong to a level.
const SHARE: f64 = 0.25;

/// Adapted singular vectors of a matrix: `left^* B right` is diagonal.
pub(super) struct Singular {
    pub left: Vec<Vector>,
    pub right: Vec<Vector>,
}

/// Adapted singular vectors of a matrix from the columns of `right` to those of `left`, by about
/// decreasing singular value.
pub(super) fn singular(b: &Matrix, right: Structure, left: Structure) -> Singular {
    let mut found = Singular { left: vec![], right: vec![] };
    let scale = b.norm();
    loop {
        checkpoint();
        let taken = found.right.len();
        // bases of the orthogonal complements
        let (mut p, mut q) = (found.right.clone(), found.left.clone());
        right.complete(&mut p, right.count);
        left.complete(&mut q, left.count);
        let (p, q) = (p.split_off(taken), q.split_off(taken));
        let columns = right.assemble(&p, right.size());
        let rows = left.assemble(&q, left.size());
        let rest = rows.ad_mul(&(b * &columns));
        let norm = rest.norm();
        if p.is_empty() || q.is_empty() || norm <= scale * f64::EPSILON / 16.0 {
            found.right.extend(p);
            found.left.extend(q);
            return found;
        }
        let rest = rest.unscale(norm);
        let all = right.with_counts(p.len(), 0).eigen(&rest.ad_mul(&rest));
        for one in top(&all).into_iter().take(q.len()) {
            let x = &columns * &one.vector;
            // the image in the complement: components along previous vectors are rounding errors
            let y = left.orthonormal(&rows * (&rest * &one.vector), &found.left);
            found.right.push(right.orthonormal(x, &found.right));
            found.left.push(y);
        }
    }
}

/// The eigenvectors of a level, of a matrix of squares.
fn top(all: &[Eigenvector]) -> Vec<&Eigenvector> {
    let largest = all.first().map_or(0.0, |one| one.value);
    all.iter().filter(|one| one.value >= SHARE * SHARE * largest).collect()
}

/// Adapted eigenvectors of a real symmetric matrix that anticommutes with `J`. Their pairs are
/// eigenvectors of the opposite eigenvalues.
pub(super) fn opposite_eigenvectors(y: &Matrix, structure: Structure) -> Vec<Vector> {
    let mut basis = vec![];
    structure.extend(&mut basis, eigenvectors(y, true), structure.count);
    basis
}

/// Adapted vectors `x_1, y_1, x_2, y_2, ...` of a real antisymmetric matrix that anticommutes with
/// `J`: it maps `x_i` to a multiple of `y_i`.
pub(super) fn planes(b: &Matrix, structure: Structure) -> Vec<Vector> {
    let mut found: Vec<Vector> = vec![];
    let scale = b.norm();
    loop {
        checkpoint();
        let taken = found.len();
        let mut p = found.clone();
        structure.complete(&mut p, structure.count);
        let p = p.split_off(taken);
        let columns = structure.assemble(&p, structure.size());
        let rest = columns.ad_mul(&(b * &columns));
        let norm = rest.norm();
        if p.len() < 2 || norm <= scale * f64::EPSILON / 16.0 {
            found.extend(p);
            return found;
        }
        let rest = rest.unscale(norm);
        let all = structure.with_counts(p.len(), 0).eigen(&rest.ad_mul(&rest));
        let mut candidates: Vec<Vector> =
            top(&all).into_iter().map(|one| &columns * &one.vector).collect();
        while structure.count - found.len() >= 2 {
            let free = |v: &Vector| {
                let along = |u: &Vector| u.dotc(v).norm_sqr() + paired(u).dotc(v).norm_sqr();
                1.0 - found[taken..].iter().map(along).sum::<f64>()
            };
            // a vector is spanned if it is in the plane of a previous one
            let next = candidates.iter().map(free).enumerate();
            let next = next.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, free)| *free > 0.25);
            let Some((at, _)) = next else { break };
            let x = structure.orthonormal(candidates.swap_remove(at), &found);
            // the image in the complement: components along previous vectors are rounding errors
            let image = &columns * (&rest * columns.ad_mul(&x));
            found.push(x);
            let y = structure.orthonormal(image, &found);
            found.push(y);
        }
    }
}

/// The part of a matrix that anticommutes with `J`.
pub(super) fn odd(m: &Matrix) -> Matrix {
    let half = m.nrows() / 2;
    let n = m.nrows();
    Matrix::from_fn(n, n, |i, j| {
        let (row, column) = ((i + half) % n, (j + half) % n);
        let sign = if (i < half) == (j < half) { 1.0 } else { -1.0 };
        (m[(i, j)] - m[(row, column)] * sign) * 0.5
    })
}

/// The Hermitian part of a matrix.
pub(super) fn hermitian(m: &Matrix) -> Matrix {
    (m + m.adjoint()).scale(0.5)
}

/// A matrix times the imaginary unit, or its negative.
pub(super) fn rotated(m: &Matrix, sign: f64) -> Matrix {
    m * Complex::new(0.0, sign)
}
