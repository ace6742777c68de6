//! The Stumpff functions, which occur in the closed forms of rotations and related groups.

use super::lanes::Lane;

/// The Stumpff functions `c_k(z) = sum (-z)^i/(k + 2i)!` for `k = 0..=5`. The argument `z` may have
/// any sign.
///
/// They satisfy `c_0(x^2) = cos x`, `c_1(x^2) = sin x/x`, `c_0(-x^2) = cosh x`, and
/// `c_k = 1/k! - z c_{k+2}`. For a matrix with `A^3 = -z A`, `exp(A) = 1 + c_1 A + c_2 A^2` and
/// `sum A^k/(k+1)! = 1 + c_2 A + c_3 A^2`. K. Stumpff, *Himmelsmechanik* (1959), section V.41.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stumpff {
    /// The argument.
    pub z: f64,
    /// The value `cos x`, at `z = x^2`.
    pub c0: f64,
    /// The value `sin x / x`.
    pub c1: f64,
    /// The value `(1 - cos x)/x^2`.
    pub c2: f64,
    /// The value `(x - sin x)/x^3`.
    pub c3: f64,
    /// The value `(x^2/2 - 1 + cos x)/x^4`.
    pub c4: f64,
    /// The value `(x^3/6 - x + sin x)/x^5`.
    pub c5: f64,
}

/// If the square of an angle exceeds this value, neighbouring floats are many turns apart, so that
/// `cos` and `sin` are meaningless. Tangent operators are then replaced by their mean over a turn.
pub(crate) const FAR: f64 = 1e40;

/// If the magnitude of `z` is below this value, the closed forms suffer from cancellation, and the
/// series need few terms.
pub(crate) const SERIES: f64 = 10.0;

impl Stumpff {
    /// All functions at `z`. They overflow where cosh overflows.
    #[inline]
    pub(crate) fn at(z: f64) -> Self {
        if z.abs() < SERIES {
            let short = z.abs() < SMALL;
            return Self::by_series(z, short);
        }
        Self::by_half_angle(z)
    }

    /// Computes all functions from the series of `c_4` and `c_5`. If `short` is set, each series
    /// has eight terms.
    #[inline(always)]
    fn by_series(z: f64, short: bool) -> Self {
        let (c4, c5) = if short {
            (eight_terms(&first(&FOURTH), z), eight_terms(&first(&FIFTH), z))
        } else {
            (polynomial(&FOURTH, z), polynomial(&FIFTH, z))
        };
        let Series { c1, c2, c3, .. } = Series::of_last(z, c4, c5);
        Stumpff { z, c0: 1.0 - z * c2, c1, c2, c3, c4, c5 }
    }

    /// Computes all functions in closed form, from the cosine and sine of the half angle.
    #[inline(always)]
    fn by_half_angle(z: f64) -> Self {
        let (cos, half) = far(0.25 * z);
        // uses 1 - cos x = 2 sin^2(x/2), which avoids cancellation
        let (c0, c1, c2) = (1.0 - 0.5 * z * half * half, half * cos, 0.5 * half * half);
        let c3 = (1.0 - c1) / z;
        Stumpff { z, c0, c1, c2, c3, c4: (0.5 - c2) / z, c5: (1.0 / 6.0 - c3) / z }
    }

    /// The derivative `c_2'(z) = c_4 - c_3/2 = (c_1/2 - c_2)/z`.
    pub(crate) fn slope2(&self) -> f64 {
        if self.z.abs() < SERIES {
            self.c4 - 0.5 * self.c3
        } else {
            // uses the second form, because the first form suffers from cancellation for large z
            (0.5 * self.c1 - self.c2) / self.z
        }
    }

    /// The derivative `c_3'(z) = (3 c_5 - c_4)/2 = (c_2 - 3 c_3)/(2 z)`.
    pub(crate) fn slope3(&self) -> f64 {
        if self.z.abs() < SERIES {
            1.5 * self.c5 - 0.5 * self.c4
        } else {
            (0.5 * self.c2 - 1.5 * self.c3) / self.z
        }
    }
}

/// The functions `c_1 ... c_5`, computed by their series for `|z| <` [`SERIES`]. There may be
/// several arguments at once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Series<T> {
    pub c1: T,
    pub c2: T,
    pub c3: T,
    pub c4: T,
    pub c5: T,
}

impl<T: Lane> Series<T> {
    #[inline(always)]
    pub(crate) fn at(z: T) -> Self {
        Self::of_last(z, polynomial(&FOURTH, z), polynomial(&FIFTH, z))
    }

