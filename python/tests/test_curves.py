"""Means, distances, splines and rigid transforms of SciPy."""

import numpy as np
import pytest
from scipy.spatial import transform

import affinor as af
from affinor import SE3, SO3

rng = np.random.default_rng(8)
NAMES = ["so3", "se3", "se2", "sl2", "heisenberg(3)", "so3+R^3"]


@pytest.mark.parametrize("name", NAMES)
def test_weighted_means(name):
    """The mean solves its equation, commutes with translations, and is computed along each axis separately."""
    group = af.Group(name)
    g = group.exp(rng.normal(scale=0.3, size=(5, 4, 3, group.dimension)))
    weights = rng.uniform(size=(5, 4, 3))
    for axis, given in [(None, None), (0, None), (-1, weights), ((0, 2), weights), (1, weights[0, :, 0])]:
        m = group.mean(g, given, axis)
        axes = tuple(range(3)) if axis is None else tuple(int(at) % 3 for at in np.atleast_1d(axis))
        w = np.ones((5, 4, 3)) if given is None else (given[None, :, None] + np.zeros((5, 4, 3)) if given.ndim == 1 else given)
        logs = group.log(group.between(np.expand_dims(m, axes), g))
        np.testing.assert_allclose((w[..., None] * logs).sum(axis=axes), 0, atol=1e-12)
        kept = [at for at in range(3) if at not in axes]
        assert m.shape == (*(g.shape[at] for at in kept), group.coordinate_count)
    h = group.exp(rng.normal(scale=0.3, size=group.dimension))
    moved = group.mean(group.compose(h, g), weights)
    np.testing.assert_allclose(moved, group.compose(h, group.mean(g, weights)), atol=1e-11)
    np.testing.assert_allclose(group.mean(g[0, 0]), group.mean(g[:1, 0], axis=1)[0], atol=1e-12)


def test_means_of_scipy():
    theirs = transform.Rotation.from_rotvec(rng.normal(scale=0.05, size=(40, 3)))
    weights = rng.uniform(size=40)
    ours = SO3.mean(SO3.from_scipy(theirs), weights)
    # the mean of SciPy minimizes another distance; the difference is of third order in the size
    np.testing.assert_allclose(SO3.log(ours), theirs.mean(weights).as_rotvec(), atol=1e-4)


def test_distances():
    x = rng.normal(size=(50, 3))
    g, h = SO3.exp(x), SO3.exp(rng.normal(size=(50, 3)))
    angle = (SO3.to_scipy(g).inv() * SO3.to_scipy(h)).magnitude()
    np.testing.assert_allclose(SO3.distance(g, h), angle, atol=1e-13)
    np.testing.assert_allclose(SO3.distance(g[:, None], h[None, :3]).shape, (50, 3))
    a, b, c = SE3.random((3, 20), rng=1)
    form = np.diag([2.0, 2, 2, 1, 1, 1]) + 0.1
    for weights in (None, [1, 1, 1, 4, 4, 4], form):
        found = SE3.distance(a, b, weights)
        np.testing.assert_allclose(found, SE3.distance(SE3.compose(c, a), SE3.compose(c, b), weights), atol=1e-12)
        np.testing.assert_allclose(found, SE3.distance(b, a, weights), atol=1e-12)
    assert SO3.distance(g, g).max() < 1e-15


@pytest.mark.parametrize(
    "weights, words",
    [
        ([1, np.nan, 1], "finite, not nan"),
        ([1, np.inf, 1], "finite, not inf"),
        ([1, -1, 1], "positive"),
        ([[1, 0.1, 0], [0.1, 0, 0], [0, 0, 1]], "positive"),
        (np.eye(3) + np.eye(3, k=1), "symmetric"),
        (np.ones((3, 3)) - 2 * np.eye(3), "positive"),
        ([[1, 2, 0], [2, 1, 0], [0, 0, 1]], "positive"),
    ],
)
def test_weights_of_distances_are_a_metric(weights, words):
    with pytest.raises(ValueError, match=f"weights should be .*{words}"):
        SO3.distance(SO3.identity(), SO3.exp([1, 0, 0]), weights)


def test_weights_of_any_size():
    scales = np.array([1e-150, 1, 1e8])
    form = np.outer(scales, scales) * (np.eye(3) + 0.1)
    np.testing.assert_allclose(SO3.distance(SO3.identity(), SO3.exp([0, 1, 0]), form), np.sqrt(1.1))
    # a form may be degenerate
    assert SE3.distance(SE3.identity(), [1, 0, 0, 0, 3, 4, 0], [1, 1, 1, 0, 0, 0]) == 0
    assert SO3.distance(SO3.identity(), SO3.exp([1, 1, 1]), np.ones((3, 3))) == pytest.approx(3)
    g = SO3.exp([[1, 0, 0], [0, 1, 0]])
    with pytest.raises(ValueError, match="the weights have no finite sum"):
        SO3.mean(g, [1e308, 1e308])
    np.testing.assert_allclose(SO3.mean(g, [1e307, 1e307]), SO3.mean(g), atol=1e-15)


