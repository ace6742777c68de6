"""Invariants of Lie algebras by GAP, for tests/data/structure/gap.json.

    python3 tests/references/structure_gap.py target/release/affinor > tests/data/structure/gap.json

The algebras are those of tests/data/structure/invariants.json, from the brackets stored there, and more of the
catalogue, from the brackets that `affinor table NAME --show structure` prints. The invariants do not depend on a basis.
Needs GAP: apt-get install gap-core. `null`: GAP gave no answer.
"""
import json
import os
import subprocess
import sys

from gap_table import READ

MORE = [
    "se(2)", "sim(2)", "sim(3)", "galilei(2)", "t(2)", "t(3)", "t(4)", "n(3)", "n(4)", "n(5)", "n(6)", "borel(A2)",
    "borel(B2)", "borel(G2)", "borel(A3)", "parabolic(A3,1)", "parabolic(A3,2)", "parabolic(B3,1)", "parabolic(C3,3)",
    "parabolic(G2,1)", "parabolic(G2,2)", "heisenberg(7)", "heisenberg(9)", "filiform(7)", "filiform(8)",
    "filiform(10)", "free_nilpotent(2,3)", "free_nilpotent(2,4)", "free_nilpotent(2,5)", "free_nilpotent(3,2)",
    "free_nilpotent(3,3)", "so(5)", "su(4)", "su(3,1)", "sp(4)", "G2", "sl(4)", "so(6)", "u(2)", "u(3)", "aff(2)",
    "aff(3)", "schroedinger(1)", "schroedinger(2)", "so(3,C)", "sl(2,C)", "sl(3,C)", "sl(2)+R^2",
    "so(4)+heisenberg(3)", "gl(3)", "se_2(3)", "sp(2,C)", "iso(2,2)", "sl(2)+bianchi(V)",
]
KEYS = ["derived_series", "lower_central_series", "upper_central_series", "radical", "nilradical", "centre",
        "killing_rank", "derivations", "cartan_subalgebra", "indecomposable_over_Q", "levi_type"]
PROGRAM = READ + r"""
BreakOnError := false;;
say := function(words...) CallFuncList(Print, Concatenation(["@@"], words, ["\n"])); end;;
SizeScreen([4096, 100]);;
L := 0;; levi := 0;;
begin := function(n, rows) L := LieAlgebraByStructureConstants(Rationals, read(n, rows)); end;;
"""
# each a statement of its own, so that an error of one leaves the others
STATEMENTS = """
say("derived_series ", List(LieDerivedSeries(L), Dimension));
say("lower_central_series ", List(LieLowerCentralSeries(L), Dimension));
say("upper_central_series ", Reversed(List(LieUpperCentralSeries(L), Dimension)));
say("radical ", Dimension(LieSolvableRadical(L)));
say("nilradical ", Dimension(LieNilRadical(L)));
say("centre ", Dimension(LieCentre(L)));
say("killing_rank ", RankMat(KillingMatrix(Basis(L))));
say("derivations ", Dimension(Derivations(Basis(L))));
say("cartan_subalgebra ", Dimension(CartanSubalgebra(L)));
parts := List(DirectSumDecomposition(L), Dimension);; Sort(parts);; say("indecomposable_over_Q ", parts);
levi := LeviMalcevDecomposition(L)[1];;
if Dimension(levi) > 0 then say("levi_type \\"", SemiSimpleType(levi), "\\""); else say("levi_type \\"\\""); fi;
"""


def of_catalogue(name):
    command = [sys.argv[1], "table", name, "--show", "structure", "--format", "json"]
    found = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    rows = [(j, k, i, value) for (i, j, k), value in found["tensors"]["structure"]["components"] if j < k]
    return found["algebra"]["dimension"], rows


path = os.path.join(os.path.dirname(__file__), "../data/structure/invariants.json")
algebras = [(one["name"], "invariants.json", one["dimension"], one["structure_constants"])
            for one in json.load(open(path))["algebras"]]
algebras += [(name, "catalogue", *of_catalogue(name)) for name in MORE]
program = PROGRAM
for at, (_, _, n, rows) in enumerate(algebras):
    entries = ",".join(f"[{i},{j},{k},{v}]" for i, j, k, v in rows)
    program += f"begin({n}, [{entries}]);\nsay(\"algebra {at}\");{STATEMENTS}"
program += 'say("version \\"", GAPInfo.Version, "\\"");\nQUIT;\n'
done = subprocess.run(["gap", "-q", "-o", "4g"], input=program, capture_output=True, text=True)
found, version = [], None
for line in done.stdout.splitlines():
    if "@@" not in line:
        continue
    key, value = line.split("@@")[1].split(" ", 1)
    if key == "algebra":
        name, source, n, _ = algebras[int(value)]
        found.append({"name": name, "from": source, "dimension": n} | dict.fromkeys(KEYS))
    elif key == "version":
        version = json.loads(value)
    else:
        found[-1][key] = json.loads(value)
for one in found:
    # GAP writes factors with blanks between them; C2 is B2
    if one["levi_type"] is not None:
        factors = sorted(one["levi_type"].replace("C2", "B2").split(), key=lambda t: (t[0], int(t[1:])))
        one["levi_type"] = " + ".join(factors) or "none"
lines = ",\n".join(json.dumps(one, separators=(",", ":")) for one in found)
print(f'{{"made_by":"tests/references/structure_gap.py","gap":"{version}","algebras":[\n{lines}\n]}}')
