"""D. Stewart's platform with six legs of two bodies: on springs with dampers, and driven by motors.

The equations are those of the platform alone, to which each leg adds the force of its spherical joint: a linear function of the
acceleration of the joint, by the principle of virtual power in the three coordinates of the leg."""
import mpmath as mp
import numpy as np
from gmpy2 import acos, atan2, cos, mpfr as Q, sin, sqrt

import maximal
from initial_value import extrapolated
from mechanism.numbers import G, cross, digits, dot, near, plus, solved, text, times

ZERO, ONE = Q(0), Q(1)
HALF = [(("2", "0.3"), ("0.7", "0.7")), (("-0.7", "2"), ("0.35", "1")), (("-1.3", "1.6"), ("-1", "0.2"))]
STEWART = {  # points of the legs on the ground and on the platform; the other three are their reflections in y = 0
    "height": "2", "stiffness": "4e5", "damping": "2000", "rests": ["0.2", "0", "-0.1", "0", "0", "0"], "rotation": "0.1",
    "rates": ["3", "4", "5", "6", "7", "8"],
    "platform": [("cylinder", "400", ("1.2", "0.2"), ("0", "0", "2")), ("box", "600", ("1.6", "1.2", "1.5"), ("0.1", "0", "2.8"))],
    "lower": {"mass": "60", "radius": "0.08"}, "upper": {"mass": "30", "radius": "0.05"},
}
UNIT = [[ONE, ZERO, ZERO], [ZERO, ONE, ZERO], [ZERO, ZERO, ONE]]
DOWN = [ZERO, ZERO, -G]


def matrix_times(matrix, vector):
    return [dot(row, vector) for row in matrix]


class Leg:
    """A lower body, which rotates about x and then about an axis that is y at the start, and an upper body, which slides along it."""

    def __init__(self, ground, platform):
        self.ground, self.tip = ground, platform
        self.home = plus(platform, times(-1, ground))
        self.length = sqrt(dot(self.home, self.home))
        unit = times(1 / self.length, self.home)
        self.bodies = []  # the mass, the inertia about the centre, and the centre, from the ground or from the tip
        for name, part in (("lower", Q("0.3")), ("upper", Q("-0.3"))):
            m, r = Q(STEWART[name]["mass"]), Q(STEWART[name]["radius"])
            along, across = m * r**2 / 2, m * (3 * r**2 + (Q("0.6") * self.length) ** 2) / 12
            inertia = [[across * (i == j) + (along - across) * unit[i] * unit[j] for j in range(3)] for i in range(3)]
            self.bodies.append((m, inertia, times(part, self.home)))

    def angles(self, u):
        """R_x(alpha) R_y(beta) home is along u."""
        a, b, c = times(1 / self.length, self.home)
        size = sqrt(a**2 + c**2)
        beta = atan2(c, a) - acos(u[0] / size)
        return atan2(u[2], u[1]) - atan2(-a * sin(beta) + c * cos(beta), b), beta

    def state(self, p, dp):
        """The length and its rate, the direction, the rotation and the columns of the Jacobian of p in alpha, beta and the length, with their rates."""
        d = plus(p, times(-1, self.ground))
        length = sqrt(dot(d, d))
        u = times(1 / length, d)
        alpha, beta = self.angles(u)
        (sa, ca), (sb, cb) = (sin(alpha), cos(alpha)), (sin(beta), cos(beta))
        rotation = [[cb, ZERO, sb], [sa * sb, ca, -sa * cb], [-ca * sb, sa, ca * cb]]
        second = [ZERO, ca, sa]
        columns = [cross(UNIT[0], d), cross(second, d), u]
        rates = [v[0] for v in solved([list(row) for row in zip(*columns)], [[v] for v in dp])]
        return length, rates, u, rotation, second, columns

    def force(self, state, actuator, acceleration):
        """The force on the tip, with a thrust along the leg, if the tip has an acceleration."""
        length, (da, db, dl), u, rotation, second, columns = state
        w = plus(times(da, UNIT[0]), times(db, second))
        du = cross(w, u)
        # the acceleration of the tip without second derivatives of the coordinates
        turn = times(da * db, cross(UNIT[0], second))
        bias = plus(times(length, plus(cross(turn, u), cross(w, du))), times(2 * dl, du))
        right = plus(acceleration, times(-1, bias))
        dda, ddb, _ = [v[0] for v in solved([list(row) for row in zip(*columns)], [[v] for v in right])]
        dw = plus(times(dda, UNIT[0]), times(ddb, second), turn)
        powers = [ZERO, ZERO, -actuator]
        transposed = [list(column) for column in zip(*rotation)]
        for (m, inertia, centre), of_ground in zip(self.bodies, (True, False)):
            arm = matrix_times(rotation, centre)
            relative = plus(cross(dw, arm), cross(w, cross(w, arm)))
            a = relative if of_ground else plus(acceleration, relative)
            own = matrix_times(transposed, w)
            moment = plus(cross(own, matrix_times(inertia, own)), matrix_times(inertia, matrix_times(transposed, dw)))
            load, moment = times(m, plus(a, times(-1, DOWN))), matrix_times(rotation, moment)
            place = arm if of_ground else plus(times(length, u), arm)
            about = plus(moment, cross(place, load))
            powers = [powers[0] + about[0], powers[1] + dot(second, about), powers[2] + (ZERO if of_ground else dot(u, load))]
        found = [v[0] for v in solved([list(c) for c in columns], [[v] for v in powers])]
        return found


