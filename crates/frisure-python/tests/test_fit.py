"""Fits of fibres whose numbers are known."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import frisure
import numpy as np
import pytest
from frisure import rods

NOISE = 1e-4
LENGTH = 0.12
ARC = np.linspace(0, LENGTH, 41)
CURL: dict[str, Any] = {"curl_radius": 6e-3, "curl_pitch": 15e-3}
WEIGHT = 1300 * np.pi * (35e-6) ** 2 * 9.81
STIFFNESS = 3.9e9 * np.pi * (35e-6) ** 4 / 4 / WEIGHT
"""EI/(ρSg) of the fibres (m³)."""


def lines(count: int, seed: int = 1, **other: Any) -> np.ndarray[Any, Any]:
    """Curls that are clamped in all directions of the horizontal, seen with noise, (count, 41, 3)."""
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    tangent = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    rest = rods.settle(LENGTH, **(CURL | {"tangent": tangent, "d1": [0, 0, 1], "elements": 160} | other))
    assert rest.points is not None
    noise = np.random.default_rng(seed).normal(0, NOISE, (count, 41, 3))
    return np.asarray(rest.points[:, ::4] + noise)


def test_strain_and_stiffness_are_found_with_their_deviations() -> None:
    found = frisure.fit(lines(100), arc_length=ARC, noise=NOISE, known={"axis_ratio": 1})
    assert found.fitted.all() and len(found) == 100
    for value, deviation, truth in [
        (found.curl_radius, found.curl_radius_sd, 6e-3),
        (found.curl_pitch, found.curl_pitch_sd, 15e-3),
        (found.stiffness_over_weight[:, 0], found.stiffness_over_weight_sd[:, 0], STIFFNESS),
    ]:
        away = np.abs(value - truth) / deviation
        assert 0.5 < (away < 1).mean() and 0.85 < (away < 1.96).mean()
        assert (np.abs(value / truth - 1) < 0.2).all()
    assert np.allclose(np.sqrt(found.covariance[:, 0, 0]), found.curvature_sd)
    assert np.abs(found.lines[3][0] - lines(100)[3]).max() < 6 * NOISE
    assert "100 of 100 fibres fitted" in repr(found) and "<table>" in found._repr_html_()


def test_a_section_that_is_not_known_makes_stiffness_uncertain() -> None:
    seen = lines(100, axis_ratio=1.4)
    round_ = frisure.fit(seen, arc_length=ARC, noise=NOISE, known={"axis_ratio": 1})
    right = frisure.fit(seen, arc_length=ARC, noise=NOISE, known={"axis_ratio": (1.4, 0.02)})
    any_ = frisure.fit(seen, arc_length=ARC, noise=NOISE)
    # The smaller bending stiffness of an ellipse of the same area: I = A²/(4π r).
    away = [np.abs(f.stiffness_over_weight - STIFFNESS / 1.4) / f.stiffness_over_weight_sd for f in (round_, right, any_)]
    assert (away[0] > 3).mean() > 0.5 and (away[1] < 1.96).mean() > 0.85 and (away[2] < 1.96).mean() > 0.9
    assert (any_.stiffness_over_weight_sd > 1.3 * right.stiffness_over_weight_sd).mean() > 0.9
    assert np.allclose(right.axis_ratio, 1.4, atol=0.05) and np.allclose(round_.axis_ratio, 1)
    assert any_.torsion_ratio_by_state.shape == (100, 1)


def test_one_pose_says_what_it_cannot_tell_and_a_second_tells_it() -> None:
    flat = lines(1, gravity=0.0)
    one = frisure.fit(flat[0], arc_length=ARC, noise=NOISE, gravity=(0, 0, 0))
    assert "stiffness over weight cannot be told from this pose" in "".join(one.statements[0])
    assert one.stiffness_over_weight_sd[0, 0] > one.stiffness_over_weight[0, 0]
    both = frisure.fit(
        np.concatenate([flat, lines(1)]),
        arc_length=ARC,
        noise=NOISE,
        gravity=np.array([[0, 0, 0], [0, 0, -9.81]]),
        fibre=[7, 7],
    )
    assert both.fitted.all() and len(both) == 1 and both.statements == [[]]
    assert abs(both.stiffness_over_weight[0, 0] / STIFFNESS - 1) < 0.05
    known = frisure.fit(
        flat, arc_length=ARC, noise=NOISE, gravity=(0, 0, 0), known={"stiffness_over_weight": (2e-4, 1e-5)}
    )
    assert np.isclose(known.stiffness_over_weight_sd[0, 0], 1e-5, rtol=0.05)


def test_lines_may_be_of_any_kind() -> None:
    given = lines(3)
    whole = frisure.fit(given, arc_length=ARC, noise=NOISE)
    listed = frisure.fit([given[0], given[1][:30], given[2]], arc_length=[ARC, ARC[:30], ARC], noise=NOISE, length=LENGTH)
    assert listed.curl_radius[0] == whole.curl_radius[0] and listed.curl_radius[1] != whole.curl_radius[1]
    strided = np.zeros((3, 82, 6))
    strided[:, ::2, ::2] = given
    locked = strided[:, ::2, ::2]
    locked.flags.writeable = False
    assert np.array_equal(frisure.fit(locked, arc_length=ARC, noise=NOISE).curl_radius, whole.curl_radius)
    free = frisure.fit(given)
    assert np.allclose(free.length[:, 0], LENGTH, rtol=0.03) and np.allclose(free.noise, NOISE, rtol=0.4)
    assert len(frisure.fit([])) == 0
    two = frisure.fit(given, arc_length=ARC, noise=NOISE, knots=2)
    assert two.profile is not None and two.profile.shape == (3, 2, 2, 2)
    assert len(frisure.fit(given, arc_length=ARC, noise=NOISE, fibre=[0, 0, 0], state=[0, 1, 0]).stiffness_over_weight[0]) == 2


def test_wrong_arguments_are_named_with_the_index() -> None:
    good = lines(2)
    bad = good.copy()
    bad[1, 3, 2] = np.nan
    cases: list[tuple[str, Any, dict[str, Any]]] = [
        (r"strands\[1\]` is wrong: point 3 is", bad, {}),
        (r"strands has the shape \(2, 41, 2\)", good[:, :, :2], {}),
        (r"strands\[0\] has 4 points; a line must have at least 5", good[:, :4], {"arc_length": ARC}),
        ("strands is no array of real numbers", "hair", {}),
        ("strands is no array of real numbers", good + 0j, {}),
        (r"arc_length has the shape \(40,\); line 0 has 41 points", good, {"arc_length": ARC[:40]}),
        (r"arc_length\[1\] is -0.003; it must be finite", good, {"arc_length": -ARC}),
        (r"arc_length\[1\]\[3\] is nan", good, {"arc_length": [ARC, np.where(np.arange(41) == 3, np.nan, ARC)]}),
        (r"strands\[0\] has 0 points; a line must have at least 5", np.zeros((2, 0, 3)), {}),
        (r"strands\[1\] has 2 points", [good[0], good[1][:2]], {}),
        (r"strands is no array of real numbers", np.zeros((1, 41, 3), dtype=bool), {}),
        (r"noise is -1", good, {"noise": -1}),
        (r"gravity has the shape \(2,\)", good, {"gravity": (0, 1)}),
        (r"gravity\[0, 2\] is inf", good, {"gravity": (0, 0, np.inf)}),
        (r"fibre has the shape \(3,\)", good, {"fibre": [1, 2, 3]}),
        (r"fibre has the type float64", good, {"fibre": [0.5, 1]}),
        (r"gravity\[1\] is \[0.0, 0.0, -1e\+300\]", good, {"gravity": [[0, 0, -9.81], [0, 0, -1e300]]}),
        (r"state\[0\] is -1; it must be between 0 and 99", good, {"state": -1}),
        (r"state\[1\] is 2, and no line of its fibre is in state 1", good, {"state": [0, 2], "fibre": [4, 4]}),
        (r"state\[1\] is 1, and no line of its fibre is in state 0", good, {"state": [0, 1]}),
        (r"length\[1\] is 0.05; it must be at least the last arc_length of the fibre, 0.12", good, {"length": [0.2, 0.05]}),
        (r"known is \[1\]; it must be a dict", good, {"known": [1]}),
        (r"knots is -1", good, {"knots": -1}),
        (r"knots is 2.7; it must be a whole number", good, {"knots": 2.7}),
        (r"noise is True", good, {"noise": True}),
        (r"length\[1\] is nan", good, {"length": [0.2, np.nan]}),
        (r"it can have stiffness_over_weight", good, {"known": {"density": 1}}),
        (r"known\['axis_ratio'\]\[0\]` is wrong: axis ratio is 0.5", good, {"known": {"axis_ratio": 0.5}}),
        (r"known\['torsion_ratio'\]\[1\]` is wrong: .* is -1;", good, {"known": {"torsion_ratio": [1, -1]}}),
        (r"known\['axis_ratio'\]\[0\]` is wrong: axis ratio is -0.1", good, {"known": {"axis_ratio": (1.5, -0.1)}}),
        (r"knots is 17; it must be between 1 and 16", good, {"knots": 17}),
    ]
    for message, strands, arguments in cases:
        with pytest.raises(frisure.ArgumentError, match=message):
            frisure.fit(strands, **({"arc_length": ARC} | arguments if "length" in arguments else arguments))


def test_an_exception_of_progress_ends_the_fit() -> None:
    def stop(stage: str, done: float) -> None:
        raise RuntimeError(stage)

    with pytest.raises(RuntimeError, match="fitting"):
        frisure.fit(np.concatenate([lines(100)] * 30), arc_length=ARC, noise=NOISE, progress=stop)


def table(path: Path, given: np.ndarray[Any, Any]) -> Path:
    rows = ["fibre,x (mm),y (mm),z (mm),s (mm)"]
    for i, line in enumerate(given):
        rows += [f"{i},{x * 1e3},{y * 1e3},{z * 1e3},{s * 1e3}" for (x, y, z), s in zip(line, ARC)]
    path.write_text("\n".join(rows) + "\n")
    return path


def test_the_command_gives_the_same_numbers(tmp_path: Path) -> None:
    given = lines(3)
    file = table(tmp_path / "lines.csv", given)
    command = [sys.executable, "-m", "frisure", "fit", str(file), "--noise", "0.1 mm"]
    report, page = tmp_path / "fits.json", tmp_path / "fits.html"
    ran = subprocess.run([*command, "-o", str(report), "-o", str(page)], capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.count("fibre ") == 3
    fibres = json.loads(report.read_text())["fibres"]
    found = frisure.fit(given, arc_length=ARC, noise=NOISE)
    assert np.allclose([f["curl_radius"]["value"] for f in fibres], found.curl_radius, rtol=1e-6)
    assert page.read_text().count("<svg") == 6
    ran = subprocess.run([*command, "--known", "weight=1"], capture_output=True, text=True, check=False)
    assert ran.returncode == 2 and "stiffness-over-weight" in ran.stderr
