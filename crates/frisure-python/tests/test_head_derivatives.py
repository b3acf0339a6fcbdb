"""Derivatives of a head of guides that touch each other, against differences of whole predictions."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import frisure
import numpy as np
import pytest

SCENE: dict[str, Any] = {
    "hair": {"type": "caucasian-wavy", "length": "20 cm"},
    "wisps": {"count": 24, "hairs": 100},
    "contact": {"hair": "wisps", "hair_stiffness": 30.0},
    "equilibrium": {"elements": 12, "method": "continuation"},
}


def predicted(element: str, **numbers: float) -> frisure.Hairstyle:
    contact = {**SCENE["contact"], **numbers}
    return frisure.predict({**SCENE, "contact": contact, "equilibrium": {**SCENE["equilibrium"], "element": element}})


@pytest.fixture(scope="module", params=["helix", "jointed"])
def element(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def head(element: str) -> frisure.HeadDerivatives:
    return predicted(element).derivatives()


def test_the_nodes_are_those_of_the_guides(element: str, head: frisure.HeadDerivatives) -> None:
    guides = predicted(element).guides
    assert len(head) == 24 and head.points.shape == (24 * 13, 3)
    assert list(np.diff(head.offsets)) == [13] * 24
    tips = guides.points[guides.offsets[1:] - 1]
    assert np.abs(tips - head.points[head.offsets[1:] - 1]).max() < 1e-5
    assert 0 < head.lowest_eigenvalue <= 1.01 and head.gradient_norm <= 1e-8
    assert "24 guides" in repr(head)


def test_how_near_contact_is_to_where_it_begins_is_told(head: frisure.HeadDerivatives) -> None:
    assert head.switch_distance.shape == (24, 3) and (head.switch_distance >= 0).all()
    skin, hold, hair = head.switch_distance.T
    assert np.isfinite(skin).all() and np.isinf(hold).all() and (hair < 0.05).any()
    assert head.one_sided.shape == (24,) and np.array_equal(head.one_sided, np.minimum(skin, hold) < 1e-9)


def test_the_stiffness_of_hair_moves_the_head_as_differences_do(element: str, head: frisure.HeadDerivatives) -> None:
    step = 1e-3
    stiffer, softer = (predicted(element, hair_stiffness=30.0 + sign * step).derivatives() for sign in (1, -1))
    expected = (stiffer.points - softer.points) / (2 * step)
    found = head.jvp(hair_stiffness=1.0).points
    assert np.abs(found - expected).max() < 1e-4 * np.abs(expected).max()


def test_the_two_products_agree(head: frisure.HeadDerivatives) -> None:
    random = np.random.default_rng(1)
    points, frames = random.normal(size=(2, *head.points.shape))
    gradient = head.vjp(points, frames)
    change: dict[str, Any] = {
        "natural_strain": random.normal(size=(24, 3)),
        "youngs_modulus": random.normal(size=24) * 1e9,
        "shear_modulus": random.normal(size=24) * 1e8,
        "element_strain": random.normal(size=(24 * 12, 3)),
        "density": random.normal(size=24) * 100,
        "diameter": random.normal(size=24) * 1e-5,
        "axis_ratio": random.normal(size=24) * 0.1,
        "gravity_vector": random.normal(size=(24, 3)),
        "hair_stiffness": 2.0,
        "skin_stiffness": 30.0,
        "rotation": random.normal(size=3),
    }
    moved = head.jvp(**change)
    along = (moved.points * points).sum() + (moved.frames * frames).sum()
    by = sum(np.sum(getattr(gradient, name) * value) for name, value in change.items())
    assert by == pytest.approx(along, rel=1e-7)
    assert gradient.element_strain.shape == (24 * 12, 3)
    assert np.allclose(gradient.element_strain.reshape(24, 12, 3).sum(axis=1), gradient.natural_strain)


def test_others_move_where_they_touch(head: frisure.HeadDerivatives) -> None:
    strain = np.zeros((24, 3))
    strain[3] = 1
    moved = np.abs(head.jvp(natural_strain=strain).points).max(axis=1).reshape(24, 13).max(axis=1)
    assert moved[3] > 0 and np.count_nonzero(moved) > 1


def test_wrong_arguments_are_named(head: frisure.HeadDerivatives) -> None:
    with pytest.raises(frisure.ArgumentError, match=r"by_points has the shape \(2, 3\)"):
        head.vjp(np.zeros((2, 3)))
    with pytest.raises(frisure.ArgumentError, match=r"density\[4\] is nan"):
        head.jvp(density=np.where(np.arange(24) == 4, np.nan, 0))
    with pytest.raises(frisure.ArgumentError, match="hair_stiffness is 'soft'"):
        head.jvp(hair_stiffness="soft")  # type: ignore[arg-type]


def test_a_head_without_derivatives_says_why() -> None:
    rubs = {**SCENE, "contact": {**SCENE["contact"], "friction": 0.4}}
    with pytest.raises(ValueError, match="contact.friction"):
        frisure.predict(rubs).derivatives()


@pytest.mark.parametrize("steps", [[], [{"wet": {"to": 0.6}}]], ids=["dry", "wet"])
def test_without_what_follows_from_weight_the_sums_are_derivatives_by_keys_of_the_scene(steps: list[Any]) -> None:
    free = {**SCENE, "contact": {"hair": "wisps", "volume": 0}, "implantation": {"hold": 0}, "step": steps}

    def at_rest(**numbers: Any) -> frisure.HeadDerivatives:
        scene = frisure.Scene(free)
        scene.update({key.replace("__", "."): value for key, value in numbers.items()})
        return frisure.predict(scene).derivatives()

    head = at_rest()
    loss = np.random.default_rng(2).normal(size=head.points.shape)
    by = head.vjp(loss)
    for key, value, found in (
        ("gravity", 9.81, -by.gravity_vector[:, 2].sum()),
        ("hair__fibre__density", 1300.0, by.density.sum()),
        ("hair__fibre__youngs_modulus", 3.9e9, by.youngs_modulus.sum()),
        ("hair__fibre__shear_modulus", 0.9e9, by.shear_modulus.sum()),
    ):
        heavier, lighter = (at_rest(**{key: value * (1 + sign * 1e-4)}) for sign in (1, -1))
        expected = ((heavier.points - lighter.points) * loss).sum() / (2e-4 * value)
        assert found == pytest.approx(expected, rel=1e-3), key


def test_derivatives_are_copied_and_not_pickled() -> None:
    at_rest = predicted("helix").derivatives()
    assert copy.copy(at_rest) is at_rest and copy.deepcopy(at_rest) is at_rest
    with pytest.raises(frisure.ArgumentTypeError, match="pickle the Hairstyle"):
        pickle.dumps(at_rest)
