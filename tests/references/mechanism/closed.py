"""Problems A01 and A02 of the IFToMM library, in elliptic functions, and again by extrapolation."""
import mpmath as mp
from gmpy2 import cos, mpfr as Q, sin, sqrt

from initial_value import extrapolated
from mechanism.numbers import G, PI, digits, near, text


def jacobi(u, m):
    """sn, cn, dn."""
    return [Q(mp.nstr(mp.ellipfun(kind, u, m), 42)) for kind in ("sn", "cn", "dn")]


def pendulum():
    """A mass of 1 kg at 1 m, released at (1, 0); psi from the vertical below: sin(psi/2) = k sn(K - w t, k), with k^2 = 1/2."""
    def closed(t):
        m, w = mp.mpf(1) / 2, mp.sqrt(mp.mpf("9.81"))
        sn, cn, dn = jacobi(mp.ellipk(m) - w * t, m)
        sine, cosine, rate = sqrt(Q("0.5")) * sn, dn, -2 * sqrt(Q("0.5") * G) * cn  # sine and cosine of psi/2
        return [[2 * sine * cosine, 2 * sine**2 - 1], [rate * (1 - 2 * sine**2), rate * 2 * sine * cosine]]

    def steps(end, count):
        psi, rate = extrapolated(lambda y: [y[1], -G * sin(y[0])], [PI / 2, Q(0)], end, count)
        return [[sin(psi), -cos(psi)], [rate * cos(psi), rate * sin(psi)]]

    return {"length": "1", "mass": "1", "states": [
        {"time": str(t), "position": text(closed(t)[0]), "velocity": text(closed(t)[1]), "digits": digits(closed(t), steps(t, 30 * t))} for t in (1, 10)]}


def windows():
    """N windows of levers and couplers of 1 m and 1 kg. All levers are parallel, so that theta'' = f g sin(theta), and with theta(0) = 0 and
    theta'(0) = 1 sin(theta/2) = sn(t/2, m), m = -4 f g."""
    found = {}
    for n in (2, 40, 400, 4000):
        factor = (Q(n + 1) / 2 + n) / (Q(n + 1) / 3 + n)
        states = []
        for t in (1, 10):
            k = mp.mpf(str(1 + 4 * factor * G))  # the transformation of the modulus: sn(u | 1 - k) = sd(sqrt(k) u | 1 - 1/k) / sqrt(k)
            sn, cn, dn = jacobi(mp.sqrt(k) * t / 2, 1 - 1 / k)
            sine, cosine = sn / dn / sqrt(1 + 4 * factor * G), cn / dn
            rate = sqrt(1 + 4 * factor * G * sine**2)
            closed = [[2 * sine * cosine, 1 - 2 * sine**2], [rate * (1 - 2 * sine**2), -rate * 2 * sine * cosine]]
            angle, speed = extrapolated(lambda y: [y[1], factor * G * sin(y[0])], [Q(0), Q(1)], t, 40 * t)
            again = [[sin(angle), cos(angle)], [speed * cos(angle), -speed * sin(angle)]]
            count = digits(closed, again)
            states.append({"time": str(t), "angle": text(angle), "rate": text(rate), "position": text(closed[0]), "velocity": text(closed[1]), "digits": count})
        found[str(n)] = {"factor": text(factor), "states": states}
    near([Q(v) for key in ("position", "velocity") for v in found["2"]["states"][1][key]],
         ["0.328458111540815", "0.944518538178601", "1.42305147020694", "-0.494868845487043"], 1e-14)
    return found
