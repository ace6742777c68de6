"""Algebras and geometries: every kind of input gives the same values."""

import json
import pickle
import re
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

import affinor as af

ROOT = Path(__file__).resolve().parents[2]
DEFINITIONS = sorted((ROOT / "examples" / "definitions").glob("*.*"))


def epsilon(dtype=float):
    c = np.zeros((3, 3, 3), dtype=dtype)
    for i, j, k in [(0, 1, 2), (1, 2, 0), (2, 0, 1)]:
        c[i, j, k], c[i, k, j] = 1, -1
    return c


so3 = af.LieAlgebra("so3")
coords = np.array(np.nonzero(epsilon()))
SPIN = [[[0, 0, 0], [0, 0, -1], [0, 1, 0]], [[0, 0, 1], [0, 0, 0], [-1, 0, 0]], [[0, -1, 0], [1, 0, 0], [0, 0, 0]]]
i = sp.I / 2

WAYS = {
    "float array": lambda: af.LieAlgebra(epsilon()),
    "integer array": lambda: af.LieAlgebra(epsilon(int)),
    "object array": lambda: af.LieAlgebra(epsilon(int).astype(object) * sp.Integer(1)),
    "fortran order": lambda: af.LieAlgebra(np.asfortranarray(epsilon())),
    "nested lists": lambda: af.LieAlgebra(epsilon(int).tolist()),
    "COO pair": lambda: af.LieAlgebra((coords, epsilon()[tuple(coords)])),
    "tuples": lambda: af.LieAlgebra.from_structure([(0, 1, 2, 1), (1, 2, 0, "1"), (2, 0, 1, Fraction(1))]),
    "dict of entries": lambda: af.LieAlgebra.from_structure({(0, 1, 2): 1, (1, 2, 0): 1, (2, 0, 1): 1}),
    "SciPy matrix": lambda: af.LieAlgebra(scipy.sparse.csr_array(epsilon().reshape(3, 9))),
    "SciPy 3-d": lambda: af.LieAlgebra(scipy.sparse.coo_array((epsilon()[tuple(coords)], tuple(coords)), shape=(3, 3, 3))),
    "SymPy array": lambda: af.LieAlgebra(sp.Array(epsilon(int).tolist())),
    "Tensor": lambda: af.LieAlgebra(so3.structure),
    "brackets": lambda: af.LieAlgebra("[e1,e2]=e3; [e2,e3]=e1; [e3,e1]=e2", basis="e1 e2 e3"),
    "dict": lambda: af.LieAlgebra({"dimension": 3, "brackets": "[e1,e2]=e3\n[e2,e3]=e1\n[e3,e1]=e2"}),
    "path": lambda: af.LieAlgebra(ROOT / "examples" / "definitions" / "so3.toml"),
    "NumPy matrices": lambda: af.LieAlgebra.from_matrices(np.array(SPIN)),
    "lists of matrices": lambda: af.LieAlgebra.from_matrices(SPIN),
    "SymPy matrices": lambda: af.LieAlgebra.from_matrices([sp.Matrix(m) for m in SPIN]),
    "complex matrices": lambda: af.LieAlgebra.from_matrices(
        [-np.array(m) * 0.5j * 2 / 2 for m in ([[0, 1], [1, 0]], [[0, -1j], [1j, 0]], [[1, 0], [0, -1]])], scalar="float"
    ),
    "complex SymPy": lambda: af.LieAlgebra.from_matrices(
        [sp.Matrix([[0, -i], [-i, 0]]), sp.Matrix([[0, -sp.Rational(1, 2)], [sp.Rational(1, 2), 0]]), sp.Matrix([[-i, 0], [0, i]])]
    ),
    "change of basis": lambda: so3.change_basis([[0, 0, 1], [1, 0, 0], [0, 1, 0]]),
}


@pytest.mark.parametrize("way", WAYS)
def test_every_way_leads_to_so3(way):
    algebra = WAYS[way]()
    np.testing.assert_array_equal(algebra.structure.to_numpy(float), epsilon())
    assert algebra.dimension == 3
    if algebra.scalar == "exact" and algebra.basis == so3.basis:
        assert algebra == so3 and hash(algebra) == hash(so3)


