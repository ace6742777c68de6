//! Many rotations at once: one array for every component, on all cores; or rows of components, in the thread of the caller.
//!
//! The formulas are those of [`So3`]. Over arrays of components the compiler emits vector instructions.

use super::stumpff::{NEAR, near};
use super::{LieGroup, So3, so3};
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
        .for_each(|(task, rotations)| exp_part(part(&vectors.0, task), rotations));
}

#[inline(always)]
fn exp_part([x, y, z]: [&[f64]; 3], (w, i, j, k): Four<'_>) {
    let mut all_near = true;
    for t in 0..w.len().min(x.len()) {
        let quarter = 0.25 * (x[t] * x[t] + y[t] * y[t] + z[t] * z[t]);
        all_near &= quarter < NEAR;
        let (cos, sin) = near(quarter);
        let half = 0.5 * sin;
        (w[t], i[t], j[t], k[t]) = (cos, x[t] * half, y[t] * half, z[t] * half);
    }
    if all_near {
        return;
    }
    for t in 0..x.len() {
        let vector = Vector3::new(x[t], y[t], z[t]);
        let quarter = 0.25 * vector.norm_squared();
        if quarter.is_nan() || quarter >= NEAR {
            let g = So3.exp(&vector);
            (w[t], i[t], j[t], k[t]) = (g.w, g.i, g.j, g.k);
        }
    }
}

/// Logarithms of all rotations, of length at most `pi`; NaN for a quaternion that is zero or not finite.
///
/// # Panics
/// If the numbers of elements differ.
pub fn log(rotations: &Quaternions, vectors: &mut Vectors) {
    assert_eq!(rotations.len(), vectors.len(), "as many vectors as rotations");
    tasks3(vectors)
        .enumerate()
        .for_each(|(task, vectors)| log_part(part(&rotations.0, task), vectors));
}

#[inline(always)]
fn log_part([w, i, j, k]: [&[f64]; 4], (x, y, z): Three<'_>) {
    let mut all_unit = true;
    for t in 0..x.len().min(w.len()) {
        let square = i[t] * i[t] + j[t] * j[t] + k[t] * k[t];
        let norm = w[t] * w[t] + square;
        all_unit &= so3::is_unit(norm);
        let factor = so3::logarithm([i[t], j[t], k[t], w[t]], square, norm);
        (x[t], y[t], z[t]) = (i[t] * factor, j[t] * factor, k[t] * factor);
    }
    for t in if all_unit { 0..0 } else { 0..w.len() } {
        let g = UnitQuaternion::new_unchecked(Quaternion::new(w[t], i[t], j[t], k[t]));
        let vector = So3.log(&g).unwrap_or(Vector3::repeat(f64::NAN));
        (x[t], y[t], z[t]) = (vector.x, vector.y, vector.z);
    }
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

/// The number of rows that are turned into columns together.
const ROWS: usize = 64;

/// [`exp`] of rows `x, y, z`, to rows `w, x, y, z`, in the thread of the caller.
///
/// ```
/// use affinor::group::batch;
/// let mut rotations = [[0.0; 4]; 2];
/// batch::exp_rows(&[[0.0, 0.0, std::f64::consts::PI], [0.0; 3]], &mut rotations);
/// assert!((rotations[0][3] - 1.0).abs() < 1e-15);
/// assert_eq!(rotations[1], [1.0, 0.0, 0.0, 0.0]);
/// ```
pub fn exp_rows(vectors: &[[f64; 3]], rotations: &mut [[f64; 4]]) {
    for (vectors, rotations) in vectors.chunks(ROWS).zip(rotations.chunks_mut(ROWS)) {
        let (n, x) = (vectors.len(), columns(vectors));
        let mut y = [[0.0; ROWS]; 4];
        let [w, i, j, k] = &mut y;
        exp_part(
            x.each_ref().map(|x| &x[..n]),
            (&mut w[..n], &mut i[..n], &mut j[..n], &mut k[..n]),
        );
        into_rows(&y, rotations);
    }
}

/// [`log`] of rows `w, x, y, z`, in the thread of the caller.
pub fn log_rows(rotations: &[[f64; 4]], vectors: &mut [[f64; 3]]) {
    for (rotations, vectors) in rotations.chunks(ROWS).zip(vectors.chunks_mut(ROWS)) {
        let (n, x) = (rotations.len(), columns(rotations));
        let mut y = [[0.0; ROWS]; 3];
        let [i, j, k] = &mut y;
        log_part(x.each_ref().map(|x| &x[..n]), (&mut i[..n], &mut j[..n], &mut k[..n]));
        into_rows(&y, vectors);
    }
}

fn columns<const N: usize>(rows: &[[f64; N]]) -> [[f64; ROWS]; N] {
    let mut columns = [[0.0; ROWS]; N];
    for (at, row) in rows.iter().enumerate() {
        (0..N).for_each(|column| columns[column][at] = row[column]);
    }
    columns
}

fn into_rows<const N: usize>(columns: &[[f64; ROWS]; N], rows: &mut [[f64; N]]) {
    for (at, row) in rows.iter_mut().enumerate() {
        *row = std::array::from_fn(|column| columns[column][at]);
    }
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
    /// The element of an index.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn get(&self, at: usize) -> Vector3<f64> {
        self.element(at).into()
    }
}

impl Quaternions {
    /// The element of an index.
    ///
    /// # Panics
    /// If the index is out of range.
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
