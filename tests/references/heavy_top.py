"""The heavy top of Bruels, Cardona and Arnold (Mech. Mach. Theory 48, 2012, 121-137) in 30 digits, by Taylor series.

    python3 tests/references/heavy_top.py > tests/data/heavy_top.txt

Body of mass 15 with centre X = (0, 1, 0) from the fixed point, moments diag(.234375, .46875, .234375) about the centre, so
diag(15.234375, .46875, 15.234375) about the point; g = 9.81 along -z; R = 1, Omega = (0, 150, -4.61538) at the start. The
multipliers are those of -x + R X = 0: the force of the support, m (x'' + g e_z). A line is

    t x[3] R[9, rows] Omega[3] lambda[3]
"""
from fractions import Fraction
from taylor import BITS, ONE, fixed, states, written

m, g = 15, Fraction(9.81)
J = [Fraction(15.234375), Fraction(.46875), Fraction(15.234375)]
R = lambda i, j: 3*i + j
W, UNIT = [9, 10, 11], 12

terms = []
for i in range(3):
    for j in range(3):
        k, l = (j + 1) % 3, (j + 2) % 3
        # R' = R spin(Omega): the column j is R_k Omega_l - R_l Omega_k
        terms += [(R(i, j), R(i, k), W[l], 1), (R(i, j), R(i, l), W[k], -1)]
for i in range(3):
    k, l = (i + 1) % 3, (i + 2) % 3
    terms.append((W[i], W[k], W[l], (J[k] - J[l])/J[i]))
# X cross R^T(-m g e_z)
terms += [(W[0], R(2, 2), UNIT, -m*g/J[0]), (W[2], R(2, 0), UNIT, m*g/J[2])]

start = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 150.0, -4.61538, 1]
times = [0, 0.1, 0.2, 0.5, 1, 2]
mul = lambda a, b: (a*b) >> BITS
for t, s in zip(times, states(terms, start, times)):
    rate = [0]*13
    for i, j, k, c in terms: rate[i] += mul(fixed(c), mul(s[j], s[k]))
    w, dw = [s[i] for i in W], [rate[i] for i in W]
    # Omega' cross X + Omega cross (Omega cross X)
    a = [-dw[2] + mul(w[0], w[1]), -mul(w[0], w[0]) - mul(w[2], w[2]), dw[0] + mul(w[2], w[1])]
    force = [m*sum(mul(s[R(i, j)], a[j]) for j in range(3)) + (int(m*g*ONE) if i == 2 else 0) for i in range(3)]
    x = [s[R(i, 1)] for i in range(3)]
    if t == 2: # as published
        for value, known in zip(x, (-0.15041682274564, -0.72416559163690, -0.67302226956044)):
            assert abs(value/ONE - known) < 1e-13
    print(repr(float(t)), *[written(v) for v in x + s[:9] + w + force])
