"""The extension in Blender without a window: it is installed by Blender's own command, and every operator is called."""

import importlib
import os
import tempfile
import time
from pathlib import Path
from types import SimpleNamespace

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
    # Lengths are in the unit of the scene.
    hair = grown(head, hair_type="caucasian-curly", length=12)
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
    module("head").Form(head).write(str(tmp_path / "head.obj"))
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
    # Without a window Blender gives no icons (0): the pictures that they are made of are read, and each is another.
    pictures = module("thumbnails")._pictures
    assert set(pictures) == set(frisure.presets.descriptions)
    assert all(min(pictures[item[0]].image_size) >= 64 for item in items)
    assert len({bytes(memoryview(np.array(pictures[item[0]].image_pixels[:], dtype=np.int32))) for item in items}) == len(items)
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


def test_dragging_without_contact_shows_all_guides_where_they_come_to_rest(head):
    solver, properties = module("solver"), module("properties")
    hair = grown(head, hair_type="caucasian-curly", length=0.1, guides=90)
    hair.frisure.contact, hair.frisure.points = False, 32
    properties.solve_now(hair)
    for name, value in {"length": 0.11, "curl_radius": 0.009}.items():
        setattr(hair.frisure, name, value)
        drafts = []
        for _ in range(600):
            again = properties.look()
            if len(hair.data.curves) == 90:
                drafts.append(world(hair).copy())
            if again is None:
                break
            time.sleep(again)
        assert again is None and not hair.frisure.problem and len(hair.data.curves) == 150
        exact = solver.last_hairstyle(hair).guides.points
        assert drafts and np.median(np.linalg.norm(drafts[-1] - exact, axis=1)) < 2e-3
    # What a draft cannot follow is solved coarsely.
    hair.frisure.seed = 2
    text = solver.with_steps(solver.scene_of(hair.frisure), hair.frisure.scene).text
    assert module("draft").Draft.of(hair, solver.last_hairstyle(hair), text) is None


def test_curves_are_settled(head, tmp_path):
    hair = grown(head, hair_type="caucasian-wavy", length=0.1, hairs=50)
    shape = world(hair).copy()
    plain = bpy.data.objects.new("plain", hair.data.copy())
    bpy.context.scene.collection.objects.link(plain)
    plain.matrix_world = hair.matrix_world
    bpy.context.view_layer.objects.active = plain
    bpy.context.view_layer.update()
    assert bpy.ops.object.frisure_settle(hair_type="caucasian-wavy") == {"FINISHED"}
    # What the library makes of the same files; interpolated hairs are no equilibria, and move to the nearest.
    module("head").Form(head).write(str(tmp_path / "head.obj"))
    hair.frisure.scene = plain.frisure.scene
    curves = module("curves")
    curves.write_groom("hair", curves.read(hair), str(tmp_path / "groom.obj"))
    import frisure

    scene = frisure.Scene.from_text(plain.frisure.scene)
    scene.update({"head.mesh": str(tmp_path / "head.obj"), "head.unit": "m", "head.up": "z"})
    scene.update({"groom.file": str(tmp_path / "groom.obj"), "groom.unit": "m", "groom.up": "z"})
    assert np.abs(world(plain) - frisure.predict(scene).strands.points).max() < 2e-5
    assert np.median(np.linalg.norm(world(plain) - shape, axis=1)) < 5e-3
    assert bpy.ops.object.frisure_wet() == {"FINISHED"}
    # Wet hair is heavier: tips come down.
    assert world(plain)[:, 2].mean() < shape[:, 2].mean()


def test_a_groom_is_saved(head, tmp_path):
    grown(head)
    path = tmp_path / "hair.abc"
    assert bpy.ops.object.frisure_export(filepath=str(path)) == {"FINISHED"}
    assert path.read_bytes()[:5] == b"Ogawa"
    refused(bpy.ops.object.frisure_export, "extension", filepath=str(tmp_path / "hair.xyz"))


