//! The methods of groups that take and give arrays of rows.

use crate::arrays::{self, Input};
use crate::class::in_python;
use crate::group::{Action, Array, PyGroup, Row};
use crate::rows::Operation;
use affinor::group::batch::rotations::JacobianKind;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Methods that apply an operation to rows: the arguments with their kinds, and the kind of the result.
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
    /// The exponential of vectors (..., dimension): elements (..., coordinates).
    exp(x: Vector) -> Element = Operation::Exp;
    /// The logarithm of elements, near the identity the one near 0.
    log(g: Element) -> Vector = Operation::Log;
    /// The products ``g h``.
    compose(g: Element, h: Element) -> Element = Operation::Compose;
    /// The inverse elements.
    inverse(g: Element) -> Element = Operation::Inverse;
    /// ``g^-1 h``.
    between(g: Element, h: Element) -> Element = Operation::Between;
    /// Drifted elements projected back onto the group; elements without an inverse are an error.
    project(g: Element) -> Element = Operation::Restore;
    /// ``Ad_g x``.
    adjoint(g: Element, x: Vector) -> Vector = Operation::Adjoint;
    /// The matrices of ``Ad_g``.
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
    /// ``Ad*_g h``: spatial to body momentum.
    coadjoint(g: Element, h: Vector) -> Vector = Operation::Coadjoint;
    /// The bracket of vectors.
    bracket(x: Vector, y: Vector) -> Vector = Operation::Bracket;
    /// ``T_left(x) v``: ``exp(x + dx) = exp(x) exp(T_left(x) dx + ...)``.
    ///
    /// The rows of ``tangent_left(x, eye)`` are the columns of ``right_jacobian(x)``: its transpose.
    tangent_left(x: Vector, v: Vector) -> Vector = Operation::TangentLeft;
    /// ``T_left(x)^-1 v``.
    tangent_left_inverse(x: Vector, v: Vector) -> Vector = Operation::TangentLeftInverse;
    /// The left Jacobian of exp: ``exp(x + dx) = exp(J dx + ...) exp(x)``.
    ///
    /// Left and right are the sides on which ``exp(J dx)`` stands (Sola, Deray and Atchuthan, arXiv 1812.01537).
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
    /// The right Jacobian of exp: ``exp(x + dx) = exp(x) exp(J dx + ...)``.
    ///
    /// It maps ``v`` to ``tangent_left(x, v)``, the velocity in the left-invariant frame. Not to be mixed up:
    /// ``tangent_left(x, eye)`` has the images of the basis vectors in its rows, and so is the transpose of this matrix.
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
    /// The inverse of the left Jacobian: ``log(exp(dx) exp(x)) = x + J^-1 dx + ...``.
    ///
    /// Singular where an eigenvalue of ``ad_x`` is ``2 pi i k``, ``k != 0``: there it raises a MathematicsError with the element.
    ///
    /// Examples
    /// --------
    /// >>> SE2.left_jacobian_inverse([0, 3, 5])
    /// array([[ 1. ,  0. ,  0. ],
    ///        [-2.5,  1. ,  0. ],
    ///        [ 1.5,  0. ,  1. ]])
    left_jacobian_inverse(x: Vector) -> Operator = Operation::Jacobian(JacobianKind::LeftInverse);
    /// The inverse of the right Jacobian: ``log(exp(x) exp(dx)) = x + J^-1 dx + ...``.
    ///
    /// Singular where ``left_jacobian_inverse`` is.
    ///
    /// Examples
    /// --------
    /// >>> SE2.right_jacobian_inverse([0, 3, 5])
    /// array([[ 1. ,  0. ,  0. ],
    ///        [ 2.5,  1. ,  0. ],
    ///        [-1.5,  0. ,  1. ]])
    right_jacobian_inverse(x: Vector) -> Operator = Operation::Jacobian(JacobianKind::RightInverse);
    /// The rate of the coordinates along ``g exp(s v)`` at ``s = 0``, linear in ``v``.
    ///
    /// Examples
    /// --------
    /// >>> float(SO3.rate([1, 0, 0, 0], [0, 0, 2])[3])
    /// 1.0
    rate(g: Element, v: Vector) -> Element = Operation::Rate;
    /// Elements as matrices (..., rows, columns), or as columns (..., rows) for vector groups and products.
    matrix(g: Element) -> Matrix = Operation::Matrix;
}

