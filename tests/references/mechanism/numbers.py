"""Numbers, vectors and agreement of two computations, for the references of mechanisms."""
import gmpy2
import mpmath as mp
from gmpy2 import mpfr as Q

from initial_value import DIGITS  # which sets the precision, before the first number is made

mp.mp.dps = DIGITS
G = Q("9.81")
PI = gmpy2.const_pi()
assert G.precision == PI.precision == 140


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plus(*vectors):
    first, *others = vectors
    for v in others:
        first = [first[0] + v[0], first[1] + v[1], first[2] + v[2]]
    return first


def times(s, a):
    return [s * a[0], s * a[1], s * a[2]]


def text(x):
    if isinstance(x, (list, tuple)):
        return [text(v) for v in x]
    return mp.nstr(mp.chop(mp.mpf(str(x)), mp.mpf(10) ** -32), 25, min_fixed=-4, max_fixed=12)


def flat(x):
    return [v for part in x for v in flat(part)] if isinstance(x, (list, tuple)) else [x]


def digits(one, two, least=14):
    """The digits that two computations agree in, relative to the largest number of the state; at most 25."""
    size = max(abs(v) for v in flat(one))
    off = max(abs(a - b) for a, b in zip(flat(one), flat(two)))
    count = 25 if off == 0 else min(25, int(-gmpy2.log10(off / size)))
    assert count >= least, (count, text(one), text(two))
    return count


def near(found, published, tolerance):
    for a, b in zip(flat(found), flat(published)):
        assert abs(a - Q(b)) <= tolerance * max(1, abs(a)), (text(a), b)


def solved(matrix, right):
    """Gaussian elimination with partial pivots; several right sides."""
    rows = [list(a) + list(b) for a, b in zip(matrix, right)]
    n = len(rows)
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[p] = rows[p], rows[k]
        pivot = rows[k]
        for i in range(k + 1, n):
            if rows[i][k]:
                factor = rows[i][k] / pivot[k]
                rows[i] = [x - factor * y if y else x for x, y in zip(rows[i], pivot)]
    for k in reversed(range(n)):
        for j in range(n, len(rows[k])):
            rows[k][j] = (rows[k][j] - sum(rows[k][i] * rows[i][j] for i in range(k + 1, n))) / rows[k][k]
    return [row[n:] for row in rows]
