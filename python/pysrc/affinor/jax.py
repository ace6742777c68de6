"""Lie groups in JAX: the operations of :mod:`affinor` under ``jit``, ``vmap``, ``grad``, ``jvp`` and ``vjp``.

Values and derivatives are computed by the engine in float64 on the CPU and rounded to the type of the arguments. Derivatives are
those of the group in closed form: they are finite at the identity and at half a turn. A row without a result, such as the
logarithm of zeros, is NaN.

The engine is called through ``jax.pure_callback`` (``vmap_method="expand_dims"``: one call for a whole batch), which costs some
tens of microseconds for each operation and a copy of its arrays; so batches pay, single elements in a compiled loop do not.
Derivatives of derivatives raise NotImplementedError.

Examples
--------
>>> import jax                                             # doctest: +SKIP
>>> from affinor.jax import SO3                            # doctest: +SKIP
>>> jax.grad(lambda x: SO3.exp(x)[0])(jax.numpy.zeros(3))  # doctest: +SKIP
Array([-0., -0., -0.], dtype=float32)
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

try:
    import jax
    import jax.numpy as jnp
except ImportError as _missing:
    raise ImportError("affinor.jax needs JAX: pip install 'affinor[jax]'") from _missing

import affinor as af
from affinor._differentials import Operation, operations, rows

__all__ = ["SE2", "SE3", "SE2_3", "SL2", "SO2", "SO3", "Group"]


def _called(function: Callable[..., Any], core: tuple[int, ...], arguments: tuple[Any, ...]) -> Any:
    """The function on the host, as an operation of JAX whose rows have the shape ``core``."""
    dtype = jnp.result_type(*arguments)
    dtype = dtype if jnp.issubdtype(dtype, jnp.floating) else jnp.result_type(float)
    # equal ranks, so that the axes which vmap adds in front belong together
    rank = max(jnp.ndim(argument) for argument in arguments)
    arguments = tuple(jnp.reshape(a, (1,) * (rank - jnp.ndim(a)) + jnp.shape(a)) for a in arguments)
    batch = jnp.broadcast_shapes(*(a.shape[:-1] for a in arguments))

    def host(*arrays: Any) -> Any:
        whole = jnp.broadcast_shapes(*(array.shape[:-1] for array in arrays))
        return rows(function, (*whole, *core), len(core), *arrays).astype(dtype)

    shape = jax.ShapeDtypeStruct((*batch, *core), dtype)
    return jax.pure_callback(host, shape, *arguments, vmap_method="expand_dims")


def _differentiable(operation: Operation) -> Callable[..., Any]:
    """The operation with its differentials as a function of JAX."""

    @jax.custom_jvp
    def apply(*arguments: Any) -> Any:
        width = operation.width(*(argument.shape[-1] for argument in arguments))
        return _called(operation.result, (width,), arguments)

    @partial(jax.custom_jvp, nondiff_argnums=(0,))
    def differential(at: int, *arguments: Any) -> Any:
        width = operation.width(*(argument.shape[-1] for argument in arguments))
        return _called(operation.differentials[at], (width, arguments[at].shape[-1]), arguments)

    @differential.defjvp
    def _second(at: int, primals: Any, tangents: Any) -> Any:
        raise NotImplementedError(f"affinor.jax has no second derivatives: {operation.name} was differentiated twice")

    def rule(primals: tuple[Any, ...], tangents: tuple[Any, ...]) -> tuple[Any, Any]:
        value = apply(*primals)
        rate = jnp.zeros_like(value)
        for at, tangent in enumerate(tangents):
            if type(tangent) is not jax.custom_derivatives.SymbolicZero:
                rate = rate + jnp.einsum("...ij,...j->...i", differential(at, *primals), tangent).astype(value.dtype)
        return value, rate

    apply.defjvp(rule, symbolic_zeros=True)
    return apply


def _real(name: str, value: Any) -> Any:
    """An array of real numbers."""
    array = jnp.asarray(value)
    if jnp.issubdtype(array.dtype, jnp.complexfloating):
        raise TypeError(f"{name} should be an array of real numbers, not of dtype {array.dtype}")
    return array


class Group:
    """The operations of a group as functions of JAX.

    Elements and vectors are those of :class:`affinor.Group`, with the axes of the batch in front and broadcasting.

    Parameters
    ----------
    group : str or affinor.Group
        A group, or its name.
    """

    def __init__(self, group: str | af.Group) -> None:
        self._group = af.Group(group) if isinstance(group, str) else group
        self.dimension: int = self._group.dimension
        self.coordinate_count: int = self._group.coordinate_count
        self._operations = {name: _differentiable(found) for name, found in operations(self._group).items()}

    def __repr__(self) -> str:
        return f"<Group {self._group.name} in JAX>"

    def identity(self, dtype: Any = None) -> Any:
        """The neutral element."""
        return jnp.asarray(self._group.identity(), dtype=dtype or jnp.result_type(float))

    def exp(self, x: Any) -> Any:
        """The exponential of vectors (..., dimension)."""
        return self._apply("exp", self._rows("x", x, self.dimension))

    def log(self, g: Any) -> Any:
        """The logarithm of elements (..., coordinates)."""
        return self._apply("log", self._rows("g", g, self.coordinate_count))

    def compose(self, g: Any, h: Any) -> Any:
        """The products ``g h``."""
        return self._apply("compose", self._rows("g", g, self.coordinate_count), self._rows("h", h, self.coordinate_count))

    def inverse(self, g: Any) -> Any:
        """The inverse elements."""
        return self._apply("inverse", self._rows("g", g, self.coordinate_count))

    def act(self, g: Any, points: Any) -> Any:
        """The action of matrices of size k on points (..., k); affine maps act on points (..., k - 1) too."""
        g, points = self._rows("g", g, self.coordinate_count), _real("points", points)
        # the shapes are checked by the engine, before anything is compiled
        self._group.act(self._group.identity(), [0.0] * (points.shape[-1] if points.ndim else 0))
        return self._apply("act", g, points)

    def _apply(self, name: str, *arguments: Any) -> Any:
        dtype = jnp.result_type(*arguments)
        dtype = dtype if jnp.issubdtype(dtype, jnp.floating) else jnp.result_type(float)
        return self._operations[name](*(argument.astype(dtype) for argument in arguments))

    def _rows(self, name: str, value: Any, width: int) -> Any:
        array = _real(name, value)
        if array.ndim == 0 or array.shape[-1] != width:
            raise ValueError(f"{name} should be an array of the shape (..., {width}), not of the shape {array.shape}")
        return array


SO2 = Group(af.SO2)
SO3 = Group(af.SO3)
SE2 = Group(af.SE2)
SE3 = Group(af.SE3)
SE2_3 = Group(af.SE2_3)
SL2 = Group(af.SL2)
