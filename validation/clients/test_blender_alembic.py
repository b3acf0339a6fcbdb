"""Blender imports Alembic files of frisure, and frisure reads its exports."""

import bpy
import numpy as np
import pytest

import sample


@pytest.fixture(autouse=True)
def empty_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)


@pytest.fixture()
def imported(frisure, tmp_path):
    np.savez(tmp_path / "sample.npz", **sample.arrays())
    frisure.convert(tmp_path / "sample.npz", tmp_path / "sample.abc")
    bpy.ops.wm.alembic_import(filepath=str(tmp_path / "sample.abc"), scale=0.01)
    return {o.name: o for o in bpy.data.objects}


def points_of(curves):
    flat = np.empty(3 * len(curves.points), "f4")
    curves.attributes["position"].data.foreach_get("vector", flat)
    return flat.reshape(-1, 3)


def test_all_points_are_there(imported):
    assert {n for n, o in imported.items() if o.type == "CURVES"} == {
        "guides", "fringe", "crown", "back"}
    groups = sample.groups()
    for name in ("fringe", "crown", "back"):
        thing = imported[name]
        rows = groups == sample.REGIONS.index(name)
        assert [c.points_length for c in thing.data.curves] == [sample.POINTS] * rows.sum()
        matrix = np.array(thing.matrix_world)
        points = points_of(thing.data) @ matrix[:3, :3].T + matrix[:3, 3]
        # Blender is z up: the hair keeps its position, in metres.
        np.testing.assert_allclose(points, sample.positions()[rows].reshape(-1, 3), atol=2e-7)
        radii = np.empty(len(points), "f4")
        thing.data.attributes["radius"].data.foreach_get("value", radii)
        scale = np.cbrt(np.linalg.det(matrix[:3, :3]))
        expected = sample.arrays()["radii"][rows].ravel()
        np.testing.assert_allclose(radii * scale, expected, rtol=1e-5)


def curves_object(strands, kind):
    data = bpy.data.hair_curves.new("Hair")
    data.add_curves([len(s) for s in strands])
    data.set_types(type=kind)
    flat = np.concatenate(strands).astype("f4").ravel()
    data.attributes["position"].data.foreach_set("vector", flat)
    radius = data.attributes.get("radius") or data.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", np.full(len(flat) // 3, 5e-5, "f4"))
    thing = bpy.data.objects.new("Hair", data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


@pytest.mark.parametrize("kind", ["POLY", "CATMULL_ROM"])
def test_hair_that_blender_exports(tmp_path, hair_of, kind):
    strands = list(sample.positions(5, 16))
    thing = curves_object(strands, kind)
    thing.location = (0, 0.01, 0.02)
    path = tmp_path / "blender.abc"
    bpy.ops.wm.alembic_export(filepath=str(path), check_existing=False)
    points, widths, counts = hair_of(path, from_unit="m")
    assert list(counts) == [16] * 5
    expected = sample.positions(5, 16).reshape(-1, 3) + np.array([0, 0.01, 0.02])
    np.testing.assert_allclose(points, expected, atol=1e-6)
    np.testing.assert_allclose(widths, 1e-4, rtol=1e-4)


@pytest.mark.parametrize("kind", ["BEZIER", "NURBS"])
def test_splines_that_blender_exports(tmp_path, hair_of, kind):
    thing = curves_object(list(sample.positions(5, 16)), kind)
    bpy.context.view_layer.update()
    path = tmp_path / "blender.abc"
    bpy.ops.wm.alembic_export(filepath=str(path), check_existing=False)
    points, _, counts = hair_of(path, from_unit="m")
    assert len(counts) == 5 and thing.data.curves[0].points_length == 16
    # Such curves are near their control points.
    control = sample.positions(5, 16).reshape(-1, 3)
    nearest = np.linalg.norm(points[:, None] - control[None], axis=-1).min(1)
    assert nearest.max() < 0.01
