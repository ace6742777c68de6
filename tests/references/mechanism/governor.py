"""Problem A05: the stiff flyball governor, whose rods move alike, so that three coordinates suffice."""
import numpy as np
from gmpy2 import cos, mpfr as Q, sin, sqrt

import maximal
from initial_value import collocated
from mechanism.numbers import G, PI, digits, near, text


GOVERNOR = {
    "stiffness": "800000", "damping": "40000", "rest_length": "0.5", "density": "3000", "shaft": ["0.01", "0.01", "1"], "rod": ["1", "0.01", "0.01"],
    "slider": ["0.1", "0.1", "0.1"], "point_mass": "5", "masses": {"shaft": "0.3", "rod": "0.3", "slider": "3"}, "slider_height": "0.5",
    "rod_angle": "30 degrees below the horizontal", "hinges": ["0.05", "0", "1"],
}


def governor_terms(alpha, s):
    """The moment of inertia about the shaft with its derivative by alpha, the length of a spring with its derivatives, the inertia of alpha.

    The shaft turns freely about z by phi; its lower end is at 0. The slider, a cube of centre (0, 0, s), turns with it. The rods hang on hinges at
    (+-0.05, 0, 1) with axes along y of the shaft, alpha below the horizontal; a point mass of 5 kg is at the free end of each. A spring with
    a damper in parallel joins (+-0.05, 0, s) of the slider and the middle of the rod on the same side.
    """
    c, n = cos(alpha), sin(alpha)
    rod, ball, along, across = Q("0.3"), Q(5), Q("0.000005"), Q("0.3") * Q("1.0001") / 12
    x, y = Q("0.05") + c / 2, Q("0.05") + c
    inertia = 2 * (rod * x**2 + across * c**2 + along * n**2 + ball * y**2) + Q("0.000005") + Q("0.005")
    slope = 2 * (-rod * x * n - 2 * (across - along) * c * n - 2 * ball * y * n)
    drop = 1 - n / 2 - s
    length = sqrt(c**2 / 4 + drop**2)
    return inertia, slope, length, -(c * n / 4 + drop * c / 2) / length, -drop / length, 2 * (rod / 4 + across + ball)


def governor_rates(alpha, s, da, ds, spin):
    inertia, slope, length, by_alpha, by_s, own = governor_terms(alpha, s)
    force = 2 * (Q(800000) * (length - Q("0.5")) + Q(40000) * (by_alpha * da + by_s * ds))
    return (slope * spin**2 / 2 + 2 * G * cos(alpha) * (Q("0.15") + 5) - force * by_alpha) / own, -G - force * by_s / 3, -slope * da * spin / inertia


def governor_check(spin, end):
    """The same with 24 coordinates: the height of the slider and the rate of the shaft."""
    c, n, g = 3**0.5 / 2, 0.5, float(G)
    across, along, mass = 0.3 * 1.0001 / 12, 5e-6, 5.3
    bodies = [(0.3, np.diag([across, across, along]), [0, 0, 0.5]), (3, 0.005 * np.eye(3), [0, 0, 0.5])]
    at = 5.15 / 5.3
    for side in (1, -1):
        d = np.array([side * c, 0, -n])
        total = across + 0.3 * (at - 0.5) ** 2 + 5 * (1 - at) ** 2
        bodies.append((mass, total * np.eye(3) + (along - total) * np.outer(d, d), np.array([side * 0.05, 0, 1]) + at * d))
    system = maximal.System(bodies, [0, 0, -g])
    system.revolute(-1, 0, [0, 0, 0], [0, 0, 1])
    system.point(0, 1, [0, 0, 0.5], [[1, 0, 0], [0, 1, 0]])
    for i, j in ((0, 1), (0, 2), (1, 2)):
        system.orthogonal(0, 1, np.eye(3)[i], np.eye(3)[j])
    for k, side in ((2, 1), (3, -1)):
        system.revolute(0, k, [side * 0.05, 0, 1], [0, 1, 0])

    def springs(pose, wrench):
        for k, side in ((2, 1), (3, -1)):
            ends = []
            for body, point in ((1, [side * 0.05, 0, 0.5]), (k, [side * (0.05 + c / 2), 0, 0.75])):
                place, arm, _, _ = system.place(pose, body, np.array(point))
                ends.append((body, place, arm, pose[body][2] + np.cross(pose[body][3], arm)))
            (i, p, a, v), (j, q, b, w) = ends
            length = np.linalg.norm(q - p)
            d = (q - p) / length
            force = (8e5 * (length - 0.5) + 4e4 * (w - v) @ d) * d
            wrench[i] += np.concatenate([force, np.cross(a, force)])
            wrench[j] -= np.concatenate([force, np.cross(b, force)])

    system.forces = springs
    w = np.array([0, 0, float(spin)])
    pose = system.run([(np.cross(w, np.array(b[2])), w) for b in bodies], end, 1e-12)
    return [pose[1][0][2], pose[0][3][2]]


def governor():
    """First by Radau IIA with 8 stages for (alpha, s) and a constant momentum; then by Gauss with 9 stages for (phi, alpha, s), on another mesh."""
    def reduced(y):
        alpha, s, da, ds, momentum, phi = y
        spin = momentum / governor_terms(alpha, s)[0]
        a, b, _ = governor_rates(alpha, s, da, ds, spin)
        return [da, ds, a, b, Q(0), spin]

    def full(y):
        phi, alpha, s, dphi, da, ds = y
        a, b, c = governor_rates(alpha, s, da, ds, dphi)
        return [dphi, da, ds, c, a, b]

    def mesh(start, end, first, factor, largest):
        found, h = [Q(start)], Q(first)
        while found[-1] < end:
            found.append(min(Q(end), found[-1] + h))
            h = min(h * Q(factor), Q(largest))
        return found

    result = dict(GOVERNOR)
    for name, spin in (("0.16 revolutions per second", 2 * PI * Q("0.16")), ("1 revolution per second", 2 * PI)):
        alpha, s = PI / 6, Q("0.5")
        one, two = [alpha, s, Q(0), Q(0), spin * governor_terms(alpha, s)[0], Q(0)], [Q(0), alpha, s, spin, Q(0), Q(0)]
        states, first = [], "1e-5"
        for start, t in ((Q(0), Q("0.01")), (Q("0.01"), Q(1)), (Q(1), Q(10))):
            one = collocated(reduced, one, mesh(start, t, first, "1.5", "0.02"), 8, "radau")
            two = collocated(full, two, mesh(start, t, first, "1.4", "0.015"), 9, "gauss")
            first = "1e-3"
            found = [one[5], one[0], one[1], one[4] / governor_terms(one[0], one[1])[0], one[2], one[3]], two
            if t < 1:
                near([found[0][2], found[0][3]], [float(x) for x in governor_check(spin, t)], 1e-8)
            keys = ("shaft_angle", "rod_angle", "slider_height", "shaft_rate", "rod_rate", "slider_velocity")
            states.append({"time": text(t).rstrip("0").rstrip("."), **dict(zip(keys, text(found[0]))), "digits": digits(*found)})
        result[name] = {"shaft_rate": text(spin), "states": states}
    return result
