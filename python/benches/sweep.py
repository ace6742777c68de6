"""Sweeps in this process, on Dask and on Ray: equal rows, and the overhead of the engine.

    python python/benches/sweep.py [--scale 1.0] [--on dask ray]

Three tasks: 10^6 motions of tops, 10^5 left-invariant metrics of so(3) (which are Einstein?), 10^4 algebras through `check`
and the quantities of `table`, each times the scale. The run in this process uses both cores, as do the two workers of one thread each.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import affinor as af

TOP = {
    "space": "so3",
    "metric": "diag(2, 2, 1)",
    "parameters": {"tilt": 0.3, "spin": 5},
    "initial": {"coordinates": ["tilt", 0, 0], "velocity": [0, 0, "spin"]},
    "forces": {"potential": "R33"},
    "output": {"end": 1, "every": 1},
}


def is_einstein(row: dict[str, Any]) -> dict[str, Any]:
    import affinor

    geometry = affinor.Geometry("so3", metric=[row["a"], row["b"], row["c"]])
    found = geometry.check_property("einstein")
    return {"einstein": found.holds, "constant": found.value, "scalar": geometry.scalar_curvature}


def table_of(row: dict[str, Any]) -> dict[str, Any]:
    import affinor

    geometry = affinor.Geometry(row["name"], connection=f"lambda={row['numerator']}/97")
    return {
        "ok": all(geometry.check()),
        **{key: getattr(geometry, key).nnz for key in ("structure", "torsion", "curvature", "ricci", "killing")},
    }


@contextmanager
def engine(name: str) -> Iterator[Any]:
    """Two workers of one thread each."""
    if name == "dask":
        from distributed import Client, LocalCluster

        with (
            LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
            Client(cluster) as client,
        ):
            yield client
    else:
        import ray

        ray.init(num_cpus=2, include_dashboard=False, object_store_memory=100 << 20, log_to_driver=False)
        yield "ray"
        ray.shutdown()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--on", nargs="*", default=["dask", "ray"])
    options = parser.parse_args()

    def size(full: int) -> int:
        return max(int(full * options.scale), 10)

    names = ["so3", "sl2", "heisenberg(3)", "se2", "aff1", "bianchi(IV)", "bianchi(V)", "so(4)", "se3", "gl(2)"]
    tasks = {
        "motions of tops": (
            af.SimulationTask(TOP, columns=["Omega1", "energy"]),
            af.RandomSample(size(1_000_000), seed=3, tilt="uniform(0.1, 1)", spin="normal(5, 1)"),
        ),
        "metrics": (is_einstein, af.RandomSample(size(100_000), seed=1, a=[1, 2, 3, 4], b=[1, 2, 3, 4], c=[1, 2, 3, 4])),
        "algebras": (table_of, {"name": names, "numerator": list(range(size(10_000) // 10))}),
    }
    found = {}
    for title, (task, grid) in tasks.items():
        # one thread computes a chunk in about a second
        af.set_threads(1)
        probe = af.RandomSample(200, **grid.laws) if isinstance(grid, af.RandomSample) else {**grid, "numerator": grid["numerator"][:20]}
        af.sweep(task, probe, chunk=10_000)
        begun = time.perf_counter()
        af.sweep(task, probe, chunk=10_000)
        chunk = max(int(200 / (time.perf_counter() - begun)), 1)
        af.set_threads(2)
        begun = time.perf_counter()
        here = af.sweep(task, grid, chunk=chunk)
        seconds = time.perf_counter() - begun
        failed = int(here.to_pandas()["error"].notna().sum())
        found[title] = (chunk, seconds, here)
        print(f"{title}: {len(here)} rows, {failed} failed, chunks of {chunk}, in this process {seconds:.1f} s", flush=True)
    for name in options.on:
        with engine(name) as on:
            for title, (task, grid) in tasks.items():
                chunk, seconds, here = found[title]
                begun = time.perf_counter()
                there = af.sweep(task, grid, chunk=chunk, on=on)
                elapsed = time.perf_counter() - begun
                same = there.manifest["partitions"] == here.manifest["partitions"]
                print(
                    f"{title} on {name}: {elapsed:.1f} s on two workers, {elapsed / seconds:.2f} of the time in this process; "
                    f"{'equal rows' if same else 'THE ROWS DIFFER'}",
                    flush=True,
                )


if __name__ == "__main__":
    main()
