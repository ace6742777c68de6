"""Converts numbers and expressions to text for the engine, and text to fractions, floats or SymPy expressions."""

from __future__ import annotations

import functools
import numbers
import operator
import re
import sys
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from affinor import _engine

Scalar: TypeAlias = Any
"""A number (int, Fraction), a SymPy expression, or an expression as a string."""

T = TypeVar("T", bound=np.generic)

Symbols: TypeAlias = dict[str, Any]
"""The SymPy symbols of the parameters, by name, with their assumptions."""

_NAMES = re.compile(r"(?<![\w.])[A-Za-z_]\w*\b(?!\s*\()")
_OF_FORMULAS = {"Abs": "abs", "Max": "max", "Min": "min"}
"""Functions whose names in formulas of motions differ from their names in SymPy."""


_is_elementary = functools.cache(_engine.knows)
"""Whether the engine has an elementary function with this name. SymPy has the same names."""


def is_sympy(value: object) -> bool:
    """Whether the value is an expression of SymPy, which need not be installed."""
    sympy = sys.modules.get("sympy")
    return sympy is not None and isinstance(value, sympy.Basic)


def is_matrix(value: object) -> bool:
    """Whether the value is a matrix or an array of SymPy."""
    sympy = sys.modules.get("sympy")
    return sympy is not None and isinstance(value, (sympy.MatrixBase, sympy.NDimArray))


def text_of(
    value: Scalar, symbols: Symbols, floats: bool = False, imaginary: bool = False
) -> str:
    """Writes a value in the notation of definition files. The SymPy symbols in the value are added to ``symbols``."""
    if isinstance(value, str):
        return value.strip()
    if isinstance(value, (bool, np.bool_)):
        raise TypeError(f"a number or an expression was expected, not the bool {value}")
    if value is np.ma.masked:
        raise ValueError("a number or an expression was expected, not a masked entry")
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if is_sympy(value):
        return _of_sympy(value, symbols, floats, imaginary)
    if isinstance(value, numbers.Rational):
        return f"{value.numerator}/{value.denominator}"
    if isinstance(value, (float, np.floating)):
        number = float(value)
        if number.is_integer() and abs(number) < 2**53 and number == value:
            return str(int(number))
        if floats and np.isfinite(number):
            return repr(number)
        if not np.isfinite(number):
            raise ValueError(f"a finite number was expected, not {number}")
        raise _inexact(number)
    if isinstance(value, (complex, np.complexfloating)):
        if value.imag == 0:
            return text_of(float(value.real), symbols, floats=floats)
        if imaginary:
            parts = [text_of(float(part), symbols, floats=floats) for part in (value.real, value.imag)]
            return f"({parts[0]}) + ({parts[1]})*i"
        raise TypeError(f"a real number was expected, not {value!r}")
    if isinstance(value, np.ndarray) and value.ndim == 0:
        return text_of(value.item(), symbols, floats=floats, imaginary=imaginary)
    raise TypeError(
        f"a number (int, Fraction), a SymPy expression or a text was expected, not {type(value).__name__}"
    )


def unmasked(value: Any) -> Any:
    """Returns the value, after a check that it has no masked entries, in an array or in a list of arrays."""
    parts = value if isinstance(value, (list, tuple)) else [value]
    if any(isinstance(part, np.ma.MaskedArray) and np.ma.is_masked(part) for part in parts):
        raise ValueError("an array of numbers was expected, not one with masked entries")
    return value


def floats(value: Any) -> NDArray[np.float64]:
    """Converts real numbers to an array of float64. Complex numbers, strings, dates and records are errors."""
    value = unmasked(value)
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise ValueError(f"an array of real numbers was expected: {error}") from error
    if array.dtype.kind == "O":
        try:
            # rejects strings, although float() accepts some of them
            numbers = [float(item) if not isinstance(item, (str, bytes)) else _refuse(item) for item in array.flat]
        except OverflowError as error:
            raise ValueError(f"an array of real numbers was expected: {error}") from error
        except TypeError as error:
            raise TypeError(f"an array of real numbers was expected: {error}") from error
        array = np.array(numbers, dtype=np.float64).reshape(array.shape)
    elif array.dtype.kind not in "biuf":
        raise TypeError(f"an array of real numbers was expected, not of dtype {array.dtype}")
    return _regular(array, np.float64)


def _regular(array: NDArray[Any], dtype: type[T]) -> NDArray[T]:
    """Converts an array to C order and aligned memory. An empty array is created anew, because NumPy always calls it aligned."""
    return np.require(array, dtype, ["C", "A"]) if array.size else np.empty(array.shape, dtype)