class Platform:
    """The platform, with its mass, its inertia about its centre and its centre."""

    def __init__(self):
        height = Q(STEWART["height"])
        points = [[[Q(v) for v in b] + [ZERO], [Q(v) for v in p] + [height]] for b, p in HALF]
        flip = lambda v: [v[0], -v[1], v[2]]
        points += [[flip(b), flip(p)] for b, p in reversed(points)]
        self.legs = [Leg(b, p) for b, p in points]
        parts = []
        for shape, m, size, at in STEWART["platform"]:
            m, size, at = Q(m), [Q(v) for v in size], [Q(v) for v in at]
            if shape == "box":
                squares = [v**2 for v in size]
                moments = [m * (sum(squares) - v) / 12 for v in squares]
            else:
                r, h = size
                moments = [m * (3 * r**2 + h**2) / 12] * 2 + [m * r**2 / 2]
            parts.append((m, moments, at))
        self.mass = sum(m for m, _, _ in parts)
        self.centre = times(1 / self.mass, plus(*(times(m, at) for m, _, at in parts)))
        self.inertia = [[ZERO] * 3 for _ in range(3)]
        for m, moments, at in parts:
            off = plus(at, times(-1, self.centre))
            for i in range(3):
                for j in range(3):
                    self.inertia[i][j] += (moments[i] + m * dot(off, off)) * (i == j) - m * off[i] * off[j]
        self.arms = [plus(leg.tip, times(-1, self.centre)) for leg in self.legs]

    def tips(self, x, rotation, v, w):
        """The states of the legs, with the arms of the tips."""
        found = []
        for leg, arm in zip(self.legs, self.arms):
            arm = matrix_times(rotation, arm)
            found.append((arm, leg.state(plus(x, arm), plus(v, cross(w, arm)))))
        return found

    def wrench(self, states, thrusts, rotation, w, a, dw):
        """What is left of the balance of force and moment of the platform."""
        force = times(self.mass, plus(DOWN, times(-1, a)))
        transposed = [list(column) for column in zip(*rotation)]
        own, down = matrix_times(transposed, w), matrix_times(transposed, dw)
        moment = plus(cross(own, matrix_times(self.inertia, own)), matrix_times(self.inertia, down))
        moment = times(-1, matrix_times(rotation, moment))
        for leg, (arm, state), thrust in zip(self.legs, states, thrusts):
            f = leg.force(state, thrust, plus(a, cross(dw, arm), cross(w, cross(w, arm))))
            force, moment = plus(force, times(-1, f)), plus(moment, times(-1, cross(arm, f)))
        return force + moment

    def on_springs(self, y, rests=STEWART["rests"]):
        x, v, w = y[:3], y[12:15], y[15:18]
        rotation = [y[3:6], y[6:9], y[9:12]]
        states = self.tips(x, rotation, v, w)
        stiffness, damping = Q(STEWART["stiffness"]), Q(STEWART["damping"])
        thrusts = [-stiffness * (state[0] - leg.length - Q(rest)) - damping * state[1][2]
                   for leg, (_, state), rest in zip(self.legs, states, rests)]
        none = [ZERO] * 3
        bias = self.wrench(states, thrusts, rotation, w, none, none)
        columns = [self.wrench(states, thrusts, rotation, w, UNIT[k] if k < 3 else none, UNIT[k - 3] if k >= 3 else none) for k in range(6)]
        matrix = [[columns[k][i] - bias[i] for k in range(6)] for i in range(6)]
        found = [row[0] for row in solved(matrix, [[-b] for b in bias])]
        turned = [cross(w, list(column)) for column in zip(*rotation)]
        return v + [turned[j][i] for i in range(3) for j in range(3)] + found

    def start(self):
        return self.centre + sum(UNIT, []) + [ZERO] * 6

    def eigenvalues(self, h):
        """The eigenvalues at the equilibrium without extensions, by central differences of order 4, sorted; the equilibrium is found by Newton's method."""
        x, rotation = self.centre, UNIT

        def acceleration(step, rates):
            y = plus(x, step[:3]) + sum(turned(step[3:], rotation), []) + rates
            return self.on_springs(y, ["0"] * 6)[12:]

        def slopes(of):
            columns = []
            for k in range(6):
                at = lambda c: of([c * h if i == k else ZERO for i in range(6)])
                columns.append([(8 * (a - b) - (c - d)) / (12 * h) for a, b, c, d in zip(at(1), at(-1), at(2), at(-2))])
            return [list(row) for row in zip(*columns)]

        none = [ZERO] * 6
        for _ in range(60):
            stiff = slopes(lambda step: acceleration(step, none))
            step = [v[0] for v in solved(stiff, [[-a] for a in acceleration(none, none)])]
            x, rotation = plus(x, step[:3]), turned(step[3:], rotation)
            if max(abs(v) for v in step) < Q("1e-33"):
                break
        else:
            raise ArithmeticError("no convergence")
        stiff, damp = slopes(lambda step: acceleration(step, none)), slopes(lambda rates: acceleration(none, rates))
        companion = mp.zeros(12)
        for i in range(6):
            companion[i, i + 6] = 1
            for j in range(6):
                companion[i + 6, j], companion[i + 6, j + 6] = mp.mpf(str(stiff[i][j])), mp.mpf(str(damp[i][j]))
        found = mp.eig(companion, left=False, right=False)
        return sorted(([mp.re(v), mp.im(v)] for v in found), key=lambda v: (round(v[0], 12), v[1]))

    def motors(self, t):
        """The pose at which the legs have prescribed lengths, by Newton's method, its rates, and the thrusts of the motors."""
        size = Q(STEWART["rotation"])
        rates = [Q(v) for v in STEWART["rates"]]
        lengths = [leg.length + size * sin(w * t) for leg, w in zip(self.legs, rates)]
        x, rotation = self.centre, UNIT
        none = [ZERO] * 3
        for _ in range(60):
            states = self.tips(x, rotation, none, none)
            rows = [state[2] + cross(arm, state[2]) for arm, state in states]
            step = [v[0] for v in solved(rows, [[goal - state[0]] for goal, (_, state) in zip(lengths, states)])]
            x, rotation = plus(x, step[:3]), turned(step[3:], rotation)
            if max(abs(v) for v in step) < Q("1e-36"):
                break
        else:
            raise ArithmeticError("no convergence")
        rows = [state[2] + cross(arm, state[2]) for arm, state in self.tips(x, rotation, none, none)]
        speeds = [v[0] for v in solved(rows, [[size * w * cos(w * t)] for w in rates])]
        v, w = speeds[:3], speeds[3:]
        states = self.tips(x, rotation, v, w)
        right = []
        for (arm, (length, (_, _, dl), u, *_)), rate in zip(states, rates):
            dp = plus(v, cross(w, arm))
            right.append([-size * rate**2 * sin(rate * t) - dot(u, cross(w, cross(w, arm))) - (dot(dp, dp) - dl**2) / length])
        speeds = [r[0] for r in solved(rows, right)]
        none = [ZERO] * 6
        bias = self.wrench(states, none, rotation, w, speeds[:3], speeds[3:])
        columns = [self.wrench(states, [ONE if i == k else ZERO for i in range(6)], rotation, w, speeds[:3], speeds[3:]) for k in range(6)]
        matrix = [[columns[k][i] - bias[i] for k in range(6)] for i in range(6)]
        thrusts = [row[0] for row in solved(matrix, [[-b] for b in bias])]
        return x, rotation, v, w, thrusts, states

    def energy(self, t):
        """The kinetic and potential energy of the driven platform, by the velocities of all centres."""
        x, rotation, v, w, _, states = self.motors(t)
        own = matrix_times([list(column) for column in zip(*rotation)], w)
        total = self.mass * (dot(v, v) / 2 + G * x[2]) + dot(own, matrix_times(self.inertia, own)) / 2
        for leg, (arm, (length, (da, db, dl), u, turn, second, _)) in zip(self.legs, states):
            spin = plus(times(da, UNIT[0]), times(db, second))
            own = matrix_times([list(column) for column in zip(*turn)], spin)
            for (m, inertia, centre), base, speed in zip(leg.bodies, (leg.ground, plus(x, arm)), ([ZERO] * 3, plus(v, cross(w, arm)))):
                off = matrix_times(turn, centre)
                speed = plus(speed, cross(spin, off))
                total += m * (dot(speed, speed) / 2 + G * (base[2] + off[2])) + dot(own, matrix_times(inertia, own)) / 2
        return total


