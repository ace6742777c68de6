"""Quadratic equations x_i' = sum c x_j x_k by Taylor series, for the references beside this file.

Fixed point of 240 bits, order 50; a step is as long as its last two terms stay below 1e-50.
"""
from fractions import Fraction

BITS, ORDER = 240, 50
ONE = 1 << BITS
SMALL = 1e-50

def fixed(x):
    """Of a float or fraction, exactly; of mpmath's numbers to their digits."""
    if hasattr(x, "man_exp"):
        man, exp = x.man_exp
        man = int(man) # unsigned in some versions, with the sign apart
        man = -abs(man) if x < 0 else abs(man)
        return man << (exp + BITS) if exp + BITS >= 0 else man >> -(exp + BITS)
    return int(Fraction(x) * ONE)

def states(terms, x, times):
    """The states at ascending times, in fixed point; terms are (i, j, k, c)."""
    terms = [(i, j, k, fixed(c)) for i, j, k, c in terms]
    x, t, found = [fixed(v) for v in x], 0, []
    for end in times:
        end = fixed(end)
        while t < end:
            series = [x]
            for n in range(ORDER):
                rate = [0]*len(x)
                products = {}
                for i, j, k, c in terms:
                    if (j, k) not in products:
                        products[j, k] = sum(series[m][j]*series[n - m][k] for m in range(n + 1)) >> BITS
                    rate[i] += c*products[j, k]
                series.append([r // (ONE*(n + 1)) for r in rate])
            bound = lambda n: (SMALL*ONE/max(1, max(abs(v) for v in series[n])))**(1/n)
            h = min(end - t, fixed(min(bound(ORDER - 1), bound(ORDER))))
            value = [0]*len(x)
            for c in reversed(series):
                value = [(v*h >> BITS) + c for v, c in zip(value, c)]
            x, t = value, t + h
        found.append(x)
    return found

def written(x, digits=30):
    """A number in fixed point, with its digits after the point."""
    sign, x = ("-", -x) if x < 0 else ("", x)
    x = (x*10**digits + ONE//2) >> BITS
    return f"{sign}{x//10**digits}.{x % 10**digits:0{digits}d}"
