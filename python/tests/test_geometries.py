"""Geometries in bulk agree with single geometries; errors of metrics name their index."""

import numpy as np
import pytest
import sympy as sp

import affinor as af

rng = np.random.default_rng(3)
KEYS = ["affinities", "torsion", "curvature", "ricci", "scalar_curvature", "einstein", "kretschmann", "nonmetricity"]
matrix = [[1, 2, 0], [0, 1, -1], [1, 0, 3]]
ALGEBRAS = {
    "so3": "so3",
    "sl2": "sl2",
    "heisenberg(3)": "heisenberg(3)",
    "so3, dense basis": af.LieAlgebra("so3").change_basis(matrix),
    "aff(1)+R^2": "aff(1)+R^2",
    "so(4)": "so(4)",
}


def metrics(n, count, signature=0):
    """Random symmetric matrices; positive definite, or with that many negative directions."""
    a = np.eye(n) + rng.uniform(-0.4, 0.4, size=(count, n, n)) / np.sqrt(n)
    signs = np.ones(n)
    signs[:signature] = -1
    return np.einsum("kai,a,kaj->kij", a, signs, a)


def close(found, expected, tolerance=1e-12):
    size = max(np.abs(expected).max(initial=0), 1e-3)
    np.testing.assert_allclose(found, expected, atol=tolerance * size, rtol=0)


@pytest.mark.parametrize("name", ALGEBRAS)
@pytest.mark.parametrize("connection", ["levi-civita", "plus", "1/3"])
def test_one_by_one(name, connection):
    space = ALGEBRAS[name]
    n = af.LieAlgebra(space).dimension
    g = np.concatenate([metrics(n, 5), metrics(n, 4, 1)])
    family = af.Geometries(space, g, connection=connection if "/" not in connection else sp.Rational(connection))
    for key in KEYS + (["weyl"] if n > 3 and connection == "levi-civita" else []):
        found = family.quantity(key)
        assert found.dtype == np.float64 and len(found) == len(g)
        for at, metric in enumerate(g):
            factor = connection if "/" not in connection else sp.Rational(connection)
            single = af.Geometry(space, factor, metric.tolist(), scalar="float").quantity(key)
            close(found[at], single.to_numpy(float))
    close(family.ricci, family.quantity("ricci"), 0)


def test_batches_and_threads():
    g = metrics(3, 6000)
    family = af.Geometries("so3", g)
    whole = family.ricci
    assert whole.shape == (6000, 3, 3) and whole.flags.c_contiguous
    grid = af.Geometries("so3", g.reshape(60, 100, 3, 3))
    assert grid.batch_shape == (60, 100)
    np.testing.assert_array_equal(grid.ricci.reshape(6000, 3, 3), whole)
    for at in (0, 7, 8, 4001, 5999):
        np.testing.assert_array_equal(af.Geometries("so3", g[at]).ricci, whole[at])
    try:
        af.set_threads(1)
        np.testing.assert_array_equal(family.ricci, whole)
    finally:
        af.set_threads(0)
    assert af.Geometries("so3", np.zeros((0, 3, 3))).curvature.shape == (0, 3, 3, 3, 3)
    np.testing.assert_array_equal(af.Geometries("so3", np.asfortranarray(g)[::-1]).ricci, whole[::-1])


def test_parameters_of_brackets():
    brackets = "[x, z] = x, [y, z] = h*y + k*x"
    h, k = np.linspace(-2, 2, 5), np.array([[0.5], [2.0]])
    g = metrics(3, 5)
    family = af.Geometries(brackets, g, parameters={"h": h, sp.Symbol("k"): k}, basis="x y z")
    assert family.batch_shape == (2, 5)
    found = family.curvature
    for a in range(2):
        for b in range(5):
            exact = af.LieAlgebra(brackets, basis="x y z").subs({"h": str(h[b]), "k": str(k[a, 0])})
            close(found[a, b], af.Geometry(exact, metric=g[b].tolist(), scalar="float").curvature.to_numpy(float))


