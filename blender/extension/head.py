"""A mesh of Blender as the head of a scene.

Blender and frisure both have z up and faces that look towards -y. frisure has metres; Blender has units of `scale_length` metres.
"""

import math

import bpy
import numpy as np

# The group of faces on which hair grows, in the file of the head.
SCALP = "scalp"

# What frisure takes for a head, with or without a body (m).
SMALLEST, LARGEST = 0.05, 3.0

# The name of texture coordinates and positions that Blender's node group "Deform Curves on Surface" looks for.
REST_POSITION = "rest_position"
UV_MAP = "frisure"


class HeadError(ValueError):
    """A mesh that is no head, with what to do about it."""


def metres_per_unit() -> float:
    """Metres in a unit of the scene; without a system of units Blender uses no scale, and a unit is a metre."""
    settings = bpy.context.scene.unit_settings
    return settings.scale_length if settings.system != "NONE" else 1.0


def world_points(head) -> np.ndarray:
    """The vertices of a mesh object in metres, (V, 3)."""
    mesh = head.data
    points = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", points)
    matrix = np.array(head.matrix_world)
    return (points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]) * metres_per_unit()


def check(head) -> None:
    """Raises `HeadError` unless the object is a mesh that can be a head."""
    if head is None or head.type != "MESH":
        raise HeadError("Hair grows on a mesh: select the mesh of a head first")
    if head.data.is_editmode:
        raise HeadError(f"{head.name} is in Edit Mode: leave it first")
    if len(head.data.polygons) == 0:
        raise HeadError(f"The mesh of {head.name} has no faces")
    points = world_points(head)
    if not np.isfinite(points).all():
        raise HeadError(f"The mesh of {head.name} has vertices that are no numbers")
    size = (points.max(axis=0) - points.min(axis=0)).max()
    if not SMALLEST <= size <= LARGEST:
        raise HeadError(
            f"{head.name} is {size:.3g} m across, and a head is between {SMALLEST} and {LARGEST} m: scale it, or set the unit "
            f"scale of the scene (one unit is {metres_per_unit():g} m)"
        )


def check_editable(*blocks) -> None:
    """Raises `HeadError` for data that are linked from another file: what is written into them is lost."""
    for block in blocks:
        if not block.is_editable:
            raise HeadError(f"{block.name} is linked from another file: make it local, or override it")


def ensure_uv_map(head, wanted: str = "") -> str:
    """The name of the UV map `wanted`, or of the active one; a mesh without any gets one of its own.

    In that each face has a cell of its own, in its own shape: Blender finds the root of a hair by its coordinates, which must not be those
    of two faces. A map without seams of a closed mesh has faces that lie on others.
    """
    mesh = head.data
    if wanted in mesh.uv_layers:
        return wanted
    if mesh.uv_layers.active is not None:
        return mesh.uv_layers.active.name
    check_editable(mesh)
    points = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", points)
    corners = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    counts = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("loop_total", counts)
    normals = np.empty(3 * len(mesh.polygons))
    mesh.polygons.foreach_get("normal", normals)
    layer = mesh.uv_layers.new(name=UV_MAP)
    uv = cells(points.reshape(-1, 3)[corners], counts, normals.reshape(-1, 3))
    layer.uv.foreach_set("vector", uv.astype(np.float32).ravel())
    return layer.name


# The part of a cell that its face fills. Chosen: rounding leaves no face in another one's cell.
FILLED = 0.9


