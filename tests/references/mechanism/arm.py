"""The arm of tests/data/arm.urdf: Newton and Euler's recursion in 42 digits, confirmed by Pinocchio."""
from pathlib import Path
from xml.etree import ElementTree

import mpmath as mp
import numpy as np

from mechanism.numbers import cross, text

DATA = Path(__file__).resolve().parents[2] / "data"


def arm_model():
    """Joints in the order of the file (kind, parent link, child link, origin, axis) and inertias (mass, centre, inertia about it in link axes)."""
    numbers = lambda s: [mp.mpf(x) for x in s.split()]

    def matrix(rpy):
        (sr, sp, sy), (cr, cp, cy) = [mp.sin(x) for x in rpy], [mp.cos(x) for x in rpy]
        return mp.matrix([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr], [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]])

    def origin(element):
        found = element.find("origin")
        place = lambda key: numbers(found.get(key, "0 0 0") if found is not None else "0 0 0")
        return mp.matrix(place("xyz")), matrix(place("rpy"))

    root = ElementTree.parse(DATA / "arm.urdf").getroot()
    joints = [(j.get("type"), j.find("parent").get("link"), j.find("child").get("link"), origin(j),
               mp.matrix(numbers(j.find("axis").get("xyz"))) if j.find("axis") is not None else None) for j in root.findall("joint")]
    links = {}
    for link in root.findall("link"):
        own = link.find("inertial")
        if own is not None:
            centre, turn = origin(own)
            v = {key: mp.mpf(value) for key, value in own.find("inertia").attrib.items()}
            inertia = mp.matrix([[v["ixx"], v["ixy"], v["ixz"]], [v["ixy"], v["iyy"], v["iyz"]], [v["ixz"], v["iyz"], v["izz"]]])
            links[link.get("name")] = mp.mpf(own.find("mass").get("value")), centre, turn * inertia * turn.T
    return joints, links


def arm_torques(model, q, v, a, gravity):
    """Newton and Euler's recursion in spatial vectors."""
    joints, links = model
    product = lambda x, y: mp.matrix(cross(list(x), list(y)))
    zero = mp.zeros(3, 1)
    state = {"base": (zero, mp.eye(3), zero, zero, -gravity)}  # position, rotation, w, w', acceleration of the origin
    loads, moving, k = [], [], 0
    for kind, parent, child, (place, turn), axis in joints:
        p, r, w, dw, acceleration = state[parent]
        arm = r * place
        acceleration = acceleration + product(dw, arm) + product(w, product(w, arm))
        p, r = p + arm, r * turn
        if kind != "fixed":
            along = r * axis / mp.norm(axis)
            moving.append((kind, along, p, child))
            if kind == "revolute":
                dw, w = dw + along * a[k] + product(w, along) * v[k], w + along * v[k]
                c, s = mp.cos(q[k]), mp.sin(q[k])
                r = mp.matrix([list(c * r[:, j] + s * product(along, r[:, j]) + (1 - c) * along * (along.T * r[:, j])[0]) for j in range(3)]).T
            else:
                shift = along * q[k]
                acceleration = acceleration + product(dw, shift) + product(w, product(w, shift)) + 2 * v[k] * product(w, along) + along * a[k]
                p = p + shift
            k += 1
        state[child] = p, r, w, dw, acceleration
        if child in links:
            mass, centre, inertia = links[child]
            arm, world = r * centre, r * inertia * r.T
            force = mass * (acceleration + product(dw, arm) + product(w, product(w, arm)))
            loads.append((child, p + arm, force, world * dw + product(w, world * w)))
    parents = {child: parent for _, parent, child, _, _ in joints}

    def behind(link, joint):
        return link == joint or (link in parents and behind(parents[link], joint))

    torques = []
    for kind, along, p, child in moving:
        total = mp.mpf(0)
        for link, at, force, moment in loads:
            if behind(link, child):
                total += (along.T * force)[0] if kind == "prismatic" else (along.T * (moment + product(at - p, force)))[0]
        torques.append(total)
    return torques


def arm():
    """Mass matrix, forward and inverse dynamics and torques of gravity by Newton and Euler's recursion in 42 digits, confirmed by Pinocchio."""
    import pinocchio
    built = pinocchio.buildModelFromUrdf(str(DATA / "arm.urdf"))
    model, data, down = arm_model(), built.createData(), mp.matrix([0, 0, -mp.mpf("9.81")])
    names = [name for name in built.names if name != "universe"]
    random = np.random.default_rng(20250)
    cases = []
    for _ in range(3):
        q, v, a, force = [[f"{x:.3f}" for x in scale * random.uniform(-1, 1, built.nv)] for scale in (1.5, 2, 3, 20)]
        exact = [[mp.mpf(x) for x in row] for row in (q, v, a, force)]
        zero, unit = [mp.mpf(0)] * built.nv, lambda k: [mp.mpf(i == k) for i in range(built.nv)]
        mass = mp.matrix([arm_torques(model, exact[0], zero, unit(k), mp.zeros(3, 1)) for k in range(built.nv)])
        weight = arm_torques(model, exact[0], zero, zero, down)
        inverse = arm_torques(model, *exact[:3], down)
        bias = arm_torques(model, *exact[:2], zero, down)
        forward = list(mp.lu_solve(mass, mp.matrix(exact[3]) - mp.matrix(bias)))
        rough = [np.array([float(x) for x in row]) for row in (q, v, a, force)]
        whole = pinocchio.crba(built, data, rough[0]).copy()
        whole = np.triu(whole) + np.triu(whole, 1).T
        peers = [whole, pinocchio.computeGeneralizedGravity(built, data, rough[0]).copy(), pinocchio.rnea(built, data, *rough[:3]).copy(),
                 pinocchio.aba(built, data, rough[0], rough[1], rough[3]).copy()]
        rows = [[mass[i, j] for j in range(built.nv)] for i in range(built.nv)]
        for found, peer in zip((rows, weight, inverse, forward), peers):
            found = np.array([[float(x) for x in row] if isinstance(row, list) else float(row) for row in found])
            assert np.abs(found - peer).max() < 1e-13 * np.abs(found).max(), np.abs(found - peer).max()
        cases.append({"positions": q, "rates": v, "accelerations": a, "forces": force, "mass_matrix": text(rows), "gravity_torques": text(weight),
                      "inverse_dynamics": text(inverse), "forward_dynamics": text(forward), "digits": 25})
    return {"file": "tests/data/arm.urdf", "joints": names, "gravity": ["0", "0", "-9.81"], "cases": cases}