def test_sectional_curvature_of_planes():
    g = metrics(6, 4)
    x, y = rng.normal(size=(2, 3, 4, 6))
    family = af.Geometries("so(4)", g)
    found, r = family.sectional_curvature(x, y), family.curvature
    above = np.einsum("nijkl,...nk,...nl,...nj,nim,...nm->...n", r, x, y, y, g, x, optimize=True)
    xx, yy, xy = (np.einsum("nij,...ni,...nj->...n", g, a, b) for a, b in ((x, x), (y, y), (x, y)))
    close(found, above / (xx * yy - xy**2), 1e-11)
    with pytest.raises(af.MathematicsError, match="plane is degenerate in row 1 "):
        family.sectional_curvature([[1, 0, 0, 0, 0, 0], [1, 2, 3, 4, 5, 6], [1] * 6, [2] * 6], [[0, 1, 0, 0, 0, 0], [2, 4, 6, 8, 10, 12], [1, 0, 0, 0, 0, 0], [1, 0, 0, 0, 0, 0]])


@pytest.mark.parametrize("name", ["so3", "so(4)", "aff(1)+R^2"])
def test_eigenvalues_of_ricci(name):
    n = af.LieAlgebra(name).dimension
    g = metrics(n, 200)
    family = af.Geometries(name, g)
    found = family.ricci_eigenvalues
    assert found.dtype == np.float64 and (np.diff(found, axis=-1) >= 0).all()
    expected = np.sort(np.linalg.eigvals(np.linalg.solve(g, family.ricci)).real, axis=-1)
    close(found, expected, 1e-10)
    close(found.sum(axis=-1), family.scalar_curvature, 1e-10)
    mixed = np.concatenate([g[:3], metrics(n, 2, 1)])
    complex_ones = af.Geometries(name, mixed).ricci_eigenvalues
    assert complex_ones.dtype == np.complex128
    close(complex_ones.sum(axis=-1).real, af.Geometries(name, mixed).scalar_curvature, 1e-9)


@pytest.mark.parametrize("key", ["affinities", "ricci", "scalar_curvature", "curvature"])
def test_derivatives_by_the_metric(key):
    """Derivatives agree with central differences along a direction and with the full derivative, and scaling is homogeneous."""
    g = metrics(3, 6)
    h = rng.normal(size=(6, 3, 3))
    h = h + np.swapaxes(h, -1, -2)
    family, s = af.Geometries("sl2", g), 1e-6
    rate = family.derivative(key, h)
    ahead, behind = (af.Geometries("sl2", g + sign * s * h).quantity(key) for sign in (1, -1))
    close(rate, (ahead - behind) / (2 * s), 1e-6)
    full = family.derivative(key)
    assert full.shape == (*rate.shape, 3, 3)
    axes = (slice(None), *(None,) * (full.ndim - 3))
    close(np.sum(full * h[axes], axis=(-2, -1)), rate, 1e-11)
    # S is homogeneous of degree -1 in the metric, the tensors with lower indices of degree 0
    degree = -1 if key == "scalar_curvature" else 0
    close(family.derivative(key, g), degree * family.quantity(key), 1e-10)


def test_wrong_metrics_are_named():
    good = metrics(3, 2000)
    for change, words in (("skew", "not symmetric"), ("singular", "degenerate"), ("nan", "NaN"), ("inf", "inf"), ("zero", "degenerate")):
        bad = good.copy()
        if change == "skew":
            bad[1500, 0, 2] += 1e-9
        elif change == "singular":
            bad[1500] = [[1, 2, 3], [2, 4, 6], [3, 6, 1]]
        elif change == "zero":
            bad[1500] = 0
        else:
            bad[1500, 1, 1] = float(change)
        with pytest.raises(af.MetricError, match=f"metric 1500 of the batch.*{words}"):
            af.Geometries("so3", bad)
    # the result does not depend on units of the basis
    scales = np.array([1e-8, 1.0, 1e8])
    assert np.isfinite(af.Geometries("so3", good * scales[:, None] * scales).scalar_curvature).all()


