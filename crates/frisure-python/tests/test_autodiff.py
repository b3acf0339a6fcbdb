"""Rods at rest in JAX and PyTorch."""

from __future__ import annotations

import importlib
import os
from typing import Any

import frisure
import numpy as np
import pytest
from frisure import rods

SHAPES: dict[str, Any] = {
    "length": [0.08, 0.1, 0.12],
    "diameter": 70e-6,
    "axis_ratio": [1.2, 1.4, 1.6],
    "curl_radius": 0.01,
    "curl_pitch": [0.02, 0.015, 0.03],
    "root": [[0.0, 0.0, 0.0], [0.01, 0.0, 0.0], [0.0, 0.02, 0.0]],
    "tangent": [1.0, 0.5, 0.2],
}
KNOTS: dict[str, Any] = {
    "length": 0.1,
    "natural_strain": (np.random.default_rng(5).normal(size=(3, 4, 3)) * 20 + [50.0, 0.0, 20.0]).tolist(),
    "d1": [0.0, 1.0, 0.1],
}
WEIGHTS = np.random.default_rng(6).normal(size=(3, 21, 3))


def framework(name: str) -> Any:
    """A framework that is there; tests/run sets the variable where it has installed both."""
    if os.environ.get("FRISURE_NEEDS_AUTODIFF"):
        return importlib.import_module(name)
    return pytest.importorskip(name)


def exact(arguments: dict[str, Any]) -> dict[str, Any]:
    """The derivative of the loss by each argument, in its shape."""
    gradient = rods.settle(**arguments, elements=20, derivatives=True).vjp(WEIGHTS)
    found = {}
    for name, value in arguments.items():
        rows = getattr(gradient, name)
        found[name] = rows if np.ndim(value) == rows.ndim else rows.sum(axis=0)
    return found


def torch_gradient(arguments: dict[str, Any]) -> dict[str, Any]:
    torch = framework("torch")
    import frisure.torch

    tensors = {name: torch.tensor(v, dtype=torch.float64, requires_grad=True) for name, v in arguments.items()}
    points = frisure.torch.settle(**tensors, elements=20)
    assert points.dtype == torch.float64 and points.shape == (3, 21, 3)
    (points * torch.as_tensor(WEIGHTS)).sum().backward()
    return {name: tensor.grad.numpy() for name, tensor in tensors.items()}


def jax_gradient(arguments: dict[str, Any]) -> dict[str, Any]:
    jax = framework("jax")
    jax.config.update("jax_enable_x64", True)
    import frisure.jax

    @jax.jit
    def loss(given: dict[str, Any]) -> Any:
        return (frisure.jax.settle(**given, elements=20) * WEIGHTS).sum()

    arrays = {name: jax.numpy.asarray(value) for name, value in arguments.items()}
    return {name: np.asarray(by) for name, by in jax.grad(loss)(arrays).items()}


@pytest.mark.parametrize("arguments", [SHAPES, KNOTS])
@pytest.mark.parametrize("gradient", [torch_gradient, jax_gradient])
def test_gradients_are_those_of_the_library(gradient: Any, arguments: dict[str, Any]) -> None:
    found = gradient(arguments)
    for name, by in exact(arguments).items():
        assert found[name].shape == np.shape(arguments[name]), name
        assert np.allclose(found[name], by, rtol=1e-9, atol=1e-12 * np.abs(by).max()), name


def torch_energy_gradient(arguments: dict[str, Any], weights: Any, by_energy: Any) -> dict[str, Any]:
    torch = framework("torch")
    import frisure.torch

    tensors = {name: torch.tensor(v, dtype=torch.float64, requires_grad=True) for name, v in arguments.items()}
    points, energy = frisure.torch.settle_with_energy(**tensors, elements=20)
    assert energy.dtype == torch.float64 and energy.shape == (3,)
    loss = (energy * torch.as_tensor(by_energy)).sum()
    if weights is not None:
        loss = loss + (points * torch.as_tensor(weights)).sum()
    loss.backward()
    return {name: tensor.grad.numpy() for name, tensor in tensors.items()}


