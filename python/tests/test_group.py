"""Groups over arrays: laws, broadcasting, and the rotations of SciPy and jaxlie."""

import copy
import importlib.util
import json
import pickle
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import affinor as af
from affinor import SE3, SO3

NAMES = ["so2", "so3", "se2", "se3", "se_2(3)", "sl2", "R^3", "heisenberg(5)", "so(4)", "su(2)", "gl(2)", "so3+R^3", "se3+so3", "aff1"]
rng = np.random.default_rng(5)


@pytest.mark.parametrize("name", NAMES)
def test_laws(name):
    group = af.Group(name)
    x, y = rng.normal(scale=0.3, size=(2, 4, 5, group.dimension))
    g, h = group.exp(x), group.exp(y)
    assert g.shape == (4, 5, group.coordinate_count)
    one = group.identity()
    np.testing.assert_allclose(group.log(g), x, atol=1e-10)
    np.testing.assert_allclose(group.compose(g, group.inverse(g)), np.broadcast_to(one, g.shape), atol=1e-10)
    np.testing.assert_allclose(group.compose(one, g), g, atol=1e-12)
    np.testing.assert_allclose(group.between(g, h), group.compose(group.inverse(g), h), atol=1e-12)
    left = group.compose(group.compose(g, h), g)
    np.testing.assert_allclose(left, group.compose(g, group.compose(h, g)), atol=1e-10)
    moved = group.compose(group.compose(g, group.exp(y)), group.inverse(g))
    np.testing.assert_allclose(group.exp(group.adjoint(g, y)), moved, atol=1e-9)
    np.testing.assert_allclose(np.einsum("...ij,...j->...i", group.adjoint_matrix(g), y), group.adjoint(g, y), atol=1e-10)
    np.testing.assert_allclose(group.tangent_left_inverse(x, group.tangent_left(x, y)), y, atol=1e-9)
    np.testing.assert_allclose(group.bracket(x, y), -group.bracket(y, x), atol=1e-12)
    np.testing.assert_allclose(group.from_matrix(group.matrix(g)), g, atol=1e-7)
    np.testing.assert_allclose(group.interpolate(g, h, 1.0), h, atol=1e-10)
    np.testing.assert_allclose(group.project(g), g, atol=1e-10)


def test_every_name_of_the_catalogue_has_its_group():
    for _, _, example in af.catalogue():
        try:
            algebra = af.LieAlgebra(example)
        except af.AffinorError:
            continue
        if algebra.dimension > 15 or algebra.parameters:
            continue
        try:
            group = algebra.group()
        except af.AffinorError as error:
            assert "matrices" in str(error)
            continue
        x = rng.normal(scale=0.1, size=(3, group.dimension))
        np.testing.assert_allclose(group.log(group.exp(x)), x, atol=1e-8)


def test_copies_are_the_same_group():
    doubled = af.LieAlgebra("heisenberg3").change_basis(np.diag([1, 1, 2])).group()
    brackets = af.LieAlgebra("[x,y]=z", basis="x y z").group()
    parameter = af.Geometry("so3", metric="diag(1,2,3)").group()
    for group in (doubled, brackets, parameter, SO3, SE3, af.Group("so3+R^3")):
        g, h = group.random((2, 5), rng=4)
        for other in (pickle.loads(pickle.dumps(group)), copy.copy(group), copy.deepcopy(group)):
            assert type(other) is type(group) and other == group and hash(other) == hash(group)
            assert other.name == group.name
            np.testing.assert_array_equal(other.compose(g, h), group.compose(g, h))
    restored = pickle.loads(pickle.dumps(doubled))
    np.testing.assert_allclose(restored.compose([1, 0, 0], [0, 1, 0]), [1, 1, 0.25], atol=1e-15)


def test_equal_groups_have_equal_definitions():
    single, double = (af.LieAlgebra(f"[x,y]={k}*z", basis="x y z").group() for k in (1, 2))
    assert not np.array_equal(single.bracket([1, 0, 0], [0, 1, 0]), double.bracket([1, 0, 0], [0, 1, 0]))
    assert single != double and len({single, double}) == 2
    for name in ("se3", "so3", "heisenberg3", "so3+R^3"):
        others = [af.LieAlgebra(name).group(), af.Geometry(name, "plus").group(), af.Group(name)]
        assert all(other == af.Group(name) for other in others) and len(set(others)) == 1
    assert af.Group("so3") == SO3 != SE3 and SO3 != "so3"


