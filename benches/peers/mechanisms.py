"""Mechanisms: affinor beside EXUDYN, in one run, with errors against tests/data/mechanisms.json.

    cargo build --release -p affinor-cli
    python3 benches/peers/mechanisms.py --affinor target/release/affinor > mechanisms.md
    python3 benches/peers/mechanisms.py --affinor target/release/affinor --settings "--method generalised-alpha --step 0.001"

Needs numpy and exudyn (from PyPI).

- Time: processor seconds (user and system) of a simulation, the least of the runs. A run of EXUDYN is the call of its solver, without the
  assembly of the model. A run of affinor is a process that reads a file, integrates and writes one row.
- Error: the largest difference of the coordinates of one point at the end, in metres, from the reference, which has 17 or more digits.
- EXUDYN solves with its generalized-alpha method of index 3 and a spectral radius of 0.9 (0.95 for the double four-bar linkage), as its own
  examples of these problems do.
"""
import argparse
import csv
import json
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import exudyn
import numpy as np
from exudyn.utilities import (LoadMassProportional, MarkerBodyMass, MarkerBodyPosition, NodeRigidBody2D, ObjectGround, ObjectJointRevolute2D, ObjectRigidBody2D,
                              RigidBodyInertia)

HERE = Path(__file__).resolve().parents[2]
REFERENCE = json.loads((HERE / "tests/data/mechanisms.json").read_text())
GRAVITY = 9.81

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("--affinor", help="the program; without it only EXUDYN runs")
arguments.add_argument("--only", nargs="+", help="problems, of: four_bar bricard slider_crank")
arguments.add_argument("--settings", nargs="+", default=["--tolerance 1e-6", "--tolerance 1e-9", "--tolerance 1e-12"], help="options of affinor, a text for each run")
arguments.add_argument("--runs", type=int, default=3, help="runs of each simulation")
options = arguments.parse_args()
exudyn.config.printToConsole = False


def system():
    container = exudyn.SystemContainer()
    return container, container.AddSystem()


def four_bar():
    """Five rods in the plane, with the markers of their ends; the levers and couplers in turn. No constraint is redundant."""
    container, mbs = system()
    ends = []
    for x, y, angle in [(0, 0.5, 0.5), (0.5, 1, 0), (1, 0.5, 0.5), (1.5, 1, 0), (2, 0.5, 0.5)]:
        speed = [0.5, 0, -1] if angle else [1, 0, 0]
        node = mbs.AddNode(NodeRigidBody2D(referenceCoordinates=[x, y, angle * np.pi], initialVelocities=speed))
        rod = mbs.AddObject(ObjectRigidBody2D(nodeNumber=node, mass=1, inertia=1 / 12))
        mbs.AddLoad(LoadMassProportional(markerNumber=mbs.AddMarker(MarkerBodyMass(bodyNumber=rod)), loadVector=[0, -GRAVITY, 0]))
        ends.append([mbs.AddMarker(MarkerBodyPosition(bodyNumber=rod, localPosition=[side, 0, 0])) for side in (-0.5, 0.5)])
        if not x:
            left = rod
    ground = mbs.AddObject(ObjectGround())
    base = [mbs.AddMarker(MarkerBodyPosition(bodyNumber=ground, localPosition=[x, 0, 0])) for x in (0, 1, 2)]
    pairs = [(base[0], ends[0][0]), (base[1], ends[2][0]), (base[2], ends[4][0]), (ends[0][1], ends[1][0]), (ends[1][1], ends[3][0]),
             (ends[2][1], ends[3][0]), (ends[3][1], ends[4][1])]
    for pair in pairs:
        mbs.AddObject(ObjectJointRevolute2D(markerNumbers=list(pair)))
    tip = lambda: mbs.GetObjectOutputBody(left, exudyn.OutputVariableType.Position, [0.5, 0, 0])[:2]
    return container, mbs, tip, 0.95, False


def bricard():
    """Five cylinders; the last joint holds a redundant constraint, which the dense solver ignores."""
    container, mbs = system()
    hinges, axes = np.array(REFERENCE["bricard"]["hinges"], dtype=float), np.array(REFERENCE["bricard"]["axes"], dtype=float)
    along, across = (float(REFERENCE["bricard"]["cylinder"]["inertia"][key]) for key in ("along", "across"))
    ground = mbs.CreateGround()
    bodies = [ground]
    for start, end in zip(hinges, hinges[1:]):
        rod = end - start
        inertia = RigidBodyInertia(mass=1, inertiaTensor=across * np.eye(3) + (along - across) * np.outer(rod, rod))
        bodies.append(mbs.CreateRigidBody(referencePosition=(start + end) / 2, inertia=inertia, gravity=[0, -GRAVITY, 0], show=False))
    for k in range(5):
        mbs.CreateRevoluteJoint(itemNumbers=[bodies[k], bodies[k + 1]], position=hinges[k], axis=axes[k], show=False)
    mbs.CreateGenericJoint(itemNumbers=[bodies[5], ground], position=hinges[5], constrainedAxes=[1, 1, 1, 0, 1, 1], show=False)
    tip = lambda: mbs.GetObjectOutputBody(bodies[4], exudyn.OutputVariableType.Position, [0.5, 0, 0])
    return container, mbs, tip, 0.9, True


