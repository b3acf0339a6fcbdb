"""Derivatives of a head of guides that touch each other, against differences of whole predictions."""

from __future__ import annotations

from typing import Any

import frisure
import numpy as np
import pytest

SCENE: dict[str, Any] = {
    "hair": {"type": "caucasian-wavy", "length": "20 cm"},
    "wisps": {"count": 24, "hairs": 100},
    "contact": {"hair": "wisps", "hair_stiffness": 30.0},
    "equilibrium": {"element": "helix", "elements": 12, "method": "continuation"},
}


def with_contact(**numbers: float) -> frisure.HeadDerivatives:
    return frisure.predict({**SCENE, "contact": {**SCENE["contact"], **numbers}}).derivatives()


@pytest.fixture(scope="module")
def head() -> frisure.HeadDerivatives:
    return with_contact()


def test_the_nodes_are_those_of_the_guides(head: frisure.HeadDerivatives) -> None:
    guides = frisure.predict(SCENE).guides
    assert len(head) == 24 and head.points.shape == (24 * 13, 3)
    assert list(np.diff(head.offsets)) == [13] * 24
    tips = guides.points[guides.offsets[1:] - 1]
    assert np.abs(tips - head.points[head.offsets[1:] - 1]).max() < 1e-5
    assert 0 < head.lowest_eigenvalue <= 1.01 and head.gradient_norm <= 1e-8
    assert "24 guides" in repr(head)


def test_the_stiffness_of_hair_moves_the_head_as_differences_do(head: frisure.HeadDerivatives) -> None:
    step = 1e-3
    apart = with_contact(hair_stiffness=30.0 + step).points - with_contact(hair_stiffness=30.0 - step).points
    expected = apart / (2 * step)
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
        "density": random.normal(size=24) * 100,
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
    jointed = {**SCENE, "equilibrium": {**SCENE["equilibrium"], "element": "jointed"}}
    with pytest.raises(ValueError, match="helix"):
        frisure.predict(jointed).derivatives()
