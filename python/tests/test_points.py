"""Values at points agree with SymPy, with finite differences and between charts, and wrong points are named."""

import numpy as np
import pytest
import sympy as sp

import affinor as af

rng = np.random.default_rng(5)
t, r, theta, phi, x, y, z = sp.symbols("t r theta phi x y z")
M, a, k = sp.symbols("M a k")

SCHWARZSCHILD = sp.diag(-(1 - 2 * M / r), 1 / (1 - 2 * M / r), r**2, r**2 * sp.sin(theta) ** 2)


def kerr():
    sigma, delta, sine = r**2 + a**2 * sp.cos(theta) ** 2, r**2 - 2 * M * r + a**2, sp.sin(theta) ** 2
    g = sp.diag(-(1 - 2 * M * r / sigma), sigma / delta, sigma, sine * (r**2 + a**2 + 2 * M * r * a**2 * sine / sigma))
    g[0, 3] = g[3, 0] = -2 * M * a * r * sine / sigma
    return g


CHARTS = {
    "schwarzschild": ([t, r, theta, phi], SCHWARZSCHILD, {M: 0.7}),
    "kerr": ([t, r, theta, phi], kerr(), {M: 0.7, a: 0.4}),
    "sphere": ([theta, phi], sp.diag(k**2, k**2 * sp.sin(theta) ** 2), {k: 1.3}),
    "skew": ([x, y, z], sp.Matrix([[2 + sp.sin(x * y), z, 0], [z, 8 + sp.exp(y / 4), x], [0, x, sp.cosh(z) + 9]]), {}),
}


def points(coordinates, count):
    """Points at which all charts are regular."""
    return np.stack([rng.uniform(*((3, 6) if c == r else (0.4, 1.2)), size=count) for c in coordinates], axis=-1)


def by_sympy(coordinates, g):
    """Affinities, curvature, Ricci and scalar curvature of a Levi-Civita connection, by their formulas."""
    n, inverse = len(coordinates), g.inv()
    rates = [[[sp.diff(g[i, j], c) for c in coordinates] for j in range(n)] for i in range(n)]
    lower = lambda i, j, m: (rates[m][j][i] + rates[m][i][j] - rates[i][j][m]) / 2  # noqa: E731
    gamma = [[[sum(inverse[i, m] * lower(j, l, m) for m in range(n)) for l in range(n)] for j in range(n)] for i in range(n)]

    def curvature(i, j, m, l):
        value = sp.diff(gamma[i][l][j], coordinates[m]) - sp.diff(gamma[i][m][j], coordinates[l])
        return value + sum(gamma[i][m][s] * gamma[s][l][j] - gamma[i][l][s] * gamma[s][m][j] for s in range(n))

    each = range(n)
    return gamma, [[[[curvature(i, j, m, l) for l in each] for m in each] for j in each] for i in each]


def numbers(nested, coordinates, values, at):
    names = [*coordinates, *values]
    # with as many digits that cancellation leaves sixteen
    flat = [sp.lambdify(names, item, "mpmath") for item in np.array(nested, dtype=object).ravel()]
    import mpmath

    with mpmath.workdps(40):
        rows = [[float(f(*map(mpmath.mpf, [*point, *values.values()]))) for f in flat] for point in at]
    return np.array(rows).reshape(len(at), *np.shape(np.array(nested, dtype=object)))


def close(found, expected, tolerance=1e-11):
    size = max(np.abs(expected).max(initial=0), 1e-3)
    np.testing.assert_allclose(found, expected, atol=tolerance * size, rtol=0)


@pytest.mark.parametrize("name", CHARTS)
def test_values_of_sympy(name):
    coordinates, g, values = CHARTS[name]
    at = points(coordinates, 4)
    found = af.Geometry.on_chart(coordinates, g).at({**dict(zip(coordinates, at.T, strict=True)), **values})
    gamma, curvature = by_sympy(coordinates, g)
    close(found.metric, numbers(g.tolist(), coordinates, values, at))
    close(found.affinities, numbers(gamma, coordinates, values, at))
    expected = numbers(curvature, coordinates, values, at)
    close(found.curvature, expected)
    ricci = np.einsum("nijil->njl", expected)
    inverse = np.linalg.inv(found.metric)
    # the sums of curvatures cancel in vacuum
    np.testing.assert_allclose(found.ricci, ricci, atol=1e-11 * np.abs(expected).max())
    np.testing.assert_allclose(found.scalar_curvature, np.einsum("njl,njl->n", inverse, ricci), atol=1e-10 * np.abs(expected).max())
    assert not found.torsion.any() and not found.quantity("nonmetricity").any()
    if name in ("schwarzschild", "kerr"):
        assert not found.ricci.any()
        m, spin = values[M], values.get(a, 0)
        radius, u = at[:, 1], spin * np.cos(at[:, 2])
        polynomial = (radius**2 - u**2) * ((radius**2 + u**2) ** 2 - 16 * radius**2 * u**2)
        close(found.quantity("kretschmann"), 48 * m**2 * polynomial / (radius**2 + u**2) ** 6)


