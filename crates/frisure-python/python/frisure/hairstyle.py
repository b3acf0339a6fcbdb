"""Hairstyles: predicted, styled, drawn, written."""

from __future__ import annotations

import functools
import json
import math
import os
import sys
from collections.abc import Callable, Mapping
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from frisure._check import flag, real, shown, whole
from frisure._check import path as _path
from frisure._frisure import Prediction, render, render_png, save_picture
from frisure.derivatives import HeadDerivatives
from frisure.errors import ArgumentError, ArgumentTypeError, FrisureError
from frisure.scene import Scene, SceneSource
from frisure.strands import Strands

Progress = Callable[[str, float], object]
"""Called with the name of a stage and the fraction of it that is done; an exception that it raises ends the work."""

_MOST_PIXELS = sys.maxsize
"""Most pixels along a side that can be counted; memory allows fewer, and says how many."""

_MOST_PATHS = 65_536
"""Most paths of light per pixel, as `frisure render` takes."""

_MOST_BOUNCES = 2**32 - 1
"""Most bounces of a path that can be counted."""

_NOTEBOOK_WIDTH = 450
"""Width in pixels of the picture in a notebook; chosen."""


def predict(scene: SceneSource, *, like: Hairstyle | None = None, progress: Progress | None = None) -> Hairstyle:
    """Predicts the hairstyle of a scene after its steps.

    `scene` is a `Scene`, a dict, a path, or a text in TOML with a line break. `progress(stage, done)` is called
    with the name of each stage and the fraction (0 to 1) that is done. Ctrl-C ends the work.

    What another hairstyle, `like`, and those before it have in common with the scene (the head, guides, steps) is not
    computed again; the result is the same.

    Raises `SceneError` with the line, the allowed range and a hint, if something in the scene is wrong.
    """
    checked = scene.copy() if isinstance(scene, Scene) else Scene(scene)
    if like is not None:
        if not isinstance(like, Hairstyle):
            raise ArgumentTypeError(f"like is of the type {type(like).__name__}; it must be a Hairstyle")
        return Hairstyle(checked, like._prediction.follow(checked._core, progress))
    return Hairstyle(checked, Prediction.of(checked._core, progress))


