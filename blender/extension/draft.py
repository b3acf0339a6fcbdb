"""Guides while a property is dragged: without contact each is a rod of its own, and all of them come to rest in a tenth of a second.

A draft begins with the exact guides in memory and changes their lengths and natural curls as the properties do. It shows the guides
alone; the exact hair follows.
"""

import functools
from types import SimpleNamespace

import frisure
import numpy as np
from frisure import rods

from . import curves

# Keys that a draft can follow.
LENGTH, RADIUS, PITCH = "hair.length", "hair.curl.radius", "hair.curl.pitch"

# Largest turn of a guide between two points (rad) whose tangent and length are computed from its points, and the order of the
# polynomial through the first of these. Chosen.
MOST_TURN = 1.0
ORDER = 8

# Elements in a turn of the curl, for some tenths of a millimetre (frisure.rods.settle).
ELEMENTS = 3.5

TOLERANCE = 1e-4


class Guides:
    """The guides of a hairstyle without contact and without steps, as arguments of `frisure.rods.settle`."""

    def __init__(self, hairstyle: frisure.Hairstyle):
        strands = hairstyle.guides
        count, points = len(strands), int(strands.counts[0])
        shape = (count, points, 3)
        line = strands.points.reshape(shape).astype(np.float64)
        strain = strands.attributes["natural_strain"].reshape(shape).astype(np.float64)
        curvature = np.linalg.norm(strain[:, :, :2], axis=2).mean(axis=1)
        rate = np.hypot(curvature, strain[:, :, 2].mean(axis=1))
        chord = np.linalg.norm(np.diff(line, axis=1), axis=2).mean(axis=1)
        self.usable = points > ORDER and float((rate * chord).max()) < MOST_TURN
        if not self.usable:
            return
        scene = hairstyle.scene
        self.curl = [scene.number(key) for key in (RADIUS, PITCH)]
        self.mean_length = scene.number(LENGTH)
        self.strands, self.strain, self.rate = strands, strain, rate
        self.length = (points - 1) * arc(chord, curvature, rate)
        # The derivative at the root of the polynomial through the first points.
        powers = np.vander(np.arange(ORDER + 1), increasing=True).T.astype(np.float64)
        weights = np.linalg.solve(powers, np.eye(ORDER + 1)[1])
        self.fixed = {
            "root": line[:, 0],
            "tangent": np.einsum("k,hkc->hc", weights, line[:, : ORDER + 1]),
            "d1": strands.attributes["d1"].reshape(shape)[:, 0].astype(np.float64),
            "diameter": 2.0 * strands.radii.reshape(count, points)[:, 0].astype(np.float64),
            "axis_ratio": strands.attributes["axis_ratio"].astype(np.float64),
        }
        for name in ("youngs_modulus", "shear_modulus", "density"):
            self.fixed[name] = scene.number(f"hair.fibre.{name}")

    def settled(self, scene: frisure.Scene, progress=None) -> SimpleNamespace:
        """The guides with the length and the curl of a scene."""
        before, after = helix(*self.curl), helix(scene.number(RADIUS), scene.number(PITCH))
        factors = [b / a if a else 1.0 for a, b in zip(before, after)]
        strain = self.strain * [factors[0], factors[0], factors[1]]
        length = self.length * (scene.number(LENGTH) / self.mean_length)
        pieces = self.strain.shape[1] - 1
        turns = float((length * self.rate * max(factors)).max()) / (2.0 * np.pi)
        each = max(1, int(np.ceil(ELEMENTS * turns / pieces)))
        rest = rods.settle(
            length, natural_strain=strain, elements=each * pieces, tolerance=TOLERANCE, progress=progress, **self.fixed
        )
        points = rest.points[:, ::each].astype(np.float32).reshape(-1, 3)
        strands = self.strands
        return SimpleNamespace(counts=strands.counts, points=points, radii=strands.radii, attributes=strands.attributes)


def arc(chord: np.ndarray, curvature: np.ndarray, rate: np.ndarray) -> np.ndarray:
    """The length of helix over chords; `rate` is the turn of the frame (rad/m)."""
    rate = np.maximum(rate, 1e-9)
    radius, climb = curvature / rate**2, np.sqrt(np.maximum(1.0 - (curvature / rate) ** 2, 0.0))
    length = chord.copy()
    for _ in range(20):
        length *= chord / np.hypot(2.0 * radius * np.sin(0.5 * rate * length), climb * length)
    return length


def helix(radius: float, pitch: float) -> tuple[float, float]:
    """Curvature and torsion (rad/m) of a helix; none for straight hair."""
    if not np.isfinite(radius):
        return 0.0, 0.0
    climb = pitch / (2.0 * np.pi)
    size = radius**2 + climb**2
    return (radius / size, climb / size) if size else (0.0, 0.0)


def guides_of(hairstyle: frisure.Hairstyle):
    """The guides of a hairstyle that a draft can begin with, or none."""
    known = _known.get(id(hairstyle))
    if known is not None and known[0] is hairstyle:
        return known[1]
    scene = hairstyle.scene
    made = scene.to_dict()
    contact = made.get("contact", {})
    free = contact.get("body") == contact.get("hair") == "none" and not made.get("step") and "groom" not in made
    guides = Guides(hairstyle) if free else None
    guides = guides if guides is not None and guides.usable else None
    # Of the last hairstyle alone: one property is dragged at a time.
    _known.clear()
    _known[id(hairstyle)] = (hairstyle, guides)
    return guides


_known: dict[int, tuple[frisure.Hairstyle, Guides | None]] = {}


class Draft:
    """A solution by a draft; none where `of` returns none."""

    coarse = True

    def __init__(self, hair_name: str, guides: Guides, scene: frisure.Scene):
        self.hair_name, self.guides, self.scene = hair_name, guides, scene
        self.strands = None

    @classmethod
    def of(cls, hair, hairstyle, text: str):
        """The draft of a scene's text that differs from a hairstyle in what a draft can follow."""
        if hairstyle is None:
            return None
        guides = guides_of(hairstyle)
        if guides is None or without(text) != without(hair.frisure.scene):
            return None
        scene = frisure.Scene.from_text(text)
        if helix(*guides.curl)[0] == 0.0 and helix(scene.number(RADIUS), scene.number(PITCH))[0] != 0.0:
            # Straight guides have no side to which they would curl.
            return None
        return cls(hair.name, guides, scene)

    def solve(self, progress=None) -> None:
        self.strands = self.guides.settled(self.scene, progress)

    def show(self, hair) -> None:
        curves.write(hair, self.strands)


@functools.lru_cache(maxsize=4)
def without(text: str) -> dict:
    """What the text of a scene says but for the keys that a draft can follow."""
    said = frisure.Scene.from_text(text).to_dict()
    said.get("hair", {}).pop("length", None)
    said.get("hair", {}).pop("curl", None)
    return said
