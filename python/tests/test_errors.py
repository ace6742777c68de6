"""Wrong arguments: each error names the expected value. Python sees neither panics nor aborts."""

import pickle
import sys

import numpy as np
import pytest
import sympy as sp

import affinor as af
from affinor import SE3, SO3, _engine

so3 = af.LieAlgebra("so3")
t3 = af.Tensor(np.eye(3), "__")
TOP = {"space": "so3", "metric": "identity", "initial": {"velocity": [0, 0, 1]}, "output": {"end": 1, "every": 1}}

masked = np.ma.array(np.eye(3), mask=np.eye(3) == 0)
masked_constants = np.ma.array(np.zeros((3, 3, 3)), mask=np.ones((3, 3, 3)))
force = np.array([[0, 0, 0, 0], [1, 0, 0, 1]])

# an array has at most so many axes
MOST_AXES = 64 if np.lib.NumpyVersion(np.__version__) >= "2.0.0" else 32

WRONG = [
    (lambda: af.LieAlgebra(), TypeError, "space"),
    (lambda: af.LieAlgebra(3), TypeError, "structure constants or a LieAlgebra, not int"),
    (lambda: af.LieAlgebra(None), TypeError, "not NoneType"),
    (lambda: af.LieAlgebra("nothing(3)"), af.InputError, "no algebra named"),
    (lambda: af.LieAlgebra(""), af.InputError, "missing"),
    (lambda: af.LieAlgebra("missing.toml"), af.InputError, "cannot read"),
    (lambda: af.LieAlgebra("[x,y]=w", basis="x y"), af.InputError, "w"),
    (lambda: af.LieAlgebra("[x,y", basis="x y"), af.InputError, "bracket"),
    (lambda: af.LieAlgebra("[x,y]=x", basis="x x"), af.InputError, "twice"),
    (lambda: af.LieAlgebra({"bracket": ""}), af.InputError, "did you mean"),
    (lambda: af.LieAlgebra({}), af.InputError, "basis"),
    (lambda: af.LieAlgebra(np.zeros((2, 3, 3))), ValueError, r"\(2, 3, 3\)"),
    (lambda: af.LieAlgebra(np.zeros((3, 3))), ValueError, r"\(3, 3\)"),
    (lambda: af.LieAlgebra(np.full((2, 2, 2), np.nan)), ValueError, "nan"),
    (lambda: af.LieAlgebra(np.full((2, 2, 2), 0.5)), TypeError, "float"),
    (lambda: af.LieAlgebra(np.zeros((2, 2, 2), dtype=complex)), TypeError, "complex"),
    (lambda: af.LieAlgebra(np.array([["a"]])), ValueError, r"\(1, 1\)"),
    (lambda: af.LieAlgebra((np.zeros((2, 4)), np.zeros(4))), ValueError, r"\(3, count\)"),
    (lambda: af.LieAlgebra.from_structure([(0, 1, 5, 1)], dimension=3), IndexError, "0..2"),
    (lambda: af.LieAlgebra.from_structure([(0, 1, 2, 1)], basis="x y"), IndexError, "0..1"),
    (lambda: af.LieAlgebra.from_structure(t3), ValueError, r"\^__"),
    (lambda: af.LieAlgebra.from_matrices([[1, 2]]), TypeError, "matrix 0"),
    (lambda: af.LieAlgebra.from_matrices([[[1, 2], [3]]]), af.InputError, "not 2 x 2"),
    (lambda: af.LieAlgebra.from_matrices([]), af.InputError, "between 1"),
    (lambda: af.LieAlgebra("so3", scalar="double"), ValueError, "exact or float"),
    (lambda: af.LieAlgebra("so3", scalar="float", tolerance=2.0), ValueError, "tolerance"),
    (lambda: so3 + 1, TypeError, "unsupported"),
    (lambda: so3.direct_sum("R^3"), TypeError, "LieAlgebra"),
    (lambda: so3.change_basis(np.zeros((3, 3))), af.MathematicsError, "dependent"),
    (lambda: so3.change_basis(np.eye(2)), af.ShapeError, "dimension"),
    (lambda: so3.bracket([1, 2], [1, 2, 3]), ValueError, "3 components"),
    (lambda: so3.ad("x"), ValueError, "neither"),
    (lambda: af.Geometry("so3", connection="left"), af.InputError, "levi-civita"),
    (lambda: af.Geometry("so3", connection="levi-civita"), af.MetricError, "metric"),
    (lambda: af.Geometry("so3", metric="diag(1,2)"), af.InputError, "dimension is 3"),
    (lambda: af.Geometry("so3", metric=np.eye(2)), af.InputError, "dimension is 3"),
    (lambda: af.Geometry("so3", metric=3), TypeError, "metric"),
    (lambda: af.Geometry("so3", metric=[True, 1, 1]), TypeError, "bool"),
    (lambda: af.Geometry("so3", metric=[1j, 1, 1]), TypeError, "real"),
    (lambda: af.Geometry("so3", metric=[object(), 1, 1]), TypeError, "object"),
    (lambda: af.Geometry("so3", torsion=so3.structure), af.MetricError, "metric"),
    (lambda: af.Geometry("so3", affinities=np.zeros((3, 3))), ValueError, "axes"),
    (lambda: af.Geometry("so3", affinities=t3), ValueError, r"\^__"),
    (lambda: af.Geometry("so3", connection="plus", affinities=so3.structure), ValueError, "only one"),
    (lambda: af.Geometry("so3", frame="up"), ValueError, "left or right"),
    (lambda: af.Geometry("so3").ricci_, AttributeError, "ricci_"),
    (lambda: af.Geometry("so3").metric, af.MathematicsError, "not defined"),
    (lambda: af.Geometry("so3").quantity("riemann"), ValueError, "curvature"),
    (lambda: af.Geometry("so3").table(format="xml"), ValueError, "markdown"),
    (lambda: af.Geometry("so3").check_property("flat"), af.InputError, "flat"),
    (lambda: af.Geometry("so3", metric="diag(a,1,1)").transport([0, 0, 1]), af.InputError, "parameters"),
    (lambda: af.Geometry.on_chart("x y"), af.MetricError, "metric"),
    (lambda: af.Tensor([[1, 2], [3]], "__"), ValueError, "axes|inhomogeneous"),
    (lambda: af.Tensor([1, 2], "+"), ValueError, r"\^ and _"),
    (lambda: af.Tensor([1, 2], 1), TypeError, "slots"),
    (lambda: af.Tensor({(0,): 1}, "^"), TypeError, "dimension"),
    (lambda: af.Tensor({(4,): 1}, "^", dimension=2), IndexError, "0..2"),
    (lambda: af.Tensor(["a+"], "^"), ValueError, "a\\+"),
    (lambda: t3[0], IndexError, "2 indices"),
    (lambda: t3[0, 3], IndexError, r"-3\.\.2"),
    (lambda: t3[0, -4], IndexError, r"-4 is not in -3\.\.2"),
    (lambda: t3[..., 0, ...], IndexError, "once"),
    (lambda: t3[0, 1.0], TypeError, "float"),
    (lambda: t3[0, 0:1], IndexError, "slice"),
    (lambda: t3 + 1, TypeError, "unsupported"),
    (lambda: t3 + so3.structure, ValueError, "equal shapes"),
    (lambda: t3 * t3, TypeError, "contract"),
    (lambda: t3 * 0.1, TypeError, "Fraction"),
    (lambda: bool(t3), TypeError, "is_zero"),
    (lambda: t3 / 0, ValueError, "zero"),
    (lambda: af.contract("_ij _jk -> _ik", t3, t3), af.ShapeError, "j"),
    (lambda: af.contract("_ij", t3), af.ShapeError, "->"),
    (lambda: af.contract("_ij -> _ij", t3, t3), ValueError, "2 factors"),
    (lambda: af.contract("a_ij -> _ij", a=1), TypeError, "Tensor"),
    (lambda: t3.trace(0, 5), af.ShapeError, "rank 2"),
    (lambda: t3.permute(0, 0), af.ShapeError, "rank"),
    (lambda: af.Group("nothing"), af.InputError, "nothing"),
    (lambda: af.Group(3), TypeError, "text"),
    (lambda: SO3.exp([1, 2]), ValueError, r"\(\.\.\., 3\)"),
    (lambda: SO3.exp(1.0), ValueError, r"\(\.\.\., 3\)"),
    (lambda: SO3.exp("abc"), TypeError, "real numbers was expected, not of dtype"),
    (lambda: SO3.exp(None), TypeError, "real numbers was expected"),
    (lambda: SO3.log(np.zeros((2, 3))), ValueError, r"\(\.\.\., 4\)"),
    (lambda: SO3.compose(np.ones((2, 4)), np.ones((3, 4))), ValueError, "broadcast"),
    (lambda: SO3.from_matrix(np.eye(4)), ValueError, r"3, 3"),
    (lambda: SO3.from_quaternion([0, 0, 0, 0]), ValueError, "zero"),
    (lambda: SE3.act(SE3.identity(), [1, 2]), ValueError, "points"),
    (lambda: SO3.mean(np.zeros((0, 4))), af.ShapeError, "at least one"),
    (lambda: af.Tensor(masked, "__"), ValueError, "masked"),
    (lambda: af.Tensor([*masked], "__"), ValueError, "masked"),
    (lambda: SO3.exp([*masked]), ValueError, "masked"),
    (lambda: af.Tensor({(0,): np.ma.masked}, "^", dimension=1), ValueError, "masked"),
    (lambda: af.Tensor.from_coo([[0, 1, 2]], masked[0], "^", 3), ValueError, "masked"),
    (lambda: af.LieAlgebra.from_structure(masked_constants), ValueError, "masked"),
    (lambda: af.LieAlgebra.from_structure(([[0], [1], [2]], np.ma.array([1], mask=[1]))), ValueError, "masked"),
    (lambda: af.LieAlgebra.from_matrices([masked]), TypeError, "NoneType"),
    (lambda: af.Geometry("so3", metric=masked), TypeError, "NoneType"),
    (lambda: af.simulate({**TOP, "forces": {"table": np.ma.array(force, mask=force == 1)}}), ValueError, "masked"),
    (lambda: af.simulate({**TOP, "forces": {"table": force + 1j}}), TypeError, "complex"),
    (lambda: af.simulate({**TOP, "forces": {"table": force.astype(str)}}), TypeError, "real numbers"),
    (lambda: af.Tensor.from_coo([[0]], [1 + 2j], "^", 1, scalar="float"), TypeError, "complex"),
    (lambda: af.Tensor.from_coo([[0]], np.array([1 + 2j]), "^", 1, scalar="float"), TypeError, "complex"),
    (lambda: af.Tensor({(0,): "1.5"}, "^", dimension=1, scalar="float"), TypeError, "real numbers"),
    (lambda: af.Tensor({(0,): True}, "^", dimension=1, scalar="float"), TypeError, "bool"),
    (lambda: af.Tensor({(0,): 1 + 1j}, "^", dimension=1, scalar="float"), TypeError, "complex"),
    (lambda: af.Geometry("so3").geodesic([0, 0, 1], ["1"]), TypeError, "real numbers"),
    (lambda: af.Geometry("so3").geodesic([0, 0, 1], [1j]), TypeError, "complex"),
    (lambda: af.Geometry("so3").geodesic(np.ones((2, 3)), 1), ValueError, r"tangent .* 1 axis, .* \(2, 3\)"),
    (lambda: af.Geometry("so3").geodesic([0, 0, 1], [[1], [2]]), ValueError, "times .* 0 or 1 axes"),
    (lambda: af.Geometry("so3").geodesic([0, 0, 1], 1, np.ones((2, 4))), ValueError, "start .* 1 axis"),
    (lambda: af.Geometry("so3").geodesic_between(np.ones((2, 4)), np.ones(4)), ValueError, "start .* 1 axis"),
    (lambda: af.Geometry("so3").geodesic_between(np.ones(4), np.ones((2, 4))), ValueError, "end .* 1 axis"),
    (lambda: af.Geometry("so3").transport(np.ones((2, 2, 3))), ValueError, "arcs .* 1 or 2 axes"),
    (lambda: af.Geometry("so3").transport_along(np.ones((2, 2, 4))), ValueError, "elements .* 2 axes"),
    (lambda: SO3.mean(np.ones((2, 3, 3))), ValueError, r"\(..., 4\), not .* \(2, 3, 3\)"),
    (lambda: SO3.mean(np.ones((2, 4)), axis=1), ValueError, "axis"),
    (lambda: SO3.mean(np.ones((2, 4)), weights=[1, -1]), ValueError, "not negative"),
    (lambda: SO3.mean(np.ones((2, 4)), weights=[0, 0]), ValueError, "positive sum"),
    (lambda: SO3.mean(np.ones((2, 4)), weights=[1, 1, 1]), ValueError, r"shape \(2,\) of the batch, not \(3,\)"),
    (lambda: SO3.mean([[0, 0, 0, 0], [1, 0, 0, 0]]), af.MathematicsError, "element 0"),
    (lambda: SO3.distance([1, 0, 0, 0], [1, 0, 0]), ValueError, r"\(..., 4\)"),
    (lambda: SO3.distance([1, 0, 0, 0], [0, 1, 0, 0], weights=[1, 1]), ValueError, r"\(3,\) or \(3, 3\), not \(2,\)"),
    (lambda: SO3.distance([1, 0, 0, 0], [0, 1, 0, 0], weights=[-1, 1, 1]), ValueError, "positive"),
    (lambda: SO3.spline([0, 0], np.ones((2, 4))), ValueError, "increasing"),
    (lambda: SO3.spline([0], np.ones((1, 4))), ValueError, "two or more"),
    (lambda: SO3.spline([0, np.nan], np.ones((2, 4))), ValueError, "finite"),
    (lambda: SO3.spline([0, 1], np.ones((3, 4))), ValueError, r"\(2, ..., 4\), not \(3, 4\)"),
    (lambda: SO3.spline([0, 1], np.ones((2, 4)), "linear"), ValueError, "cubic or geodesic"),
    (lambda: SO3.spline([0, 1], np.full((2, 4), 0.5), velocities=np.ones((2, 4))), ValueError, r"\(2, 3\), not \(2, 4\)"),
    (lambda: SO3.spline([0, 1], np.full((2, 4), 0.5), "geodesic", np.ones((2, 3))), ValueError, "leave velocities out"),
    (lambda: SO3.spline([0, 1], np.full((2, 4), 0.5))(1.5), ValueError, "1.5 is not between"),
    (lambda: SE3.from_scipy(3), TypeError, "RigidTransform"),
    (lambda: af.simulate(), af.InputError, "the space is missing"),
    (lambda: af.simulate(3), TypeError, "path"),
    (lambda: af.simulate("missing.toml"), af.InputError, "cannot read"),
    (lambda: af.simulate({**TOP, "sapce": "so3"}), af.InputError, "did you mean"),
    (lambda: af.simulate(TOP, method="euler"), af.InputError, "euler"),
    (lambda: af.simulate(TOP, end=float("nan")), ValueError, "nan"),
    (lambda: af.simulate(TOP, set={"m": 1}), af.InputError, "m"),
    (lambda: af.simulate({**TOP, "forces": {"potential": "R44"}}), af.InputError, "R44"),
    (lambda: af.simulate({**TOP, "forces": {"table": [1, 2]}}), ValueError, "rows"),
    (lambda: af.simulate({**TOP, "forces": {"potential": sp.gamma(sp.Symbol("t"))}}), af.InputError, "gamma"),
    (lambda: af.simulate(TOP, on_error="ignore"), ValueError, "'raise' or 'keep'"),
    (lambda: af.simulate("x.toml", space="so3"), TypeError, "keys"),
    (lambda: af.sweep(3, {"a": [1]}), TypeError, "task"),
    (lambda: af.sweep(len, [1, 2]), TypeError, "grid"),
    (lambda: af.sweep(len, {"a": [1]}, on="cloud"), ValueError, "dask"),
    (lambda: af.sweep(len, {"a": [1]}, chunk=0), ValueError, "chunk"),
    (lambda: af.RandomSample(3, a="cauchy(0, 1)"), ValueError, "uniform"),
    (lambda: SO3.exp(np.array([1j, 0, 0])), TypeError, "real numbers.*complex128"),
    (lambda: SO3.exp([1j, 0, 0]), TypeError, "real numbers.*complex128"),
    (lambda: SO3.exp(["1", "2", "3"]), TypeError, "real numbers"),
    (lambda: SO3.exp(np.array(["1", 0, 0], dtype=object)), TypeError, "'1' is not a number"),
    (lambda: SO3.exp([None, 0, 0]), TypeError, "real numbers.*NoneType"),
    (lambda: SO3.exp(np.zeros(3, dtype="datetime64[Y]")), TypeError, "datetime64"),
    (lambda: SO3.exp(np.zeros(3, dtype=[("a", "f8")])), TypeError, "real numbers"),
    (lambda: SO3.exp([10**400, 0, 0]), ValueError, "too large"),
    (lambda: SO3.exp([sp.Symbol("a"), 0, 0]), TypeError, "real numbers"),
    (lambda: SO3.exp([[1, 2, 3], [1, 2]]), ValueError, "real numbers.*inhomogeneous"),
    (lambda: SO3.exp(np.ma.masked_array([1.0, 2, 3], mask=[0, 1, 0])), ValueError, "masked"),
    (lambda: SO3.exp(np.broadcast_to(np.ones(3), (2**40, 2**10, 3))), MemoryError, "allocate"),
    (lambda: SO3.matrix(np.zeros((1,) * (MOST_AXES - 1) + (4,))), ValueError, "dimension"),
    (lambda: SO3.adjoint_matrix(1.0), ValueError, r"\(\.\.\., 4\)"),
    (lambda: SO3.to_quaternion([1, 2]), ValueError, r"\(\.\.\., 4\)"),
    (lambda: SO3.from_scipy(3), TypeError, "Rotation"),
    (lambda: SO3.random(2.5), ValueError, "shape"),
    (lambda: SO3.random("3"), ValueError, "shape"),
    (lambda: af.set_threads(-1), ValueError, "0 .all cores. to 1024, not -1"),
    (lambda: af.set_threads(10**6), ValueError, "1024"),
    (lambda: af.set_threads("2"), ValueError, "number"),
    (lambda: af.Tensor.from_coo([[0.7], [1.2]], [1], "__", 3), TypeError, "integers, not of dtype float64"),
    (lambda: af.Tensor.from_coo([[0], [1]], [1], "__", -3), ValueError, "dimension"),
    (lambda: af.Tensor.from_coo([[0], [1]], [1], "__", 3.0), TypeError, "dimension.*float"),
    (lambda: af.Tensor.from_coo([[0], [1]], None, "__", 3), ValueError, r"\(count,\)"),
    (lambda: af.Tensor({(0.5, 1): 1}, "__", dimension=2), TypeError, "integers"),
    (lambda: t3.trace(-1, 0), af.ShapeError, "slot -1"),
    (lambda: t3.trace("a", "b"), TypeError, "slot"),
    (lambda: np.array([1, 2]) * t3, TypeError, "number"),
    (lambda: af.contract(" ".join(["_ij"] * 30) + " -> _ij", *[t3] * 30), ValueError, "26 factors"),
    (lambda: af.LieAlgebra((np.array([[0.5], [1], [2]]), np.array([1]))), TypeError, "integers"),
    (lambda: af.LieAlgebra.from_structure([], dimension="3"), TypeError, "dimension"),
    (lambda: af.LieAlgebra.from_matrices(None), TypeError, "matrices"),
    (lambda: af.LieAlgebra("[x,y]=x", basis=3), TypeError, "basis"),
    (lambda: af.Geometry("so3").table(show=3), TypeError, "show"),
    (lambda: af.Geometry.on_chart(3, metric=1), TypeError, "coordinates"),
    (lambda: so3.bracket([0.5, 0, 0], [0, 1, 0]), TypeError, "Fraction.'0.5'"),
    (lambda: af.simulate(TOP, set=[1]), TypeError, "set"),
    (lambda: af.simulate({**TOP, "forces": {"body": lambda t, g, w: [0, 0]}}), ValueError, "3 components"),
    (lambda: af.simulate({**TOP, "forces": {"body": lambda t, g, w: None}}), TypeError, "real numbers"),
    (lambda: af.sweep(len, {"a": 3}), TypeError, "values of a"),
    (lambda: af.sweep(len, {"a": [1]}, chunk="x"), TypeError, "chunk"),
    (lambda: af.sweep(lambda row: {"y": "x" if row["a"] == 1 else 1}, {"a": [1, 2]}, chunk=1), TypeError, "'y'"),
    (lambda: af.RandomSample(1.5, a="uniform(0, 1)"), TypeError, "integer"),
    (lambda: af.RandomSample(2, a=3), TypeError, "law of a"),
]


