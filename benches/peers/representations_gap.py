"""GAP: `DecomposeTensorProduct` and `DominantCharacter` of a simple Lie algebra; the algebra is made before.
Arguments: the type, the file of values, the operation, a weight, the second weight."""
import re
import subprocess
import sys
from peer import values

cartan, path, operation, first, second = sys.argv[1:]
calls = {
    "product": f"DecomposeTensorProduct(L, [{first}], [{second}])",
    "weights": f"DominantCharacter(L, [{first}])",
}
if operation not in calls:
    sys.exit("GAP has no restrictions of representations")
program = f"""
L := SimpleLieAlgebra("{cartan[0]}", {cartan[1:]}, Rationals);; RootSystem(L);;
spent := 0;; runs := 0;;
while spent < 1000 and runs < 100 do
  start := Runtime(); found := {calls[operation]}; spent := spent + Runtime() - start; runs := runs + 1;
od;
Print("RESULT {operation} ", Float(spent)/1000/runs, " ", Length(found[1]), "\\n");
for k in [1..Length(found[1])] do Print("W ", found[1][k], " = ", found[2][k], ";\\n"); od;
QUIT;
"""
done = subprocess.run(["gap", "-q", "--quitonbreak", "-o", "8g"], text=True, input=program, capture_output=True)
text = re.sub(r"\\\n|\n(?=[^WR])", "", done.stdout)
for line in text.splitlines():
    if line.startswith("RESULT"):
        print(line)
rows = re.findall(r"W \[([^\]]*)\] = (\d+);", text)
values(path, operation, (([int(x) - 1 for x in labels.split(",")], m) for labels, m in rows))
sys.exit(done.returncode)
