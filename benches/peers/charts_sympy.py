"""SymPy, metrics over charts: `diff`, each component by `simplify`. Arguments as in charts_maxima.py."""
import sys
import time
from sympy import Derivative, Function, Matrix, Rational, diff, simplify, symbols, sympify
from chart_metrics import entries
from peer import report, values

letters = {name: symbols(name, real=True) for name in f"{sys.argv[1]},{sys.argv[4]}".split(",") if name}
letters |= {name.split("(")[0]: Function(name.split("(")[0]) for name in sys.argv[5].split(";") if name}
x = [letters[name] for name in sys.argv[1].split(",")]
n, all_ = len(x), range(len(x))
g = Matrix([[sympify(v.replace("^", "**"), locals=letters) for v in entries(row)] for row in sys.argv[3].split(";")])
spent = 0


def stage(name, work):
    global spent
    start = time.process_time()
    found = {at: v for at, v in ((at, simplify(v)) for at, v in work()) if v != 0}
    spent += time.process_time() - start
    report(name, spent, len(found))
    head = lambda d: Function("_".join(map(str, [d.expr.func, *d.variables])))(*d.expr.args)
    values(sys.argv[2], name, ((at, v.replace(lambda e: isinstance(e, Derivative), head)) for at, v in found.items()))
    return found


def affinities():
    h = simplify(g.inv())
    for i in all_:
        for j in all_:
            for k in all_:
                yield (i, j, k), sum(h[i, p] * (diff(g[p, j], x[k]) + diff(g[p, k], x[j]) - diff(g[j, k], x[p])) for p in all_) / 2


def curvature():
    c = lambda *at: found.get(at, Rational(0))
    for i in all_:
        for j in all_:
            for k in all_:
                for l in range(k + 1, n):
                    terms = sum(c(i, k, m) * c(m, l, j) - c(i, l, m) * c(m, k, j) for m in all_)
                    yield (i, j, k, l), diff(c(i, l, j), x[k]) - diff(c(i, k, j), x[l]) + terms


def ricci():
    r = lambda i, j, k, l: riemann.get((i, j, k, l), 0) if k < l else -riemann.get((i, j, l, k), 0)
    for j in all_:
        for l in all_:
            yield (j, l), sum(r(k, j, k, l) for k in all_ if k != l)


found = stage("affinities", affinities)
riemann = stage("curvature", curvature)
stage("ricci", ricci)
