"""Hairstyles: arrays, steps, pictures, files."""

from __future__ import annotations

import copy
import inspect
import io
import json
import os
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import frisure
import numpy as np
import pytest
from frisure._frisure import operation_names

from conftest import SMALL


def run(*arguments: str | os.PathLike[str]) -> subprocess.CompletedProcess[str]:
    """The command line of the installed package."""
    command = [sys.executable, "-m", "frisure", *map(os.fspath, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_strands_are_arrays(hair: frisure.Hairstyle) -> None:
    strands = hair.strands
    points = len(strands.points)
    assert (len(strands), strands.points.shape, strands.points.dtype) == (200, (points, 3), np.float32)
    assert (strands.radii.shape, strands.radii.dtype) == ((points,), np.float32)
    assert (strands.offsets.shape, strands.offsets.dtype) == ((201,), np.uint32)
    assert strands.offsets[0] == 0 and strands.offsets[-1] == points
    assert strands.curves.shape == (200, points // 200, 3)
    assert strands.curves.base is not None and np.shares_memory(strands.curves, strands.points)
    assert np.array_equal(strands[-1], strands.curves[-1])
    assert sum(len(strand) for strand in strands) == points
    assert len(strands[5:9]) == 4
    with pytest.raises(IndexError):
        strands[200]
    assert np.isfinite(strands.points).all()


def test_a_hairstyle_like_another_is_the_same_as_one_by_itself(hair: frisure.Hairstyle) -> None:
    scene = hair.scene
    scene.update({"wisps.points": 9})
    alone, like = frisure.predict(scene), frisure.predict(scene, like=hair)
    assert np.array_equal(alone.strands.points, like.strands.points)
    scene = scene.with_step("wet")
    assert np.array_equal(frisure.predict(scene).strands.points, frisure.predict(scene, like=like).strands.points)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"width": 10**20}, "width is 1000.*between 1 and"),
        ({"width": 10.5}, "width is 10.5; it must be a whole number"),
        ({"height": True}, "height is True"),
        ({"paths": 2.5}, "paths is 2.5"),
        ({"noise": "a"}, "noise is 'a'"),
        ({"azimuth": "90 deg"}, "azimuth is '90 deg'; it must be a finite number of degrees"),
        ({"clamp": 0}, "clamp is 0"),
    ],
)
def test_wrong_arguments_of_a_picture_are_named(hair: frisure.Hairstyle, arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(frisure.ArgumentError, match=message):
        hair.render(**arguments)


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not tell how much memory is free")
def test_a_picture_without_room_in_memory_is_refused(hair: frisure.Hairstyle) -> None:
    for quality in ("preview", "final"):
        with pytest.raises(ValueError, match=r"it takes about \d+\.\d GB of memory, and \d+\.\d GB are free"):
            hair.render(width=1_000_000, height=1_000_000, quality=quality)
    with pytest.raises(ValueError, match="GB of memory"):
        hair.render(width=2**62, height=2**62)


def test_attributes_have_a_value_for_each_strand_or_point(hair: frisure.Hairstyle) -> None:
    for strands in (hair.strands, hair.guides):
        for name, values in strands.attributes.items():
            rows = len(strands.points) if name in strands.per_point else len(strands)
            assert len(values) == rows, name
    assert np.allclose(hair.attributes["guide_weights"].sum(axis=1), 1, atol=1e-5)
    assert np.allclose(np.linalg.norm(hair.guides.attributes["d1"], axis=1), 1, atol=1e-5)
    assert np.array_equal(hair.guides.attributes["id"], np.arange(30))


def test_strands_are_neither_replaced_nor_searched(hair: frisure.Hairstyle) -> None:
    strands = hair.strands
    for name in ("points", "attributes", "colour"):
        with pytest.raises(AttributeError, match=f"`{name}` of strands cannot be set"):
            setattr(strands, name, strands.points)
    with pytest.raises(AttributeError, match="cannot be deleted"):
        del strands.radii
    with pytest.raises(TypeError):
        strands.attributes["id"] = strands.radii  # type: ignore[index]
    with pytest.raises(frisure.ArgumentTypeError, match=r"by their index: `strands\[h\]`"):
        assert strands[0] in strands


def test_arrays_are_not_copied_and_outlive_the_hairstyle() -> None:
    hair = frisure.predict(SMALL)
    data = hair._prediction.hairs(None)
    address = data.points().__array_interface__["data"]
    assert hair.strands.points.__array_interface__["data"] == address
    assert address == (hair.strands.points.ctypes.data, True)
    assert hair.strands.curves.ctypes.data == hair.strands.points.ctypes.data
    assert hair.draw().points is hair.strands.points
    points = hair.strands.points
    before = points.copy()
    del hair, data
    assert np.array_equal(points, before)
    with pytest.raises(ValueError):
        points[0] = 0
    with pytest.raises(ValueError):
        points.flags.writeable = True


def test_guides_hang_as_a_single_rod_does() -> None:
    # Without contact and without variation a guide is a rod in its own weight.
    scene = frisure.Scene(SMALL)
    scene.update({"contact.body": "none", "contact.hair": "none", "equilibrium.accuracy": "0.01 mm"})
    guides = frisure.predict(scene).guides
    lengths = np.linalg.norm(np.diff(guides.curves.astype(float), axis=1), axis=2).sum(axis=1)
    frame = guides.attributes["d1"].reshape(len(guides), -1, 3)[:, 0]
    strain = guides.attributes["natural_strain"].reshape(len(guides), -1, 3)
    first = guides.curves[:, :3].astype(float)
    rest = frisure.rods.settle(
        lengths,
        diameter=2 * guides.radii[guides.offsets[:-1]].astype(float),
        axis_ratio=guides.attributes["axis_ratio"].astype(float),
        natural_strain=strain.astype(float),
        root=first[:, 0],
        # The derivative at the end of the parabola through three points.
        tangent=-3 * first[:, 0] + 4 * first[:, 1] - first[:, 2],
        d1=frame.astype(float),
        youngs_modulus=scene.number("hair.fibre.youngs_modulus"),
        shear_modulus=scene.number("hair.fibre.shear_modulus"),
        density=scene.number("hair.fibre.density"),
        elements=4 * (guides.curves.shape[1] - 1),
    )
    assert rest.points is not None
    gaps = np.linalg.norm(rest.points[:, ::4] - guides.curves, axis=2).max(axis=1)
    # Lengths, roots and strains are those of a polyline of some dozen points.
    assert np.median(gaps) < 1e-3, gaps


def test_steps_have_methods_and_return_new_hairstyles(hair: frisure.Hairstyle) -> None:
    for name in operation_names():
        assert inspect.getdoc(getattr(frisure.Hairstyle, name)), name
    before = hair.strands.points.copy()
    cut = hair.wet().cut("ears", raise_="1 cm", where={"above": "ears"}).dry(progress=lambda stage, done: None)
    assert np.array_equal(hair.strands.points, before)
    steps = cut.report["steps"]
    assert [step["operation"] for step in steps] == ["wet", "cut", "dry"]
    assert steps[1]["mass_change"] < 0
    assert cut.scene.to_dict()["step"][1] == {
        "cut": {"below": "ears", "raise": "1 cm", "where": {"above": "ears"}}
    }
    assert hair.humidity(0.9).scene.to_dict()["step"] == [{"humidity": 0.9}]


def test_steps_give_what_the_whole_scene_gives(hair: frisure.Hairstyle) -> None:
    stepwise = hair.wet().comb("left", strength=2)
    scene = frisure.Scene(SMALL).with_step("wet").with_step("comb", to="left", strength=2)
    whole = frisure.predict(scene)
    assert np.array_equal(stepwise.strands.points, whole.strands.points)
    assert stepwise.report == whole.report


def test_a_wrong_step_is_refused_with_a_hint(hair: frisure.Hairstyle) -> None:
    with pytest.raises(frisure.SceneError, match="chin") as wrong:
        hair.cut("chn")
    assert wrong.value.hint == 'did you mean "chin"?'
    with pytest.raises(frisure.SceneError, match="does not say where"):
        hair.cut()
    with pytest.raises(frisure.SceneError):
        hair.step("cutt", below="chin")
    with pytest.raises(TypeError, match="not both"):
        hair.step("humidity", 0.9, to=3)


def test_a_pickled_hairstyle_is_the_same(hair: frisure.Hairstyle) -> None:
    again = pickle.loads(pickle.dumps(hair.wet()))
    assert "not predicted yet" in repr(again)
    assert np.array_equal(again.strands.points, hair.wet().strands.points)
    assert "30 of 30 guides at rest" in repr(again)


def test_strands_are_copied_and_pickled_with_their_arrays(hair: frisure.Hairstyle) -> None:
    for same in (pickle.loads(pickle.dumps(hair.strands)), copy.deepcopy(hair.guides), copy.copy(hair.guides)):
        of = hair.strands if len(same) == len(hair.strands) else hair.guides
        assert np.array_equal(same.points, of.points) and np.array_equal(same.offsets, of.offsets)
        assert np.array_equal(same.radii, of.radii) and same.per_point == of.per_point
        assert set(same.attributes) == set(of.attributes)
        assert all(np.array_equal(same.attributes[name], of.attributes[name]) for name in of.attributes)
        assert repr(same) == repr(of) and not same.points.flags.writeable


def test_wrong_types_are_errors_of_the_package(hair: frisure.Hairstyle, tmp_path: Path) -> None:
    wrong: list[tuple[Any, str]] = [
        (lambda: hair.render(20, 20, alpha=1), "alpha is 1"),  # type: ignore[arg-type]
        (lambda: hair.render(20, 20, progress=1), "progress is 1"),  # type: ignore[arg-type]
        (lambda: hair.save(tmp_path / "a.hair", fibres="x"), "fibres is 'x'"),  # type: ignore[arg-type]
        (lambda: hair.save(3), "path is 3"),  # type: ignore[arg-type]
        (lambda: hair.step(1), "step is 1"),  # type: ignore[arg-type]
        (lambda: hair.strands[np.array([0, 1])], "index of a strand is array"),  # type: ignore[call-overload]
    ]
    for call, words in wrong:
        with pytest.raises(frisure.ArgumentError, match=words):
            call()
    assert issubclass(frisure.ArgumentTypeError, (TypeError, ValueError))


def test_pictures_are_arrays(hair: frisure.Hairstyle) -> None:
    picture = hair.render()
    assert (picture.shape, picture.dtype) == ((140, 120, 3), np.uint8)
    assert picture.std() > 10
    assert hair.render(64, 50, alpha=True).shape == (50, 64, 4)
    assert not np.array_equal(hair.render(azimuth=180), picture)
    traced = hair.render(40, 30, quality="final", paths=4, noise=0)
    assert traced.shape == (30, 40, 3)
    png = hair._repr_png_()
    assert png.startswith(b"\x89PNG\r\n\x1a\n")


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ({"width": 0}, "width is 0"),
        ({"width": 100_000}, "100000"),
        ({"quality": "best"}, "quality is 'best'"),
        ({"noise": float("nan")}, "noise is nan"),
        ({"azimuth": float("inf")}, "azimuth is inf"),
        ({"paths": -1}, "paths is -1"),
    ],
)
def test_wrong_pictures_are_refused(
    hair: frisure.Hairstyle, arguments: dict[str, object], name: str
) -> None:
    with pytest.raises(frisure.ArgumentError, match=name):
        hair.render(**arguments)  # type: ignore[arg-type]