#[pymethods]
#[allow(clippy::wrong_self_convention, reason = "a group reads and writes its elements")]
impl PyGroup {
    /// The elements of matrices.
    ///
    /// Parameters
    /// ----------
    /// matrix : array of the shape (..., rows, columns)
    ///     Matrices, or columns of vector groups and products.
    /// check : bool
    ///     Whether matrices that are not of the group raise an error. ``False`` is faster for SO(3) and SE(3), and gives an
    ///     unspecified element for a matrix that is not of the group; other groups always check.
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

    /// The action of matrices of size k on points.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements.
    /// points : array of the shape (..., k)
    ///     Points. Affine maps, such as rigid motions, act on points (..., k - 1) too.
    ///
    /// Examples
    /// --------
    /// >>> SE3.act([1, 0, 0, 0, 5, 6, 7], [[1, 2, 3], [0, 0, 0]])
    /// array([[ 6.,  8., 10.],
    ///        [ 5.,  6.,  7.]])
    fn act<'py>(&self, py: Python<'py>, g: Input<'py>, points: Input<'py>) -> PyResult<Array<'py>> {
        let Some(Action { size, is_affine }) = self.action() else {
            let name = self.name();
            let reason = format!("the elements of {name} are no matrices that act on points");
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
    /// The point ``g exp(t log(g^-1 h))``: ``g`` at ``t = 0``, ``h`` at ``t = 1``; ``t`` has the shape of the batch.
    interpolate (g, h, t) [g, h, t];
    /// The element ``m`` with ``sum w_i log(m^-1 g_i) = 0`` that the iteration from the first element finds.
    ///
    /// For rotations it is the Karcher mean, the point with the least weighted sum of squared distances; elements should lie within a
    /// half turn of each other. On other groups it is the group exponential mean, which commutes with translations.
    ///
    /// Parameters
    /// ----------
    /// g : array of the shape (..., coordinates)
    ///     Elements.
    /// weights : array, optional
    ///     Weights that are not negative, of the shape of the batch; for a single axis also a vector.
    /// axis : int or tuple of ints, optional
    ///     The axes of the batch over which the mean is taken; by default all.
    ///
    /// Examples
    /// --------
    /// >>> turns = SO3.exp([[0, 0, 0.0], [0, 0, 0.4]])
    /// >>> SO3.log(SO3.mean(turns, weights=[3, 1])).round(12)
    /// array([0. , 0. , 0.1])
    mean (g, weights=None, axis=None) [g, weights, axis];
    /// The length of ``log(g^-1 h)``, invariant under left translations; the angle between rotations.
    ///
    /// Parameters
    /// ----------
    /// g, h : array of the shape (..., coordinates)
    ///     Elements.
    /// weights : array of the shape (dimension,) or (dimension, dimension), optional
    ///     A positive form on the algebra, such as squared lengths per radian for rigid motions; by default the identity.
    ///
    /// Examples
    /// --------
    /// >>> SE3.distance(SE3.identity(), [1, 0, 0, 0, 3, 4, 0])
    /// array(5.)
    /// >>> SE3.distance(SE3.identity(), [1, 0, 0, 0, 3, 4, 0], weights=[1, 1, 1, 4, 4, 4])
    /// array(10.)
    distance (g, h, weights=None) [g, h, weights];
    /// The curve through elements at given times: piecewise geodesic, or cumulative cubic with continuous velocities.
    ///
    /// Parameters
    /// ----------
    /// times : array of the shape (count,)
    ///     Increasing times.
    /// g : array of the shape (count, ..., coordinates)
    ///     Elements.
    /// kind : str
    ///     ``"cubic"`` or ``"geodesic"``.
    /// velocities : array of the shape (count, ..., dimension), optional
    ///     Body velocities at the elements, for ``"cubic"``.
    ///
    /// Examples
    /// --------
    /// >>> path = SO3.spline([0, 1, 3], SO3.exp([[0, 0, 0], [0, 0, 1], [0, 0, 3]]))
    /// >>> SO3.log(path(2)).round(12)
    /// array([0., 0., 2.])
    spline (times, g, kind=None, velocities=None) [times, g, kind, velocities];
}
