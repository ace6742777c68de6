"""Calls that are stopped by signals, and by limits on time and memory."""

import contextvars
import gc
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import sympy as sp

import affinor as af
from affinor import _limits

RANDOM = np.random.default_rng(5).integers(-3, 4, size=(28, 28))
DENSE = (RANDOM.T @ RANDOM + 28 * np.eye(28, dtype=int)).tolist()

TOP = {"space": "so3", "metric": [1, 2, 3], "initial": {"velocity": [0.1, 2, 0.1]}}


def metric(n):
    return [[DENSE[i][j] for j in range(n)] for i in range(n)]


def symbols(n):
    return sp.Matrix(n, n, lambda i, j: sp.Symbol(f"g{min(i, j)}_{max(i, j)}"))


def scrambled(name):
    algebra = af.LieAlgebra(name)
    return algebra.change_basis(metric(algebra.dimension))


LONG = {
    "curvature": lambda: af.Geometry("se3", metric=symbols(6)).curvature,
    "properties": lambda: af.Geometry("se3", metric=symbols(6)).properties(),
    "exact": lambda: af.Geometry("so(8)", metric=metric(28)).nabla_curvature,
    "extremes": lambda: [af.Geometry("so(5)", metric=metric(10)).properties() for _ in range(9)],
    "holonomy": lambda: af.Geometry("so(6)", metric=metric(15)).holonomy(),
    "info": lambda: scrambled("so(7)+heisenberg(7)").info(),
    "E8": lambda: af.Geometry("E8", metric=list(range(1, 249))).nabla_curvature,
    "check": lambda: [af.Geometry("E8@zero").nabla_curvature for _ in range(9)],
    "transport": lambda: af.Geometry("E7@zero").transport(np.full((50, 133), 0.1)),
    "exponentials": lambda: af.Group("so(12)").exp(np.broadcast_to(np.full(66, 0.1), (200_000, 66))),
    "contraction": lambda: [af.contract("^i_jk ^j_il -> _kl", c, c) for c in 10**6 * [af.LieAlgebra("E8").structure]],
    "motions": lambda: af.convergence(
        {**TOP, "output": {"end": 1e6, "every": 1e6}}, "Omega1", methods=["rkmk4"], steps=[1e-3]
    ),
}
every = pytest.mark.parametrize("name", LONG)
posix = pytest.mark.skipif(os.name != "posix", reason="signals")


def results():
    geometry = af.Geometry("so3", metric=symbols(3))
    return geometry.table() + str(af.Geometry("so4", metric=metric(6)).ricci) + str(scrambled("so4").info())


@pytest.fixture(scope="module")
def fresh():
    """The results of another process."""
    code = "import test_stops; print(test_stops.results())"
    folder = os.path.dirname(__file__)
    return subprocess.run(
        [sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, check=True
    ).stdout.removesuffix("\n")


@pytest.fixture
def no_collection():
    """Python drops an interrupt that arrives in a callback of its garbage collector."""
    gc.collect()
    gc.disable()
    yield
    gc.enable()


@posix
@every
@pytest.mark.parametrize("threads", [1, 3])
def test_ctrl_c_interrupts(name, threads, fresh, no_collection):
    before = af.threads()

    def interrupt():
        time.sleep(0.3)
        os.kill(os.getpid(), signal.SIGINT)

    af.set_threads(threads)
    try:
        threading.Thread(target=interrupt).start()
        with pytest.raises(KeyboardInterrupt):
            LONG[name]()
        assert results() == fresh
    finally:
        af.set_threads(before)


@every
def test_a_timeout_ends_every_call(name):
    with pytest.raises(af.LimitError, match="exceeds its time limit of 0.4 s") as found:
        with af.limits(timeout=0.4):
            LONG[name]()
    assert found.value.limit == "timeout" and "timeout=" in found.value.help
    # limits that are not reached change nothing
    with af.limits(timeout=1000):
        assert af.Geometry("so3@zero").scalar == "exact"


def test_a_limit_names_the_stage():
    geometry = af.Geometry("se3", metric=symbols(6))
    with pytest.raises(af.LimitError, match="in the stage `curvature`") as found, af.limits(timeout=0.5):
        geometry.curvature  # noqa: B018
    assert found.value.stage == "curvature"


@pytest.mark.skipif(sys.platform != "linux", reason="the size of the process")
def test_a_limit_on_the_memory():
    with open("/proc/self/status") as status:
        size = next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))
    with pytest.raises(af.LimitError, match="memory limit of") as found:
        with af.limits(memory=f"{size + 20_000}K"):
            LONG["curvature"]()
    assert found.value.limit == "memory"
    with af.limits(memory="1024G"):
        af.Geometry("so3@zero").table()


