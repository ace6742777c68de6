"""affinor beside GAP: structure theory of Lie algebras, task by task.

    cargo build --release -p affinor-cli; cargo bench -p affinor-benches --bench structure_calls --no-run
    python3 benches/peers/structure.py --affinor target/release/affinor --calls target/release/deps/structure_calls-* > structure.md

One run writes one Markdown table; progress goes to standard error. On Debian: apt-get install gap-core.

How it is measured
- GAP reads the same structure constants (`affinor table NAME --show structure --format json`) and measures itself: CPU
  seconds from the table in memory to the answer, without start and reading. A cell ends at --seconds (180).
- GAP's process: CPU seconds of the whole of `gap`, with start, reading and printing. It is the peer of our process.
- The call: seconds of the same task by the library, from the algebra in memory to the answer, the least of the repetitions
  of one second (benches/structure_calls.rs). It is the peer of GAP's call.
- The process: CPU seconds of the whole command, with start, reading, the check of the Jacobi identity, all else that the
  command computes, and printing. `affinor --version` takes 1 to 3 ms.
- GAP and the process once. A permuted table is an algebra whose basis vectors are permuted, with random signs and without
  names; a scrambled one is an algebra after random elementary changes of the basis, two for each basis vector.
- Where GAP prints an answer, it is compared with affinor's.
"""
import argparse
import json
import os
import random
import resource
import subprocess
import sys
import tempfile
import time
from fractions import Fraction

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../tests/references"))
from gap_table import READ

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("--affinor", default="target/release/affinor", help="the program")
arguments.add_argument("--calls", required=True, help="the program of benches/structure_calls.rs")
arguments.add_argument("--seconds", type=int, default=180, help="CPU limit of a cell of GAP [180]")
arguments.add_argument("--tasks", default="constants,Jacobi,Killing,centre,Levi,type",
                       help="the tasks by their first words [all]")
arguments.add_argument("--scrambled", default="F4,E6,E7,E8", help="the types of scrambled tables [F4,E6,E7,E8]")
options = arguments.parse_args()
TASKS = options.tasks.split(",")
FOLDER = tempfile.mkdtemp(prefix="structure")

MATRICES = """
unit := function(n, l) local m, x; m := NullMat(n, n, Rationals);
  for x in l do m[x[1]][x[2]] := x[3]; od; return m; end;;
so := n -> List(Combinations([1..n], 2), c -> unit(n, [[c[1], c[2], 1], [c[2], c[1], -1]]));;
sl := n -> Concatenation(List(Arrangements([1..n], 2), c -> unit(n, [[c[1], c[2], 1]])),
  List([1..n-1], i -> unit(n, [[i, i, 1], [i+1, i+1, -1]])));;
of := function(M) return StructureConstantsTable(Basis(LieAlgebra(Rationals, M, "basis"), List(M, LieObject))); end;;
"""


def say(*words):
    print(time.strftime("%H:%M:%S"), *words, file=sys.stderr, flush=True)


