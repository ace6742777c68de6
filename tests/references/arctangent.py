"""The coefficients of `ARCTANGENT` in src/group/groups/so3.rs: atan(sqrt u)/sqrt u on [0, 1] with the least
largest relative error (Remez exchange in 60 digits), rounded to doubles; and the error after rounding.

    python3 tests/references/arctangent.py        (mpmath 1.3)
"""
from mpmath import atan, cos, lu_solve, matrix, mp, mpf, nstr, pi, polyval, sqrt

mp.dps = 60
TERMS = 21


def f(u):
    return mpf(1) if u == 0 else atan(sqrt(u)) / sqrt(u)


def error(c, u):
    return polyval(c[::-1], u) / f(u) - 1


def solve(nodes):
    a, b = matrix(TERMS + 1, TERMS + 1), matrix(TERMS + 1, 1)
    for i, u in enumerate(nodes):
        for j in range(TERMS):
            a[i, j] = u**j / f(u)
        a[i, TERMS], b[i] = (-1) ** i, 1
    return list(lu_solve(a, b))[:TERMS]


grid = [(1 - cos(pi * i / (40 * TERMS))) / 2 for i in range(40 * TERMS + 1)]
nodes = [(1 - cos(pi * i / TERMS)) / 2 for i in range(TERMS + 1)]
for _ in range(8):
    c = solve(nodes)
    peaks = []  # the largest of every run of one sign
    for u in grid:
        e = error(c, u)
        if peaks and peaks[-1][1] * e > 0:
            peaks[-1] = max(peaks[-1], (u, e), key=lambda peak: abs(peak[1]))
        else:
            peaks.append((u, e))
    assert len(peaks) == TERMS + 1, len(peaks)
    nodes = [u for u, _ in peaks]
rounded = [float(k) for k in c]
print(*rounded, sep="\n")
print("error", nstr(max(abs(error([mpf(k) for k in rounded], u)) for u in grid), 3))
