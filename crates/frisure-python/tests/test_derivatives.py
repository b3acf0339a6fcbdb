"""Derivatives of rods at rest, against differences of the solver."""

from __future__ import annotations

import pickle
from typing import Any

import frisure
import numpy as np
import pytest
from frisure import rods

ANGLE = np.linspace(0, 2 * np.pi, 7, endpoint=False)
RODS: dict[str, Any] = {
    "length": np.linspace(0.05, 0.12, 7),
    "diameter": np.linspace(60e-6, 90e-6, 7),
    "axis_ratio": 1.4,
    "youngs_modulus": 3.9e9,
    "shear_modulus": np.full(7, 0.9e9),
    "density": 1300.0,
    "gravity": 9.81,
    "root": np.random.default_rng(1).normal(size=(7, 3)) * 0.01,
    "tangent": np.stack([2 * np.cos(ANGLE), 2 * np.sin(ANGLE), 0.3 + 0 * ANGLE], axis=1),
    "d1": np.array([0.1, 0.2, 1.5]),
}
CURL: dict[str, Any] = {"curl_radius": np.linspace(5e-3, 2e-2, 7), "curl_pitch": 1.5e-2}
KNOTS: dict[str, Any] = {"natural_strain": np.random.default_rng(2).normal(size=(7, 4, 3)) * 30 + [60.0, 0.0, 20.0]}
OPTIONS: dict[str, Any] = {"elements": 20, "tolerance": 1e-12}


def loss_of(points: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """A loss of each rod, and its derivative by the points."""
    return (points * WEIGHTS).sum(axis=(1, 2))


WEIGHTS = np.random.default_rng(3).normal(size=(7, 21, 3))


def difference(arguments: dict[str, Any], name: str, index: tuple[int, ...]) -> np.ndarray[Any, Any]:
    """By one number of each rod, (7,)."""
    value = np.asarray(arguments[name], dtype=np.float64)
    size = np.abs(value).max() if name not in ("root", "natural_strain") else {"root": 0.01, "natural_strain": 30.0}[name]
    step = 1e-4 * size
    values = []
    for k in (-2, -1, 1, 2):
        changed = value.copy()
        changed[(..., *index)] += k * step
        points = rods.settle(**{**arguments, name: changed}, **OPTIONS).points
        assert points is not None
        values.append(loss_of(points))
    return np.asarray((values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * step))


@pytest.mark.parametrize("natural", [CURL, KNOTS, {"natural_strain": np.array([50.0, 5.0, 20.0])}])
def test_each_argument_has_the_derivative_that_differences_have(natural: dict[str, Any]) -> None:
    arguments = RODS | natural
    rest = rods.settle(**arguments, **OPTIONS, derivatives=True)
    gradient = rest.vjp(WEIGHTS)
    assert gradient.exists.all() and gradient.regular.all() and len(gradient) == 7
    for name, value in arguments.items():
        exact = getattr(gradient, name)
        for index in np.ndindex(exact.shape[1:]):
            found = difference(arguments, name, index)
            size = np.abs(exact).max()
            assert np.allclose(exact[(slice(None), *index)], found, rtol=1e-5, atol=1e-6 * size), (name, index)
        assert np.ndim(value) <= exact.ndim
    assert (gradient.curl_radius is None) == ("natural_strain" in natural)


@pytest.mark.parametrize("natural", [CURL, KNOTS, {"natural_strain": np.array([50.0, 5.0, 20.0])}])
def test_energies_and_frames_have_the_derivatives_that_differences_have(natural: dict[str, Any]) -> None:
    arguments = RODS | natural
    rest = rods.settle(**arguments, **OPTIONS, derivatives=True, frames=True)
    assert rest.frames is not None and rest.points is not None
    # A frame is a rotation, whose last row is the tangent: at the clamp that which was given.
    assert np.allclose(rest.frames @ np.swapaxes(rest.frames, -1, -2), np.eye(3))
    tangent = np.asarray(RODS["tangent"])
    assert np.allclose(rest.frames[:, 0, 2], tangent / np.linalg.norm(tangent, axis=1, keepdims=True))
    # Σ W·F has along a rotation ω of the frame F the derivative ω·Σ f × w, over the rows f of F and w of W.
    weights = np.random.default_rng(5).normal(size=rest.frames.shape)
    by_frames = np.cross(rest.frames, weights).sum(axis=-2)
    scale = 1.0 / np.abs(rest.energy)
    gradient = rest.vjp(by_frames=by_frames, by_energy=scale)
    energy = rest.vjp(by_energy=scale)
    assert (energy.eigenvalue_bound == 1.0).all() and not energy.root.any()
    for name, value in arguments.items():
        exact, of_energy = getattr(gradient, name), getattr(energy, name)
        for index in np.ndindex(exact.shape[1:]):
            given = np.asarray(value, dtype=np.float64)
            size = np.abs(given).max() if name not in ("root", "natural_strain") else {"root": 0.01, "natural_strain": 30.0}[name]
            step, values = 1e-4 * size, []
            for k in (-2, -1, 1, 2):
                changed = given.copy()
                changed[(..., *index)] += k * step
                moved = rods.settle(**{**arguments, name: changed}, **OPTIONS, frames=True)
                values.append(np.stack([(moved.frames * weights).sum(axis=(1, 2, 3)), moved.energy * scale]))
            frames, energies = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * step)
            row = (slice(None), *index)
            assert np.allclose(of_energy[row], energies, rtol=1e-5, atol=1e-6 * np.abs(of_energy).max() + 1e-9), (name, index)
            assert np.allclose(exact[row], frames + energies, rtol=1e-5, atol=1e-6 * np.abs(exact).max() + 1e-8), (name, index)


