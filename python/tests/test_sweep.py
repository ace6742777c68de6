"""Sweeps: the same rows on every engine, failures as rows, and no lost or repeated rows if a worker is killed."""

import gc
import hashlib
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
import warnings
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

import affinor as af
from affinor._sweep import _Grid, _partition

pytest.importorskip("pyarrow")
pytestmark = pytest.mark.xdist_group("sweep")
ENGINES = ["client", "ray"] if os.environ.get("AFFINOR_RAY") == "1" else ["client"]
TOP = {
    "space": "so3",
    "metric": "diag(2, 2, 1)",
    "parameters": {"tilt": 0.3, "spin": 5},
    "initial": {"coordinates": ["tilt", 0, 0], "velocity": [0, 0, "spin"]},
    "forces": {"potential": "R33"},
    "output": {"end": 1, "every": 1},
}
MOTIONS = af.SimulationTask(TOP, columns=["Omega1", "energy"])
DRAW = af.RandomSample(60, seed=3, tilt="uniform(0.1, 1)", spin="normal(5, 1)")
METRICS = {"a": [1, 2, 0], "b": [1, 2], "c": [1, 2, 3]}
NAMES = {"name": ["so3", "so3xx", "sl2", "heisenberg(3)", "bianchi(IV)", "aff1", "se2", "R^3"]}


def is_einstein(row):
    geometry = af.Geometry("so3", metric=[row["a"], row["b"], row["c"]])
    found = geometry.check_property("einstein")
    return {"einstein": found.holds, "constant": found.value, "scalar": geometry.scalar_curvature}


def table_of(row):
    geometry = af.Geometry(row["name"])
    return {"ok": all(geometry.check()), "curvature": geometry.curvature.nnz, "killing": geometry.killing.nnz}


TASKS = {
    "motions": (MOTIONS, DRAW, 20),
    "metrics": (is_einstein, METRICS, 5),
    "algebras": (table_of, NAMES, 3),
}


def hashes(found):
    return {name: hashlib.sha256((found.folder / name).read_bytes()).hexdigest() for name in found.manifest["partitions"]}


@pytest.fixture(scope="module")
def in_process():
    return {name: af.sweep(task, grid, chunk=chunk) for name, (task, grid, chunk) in TASKS.items()}


def test_rows(in_process):
    frame = in_process["metrics"].to_pandas()
    assert len(frame) == 18 and list(frame["row"]) == list(range(18))
    assert frame["einstein"].sum() == 2 and set(frame[frame["einstein"] == True]["constant"]) == {"1/2", "1/4"}  # noqa: E712
    failed = frame[frame["a"] == 0]
    assert failed["error"].str.startswith("MetricError: the metric is degenerate").all() and failed["einstein"].isna().all()
    tops = in_process["motions"].to_pandas()
    one = af.simulate(TOP, set={"tilt": tops["tilt"][7], "spin": tops["spin"][7]})
    assert tops["Omega1"][7] == one["Omega1"][-1] and tops["energy"][7] == one["energy"][-1]
    algebras = in_process["algebras"].to_pandas()
    assert algebras["ok"].sum() == 7 and "so3xx" in algebras["error"][1]


def test_chunks_and_threads_change_no_row(in_process):
    other = af.sweep(MOTIONS, DRAW, chunk=7).to_pandas()
    assert other.equals(in_process["motions"].to_pandas())
    af.set_threads(1)
    try:
        assert hashes(af.sweep(*TASKS["motions"][:2], chunk=20)) == hashes(in_process["motions"])
    finally:
        af.set_threads(0)


def test_a_data_frame_is_a_grid():
    pd = pytest.importorskip("pandas")
    grid = pd.DataFrame({"a": [1, 2], "b": [1, 2], "c": [1, 2]})
    assert af.sweep(is_einstein, grid).to_pandas()["einstein"].all()


