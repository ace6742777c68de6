//! The trait of Lie groups.

use super::{Coordinates, mean, tangent};
use crate::{Bracket, Error, LieAlgebra};
use nalgebra::DMatrix;
use std::fmt::Debug;

/// A Lie group with its algebra, in floating point.
///
/// ```text
/// T_left(x)  = sum (-ad_x)^k/(k+1)!     exp(x + dx) = exp(x) exp(T_left(x) dx + ..)
/// T_right(x) = sum ad_x^k/(k+1)!        exp(x + dx) = exp(T_right(x) dx + ..) exp(x)
/// ```
///
/// A group must implement nine methods. The tangent operators are computed from their series unless
/// the group has closed forms. [`laws`](super::laws) checks the implementation. The methods
/// implement equations (17)-(27) of Paraskevopoulos and Natsiavas, and equations (77)-(86) for the
/// map `Phi = exp`.
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
#[doc(alias("Lie group", "exponential map"))]
pub trait LieGroup {
    /// The type of an element.
    type Element: Clone + Debug;
    /// The type of a vector of the algebra, which consists of the components in the basis.
    type Vector: Coordinates;

    /// The dimension of the algebra.
    fn dimension(&self) -> usize;
    /// The neutral element.
    fn identity(&self) -> Self::Element;
    /// The product `g h`, which is the left translate (17) of `h`, and the right translate (18) of
    /// `g`.
    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element;
    /// The inverse `g^-1`.
    fn inverse(&self, g: &Self::Element) -> Self::Element;
    /// The exponential (26), which is the one-parameter group of `x` at time 1.
    fn exp(&self, x: &Self::Vector) -> Self::Element;
    /// A logarithm of `g`, which satisfies `exp(log(g)) = g`. For elements near the identity, it is
    /// the logarithm near 0.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an element without a logarithm, or for an element whose logarithm the
    /// group cannot compute.
    fn log(&self, g: &Self::Element) -> Result<Self::Vector, Error>;
    /// The adjoint action `Ad_g x`, which is `g x g^-1` for matrices.
    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector;
    /// The bracket `[x, y] = ad_x y`, which is the commutator (28) for matrices.
    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector;
    /// The element as a matrix.
    fn matrix(&self, g: &Self::Element) -> DMatrix<f64>;

    /// The tangent operator `T_left(x) v`. The result consists of the left components of the
    /// derivative of exp at `x` along `v`.
    fn tangent_left(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        tangent::by_series(self, x, v)
    }

