"""Extremals of left-invariant distributions, as references of tests.

SE(2): Jacobi's elliptic functions, as in Yu. Sachkov, ESAIM: COCV 16 (2010) 380-399; conjugate times are zeros of the
derivative of these closed forms, by differences in 50 digits. Nilpotent groups and aff(1) + R: extrapolation (Gragg, Bulirsch and
Stoer) of Hamilton's equations in coordinates. Coordinates of nilpotent groups are of the first kind; the left-invariant fields are
X_i = e_i + [x,e_i]/2 + [x,[x,e_i]]/12, which is exact up to step 4.

Run with mpmath:  python tests/references/sub_riemannian.py
"""

from mpmath import asin, cos, ellipe, ellipfun, ellipk, findroot, matrix, mp, mpf, nstr, pi, sin

mp.dps = 50
CHANGE = mpf(10) ** -8


def show(name, values):
    print(name, ", ".join(nstr(v, 25) for v in values))


# SE(2): X1 = rotation, X2 = translation along the first axis; h1' = -h2 h3, h2' = h1 h3, h3' = -h1 h2.
def functions(t, k):
    return [ellipfun(name, t, m=k * k) for name in ("sn", "cn", "dn")]


def amplitude(t, k):
    """am(t), continuous in t."""
    quarter = ellipk(k * k)
    turns = mp.nint(t / (2 * quarter))
    sn, cn, _ = functions(t - 2 * turns * quarter, k)
    return turns * pi + asin(sn)


def oscillating(t, k):
    """h = (dn, -k sn, -k cn); the angle, x and y from the phase 0."""
    sn, cn, dn = functions(t, k)
    return amplitude(t, k), (dn - 1) / k, -(t - ellipe(amplitude(t, k), k * k)) / k, [dn, -k * sn, -k * cn]


def rotating(t, k):
    """h = (cn, -sn, -dn/k) at t/k."""
    sn, cn, dn = functions(t / k, k)
    area = t / k - ellipe(amplitude(t / k, k), k * k)
    return asin(k * sn), k * (cn - 1), -area, [cn, -sn, -dn / k]


def between(family, phase, t, k):
    """The pose at the time t from the identity, for an extremal that begins at a phase."""
    angle, x, y, _ = family(phase, k)
    other, x1, y1, _ = family(phase + t, k)
    x, y = x1 - x, y1 - y
    return [other - angle, cos(angle) * x + sin(angle) * y, cos(angle) * y - sin(angle) * x]


def slope(curve):
    """The derivative at 0, by central differences of order 6."""
    values = {n: curve(n * CHANGE) for n in (-3, -2, -1, 1, 2, 3)}
    terms = ((1, mpf(3) / 2), (2, -mpf(3) / 5), (3, mpf(1) / 10))
    return [sum(c * (values[n][i] - values[-n][i]) for n, c in terms) / (2 * CHANGE) for i in range(3)]


for family, phase, t, k in [
    (oscillating, mpf("0.3"), mpf(2), mpf("0.8")),
    (oscillating, mpf("1.1"), mpf(5), mpf("0.5")),
    (rotating, mpf("0.3"), mpf(2), mpf("0.8")),
    (rotating, mpf("-0.4"), mpf(5), mpf("0.6")),
]:
    show(f"SE(2) {family.__name__} covector", family(phase, k)[3])
    show(f"  pose at {t}: angle, x, y", between(family, phase, t, k))
    show("  covector there", family(phase + t, k)[3])

    def determinant(t):
        curves = [
            lambda by: between(family, phase, t + by, k),
            lambda by: between(family, phase + by, t, k),
            lambda by: between(family, phase, t, k + by),
        ]
        return mp.det(matrix([slope(curve) for curve in curves]))

    s, step = mpf("0.5"), mpf("0.5")
    sign = determinant(s) > 0
    while s < 12 and (determinant(s + step) > 0) == sign:
        s += step
    if s < 12:
        conjugate = findroot(determinant, (s, s + step), solver="anderson", tol=mpf(10) ** -40)
        show("  first conjugate time", [conjugate])
    else:
        print("  no conjugate time up to 12")


