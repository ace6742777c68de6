"""python-flint and SymEngine, symbolic metrics. `flint`: quotients of integer polynomials (`fmpz_mpoly`), in lowest terms
after each operation. `symengine`: expressions, of which numerator and denominator are expanded and, as SymEngine has no
greatest common divisor of several variables, not in lowest terms: its counts may be larger, its values are not printed."""
import sys
import time
from peer import both_orders, constants, report, values

n, c = constants(sys.argv[1])
metric, mode = sys.argv[3:5]
names = [row.split(",") for row in metric.split(";")]
letters = sorted({name for row in names for name in row} - {"0"})
c = both_orders(c)


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


if mode == "flint":
    from flint import Ordering, fmpz_mpoly_ctx
    ring = fmpz_mpoly_ctx.get(letters, Ordering.degrevlex)
    gens, one = dict(zip(letters, ring.gens())), ring.constant(1)

    def reduced(above, below):
        if above == 0:
            return Quotient(above, one)
        common = above.gcd(below)
        return Quotient(above, below) if common == 1 else Quotient(above // common, below // common)
else:
    import symengine
    gens, one = dict(zip(letters, symengine.symbols(letters))), symengine.Integer(1)

    def reduced(above, below):
        return Quotient(symengine.expand(above), symengine.expand(below))

zero = Quotient(one - one, one)
gens["0"] = one - one
spent = 0


def stage(name, work):
    global spent
    start = time.process_time()
    found = {at: v for at, v in work().items() if v}
    spent += time.process_time() - start
    report(name, spent, len(found))
    if mode == "flint":
        values(sys.argv[2], name, found.items())
    return found


def add(sums, at, value):
    sums[at] = sums[at] + value if at in sums else value


def inverted(rows):
    """Gauss-Jordan elimination."""
    m = [row + [Quotient(one, one) if i == j else zero for j in range(n)] for i, row in enumerate(rows)]
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


def affinities():
    g = [[Quotient(gens[name], one) for name in row] for row in names]
    inverse = inverted(g)
    lower = {}
    for (m, j, k), v in c.items():
        for p in range(n):
            if g[p][m]:
                add(lower, (p, j, k), g[p][m] * v)
    half, sums = Quotient(one, one + one), {}
    for p in range(n):
        for j in range(n):
            for k in range(n):
                koszul = (lower.get((p, j, k), zero) + -lower.get((j, k, p), zero) + lower.get((k, p, j), zero)) * half
                if koszul:
                    for i in range(n):
                        if inverse[i][p]:
                            add(sums, (i, j, k), inverse[i][p] * koszul)
    return sums


def curvature():
    rows, sums = {}, {}
    for (m, j, k), v in found.items():
        rows.setdefault((j, k), []).append((m, v))
    for k in range(n):
        for l in range(k + 1, n):
            for j in range(n):
                for inner, outer, sign in ((l, k, 1), (k, l, -1)):
                    for m, v in rows.get((inner, j), []):
                        for i, w in rows.get((outer, m), []):
                            add(sums, (i, j, k, l), v * w * sign)
                for m in range(n):
                    if (m, k, l) in c:
                        for i, w in rows.get((m, j), []):
                            add(sums, (i, j, k, l), w * -c[m, k, l])
    return sums


def ricci():
    sums = {}
    for (i, j, k, l), v in riemann.items():
        if i == k:
            add(sums, (j, l), v)
        if i == l:
            add(sums, (j, k), -v)
    return sums


found = stage("affinities", affinities)
riemann = stage("curvature", curvature)
stage("ricci", ricci)
