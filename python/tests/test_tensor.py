"""Tensors: conversions, arithmetic, contraction, display."""

import copy
import pickle
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import affinor as af

ricci = af.Geometry("so3", metric="diag(a,b,c)").ricci
curvature = af.Geometry("SO3").curvature
integers = arrays.arrays(np.int64, (3, 3), elements=st.integers(-9, 9))


def test_printed_as_on_the_command_line():
    table = af.Geometry("SO3").table("curvature")
    assert str(curvature) in table
    assert repr(curvature) == "<Tensor R^i_jkl, dimension 3, 12 nonzero components, exact>"
    assert str(af.Geometry("M3").curvature) == "Curvature\n  R^i_jkl = 0"
    assert str(ricci) in af.Geometry("so3", metric="diag(a,b,c)").table("ricci")


def test_notebooks_get_latex_or_a_table():
    assert "R^{1}{}_{212}" in curvature._repr_latex_() and curvature._repr_html_() is None
    large = af.Geometry("so(5)").curvature
    assert large.nnz > 50
    assert f"and {large.nnz - 50} more" in large._repr_latex_()
    assert large._repr_html_().count("<tr>") == 51 and f"{large.nnz - 50} are not" in large._repr_html_()
    assert "= 0" in af.Geometry("M3").curvature._repr_latex_()


def test_arrays():
    dense = curvature.to_numpy()
    assert dense.dtype == float and dense.shape == (3, 3, 3, 3) and dense[0, 1, 0, 1] == 0.25
    exact = curvature.to_numpy(object)
    assert exact[0, 1, 0, 1] == Fraction(1, 4) and exact[0, 0, 0, 0] == 0
    indices, values = curvature.to_coo()
    assert indices.shape == (4, 12) and (dense[tuple(indices)] == values).all()
    np.testing.assert_array_equal(np.asarray(curvature), dense)
    assert ricci.to_numpy().dtype == object and isinstance(ricci.to_numpy()[0, 0], sp.Expr)
    with pytest.raises(af.InputError, match="parameters"):
        ricci.to_numpy(float)
    with pytest.raises(ValueError, match="copy"):
        np.array(curvature, copy=False)
    with pytest.raises(MemoryError):
        af.LieAlgebra("so(40)").structure.to_numpy()


def test_arrays_of_integers():
    components = np.array([[3, 0], [-2, 1 << 40]])
    np.testing.assert_array_equal(af.Tensor(components, "^_").to_numpy(int), components)
    for value in (Fraction(1, 2), (1 << 53) + 1, 1 << 70):
        for convert in (af.Tensor.to_numpy, af.Tensor.to_coo):
            with pytest.raises(TypeError, match="int64"):
                convert(af.Tensor([value, 1], "^"), np.int64)
    with pytest.raises(TypeError, match="uint8"):
        af.Tensor([-1, 300], "^").to_numpy(np.uint8)


def test_floats_stay_floats_in_subs():
    floats = af.Tensor([[0.1, 0.2], [0.3, 0.4]], "^_", scalar="float")
    found = floats.subs({"a": 2})
    assert found.scalar == "float" and found == floats


def test_pandas():
    frame = curvature.to_pandas()
    assert list(frame.columns) == ["i", "j", "k", "l", "value"] and len(frame) == 12
    assert list(ricci.to_pandas().columns) == ["j", "l", "value"]


def test_indices():
    assert curvature[0, 1, 0, 1] == Fraction(1, 4)
    assert curvature[0, :, 0, :] == af.Tensor(curvature.to_numpy()[0, :, 0, :] * 4, "__") / 4
    assert dict(curvature.items())[0, 1, 0, 1] == Fraction(1, 4)
    assert len(dict(curvature.items())) == curvature.nnz


@given(integers, integers, st.fractions(max_denominator=9))
def test_arithmetic(x, y, factor):
    s, t = af.Tensor(x, "^_"), af.Tensor(y, "^_")
    np.testing.assert_array_equal((s + t).to_numpy(), x + y)
    np.testing.assert_array_equal((s - t).to_numpy(), x - y)
    np.testing.assert_array_equal((-s).to_numpy(), -x)
    np.testing.assert_array_equal((s * factor).to_numpy(object), x.astype(object) * factor)
    assert factor * s == s * factor
    np.testing.assert_array_equal(af.contract("^i_k ^k_j -> ^i_j", s, t).to_numpy(), x @ y)
    assert af.contract("x^i_k y^k_j -> ^i_j", x=s, y=t) == s.contract("^i_k ^k_j -> ^i_j", t)
    assert s.trace(0, 1)[()] == np.trace(x)
    np.testing.assert_array_equal(s.permute(1, 0).to_numpy(), x.T)
    assert s.permute(1, 0).slots == "_^"


