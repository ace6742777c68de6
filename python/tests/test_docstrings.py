"""Docstrings: public names have complete ones in the style of numpydoc, and the examples in them are true."""

import doctest
import importlib
import inspect
import pkgutil
import re

import pytest

import affinor as af
from affinor.motion import ProblemKeys

NAMES = {name: getattr(af, name) for name in af.__all__}

RESULTS = ["Check", "Convergence", "Geodesic", "Joint", "KakFactors", "Property", "Report", "Sweep", "Trajectory", "TwoQubitKak"]
"""Classes whose objects only affinor makes: they document attributes instead of the arguments of a constructor."""

WITHOUT_RESULT = ["clear_caches", "set_threads"]

SECTIONS = ["Parameters", "Returns", "Attributes", "Raises", "Examples"]


def modules():
    """The modules of the package, except those whose optional packages are not installed."""
    yield af
    for found in pkgutil.iter_modules(af.__path__, "affinor."):
        if found.name != "affinor.__main__":
            try:
                yield importlib.import_module(found.name)
            except ImportError:
                continue


def members(owner):
    """The public members of a class that affinor defines, and its call."""
    names = {name for base in owner.__mro__ if base.__module__.startswith("affinor") for name in vars(base)}
    return sorted(name for name in names if not name.startswith("_") or name == "__call__")


def public():
    """The public classes, functions, methods and properties: qualified name and object."""
    # the classes of the modules for JAX and PyTorch are public too
    others = [module for module in modules() if module.__name__ in ("affinor.jax", "affinor.torch")]
    for name, found in [*NAMES.items(), *((f"{module.__name__}.Group", module.Group) for module in others)]:
        if callable(found):
            yield name, found
        if inspect.isclass(found):
            for member in members(found):
                yield f"{name}.{member}", getattr(found, member)


def is_field(found):
    """Whether a member is stored data, which the class describes under Attributes."""
    return inspect.ismemberdescriptor(found) or type(found).__name__ == "_tuplegetter" or isinstance(found, str)


def documented():
    """The public objects that have docstrings; members that a class inherits belong to the first class alone."""
    seen = set()
    for name, found in public():
        if not is_field(found) and found not in seen:
            seen.add(found)
            yield name, found


def docstring(name):
    """The docstring of a public object without its indentation."""
    return inspect.cleandoc(DOCUMENTED[name].__doc__ or "")


DOCUMENTED = dict(documented())
CALLABLES = {name: found for name, found in DOCUMENTED.items() if callable(found)}
CLASSES = {name: found for name, found in CALLABLES.items() if inspect.isclass(found)}


def sections(text):
    """The summary of a docstring, and its sections: lines by name."""
    name, found, lines = "", {"": []}, text.splitlines()
    for line, rule in zip(lines, [*lines[1:], ""], strict=True):
        if rule and line and set(rule) == {"-"} and len(rule) == len(line):
            name = line
            found[name] = []
        elif not (line and set(line) == {"-"}):
            found[name].append(line)
    return found


def entries(lines):
    """The names that a section describes; ``x, y : type`` describes two."""
    heads = [line.partition(" : ")[0] for line in lines if line and not line.startswith(" ")]
    return [name for head in heads for name in head.split(", ")]


def arguments(found):
    """The names of the arguments of a callable, with the stars of lists and of keywords."""
    stars = {inspect.Parameter.VAR_POSITIONAL: "*", inspect.Parameter.VAR_KEYWORD: "**"}
    parameters = inspect.signature(found).parameters.values()
    return [stars.get(p.kind, "") + p.name for p in parameters if p.name != "self"]


def has_arguments(name):
    """Whether users call it with arguments: classes that inherit their constructor are described by the base class."""
    found = CALLABLES[name]
    if inspect.isclass(found):
        return name not in RESULTS and not {"__init__", "__new__"}.isdisjoint(vars(found))
    return bool(arguments(found))


@pytest.mark.parametrize("name", DOCUMENTED)
def test_docstring_is_complete(name):
    assert docstring(name), f"{name} has no docstring"
    found = sections(docstring(name))
    assert set(found) - {""} <= set(SECTIONS)
    order = [section for section in found if section]
    assert order == sorted(order, key=SECTIONS.index), f"{name}: the order of sections is {', '.join(SECTIONS)}"
    summary = "\n".join(found[""]).strip().split("\n\n")[0]
    assert summary.endswith(".") and not summary[0].islower(), f"{name}: the summary is a sentence"


@pytest.mark.parametrize("name", [name for name in CALLABLES if has_arguments(name)])
def test_parameters_are_those_of_the_signature(name):
    described = entries(sections(docstring(name)).get("Parameters", []))
    expected = arguments(CALLABLES[name])
    if "**keys" in described and "**keys" not in expected:
        at = described.index("**keys")
        described[at : at + 1] = ProblemKeys.__annotations__
    assert described == expected


@pytest.mark.parametrize("name", [name for name in CALLABLES if name not in CLASSES])
def test_results_are_described(name):
    assert ("Returns" in sections(docstring(name))) == (name not in WITHOUT_RESULT)


@pytest.mark.parametrize("name", CALLABLES)
def test_classes_functions_and_methods_have_an_example(name):
    assert ">>> " in "\n".join(sections(docstring(name)).get("Examples", []))


@pytest.mark.parametrize("name", CLASSES)
def test_attributes_are_the_stored_data(name):
    owner = CLASSES[name]
    described = entries(sections(docstring(name)).get("Attributes", []))
    stored = [member for member in members(owner) if is_field(getattr(owner, member))]
    assert set(stored) <= set(described)
    assert described or name not in RESULTS


def examples():
    """The examples of the modules and all that Python defines in them, and those of the public objects of the engine."""
    for module in modules():
        for test in doctest.DocTestFinder().find(module, globs=dict(NAMES)):
            yield test.name.removeprefix("affinor."), test
    parser = doctest.DocTestParser()
    for name in DOCUMENTED:
        if not inspect.isfunction(DOCUMENTED[name]):
            yield name, parser.get_doctest(docstring(name), dict(NAMES), name, None, 0)


EXAMPLES = {name: test for name, test in examples() if test.examples}


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_are_true(name):
    assert doctest.DocTestRunner().run(EXAMPLES[name]).failed == 0


def test_examples_of_jax_are_true():
    """The examples are skipped elsewhere, because JAX is optional and prints in its own way."""
    module = pytest.importorskip("affinor.jax")
    texts = [module, module.Group, *(getattr(module.Group, name) for name in members(module.Group))]
    for found in texts:
        if not is_field(found):
            text = re.sub(r"# doctest: \+SKIP", "", found.__doc__)
            test = doctest.DocTestParser().get_doctest(text, dict(vars(module)), module.__name__, None, 0)
            assert doctest.DocTestRunner().run(test).failed == 0
