//! Jacobi's elliptic functions, and elliptic integrals of the first and third kind in Carlson's
//! form.
//!
//! The arguments of functions are the modulus and its complement, so that each is accurate near 0.
//! Sources: the Gauss (descending Landen) transformation, DLMF 22.7(i) and 19.8; B. C. Carlson,
//! Numer. Algorithms 10 (1995) 13-26.

use std::f64::consts::FRAC_PI_2;

/// Below this modulus, `sn` equals the sine, because the square of the modulus is half a rounding
/// error.
const CIRCULAR: f64 = 1e-8;
/// The distance of the arguments from their mean at which Carlson's series of degree 5 has an error
/// of half a rounding error.
const CLOSE: f64 = 2e-3;
/// The number of Gauss transformations for the smallest complement of floats. Each transformation
/// replaces the complement by its square root, approximately.
const LEVELS: usize = 16;

/// The functions `sn`, `cn`, `dn` of one modulus.
///
/// ```
/// use affinor::mechanics::bodies::elliptic::Jacobi;
/// let half = 0.5_f64.sqrt(); // the lemniscate
/// let lemniscate = Jacobi::new(half, half);
/// assert!((lemniscate.quarter_period() - 1.8540746773013719).abs() < 1e-15);
/// let [sn, cn, dn] = lemniscate.at(0.7);
/// assert!((sn * sn + cn * cn - 1.0).abs() < 1e-15);
/// assert!((dn * dn + 0.5 * sn * sn - 1.0).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobi {
    quarter: f64,
    /// The moduli `k` in ascending order, each with `1 - k`.
    moduli: [(f64, f64); LEVELS],
    levels: usize,
}

impl Jacobi {
    /// The functions for a modulus `k` and the complement `sqrt(1 - k^2) > 0`. Both numbers are in
    /// `[0, 1]`.
    pub fn new(modulus: f64, complement: f64) -> Self {
        let (mut k, mut complement) = (modulus, complement);
        // computes the quarter period directly, because the product of all 1 + k1 would have more
        // rounding errors
        let quarter = first_kind([1.0, 0.0, complement]);
        let mut jacobi = Jacobi { quarter, moduli: [(0.0, 1.0); LEVELS], levels: 0 };
        while k > CIRCULAR && jacobi.levels < LEVELS {
            (k, complement) = gauss(k, complement);
            jacobi.moduli[jacobi.levels] = level(k, complement);
            jacobi.levels += 1;
        }
        jacobi.moduli[..jacobi.levels].reverse();
        jacobi
    }

    /// The quarter period `K` of `sn` and `cn`, which is the half period of `dn`.
    pub fn quarter_period(&self) -> f64 {
        self.quarter
    }

    /// The values `sn u`, `cn u`, `dn u`.
    #[inline]
    pub fn at(&self, u: f64) -> [f64; 3] {
        let (s, c) = (u * (FRAC_PI_2 / self.quarter)).sin_cos();
        self.moduli[..self.levels].iter().fold([s, c, 1.0], |below, level| raise(below, *level))
    }
}

/// The modulus and its complement after one Gauss transformation: `k1 = (1 - k')/(1 + k')`.
pub(super) fn gauss(modulus: f64, complement: f64) -> (f64, f64) {
    let below = (modulus / (1.0 + complement)).powi(2);
    (below, 2.0 * complement.sqrt() / (1.0 + complement))
}

/// The pair of a modulus `k` and `1 - k`.
pub(super) fn level(k: f64, complement: f64) -> (f64, f64) {
    (k, complement * complement / (1.0 + k))
}

/// The functions at `(1 + k1) v`, computed from the functions at `v` for the modulus `k1`. The
/// second argument contains `k1` and `1 - k1`.
#[inline]
pub(super) fn raise([s, c, d]: [f64; 3], (k, gap): (f64, f64)) -> [f64; 3] {
    let square = s * s;
    let product = k * square;
    let scale = 1.0 / (1.0 + product);
    // uses only s where this does not cause cancellation, because the errors of c and d would
    // double at each level
    let rest = if product < 0.5 { 1.0 - product } else { c * c + gap * square };
    [(1.0 + k) * s * scale, c * d * scale, rest * scale]
}

