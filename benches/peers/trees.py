"""Dynamics of trees of bodies: affinor beside Pinocchio, in one run.

    cargo bench -p affinor-benches --bench tree_calls --no-run
    python3 benches/peers/trees.py --calls target/release/deps/tree_calls-* > trees.md

Needs numpy and pin (Pinocchio, from PyPI).

- Time: the least microseconds per call in a process, over a second of calls. Pinocchio is called from Python; the time of its forward dynamics
  of a tree without bodies is printed, and not subtracted. Its data of n bodies have tensors with n^3 numbers, so that it stops before 1000 bodies.
- Difference: the largest difference of accelerations, relative to the largest acceleration.
"""
import argparse
import json
import subprocess
import tempfile
import time

import numpy
import pinocchio

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("--calls", required=True, help="the program of benches/tree_calls.rs")
options = arguments.parse_args()


def tree(before, at, axis):
    """A model with bodies behind hinges; inertias are not diagonal."""
    count = len(before)
    inertia = numpy.array([[0.03, 0.002, -0.003], [0.002, 0.04, 0.004], [-0.003, 0.004, 0.05]])
    bodies = [{"mass": 1 + 0.1 * (k % 7), "centre": (numpy.array(at[k]) + [0.05, 0.02, 0.1]).tolist(),
               "inertia": (inertia * (1 + 0.2 * (k % 5))).tolist()} for k in range(count)]
    joints = [{"before": before[k], "kind": "revolute", "at": list(at[k]), "axis": list(axis[k])} for k in range(count)]
    return {"joints": joints, "bodies": bodies, "gravity": [0, 0, -9.81], "numbers": [0.3 * numpy.sin(k + 1.0) for k in range(count)],
            "rates": [0.5 * numpy.cos(k + 1.0) for k in range(count)], "forces": [0.2 * numpy.sin(2.0 * k) for k in range(count)]}


def chain(count):
    axes = [[0, 1, 0], [0.6, 0, 0.8], [1, 0, 0]]
    return tree(list(range(count)), [[0, 0, 0.2 * k] for k in range(count)], [axes[k % 3] for k in range(count)])


HEIGHTS = [0.34, 0.34, 0.74, 0.74, 1.14, 1.14, 1.266]  # joints of an arm with seven axes, z and y in turn
ARM = tree(list(range(7)), [[0, 0, z] for z in HEIGHTS], [[0, 0, 1] if k % 2 == 0 else [0, 1, 0] for k in range(7)])


def least(call):
    best, begin, calls = float("inf"), time.perf_counter(), 1
    while time.perf_counter() - begin < 1:
        start = time.perf_counter()
        for _ in range(calls):
            call()
        seconds = time.perf_counter() - start
        best = min(best, seconds / calls)
        if seconds < 1e-3:
            calls *= 2
    return best


def peer(model):
    built = pinocchio.Model()
    built.gravity.linear = numpy.array(model["gravity"], dtype=float)
    origins, unit = [numpy.zeros(3)], numpy.eye(3)
    for joint, body in zip(model["joints"], model["bodies"]):
        at, before = numpy.array(joint["at"], dtype=float), joint["before"]
        place = pinocchio.SE3(unit, at - origins[before])
        named = {(0, 1, 0): pinocchio.JointModelRY, (0, 0, 1): pinocchio.JointModelRZ, (1, 0, 0): pinocchio.JointModelRX}
        kind = named.get(tuple(joint["axis"]))
        kind = kind() if kind else pinocchio.JointModelRevoluteUnaligned(numpy.array(joint["axis"], dtype=float))
        own = built.addJoint(before, kind, place, f"J{len(origins)}")
        inertia = pinocchio.Inertia(body["mass"], numpy.array(body["centre"]) - at, numpy.array(body["inertia"]))
        built.appendBodyToJoint(own, inertia, pinocchio.SE3.Identity())
        origins.append(at)
    data = built.createData()
    numbers, rates, forces = (numpy.array(model[key], dtype=float) for key in ("numbers", "rates", "forces"))
    found = pinocchio.aba(built, data, numbers, rates, forces).copy()
    times = {"forward": least(lambda: pinocchio.aba(built, data, numbers, rates, forces)),
             "inverse": least(lambda: pinocchio.rnea(built, data, numbers, rates, found)),
             "mass": least(lambda: pinocchio.crba(built, data, numbers))}
    return times, found


empty, nothing = pinocchio.Model(), numpy.zeros(0)
data = empty.createData()
print(f"A call of Pinocchio from Python, without bodies: {1e6 * least(lambda: pinocchio.aba(empty, data, nothing, nothing, nothing)):.2f} us.\n")
print("| tree | computation | affinor, us | Pinocchio, us | ratio | difference |\n|---|---|---:|---:|---:|---:|")
for name, model in [("arm with 7 axes", ARM)] + [(f"chain of {n}", chain(n)) for n in (10, 100, 300, 1000)]:
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(model, file)
        file.flush()
        own = json.loads(subprocess.run([options.calls, file.name], capture_output=True, check=True, text=True).stdout)
    times, found = peer(model) if len(model["joints"]) <= 300 else ({}, None)
    off = None if found is None else numpy.abs(numpy.array(own["accelerations"]) - found).max() / numpy.abs(found).max()
    for kind, text in [("forward", "forward dynamics"), ("inverse", "inverse dynamics"), ("mass", "mass matrix")]:
        other = f"{1e6 * times[kind]:.2f} | {own[kind] / times[kind]:.2f}" if times else " | "
        shown = f"{off:.0e}" if off is not None and kind == "forward" else ""
        print(f"| {name} | {text} | {1e6 * own[kind]:.2f} | {other} | {shown} |", flush=True)
