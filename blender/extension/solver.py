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

from . import curves, head as heads

# Hair while a property is dragged: guides and hairs at most. Chosen: a tenth of a second to a second.
COARSE_GUIDES = 60
COARSE_HAIRS = 1500

# The keys of a scene for the properties of an object; 0 stands for what the hair type has.
KEYS = {
    "length": ("hair.length", lambda v: f"{100 * v:.6g} cm"),
    "curl_radius": ("hair.curl.radius", lambda v: f"{1000 * v:.6g} mm"),
    "curl_pitch": ("hair.curl.pitch", lambda v: f"{1000 * v:.6g} mm"),
    "guides": ("wisps.count", int),
    "hairs": ("wisps.hairs", int),
    "points": ("wisps.points", int),
    "seed": ("seed", int),
}

# The keys of a scene without contact.
NO_CONTACT = {"contact.body": "none", "contact.hair": "none"}

# The keys of `[hair.curl]` mean something only together.
TOGETHER = ("hair.curl.radius", "hair.curl.pitch")


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


def with_steps(scene: frisure.Scene, text: str) -> frisure.Scene:
    """The scene with the steps of another text."""
    for step in frisure.Scene.from_text(text).to_dict().get("step", []):
        ((operation, keys),) = step.items()
        scene = scene.with_step(operation, keys)
    return scene


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
        self.hair_name = hair.name
        self.session_uid = hair.session_uid
        self.text = text
        self.step = step
        self.coarse = coarse
        self.hairstyle = None
        _, self.like, _ = _solved.get(hair.session_uid, ("", None, []))
        if properties.head is None or properties.head.name not in bpy.data.objects:
            raise heads.HeadError(f"The head of {hair.name} is gone: choose one in the panel")
        form = heads.Form(properties.head, properties.scalp)
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
        self.data, self.name, self.matrix_world = data, data.name, hair.matrix_world


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


def told(error: BaseException) -> str:
    """An error for the status line: the problem, the place and the hint."""
    return "\n".join(line for line in str(error).splitlines() if line.strip()) or type(error).__name__
