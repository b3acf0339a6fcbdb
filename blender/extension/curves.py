"""Strands of frisure as a Curves object of Blender, and back."""

import math

import bpy
import numpy as np
from mathutils import Matrix

from . import head as heads

MATERIAL = "frisure hair"


def new_object(head):
    """An empty Curves object on the head, with its surface set."""
    uv_map = heads.ensure_uv_map(head)
    heads.ensure_rest_position(head)
    data = bpy.data.hair_curves.new(f"{head.name} hair")
    hair = bpy.data.objects.new(data.name, data)
    # Beside the head, in a collection that is shown.
    for collection in [*head.users_collection, bpy.context.scene.collection]:
        collection.objects.link(hair)
        bpy.context.view_layer.update()
        if hair.name in bpy.context.view_layer.objects:
            break
        collection.objects.unlink(hair)
    hang(hair, head)
    data.surface, data.surface_uv_map = head, uv_map
    return hair


def hang(hair, head) -> None:
    """Makes the head the parent of the hair, in its axes."""
    hair.parent = head
    hair.matrix_parent_inverse = Matrix()
    bpy.context.view_layer.update()


def uv_map_on(hair, head) -> str:
    """The name of the UV map by which the curves are bound to a head; empty where they are bound to none, or to another one."""
    return hair.data.surface_uv_map if hair.data.surface == head else ""


def attach(hair, head) -> None:
    """Binds the curves to the surface of the head: Blender's own tools and nodes find the roots there."""
    uv_map = heads.ensure_uv_map(head, uv_map_on(hair, head))
    heads.ensure_rest_position(head)
    hair.data.surface, hair.data.surface_uv_map = head, uv_map


def matrix_of(hair) -> Matrix:
    """From the object's axes to those of the scene. Blender does not evaluate `matrix_world` of an object that is hidden."""
    if len(hair.constraints) > 0 or (hair.parent is not None and hair.parent_type != "OBJECT"):
        return hair.matrix_world
    if hair.parent is None:
        return hair.matrix_basis
    return hair.parent.matrix_world @ hair.matrix_parent_inverse @ hair.matrix_basis


def write(hair, strands) -> None:
    """Replaces the curves of an object by strands (m)."""
    data = hair.data
    if not np.array_equal(sizes(data), strands.counts):
        kept = of_curves(data) if len(data.curves) == len(strands.counts) else []
        if len(data.curves) > 0:
            data.remove_curves()
        data.add_curves(strands.counts.tolist())
        for attribute, field, values in kept:
            attribute = data.attributes.get(attribute)
            if attribute is not None:
                attribute.data.foreach_set(field, values)
    if not set(types(data)) <= SMOOTH:
        data.set_types(type="CATMULL_ROM")
    if "cyclic" in data.attributes:
        data.attributes.remove(data.attributes["cyclic"])
    unit = heads.metres_per_unit()
    matrix_world = matrix_of(hair)
    matrix = np.array(matrix_world.inverted())
    points = strands.points.astype(np.float64) / unit @ matrix[:3, :3].T + matrix[:3, 3]
    data.attributes["position"].data.foreach_set("vector", points.astype(np.float32).ravel())
    # Radii are lengths: the object's own scale takes part in them.
    scale = unit * abs(matrix_world.determinant()) ** (1.0 / 3.0)
    set_attribute(data, "radius", "FLOAT", "POINT", "value", strands.radii / scale)
    if "root_uv" in strands.attributes:
        set_attribute(data, "surface_uv_coordinate", "FLOAT2", "CURVE", "vector", strands.attributes["root_uv"])
    if "group" in strands.attributes:
        set_attribute(data, "frisure_group", "INT", "CURVE", "value", strands.attributes["group"].astype(np.int32))
    data.update_tag()


# The types of curves that go through their points, by Blender's numbers.
SMOOTH = {0, 1}

