"""Tensors of a chart at many points: affinor beside functions of NumPy that SymPy makes of its expressions.

Each row has the time of affinor, and how many times as long NumPy takes; the best of several calls that take turns.
"""

import time

import numpy as np
import sympy as sp

import affinor as af

r, theta, M, a = sp.symbols("r theta M a")
COORDINATES = [sp.Symbol("t"), r, theta, sp.Symbol("phi")]


def kerr() -> sp.Matrix:
    sigma, delta, sine = r**2 + a**2 * sp.cos(theta) ** 2, r**2 - 2 * M * r + a**2, sp.sin(theta) ** 2
    g = sp.diag(-(1 - 2 * M * r / sigma), sigma / delta, sigma, sine * (r**2 + a**2 + 2 * M * r * a**2 * sine / sigma))
    g[0, 3] = g[3, 0] = -2 * M * a * r * sine / sigma
    return g


def affinities(g: sp.Matrix) -> list[sp.Expr]:
    n, inverse = len(COORDINATES), g.inv()
    rates = [g.diff(c) for c in COORDINATES]

    def component(i: int, j: int, k: int) -> sp.Expr:
        terms = (inverse[i, m] * (rates[j][m, k] + rates[k][m, j] - rates[m][j, k]) for m in range(n))
        return sum(terms) / 2

    return [component(i, j, k) for i in range(n) for j in range(n) for k in range(n)]


def curvature(gamma: list[sp.Expr]) -> list[sp.Expr]:
    n = len(COORDINATES)
    at = lambda i, j, k: gamma[(i * n + j) * n + k]  # noqa: E731

    def component(i: int, j: int, k: int, l: int) -> sp.Expr:
        value = at(i, l, j).diff(COORDINATES[k]) - at(i, k, j).diff(COORDINATES[l])
        return value + sum(at(i, k, m) * at(m, l, j) - at(i, l, m) * at(m, k, j) for m in range(n))

    return [component(i, j, k, l) for i in range(n) for j in range(n) for k in range(n) for l in range(n)]


def best(calls: list, turns: int = 7) -> list[float]:
    times = [float("inf")] * len(calls)
    for _ in range(turns):
        for at, call in enumerate(calls):
            begin = time.perf_counter()
            call()
            times[at] = min(times[at], time.perf_counter() - begin)
    return times


def main() -> None:
    rng = np.random.default_rng(0)
    count = 100_000
    radii, angles = rng.uniform(3, 9, size=count), rng.uniform(0.1, 3, size=count)
    g = kerr()
    begin = time.perf_counter()
    geometry = af.Geometry.on_chart(COORDINATES, g)
    found = geometry.at({r: radii, theta: angles}, M=1, a=0.5)
    ours = {key: found.quantity(key) for key in ("affinities", "curvature")}
    print(f"affinor: formulas and first values in {time.perf_counter() - begin:.2f} s")
    begin = time.perf_counter()
    gamma = affinities(g)
    theirs = {"affinities": gamma, "curvature": curvature(gamma)}
    functions = {key: sp.lambdify([r, theta, M, a], values, "numpy", cse=True) for key, values in theirs.items()}
    print(f"SymPy: formulas and functions in {time.perf_counter() - begin:.2f} s")
    for key, function in functions.items():
        values = np.stack(np.broadcast_arrays(*function(radii, angles, 1.0, 0.5)), axis=-1).reshape(ours[key].shape)
        scale = np.abs(values).max()
        assert np.abs(values - ours[key]).max() < 1e-10 * scale
        # without the array of all components, which NumPy's functions do not make
        one, other = best([lambda: found.quantity(key), lambda: function(radii, angles, 1.0, 0.5)])  # noqa: B023
        print(f"{key} of Kerr at {count} points: {1e3 * one:.1f} ms, NumPy {other / one:.1f} x")


if __name__ == "__main__":
    main()
