"""Simulations: the values of the command line, every kind of input, interrupts and errors."""

import gc
import inspect
import os
import pickle
import signal
import threading
import time
import tomllib
import warnings
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pytest
import sympy as sp

import affinor as af

MOTIONS = Path(__file__).resolve().parents[2] / "examples" / "motions"
TOP = {
    "space": "so3",
    "metric": "diag(2, 2, 1)",
    "parameters": {"tilt": 0.3, "spin": 5},
    "initial": {"coordinates": ["tilt", 0, 0], "velocity": [0, 0, "spin"]},
    "forces": {"potential": "R33"},
    "output": {"end": 1, "every": 0.1},
}


def test_columns_are_views():
    top = af.simulate(TOP)
    assert top["Omega1"].base is not None and np.shares_memory(top["Omega1"], top.rows)
    assert top["Omega"].shape == (11, 3) and np.shares_memory(top["Omega"], top.rows)
    assert list(top) == top.columns and "energy" in top and len(top) == 11
    np.testing.assert_allclose(top.t, np.linspace(0, 1, 11))
    assert top.drift()["energy"] < 1e-11 and top.drift()["h3"] < 1e-11
    with pytest.raises(KeyError, match="the columns are"):
        top["nothing"]


def test_every_way_in(tmp_path):
    expected = af.simulate(TOP).rows
    R33 = sp.Symbol("R33")
    keys = {**TOP, "metric": np.diag([2, 2, 1]), "forces": {"potential": R33}}
    np.testing.assert_array_equal(af.simulate(**keys).rows, expected)
    np.testing.assert_array_equal(af.simulate({**TOP, "metric": [2, 2, 1]}).rows, expected)
    np.testing.assert_array_equal(af.simulate(af.Problem(TOP)).rows, expected)
    np.testing.assert_array_equal(af.simulate(pickle.loads(pickle.dumps(af.Problem(TOP)))).rows, expected)
    path = tmp_path / "top.toml"
    path.write_text(
        'space = "so3"\nmetric = "diag(2, 2, 1)"\nparameters = {tilt = 0.3, spin = 5}\nforces.potential = "R33"\n'
        'initial = {coordinates = ["tilt", 0, 0], velocity = [0, 0, "spin"]}\noutput = {end = 1, every = 0.1}\n'
    )
    np.testing.assert_array_equal(af.simulate(path).rows, expected)
    np.testing.assert_array_equal(af.simulate(TOP, set={"spin": 4}).rows, af.simulate(path, set="spin=4").rows)
    assert af.simulate(TOP, method="kick4", step=0.01).method == "kick4"
    assert len(af.simulate(TOP, end=2, every=sp.Rational(1, 2))) == 5


def test_forces():
    t, o1 = sp.symbols("t Omega1")
    body = {**TOP, "forces": {"body": [sp.cos(t), -o1 / 2, 0]}}
    text = {**TOP, "forces": {"body": ["cos(t)", "-Omega1/2", 0]}}
    np.testing.assert_array_equal(af.simulate(body).rows, af.simulate(text).rows)
    table = np.array([[0, 0, 0, 0], [1, 1, 0, 0.0]])
    gc.collect()
    with warnings.catch_warnings(record=True) as raised:
        warnings.simplefilter("always", ResourceWarning)
        by_table = af.simulate({**TOP, "forces": {"table": table}})
        gc.collect()
    assert not [warning for warning in raised if "TemporaryDirectory" in str(warning.message)]
    by_formula = af.simulate({**TOP, "forces": {"body": ["t", 0, 0]}})
    np.testing.assert_allclose(by_table.rows, by_formula.rows, atol=1e-9)
    pd = pytest.importorskip("pandas")
    frame = pd.DataFrame(table, columns=["t", "M1", "M2", "M3"])
    np.testing.assert_array_equal(af.simulate({**TOP, "forces": {"table": frame}}).rows, by_table.rows)
    # columns count by their names
    turned = frame[["M3", "t", "M1", "M2"]]
    np.testing.assert_array_equal(af.simulate({**TOP, "forces": {"table": turned}}).rows, by_table.rows)
    with pytest.raises(ValueError, match="no column `M1`"):
        af.simulate({**TOP, "forces": {"table": frame.rename(columns={"M1": "x"})}})


