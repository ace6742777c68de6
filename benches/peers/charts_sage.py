"""SageManifolds, metrics over charts: `metric`, `connection`, `riemann` and `ricci` with the simplifications of SageManifolds.
Arguments as in charts_maxima.py."""
import sys
import time
import sage.all__sagemath_symbolics  # noqa: F401
import sage.all__sagemath_modules  # noqa: F401
import sage.manifolds.all  # noqa: F401
from sage.calculus.var import function, var
from sage.manifolds.manifold import Manifold
from sage.symbolic.ring import SR
from chart_metrics import entries
from peer import report, values

names = sys.argv[1].split(",")
manifold = Manifold(len(names), "M")
chart = manifold.chart(" ".join(names))
letters = {name: x for name, x in zip(names, chart[:])}
letters |= {name: var(name, domain="real") for name in sys.argv[4].split(",") if name}
letters |= {name.split("(")[0]: function(name.split("(")[0]) for name in sys.argv[5].split(";") if name}
from sage.functions.all import cos, cot, exp, sin, sqrt, tan  # noqa: E402
letters |= {"sin": sin, "cos": cos, "tan": tan, "cot": cot, "exp": exp, "sqrt": sqrt}
rows = [[SR(eval(text.replace("^", "**"), {}, letters)) for text in entries(row)] for row in sys.argv[3].split(";")]
spent = 0


def stage(work):
    global spent
    start = time.process_time()
    result = work()
    spent += time.process_time() - start
    return result


def written(value):
    """Derivatives of free functions as `a_t_t(t)`."""
    from sage.symbolic.operators import FDerivativeOperator
    if not value.operands():
        return str(value)
    head, operands = value.operator(), [written(one) for one in value.operands()]
    if isinstance(head, FDerivativeOperator):
        by = "_".join(str(value.operands()[at]) for at in head.parameter_set())
        return f"{head.function().name()}_{by}({','.join(operands)})"
    if hasattr(head, "name") and callable(head) and str(head.name()).isidentifier():
        return f"{head.name()}({','.join(operands)})"
    sign = {"add_vararg": "+", "mul_vararg": "*", "pow": "**"}.get(getattr(head, "__name__", ""))
    return "(" + (sign.join(f"({one})" for one in operands) if sign else str(value)) + ")"


def told(name, tensor):
    """Reports the nonzero components; the curvature with k < l."""
    rank = {"affinities": 3, "curvature": 4, "ricci": 2}[name]
    indices = (at for at in manifold.index_generator(rank) if name != "curvature" or at[2] < at[3])
    found = [(at, tensor[at].expr()) for at in indices]
    found = [(at, value) for at, value in found if not value.is_trivial_zero()]
    report(name, spent, len(found))
    values(sys.argv[2], name, ((at, written(value)) for at, value in found))


def connection():
    metric = manifold.metric("g")
    for i, row in enumerate(rows):
        for j, value in enumerate(row[i:], i):
            metric[i, j] = value
    nabla = metric.connection()
    nabla.coef()
    return metric, nabla


def computed(tensor):
    tensor.comp()
    return tensor


metric, nabla = stage(connection)
told("affinities", nabla.coef())
told("curvature", stage(lambda: computed(nabla.riemann())))
told("ricci", stage(lambda: computed(nabla.ricci())))
