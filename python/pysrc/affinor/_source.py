"""Converts names, paths, brackets, dicts, structure constants and matrices to sources, from which the engine makes algebras."""

from __future__ import annotations

import json
import numbers
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from affinor._engine import Geometry, LieAlgebra, Source, Tensor
from affinor._scalars import (
    Scalar,
    Symbols,
    document,
    index,
    integers,
    is_matrix,
    merged,
    names_in,
    replaced,
    text_of,
    unmasked,
)

Names = str | Sequence[str] | None


def source_of(
    space: Any,
    *,
    basis: Names = None,
    scalar: str = "exact",
    tolerance: float | None = None,
) -> Source:
    """Converts a name, a path, brackets as strings, a dict, or structure constants to a source."""
    if basis is not None and isinstance(space, (LieAlgebra, Mapping)):
        raise TypeError(f"this {type(space).__name__} has a basis: give other names with from_structure, or in the dict")
    if isinstance(space, Source):
        return space
    if isinstance(space, LieAlgebra):
        source = space._source
        if scalar == "exact" and tolerance is None:
            return source
        # if the algebra is in floats, the source remains in floats
        scalar = source.scalar if scalar == "exact" else scalar
        return Source(source.arguments, source.symbols, scalar, source.tolerance if tolerance is None else tolerance)
    if isinstance(space, os.PathLike):
        space = os.fspath(space)
    if isinstance(space, str):
        if basis is not None:
            return Source({"space": None, "basis": " ".join(names_of(basis)), "brackets": _brackets(space)}, {}, scalar, tolerance)
        return Source({"space": space}, {}, scalar, tolerance)
    if isinstance(space, (list, tuple)) and space and all(isinstance(text, str) for text in space):
        if basis is None:
            raise TypeError("brackets need the names of a basis: basis='x y z'")
        return Source({"space": None, "basis": " ".join(names_of(basis)), "brackets": list(space)}, {}, scalar, tolerance)
    symbols: Symbols = {}
    if isinstance(space, Mapping):
        keys = document(space, symbols)
        if symbols:
            declared = [str(name) for name in keys.get("parameters", [])]
            coordinates = keys.get("chart", {}).get("coordinates", []) if isinstance(keys.get("chart"), dict) else []
            extra = [name for name in sorted(symbols) if name not in declared and name not in coordinates]
            keys["parameters"] = declared + extra
        name = str(keys.get("name", "definition"))
        return Source({"space": None, "definition": (name, json.dumps(keys))}, symbols, scalar, tolerance)
    if isinstance(space, Geometry):
        raise TypeError("a LieAlgebra or its definition was expected, not a Geometry: pass its algebra")
    if space is None or isinstance(space, numbers.Number):
        raise TypeError(f"a space is a name, a path, brackets, a dict, structure constants or a LieAlgebra, not {type(space).__name__}")
    return from_structure(space, basis=basis, scalar=scalar, tolerance=tolerance)


def _brackets(text: str) -> list[str]:
    """Replaces the commas between brackets by semicolons, so that positions in the text do not change."""
    return [re.sub(r",(?![^\[]*\])", ";", text)]


def names_of(basis: str | Sequence[str]) -> list[str]:
    """The names in a string or a list."""
    if isinstance(basis, str):
        return basis.replace(",", " ").split()
    if not isinstance(basis, Iterable):
        raise TypeError(f"a basis is a text or a list of names, not {type(basis).__name__}")
    return [str(name) for name in basis]


def _definition(
    keys: dict[str, Any], texts: Iterable[str], symbols: Symbols, scalar: str, tolerance: float | None, *without: str
) -> Source:
    """The source of a definition. The names in ``texts`` become its parameters, except the names in ``without``."""
    parameters = names_in(texts, without=without)
    if parameters:
        keys["parameters"] = parameters
    keys.setdefault("name", "algebra")
    return Source({"space": None, "definition": (keys["name"], json.dumps(keys))}, symbols, scalar, tolerance)


def from_structure(
    constants: Any,
    *,
    basis: Names = None,
    name: str | None = None,
    dimension: int | None = None,
    scalar: str = "exact",
    tolerance: float | None = None,
) -> Source:
    """The source of an algebra with structure constants ``c[i, j, k]``, in any form that :meth:`LieAlgebra.from_structure` accepts."""
    if dimension is not None:
        dimension = index("the dimension", dimension)
    places, values, found = _entries(constants, dimension)
    indices = [tuple(index("an index", i) for i in at) for at in places]
    labels = None if basis is None else names_of(basis)
    if None not in (found, dimension) and found != dimension:
        raise ValueError(f"the structure constants have the dimension {found}, not {dimension}")
    n = found if dimension is None else dimension
    if labels is not None and n is not None and len(labels) != n:
        raise ValueError(f"{len(labels)} names for a basis of dimension {n}")
    if n is None:
        n = len(labels) if labels is not None else 1 + max((max(at) for at in indices), default=-1)
    symbols: Symbols = dict(constants._symbols) if isinstance(constants, Tensor) else {}
    texts = [text_of(value, symbols, floats=scalar == "float") for value in values]
    for at in indices:
        if len(at) != 3 or not all(0 <= i < n for i in at):
            raise IndexError(f"the index {tuple(at)} is not a triple in 0..{n - 1}")
    # for [e_j, e_k] = c^i_jk e_i, files contain rows [j, k, i, value] with indices from 1
    rows = [[j + 1, k + 1, i + 1, text] for (i, j, k), text in zip(indices, texts, strict=True) if text != "0"]
    keys: dict[str, Any] = {"basis": labels} if labels is not None else {"dimension": n}
    keys["structure_constants"] = rows
    if name is not None:
        keys["name"] = name
    return _definition(keys, texts, symbols, scalar, tolerance)


