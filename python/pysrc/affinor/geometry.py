"""Geometries: a frame with a connection and perhaps a metric."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from affinor import _engine
from affinor._scalars import (
    Scalar,
    Symbols,
    free_functions,
    is_matrix,
    is_sympy,
    merged,
    names_in,
    text_of,
    value_of,
    with_axes,
)
from affinor._source import Source
from affinor.algebra import DESCRIPTIONS, Check, LieAlgebra, checks, settings, source_of, structure_source
from affinor.errors import MathematicsError
from affinor.group import Group
from affinor.structure import Report
from affinor.tensor import Tensor

__all__ = ["Geodesic", "Geometry", "Property", "check", "compare", "conventions"]

QUANTITIES = list(DESCRIPTIONS)


def metric_text(metric: Any, symbols: Symbols, *, floats: bool) -> str:
    """A metric as the command line takes it: a text, a matrix, or the entries of a diagonal."""
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
    """A connection as the command line takes it: a name, or the factor lambda."""
    if isinstance(connection, str):
        return connection
    return f"lambda = {text_of(connection, symbols, floats=floats)}"


def completed(source: Source, connection: Any, metric: Any) -> Source:
    """The source with a connection and a metric."""
    request, symbols = dict(source.request), merged(source.symbols)
    if metric is not None:
        request["metric"] = metric_text(metric, symbols, floats=source.scalar == "float")
    if connection is not None:
        request["connection"] = connection_text(connection, symbols, floats=source.scalar == "float")
    given = [request[key] for key, value in (("metric", metric), ("connection", connection)) if value is not None]
    if taken := sorted(set(names_in(given)) & set(source.values())):
        raise ValueError(f"the parameter {taken[0]} has a value in the algebra: choose another name for it, or write its value")
    return Source(request, symbols, source.scalar, source.tolerance)


def check(
    space: Any,
    *,
    basis: str | Sequence[str] | None = None,
    connection: Any = None,
    metric: Any = None,
    scalar: str = "exact",
    tolerance: float | None = None,
) -> list[Check]:
    """Antisymmetry, the Jacobi identity, the metric and the Bianchi identities, each with a witness if it fails.

    ``space`` is anything that a LieAlgebra or a Geometry is made of, with the same ``scalar`` and ``tolerance``. Failures are
    results, not exceptions.
    """
    source = source_of(space, basis=basis, scalar=scalar, tolerance=tolerance)
    return checks(completed(source, connection, metric))


class Property(NamedTuple):
    """A property of a geometry: whether it holds, its value, or the witness of its failure."""

    holds: bool
    value: Any
    witness: str | None

    def __bool__(self) -> bool:
        return self.holds


class Geodesic(NamedTuple):
    """An autoparallel: times, elements of the group, and tangent vectors in the left-invariant frame."""

    times: NDArray[np.float64]
    elements: NDArray[np.float64]
    tangents: NDArray[np.float64]


class Geometry:
    """A frame with a connection and perhaps a metric; every quantity of ``affinor table`` is a property.

    ``Geometry("so3", metric="diag(a,b,c)")`` takes a LieAlgebra or anything that makes one, a geometry of the paper
    (``"M3"``, ``"SO3"``), a name with a connection (``"so3@plus"``), or a definition with a chart.

    ``connection`` is ``plus``, ``zero``, ``minus``, ``levi-civita``, ``lambda=1/3`` or a number lambda. Without one it is
    levi-civita if there is a metric, else zero. Instead of it, ``affinities`` (slots ``^__``, direction first), or
    ``torsion`` and ``nonmetricity`` (slots ``^__`` and ``___``, with a metric) determine the connection.

    ``metric`` is ``identity``, ``killing``, ``diag(...)``, a matrix, or the entries of a diagonal; unknown names are
    parameters. ``frame="right"`` gives the components in the right-invariant frame. ``scalar`` and ``tolerance`` are those of
    a :class:`LieAlgebra`.
    """

    __slots__ = ("_engine", "_extra", "_frame", "_source", "_symbols")

    def __init__(
        self,
        space: Any,
        connection: Any = None,
        metric: Any = None,
        *,
        basis: str | Sequence[str] | None = None,
        affinities: Any = None,
        torsion: Any = None,
        nonmetricity: Any = None,
        frame: str = "left",
        scalar: str = "exact",
        tolerance: float | None = None,
    ) -> None:
        source = source_of(space, basis=basis, scalar=scalar, tolerance=tolerance)
        extra = {"affinities": (affinities, "^__"), "torsion": (torsion, "^__"), "nonmetricity": (nonmetricity, "___")}
        made = {key: _tensor(given, slots, key, source.scalar) for key, (given, slots) in extra.items()}
        tensors = {key: tensor for key, tensor in made.items() if tensor is not None}
        if tensors and connection is not None:
            raise ValueError("give a connection, or affinities, or torsion and nonmetricity: only one of them")
        self._set(completed(source, connection, metric), tensors, frame)

    def _set(self, source: Source, extra: Mapping[str, Tensor], frame: str) -> None:
        if frame not in ("left", "right"):
            raise ValueError(f"the frame is left or right, not {frame!r}")
        self._source, self._extra, self._frame = source, dict(extra), frame
        self._symbols = merged(source.symbols, *(tensor._symbols for tensor in extra.values()))
        engines = {key: tensor._engine for key, tensor in extra.items()}
        self._engine = source.space().geometry(source.scalar, source.tolerance, **engines)
        if frame == "right":
            self._engine = self._engine.in_right_frame()

    @classmethod
    def _of(cls, source: Source, extra: Mapping[str, Tensor], frame: str) -> Geometry:
        geometry = cls.__new__(cls)
        geometry._set(source, extra, frame)
        return geometry

    @classmethod
    def on_chart(
        cls,
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
    ) -> Geometry:
        """A geometry over coordinates, with a metric in the frame of the coordinates or of ``fields``.

        Coordinates are symbols of SymPy or names; metric and fields may contain sin, cos, exp and others of them. A field is
        a text such as ``"1/sin(theta)*d_phi"``, or its components in the coordinate frame. ``functions`` are functions of
        coordinates that are not given, such as ``"a(t)"``; those of SymPy in the metric and the fields need no mention.
        ``positive`` are functions that are positive, for roots and logarithms.
        """
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
        source = Source({"definition": (name, json.dumps(keys))}, symbols, "exact", None)
        return cls._of(source, {}, "left")

    # -- what it is ------------------------------------------------------------------------------------------------------

    @property
    def name(self) -> str:
        """The name."""
        return self._engine.name

    @property
    def basis(self) -> list[str]:
        """The names of the frame vectors."""
        return self._engine.labels

    @property
    def dimension(self) -> int:
        """The dimension."""
        return len(self.basis)

    @property
    def scalar(self) -> str:
        """``exact``, ``symbolic`` or ``float``."""
        return self._engine.scalar

    @property
    def connection(self) -> str:
        """The connection: ``plus``, ``zero``, ``minus``, ``lambda``, ``levi-civita`` or ``affinities``."""
        return self._engine.connection

    @property
    def lambda_(self) -> Any:
        """The factor lambda of a connection ``Lambda = lambda c``; None for others."""
        text = self._engine.factor
        return None if text is None else self._number(text)

    @property
    def frame(self) -> str:
        """``left-invariant``, ``right-invariant``, ``coordinate`` or ``moving``."""
        return self._engine.frame

    @property
    def symbols(self) -> Symbols:
        """The symbols of SymPy that were given, by name."""
        return dict(self._symbols)

    @property
    def algebra(self) -> LieAlgebra:
        """The Lie algebra."""
        return LieAlgebra._of(self._source.of_algebra())

    # -- quantities ------------------------------------------------------------------------------------------------------

    def quantity(self, key: str) -> Tensor | None:
        """A quantity by its name in tables; None where it does not apply."""
        found = self._engine.quantity(key)
        if found is None:
            return None
        symbol, latex, title, letters = DESCRIPTIONS[key]
        return Tensor._of(found, self._symbols, symbol, latex, title, letters)

    def _tensor(self, key: str) -> Tensor:
        found = self.quantity(key)
        if found is None:
            raise MathematicsError(
                f"{key} is not defined for this geometry",
                "ricci contractions and norms need a metric; schouten, weyl and cotton need levi-civita in dimension 3 or more",
            )
        return found

    def _scalar(self, key: str) -> Any:
        return self._tensor(key)[()]

    def _number(self, text: str) -> Any:
        from fractions import Fraction

        if self.scalar == "float":
            return float(text)
        try:
            return Fraction(text)
        except ValueError:
            return value_of(text, self._symbols)

    @property
    def structure(self) -> Tensor:
        """Structure constants ``c^i_jk``: ``[e_j, e_k] = c^i_jk e_i``."""
        return self._tensor("structure")

    @property
    def affinities(self) -> Tensor:
        """Affinities ``Lambda^i_jk``: ``nabla_{e_j} e_k = Lambda^i_jk e_i``, the direction first."""
        return self._tensor("affinities")

    @property
    def torsion(self) -> Tensor:
        """Torsion ``tau^i_jk``."""
        return self._tensor("torsion")

    @property
    def curvature(self) -> Tensor:
        """Curvature ``R^i_jkl``: ``R(e_k, e_l) e_j = R^i_jkl e_i``."""
        return self._tensor("curvature")

    @property
    def ricci(self) -> Tensor:
        """Ricci tensor ``Ric_jl``."""
        return self._tensor("ricci")

    @property
    def scalar_curvature(self) -> Any:
        """Scalar curvature ``S``."""
        return self._scalar("scalar_curvature")

    @property
    def metric(self) -> Tensor:
        """Metric ``g_ij``."""
        return self._tensor("metric")

    @property
    def inverse_metric(self) -> Tensor:
        """Inverse metric ``g^ij``."""
        return self._tensor("inverse_metric")

    @property
    def nonmetricity(self) -> Tensor:
        """Nonmetricity ``Q_kij = (nabla_k g)_ij``."""
        return self._tensor("nonmetricity")

    @property
    def killing(self) -> Tensor:
        """Killing form ``K_ij`` of the algebra."""
        return self._tensor("killing")

    @property
    def nabla_torsion(self) -> Tensor:
        """Derivative of the torsion ``(nabla_m tau)^i_jk``, slots ``^i_mjk``."""
        return self._tensor("nabla_torsion")

    @property
    def nabla_curvature(self) -> Tensor:
        """Derivative of the curvature ``(nabla_m R)^i_jkl``, slots ``^i_mjkl``."""
        return self._tensor("nabla_curvature")

    @property
    def ricci_symmetric(self) -> Tensor:
        """Symmetric part of the Ricci tensor, ``(Ric_jl + Ric_lj)/2``."""
        return self._tensor("ricci_symmetric")

    @property
    def ricci_antisymmetric(self) -> Tensor:
        """Antisymmetric part of the Ricci tensor, ``(Ric_jl - Ric_lj)/2``."""
        return self._tensor("ricci_antisymmetric")

    @property
    def einstein(self) -> Tensor:
        """Einstein tensor ``G_jl = Ric_jl - 1/2 S g_jl``."""
        return self._tensor("einstein")

    @property
    def schouten(self) -> Tensor:
        """Schouten tensor ``P_jl = (Ric_jl - S/(2 (n - 1)) g_jl)/(n - 2)`` of a Levi-Civita connection."""
        return self._tensor("schouten")

    @property
    def weyl(self) -> Tensor:
        """Weyl tensor ``W^i_jkl`` of a Levi-Civita connection, the trace-free part of the curvature."""
        return self._tensor("weyl")

    @property
    def cotton(self) -> Tensor:
        """Cotton tensor ``C_jkl = (nabla_k P)_jl - (nabla_l P)_jk`` of a Levi-Civita connection."""
        return self._tensor("cotton")

    @property
    def kretschmann(self) -> Any:
        """Kretschmann scalar ``R_ijkl R^ijkl``."""
        return self._scalar("kretschmann")

    # -- properties and reports ------------------------------------------------------------------------------------------

    def check_property(self, name: str) -> Property:
        """``einstein``, ``constant_curvature``, ``bi_invariant``, ``locally_symmetric``, ``parallel_torsion`` or
        ``parallel_curvature``: whether it holds, with its constant or a witness."""
        holds, value, witness = self._engine.property(name)
        return Property(holds, None if value is None else self._number(value), None if witness is None else witness[0])

    def properties(self) -> Report:
        """All properties as ``affinor properties`` finds them: flat, Einstein, naturally reductive, Ricci soliton, ...

        The dict is the JSON document ``affinor.properties/1``; ``print`` shows the table.
        """
        return Report(_engine.properties(self._engine))

    def holonomy(self) -> list[Tensor]:
        """A basis of the holonomy algebra, matrices ``A^i_j``."""
        return [Tensor._of(matrix, self._symbols, "A") for matrix in self._engine.holonomy()]

    def equations(self, kind: str = "euler-poincare", format: str = "text") -> str:
        """Equations of motion: ``euler-poincare``, ``autoparallel`` or ``transport``."""
        return self._engine.equations(kind, format)

    def table(
        self, show: str | Sequence[str] | None = None, format: str = "text", *, independent: bool = False
    ) -> str:
        """The table as the command line prints it, in ``text``, ``markdown``, ``latex``, ``csv`` or ``json``.

        ``show`` names quantities, or is ``all`` or ``derived``.
        """
        if show is None:
            keys = [key for key in QUANTITIES[:10] if key not in ("inverse_metric", "killing")]
        else:
            if not isinstance(show, Iterable):
                raise TypeError(f"show is a text or a list of names of quantities, not {type(show).__name__}")
            named = show.replace(",", " ").split() if isinstance(show, str) else list(show)
            groups = {"all": QUANTITIES[:10], "derived": QUANTITIES[10:]}
            keys = list(dict.fromkeys(key for name in named for key in groups.get(name, [name])))
        return self._engine.table(keys, format, independent)

    def check(self) -> list[Check]:
        """The checks of the certificate, of the connection that was given."""
        return checks(self._written() if self._extra else self._source)

    def _written(self) -> Source:
        """The source of a definition with the affinities and the metric of this geometry."""
        left = Geometry._of(self._source, self._extra, "left")
        if left.frame != "left-invariant":
            raise MathematicsError(
                "a connection on a chart that is given by tensors cannot be checked",
                "write its affinities in the definition of the chart",
            )
        scalar, tolerance, symbols = self._source.scalar, self._source.tolerance, merged(self._symbols)
        # sums have names that cannot be read again
        basis = [label.replace("'", "_") for label in left.basis]
        source = structure_source(left.structure, basis=basis, name=left.name, scalar=scalar, tolerance=tolerance)
        name, text = source.request["definition"]
        keys, texts = json.loads(text), []
        sums: dict[tuple[str, str], list[str]] = {}
        for (i, j, k), value in left.affinities.items():
            texts.append(text_of(value, symbols, floats=scalar == "float"))
            sums.setdefault((basis[j], basis[k]), []).append(f"({texts[-1]})*{basis[i]}")
        keys["affinities"] = [f"nabla[{x}, {y}] = {' + '.join(terms)}" for (x, y), terms in sums.items()]
        keys["parameters"] = sorted({*keys.get("parameters", []), *names_in(texts)})
        source.request["definition"] = (name, json.dumps(keys))
        return completed(source, None, left.quantity("metric"))

    def subs(self, values: Mapping[Any, Scalar]) -> Geometry:
        """The geometry with parameters replaced, by name or by symbol."""
        space = self._source.space()
        alone = {name for tensor in self._extra.values() for name in tensor.parameters}
        alone.difference_update(space.parameters, space.coordinates)
        rest = {name: value for name, value in values.items() if str(name) not in alone}
        source = self._source
        if rest:
            text, symbols = settings(rest, source)
            source = Source({**source.request, "set": text}, symbols, source.scalar, source.tolerance)
        extra = {key: tensor.subs(values) for key, tensor in self._extra.items()}
        return Geometry._of(source, extra, self._frame)

    # -- on the group ----------------------------------------------------------------------------------------------------

    def group(self) -> Group:
        """The group of the algebra."""
        return Group._of(self._source.of_algebra().request)

    def _transport(self) -> tuple[_engine.Transport, Group]:
        group = self.group()
        return self._engine.transport(group._engine), group

    def transport(self, arcs: ArrayLike) -> NDArray[np.float64]:
        """The matrix (dimension, dimension) of parallel translation along consecutive arcs ``exp(s x)``, ``0 <= s <= 1``.

        Components are those in the left-invariant frame; ``arcs`` is a vector ``x`` or rows of them.
        """
        return self._transport()[0].along(with_axes("arcs", arcs, 1, 2))

    def transport_along(self, elements: ArrayLike) -> NDArray[np.float64]:
        """The matrix of parallel translation along a curve of elements; of a loop its holonomy."""
        transport, group = self._transport()
        return transport.samples(group._checked("elements", elements, 2))

    def geodesic(
        self, tangent: ArrayLike, times: ArrayLike, start: ArrayLike | None = None, *, tolerance: float = 1e-12
    ) -> Geodesic:
        """The autoparallel from an element (default: the identity) with a tangent vector, at times after 0."""
        transport, group = self._transport()
        moments = np.array(with_axes("times", times, 0, 1), ndmin=1)
        begin = group.identity() if start is None else group._checked("start", start, 1)
        tangent = with_axes("tangent", tangent, 1)
        return Geodesic(moments, *transport.autoparallel(begin, tangent, moments.tolist(), tolerance))

    def geodesic_between(self, start: ArrayLike, end: ArrayLike, *, tolerance: float = 1e-10) -> NDArray[np.float64]:
        """The tangent vector at ``start`` of an autoparallel that is at ``end`` at time 1."""
        if not tolerance > 0:
            raise ValueError(f"the tolerance {tolerance} is not positive")
        transport, group = self._transport()
        return transport.between(group._checked("start", start, 1), group._checked("end", end, 1), tolerance)

    # -- equality and display --------------------------------------------------------------------------------------------

    def __eq__(self, other: object) -> bool:
        """Equal structure constants, affinities and metrics."""
        if not isinstance(other, Geometry):
            return NotImplemented
        keys = ("structure", "affinities", "metric")
        return all(self.quantity(key) == other.quantity(key) for key in keys)

    def __hash__(self) -> int:
        return hash((self.structure, self.affinities))

    def __copy__(self) -> Geometry:
        return self

    def __deepcopy__(self, memo: Any) -> Geometry:
        return self

    def __reduce__(self) -> Any:
        return _restore, (self._source.of(), self._extra, self._frame)

    def __repr__(self) -> str:
        return f"<Geometry {self.name}, connection {self.connection}, dimension {self.dimension}, {self.scalar}>"

    def __str__(self) -> str:
        return self.table()

    def _repr_markdown_(self) -> str:
        return self.table(format="markdown")


def _restore(source: tuple[Any, ...], extra: Mapping[str, Tensor], frame: str) -> Geometry:
    return Geometry._of(Source(*source), extra, frame)


def _tensor(given: Any, slots: str, name: str, scalar: str) -> Tensor | None:
    if given is None:
        return None
    if isinstance(given, Tensor) and given.scalar == "float" and scalar != "float":
        raise TypeError(f"{name} are floats, and exact numbers are needed: choose scalar='float'")
    tensor = given if isinstance(given, Tensor) else Tensor(given, slots, scalar="float" if scalar == "float" else None)
    if tensor.slots != slots:
        raise ValueError(f"{name} should have the slots {slots!r}, not {tensor.slots!r}")
    return tensor


def _field(field: Any, names: Sequence[str], symbols: Symbols) -> str:
    if isinstance(field, str) or is_sympy(field):
        return text_of(field, symbols)
    parts = [text_of(part, symbols) for part in field]
    if len(parts) != len(names):
        raise ValueError(f"a field has {len(names)} components, not {len(parts)}")
    return " + ".join(f"({part})*d_{name}" for part, name in zip(parts, names, strict=True) if part != "0")


def compare(first: Any = "M(3)", second: Any = "SO(3)", *, format: str = "text") -> str:
    """Two geometries side by side, with the claims of the paper about them; by default the paper's table."""
    sides = [side if isinstance(side, Geometry) else Geometry(side) for side in (first, second)]
    return sides[0]._engine.compare(sides[1]._engine, format)


def conventions(format: str = "text") -> str:
    """The conventions of signs and indices."""
    return _engine.conventions(format)
