"""affinor beside other programs: curvature of Levi-Civita, by size (`numbers`) and by symbols (`symbols`), and
where symbols become too many (`limits`); of metrics over charts (`charts`), and of homogeneous spaces (`homogeneous`);
products, weights and restrictions of representations (`representations`).

    python3 benches/peers/run.py numbers --affinor target/release/affinor > numbers.md
    cargo bench -p affinor-benches --bench table_calls --no-run
    python3 benches/peers/run.py symbols --affinor target/release/affinor --calls target/release/deps/table_calls-* > symbols.md
    python3 benches/peers/run.py limits  --affinor target/release/affinor > limits.md
    python3 benches/peers/run.py charts  --affinor target/release/affinor --calls target/release/deps/table_calls-* > charts.md
    python3 benches/peers/run.py homogeneous --affinor target/release/affinor --calls target/release/deps/table_calls-* > homogeneous.md
    python3 benches/peers/run.py representations --affinor target/release/affinor > representations.md

Each is one run that writes one Markdown document; progress goes to standard error. What is not installed has a
column of dashes. The peers, on Debian:

    apt-get install maxima maxima-share gap-core lie g++ libginac-dev
    pip install python-flint symengine                      # likewise
    pip install numpy scipy sympy                           # for the python3 that runs this, or --python
    pip install geomstats==2.8.0 'numpy<2'                  # in an environment of its own: --geomstats
    pip install passagemath-modules passagemath-symbolics passagemath-gap passagemath-combinat passagemath-repl \\
        passagemath-groups passagemath-polyhedra passagemath-flint passagemath-ntl passagemath-categories \\
        passagemath-schemes passagemath-graphs              # SageManifolds, likewise: --sage

How it is measured
- Every cell is a fresh process with a limit of CPU time and of resident memory, its children included.
- The structure constants are affinor's: `affinor table NAME --show structure --format csv`, handed to all.
- The peers measure themselves, in CPU seconds (user and system), from the constants in memory to the list of
  nonzero R^i_jkl, k < l. Starting, importing, reading and printing do not count. Short work is repeated until it
  fills a second: the mean.
- affinor: the CPU time of its process when the lines of `--timings` arrive, that is of its stages `connection` and
  `curvature`, and the CPU time of the whole process, with starting, reading, the Jacobi identity and printing; the
  median of up to five runs. With --calls, instead of the stages, the call in the library from the algebra in memory to the
  components, repeated as the peers repeat theirs (benches/table_calls.rs). Wall-clock times are what `--timings` says of these stages, the smallest of the runs.
- Several processes run side by side (--jobs), for many cells end at their limit. CPU time suffers from it through
  caches and clocks only; wall-clock times need a quiet machine and --jobs 1.
- One thread each (OPENBLAS_NUM_THREADS=1) unless the column says otherwise.
- Results are compared: the number of nonzero components always; values as the caption says.

Beside this file: `peer.py`, what the Python ones share; `numbers_*.py`, `symbols_*.py`, `charts_*.py` with `chart_metrics.py`, `homogeneous_*.py`, `representation_tasks.py` with `representations_*.py`, and `symbols_ginac.cpp`, which is compiled here.
"""
import argparse
import csv
import json
import os
import random
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction

import chart_metrics
import homogeneous_spaces
import representation_tasks