def test_rows_without_a_folder_live_as_long_as_their_sweep():
    # gone when the sweep is, without a warning of what was not closed
    with warnings.catch_warnings(record=True) as raised:
        warnings.simplefilter("always", ResourceWarning)
        found = af.sweep(MOTIONS, DRAW, chunk=20)
        gc.collect()
        assert len(found.to_pandas()) == 60
        folder = found.folder
        del found
        gc.collect()
        assert not folder.exists()
        with pytest.raises(ValueError, match="unknown"):
            af.sweep(MOTIONS, DRAW, on="unknown")
        gc.collect()
    assert not [warning for warning in raised if "TemporaryDirectory" in str(warning.message)]


def test_draws_are_reproducible():
    assert DRAW.rows(10, 20) == {name: values[10:20] for name, values in DRAW.rows(0, 60).items()}
    long = af.RandomSample(9000, seed=3, tilt="uniform(0.1, 1)", spin="normal(5, 1)", which=["x", "y"])
    assert long.rows(4090, 4100)["spin"] == long.rows(0, 9000)["spin"][4090:4100]
    assert af.RandomSample(5, seed=4, x="uniform(0, 1)").rows(0, 5) != af.RandomSample(5, seed=5, x="uniform(0, 1)").rows(0, 5)


def test_it_goes_on_where_it_was(tmp_path, in_process):
    out = tmp_path / "rows"
    whole = af.sweep(MOTIONS, DRAW, chunk=20, out=out)
    assert whole.computed == 3 and af.sweep(MOTIONS, DRAW, chunk=20, out=out).computed == 0
    (out / "part-000001.parquet").unlink()
    (out / ".part-000001.parquet.1.2.tmp").write_bytes(b"half of a partition")
    (out / "part-000002.parquet").write_bytes(b"damaged")
    again = af.sweep(MOTIONS, DRAW, chunk=20, out=out)
    assert again.computed == 2 and hashes(again) == hashes(in_process["motions"])
    with pytest.raises(ValueError, match="another"):
        af.sweep(MOTIONS, af.RandomSample(60, seed=4, tilt="uniform(0.1, 1)"), chunk=20, out=out)


def test_a_killed_driver_goes_on(tmp_path):
    script = tmp_path / "driver.py"
    script.write_text(
        textwrap.dedent(
            f"""
            import os, signal, sys
            import affinor as af
            def task(row):
                if row["x"] == 7 and not os.path.exists({str(tmp_path / "mark")!r}):
                    open({str(tmp_path / "mark")!r}, "w").close()
                    os.kill(os.getpid(), signal.SIGKILL)
                return {{"y": row["x"] ** 2}}
            found = af.sweep(task, {{"x": list(range(10))}}, chunk=2, out={str(tmp_path / "rows")!r})
            print(found.computed, found.to_pandas()["y"].tolist())
            """
        )
    )
    first = subprocess.run([sys.executable, script], capture_output=True, text=True, check=False)
    assert first.returncode == -signal.SIGKILL
    second = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True)
    assert second.stdout.split(" ", 1) == ["2", f"{[x * x for x in range(10)]}\n"]


def kills_its_worker_once(row):
    """The worker of row 9 kills itself; the marker file remembers that it did."""
    mark = Path(row["mark"])
    if row["x"] == 9 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return {"y": row["x"] ** 2}


def harmless(row):
    return {"y": row["x"] ** 2}


@pytest.fixture(scope="module")
def client():
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        # workers cannot import the tests
        pytest.importorskip("cloudpickle").register_pickle_by_value(sys.modules[__name__])
        yield client


@pytest.fixture(scope="module")
def ray():
    ray = pytest.importorskip("ray")
    ray.cloudpickle.register_pickle_by_value(sys.modules[__name__])
    ray.init(num_cpus=2, include_dashboard=False, object_store_memory=100 << 20, log_to_driver=False)
    yield "ray"
    ray.shutdown()


@pytest.mark.cluster
@pytest.mark.parametrize("engine", ENGINES)
def test_the_same_rows_on_a_cluster(engine, in_process, request):
    on = request.getfixturevalue(engine)
    for name, (task, grid, chunk) in TASKS.items():
        assert hashes(af.sweep(task, grid, chunk=chunk, on=on)) == hashes(in_process[name]), name


