//! The translations and dilations of R^n.

use crate::Error;
use crate::group::TranslationSplit;
use crate::group::matrices::{MatrixNotation, checked, sparse};
use crate::group::{Coordinates, Embedded, LieGroup};
use nalgebra::allocator::Allocator;
use nalgebra::{Const, DMatrix, DefaultAllocator, Dim, Dyn, OVector};

/// The group of translations and dilations of `R^n`, `p -> a p + b` with `a > 0`. Its dimension is
/// `N = n + 1`.
///
/// Elements are lists `(a, b_1, ..., b_n)`. Vectors are lists `(w, u_1, ..., u_n)` of the dilation
/// and the translation. The basis is the basis of `hom(n)` in the catalogue: `[d, p_i] = p_i`. With
/// any left-invariant metric, the group is a hyperbolic space.
///
/// ```
/// use affinor::group::{Homotheties, LieGroup};
/// use nalgebra::{Const, Vector3};
/// // x -> 2 x of the plane, then (from the right) the translation by (1, 0)
/// let group = Homotheties::<Const<3>>::new();
/// let g = group.compose(&Vector3::new(2.0, 0.0, 0.0), &Vector3::new(1.0, 1.0, 0.0));
/// assert_eq!(g, Vector3::new(2.0, 2.0, 0.0));
/// assert!((group.log(&g)? - Vector3::new(1.0, 2.0, 0.0) * 2f64.ln()).norm() < 1e-15);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Homotheties<D>(D);

impl<const N: usize> Homotheties<Const<N>> {
    /// The group with a dimension that is fixed at compile time. The dimension is one more than the
    /// dimension of the space. If `N` is below 2, the code does not compile.
    pub const fn new() -> Self {
        const { assert!(N >= 2, "a group of homotheties has a dimension of at least 2") };
        Homotheties(Const)
    }
}

impl<const N: usize> Default for Homotheties<Const<N>> {
    fn default() -> Self {
        Self::new()
    }
}

impl Homotheties<Dyn> {
    /// The group of `R^n`, where `n` is chosen at run time.
    pub fn of_space(n: usize) -> Self {
        Homotheties(Dyn(n + 1))
    }
}

impl<D: Dim> Homotheties<D>
where
    DefaultAllocator: Allocator<D>,
    OVector<f64, D>: Coordinates,
{
    /// The list `(first, rest(1), rest(2), ...)`.
    fn join(&self, first: f64, rest: impl Fn(usize) -> f64) -> OVector<f64, D> {
        Coordinates::from_fn(self.dimension(), |i| if i == 0 { first } else { rest(i) })
    }
}

/// Checks that the factor of a dilation is positive.
fn expect_positive(what: &'static str, factor: f64) -> Result<(), Error> {
    // the comparison `>` also rejects NaN
    let positive = factor > 0.0;
    if positive {
        return Ok(());
    }
    let reason = format!("the factor {factor} of the dilation is not positive");
    Err(Error::Invalid { what, reason })
}

/// The function `(e^w - 1)/w`.
fn phi1(w: f64) -> f64 {
    if w == 0.0 { 1.0 } else { w.exp_m1() / w }
}

/// The function `(e^w - 1 - w)/w^2`.
fn phi2(w: f64) -> f64 {
    if w.abs() < 1.0 {
        // the series avoids cancellation in the difference
        return 0.5 * (3..20).rev().fold(1.0, |rest, k| 1.0 + rest * w / f64::from(k));
    }
    (w.exp_m1() - w) / w / w
}

impl<D: Dim> LieGroup for Homotheties<D>
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
        self.join(1.0, |_| 0.0)
    }

    /// Returns `(a, b)(a', b') = (a a', b + a b')`.
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        self.join(g[0] * h[0], |i| g[i] + g[0] * h[i])
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        self.join(g[0].recip(), |i| -g[i] / g[0])
    }

    /// Returns `(e^w, (e^w - 1)/w u)`.
    fn exp(&self, x: &Self::Vector) -> Self::Element {
        let factor = phi1(x[0]);
        self.join(x[0].exp(), |i| factor * x[i])
    }

    /// Returns the logarithm, which exists for every element.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error> {
        expect_positive("logarithm", g[0])?;
        let w = g[0].ln();
        let factor = phi1(w);
        Ok(self.join(w, |i| g[i] / factor))
    }

    /// Returns `(w, a u - w b)`.
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        self.join(x[0], |i| g[0] * x[i] - x[0] * g[i])
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        self.join(0.0, |i| x[0] * y[i] - y[0] * x[i])
    }

    /// Returns `[[a, b], [0, 1]]`, of size `n + 1`.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64> {
        let n = self.dimension() - 1;
        let mut matrix = DMatrix::identity(n + 1, n + 1);
        for i in 0..n {
            matrix[(i, i)] = g[0];
            matrix[(i, n)] = g[i + 1];
        }
        matrix
    }

    /// Computes the product in closed form, which is accurate for short vectors.
    fn log_product(&self, x: &Self::Vector, y: &Self::Vector) -> Result<Self::Vector, Error> {
        let w = x[0] + y[0];
        let (first, second) = (phi1(x[0]), x[0].exp() * phi1(y[0]));
        Ok(self.join(w, |i| (first * x[i] + second * y[i]) / phi1(w)))
    }

    /// Computes the operator in closed form, because `ad_x^2 = w ad_x`.
    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        let (along, across) = (phi1(-x[0]), phi2(-x[0]) * v[0]);
        self.join(v[0], |i| along * v[i] + across * x[i])
    }

    /// Computes the operator in closed form; `exp` is regular everywhere.
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        let (along, across) = (phi1(-x[0]), phi2(-x[0]) * v[0]);
        Ok(self.join(v[0], |i| (v[i] - across * x[i]) / along))
    }
}

impl<D: Dim> TranslationSplit for Homotheties<D>
where
    DefaultAllocator: Allocator<D>,
    OVector<f64, D>: Coordinates,
{
    fn translational_part(&self, x: &Self::Vector) -> Option<Self::Vector> {
        Some(self.join(0.0, |i| x[i]))
    }

    fn translational_momentum(&self, h: &Self::Vector) -> Option<Self::Vector> {
        Some(self.join(0.0, |i| h[i]))
    }

    fn linear_part(&self, g: &Self::Element) -> Self::Element {
        self.join(g[0], |_| 0.0)
    }
}

/// The embedding coordinates are the list `(a, b)`.
impl<D: Dim> Embedded for Homotheties<D>
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
        v * g[0]
    }

    fn is_translation_coordinate(&self, at: usize) -> bool {
        at > 0
    }
}

/// The written form is the homogeneous matrix of size `n + 1`.
impl<D: Dim> MatrixNotation for Homotheties<D>
where
    DefaultAllocator: Allocator<D>,
    OVector<f64, D>: Coordinates,
{
    fn read(&self, matrix: &DMatrix<f64>) -> Result<Self::Element, Error> {
        checked(self, matrix, |m| {
            expect_positive("element of the group", m[(0, 0)])?;
            Ok(self.join(m[(0, 0)], |i| m[(i - 1, self.dimension() - 1)]))
        })
    }

    fn generators(&self) -> Vec<DMatrix<f64>> {
        let n = self.dimension() - 1;
        let dilation: Vec<_> = (0..n).map(|i| (i, i, 1.0)).collect();
        let translations = (0..n).map(|i| sparse(n + 1, &[(i, n, 1.0)]));
        [sparse(n + 1, &dilation)].into_iter().chain(translations).collect()
    }
}