def slider_crank():
    """The spatial slider-crank; the universal joint has one axis along the guide and one orthogonal to the guide and the rod."""
    container, mbs = system()
    a, b, c = np.array([0, 0.1, 0.12]), np.array([0, 0.1, 0.2]), np.array([0.2, 0, 0])
    u, second = (c - b) / 0.3, np.array([float(x) for x in REFERENCE["slider_crank"]["universal_joint"]["rod_axis"]])
    ground, spin = mbs.CreateGround(), np.array([6.0, 0, 0])

    def body(mass, inertia, at, velocity, rate):
        return mbs.CreateRigidBody(referencePosition=at, inertia=RigidBodyInertia(mass=mass, inertiaTensor=inertia), gravity=[0, 0, -GRAVITY],
                                   initialVelocity=velocity, initialAngularVelocity=rate, show=False)

    crank = body(0.12, np.diag([1e-4, 1e-4, 1e-5]), (a + b) / 2, np.cross(spin, (b - a) / 2), spin)
    rod = body(0.5, 0.004 * np.eye(3) - 0.0036 * np.outer(u, u), (b + c) / 2, [0.12, -0.24, 0], [1.92, -0.96, 0.48])
    slider = body(2, 1e-4 * np.eye(3), c, [0.24, 0, 0], [0, 0, 0])
    frame = np.array([[1, 0, 0], second, np.cross([1, 0, 0], second)]).T
    for pair, at, fixed in [([ground, crank], a, [1, 1, 1, 0, 1, 1]), ([ground, slider], c, [0, 1, 1, 1, 1, 1]), ([crank, rod], b, [1, 1, 1, 0, 0, 0])]:
        mbs.CreateGenericJoint(itemNumbers=pair, position=at, constrainedAxes=fixed, show=False)
    mbs.CreateGenericJoint(itemNumbers=[slider, rod], position=c, rotationMatrixAxes=frame, constrainedAxes=[1, 1, 1, 0, 0, 1], show=False)
    place = lambda: mbs.GetObjectOutputBody(slider, exudyn.OutputVariableType.Position, [0, 0, 0])[:1]
    return container, mbs, place, 0.9, False


def solved(build, end, step):
    """The least processor time of the runs, and the point at the end; None if the solver gave up."""
    times = []
    for _ in range(options.runs):
        container, mbs, point, radius, redundant = build()
        mbs.Assemble()
        settings = exudyn.SimulationSettings()
        settings.timeIntegration.numberOfSteps = round(end / step)
        settings.timeIntegration.endTime = end
        settings.timeIntegration.generalizedAlpha.spectralRadius = radius
        settings.timeIntegration.generalizedAlpha.computeInitialAccelerations = True
        settings.timeIntegration.newton.useModifiedNewton = True
        settings.solution.file.write = False
        settings.timeIntegration.verboseMode = 0
        if redundant:
            settings.linearSolver.solverType = exudyn.LinearSolverType.EigenDense
            settings.linearSolver.ignoreSingularJacobian = True
            settings.timeIntegration.newton.relativeTolerance = 1e-6
        begin = time.process_time()
        try:
            mbs.SolveDynamic(settings, showHints=False, showCausingItems=False)
        except exudyn.SolverError:
            return None
        times.append(time.process_time() - begin)
    return min(times), np.array(point())


def simulated(file, columns, end, setting):
    """The same by affinor, on the file of a mechanism without its table `integrator`, with the columns of the point."""
    text = re.sub(r"^\[integrator\]\n(?:(?!\[).*\n)*", "", file.read_text(), flags=re.MULTILINE)
    times = []
    with tempfile.TemporaryDirectory() as folder:
        problem, rows = Path(folder) / file.name, Path(folder) / "rows.csv"
        problem.write_text(text)
        for _ in range(options.runs):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            run = subprocess.run([options.affinor, "simulate", problem, *setting.split(), "--end", str(end), "--every", str(end), "-o", rows], capture_output=True, text=True)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            if run.returncode:
                print(f"{file.name}, {setting}: {run.stderr.splitlines()[0]}", file=sys.stderr)
                return None
            times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
            with rows.open() as lines:
                last = list(csv.DictReader(lines))[-1]
    return min(times), np.array([float(last[name]) for name in columns])


def expected(path, time_, key):
    states = REFERENCE
    for name in path:
        states = states[name]
    value = next(s for s in states["states"] if s["time"] == str(time_))[key]
    return np.array([float(x) for x in (value if isinstance(value, list) else [value])])


PROBLEMS = {  # title, EXUDYN's model, affinor's file and columns, the reference, end, steps
    "four_bar": ("double four-bar linkage, 10 s", four_bar, "examples/mechanisms/double_four_bar.toml", ["x", "y"], (["windows", "2"], 10, "position"), [1e-2, 5e-3, 1e-3, 2.5e-4]),
    "bricard": ("Bricard's mechanism, 1 s", bricard, "examples/mechanisms/bricard.toml", ["tip1", "tip2", "tip3"], (["bricard", "cylinder"], 1, "point"), [1e-2, 5e-3, 1e-3, 2.5e-4]),
    "slider_crank": ("spatial slider-crank, 5 s", slider_crank, "benches/peers/spatial_slider_crank.toml", ["slider"], (["slider_crank"], 5, "slider"), [5e-3, 1e-3, 5e-4, 1e-4]),
}


def row(title, program, setting, found, reference):
    if found is None:
        print(f"| {title} | {program} | {setting} | | no solution |", flush=True)
    else:
        print(f"| {title} | {program} | {setting} | {found[0]:.3g} | {np.abs(found[1] - reference).max():.1e} |", flush=True)


print("| problem | program | setting | time, s | error, m |\n|---|---|---|---:|---:|")
for name in options.only or PROBLEMS:
    title, build, file, columns, (path, end, key), steps = PROBLEMS[name]
    reference = expected(path, end, key)
    for step in steps:
        row(title, "EXUDYN", f"step {step:g} s", solved(build, end, step), reference)
    if options.affinor:
        for setting in options.settings:
            row(title, "affinor", setting.replace("--", ""), simulated(HERE / file, columns, end, setting), reference)