def test_the_smallest_eigenvalue_says_how_near_a_loss_of_stability_is() -> None:
    curl: dict[str, Any] = {"curl_radius": 5e-3, "curl_pitch": 0.02, "eigenvalue": True}
    assert rods.settle(0.15, curl_radius=5e-3, curl_pitch=0.02).eigenvalue is None
    free = rods.settle(0.15, gravity=0.0, **curl).eigenvalue
    hanging = rods.settle(0.15, tangent=[0, 0, -1], eigenvalue=True).eigenvalue
    # Weight stretches straight hair, and leaves its twist alone.
    assert free is not None and free[0] == pytest.approx(1.0) and hanging is not None and hanging[0] == pytest.approx(1.0)
    held_out = rods.settle([0.02, 0.05], **curl).eigenvalue
    assert held_out is not None and 0 < held_out[1] < held_out[0] < 1
    # No loss meets a rod more softly.
    rest = rods.settle(**(RODS | KNOTS), **OPTIONS, derivatives=True, eigenvalue=True)
    assert rest.eigenvalue is not None and (rest.vjp(WEIGHTS).eigenvalue_bound >= rest.eigenvalue * (1 - 1e-9)).all()
    # Upright, near the load at which it falls over (Greenhill: 7.8373), where the quotient is as the load that is missing.
    fibre = 3e9 * np.pi * (40e-6) ** 4 / 4 / (1300 * 9.81 * np.pi * (40e-6) ** 2)
    lengths = (np.array([0.9, 0.95]) * 7.8373 * fibre) ** (1 / 3)
    upright = {"diameter": 80e-6, "youngs_modulus": 3e9, "shear_modulus": 1e9, "tangent": [0, 0, 1], "elements": 48}
    found = rods.settle(lengths, **upright, eigenvalue=True).eigenvalue
    assert found is not None and np.allclose(found, [0.1, 0.05], atol=2e-3)


