"""Motions: accuracy and computing time, affinor compared with other programs.

    python3 -m venv peers && peers/bin/pip install numpy scipy mujoco pin drake
    python3 benches/peers/motion.py --python peers/bin/python

measures, writes the tables of benches/results/motions.md between its markers and draws benches/results/motions.svg. A peer that
cannot be imported is left out, and named. Progress goes to standard error. The machine should have little else to do.
With `--problem` one problem is measured: its table is replaced, the other tables and the picture stay.

How it is measured
- Problems and their states in 25 digits are those of tests/data/motions.json. The error is that at the end: the largest
  of the entries of the rotation (on SE(3): and of the position), and of the body momentum over its largest component.
- The satellite is that of tests/data/orbit.json, in SI units. Its error is the largest of four: entries of the rotation,
  spin over its largest component, position over its length, velocity over its length. Absolute tolerances are the
  tolerance times these scales, in every program.
- The time is CPU time from the initial state in memory to the last state in memory, the least of several batches and of
  all rounds; models are made before, and so is what a method prepares for a system, except in rows of affinor's bodies.
- affinor, and what is written in Rust beside it (`Rust: ..`), are one program: `benches/precision.rs`. A round is that
  program, then each peer; rounds alternate, so that a busy machine is busy for all.
- SciPy and `NumPy: RK4` call a right side written in Python with plain floats; Pinocchio is called from Python for each
  stage, MuJoCo and Drake make all steps in C++.
"""
import argparse
import csv
import io
import json
import math
import os
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PEERS = ["scipy", "numpy", "pinocchio", "drake", "mujoco"]
LONG = 0.3  # seconds: the sweep of a method ends after a run that takes longer
BATCH = 0.02
LEVELS = [10.0**-k for k in range(4, 13)]
TOLERANCES = [10.0 ** (-k / 2) for k in range(4, 29)]
# lines of the diagram
SHOWN = ["exact", "DMV10", "RKMK853", "projected DP853", "kick4, DMV10", "Rust: DOP853", "SciPy: DOP853", "MuJoCo: RK4"]
PROBLEMS = {
    "free body, t = 10": ("hairer-vilmart", "10.0", 20),
    "free body, t = 100": ("hairer-vilmart", "100.0", 200),
    "heavy top, t = 2": ("bruels-cardona-arnold", "2.0", 300),
    "Kirchhoff, t = 20": ("kirchhoff", "20.0", 20),
    "satellite, two orbits": ("satellite", "12000", 100),
}


class Problem:
    """A problem up to one of its times."""

    satellite = False

    def __init__(self, name, motion, when, few):
        motions = json.load(open(os.path.join(ROOT, "tests/data/motions.json")))["motions"]
        motion = next(m for m in motions if m["name"] == motion)
        state = next(s for s in motion["states"] if s["time"] == when)
        self.name, self.few, self.time = name, few, float(when)
        self.moments = [float(row[i]) for i, row in enumerate(motion["metric"])]
        self.velocity = [float(x) for x in motion["velocity"]]
        self.momentum = [j * w for j, w in zip(self.moments, self.velocity)]
        self.weight = [float(x) for x in motion.get("weight", ["0"] * 3)]
        self.heavy = "weight" in motion
        self.screw = len(self.moments) == 6
        self.parts = [[float(x) for x in state[key]] for key in ["element", "momentum"]]
        self.sizes = [1.0, max(map(abs, self.parts[1]))]
        self.scales = [1.0] * (13 if self.screw else 7)

    def error(self, *parts):
        """The largest error of a part over its size."""
        expected = zip(self.parts, self.sizes)
        error = max(max(abs(x - y) for x, y in zip(part, end)) / size for part, (end, size) in zip(parts, expected))
        return error if all(math.isfinite(x) for part in parts for x in part) else math.nan