def test_a_function_of_python_is_a_force():
    seen = []

    def force(t, g, omega):
        seen.append((g.shape, omega.shape))
        return [np.cos(t), -omega[0] / 2, g[2, 2]]

    by_function = af.simulate({**TOP, "forces": {"body": force}})
    by_formula = af.simulate({**TOP, "forces": {"body": ["cos(t)", "-Omega1/2", "R33"]}})
    np.testing.assert_allclose(by_function.rows, by_formula.rows, atol=1e-13)
    assert set(seen) == {((3, 3), (3,))}
    in_space = af.simulate({**TOP, "forces": {"spatial": lambda t, g, omega: [t, 0, 0]}})
    np.testing.assert_allclose(in_space.rows, af.simulate({**TOP, "forces": {"spatial": ["t", 0, 0]}}).rows, atol=1e-13)

    def broken(t, g, omega):
        raise LookupError("no torque")

    with pytest.raises(LookupError, match="no torque"):
        af.simulate({**TOP, "forces": {"body": broken}})
    with pytest.raises(TypeError):
        af.simulate({**TOP, "forces": {"body": lambda t, g, omega: "text"}})
    with pytest.raises(ValueError, match="3 components"):
        af.simulate({**TOP, "forces": {"body": lambda t, g, omega: [0, 0]}})


def test_tables():
    top = af.simulate(TOP)
    frame, arrow = top.to_pandas(), top.to_arrow()
    np.testing.assert_array_equal(frame.to_numpy(), top.rows)
    assert arrow.column_names == top.columns and arrow.num_rows == len(top)
    assert "<table" in top._repr_html_()


def test_plots():
    top = af.simulate(TOP)
    for kind in ("conserved", "series", "attitude", "momentum"):
        assert top.plot(kind) is not None
    with pytest.raises(ValueError, match="the plots are"):
        top.plot("pie")
    for kind in ("conserved", "attitude"):
        with pytest.raises(TypeError, match="ax should be axes of matplotlib, not int"):
            top.plot(kind, ax=3)
    body = af.simulate(space="se3", metric="identity", initial={"velocity": [1, 2, 3, 4, 5, 6]}, output={"end": 0.1})
    with pytest.raises(ValueError, match="3 components, not 6"):
        body.plot("momentum")
    errors = af.convergence(TOP, "Omega1", ["simo-wong", "rkmk4"], [0.1, 0.05])
    assert 3 < errors["simo-wong"][0] / errors["simo-wong"][1] < 5
    assert errors["rkmk4"][0] / errors["rkmk4"][1] > 10
    with pytest.raises(TypeError, match="ax should be axes of matplotlib, not Figure"):
        errors.plot(plt.figure())
    kick, _ = errors.plot().lines
    np.testing.assert_array_equal(kick.get_xydata(), np.column_stack([[0.1, 0.05], errors["simo-wong"]]))


def test_convergence_in_classes_without_a_tolerance():
    """The reference is a run by a method of the class: errors fall with the order of the method."""
    pendulum = tomllib.loads((MOTIONS / "double_pendulum.toml").read_text())
    pendulum["output"].update(end=0.2, every=0.1)
    coning = tomllib.loads((MOTIONS / "coning.toml").read_text())
    coning["output"].update(end=2, every=1)
    for problem, column, method, order in ((pendulum, "qx_2", "generalised-alpha", 2), (coning, "qx", "magnus6", 6)):
        errors = af.convergence(problem, column, [method], [0.1 / 8, 0.1 / 16] if order == 2 else [0.5, 0.25])[method]
        assert order - 0.6 < np.log2(errors[0] / errors[1]) < order + 0.6, (method, errors)


def test_events():
    found = af.simulate({**TOP, "events": {"half": "t - 1/2"}, "output": {"end": 1, "every": 0.1, "stop": "half"}})
    assert found.events == [("half", pytest.approx(0.5))] and found.t[-1] == pytest.approx(0.5)


def test_ensembles():
    problem = af.Problem(MOTIONS / "ensemble_grid.toml")
    assert problem.ensemble_size == 15
    assert problem.member_parameters(3) == {"tilt": 0.2, "spin": 2.0}
    assert not np.array_equal(af.simulate(problem, member=0).rows, af.simulate(problem, member=3).rows)


def test_an_error_keeps_the_rows():
    singular = {**TOP, "forces": {"body": ["1/(1/2 - t)", 0, 0]}}
    with pytest.raises(af.IntegrationError) as found:
        af.simulate(singular)
    assert found.value.time == pytest.approx(0.5) and len(found.value.trajectory) == 5
    kept = af.simulate(singular, on_error="keep")
    assert len(kept) == 5 and isinstance(kept.error, af.IntegrationError)


def test_an_exception_of_a_force_keeps_the_rows():
    stopped = {**TOP, "forces": {"body": lambda t, g, omega: [0, 0, 0] if t < 0.6 else 1 / 0}}
    kept = af.simulate(stopped, on_error="keep")
    assert len(kept) == 6 and isinstance(kept.error, ZeroDivisionError)
    with pytest.raises(ZeroDivisionError) as found:
        af.simulate(stopped)
    assert len(found.value.trajectory) == 6


