"""Arrays in bulk beside SciPy, jaxlie, Pinocchio and NumPy, in one run: a table in Markdown.

    python python/benches/bulk.py [--only groups|geometries|frameworks] [--counts 1,100,10000,1000000]

Needs an installed release of affinor; peers that are not installed are left out. The calls of a row take turns, so that a busy
machine is equally busy for all; a number is the shortest wall time of a call. A ratio above 1 means that affinor is faster.
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
from affinor import SE3, SO3

Calls = dict[str, Callable[[], Any]]

SHORTEST = 2e-4
"""Seconds that the calls of one measurement take at least."""


def paired(calls: Calls, repeats: int = 9) -> dict[str, float]:
    """The shortest time of one call, in seconds."""
    loops = {}
    for name, call in calls.items():
        call()
        begun = time.perf_counter()
        call()
        loops[name] = max(1, int(SHORTEST / max(time.perf_counter() - begun, 1e-9)))
    times: dict[str, float] = dict.fromkeys(calls, np.inf)
    for _ in range(repeats):
        for name, call in calls.items():
            count = loops[name]
            begun = time.perf_counter()
            for _ in range(count):
                call()
            times[name] = min(times[name], (time.perf_counter() - begun) / count)
    return times


def written(seconds: float) -> str:
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


PEERS = ("SciPy", "jaxlie", "Pinocchio", "NumPy", "loop")


def row(title: str, calls: Calls) -> None:
    times = paired(calls)
    ratios = [f"{times[peer] / times['affinor']:.2f}" if peer in times else "" for peer in PEERS]
    print(f"| {title} | {written(times['affinor'])} | " + " | ".join(ratios) + " |", flush=True)


def head() -> None:
    print("| work | affinor | " + " | ".join(PEERS) + " |")
    print("|" + "---|" * (2 + len(PEERS)), flush=True)


def jitted(function: Any, *arguments: Any) -> Callable[[], Any]:
    """A compiled function of JAX on its own arrays."""
    import jax

    compiled, given = jax.jit(function), [jax.numpy.asarray(array) for array in arguments]
    return lambda: compiled(*given).block_until_ready()


def peers() -> tuple[Any, Any, Any]:
    found: list[Any] = []
    for name in ("scipy.spatial.transform", "jaxlie", "pinocchio"):
        try:
            found.append(__import__(name, fromlist=["_"]))
        except ImportError:
            found.append(None)
    if found[1] is not None:
        import jax

        jax.config.update("jax_enable_x64", True)
    return found[0], found[1], found[2]


def groups(counts: list[int]) -> None:
    scipy, jaxlie, pin = peers()
    rng = np.random.default_rng(0)
    for count in counts:
        shape = (count,) if count > 1 else ()
        x, p = rng.normal(size=(*shape, 3)), rng.normal(size=(*shape, 3))
        g, h = SO3.exp(x), SO3.exp(p)
        m, twists = SO3.matrix(g), rng.normal(size=(*shape, 6))
        f = SE3.exp(twists)
        f2, big = SE3.compose(f, f), SE3.matrix(f)
        rows: dict[str, Calls] = {
            "SO3.exp": {"affinor": lambda: SO3.exp(x)},
            "SO3.log": {"affinor": lambda: SO3.log(g)},
            "SO3.compose": {"affinor": lambda: SO3.compose(g, h)},
            "SO3.inverse": {"affinor": lambda: SO3.inverse(g)},
            "SO3.matrix": {"affinor": lambda: SO3.matrix(g)},
            "SO3.act": {"affinor": lambda: SO3.act(g, p)},
            "SO3.from_matrix": {"affinor": lambda: SO3.from_matrix(m)},
            "SO3.from_matrix, check=False": {"affinor": lambda: SO3.from_matrix(m, check=False)},
            "SO3.adjoint_matrix": {"affinor": lambda: SO3.adjoint_matrix(g)},
            "SO3.left_jacobian": {"affinor": lambda: SO3.left_jacobian(x)},
            "SO3.right_jacobian_inverse": {"affinor": lambda: SO3.right_jacobian_inverse(x)},
            "SE3.exp": {"affinor": lambda: SE3.exp(twists)},
            "SE3.log": {"affinor": lambda: SE3.log(f)},
            "SE3.compose": {"affinor": lambda: SE3.compose(f, f2)},
            "SE3.inverse": {"affinor": lambda: SE3.inverse(f)},
            "SE3.matrix": {"affinor": lambda: SE3.matrix(f)},
            "SE3.act": {"affinor": lambda: SE3.act(f, p)},
            "SE3.from_matrix": {"affinor": lambda: SE3.from_matrix(big)},
            "SE3.from_matrix, check=False": {"affinor": lambda: SE3.from_matrix(big, check=False)},
            "SE3.adjoint_matrix": {"affinor": lambda: SE3.adjoint_matrix(f)},
            "SE3.left_jacobian": {"affinor": lambda: SE3.left_jacobian(twists)},
            "SE3.right_jacobian_inverse": {"affinor": lambda: SE3.right_jacobian_inverse(twists)},
        }
        if scipy is not None:
            R = scipy.Rotation
            a, b = R.from_quat(g, scalar_first=True), R.from_quat(h, scalar_first=True)
            rows["SO3.exp"]["SciPy"] = lambda: R.from_rotvec(x)
            rows["SO3.log"]["SciPy"] = lambda: a.as_rotvec()
            rows["SO3.compose"]["SciPy"] = lambda: a * b
            rows["SO3.inverse"]["SciPy"] = lambda: a.inv()
            rows["SO3.matrix"]["SciPy"] = lambda: a.as_matrix()
            rows["SO3.act"]["SciPy"] = lambda: a.apply(p)
            rows["SO3.from_matrix"]["SciPy"] = lambda: R.from_matrix(m)
            rows["SO3.from_matrix, check=False"]["SciPy"] = lambda: R.from_matrix(m, assume_valid=True)
            if hasattr(scipy, "RigidTransform"):
                T = scipy.RigidTransform
                s, s2 = T.from_matrix(big), T.from_matrix(SE3.matrix(f2))
                rows["SE3.exp"]["SciPy"] = lambda: T.from_exp_coords(twists)
                rows["SE3.log"]["SciPy"] = lambda: s.as_exp_coords()
                rows["SE3.compose"]["SciPy"] = lambda: s * s2
                rows["SE3.inverse"]["SciPy"] = lambda: s.inv()
                rows["SE3.matrix"]["SciPy"] = lambda: s.as_matrix()
                rows["SE3.act"]["SciPy"] = lambda: s.apply(p)
                rows["SE3.from_matrix"]["SciPy"] = lambda: T.from_matrix(big)
        if jaxlie is not None:
            import jax

            def batched(function: Any) -> Any:
                return jax.vmap(function) if shape else function

            S, E = jaxlie.SO3, jaxlie.SE3
            t = np.roll(twists, 3, axis=-1)
            rows["SO3.exp"]["jaxlie"] = jitted(lambda v: S.exp(v).wxyz, x)
            rows["SO3.log"]["jaxlie"] = jitted(lambda q: S(q).log(), g)
            rows["SO3.compose"]["jaxlie"] = jitted(lambda q, r: (S(q) @ S(r)).wxyz, g, h)
            rows["SO3.inverse"]["jaxlie"] = jitted(lambda q: S(q).inverse().wxyz, g)
            rows["SO3.matrix"]["jaxlie"] = jitted(lambda q: S(q).as_matrix(), g)
            rows["SO3.act"]["jaxlie"] = jitted(batched(lambda q, v: S(q) @ v), g, p)
            rows["SO3.from_matrix, check=False"]["jaxlie"] = jitted(batched(lambda r: S.from_matrix(r).wxyz), m)
            rows["SO3.adjoint_matrix"]["jaxlie"] = jitted(lambda q: S(q).adjoint(), g)
            rows["SO3.right_jacobian_inverse"]["jaxlie"] = jitted(batched(lambda q: S(q).jlog()), g)
            rows["SE3.exp"]["jaxlie"] = jitted(lambda v: E.exp(v).wxyz_xyz, t)
            rows["SE3.log"]["jaxlie"] = jitted(lambda q: E(q).log(), f)
            rows["SE3.compose"]["jaxlie"] = jitted(lambda q, r: (E(q) @ E(r)).wxyz_xyz, f, f2)
            rows["SE3.inverse"]["jaxlie"] = jitted(lambda q: E(q).inverse().wxyz_xyz, f)
            rows["SE3.matrix"]["jaxlie"] = jitted(lambda q: E(q).as_matrix(), f)
            rows["SE3.act"]["jaxlie"] = jitted(batched(lambda q, v: E(q) @ v), f, p)
            rows["SE3.from_matrix, check=False"]["jaxlie"] = jitted(batched(lambda r: E.from_matrix(r).wxyz_xyz), big)
            rows["SE3.adjoint_matrix"]["jaxlie"] = jitted(lambda q: E(q).adjoint(), f)
            rows["SE3.right_jacobian_inverse"]["jaxlie"] = jitted(batched(lambda q: E(q).jlog()), f)
        if pin is not None and not shape:
            M, N = pin.exp6(np.roll(twists, 3)), pin.exp6(np.roll(SE3.log(f2), 3))
            q, r, t = pin.Quaternion(m), pin.Quaternion(SO3.matrix(h)), np.roll(twists, 3)
            rows["SO3.exp"]["Pinocchio"] = lambda: pin.exp3(x)
            rows["SO3.log"]["Pinocchio"] = lambda: pin.log3(m)
            rows["SO3.compose"]["Pinocchio"] = lambda: q * r
            rows["SO3.inverse"]["Pinocchio"] = lambda: q.inverse()
            rows["SO3.matrix"]["Pinocchio"] = lambda: q.matrix()
            rows["SO3.act"]["Pinocchio"] = lambda: q * p
            rows["SO3.from_matrix, check=False"]["Pinocchio"] = lambda: pin.Quaternion(m)
            rows["SO3.left_jacobian"]["Pinocchio"] = lambda: pin.Jexp3(x)
            rows["SO3.right_jacobian_inverse"]["Pinocchio"] = lambda: pin.Jlog3(m)
            rows["SE3.exp"]["Pinocchio"] = lambda: pin.exp6(t)
            rows["SE3.log"]["Pinocchio"] = lambda: pin.log6(M)
            rows["SE3.compose"]["Pinocchio"] = lambda: M * N
            rows["SE3.inverse"]["Pinocchio"] = lambda: M.inverse()
            rows["SE3.matrix"]["Pinocchio"] = lambda: M.homogeneous
            rows["SE3.act"]["Pinocchio"] = lambda: M.act(p)
            rows["SE3.from_matrix, check=False"]["Pinocchio"] = lambda: pin.SE3(big)
            rows["SE3.adjoint_matrix"]["Pinocchio"] = lambda: M.action
            rows["SE3.left_jacobian"]["Pinocchio"] = lambda: pin.Jexp6(t)
            rows["SE3.right_jacobian_inverse"]["Pinocchio"] = lambda: pin.Jlog6(M)
        for title, calls in rows.items():
            row(f"`{title}`, {count:,}", calls)


def affinities(c: Any, g: Any) -> Any:
    """Affinities of metrics (count, n, n) by contractions of NumPy over the batch."""
    low = np.einsum("nmi,mjk->nijk", g, c)
    koszul = (low - np.transpose(low, (0, 3, 1, 2)) + np.transpose(low, (0, 2, 3, 1))) / 2
    return np.einsum("nim,nmjk->nijk", np.linalg.inv(g), koszul)


def curvature(c: Any, lam: Any) -> Any:
    product = np.einsum("nikm,nmlj->nijkl", lam, lam)
    return product - np.swapaxes(product, -1, -2) - np.einsum("mkl,nimj->nijkl", c, lam)


def ricci(c: Any, lam: Any) -> Any:
    first = np.einsum("niim,nmlj->njl", lam, lam)
    return first - np.einsum("nilm,nmij->njl", lam, lam) - np.einsum("mil,nimj->njl", c, lam)


def sectional(c: Any, g: Any, x: Any, y: Any) -> Any:
    r = curvature(c, affinities(c, g))
    r = np.einsum("nijkl,nj,nk->nil", r, y, x)
    above = np.einsum("nil,nl,nim,nm->n", r, y, g, x, optimize=True)
    xx, yy, xy = (np.einsum("nij,ni,nj->n", g, a, b) for a, b in ((x, x), (y, y), (x, y)))
    return above / (xx * yy - xy**2)


def of_rows(function: Callable[..., Any], *arrays: Any) -> Callable[[], Any]:
    """The function in a loop over metrics."""
    parts = [[array[at : at + 1] for array in arrays] for at in range(len(arrays[0]))]
    return lambda: [function(*part) for part in parts]


def geometries(count: int = 1000) -> None:
    rng = np.random.default_rng(0)
    for name in ("so(3)", "se(3)", "so(5)"):
        n = af.LieAlgebra(name).dimension
        a = np.eye(n) + rng.uniform(-0.4, 0.4, size=(count, n, n)) / np.sqrt(n)
        g, x, y = np.swapaxes(a, -1, -2) @ a, rng.normal(size=(count, n)), rng.normal(size=(count, n))
        h = np.einsum("nij->nji", a) + a
        c = af.LieAlgebra(name).structure.to_numpy(float)
        family = af.Geometries(name, g)
        step = 1e-6

        def by_ricci(g: Any, c: Any = c) -> Any:
            return ricci(c, affinities(c, g))

        def by_scalar(g: Any, c: Any = c) -> Any:
            return np.einsum("njl,njl->n", np.linalg.inv(g), ricci(c, affinities(c, g)))

        np.testing.assert_allclose(family.ricci, by_ricci(g), atol=1e-8 * np.abs(family.ricci).max())
        np.testing.assert_allclose(family.curvature, curvature(c, affinities(c, g)), atol=1e-8 * np.abs(family.curvature).max())
        rows: dict[str, Calls] = {
            "affinities": {"affinor": lambda: family.affinities, "NumPy": lambda: affinities(c, g)},
            "curvature": {"affinor": lambda: family.curvature, "NumPy": lambda: curvature(c, affinities(c, g))},
            "Ricci": {"affinor": lambda: family.ricci, "NumPy": lambda: by_ricci(g), "loop": of_rows(by_ricci, g)},
            "Ricci, with its metrics checked": {
                "affinor": lambda: af.Geometries(name, g).ricci,
                "NumPy": lambda: by_ricci(g),
                "loop": of_rows(by_ricci, g),
            },
            "scalar curvature": {"affinor": lambda: family.scalar_curvature, "NumPy": lambda: by_scalar(g)},
            "sectional curvature": {
                "affinor": lambda: family.sectional_curvature(x, y),
                "NumPy": lambda: sectional(c, g, x, y),
            },
            "eigenvalues of Ricci": {
                "affinor": lambda: family.ricci_eigenvalues,
                "NumPy": lambda: np.linalg.eigvals(np.linalg.solve(g, by_ricci(g))),
            },
            "derivative of Ricci": {
                "affinor": lambda: family.derivative("ricci", h),
                "NumPy": lambda: (by_ricci(g + step * h) - by_ricci(g - step * h)) / (2 * step),
            },
        }
        for title, calls in rows.items():
            row(f"{title}, {count:,} metrics on {name}", calls)


def frameworks(counts: list[int]) -> None:
    """Operations in compiled functions of JAX; in PyTorch, where there is no peer, the time alone."""
    _, jaxlie, _ = peers()
    if jaxlie is None:
        return
    import jax

    import affinor.jax as aj

    for count in counts:
        x = np.random.default_rng(0).normal(size=(count, 3))
        q, t = SO3.exp(x), np.random.default_rng(1).normal(size=(count, 6))
        S, E = jaxlie.SO3, jaxlie.SE3
        rows: dict[str, Calls] = {
            "SO3.exp": {
                "affinor": jitted(aj.SO3.exp, x),
                "jaxlie": jitted(lambda v: S.exp(v).wxyz, x),
            },
            "SO3.log": {"affinor": jitted(aj.SO3.log, q), "jaxlie": jitted(lambda g: S(g).log(), q)},
            "gradient of SO3.exp": {
                "affinor": jitted(jax.grad(lambda v: aj.SO3.exp(v).sum()), x),
                "jaxlie": jitted(jax.grad(lambda v: S.exp(v).wxyz.sum()), x),
            },
            "gradient of SE3.exp": {
                "affinor": jitted(jax.grad(lambda v: aj.SE3.exp(v).sum()), t),
                "jaxlie": jitted(jax.grad(lambda v: E.exp(v).wxyz_xyz.sum()), t),
            },
        }
        for title, calls in rows.items():
            row(f"JAX, jit: {title}, {count:,}", calls)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=("groups", "geometries", "frameworks"))
    parser.add_argument("--counts", default="1,100,10000,1000000")
    given = parser.parse_args()
    counts = [int(count) for count in given.counts.split(",")]
    print(f"Python {sys.version.split()[0]}, {platform.machine()}, {af.threads()} threads")
    for name in ("affinor", "numpy", "scipy", "jaxlie", "jax", "pin"):
        try:
            print(f"  {name} {version(name)}")
        except PackageNotFoundError:
            print(f"  {name} is not installed")
    print()
    head()
    if given.only in (None, "groups"):
        groups(counts)
    if given.only in (None, "geometries"):
        geometries()
    if given.only in (None, "frameworks"):
        frameworks(counts)


if __name__ == "__main__":
    main()