# nilpotent groups and aff(1) + R
def solve(slope, y, t, steps=24, columns=14):
    """The solution at the time t: the modified midpoint rule, extrapolated in the squares of its steps."""
    for _ in range(steps):
        table = []
        for row in range(columns):
            count = 2 * (row + 1)
            h = mpf(t) / steps / count
            before, now = y, [a + h * b for a, b in zip(y, slope(0, y))]
            for _ in range(count - 1):
                before, now = now, [a + 2 * h * b for a, b in zip(before, slope(0, now))]
            smooth = [(a + b + h * c) / 2 for a, b, c in zip(before, now, slope(0, now))]
            line = [smooth]
            for k in range(1, row + 1):
                ratio = (mpf(row + 1) / (row + 1 - k)) ** 2 - 1
                line.append([a + (a - b) / ratio for a, b in zip(line[-1], table[-1][k - 1])])
            table.append(line)
        y = table[-1][-1]
    return y


def nilpotent(n, brackets):
    """ad of a vector from structure constants (i, j, k): [e_i, e_j] = e_k."""

    def bracket(x, y):
        z = [mpf(0)] * n
        for i, j, k, c in brackets:
            z[k] += c * (x[i] * y[j] - x[j] * y[i])
        return z

    return bracket


def field(bracket, x, e):
    once = bracket(x, e)
    twice = bracket(x, once)
    return [a + b / 2 + c / 12 for a, b, c in zip(e, once, twice)]


def field_slope(bracket, x, y, e):
    """The derivative of the field at x along y."""
    once = bracket(y, e)
    twice = [a + b for a, b in zip(bracket(y, bracket(x, e)), bracket(x, once))]
    return [b / 2 + c / 12 for b, c in zip(once, twice)]


def flow(n, brackets, p, t):
    bracket = nilpotent(n, brackets)
    unit = [[mpf(i == j) for i in range(n)] for j in range(n)]

    def slope(_, y):
        x, xi = y[:n], y[n:]
        h = [sum(a * b for a, b in zip(xi, field(bracket, x, unit[a]))) for a in range(2)]
        fields = [field(bracket, x, unit[a]) for a in range(2)]
        forward = [sum(h[a] * fields[a][i] for a in range(2)) for i in range(n)]
        back = [
            -sum(
                h[a] * sum(u * v for u, v in zip(xi, field_slope(bracket, x, unit[i], unit[a])))
                for a in range(2)
            )
            for i in range(n)
        ]
        return forward + back

    end = solve(slope, [mpf(0)] * n + p, t)
    x, xi = end[:n], end[n:]
    # the covector in the left-invariant basis
    return x, [sum(a * b for a, b in zip(xi, field(bracket, x, e))) for e in unit]


mp.dps = 34
ENGEL = [(0, 1, 2, 1), (0, 2, 3, 1)]
# the Lyndon basis: e4 = [e1, e3], e5 = [e3, e2]
CARTAN = [(0, 1, 2, 1), (0, 2, 3, 1), (2, 1, 4, 1)]
for name, n, brackets, p, t in [
    ("Engel", 4, ENGEL, ["0.6", "0.8", "1.5", "-2"], 2),
    ("Cartan", 5, CARTAN, ["0.6", "-0.8", "1.25", "2", "-1.5"], 2),
]:
    x, h = flow(n, brackets, [mpf(v) for v in p], mpf(t))
    show(f"{name} from {p} at {t}: coordinates", x)
    show("  covector", h)


# aff(1) + R with X1 = x, X2 = y + z: a = exp(s), E = (p_s^2 + (e^s p_b + p_c)^2)/2
def affine(_, y):
    s, b, c, ps, pb, pc = y
    w = mp.exp(s) * pb + pc
    return [ps, mp.exp(s) * w, w, -w * mp.exp(s) * pb, 0, 0]


start = [mpf(v) for v in ("0.6", "1.5", "-0.7")]
s, b, c, ps, pb, pc = solve(affine, [mpf(0)] * 3 + start, 2)
show("aff(1) + R: a, b, c", [mp.exp(s), b, c])
show("  covector", [ps, mp.exp(s) * pb, pc])
