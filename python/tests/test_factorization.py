"""Factorizations: the factors lie in their groups, and the coordinates are those of SciPy and of published gates."""

import numpy as np
import pytest

import affinor as af


def unitary(n, seed):
    rng = np.random.default_rng(seed)
    return np.linalg.qr(rng.normal(size=(n, n)) + 1j * rng.normal(size=(n, n)))[0]


def special(m):
    return m / np.linalg.det(m) ** (1 / len(m))


@pytest.mark.parametrize("n", range(1, 7))
def test_symmetric_unitary_matrices(n):
    g = special(unitary(n, n))
    found = af.kak(g, f"SU({n})/SO({n})")
    assert np.abs(found.k1 @ found.a @ found.k2 - g).max() < 1e-14
    assert found.residual < 1e-13
    for k in (found.k1, found.k2):
        assert np.abs(k.imag).max() < 1e-15
        assert np.abs(k.T @ k - np.eye(n)).max() < 1e-14
    assert np.allclose(np.diag(found.a), np.exp(1j * found.coordinates), rtol=0, atol=1e-15)
    assert found.pair == f"SU({n})/SO({n})"
    assert abs(found.coordinates.sum()) < 1e-14


def test_angles_are_those_of_singular_values():
    g = unitary(5, 3)
    found = af.kak(g, "U(5)/U(3)xU(2)")
    cosines = np.linalg.svd(g[3:, 3:], compute_uv=False)
    assert np.allclose(np.cos(found.coordinates), cosines[::-1], rtol=0, atol=1e-14)
    m = np.random.default_rng(1).normal(size=(4, 4))
    found = af.kak(m, "GL(4,R)")
    assert np.allclose(np.exp(found.coordinates), np.linalg.svd(m, compute_uv=False), rtol=1e-13)
    assert all(factor.dtype == np.float64 for factor in found[:3])


def test_gates_of_two_qubits():
    iswap = np.array([[1, 0, 0, 0], [0, 0, 1j, 0], [0, 1j, 0, 0], [0, 0, 0, 1]])
    for seed in range(20):
        gate = np.kron(unitary(2, seed), unitary(2, seed + 50)) @ iswap @ np.kron(unitary(2, seed + 100), unitary(2, seed + 150))
        found = af.two_qubit_kak(gate)
        assert np.allclose(found.coordinates, [np.pi / 4, np.pi / 4, 0], rtol=0, atol=1e-14)
        paulis = [np.array([[0, 1], [1, 0]]), np.array([[0, -1j], [1j, 0]]), np.diag([1, -1])]
        product = np.eye(4)
        for c, pauli in zip(found.coordinates, paulis, strict=True):
            product = product @ (np.cos(c) * np.eye(4) + 1j * np.sin(c) * np.kron(pauli, pauli))
        product = np.exp(1j * found.phase) * np.kron(*found.left) @ product @ np.kron(*found.right)
        assert np.abs(product - gate).max() < 1e-14


def test_bad_input():
    with pytest.raises(af.InputError, match="symmetric pair"):
        af.kak(np.eye(3), "SU(3)")
    with pytest.raises(af.ShapeError):
        af.kak(np.eye(2), "SU(3)/SO(3)")
    with pytest.raises(af.ShapeError, match="matrix"):
        af.kak([1.0, 2.0], "SU(3)/SO(3)")
    with pytest.raises(af.MathematicsError, match="determinant"):
        af.kak(np.diag([1j, 1]), "SU(2)/SO(2)")
    with pytest.raises(af.MathematicsError):
        af.kak([[1, 0], [np.nan, 1]], "SU(2)/SO(2)")
    with pytest.raises(af.MathematicsError, match="off by"):
        af.two_qubit_kak(2 * np.eye(4))
