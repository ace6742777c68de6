//! Many rotations at once: one array for every component, on all cores; or rows of components, in the thread of the caller.
//!
//! The formulas are those of [`So3`]. Over arrays of components the compiler emits vector instructions: with the feature `simd` those
//! that the processor has, chosen at run time. All of them round alike, so a result depends on its argument alone.

use super::groups::so3;
use super::{LieGroup, So3};
use crate::numerics::stumpff::{NEAR, near};
#[cfg(feature = "simd")]
use multiversion::multiversion;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rayon::prelude::*;

/// Elements in `N` columns, one for each of their components.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns<const N: usize>([Vec<f64>; N]);

/// Vectors in the columns `x, y, z`.
pub type Vectors = Columns<3>;

/// Unit quaternions in the columns `w, x, y, z`.
pub type Quaternions = Columns<4>;

/// The number of elements of one task; their columns fit the cache of a core.
const TASK: usize = 1024;

/// Exponentials of all vectors.
///
/// ```
/// use affinor::group::batch;
/// use affinor::group::batch::{Quaternions, Vectors};
/// use affinor::group::{LieGroup, So3};
/// use nalgebra::Vector3;
/// let vectors: Vectors = (0..3000).map(|k| Vector3::new(1e-3, 2e-3, 4e-3) * f64::from(k)).collect();
/// let mut rotations = Quaternions::zeros(vectors.len());
/// batch::exp(&vectors, &mut rotations);
/// let one = So3.exp(&vectors.get(2000));
/// assert!((rotations.get(2000).coords - one.coords).norm() < 1e-15);
/// ```
///
/// # Panics
/// If the numbers of elements differ, like all functions here.
pub fn exp(vectors: &Vectors, rotations: &mut Quaternions) {
    assert_eq!(vectors.len(), rotations.len(), "as many rotations as vectors");
    tasks4(rotations)
        .enumerate()
        .for_each(|(task, (w, x, y, z))| exp_columns(part(&vectors.0, task), [w, x, y, z]));
}

#[cfg_attr(
    feature = "simd",
    multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))
)]
fn exp_columns(vectors: [&[f64]; 3], rotations: [&mut [f64]; 4]) {
    let ([x, y, z], [w, i, j, k]) = (vectors, rotations);
    let mut all_near = true;
    for t in 0..w.len().min(x.len()) {
        let (quarter, cos, half) = exp_near([x[t], y[t], z[t]]);
        all_near &= quarter < NEAR;
        (w[t], i[t], j[t], k[t]) = (cos, x[t] * half, y[t] * half, z[t] * half);
    }
    for t in if all_near { 0..0 } else { 0..x.len() } {
        let x = [x[t], y[t], z[t]];
        if is_far(exp_near(x).0) {
            [w[t], i[t], j[t], k[t]] = exp_alone(x);
        }
    }
}

/// A quarter of the squared angle, and where this is below [`NEAR`] the scalar part and the ratio of the vector parts.
#[inline(always)]
fn exp_near([x, y, z]: [f64; 3]) -> (f64, f64, f64) {
    let quarter = 0.25 * (x * x + y * y + z * z);
    let (cos, sin) = near(quarter);
    (quarter, cos, 0.5 * sin)
}

#[inline(always)]
fn is_far(quarter: f64) -> bool {
    quarter.is_nan() || quarter >= NEAR
}

fn exp_alone(x: [f64; 3]) -> [f64; 4] {
    let g = So3.exp(&x.into());
    [g.w, g.i, g.j, g.k]
}

/// Logarithms of all rotations, of length at most `pi`; NaN for a quaternion that is zero or not finite.
///
/// # Panics
/// If the numbers of elements differ.
pub fn log(rotations: &Quaternions, vectors: &mut Vectors) {
    assert_eq!(rotations.len(), vectors.len(), "as many vectors as rotations");
    tasks3(vectors)
        .enumerate()
        .for_each(|(task, (x, y, z))| log_columns(part(&rotations.0, task), [x, y, z]));
}

