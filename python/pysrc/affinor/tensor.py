"""Tensors: sparse components over upper and lower slots."""

from __future__ import annotations

import html
import itertools
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from affinor import _engine
from affinor._engine import Tensor as Components
from affinor._scalars import (
    Scalar,
    Symbols,
    floats,
    index,
    integers,
    is_matrix,
    merged,
    replaced,
    text_of,
    to_sympy,
    unmasked,
    value_of,
)
from affinor.errors import ShapeError

__all__ = ["Tensor", "contract"]

_SHOWN = 50
"""The most components that a notebook shows."""
_LISTED = 2000
"""The most components that ``str`` lists."""
_NAMES = "abcdefghijklmnopqrstuvwxyz"
"""The names of factors that are given in order."""
_DENSE = 1 << 27
"""The most components of a dense array."""


class Tensor:
    """A tensor over exact numbers, rational functions of parameters, or floats.

    Components are sparse. Indices count from 0 in Python, and from 1 in all printed output. ``slots`` has a mark for each
    index: ``"^"`` for an upper and ``"_"`` for a lower one, so a curvature has ``"^___"``.

    ``Tensor(array, "^_")`` makes a tensor of an array of numbers (int, Fraction, integral floats), SymPy expressions or
    texts; ``scalar="float"`` makes one of floats. A dict of components needs ``dimension``: ``Tensor({(0, 1): "a"}, "__",
    dimension=3)``.
    """

    __slots__ = ("_engine", "_latex_symbol", "_letters", "_symbol", "_symbols", "_title")

    _engine: Components
    # a product with a scalar of NumPy is a tensor, too, and no dense array
    __array_ufunc__ = None
    _symbols: Symbols

    def __init__(
        self,
        components: ArrayLike | Mapping[tuple[int, ...], Scalar] | Any,
        slots: str,
        *,
        dimension: int | None = None,
        scalar: str | None = None,
        symbol: str = "T",
    ) -> None:
        symbols: Symbols = {}
        if isinstance(components, Mapping):
            if dimension is None:
                raise TypeError("a dict of components needs the dimension")
            keys = [key if isinstance(key, tuple) else (key,) for key in components]
            values: list[Any] = list(components.values())
            for key in keys:
                if len(key) != len(slots):
                    raise ValueError(f"the component {key} has {len(key)} indices, the slots {slots!r} {len(slots)}")
            indices = integers("indices", keys).reshape(len(keys), len(slots)).T
        else:
            indices, values, found = _dense(components, slots)
            if dimension is not None and dimension != found:
                raise ValueError(f"the components have the dimension {found}, not {dimension}")
            dimension = found
        self._make(indices, values, slots, dimension, scalar, symbols, symbol)

    def _make(
        self,
        indices: NDArray[np.int64],
        values: Sequence[Any] | NDArray[Any],
        slots: str,
        dimension: int,
        scalar: str | None,
        symbols: Symbols,
        symbol: str,
    ) -> None:
        if not isinstance(slots, str):
            raise TypeError(f"slots are a text of ^ and _, not {type(slots).__name__}")
        dimension = index("the dimension", dimension)
        if not 0 <= dimension < 1 << 63:
            raise ValueError(f"the dimension is a number from 0, not {dimension}")
        if scalar not in (None, "exact", "float"):
            raise ValueError(f"the scalar is exact or float, not {scalar!r}")
        if scalar == "float":
            if any(isinstance(value, (bool, np.bool_)) for value in values):
                raise TypeError("components are numbers, not bools")
            values = floats(values).tolist()
            if not np.isfinite(values).all():
                raise ValueError("components should be finite")
        else:
            values = [text_of(value, symbols) for value in values]
            scalar = "exact"
        made = _engine.Tensor.build(dimension, slots, indices, values, scalar)
        self._set(made, symbols, symbol)

    def _set(
        self,
        engine: Components,
        symbols: Mapping[str, Any],
        symbol: str = "T",
        latex: str | None = None,
        title: str | None = None,
        letters: str | None = None,
    ) -> None:
        names = engine.parameters() if symbols else []
        self._engine = engine
        self._symbols = {name: symbols[name] for name in names if name in symbols}
        self._symbol = symbol
        self._latex_symbol = latex if latex is not None else symbol
        self._title = title
        self._letters = letters

    @classmethod
    def _of(cls, engine: Components, symbols: Mapping[str, Any], *names: Any) -> Tensor:
        tensor = cls.__new__(cls)
        tensor._set(engine, symbols, *names)
        return tensor

    @classmethod
    def from_coo(
        cls,
        indices: ArrayLike,
        values: ArrayLike,
        slots: str,
        dimension: int,
        *,
        scalar: str | None = None,
        symbol: str = "T",
    ) -> Tensor:
        """The tensor of the components ``values`` at ``indices``, of the shape (rank, count) and from 0.

        Components with equal indices are added.
        """
        listed = np.asarray(unmasked(values), dtype=None if isinstance(values, np.ndarray) else object)
        places = integers("indices", indices)
        if listed.ndim != 1:
            raise ValueError(f"values should have the shape (count,), not {listed.shape}")
        tensor = cls.__new__(cls)
        tensor._make(places, list(listed), slots, dimension, scalar, {}, symbol)
        return tensor

    # -- shape -----------------------------------------------------------------------------------------------------------

    @property
    def dimension(self) -> int:
        """The dimension: indices run from 0 to one less."""
        return self._engine.dimension

    @property
    def slots(self) -> str:
        """``^`` or ``_`` for each index."""
        return self._engine.slots

    @property
    def rank(self) -> int:
        """The number of indices."""
        return len(self.slots)

    @property
    def shape(self) -> tuple[int, ...]:
        """``(dimension,) * rank``."""
        return (self.dimension,) * self.rank

    @property
    def nnz(self) -> int:
        """The number of nonzero components."""
        return self._engine.nnz

    @property
    def scalar(self) -> str:
        """``exact``, ``symbolic`` or ``float``."""
        return self._engine.scalar

    @property
    def parameters(self) -> list[str]:
        """The names of the parameters, sorted."""
        return self._engine.parameters()

    @property
    def is_zero(self) -> bool:
        """Whether every component is zero."""
        return self.nnz == 0

    def __bool__(self) -> bool:
        raise TypeError("the truth of a tensor is ambiguous: ask for is_zero")

    # -- components ------------------------------------------------------------------------------------------------------

    def __iter__(self) -> Iterator[Any]:
        """The components of a vector or covector; of other tensors those with the first index fixed."""
        if not self.rank:
            raise TypeError("a tensor of rank 0 has no components to iterate over")
        return (self[(i, *[slice(None)] * (self.rank - 1))] for i in range(self.dimension))

    def __getitem__(self, at: Any) -> Any:
        """The component at indices from 0, or the tensor in which some indices are fixed: ``R[0, :, :, 1]``.

        Displays and the command line count from 1.
        """
        at = at if isinstance(at, tuple) else (at,)
        if len(at) != self.rank:
            raise IndexError(f"a tensor of rank {self.rank} takes {self.rank} indices, not {len(at)}")
        at = tuple(i if isinstance(i, slice) else index("an index", i) for i in at)
        for i in at:
            if isinstance(i, slice):
                if i != slice(None):
                    raise IndexError("a slice of a sparse tensor is ':'")
            elif not 0 <= i < self.dimension:
                raise IndexError(f"the index {i} is not in 0..{self.dimension - 1}; negative ones do not count")
        if not any(isinstance(i, slice) for i in at):
            return value_of(self._engine.get(list(at)), self._symbols)
        part = self._engine
        for slot in reversed(range(self.rank)):
            if not isinstance(at[slot], slice):
                part = part.slice(slot, int(at[slot]))
        return Tensor._of(part, self._symbols, self._symbol, self._latex_symbol)

    def items(self) -> Iterable[tuple[tuple[int, ...], Any]]:
        """The nonzero components in the order of their indices: indices from 0, and value."""
        places = self._engine.indices().T.tolist()
        values: list[Any] = [*self._engine.values()]
        return ((tuple(at), value_of(value, self._symbols)) for at, value in zip(places, values, strict=True))

    def to_coo(self, dtype: Any = float) -> tuple[NDArray[np.int64], NDArray[Any]]:
        """The indices of the nonzero components, shape (rank, nnz) and from 0, and their values.

        Values are float64; with ``dtype=object`` they are fractions or expressions of SymPy. Both arrays are built by the
        engine and handed over without a copy. A type of integers needs components that are such integers.
        """
        if np.dtype(dtype) != np.dtype(object):
            indices, numbers = self._engine.coo()
            with np.errstate(invalid="ignore"):
                values = numbers.astype(dtype, copy=False)
            # floats from 2^53 on may be rounded integers
            if values.dtype.kind in "biu" and not ((values == numbers) & (abs(numbers) < 1 << 53)).all():
                raise TypeError(f"a component has no safe value of the type {values.dtype}; take float or object")
            return indices, values
        indices = self._engine.indices()
        values = np.empty(self.nnz, dtype=object)
        values[:] = [value_of(value, self._symbols) for value in self._engine.values()]
        return indices, values

    def to_numpy(self, dtype: Any = None) -> NDArray[Any]:
        """A dense array: float64, or with ``dtype=object`` of fractions or SymPy expressions.

        Tensors with parameters need ``object``, which is then the default.
        """
        if self.dimension**self.rank > _DENSE:
            raise MemoryError(
                f"{self.dimension**self.rank} components are too many for a dense array: take to_coo()"
            )
        if dtype is None:
            dtype = object if self.parameters else float
        indices, values = self.to_coo(dtype)
        if np.dtype(dtype) == np.dtype(object):
            dense: NDArray[Any] = np.full(self.shape, value_of(_zero(self.scalar), {}), dtype=object)
        else:
            dense = np.zeros(self.shape, dtype=dtype)
        if self.rank:
            dense[tuple(indices)] = values
        elif len(values):
            dense[()] = values[0]
        return dense

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        if copy is False:
            raise ValueError("a dense array of a sparse tensor is always a copy")
        return self.to_numpy(dtype)

    def to_sympy(self) -> Any:
        """An array of SymPy (sparse if it is large); an expression for rank 0, a matrix for rank 2."""
        import sympy

        def convert(value: Any) -> Any:
            if isinstance(value, Fraction):
                return sympy.Rational(value.numerator, value.denominator)
            return to_sympy(value, self._symbols) if isinstance(value, str) else sympy.Float(value)

        places = [tuple(at) for at in self._engine.indices().T.tolist()]
        values = [convert(value) for value in self._engine.values()]
        if self.rank == 0:
            return values[0] if values else sympy.Integer(0)
        found = dict(zip(places, values, strict=True))
        if self.rank == 2:
            return sympy.ImmutableMatrix(self.dimension, self.dimension, lambda i, j: found.get((i, j), 0))
        if self.dimension**self.rank <= 10_000:
            every = itertools.product(range(self.dimension), repeat=self.rank)
            return sympy.ImmutableDenseNDimArray([found.get(at, 0) for at in every], self.shape)
        return sympy.ImmutableSparseNDimArray(found, self.shape)

    def to_pandas(self) -> Any:
        """A DataFrame with a row for each nonzero component: its indices, from 0, and its value."""
        import pandas as pd

        dtype = object if self.parameters else (float if self.scalar == "float" else object)
        indices, values = self.to_coo(dtype)
        letters = self._letters or "ijklmnpq"[: self.rank]
        return pd.DataFrame({**dict(zip(letters, indices, strict=True)), "value": values})

    # -- arithmetic ------------------------------------------------------------------------------------------------------

    def _sum(self, other: Tensor, sign: str) -> Tensor:
        if self.slots != other.slots or self.dimension != other.dimension:
            raise ValueError(
                f"a sum needs equal shapes: {self.slots!r} of dimension {self.dimension}, "
                f"and {other.slots!r} of dimension {other.dimension}"
            )
        if self.rank == 0:
            return _sum0(self, other, sign)
        letters = _written("ijklmnpq"[: self.rank], self.slots)
        return contract(f"a{letters} {sign} b{letters} -> {letters}", a=self, b=other)

    def __add__(self, other: object) -> Tensor:
        return self._sum(other, "+") if isinstance(other, Tensor) else NotImplemented

    def __sub__(self, other: object) -> Tensor:
        return self._sum(other, "-") if isinstance(other, Tensor) else NotImplemented

    def __neg__(self) -> Tensor:
        return Tensor._of(self._engine.scale("-1"), self._symbols)

    def __mul__(self, factor: Scalar) -> Tensor:
        if isinstance(factor, (Tensor, np.ndarray, list, tuple)):
            raise TypeError("a tensor is multiplied by a number; products of tensors are written with contract")
        symbols = merged(self._symbols)
        text = text_of(factor, symbols, floats=self.scalar == "float")
        return Tensor._of(self._engine.scale(text), symbols)

    __rmul__ = __mul__

    def __truediv__(self, divisor: Scalar) -> Tensor:
        symbols = merged(self._symbols)
        text = text_of(divisor, symbols, floats=self.scalar == "float")
        return Tensor._of(self._engine.scale(f"1/({text})"), symbols)

    def contract(self, expression: str, *others: Tensor) -> Tensor:
        """The :func:`contract` of this tensor, as the first factor, with others."""
        return contract(expression, self, *others)

    def permute(self, *order: int) -> Tensor:
        """The slots in another order: slot ``a`` of the result is slot ``order[a]`` of this tensor."""
        return Tensor._of(self._engine.permute(self._positions(*order)), self._symbols)

    def trace(self, a: int, b: int) -> Tensor:
        """The sum over an upper and a lower slot, by their positions from 0."""
        return Tensor._of(self._engine.trace(*self._positions(a, b)), self._symbols)

    def _positions(self, *slots: int) -> list[int]:
        positions = [index("a slot", slot) for slot in slots]
        for slot in positions:
            if not 0 <= slot < self.rank:
                raise ShapeError(f"a tensor of rank {self.rank} has no slot {slot}; they count from 0")
        return positions

    def subs(self, values: Mapping[Any, Scalar]) -> Tensor:
        """The tensor with parameters replaced, by name or by symbol; floats have none. Functions get values in a geometry."""
        if self.scalar == "float":
            return self
        if others := [name for name in values if not str(name).isidentifier()]:
            raise ValueError(f"{others[0]} is no parameter: Geometry.subs gives values to functions")
        symbols = merged(self._symbols)
        written = {str(name): f"({text_of(value, symbols)})" for name, value in values.items()}
        texts = [replaced(text, written) for text in self._engine.texts()]
        made = _engine.Tensor.build(self.dimension, self.slots, self._engine.indices(), texts, "exact")
        return Tensor._of(made, symbols, self._symbol, self._latex_symbol, self._title, self._letters)

    def to_float(self) -> Tensor:
        """The same tensor over floats."""
        names = (self._symbol, self._latex_symbol, self._title, self._letters)
        return Tensor._of(self._engine.over("float"), {}, *names)

    # -- equality --------------------------------------------------------------------------------------------------------

    def __eq__(self, other: object) -> bool:
        """Equal shapes and equal components. Tensors of floats never equal exact ones."""
        return self._engine.equals(other._engine) if isinstance(other, Tensor) else NotImplemented

    def __hash__(self) -> int:
        texts = self._engine.texts() if self.nnz <= 64 else []
        return hash((self.dimension, self.slots, self.nnz, *texts))

    def __copy__(self) -> Tensor:
        return self

    def __deepcopy__(self, memo: Any) -> Tensor:
        return self

    def __reduce__(self) -> Any:
        names = (self._symbol, self._latex_symbol, self._title, self._letters)
        return _restore, (self.scalar, self._engine.to_bytes(), self._symbols, names)

    # -- display ---------------------------------------------------------------------------------------------------------

    def _heading(self) -> str:
        count = f"{self.nnz} nonzero component" + ("" if self.nnz == 1 else "s")
        general = self._symbol + _written(self._letters or "ijklmnpq"[: self.rank], self.slots, runs=True)
        return f"{self._title or general}: {count}" if self.nnz else f"{self._title or general}"

    def __repr__(self) -> str:
        general = self._symbol + _written(self._letters or "ijklmnpq"[: self.rank], self.slots, runs=True)
        count = f"{self.nnz} nonzero component" + ("" if self.nnz == 1 else "s")
        return f"<Tensor {general}, dimension {self.dimension}, {count}, {self.scalar}>"

    def __str__(self) -> str:
        if self.nnz == 0:
            general = self._symbol + _written(self._letters or "ijklmnpq"[: self.rank], self.slots, runs=True)
            return f"{self._title or general}\n  {general} = 0"
        text = self._engine.text(self._symbol, _LISTED)
        if self.nnz > _LISTED:
            text += f"  and {self.nnz - _LISTED} more\n"
        elif self.nnz < self.dimension**self.rank:
            text += "  all others are zero\n"
        return f"{self._heading()}\n{text}".rstrip("\n")

    def to_latex(self, limit: int | None = None) -> str:
        """The components in LaTeX, lines of an ``aligned`` environment; at most ``limit`` of them."""
        if self.nnz == 0:
            letters = self._letters or "ijklmnpq"[: self.rank]
            return f"{self._latex_symbol}{_braced(letters, self.slots)} = 0"
        limit = self.nnz if limit is None else limit
        lines = [line.replace("\\\\*", "\\\\") for line in self._engine.latex(self._latex_symbol, limit)]
        if self.nnz > limit:
            lines.append(f"&\\text{{and {self.nnz - limit} more components}}")
        return "\\begin{aligned}\n" + " \\\\\n".join(lines) + "\n\\end{aligned}"

    def _repr_latex_(self) -> str:
        return f"$$\n{self.to_latex(_SHOWN)}\n$$"

    def _repr_html_(self) -> str | None:
        """A table of the first components of a large tensor; smaller ones are LaTeX."""
        if self.nnz <= _SHOWN:
            return None
        letters = self._letters or "ijklmnpq"[: self.rank]
        head = "".join(f"<th>{letter}</th>" for letter in letters)
        places = (self._engine.indices()[:, :_SHOWN] + 1).T.tolist()
        texts = self._engine.texts()[:_SHOWN]
        rows = "".join(
            "<tr>" + "".join(f"<td>{index}</td>" for index in at) + f"<td>{html.escape(text)}</td></tr>"
            for at, text in zip(places, texts, strict=True)
        )
        return (
            f"<p>{html.escape(self._heading())}; the first {_SHOWN} are shown, indices from 1, "
            f"{self.nnz - _SHOWN} are not</p><table><tr>{head}<th>value</th></tr>{rows}</table>"
        )