@pytest.mark.parametrize("path", DEFINITIONS, ids=lambda path: path.name)
def test_definition_files_as_files_and_as_dicts(path):
    tomllib = pytest.importorskip("tomllib")
    text = path.read_text()
    keys = json.loads(text) if path.suffix == ".json" else tomllib.loads(text)
    if "chart" in keys and "metric" not in keys and "connection" not in keys and "affinities" not in keys:
        pytest.skip("a chart without a metric and a connection")
    from_file, from_dict = af.Geometry(path), af.Geometry(keys)
    assert from_file == from_dict
    assert from_file.basis == from_dict.basis and from_file.scalar == from_dict.scalar
    # curvature follows from these, and needs a minute for a rotating black hole
    given = [key for key in ("structure", "affinities", "metric") if from_file.quantity(key) is not None]
    assert from_file.table(given).splitlines()[1:] == from_dict.table(given).splitlines()[1:]


def test_a_file_is_read_once(tmp_path):
    part, whole = tmp_path / "part.toml", tmp_path / "whole.json"

    def write(value):
        part.write_text(f'basis = ["x", "y", "z"]\nbrackets = "[x,y]={value}*z"\n')
        whole.write_text(json.dumps({"sum": ["part.toml", "so3"]}))

    def constants(algebra):
        geometry = af.Geometry(algebra, metric="identity")
        copied = pickle.loads(pickle.dumps(algebra))
        of_group = algebra.group().bracket(*np.eye(algebra.dimension)[:2])[2]
        algebras = (algebra, geometry, geometry.algebra, geometry.subs({}), copied, pickle.loads(pickle.dumps(geometry)))
        return {of_group, *(one.structure[2, 0, 1] for one in algebras)}

    for path in (part, whole, f"{part}@plus"):
        write(1)
        before = af.LieAlgebra(path)
        group = before.group()
        write(5)
        assert constants(before) == {1} and constants(af.LieAlgebra(path)) == {5}
        assert group == before.group() and group != af.LieAlgebra(path).group()
        part.unlink()
        whole.unlink()
        assert constants(before) == {1}


def test_sparse_entries_with_equal_indices_are_added():
    places = ([2, 2, 2, 1], [1, 1, 3, 2])
    values = scipy.sparse.coo_array(([1, 2, -3, 0], places), shape=(3, 9))
    found = af.LieAlgebra.from_structure(values)
    np.testing.assert_array_equal(found.structure.to_numpy(), values.toarray().reshape(3, 3, 3))
    assert values.nnz == 4


