"""Motion: problems of mechanics on Lie groups, and their trajectories."""

from __future__ import annotations

import contextlib
import csv
import difflib
import inspect
import json
import os
import tempfile
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from pathlib import Path
from typing import Any, ClassVar, Self, TypedDict, TypeVar, Unpack

import numpy as np
from numpy.typing import NDArray

from affinor import _engine
from affinor._columns import components
from affinor._engine import methods
from affinor._optional import optional
from affinor._scalars import Symbols, document, floats, index, is_matrix, text_of
from affinor.geometry import metric_text

__all__ = ["Problem", "Trajectory", "convergence", "methods", "simulate"]

Floats = NDArray[np.float64]

interrupts: ContextVar[str] = ContextVar("interrupts", default="return")
"""The default of ``on_interrupt``, which is ``raise`` in tasks of sweeps."""


class ProblemKeys(TypedDict, total=False):
    """The keyword arguments of a problem: options that override keys of a file, and the keys themselves."""

    set: Mapping[str, Any] | str | None
    method: str | None
    step: Any
    tolerance: Any
    end: Any
    every: Any
    name: str | None
    space: Any
    definition: Mapping[str, Any] | None
    metric: Any
    inertia: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None
    connection: Any
    invariance: str | None
    parameters: Mapping[str, Any] | None
    flow: Mapping[str, Any] | None
    initial: Mapping[str, Any] | None
    prescribed: Mapping[str, Any] | None
    hamiltonian: Any
    constraints: Sequence[Any] | None
    forces: Mapping[str, Any] | None
    integrator: Mapping[str, Any] | None
    output: Mapping[str, Any] | None
    quantities: Mapping[str, Any] | None
    events: Mapping[str, Any] | None
    ensemble: Mapping[str, Any] | None
    urdf: str | None
    bodies: Sequence[Mapping[str, Any]] | None
    joints: Sequence[Mapping[str, Any]] | None
    gravity: Sequence[Any] | None
    coordinates: str | None
    springs: Sequence[Mapping[str, Any]] | None
    contacts: Sequence[Mapping[str, Any]] | None


Function = TypeVar("Function", bound=Callable[..., Any])


def spelled_out(function: Function) -> Function:
    """Adds the keys of a problem to the signature of a function or class, for help and completion."""
    signature = inspect.signature(function)
    own = [parameter for parameter in signature.parameters.values() if parameter.kind is not inspect.Parameter.VAR_KEYWORD]
    keys = [inspect.Parameter(key, inspect.Parameter.KEYWORD_ONLY, default=None) for key in ProblemKeys.__annotations__]
    function.__signature__ = signature.replace(parameters=[*own, *keys])  # type: ignore[attr-defined]
    return function


def unknown(keys: Mapping[str, Any]) -> None:
    """Raises an error for keys that problems do not have."""
    for key in keys:
        if key not in ProblemKeys.__annotations__:
            near = difflib.get_close_matches(key, ProblemKeys.__annotations__, 1)
            hint = f"; did you mean {near[0]!r}?" if near else f"; the keys are {', '.join(ProblemKeys.__annotations__)}"
            raise TypeError(f"a problem has no key {key!r}{hint}")


