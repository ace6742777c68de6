"""Problem A04: Bricard's mechanism of six hinges, reduced to one coordinate."""
import numpy as np
from gmpy2 import cos, mpfr as Q, sin

import maximal
from initial_value import extrapolated
from mechanism.numbers import G, PI, cross, digits, dot, near, plus, text, times


HINGES = [[0, 0, 0], [1, 0, 0], [1, -1, 0], [1, -1, 1], [0, -1, 1], [0, 0, 1]]
AXES = [[0, 1, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0]]
RODS = {  # moments of inertia about the rod and across it, for 1 kg and 1 m: no radius, radius 0.05 m, section of 0.1 m by 0.1 m
    "thin": [Q(0), Q(1) / 12], "cylinder": [Q("0.00125"), (1 + Q("0.0075")) / 12], "box": [Q(1) / 600, Q("1.01") / 12],
}


def bricard_rates(theta, phi):
    """First and second derivatives of hinge angles by a parameter s of the curve F = cos theta + cos phi + cos theta cos phi = 0.

    The mechanism is a threefold-symmetric one: hinges 1, 3, 5 have the angle theta, hinges 2, 4, 6 the angle phi. The flow
    (theta, phi)_s = (F_phi, -F_theta) is regular on the whole curve. All angles from rod to rod about the axes start at -pi/2.
    """
    st, ct, sp, cp = sin(theta), cos(theta), sin(phi), cos(phi)
    first = [-sp * (1 + ct), st * (1 + cp)]
    second = [-cp * first[1] * (1 + ct) + sp * st * first[0], ct * first[0] * (1 + cp) - st * sp * first[1]]
    return first, second


def bricard_chain(theta, phi):
    """Axis, position and next rod of each hinge; then the end of the loop, and the columns of its rotation."""
    turns = [(sin(angle + PI / 2), cos(angle + PI / 2)) for angle in (theta, phi)]
    columns, at, found = [[Q(i == j) for i in range(3)] for j in range(3)], [Q(0)] * 3, []
    for k in range(6):
        a = AXES[k].index(1)
        b, c, (sine, cosine) = (a + 1) % 3, (a + 2) % 3, turns[k % 2]
        columns[b], columns[c] = plus(times(cosine, columns[b]), times(sine, columns[c])), plus(times(cosine, columns[c]), times(-sine, columns[b]))
        ahead = [q - p for p, q in zip(HINGES[k], HINGES[(k + 1) % 6])]
        d = next(d for d in range(3) if ahead[d])
        rod = times(ahead[d], columns[d])
        found.append((columns[a], at, rod))
        at = plus(at, rod)
    return found, at, columns


def bricard_energy(theta, phi, inertia):
    """m and m_s/2 of T = m s'^2/2, and V_s; then the point P4, which starts at (1, -1, 1), and its derivative by s."""
    first, second = bricard_rates(theta, phi)
    chain, _, _ = bricard_chain(theta, phi)
    along, across = inertia
    w, a, v, acceleration = [Q(0)] * 3, [Q(0)] * 3, [Q(0)] * 3, [Q(0)] * 3
    m = slope = pull = Q(0)
    for k, (axis, at, rod) in enumerate(chain[:5]):
        if k == 3:
            point = at, v
        q, dq = first[k % 2], second[k % 2]
        a = plus(a, times(dq, axis), times(q, cross(w, axis)))
        w = plus(w, times(q, axis))
        turn = cross(w, rod)  # the velocity of the end of the rod relative to its start
        swing = plus(cross(a, rod), cross(w, turn))
        vc, ac = plus(v, times(Q(1) / 2, turn)), plus(acceleration, times(Q(1) / 2, swing))
        m += dot(vc, vc) + across * dot(w, w) + (along - across) * dot(w, rod) ** 2
        slope += dot(vc, ac) + across * dot(w, a) + (along - across) * dot(w, rod) * dot(a, rod)
        pull += G * vc[1]
        v, acceleration = plus(v, turn), plus(acceleration, swing)
    return m, slope, pull, point


def bricard_check(inertia, end):
    """The same with 30 coordinates: the velocity and position of the point, and the rotation matrices."""
    along, across = map(float, inertia)
    bodies = []
    for k in range(5):
        rod = np.array(HINGES[k + 1], dtype=float) - HINGES[k]
        thin = 1e-6 if along == 0 else along  # a rod without radius must not have a singular inertia
        bodies.append((1, across * np.eye(3) + (thin - across) * np.outer(rod, rod), (np.array(HINGES[k + 1], dtype=float) + HINGES[k]) / 2))
    system = maximal.System(bodies, [0, -float(G), 0])
    for k in range(6):
        system.revolute(k - 1, k if k < 5 else -1, HINGES[k], AXES[k])
    pose = system.run([(np.zeros(3), np.zeros(3))] * 5, end)
    return system.place(pose, 3, np.array(HINGES[3], dtype=float))[0]


def bricard():
    found = {"hinges": HINGES, "axes": AXES}
    for name, inertia in RODS.items():
        def f(y):
            first, _ = bricard_rates(y[0], y[1])
            m, slope, pull, _ = bricard_energy(y[0], y[1], inertia)
            return [first[0] * y[2], first[1] * y[2], -(slope * y[2] ** 2 + pull) / m]

        states = []
        one = two = [-PI / 2, -PI / 2, Q(0)]
        for start, t in ((0, 1), (1, 10)):
            one, two = extrapolated(f, one, t - start, 16 * (t - start)), extrapolated(f, two, t - start, 24 * (t - start), 12)
            state = []
            for theta, phi, w in (one, two):
                first, _ = bricard_rates(theta, phi)
                m, _, _, point = bricard_energy(theta, phi, inertia)
                angles = [theta + PI / 2, phi + PI / 2] * 3
                state.append([angles, [w * q for q in first * 3], point[0], times(w, point[1])])
                _, end, columns = bricard_chain(theta, phi)
                assert max(abs(x) for x in end) < 1e-20 and max(abs(columns[i][j] - (i == j)) for i in range(3) for j in range(3)) < 1e-20
                assert abs(cos(theta) + cos(phi) + cos(theta) * cos(phi)) < 1e-20
            count = digits(*state)
            angles, rates, position, velocity = state[0]
            states.append({"time": str(t), "angles": text(angles), "rates": text(rates), "point": text(position), "velocity": text(velocity), "digits": count})
        if name != "thin":
            near([Q(x) for x in states[0]["point"]], [float(x) for x in bricard_check(inertia, 1)], 1e-9)
        found[name] = {"inertia": {"along": text(inertia[0]), "across": text(inertia[1])}, "states": states}
    return found
