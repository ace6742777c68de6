"""Structure theory and constructions: the documents of the command line, known algebras, and errors with witnesses."""

import json
import pickle

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from test_command_line import needs_command, run

import affinor as af

a, h = sp.symbols("a h", positive=True)
so3 = af.LieAlgebra("so3")
R2 = af.LieAlgebra("R^2")
NAMES = [example for _, _, example in af.catalogue() if "@" not in example]


def algebras(largest):
    for name in NAMES:
        try:
            algebra = af.LieAlgebra(name)
        except af.AffinorError:
            continue
        if algebra.dimension <= largest:
            yield name, algebra


def commutators(algebra, vectors):
    """The brackets of vectors with the basis, by NumPy."""
    c = algebra.structure.to_numpy(float)
    return np.einsum("ijk,aj->aik", c, np.asarray(vectors, dtype=float).reshape(-1, algebra.dimension))


@needs_command
@pytest.mark.parametrize("name, algebra", list(algebras(8)), ids=lambda value: value if isinstance(value, str) else "")
def test_the_document_of_the_command_line(name, algebra):
    stored = json.loads(run("info", name, "--format", "json").stdout)
    assert algebra.info() == stored
    assert str(algebra.info()) == run("info", name).stdout
    for key in ("abelian", "nilpotent", "solvable", "unimodular", "perfect", "reductive", "semisimple", "simple", "complete"):
        assert getattr(algebra, f"is_{key}") is stored[key]
    for key in ("derived_series", "lower_central_series", "upper_central_series", "betti", "rank", "index", "dynkin_type"):
        assert getattr(algebra, key) == stored[key]
    for key, ours in (("centre", "centre"), ("radical", "radical"), ("nilradical", "nilradical"), ("levi", "levi_subalgebra")):
        basis = getattr(algebra, ours)
        assert basis.shape == (stored[key]["dimension"], algebra.dimension)
        if not algebra.parameters:
            assert [[str(entry) for entry in row] for row in basis] == stored[key]["basis"]
    if not algebra.parameters:
        assert not commutators(algebra, algebra.centre).any()
        rank = np.linalg.matrix_rank(algebra.killing_form.to_numpy(float))
        assert bool(rank == algebra.dimension) is algebra.is_semisimple


@needs_command
@pytest.mark.parametrize(
    "name, metric", [("so3", "identity"), ("heisenberg(3)", "identity"), ("so3", "diag(a,b,c)"), ("so3", None), ("sl2", "killing")]
)
def test_properties(name, metric):
    options = [] if metric is None else ["--metric", metric]
    geometry = af.Geometry(name, metric=metric)
    assert geometry.properties() == json.loads(run("properties", name, *options, "--format", "json").stdout)
    assert str(geometry.properties()) == run("properties", name, *options).stdout
    assert "| property" in geometry.properties()._repr_markdown_()


def test_properties_of_given_affinities():
    found = af.Geometry("so3", affinities=so3.structure).properties()
    holds = {entry["name"]: entry.get("holds") for entry in found["properties"]}
    assert found["connection"] == "affinities" and holds["flat"] and not holds["torsion-free"]


@needs_command
@pytest.mark.parametrize("program", ["gap", "sage", "maple", "sympy"])
@pytest.mark.parametrize("name", ["so3", "heisenberg(5)", "bianchi(VI,h=h)"])
def test_export(program, name):
    text = af.LieAlgebra(name).export(program)
    assert text == run("table", name, "--show", "structure", "--format", program).stdout


def test_gap_reads_back(tmp_path):
    path = tmp_path / "table.g"
    path.write_text(so3.export("gap"))
    assert af.LieAlgebra(path).structure == so3.structure


# -- constructions: the same as definition files, and known algebras -----------------------------------------------------------

# one and u with u u = one
SPLIT = [[[1, 0], [0, 1]], [[0, 1], [1, 0]]]
SPLIT_TEXT = "product[one, one] = one; product[one, u] = u; product[u, u] = one"