def test_frames_count_too() -> None:
    arguments = RODS | CURL
    rest = rods.settle(**arguments, **OPTIONS, derivatives=True)
    zero = np.zeros((7, 21, 3))
    # A turn of the clamp about the root turns all frames: their sum is its derivative, but for the weight.
    frames = zero.copy()
    frames[:, 0] = [1.0, 2.0, 3.0]
    gradient = rest.vjp(zero, frames)
    assert np.allclose(gradient.root_rotation, [1.0, 2.0, 3.0])
    assert np.abs(gradient.half_strain).max() == 0.0
    frames[:, -1] = [1.0, 2.0, 3.0]
    assert np.abs(rest.vjp(zero, frames).half_strain).max() > 0.0


def test_straight_hair_and_saddles_say_so() -> None:
    gradient = rods.settle(0.05, derivatives=True).vjp(np.ones((1, 16, 3)))
    assert gradient.curl_radius is not None and gradient.curl_radius[0] == 0.0
    # Upright, at 0.999 of the load at which it falls over (Greenhill: 7.8373); at 0.9999 these elements lean, to no side.
    fibre = 3e9 * np.pi * (40e-6) ** 4 / 4 / (1300 * 9.81 * np.pi * (40e-6) ** 2)
    length = (0.999 * 7.8373 * fibre) ** (1 / 3)
    upright = {"diameter": 80e-6, "youngs_modulus": 3e9, "shear_modulus": 1e9, "tangent": [0, 0, 1], "elements": 24}
    rest = rods.settle([0.5 * length, length], **upright, derivatives=True)
    for products in (rest.vjp(np.ones((2, 25, 3))), rest.jvp(density=1.0)):
        assert products.exists.all()
        assert products.regular.tolist() == [True, False]


def test_what_rounding_decides_is_not_called_stable() -> None:
    # 1e4 and 1e12 times as heavy as stiff.
    rest = rods.settle(1.0, youngs_modulus=[4e9, 40.0e3], shear_modulus=[1e9, 10.0e3], gravity=[9.81, 9.81e3], elements=30)
    assert rest.stable.tolist() == [True, False]


def test_what_cannot_be_differentiated_is_told() -> None:
    rest = rods.settle(0.1)
    with pytest.raises(frisure.ArgumentError, match="derivatives=True"):
        rest.vjp(np.zeros((1, 16, 3)))
    rest = rods.settle(0.1, derivatives=True)
    with pytest.raises(frisure.ArgumentError, match="there is no loss"):
        rest.vjp()
    with pytest.raises(frisure.ArgumentError, match="by_energy has 2 values for 1 rods"):
        rest.vjp(by_energy=[1.0, 2.0])
    with pytest.raises(frisure.ArgumentError, match=r"by_energy\[0\] is inf"):
        rest.vjp(by_energy=np.inf)
    with pytest.raises(frisure.ArgumentError, match="by_points has the shape"):
        rest.vjp(np.zeros((1, 15, 3)))
    with pytest.raises(frisure.ArgumentError, match="by_frames has the shape"):
        rest.vjp(np.zeros((1, 16, 3)), np.zeros((2, 16, 3)))
    bad = np.zeros((1, 16, 3))
    bad[0, 3, 1] = np.nan
    for given in (bad, np.asfortranarray(bad), bad.astype(np.float32)):
        with pytest.raises(frisure.ArgumentError, match=r"by_points\[0, 3, 1\] is nan"):
            rest.vjp(given)
    bad[0, 2, 2] = -np.inf
    with pytest.raises(frisure.ArgumentError, match=r"by_frames\[0, 2, 2\] is -inf"):
        rest.vjp(None, bad)
    again = pickle.loads(pickle.dumps(rest))
    assert np.array_equal(again.points, rest.points)
    with pytest.raises(frisure.ArgumentError, match="in this process"):
        again.vjp(np.zeros((1, 16, 3)))
    none = rods.settle(np.zeros(0), derivatives=True).vjp(np.zeros((0, 16, 3)))
    assert none.half_strain.shape == (0, 30, 3) and len(none) == 0
    strided = np.zeros((1, 32, 6))[:, ::2, ::2]
    assert rest.vjp(strided).length.shape == (1,)
    assert rest.vjp(strided.astype(np.float32)).length[0] == 0.0


