"""Many geometries at once: one Lie algebra with a connection, and an array of metrics."""

from __future__ import annotations

import os
import threading
from collections import OrderedDict
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from affinor._bulk import Bulk, Floats, common
from affinor._engine import Family, Geometry, LieAlgebra, Source
from affinor._scalars import floats, merged
from affinor._source import Names, source_of
from affinor.errors import InputError, MathematicsError
from affinor.geometry import completed, connection_text

__all__ = ["Geometries"]

_FAMILIES: OrderedDict[str, Family] = OrderedDict()
"""The most recently used families, with their recorded programs."""

_MOST_FAMILIES = 32
_LOCK = threading.Lock()


class Geometries(Bulk):
    """Left-invariant geometries of one Lie algebra, for an array of metrics in floats.

    Every quantity of a :class:`Geometry` with ``scalar="float"`` is an array, whose first axes are the axes of the batch. The
    formula is recorded once for the algebra and the connection, and then evaluated for all metrics on all cores. The formulas
    of the last 32 algebras are stored.

    Parameters
    ----------
    space : LieAlgebra, Geometry, str or dict
        A LieAlgebra or anything that defines one, with or without a connection, such as ``"so3@plus"``; or a Geometry without
        a metric.
    metrics : array of the shape (..., n, n)
        Symmetric, regular matrices ``g_ij`` of any signature.
    connection : str or number, optional
        ``levi-civita``, ``plus``, ``zero``, ``minus``, or a number lambda. The default is the connection of the space; if the
        space has none, ``levi-civita``.
    parameters : dict of arrays, optional
        Values of the parameters of the brackets, by name or symbol; arrays are broadcast with the batch of metrics.
    basis : str or list of str, optional
        Names of the basis vectors; required for brackets.

    Attributes
    ----------
    dimension : int
        Dimension ``n`` of the algebra.
    batch_shape : tuple of ints
        Shape (...) of the batch of metrics and parameters.

    Raises
    ------
    MetricError
        A metric is not symmetric or is degenerate.

    Examples
    --------
    >>> import numpy as np
    >>> bodies = Geometries("so3", [np.diag([1, 1, 1]), np.diag([1, 1, 2])])
    >>> bodies.scalar_curvature
    array([1.5, 1. ])
    >>> bodies.ricci.shape
    (2, 3, 3)
    >>> bianchi = Geometries("[x, z] = x, [y, z] = h*y", np.eye(3), parameters={"h": [1, 2]}, basis="x y z")
    >>> bianchi.scalar_curvature
    array([ -6., -14.])
    """

    __slots__ = ("_metrics",)

    def __init__(
        self,
        space: Any,
        metrics: ArrayLike,
        *,
        connection: Any = None,
        parameters: Mapping[Any, ArrayLike] | None = None,
        basis: Names = None,
    ) -> None:
        g = floats(metrics)
        if g.ndim < 2 or g.shape[-1] != g.shape[-2] or g.shape[-1] == 0:
            raise ValueError(f"metrics should be an array of the shape (..., n, n), not of the shape {g.shape}")
        n = g.shape[-1]
        if parameters is not None and not isinstance(parameters, Mapping):
            raise TypeError(f"parameters should be a dict of arrays by name, not {type(parameters).__name__}")
        source, connection = _with_connection(space, connection, basis)
        family = _family_of(source, connection, g.shape, _may_have_metric(space))
        given = {str(name): floats(value) for name, value in (parameters or {}).items()}
        if unknown := sorted(set(given) - set(family.parameters)):
            known = ", ".join(family.parameters) or "none"
            raise ValueError(f"the algebra has no parameter {unknown[0]}; its parameters: {known}")
        if missing := [name for name in family.parameters if name not in given]:
            raise ValueError(f"values of the parameters are missing: {', '.join(missing)}")
        family.check("metric", g.reshape(-1, n * n), True)
        values = [given[name] for name in family.parameters]
        shape = common(g.shape[:-2], *(value.shape for value in values))
        # copies the array, because the caller may change it
        self._metrics = g.copy()
        rows = self._metrics.reshape((*g.shape[:-2], n * n))
        super().__init__(family, [rows, *(value[..., np.newaxis].copy() for value in values)], shape)

    def __reduce__(self) -> Any:
        raise TypeError("geometries in bulk cannot be pickled: pickle the algebra and the metrics")

    @property
    def metric(self) -> Floats:
        """Metrics ``g_ij``, an array of the shape (..., n, n)."""
        return np.broadcast_to(self._metrics, (*self.batch_shape, self.dimension, self.dimension)).copy()

    def derivative(self, key: str, direction: ArrayLike | None = None) -> Floats:
        """Derivative of a quantity with respect to the metric.

        Parameters
        ----------
        key : str
            Name of a quantity, as for :meth:`quantity`.
        direction : array of the shape (..., n, n), optional
            Symmetric variations ``h`` of the metric, broadcast with the batch.

        Returns
        -------
        array of the shape (..., n, ...)
            Derivative along ``h``. Without a direction, the full derivative ``D``, which has two additional axes ``a, b`` at the
            end and is symmetric in them. The derivative along ``h`` is then ``sum D[..., a, b] h[a, b]``.

        Examples
        --------
        A step of the Ricci flow changes the scalar curvature by its derivative along ``-2 Ric``.

        >>> import numpy as np
        >>> sphere = Geometries("so3", np.eye(3))
        >>> sphere.derivative("scalar_curvature", -2 * sphere.ricci)
        array(1.5)
        >>> sphere.derivative("scalar_curvature")
        array([[-0.5,  0. ,  0. ],
               [ 0. , -0.5,  0. ],
               [ 0. ,  0. , -0.5]])
        """
        self._check_key(key)
        n = self.dimension
        if direction is None:
            pairs = [(a, b) for a in range(n) for b in range(a, n)]
            rates = np.zeros((len(pairs), n, n))
            for at, (a, b) in enumerate(pairs):
                rates[at, a, b] += 0.5
                rates[at, b, a] += 0.5
            slots = len(self._family.shape(key))
            axes = (1,) * len(self.batch_shape)
            rates = rates.reshape(len(pairs), *axes, n, n)
            found = self._evaluate(key, (len(pairs), *self.batch_shape), rates=rates)
            full = np.empty((*found.shape[1:], n, n))
            for at, (a, b) in enumerate(pairs):
                full[..., a, b] = full[..., b, a] = found[at]
            assert full.ndim == len(self.batch_shape) + slots + 2
            return full
        rates = floats(direction)
        if rates.ndim < 2 or rates.shape[-2:] != (n, n):
            raise ValueError(f"the direction should be an array of the shape (..., {n}, {n}), not of the shape {rates.shape}")
        self._family.check("direction", rates.reshape(-1, n * n), False)
        return self._evaluate(key, common(self.batch_shape, rates.shape[:-2]), rates=rates)