class Hairstyle:
    """A head of hair at rest; made by `predict`, and by the steps of another hairstyle. It never changes.

    A step solves no earlier step again. A pickled hairstyle is its scene: it is predicted again where it is used first,
    to the same bytes.
    """

    def __init__(self, scene: Scene, prediction: Prediction | None) -> None:
        self._scene = scene
        self._known = prediction

    @property
    def _prediction(self) -> Prediction:
        if self._known is None:
            self._known = Prediction.of(self._scene._core, None)
        return self._known

    @property
    def scene(self) -> Scene:
        """The scene of it, with all steps; a copy."""
        return self._scene.copy()

    @functools.cached_property
    def strands(self) -> Strands:
        """The drawn hairs, with the attributes `guide`, `closest_guides`, `guide_weights`, `id`, `group`, `root_uv`
        and, if any hair is wet, `wetness`. `docs/formats.md` describes them."""
        return self.draw()

    def draw(self, *, progress: Progress | None = None) -> Strands:
        """The same as `strands`, with progress."""
        if "strands" not in self.__dict__:
            self.__dict__["strands"] = Strands(self._prediction.hairs(progress))
        strands: Strands = self.__dict__["strands"]
        return strands

    @functools.cached_property
    def guides(self) -> Strands:
        """The guide hairs, which are solved as rods, with the attributes `id`, `guide`, `group`, `root_uv`, `axis_ratio`,
        `d1` (director, unit vector), `natural_strain` (rad/m), and `wetness` if any is wet."""
        return Strands(self._prediction.guides())

    @property
    def attributes(self) -> Mapping[str, NDArray[Any]]:
        """The attributes of the drawn hairs: `strands.attributes`."""
        return self.strands.attributes

    @functools.cached_property
    def _report(self) -> str:
        """The text of the report."""
        return self._prediction.report(None)

    @property
    def report(self) -> dict[str, Any]:
        """How the guides came to rest, with energies, volume, mass and the effect of each step, in SI units: what
        `frisure predict --report` writes. The hairs are drawn for it."""
        report: dict[str, Any] = json.loads(self._report)
        return report

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        fibres: bool = False,
        progress: Progress | None = None,
    ) -> None:
        """Writes a file, in the format that the extension names.

        A groom has hairs, guides and head, with `fibres` also the directors and natural strains of each hair; the
        formats are those of `docs/formats.md`. `.png` and `.exr` are a preview in the scene's size, `.json` is the
        report and `.toml` the scene. The bytes are those of the command line.
        """
        file, fibres = _path("path", path), flag("fibres", fibres)
        kind = file.suffix.lower()
        if kind == ".toml":
            self._scene.save(file)
        elif kind == ".json":
            self._prediction.save_report(file, progress)
        elif kind in {".png", ".exr"}:
            save_picture(self._prediction, file, progress)
        else:
            self._prediction.save(file, fibres, progress)

    def render(
        self,
        width: int | None = None,
        height: int | None = None,
        *,
        azimuth: float | None = None,
        quality: Literal["preview", "final"] = "preview",
        paths: int = 256,
        noise: float = 2.0,
        bounces: int = 100,
        clamp: float | None = None,
        alpha: bool = False,
        progress: Progress | None = None,
    ) -> NDArray[np.uint8]:
        """A picture: (height, width, 3) uint8, rows from the top, sRGB; with `alpha` (height, width, 4).

        The size (pixels), the camera, the lights and the look are the scene's where nothing else is given. `azimuth` is
        the direction of the camera around the head in degrees: 0 in front, 90 at the head's left. A preview takes
        seconds. `quality="final"` traces at most `paths` paths of light per pixel until the `noise` (percent of the way
        from black to white) is reached, each followed at most `bounces` times. `clamp` bounds the light that one path may
        bring which was scattered twice or more (white paper has about 1): it takes away single bright pixels and
        darkens the picture a little.
        """
        if not isinstance(quality, str) or quality not in ("preview", "final"):
            raise ArgumentError(f'quality is {shown(quality)}; it must be "preview" or "final"')
        size = [
            None if count is None else whole(name, count, 1, _MOST_PIXELS)
            for name, count in (("width", width), ("height", height))
        ]
        paths, bounces = whole("paths", paths, 1, _MOST_PATHS), whole("bounces", bounces, 1, _MOST_BOUNCES)
        noise = real("noise", noise, "a number between 0 and 100 percent", 0, 100)
        if clamp is not None:
            clamp = real("clamp", clamp, "a number above 0, or None", np.nextafter(0, 1))
        alpha = flag("alpha", alpha)
        tracing = (paths, 0.01 * noise, bounces, clamp) if quality == "final" else None
        turned = None if azimuth is None else math.radians(real("azimuth", azimuth, "a finite number of degrees"))
        made = render(self._prediction, (size[0], size[1]), turned, tracing, alpha, progress)
        return np.asarray(made)

    def step(
        self, operation: str, value: Any = None, /, *, progress: Progress | None = None, **keys: Any
    ) -> Hairstyle:
        """The hairstyle after one more step, as in a scene: `hair.step("cut", below="chin", where="fringe")`.

        Every step but `humidity` takes `where`, which selects hair (`docs/styling.md`). A key that is a word of Python gets an
        underscore at its end.
        """
        scene = self._scene.with_step(operation, value, **keys)
        return Hairstyle(scene, self._prediction.follow(scene._core, progress))

    def wet(self, to: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair wetted: `to` is how wet, 0 to 1 (the default)."""
        return self.step("wet", progress=progress, to=to, **keys)

    def dry(self, keep: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair dried; hair that is held meanwhile keeps the part `keep` (0 to 1) of that shape."""
        return self.step("dry", progress=progress, keep=keep, **keys)

    def humidity(self, relative: float, *, progress: Progress | None = None) -> Hairstyle:
        """The hair in air of a relative humidity, 0 to 1."""
        return self.step("humidity", relative, progress=progress)

    def cut(self, below: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair cut `below` a level of the head (`"chin"`) or a height, or along `plane`, `sphere`, `off_skin`,
        `length` or `gathered`. `point_cut` makes a soft edge, `share` thins: it cuts a fraction of the hairs."""
        return self.step("cut", progress=progress, below=below, **keys)

    def grow(self, by: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair grown `by` a length (`"2 cm"`), or `to` a length, or for `months` or a `time`."""
        return self.step("grow", progress=progress, by=by, **keys)

    def comb(self, to: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair combed `to` a side (`"left"`) or in a direction, with a `strength`; with `hold=True` it stays."""
        return self.step("comb", progress=progress, to=to, **keys)

    def part(self, at: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair parted `at` a place (`"middle"`) or along a `line`."""
        return self.step("part", progress=progress, at=at, **keys)

    def roll(self, radius: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """Each wisp on a roller of a `radius` (`"1 cm"`), with a `pitch`, and held."""
        return self.step("roll", progress=progress, radius=radius, **keys)

    def braid(self, width: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair braided in three, of a `width` and a `pitch`, and held."""
        return self.step("braid", progress=progress, width=width, **keys)

    def twist(self, width: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair in two-strand twists, of a `width` and a `pitch`, and held."""
        return self.step("twist", progress=progress, width=width, **keys)

    def straighten(self, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair straightened, and held."""
        return self.step("straighten", progress=progress, **keys)

    def clip(self, to: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair held by a clip: the place `at` along it (0 to 1) is brought `to` a point."""
        return self.step("clip", progress=progress, to=to, **keys)

    def tie(self, to: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair gathered with a hair tie and held: `to` is `"high"`, `"middle"` (the default), `"low"`, `"left"`,
        `"right"` or a point (m). `braided=True` braids the tail in three."""
        return self.step("tie", progress=progress, to=to, **keys)

    def product(self, kind: str = "gel", *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair with a styling product: `kind` is `"gel"`, `"mousse"` or `"oil"`, `amount` 0 to 1 (the usual amount)."""
        return self.step("product", progress=progress, kind=kind, **keys)

    def tuck(self, side: Any = None, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair behind the ears: `side` is `"both"` (the default), `"left"` or `"right"`; `hold=True` pins it there."""
        return self.step("tuck", progress=progress, side=side, **keys)

    def release(self, *, progress: Progress | None = None, **keys: Any) -> Hairstyle:
        """The hair without what holds it."""
        return self.step("release", progress=progress, **keys)

    def derivatives(self, *, progress: Progress | None = None) -> HeadDerivatives:
        """The head as it rests, with exact derivatives of all guides together by curl, stiffness, density, gravity and contact.

        The head is brought to rest to rounding first. Wisps that touch need `equilibrium.method = "continuation"`; hair with friction
        has no derivatives. A `SceneError` or an `ArgumentError` says what is missing.
        """
        return HeadDerivatives(self._prediction, progress)

    def __reduce__(self) -> tuple[Any, ...]:
        return Hairstyle, (self._scene, None)

    @functools.cached_property
    def _told(self) -> str:
        guides, stable = self._prediction.guides_at_rest()
        return f"{stable} of {guides} guides at rest"

    def __repr__(self) -> str:
        scene = repr(self._scene).removeprefix("<frisure.Scene ").removesuffix(">")
        try:
            told = self._told if self._known is not None else "not predicted yet"
        except FrisureError:
            # In a child of the process that predicted it, where threads are gone.
            told = "predicted in another process"
        return f"<frisure.Hairstyle {scene}; {told}>"

    def _repr_png_(self) -> bytes:
        """A picture for notebooks."""
        height = _NOTEBOOK_WIDTH * self._scene.number("output.height") / self._scene.number("output.width")
        return render_png(self._prediction, _NOTEBOOK_WIDTH, max(1, round(height)))
