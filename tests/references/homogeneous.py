"""Geodesics and parallel vectors of invariant metrics on SU(3)/T and SO(5)/SO(3), as references of tests.

The matrices, the metric and the equations are written here, without affinor. The geodesic is the
Euler-Arnold equation of matrices, g' = g v and mu' = [mu, v], where mu is the metric times v for the
trace form; the parallel vector solves u' = -Lambda(v) u with the formula of Koszul. Power series in
time with 40 digits give the values; DOP853 of SciPy integrates the same matrices and checks them.

Run with mpmath, numpy and scipy:  python tests/references/homogeneous.py
"""

import mpmath as mp
import numpy as np
from scipy.integrate import solve_ivp

mp.mp.dps = 40


def unit(n, i, j, value):
    m = mp.zeros(n, n)
    m[i, j] = value
    return m


def su3():
    """The pairs (1,2), (1,3), (2,3): -i/2 (E_ij + E_ji) and -1/2 (E_ij - E_ji); then the diagonal."""
    half = mp.mpf(1) / 2
    vectors = []
    for i, j in [(0, 1), (0, 2), (1, 2)]:
        vectors.append(unit(3, i, j, -1j * half) + unit(3, j, i, -1j * half))
        vectors.append(unit(3, i, j, -half) + unit(3, j, i, half))
    for k in (0, 1):
        vectors.append(unit(3, k, k, -1j * half) + unit(3, k + 1, k + 1, 1j * half))
    return vectors, list(range(6))


def so5():
    """(-1)^(i+j) (E_ij - E_ji) for i < j, the last pair first; SO(3) rotates the first three."""
    vectors, m = [], []
    pairs = [(i, j) for i in range(5) for j in range(i + 1, 5)][::-1]
    for at, (i, j) in enumerate(pairs):
        sign = mp.mpf((-1) ** (i + j))
        vectors.append(unit(5, i, j, sign) + unit(5, j, i, -sign))
        if j > 2:
            m.append(at)
    return vectors, m


def trace_form(x, y):
    n = x.rows
    return -mp.re(sum(x[i, j] * y[j, i] for i in range(n) for j in range(n)))


def coordinates(x, vectors):
    n = len(vectors)
    gram = mp.matrix(n, n)
    for a in range(n):
        for b in range(n):
            gram[a, b] = trace_form(vectors[a], vectors[b])
    return mp.lu_solve(gram, mp.matrix([trace_form(v, x) for v in vectors]))


def run(name, space, weights, velocity, vector, time):
    vectors, m = space()
    n, size = len(m), vectors[0].rows
    basis = [vectors[a] for a in m]
    length = [trace_form(x, x) for x in basis]
    c = {}
    for j in range(n):
        for k in range(n):
            x = coordinates(basis[j] * basis[k] - basis[k] * basis[j], vectors)
            for i in range(n):
                if abs(x[m[i]]) > mp.mpf(10) ** -30:
                    c[i, j, k] = x[m[i]]
    # Koszul: 2 <Lambda(x) y, z> = <[x,y], z> + <[z,x], y> + <x, [z,y]> on m
    lam = {}
    for i in range(n):
        for j in range(n):
            for k in range(n):
                value = (
                    c.get((i, j, k), 0) * weights[i]
                    + c.get((k, i, j), 0) * weights[k]
                    + c.get((j, i, k), 0) * weights[j]
                ) / (2 * weights[i])
                if value:
                    lam[i, j, k] = value

    def momentum(v):
        """The matrix mu with trace_form(mu, x) = metric(v, x)."""
        total = mp.zeros(size, size)
        for a in range(n):
            total += basis[a] * (weights[a] * v[a] / length[a])
        return total

    def along(mu):
        return [trace_form(mu, basis[a]) / weights[a] for a in range(n)]

    def combine(v):
        total = mp.zeros(size, size)
        for a in range(n):
            total += basis[a] * v[a]
        return total

    mu, g = momentum(velocity), mp.eye(size)
    u = list(vector)
    steps, degree = 8 * int(time), 30
    h = mp.mpf(time) / steps
    for _ in range(steps):
        mus, gs, vs, us, ws = [mu], [g], [], [u], []
        for k in range(degree):
            ws.append(along(mus[k]))
            vs.append(combine(ws[k]))
            dmu, dg, du = mp.zeros(size, size), mp.zeros(size, size), [mp.mpf(0)] * n
            for j in range(k + 1):
                dmu += mus[j] * vs[k - j] - vs[k - j] * mus[j]
                dg += gs[j] * vs[k - j]
                for (i, a, b), value in lam.items():
                    du[i] -= value * ws[k - j][a] * us[j][b]
            mus.append(dmu / (k + 1))
            gs.append(dg / (k + 1))
            us.append([x / (k + 1) for x in du])
        total = lambda terms: sum((t * h**k for k, t in enumerate(terms[1:], 1)), terms[0])
        mu, g = total(mus), total(gs)
        u = [total([term[i] for term in us]) for i in range(n)]
    v = along(mu)
    print(name)
    print("  v ", [mp.nstr(mp.re(x), 25) for x in v])
    print("  u ", [mp.nstr(mp.re(x), 25) for x in u])
    print("  re g", [mp.nstr(mp.re(g[i, j]), 25) for i in range(size) for j in range(size)])
    print("  im g", [mp.nstr(mp.im(g[i, j]), 25) for i in range(size) for j in range(size)])

    dense = [np.array(x.tolist(), dtype=complex) for x in basis]
    scale = [float(w / l) for w, l in zip(weights, length)]

    def slope(_, y):
        g = (y[: size**2] + 1j * y[size**2 : 2 * size**2]).reshape(size, size)
        mu = (y[2 * size**2 : 3 * size**2] + 1j * y[3 * size**2 :]).reshape(size, size)
        v = sum(-np.trace(mu @ x).real / float(w) * x for x, w in zip(dense, weights))
        dg, dmu = g @ v, mu @ v - v @ mu
        return np.concatenate([p.ravel() for p in (dg.real, dg.imag, dmu.real, dmu.imag)])

    start = sum(s * float(a) * x for s, a, x in zip(scale, velocity, dense))
    y = np.concatenate(
        [p.ravel() for p in (np.eye(size), np.zeros((size, size)), start.real, start.imag)]
    )
    end = solve_ivp(slope, (0, time), y, method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    found = end[: size**2] + 1j * end[size**2 : 2 * size**2]
    exact = np.array([complex(g[i, j]) for i in range(size) for j in range(size)])
    print("  DOP853 differs by", abs(found - exact).max())


q = lambda *values: [mp.mpf(value) / 10 for value in values]
run("SU(3)/T, diag(1,1,2,2,4,4)", su3, [1, 1, 2, 2, 4, 4], q(3, -5, 7, 2, 4, -1), q(1, 2, -3, 0, 5, 4), 3)
run(
    "SO(5)/SO(3), diag(3/2,1,3,1,3,1,3)",
    so5,
    [mp.mpf(3) / 2, 1, 3, 1, 3, 1, 3],
    q(4, -3, 5, 2, 6, -1, 3),
    q(-2, 1, 0, 3, 4, -5, 6),
    3,
)
