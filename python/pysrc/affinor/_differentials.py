"""Operations of groups and their differentials as matrices, for :mod:`affinor.jax` and :mod:`affinor.torch`.

The functions map float64 arrays whose first axes are the axes of the batch. Elements are given by embedding coordinates.
Differentials contain only changes along the group: a change in the length of a quaternion alone has the derivative zero.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from affinor._engine import Group
from affinor.errors import AffinorError

Floats = NDArray[np.float64]


class Operation(NamedTuple):
    """An operation of a group: its result, its differential for each argument, and the number of components of a result."""

    name: str
    result: Callable[..., Floats]
    differentials: tuple[Callable[..., Floats], ...]
    width: Callable[..., int]
    """The number of components of a result, from the numbers of components of the arguments."""


def operations(group: Group) -> dict[str, Operation]:
    """The operations of a group that have differentials, by name."""
    n, count = group.dimension, group.coordinate_count
    eye = np.eye(n)

    def rates(g: Floats) -> Floats:
        """The matrix of ``v -> rate(g, v)``."""
        return np.swapaxes(group.rate(g[..., None, :], eye), -1, -2)

    def velocities(g: Floats) -> Floats:
        """The matrix that maps a change of coordinates to the body velocity: the left inverse of ``rates(g)``."""
        e = rates(g)
        transposed = np.swapaxes(e, -1, -2)
        return np.asarray(np.linalg.solve(transposed @ e, transposed), dtype=np.float64)

    def exp(x: Floats) -> Floats:
        return rates(group.exp(x)) @ group.right_jacobian(x)

    def log(g: Floats) -> Floats:
        return group.right_jacobian_inverse(group.log(g)) @ velocities(g)

    def inverse(g: Floats) -> Floats:
        return -rates(group.inverse(g)) @ group.adjoint_matrix(g) @ velocities(g)

    def first(g: Floats, h: Floats) -> Floats:
        back = group.adjoint_matrix(group.inverse(h))
        return rates(group.compose(g, h)) @ back @ velocities(g)

    def second(g: Floats, h: Floats) -> Floats:
        return rates(group.compose(g, h)) @ velocities(h)

    def parts(g: Floats, points: Floats) -> tuple[Floats, Floats]:
        """The matrices of elements, and the images of points under the generators."""
        matrix, generators = group.matrix(g), group.generators()
        size = points.shape[-1]
        if size < matrix.shape[-1]:
            moved = np.einsum("kij,...j->...ik", generators[:, :-1, :-1], points) + generators[:, :-1, -1].T
            return matrix[..., :-1, :-1], moved
        return matrix, np.einsum("kij,...j->...ik", generators, points)

    def moved_by_element(g: Floats, points: Floats) -> Floats:
        matrix, moved = parts(g, points)
        return matrix @ moved @ velocities(g)

    def moved_point(g: Floats, points: Floats) -> Floats:
        matrix, _ = parts(g, points)
        shape = np.broadcast_shapes(g.shape[:-1], points.shape[:-1])
        return np.broadcast_to(matrix, (*shape, *matrix.shape[-2:]))

    found = [
        Operation("exp", group.exp, (exp,), lambda _: count),
        Operation("log", group.log, (log,), lambda _: n),
        Operation("inverse", group.inverse, (inverse,), lambda _: count),
        Operation("compose", group.compose, (first, second), lambda *_: count),
        Operation("act", group.act, (moved_by_element, moved_point), lambda _, size: size),
    ]
    return {operation.name: operation for operation in found}


def rows(function: Callable[..., Floats], shape: tuple[int, ...], core: int, *arguments: Any) -> Floats:
    """Calls a function with arrays of any float type. Rows without a result, such as the logarithm of zeros, are NaN.

    ``shape`` is the shape of the result. Its last ``core`` axes are the axes of a row.
    """
    given = [np.asarray(argument, dtype=np.float64) for argument in arguments]
    try:
        whole = function(*given)
        return whole if whole.shape == shape else np.broadcast_to(whole, shape).copy()
    except (AffinorError, np.linalg.LinAlgError):
        batch = shape[: len(shape) - core]
        wide = [np.broadcast_to(argument, (*batch, argument.shape[-1])) for argument in given]
        found = np.full(shape, np.nan)
        for at in np.ndindex(*batch):
            try:
                found[at] = function(*(argument[at] for argument in wide))
            except (AffinorError, np.linalg.LinAlgError):
                continue
        return found


class DifferentiableGroup:
    """Operations of a group on arrays of another library, with derivatives.

    Elements and vectors are those of :class:`affinor.Group`: the first axes are the axes of the batch, which broadcast, and
    angles are in radians. Results have the floating-point type of the arguments. A row without a result is NaN.

    Parameters
    ----------
    group : str or affinor.Group
        A group, or its name.

    Attributes
    ----------
    library : str
        Name of the library.
    dimension : int
        Dimension of the algebra, which is the length of a vector.
    coordinate_count : int
        Number of coordinates of an element.

    Raises
    ------
    ValueError
        The last axis of an argument of an operation has the wrong length.

    Examples
    --------
    >>> from affinor.jax import Group      # doctest: +SKIP
    >>> Group("so3").exp([0.0, 0.0, 0.0])  # doctest: +SKIP
    Array([1., 0., 0., 0.], dtype=float32)
    """

    library: str
    """The name of the library."""

    def __init__(self, group: str | Group) -> None:
        self._group = Group(group) if isinstance(group, str) else group
        self.dimension: int = self._group.dimension
        self.coordinate_count: int = self._group.coordinate_count
        self._operations = {name: self._differentiable(found) for name, found in operations(self._group).items()}

    def __repr__(self) -> str:
        return f"<Group {self._group.name} in {self.library}>"

    def exp(self, x: Any) -> Any:
        """Exponential map.

        Parameters
        ----------
        x : array of the shape (..., dimension)
            Vectors of the algebra; for rotations, the rotation vectors in radians.

        Returns
        -------
        array of the shape (..., coordinates)

        Examples
        --------
        >>> SO3.exp([0.0, 0.0, 0.0])  # doctest: +SKIP
        Array([1., 0., 0., 0.], dtype=float32)
        """
        return self._apply("exp", self._rows("x", x, self.dimension))

    def log(self, g: Any) -> Any:
        """Logarithm, the inverse of :meth:`exp` near the identity.

        Parameters
        ----------
        g : array of the shape (..., coordinates)
            Elements.

        Returns
        -------
        array of the shape (..., dimension)

        Examples
        --------
        >>> SE3.log([1.0, 0, 0, 0, 5, 6, 7])  # doctest: +SKIP
        Array([0., 0., 0., 5., 6., 7.], dtype=float32)
        """
        return self._apply("log", self._rows("g", g, self.coordinate_count))

    def compose(self, g: Any, h: Any) -> Any:
        """Product ``g h``.

        Parameters
        ----------
        g, h : array of the shape (..., coordinates)
            Elements.

        Returns
        -------
        array of the shape (..., coordinates)

        Examples
        --------
        >>> SO3.compose([1.0, 0, 0, 0], [0.0, 0, 0, 1])  # doctest: +SKIP
        Array([0., 0., 0., 1.], dtype=float32)
        """
        return self._apply("compose", self._rows("g", g, self.coordinate_count), self._rows("h", h, self.coordinate_count))

    def inverse(self, g: Any) -> Any:
        """Inverse elements.

        Parameters
        ----------
        g : array of the shape (..., coordinates)
            Elements.

        Returns
        -------
        array of the shape (..., coordinates)

        Examples
        --------
        >>> SE3.inverse([0.0, 0, 0, 1, 5, 6, 7])[4:]  # doctest: +SKIP
        Array([ 5.,  6., -7.], dtype=float32)
        """
        return self._apply("inverse", self._rows("g", g, self.coordinate_count))

    def act(self, g: Any, points: Any) -> Any:
        """Action of elements, as matrices of size k, on points.

        Parameters
        ----------
        g : array of the shape (..., coordinates)
            Elements.
        points : array of the shape (..., k)
            Points. Affine maps, such as rigid motions, also act on points of the shape (..., k - 1).

        Returns
        -------
        array of the shape of the points, broadcast with the batch

        Examples
        --------
        >>> SE3.act([1.0, 0, 0, 0, 5, 6, 7], [1.0, 2, 3])  # doctest: +SKIP
        Array([ 6.,  8., 10.], dtype=float32)
        """
        g, points = self._rows("g", g, self.coordinate_count), self._real("points", points)
        # the engine checks the size of points
        self._group.act(self._group.identity(), [0.0] * (points.shape[-1] if points.ndim else 0))
        return self._apply("act", g, points)

    def _rows(self, name: str, value: Any, width: int) -> Any:
        """Converts an argument to an array of real numbers, and checks the length of its last axis."""
        array = self._real(name, value)
        if array.ndim == 0 or array.shape[-1] != width:
            raise ValueError(f"{name} should have the shape (..., {width}), not {tuple(array.shape)}")
        return array

    def _apply(self, name: str, *arguments: Any) -> Any:
        """Applies an operation after converting its arguments to a common floating-point type."""
        dtype = self._dtype(*arguments)
        return self._operations[name](*(self._converted(argument, dtype) for argument in arguments))

    @staticmethod
    def _differentiable(operation: Operation) -> Callable[..., Any]:
        """Converts an operation with its differentials to a function of the library."""
        raise NotImplementedError

    @staticmethod
    def _real(name: str, value: Any) -> Any:
        """Converts an argument to an array of real numbers."""
        raise NotImplementedError

    @staticmethod
    def _dtype(*arguments: Any) -> Any:
        """The floating-point type of a result of these arguments."""
        raise NotImplementedError

    @staticmethod
    def _converted(array: Any, dtype: Any) -> Any:
        """Converts an array to another floating-point type."""
        raise NotImplementedError


def second_derivative(library: str, name: str) -> NotImplementedError:
    """The error for an operation that is differentiated twice."""
    return NotImplementedError(f"affinor.{library} has no second derivatives: {name} was differentiated twice")