def test_the_result_does_not_depend_on_those_beside_it() -> None:
    length = np.linspace(0.05, 0.2, 1500)
    weights = np.random.default_rng(4).normal(size=(1500, 16, 3))
    curl: dict[str, Any] = {"curl_radius": 0.01, "curl_pitch": 0.01, "derivatives": True}
    together = rods.settle(length, **curl).vjp(weights)
    alone = rods.settle(length[1300], **curl).vjp(weights[1300:1301])
    assert together.length[1300] == alone.length[0]
    assert np.array_equal(together.half_strain[1300], alone.half_strain[0])


EXTRA: dict[str, tuple[int, ...]] = {"gravity_vector": (3,), "root_rotation": (3,), "half_strain": (40, 3)}
"""Changes of what is no argument of `settle`, and their shapes for a rod."""


def changes_of(arguments: dict[str, Any], seed: int) -> dict[str, np.ndarray[Any, Any]]:
    """A random change of each argument, of a thousandth of its size, with a row for each rod."""
    random, found = np.random.default_rng(seed), {}
    for name, value in arguments.items():
        size = np.abs(value).max()
        shape = (7, *np.shape(value)[-1:]) if name in ("root", "tangent", "d1", "natural_strain") else (7,)
        if np.ndim(value) == 3:
            shape = np.shape(value)
        found[name] = 1e-3 * size * random.normal(size=shape)
    return found


@pytest.mark.parametrize("natural", [CURL, KNOTS, {"natural_strain": np.array([50.0, 5.0, 20.0])}])
@pytest.mark.parametrize("gravity", [9.81, 0.0])
def test_forward_products_are_differences_and_agree_with_backward_ones(natural: dict[str, Any], gravity: float) -> None:
    arguments = RODS | natural | {"gravity": gravity}
    rest = rods.settle(**arguments, **OPTIONS, derivatives=True)
    assert rest.points is not None
    frames = np.random.default_rng(9).normal(size=WEIGHTS.shape)
    # An energy in the unit of the other losses.
    by_energy = 1e8 * np.arange(1.0, 8.0)
    gradient = rest.vjp(WEIGHTS, frames, by_energy=by_energy)
    everything = changes_of({**arguments, "gravity": 9.81}, 8)
    # One by one and all together: against differences of the solver.
    for names in [*([name] for name in everything), list(everything)]:
        change = {name: everything[name] for name in names}
        moved = rest.jvp(**change)
        assert moved.points.shape == (7, 21, 3) and moved.exists.all() and len(moved) == 7
        step = 1e-2
        values = []
        for k in (-2, -1, 1, 2):
            changed = dict(arguments)
            for name, by in change.items():
                changed[name] = np.asarray(arguments[name]) + k * step * by
            if np.any(np.asarray(changed["gravity"]) < 0):
                # A size cannot be less than nothing: the backward product is left to compare with.
                break
            points = rods.settle(**changed, **OPTIONS).points
            assert points is not None
            values.append(points)
        if len(values) == 4:
            found = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * step)
            size = np.abs(moved.points).max()
            assert np.allclose(moved.points, found, rtol=1e-5, atol=1e-6 * size + 1e-13), names
        # Against the backward products: the derivative of one loss along the change.
        parts = [(moved.points * WEIGHTS).sum(axis=(1, 2)), (moved.frames * frames).sum(axis=(1, 2)), moved.energy * by_energy]
        forward = parts[0] + parts[1] + parts[2]
        backward = sum((getattr(gradient, name) * by).reshape(7, -1).sum(axis=1) for name, by in change.items())
        size = max(np.abs(part).max() for part in parts)
        assert np.allclose(forward, backward, rtol=1e-8, atol=1e-10 * size + 1e-15), names


