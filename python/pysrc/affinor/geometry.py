"""Geometries: a frame with a connection and, optionally, a metric.

The functions convert the arguments of :class:`Geometry`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from affinor._engine import Geometry, Source, Tensor, compare, conventions
from affinor._scalars import Scalar, Symbols, free_functions, is_matrix, is_sympy, merged, names_in, text_of
from affinor._source import Names, from_structure, source_of
from affinor.algebra import Check
from affinor.errors import MathematicsError

if TYPE_CHECKING:
    from affinor.structure import Report

__all__ = ["Geodesic", "Geometry", "Property", "check", "compare", "conventions"]


def metric_text(metric: Any, symbols: Symbols, *, floats: bool) -> str:
    """Writes a metric in the notation of the command line. The metric is a string, a matrix, or a list of diagonal entries."""
    if isinstance(metric, str):
        return metric
    if isinstance(metric, Tensor):
        if metric.slots != "__":
            raise ValueError(f"a metric has the slots '__', not {metric.slots!r}")
        metric = metric.to_numpy(object if metric.scalar != "float" else float)
    rows = metric.tolist() if is_matrix(metric) or isinstance(metric, np.ndarray) else metric
    if not isinstance(rows, (list, tuple)) or not rows:
        raise TypeError(f"a metric is a text, a matrix or a list of diagonal entries, not {type(metric).__name__}")
    if not isinstance(rows[0], (list, tuple, np.ndarray)):
        entries = [text_of(entry, symbols, floats=floats) for entry in rows]
        return f"diag({', '.join(entries)})"
    written = [", ".join(text_of(entry, symbols, floats=floats) for entry in row) for row in rows]
    return "[" + ", ".join(f"[{row}]" for row in written) + "]"


def connection_text(connection: Any, symbols: Symbols, *, floats: bool) -> str:
    """Writes a connection in the notation of the command line. The connection is a name, or lambda as a number or a string."""
    if isinstance(connection, str):
        return f"lambda = {connection.strip()}" if _NUMBER.fullmatch(connection) else connection
    return f"lambda = {text_of(connection, symbols, floats=floats)}"


_NUMBER = re.compile(r"\s*[+-]?\d+(\.\d+)?([eE][+-]?\d+)?(\s*/\s*\d+)?\s*")


def completed(source: Source, connection: Any, metric: Any) -> Source:
    """Adds a connection and a metric to a source."""
    symbols, floats = merged(source.symbols), source.scalar == "float"
    given = [
        None if metric is None else metric_text(metric, symbols, floats=floats),
        None if connection is None else connection_text(connection, symbols, floats=floats),
    ]
    if taken := sorted(set(names_in(filter(None, given))) & set(dict(source.arguments["values"]))):
        raise ValueError(f"the parameter {taken[0]} has a value in the algebra: choose another name for it, or write its value")
    arguments = dict(source.arguments)
    arguments.update((key, text) for key, text in zip(("metric", "connection"), given, strict=True) if text is not None)
    return Source(arguments, symbols, source.scalar, source.tolerance)


def latex(geometry: Geometry) -> str:
    """The metric and the affinities of a geometry in LaTeX, which notebooks show."""
    metric = geometry.metric
    parts = [] if metric is None else [metric]
    shown = [tensor.to_latex(30) for tensor in [*parts, geometry.affinities]]
    return "\n".join(f"$$\n{part}\n$$" for part in shown)


def check(
    space: Any,
    *,
    basis: Names = None,
    connection: Any = None,
    metric: Any = None,
    scalar: str = "exact",
    tolerance: float | None = None,
) -> list[Check]:
    """Certificate of a definition: antisymmetry, the Jacobi identity, the metric and the Bianchi identities.

    If a check fails, the result has a witness; the function does not raise an exception.

    Parameters
    ----------
    space : LieAlgebra, str, path or dict
        Anything that defines a LieAlgebra or a Geometry.
    basis : str or list of str, optional
        Names of the basis vectors; required for brackets.
    connection : str or number, optional
        Connection as in :class:`Geometry`.
    metric : str, array or list, optional
        Metric as in :class:`Geometry`.
    scalar : str
        ``"exact"`` or ``"float"``.
    tolerance : float, optional
        For floats: a sum counts as zero below this bound, relative to its terms.

    Returns
    -------
    list of Check

    Examples
    --------
    >>> [check.ok for check in check("[x, y] = x, [y, z] = y", basis="x y z")]
    [True, False]
    """
    source = source_of(space, basis=basis, scalar=scalar, tolerance=tolerance)
    return completed(source, connection, metric).check()


class Property(NamedTuple):
    """Property of a geometry. Its truth value tells whether the property holds.

    Attributes
    ----------
    holds : bool
        Whether the property holds.
    value : number or None
        Constant of the property, such as ``c`` in ``Ric = c g``; None if the property has no constant.
    witness : str or None
        First component that violates the property; None if the property holds.

    Examples
    --------
    >>> einstein = Geometry("so3", metric=[1, 1, 1]).check_property("einstein")
    >>> einstein.holds, einstein.value
    (True, Fraction(1, 2))
    """

    holds: bool
    value: Any
    witness: str | None

    def __bool__(self) -> bool:
        return self.holds


Property.holds.__doc__ = "Whether the property holds."
Property.value.__doc__ = "Constant of the property, such as ``c`` in ``Ric = c g``; None if the property has no constant."
Property.witness.__doc__ = "First component that violates the property; None if the property holds."


class Geodesic(NamedTuple):
    """Autoparallel curve on a group.

    Attributes
    ----------
    times : array of the shape (count,)
        Times of the points of the curve.
    elements : array of the shape (count, coordinates)
        Elements of the group at these times.
    tangents : array of the shape (count, dimension)
        Velocities at these times, in the left-invariant frame.

    Examples
    --------
    >>> Geometry("so3", metric=[1, 1, 2]).geodesic([1, 0, 1], [0.5, 1]).tangents.shape
    (2, 3)
    """

    times: NDArray[np.float64]
    elements: NDArray[np.float64]
    tangents: NDArray[np.float64]


Geodesic.times.__doc__ = "Times of the points of the curve."
Geodesic.elements.__doc__ = "Elements of the group at these times."
Geodesic.tangents.__doc__ = "Velocities at these times, in the left-invariant frame."


def geodesics(geometry: Geometry, start: Any, end: Any, starts: int | None = None) -> Report:
    """The geodesics between two points."""
    return geometry._geodesics(_point(start), _point(end), starts)


def _point(point: Any) -> str:
    """Writes a point in the notation of the command line. The point is a text, a sequence of values, or values by name."""
    if isinstance(point, str):
        return point
    symbols: Symbols = {}
    if isinstance(point, Mapping):
        named = [(text_of(name, symbols), text_of(value, symbols, floats=True)) for name, value in point.items()]
        return ", ".join(f"{name}={value}" for name, value in named)
    return ", ".join(text_of(value, symbols, floats=True) for value in np.asarray(point).ravel().tolist())


def parts(
    space: Any,
    connection: Any = None,
    metric: Any = None,
    *,
    basis: Names = None,
    affinities: Any = None,
    torsion: Any = None,
    nonmetricity: Any = None,
    frame: str = "left",
    scalar: str = "exact",
    tolerance: float | None = None,
) -> tuple[Source, list[tuple[str, Tensor]], str]:
    """Reads the arguments of a geometry. Returns its source, the tensors that define its connection, and its frame."""
    source = source_of(space, basis=basis, scalar=scalar, tolerance=tolerance)
    extra = {"affinities": (affinities, "^__"), "torsion": (torsion, "^__"), "nonmetricity": (nonmetricity, "___")}
    made = [(key, _tensor(given, slots, key, source.scalar)) for key, (given, slots) in extra.items()]
    tensors = [(key, tensor) for key, tensor in made if tensor is not None]
    if tensors and connection is not None:
        raise ValueError("give a connection, or affinities, or torsion and nonmetricity: only one of them")
    return completed(source, connection, metric), tensors, frame


def restored(cls: type[Geometry], source: Source, extra: Mapping[str, Tensor], frame: str) -> Geometry:
    """Restores a pickled geometry."""
    given: dict[str, Any] = {**extra, "frame": frame}
    return cls(source, **given)


def chart(
    coordinates: Sequence[Any] | str,
    metric: Any = None,
    *,
    fields: Mapping[str, Any] | None = None,
    connection: Any = None,
    affinities: str | Sequence[str] | None = None,
    parameters: Sequence[Any] = (),
    functions: Sequence[Any] = (),
    positive: Sequence[Any] = (),
    name: str = "chart",
) -> Source:
    """The source of a geometry on a chart with these coordinates."""
    symbols: Symbols = {}
    if not isinstance(coordinates, Iterable):
        raise TypeError(f"coordinates are a text or a list of symbols, not {type(coordinates).__name__}")
    listed = coordinates.replace(",", " ").split() if isinstance(coordinates, str) else list(coordinates)
    names = [text_of(name, symbols) for name in listed]
    chart = {"coordinates": names}
    keys: dict[str, Any] = {"name": name, "chart": chart}
    if fields is not None:
        keys["frame"] = {label: _field(field, names, symbols) for label, field in fields.items()}
    if metric is not None:
        keys["metric"] = metric_text(metric, symbols, floats=False)
    if connection is not None:
        keys["connection"] = connection_text(connection, symbols, floats=False)
    if affinities is not None:
        keys["affinities"] = affinities
    declared = [text_of(function, symbols) for function in functions]
    chart["functions"] = declared + sorted(free_functions([metric, fields or {}]).difference(declared))
    chart["positive"] = [text_of(function, symbols) for function in positive]
    texts = [keys.get("metric", ""), *map(str, keys.get("frame", {}).values()), *chart["positive"]]
    known = {*names, *(f"d_{name}" for name in names), "diag", "identity", "killing"}
    found = [text_of(parameter, symbols) for parameter in parameters]
    keys["parameters"] = sorted({*found, *names_in(texts, without=known)})
    return Source({"space": None, "definition": (name, json.dumps(keys))}, symbols, "exact", None)


def written(geometry: Geometry) -> Source:
    """Returns a source that defines a geometry by its affinities and its metric."""
    extra, _ = geometry._extra
    left = restored(type(geometry), geometry._source, extra, "left")
    if left.frame != "left-invariant":
        raise MathematicsError(
            "a connection on a chart that is given by tensors cannot be checked",
            "write its affinities in the definition of the chart",
        )
    scalar, tolerance, symbols = geometry._source.scalar, geometry._source.tolerance, geometry.symbols
    # basis vectors of sums have names with primes, which cannot be read again
    basis = [label.replace("'", "_") for label in left.basis]
    source = from_structure(left.structure, basis=basis, name=left.name, scalar=scalar, tolerance=tolerance)
    name, text = source.arguments["definition"]
    keys, texts = json.loads(text), []
    sums: dict[tuple[str, str], list[str]] = {}
    for (i, j, k), value in left.affinities.items():
        texts.append(text_of(value, symbols, floats=scalar == "float"))
        sums.setdefault((basis[j], basis[k]), []).append(f"({texts[-1]})*{basis[i]}")
    keys["affinities"] = [f"nabla[{x}, {y}] = {' + '.join(terms)}" for (x, y), terms in sums.items()]
    keys["parameters"] = sorted({*keys.get("parameters", []), *names_in(texts)})
    source = Source({"space": None, "definition": (name, json.dumps(keys))}, symbols, scalar, tolerance)
    return completed(source, None, left.quantity("metric"))


def subs(geometry: Geometry, values: Mapping[Any, Scalar]) -> Geometry:
    """The geometry with parameters replaced by values."""
    source, (extra, frame) = geometry._source, geometry._extra
    alone = {name for tensor in extra.values() for name in tensor.parameters}
    alone.difference_update(*source.names(True))
    rest = {name: value for name, value in values.items() if str(name) not in alone}
    tensors = {key: tensor.subs(values) for key, tensor in extra.items()}
    return restored(type(geometry), source.subs(rest) if rest else source, tensors, frame)


def _tensor(given: Any, slots: str, name: str, scalar: str) -> Tensor | None:
    """Converts an argument to a tensor with these slots; None remains None."""
    if given is None:
        return None
    if isinstance(given, Tensor) and given.scalar == "float" and scalar != "float":
        raise TypeError(f"{name} are floats, but exact numbers are needed: choose scalar='float'")
    tensor = given if isinstance(given, Tensor) else Tensor(given, slots, scalar="float" if scalar == "float" else None)
    if tensor.slots != slots:
        raise ValueError(f"{name} should have the slots {slots!r}, not {tensor.slots!r}")
    return tensor


def _field(field: Any, names: Sequence[str], symbols: Symbols) -> str:
    """Writes a field of the frame in terms of the coordinate fields ``d_x``."""
    if isinstance(field, str) or is_sympy(field):
        return text_of(field, symbols)
    parts = [text_of(part, symbols) for part in field]
    if len(parts) != len(names):
        raise ValueError(f"a field has {len(names)} components, not {len(parts)}")
    return " + ".join(f"({part})*d_{name}" for part, name in zip(parts, names, strict=True) if part != "0")
