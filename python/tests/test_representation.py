"""Representations: matrices satisfy their brackets, decompositions their dimensions, couplings are orthogonal."""

from fractions import Fraction

import numpy as np
import pytest
from sympy import Rational
from sympy.physics.wigner import clebsch_gordan

import affinor as af


@pytest.mark.parametrize(("algebra", "weight"), [("SU(3)", "8"), ("G2", [1, 1]), ("E6", "27"), ("SO(10)", "16")])
def test_matrices_satisfy_their_brackets(algebra, weight):
    representation = af.Representation(algebra, weight)
    m, exact = representation.matrices(), representation.matrices(dtype=object)
    rank = len(representation.labels)
    for i in range(1, rank + 1):
        for j in range(1, rank + 1):
            e, f = exact[f"e{i}"], exact[f"f{j}"]
            assert np.array_equal(e @ f - f @ e, exact[f"h{i}"] if i == j else 0 * e)
    form, hermitian = representation.bilinear_form(), representation.hermitian_form()
    assert (form is None) == (representation.reality == "complex")
    for i in range(1, rank + 1):
        e, f = m[f"e{i}"], m[f"f{i}"]
        assert np.allclose(f.T @ hermitian, hermitian @ e, rtol=1e-14, atol=1e-11)
        if form is not None:
            assert np.allclose(e.T @ form, -form @ e, rtol=1e-14, atol=1e-11)
    assert len(representation.matrices("all")) > 3 * rank
    assert isinstance(exact["e1"][0, 0], Fraction)
    assert np.array_equal(exact["e1"].astype(float), m["e1"])


def test_decompositions_have_their_dimensions():
    a, b = af.Representation("F4", "26"), af.Representation("F4", "52")
    assert sum(n * c.dimension for c, n in a.tensor(b).items()) == a.dimension * b.dimension
    assert sum(n * c.dimension for c, n in a.power(3).items()) == 26 * 27 * 28 // 6
    assert sum(n * c.dimension for c, n in a.branch("SO(9)").items()) == 26
    assert sum(n * c.dimension for c, n in a.branch("span e1-f1").items()) == 26
    assert af.Representation("SU(3)", "3").dual == af.Representation("SU(3)", "3bar")
    assert a.dual == a
    with pytest.raises(af.InputError):
        af.Representation("SU(3)", [1, -1])
    with pytest.raises(ValueError, match="symmetric"):
        a.power(2, "other")


def test_couplings_are_those_of_sympy():
    for j1, j2, j in [(1, 1, 2), (Fraction(1, 2), 1, "3/2"), (1.5, 2, 0.5)]:
        array = af.clebsch_gordan(j1, j2, j, squares=True)
        numbers = [Rational(str(Fraction(one))) for one in (j1, j2, j)]
        for (a, b, c), square in np.ndenumerate(array):
            value = clebsch_gordan(*numbers, a - numbers[0], b - numbers[1], c - numbers[2])
            assert value * abs(value) == Rational(square.numerator, square.denominator)
    real = af.clebsch_gordan(2, 2, 2, real=True)
    assert abs((real**2).sum() - 1) < 1e-14
    assert af.wigner_3j(1, 1, 1).shape == (3, 3, 3)
    assert af.wigner_6j(1, 1, 1, 1, 1, 1, squares=True) == Fraction(1, 36)
    with pytest.raises(af.InputError):
        af.clebsch_gordan(1, 1, 3)
