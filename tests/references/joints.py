#!/usr/bin/env python3
"""States of examples/motions/gyrostat.toml and double_pendulum.toml, by equations that use no group of the product.

The gyrostat: dH/dt = H x Omega in the body, dq/dt = q Omega/2, H = J Omega + I a (a . Omega + rho), with a constant momentum
I (a . Omega + rho) of the wheel. The pendulum: unit vectors along its two rods, with one multiplier each. Written to
tests/data/joints.json. Needs mpmath.

    python3 tests/references/joints.py
"""
import json
from pathlib import Path

import mpmath as mp

mp.mp.dps = 40


def extrapolated(f, y, end, steps):
    """Gragg's extrapolated midpoint rule: 14 columns on each of equal steps."""
    h = mp.mpf(end) / steps
    sequence = [2 * (k + 1) for k in range(14)]
    for _ in range(steps):
        table = []
        for k, n in enumerate(sequence):
            s = h / n
            before, now = y, [a + s * b for a, b in zip(y, f(y))]
            for _ in range(n - 1):
                before, now = now, [a + 2 * s * b for a, b in zip(before, f(now))]
            last = [(a + b + s * c) / 2 for a, b, c in zip(before, now, f(now))]
            row = [last]
            for j in range(k):
                ratio = (mp.mpf(n) / sequence[k - 1 - j]) ** 2 - 1
                row.append([a + (a - b) / ratio for a, b in zip(row[j], table[k - 1][j])])
            table.append(row)
        y = table[-1][-1]
    return y


def gyrostat():
    j, wheel = [mp.mpf(2), mp.mpf(3), mp.mpf("3.5")], mp.mpf("0.5")
    velocity, rate = [mp.mpf("0.1"), mp.mpf(1), mp.mpf("0.2")], mp.mpf(30)
    spin = wheel * (velocity[2] + rate)

    def f(y):
        w, x, b, c, *h = y
        o = [h[0] / j[0], h[1] / j[1], (h[2] - spin) / j[2]]
        q = [(-x * o[0] - b * o[1] - c * o[2]) / 2, (w * o[0] + b * o[2] - c * o[1]) / 2,
             (w * o[1] + c * o[0] - x * o[2]) / 2, (w * o[2] + x * o[1] - b * o[0]) / 2]
        return q + [h[1] * o[2] - h[2] * o[1], h[2] * o[0] - h[0] * o[2], h[0] * o[1] - h[1] * o[0]]

    start = [mp.cos(mp.mpf("0.15")), mp.sin(mp.mpf("0.15")), mp.mpf(0), mp.mpf(0)]
    start += [j[0] * velocity[0], j[1] * velocity[1], j[2] * velocity[2] + spin]
    return extrapolated(f, start, 20, 200)


def pendulum():
    length, m, g, r = mp.mpf(1), mp.mpf(2), mp.mpf("9.81"), mp.mpf("0.05")
    own = m * (3 * r**2 + length**2) / 12
    a, b, c = m * length**2 * 5 / 4 + own, m * length**2 / 2, m * length**2 / 4 + own
    pull = [-m * g * length * 3 / 2, -m * g * length / 2]
    dot = lambda x, y: sum(s * t for s, t in zip(x, y))

    def f(y):
        n1, n2, v1, v2 = y[:3], y[3:6], y[6:9], y[9:]
        # (a n1'' + b n2'', b n1'' + c n2'') = (pull1 z + x n1, pull2 z + y n2), and n . n'' = -n' . n'
        det, cos = a * c - b * b, dot(n1, n2)
        free1, free2 = (c * pull[0] - b * pull[1]) / det, (a * pull[1] - b * pull[0]) / det
        matrix = mp.matrix([[c / det, -b * cos / det], [-b * cos / det, a / det]])
        right = mp.matrix([-dot(v1, v1) - free1 * n1[2], -dot(v2, v2) - free2 * n2[2]])
        x, z = mp.lu_solve(matrix, right)
        up = [0, 0, 1]
        w1 = [free1 * e + (c * x * s - b * z * t) / det for e, s, t in zip(up, n1, n2)]
        w2 = [free2 * e + (a * z * t - b * x * s) / det for e, s, t in zip(up, n1, n2)]
        return v1 + v2 + w1 + w2

    tilt = mp.mpf("1.2")
    start = [mp.mpf(0), mp.sin(tilt), -mp.cos(tilt), mp.mpf(0), mp.mpf(0), mp.mpf(-1)]
    start += [mp.mpf("-0.5")] + [mp.mpf(0)] * 5
    return extrapolated(f, start, 4, 80)


def main():
    text = lambda state: [mp.nstr(x, 25) for x in state]
    data = {
        "gyrostat": {"time": "20", "quaternion": text(gyrostat()[:4]), "momentum": text(gyrostat()[4:])},
        "double_pendulum": {"time": "4", "directions": text(pendulum()[:6])},
    }
    path = Path(__file__).resolve().parents[1] / "data" / "joints.json"
    path.write_text(json.dumps(data, indent=1) + "\n")


if __name__ == "__main__":
    main()
