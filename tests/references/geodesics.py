"""Geodesics between two points, as references of tests.

On the ellipsoid WGS84: GeographicLib (C. Karney, J. Geodesy 87 (2013) 43-55). On Schwarzschild's spacetime of mass 1
in the equatorial plane: SciPy's collocation solve_bvp, on equations that are written here.

Run with numpy, scipy and geographiclib:  python tests/references/geodesics.py
"""

from math import atan, degrees, pi, sqrt, tan

import numpy as np
from geographiclib.geodesic import Geodesic
from scipy.integrate import solve_bvp, solve_ivp

earth = Geodesic.WGS84
latitudes = [40.6, 51.6]
found = earth.Inverse(latitudes[0], -73.8, latitudes[1], -0.5)
reduced = [atan((1 - earth.f) * tan(x * pi / 180)) for x in latitudes]
print("WGS84: a, b =", earth.a, earth.a * (1 - earth.f))
print("  reduced latitudes", *map(repr, reduced), "longitudes", repr(-73.8 * pi / 180), repr(-0.5 * pi / 180))
print("  length", repr(found["s12"]), "azimuth", repr(found["azi1"]))


def slope(_, y):
    t, r, phi, vt, vr, vphi = y
    f = 1 - 2 / r
    return np.array(
        [
            vt,
            vr,
            vphi,
            -2 / (r**2 * f) * vt * vr,
            -f / r**2 * vt**2 + vr**2 / (r**2 * f) + r * f * vphi**2,
            -2 / r * vr * vphi,
        ]
    )


start, end = np.array([0, 10, 0.0]), np.array([60, 12, 1.2])
ends = lambda a, b: np.concatenate([a[:3] - start, b[:3] - end])
s = np.linspace(0, 1, 200)
guess = np.concatenate([start[:, None] + np.outer(end - start, s), np.outer(end - start, np.ones_like(s))])
solution = solve_bvp(slope, ends, s, guess, tol=1e-10, max_nodes=100000)
t, r, phi, vt, vr, vphi = solution.y[:, 0]
square = -(1 - 2 / r) * vt**2 + vr**2 / (1 - 2 / r) + r**2 * vphi**2
print("Schwarzschild:", solution.message)
print("  velocity", [repr(float(x)) for x in (vt, vr, vphi)], "proper time", repr(float(sqrt(-square))))
check = solve_ivp(slope, (0, 1), solution.y[:, 0], method="DOP853", rtol=1e-13, atol=1e-13)
print("  DOP853 from this velocity misses the end by", abs(check.y[:3, -1] - end).max())
