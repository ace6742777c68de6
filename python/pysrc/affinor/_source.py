"""What a space is made of."""

from __future__ import annotations

import re
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
        if tolerance is not None and scalar != "float":
            raise ValueError("exact numbers have no tolerance: choose scalar='float', or leave the tolerance out")
        self.request, self.symbols = request, symbols
        self.scalar, self.tolerance = scalar, tolerance

    def space(self, **more: Any) -> _engine.Space:
        """The space, perhaps with another connection, metric or values of parameters; its files are read once."""
        space = _engine.Space(**{**self.request, **more})
        if space.files:
            self.request = {**self.request, "files": space.files}
        return space

    def of_algebra(self) -> Source:
        """The source without the connection and the metric, with values of the parameters that remain."""
        request = {key: value for key, value in self.request.items() if key not in ("connection", "metric", "set")}
        parameters = _engine.Space(**request).parameters
        remaining = [f"{name}={value}" for name, value in self.values().items() if name in parameters]
        if remaining:
            request["set"] = ",".join(remaining)
        return Source(request, self.symbols, self.scalar, self.tolerance)

    def values(self) -> dict[str, str]:
        """The values of parameters and functions that were set, by the text before the equality sign."""
        # a comma before a name and an equality sign separates values
        texts = re.split(r",(?=\s*\w+\s*(?:\([^()]*\)\s*)?=)", self.request.get("set") or "")
        pairs = [text.partition("=") for text in texts if text]
        return {name.strip(): value for name, _, value in pairs}

    def with_(self, **more: Any) -> Source:
        return Source({**self.request, **more}, self.symbols, self.scalar, self.tolerance)

    def of(self) -> tuple[Any, ...]:
        return self.request, self.symbols, self.scalar, self.tolerance
