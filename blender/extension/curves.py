"""Strands of frisure as a Curves object of Blender, and back."""

import math

import bpy
import numpy as np
from mathutils import Matrix

from . import head as heads

MATERIAL = "frisure hair"


def new_object(head):
    """An empty Curves object on the head, with its surface set."""
    data = bpy.data.hair_curves.new(f"{head.name} hair")
    hair = bpy.data.objects.new(data.name, data)
    collection = head.users_collection[0] if head.users_collection else bpy.context.scene.collection
    collection.objects.link(hair)
    hair.parent = head
    hair.matrix_parent_inverse = Matrix()
    bpy.context.view_layer.update()
    attach(hair, head)
    return hair


def attach(hair, head) -> None:
    """Binds the curves to the surface of the head: Blender's own tools and nodes find the roots there."""
    heads.ensure_rest_position(head)
    hair.data.surface = head
    hair.data.surface_uv_map = heads.ensure_uv_map(head)


def write(hair, strands) -> None:
    """Replaces the curves of an object by strands (m)."""
    data = hair.data
    if not np.array_equal(sizes(data), strands.counts):
        if len(data.curves) > 0:
            data.remove_curves()
        data.add_curves(strands.counts.tolist())
    unit = heads.metres_per_unit()
    matrix = np.array(hair.matrix_world.inverted())
    points = strands.points.astype(np.float64) / unit @ matrix[:3, :3].T + matrix[:3, 3]
    data.attributes["position"].data.foreach_set("vector", points.astype(np.float32).ravel())
    # Radii are lengths: the object's own scale takes part in them.
    scale = unit * abs(hair.matrix_world.determinant()) ** (1.0 / 3.0)
    set_attribute(data, "radius", "FLOAT", "POINT", "value", strands.radii / scale)
    if "root_uv" in strands.attributes:
        set_attribute(data, "surface_uv_coordinate", "FLOAT2", "CURVE", "vector", strands.attributes["root_uv"])
    if "group" in strands.attributes:
        set_attribute(data, "frisure_group", "INT", "CURVE", "value", strands.attributes["group"].astype(np.int32))
    data.update_tag()


def sizes(data) -> np.ndarray:
    """The number of points of each curve, (H,)."""
    counts = np.empty(len(data.curves), dtype=np.int32)
    data.curves.foreach_get("points_length", counts)
    return counts


def set_attribute(data, name: str, kind: str, domain: str, field: str, values) -> None:
    attribute = data.attributes.get(name) or data.attributes.new(name, kind, domain)
    values = np.ascontiguousarray(values, dtype=np.int32 if kind == "INT" else np.float32)
    attribute.data.foreach_set(field, values.ravel())


def read(hair) -> tuple[np.ndarray, np.ndarray]:
    """Points (m) of all curves, (N, 3), and their offsets, (H + 1,)."""
    data = hair.data
    count = len(data.curves)
    if count == 0:
        raise heads.HeadError(f"{hair.name} has no curves")
    offsets = np.empty(count, dtype=np.int32)
    data.curves.foreach_get("first_point_index", offsets)
    points = np.empty(3 * len(data.points), dtype=np.float32)
    data.attributes["position"].data.foreach_get("vector", points)
    matrix = np.array(hair.matrix_world)
    world = (points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]) * heads.metres_per_unit()
    if not np.isfinite(world).all():
        raise heads.HeadError(f"{hair.name} has points that are no numbers")
    return world, np.append(offsets, len(data.points))


def write_groom(name: str, groom: tuple[np.ndarray, np.ndarray], path: str) -> None:
    """Writes points and offsets of the curves of this name as lines of Wavefront OBJ in metres, z up."""
    points, offsets = groom
    if (np.diff(offsets) < 2).any():
        raise heads.HeadError(f"{name} has curves of a single point")
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in points.tolist()]
    for start, end in zip(offsets[:-1].tolist(), offsets[1:].tolist()):
        lines.append("l " + " ".join(str(i + 1) for i in range(start, end)))
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def set_material(hair, eumelanin: float, pheomelanin: float) -> None:
    """Gives the hair Blender's Principled Hair BSDF with the melanin of its scene.

    Blender has Melanin = 1 - exp(-(eumelanin + pheomelanin)), and Redness is the pheomelanin's share.
    """
    material = hair.active_material
    if material is None:
        material = bpy.data.materials.new(MATERIAL)
        if material.node_tree is None:
            material.use_nodes = True
        hair.data.materials.append(material)
    nodes = material.node_tree.nodes
    shader = next((n for n in nodes if n.bl_idname == "ShaderNodeBsdfHairPrincipled"), None)
    if shader is None:
        nodes.clear()
        shader = nodes.new("ShaderNodeBsdfHairPrincipled")
        out = nodes.new("ShaderNodeOutputMaterial")
        out.location.x = 300
        material.node_tree.links.new(shader.outputs[0], out.inputs["Surface"])
    shader.parametrization = "MELANIN"
    total = eumelanin + pheomelanin
    shader.inputs["Melanin"].default_value = 1.0 - math.exp(-total)
    shader.inputs["Melanin Redness"].default_value = pheomelanin / total if total > 0.0 else 0.0
