#!/usr/bin/env python3
"""Mutants of decisions: signs, comparisons, constants, indices, tolerances, branches left out, arguments exchanged.

`sites.py` lists them. In a copy of the tree each site becomes a choice between its text and its mutants by a number
from the environment, so all mutants are compiled at once. Then the tests named at the site are run once for each
mutant. Survivors are listed, except those with a reason why they are equivalent; exit status 1 if there are any.

    python3 tests/mutants/decisions.py [--only SUBSTRING] [--tests FILTER,FILTER...] [--skip TEST,TEST...]
        [--folder FOLDER]
"""
import argparse
import sys
import tempfile
import time

from copied import ROOT, build, copy_into, fails
from sites import SITES

LIBRARY = "src/lib.rs"
SWITCH = """
/// The mutant that the environment chooses; 0 for none.
#[doc(hidden)]
pub fn mutant() -> usize {
    static CHOSEN: std::sync::OnceLock<usize> = std::sync::OnceLock::new();
    let read = || std::env::var("AFFINOR_MUTANT").ok().and_then(|number| number.parse().ok());
    *CHOSEN.get_or_init(|| read().unwrap_or(0))
}
"""
# the programs with tests of the library
SELECTION = ["-p", "affinor", "-p", "affinor-tests", "--lib", "--test", "affinor", "--test", "documents"]


class Mutant:
    """A number, the file, the text and its replacement, the tests, and the reason if it is equivalent."""

    def __init__(self, number, path, tests, old, new, reason=None):
        self.number, self.path, self.tests = number, path, tests.split()
        self.old, self.new, self.reason = old, new, reason

    def __str__(self):
        return f"{self.number} {self.path}: {self.old} -> {self.new}"


def numbered():
    """The mutants of all sites, in order."""
    rows = ((path, tests, *row) for path, (tests, sites) in SITES.items() for row in sites)
    return [Mutant(number, *row) for number, row in enumerate(rows, start=1)]


def choice(old, mutants):
    """The choice in Rust between a text and its mutants. A text that ends as a statement does is one."""
    if old.endswith((";", "}")):
        arms = "".join(f"{mutant.number} => {{ {mutant.new} }} " for mutant in mutants)
        return f"match crate::mutant() {{ {arms}_ => {{ {old} }} }}"
    arms = "".join(f"{mutant.number} => {mutant.new}, " for mutant in mutants)
    return f"(match crate::mutant() {{ {arms}_ => {old} }})"


def mutated(text, mutants):
    """The text of a file with a choice at each of its sites."""
    sites = {}
    for mutant in mutants:
        sites.setdefault(mutant.old, []).append(mutant)
    spans = []
    for old, group in sites.items():
        assert text.count(old) == 1, f"{group[0].path} says {text.count(old)} times: {old}"
        spans.append((text.index(old), old, group))
    end = len(text)
    for start, old, group in sorted(spans, reverse=True, key=lambda span: span[0]):
        assert start + len(old) <= end, f"{group[0].path}: two sites overlap: {old}"
        text, end = text[:start] + choice(old, group) + text[start + len(old):], start
    return text


def edits(mutants):
    """The edited texts of the copy: the function that chooses, and the choices."""
    texts = {LIBRARY: "#![allow(unused_parens)]\n" + (ROOT / LIBRARY).read_text() + SWITCH}
    for path in {mutant.path: None for mutant in mutants}:
        texts[path] = mutated((ROOT / path).read_text(), [mutant for mutant in mutants if mutant.path == path])
    return texts


def by_program(tests):
    """Filters by test program: `PROGRAM:FILTER`, or a filter of the program `affinor`."""
    chosen = {}
    for test in tests:
        program, colon, rest = test.partition(":")
        named = colon and not rest.startswith(":")
        chosen.setdefault(program if named else "affinor", []).append(rest if named else test)
    return chosen


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="mutants whose description contains this")
    parser.add_argument("--tests", default="", help="filters instead of those of the sites")
    parser.add_argument("--skip", default="", help="tests to leave out, such as those that fail without a mutant")
    parser.add_argument("--folder", help="where the copy is made and stays, for a second run")
    options = parser.parse_args()
    mutants = numbered()
    with tempfile.TemporaryDirectory() as temporary:
        tree = copy_into(options.folder or temporary, edits(mutants))
        programs = build(tree, SELECTION)
        chosen = [mutant for mutant in mutants if options.only in str(mutant)]
        for mutant in chosen:
            mutant.tests = options.tests.split(",") if options.tests else mutant.tests
        skipped = [word for name in options.skip.split(",") if name for word in ("--skip", name)]
        everything = {test: None for mutant in chosen for test in mutant.tests}
        for program, filters in by_program(everything).items():
            if fails(programs[program], filters + skipped, tree):
                sys.exit(f"{program} fails without a mutant")
        survivors = equivalent = 0
        for mutant in chosen:
            begin = time.monotonic()
            tests = by_program(mutant.tests).items()
            number = str(mutant.number)
            if any(fails(programs[name], filters + skipped, tree, number) for name, filters in tests):
                print(f"caught {mutant} ({time.monotonic() - begin:.0f} s)", flush=True)
                if mutant.reason:
                    print(f"    although it is listed as equivalent: {mutant.reason}", flush=True)
            elif mutant.reason:
                equivalent += 1
            else:
                survivors += 1
                print(f"SURVIVES {mutant}", flush=True)
        print(f"{len(chosen)} mutants, {survivors} survive, {equivalent} are equivalent")
        sys.exit(bool(survivors))


if __name__ == "__main__":
    main()
