"""Components of tensors on charts at points close to and far from the special values of their functions, by mpmath.

    python3 tests/references/programs.py > tests/data/programs.json

The metric of each chart is evaluated on jets of second order with at least 100 digits; affinities and curvature follow by
their definitions. A component that does not vanish identically has at each point a text "value size": 17 digits, and the
sum of |x dF/dx| over all arguments x and |F|, which is |F| times the condition number. The text is `-` where the value
does not fit a double, and empty where it is singular. Arguments are exact doubles: coordinates, parameters, and the values of free
functions and of their derivatives.
"""
import itertools
import json
import sys

from mpmath import mp, mpf

H = mpf(10) ** -50  # relative step of the condition number
STD = [1e-12, 1e-8, 1e-4, 0.1, 1.0, 20.0, 100.0, 300.0, 700.0]
BOTH = STD + [-x for x in STD]
NEAR = [s * d for d in (1e-12, 1e-8, 1e-3) for s in (1, -1)]
PI = 3.141592653589793


class Jet:
    """A value with its first and second derivatives by the coordinates."""

    def __init__(self, v, g, h):
        self.v, self.g, self.h = v, g, h

    def chain(self, f, f1, f2):
        n = range(len(self.g))
        g = [f1 * x for x in self.g]
        return Jet(f, g, [[f1 * self.h[i][j] + f2 * self.g[i] * self.g[j] for j in n] for i in n])

    def constant(self, c):
        n = len(self.g)
        return c if isinstance(c, Jet) else Jet(mpf(c), [mpf(0)] * n, [[mpf(0)] * n for _ in range(n)])

    def __add__(self, o):
        o, n = self.constant(o), range(len(self.g))
        return Jet(self.v + o.v, [self.g[i] + o.g[i] for i in n],
                   [[self.h[i][j] + o.h[i][j] for j in n] for i in n])

    def __mul__(self, o):
        o, n = self.constant(o), range(len(self.g))
        return Jet(self.v * o.v, [self.v * o.g[i] + o.v * self.g[i] for i in n],
                   [[self.v * o.h[i][j] + o.v * self.h[i][j] + self.g[i] * o.g[j] + self.g[j] * o.g[i]
                     for j in n] for i in n])

    def __neg__(self):
        return self * -1

    def __sub__(self, o):
        return self + self.constant(o) * -1

    def __rsub__(self, o):
        return self.constant(o) + self * -1

    def __truediv__(self, o):
        return self * self.constant(o) ** -1

    def __rtruediv__(self, o):
        return self.constant(o) * self ** -1

    def __pow__(self, e):
        if isinstance(e, Jet):
            return exp(log(self) * e)
        if e == 2:
            return self * self
        e = mpf(e.p) / e.q if isinstance(e, Exponent) else mpf(e)
        p = self.v ** (e - 2)
        return self.chain(p * self.v ** 2, e * p * self.v, e * (e - 1) * p)

    __radd__, __rmul__ = __add__, __mul__


class Exponent:
    def __init__(self, p, q):
        self.p, self.q = p, q


def sin(x): s, c = mp.sin(x.v), mp.cos(x.v); return x.chain(s, c, -s)
def cos(x): s, c = mp.sin(x.v), mp.cos(x.v); return x.chain(c, -s, -c)
def sinh(x): s, c = mp.sinh(x.v), mp.cosh(x.v); return x.chain(s, c, s)
def cosh(x): s, c = mp.sinh(x.v), mp.cosh(x.v); return x.chain(c, s, c)
def exp(x): e = mp.exp(x.v); return x.chain(e, e, e)
def log(x): return x.chain(mp.log(x.v), 1 / x.v, -1 / x.v ** 2)
def tan(x): return sin(x) / cos(x)
def tanh(x): return sinh(x) / cosh(x)
def sqrt(x): return x ** Exponent(1, 2)


FUNCTIONS = dict(sin=sin, cos=cos, sinh=sinh, cosh=cosh, exp=exp, log=log, tan=tan, tanh=tanh, sqrt=sqrt)


def inverse(a):
    n = len(a)
    rows = [list(a[i]) + [mpf(i == j) for j in range(n)] for i in range(n)]
    for c in range(n):
        p = max(range(c, n), key=lambda r: abs(rows[r][c]))
        rows[c], rows[p] = rows[p], rows[c]
        inv = 1 / rows[c][c]
        rows[c] = [x * inv for x in rows[c]]
        for r in range(n):
            if r != c and rows[r][c] != 0:
                f = rows[r][c]
                rows[r] = [x - f * y for x, y in zip(rows[r], rows[c])]
    return [row[n:] for row in rows]


