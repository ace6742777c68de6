"""Multibody systems with six coordinates for each body and one multiplier for each constraint, in double precision.

For checks of references that reduce a mechanism to few coordinates: no reduction is used here. All vectors are spatial and refer to the
initial position, in which every rotation matrix is 1. Accelerations solve the equations of motion together with the second
derivatives of the constraints; redundant constraints have the multipliers of least norm. The method is DOP853.
"""
import numpy as np
from scipy.integrate import solve_ivp


def perpendicular(axis):
    """Two vectors that span the plane orthogonal to the axis."""
    first = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    return first, np.cross(axis, first)


class System:
    """Bodies (mass, inertia about the centre, centre), constraints and a field of forces; body -1 is the ground."""

    def __init__(self, bodies, gravity):
        self.mass = [float(b[0]) for b in bodies]
        self.inertia = [np.array(b[1], dtype=float) for b in bodies]
        self.centre = [np.array(b[2], dtype=float) for b in bodies]
        self.gravity, self.rows, self.forces = np.array(gravity, dtype=float), [], lambda pose, wrench: None

    def point(self, i, j, at, directions=np.eye(3)):
        """The points of bodies i and j that start at `at` agree, in the given directions of the ground."""
        at = np.array(at, dtype=float)
        self.rows += [("point", i, j, at, np.array(d, dtype=float)) for d in directions]

    def orthogonal(self, i, j, a, b):
        """The vector a of body i stays orthogonal to the vector b of body j."""
        self.rows.append(("orthogonal", i, j, np.array(a, dtype=float), np.array(b, dtype=float)))

    def slide(self, i, j, at, axis):
        """The point of body j that starts at `at` stays on a line of body i along the axis."""
        at = np.array(at, dtype=float)
        self.rows += [("slide", i, j, at, d) for d in perpendicular(np.array(axis, dtype=float))]

    def revolute(self, i, j, at, axis):
        self.point(i, j, at)
        for d in perpendicular(np.array(axis, dtype=float)):
            self.orthogonal(i, j, axis, d)

    def unpack(self, y):
        """The centre, rotation, velocity and angular velocity of each body."""
        return [(p[:3], p[3:12].reshape(3, 3), p[12:15], p[15:18]) for p in y.reshape(-1, 18)]

    def place(self, pose, i, at):
        """Position, arm, velocity and acceleration by rotation of the point of body i that started at `at`."""
        if i < 0:
            return at, np.zeros(3), np.zeros(3), np.zeros(3)
        x, r, v, w = pose[i]
        arm = r @ (at - self.centre[i])
        return x + arm, arm, v + np.cross(w, arm), np.cross(w, np.cross(w, arm))

    def rate(self, t, y):
        pose, n = self.unpack(y), len(self.mass)
        inverse, wrench = np.zeros((6 * n, 6 * n)), np.zeros((n, 6))
        for i, (x, r, v, w) in enumerate(pose):
            inertia = r @ self.inertia[i] @ r.T
            inverse[6*i:6*i+3, 6*i:6*i+3] = np.eye(3) / self.mass[i]
            inverse[6*i+3:6*i+6, 6*i+3:6*i+6] = np.linalg.inv(inertia)
            wrench[i, :3] += self.mass[i] * self.gravity
            wrench[i, 3:] -= np.cross(w, inertia @ w)
        self.forces(pose, wrench)
        rows, bias = np.zeros((len(self.rows), 6 * n)), np.zeros(len(self.rows))
        for k, (kind, i, j, a, b) in enumerate(self.rows):
            if kind == "point":
                for body, sign in ((i, -1), (j, 1)):
                    if body >= 0:
                        _, arm, _, turning = self.place(pose, body, a)
                        rows[k, 6*body:6*body+3] += sign * b
                        rows[k, 6*body+3:6*body+6] += sign * np.cross(arm, b)
                        bias[k] += sign * b @ turning
            elif kind == "slide":
                (p, arm, dp, ap), (q, other, dq, aq) = self.place(pose, i, a), self.place(pose, j, a)
                w, u, off = pose[i][3], pose[i][1] @ b, q - p
                du, speed = np.cross(w, u), dq - dp
                rows[k, 6*i:6*i+6] += np.concatenate([-u, np.cross(u, off) - np.cross(arm, u)])
                rows[k, 6*j:6*j+6] += np.concatenate([u, np.cross(other, u)])
                bias[k] += u @ (aq - ap) + 2 * du @ speed + np.cross(w, du) @ off
            else:
                zero, one = np.zeros(3), np.eye(3)
                (ra, wa), (rb, wb) = [(pose[body][1], pose[body][3]) if body >= 0 else (one, zero) for body in (i, j)]
                u, v = ra @ a, rb @ b
                du, dv = np.cross(wa, u), np.cross(wb, v)
                if i >= 0:
                    rows[k, 6*i+3:6*i+6] += np.cross(u, v)
                if j >= 0:
                    rows[k, 6*j+3:6*j+6] += np.cross(v, u)
                bias[k] += np.cross(wa, du) @ v + 2 * du @ dv + u @ np.cross(wb, dv)
        free = inverse @ wrench.ravel()
        multipliers = np.linalg.lstsq(rows @ inverse @ rows.T, -bias - rows @ free, rcond=1e-11)[0]
        acceleration = (free + inverse @ rows.T @ multipliers).reshape(n, 6)
        found = np.zeros((n, 18))
        for i, (x, r, v, w) in enumerate(pose):
            found[i, :3], found[i, 3:12] = v, np.cross(w, r.T).T.ravel()
            found[i, 12:15], found[i, 15:] = acceleration[i, :3], acceleration[i, 3:]
        return found.ravel()

    def run(self, velocities, end, tolerance=3e-14):
        """The poses at the end; velocities are pairs (velocity of the centre, angular velocity)."""
        y = np.concatenate([np.concatenate([c, np.eye(3).ravel(), v, w]) for c, (v, w) in zip(self.centre, velocities)])
        return self.unpack(solve_ivp(self.rate, (0, float(end)), y, method="DOP853", rtol=tolerance, atol=tolerance).y[:, -1])
