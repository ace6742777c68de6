"""LiE: `tensor`, `dom_char` and `branch`. The time is that of the whole process, without an empty one.
Arguments: the type, the file of values, the operation, a weight, the second weight or a node."""
import re
import resource
import subprocess
import sys
from peer import report, values

cartan, path, operation, first, second = sys.argv[1:]
calls = {
    "product": f"tensor([{first}],[{second}],{cartan})",
    "weights": f"dom_char([{first}],{cartan})",
    "restriction": f"branch([{first}],D8,res_mat(D8,{cartan}),{cartan})",
}


def lie(program):
    """The output and the CPU seconds of LiE."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    output = subprocess.run(["lie"], text=True, input=f"maxobjects 2000000\n{program}\nquit\n", capture_output=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return output, sum(getattr(after, name) - getattr(before, name) for name in ("ru_utime", "ru_stime"))


_, empty = lie("1")
output, spent = lie(calls[operation])
rows = re.findall(r"(\d+)\s*X\s*\[([-\d,\s]*)\]", output)
if not rows:
    sys.exit(output)
report(operation, max(spent - empty, 0), len(rows))
values(path, operation, (([int(x) - 1 for x in labels.split(",")], m) for m, labels in rows))