def with_axes(what: str, value: Any, counts: Sequence[int]) -> NDArray[np.float64]:
    """Converts finite real numbers to an array; ``counts`` lists the allowed numbers of axes."""
    array = floats(value)
    if array.ndim not in counts:
        expected = " or ".join(map(str, counts)) + (" axis" if list(counts) == [1] else " axes")
        raise ValueError(f"{what} should be an array with {expected}, not of the shape {array.shape}")
    if not np.isfinite(array).all():
        raise ValueError(f"{what} should be finite, not {array[~np.isfinite(array)][0]}")
    return array


def _refuse(item: object) -> float:
    """Raises the TypeError for an object that is not a number."""
    raise TypeError(f"{item!r} is not a number")


def index(what: str, value: Any) -> int:
    """Converts an integer of any type with ``__index__``, except bool."""
    if isinstance(value, (bool, np.bool_)) or not hasattr(value, "__index__"):
        raise TypeError(f"{what} is an integer, not {type(value).__name__}")
    return operator.index(value)


def integers(what: str, value: Any) -> NDArray[np.int64]:
    """Converts indices to an array of int64. Numbers that are not integers are an error; they are not truncated."""
    value = unmasked(value)
    try:
        array = np.asarray(value)
        if array.dtype.kind == "O":
            array = np.array([operator.index(item) for item in array.flat], dtype=np.int64).reshape(array.shape)
    except (TypeError, ValueError, OverflowError) as error:
        raise type(error)(f"{what} should be an array of integers: {error}") from error
    if array.size and array.dtype.kind not in "iu":
        raise TypeError(f"{what} should be an array of integers, not of dtype {array.dtype}")
    return _regular(array, np.int64)


def _inexact(number: float) -> TypeError:
    """The error for a float where an exact number is required."""
    exact = f"write Fraction('{number!r}') or the text '{number!r}' for an exact number, or choose scalar='float'"
    return TypeError(f"{number!r} is a float, and exact numbers are needed: {exact}")


def _of_sympy(expression: Any, symbols: Symbols, floats: bool, imaginary: bool) -> str:
    """Writes a SymPy expression in the notation of definition files. Its symbols are added to ``symbols``."""
    import sympy

    if floats and expression.is_real and expression.is_number and not expression.is_rational:
        return repr(float(expression))

    def write(node: Any) -> str:
        if floats and imaginary and node.is_number and (inexact := _inexact_complex(node)) is not None:
            return inexact
        if node.is_Symbol:
            if imaginary and node.name == "i":
                raise ValueError("i is the imaginary unit in matrices: give the symbol i another name, or write sympy.I")
            return _symbol(node, symbols)
        if node.is_Integer:
            return f"({node})" if node.is_negative else str(node)
        if node.is_Rational:
            return f"({node.p}/{node.q})"
        if node.is_Float:
            number = float(node)
            if floats or (number.is_integer() and abs(number) < 2**53 and sympy.Rational(node) == int(number)):
                return f"({text_of(number, symbols, floats=True)})"
            raise _inexact(number)
        if node is sympy.I and imaginary:
            return "i"
        if node is sympy.pi:
            return "pi"
        if node.is_Add:
            return "(" + " + ".join(map(write, node.args)) + ")"
        if node.is_Mul:
            return "*".join(map(write, node.args))
        if node.is_Pow:
            base, exponent = node.args
            if exponent.is_Integer:
                return f"({write(base)})^{int(exponent)}"
            if exponent.is_Rational and exponent.q == 2:
                return f"(sqrt({write(base)}))^{int(exponent.p)}"
            if base is sympy.E:
                return f"exp({write(exponent)})"
            return f"({write(base)})^({write(exponent)})"
        elif node is sympy.E and floats:
            return "exp(1)"
        elif node.is_Derivative and isinstance(node.expr, sympy.core.function.AppliedUndef):
            by = "".join(f"_{write(variable)}" for variable in node.variables)
            return f"{_undefined(node.expr)}{by}({', '.join(map(write, node.expr.args))})"
        elif node.is_Function:
            name = node.func.__name__
            arguments = ", ".join(map(write, node.args))
            if isinstance(node, sympy.core.function.AppliedUndef):
                return f"{name if floats else _undefined(node)}({arguments})"
            # lets formulas pass any function: they have further functions, and the engine reports unknown ones
            if floats or _is_elementary(name):
                return f"{_OF_FORMULAS.get(name, name)}({arguments})"
        raise TypeError(f"{node} is neither a rational function nor an elementary function")

    return write(expression)


def _inexact_complex(number: Any) -> str | None:
    """Writes a SymPy number with an irrational real or imaginary part in floats; ``None`` for other numbers."""
    parts = number.as_real_imag()
    if all(part.is_rational for part in parts):
        return None
    real, imaginary = (float(part) for part in parts)
    return f"(({real!r}) + ({imaginary!r})*i)"


