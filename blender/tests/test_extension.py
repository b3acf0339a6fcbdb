"""The extension in Blender without a window: it is installed by Blender's own command, and every operator is called."""

import importlib
import os
import tempfile
from pathlib import Path

os.environ.setdefault("BLENDER_USER_RESOURCES", tempfile.mkdtemp(prefix="frisure-blender-"))

import bpy
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
ZIP = Path(os.environ.get("FRISURE_BLENDER", ROOT / "out" / "frisure-blender.zip"))
HEAD = ROOT / "scenes" / "heads" / "female-head.obj"

FEW = {"guides": 12, "hairs": 150}


@pytest.fixture(scope="session", autouse=True)
def extension():
    assert ZIP.is_file(), f"there is no {ZIP}: make it with blender/build.py"
    done = bpy.ops.extensions.package_install_files(filepath=str(ZIP), repo="user_default", enable_on_install=True)
    assert done == {"FINISHED"}
    assert hasattr(bpy.types.Object, "frisure")


@pytest.fixture
def head():
    """The only object: the mesh of a head, selected."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if not hasattr(bpy.types.Object, "frisure"):
        bpy.ops.preferences.addon_enable(module="bl_ext.user_default.frisure")
    # Blender's defaults: y up and a face that looks along +z become z up and a face along -y.
    bpy.ops.wm.obj_import(filepath=str(HEAD))
    mesh = bpy.context.selected_objects[0]
    bpy.context.view_layer.objects.active = mesh
    return mesh


def grown(head, **keys):
    assert bpy.ops.object.frisure_add(**(FEW | keys)) == {"FINISHED"}
    hair = next(o for o in bpy.data.objects if o.type == "CURVES")
    bpy.context.view_layer.objects.active = hair
    return hair


def world(hair) -> np.ndarray:
    """The points of the curves in metres."""
    points = np.empty(3 * len(hair.data.points), dtype=np.float32)
    hair.data.attributes["position"].data.foreach_get("vector", points)
    matrix = np.array(hair.matrix_world)
    unit = bpy.context.scene.unit_settings.scale_length
    return (points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]) * unit


def refused(call, words: str, **keys) -> None:
    """An operator that reports an error raises in a script."""
    with pytest.raises(RuntimeError, match=words):
        call(**keys)


def module(name: str):
    return importlib.import_module(f"bl_ext.user_default.frisure.{name}")


def written_here(head, path) -> None:
    """The mesh as the test writes it, in metres."""
    points = [head.matrix_world @ v.co * bpy.context.scene.unit_settings.scale_length for v in head.data.vertices]
    lines = [f"v {p.x:.9g} {p.y:.9g} {p.z:.9g}" for p in points]
    lines += ["f " + " ".join(str(i + 1) for i in face.vertices) for face in head.data.polygons]
    path.write_text("\n".join(lines))


def library(hair, mesh):
    """What the library gives for the scene of the object on a mesh."""
    import frisure

    scene = frisure.Scene.from_text(hair.frisure.scene)
    scene.update({"head.mesh": str(mesh), "head.unit": "m", "head.up": "z"})
    return frisure.predict(scene)


def test_hair_is_that_of_the_library_on_a_head_that_is_moved_and_scaled(head, tmp_path):
    head.location = (1.0, 2.0, 0.5)
    bpy.context.scene.unit_settings.scale_length = 0.01
    head.scale = [100.0 * s for s in head.scale]
    bpy.context.view_layer.update()
    hair = grown(head, hair_type="caucasian-curly", length=0.12)
    written_here(head, tmp_path / "head.obj")
    strands = library(hair, tmp_path / "head.obj").strands
    assert len(hair.data.curves) == len(strands) == 150
    assert np.abs(world(hair) - strands.points).max() < 2e-5
    radii = np.empty(len(hair.data.points), dtype=np.float32)
    hair.data.attributes["radius"].data.foreach_get("value", radii)
    size = 0.01 * abs(hair.matrix_world.determinant()) ** (1 / 3)
    assert np.allclose(radii * size, strands.radii, rtol=1e-4)


def test_hair_is_bound_to_its_head_and_has_a_material(head):
    hair = grown(head, hair_type="african-coily")
    assert hair.data.surface == head and hair.parent == head
    assert hair.data.surface_uv_map in head.data.uv_layers
    assert "rest_position" in head.data.attributes
    uv = np.empty(2 * len(hair.data.curves), dtype=np.float32)
    hair.data.attributes["surface_uv_coordinate"].data.foreach_get("vector", uv)
    assert ((uv > 0.0) & (uv < 1.0)).all() and uv.reshape(-1, 2).std(axis=0).min() > 0.01
    shader = next(n for n in hair.active_material.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfHairPrincipled")
    assert shader.parametrization == "MELANIN" and shader.inputs["Melanin"].default_value > 0.8


def test_roots_are_where_their_texture_coordinates_are(head):
    """Blender's own nodes move each curve with the face at its texture coordinates."""
    hair = grown(head)
    layer = head.data.uv_layers[hair.data.surface_uv_map]
    head.data.calc_loop_triangles()
    points = world(hair)
    starts = [curve.first_point_index for curve in hair.data.curves]
    uv = np.empty(2 * len(starts), dtype=np.float32)
    hair.data.attributes["surface_uv_coordinate"].data.foreach_get("vector", uv)
    corners = np.array([[layer.uv[i].vector[:] for i in t.loops] for t in head.data.loop_triangles])
    spots = np.array([[(head.matrix_world @ head.data.vertices[i].co)[:] for i in t.vertices] for t in head.data.loop_triangles])
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    area = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    area[area == 0.0] = np.inf
    misses = []
    for start, p in zip(starts[::10], uv.reshape(-1, 2)[::10]):
        v = ((p - a)[:, 0] * (c - a)[:, 1] - (p - a)[:, 1] * (c - a)[:, 0]) / area
        w = ((b - a)[:, 0] * (p - a)[:, 1] - (b - a)[:, 1] * (p - a)[:, 0]) / area
        inside = np.minimum(np.minimum(v, w), 1.0 - v - w)
        # Where the map overlaps itself, one of the faces is the right one.
        found = [spots[i, 0] * (1 - v[i] - w[i]) + spots[i, 1] * v[i] + spots[i, 2] * w[i] for i in np.argsort(-inside)[:3]]
        misses.append(min(np.linalg.norm(q - points[start]) for q in found))
    assert np.median(misses) < 1e-3