def contract(expression: str, *factors: Tensor, **named: Tensor) -> Tensor:
    """A sum of products in index letters.

    ``contract("^i_jk ^j -> ^i_k", c, v)`` takes its factors in order; ``contract("c^i_jk v^j -> ^i_k", c=c, v=v)`` by
    name. A letter that occurs twice in a term, once upper and once lower, is summed. Terms may have rational coefficients:
    ``"1/2 a^i_j - b^i_j -> ^i_j"``.
    """
    if not isinstance(expression, str):
        raise TypeError(f"the expression is a text, not {type(expression).__name__}")
    operands: dict[str, Tensor] = {}
    if factors:
        left, arrow, right = expression.partition("->")
        # factors in order get names that no other factor has
        taken = {*named, *re.findall(r"(?<![\w^_])[A-Za-z][A-Za-z0-9]*", left)}
        names = [letter for letter in _NAMES if letter not in taken]
        count = itertools.count()

        def name(match: re.Match[str]) -> str:
            at = next(count)
            if at >= len(names):
                raise ValueError(f"at most {len(names)} factors are given in order; give the others by name")
            if at >= len(factors):
                raise ValueError(f"{expression!r} has more factors than the {len(factors)} given")
            operands[names[at]] = factors[at]
            return names[at] + match.group()

        expression = re.sub(r"(?<![\w^_])[\^_][\^_\w]*", name, left) + arrow + right
        if len(operands) < len(factors):
            raise ValueError(f"{len(factors)} factors are given, and the expression has {len(operands)}")
    operands.update(named)
    for key, tensor in operands.items():
        if not isinstance(tensor, Tensor):
            raise TypeError(f"the factor {key} should be a Tensor, not {type(tensor).__name__}")
    symbols = merged(*(tensor._symbols for tensor in operands.values()))
    found = _engine.Tensor.contract(expression, [(key, tensor._engine) for key, tensor in operands.items()])
    return Tensor._of(found, symbols)