csv.field_size_limit(1 << 30)
HERE = os.path.dirname(os.path.abspath(__file__))
NUMBERS = ["so3", "sl3", "so5", "G2", "so8", "F4", "E6", "so(16)", "E7", "E8"]
SMALL = 14  # the largest dimension whose values are compared
SYMBOLS = ["so3", "sl(2)", "se3", "so4", "so(3,1)", "heisenberg(5)", "sl3"]
LIMITS = ["se3", "so4"]
PRIME = 2**61 - 1
MINUTE = 60

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("table", choices=["numbers", "symbols", "limits", "charts", "homogeneous", "representations"])
arguments.add_argument("--affinor", default="target/release/affinor", help="the program")
arguments.add_argument("--calls", help="the program of benches/table_calls.rs")
arguments.add_argument("--python", default=sys.executable, help="Python with numpy, scipy, sympy")
arguments.add_argument("--sage", help="Python with passagemath")
arguments.add_argument("--geomstats", help="Python with geomstats")
arguments.add_argument("--seconds", type=float, help="CPU limit of a cell [60; limits: 300]")
arguments.add_argument("--memory", type=float, help="its memory limit, GB [8; symbols: 4]")
arguments.add_argument("--jobs", type=int, default=4, help="processes side by side [4]")
options = arguments.parse_args()
SECONDS = options.seconds or (300 if options.table == "limits" else 60)
MEMORY = options.memory or (4 if options.table == "symbols" else 8)
FOLDER = tempfile.mkdtemp(prefix="peers")
TICK, PAGE = os.sysconf("SC_CLK_TCK"), os.sysconf("SC_PAGE_SIZE")


class Done:
    """A process that has ended: its output, CPU seconds and peak of memory; `why` if it was ended."""

    def __init__(self, output, errors, cpu, peak, why):
        self.output, self.errors, self.cpu, self.peak, self.why = output, errors, cpu, peak, why

    def wall(self, *stages):
        """Wall-clock seconds of these stages, as affinor says."""
        return sum(float(re.search(rf"^timing: {stage} ([\d.]+) s", self.errors, re.M)[1]) for stage in stages)


def usage(pid):
    """CPU seconds and resident bytes of a process and its descendants."""
    try:
        fields = open(f"/proc/{pid}/stat").read().rpartition(")")[2].split()
        children = open(f"/proc/{pid}/task/{pid}/children").read().split()
    except OSError:
        return 0, 0
    cpu, memory = sum(map(int, fields[11:15])) / TICK, int(fields[21]) * PAGE
    for child in children:
        more = usage(child)
        cpu, memory = cpu + more[0], memory + more[1]
    return cpu, memory


def run(command, output=None, limit=None):
    """Runs a command within the limits. `stages`: CPU seconds between the lines `timing: ...` of its errors."""
    limit = limit or SECONDS
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
    with tempfile.TemporaryFile("w+") as out:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output or out, stderr=subprocess.PIPE,
                                   start_new_session=True, env=environment, text=True)
        clock, errors, stages = ~process.pid << 3 | 2, [], {}  # the CPU clock of another process

        def listen():
            before = 0.0
            for line in process.stderr:
                errors.append(line)
                if stage := re.match(r"timing: (\w+) ", line):
                    try:
                        now = time.clock_gettime(clock)
                    except OSError:
                        now = before  # it has ended
                    stages[stage[1]], before = now - before, now

        listener = threading.Thread(target=listen)
        listener.start()
        started, peak, why = time.time(), 0, None
        while True:
            pid, _, used = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            cpu, memory = usage(process.pid)
            peak = max(peak, memory)
            # a process that only waits must end too
            if cpu > limit or time.time() - started > 40 * limit:
                why = f"> {limit:.0f} s"
            if memory > MEMORY * 1e9:
                why = f"> {MEMORY:.0f} GB"
            if why:
                os.killpg(process.pid, signal.SIGKILL)
                _, _, used = os.wait4(process.pid, 0)
                break
            time.sleep(0.02 if time.time() - started < 2 else 0.2)
        process.returncode = 0  # it is gone
        listener.join()
        out.seek(0)
        done = Done(out.read(), "".join(errors), used.ru_utime + used.ru_stime, max(peak, used.ru_maxrss * 1024), why)
    done.stages = stages
    return done

def say(*words):
    print(time.strftime("%H:%M:%S"), *words, file=sys.stderr, flush=True)


def components(path):
    """The components of a table in CSV, as {(tensor, indices): text}; of curvature those with k < l."""
    found = {}
    with open(path) as file:
        for row in csv.DictReader(file):
            at = tuple(int(row[name]) for name in "ijkl" if row[name])
            if row["tensor"] != "curvature" or at[2] < at[3]:
                found[row["tensor"], at] = row["value"]
    return found