def test_steps_are_those_of_the_library_and_can_be_taken_back(head, tmp_path):
    hair = grown(head, hair_type="caucasian-straight", length=0.25)
    dry = world(hair).copy()
    assert bpy.ops.object.frisure_wet() == {"FINISHED"}
    assert bpy.ops.object.frisure_cut(below="chin") == {"FINISHED"}
    assert bpy.ops.object.frisure_dry() == {"FINISHED"}
    assert bpy.ops.object.frisure_comb(to="back") == {"FINISHED"}
    assert bpy.ops.object.frisure_grow(months=2) == {"FINISHED"}
    assert bpy.ops.object.frisure_step(text='roll = { radius = "12 mm" }') == {"FINISHED"}
    assert [list(step) for step in _steps(hair)] == [["wet"], ["cut"], ["dry"], ["comb"], ["grow"], ["roll"]]
    # The same file, to the last digit: where hair lies after a comb can be a matter of chance.
    module("head").write(head, str(tmp_path / "head.obj"))
    strands = library(hair, tmp_path / "head.obj").strands
    assert np.abs(world(hair) - strands.points).max() < 2e-5
    assert bpy.ops.object.frisure_take_back() == {"FINISHED"}
    assert len(_steps(hair)) == 5
    assert bpy.ops.object.frisure_take_back(all_steps=True) == {"FINISHED"}
    assert not _steps(hair) and np.abs(world(hair) - dry).max() < 1e-6


def _steps(hair):
    import frisure

    return frisure.Scene.from_text(hair.frisure.scene).to_dict().get("step", [])


def test_every_hair_type_has_its_picture(head):
    import frisure

    items = module("thumbnails").hair_types()
    assert [item[0] for item in items] == list(frisure.presets.descriptions)
    icons = [item[3] for item in items]
    assert 0 not in icons and len(set(icons)) == len(icons)
    pictures = module("thumbnails")._pictures
    assert all(min(pictures[item[0]].image_size) >= 64 for item in items)
    # Settled curves and scripts name a type by its text.
    hair = grown(head, hair_type="type-8")
    assert hair.frisure.hair_type == "type-8"


def test_a_property_solves_again(head):
    hair = grown(head, length=0.1)
    before = world(hair).copy()
    hair.frisure.length = 0.2
    module("properties").solve_now(hair)
    longer = np.linalg.norm(np.diff(world(hair), axis=0), axis=1).sum() / np.linalg.norm(np.diff(before, axis=0), axis=1).sum()
    assert longer > 1.3 and 'length = "20 cm"' in hair.frisure.scene