def turned(step, rotation):
    """The rotation matrix after a small rotation, by Rodrigues' formula."""
    angle = sqrt(dot(step, step))
    if angle == 0:
        return rotation
    axis = times(1 / angle, step)
    columns = [plus(times(cos(angle), c), times(sin(angle), cross(axis, c)), times((1 - cos(angle)) * dot(axis, c), axis)) for c in map(list, zip(*rotation))]
    return [list(row) for row in zip(*columns)]


def stewart_check(platform, end):
    """The platform on springs with 13 bodies and multipliers, in double precision: its centre and its angular velocity."""
    array = lambda v: np.array(v, dtype=float)
    bodies = [(platform.mass, platform.inertia, platform.centre)]
    for leg in platform.legs:
        (m, inertia, off), (n, other, back) = leg.bodies
        bodies += [(m, inertia, plus(leg.ground, off)), (n, other, plus(leg.tip, back))]
    system = maximal.System(bodies, [0, 0, -float(G)])
    for k, leg in enumerate(platform.legs):
        lower, upper, along = 2 * k + 1, 2 * k + 2, array(leg.home) / float(leg.length)
        system.point(-1, lower, leg.ground)
        system.orthogonal(-1, lower, [1, 0, 0], [0, 1, 0])
        first, second = maximal.perpendicular(along)
        for a, b in ((first, second), (along, first), (along, second)):
            system.orthogonal(lower, upper, a, b)
        system.slide(lower, upper, leg.tip, along)
        system.point(upper, 0, leg.tip)

    def springs(pose, wrench):
        for k, (leg, rest) in enumerate(zip(platform.legs, STEWART["rests"])):
            lower, upper = 2 * k + 1, 2 * k + 2
            tip, arm, velocity, _ = system.place(pose, upper, array(leg.tip))
            d = tip - array(leg.ground)
            length = np.linalg.norm(d)
            d, speed = d / length, d @ velocity / length
            force = (-float(STEWART["stiffness"]) * (length - float(leg.length) - float(rest)) - float(STEWART["damping"]) * speed) * d
            wrench[upper] += np.concatenate([force, np.cross(arm, force)])
            wrench[lower] -= np.concatenate([force, np.cross(array(leg.ground) - pose[lower][0], force)])

    system.forces = springs
    pose = system.run([(np.zeros(3), np.zeros(3))] * 13, end, 1e-11)[0]
    return list(pose[0]) + list(pose[3])