#[cfg_attr(
    feature = "simd",
    multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))
)]
fn log_columns(rotations: [&[f64]; 4], vectors: [&mut [f64]; 3]) {
    let ([w, i, j, k], [x, y, z]) = (rotations, vectors);
    let mut all_unit = true;
    for t in 0..x.len().min(w.len()) {
        let (norm, factor) = log_near([w[t], i[t], j[t], k[t]]);
        all_unit &= so3::is_unit(norm);
        (x[t], y[t], z[t]) = (i[t] * factor, j[t] * factor, k[t] * factor);
    }
    for t in if all_unit { 0..0 } else { 0..w.len() } {
        let g = [w[t], i[t], j[t], k[t]];
        if !so3::is_unit(log_near(g).0) {
            [x[t], y[t], z[t]] = log_alone(g);
        }
    }
}

/// The squared norm, and where this is that of a unit the ratio of the vector parts.
#[inline(always)]
fn log_near([w, i, j, k]: [f64; 4]) -> (f64, f64) {
    let square = i * i + j * j + k * k;
    let norm = w * w + square;
    (norm, so3::logarithm([i, j, k, w], square, norm))
}

fn log_alone([w, i, j, k]: [f64; 4]) -> [f64; 3] {
    let g = UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k));
    So3.log(&g).unwrap_or(Vector3::repeat(f64::NAN)).into()
}

/// Products `g h` of all pairs.
///
/// # Panics
/// If the numbers of elements differ.
pub fn compose(g: &Quaternions, h: &Quaternions, products: &mut Quaternions) {
    assert!(g.len() == h.len() && h.len() == products.len(), "as many products as factors");
    tasks4(products).enumerate().for_each(|(task, (w, x, y, z))| {
        let [a, b, c, d] = part(&g.0, task);
        let [e, f, g, h] = part(&h.0, task);
        for t in 0..w.len().min(a.len()).min(e.len()) {
            [w[t], x[t], y[t], z[t]] = product([a[t], b[t], c[t], d[t]], [e[t], f[t], g[t], h[t]]);
        }
    });
}

/// The product of two quaternions.
#[inline(always)]
fn product([a, b, c, d]: [f64; 4], [e, f, g, h]: [f64; 4]) -> [f64; 4] {
    [
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    ]
}

/// [`compose`] of rows `w, x, y, z`, in the thread of the caller.
pub fn compose_rows(g: &[[f64; 4]], h: &[[f64; 4]], products: &mut [[f64; 4]]) {
    for ((g, h), gh) in g.iter().zip(h).zip(products) {
        *gh = product(*g, *h);
    }
}

/// [`exp`] of rows `x, y, z`, to rows `w, x, y, z`, in the thread of the caller.
///
/// ```
/// use affinor::group::batch;
/// let mut rotations = [[0.0; 4]; 2];
/// batch::exp_rows(&[[0.0, 0.0, std::f64::consts::PI], [0.0; 3]], &mut rotations);
/// assert!((rotations[0][3] - 1.0).abs() < 1e-15);
/// assert_eq!(rotations[1], [1.0, 0.0, 0.0, 0.0]);
/// ```
///
/// # Panics
/// If the numbers of rows differ, like all functions here.
#[cfg_attr(
    feature = "simd",
    multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))
)]
pub fn exp_rows(vectors: &[[f64; 3]], rotations: &mut [[f64; 4]]) {
    assert_eq!(vectors.len(), rotations.len(), "as many rotations as vectors");
    let ((blocks, rest), (found, last)) = (vectors.as_chunks(), rotations.as_chunks_mut());
    for (block, found) in blocks.iter().zip(found) {
        exp_lanes(block, found);
    }
    if !rest.is_empty() {
        let mut found = [[0.0; 4]; LANES];
        exp_lanes(&filled(rest, [0.0; 3]), &mut found);
        last.copy_from_slice(&found[..rest.len()]);
    }
}

