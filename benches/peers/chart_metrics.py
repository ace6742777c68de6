"""Metrics over charts, and the values of components at a point where none is singular.

Free functions are taken as exponentials of sums, of which every derivative is a multiple.
"""
import json
import math
import random
import re

BOX = "r^2 + a^2*cos(h)^2"
TEN = "ABCDEFGHKL"
GENERAL = [[f"{TEN[max(i, j) - min(i, j) + sum(range(4, 4 - min(i, j), -1))]}(t,x,y,z)" for j in range(4)] for i in range(4)]
CHARTS = {  # coordinates, parameters, functions, rows of the metric
    "ellipsoid": ("u,v", "a,b,c", "", ["(a^2*cos(v)^2 + b^2*sin(v)^2)*sin(u)^2,(b^2 - a^2)*sin(u)*cos(u)*sin(v)*cos(v)",
                                       "(b^2 - a^2)*sin(u)*cos(u)*sin(v)*cos(v),(a^2*sin(v)^2 + b^2*cos(v)^2)*cos(u)^2 + c^2*sin(u)^2"]),
    "trigonometric": ("u,v", "a", "", ["2 + cos(u),a*sin(u)*sin(v)", "a*sin(u)*sin(v),3 + cos(v)"]),
    "Schwarzschild": ("t,r,h,p", "m", "", ["2*m/r - 1,0,0,0", "0,1/(1 - 2*m/r),0,0", "0,0,r^2,0", "0,0,0,r^2*sin(h)^2"]),
    "de Sitter, flat slices": ("t,r,h,p", "H", "", ["-1,0,0,0", "0,exp(t)^2*H,0,0", "0,0,r^2*exp(t)^2*H,0", "0,0,0,r^2*sin(h)^2*exp(t)^2*H"]),
    "Kerr": ("t,r,h,p", "m,a", "", [
        f"2*m*r/({BOX}) - 1,0,0,-2*m*a*r*sin(h)^2/({BOX})", f"0,({BOX})/(r^2 - 2*m*r + a^2),0,0", f"0,0,{BOX},0",
        f"-2*m*a*r*sin(h)^2/({BOX}),0,0,(r^2 + a^2 + 2*m*a^2*r*sin(h)^2/({BOX}))*sin(h)^2"]),
    "Friedmann, any a(t)": ("t,r,h,p", "k", "a(t)", [
        "-1,0,0,0", "0,a(t)^2/(1 - k*r^2),0,0", "0,0,r^2*a(t)^2,0", "0,0,0,r^2*sin(h)^2*a(t)^2"]),
    "10 free functions": ("t,x,y,z", "", ";".join(f"{name}(t,x,y,z)" for name in TEN), [",".join(row) for row in GENERAL]),
}


def entries(row):
    """The entries of a row, separated by commas outside of parentheses."""
    return re.split(r",(?![^()]*\))", row)


def definition(coordinates, parameters, functions, rows):
    """The definition file of a chart."""
    listed = lambda text, between: json.dumps([name for name in text.split(between) if name])
    metric = json.dumps([entries(row) for row in rows])
    return (f"parameters = {listed(parameters, ',')}\n[chart]\ncoordinates = {listed(coordinates, ',')}\n"
            f"functions = {listed(functions, ';')}\n[metric]\ncomponents = {metric}\n")


class Names(dict):
    """What the names of components stand for at a point."""

    def __init__(self, coordinates, parameters, functions):
        draw = random.Random(1)
        letters = [name for name in f"{coordinates},{parameters}".split(",") if name]
        point = {name: draw.uniform(0.3, 0.6) for name in letters} | {"r": 3.1}
        super().__init__(vars(math) | {"cot": lambda v: 1 / math.tan(v)} | point)
        self.rates = {name[0]: {x: draw.uniform(-1.0, 1.0) for x in name[2:-1].split(",")} for name in functions.split(";") if name}

    def __missing__(self, name):
        """A free function, or a derivative such as `a_t_t`."""
        head, *by = name.split("_")
        rates = self.rates[head]
        factor = math.prod(rates[x] for x in by)
        return lambda *at: factor * math.exp(sum(rate * x for rate, x in zip(rates.values(), at)))

    def value(self, text):
        # Maxima writes 'diff(a(t),t,2), and %e
        head = lambda found: "_".join([found[1], *(x for x, n in zip(*[iter(found[3].split(","))] * 2) for _ in range(int(n)))])
        text = re.sub(r"'diff\((\w+)\(([^()]*)\),([^()]*)\)", lambda found: f"{head(found)}({found[2]})", text)
        return eval(text.replace("^", "**").replace("%e", "e"), {}, self)

    def agree(self, a, b):
        a, b = self.value(a), self.value(b)
        return abs(a - b) <= 1e-9 * max(1.0, abs(a), abs(b))
