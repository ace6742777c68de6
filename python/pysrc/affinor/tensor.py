"""Tensors: sparse components with upper and lower indices.

The functions implement the parts of :class:`Tensor` that need NumPy, SymPy or pandas.
"""

from __future__ import annotations

import itertools
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from affinor._engine import Tensor, contract
from affinor._optional import optional
from affinor._scalars import Scalar, Symbols, floats, index, integers, is_matrix, merged, replaced, text_of, unmasked

__all__ = ["Tensor", "contract"]

_NAMES = "abcdefghijklmnopqrstuvwxyz"
"""The names that factors without names get."""
_DENSE = 1 << 27
"""The maximum number of components of a dense array."""

Parts = tuple[int, str, NDArray[np.int64], list[Any], str, Symbols]
"""The dimension, slots, indices, values (strings or floats) and kind of scalars of a tensor, and the SymPy symbols in it."""


def parts(components: Any, slots: str, dimension: int | None, scalar: str | None) -> Parts:
    """Reads the parts of a tensor from an array or a dict of components."""
    if not isinstance(components, Mapping):
        indices, values, found = _dense(components, slots)
        if dimension is not None and dimension != found:
            raise ValueError(f"the components have the dimension {found}, not {dimension}")
        return _checked(indices, values, slots, found, scalar)
    if dimension is None:
        raise TypeError("a dict of components needs the argument dimension")
    keys = [key if isinstance(key, tuple) else (key,) for key in components]
    for key in keys:
        if len(key) != len(slots):
            raise ValueError(f"the component {key} has {len(key)} indices, but the slots {slots!r} need {len(slots)}")
    indices = integers("indices", keys).reshape(len(keys), len(slots)).T
    return _checked(indices, list(components.values()), slots, dimension, scalar)


def parts_of_coo(indices: Any, values: Any, slots: str, dimension: int, scalar: str | None) -> Parts:
    """Reads the parts of a tensor from indices and values."""
    listed = np.asarray(unmasked(values), dtype=None if isinstance(values, np.ndarray) else object)
    places = integers("indices", indices)
    if listed.ndim != 1:
        raise ValueError(f"values should have the shape (count,), not {listed.shape}")
    return _checked(places, list(listed), slots, dimension, scalar)


def _checked(
    indices: NDArray[np.int64], values: Sequence[Any], slots: str, dimension: int, scalar: str | None
) -> Parts:
    """Checks the parts of a tensor, and returns them."""
    if not isinstance(slots, str):
        raise TypeError(f"slots are a text of ^ and _, not {type(slots).__name__}")
    dimension = index("the dimension", dimension)
    if not 0 <= dimension < 1 << 63:
        raise ValueError(f"the dimension should be from 0 to 2^63 - 1, not {dimension}")
    if scalar not in (None, "exact", "float"):
        raise ValueError(f"the scalar is exact or float, not {scalar!r}")
    symbols: Symbols = {}
    if scalar != "float":
        return dimension, slots, indices, [text_of(value, symbols) for value in values], "exact", symbols
    if any(isinstance(value, (bool, np.bool_)) for value in values):
        raise TypeError("components are numbers, not bools")
    numbers = floats(values).tolist()
    if not np.isfinite(numbers).all():
        raise ValueError("components should be finite")
    return dimension, slots, indices, numbers, "float", symbols


def _dense(components: Any, slots: str) -> tuple[NDArray[np.int64], list[Any], int]:
    """The indices and values of the nonzero components of an array, and its dimension."""
    if not isinstance(slots, str):
        raise TypeError(f"slots are a text of ^ and _, not {type(slots).__name__}")
    if isinstance(components, Tensor):
        raise TypeError("the components are a Tensor already")
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


def rows(tensor: Tensor) -> Iterator[Any]:
    """For each value of the first index, the tensor in which this index is fixed."""
    if not tensor.rank:
        raise TypeError("a tensor of rank 0 has no components to iterate over")
    return (tensor[(i, *[slice(None)] * (tensor.rank - 1))] for i in range(tensor.dimension))


def to_coo(tensor: Tensor, dtype: Any) -> tuple[NDArray[np.int64], NDArray[Any]]:
    """The indices and the values of the nonzero components, as arrays."""
    if np.dtype(dtype) != np.dtype(object):
        indices, numbers = tensor._coo()
        with np.errstate(invalid="ignore"):
            values: NDArray[Any] = numbers.astype(dtype, copy=False)
        # rejects floats of 2^53 and more, because they may be rounded integers
        if values.dtype.kind in "biu" and not ((values == numbers) & (abs(numbers) < 1 << 53)).all():
            raise TypeError(f"a component cannot be converted safely to {values.dtype}: use float or object")
        return indices, values
    values = np.empty(tensor.nnz, dtype=object)
    values[:] = tensor._values()
    return tensor._indices(), values


