"""Thirty symbolic cases agree with SymPy's computation; expressions are converted in both directions."""

import itertools
import pickle

import numpy as np
import pytest
import sympy as sp

import affinor as af

a, b, c, d = sp.symbols("a b c d", positive=True)
half = sp.Rational(1, 2)


def same(found, expected):
    """Whether both arrays agree after simplification."""
    found, expected = sp.flatten(sp.Array(found)), sp.flatten(sp.Array(expected))
    assert len(found) == len(expected)
    for one, other in zip(found, expected, strict=True):
        rest = sp.cancel(one - other)
        assert rest == 0 or sp.simplify(rest) == 0 or sp.simplify(rest.rewrite(sp.exp)) == 0, (one, other)


def levi_civita(structure, g):
    """Affinities by Koszul's formula for a left-invariant metric: L[i][j][k] = Lambda^i_jk."""
    n, inverse = g.shape[0], g.inv()
    lower = [[[sum(g[i, m] * structure[m, j, k] for m in range(n)) for k in range(n)] for j in range(n)] for i in range(n)]
    koszul = [
        [[(lower[i][j][k] - lower[j][k][i] + lower[k][i][j]) / 2 for k in range(n)] for j in range(n)] for i in range(n)
    ]
    return [
        [[sp.cancel(sum(inverse[i, m] * koszul[m][j][k] for m in range(n))) for k in range(n)] for j in range(n)]
        for i in range(n)
    ]


def curvature(structure, lam):
    """R^i_jkl of constant affinities: R(e_k, e_l) e_j."""
    n = len(lam)
    span = range(n)

    def component(i, j, k, l):
        return sp.cancel(
            sum(
                lam[i][k][m] * lam[m][l][j] - lam[i][l][m] * lam[m][k][j] - structure[m, k, l] * lam[i][m][j]
                for m in span
            )
        )

    return [[[[component(i, j, k, l) for l in span] for k in span] for j in span] for i in span]


METRICS = {
    "diagonal": lambda n: sp.diag(*(a, b, c, d)[:n]),
    "with one off the diagonal": lambda n: sp.Matrix(n, n, lambda i, j: (a, b, c, d)[i] if i == j else half * int(i + j == 1)),
    "one parameter": lambda n: sp.diag(*([1] * (n - 1) + [a])),
}
ALGEBRAS = ["so3", "sl2", "heisenberg(3)", "aff1", "se2", "aff1+R^1", "bianchi(IV)", "bianchi(V)"]
CASES = list(itertools.product(ALGEBRAS, METRICS))


@pytest.mark.parametrize(("name", "metric"), CASES)
def test_left_invariant_metrics(name, metric):
    algebra = af.LieAlgebra(name)
    n = algebra.dimension
    g = METRICS[metric](n)
    geometry = af.Geometry(algebra, metric=g)
    structure = algebra.structure.to_sympy()
    lam = levi_civita(structure, g)
    r = curvature(structure, lam)
    ricci = sp.Matrix(n, n, lambda j, l: sum(r[i][j][i][l] for i in range(n)))
    same(geometry.affinities.to_sympy(), lam)
    same(geometry.curvature.to_sympy(), r)
    same(geometry.ricci.to_sympy(), ricci)
    assert sp.simplify(geometry.scalar_curvature - (g.inv() * ricci).trace()) == 0
    assert geometry.metric.to_sympy() == g


x, y, r, theta, phi, t = sp.symbols("x y r theta phi t", real=True)
scale, height = sp.Function("a"), sp.Function("f")
CHARTS = {
    "sphere": ([theta, phi], sp.diag(1, sp.sin(theta) ** 2)),
    "sphere of radius a": ([theta, phi], a**2 * sp.diag(1, sp.sin(theta) ** 2)),
    "half plane": ([x, y], sp.diag(1 / y**2, 1 / y**2)),
    "horocycles": ([x, t], sp.diag(sp.exp(2 * t), 1)),
    "polar": ([r, phi], sp.diag(1, r**2)),
    "space in spherical coordinates": ([r, theta, phi], sp.diag(1, r**2, r**2 * sp.sin(theta) ** 2)),
    "expanding plane": ([t, x, y], sp.diag(-1, scale(t) ** 2, scale(t) ** 2)),
    "any surface": ([x, y], sp.Matrix([[height(x, y), x], [x, sp.Derivative(height(x, y), x)]])),
    "product": ([theta, phi, x], sp.diag(1, sp.cos(theta) ** 2, b)),
}


