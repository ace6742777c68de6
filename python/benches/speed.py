"""Speed against SciPy, jaxlie, geomstats and SymPy, in one run: times and ratios.

    python python/benches/speed.py [--count 1000000]

Needs an installed release of affinor; peers that are not installed are left out. Every time is the best of several.
"""

from __future__ import annotations

import argparse
import platform
import sys
import time
from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

import affinor as af

REPEATS = 5
Calls = dict[str, Callable[[], Any]]


def best(call: Callable[[], Any], repeats: int = REPEATS) -> float:
    """The shortest time of a call, in seconds, after one call that warms up."""
    call()
    times = []
    for _ in range(repeats):
        begun = time.perf_counter()
        call()
        times.append(time.perf_counter() - begun)
    return min(times)


def paired(calls: Calls, repeats: int = 15) -> dict[str, float]:
    """The shortest time of each call; the calls take turns, so that a busy machine is equally busy for all."""
    times: dict[str, list[float]] = {name: [] for name in calls}
    for repeat in range(repeats + 1):
        for name, call in calls.items():
            begun = time.perf_counter()
            call()
            if repeat:
                times[name].append(time.perf_counter() - begun)
    return {name: min(found) for name, found in times.items()}


def show(title: str, times: dict[str, float], unit: float = 1e3, name: str = "ms") -> None:
    ours = times["affinor"]
    print(f"\n{title}")
    for peer, seconds in times.items():
        ratio = "" if peer == "affinor" else f"   {seconds / ours:8.1f} x"
        print(f"  {peer:28}{seconds * unit:12.3f} {name}{ratio}")


def rotations(count: int) -> None:
    rng = np.random.default_rng(0)
    x = rng.normal(size=(count, 3))
    g, h = af.SO3.exp(x), af.SO3.exp(x[::-1].copy())
    exp: Calls = {"affinor": lambda: af.SO3.exp(x)}
    log: Calls = {"affinor": lambda: af.SO3.log(g)}
    compose: Calls = {"affinor": lambda: af.SO3.compose(g, h)}
    try:
        from scipy.spatial.transform import Rotation

        a, b = Rotation.from_rotvec(x), Rotation.from_quat(np.roll(h, -1, axis=-1))
        exp["SciPy"] = lambda: Rotation.from_rotvec(x)
        log["SciPy"] = lambda: a.as_rotvec()
        compose["SciPy"] = lambda: a * b
    except ImportError:
        pass
    try:
        import jax
        import jaxlie

        jax.config.update("jax_enable_x64", True)
        vectors, first, second = (jax.numpy.asarray(array) for array in (x, g, h))
        exp_jit = jax.jit(lambda v: jaxlie.SO3.exp(v).wxyz)
        log_jit = jax.jit(lambda q: jaxlie.SO3(q).log())
        compose_jit = jax.jit(lambda p, q: (jaxlie.SO3(p) @ jaxlie.SO3(q)).wxyz)
        exp["jaxlie (jit, CPU, float64)"] = lambda: exp_jit(vectors).block_until_ready()
        log["jaxlie (jit, CPU, float64)"] = lambda: log_jit(first).block_until_ready()
        compose["jaxlie (jit, CPU, float64)"] = lambda: compose_jit(first, second).block_until_ready()
    except ImportError:
        pass
    try:
        from geomstats.geometry.special_orthogonal import SpecialOrthogonal

        group = SpecialOrthogonal(3, point_type="vector")
        group_matrices = SpecialOrthogonal(3, point_type="matrix")
        matrices = group.matrix_from_rotation_vector(x)
        exp["geomstats"] = lambda: group.matrix_from_rotation_vector(x)
        log["geomstats"] = lambda: group.rotation_vector_from_matrix(matrices)
        compose["geomstats (matrices)"] = lambda: group_matrices.compose(matrices, matrices)
    except ImportError:
        pass
    show(f"exp of {count} rotation vectors", paired(exp))
    show(f"log of {count} rotations", paired(log))
    show(f"products of {count} pairs of rotations", paired(compose))


def one_vector() -> None:
    x, count = np.array([0.1, 0.2, 0.3]), 20_000
    times = {"affinor": best(lambda: [af.SO3.exp(x) for _ in range(count)]) / count}
    try:
        from scipy.spatial.transform import Rotation

        times["SciPy"] = best(lambda: [Rotation.from_rotvec(x) for _ in range(count)], 2) / count
    except ImportError:
        pass
    show("exp of one vector, a call", times, 1e6, "us")


