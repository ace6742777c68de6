"""Exports to other programs: SymPy runs its own; those of Sage and Maple are parsed here, for neither program is at hand."""

import re
from fractions import Fraction

import pytest
import sympy as sp

import affinor as af

NAMES = ["so3", "sl2", "heisenberg(5)", "bianchi(VI,h=-1/2)", "bianchi(VI,h=h)", "patera(4,9,b=b)", "R^2", "su(3)"]
every = pytest.mark.parametrize("name", NAMES)


def number(value):
    """An exact number or an expression of SymPy."""
    return sp.sympify(str(value).replace("^", "**"), rational=True)


def constants(name):
    """`{(i, j, k): c^i_jk}` from 0, both orders of j and k, without zeros."""
    array = af.LieAlgebra(name).structure.to_sympy()
    n = af.LieAlgebra(name).dimension
    places = [(i, j, k) for i in range(n) for j in range(n) for k in range(n)]
    return {at: number(array[at]) for at in places if array[at] != 0}


def equal(found, name):
    expected = constants(name)
    assert found.keys() == expected.keys()
    assert all(sp.simplify(found[at] - expected[at]) == 0 for at in expected)


@every
def test_sympy_runs_its_export(name):
    names = {}
    exec(af.LieAlgebra(name).export("sympy"), names)
    array, n = names["c"], af.LieAlgebra(name).dimension
    assert array.shape == (n, n, n)
    places = [(i, j, k) for i in range(n) for j in range(n) for k in range(n)]
    equal({at: number(array[at]) for at in places if array[at] != 0}, name)


class Sage:
    """The part of Sage's language that an export uses, on Python's own syntax."""

    @staticmethod
    def run(text):
        found = {}

        class Field:
            def __init__(self, names=""):
                self.names = names

            def __call__(self, text):
                return Fraction(text)

            def gens(self):
                return sp.symbols(self.names, seq=True)

        def algebra(field, brackets, names):
            assert isinstance(field, Field)
            found.update(brackets=brackets, labels=names.split(","))

        scope = {
            "QQ": Field(),
            "PolynomialRing": lambda field, names: Field(names),
            "FractionField": lambda ring: ring,
            "LieAlgebra": algebra,
        }
        # Sage reads ^ as a power
        exec(text.replace("^", "**"), scope)
        return found["labels"], found["brackets"]


def by_labels(labels, brackets):
    found = {}
    for (x, y), image in brackets.items():
        j, k = labels.index(x), labels.index(y)
        for z, value in image.items():
            found[labels.index(z), j, k] = number(value)
            found[labels.index(z), k, j] = -number(value)
    return found


@every
def test_sage_has_the_brackets(name):
    equal(by_labels(*Sage.run(af.LieAlgebra(name).export("sage"))), name)


def maple(text):
    """The labels and the brackets of a call of LieAlgebraData."""
    text = "".join(line for line in text.splitlines() if not line.startswith("#"))
    shape = r"with\(DifferentialGeometry\): with\(LieAlgebras\):L := LieAlgebraData\(\[(.*?)\], \[([^]]*)\], Alg\):DGsetup\(L\):"
    body, labels = re.fullmatch(shape, text).groups()
    labels = labels.split(", ")
    symbols = {label: sp.Symbol(f"label_{label}") for label in labels}
    brackets = {}
    for x, y, image in re.findall(r"\[(\w+), (\w+)\] = ([^\[]*?)(?:,\s*(?=\[)|$)", body.strip()):
        names = {**symbols, **{p: sp.Symbol(p) for p in re.findall(r"[A-Za-z]\w*", image) if p not in symbols}}
        terms = sp.expand(sp.sympify(image.replace("^", "**"), locals=names, rational=True))
        brackets[x, y] = {label: terms.coeff(symbol) for label, symbol in symbols.items() if terms.coeff(symbol) != 0}
    return labels, brackets


@every
def test_maple_has_the_brackets(name):
    equal(by_labels(*maple(af.LieAlgebra(name).export("maple"))), name)


def test_parameters_with_names_of_the_programs():
    names = ["c", "lambda", "F", "F_", "T", "L", "E", "last", "gamma", "symbols", "QQ"]
    symbols = sp.symbols(names)
    algebra = af.LieAlgebra.from_structure([(i, 11, i, symbol) for i, symbol in enumerate(symbols)])
    found: dict = {}
    exec(algebra.export("sympy"), found)
    assert [found["c"][i, 11, i] for i in range(11)] == symbols
    _, brackets = Sage.run(algebra.export("sage"))
    assert [str(-brackets[f"e{i}", "e12"][f"e{i}"]) for i in range(1, 12)] == ["c", "lambda_", "F__", "F_", "T", "L_", "E", "last", "gamma", "symbols", "QQ_"]
    variables = re.findall(r"^(\w+) := Indet", algebra.export("gap"), re.MULTILINE)
    assert sorted(variables) == ["E_", "F__", "F___", "L_", "QQ_", "T_", "c", "gamma", "lambda", "last_", "symbols"]
    assert "[e6, e12] = -L_*e6" in algebra.export("maple") and "[e9, e12] = -gamma_*e9" in algebra.export("maple")
