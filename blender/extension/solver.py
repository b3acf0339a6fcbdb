"""The scene of a hair object, and its solution.

A hair object keeps the text of its scene, without the files of head and groom. The last hairstyle of each object stays in memory with
these files: a solution computes again only what differs, and a mesh that has not changed is neither written nor read again.
"""

import hashlib
import os
import tempfile
import threading
import weakref

import bpy
import frisure
import numpy as np

from . import curves, head as heads

# Hair while a property is dragged: guides and hairs at most. Chosen: a tenth of a second to a second.
COARSE_GUIDES = 60
COARSE_HAIRS = 1500

# The keys of a scene for the properties of an object; 0 stands for what the hair type has.
KEYS = {
    "length": ("hair.length", lambda v: f"{100 * metres(v):.6g} cm"),
    "curl_radius": ("hair.curl.radius", lambda v: f"{1000 * metres(v):.6g} mm"),
    "curl_pitch": ("hair.curl.pitch", lambda v: f"{1000 * metres(v):.6g} mm"),
    "guides": ("wisps.count", int),
    "hairs": ("wisps.hairs", int),
    "points": ("wisps.points", int),
    "seed": ("seed", int),
}

# The keys of a scene without contact.
NO_CONTACT = {"contact.body": "none", "contact.hair": "none"}

# The keys of `[hair.curl]` mean something only together.
TOGETHER = ("hair.curl.radius", "hair.curl.pitch")


def metres(value: float) -> float:
    """A length in metres of a property, which Blender shows in the unit of the scene."""
    return value * heads.metres_per_unit()


class Cancelled(Exception):
    """Someone pressed Escape."""


def scene_of(properties) -> frisure.Scene:
    """The scene that the properties describe, without steps."""
    scene = frisure.presets[properties.hair_type]
    changes = {}
    for name, (key, said) in KEYS.items():
        value = getattr(properties, name)
        if value:
            changes[key] = said(value)
    if not properties.contact:
        changes |= NO_CONTACT
    curl = [key for key in TOGETHER if key in changes]
    if len(curl) == 1:
        # The other one is that of the type.
        other = next(key for key in TOGETHER if key not in changes)
        changes[other] = scene.number(other)
    scene.update(changes)
    return scene


def text_of(hair) -> str:
    """The text of the scene that the properties of an object describe, with its steps."""
    return with_steps(scene_of(hair.frisure), hair.frisure.scene).text


def with_steps(scene: frisure.Scene, text: str) -> frisure.Scene:
    """The scene with the steps of another text."""
    for step in frisure.Scene.from_text(text).to_dict().get("step", []):
        ((operation, keys),) = step.items()
        scene = scene.with_step(operation, keys)
    return scene


def solved_on(hair, solution) -> bool:
    """Whether the hairstyle in memory was solved on the head, and from the groom, of a solution."""
    _, _, files = _solved.get(hair.session_uid, ("", None, []))
    return files == [f for f in (solution.head, solution.groom) if f]


def last_hairstyle(hair):
    """The hairstyle in memory, if it is that of the object."""
    text, hairstyle, _ = _solved.get(hair.session_uid, ("", None, []))
    return hairstyle if hairstyle is not None and text == hair.frisure.scene else None


class InputFile:
    """A file for the solver, which is deleted with the last solution that uses it."""

    def __init__(self, name: str, write):
        self.folder = tempfile.TemporaryDirectory(prefix="frisure-", dir=bpy.app.tempdir or None, ignore_cleanup_errors=True)
        self.path = os.path.join(self.folder.name, name)
        write(self.path)


# Files in use by their name and their content.
_files: weakref.WeakValueDictionary[tuple[str, bytes], InputFile] = weakref.WeakValueDictionary()


def input_file(name: str, arrays, write) -> InputFile:
    """The file of some arrays: the same one as long as they are the same."""
    content = hashlib.blake2b(digest_size=16)
    for array in arrays:
        content.update(f"{array.dtype.str}{array.shape}".encode())
        content.update(array.tobytes())
    key = (name, content.digest())
    file = _files.get(key)
    # Blender empties its folder when another file is opened.
    if file is None or not os.path.isfile(file.path):
        file = _files[key] = InputFile(name, write)
    return file


# The text of the scene, the hairstyle and its files, by the session's number of the object.
_solved: dict[int, tuple[str, frisure.Hairstyle, list[InputFile]]] = {}


