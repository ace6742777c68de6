"""Lie algebras: from names, brackets, structure constants, matrices and definition files."""

from __future__ import annotations

from affinor._engine import LieAlgebra, catalogue

__all__ = ["Check", "LieAlgebra", "catalogue"]


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
