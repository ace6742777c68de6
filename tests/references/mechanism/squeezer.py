"""Problem A03: Andrews' squeezer, with multipliers, with one coordinate, and as seven bodies."""
import numpy as np
from gmpy2 import cos, mpfr as Q, sin, sqrt

import maximal
from initial_value import extrapolated
from mechanism.numbers import digits, near, solved, text


SQUEEZER = {  # names of the test set of initial value problems (Bari and Amsterdam), and of Hairer and Wanner, section VII.7
    "d": "0.028", "da": "0.0115", "e": "0.02", "ea": "0.01421", "rr": "0.007", "ra": "0.00092", "ss": "0.035", "sa": "0.01874", "sb": "0.01043",
    "sc": "0.018", "sd": "0.02", "zt": "0.04", "ta": "0.02308", "tb": "0.00916", "u": "0.04", "ua": "0.01228", "ub": "0.00449", "zf": "0.02",
    "fa": "0.01421", "xa": "-0.06934", "ya": "-0.00227", "xb": "-0.03635", "yb": "0.03273", "xc": "0.014", "yc": "0.072", "c0": "4530",
    "lo": "0.07785", "mom": "0.033",
}
MASSES = ["0.04325", "0.00365", "0.02373", "0.00706", "0.0705", "0.00706", "0.05498"]
INERTIAS = ["2.194e-6", "4.41e-7", "5.255e-6", "5.667e-7", "1.169e-5", "5.667e-7", "1.912e-5"]
ANGLES = ["-0.0617138900142764496358948458001", "0", "0.455279819163070380255912382449", "0.222668390165885884674473185609",
          "0.487364979543842550225598953530", "-0.222668390165885884674473185609", "1.23054744454982119249735015568"]
PUBLISHED = [
    "15.81077119629904", "-15.75637105984298", "0.04082224013073101", "-0.5347301163226948", "0.5244099658805304", "0.5347301163226948", "1.048080741042263",
    "1139.920302151208", "-1424.379294994111", "11.03291221937134", "19.29337464421385", "0.5735699284790808", "-19.29337464421385", "0.3231791658026955",
    "199.1753333731910", "-29.75531228015052", "23.06654119098399", "31.45271365475927", "22.64249232082739", "11.61740700019673"]
P = type("Lengths", (), {name: Q(value) for name, value in SQUEEZER.items()})
M, I = [Q(x) for x in MASSES], [Q(x) for x in INERTIAS]
ORIENTATION = [[0], [0, 1], [2], [3, 4], [4], [5, 6], [6]]  # the angles of the test set that add up to the rotation of each body


def squeezer_paths(q):
    """Vectors (length, angle) whose sums are the loops: crank to E, and from E's other ends; each as [(x, y), dependence on the seven angles]."""
    b, t, g, ph, de, om, ep = q
    arm = lambda x, y, angle, of: (x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle), of)
    crank = [arm(P.rr, 0, b, [0]), arm(-P.d, 0, b + t, [0, 1])]
    return crank, [arm(0, -P.ss, g, [2])], [arm(P.zt, 0, de, [4]), arm(0, -P.e, ph + de, [3, 4])], [arm(0, -P.u, ep, [6]), arm(P.zf, 0, om + ep, [5, 6])]


def squeezer_constraints(q, v):
    """The six constraints, their Jacobian and the part of their second derivatives that has no accelerations."""
    crank, *others = squeezer_paths(q)
    values, rows, bias = [], [], []
    for path, (x, y) in zip(others, [(P.xb, P.yb), (P.xa, P.ya), (P.xa, P.ya)]):
        value, row, rest = [-x, -y], [[Q(0)] * 7, [Q(0)] * 7], [Q(0), Q(0)]
        for sign, (dx, dy, of) in [(1, part) for part in crank] + [(-1, part) for part in path]:
            value = [value[0] + sign * dx, value[1] + sign * dy]
            speed = sum(v[k] for k in of)
            for k in of:
                row[0][k] -= sign * dy
                row[1][k] += sign * dx
            rest = [rest[0] - sign * dx * speed**2, rest[1] - sign * dy * speed**2]
        values, rows, bias = values + value, rows + row, bias + rest
    return values, rows, bias


