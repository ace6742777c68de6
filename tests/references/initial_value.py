"""Initial value problems y' = f(y) in numbers of gmpy2 (MPFR), for the references beside this file.

The precision is that of the context of gmpy2, here 140 bits.

`extrapolated` is Gragg's extrapolated midpoint rule of order 28, for problems that are not stiff. `collocated` is collocation at the nodes
of Gauss (order 2s) or Radau IIA (order 2s - 1). Its Newton iteration solves with a matrix in double precision and takes residuals in
full precision, so that an iteration gains about ten digits.
"""
import gmpy2
import mpmath as mp
import numpy as np
from gmpy2 import mpfr

gmpy2.get_context().precision = 140
DIGITS = 42


def extrapolated(f, y, end, steps, columns=14):
    """The state at `end`, from 0, by equal steps."""
    h = mpfr(end) / steps
    sequence = [2 * (k + 1) for k in range(columns)]
    for _ in range(steps):
        table = []
        first = f(y)
        for k, n in enumerate(sequence):
            s = h / n
            before, now = y, [a + s * b for a, b in zip(y, first)]
            for _ in range(n - 1):
                before, now = now, [a + 2 * s * b for a, b in zip(before, f(now))]
            last = [(a + b + s * c) / 2 for a, b, c in zip(before, now, f(now))]
            row = [last]
            for j in range(k):
                ratio = (mpfr(n) / sequence[k - 1 - j]) ** 2 - 1
                row.append([a + (a - b) / ratio for a, b in zip(row[j], table[k - 1][j])])
            table.append(row)
        y = table[-1][-1]
    return y


def nodes(stages, kind):
    """The zeros in [0, 1] of the shifted Legendre polynomial P_s (Gauss), or of P_s - P_(s-1) (Radau IIA)."""
    with mp.workdps(4 * DIGITS):
        legendre = lambda n: [(-1) ** (n + k) * mp.binomial(n, k) * mp.binomial(n + k, k) for k in range(n + 1)]
        up = legendre(stages)
        if kind == "radau":
            up = [a - b for a, b in zip(up, legendre(stages - 1) + [0])]
        return sorted(mp.re(x) for x in mp.polyroots(up[::-1], maxsteps=500, extraprec=2000))


def tableau(stages, kind):
    """The matrix A and the weights b of collocation."""
    with mp.workdps(4 * DIGITS):
        c = nodes(stages, kind)
        powers = mp.matrix(stages, stages)
        for i in range(stages):
            for k in range(stages):
                powers[k, i] = c[i] ** k
        inverse = powers ** -1
        integral = lambda x: [mp.fsum(inverse[j, k] * x ** (k + 1) / (k + 1) for k in range(stages)) for j in range(stages)]
        number = lambda row: [mpfr(mp.nstr(x, DIGITS + 10)) for x in row]
        return [number(integral(x)) for x in c], number(integral(mp.mpf(1)))


def collocated(f, y, mesh, stages, kind):
    """The state at the last time of the mesh."""
    a, b = tableau(stages, kind)
    rough, n = np.array([[float(v) for v in row] for row in a]), len(y)
    slopes = None
    for start, end in zip(mesh, mesh[1:]):
        h = end - start
        base = f(y)
        jacobian = np.zeros((n, n))
        for j in range(n):
            small = mpfr(10) ** (-DIGITS // 2) * (1 + abs(y[j]))
            moved = f([v + small if i == j else v for i, v in enumerate(y)])
            jacobian[:, j] = [float((p - q) / small) for p, q in zip(moved, base)]
        solve = np.linalg.inv(np.eye(stages * n) - float(h) * np.kron(rough, jacobian))
        slopes = [base] * stages
        for _ in range(60):
            values = [[y[k] + h * gmpy2.fsum([a[i][j] * slopes[j][k] for j in range(stages)]) for k in range(n)] for i in range(stages)]
            residual = [p - q for i in range(stages) for p, q in zip(f(values[i]), slopes[i])]
            size = max(abs(r) for r in residual)
            if size == 0:
                break
            step = solve @ np.array([float(r / size) for r in residual])
            slopes = [[v + size * mpfr(step[i * n + k]) for k, v in enumerate(slopes[i])] for i in range(stages)]
            largest = max(abs(v) for row in slopes for v in row)
            if size * mpfr(np.abs(step).max()) < mpfr(10) ** (9 - DIGITS) * (1 + largest):
                break
        else:
            raise ArithmeticError(f"no convergence in the step from {float(start):.6g} to {float(end):.6g}")
        y = [y[k] + h * gmpy2.fsum([b[j] * slopes[j][k] for j in range(stages)]) for k in range(n)]
    return y