def _with_connection(space: Any, connection: Any, basis: Names) -> tuple[Source, Any]:
    """The source of a space, and the connection. ``None`` means the connection of the source."""
    if isinstance(space, Geometry):
        if basis is not None:
            raise TypeError("this Geometry has a basis: leave basis out")
        tensors, frame = space._extra
        if tensors or frame != "left":
            reason = "is given by tensors" if tensors else f"is in the {frame}-invariant frame"
            raise ValueError(f"the connection of the Geometry {reason}: pass its algebra and a connection")
        if space.quantity("metric") is not None:
            raise ValueError(f"{_TWICE}; pass its algebra, or a Geometry without a metric")
        # zero is also the default of a geometry without a metric, and is used here too
        if connection is None and space.connection in ("plus", "zero", "minus"):
            connection = space.connection
        source = space._source
    else:
        source = source_of(space, basis=basis)
    if connection is not None and not isinstance(connection, str):
        connection = connection_text(connection, merged(source.symbols), floats=True)
    return source, connection


_TWICE = "the metric is given twice: by the space and by the argument metrics"


def _may_have_metric(space: Any) -> bool:
    """Whether a metric of the space may be replaced: the metric of an algebra, or of a name such as ``M(3)``."""
    if isinstance(space, str):
        return ";" not in space and not os.path.isfile(space.partition("@")[0])
    return isinstance(space, LieAlgebra)


def _family_of(space: Source, connection: Any, shape: tuple[int, ...], may_have_metric: bool) -> Family:
    """The family of an algebra with a connection. Its parameters are the upper triangle of the metric.

    ``shape`` is the shape of the metrics. If ``may_have_metric`` is true, the metrics may replace a metric of the space.
    """
    n = shape[-1]
    names = [[f"metric_{min(i, j)}_{max(i, j)}" for j in range(n)] for i in range(n)]
    metric = "[" + ", ".join(f"[{', '.join(row)}]" for row in names) + "]"
    source = completed(space, connection, metric)
    key = repr((source.arguments, source.scalar, source.tolerance, may_have_metric))
    with _LOCK:
        if key in _FAMILIES:
            _FAMILIES.move_to_end(key)
            return _FAMILIES[key]
    geometry = _geometry_of(space)
    if not may_have_metric and geometry.quantity("metric") is not None:
        raise ValueError(f"{_TWICE}; remove it from the space")
    dimension = geometry.dimension
    if dimension != n:
        raise ValueError(f"metrics should be an array of the shape (..., {dimension}, {dimension}), not of the shape {shape}")
    family = Family(source, [name for row in names for name in row])
    with _LOCK:
        _FAMILIES[key] = family
        while len(_FAMILIES) > _MOST_FAMILIES:
            _FAMILIES.popitem(last=False)
    return family


def _geometry_of(space: Source) -> Geometry:
    """The geometry of a space, with the metric of the space if there is one."""
    try:
        return Geometry(space)
    except (InputError, MathematicsError):
        # uses another connection, because levi-civita needs a metric, which this space may lack
        return Geometry(space, "zero")
