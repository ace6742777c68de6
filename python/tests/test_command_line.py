"""The same values as the program ``affinor``, for the whole catalogue.

The program is that of AFFINOR_COMMAND, or of the folder ``target`` of the checkout.
"""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import affinor as af

ROOT = Path(__file__).resolve().parents[2]
CANDIDATES = [os.environ.get("AFFINOR_COMMAND", ""), *(str(ROOT / "target" / kind / "affinor") for kind in ("debug", "release"))]
COMMAND = next((path for path in CANDIDATES if path and Path(path).is_file()), None)
needs_command = pytest.mark.skipif(COMMAND is None, reason="the program affinor is not built")
LARGEST = 30


def run(*arguments, ok=True):
    done = subprocess.run([COMMAND, *map(str, arguments)], capture_output=True, text=True, encoding="utf-8", check=False)
    assert not ok or done.returncode == 0, done.stderr
    return done


def spaces():
    for _, _, example in af.catalogue():
        try:
            algebra = af.LieAlgebra(example)
        except af.AffinorError:
            continue
        if algebra.dimension <= LARGEST:
            yield example


@needs_command
@pytest.mark.parametrize("name", list(spaces()))
def test_catalogue(name):
    stored = json.loads(run("table", name, "--format", "json", "--show", "all").stdout)
    geometry = af.Geometry(name)
    assert json.loads(geometry.table("all", "json")) == stored
    for key, entry in stored["tensors"].items():
        found = geometry.quantity(key)
        components = {tuple(index - 1 for index in at): value for at, value in entry["components"]}
        assert dict(zip(map(tuple, found._indices().T.tolist()), found._texts(), strict=True)) == components
        if len(components) < 500:
            assert {at: str(value).replace("**", "^") for at, value in found.items() if not geometry.algebra.parameters} == (
                components if not geometry.algebra.parameters else {}
            )


@needs_command
@pytest.mark.parametrize("format", ["text", "markdown", "latex", "csv", "json"])
def test_formats(format):
    metric = "diag(a,b,c)"
    table = run("table", "so3", "--metric", metric, "--format", format).stdout
    assert af.Geometry("so3", metric=metric).table(format=format) == table
    assert af.compare(format=format) == run("compare", "--format", format).stdout


@needs_command
@pytest.mark.parametrize("program", [[sys.executable, "-m", "affinor"], [os.path.join(os.path.dirname(sys.executable), "affinor")]])
def test_the_program_of_the_package(program):
    for arguments in [["compare"], ["info", "sl(2)"], ["--help"], ["table", "nothing"], ["check", "[x,y]=z; [y,z]=y"], []]:
        done = subprocess.run([*program, *arguments], capture_output=True, encoding="utf-8", check=False)
        expected = run(*arguments, ok=False)
        assert (done.returncode, done.stdout, done.stderr) == (expected.returncode, expected.stdout, expected.stderr)


@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_an_interrupt_ends_the_program_of_the_package():
    program = subprocess.Popen([sys.executable, "-m", "affinor", "properties", "E8", "--metric", "identity"], stderr=subprocess.PIPE)
    time.sleep(3)
    program.send_signal(signal.SIGINT)
    _, message = program.communicate(timeout=60)
    assert program.returncode == 130
    assert b"interrupted" in message and b"Traceback" not in message


@needs_command
def test_messages():
    done = run("table", "--basis", "x y z", "--bracket", "[x,y]=z; [y,z]=y", ok=False)
    with pytest.raises(af.JacobiError) as found:
        af.LieAlgebra("[x,y]=z; [y,z]=y", basis="x y z")
    assert done.returncode == 1
    assert found.value.message in " ".join(done.stderr.split()) and found.value.help in " ".join(done.stderr.split())


@needs_command
@pytest.mark.parametrize("name", ["heavy_top.toml", "satellite.toml", "geodesic_se2.toml", "toda.toml", "manakov_so4.toml"])
def test_motions(name):
    path = ROOT / "examples" / "motions" / name
    rows = run("simulate", path).stdout.splitlines()
    found = af.simulate(path)
    assert rows[0].split(",") == found.columns
    np.testing.assert_array_equal(np.array([row.split(",") for row in rows[1:]], dtype=float), found.rows)


@needs_command
def test_groups():
    x = np.random.default_rng(0).normal(size=(5, 6))
    for row in x:
        numbers = run("exp", "se3", "--format", "json", ",".join(map(repr, row.tolist()))).stdout
        matrix = np.array(json.loads(numbers)["rows"][0] if isinstance(json.loads(numbers), dict) else json.loads(numbers)).reshape(4, 4)
        # rows of arrays use one series for all angles, single elements a shorter one for small angles
        np.testing.assert_allclose(af.SE3.matrix(af.SE3.exp(row)), matrix, rtol=1e-15, atol=4e-16)