# The field, the width and the type of the values of attributes, by their data type.
FIELDS = {"FLOAT": ("value", 1, np.float32), "INT": ("value", 1, np.int32), "FLOAT2": ("vector", 2, np.float32),
          "FLOAT_VECTOR": ("vector", 3, np.float32), "FLOAT_COLOR": ("color", 4, np.float32)}  # fmt: skip


def of_curves(data) -> list:
    """The attributes that each curve has one value of: name, field and values."""
    kept = []
    for attribute in data.attributes:
        if attribute.domain == "CURVE" and attribute.data_type in FIELDS and not attribute.is_internal:
            field, width, kind = FIELDS[attribute.data_type]
            values = np.empty(width * len(attribute.data), dtype=kind)
            attribute.data.foreach_get(field, values)
            kept.append((attribute.name, field, values))
    return kept


def types(data) -> np.ndarray:
    """The type of each curve: 0 Catmull-Rom, 1 poly, 2 Bezier, 3 NURBS."""
    attribute = data.attributes.get("curve_type")
    kinds = np.zeros(len(data.curves), dtype=np.int32)
    if attribute is not None:
        attribute.data.foreach_get("value", kinds)
    return kinds


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
    if not set(types(data).tolist()) <= SMOOTH:
        raise heads.HeadError(f"{hair.name} has Bezier or NURBS curves, which do not go through their points: set their type to Catmull-Rom or poly")
    cyclic = data.attributes.get("cyclic")
    if cyclic is not None and any(curve.value for curve in cyclic.data):
        raise heads.HeadError(f"{hair.name} has closed curves; hair has a root and a tip: open them (Toggle Cyclic)")
    offsets = np.empty(count, dtype=np.int32)
    data.curves.foreach_get("first_point_index", offsets)
    points = np.empty(3 * len(data.points), dtype=np.float32)
    data.attributes["position"].data.foreach_get("vector", points)
    matrix = np.array(matrix_of(hair) if isinstance(hair, bpy.types.Object) else hair.matrix_world)
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


# The property of a material that keeps the pigments which the extension gave it.
GIVEN = "frisure_pigment"


def new_material():
    material = bpy.data.materials.new(MATERIAL)
    if material.node_tree is None:
        material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    shader = nodes.new("ShaderNodeBsdfHairPrincipled")
    shader.parametrization = "MELANIN"
    out = nodes.new("ShaderNodeOutputMaterial")
    out.location.x = 300
    material.node_tree.links.new(shader.outputs[0], out.inputs["Surface"])
    return material


def put(data, material, before=None) -> None:
    """Puts a material into the slots of another one, or into the empty ones; a new slot if there is none."""
    slots = [i for i, other in enumerate(data.materials) if other == before]
    for i in slots:
        data.materials[i] = material
    if not slots:
        data.materials.append(material)


def set_material(hair, eumelanin: float, pheomelanin: float) -> None:
    """Gives the hair Blender's Principled Hair BSDF with the melanin of its scene: a material that the extension made, while its hair has the
    colour that the extension gave it. A material of the artist stays as it is.

    Blender has Melanin = 1 - exp(-(eumelanin + pheomelanin)), and Redness is the pheomelanin's share.
    """
    material = hair.active_material
    pigment = [eumelanin, pheomelanin]
    if material is None:
        material = new_material()
        put(hair.data, material)
    elif GIVEN not in material or list(material[GIVEN]) == pigment:
        return
    elif material.users > 1:
        # Another hair has it, of another colour.
        copied = material.copy()
        put(hair.data, copied, material)
        material = copied
    material[GIVEN] = pigment
    shader = next((n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfHairPrincipled"), None)
    if shader is None or shader.parametrization != "MELANIN":
        return
    total = eumelanin + pheomelanin
    shader.inputs["Melanin"].default_value = 1.0 - math.exp(-total)
    shader.inputs["Melanin Redness"].default_value = pheomelanin / total if total > 0.0 else 0.0