def to_numpy(tensor: Tensor, dtype: Any) -> NDArray[Any]:
    """The tensor as a dense array."""
    count = tensor.dimension**tensor.rank
    if count > _DENSE:
        raise MemoryError(f"{count} components are too many for a dense array: use to_coo()")
    if dtype is None:
        dtype = object if tensor.parameters else float
    indices, values = to_coo(tensor, dtype)
    if np.dtype(dtype) == np.dtype(object):
        dense: NDArray[Any] = np.full(tensor.shape, 0.0 if tensor.scalar == "float" else Fraction(0), dtype=object)
    else:
        dense = np.zeros(tensor.shape, dtype=dtype)
    if tensor.rank:
        dense[tuple(indices)] = values
    elif len(values):
        dense[()] = values[0]
    return dense


def __array__(tensor: Tensor, dtype: Any, copy: bool | None) -> NDArray[Any]:
    if copy is False:
        raise ValueError("a dense array of a sparse tensor is always a copy")
    # gives exact values to SymPy, which creates matrices from arrays; floats would not be exact
    caller = sys._getframe(1).f_globals.get("__name__", "")
    if dtype is None and tensor.scalar != "float" and caller.partition(".")[0] == "sympy":
        dtype = object
    return to_numpy(tensor, dtype)


def _sympy_(tensor: Tensor) -> Any:
    """Converts a tensor if ``sympy.sympify`` is called with it."""
    return to_sympy(tensor)


def to_sympy(tensor: Tensor) -> Any:
    """The tensor as a SymPy array; as an expression for rank 0, and as a matrix for rank 2."""
    sympy = optional("sympy", "sympy")

    found = {at: sympy.Float(value) if isinstance(value, float) else sympy.sympify(value) for at, value in tensor.items()}
    if tensor.rank == 0:
        return found.get((), sympy.Integer(0))
    if tensor.rank == 2:
        return sympy.ImmutableMatrix(*tensor.shape, lambda i, j: found.get((i, j), 0))
    if tensor.dimension**tensor.rank <= 10_000:
        every = itertools.product(range(tensor.dimension), repeat=tensor.rank)
        return sympy.ImmutableDenseNDimArray([found.get(at, 0) for at in every], tensor.shape)
    return sympy.ImmutableSparseNDimArray(found, tensor.shape)


def to_pandas(tensor: Tensor) -> Any:
    """The tensor as a DataFrame with one row for each nonzero component."""
    pd = optional("pandas", "pandas")

    indices, values = to_coo(tensor, float if tensor.scalar == "float" and not tensor.parameters else object)
    return pd.DataFrame({**dict(zip(tensor._letters, indices, strict=True)), "value": values})


def subs(tensor: Tensor, values: Mapping[Any, Scalar]) -> Tensor:
    """The tensor with parameters replaced by values."""
    if tensor.scalar == "float":
        return tensor
    if others := [name for name in values if not str(name).isidentifier()]:
        raise ValueError(f"{others[0]} is not a parameter: Geometry.subs gives values to functions")
    symbols = merged(tensor._symbols)
    written = {str(name): f"({text_of(value, symbols)})" for name, value in values.items()}
    return tensor._with_texts([replaced(text, written) for text in tensor._texts()], symbols)


def operands(
    expression: str, factors: Sequence[Tensor], named: Mapping[str, Tensor] | None
) -> tuple[str, list[tuple[str, Tensor]]]:
    """Inserts names for the factors without names into the expression of a contraction. Also returns all factors by name."""
    named = named or {}
    if not isinstance(expression, str):
        raise TypeError(f"the expression is a text, not {type(expression).__name__}")
    found: dict[str, Tensor] = {}
    if factors:
        left, arrow, right = expression.partition("->")
        # gives unused names to the factors without names
        taken = {*named, *re.findall(r"(?<![\w^_])[A-Za-z][A-Za-z0-9]*", left)}
        names = [letter for letter in _NAMES if letter not in taken]
        count = itertools.count()

        def name(match: re.Match[str]) -> str:
            at = next(count)
            if at >= len(names):
                raise ValueError(f"at most {len(names)} factors are given in order; give the others by name")
            if at >= len(factors):
                raise ValueError(f"{expression!r} has more factors than the {len(factors)} given")
            found[names[at]] = factors[at]
            return names[at] + match.group()

        expression = re.sub(r"(?<![\w^_])[\^_][\^_\w]*", name, left) + arrow + right
        if len(found) < len(factors):
            raise ValueError(f"{len(factors)} factors are given, but the expression has {len(found)}")
    found.update(named)
    for key, tensor in found.items():
        if not isinstance(tensor, Tensor):
            raise TypeError(f"the factor {key} should be a Tensor, not {type(tensor).__name__}")
    return expression, list(found.items())
