"""Batches in this process, as tables of Arrow."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import frisure
import frisure.data
import pytest

if not os.environ.get("FRISURE_NEEDS_AUTODIFF"):
    # tests/run sets the variable where it has installed it.
    pytest.importorskip("pyarrow")

BATCH: dict[str, Any] = {
    "samples": 5,
    "rows": 2,
    "volume": False,
    "set": {"wisps": {"count": 6, "hairs": 200, "points": 32}},
    "vary": {"hair.length": {"from": "8 cm", "to": "12 cm"}, "hair.type": ["straight", "wavy"]},
}
TEXT = """\
samples = 5
rows = 2
volume = false
[set]
wisps = { count = 6, hairs = 200, points = 32 }
[vary]
hair.length = { from = "8 cm", to = "12 cm" }
hair.type = ["straight", "wavy"]
"""


def test_the_table_has_the_rows_and_columns_of_the_files(tmp_path: Path) -> None:
    import pyarrow
    import pyarrow.dataset

    spec = tmp_path / "batch.toml"
    spec.write_text(TEXT)
    command = [sys.executable, "-m", "frisure", "batch", str(spec), "-o", str(tmp_path / "heads"), "--quiet"]
    subprocess.run(command, check=True)
    files = pyarrow.dataset.dataset(tmp_path / "heads", format="parquet").to_table()
    heard: list[float] = []
    table = frisure.batch(spec, progress=lambda stage, done: heard.append(done))
    assert isinstance(table, pyarrow.Table) and table.num_rows == 5
    assert table.schema.names == files.schema.names and table.equals(files)
    assert heard and heard[-1] == 1
    for same in (TEXT, BATCH):
        names = ["index", "hair.length", "hair.type", "guides", "status"]
        assert frisure.batch(same, columns=names, threads=1).equals(table.select(names))
    assert [path.name for path in tmp_path.iterdir()].count("heads") == 1


def test_a_folder_keeps_the_heads(tmp_path: Path) -> None:
    first = frisure.batch(BATCH, tmp_path / "kept")
    parts = sorted((tmp_path / "kept").glob("part-*.parquet"))
    assert len(parts) == 3
    before = [path.stat().st_mtime_ns for path in parts]
    assert frisure.batch(BATCH, tmp_path / "kept").equals(first)
    assert before == [path.stat().st_mtime_ns for path in parts]
    with pytest.raises(frisure.ArgumentError, match="belongs to another batch"):
        frisure.batch({**BATCH, "seed": 9}, tmp_path / "kept")


def test_views_need_a_folder_and_are_read_from_there(tmp_path: Path) -> None:
    seen = {**BATCH, "samples": 2, "views": {"cameras": ["front"], "size": [40, 30], "hairs": 50}}
    with pytest.raises(frisure.ArgumentError, match="views.*no folder"):
        frisure.batch(seen)
    assert frisure.batch(seen, tmp_path).num_rows == 2
    assert [view["color"].shape for view in frisure.data.views(tmp_path)] == [(30, 40, 3)] * 2


def test_columns_may_be_any_iterable_and_are_checked_before_the_work(tmp_path: Path) -> None:
    chosen = ["hair.length", "drop"]
    table = frisure.batch(BATCH, tmp_path, columns=(name for name in chosen))
    assert sorted(table.schema.names) == sorted(chosen)
    head = next(frisure.data.heads(tmp_path, columns=(name for name in chosen)))
    assert {"hair.length", "drop"} <= set(head)
    heard: list[float] = []
    with pytest.raises(frisure.ArgumentError, match="columns has 'hair.lenght'; there are index, status"):
        frisure.batch(BATCH, columns=["hair.lenght"], progress=lambda stage, done: heard.append(done))
    assert not heard
    for wrong in (3, "drop", [1]):
        with pytest.raises(frisure.ArgumentError, match="columns is .*; it must be a list of names"):
            frisure.data.heads(tmp_path, columns=wrong)  # type: ignore[arg-type]


def test_the_wrong_number_of_a_range_is_named_at_its_place() -> None:
    for value, words in ((float("nan"), "is nan; it must be a finite number"), ("20 kg", 'is "20 kg"; it must be a length')):
        with pytest.raises(frisure.SceneError, match=rf"`vary.hair.length.from` {words}") as told:
            frisure.batch({"samples": 1, "vary": {"hair.length": {"from": value, "to": 1}}})
        assert told.value.line == 4, told.value
    itself: dict[str, Any] = {}
    itself["a"] = itself
    with pytest.raises(frisure.ArgumentError, match="vary.*more than 64 dicts and lists"):
        frisure.batch({"samples": 1, "vary": itself})
    lists: list[Any] = [1]
    for _ in range(40):
        lists = [lists, lists]
    with pytest.raises(frisure.ArgumentError, match="spec.*more than 1000000 values"):
        frisure.batch({"samples": 1, "vary": {"a": lists}})


def test_an_exception_of_progress_ends_the_batch_and_wrong_arguments_are_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stop(stage: str, done: float) -> None:
        raise RuntimeError(stage)

    with pytest.raises(RuntimeError):
        frisure.batch({**BATCH, "samples": 500}, progress=stop)
    with pytest.raises(frisure.SceneError, match="samples"):
        frisure.batch({**BATCH, "samples": 0})
    with pytest.raises(frisure.SceneNotFoundError, match="nowhere"):
        frisure.batch(tmp_path / "nowhere.toml")
    with pytest.raises(frisure.ArgumentError, match="columns is 'guides'"):
        frisure.batch(BATCH, columns="guides")
    with pytest.raises(frisure.ArgumentError, match="columns has 'guide'; there are .*guides"):
        frisure.batch({**BATCH, "samples": 1}, columns=["guide"])
    with pytest.raises(frisure.ArgumentError, match="threads is 0"):
        frisure.batch(BATCH, threads=0)
    with pytest.raises(TypeError, match="spec is of the type int"):
        frisure.batch(3)  # type: ignore[arg-type]
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(ImportError, match=r'pip install "frisure\[data\]"'):
        frisure.batch(BATCH)


def test_no_columns_are_refused() -> None:
    with pytest.raises(frisure.ArgumentError, match="columns is empty"):
        frisure.batch(BATCH, columns=[])