class Satellite(Problem):
    """The satellite of tests/data/orbit.json. Its parts are attitude, spin, position and velocity."""

    screw, heavy, satellite = True, False, True

    def __init__(self, name, when, few):
        orbit = json.load(open(os.path.join(ROOT, "tests/data/orbit.json")))
        state = next(s for s in orbit["states"] if s["time"] == when)
        numbers = lambda texts: [float(x) for x in texts]
        self.name, self.few, self.time = name, few, float(when)
        self.moments, self.mass, self.mu = numbers(orbit["moments"]), float(orbit["mass"]), float(orbit["mu"])
        self.spin, self.position, self.velocity = (numbers(orbit[key]) for key in ["spin", "position", "velocity"])
        self.parts = [numbers(state[key]) for key in ["element", "spin", "position", "velocity"]]
        self.sizes = [1.0, max(map(abs, self.parts[1])), math.hypot(*self.parts[2]), math.hypot(*self.parts[3])]
        start = [1.0, math.hypot(*self.position), max(map(abs, self.spin)), math.hypot(*self.velocity)]
        self.scales = [start[0]] * 4 + [start[1]] * 3 + [start[2]] * 3 + [start[3]] * 3


def rotation(w, x, y, z):
    n = w * w + x * x + y * y + z * z
    s = 2 / n
    return [
        1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),
        s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),
        s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y),
    ]


def rows(problem, method, parameters, run, seen, steps=lambda parameter, state: int(parameter)):
    """A row for each parameter, until the error no longer decreases or a run takes too long."""
    best, worse = math.inf, 0
    for parameter in parameters:
        try:
            state = run(parameter)
        except Exception:  # a step too long, in each program another error
            continue
        error = problem.error(*seen(state))
        count, seconds = 1, 0
        while True:
            begun = time.process_time()
            for _ in range(count):
                run(parameter)
            spent = time.process_time() - begun
            if spent > BATCH:
                break
            count *= 2
        seconds = spent / count
        for _ in range(2):
            begun = time.process_time()
            for _ in range(count):
                run(parameter)
            seconds = min(seconds, (time.process_time() - begun) / count)
        print(f'"{problem.name}","{method}",{parameter:e},{error:e},{seconds:e},{steps(parameter, state)}', flush=True)
        worse = 0 if error < best or best > 1e-7 else worse + 1
        best = min(best, error)
        if seconds > LONG or worse == 3:
            break


def doublings(problem):
    return [problem.few << k for k in range(16)]