def half(path):
    """The number of components of the curvature with k < l: of an antisymmetric pair, half of all lines."""
    with open(path) as file:
        return sum(1 for _ in file) // 2


def affinor(name, metric, show, *more, path=None, limit=None):
    """Runs `affinor table` into a file; also its stages in seconds."""
    command = [options.affinor, "table", name, "--show", show, "--format", "csv", "--timings", *more]
    if metric:
        command += ["--metric", metric]
    with open(path or os.devnull, "w") as file:
        done = run(command, file, limit)
    if not done.why and "output" not in done.stages:
        sys.exit(f"{' '.join(command)}: {done.errors}")
    return done


def constants(name):
    """Writes the structure constants for the peers; the dimension and the path."""
    path, table = os.path.join(FOLDER, name), os.path.join(FOLDER, "structure.csv")
    affinor(name, None, "structure", path=table)
    found = [(*at, v) for (_, at), v in components(table).items()]
    n = max(max(row[:3]) for row in found)
    with open(path, "w") as file:
        file.write(f"{n}\n" + "".join(f"{i} {j} {k} {v}\n" for i, j, k, v in found if j < k))
    return n, path


def peer(script, python, *rest):
    """Runs a peer, by a Python or by itself; what it reports, as {tensor: (seconds, count)}, and its values."""
    handle, path = tempfile.mkstemp(dir=FOLDER)
    os.close(handle)
    done = run([*python, os.path.join(HERE, script), rest[0], path, *rest[1:]])
    done.reports = {w[1]: (float(w[2]), int(w[3])) for w in map(str.split, done.output.splitlines())
                    if w[:1] == ["RESULT"]}
    done.values = {}
    if not done.why:  # a file of a process that was ended may stop within a line
        for line in open(path):
            tensor, *at, value = line.split()
            done.values[tensor, tuple(map(int, at))] = value
        if not done.reports:
            say("FAILED", script, (done.output + done.errors)[-300:])
            done.why = "failed"
    say(os.path.basename(rest[0]), script, *rest[-2:], done.why, done.reports, f"{done.cpu:.1f} s {done.peak / 1e6:.0f} MB")
    return done


def seconds(t, least=0.0):
    if t < least:
        return f"< {1000 * least:.0f} ms"
    if t == 0:
        return "< 10 ms"  # below the clock of the peer
    return f"{t:.0f} s" if t >= 100 else f"{t:.1f} s" if t >= 1 else f"{1000 * t:.3g} ms"


def part(t, whole):
    """A stage of a process, which bounds it; of a short process no more is known, for lines arrive late."""
    return seconds(t) if whole >= 0.2 else "< " + seconds(whole)


def called(space, metric, tensor, done):
    """What affinor takes for a tensor: the call in the library, or the stages of the process; and the process."""
    if not options.calls:
        return f"{part(done.stages['connection'] + done.stages[tensor], done.cpu)}; {seconds(done.cpu)}"
    call = run([options.calls, space, metric, tensor])
    if call.why:
        sys.exit(f"{space} {tensor}: {call.errors or call.why}")
    return f"{seconds(float(call.output))}; {seconds(done.cpu)}"


def megabytes(size):
    return f"{size / 1e6:.0f} MB" if size >= 1e6 else f"{size / 1e3:.1f} kB"


def row(*cells):
    print("|", " | ".join(str(cell) for cell in cells), "|", flush=True)


def head(*cells):
    row(*cells)
    row(*["---"] + ["---:"] * (len(cells) - 1))


def version(command):
    try:
        return subprocess.run(command, capture_output=True, text=True).stdout.strip().splitlines()[-1]
    except (OSError, IndexError):
        return "not here"