@pytest.mark.cluster
@pytest.mark.parametrize("engine", ENGINES)
def test_a_killed_worker_loses_and_doubles_nothing(engine, tmp_path, request):
    on = request.getfixturevalue(engine)
    grid = {"mark": [str(tmp_path / "mark")], "x": list(range(20))}
    found = af.sweep(kills_its_worker_once, grid, chunk=3, on=on)
    assert (tmp_path / "mark").exists()
    frame = found.to_pandas()
    assert frame["row"].tolist() == list(range(20)) and frame["y"].tolist() == [x * x for x in range(20)]
    assert hashes(found) == hashes(af.sweep(harmless, grid, chunk=3))
    assert not list(found.folder.glob("*.tmp"))


def test_a_folder_belongs_to_one_version_of_a_task(tmp_path):
    rows = af.sweep(harmless, {"x": [1, 2]}, out=tmp_path, version="1").to_pandas()
    assert rows["y"].tolist() == [1, 4]
    assert af.sweep(harmless, {"x": [1, 2]}, out=tmp_path, version="1").computed == 0
    for other, options in (("version", {}), ("chunk", {"version": "1", "chunk": 1})):
        with pytest.raises(ValueError, match=f"another {other}"):
            af.sweep(harmless, {"x": [1, 2]}, out=tmp_path, **options)


def test_names_and_seeds_of_sweeps():
    for grid in ({"row": [1]}, {"error": [1]}, {}):
        with pytest.raises(ValueError, match="rename the parameter|at least one"):
            af.sweep(harmless, grid)
    for seed in (-1, 2**64):
        with pytest.raises(ValueError, match="the seed should be from 0"):
            af.RandomSample(1, seed=seed, a="uniform(0, 1)")
    drawn = [af.RandomSample(1, seed=seed, a="uniform(0, 1)").rows(0, 1)["a"] for seed in (2**63, 2**63 + 1, 2**64 - 1)]
    assert len({value for (value,) in drawn}) == 3


def test_interrupts_end_tasks_of_sweeps(monkeypatch):
    class Interrupted(af.Problem):
        def _run(self, member, tell):
            return {**super()._run(member, tell), "interrupt": KeyboardInterrupt()}

    problem = Interrupted(space="so3", metric=[1, 2, 3], initial={"velocity": [0, 0, 1]}, output={"end": 1})

    def task(row):
        return {"t": af.simulate(problem).t[-1]}

    with pytest.raises(KeyboardInterrupt):
        af.sweep(task, {"x": [1, 2]})
    with pytest.warns(RuntimeWarning, match="interrupted"):
        task({})


def test_a_force_of_python_is_not_entered_twice():
    inside, entered = threading.local(), []
    vectors = np.full((5_000, 6), 0.3)

    def force(t, g, omega):
        entered.append(getattr(inside, "now", False))
        if entered[-1]:
            return [0, 0, 0]
        inside.now = True
        found = af.SE3.exp(vectors)[0, :3] * 0
        inside.now = False
        return found

    before = af.threads()
    af.set_threads(16)
    try:
        motions = af.SimulationTask(
            space="so3", metric=[1, 2, 3], parameters={"v": 1}, initial={"velocity": [1, 1, "v"]},
            forces={"body": force}, output={"end": 0.5, "every": 0.5}, method="rkmk4", step=0.5, columns=["Omega3"],
        )  # fmt: skip
        table = af.sweep(motions, {"v": [k / 40 for k in range(120)]}).to_pandas()
    finally:
        af.set_threads(before)
    assert table.error.isna().all() and entered and not any(entered)


def test_exceptions_of_forces_are_errors_of_their_rows():
    def force(t, g, omega):
        if omega[2] > 5:
            raise RuntimeError("too fast")
        return [0, 0, 0]

    keys = {"space": "so3", "metric": [1, 2, 3], "parameters": {"v": 1}, "initial": {"velocity": [0, 0, "v"]}}
    problem = af.Problem(**keys, forces={"body": force}, output={"end": 1, "every": 0.5})
    table = af.sweep(af.SimulationTask(problem, columns=["Omega3"]), {"v": [1, 10, 2]}).to_pandas()
    assert table.error[[0, 2]].isna().all() and table.error[1] == "RuntimeError: too fast"
    np.testing.assert_allclose(af.simulate(problem)["Omega3"], 1)


