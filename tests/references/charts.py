"""Charts evaluated at a point in 50 digits: metric, affinities, curvature and its contractions.

    python3 tests/references/charts.py FILE.toml [r=3/2 M=1 ...]        (Python 3.11, mpmath 1.3)

The definition file is parsed here, and nothing is differentiated symbolically: an expression is evaluated as a jet, its
value with all first and second partial derivatives by the coordinates. Names without a value on the command line get
random values in the domain of the metric.

A free function is its Taylor coefficients at the point, `f`, `f_r`, `f_r_t`, ...: those of an expression
(`Point(functions={"f": "1 + r^2"})`), or random numbers. A relation of the key `where` determines the derivative on its
left and all derivatives of that one; the others stay random. So a relation holds at the point, with its derivatives.

Conventions: R^i_jkl = d_k G^i_lj - d_l G^i_kj + G^i_km G^m_lj - G^i_lm G^m_kj, Ric_jl = R^i_jil, S = g^jl Ric_jl.
"""
import json
import random
import re
import sys
import tomllib
from fractions import Fraction
from itertools import product

from mpmath import mp, mpf

mp.dps = 60
DIGITS = 50


class Domain(Exception):
    """A root, logarithm or quotient without a real value."""


# Expressions: nested tuples.

TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+)|([^\W\d]\w*)|(\*\*|[-+*/^(),=]))")


