//! Operations on many elements of SO(3) or SE(3). The elements are rows of arrays, and all
//! computations run in the thread of the caller.
//!
//! [`exp_rows`], [`log_rows`] and [`compose_rows`] compute with rotations. [`map`] applies any
//! kernel of [`rotations`] and [`motions`] to rows. The formulas are those of [`So3`] and
//! [`Se3`](super::Se3). For blocks of rows, the compiler emits vector instructions. The feature
//! `simd` chooses the instructions at run time, to suit the processor. All instruction sets round
//! alike, so a result depends only on its argument.

pub mod motions;
pub mod rotations;
mod rows;

pub use rows::{Kernel, Operand, map, single};

use super::groups::so3;
use super::rotation::formulas::product;
use super::{LieGroup, So3};
use crate::numerics::stumpff::{NEAR, near};
#[cfg(feature = "simd")]
use multiversion::multiversion;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Returns a quarter of the squared angle, the scalar part of the quaternion, and the ratio of its
/// vector part to the rotation vector. The last two values are valid only if the first value is
/// below [`NEAR`].
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

/// Returns the squared norm of the quaternion, and the ratio of the rotation vector to the vector
/// part. The ratio is valid only if the norm is near 1.
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

/// Computes the products `g h` of all pairs of rows `w, x, y, z`.
pub fn compose_rows(g: &[[f64; 4]], h: &[[f64; 4]], products: &mut [[f64; 4]]) {
    for ((g, h), gh) in g.iter().zip(h).zip(products) {
        *gh = product(*g, *h);
    }
}

/// Computes the exponentials of rows `x, y, z`, as rows `w, x, y, z`.
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
/// If the numbers of rows differ.
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

/// Computes the logarithms of rows `w, x, y, z`, whose length is at most `pi`. The logarithm of a
/// quaternion that is zero or not finite is NaN. Returns whether every row has a logarithm.
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

/// The number of rows that are computed at once.
const LANES: usize = 16;

/// Transposes rows to columns, because the compiler turns loops over columns into vector
/// instructions.
#[inline(always)]
fn columns<const N: usize>(rows: &[[f64; N]; LANES]) -> [[f64; LANES]; N] {
    std::array::from_fn(|column| std::array::from_fn(|row| rows[row][column]))
}

/// The rows of an incomplete block, padded with `fill`.
#[inline(always)]
fn filled<const N: usize>(rest: &[[f64; N]], fill: [f64; N]) -> [[f64; N]; LANES] {
    let mut block = [fill; LANES];
    block[..rest.len()].copy_from_slice(rest);
    block
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The instructions of this processor yield the same floats as the basic instructions, at every
    /// position of a batch.
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
