"""Structure theory of Lie algebras, and new algebras from old ones."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from affinor import _engine
from affinor._engine import Geometry as Components
from affinor._engine import Space
from affinor._engine import Tensor as Constants
from affinor._scalars import Symbols, index, is_matrix, merged, value_of
from affinor._source import Source
from affinor.errors import InputError
from affinor.tensor import Tensor

__all__ = ["Report"]

Basis = str | Sequence[str] | None
Written = tuple[str, str, str]
"""A report as JSON, as text and as Markdown."""


class Report(dict[str, Any]):
    """A JSON document of the command line as a dict; it prints as the command line prints it.

    Numbers of the algebra are texts, such as ``"-1/2"``. ``docs/formats.md`` describes the keys.
    """

    def __init__(self, written: Written) -> None:
        document, self.text, self.markdown = written
        super().__init__(json.loads(document))

    def __str__(self) -> str:
        return self.text

    def _repr_markdown_(self) -> str:
        return self.markdown


class Structured:
    """The structure of a Lie algebra, and the constructions that begin with it."""

    __slots__ = ("_found",)

    _engine: Components
    _space: Space
    _source: Source
    _found: tuple[Written, Report] | None

    @property
    def name(self) -> str:
        """The name."""
        return self._space.name

    @property
    def basis(self) -> list[str]:
        """The names of the basis vectors."""
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
    def parameters(self) -> list[str]:
        """The names of the parameters, sorted."""
        return self._space.parameters

    # -- structure -------------------------------------------------------------------------------------------------------

    def info(self) -> Report:
        """The structure as ``affinor info`` finds it: series, radical, Levi subalgebra, type, cohomology, ...

        The dict is the JSON document ``affinor.info/1``; ``print`` shows the table. The answers are exact; with parameters
        they hold for generic values. The computation is done once for an algebra.
        """
        return Report(self._answers[0])

    @property
    def _answers(self) -> tuple[Written, Report]:
        if self._found is None:
            if self.scalar == "float":
                raise InputError(
                    "structure theory is exact, and the structure constants are floats",
                    "give exact numbers (int, Fraction, SymPy or texts) and leave out scalar='float'",
                )
            written = _engine.info(self._space)
            self._found = written, Report(written)
        return self._found

    def _answer(self, key: str) -> Any:
        return self._answers[1][key]

    @property
    def is_abelian(self) -> bool:
        """Whether all brackets vanish."""
        return bool(self._answer("abelian"))

    @property
    def is_nilpotent(self) -> bool:
        """Whether the lower central series ends in zero."""
        return bool(self._answer("nilpotent"))

    @property
    def is_solvable(self) -> bool:
        """Whether the derived series ends in zero."""
        return bool(self._answer("solvable"))

    @property
    def is_unimodular(self) -> bool:
        """Whether ``tr ad_x = 0`` for all ``x``."""
        return bool(self._answer("unimodular"))

    @property
    def is_perfect(self) -> bool:
        """Whether ``[L, L] = L``."""
        return bool(self._answer("perfect"))

    @property
    def is_reductive(self) -> bool:
        """Whether the radical is the centre."""
        return bool(self._answer("reductive"))

    @property
    def is_semisimple(self) -> bool:
        """Whether the Killing form is not degenerate."""
        return bool(self._answer("semisimple"))

    @property
    def is_simple(self) -> bool | None:
        """Whether there is no proper ideal over the reals; None if it was not decided."""
        found: bool | None = self._answer("simple")
        return found

    @property
    def is_complete(self) -> bool | None:
        """Whether the centre is zero and all derivations are inner; None if it was not decided."""
        found: bool | None = self._answer("complete")
        return found

    @property
    def nilpotency_class(self) -> int | None:
        """The length of the lower central series; None if the algebra is not nilpotent."""
        found: int | None = self._answer("nilpotency_class")
        return found

    @property
    def derived_length(self) -> int | None:
        """The length of the derived series; None if the algebra is not solvable."""
        found: int | None = self._answer("derived_length")
        return found

    @property
    def derived_series(self) -> list[int]:
        """The dimensions of the derived series, until they are stable."""
        return list(self._answer("derived_series"))

    @property
    def lower_central_series(self) -> list[int]:
        """The dimensions of the lower central series, until they are stable."""
        return list(self._answer("lower_central_series"))

    @property
    def upper_central_series(self) -> list[int]:
        """The dimensions of the upper central series, until they are stable."""
        return list(self._answer("upper_central_series"))

    @property
    def centre(self) -> NDArray[Any]:
        """A basis of the centre, a row a vector: an object array of the shape (dimension of the centre, n)."""
        return self._subspace("centre")

    @property
    def radical(self) -> NDArray[Any]:
        """A basis of the solvable radical, a row a vector."""
        return self._subspace("radical")

    @property
    def nilradical(self) -> NDArray[Any]:
        """A basis of the nilradical, a row a vector."""
        return self._subspace("nilradical")

    @property
    def levi_subalgebra(self) -> NDArray[Any]:
        """A basis of a Levi subalgebra, a row a vector."""
        return self._subspace("levi")

    @property
    def cartan_subalgebra(self) -> NDArray[Any]:
        """A basis of a Cartan subalgebra, a row a vector."""
        return self._subspace("cartan_subalgebra")

    def _subspace(self, key: str) -> NDArray[Any]:
        rows = self._answer(key)["basis"]
        found = np.empty((len(rows), len(self.basis)), dtype=object)
        for i, row in enumerate(rows):
            for j, text in enumerate(row):
                found[i, j] = _number(text, self._source.symbols)
        return found

    @property
    def rank(self) -> int:
        """The dimension of a Cartan subalgebra."""
        return int(self._answer("rank"))

    @property
    def killing_signature(self) -> tuple[int, int, int] | None:
        """The numbers of positive, negative and zero squares of the Killing form; None if they depend on parameters."""
        found = self._answer("killing")["signature"]
        return None if found is None else (int(found[0]), int(found[1]), int(found[2]))

    @property
    def dynkin_type(self) -> str | None:
        """The type of the Levi subalgebra over the complex numbers, such as ``"A1 + A1"``; None without one."""
        found: str | None = self._answer("dynkin_type")
        return found

    @property
    def betti(self) -> list[int] | None:
        """The Betti numbers; None where they were not computed."""
        found = self._answer("betti")
        return None if found is None else list(found)

    @property
    def index(self) -> int:
        """The dimension minus the generic rank of ``f([x, y])``."""
        return int(self._answer("index"))

    @property
    def identification(self) -> str | None:
        """The name of an isomorphic algebra, where one is found."""
        found = self._answer("identification")
        return None if found is None else str(found["name"])

    def export(self, program: str) -> str:
        """The structure constants as input of another program: ``gap``, ``sage``, ``maple`` or ``sympy``."""
        return _engine.program(self._engine, program)

    # -- constructions ---------------------------------------------------------------------------------------------------

    def subalgebra(self, vectors: Iterable[Any], *, basis: Basis = None) -> Self:
        """The subalgebra with these vectors as its basis.

        A vector is its components, or a text such as ``"e1 + 2*e2"``. A span that is not closed raises ConstructionError.
        """
        return self._subalgebra("spanned", vectors, "span in", basis)

    def generated(self, vectors: Iterable[Any], *, basis: Basis = None) -> Self:
        """The subalgebra that vectors generate."""
        return self._subalgebra("generated", vectors, "subalgebra of", basis)

    def centralizer(self, vectors: Iterable[Any], *, basis: Basis = None) -> Self:
        """The subalgebra of all vectors that commute with these."""
        return self._subalgebra("centralizer", vectors, "centralizer in", basis)

    def derived_subalgebra(self, *, basis: Basis = None) -> Self:
        """The subalgebra ``[L, L]``."""
        return self._subalgebra("derived", [], "derived algebra of", basis)

    def _subalgebra(self, way: str, vectors: Iterable[Any], title: str, basis: Basis) -> Self:
        given = self._vectors(vectors)
        found = _engine.subalgebra(self._engine, way, [vector._engine for vector in given])
        return self._made(found, f"{title} {self.name}", basis, given)

    def quotient(self, vectors: Iterable[Any], *, basis: Basis = None) -> Self:
        """The quotient by the ideal that vectors span; a span that is no ideal raises ConstructionError."""
        given = self._vectors(vectors)
        found = _engine.quotient(self._engine, [vector._engine for vector in given])
        return self._made(found, f"quotient of {self.name}", basis, given)

    def central_extension(self, cocycle: Any, centre: str | Sequence[str] = "z", *, basis: Basis = None) -> Self:
        """The extension by a centre with the names ``centre``: ``[x, y]`` gets the further component ``omega(x, y)``.

        ``cocycle`` is a text such as ``"[e1, e2] = z"``; or ``omega[j, k]`` for one central vector, ``omega[a, j, k]`` for
        several, as an array or a dict. A form that is no cocycle raises ConstructionError.
        """
        names = centre.replace(",", " ").split() if isinstance(centre, str) else [str(name) for name in centre]
        labels = [*self.basis, *names]
        if not names or len(set(labels)) != len(labels):
            raise ValueError(f"the centre {names} needs names that differ from each other and from {self.basis}")
        tensor = self._cocycle(cocycle, labels, len(names))
        found = _engine.central_extension(self._engine, names, tensor._engine)
        return self._made(found, f"extension of {self.name}", basis, [tensor])

    def _cocycle(self, cocycle: Any, labels: list[str], count: int) -> Tensor:
        """The cocycle as constants ``w^i_jk`` over the algebra and the centre."""
        n = len(labels) - count
        if isinstance(cocycle, str):
            # brackets into the centre are always an algebra
            return self._read(cocycle, labels).structure
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
        return Tensor(components, "^__", dimension=n + count)

    def semidirect(self, on: Any, by: Iterable[Any] | None = None, *, basis: Basis = None) -> Self:
        """The semidirect sum with ``on``, an algebra on which this one acts: ``[e_j, v] = D_j v``.

        ``by`` has a matrix ``D_j`` for each basis vector of this algebra. ``semidirect("adjoint")`` acts on the algebra
        itself as a vector space, ``semidirect("coadjoint")`` on its dual space. Matrices that are no derivations, or no
        action, raise ConstructionError.
        """
        if by is None:
            plain = {"adjoint": self.tangent_algebra, "coadjoint": self.cotangent_algebra}
            if not isinstance(on, str) or on not in plain:
                raise TypeError("give the matrices of the action, or one of 'adjoint' and 'coadjoint' without matrices")
            return plain[on](basis=basis)
        other = on if isinstance(on, Structured) else self._read(on)
        matrices = [matrix if isinstance(matrix, Tensor) else Tensor(matrix, "^_") for matrix in by]
        found = _engine.semidirect(self._engine, other._engine, [matrix._engine for matrix in matrices])
        return self._made(found, f"{self.name} on {other.name}", basis, matrices, other._source.symbols)

    def cotangent_algebra(self, *, basis: Basis = None) -> Self:
        """The semidirect sum with the dual space, by the coadjoint action."""
        return self._made(_engine.with_dual(self._engine), f"{self.name} with its dual", basis)

    def tensor_product(self, units: str | Sequence[str], products: Any, *, basis: Basis = None) -> Self:
        """The tensor product with a commutative algebra: ``[x u_a, y u_b] = [x, y] (u_a u_b)``.

        ``units`` are the names of its basis. ``products[d, a, b]`` is the component of ``u_a u_b`` along ``u_d``, as an array
        or a dict. Products that do not commute or are not associative raise ConstructionError.
        """
        names = units.replace(",", " ").split() if isinstance(units, str) else [str(name) for name in units]
        if not names or len(set(names)) != len(names):
            raise ValueError(f"the units {names} need names that differ from each other")
        tensor = products if isinstance(products, Tensor) else Tensor(products, "^__", dimension=len(names))
        found = _engine.tensor_product(self._engine, names, tensor._engine)
        return self._made(found, f"{self.name} with {' '.join(names)}", basis, [tensor])

    def truncated(self, order: int, *, basis: Basis = None) -> Self:
        """Polynomials in ``t`` with values in this algebra and ``t^order = 0``."""
        order = index("the order", order)
        return self._made(_engine.truncated(self._engine, order), f"{self.name}[t]/t^{order}", basis)

    def tangent_algebra(self, *, basis: Basis = None) -> Self:
        """The algebra of the tangent bundle: the semidirect sum with itself as a vector space, by the adjoint action."""
        return self.truncated(2, basis=basis)

    def complexification(self, *, basis: Basis = None) -> Self:
        """The complexification, as a real algebra of twice the dimension: ``x`` and ``i x``."""
        return self._made(_engine.complexification(self._engine), f"complexification of {self.name}", basis)

    def contraction(self, weights: Sequence[int], *, basis: Basis = None) -> Self:
        """The Inonu-Wigner contraction: ``e_i`` is scaled by ``t^w_i``, in the limit of ``t`` to 0.

        Weights for which there is no limit raise ConstructionError.
        """
        integers = [index("a weight", weight) for weight in weights]
        return self._made(_engine.contraction(self._engine, integers), f"contraction of {self.name}", basis)

    def _made(
        self,
        found: tuple[list[str], Constants],
        name: str,
        basis: Basis,
        given: Iterable[Tensor] = (),
        symbols: Symbols | None = None,
    ) -> Self:
        labels, engine = found
        if basis is not None:
            labels = basis.replace(",", " ").split() if isinstance(basis, str) else [str(label) for label in basis]
        known = merged(self._source.symbols, symbols or {}, *(tensor._symbols for tensor in given))
        return self._structured(Tensor._of(engine, known), name, labels)

    @classmethod
    def _read(cls, space: Any, basis: list[str] | None = None) -> Self:
        """The algebra of a name, brackets or constants."""
        raise NotImplementedError

    @property
    def structure(self) -> Tensor:
        """The structure constants ``c^i_jk``."""
        raise NotImplementedError

    def _structured(self, structure: Tensor, name: str, labels: list[str] | None) -> Self:
        """The algebra of these constants, with the scalar and the tolerance of this one."""
        raise NotImplementedError

    # -- vectors ---------------------------------------------------------------------------------------------------------

    def _vector(self, x: Any) -> Tensor:
        if isinstance(x, str):
            return self._combination(x)
        vector = x if isinstance(x, Tensor) else Tensor(x, "^", scalar="float" if self.scalar == "float" else None)
        if vector.slots != "^" or vector.dimension != self.dimension:
            raise ValueError(f"a vector of this algebra has {self.dimension} components, not {vector.dimension}")
        return vector

    def _vectors(self, vectors: Iterable[Any]) -> list[Tensor]:
        if isinstance(vectors, (str, Tensor)):
            raise TypeError("a list of vectors was expected, not a single one")
        return [self._vector(vector) for vector in vectors]

    def _combination(self, text: str) -> Tensor:
        """A vector from a text such as ``"e1 + 2*e2"``."""
        places = {label: at for at, label in enumerate(self.basis)}
        symbols, parameters = self._source.symbols, self.parameters

        def name(found: str) -> Any:
            if found in places:
                return Tensor({(places[found],): 1}, "^", dimension=len(places))
            if found in parameters:
                return value_of(found, symbols)
            raise ValueError(f"{found!r} is neither one of the vectors {', '.join(places)} nor a parameter of the algebra")

        def function(found: str, argument: Any) -> Any:
            raise ValueError(f"the function {found} has no place in the vector {text!r}")

        vector = _engine.evaluate(text, Fraction, name, function)
        if not isinstance(vector, Tensor):
            raise ValueError(f"{text!r} is no combination of the vectors {', '.join(places)}")
        return vector


def _number(text: str, symbols: Symbols) -> Any:
    try:
        return Fraction(text)
    except ValueError:
        return value_of(text, symbols)
