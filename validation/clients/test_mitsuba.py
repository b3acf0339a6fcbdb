"""Mitsuba 3 loads curves, and its picture has hair in the right place."""

import mitsuba
import numpy as np
import pytest

import sample

mitsuba.set_variant("scalar_rgb")


@pytest.fixture()
def curves(frisure, tmp_path):
    source, path = tmp_path / "sample.npz", tmp_path / "sample.txt"
    arrays = sample.arrays(400, 24)
    np.savez(source, positions=arrays["positions"], radii=np.full((400, 24), 2e-4, "f4"))
    frisure.convert(source, path)
    return path


@pytest.mark.parametrize("kind", ["linearcurve", "bsplinecurve"])
def test_curves_are_where_they_should_be(curves, kind):
    shape = mitsuba.load_dict({"type": kind, "filename": str(curves)})
    box = shape.bbox()
    points = sample.y_up(sample.positions(400, 24)).reshape(-1, 3)
    slack = 1e-3 if kind == "linearcurve" else 0.02
    np.testing.assert_allclose(np.array(box.min).ravel(), points.min(0), atol=slack)
    np.testing.assert_allclose(np.array(box.max).ravel(), points.max(0), atol=slack)
    pieces = 23 if kind == "linearcurve" else 21
    assert shape.primitive_count() == 400 * pieces


def test_a_picture_has_hair(curves, tmp_path):
    look = mitsuba.ScalarTransform4f().look_at([0, 0, 0.6], [0, 0, 0], [0, 1, 0])
    scene = mitsuba.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 4, "hide_emitters": True},
        "light": {"type": "constant"},
        "hair": {"type": "linearcurve", "filename": str(curves), "bsdf": {"type": "hair"}},
        "sensor": {
            "type": "perspective", "fov": 40, "to_world": look,
            "film": {"type": "hdrfilm", "width": 160, "height": 160, "pixel_format": "rgba"},
            "sampler": {"type": "independent", "sample_count": 16},
        },
    })
    image = np.array(mitsuba.render(scene))
    mitsuba.util.write_bitmap(str(tmp_path / "hair.png"), image)
    cover = image[..., 3]
    assert 0.1 < (cover > 0.05).mean() < 0.7
    assert np.isfinite(image).all()
    # The corners are empty, the middle has hair.
    assert cover[:20, :20].max() == 0 and cover[60:110, 60:100].mean() > 0.3