#[inline(always)]
fn exp_lanes(x: &[[f64; 3]; LANES], g: &mut [[f64; 4]; LANES]) {
    let [mut quarter, mut cos, mut half] = [[0.0; LANES]; 3];
    let columns: [[f64; LANES]; 3] = columns(x);
    for t in 0..LANES {
        (quarter[t], cos[t], half[t]) = exp_near([columns[0][t], columns[1][t], columns[2][t]]);
    }
    let mut all_near = true;
    for quarter in &quarter {
        all_near &= *quarter < NEAR;
    }
    for t in 0..LANES {
        g[t] = [cos[t], x[t][0] * half[t], x[t][1] * half[t], x[t][2] * half[t]];
    }
    for t in if all_near { 0..0 } else { 0..LANES } {
        if is_far(quarter[t]) {
            g[t] = exp_alone(x[t]);
        }
    }
}

/// [`log`] of rows `w, x, y, z`, in the thread of the caller. Returns whether every row has a logarithm.
///
/// # Panics
/// If the numbers of rows differ.
#[cfg_attr(
    feature = "simd",
    multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))
)]
pub fn log_rows(rotations: &[[f64; 4]], vectors: &mut [[f64; 3]]) -> bool {
    assert_eq!(rotations.len(), vectors.len(), "as many vectors as rotations");
    let mut valid = true;
    let ((blocks, rest), (found, last)) = (rotations.as_chunks(), vectors.as_chunks_mut());
    for (block, found) in blocks.iter().zip(found) {
        valid &= log_lanes(block, found);
    }
    if !rest.is_empty() {
        let mut found = [[0.0; 3]; LANES];
        valid &= log_lanes(&filled(rest, [1.0, 0.0, 0.0, 0.0]), &mut found);
        last.copy_from_slice(&found[..rest.len()]);
    }
    valid
}

#[inline(always)]
fn log_lanes(g: &[[f64; 4]; LANES], x: &mut [[f64; 3]; LANES]) -> bool {
    let [mut norm, mut factor] = [[0.0; LANES]; 2];
    let columns: [[f64; LANES]; 4] = columns(g);
    for t in 0..LANES {
        (norm[t], factor[t]) =
            log_near([columns[0][t], columns[1][t], columns[2][t], columns[3][t]]);
    }
    let mut all_unit = true;
    for norm in &norm {
        all_unit &= so3::is_unit(*norm);
    }
    for t in 0..LANES {
        x[t] = [g[t][1] * factor[t], g[t][2] * factor[t], g[t][3] * factor[t]];
    }
    let mut valid = true;
    for t in if all_unit { 0..0 } else { 0..LANES } {
        if !so3::is_unit(norm[t]) {
            x[t] = log_alone(g[t]);
            valid &= !x[t][0].is_nan();
        }
    }
    valid
}

/// The number of rows that are computed side by side.
const LANES: usize = 16;

/// Rows as columns, over which loops become vector instructions.
#[inline(always)]
fn columns<const N: usize>(rows: &[[f64; N]; LANES]) -> [[f64; LANES]; N] {
    std::array::from_fn(|column| std::array::from_fn(|row| rows[row][column]))
}

/// The last rows, and others that complete the lanes.
#[inline(always)]
fn filled<const N: usize>(rest: &[[f64; N]], fill: [f64; N]) -> [[f64; N]; LANES] {
    let mut block = [fill; LANES];
    block[..rest.len()].copy_from_slice(rest);
    block
}

/// The columns of one task, of equal lengths, so that loops need no bounds checks.
fn part<const N: usize>(columns: &[Vec<f64>; N], task: usize) -> [&[f64]; N] {
    let length = columns[0].len();
    let range = (task * TASK).min(length)..((task + 1) * TASK).min(length);
    columns.each_ref().map(|column| &column[range.clone()])
}

type Chunk<'a> = &'a mut [f64];
type Three<'a> = (Chunk<'a>, Chunk<'a>, Chunk<'a>);
type Four<'a> = (Chunk<'a>, Chunk<'a>, Chunk<'a>, Chunk<'a>);

fn tasks3(vectors: &mut Vectors) -> impl IndexedParallelIterator<Item = Three<'_>> {
    let [x, y, z] = vectors.0.each_mut().map(|column| column.par_chunks_mut(TASK));
    (x, y, z).into_par_iter()
}

