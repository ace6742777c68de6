"""Lie groups in PyTorch: the operations of :mod:`affinor` with derivatives, for ``autograd`` and ``torch.func``.

The engine computes values and derivatives in float64 on the CPU and rounds them to the type of the arguments. Tensors on other
devices are copied to the CPU and back. Derivatives are in closed form, so they are finite at the identity and at half a turn. A
row without a result, such as the logarithm of zeros, is NaN. Second derivatives raise NotImplementedError.

Examples
--------
>>> import torch                          # doctest: +SKIP
>>> from affinor.torch import SO3         # doctest: +SKIP
>>> x = torch.zeros(3, requires_grad=True)  # doctest: +SKIP
>>> SO3.exp(x).sum().backward()           # doctest: +SKIP
>>> x.grad                                # doctest: +SKIP
tensor([0.5000, 0.5000, 0.5000])
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

try:
    import torch
except ImportError as _missing:
    raise ImportError("affinor.torch needs PyTorch: pip install 'affinor[torch]'") from _missing

import affinor as af
from affinor._differentials import DifferentiableGroup, Operation, rows, second_derivative

__all__ = ["SE2", "SE3", "SE2_3", "SL2", "SO2", "SO3", "Group"]


def _on_host(function: Any, core: tuple[int, ...], arguments: tuple[Any, ...]) -> Any:
    """Calls a function with NumPy arrays. The result is a tensor with the type and the device of the first argument."""
    first = arguments[0]
    batch = torch.broadcast_shapes(*(argument.shape[:-1] for argument in arguments))
    arrays = [argument.detach().to("cpu", torch.float64).numpy() for argument in arguments]
    found = rows(function, (*batch, *core), len(core), *arrays)
    return torch.from_numpy(np.require(found, requirements=["C", "W"])).to(first.device, first.dtype)


def _in_front(in_dims: Any, arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """Moves the axis of vmap to the front of each argument, and makes the ranks of the arguments equal."""
    given = zip(arguments, in_dims, strict=True)
    moved = [a[None] if axis is None else a.movedim(axis, 0) for a, axis in given]
    rank = max(a.dim() for a in moved)
    return tuple(a.reshape(a.shape[0], *(1,) * (rank - a.dim()), *a.shape[1:]) for a in moved)


class _Differential(torch.autograd.Function):
    """The matrices of a differential, which have no derivatives."""

    @staticmethod
    def forward(operation: Operation, at: int, *arguments: Any) -> Any:
        width = operation.width(*(argument.shape[-1] for argument in arguments))
        return _on_host(operation.differentials[at], (width, arguments[at].shape[-1]), arguments)

    @staticmethod
    def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
        ctx.name = inputs[0].name

    @staticmethod
    def backward(ctx: Any, *gradients: Any) -> Any:
        raise second_derivative("torch", ctx.name)

    @staticmethod
    def jvp(ctx: Any, *tangents: Any) -> Any:
        raise second_derivative("torch", ctx.name)

    @staticmethod
    def vmap(info: Any, in_dims: Any, operation: Operation, at: int, *arguments: Any) -> Any:
        return _Differential.apply(operation, at, *_in_front(in_dims[2:], arguments)), 0


class _Apply(torch.autograd.Function):
    """An operation, whose derivatives are its differentials."""

    @staticmethod
    def forward(operation: Operation, *arguments: Any) -> Any:
        width = operation.width(*(argument.shape[-1] for argument in arguments))
        return _on_host(operation.result, (width,), arguments)

    @staticmethod
    def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
        ctx.operation, *arguments = inputs
        ctx.save_for_backward(*arguments)
        ctx.save_for_forward(*arguments)

    @staticmethod
    def backward(ctx: Any, *gradients: Any) -> Any:
        found: list[Any] = [None]
        for at, argument in enumerate(ctx.saved_tensors):
            if not ctx.needs_input_grad[at + 1]:
                found.append(None)
                continue
            matrix = _Differential.apply(ctx.operation, at, *ctx.saved_tensors)
            whole = torch.einsum("...ij,...i->...j", matrix, gradients[0])
            found.append(whole.sum_to_size(argument.shape))
        return tuple(found)

    @staticmethod
    def jvp(ctx: Any, _: Any, *tangents: Any) -> Any:
        rate: Any = None
        for at, tangent in enumerate(tangents):
            if tangent is None:
                continue
            matrix = _Differential.apply(ctx.operation, at, *ctx.saved_tensors)
            part = torch.einsum("...ij,...j->...i", matrix, tangent)
            rate = part if rate is None else rate + part
        return rate

    @staticmethod
    def vmap(info: Any, in_dims: Any, operation: Operation, *arguments: Any) -> Any:
        return _Apply.apply(operation, *_in_front(in_dims[1:], arguments)), 0


class Group(DifferentiableGroup):
    __doc__ = DifferentiableGroup.__doc__
    library = "PyTorch"

    def identity(self, dtype: Any = None, device: Any = None) -> Any:
        """Identity element.

        Parameters
        ----------
        dtype : torch.dtype, optional
            Floating-point type; by default the default type of PyTorch.
        device : torch.device, optional
            Device of the tensor; by default the CPU.

        Returns
        -------
        tensor of the shape (coordinates,)

        Examples
        --------
        >>> SE3.identity()  # doctest: +SKIP
        tensor([1., 0., 0., 0., 0., 0., 0.])
        """
        return torch.as_tensor(self._group.identity(), dtype=dtype or torch.get_default_dtype(), device=device)

    @staticmethod
    def _differentiable(operation: Operation) -> Any:
        """Converts an operation with its differentials to a function of PyTorch."""
        return partial(_Apply.apply, operation)

    @staticmethod
    def _real(name: str, value: Any) -> Any:
        """Converts an argument to a tensor of real numbers."""
        tensor = torch.as_tensor(value)
        if tensor.is_complex():
            raise TypeError(f"{name} should be a tensor of real numbers, not of dtype {tensor.dtype}")
        return tensor

    @staticmethod
    def _dtype(*arguments: Any) -> Any:
        """The floating-point type of a result of these arguments."""
        dtype = arguments[0].dtype
        for argument in arguments[1:]:
            dtype = torch.promote_types(dtype, argument.dtype)
        return dtype if dtype.is_floating_point else torch.get_default_dtype()

    @staticmethod
    def _converted(array: Any, dtype: Any) -> Any:
        """Converts a tensor to another floating-point type."""
        return array.to(dtype)


SO2 = Group(af.SO2)
SO3 = Group(af.SO3)
SE2 = Group(af.SE2)
SE3 = Group(af.SE3)
SE2_3 = Group(af.SE2_3)
SL2 = Group(af.SL2)
