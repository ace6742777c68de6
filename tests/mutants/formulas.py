#!/usr/bin/env python3
"""Mutants of the formulas: every sign flipped, every two indices of a factor exchanged, every
term doubled. A mutant is caught when a test fails; survivors are listed, exit status 1.

The formulas are strings that go through one function, so a copy of the tree is compiled once with
that function taking its text from the environment, and the tests are run once for each mutant.

    python3 tests/mutants/formulas.py [--only SUBSTRING] [--tests MODULE,MODULE...]
"""
import argparse
import itertools
import re
import sys
import tempfile

from copied import ROOT, build, copy_into, fails

CONTRACTION = "tensors/src/contraction.rs"
HOOK = "    let parsed = Expression::parse(expression)?;"
SWITCH = """    let switched = std::env::var("AFFINOR_MUTANT").ok();
    let pair = switched.as_deref().and_then(|pair| pair.split_once('|'));
    let expression = match pair {
        Some((from, to)) if expression.split_whitespace().eq(from.split(' ')) => to,
        _ => expression,
    };
""" + HOOK
TERM = r"(-?\d+ )?[A-Za-z]+[\^_\w]*( [A-Za-z]+[\^_\w]*)?"
FORMULA = re.compile(rf"{TERM}( [+-] {TERM})* ->[ \^_\w\[\]]*")

# derivations write their formula for the tensor at hand, so its mutants are changes of their source
UPPER, LOWER = " + L^{letter}_{direction}p T{summed}", " - L^p_{direction}{letter} T{summed}"
DERIVATIONS = [
    ("src/algebra/lie_derivative.rs", UPPER, UPPER.replace("+", "-")),
    ("src/algebra/lie_derivative.rs", UPPER, UPPER.replace("{direction}p", "p{direction}")),
    ("src/algebra/lie_derivative.rs", UPPER, UPPER.replace("+", "+ 2")),
    ("src/algebra/lie_derivative.rs", LOWER, LOWER.replace("-", "+")),
    ("src/algebra/lie_derivative.rs", LOWER, LOWER.replace("{direction}{letter}", "{letter}{direction}")),
    ("src/algebra/lie_derivative.rs", LOWER, LOWER.replace("-", "- 2")),
    ("src/algebra/lie_derivative.rs", "X^m d_m{result} + A", "X^m d_m{result} - A"),
    ("src/algebra/lie_derivative.rs", "X^m d_m{result} + A", "2 X^m d_m{result} + A"),
    ("src/geometry/connection.rs", 'format!("d_m{}', 'format!("2 d_m{}'),
    ("src/geometry/connection.rs", 'format!("d_m{}', 'format!("-1 d_m{}'),
]


def formulas():
    """The contraction strings of the library, white space folded."""
    found = {}
    for path in sorted((ROOT / "src").rglob("*.rs")):
        text = path.read_text()
        for literal in re.findall(r'"([^"\n]*(?:\\\n[^"\n]*)*->[^"\n]*)"', text):
            folded = " ".join(re.sub(r"\\\n\s*", "", literal).split())
            if FORMULA.fullmatch(folded):
                found.setdefault(folded, path.relative_to(ROOT))
    return found


def mutants(formula):
    """Each mutant with a word on what was done."""
    left, right = formula.split("->")
    words = left.split()
    for at, word in enumerate(words):
        if word in "+-":
            other = "-" if word == "+" else "+"
            yield f"sign {at}", " ".join(words[:at] + [other] + words[at + 1:]) + " ->" + right
        elif word.lstrip("-").isdigit():
            yield f"factor {at}", " ".join(words[:at] + [str(3 * int(word))] + words[at + 1:]) + " ->" + right
        else:
            starts = at == 0 or words[at - 1] in "+-"
            if starts:
                yield f"double {at}", " ".join(words[:at] + ["2", word] + words[at + 1:]) + " ->" + right
            name, indices = re.match(r"([A-Za-z0-9]+)(.*)", word).groups()
            letters = [i for i, c in enumerate(indices) if c not in "^_"]
            level = {i: indices[: i + 1].rfind("^") > indices[: i + 1].rfind("_") for i in letters}
            for a, b in itertools.combinations(letters, 2):
                if level[a] == level[b]:
                    swapped = list(indices)
                    swapped[a], swapped[b] = swapped[b], swapped[a]
                    new = name + "".join(swapped)
                    yield f"{word} -> {new}", " ".join(words[:at] + [new] + words[at + 1:]) + " ->" + right
    if words[0] not in "+-":
        yield "sign of the first term", "-1 " + " ".join(words) + " ->" + right


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--only", default="")
    parser.add_argument("--tests", default="")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        text = (ROOT / CONTRACTION).read_text()
        assert text.count(HOOK) == 1, "the one function of formulas has moved"
        tree = copy_into(folder, {CONTRACTION: text.replace(HOOK, SWITCH)})
        modules = [name for name in options.tests.split(",") if name]
        programs = list(build(tree).values())
        for program in programs:
            if fails(program, modules, tree):
                sys.exit(f"{program} fails without a mutant")
        count, survivors, last = 0, 0, {}

        def judge(path, formula, what, mutant=None):
            nonlocal count, survivors
            count += 1
            # whoever caught the last mutant of this file is asked first
            for program in sorted(programs, key=lambda program: program != last.get(path)):
                if fails(program, modules, tree, mutant):
                    last[path] = program
                    return
            survivors += 1
            print(f"SURVIVES {path}: {what}\n    {formula}", flush=True)

        for formula, path in formulas().items():
            if options.only in f"{path} {formula}":
                for what, mutant in mutants(formula):
                    judge(path, formula, what, f"{formula}|{mutant}")
        for path, old, new in DERIVATIONS:
            if options.only not in f"{path} {old}":
                continue
            source = tree / path
            text = source.read_text()
            assert old in text, f"{path} no longer says {old}"
            source.write_text(text.replace(old, new))
            programs = list(build(tree).values())
            judge(path, old, new)
            source.write_text(text)
        print(f"{count} mutants, {survivors} survive")
        sys.exit(bool(survivors))


if __name__ == "__main__":
    main()