    /// Computes all functions from `c_4` and `c_5`.
    #[inline(always)]
    fn of_last(z: T, c4: T, c5: T) -> Self {
        let (c2, c3) = (T::splat(0.5) - z * c4, T::splat(1.0 / 6.0) - z * c5);
        Series { c1: T::splat(1.0) - z * c3, c2, c3, c4, c5 }
    }

    /// The derivatives `c_2'(z)` and `c_3'(z)`.
    #[inline(always)]
    pub(crate) fn slopes(&self) -> [T; 2] {
        let half = T::splat(0.5);
        [self.c4 - half * self.c3, T::splat(1.5) * self.c5 - half * self.c4]
    }
}

/// The number `d` of [`inverse_tangent`] and its derivative `d'(z)`, for `|z| <` [`SERIES`]. The
/// derivative is `d' = (c_1 (c_2' - c_3') - c_1' (c_2 - c_3))/(16 c_1^2)` at `z/4`, where
/// `2 c_1' = c_3 - c_2`.
#[inline(always)]
pub(crate) fn inverse_series<T: Lane>(z: T) -> (T, T) {
    let c = Series::at(T::splat(0.25) * z);
    let difference = c.c2 - c.c3;
    let [slope2, slope3] = c.slopes();
    let below = T::splat(4.0) * c.c1;
    let above = c.c1 * (slope2 - slope3) + T::splat(0.5) * (difference * difference);
    (difference / below, above / (below * below))
}

/// The values `(c_0(z), c_1(z))`. They are accurate up to one or two rounding errors.
#[inline]
pub(crate) fn first_two(z: f64) -> (f64, f64) {
    if z.abs() < SMALL {
        return (eight_terms(&first(&ZEROTH), z), eight_terms(&first(&FIRST), z));
    }
    larger(z)
}

/// The values of [`first_two`] for angles that are larger than in a typical step. The function is
/// not inlined.
#[inline(never)]
fn larger(z: f64) -> (f64, f64) {
    if z.abs() < NEAR { near(z) } else { far(z) }
}