def about():
    """Machine and versions, as they were in this run."""
    module = "import importlib.metadata as m; print(m.version('{}'))".format
    model = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), "?")
    load = " ".join(f"{x:.1f}" for x in os.getloadavg())
    print(f"{time.strftime('%Y-%m-%d')}; {os.cpu_count()} cores, {model}; load average at the start {load}; limits "
          f"of a cell {SECONDS:.0f} s of CPU, {MEMORY:.0f} GB.")
    python = options.python
    platform = "import platform as p; print(p.python_version())"
    parts = [version([options.affinor, "--version"]), "Python " + version([python, "-c", platform]),
             "SymPy " + version([python, "-c", module("sympy")]), version(["maxima", "--version"])]
    if options.table == "symbols":
        parts += ["python-flint " + version([python, "-c", module("python-flint")]),
                  "SymEngine " + version([python, "-c", module("symengine")]),
                  "GiNaC " + version(["pkg-config", "--modversion", "ginac"])]
    if options.table == "numbers":
        parts += ["SciPy " + version([python, "-c", module("scipy")]),
                  "GAP " + version(["gap", "-q", "-c", 'Print(GAPInfo.Version, "\\n"); QUIT;'])]
    if options.sage and options.table in ("numbers", "charts", "homogeneous"):
        parts.append("SageManifolds in passagemath " + version([options.sage, "-c", module("passagemath-modules")]))
    if options.table == "numbers":
        if options.geomstats:
            parts.append("geomstats " + version([options.geomstats, "-c", module("geomstats")]))
    print("; ".join(parts) + ".\n", flush=True)


def alone(name, metric, expected):
    """The row of affinor: CPU of the two stages and of the process, and the wall-clock time by threads."""
    cells = []
    for scalar in ("exact", "float"):
        path = os.path.join(FOLDER, f"{name} {scalar}.csv")
        affinor(name, metric, "curvature", "--scalar", scalar, path=path)
        count = half(path)
        os.remove(path)
        if count != expected:
            sys.exit(f"{name}: affinor in {scalar} has another number of components")
        runs = {"1": [], "2": []}
        for threads, found in runs.items():
            began = time.time()
            while len(found) < 5 and (time.time() - began < 15 or len(found) < 2):
                found.append(affinor(name, metric, "curvature", "--scalar", scalar, "--threads", threads))
        whole = statistics.median(one.cpu for one in runs["1"])
        stages = statistics.median(one.stages["connection"] + one.stages["curvature"] for one in runs["1"])
        cells += [part(stages, whole), seconds(whole)]
        cells += [seconds(min(one.wall("connection", "curvature") for one in found), 0.002) for found in runs.values()]
    say(name, *cells)
    return cells


def sizes_of(label, spaces, script, python, *more):
    """The column of a peer, until it gives up: what each size took, and whether values were compared."""
    column = []
    for name, n, path, number, expected in spaces:
        done = peer(script, [python], path, *more)
        if done.why:
            return column + [(done.why, False)]
        t, count = done.reports["curvature"]
        if count != number:
            sys.exit(f"{name}: {label} has {count} components, affinor {number}")
        if n <= SMALL:
            equal = (lambda v, w: abs(float(v) - float(w)) < 1e-9) if "f64" in label else (lambda v, w: v == w)
            if done.values.keys() != expected.keys() or not all(
                    equal(Fraction(v), Fraction(expected[at])) for at, v in done.values.items()):
                sys.exit(f"{name}: {label} has other values")
        column.append((seconds(t), n <= SMALL))
    return column


