"""Representations of reductive Lie algebras, and coupling coefficients of spins."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from affinor._engine import _coupling, _representation, _representation_matrices
from affinor.structure import Report

__all__ = ["Representation", "clebsch_gordan", "wigner_3j", "wigner_6j"]

Spin: TypeAlias = int | float | str | Fraction


class Representation:
    """Irreducible representation of a reductive Lie algebra over the complex numbers.

    Parameters
    ----------
    algebra : str
        A sum of simple and abelian algebras, such as ``"E6"``, ``"SU(5)"`` or ``"SU(3)xSU(2)xU(1)"``.
    weight : str or sequence of int
        Dynkin labels, numbered as in Bourbaki, then charges; or a name such as ``"5bar"``.

    Attributes
    ----------
    algebra : str
        The type of the algebra.
    labels : tuple of int
        Dynkin labels of the highest weight, then charges.
    name : str or None
        The name of physics; None for large dimensions.
    dimension : int
        Dimension of the representation.
    index : list of int
        Dynkin index for each simple factor; 1 for the defining representation of SU(n).
    casimir : list of Fraction
        Casimir eigenvalue ``(w, w + 2 rho)`` for each simple factor, where long roots have squared length 2.
    reality : str
        ``"real"``, ``"complex"`` or ``"quaternionic"``.

    Raises
    ------
    InputError
        The text does not name an algebra or a representation.

    Examples
    --------
    >>> ten = Representation("SU(5)", "10")
    >>> ten.labels, ten.dimension, ten.reality
    ((0, 1, 0, 0), 10, 'complex')
    >>> ten.tensor("5bar")
    {Representation('A4', '5'): 1, Representation('A4', '45'): 1}
    """

    algebra: str
    labels: tuple[int, ...]
    name: str | None
    dimension: int
    index: list[int]
    casimir: list[Fraction]
    reality: str

    def __init__(self, algebra: str, weight: Weight) -> None:
        report = Report(_representation(algebra, _text(weight), [], None, None, False))
        found = report["representation"]
        self._report = report
        self.algebra = report["algebra"]["name"]
        self.labels = tuple(found["labels"])
        self.name = found["name"]
        self.dimension = int(found["dimension"])
        self.index = [int(value) for value in found["index"]]
        self.casimir = [Fraction(value) for value in found["casimir"]]
        self.reality = found["reality"]

    def __repr__(self) -> str:
        return f"Representation({self.algebra!r}, {self.name or _text(self.labels)!r})"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Representation):
            return NotImplemented
        return (self.algebra, self.labels) == (other.algebra, other.labels)

    def __hash__(self) -> int:
        return hash((self.algebra, self.labels))

    def info(self) -> Report:
        """All properties, as ``affinor rep`` prints them.

        Returns
        -------
        Report

        Examples
        --------
        >>> Representation("E7", "56").info()["representation"]["frobenius_schur"]
        -1
        """
        return self._report

    @property
    def dual(self) -> Representation:
        """Dual representation.

        Examples
        --------
        >>> Representation("SU(3)", "3").dual.labels
        (0, 1)
        """
        return Representation(self.algebra, self._report["representation"]["dual"]["labels"])

    def tensor(self, *others: Weight) -> dict[Representation, int]:
        """Decomposition of the tensor product with other representations.

        Parameters
        ----------
        *others : Representation, str or sequence of int
            The other factors.

        Returns
        -------
        dict
            The irreducible components with their multiplicities.

        Examples
        --------
        >>> Representation("SU(3)", "3").tensor("3bar")
        {Representation('A2', '1'): 1, Representation('A2', '8'): 1}
        """
        return self._components(tensor=[_text(other) for other in others])

    def power(self, degree: int, kind: Literal["symmetric", "exterior"] = "symmetric") -> dict[Representation, int]:
        """Decomposition of a symmetric or an exterior power.

        Parameters
        ----------
        degree : int
            The degree.
        kind : str
            ``"symmetric"`` or ``"exterior"``.

        Returns
        -------
        dict
            The irreducible components with their multiplicities.

        Raises
        ------
        ValueError
            The kind is neither ``"symmetric"`` nor ``"exterior"``.

        Examples
        --------
        >>> Representation("SU(3)", "3").power(2, "exterior")
        {Representation('A2', '3bar'): 1}
        """
        if kind not in ("symmetric", "exterior"):
            raise ValueError(f"the kind of a power is 'symmetric' or 'exterior', not {kind!r}")
        return self._components(power=(degree, kind == "symmetric"))

    def branch(self, subalgebra: str) -> dict[Representation, int]:
        """Restriction to a subalgebra.

        Parameters
        ----------
        subalgebra : str
            A name such as ``"SU(3)xSU(2)"``, or another form of ``affinor rep --branch``: ``"levi 3"``,
            ``"principal"``, ``"span e1-f1, e2-f2"``.

        Returns
        -------
        dict
            The irreducible components with their multiplicities.

        Examples
        --------
        >>> Representation("G2", "7").branch("SU(3)")
        {Representation('A2', '1'): 1, Representation('A2', '3'): 1, Representation('A2', '3bar'): 1}
        """
        return self._components(branch=subalgebra)

    def weights(self) -> dict[tuple[int, ...], int]:
        """Dominant weights with their multiplicities.

        Returns
        -------
        dict

        Examples
        --------
        >>> Representation("SU(3)", "8").weights()
        {(1, 1): 1, (0, 0): 2}
        """
        report = self._operations(weights=True)
        return {tuple(one["labels"]): int(one["multiplicity"]) for one in report["weights"]}

    def matrices(self, which: Literal["generators", "all"] = "generators", dtype: Any = float) -> dict[str, NDArray[Any]]:
        """Matrices of the generators ``e_i``, ``f_i``, ``h_i``, or of all vectors of the Chevalley basis.

        Column ``j`` is the image of the basis vector ``j``. The basis consists of monomials of lowering operators.

        Parameters
        ----------
        which : str
            ``"generators"`` or ``"all"``.
        dtype : data type
            ``float``, or ``object`` for exact entries (:class:`fractions.Fraction`).

        Returns
        -------
        dict
            Arrays of the shape (dimension, dimension) by the names ``e1``, ..., ``f1``, ..., ``h1``, ...

        Raises
        ------
        ValueError
            ``which`` is neither ``"generators"`` nor ``"all"``.

        Examples
        --------
        >>> m = Representation("SU(2)", "3").matrices()
        >>> bool((m["e1"] @ m["f1"] - m["f1"] @ m["e1"] == m["h1"]).all())
        True
        """
        if which not in ("generators", "all"):
            raise ValueError(f"which is 'generators' or 'all', not {which!r}")
        document = self._matrices(which == "all")
        return {one["name"]: self._dense(one["entries"], dtype) for one in document["matrices"]}

    def bilinear_form(self, dtype: Any = float) -> NDArray[Any] | None:
        """Invariant bilinear form in the basis of :meth:`matrices`; None if the representation is complex.

        Parameters
        ----------
        dtype : data type
            ``float``, or ``object`` for exact entries.

        Returns
        -------
        ndarray or None
            Array of the shape (dimension, dimension), symmetric or antisymmetric.

        Examples
        --------
        >>> Representation("SU(2)", "2").bilinear_form().tolist()
        [[0.0, 1.0], [-1.0, 0.0]]
        """
        form = self._matrices(False)["bilinear_form"]
        return None if form is None else self._dense(form["entries"], dtype)

    def hermitian_form(self, dtype: Any = float) -> NDArray[Any]:
        """Form that is invariant under the compact real form, in the basis of :meth:`matrices`.

        Parameters
        ----------
        dtype : data type
            ``float``, or ``object`` for exact entries.

        Returns
        -------
        ndarray
            Symmetric, positive definite array of the shape (dimension, dimension).

        Examples
        --------
        >>> Representation("SU(2)", "3").hermitian_form().diagonal().tolist()
        [1.0, 2.0, 1.0]
        """
        return self._dense(self._matrices(False)["hermitian_form"]["entries"], dtype)

    def _matrices(self, all_vectors: bool) -> dict[str, Any]:
        return dict(json.loads(_representation_matrices(self.algebra, _text(self.labels), all_vectors)))

    def _dense(self, entries: Iterable[tuple[int, int, str]], dtype: Any) -> NDArray[Any]:
        zero = Fraction(0) if np.dtype(dtype) == object else 0
        dense = np.full((self.dimension, self.dimension), zero, dtype=dtype)
        for row, column, value in entries:
            dense[row - 1, column - 1] = Fraction(value)
        return dense

    def _operations(
        self,
        tensor: list[str] | None = None,
        power: tuple[int, bool] | None = None,
        branch: str | None = None,
        weights: bool = False,
    ) -> Report:
        return Report(_representation(self.algebra, _text(self.labels), tensor or [], power, branch, weights))

    def _components(self, **operations: Any) -> dict[Representation, int]:
        result = self._operations(**operations)["result"]
        algebra = result["algebra"]["name"]
        return {Representation(algebra, one["labels"]): int(one["multiplicity"]) for one in result["components"]}


Weight: TypeAlias = str | Sequence[int] | Representation


def clebsch_gordan(j1: Spin, j2: Spin, j: Spin, *, real: bool = False, squares: bool = False) -> NDArray[Any]:
    """Clebsch-Gordan coefficients ``<j1 m1 j2 m2 | j m>`` of su(2) in the convention of Condon and Shortley.

    Parameters
    ----------
    j1, j2, j : int, float, Fraction or str
        The spins: integers or halves of odd integers.
    real : bool
        Whether to return the invariant tensor of norm 1 in the basis of real spherical harmonics that e3nn uses. The
        spins must be integers.
    squares : bool
        Whether to return the exact squares with the signs of the coefficients (:class:`fractions.Fraction`).

    Returns
    -------
    ndarray
        Array of the shape (2 j1 + 1, 2 j2 + 1, 2 j + 1) with the indices ``m1 + j1``, ``m2 + j2``, ``m + j``.

    Examples
    --------
    >>> clebsch_gordan(1, 1, 0, squares=True)[2, 0, 0]
    Fraction(1, 3)
    >>> clebsch_gordan("1/2", "1/2", 1).shape
    (2, 2, 3)
    """
    return _array([j1, j2, j], "real" if real else "clebsch-gordan", squares)


def wigner_3j(j1: Spin, j2: Spin, j3: Spin, *, squares: bool = False) -> NDArray[Any]:
    """3j symbols of Wigner for all magnetic quantum numbers.

    Parameters
    ----------
    j1, j2, j3 : int, float, Fraction or str
        The spins.
    squares : bool
        Whether to return the exact squares with the signs of the symbols.

    Returns
    -------
    ndarray
        Array of the shape (2 j1 + 1, 2 j2 + 1, 2 j3 + 1).

    Examples
    --------
    >>> wigner_3j(1, 1, 2, squares=True)[1, 1, 2]
    Fraction(2, 15)
    """
    return _array([j1, j2, j3], "3j", squares)


def wigner_6j(*spins: Spin, squares: bool = False) -> Any:
    """6j symbol of Wigner.

    Parameters
    ----------
    *spins : int, float, Fraction or str
        The six spins, the upper row first.
    squares : bool
        Whether to return the exact square with the sign of the symbol.

    Returns
    -------
    float or Fraction

    Examples
    --------
    >>> wigner_6j(1, 1, 1, 1, 1, 1)
    0.16666666666666666
    """
    _, values = _coupling([_spin(spin) for spin in spins], "6j", squares)
    return values[0]


def _array(spins: list[Spin], kind: str, squares: bool) -> NDArray[Any]:
    texts = [_spin(spin) for spin in spins]
    positions, values = _coupling(texts, kind, squares)
    shape = [int(2 * Fraction(text)) + 1 for text in texts]
    array = np.full(shape, Fraction(0), dtype=object) if squares else np.zeros(shape)
    array.flat[positions] = values
    return array


def _spin(spin: Spin) -> str:
    """A spin as text, such as ``3/2``."""
    return spin if isinstance(spin, str) else str(Fraction(spin))


def _text(weight: Weight) -> str:
    """A weight as text: a name, or labels in brackets."""
    if isinstance(weight, str):
        return weight
    labels = weight.labels if isinstance(weight, Representation) else weight
    return "[" + ",".join(str(int(label)) for label in labels) + "]"