def test_blocks_nest():
    with af.limits(timeout=1000), af.limits(timeout=0):
        with pytest.raises(af.LimitError), af.limits(timeout=1000):
            af.Geometry("so3@zero").table()
    af.Geometry("so3@zero").table()
    # another thread has separate limits
    found = []
    with af.limits(timeout=0):
        thread = threading.Thread(target=lambda: found.append(af.Geometry("so3@zero").table()))
        thread.start()
        thread.join()
    assert found


@pytest.mark.parametrize("wrong", [{"timeout": -1}, {"timeout": float("nan")}, {"memory": "much"}, {"memory": -5}])
def test_limits_are_numbers(wrong):
    with pytest.raises(ValueError), af.limits(**wrong):
        pass


@pytest.mark.parametrize(
    "wrong, error, words",
    [
        ({"timeout": "5"}, TypeError, "timeout should be a number of seconds, not str"),
        ({"timeout": True}, TypeError, "timeout should be .* not bool"),
        ({"memory": b"2G"}, TypeError, "memory should be .* not bytes"),
        ({"memory": "8X"}, ValueError, "memory should be a size such as 800M or 2G, not 8X"),
    ],
)
def test_a_wrong_limit_is_named(wrong, error, words):
    with pytest.raises(error, match=words):
        af.limits(**wrong)


def is_limited():
    try:
        af.Geometry("so3@zero").table()
    except af.LimitError:
        return True
    return False


def block(**keys):
    with af.limits(**keys):
        yield


@pytest.mark.parametrize("first, second", [(0, 1000), (1000, 0)])
def test_blocks_end_in_any_order(first, second):
    one, other = block(timeout=first), block(timeout=second)
    next(one)
    next(other)
    assert is_limited()
    one.close()
    assert is_limited() == (second == 0)
    with af.limits(timeout=1000):
        assert is_limited() == (second == 0)
    other.close()
    assert not is_limited() and _limits.current.get() is None


def test_a_time_limit_keeps_its_deadline_when_an_outer_block_ends():
    one, other = block(timeout=1000, memory="1024G"), block(timeout=0.3)
    next(one)
    next(other)
    time.sleep(0.4)
    one.close()
    # a limit that began anew would not have passed yet
    assert is_limited()
    other.close()
    assert not is_limited()


def test_a_block_ends_in_another_context():
    stopped = block(timeout=0)
    thread = threading.Thread(target=next, args=(stopped,))
    thread.start()
    thread.join()
    stopped.close()
    assert not is_limited()
    # a copy of a context has no limits of blocks that have ended
    with af.limits(timeout=0):
        copied = contextvars.copy_context()
        assert copied.run(is_limited)
    assert not copied.run(is_limited)


def test_limits_are_used_again():
    stop = af.limits(timeout=0)
    for _ in range(2):
        with stop:
            with stop:
                assert is_limited()
            assert is_limited()
        assert not is_limited()
    assert stop(is_limited)() and not is_limited()
    with stop:
        thread = threading.Thread(target=stop(is_limited))
        thread.start()
        thread.join()
        assert is_limited()
    assert not is_limited()


def test_a_limit_keeps_the_rows_of_a_motion():
    # the first report comes after some rows, and waits for the limit
    with pytest.raises(af.LimitError) as found, af.limits(timeout=3):
        af.simulate({**TOP, "output": {"end": 1e6, "every": 0.1}}, progress=lambda share: time.sleep(3))
    assert len(found.value.trajectory) > 1


def test_caches_are_cleared():
    before = results()
    af.clear_caches()
    assert results() == before
