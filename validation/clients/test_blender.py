"""Blender, as a module, imports files of frisure, and frisure reads its exports."""

import os
import pathlib

import bpy
import numpy as np
import pytest
from pxr import Usd, UsdGeom

KINDS = ("usda", "usdc")


def quietly(work):
    """Runs a script; returns Blender's output without times."""
    report = pathlib.Path(bpy.app.tempdir) / "said.txt"
    old = os.dup(1), os.dup(2)
    with open(report, "w") as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
        try:
            assert work() == {"FINISHED"}
        finally:
            for number, kept in enumerate(old, 1):
                os.dup2(kept, number)
                os.close(kept)
    return [line for line in report.read_text().splitlines() if line and " took " not in line]


@pytest.fixture(autouse=True)
def empty():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def values(attribute, name, width):
    found = np.zeros(len(attribute.data) * width, np.float32)
    attribute.data.foreach_get(name, found)
    return found.reshape(-1, width) if width > 1 else found


@pytest.mark.parametrize("kind", KINDS)
def test_hair_and_head_are_imported(head, kind, hair_of):
    path = str(head / f"head.{kind}")
    said = quietly(lambda: bpy.ops.wm.usd_import(filepath=path, import_guide=True, import_all_materials=True))
    assert said == []
    positions, thickness, counts = hair_of(head / "head.hair")
    hairs = bpy.data.objects["hairs"]
    curves = hairs.data
    assert hairs.type == "CURVES" and np.allclose(hairs.matrix_world, np.eye(4))
    assert [c.points_length for c in curves.curves] == list(counts)
    assert np.abs(values(curves.attributes["position"], "vector", 3) - positions).max() < 2e-7
    assert np.abs(values(curves.attributes["radius"], "value", 1) - thickness / 2).max() < 1e-9
    assert {c.curve_type for c in curves.curves} == {"CATMULL_ROM"} if hasattr(curves.curves[0], "curve_type") else True
    domains = {a.name: a.domain for a in curves.attributes}
    for name in ("surface_uv_coordinate", "guide_curve_index", "groom_id", "groom_group_id", "groom_guide_weights"):
        assert domains[name] == "CURVE"
    for name in ("frisure:d1", "frisure:natural_strain"):
        assert domains[name] == "POINT"
    guides = bpy.data.objects["guides"].data
    assert len(guides.curves) > 50
    index = np.zeros(len(counts), np.int32)
    curves.attributes["guide_curve_index"].data.foreach_get("value", index)
    assert 0 <= index.min() and index.max() < len(guides.curves)
    # Each of the three guides and weights, as Pixar's library reads them.
    stage = Usd.Stage.Open(path)
    primvars = UsdGeom.PrimvarsAPI(stage.GetPrimAtPath("/groom/hairs"))
    closest = np.array(primvars.GetPrimvar("groom_closest_guides").Get()).reshape(-1, 3)
    weights = np.array(primvars.GetPrimvar("groom_guide_weights").ComputeFlattened())
    assert closest.max() > 0 and (closest[:, 0] == index).all()
    for k in range(3):
        single = np.zeros(len(counts), np.int32)
        curves.attributes[f"groom_closest_guide_{k}"].data.foreach_get("value", single)
        assert (single == closest[:, k]).all()
        assert (values(curves.attributes[f"groom_guide_weight_{k}"], "value", 1) == weights[:, k]).all()
    clumps = np.zeros(len(counts), np.int32)
    curves.attributes["groom_clumpid"].data.foreach_get("value", clumps)
    assert (clumps == index).all()
    skin = bpy.data.objects["head"].data.materials[0]
    colour = next(n for n in skin.node_tree.nodes if n.type == "BSDF_PRINCIPLED").inputs["Base Color"]
    assert np.allclose(colour.default_value[:3], [0.40, 0.29, 0.235])
    # Blender imports the material, but does not assign it to curves.
    assert "hair" in bpy.data.materials


def test_guides_are_not_drawn_unasked(head):
    quietly(lambda: bpy.ops.wm.usd_import(filepath=str(head / "head.usdc")))
    assert "guides" not in bpy.data.objects and "hairs" in bpy.data.objects


def test_roots_are_on_the_head(head):
    quietly(lambda: bpy.ops.wm.usd_import(filepath=str(head / "head.usdc")))
    skin = bpy.data.objects["head"]
    curves = bpy.data.objects["hairs"].data
    for curve in list(curves.curves)[::20]:
        root = curves.points[curve.first_point_index].position
        found, place, _, _ = skin.closest_point_on_mesh(root)
        assert found and (place - root).length < 1e-3