def squeezer_published(y):
    """Velocities, accelerations and multipliers, with the mass matrix and forces of the test set: M q'' = f - G^T lambda."""
    q, v = y[:7], y[7:]
    b, t, g, ph, de, om, ep = q
    m = [[Q(0)] * 7 for _ in range(7)]
    m[0][0] = M[0] * P.ra**2 + M[1] * (P.rr**2 - 2 * P.da * P.rr * cos(t) + P.da**2) + I[0] + I[1]
    m[0][1] = m[1][0] = M[1] * (P.da**2 - P.da * P.rr * cos(t)) + I[1]
    m[1][1] = M[1] * P.da**2 + I[1]
    m[2][2] = M[2] * (P.sa**2 + P.sb**2) + I[2]
    r = P.e - P.ea
    m[3][3] = M[3] * r**2 + I[3]
    m[3][4] = m[4][3] = M[3] * (r**2 + P.zt * r * sin(ph)) + I[3]
    m[4][4] = M[3] * (P.zt**2 + 2 * P.zt * r * sin(ph) + r**2) + M[4] * (P.ta**2 + P.tb**2) + I[3] + I[4]
    z = P.zf - P.fa
    m[5][5] = M[5] * z**2 + I[5]
    m[5][6] = m[6][5] = M[5] * (z**2 - P.u * z * sin(om)) + I[5]
    m[6][6] = M[5] * (z**2 - 2 * P.u * z * sin(om) + P.u**2) + M[6] * (P.ua**2 + P.ub**2) + I[5] + I[6]
    x, h = P.sd * cos(g) + P.sc * sin(g) + P.xb - P.xc, P.sd * sin(g) - P.sc * cos(g) + P.yb - P.yc
    long = sqrt(x**2 + h**2)
    pull = -P.c0 * (long - P.lo) / long
    f = [P.mom - M[1] * P.da * P.rr * v[1] * (v[1] + 2 * v[0]) * sin(t), M[1] * P.da * P.rr * v[0] ** 2 * sin(t),
         pull * x * (P.sc * cos(g) - P.sd * sin(g)) + pull * h * (P.sd * cos(g) + P.sc * sin(g)),
         M[3] * P.zt * r * v[4] ** 2 * cos(ph), -M[3] * P.zt * r * v[3] * (v[3] + 2 * v[4]) * cos(ph),
         -M[5] * P.u * z * v[6] ** 2 * cos(om), M[5] * P.u * z * v[5] * (v[5] + 2 * v[6]) * cos(om)]
    _, rows, bias = squeezer_constraints(q, v)
    matrix = [m[i] + [row[i] for row in rows] for i in range(7)] + [row + [Q(0)] * 6 for row in rows]
    found = [x[0] for x in solved(matrix, [[x] for x in f] + [[-x] for x in bias])]
    return v, found[:7], found[7:]


def squeezer_bodies(q):
    """The paths of vectors from the ground to the centre of each body."""
    arm = lambda x, y, of: (x * cos(sum(q[k] for k in of)) - y * sin(sum(q[k] for k in of)), x * sin(sum(q[k] for k in of)) + y * cos(sum(q[k] for k in of)), of)
    a, b, o = (P.xa, P.ya, []), (P.xb, P.yb, []), (Q(0), Q(0), [])
    return [[o, arm(P.ra, 0, [0])], [o, arm(P.rr, 0, [0]), arm(-P.da, 0, [0, 1])], [b, arm(P.sb, -P.sa, [2])],
            [a, arm(P.zt, 0, [4]), arm(0, -(P.e - P.ea), [3, 4])], [a, arm(P.ta, P.tb, [4])],
            [a, arm(0, -P.u, [6]), arm(P.zf - P.fa, 0, [5, 6])], [a, arm(-P.ub, -P.ua, [6])]]


