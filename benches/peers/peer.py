"""Common code of the Python peers: reading constants, measuring, returning results.

A file of constants has a line `i j k value` for every nonzero c^i_jk, j < k, indices from 1.
"""
import time
from fractions import Fraction


def constants(path):
    """The dimension, and c[i, j, k] for j < k, indices from 0."""
    lines = open(path).read().split("\n")
    n = int(lines[0])
    rows = (line.split() for line in lines[1:] if line)
    return n, {(int(i) - 1, int(j) - 1, int(k) - 1): Fraction(v) if "/" in v else int(v) for i, j, k, v in rows}


def both_orders(c):
    return c | {(i, k, j): -v for (i, j, k), v in c.items()}


def measure(prepare, work):
    """CPU seconds (user and system) of `work`, the mean of runs that fill one second; the result."""
    spent = runs = 0
    while spent < 1 and runs < 100:
        prepared = prepare()
        start = time.process_time()
        result = work(prepared)
        spent += time.process_time() - start
        runs += 1
    return spent / runs, result


def report(tensor, seconds, count):
    print("RESULT", tensor, f"{seconds:.6g}", count, flush=True)


def values(path, tensor, components):
    """Appends `tensor i j .. value` for nonzero components, indices from 0 here and 1 there."""
    with open(path, "a") as file:
        for indices, value in components:
            file.write(" ".join([tensor, *(str(i + 1) for i in indices), "".join(str(value).split())]) + "\n")
