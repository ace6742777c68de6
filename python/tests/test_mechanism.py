"""Mechanisms: the dynamics of an arm by Pinocchio, batches, mobilities and errors."""

import copy
import json
import pickle
from pathlib import Path

import numpy as np
import pytest

import affinor as af

ROOT = Path(__file__).parent.parent.parent
DATA = ROOT / "tests" / "data"
ARM = DATA / "arm_seven.urdf"

GROUND = {"name": "ground", "fixed": True}
ROD = {"name": "rod", "inertia": {"parts": [{"shape": "rod", "length": "l", "mass": 3, "position": [0, 0, "-l/2"]}]}}
HINGE = {"name": "hinge", "type": "revolute", "bodies": ["ground", "rod"], "at": [0, 0, 0], "axis": [0, 1, 0]}
PENDULUM = {"parameters": {"l": 1}, "gravity": [0, 0, -9.81], "bodies": [GROUND, ROD], "joints": [HINGE]}


@pytest.fixture(scope="module")
def numbers():
    return json.loads((DATA / "arm_seven.json").read_text())


@pytest.fixture(scope="module")
def arm(numbers):
    return af.Mechanism({"urdf": str(ARM)}, gravity=numbers["gravity"])


def close(found, expected, tolerance):
    found, expected = np.asarray(found), np.asarray(expected)
    assert found.shape == expected.shape
    assert np.abs(found - expected).max() <= tolerance


def test_the_dynamics_of_an_arm_agree_with_pinocchio(arm, numbers):
    q, v, x = numbers["coordinates"], numbers["rates"], numbers["forces"]
    expected = numbers["dynamics"]
    close(arm.inverse(q, v, x), expected["inverse"], 1e-12)
    close(arm.forward(q, v, x), expected["forward"], 1e-10)
    close(arm.mass_matrix(q), expected["mass_matrix"], 1e-13)
    close(arm.momentum(q, v), expected["momentum"], 1e-12)
    kinetic, potential = numbers["energies"]
    close(arm.kinetic_energy(q, v), kinetic, 1e-13)
    close(arm.potential_energy(q), potential, 1e-12)
    close(arm.energy(q, v), kinetic + potential, 1e-12)
    tip = af.SE3.act(arm.poses(q)[arm.bodies.index("tip")], numbers["tip_at_zero"])
    close(tip, numbers["tip"], 1e-14)


def test_bodies_and_joints_are_those_of_the_robot(arm, numbers):
    assert arm.bodies == ["base", *(f"link{k}" for k in (1, 2, 3)), "slider", "link5", "link6", "flange", "tool", "tip"]
    assert [joint.name for joint in arm.joints] == [*numbers["names"], "mount", "end"]
    slide = arm.joints[3]
    assert slide == ("slide", "prismatic", ("link3", "slider"), slice(3, 4), slice(3, 4))
    assert (arm.coordinate_count, arm.freedom) == (7, 7)
    assert arm.joints[7].v == slice(7, 7)
    assert not arm.home().any()
    assert arm.mobility()["mobility"] == 7


def test_rows_are_batches(arm):
    rng = np.random.default_rng(3)
    q, v, tau = rng.normal(size=(4, 1, 7)), rng.normal(size=(5, 7)), rng.normal(size=7)
    a = arm.forward(q, v, tau)
    assert a.shape == (4, 5, 7)
    close(arm.inverse(q, v, a), np.broadcast_to(tau, (4, 5, 7)), 1e-9)
    close(a[2, 3], arm.forward(q[2, 0], v[3], tau), 0)
    mass = arm.mass_matrix(q)
    assert mass.shape == (4, 1, 7, 7)
    close(np.einsum("...i,...ij,...j", v, mass, v) / 2, arm.kinetic_energy(q, v), 1e-11)
    assert arm.poses(q).shape == (4, 1, 10, 7)
    assert arm.momentum(q, v).shape == (4, 5, 6)
    assert arm.energy(q, v).shape == (4, 5)
    assert arm.forward(np.zeros((0, 7)), v[0], tau).shape == (0, 7)