SAME = [
    (so3.semidirect("adjoint"), {"semidirect": {"of": "so3", "by": "adjoint"}}),
    (so3.semidirect("coadjoint"), {"semidirect": {"of": "so3", "by": "coadjoint"}}),
    (
        af.LieAlgebra("R^1").semidirect("R^2", [[[1, 0], [0, "-1/2"]]], basis="x y z"),
        {"basis": ["x", "y", "z"], "semidirect": {"of": "R^1", "on": "R^2", "by": [[[1, 0], [0, "-1/2"]]]}},
    ),
    (
        af.LieAlgebra("sl(4)").generated(["E12", "E23"]),
        {"subalgebra": {"of": "sl(4)", "generated_by": ["E12", "E23"]}},
    ),
    (
        af.LieAlgebra("sl(3)").subalgebra(["E12 + E21", "E12 - E21", "2*H1"], basis="x y z"),
        {"basis": ["x", "y", "z"], "subalgebra": {"of": "sl(3)", "spanned_by": ["E12 + E21", "E12 - E21", "2*H1"]}},
    ),
    (af.LieAlgebra("sl(3)").centralizer(["H1"]), {"subalgebra": {"of": "sl(3)", "centralizer_of": ["H1"]}}),
    (af.LieAlgebra("heisenberg(5)").quotient(["z"]), {"quotient": {"of": "heisenberg(5)", "by": ["z"]}}),
    (
        R2.central_extension("[e1, e2] = z"),
        {"central_extension": {"of": "R^2", "centre": ["z"], "cocycle": "[e1, e2] = z"}},
    ),
    (so3.contraction([1, 1, 0]), {"contraction": {"of": "so(3)", "weights": [1, 1, 0]}}),
    (so3.truncated(3), {"truncated": {"of": "so(3)", "order": 3}}),
    (so3.tangent_algebra(), {"truncated": {"of": "so(3)", "order": 2}}),
    (
        so3.tensor_product("one u", SPLIT),
        {"tensor_product": {"of": "so(3)", "basis": ["one", "u"], "products": SPLIT_TEXT}},
    ),
    (so3.complexification(), {"complexification": "so(3)"}),
    (so3 + R2, {"sum": ["so(3)", "R^2"]}),
]


@pytest.mark.parametrize("ours, keys", SAME, ids=lambda value: next(iter(value)) if isinstance(value, dict) else "")
def test_definition_files_build_the_same(ours, keys):
    theirs = af.LieAlgebra(keys)
    assert ours.structure == theirs.structure
    if "sum" not in keys:
        assert ours.basis == theirs.basis


def test_known_algebras():
    assert so3.contraction([1, 1, 0]).identification == af.LieAlgebra("se2").identification
    assert so3.tangent_algebra().identification == so3.cotangent_algebra().identification
    assert so3.tangent_algebra().killing_signature == af.LieAlgebra("se3").killing_signature == (0, 3, 3)
    assert so3.tensor_product("one u", SPLIT).identification == (so3 + so3).identification
    assert so3.complexification().dynkin_type == "A1 + A1" and so3.complexification().killing_signature == (3, 3, 0)
    assert R2.central_extension([[0, 1], [-1, 0]]).identification == af.LieAlgebra("heisenberg(3)").identification
    assert af.LieAlgebra("se3").derived_subalgebra().dimension == 6 and af.LieAlgebra("aff1").derived_subalgebra().is_abelian
    assert af.LieAlgebra("gl(3)").centralizer(np.eye(9, dtype=int)[:0]).dimension == 9
    assert af.LieAlgebra("E6").dynkin_type == "E6" and af.LieAlgebra("E6").is_simple
    # extensions of an extension: any algebra is the beginning of a construction
    tower = R2.central_extension("[e1,e2]=e3", "e3").central_extension("[e1,e3]=e4", "e4")
    assert tower.nilpotency_class == 3 and tower.identification == af.LieAlgebra("filiform(4)").identification