def test_texture_coordinates_of_roots_are_those_of_the_head(head):
    quietly(lambda: bpy.ops.wm.usd_import(filepath=str(head / "head.usdc")))
    skin = bpy.data.objects["head"].data
    vertices = np.zeros(len(skin.vertices) * 3, np.float32)
    skin.vertices.foreach_get("co", vertices)
    vertices = vertices.reshape(-1, 3)
    rest = skin.attributes["rest_position"]
    assert rest.domain == "POINT" and (values(rest, "vector", 3) == vertices).all()
    corners = values(skin.uv_layers["st"], "uv", 2).reshape(-1, 3, 2).astype(float)
    index = np.zeros(len(skin.loops), np.int32)
    skin.loops.foreach_get("vertex_index", index)
    places = vertices[index].reshape(-1, 3, 3).astype(float)

    def cross(a, b):
        return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]

    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    area = cross(b - a, c - a)
    curves = bpy.data.objects["hairs"].data
    uvs = values(curves.attributes["surface_uv_coordinate"], "vector", 2)
    for curve, uv in list(zip(curves.curves, uvs))[::20]:
        weights = np.stack([cross(b - uv, c - uv), cross(c - uv, a - uv), cross(a - uv, b - uv)], -1)
        with np.errstate(divide="ignore", invalid="ignore"):
            weights /= area[:, None]
        inside = np.flatnonzero((weights > -1e-4).all(axis=1) & (area != 0))
        found = (weights[inside, :, None] * places[inside]).sum(axis=1)
        root = np.array(curves.points[curve.first_point_index].position)
        # Drawn hairs begin 0.3 mm below the skin, and come out of it at the root: what leaves it flat begins up to 1.5 mm behind.
        assert len(found) > 0
        normals = np.cross(places[inside, 1] - places[inside, 0], places[inside, 2] - places[inside, 0])
        depth = ((found - root) * normals).sum(axis=1) / np.linalg.norm(normals, axis=1)
        assert np.abs(depth).max() < 4e-4 and np.linalg.norm(found - root, axis=1).max() < 1.6e-3