LONG = {**TOP, "output": {"end": 1e5, "every": 0.1}}


@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_ctrl_c_keeps_the_rows():
    def interrupted_after_the_first_report():
        """A report of progress, after which another thread sends the signal."""
        reported = threading.Event()

        def interrupt():
            if reported.wait(60):
                os.kill(os.getpid(), signal.SIGINT)

        threading.Thread(target=interrupt).start()
        return lambda share: reported.set()

    begun = time.monotonic()
    with pytest.warns(RuntimeWarning, match="interrupted"):
        top = af.simulate(LONG, progress=interrupted_after_the_first_report())
    assert top.interrupted and len(top) > 1 and time.monotonic() - begun < 10
    with pytest.raises(KeyboardInterrupt) as found:
        af.simulate(LONG, progress=interrupted_after_the_first_report(), on_interrupt="raise")
    assert len(found.value.trajectory) > 1


def test_progress():
    shares = []
    af.simulate(TOP, progress=shares.append)
    assert shares[-1] == 1 and shares == sorted(shares)
    af.simulate(TOP, progress=True)

    for wrong in ("yes", 1):
        with pytest.raises(TypeError, match="progress should be a truth value or a function, not"):
            af.simulate(TOP, progress=wrong)

    def stop(share):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        af.simulate(LONG, progress=stop)


def test_the_interpreter_is_free_meanwhile():
    counted, until = 0, time.monotonic() + 0.5

    def simulations():
        while time.monotonic() < until:
            af.simulate({**TOP, "output": {"end": 30, "every": 0.1}})

    thread = threading.Thread(target=simulations)
    thread.start()
    while thread.is_alive():
        counted += 1
        thread.join(0.001)
    assert counted > 5


def test_components_stand_in_their_order():
    keys = {"space": "so3", "metric": [1, 2, 3], "initial": {"velocity": [1, 2, 3]}}
    found = af.simulate(**keys, output={"end": 1, "columns": ["t", "Omega2", "H1", "Omega1", "Omega3"]})
    assert found["Omega"][0].tolist() == [1, 2, 3]


def test_members_are_those_of_the_ensemble():
    problem = af.Problem(space="so3", metric=[1, 2, 3], initial={"velocity": [1, 2, 3]}, output={"end": 1})
    for member in (1, 5, -1):
        with pytest.raises(ValueError, match="no ensemble"):
            af.simulate(problem, member=member)


TURN = {"space": "so3", "metric": [2, 3, 4], "initial": {"velocity": [0.3, 2, 0.1]}, "output": {"end": 4, "every": 2}}


def test_a_trajectory_at_other_times():
    motion = af.simulate(**TURN)
    times = np.array([3.0, 0.0, 1.7, 0.1, 1.7])
    found = motion(times)
    assert found.t.tolist() == times.tolist()
    dense = af.simulate(**{**TURN, "output": {"times": [0.1, 1.7, 3.0]}})
    assert np.array_equal(found.rows[3], dense.rows[1]) and np.array_equal(found.rows[4], dense.rows[2])
    assert np.array_equal(motion(0.1).rows[0], dense.rows[1])
    back = motion(-1.0)
    assert back.t.tolist() == [-1.0] and abs(back["energy"][0] - motion["energy"][0]) < 1e-12
    restored = pickle.loads(pickle.dumps(motion))
    assert np.array_equal(restored.rows, motion.rows)
    with pytest.raises(ValueError, match="unpickled"):
        restored(1.0)


def test_times_of_a_trajectory_are_checked():
    motion = af.simulate(**TURN)
    for t in (np.nan, [0, np.nan], np.inf):
        with pytest.raises(ValueError, match="t should have finite times, not (nan|inf)"):
            motion(t)
    with pytest.raises(ValueError, match=r"one axis, not of the shape \(2, 2\)"):
        motion([[0, 1], [1, 2]])
    with pytest.raises(ValueError, match="t has times on both sides of the initial time 0:"):
        motion([-1, 0, 1])
    assert motion([0, -1]).t.tolist() == [0, -1] and len(motion([])) == 0
    # the initial time is that of the problem, and need not be in the rows
    assert motion([3.0, 2.0])([1.0, 2.0]).t.tolist() == [1, 2]
    late = af.simulate(**{**TURN, "initial": {"time": 1, **TURN["initial"]}})
    np.testing.assert_allclose(late([1.5, 3])["H"], motion([0.5, 2])["H"], atol=1e-8)
    with pytest.raises(ValueError, match="the initial time 1:"):
        late([0.5, 1.5])
    short = af.simulate(**{**TURN, "output": {"end": 4, "every": 2, "columns": ["Omega1"]}})
    with pytest.raises(ValueError, match="add t to output.columns"):
        short(1)


