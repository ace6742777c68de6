"""The claims of tests/documents/claims/{line_elements,public_reports,equal_functions}.rs, tested at random points in 50 digits.

    python3 tests/references/line_elements.py [NAME ...]        (Python 3.11, mpmath 1.3)

The claims are read from the tables in the Rust sources, the definition files from the folders of tests/data/ with their names,
or from examples/definitions/ and documents/charts/.
"""
import random
import re
import sys
import tomllib
import zlib
from itertools import product
from pathlib import Path

from mpmath import mp, mpf

import charts
from charts import Definition, RANKS, component, components, parse, random_point

ROOT = Path(__file__).resolve().parents[2]
TABLES = ["line_elements", "public_reports"]
POINTS = 3
# Ranges of coordinates and parameters in the domain of the line element.
RANGES = {"line_elements/khan_penrose": (mpf(1) / 20, mpf(3) / 5)}


def claims():
    for folder in TABLES:
        text = (ROOT / f"tests/documents/claims/{folder}.rs").read_text()
        for name, claim in re.findall(r'\("([\w-]+)", "([^"]* = [^"]*)"\),', text):
            yield f"{folder}/{name}", claim


def residuals(claim, point, geometry):
    """Pairs of values that a claim says are equal."""
    left, right = claim.split(" = ")
    value = lambda text: point.value(parse(text), 0).v
    n, g = geometry.n, geometry.metric
    if left == "sectional":
        K = value(right)
        for at, found in components(geometry.lowered, n, 4).items():
            i, j, k, l = at
            yield found, K * (g[i][k] * g[j][l] - g[i][l] * g[j][k])
    elif match := re.fullmatch(r"(\w+)\[([\d,]+)\]", left):
        at = [int(i) - 1 for i in match[2].split(",")]
        yield component(getattr(geometry, match[1]), at), value(right)
    elif match := re.fullmatch(r"(\w+)\((.*)\)", left):
        vector = [value(entry) for entry in charts.entries(f"diag({match[2]})")]
        tensor = getattr(geometry, match[1])
        yield sum(vector[i] * vector[j] * tensor[i][j] for i in range(n) for j in range(n)), value(right)
    else:
        factor = value(right.removesuffix("*metric"))
        for at, found in components(getattr(geometry, left), n, RANKS[left]).items():
            yield found, factor * component(g, at) if right.endswith("*metric") else factor


def identities():
    """Pairs of functions that tests/documents/claims/equal_functions.rs says are equal; the number that are not."""
    text = (ROOT / "tests/documents/claims/equal_functions.rs").read_text()
    chart = tomllib.loads(re.search(r'const CHART: &str = "(.*?)";', text, re.S)[1].replace('\\"', '"'))
    found, failed = re.findall(r'^    "(.*) = (.*)",$', text, re.M), 0
    for left, right in found:
        rng = random.Random(zlib.crc32(left.encode()))
        point, _, _ = random_point(Definition(chart), rng)
        left, right = (point.value(parse(side)).v for side in (left, right))
        if abs(left - right) > mpf(10) ** (10 - charts.DIGITS) * (1 + abs(left)):
            print(f"{mp.nstr(left, 20)} is not {mp.nstr(right, 20)}")
            failed += 1
    print(f"{len(found)} identities, {failed} failed")
    return failed


def main():
    chosen, failed, count = sys.argv[1:], 0, 0
    geometries = {}
    for name, claim in claims():
        if chosen and name.split("/")[1] not in chosen:
            continue
        if name not in geometries:
            folders = [f"tests/data/{Path(name).parent}", "examples/definitions", "documents/charts"]
            paths = [ROOT / folder / f"{Path(name).name}.toml" for folder in folders]
            definition = Definition.read(next(filter(Path.exists, paths)))
            rng = random.Random(zlib.crc32(name.encode()))
            low, high = RANGES.get(name, (mpf(1) / 5, 3))
            geometries[name] = [random_point(definition, rng, low=low, high=high)[:2] for _ in range(POINTS)]
        count += 1
        for point, geometry in geometries[name]:
            scale = max(abs(v) for v in components(geometry.curvature, geometry.n, 4).values()) + 1
            worst = max(residuals(claim, point, geometry), key=lambda pair: abs(pair[0] - pair[1]))
            if abs(worst[0] - worst[1]) > mpf(10) ** (10 - charts.DIGITS) * scale:
                print(f"{name}: {claim}: {mp.nstr(worst[0], 20)} and {mp.nstr(worst[1], 20)}")
                failed += 1
                break
    files = {f"line_elements/{path.stem}" for path in (ROOT / "tests/data/line_elements").iterdir()}
    if not chosen and (missing := files - set(geometries)):
        print("no claim:", *sorted(missing))
        failed += 1
    print(f"{count} claims of {len(geometries)} line elements, {failed} failed")
    failed += 0 if chosen else identities()
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
