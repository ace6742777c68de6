"""What tells the tasks and grids of sweeps apart: code with what it uses, values, and the contents of files."""

from __future__ import annotations

import functools
import hashlib
import json
import pickle
import sys
import tomllib
import types
from collections.abc import Callable, Mapping, Set
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

_PLAIN = (bool, int, float, complex, str, bytes, Fraction, type(None), type(...), np.generic)


def identity(value: Any) -> Any:
    """Plain values that are equal for equal values, and differ where code, or a value that it uses, differs.

    Functions of packages that the task does not belong to count by name and version.

    Raises TypeError for an object that has no such form, such as an open file.
    """
    return _identity(value, {})


def _identity(value: Any, seen: dict[int, tuple[int, Any]]) -> Any:
    """The same beside what has been ``seen``: objects by their addresses, with numbers in their order."""
    if isinstance(value, _PLAIN):
        return f"{type(value).__name__} {value!r}"
    if isinstance(value, types.ModuleType):
        return "module", value.__name__, getattr(value, "__version__", None)
    if id(value) in seen:
        return "seen", seen[id(value)][0]
    seen[id(value)] = len(seen), value
    found = _of_object(value, lambda item: _identity(item, seen))
    # functions and classes count once, however often they are used; values that are equal may be one object or several
    if not isinstance(value, (types.FunctionType, type)):
        del seen[id(value)]
    return found


def _of_object(value: Any, of: Callable[[Any], Any]) -> Any:
    if isinstance(value, np.ndarray) and value.dtype.kind != "O":
        digest = hashlib.sha256(np.ascontiguousarray(value).tobytes()).hexdigest()
        return "array", value.dtype.str, value.shape, digest
    if isinstance(value, (list, tuple, np.ndarray)):
        return type(value).__name__, [of(item) for item in value]
    if isinstance(value, Mapping):
        return "mapping", [(of(key), of(item)) for key, item in value.items()]
    if isinstance(value, Set):
        return "set", sorted(repr(of(item)) for item in value)
    if isinstance(value, types.CodeType):
        return "code", value.co_code.hex(), value.co_names, value.co_varnames, [of(item) for item in value.co_consts]
    if isinstance(value, functools.partial):
        return "partial", of(value.func), of(value.args), of(value.keywords)
    if isinstance(value, types.MethodType):
        return "method", of(value.__func__), of(value.__self__)
    if isinstance(value, types.FunctionType):
        return _of_function(value, of)
    if isinstance(value, (type, types.BuiltinFunctionType, np.ufunc)):
        return _of_class(value, of)
    if isinstance(value, property):
        return "property", of(value.fget), of(value.fset), of(value.fdel)
    if hasattr(value, "__wrapped__"):
        return "wrapped", type(value).__qualname__, of(value.__wrapped__)
    if not _is_installed(type(value).__module__) and hasattr(value, "__dict__"):
        return "object", of(type(value)), of(vars(value))
    try:
        return "pickle", hashlib.sha256(pickle.dumps(value)).hexdigest()
    except Exception as error:
        raise TypeError(
            f"a sweep cannot tell whether a later task with this {type(value).__name__} is the same: {error}"
        ) from error


def _of_function(function: types.FunctionType, of: Callable[[Any], Any]) -> Any:
    if _is_installed(function.__module__):
        return _named(function)
    cells = []
    for cell in function.__closure__ or ():
        try:
            cells.append(of(cell.cell_contents))
        except ValueError:  # not assigned yet
            cells.append("empty")
    used = {name: function.__globals__[name] for name in sorted(_names(function.__code__)) if name in function.__globals__}
    return "function", of(function.__code__), of(function.__defaults__), of(function.__kwdefaults__), cells, of(used)


def _of_class(value: Any, of: Callable[[Any], Any]) -> Any:
    if not isinstance(value, type) or _is_installed(value.__module__):
        return _named(value)
    own = {
        name: item
        for name, item in vars(value).items()
        if isinstance(item, types.FunctionType)
        or not (name.startswith("__") or isinstance(item, (types.MemberDescriptorType, types.GetSetDescriptorType)))
    }
    return "class", value.__qualname__, of(own), [of(base) for base in value.__bases__]


def _names(code: types.CodeType) -> set[str]:
    """The global names in a code and in those inside it."""
    inner = (constant for constant in code.co_consts if isinstance(constant, types.CodeType))
    return set(code.co_names).union(*map(_names, inner))


def _named(value: Any) -> Any:
    name = getattr(value, "__qualname__", None) or getattr(value, "__name__", "")
    module = getattr(value, "__module__", None) or ""
    package = sys.modules.get(module.partition(".")[0])
    return "name", module, name, getattr(package, "__version__", None)


def _is_installed(module: str | None) -> bool:
    """Whether a module belongs to Python or to an installed package."""
    root = (module or "").partition(".")[0]
    if root in sys.stdlib_module_names or root == "affinor":
        return True
    path = None if root == "__main__" else getattr(sys.modules.get(root), "__file__", None)
    return path is not None and bool({"site-packages", "dist-packages"} & set(Path(path).parts))


def of_files(document: Any, folder: Path) -> Any:
    """A document with the contents of the files that its texts name, and of those that these name."""
    if isinstance(document, Mapping):
        return [(key, of_files(value, folder)) for key, value in document.items()]
    if isinstance(document, (list, tuple)):
        return [of_files(value, folder) for value in document]
    if isinstance(document, str) and len(document) < 1000 and "\n" not in document:
        path = folder / document
        try:
            if document and path.is_file():
                return of_file(path)
        except (OSError, ValueError):  # no name of a file
            pass
    return repr(document)


def of_file(path: Path) -> Any:
    """The content of a file, and of the files that it names."""
    data = path.read_bytes()
    digest = hashlib.sha256(data).hexdigest()
    readers: dict[str, Any] = {".toml": tomllib.loads, ".json": json.loads}
    reader = readers.get(path.suffix)
    try:
        return digest, of_files(reader(data.decode()), path.parent) if reader else None
    except (ValueError, RecursionError):
        return digest, None
