//! R^n, the translations.

use super::written::{Generator, Partial, Written, checked, column, replace};
use super::{Coordinates, Embedded, LieGroup};
use crate::Error;
use nalgebra::{DMatrix, DVector, SVector};

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

impl<const N: usize> Translations<N> {
    fn size(&self) -> usize {
        N
    }
}

/// R^n for a dimension that is known at run time.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfDimension(pub usize);

impl OfDimension {
    fn size(&self) -> usize {
        self.0
    }
}

/// The group for vectors of a type.
macro_rules! translations {
    ([$($parameters:tt)*] $Group:ty, $Vector:ty) => {
        impl $($parameters)* LieGroup for $Group {
            type Element = $Vector;
            type Vector = $Vector;

            fn dimension(&self) -> usize {
                self.size()
            }

            fn identity(&self) -> Self::Element {
                Coordinates::zeros(self.size())
            }

            fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
                g + h
            }

            fn inverse(&self, g: &Self::Element) -> Self::Element {
                -g
            }

            fn exp(&self, x: &Self::Vector) -> Self::Element {
                x.clone()
            }

            fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
                Ok(g.clone())
            }

            fn adjoint(&self, _: &Self::Element, x: &Self::Vector) -> Self::Vector {
                x.clone()
            }

            fn has_bounded_turns(&self) -> bool {
                true
            }

            fn bracket(&self, _: &Self::Vector, _: &Self::Vector) -> Self::Vector {
                Coordinates::zeros(self.size())
            }

            /// The homogeneous matrix, of size `n + 1`.
            fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
                let n = self.size();
                let mut matrix = DMatrix::identity(n + 1, n + 1);
                matrix.view_mut((0, n), (n, 1)).copy_from(g);
                matrix
            }

            fn tangent_left(&self, _: &Self::Vector, v: &Self::Vector) -> Self::Vector {
                v.clone()
            }

            fn tangent_left_inverse(
                &self,
                _: &Self::Vector,
                v: &Self::Vector,
            ) -> Result<Self::Vector, Error> {
                Ok(v.clone())
            }
        }

        /// The coordinates.
        impl $($parameters)* Embedded for $Group {
            type Numbers = $Vector;

            fn numbers(&self, g: &Self::Element) -> $Vector {
                g.clone()
            }

            fn from_numbers(&self, y: &$Vector) -> Self::Element {
                y.clone()
            }

            fn rate(&self, _: &Self::Element, v: &Self::Vector) -> $Vector {
                v.clone()
            }
        }

        /// A column of coordinates.
        impl $($parameters)* Written for $Group {
            fn write(&self, g: &Self::Element) -> DMatrix<f64> {
                column(g)
            }

            fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
                checked(self, matrix, |m| Ok(Coordinates::from_components(m.as_slice())))
            }

            fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
                replace(entries, g.as_slice());
            }

            fn generators(&self) -> Vec<DMatrix<f64>> {
                self.basis().iter().map(column).collect()
            }

            fn derivatives(
                &self,
                _: &Self::Element,
                _: &[f64],
                _: &[Generator],
                partial: &[Partial],
            ) -> Self::Vector {
                let mut slopes: $Vector = Coordinates::zeros(self.size());
                partial.iter().for_each(|(row, _, share)| slopes[*row] += share);
                slopes
            }
        }
    };
}

translations!([<const N: usize>] Translations<N>, SVector<f64, N>);
translations!([] OfDimension, DVector<f64>);