@pytest.mark.parametrize("at", range(len(WRONG)))
def test_wrong_arguments(at):
    call, error, words = WRONG[at]
    with pytest.raises(error, match=words) as found:
        call()
    assert isinstance(found.value, Exception) and str(found.value)


def test_there_are_sixty():
    assert len(WRONG) >= 60


def test_a_row_says_that_its_task_returned_no_dict():
    assert "dict" in af.sweep(lambda row: None, {"a": [1]}).to_arrow()["error"][0].as_py()


def test_a_panic_is_an_exception():
    for _ in range(3):
        with pytest.raises(af.InternalError, match="a panic for the tests"):
            _engine._panic()
    assert af.threads() >= 1


def test_errors_have_a_place_and_survive_pickle():
    with pytest.raises(af.InputError) as found:
        af.LieAlgebra({"basis": ["x", "y"], "brackets": "[x, y] = 1/0 x"})
    error = pickle.loads(pickle.dumps(found.value))
    assert type(error) is type(found.value) and str(error) == str(found.value)
    assert error.place["text"] == "0" and error.place["line"] == 1 and "division by zero" in error.message
    with pytest.raises(af.JacobiError) as found:
        af.LieAlgebra("[x,y]=z; [y,z]=y", basis="x y z")
    assert pickle.loads(pickle.dumps(found.value)).triple == ("x", "y", "z")
    assert isinstance(found.value, ValueError)