def test_a_groom_is_saved_for_a_program(head, tmp_path):
    hair = grown(head, hair_type="african-coily", length=0.06)
    hair.frisure.points = 400
    module("properties").solve_now(hair)
    assert {curve.points_length for curve in hair.data.curves} == {400}
    for program, kind in {"unreal": "abc", "unity": "abc", "blender": "usdc", "web": "html"}.items():
        path = tmp_path / f"{program}.{kind}"
        assert bpy.ops.object.frisure_export(filepath=str(path), program=program) == {"FINISHED"}
        assert path.stat().st_size > 10_000
    refused(bpy.ops.object.frisure_export, "unreal", filepath=str(tmp_path / "hair.glb"), program="unreal")
    assert not (tmp_path / "hair.glb").exists()
    # What the importers of Blender find.
    scale = {"unreal": 0.01, "unity": 0.01}
    most = {"unreal": 255, "unity": 32}
    points = {}
    for program in scale:
        before = set(bpy.data.objects)
        bpy.ops.wm.alembic_import(filepath=str(tmp_path / f"{program}.abc"), scale=scale[program])
        found = [o for o in set(bpy.data.objects) - before if o.type == "CURVES"]
        hairs = [o for o in found if not o.name.startswith("guides")]
        assert len(found) - len(hairs) == (program == "unreal")
        assert sum(len(o.data.curves) for o in hairs) == 150
        assert max(curve.points_length for o in found for curve in o.data.curves) == most[program]
        bpy.context.view_layer.update()
        points[program] = np.concatenate([world(o) for o in hairs])
    # Centimetres, y up, in the place of the hair.
    shown = world(hair)
    assert np.abs(points["unreal"].min(axis=0) - shown.min(axis=0)).max() < 1e-3
    assert np.abs(points["unreal"].max(axis=0) - shown.max(axis=0)).max() < 1e-3


def test_a_groom_for_unreal_has_the_attributes_of_its_specification(head, tmp_path):
    # The Alembic library is in the environment of validation/clients only.
    geometry, abc = pytest.importorskip("alembic3d.AbcGeom"), pytest.importorskip("alembic3d.Abc")
    grown(head)
    path = tmp_path / "hair.abc"
    assert bpy.ops.object.frisure_export(filepath=str(path), program="unreal") == {"FINISHED"}
    archive = abc.IArchive(str(path))
    groom = archive.getTop().getChild(0)
    found = {}
    for part in (groom.getChild(i) for i in range(groom.getNumChildren())):
        schema = geometry.ICurves(part, part.getChild(0).getName()).getSchema()
        given = schema.getArbGeomParams()
        found[part.getName()] = {given.getPropertyHeader(i).getName() for i in range(given.getNumProperties())}
        assert max(schema.getValue().getCurvesNumVertices()) <= 255
    assert "guides" in found and len(found) > 2
    for name, attributes in found.items():
        # From two of its own frisure reads wisps and parts back.
        assert {a for a in attributes if not a.startswith("groom_")} <= {"frisure_guide", "frisure_group"}, name
        assert {"groom_guide", "groom_group_id", "groom_group_name", "groom_id", "groom_root_uv"} <= attributes
        if name != "guides":
            assert {"groom_closest_guides", "groom_guide_weights", "groom_clumpid", "groom_group_cards_id"} <= attributes


def test_undo_and_redo_bring_the_hair_back(head):
    """The second argument makes Blender push an undo step as it does in a window."""
    bpy.ops.ed.undo_push(message="start")
    assert bpy.ops.object.frisure_add("EXEC_DEFAULT", True, **FEW) == {"FINISHED"}

    def hair():
        return next((o for o in bpy.data.objects if o.type == "CURVES"), None)

    bpy.context.view_layer.objects.active = hair()
    dry, scene = world(hair()).copy(), hair().frisure.scene
    bpy.ops.ed.undo_push(message="chosen")
    assert bpy.ops.object.frisure_wet("EXEC_DEFAULT", True) == {"FINISHED"}
    wet, after = world(hair()).copy(), hair().frisure.scene
    assert after != scene and np.abs(wet - dry).max() > 1e-4
    assert bpy.ops.ed.undo() == {"FINISHED"}
    assert hair().frisure.scene == scene and np.array_equal(world(hair()), dry)
    assert bpy.ops.ed.redo() == {"FINISHED"}
    assert hair().frisure.scene == after and np.array_equal(world(hair()), wet)
    # A step after undoing begins with the hair that is shown, not with that which was undone.
    assert bpy.ops.ed.undo() == {"FINISHED"}
    bpy.context.view_layer.objects.active = hair()
    assert bpy.ops.object.frisure_cut(below="chin") == {"FINISHED"}
    assert [list(step) for step in _steps(hair())] == [["cut"]]
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    assert hair() is None
    assert bpy.ops.ed.redo() == {"FINISHED"}
    assert np.array_equal(world(hair()), dry) and hair().data.surface is not None


