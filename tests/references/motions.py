"""Motions on groups in 25 digits, by Taylor series of the equations, each computed twice.

    python3 tests/references/motions.py > tests/data/motions.json

With a basis E_a of matrices, a metric J and a torque M the equations are quadratic in g and H:

    g' = g E_a Omega^a,   H_i' = c^j_ki Omega^k H_j + M_i,   Omega = J^-1 H

c is found from the commutators of the E_a. A torque is constant in the body, or that of the potential
w . (g^T e3), for a weight w (mass times gravity times the centre of mass). Taylor coefficients come by their recurrences
in fixed point, steps as long as the last coefficients allow (Jorba and Zou, Exp. Math. 14 (2005) 99-117). A second run of another
order, step and precision has to agree in 27 digits; energies, Casimirs and further integrals have to stay, and published values
to come out. Inputs are exact decimals.

A case: group, metric, velocity at 0 (body), start (g = exp of it), weight or torque, states of time, g row by row, and H (body).
"""
import json
import sys
from fractions import Fraction as Q

from mpmath import chop, cos, exp, expm, hyp1f1, matrix, mp, mpc, mpf, sech, sin, sqrt, tanh

mp.dps = 60
FIRST, SECOND, AGREE, DIGITS = (40, 260, 55), (52, 300, 62), mpf(10)**-27, 25


# Algebras of matrices.

def entries(n, *at):
    m = [[0]*n for _ in range(n)]
    for i, j, v in at:
        m[i][j] = v
    return m

def spin(n, i, j): return entries(n, (i, j, -1), (j, i, 1))
def product(a, b): return [[sum(a[i][k]*b[k][j] for k in range(len(b))) for j in range(len(b[0]))] for i in range(len(a))]

ROTATIONS = [(1, 2), (2, 0), (0, 1)]
GROUPS = {
    "SO(3)": [spin(3, i, j) for i, j in ROTATIONS],
    "SE(3)": [spin(4, i, j) for i, j in ROTATIONS] + [entries(4, (i, 3, 1)) for i in range(3)],
    "SE(2)": [spin(3, 0, 1), entries(3, (0, 2, 1)), entries(3, (1, 2, 1))],
    "SL(2)": [entries(2, (0, 1, 1)), entries(2, (1, 0, 1)), entries(2, (0, 0, 1), (1, 1, -1))],
    "heisenberg(3)": [entries(3, (0, 1, 1)), entries(3, (1, 2, 1)), entries(3, (0, 2, 1))],
    "aff(1)": [entries(2, (0, 0, 1)), entries(2, (0, 1, 1))],
    "SO(4)": [spin(4, i, j) for i in range(4) for j in range(i + 1, 4)],
}

def solve(a, b):
    """x with a x = b, exactly."""
    rows = [list(map(Q, row)) + [Q(v)] for row, v in zip(a, b)]
    n = len(a)
    for k in range(n):
        p = next(i for i in range(k, n) if rows[i][k])
        rows[k], rows[p] = rows[p], rows[k]
        rows[k] = [v/rows[k][k] for v in rows[k]]
        rows = [row if i == k else [v - row[k]*w for v, w in zip(row, rows[k])] for i, row in enumerate(rows)]
    return [row[n] for row in rows]

def inverse(a):
    columns = [solve(a, [int(i == k) for i in range(len(a))]) for k in range(len(a))]
    return [list(row) for row in zip(*columns)]

def structure(basis):
    """(j, k, i, v) with [E_j, E_k] = .. + v E_i."""
    dot = lambda a, b: sum(x*y for r, s in zip(a, b) for x, y in zip(r, s))
    gram, table = [[dot(a, b) for b in basis] for a in basis], []
    for j, x in enumerate(basis):
        for k, y in enumerate(basis):
            bracket = [[p - q for p, q in zip(r, s)] for r, s in zip(product(x, y), product(y, x))]
            found = solve(gram, [dot(e, bracket) for e in basis])
            back = [[sum(v*e[r][s] for v, e in zip(found, basis)) for s in range(len(x))] for r in range(len(x))]
            assert back == bracket
            table += [(j, k, i, int(v)) for i, v in enumerate(found) if v]
    return table


# The Taylor series.