@spelled_out
class Problem(_engine.Problem):
    """Problem of motion: a file, a dict with the keys of a file, or these keys as arguments.

    Formulas are strings or SymPy expressions. Angles are in radians; all other quantities are in any consistent units.
    ``docs/motion.md`` describes all keys.

    Parameters
    ----------
    problem : path or dict, optional
        TOML or JSON file, or a dict with its keys.
    set : dict or str, optional
        New values of parameters, ``{"m": 2}`` or ``"m=2"``.
    method : str, optional
        Integration method, one of :func:`methods`; overrides the method of the file.
    step : number, expression or str, optional
        Time step; overrides the step of the file.
    tolerance : number, expression or str, optional
        Relative tolerance of a step; overrides the tolerance of the file.
    end : number, expression or str, optional
        Final time; overrides the final time of the file.
    every : number, expression or str, optional
        Time between rows; overrides the interval of the file.
    name : str, optional
        Name of the problem.
    space : str, path or LieAlgebra, optional
        Group: a name of the catalogue, a sum of names, a definition file, or an algebra.
    definition : dict, optional
        The keys of a definition file, instead of ``space``.
    metric : str, array or list, optional
        Inertia tensor ``J``: a string such as ``"diag(1,2,3)"``, a matrix, or a list of diagonal entries. The kinetic energy is
        ``J_ij Omega^i Omega^j/2``.
    inertia : dict or list of dict, optional
        Bodies that consist of parts, instead of ``metric``. A list has one dict for each summand of a sum of groups.
    connection : str or number, optional
        Connection; the default ``plus`` gives the Euler-Poincare equations.
    invariance : str, optional
        Whether the metric is left-invariant (``"left"``, the default) or right-invariant (``"right"``).
    parameters : dict, optional
        Numbers or formulas by name. A formula may use the parameters before it.
    flow : dict, optional
        Isospectral flow of matrices, instead of a space.
    initial : dict, optional
        Initial condition. The element is given by ``coordinates``, ``quaternion``, ``position`` or ``element``; the velocity
        by ``velocity``, ``momentum``, ``spatial_velocity`` or ``spatial_momentum``. ``time`` is the initial time.
    prescribed : dict, optional
        Prescribed ``velocity`` as a function of time, instead of equations of motion.
    hamiltonian : str or expression, optional
        Function of the momentum ``H1``, ``H2``, ..., instead of ``metric``.
    constraints : list, optional
        Holonomic constraints: formulas in the entries of the element, each of which must vanish.
    forces : dict, optional
        The covectors ``body`` and ``spatial`` are lists of formulas, and ``potential`` is a formula. ``table`` is a path, an
        array whose first column is the time, or a DataFrame with the columns ``t``, ``M1``, ``M2`` and so on. ``body``
        and ``spatial`` may also be functions ``force(t, g, omega)`` that return the components. Their arguments are the time,
        the matrix of the element and the body velocity. A function is a few hundred times slower than a formula.
    integrator : dict, optional
        Settings ``method``, ``step``, ``tolerance``, ``absolute_tolerance``, ``max_step`` and ``max_steps``.
    output : dict, optional
        Times of the rows, as ``end`` and ``every`` or as ``times``; ``columns``; ``stop``, a terminal event; ``section``, an
        event at which rows are written.
    quantities : dict, optional
        Additional columns: formulas by name.
    events : dict, optional
        Event functions: formulas by name.
    ensemble : dict, optional
        Variations of parameters: ``grid``, ``random``, ``samples`` and ``seed``.
    urdf : str, optional
        Path of a robot, whose links and joints are the first bodies and joints.
    bodies : list of dict, optional
        Bodies with ``name``, ``fixed`` and ``inertia``, instead of ``space``.
    joints : list of dict, optional
        Joints between bodies, and values of joints of the robot.
    gravity : list, optional
        Acceleration of gravity in the ground frame, for bodies.
    coordinates : str, optional
        State of bodies: ``"joints"``, the default, or ``"poses"``.
    springs : list of dict, optional
        Springs and dampers between points of bodies.
    contacts : list of dict, optional
        Bodies that roll or slide on a plane.

    Raises
    ------
    InputError
        A key or a formula is invalid.

    Examples
    --------
    >>> top = Problem(space="so3", metric=[2, 2, 1], initial={"velocity": [0, 0, 5]}, output={"end": 1, "every": 0.5})
    >>> simulate(top)["Omega3"]
    array([5., 5., 5.])
    """

    __signature__: ClassVar[inspect.Signature]

    __slots__ = ("_arguments", "_in_memory")

    _arguments: tuple[str | None, str | None, dict[str, Any]]
    _in_memory: bool

    def __new__(
        cls,
        problem: str | os.PathLike[str] | Mapping[str, Any] | None = None,
        **keys: Unpack[ProblemKeys],
    ) -> Self:
        unknown(keys)
        # a key with the value None counts as absent
        given: dict[str, Any] = {key: value for key, value in keys.items() if value is not None}
        options = {name: given.pop(name, None) for name in ("set", "method", "step", "tolerance", "end", "every")}
        return cls._made(problem, given, **options)

    @classmethod
    def _made(
        cls,
        problem: Any,
        keys: dict[str, Any],
        set: Mapping[str, Any] | str | None,
        method: str | None,
        step: Any,
        tolerance: Any,
        end: Any,
        every: Any,
    ) -> Self:
        """Creates a problem from its keys, and from options that override keys of a file."""
        symbols: Symbols = {}
        texts = {"step": step, "tolerance": tolerance, "end": end, "every": every}
        options: dict[str, Any] = {
            "set": _settings(set, symbols),
            "method": method,
            **{key: None if value is None else text_of(value, symbols, floats=True) for key, value in texts.items()},
        }
        path = text = None
        table = False
        # the engine must read the table of forces within this block, because a temporary file is deleted at its end
        with contextlib.ExitStack() as stack:
            if isinstance(problem, (str, os.PathLike)):
                if keys:
                    raise TypeError(f"a file has its own keys: {', '.join(keys)} cannot be added")
                path = os.fspath(problem)
            elif problem is None or isinstance(problem, Mapping):
                keys, functions = _functions({**(problem or {}), **keys})
                options.update(functions)
                keys, table = _with_table(keys, stack)
                text = json.dumps(_document(keys, symbols))
            else:
                raise TypeError(f"a problem is a path, a dict or keys, not {type(problem).__name__}")
            return cls._of(path, text, options, in_memory=table)

    @classmethod
    def _of(cls, path: str | None, text: str | None, options: dict[str, Any], *, in_memory: bool = False) -> Self:
        """Creates a problem from a file or a text, and stores the arguments for pickling."""
        made = super().__new__(cls, path, None if text is None else ("problem", text), **options)
        made._arguments, made._in_memory = (path, text, options), in_memory
        return made

    def __reduce__(self) -> Any:
        if self._in_memory:
            raise TypeError("a problem with a table in memory cannot be pickled: write the table to a file")
        return type(self)._of, self._arguments