def test_a_law_names_its_witness():
    with pytest.raises(af.MathematicsError, match="right-invariant frame") as found:
        af.Geometry("so3", metric="diag(1,2,3)", connection="levi-civita", frame="right")
    data = found.value.data
    assert set(data) == {"direction", "indices", "residual"} and len(data["indices"]) == 3
    direction, indices = data["direction"], "^{}_{}{}".format(*data["indices"])
    assert f"(L_{direction} Lambda){indices} = {data['residual']}," in found.value.message
    assert found.value.help == "write frame left, or choose a canonical connection"


def test_messages_are_in_the_words_of_python():
    with pytest.raises(af.InputError) as caught:
        af.Geometry("so3", metric="diag(1,2")
    assert caught.value.place["source"] == "metric" and "in the argument metric" in str(caught.value)
    with pytest.raises(af.AffinorError) as caught:
        af.LieAlgebra("so(q)")
    assert "--" not in str(caught.value) and "affinor list" not in str(caught.value)
    motion = {"space": "so3", "initial": {"velocity": [0, 0, 1]}, "output": {"end": 1}}
    body = {"moments": [1, 2, 3]}
    sum_of_two = {"space": "so3+so3", "metric": "identity", "initial": {"velocity": [0] * 6, "parts": [{}]}}
    for keys, words in [
        ({}, "also `inertia`"),
        ({"inertia": [body, body]}, "one dict in the list `inertia`"),
        ({"inertia": 3}, "expected a dict, or a list of dicts"),
        ({"inertia": body, "output": {"end": 1, "stop": "a"}}, "a dict `events`"),
        (sum_of_two, "one dict in the list `initial.parts`"),
    ]:
        with pytest.raises(af.AffinorError) as caught:
            af.simulate(**{**motion, **keys})
        assert words in str(caught.value) and "table" not in str(caught.value), str(caught.value)


@pytest.mark.parametrize(
    ("module", "extra", "call"),
    [
        ("pandas", "pandas", lambda: af.LieAlgebra("so3").structure.to_pandas()),
        ("sympy", "sympy", lambda: af.LieAlgebra("so3").structure.to_sympy()),
        ("pyarrow", "pandas", lambda: af.simulate(space="so3", metric=[1, 1, 1], initial={"velocity": [1, 0, 0]}, output={"end": 1}).to_arrow()),
    ],
)
def test_missing_packages_are_named_with_their_extra(monkeypatch, module, extra, call):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=rf"{module}.*affinor\[{extra}\]"):
        call()