class Window:
    """A stand-in for what an operator has of a window, which remembers what it is told."""

    def __init__(self):
        self.progress, self.texts, self.timers, self.handlers, self.reports = [], [], [], [], []
        self.window_manager = SimpleNamespace(
            progress_begin=lambda low, high: self.progress.append(low),
            progress_update=self.progress.append,
            progress_end=lambda: self.progress.append("end"),
            event_timer_add=self._timer,
            event_timer_remove=self.timers.remove,
            modal_handler_add=self.handlers.append,
        )
        self.workspace = SimpleNamespace(status_text_set=self.texts.append)
        self.window, self.mode = None, "OBJECT"

    @property
    def active_object(self):
        return bpy.context.view_layer.objects.active

    def _timer(self, interval, window):
        self.timers.append(interval)
        return interval

    def operator(self, name: str, **keys):
        """An operator of this class that is no operator of Blender, whose instances no script can make."""
        of = getattr(module("operators"), f"OBJECT_OT_frisure_{name}")
        body = {n: v for n, v in vars(of).items() if callable(v) or n.startswith("_made") or n.startswith("_before")}
        bases = tuple(base for base in of.__bases__ if base is not bpy.types.Operator)
        made = type(name, bases, body | keys)()
        made.report = lambda kind, text: self.reports.append((kind, text))
        return made

    def events(self, operator, *first) -> set:
        """What the operator returns at last, for these events and then a timer's."""
        assert operator.start(self) == {"RUNNING_MODAL"}
        assert self.handlers == [operator] and len(self.timers) == 1
        for kind in first:
            assert operator.modal(self, SimpleNamespace(type=kind)) == {"RUNNING_MODAL"}
        for _ in range(3000):
            done = operator.modal(self, SimpleNamespace(type="TIMER"))
            if done != {"RUNNING_MODAL"}:
                break
            time.sleep(0.01)
        assert not self.timers and self.texts[-1] is None and self.progress[-1] == "end"
        return done


ADDED = {"hair_type": "caucasian-wavy", "length": 0.2, "guides": 60, "hairs": 3000, "seed": 1, "scalp": ""}


def test_the_timer_shows_progress_and_then_the_hair(head):
    window = Window()
    assert window.events(window.operator("add", **ADDED), "MOUSEMOVE") == {"FINISHED"}
    hair = next(o for o in bpy.data.objects if o.type == "CURVES")
    assert len(hair.data.curves) == 3000 and hair.frisure.scene
    ((kind, text),) = window.reports
    assert kind == {"INFO"} and "60 guides at rest" in text
    # Within a stage of the work its part rises.
    parts = {}
    for text in filter(None, window.texts):
        stage, part = text.removeprefix("frisure: ").removesuffix(" (Escape to cancel)").rsplit(" ", 1)
        parts.setdefault(stage, []).append(int(part.removesuffix("%")))
    assert sum(len(stage) for stage in parts.values()) > 3
    assert all(0 <= part <= 100 for stage in parts.values() for part in stage)
    assert all(a <= b for stage in parts.values() for a, b in zip(stage, stage[1:]))
    assert max(part for part in window.progress if part != "end") > 0


def test_escape_leaves_everything_as_it_was(head):
    window = Window()
    before = {o.name for o in bpy.data.objects}, len(bpy.data.hair_curves)
    assert window.events(window.operator("add", **ADDED), "ESC") == {"CANCELLED"}
    assert ({o.name for o in bpy.data.objects}, len(bpy.data.hair_curves)) == before and not window.reports
    hair = grown(head, guides=60, hairs=3000)
    dry, scene = world(hair).copy(), hair.frisure.scene
    window = Window()
    assert window.events(window.operator("wet"), "ESC") == {"CANCELLED"}
    assert np.array_equal(world(hair), dry) and hair.frisure.scene == scene
    # The hair is as usable as before.
    window = Window()
    assert window.events(window.operator("wet")) == {"FINISHED"}
    assert not np.array_equal(world(hair), dry) and [list(step) for step in _steps(hair)] == [["wet"]]
    # Curves that are not settled stay curves.
    plain = bpy.data.objects.new("plain", hair.data.copy())
    bpy.context.scene.collection.objects.link(plain)
    plain.matrix_world, plain.data.surface = hair.matrix_world, head
    bpy.context.view_layer.objects.active = plain
    bpy.context.view_layer.update()
    shape, count = world(plain).copy(), len(bpy.data.hair_curves)
    window = Window()
    assert window.events(window.operator("settle", hair_type="caucasian-wavy"), "ESC") == {"CANCELLED"}
    assert np.array_equal(world(plain), shape) and not plain.frisure.scene and plain.frisure.source is None
    assert plain.data.surface == head and len(bpy.data.hair_curves) == count


