//! SO(2), the rotations of a plane, as complex numbers of modulus 1.

use crate::Error;
use crate::group::TranslationSplit;
use crate::group::matrices::{MatrixNotation, checked, replace, sparse};
use crate::group::{Embedded, LieGroup};
use nalgebra::{Complex, DMatrix, UnitComplex, Vector1, Vector2};

/// The group of rotations of a plane, counterclockwise. Vectors are angles in radians.
///
/// ```
/// use affinor::group::{LieGroup, So2};
/// use nalgebra::Vector1;
/// let quarter = So2.exp(&Vector1::new(std::f64::consts::FRAC_PI_2));
/// let half = So2.compose(&quarter, &quarter);
/// assert!((So2.log(&half)?[0].abs() - std::f64::consts::PI).abs() < 1e-15);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct So2;

impl LieGroup for So2 {
    type Element = UnitComplex<f64>;
    type Vector = Vector1<f64>;

    fn dimension(&self) -> usize {
        1
    }

    fn identity(&self) -> Self::Element {
        UnitComplex::identity()
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        g * h
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        g.inverse()
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        UnitComplex::new(x[0])
    }

    /// The angle between `-pi` and `pi`. For the half turn, the result is either `-pi` or `pi`.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        Ok(Vector1::new(g.angle()))
    }

    fn adjoint(&self, _: &Self::Element, x: &Self::Vector) -> Self::Vector {
        *x
    }

    fn project(&self, g: Self::Element) -> Self::Element {
        UnitComplex::new_normalize(g.into_inner())
    }

    fn bracket(&self, _: &Self::Vector, _: &Self::Vector) -> Self::Vector {
        Vector1::zeros()
    }

    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        DMatrix::from_column_slice(2, 2, g.to_rotation_matrix().matrix().as_slice())
    }

    fn tangent_left(&self, _: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        *v
    }

    fn tangent_left_inverse(
        &self,
        _: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        Ok(*v)
    }
}

impl TranslationSplit for So2 {
    fn has_bounded_adjoint(&self) -> bool {
        true
    }
}

/// The embedding coordinates are the cosine and the sine of the angle.
impl Embedded for So2 {
    type Ambient = Vector2<f64>;

    fn coordinates(&self, g: &Self::Element) -> Vector2<f64> {
        Vector2::new(g.re, g.im)
    }

    fn from_coordinates(&self, y: &Vector2<f64>) -> Self::Element {
        UnitComplex::new_unchecked(Complex::new(y.x, y.y))
    }

    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> Vector2<f64> {
        Vector2::new(-g.im, g.re) * v[0]
    }
}

/// The written form is the rotation matrix. The angle is a named coordinate.
impl MatrixNotation for So2 {
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| Ok(nearest_turn(m)))
    }

    fn is_angle(&self, _: usize) -> bool {
        true
    }

    fn names(&self) -> &'static [&'static str] {
        &["angle"]
    }

    fn named(&self, g: &Self::Element, _: usize) -> f64 {
        g.angle()
    }

    fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
        replace(entries, g.to_rotation_matrix().matrix().as_slice());
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        vec![sparse(2, &[(1, 0, 1.0), (0, 1, -1.0)])]
    }
}

/// The rotation of the plane that is nearest to the upper left block of a matrix.
pub(super) fn nearest_turn(m: &DMatrix<f64>) -> UnitComplex<f64> {
    UnitComplex::new((m[(1, 0)] - m[(0, 1)]).atan2(m[(0, 0)] + m[(1, 1)]))
}
