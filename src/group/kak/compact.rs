//! Factorizations in compact groups.
//!
//! For `g = k1 a k2`, the unitary matrix `q = g theta(g)^-1` is `k1 a^2 k1^-1`. Its Hermitian part
//! `cos(2 X)` commutes with the operators of `K`. Its adapted eigenvectors split the space at the
//! widest gap of the cosines between -1/2 and 1/2. On the first part, the Cayley transform
//! `(q - 1)(q + 1)^-1 = tanh(X)` is bounded, on the second part `(q + 1)(1 - q)^-1` is. Both are in
//! `p`, and increasing functions of the angles, so that one diagonalization in `p` for each part
//! finds `k1`. No step depends on the distances of angles from each other, from 0 or from `pi/2`.

use super::flat::{hermitian, odd, opposite_eigenvectors, planes, rotated, singular};
use super::pair::{Field, Kind, SymmetricPair};
use super::structure::{Eigenvector, Matrix, Structure, Vector, embedded, paired};
use nalgebra::Complex;
use std::f64::consts::PI;

/// Cosines between these limits may separate the two parts.
const LIMIT: f64 = 0.5;

/// The vectors of `k1` that belong to one coordinate of `a`.
struct Cell {
    vectors: Vec<Vector>,
    angle: f64,
}

/// `k1` and the coordinates of `a` for an element in the order of [`SymmetricPair::inside`].
pub(super) fn factor(pair: &SymmetricPair, g: &Matrix) -> (Matrix, Vec<f64>) {
    let structure = pair.structure();
    let q = g * pair.theta(g).adjoint();
    let cosines = structure.eigen(&structure.project(&hermitian(&q)));
    let limit = widest_gap(&cosines);
    let (high, low): (Vec<_>, Vec<_>) = cosines.into_iter().partition(|one| one.value < limit);
    let (mut cells, mut free) = (vec![], [vec![], vec![]]);
    for (part, is_low) in [(low, true), (high, false)] {
        let first = part.iter().filter(|one| one.is_first).count();
        let inner = structure.with_counts(first, part.len() - first);
        let columns: Vec<Vector> = part.into_iter().map(|one| one.vector).collect();
        let columns = structure.assemble(&columns, structure.size());
        let z = transform(&columns.ad_mul(&(&q * &columns)), is_low);
        let lift = |v: &Vector| &columns * v;
        for part in diagonalize(pair.kind, inner, &z) {
            match part {
                Part::Cell(vectors) => {
                    cells.push(cell(pair.kind, vectors.iter().map(lift).collect(), &q));
                }
                Part::Free(vector, is_first) => free[usize::from(!is_first)].push(lift(&vector)),
            }
        }
    }
    cells.sort_by(|a, b| b.angle.total_cmp(&a.angle));
    choose_determinant(pair, &mut cells, &mut free);
    assemble(pair, &cells, &free)
}

/// The middle of the widest gap of the eigenvalues between the limits.
fn widest_gap(cosines: &[Eigenvector]) -> f64 {
    let inside = cosines.iter().map(|one| one.value).filter(|value| value.abs() < LIMIT);
    let mut values: Vec<f64> = inside.chain([-LIMIT, LIMIT]).collect();
    values.sort_by(f64::total_cmp);
    let gaps = values.windows(2).map(|pair| (pair[1] - pair[0], 0.5 * (pair[0] + pair[1])));
    gaps.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, middle)| middle)
}

/// The Cayley transform of a part. The inverse is bounded, because no eigenvalue of the part is
/// near the excluded point.
fn transform(q: &Matrix, is_low: bool) -> Matrix {
    let one = Matrix::identity(q.nrows(), q.ncols());
    let (above, below) = if is_low { (q - &one, q + &one) } else { (q + &one, &one - q) };
    // the factors commute; a singular denominator cannot occur for a unitary matrix
    below.lu().solve(&above).unwrap_or(above)
}

/// A result of the diagonalization in `p`: the vectors of a coordinate, or a vector on which `a`
/// acts trivially.
enum Part {
    Cell(Vec<Vector>),
    Free(Vector, bool),
}

/// Adapted vectors that diagonalize an element of `p`.
fn diagonalize(kind: Kind, structure: Structure, z: &Matrix) -> Vec<Part> {
    match kind {
        Kind::Conjugation(_) => {
            let h = structure.project(&hermitian(&rotated(z, -1.0)));
            let all = structure.eigen(&h).into_iter();
            all.map(|one| Part::Cell(vec![one.vector])).collect()
        }
        Kind::ComplexStructure(Field::Real) => {
            let real = z.map(|value| Complex::new(value.re, 0.0));
            let b = odd(&(&real - real.transpose()).scale(0.5));
            let vectors = planes(&b, structure);
            let cells = vectors.chunks(2).map(|chunk| match chunk {
                [x] => Part::Free(x.clone(), true),
                both => Part::Cell(both.to_vec()),
            });
            cells.collect()
        }
        Kind::ComplexStructure(_) => {
            let y = odd(&hermitian(&rotated(z, -1.0)).map(|value| Complex::new(value.re, 0.0)));
            let vectors = opposite_eigenvectors(&y, structure).into_iter();
            vectors.map(|v| Part::Cell(vec![v])).collect()
        }
        _ => {
            let (first, second) = (structure.indices(true), structure.indices(false));
            let lower = z.select_rows(&second).select_columns(&first);
            let upper = z.select_rows(&first).select_columns(&second);
            let right = structure.with_counts(structure.first, 0);
            let left = structure.with_counts(structure.count - structure.first, 0);
            let b = between(&(&lower - upper.adjoint()).scale(0.5), right);
            let found = singular(&b, right, left);
            let count = right.count.min(left.count);
            let size = structure.size();
            let x = |v: &Vector| embedded(v, &first, size);
            let y = |v: &Vector| embedded(v, &second, size);
            let cells = found.right.iter().zip(&found.left).take(count);
            let mut parts: Vec<Part> = cells.map(|(u, v)| Part::Cell(vec![x(u), y(v)])).collect();
            parts.extend(found.right[count..].iter().map(|u| Part::Free(x(u), true)));
            parts.extend(found.left[count..].iter().map(|v| Part::Free(y(v), false)));
            parts
        }
    }
}