def test_factors_in_order_and_by_name():
    u, v, w = np.array([[1, 2, 3], [4, 5, 6], [7, 8, 9]])
    first, second, third = (af.Tensor(x, "^") for x in (u, v, w))
    expected = np.einsum("i,j,k->ijk", u, v, w)
    for key in ("a", "b", "w"):
        found = af.contract(f"^i ^j {key}^k -> ^i^j^k", first, second, **{key: third})
        np.testing.assert_array_equal(found.to_numpy(), expected)
    with pytest.raises(af.AffinorError):
        af.contract("^i ^j b^k -> ^i^j^k", first, second)


@given(integers)
def test_equality_hash_pickle_copy(x):
    tensor = af.Tensor(x, "^_")
    for other in (af.Tensor(x.astype(float), "^_"), pickle.loads(pickle.dumps(tensor)), copy.deepcopy(tensor)):
        assert other == tensor and hash(other) == hash(tensor)
    assert tensor != af.Tensor(x, "__") and tensor != x.tolist()
    floats = tensor.to_float()
    assert floats.scalar == "float" and floats != tensor
    assert pickle.loads(pickle.dumps(floats)) == floats
    parameter = tensor * sp.Symbol("q", positive=True)
    assert pickle.loads(pickle.dumps(parameter)) == parameter


@given(integers)
def test_ways_in(x):
    indices = np.array(np.nonzero(x))
    tensor = af.Tensor(x, "__")
    assert af.Tensor.from_coo(indices, x[tuple(indices)], "__", 3) == tensor
    assert af.Tensor({tuple(at): int(x[tuple(at)]) for at in indices.T}, "__", dimension=3) == tensor
    assert af.Tensor(sp.Matrix(x.tolist()), "__") == tensor
    assert af.Tensor(x.tolist(), "__") == tensor
    np.testing.assert_array_equal(af.Tensor(x, "__", scalar="float").to_numpy(), x)


def test_rank_0_and_floats():
    one = af.Tensor({(): Fraction(1, 2)}, "", dimension=3)
    assert (one + one)[()] == 1 and (one - one).is_zero
    f = af.Tensor([0.1, 0.2, 0.3], "^", scalar="float")
    assert (f * 2.5)[1] == 0.5
    assert af.contract("^i _i -> ", f, af.Tensor([1, 1, 1], "_"))[()] == pytest.approx(0.6)


def test_big_numbers():
    big = 10**40 + 1
    assert af.Tensor([big, Fraction(1, big)], "^")[0] == big
    assert pickle.loads(pickle.dumps(af.Tensor([big, Fraction(1, big)], "^")))[1] == Fraction(1, big)


def test_coordinates_of_a_large_tensor():
    """Arrays of more than a megabyte; components in the order of their indices."""
    curvature = af.Geometry("so(14)").curvature
    indices, values = curvature.to_coo()
    assert indices.nbytes > 1 << 20 and indices.shape == (4, curvature.nnz) == (4, len(values))
    assert indices.dtype == np.int64 and indices.flags.c_contiguous and indices.flags.writeable and indices.flags.owndata
    assert (np.diff(np.ravel_multi_index(tuple(indices), curvature.shape)) > 0).all()
    for at in range(0, curvature.nnz, 997):
        assert curvature[tuple(indices[:, at])] == values[at]
    assert af.Tensor.from_coo(indices, values, "^___", curvature.dimension, scalar="float").to_coo()[1].sum() == values.sum()


def test_a_scalar_of_numpy_times_a_tensor_is_a_tensor():
    tensor = af.Tensor([1, 2], "^")
    assert np.int64(2) * tensor == tensor * 2 == np.float64(2) * tensor
    assert isinstance(np.int64(2) * tensor, af.Tensor)


def test_indices_in_any_layout():
    records = np.zeros(3, dtype=[("tag", "i4"), ("at", "i8", (2,))])
    records["at"] = [[0, 1], [1, 2], [2, 0]]
    expected = af.Tensor({(0, 1): 1, (1, 2): 2, (2, 0): 3}, "__", dimension=3)
    for indices in (records["at"].T, records["at"].T.astype(np.uint8), records["at"].T.tolist(), records["at"].T.astype(object)):
        assert af.Tensor.from_coo(indices, [1, 2, 3], "__", 3) == expected


def test_iteration_goes_along_the_first_index():
    ricci = af.Geometry("so3", metric=[1, 2, 3]).ricci
    assert [row.slots for row in ricci] == ["_"] * 3
    assert [[value for value in row] for row in ricci] == ricci.to_numpy(object).tolist()
    with pytest.raises(TypeError, match="rank 0"):
        iter(af.Tensor(2, ""))


def test_what_a_substitution_cannot_replace_is_refused():
    a, b = sp.symbols("a b")
    ricci = af.Geometry("so3", metric=[a, b, 1]).ricci
    for key in (a * b, sp.Function("f")(a), "a*b"):
        with pytest.raises(ValueError, match="is not a parameter"):
            ricci.subs({key: 1})
    algebra = af.LieAlgebra("bianchi(VII)").subs({"h": 3})
    assert af.Geometry(algebra, metric=[b, 1, 1]).metric[0, 0] == b
    with pytest.raises(ValueError, match="h has a value in the algebra"):
        af.Geometry(algebra, metric=["h", 1, 1])


