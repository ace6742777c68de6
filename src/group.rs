//! Lie groups in floats: exponential, logarithm, translations and tangent operators.
//!
//! A group implements [`LieGroup`]. In closed form there are [`So2`], [`So3`], [`Se2`], [`Se3`],
//! [`Se23`], [`Sl2`] and [`Heisenberg`]; any nilpotent algebra has its [`Nilpotent`] group, any
//! algebra of matrices its [`MatrixGroup`]; [`Product`] makes one of two, as of [`So3`] and [`Translations`].
//! [`Opposite`] makes right-invariant systems left-invariant ones.
//!
//! Vectors are components in the basis of the algebra, tangent vectors at `g` components in its
//! left-invariant frame, so that `g x` for a matrix group is the left translate of `x`.

pub mod batch;
pub mod coordinates;
mod cubic;
pub mod fields;
pub mod heisenberg;
mod left_frame;
mod logarithm;
pub mod matrix_group;
mod membership;
pub mod nilpotent;
pub mod opposite;
mod polynomial;
pub mod product;
pub mod rotation;
mod screws;
pub mod se2;
pub mod se23;
pub mod se3;
pub mod series;
pub mod sl2;
pub mod so2;
pub mod so3;
mod splitting;
mod stored;
pub mod stumpff;
pub mod translations;
pub mod velocity;

pub use coordinates::Coordinates;
pub use heisenberg::Heisenberg;
pub(crate) use left_frame::expect_left_frame;
pub(crate) use logarithm::logarithm;
pub use matrix_group::MatrixGroup;
pub use nilpotent::Nilpotent;
pub use opposite::Opposite;
pub use product::Product;
pub use se2::Se2;
pub use se3::Se3;
pub use se23::{ExtendedPose, Se23};
pub use sl2::Sl2;
pub use so2::So2;
pub use so3::So3;
pub use stored::Stored;
pub use translations::Translations;
pub use velocity::Velocity;

use crate::{Bracket, Error, LieAlgebra};
use nalgebra::DMatrix;
use std::fmt::Debug;

/// A Lie group with its algebra, in floats.
///
/// ```text
/// T_left(x)  = sum (-ad_x)^k/(k+1)!     exp(x + dx) = exp(x) exp(T_left(x) dx + ..)
/// T_right(x) = sum ad_x^k/(k+1)!        exp(x + dx) = exp(T_right(x) dx + ..) exp(x)
/// ```
///
/// Nine methods make a group; the tangent operators come by their series where no closed form is
/// given. Equations (17)-(27) and, for the map `Phi = exp`, (77)-(86) of the paper.
///
/// ```
/// use affinor::group::{Coordinates, LieGroup, So3};
/// use nalgebra::Vector3;
/// // a quarter turn about z, then one about x (body axes: factors are added on the right)
/// let quarter = std::f64::consts::FRAC_PI_2;
/// let g = So3.compose(
///     &So3.exp(&Vector3::new(0.0, 0.0, quarter)),
///     &So3.exp(&Vector3::new(quarter, 0.0, 0.0)),
/// );
/// let x = So3.log(&g)?; // a third of a turn about (1, 1, 1)
/// assert!((x - Vector3::repeat(x[0])).norm() < 1e-15);
/// assert!((x.norm() - std::f64::consts::TAU / 3.0).abs() < 1e-15);
/// # Ok::<(), affinor::Error>(())
/// ```
pub trait LieGroup {
    /// What an element is stored as.
    type Element: Clone + Debug;
    /// Components in the basis of the algebra.
    type Vector: Coordinates;

    /// The dimension of the algebra.
    fn dimension(&self) -> usize;
    /// The neutral element.
    fn identity(&self) -> Self::Element;
    /// `g h`: the left translate (17) of `h`, and the right translate (18) of `g`.
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element;
    /// `g^-1`.
    fn inverse(&self, g: &Self::Element) -> Self::Element;
    /// The exponential (26), the one-parameter group of `x` at time 1.
    fn exp(&self, x: &Self::Vector) -> Self::Element;
    /// A logarithm: `exp(log(g)) = g`, near the identity the one near 0.
    ///
    /// # Errors
    /// [`Error::NoLogarithm`] for an element without one, or outside of what the group can do.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error>;
    /// `Ad_g x`, for matrices `g x g^-1`.
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector;
    /// `[x, y] = ad_x y`, for matrices the commutator (28).
    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector;
    /// The element as a matrix.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64>;

