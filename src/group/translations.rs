//! R^n, the translations.

use super::LieGroup;
use crate::Error;
use nalgebra::{DMatrix, SVector};

/// The vectors of `R^N` under addition: `exp` is the identity map, brackets are 0.
///
/// ```
/// use affinor::group::{LieGroup, Translations};
/// use nalgebra::Vector2;
/// let x = Vector2::new(3.0, 4.0);
/// assert_eq!(Translations::<2>.compose(&Translations::<2>.exp(&x), &x), x * 2.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Translations<const N: usize>;

impl<const N: usize> LieGroup for Translations<N> {
    type Element = SVector<f64, N>;
    type Vector = SVector<f64, N>;

    fn dimension(&self) -> usize {
        N
    }

    fn identity(&self) -> Self::Element {
        SVector::zeros()
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        g + h
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        -g
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        *x
    }

    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        Ok(*g)
    }

    fn adjoint(&self, _: &Self::Element, x: &Self::Vector) -> Self::Vector {
        *x
    }

    fn has_bounded_turns(&self) -> bool {
        true
    }

    fn bracket(&self, _: &Self::Vector, _: &Self::Vector) -> Self::Vector {
        SVector::zeros()
    }

    /// Of size `N + 1`, homogeneous.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        let mut matrix = DMatrix::identity(N + 1, N + 1);
        matrix.view_mut((0, N), (N, 1)).copy_from(g);
        matrix
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
