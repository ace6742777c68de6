//! The Heisenberg groups.

use super::written::{Written, checked, sparse};
use super::{Coordinates, Embedded, LieGroup};
use crate::Error;
use nalgebra::{DMatrix, DVector, SVector};

/// The Heisenberg group of dimension `N = 2m + 1`, in canonical coordinates `x_1 .. x_m, y_1 .. y_m, z`:
/// `exp` and `log` are the identity map, and the product is
/// `(x, y, z)(x', y', z') = (x + x', y + y', z + z' + (x y' - y x')/2)`.
///
/// The basis is that of the catalogue's `heisenberg(2m+1)`: `[x_a, y_a] = z`. An `N` that is even or
/// below 3 does not compile.
///
/// ```
/// use affinor::group::{Heisenberg, LieGroup};
/// use nalgebra::Vector3;
/// let (x, y) = (Vector3::x(), Vector3::y());
/// assert_eq!(Heisenberg::<3>.compose(&x, &y), Vector3::new(1.0, 1.0, 0.5));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Heisenberg<const N: usize>;

impl<const N: usize> Heisenberg<N> {
    /// The number of pairs.
    const M: usize = {
        assert!(N >= 3 && N % 2 == 1, "a Heisenberg group has an odd dimension of at least 3");
        N / 2
    };

    fn pairs(&self) -> usize {
        Self::M
    }
}

/// The Heisenberg group of `m` pairs, where `m` is known at run time.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfPairs(pub usize);

impl OfPairs {
    fn pairs(&self) -> usize {
        self.0
    }
}

/// The group for vectors of a type.
macro_rules! heisenberg {
    ([$($parameters:tt)*] $Group:ty, $Vector:ty) => {
        impl $($parameters)* LieGroup for $Group {
            type Element = $Vector;
            type Vector = $Vector;

            fn dimension(&self) -> usize {
                2 * self.pairs() + 1
            }

            fn identity(&self) -> Self::Element {
                Coordinates::zeros(self.dimension())
            }

            fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
                g + h + self.bracket(g, h) * 0.5
            }

            fn inverse(&self, g: &Self::Element) -> Self::Element {
                -g
            }

            /// The identity map.
            fn exp(&self, x: &Self::Vector) -> Self::Element {
                x.clone()
            }

            /// The identity map.
            fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
                Ok(g.clone())
            }

            /// `x + [g, x]`.
            fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
                x + self.bracket(g, x)
            }

            fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
                let m = self.pairs();
                let area = || (0..m).map(|a| x[a] * y[a + m] - x[a + m] * y[a]).sum();
                Coordinates::from_fn(2 * m + 1, |i| if i == 2 * m { area() } else { 0.0 })
            }

            /// `[[1, x, z + x y/2], [0, 1, y], [0, 0, 1]]`, of size `m + 2`.
            fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
                let (m, last) = (self.pairs(), self.pairs() + 1);
                let mut matrix = DMatrix::identity(m + 2, m + 2);
                matrix[(0, last)] = g[2 * m];
                for a in 0..m {
                    matrix[(0, a + 1)] = g[a];
                    matrix[(a + 1, last)] = g[a + m];
                    matrix[(0, last)] += 0.5 * g[a] * g[a + m];
                }
                matrix
            }

            /// `v - [x, v]/2`.
            fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
                v - self.bracket(x, v) * 0.5
            }

            /// `v + [x, v]/2`.
            fn tangent_left_inverse(
                &self,
                x: &Self::Vector,
                v: &Self::Vector,
            ) -> Result<Self::Vector, Error> {
                Ok(v + self.bracket(x, v) * 0.5)
            }
        }

        /// The canonical coordinates, with the rate `v + [g, v]/2`.
        impl $($parameters)* Embedded for $Group {
            type Numbers = $Vector;

            fn numbers(&self, g: &Self::Element) -> $Vector {
                g.clone()
            }

            fn from_numbers(&self, y: &$Vector) -> Self::Element {
                y.clone()
            }

            fn rate(&self, g: &Self::Element, v: &Self::Vector) -> $Vector {
                v + self.bracket(g, v) * 0.5
            }
        }

        /// The upper triangular matrix.
        impl $($parameters)* Written for $Group {
            fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
                checked(self, matrix, |matrix| {
                    let (m, last) = (self.pairs(), self.pairs() + 1);
                    let half = |a: usize| 0.5 * matrix[(0, a + 1)] * matrix[(a + 1, last)];
                    let z = matrix[(0, last)] - (0..m).map(half).sum::<f64>();
                    Ok(Coordinates::from_fn(2 * m + 1, |i| match i {
                        _ if i < m => matrix[(0, i + 1)],
                        _ if i < 2 * m => matrix[(i - m + 1, last)],
                        _ => z,
                    }))
                })
            }

            fn generators(&self) -> Vec<DMatrix<f64>> {
                let (m, last) = (self.pairs(), self.pairs() + 1);
                let places = (1..last).map(|a| (0, a)).chain((1..last).map(|a| (a, last)));
                let places = places.chain([(0, last)]);
                places.map(|(row, column)| sparse(m + 2, &[(row, column, 1.0)])).collect()
            }
        }
    };
}

heisenberg!([<const N: usize>] Heisenberg<N>, SVector<f64, N>);
heisenberg!([] OfPairs, DVector<f64>);