/// The values `(c_1(z), c_2(z))`. At `z = |x|^2`, the rotation is
/// `R = 1 + c_1 spin(x) + c_2 spin(x)^2`.
#[inline]
pub(crate) fn turning(z: f64) -> (f64, f64) {
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

/// If the magnitude of `z` is below this value, [`TERMS`] terms of a series suffice, because the
/// next term is below 4e-17. For example, half the rotation angle of a body in a step is small.
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

/// The limit of `z` for [`near`], which corresponds to `x` up to 1.5. Near a right angle, the
/// rounding of `z` does not determine on which side of the angle `x` is.
pub(crate) const NEAR: f64 = 2.25;

/// The values of [`first_two`] for `|z| < NEAR`, computed without a branch.
#[inline(always)]
pub(crate) fn near<T: Lane>(z: T) -> (T, T) {
    (polynomial(&ZEROTH, z), polynomial(&FIRST, z))
}

/// The values of [`first_two`] for `z` that is not small.
fn far(z: f64) -> (f64, f64) {
    let root = z.abs().sqrt();
    if z > 0.0 {
        let (sin, cos) = root.sin_cos();
        (cos, sin / root)
    } else {
        (root.cosh(), root.sinh() / root)
    }
}

/// The coefficients `(-1)^i/(k + 2i)!` of the series of `c_k`.
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

// the first omitted term is small relative to the sum: below 1e-16 for z up to NEAR, and below
// 1e-18 for z up to SERIES
const ZEROTH: [f64; 12] = coefficients(0);
const FIRST: [f64; 12] = coefficients(1);
const SECOND: [f64; TERMS] = coefficients(2);
const FOURTH: [f64; 15] = coefficients(4);
const FIFTH: [f64; 15] = coefficients(5);

/// The error of `z` in units of its rounding error. It includes the rounding errors of a squared
/// length, and of the components from which this length is computed.
const ROUNDINGS: f64 = 8.0;

/// The function `d = (1 - (x/2) cot(x/2))/x^2` at `z = x^2`. For a matrix with `A^3 = -z A`, it
/// satisfies `(sum A^k/(k+1)!)^-1 = 1 - A/2 + d A^2`.
///
/// With `w = z/4`, the function is `(c_2(w) - c_3(w))/(4 c_1(w))`, which causes no cancellation up
/// to its first pole `x = 2 pi`. The parameter `size` is the sum of the magnitudes of the terms of
/// `z`. Returns `None` if the rounding errors of these terms exceed the distance of `z` from a pole
/// `z = (2 pi k)^2`.
#[inline]
pub(crate) fn inverse_tangent(z: f64, size: f64) -> Option<f64> {
    if z.abs() < SMALL {
        return Some(eight_terms(&INVERSE, z));
    }
    let c = Stumpff::at(0.25 * z);
    // near a pole, c_1 = sin(x/2)/(x/2) is half of the relative distance of z from the pole; this
    // distance must exceed the rounding error
    let regular = c.c1.abs() > ROUNDINGS * f64::EPSILON * (size / z.abs());
    regular.then(|| (c.c2 - c.c3) / (4.0 * c.c1)).filter(|d| d.is_finite())
}

/// The numbers `|B_2k|/(2k)!` for `k = 1..=8`, where `B_2k` are the Bernoulli numbers. They are the
/// first coefficients of [`inverse_tangent`].
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

/// The value of the polynomial `c_0 + c_1 z + c_2 z^2 + ...`. It is computed in four independent
/// chains, each of every fourth term, which a processor evaluates in parallel.
#[inline(always)]
pub(crate) fn polynomial<T: Lane, const N: usize>(coefficients: &[f64; N], z: T) -> T {
    let square = z * z;
    let fourth = square * square;
    let mut chains = [T::splat(0.0); 4];
    for k in (0..N).rev() {
        chains[k % 4] = chains[k % 4] * fourth + T::splat(coefficients[k]);
    }
    (chains[0] + z * chains[1]) + square * (chains[2] + z * chains[3])
}

/// The value of a polynomial of eight terms, computed by Estrin's scheme, which has the shortest
/// chain of operations.
///
/// G. Estrin, *Western Joint IRE-AIEE-ACM Computer Conference* (1960) 33-40.
#[inline(always)]
fn eight_terms(c: &[f64; 8], z: f64) -> f64 {
    let square = z * z;
    let low = (c[0] + z * c[1]) + square * (c[2] + z * c[3]);
    let high = (c[4] + z * c[5]) + square * (c[6] + z * c[7]);
    low + square * square * high
}

#[cfg(test)]
mod tests {
    use super::*;
    use affinor_tensors::Rational;

    /// The value `c_k(z)`, computed by its series in exact fractions up to terms below 1e-30.
    fn exact(k: i64, z: f64) -> Rational {
        let z = Rational::from_f64(z).expect("a finite number");
        let mut term = (1..=k).fold(Rational::from(1), |term, n| term / Rational::from(n));
        let mut sum = Rational::from(0);
        let mut i = 0;
        while i < 4 || term.clone().abs().to_f64() > 1e-30 {
            sum += &term;
            i += 1;
            term = -(term * &z) / Rational::from((k + 2 * i - 1) * (k + 2 * i));
        }
        sum
    }

    /// The error of a number, in machine epsilons. It is relative to the exact number, or to a
    /// size.
    fn off(found: f64, exact: Rational, size: f64) -> f64 {
        let size = exact.to_f64().abs().max(size);
        let found = Rational::from_f64(found).expect("a finite number");
        (found - exact).to_f64().abs() / size / f64::EPSILON
    }

    /// Asserts that the error is at most `bound`, relative to the size of `c_k` near `z`, where
    /// `c_k` oscillates.
    fn bounded(k: i64, z: f64, found: f64, bound: f64) {
        let largest = 1.0 / (1..=k).map(|n| n as f64).product::<f64>();
        let envelope = [1.0, z.powf(-0.5), 2.0 / z, 1.0 / z, 0.5 / z, 1.0 / (6.0 * z)][k as usize];
        let off = off(found, exact(k, z), if z > 0.0 { largest.min(envelope) } else { 0.0 });
        assert!(off <= bound, "c_{k}({z:e}) is off by {off} eps");
    }

    fn all(c: Stumpff) -> [f64; 6] {
        [c.c0, c.c1, c.c2, c.c3, c.c4, c.c5]
    }

    /// A threshold, its neighbouring floats, and more distant numbers on both sides.
    fn around(threshold: f64, farthest: f64) -> impl Iterator<Item = f64> {
        let far = (1..=20).map(move |step| farthest.powf(f64::from(step) / 20.0));
        let near = [1.0, 1.0 + 1e-9, 1.0 + 2.0 * f64::EPSILON].into_iter().chain(far);
        let ratios = near.flat_map(|ratio| [ratio, 1.0 / ratio]);
        ratios.flat_map(move |ratio| [threshold * ratio, -threshold * ratio])
    }

    /// Every function is accurate on both sides of every threshold.
    #[test]
    fn every_function_around_every_threshold() {
        let thresholds = [SMALL, NEAR, SERIES, 4.0 * SMALL, 4.0 * NEAR];
        for z in thresholds.into_iter().flat_map(|threshold| around(threshold, 4.0)) {
            for (k, found) in (0..6).zip(all(Stumpff::at(z))) {
                bounded(k, z, found, 6.0);
            }
            let (pair, turning) = (first_two(z), turning(z));
            for (k, found) in [(0, pair.0), (1, pair.1), (1, turning.0), (2, turning.1)] {
                bounded(k, z, found, 4.0);
            }
        }
    }

    /// Each algorithm is accurate in its range, and slightly beyond its threshold.
    #[test]
    fn every_path_beyond_its_threshold() {
        let six = |z: f64, c: Stumpff, bound: f64| {
            (0..6).zip(all(c)).for_each(|(k, found)| bounded(k, z, found, bound));
        };
        for z in around(SMALL, 4.0).filter(|z| z.abs() < 1.1 * SMALL) {
            six(z, Stumpff::by_series(z, true), 4.0);
            six(z, Stumpff::by_series(z, false), 4.0);
        }
        for z in around(SERIES, 100.0).filter(|z| z.abs() < 1.2 * SERIES) {
            six(z, Stumpff::by_series(z, false), 6.0);
        }
        for z in around(SERIES, 2.0) {
            six(z, Stumpff::by_half_angle(z), 10.0);
        }
        for z in around(NEAR, 100.0) {
            let closed = far(z);
            bounded(0, z, closed.0, 5.0);
            bounded(1, z, closed.1, 5.0);
            if z.abs() < 1.2 * NEAR {
                let series = near(z);
                bounded(0, z, series.0, 3.0);
                bounded(1, z, series.1, 3.0);
            }
        }
    }

    /// The derivatives `c_2'` and `c_3'` satisfy `2 c_k' = k c_{k+2} - c_{k+1}`.
    #[test]
    fn slopes_around_the_threshold() {
        for z in around(SERIES, 8.0) {
            let c = Stumpff::at(z);
            for (k, found) in [(2, c.slope2()), (3, c.slope3())] {
                let slope = exact(k + 2, z) * Rational::from(k) - exact(k + 1, z);
                let size = if z > 0.0 { 0.5 * z.powf(-1.5) } else { 0.0 };
                let off = off(found, slope / Rational::from(2), size);
                assert!(off <= 8.0, "c_{k}'({z:e}) is off by {off} eps");
            }
        }
    }

    /// The series of all functions, of their slopes and of the inverse are accurate within their
    /// ranges.
    #[test]
    fn series_within_their_range() {
        for z in (0..200).map(|k| 0.05 * f64::from(k)).chain([1e-300, 1e-9, 9.999_999]) {
            let c = Series::at(z);
            for (k, found) in (1..).zip([c.c1, c.c2, c.c3, c.c4, c.c5]) {
                bounded(k, z, found, 6.0);
            }
            let at = Stumpff::at(z);
            let [slope2, slope3] = c.slopes();
            assert!((slope2 - at.slope2()).abs() <= 4e-16, "c_2'({z:e}) = {slope2:e}");
            assert!((slope3 - at.slope3()).abs() <= 2e-16, "c_3'({z:e}) = {slope3:e}");
            let (d, slope) = inverse_series(z);
            let expected = inverse_tangent(z, z).expect("no pole");
            assert!((d - expected).abs() <= 8e-16 * expected, "d({z:e}) = {d:e}");
            // a central difference of odd order; the tolerance includes the errors of the step and
            // of rounding
            let h = 1e-3;
            let at = |z: f64| inverse_series(z).0;
            let difference =
                (8.0 * (at(z + h) - at(z - h)) - (at(z + 2.0 * h) - at(z - 2.0 * h))) / (12.0 * h);
            assert!((slope - difference).abs() <= 1e-11, "d'({z:e}) = {slope:e}");
        }
    }

    /// The inverse equals `(c_2 - c_3)/(4 c_1)` at a quarter of the argument, on both sides of the
    /// first pole.
    #[test]
    fn the_inverse_around_its_thresholds() {
        let exact = |z: f64| {
            let quarter = 0.25 * z;
            let four = Rational::from(4);
            (exact(2, quarter) - exact(3, quarter)) / (exact(1, quarter) * four)
        };
        let points = around(SMALL, 4.0).chain(around(4.0 * NEAR, 2.0));
        for z in points.chain(around(4.0 * SERIES, 2.0)) {
            let expected = exact(z);
            let size = expected.to_f64().abs().max(z.abs().recip().min(1.0 / 12.0));
            // the tolerance depends on the condition, because near the pole, the rounding of the
            // argument is amplified
            let step = f64::from(1 << 20).recip();
            let change = exact(z * (1.0 + step)) - expected.clone();
            let condition = change.to_f64().abs() / step / size;
            let found = inverse_tangent(z, z.abs()).expect("no pole");
            let off = off(found, expected, size) / (1.0 + condition);
            assert!(off <= 8.0, "the inverse at {z:e} is off by {off} eps");
        }
    }
}