@given(st.integers(0, 2**32), st.floats(1e-12, 3.1))
def test_rotations_of_scipy(seed, size):
    x = np.random.default_rng(seed).normal(size=(2, 3, 3))
    x *= size / np.linalg.norm(x, axis=-1, keepdims=True)
    theirs = Rotation.from_rotvec(x.reshape(-1, 3))
    g = SO3.exp(x)
    np.testing.assert_allclose(SO3.matrix(g).reshape(-1, 3, 3), theirs.as_matrix(), atol=1e-14)
    np.testing.assert_allclose(SO3.log(g), x, atol=1e-13)
    np.testing.assert_allclose(SO3.log(SO3.from_scipy(theirs)).reshape(2, 3, 3), x, atol=1e-13)
    np.testing.assert_allclose(SO3.to_scipy(g.reshape(-1, 4)).as_rotvec(), x.reshape(-1, 3), atol=1e-13)
    points = np.random.default_rng(seed).normal(size=(6, 3))
    np.testing.assert_allclose(SO3.act(g.reshape(-1, 4), points), theirs.apply(points), atol=1e-13)
    h = SO3.compose(g, g[::-1]).reshape(-1, 4)
    expected = theirs * Rotation.from_rotvec(x[::-1].reshape(-1, 3))
    np.testing.assert_allclose(SO3.matrix(h), expected.as_matrix(), atol=1e-13)


def test_quaternion_order():
    q = SO3.exp([0, 0, np.pi / 2])
    np.testing.assert_allclose(q, [np.sqrt(0.5), 0, 0, np.sqrt(0.5)])
    np.testing.assert_allclose(SO3.to_quaternion(q, scalar_first=False), [0, 0, np.sqrt(0.5), np.sqrt(0.5)])
    np.testing.assert_allclose(SO3.from_quaternion([0, 0, 2, 2], scalar_first=False), q)
    np.testing.assert_allclose(SE3.exp([0, 0, np.pi / 2, 0, 0, 0])[:4], q)


JAXLIE = """
import json, sys, numpy as np, jaxlie
vectors, twists = json.load(sys.stdin)
quaternions = [np.asarray(jaxlie.SO3.exp(np.array(x)).wxyz).tolist() for x in vectors]
matrices = [np.asarray(jaxlie.SE3.exp(np.array(x)).as_matrix()).tolist() for x in twists]
print(json.dumps([quaternions, matrices]))
"""


def test_jaxlie():
    if importlib.util.find_spec("jaxlie") is None:
        pytest.skip("jaxlie is not installed")
    x, twists = rng.normal(size=(20, 3)), rng.normal(size=(5, 6))
    # JAX has threads, and other tests fork this process; translations come first in jaxlie
    given = json.dumps([x.tolist(), np.roll(twists, 3, axis=1).tolist()])
    done = subprocess.run([sys.executable, "-c", JAXLIE], input=given, capture_output=True, text=True, check=True)
    quaternions, matrices = map(np.array, json.loads(done.stdout))
    ours = SO3.exp(x)
    np.testing.assert_allclose(ours * np.sign(ours[:, :1]), quaternions * np.sign(quaternions[:, :1]), atol=1e-6)
    np.testing.assert_allclose(SE3.matrix(SE3.exp(twists)), matrices, atol=1e-5)


def test_arrays_of_every_kind():
    x = rng.normal(size=(6, 4, 3))
    expected = SO3.exp(x)
    for other in (np.asfortranarray(x), x.tolist(), x[::-1][::-1], x.astype(">f8")):
        np.testing.assert_array_equal(SO3.exp(other), expected)
    np.testing.assert_array_equal(SO3.exp(x[::2, ::-1]), expected[::2, ::-1])
    readonly = x.copy()
    readonly.flags.writeable = False
    np.testing.assert_array_equal(SO3.exp(readonly), expected)
    np.testing.assert_allclose(SO3.exp(x.astype(np.float32)), expected, atol=1e-6)
    assert SO3.exp([1, 0, 0]).dtype == np.float64
    assert SO3.exp(np.zeros((0, 3))).shape == (0, 4)
    one = SO3.exp([0.1, 0.2, 0.3])
    assert SO3.compose(expected, one).shape == SO3.compose(one, expected).shape == (6, 4, 4)
    assert SO3.compose(expected[:, None], expected[None, :]).shape == (6, 6, 4, 4)
    result = SO3.exp(x)
    result[0] = 1  # fresh and writable