def _entries(constants: Any, dimension: int | None) -> tuple[list[Any], list[Any], int | None]:
    """Reads the indices, the values and the dimension of structure constants."""
    if isinstance(constants, Tensor):
        if constants.slots != "^__":
            raise ValueError(f"structure constants should have the slots '^__', not {constants.slots!r}")
        entries = constants._values() if constants.scalar == "float" else constants._texts()
        return constants._indices().T.tolist(), entries, constants.dimension
    if hasattr(constants, "tocoo") or hasattr(constants, "coords"):
        return _sparse(constants)
    if is_matrix(constants):
        constants = constants.tolist()
    if isinstance(constants, Mapping):
        return [tuple(at) for at in constants], list(constants.values()), None
    if isinstance(constants, tuple) and len(constants) == 2:
        indices, values = np.asarray(unmasked(constants[0])), np.asarray(unmasked(constants[1]))
        if indices.ndim != 2 or indices.shape[0] != 3 or indices.shape[1:] != values.shape:
            raise ValueError(
                "a COO pair has indices of the shape (3, count) and as many values, "
                f"not {indices.shape} and {values.shape}"
            )
        return integers("indices", indices).T.tolist(), list(values), None
    if isinstance(constants, (list, tuple)) and constants and isinstance(constants[0], (list, tuple)):
        first = constants[0]
        if len(first) == 4 and not isinstance(first[0], (list, tuple, np.ndarray)):
            return [tuple(row[:3]) for row in constants], [row[3] for row in constants], None
    constants = unmasked(constants)
    array = constants if isinstance(constants, np.ndarray) else np.asarray(constants, dtype=object)
    if array.ndim != 3 or len(set(array.shape)) != 1:
        raise ValueError(f"structure constants should be an array of the shape (n, n, n), not {array.shape}")
    if array.dtype.kind not in "iufO":
        raise TypeError(f"structure constants are numbers or expressions, not {array.dtype}")
    places = np.nonzero(array != 0)
    return np.array(places).T.tolist(), list(array[places]), array.shape[0]


def _sparse(constants: Any) -> tuple[list[Any], list[Any], int | None]:
    """Reads a sparse array of SciPy of the shape (n, n, n), or (n, n*n) with the column ``j*n + k``."""
    coo = constants.tocoo(copy=True) if hasattr(constants, "tocoo") else constants
    if hasattr(coo, "sum_duplicates"):
        coo.sum_duplicates()
    shape = tuple(coo.shape)
    if len(shape) == 3 and len(set(shape)) == 1:
        return np.array(coo.coords).T.tolist(), list(coo.data), shape[0]
    if len(shape) == 2 and shape[1] == shape[0] ** 2:
        n = shape[0]
        places = [(int(i), int(c) // n, int(c) % n) for i, c in zip(coo.row, coo.col, strict=True)]
        return places, list(coo.data), n
    raise ValueError(f"sparse structure constants have the shape (n, n, n) or (n, n*n), not {shape}")


def from_matrices(
    matrices: Iterable[Any],
    *,
    basis: Names = None,
    name: str | None = None,
    scalar: str = "exact",
    tolerance: float | None = None,
) -> Source:
    """The source of an algebra with a basis of matrices, in any form that :meth:`LieAlgebra.from_matrices` accepts."""
    symbols: Symbols = {}
    all_rows = []
    if not isinstance(matrices, Iterable):
        raise TypeError(f"matrices are a list of matrices, not {type(matrices).__name__}")
    for at, matrix in enumerate(matrices):
        rows = matrix.tolist() if hasattr(matrix, "tolist") else matrix
        if not isinstance(rows, (list, tuple)) or not all(isinstance(row, (list, tuple)) for row in rows):
            raise TypeError(f"matrix {at} should be a matrix, not {type(matrix).__name__}")
        all_rows.append(
            [[text_of(entry, symbols, floats=scalar == "float", imaginary=True) for entry in row] for row in rows]
        )
    keys: dict[str, Any] = {"matrices": all_rows}
    if basis is not None:
        keys["basis"] = names_of(basis)
    if name is not None:
        keys["name"] = name
    texts = [text for rows in all_rows for row in rows for text in row]
    return _definition(keys, texts, symbols, scalar, tolerance, "i")


def structured(structure: Tensor, name: str, basis: Names, tolerance: float | None) -> Source:
    """The source of an algebra that a construction returns. Names with primes are left out, because they cannot be read again."""
    labels = None if basis is None else names_of(basis)
    return from_structure(
        structure,
        basis=None if labels is None or any("'" in label for label in labels) else labels,
        name=name,
        dimension=structure.dimension,
        scalar="float" if structure.scalar == "float" else "exact",
        tolerance=tolerance,
    )


def settings(values: Mapping[Any, Scalar], source: Source) -> tuple[list[tuple[str, str]], Symbols]:
    """Adds new values of parameters to a source. They are substituted in the earlier values. Returns all values and all symbols."""
    symbols = merged(source.symbols)
    texts = {str(name): text_of(value, symbols) for name, value in values.items()}
    before: dict[str, str] = dict(source.arguments["values"])
    brought = names_in(before.values())
    inner = {name: f"({text})" for name, text in texts.items()}
    settled = [(name, replaced(text, inner)) for name, text in before.items()]
    # drops the value of a name that occurs only in the earlier values, because it was substituted there
    own = {*source.names(False)[0]}.difference(before) if before else texts.keys()
    return settled + [(name, text) for name, text in texts.items() if name in own or name not in brought], symbols