def stewart():
    """On springs with different steps, and with motors: their power is the rate of the energy."""
    platform = Platform()
    names = ("centre", "rotation", "velocity", "angular_velocity")
    states, one, two, before = [], platform.start(), platform.start(), ZERO
    for end, steps in (("0.25", 10), ("1", 30)):
        span = Q(end) - before
        one, two, before = extrapolated(platform.on_springs, one, span, steps), extrapolated(platform.on_springs, two, span, steps * 3 // 2, 11), Q(end)
        if end == "0.25":
            near(one[:3] + one[15:], [float(v) for v in stewart_check(platform, 0.25)], 1e-8)
        parts = [one[:3], one[3:12], one[12:15], one[15:]]
        states.append({"time": end, **dict(zip(names, text(parts))), "digits": digits(one, two)})
    driven = []
    for end in ("0.5", "2"):
        t, h = Q(end), Q("1e-4")
        x, rotation, v, w, thrusts, legs = platform.motors(t)
        power = sum(f * state[1][2] for f, (_, state) in zip(thrusts, legs))
        # central differences of order 8
        weights = [(1, Q(4) / 5), (2, -Q(1) / 5), (3, Q(4) / 105), (4, -Q(1) / 280)]
        rate = sum(c * (platform.energy(t + k * h) - platform.energy(t - k * h)) for k, c in weights) / h
        parts = [x, sum(rotation, []), v, w]
        driven.append({"time": end, **dict(zip(names, text(parts))), "thrusts": text(thrusts), "digits": digits([power], [rate])})
    one, two = (platform.eigenvalues(Q(h)) for h in ("1e-7", "3e-8"))
    eigenvalues = {"values": text(one), "digits": digits(*([[Q(str(x)) for x in z] for z in values] for values in (one, two)))}
    return {"parameters": STEWART, "springs": states, "motors": driven, "equilibrium": eigenvalues}