def test_large_batches_agree_with_small_ones():
    x = rng.normal(size=(5000, 3))
    x[::7] *= 10
    whole = SO3.exp(x)
    np.testing.assert_array_equal(whole, np.array([SO3.exp(row) for row in x]))
    np.testing.assert_array_equal(SO3.log(whole), np.array([SO3.log(row) for row in whole]))
    products = SO3.compose(whole, whole[::-1])
    np.testing.assert_array_equal(products, np.array([SO3.compose(g, h) for g, h in zip(whole, whole[::-1], strict=True)]))


def test_failures_name_the_element():
    with pytest.raises(af.AffinorError, match="element 2 of the batch"):
        SO3.log([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0]])
    with pytest.raises(af.AffinorError):
        SO3.from_matrix(2 * np.eye(3))


def test_points_and_means():
    g = SE3.random((4,), rng=1)
    points = rng.normal(size=(4, 3))
    matrix = SE3.matrix(g)
    np.testing.assert_allclose(SE3.act(g, points), np.einsum("nij,nj->ni", matrix[:, :3, :3], points) + matrix[:, :3, 3])
    mean = SO3.mean(SO3.exp([[0.1, 0, 0], [0.3, 0, 0]]))
    np.testing.assert_allclose(SO3.log(mean), [0.2, 0, 0], atol=1e-14)
    np.testing.assert_array_equal(SE3.random(3, rng=7), SE3.random(3, rng=7))


def test_affine_maps_are_known_by_their_matrices():
    e = np.eye(9, dtype=int).reshape(3, 3, 3, 3)
    plane = [e[1, 0] - e[0, 1], e[0, 2], e[1, 2]]
    moving = af.LieAlgebra.from_matrices(plane, name="motions").group()
    turning = af.LieAlgebra.from_matrices([e[j, i] - e[i, j] for i, j in ((1, 2), (2, 0), (0, 1))], name="sensor").group()
    points = rng.normal(size=(4, 2))
    for group in (moving, af.Group("aff(2)"), af.Group("se2")):
        g = group.random(rng=2)
        whole = np.einsum("ij,nj->ni", group.matrix(g), np.hstack([points, np.ones((4, 1))]))
        np.testing.assert_allclose(group.act(g, points), whole[:, :2], atol=1e-14)
    for group in (turning, SO3):
        with pytest.raises(ValueError, match="points"):
            group.act(group.identity(), points)


def test_geodesics_between_points():
    # a chart: the great-circle distance, and antipodal points
    sphere = af.Geometry.on_chart("theta phi", [1, "sin(theta)^2"])
    found = sphere.geodesics([1, 0.5], {"phi": 2.5, "theta": 2})
    assert found["schema"] == "affinor.geodesic/1" and found["components"] == ["theta", "phi"]
    curve = found["geodesics"][0]
    assert curve["length"] == pytest.approx(2.145110075517188557751268, rel=1e-11)
    assert curve["residual"] < 1e-10 and not curve["conjugate"]
    antipodal = sphere.geodesics("pi/2, 0", "pi/2, pi")["geodesics"][0]
    assert antipodal["conjugate"] and antipodal["length"] == pytest.approx(np.pi)
    # a group: the angle of a rotation, also by its matrix, and the way around
    rotations = af.Geometry("so3", metric="identity")
    ways = rotations.geodesics(np.zeros(3), [0.3, 1.0, -0.5], starts=12)["geodesics"]
    assert ways[0]["length"] == pytest.approx(np.sqrt(1.34)) and len(ways) > 1
    same = rotations.geodesics([0, 0, 1], np.eye(3))["geodesics"][0]
    np.testing.assert_allclose(same["velocity"], [0, 0, -1], atol=1e-10)
    np.testing.assert_allclose(rotations.geodesic_between(SO3.identity(), SO3.exp([0.3, 1, -0.5])), ways[0]["velocity"], atol=1e-8)
    # a homogeneous space, with and without a metric
    assert af.Geometry("S^2", metric="identity").geodesics([0.7, 0], [0, 1.1])["geodesics"][0]["length"] == pytest.approx(
        np.arccos(np.cos(0.7) * np.cos(1.1))
    )
    natural = af.Geometry("S^2").geodesics([0, 0], [0.3, 0.4])
    assert natural["connection"] == "natural" and natural["geodesics"][0]["length"] is None
    for wrong, message in [
        (lambda: sphere.geodesics([1, 1], [1, 1]), "the end point is the start point"),
        (lambda: sphere.geodesics([1], [1, 1]), "has 1 value"),
        (lambda: sphere.geodesics({"psi": 1, "theta": 1}, [1, 1]), "psi"),
        (lambda: af.Geometry("so3", metric="diag(a,1,1)").geodesics([0, 0, 0], [1, 0, 0]), "numbers for a"),
        (lambda: af.Geometry("so3", affinities=af.LieAlgebra("so3").structure / 2).geodesics([0, 0, 0], [1, 0, 0]), "with a name"),
        (lambda: sphere.geodesics([1, 1], [2, 2], starts=0), "positive"),
    ]:
        with pytest.raises(ValueError, match=message):
            wrong()