def test_the_space_gives_the_connection():
    """A connection in a text, a dict or a Geometry is the default; the argument overrides it."""
    g = metrics(3, 4)
    plus = af.Geometries("so3", g, connection="plus").torsion
    assert np.abs(plus).max() > 0.5
    definition = {"dimension": 3, "structure_constants": [[1, 2, 3, "1"], [2, 3, 1, "1"], [3, 1, 2, "1"]], "connection": "plus"}
    for space in ("so3@plus", definition, af.LieAlgebra("so3@plus"), af.Geometry("so3@plus"), af.Geometry("so3", "plus")):
        np.testing.assert_array_equal(af.Geometries(space, g).torsion, plus)
        assert np.abs(af.Geometries(space, g, connection="levi-civita").torsion).max() < 1e-12
    assert np.abs(af.Geometries("so3@levi-civita", g).torsion).max() < 1e-12
    # a Geometry without a metric has the connection zero by default
    zero = af.Geometries("so3", g, connection="zero").affinities
    np.testing.assert_array_equal(af.Geometries(af.Geometry("so3"), g).affinities, zero)
    np.testing.assert_array_equal(af.Geometries("so3@plus", g, connection="zero").affinities, zero)
    third = af.Geometries("so3@lambda=3/10", g).ricci
    for factor in (0.3, np.float64(0.3), sp.Rational(3, 10), "3/10", "0.3", af.Geometry("so3", "3/10")):
        space, connection = (factor, None) if isinstance(factor, af.Geometry) else ("so3", factor)
        np.testing.assert_allclose(af.Geometries(space, g, connection=connection).ricci, third, rtol=1e-15)
    assert af.Geometry("so3", "1/3").lambda_ == sp.Rational(1, 3)


@pytest.mark.parametrize("space", [
    "so3;metric=diag(1,2,3)", "so3@zero;metric=identity", "so3@levi-civita;metric=identity",
    {"basis": ["x", "y", "z"], "brackets": ["[x, y] = z"], "metric": "identity"}, af.Geometry("so3", metric="identity"),
])  # fmt: skip
@pytest.mark.parametrize("connection", [None, "plus"])
def test_a_second_metric_is_rejected(space, connection):
    with pytest.raises(ValueError, match="the metric is given twice"):
        af.Geometries(space, np.eye(3), connection=connection)


def test_metrics_of_names_and_algebras_are_replaced(tmp_path):
    g = metrics(3, 2)
    flat = af.Geometries("so3", g).ricci
    for space in (af.Geometry("so3;metric=identity").algebra, af.LieAlgebra("so3;metric=identity")):
        np.testing.assert_array_equal(af.Geometries(space, g).ricci, flat)
    with pytest.raises(ValueError, match="given twice"):
        af.Geometries("so3;metric=identity", g)
    # the connection of M(3) is plus
    plus = af.Geometries("M(3)", g, connection="plus").torsion
    np.testing.assert_array_equal(af.Geometries("M(3)", g).torsion, plus)
    close(plus[1], af.Geometry("M(3)", metric=g[1].tolist(), scalar="float").torsion.to_numpy(float))
    path = tmp_path / "so3.toml"
    path.write_text('basis = ["x", "y", "z"]\nbrackets = ["[x, y] = z"]\nmetric = "identity"\n')
    for space in (path, str(path), f"{path}@plus"):
        with pytest.raises(ValueError, match="given twice"):
            af.Geometries(space, np.eye(3))


def test_connections_by_tensors_are_rejected():
    constants = af.LieAlgebra("so3").structure
    for keys, words in (({"affinities": constants}, "by tensors"), ({"connection": "plus", "frame": "right"}, "right-invariant")):
        with pytest.raises(ValueError, match=f"{words}.*: pass its algebra"):
            af.Geometries(af.Geometry("so3", **keys), np.eye(3))
    with pytest.raises(TypeError, match="not a Geometry: pass its algebra"):
        af.LieAlgebra(af.Geometry("so3"))


