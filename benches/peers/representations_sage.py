"""Sage's `WeylCharacterRing`, as its users write it. The ring is made before; the time is that of the first call.
Arguments: the type, the file of values, the operation, a weight, the second weight or a node."""
import sys
import time
import sage.all__sagemath_combinat  # noqa: F401
from sage.combinat.root_system.weyl_characters import WeylCharacterRing
from peer import report, values

cartan, path, operation, first, second = sys.argv[1:]


def weight(text):
    return [int(label) for label in text.split(",")]


def work(made):
    one = made(*weight(first))
    if operation == "product":
        return one * made(*weight(second))
    if operation == "weights":
        return one.weight_multiplicities()
    target = WeylCharacterRing("D8", style="coroots")
    return one.branch(target, rule="extended")


made = WeylCharacterRing(cartan, style="coroots")
start = time.process_time()
found = work(made)
seconds = time.process_time() - start
if operation == "weights":
    coroots = made.simple_coroots()
    labels = {tuple(int(w.inner_product(c)) for c in coroots): m for w, m in found.items()}
    labels = {at: m for at, m in labels.items() if min(at) >= 0}
else:
    ambient = found.parent()
    coroots = ambient.simple_coroots()
    labels = {tuple(int(w.inner_product(c)) for c in coroots): m for w, m in found.monomial_coefficients().items()}
report(operation, seconds, len(labels))
values(path, operation, (([x - 1 for x in at], m) for at, m in labels.items()))
