"""A satellite in orbit with the gravity gradient, for tests/data/orbit.json.

    python3 tests/references/orbit.py > tests/data/orbit.json

In SI units, with the potential of a point mass up to the second order in the size of the body (MacCullagh),

    V = -m mu/r - mu/(2 r^3) (tr J - 3 n.J n),   n = R^T x/r,

the body obeys J W' = J W x W + 3 mu/r^3 n x J n, R' = R spin(W), m x'' = -grad V. By extrapolation of the midpoint rule
(Gragg, Bulirsch, Stoer) in 50 digits, twice, with steps and orders of their own; both agree to 27 digits of each vector.
"""
import json
from mpmath import mp, mpf, sqrt

mp.dps = 50
MU, MASS, J = mpf("3.986004418e14"), mpf(1000), [mpf(10), mpf(12), mpf(15)]
PLACE, VELOCITY, SPIN = ["7e6", "0", "0"], ["0", "7600", "1000"], ["0.002", "-0.001", "0.0015"]
TIMES, AGREE, DIGITS = ["100", "6000", "12000"], mpf(10)**-27, 25
EVEN = [2*k for k in range(1, 40)]

def dot(a, b): return a[0]*b[0] + a[1]*b[1] + a[2]*b[2]
def cross(a, b): return [a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]]

def rate(s):
    r, x, w, v = s[:9], s[9:12], s[12:15], s[15:18]
    squared = dot(x, x)
    length = sqrt(squared)
    n = [(r[i]*x[0] + r[3 + i]*x[1] + r[6 + i]*x[2])/length for i in range(3)]
    jn, jw = [J[i]*n[i] for i in range(3)], [J[i]*w[i] for i in range(3)]
    pull = MU/(squared*length)
    torque, gyro = cross(n, jn), cross(jw, w)
    spin = [(gyro[i] + 3*pull*torque[i])/J[i] for i in range(3)]
    turned = [r[3*i]*jn[0] + r[3*i + 1]*jn[1] + r[3*i + 2]*jn[2] for i in range(3)]
    # the gradient of mu/(2 r^3) (tr J - 3 n.J n), with R J R^T x = r R J n
    small = 3*pull/(2*squared)*(sum(J) - 5*dot(n, jn))
    force = [-MASS*pull*x[i] - small*x[i] - 3*pull/length*turned[i] for i in range(3)]
    columns = [[r[3*i + 1]*w[2] - r[3*i + 2]*w[1], r[3*i + 2]*w[0] - r[3*i]*w[2], r[3*i]*w[1] - r[3*i + 1]*w[0]] for i in range(3)]
    return sum(columns, []) + v + spin + [f/MASS for f in force]

def midpoint(s, h, n):
    d = h/n
    before, now = s, [a + d*b for a, b in zip(s, rate(s))]
    for _ in range(n - 1):
        before, now = now, [a + 2*d*b for a, b in zip(before, rate(now))]
    last = rate(now)
    return [(a + b + d*c)/2 for a, b, c in zip(before, now, last)]

def step(s, h, order):
    rows = []
    for k in range(order):
        row = [midpoint(s, h, EVEN[k])]
        for j in range(k):
            ratio = (mpf(EVEN[k])/EVEN[k - j - 1])**2 - 1
            row.append([a + (a - b)/ratio for a, b in zip(row[j], rows[k - 1][j])])
        rows.append(row)
    return rows[-1][-1]

def states(h, order):
    one = [mpf(int(i == j)) for i in range(3) for j in range(3)]
    s, t, found = one + [mpf(x) for x in PLACE + SPIN + VELOCITY], mpf(0), []
    for end in map(mpf, TIMES):
        count = int(mp.ceil((end - t)/h))
        length = (end - t)/count
        for _ in range(count):
            s = step(s, length, order)
        t = end
        found.append(s)
    return found

def text(x): return mp.nstr(x, DIGITS, min_fixed=-3, max_fixed=12, strip_zeros=False)

first, second = states(mpf(100), 18), states(mpf(77), 17)
for a, b in zip(first, second):
    for part in (slice(0, 9), slice(9, 12), slice(12, 15), slice(15, 18)):
        size = max(abs(x) for x in a[part])
        off = max(abs(x - y) for x, y in zip(a[part], b[part]))/size
        assert off < AGREE, mp.nstr(off, 5)
rows = [{"time": t, "element": list(map(text, s[:9])), "position": list(map(text, s[9:12])),
         "spin": list(map(text, s[12:15])), "velocity": list(map(text, s[15:18]))} for t, s in zip(TIMES, first)]
print(json.dumps({"mu": text(MU), "mass": text(MASS), "moments": list(map(text, J)), "position": PLACE,
                  "velocity": VELOCITY, "spin": SPIN, "states": rows}, indent=1))
