"""What a hair object keeps: the head, the hair type and the text of its scene."""

import time

import bpy
import frisure
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import curves, head as heads, solver, thumbnails
from .draft import Draft

# How long (s) a property has to stay as it is until the exact hair is solved, and how often this, and a running solution, is looked
# at. Chosen.
STILL = 0.5
LOOK = 0.1
LOOK_AT_JOB = 0.02


def changed(properties, _context) -> None:
    """A property was changed: solved coarsely at once, and exactly when it stays."""
    hair = properties.id_data
    if hair.type != "CURVES" or not properties.scene or properties.source is not None:
        return
    _changed[hair.name] = time.monotonic()
    if not bpy.app.background and not bpy.app.timers.is_registered(look):
        bpy.app.timers.register(look, first_interval=0.01)


# When the properties of an object were changed last (s), and those that show coarse hair.
_changed: dict[str, float] = {}
_job: list = []

# How often something was undone or redone: one entry each time.
_undone: list[None] = []


@bpy.app.handlers.persistent
def undone(_scene, _graph=None) -> None:
    """After undo and redo: hair whose scene is no longer that of its properties is solved again. Blender takes a changed property back as
    a step of its own, without the hair that came after it."""
    _undone.append(None)
    for hair in bpy.data.objects:
        if hair.type == "CURVES":
            notice(hair)


def notice(hair) -> None:
    """Solves hair again, if its scene is not that of its properties."""
    _changed.pop(hair.name, None)
    properties = hair.frisure
    if not properties.scene or properties.source is not None or not hair.is_editable:
        return
    try:
        same = solver.text_of(hair) == properties.scene
    except (ValueError, frisure.FrisureError):
        return
    if not same:
        changed(properties, None)


def other_head(properties, context) -> None:
    """Another head was chosen: the hair is bound to it, and hangs on it."""
    hair, head = properties.id_data, properties.head
    if head is None or hair.type != "CURVES" or not properties.scene or hair.data.surface == head:
        return
    try:
        heads.check(head)
        curves.attach(hair, head)
    except ValueError as error:
        properties.problem = solver.told(error)
        return
    if hair.parent is None or hair.parent.type == "MESH":
        curves.hang(hair, head)
    changed(properties, context)


def look():
    """Solves what was changed; called by a timer of Blender. Returns when to look again (s), or None."""
    if _job:
        job, hair_name = _job[0]
        if job.is_running:
            return LOOK_AT_JOB
        _job.clear()
        hair = bpy.data.objects.get(hair_name)
        if hair is not None and job.undone != len(_undone):
            # Undo has taken back what was solved; the object is as it was then, and is looked at anew.
            notice(hair)
        elif hair is not None and job.error is None:
            try:
                job.solution.show(hair)
            except (ValueError, RuntimeError) as error:
                job.error = error
                hair.frisure.problem = solver.told(error)
            if job.error is not None or (not job.solution.coarse and _changed.get(hair_name) == job.since):
                _changed.pop(hair_name, None)
        elif job.error is not None:
            # The scene in the panel is wrong until it is changed again; the panel shows why.
            _changed.pop(hair_name, None)
            if hair is not None:
                hair.frisure.problem = solver.told(job.error)
    for name, since in list(_changed.items()):
        hair = bpy.data.objects.get(name)
        if hair is None:
            del _changed[name]
            continue
        still = time.monotonic() - since > STILL
        try:
            text = solver.text_of(hair)
            draft = None if still else Draft.of(hair, solver.last_hairstyle(hair), text)
            solution = draft or solver.Solution(hair, text, coarse=not still)
        except (ValueError, frisure.FrisureError) as error:
            hair.frisure.problem = solver.told(error)
            del _changed[name]
            continue
        hair.frisure.problem = ""
        job = solver.Job(solution)
        job.since, job.undone = since, len(_undone)
        _job.append((job, name))
        return LOOK_AT_JOB
    return LOOK if _changed else None


def is_pending(hair) -> bool:
    """Whether the exact hair of the properties is still to be solved."""
    return hair.name in _changed


def solve_now(hair) -> None:
    """Solves what the properties say, and waits for it: for scripts and tests."""
    _changed.pop(hair.name, None)
    solution = solver.Solution(hair, solver.text_of(hair))
    solution.solve()
    solution.show(hair)


def is_curves(_self, data) -> bool:
    return data.users > 0


class FrisureHair(bpy.types.PropertyGroup):
    """What is kept with a Curves object that frisure solves."""

    scene: StringProperty(name="Scene", description="The text of the frisure scene, without the files of head and groom")
    problem: StringProperty(name="Problem", description="Why the hair was not solved")
    head: PointerProperty(
        name="Head", description="The mesh on which the hair grows", type=bpy.types.Object,
        poll=lambda _self, other: other.type == "MESH", update=other_head,
    )
    source: PointerProperty(
        name="Groom", description="The curves from which the hair was settled", type=bpy.types.Curves, poll=is_curves,
    )
    scalp: StringProperty(name="Scalp", description="The vertex group where hair grows; empty for the usual scalp")
    hair_type: EnumProperty(
        name="Hair type", items=thumbnails.hair_types, default=thumbnails.DEFAULT, update=changed,
    )
    length: FloatProperty(
        name="Length", description="Mean length of the hair; 0 for that of the type", min=0.0, soft_max=2.0, precision=3,
        step=1, subtype="DISTANCE", update=changed,
    )
    curl_radius: FloatProperty(
        name="Curl radius", description="Radius of the natural curl; 0 for that of the type", min=0.0, soft_max=1.0,
        precision=4, step=0.1, subtype="DISTANCE", update=changed,
    )
    curl_pitch: FloatProperty(
        name="Curl pitch", description="Advance of the curl in a turn; 0 for that of the type", min=0.0, soft_max=1.0,
        precision=4, step=0.1, subtype="DISTANCE", update=changed,
    )
    guides: IntProperty(
        name="Guides", description="Hairs that are solved; 0 for as many as the type has", min=0, max=20_000,
        update=changed,
    )
    hairs: IntProperty(
        name="Hairs", description="Hairs that are drawn", min=1, max=1_000_000, default=5000, update=changed,
    )
    points: IntProperty(
        name="Points", description="Points of each hair; 0 for as many as the type has", min=0, max=1000, update=changed,
    )
    contact: BoolProperty(
        name="Contact", description="Hair lies on the head and on other hair; without it, it passes through both", default=True,
        update=changed,
    )
    seed: IntProperty(name="Seed", description="Another seed, another head of the same hair", min=1, default=1, update=changed)


def register():
    bpy.utils.register_class(FrisureHair)
    bpy.types.Object.frisure = PointerProperty(type=FrisureHair)
    for handlers in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        handlers.append(undone)


def unregister():
    if bpy.app.timers.is_registered(look):
        bpy.app.timers.unregister(look)
    for handlers in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        handlers.remove(undone)
    _changed.clear()
    _job.clear()
    del bpy.types.Object.frisure
    bpy.utils.unregister_class(FrisureHair)
