//! The opposite of a group. It has the same elements, and multiplies them in reverse order.

use crate::group::{
    Block, Embedded, Generator, LieGroup, MatrixNotation, Partial, TranslationSplit,
};
use crate::{Error, LieAlgebra};
use nalgebra::DMatrix;

/// The group with the elements of `G` and the product `g * h = h g`.
///
/// The left translations of the opposite group are the right translations of `G`. Therefore, its
/// left-invariant systems are the right-invariant systems of `G`:
///
/// ```text
/// [x, y]_opp = -[x, y]   Ad_opp(g) = Ad_(g^-1)   T_left_opp = T_right   g' = g * omega = omega g
/// ```
///
/// The functions `exp`, `log` and `inverse` are the same for both groups, and `g -> g^-1` is an
/// isomorphism between them. [`EulerPoincare`](crate::mechanics::EulerPoincare) on the opposite
/// group uses the spatial velocity `omega = g' g^-1` as its velocity. Its metric is
/// right-invariant, like the metric of an ideal fluid, which is invariant under relabelling. With
/// the connection `plus` and without a torque, the system conserves the body momentum, which it
/// calls `spatial`.
///
/// The matrix of an element is the same as in `G`, so products are reversed:
/// `matrix(g * h) = matrix(h) matrix(g)`.
///
/// ```
/// use affinor::group::{LieGroup, Opposite, So3};
/// use nalgebra::Vector3;
/// let (x, y) = (Vector3::x(), Vector3::y());
/// assert_eq!(Opposite(So3).bracket(&x, &y), -Vector3::z());
/// let (g, h) = (So3.exp(&x), So3.exp(&y));
/// assert_eq!(Opposite(So3).compose(&g, &h), So3.compose(&h, &g));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Opposite<G>(pub G);

impl<G: LieGroup> LieGroup for Opposite<G> {
    type Element = G::Element;
    type Vector = G::Vector;

    fn dimension(&self) -> usize {
        self.0.dimension()
    }

    fn identity(&self) -> Self::Element {
        self.0.identity()
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        self.0.compose(h, g)
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        self.0.inverse(g)
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        self.0.exp(x)
    }

    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        self.0.log(g)
    }

    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        self.0.adjoint(&self.0.inverse(g), x)
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        self.0.bracket(y, x)
    }

    /// The matrix in the original group, which reverses products.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        self.0.matrix(g)
    }

    /// The opposite of the algebra of the original group.
    fn algebra(&self) -> Result<LieAlgebra<f64>, Error> {
        Ok(self.0.algebra()?.opposite())
    }

    fn project(&self, g: Self::Element) -> Self::Element {
        self.0.project(g)
    }

    /// The product in the original group, with the factors exchanged.
    fn log_product(&self, x: &Self::Vector, y: &Self::Vector) -> Result<Self::Vector, Error> {
        self.0.log_product(y, x)
    }

    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        self.0.tangent_right(x, v)
    }

    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        self.0.tangent_right_inverse(x, v)
    }

    fn coadjoint(&self, g: &Self::Element, h: &Self::Vector) -> Self::Vector {
        self.0.coadjoint(&self.0.inverse(g), h)
    }

    fn coadjoint_exp(&self, x: &Self::Vector, h: &Self::Vector) -> Self::Vector {
        self.0.coadjoint_exp(&-x.clone(), h)
    }
}

impl<G: TranslationSplit> TranslationSplit for Opposite<G> {
    fn translational_part(&self, x: &Self::Vector) -> Option<Self::Vector> {
        self.0.translational_part(x)
    }

    fn has_translations(&self) -> bool {
        self.0.has_translations()
    }

    fn translational_momentum(&self, h: &Self::Vector) -> Option<Self::Vector> {
        self.0.translational_momentum(h)
    }

    /// Returns `Ad*_opp(k^-1) h`, which equals `Ad*_k h`.
    fn coadjoint_inverse(&self, k: &Self::Element, h: &Self::Vector) -> Self::Vector {
        self.0.coadjoint(k, h)
    }

    /// The linear part of the element in the original group, because
    /// `exp(y) k = k exp(Ad_(k^-1) y)`.
    fn linear_part(&self, g: &Self::Element) -> Self::Element {
        self.0.linear_part(g)
    }

    fn has_bounded_adjoint(&self) -> bool {
        self.0.has_bounded_adjoint()
    }
}

impl<G: Embedded> Embedded for Opposite<G> {
    type Ambient = G::Ambient;

    fn coordinates(&self, g: &Self::Element) -> Self::Ambient {
        self.0.coordinates(g)
    }

    fn from_coordinates(&self, y: &Self::Ambient) -> Self::Element {
        self.0.from_coordinates(y)
    }

    /// The time derivative `v g` in the original group.
    fn rate(&self, g: &Self::Element, v: &Self::Vector) -> Self::Ambient {
        self.0.rate(g, &self.adjoint(g, v))
    }

    fn rate_at_projected(
        &self,
        point: &Self::Element,
        projected: &Self::Element,
        v: &Self::Vector,
    ) -> Self::Ambient {
        self.0.rate_at_projected(point, projected, &self.adjoint(point, v))
    }

    fn embedding_dimension(&self) -> usize {
        self.0.embedding_dimension()
    }

    fn is_translation_coordinate(&self, at: usize) -> bool {
        self.0.is_translation_coordinate(at)
    }

    fn has_projection(&self) -> bool {
        self.0.has_projection()
    }
}

/// Elements are written as in the original group.
impl<G: MatrixNotation> MatrixNotation for Opposite<G> {
    fn write(&self, g: &Self::Element) -> DMatrix<f64> {
        self.0.write(g)
    }

    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        self.0.read(matrix)
    }

    fn is_angle(&self, at: usize) -> bool {
        self.0.is_angle(at)
    }

    fn names(&self) -> &'static [&'static str] {
        self.0.names()
    }

    fn named(&self, g: &Self::Element, k: usize) -> f64 {
        self.0.named(g, k)
    }

    fn entries(&self, g: &Self::Element, entries: &mut Vec<f64>) {
        self.0.entries(g, entries);
    }

    fn blocks(&self) -> Vec<Block> {
        self.0.blocks()
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        self.0.generators()
    }

    /// The derivatives along `exp(s e_i) g` in the original group. At `g`, the left components of
    /// `e_i` are `Ad_g^-1 e_i`.
    fn derivatives(
        &self,
        g: &Self::Element,
        entries: &[f64],
        generators: &[Generator],
        partial: &[Partial],
    ) -> Self::Vector {
        self.coadjoint(g, &self.0.derivatives(g, entries, generators, partial))
    }

    /// The second derivative along `exp(s v) g = g exp(s Ad_g^-1 v)` in the original group.
    fn second_derivative(
        &self,
        g: &Self::Element,
        entries: &[f64],
        generators: &[Generator],
        partial: &[Partial],
        v: &Self::Vector,
    ) -> f64 {
        let v = self.0.adjoint(&self.0.inverse(g), v);
        self.0.second_derivative(g, entries, generators, partial, &v)
    }

    fn log_rounding(&self, g: &Self::Element, x: &Self::Vector) -> Option<f64> {
        self.0.log_rounding(g, x)
    }
}