def jax_energy_gradient(arguments: dict[str, Any], weights: Any, by_energy: Any) -> dict[str, Any]:
    jax = framework("jax")
    jax.config.update("jax_enable_x64", True)
    import frisure.jax

    @jax.jit
    def loss(given: dict[str, Any]) -> Any:
        points, energy = frisure.jax.settle_with_energy(**given, elements=20)
        return (energy * by_energy).sum() + (0.0 if weights is None else (points * weights).sum())

    arrays = {name: jax.numpy.asarray(value) for name, value in arguments.items()}
    return {name: np.asarray(by) for name, by in jax.grad(loss)(arrays).items()}


@pytest.mark.parametrize("weights", [WEIGHTS, None])
@pytest.mark.parametrize("gradient", [torch_energy_gradient, jax_energy_gradient])
def test_a_loss_may_have_the_energy(gradient: Any, weights: Any) -> None:
    settled = rods.settle(**SHAPES, elements=20, derivatives=True)
    by_energy = np.array([1.0, -2.0, 3.0]) / settled.energy
    exact = settled.vjp(weights, by_energy=by_energy)
    for name, found in gradient(SHAPES, weights, by_energy).items():
        rows = getattr(exact, name)
        by = rows if np.ndim(SHAPES[name]) == rows.ndim else rows.sum(axis=0)
        assert np.allclose(found, by, rtol=1e-9, atol=1e-12 * np.abs(by).max()), name


def test_a_curl_is_found_by_descent_in_torch() -> None:
    torch = framework("torch")
    import frisure.torch

    # The curl of a hair from its shape: what an apprentice of machine learning does first.
    kept: dict[str, Any] = {"curl_pitch": 0.02, "tangent": [1.0, 0.0, 0.0], "elements": 20}
    target = torch.as_tensor(rods.settle(0.1, curl_radius=0.012, **kept).points)
    radius = torch.tensor(0.010, dtype=torch.float64, requires_grad=True)
    optimizer = torch.optim.LBFGS([radius], line_search_fn="strong_wolfe", max_iter=30)

    def closure() -> Any:
        optimizer.zero_grad()
        loss = ((frisure.torch.settle(0.1, curl_radius=radius, **kept) - target) ** 2).sum() * 1e4
        loss.backward()
        return loss

    optimizer.step(closure)
    assert abs(radius.item() - 0.012) < 1e-6


def test_wrong_arguments_are_told() -> None:
    torch = framework("torch")
    import frisure.torch

    with pytest.raises(frisure.ArgumentError, match="curl_radios is no argument"):
        frisure.torch.settle(0.1, curl_radios=0.1)
    with pytest.raises(frisure.ArgumentError, match="length"):
        frisure.torch.settle(torch.tensor(-0.1, dtype=torch.float64))
    points = frisure.torch.settle(0.1)
    assert points.shape == (1, 16, 3) and not points.requires_grad
    # Whole numbers do not make the points whole.
    points = frisure.torch.settle(0.1, gravity=torch.tensor(10))
    assert points.dtype == torch.float64 and float(points[0, -1, 0]) > 0.0


def test_what_would_lose_a_part_is_refused() -> None:
    torch, jax = framework("torch"), framework("jax")
    import frisure.jax
    import frisure.torch

    for wrong in (torch.tensor(0.1 + 1j), torch.tensor(True), 0.1 + 1j, np.array(0.1 + 0j), True, "abc"):
        with pytest.raises(TypeError, match="length has the dtype"):
            frisure.torch.settle(wrong)
    with pytest.raises(TypeError, match="diameter has the dtype torch.complex"):
        frisure.torch.settle(0.1, diameter=torch.tensor(7e-5 + 0j))
    for wrong in (jax.numpy.asarray(0.1 + 1j), jax.numpy.asarray(True), 0.1 + 1j, True, "abc", None):
        with pytest.raises((TypeError, frisure.ArgumentError), match="length"):
            frisure.jax.settle(wrong)
    half = torch.tensor(0.125, dtype=torch.bfloat16, requires_grad=True)
    frisure.torch.settle(half)[0, -1, 2].backward()
    assert half.grad is not None and half.grad.dtype == torch.bfloat16


