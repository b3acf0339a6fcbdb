"""From the photo of a lock with a ruler to its curl, with error bars."""

from __future__ import annotations

import json
import os
import sys
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from frisure._check import path, real, shown, text, unmasked, whole
from frisure._frisure import measure_photo
from frisure.errors import ArgumentError, ArgumentTypeError
from frisure.fits import Progress

__all__ = ["Measured", "measure"]

RANGES = {
    "length": (1e-3, 3.0, "m"),
    "diameter": (5e-6, 5e-4, "m"),
    "axis_ratio": (1.0, 20.0, ""),
    "youngs_modulus": (1e8, 1e11, "Pa"),
}
"""What can be given of the fibres, as `frisure_engine::photo` has it."""

LEAST_SIDE = 32
"""Pixels of the shorter side of a photo or a crop, as `frisure_measure::Photo` asks for."""


@dataclass(frozen=True, eq=False)
class Measured:
    """What the photo of a lock tells. Where it does not tell, `reason` says why and the numbers are None. Lengths in metres; radii and pitches
    have their standard deviations under their names with `_sd`, and lie within 1.96 of them with a probability of 95 %.

    - `reason`: why the lock was not measured, None where it was; `hint`: what to do about that.
    - `apparent_radius`, `apparent_pitch` (m): of the curl as it hangs.
    - `curl_radius`, `curl_pitch` (m): without weight; None where no fibre of the type hangs so.
    - `turns`: turns seen.
    - `tilt` (rad): angle of the lock's axis to the vertical, positive where its lower end is to the right.
    - `length` (m): of the hairs, given, or that of the line that is seen.
    - `overlay` (height, width, 3), uint8: the photo with what was found; ridge lines blue, the fitted wave magenta, its axis yellow.

    It is true where the lock was measured. Two results are equal if they are the same object.
    """

    reason: str | None
    hint: str | None
    apparent_radius: float | None
    apparent_radius_sd: float | None
    apparent_pitch: float | None
    apparent_pitch_sd: float | None
    curl_radius: float | None
    curl_radius_sd: float | None
    curl_pitch: float | None
    curl_pitch_sd: float | None
    turns: float | None
    tilt: float | None
    length: float | None
    overlay: NDArray[np.uint8]

    def __bool__(self) -> bool:
        """Whether the lock was measured."""
        return self.reason is None

    def __repr__(self) -> str:
        if self.reason is not None:
            return f"<frisure.Measured: not measured, {self.reason}>"
        parts = [f"{1e3 * value:.2f} mm" for value in (self.curl_radius, self.curl_pitch) if value is not None]
        natural = f"radius and pitch {' and '.join(parts)} without weight" if parts else "no natural curl found"
        return f"<frisure.Measured: {natural}>"


def measure(
    photo: str | os.PathLike[str] | NDArray[np.uint8],
    scale: str,
    *,
    crop: tuple[int, int, int, int] | None = None,
    hang: Literal["down", "none"] = "down",
    hair_type: str = "caucasian-curly",
    length: float | None = None,
    diameter: float | None = None,
    axis_ratio: float | None = None,
    youngs_modulus: float | None = None,
    progress: Progress | None = None,
) -> Measured:
    """Radius and pitch of the curl of one lock from a photo, as it hangs and without weight, with error bars.

    - `photo`: a file (PNG, JPEG), or an array (height, width, 3 or 4) of uint8, rows from the top, sRGB.
    - `scale`: by a ruler in the photo: `"52 px/mm"`, `"600 dpi"`, `"19 um/px"`.
    - `crop`: left edge, upper edge, width, height (pixels) of the part that is measured, without the ruler.
    - `hang`: `"down"`: it hangs by its root, and down is down in the photo; `"none"`: it lies flat or floats.
    - `hair_type`: whose fibre it is, for the stretch by weight; what is known of the fibre itself is given by `length` (m), mean `diameter`
      (m), `axis_ratio` and `youngs_modulus` (Pa).

    docs/photo.md describes how to photograph a lock, the method and its errors. `frisure measure` is the same in a shell.
    """
    if not isinstance(hang, str) or hang not in ("down", "none"):
        raise ArgumentError(f"hang is {shown(hang)}; it can be 'down' or 'none'")
    if isinstance(photo, np.ndarray):
        unmasked("photo", photo)
        if photo.dtype != np.uint8 or photo.ndim != 3 or photo.shape[2] not in (3, 4):
            raise ArgumentError(
                f"photo has the shape {photo.shape} and the type {photo.dtype}; it must be (height, width, 3 or 4) of uint8"
            )
        if min(photo.shape[:2]) < LEAST_SIDE:
            raise ArgumentError(
                f"photo has the shape {photo.shape}; its height and width must be at least {LEAST_SIDE} pixels"
            )
    elif not isinstance(photo, (str, os.PathLike)):
        raise ArgumentTypeError(f"photo is a {type(photo).__name__}; it must be a path or an array of uint8")
    else:
        path("photo", photo)
    scale = text("scale", scale, "a text such as '52 px/mm'")
    given: dict[str, Any] = {"hair_type": text("hair_type", hair_type, "the name of a hair type")}
    fibre = {"length": length, "diameter": diameter, "axis_ratio": axis_ratio, "youngs_modulus": youngs_modulus}
    for name, value in fibre.items():
        low, high, unit = RANGES[name]
        allowed = f"a number from {low:g} to {high:g} {unit}".rstrip()
        given[name] = None if value is None else real(name, value, allowed, low, high)
    told, overlay = measure_photo(photo, scale, _part(crop), hang == "down", given, progress)
    found = json.loads(told)
    numbers: dict[str, float | None] = {}
    natural = found.get("natural") or (None, None)
    for name, number in {
        "apparent_radius": found.get("apparent_radius"),
        "apparent_pitch": found.get("apparent_pitch"),
        "curl_radius": natural[0],
        "curl_pitch": natural[1],
    }.items():
        numbers[name] = None if number is None else number["value"]
        numbers[f"{name}_sd"] = None if number is None else number["deviation"]
    return Measured(
        reason=found.get("reason"),
        hint=found.get("hint"),
        turns=found.get("turns"),
        tilt=found.get("tilt"),
        length=found.get("length"),
        overlay=np.asarray(overlay),
        **numbers,
    )


def _part(crop: Any) -> tuple[int, int, int, int] | None:
    if crop is None:
        return None
    try:
        left, top, width, height = (whole("crop", number, 0, sys.maxsize) for number in crop)
        whole("crop", min(width, height), LEAST_SIDE)
    except (TypeError, ValueError):
        allowed = f"four whole numbers (pixels): left and top from 0, width and height from {LEAST_SIDE}"
        raise ArgumentError(f"crop is {shown(crop)}; it must be {allowed}") from None
    return left, top, width, height
