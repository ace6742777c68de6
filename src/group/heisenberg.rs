//! The Heisenberg groups.

use super::{LieGroup, Stored};
use crate::Error;
use nalgebra::{DMatrix, SVector};

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

    /// `x y' - y x'`.
    fn area(x: &SVector<f64, N>, y: &SVector<f64, N>) -> f64 {
        (0..Self::M).map(|a| x[a] * y[a + Self::M] - x[a + Self::M] * y[a]).sum()
    }
}

impl<const N: usize> LieGroup for Heisenberg<N> {
    type Element = SVector<f64, N>;
    type Vector = SVector<f64, N>;

    fn dimension(&self) -> usize {
        N
    }

    fn identity(&self) -> Self::Element {
        SVector::zeros()
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        g + h + self.bracket(g, h) * 0.5
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        -g
    }

    /// The identity map.
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        *x
    }

    /// The identity map.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        Ok(*g)
    }

    /// `x + [g, x]`.
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        x + self.bracket(g, x)
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        let mut z = SVector::zeros();
        z[N - 1] = Self::area(x, y);
        z
    }

    /// `[[1, x, z + x y/2], [0, 1, y], [0, 0, 1]]`, of size `m + 2`.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        let (m, last) = (Self::M, Self::M + 1);
        let mut matrix = DMatrix::identity(m + 2, m + 2);
        matrix[(0, last)] = g[N - 1];
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

/// The coordinates, with the rate `v + [g, v]/2`.
impl<const N: usize> Stored for Heisenberg<N> {
    type Numbers = SVector<f64, N>;

    fn numbers(&self, g: &Self::Element) -> SVector<f64, N> {
        *g
    }

    fn from_numbers(&self, y: &SVector<f64, N>) -> Self::Element {
        *y
    }

    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> SVector<f64, N> {
        v + self.bracket(g, v) * 0.5
    }
}
