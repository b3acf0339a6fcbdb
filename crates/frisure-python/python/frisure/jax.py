"""Rods at rest for JAX: `settle` and `settle_with_energy` with gradients, also inside `jax.jit`. Needs `jax`, which frisure does not install.

>>> import jax
>>> import frisure.jax
>>> def height_of_the_tip(radius):
...     return frisure.jax.settle(0.15, curl_radius=radius, curl_pitch=1e-2, elements=30)[0, -1, 2]
>>> bool(jax.grad(height_of_the_tip)(5e-3) > 0)          # a wider curl is shorter
True
"""

from __future__ import annotations

from functools import partial
from typing import Any

import jax  # type: ignore[import-not-found, unused-ignore]
import jax.numpy as jnp  # type: ignore[import-not-found, unused-ignore]
import numpy as np

from frisure import _autodiff, rods
from frisure._check import unmasked, without_bools
from frisure.errors import ArgumentTypeError

__all__ = ["settle", "settle_with_energy"]

_Options = tuple[tuple[str, Any], ...]

_Rest = tuple[jax.Array, jax.Array]
"""The nodes and the energies."""


def _like(shape: tuple[int, ...], kind: Any) -> Any:
    return jax.ShapeDtypeStruct(shape, kind)  # type: ignore[no-untyped-call, unused-ignore]


def _doubles(given: dict[str, Any]) -> dict[str, Any]:
    """The arrays of a callback for NumPy, which has no half precision of eight exponents."""
    return {name: np.asarray(value, dtype=np.float64) for name, value in given.items()}


def _real(name: str, value: Any) -> jax.Array:
    """A real number or array as JAX has them; a complex one would lose its imaginary part."""
    unmasked(name, value)
    without_bools(name, value)
    if isinstance(value, (list, tuple)):
        try:
            # A list may have arrays of JAX in it, also such that it traces.
            value = jnp.asarray(value)
        except (TypeError, ValueError) as error:
            raise ArgumentTypeError(f"{name} is no array of numbers: {error}") from None
    kind = value.dtype if hasattr(value, "dtype") else np.asarray(value).dtype
    if not (jnp.issubdtype(kind, jnp.floating) or jnp.issubdtype(kind, jnp.integer)):
        raise ArgumentTypeError(f"{name} has the dtype {kind}; it must be real numbers in SI units")
    return jnp.asarray(value, dtype=float)


@partial(jax.custom_vjp, nondiff_argnums=(0,))  # type: ignore[untyped-decorator, unused-ignore]
def _rest(options: _Options, arguments: dict[str, jax.Array]) -> _Rest:
    kind = jnp.result_type(*arguments.values())
    count = _autodiff.count({name: value.shape for name, value in arguments.items()})
    shape = (count, dict(options).get("elements", 15) + 1, 3)
    if count == 0:
        return jnp.zeros(shape, kind), jnp.zeros(0, kind)

    def host(given: dict[str, Any]) -> Any:
        settled = _autodiff.settle(_doubles(given), dict(options), derivatives=False)
        return _autodiff.points(settled).astype(kind), settled.energy.astype(kind)

    like = (_like(shape, kind), _like((count,), kind))
    found: _Rest = jax.pure_callback(host, like, arguments, vmap_method="sequential")
    return found


def _forward(options: _Options, arguments: dict[str, jax.Array]) -> tuple[_Rest, dict[str, jax.Array]]:
    return _rest(options, arguments), arguments


def _backward(options: _Options, arguments: dict[str, jax.Array], by_rest: _Rest) -> tuple[dict[str, jax.Array]]:
    shapes = {name: _like(value.shape, value.dtype) for name, value in arguments.items()}

    if by_rest[0].shape[0] == 0:
        return ({name: jnp.zeros(shape.shape, shape.dtype) for name, shape in shapes.items()},)

    def host(given: dict[str, Any], by_points: Any, by_energy: Any) -> Any:
        # The equilibria are computed again: JAX keeps arrays alone from one pass to the other.
        settled = _autodiff.settle(_doubles(given), dict(options), derivatives=True)
        by_points, by_energy = (np.asarray(by, dtype=np.float64) for by in (by_points, by_energy))
        gradient = settled.vjp(by_points, by_energy=by_energy)
        return {
            name: _autodiff.derivative(gradient, name, shape.shape).astype(shape.dtype)
            for name, shape in shapes.items()
        }

    found = jax.pure_callback(host, shapes, arguments, *by_rest, vmap_method="sequential")
    return (found,)


_rest.defvjp(_forward, _backward)


def settle(length: Any, **keywords: Any) -> jax.Array:
    """The nodes of H rods at rest (m), (H, P, 3), with the arguments of `frisure.rods.settle`: `length`, `diameter`, `axis_ratio`,
    `youngs_modulus`, `shear_modulus`, `density`, `gravity`, `curl_radius`, `curl_pitch`, `natural_strain`, `root`, `tangent`, `d1`
    as arrays or numbers, and `elements` and `precision`.

    Gradients go to all of them, once (no second derivatives). The computation is on the processor, in float64; the points have the
    type of the arguments, float32 unless `jax_enable_x64` is set. Rods without derivatives (`rods.Gradient.exists`) get zeros.

    Wrong shapes and options are an `ArgumentError`, and so are wrong numbers where JAX traces none of the arguments; of those that it
    traces, such as the ones that are differentiated, only the computation sees the numbers, and JAX raises an error of its own.
    """
    return settle_with_energy(length, **keywords)[0]


def settle_with_energy(length: Any, **keywords: Any) -> _Rest:
    """The nodes of H rods at rest (m), (H, P, 3), and their potential energies (J), (H,): elastic, and of the weight, which is 0 at the height of the
    root. Arguments, types, gradients and errors are those of `settle`.

    >>> bool(jax.grad(lambda length: settle_with_energy(length)[1][0])(0.1) < 0)     # a longer rod hangs lower
    True
    """
    arguments, options = _autodiff.split({"length": length, **keywords})
    arrays = {name: _real(name, value) for name, value in arguments.items()}
    _autodiff.count({name: value.shape for name, value in arrays.items()})
    if not any(isinstance(value, jax.core.Tracer) for value in arrays.values()):
        rods._check(_doubles(arrays))
    found: _Rest = _rest(tuple(sorted(options.items())), arrays)
    return found