_LISTS = {
    "forces": ("body", "spatial"),
    "initial": ("coordinates", "velocity", "spatial_velocity", "momentum", "spatial_momentum"),
    "prescribed": ("velocity", "spatial_velocity"),
}
"""The keys whose values are lists of components. In SymPy, such a list is a column."""


def _listed(vector: Any) -> Any:
    """Converts a column or a row of SymPy to the list of its components."""
    if 1 not in vector.shape:
        raise ValueError(f"components are a list or a column, not a matrix of the shape {vector.shape}")
    return list(vector)


def _document(keys: Mapping[str, Any], symbols: Symbols) -> Any:
    """Converts the keys of a problem to the form of a file."""
    for table, names in _LISTS.items():
        part = keys.get(table)
        if isinstance(part, Mapping):
            columns = {name: _listed(part[name]) for name in names if is_matrix(part.get(name))}
            keys = {**keys, table: {**part, **columns}}
    metric = keys.get("metric")
    if metric is not None and not isinstance(metric, str):
        keys = {**keys, "metric": metric_text(metric, symbols, floats=True)}
    return document(keys, symbols)


def _with_table(keys: dict[str, Any], stack: contextlib.ExitStack) -> tuple[dict[str, Any], bool]:
    """Replaces a table of forces in memory by the path of a temporary file. Also returns whether there was such a table."""
    forces = keys.get("forces")
    if not isinstance(forces, Mapping) or isinstance(forces.get("table"), (str, type(None))):
        return keys, False
    table = forces["table"]
    if isinstance(table, os.PathLike):
        return {**keys, "forces": {**forces, "table": str(os.fspath(table))}}, False
    columns = [str(name) for name in table.columns] if hasattr(table, "columns") else None
    rows = floats(table)
    if rows.ndim != 2 or rows.shape[1] < 2:
        raise ValueError(f"a table of forces has rows of a time and components, not the shape {rows.shape}")
    path = os.path.join(stack.enter_context(tempfile.TemporaryDirectory(prefix="affinor-")), "forces.csv")
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns or ["t", *(f"M{i}" for i in range(1, rows.shape[1]))])
        writer.writerows(rows.tolist())
    return {**keys, "forces": {**forces, "table": path}}, True