def used(command):
    """CPU seconds of a process, its output."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"{' '.join(command)}: {done.stderr}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def affinor(*words):
    return used([options.affinor, *words])


def gap(program, work):
    """CPU seconds of `work`, its answer in the variable `answer`, and CPU seconds of the process; None and why where GAP does not
    end."""
    # long numbers stay in one line
    text = "SizeScreen([100000, 24]);;\n" + program + f'start := Runtime();; {work}\nPrint("RESULT ", Runtime() - start, " ", answer, "\\n"); QUIT;\n'
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (options.seconds + 60, options.seconds + 60))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(["gap", "-q", "--quitonbreak", "-o", "8g"], input=text, capture_output=True, text=True,
                          preexec_fn=limit)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    process = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    found = [line.split(" ", 2)[1:] for line in done.stdout.splitlines() if line.startswith("RESULT")]
    if not found:
        return None, f"> {options.seconds} s" if done.returncode < 0 else "error", None
    seconds = int(found[0][0]) / 1000
    return (seconds, found[0][1], process) if seconds <= options.seconds else (None, f"> {options.seconds} s", None)


def constants(name):
    """The dimension and {(i, j): {k: value}}, i < j, indices from 0, as affinor has them."""
    _, text = affinor("table", name, "--show", "structure", "--format", "json")
    found, table = json.loads(text), {}
    for (k, i, j), value in found["tensors"]["structure"]["components"]:
        if i < j:
            table.setdefault((i - 1, j - 1), {})[k - 1] = Fraction(value)
    return found["algebra"]["dimension"], table


def scrambled(n, table, seed=1):
    """The table after elementary changes of the basis."""
    draw = random.Random(seed)
    basis = [[int(i == j) for j in range(n)] for i in range(n)]
    inverse = [row[:] for row in basis]
    for _ in range(2 * n if n < 200 else n):
        a, b, sign = draw.randrange(n), draw.randrange(n), draw.choice([1, -1])
        if a != b:
            basis[a] = [u + sign * v for u, v in zip(basis[a], basis[b])]
            for row in inverse:
                row[b] -= sign * row[a]
    sparse = [[(i, v) for i, v in enumerate(row) if v] for row in basis]
    inverse = [[(m, v) for m, v in enumerate(row) if v] for row in inverse]
    both = table | {(j, i): {k: -v for k, v in image.items()} for (i, j), image in table.items()}
    found = {}
    for a in range(n):
        for b in range(a + 1, n):
            image = {}
            for i, u in sparse[a]:
                for j, v in sparse[b]:
                    for k, c in both.get((i, j), {}).items():
                        for m, w in inverse[k]:
                            image[m] = image.get(m, 0) + u * v * c * w
            image = {k: v for k, v in image.items() if v}
            if image:
                found[a, b] = image
    return found


def permuted(n, table, seed=1):
    """The table of the basis in another order, with other signs."""
    draw = random.Random(seed)
    place = draw.sample(range(n), n)
    sign = [draw.choice([1, -1]) for _ in range(n)]
    found = {}
    for (i, j), image in table.items():
        factor = sign[i] * sign[j] * (1 if place[i] < place[j] else -1)
        found[min(place[i], place[j]), max(place[i], place[j])] = {place[k]: factor * sign[k] * v for k, v in image.items()}
    return found


def rows(table):
    return [[i + 1, j + 1, k + 1, str(v)] for (i, j), image in table.items() for k, v in image.items()]


def as_gap(n, table):
    entries = ",".join(f"[{i},{j},{k},{v}]" for i, j, k, v in rows(table))
    return READ + f"T := read({n}, [{entries}]);; L := LieAlgebraByStructureConstants(Rationals, T);;\n"


def as_file(n, table):
    path = os.path.join(FOLDER, "table.json")
    with open(path, "w") as file:
        json.dump({"name": "table", "dimension": n, "structure_constants": rows(table)}, file)
    return path


def seconds(t):
    if t >= 1:
        return f"{t:.0f} s" if t >= 100 else f"{t:.1f} s"
    return f"{1000 * t:.0f} ms" if t >= 0.01 else f"{1000 * t:.1f} ms" if t >= 0.001 else f"{1000 * t:.2f} ms"


def call(task, space, answer=None):
    """Seconds of a task by the library; its answer must be the expected one."""
    _, text = used([options.calls, task, space])
    found, answer_found = text.split(" ", 1)
    if answer is not None:
        equal(f"{task} of {space}", answer_found.strip(), answer)
    return float(found)


def ratio(theirs, answer, ours):
    if theirs is None:
        return "-" if answer == "error" else f"> {options.seconds / ours:.0f}"
    quotient = theirs / ours
    return f"{quotient:.0f}" if quotient >= 10 else f"{quotient:.1f}"


def row(task, work, theirs, own_call, process, command):
    t, answer, whole = theirs
    say(task, work, theirs, own_call, process)
    written = [answer if value is None else seconds(value) for value in (t, whole)]
    print(f"| {task} | `{work}` | {written[0]} | {seconds(own_call)} | {ratio(t, answer, own_call)} | "
          f"`{command}` | {written[1]} | {seconds(process)} | {ratio(whole, answer, process)} |", flush=True)


def equal(what, ours, theirs):
    if ours != theirs:
        sys.exit(f"{what}: affinor {ours}, GAP {theirs}")


load = " ".join(f"{x:.1f}" for x in os.getloadavg())
release = subprocess.run(["gap", "-q", "-c", 'Print(GAPInfo.Version, "\\n"); QUIT;'], capture_output=True, text=True)
print(f"{time.strftime('%Y-%m-%d')}; {os.cpu_count()} cores; load average at the start {load}; "
      f"GAP {release.stdout.strip()}; {affinor('--version')[1].strip()}.\n")
print("| task | GAP | the call: GAP | affinor | ratio | the process | GAP | affinor | ratio |\n"
      "|---|---|---:|---:|---:|---|---:|---:|---:|")

def names(task, all_names):
    return all_names if task in TASKS else []


for name in names("constants", ["G2", "F4", "E6", "E7", "E8", "D29"]):
    ours, _ = affinor("table", name, "--show", "structure", "--format", "csv")
    work = f'SimpleLieAlgebra("{name[0]}", {name[1:]}, Rationals)'
    row(f"constants of {name}", work, gap("", f"{work};; answer := 0;;"), call("constants", name), ours, f"table {name} --show structure")
for name in names("constants", ["so(20)", "sl(20)"]):
    ours, _ = affinor("table", name, "--show", "structure", "--format", "csv")
    theirs = gap(MATRICES, f"of({name});; answer := 0;;")
    row(f"constants of {name} from matrices", "StructureConstantsTable", theirs, call("constants", name), ours, f'table "{name}" --show structure')
for name in names("Jacobi", ["F4", "E6", "E7", "E8"]):
    program = as_gap(*constants(name))
    ours, _ = affinor("check", name)
    row(f"Jacobi identity of {name}", "TestJacobi", gap(program, "answer := TestJacobi(T);;"), call("Jacobi", name, "true"), ours,
        f"check {name}")
for name in names("Killing", ["F4", "E6", "E7", "E8"]):
    program = as_gap(*constants(name))
    ours, text = affinor("info", name, "--format", "json")
    theirs = gap(program, "answer := DeterminantMat(KillingMatrix(Basis(L)));;")
    if theirs[0] is not None:
        equal(f"determinant of {name}", json.loads(text)["killing"]["determinant"], theirs[1])
    row(f"Killing form of {name}, determinant", "DeterminantMat(KillingMatrix(..))", theirs,
        call("Killing", name, json.loads(text)["killing"]["determinant"]), ours, f"info {name}")
for name in names("centre", ["E7", "parabolic(E7,7)", "borel(E6)", "n(12)", "filiform(60)"]):
    ours, text = affinor("info", name, "--format", "json")
    theirs = gap(as_gap(*constants(name)), "answer := [Dimension(LieCentre(L)), List(LieDerivedSeries(L), Dimension), "
                 "Dimension(LieSolvableRadical(L))];;")
    if theirs[0] is not None:
        found = json.loads(text)
        equal(name, [found["centre"]["dimension"], found["derived_series"], found["radical"]["dimension"]],
              json.loads(theirs[1]))
    row(f"centre, derived series, radical of {name}", "LieCentre, ..", theirs, call("centre", name), ours, f'info "{name}"')
for name in names("Levi", ["parabolic(E7,7)", "parabolic(E7,1,3,6)"]):
    ours, text = affinor("info", name, "--format", "json")
    theirs = gap(as_gap(*constants(name)), "answer := Dimension(LeviMalcevDecomposition(L)[1]);;")
    if theirs[0] is not None:
        equal(name, json.loads(text)["levi"]["dimension"], int(theirs[1]))
    row(f"Levi subalgebra of {name}", "LeviMalcevDecomposition", theirs, call("Levi", name), ours, f'info "{name}"')
for kind, change, all_names in [("permuted", permuted, ["F4", "E6", "E7", "E8"]), ("scrambled", scrambled, options.scrambled.split(","))]:
    for name in names("type", all_names):
        n, table = constants(name)
        table = change(n, table)
        ours, text = affinor("info", as_file(n, table), "--format", "json")
        equal(f"{kind} {name}", json.loads(text)["dynkin_type"], name)
        theirs = gap(as_gap(n, table), "answer := SemiSimpleType(L);;")
        if theirs[0] is not None:
            equal(f"{kind} {name}", name, theirs[1])
        count = sum(map(len, table.values()))
        row(f"type of {kind} {name}, {count:,} constants", "SemiSimpleType", theirs, call("type", as_file(n, table), name), ours,
            "info FILE")