def test_transport_and_geodesics():
    turn = [0, 0, 2 * np.pi]
    np.testing.assert_allclose(af.Geometry("M3").subs({f"J{k}": int(k in ("11", "22", "33")) for k in ("11", "12", "13", "22", "23", "33")}).transport(turn), np.eye(3), atol=1e-13)
    np.testing.assert_allclose(af.Geometry("SO3").transport(turn), np.diag([-1, -1, 1]), atol=1e-13)
    body = af.Geometry("so3", metric="diag(1,2,3)")
    path = body.geodesic([0.3, 1.0, -0.2], np.linspace(0.1, 2, 5))
    energy = np.einsum("ti,i,ti->t", path.tangents, [1, 2, 3], path.tangents)
    np.testing.assert_allclose(energy, energy[0], rtol=1e-10)
    np.testing.assert_allclose(np.linalg.norm(path.elements, axis=-1), 1, rtol=1e-12)
    there = body.geodesic([0.2, 0.1, 0.3], [1.0]).elements[0]
    np.testing.assert_allclose(body.geodesic_between(SO3.identity(), there), [0.2, 0.1, 0.3], atol=1e-8)
    loop = SO3.exp(np.linspace(0, 1, 200)[:, None] * np.array(turn))
    np.testing.assert_allclose(af.Geometry("SO3").transport_along(loop), np.diag([-1, -1, 1]), atol=1e-10)
    by_affinities = af.Geometry("so3", affinities=af.LieAlgebra("so3").structure / 2)
    np.testing.assert_allclose(by_affinities.transport(turn), np.diag([-1, -1, 1]), atol=1e-13)


def layouts(x):
    """Arrays of other layouts and types give the same numbers."""
    packed = np.zeros(len(x), dtype=[("tag", "f4"), ("x", "f8", (x.shape[1],))])
    packed["x"] = x
    wide = np.zeros((len(x), 2 * x.shape[1]))
    wide[:, ::2] = x
    shifted = np.frombuffer(b"x" + x.tobytes(), dtype=np.uint8)[1:].view(np.float64).reshape(x.shape)
    fixed = x.copy()
    fixed.flags.writeable = False
    yield from (np.asfortranarray(x), x[::-1].copy()[::-1], x[:, ::-1].copy()[:, ::-1], packed["x"], wide[:, ::2], shifted)
    yield from (fixed, x.astype(">f8"), x.astype(object), x.tolist())


@pytest.mark.parametrize("dtype", [np.float64, np.int64])
def test_empty_arrays_anywhere_in_memory(dtype):
    memory = np.zeros(100, dtype=np.uint8)
    elements, indices = (np.ndarray(shape, dtype, buffer=memory.data, offset=1) for shape in ((0, 4), (1, 0)))
    assert SO3.adjoint_matrix(elements).shape == (0, 3, 3) and SO3.log(elements).shape == (0, 3)
    if dtype is np.int64:
        assert af.Tensor.from_coo(indices, [], "^", 3).nnz == 0


@pytest.mark.parametrize("count", [1, 5, 3000])
def test_layouts(count):
    x, y = rng.normal(size=(2, count, 3))
    g, h = SO3.exp(x), SO3.exp(y)
    for other in layouts(x):
        np.testing.assert_array_equal(SO3.exp(other), g)
    for other in layouts(g):
        np.testing.assert_array_equal(SO3.log(other), SO3.log(g))
        np.testing.assert_array_equal(SO3.compose(h, other), SO3.compose(h, g))
        np.testing.assert_array_equal(SO3.matrix(other), SO3.matrix(g))