def squeezer_reduced(y):
    """The state (angles, beta'): the other rates follow from the constraints, and m and m'/2 of T = m beta'^2/2 from the bodies."""
    q, rate = y[:7], y[7]
    _, rows, _ = squeezer_constraints(q, [Q(0)] * 7)
    first = [Q(1)] + [x[0] for x in solved([row[1:] for row in rows], [[-row[0]] for row in rows])]
    _, _, bias = squeezer_constraints(q, first)
    second = [Q(0)] + [x[0] for x in solved([row[1:] for row in rows], [[-x] for x in bias])]
    m, slope, force = Q(0), Q(0), P.mom
    for k, path in enumerate(squeezer_bodies(q)):
        v, a = [Q(0), Q(0)], [Q(0), Q(0)]
        for x, h, of in path:
            w, dw = sum(first[i] for i in of), sum(second[i] for i in of)
            v = [v[0] - h * w, v[1] + x * w]
            a = [a[0] - h * dw - x * w**2, a[1] + x * dw - h * w**2]
        w, dw = sum(first[i] for i in ORIENTATION[k]), sum(second[i] for i in ORIENTATION[k])
        m += M[k] * (v[0] ** 2 + v[1] ** 2) + I[k] * w**2
        slope += M[k] * (v[0] * a[0] + v[1] * a[1]) + I[k] * w * dw
    dx, dy = P.sd * cos(q[2]) + P.sc * sin(q[2]), P.sd * sin(q[2]) - P.sc * cos(q[2])
    x, h = dx + P.xb - P.xc, dy + P.yb - P.yc
    long = sqrt(x**2 + h**2)
    force += -P.c0 * (long - P.lo) / long * (-x * dy + h * dx) * first[2]
    return [rate * p for p in first] + [(force - slope * rate**2) / m], first


def squeezer_energy(y):
    """Kinetic energy and the energy of the spring, less the work of the torque."""
    q, v = y[:7], y[7:]
    energy = -P.mom * q[0]
    for k, path in enumerate(squeezer_bodies(q)):
        x = sum(-h * sum(v[i] for i in of) for _, h, of in path)
        y = sum(x * sum(v[i] for i in of) for x, _, of in path)
        energy += (M[k] * (x**2 + y**2) + I[k] * sum(v[i] for i in ORIENTATION[k]) ** 2) / 2
    x, y = P.sd * cos(q[2]) + P.sc * sin(q[2]) + P.xb - P.xc, P.sd * sin(q[2]) - P.sc * cos(q[2]) + P.yb - P.yc
    return energy + P.c0 * (sqrt(x**2 + y**2) - P.lo) ** 2 / 2


def squeezer_check(data):
    """The bodies, joints, spring and torque of the data alone, with 42 coordinates: rotations and centres at the end."""
    number = lambda pair: np.array([float(x) for x in pair] + [0.0])
    names = {body["name"]: k for k, body in enumerate(data["bodies"])} | {"ground": -1}
    system = maximal.System([(b["mass"], float(b["inertia"]) * np.eye(3), number(b["centre"])) for b in data["bodies"]], [0, 0, 0])
    for joint in data["joints"]:
        system.revolute(*[names[name] for name in joint["bodies"]], number(joint["at"]), [0, 0, 1])
    spring, torque = data["spring"], data["torque"]
    body, at, ground = names[spring["body"]], number(spring["at"]), number(spring["ground"])

    def forces(pose, wrench):
        place, arm, _, _ = system.place(pose, body, at)
        length = np.linalg.norm(place - ground)
        force = -float(spring["stiffness"]) * (length - float(spring["rest_length"])) / length * (place - ground)
        wrench[body] += np.concatenate([force, np.cross(arm, force)])
        wrench[names[torque["body"]], 5] += float(torque["value"])

    system.forces = forces
    pose = system.run([(np.zeros(3), np.zeros(3))] * 7, 0.03, 1e-11)
    return [[x[0], x[1], np.arctan2(r[1, 0], r[0, 0])] for x, r, _, _ in pose]


