//! The Stumpff functions, in which the closed forms of rotations and their kin are written.

use super::polynomial::{eight_terms, polynomial};

/// `c_k(z) = sum (-z)^i/(k + 2i)!` for `k = 0..=5`, for any sign of `z`.
///
/// `c_0(x^2) = cos x`, `c_1(x^2) = sin x/x`, `c_0(-x^2) = cosh x`, and `c_k = 1/k! - z c_{k+2}`. For a
/// matrix with `A^3 = -z A`, `exp(A) = 1 + c_1 A + c_2 A^2` and `sum A^k/(k+1)! = 1 + c_2 A + c_3 A^2`.
/// K. Stumpff, *Himmelsmechanik* (1959), section V.41.
///
/// ```
/// use affinor::group::stumpff::Stumpff;
/// let c = Stumpff::at(1e-8); // where (1 - cos x)/x^2 has lost half of its digits
/// assert_eq!(c.c2, 0.5 - 1e-8 / 24.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stumpff {
    /// The argument.
    pub z: f64,
    /// `cos x`.
    pub c0: f64,
    /// `sin x / x`.
    pub c1: f64,
    /// `(1 - cos x)/x^2`.
    pub c2: f64,
    /// `(x - sin x)/x^3`.
    pub c3: f64,
    /// `(x^2/2 - 1 + cos x)/x^4`.
    pub c4: f64,
    /// `(x^3/6 - x + sin x)/x^5`.
    pub c5: f64,
}

/// Beyond this square of an angle, floats are many turns apart, and `cos` and `sin` are noise: what is
/// left of a tangent operator is its mean over a turn.
pub(super) const FAR: f64 = 1e40;

/// Below this modulus of `z` the differences lose digits, and the series have few terms.
const SERIES: f64 = 10.0;

impl Stumpff {
    /// All of them at `z`. They overflow where cosh does.
    #[inline]
    pub fn at(z: f64) -> Self {
        if z.abs() < SERIES {
            let (c4, c5) = if z.abs() < SMALL {
                (eight_terms(&first(&FOURTH), z), eight_terms(&first(&FIFTH), z))
            } else {
                (polynomial(&FOURTH, z), polynomial(&FIFTH, z))
            };
            let (c2, c3) = (0.5 - z * c4, 1.0 / 6.0 - z * c5);
            return Stumpff { z, c0: 1.0 - z * c2, c1: 1.0 - z * c3, c2, c3, c4, c5 };
        }
        let (cos, half) = far(0.25 * z);
        // no difference: 1 - cos x = 2 sin^2(x/2)
        let (c0, c1, c2) = (1.0 - 0.5 * z * half * half, half * cos, 0.5 * half * half);
        let c3 = (1.0 - c1) / z;
        Stumpff { z, c0, c1, c2, c3, c4: (0.5 - c2) / z, c5: (1.0 / 6.0 - c3) / z }
    }

    /// `c_2'(z) = c_4 - c_3/2 = (c_1/2 - c_2)/z`.
    pub fn slope2(&self) -> f64 {
        if self.z.abs() < SERIES {
            self.c4 - 0.5 * self.c3
        } else {
            // far out the first form is a difference of near equals
            (0.5 * self.c1 - self.c2) / self.z
        }
    }

    /// `c_3'(z) = (3 c_5 - c_4)/2 = (c_2 - 3 c_3)/(2 z)`.
    pub fn slope3(&self) -> f64 {
        if self.z.abs() < SERIES {
            1.5 * self.c5 - 0.5 * self.c4
        } else {
            (0.5 * self.c2 - 1.5 * self.c3) / self.z
        }
    }
}

/// `(c_0(z), c_1(z))` alone, to a rounding or two.
#[inline]
pub fn first_two(z: f64) -> (f64, f64) {
    if z.abs() < SMALL {
        return (eight_terms(&first(&ZEROTH), z), eight_terms(&first(&FIRST), z));
    }
    larger(z)
}

