"""Coupling coefficients of spins by SymPy 1.14 (sympy.physics.wigner) and e3nn 0.6 (o3.wigner_3j).

    python3 tests/references/coupling.py > tests/data/representations/coupling.txt

The stored values of e3nn come from its file `o3/_wigner.py` with NumPy in place of PyTorch, in double precision.

A line is a name, arguments, and a value:

    cg j1 m1 j2 m2 j m = square     the square of <j1 m1 j2 m2 | j m>, with the sign of the coefficient
    3j j1 m1 j2 m2 j3 m3 = square   the 3j symbol in the same form
    6j j1 j2 j3 j4 j5 j6 = square   the 6j symbol in the same form
    real l1 l2 l3 = value           sum of w(m1) w(m2 + 1) w(m3 + 2) C[m1, m2, m3] with w(m) = (7 m^2 + 3 m) mod 11 - 5
"""
import random
from sympy import Rational, sign
from sympy.physics.wigner import clebsch_gordan, wigner_3j, wigner_6j
from e3nn.o3 import wigner_3j as real_tensor
import torch

random.seed(5)

def spin(limit):
    return Rational(random.randrange(0, 2 * limit + 1), 2)

def projection(j):
    return random.randrange(0, int(2 * j) + 1) - j

def line(name, arguments, value):
    print(name, *arguments, "=", sign(value) * value**2)

for name, function in (("cg", clebsch_gordan), ("3j", wigner_3j)):
    count = 0
    while count < 150:
        limit = 4 if count < 100 else 12
        j1, j2 = spin(limit), spin(limit)
        j3 = abs(j1 - j2) + random.randrange(0, int(2 * min(j1, j2)) + 1)
        m1, m2 = projection(j1), projection(j2)
        m3 = m1 + m2 if name == "cg" else -m1 - m2
        if abs(m3) > j3:
            continue
        line(name, (j1, m1, j2, m2, j3, m3), function(j1, j2, j3, m1, m2, m3))
        count += 1
count = 0
while count < 150:
    limit = 4 if count < 100 else 12
    j = [spin(limit) for _ in range(6)]
    triples = [(j[0], j[1], j[2]), (j[0], j[4], j[5]), (j[3], j[1], j[5]), (j[3], j[4], j[2])]
    if all((a + b + c).is_integer and abs(a - b) <= c <= a + b for a, b, c in triples):
        line("6j", j, wigner_6j(*j))
        count += 1

def weights(l, shift):
    return torch.tensor([float((7 * (m + shift)**2 + 3 * (m + shift)) % 11 - 5) for m in range(-l, l + 1)], dtype=torch.float64)

for l1 in range(11):
    for l2 in range(11):
        for l3 in range(abs(l1 - l2), min(l1 + l2, 10) + 1):
            tensor = real_tensor(l1, l2, l3, dtype=torch.float64)
            value = torch.einsum("ijk,i,j,k->", tensor, weights(l1, 0), weights(l2, 1), weights(l3, 2))
            print("real", l1, l2, l3, "=", repr(float(value)))
