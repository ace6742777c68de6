"""JAX and PyTorch: values, derivatives, batches and types, in separate processes and together in one."""

import functools
import importlib.util
import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest

LIBRARIES = {"jax": "JAX", "torch": "PyTorch"}
PROGRAM = pathlib.Path(__file__).with_name("differentials.py")


@functools.cache
def derivatives(name):
    if importlib.util.find_spec(name) is None:
        pytest.skip(f"{LIBRARIES[name]} is not installed")
    done = subprocess.run([sys.executable, str(PROGRAM), name], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.xdist_group("differentials")
@pytest.mark.parametrize("name", LIBRARIES)
def test_derivatives_are_those_of_differences_in_60_digits(name):
    assert len(derivatives(name)) == 88


@pytest.mark.xdist_group("differentials")
def test_both_libraries_agree():
    first, second = (derivatives(name) for name in LIBRARIES)
    for key, matrix in first.items():
        np.testing.assert_allclose(matrix, second[key], atol=1e-14, err_msg=key)


@pytest.mark.parametrize("name, library", LIBRARIES.items())
def test_a_missing_library_is_named_with_its_extra(name, library):
    hidden = f"import sys; sys.modules[{name!r}] = None; import affinor.{name}"
    done = subprocess.run([sys.executable, "-c", hidden], capture_output=True, text=True)
    assert f"ImportError: affinor.{name} needs {library}: pip install 'affinor[{name}]'" in done.stderr