def test_metrics_are_copied():
    g = np.eye(3)
    bodies = af.Geometries("so3", g)
    g *= np.nan
    assert bodies.scalar_curvature == 1.5 and np.array_equal(bodies.metric, np.eye(3))


WRONG = [
    (lambda: af.Geometries("so3", np.eye(4)), ValueError, r"\(..., 3, 3\), not of the shape \(4, 4\)"),
    (lambda: af.Geometries(None, np.eye(3)), TypeError, "not NoneType"),
    (lambda: af.Geometries(3, np.eye(3)), TypeError, "not int"),
    (lambda: af.Geometries("so3", np.eye(3), parameters=[1]), TypeError, "parameters should be a dict .* not list"),
    (lambda: af.Geometries("so3", np.ones(3)), ValueError, r"\(..., n, n\), not of the shape \(3,\)"),
    (lambda: af.Geometries("so3", np.ones((2, 3, 4))), ValueError, r"\(2, 3, 4\)"),
    (lambda: af.Geometries("so3", np.eye(3) * 1j), TypeError, "complex"),
    (lambda: af.Geometries("so3", "identity"), TypeError, "real numbers"),
    (lambda: af.Geometries("nothing", np.eye(3)), af.InputError, "nothing"),
    (lambda: af.Geometries("so3", np.eye(3), connection="left"), af.InputError, "levi-civita"),
    (lambda: af.Geometries("so3", np.eye(3), parameters={"a": 1}), ValueError, "no parameter a"),
    (lambda: af.Geometries("[x,y]=a*x", np.eye(2), basis="x y"), ValueError, "missing: a"),
    (lambda: af.Geometries("[x,y]=a*x", np.eye(2), parameters={"a": "b"}, basis="x y"), TypeError, "real numbers"),
    (lambda: af.Geometries("[x,y]=a*x", np.stack([np.eye(2)] * 3), parameters={"a": [1, 2]}, basis="x y"), ValueError, "broadcast"),
    (lambda: af.Geometries("[x,y]=1/a*x", np.eye(2), parameters={"a": [1, 0]}, basis="x y").ricci, af.MathematicsError, "row 1 of the batch"),
    (lambda: af.Geometries("so3", np.eye(3)).quantity("riemann"), ValueError, "curvature"),
    (lambda: af.Geometries("so3", np.eye(3)).quantity("weyl2"), ValueError, "weyl"),
    (lambda: af.Geometries("so3", np.eye(3), connection="plus").quantity("weyl"), af.MathematicsError, "not defined"),
    (lambda: af.Geometries("so3", np.eye(3)).quantity("sectional_curvature"), ValueError, r"not one of structure, .*sectional_curvature\(x, y\)"),
    (lambda: af.Geometries("so3", np.eye(3)).derivative("sectional_curvature"), ValueError, "not one of structure"),
    (lambda: af.Geometries("so3", np.eye(3)).sectional_curvature([np.nan, 0, 0], [0, 1, 0]), ValueError, "x should be finite, not nan"),
    (lambda: af.Geometries("so3", np.eye(3), connection=np.nan), ValueError, "nan"),
    (lambda: af.Geometries("so3", np.eye(3)).derivative("ricci", np.eye(2)), ValueError, r"\(..., 3, 3\)"),
    (lambda: af.Geometries("so3", np.eye(3)).derivative("ricci", np.triu(np.ones((3, 3)))), af.MetricError, "direction 0 .* not symmetric"),
    (lambda: af.Geometries("so3", np.eye(3)).sectional_curvature([1, 0], [0, 1]), ValueError, r"\(..., 3\)"),
]


@pytest.mark.parametrize("at", range(len(WRONG)))
def test_wrong_arguments(at):
    call, error, words = WRONG[at]
    with pytest.raises(error, match=words):
        call()