def test_floats_are_not_taken_for_exact_numbers():
    for value in (sp.Float(2.0**60), sp.Float("1.00000000000000000000001", 30), sp.Float(0.1)):
        with pytest.raises(TypeError, match="exact numbers are needed"):
            af.Tensor([value, 0], "^")
    assert af.Tensor([sp.Float(3.0), 0], "^")[0] == 3
    if np.finfo(np.longdouble).eps < np.finfo(float).eps:
        with pytest.raises(TypeError, match="exact numbers are needed"):
            af.Tensor([np.longdouble(1) + np.finfo(np.longdouble).eps, 0], "^")
    with pytest.raises(TypeError, match="scalar='float'"):
        af.Geometry("so3", affinities=af.Tensor(np.full((3, 3, 3), 0.1), "^__", scalar="float"))


def test_components_without_floats_say_why():
    big = af.Tensor([10**400, 0], "^")
    for convert in (big.to_numpy, big.to_float):
        with pytest.raises(af.InputError, match=r"0000\.\.\. is beyond the range of floats"):
            convert()
    assert big.to_numpy(object)[0] == 10**400
    assert af.Tensor([sp.sqrt(2), 0], "^").to_float().to_numpy() == pytest.approx([2**0.5, 0])
    with pytest.raises(af.InputError, match="a has parameters"):
        af.Tensor(["a", 0], "^").to_numpy(float)
    halves = af.Tensor(np.eye(3) / 2, "^_", scalar="float")
    with pytest.raises(af.InputError, match="are floats, but exact numbers are needed"):
        af.LieAlgebra("so3").change_basis(halves)


def test_orders_of_slots():
    with pytest.raises(af.ShapeError, match=r"\[0, 0\] are not different slots"):
        af.Tensor([[1, 2], [3, 4]], "^_").permute(0, 0)


def test_indices_as_in_numpy():
    rng = np.random.default_rng(4)
    dense = rng.integers(-2, 3, (4,) * 4)
    tensor = af.Tensor(dense, "^___")
    assert len(tensor) == 4 and tensor.dtype == np.float64 and af.Tensor(["a"], "^").dtype == object
    everything = slice(None)
    for at in [(-1, 0, -4, 2), (-1, ...), (..., -2), (1, ..., -3), (..., 0, 1), (0, -1, ..., 2, 3), (everything, -1, ...), ...]:
        found, expected = tensor[at], dense[at]
        assert np.array_equal(found.to_numpy() if isinstance(found, af.Tensor) else found, expected), at
    with pytest.raises(TypeError, match="rank 0"):
        len(af.Tensor({(): 2}, "", dimension=3))


def test_products_by_matmul():
    rng = np.random.default_rng(5)
    for a, b in [("^", "_"), ("_^", "_^"), ("^_", "^__"), ("^__", "^"), ("_", "^___")]:
        x, y = rng.integers(-3, 4, (3,) * len(a)), rng.integers(-3, 4, (3,) * len(b))
        product = af.Tensor(x, a) @ af.Tensor(y, b)
        assert product.slots == a[:-1] + b[1:]
        assert np.array_equal(product.to_numpy(), np.tensordot(x, y, 1)), (a, b)
    for a, b in [("^", "^"), ("__", "_^")]:
        with pytest.raises(af.ShapeError, match="upper index next to a lower"):
            af.Tensor(np.ones((3,) * len(a), int), a) @ af.Tensor(np.ones((3,) * len(b), int), b)


def test_matrices_of_sympy_are_exact():
    third = af.Tensor([[Fraction(1, 3), 0], [0, 1]], "^_")
    assert sp.Matrix(third) == sp.diag(sp.Rational(1, 3), 1)
    assert sp.sympify(third) == sp.diag(sp.Rational(1, 3), 1)
    assert np.asarray(third).dtype == np.float64
    a = sp.Symbol("a", positive=True)
    assert sp.Matrix(af.Geometry("so3", metric=[a, 1, 1]).metric) == sp.diag(a, 1, 1)


def test_names_of_indices():
    """Text and LaTeX name indices on request: by single letters without commas, by longer names with commas."""
    ricci = af.Geometry("so3", connection="zero").ricci
    assert ricci.to_text() == str(ricci)
    assert "Ric_xx = Ric_yy = Ric_zz = 1/2" in ricci.to_text(labels=["x", "y", "z"])
    assert "Ric_r,r = Ric_theta,theta" not in ricci.to_text(labels=["r", "theta", "phi"])
    assert "Ric_rr = Ric_theta,theta = Ric_phi,phi = 1/2" in ricci.to_text(labels=["r", "theta", "phi"])
    assert r"_{\theta \theta}" in ricci.to_latex(labels=["r", "theta", "phi"])
    assert ricci.to_latex(labels=None) == ricci.to_latex()
    for method in (ricci.to_text, ricci.to_latex):
        with pytest.raises(ValueError, match="2 labels, but the dimension is 3"):
            method(labels=["x", "y"])