    /// `T_left(x) v`: left components of the derivative of exp at `x` along `v`.
    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        series::tangent_left(self, x, v)
    }

    /// `T_left(x)^-1 v`.
    ///
    /// # Errors
    /// [`Error::SingularTangent`] where `exp` is no local chart: an eigenvalue of `ad_x` is
    /// `2 pi i k`, `k != 0`, to the rounding of `x`. Near it the result is large.
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        series::tangent_left_inverse(self, x, v)
    }

    /// `T_right(x) v = T_left(-x) v = Ad_exp(x) T_left(x) v`.
    fn tangent_right(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        self.tangent_left(&-x.clone(), v)
    }

    /// `T_right(x)^-1 v`.
    ///
    /// # Errors
    /// As [`LieGroup::tangent_left_inverse`].
    fn tangent_right_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        self.tangent_left_inverse(&-x.clone(), v)
    }

    /// `Ad*_g h`, the covector with `(Ad*_g h)_i = h_j (Ad_g e_i)^j`: spatial to body momentum.
    fn coadjoint(&self, g: &Self::Element, h: &Self::Vector) -> Self::Vector {
        Self::Vector::from_fn(self.dimension(), |i| {
            let image = self.adjoint(g, &self.unit(i));
            h.components().iter().zip(image.components()).map(|(h, x)| h * x).sum()
        })
    }

    /// `Ad*_exp(x) h`, for which some groups need no element.
    fn coadjoint_exp(&self, x: &Self::Vector, h: &Self::Vector) -> Self::Vector {
        self.coadjoint(&self.exp(x), h)
    }

    /// The element that is meant by one which the roundings of many products took off the group, such as a
    /// quaternion of length 1 again. Groups whose elements are free coordinates have nothing to do.
    fn restored(&self, g: Self::Element) -> Self::Element {
        g
    }

    /// The translations `P x` in a vector: its part in an abelian ideal `V`, along a subalgebra `K` with `g = K + V`.
    /// `None` where no such ideal is singled out.
    ///
    /// On SE(3) `P(w, u) = (0, u)`. Integrators treat `V` linearly, so that neither the place of the origin nor a
    /// uniform motion of the frame enters the momentum about the body.
    fn translation(&self, x: &Self::Vector) -> Option<Self::Vector> {
        let _ = x;
        None
    }

    /// The factor `k` of `g = exp(y) k`, with `y` in the ideal of [`translation`](Self::translation) and `k` in the
    /// group of `K`: on SE(3) the rotation. The element itself where there are no translations.
    fn turn(&self, g: &Self::Element) -> Self::Element {
        g.clone()
    }

    /// Whether `Ad_k` is bounded for every [`turn`](Self::turn) `k`, as for rotations. Where it grows without bound, a
    /// momentum in axes that do not turn has lost digits when it is carried back to the body.
    fn has_bounded_turns(&self) -> bool {
        false
    }

    /// The basis vector of an index, from 0.
    fn unit(&self, at: usize) -> Self::Vector {
        Self::Vector::from_fn(self.dimension(), |i| f64::from(i == at))
    }

    /// The basis of the algebra, in components.
    fn basis(&self) -> Vec<Self::Vector> {
        (0..self.dimension()).map(|a| self.unit(a)).collect()
    }

    /// The algebra, with the basis `e1`, `e2`, ... of the components unless the group has names for it.
    ///
    /// # Errors
    /// [`Error::Jacobi`] for a `bracket` that is none.
    fn algebra(&self) -> Result<LieAlgebra<f64>, Error> {
        let basis = self.basis();
        let labels: Vec<String> = (1..=basis.len()).map(|i| format!("e{i}")).collect();
        let labels: Vec<&str> = labels.iter().map(String::as_str).collect();
        let bracket = Bracket::from_fn(&labels, |j, k| {
            let bracket = self.bracket(&basis[j], &basis[k]);
            bracket.components().iter().copied().enumerate().collect()
        })?;
        LieAlgebra::try_from(bracket)
    }

    /// The matrix of a linear map of the algebra, such as `|v| group.tangent_left(&x, v)`: the
    /// upper index is the row.
    fn operator(&self, map: impl Fn(&Self::Vector) -> Self::Vector) -> DMatrix<f64> {
        let columns: Vec<_> = self.basis().iter().map(map).collect();
        DMatrix::from_fn(self.dimension(), self.dimension(), |i, k| columns[k].components()[i])
    }
}
