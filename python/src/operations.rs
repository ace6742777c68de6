//! The methods of groups on arrays of rows.

use crate::arrays::{self, Input};
use crate::class::in_python;
use crate::group::{Action, Array, PyGroup, Row};
use crate::rows::Operation;
use affinor::group::batch::rotations::JacobianKind;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Defines methods that apply an operation to rows: the arguments with their kinds, and the kind of the result.
macro_rules! operations {
    ($(
        $(#[doc = $doc:literal])*
        $name:ident($a:ident: $A:ident $(, $b:ident: $B:ident)?) -> $result:ident = $operation:expr;
    )*) => {
        #[pymethods]
        #[allow(clippy::wrong_self_convention, reason = "a group reads and writes its elements")]
        impl PyGroup {
            $(
                $(#[doc = $doc])*
                pub fn $name<'py>(
                    &self,
                    py: Python<'py>,
                    $a: Input<'py>,
                    $($b: Input<'py>,)?
                ) -> PyResult<Array<'py>> {
                    let first = (stringify!($a), Row::$A, &$a);
                    #[allow(unused_mut, unused_assignments, reason = "some have one argument")]
                    let mut second = None;
                    $(second = Some((stringify!($b), Row::$B, &$b));)?
                    self.map(py, $operation, first, second, Row::$result)
                }
            )*
        }
    };
}

operations! {
    /// Exponential map.
    ///
    /// Parameters
    /// ----------
    /// x : array of the shape (..., dimension)
    ///     Vectors of the algebra; for rotations, the rotation vectors in radians.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., coordinates)
    ///
    /// Examples
    /// --------
    /// >>> SO2.exp([[0.0], [3.0]]).round(6)
    /// array([[ 1.      ,  0.      ],
    ///        [-0.989992,  0.14112 ]])
    exp(x: Vector) -> Element = Operation::Exp;
    /// Logarithm, the inverse of :meth:`exp` near the identity.
    ///
    /// The rotation vectors in results for SO(3) and SE(3) have lengths up to pi.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., dimension)
    ///
    /// Raises
    /// ------
    /// MathematicsError
    ///     An element has no real logarithm.
    ///
    /// Examples
    /// --------
    /// >>> SE3.log([1, 0, 0, 0, 5, 6, 7])
    /// array([0., 0., 0., 5., 6., 7.])
    log(g: Element) -> Vector = Operation::Log;
    /// Product ``g h``.
    ///
    /// Parameters
    /// ----------
    /// g, h : array of the shape (..., coordinates)
    ///     Elements.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., coordinates)
    ///
    /// Examples
    /// --------
    /// >>> SE3.compose([0, 0, 0, 1, 0, 0, 0], [1, 0, 0, 0, 5, 6, 7])
    /// array([ 0.,  0.,  0.,  1., -5., -6.,  7.])
    compose(g: Element, h: Element) -> Element = Operation::Compose;
    /// Inverse elements.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., coordinates)
    ///
    /// Examples
    /// --------
    /// >>> SE3.inverse([0, 0, 0, 1, 5, 6, 7])[4:]
    /// array([ 5.,  6., -7.])
    inverse(g: Element) -> Element = Operation::Inverse;
    /// Relative element ``g^-1 h``.
    ///
    /// Parameters
    /// ----------
    /// g, h : array of the shape (..., coordinates)
    ///     Elements.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., coordinates)
    ///
    /// Examples
    /// --------
    /// >>> SO3.between([0, 0, 0, 1], [0, 0, 0, 1])
    /// array([1., 0., 0., 0.])
    between(g: Element, h: Element) -> Element = Operation::Between;
    /// Projects drifted elements back onto the group.
    ///
    /// Quaternions are normalized; positions are unchanged.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements with rounding errors or drift.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., coordinates)
    ///
    /// Raises
    /// ------
    /// MathematicsError
    ///     An element has no inverse, such as the quaternion 0.
    ///
    /// Examples
    /// --------
    /// >>> SO3.project([2, 0, 0, 0])
    /// array([1., 0., 0., 0.])
    project(g: Element) -> Element = Operation::Restore;
    /// Adjoint action ``Ad_g x``, which maps a body velocity to the spatial velocity.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements.
    /// x : array of the shape (..., dimension)
    ///     Vectors of the algebra.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., dimension)
    ///
    /// Examples
    /// --------
    /// >>> SO3.adjoint([0, 0, 0, 1], [1, 2, 3])
    /// array([-1., -2.,  3.])
    adjoint(g: Element, x: Vector) -> Vector = Operation::Adjoint;
    /// Matrices of the adjoint action ``Ad_g``.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., dimension, dimension)
    ///     The upper index is the row: ``adjoint(g, x)[i] == sum(adjoint_matrix(g)[i, k] * x[k])``.
    ///
    /// Examples
    /// --------
    /// >>> SO3.adjoint_matrix([1, 0, 0, 1])
    /// array([[ 0., -1.,  0.],
    ///        [ 1.,  0.,  0.],
    ///        [ 0.,  0.,  1.]])
    adjoint_matrix(g: Element) -> Operator = Operation::AdjointMatrix;
    /// Coadjoint action ``(Ad*_g h)_k = (Ad_g)^i_k h_i``, which maps a spatial momentum to the body momentum.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements.
    /// h : array of the shape (..., dimension)
    ///     Covectors, such as momenta or forces.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., dimension)
    ///
    /// Examples
    /// --------
    /// >>> SO3.coadjoint([0, 0, 0, 1], [1, 2, 3])
    /// array([-1., -2.,  3.])
    coadjoint(g: Element, h: Vector) -> Vector = Operation::Coadjoint;
    /// Lie bracket ``[x, y]^i = c^i_jk x^j y^k``.
    ///
    /// Parameters
    /// ----------
    /// x, y : array of the shape (..., dimension)
    ///     Vectors of the algebra.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., dimension)
    ///
    /// Examples
    /// --------
    /// >>> SO3.bracket([1, 0, 0], [0, 1, 0])
    /// array([0., 0., 1.])
    bracket(x: Vector, y: Vector) -> Vector = Operation::Bracket;
    /// Left-trivialized differential of exp, ``T(x) v``, with ``exp(x + dx) = exp(x) exp(T(x) dx + ...)``.
    ///
    /// ``T(x)`` is the matrix :meth:`right_jacobian`. Its columns are the rows of ``tangent_left(x, eye)``.
    ///
    /// Parameters
    /// ----------
    /// x : array of the shape (..., dimension)
    ///     Vectors of the algebra.
    /// v : array of the shape (..., dimension)
    ///     Time derivatives of ``x``.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., dimension)
    ///     Velocities in the left-invariant (body) frame.
    ///
    /// Examples
    /// --------
    /// >>> SE2.tangent_left([0, 3, 5], [1, 0, 0])
    /// array([ 1. , -2.5,  1.5])
    tangent_left(x: Vector, v: Vector) -> Vector = Operation::TangentLeft;
    /// Inverse of the left-trivialized differential of exp: ``T(x)^-1 v``.
    ///
    /// Parameters
    /// ----------
    /// x : array of the shape (..., dimension)
    ///     Vectors of the algebra.
    /// v : array of the shape (..., dimension)
    ///     Velocities in the left-invariant (body) frame.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., dimension)
    ///     Time derivatives of ``x``.
    ///
    /// Raises
    /// ------
    /// MathematicsError
    ///     The differential is singular, as for :meth:`left_jacobian_inverse`.
    ///
    /// Examples
    /// --------
    /// >>> SE2.tangent_left_inverse([0, 3, 5], [1, -2.5, 1.5]).round(12)
    /// array([1., 0., 0.])
    tangent_left_inverse(x: Vector, v: Vector) -> Vector = Operation::TangentLeftInverse;
    /// Left Jacobian ``J`` of exp: ``exp(x + dx) = exp(J dx + ...) exp(x)``.
    ///
    /// In the names of the Jacobians, left and right mean the side of the factor ``exp(J dx)`` (Sola, Deray and
    /// Atchuthan, arXiv 1812.01537).
    ///
    /// Parameters
    /// ----------
    /// x : array of the shape (..., dimension)
    ///     Vectors of the algebra.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., dimension, dimension)
    ///     The matrices ``J``; the upper index is the row.
    ///
    /// Examples
    /// --------
    /// >>> SE2.left_jacobian([0, 3, 5])
    /// array([[ 1. ,  0. ,  0. ],
    ///        [ 2.5,  1. ,  0. ],
    ///        [-1.5,  0. ,  1. ]])
    left_jacobian(x: Vector) -> Operator = Operation::Jacobian(JacobianKind::Left);
    /// Right Jacobian ``J`` of exp: ``exp(x + dx) = exp(x) exp(J dx + ...)``.
    ///
    /// ``J`` maps ``v`` to ``tangent_left(x, v)``, the velocity in the left-invariant frame. It is the transpose of
    /// ``tangent_left(x, eye)``, whose rows are the images of the basis vectors.
    ///
    /// Parameters
    /// ----------
    /// x : array of the shape (..., dimension)
    ///     Vectors of the algebra.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., dimension, dimension)
    ///     The matrices ``J``; the upper index is the row.
    ///
    /// Examples
    /// --------
    /// >>> SE2.right_jacobian([0, 3, 5])
    /// array([[ 1. ,  0. ,  0. ],
    ///        [-2.5,  1. ,  0. ],
    ///        [ 1.5,  0. ,  1. ]])
    right_jacobian(x: Vector) -> Operator = Operation::Jacobian(JacobianKind::Right);
    /// Inverse of the left Jacobian: ``log(exp(dx) exp(x)) = x + J^-1 dx + ...``.
    ///
    /// Parameters
    /// ----------
    /// x : array of the shape (..., dimension)
    ///     Vectors of the algebra.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., dimension, dimension)
    ///     The matrices ``J^-1``; the upper index is the row.
    ///
    /// Raises
    /// ------
    /// MathematicsError
    ///     An eigenvalue of ``ad_x`` is ``2 pi i k`` with ``k != 0``; the message names the row.
    ///
    /// Examples
    /// --------
    /// >>> SE2.left_jacobian_inverse([0, 3, 5])
    /// array([[ 1. ,  0. ,  0. ],
    ///        [-2.5,  1. ,  0. ],
    ///        [ 1.5,  0. ,  1. ]])
    left_jacobian_inverse(x: Vector) -> Operator = Operation::Jacobian(JacobianKind::LeftInverse);
    /// Inverse of the right Jacobian: ``log(exp(x) exp(dx)) = x + J^-1 dx + ...``.
    ///
    /// Parameters
    /// ----------
    /// x : array of the shape (..., dimension)
    ///     Vectors of the algebra.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., dimension, dimension)
    ///     The matrices ``J^-1``; the upper index is the row.
    ///
    /// Raises
    /// ------
    /// MathematicsError
    ///     An eigenvalue of ``ad_x`` is ``2 pi i k`` with ``k != 0``; the message names the row.
    ///
    /// Examples
    /// --------
    /// >>> SE2.right_jacobian_inverse([0, 3, 5])
    /// array([[ 1. ,  0. ,  0. ],
    ///        [ 2.5,  1. ,  0. ],
    ///        [-1.5,  0. ,  1. ]])
    right_jacobian_inverse(x: Vector) -> Operator = Operation::Jacobian(JacobianKind::RightInverse);
    /// Time derivative of the coordinates along ``g exp(s v)`` at ``s = 0``. It is linear in ``v``.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements.
    /// v : array of the shape (..., dimension)
    ///     Body velocities.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., coordinates)
    ///
    /// Examples
    /// --------
    /// >>> SO3.rate([1, 0, 0, 0], [0, 0, 2])[3].item()
    /// 1.0
    rate(g: Element, v: Vector) -> Element = Operation::Rate;
    /// Matrices of elements.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., rows, columns)
    ///     The matrices. For vector groups and products, they are columns of the shape (..., rows).
    ///
    /// Examples
    /// --------
    /// >>> SO3.matrix([0, 0, 0, 1])
    /// array([[-1.,  0.,  0.],
    ///        [ 0., -1.,  0.],
    ///        [ 0.,  0.,  1.]])
    matrix(g: Element) -> Matrix = Operation::Matrix;
}

#[pymethods]
#[allow(clippy::wrong_self_convention, reason = "a group reads and writes its elements")]
impl PyGroup {
    /// Elements that are given by their matrices.
    ///
    /// Parameters
    /// ----------
    /// matrix : array of the shape (..., rows, columns)
    ///     Matrices; for vector groups and products, columns.
    /// check : bool
    ///     Whether to check that the matrices belong to the group. ``False`` is faster for SO(3) and SE(3), but then
    ///     the result for other matrices is unspecified. Other groups always check.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., coordinates)
    ///
    /// Raises
    /// ------
    /// MathematicsError
    ///     A matrix does not belong to the group.
    ///
    /// Examples
    /// --------
    /// >>> SO3.from_matrix([[1, 0, 0], [0, -1, 0], [0, 0, -1]])
    /// array([0., 1., 0., 0.])
    #[pyo3(signature = (matrix, *, check=true))]
    pub fn from_matrix<'py>(
        &self,
        py: Python<'py>,
        matrix: Input<'py>,
        check: bool,
    ) -> PyResult<Array<'py>> {
        let operation = if check { Operation::Read } else { Operation::ReadUnchecked };
        self.map(py, operation, ("matrix", Row::Matrix, &matrix), None, Row::Element)
    }

    /// Action of elements, as matrices of size k, on points.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements.
    /// points : array of the shape (..., k)
    ///     Points. Affine maps, such as rigid motions, also act on points of the shape (..., k - 1).
    ///
    /// Returns
    /// -------
    /// array of the shape of the points, broadcast with the batch
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     The elements are not square matrices, or the points have another size.
    ///
    /// Examples
    /// --------
    /// >>> SE3.act([1, 0, 0, 0, 5, 6, 7], [[1, 2, 3], [0, 0, 0]])
    /// array([[ 6.,  8., 10.],
    ///        [ 5.,  6.,  7.]])
    fn act<'py>(&self, py: Python<'py>, g: Input<'py>, points: Input<'py>) -> PyResult<Array<'py>> {
        let Some(Action { size, is_affine }) = self.action() else {
            let name = self.name();
            let reason = format!("the elements of {name} are not matrices that act on points");
            return Err(PyValueError::new_err(reason));
        };
        let shape = points.shape();
        let last = shape.last().copied().unwrap_or(0);
        if last != size && !(is_affine && last + 1 == size && last > 0) {
            let other = if is_affine { format!("(..., {}) or ", size - 1) } else { String::new() };
            let found = arrays::written(shape);
            let reason = format!("points should have the shape {other}(..., {size}), not {found}");
            return Err(PyValueError::new_err(reason));
        }
        let point = Row::Point(last);
        let (g, points) = (("g", Row::Element, &g), ("points", point, &points));
        self.map(py, Operation::Act, g, Some(points), point)
    }
}

