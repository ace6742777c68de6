"""Packages of Python, symbolic metrics.

- `cancel`: expressions of SymPy, each component brought to lowest terms by `cancel`.
- `field`: elements of SymPy's field of rational functions, in lowest terms after each operation.
- `flint`: quotients of integer polynomials of python-flint (`fmpz_mpoly`), in lowest terms after each operation.
- `symengine`: quotients of SymEngine's expressions, expanded and, as SymEngine has no greatest common divisor of several
  variables, not in lowest terms: its counts may be larger, its values are not printed.
"""
import sys
import time
from peer import both_orders, constants, report, values

n, c = constants(sys.argv[1])
metric, mode = sys.argv[3:5]
names = [row.split(",") for row in metric.split(";")]
letters = sorted({name for row in names for name in row} - {"0"})
c = both_orders(c)
spent = 0


class Quotient:
    """A quotient of polynomials."""
    __slots__ = ("above", "below")

    def __init__(self, above, below):
        self.above, self.below = above, below

    def __add__(self, other):
        if self.below == other.below:
            return reduced(self.above + other.above, self.below)
        return reduced(self.above * other.below + other.above * self.below, self.below * other.below)

    def __mul__(self, other):
        if isinstance(other, int):
            return reduced(self.above * other, self.below)
        return reduced(self.above * other.above, self.below * other.below)

    def __neg__(self):
        return Quotient(-self.above, self.below)

    def __bool__(self):
        return self.above != 0

    def inverse(self):
        return Quotient(self.below, self.above)

    def __str__(self):
        return f"({self.above})/({self.below})"


def inverted(rows):
    """Gauss-Jordan elimination."""
    m = [row + [one if i == j else zero for j in range(n)] for i, row in enumerate(rows)]
    for at in range(n):
        pivot = next(i for i in range(at, n) if m[i][at])
        m[at], m[pivot] = m[pivot], m[at]
        unit = m[at][at].inverse()
        m[at] = [v * unit for v in m[at]]
        for i in range(n):
            if i != at and m[i][at]:
                factor = -m[i][at]
                m[i] = [v + factor * w if w else v for v, w in zip(m[i], m[at])]
    return [row[n:] for row in m]


lowest = lambda v: v
if mode in ("cancel", "field"):
    from sympy import QQ, Rational, cancel, symbols
    from sympy.polys.matrices import DomainMatrix
    if mode == "field":
        field = QQ.frac_field(*letters)
        gens, zero, one = dict(zip(letters, field.gens)), field.zero, field.one
        inverted = lambda rows: DomainMatrix(rows, (n, n), field).inv().to_list()
    else:
        gens, zero, one, lowest = dict(zip(letters, symbols(letters))), Rational(0), Rational(1), cancel
        inverted = lambda rows: DomainMatrix.from_list_sympy(n, n, rows).to_field().inv().to_Matrix().tolist()
    half = one / 2
else:
    if mode == "flint":
        from flint import Ordering, fmpz_mpoly_ctx
        ring = fmpz_mpoly_ctx.get(letters, Ordering.degrevlex)
        gens, unit = ring.gens(), ring.constant(1)

        def reduced(above, below):
            if above == 0:
                return Quotient(above, unit)
            common = above.gcd(below)
            return Quotient(above, below) if common == 1 else Quotient(above // common, below // common)
    else:
        import symengine
        gens, unit = symengine.symbols(letters), symengine.Integer(1)

        def reduced(above, below):
            return Quotient(symengine.expand(above), symengine.expand(below))
    gens = {name: Quotient(gen, unit) for name, gen in zip(letters, gens)}
    zero, one, half = Quotient(unit - unit, unit), Quotient(unit, unit), Quotient(unit, unit + unit)
gens["0"] = zero


def stage(name, work):
    """Sums of the terms of each component, in lowest terms, without those that are zero."""
    global spent
    start = time.process_time()
    sums = {}
    for at, term in work():
        sums[at] = sums[at] + term if at in sums else term
    found = {at: v for at, v in ((at, lowest(v)) for at, v in sums.items()) if v}
    spent += time.process_time() - start
    report(name, spent, len(found))
    if mode != "symengine":
        values(sys.argv[2], name, found.items())
    return found


def affinities():
    g = [[gens[name] for name in row] for row in names]
    inverse = inverted(g)
    lower = {}
    for (m, j, k), v in c.items():
        for p in range(n):
            if g[p][m]:
                lower[p, j, k] = lower.get((p, j, k), zero) + g[p][m] * v
    for p in range(n):
        for j in range(n):
            for k in range(n):
                koszul = (lower.get((p, j, k), zero) + -lower.get((j, k, p), zero) + lower.get((k, p, j), zero)) * half
                if koszul:
                    for i in range(n):
                        if inverse[i][p]:
                            yield (i, j, k), inverse[i][p] * koszul


def curvature():
    rows = {}
    for (m, j, k), v in found.items():
        rows.setdefault((j, k), []).append((m, v))
    for k in range(n):
        for l in range(k + 1, n):
            for j in range(n):
                for inner, outer, sign in ((l, k, 1), (k, l, -1)):
                    for m, v in rows.get((inner, j), []):
                        for i, w in rows.get((outer, m), []):
                            yield (i, j, k, l), v * w * sign
                for m in range(n):
                    if (m, k, l) in c:
                        for i, w in rows.get((m, j), []):
                            yield (i, j, k, l), w * -c[m, k, l]


def ricci():
    for (i, j, k, l), v in riemann.items():
        if i == k:
            yield (j, l), v
        if i == l:
            yield (j, k), -v


found = stage("affinities", affinities)
riemann = stage("curvature", curvature)
stage("ricci", ricci)