def _functions(keys: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Removes the forces that are Python functions from the keys. Returns the remaining keys and these functions."""
    forces = keys.get("forces")
    if not isinstance(forces, Mapping):
        return keys, {}
    functions = {name: force for name, force in forces.items() if callable(force)}
    if not set(functions) <= {"body", "spatial"}:
        raise TypeError(f"forces.{next(iter(functions))} cannot be a function: only body and spatial can")
    rest = {name: force for name, force in forces.items() if name not in functions}
    return {**keys, "forces": rest}, functions


def _settings(values: Mapping[str, Any] | str | None, symbols: Symbols) -> str | None:
    """Writes new values of parameters as ``name=value,...``."""
    if values is None or isinstance(values, str):
        return values
    if not isinstance(values, Mapping):
        raise TypeError(f"set is a dict of parameters or a text, not {type(values).__name__}")
    return ",".join(f"{name}={text_of(value, symbols, floats=True)}" for name, value in values.items())


class Trajectory:
    """Rows of a motion, with one column per quantity.

    ``trajectory["Omega1"]`` is a view of a column. ``trajectory["Omega"]`` contains all columns ``Omega1``, ``Omega2``, ... in
    order, as an array of the shape (rows, components). Iteration runs over the names of the columns. ``trajectory(t)`` is the
    motion at other times.

    Attributes
    ----------
    name : str
        Name of the problem.
    rows : array of the shape (rows, columns)
        All values. Angles are in radians; other quantities are in the units of the problem.
    columns : list of str
        Names of the columns.
    parameter : str
        Column of the time, ``t``; for a curve on a chart, of its parameter, ``s``.
    watched : list of str
        Columns whose changes :meth:`drift` reports: energy, momentum, Casimir functions and named quantities.
    conserved : list of str
        Columns that the equations and the forces conserve.
    events : list of (str, float)
        Name and time of each event.
    method : str
        Integration method.
    notes : list of str
        Notes on the run, such as a note on the default that was chosen.
    error : Exception or None
        Error that ended the run.
    interrupted : bool
        Whether an interrupt ended the run.

    Examples
    --------
    >>> turn = simulate(space="so3", metric="identity", initial={"velocity": [0, 0, 2]}, output={"end": 1, "every": 0.5})
    >>> turn["h"].shape
    (3, 3)
    >>> turn.conserved
    ['h1', 'h2', 'h3', 'energy', 'casimir1']
    """

    __slots__ = (
        "_motion", "columns", "conserved", "error", "events", "interrupted", "method", "name", "notes", "parameter", "rows", "watched",
    )  # fmt: skip

    def __init__(self, found: Mapping[str, Any], motion: tuple[_engine.Problem, int] | None = None) -> None:
        self._motion = motion
        self.name: str = found["name"]
        self.rows: Floats = found["rows"]
        self.columns: list[str] = list(found["columns"])
        self.parameter: str = found["parameter"]
        self.watched: list[str] = [
            name for name, watched in zip(self.columns, found["watched"], strict=True) if watched
        ]
        self.conserved: list[str] = [
            name for name, conserved in zip(self.columns, found["conserved"], strict=True) if conserved
        ]
        """The columns that the equations and the forces conserve, such as the energy, the spatial momentum and Casimir functions."""
        self.events: list[tuple[str, float]] = list(found["events"])
        self.method: str = found["method"]
        self.notes: list[str] = list(found["notes"])
        self.error: BaseException | None = found["failed"]
        self.interrupted: bool = found["interrupt"] is not None

    def __getitem__(self, name: str) -> Floats:
        if name in self.columns:
            return self.rows[:, self.columns.index(name)]
        stem = [self.columns.index(column) for column in components(self.columns, name)]
        if stem == list(range(stem[0], stem[-1] + 1)):
            return self.rows[:, stem[0] : stem[-1] + 1]
        return self.rows[:, stem]

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.rows)

    @property
    def t(self) -> Floats:
        """Times of the rows; for a curve on a chart, its parameters."""
        return self[self.parameter]

    def __getstate__(self) -> Any:
        # leaves out the motion, because it may contain functions that cannot be pickled
        return None, {name: getattr(self, name) for name in self.__slots__ if name != "_motion"}

    def __setstate__(self, state: Any) -> None:
        self._motion = None
        for name, value in state[1].items():
            setattr(self, name, value)

    def __call__(self, t: Any) -> Trajectory:
        """Motion at other times, integrated again with the same method.

        Parameters
        ----------
        t : float or array
            Finite times in any order: a number, or an array with one axis.

        Returns
        -------
        Trajectory
            One row per time, in the order of the times.

        Raises
        ------
        ValueError
            The trajectory was unpickled, so its problem is unknown. Some times are before and others after the initial time, or
            a time is after the end at ``output.stop``. The rows are those of ``output.section``.

        Examples
        --------
        >>> turn = simulate(space="so3", metric="identity", initial={"velocity": [0, 0, 2]}, output={"end": 1})
        >>> turn([0.25, 0.5])["qz"].round(12).tolist()
        [0.247403959255, 0.479425538604]
        """
        if self._motion is None:
            raise ValueError(
                "an unpickled trajectory does not know its problem: call simulate on the problem again, with these times as output"
            )
        times = np.atleast_1d(floats(t))
        if times.ndim > 1:
            raise ValueError(f"t should be a number or an array with one axis, not of the shape {times.shape}")
        if not np.isfinite(times).all():
            raise ValueError(f"t should have finite times, not {times[~np.isfinite(times)][0]}")
        problem, member = self._motion
        rows, at = _rows_at(problem, member, [])
        start = float(rows["rows"][0, at])
        wanted = np.unique(times)
        if len(wanted) and wanted[0] < start:
            if wanted[-1] > start:
                raise ValueError(f"t has times on both sides of the initial time {start:g}: call the trajectory once for each side")
            wanted = wanted[::-1]
        found, at = _rows_at(problem, member, wanted.tolist())
        place = {time: row for row, time in enumerate(found["rows"][:, at].tolist())}
        if beyond := [time for time in wanted.tolist() if time not in place]:
            raise ValueError(f"the run ends at {self.parameter} = {found['rows'][-1, at]:g}, before the requested time {beyond[0]:g}")
        found["rows"] = found["rows"][[place[time] for time in times.tolist()]]
        return Trajectory(found, self._motion)

    def curve(self) -> tuple[list[str], Floats]:
        """Rows that are dense enough to draw a smooth curve.

        Returns
        -------
        columns : list of str
            Names of the columns.
        rows : array of the shape (rows, columns)
            Dense rows. If the run did not reach its end, or if the trajectory was unpickled, they are the rows of the trajectory.

        Examples
        --------
        >>> turn = simulate(space="so3", metric="identity", initial={"velocity": [0, 0, 2]}, output={"end": 1, "every": 1})
        >>> columns, rows = turn.curve()
        >>> len(rows) > len(turn)
        True
        """
        if self._motion is None or self.interrupted or self.error:
            return self.columns, self.rows
        problem, member = self._motion
        return problem._curve(member)

    def drift(self) -> dict[str, float]:
        """Largest change of each watched quantity from its initial value.

        Returns
        -------
        dict of float
            Changes of the energy, the momentum, Casimir functions and named quantities.

        Examples
        --------
        >>> body = simulate(space="so3", metric=[1, 2, 3], initial={"velocity": [1, 1, 1]}, output={"end": 9}, method="rkmk853")
        >>> body.drift()["energy"] < 1e-8
        True
        """
        if not len(self):
            return {}
        return {name: float(np.abs(self[name] - self[name][0]).max()) for name in self.watched}

    def to_pandas(self) -> Any:
        """DataFrame with the columns of the trajectory.

        Returns
        -------
        pandas.DataFrame

        Examples
        --------
        >>> turn = simulate(space="so3", metric="identity", initial={"velocity": [0, 0, 2]}, output={"end": 1, "every": 0.5})
        >>> turn.to_pandas()["t"].tolist()
        [0.0, 0.5, 1.0]
        """
        pd = optional("pandas", "pandas")

        return pd.DataFrame(self.rows, columns=self.columns)

    def to_arrow(self) -> Any:
        """Arrow table with the columns of the trajectory.

        Returns
        -------
        pyarrow.Table

        Examples
        --------
        >>> turn = simulate(space="so3", metric="identity", initial={"velocity": [0, 0, 2]}, output={"end": 1, "every": 0.5})
        >>> turn.to_arrow()["t"].to_pylist()
        [0.0, 0.5, 1.0]
        """
        pa = optional("pyarrow", "pandas")

        return pa.table({name: np.ascontiguousarray(self[name]) for name in self.columns})

    def plot(self, kind: str = "conserved", *, columns: Sequence[str] | None = None, ax: Any = None) -> Any:
        """Plot of the trajectory with matplotlib.

        Parameters
        ----------
        kind : str
            ``"conserved"`` (changes of conserved quantities), ``"series"`` (columns over time), ``"attitude"`` (paths of the body
            axes) or ``"momentum"`` (path of the body momentum).
        columns : list of str, optional
            Columns to plot, for ``"conserved"`` and ``"series"``. A stem such as ``Omega`` means all its components.
        ax : matplotlib.axes.Axes, optional
            Axes to draw on; by default those of a new figure. ``"attitude"`` and ``"momentum"`` need the projection ``"3d"``.

        Returns
        -------
        matplotlib.axes.Axes

        Examples
        --------
        >>> simulate("satellite.toml").plot("series", columns=["Omega"])  # doctest: +SKIP
        """
        from affinor import _plots

        return _plots.plot(self, kind, columns, ax)

    def __repr__(self) -> str:
        state = ", interrupted" if self.interrupted else ", stopped by an error" if self.error else ""
        return f"<Trajectory {self.name}, {len(self)} rows of {len(self.columns)} columns, {self.method}{state}>"

    def _repr_html_(self) -> str | None:
        """The rows as a table of pandas, which notebooks show."""
        try:
            frame = self.to_pandas()
        except ImportError:
            return None
        return str(frame._repr_html_())


def _rows_at(problem: _engine.Problem, member: int, times: list[float]) -> tuple[dict[str, Any], int]:
    """Integrates with rows at the initial time and at these times. Also returns the index of the column of times."""
    found = problem._at_times(times)._run(member)
    for failed in (found["interrupt"], found["failed"]):
        if failed is not None:
            raise failed
    columns, parameter = list(found["columns"]), found["parameter"]
    if parameter not in columns:
        raise ValueError(f"the columns of the trajectory have no {parameter}: add {parameter} to output.columns")
    return found, columns.index(parameter)


@spelled_out
def simulate(
    problem: Problem | str | os.PathLike[str] | Mapping[str, Any] | None = None,
    *,
    member: int = 0,
    progress: bool | Callable[[float], object] = False,
    on_error: str = "raise",
    on_interrupt: str | None = None,
    **keys: Unpack[ProblemKeys],
) -> Trajectory:
    """Integrates a problem of motion.

    Parameters
    ----------
    problem : Problem, path or dict, optional
        A problem, a TOML or JSON file, or a dict with its keys. Without it, give the keys as keyword arguments.
    member : int
        Number of the member of an ensemble, from 0.
    progress : bool or callable
        ``True`` shows a progress bar of tqdm. A function is called with the fraction of the time that has passed, from 0 to 1.
    on_error : str
        ``"raise"`` (default) raises an error of the integration or of a force; its attribute ``trajectory`` has the rows so far.
        ``"keep"`` returns the trajectory with these rows, and the error in its attribute ``error``.
    on_interrupt : str, optional
        After Ctrl-C, ``"return"`` (default) returns the rows so far and sets ``interrupted``; ``"raise"`` raises
        KeyboardInterrupt. In tasks of sweeps, the default is ``"raise"``.
    **keys
        Keys of a :class:`Problem`.

    Returns
    -------
    Trajectory

    Raises
    ------
    InputError
        A key or a formula is invalid.
    IntegrationError
        The integration stops before the final time.

    Examples
    --------
    >>> weight = {"body": ["-2*9.81"]}
    >>> fall = simulate(space="R^1", metric=[2], forces=weight, initial={"velocity": [0]}, output={"end": 2, "every": 1})
    >>> fall["x1"].round(6)
    array([  0.   ,  -4.905, -19.62 ])
    """
    on_interrupt = on_interrupt or interrupts.get()
    if on_error not in ("raise", "keep") or on_interrupt not in ("return", "raise"):
        raise ValueError("on_error should be 'raise' or 'keep', and on_interrupt 'return' or 'raise'")
    if not isinstance(progress, (bool, np.bool_, type(None))) and not callable(progress):
        raise TypeError(f"progress should be a truth value or a function, not {progress!r}")
    if not isinstance(problem, Problem):
        problem = Problem(problem, **keys)
    elif keys:
        raise TypeError(f"a Problem has its own keys: {', '.join(keys)} cannot be added")
    member = index("the member", member)
    if not 0 <= member < (problem.ensemble_size or 1):
        ensemble = "no ensemble" if problem.ensemble_size is None else f"an ensemble of {problem.ensemble_size} members, from 0"
        raise ValueError(f"the problem has {ensemble}, but no member {member}")
    bar = None
    tell: Callable[[float], object] | None = progress if callable(progress) else None
    if tell is None and progress:
        bar = optional("tqdm.auto", "progress").tqdm(total=1.0, bar_format="{percentage:3.0f}%|{bar}| {elapsed}<{remaining}")

        def tell(share: float) -> None:
            bar.update(share - bar.n)

    try:
        found = problem._run(member, tell)
    finally:
        if bar is not None:
            bar.close()
    trajectory = Trajectory(found, (problem, member))
    interrupt, failed = found["interrupt"], found["failed"]
    if interrupt is not None:
        if on_interrupt == "raise" or not isinstance(interrupt, KeyboardInterrupt):
            interrupt.trajectory = trajectory
            raise interrupt
        last = f" at t = {trajectory.rows[-1, 0]:g}" if len(trajectory) else ""
        warnings.warn(f"interrupted{last}; the rows so far are kept", RuntimeWarning, stacklevel=2)
    if failed is not None and on_error == "raise":
        failed.trajectory = trajectory
        raise failed
    return trajectory


class Convergence(dict[str, Floats]):
    """Errors of integration methods: a dict with the names of methods as keys, and arrays with one error per step size.

    Attributes
    ----------
    steps : list of float
        Step sizes.

    Examples
    --------
    >>> body = {"space": "so3", "metric": [1, 2, 3], "initial": {"velocity": [1, 1, 1]}, "output": {"end": 1}}
    >>> errors = convergence(body, "Omega1", ["rkmk4", "cf4"], [0.1, 0.05])
    >>> list(errors), errors.steps
    (['rkmk4', 'cf4'], [0.1, 0.05])
    """

    def __init__(self, errors: Mapping[str, Floats], steps: Sequence[float]) -> None:
        super().__init__(errors)
        self.steps = list(steps)

    def plot(self, ax: Any = None) -> Any:
        """Plot of the errors against the step size, on logarithmic axes.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw on; by default those of a new figure.

        Returns
        -------
        matplotlib.axes.Axes

        Examples
        --------
        >>> convergence("top.toml", "energy", ["rkmk4"], [0.1, 0.05]).plot()  # doctest: +SKIP
        """
        from affinor._plots import plot_convergence

        return plot_convergence(self, self.steps, ax)


def convergence(
    problem: str | os.PathLike[str] | Mapping[str, Any],
    column: str,
    methods: Sequence[str],
    steps: Sequence[float],
    *,
    reference: float | None = None,
) -> Convergence:
    """Error of a column at the final time, for each method and step size.

    Parameters
    ----------
    problem : path or dict
        Problem file, or a dict with its keys.
    column : str
        Name of the column.
    methods : list of str
        Integration methods, from :func:`methods`.
    steps : list of float
        Step sizes.
    reference : float, optional
        Exact value of the column. By default, the method ``rkmk853`` computes the value with the tolerance 1e-13. For constraints,
        flows of matrices and prescribed velocities, their most accurate method computes it with a quarter of the smallest step.

    Returns
    -------
    Convergence
        Absolute errors.

    Examples
    --------
    >>> body = {"space": "so3", "metric": [1, 2, 3], "initial": {"velocity": [1, 1, 1]}, "output": {"end": 1}}
    >>> large, small = convergence(body, "Omega1", ["rkmk4"], [0.1, 0.05])["rkmk4"]
    >>> bool(8 < large / small < 32)
    True
    """
    if reference is None:
        own = Problem(problem, method=methods[0], step=min(steps))._own_methods() if len(methods) and len(steps) else []
        keys: ProblemKeys = {"method": own[-1], "step": min(steps) / 4} if own else {"method": "rkmk853", "tolerance": 1e-13}
        exact = simulate(problem, on_interrupt="raise", **keys)
        reference = float(exact[column][-1])

    def error(method: str, step: float) -> float:
        found = simulate(problem, method=method, step=step, on_interrupt="raise")
        return abs(float(found[column][-1]) - reference)

    return Convergence({method: np.array([error(method, step) for step in steps]) for method in methods}, steps)
