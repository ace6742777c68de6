"""The free rigid body in 50 digits, by Taylor series of the equations: no elliptic function.

    python3 tests/references/free_body.py > tests/data/free_body.txt

H' = H x J^-1 H and q' = q (0, J^-1 H)/2 by the recurrences of their Taylor coefficients, order 50, steps of 0.15 over the
largest |Omega|, in fixed point of 190 bits; the error is below 1e-40. Inputs are exact doubles, written so that they read back;
outputs have 25 digits. A line is a name and numbers:

    name J[9] q0[4] H0[3] t q[4] H[3]          q = (w, x, y, z) takes body to space components
"""
import random
from fractions import Fraction
from math import cos, sin, sqrt

BITS, ORDER = 190, 50
ONE = 1 << BITS
random.seed(20080207)

def fixed(x): return int(Fraction(x) * ONE)
def mul(a, b): return (a * b) >> BITS
def root(x):
    return sqrt(float(x))

def inverse(J):
    J = [[Fraction(x) for x in row] for row in J]
    c = [[J[(i+1) % 3][(j+1) % 3]*J[(i+2) % 3][(j+2) % 3] - J[(i+1) % 3][(j+2) % 3]*J[(i+2) % 3][(j+1) % 3] for j in range(3)] for i in range(3)]
    det = sum(J[0][j]*c[0][j] for j in range(3))
    return [[c[j][i]/det for j in range(3)] for i in range(3)]

