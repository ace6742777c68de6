#!/usr/bin/env python3
"""Motion of the arm tests/data/arm_seven.urdf by Pinocchio: accelerations, energies and a trajectory.

Pinocchio reads the file and computes `aba`; SciPy integrates the equations. The damping of the file and constant joint forces are
added by hand. Written to tests/data/arm_seven.json. Needs pin and scipy.

    python3 tests/references/urdf.py
"""
import json
from pathlib import Path

import numpy as np
import pinocchio as pin
from scipy.integrate import solve_ivp

DATA = Path(__file__).parent.parent / "data"
NAMES = ["axis1", "axis2", "axis3", "slide", "axis5", "axis6", "axis7"]

model = pin.buildModelFromUrdf(str(DATA / "arm_seven.urdf"))
model.gravity.linear = np.array([0.3, -0.4, -9.7])
data = model.createData()
assert list(model.names)[1:] == NAMES, list(model.names)
damping = np.array([0.5, 0.4, 0, 3, 0, 0, 0.05])
start = np.array([0.4, -0.7, 1.1, 0.15, -0.5, 0.8, 0.3])
rates = np.array([0.6, -0.9, 0.5, 0.3, 1.2, -1.5, 2.0])
force = np.array([3.0, -2.0, 1.0, 12.0, -0.5, 0.4, 0.1])


def configuration(angles):
    """The numbers of Pinocchio: a continuous joint has a cosine and a sine."""
    numbers = []
    for joint, angle in zip(model.joints[1:], angles):
        numbers += [angle] if joint.nq == 1 else [np.cos(angle), np.sin(angle)]
    return np.array(numbers)


def acceleration(q, v):
    return pin.aba(model, data, configuration(q), v, force - damping * v).copy()


def energies(q, v):
    numbers = configuration(q)
    return [pin.computeKineticEnergy(model, data, numbers, v), pin.computePotentialEnergy(model, data, numbers)]


def rate(_, y):
    return np.concatenate([y[7:], acceleration(y[:7], y[7:])])


def dynamics(q, v, a):
    """Joint forces for accelerations, the mass matrix, and the momentum about the origin."""
    numbers = configuration(q)
    forces = pin.rnea(model, data, numbers, v, a).copy()
    mass = pin.crba(model, data, numbers)
    mass = np.triu(mass) + np.triu(mass, 1).T
    own = pin.computeCentroidalMomentum(model, data, numbers, v)
    moment = own.angular + np.cross(data.com[0], own.linear)
    free = pin.aba(model, data, numbers, v, a).copy()
    return {"inverse": list(forces), "mass_matrix": mass.tolist(), "momentum": [*moment, *own.linear], "forward": list(free)}


times = [0.1, 0.25]
y0 = np.concatenate([start, rates])
solution = solve_ivp(rate, (0, times[-1]), y0, method="DOP853", rtol=1e-13, atol=1e-14, t_eval=times)
rows = []
for t, y in zip(solution.t, solution.y.T):
    rows.append({"t": t, "q": list(y[:7]), "v": list(y[7:]), "energies": energies(y[:7], y[7:])})


def tip(q):
    """The position of the tip in the ground frame."""
    pin.framesForwardKinematics(model, data, configuration(q))
    return list(data.oMf[model.getFrameId("tip")].translation)


result = {
    "program": f"Pinocchio {pin.__version__}",
    "names": NAMES,
    "gravity": list(model.gravity.linear),
    "coordinates": list(start),
    "rates": list(rates),
    "forces": list(force),
    "accelerations": list(acceleration(start, rates)),
    "energies": energies(start, rates),
    # the damping is not in these; the forces of `forward` have the numbers of the accelerations of `inverse`
    "dynamics": dynamics(start, rates, force),
    "tip": tip(start),
    "tip_at_zero": tip(np.zeros(7)),
    "rows": rows,
}
(DATA / "arm_seven.json").write_text(json.dumps(result, indent=1) + "\n")