@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_ctrl_c_ends_a_chunk_of_motions():
    motions = af.SimulationTask({**TOP, "output": {"end": 1e5, "every": 1e5}})
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        af.sweep(motions, {"spin": [5 + k / 100 for k in range(200)]})
    assert time.monotonic() - begun < 10


def columns(task, grid, **options):
    table = af.sweep(task, grid, **options).to_arrow()
    return table["x"].to_pylist(), [error is not None for error in table["error"].to_pylist()]


@pytest.mark.parametrize(
    "values, expected",
    [
        ([1, 0.5, 2**53], [1.0, 0.5, 2.0**53]),
        ([0.5, 2**60 + 1, None], [0.5, "error", None]),
        ([2**60 + 1, 0.5, 3], [2**60 + 1, "error", 3]),
        ([1, True, 2], [1, "error", 2]),
        ([True, 0.5, False], [True, "error", False]),
        (["a", 1, "b"], ["a", "error", "b"]),
        ([1, 2**70, 3], [1, "error", 3]),
        ([[1], [0.5], [2]], [[1.0], [0.5], [2.0]]),
        ([[1], ["a"], 2], [[1], "error", "error"]),
        ([np.longdouble(0.5), np.int64(1), np.float32(2)], [0.5, 1.0, 2.0]),
        ([Fraction(1, 2), Fraction(2), None], ["1/2", "2", None]),
        ([np.arange(2), np.zeros(0), None], [[0, 1], [], None]),
    ],
)
def test_a_column_has_one_kind(values, expected):
    found, failed = columns(lambda row: {"x": values[row["a"]]}, {"a": [0, 1, 2]})
    assert failed == [isinstance(value, str) and value == "error" for value in expected]
    assert found == [None if bad else value for bad, value in zip(failed, expected, strict=True)]


@pytest.mark.parametrize("value, kind", [(object(), "object"), (1j, "complex"), ({"a": 1}, "dict"), (b"a", "bytes"), ([1j], "complex"), (np.complex64(1), "complex"), (np.eye(2) * 1j, "complex")])
def test_objects_are_no_results(value, kind):
    table = af.sweep(lambda row: {"x": value if row["a"] == 1 else 2}, {"a": [0, 1, 2]}).to_pandas()
    assert table["error"].isna().tolist() == [True, False, True]
    assert table["error"][1] == f"TypeError: the result 'x' should be a number, a text, a truth value, a list or an array, not {kind}"


def test_exact_results_are_texts_and_arrays_are_lists():
    x = sp.Symbol("x")
    results = {"a": Decimal("0.1"), "b": x**2 / 2, "c": sp.Matrix([[x, 1]]), "d": af.Geometry("so3@zero").ricci, "e": np.array(0.5)}
    row = af.sweep(lambda row: results, {"n": [1]}).to_arrow().to_pylist()[0]
    assert row["error"] is None and row["a"] == "0.1" and row["b"] == "x**2/2" and row["c"] == [["x", "1"]]
    assert row["d"][0] == [0.5, 0, 0] and row["e"] == 0.5


def test_ranges_are_read_row_by_row(tmp_path):
    grid = {"x": range(10**6), "y": range(0, 2**21, 2)}
    source = _Grid(grid)
    assert len(source) == 2**20 * 10**6 and source.rows(2**20 + 3, 2**20 + 5) == {"x": [1, 1], "y": [6, 8]}
    long = _Grid({"z": range(10**9), "a": [1, 2]})
    assert len(long) == 2 * 10**9 and long.rows(10**9, 10**9 + 1) == {"z": [5 * 10**8], "a": [1]}
    assert long.kinds == {"z": "integer", "a": "integer"} and long.digest() != _Grid({"z": range(1, 10**9 + 1), "a": [1, 2]}).digest()
    assert _Grid({"x": range(9)}).digest() == _Grid({"x": list(range(9))}).digest()
    with pytest.raises(TypeError, match="64 bits"):
        _Grid({"x": range(2**63, 2**63 + 2**21)})
    # the first error ends such a sweep, whose other chunks are not listed
    with pytest.raises(ValueError, match="name of another column"):
        af.sweep(lambda row: {"a": 1}, {"z": range(10**9), "a": [1, 2]}, chunk=1, out=tmp_path)
    for huge in ({"x": range(10**9), "z": range(10**9)}, {"x": range(10**30)}, af.RandomSample(2**41, a="uniform(0, 1)")):
        with pytest.raises(ValueError, match=r"the grid has \d+ rows, but a sweep has at most 2\^40"):
            af.sweep(lambda row: {}, huge)