def numbers():
    gap, maxima = (options.python if shutil.which(program) else None for program in ("gap", "maxima"))
    peers = {"SciPy f64": ("numbers_scipy.py", options.python), "GAP": ("numbers_gap.py", gap),
             "Maxima, loops": ("numbers_maxima.py", maxima, "plain"),
             "Maxima ctensor": ("numbers_maxima.py", maxima, "ctensor"),
             "SymPy": ("numbers_sympy.py", options.python), "SageManifolds": ("numbers_sage.py", options.sage),
             "geomstats f64": ("numbers_geomstats.py", options.geomstats)}
    about()
    spaces, metrics = [], {}
    for name in NUMBERS:
        n, path = constants(name)
        metrics[name] = f"diag({','.join(map(str, range(1, n + 1)))})"
        table = os.path.join(FOLDER, "curvature.csv")
        affinor(name, metrics[name], "curvature", path=table)
        spaces.append((name, n, path, half(table), components(table) if n <= SMALL else None))
    with ThreadPoolExecutor(options.jobs) as pool:
        columns = {}
        for label, (script, python, *more) in peers.items():
            of = [space for space in spaces if "geomstats" not in label or space[0].startswith("so")]
            columns[label] = of, pool.submit(sizes_of, label, of if python else [], script, python, *more)
        ours = [pool.submit(alone, name, metrics[name], number) for name, _, _, number, _ in spaces]
    print("affinor: the stages connection and curvature together, and the whole process, which prints CSV\n")
    head("algebra", "dimension", "nonzero R^i_jkl, k < l", *(f"{scalar}: {what}" for scalar in ("exact", "f64") for what in
         ("CPU", "CPU of the process", "wall, 1 thread", "wall, 2 threads")))
    for (name, n, _, number, _), cells in zip(spaces, ours):
        row(name, n, f"{number:,}", *cells.result())
    print("\nCPU time of connection and curvature: affinor (exact, 1 thread) and the peers\n")
    head("algebra", "affinor", *peers)
    same, agreed = {}, 0
    for space, cells in zip(spaces, ours):
        found = [space[0], cells.result()[0]]
        for label, (of, future) in columns.items():
            column = future.result()
            at = of.index(space) if space in of else len(column)
            found.append(column[at][0] if at < len(column) else "-")
            agreed += at < len(column) and not column[at][0].startswith(">")
            if at < len(column) and column[at][1]:
                same.setdefault(space[0], []).append(label)
        row(*found)
    print(f"\nIn all {agreed} runs of a peer that ended, the number of nonzero components agreed. All values agreed "
          "(floats within 1e-9) in these runs: " + "; ".join(f"{name}: {', '.join(labels)}" for name, labels in same.items()) + ".")

def value_at(text, point):
    """The value of an expression at integers, modulo PRIME."""
    tokens = re.findall(r"\d+|\w+|\*\*|[-+*/^()]", text)
    tokens.append("")
    at = 0

    def atom():
        nonlocal at
        token = tokens[at]
        at += 1
        if token == "(":
            v = total()
            at += 1
            return v
        return int(token) if token.isdigit() else point[token]

    def power():
        nonlocal at
        v = atom()
        if tokens[at] in ("^", "**"):
            at += 1
            v = pow(v, atom(), PRIME)
        return v

    def product():
        nonlocal at
        if tokens[at] == "-":
            at += 1
            return -product()
        v = power()
        while tokens[at] in ("*", "/"):
            divide = tokens[at] == "/"
            at += 1
            w = power()
            v = v * (pow(w, -1, PRIME) if divide else w) % PRIME
        return v

    def total():
        nonlocal at
        v = product()
        while tokens[at] in ("+", "-"):
            sign = -1 if tokens[at] == "-" else 1
            at += 1
            v = (v + sign * product()) % PRIME
        return v % PRIME

    v = total()
    assert at == len(tokens) - 1, text
    return v


def letter(i, j):
    return f"g{min(i, j)}{max(i, j)}"


def matrix(n, free):
    """A symmetric matrix of letters: the diagonal, and the places that are free."""
    return [[letter(i, j) if i == j or (min(i, j), max(i, j)) in free else "0" for j in range(1, n + 1)]
            for i in range(1, n + 1)]


def off_diagonal(n):
    return [(i, j) for i in range(1, n + 1) for j in range(i + 1, n + 1)]


