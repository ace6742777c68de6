"""Lie groups whose methods act on arrays of elements.

The functions are the methods of :class:`Group` that are computed with NumPy.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from affinor._engine import Group, groups
from affinor._optional import optional
from affinor._scalars import floats, index
from affinor._spline import Spline
from affinor.errors import MathematicsError, ShapeError

__all__ = ["SE2", "SE3", "SE2_3", "SL2", "SO2", "SO3", "Group", "RigidMotionGroup", "RotationGroup", "Spline", "groups"]

Floats = NDArray[np.float64]


def _elements(group: Group, g: ArrayLike) -> Floats:
    """Converts elements to an array of floats, and checks its shape."""
    array = floats(g)
    if array.ndim == 0 or array.shape[-1] != group.coordinate_count:
        raise ValueError(f"g should be an array of the shape (..., {group.coordinate_count}), not of the shape {array.shape}")
    return array


def interpolate(group: Group, g: ArrayLike, h: ArrayLike, t: ArrayLike) -> Floats:
    """The point ``g exp(t log(g^-1 h))``, which is ``g`` at ``t = 0`` and ``h`` at ``t = 1``. ``t`` has the shape of the batch."""
    steps = floats(t)[..., None] * group.log(group.between(g, h))
    return group.compose(g, group.exp(steps))


def random(group: Group, shape: Any, rng: np.random.Generator | int | None, scale: float) -> Floats:
    """Exponentials of vectors whose components are normally distributed with the standard deviation ``scale``."""
    shape = () if shape is None else shape
    generator = rng if isinstance(rng, np.random.Generator) else np.random.default_rng(rng)
    sizes = tuple(shape) if isinstance(shape, (tuple, list)) else (shape,)
    if not all(hasattr(size, "__index__") and size >= 0 for size in sizes):
        raise ValueError(f"the shape should be a number or a tuple of numbers from 0, not {shape!r}")
    return group.exp(generator.normal(scale=scale, size=(*sizes, group.dimension)))


def mean(group: Group, g: ArrayLike, weights: ArrayLike | None = None, axis: int | tuple[int, ...] | None = None) -> Floats:
    """The element ``m`` with ``sum w_i log(m^-1 g_i) = 0``."""
    elements = _elements(group, g)
    batch = elements.shape[:-1]
    axes = _axes(axis, len(batch))
    share = np.ones(batch) if weights is None else _weights(floats(weights), batch, axes)
    front = tuple(range(len(axes)))
    elements = np.moveaxis(elements, axes, front)
    share = np.moveaxis(share, axes, front)
    rest = elements.shape[len(axes) : -1]
    elements = np.ascontiguousarray(elements.reshape(-1, *rest, elements.shape[-1]))
    share = share.reshape(-1, *rest)
    if elements.shape[0] == 0:
        raise ShapeError("elements of a mean should be at least one, not none")
    with np.errstate(invalid="ignore"):
        share = (share / share.sum(axis=0))[..., None]
    found, spread, before = elements[0].copy(), np.zeros(rest), np.full(rest, np.inf)
    for step in range(_MEAN_STEPS):
        logs = group.log(group.between(found, elements))
        if step == 0:
            spread = np.abs(logs).max(axis=(0, -1), initial=0.0)
        correction = (share * logs).sum(axis=0)
        size = np.abs(correction).max(axis=-1, initial=0.0)
        if not np.isfinite(size).all():
            break
        # the rounding errors of elements with large entries are large
        own = 1e3 * np.finfo(float).eps * np.abs(found).max(axis=-1, initial=0.0)
        found = group.project(group.compose(found, group.exp(correction)))
        tiny = size <= _ROUNDING * spread
        # ends if steps become no smaller, because further steps do not reduce the rounding errors of the logarithms
        stalled = (size <= np.maximum(own, 1e6 * _ROUNDING * spread)) & (size >= before)
        if (tiny | stalled).all():
            return found
        before = size
    raise MathematicsError(f"invalid mean: after {step + 1} iterations the mean logarithm still has the size {float(np.max(size)):e}")


_MEAN_STEPS = 100
_ROUNDING = 1e-14
"""Steps below this size, relative to the largest logarithm of the first iteration, are rounding errors."""


def _axes(axis: int | tuple[int, ...] | None, count: int) -> tuple[int, ...]:
    """Converts the argument ``axis`` to a list of axes that count from 0; None means all axes."""
    if axis is None:
        return tuple(range(count))
    given = [index("axis", at) for at in (axis if isinstance(axis, (tuple, list)) else (axis,))]
    axes = tuple(at + count if at < 0 else at for at in given)
    if not all(0 <= at < count for at in axes) or len(set(axes)) < len(axes):
        raise ValueError(f"axis should name different axes of a batch with {count} axes, not {axis}")
    return axes


def _weights(weights: Floats, batch: tuple[int, ...], axes: tuple[int, ...]) -> Floats:
    """Broadcasts weights to the shape of the batch. For a single axis, the weights may be a vector."""
    if weights.ndim == 1 and len(axes) == 1:
        shape = [1] * len(batch)
        shape[axes[0]] = weights.shape[0]
        weights = weights.reshape(shape)
    try:
        whole = np.broadcast_to(weights, batch)
    except ValueError:
        raise ValueError(f"weights should have the shape {batch} of the batch, not {weights.shape}") from None
    with np.errstate(over="ignore", invalid="ignore"):
        sums = whole.sum(axis=axes)
    if not (np.isfinite(whole).all() and (whole >= 0).all() and (sums > 0).all()) and whole.size:
        raise ValueError("weights should be finite and not negative, with a positive sum")
    if not np.isfinite(sums).all():
        raise ValueError("the weights have no finite sum: divide them by the largest weight")
    return whole


def distance(group: Group, g: ArrayLike, h: ArrayLike, weights: ArrayLike | None = None) -> Floats:
    """The length of ``log(g^-1 h)``."""
    x = group.log(group.between(g, h))
    if weights is None:
        return np.asarray(np.linalg.norm(x, axis=-1))
    form, n = floats(weights), group.dimension
    if form.shape not in ((n,), (n, n)):
        raise ValueError(f"weights should have the shape ({n},) or ({n}, {n}), not {form.shape}")
    form = np.diag(form) if form.ndim == 1 else form
    if not np.isfinite(form).all():
        raise ValueError(f"weights should be finite, not {form[~np.isfinite(form)][0]}")
    if (np.abs(form - form.T) > 1e-12 * (np.abs(form) + np.abs(form.T))).any():
        raise ValueError("weights should be a symmetric matrix")
    if not _is_positive(form):
        raise ValueError("weights should be positive: the form of the weights has a negative eigenvalue")
    square = np.einsum("...i,ij,...j->...", x, form, x)
    # cancellation: the square of a short vector may be negative, so it is at least zero
    return np.asarray(np.sqrt(np.maximum(square, 0)))


def _is_positive(form: Floats) -> bool:
    """Whether a symmetric matrix has no negative eigenvalue, up to rounding errors. The units of the basis do not matter."""
    diagonal = np.diag(form)
    if (diagonal < 0).any() or form[diagonal == 0].any():
        return False
    scales = np.sqrt(np.where(diagonal == 0, 1.0, diagonal))
    return bool(np.linalg.eigvalsh(form / scales / scales[:, None]).min() >= -1e-14 * len(form))


def spline(
    group: Group,
    times: ArrayLike,
    g: ArrayLike,
    kind: str | None = None,
    velocities: ArrayLike | None = None,
) -> Spline:
    """The curve through elements at given times."""
    return Spline(group, times, g, kind="cubic" if kind is None else kind, velocities=velocities)


class RotationGroup(Group):
    """Rotation group SO(3). Elements are unit quaternions ``w, x, y, z``; vectors are rotation vectors in radians.

    Parameters
    ----------
    name : str
        Name of the algebra, by default ``"so3"``.

    Examples
    --------
    >>> SO3.log([0, 0, 0, 1]).round(6)
    array([0.      , 0.      , 3.141593])
    """

    __slots__ = ()

    def __new__(cls, name: str = "so3") -> RotationGroup:
        return super().__new__(cls, name)

    def from_quaternion(self, q: ArrayLike, *, scalar_first: bool = True) -> Floats:
        """Elements from quaternions, which are normalized.

        Parameters
        ----------
        q : array of the shape (..., 4)
            Quaternions of any length except 0.
        scalar_first : bool
            ``True`` for the order ``w, x, y, z``, ``False`` for ``x, y, z, w``.

        Returns
        -------
        array of the shape (..., 4)
            Elements ``w, x, y, z``.

        Raises
        ------
        ValueError
            A quaternion is zero or not finite.

        Examples
        --------
        >>> SO3.from_quaternion([0, 0, 0, 2], scalar_first=False)
        array([1., 0., 0., 0.])
        """
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
        """Unit quaternions of elements.

        Parameters
        ----------
        g : array of the shape (..., 4)
            Elements ``w, x, y, z``.
        scalar_first : bool
            ``True`` for the order ``w, x, y, z``, ``False`` for ``x, y, z, w``.

        Returns
        -------
        array of the shape (..., 4)

        Examples
        --------
        >>> SO3.to_quaternion([1, 0, 0, 0], scalar_first=False)
        array([0., 0., 0., 1.])
        """
        g = _elements(self, g)
        return g.copy() if scalar_first else np.roll(g, -1, axis=-1)

    def from_scipy(self, rotation: Any) -> Floats:
        """Elements from a SciPy rotation.

        Parameters
        ----------
        rotation : scipy.spatial.transform.Rotation
            One rotation, or a stack of rotations.

        Returns
        -------
        array of the shape (..., 4)

        Examples
        --------
        >>> from scipy.spatial.transform import Rotation
        >>> SO3.from_scipy(Rotation.identity())
        array([1., 0., 0., 0.])
        """
        if not hasattr(rotation, "as_quat"):
            raise TypeError(f"a Rotation of SciPy was expected, not {type(rotation).__name__}")
        return np.roll(np.asarray(rotation.as_quat(), dtype=np.float64), 1, axis=-1)

    def to_scipy(self, g: ArrayLike) -> Any:
        """SciPy rotation from elements.

        Parameters
        ----------
        g : array of the shape (..., 4)
            Elements.

        Returns
        -------
        scipy.spatial.transform.Rotation

        Examples
        --------
        >>> SO3.to_scipy([0, 0, 0, 1]).magnitude().round(6).item()
        3.141593
        """
        rotations = optional("scipy.spatial.transform", "scipy")
        return rotations.Rotation.from_quat(self.to_quaternion(g, scalar_first=False))


class RigidMotionGroup(Group):
    """Group SE(3) of rigid motions. Elements are a quaternion ``w, x, y, z`` and a position; vectors have the rotation first.

    Parameters
    ----------
    name : str
        Name of the algebra, by default ``"se3"``.

    Examples
    --------
    >>> SE3.exp([0, 0, 0, 1, 2, 3])
    array([1., 0., 0., 0., 1., 2., 3.])
    """

    __slots__ = ()

    def __new__(cls, name: str = "se3") -> RigidMotionGroup:
        return super().__new__(cls, name)

    def from_scipy(self, transform: Any) -> Floats:
        """Elements from a rigid transform of SciPy 1.16 or later.

        Parameters
        ----------
        transform : scipy.spatial.transform.RigidTransform
            One transform, or a stack of transforms.

        Returns
        -------
        array of the shape (..., 7)

        Examples
        --------
        >>> from scipy.spatial.transform import RigidTransform
        >>> SE3.from_scipy(RigidTransform.from_translation([1, 2, 3]))
        array([1., 0., 0., 0., 1., 2., 3.])
        """
        if not (hasattr(transform, "rotation") and hasattr(transform, "translation")):
            raise TypeError(f"a RigidTransform of SciPy was expected, not {type(transform).__name__}")
        rotation = np.roll(np.asarray(transform.rotation.as_quat(), dtype=np.float64), 1, axis=-1)
        translation = np.asarray(transform.translation, dtype=np.float64)
        return np.concatenate([rotation, translation], axis=-1)

    def to_scipy(self, g: ArrayLike) -> Any:
        """Rigid transform of SciPy 1.16 or later, from elements.

        Parameters
        ----------
        g : array of the shape (..., 7)
            Elements.

        Returns
        -------
        scipy.spatial.transform.RigidTransform

        Raises
        ------
        ImportError
            SciPy is missing or older than 1.16.

        Examples
        --------
        >>> SE3.to_scipy([1, 0, 0, 0, 1, 2, 3]).translation
        array([1., 2., 3.])
        """
        try:
            from scipy.spatial.transform import RigidTransform, Rotation
        except ImportError as error:
            raise ImportError("RigidTransform needs SciPy 1.16 or later: pip install 'scipy>=1.16'") from error
        g = _elements(self, g)
        rotation = Rotation.from_quat(np.roll(g[..., :4], -1, axis=-1))
        return RigidTransform.from_components(g[..., 4:], rotation)


SO2 = Group("so2")
SO3 = RotationGroup()
SE2 = Group("se2")
SE3 = RigidMotionGroup()
SE2_3 = Group("se_2(3)")
SL2 = Group("sl2")