def right_side(problem):
    """Of quaternion, (position,) and body momentum, in plain floats; of a satellite quaternion, position, spin, velocity."""
    if problem.satellite:
        a, b, c = problem.moments
        mass, mu = problem.mass, problem.mu
        trace = a + b + c

        def rates(_, y):
            w, x, y_, z, x1, x2, x3, o1, o2, o3, v1, v2, v3 = y.tolist() if hasattr(y, "tolist") else y
            r = rotation(w, x, y_, z)
            inverse = 1 / math.sqrt(x1 * x1 + x2 * x2 + x3 * x3)
            n1 = (r[0] * x1 + r[3] * x2 + r[6] * x3) * inverse
            n2 = (r[1] * x1 + r[4] * x2 + r[7] * x3) * inverse
            n3 = (r[2] * x1 + r[5] * x2 + r[8] * x3) * inverse
            s1, s2, s3 = a * n1, b * n2, c * n3
            tidal = 3 * mu * inverse * inverse * inverse
            # the force over the mass, in body components
            along = mu * inverse * inverse + 0.5 * inverse * tidal / mass * (trace - 5 * (n1 * s1 + n2 * s2 + n3 * s3))
            across = tidal * inverse / mass
            f1, f2, f3 = -along * n1 - across * s1, -along * n2 - across * s2, -along * n3 - across * s3
            return [
                0.5 * (-x * o1 - y_ * o2 - z * o3), 0.5 * (w * o1 + y_ * o3 - z * o2),
                0.5 * (w * o2 + z * o1 - x * o3), 0.5 * (w * o3 + x * o2 - y_ * o1),
                v1, v2, v3,
                ((b - c) * o2 * o3 + tidal * (n2 * s3 - n3 * s2)) / a,
                ((c - a) * o3 * o1 + tidal * (n3 * s1 - n1 * s3)) / b,
                ((a - b) * o1 * o2 + tidal * (n1 * s2 - n2 * s1)) / c,
                r[0] * f1 + r[1] * f2 + r[2] * f3, r[3] * f1 + r[4] * f2 + r[5] * f3, r[6] * f1 + r[7] * f2 + r[8] * f3,
            ]

        return rates, [1.0, 0, 0, 0, *problem.position, *problem.spin, *problem.velocity]
    if problem.screw:
        a, b, c, d, e, f = problem.moments

        def rates(_, y):
            w, x, y_, z, *_place, p1, p2, p3, q1, q2, q3 = y.tolist() if hasattr(y, "tolist") else y
            o1, o2, o3, v1, v2, v3 = p1 / a, p2 / b, p3 / c, q1 / d, q2 / e, q3 / f
            r = rotation(w, x, y_, z)
            return [
                0.5 * (-x * o1 - y_ * o2 - z * o3), 0.5 * (w * o1 + y_ * o3 - z * o2),
                0.5 * (w * o2 + z * o1 - x * o3), 0.5 * (w * o3 + x * o2 - y_ * o1),
                r[0] * v1 + r[1] * v2 + r[2] * v3, r[3] * v1 + r[4] * v2 + r[5] * v3, r[6] * v1 + r[7] * v2 + r[8] * v3,
                p2 * o3 - p3 * o2 + q2 * v3 - q3 * v2, p3 * o1 - p1 * o3 + q3 * v1 - q1 * v3,
                p1 * o2 - p2 * o1 + q1 * v2 - q2 * v1,
                q2 * o3 - q3 * o2, q3 * o1 - q1 * o3, q1 * o2 - q2 * o1,
            ]

        return rates, [1.0, 0, 0, 0, 0, 0, 0, *problem.momentum]
    a, b, c = problem.moments
    u1, u2, u3 = problem.weight
    heavy = problem.heavy

    def rates(_, y):
        w, x, y_, z, p1, p2, p3 = y.tolist() if hasattr(y, "tolist") else y
        o1, o2, o3 = p1 / a, p2 / b, p3 / c
        m1, m2, m3 = p2 * o3 - p3 * o2, p3 * o1 - p1 * o3, p1 * o2 - p2 * o1
        if heavy:
            g1, g2, g3 = 2 * (x * z - w * y_), 2 * (y_ * z + w * x), 1 - 2 * (x * x + y_ * y_)
            m1, m2, m3 = m1 + g2 * u3 - g3 * u2, m2 + g3 * u1 - g1 * u3, m3 + g1 * u2 - g2 * u1
        return [
            0.5 * (-x * o1 - y_ * o2 - z * o3), 0.5 * (w * o1 + y_ * o3 - z * o2),
            0.5 * (w * o2 + z * o1 - x * o3), 0.5 * (w * o3 + x * o2 - y_ * o1), m1, m2, m3,
        ]

    return rates, [1.0, 0, 0, 0, *problem.momentum]


def seen_plain(problem):
    def seen(y):
        y = [float(x) for x in y]
        r = rotation(*y[:4])
        if problem.satellite:
            return r, y[7:10], y[4:7], y[10:]
        if not problem.screw:
            return r, y[4:]
        x = y[4:7]
        return [*r[0:3], x[0], *r[3:6], x[1], *r[6:9], x[2], 0, 0, 0, 1], y[7:]

    return seen


def scipy(problem):
    from scipy.integrate import solve_ivp

    rates, start = right_side(problem)
    seen = seen_plain(problem)

    def run(tolerance):
        absolute = [tolerance * scale for scale in problem.scales]
        solution = solve_ivp(rates, (0, problem.time), start, method="DOP853", rtol=tolerance, atol=absolute)
        return solution.y[:, -1], len(solution.t) - 1

    rows(problem, "SciPy: DOP853", TOLERANCES, run, lambda s: seen(s[0]), lambda _, s: s[1])