@pytest.mark.parametrize("name", CHARTS)
def test_affinities_are_differences_of_the_metric(name):
    coordinates, g, values = CHARTS[name]
    n, at, h = len(coordinates), points(coordinates, 20), 1e-5
    geometry, values = af.Geometry.on_chart(coordinates, g), {str(key): value for key, value in values.items()}
    steps = h * np.eye(n)[:, np.newaxis]
    rates = (geometry.at(at + steps, **values).metric - geometry.at(at - steps, **values).metric) / (2 * h)
    lower = (np.einsum("jnml->nmjl", rates) + np.einsum("lnmj->nmjl", rates) - np.einsum("mnjl->nmjl", rates)) / 2
    expected = np.einsum("nim,nmjl->nijl", np.linalg.inv(geometry.at(at, **values).metric), lower)
    close(geometry.at(at, **values).affinities, expected, 1e-8)


def test_torsion_of_a_frame():
    """The connection that makes an orthonormal frame of the sphere parallel has the torsion ``-c`` and no curvature."""
    frame = {"u": "d_theta", "v": "1/sin(theta)*d_phi"}
    geometry = af.Geometry.on_chart("theta phi", [1, 1], fields=frame, affinities="nabla[u, u] = 0*u")
    angles = rng.uniform(0.3, 2.8, size=(3, 5))
    found = geometry.at({"theta": angles})
    expected = np.zeros((3, 5, 2, 2, 2))
    # [u, v] = -cot(theta) v
    expected[..., 1, 0, 1], expected[..., 1, 1, 0] = 1 / np.tan(angles), -1 / np.tan(angles)
    close(found.torsion, expected, 1e-14)
    assert not found.curvature.any() and not found.affinities.any()
    given = af.Geometry.on_chart("theta phi", [1, 1], fields=frame, affinities="nabla[v, u] = cot(theta)*v\nnabla[v, v] = -cot(theta)*u")
    levi_civita = af.Geometry.on_chart("theta phi", [1, 1], fields=frame)
    for key in ("affinities", "torsion", "curvature"):
        close(given.at({"theta": angles}).quantity(key), levi_civita.at({"theta": angles}).quantity(key), 1e-14)
    close(levi_civita.at({"theta": angles}).scalar_curvature, np.full((3, 5), 2.0), 1e-14)


def test_scalars_do_not_depend_on_the_chart():
    """A sphere in angles and in stereographic coordinates; Schwarzschild in its radius and in the isotropic one."""
    radius, at = 1.7, rng.uniform(0.3, 2.8, size=(50, 2))
    angles = af.Geometry.on_chart([theta, phi], sp.diag(k**2, k**2 * sp.sin(theta) ** 2)).at(at, k=radius)
    factor = 4 * k**2 / (1 + x**2 + y**2) ** 2
    length = 1 / np.tan(at[:, 0] / 2)
    plane = np.stack([length * np.cos(at[:, 1]), length * np.sin(at[:, 1])], axis=-1)
    stereographic = af.Geometry.on_chart([x, y], sp.diag(factor, factor)).at(plane, k=radius)
    close(angles.scalar_curvature, np.full(50, 2 / radius**2), 1e-14)
    close(stereographic.scalar_curvature, angles.scalar_curvature, 1e-14)
    close(np.sort(stereographic.ricci_eigenvalues), np.sort(angles.ricci_eigenvalues), 1e-13)
    close(stereographic.sectional_curvature([1, 2], [0, 1]), angles.sectional_curvature([1, 0], [3, 1]), 1e-12)
    s, m = rng.uniform(2, 9, size=50), 0.8
    psi = 1 + M / (2 * r)
    isotropic = sp.diag(-(((1 - M / (2 * r)) / psi) ** 2), psi**4, psi**4 * r**2, psi**4 * r**2 * sp.sin(theta) ** 2)
    found = af.Geometry.on_chart([t, r, theta, phi], isotropic).at({r: s, theta: 1.1}, M=m)
    usual = af.Geometry.on_chart([t, r, theta, phi], SCHWARZSCHILD).at({r: s * (1 + m / (2 * s)) ** 2, theta: 0.3}, M=m)
    for key in ("kretschmann", "scalar_curvature"):
        close(found.quantity(key), usual.quantity(key), 1e-12)


