"""What the functions for JAX and PyTorch share: which arguments are differentiated, and their derivatives in the right shape."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from frisure import rods
from frisure.errors import ArgumentError

Float64 = NDArray[np.float64]

DIFFERENTIABLE = (
    "length",
    "diameter",
    "axis_ratio",
    "youngs_modulus",
    "shear_modulus",
    "density",
    "gravity",
    "curl_radius",
    "curl_pitch",
    "natural_strain",
    "root",
    "tangent",
    "d1",
)
"""The arguments of `rods.settle` that have derivatives."""

VECTORS = ("root", "tangent", "d1")
"""Those that have three numbers for each rod."""

OPTIONS = ("elements", "precision")
"""The others that change the points."""


def split(keywords: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The arguments that have derivatives, and the options."""
    unknown = [name for name in keywords if name not in DIFFERENTIABLE + OPTIONS]
    if unknown:
        known = ", ".join(DIFFERENTIABLE + OPTIONS)
        raise ArgumentError(f"{unknown[0]} is no argument of this function; it has {known}")
    options = {name: keywords[name] for name in OPTIONS if name in keywords}
    if options:
        elements, precision = rods._options(options.get("elements", 15), options.get("precision", "double"))
        options = {"elements": elements, "precision": precision}
    arguments = {name: value for name, value in keywords.items() if name not in OPTIONS and value is not None}
    if "length" not in arguments:
        raise ArgumentError("length is None; it must be a number or (H,)")
    rods._natural(arguments)
    return arguments, options


def count(shapes: dict[str, tuple[int, ...]]) -> int:
    """The number of rods H of arguments in these shapes."""
    alike: dict[str, Any] = {}
    for name, shape in shapes.items():
        # Arrays without memory: only their shapes are looked at.
        array = np.broadcast_to(np.float64(0), shape)
        if name == "natural_strain":
            alike[name] = rods._profiles(name, array)
        else:
            alike[name] = (rods._vectors if name in VECTORS else rods._numbers)(name, array)
    return rods._count(alike)


def settle(arguments: dict[str, Any], options: dict[str, Any], *, derivatives: bool) -> rods.Settled:
    """The rods."""
    return rods.settle(**arguments, **options, derivatives=derivatives)


def points(settled: rods.Settled) -> Float64:
    """The nodes, (H, P, 3)."""
    assert settled.points is not None
    return settled.points


def derivative(gradient: rods.Gradient, name: str, shape: tuple[int, ...]) -> Float64:
    """By one argument of that shape: the sum over rods where it was one for all."""
    rows = getattr(gradient, name)
    per_rod: Float64 = np.zeros((len(gradient), *shape[1:])) if rows is None else rows
    if name == "natural_strain":
        alike = len(shape) == 1 or shape[0] == 1 < len(gradient)
    else:
        scalar = per_rod.ndim - 1
        alike = len(shape) == scalar or (len(shape) > scalar and shape[0] == 1 < len(gradient))
    found = per_rod.sum(axis=0) if alike else per_rod
    return np.asarray(found, dtype=np.float64).reshape(shape)