def test_a_rotation_does_not_depend_on_its_place_or_on_threads():
    """Large arrays (from NumPy), parts of any length, and single vectors give the same numbers, on both sides of every threshold."""
    x = rng.normal(size=(70_001, 3)) * rng.choice([1e-170, 1e-8, 0.3, 1, 3, 30], size=(70_001, 1))
    g, logs = SO3.exp(x), SO3.log(SO3.exp(x))
    products = SO3.compose(g, g[::-1])
    assert g.flags.owndata and g.flags.writeable and g.flags.c_contiguous
    for start, stop in [(0, 1), (17, 18), (3, 520), (511, 513), (1000, 1031), (69_990, 70_001)]:
        np.testing.assert_array_equal(SO3.exp(x[start:stop]), g[start:stop])
        np.testing.assert_array_equal(SO3.log(g[start:stop]), logs[start:stop])
        np.testing.assert_array_equal(SO3.compose(g[start:stop], g[::-1][start:stop]), products[start:stop])
    try:
        for count in (1, 3):
            af.set_threads(count)
            np.testing.assert_array_equal(SO3.exp(x), g)
            np.testing.assert_array_equal(SO3.log(g), logs)
    finally:
        af.set_threads(0)
    np.testing.assert_allclose(g, Rotation.from_rotvec(x).as_quat(scalar_first=True), atol=4e-15)
    bad = g.copy()
    bad[65_000] = 0
    with pytest.raises(af.MathematicsError, match="element 65000 of the batch"):
        SO3.log(bad)


def test_matrices_of_one_number_act_on_points():
    group = af.Group("gl1")
    x, points = np.array([[0.1], [0.2], [0.3]]), np.array([[1.0], [2.0], [3.0]])
    np.testing.assert_allclose(group.act(group.exp(x), points), np.exp(x) * points)
    np.testing.assert_allclose(group.act(group.exp([0.5]), [2.0]), [2 * np.exp(0.5)])
    with pytest.raises(ValueError, match="not matrices that act"):
        af.Group("R^1").act([0.5], [2.0])


def test_what_has_no_direction_is_refused():
    for group, g in ((SO3, [0, 0, 0, 0]), (SO3, [np.nan, 0, 0, 1]), (af.Group("so(4)"), np.zeros(16)), (af.SO2, [0, 0])):
        with pytest.raises(af.MathematicsError, match="invalid element of the group"):
            group.project(g)
    geometry = af.Geometry("so3", metric=[1, 2, 3])
    calls = (
        lambda: geometry.transport([np.nan, 0, 0]),
        lambda: geometry.transport([[1, 0, 0], [0, np.inf, 0]]),
        lambda: geometry.geodesic([1, 2, 3], [np.nan]),
        lambda: geometry.geodesic([1, 2, 3], [1], [0, 0, 0, 0]),
        lambda: geometry.geodesic([1, 2, 3], [1], tolerance=-1),
        lambda: geometry.geodesic_between([1, 0, 0, 0], [0, 1, 0, 0], tolerance=-1),
        lambda: af.Geometry("sl2", metric="identity").geodesic([1, 2, 3], [1], [2, 0, 0, 1]),
    )
    for call in calls:
        with pytest.raises(ValueError, match="finite|invalid element|not positive"):
            call()


def test_lengths_of_quaternions():
    for length in (5e-324, 1e-200, 1e-3, 1, 1e200, 1.7e308):
        np.testing.assert_allclose(SO3.from_quaternion([length, 0, 0, -length]), np.array([1, 0, 0, -1]) / np.sqrt(2))
    geodesic = af.Geometry("so3", metric=[1, 2, 3]).geodesic([1, 2, 3], [0.5, 1], [-2, 0, 0, 0])
    np.testing.assert_allclose(np.linalg.norm(geodesic.elements, axis=1), 1)
    assert geodesic.elements[0, 0] < 0


def test_times_of_a_geodesic_are_its_own():
    times = np.array([0.5, 1])
    geodesic = af.Geometry("so3", metric=[1, 2, 3]).geodesic([1, 2, 3], times)
    times[:] = 99
    assert geodesic.times.tolist() == [0.5, 1]


def test_generators_are_derivatives_of_matrices():
    for name in ["so3", "se3", "R^3", "se2", "sl2", "heisenberg(3)", "so3+R^3", "se2+so3+R^1", "su(2)+so2"]:
        group = af.Group(name)
        generators = group.generators()
        assert generators.shape[0] == group.dimension
        steps = 1e-6 * np.eye(group.dimension)
        slopes = (group.matrix(group.exp(steps)) - group.matrix(group.exp(-steps))) / 2e-6
        assert np.allclose(generators, slopes.reshape(generators.shape), atol=1e-9), name
