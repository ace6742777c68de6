"""affinor beside other programs: curvature of Levi-Civita, by size (`numbers`) and by symbols (`symbols`), and
where symbols become too many (`limits`).

    python3 benches/peers/run.py numbers --affinor target/release/affinor > numbers.md
    python3 benches/peers/run.py symbols --affinor target/release/affinor > symbols.md
    python3 benches/peers/run.py limits  --affinor target/release/affinor > limits.md

Each is one run that writes one Markdown document; progress goes to standard error. What is not installed has a
column of dashes. The peers, on Debian:

    apt-get install maxima maxima-share gap-core
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
  `curvature`, the median of up to five runs; and the CPU time of the whole process, with starting, reading, the Jacobi
  identity and printing. With two threads the CPU time of both is counted, so the wall-clock time of these stages is
  given instead, the smallest of the runs.
- One thread each (OPENBLAS_NUM_THREADS=1) unless the column says otherwise.
- Results are compared: the number of nonzero components always; values as the caption says.

Beside this file: `peer.py`, what the Python ones share; `numbers_*.py` and `symbols_*.py`, one for each peer.
"""
import argparse
import csv
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

HERE = os.path.dirname(os.path.abspath(__file__))
NUMBERS = ["so3", "sl3", "so5", "G2", "so8", "F4", "E6", "so16", "E7", "E8"]
SMALL = 14  # the largest dimension whose values are compared
SYMBOLS = ["so3", "se3", "so4"]
PRIME = 2**61 - 1
MINUTE = 60

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("table", choices=["numbers", "symbols", "limits"])
arguments.add_argument("--affinor", default="target/release/affinor", help="the program")
arguments.add_argument("--python", default=sys.executable, help="Python with numpy, scipy, sympy")
arguments.add_argument("--sage", help="Python with passagemath")
arguments.add_argument("--geomstats", help="Python with geomstats")
arguments.add_argument("--seconds", type=float, help="CPU limit of a cell [60; limits: 300]")
arguments.add_argument("--memory", type=float, help="its memory limit, GB [8; symbols: 4]")
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
            if cpu > limit or time.time() - started > 10 * limit:
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
    """Runs a peer; what it reports, as {tensor: (seconds, count)}, and its values."""
    path = os.path.join(FOLDER, "values")
    open(path, "w").close()
    done = run([python, os.path.join(HERE, script), rest[0], path, *rest[1:]])
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
    return done


def seconds(t, least=0.0):
    if t < least:
        return f"< {1000 * least:.0f} ms"
    return f"{t:.0f} s" if t >= 100 else f"{t:.1f} s" if t >= 1 else f"{1000 * t:.3g} ms"


def part(t, whole):
    """A stage of a process: what is shorter than the arrival of a line is only bounded."""
    return seconds(t) if t >= 0.005 else "< " + seconds(min(0.005, whole))


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
    parts = [version([options.affinor, "--version"]), "Python " + version([python, "-c", "import platform as p; print(p.python_version())"]),
             "SymPy " + version([python, "-c", module("sympy")]), version(["maxima", "--version"])]
    if options.table == "numbers":
        parts += ["SciPy " + version([python, "-c", module("scipy")]),
                  "GAP " + version(["gap", "-q", "-c", 'Print(GAPInfo.Version, "\\n"); QUIT;'])]
        if options.sage:
            parts.append("SageManifolds in passagemath " + version([options.sage, "-c", module("passagemath-modules")]))
        if options.geomstats:
            parts.append("geomstats " + version([options.geomstats, "-c", module("geomstats")]))
    print("; ".join(parts) + ".\n", flush=True)


