"""Elliptic functions and integrals in 30 digits, by mpmath 1.3 and quadrature.

    python3 tests/references/elliptic.py > tests/data/elliptic.txt

Inputs are exact doubles, written so that they read back; outputs have 22 digits. A line is a name and numbers:

    quarter k' K
    jacobi  k' u sn cn dn
    third   k' u n J        J = int_0^u sn^2/(1 + n sn^2), by quadrature
"""
from mpmath import mp, mpf, ellipk, ellipfun, quad, nstr

mp.dps = 30
def line(name, inputs, outputs):
    print(name, *[repr(x) for x in inputs], *[nstr(x, 22, min_fixed=0, max_fixed=0) if x else "0" for x in outputs])

for complement in (1.0, 1 - 1e-9, 0.9, 0.3, 1e-2, 1e-5, 1e-9):
    m = 1 - mpf(complement)**2
    K = ellipk(m)
    line("quarter", [complement], [K])
    for share in (1e-6, 0.2, 0.6, 0.95):
        u = float(share*K)
        line("jacobi", [complement, u], [ellipfun(f, u=mpf(u), m=m) for f in ("sn", "cn", "dn")])
        for n in (0.0, 0.3, 1.0):
            def rate(v):
                square = ellipfun("sn", u=v, m=m)**2
                return square/(1 + mpf(n)*square)
            line("third", [complement, u, n], [quad(rate, [0, mpf(u)/2, mpf(u)])])
