"""The bicycle of Meijaard, Papadopoulos, Ruina and Schwab, Proc. R. Soc. A 463 (2007) 1955-1982, upright at constant speed."""
import mpmath as mp
from gmpy2 import mpfr as Q

from mechanism.numbers import digits, text


BICYCLE = {
    "w": "1.02", "c": "0.08", "lambda": "pi/10", "g": "9.81", "rR": "0.3", "mR": "2", "IRxx": "0.0603", "IRyy": "0.12", "xB": "0.3", "zB": "-0.9", "mB": "85",
    "IBxx": "9.2", "IByy": "11", "IBzz": "2.8", "IBxz": "2.4", "xH": "0.9", "zH": "-0.7", "mH": "4", "IHxx": "0.05892", "IHyy": "0.06", "IHzz": "0.00708",
    "IHxz": "-0.00756", "rF": "0.35", "mF": "3", "IFxx": "0.1405", "IFyy": "0.28",
}


def bicycle_matrices():
    """M, C1, K0 and K2 of M q'' + v C1 q' + (g K0 + v^2 K2) q = 0 for lean and steer: appendix A of the paper."""
    p = type("Parameters", (), {key: mp.mpf(value) for key, value in BICYCLE.items() if key != "lambda"})
    sine, cosine = mp.sin(mp.pi / 10), mp.cos(mp.pi / 10)
    total = p.mR + p.mB + p.mH + p.mF
    x, z = (p.xB * p.mB + p.xH * p.mH + p.w * p.mF) / total, (-p.rR * p.mR + p.zB * p.mB + p.zH * p.mH - p.rF * p.mF) / total
    txx = p.IRxx + p.IBxx + p.IHxx + p.IFxx + p.mR * p.rR**2 + p.mB * p.zB**2 + p.mH * p.zH**2 + p.mF * p.rF**2
    txz = p.IBxz + p.IHxz - p.mB * p.xB * p.zB - p.mH * p.xH * p.zH + p.mF * p.w * p.rF
    tzz = p.IRxx + p.IBzz + p.IHzz + p.IFxx + p.mB * p.xB**2 + p.mH * p.xH**2 + p.mF * p.w**2  # the wheels are symmetric: Izz = Ixx
    ma = p.mH + p.mF  # A: the front assembly
    xa, za = (p.xH * p.mH + p.w * p.mF) / ma, (p.zH * p.mH - p.rF * p.mF) / ma
    axx = p.IHxx + p.IFxx + p.mH * (p.zH - za) ** 2 + p.mF * (p.rF + za) ** 2
    axz = p.IHxz - p.mH * (p.xH - xa) * (p.zH - za) + p.mF * (p.w - xa) * (p.rF + za)
    azz = p.IHzz + p.IFxx + p.mH * (p.xH - xa) ** 2 + p.mF * (p.w - xa) ** 2
    ua = (xa - p.w - p.c) * cosine - za * sine
    all_ = ma * ua**2 + axx * sine**2 + 2 * axz * sine * cosine + azz * cosine**2
    alx = -ma * ua * za + axx * sine + axz * cosine
    alz = ma * ua * xa + axz * sine + azz * cosine
    mu = p.c / p.w * cosine
    rear, front = p.IRyy / p.rR, p.IFyy / p.rF
    both, sa = rear + front, ma * ua + mu * total * x
    m = [[txx, alx + mu * txz], [alx + mu * txz, all_ + 2 * mu * alz + mu**2 * tzz]]
    k0 = [[total * z, -sa], [-sa, -sa * sine]]
    k2 = [[mp.mpf(0), (both - total * z) / p.w * cosine], [mp.mpf(0), (sa + front * sine) / p.w * cosine]]
    c1 = [[mp.mpf(0), mu * both + front * cosine + txz / p.w * cosine - mu * total * z],
          [-(mu * both + front * cosine), alz / p.w * cosine + mu * (sa + tzz / p.w * cosine)]]
    return m, c1, k0, k2


def bicycle():
    m, c1, k0, k2 = bicycle_matrices()
    for found, published in zip((m, c1, k0, k2), (
            ["80.81722", "2.31941332208709", "2.31941332208709", "0.29784188199686"], ["0", "33.86641391492494", "-0.85035641456978", "1.68540397397560"],
            ["-80.95", "-2.59951685249872", "-2.59951685249872", "-0.80329488458618"], ["0", "76.59734589573222", "0", "2.65431523794604"])):
        assert all(abs(a - mp.mpf(b)) < 1e-14 * max(1, abs(a)) for a, b in zip(sum(found, []), published)), published

    def polynomial(v):
        """Coefficients of det(M x^2 + v C1 x + g K0 + v^2 K2), from x^4 on."""
        entry = [[[m[i][j], v * c1[i][j], mp.mpf("9.81") * k0[i][j] + v**2 * k2[i][j]] for j in range(2)] for i in range(2)]
        product = lambda a, b: [mp.fsum(a[i] * b[k - i] for i in range(3) if 0 <= k - i < 3) for k in range(5)]
        return [a - b for a, b in zip(product(entry[0][0], entry[1][1]), product(entry[0][1], entry[1][0]))]

    def eigenvalues(v):
        inverse = mp.matrix(m) ** -1
        stiff, damp = inverse * (mp.mpf("9.81") * mp.matrix(k0) + v**2 * mp.matrix(k2)), inverse * (v * mp.matrix(c1))
        companion = mp.zeros(4)
        for i in range(2):
            companion[i, i + 2] = 1
            for j in range(2):
                companion[i + 2, j], companion[i + 2, j + 2] = -stiff[i, j], -damp[i, j]
        return mp.eig(companion, left=False, right=False)

    order = lambda values: sorted(([mp.re(x), mp.im(x) if abs(mp.im(x)) > 1e-25 else mp.mpf(0)] for x in values), key=lambda x: (round(x[0], 12), x[1]))
    states = []
    for v in range(11):
        one, two = order(mp.polyroots(polynomial(mp.mpf(v)), maxsteps=200, extraprec=400)), order(eigenvalues(mp.mpf(v)))
        states.append({"speed": str(v), "eigenvalues": text(one), "digits": digits([[Q(str(x)) for x in z] for z in one], [[Q(str(x)) for x in z] for z in two])})
    # The published bounds of stable speeds: weave, with a pair on the imaginary axis, and capsize, with an eigenvalue 0.
    assert min(abs(mp.re(x)) for x in mp.polyroots(polynomial(mp.mpf("4.29238253634111")), maxsteps=200, extraprec=400)) < 1e-13
    assert min(abs(x) for x in mp.polyroots(polynomial(mp.mpf("6.02426201538837")), maxsteps=200, extraprec=400)) < 1e-13
    return {"parameters": BICYCLE, "matrices": {key: text(value) for key, value in zip(("M", "C1", "K0", "K2"), (m, c1, k0, k2))}, "speeds": states}
