"""Curves through elements of a group."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from affinor._engine import Group
from affinor._scalars import floats, with_axes

__all__ = ["Spline"]

Floats = NDArray[np.float64]


class Spline:
    """Curve through given elements ``g_0, ..., g_m`` at increasing times.

    ``kind="geodesic"`` joins adjacent elements by ``g exp(s log(g^-1 h))``. The body velocity is constant between two elements
    and discontinuous at the elements. ``kind="cubic"`` is the cumulative cubic curve (M.-J. Kim, M.-S. Kim and S. Shin,
    SIGGRAPH 1995)

        ``g_i exp(B_1(u) a) exp(B_2(u) b) exp(B_3(u) c)``,  ``B = 1 - (1-u)^3, 3 u^2 - 2 u^3, u^3``,

    where ``3 a/h`` and ``3 c/h`` are the body velocities at the ends of an interval of length ``h``. The vector ``b`` is chosen
    such that the curve passes through the next element. The curve is continuously differentiable and commutes with left translations. By
    default, the velocities are those of the parabola through three adjacent elements.

    Parameters
    ----------
    group : Group
        The group.
    times : array of the shape (m + 1,)
        Two or more increasing times, in any consistent units.
    elements : array of the shape (m + 1, ..., coordinates)
        Elements; adjacent elements should differ by less than half a turn.
    kind : str
        ``"cubic"`` or ``"geodesic"``.
    velocities : array of the shape (m + 1, ..., dimension), optional
        Body velocities at the elements, only for ``"cubic"``.

    Attributes
    ----------
    group : Group
        The group.
    times : array of the shape (m + 1,)
        Times of the elements.
    elements : array of the shape (m + 1, ..., coordinates)
        The given elements.
    kind : str
        ``"cubic"`` or ``"geodesic"``.

    Raises
    ------
    ValueError
        The times do not increase, a shape does not match, or an element does not belong to the group.

    Examples
    --------
    >>> path = SO3.spline([0, 1, 3], SO3.exp([[0, 0, 0], [0, 0, 1], [0, 0, 3]]))
    >>> SO3.log(path(2)).round(12)
    array([0., 0., 2.])
    >>> path.velocity([0, 2.5]).round(12)
    array([[0., 0., 1.],
           [0., 0., 1.]])
    """

    __slots__ = ("_logs", "elements", "group", "kind", "times")

    def __init__(
        self, group: Group, times: ArrayLike, elements: ArrayLike, *, kind: str = "cubic", velocities: ArrayLike | None = None
    ) -> None:
        t, g = with_axes("times", times, [1]), floats(elements)
        if kind not in ("cubic", "geodesic"):
            raise ValueError(f"the kind of a spline is cubic or geodesic, not {kind!r}")
        if len(t) < 2 or not (np.diff(t) > 0).all():
            raise ValueError("times should be two or more increasing numbers")
        if g.ndim < 2 or g.shape[0] != len(t) or g.shape[-1] != group.coordinate_count:
            raise ValueError(f"elements should have the shape ({len(t)}, ..., {group.coordinate_count}), not {g.shape}")
        self.group, self.times, self.elements, self.kind = group, t.copy(), g.copy(), kind
        _check_elements(group, g)
        steps = np.diff(t).reshape(-1, *(1,) * (g.ndim - 1))
        jumps = group.log(group.between(g[:-1], g[1:]))
        if kind == "geodesic":
            if velocities is not None:
                raise ValueError("a geodesic spline has the velocities of its arcs: leave velocities out")
            self._logs: tuple[Floats, ...] = (jumps,)
            return
        if velocities is None:
            v = _velocities(group, jumps / steps, steps)
        else:
            v = floats(velocities)
            if v.shape != (*g.shape[:-1], group.dimension):
                raise ValueError(f"velocities should have the shape {(*g.shape[:-1], group.dimension)}, not {v.shape}")
            if not np.isfinite(v).all():
                raise ValueError(f"velocities should be finite, not {v[~np.isfinite(v)][0]}")
        first, last = v[:-1] * steps / 3, v[1:] * steps / 3
        # exp(b) = exp(-a) g_i^-1 g_{i+1} exp(-c)
        between = group.compose(group.exp(-first), group.compose(group.exp(jumps), group.exp(-last)))
        self._logs = (first, group.log(between), last)

    def __repr__(self) -> str:
        name, count = self.group.name, len(self.times)
        return f"<Spline on {name}, {self.kind}, through {count} elements from {self.times[0]} to {self.times[-1]}>"

    def __call__(self, t: ArrayLike) -> Floats:
        """Elements of the curve at given times.

        Parameters
        ----------
        t : array of any shape
            Times between the first and the last time of the spline.

        Returns
        -------
        array of the shape ``(*t.shape, ..., coordinates)``

        Raises
        ------
        ValueError
            A time is outside of the interval.

        Examples
        --------
        >>> SE3.spline([0, 1], [[1, 0, 0, 0, 0, 0, 0], [1, 0, 0, 0, 3, 4, 0]], kind="geodesic")(0.5)
        array([1. , 0. , 0. , 0. , 1.5, 2. , 0. ])
        """
        at, u, _ = self._place(t)
        curve = self.elements[at]
        for weight, logs in zip(self._weights(u), self._logs, strict=True):
            curve = self.group.compose(curve, self.group.exp(weight * logs[at]))
        return curve

    def velocity(self, t: ArrayLike) -> Floats:
        """Body velocities of the curve at given times.

        Parameters
        ----------
        t : array of any shape
            Times between the first and the last time of the spline.

        Returns
        -------
        array of the shape ``(*t.shape, ..., dimension)``

        Raises
        ------
        ValueError
            A time is outside of the interval.

        Examples
        --------
        >>> SO2.spline([0, 2], SO2.exp([[0.0], [1.0]])).velocity(0.5).round(12)
        array([0.5])
        """
        at, u, h = self._place(t)
        found: Any = 0.0
        for weight, rate, logs in zip(self._weights(u), self._rates(u), self._logs, strict=True):
            step = logs[at]
            if isinstance(found, np.ndarray):
                found = self.group.adjoint(self.group.exp(-weight * step), found)
            found = found + rate / h * step
        return np.asarray(found)

    def _place(self, t: ArrayLike) -> tuple[NDArray[np.intp], Floats, Floats]:
        """For each time, the index of its interval, the relative position in the interval, and the length of the interval."""
        moments = floats(t)
        start, end = self.times[0], self.times[-1]
        if not ((moments >= start) & (moments <= end)).all():
            outside = moments[~((moments >= start) & (moments <= end))].flat[0]
            raise ValueError(f"the time {outside} is not between {start} and {end}")
        at = np.clip(np.searchsorted(self.times, moments, side="right") - 1, 0, len(self.times) - 2)
        steps = np.diff(self.times)[at]
        axes = (..., *(None,) * (self.elements.ndim - 1))
        return at, ((moments - self.times[at]) / steps)[axes], steps[axes]

    def _weights(self, u: Floats) -> tuple[Floats, ...]:
        """The weights of the logarithms at the relative positions ``u`` in an interval."""
        if self.kind == "geodesic":
            return (u,)
        return 1 - (1 - u) ** 3, (3 - 2 * u) * u**2, u**3

    def _rates(self, u: Floats) -> tuple[Floats, ...]:
        """The derivatives of the weights with respect to ``u``."""
        if self.kind == "geodesic":
            return (np.ones_like(u),)
        return 3 * (1 - u) ** 2, 6 * u * (1 - u), 3 * u**2


def _check_elements(group: Group, elements: Floats) -> None:
    """Rejects elements that differ from their projections by more than rounding errors, such as quaternions of length 2."""
    drift = np.abs(group.project(elements) - elements)
    # ignores the size of positions, because the projection does not change positions
    size = np.where(drift > 0, np.abs(elements), 0.0).max(axis=-1, initial=1.0)
    # the determinant of a large matrix has large rounding errors
    rounding = 8 * np.finfo(float).eps * size ** max(2, *group._shape[1:])
    wrong = np.flatnonzero(drift.max(axis=-1, initial=0.0) > 1e-6 * size + rounding)
    if wrong.size:
        at = wrong[0]
        reason = f"it differs from its projection by {drift.max(axis=-1).flat[at]:g}"
        raise ValueError(f"element {at} of the batch is not in the group {group.name}: {reason}; project it first")


def _velocities(group: Group, slopes: Floats, steps: Floats) -> Floats:
    """Body velocities of the parabolas through three adjacent elements. At each end, the nearest parabola is used."""
    if len(slopes) == 1:
        return np.concatenate([slopes, slopes])
    before, after = steps[:-1], steps[1:]
    middle = (after * slopes[:-1] + before * slopes[1:]) / (before + after)
    first, last = 2 * slopes[:1] - middle[:1], 2 * slopes[-1:] - middle[-1:]
    return np.concatenate([first, middle, last])