def test_a_job_ends_when_it_is_cancelled(head):
    solver = module("solver")
    hair = grown(head)
    hair.frisure.guides, hair.frisure.hairs = 400, 50_000
    job = solver.Job(solver.Solution(hair, solver.scene_of(hair.frisure).text))
    time.sleep(0.1)
    assert job.is_running
    job.cancel()
    # It would have ended with a hairstyle.
    with pytest.raises(solver.Cancelled):
        job.finish()


def test_the_file_of_a_head_is_written_once(head):
    solver = module("solver")
    hair = grown(head)
    text = hair.frisure.scene
    first = solver.Solution(hair, text)
    assert solver.Solution(hair, text).head is first.head
    head.data.vertices[0].co.x += 1e-4
    head.data.update()
    assert solver.Solution(hair, text).head is not first.head


def test_hair_without_contact_passes_through_the_head(head, tmp_path):
    hair = grown(head, hair_type="caucasian-straight", length=0.2)
    on = world(hair).copy()
    hair.frisure.contact = False
    module("properties").solve_now(hair)
    assert 'body = "none"' in hair.frisure.scene and np.abs(world(hair) - on).max() > 0.01
    # The same as a prediction from the beginning.
    module("head").Form(head).write(str(tmp_path / "head.obj"))
    assert np.abs(world(hair) - library(hair, tmp_path / "head.obj").strands.points).max() < 2e-5


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


def test_undo_of_a_step_does_not_bring_back_hair_of_other_properties(head):
    bpy.ops.ed.undo_push(message="start")
    bpy.ops.object.frisure_add("EXEC_DEFAULT", True, length=0.1, **FEW)
    hair = next(o for o in bpy.data.objects if o.type == "CURVES")
    hair.frisure.length = 0.3
    bpy.ops.ed.undo_push(message="Length")
    module("properties").solve_now(hair)
    long = world(hair)
    bpy.context.view_layer.objects.active = hair
    bpy.ops.object.frisure_wet("EXEC_DEFAULT", True)
    bpy.ops.ed.undo()
    hair = next(o for o in bpy.data.objects if o.type == "CURVES")
    assert np.isclose(hair.frisure.length, 0.3) and module("properties").is_pending(hair)
    module("properties").solve_now(hair)
    assert np.abs(world(hair) - long).max() < 1e-6


