"""Lie groups over arrays of elements."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from affinor import _engine
from affinor._scalars import floats, with_axes
from affinor._source import Request

__all__ = ["SE2", "SE3", "SE2_3", "SL2", "SO2", "SO3", "Group", "RotationGroup", "groups"]

Floats = NDArray[np.float64]


class Group:
    """A Lie group. All operations take and give arrays, with the axes of a batch in front and NumPy's broadcasting.

    Vectors are components in the basis of the algebra, of the shape (..., dimension). Elements are arrays of coordinates of
    the shape (..., coordinates): a unit quaternion ``w, x, y, z`` for rotations, a quaternion and a position for SE(3),
    entries column by column for groups of matrices, coordinates for R^n and nilpotent groups. Vectors of se(3) have the
    rotation first.

    ``Group("se3")`` takes a name of the catalogue or a sum of names. Groups are equal if they are made of the same name or
    the same definition.
    """

    __slots__ = ("_engine", "_made", "_request")

    def __init__(self, name: str) -> None:
        if not isinstance(name, str):
            raise TypeError(f"the name of a group is a text, not {type(name).__name__}")
        self._engine = _engine.Group(name)
        self._request: Request = {"space": name}
        self._made: tuple[Any, ...] = type(self), (name,)

    @classmethod
    def _of(cls, request: Request) -> Group:
        """The group of the algebra of a space."""
        group = cls.__new__(cls)
        group._request = request
        group._made = _restore, (request,)
        group._engine = _engine.Space(**request).group()
        return group

    @property
    def name(self) -> str:
        """The name of the algebra."""
        return self._engine.name

    @property
    def dimension(self) -> int:
        """The dimension of the algebra."""
        return self._engine.dimension

    @property
    def coordinate_count(self) -> int:
        """The number of coordinates of an element."""
        return self._engine.coordinate_count

    def identity(self) -> Floats:
        """The neutral element."""
        return self._engine.identity()

    def exp(self, x: ArrayLike) -> Floats:
        """The exponential of vectors (..., dimension): elements (..., coordinates)."""
        return self._engine.exp(x)

    def log(self, g: ArrayLike) -> Floats:
        """The logarithm of elements, near the identity the one near 0."""
        return self._engine.log(g)

    def compose(self, g: ArrayLike, h: ArrayLike) -> Floats:
        """The products ``g h``."""
        return self._engine.compose(g, h)

    def inverse(self, g: ArrayLike) -> Floats:
        """The inverse elements."""
        return self._engine.inverse(g)

    def between(self, g: ArrayLike, h: ArrayLike) -> Floats:
        """``g^-1 h``."""
        return self._engine.between(g, h)

    def project(self, g: ArrayLike) -> Floats:
        """Drifted elements projected back onto the group; what has no inverse is refused."""
        return self._engine.project(g)

    def adjoint(self, g: ArrayLike, x: ArrayLike) -> Floats:
        """``Ad_g x``."""
        return self._engine.adjoint(g, x)

    def adjoint_matrix(self, g: ArrayLike) -> Floats:
        """The matrices of ``Ad_g``, (..., dimension, dimension)."""
        g = self._elements(g)
        images = self._engine.adjoint(g[..., None, :], np.eye(self.dimension))
        return np.swapaxes(images, -1, -2)

    def _elements(self, g: ArrayLike) -> Floats:
        """Elements as an array of floats, of a checked shape."""
        array = floats(g)
        if array.ndim == 0 or array.shape[-1] != self.coordinate_count:
            raise ValueError(f"g should be an array of the shape (..., {self.coordinate_count}), not of the shape {array.shape}")
        return array

    def _checked(self, what: str, g: ArrayLike, axes: int) -> Floats:
        """Elements, which are checked; their quaternions get the length 1."""
        array = with_axes(what, g, axes)
        self.from_matrix(self.matrix(array))
        return self.project(array)

    def coadjoint(self, g: ArrayLike, h: ArrayLike) -> Floats:
        """``Ad*_g h``: spatial to body momentum."""
        return self._engine.coadjoint(g, h)

    def bracket(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """The bracket of vectors."""
        return self._engine.bracket(x, y)

    def tangent_left(self, x: ArrayLike, v: ArrayLike) -> Floats:
        """``T_left(x) v``: ``exp(x + dx) = exp(x) exp(T_left(x) dx + ..)``."""
        return self._engine.tangent_left(x, v)

    def tangent_left_inverse(self, x: ArrayLike, v: ArrayLike) -> Floats:
        """``T_left(x)^-1 v``."""
        return self._engine.tangent_left_inverse(x, v)

    def matrix(self, g: ArrayLike) -> Floats:
        """Elements as matrices (..., rows, columns), or as columns (..., rows) for vector groups and products."""
        return self._engine.matrix(g)

    def from_matrix(self, matrix: ArrayLike) -> Floats:
        """The elements of matrices, which are checked."""
        return self._engine.from_matrix(matrix)

    def act(self, g: ArrayLike, points: ArrayLike) -> Floats:
        """The action of matrices of size k on points (..., k); affine maps, such as rigid motions, act on points
        (..., k - 1) too."""
        matrix, points = self.matrix(g), floats(points)
        rows, columns = self._engine.shape
        # a matrix of one number, or a vector of one, whose identity is 0
        single = rows == columns == 1
        if rows != columns or (single and not self.matrix(self.exp(np.zeros(self.dimension))).all()):
            raise ValueError(f"the elements of {self.name} are no matrices that act on points")
        if single:
            matrix = matrix[..., None]
        size = points.shape[-1] if points.ndim else 0
        if size == rows:
            moved: Floats = np.einsum("...ij,...j->...i", matrix, points)
            return moved
        if 0 < size == rows - 1 and self._is_affine():
            turned: Floats = np.einsum("...ij,...j->...i", matrix[..., :-1, :-1], points)
            return turned + matrix[..., :-1, -1]
        raise ValueError(f"points should have the shape (..., {rows}), not {points.shape}")

    def _is_affine(self) -> bool:
        """Whether all elements are matrices with the last row 0, .., 0, 1."""
        last = self.matrix(self.exp(np.eye(self.dimension)))[:, -1]
        return bool((last == np.eye(last.shape[-1])[-1]).all())

    def interpolate(self, g: ArrayLike, h: ArrayLike, t: ArrayLike) -> Floats:
        """The point ``g exp(t log(g^-1 h))``: ``g`` at ``t = 0``, ``h`` at ``t = 1``; ``t`` has the shape of the batch."""
        steps = floats(t)[..., None] * self.log(self.between(g, h))
        return self.compose(g, self.exp(steps))

    def mean(self, g: ArrayLike) -> Floats:
        """The mean of elements (count, coordinates): ``sum log(m^-1 g_i) = 0``."""
        return self._engine.mean(with_axes("g", g, 2))

    def random(
        self, shape: int | tuple[int, ...] = (), *, rng: np.random.Generator | int | None = None, scale: float = 1.0
    ) -> Floats:
        """Exponentials of normal vectors of this scale."""
        generator = rng if isinstance(rng, np.random.Generator) else np.random.default_rng(rng)
        sizes = tuple(shape) if isinstance(shape, (tuple, list)) else (shape,)
        if not all(hasattr(size, "__index__") and size >= 0 for size in sizes):
            raise ValueError(f"the shape should be a number or a tuple of numbers from 0, not {shape!r}")
        return self.exp(generator.normal(scale=scale, size=(*sizes, self.dimension)))

    def __repr__(self) -> str:
        return f"<Group {self.name}, dimension {self.dimension}, {self.coordinate_count} coordinates>"

    def __eq__(self, other: object) -> bool:
        """Whether both are made of the same name or definition."""
        return self._request == other._request if isinstance(other, Group) else NotImplemented

    def __hash__(self) -> int:
        return hash(repr(sorted(self._request.items())))

    def __copy__(self) -> Group:
        return self

    def __deepcopy__(self, memo: Any) -> Group:
        return self

    def __reduce__(self) -> Any:
        return self._made


class RotationGroup(Group):
    """The rotations SO(3): elements are unit quaternions ``w, x, y, z``, vectors rotation vectors in radians."""

    __slots__ = ()

    def __init__(self, name: str = "so3") -> None:
        super().__init__(name)

    def from_quaternion(self, q: ArrayLike, *, scalar_first: bool = True) -> Floats:
        """The elements of quaternions of any length but zero; ``scalar_first=False`` takes the order ``x, y, z, w``."""
        q = floats(q)
        if q.ndim == 0 or q.shape[-1] != 4:
            raise ValueError(f"quaternions should have the shape (..., 4), not {q.shape}")
        largest = np.abs(q).max(axis=-1, keepdims=True)
        if not (np.isfinite(largest) & (largest > 0)).all():
            raise ValueError("a quaternion should be finite and not zero")
        q = np.ldexp(q, -np.frexp(largest)[1])
        unit: Floats = q / np.linalg.norm(q, axis=-1, keepdims=True)
        return unit if scalar_first else np.roll(unit, 1, axis=-1)

    def to_quaternion(self, g: ArrayLike, *, scalar_first: bool = True) -> Floats:
        """The quaternions; ``scalar_first=False`` gives the order ``x, y, z, w``."""
        g = self._elements(g)
        return g.copy() if scalar_first else np.roll(g, -1, axis=-1)

    def from_scipy(self, rotation: Any) -> Floats:
        """The elements of a ``scipy.spatial.transform.Rotation``."""
        if not hasattr(rotation, "as_quat"):
            raise TypeError(f"a Rotation of SciPy was expected, not {type(rotation).__name__}")
        return np.roll(np.asarray(rotation.as_quat(), dtype=np.float64), 1, axis=-1)

    def to_scipy(self, g: ArrayLike) -> Any:
        """A ``scipy.spatial.transform.Rotation``."""
        from scipy.spatial.transform import Rotation

        return Rotation.from_quat(self.to_quaternion(g, scalar_first=False))


def _restore(request: Request) -> Group:
    return Group._of(request)


def groups() -> list[tuple[str, str]]:
    """The groups in closed form: pattern of the name, and how elements are written as matrices."""
    return _engine.groups()


SO2 = Group("so2")
SO3 = RotationGroup()
SE2 = Group("se2")
SE3 = Group("se3")
SE2_3 = Group("se_2(3)")
SL2 = Group("sl2")
