//! SL(2,R), the real matrices of size 2 and determinant 1.

use crate::Error;
use crate::group::TranslationSplit;
use crate::group::matrices::{MatrixNotation, TOLERANCE, checked, replace, sparse};
use crate::group::{Embedded, LieGroup, tangent};
use crate::numerics::rounding::expect_digits_of_product;
use crate::numerics::stumpff::Stumpff;
use nalgebra::{DMatrix, Matrix2, Vector3, Vector4};
use std::f64::consts::PI;

/// The group of real matrices of size 2 with determinant 1.
///
/// A vector `(e, f, h)` is the matrix `[[h, e], [f, -h]]`. The basis is the basis of `sl(2)` in the
/// catalogue: `[E, F] = H`, `[H, E] = 2 E`, `[H, F] = -2 F`. The exponential is not surjective: its
/// image consists of `-1` and the elements whose trace exceeds -2.
///
/// ```
/// use affinor::group::{LieGroup, Sl2};
/// use nalgebra::Matrix2;
/// let refused = Sl2.log(&Matrix2::new(-2.0, 0.0, 0.0, -0.5)).unwrap_err();
/// let reason = "invalid logarithm: the trace is -2.5, but every exp(x) other than -1 has a trace above -2";
/// assert_eq!(refused.to_string(), reason);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sl2;

/// Squares of larger numbers may overflow.
const LARGE: f64 = 1e150;

/// Cancellation is assumed if the ratio of the terms to their sum exceeds this value.
const CANCELLED: f64 = 64.0;

/// A limit for the squared sine of the angle. If the squared sine is at most this value, the
/// derivative of angle over sine with respect to the squared sine is less than 1.
const NEAR: f64 = 1e-4;

fn traceless(x: &Vector3<f64>) -> Matrix2<f64> {
    Matrix2::new(x[2], x[0], x[1], -x[2])
}

/// The components of the traceless part of a matrix.
fn components(m: &Matrix2<f64>) -> Vector3<f64> {
    Vector3::new(m[(0, 1)], m[(1, 0)], 0.5 * (m[(0, 0)] - m[(1, 1)]))
}

/// The determinant of the matrix `x`, which satisfies `x^2 = -det(x)`.
fn determinant(x: &Vector3<f64>) -> f64 {
    let largest = x.amax();
    let product = |x: &Vector3<f64>| -x[2] * x[2] - x[0] * x[1];
    if largest < LARGE {
        return product(x);
    }
    match product(&(x / largest)) {
        0.0 => 0.0,
        small => largest * small * largest,
    }
}

/// The logarithm of `cos + part`, where `part = (sin / angle) x`. In the hyperbolic case, the
/// functions are cosh and sinh.
fn logarithm(cos: f64, part: &Vector3<f64>) -> Result<Vector3<f64>, Error> {
    if (cos + 1.0).abs() <= 4.0 * f64::EPSILON && part.amax() <= 4.0 * f64::EPSILON {
        return Ok(Vector3::new(-PI, PI, 0.0));
    }
    let square = determinant(part);
    let sine = square.abs().sqrt();
    if square <= 0.0 && cos < 0.0 {
        let trace = 2.0 * cos;
        let reason = match trace > -2.0 {
            true => format!("the trace is {trace}, so near -2 that rounding hides the angle"),
            false => {
                format!("the trace is {trace}, but every exp(x) other than -1 has a trace above -2")
            }
        };
        return Err(Error::Invalid { what: "logarithm", reason });
    }
    let angle = if square > 0.0 { sine.atan2(cos) } else { sine.asinh() };
    Ok(if sine == 0.0 { *part } else { part * (angle / sine) })
}

impl LieGroup for Sl2 {
    type Element = Matrix2<f64>;
    type Vector = Vector3<f64>;

    fn dimension(&self) -> usize {
        3
    }

    fn identity(&self) -> Self::Element {
        Matrix2::identity()
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        g * h
    }

    /// The adjugate of the matrix, which is the inverse because the determinant is 1.
    fn inverse(&self, g: &Self::Element) -> Self::Element {
        Matrix2::new(g[(1, 1)], -g[(0, 1)], -g[(1, 0)], g[(0, 0)])
    }

