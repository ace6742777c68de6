"""Plots of trajectories with matplotlib."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from affinor._columns import components
from affinor._optional import optional


class Columns(Protocol):
    """The parts of a trajectory that a plot needs."""

    @property
    def name(self) -> str: ...
    @property
    def t(self) -> NDArray[np.float64]: ...
    @property
    def parameter(self) -> str: ...
    @property
    def columns(self) -> list[str]: ...
    @property
    def conserved(self) -> list[str]: ...
    def curve(self) -> tuple[list[str], NDArray[np.float64]]: ...
    def __contains__(self, name: object) -> bool: ...
    def __getitem__(self, name: str) -> NDArray[np.float64]: ...


class _Curve:
    """Columns of a curve, found by name or stem."""

    def __init__(self, columns: Sequence[str], rows: NDArray[np.float64]) -> None:
        self.columns, self.rows = list(columns), rows

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        found = [self.columns.index(column) for column in components(self.columns, name)]
        return self.rows[:, found[0]] if name in self.columns else self.rows[:, found]


def _smooth(trajectory: Columns) -> _Curve:
    """Dense rows of a trajectory, which do not depend on its output times."""
    return _Curve(*trajectory.curve())


KINDS = ("conserved", "series", "attitude", "momentum")


def plot(trajectory: Columns, kind: str, columns: Sequence[str] | None, ax: Any) -> Any:
    """Draws the plot of this kind and returns its axes."""
    if kind not in KINDS:
        raise ValueError(f"the plots are {', '.join(KINDS)}, not {kind!r}")
    plt = optional("matplotlib.pyplot", "plot")

    _check_axes(ax)
    space = kind in ("attitude", "momentum")
    if space and ax is not None and not hasattr(ax, "set_zlabel"):
        raise ValueError(f"{kind} is drawn in space: give axes of the projection '3d', or none")
    if ax is None:
        ax = plt.figure().add_subplot(projection="3d" if space else None)
    if kind == "series":
        shown = list(columns) if columns is not None else [name for name in trajectory.columns if name != trajectory.parameter][:6]
        smooth = _smooth(trajectory)
        for name in shown:
            trajectory[name]  # raises the error for an unknown column
            ax.plot(smooth[trajectory.parameter], smooth[name], label=name)
        ax.set_ylabel("value")
    elif kind == "conserved":
        shown = list(columns) if columns is not None else trajectory.conserved
        if not shown:
            raise ValueError("the equations conserve no column of this motion: choose columns with columns=")
        for name in shown:
            change = np.abs(trajectory[name] - trajectory[name][0])
            ax.semilogy(trajectory.t, np.maximum(change, 1e-18), label=name)
        ax.set_ylabel("change of conserved quantities")
    elif kind == "attitude":
        axes = _axes(_smooth(trajectory))
        for axis in range(3):
            path = axes[:, :, axis].T
            ax.plot(*path, label=f"body axis {axis + 1}")
            ax.scatter(*path[:, -1:])
        _sphere(ax, 1.0)
    else:
        path = _smooth(trajectory)["H"].T
        if len(path) != 3:
            raise ValueError(f"the plot needs a momentum of 3 components, not {len(path)}")
        ax.plot(*path, label="H")
        _sphere(ax, float(np.linalg.norm(path[:, 0])))
        for name, letter in zip(("set_xlabel", "set_ylabel", "set_zlabel"), "123", strict=True):
            getattr(ax, name)(f"H{letter}")
    if not space:
        ax.set_xlabel("time" if trajectory.parameter == "t" else trajectory.parameter)
    ax.set_title(trajectory.name)
    if ax.get_legend_handles_labels()[0]:
        ax.legend()
    return ax


def plot_convergence(errors: Mapping[str, Any], steps: Sequence[float], ax: Any = None) -> Any:
    """Plots the errors of methods against the step size, on logarithmic axes."""
    plt = optional("matplotlib.pyplot", "plot")

    _check_axes(ax)
    ax = plt.figure().add_subplot() if ax is None else ax
    for method, error in errors.items():
        ax.loglog(steps, error, "o-", label=method)
    ax.set_xlabel("step size")
    ax.set_ylabel("error at the end")
    ax.legend()
    return ax


def _check_axes(ax: Any) -> None:
    """Raises an error for an object that is not axes of matplotlib."""
    if ax is not None and not hasattr(ax, "get_legend_handles_labels"):
        raise TypeError(f"ax should be axes of matplotlib, not {type(ax).__name__}")


def _axes(trajectory: _Curve) -> Any:
    """Rotation matrices, from the columns of the quaternion or of the entries of the element."""
    from affinor.group import SO3

    if "qw" in trajectory:
        return SO3.matrix(np.stack([trajectory[name] for name in ("qw", "qx", "qy", "qz")], axis=-1))
    entries = [trajectory[f"g{row}{column}"] for row in range(1, 4) for column in range(1, 4)]
    return np.stack(entries, axis=-1).reshape(-1, 3, 3)


def _sphere(ax: Any, radius: float) -> None:
    """Draws a wireframe sphere around the origin."""
    u, v = np.mgrid[0 : 2 * np.pi : 25j, 0 : np.pi : 13j]
    ax.plot_wireframe(
        radius * np.cos(u) * np.sin(v),
        radius * np.sin(u) * np.sin(v),
        radius * np.cos(v),
        linewidth=0.3,
        color="grey",
    )
    ax.set_box_aspect((1, 1, 1))
