"""Limits on the time and the memory of computations."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from affinor import _engine

__all__ = ["current", "limits"]

current: ContextVar[_engine.Budget | None] = ContextVar("affinor limits", default=None)
"""The limits of the innermost block."""


@contextmanager
def limits(timeout: float | None = None, memory: int | str | None = None) -> Iterator[None]:
    """Limits for all computations of affinor in a block. A computation that passes one ends with LimitError.

    ``timeout`` is the number of seconds of the whole block. ``memory`` is the resident size of the whole process, in bytes or as
    a text such as ``"2G"``; only Linux tells it. Blocks nest, and all their limits hold. A limit ends computations of
    affinor only, also in the calls that follow in the block; code of Python goes on.

    >>> import affinor as af
    >>> with af.limits(timeout=60, memory="8G"):
    ...     print(af.Geometry("so3@zero").ricci[0, 0])
    1/2
    """
    token = current.set(_engine.Budget(timeout, memory, current.get()))
    try:
        yield
    finally:
        current.reset(token)
