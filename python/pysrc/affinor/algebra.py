"""Lie algebras: from names, brackets, structure constants, matrices and definition files."""

from __future__ import annotations

from affinor._engine import LieAlgebra, catalogue

__all__ = ["Check", "LieAlgebra", "catalogue"]


class Check:
    """Check of a certificate. Its truth value tells whether the check succeeds.

    Attributes
    ----------
    name : str
        Identity that was checked, such as ``"jacobi"``.
    ok : bool
        Whether the identity holds.
    detail : str
        Identity in words, or the reason why it fails.
    indices : list of int or None
        Indices, from 1, of the first component that fails; None if the check succeeds.
    residual : list of (int, str) or None
        Nonzero components of the residual at these indices; None if the check succeeds.

    Examples
    --------
    >>> jacobi = check("[x, y] = x, [y, z] = y", basis="x y z")[1]
    >>> jacobi.name, jacobi.ok, jacobi.residual
    ('jacobi', False, [(1, '-1')])
    """

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
