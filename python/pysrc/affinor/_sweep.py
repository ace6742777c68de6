"""Sweeps: run one task for many parameters, in this process, on Dask or on Ray, and store the rows in a Parquet data set."""

from __future__ import annotations

import contextlib
import hashlib
import itertools
import json
import math
import numbers
import os
import re
import tempfile
import time
import weakref
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from affinor import _engine
from affinor._columns import components
from affinor._optional import optional
from affinor._scalars import index, is_matrix, is_sympy
from affinor.motion import Problem, interrupts

__all__ = ["RandomSample", "SimulationTask", "Sweep", "sweep"]

Columns = dict[str, list[Any]]
Kind = Any
"""The kind of the values of a column: a name, ``["list", kind]``, or None if the column has no values."""
_BLOCK = 4096
"""The number of rows for which one random stream is used."""
_MOST_ROWS = 2**40
_LONG = 2**20
"""The length above which a range in a grid is not converted to a list."""
_MANIFEST = "_affinor.json"
"""The name of the file that describes the sweep. Readers of data sets skip the file, because its name begins with ``_``."""


class RandomSample:
    """Grid of a sweep with random parameters and a seed.

    The values of row ``i`` depend only on the seed, on ``i``, and on the laws and their order.

    Parameters
    ----------
    samples : int
        Number of rows.
    seed : int
        Seed from 0 to 2^64 - 1.
    **laws : str or list
        Distribution of each parameter: ``"uniform(a, b)"``, ``"normal(mean, deviation)"``, or a list of equally likely values.

    Examples
    --------
    >>> grid = RandomSample(1000, seed=7, a="uniform(-1, 1)", b="normal(0, 0.1)", c=[1, 2, 3])
    >>> len(grid), list(grid.rows(0, 2))
    (1000, ['a', 'b', 'c'])
    """

    def __init__(self, samples: int, *, seed: int = 0, **laws: str | Sequence[Any]) -> None:
        samples, seed = index("the number of samples", samples), index("the seed", seed)
        if not 0 <= seed < 2**64:
            raise ValueError(f"the seed should be from 0 to 2^64 - 1, not {seed}")
        if samples < 0 or not laws:
            raise ValueError("a draw needs a number of samples and a law for each parameter")
        self.samples, self.seed, self.laws = samples, seed, laws
        for name, law in laws.items():
            if isinstance(law, str):
                _law(name, law)
            elif not isinstance(law, Sequence) or not len(law):
                raise TypeError(f"the law of {name} is a text or a list of values, not {law!r}")

    def __len__(self) -> int:
        return self.samples

    def rows(self, start: int, stop: int) -> Columns:
        """Values of the rows from ``start`` to ``stop``.

        Parameters
        ----------
        start, stop : int
            Index of the first row, and index after the last row.

        Returns
        -------
        dict of list
            For each parameter, the list of its values.

        Examples
        --------
        >>> grid = RandomSample(10, a="uniform(0, 1)")
        >>> grid.rows(2, 4)["a"] == grid.rows(0, 4)["a"][2:]
        True
        """
        parts = [self._block(block) for block in range(start // _BLOCK, (max(stop, 1) - 1) // _BLOCK + 1)]
        offset = start // _BLOCK * _BLOCK
        joined = {name: list(itertools.chain(*(part[name] for part in parts))) for name in self.laws}
        return {name: values[start - offset : stop - offset] for name, values in joined.items()}

    def _block(self, block: int) -> Columns:
        """The values of one block. Each block has its own random stream."""
        generator = np.random.Generator(np.random.Philox(key=np.array([self.seed, block], dtype=np.uint64)))
        found: Columns = {}
        for name, law in self.laws.items():
            if isinstance(law, str):
                kind, a, b = _law(name, law)
                values = generator.uniform(a, b, _BLOCK) if kind == "uniform" else generator.normal(a, b, _BLOCK)
                found[name] = values.tolist()
            else:
                found[name] = [law[at] for at in generator.integers(0, len(law), _BLOCK)]
        return found


def _law(name: str, law: str) -> tuple[str, float, float]:
    """Parses a law. Returns its kind and its two numbers."""
    match = re.fullmatch(r"\s*(uniform|normal)\s*\(([^,()]+),([^,()]+)\)\s*", law)
    if match is None:
        raise ValueError(f"the law of {name} is uniform(a, b) or normal(mean, deviation), not {law!r}")
    return match.group(1), float(match.group(2)), float(match.group(3))


class SimulationTask:
    """Task of a sweep: integrates a problem with the parameters of a row and stores the last row of the trajectory.

    The runs of a partition use all cores together.

    Parameters
    ----------
    problem : Problem, path or dict, optional
        Problem of motion. Without it, give the keys as keyword arguments.
    columns : list of str, optional
        Columns to store, as names or stems; by default all columns.
    **keys
        Keys of a :class:`Problem`.

    Examples
    --------
    >>> spin = {"velocity": [0, 0, 1]}
    >>> body = Problem(space="so3", metric="diag(1,1,J)", parameters={"J": 1}, initial=spin, output={"end": 1})
    >>> sweep(SimulationTask(body, columns=["H3"]), {"J": [1, 2]}).to_pandas()["H3"].round(9).tolist()
    [1.0, 2.0]
    """

    def __init__(self, problem: Any = None, *, columns: Sequence[str] | None = None, **keys: Any) -> None:
        self.problem = problem if isinstance(problem, Problem) else Problem(problem, **keys)
        self.columns = None if columns is None else list(columns)

    def run_rows(self, rows: Columns) -> tuple[Columns, list[str | None]]:
        """Integrates the problem once for each row of parameters.

        Parameters
        ----------
        rows : dict of list
            For each parameter, the list of its values, one per row.

        Returns
        -------
        results : dict of list
            For each column, the list of its values in the last row of each run.
        errors : list of str or None
            For each run, the reason of its failure, or None.

        Examples
        --------
        >>> spin = {"velocity": [0, 0, 1]}
        >>> body = Problem(space="so3", metric="diag(1,1,J)", parameters={"J": 1}, initial=spin, output={"end": 1})
        >>> results, errors = SimulationTask(body, columns=["H3"]).run_rows({"J": [1, 2]})
        >>> [round(value, 9) for value in results["H3"]], errors
        ([1.0, 2.0], [None, None])
        """
        names = list(rows)
        values = np.array([rows[name] for name in names], dtype=np.float64).T.reshape(-1, len(names))
        columns, last, failed = self.problem._run_many(names, values)
        chosen = [name for name in columns if name not in rows]
        if self.columns is not None and columns:
            chosen = [column for name in self.columns for column in components(columns, name)]
        results = {name: last[:, columns.index(name)].tolist() for name in chosen}
        return results, [_reason(error) if isinstance(error, Exception) else error for error in failed]


class Sweep:
    """Rows of a sweep: a Parquet data set with one file per partition.

    Attributes
    ----------
    folder : pathlib.Path
        Folder of the data set. A temporary folder is removed with this object.
    computed : int
        Number of partitions that this call computed. The other partitions already existed.

    Examples
    --------
    >>> squares = sweep(lambda row: {"square": row["x"] ** 2}, {"x": [1, 2, 3]})
    >>> len(squares), squares.computed
    (3, 1)
    """

    def __init__(self, folder: Path, computed: int) -> None:
        self.folder = folder
        self.computed = computed
        """The number of partitions that this call computed."""

    @property
    def manifest(self) -> dict[str, Any]:
        """Description of the sweep: its grid, chunk and version, and the number of rows of each partition."""
        return _manifest(self.folder / _MANIFEST)

    def to_arrow(self) -> Any:
        """All rows as an Arrow table, in the order of the grid.

        Returns
        -------
        pyarrow.Table

        Examples
        --------
        >>> sweep(lambda row: {"square": row["x"] ** 2}, {"x": [1, 2]}).to_arrow().column_names
        ['row', 'x', 'square', 'error']
        """
        pa, pq = optional("pyarrow", "sweep"), optional("pyarrow.parquet", "sweep")

        names = sorted(self.manifest["partitions"])
        tables = [pq.read_table(self.folder / name) for name in names]
        if not tables:
            return pa.table({"row": pa.array([], pa.int64()), "error": pa.array([], pa.string())})
        return pa.concat_tables(tables, promote_options="permissive")

    def to_pandas(self) -> Any:
        """All rows as a DataFrame, in the order of the grid.

        Returns
        -------
        pandas.DataFrame

        Examples
        --------
        >>> sweep(lambda row: {"square": row["x"] ** 2}, {"x": [1, 2]}).to_pandas()["square"].tolist()
        [1, 4]
        """
        return self.to_arrow().to_pandas()

    def __len__(self) -> int:
        return sum(part["rows"] for part in self.manifest["partitions"].values())

    def __repr__(self) -> str:
        return f"<Sweep {self.folder}, {len(self)} rows>"


def sweep(
    task: Callable[[dict[str, Any]], Mapping[str, Any]] | SimulationTask,
    grid: Mapping[str, Sequence[Any]] | RandomSample | Any,
    *,
    on: Any = "process",
    out: str | os.PathLike[str] | None = None,
    chunk: int = 1000,
    version: str = "",
    progress: bool = False,
) -> Sweep:
    """Runs a task for every row of a grid, and writes the results as a Parquet data set.

    Each row has its number, the parameters, the results, and ``error``, the reason why the task failed. The rows do not depend
    on the engine. All values of a column have the same kind: truth values, integers, floats, strings or lists. Integers up to
    2^53 may occur among floats; fractions and expressions become strings. A result of any other type is an error of its row, and
    so is a result of another kind than the earlier rows of its chunk. A chunk of another kind ends the sweep. A sweep has at
    most 2^40 rows.

    Parameters
    ----------
    task : callable or SimulationTask
        Function that maps a dict of parameters to a dict of results, or a SimulationTask.
    grid : dict, DataFrame or RandomSample
        Rows of parameters. A dict of lists means every combination of their values; the last parameter varies fastest.
    on : str or dask.distributed.Client
        ``"process"`` runs the task in this process, on all cores. ``"dask"`` runs it on a local cluster that ends with the
        sweep. A client of Dask, or ``"ray"``, runs it on their workers.
    out : path, optional
        Folder of the data set; by default a temporary folder. An interrupted sweep continues if the function is called again
        with the same folder.
    chunk : int
        Number of rows in each partition. A partition is one file.
    version : str
        Version of the task. Change it if the code of the task changes, or a file that the task reads.
    progress : bool
        Whether to show a progress bar of tqdm.

    Returns
    -------
    Sweep

    Raises
    ------
    ValueError
        The folder belongs to another grid, ``chunk`` or ``version``, or the grid has no rows.
    TypeError
        Two chunks have results of different kinds.

    Examples
    --------
    >>> squares = sweep(lambda row: {"square": row["x"] ** 2}, {"x": [1, 2, 3]})
    >>> squares.to_pandas()["square"].tolist()
    [1, 4, 9]
    """
    if not isinstance(task, SimulationTask) and not callable(task):
        raise TypeError(f"a task is a function of a dict or SimulationTask, not {type(task).__name__}")
    chunk = index("chunk", chunk)
    if chunk < 1:
        raise ValueError(f"chunk should be at least one row, not {chunk}")
    source = _Grid(grid)
    names = source.rows(0, 0)
    if reserved := {"row", "error"} & set(names):
        raise ValueError(f"{sorted(reserved)[0]!r} is a column of every sweep: rename the parameter")
    if not names:
        raise ValueError("the grid needs at least one parameter")
    if not len(source):
        empty = [name for name, values in getattr(source, "values", {}).items() if not values]
        raise ValueError(f"the grid has no rows: {f'the list of {empty[0]} is empty' if empty else 'give some samples'}")
    with contextlib.ExitStack() as stack:
        if out is None:
            out = stack.enter_context(tempfile.TemporaryDirectory(prefix="affinor-sweep-"))
        folder = Path(out).absolute()
        folder.mkdir(parents=True, exist_ok=True)
        found = _run(task, source, folder, chunk, on, progress, version)
        # a temporary folder of rows is deleted when the Sweep object is deleted
        weakref.finalize(found, stack.pop_all().close)
    return found


def _run(task: Any, source: _Grid, folder: Path, chunk: int, on: Any, progress: bool, version: str) -> Sweep:
    """Computes the partitions that the folder does not contain yet."""
    from affinor import __version__

    head = {"grid": source.digest(), "rows": len(source), "chunk": chunk, "version": version, "affinor": __version__}
    done = _begin(folder, head)
    starts = range(0, len(source), chunk)
    before = set(done)
    computed = 0

    def parts() -> Iterator[tuple[Any, ...]]:
        for start in starts:
            if _name(start // chunk) in before:
                continue
            stop = min(start + chunk, len(source))
            yield task, start, source.rows(start, stop), source.kinds, str(folder), _name(start // chunk)

    bar: Any = None
    if progress:
        bar = optional("tqdm.auto", "progress").tqdm(total=len(source), initial=sum(part["rows"] for part in done.values()))
    kinds: dict[str, Kind] = {}
    for name in sorted(done):
        _unify(kinds, folder / name)
    engine, close = _engine_of(on)
    try:
        for name, rows in engine(parts()):
            _unify(kinds, folder / name)
            done[name] = {"rows": rows}
            computed += 1
            if bar is not None:
                bar.update(rows)
    finally:
        close()
        if bar is not None:
            bar.close()
    _write_json(folder / _MANIFEST, {**head, "partitions": dict(sorted(done.items()))})
    return Sweep(folder, computed)


# -- grids ---------------------------------------------------------------------------------------------------------------


class _Grid:
    """A grid of any kind, whose rows are found by their indices."""

    def __init__(self, grid: Any) -> None:
        self.grid = grid
        self.kinds: dict[str, Kind] = {}
        if isinstance(grid, RandomSample):
            self.kinds = {name: _kind_of(name, [0.0] if isinstance(law, str) else law) for name, law in grid.laws.items()}
            self.length = _row_count([grid.samples])
            return
        if isinstance(grid, Mapping):
            for name, values in grid.items():
                if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
                    raise TypeError(f"the values of {name} are a list, not {type(values).__name__}")
            # checks the number of rows before ranges are converted to lists
            _row_count(_length(values) for values in grid.values() if isinstance(values, Sequence))
            self.values: dict[str, Sequence[Any]] = {
                str(name): values if isinstance(values, range) and len(values) > _LONG else list(values)
                for name, values in grid.items()
            }
            self.length = _row_count(map(len, self.values.values()))
        elif hasattr(grid, "columns") and hasattr(grid, "to_dict"):
            self.values = {str(name): grid[name].tolist() for name in grid.columns}
            self.length = len(grid)
        else:
            raise TypeError(f"a grid is a dict of lists, a DataFrame or a RandomSample, not {type(grid).__name__}")
        self.kinds = {name: _kind_of(name, values) for name, values in self.values.items()}

    def __len__(self) -> int:
        return self.length

    def digest(self) -> str:
        """A hash of the grid, which identifies it."""
        draw = isinstance(self.grid, RandomSample)
        values = self.grid.laws if draw else self.values

        def whole(law: Any) -> bool:
            """Whether a law is hashed as text, and not by its values."""
            return isinstance(law, str) or (isinstance(law, range) and len(law) > _LONG)

        plain = [(name, law if whole(law) else [_plain(value) for value in law]) for name, law in values.items()]
        written = repr((type(self.grid).__name__, self.grid.seed if draw else None, plain))
        return hashlib.sha256(written.encode()).hexdigest()

    def rows(self, start: int, stop: int) -> Columns:
        """The values of the rows ``start`` to ``stop``, by parameter."""
        if isinstance(self.grid, RandomSample):
            return self.grid.rows(start, stop)
        if not isinstance(self.grid, Mapping):
            return {name: list(values[start:stop]) for name, values in self.values.items()}
        found: Columns = {}
        step = 1
        for name, values in reversed(self.values.items()):
            found[name] = [values[row // step % len(values)] for row in range(start, stop)]
            step *= len(values)
        return dict(reversed(found.items()))


def _length(values: Sequence[Any]) -> int:
    """The number of values. A range may be so long that ``len`` overflows."""
    try:
        return len(values)
    except OverflowError:
        return 2**63


def _row_count(lengths: Iterable[int]) -> int:
    """The number of rows of a grid whose lists have these lengths."""
    count = math.prod(lengths)
    if count > _MOST_ROWS:
        raise ValueError(f"the grid has {count} rows, but a sweep has at most 2^40: split the grid")
    return count


# -- partitions ------------------------------------------------------------------------------------------------------------


def _name(part: int) -> str:
    """The file name of a partition."""
    return f"part-{part:06d}.parquet"


def _partition(
    task: Any, start: int, rows: Columns, kinds: dict[str, Kind], folder: str, name: str, threads: int | None = None
) -> tuple[str, int]:
    """Computes and writes a partition. Returns its name and its number of rows."""
    pa, pq = optional("pyarrow", "sweep"), optional("pyarrow.parquet", "sweep")

    before = _engine.threads()
    threads = before if threads is None else threads
    count = len(next(iter(rows.values()), []))
    try:
        if threads != before:
            _engine.set_threads(threads)
        if isinstance(task, SimulationTask):
            results, errors = task.run_rows(rows)
            found = {key: "float" for key in results}
        else:
            results, errors, found = _each(task, rows, count)
    finally:
        # the process of a worker may compute other things, so its number of threads is restored
        if threads != before:
            _engine.set_threads(before)
    columns = {"row": list(range(start, start + count)), **rows, **results, "error": errors}
    kinds = {"row": "integer", **kinds, **found, "error": "text"}
    table = pa.table({key: _array(pa, values, kinds[key]) for key, values in columns.items()})
    table = table.replace_schema_metadata({"affinor": json.dumps(found)})
    # writes to a temporary name and renames it: several runs of this partition write equal bytes
    path = os.path.join(folder, f".{name}.{os.getpid()}.{time.time_ns()}.tmp")
    with open(path, "wb") as file:
        pq.write_table(table, file, compression="zstd")
        file.flush()
        os.fsync(file.fileno())
    os.replace(path, os.path.join(folder, name))
    return name, count


def _each(
    task: Callable[[dict[str, Any]], Mapping[str, Any]], rows: Columns, count: int
) -> tuple[Columns, list[str | None], dict[str, Kind]]:
    """Calls a function for each row. Returns the results, the errors, and the kinds of the results."""

    def one(at: int) -> tuple[dict[str, Any], str | None]:
        before = interrupts.set("raise")
        try:
            found = task({name: values[at] for name, values in rows.items()})
            if not isinstance(found, Mapping):
                raise TypeError(f"a task returns a dict of results, not {type(found).__name__}")
            return {str(key): _result(str(key), value) for key, value in found.items()}, None
        except (Exception, SystemExit) as error:
            return {}, _reason(error)
        finally:
            interrupts.reset(before)

    workers = min(_engine.threads(), max(count, 1))
    if workers > 1:
        with ThreadPoolExecutor(workers) as pool:
            found = list(pool.map(one, range(count)))
    else:
        found = [one(at) for at in range(count)]
    kinds: dict[str, Kind] = {}
    for at, (result, _) in enumerate(found):
        if taken := ({"row", "error"} | rows.keys()) & result.keys():
            raise ValueError(f"the result {sorted(taken)[0]!r} has the name of another column")
        try:
            kinds |= {key: _common(key, kinds.get(key), _kind(value)) for key, value in result.items()}
        except TypeError as error:
            found[at] = {}, _reason(error)
    return {key: [result.get(key) for result, _ in found] for key in kinds}, [error for _, error in found], kinds


def _reason(error: BaseException) -> str:
    """The class of an exception and the first line of its message."""
    return f"{type(error).__name__}: {str(error).splitlines()[0] if str(error) else ''}"


def _plain(value: Any) -> Any:
    """Converts a value to a type that Parquet supports."""
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, np.floating):
        return float(value)
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return str(value)


def _result(name: str, value: Any) -> Any:
    """Converts a result of a task to a Parquet value: a number, a string, a truth value, or lists of them."""
    if isinstance(value, np.generic):
        value = value.item()
    elif hasattr(value, "__array__") or is_matrix(value):
        value = np.asarray(value).tolist()
    if isinstance(value, (list, tuple)):
        return [_result(name, item) for item in value]
    known = value is None or isinstance(value, (str, bool, numbers.Real, Decimal)) or is_sympy(value)
    if not known:
        kinds = "a number, a text, a truth value, a list or an array"
        raise TypeError(f"the result {name!r} should be {kinds}, not {type(value).__name__}")
    return _plain(value)


def _kind(value: Any) -> Kind:
    """The kind of a Parquet value."""
    if value is None:
        return None
    if isinstance(value, list):
        inner: Kind = None
        for item in value:
            inner = _common("", inner, _kind(item))
        return ["list", inner]
    if isinstance(value, int) and not isinstance(value, bool):
        if not -(2**63) <= value < 2**63:
            raise TypeError(f"the integer {value} has more than 64 bits: give it as a text")
        return "integer" if abs(value) <= 2**53 else "long integer"
    return "truth value" if isinstance(value, bool) else "float" if isinstance(value, float) else "text"


def _common(name: str, a: Kind, b: Kind) -> Kind:
    """The kind of a column that has values of the kinds ``a`` and ``b``."""
    if a is None or b is None or a == b:
        return b if a is None else a
    if isinstance(a, list) and isinstance(b, list):
        return ["list", _common(name, a[1], b[1])]
    if "integer" in (a, b):
        other = b if a == "integer" else a
        if other in ("long integer", "float"):
            return other
    first, second = ("list" if isinstance(kind, list) else kind for kind in (a, b))
    raise TypeError(f"the column {name!r} has values of two kinds, {first} and {second}: convert them to one")


def _kind_of(name: str, values: Iterable[Any]) -> Kind:
    """The kind of a column of a grid. If a column contains fractions, its integers are strings."""
    if isinstance(values, range) and len(values) > _LONG:
        # the first and the last number of a range are its extremes, which determine the kind
        values = [values[0], values[-1]]
    exact = any(isinstance(value, Fraction) for value in values)
    found: Kind = None
    for value in values:
        plain = _plain(value)
        found = _common(name, found, "text" if exact and type(plain) is int else _kind(plain))
    return found


def _array(pa: Any, values: list[Any], kind: Kind) -> Any:
    """Creates an Arrow column of values of one kind."""
    types = {None: pa.null(), "truth value": pa.bool_(), "float": pa.float64(), "text": pa.string()}

    def type_of(kind: Kind) -> Any:
        return pa.list_(type_of(kind[1])) if isinstance(kind, list) else types.get(kind, pa.int64())

    plain = [_plain(value) for value in values]
    if kind == "text":
        plain = [None if value is None else str(value) for value in plain]
    return pa.array(plain, type_of(kind))


def _unify(kinds: dict[str, Kind], path: Path) -> None:
    """Adds the kinds of the results of a partition. They must agree with those of earlier partitions."""
    pq = optional("pyarrow.parquet", "sweep")

    metadata = pq.read_schema(path).metadata or {}
    for key, kind in json.loads(metadata.get(b"affinor", "{}")).items():
        kinds[key] = _common(key, kinds.get(key), kind)


def _begin(folder: Path, head: Mapping[str, Any]) -> dict[str, Any]:
    """Finds the partitions that the folder already contains. A folder of another sweep is an error."""
    pa, pq = optional("pyarrow", "sweep"), optional("pyarrow.parquet", "sweep")

    path = folder / _MANIFEST
    if not path.exists():
        foreign = [item.name for item in folder.iterdir() if item.suffix == ".parquet"]
        if foreign:
            raise ValueError(f"{folder} has {foreign[0]}, which does not belong to a sweep: choose another folder")
        _write_json(path, {**head, "partitions": {}})
        return {}
    before = _manifest(path)
    other = [key for key in head if before.get(key) != head[key]]
    if other:
        raise ValueError(f"{folder} has rows of another {other[0]}: choose another folder")
    done: dict[str, Any] = {}
    for item in folder.glob("part-*.parquet"):
        # ignores a damaged file, so that its partition is computed again
        with contextlib.suppress(pa.ArrowException, OSError):
            done[item.name] = {"rows": pq.read_metadata(item).num_rows}
    return done


def _manifest(path: Path) -> dict[str, Any]:
    """The description of the sweep in a folder."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        if not isinstance(found, dict) or not isinstance(found.get("partitions"), dict):
            raise ValueError("its keys are missing")
    except ValueError as error:
        raise ValueError(f"{path} does not describe a sweep ({error}): choose another folder, or remove this one") from error
    return found


def _write_json(path: Path, value: Any) -> None:
    """Writes a JSON file. An existing file is replaced in a single step."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    temporary.write_text(json.dumps(value, indent=1), encoding="utf-8")
    os.replace(temporary, path)


# -- engines ---------------------------------------------------------------------------------------------------------------

Engine = Callable[[Iterator[tuple[Any, ...]]], Iterator[tuple[str, int]]]


def _engine_of(on: Any) -> tuple[Engine, Callable[[], Any]]:
    """Returns a function that runs partitions, and a function that releases the resources of the first."""
    if on == "process":
        return _in_process, lambda: None
    if on == "dask":
        from dask.distributed import Client, LocalCluster

        cluster = LocalCluster(threads_per_worker=1, dashboard_address=None)
        client = Client(cluster)

        def close() -> None:
            client.close()
            cluster.close()

        return lambda parts: _on_dask(client, parts), close
    if hasattr(on, "submit") and hasattr(on, "scheduler_info"):
        return lambda parts: _on_dask(on, parts), lambda: None
    if on == "ray" or getattr(on, "__name__", None) == "ray":
        return _on_ray, lambda: None
    raise ValueError(f"a sweep runs on 'process', 'dask', a Client of dask.distributed, or 'ray', not {on!r}")


def _in_process(parts: Iterator[tuple[Any, ...]]) -> Iterator[tuple[str, int]]:
    """Runs partitions one after the other in this process."""
    for part in parts:
        yield _partition(*part)


def _on_dask(client: Any, parts: Iterator[tuple[Any, ...]]) -> Iterator[tuple[str, int]]:
    """Runs partitions on Dask. Submits as many partitions at a time as the workers need, and releases each finished future."""
    from dask.distributed import as_completed

    def submit(part: tuple[Any, ...]) -> Any:
        return client.submit(_partition, *part, 1, pure=False)

    threads = sum(worker["nthreads"] for worker in client.scheduler_info(n_workers=-1)["workers"].values())
    first = [submit(part) for part in itertools.islice(parts, 2 * max(threads, 1) + 2)]
    flying = as_completed(first)
    for future in flying:
        yield future.result()
        future.release()
        for part in itertools.islice(parts, 1):
            flying.add(submit(part))


def _on_ray(parts: Iterator[tuple[Any, ...]]) -> Iterator[tuple[str, int]]:
    """Runs partitions on Ray. A limited number of partitions is submitted at a time."""
    ray = optional("ray", "ray")

    if not ray.is_initialized():
        ray.init(include_dashboard=False, log_to_driver=False)
    remote = ray.remote(num_cpus=1)(_partition)
    cores = int(ray.cluster_resources().get("CPU", 1))
    flying = [remote.remote(*part, 1) for part in itertools.islice(parts, 2 * cores + 2)]
    while flying:
        ready, flying = ray.wait(flying, num_returns=1)
        yield from ray.get(ready)
        flying.extend(remote.remote(*part, 1) for part in itertools.islice(parts, 1))