def _restore(scalar: str, data: bytes, symbols: Symbols, names: tuple[Any, ...]) -> Tensor:
    return Tensor._of(_engine.Tensor.from_bytes(scalar, data), symbols, *names)


def _sum0(a: Tensor, b: Tensor, sign: str) -> Tensor:
    """The sum of two scalars, by their texts."""
    texts = [a._engine.texts() or ["0"], b._engine.texts() or ["0"]]
    scalar = "float" if "float" in (a.scalar, b.scalar) else "exact"
    symbols = merged(a._symbols, b._symbols)
    if scalar == "float":
        values: list[Any] = [float(np.sum(a._engine.floats())) + (1 if sign == "+" else -1) * float(np.sum(b._engine.floats()))]
    else:
        values = [f"({texts[0][0]}) {sign} ({texts[1][0]})"]
    made = _engine.Tensor.build(a.dimension, "", np.zeros((0, 1), dtype=np.int64), values, scalar)
    return Tensor._of(made, symbols)


def _zero(scalar: str) -> Any:
    return 0.0 if scalar == "float" else Fraction(0)


def _written(letters: str, slots: str, *, runs: bool = False) -> str:
    """Letters with their marks: ``^i_j_k``, or in runs ``^i_jk``."""
    text, last = "", ""
    for letter, mark in zip(letters, slots, strict=True):
        text += letter if runs and mark == last else mark + letter
        last = mark
    return text