    /// The inverse operator `T_left(x)^-1 v`.
    ///
    /// # Errors
    /// [`Law::RegularTangent`](crate::Law::RegularTangent) where `exp` is singular, which means
    /// that an eigenvalue of `ad_x` is `2 pi i k`, `k != 0`, up to the rounding error of `x`. Near
    /// such a point, the result is large.
    fn tangent_left_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        tangent::inverse_by_series(self, x, v)
    }

    /// The tangent operator `T_right(x) v = T_left(-x) v = Ad_exp(x) T_left(x) v`.
    fn tangent_right(&self, x: &Self::Vector, v: &Self::Vector) -> Self::Vector {
        self.tangent_left(&-x.clone(), v)
    }

    /// The inverse operator `T_right(x)^-1 v`.
    ///
    /// # Errors
    /// The errors of [`LieGroup::tangent_left_inverse`].
    fn tangent_right_inverse(
        &self,
        x: &Self::Vector,
        v: &Self::Vector,
    ) -> Result<Self::Vector, Error> {
        self.tangent_left_inverse(&-x.clone(), v)
    }

    /// The coadjoint action `Ad*_g h`, the covector with `(Ad*_g h)_i = h_j (Ad_g e_i)^j`. It
    /// converts spatial to body momentum.
    ///
    /// The action is the transpose of `Ad_g` and a right action: `Ad*_(gh) = Ad*_h Ad*_g`. Many
    /// books denote it by `Ad*_(g^-1)`.
    fn coadjoint(&self, g: &Self::Element, h: &Self::Vector) -> Self::Vector {
        Self::Vector::from_fn(self.dimension(), |i| {
            let image = self.adjoint(g, &self.basis_vector(i));
            h.components().iter().zip(image.components()).map(|(h, x)| h * x).sum()
        })
    }

    /// The matrix of the operator `Ad_exp(x) = exp(ad_x)`. The upper index is the row.
    fn adjoint_exp(&self, x: &Self::Vector) -> DMatrix<f64> {
        let g = self.exp(x);
        let columns: Vec<_> = self.basis().iter().map(|v| self.adjoint(&g, v)).collect();
        DMatrix::from_fn(columns.len(), columns.len(), |i, k| columns[k].components()[i])
    }

    /// The product in canonical coordinates, `log(exp(x) exp(y))`, equation (73).
    ///
    /// # Errors
    /// The errors of [`log`](Self::log).
    fn log_product(&self, x: &Self::Vector, y: &Self::Vector) -> Result<Self::Vector, Error> {
        self.log(&self.compose(&self.exp(x), &self.exp(y)))
    }

    /// The coadjoint action `Ad*_exp(x) h`.
    fn coadjoint_exp(&self, x: &Self::Vector, h: &Self::Vector) -> Self::Vector {
        self.coadjoint(&self.exp(x), h)
    }

    /// Projects a drifted element back onto the group; for example, it normalizes a quaternion.
    /// Groups whose elements are unconstrained coordinates return the element unchanged.
    fn project(&self, g: Self::Element) -> Self::Element {
        g
    }

    /// The element `g^-1 h`. The product of `g` and this element is `h`.
    fn between(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        self.compose(&self.inverse(g), h)
    }

    /// Interpolates by `g exp(t log(g^-1 h))`, from `g` at `t = 0` to `h` at `t = 1`, with a
    /// constant body velocity.
    ///
    /// ```
    /// use affinor::group::{LieGroup, Se3};
    /// use nalgebra::Isometry3;
    /// // poses are isometries of nalgebra
    /// let start = Isometry3::translation(1.0, 0.0, 0.0);
    /// let end = Isometry3::rotation([0.0, 0.0, 1.0].into());
    /// let middle = Se3.interpolate(&start, &end, 0.5)?;
    /// assert!((middle.rotation.angle() - 0.5).abs() < 1e-15);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`log`](Self::log).
    fn interpolate(
        &self,
        g: &Self::Element,
        h: &Self::Element,
        t: f64,
    ) -> Result<Self::Element, Error> {
        Ok(self.compose(g, &self.exp(&(self.log(&self.between(g, h))? * t))))
    }

    /// The mean of elements. It is the element `m` with `sum log(m^-1 g_i) = 0` to which an
    /// iteration from the first element converges.
    ///
    /// For rotations, the mean is the Karcher mean, which minimizes the sum of squared distances;
    /// elements should be within a half turn of each other. On other groups, the mean is the group
    /// exponential mean, which commutes with left and right translations. X. Pennec and V. Arsigny,
    /// in *Matrix Information Geometry* (2013) 123-166.
    ///
    /// # Errors
    /// [`Error::Shape`] for an empty list; the errors of [`log`](Self::log); [`Error::Invalid`] if
    /// the iteration does not converge.
    fn mean(&self, elements: &[Self::Element]) -> Result<Self::Element, Error> {
        mean::mean(self, elements)
    }

    /// The left Jacobian of exp at `x`, which is the matrix of
    /// [`tangent_right`](Self::tangent_right): `exp(x + dx) = exp(J dx + ...) exp(x)`. The matrix
    /// has a fixed size if vectors have a fixed size.
    ///
    /// The names left and right refer to the side of the factor `exp(J dx)`, as in J. Sola, J.
    /// Deray and D. Atchuthan, arXiv 1812.01537. The names of the tangent operators refer to the
    /// frame of the result.
    ///
    /// ```
    /// use affinor::group::{LieGroup, So3};
    /// use nalgebra::{Matrix3, Vector3};
    /// let x = Vector3::new(0.3, -0.2, 0.5);
    /// let left: Matrix3<f64> = So3.jacobian_left(&x);
    /// assert!((left - So3.jacobian_right(&x).transpose()).norm() < 1e-15);
    /// ```
    fn jacobian_left(&self, x: &Self::Vector) -> <Self::Vector as Coordinates>::Matrix
    where
        Self: Sized,
    {
        Self::Vector::matrix(self.dimension(), |k| self.tangent_right(x, &self.basis_vector(k)))
    }

    /// The right Jacobian of exp at `x`, which is the matrix of
    /// [`tangent_left`](Self::tangent_left): `exp(x + dx) = exp(x) exp(J dx + ...)`.
    fn jacobian_right(&self, x: &Self::Vector) -> <Self::Vector as Coordinates>::Matrix
    where
        Self: Sized,
    {
        Self::Vector::matrix(self.dimension(), |k| self.tangent_left(x, &self.basis_vector(k)))
    }

    /// The inverse of the left Jacobian, which is the matrix of
    /// [`tangent_right_inverse`](Self::tangent_right_inverse):
    /// `log(exp(dx) exp(x)) = x + J^-1 dx + ...`.
    ///
    /// ```
    /// use affinor::group::{LieGroup, Se3};
    /// use nalgebra::{Matrix6, Vector6};
    /// let x = Vector6::new(0.3, -0.2, 0.5, 1.0, 2.0, 3.0);
    /// let inverse: Matrix6<f64> = Se3.jacobian_left_inverse(&x)?;
    /// assert!((inverse * Se3.jacobian_left(&x) - Matrix6::identity()).norm() < 1e-14);
    /// # Ok::<(), affinor::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`tangent_left_inverse`](Self::tangent_left_inverse).
    fn jacobian_left_inverse(
        &self,
        x: &Self::Vector,
    ) -> Result<<Self::Vector as Coordinates>::Matrix, Error>
    where
        Self: Sized,
    {
        self.jacobian_right_inverse(&-x.clone())
    }

    /// The inverse of the right Jacobian, which is the matrix of
    /// [`tangent_left_inverse`](Self::tangent_left_inverse):
    /// `log(exp(x) exp(dx)) = x + J^-1 dx + ...`.
    ///
    /// # Errors
    /// The errors of [`tangent_left_inverse`](Self::tangent_left_inverse).
    fn jacobian_right_inverse(
        &self,
        x: &Self::Vector,
    ) -> Result<<Self::Vector as Coordinates>::Matrix, Error>
    where
        Self: Sized,
    {
        let columns = (0..self.dimension())
            .map(|k| self.tangent_left_inverse(x, &self.basis_vector(k)))
            .collect::<Result<Vec<_>, Error>>()?;
        Ok(Self::Vector::matrix(columns.len(), |k| columns[k].clone()))
    }

    /// The matrix of `Ad_g`. The upper index is the row. The matrix has a fixed size if vectors
    /// have a fixed size.
    ///
    /// ```
    /// use affinor::group::{LieGroup, Se3};
    /// use nalgebra::{Isometry3, Matrix6};
    /// let g = Isometry3::translation(1.0, 2.0, 3.0);
    /// let adjoint: Matrix6<f64> = Se3.adjoint_matrix(&g);
    /// // a rotation about z through the origin, seen from there
    /// assert_eq!(adjoint.column(2).as_slice(), [0.0, 0.0, 1.0, 2.0, -1.0, 0.0]);
    /// ```
    fn adjoint_matrix(&self, g: &Self::Element) -> <Self::Vector as Coordinates>::Matrix
    where
        Self: Sized,
    {
        Self::Vector::matrix(self.dimension(), |k| self.adjoint(g, &self.basis_vector(k)))
    }

    /// The basis vector at the index `at`, from 0.
    fn basis_vector(&self, at: usize) -> Self::Vector {
        Self::Vector::from_fn(self.dimension(), |i| f64::from(i == at))
    }

    /// The basis vectors of the algebra, as components.
    fn basis(&self) -> Vec<Self::Vector> {
        (0..self.dimension()).map(|a| self.basis_vector(a)).collect()
    }

    /// The algebra. Its basis vectors have the names `e1`, `e2`, ... unless the group defines other
    /// names.
    ///
    /// # Errors
    /// [`Law::Jacobi`](crate::Law::Jacobi) if `bracket` is not a Lie bracket.
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

    /// The matrix of a linear map of the algebra, such as `|v| group.tangent_left(&x, v)`. The
    /// upper index is the row.
    fn operator_matrix(&self, map: impl Fn(&Self::Vector) -> Self::Vector) -> DMatrix<f64>
    where
        Self: Sized,
    {
        let columns: Vec<_> = self.basis().iter().map(map).collect();
        DMatrix::from_fn(self.dimension(), self.dimension(), |i, k| columns[k].components()[i])
    }
}