/// [`first_two`] of an angle that no step has: not to be inlined with it.
#[inline(never)]
fn larger(z: f64) -> (f64, f64) {
    if z.abs() < NEAR { near(z) } else { far(z) }
}

/// `(c_1(z), c_2(z))` alone: `R = 1 + c_1 spin(x) + c_2 spin(x)^2` at `z = |x|^2`.
#[inline]
pub(super) fn turning(z: f64) -> (f64, f64) {
    if z.abs() < SMALL {
        return (eight_terms(&first(&FIRST), z), eight_terms(&SECOND, z));
    }
    turning_far(z)
}

#[inline(never)]
fn turning_far(z: f64) -> (f64, f64) {
    let c = Stumpff::at(z);
    (c.c1, c.c2)
}

/// Below this modulus of `z`, such as half the angle that a body turns in a step, [`TERMS`] of a series are enough:
/// the next one is below 4e-17.
const SMALL: f64 = 0.4;
const TERMS: usize = 8;

/// The first terms of a series.
const fn first<const N: usize>(series: &[f64; N]) -> [f64; TERMS] {
    let mut terms = [0.0; TERMS];
    let mut i = 0;
    while i < TERMS {
        terms[i] = series[i];
        i += 1;
    }
    terms
}

/// Where [`near`] is taken: up to 1.5 for `x`. At a right angle `z` no longer tells on which side of it
/// `x` is, but its root does.
pub(super) const NEAR: f64 = 2.25;

/// [`first_two`] for `|z| < NEAR`, without a branch.
#[inline(always)]
pub(super) fn near(z: f64) -> (f64, f64) {
    (polynomial(&ZEROTH, z), polynomial(&FIRST, z))
}

/// [`first_two`] where `z` is not small.
fn far(z: f64) -> (f64, f64) {
    let root = z.abs().sqrt();
    if z > 0.0 {
        let (sin, cos) = root.sin_cos();
        (cos, sin / root)
    } else {
        (root.cosh(), root.sinh() / root)
    }
}

/// `(-1)^i/(k + 2i)!`.
const fn coefficients<const N: usize>(k: usize) -> [f64; N] {
    let mut coefficients = [1.0; N];
    let mut factorial = 1.0;
    let mut n = 1;
    while n < k + 2 * N {
        factorial *= n as f64;
        if n >= k && (n - k).is_multiple_of(2) {
            let i = (n - k) / 2;
            coefficients[i] = if i.is_multiple_of(2) { 1.0 } else { -1.0 } / factorial;
        }
        n += 1;
    }
    coefficients
}

// the first term left out is below 1e-16 of the sum up to NEAR, below 1e-18 of it up to SERIES
const ZEROTH: [f64; 12] = coefficients(0);
const FIRST: [f64; 12] = coefficients(1);
const SECOND: [f64; TERMS] = coefficients(2);
const FOURTH: [f64; 15] = coefficients(4);
const FIFTH: [f64; 15] = coefficients(5);

/// `|B_2k|/(2k)!` for `k = 1..=8`, Bernoulli's numbers: the first terms of [`inverse_tangent`].
const INVERSE: [f64; 8] = [
    1.0 / 12.0,
    1.0 / 720.0,
    1.0 / 30240.0,
    1.0 / 1209600.0,
    1.0 / 47900160.0,
    691.0 / 1307674368000.0,
    1.0 / 74724249600.0,
    3617.0 / 10670622842880000.0,
];

/// `(1 - (x/2) cot(x/2))/x^2` at `z = x^2`: `(sum A^k/(k+1)!)^-1 = 1 - A/2 + d A^2` where
/// `A^3 = -z A`.
///
/// With `w = z/4` it is `(c_2(w) - c_3(w))/(4 c_1(w))`, without a difference of near equals up to its first pole
/// `x = 2 pi`.
#[inline]
pub fn inverse_tangent(z: f64) -> f64 {
    if z.abs() < SMALL {
        return eight_terms(&INVERSE, z);
    }
    let c = Stumpff::at(0.25 * z);
    (c.c2 - c.c3) / (4.0 * c.c1)
}
