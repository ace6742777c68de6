"""Values of the quantities of a geometry at points."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from affinor._bulk import Bulk, Floats
from affinor._engine import Geometry
from affinor._scalars import Symbols, floats, text_of

__all__ = ["PointValues"]


class PointValues(Bulk):
    """The quantities of one geometry at points, in floats: the result of :meth:`Geometry.at`.

    Every quantity of the geometry is an array. Its first axes are the axes of the batch.

    Attributes
    ----------
    batch_shape : tuple of int
        The shape of the batch, to which all arguments are broadcast.
    dimension : int
        The dimension of the geometry.

    Examples
    --------
    >>> plane = Geometry.on_chart("x y", ["1/y^2", "1/y^2"]).at([[0, 1], [0, 2]])
    >>> plane.metric[:, 0, 0]
    array([1.  , 0.25])
    >>> plane.sectional_curvature([1, 0], [0, 1])
    array([-1., -1.])
    """

    __slots__ = ()

    def __reduce__(self) -> Any:
        raise TypeError("values at points cannot be pickled: pickle the geometry and the points")


def at(geometry: Geometry, points: Any, values: Mapping[str, Any] | None) -> PointValues:
    """Evaluates a geometry at points. The keys of ``values`` are names of coordinates, parameters or functions."""
    parameters, coordinates = geometry._source.names(True)
    names: list[str] = []
    arrays: list[Floats] = []
    shapes: list[tuple[str, tuple[int, ...]]] = []
    given: list[tuple[Any, Any]] = list((values or {}).items())
    if isinstance(points, Mapping):
        given = [*points.items(), *given]
    elif points is not None:
        if not coordinates:
            known = ", ".join(parameters) or "none"
            raise ValueError(f"this geometry has no coordinates: give values of its parameters by name ({known})")
        array, n = floats(points), len(coordinates)
        if array.ndim == 0 or array.shape[-1] != n:
            order = ", ".join(coordinates)
            raise ValueError(f"points should be an array of the shape (..., {n}) for {order}, not of the shape {array.shape}")
        names.extend(coordinates)
        # copies the array, because the caller may change it
        arrays.append(_finite(coordinates, array.copy()))
        shapes.append(("points", array.shape[:-1]))
    symbols: Symbols = dict(geometry.symbols)
    for key, value in given:
        name = text_of(key, symbols)
        array = floats(value)
        names.append(name)
        arrays.append(_finite([name], array[..., np.newaxis].copy()))
        shapes.append((name, array.shape))
    family = geometry._at(names)
    return PointValues(family, arrays, _common(shapes))


def _finite(names: list[str], array: Floats) -> Floats:
    """Checks that the numbers of an array (..., k) are finite, and returns the array. ``names`` are the names of the columns."""
    if not np.isfinite(array).all():
        *place, column = np.argwhere(~np.isfinite(array))[0].tolist()
        where = f" at the point {place}" if place else ""
        raise ValueError(f"{names[column]} should be finite, not {array[(*place, column)]}{where}")
    return array


def _common(shapes: list[tuple[str, tuple[int, ...]]]) -> tuple[int, ...]:
    try:
        return np.broadcast_shapes(*(shape for _, shape in shapes))
    except ValueError:
        written = ", ".join(f"{name} {shape}" for name, shape in shapes)
        raise ValueError(f"the batches cannot be broadcast together: {written}") from None
