"""Exceptions. Each carries its witness as data, and the message of the command line."""

from __future__ import annotations

from typing import Any

__all__ = [
    "AffinorError",
    "AntisymmetryError",
    "ClosureError",
    "ConstructionError",
    "DependentError",
    "InputError",
    "IntegrationError",
    "InternalError",
    "JacobiError",
    "LimitError",
    "MathematicsError",
    "MetricError",
    "ShapeError",
    "SymmetryError",
]


class AffinorError(ValueError):
    """An error of affinor.

    ``message`` says what is wrong, ``help`` what to write instead (or None), and ``place`` where it stands: a dict with
    ``source`` and, where they are known, ``line``, ``column`` and ``text`` (or None). ``data`` has the witness.
    """

    def __init__(
        self,
        message: str,
        help: str | None = None,
        place: dict[str, Any] | None = None,
        data: dict[str, Any] | None = None,
    ) -> None:
        super().__init__(message, help, place, data)
        self.message = message
        self.help = help
        self.place = place
        self.data = dict(data or {})

    def __str__(self) -> str:
        lines = [self.message]
        if self.place is not None:
            source, text = str(self.place["source"]), self.place.get("text")
            if source.isidentifier():
                lines.append(f"  in the argument {source}" + (f": {text}" if text is not None else ""))
            else:
                at = f"{source}:{self.place['line']}:{self.place['column']}: {text}" if "line" in self.place else source
                lines.append(f"  at {at}")
        if self.help is not None:
            lines.append(f"  help: {self.help}")
        return "\n".join(lines)


class InputError(AffinorError):
    """Wrong usage or unreadable input; exit status 2 of the command line."""


class ShapeError(InputError):
    """A tensor or an array of the wrong dimension, slots or shape."""


class MathematicsError(AffinorError):
    """A refusal of the mathematics; exit status 1 of the command line."""


class _Pair(MathematicsError):
    @property
    def pair(self) -> tuple[str, str] | None:
        """The names of the two basis vectors or matrices."""
        return self.data.get("pair")

    @property
    def residual(self) -> str | None:
        """The component that should vanish."""
        return self.data.get("residual")


class JacobiError(MathematicsError):
    """A bracket that violates the Jacobi identity."""

    @property
    def triple(self) -> tuple[str, str, str]:
        """The names of the three basis vectors."""
        triple: tuple[str, str, str] = self.data["triple"]
        return triple

    @property
    def residual(self) -> str:
        """``[[x,y],z] + [[y,z],x] + [[z,x],y]``, which should vanish."""
        return str(self.data["residual"])


class AntisymmetryError(_Pair):
    """A bracket that is not antisymmetric."""


class ClosureError(_Pair):
    """Matrices whose span is not closed under the commutator."""


class ConstructionError(_Pair):
    """A construction whose condition fails: that of an ideal, a subalgebra, a cocycle, a derivation, an action, a limit, or a
    commutative, associative algebra.

    ``data`` has the witness: ``pair`` or ``triple``, ``residual``, and ``derivation``, ``vector`` or ``component``.
    """

    @property
    def triple(self) -> tuple[str, str, str] | None:
        """The names of three vectors for which the condition of a cocycle or of an associative product fails."""
        return self.data.get("triple")


class DependentError(MathematicsError):
    """Matrices or fields that are linearly dependent."""

    @property
    def relation(self) -> str:
        """A linear combination that vanishes."""
        return str(self.data["relation"])


class MetricError(_Pair):
    """A metric that is missing, not symmetric, or degenerate."""

    @property
    def null(self) -> str | None:
        """A nonzero vector that is orthogonal to every vector, ``g_ij v^j = 0``."""
        return self.data.get("null")


class SymmetryError(MathematicsError):
    """A tensor without a symmetry that it needs."""

    @property
    def at(self) -> list[int]:
        """The indices of a component, from 1."""
        return list(self.data["at"])

    @property
    def residual(self) -> str:
        """The component that should vanish."""
        return str(self.data["residual"])


class IntegrationError(MathematicsError):
    """An integration that stopped before its end."""

    @property
    def time(self) -> float:
        """The time that was reached."""
        return float(self.data["time"])


class LimitError(AffinorError):
    """A computation that passed a limit of :func:`affinor.limits`."""

    @property
    def limit(self) -> str:
        """``"timeout"`` or ``"memory"``."""
        return str(self.data["limit"])

    @property
    def stage(self) -> str | None:
        """What was computed, such as ``"curvature"``, or None."""
        return self.data.get("stage")


class InternalError(RuntimeError):
    """A defect of affinor itself; please report it."""


def _of_engine(
    kind: str,
    message: str,
    help: str | None,
    place: dict[str, Any] | None,
    data: dict[str, Any],
) -> AffinorError:
    """The exception of a class name."""
    made: AffinorError = globals()[kind](message, help, place, data)
    return made
