"""Lie algebras: from names, brackets, structure constants, matrices and definition files."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from affinor import _engine
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
from affinor._source import Source
from affinor.errors import MathematicsError
from affinor.group import Group
from affinor.structure import Structured
from affinor.tensor import Tensor

__all__ = ["Check", "LieAlgebra", "catalogue"]


def source_of(
    space: Any,
    *,
    basis: str | Sequence[str] | None = None,
    scalar: str = "exact",
    tolerance: float | None = None,
) -> Source:
    """The source of a name, a path, brackets as text, a dict, or structure constants."""
    if basis is not None and isinstance(space, (LieAlgebra, Mapping)):
        raise TypeError(f"this {type(space).__name__} has a basis: give other names with from_structure, or in the dict")
    if isinstance(space, LieAlgebra):
        source = space._source
        if scalar == "exact" and tolerance is None:
            return source
        # floats stay floats
        scalar = source.scalar if scalar == "exact" else scalar
        return Source(source.request, source.symbols, scalar, source.tolerance if tolerance is None else tolerance)
    if isinstance(space, os.PathLike):
        space = os.fspath(space)
    if isinstance(space, str):
        if basis is not None:
            names = " ".join(_labels(basis) or [])
            return Source({"basis": names, "brackets": _brackets(space)}, {}, scalar, tolerance)
        return Source({"space": space}, {}, scalar, tolerance)
    if isinstance(space, (list, tuple)) and space and all(isinstance(text, str) for text in space):
        if basis is None:
            raise TypeError("brackets need the names of a basis: basis='x y z'")
        names = " ".join(_labels(basis) or [])
        return Source({"basis": names, "brackets": list(space)}, {}, scalar, tolerance)
    symbols: Symbols = {}
    if isinstance(space, Mapping):
        keys = document(space, symbols)
        if symbols:
            declared = [str(name) for name in keys.get("parameters", [])]
            coordinates = keys.get("chart", {}).get("coordinates", []) if isinstance(keys.get("chart"), dict) else []
            extra = [name for name in sorted(symbols) if name not in declared and name not in coordinates]
            keys["parameters"] = declared + extra
        name = str(keys.get("name", "definition"))
        return Source({"definition": (name, json.dumps(keys))}, symbols, scalar, tolerance)
    return structure_source(space, basis=basis, scalar=scalar, tolerance=tolerance)


def _brackets(text: str) -> list[str]:
    """The brackets of a text, with semicolons for the commas between brackets: places in it stay the same."""
    return [re.sub(r",(?![^\[]*\])", ";", text)]


def _labels(basis: str | Sequence[str] | None) -> list[str] | None:
    if basis is None:
        return None
    if isinstance(basis, str):
        return basis.replace(",", " ").split()
    if not isinstance(basis, Iterable):
        raise TypeError(f"a basis is a text or a list of names, not {type(basis).__name__}")
    return [str(name) for name in basis]


def _definition(
    keys: dict[str, Any], texts: Iterable[str], symbols: Symbols, scalar: str, tolerance: float | None, *without: str
) -> Source:
    """The source of a definition whose values are these texts."""
    parameters = names_in(texts, without=without)
    if parameters:
        keys["parameters"] = parameters
    keys.setdefault("name", "algebra")
    return Source({"definition": (keys["name"], json.dumps(keys))}, symbols, scalar, tolerance)


def structure_source(
    constants: Any,
    *,
    basis: str | Sequence[str] | None = None,
    name: str | None = None,
    dimension: int | None = None,
    scalar: str = "exact",
    tolerance: float | None = None,
) -> Source:
    """The source of structure constants ``c[i, j, k]``, in any of the forms of :meth:`LieAlgebra.from_structure`."""
    if dimension is not None:
        dimension = index("the dimension", dimension)
    places, values, found = _entries(constants, dimension)
    indices = [tuple(index("an index", i) for i in at) for at in places]
    labels = _labels(basis)
    if None not in (found, dimension) and found != dimension:
        raise ValueError(f"the structure constants have the dimension {found}, not {dimension}")
    n = found if dimension is None else dimension
    if labels is not None and n is not None and len(labels) != n:
        raise ValueError(f"{len(labels)} names for a basis of dimension {n}")
    if n is None:
        n = len(labels) if labels is not None else 1 + max((max(at) for at in indices), default=-1)
    symbols: Symbols = {}
    texts = [text_of(value, symbols, floats=scalar == "float") for value in values]
    for at in indices:
        if len(at) != 3 or not all(0 <= i < n for i in at):
            raise IndexError(f"the index {tuple(at)} is not a triple in 0..{n - 1}")
    # [e_j, e_k] = c^i_jk e_i; files count from 1 and write [j, k, i, value]
    rows = [[j + 1, k + 1, i + 1, text] for (i, j, k), text in zip(indices, texts, strict=True) if text != "0"]
    keys: dict[str, Any] = {"basis": labels} if labels is not None else {"dimension": n}
    keys["structure_constants"] = rows
    if name is not None:
        keys["name"] = name
    return _definition(keys, texts, symbols, scalar, tolerance)


def _entries(constants: Any, dimension: int | None) -> tuple[list[Any], list[Any], int | None]:
    """Indices, values and dimension of structure constants."""
    if isinstance(constants, Tensor):
        if constants.slots != "^__":
            raise ValueError(f"structure constants have the slots '^__', not {constants.slots!r}")
        indices, values = constants.to_coo(float if constants.scalar == "float" else object)
        return indices.T.tolist(), list(values), constants.dimension
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
    """Entries of a sparse array of SciPy: (n, n, n), or (n, n n) with the column ``j n + k``."""
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


class LieAlgebra(Structured):
    """A Lie algebra with a basis; the Jacobi identity is checked.

    ``LieAlgebra("so3")`` takes a name of the catalogue, a sum of names (``"so3+R^3"``), or the path of a definition file;
    ``LieAlgebra("[x,y]=z, [y,z]=x", basis="x y z")`` brackets, in one text or in a list;
    ``LieAlgebra({"basis": [...], "brackets": ...})`` the keys of a definition file; ``LieAlgebra(array)`` structure constants
    (:meth:`from_structure`). A file is read once: what is made of the algebra later does not read it again.

    Structure constants are ``c[i, j, k]``, with ``[e_j, e_k] = c^i_jk e_i``. ``scalar`` is ``"exact"`` (with parameters
    ``symbolic``) or ``"float"``; there a ``tolerance``, relative to the terms of a sum, says what counts as zero.
    """

    __slots__ = ("_engine", "_source", "_space")

    def __init__(
        self,
        space: Any,
        *,
        basis: str | Sequence[str] | None = None,
        scalar: str = "exact",
        tolerance: float | None = None,
    ) -> None:
        self._set(source_of(space, basis=basis, scalar=scalar, tolerance=tolerance))

    def _set(self, source: Source) -> None:
        self._source, self._found = source, None
        self._space = source.space()
        self._engine = self._space.algebra(source.scalar, source.tolerance)

    @classmethod
    def _of(cls, source: Source) -> Self:
        algebra = cls.__new__(cls)
        algebra._set(source)
        return algebra

    @classmethod
    def from_structure(
        cls,
        constants: Any,
        *,
        basis: str | Sequence[str] | None = None,
        name: str | None = None,
        dimension: int | None = None,
        scalar: str = "exact",
        tolerance: float | None = None,
    ) -> LieAlgebra:
        """The algebra with the structure constants ``c[i, j, k]``, ``[e_j, e_k] = c^i_jk e_i``, indices from 0.

        They are an array of the shape (n, n, n); a pair of indices (3, count) and values; a sparse array of SciPy of the
        shape (n, n, n), or (n, n*n) with the column ``j*n + k``; a list of tuples ``(i, j, k, value)``; a dict; a Tensor.
        Each pair may be given in one order or in both.
        """
        return cls._of(
            structure_source(
                constants, basis=basis, name=name, dimension=dimension, scalar=scalar, tolerance=tolerance
            )
        )

    @classmethod
    def from_matrices(
        cls,
        matrices: Iterable[Any],
        *,
        basis: str | Sequence[str] | None = None,
        name: str | None = None,
        scalar: str = "exact",
        tolerance: float | None = None,
    ) -> LieAlgebra:
        """The algebra of a basis of matrices under the commutator, over the reals.

        Matrices are arrays of NumPy, matrices of SymPy or nested lists; entries may be complex.
        """
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
        labels = _labels(basis)
        keys: dict[str, Any] = {"matrices": all_rows}
        if labels is not None:
            keys["basis"] = labels
        if name is not None:
            keys["name"] = name
        texts = [text for rows in all_rows for row in rows for text in row]
        return cls._of(_definition(keys, texts, symbols, scalar, tolerance, "i"))

    # -- what it is ------------------------------------------------------------------------------------------------------

    @property
    def symbols(self) -> Symbols:
        """The symbols of SymPy that were given, by name."""
        return dict(self._source.symbols)

    @property
    def structure(self) -> Tensor:
        """The structure constants ``c^i_jk``."""
        return self._quantity("structure")

    @property
    def killing_form(self) -> Tensor:
        """The Killing form ``K_ij = tr(ad_i ad_j)``."""
        return self._quantity("killing")

    def _quantity(self, key: str) -> Tensor:
        found = self._engine.quantity(key)
        if found is None:
            raise MathematicsError(f"{key} is not defined here")
        return Tensor._of(found, self._source.symbols, *DESCRIPTIONS[key])

    # -- what it does ----------------------------------------------------------------------------------------------------

    def ad(self, x: ArrayLike | Any) -> Tensor:
        """The matrix of ``[x, .]``: ``(ad_x)^i_k = c^i_jk x^j``."""
        return self.structure.contract("^i_jk ^j -> ^i_k", self._vector(x))

    def bracket(self, x: ArrayLike | Any, y: ArrayLike | Any) -> Tensor:
        """The bracket of two vectors by their components."""
        return self.structure.contract("^i_jk ^j ^k -> ^i", self._vector(x), self._vector(y))

    def direct_sum(self, other: LieAlgebra) -> LieAlgebra:
        """The direct sum, in the basis of this algebra followed by that of the other."""
        if not isinstance(other, LieAlgebra):
            raise TypeError(f"a LieAlgebra was expected, not {type(other).__name__}")
        mine, theirs = self._source, other._source
        names = [source.request.get("space") for source in (mine, theirs)]
        plain = all(name and "@" not in name and not name.endswith((".toml", ".json")) for name in names)
        if plain and len(mine.request) == len(theirs.request) == 1 and mine.scalar == theirs.scalar:
            return LieAlgebra._of(mine.with_(space=f"{names[0]}+{names[1]}"))
        parts = [self._engine, other._engine]
        if {part.scalar for part in parts} == {"exact", "symbolic"}:
            labels, structure = _mixed_sum(self, other)
        else:
            labels, engine = parts[0].direct_sum(parts[1])
            structure = Tensor._of(engine, merged(mine.symbols, theirs.symbols))
        return self._structured(structure, f"{self.name}+{other.name}", labels)

    def __add__(self, other: object) -> LieAlgebra:
        return self.direct_sum(other) if isinstance(other, LieAlgebra) else NotImplemented

    def change_basis(self, matrix: Any, *, basis: str | Sequence[str] | None = None) -> LieAlgebra:
        """The same algebra in the basis ``e'_a = A^i_a e_i``: column ``a`` of the matrix has the components of ``e'_a``."""
        scalar = "float" if self.scalar == "float" else None
        change = matrix if isinstance(matrix, Tensor) else Tensor(matrix, "^_", scalar=scalar)
        engine = self._engine.change_basis(change._engine)
        structure = Tensor._of(engine, merged(self._source.symbols, change._symbols))
        return self._structured(structure, self.name, _labels(basis))

    @classmethod
    def _read(cls, space: Any, basis: list[str] | None = None) -> Self:
        return cls(space, basis=basis)

    def _structured(self, structure: Tensor, name: str, labels: list[str] | None) -> Self:
        tidy = None if labels is None or any("'" in label for label in labels) else labels
        source = structure_source(
            structure,
            basis=tidy,
            name=name,
            dimension=structure.dimension,
            scalar="float" if structure.scalar == "float" else "exact",
            tolerance=self._source.tolerance,
        )
        source.symbols = merged(source.symbols, structure._symbols)
        return type(self)._of(source)

    def subs(self, values: Mapping[Any, Scalar]) -> LieAlgebra:
        """The algebra with parameters replaced, by name or by symbol."""
        if not values:
            return self
        text, symbols = settings(values, self._source)
        request, _, scalar, tolerance = self._source.of()
        return LieAlgebra._of(Source({**request, "set": text}, symbols, scalar, tolerance))

    def group(self) -> Group:
        """A group with this algebra, in its basis."""
        return Group._of(self._source.request)

    def check(self) -> list[Check]:
        """The checks of the certificate."""
        return checks(self._source)

    # -- equality and display --------------------------------------------------------------------------------------------

    def __eq__(self, other: object) -> bool:
        """Equal names of the basis vectors and equal structure constants."""
        if not isinstance(other, LieAlgebra):
            return NotImplemented
        return self.basis == other.basis and self.structure == other.structure

    def __hash__(self) -> int:
        return hash((tuple(self.basis), self.structure))

    def __copy__(self) -> LieAlgebra:
        return self

    def __deepcopy__(self, memo: Any) -> LieAlgebra:
        return self

    def __reduce__(self) -> Any:
        return _restore, self._source.of()

    def __repr__(self) -> str:
        return f"<LieAlgebra {self.name}, dimension {self.dimension}, {self.scalar}>"

    def __str__(self) -> str:
        """The nonzero brackets, one a line."""
        return self._engine.brackets() or ""

    def _repr_latex_(self) -> str:
        return self.structure._repr_latex_()


def _mixed_sum(a: LieAlgebra, b: LieAlgebra) -> tuple[list[str] | None, Tensor]:
    n = a.dimension
    entries = dict(a.structure.items())
    entries.update({(i + n, j + n, k + n): value for (i, j, k), value in b.structure.items()})
    return None, Tensor(entries, "^__", dimension=n + b.dimension)


def _restore(*parts: Any) -> LieAlgebra:
    return LieAlgebra._of(Source(*parts))


def settings(values: Mapping[Any, Scalar], source: Source) -> tuple[str, Symbols]:
    """Values of parameters as the command line takes them, after those that were set before and in them."""
    symbols = merged(source.symbols)
    texts = {str(name): text_of(value, symbols) for name, value in values.items()}
    before = source.values()
    brought = names_in(before.values())
    inner = {name: f"({text})" for name, text in texts.items()}
    settled = [f"{name}={replaced(text, inner)}" for name, text in before.items()]
    # a name that only the values before brought in is replaced in them
    own = {*source.space(set=None).parameters}.difference(before) if before else texts.keys()
    settled += [f"{name}={text}" for name, text in texts.items() if name in own or name not in brought]
    return ",".join(settled), symbols


DESCRIPTIONS: dict[str, tuple[str, str, str, str]] = {
    key: (symbol, latex, title, letters) for key, symbol, latex, title, letters in _engine.quantities()
}
"""Symbol, LaTeX symbol, title and letters of each quantity."""


class Check:
    """A check of a certificate: what was checked, whether it holds, and the witness if it fails."""

    __slots__ = ("detail", "indices", "name", "ok", "residual")

    def __init__(
        self, name: str, ok: bool, detail: str, witness: tuple[list[int], list[tuple[int, str]]] | None
    ) -> None:
        self.name, self.ok, self.detail = name, ok, detail
        self.indices: list[int] | None = None if witness is None else witness[0]
        self.residual: list[tuple[int, str]] | None = None if witness is None else witness[1]

    def __bool__(self) -> bool:
        return self.ok

    def __repr__(self) -> str:
        return f"<Check {self.name}: {'ok' if self.ok else 'FAILS'}, {self.detail}>"


def checks(source: Source) -> list[Check]:
    """The checks of a source with its connection and metric."""
    return [Check(*entry) for entry in source.space().check(source.scalar, source.tolerance)]


def catalogue(pattern: str = "") -> list[tuple[str, str, str]]:
    """The families of named algebras that contain a text: pattern, description, example."""
    pattern = pattern.lower()
    return [row for row in _engine.catalogue() if any(pattern in cell.lower() for cell in row)]