def test_cocycles_are_arrays_dicts_texts_and_tensors_of_components():
    n4 = af.LieAlgebra("R^4")
    omega = np.zeros((2, 4, 4), dtype=int)
    omega[0, 0, 1], omega[1, 2, 3] = 1, 2
    first = n4.central_extension(omega, "u v")
    assert first.structure == n4.central_extension(omega - omega.transpose(0, 2, 1), ["u", "v"]).structure
    assert first.structure == n4.central_extension({(0, 0, 1): 1, (1, 2, 3): 2}, "u v").structure
    assert first.structure == n4.central_extension("[e1,e2]=u; [e3,e4]=2*v", "u v").structure
    assert first.basis == ["e1", "e2", "e3", "e4", "u", "v"]


def test_parameters_stay_the_symbols_of_sympy():
    family = af.LieAlgebra("R^1").semidirect("R^2", [sp.diag(1, a)], basis="x y z")
    assert family.structure[2, 0, 2] == a and family.symbols == {"a": a}
    assert family.subs({a: -1}).is_unimodular and not family.is_unimodular
    assert family.info()["exceptional_values"] == ["-1", "0", "1"]
    assert so3.subalgebra([[0, 0, h]]).dimension == 1
    mixed = R2.subalgebra([[1, a], [0, 1]])
    assert mixed.is_abelian
    killing = sp.Matrix(family.killing_form.to_sympy())
    assert sp.simplify(killing - sp.Matrix(3, 3, lambda i, j: (1 + a**2) if i == j == 0 else 0)) == sp.zeros(3)


def test_vectors_are_texts_and_components():
    assert so3.bracket("e1", "e2 - 2*e3") == so3.bracket([1, 0, 0], [0, 1, -2])
    assert so3.ad("e1 / 2")[2, 1] == sp.Rational(1, 2)


@given(st.lists(st.integers(-3, 3), min_size=9, max_size=9).filter(lambda m: np.linalg.matrix_rank(np.reshape(m, (3, 3))) == 3))
def test_structure_does_not_depend_on_the_basis(entries):
    moved = af.LieAlgebra("bianchi(V)").change_basis(np.reshape(entries, (3, 3)))
    keys = ("derived_series", "lower_central_series", "betti", "index", "rank", "killing_signature", "nilpotency_class")
    assert [getattr(moved, key) for key in keys] == [getattr(af.LieAlgebra("bianchi(V)"), key) for key in keys]


def test_a_report_is_a_dict_of_its_own():
    report = so3.info()
    report.clear()
    assert so3.info()["schema"] == "affinor.info/1" and so3.is_simple
    copy = pickle.loads(pickle.dumps(so3.info()))
    assert copy == so3.info() and str(copy) == str(so3.info())


# -- errors --------------------------------------------------------------------------------------------------------------------

heisenberg = af.LieAlgebra("heisenberg(5)")
filiform = af.LieAlgebra("filiform(4)")
floats = af.LieAlgebra("so3", scalar="float")

REFUSED = [
    (lambda: heisenberg.quotient(["x1"]), {"pair": ("y1", "x1"), "residual": "-z"}, "not an ideal"),
    (lambda: so3.subalgebra(["e1", "e2"]), {"pair": ("e1", "e2"), "residual": "e3"}, "not a subalgebra"),
    (lambda: so3.contraction([0, 0, 1]), {"pair": ("e1", "e2"), "component": "e3", "residual": "1"}, "no limit"),
    (
        lambda: af.LieAlgebra("R^1").semidirect("so3", [np.eye(3)]),
        {"derivation": "e1", "pair": ("e1", "e2"), "residual": "-e3"},
        "not a derivation",
    ),
    (
        lambda: R2.semidirect("R^2", [[[0, 1], [0, 0]], [[0, 0], [1, 0]]]),
        {"pair": ("e1", "e2"), "vector": "e1", "residual": "e1"},
        "not an action",
    ),
]


@pytest.mark.parametrize("call, data, message", REFUSED, ids=[message for _, _, message in REFUSED])
def test_a_refusal_has_its_witness(call, data, message):
    with pytest.raises(af.ConstructionError, match=message) as found:
        call()
    assert found.value.data == data and found.value.residual == data["residual"] and found.value.pair == data["pair"]
    assert pickle.loads(pickle.dumps(found.value)).data == data