/// The argument `u`, computed from `sn u`, `cn u >= 0`, `dn u`. It is the integral of the first
/// kind, `sn R_F(cn^2, dn^2, 1)`.
pub fn first_kind([s, c, d]: [f64; 3]) -> f64 {
    // computes the first duplication from c and d, the roots of the arguments c^2 and d^2, because
    // these squares may underflow
    let lambda = c * d + c + d;
    let [mut x, mut y, mut z] = [c * c, d * d, 1.0].map(|x| 0.25 * (x + lambda));
    loop {
        let mean = (x + y + z) / 3.0;
        let [dx, dy, dz] = [x, y, z].map(|x| 1.0 - x / mean);
        let largest = dx.abs().max(dy.abs()).max(dz.abs());
        if largest < CLOSE || largest.is_nan() {
            let (e2, e3) = (dx * dy - dz * dz, dx * dy * dz);
            let series = 1.0 + e3 / 14.0 - e2 / 10.0 + e2 * e2 / 24.0 - 3.0 / 44.0 * e2 * e3;
            return s * series / mean.sqrt();
        }
        let lambda = (x * y).sqrt() + (y * z).sqrt() + (z * x).sqrt();
        [x, y, z] = [x, y, z].map(|x| 0.25 * (x + lambda));
    }
}

/// The integral `int_0^u sn^2/(1 + n sn^2)`, computed from `sn u`, `cn u >= 0`, `dn u`, for
/// `n >= 0`. It is `sn^3 R_J(cn^2, dn^2, 1, 1 + n sn^2)/3`, a difference of integrals of the third
/// and the first kind.
pub fn third_kind([s, c, d]: [f64; 3], n: f64) -> f64 {
    // sets a negative cn to 0, because only rounding errors make it negative
    let c = c.max(0.0);
    let square = s * s;
    let mut p = 1.0 + n * square;
    let [mut x, mut y, mut z] = [c * c, d * d, 1.0];
    let [mut rx, mut ry, mut rz, mut rp] = [c, d, 1.0, p.sqrt()];
    // computes (p - x)(p - y)(p - z); the first two factors avoid cancellation of squares near 1
    let mut delta = (n * square + square) * (p - y) * (n * square);
    let (mut quarters, mut sum) = (1.0, 0.0);
    loop {
        let mean = (x + y + z + 2.0 * p) / 5.0;
        let [dx, dy, dz] = [x, y, z].map(|x| 1.0 - x / mean);
        let dp = -0.5 * (dx + dy + dz);
        let largest = dx.abs().max(dy.abs()).max(dz.abs()).max(dp.abs());
        if largest < CLOSE || largest.is_nan() {
            let xyz = dx * dy * dz;
            let e2 = dx * dy + dx * dz + dy * dz - 3.0 * dp * dp;
            let e3 = xyz + 2.0 * e2 * dp + 4.0 * dp * dp * dp;
            let e4 = (2.0 * xyz + e2 * dp + 3.0 * dp * dp * dp) * dp;
            let e5 = xyz * dp * dp;
            let series = 1.0 - 3.0 / 14.0 * e2 + e3 / 6.0 + 9.0 / 88.0 * e2 * e2
                - 3.0 / 22.0 * e4
                - 9.0 / 52.0 * e2 * e3
                + 3.0 / 26.0 * e5;
            return square * s / 3.0 * (quarters * series / (mean * mean.sqrt()) + 6.0 * sum);
        }
        let lambda = rx * ry + ry * rz + rz * rx;
        let product = (rp + rx) * (rp + ry) * (rp + rz);
        let e = delta / (product * product);
        let root = e.sqrt();
        // the elliptic integral R_C(1, 1 + e)
        let circular = if e > 1e-5 {
            root.atan() / root
        } else {
            1.0 - e / 3.0 + e * e / 5.0 - e * e * e / 7.0
        };
        sum += quarters / product * circular;
        quarters *= 0.25;
        delta *= 1.0 / 64.0;
        [x, y, z, p] = [x, y, z, p].map(|x| 0.25 * (x + lambda));
        [rx, ry, rz, rp] = [x, y, z, p].map(f64::sqrt);
    }
}