def cells(points: np.ndarray, counts: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Coordinates of the corners (L, 3) of faces (F) in the unit square, each face flattened into a cell of its own."""
    face = np.repeat(np.arange(len(counts)), counts)
    starts = np.cumsum(counts) - counts
    # Two axes across each normal.
    away = np.eye(3)[np.abs(normals).argmin(axis=1)]
    first = np.cross(normals, away)
    first /= np.maximum(np.linalg.norm(first, axis=1), 1e-12)[:, None]
    axes = np.stack([first, np.cross(normals, first)], axis=1)
    flat = np.einsum("lij,lj->li", axes[face], points)
    low, high = np.minimum.reduceat(flat, starts), np.maximum.reduceat(flat, starts)
    size = np.maximum((high - low).max(axis=1), 1e-12)
    within = (flat - 0.5 * (low + high)[face]) / size[face, None]
    side = math.ceil(math.sqrt(len(counts)))
    cell = np.stack([face % side, face // side], axis=1)
    return (cell + 0.5 + FILLED * within) / side


def ensure_rest_position(head) -> None:
    """Keeps the positions of the vertices as they are now: those on which hair is solved, and from which it is moved with a head that is
    deformed."""
    mesh = head.data
    points = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", points)
    kept = mesh.attributes.get(REST_POSITION)
    if kept is not None and (kept.data_type != "FLOAT_VECTOR" or kept.domain != "POINT"):
        raise HeadError(f"{head.name} has an attribute `{REST_POSITION}` of another kind: rename or remove it")
    if kept is not None:
        before = np.empty_like(points)
        kept.data.foreach_get("vector", before)
        if np.array_equal(before, points):
            return
    check_editable(mesh)
    kept = kept or mesh.attributes.new(REST_POSITION, "FLOAT_VECTOR", "POINT")
    kept.data.foreach_set("vector", points)


def modified(head) -> bool:
    """Whether modifiers give the head other faces than its mesh has, such as those of Mirror and Subdivision Surface."""
    shown = head.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return shown.type == "MESH" and len(shown.data.polygons) != len(head.data.polygons)


def scalp_faces(head, group: str) -> set[int] | None:
    """The faces of which every vertex is in a vertex group by half or more; none without a group."""
    if not group:
        return None
    vertex_group = head.vertex_groups.get(group)
    if vertex_group is None:
        raise HeadError(f"{head.name} has no vertex group `{group}`; choose one of its groups, or none")
    inside = {
        vertex.index
        for vertex in head.data.vertices
        if any(g.group == vertex_group.index and g.weight >= 0.5 for g in vertex.groups)
    }
    faces = {face.index for face in head.data.polygons if all(v in inside for v in face.vertices)}
    if not faces:
        raise HeadError(f"No face of {head.name} has all its vertices in the group `{group}` with a weight of 0.5 or more")
    return faces


class Form:
    """What a solution depends on of a head: the arrays of its mesh in metres, z up."""

    def __init__(self, head, group: str = "", uv_map: str = ""):
        check(head)
        mesh = head.data
        layer = mesh.uv_layers[ensure_uv_map(head, uv_map)]
        self.points = world_points(head)
        self.uv = np.empty(2 * len(mesh.loops), dtype=np.float32)
        layer.uv.foreach_get("vector", self.uv)
        self.corners = np.empty(len(mesh.loops), dtype=np.int32)
        mesh.loops.foreach_get("vertex_index", self.corners)
        self.starts = np.empty(len(mesh.polygons), dtype=np.int32)
        mesh.polygons.foreach_get("loop_start", self.starts)
        # Whether each face is in the scalp, and whether faces are the other way round, as those of a mirrored object.
        self.scalp = np.zeros(len(mesh.polygons), dtype=bool)
        self.scalp[list(scalp_faces(head, group) or ())] = True
        self.mirrored = np.array([head.matrix_world.determinant() < 0.0])

    @property
    def arrays(self) -> list[np.ndarray]:
        return [self.points, self.uv, self.corners, self.starts, self.scalp, self.mirrored]

    def write(self, path: str) -> None:
        """Writes the head as Wavefront OBJ, with its texture coordinates and its scalp."""
        lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in self.points.tolist()]
        lines += [f"vt {u:.9g} {v:.9g}" for u, v in self.uv.reshape(-1, 2).tolist()]
        corners = [f"{vertex + 1}/{i + 1}" for i, vertex in enumerate(self.corners.tolist())]
        ends = [*self.starts[1:].tolist(), len(corners)]
        faces = [corners[start:end] for start, end in zip(self.starts.tolist(), ends)]
        if self.mirrored[0]:
            faces = [face[::-1] for face in faces]
        for name, wanted in ((SCALP, True), ("skin", False)):
            lines.append(f"g {name}")
            lines += ["f " + " ".join(faces[i]) for i in np.flatnonzero(self.scalp == wanted).tolist()]
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