@pytest.mark.parametrize("name", CHARTS)
def test_charts(name):
    coordinates, g = CHARTS[name]
    geometry = af.Geometry.on_chart(coordinates, metric=g)
    n, inverse = len(coordinates), g.inv()

    def christoffel(i, j, k):
        terms = (
            inverse[i, m] * (g[m, j].diff(coordinates[k]) + g[m, k].diff(coordinates[j]) - g[j, k].diff(coordinates[m]))
            for m in range(n)
        )
        return sp.simplify(sum(terms) / 2)

    span = range(n)
    gamma = [[[christoffel(i, j, k) for k in span] for j in span] for i in span]

    def component(i, j, k, l):
        first = gamma[i][l][j].diff(coordinates[k]) - gamma[i][k][j].diff(coordinates[l])
        return first + sum(gamma[i][k][m] * gamma[m][l][j] - gamma[i][l][m] * gamma[m][k][j] for m in span)

    same(geometry.affinities.to_sympy(), gamma)
    same(geometry.curvature.to_sympy(), [[[[component(i, j, k, l) for l in span] for k in span] for j in span] for i in span])
    assert geometry.frame == "coordinate"


def test_there_are_thirty_cases():
    assert len(CASES) + len(CHARTS) >= 30


def test_free_functions():
    a = scale(t)
    universe = af.Geometry.on_chart("t x y z", metric="diag(-1, a(t)^2, a(t)^2, a(t)^2)", functions=["a(t)"])
    time = sp.Symbol("t")
    expected = 6 * (sp.diff(scale(time), time, 2) / scale(time) + sp.diff(scale(time), time) ** 2 / scale(time) ** 2)
    assert sp.simplify(universe.scalar_curvature - expected) == 0
    assert universe.subs({"a(t)": "exp(2*t)"}).scalar_curvature == 48
    with pytest.raises(ValueError, match="assumptions"):
        af.Geometry.on_chart([t, x], metric=sp.diag(1, sp.Function("b", positive=True)(t)))
    with pytest.raises(af.AffinorError, match="`b` is not a function"):
        af.Geometry.on_chart("t x", metric="diag(1, b(t))")
    roots = af.Geometry.on_chart("t x", metric="diag(1/a(t), a(t))", functions=[a.subs(t, time)], positive=["a(t)"])
    assert roots.scalar_curvature == -sp.diff(scale(time), time, 2)


def test_fields_on_a_chart():
    moving = af.Geometry.on_chart(
        [theta, phi], fields={"u": [1, 0], "v": [0, 1 / sp.sin(theta)]}, metric="identity"
    )
    assert moving.frame == "moving" and moving.scalar_curvature == 2
    assert sp.simplify(moving.structure.to_sympy()[1, 0, 1] + sp.cot(theta)) == 0


def test_assumptions_are_kept():
    real = sp.Symbol("k", negative=True)
    geometry = af.Geometry("so3", metric=[real, 1, 1])
    assert geometry.ricci[0, 0].free_symbols == {real}
    assert geometry.ricci.to_numpy()[0, 0] == geometry.ricci[0, 0]
    assert pickle.loads(pickle.dumps(geometry)).ricci[0, 0].free_symbols == {real}
    assert geometry.subs({real: -2}).ricci[0, 0] == geometry.ricci[0, 0].subs(real, -2)
    with pytest.raises(ValueError, match="two different symbols"):
        geometry.ricci + af.Tensor([[sp.Symbol("k"), 0, 0]] + [[0] * 3] * 2, "__")


@pytest.mark.parametrize(
    "value",
    [sp.Rational(-7, 3), a, a**-2, (a + b) ** 3 / (c - d), sp.sqrt(4), sp.sqrt(sp.Rational(9, 4)), -a * b + 1, a * (b + c) ** -1, sp.sqrt(2), a / sp.sqrt(6), sp.pi / 4, sp.pi**2 * a],
)
def test_expressions_come_back(value):
    tensor = af.Tensor({(0,): value}, "^", dimension=2)
    assert sp.simplify(tensor[0] - value) == 0
    assert sp.simplify((tensor * value)[0] - value**2) == 0
    assert sp.simplify((tensor / value)[0] - 1) == 0


@pytest.mark.parametrize("value", [sp.sqrt(a), sp.Float(0.1), sp.I, sp.zoo, sp.Symbol("x'"), sp.gamma(a), sp.Symbol("pi")])
def test_what_has_no_exact_value_is_refused(value):
    with pytest.raises((TypeError, ValueError)):
        af.LieAlgebra.from_structure([(0, 0, 1, value)], dimension=2)


