"""Exact derivatives of a head of hair at rest.

>>> import frisure, numpy as np
>>> hair = frisure.predict({"hair": {"type": "caucasian-wavy"}, "wisps": {"count": 10, "hairs": 100}})
>>> at_rest = hair.derivatives()
>>> loss = np.zeros_like(at_rest.points)
>>> loss[at_rest.offsets[1:] - 1, 2] = 1           # the sum of the heights of all tips
>>> gradient = at_rest.vjp(loss)
>>> gradient.natural_strain.shape, bool((gradient.density < 0).all())
((10, 3), True)
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from frisure._check import array as _array
from frisure._check import real
from frisure._frisure import HeadAtRest, Prediction
from frisure.errors import ArgumentError, ArgumentTypeError

__all__ = ["HeadDerivatives", "HeadGradient", "HeadMotion"]

Float64 = NDArray[np.float64]
Progress = Callable[[str, float], object]


@dataclass(frozen=True, eq=False, repr=False)
class HeadGradient:
    """The derivatives of a loss by what a head of G guides with E elements in all is made of; units are those of the loss over those given.

    - `natural_strain` (G, 3), loss per rad/m: by a change of the natural strain that is the same all along a guide; `element_strain` (E, 3) by that
      of each element, guide after guide.
    - `youngs_modulus`, `shear_modulus` (G,), loss per Pa; `density` (G,), loss per kg/m³; `diameter` (G,), loss per m; `axis_ratio` (G,), loss per 1:
      by those of the room-dry fibre, of which water and a hold make a fixed multiple.
    - `gravity_vector` (G, 3), loss per m/s²: by the acceleration that pulls each guide (world), by its weight alone.
    - `hair_stiffness`, `skin_stiffness`, loss per Pa: by `contact.hair_stiffness` and `contact.stiffness` of the scene.
    - `rotation` (3,), loss per rad: by a rotation of the head about the origin with all that holds its hair, while gravity stays.

    The sums over the guides of `gravity_vector`, `density` and the moduli are not the derivatives by those keys of a scene: from them the program
    also derives the force that holds combed hair (`implantation.hold`, in weights of the hair), the thickness of wisps and the bed beneath them, which are
    held here. They are where neither is: with `implantation.hold = 0` and `contact.volume = 0`.

    Two gradients are equal if they are the same object: compare their arrays.
    """

    natural_strain: Float64
    element_strain: Float64
    youngs_modulus: Float64
    shear_modulus: Float64
    density: Float64
    diameter: Float64
    axis_ratio: Float64
    gravity_vector: Float64
    hair_stiffness: float
    skin_stiffness: float
    rotation: Float64

    def __repr__(self) -> str:
        return f"<frisure.HeadGradient of {len(self.density)} guides with {len(self.element_strain)} elements>"


@dataclass(frozen=True, eq=False, repr=False)
class HeadMotion:
    """How the N nodes of all guides of a head move along a change, to first order.

    - `points` (N, 3), m: how far each node moves, per unit of the change.
    - `frames` (N, 3), rad: the rotation of the frame of each node (world).
    """

    points: Float64
    frames: Float64

    def __repr__(self) -> str:
        return f"<frisure.HeadMotion of {len(self.points)} nodes>"


class HeadDerivatives:
    """A head at rest, and how its G guides move together when fibres, gravity or contact change; made by `Hairstyle.derivatives`.

    - `points` (N, 3), m: the nodes of all guides, the root's first, guide after guide; at rest to rounding, so they can lie micrometres off those of
      `Hairstyle.guides`.
    - `offsets` (G + 1,): guide i has the nodes from `offsets[i]` up to `offsets[i + 1]`.
    - `gradient_norm`: largest derivative of the energy of the head, relative to EI/L + ρSgL² of its guide.
    - `lowest_eigenvalue`: of the second variation of the head, relative to that of each guide while the others hold still; 1 without contact, 0 where
      stability is lost. An eigenvalue lies within `eigenvalue_error` of it.
    - `regular`: whether neither it nor the smallest eigenvalue of any guide is below 1e-3; nearer to a loss of stability derivatives hold for tiny changes only.
    - `one_sided` (G,) bool: whether a point of the guide is within 1e-9 m of the surface of the skin, or of where a clip pulls as hard as it can. The
      derivatives are those of the side on which the head is, and hold for changes towards that side only: skin is firm as soon as it is touched.
    - `switch_distance` (G, 3), m: how far the nearest point of each guide is from the surface of the skin, from where a clip or a braid pulls with its
      largest force, and from where hair begins to press (the bed beneath, other wisps); infinite where there is none near, and for density. Derivatives
      hold for changes that move the guide by less than that. Hair is soft where it begins to touch: there they are the same on both sides.

    Numbers that the program derives from a fibre besides its rod stay as
    they are: the thickness of its wisp, the bed of hair beneath it, the force that holds combed hair, firmer skin beneath tight curls.
    """

    def __init__(self, prediction: Prediction, progress: Progress | None = None) -> None:
        self._at_rest = HeadAtRest.of(prediction, progress)
        self.points: Float64
        self.points, counts = self._at_rest.points()
        self.offsets: NDArray[np.int64] = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
        self.switch_distance: Float64
        self.one_sided: NDArray[np.bool_]
        self.switch_distance, self.one_sided = self._at_rest.switches()
        self.lowest_eigenvalue, self.eigenvalue_error, self.gradient_norm, self.regular = self._at_rest.certificate()

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def __copy__(self) -> HeadDerivatives:
        return self

    def __deepcopy__(self, memo: object) -> HeadDerivatives:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        raise ArgumentTypeError("derivatives of a head are not pickled; pickle the Hairstyle, and call `derivatives` there")

    def __repr__(self) -> str:
        return f"<frisure.HeadDerivatives of {len(self)} guides; lowest eigenvalue {self.lowest_eigenvalue:.2g}>"

    def vjp(
        self, by_points: ArrayLike, by_frames: ArrayLike | None = None, *, progress: Progress | None = None
    ) -> HeadGradient:
        """The derivatives of a loss by what the head is made of, from those by `points` (loss per m), (N, 3), and by rotations of the frames at the nodes
        (loss per rad, world)."""
        shape = self.points.shape
        loss = _shaped("by_points", by_points, shape)
        frames = None if by_frames is None else _shaped("by_frames", by_frames, shape)
        elements, (uniform, gravity), material, section, (hair, skin), rotation = self._at_rest.vjp(loss, frames, progress)
        return HeadGradient(
            natural_strain=uniform,
            element_strain=elements,
            youngs_modulus=material[:, 0],
            shear_modulus=material[:, 1],
            density=material[:, 2],
            diameter=section[:, 0],
            axis_ratio=section[:, 1],
            gravity_vector=gravity,
            hair_stiffness=hair,
            skin_stiffness=skin,
            rotation=np.asarray(rotation, dtype=np.float64),
        )

    def jvp(
        self,
        *,
        natural_strain: ArrayLike = 0.0,
        element_strain: ArrayLike = 0.0,
        youngs_modulus: ArrayLike = 0.0,
        shear_modulus: ArrayLike = 0.0,
        density: ArrayLike = 0.0,
        diameter: ArrayLike = 0.0,
        axis_ratio: ArrayLike = 0.0,
        gravity_vector: ArrayLike = 0.0,
        hair_stiffness: float = 0.0,
        skin_stiffness: float = 0.0,
        rotation: ArrayLike = 0.0,
        progress: Progress | None = None,
    ) -> HeadMotion:
        """How the nodes move along a change, whose parts are named as in `HeadGradient`: each is one for all guides or one for each, (G,) or (G, 3),
        and `element_strain` one for all elements or one for each, (E, 3)."""
        count = len(self)
        elements = len(self.points) - count
        fibre = {
            "youngs_modulus": youngs_modulus, "shear_modulus": shear_modulus, "density": density, "diameter": diameter,
            "axis_ratio": axis_ratio,
        }
        x, y, z = (float(part) for part in _shaped("rotation", rotation, (3,)))
        contact = (
            real("hair_stiffness", hair_stiffness, "a finite number of Pa"),
            real("skin_stiffness", skin_stiffness, "a finite number of Pa"),
        )
        changes = {name: _shaped(name, value, (count,)) for name, value in fibre.items()}
        changes["natural_strain"] = _shaped("natural_strain", natural_strain, (count, 3))
        changes["element_strain"] = _shaped("element_strain", element_strain, (elements, 3))
        changes["gravity_vector"] = _shaped("gravity_vector", gravity_vector, (count, 3))
        points, frames = self._at_rest.jvp(changes, contact, (x, y, z), progress)
        return HeadMotion(points, frames)


def _shaped(name: str, value: ArrayLike, shape: tuple[int, ...]) -> Float64:
    """Finite numbers in a shape, or that can be spread to it."""
    found = _array(name, value)
    try:
        spread = np.ascontiguousarray(np.broadcast_to(found, shape))
    except ValueError:
        raise ArgumentError(f"{name} has the shape {found.shape}; it must be {shape}") from None
    wrong = np.argwhere(~np.isfinite(spread))
    if len(wrong):
        index = tuple(int(i) for i in wrong[0])
        raise ArgumentError(f"{name}[{', '.join(map(str, index))}] is {spread[index]}; it must be finite")
    return spread
