"""The snakeboard of Ostrowski, Lewis, Murray and Burdick (ICRA 1994), with motors for the rotor and for both axles."""
from gmpy2 import cos, mpfr as Q, sin, sqrt, tan

from initial_value import extrapolated
from mechanism.numbers import PI, digits, solved, text

SNAKEBOARD = {"l": "0.2", "board": "2", "rotor": "3", "axle": "0.5", "rotor_amplitude": "0.7", "axle_amplitude": "0.3"}


def snakeboard_masses():
    """The mass, the moments of inertia about the centre of the whole and of the rotor, and l: a box 3l x l, a box l/4 x 2l, two rods of length l at a distance of l."""
    l, board, rotor, axle = (Q(SNAKEBOARD[key]) for key in ("l", "board", "rotor", "axle"))
    of_rotor = rotor * ((l / 4) ** 2 + (2 * l) ** 2) / 12
    whole = board * (9 * l**2 + l**2) / 12 + of_rotor + 2 * axle * (l**2 / 12 + l**2)
    return board + rotor + 2 * axle, whole, of_rotor, l


def snakeboard_motors(t, rates):
    """The angle of the rotor, with two derivatives, and the angle of the front axle, with its derivative. The back axle has the opposite angle."""
    a, b, p, q = Q(SNAKEBOARD["rotor_amplitude"]), Q(SNAKEBOARD["axle_amplitude"]), *map(Q, rates)
    return a * sin(p * t), a * p * cos(p * t), -a * p**2 * sin(p * t), b * sin(q * t), b * q * cos(q * t)


def snakeboard_reduced(rates, end, steps):
    """The board moves along itself with the speed u and turns with the rate u tan(phi)/l. With M = m + J tan(phi)^2/l^2, the balance of momentum along this
    direction is (sqrt(M) u)' = -J_r tan(phi) psi''/(l sqrt(M)), an integral over time."""
    m, whole, rotor, l = snakeboard_masses()

    def speed(t, p):
        _, _, ddpsi, phi, dphi = snakeboard_motors(t, rates)
        size = sqrt(m + whole * (tan(phi) / l) ** 2)
        return p / size, tan(phi) / l, size, ddpsi, dphi / cos(phi) ** 2 / l

    def f(y):
        t, p, theta, _, _ = y
        u, slope, size, ddpsi, _ = speed(t, p)
        return [Q(1), -rotor * slope * ddpsi / size, u * slope, u * cos(theta), u * sin(theta)]

    t, p, theta, x, y = extrapolated(f, [Q(0)] * 5, end, steps)
    u, slope, size, ddpsi, dslope = speed(t, p)
    du = -slope * (rotor * ddpsi + whole * u * dslope) / size**2
    return [x, y, theta, u * cos(theta), u * sin(theta), u * slope, rotor * (du * slope + u * dslope + ddpsi)]


def snakeboard_multipliers(rates, end, steps):
    """By the equations for x, y, theta and the forces of the wheels across each axle."""
    m, whole, rotor, l = snakeboard_masses()

    def acceleration(t, theta, dx, dy, dtheta):
        _, _, ddpsi, phi, dphi = snakeboard_motors(t, rates)
        rows, right = [], []
        for side in (1, -1):
            # across the axle at side*l, of the direction theta + side*phi; the velocity of its centre is zero there
            angle, rate = theta + side * phi, dtheta + side * dphi
            rows.append([-sin(angle), cos(angle), side * l * cos(phi)])
            right.append((cos(angle) * dx + sin(angle) * dy) * rate + side * l * sin(phi) * dphi * dtheta)
        a, b = rows
        zero = Q(0)
        matrix = [[m, zero, zero, -a[0], -b[0]], [zero, m, zero, -a[1], -b[1]], [zero, zero, whole, -a[2], -b[2]], a + [zero, zero], b + [zero, zero]]
        found = solved(matrix, [[v] for v in [zero, zero, -rotor * ddpsi] + right])
        return [v[0] for v in found[:3]], ddpsi

    def f(y):
        t, _, _, theta, dx, dy, dtheta = y
        return [Q(1), dx, dy, dtheta] + acceleration(t, theta, dx, dy, dtheta)[0]

    t, x, y, theta, dx, dy, dtheta = extrapolated(f, [Q(0)] * 7, end, steps)
    (_, _, ddtheta), ddpsi = acceleration(t, theta, dx, dy, dtheta)
    return [x, y, theta, dx, dy, dtheta, rotor * (ddtheta + ddpsi)]


def snakeboard():
    """Three gaits from rest, for five periods: forwards, rotation, and sideways."""
    gaits = {}
    for name, rates in (("drive", (1, 1)), ("rotate", (2, 1)), ("park", (3, 2))):
        states = []
        for end, count in (("5", 40), ("10*pi", 240)):
            t = 10 * PI if "pi" in end else Q(end)
            one, two = snakeboard_reduced(rates, t, count), snakeboard_multipliers(rates, t, count * 5 // 4)
            keys = ("x", "y", "angle", "x_rate", "y_rate", "angle_rate", "rotor_torque")
            states.append({"time": text(t), **dict(zip(keys, text(one))), "digits": digits(one, two)})
        gaits[name] = {"rotor_rate": str(rates[0]), "axle_rate": str(rates[1]), "states": states}
    return {"parameters": SNAKEBOARD, "gaits": gaits}
