"""The operators: add hair to a mesh, settle curves that are there, and the steps of styling."""

import tomllib

import bpy
import frisure
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from . import curves, grooms, head as heads, properties, solver, thumbnails

# How often (s) a computation is looked at. Chosen.
TICK = 0.05

LEVELS = [
    (name, name.capitalize(), f"At the height of the {name}")
    for name in ("brows", "eyes", "ears", "chin", "nape")
]

PROGRAMS = [
    ("none", "None", "As the format has it, with everything that it holds"),
    ("unreal", "Unreal", "Alembic (.abc) in centimetres, y up, at most 255 points in each curve"),
    ("blender", "Blender", "USD or Alembic in metres"),
    ("unity", "Unity", "Alembic (.abc) in centimetres, y up, 32 points in each curve, without guides"),
    ("web", "Web", "A page (.html) or .glb of at most 20 000 hairs of 32 points"),
]

DIRECTIONS = [
    ("forward", "Forward", "Over the head to the face"),
    ("back", "Back", "Over the head to the neck"),
    ("down", "Down", "Down"),
    ("left", "Left", "To the head's left, and down"),
    ("right", "Right", "To the head's right, and down"),
]


class Solving:
    """An operator that solves hair: in the window beside it, where Escape ends the work; in a script at once."""

    bl_options = {"REGISTER", "UNDO"}

    # The object that gets the hair, and what to do if that fails.
    _job = None
    _hair_name = ""

    def prepare(self, context) -> solver.Solution:
        raise NotImplementedError

    def undo(self) -> None:
        """Takes back what `prepare` did."""

    def refused(self, error) -> set:
        self.undo()
        self.report({"ERROR"}, solver.told(error))
        return {"CANCELLED"}

    def execute(self, context):
        try:
            solution = self.prepare(context)
            solution.solve()
            solution.show(bpy.data.objects[solution.hair_name])
        except (ValueError, OSError, MemoryError, frisure.FrisureError) as error:
            return self.refused(error)
        self.told(solution)
        return {"FINISHED"}

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        return self.start(context)

    def start(self, context):
        """Solves beside the window: `modal` looks at the work."""
        try:
            self._job = solver.Job(self.prepare(context))
        except (ValueError, OSError, MemoryError, frisure.FrisureError) as error:
            return self.refused(error)
        manager = context.window_manager
        manager.progress_begin(0, 100)
        self._timer = manager.event_timer_add(TICK, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        job = self._job
        if event.type == "ESC":
            job.cancel()
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        if job.is_running:
            context.window_manager.progress_update(round(100 * job.done))
            context.workspace.status_text_set(f"frisure: {job.stage} {job.done:.0%} (Escape to cancel)")
            return {"RUNNING_MODAL"}
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        try:
            job.finish()
            job.solution.show(bpy.data.objects[job.solution.hair_name])
        except solver.Cancelled:
            self.undo()
            return {"CANCELLED"}
        except (ValueError, OSError, MemoryError, KeyError, RuntimeError, frisure.FrisureError) as error:
            return self.refused(error)
        self.told(job.solution)
        return {"FINISHED"}

    def told(self, solution) -> None:
        guides = solution.hairstyle.report["guides"]
        kind = "INFO" if guides["status"] == "at rest" else "WARNING"
        text = f"{guides['stable']} of {guides['count']} guides at rest: {guides['status']}"
        groom = solution.hairstyle.report.get("groom")
        if groom is not None:
            text += f"; settled curves stay within {1000 * groom['median_distance']:.2g} mm in the median"
            for name, what in (("left_out", "without length and left out"), ("off_skin", "rooted more than 1 cm off the head")):
                if groom.get(name):
                    kind, text = "WARNING", f"{text}; {groom[name]} of them {what}"
        if solution.without_modifiers:
            kind = "WARNING"
            text += "; it grows on the mesh without its modifiers, which add faces: apply them (Mirror, Subdivision Surface) and add hair anew"
        self.report({kind}, text)


class OBJECT_OT_frisure_add(Solving, bpy.types.Operator):
    """Grow hair on the selected mesh: a Curves object at rest under gravity, on the head and on itself"""

    bl_idname = "object.frisure_add"
    bl_label = "Add frisure Hair"

    hair_type: EnumProperty(name="Hair type", items=thumbnails.hair_types, default=thumbnails.DEFAULT)
    length: FloatProperty(
        name="Length", description="Mean length; 0 for that of the type", min=0.0, soft_max=2.0, subtype="DISTANCE",
    )
    guides: bpy.props.IntProperty(
        name="Guides", description="Hairs that are solved; 0 for as many as the type has", min=0, max=20_000,
    )
    hairs: bpy.props.IntProperty(name="Hairs", description="Hairs that are drawn", min=1, max=1_000_000, default=5000)
    seed: bpy.props.IntProperty(name="Seed", min=1, default=1)
    scalp: StringProperty(
        name="Scalp", description="The vertex group where hair grows; empty for the usual scalp of a head",
    )

    _made = None

    @classmethod
    def poll(cls, context):
        head = context.active_object
        if head is None or head.type != "MESH":
            cls.poll_message_set("Select the mesh of a head")
            return False
        return context.mode == "OBJECT"

    def prepare(self, context):
        head = context.active_object
        heads.check(head)
        heads.scalp_faces(head, self.scalp)
        heads.check_editable(head.data)
        hair = curves.new_object(head)
        self._made = hair.name
        kept = hair.frisure
        kept.head = head
        for name in ("scalp", "hair_type", "length", "guides", "hairs", "seed"):
            setattr(kept, name, getattr(self, name))
        return solver.Solution(hair, solver.scene_of(kept).text)

    def undo(self):
        hair = bpy.data.objects.get(self._made) if self._made else None
        if hair is not None:
            data = hair.data
            bpy.data.objects.remove(hair)
            bpy.data.hair_curves.remove(data)


class OBJECT_OT_frisure_settle(Solving, bpy.types.Operator):
    """Take the curves as hair at rest: find the natural curl with which they hang in this shape, so that they can be wetted, cut, \
grown and combed"""

    bl_idname = "object.frisure_settle"
    bl_label = "Settle Curves as Hair"

    hair_type: EnumProperty(name="Fibre", items=thumbnails.hair_types, default=thumbnails.DEFAULT)

    _before = None

    @classmethod
    def poll(cls, context):
        hair = context.active_object
        if hair is None or hair.type != "CURVES":
            cls.poll_message_set("Select curves on the mesh of a head")
            return False
        return context.mode == "OBJECT"

    def prepare(self, context):
        hair = context.active_object
        head = hair.data.surface or hair.parent
        if head is None:
            raise heads.HeadError(f"{hair.name} has no surface: set the mesh of the head in its data properties")
        heads.check(head)
        curves.read(hair)
        heads.check_editable(hair, hair.data)
        kept = hair.frisure
        surface = (hair.data.surface, hair.data.surface_uv_map)
        self._before = (hair.name, kept.head, kept.source, kept.scene, kept.hair_type, surface)
        kept.scene = ""
        kept.head, kept.source, kept.hair_type = head, hair.data.copy(), self.hair_type
        curves.attach(hair, head)
        return solver.Solution(hair, frisure.presets[self.hair_type].text)

    def undo(self):
        if self._before is None:
            return
        name, head, source, scene, hair_type, surface = self._before
        hair = bpy.data.objects.get(name)
        if hair is None:
            return
        hair.data.surface, hair.data.surface_uv_map = surface
        kept = hair.frisure
        copied = kept.source
        kept.scene = ""
        kept.head, kept.source, kept.hair_type = head, source, hair_type
        kept.scene = scene
        if copied is not None and copied != source:
            bpy.data.hair_curves.remove(copied)
        self._before = None


class Step(Solving):
    """A step of styling."""

    @classmethod
    def poll(cls, context):
        hair = context.active_object
        if hair is None or hair.type != "CURVES" or not hair.frisure.scene:
            cls.poll_message_set("Select hair of frisure: add it to a mesh, or settle curves first")
            return False
        return context.mode == "OBJECT"

    def step(self) -> tuple[str, object]:
        raise NotImplementedError

    def prepare(self, context):
        hair = context.active_object
        return solver.Solution(hair, hair.frisure.scene, self.step())


class OBJECT_OT_frisure_wet(Step, bpy.types.Operator):
    """Soak the hair: it is heavier and softer, its locks cling together"""

    bl_idname = "object.frisure_wet"
    bl_label = "Wet"

    def step(self):
        return "wet", {}


class OBJECT_OT_frisure_dry(Step, bpy.types.Operator):
    """Dry the hair"""

    bl_idname = "object.frisure_dry"
    bl_label = "Dry"

    def step(self):
        return "dry", {}


class OBJECT_OT_frisure_cut(Step, bpy.types.Operator):
    """Cut off what hangs below a level of the head"""

    bl_idname = "object.frisure_cut"
    bl_label = "Cut"

    below: EnumProperty(name="Below", items=LEVELS, default="chin")
    raised: FloatProperty(name="Raised by", description="Height of the line above the level", subtype="DISTANCE")
    above_only: BoolProperty(
        name="Only hair rooted above", description="Leave hair that is rooted below the level as it is", default=True,
    )

    def step(self):
        keys = {"below": self.below}
        if self.raised:
            keys["raise"] = f"{100 * solver.metres(self.raised):.6g} cm"
        if self.above_only:
            # Hair of no length left is an error.
            keys["where"] = {"above": self.below}
        return "cut", keys


class OBJECT_OT_frisure_grow(Step, bpy.types.Operator):
    """Let the hair grow"""

    bl_idname = "object.frisure_grow"
    bl_label = "Grow"

    months: FloatProperty(name="Months", min=0.1, max=120.0, default=3.0)

    def step(self):
        return "grow", {"months": self.months}


class OBJECT_OT_frisure_comb(Step, bpy.types.Operator):
    """Comb the hair, and let go"""

    bl_idname = "object.frisure_comb"
    bl_label = "Comb"

    to: EnumProperty(name="To", items=DIRECTIONS, default="back")

    def step(self):
        return "comb", {"to": self.to}


class OBJECT_OT_frisure_step(Step, bpy.types.Operator):
    """Any other step, as a scene has it, such as `tie = { to = "high" }` or `roll = "12 mm"`"""

    bl_idname = "object.frisure_step"
    bl_label = "Other Step"

    text: StringProperty(name="Step", description="A step as a scene has it, such as: roll = \"12 mm\"")

    def step(self):
        try:
            said = tomllib.loads(self.text)
        except tomllib.TOMLDecodeError as error:
            raise ValueError(f"`{self.text}` is no step: {error}") from None
        if len(said) != 1:
            raise ValueError(f"`{self.text}` has {len(said)} keys; a step has one, such as `wet = {{}}`")
        ((operation, keys),) = said.items()
        return operation, keys

    def invoke(self, context, event):
        if not self.text and not bpy.app.background:
            return context.window_manager.invoke_props_dialog(self, width=420)
        return super().invoke(context, event)


class OBJECT_OT_frisure_take_back(Step, bpy.types.Operator):
    """Take back the last step, or all of them"""

    bl_idname = "object.frisure_take_back"
    bl_label = "Take Back"

    all_steps: BoolProperty(name="All steps")

    def prepare(self, context):
        hair = context.active_object
        scene = frisure.Scene.from_text(hair.frisure.scene)
        steps = scene.to_dict().get("step", [])
        if not steps:
            raise ValueError(f"Nothing was done to {hair.name} yet")
        steps = [] if self.all_steps else steps[:-1]
        if hair.frisure.source is not None:
            scene = frisure.presets[hair.frisure.hair_type]
        else:
            scene = solver.scene_of(hair.frisure)
        for step in steps:
            ((operation, keys),) = step.items()
            scene = scene.with_step(operation, keys)
        return solver.Solution(hair, scene.text)


class OBJECT_OT_frisure_export(bpy.types.Operator):
    """Save the hair as a groom, for a program or by the extension of the file: Alembic, USD, HAIR, OBJ and others"""

    bl_idname = "object.frisure_export"
    bl_label = "Save Groom"

    filepath: StringProperty(subtype="FILE_PATH", default="hair.abc")
    program: EnumProperty(name="Program", description="The program that is to open the file", items=PROGRAMS, default="none")
    filter_glob: StringProperty(
        default="*.abc;*.usd;*.usda;*.usdc;*.usdz;*.hair;*.obj;*.ply;*.npz;*.data;*.glb;*.html", options={"HIDDEN"},
    )

    @classmethod
    def poll(cls, context):
        return Step.poll.__func__(cls, context)

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        hair = context.active_object
        try:
            if properties.is_pending(hair):
                properties.solve_now(hair)
            hairstyle = solver.last_hairstyle(hair)
            solution = solver.Solution(hair, hair.frisure.scene)
            if hairstyle is not None and solver.solved_on(hair, solution):
                if solver.is_edited(hair, hairstyle):
                    raise ValueError(
                        f"The curves of {hair.name} were edited since they were solved: settle a copy of them to keep the edits (its "
                        "frisure scene is then that of the copy), or make any step to have the solved hair again"
                    )
            else:
                solution.solve()
                solution.show(hair)
                hairstyle = solution.hairstyle
            grooms.save(hairstyle, bpy.path.abspath(self.filepath), "" if self.program == "none" else self.program)
        except (ValueError, OSError, frisure.FrisureError) as error:
            self.report({"ERROR"}, solver.told(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"wrote {self.filepath}")
        return {"FINISHED"}


CLASSES = (
    OBJECT_OT_frisure_add,
    OBJECT_OT_frisure_settle,
    OBJECT_OT_frisure_wet,
    OBJECT_OT_frisure_dry,
    OBJECT_OT_frisure_cut,
    OBJECT_OT_frisure_grow,
    OBJECT_OT_frisure_comb,
    OBJECT_OT_frisure_step,
    OBJECT_OT_frisure_take_back,
    OBJECT_OT_frisure_export,
)


def in_menu(self, _context):
    self.layout.operator(OBJECT_OT_frisure_add.bl_idname, text="frisure Hair", icon="CURVES_DATA")


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.VIEW3D_MT_curve_add.append(in_menu)


def unregister():
    bpy.types.VIEW3D_MT_curve_add.remove(in_menu)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
