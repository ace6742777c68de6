"""A disk and a coin that roll without slip on the plane z = 0."""
from gmpy2 import cos, mpfr as Q, sin, sqrt

from initial_value import extrapolated
from mechanism.numbers import G, PI, cross, digits, dot, near, plus, solved, text, times


def rolling_angles(m, r, across, along, angles, rates, end, steps):
    """By Euler angles (theta, psi, phi) and rates (w1, w2, w3) in the frame e1 (horizontal), s (upward in the disk), a (the axis).

    a = cos(theta) n + sin(theta) h, h = (cos psi, sin psi, 0), e1 = n x h. The balance of momentum about the contact point, with the velocity
    r (-w3 e1 + w1 a) of the centre, gives three equations without reactions."""
    def f(y):
        theta, psi, phi, w1, w2, w3, _, _ = y
        sine, cosine = sin(theta), cos(theta)
        yaw = w2 / sine
        w1_ = (yaw * cosine * across * w2 - along * w2 * w3 - m * r * (r * w2 * w3 + G * cosine)) / (across + m * r**2)
        w2_ = (along * w3 - across * yaw * cosine) * w1 / across
        w3_ = m * r**2 * w1 * w2 / (along + m * r**2)
        u, v = -r * w3, r * w1 * sine  # along e1 and h
        return [w1, yaw, w3 - yaw * cosine, w1_, w2_, w3_, -u * sin(psi) + v * cos(psi), u * cos(psi) + v * sin(psi)]

    theta, psi, phi, w1, w2, w3, x, y = extrapolated(f, angles + rates + [r * cos(angles[0]) * -cos(angles[1]), r * cos(angles[0]) * -sin(angles[1])], end, steps)
    h, n = [cos(psi), sin(psi), Q(0)], [Q(0), Q(0), Q(1)]
    e1, a, s = cross(n, h), plus(times(cos(theta), n), times(sin(theta), h)), plus(times(sin(theta), n), times(-cos(theta), h))
    w = plus(times(w1, e1), times(w2, s), times(w3, a))
    return [[x, y, r * sin(theta)], cross(w, times(r, s)), w, a, plus(times(cos(phi), e1), times(sin(phi), s))]


def rolling_vectors(m, r, across, along, a, b, w, end, steps):
    """By the axis a, a vector b in the disk, the spatial angular velocity w and the contact, without angles; matrices are solved."""
    n = [Q(0), Q(0), Q(1)]

    def up(a, da):
        p, dp = plus(n, times(-a[2], a)), plus(times(-da[2], a), times(-a[2], da))
        size = sqrt(dot(p, p))
        s = times(1 / size, p)
        return s, times(1 / size, plus(dp, times(-dot(s, dp), s)))

    def f(y):
        a, b, w = y[:3], y[3:6], y[6:9]
        da = cross(w, a)
        s, ds = up(a, da)
        arm, darm = times(r, s), times(r, ds)
        right = plus(times(along - across, plus(times(dot(a, w), da), times(dot(da, w), a))), times(m, cross(arm, plus(cross(w, darm), times(G, n)))))
        matrix = [[(across + m * r**2) * (i == j) + (along - across) * a[i] * a[j] - m * arm[i] * arm[j] for j in range(3)] for i in range(3)]
        return da + cross(w, b) + [-x[0] for x in solved(matrix, [[x] for x in right])] + cross(w, arm)

    s, _ = up(a, [Q(0)] * 3)
    y = extrapolated(f, a + b + w + times(r, s), end, steps)
    s, _ = up(y[:3], [Q(0)] * 3)
    return [y[9:], cross(y[6:9], times(r, s)), y[6:9], y[:3], y[3:6]]


def rolling(m, r, across, along, angles, rates, names, cases):
    theta, psi, phi = angles
    h, n = [cos(psi), sin(psi), Q(0)], [Q(0), Q(0), Q(1)]
    e1, a, s = cross(n, h), plus(times(cos(theta), n), times(sin(theta), h)), plus(times(sin(theta), n), times(-cos(theta), h))
    w = plus(times(rates[0], e1), times(rates[1], s), times(rates[2], a))
    states = []
    for t, count in cases:
        one = rolling_angles(m, r, across, along, angles, rates, t, count)
        two = rolling_vectors(m, r, across, along, a, e1, w, t, count * 5 // 4)
        place, velocity, w_, a_, b_ = one
        up = plus([Q(0), Q(0), Q(1)], times(-a_[2], a_))
        contact = plus(place, times(-r / sqrt(dot(up, up)), up))
        fields = {"position": place, "velocity": velocity, "angular_velocity": w_, names[0]: a_, names[1]: b_, "contact": contact}
        states.append({"time": t, **{key: text(value) for key, value in fields.items()}, "digits": min(digits(x, y) for x, y in zip(one, two))})
    start = {"position": times(r, s), "velocity": cross(w, times(r, s)), "angular_velocity": w, names[0]: a, names[1]: e1}
    start = {key: text(value) for key, value in start.items()}
    return {"mass": text(m), "radius": text(r), "inertia": {"across": text(across), "along": text(along)}, "start": start, "states": states}


def disk():
    """Hante's disk: the axis e3 along y, e1 along -x, the body angular velocity (0, 15, 5)."""
    return rolling(Q(15), Q(1), Q("3.75"), Q("7.5"), [PI / 2, PI / 2, Q(0)], [Q(0), Q(15), Q(5)], ("e3", "e1"), [("0.5", 60), ("2", 240)])


def coin():
    """Rill and Schaeffer's coin: the axis e1 leans by one degree below x; e2 is along y. It spins about the vertical by 1800 degrees per second."""
    r, lean, spin = Q("0.01"), PI / 180, 10 * PI
    found = rolling(Q(1), r, r**2 / 4, r**2 / 2, [PI / 2 + lean, Q(0), Q(0)], [Q(0), spin * cos(lean), -spin * sin(lean)], ("e1", "e2"), [("0.5", 120), ("2", 480)])
    near([Q(found["states"][0]["contact"][0])], ["0.002004099927340136"], 2e-5)  # EXUDYN's test, with steps of 0.5 ms
    return found