    /// Returns `c_0 + c_1 x` with the Stumpff functions of `det x`. If `x` is hyperbolic
    /// (`det x < 0`), the result overflows where cosh overflows.
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let z = determinant(x);
        if z > LARGE {
            let unit = x / x.amax();
            let length = determinant(&unit).sqrt();
            let (sin, cos) = (x.amax() * length).sin_cos();
            return Matrix2::identity() * cos + traceless(&unit) * (sin / length);
        }
        let c = Stumpff::at(z);
        Matrix2::identity() * c.c0 + traceless(x) * c.c1
    }

    /// The logarithm with an angle of at most `pi`. For `-1`, the result is the half turn
    /// `pi (F - E)`, which is one of several logarithms.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        logarithm(0.5 * g.trace(), &components(g))
    }

    /// Computes the product accurately for short vectors. The trace-free part of
    /// `(c_0 + c_1 x) (d_0 + d_1 y)` is `c_0 d_1 y + d_0 c_1 x + c_1 d_1 [x, y]/2`. Returns an
    /// error if cancellation makes the result inaccurate.
    fn log_product(&self, x: &Self::Vector, y: &Self::Vector) -> Result<Self::Vector, Error> {
        let [zx, zy] = [x, y].map(determinant);
        if zx.max(zy) > LARGE {
            return self.log(&self.compose(&self.exp(x), &self.exp(y)));
        }
        let (c, d) = (Stumpff::at(zx), Stumpff::at(zy));
        let half_trace = x[2] * y[2] + 0.5 * (x[0] * y[1] + x[1] * y[0]);
        let cos = c.c0 * d.c0 + c.c1 * d.c1 * half_trace;
        let terms =
            [x * (d.c0 * c.c1), y * (c.c0 * d.c1), self.bracket(x, y) * (0.5 * c.c1 * d.c1)];
        let part = terms[0] + terms[1] + terms[2];
        let vectors: f64 = terms.iter().map(|term| term.abs().sum()).sum();
        let terms = vectors + (c.c0 * d.c0).abs() + (c.c1 * d.c1 * half_trace).abs();
        let rounding = f64::EPSILON * terms;
        let cancelled = terms > CANCELLED * (part.amax() + cos.abs());
        // the rounding error that the sum of the vectors has anyway; it is subtracted from the
        // error
        let sum = 8.0 * f64::EPSILON * (x.amax() + y.amax());
        let unknown = |error| expect_digits_of_product(rounding - sum).and(Err(error));
        let product = logarithm(cos, &part).or_else(unknown)?;
        if cancelled {
            // computes a bound of the derivative of (angle / sine) part
            let (square, size) = (determinant(&part), part.amax());
            let slope = if square > 0.0 { cos } else { 1.0 / cos };
            let lost = match product.amax() / size {
                _ if size == 0.0 => 1.0,
                factor if cos > 0.0 && square.abs() < NEAR => factor + size * size,
                factor => factor + (slope - factor).abs() * (size * size / square.abs()),
            };
            expect_digits_of_product(rounding * lost - sum)?;
        }
        Ok(product)
    }

    /// Returns `g x g^-1`.
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        components(&(g * traceless(x) * self.inverse(g)))
    }

    fn project(&self, g: Self::Element) -> Self::Element {
        match g.determinant() {
            square if square > 0.0 => g / square.sqrt(),
            _ => g,
        }
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        Vector3::new(
            2.0 * (x[2] * y[0] - x[0] * y[2]),
            2.0 * (x[1] * y[2] - x[2] * y[1]),
            x[0] * y[1] - x[1] * y[0],
        )
    }

    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        DMatrix::from_column_slice(2, 2, g.as_slice())
    }

    /// Computes the operator in closed form, because `ad_x^3 = -4 det(x) ad_x`. The eigenvalues of
    /// `ad_x` are twice the eigenvalues of `x`, and 0.
    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        tangent::cubic(self, |x| 4.0 * determinant(x), x, v)
    }

    /// Computes the operator in closed form.
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        // the sum of the magnitudes of the terms of the determinant bounds the rounding error of
        // the determinant
        let size = 4.0 * (x[2] * x[2] + (x[0] * x[1]).abs());
        tangent::cubic_inverse(self, [4.0 * determinant(x), size], x, v)
    }
}

impl TranslationSplit for Sl2 {}

/// The embedding coordinates are the entries of the matrix.
impl Embedded for Sl2 {
    type Ambient = Vector4<f64>;

    fn coordinates(&self, g: &Self::Element) -> Vector4<f64> {
        Vector4::from_column_slice(g.as_slice())
    }

    fn from_coordinates(&self, y: &Vector4<f64>) -> Self::Element {
        Matrix2::from_column_slice(y.as_slice())
    }

    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> Vector4<f64> {
        self.coordinates(&(g * traceless(v)))
    }
}

/// The written form is the matrix.
impl MatrixNotation for Sl2 {
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            let m: Matrix2<f64> = m.fixed_view::<2, 2>(0, 0).into_owned();
            let determinant = m.determinant();
            if (determinant - 1.0).abs() <= TOLERANCE * (1.0 + m.norm_squared()) {
                return Ok(m);
            }
            let reason = format!("its determinant is {determinant}, not 1");
            Err(Error::Invalid { what: "element of the group", reason })
        })
    }

    fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
        replace(entries, g.as_slice());
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        let diagonal = sparse(2, &[(0, 0, 1.0), (1, 1, -1.0)]);
        vec![sparse(2, &[(0, 1, 1.0)]), sparse(2, &[(1, 0, 1.0)]), diagonal]
    }
}
