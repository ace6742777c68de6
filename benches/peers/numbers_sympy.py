"""SymPy, exact: dense arrays of rationals."""
import sys
from sympy import S
from sympy.tensor.array import (ImmutableDenseNDimArray, MutableDenseNDimArray, permutedims,
                                tensorcontraction, tensorproduct)
from peer import both_orders, constants, measure, report, values

n, c = constants(sys.argv[1])


def array():
    dense = MutableDenseNDimArray.zeros(n, n, n)
    for at, v in both_orders(c).items():
        dense[at] = v
    return ImmutableDenseNDimArray(dense)


def curvature(c):
    affinities = MutableDenseNDimArray.zeros(n, n, n)
    for i in range(n):
        for j in range(n):
            for k in range(n):
                v = (i + 1) * c[i, j, k] - (j + 1) * c[j, k, i] + (k + 1) * c[k, i, j]
                affinities[i, j, k] = v / S(2 * (i + 1))
    affinities = ImmutableDenseNDimArray(affinities)
    twice = tensorcontraction(tensorproduct(affinities, affinities), (2, 3))  # i k l j
    bracket = tensorcontraction(tensorproduct(c, affinities), (0, 4))  # k l i j
    return permutedims(twice, (0, 3, 1, 2)) - permutedims(twice, (0, 3, 2, 1)) - permutedims(bracket, (2, 3, 0, 1))


seconds, r = measure(array, curvature)
found = [((i, j, k, l), r[i, j, k, l])
         for i in range(n) for j in range(n) for k in range(n) for l in range(k + 1, n) if r[i, j, k, l] != 0]
report("curvature", seconds, len(found))
values(sys.argv[2], "curvature", found)