def squeezer():
    start = [Q(x) for x in ANGLES]
    closed = lambda q: max(abs(x) for x in squeezer_constraints(q, [Q(0)] * 7)[0])
    assert closed(start) < 1e-17
    # the published angles are rounded: Newton's iteration closes the loops for the given beta
    for _ in range(3):
        values, rows, _ = squeezer_constraints(start, [Q(0)] * 7)
        start = start[:1] + [p - x[0] for p, x in zip(start[1:], solved([row[1:] for row in rows], [[v] for v in values]))]
    near(start, ANGLES, 1e-15)
    full = extrapolated(lambda y: sum(squeezer_published(y)[:2], []), start + [Q(0)] * 7, "0.03", 180, 11)
    least = extrapolated(lambda y: squeezer_reduced(y)[0], start + [Q(0)], "0.03", 240, 10)
    again = least[:7] + [least[7] * p for p in squeezer_reduced(least)[1]]
    assert closed(full[:7]) < 1e-20
    count = min(digits(full[:7], again[:7]), digits(full[7:], again[7:]))
    multipliers = squeezer_published(full)[2]
    assert abs(squeezer_energy(full) - squeezer_energy(start + [Q(0)] * 7)) < 1e-20
    # The published numbers are those of a method of index 3: angles are right to 10 digits, rates to 7, multipliers to 6. They violate the
    # derivatives of the constraints by 1e-9, and the balance of energy by 2e-10 J.
    for found, published, error in ((full[:7], PUBLISHED[:7], 3e-10), (full[7:], PUBLISHED[7:14], 6e-8), (multipliers, PUBLISHED[14:], 2e-6)):
        assert all(abs(a - Q(b)) < error * abs(a) for a, b in zip(found, published))
    stray = [Q(x) for x in PUBLISHED]
    rows = squeezer_constraints(stray[:7], stray[7:14])[1]
    assert max(abs(sum(a * b for a, b in zip(row, stray[7:14]))) for row in rows) > 5e-10
    assert abs(squeezer_energy(stray[:14]) - squeezer_energy(start + [Q(0)] * 7)) > 2e-10
    q, at = start, lambda path: [sum(v[0] for v in path), sum(v[1] for v in path)]
    end = squeezer_bodies(full[:7])
    bodies = [{"name": name, "mass": m, "inertia": i, "centre": text(at(path)), "last_centre": text(at(last)),
               "rotation": text(sum(full[k] - start[k] for k in of))}
              for name, m, i, path, last, of in zip(["OF", "FE", "BDE", "EG", "AG", "EH", "AH"], MASSES, INERTIAS, squeezer_bodies(q), end, ORIENTATION)]
    crank, _, left, right = squeezer_paths(q)
    a, b = [P.xa, P.ya], [P.xb, P.yb]
    f, e = at(crank[:1]), at(crank)
    g, h = [p + v for p, v in zip(a, left[0])], [p + v for p, v in zip(a, right[0])]
    d = [b[0] + P.sd * cos(q[2]) + P.sc * sin(q[2]), b[1] + P.sd * sin(q[2]) - P.sc * cos(q[2])]
    joints = [("O", "ground", "OF", [Q(0), Q(0)]), ("F", "OF", "FE", f), ("E", "FE", "BDE", e), ("E", "FE", "EG", e), ("E", "FE", "EH", e),
              ("B", "ground", "BDE", b), ("G", "EG", "AG", g), ("A", "ground", "AG", a), ("H", "EH", "AH", h), ("A", "ground", "AH", a)]
    found = {"bodies": bodies, "joints": [{"name": n, "bodies": [i, j], "at": text(p)} for n, i, j, p in joints],
            "spring": {"body": "BDE", "at": text(d), "ground": [SQUEEZER["xc"], SQUEEZER["yc"]], "stiffness": SQUEEZER["c0"], "rest_length": SQUEEZER["lo"]},
            "torque": {"body": "OF", "value": SQUEEZER["mom"]}, "lengths": SQUEEZER, "start": text(start),
            "states": [{"time": "0.03", "angles": text(full[:7]), "rates": text(full[7:]), "multipliers": text(multipliers), "digits": count}]}
    for (x, y, angle), body in zip(squeezer_check(found), bodies):
        near([x, y], [float(v) for v in body["last_centre"]], 1e-9)
        assert abs(np.exp(1j * (angle - float(body["rotation"]))) - 1) < 1e-8
    return found
