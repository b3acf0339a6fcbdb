"""The extension module, which is written in Rust; `frisure` has what a user calls."""

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

_Progress = Callable[[str, float], object]

__all__ = [
    "Memory",
    "HeadAtRest",
    "Prediction",
    "RodsAtRest",
    "SceneText",
    "StrandData",
    "__version__",
    "after_fork",
    "check_rods",
    "check_room",
    "compute_part",
    "fit_fibres",
    "inverse_rods",
    "measure_photo",
    "missing_parts",
    "operation_names",
    "preset_names",
    "preset_text",
    "read_png",
    "render",
    "render_png",
    "run_batch",
    "run_command",
    "save_picture",
    "scene_keys",
    "settle_rods",
]

__version__: str

@final
class Memory:
    @property
    def __array_interface__(self) -> dict[str, Any]: ...

@final
class SceneText:
    @staticmethod
    def parse(text: str, name: str, folder: str | os.PathLike[str], edited: bool) -> SceneText: ...
    @staticmethod
    def read(path: str | os.PathLike[str]) -> SceneText: ...
    @staticmethod
    def from_mapping(mapping: Mapping[str, Any], folder: str | os.PathLike[str]) -> SceneText: ...
    @property
    def text(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def folder(self) -> Path: ...
    @property
    def edited(self) -> bool: ...
    @property
    def hair_type(self) -> str: ...
    @property
    def step_count(self) -> int: ...
    def with_values(self, changes: Sequence[tuple[str, Any]]) -> SceneText: ...
    def with_step(self, name: str, value: Any) -> SceneText: ...
    def number(self, key: str) -> float | None: ...
    def save(self, path: str | os.PathLike[str]) -> None: ...

@final
class Prediction:
    @staticmethod
    def of(scene: SceneText, progress: _Progress | None) -> Prediction: ...
    def follow(self, scene: SceneText, progress: _Progress | None) -> Prediction: ...
    def hairs(self, progress: _Progress | None) -> StrandData: ...
    def guides(self) -> StrandData: ...
    def guides_at_rest(self) -> tuple[int, int]: ...
    def report(self, progress: _Progress | None) -> str: ...
    def save(self, path: str | os.PathLike[str], fibres: bool, progress: _Progress | None) -> None: ...
    def save_report(self, path: str | os.PathLike[str], progress: _Progress | None) -> None: ...

@final
class HeadAtRest:
    @staticmethod
    def of(prediction: Prediction, progress: _Progress | None) -> HeadAtRest: ...
    def points(self) -> tuple[NDArray[np.float64], NDArray[np.int64]]: ...
    def certificate(self) -> tuple[float, float, float, bool]: ...
    def switches(self) -> tuple[NDArray[np.float64], NDArray[np.bool_]]: ...
    def vjp(
        self,
        by_points: NDArray[np.float64],
        by_frames: NDArray[np.float64] | None,
        progress: _Progress | None,
    ) -> tuple[
        NDArray[np.float64],
        list[NDArray[np.float64]],
        NDArray[np.float64],
        NDArray[np.float64],
        list[float],
        list[float],
    ]: ...
    def jvp(
        self,
        changes: Mapping[str, NDArray[np.float64]],
        contact: tuple[float, float],
        rotation: tuple[float, float, float],
        progress: _Progress | None,
    ) -> list[NDArray[np.float64]]: ...

@final
class StrandData:
    def points(self) -> Memory: ...
    def radii(self) -> Memory: ...
    def offsets(self) -> Memory: ...
    def attributes(self) -> list[tuple[str, bool]]: ...
    def attribute(self, name: str) -> Memory | None: ...

def render(
    prediction: Prediction,
    size: tuple[int | None, int | None],
    azimuth: float | None,
    tracing: tuple[int, float, int, float | None] | None,
    alpha: bool,
    progress: _Progress | None,
) -> Memory: ...
def render_png(prediction: Prediction, width: int, height: int) -> bytes: ...
def read_png(png: bytes) -> Memory: ...
def save_picture(
    prediction: Prediction, path: str | os.PathLike[str], progress: _Progress | None
) -> None: ...
@final
class RodsAtRest:
    def vjp(
        self,
        by_points: NDArray[np.float64] | None,
        by_frames: NDArray[np.float64] | None,
        by_energy: NDArray[np.float64] | None,
        progress: _Progress | None,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_]]: ...
    def jvp(
        self,
        changes: Mapping[str, NDArray[np.float64] | None],
        progress: _Progress | None,
    ) -> tuple[
        NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_]
    ]: ...

def after_fork() -> None: ...
def check_room(things: str, count: int, each: float) -> None: ...
def check_rods(
    count: int,
    fibres: Mapping[str, NDArray[np.float64]],
    clamped: Mapping[str, NDArray[np.float64] | None],
) -> None: ...
def settle_rods(
    count: int,
    fibres: Mapping[str, NDArray[np.float64]],
    clamped: Mapping[str, NDArray[np.float64] | None],
    options: Mapping[str, int | float | bool],
    progress: _Progress | None,
) -> tuple[
    NDArray[np.float64] | None,
    NDArray[np.float64],
    NDArray[np.bool_],
    NDArray[np.float64],
    NDArray[np.uint32],
    NDArray[np.float64] | None,
    NDArray[np.float64] | None,
    NDArray[np.float64] | None,
    RodsAtRest | None,
]: ...
def inverse_rods(
    points: NDArray[np.float64],
    fibres: Mapping[str, NDArray[np.float64]],
    accuracy: float,
    progress: _Progress | None,
) -> tuple[
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.bool_],
    NDArray[np.float64],
    NDArray[np.float64],
]: ...
def fit_fibres(
    lines: Mapping[str, NDArray[np.float64] | NDArray[np.int64] | None],
    known: Mapping[str, NDArray[np.float64] | None],
    noise: float | None,
    knots: int,
    progress: _Progress | None,
) -> dict[str, Any]: ...
def preset_names() -> list[tuple[str, str]]: ...
def preset_text(name: str) -> str | None: ...
def operation_names() -> list[str]: ...
def scene_keys() -> list[tuple[str, str]]: ...
def measure_photo(
    photo: str | os.PathLike[str] | NDArray[np.uint8],
    scale: str,
    crop: tuple[int, int, int, int] | None,
    hangs: bool,
    known: Mapping[str, object],
    progress: _Progress | None,
) -> tuple[str, Memory]: ...
def run_command(arguments: Sequence[str]) -> int: ...
def missing_parts(
    spec: str | os.PathLike[str], folder: str | os.PathLike[str]
) -> tuple[int, list[int]]: ...
def run_batch(
    spec: str | os.PathLike[str] | tuple[str | Mapping[str, Any], str | os.PathLike[str]],
    folder: str | os.PathLike[str],
    lasts: bool,
    columns: list[str] | None,
    threads: int | None,
    progress: _Progress | None,
) -> tuple[int, int, int, bool]: ...
def compute_part(
    spec: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    part: int,
    parts: int,
    threads: int,
) -> tuple[int, int, int]: ...
