"""Rods at rest for PyTorch: `settle` and `settle_with_energy`, with gradients. Needs `torch`, which frisure does not install.

>>> import torch
>>> import frisure.torch
>>> radius = torch.tensor(5e-3, dtype=torch.float64, requires_grad=True)
>>> points = frisure.torch.settle(0.15, curl_radius=radius, curl_pitch=1e-2, elements=30)
>>> points[0, -1, 2].backward()               # the height of the tip
>>> bool(radius.grad > 0)                     # a wider curl is shorter
True
"""

from __future__ import annotations

from functools import reduce
from typing import Any

import torch  # type: ignore[import-not-found, unused-ignore]

from frisure import _autodiff, rods
from frisure._check import array as _array
from frisure.errors import ArgumentError, ArgumentTypeError

__all__ = ["settle", "settle_with_energy"]


def _check_real(name: str, tensor: torch.Tensor) -> None:
    """Refuses what has no real numbers; a complex tensor would lose its imaginary part."""
    if tensor.is_complex() or tensor.dtype == torch.bool:
        raise ArgumentTypeError(f"{name} has the dtype {tensor.dtype}; it must be real numbers in SI units")
    if tensor.layout != torch.strided or tensor.is_meta:
        kind = "meta" if tensor.is_meta else str(tensor.layout)
        raise ArgumentTypeError(f"{name} is a tensor of the kind {kind}; it must have its numbers in memory, as `to_dense()` makes them")


def _numpy(name: str, tensor: torch.Tensor) -> Any:
    """A real tensor as an array."""
    _check_real(name, tensor)
    given = tensor.detach().cpu()
    # NumPy has no bfloat16.
    return (given.double() if given.is_floating_point() else given).numpy()


def _joined(name: str, value: Any) -> Any:
    """A list with tensors in it as one tensor, through which gradients go to each; other values as they are."""
    if not isinstance(value, (list, tuple)):
        return value
    parts = [_joined(name, part) for part in value]
    if not any(isinstance(part, torch.Tensor) for part in parts):
        return value
    for part in parts:
        # Stacking would take bools for numbers, and drop imaginary parts and masks.
        _check_real(name, part) if isinstance(part, torch.Tensor) else _array(name, part)
    try:
        return torch.stack([torch.as_tensor(part, dtype=torch.float64) for part in parts])
    except (RuntimeError, ValueError, TypeError) as error:
        raise ArgumentError(f"{name} is no tensor: {error}") from None


class _Once(torch.autograd.Function):  # type: ignore[misc, unused-ignore]
    """A gradient that depends on tensors, and cannot be differentiated by them. PyTorch's own mark does not stand between a gradient
    and the tensors, so that a second derivative by one of them would silently lack this part."""

    @staticmethod
    def forward(ctx: Any, gradient: torch.Tensor, *tensors: torch.Tensor) -> torch.Tensor:
        return gradient.clone()

    @staticmethod
    def backward(ctx: Any, *by: torch.Tensor) -> Any:
        raise ArgumentError("rods at rest have first derivatives alone here; their gradients cannot be differentiated once more")


class _Settle(torch.autograd.Function):  # type: ignore[misc, unused-ignore]
    @staticmethod
    def forward(
        ctx: Any, keywords: dict[str, Any], options: dict[str, Any], names: list[str], *tensors: torch.Tensor
    ) -> tuple[torch.Tensor, torch.Tensor]:
        arrays = {name: _numpy(name, tensor) for name, tensor in zip(names, tensors, strict=True)}
        settled = _autodiff.settle(keywords | arrays, options, derivatives=any(ctx.needs_input_grad))
        ctx.settled, ctx.names = settled, names
        ctx.save_for_backward(*tensors)
        ctx.kinds = [(tensor.shape, tensor.dtype, tensor.device) for tensor in tensors]
        kinds = [tensor.dtype for tensor in tensors if tensor.is_floating_point()]
        kind = reduce(torch.promote_types, kinds) if kinds else torch.float64
        device = tensors[0].device if tensors else None
        points = torch.as_tensor(_autodiff.points(settled), dtype=kind, device=device)
        return points, torch.as_tensor(settled.energy, dtype=kind, device=device)

    @staticmethod
    def backward(ctx: Any, by_points: torch.Tensor, by_energy: torch.Tensor) -> tuple[Any, ...]:
        settled: rods.Settled = ctx.settled
        gradient = settled.vjp(_numpy("by_points", by_points), by_energy=_numpy("by_energy", by_energy))
        sources = [tensor for tensor in (*ctx.saved_tensors, by_points, by_energy) if tensor.requires_grad]
        found: list[torch.Tensor | None] = []
        for index, (name, (shape, dtype, device)) in enumerate(zip(ctx.names, ctx.kinds, strict=True)):
            if ctx.needs_input_grad[3 + index]:
                by = _autodiff.derivative(gradient, name, tuple(shape))
                gradient_by = torch.as_tensor(by, dtype=dtype, device=device)
                if torch.is_grad_enabled():
                    gradient_by = _Once.apply(gradient_by, *sources)  # type: ignore[no-untyped-call, unused-ignore]
                found.append(gradient_by)
            else:
                found.append(None)
        return (None, None, None, *found)


def settle(length: Any, **keywords: Any) -> torch.Tensor:
    """The nodes of H rods at rest (m), (H, P, 3), with the arguments of `frisure.rods.settle`: `length`, `diameter`, `axis_ratio`,
    `youngs_modulus`, `shear_modulus`, `density`, `gravity`, `curl_radius`, `curl_pitch`, `natural_strain`, `root`, `tangent`, `d1`
    as tensors, arrays or numbers, and `elements` and `precision`.

    Gradients go to all tensors that require them, once (no second derivatives). The computation is on the processor, in float64;
    the points have the tensors' widest type, and are on the device of the first. Rods without derivatives (`rods.Gradient.exists`)
    get zeros.
    """
    return settle_with_energy(length, **keywords)[0]


def settle_with_energy(length: Any, **keywords: Any) -> tuple[torch.Tensor, torch.Tensor]:
    """The nodes of H rods at rest (m), (H, P, 3), and their potential energies (J), (H,): elastic, and of the weight, which is 0 at the height of the
    root. Arguments, types and gradients are those of `settle`.

    >>> length = torch.tensor(0.1, dtype=torch.float64, requires_grad=True)
    >>> points, energy = settle_with_energy(length)
    >>> energy[0].backward()
    >>> bool(length.grad < 0)                     # a longer rod hangs lower
    True
    """
    arguments, options = _autodiff.split({"length": length, **keywords})
    arguments = {name: _joined(name, value) for name, value in arguments.items()}
    tensors = {name: value for name, value in arguments.items() if isinstance(value, torch.Tensor)}
    others = {name: value for name, value in arguments.items() if name not in tensors}
    points, energy = _Settle.apply(others, options, list(tensors), *tensors.values())  # type: ignore[no-untyped-call, unused-ignore]
    return points, energy
