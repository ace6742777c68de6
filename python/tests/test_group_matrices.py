"""Matrices of groups in bulk: adjoint maps, Jacobians, rotations of matrices, and the action on points."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import affinor as af
from affinor import SE3, SO3

NAMES = ["so2", "so3", "se2", "se3", "se_2(3)", "sl2", "heisenberg(5)", "so(4)", "gl(2)", "so3+R^3", "se3+so3"]
rng = np.random.default_rng(11)


def vectors(group, shape=(2, 5), scale=0.4):
    return rng.normal(scale=scale, size=(*shape, group.dimension))


@pytest.mark.parametrize("name", NAMES)
def test_jacobians_are_derivatives_of_exp(name):
    """Central differences of ``log(exp(x)^-1 exp(x + s v))`` and of ``log(exp(x + s v) exp(x)^-1)``."""
    group = af.Group(name)
    x, v = vectors(group), vectors(group)
    left, right = group.left_jacobian(x), group.right_jacobian(x)
    assert left.shape == (2, 5, group.dimension, group.dimension)
    s, g = 1e-5, group.exp(x)
    ahead, behind = group.exp(x + s * v), group.exp(x - s * v)
    back = group.inverse(g)
    by_left = (group.log(group.compose(ahead, back)) - group.log(group.compose(behind, back))) / (2 * s)
    by_right = (group.log(group.between(g, ahead)) - group.log(group.between(g, behind))) / (2 * s)
    np.testing.assert_allclose(np.einsum("...ij,...j->...i", left, v), by_left, atol=1e-8)
    np.testing.assert_allclose(np.einsum("...ij,...j->...i", right, v), by_right, atol=1e-8)
    eye = np.eye(group.dimension)
    np.testing.assert_allclose(group.left_jacobian_inverse(x) @ left, np.broadcast_to(eye, left.shape), atol=1e-11)
    np.testing.assert_allclose(group.right_jacobian_inverse(x) @ right, np.broadcast_to(eye, left.shape), atol=1e-11)
    np.testing.assert_allclose(group.adjoint_matrix(g) @ right, left, atol=1e-11)
    # the rows of images of the basis are the transpose
    np.testing.assert_allclose(group.tangent_left(x[..., None, :], eye), np.swapaxes(right, -1, -2), atol=1e-13)


@pytest.mark.parametrize("name", NAMES)
def test_adjoint_matrices_and_rates(name):
    group = af.Group(name)
    x, v = vectors(group), vectors(group)
    g = group.exp(x)
    np.testing.assert_allclose(np.einsum("...ij,...j->...i", group.adjoint_matrix(g), v), group.adjoint(g, v), atol=1e-12)
    s = 1e-6
    slope = (group.compose(g, group.exp(s * v)) - group.compose(g, group.exp(-s * v))) / (2 * s)
    np.testing.assert_allclose(group.rate(g, v), slope, atol=1e-8)


@pytest.mark.parametrize("group", [SO3, SE3], ids=repr)
def test_rows_do_not_depend_on_their_batch(group):
    """Single rows, small batches, and batches on several threads give the same floats at all angles."""
    n, count = group.dimension, 9001
    x = rng.normal(size=(count, n))
    x[:, :3] *= rng.choice([0, 1e-170, 1e-8, 0.3, 1, 1.8, 5], size=(count, 1))
    g, points = group.exp(x), rng.normal(size=(count, 3))
    h = g[::-1].copy()
    m = group.matrix(g)
    calls = {
        "exp": ((x,), {}),
        "log": ((g,), {}),
        "compose": ((g, h), {}),
        "inverse": ((g,), {}),
        "matrix": ((g,), {}),
        "act": ((g, points), {}),
        "adjoint_matrix": ((g,), {}),
        "left_jacobian": ((x,), {}),
        "right_jacobian": ((x,), {}),
        "left_jacobian_inverse": ((0.4 * x,), {}),
        "from_matrix": ((m,), {}),
        "from_matrix unchecked": ((m,), {"check": False}),
    }
    for name, (arguments, keys) in calls.items():
        method = getattr(group, name.split()[0])
        whole = method(*arguments, **keys)
        assert whole.flags.c_contiguous and whole.flags.writeable and np.isfinite(whole).all()
        for start, stop in [(0, 1), (3, 12), (4090, 4100), (8995, 9001), (100, 5000)]:
            part = method(*(a[start:stop] for a in arguments), **keys)
            np.testing.assert_array_equal(part, whole[start:stop], err_msg=name)
        for at in (0, 17, 9000):
            np.testing.assert_array_equal(method(*(a[at] for a in arguments), **keys), whole[at], err_msg=name)
    np.testing.assert_array_equal(group.from_matrix(m), group.from_matrix(m, check=False))
    one = group.act(g[5], points)
    np.testing.assert_array_equal(one, group.act(np.broadcast_to(g[5], g.shape), points))
    np.testing.assert_array_equal(group.act(g[:4, None], points[None, :6])[2, 3], group.act(g[2], points[3]))


def test_rotations_of_scipy():
    x = rng.normal(scale=1.5, size=(500, 3))
    g, theirs = SO3.exp(x), Rotation.from_rotvec(x)
    points = rng.normal(size=(500, 3))
    np.testing.assert_allclose(SO3.matrix(g), theirs.as_matrix(), atol=1e-15)
    np.testing.assert_allclose(SO3.adjoint_matrix(g), theirs.as_matrix(), atol=1e-15)
    np.testing.assert_allclose(SO3.act(g, points), theirs.apply(points), atol=1e-14)
    for check in (True, False):
        found = SO3.from_matrix(theirs.as_matrix(), check=check)
        np.testing.assert_allclose(np.abs(np.sum(found * g, axis=-1)), 1, atol=1e-15)


def test_points_of_three_and_four_coordinates():
    g, points = SE3.random((7,), rng=3), rng.normal(size=(7, 3))
    whole = SE3.act(g, np.concatenate([points, np.ones((7, 1))], axis=-1))
    np.testing.assert_allclose(whole[:, :3], SE3.act(g, points), atol=1e-14)
    np.testing.assert_array_equal(whole[:, 3], 1)
    far = SE3.act(g, np.concatenate([points, np.zeros((7, 1))], axis=-1))
    np.testing.assert_allclose(far[:, :3], SO3.act(g[:, :4], points), atol=1e-14)


def test_wrong_matrices_and_singular_jacobians():
    g = SE3.random((20,), rng=4)
    for group, matrices in ((SO3, SO3.matrix(g[:, :4])), (SE3, SE3.matrix(g))):
        for change in (-1.0, 1.001, np.nan):
            bad = matrices.copy()
            bad[13, :3, :3] *= change
            with pytest.raises(af.AffinorError, match="element 13 of the batch"):
                group.from_matrix(bad)
            assert group.from_matrix(bad, check=False).shape == (20, group.coordinate_count)
    bad = SE3.matrix(g)
    bad[7, 3, 0] = 0.1
    with pytest.raises(af.AffinorError, match="element 7 of the batch"):
        SE3.from_matrix(bad)
    turn = np.zeros((12, 6))
    turn[10, 1] = 2 * np.pi
    for method in (SE3.left_jacobian_inverse, SE3.right_jacobian_inverse):
        with pytest.raises(af.MathematicsError, match="element 10 of the batch"):
            method(turn)
    with pytest.raises(af.MathematicsError, match="element 10 of the batch"):
        SO3.left_jacobian_inverse(turn[:, :3])
    # rounded entries are read with the tolerance of elements
    rounded = SO3.matrix(g[:, :4]).round(7)
    np.testing.assert_allclose(SO3.matrix(SO3.from_matrix(rounded)), rounded, atol=1e-6)


def test_points_that_do_not_fit():
    with pytest.raises(ValueError, match=r"\(..., 3\) or \(..., 4\), not \(2,\)"):
        SE3.act(SE3.identity(), [1, 2])
    with pytest.raises(ValueError, match=r"\(..., 3\), not \(\)"):
        SO3.act(SO3.identity(), 1.0)
    with pytest.raises(ValueError, match="broadcast"):
        SO3.act(np.ones((2, 4)), np.ones((3, 3)))