fn tasks4(rotations: &mut Quaternions) -> impl IndexedParallelIterator<Item = Four<'_>> {
    let [w, x, y, z] = rotations.0.each_mut().map(|column| column.par_chunks_mut(TASK));
    (w, x, y, z).into_par_iter()
}

impl<const N: usize> Columns<N> {
    /// Zeros, to be overwritten: zero quaternions are no rotations.
    pub fn zeros(count: usize) -> Self {
        Columns(std::array::from_fn(|_| vec![0.0; count]))
    }

    /// The number of elements.
    pub fn len(&self) -> usize {
        self.0[0].len()
    }

    /// Whether there are no elements.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The columns.
    pub fn columns(&self) -> [&[f64]; N] {
        self.0.each_ref().map(Vec::as_slice)
    }

    fn element(&self, at: usize) -> [f64; N] {
        self.0.each_ref().map(|column| column[at])
    }

    fn collect(elements: impl Iterator<Item = [f64; N]>) -> Self {
        let mut columns = Self::zeros(0);
        for element in elements {
            columns.0.iter_mut().zip(element).for_each(|(column, c)| column.push(c));
        }
        columns
    }
}

impl Vectors {
    /// The rotation vector at a position, counted from 0.
    ///
    /// # Panics
    /// If the position is out of range.
    pub fn get(&self, at: usize) -> Vector3<f64> {
        self.element(at).into()
    }
}

impl Quaternions {
    /// The unit quaternion at a position, counted from 0.
    ///
    /// # Panics
    /// If the position is out of range.
    pub fn get(&self, at: usize) -> UnitQuaternion<f64> {
        let [w, x, y, z] = self.element(at);
        UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z))
    }
}

impl FromIterator<Vector3<f64>> for Vectors {
    fn from_iter<I: IntoIterator<Item = Vector3<f64>>>(vectors: I) -> Self {
        Self::collect(vectors.into_iter().map(Into::into))
    }
}

impl FromIterator<UnitQuaternion<f64>> for Quaternions {
    fn from_iter<I: IntoIterator<Item = UnitQuaternion<f64>>>(rotations: I) -> Self {
        Self::collect(rotations.into_iter().map(|g| [g.w, g.i, g.j, g.k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The instructions of this processor give the same floats as those that every processor has, at any place of a batch.
    #[test]
    fn equal_floats_on_every_processor_at_every_place() {
        let scales = [0.0, 1e-170, 1e-9, 0.1, 1.2, 2.99, 3.0, 3.01, 6.3, 1e3, 1e150, f64::NAN];
        let axis = [0.28, -0.96, 0.6];
        let vectors: Vec<[f64; 3]> = (0..6 * LANES)
            .map(|at| axis.map(|c| c * scales[at % scales.len()] + 1e-3 * at as f64))
            .collect();
        let bits =
            |rows: &[[f64; 4]]| rows.as_flattened().iter().map(|c| c.to_bits()).collect::<Vec<_>>();
        let mut plain = vec![[0.0; 4]; vectors.len()];
        for (x, g) in vectors.as_chunks().0.iter().zip(plain.as_chunks_mut().0) {
            exp_lanes(x, g);
        }
        let mut logarithms = vec![[0.0; 3]; vectors.len()];
        for (g, x) in plain.as_chunks().0.iter().zip(logarithms.as_chunks_mut().0) {
            log_lanes(g, x);
        }
        for start in 0..20 {
            for end in start..vectors.len() {
                let mut found = vec![[0.0; 4]; end - start];
                exp_rows(&vectors[start..end], &mut found);
                assert!(bits(&found) == bits(&plain[start..end]), "{start}..{end}");
                let mut back = vec![[0.0; 3]; end - start];
                let valid = log_rows(&found, &mut back);
                assert_eq!(valid, !back.as_flattened().iter().any(|c| c.is_nan()));
                let both = back.as_flattened().iter().zip(logarithms[start..end].as_flattened());
                both.for_each(|(a, b)| assert_eq!(a.to_bits(), b.to_bits(), "{start}..{end}"));
            }
        }
    }
}