def step(system, state, order, bits):
    """The coefficients of g, row by row, and of H."""
    basis, table, inv, torque = system
    one, size = 1 << bits, len(basis[0])
    gs, hs, ws, bs = [state[0]], [state[1]], [], []
    for n in range(order):
        w = [sum(v*h for v, h in zip(row, hs[n])) >> bits for row in inv]
        ws.append(w)
        # Omega as a matrix, by its nonzero entries
        body = {}
        for e, v in zip(basis, w):
            for r in range(size):
                for s in range(size):
                    if e[r][s]:
                        body[r, s] = body.get((r, s), 0) + e[r][s]*v
        bs.append(body)
        turn = [0]*(size*size)
        for (r, s) in body:
            for row in range(size):
                turn[row*size + s] += sum(gs[n-m][row*size + r]*bs[m][r, s] for m in range(n + 1))
        rate = [0]*len(inv)
        for j, k, i, v in table:  # H_k' = c^i_jk Omega^j H_i
            rate[k] += v*sum(ws[m][j]*hs[n-m][i] for m in range(n + 1))
        force = torque(gs[n], n, one)
        gs.append([(v >> bits)//(n + 1) for v in turn])
        hs.append([((v >> bits) + f)//(n + 1) for v, f in zip(rate, force)])
    return gs, hs

def motion(system, start, times, order, bits, digits):
    """The states at the times."""
    fixed = lambda x: int(mp.floor(mpf(x)*mpf(2)**bits)) if not isinstance(x, Q) else (x.numerator << bits)//x.denominator
    basis, table, inv, torque = system
    system = basis, table, [[fixed(v) for v in row] for row in inv], torque(fixed)
    state, t, states = [[fixed(v) for v in part] for part in start], Q(0), []
    mul = lambda a, b: (a*b) >> bits
    for end in times:
        while t != end:
            gs, hs = step(system, state, order, bits)
            largest = lambda n: max(abs(v) for v in gs[n] + hs[n])
            radius = [(largest(n)/mpf(2)**bits)**(-mpf(1)/n) for n in (order - 1, order) if largest(n)]
            h = min([end - t] + [Q(int(r*mpf(10)**(-mpf(digits)/order)*2**20), 2**20) for r in radius])
            assert h > 0
            x = fixed(h)
            def value(series):
                total = [0]*len(series[0])
                for c in reversed(series):
                    total = [mul(v, x) + w for v, w in zip(total, c)]
                return total
            state, t = [value(gs), value(hs)], t + h
        states.append([[mpf(v)/mpf(2)**bits for v in part] for part in state])
    return states

def none(fixed): return lambda g, n, one: [0]*9
def weighted(weight):
    """M = gamma x w of V = w . gamma, gamma = g^T e3: the third row of g."""
    def made(fixed):
        w = [fixed(x) for x in weight]
        def torque(g, n, one):
            c = g[6:9]
            return [(c[i-2]*w[i-1] - c[i-1]*w[i-2])//one for i in range(3)]
        return torque
    return made
def constant(moment):
    return lambda fixed: lambda g, n, one: [fixed(x) if n == 0 else 0 for x in moment]


# Cases.

cases = []
def q(x): return x if isinstance(x, Q) else Q(str(x))
def text(x): return mp.nstr(chop(mpf(x), mpf(10)**-40), DIGITS, min_fixed=-3, max_fixed=12, strip_zeros=False)
def diagonal(*moments): return [[q(v) if i == j else Q(0) for j in range(len(moments))] for i, v in enumerate(moments)]
def column(v): return [mpf(x.numerator)/x.denominator if isinstance(x, Q) else mpf(x) for x in v]
def dot(a, b): return sum(x*y for x, y in zip(column(a), column(b)))

def case(name, group, metric, velocity, times, start=None, weight=None, moment=None, keep=True, integrals=()):
    """The states, after all checks."""
    basis, n = GROUPS[group], len(metric)
    metric, velocity = [[q(v) for v in row] for row in metric], [q(v) for v in velocity]
    start, times = [q(v) for v in start or [0]*n], [q(t) for t in times]
    assert all(metric[i][j] == metric[j][i] for i in range(n) for j in range(n))
    h0 = [sum(a*b for a, b in zip(row, velocity)) for row in metric]
    turn = sum((matrix(e)*column([v])[0] for v, e in zip(start, basis)), matrix(len(basis[0])))
    g0 = list(expm(turn)) if any(start) else [Q(i == j) for i in range(len(turn)) for j in range(len(turn))]
    torque = weighted([q(w) for w in weight]) if weight else constant([q(m) for m in moment]) if moment else none
    inv = inverse(metric)
    system = basis, structure(basis), inv, torque
    states = motion(system, (g0, h0), times, *FIRST)
    again = motion(system, (g0, h0), times, *SECOND)
    for one, two in zip(states, again):
        size = max(abs(v) for v in one[0] + one[1])
        off = max(abs(a - b) for x, y in zip(one, two) for a, b in zip(x, y))
        assert off < AGREE*size, (name, off)
    first = [column(g0), column(h0)]
    kinetic = lambda s: sum(s[1][i]*column([inv[i][j]])[0]*s[1][j] for i in range(n) for j in range(n))/2
    laws = list(integrals)
    if weight:
        laws += [lambda s: kinetic(s) + dot(weight_of(weight), s[0][6:9]), lambda s: dot(s[0][6:9], s[1])]
    elif not moment:
        laws += [kinetic] + [lambda s, a=a: spatial(basis, s)[a] for a in range(n)]
    for at, law in enumerate(laws):
        for s in states:
            assert abs(law(s) - law(first)) < AGREE*10*(1 + abs(law(first))), (name, at)
    if keep:
        written = [{"time": str(float(t)), "element": [text(v) for v in s[0]], "momentum": [text(v) for v in s[1]]} for t, s in zip(times, states)]
        short = lambda v: str(v.numerator) if v.denominator == 1 else repr(float(v)) if len(repr(float(v))) < 12 else f"{v.numerator}/{v.denominator}"
        data = {"name": name, "group": group, "metric": [[short(v) for v in row] for row in metric], "velocity": [short(v) for v in velocity]}
        data |= {key: [short(q(v)) for v in value] for key, value in [("start", start if any(start) else None), ("weight", weight), ("moment", moment)] if value}
        cases.append(data | {"states": written})
    print(name, "done", file=sys.stderr)
    return states

def weight_of(weight): return [q(w) for w in weight]

def spatial(basis, s):
    """h_i = H_j (Ad_(g^-1) E_i)^j."""
    size = len(basis[0])
    g = matrix(size, size)
    for i, v in enumerate(s[0]):
        g[i//size, i % size] = v
    back, n = g**-1, len(basis)
    gram = matrix([[sum(x*y for r, t in zip(a, b) for x, y in zip(r, t)) for b in basis] for a in basis])
    inv = gram**-1
    def components(m):
        found = matrix([sum(m[r, t]*e[r][t] for r in range(size) for t in range(size)) for e in basis])
        return list(inv*found)
    return [dot(s[1], components(back*matrix(e)*g)) for e in basis]

def near(a, b, tolerance):
    for x, y in zip(a, b):
        assert abs(x - mpf(y)) < tolerance*max(1, abs(x)), (a, b)

def kinetic_energy(J, w): return sum(q(j)*q(x)**2 for j, x in zip(J, w))/2


# The free body: published periods, and the separatrix.

for name, J, H, period in [
    ("hairer-vilmart", (".6", ".8", "1"), ("1.8", ".4", "-.9"), "6.86261617805811641"),
    ("dzhanibekov", (3, 5, 9), (0, 2, ".01"), "118.110887046385744068"),
    ("dzhanibekov-long", (1, 2, 3), (0, 2, "1e-6"), "109.126898549993902698"),
    ("small-axis", (1, 2, 3), (3, Q(1, 2), Q(1, 3)), "3.62505635657128895141"),
]:
    velocity = [q(h)/q(j) for h, j in zip(H, J)]
    half, whole = [s[1] for s in case(name, "SO(3)", diagonal(*J), velocity, [q(period)/2, q(period)], keep=False)]
    digits = len(period.partition(".")[2])
    near(whole, column([q(h) for h in H]), mpf(10)**(2 - digits))
    assert max(abs(a - b) for a, b in zip(half, whole)) > mpf(".01")

# of Hairer, Lubich and Wanner, whose momentum is not rational: H to 40 digits; its period was given for data rounded to doubles
rounded = lambda x: Q(int(x*mpf(10)**40), 10**40)
H, J = [rounded(cos(mpf("1.1"))), Q(0), rounded(sin(mpf("1.1")))], (2, 1, Q(2, 3))
end = case("hairer-lubich-wanner", "SO(3)", diagonal(*J), [h/q(j) for h, j in zip(H, J)], ["10.7314652348828023981"], keep=False)
near(end[0][1], column(H), mpf(10)**-14)

# H = (sech u, 2 tanh u, sqrt(3) sech u), u = t/sqrt(3)
H, J = [Q(1), Q(0), rounded(sqrt(3))], (1, 2, 3)
for t, s in zip((1, 3, 6), case("separatrix", "SO(3)", diagonal(*J), [h/j for h, j in zip(H, J)], [1, 3, 6], keep=False)):
    u = t/sqrt(mpf(3))
    near(s[1], [sech(u), 2*tanh(u), sqrt(3)*sech(u)], AGREE)

case("hairer-vilmart", "SO(3)", diagonal(".6", ".8", "1"), [3, ".5", "-.9"], [1, 5, 10, 50, 100])


# Tops: V = w . gamma, gamma = g^T e3.

m, gravity = 15, q("9.81")
J = [q(".234375") + m, q(".46875"), q(".234375") + m]
W = [0, 150, q("-4.61538")]
end = case("bruels-cardona-arnold", "SO(3)", diagonal(*J), W, [1, 2], weight=[0, m*gravity, 0])[-1]
g, h = end
near([g[1], g[4], g[7]], ["-0.15041682274564", "-0.72416559163690", "-0.67302226956044"], mpf(10)**-13)
omega = [x/y for x, y in zip(h, column(J))]
near([dot(g[3:6], omega)], ["-106.1638041431244797"], mpf(10)**-14)
assert kinetic_energy(J, W) == q("5435.696790865546875") and J[2]*W[2] == q("-70.3124296875")

for tilt, energy in [(".05", "1269.975005207899"), (".3", "1269.106729782512")]:
    case(f"simo-wong-{tilt[1:]}", "SO(3)", diagonal(5, 5, 1), [0, 0, 50], [1, 5, 10], start=[tilt, 0, 0], weight=[0, 0, 20])
    near([1250 + 20*cos(mpf(tilt))], [energy], mpf(10)**-14)

# V = R33, the sign that makes E = 4.205
J, W = (".6", ".8", "1"), (3, ".5", "-.9")
case("hairer-vilmart-potential", "SO(3)", diagonal(*J), W, [1, 5, 10, 20], weight=[0, 0, 1])
assert kinetic_energy(J, W) + 1 == q("4.205") and q(J[2])*q(W[2]) == q("-.9")

# xi = (Omega_1 + i Omega_2)^2 - (gamma_1 + i gamma_2), |xi|^2 = 1
xi = lambda s: abs(mpc(s[1][0], s[1][1])**2/4 - mpc(s[0][6], s[0][7]))**2
end = case("kovalevskaya", "SO(3)", diagonal(2, 2, 1), [1, 0, ".5"], [1, 5, 10, 20], weight=[1, 0, 0], integrals=[xi])
near([xi(end[-1])], ["1"], AGREE)


# Constant torques in the body (Romano 2008): closed forms.

def rotation(q):
    w, x, y, z = q
    return [w*w+x*x-y*y-z*z, 2*(x*y-w*z), 2*(x*z+w*y), 2*(x*y+w*z), w*w-x*x+y*y-z*z, 2*(y*z-w*x),
            2*(x*z-w*y), 2*(y*z+w*x), w*w-x*x-y*y+z*z]

def accelerated(velocity, rate, t):
    """The attitude with Omega = velocity + (0, 0, rate) t, by Kummer's function.

    In the first row (u, v) = (w - iz, -y - ix) of the matrix of SU(2) u'' = -(i rate/2 + (|W|^2 + Omega_3^2)/4) u,
    W = Omega_1 + i Omega_2."""
    W, s0, rate = mpc(velocity[0], velocity[1]), mpf(velocity[2])/rate, mpf(rate)
    k = abs(W)**2/4
    a = 1j*k/(2*rate)
    def solutions(s):
        """Two of them, and their slopes."""
        z, f = 1j*rate*s*s/2, exp(-1j*rate*s*s/4)
        even, odd = hyp1f1(a, mpf(1)/2, z), hyp1f1(a + mpf(1)/2, mpf(3)/2, z)
        d_even = 2*a*hyp1f1(a + 1, mpf(3)/2, z)*1j*rate*s
        d_odd = odd + s*(a + mpf(1)/2)/(mpf(3)/2)*hyp1f1(a + mpf(3)/2, mpf(5)/2, z)*1j*rate*s
        slope = -1j*rate*s/2
        return [f*even, f*s*odd], [f*(d_even + slope*even), f*(d_odd + slope*s*odd)]
    value, slope = solutions(s0)
    u0, du0 = mpf(1), -0.5j*velocity[2]
    determinant = value[0]*slope[1] - value[1]*slope[0]
    c = [(u0*slope[1] - value[1]*du0)/determinant, (value[0]*du0 - slope[0]*u0)/determinant]
    value, slope = solutions(s0 + t)
    u = c[0]*value[0] + c[1]*value[1]
    du = c[0]*slope[0] + c[1]*slope[1]
    v = (2j*du - (velocity[2] + rate*t)*u)/W
    return rotation([u.real, -v.imag, -v.real, -u.imag])

def times3(a, b): return [sum(a[3*i+k]*b[3*k+j] for k in range(3)) for i in range(3) for j in range(3)]
def transposed(a): return [a[3*j+i] for i in range(3) for j in range(3)]
def about_z(angle): return [cos(angle), -sin(angle), mpf(0), sin(angle), cos(angle), mpf(0), mpf(0), mpf(0), mpf(1)]

# three equal moments; the torque along n = (2, 3, 6)/7, the third column of P
n, e = column([Q(2, 7), Q(3, 7), Q(6, 7)]), column([Q(6, 7), Q(2, 7), Q(-3, 7)])
P = e, [n[1]*e[2] - n[2]*e[1], n[2]*e[0] - n[0]*e[2], n[0]*e[1] - n[1]*e[0]], n
assert abs(dot(e, n)) < AGREE
W, M = column(["1", "-.5", ".25"]), column([Q(2, 5), Q(3, 5), Q(6, 5)])
for t, s in zip((1, 5, 10), case("romano-constant", "SO(3)", diagonal(2, 2, 2), [1, "-.5", ".25"], [1, 5, 10], moment=["2/5", "3/5", "6/5"])):
    near(s[1], [2*w + m*t for w, m in zip(W, M)], AGREE)
    attitude = accelerated([dot(p, W) for p in P], mpf(7)/5/2, t)
    frame = [p[i] for i in range(3) for p in P]
    near(s[0], times3(times3(frame, attitude), transposed(frame)), AGREE)

# the torque along the axis of a symmetric body: R = R0 Rz(phi), R0 that of three equal moments
J, J3, W, M = mpf(3), mpf(1), column(["1", "-.5", ".25"]), mpf(".5")
for t, s in zip((1, 5, 10), case("romano-axial", "SO(3)", diagonal(3, 3, 1), [1, "-.5", ".25"], [1, 5, 10], moment=[0, 0, ".5"])):
    phi = (1/J3 - 1/J)*(J3*W[2]*t + M*t*t/2)
    near(s[0], times3(accelerated([W[0], W[1], J3*W[2]/J], M/J, t), about_z(phi)), AGREE)
    H = J*mpc(W[0], W[1])*exp(-1j*phi)
    near(s[1], [H.real, H.imag, J3*W[2] + M*t], AGREE)

# across the axis: Omega_3 stays, w' = -i l w + M/J for w = Omega_1 + i Omega_2
M = mpc(".5", "-.25")
for t, s in zip((1, 5, 10), case("romano-transverse", "SO(3)", diagonal(3, 3, 1), [1, "-.5", ".25"], [1, 5, 10], moment=[".5", "-.25", 0])):
    l = 1j*(J3/J - 1)*W[2]
    w = (mpc(W[0], W[1]) + M/J/l)*exp(l*t) - M/J/l
    near(s[1], [J*w.real, J*w.imag, J3*W[2]], AGREE)


# Coning, R = Rz(w t) Rx(b) Rz(-w t), of three unit moments: exact, w = 2, b = 1/4, t = 20.

turn = lambda x: about_z(mpf(x))
lean = [mpf(1), mpf(0), mpf(0), mpf(0), cos(mpf(".25")), -sin(mpf(".25")), mpf(0), sin(mpf(".25")), cos(mpf(".25"))]
coned = times3(times3(turn(40), lean), turn(-40))
momentum = [-2*sin(mpf(".25"))*sin(mpf(40)), 2*sin(mpf(".25"))*cos(mpf(40)), 2*(cos(mpf(".25")) - 1)]
coning = {"rate": "2", "angle": "0.25", "time": "20", "element": [text(v) for v in coned], "momentum": [text(v) for v in momentum]}


# Bodies in a fluid, on SE(3): H = (Pi, P).

casimirs = [lambda s: dot(s[1][:3], s[1][3:]), lambda s: dot(s[1][3:], s[1][3:])]
W = [".5", "-.3", ".6", ".4", ".2", "-.5"]
case("kirchhoff", "SE(3)", diagonal(1, 2, 3, 4, 2, 1), W, [1, 5, 10, 20], integrals=casimirs)
# b1 - 2 b2 + b3 = 0 for the reciprocal masses b, with the integral of Clebsch |Pi|^2 + q_i P_i^2
b = [Q(1, 2), Q(3, 4), Q(1)]
clebsch = [-2*(b[2] - b[0]), b[1] - b[2], Q(0)]
further = lambda s: dot(s[1][:3], s[1][:3]) + sum(c*p*p for c, p in zip(column(clebsch), s[1][3:]))
case("clebsch", "SE(3)", diagonal(1, 2, 3, *[1/x for x in b]), W, [1, 5, 10, 20], integrals=casimirs + [further])


# Other algebras, with metrics that are not diagonal.

full = lambda n: [[q(1 + Q(i, 2)) if i == j else Q(1, 4) if abs(i - j) == 1 else Q(1, 8) for j in range(n)] for i in range(n)]
case("sl(2)", "SL(2)", full(3), [".5", "-.25", ".375"], [1, 2, 5, 10], integrals=[lambda s: s[1][0]*s[1][1] + s[1][2]**2/4])
case("heisenberg(3)", "heisenberg(3)", full(3), [".5", "-.75", "1.25"], [1, 5, 10, 20], integrals=[lambda s: s[1][2]])
case("aff(1)", "aff(1)", full(2), [".5", "-.75"], [1, 2, 5, 10])
case("se(2)", "SE(2)", full(3), [".75", "-.5", ".25"], [1, 5, 10, 20], integrals=[lambda s: s[1][1]**2 + s[1][2]**2])

# of mass tensor A = (1, 3/2, 5/2, 4): moments a_i + a_j; norm, Pfaffian, and an integral of Manakov, B = A^2
a = [Q(1), Q(3, 2), Q(5, 2), Q(4)]
pairs = [(i, j) for i in range(4) for j in range(i + 1, 4)]
def manakov(s):
    m = matrix(4, 4)
    for (i, j), v in zip(pairs, s[1]):
        m[i, j], m[j, i] = -v, v
    B = matrix(4, 4)
    for i in range(4):
        B[i, i] = column([a[i]**2])[0]
    trace = lambda x: sum(x[i, i] for i in range(4))
    return trace(m*m*B*B) + trace(m*B*m*B)/2
pfaffian = lambda s: s[1][0]*s[1][5] - s[1][1]*s[1][4] + s[1][2]*s[1][3]
case("so(4)", "SO(4)", diagonal(*[a[i] + a[j] for i, j in pairs]), [".5", "-.3", ".6", ".4", ".2", "-.5"], [1, 5, 10, 20],
     integrals=[lambda s: dot(s[1], s[1]), pfaffian, manakov])


# one state per line
print('{"motions": [')
for at, data in enumerate(cases):
    states = data.pop("states")
    print(json.dumps(data)[:-1] + ', "states": [')
    print(",\n".join(json.dumps(state) for state in states))
    print("]}" + ("," if at + 1 < len(cases) else ""))
print('], "coning": ' + json.dumps(coning) + "}")
