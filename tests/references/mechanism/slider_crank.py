"""The spatial slider-crank of the IFToMM library, reduced to the angle of the crank."""
import numpy as np
from gmpy2 import cos, mpfr as Q, sin, sqrt

import maximal
from initial_value import extrapolated
from mechanism.numbers import G, cross, digits, dot, near, plus, text, times


def slider_crank_rates(theta):
    """x of the slider, m and m'/2 of T = m theta'^2/2, V', and u, u', the direction of the rod.

    The crank turns about the x axis at A = (0, 0.1, 0.12), B = A + 0.08 (0, -sin theta, cos theta), the slider C = (x, 0, 0). The universal
    joint at C has the axis x in the slider and an axis b in the rod, orthogonal to both; so the rate of the rod about its own axis u is
    u_x psi', where psi is the angle of (u_y, u_z). The mass centres are in the middle of crank and rod.
    """
    crank, length = Q("0.08"), Q("0.3")
    y = [Q("0.1") - crank * sin(theta), -crank * cos(theta), crank * sin(theta)]  # of B, with two derivatives
    z = [Q("0.12") + crank * cos(theta), -crank * sin(theta), -crank * cos(theta)]
    x = [sqrt(length**2 - y[0] ** 2 - z[0] ** 2)]
    x.append(-(y[0] * y[1] + z[0] * z[1]) / x[0])
    x.append(-(x[1] ** 2 + y[1] ** 2 + y[0] * y[2] + z[1] ** 2 + z[0] * z[2]) / x[0])
    u = [[x[k] / length, -y[k] / length, -z[k] / length] for k in range(3)]
    c = [[x[k] / 2, y[k] / 2, z[k] / 2] for k in range(3)]
    n, dn = u[0][1] * u[1][2] - u[0][2] * u[1][1], u[0][1] * u[2][2] - u[0][2] * u[2][1]
    d, dd = u[0][1] ** 2 + u[0][2] ** 2, 2 * (u[0][1] * u[1][1] + u[0][2] * u[1][2])
    spin, dspin = u[0][0] * n / d, u[1][0] * n / d + u[0][0] * (dn / d - n * dd / d**2)
    m1, m2, m3, across, along = Q("0.12"), Q("0.5"), Q(2), Q("0.004"), Q("0.0004")
    m = m1 * (crank / 2) ** 2 + Q("0.0001") + m2 * dot(c[1], c[1]) + across * dot(u[1], u[1]) + along * spin**2 + m3 * x[1] ** 2
    slope = m2 * dot(c[1], c[2]) + across * dot(u[1], u[2]) + along * spin * dspin + m3 * x[1] * x[2]
    return x, m, slope, G * (m1 + m2) * z[1] / 2, u, spin


def slider_crank_check(end):
    """The same with 18 coordinates: x of the slider and the rate of the crank."""
    a, b, c = np.array([0, 0.1, 0.12]), np.array([0, 0.1, 0.2]), np.array([0.2, 0, 0])
    u = (c - b) / 0.3
    second = np.cross([1, 0, 0], u)
    second /= np.linalg.norm(second)
    rod = 0.004 * np.eye(3) - 0.0036 * np.outer(u, u)
    system = maximal.System([(0.12, np.diag([1e-4, 1e-4, 1e-5]), (a + b) / 2), (0.5, rod, (b + c) / 2), (2, 1e-4 * np.eye(3), c)], [0, 0, -float(G)])
    system.revolute(-1, 0, a, [1, 0, 0])
    system.point(0, 1, b)
    system.point(1, 2, c)
    system.orthogonal(2, 1, [1, 0, 0], second)
    system.point(-1, 2, c, [[0, 1, 0], [0, 0, 1]])
    for i, j in ((0, 1), (0, 2), (1, 2)):
        system.orthogonal(-1, 2, np.eye(3)[i], np.eye(3)[j])
    w = np.array([6.0, 0, 0])
    pose = system.run([(np.cross(w, (b - a) / 2), w), (np.array([0.12, -0.24, 0]), np.array([1.92, -0.96, 0.48])), (np.array([0.24, 0, 0]), np.zeros(3))], end)
    return [pose[2][0][0], pose[0][3][0]]


def slider_crank():
    def f(y):
        _, m, slope, pull, _, _ = slider_crank_rates(y[0])
        return [y[1], -(slope * y[1] ** 2 + pull) / m]

    x, _, _, _, u, spin = slider_crank_rates(Q(0))
    w = plus(cross(u[0], u[1]), times(spin, u[0]))
    near(times(6, w) + [6 * x[1]], ["1.92", "-0.96", "0.48", "0.24"], 1e-25)
    states, one, two = [], [Q(0), Q(6)], [Q(0), Q(6)]
    for start, t in ((0, 1), (1, 5)):
        one, two = extrapolated(f, one, t - start, 160 * (t - start)), extrapolated(f, two, t - start, 240 * (t - start), 12)
        found = [[y[0], y[1], slider_crank_rates(y[0])[0][0], y[1] * slider_crank_rates(y[0])[0][1]] for y in (one, two)]
        if t == 1:
            near([found[0][2], found[0][1]], [float(v) for v in slider_crank_check(1)], 1e-9)
        angle, rate, place, speed = map(text, found[0])
        states.append({"time": str(t), "crank_angle": angle, "crank_rate": rate, "slider": place, "slider_velocity": speed, "digits": digits(*found)})
    b = cross([Q(1), Q(0), Q(0)], u[0])
    return {"universal_joint": {"slider_axis": ["1", "0", "0"], "rod_axis": text(times(1 / sqrt(dot(b, b)), b))}, "states": states}