def numpy(problem):
    import numpy as np

    rates, start = right_side(problem)

    def run(n):
        h, y = problem.time / n, np.array(start)
        for _ in range(n):
            k1 = np.array(rates(0, y))
            k2 = np.array(rates(0, y + (0.5 * h) * k1))
            k3 = np.array(rates(0, y + (0.5 * h) * k2))
            k4 = np.array(rates(0, y + h * k3))
            y = y + (h / 6) * (k1 + 2 * (k2 + k3) + k4)
            y[:4] /= math.sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3])
        return y

    rows(problem, "NumPy: RK4", doublings(problem), run, seen_plain(problem))


def about_centre(problem):
    """Of a heavy top: mass, centre, moments about the centre, gravity."""
    mass, height = 15.0, [0.0, 1.0, 0.0]
    moments = [problem.moments[0] - mass, problem.moments[1], problem.moments[2] - mass]
    assert problem.weight == [0, 147.15, 0]
    return mass, height, moments, 9.81


def pinocchio(problem):
    if problem.screw:
        return
    import numpy as np
    import pinocchio as pin

    model = pin.Model()
    if problem.heavy:
        mass, centre, moments, gravity = about_centre(problem)
        joint = model.addJoint(0, pin.JointModelSpherical(), pin.SE3.Identity(), "ball")
        model.gravity.linear = np.array([0, 0, -gravity])
    else:
        mass, centre, moments = 1.0, [0.0] * 3, problem.moments
        joint = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "free")
        model.gravity.linear = np.zeros(3)
    inertia = pin.Inertia(mass, np.array(centre), np.diag(moments))
    model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
    data, zero = model.createData(), np.zeros(model.nv)
    start = np.zeros(model.nv)
    start[-3:] = problem.velocity

    def euler(n):
        h, q, v = problem.time / n, pin.neutral(model), start.copy()
        for _ in range(n):
            v = v + h * pin.aba(model, data, q, v, zero)
            q = pin.integrate(model, q, h * v)
        return q, v

    def rk4(n):
        h, q, v = problem.time / n, pin.neutral(model), start.copy()
        for _ in range(n):
            a1 = pin.aba(model, data, q, v, zero).copy()
            v2 = v + (0.5 * h) * a1
            a2 = pin.aba(model, data, pin.integrate(model, q, (0.5 * h) * v), v2, zero).copy()
            v3 = v + (0.5 * h) * a2
            a3 = pin.aba(model, data, pin.integrate(model, q, (0.5 * h) * v2), v3, zero).copy()
            v4 = v + h * a3
            a4 = pin.aba(model, data, pin.integrate(model, q, h * v3), v4, zero).copy()
            q = pin.integrate(model, q, (h / 6) * (v + 2 * (v2 + v3) + v4))
            v = v + (h / 6) * (a1 + 2 * (a2 + a3) + a4)
        return q, v

    def seen(state):
        q, v = state
        x, y, z, w = q[-4:]
        return rotation(w, x, y, z), [j * o for j, o in zip(problem.moments, v[-3:])]

    rows(problem, "Pinocchio: semi-implicit Euler", doublings(problem), euler, seen)
    rows(problem, "Pinocchio: RK4 of aba, integrate", doublings(problem), rk4, seen)


