"""Batches of heads in this process, as tables of Arrow."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from frisure import _frisure
from frisure._check import names, path, text, whole
from frisure.errors import ArgumentError, ArgumentTypeError, FailedError
from frisure.hairstyle import Progress

if TYPE_CHECKING:
    import pyarrow  # type: ignore[import-not-found, import-untyped, unused-ignore]

BatchSource = Union[Mapping[str, Any], "os.PathLike[str]", str]
"""What a batch is made from: a dict, a path, or text in TOML (a str with a line break)."""


def batch(
    spec: BatchSource,
    folder: str | os.PathLike[str] | None = None,
    *,
    columns: Iterable[str] | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> pyarrow.Table:
    """Computes the heads of a batch, and returns a table with a row for each, the columns of the files of `frisure batch`.

    - `spec`: the batch as `docs/batch.md` describes it: a path, a dict, or a text in TOML (with a line break). Paths in a dict or a text
      are relative to the working directory.
    - `folder`: where the files of the batch are kept, as by `frisure batch SPEC -o FOLDER`; heads that are there are not computed again.
      Without it a temporary folder is used and removed. A batch with views needs one: `frisure.data` reads them from there.
    - `columns`: the names of those that are read; by default all.
    - `threads`: how many are used; by default one for each processor.
    - `progress("heads", done)` is called with the fraction that is done. Ctrl-C ends the work; files that are complete stay in the folder.

    A head that failed is a row whose `status` is not `"ok"`, with the message in `error`. Needs `pyarrow`.

    >>> table = batch({"samples": 2, "volume": False, "set": {"wisps.count": 3},
    ...                "vary": {"hair.length": {"from": "3 cm", "to": "6 cm"}}})           # doctest: +SKIP
    >>> table.num_rows, table["hair.length"].to_pylist()                                # doctest: +SKIP
    (2, [0.0387, 0.0514])
    """
    try:
        import pyarrow  # noqa: F401
        import pyarrow.parquet  # type: ignore[import-not-found, import-untyped, unused-ignore]  # noqa: F401
    except ImportError as error:
        raise ImportError('`frisure.batch` needs pyarrow: pip install "frisure[data]"') from error
    if not hasattr(_frisure, "run_batch"):
        raise FailedError("this build of frisure has no batches: it was made without the feature `batch`")
    if threads is not None:
        threads = whole("threads", threads, 1, 4096)
    wanted = names("columns", columns)
    if wanted == []:
        raise ArgumentError("columns is empty; name one at least, or leave it out for all")
    source = _source(spec)
    if folder is not None:
        return _computed(source, path("folder", folder).absolute(), True, wanted, threads, progress)
    with tempfile.TemporaryDirectory(prefix="frisure-batch-") as temporary:
        return _computed(source, Path(temporary), False, wanted, threads, progress)


def _source(spec: Any) -> Any:
    """A path, or a description with the folder that its paths are relative to."""
    if isinstance(spec, Mapping):
        return spec, Path.cwd()
    if isinstance(spec, str) and "\n" in spec:
        return text("spec", spec), Path.cwd()
    if isinstance(spec, (str, os.PathLike)):
        return Path(spec)
    raise ArgumentTypeError(f"spec is of the type {type(spec).__name__}; it must be a dict, a path or a text")


def _computed(
    source: Any,
    folder: Path,
    lasts: bool,
    columns: list[str] | None,
    threads: int | None,
    progress: Progress | None,
) -> pyarrow.Table:
    import pyarrow
    import pyarrow.parquet

    _frisure.run_batch(source, folder, lasts, columns, threads, progress)
    tables = []
    for part in sorted(folder.glob("part-*.parquet")):
        # Read whole: the folder may be removed.
        file = pyarrow.parquet.ParquetFile(part, memory_map=False)
        tables.append(file.read(columns=columns))
        file.close()
    return pyarrow.concat_tables(tables)
