//! R^n, the translations.

use crate::Error;
use crate::group::TranslationSplit;
use crate::group::matrices::{Generator, MatrixNotation, Partial, checked, column, replace};
use crate::group::{Coordinates, Embedded, LieGroup};
use nalgebra::allocator::Allocator;
use nalgebra::{DMatrix, DefaultAllocator, Dim, OVector};

/// The group of vectors of `R^n` under addition: `exp` is the identity map, and brackets are 0.
///
/// The dimension is fixed or chosen at run time, for example by `Translations(Const::<3>)` or
/// `Translations(Dyn(3))` with the types of nalgebra.
///
/// ```
/// use affinor::group::{LieGroup, Translations};
/// use nalgebra::{Const, Dyn, Vector2, dvector};
/// let (x, plane) = (Vector2::new(3.0, 4.0), Translations(Const::<2>));
/// assert_eq!(plane.compose(&plane.exp(&x), &x), x * 2.0);
/// assert_eq!(Translations(Dyn(1)).inverse(&dvector![5.0]), dvector![-5.0]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Translations<D>(
    /// The dimension.
    pub D,
);

impl<D: Dim> LieGroup for Translations<D>
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

    fn bracket(&self, _: &Self::Vector, _: &Self::Vector) -> Self::Vector {
        Coordinates::zeros(self.dimension())
    }

    /// The homogeneous matrix, of size `n + 1`.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        let n = self.dimension();
        let mut matrix = DMatrix::identity(n + 1, n + 1);
        (0..n).for_each(|i| matrix[(i, n)] = g[i]);
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

impl<D: Dim> TranslationSplit for Translations<D>
where
    DefaultAllocator: Allocator<D>,
    OVector<f64, D>: Coordinates,
{
    fn has_bounded_adjoint(&self) -> bool {
        true
    }
}

/// The embedding coordinates are the components of the vector.
impl<D: Dim> Embedded for Translations<D>
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

    fn rate(&self, _: &Self::Element, v: &Self::Vector) -> OVector<f64, D> {
        v.clone()
    }
}

/// The written form is a column of coordinates.
impl<D: Dim> MatrixNotation for Translations<D>
where
    DefaultAllocator: Allocator<D>,
    OVector<f64, D>: Coordinates,
{
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
        let mut slopes: OVector<f64, D> = Coordinates::zeros(self.dimension());
        partial.iter().for_each(|(row, _, share)| slopes[*row] += share);
        slopes
    }

    /// Returns 0, because the coordinates change linearly.
    fn second_derivative(
        &self,
        _: &Self::Element,
        _: &[f64],
        _: &[Generator],
        _: &[Partial],
        _: &Self::Vector,
    ) -> f64 {
        0.0
    }
}