class Chart:
    def __init__(self, name, coordinates, metric, points, parameters=(), functions=None, positive=()):
        self.name, self.coordinates, self.metric = name, coordinates.split(), metric
        self.parameters, self.positive = list(parameters), list(positive)
        self.functions = functions or {}  # head -> names of the value, the derivative, the second derivative
        inputs = [name for names in self.functions.values() for name in names]
        self.arguments = self.coordinates + self.parameters + inputs
        self.points = points
        text = metric.replace("^(1/3)", "**Exponent(1,3)").replace("^(2/3)", "**Exponent(2,3)")
        text = text.replace("^(4/3)", "**Exponent(4,3)").replace("^(3/2)", "**Exponent(3,2)")
        self.code = compile(text.replace("^", "**"), name, "eval")

    def tensors(self, values):
        """All independent components at a point, by key and indices from 1."""
        n = len(self.coordinates)
        N = range(n)
        at = dict(zip(self.arguments, values))
        zero = lambda: [[mpf(0)] * n for _ in N]
        jet = {p: Jet(at[p], [mpf(0)] * n, zero()) for p in self.parameters}
        for i, c in enumerate(self.coordinates):
            jet[c] = Jet(at[c], [mpf(i == j) for j in N], zero())
        for head, names in self.functions.items():
            name, by = head[:-1].split("(")
            i = self.coordinates.index(by)
            g, h = [mpf(0)] * n, zero()
            g[i], h[i][i] = at[names[1]], at[names[2]]
            jet[name] = (lambda value: lambda _: value)(Jet(at[names[0]], g, h))
        unit = Jet(mpf(0), [mpf(0)] * n, zero())
        diag = lambda *d: [[d[i] if i == j else 0 for j in N] for i in N]
        g = eval(self.code, {**FUNCTIONS, **jet, "diag": diag, "Exponent": Exponent})
        g = [[unit.constant(x) for x in row] for row in g]
        inv = inverse([[x.v for x in row] for row in g])
        dg = [[[g[i][j].g[k] for k in N] for j in N] for i in N]
        low = [[[(dg[m][k][j] + dg[m][j][k] - dg[j][k][m]) / 2 for k in N] for j in N] for m in N]
        G = [[[sum(inv[i][m] * low[m][j][k] for m in N) for k in N] for j in N] for i in N]

        def rate(l, j, k):
            d = [(g[m][k].h[j][l] + g[m][j].h[k][l] - g[j][k].h[m][l]) / 2
                 - sum(dg[m][p][l] * G[p][j][k] for p in N) for m in N]
            return [sum(inv[i][m] * d[m] for m in N) for i in N]

        dG = {(l, j, k): rate(l, j, k) for l in N for j in N for k in N if j <= k}
        dGamma = lambda i, j, k, l: dG[(l, min(j, k), max(j, k))][i]
        R = {}
        for i, j in itertools.product(N, N):
            for k, l in itertools.combinations(N, 2):
                R[i, j, k, l] = dGamma(i, l, j, k) - dGamma(i, k, j, l) + sum(
                    G[i][k][m] * G[m][l][j] - G[i][l][m] * G[m][k][j] for m in N)
        full = lambda i, j, k, l: R[i, j, k, l] if k < l else -R[i, j, l, k] if l < k else mpf(0)
        ricci = [[sum(full(i, j, i, l) for i in N) for l in N] for j in N]
        mixed = {(i, j, k, l): sum(inv[j][p] * R[i, p, k, l] for p in N) for (i, j, k, l) in R}
        pairs = list(itertools.combinations(N, 2))
        kretschmann = 4 * sum(mixed[(*a, *b)] * mixed[(*b, *a)] for a in pairs for b in pairs)
        out = {}
        word = lambda *at: "".join(str(i + 1) for i in at)
        for i, j in itertools.combinations_with_replacement(N, 2):
            out["metric " + word(i, j)] = g[i][j].v
            out["ricci " + word(i, j)] = ricci[i][j]
            for m in N:
                out["affinities " + word(m, i, j)] = G[m][i][j]
        out.update({"curvature " + word(*at): value for at, value in R.items()})
        out["scalar_curvature"] = sum(inv[j][l] * ricci[j][l] for j in N for l in N)
        out["kretschmann"] = kretschmann
        return out

    def nonzero(self):
        """The components that do not vanish identically."""
        mp.dps = 100
        found = set()
        for start in (37, 41):
            values = [mp.mpf(start + 5 * i) / 97 for i in range(len(self.arguments))]
            found |= {key for key, v in self.tensors(values).items() if abs(v) > mpf(10) ** -70}
        return sorted(found)

    def sized(self, point, keys, side):
        """The components, and their sizes, at a distance of 1e-90 from the point."""
        values = [mpf(x) + side * mpf(10) ** -90 * (abs(mpf(x)) or 1) for x in point]
        base = self.tensors(values)
        sizes = {key: abs(base[key]) for key in keys}
        for i, x in enumerate(values):
            near = self.tensors(values[:i] + [x * (1 + H)] + values[i + 1:])
            for key in keys:
                sizes[key] += abs(near[key] - base[key]) / H
        return base, sizes

    def at(self, point, keys):
        """Texts of value and size of the components; those that differ on both sides of the point are singular."""
        texts = [""] * len(keys)
        for dps in (150, 600, 2500):
            mp.dps = dps
            try:
                sides = [self.sized(point, keys, side) for side in (1, -3)]
            except ZeroDivisionError:
                continue
            texts = [self.text(key, sides) for key in keys]
            if all(texts):
                return texts
        return texts

    @staticmethod
    def text(key, sides):
        """The value and its size, if both sides agree; sizes grow on one side of a singular point."""
        (v, s), (w, other) = ((base[key], sizes[key]) for base, sizes in sides)
        if max(s, other) < mpf(10) ** -60 and max(abs(v), abs(w)) < mpf(10) ** -80 and mp.dps > 150:
            return "0 1"
        if 100 * abs(s - other) > s or abs(v - w) > mpf(10) ** -22 * s:
            return ""
        if not mpf(10) ** -280 < s < mpf(10) ** 307:
            return "-"
        return f"{mp.nstr(v, 17, min_fixed=0, max_fixed=0)} {mp.nstr(s, 3, min_fixed=0, max_fixed=0)}"

    def record(self):
        keys = self.nonzero()
        points = [[float(x) for x in p] for p in self.points]
        values = [self.at(p, keys) for p in points]
        return dict(name=self.name, parameters=self.parameters, coordinates=self.coordinates,
                    functions=list(self.functions), positive=self.positive, metric=self.metric,
                    arguments=self.arguments, components=keys,
                    points=[dict(at=p, values=v) for p, v in zip(points, values)])


