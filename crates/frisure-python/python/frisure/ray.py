"""Batches of heads on a Ray cluster. Needs `ray[data]`, which frisure does not install.

>>> import frisure.ray
>>> done = frisure.ray.batch("people.toml", "/shared/heads", cpus_per_task=8)     # doctest: +SKIP
>>> done.heads, done.new, done.failed                                             # doctest: +SKIP
(10000, 10000, 0)

Each part of the batch (`rows` heads) is a task of a Ray Data pipeline, which writes its files as `frisure batch` does: to the
same bytes, complete or absent. A task whose worker is killed runs again elsewhere, and a part that is there is kept.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike
from typing import Any, Optional, Union

from frisure._check import path, whole
from frisure._frisure import compute_part, missing_parts
from frisure.errors import ArgumentError

__all__ = ["Done", "batch"]


@dataclass(frozen=True)
class Done:
    """Counts of a finished run."""

    heads: int
    """Heads of the parts that this run has looked after; those of whole parts that were there before it are not counted."""
    new: int
    """Heads that this run has computed."""
    failed: int
    """Those of them that failed."""


def batch(
    spec: Union[str, PathLike[str]],
    folder: Union[str, PathLike[str]],
    *,
    cpus_per_task: int = 1,
    progress: Optional[Callable[[str, float], object]] = None,
) -> Done:
    """Computes the missing parts of a batch on the Ray cluster that this program is connected to, or on one of its own machine.

    `spec` is the batch (TOML) and `folder` the folder of its heads: paths that name the same files on every machine, such as
    those of a network disk. Each task uses `cpus_per_task` threads and asks Ray for as many processors; a task that loses its
    worker or its machine is tried again, as Ray Data does. `progress("parts", done)` is called after each part with the
    fraction that is done; Ray shows its own progress, too.

    Errors: those of `frisure batch`, before any task begins; `ray.exceptions.RayTaskError` from within a task, with the
    original error as its cause; `ImportError` without Ray.
    """
    try:
        import ray.data  # type: ignore[import-not-found, unused-ignore]
    except ImportError as error:
        raise ImportError('`frisure.ray` needs Ray Data: pip install "ray[data]"') from error
    cpus_per_task = whole("cpus_per_task", cpus_per_task, 1)
    spec, folder = path("spec", spec).absolute(), path("folder", folder).absolute()
    parts, missing = missing_parts(spec, folder)
    if not missing:
        return Done(0, 0, 0)
    compute = _Task(str(spec), str(folder), parts, cpus_per_task)
    # One block for each part: a task computes one, and a killed worker costs no more than that.
    tasks = ray.data.from_items([{"part": part} for part in missing], override_num_blocks=len(missing))
    rows = tasks.map(compute, num_cpus=cpus_per_task).iter_rows()
    heads = before = failed = 0
    for count, row in enumerate(rows, 1):
        heads, before, failed = heads + row["heads"], before + row["before"], failed + row["failed"]
        if progress is not None:
            progress("parts", count / len(missing))
    left = missing_parts(spec, folder)[1]
    if left:
        raise ArgumentError(f"part {left[0]} is not in `{folder}`: the machines of the cluster have other folders of this name")
    return Done(heads, heads - before, failed)


@dataclass(frozen=True)
class _Task:
    """Computes one part in a worker."""

    spec: str
    folder: str
    parts: int
    threads: int

    @property
    def __name__(self) -> str:
        """The name of the task in Ray's messages."""
        return "heads"

    def __call__(self, row: dict[str, Any]) -> dict[str, Any]:
        part = int(row["part"])
        heads, before, failed = compute_part(self.spec, self.folder, part, self.parts, self.threads)
        return {"part": part, "heads": heads, "before": before, "failed": failed}