def test_partitions_of_other_kinds_end_a_sweep(tmp_path):
    def task(row):
        return {"x": "text" if row["a"] == 2 else row["a"]}

    for _ in range(2):
        with pytest.raises(TypeError, match="'x' has values of two kinds, integer and text"):
            af.sweep(task, {"a": list(range(100))}, chunk=2, out=tmp_path)
        assert len(list(tmp_path.glob("part-*"))) == 2
    with pytest.raises(TypeError, match="two kinds, long integer and float"):
        af.sweep(lambda row: {"x": 2**60 + 1 if row["a"] < 2 else 0.5}, {"a": [0, 1, 2]}, chunk=1)
    assert columns(lambda row: {"x": 1 if row["a"] < 2 else 0.5}, {"a": [0, 1, 2]}, chunk=1)[0] == [1, 1, 0.5]


def test_columns_of_a_grid_have_one_kind():
    for values in ([2**60 + 1, 0.5], [1, "a"], [True, 1], [2**70]):
        with pytest.raises(TypeError, match="two kinds|64 bits"):
            af.sweep(lambda row: {"x": 1}, {"a": values})
        with pytest.raises(TypeError, match="two kinds|64 bits"):
            af.sweep(lambda row: {"x": 1}, af.RandomSample(2, a=values))
    table = af.sweep(lambda row: {"x": str(row["a"] / 2)}, {"a": [1, Fraction(1, 2)]}, chunk=np.int64(1)).to_arrow()
    assert table["a"].to_pylist() == ["1", "1/2"] and table["x"].to_pylist() == ["0.5", "1/4"]


def test_a_partition_leaves_the_number_of_threads(tmp_path):
    af.set_threads(3)
    try:
        _partition(lambda row: {"x": af.threads()}, 0, {"a": [1]}, {"a": "integer"}, str(tmp_path), "part.parquet", 1)
        assert af.threads() == 3
    finally:
        af.set_threads(0)


def test_columns_of_motions_by_their_stems():
    table = af.sweep(af.SimulationTask(TOP, columns=["energy", "Omega"]), {"spin": [1, 2]}).to_arrow()
    assert table.column_names == ["row", "spin", "energy", "Omega1", "Omega2", "Omega3", "error"]
    with pytest.raises(KeyError, match="no column 'Phi'"):
        af.sweep(af.SimulationTask(TOP, columns=["Phi"]), {"spin": [1]})


def test_a_task_that_exits_is_an_error_of_its_row(tmp_path):
    def task(row):
        if row["a"] == 1:
            raise SystemExit(3)
        return {"b": row["a"]}

    found = af.sweep(task, {"a": [0, 1, 2]}, out=tmp_path / "exits").to_pandas()
    assert found["error"].isna().tolist() == [True, False, True] and found["error"][1] == "SystemExit: 3"


def test_a_broken_manifest_and_an_empty_grid_are_named(tmp_path):
    folder = tmp_path / "rows"
    af.sweep(lambda row: {}, {"a": [1]}, out=folder)
    for text in ("", "{", "[]", "{}"):
        (folder / "_affinor.json").write_text(text)
        with pytest.raises(ValueError, match="does not describe a sweep"):
            af.sweep(lambda row: {}, {"a": [1]}, out=folder)
    with pytest.raises(ValueError, match="the list of b is empty"):
        af.sweep(lambda row: {}, {"a": [1], "b": []})