def test_every_quantity_one_by_one():
    """Arrays have the values of the exact tensors, of charts and of algebras with parameters."""
    keys = ["structure", "inverse_metric", "einstein", "weyl", "nabla_curvature", "ricci_trace_free", "kretschmann"]
    schwarzschild = af.Geometry.on_chart([t, r, theta, phi], SCHWARZSCHILD)
    so3 = af.Geometry("so3", metric=sp.diag(*sp.symbols("p q s")))
    for geometry, values in ((schwarzschild, {"r": 3, "theta": 1, "M": 1}), (so3, {"p": 1, "q": 2, "s": 5})):
        for key in keys:
            exact = geometry.quantity(key)
            if exact is None:
                continue
            symbols = {symbol: values.get(str(symbol), 0) for symbol in geometry.symbols.values()}
            expected = np.vectorize(lambda item: float(sp.sympify(item).subs(symbols)), otypes=[float])(exact.to_numpy(object))  # noqa: B023
            close(geometry.at(values).quantity(key), expected, 1e-13)
    right = af.Geometry("aff(1)", "plus", frame="right")
    close(right.at().affinities, right.affinities.to_numpy(float), 0)
    tensors = af.Geometry("so3", affinities=af.Tensor({(0, 1, 2): "b"}, "^__", dimension=3))
    assert tensors.at(b=[2, 3]).affinities[:, 0, 1, 2].tolist() == [2, 3]


def test_batches_and_threads():
    geometry = af.Geometry.on_chart([t, r, theta, phi], SCHWARZSCHILD)
    at = points([t, r, theta, phi], 3000)
    whole = geometry.at(at, M=1)
    assert whole.batch_shape == (3000,) and whole.dimension == 4 and "PointValues" in repr(whole)
    grid = geometry.at(at.reshape(30, 100, 4), M=np.linspace(0.5, 1, 30)[:, np.newaxis])
    assert grid.curvature.shape == (30, 100, 4, 4, 4, 4)
    np.testing.assert_array_equal(grid.curvature[29], whole.curvature.reshape(30, 100, 4, 4, 4, 4)[29])
    np.testing.assert_array_equal(geometry.at({"r": at[:, 1], theta: at[:, 2]}, M=1).affinities, whole.affinities)
    np.testing.assert_array_equal(geometry.at(at[7], M=1).affinities, whole.affinities[7])
    assert geometry.at(np.zeros((0, 4)), M=1).ricci.shape == (0, 4, 4)
    before = whole.metric
    at *= np.nan
    np.testing.assert_array_equal(whole.metric, before)
    try:
        af.set_threads(1)
        np.testing.assert_array_equal(whole.metric, before)
    finally:
        af.set_threads(0)


def test_functions_without_values():
    scale = sp.Function("a")
    universe = af.Geometry.on_chart([t, x], sp.diag(-1, scale(t) ** 2))
    times = np.linspace(1, 2, 7)
    # a = t^3
    named = universe.at({"a(t)": times**3, "a_t(t)": 3 * times**2, "a_t_t(t)": 6 * times})
    by_symbol = universe.at({scale(t): times**3, scale(t).diff(t): 3 * times**2, scale(t).diff(t, 2): 6 * times})
    given = af.Geometry.on_chart([t, x], sp.diag(-1, t**6)).at({t: times})
    for key in ("affinities", "curvature", "scalar_curvature"):
        close(named.quantity(key), given.quantity(key), 1e-13)
        np.testing.assert_array_equal(by_symbol.quantity(key), named.quantity(key))
    with pytest.raises(ValueError, match=r"scalar_curvature depends on a_t_t\(t\), which has no value"):
        universe.at({"a(t)": 1, "a_t(t)": 1}).scalar_curvature  # noqa: B018