class Parser:
    def __init__(self, text):
        self.tokens, at = [], 0
        text = text.strip()
        while at < len(text):
            match = TOKEN.match(text, at)
            if not match:
                raise SyntaxError(f"{text[at:]!r} in {text!r}")
            self.tokens.append(match.groups())
            at = match.end()
        self.at = 0

    def peek(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else (None, None, None)

    def take(self, *symbols):
        symbol = self.peek()[2]
        if symbol in symbols:
            self.at += 1
            return symbol
        return None

    def need(self, symbol):
        if not self.take(symbol):
            raise SyntaxError(f"{symbol} is missing before {self.tokens[self.at:]}")

    def sum(self):
        value = self.product()
        while symbol := self.take("+", "-"):
            value = ("+" if symbol == "+" else "-", value, self.product())
        return value

    def product(self):
        value = self.sign()
        while True:
            if symbol := self.take("*", "/"):
                value = (symbol, value, self.sign())
            elif self.peek()[1]:  # `2 x`
                value = ("*", value, self.power())
            else:
                return value

    def sign(self):
        if self.take("+"):
            return self.sign()
        if self.take("-"):
            return ("neg", self.sign())
        return self.power()

    def power(self):
        value = self.atom()
        if self.take("^", "**"):
            value = ("^", value, self.sign())
        return value

    def atom(self):
        number, name, _ = self.peek()
        if number:
            self.at += 1
            return ("number", Fraction(number))
        if name:
            self.at += 1
            power = None
            if self.peek()[2] in ("^", "**") and self.tokens[self.at + 1 :][:2] and self.at + 2 < len(self.tokens) \
                    and self.tokens[self.at + 1][0] and self.tokens[self.at + 2][2] == "(":  # sin^2(x)
                power = ("number", Fraction(self.tokens[self.at + 1][0]))
                self.at += 2
            if not self.take("("):
                return ("name", name)
            arguments = [self.sum()]
            while self.take(","):
                arguments.append(self.sum())
            self.need(")")
            call = ("call", name, *arguments)
            return ("^", call, power) if power else call
        self.need("(")
        value = self.sum()
        self.need(")")
        return value


def parse(text):
    parser = Parser(str(text))
    value = parser.sum()
    if parser.at < len(parser.tokens):
        raise SyntaxError(f"{parser.tokens[parser.at:]} is left of {text!r}")
    return value


def constant(node):
    """The rational value of an expression without names, or None."""
    match node:
        case ("number", value):
            return value
        case ("neg", a):
            a = constant(a)
            return None if a is None else -a
        case (("+" | "-" | "*" | "/") as op, a, b):
            a, b = constant(a), constant(b)
            if a is None or b is None:
                return None
            return {"+": lambda: a + b, "-": lambda: a - b, "*": lambda: a * b, "/": lambda: a / b}[op]()
    return None


# Jets.


class Jet:
    """A value, its gradient and its second derivatives."""

    __slots__ = ("v", "g", "h")

    def __init__(self, v, g, h):
        self.v, self.g, self.h = v, g, h

    @staticmethod
    def constant(value, n):
        return Jet(mpf(value), [mpf(0)] * n, [[mpf(0)] * n for _ in range(n)])

    @staticmethod
    def variable(value, at, n):
        jet = Jet.constant(value, n)
        jet.g[at] = mpf(1)
        return jet

    def __add__(self, other):
        n = range(len(self.g))
        return Jet(self.v + other.v, [self.g[i] + other.g[i] for i in n],
                   [[self.h[i][j] + other.h[i][j] for j in n] for i in n])

    def chain(self, f, d, dd):
        """f of the jet, by the derivatives of f."""
        n = range(len(self.g))
        return Jet(f, [d * self.g[i] for i in n],
                   [[d * self.h[i][j] + dd * self.g[i] * self.g[j] for j in n] for i in n])

    def __neg__(self):
        return self.chain(-self.v, mpf(-1), mpf(0))

    def __sub__(self, other):
        return self + -other

    def __mul__(self, other):
        n, a, b = range(len(self.g)), self, other
        return Jet(a.v * b.v, [a.v * b.g[i] + a.g[i] * b.v for i in n],
                   [[a.v * b.h[i][j] + a.g[i] * b.g[j] + a.g[j] * b.g[i] + a.h[i][j] * b.v for j in n] for i in n])

    def power(self, p):
        p, v = mpf(p.numerator) / p.denominator if isinstance(p, Fraction) else p, self.v
        whole = p == int(p)
        if v == 0 and p < 0 or not whole and v <= 0:
            raise Domain(f"{mp.nstr(v, 5)}^{mp.nstr(p, 5)}")
        raised = lambda q: mpf(0) if v == 0 and q < 0 else v ** (int(q) if whole else q)
        return self.chain(raised(p), p * raised(p - 1), p * (p - 1) * raised(p - 2))


def positive(value):
    if value <= 0:
        raise Domain(mp.nstr(value, 5))
    return value


def one(f, name):
    """1/f for a function given by its value and derivatives."""
    def inverse(v):
        a, d, dd = f(v)
        if a == 0:
            raise Domain(name)
        return 1 / a, -d / a**2, 2 * d * d / a**3 - dd / a**2
    return inverse


def sine(v): return mp.sin(v), mp.cos(v), -mp.sin(v)
def cosine(v): return mp.cos(v), -mp.sin(v), -mp.cos(v)
def tangent(v): t = mp.tan(v); return t, 1 + t * t, 2 * t * (1 + t * t)
def sinh(v): return mp.sinh(v), mp.cosh(v), mp.sinh(v)
def cosh(v): return mp.cosh(v), mp.sinh(v), mp.cosh(v)
def tanh(v): t = mp.tanh(v); return t, 1 - t * t, -2 * t * (1 - t * t)
def exp(v): return (mp.exp(v),) * 3
def log(v): positive(v); return mp.log(v), 1 / v, -1 / v**2
def sqrt(v): s = mp.sqrt(positive(v)); return s, 1 / (2 * s), -1 / (4 * s**3)


FUNCTIONS = {
    "sin": sine, "cos": cosine, "tan": tangent, "cot": one(tangent, "cot"), "sec": one(cosine, "sec"),
    "csc": one(sine, "csc"), "exp": exp, "log": log, "ln": log, "sqrt": sqrt, "sinh": sinh, "cosh": cosh, "tanh": tanh,
    "coth": one(tanh, "coth"), "sech": one(cosh, "sech"), "csch": one(sinh, "csch"),
}


def evaluate(node, n, name, call):
    """An expression as a jet of n variables; `name` and `call` give the values of names and of free functions."""
    of = lambda part: evaluate(part, n, name, call)
    match node:
        case ("number", value):
            return Jet.constant(mpf(value.numerator) / value.denominator, n)
        case ("name", text):
            return Jet.constant(mp.pi, n) if text == "pi" else name(text)
        case ("neg", a):
            return -of(a)
        case ("+", a, b):
            return of(a) + of(b)
        case ("-", a, b):
            return of(a) - of(b)
        case ("*", a, b):
            return of(a) * of(b)
        case ("/", a, b):
            return of(a) * of(b).power(Fraction(-1))
        case ("^", a, b):
            exponent = constant(b)
            if exponent is not None:
                return of(a).power(exponent)
            base, exponent = of(a), of(b)
            if not any(exponent.g):
                return base.power(exponent.v)
            logarithm = exponent * base.chain(*log(base.v))
            return logarithm.chain(*exp(logarithm.v))
        case ("call", text, *arguments):
            values = [of(argument) for argument in arguments]
            if text in FUNCTIONS and len(values) == 1:
                return values[0].chain(*FUNCTIONS[text](values[0].v))
            return call(text, values)
    raise ValueError(node)


# Definitions.


def entries(text):
    """The entries of `diag(...)`, by the commas outside of parentheses."""
    inside, depth, start, found = text.strip()[len("diag(") : -1], 0, 0, []
    for at, c in enumerate(inside + ","):
        depth += (c == "(") - (c == ")")
        if c == "," and depth == 0:
            found.append(inside[start:at])
            start = at + 1
    return found


class Definition:
    """The keys of a definition file that concern a metric in coordinates."""

    def __init__(self, keys):
        chart = keys["chart"]
        self.keys = keys
        self.coordinates = chart["coordinates"]
        self.parameters = keys.get("parameters", [])
        self.functions = {}
        for text in chart.get("functions", []):
            _, name, *arguments = parse(text)
            self.functions[name] = [argument[1] for argument in arguments]
        self.positive = [(text, parse(text)) for text in chart.get("positive", [])]
        self.where = []
        for text in chart.get("where", []):
            left, right = text.split("=")
            head, *by = left.split("(")[0].strip().split("_")
            self.where.append((head, tuple(sorted(by)), parse(right)))
        metric = keys["metric"]
        metric = metric["components"] if isinstance(metric, dict) else metric
        n = len(self.coordinates)
        if isinstance(metric, str):
            row = [parse(entry) for entry in entries(metric)]
            zero = ("number", Fraction(0))
            self.metric = [[row[i] if i == j else zero for j in range(n)] for i in range(n)]
        else:
            self.metric = [[parse(entry) for entry in row] for row in metric]

    @staticmethod
    def read(path):
        with open(path, "rb") as file:
            return Definition(tomllib.load(file))


def contains(whole, part):
    """The derivatives that lead from one derivative to another one, or None."""
    rest = list(whole)
    for name in part:
        if name not in rest:
            return None
        rest.remove(name)
    return tuple(rest)


class Point:
    """A definition at a point."""

    def __init__(self, definition, values, functions=None, rng=None):
        self.definition, self.rng = definition, rng or random.Random(1)
        self.values = {name: parse_value(value) for name, value in values.items()}
        self.functions = {name: parse(text) for name, text in (functions or {}).items()}
        self.taylor = {}

    def coefficient(self, name, by, arguments):
        """The partial derivative of a free function by its own arguments, by their names or numbers from 1."""
        own = self.definition.functions[name]
        by = tuple(sorted(own[int(a) - 1] if a.isdigit() else a for a in by))
        key = name, by, tuple(mp.nstr(x, 30) for x in arguments)
        if key not in self.taylor:
            self.taylor[key] = self.computed(name, by, arguments)
        return self.taylor[key]

    def computed(self, name, by, arguments):
        own = self.definition.functions[name]
        if name in self.functions:
            return self.along(self.functions[name], own, arguments, by)
        rules = [(len(left), left, right) for head, left, right in self.definition.where
                 if head == name and contains(by, left) is not None]
        if rules:
            _, left, right = max(rules, key=lambda rule: rule[:2])
            return self.along(right, own, arguments, contains(by, left))
        return mpf(self.rng.randint(300, 900)) / 700 if not by else mpf(self.rng.randint(-900, 900)) / 700

    def along(self, node, own, arguments, by):
        """A derivative of the right side of a relation, by the arguments of the function on its left."""
        n = len(own)
        wanted = [own.index(a) for a in by]

        def name(text):
            if text in own:
                return Jet.variable(arguments[own.index(text)], own.index(text), n)
            head, *before = text.split("_")
            if head in self.definition.functions:
                others = self.definition.functions[head]
                at = [arguments[own.index(other)] for other in others]
                of = lambda *more: self.coefficient(head, (*before, *more), at)
                jet = Jet.constant(of(), n)
                # no more derivatives than wanted: those of all directions would need each other
                for i in wanted:
                    jet.g[i] = of(own[i]) if own[i] in others else mpf(0)
                if len(wanted) == 2 and set(by) <= set(others):
                    i, j = wanted
                    jet.h[i][j] = jet.h[j][i] = of(*by)
                return jet
            return Jet.constant(self.values[text], n)

        def call(text, values):
            return self.called(text, values, n, len(by))

        jet = evaluate(node, n, name, call)
        return [lambda: jet.v, lambda: jet.g[wanted[0]], lambda: jet.h[wanted[0]][wanted[1]]][len(by)]()

    def called(self, text, values, n, order=2):
        """A free function, or a derivative of one, at jets."""
        head, *by = text.split("_")
        own, at = self.definition.functions[head], [value.v for value in values]
        jet = Jet.constant(self.coefficient(head, by, at), n)
        for a, x in zip(own, values):
            if order > 0 and any(x.g):
                d = self.coefficient(head, (*by, a), at)
                jet = jet + x.chain(mpf(0), d, mpf(0))
            for b, y in zip(own, values):
                if order > 1 and any(x.g) and any(y.g):
                    dd = self.coefficient(head, (*by, a, b), at)
                    for i, j in product(range(n), repeat=2):
                        jet.h[i][j] += dd * x.g[i] * y.g[j]
        return jet

    def value(self, node, order=2):
        """An expression as a jet in the coordinates, free functions up to an order."""
        names, n = self.definition.coordinates, len(self.definition.coordinates)

        def name(text):
            if text in names:
                return Jet.variable(self.values[text], names.index(text), n)
            if text in self.values:
                return Jet.constant(self.values[text], n)
            head = text.split("_")[0]  # a bare name of a function
            arguments = self.definition.functions[head]
            return self.called(text, [name(argument) for argument in arguments], n, order)

        return evaluate(node, n, name, lambda text, values: self.called(text, values, n, order))

    def check(self):
        """Refuses a point at which a declaration of a sign does not hold."""
        for text, node in self.definition.positive:
            if self.value(node, 0).v <= 0:
                raise Domain(f"{text} is not positive")


def parse_value(value):
    if isinstance(value, str):
        return evaluate(parse(value), 0, None, None).v
    return mpf(value)


# Geometry.


class Geometry:
    """The Levi-Civita connection of a metric at a point: tensors as nested lists of numbers."""

    def __init__(self, point):
        n = self.n = len(point.definition.coordinates)
        jets = [[point.value(entry) for entry in row] for row in point.definition.metric]
        g = self.metric = [[jets[i][j].v for j in range(n)] for i in range(n)]
        try:
            inverse = mp.inverse(mp.matrix(g))
        except ZeroDivisionError:
            raise Domain("degenerate") from None
        up = self.inverse_metric = [[inverse[i, j] for j in range(n)] for i in range(n)]
        d = lambda i, j, k: jets[i][j].g[k]
        dd = lambda i, j, k, l: jets[i][j].h[k][l]
        r = range(n)
        lower = [[[(d(i, k, j) + d(i, j, k) - d(j, k, i)) / 2 for k in r] for j in r] for i in r]
        G = self.affinities = [[[sum(up[i][m] * lower[m][j][k] for m in r) for k in r] for j in r] for i in r]

        def riemann(i, j, k, l):
            second = (dd(i, l, j, k) + dd(j, k, i, l) - dd(i, k, j, l) - dd(j, l, i, k)) / 2
            return second + sum(G[m][j][k] * lower[m][i][l] - G[m][j][l] * lower[m][i][k] for m in r)

        # the independent components, then the symmetries
        self.lowered = R = table(n, 4)
        for i, j, k, l in product(r, repeat=4):
            if i < j and k < l and (i, j) <= (k, l):
                value = riemann(i, j, k, l)
                for (a, b, s), (c, e, t) in product([(i, j, 1), (j, i, -1)], [(k, l, 1), (l, k, -1)]):
                    R[a][b][c][e] = R[c][e][a][b] = s * t * value
        self.curvature = self.raise_first(R)
        self.ricci = [[sum(self.curvature[m][j][m][l] for m in r) for l in r] for j in r]
        self.scalar_curvature = sum(up[j][l] * self.ricci[j][l] for j in r for l in r)
        half = self.scalar_curvature / 2
        self.einstein = [[self.ricci[j][l] - half * g[j][l] for l in r] for j in r]
        self.weyl = self.raise_first(self.trace_free()) if n > 2 else None
        self.kretschmann = self.square(R)

    def raise_first(self, R):
        r, up = range(self.n), self.inverse_metric
        return [[[[sum(up[i][m] * R[m][j][k][l] for m in r) for l in r] for k in r] for j in r] for i in r]

    def trace_free(self):
        n, g, Ric, S = self.n, self.metric, self.ricci, self.scalar_curvature
        W = table(n, 4)
        for i, j, k, l in product(range(n), repeat=4):
            W[i][j][k][l] = self.lowered[i][j][k][l] \
                - (g[i][k] * Ric[j][l] - g[i][l] * Ric[j][k] - g[j][k] * Ric[i][l] + g[j][l] * Ric[i][k]) / (n - 2) \
                + S * (g[i][k] * g[j][l] - g[i][l] * g[j][k]) / ((n - 1) * (n - 2))
        return W

    def square(self, R):
        """R_ijkl R^ijkl, as the trace of the square of R^ij_kl."""
        r, up = range(self.n), self.inverse_metric
        first = self.raise_first(R)
        pairs = [(i, j) for i in r for j in r if i < j]
        mixed = {(p, q): sum(up[p[1]][m] * first[p[0]][m][q[0]][q[1]] for m in r) for p in pairs for q in pairs}
        return 4 * sum(mixed[p, q] * mixed[q, p] for p in pairs for q in pairs)


def table(n, rank):
    return [table(n, rank - 1) for _ in range(n)] if rank else mpf(0)


RANKS = {"metric": 2, "inverse_metric": 2, "affinities": 3, "curvature": 4, "ricci": 2, "einstein": 2, "weyl": 4,
         "scalar_curvature": 0, "kretschmann": 0}


def component(tensor, at):
    for i in at:
        tensor = tensor[i]
    return tensor


def components(tensor, n, rank):
    return {at: component(tensor, at) for at in product(range(n), repeat=rank)}


def random_point(definition, rng, functions=None, fixed=None, low=Fraction(1, 5), high=3, tries=2000):
    """A point with rational coordinates at which the metric has a real value, and its geometry."""
    for _ in range(tries):
        values = {name: Fraction(rng.randint(int(100 * low), int(100 * high)), 100)
                  for name in definition.coordinates + definition.parameters}
        values.update(fixed or {})
        try:
            point = Point(definition, {name: str(value) for name, value in values.items()}, functions, rng)
            point.check()
            return point, Geometry(point), values
        except Domain:
            continue
    raise Domain("no point of the domain was found")


def main():
    path, *settings = sys.argv[1:]
    definition = Definition.read(path)
    fixed = dict(setting.split("=") for setting in settings)
    point, geometry, values = random_point(definition, random.Random(1), fixed=fixed)
    print("at", ", ".join(f"{name} = {value}" for name, value in values.items()))
    for (name, by, at), value in sorted(point.taylor.items()):
        print(f"{'_'.join((name, *by))}({', '.join(at)}) = {mp.nstr(value, DIGITS)}")
    for key, rank in RANKS.items():
        tensor = getattr(geometry, key)
        if tensor is not None:
            for at, value in components(tensor, geometry.n, rank).items():
                if abs(value) > mpf(10) ** -DIGITS:
                    print(key, *(i + 1 for i in at), mp.nstr(value, DIGITS))


if __name__ == "__main__":
    main()