def drake(problem):
    if problem.screw or problem.heavy:
        return
    import numpy as np
    from pydrake.math import RigidTransform, RotationMatrix
    from pydrake.multibody.math import SpatialVelocity
    from pydrake.multibody.plant import MultibodyPlant
    from pydrake.multibody.tree import SpatialInertia, UnitInertia
    from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig

    plant = MultibodyPlant(0.0)
    inertia = SpatialInertia(1.0, np.zeros(3), UnitInertia(*problem.moments))
    body = plant.AddRigidBody("body", inertia)
    plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
    plant.Finalize()

    def method(scheme, fixed):
        simulator = Simulator(plant)
        context = simulator.get_mutable_context()

        def run(parameter):
            accuracy, step = (1e-3, problem.time / parameter) if fixed else (parameter, problem.time)
            config = SimulatorConfig(
                integration_scheme=scheme, max_step_size=step, accuracy=accuracy, use_error_control=not fixed
            )
            ApplySimulatorConfig(config, simulator)
            context.SetTime(0.0)
            plant.SetFreeBodyPose(context, body, RigidTransform())
            velocity = SpatialVelocity(np.array(problem.velocity), np.zeros(3))
            plant.SetFreeBodySpatialVelocity(context, body, velocity)
            simulator.Initialize()
            simulator.AdvanceTo(problem.time)
            pose = plant.EvalBodyPoseInWorld(context, body)
            turn = plant.EvalBodySpatialVelocityInWorld(context, body).rotational()
            return pose.rotation().matrix(), turn, simulator.get_integrator().get_num_steps_taken()

        return run

    def seen(state):
        matrix, turn, _ = state
        return matrix.flatten().tolist(), [j * o for j, o in zip(problem.moments, matrix.T @ turn)]

    for scheme in ["runge_kutta3", "runge_kutta5"]:
        run = method(scheme, False)
        rows(problem, f"Drake: {scheme}", TOLERANCES, run, seen, lambda _, state: state[2])
    rows(problem, "Drake: runge_kutta2", doublings(problem), method("runge_kutta2", True), seen)


def mujoco(problem):
    if problem.screw:
        return
    import mujoco as mj
    import numpy as np

    if problem.heavy:
        mass, centre, moments, gravity = about_centre(problem)
        joint = '<joint type="ball"/>'
    else:
        mass, centre, moments, gravity = 1.0, [0.0] * 3, problem.moments, 0.0
        joint = "<freejoint/>"
    text = lambda numbers: " ".join(map(repr, numbers))
    for integrator in ["Euler", "implicit", "RK4"]:
        model = mj.MjModel.from_xml_string(f"""
            <mujoco>
              <option integrator="{integrator}" gravity="0 0 {-gravity}"><flag contact="disable"/></option>
              <worldbody><body>{joint}
                <inertial pos="{text(centre)}" mass="{mass}" diaginertia="{text(moments)}"/>
              </body></worldbody>
            </mujoco>""")
        data = mj.MjData(model)

        def run(n):
            model.opt.timestep = problem.time / n
            mj.mj_resetData(model, data)
            data.qvel[-3:] = problem.velocity
            mj.mj_step(model, data, n)
            return data.qpos[-4:].copy(), data.qvel[-3:].copy()

        def seen(state):
            return rotation(*state[0]), [j * o for j, o in zip(problem.moments, state[1])]

        rows(problem, f"MuJoCo: {integrator}", doublings(problem), run, seen)


def version(python, peer):
    module = {"pinocchio": "pinocchio", "drake": "pydrake"}.get(peer, peer)
    package = {"pinocchio": "pin"}.get(peer, peer)
    code = f"import {module}, importlib.metadata as m; print(m.version('{package}'))"
    found = subprocess.run([python, "-c", code], capture_output=True, text=True)
    return found.stdout.strip() if found.returncode == 0 else None


def short(seconds):
    if seconds is None:
        return "-"
    for unit, size in [("s", 1), ("ms", 1e-3), ("us", 1e-6)]:
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def is_peer(method):
    return ":" in method


