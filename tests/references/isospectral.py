"""Isospectral flows in 30 digits, by Taylor series of the equations in components.

    python3 tests/references/isospectral.py > tests/data/isospectral.txt

toda: a_k' = a_k (b_(k+1) - b_k), b_k' = 2 (a_k^2 - a_(k-1)^2) in Flaschka's variables, compared here with QR of the
exponential. manakov: M' = [M, Omega]. zeitlin: by structure constants of spherical harmonics, whose matrices are made of
Wigner's 3j symbols (Racah's sum); no Laplacian of matrices. A line is a name and numbers, inputs as exact doubles:

    toda n t b[n] a[n-1] b(t)[n] a(t)[n-1]
    manakov n t A[n] M_ij[i<j] M_ij(t)[i<j]
    zeitlin N t w_lm[1<=l<N, -l<=m<=l] w_lm(t)
"""
import random
from math import factorial as f
from mpmath import mp, mpf, mpc, matrix, sqrt, pi, expm, qr
from taylor import ONE, states, written

mp.dps = 60
random.seed(1974)

def show(name, n, t, start, end):
    print(name, n, repr(float(t)), *[repr(float(x)) for x in start], *[written(x) for x in end])

# Toda

def toda(b, a, times):
    n = len(b)
    terms = []
    for k in range(n - 1):
        terms += [(n + k, n + k, k + 1, 1), (n + k, n + k, k, -1), (k, n + k, n + k, 2), (k + 1, n + k, n + k, -2)]
    for t, end in zip(times, states(terms, b + a, times)):
        L = matrix(n, n)
        for k in range(n): L[k, k] = mpf(b[k])
        for k in range(n - 1): L[k, k + 1] = L[k + 1, k] = mpf(a[k])
        mp.dps = 120
        Q, R = qr(expm(L*t))
        L = Q.T*L*Q # signs of R change those of a only
        mp.dps = 60
        for k in range(n): assert abs(L[k, k] - mpf(end[k])/ONE) < mpf(10)**-36, (n, t)
        for k in range(n - 1): assert abs(abs(L[k, k + 1]) - mpf(end[n + k])/ONE) < mpf(10)**-36, (n, t)
        show("toda", n, t, b + a, end)

toda([-.5, .25, .375], [.5, .75], [0.5, 2, 5, 10, 20])
toda([random.uniform(-1, 1) for _ in range(6)], [random.uniform(.2, .8) for _ in range(5)], [0.5, 2, 5, 10, 20])

# Manakov

def manakov(A, M, times):
    n = len(A)
    pairs = [(i, j) for i in range(n) for j in range(i + 1, n)]
    at = lambda i, j: (pairs.index((i, j)), 1) if i < j else (pairs.index((j, i)), -1)
    terms = []
    for i, j in pairs:
        for k in range(n):
            if k not in (i, j):
                (p, s), (q, r) = at(i, k), at(k, j)
                # M_ik Omega_kj - Omega_ik M_kj
                terms.append((pairs.index((i, j)), p, q, s*r*(1/mpf(A[k] + A[j]) - 1/mpf(A[i] + A[k]))))
    for t, end in zip(times, states(terms, M, times)): show("manakov", n, t, A + M, end)

manakov([1, 1.5, 2.5, 4], [.9, -.4, .7, 1.1, -.6, .3], [1, 5, 10, 20])
manakov([1, 2, 3, 4, 5], [1.2, -.5, .7, 2.1, -.9, .4, 1.6, .3, -1.1, .8], [1, 5, 10, 20])

# Zeitlin

def wigner(j2, l, m1, m, m2):
    """The symbol (j l j; m1 m m2) with j = j2/2, and m1, m2 doubled."""
    if m1 + 2*m + m2 != 0 or max(abs(m1), abs(m2)) > j2 or abs(m) > l or l > j2: return mpf(0)
    half = lambda x: f(x // 2)
    triangle = mpf(f(l)*f(j2 - l)*f(l))/f(j2 + l + 1)
    factor = half(j2 + m1)*half(j2 - m1)*half(j2 + m2)*half(j2 - m2)*f(l + m)*f(l - m)
    total = mpf(0)
    for k in range(l + 1):
        x = [k, l - k, (j2 - m1)//2 - k, l + m - k, (j2 + m1)//2 - l + k, k - m]
        if min(x) < 0: continue
        term = 1
        for v in x: term *= f(v)
        total += mpf((-1)**k)/term
    return (-1)**(((j2 - m2)//2 - l) % 2)*sqrt(triangle*factor)*total

def zeitlin(N, w, times):
    j2 = N - 1
    basis = [(l, m) for l in range(1, N) for m in range(-l, l + 1)]
    def T(l, m):
        """Row m1, column m2, from j down: (-1)^(j - m1) sqrt(2l + 1) (j l j; -m1 m m2)."""
        return matrix([[(-1)**a*sqrt(2*l + 1)*wigner(j2, l, 2*a - j2, m, j2 - 2*b) for b in range(N)] for a in range(N)])
    def real(l, m):
        if m == 0: return T(l, 0)
        K = T(l, abs(m))*(-1)**abs(m)
        return (K + K.H)/sqrt(2) if m > 0 else (K - K.H)*mpc(0, -1)/sqrt(2)
    Y = [real(l, m) for l, m in basis]
    dot = lambda A, B: sum(A[i, k]*B[k, i] for i in range(N) for k in range(N))
    for a in range(len(Y)):
        for b in range(len(Y)): assert abs(dot(Y[a], Y[b]) - (a == b)) < mpf(10)**-50
    hbar, scale = 2/sqrt(mpf(N*N - 1)), sqrt(N/(4*pi))
    # W = i scale sum w Y, P the same of -w/(l(l+1)): w' of [P, W]/hbar
    terms = []
    for a in range(len(Y)):
        l = basis[a][0]
        for b in range(len(Y)):
            C = Y[a]*Y[b] - Y[b]*Y[a]
            for c in range(len(Y)):
                value = dot(Y[c], C)*mpc(0, 1)*scale/hbar*(mpf(-1)/(l*(l + 1)))
                assert abs(value.imag) < mpf(10)**-50
                if abs(value.real) > mpf(10)**-50: terms.append((c, a, b, value.real))
    for t, end in zip(times, states(terms, w, times)): show("zeitlin", N, t, w, end)

for N in (3, 5):
    zeitlin(N, [round(random.uniform(-1, 1), 3) for _ in range(N*N - 1)], [1, 5, 10])
