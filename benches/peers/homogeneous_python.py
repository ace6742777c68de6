"""Levi-Civita of an invariant metric on a homogeneous space, by Nomizu's formulas, with SymPy or in a fraction field of Sage.

Arguments: the file of constants, the file of values, indices of the complement and of the isotropy algebra, the diagonal of the
metric, `sympy` or `sage`.
"""
import itertools
import sys
from peer import both_orders, constants, measure, report, values

n, c = constants(sys.argv[1])
tangent, isotropy = ([int(i) - 1 for i in part.split(",")] for part in sys.argv[3:5])
diagonal, kind = sys.argv[5].split(","), sys.argv[6]
letters = sorted(set(diagonal))
if kind == "sympy":
    from sympy import Rational as number, cancel, symbols
    found = dict(zip(letters, symbols(letters)))
else:
    import sage.all__sagemath_modules  # noqa: F401
    from sage.rings.polynomial.polynomial_ring_constructor import PolynomialRing
    from sage.rings.rational_field import QQ
    number, cancel = (lambda p, q: QQ(p) / QQ(q)), (lambda value: value)
    found = dict(zip(letters, PolynomialRing(QQ, letters).fraction_field().gens()))
g = [found[name] for name in diagonal]
place = {i: at for at, i in enumerate(tangent + isotropy)}
r = len(tangent)
adapted = {tuple(place[i] for i in at): number(v.numerator, v.denominator) for at, v in both_orders(c).items()}


def by_last_two():
    """For each j, k the list of (i, c^i_jk)."""
    pairs = {}
    for (i, j, k), v in adapted.items():
        pairs.setdefault((j, k), []).append((i, v))
    return pairs


def curvature(pairs):
    # Gamma^i_jk with the direction j: 2 g_ii Gamma^i_jk = g_ii c^i_jk + g_kk c^k_ij + g_jj c^j_ik
    gamma = {}
    half = number(1, 2)
    for i, j, k in itertools.product(range(r), repeat=3):
        terms = ((1, (i, j, k)), (g[k] / g[i], (k, i, j)), (g[j] / g[i], (j, i, k)))
        value = sum(half * factor * adapted[at] for factor, at in terms if at in adapted)
        if value != 0 and cancel(value) != 0:
            gamma[i, j, k] = cancel(value)
    after = {}
    for (i, j, k), v in gamma.items():
        after.setdefault((j, k), []).append((i, v))
    sums = {}

    def add(at, v):
        sums[at] = sums[at] + v if at in sums else v

    for (m, l, j), v in gamma.items():
        for k in range(r):
            for i, w in after.get((k, m), ()):
                if k < l:
                    add((i, j, k, l), w * v)
                elif k > l:
                    add((i, j, l, k), -w * v)
    for (k, l), terms in pairs.items():
        if k < l < r:
            for m, v in terms:
                for j in range(r):
                    for i, w in after.get((m, j), ()) if m < r else pairs.get((m, j), ()):
                        add((i, j, k, l), -v * w)
    return {at: w for at, w in ((at, cancel(v)) for at, v in sums.items()) if w != 0}


seconds, result = measure(by_last_two, curvature)
report("curvature", seconds, len(result))
values(sys.argv[2], "curvature", result.items())