def _braced(letters: str, slots: str) -> str:
    runs = [(mark, "".join(letter for letter, _ in run)) for mark, run in itertools.groupby(zip(letters, slots, strict=True), key=lambda pair: pair[1])]
    return "{}".join(f"{mark}{{{run}}}" for mark, run in runs)


def _dense(components: Any, slots: str) -> tuple[NDArray[np.int64], list[Any], int]:
    """The indices and values of the nonzero components of an array, and its dimension."""
    if not isinstance(slots, str):
        raise TypeError(f"slots are a text of ^ and _, not {type(slots).__name__}")
    if isinstance(components, Tensor):
        raise TypeError("this is a tensor already")
    if is_matrix(components):
        components = components.tolist()
    array = np.asarray(unmasked(components), dtype=None if isinstance(components, np.ndarray) else object)
    if array.ndim != len(slots) or len(set(array.shape)) > 1:
        expected = f"an array with {len(slots)} equal axes for the slots {slots!r}"
        raise ValueError(f"components should be {expected}, not of the shape {array.shape}")
    if array.ndim == 0:
        raise TypeError("a tensor of rank 0 is a dict: Tensor({(): value}, '', dimension=n)")
    if array.dtype.kind not in "iufO":
        raise TypeError(f"components are numbers or expressions, not {array.dtype}")
    indices = np.array(np.nonzero(array != 0), dtype=np.int64)
    return indices, list(array[tuple(indices)]), array.shape[0]