def taylor(inv, q, H, h):
    """One step of length h, all in fixed point."""
    Hs, qs, ws = [H], [q], []
    for n in range(ORDER):
        ws.append([sum(inv[i][j]*Hs[n][j] for j in range(3)) >> BITS for i in range(3)])
        rate = [0]*3; turn = [0]*4
        for m in range(n + 1):
            a, w, (s, x, y, z) = Hs[n-m], ws[m], qs[n-m]
            rate[0] += a[1]*w[2] - a[2]*w[1]
            rate[1] += a[2]*w[0] - a[0]*w[2]
            rate[2] += a[0]*w[1] - a[1]*w[0]
            turn[0] -= x*w[0] + y*w[1] + z*w[2]
            turn[1] += s*w[0] + y*w[2] - z*w[1]
            turn[2] += s*w[1] + z*w[0] - x*w[2]
            turn[3] += s*w[2] + x*w[1] - y*w[0]
        Hs.append([(r >> BITS)//(n + 1) for r in rate])
        qs.append([(r >> BITS)//(2*(n + 1)) for r in turn])
    def value(series):
        v = [0]*len(series[0])
        for c in reversed(series):
            v = [mul(v[i], h) + c[i] for i in range(len(c))]
        return v
    return value(qs), value(Hs)

def written(x):
    """25 digits."""
    sign, x = ("-", -x) if x < 0 else ("", x)
    digits = (x*10**25 + ONE//2) >> BITS
    return f"{sign}{digits//10**25}.{digits % 10**25:025d}"

def run(name, J, H0, times, q0=(1.0, 0.0, 0.0, 0.0)):
    if len(J) == 3 and not hasattr(J[0], "__len__"):
        J = [[J[i] if i == j else 0.0 for j in range(3)] for i in range(3)]
    exact = inverse(J)
    inv = [[fixed(x) for x in row] for row in exact]
    energy = sum(Fraction(H0[i])*exact[i][j]*Fraction(H0[j]) for i in range(3) for j in range(3))
    largest = root(energy * max(sum(abs(x) for x in row) for row in exact)) # |Omega|^2 <= 2E/J_min
    for sign in (1, -1):
        q, H, t = [fixed(x) for x in q0], [fixed(x) for x in H0], Fraction(0)
        for end in sorted((t for t in times if t*sign > 0), key=abs):
            length = Fraction(end) - t
            count = int(abs(length)*Fraction(largest)/Fraction(15, 100)) + 1
            for _ in range(count):
                q, H = taylor(inv, q, H, fixed(length/count))
            t = Fraction(end)
            numbers = [x for row in J for x in row] + list(q0) + list(H0) + [float(end)]
            print(name, *[repr(float(x)) for x in numbers], *[written(x) for x in q + H])

def dense(moments):
    """A double matrix near moments in other axes, exactly symmetric."""
    w, x, y, z = [random.gauss(0, 1) for _ in range(4)]
    n = w*w + x*x + y*y + z*z
    R = [[(w*w+x*x-y*y-z*z)/n, 2*(x*y-w*z)/n, 2*(x*z+w*y)/n], [2*(x*y+w*z)/n, (w*w-x*x+y*y-z*z)/n, 2*(y*z-w*x)/n],
         [2*(x*z-w*y)/n, 2*(y*z+w*x)/n, (w*w-x*x-y*y+z*z)/n]]
    J = [[sum(R[i][k]*moments[k]*R[j][k] for k in range(3)) for j in range(3)] for i in range(3)]
    return [[J[min(i, j)][max(i, j)] for j in range(3)] for i in range(3)]

def vector(): return tuple(random.gauss(0, 1) for _ in range(3))
UNIT = (0.5, -0.5, 0.5, 0.5)

run("hairer-vilmart", (.6, .8, 1.0), (1.8, .4, -.9), [1, 5, 10, 50, 100, -1, -20])
run("dzhanibekov", (3.0, 5.0, 9.0), (0.0, 2.0, .01), [10, 30, 60, 120, -50])
run("dzhanibekov-long", (1.0, 2.0, 3.0), (0.0, 2.0, 1e-6), [10, 30, 60])
run("hairer-lubich-wanner", (2.0, 1.0, 2/3), (cos(1.1), 0.0, sin(1.1)), [1, 10, 40])
run("small-axis", (1.0, 2.0, 3.0), (3.0, .5, 1/3), [1, 5, 20, -3])
run("separatrix", (1.0, 2.0, 3.0), (1.0, 0.0, sqrt(3)), [1, 3, 6, -2, -6])
run("two-small-equal", (1.0, 1.0, 2.0), (.5, -.7, .3), [1, 10], UNIT)
run("two-large-equal", (1.0, 2.0, 2.0), (.5, -.7, .3), [1, 10], UNIT)
run("all-equal", (1.5, 1.5, 1.5), (.5, -.7, .3), [1, 10], UNIT)
for gap in (1e-12, 1e-8, 1e-4):
    run("nearly-small-equal", (1.0, 1 + gap, 2.0), (.5, -.7, .3), [1, 10])
    run("nearly-large-equal", (1.0, 2.0, 2 + gap), (.5, -.7, .3), [1, 10])
    run("nearly-large-equal-plane", (1.0, 2.0, 2 + gap), (1e-7, -.7, .3), [1, 10])
    run("nearly-small-equal-plane", (1.0, 1 + gap, 2.0), (.5, -.7, 1e-7), [1, 10])
    run("nearly-all-equal", (1.0, 1 + gap, 1 + 3*gap), (.5, -.7, .3), [1, 10])
    run("near-largest-axis", (1.0, 2.0, 3.0), (gap, -gap, -1.0), [1, 10])
    run("near-smallest-axis", (1.0, 2.0, 3.0), (-1.0, gap, 2*gap), [1, 10])
    run("near-middle-axis", (1.0, 2.0, 3.0), (gap, -1.0, gap/3), [1, 10])
    run("near-separatrix", (1.0, 2.0, 3.0), (-1.0, 0.1, -sqrt(3)*(1 + gap)), [1, 10])
run("needle", (1e-3, 1.0, 1.0001), (1e-3, .5, -.5), [1, 10])
for order in ((1., 2., 3.), (1., 3., 2.), (2., 1., 3.), (2., 3., 1.), (3., 1., 2.), (3., 2., 1.)):
    run("orders", order, vector(), [2, -7], UNIT)
for _ in range(8):
    moments = [1 + random.random()*3 for _ in range(3)]
    run("dense", dense(moments), vector(), [1, 10, -5], UNIT)
