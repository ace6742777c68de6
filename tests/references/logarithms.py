"""Products and logarithms of groups of matrices in 60 digits.

    python3 tests/references/logarithms.py > tests/data/logarithms.txt        (mpmath 1.3)

Inputs are exact doubles, written so that they read back; results have 20 digits. A line is a group, a name and numbers:

    product x[n] y[n] z[n]    exp(z) = exp(x) exp(y), z the principal logarithm
    log g[m m] x[n]           the nearest doubles to the entries of exp(x), row by row; x is exact

Bases are those of `affinor list`. Logarithms are of square roots near 1, by the series of 2 artanh((A - 1)/(A + 1)).
"""
import random
from mpmath import mp, mpf, expm, eye, inverse, lu_solve, matrix, mnorm, nstr

mp.dps = 60
random.seed(20261126)


def unit(n, *entries):
    m = matrix(n, n)
    for i, j, value in entries:
        m[i, j] += value
    return m


def orthogonal(p, q, size):
    n, eta = p + q, [1] * p + [-1] * q
    pairs = [(i, j) for i in range(n) for j in range(i + 1, n)]
    # the last pair first
    for i, j in reversed(pairs):
        sign = (-1) ** (i + j)
        yield unit(size, (i, j, sign), (j, i, -sign * eta[i] * eta[j]))


def symplectic(n):
    pairs = [(i, j) for i in range(n) for j in range(i, n)]
    for i in range(n):
        for j in range(n):
            yield unit(2 * n, (i, j, 1), (n + j, n + i, -1))
    upper = [((i, n + j), (j, n + i)) for i, j in pairs]
    for a, b in upper:
        yield unit(2 * n, *{(*a, 1), (*b, 1)})
    for a, b in upper:
        yield unit(2 * n, *{(a[1], a[0], 1), (b[1], b[0], 1)})


def special(n):
    pairs = [(i, j) for i in range(n) for j in range(i + 1, n)]
    yield from (unit(n, (i, j, 1)) for i, j in pairs)
    yield from (unit(n, (j, i, 1)) for i, j in pairs)
    yield from (unit(n, (k, k, 1), (k + 1, k + 1, -1)) for k in range(n - 1))


GROUPS = {
    "so(2,1)": list(orthogonal(2, 1, 3)),
    "so(3,1)": list(orthogonal(3, 1, 4)),
    "so(2,2)": list(orthogonal(2, 2, 4)),
    "so(4)": list(orthogonal(4, 0, 4)),
    "so(5)": list(orthogonal(5, 0, 5)),
    "iso(2,1)": [*orthogonal(2, 1, 4), *(unit(4, (i, 3, 1)) for i in range(3))],
    "iso(3,1)": [*orthogonal(3, 1, 5), *(unit(5, (i, 4, 1)) for i in range(4))],
    "sp(2)": list(symplectic(1)),
    "sp(4)": list(symplectic(2)),
    "sl(3)": list(special(3)),
    "gl(2)": [unit(2, (i, j, 1)) for i in range(2) for j in range(2)],
    "gl(3)": [unit(3, (i, j, 1)) for i in range(3) for j in range(3)],
    "t(3)": [unit(3, (i, j, 1)) for i in range(3) for j in range(i, 3)],
    "n(4)": [unit(4, (i, j, 1)) for i in range(4) for j in range(i + 1, 4)],
}


def combination(basis, x):
    total = basis[0] * 0
    for b, value in zip(basis, x):
        total += b * value
    return total


def entries(m):
    return [m[i, j] for i in range(m.rows) for j in range(m.cols)]


def coordinates(basis, m):
    dot = lambda a, b: sum(p * q for p, q in zip(entries(a), entries(b)) if p)
    gram = matrix([[dot(a, b) for b in basis] for a in basis])
    return list(lu_solve(gram, matrix([dot(b, m) for b in basis])))


def logarithm(a):
    """The principal logarithm, None if the square roots do not converge."""
    n, roots = a.rows, 0
    one = eye(n)
    while mnorm(a - one, 1) > mpf(2) ** -6:
        m, x = a.copy(), a.copy()
        for _ in range(40):
            try:
                back = inverse(m)
            except ZeroDivisionError:
                return None
            x, m = x * (one + back) / 2, (one + (m + back) / 2) / 2
            if mnorm(m - one, 1) < mpf(10) ** (8 - mp.dps):
                break
        else:
            return None
        a, roots = x, roots + 1
    w = (a - one) * inverse(a + one)
    term, total, k = w, w, 1
    while mnorm(term, 1) > mpf(10) ** -(mp.dps + 5):
        term, k = term * w * w, k + 2
        total += term / k
    return total * mpf(2) ** (roots + 1)


def vector(n, size):
    return [random.gauss(0, 1) * size / n**0.5 for _ in range(n)]


def pairs(n):
    """Vectors of products: of all sizes, nearly opposite, along an axis back and forth, near a half turn."""
    for size in [10 ** random.uniform(-8, -3), 0.3, 1.5, 5, 10]:
        yield vector(n, size), vector(n, size)
    for size in [0.3, 4]:
        x = vector(n, size)
        yield x, [b - a for a, b in zip(x, vector(n, 10 ** random.uniform(-8, -1)))]
    x, y, axis = vector(n, 0.1), vector(n, 0.1), random.randrange(n)
    x[axis] += 8
    y[axis] -= 7.5
    yield x, y
    x, y, axis = [0.0] * n, [0.0] * n, random.randrange(n)
    x[axis], y[axis] = 1.25, 1.8915
    y[random.randrange(n)] += 1e-3
    yield x, y


def write(name, kind, exact, result):
    print(name, kind, *(repr(float(value)) for value in exact), *(nstr(value, 20) for value in result))


for name, basis in GROUPS.items():
    n = len(basis)
    for x, y in pairs(n):
        product = expm(combination(basis, map(mpf, x))) * expm(combination(basis, map(mpf, y)))
        log = logarithm(product)
        if log is None:
            continue
        z = coordinates(basis, log)
        if mnorm(combination(basis, z) - log, 1) < mpf(10) ** -30:
            write(name, "product", x + y, z)
    for size in [1e-3, 0.3, 1.5, 5, 8]:
        x = vector(n, size)
        exact = combination(basis, map(mpf, x))
        log = logarithm(expm(exact))
        if log is not None and mnorm(log - exact, 1) < mpf(10) ** -30:
            write(name, "log", entries(expm(exact)), map(mpf, x))