def numbers():
    peers = [("SciPy f64", "numbers_scipy.py", options.python, []), ("GAP", "numbers_gap.py", options.python, []),
             ("Maxima, loops", "numbers_maxima.py", options.python, ["plain"]),
             ("Maxima ctensor", "numbers_maxima.py", options.python, ["ctensor"]),
             ("SymPy", "numbers_sympy.py", options.python, []),
             ("SageManifolds", "numbers_sage.py", options.sage, []),
             ("geomstats f64", "numbers_geomstats.py", options.geomstats, [])]
    present = {"GAP": shutil.which("gap"), "Maxima, loops": shutil.which("maxima"), "Maxima ctensor": shutil.which("maxima")}
    about()
    stopped, agreed, same = {}, 0, {}
    ours, theirs = [], []
    for name in NUMBERS:
        n, path = constants(name)
        metric = f"diag({','.join(map(str, range(1, n + 1)))})"
        table = os.path.join(FOLDER, "curvature.csv")
        affinor(name, metric, "curvature", path=table)
        expected = components(table)
        cells = [name, n, f"{len(expected):,}"]
        exact = None
        for scalar in ("exact", "float"):
            for threads in ("1", "2"):
                runs, began = [], time.time()
                while len(runs) < 5 and (time.time() - began < 15 or len(runs) < 2):
                    runs.append(affinor(name, metric, "curvature", "--scalar", scalar, "--threads", threads))
                if threads == "1":
                    t = statistics.median(one.stages["connection"] + one.stages["curvature"] for one in runs)
                    whole = statistics.median(one.cpu for one in runs)
                    exact = exact or part(t, whole)
                    cells += [part(t, whole), seconds(whole)]
                else:
                    cells.append(seconds(min(one.wall("connection", "curvature") for one in runs), 0.002))
            affinor(name, metric, "curvature", "--scalar", scalar, path=table)
            if len(components(table)) != len(expected):
                sys.exit(f"{name}: affinor in {scalar} has another number of components")
        say(*cells)
        ours.append(cells)
        cells = [name, exact]
        for label, script, python, more in peers:
            if not python or not present.get(label, True) or (label.startswith("geomstats") and not name.startswith("so")):
                cells.append("-")
                continue
            if label in stopped:
                cells.append("")
                continue
            done = peer(script, python, path, *more)
            if done.why:
                stopped[label] = True
                cells.append(done.why)
            else:
                t, count = done.reports["curvature"]
                agreed += 1
                if count != len(expected):
                    sys.exit(f"{name}: {label} has {count} components, affinor {len(expected)}")
                if n <= SMALL:
                    close = done.values.keys() == expected.keys() and all(
                        abs(float(Fraction(v)) - float(Fraction(expected[at]))) < 1e-9 if "f64" in label
                        else Fraction(v) == Fraction(expected[at]) for at, v in done.values.items())
                    if not close:
                        sys.exit(f"{name}: {label} has other values")
                    same.setdefault(name, []).append(label)
                cells.append(seconds(t))
            say(name, label, cells[-1], f"process {done.cpu:.1f} s CPU, {done.peak / 1e6:.0f} MB")
        theirs.append(cells)
    print("affinor alone: connection and curvature (CPU; with two threads wall), and the whole process (CPU), which prints CSV\n")
    head("algebra", "dimension", "nonzero R^i_jkl, k < l", "exact, 1 thread", "process", "exact, 2 threads", "f64, 1 thread",
         "process", "f64, 2 threads")
    for cells in ours:
        row(*cells)
    print("\nConnection and curvature: affinor exact with 1 thread, and the peers (CPU)\n")
    head("algebra", "affinor", *(label for label, *_ in peers))
    for cells in theirs:
        row(*cells)
    print(f"\nThe number of nonzero components was the same in all {agreed} runs of a peer that ended. All values were the "
          "same (floats within 1e-9): " + "; ".join(f"{name}: {', '.join(labels)}" for name, labels in same.items()) + ".")


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


