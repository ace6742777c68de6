"""Structure theory: reports, and constructions of algebras. The functions convert the arguments of methods of
:class:`affinor.LieAlgebra`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from affinor._engine import LieAlgebra, Tensor, evaluate
from affinor._scalars import index, is_matrix, number, value_of
from affinor.errors import InputError

__all__ = ["Report"]

Written = tuple[str, str, str]
"""A report as JSON, as text and as Markdown."""
T = TypeVar("T")
Read: TypeAlias = tuple[str, T, list[Tensor]]
"""The arguments of a construction: the name of the new algebra, other data, and tensors."""


class Report(dict[str, Any]):
    """Report of the command line as a dict, which contains its JSON document.

    ``print`` shows the report as the command line does. Numbers of the algebra are strings, such as ``"-1/2"``.
    ``docs/formats.md`` describes the keys.

    Attributes
    ----------
    text : str
        The report as plain text.
    markdown : str
        The report as Markdown.

    Examples
    --------
    >>> report = LieAlgebra("so3").info()
    >>> report["simple"], report["rank"]
    (True, 1)
    """

    def __init__(self, written: Written) -> None:
        document, self.text, self.markdown = written
        super().__init__(json.loads(document))

    def __str__(self) -> str:
        return self.text

    def _repr_markdown_(self) -> str:
        """The report as Markdown, which notebooks show."""
        return self.markdown


def subspace(algebra: LieAlgebra, rows: list[list[str]]) -> NDArray[Any]:
    """Converts the vectors of a basis to the rows of an array of numbers."""
    found = np.empty((len(rows), algebra.dimension), dtype=object)
    for at, _ in np.ndenumerate(found):
        found[at] = number(rows[at[0]][at[1]], algebra.symbols, False)
    return found


def names(given: str | Sequence[str]) -> list[str]:
    """The names in a string or a list."""
    return given.replace(",", " ").split() if isinstance(given, str) else [str(name) for name in given]


def _named(title: str) -> Callable[..., Read[None]]:
    """Creates the function that reads the arguments of a construction: vectors, or no arguments. ``title`` names the result."""

    def read(algebra: LieAlgebra, vectors: Iterable[Any] = ()) -> Read[None]:
        return title.format(algebra.name), None, _vectors(algebra, vectors)

    return read


subalgebra, generated, centralizer = _named("span in {}"), _named("subalgebra of {}"), _named("centralizer in {}")
derived_subalgebra, quotient = _named("derived algebra of {}"), _named("quotient of {}")
cotangent_algebra, complexification = _named("{} with its dual"), _named("complexification of {}")


def central_extension(algebra: LieAlgebra, cocycle: Any, centre: str | Sequence[str] | None) -> Read[list[str]]:
    """Reads the basis names of a centre, and a cocycle as constants ``w^i_jk``.

    Their indices number the basis of the algebra, followed by that of the centre.
    """
    basis, new, title = algebra.basis, names("z" if centre is None else centre), f"extension of {algebra.name}"
    labels, n, count = [*basis, *new], len(basis), len(new)
    if not new or len(set(labels)) != len(labels):
        raise ValueError(f"the centre {new} needs names that differ from each other and from {basis}")
    if isinstance(cocycle, str):
        # brackets whose values are in the centre always define an algebra
        tensor = type(algebra)(cocycle, basis=labels).structure
        return title, new, [tensor]
    if isinstance(cocycle, Mapping):
        entries = dict(cocycle)
    else:
        array = np.array(cocycle.tolist() if is_matrix(cocycle) else cocycle, dtype=object)
        if array.shape not in ((count, n, n), *([(n, n)] if count == 1 else [])):
            expected = f"({count}, {n}, {n})" + (f" or ({n}, {n})" if count == 1 else "")
            raise ValueError(f"a cocycle should be an array of the shape {expected}, not {array.shape}")
        entries = {at: value for at, value in np.ndenumerate(array) if value != 0}
    components = {}
    for key, value in entries.items():
        at = (0, *key) if len(key) == 2 and count == 1 else tuple(key)
        if len(at) != 3 or not (0 <= at[0] < count and all(0 <= index < n for index in at[1:])):
            raise IndexError(f"the index {key} of a cocycle is not (a, j, k) with a < {count} and j, k < {n}")
        components[n + at[0], at[1], at[2]] = value
    return title, new, [Tensor(components, "^__", dimension=n + count)]


def semidirect(algebra: LieAlgebra, on: Any, by: Iterable[Any] | None, basis: Any) -> LieAlgebra:
    """The semidirect sum for an action by matrices, or for the adjoint or the coadjoint action."""
    if by is not None:
        return algebra._semidirect(on, by, basis=basis)
    plain = {"adjoint": algebra.tangent_algebra, "coadjoint": algebra.cotangent_algebra}
    if not isinstance(on, str) or on not in plain:
        raise TypeError("give the matrices of the action, or one of 'adjoint' and 'coadjoint' without matrices")
    return plain[on](basis=basis)


def _semidirect(algebra: LieAlgebra, on: Any, by: Iterable[Any]) -> Read[list[str]]:
    """Reads the labels and the structure constants of an algebra, and the matrices that act on it."""
    other = on if isinstance(on, LieAlgebra) else type(algebra)(on)
    matrices = [matrix if isinstance(matrix, Tensor) else Tensor(matrix, "^_") for matrix in by]
    if other.scalar == "float":
        raise InputError(
            "a construction needs exact numbers, but the values are floats",
            "give exact numbers (int, Fraction, SymPy or texts) and leave out scalar='float'",
        )
    return f"{algebra.name} on {other.name}", other.basis, [other.structure, *matrices]


def tensor_product(algebra: LieAlgebra, units: str | Sequence[str], products: Any) -> Read[list[str]]:
    """Reads the names of the basis of a commutative algebra, and its products."""
    found = names(units)
    if not found or len(set(found)) != len(found):
        raise ValueError(f"the units {found} need names that differ from each other")
    tensor = products if isinstance(products, Tensor) else Tensor(products, "^__", dimension=len(found))
    return f"{algebra.name} with {' '.join(found)}", found, [tensor]


def truncated(algebra: LieAlgebra, order: int) -> Read[int]:
    """Reads the order of truncation."""
    order = index("the order", order)
    return f"{algebra.name}[t]/t^{order}", order, []


def tangent_algebra(algebra: LieAlgebra, basis: Any) -> LieAlgebra:
    """The algebra of the tangent bundle."""
    return algebra.truncated(2, basis=basis)


def contraction(algebra: LieAlgebra, weights: Iterable[int]) -> Read[list[int]]:
    """Reads the weights of a contraction."""
    return f"contraction of {algebra.name}", [index("a weight", weight) for weight in weights], []


def matrix(algebra: LieAlgebra, given: Any) -> Tensor:
    """Reads a matrix with the kind of scalars of the algebra."""
    return given if isinstance(given, Tensor) else Tensor(given, "^_", scalar=_scalar(algebra))


def vector(algebra: LieAlgebra, x: Any) -> Tensor:
    """Reads a vector, given by its components or by a string."""
    if isinstance(x, str):
        return _combination(algebra, x)
    vector = x if isinstance(x, Tensor) else Tensor(x, "^", scalar=_scalar(algebra))
    if vector.slots != "^" or vector.dimension != algebra.dimension:
        raise ValueError(f"a vector of this algebra has {algebra.dimension} components, not {vector.dimension}")
    return vector


def _vectors(algebra: LieAlgebra, given: Iterable[Any]) -> list[Tensor]:
    """Reads a list of vectors."""
    if isinstance(given, (str, Tensor)):
        raise TypeError("a list of vectors was expected, not a single vector")
    return [vector(algebra, x) for x in given]


def _scalar(algebra: LieAlgebra) -> str | None:
    """The argument ``scalar`` for tensors with the kind of scalars of the algebra."""
    return "float" if algebra.scalar == "float" else None


def _combination(algebra: LieAlgebra, text: str) -> Tensor:
    """Reads a vector from a string such as ``"e1 + 2*e2"``."""
    places = {label: at for at, label in enumerate(algebra.basis)}
    symbols, parameters = algebra.symbols, algebra.parameters

    def name(found: str) -> Any:
        if found in places:
            return Tensor({(places[found],): 1}, "^", dimension=len(places))
        if found in parameters:
            return value_of(found, symbols)
        raise ValueError(f"{found!r} is neither one of the vectors {', '.join(places)} nor a parameter of the algebra")

    def function(found: str, argument: Any) -> Any:
        raise ValueError(f"the vector {text!r} cannot contain the function {found}")

    vector = evaluate(text, Fraction, name, function)
    if not isinstance(vector, Tensor):
        raise ValueError(f"{text!r} is not a combination of the vectors {', '.join(places)}")
    return vector
