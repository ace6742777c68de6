"""Docstrings: every public name has one, and the examples in them are true."""

import doctest
import inspect

import pytest

import affinor as af

NAMES = {name: getattr(af, name) for name in af.__all__}


def documented():
    for name, found in NAMES.items():
        if callable(found):
            yield name, found
        if inspect.isclass(found):
            own = sorted(key for key, value in vars(found).items() if not key.startswith("_") and hasattr(value, "__doc__"))
            yield from ((f"{name}.{key}", getattr(found, key)) for key in own)


@pytest.mark.parametrize("name, found", list(documented()), ids=lambda value: value if isinstance(value, str) else "")
def test_docstrings(name, found):
    if inspect.ismemberdescriptor(found):
        return
    assert found.__doc__, f"{name} has no docstring"
    test = doctest.DocTestParser().get_doctest(found.__doc__, dict(NAMES), name, None, 0)
    assert doctest.DocTestRunner().run(test).failed == 0
