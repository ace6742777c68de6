"""Factorizations ``g = k1 a k2`` of matrices of classical groups, and of quantum gates of two qubits."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from affinor._engine import _kak, _two_qubit_kak
from affinor.errors import ShapeError

__all__ = ["KakFactors", "TwoQubitKak", "kak", "two_qubit_kak"]

Complexes = NDArray[np.complex128]


class KakFactors(NamedTuple):
    """Factorization ``g = k1 @ a @ k2`` for a symmetric pair (G, K).

    Attributes
    ----------
    k1 : array of the shape (n, n)
        Left factor, in K.
    a : array of the shape (n, n)
        Exponential of an element of a maximal abelian subspace.
    k2 : array of the shape (n, n)
        Right factor, in K.
    coordinates : array of the shape (count,)
        Coordinates of ``a`` in a Weyl chamber: angles in radians for compact groups, logarithms of singular values or
        hyperbolic angles for others.
    pair : str
        Name of the symmetric pair.
    residual : float
        Frobenius norm of ``k1 @ a @ k2 - g``.

    Examples
    --------
    >>> kak([[2, 1], [1, 1]], "SL(2,R)").coordinates
    array([ 0.96242365, -0.96242365])
    """

    k1: NDArray[Any]
    a: NDArray[Any]
    k2: NDArray[Any]
    coordinates: NDArray[np.float64]
    pair: str
    residual: float


class TwoQubitKak(NamedTuple):
    """Factorization ``exp(i phase) kron(a1, b1) exp(i (c1 XX + c2 YY + c3 ZZ)) kron(a2, b2)`` of a gate of two qubits.

    Attributes
    ----------
    coordinates : array of the shape (3,)
        Weyl coordinates ``c1, c2, c3`` in radians with ``pi/4 >= c1 >= c2 >= |c3|``, and ``c3 >= 0`` if ``c1 = pi/4``.
    left : tuple of two arrays of the shape (2, 2)
        Local gates ``a1, b1`` of SU(2) that act last.
    right : tuple of two arrays of the shape (2, 2)
        Local gates ``a2, b2`` of SU(2) that act first.
    phase : float
        Global phase in radians.
    residual : float
        Frobenius norm of the product less the gate.

    Examples
    --------
    >>> import numpy as np
    >>> swap = np.eye(4)[[0, 2, 1, 3]]
    >>> two_qubit_kak(swap).coordinates / np.pi
    array([0.25, 0.25, 0.25])
    """

    coordinates: NDArray[np.float64]
    left: tuple[Complexes, Complexes]
    right: tuple[Complexes, Complexes]
    phase: float
    residual: float


KakFactors.k1.__doc__ = "Left factor, in K."
KakFactors.a.__doc__ = "Exponential of an element of a maximal abelian subspace."
KakFactors.k2.__doc__ = "Right factor, in K."
KakFactors.coordinates.__doc__ = "Coordinates of ``a`` in a Weyl chamber."
KakFactors.pair.__doc__ = "Name of the symmetric pair."
KakFactors.residual.__doc__ = "Frobenius norm of ``k1 @ a @ k2 - g``."
TwoQubitKak.coordinates.__doc__ = "Weyl coordinates in radians."
TwoQubitKak.left.__doc__ = "Local gates that act last."
TwoQubitKak.right.__doc__ = "Local gates that act first."
TwoQubitKak.phase.__doc__ = "Global phase in radians."
TwoQubitKak.residual.__doc__ = "Frobenius norm of the product less the gate."


def kak(g: ArrayLike, pair: str) -> KakFactors:
    """Factor a matrix as ``k1 a k2`` for a symmetric pair of classical groups.

    All factors are accurate up to rounding errors, also if coordinates are equal, zero or right angles.

    The compact pairs ``G/K`` are:

    - ``U(n)/O(n)``, ``SU(n)/SO(n)`` (factorization of Takagi), ``U(2n)/Sp(n)``, ``SU(2n)/Sp(n)``.

    - ``U(p+q)/U(p)xU(q)``, ``SU(p+q)/S(U(p)xU(q))`` (cosine-sine decomposition).

    - ``O(p+q)/O(p)xO(q)``, ``SO(p+q)/S(O(p)xO(q))`` (principal angles of subspaces).

    - ``SO(2n)/U(n)``, ``Sp(n)/U(n)``, ``Sp(p+q)/Sp(p)xSp(q)``.

    The noncompact groups, each with its maximal compact subgroup, are:

    - ``GL(n,R)``, ``SL(n,R)`` (singular value decomposition), also over ``C`` and ``H``.

    - ``O(p,q)``, ``SO(p,q)`` (boosts of Lorentz), ``U(p,q)``, ``SU(p,q)``, ``Sp(p,q)``.

    - ``Sp(2n,R)`` with ``g.T @ J @ g = J`` for ``J = [[0, 1], [-1, 0]]`` in blocks of size n.

    Parameters
    ----------
    g : array_like of the shape (n, n)
        Matrix of the group, real or complex. Quaternions ``a + b i + c j + d k`` are blocks
        ``[[a + b i, c + d i], [-c + d i, a - b i]]``.
    pair : str
        Name of a symmetric pair with numbers, such as ``"SU(4)/SO(4)"`` or ``"SO(3,1)"``.

    Returns
    -------
    KakFactors
        The factors, real for real groups.

    Raises
    ------
    InputError
        The text is not the name of a symmetric pair.
    ShapeError
        The matrix has another size.
    MathematicsError
        The matrix is not in the group up to 1e-6.

    Examples
    --------
    >>> import numpy as np
    >>> c, s = np.cos(0.4), np.sin(0.4)
    >>> factors = kak([[c, 0, -s], [0, 1, 0], [s, 0, c]], "SO(3)/S(O(2)xO(1))")
    >>> factors.coordinates
    array([0.4])
    >>> bool(factors.residual < 1e-15)
    True
    """
    name, factors, coordinates, residual = _kak(_matrix(g), pair)
    group = name.partition("/")[0]
    is_real = group.startswith(("O(", "SO(")) or group.endswith("R)")
    k1, a, k2 = [factor.real.copy() if is_real else factor for factor in factors]
    return KakFactors(k1, a, k2, np.array(coordinates), name, residual)


def two_qubit_kak(gate: ArrayLike) -> TwoQubitKak:
    """Factor a quantum gate of two qubits into local gates and a canonical gate.

    Parameters
    ----------
    gate : array_like of the shape (4, 4)
        Unitary matrix in the basis ``|00>, |01>, |10>, |11>``.

    Returns
    -------
    TwoQubitKak
        Local gates, Weyl coordinates and the phase.

    Raises
    ------
    ShapeError
        The matrix does not have 4 rows and 4 columns.
    MathematicsError
        The matrix is not unitary up to 1e-6.

    Examples
    --------
    >>> import numpy as np
    >>> cnot = np.eye(4)[[0, 1, 3, 2]]
    >>> np.abs(two_qubit_kak(cnot).coordinates / np.pi).round(12)
    array([0.25, 0.  , 0.  ])
    """
    (a1, b1, a2, b2), coordinates, phase, residual = _two_qubit_kak(_matrix(gate))
    return TwoQubitKak(np.array(coordinates), (a1, b1), (a2, b2), phase, residual)


def _matrix(g: ArrayLike) -> Complexes:
    """Converts a matrix to an array of complex numbers, and checks that it has two axes."""
    array = np.asarray(g)
    if array.dtype.kind not in "biufc":
        array = array.astype(complex)
    if array.ndim != 2:
        raise ShapeError(f"g should be a matrix, not an array of the shape {array.shape}")
    return array.astype(np.complex128)
