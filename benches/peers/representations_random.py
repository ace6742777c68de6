#!/usr/bin/env python3
"""Random products of representations beside GAP, and random restrictions beside Sage: the number that agree.

    python3 benches/peers/representations_random.py --affinor target/release/affinor --sage SAGE_PYTHON

Products are compared by labels, with the nodes of GAP renumbered after the dimensions of its fundamental
representations. Restrictions are compared by the dimensions of their components, because the programs order
the factors of a subalgebra differently and Sage leaves out charges."""
import argparse
import json
import random
import re
import subprocess
from collections import Counter
from itertools import permutations

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("--affinor", default="target/release/affinor")
arguments.add_argument("--sage", help="Python with passagemath; without it there are no restrictions")
arguments.add_argument("--products", type=int, default=500)
arguments.add_argument("--restrictions", type=int, default=200)
arguments.add_argument("--seed", type=int, default=1)
options = arguments.parse_args()
chance = random.Random(options.seed)

TYPES = ["A1", "A2", "A3", "A4", "A6", "B2", "B3", "B5", "C3", "C4", "D4", "D5", "D6", "E6", "E7", "E8", "F4", "G2"]
LARGEST = {"product": 3000, "restriction": 20000}
# Sage: the type of the subalgebra and the rule; affinor: the subalgebra
RULES = [
    ("E6", "D5", "levi", "levi 6"), ("E6", "A5", "levi", "levi 2"), ("E7", "E6", "levi", "levi 7"),
    ("E7", "D6", "levi", "levi 1"), ("E8", "E7", "levi", "levi 8"), ("E8", "D7", "levi", "levi 1"),
    ("F4", "B3", "levi", "levi 4"), ("F4", "C3", "levi", "levi 1"), ("A5", "A4", "levi", "levi 5"),
    ("D5", "A4", "levi", "levi 5"), ("D5", "D4", "levi", "levi 1"), ("B4", "B3", "levi", "levi 1"),
    ("C4", "A3", "levi", "levi 4"), ("E6", "A5xA1", "extended", "extended 2"), ("E7", "A7", "extended", "extended 2"),
    ("E8", "D8", "extended", "extended 1"), ("E8", "A8", "extended", "extended 2"),
    ("F4", "B4", "extended", "extended 4"), ("G2", "A2", "extended", "extended 1"),
    ("G2", "A1xA1", "extended", "extended 2"), ("B4", "D4", "extended", "extended 4"),
    ("A5", "C3", "symmetric", "Sp(6)"), ("A4", "B2", "symmetric", "SO(5)"), ("A5", "A1xA2", "tensor", "SU(2) x SU(3)"),
]


def affinor(*words):
    return json.loads(subprocess.run([options.affinor, "rep", *words, "--format", "json"], text=True, check=True,
                                     capture_output=True).stdout)


def listed(labels):
    return "[" + ",".join(map(str, labels)) + "]"


def dimension(cartan, labels):
    return int(affinor(cartan, listed(labels))["representation"]["dimension"])


def weight(cartan, largest):
    """A random weight that is not 0, whose dimension is at most `largest`, or a fundamental one."""
    rank = int(cartan[1:])
    for _ in range(20):
        labels = [chance.choice([0, 0, 0, 1, 1, 2, 3]) if chance.random() < 3 / rank else 0 for _ in range(rank)]
        if any(labels) and dimension(cartan, labels) <= largest:
            return labels
    smallest = min(range(rank), key=lambda i: dimension(cartan, [int(j == i) for j in range(rank)]))
    return [int(j == smallest) for j in range(rank)]


def gap(program):
    done = subprocess.run(["gap", "-q", "--quitonbreak", "-o", "4g"], text=True, input=program + "\nQUIT;\n",
                          capture_output=True)
    return re.sub(r"\\\n|\n(?=[^WR])", "", done.stdout)


def products():
    tasks = {}
    for at in range(options.products):
        cartan = TYPES[at % len(TYPES)]
        tasks.setdefault(cartan, []).append([weight(cartan, LARGEST["product"]) for _ in range(2)])
    agree = 0
    for cartan, pairs in tasks.items():
        rank = int(cartan[1:])
        units = [[int(i == j) for j in range(rank)] for i in range(rank)]
        made = f'L := SimpleLieAlgebra("{cartan[0]}", {rank}, Rationals);;\n'
        text = gap(made + "".join(f'Print("W ", DimensionOfHighestWeightModule(L, {u}), "\\n");' for u in units))
        theirs = [int(d) for d in re.findall(r"W (\d+)", text)]
        ours = [dimension(cartan, unit) for unit in units]
        order = next(p for p in permutations(range(rank)) if [ours[i] for i in p] == theirs)
        there = [[[labels[i] for i in order] for labels in pair] for pair in pairs]
        text = gap(made + "".join(
            f'd := DecomposeTensorProduct(L, {a}, {b});; Print("R\\n");\n'
            'for k in [1..Length(d[1])] do Print("W ", d[1][k], " = ", d[2][k], ";\\n"); od;\n' for a, b in there))
        results = text.split("R\n")[1:]
        assert len(results) == len(pairs), (cartan, text[-300:])
        for (a, b), result in zip(pairs, results):
            expected = Counter()
            for labels, multiplicity in re.findall(r"W \[([^\]]*)\] = (\d+);", result):
                own = [0] * rank
                for i, label in zip(order, labels.split(",")):
                    own[i] = int(label)
                expected[tuple(own)] = int(multiplicity)
            found = affinor(cartan, listed(a), "--tensor", listed(b))["result"]["components"]
            found = Counter({tuple(one["labels"]): int(one["multiplicity"]) for one in found})
            agree += found == expected
            if found != expected:
                print("differs:", cartan, a, b)
    print(f"{agree} of {options.products} products agree with GAP")


SAGE = """
import json, sys
import sage.all__sagemath_combinat
from collections import Counter
from sage.combinat.root_system.weyl_characters import WeylCharacterRing
for line in sys.stdin:
    ambient, target, rule, labels = json.loads(line)
    made, target = (WeylCharacterRing(name, style="coroots") for name in (ambient, target))
    restricted = made(*labels).branch(target, rule=rule)
    sizes = Counter()
    for at, multiplicity in restricted.monomial_coefficients().items():
        sizes[int(target.monomial(at).degree())] += int(multiplicity)
    print(json.dumps(sorted(sizes.items())), flush=True)
"""


def restrictions():
    tasks = [RULES[at % len(RULES)] for at in range(options.restrictions)]
    tasks = [(*rule, weight(rule[0], LARGEST["restriction"])) for rule in tasks]
    given = "".join(json.dumps([ambient, target, rule, labels]) + "\n" for ambient, target, rule, _, labels in tasks)
    done = subprocess.run([options.sage, "-c", SAGE], text=True, input=given, capture_output=True)
    lines = done.stdout.splitlines()
    assert len(lines) == len(tasks), done.stderr[-2000:]
    agree = 0
    for (ambient, target, _, own, labels), line in zip(tasks, lines):
        sizes = Counter()
        for one in affinor(ambient, listed(labels), "--branch", own)["result"]["components"]:
            sizes[int(one["dimension"])] += int(one["multiplicity"])
        same = sorted(sizes.items()) == [tuple(entry) for entry in json.loads(line)]
        agree += same
        if not same:
            print("differs:", ambient, target, labels)
    print(f"{agree} of {options.restrictions} restrictions agree with Sage")


products()
if options.sage:
    restrictions()