def symbols():
    peers = [("Maxima", "symbols_maxima.py", []), ("SymPy, field", "symbols_sympy.py", ["field"]),
             ("SymPy, cancel", "symbols_sympy.py", ["cancel"])]
    about()
    times, sizes, agreed = [], [], []
    point_of = random.Random(1)
    for name in SYMBOLS:
        n, path = constants(name)
        kinds = [("diagonal", []), ("blocks 3 x 3", blocks(n)), ("full", off_diagonal(n))]
        for kind, free in kinds:
            if kind.startswith("blocks") and n == 3:
                continue
            rows = matrix(n, free)
            point = {g: point_of.randrange(2, PRIME) for g in letters(rows)}
            cells, ours, bytes_of = {}, {}, {}
            for tensor in ("affinities", "curvature", "ricci"):
                table = os.path.join(FOLDER, "table.csv")
                done = affinor(name, written(rows), tensor, "--threads", "1", path=table)
                cells[tensor] = [done.why or f"{part(done.stages['connection'] + done.stages[tensor], done.cpu)}; {seconds(done.cpu)}"]
                if not done.why:
                    ours[tensor] = {at: v.replace(" ", "") for at, v in components(table).items()}
                    bytes_of[tensor] = [len(ours[tensor]), megabytes(sum(map(len, ours[tensor].values())))]
                say(name, kind, tensor, cells[tensor], f"{done.peak / 1e6:.0f} MB")
            expected = {at: value_at(v, point) for of in ours.values() for at, v in of.items()}
            for label, script, more in peers:
                done = peer(script, options.python, path, ";".join(",".join(row) for row in rows), *more)
                for tensor in cells:
                    if tensor not in done.reports:
                        cells[tensor].append(done.why or "failed")
                        bytes_of.get(tensor, []).append("")
                        continue
                    t, count = done.reports[tensor]
                    cells[tensor].append(seconds(t))
                    texts = {at: v for at, v in done.values.items() if at[0] == tensor}
                    bytes_of.setdefault(tensor, [count, ""]).append(megabytes(sum(map(len, texts.values()))) if texts else "?")
                    if tensor not in ours:
                        continue
                    if count != len(ours[tensor]):
                        sys.exit(f"{name} {kind} {tensor}: {label} has {count} components, affinor {len(ours[tensor])}")
                    if texts:
                        if any(value_at(v, point) != expected[at] for at, v in texts.items()):
                            sys.exit(f"{name} {kind} {tensor}: {label} has other values")
                        agreed.append((name, kind, tensor, label))
                say(name, kind, label, done.reports, done.why, f"{done.peak / 1e6:.0f} MB")
            for tensor in cells:
                times.append([name, f"{kind}, {len(point)}", tensor, *cells[tensor]])
                if tensor in bytes_of:
                    sizes.append([name, f"{kind}, {len(point)}", tensor, *bytes_of[tensor]])
    print("From the metric to the tensor in lowest terms. affinor: connection and tensor, whole process; peers: "
          "each row with those above it (all CPU)\n")
    head("algebra", "metric, symbols", "tensor", "affinor", *(label for label, *_ in peers))
    for cells in times:
        row(*cells)
    print("\nSize: nonzero components (curvature: k < l), and the characters of their values, without spaces\n")
    head("algebra", "metric, symbols", "tensor", "components", "affinor", *(label for label, *_ in peers))
    for cells in sizes:
        row(*cells)
    print(f"\nIn all {len(agreed)} cells of a peer in which it and affinor ended and printed, every component had the same "
          "value at a random point modulo 2^61 - 1.")


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
    for name in SYMBOLS[1:]:
        n, _ = constants(name)
        order = off_diagonal(n)
        inside = blocks(n)
        chains += [(name, "full", n, order, len(order), SECONDS),
                   (name, "diagonal, then row by row", n, order, 0, MINUTE),
                   (name, "blocks 3 x 3, then row by row", n, inside + [at for at in order if at not in inside],
                    len(inside), MINUTE)]
    # side by side, for CPU time hardly depends on it
    with ThreadPoolExecutor(3) as pool:
        found = list(pool.map(lambda one: chain(*one), chains))
    print("affinor, curvature, exact, 1 thread: off-diagonal components become free one by one, until a minute is passed; "
          "and all of them\n")
    head("algebra", "metric", "symbols", "process (CPU)", "peak memory", "nonzero R^i_jkl, k < l", "printed")
    for rows in found:
        for cells in rows:
            row(*cells)

try:
    {"numbers": numbers, "symbols": symbols, "limits": limits}[options.table]()
finally:
    shutil.rmtree(FOLDER)