def table(problem, found):
    """Markdown: the least time of each method for each error."""
    methods = {}
    for (name, method, _), (error, seconds, _) in found.items():
        if name == problem:
            methods.setdefault(method, []).append((error, seconds))
    cheapest = {
        method: [min((s for e, s in points if e <= level), default=None) for level in LEVELS]
        for method, points in methods.items()
    }

    def best(which):
        chosen = [[m for m in cheapest if is_peer(m) == which and cheapest[m][k] is not None] for k in range(len(LEVELS))]
        return [min(names, key=lambda m: cheapest[m][k], default=None) for k, names in enumerate(chosen)]

    ours, theirs = best(False), best(True)
    out = ["| error at most | " + " | ".join(f"{level:.0e}" for level in LEVELS) + " |"]
    out += ["| --- |" + " ---: |" * len(LEVELS)]
    ratio = []
    for k in range(len(LEVELS)):
        mine, other = (cheapest[m[k]][k] if m[k] else None for m in (ours, theirs))
        ratio.append("-" if not (mine and other) else f"{other / mine:.3g}")
    out += ["| **best peer over affinor's best** | " + " | ".join(ratio) + " |"]
    out += ["| affinor's best | " + " | ".join(m or "-" for m in ours) + " |"]
    out += ["| best peer | " + " | ".join(m or "-" for m in theirs) + " |"]
    for peers in [False, True]:
        for method in cheapest:
            if is_peer(method) == peers and any(cheapest[method]):
                out += [f"| {method} | " + " | ".join(map(short, cheapest[method])) + " |"]
    never = [method for method in cheapest if not any(cheapest[method])]
    if never:
        out += ["", "Not to 1e-4: " + ", ".join(never) + "."]
    return "\n".join(out)


def heading(problem):
    return f"### {problem[0].upper()}{problem[1:]}\n\n"


def tables(found):
    """Markdown: all problems, and the cost of steps."""
    out = [f"{heading(problem)}{table(problem, found)}\n" for problem in PROBLEMS]
    places = ["SO(3)", "SO(3), potential", "SE(3)"]
    out += ["### Nanoseconds a step", "", "| method | " + " | ".join(places) + " |", "| --- |" + " ---: |" * len(places)]
    methods = dict.fromkeys(method for name, method, _ in found if name == "step")
    for method in methods:
        cells = [found.get(("step", method, place)) for place in places]
        out += [f"| {method} | " + " | ".join(f"{cell[1] * 1e9:.0f}" if cell else "" for cell in cells) + " |"]
    return "\n".join(out)


def ensemble(program, members, rounds):
    """Wall time of an ensemble of free bodies, with one thread and with two."""
    problem = f"""
space  = "so3"
metric = "diag(0.6, 0.8, 1)"

[parameters]
a = 1.8
b = 0.4
c = -0.9

[initial]
momentum = ["a", "b", "c"]

[ensemble]
samples = {members}
random  = {{ a = "normal(0, 1)", b = "normal(0, 1)", c = "normal(0, 1)" }}

[output]
times = [0, 10]
"""
    least = {}
    for _ in range(rounds):
        for threads in (1, 2):
            begun = time.time()
            command = [program, "simulate", "-", "--ensemble", "--threads", str(threads), "-o", os.devnull, "--format", "csv"]
            subprocess.run(command, input=problem, text=True, check=True, stderr=subprocess.DEVNULL)
            least[threads] = min(least.get(threads, math.inf), time.time() - begun)
    return least