def _undefined(function: Any) -> str:
    """The name of an undefined SymPy function, after a check that the name can be read back."""
    from sympy import Function

    name = str(function.func.__name__)
    if function.func != Function(name):
        raise ValueError(f"the function {name} has assumptions, which would be lost")
    if _is_elementary(name) or not re.fullmatch(r"[A-Za-z][A-Za-z0-9]*", name):
        raise ValueError(f"the function {name!r} needs another name: use ASCII letters and digits, but not the name of a known function")
    return name


def _symbol(symbol: Any, symbols: Symbols) -> str:
    """Checks a SymPy symbol, adds it to ``symbols``, and returns its name."""
    name = str(symbol.name)
    if name == "pi":
        raise ValueError("pi is the number here: give the symbol pi another name, or write sympy.pi")
    if not name.isidentifier() or len(name) > 64:
        raise ValueError(f"the symbol {name!r} needs a name of letters, digits and _, at most 64, not beginning with a digit")
    known = symbols.setdefault(name, symbol)
    if known != symbol:
        raise ValueError(f"two different symbols are called {name!r}: their assumptions differ")
    return name


def merged(*several: Mapping[str, Any]) -> Symbols:
    """Merges the symbols of several objects. Two different symbols with the same name are an error."""
    result: Symbols = {}
    for symbols in several:
        for symbol in symbols.values():
            _symbol(symbol, result)
    return result


def free_functions(value: Any) -> set[str]:
    """The undefined SymPy functions in expressions, matrices and lists of them, written as in charts: ``a(t)``."""
    if isinstance(value, Mapping):
        return set().union(*map(free_functions, value.values()))
    if isinstance(value, (list, tuple)):
        return set().union(*map(free_functions, value))
    if not hasattr(value, "atoms"):
        return set()
    from sympy.core.function import AppliedUndef

    return {f"{_undefined(function)}({', '.join(map(str, function.args))})" for function in value.atoms(AppliedUndef)}


def names_in(texts: Iterable[str], *, without: Iterable[str] = ()) -> list[str]:
    """The names that occur in expressions, sorted. Names of functions, and names in ``without``, are left out."""
    found = {name for text in texts for name in _NAMES.findall(text)}
    return sorted(found.difference(without))


def replaced(text: str, values: Mapping[str, str]) -> str:
    """Replaces names in an expression by the texts in ``values``."""
    return re.sub(r"(?<![\w.])[A-Za-z_]\w*", lambda match: values.get(match.group(), match.group()), text)


def to_sympy(text: str, symbols: Mapping[str, Any]) -> Any:
    """Converts text of the engine to a SymPy expression that contains the given symbols."""
    import sympy

    def name(name: str) -> Any:
        if name == "pi":
            return sympy.pi
        return symbols[name] if name in symbols else sympy.Symbol(name)

    def function(name: str, *arguments: Any) -> Any:
        if _is_elementary(name):
            return getattr(sympy, name)(*arguments)
        # a name such as f_r_theta means a derivative of f
        head, *by = name.split("_")
        places = {str(argument): argument for argument in arguments}
        value = sympy.Function(head)(*arguments)
        return value.diff(*(places[argument] for argument in by)) if by else value

    return _engine.evaluate(text, sympy.Rational, name, function)


def value_of(found: Fraction | float | str, symbols: Mapping[str, Any]) -> Any:
    """Converts a component to the value that users get: a Fraction, a float, or a SymPy expression (without SymPy, a string)."""
    if not isinstance(found, str):
        return found
    try:
        return to_sympy(found, symbols)
    except ImportError:
        return found


def number(text: str, symbols: Mapping[str, Any], floats: bool) -> Any:
    """Converts a number of the engine to the value that users get."""
    if floats:
        return float(text)
    try:
        return Fraction(text)
    except ValueError:
        return value_of(text, symbols)


def document(value: Any, symbols: Symbols, *, imaginary: bool = False) -> Any:
    """Converts a value to the form of a definition file or a problem file. Matrices of a basis may be complex."""
    if isinstance(value, Mapping):
        return {
            str(key): document(item, symbols, imaginary=imaginary or key == "matrices")
            for key, item in value.items()
            if item is not None
        }
    if is_matrix(value) or isinstance(value, np.ndarray):
        return document(value.tolist(), symbols, imaginary=imaginary)
    if isinstance(value, (list, tuple)):
        return [document(item, symbols, imaginary=imaginary) for item in value]
    if isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, np.bool_):
        return bool(value)
    if isinstance(value, (float, np.floating)):
        if not np.isfinite(value):
            raise ValueError(f"a finite number was expected, not {value}")
        return float(value)
    if isinstance(value, np.integer):
        return int(value)
    if hasattr(value, "to_document"):
        return value.to_document()
    return text_of(value, symbols, floats=True, imaginary=imaginary)