@pytest.mark.parametrize("table", ["(0,0,12)", "[x,y]=z", "table.csv", "M3"])
def test_direct_sums_of_tables_and_of_the_paper(table, tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("j,k,i,value\n1,2,3,1\n", encoding="utf-8")
    first = af.LieAlgebra(path if table == "table.csv" else table)
    for both, at in [(first + so3, (0, 3)), (so3 + first, (3, 0))]:
        assert both.dimension == 6
        constants = both.structure.to_numpy(object)
        for part, start in [(first, at[0]), (so3, at[1])]:
            block = constants[start : start + 3, start : start + 3, start : start + 3]
            assert (block == part.structure.to_numpy(object)).all()


def test_direct_sums():
    assert (so3 + af.LieAlgebra("R^3")).dimension == 6
    both = af.LieAlgebra(epsilon()) + so3
    assert both.dimension == 6
    np.testing.assert_array_equal(both.structure.to_numpy(float)[3:, 3:, 3:], epsilon())
    a = sp.Symbol("a")
    scaled = so3.change_basis(sp.diag(a, 1, 1)) + so3
    assert scaled.parameters == ["a"]


def test_a_change_of_basis_is_covariant():
    matrix = sp.Matrix([[1, 2, 0], [0, 1, 3], [1, 0, 1]])
    changed = so3.change_basis(matrix)
    there = np.array(matrix.tolist(), dtype=float)
    expected = np.einsum("ai,ijk,jb,kc->abc", np.linalg.inv(there), epsilon(), there, there)
    np.testing.assert_allclose(changed.structure.to_numpy(float), expected, atol=1e-14)
    assert np.allclose(changed.killing_form.to_numpy(float), there.T @ so3.killing_form.to_numpy() @ there)


def test_the_bracket_and_ad():
    x, y = [1, 2, 3], [0, 1, Fraction(1, 2)]
    np.testing.assert_allclose(so3.bracket(x, y).to_numpy(float), np.cross(x, np.array(y, dtype=float)))
    assert so3.ad(x).contract("^i_j ^j -> ^i", af.Tensor(y, "^")) == so3.bracket(x, y)


def test_jacobi_has_its_witness():
    with pytest.raises(af.JacobiError) as found:
        af.LieAlgebra("[x,y]=z; [y,z]=y", basis="x y z")
    assert found.value.triple == ("x", "y", "z")
    assert found.value.residual == "-z"
    assert "[[x,y],z]" in str(found.value)
    [antisymmetry, jacobi] = af.check("[x,y]=z; [y,z]=y", basis="x y z")
    assert antisymmetry and not jacobi
    assert jacobi.indices == [1, 2, 3] and jacobi.residual == [(3, "-1")]


def test_other_witnesses():
    with pytest.raises(af.AntisymmetryError) as found:
        af.LieAlgebra.from_structure([(0, 1, 1, 2)], dimension=2)
    assert found.value.pair == ("e2", "e2")
    with pytest.raises(af.ClosureError) as found:
        af.LieAlgebra.from_matrices([[[0, 1], [0, 0]], [[0, 0], [1, 0]]], basis="e f")
    assert found.value.pair == ("e", "f")
    with pytest.raises(af.DependentError) as found:
        af.LieAlgebra.from_matrices([[[0, 1], [0, 0]], [[0, 2], [0, 0]]], basis="e f")
    assert "f" in found.value.relation
    with pytest.raises(af.MetricError) as found:
        af.Geometry("so3", metric="diag(1,1,0)")
    assert found.value.null == "e3"
    with pytest.raises(af.MetricError) as found:
        af.Geometry("so3", metric=[[1, 2, 0], [0, 1, 0], [0, 0, 1]])
    assert found.value.pair == ("e1", "e2")
    with pytest.raises(af.SymmetryError):
        af.Geometry("so3", metric="identity", torsion=np.ones((3, 3, 3)))


def test_connections():
    c = so3.structure
    for name, factor in [("plus", 1), ("zero", Fraction(1, 2)), ("minus", 0)]:
        geometry = af.Geometry(so3, connection=name)
        assert geometry.affinities == c * factor
        assert af.Geometry(so3, connection=factor) == geometry
        assert geometry.lambda_ == factor
    assert af.Geometry(so3, connection="lambda=1/3").affinities == c / 3
    lam = sp.Symbol("lam", real=True)
    family = af.Geometry(so3, connection=lam)
    assert family.lambda_ == lam and family.torsion.to_numpy()[0, 1, 2] == 2 * lam - 1
    by_affinities = af.Geometry(so3, affinities=c * Fraction(1, 2))
    assert by_affinities.curvature == af.Geometry(so3, connection="zero").curvature
    torsion = so3.structure * Fraction(2, 3)
    with_torsion = af.Geometry(so3, metric="diag(1,2,3)", torsion=torsion)
    assert with_torsion.torsion == torsion and with_torsion.nonmetricity.is_zero
    q = np.zeros((3, 3, 3))
    q[0, 1, 2] = q[0, 2, 1] = 2
    both = af.Geometry(so3, metric="diag(1,2,3)", torsion=torsion, nonmetricity=q)
    assert both.torsion == torsion
    np.testing.assert_array_equal(both.nonmetricity.to_numpy(), q)


def test_frames_and_reports():
    m3 = af.Geometry("M3", frame="right")
    assert m3.frame == "right-invariant" and m3.affinities.is_zero
    assert "R^1_212" in str(af.Geometry("SO3").curvature)
    assert "\\begin{align*}" in af.Geometry("SO3").table(format="latex")
    assert "dOmega1/dt" in af.Geometry("so3", "plus", "diag(J1,J2,J3)").equations()
    assert "nabla g = 0" in af.compare()
    assert "quaternion" in af.conventions()
    assert len(af.catalogue("heis")) == 1
    assert af.Geometry("heisenberg(3)", metric="identity").check_property("einstein").witness.startswith("Ric_jl")
    assert len(af.Geometry("heisenberg(3)", metric="identity").holonomy()) == 3


def test_floats_are_floats():
    metric = [1.5, 2.25, 0.1]
    floats, exact = af.Geometry("so3", metric=metric, scalar="float"), af.Geometry(
        "so3", metric=[Fraction(3, 2), Fraction(9, 4), Fraction(1, 10)]
    )
    assert floats.scalar == "float"
    np.testing.assert_allclose(floats.ricci.to_numpy(), exact.ricci.to_numpy(float), rtol=1e-14)
    with pytest.raises(TypeError, match="Fraction"):
        af.Geometry("so3", metric=metric)


@given(st.lists(st.fractions(min_value=1, max_value=9, max_denominator=9), min_size=3, max_size=3))
def test_milnors_formula(metric):
    """Ricci of so(3) with a diagonal metric, after J. Milnor, Adv. Math. 21 (1976) 293-329."""
    a, b, c = metric
    ricci = af.Geometry("so3", metric=metric).ricci
    assert ricci[0, 0] == (a + b - c) * (a - b + c) / (2 * b * c)
    assert ricci[0, 1] == 0


@pytest.mark.parametrize("text", ["[x,y]=z, [y,z]=x, [z,x]=y", "[x,y]=z; [y,z]=x; [z,x]=y;", "\n[x, y] = z  # a, b\n[y, z] = x\n[z, x] = y\n"])
def test_brackets_of_one_text(text: str) -> None:
    expected = af.LieAlgebra({"basis": ["x", "y", "z"], "brackets": ["[x,y]=z", "[y,z]=x", "[z,x]=y"]}).structure
    assert af.LieAlgebra(text, basis="x y z").structure == expected
    assert af.LieAlgebra([part for part in re.split(r"[;\n]|, (?=\[)", text) if part], basis="x y z").structure == expected
    with pytest.raises(af.InputError) as refused:
        af.LieAlgebra(text.replace("= x", "= u").replace("=x", "=u"), basis="x y z")
    assert "u" in str(refused.value)


def test_integers_of_any_type():
    for integer in (np.int64, np.uint8, sp.Integer):
        rows = [(integer(2), integer(0), integer(1), 1)]
        algebra = af.LieAlgebra.from_structure(rows, dimension=integer(3))
        assert algebra == af.LieAlgebra.from_structure({(integer(2), 0, 1): 1}, dimension=3)
        assert algebra.structure[integer(2), integer(0), integer(1)] == 1
        assert algebra.truncated(integer(2)).dimension == 6
        assert af.Tensor({(integer(1),): 1}, "^", dimension=integer(2))[1] == 1
    for call in (lambda: algebra.truncated(True), lambda: algebra.contraction([True, 0, 0]), lambda: algebra.structure[True, 0, 1]):
        with pytest.raises(TypeError, match="is an integer, not bool"):
            call()


def test_floats_stay_floats_with_a_tolerance():
    algebra = af.LieAlgebra.from_structure([(2, 0, 1, 0.5)], scalar="float", dimension=3)
    geometry = af.Geometry(algebra, metric=[0.5, 1, 1], tolerance=1e-9)
    assert geometry.scalar == "float" and geometry.algebra.scalar == "float"
    assert af.Geometry("so3", 0.25, scalar="float").lambda_ == 0.25
    for make in (af.LieAlgebra, af.Geometry, af.check):
        with pytest.raises(ValueError, match="exact numbers have no tolerance"):
            make("so3", tolerance=1e-9)


def test_names_and_dimensions_are_not_ignored():
    with pytest.raises(TypeError, match="has a basis"):
        af.LieAlgebra(so3, basis="x y z")
    with pytest.raises(TypeError, match="has a basis"):
        af.Geometry({"basis": ["x", "y"], "brackets": "[x, y] = y"}, basis="u v")
    for call in (
        lambda: af.Tensor(np.eye(3, dtype=int), "^_", dimension=5),
        lambda: af.LieAlgebra.from_structure(epsilon(int), dimension=5),
    ):
        with pytest.raises(ValueError, match="have the dimension 3, not 5"):
            call()
    assert af.Tensor(np.eye(3, dtype=int), "^_", dimension=np.int64(3)).dimension == 3
    with pytest.raises(TypeError, match="bool"):
        af.Tensor.from_coo([[0, 1]], [True, 2], "^", 2)
