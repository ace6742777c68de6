"""Lie groups over arrays of elements.

The functions are the methods of :class:`Group` that NumPy computes.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from affinor._engine import Group, groups
from affinor._scalars import floats

__all__ = ["SE2", "SE3", "SE2_3", "SL2", "SO2", "SO3", "Group", "RotationGroup", "groups"]

Floats = NDArray[np.float64]


def _elements(group: Group, g: ArrayLike) -> Floats:
    """Elements as an array of floats, of a checked shape."""
    array = floats(g)
    if array.ndim == 0 or array.shape[-1] != group.coordinate_count:
        raise ValueError(f"g should be an array of the shape (..., {group.coordinate_count}), not of the shape {array.shape}")
    return array


def adjoint_matrix(group: Group, g: ArrayLike) -> Floats:
    """The matrices of ``Ad_g``."""
    images = group.adjoint(_elements(group, g)[..., None, :], np.eye(group.dimension))
    return np.swapaxes(images, -1, -2)


def act(group: Group, g: ArrayLike, points: ArrayLike) -> Floats:
    """The action of matrices of size k on points (..., k); affine maps, such as rigid motions, act on points
    (..., k - 1) too."""
    matrix, points = group.matrix(g), floats(points)
    rows, columns = group._shape
    # a matrix of one number, or a vector of one, whose identity is 0
    single = rows == columns == 1
    if rows != columns or (single and not group.matrix(group.exp(np.zeros(group.dimension))).all()):
        raise ValueError(f"the elements of {group.name} are no matrices that act on points")
    if single:
        matrix = matrix[..., None]
    size = points.shape[-1] if points.ndim else 0
    if size == rows:
        moved: Floats = np.einsum("...ij,...j->...i", matrix, points)
        return moved
    if 0 < size == rows - 1 and _is_affine(group):
        turned: Floats = np.einsum("...ij,...j->...i", matrix[..., :-1, :-1], points)
        return turned + matrix[..., :-1, -1]
    raise ValueError(f"points should have the shape (..., {rows}), not {points.shape}")


def _is_affine(group: Group) -> bool:
    """Whether all elements are matrices with the last row 0, .., 0, 1."""
    last = group.matrix(group.exp(np.eye(group.dimension)))[:, -1]
    return bool((last == np.eye(last.shape[-1])[-1]).all())


def interpolate(group: Group, g: ArrayLike, h: ArrayLike, t: ArrayLike) -> Floats:
    """The point ``g exp(t log(g^-1 h))``: ``g`` at ``t = 0``, ``h`` at ``t = 1``; ``t`` has the shape of the batch."""
    steps = floats(t)[..., None] * group.log(group.between(g, h))
    return group.compose(g, group.exp(steps))


def random(group: Group, shape: Any, rng: np.random.Generator | int | None, scale: float) -> Floats:
    """Exponentials of normal vectors of this scale."""
    shape = () if shape is None else shape
    generator = rng if isinstance(rng, np.random.Generator) else np.random.default_rng(rng)
    sizes = tuple(shape) if isinstance(shape, (tuple, list)) else (shape,)
    if not all(hasattr(size, "__index__") and size >= 0 for size in sizes):
        raise ValueError(f"the shape should be a number or a tuple of numbers from 0, not {shape!r}")
    return group.exp(generator.normal(scale=scale, size=(*sizes, group.dimension)))


class RotationGroup(Group):
    """The rotations SO(3): elements are unit quaternions ``w, x, y, z``, vectors rotation vectors in radians."""

    __slots__ = ()

    def __new__(cls, name: str = "so3") -> RotationGroup:
        return super().__new__(cls, name)

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
        g = _elements(self, g)
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


SO2 = Group("so2")
SO3 = RotationGroup()
SE2 = Group("se2")
SE3 = Group("se3")
SE2_3 = Group("se_2(3)")
SL2 = Group("sl2")
