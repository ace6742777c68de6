"""Geodesics on charts: errors and times of affinor beside SciPy's DOP853 on the same equations.

    python3 benches/peers/geodesics.py --affinor target/release/affinor > geodesics.md

Needs numpy, scipy, sympy, mpmath, and gmpy2 for speed. The right side of SciPy is compiled by `sympy.lambdify` with common subexpressions, from the
affinities that SymPy computes. References are extrapolated midpoint steps in 34 digits, and need half a minute for each problem (with gmpy2).

- Error: the largest difference of the position at the end, relative to max(1, |x|).
- Time: CPU seconds. Of SciPy, `solve_ivp` alone, the mean of runs that fill a second; of affinor, the whole process less the same
  process with an end near the beginning, and the whole process; the median of five runs.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import tempfile
import time

import mpmath
import numpy
import scipy
import sympy
from scipy.integrate import solve_ivp

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("--affinor", required=True)
options = arguments.parse_args()

KERR = "(r^2 + a^2*cos(h)^2)"
PROBLEMS = {  # coordinates, parameters, metric, position, velocity, end
    "orbit of Schwarzschild": ("t,r,h,p", {"m": 1.0}, [
        ["2*m/r - 1", "0", "0", "0"], ["0", "1/(1 - 2*m/r)", "0", "0"], ["0", "0", "r^2", "0"], ["0", "0", "0", "r^2*sin(h)^2"]],
        [0, 10, 1.5, 0], [1.2, 0, 0.01, 0.038], 1000),
    "orbit of Kerr": ("t,r,h,p", {"m": 1.0, "a": 0.9}, [
        [f"2*m*r/{KERR} - 1", "0", "0", f"-2*m*a*r*sin(h)^2/{KERR}"], ["0", f"{KERR}/(r^2 - 2*m*r + a^2)", "0", "0"], ["0", "0", KERR, "0"],
        [f"-2*m*a*r*sin(h)^2/{KERR}", "0", "0", f"(r^2 + a^2 + 2*m*a^2*r*sin(h)^2/{KERR})*sin(h)^2"]],
        [0, 8, 1.2, 0], [1.3, 0, 0.02, 0.045], 500),
    "torus": ("u,v", {"a": 2.0, "b": 1.0}, [["b^2", "0"], ["0", "(a + b*cos(u))^2"]], [0, 0], [0.9, 0.2], 100),
    "ellipsoid": ("u,v", {"a": 1.0, "b": 1.5, "c": 2.0}, [
        ["(a^2*cos(v)^2 + b^2*sin(v)^2)*cos(u)^2 + c^2*sin(u)^2", "(a^2 - b^2)*sin(u)*cos(u)*sin(v)*cos(v)"],
        ["(a^2 - b^2)*sin(u)*cos(u)*sin(v)*cos(v)", "(a^2*sin(v)^2 + b^2*cos(v)^2)*sin(u)^2"]], [1.2, 0.3], [0.3, 0.4], 50),
}
TOLERANCES = [1e-5, 1e-7, 1e-9, 1e-11, 1e-13]


def equations(coordinates, metric):
    """`-Gamma^i_jk v^j v^k` by SymPy, and the symbols."""
    x = sympy.symbols(coordinates)
    v = sympy.symbols([f"v_{name}" for name in coordinates.split(",")])
    letters = {str(name): name for name in x}
    g = sympy.Matrix([[sympy.sympify(text.replace("^", "**"), locals=letters) for text in row] for row in metric])
    inverse, n = sympy.simplify(g.inv()), len(x)
    lowered = [sum((g[i, j].diff(x[k]) - g[j, k].diff(x[i]) / 2) * v[j] * v[k] for j in range(n) for k in range(n)) for i in range(n)]
    return x, v, [-sum(inverse[i, k] * lowered[k] for k in range(n)) for i in range(n)]


def reference(symbols, forces, values, start, end):
    """The position at the end, in 34 digits: extrapolated midpoint steps (Gragg, Bulirsch, Stoer)."""
    mpmath.mp.dps = 34
    exact = {name: sympy.Rational(str(value)) for name, value in values.items()}
    call = sympy.lambdify(symbols, [force.subs(exact) for force in forces], "mpmath", cse=True)
    n = len(start) // 2
    right = lambda y: [*y[n:], *call(*y)]
    columns = range(2, 26, 2)
    plus = lambda y, h, f: [a + h * b for a, b in zip(y, f)]

    def step(y, size):
        table, first = [], right(y)
        for row, count in enumerate(columns):
            h = size / count
            old, new = y, plus(y, h, first)
            for _ in range(count - 1):
                old, new = new, plus(old, 2 * h, right(new))
            estimate = [(a + b + h * c) / 2 for a, b, c in zip(old, new, right(new))]
            line = [estimate]
            for back in range(row):
                ratio = (mpmath.mpf(count) / columns[row - 1 - back]) ** 2 - 1
                line.append([a + (a - b) / ratio for a, b in zip(line[back], table[row - 1][back])])
            table.append(line)
        error = max(abs(a - b) / max(1, abs(a)) for a, b in zip(table[-1][-1], table[-2][-1]))
        return table[-1][-1], error

    y, t, end = [mpmath.mpf(str(value)) for value in start], mpmath.mpf(0), mpmath.mpf(end)
    size = end / 100
    while t < end:
        size = min(size, end - t)
        found, error = step(y, size)
        if error < mpmath.mpf("1e-22"):
            y, t = found, t + size
        size *= min(2, max(mpmath.mpf("0.3"), (mpmath.mpf("1e-24") / (error + mpmath.mpf("1e-60"))) ** (mpmath.mpf(1) / 23)))
    return [float(value) for value in y[:n]]


def cpu(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise SystemExit(done.stderr)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def affinor(problem, end, tolerance, folder):
    coordinates, parameters, metric, position, velocity, _ = problem
    names = coordinates.split(",")
    listed = lambda values: "{ " + ", ".join(f"{name} = {value}" for name, value in zip(names, values)) + " }"
    path = os.path.join(folder, "problem.toml")
    with open(path, "w") as file:
        file.write(f"[definition]\nparameters = {json.dumps(list(parameters))}\nchart = {{ coordinates = {json.dumps(names)} }}\n"
                   f"metric = {{ components = {json.dumps(metric)} }}\n[parameters]\n"
                   + "".join(f"{name} = {value}\n" for name, value in parameters.items())
                   + f"[initial]\nposition = {listed(position)}\nvelocity = {listed(velocity)}\n"
                   f"[integrator]\ntolerance = {tolerance}\n[output]\nend = {end}\nevery = {end}\ncolumns = {json.dumps(names)}\n")
    runs = [cpu([options.affinor, "simulate", path]) for _ in range(5)]
    last = runs[0][1].strip().splitlines()[-1]
    return statistics.median(run[0] for run in runs), [float(value) for value in last.split(",")]


def dop853(call, values, start, end, tolerance):
    n = len(start) // 2
    right = lambda _, y: numpy.concatenate([y[n:], call(*y, *values)])
    spent = runs = 0
    while spent < 1:
        began = time.process_time()
        found = solve_ivp(right, (0, end), start, "DOP853", rtol=tolerance, atol=tolerance)
        spent, runs = spent + time.process_time() - began, runs + 1
    return spent / runs, found.y[:n, -1]


def error(found, expected):
    return max(abs(a - b) / max(1, abs(b)) for a, b in zip(found, expected))


def milliseconds(seconds):
    return f"{1000 * seconds:.3g}"


print(f"SciPy {scipy.__version__}, {subprocess.run([options.affinor, '--version'], capture_output=True, text=True).stdout.strip()}\n")
print("| geodesic | tolerance | affinor: error | steps, ms | process, ms | DOP853: error | ms |\n| --- | --- | ---: | ---: | ---: | ---: | ---: |")
with tempfile.TemporaryDirectory() as folder:
    for name, problem in PROBLEMS.items():
        coordinates, parameters, metric, position, velocity, end = problem
        x, v, forces = equations(coordinates, metric)
        start = [*map(float, position), *map(float, velocity)]
        exact = reference([*x, *v], forces, parameters, [*position, *velocity], end)
        letters = sympy.symbols(list(parameters))
        call = sympy.lambdify([*x, *v, *letters], forces, "math", cse=True)
        idle, _ = affinor(problem, end * 1e-6, 1e-6, folder)
        for tolerance in TOLERANCES:
            whole, ours = affinor(problem, end, tolerance, folder)
            theirs_time, theirs = dop853(call, parameters.values(), start, end, tolerance)
            steps = milliseconds(whole - idle) if whole > 1.2 * idle else f"< {milliseconds(0.2 * idle)}"
            print(f"| {name} | {tolerance:.0e} | {error(ours, exact):.1e} | {steps} | {milliseconds(whole)} | {error(theirs, exact):.1e} "
                  f"| {milliseconds(theirs_time)} |", flush=True)
