"""SymPy, symbolic metrics. `cancel`: expressions, each component brought to lowest terms by `cancel`;
`field`: elements of a field of rational functions, in lowest terms after each operation."""
import sys
import time
from sympy import QQ, Rational, cancel, symbols
from sympy.polys.matrices import DomainMatrix
from peer import both_orders, constants, report, values

n, c = constants(sys.argv[1])
metric, mode = sys.argv[3:5]
names = [[name for name in row.split(",")] for row in metric.split(";")]
letters = sorted({name for row in names for name in row} - {"0"})
c = both_orders(c)
field = QQ.frac_field(*letters) if mode == "field" else None
letter = dict(zip(letters, field.gens if field else symbols(letters)))
letter["0"] = field.zero if field else Rational(0)
half = field.one / 2 if field else Rational(1, 2)
spent = 0


def lowest(sums):
    """Sums of terms, brought to lowest terms, without those that are zero."""
    found = {}
    for at, terms in sums.items():
        v = sum(terms, letter["0"])
        v = v if field else cancel(v)
        if v != 0:
            found[at] = v
    return found


def stage(name, work):
    global spent
    start = time.process_time()
    found = work()
    spent += time.process_time() - start
    report(name, spent, len(found))
    values(sys.argv[2], name, found.items())
    return found


def affinities():
    g = [[letter[name] for name in row] for row in names]
    matrix = DomainMatrix(g, (n, n), field) if field else DomainMatrix.from_list_sympy(n, n, g).to_field()
    inverse = matrix.inv().to_Matrix() if not field else matrix.inv().to_list()
    inverse = [[inverse[i, j] if not field else inverse[i][j] for j in range(n)] for i in range(n)]
    lower = {}
    for (m, j, k), v in c.items():
        for p in range(n):
            if g[p][m] != 0:
                lower[p, j, k] = lower.get((p, j, k), letter["0"]) + v * g[p][m]
    zero, sums = letter["0"], {}
    for p in range(n):
        for j in range(n):
            for k in range(n):
                koszul = (lower.get((p, j, k), zero) - lower.get((j, k, p), zero) + lower.get((k, p, j), zero)) * half
                if koszul != 0:
                    for i in range(n):
                        if inverse[i][p] != 0:
                            sums.setdefault((i, j, k), []).append(inverse[i][p] * koszul)
    return lowest(sums)


def curvature():
    rows = {}
    for (m, j, k), v in found.items():
        rows.setdefault((j, k), []).append((m, v))
    sums = {}
    for k in range(n):
        for l in range(k + 1, n):
            for j in range(n):
                for inner, outer, sign in ((l, k, 1), (k, l, -1)):
                    for m, v in rows.get((inner, j), []):
                        for i, w in rows.get((outer, m), []):
                            sums.setdefault((i, j, k, l), []).append(sign * v * w)
                for m in range(n):
                    if (m, k, l) in c:
                        for i, w in rows.get((m, j), []):
                            sums.setdefault((i, j, k, l), []).append(-c[m, k, l] * w)
    return lowest(sums)


def ricci():
    sums = {}
    for (i, j, k, l), v in riemann.items():
        if i == k:
            sums.setdefault((j, l), []).append(v)
        if i == l:
            sums.setdefault((j, k), []).append(-v)
    return lowest(sums)


found = stage("affinities", affinities)
riemann = stage("curvature", curvature)
stage("ricci", ricci)