@pytest.mark.parametrize("value", [1 / sp.sec(a), sp.csc(a), sp.coth(a), sp.sech(a), sp.csch(a), sp.Function("f")(a, b).diff(a, b)])
def test_functions_come_back(value):
    found = af.Tensor([value, 0], "^")[0]
    assert sp.simplify((found - value).rewrite(sp.exp)) == 0


@pytest.mark.parametrize(
    "value",
    [
        *(sp.Abs(sp.Symbol("x")), sp.atan2(a, b), sp.gamma(a), sp.re(sp.Symbol("x")), sp.Max(a, b), sp.asin(a)),
        *(sp.Function("f_a")(a), sp.Function("sin")(a), sp.Function("f", positive=True)(a)),
        *(sp.Derivative(sp.Abs(a, evaluate=False), a, evaluate=False), sp.Derivative(sp.sin(a), a)),
    ],
)
def test_functions_that_would_be_others_are_refused(value):
    with pytest.raises((TypeError, ValueError), match="neither a rational function|another name|assumptions"):
        af.Tensor([value, 0], "^")


def test_the_imaginary_unit_is_no_symbol():
    i = sp.Symbol("i")

    def basis(value):
        return [[[0, value], [0, 0]], [[0, 0], [value, 0]], [[1, 0], [0, -1]]]

    assert af.LieAlgebra.from_matrices(basis(sp.I)).structure == af.LieAlgebra({"matrices": basis(1j)}).structure
    for make in (af.LieAlgebra.from_matrices, lambda rows: af.LieAlgebra({"matrices": rows})):
        with pytest.raises(ValueError, match="imaginary unit"):
            make(basis(i))
    keys = {"space": "so3", "metric": "identity", "initial": {"velocity": [0, 0, 0]}, "parameters": {"i": 5}}
    assert af.simulate(keys, forces={"body": [i, 0, 0]}, output={"end": 1})["Omega1"][-1] == pytest.approx(5)
    for value in (sp.I, 1j):
        with pytest.raises(TypeError, match="neither a rational function|real number"):
            af.simulate(keys, forces={"body": [value, 0, 0]}, output={"end": 1})


def test_checks_are_those_of_the_connection_given():
    c, s = af.LieAlgebra("so3").structure, sp.Symbol("s")
    lines = [f"nabla[e{j + 1}, e{k + 1}] = s*({value})*e{i + 1}" for (i, j, k), value in c.items()]
    written = af.Geometry(
        {
            "basis": ["e1", "e2", "e3"],
            "brackets": "[e1,e2]=e3; [e2,e3]=e1; [e3,e1]=e2",
            "parameters": ["s", "a"],
            "metric": "diag(a,1,1)",
            "affinities": lines,
        }
    )
    given = af.Geometry("so3", metric="diag(a,1,1)", affinities=c * s)
    assert given == written and [*map(repr, given.check())] == [*map(repr, written.check())]
    assert "metric_compatible" not in [check.name for check in given.check()]
    for other in (af.Geometry("so3", metric=[1.5, 1, 1], torsion=c, scalar="float"), af.Geometry("so3", affinities=c * 0)):
        assert all(other.check())
    whole = af.LieAlgebra("so3+so3")
    assert all(af.Geometry(whole, affinities=whole.structure / 3).check())
    plane = {"chart": {"coordinates": ["x", "y"]}, "metric": "identity"}
    with pytest.raises(af.MathematicsError, match="chart"):
        af.Geometry(plane, affinities=af.Tensor({(0, 1, 1): 1}, "^__", dimension=2)).check()


def test_values_of_parameters_of_the_metric_alone():
    a, b = sp.symbols("a b")
    geometry = af.Geometry("so3", metric=[a, b, 1]).subs({a: 2}).subs({b: "3"})
    plain = af.Geometry("so3", metric=[2, 3, 1])
    assert geometry.algebra == plain.algebra and geometry.group() == af.Group("so3")
    np.testing.assert_array_equal(geometry.transport([1, 2, 3]), plain.transport([1, 2, 3]))
    tangents = geometry.geodesic([1, 2, 3], [0.5]).tangents
    np.testing.assert_array_equal(tangents, plain.geodesic([1, 2, 3], [0.5]).tangents)
    brackets = {"basis": ["x", "y", "z"], "parameters": ["s"], "brackets": "[x,y]=s*z"}
    several = af.Geometry(brackets, metric=[a, b, 1]).subs({a: 2, "s": 5, b: 3})
    assert several.algebra.structure[2, 0, 1] == 5
    np.testing.assert_array_equal(several.group().bracket([1, 0, 0], [0, 1, 0]), [0, 0, 5])


