"""Processes, threads, memory and the cost of a call."""

import concurrent.futures
import gc
import multiprocessing
import os
import sys
import threading

import numpy as np
import pytest
import sympy as sp

import affinor as af
from affinor import SE3, SO3

a = sp.Symbol("a", positive=True)


def ricci_of(algebra):
    return af.Geometry(algebra, metric=[a, 1, 1]).ricci


def batch(seed):
    return SO3.exp(np.random.default_rng(seed).normal(size=(5000, 3)))


def bulk(seed):
    """Results of kernels and of a recorded program, on several threads."""
    rng = np.random.default_rng(seed)
    x = 0.5 * rng.normal(size=(30_000, 6))
    metrics = np.eye(3) + 0.1 * np.ones((9000, 3, 3)) * rng.uniform(size=(9000, 1, 1))
    found = [SE3.left_jacobian(x), SE3.adjoint_matrix(SE3.exp(x)), af.Geometries("so3", metrics).ricci]
    return np.concatenate([part.ravel() for part in found])


@pytest.mark.parametrize("method", ["spawn", "fork"])
def test_other_processes(method):
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"no {method} here")
    bulk(0)  # the pool of this process has threads now
    context = multiprocessing.get_context(method)
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
        found = list(pool.map(ricci_of, [af.LieAlgebra("so3"), af.LieAlgebra("sl2")], timeout=60))
        np.testing.assert_array_equal(pool.submit(batch, 3).result(timeout=60), batch(3))
        np.testing.assert_array_equal(pool.submit(bulk, 3).result(timeout=60), bulk(3))
        failed = pool.submit(af.LieAlgebra, {"basis": ["x", "y", "z"], "brackets": "[x,y]=z; [y,z]=y"})
        with pytest.raises(af.JacobiError) as error:
            failed.result(timeout=60)
    assert found[0] == ricci_of("so3") and found[1] == ricci_of("sl2")
    assert found[0][0, 0].free_symbols == {a}
    assert error.value.triple == ("x", "y", "z")


def test_threads():
    expected, tensor, wide = batch(1), ricci_of("so3"), bulk(1)

    def work(at):
        np.testing.assert_array_equal(batch(1), expected)
        assert ricci_of("so3") == tensor
        if at % 10 == 0:
            np.testing.assert_array_equal(bulk(1), wide)
        return True

    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        assert all(pool.map(work, range(40)))


def test_the_number_of_threads_changes_nothing():
    expected, before = batch(2), af.threads()
    try:
        af.set_threads(1)
        assert af.threads() == 1
        np.testing.assert_array_equal(batch(2), expected)
    finally:
        af.set_threads(0)
    assert af.threads() == before


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
def test_memory_is_flat():
    x, algebra = np.ones(3), af.LieAlgebra("so3")
    pose, bodies = SE3.random(rng=1), af.Geometries("so3", np.eye(3) * np.arange(1.0, 50)[:, None, None])
    structure = algebra.structure

    def calls(count):
        for at in range(count):
            SO3.compose(SO3.exp(x), SO3.identity())
            SE3.left_jacobian(SE3.log(pose))
            SE3.from_matrix(SE3.matrix(pose), check=False)
            if at % 10 == 0:
                structure + structure
                structure.to_coo()
            if at % 100 == 0:
                with pytest.raises(ValueError):
                    SO3.exp([1, 2])
                with pytest.raises(af.MetricError):
                    af.Geometries("so3", np.zeros((3, 3)))
                assert np.isfinite(bodies.derivative("ricci", bodies.metric)).all()
                hash(af.LieAlgebra("heisenberg(3)"))
        gc.collect()

    calls(5_000)
    before = resident()
    calls(100_000)
    assert resident() - before < 8 << 20


def test_many_threads_raise_their_own_errors():
    failures = []

    def work(name):
        try:
            af.LieAlgebra(name)
        except af.InputError as error:
            failures.append(name in str(error))

    threads = [threading.Thread(target=work, args=(f"nothing{at}",)) for at in range(20)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == [True] * 20