def test_a_form_that_is_no_cocycle():
    sl2 = af.LieAlgebra("so3") + af.LieAlgebra("R^1")
    with pytest.raises(af.ConstructionError, match="not a cocycle") as found:
        sl2.central_extension({(0, 3): 1}, "z")
    assert len(found.value.triple) == 3 and found.value.residual not in ("0", None)
    assert found.value.pair is None


WRONG = [
    (lambda: floats.info(), af.InputError, "floats"),
    (lambda: floats.is_simple, af.InputError, "scalar='float'"),
    (lambda: floats.contraction([1, 1, 0]), af.InputError, "floats"),
    (lambda: af.Geometry("so3", scalar="float").properties(), af.InputError, "floats"),
    (lambda: so3.semidirect(floats, [np.eye(3)] * 3), af.InputError, "floats"),
    (lambda: so3.semidirect("R^2"), TypeError, "adjoint"),
    (lambda: so3.semidirect("R^2", [np.eye(2, dtype=int)]), af.ShapeError, "3 matrices of size 2 x 2"),
    (lambda: so3.semidirect("R^2", [[1, 2]] * 3), ValueError, "axes"),
    (lambda: so3.quotient(["e1", "e2", "e3"]), af.InputError, "zero"),
    (lambda: so3.quotient("e1"), TypeError, "list of vectors"),
    (lambda: so3.quotient([[1, 0]]), ValueError, "3 components"),
    (lambda: so3.subalgebra(["e9"]), ValueError, "neither"),
    (lambda: so3.subalgebra(["3"]), ValueError, "not a combination"),
    (lambda: so3.subalgebra(["sin(e1)"]), ValueError, "function"),
    (lambda: so3.subalgebra(["e1 +"]), ValueError, r"e1 \+"),
    (lambda: so3.subalgebra(["e1", "2*e1"]), af.InputError, "dependent"),
    (lambda: so3.subalgebra([]), af.InputError, "zero"),
    (lambda: so3.centralizer(["e1", "e2"]), af.InputError, "zero"),
    (lambda: af.LieAlgebra("R^2").derived_subalgebra(), af.InputError, "zero"),
    (lambda: so3.subalgebra(["e1"], basis="x y"), ValueError, "2 names"),
    (lambda: so3.contraction([1, 1]), af.ShapeError, "weights"),
    (lambda: so3.contraction([0.5, 1, 1]), TypeError, "float"),
    (lambda: so3.tensor_product("u u", SPLIT), ValueError, "differ"),
    (lambda: so3.tensor_product("one", SPLIT), ValueError, "1|axes|dimension"),
    (lambda: so3.tensor_product("u v", {(0, 0, 1): 1}), af.ConstructionError, "do not commute: u v - v u = u"),
    (lambda: so3.tensor_product("u v", {(1, 0, 0): 1, (0, 1, 1): 1}), af.ConstructionError, r"\(u u\) v - u \(u v\) = u"),
    (lambda: so3.truncated(0), af.InputError, "from 1 to 64"),
    (lambda: so3.truncated(65), af.InputError, "from 1 to 64"),
    (lambda: so3.truncated(-1), OverflowError, "negative|convert"),
    (lambda: R2.central_extension("[e1,e2]=z", ""), ValueError, "needs names"),
    (lambda: R2.central_extension("[e1,e2]=e1", "e1"), ValueError, "needs names"),
    (lambda: R2.central_extension("[e1,e2]=e1"), af.InputError, "into the centre"),
    (lambda: R2.central_extension([[0, 1, 0]]), ValueError, r"\(1, 2, 2\) or \(2, 2\)"),
    (lambda: R2.central_extension([[0, 1], [1, 0]]), af.AntisymmetryError, "antisymmetric"),
    (lambda: R2.central_extension({(0, 2): 1}), IndexError, "j, k < 2"),
    (lambda: so3.export("mathematica"), ValueError, "gap, sage, maple, sympy"),
]


@pytest.mark.parametrize("call, error, message", WRONG)
def test_wrong_arguments(call, error, message):
    with pytest.raises(error, match=message):
        call()