def follows(hair, head) -> np.ndarray:
    """How far (m) each root moves with a head that a shape key moves by 0.05 units, through Blender's own node."""
    before = world(hair)[[curve.first_point_index for curve in hair.data.curves]]
    head.shape_key_add(name="Basis")
    lifted = head.shape_key_add(name="lifted")
    for point in lifted.data:
        point.co.z += 0.05
    lifted.value = 1.0
    tree = bpy.data.node_groups.new("deform", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    nodes = [tree.nodes.new(kind) for kind in ("NodeGroupInput", "GeometryNodeDeformCurvesOnSurface", "NodeGroupOutput")]
    for a, b in zip(nodes, nodes[1:]):
        tree.links.new(a.outputs[0], b.inputs[0])
    hair.modifiers.new("deform", "NODES").node_group = tree
    bpy.context.view_layer.update()
    shown = hair.evaluated_get(bpy.context.evaluated_depsgraph_get())
    after = world(SimpleNamespace(data=shown.data, matrix_world=hair.matrix_world))
    return np.linalg.norm(after[[curve.first_point_index for curve in shown.data.curves]] - before, axis=1)


def test_every_root_has_one_place_on_a_mesh_without_texture_coordinates(head):
    head.data.uv_layers.remove(head.data.uv_layers[0])
    hair = grown(head, length=0.05)
    assert hair.data.surface_uv_map == "frisure"
    size = head.matrix_world.to_scale().z
    assert np.allclose(follows(hair, head), 0.05 * size, atol=1e-3)


def test_another_active_map_leaves_the_hair_bound(head):
    hair = grown(head, length=0.05)
    head.data.uv_layers.active = head.data.uv_layers.new(name="second")
    bpy.ops.object.frisure_wet()
    assert hair.data.surface_uv_map != "second"
    assert np.allclose(follows(hair, head), 0.05 * head.matrix_world.to_scale().z, atol=1e-3)


def test_materials_of_the_artist_stay(head):
    hair = grown(head, length=0.05)
    copied = bpy.data.objects.new("plain", hair.data.copy())
    bpy.context.scene.collection.objects.link(copied)
    copied.matrix_world = hair.matrix_world
    own = bpy.data.materials.new("own")
    copied.data.materials.clear()
    copied.data.materials.append(own)
    bpy.context.view_layer.objects.active = copied
    bpy.context.view_layer.update()
    kinds = [node.bl_idname for node in own.node_tree.nodes] if own.node_tree else []
    assert bpy.ops.object.frisure_settle() == {"FINISHED"}
    assert copied.active_material == own
    assert kinds == ([node.bl_idname for node in own.node_tree.nodes] if own.node_tree else [])
    # A duplicate with another colour gets a material of its own.
    other = hair.copy()
    other.data = hair.data.copy()
    bpy.context.scene.collection.objects.link(other)
    first = hair.active_material
    other.frisure.hair_type = "asian-straight"
    module("properties").solve_now(other)
    assert hair.active_material == first and other.active_material != first


def test_the_head_can_be_moved_changed_and_edited(head, tmp_path):
    hair = grown(head, length=0.05)
    other = head.copy()
    other.data = head.data.copy()
    bpy.context.scene.collection.objects.link(other)
    other.location.x += 1.0
    bpy.context.view_layer.update()
    hair.frisure.head = other
    bpy.context.view_layer.objects.active = hair
    bpy.ops.object.frisure_wet()
    assert hair.data.surface == other and hair.parent == other
    assert 0.8 < world(hair)[:, 0].mean() < 1.2
    # A groom is that of the head where it is now; one that was edited is not written as if it was not.
    other.location.x += 1.0
    bpy.context.view_layer.update()
    bpy.ops.object.frisure_export(filepath=str(tmp_path / "hair.obj"))
    points = [line.split()[1:] for line in (tmp_path / "hair.obj").read_text().splitlines() if line.startswith("v ")]
    assert abs(np.array(points, float)[:, 0].mean() - world(hair)[:, 0].mean()) < 1e-3
    hair.data.attributes["position"].data[0].vector.z += 0.01
    refused(bpy.ops.object.frisure_export, "were edited", filepath=str(tmp_path / "edited.obj"))
    # What the mesh is when hair is solved is where Blender moves it from.
    other.data.vertices[0].co.x += 0.01
    bpy.ops.object.frisure_wet()
    rest = other.data.attributes["rest_position"].data[0].vector
    assert (rest - other.data.vertices[0].co).length < 1e-6
    bpy.context.view_layer.objects.active = other
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.view_layer.objects.active = hair
    refused(bpy.ops.object.frisure_dry, "Edit Mode")


def test_curves_that_do_not_go_through_their_points_are_refused(head):
    hair = grown(head, length=0.05)
    copied = bpy.data.objects.new("plain", hair.data.copy())
    bpy.context.scene.collection.objects.link(copied)
    copied.matrix_world = hair.matrix_world
    bpy.context.view_layer.objects.active = copied
    bpy.context.view_layer.update()
    copied.data.set_types(type="NURBS")
    refused(bpy.ops.object.frisure_settle, "NURBS")
    copied.data.set_types(type="POLY")
    copied.data.attributes.new("own", "INT", "CURVE").data.foreach_set("value", list(range(150)))
    assert bpy.ops.object.frisure_settle() == {"FINISHED"}
    assert [x.value for x in copied.data.attributes["own"].data] == list(range(150))


def test_two_objects_with_the_same_curves_have_steps_of_their_own(head):
    hair = grown(head, length=0.05)
    other = hair.copy()
    bpy.context.scene.collection.objects.link(other)
    before = world(hair)
    bpy.context.view_layer.objects.active = other
    bpy.ops.object.frisure_wet()
    assert other.data != hair.data and np.array_equal(world(hair), before)


def test_an_empty_mesh_is_no_head():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if not hasattr(bpy.types.Object, "frisure"):
        bpy.ops.preferences.addon_enable(module="bl_ext.user_default.frisure")
    empty = bpy.data.objects.new("empty", bpy.data.meshes.new("empty"))
    bpy.context.scene.collection.objects.link(empty)
    bpy.context.view_layer.objects.active = empty
    refused(bpy.ops.object.frisure_add, "no faces")