def draw(options, found):
    """The picture, by affinor."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(["problem", "method", "parameter", "error", "seconds", "steps"])
    for key, value in found.items():
        if key[1] in SHOWN:
            writer.writerow([*key, *value])
    picture = subprocess.run([*options.precision, "draw"], input=text.getvalue(), stdout=subprocess.PIPE, text=True, check=True)
    with open(os.path.join(ROOT, "benches/results/motions.svg"), "w") as file:
        file.write(picture.stdout)


def replace(problem, head, found):
    """The section of one problem in the document, or a new one after those of the others."""
    path = os.path.join(ROOT, "benches/results/motions.md")
    document = open(path).read()
    title, last = heading(problem), "### Nanoseconds a step\n"
    at = document.find(title)
    begin = at if at >= 0 else document.index(last)
    end = document.index("\n### ", begin) + 1 if at >= 0 else begin
    section = f"{title}Measured apart: {head}\n\n{table(problem, found)}\n\n"
    with open(path, "w") as file:
        file.write(document[:begin] + section + document[end:])


def measure(options):
    load = " ".join(f"{x:.1f}" for x in os.getloadavg())
    versions = {peer: version(options.python, peer) for peer in PEERS}
    missing = [peer for peer in PEERS if not versions[peer]]
    found, late, folder = {}, [], tempfile.mkdtemp(prefix="peers")  # some leave files where they run
    only = ["--problem", options.problem] if options.problem else []
    commands = [("affinor", [*options.precision, "measure", *only])]
    commands += [(p, [options.python, os.path.abspath(__file__), "--peer", p, *only]) for p in PEERS if versions[p]]
    for number in range(options.rounds):
        for name, command in commands:
            print(f"round {number + 1}: {name}", file=sys.stderr)
            environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
            running = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment, cwd=folder)
            try:
                rows, _ = running.communicate(timeout=options.limit * 60)
            except subprocess.TimeoutExpired:
                running.kill()
                rows, _ = running.communicate()
                late.append(name)
            if running.returncode:
                print(f"{name} ended with {running.returncode}", file=sys.stderr)
            for row in csv.reader(io.StringIO(rows)):
                if len(row) != 6 or row[0] == "problem":
                    continue
                key, error, seconds = tuple(row[:3]), float(row[3] or "nan"), float(row[4])
                before = found.get(key)
                found[key] = (error, min(seconds, before[1]) if before else seconds, row[5])
    installed = ", ".join(f"{peer} {versions[peer]}" for peer in PEERS if versions[peer])
    head = f"{time.strftime('%Y-%m-%d')}; {os.cpu_count()} cores; load average at the start {load}; "
    head += f"{options.rounds} round{'s' * (options.rounds > 1)}; {installed}."
    if late:
        head += f" Ended after {options.limit:g} minutes: " + ", ".join(dict.fromkeys(late)) + "."
    if missing:
        head += " Not there: " + ", ".join(missing) + "."
    if options.problem:
        replace(options.problem, head, found)
        return
    draw(options, found)
    path = os.path.join(ROOT, "benches/results/motions.md")
    document = open(path).read()
    before, _, rest = document.partition("<!-- measured -->")
    _, _, after = rest.partition("<!-- end -->")
    with open(path, "w") as file:
        file.write(f"{before}<!-- measured -->\n\n{head}\n\n{tables(found)}\n\n<!-- end -->{after}")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--python", default=sys.executable, type=os.path.abspath, help="Python with the peers")
    arguments.add_argument("--precision", help="the compiled benches/precision.rs [built by cargo]")
    arguments.add_argument("--rounds", type=int, default=3, help="[3]")
    arguments.add_argument("--limit", type=float, default=10, help="the most minutes of one program in a round [10]")
    arguments.add_argument("--ensemble", metavar="PROGRAM", help="only time an ensemble of 10^5 free bodies with this affinor")
    arguments.add_argument("--problem", choices=PROBLEMS, metavar="NAME", help="only this problem")
    arguments.add_argument("--peer", choices=PEERS, help="print the rows of one peer (needs it in this Python)")
    options = arguments.parse_args()
    if options.ensemble:
        for threads, seconds in ensemble(options.ensemble, 100_000, options.rounds).items():
            print(f"{threads} threads: {seconds:.2f} s")
    elif options.peer:
        for name, (motion, *rest) in PROBLEMS.items():
            if options.problem in (None, name):
                problem = Satellite(name, *rest) if motion == "satellite" else Problem(name, motion, *rest)
                globals()[options.peer](problem)
    else:
        manifest = os.path.join(ROOT, "Cargo.toml")
        cargo = ["cargo", "bench", "-q", "--manifest-path", manifest, "-p", "affinor-benches", "--bench", "precision", "--"]
        options.precision = [os.path.abspath(options.precision)] if options.precision else cargo
        measure(options)


main()