@pytest.mark.parametrize("name", ["torch", "jax"])
def test_wrong_options_and_shapes_are_told_before_the_computation(name: str) -> None:
    framework(name)
    settle = importlib.import_module(f"frisure.{name}").settle
    cases: dict[str, dict[str, Any]] = {
        "elements is -5": {"elements": -5},
        "elements is 15.5": {"elements": 15.5},
        "elements is True": {"elements": True},
        "precision is 'half'": {"precision": "half"},
        "curl_radius and natural_strain are both given": {"curl_radius": 0.01, "natural_strain": [0.0, 0.0, 0.0]},
        "curl_pitch is given without": {"curl_pitch": 0.01},
        "root has the shape": {"root": [0.0, 0.0]},
        "axis_ratio has 3 values": {"diameter": [7e-5, 8e-5], "axis_ratio": [1.0, 1.0, 1.0]},
        r"diameter\[0\]": {"diameter": -1.0},
    }
    for message, arguments in cases.items():
        arrays = {key: np.asarray(value) if isinstance(value, list) else value for key, value in arguments.items()}
        with pytest.raises(frisure.ArgumentError, match=message):
            settle(0.1, **arrays)


def test_no_rods_have_no_points_and_no_gradient_in_both() -> None:
    torch, jax = framework("torch"), framework("jax")
    import frisure.jax
    import frisure.torch

    assert frisure.jax.settle(jax.numpy.zeros(0), elements=5).shape == (0, 6, 3)
    assert jax.grad(lambda length: frisure.jax.settle(length).sum())(jax.numpy.zeros(0)).shape == (0,)
    none = torch.zeros(0, dtype=torch.float64, requires_grad=True)
    frisure.torch.settle(none).sum().backward()
    assert none.grad is not None and none.grad.shape == (0,)


def test_vmap_and_single_precision_in_jax() -> None:
    jax = framework("jax")
    import frisure.jax

    def height(radius: Any) -> Any:
        return frisure.jax.settle(0.1, curl_radius=radius, curl_pitch=0.02)[0, -1, 2]

    radii = jax.numpy.asarray([0.01, 0.012], dtype="float32")
    slopes = jax.vmap(jax.grad(height))(radii)
    assert slopes.shape == (2,) and np.isfinite(np.asarray(slopes)).all()
    assert np.isclose(slopes[1], jax.grad(height)(radii[1]), rtol=1e-5)


def test_a_second_derivative_in_torch_is_an_error() -> None:
    torch = framework("torch")
    import frisure.torch

    length = torch.tensor(0.1, dtype=torch.float64, requires_grad=True)
    height = frisure.torch.settle(length, elements=6)[0, -1, 2]
    # By the product alone there would be a number without the part of the rods.
    for loss in (height, height * length):
        (first,) = torch.autograd.grad(loss, length, create_graph=True, retain_graph=True)
        with pytest.raises(frisure.ArgumentError, match="first derivatives alone"):
            torch.autograd.grad(first, length)


def test_gradients_go_through_lists() -> None:
    torch, jax = framework("torch"), framework("jax")
    import frisure.jax
    import frisure.torch

    expected = rods.settle([0.1, 0.2], elements=6, derivatives=True)
    assert expected.points is not None
    loss = np.zeros_like(expected.points)
    loss[0, -1, 2] = 1
    by = expected.vjp(loss).length[0]
    length = torch.tensor(0.1, dtype=torch.float64, requires_grad=True)
    frisure.torch.settle([length, 0.2], elements=6)[0, -1, 2].backward()
    assert float(length.grad) == pytest.approx(by, rel=1e-9)
    height = jax.grad(lambda length: frisure.jax.settle([length, 0.2], elements=6)[0, -1, 2])
    assert float(height(0.1)) == pytest.approx(by, rel=1e-5)
    with pytest.raises(frisure.ArgumentTypeError, match="length is no array of numbers"):
        rods.settle(length)
    with pytest.raises(frisure.ArgumentTypeError, match="length is no array of numbers"):
        frisure.jax.settle([[0.1], [0.1, 0.2]])


def test_lists_with_tensors_in_them_are_checked_as_others_are() -> None:
    torch = framework("torch")
    import frisure.torch

    tensor = torch.tensor(0.1, dtype=torch.float64)
    masked = np.ma.array([9.0, 9.0, 9.0], mask=True)
    for arguments, words in [
        ({"length": [tensor, True]}, "bool"),
        ({"length": [tensor, torch.tensor(0.1 + 5j)]}, "complex"),
        ({"length": 0.1, "root": [[tensor, 0.0, 0.0], masked]}, "masked"),
        ({"length": torch.tensor([0.1]).to_sparse()}, "sparse"),
        ({"length": torch.tensor([0.1], device="meta")}, "meta"),
    ]:
        with pytest.raises(frisure.FrisureError, match=words):
            frisure.torch.settle(**arguments)