/// The part of a matrix between two blocks that commutes with the conjugation and with the pairs.
pub(super) fn between(b: &Matrix, structure: Structure) -> Matrix {
    // the sign that separates the blocks does not act within a block
    let whole = Structure { count: usize::MAX, first: usize::MAX, ..structure };
    whole.project(b)
}

/// The vectors of a coordinate with its angle. The sign of one vector is chosen such that the
/// angle of two vectors is not negative.
fn cell(kind: Kind, mut vectors: Vec<Vector>, q: &Matrix) -> Cell {
    if let [x, y] = &mut vectors[..] {
        let image = q * &*x;
        let cosine = 0.5 * (x.dotc(&image) + y.dotc(&(q * &*y))).re;
        let sine = y.dotc(&image).re;
        if sine < 0.0 {
            y.neg_mut();
        }
        return Cell { vectors, angle: 0.5 * sine.abs().atan2(cosine) };
    }
    let v = &mut vectors[0];
    let value = v.dotc(&(q * &*v));
    let mut angle = 0.5 * value.im.atan2(value.re);
    if angle < 0.0 && kind == Kind::ComplexStructure(Field::Quaternion) {
        // the pair is the eigenvector of the conjugate eigenvalue
        (*v, angle) = (paired(v), -angle);
    }
    Cell { vectors, angle }
}

/// Changes `k1` and the coordinates, such that all factors have determinant 1 if `g` has, and such
/// that the coordinates of traceless subspaces have the sum 0.
fn choose_determinant(pair: &SymmetricPair, cells: &mut [Cell], free: &mut [Vec<Vector>; 2]) {
    let structure = pair.structure();
    if !pair.is_special {
        return;
    }
    if pair.has_sum_zero() {
        // angles are defined up to multiples of pi: changes by pi keep them within an interval of
        // length pi
        let sum: f64 = cells.iter().map(|cell| cell.angle).sum();
        let half_turns = (sum / PI).round();
        for _ in 0..half_turns.abs() as usize {
            let by = if half_turns > 0.0 { -PI } else { PI };
            let end = if by < 0.0 { 0 } else { cells.len() - 1 };
            cells[end].angle += by;
            if by < 0.0 { cells.rotate_left(1) } else { cells.rotate_right(1) }
        }
        // the rest of the sum is a rounding error
        let rest: f64 = cells.iter().map(|cell| cell.angle).sum();
        let count = cells.len() as f64;
        cells.iter_mut().for_each(|cell| cell.angle -= rest / count);
    }
    if structure.is_paired {
        // unitary quaternionic and realified complex matrices have determinant 1
        return;
    }
    let (k1, _) = assemble(pair, cells, free);
    let phase = k1.determinant();
    let phase = if structure.is_real {
        Complex::new(phase.re.signum(), 0.0)
    } else {
        phase.unscale(phase.norm())
    };
    if phase == Complex::ONE {
        return;
    }
    // a free vector changes alone
    if let Some(v) = free.iter_mut().flatten().next() {
        *v *= phase.conj();
        return;
    }
    let Some(last) = cells.last_mut() else { return };
    match &mut last.vectors[..] {
        [_, y] if structure.is_real => {
            // only one vector may change its sign, and the angle with it
            *y *= phase;
            last.angle = -last.angle;
        }
        [x, y] => {
            let half = phase.conj().sqrt();
            *x *= half;
            *y *= half;
        }
        [x, ..] => *x *= phase.conj(),
        [] => {}
    }
}

/// `k1` and the coordinates.
fn assemble(pair: &SymmetricPair, cells: &[Cell], free: &[Vec<Vector>; 2]) -> (Matrix, Vec<f64>) {
    let structure = pair.structure();
    let is_graded = matches!(pair.kind, Kind::Grading(_));
    let mut columns: Vec<Vector> = vec![];
    if is_graded {
        for (at, free) in free.iter().enumerate() {
            columns.extend(cells.iter().map(|cell| cell.vectors[at].clone()));
            columns.extend(free.iter().cloned());
        }
    } else {
        columns.extend(cells.iter().flat_map(|cell| cell.vectors.iter().cloned()));
        columns.extend(free[0].iter().cloned());
    }
    let angles = cells.iter().map(|cell| cell.angle).collect();
    (structure.assemble(&columns, structure.size()), angles)
}
