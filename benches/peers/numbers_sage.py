"""SageManifolds, exact: a frame with these structure coefficients, and Riemann of the connection that is
given to it. The affinities of Levi-Civita are handed over ready (their few operations are measured too):
asking the metric of SageManifolds for its connection is slower."""
import sys
import sage.all__sagemath_symbolics  # noqa: F401
import sage.all__sagemath_modules  # noqa: F401
import sage.manifolds.all  # noqa: F401
from sage.manifolds.manifold import Manifold
from sage.rings.rational_field import QQ
from sage.tensor.modules.comp import CompWithSym
from peer import both_orders, constants, measure, report, values

n, c = constants(sys.argv[1])
number = 0


def frame():
    global number
    number += 1
    manifold = Manifold(n, f"M{number}", start_index=1)
    chart = manifold.chart(names=tuple(f"x{i}" for i in manifold.irange()))
    moved = manifold.automorphism_field(name=f"a{number}")
    for i in manifold.irange():
        moved[i, i] = 1
    frame = chart.frame().new_frame(moved, f"e{number}")
    module = frame._fmodule
    structure = CompWithSym(module._ring, frame, 3, start_index=module._sindex,
                            output_formatter=module._output_formatter, antisym=(1, 2))
    for (i, j, k), v in c.items():
        structure[[i + 1, j + 1, k + 1]] = manifold.scalar_field(v)
    frame.structure_coeff.set_cache(structure)
    return manifold, frame


def curvature(prepared):
    manifold, frame = prepared
    affinities = {}
    for (i, j, k), v in both_orders(c).items():
        v = QQ(v) / 2
        for at, x in (((i, j, k), v), ((k, i, j), -v * (i + 1) / (k + 1)), ((j, k, i), v * (i + 1) / (j + 1))):
            affinities[at] = affinities.get(at, 0) + x
    nabla = manifold.affine_connection("nabla")
    coefficients = nabla.set_coef(frame)
    for (i, j, k), v in affinities.items():
        if v:
            coefficients[i + 1, k + 1, j + 1] = v  # theirs has the direction last
    return nabla.riemann().comp(frame)


seconds, r = measure(frame, curvature)
found = [([i - 1 for i in at], v.expr()) for at, v in r._comp.items()]
report("curvature", seconds, len(found))
values(sys.argv[2], "curvature", found)