def blocks(n):
    return [(i, j) for i, j in off_diagonal(n) if (i - 1) // 3 == (j - 1) // 3]


def written(rows, between=","):
    return "[" + between.join(f"[{','.join(row)}]" for row in rows) + "]"


def letters(rows):
    return sorted({name for row in rows for name in row} - {"0"})


def cell(name, kind, rows, tensor):
    """affinor in one cell: the process, and its components without spaces."""
    table = os.path.join(FOLDER, f"{name} {kind} {tensor}.csv")
    done = affinor(name, written(rows), tensor, "--threads", "1", path=table)
    done.reports, done.values = {}, {}
    if not done.why:
        done.values = {at: v.replace(" ", "") for at, v in components(table).items()}
        done.reports[tensor] = called(name, written(rows), tensor, done), len(done.values)
    say(name, kind, tensor, "affinor", done.why or done.reports, f"{done.peak / 1e6:.0f} MB")
    return done


def symbols():
    tensors = ["affinities", "curvature", "ricci"]
    python, ginac = [options.python], os.path.join(FOLDER, "ginac")
    peers = {"Maxima": ("symbols_maxima.py", python, []), "python-flint": ("symbols_python.py", python, ["flint"]),
             "GiNaC": (ginac, [], []), "SymEngine": ("symbols_python.py", python, ["symengine"]),
             "SymPy, field": ("symbols_python.py", python, ["field"]), "SymPy, cancel": ("symbols_python.py", python, ["cancel"])}
    subprocess.run(["g++", "-O2", "-std=c++17", os.path.join(HERE, "symbols_ginac.cpp"), "-o", ginac, "-lginac", "-lcln"], check=True)
    about()
    spaces = []
    with ThreadPoolExecutor(options.jobs) as pool:
        for name in SYMBOLS:
            n, path = constants(name)
            for kind, free in [("diagonal", []), ("blocks 3 x 3", blocks(n)), ("full", off_diagonal(n))]:
                if kind.startswith("blocks") and n == 3:
                    continue
                rows = matrix(n, free)
                ours = {tensor: pool.submit(cell, name, kind, rows, tensor) for tensor in tensors}
                text = ";".join(",".join(row) for row in rows)
                theirs = {label: pool.submit(peer, script, python, path, text, *more)
                          for label, (script, python, more) in peers.items()}
                spaces.append((name, kind, letters(rows), ours, theirs))
    times, sizes, agreed = [], [], 0
    for name, kind, names, ours, theirs in spaces:
        point_of = random.Random(1)
        point = {g: point_of.randrange(2, PRIME) for g in names}
        for tensor in tensors:
            mine = ours[tensor].result()
            expected = {at: value_at(v, point) for at, v in mine.values.items()}
            row_of_times, row_of_sizes, count = [], [], len(expected)
            for label, future in {"affinor": ours[tensor], **theirs}.items():
                done = future.result()
                if tensor not in done.reports:
                    row_of_times.append(done.why)
                    row_of_sizes.append("")
                    continue
                t, number = done.reports[tensor]
                row_of_times.append(t if done is mine else seconds(t))
                texts = {at: v for at, v in done.values.items() if at[0] == tensor}
                row_of_sizes.append(megabytes(sum(map(len, texts.values()))) if texts else "not printed")
                count = count or number
                # SymEngine does not know whether an expression is zero
                if count != number and label != "SymEngine":
                    sys.exit(f"{name} {kind} {tensor}: {label} has {number} components, not {count}")
                if expected and texts and done is not mine:
                    if {at: value_at(v, point) for at, v in texts.items()} != expected:
                        sys.exit(f"{name} {kind} {tensor}: {label} has other values")
                    agreed += 1
            times.append([name, f"{kind}, {len(names)}", tensor, *row_of_times])
            sizes.append([name, f"{kind}, {len(names)}", tensor, count or "", *row_of_sizes])
    print("CPU time from the metric to the tensor in lowest terms. affinor: connection and tensor, as a call; whole process. "
          "Peers: each row includes the rows above it\n")
    head("algebra", "metric, symbols", "tensor", "affinor", *peers)
    for cells in times:
        row(*cells)
    print("\nSize: the number of nonzero components (curvature: k < l), and of the characters of their values without spaces\n")
    head("algebra", "metric, symbols", "tensor", "components", "affinor", *peers)
    for cells in sizes:
        row(*cells)
    print(f"\nIn all {agreed} cells in which both a peer and affinor ended and printed, the nonzero components were the same, "
          "and each had the same value at a random point modulo 2^61 - 1.")

def chain(name, label, n, order, first, allowed):
    """Frees one place of the metric after the other until the curvature takes more than a minute."""
    table, rows = os.path.join(FOLDER, f"{name}-{label}.csv"), []
    for free in range(first, len(order) + 1):
        done = affinor(name, written(matrix(n, order[:free])), "curvature", "--threads", "1", path=table, limit=allowed)
        what = [done.why, megabytes(done.peak), "", ""]
        if not done.why:
            what = [seconds(done.cpu), megabytes(done.peak), len(components(table)), megabytes(os.path.getsize(table))]
        added = f", with {letter(*order[free - 1])}" if free > first else ""
        rows.append([name, label + added, n + free, *what])
        say(*rows[-1])
        if done.why or done.cpu > MINUTE:
            break
    return rows


def limits():
    about()
    chains = []
    for name in LIMITS:
        n, _ = constants(name)
        order = off_diagonal(n)
        inside = blocks(n)
        chains += [(name, "diagonal, then row by row", n, order, 0, MINUTE),
                   (name, "blocks 3 x 3, then row by row", n, inside + [at for at in order if at not in inside],
                    len(inside), MINUTE)]
    n, _ = constants("se3")
    chains.insert(0, ("se3", "full", n, off_diagonal(n), len(off_diagonal(n)), SECONDS))
    with ThreadPoolExecutor(options.jobs) as pool:
        found = list(pool.map(lambda one: chain(*one), chains))
    print("affinor, exact curvature, 1 thread: off-diagonal components become symbols one by one, until a run takes more "
          "than a minute. The first row has all of them, with a longer limit\n")
    head("algebra", "metric", "symbols", "process (CPU)", "peak memory", "nonzero R^i_jkl, k < l", "printed")
    for rows in found:
        for cells in rows:
            row(*cells)

def charts():
    tensors, python = ["affinities", "curvature", "ricci"], [options.python]
    peers = {"Maxima": ("charts_maxima.py", python), "SymPy": ("charts_sympy.py", python)}
    if options.sage:
        peers["SageManifolds"] = ("charts_sage.py", [options.sage])
    about()
    print("CPU time from the metric to the tensor, each component simplified. affinor: connection and tensor, as a call; whole process. "
          "Peers: each row includes the rows above it\n")
    head("chart", "tensor", "components", "affinor", *peers)
    agreed = 0
    for name, (coordinates, parameters, functions, rows) in chart_metrics.CHARTS.items():
        path = os.path.join(FOLDER, "chart.toml")
        with open(path, "w") as file:
            file.write(chart_metrics.definition(coordinates, parameters, functions, rows))
        theirs = {label: peer(*how, coordinates, ";".join(rows), parameters, functions) for label, how in peers.items()}
        names = chart_metrics.Names(coordinates, parameters, functions)
        for tensor in tensors:
            table = os.path.join(FOLDER, "chart.csv")
            done = affinor(path, None, tensor, "--threads", "1", path=table)
            expected = components(table) if not done.why else {}
            ours = done.why or called(path, "", tensor, done)
            cells = []
            for label, theirs_done in theirs.items():
                if tensor not in theirs_done.reports:
                    cells.append(theirs_done.why)
                    continue
                cells.append(seconds(theirs_done.reports[tensor][0]))
                found = {at: v for at, v in theirs_done.values.items() if at[0] == tensor}
                if expected and found:
                    at_all = found.keys() | expected.keys()
                    wrong = [at for at in at_all if not names.agree(found.get(at, "0"), expected.get(at, "0"))]
                    if wrong:
                        sys.exit(f"{name} {wrong[0]}: {label} has {found.get(wrong[0])}, affinor {expected.get(wrong[0])}")
                    agreed += 1
            row(name, tensor, len(expected) or "", ours, *cells)
    print(f"\nIn all {agreed} cells in which both a peer and affinor ended, the values agreed at a random point.")


def homogeneous():
    python = [options.python]
    peers = {"Maxima": ("homogeneous_maxima.py", python), "SymPy": ("homogeneous_python.py", python, "sympy")}
    if options.sage:
        peers["Sage, fraction field"] = ("homogeneous_python.py", [options.sage], "sage")
    about()
    print("CPU time from the structure constants and the metric to the curvature of Levi-Civita. affinor: as a call; whole process\n")
    head("space", "metric", "nonzero R^i_jkl, k < l", "affinor", *peers)
    for name, (algebra, tangent, isotropy, diagonal) in homogeneous_spaces.SPACES.items():
        path, table = (os.path.join(FOLDER, file) for file in ("space.toml", "space.csv"))
        with open(path, "w") as file:
            file.write(homogeneous_spaces.definition(algebra, tangent, isotropy, diagonal))
        done = affinor(path, None, "curvature", "--threads", "1", path=table)
        if done.why:
            sys.exit(f"{name}: {done.why}")
        expected = components(table)
        names = chart_metrics.Names("", ",".join(sorted(set(diagonal.split(",")))), "")
        listed = [",".join(map(str, part)) for part in (tangent, isotropy)]
        _, numbers_file = constants(algebra)
        cells = []
        for label, (script, program, *more) in peers.items():
            theirs = peer(script, program, numbers_file, *listed, diagonal, *more)
            cells.append(theirs.why or seconds(theirs.reports["curvature"][0]))
            for at in theirs.values.keys() | (expected.keys() if theirs.values else set()):
                if not names.agree(theirs.values.get(at, "0"), expected.get(at, "0")):
                    sys.exit(f"{name} {at}: {label} has {theirs.values.get(at)}, affinor {expected.get(at)}")
        row(name, f"diag({diagonal})", len(expected), called(path, "", "curvature", done), *cells)


def representations():
    python = [options.python]
    peers = {"LiE": ("representations_lie.py", python), "GAP": ("representations_gap.py", python)}
    if options.sage:
        peers["Sage"] = ("representations_sage.py", [options.sage])
    about()
    print("CPU time. affinor: the whole process, with starting and printing. LiE: the whole process without an empty one. "
          "GAP, Sage: the call\n")
    head("task", "components", "affinor", *peers)
    flags = {"product": "--tensor", "weights": "--weights", "restriction": "--branch"}
    for name, (cartan, operation, first, second) in representation_tasks.TASKS.items():
        given = {"product": [f"[{second}]"], "weights": [], "restriction": [f"extended {second}"]}[operation]
        command = [options.affinor, "rep", cartan, f"[{first}]", flags[operation], *given, "--format", "json"]
        runs = [run(command) for _ in range(5)]
        if runs[0].why or not runs[0].output:
            sys.exit(f"{name}: {runs[0].why or runs[0].errors}")
        found = json.loads(runs[0].output)
        listed = found["weights"] if operation == "weights" else found["result"]["components"]
        expected = {tuple(one["labels"]): int(one["multiplicity"]) for one in listed}
        cells = []
        for label, (script, program) in peers.items():
            if label == "GAP" and operation == "restriction":
                cells.append("-")
                continue
            theirs = peer(script, program, cartan, operation, first, second)
            cells.append(theirs.why or seconds(theirs.reports[operation][0]))
            found = {at: int(m) for (_, at), m in theirs.values.items()}
            # the nodes of a subalgebra may be numbered in another order
            same = found == expected or operation == "restriction" and sorted(found.values()) == sorted(expected.values())
            if found and not same:
                sys.exit(f"{name}: {label} differs in {found.items() ^ expected.items()}")
        row(name, len(expected), seconds(statistics.median(one.cpu for one in runs)), *cells)


try:
    {"numbers": numbers, "symbols": symbols, "limits": limits, "charts": charts, "homogeneous": homogeneous,
     "representations": representations}[options.table]()
finally:
    shutil.rmtree(FOLDER)
