"""Photos of locks: drawn waves of known radius and pitch."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import frisure
import numpy as np
import pytest
from numpy.typing import NDArray

RADIUS, PITCH, SCALE = 3e-3, 15e-3, 10_000.0


def photo(noise: float = 2.0) -> NDArray[np.uint8]:
    """Thirty dark hairs side by side on white paper, in a wave of 3 mm and 15 mm at 10 pixels a millimetre."""
    height, width = 1200, 500
    y, x = np.mgrid[0:height, 0:width].astype(float)
    wave = 0.5 * width + RADIUS * SCALE * np.sin(2 * np.pi * y / (PITCH * SCALE))
    seed = np.random.default_rng(7)
    light = np.ones((height, width))
    for aside in seed.normal(0.0, 5.0, 30):
        light *= 1.0 - 0.5 * np.exp(-0.5 * ((x - wave - aside) / 0.8) ** 2)
    grey = 235.0 * light + seed.normal(0.0, noise, light.shape)
    return np.repeat(np.clip(grey, 0, 255).astype(np.uint8)[:, :, None], 3, axis=2)


def test_a_lock_is_measured_from_an_array() -> None:
    given = photo()
    found = frisure.measure(given, "10 px/mm", hang="none")
    assert found and found.reason is None, found
    assert found.apparent_radius is not None and found.apparent_pitch is not None
    assert found.apparent_radius == pytest.approx(RADIUS, rel=0.1)
    assert found.apparent_pitch == pytest.approx(PITCH, rel=0.05)
    assert found.turns == pytest.approx(0.12 / PITCH, rel=0.15)
    assert found.overlay.shape == given.shape and not np.array_equal(found.overlay, given)
    assert "without weight" in repr(found)
    # A view and one with alpha are the same photo.
    alpha = np.dstack([given, np.full(given.shape[:2], 255, np.uint8)])
    again = frisure.measure(alpha[:, :, :], "10 px/mm", hang="none")
    assert again.apparent_radius == found.apparent_radius
    for strided in (np.flipud(np.flipud(given).copy()), np.fliplr(np.fliplr(alpha).copy()), np.asfortranarray(given)):
        assert not strided.flags.c_contiguous
        assert np.array_equal(frisure.measure(strided, "10 px/mm", hang="none").overlay, found.overlay)
    part = frisure.measure(given, "10 px/mm", hang="none", crop=(50, 100, 400, 1000))
    assert part.apparent_radius == pytest.approx(RADIUS, rel=0.1)


def test_weight_is_taken_out() -> None:
    lying, hanging = (frisure.measure(photo(), "10 px/mm", hang=hang, length=np.float32(0.2)) for hang in ("none", "down"))
    assert lying.curl_pitch is not None and hanging.curl_pitch is not None
    # What hangs is drawn out: without weight the curl is shorter.
    assert hanging.curl_pitch < lying.curl_pitch
    assert hanging.curl_radius_sd is not None and hanging.curl_radius_sd > 0


def test_hair_is_no_shorter_than_what_is_seen_of_it() -> None:
    short = frisure.measure(photo(), "10 px/mm", length=0.08)
    assert not short and short.reason is not None and "80 mm" in short.reason
    swapped = frisure.measure(photo(), "10 mm/px", hang="none")
    assert not swapped and swapped.hint is not None and "scale" in swapped.hint


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not tell what is free")
def test_a_photo_without_room_is_refused_before_it_is_copied() -> None:
    program = """
import resource, frisure, numpy as np
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + (300 << 20),) * 2)
try:
    frisure.measure(np.broadcast_to(np.uint8(240), (12_000, 12_000, 3)), "10 px/mm")
except frisure.ArgumentError as error:
    print(error)
"""
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert "photo has 12000 x 12000 pixels; at most" in told.stdout and "have room" in told.stdout


def test_what_does_not_tell_is_said() -> None:
    blank = np.full((400, 300, 3), 240, np.uint8)
    found = frisure.measure(blank, "10 px/mm")
    assert not found and found.reason and found.hint and found.curl_radius is None
    assert "not measured" in repr(found)


def test_wrong_arguments_are_named(tmp_path: Path) -> None:
    good = photo()
    for wrong, words in [
        (lambda: frisure.measure(good, "52"), "scale is"),
        (lambda: frisure.measure(good, "52 px/mile"), "no unit of a scale"),
        (lambda: frisure.measure(good.astype(float), "10 px/mm"), "photo has the shape"),
        (lambda: frisure.measure(good[:, :, 0], "10 px/mm"), "photo has the shape"),
        (lambda: frisure.measure(3, "10 px/mm"), "photo is a int"),  # type: ignore[arg-type]
        (lambda: frisure.measure(good, "10 px/mm", hang="up"), "hang is"),  # type: ignore[arg-type]
        (lambda: frisure.measure(good, "10 px/mm", length=5.0), "length is"),
        (lambda: frisure.measure(good, "10 px/mm", diameter=float("nan")), "diameter is"),
        (lambda: frisure.measure(good, "10 px/mm", hair_type="feathers"), "no hair type"),
        (lambda: frisure.measure(good, "10 px/mm", crop=(0, 0, 9, 9)), "width and height from 32"),
        (lambda: frisure.measure(good[:20], "10 px/mm"), "its height and width must be at least 32"),
        (lambda: frisure.measure(good, "10 px/mm", crop=(400, 0, 400, 400)), "not within"),
        (lambda: frisure.measure(good, "10 px/mm", crop=(0, 0, 1, -1)), "crop is"),
        (lambda: frisure.measure(tmp_path / "none.jpg", "10 px/mm"), "none.jpg"),
        (lambda: frisure.measure(good, 10), "scale is 10"),  # type: ignore[arg-type]
        (lambda: frisure.measure(good, "10 px/mm", hair_type=None), "hair_type is None"),  # type: ignore[arg-type]
        (lambda: frisure.measure(good, "10 px/mm", crop=5), "crop is 5"),  # type: ignore[arg-type]
        (lambda: frisure.measure(good, "10 px/mm", crop=(10**30, 0, 1, 1)), "crop is"),
        (lambda: frisure.measure(np.ma.masked_less(good, 9), "10 px/mm"), "photo has masked values"),
        (lambda: frisure.measure(np.broadcast_to(np.uint8(240), (40_000, 40_000, 3)), "10 px/mm"), "photo has 40000 x 40000 pixels; at most"),
    ]:
        with pytest.raises(ValueError, match=words):
            wrong()