class Solution:
    """What is computed of a hair object; everything that reads Blender's data is read at once, so that it may run in a thread."""

    def __init__(self, hair, text: str, step=None, coarse=False):
        properties = hair.frisure
        heads.check_editable(hair, hair.data)
        if hair.data.users > 1:
            # Another object shows the same curves, with steps of its own.
            hair.data = hair.data.copy()
        self.hair_name = hair.name
        self.session_uid = hair.session_uid
        self.text = text
        self.step = step
        self.coarse = coarse
        self.hairstyle = None
        _, self.like, _ = _solved.get(hair.session_uid, ("", None, []))
        if properties.head is None or properties.head.name not in bpy.data.objects:
            raise heads.HeadError(f"The head of {hair.name} is gone: choose one in the panel")
        form = heads.Form(properties.head, properties.scalp, curves.uv_map_on(hair, properties.head))
        self.without_modifiers = not coarse and heads.modified(properties.head)
        self.head = input_file("head.obj", form.arrays, form.write)
        self.scalp = bool(properties.scalp)
        self.groom = None
        if properties.source is not None:
            groom = curves.read(_Placed(properties.source, hair))
            self.groom = input_file("groom.obj", groom, lambda path: curves.write_groom(properties.source.name, groom, path))

    def placed(self, scene: frisure.Scene) -> frisure.Scene:
        """The scene with its files."""
        files = {"head.mesh": self.head.path, "head.unit": "m", "head.up": "z"}
        if self.scalp:
            files["head.scalp_group"] = heads.SCALP
        if self.groom is not None:
            files |= {"groom.file": self.groom.path, "groom.unit": "m", "groom.up": "z"}
        if self.coarse:
            files["wisps.count"] = min(int(scene.number("wisps.count")), COARSE_GUIDES)
            files["wisps.hairs"] = COARSE_HAIRS
            files["wisps.density"] = None
        scene = scene.copy()
        scene.update(files)
        return scene

    def solve(self, progress=None) -> None:
        """Computes the hairstyle and its hairs; in any thread."""
        scene = frisure.Scene.from_text(self.text, file=self.hair_name)
        if self.step is not None:
            scene = scene.with_step(*self.step)
            self.text = scene.text
        self.hairstyle = frisure.predict(self.placed(scene), like=self.like, progress=progress)
        self.hairstyle.draw(progress=progress)

    def show(self, hair) -> None:
        """Puts the hairs into the object."""
        curves.attach(hair, hair.frisure.head)
        curves.write(hair, self.hairstyle.strands)
        scene = self.hairstyle.scene
        curves.set_material(hair, scene.number("look.eumelanin"), scene.number("look.pheomelanin"))
        if not self.coarse:
            hair.frisure.scene = self.text
            _solved.pop(self.session_uid, None)
            _solved[self.session_uid] = (self.text, self.hairstyle, [f for f in (self.head, self.groom) if f])
            while len(_solved) > MOST_IN_MEMORY:
                del _solved[next(iter(_solved))]


# Objects whose hairstyles stay in memory. Chosen.
MOST_IN_MEMORY = 4


class _Placed:
    """Curves that are no object, at the place of one."""

    def __init__(self, data, hair):
        self.data, self.name, self.matrix_world = data, data.name, curves.matrix_of(hair)


class Job:
    """A solution that is computed in a thread."""

    def __init__(self, solution: Solution):
        self.solution = solution
        self.stage, self.done = "", 0.0
        self.error: BaseException | None = None
        self._cancelled = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            self.solution.solve(self._progress)
        except BaseException as error:  # noqa: BLE001 - it is raised where the job is finished
            self.error = error

    def _progress(self, stage: str, done: float) -> None:
        if self._cancelled.is_set():
            raise Cancelled
        self.stage, self.done = stage, done

    def cancel(self) -> None:
        self._cancelled.set()

    @property
    def is_running(self) -> bool:
        return self._thread.is_alive()

    def finish(self) -> None:
        """Waits, and raises what was raised."""
        self._thread.join()
        if self.error is not None:
            raise self.error


# What errors of the library say to who writes scenes, and what that is in Blender.
IN_BLENDER = (
    ("does not stand upright", "The head does not stand upright with its face towards -y: rotate the object until it does"),
    ("of the groom's strands are rooted", "Most curves are rooted off the head: move or scale them onto its surface first"),
)


def told(error: BaseException) -> str:
    """An error for the status line: the problem, the place and the hint."""
    text = str(error)
    for said, here in IN_BLENDER:
        if said in text:
            return here
    lines = [line.removeprefix("error: ") for line in text.splitlines() if line.strip()]
    return "\n".join(lines) or type(error).__name__


def is_edited(hair, hairstyle) -> bool:
    """Whether the points of an object are others than those that were solved."""
    points, _ = curves.read(hair)
    solved = hairstyle.strands.points
    return points.shape != solved.shape or float(np.abs(points - solved).max()) > EDITED


# Difference of a point (m) from where it was solved that counts as an edit: well above the rounding of 32-bit numbers. Chosen.
EDITED = 1e-4