def test_parameters_and_gravity():
    pendulum = af.Mechanism(PENDULUM, set={"l": 2})
    close(pendulum.mass_matrix([0.0]), [[4.0]], 1e-14)
    q = np.linspace(-3, 3, 11)[:, None]
    close(pendulum.forward(q, [0.0], [0.0]), -1.5 * 9.81 / 2 * np.sin(q), 1e-13)
    free = af.Mechanism(PENDULUM, gravity=np.zeros(3))
    close(free.inverse(q, [2.0], [0.0]), np.zeros((11, 1)), 1e-14)
    assert repr(pendulum) == "Mechanism('mechanism', 2 bodies, 1 joints)"


def test_rotations_about_points_have_quaternions():
    ball = {**HINGE, "type": "spherical"}
    del ball["axis"]
    ball_rod = {"name": "rod", "inertia": {"parts": [{"shape": "box", "edges": [1, 2, 3], "mass": 2, "position": [0, 0, -1]}]}}
    mechanism = af.Mechanism({"bodies": [GROUND, ball_rod], "joints": [ball]})
    assert (mechanism.coordinate_count, mechanism.freedom) == (4, 3)
    close(mechanism.home(), [1, 0, 0, 0], 0)
    q = af.SO3.exp([0.3, -0.4, 0.5])
    close(mechanism.poses(q)[1], [*q, 0, 0, 0], 1e-15)


def test_copies_and_pickles(arm, numbers):
    q = numbers["coordinates"]
    for other in (pickle.loads(pickle.dumps(arm)), copy.copy(arm), copy.deepcopy(arm)):
        assert (other.mass_matrix(q) == arm.mass_matrix(q)).all()


def test_files_of_the_examples():
    arm = af.Mechanism(ROOT / "examples/mechanisms/arm.toml")
    assert [joint.name for joint in arm.joints] == ["turn", "shoulder", "extend", "mount"]
    bricard = af.Mechanism(ROOT / "examples/mechanisms/bricard.toml")
    report = bricard.mobility()
    assert (report["mobility"], len(bricard.joints)) == (1, 6)
    assert "plane reverses the loop" in str(report)


def test_problems_take_robots(numbers):
    problem = af.Problem(
        urdf=str(ARM), coordinates="joints", gravity=numbers["gravity"], output={"end": 0.1, "every": 0.1}
    )
    found = af.simulate(problem)
    assert abs(found["energy"][0] - af.Mechanism({"urdf": str(ARM)}, gravity=numbers["gravity"]).energy([0] * 7, [0] * 7)) < 1e-12
    assert any("are not enforced" in note for note in found.notes)


def test_errors():
    with pytest.raises(af.InputError, match=r"cannot read .*nowhere\.urdf") as caught:
        af.Mechanism({"urdf": "nowhere.urdf"})
    assert "path of the URDF file" in str(caught.value)
    with pytest.raises(TypeError, match="a path or a dict, not int"):
        af.Mechanism(3)
    with pytest.raises(ValueError, match="3 finite numbers"):
        af.Mechanism(PENDULUM, gravity=[0, 1])
    pendulum = af.Mechanism(PENDULUM)
    with pytest.raises(ValueError, match=r"q should be an array of the shape \(\.\.\., 1\)"):
        pendulum.mass_matrix([0.0, 1.0])
    with pytest.raises(ValueError, match="q should be finite numbers, not NaN"):
        pendulum.mass_matrix([np.nan])
    with pytest.raises(ValueError, match="broadcast"):
        pendulum.energy(np.zeros((2, 1)), np.zeros((3, 1)))
    # a mechanism without masses, or with a loop, has a mobility only
    massless = af.Mechanism({"bodies": [GROUND, {"name": "rod"}], "joints": [HINGE]})
    assert massless.mobility()["mobility"] == 1
    assert massless.joints[0].q == slice(0, 0)
    with pytest.raises(af.InputError, match="the moving body `rod` has no inertia"):
        massless.mass_matrix([0.0])