@pytest.mark.parametrize("bound", [True, False])
def test_hair_follows_the_head_as_it_deforms(head, bound):
    """The node Deform Curves on Surface finds all that it asks for, and moves hair as its modifier moves the head."""
    quietly(lambda: bpy.ops.wm.usd_import(filepath=str(head / "head.usdc")))
    skin, hairs = bpy.data.objects["head"], bpy.data.objects["hairs"]
    if not bound:
        skin.data.uv_layers.remove(skin.data.uv_layers["st"])
    hairs.data.surface = skin
    hairs.data.surface_uv_map = "st"
    before = values(hairs.data.attributes["position"], "vector", 3).copy()
    lift = skin.modifiers.new("lift", "DISPLACE")
    lift.direction, lift.mid_level, lift.strength = "Z", 0.0, 0.02
    tree = bpy.data.node_groups.new("follow", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    deform = tree.nodes.new("GeometryNodeDeformCurvesOnSurface")
    tree.links.new(start.outputs[0], deform.inputs[0])
    tree.links.new(deform.outputs[0], end.inputs[0])
    follow = hairs.modifiers.new("follow", "NODES")
    follow.node_group = tree
    bpy.context.view_layer.update()
    found = hairs.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    after = values(found.attributes["position"], "vector", 3)
    moved = np.abs(after - before - [0, 0, 0.02 if bound else 0]).max()
    assert moved < 1e-5, moved
    # What the node says to its user.
    told = [(warning.type, warning.message) for warning in follow.node_warnings]
    assert told == ([] if bound else [("ERROR", 'Evaluated surface missing UV map: "st"')])


def make(kind):
    """Three curves of 4, 5 and 6 points, translated and rotated."""
    data = bpy.data.hair_curves.new(kind)
    data.add_curves([4, 5, 6])
    points = [[0.01 * i, 0.004 * k * k, 1.5 - 0.02 * k] for i, n in enumerate([4, 5, 6]) for k in range(n)]
    data.attributes["position"].data.foreach_set("vector", np.array(points, np.float32).ravel())
    radius = data.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", np.linspace(1e-4, 5e-5, 15, dtype=np.float32))
    index = data.attributes.new("groom_group_id", "INT", "CURVE")
    index.data.foreach_set("value", np.array([2, 1, 0], np.int32))
    data.set_types(type=kind)
    place = bpy.data.objects.new(kind, data)
    place.location, place.rotation_euler, place.scale = (0.1, 0.2, 0.0), (0.0, 0.3, 0.5), (1.5, 1.5, 1.5)
    bpy.context.scene.collection.objects.link(place)
    bpy.context.view_layer.update()
    return np.array([place.matrix_world @ __import__("mathutils").Vector(p) for p in points])


@pytest.mark.parametrize("extension", KINDS)
@pytest.mark.parametrize("kind", ["POLY", "CATMULL_ROM"])
def test_what_blender_exports_is_read(kind, extension, hair_of, tmp_path):
    world = make(kind)
    path = str(tmp_path / f"{kind}.{extension}")
    quietly(lambda: bpy.ops.wm.usd_export(filepath=path))
    positions, thickness, counts = hair_of(path)
    assert list(counts) == [4, 5, 6]
    assert np.abs(positions - world).max() < 1e-6
    assert np.allclose(thickness, 2 * 1.5 * np.linspace(1e-4, 5e-5, 15), rtol=1e-5)


def test_nurbs_are_read_as_points_on_them(hair_of, tmp_path):
    world = make("NURBS")
    path = str(tmp_path / "nurbs.usdc")
    quietly(lambda: bpy.ops.wm.usd_export(filepath=path))
    positions, _, counts = hair_of(path)
    assert list(counts) == [4, 5, 6]
    # Points are in the hulls of their vertices.
    for first, n in ((0, 4), (4, 5), (9, 6)):
        low, high = world[first : first + n].min(axis=0), world[first : first + n].max(axis=0)
        own = positions[first : first + n]
        assert (own > low - 1e-6).all() and (own < high + 1e-6).all()


def test_other_units_are_the_same_size(head, frisure, tmp_path):
    out = tmp_path / "cm.usdc"
    frisure.convert(head / "head.usdc", out, unit="cm", up="y")
    quietly(lambda: bpy.ops.wm.usd_import(filepath=str(head / "head.usdc")))
    bpy.context.view_layer.update()
    skin = bpy.data.objects["head"]
    metres = [tuple(skin.matrix_world @ v.co) for v in list(skin.data.vertices)[:50]]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    quietly(lambda: bpy.ops.wm.usd_import(filepath=str(out)))
    bpy.context.view_layer.update()
    skin = bpy.data.objects["head"]
    turned = [tuple(skin.matrix_world @ v.co) for v in list(skin.data.vertices)[:50]]
    assert np.allclose(metres, turned, atol=1e-5)


HEADS = {
    "usdc": lambda path: bpy.ops.wm.usd_export(filepath=path),
    "usda": lambda path: bpy.ops.wm.usd_export(filepath=path),
    "glb": lambda path: bpy.ops.export_scene.gltf(filepath=path, export_vertex_color="ACTIVE"),
    "gltf": lambda path: bpy.ops.export_scene.gltf(
        filepath=path, export_format="GLTF_SEPARATE", export_vertex_color="ACTIVE"
    ),
    "ply": lambda path: bpy.ops.wm.ply_export(filepath=path),
    "obj": lambda path: bpy.ops.wm.obj_export(filepath=path, export_colors=True),
}


def ply_with_y_up(path):
    return bpy.ops.wm.ply_export(filepath=path, up_axis="Y", forward_axis="NEGATIVE_Z")


# A PLY does not state its axes: the default are Blender's, and the scene can set others.
@pytest.mark.parametrize(
    "extension, export, axis",
    [(extension, export, "") for extension, export in HEADS.items()]
    + [("ply", ply_with_y_up, 'up = "y"')],
)
def test_hair_grows_where_blender_painted(
    extension, export, axis, head, frisure, hair_of, tmp_path
):
    quietly(lambda: bpy.ops.wm.usd_import(filepath=str(head / "head.usdc")))
    for other in [o for o in bpy.data.objects if o.type == "CURVES"]:
        bpy.data.objects.remove(other)
    skin = bpy.data.objects["head"].data
    for name in [a.name for a in skin.color_attributes]:
        skin.color_attributes.remove(skin.color_attributes[name])
    # White on the top of its left half, black elsewhere.
    paint = skin.color_attributes.new("displayColor", "BYTE_COLOR", "CORNER")
    top = max(v.co.z for v in skin.vertices)
    for corner in skin.loops:
        place = skin.vertices[corner.vertex_index].co
        white = float(place.z > top - 0.05 and place.x > 0)
        paint.data[corner.index].color = (white, white, white, 1.0)
    skin.color_attributes.active_color = paint
    skin.color_attributes.render_color_index = 0
    quietly(lambda: export(str(tmp_path / f"painted.{extension}")))
    scene = tmp_path / "scene.toml"
    scene.write_text(
        f'[hair]\ntype = "straight"\nlength = "3 cm"\n[wisps]\nhairs = 200\ncount = 40\n'
        f'[head]\nmesh = "painted.{extension}"\nscalp_colour = "red"\n{axis}\n'
    )
    frisure.run("predict", scene, "-o", tmp_path / "grown.usdc")
    positions, _, counts = hair_of(tmp_path / "grown.usdc")
    roots = positions[np.concatenate([[0], np.cumsum(counts)[:-1]])]
    assert len(roots) == 200
    # Up to a triangle beside the white area.
    assert roots[:, 2].min() > top - 0.07 and roots[:, 2].max() < top + 1e-3
    assert roots[:, 0].min() > -0.02 and roots[:, 0].max() > 0.03