def test_what_is_no_argument_has_forward_products_too() -> None:
    for natural in (CURL, KNOTS):
        rest = rods.settle(**(RODS | natural), **OPTIONS, derivatives=True)
        gradient = rest.vjp(WEIGHTS)
        for name, shape in EXTRA.items():
            change = np.random.default_rng(10).normal(size=(7, *shape))
            moved = rest.jvp(**{name: change})
            forward = (moved.points * WEIGHTS).sum(axis=(1, 2))
            backward = (getattr(gradient, name) * change).reshape(7, -1).sum(axis=1)
            assert np.allclose(forward, backward, rtol=1e-8, atol=1e-10 * np.abs(forward).max()), name
        # Gravity is along -z.
        assert np.allclose(-gradient.gravity_vector[:, 2], gradient.gravity, rtol=1e-10)


def test_a_change_may_be_one_for_all_rods() -> None:
    rest = rods.settle(**(RODS | KNOTS), **OPTIONS, derivatives=True)
    one = rest.jvp(length=0.01, tangent=[0, 0, 1], natural_strain=np.ones((1, 4, 3)))
    each = rest.jvp(length=np.full(7, 0.01), tangent=np.tile([0, 0, 1.0], (7, 1)), natural_strain=np.ones((7, 4, 3)))
    assert np.allclose(one.points, each.points, rtol=1e-12, atol=0)
    assert np.array_equal(rest.jvp(natural_strain=[1, 2, 3]).points, rest.jvp(natural_strain=np.tile([1.0, 2, 3], (7, 1))).points)
    assert not rest.jvp().points.any()
    none = rods.settle(np.zeros(0), derivatives=True).jvp(length=np.zeros(0))
    assert none.points.shape == (0, 16, 3)
    straight = rods.settle(0.1, derivatives=True)
    assert not straight.jvp(curl_radius=1.0).points.any()


def test_wrong_changes_are_named() -> None:
    rest = rods.settle(**(RODS | KNOTS), **OPTIONS, derivatives=True)
    for message, change in {
        "length has 3 values for 7 rods": {"length": [1, 2, 3]},
        r"diameter\[2\] is nan": {"diameter": [0, 0, np.nan, 0, 0, 0, 0]},
        "root has the shape": {"root": [1, 2]},
        "have a natural_strain, and no curl_radius": {"curl_radius": 1},
        "natural_strain has 3 knots; the rods have 4": {"natural_strain": np.ones((7, 3, 3))},
        "half_strain has the shape": {"half_strain": np.ones((7, 3, 3))},
    }.items():
        with pytest.raises(frisure.ArgumentError, match=message):
            rest.jvp(**change)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="length has the dtype complex"):
        rest.jvp(length=1j)
    with pytest.raises(frisure.ArgumentError, match="derivatives=True"):
        rods.settle(0.1).jvp(length=1.0)


def test_the_bound_of_the_eigenvalue_is_one_without_weight_and_more_where_weight_stretches() -> None:
    loss = np.ones((1, 16, 3))
    curl: dict[str, Any] = {"curl_radius": 5e-3, "curl_pitch": 0.02, "derivatives": True}
    free = rods.settle(0.15, gravity=0.0, **curl).vjp(loss)
    assert free.eigenvalue_bound[0] == pytest.approx(1.0)
    hanging = rods.settle(0.15, tangent=[0, 0, -1], **curl).vjp(loss)
    assert hanging.eigenvalue_bound[0] > 1.5
    assert rods.settle(0.15, **curl).vjp(0 * loss).eigenvalue_bound[0] == 1.0


def test_derivatives_that_are_not_finite_are_not_regular() -> None:
    far = rods.settle(0.1, curl_radius=[1e160, 5e-3], curl_pitch=1e-2, derivatives=True)
    found = far.vjp(np.ones((2, 16, 3)))
    assert found.curl_radius is not None and found.curl_pitch is not None
    assert abs(found.curl_radius[0]) < 1e-300 and abs(found.curl_pitch[0]) < 1e-300 and found.regular.all()
    assert np.abs(far.jvp(curl_radius=[1.0, 0.0]).points).max() < 1e-300
    large = np.zeros((2, 16, 3))
    large[0] = 1e308
    with np.errstate(all="ignore"):
        assert list(far.vjp(large).regular) == [False, True]