def test_removable_singularities_have_values():
    sphere = af.Geometry.on_chart([theta, phi], sp.diag(1, sp.sin(theta) ** 2))
    assert sphere.at({theta: 0}).scalar_curvature == 2
    with pytest.raises(af.MathematicsError, match="affinities is not defined at the point theta = 0: division by zero"):
        sphere.at({theta: 0}).affinities  # noqa: B018


def schwarzschild(*arguments, **values):
    return af.Geometry.on_chart([t, r, theta, phi], SCHWARZSCHILD).at(*arguments, **values)


LOGARITHM = af.Geometry.on_chart("x y", ["log(x)", "sqrt(y)"], positive=["x", "y"])

WRONG = [
    (lambda: schwarzschild({r: [3, 2, 1], theta: 1}, M=1).affinities, af.MathematicsError, r"at the point \[1\], r = 2, theta = 1, M = 1: division by zero"),
    (lambda: schwarzschild({r: [[3, 3], [3, 2]], theta: 1, M: 1}).affinities, af.MathematicsError, r"at the point \[1, 1\], r = 2"),
    (lambda: LOGARITHM.at([[1, 1], [-2, 1]]).metric, af.MathematicsError, r"at the point \[1\], x = -2, y = 1: log\(-2\)"),
    (lambda: LOGARITHM.at([1, -3]).metric, af.MathematicsError, r"at the point x = 1, y = -3: sqrt\(-3\)"),
    (lambda: LOGARITHM.at({"x": 0, "y": 1}).metric, af.MathematicsError, r"log\(0\)"),
    (lambda: af.Geometry.on_chart("x", ["exp(x)"]).at([1000]).metric, af.MathematicsError, "beyond the range of floats"),
    (lambda: schwarzschild([[3, 3, 1, 1], [1, np.nan, 1, 1]], M=1), ValueError, r"r should be finite, not nan at the point \[1\]"),
    (lambda: schwarzschild({r: [[3, np.inf]]}, M=1), ValueError, r"r should be finite, not inf at the point \[0, 1\]"),
    (lambda: schwarzschild({r: 3}, M=np.nan), ValueError, "M should be finite, not nan"),
    (lambda: schwarzschild([[3, 3, 1, 1]]).metric, ValueError, "metric depends on M, which has no value"),
    (lambda: schwarzschild([3, 3, 1], M=1), ValueError, r"\(..., 4\) for t, r, theta, phi, not of the shape \(3,\)"),
    (lambda: schwarzschild(3, M=1), ValueError, r"\(..., 4\) for t, r, theta, phi, not of the shape \(\)"),
    (lambda: schwarzschild(np.ones((5, 4)), M=[1, 2, 3]), ValueError, r"broadcast together: points \(5,\), M \(3,\)"),
    (lambda: schwarzschild({r: 1}, r=2), ValueError, "r is given twice"),
    (lambda: schwarzschild([3, 3, 1, 1], r=2), ValueError, "r is given twice"),
    (lambda: schwarzschild({"q": 1}), af.InputError, "`q` is not a parameter here"),
    (lambda: schwarzschild({"2*r": 1}), af.InputError, "is not a coordinate, a parameter or a function"),
    (lambda: schwarzschild({r: 1j}), TypeError, "complex"),
    (lambda: schwarzschild("3 3 1 1"), TypeError, "real numbers"),
    (lambda: schwarzschild({r: "3"}), TypeError, "real numbers"),
    (lambda: schwarzschild({r: 3}).quantity("riemann"), ValueError, "curvature"),
    (lambda: schwarzschild({r: 3}).quantity("sectional_curvature"), ValueError, r"sectional_curvature\(x, y\)"),
    (lambda: af.Geometry.on_chart("x", ["m*x"]).subs({"m": 2}).at({"x": 1, "m": 3}), af.InputError, "m has the value 2 already"),
    (lambda: af.Geometry("so3", metric=[1, 2, 3]).at([1, 2, 3]), ValueError, "this geometry has no coordinates"),
    (lambda: af.Geometry("so3", metric=[1, 2, 3], scalar="float").at(), af.InputError, "exact"),
    (lambda: af.Geometry("so3").at().metric, af.MathematicsError, "metric is not defined"),
]  # fmt: skip


@pytest.mark.parametrize("at", range(len(WRONG)))
def test_wrong_arguments(at):
    call, error, words = WRONG[at]
    with pytest.raises(error, match=words):
        call()