def line(values, *rest):
    """Points on a line: the first coordinate varies."""
    return [(x, *rest) for x in values]


def around(*values):
    """Values close to others, on both sides, and themselves."""
    return [x + d * max(1.0, abs(x)) for x in values for d in NEAR] + list(values)


def radial(values, *rest):
    """Points at which the second coordinate varies."""
    return [(0.3, x, *rest) for x in values]


def plane(name, square, values, **more):
    return Chart(name, "x y", f"diag(1, ({square})^2)", line(values, 0.3), **more)


def static(name, f, values, **more):
    rest = more.pop("rest", ())
    metric = f"diag(-({f}), 1/({f}), r^2, r^2*sin(theta)^2)"
    return Chart(name, "t r theta phi", metric, radial(values, 1.1, 0.2, *rest), **more)


SPHERE = "x^2+y^2+z^2"
ISO = f"M/(2*sqrt({SPHERE}))"
SMALL = [x for x in BOTH if abs(x) <= 0.1]
POS_SMALL = [x for x in STD if x <= 20]
CHARTS = [
    plane("hyperbolic_plane", "sinh(x)", BOTH),
    plane("two_plus_tanh", "2+tanh(x)", BOTH),
    Chart("root_below", "x y", "diag(1, 1/(2+sqrt(x))^2)", line(STD + around(4.0), 0.3), positive=["x"]),
    Chart("isotropic", "t x y z", f"diag(-((1-{ISO})/(1+{ISO}))^2, (1+{ISO})^4, (1+{ISO})^4, (1+{ISO})^4)",
          [(0.3, x, 0.0, 0.0, 1.0) for x in [0.1, 1.0, 100.0] + around(0.5)[::2]]
          + [(0.3, x, 0.3, 0.0, 1.0) for x in around(0.4)[::2]] + [(0.3, 0.7, 0.4, -0.9, 1.25)],
          parameters=["M"], positive=["M"]),
    plane("sphere", "sin(x)", SMALL + [1.0, 20.0, 700.0] + around(PI / 2, PI)),
    plane("sphere_latitude", "cos(x)", SMALL + [1.0] + around(PI / 2)),
    Chart("sphere_stereographic", "x y", "diag(4/(1+x^2+y^2)^2, 4/(1+x^2+y^2)^2)", line(STD, 0.3)),
    Chart("half_plane", "x y", "diag(1/y^2, 1/y^2)", radial(STD)),
    Chart("disc", "x y", "diag(4/(1-x^2-y^2)^2, 4/(1-x^2-y^2)^2)",
          line(POS_SMALL[:4] + [0.75 - 1e-3, 0.8 - 1e-8, 0.8 - 1e-12, 0.8 + 1e-3], 0.6)),
    plane("one_minus_cos", "1-cos(x)", SMALL + [1.0, 20.0] + around(PI, 2 * PI)),
    plane("one_plus_cos", "1+cos(x)", SMALL + [1.0] + around(PI / 2, PI)),
    plane("one_minus_sin", "1-sin(x)", SMALL + [1.0, 20.0] + around(PI / 2, -PI / 2)),
    plane("two_plus_cos", "2+cos(x)", SMALL + [1.0, 20.0] + around(PI / 2, PI)),
    plane("tangent", "tan(x)", SMALL + [1.0] + around(PI / 2, PI)),
    plane("cosh_minus_one", "cosh(x)-1", BOTH),
    plane("exp_minus_one", "exp(x)-1", BOTH),
    plane("fermi", "1/(1+exp(x))", BOTH),
    plane("bose", "1/(exp(x)-1)", BOTH),
    plane("bose_fermi", "exp(x)/(exp(2*x)-1)", BOTH),
    plane("one_plus_tanh", "1+tanh(x)", BOTH),
    plane("coth", "1/tanh(x)", BOTH),
    plane("sech", "1/cosh(x)", BOTH),
    plane("csch", "1/sinh(x)", BOTH),
    plane("sinh_cosh", "sinh(x)+2*cosh(x)", BOTH),
    plane("double_sinh", "sinh(2*x)", BOTH),
    plane("sinh_over_cosh_square", "sinh(x)/cosh(x)^2", BOTH),
    plane("difference_of_exponentials", "exp(x)-exp(-2*x)", BOTH),
    plane("sin_sinh", "sin(x)*sinh(x)", SMALL + [1.0, 20.0] + around(PI)),
    # tan(x) - tanh(x), log(1+x) and x*cosh(x) - sinh(x) have no accurate form in these functions for small x
    plane("cos_cosh", "cos(x)*cosh(x)", [-0.1, 0.1, 1.0, 20.0] + around(PI / 2)),
    Chart("sin_cosh", "x y", "diag(1, sin(x)^2*cosh(y)^2)",
          [(x, y) for x in (1e-12, 1e-4, 1.0) for y in (1e-8, 1.0, 100.0)]),
    Chart("catenoid", "u v", "diag(cosh(u)^2, cosh(u)^2)", line(BOTH, 0.3)),
    plane("exp_length", "exp(x/L)", [], parameters=["L"]),
    Chart("tanh_radius", "x y", "diag(1, (1+tanh(sqrt(x^2+y^2)))^2)",
          line(STD, 0.0) + line(POS_SMALL, 0.3), positive=["x^2+y^2"]),
    plane("root_of_linear", "sqrt(1+x)-1", STD + [-1e-12, -1e-4, -0.1, -1 + 1e-3, -1 + 1e-8], positive=["1+x"]),
    plane("cube_root_of_linear", "(1+x)^(1/3)-1", STD + [-1e-12, -1e-4, -0.1, -1 + 1e-3], positive=["1+x"]),
    plane("root_of_quadratic", "sqrt(1+x^2)-1", BOTH, positive=["1+x^2"]),
    plane("root_difference", "sqrt(1+x)-sqrt(x)", STD, positive=["1+x", "x"]),
    plane("root_and_number", "2-sqrt(x)", STD + around(4.0), positive=["x"]),
    plane("logarithm", "log(x)", STD + around(1.0), positive=["x"]),
    plane("logarithm_of_one_plus", "log(1+x)", [x for x in STD if x > 0.01] + [-0.1], positive=["1+x"]),
    plane("x_over_sinh", "x/sinh(x)", [x for x in BOTH if abs(x) > 0.5]),
    plane("hyperboloid", "x^2+1", BOTH),
    plane("two_roots", "1/(1+sqrt(x)+x)", STD + around(1.0), positive=["x"]),
    Chart("rindler", "t x", "diag(-x^2, 1)", radial(STD)),
    static("schwarzschild", "1-2*M/r", [1e-4, 0.1, 1.0, 20.0, 700.0] + around(2.0), rest=(1.0,), parameters=["M"]),
    static("extremal", "(1-M/r)^2", [1e-4, 0.1, 20.0, 700.0] + around(1.0), rest=(1.0,), parameters=["M"]),
    static("de_sitter_static", "1-r^2", [1e-12, 1e-4, 0.1, 20.0] + around(1.0)),
    Chart("kerr", "t r theta phi",
          "[[-(1-2*M*r/(r^2+a^2*cos(theta)^2)),0,0,-2*M*r*a*sin(theta)^2/(r^2+a^2*cos(theta)^2)],"
          "[0,(r^2+a^2*cos(theta)^2)/(r^2-2*M*r+a^2),0,0],[0,0,r^2+a^2*cos(theta)^2,0],"
          "[-2*M*r*a*sin(theta)^2/(r^2+a^2*cos(theta)^2),0,0,"
          "(r^2+a^2+2*M*r*a^2*sin(theta)^2/(r^2+a^2*cos(theta)^2))*sin(theta)^2]]",
          [(0.3, r, th, 0.2, 1.25, 1.0) for r, th in [(700.0, 1.1), (3.0, 1.1), (3.0, 1e-8), (2.0 + 1e-8, 1.1), (0.1, 1.5)]],
          parameters=["M", "a"]),
    Chart("matter_universe", "t x y z", "diag(-1, t^(4/3), t^(4/3), t^(4/3))", line(STD, 0.3, 0.4, 0.5), positive=["t"]),
    Chart("root_universe", "t x", "diag(-1, (1+t^(2/3))^2)", line(STD, 0.3), positive=["t"]),
    Chart("kasner", "t x y z", "diag(-1, t^(2*p), t^(2*q), t^(2*s))",
          line(STD, 0.3, 0.4, 0.5, 0.75, 0.5, -0.25), parameters=["p", "q", "s"], positive=["t"]),
    Chart("de_sitter_closed", "t chi theta phi", "diag(-1, cosh(t)^2, cosh(t)^2*sin(chi)^2, cosh(t)^2*sin(chi)^2*sin(theta)^2)",
          line([-1e-8, 1e-4, 1.0, 20.0, 300.0, 700.0], 0.4, 1.1, 0.2) + [(1.0, 1e-8, 1e-4, 0.2)]),
    Chart("de_sitter_flat", "t x y z", "diag(-1, exp(2*t/L), exp(2*t/L), exp(2*t/L))",
          line([-1e-8, 1.0, 100.0, 700.0], 0.3, 0.4, 0.5, 1.25), parameters=["L"]),
    Chart("anti_de_sitter", "t r theta phi", "diag(-cosh(r)^2, 1, sinh(r)^2, sinh(r)^2*sin(theta)^2)",
          radial([1e-12, 1e-4, 1.0, 20.0, 300.0, 700.0], 1.1, 0.2)),
    Chart("free_scale", "t x y", "diag(-1, a(t)^2, a(t)^2)",
          [(0.3, 0.4, 0.5, *v) for v in [(1.25, 0.5, -0.75), (1e-12, 0.5, 3.0), (700.0, 1e-8, -1e-4), (1e-8, 1e-8, 1e-8)]],
          functions={"a(t)": ["a(t)", "a_t(t)", "a_t_t(t)"]}),
    Chart("free_static", "t r theta phi", "diag(-f(r), 1/f(r), r^2, r^2*sin(theta)^2)",
          [(0.3, r, 1.1, 0.2, *v) for r in (1e-4, 3.0, 300.0) for v in [(0.5, 0.25, -0.75), (1e-12, 0.5, 3.0)]],
          functions={"f(r)": ["f(r)", "f_r(r)", "f_r_r(r)"]}),
    Chart("lemaitre", "t x theta phi", "diag(-1, 1/(x-t)^(2/3), (x-t)^(4/3), (x-t)^(4/3)*sin(theta)^2)",
          [(0.25, x, 1.1, 0.2) for x in (0.25 + 1e-8, 0.25 + 1e-3, 1.0, 20.0, 700.0)], positive=["x-t"]),
]
for chart in CHARTS:
    if chart.name == "exp_length":
        chart.points = line(BOTH, 0.3, 1.25)

if __name__ == "__main__":
    names = sys.argv[1:]
    print("[")
    chosen = [chart for chart in CHARTS if not names or chart.name in names]
    for at, chart in enumerate(chosen):
        print(json.dumps(chart.record(), separators=(",", ":")) + ("," if at + 1 < len(chosen) else ""), flush=True)
        print(chart.name, file=sys.stderr, flush=True)
    print("]")