def test_runs_that_end_early_have_no_later_times():
    keys = {**TURN, "events": {"half": "t - 1/2"}}
    stopped = af.simulate(**{**keys, "output": {"end": 4, "every": 0.2, "stop": "half"}})
    assert stopped([0.3, 0.1, 0.5]).t.tolist() == [0.3, 0.1, 0.5]
    with pytest.raises(ValueError, match=r"the run ends at t = 0\.5, before the requested time 0\.7"):
        stopped([0.1, 0.9, 0.7])
    # rows at a section give way to the times
    section = af.simulate(**{**keys, "output": {"end": 4, "section": "half"}})
    assert section.t.tolist() == pytest.approx([0.5])
    plain = af.simulate(**{**keys, "output": {"end": 4}})
    np.testing.assert_array_equal(section([0.1, 0.7]).rows, plain([0.1, 0.7]).rows)


def test_curves_are_smooth_whatever_the_rows():
    motion = af.simulate(**{**TURN, "output": {"end": 4, "every": 4}})
    axes = motion.plot("attitude")
    path = np.array(axes.lines[0].get_data_3d())
    assert path.shape[1] > 30 and np.allclose(np.linalg.norm(path, axis=0), 1)
    assert len(motion.plot("series", columns=["Omega1"]).lines[0].get_xdata()) > 20
    with pytest.raises(ValueError, match="projection '3d'"):
        motion.plot("momentum", ax=plt.figure().add_subplot())


def test_only_what_is_conserved_is_drawn_as_conserved():
    free = af.simulate(**TURN)
    assert free.conserved == ["h1", "h2", "h3", "energy", "casimir1"]
    heavy = af.simulate(**TURN, forces={"potential": "R33"}, quantities={"height": "R33"})
    assert heavy.conserved == ["energy"] and "height" in heavy.watched
    pushed = af.simulate(**TURN, forces={"body": ["-Omega1", 0, 0]})
    assert pushed.conserved == []
    with pytest.raises(ValueError, match="conserve no column"):
        pushed.plot()


def test_keys_are_in_the_signature():
    for function in (af.simulate, af.Problem):
        names = list(inspect.signature(function).parameters)
        assert {"metric", "constraints", "method", "every"} <= set(names)
    with pytest.raises(TypeError, match="did you mean 'metric'"):
        af.simulate(space="so3", metrik=[1, 1, 1])
    assert "rkmk853" in af.methods() and af.methods()["exact"]


def test_columns_of_sympy_are_components():
    t = sp.Symbol("t")
    force = sp.Matrix([sp.sin(t), 0, 0])
    found = af.simulate(**TURN, forces={"body": force})
    expected = af.simulate(**TURN, forces={"body": ["sin(t)", 0, 0]})
    assert np.array_equal(found.rows, expected.rows)
    with pytest.raises(ValueError, match="column"):
        af.simulate(**TURN, forces={"body": sp.eye(3)})


def test_functions_act_on_constrained_motions():
    # a pendulum in the plane with a torque about its axis, as a formula and as a function
    pendulum = {
        "space": "se3",
        "metric": [1, 1, 1, 1, 1, 1],
        "constraints": ["g14", "g24", "g34"],
        "initial": {"velocity": [0, 0, 1, 0, 0, 0]},
        "integrator": {"step": 0.01},
        "output": {"end": 1},
    }
    formula = af.simulate(**pendulum, forces={"body": [0, 0, "-Omega3", 0, 0, 0]})
    function = af.simulate(**pendulum, forces={"body": lambda t, g, omega: [0, 0, -omega[2], 0, 0, 0]})
    assert np.allclose(formula["Omega"], function["Omega"], atol=1e-9)
    assert abs(formula["Omega3"][-1] - np.exp(-1)) < 1e-4


def test_curves_on_charts_have_their_parameter_in_place_of_the_time():
    sphere = {"metric": [1, "sin(theta)^2"], "chart": {"coordinates": ["theta", "phi"]}}
    start = {"position": {"theta": "pi/2", "phi": 0}, "velocity": {"theta": 0, "phi": 1}}
    equator = af.simulate(definition=sphere, initial=start, output={"end": 1, "every": 0.5})
    assert equator.parameter == "s"
    assert equator.t.tolist() == [0, 0.5, 1]
    assert equator["phi"] == pytest.approx([0, 0.5, 1], abs=1e-9)
    assert equator([0.25, 0.75])["phi"] == pytest.approx([0.25, 0.75], abs=1e-9)
    columns, rows = equator.curve()
    assert columns[0] == "s" and len(rows) >= 3
    assert equator.plot("series", columns=["phi"]).get_xlabel() == "s"