def test_files_have_the_bytes_of_the_command_line(tmp_path: Path) -> None:
    scene = frisure.Scene(SMALL).with_step("wet").with_step("cut", below="chin")
    hair = frisure.predict(scene)
    hair.save(tmp_path / "scene.toml")
    names = ["hair.hair", "hair.usdc", "hair.abc", "hair.png", "report.json"]
    for name in names:
        hair.save(tmp_path / f"python-{name}")
    line = ["predict", tmp_path / "scene.toml", "--report", tmp_path / "report.json"]
    line += ["--image", tmp_path / "hair.png"]
    for name in names[:3]:
        line += ["-o", tmp_path / name]
    ran = run(*line)
    assert ran.returncode == 0, ran.stderr
    for name in names:
        assert (tmp_path / name).read_bytes() == (tmp_path / f"python-{name}").read_bytes(), name
    assert json.loads((tmp_path / "report.json").read_text()) == hair.report
    with pytest.raises(ValueError, match="xyz"):
        hair.save(tmp_path / "hair.xyz")
    with pytest.raises(frisure.FrisureError, match="nowhere"):
        hair.save(tmp_path / "nowhere" / "hair.hair")


def test_the_command_has_the_exit_status_of_the_program(tmp_path: Path) -> None:
    assert run("--version").stdout.strip() == f"frisure {frisure.__version__}"
    assert run("presets").returncode == 0
    wrong = run("predict", tmp_path / "nowhere.toml")
    assert (wrong.returncode, "there is no file" in wrong.stderr) == (2, True)
    assert run("nonsense").returncode == 2


def test_a_picture_is_readable_as_png(hair: frisure.Hairstyle, tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image")
    hair.save(tmp_path / "hair.png")
    read = np.asarray(image.open(tmp_path / "hair.png").convert("RGBA"))
    assert np.array_equal(read, hair.render(alpha=True))
    assert image.open(io.BytesIO(hair._repr_png_())).size == (450, 525)
