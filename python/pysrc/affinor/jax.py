"""Lie groups in JAX: the operations of :mod:`affinor` under ``jit``, ``vmap``, ``grad``, ``jvp`` and ``vjp``.

The engine computes values and derivatives in float64 on the CPU and rounds them to the type of the arguments. Derivatives are in
closed form, so they are finite at the identity and at half a turn. A row without a result, such as the logarithm of zeros, is
NaN. Second derivatives raise NotImplementedError.

The engine is called through ``jax.pure_callback``, with one call for a whole batch (``vmap_method="expand_dims"``). Each call
takes some tens of microseconds and copies its arrays. In a compiled loop, batches are therefore faster than single elements.

Examples
--------
>>> import jax                                             # doctest: +SKIP
>>> from affinor.jax import SO3                            # doctest: +SKIP
>>> jax.grad(lambda x: SO3.exp(x)[3])(jax.numpy.zeros(3))  # doctest: +SKIP
Array([0. , 0. , 0.5], dtype=float32)
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
from affinor._differentials import DifferentiableGroup, Operation, rows, second_derivative

__all__ = ["SE2", "SE3", "SE2_3", "SL2", "SO2", "SO3", "Group"]


def _called(function: Callable[..., Any], core: tuple[int, ...], arguments: tuple[Any, ...]) -> Any:
    """Calls a function on the host, as an operation of JAX. The rows of the result have the shape ``core``."""
    dtype = _floats(*arguments)
    # makes the ranks equal, so that the axes that vmap adds in front correspond
    rank = max(jnp.ndim(argument) for argument in arguments)
    arguments = tuple(jnp.reshape(a, (1,) * (rank - jnp.ndim(a)) + jnp.shape(a)) for a in arguments)
    batch = jnp.broadcast_shapes(*(a.shape[:-1] for a in arguments))

    def host(*arrays: Any) -> Any:
        whole = jnp.broadcast_shapes(*(array.shape[:-1] for array in arrays))
        return rows(function, (*whole, *core), len(core), *arrays).astype(dtype)

    shape = jax.ShapeDtypeStruct((*batch, *core), dtype)
    return jax.pure_callback(host, shape, *arguments, vmap_method="expand_dims")


def _with_rule(operation: Operation) -> Callable[..., Any]:
    """Converts an operation with its differentials to a function of JAX."""

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
        raise second_derivative("jax", operation.name)

    def rule(primals: tuple[Any, ...], tangents: tuple[Any, ...]) -> tuple[Any, Any]:
        value = apply(*primals)
        rate = jnp.zeros_like(value)
        for at, tangent in enumerate(tangents):
            if type(tangent) is not jax.custom_derivatives.SymbolicZero:
                rate = rate + jnp.einsum("...ij,...j->...i", differential(at, *primals), tangent).astype(value.dtype)
        return value, rate

    apply.defjvp(rule, symbolic_zeros=True)
    return apply


def _floats(*arguments: Any) -> Any:
    """The floating-point type of a result of these arguments."""
    dtype = jnp.result_type(*arguments)
    return dtype if jnp.issubdtype(dtype, jnp.floating) else jnp.result_type(float)


class Group(DifferentiableGroup):
    __doc__ = DifferentiableGroup.__doc__
    library = "JAX"

    @staticmethod
    def _differentiable(operation: Operation) -> Callable[..., Any]:
        return _with_rule(operation)

    @staticmethod
    def _dtype(*arguments: Any) -> Any:
        return _floats(*arguments)

    def identity(self, dtype: Any = None) -> Any:
        """Identity element.

        Parameters
        ----------
        dtype : dtype, optional
            Floating-point type; by default the default type of JAX.

        Returns
        -------
        array of the shape (coordinates,)

        Examples
        --------
        >>> SE3.identity()  # doctest: +SKIP
        Array([1., 0., 0., 0., 0., 0., 0.], dtype=float32)
        """
        return jnp.asarray(self._group.identity(), dtype=dtype or jnp.result_type(float))

    @staticmethod
    def _real(name: str, value: Any) -> Any:
        """Converts an argument to an array of real numbers."""
        array = jnp.asarray(value)
        if jnp.issubdtype(array.dtype, jnp.complexfloating):
            raise TypeError(f"{name} should be an array of real numbers, not of dtype {array.dtype}")
        return array

    @staticmethod
    def _converted(array: Any, dtype: Any) -> Any:
        """Converts an array to another floating-point type."""
        return array.astype(dtype)


SO2 = Group(af.SO2)
SO3 = Group(af.SO3)
SE2 = Group(af.SE2)
SE3 = Group(af.SE3)
SE2_3 = Group(af.SE2_3)
SL2 = Group(af.SL2)