def test_dragging_shows_coarse_hair_and_then_the_exact(head):
    """The timer does not run without a window: its function is called as Blender calls it."""
    import time

    hair = grown(head, length=0.1, guides=80, hairs=2000)
    hair.frisure.length = 0.15
    counts = set()
    for _ in range(600):
        again = module("properties").look()
        counts.add(len(hair.data.curves))
        if again is None:
            break
        time.sleep(again)
    assert again is None and not hair.frisure.problem
    assert counts == {2000, 1500} and len(hair.data.curves) == 2000


def test_curves_are_settled(head, tmp_path):
    hair = grown(head, hair_type="caucasian-wavy", length=0.1)
    shape = world(hair).copy()
    plain = bpy.data.objects.new("plain", hair.data.copy())
    bpy.context.scene.collection.objects.link(plain)
    plain.matrix_world = hair.matrix_world
    bpy.context.view_layer.objects.active = plain
    bpy.context.view_layer.update()
    assert bpy.ops.object.frisure_settle(hair_type="caucasian-wavy") == {"FINISHED"}
    # What the library makes of the same files; interpolated hairs are no equilibria, and move to the nearest.
    module("head").write(head, str(tmp_path / "head.obj"))
    hair.frisure.scene = plain.frisure.scene
    module("curves").write_groom(hair, str(tmp_path / "groom.obj"))
    import frisure

    scene = frisure.Scene.from_text(plain.frisure.scene)
    scene.update({"head.mesh": str(tmp_path / "head.obj"), "head.unit": "m", "head.up": "z"})
    scene.update({"groom.file": str(tmp_path / "groom.obj"), "groom.unit": "m", "groom.up": "z"})
    assert np.abs(world(plain) - frisure.predict(scene).strands.points).max() < 2e-5
    assert np.median(np.linalg.norm(world(plain) - shape, axis=1)) < 5e-3
    assert bpy.ops.object.frisure_wet() == {"FINISHED"}
    # Wet hair is heavier: tips come down.
    assert world(plain)[:, 2].mean() < shape[:, 2].mean()


def test_a_groom_is_saved_for_unreal(head, tmp_path):
    grown(head)
    path = tmp_path / "hair.abc"
    assert bpy.ops.object.frisure_export(filepath=str(path)) == {"FINISHED"}
    assert path.read_bytes()[:5] == b"Ogawa"
    refused(bpy.ops.object.frisure_export, "extension", filepath=str(tmp_path / "hair.xyz"))


def test_hair_grows_in_a_vertex_group(head):
    heights = [(head.matrix_world @ v.co).z for v in head.data.vertices]
    top = max(heights)
    group = head.vertex_groups.new(name="crown")
    group.add([i for i, height in enumerate(heights) if height > top - 0.04], 1.0, "REPLACE")
    hair = grown(head, scalp="crown", length=0.02)
    starts = [curve.first_point_index for curve in hair.data.curves]
    # Faces beside the group have hair where their corners are in it.
    assert world(hair)[starts, 2].min() > top - 0.06


def test_what_is_wrong_is_told(head):
    refused(bpy.ops.object.frisure_add, "no vertex group `nowhere`", scalp="nowhere", **FEW)
    head.vertex_groups.new(name="empty")
    refused(bpy.ops.object.frisure_add, "No face of", scalp="empty", **FEW)
    assert not [o for o in bpy.data.objects if o.type == "CURVES"]
    head.scale = (50, 50, 50)
    bpy.context.view_layer.update()
    refused(bpy.ops.object.frisure_add, "m across, and a head is between", **FEW)
    assert not [o for o in bpy.data.objects if o.type == "CURVES"]
    head.scale = (1, 1, 1)
    hair = grown(head)
    refused(bpy.ops.object.frisure_step, "is no step", text="roll = ")
    refused(bpy.ops.object.frisure_step, "2 keys", text="wet = {}\ndry = {}")
    refused(bpy.ops.object.frisure_take_back, "Nothing was done")
    before = hair.frisure.scene
    refused(bpy.ops.object.frisure_step, "fold", text="fold = {}")
    assert hair.frisure.scene == before
    assert bpy.ops.object.frisure_wet() == {"FINISHED"}
    bpy.data.objects.remove(head)
    refused(bpy.ops.object.frisure_take_back, "is gone")


def test_an_empty_mesh_is_no_head():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if not hasattr(bpy.types.Object, "frisure"):
        bpy.ops.preferences.addon_enable(module="bl_ext.user_default.frisure")
    empty = bpy.data.objects.new("empty", bpy.data.meshes.new("empty"))
    bpy.context.scene.collection.objects.link(empty)
    bpy.context.view_layer.objects.active = empty
    refused(bpy.ops.object.frisure_add, "no faces")
