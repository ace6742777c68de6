//! The Heisenberg groups.

use crate::Error;
use crate::group::TranslationSplit;
use crate::group::matrices::{MatrixNotation, checked, sparse};
use crate::group::{Coordinates, Embedded, LieGroup};
use nalgebra::allocator::Allocator;
use nalgebra::{Const, DMatrix, DefaultAllocator, Dim, Dyn, OVector};

/// The Heisenberg group of dimension `n = 2m + 1`, in canonical coordinates
/// `x_1 ... x_m, y_1 ... y_m, z`. In these coordinates, `exp` and `log` are the identity map, and
/// the product is `(x, y, z)(x', y', z') = (x + x', y + y', z + z' + (x y' - y x')/2)`.
///
/// The basis is the basis of `heisenberg(2m+1)` in the catalogue: `[x_a, y_a] = z`.
///
/// ```
/// use affinor::group::{Heisenberg, LieGroup};
/// use nalgebra::{Const, Vector3};
/// let (x, y) = (Vector3::x(), Vector3::y());
/// assert_eq!(Heisenberg::<Const<3>>::new().compose(&x, &y), Vector3::new(1.0, 1.0, 0.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Heisenberg<D>(D);

impl<const N: usize> Heisenberg<Const<N>> {
    /// The group with a dimension that is fixed at compile time. If `N` is even or below 3, the
    /// code does not compile.
    pub const fn new() -> Self {
        const { assert!(N >= 3 && N % 2 == 1, "a Heisenberg group has an odd dimension of at least 3") };
        Heisenberg(Const)
    }
}

impl<const N: usize> Default for Heisenberg<Const<N>> {
    fn default() -> Self {
        Self::new()
    }
}

impl Heisenberg<Dyn> {
    /// The group with `m` pairs of coordinates `x`, `y`; `m` is chosen at run time.
    pub fn of_pairs(m: usize) -> Self {
        Heisenberg(Dyn(2 * m + 1))
    }
}

impl<D: Dim> Heisenberg<D> {
    /// The number `m` of pairs of coordinates.
    fn pairs(&self) -> usize {
        self.0.value() / 2
    }
}

impl<D: Dim> LieGroup for Heisenberg<D>
where
    DefaultAllocator: Allocator<D>,
    OVector<f64, D>: Coordinates,
{
    type Element = OVector<f64, D>;
    type Vector = OVector<f64, D>;

    fn dimension(&self) -> usize {
        self.0.value()
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

    /// Returns `x + [g, x]`.
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        x + self.bracket(g, x)
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        let m = self.pairs();
        let area = || (0..m).map(|a| x[a] * y[a + m] - x[a + m] * y[a]).sum();
        Coordinates::from_fn(2 * m + 1, |i| if i == 2 * m { area() } else { 0.0 })
    }

    /// Returns `[[1, x, z + x y/2], [0, 1, y], [0, 0, 1]]`, of size `m + 2`.
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

    /// Returns `v - [x, v]/2`.
    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        v - self.bracket(x, v) * 0.5
    }

    /// Returns `v + [x, v]/2`.
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        Ok(v + self.bracket(x, v) * 0.5)
    }
}

impl<D: Dim> TranslationSplit for Heisenberg<D>
where
    DefaultAllocator: Allocator<D>,
    OVector<f64, D>: Coordinates,
{
}

/// The embedding coordinates are the canonical coordinates. Their time derivative is
/// `v + [g, v]/2`.
impl<D: Dim> Embedded for Heisenberg<D>
where
    DefaultAllocator: Allocator<D>,
    OVector<f64, D>: Coordinates,
{
    type Ambient = OVector<f64, D>;

    fn coordinates(&self, g: &Self::Element) -> OVector<f64, D> {
        g.clone()
    }

    fn from_coordinates(&self, y: &OVector<f64, D>) -> Self::Element {
        y.clone()
    }

    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> OVector<f64, D> {
        v + self.bracket(g, v) * 0.5
    }
}

/// The written form is the upper triangular matrix.
impl<D: Dim> MatrixNotation for Heisenberg<D>
where
    DefaultAllocator: Allocator<D>,
    OVector<f64, D>: Coordinates,
{
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