def test_splines_of_wrong_numbers():
    g = SO3.exp([[0, 0, 0], [0, 0, 1]])
    with pytest.raises(ValueError, match="velocities should be finite, not nan"):
        SO3.spline([0, 1], g, velocities=np.full((2, 3), np.nan))
    for name, factor in (("so3", 2), ("so3", 1 + 1e-5), ("se3", 2), ("sl2", 1.1)):
        group = af.Group(name)
        g = group.exp(np.linspace(0, 0.3, 3 * group.dimension).reshape(3, -1))
        group.spline([0, 1, 2], -g if name == "so3" else g)
        g[1] *= factor
        with pytest.raises(ValueError, match="element 1 of the batch is not in the group .*project it first"):
            group.spline([0, 1, 2], g)
    # rounding errors of large elements
    g = af.Group("so(3,1)").exp([[0, 0, 0, 0, 0, 0], [0, 0, 0, 1, 2, 6], [0, 0, 0, 2, 4, 12]])
    af.Group("so(3,1)").spline([0, 1, 2], g)
    far = SE3.exp([[0, 0, 0, 1e7, 0, 0], [1, 0, 0, 1e7, 1, 1]])
    SE3.spline([0, 1], far)
    with pytest.raises(ValueError, match="not in the group"):
        SE3.spline([0, 1], far * [[1], [1.01]])


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("kind", ["cubic", "geodesic"])
def test_splines(name, kind):
    """The curve passes through its elements, its velocity agrees with finite differences, and it commutes with translations."""
    group = af.Group(name)
    times = np.array([0, 0.5, 1.7, 2, 3.5])
    g = group.exp(rng.normal(scale=0.3, size=(5, 2, group.dimension)))
    path = group.spline(times, g, kind)
    assert isinstance(path, af.Spline) and path.kind == kind
    np.testing.assert_allclose(path(times), g, atol=1e-12)
    t, s = np.array([[0.2, 0.5 + 1e-3], [1.9, 3.1]]), 1e-5
    assert path(t).shape == (2, 2, 2, group.coordinate_count)
    slope = (group.log(group.between(path(t), path(t + s))) - group.log(group.between(path(t), path(t - s)))) / (2 * s)
    np.testing.assert_allclose(path.velocity(t), slope, atol=1e-7)
    h = group.exp(rng.normal(scale=0.3, size=group.dimension))
    moved = group.spline(times, group.compose(h, g), kind)
    np.testing.assert_allclose(moved(t), group.compose(h, path(t)), atol=1e-11)
    if kind == "cubic":
        inside, e = times[1:-1], 1e-9
        np.testing.assert_allclose(path.velocity(inside - e), path.velocity(inside + e), atol=1e-6)
        v = rng.normal(scale=0.3, size=(5, 2, group.dimension))
        np.testing.assert_allclose(group.spline(times, g, velocities=v).velocity(times), v, atol=1e-12)
    # a one-parameter group is reproduced
    x = rng.normal(scale=0.2, size=group.dimension)
    line = group.spline(times, group.exp(times[:, None] * x), kind)
    np.testing.assert_allclose(line(t), group.exp(t[..., None] * x), atol=1e-12)
    np.testing.assert_allclose(line.velocity(t), np.broadcast_to(x, (2, 2, group.dimension)), atol=1e-11)


def test_cubics_of_a_vector_group():
    """On R^n the curve is the cubic Hermite polynomial."""
    group, t = af.Group("R^2"), np.linspace(0, 2, 9)
    p = lambda t: np.stack([t**2 - t, 1 + 3 * t**2], axis=-1)  # noqa: E731
    np.testing.assert_allclose(group.spline([0, 0.7, 2], p(np.array([0, 0.7, 2])))(t), p(t), atol=1e-13)


@pytest.mark.skipif(not hasattr(transform, "RigidTransform"), reason="needs SciPy 1.16")
def test_rigid_transforms_of_scipy():
    for shape in ((), (7,)):
        x = rng.normal(size=(*shape, 6))
        g = SE3.exp(x)
        theirs = SE3.to_scipy(g)
        np.testing.assert_allclose(theirs.as_matrix(), SE3.matrix(g), atol=1e-14)
        np.testing.assert_allclose(theirs.as_exp_coords(), SE3.log(g), atol=1e-13)
        back = SE3.from_scipy(theirs)
        np.testing.assert_allclose(SE3.matrix(back), SE3.matrix(g), atol=1e-14)
        points = rng.normal(size=(*shape, 3))
        np.testing.assert_allclose(SE3.act(g, points), theirs.apply(points), atol=1e-13)
    assert isinstance(SE3, af.RigidMotionGroup) and af.Group("se3") == SE3
