"""Rotations in 60 digits: exp, log, T_left, T_left^-1, products, matrices.

    python3 tests/references/so3.py > tests/data/so3.txt        (mpmath 1.3)

Inputs are exact doubles, written so that they read back; outputs have 30 digits. A line is a name and numbers:

    exp x[3] q[4]             q = (w, x, y, z) = (cos |x|/2, sin(|x|/2) x/|x|)
    log q[4] x[3]             of q/|q|, with w >= 0
    left x[3] v[3] u[3]       u = T_left(x) v = sum (-ad_x)^k v/(k+1)!
    inverse x[3] v[3] u[3]    u = T_left(x)^-1 v
    product x[3] y[3] p[3]    exp p = exp x exp y, |p| <= pi
    matrix x[3] R[9]          R = exp(spin x), by rows

Closed forms in exact arithmetic of 400 digits where numbers are tiny: no series, no threshold.
"""
import random
from mpmath import mp, mpf, sqrt, sin, cos, atan2, pi, nstr, matrix

mp.dps = 1000  # 1 - cos at 1e-300 leaves 400 digits
random.seed(20130141)

ANGLES = ["0", "1e-300", "1e-160", "1e-20", "1e-8", "1e-4", "1e-2", "0.5", "1", "pi/2", "2.5", "pi-1e-3", "pi-1e-6",
          "pi-1e-9", "pi-1e-12", "pi-1e-15", "pi", "pi+1e-15", "pi+1e-3", "4", "5.5", "2*pi-1e-3", "2*pi-1e-9",
          "2*pi+1e-9", "2*pi+1e-3", "10", "4*pi+1e-6", "100", "1e4"]

def axes():
    yield from [(1, 0, 0), (0, -1, 0), (0, 0, 1), (1, 1, 1), (-1, 1e-9, 0)]
    for _ in range(4):
        yield tuple(random.gauss(0, 1) for _ in range(3))

def dot(a, b): return sum(p * q for p, q in zip(a, b))
def cross(a, b): return (a[1]*b[2]-a[2]*b[1], a[2]*b[0]-a[0]*b[2], a[0]*b[1]-a[1]*b[0])
def norm(a): return sqrt(dot(a, a))
def exact(a): return tuple(mpf(c) for c in a)

def vector(angle, axis):
    """The double nearest to each component."""
    with mp.workdps(40):
        t = mpf(eval(angle.replace("pi", "P").replace("1e-", "E**-"), {"P": +pi, "E": mpf(10)})) if "pi" in angle else mpf(angle)
        n = exact(axis)
        return tuple(float(t * c / norm(n)) for c in n)

def exp(x):
    t = norm(x)
    if t == 0: return (mpf(1), mpf(0), mpf(0), mpf(0))
    s = sin(t/2)/t
    return (cos(t/2), s*x[0], s*x[1], s*x[2])

def log(q):
    w, v = q[0], q[1:]
    if w < 0 or (w == 0 and next((c for c in v if c != 0), 1) < 0): w, v = -w, tuple(-c for c in v)
    s = norm(v)
    if s == 0: return (mpf(0),) * 3
    f = 2*atan2(s, w)/s
    return tuple(f*c for c in v)

def mul(p, q):
    a, u, b, v = p[0], p[1:], q[0], q[1:]
    w = cross(u, v)
    return (a*b - dot(u, v),) + tuple(a*v[i] + b*u[i] + w[i] for i in range(3))

def left(x, v):
    t = norm(x)
    if t == 0: return v
    a, b = (1-cos(t))/t**2, (t-sin(t))/t**3
    xv = cross(x, v); xxv = cross(x, xv)
    return tuple(v[i] - a*xv[i] + b*xxv[i] for i in range(3))

def inverse(x, v):
    t = norm(x)
    if t == 0: return v
    d = (1 - t/2*cos(t/2)/sin(t/2))/t**2
    xv = cross(x, v); xxv = cross(x, xv)
    return tuple(v[i] + xv[i]/2 + d*xxv[i] for i in range(3))

def rotation(x):
    t = norm(x)
    e = [exact(r) for r in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    if t == 0: return [c for r in e for c in r]
    a, b = sin(t)/t, (1-cos(t))/t**2
    columns = []
    for v in e:
        xv = cross(x, v); xxv = cross(x, xv)
        columns.append(tuple(v[i] + a*xv[i] + b*xxv[i] for i in range(3)))
    return [columns[j][i] for i in range(3) for j in range(3)]

def line(name, inputs, outputs):
    print(name, *[repr(float(c)) for c in inputs], *[nstr(c, 30, min_fixed=0, max_fixed=0) if c else "0" for c in outputs])

for angle in ANGLES:
    if angle == "0":
        points = [(0.0, 0.0, 0.0)]
    else:
        points = [vector(angle, n) for n in axes()]
    for x in points:
        X = exact(x)
        line("exp", x, exp(X))
        line("matrix", x, rotation(X))
        q = tuple(float(c) for c in exp(X))
        line("log", q, log(exact(q)))
        vs = [tuple(random.gauss(0, 1) for _ in range(3)), tuple(float(c) for c in (1, 0, 0))]
        for v in vs:
            line("left", x + v, left(X, exact(v)))
            line("inverse", x + v, inverse(X, exact(v)))
        size = random.choice(["1e-300", "1e-8", "0.3", "1", "2", "3"])
        y = vector(size, tuple(random.gauss(0, 1) for _ in range(3)))
        line("product", x + y, log(mul(exp(X), exp(exact(y)))))
    # turned back almost: x exp(-x + dx)
    x = points[-1]
    y = tuple(-c*(1 + 1e-7*random.gauss(0, 1)) for c in x)
    line("product", x + y, log(mul(exp(exact(x)), exp(exact(y)))))