in_python! { PyGroup, "group":
    /// The point ``g exp(t log(g^-1 h))`` of the one-parameter curve from ``g`` to ``h``.
    ///
    /// Parameters
    /// ----------
    /// g, h : array of the shape (..., coordinates)
    ///     Elements at ``t = 0`` and at ``t = 1``.
    /// t : array of the shape (...)
    ///     Parameter of the curve, of the shape of the batch. Values outside the interval from 0 to 1 extrapolate.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., coordinates)
    ///
    /// Examples
    /// --------
    /// >>> SE3.interpolate(SE3.identity(), [1, 0, 0, 0, 4, 0, 8], [0.25, 0.5])
    /// array([[1., 0., 0., 0., 1., 0., 2.],
    ///        [1., 0., 0., 0., 2., 0., 4.]])
    interpolate (g, h, t) [g, h, t];
    /// Mean of elements: the solution ``m`` of ``sum w_i log(m^-1 g_i) = 0``, found by iteration from the first
    /// element.
    ///
    /// For rotations, the mean is the Karcher mean, which minimizes the weighted sum of squared distances; the elements
    /// should be within half a turn of each other. On other groups, it is the group exponential mean, which commutes
    /// with translations.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements.
    /// weights : array, optional
    ///     Nonnegative weights, an array of the shape of the batch. For a single axis, a vector is enough.
    /// axis : int or tuple of ints, optional
    ///     Axes of the batch over which the mean is taken; by default all axes.
    ///
    /// Returns
    /// -------
    /// array of the shape (..., coordinates)
    ///     The means; their batch has the remaining axes.
    ///
    /// Raises
    /// ------
    /// MathematicsError
    ///     The iteration does not converge.
    ///
    /// Examples
    /// --------
    /// >>> turns = SO3.exp([[0, 0, 0.0], [0, 0, 0.4]])
    /// >>> SO3.log(SO3.mean(turns, weights=[3, 1])).round(12)
    /// array([0. , 0. , 0.1])
    mean (g, weights=None, axis=None) [g, weights, axis];
    /// Length of ``log(g^-1 h)``, which is invariant under left translations. For rotations, it is the angle in
    /// radians.
    ///
    /// Parameters
    /// ----------
    /// g, h : array of the shape (..., coordinates)
    ///     Elements.
    /// weights : array of the shape (dimension,) or (dimension, dimension), optional
    ///     Positive semidefinite form on the algebra, by default the identity. For rigid motions, it may contain
    ///     squared lengths per radian.
    ///
    /// Returns
    /// -------
    /// array of the shape (...)
    ///
    /// Examples
    /// --------
    /// >>> SE3.distance(SE3.identity(), [1, 0, 0, 0, 3, 4, 0])
    /// array(5.)
    /// >>> SE3.distance(SE3.identity(), [1, 0, 0, 0, 3, 4, 0], weights=[1, 1, 1, 4, 4, 4])
    /// array(10.)
    distance (g, h, weights=None) [g, h, weights];
    /// Curve through elements at given times.
    ///
    /// Parameters
    /// ----------
    /// times : array of the shape (count,)
    ///     Increasing times.
    /// g : array of the shape (count, ..., coordinates)
    ///     Elements.
    /// kind : str
    ///     ``"cubic"`` (default) for a curve with continuous velocities, or ``"geodesic"`` for a constant velocity
    ///     between elements.
    /// velocities : array of the shape (count, ..., dimension), optional
    ///     Body velocities at the elements, only for ``"cubic"``.
    ///
    /// Returns
    /// -------
    /// Spline
    ///
    /// Examples
    /// --------
    /// >>> path = SO3.spline([0, 1, 3], SO3.exp([[0, 0, 0], [0, 0, 1], [0, 0, 3]]))
    /// >>> SO3.log(path(2)).round(12)
    /// array([0., 0., 2.])
    spline (times, g, kind=None, velocities=None) [times, g, kind, velocities];
}