def test_values_of_parameters_of_tensors_alone():
    a, s, c = *sp.symbols("a s"), af.LieAlgebra("so3").structure
    given = af.Geometry("so3", metric=[a, 1, 1], affinities=c * s)
    np.testing.assert_array_equal(given.subs({s: 3}).affinities.to_numpy(), 3 * c.to_numpy())
    assert given.subs({s: 3}).subs({a: 2}) == given.subs({a: 2, s: 3}) == af.Geometry("so3", metric=[2, 1, 1], affinities=c * 3)
    twice = af.Geometry("so3", metric=[1, 1, 1], torsion=c * s).subs({"s": 2})
    np.testing.assert_array_equal(twice.torsion.to_numpy(), 2 * c.to_numpy())
    with pytest.raises(af.InputError, match="not a parameter"):
        given.subs({"q": 1})


def test_values_in_values():
    a, b = sp.symbols("a b")
    geometry = af.Geometry("so3", metric=[a, b, 1])
    later = geometry.subs({a: b + 1}).subs({b: 2})
    assert [later.metric[i, i] for i in range(3)] == [3, 2, 1]
    assert geometry.subs({a: a + 1}).subs({a: 2}).metric[0, 0] == 3
    with pytest.raises(af.InputError):
        geometry.subs({a: 2}).subs({a: 3})


def test_values_for_names_that_a_value_brought_in():
    geometry = af.Geometry("so3", metric=sp.diag(a, b, 1))
    assert geometry.subs({a: c}).subs({c: 3}).metric[0, 0] == 3
    assert geometry.subs({a: c + d}).subs({c: 3}).subs({d: 1}).metric[0, 0] == 4
    assert geometry.subs({a: c}).subs({c: a}).subs({a: 5}).metric[0, 0] == 5
    assert geometry.subs({a: b}).subs({b: 3}).metric.to_sympy().diagonal() == sp.Matrix([[3, 3, 1]])
    algebra = af.LieAlgebra.from_structure({(2, 0, 1): a}, dimension=3)
    assert algebra.subs({a: c}).subs({c: 3}).structure[2, 0, 1] == 3
    assert algebra.subs({}) == algebra and geometry.subs({}) == geometry
    with pytest.raises(af.InputError, match="not a parameter here"):
        geometry.subs({a: 3}).subs({c: 3})


def test_irrational_complex_numbers_in_floats():
    """Matrices with irrational complex entries give the brackets of the same matrices of NumPy, to rounding."""
    third, quarter = 1 / sp.sqrt(3), sp.exp(sp.I * sp.pi / 4)
    pauli = [[[0, 1], [1, 0]], [[0, -sp.I], [sp.I, 0]], [[1, 0], [0, -1]]]
    for factors in ([sp.I * third] * 3, [sp.I * sp.pi, 2 * sp.I, sp.I / 3], [sp.I * sp.sqrt(2) / 2, -sp.I * sp.E, sp.I]):
        exact = [(factor * sp.Matrix(matrix)).tolist() for factor, matrix in zip(factors, pauli, strict=True)]
        numeric = [np.array(sp.Matrix(matrix).evalf(30), dtype=complex) for matrix in exact]
        found = af.LieAlgebra.from_matrices(exact, scalar="float").structure.to_numpy()
        expected = af.LieAlgebra.from_matrices(numeric, scalar="float").structure.to_numpy()
        assert np.abs(found).max() > 0.1
        np.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-13)
    # a sum of both parts, and a matrix of SymPy
    turned = [sp.Matrix([[0, quarter], [-sp.conjugate(quarter), 0]]), sp.Matrix([[0, sp.I * quarter], [sp.I * sp.conjugate(quarter), 0]])]
    turned.append(turned[0] * turned[1] - turned[1] * turned[0])
    numeric = [np.array(matrix.evalf(30), dtype=complex) for matrix in turned]
    found = af.LieAlgebra.from_matrices(turned, scalar="float").structure.to_numpy()
    np.testing.assert_allclose(found, af.LieAlgebra.from_matrices(numeric, scalar="float").structure.to_numpy(), atol=1e-13)
