"""The heads of `frisure batch` as arrays, for programs that learn. Needs `pyarrow`; `torch_dataset` needs `torch`, too.

>>> from frisure import data
>>> for head in data.heads("heads", columns=["guides", "hair.length"]):      # doctest: +SKIP
...     head["guides"].shape                  # (G, P, 3): guides, points, metres
>>> for view in data.views("heads", columns=["color", "depth"], shuffle=1):  # doctest: +SKIP
...     view["color"].shape, view["depth"].shape                             # (H, W, 3), (H, W)

A head is a dict of NumPy arrays, numbers and texts by the names of the columns, which `docs/batch.md` and
`docs/training-data.md` describe. Every array is a copy that may be written to. Heads that failed are left out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, Literal, Optional, Union

import numpy as np
from numpy.typing import NDArray

from frisure._check import names as _names
from frisure._check import path as _path
from frisure._check import shown, whole
from frisure._frisure import read_png
from frisure.errors import ArgumentError, ArgumentTypeError

__all__ = ["heads", "torch_dataset", "views"]

Row = dict[str, Any]
"""A head or a view: arrays, numbers and texts by the names of their columns."""

Folder = Union[str, "PathLike[str]"]

_PNG = ("color", "mask", "body")
_MAPS: dict[str, tuple[str, int]] = {
    "depth": ("<f4", 1),
    "direction": ("<f2", 2),
    "tangent": ("<f2", 3),
    "strand": ("<i4", 1),
    "guide": ("<i4", 1),
}
"""Maps with the type of their numbers and how many there are in a pixel."""
_MATRICES: dict[str, tuple[int, ...]] = {
    "intrinsics": (3, 3),
    "rotation": (3, 3),
    "translation": (3,),
    "to_world": (4, 4),
}
_NEEDED = ("index", "width", "height")
_DIGEST = b"frisure.batch"


def heads(
    folder: Folder,
    columns: Optional[Iterable[str]] = None,
    *,
    shuffle: Optional[int] = None,
    shard: tuple[int, int] = (0, 1),
) -> Iterator[Row]:
    """The heads of a folder that `frisure batch` has written, one after the other.

    `columns` are the names of those that are read (all, if they are not given; pictures are most of the bytes). `guides` are
    (G, P, 3) float32, metres. If the batch has views, `color`, `depth` and the other columns of views have the views of
    the head as their first axis: `color` (V, H, W, 3) uint8, `mask` and `body` (V, H, W) uint8, `depth` (V, H, W)
    float32, `direction` (V, H, W, 2) and `tangent` (V, H, W, 3) float32, `strand` and `guide` (V, H, W) int32, `intrinsics` and
    `rotation` (V, 3, 3), `translation` (V, 3), `to_world` (V, 4, 4) float64, and `camera` is a list of names.

    `shuffle` is the seed of another order: files, and heads within each. `shard=(i, n)` is the part i, from 0, of n parts
    that have all heads together: whole files where there are enough of them.

    Errors: `ArgumentError` for a folder without heads, of two batches, or with broken files, and for unknown columns.
    """
    source = _Source.read(folder, columns)
    return source.heads(*_order(shuffle, shard))


def views(
    folder: Folder,
    columns: Optional[Iterable[str]] = None,
    *,
    shuffle: Optional[int] = None,
    shard: tuple[int, int] = (0, 1),
) -> Iterator[Row]:
    """The views of all heads, one after the other: as `heads`, without the axis of the views.

    The columns of the head are repeated in each of its views; `view` is the index of the view.
    """
    source = _Source.read(folder, columns)
    if not source.has_views:
        raise ArgumentError(f"`{folder}` has no views: its batch has no table `[views]`")
    return source.views(*_order(shuffle, shard))


def torch_dataset(
    folder: Folder,
    columns: Optional[Iterable[str]] = None,
    *,
    per: Literal["head", "view"] = "head",
    shuffle: Optional[int] = None,
    shard: Optional[tuple[int, int]] = None,
    transform: Optional[Callable[[Row], Any]] = None,
) -> Any:
    """A `torch.utils.data.IterableDataset` of `heads` or `views`, for `torch.utils.data.DataLoader`.

    The workers of the loader, and the processes of `torch.distributed` if it is initialised, get different heads; each head
    comes once. `shard` replaces the rank and the number of processes. With `shuffle`, call `set_epoch` with another number
    before each epoch for another order. `transform` is called with each dict, in the worker.

    The numbers of heads of two processes may differ by those of one file. Heads with different numbers of guides
    do not go into one batch of tensors: choose `columns`, or a `collate_fn`.
    """
    try:
        import torch.utils.data  # type: ignore[import-not-found, unused-ignore]  # noqa: F401
    except ImportError as error:
        raise ImportError("`frisure.data.torch_dataset` needs PyTorch: pip install torch") from error
    from frisure._torch_data import TorchDataset

    source = _Source.read(folder, columns)
    if per not in ("head", "view"):
        raise ArgumentError(f"`per` is {per!r}; it must be 'head' or 'view'")
    if per == "view" and not source.has_views:
        raise ArgumentError(f"`{folder}` has no views: its batch has no table `[views]`")
    _order(shuffle, (0, 1) if shard is None else shard)
    if transform is not None and not callable(transform):
        raise ArgumentTypeError(f"`transform` is {shown(transform)}; it must be a function of a row, or None")
    return TorchDataset(source.heads if per == "head" else source.views, shuffle, shard, transform)


def _order(shuffle: Any, shard: Any) -> tuple[Optional[int], tuple[int, int]]:
    """A seed and a shard, checked before the first head is asked for."""
    if shuffle is not None:
        shuffle = whole("shuffle", shuffle, 0)
    try:
        which, count = (whole("shard", number, 0) for number in shard)
    except (TypeError, ValueError):
        which, count = 0, 0
    if not which < count:
        raise ArgumentError(f"`shard` is {shard}; it must be (i, n) with i from 0 to n - 1")
    return shuffle, (which, count)


def _parquet() -> Any:
    try:
        import pyarrow.parquet  # type: ignore[import-not-found, import-untyped, unused-ignore]
    except ImportError as error:
        raise ImportError("`frisure.data` needs pyarrow: pip install pyarrow") from error
    return pyarrow.parquet


@dataclass(frozen=True)
class _Part:
    path: Path
    heads: int

    @property
    def views(self) -> Path:
        return self.path.parent / "_views" / self.path.name.replace("part-", "views-")


@dataclass(frozen=True)
class _Source:
    """The files of a folder and the columns that are read; can be pickled for other processes."""

    parts: tuple[_Part, ...]
    head_columns: tuple[str, ...]
    view_columns: tuple[str, ...]
    has_views: bool

    @staticmethod
    def read(folder: Folder, columns: Optional[Iterable[str]]) -> _Source:
        wanted = _names("columns", columns)
        parts, known, digest = [], set[str](), None
        for path in sorted(_path("folder", folder).glob("part-*.parquet")):
            file = _open(path)
            found = (file.metadata.metadata or {}).get(_DIGEST)
            if found is None:
                raise ArgumentError(f"`{path}` is no part of a batch")
            if digest not in (None, found):
                raise ArgumentError(f"`{path}` is of another batch than the files before it")
            digest = found
            known = set(file.schema_arrow.names)
            parts.append(_Part(path, file.metadata.num_rows))
        if not parts:
            raise ArgumentError(f"`{folder}` has no heads: `frisure batch BATCH -o {folder}` writes them")
        has_views = parts[0].views.exists()
        seen = set(_open(parts[0].views).schema_arrow.names) if has_views else set()
        chosen = known | seen if wanted is None else set(wanted)
        unknown = sorted(chosen - known - seen)
        if unknown:
            names = ", ".join(sorted(known | seen))
            raise ArgumentError(f"`{folder}` has no column `{unknown[0]}`; there are {names}")
        # What shapes need, and what failed.
        head_columns = (chosen & known) | {"index", "status"}
        if "guides" in chosen:
            head_columns |= {"guide_count", "guide_points"}
        view_columns = chosen & (seen - {"index"})
        if view_columns:
            view_columns |= set(_NEEDED) | {"view"}
        return _Source(tuple(parts), tuple(sorted(head_columns)), tuple(sorted(view_columns)), has_views)

    def heads(self, shuffle: Optional[int], shard: tuple[int, int]) -> Iterator[Row]:
        for head, seen in self._rows(shuffle, shard):
            if seen:
                rows = [_view(row) for row in seen]
                for name in rows[0]:
                    values = [row[name] for row in rows]
                    head[name] = values if isinstance(values[0], str) else np.stack(values)
            yield head

    def views(self, shuffle: Optional[int], shard: tuple[int, int]) -> Iterator[Row]:
        for head, seen in self._rows(shuffle, shard, views=True):
            for row in seen:
                yield head | _view(row)

    def _rows(
        self, shuffle: Optional[int], shard: tuple[int, int], views: bool = False
    ) -> Iterator[tuple[Row, list[Row]]]:
        """The heads of a shard with the rows of their views."""
        which, count = shard
        wanted = self.view_columns or ((*_NEEDED, "view") if views else ())
        random = np.random.default_rng(shuffle)
        parts = list(range(len(self.parts)))
        if shuffle is not None:
            parts = [int(part) for part in random.permutation(len(parts))]
        whole = len(parts) >= count
        place = -1
        for turn, number in enumerate(parts):
            part = self.parts[number]
            rows = np.arange(part.heads)
            if shuffle is not None:
                # An order of its own, whoever reads the part.
                rows = np.random.default_rng([shuffle, number]).permutation(part.heads)
            if whole:
                mine = rows if turn % count == which else rows[:0]
            else:
                places = place + 1 + np.arange(part.heads)
                place += part.heads
                mine = rows[places % count == which]
            if len(mine):
                yield from self._part(part, [int(row) for row in mine], wanted)

    def _part(self, part: _Part, rows: list[int], wanted: Sequence[str]) -> Iterator[tuple[Row, list[Row]]]:
        table = _read(part.path, lambda file: file.read(columns=list(self.head_columns)))
        status = table["status"].to_pylist()
        # Each head that is there has one group of rows.
        group = np.cumsum([found == "ok" for found in status]) - 1
        seen = _open(part.views) if wanted else None
        for row in rows:
            if status[row] != "ok":
                continue
            head = _head(table.slice(row, 1))
            found: list[Row] = []
            if seen is not None:
                number = int(group[row])
                read = _read(part.views, lambda file: seen.read_row_group(number, columns=list(wanted)))
                found = [dict(zip(read.column_names, cells, strict=True)) for cells in zip(*read.columns, strict=True)]
                if any(view["index"].as_py() != head["index"] for view in found):
                    raise ArgumentError(f"`{part.views}` has other heads than `{part.path}`")
            yield head, found


def _open(path: Path) -> Any:
    return _read(path, lambda file: file)


def _read(path: Path, read: Callable[[Any], Any]) -> Any:
    """What is read from a file; a broken one is an `ArgumentError`."""
    parquet = _parquet()
    import pyarrow  # type: ignore[import-not-found, import-untyped, unused-ignore]

    try:
        return read(parquet.ParquetFile(path))
    except (pyarrow.ArrowException, OSError, EOFError) as error:
        raise ArgumentError(f"`{path}` cannot be read: {error}") from error


def _head(table: Any) -> Row:
    head: Row = {}
    for name in table.column_names:
        cell = table[name][0]
        if name == "guides":
            shape = (table["guide_count"][0].as_py(), table["guide_points"][0].as_py(), 3)
            head[name] = np.array(cell.values, np.float32).reshape(shape)
        else:
            value = cell.as_py()
            missing: Any = "" if str(cell.type) == "string" else float("nan")
            head[name] = missing if value is None else value
    return head


def _view(cells: Row) -> Row:
    width, height = cells["width"].as_py(), cells["height"].as_py()
    view: Row = {}
    for name, cell in cells.items():
        if name in _PNG:
            view[name] = np.array(read_png(cell.as_py()))
        elif name in _MAPS:
            kind, depth = _MAPS[name]
            shape = (height, width) if depth == 1 else (height, width, depth)
            view[name] = _wider(np.frombuffer(cell.as_buffer(), kind).reshape(shape))
        elif name in _MATRICES:
            view[name] = np.array(cell.values, np.float64).reshape(_MATRICES[name])
        elif name != "index":
            view[name] = cell.as_py()
    return view


def _wider(numbers: NDArray[Any]) -> NDArray[Any]:
    """A copy in this machine's byte order; half precision becomes single."""
    kind = np.float32 if numbers.dtype.itemsize == 2 else numbers.dtype.newbyteorder("=")
    return numbers.astype(kind)
