"""Limits on the time and the memory of computations."""

from __future__ import annotations

import numbers
import time
from contextlib import ContextDecorator
from contextvars import ContextVar
from typing import Any

from affinor._engine import Budget

__all__ = ["current", "limits"]


class _Block:
    """A block of code with limits. Blocks may end in any order, and in a context other than the one in which they began."""

    __slots__ = ("deadline", "memory", "open", "owner")

    def __init__(self, owner: Limits) -> None:
        self.owner, self.memory, self.open = owner, owner.memory, True
        self.deadline = None if owner.timeout is None else time.monotonic() + owner.timeout

    def rest(self) -> float | None:
        """The seconds until the time limit of the block; None without a time limit."""
        return None if self.deadline is None else max(0.0, self.deadline - time.monotonic())


_Stack = tuple[tuple[_Block, Budget], ...]
"""The blocks of a context, the innermost block last. Each budget has the limits of its block and of all blocks before it."""


class _Current:
    """The limits that apply now. The engine reads them."""

    def __init__(self) -> None:
        self._stack: ContextVar[_Stack] = ContextVar("affinor limits", default=())

    def get(self) -> Budget | None:
        """The limits of all open blocks of this context."""
        stack = self.blocks()
        return stack[-1][1] if stack else None

    def blocks(self) -> _Stack:
        """The open blocks of this context."""
        stack = self._stack.get()
        closed = next((at for at, (block, _) in enumerate(stack) if not block.open), None)
        if closed is not None:
            rest = stack[closed:]
            stack = stack[:closed]
            # renews the budgets after a closed block, because they contain its limits
            for block, _ in rest:
                if block.open:
                    stack += ((block, Budget(block.rest(), block.memory, stack[-1][1] if stack else None)),)
            self._stack.set(stack)
        return stack

    def push(self, block: _Block) -> None:
        """Begins a block."""
        stack = self.blocks()
        own = Budget(block.owner.timeout, block.memory, stack[-1][1] if stack else None)
        self._stack.set((*stack, (block, own)))


current = _Current()


class Limits(ContextDecorator):
    """Limits for blocks of code. Every block starts with the full time. One object may serve several blocks, nested or in threads."""

    def __init__(self, timeout: float | None, memory: int | str | None) -> None:
        if timeout is not None:
            if isinstance(timeout, bool) or not isinstance(timeout, numbers.Real):
                raise TypeError(f"timeout should be a number of seconds, not {type(timeout).__name__}")
            timeout = float(timeout)
        if memory is not None:
            if isinstance(memory, bool) or not isinstance(memory, (str, numbers.Real)):
                raise TypeError(f"memory should be a number of bytes or a text such as '2G', not {type(memory).__name__}")
            try:
                Budget(None, memory, None)
            except ValueError:
                raise ValueError(f"memory should be a size such as 800M or 2G, not {memory}") from None
        Budget(timeout, None, None)
        self.timeout, self.memory = timeout, memory
        self._blocks: list[_Block] = []

    def __enter__(self) -> None:
        block = _Block(self)
        current.push(block)
        self._blocks.append(block)

    def __exit__(self, *_: Any) -> None:
        own = [block for block, _ in current.blocks() if block.owner is self]
        # if this context has no such block, ends the latest one: a generator with a `with` block may be closed in another
        # context than it was started in
        block = own[-1] if own else self._blocks[-1]
        block.open = False
        self._blocks.remove(block)
        current.blocks()


def limits(timeout: float | None = None, memory: int | str | None = None) -> Limits:
    """Limits on the time and the memory of all computations of affinor in a ``with`` block.

    A computation that exceeds a limit raises LimitError; Python code is not limited. Blocks may be nested; then all their limits
    apply. Limits apply only to the thread of the block. Other threads have their own limits. This includes the tasks of sweeps,
    which run in a pool of threads: to limit a task, write the block in the task.

    Parameters
    ----------
    timeout : float, optional
        Seconds that the whole block may take.
    memory : int or str, optional
        Resident memory of the whole process, in bytes or as a string such as ``"2G"``. Only Linux reports this memory.

    Returns
    -------
    context manager
        The limits; they can also be used as a decorator of functions.

    Raises
    ------
    LimitError
        A computation in the block exceeds a limit.

    Examples
    --------
    >>> with limits(timeout=60, memory="8G"):
    ...     print(Geometry("so3@zero").ricci[0, 0])
    1/2
    """
    return Limits(timeout, memory)
