"""What a space is made of."""

from __future__ import annotations

from typing import Any

from affinor import _engine
from affinor._scalars import Symbols

Request = dict[str, Any]
"""The arguments of a space: those of ``_engine.Space``."""


class Source:
    """What a space is made of: the arguments of the engine, the symbols of SymPy in them, and the scalar."""

    __slots__ = ("request", "scalar", "symbols", "tolerance")

    def __init__(self, request: Request, symbols: Symbols, scalar: str, tolerance: float | None) -> None:
        if scalar not in ("exact", "float"):
            raise ValueError(f"the scalar is exact or float, not {scalar!r}")
        self.request, self.symbols = request, symbols
        self.scalar, self.tolerance = scalar, tolerance

    def space(self, **more: Any) -> _engine.Space:
        """The space, perhaps with another connection, metric or values of parameters."""
        return _engine.Space(**{**self.request, **more})

    def with_(self, **more: Any) -> Source:
        return Source({**self.request, **more}, self.symbols, self.scalar, self.tolerance)

    def of(self) -> tuple[Any, ...]:
        return self.request, self.symbols, self.scalar, self.tolerance
