"""Exceptions. Each exception has a witness as data, and the message that the command line prints."""

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
    """Base class of the errors of affinor.

    Parameters
    ----------
    message : str
        Description of the fault.
    help : str, optional
        Advice: the text or the argument to write instead.
    place : dict, optional
        Location of the fault: ``source`` and, if they are known, ``line``, ``column`` and ``text``.
    data : dict, optional
        Witness of the fault. Subclasses have its entries as properties.

    Attributes
    ----------
    message, help, place, data
        The arguments of the constructor.

    Examples
    --------
    >>> try:
    ...     LieAlgebra("so(n)")
    ... except AffinorError as error:
    ...     print(type(error).__name__)
    InputError
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
    """Wrong usage or unreadable input. On the command line, the exit status is 2.

    Examples
    --------
    >>> try:
    ...     LieAlgebra("nothing")
    ... except InputError as error:
    ...     print(error.place["text"])
    nothing
    """


class ShapeError(InputError):
    """Tensor or array with a wrong dimension, wrong slots or a wrong shape.

    Examples
    --------
    >>> try:
    ...     contract("^i _i -> ", Tensor([1], "^"), Tensor([1, 2], "_"))
    ... except ShapeError:
    ...     print("the dimensions 1 and 2 differ")
    the dimensions 1 and 2 differ
    """


class MathematicsError(AffinorError):
    """Valid input without a mathematical answer. On the command line, the exit status is 1.

    Examples
    --------
    >>> try:
    ...     SO3.project([0, 0, 0, 0])
    ... except MathematicsError:
    ...     print("the quaternion has no direction")
    the quaternion has no direction
    """


class _Pair(MathematicsError):
    """Error whose witness is a pair of basis vectors or matrices."""

    @property
    def pair(self) -> tuple[str, str] | None:
        """Names of the two basis vectors or matrices; None for other witnesses."""
        return self.data.get("pair")

    @property
    def residual(self) -> str | None:
        """Component that should vanish, as a string; None for other witnesses."""
        return self.data.get("residual")


class JacobiError(MathematicsError):
    """Bracket that violates the Jacobi identity.

    Examples
    --------
    >>> try:
    ...     LieAlgebra("[x, y] = x, [y, z] = y", basis="x y z")
    ... except JacobiError as error:
    ...     print(error.triple, error.residual)
    ('x', 'y', 'z') -x
    """

    @property
    def triple(self) -> tuple[str, str, str]:
        """Names of the three basis vectors."""
        triple: tuple[str, str, str] = self.data["triple"]
        return triple

    @property
    def residual(self) -> str:
        """Residual ``[[x,y],z] + [[y,z],x] + [[z,x],y]``, which should vanish."""
        return str(self.data["residual"])


class AntisymmetryError(_Pair):
    """Bracket that is not antisymmetric.

    Examples
    --------
    >>> try:
    ...     LieAlgebra("[x, y] = x, [y, x] = x", basis="x y")
    ... except AntisymmetryError as error:
    ...     print(error.pair, error.residual)
    ('x', 'y') 2*x
    """


class ClosureError(_Pair):
    """Matrices whose span is not closed under the commutator.

    Examples
    --------
    >>> try:
    ...     LieAlgebra.from_matrices([[[0, 1], [0, 0]], [[0, 0], [1, 0]]])
    ... except ClosureError as error:
    ...     print(error.pair)
    ('e1', 'e2')
    """


class ConstructionError(_Pair):
    """Construction whose condition fails. Examples are the conditions of an ideal, a subalgebra, a cocycle, a derivation, an
    action, a limit, or a commutative, associative algebra.

    ``data`` contains the witness: ``pair`` or ``triple``, ``residual``, and ``derivation``, ``vector`` or ``component``.

    Examples
    --------
    >>> try:
    ...     LieAlgebra("so3").quotient([[1, 0, 0]])
    ... except ConstructionError as error:
    ...     print(error.pair, error.residual)
    ('e2', 'e1') -e3
    """

    @property
    def triple(self) -> tuple[str, str, str] | None:
        """Names of three vectors that violate the condition of a cocycle or of an associative product; None for other conditions."""
        return self.data.get("triple")


class DependentError(MathematicsError):
    """Matrices or fields that are linearly dependent.

    Examples
    --------
    >>> try:
    ...     LieAlgebra.from_matrices([[[1, 0], [0, 0]], [[2, 0], [0, 0]]])
    ... except DependentError as error:
    ...     print(error.relation)
    -2*e1 + e2
    """

    @property
    def relation(self) -> str:
        """Linear combination that vanishes."""
        return str(self.data["relation"])


class MetricError(_Pair):
    """Metric that is missing, not symmetric, or degenerate.

    Examples
    --------
    >>> try:
    ...     Geometry("so3", metric=[1, 1, 0])
    ... except MetricError as error:
    ...     print(error.null)
    e3
    """

    @property
    def null(self) -> str | None:
        """Nonzero vector ``v`` that is orthogonal to every vector, ``g_ij v^j = 0``; None for other faults."""
        return self.data.get("null")


class SymmetryError(MathematicsError):
    """Tensor that lacks a required symmetry.

    Examples
    --------
    >>> try:
    ...     Geometry("so3", metric=[1, 1, 1], torsion=Tensor({(0, 1, 2): 1}, "^__", dimension=3))
    ... except SymmetryError as error:
    ...     print(error.at, error.residual)
    [1, 2, 3] 1
    """

    @property
    def at(self) -> list[int]:
        """Indices, from 1, of a component that violates the symmetry."""
        return list(self.data["at"])

    @property
    def residual(self) -> str:
        """Component that should vanish, as a string."""
        return str(self.data["residual"])


class IntegrationError(MathematicsError):
    """Integration that stopped before the final time.

    Examples
    --------
    >>> try:
    ...     Geometry("sl2", metric=[1, -1, 3]).geodesic([1, 2, 3], [100])
    ... except IntegrationError as error:
    ...     print(round(error.time, 3))
    1.214
    """

    @property
    def time(self) -> float:
        """Time at which the integration stopped."""
        return float(self.data["time"])


class LimitError(AffinorError):
    """Computation that exceeded a limit of :func:`affinor.limits`.

    Examples
    --------
    >>> try:
    ...     with limits(timeout=1e-9):
    ...         Geometry("so3@zero").ricci
    ... except LimitError as error:
    ...     print(error.limit)
    timeout
    """

    @property
    def limit(self) -> str:
        """Kind of the limit: ``"timeout"`` or ``"memory"``."""
        return str(self.data["limit"])

    @property
    def stage(self) -> str | None:
        """Computation that was stopped, such as ``"curvature"``; None if it had not begun."""
        return self.data.get("stage")


class InternalError(RuntimeError):
    """Defect of affinor itself; please report it.

    Examples
    --------
    >>> issubclass(InternalError, RuntimeError)
    True
    """


def _of_engine(
    kind: str,
    message: str,
    help: str | None,
    place: dict[str, Any] | None,
    data: dict[str, Any],
) -> AffinorError:
    """Creates the exception of the class with the name ``kind``."""
    made: AffinorError = globals()[kind](message, help, place, data)
    return made