def small_geometries(count: int = 1000) -> None:
    def ours() -> None:
        for at in range(count):
            af.Geometry("so3", metric=f"diag(a, b, {at + 1})").ricci

    times, few = {"affinor": best(ours, 2)}, 10
    try:
        import sympy as sp

        a, b = sp.symbols("a b", positive=True)
        c = {(i, j, k): sp.LeviCivita(i, j, k) for i in range(3) for j in range(3) for k in range(3)}

        def by_sympy(last: int) -> Any:
            g = sp.diag(a, b, last)
            inverse, span = g.inv(), range(3)
            lower = lambda i, j, k: sum(g[i, m] * c[m, j, k] for m in span)  # noqa: E731
            lam = [
                [
                    [
                        sum(inverse[i, m] * (lower(m, j, k) - lower(j, k, m) + lower(k, m, j)) for m in span) / 2
                        for k in span
                    ]
                    for j in span
                ]
                for i in span
            ]
            ricci = [
                [
                    sum(
                        lam[i][i][m] * lam[m][l][j] - lam[i][l][m] * lam[m][i][j] - c[m, i, l] * lam[i][m][j]
                        for i in span
                        for m in span
                    )
                    for l in span
                ]
                for j in span
            ]
            return sp.Matrix(ricci).applyfunc(sp.cancel)

        from components import ricci

        assert (ricci(sp.diag(a, b, 7), c) - by_sympy(7)).applyfunc(sp.cancel).is_zero_matrix
        by_sage = lambda: [ricci(sp.diag(a, b, at + 1), c) for at in range(few)]  # noqa: E731
        times["SymPy, as SageManifolds"] = best(by_sage, 1) * count / few
        times["SymPy, loops over a frame"] = best(lambda: [by_sympy(at + 1) for at in range(few)], 1) * count / few
    except ImportError:
        pass
    try:
        from geomstats.geometry.invariant_metric import InvariantMetric
        from geomstats.geometry.special_orthogonal import SpecialOrthogonal

        def by_geomstats(last: int) -> Any:
            """The same with numbers: geomstats has no symbols."""
            group = SpecialOrthogonal(3, equip=False)
            group.equip_with_metric(InvariantMetric, metric_mat_at_identity=np.diag([2.0, 3.0, float(last)]))
            basis = group.metric.normal_basis(group.lie_algebra.basis)
            span = range(3)
            return [
                [
                    sum(
                        group.metric.inner_product(
                            group.metric.curvature(basis[i], basis[j], basis[k], base_point=None), basis[i]
                        )
                        for i in span
                    )
                    for k in span
                ]
                for j in span
            ]

        times["geomstats (numbers)"] = best(lambda: by_geomstats(1), 2) * count
    except ImportError:
        pass
    show(f"Ricci of {count} metrics diag(a, b, n) on so(3), with two parameters", times)


def large() -> None:
    """E8: the computation in Rust, and its conversion to arrays of coordinates, each time of a new geometry."""
    computed, converted = [], []
    for _ in range(REPEATS + 1):
        geometry = af.Geometry("E8", connection="zero")
        begun = time.perf_counter()
        curvature = geometry.curvature
        computed.append(time.perf_counter() - begun)
        indices, values = curvature.to_coo()
        converted.append(time.perf_counter() - begun)
    assert indices.shape == (4, len(values))
    print(f"\ncurvature of E8, {curvature.nnz} nonzero components")
    print(f"  computed in Rust            {1e3 * min(computed):12.3f} ms")
    print(f"  with arrays of coordinates  {1e3 * min(converted):12.3f} ms   {min(converted) / min(computed):8.2f} x of Rust")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1_000_000)
    count = parser.parse_args().count
    print(f"Python {sys.version.split()[0]}, {platform.machine()}, {af.threads()} threads")
    for name in ("affinor", "numpy", "scipy", "jaxlie", "jax", "geomstats", "sympy"):
        try:
            print(f"  {name} {version(name)}")
        except PackageNotFoundError:
            print(f"  {name} is not installed")
    rotations(count)
    one_vector()
    small_geometries()
    large()


if __name__ == "__main__":
    main()
