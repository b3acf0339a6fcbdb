"""Parquet: pyarrow reads the heads of a batch, and frisure computes the same hair again."""

import pathlib
import re

import numpy as np
import pyarrow.dataset as ds
import pyarrow.parquet as pq
import pytest

BATCH = """\
samples = 6
rows = 4
[set]
wisps = { count = 5, hairs = 50, points = 10 }
[vary]
hair.length = { normal = ["2 cm", "2 cm"] }
hair.type = ["straight", "curly"]
wisps.blending = { from = 0.1, to = 0.9 }
"""


@pytest.fixture(scope="module")
def folder(frisure, tmp_path_factory):
    folder = tmp_path_factory.mktemp("batch")
    (folder / "batch.toml").write_text(BATCH)
    frisure.run("batch", folder / "batch.toml", "-o", folder / "heads")
    return folder


def test_columns_and_rows(folder):
    table = ds.dataset(folder / "heads", format="parquet").to_table()
    assert table["index"].to_pylist() == list(range(6))
    kinds = {field.name: str(field.type) for field in table.schema}
    assert (kinds["hair.length"], kinds["hair.type"], kinds["guide_count"]) == ("double", "string", "int32")
    assert kinds["guides"].startswith("list<")
    for row in table.to_pylist():
        possible = row["hair.length"] >= 1e-3
        assert row["status"] == ("ok" if possible else "failed")
        assert (row["error"] is None) == (row["guides"] is not None) == possible
    assert {row["status"] for row in table.to_pylist()} == {"ok", "failed"}
    keys = pq.read_metadata(folder / "heads/part-000000000.parquet").metadata
    assert len(keys[b"frisure.batch"]) == 32


def test_the_scene_of_a_row_has_the_same_guides(frisure, folder):
    rows = ds.dataset(folder / "heads", format="parquet").to_table().to_pylist()
    row = next(row for row in rows if row["status"] == "ok")
    curves = np.asarray(row["guides"], "f4").reshape(row["guide_count"], row["guide_points"], 3)
    assert curves.shape == (5, 10, 3)
    # A chord is never longer than its arc.
    lengths = np.linalg.norm(np.diff(curves, axis=1), axis=2).sum(1)
    assert 0.8 * row["length"] < lengths.mean() < row["length"] * (1 + 1e-5)
    fall = (curves[:, 0, 2] - curves[:, -1, 2]).mean() / row["length"]
    assert abs(fall - row["drop"]) < 0.2

    frisure.run("batch", folder / "batch.toml", "--scene", row["index"], "-o", folder / "one.toml")
    assert (folder / "one.toml").read_text() == row["scene"]
    frisure.run("predict", folder / "one.toml", "-o", folder / "one.npz", "--content", "guides")
    with np.load(folder / "one.npz") as groom:
        np.testing.assert_array_equal(groom["guide_positions"], curves)


def test_the_example_of_the_documentation_runs(folder, monkeypatch, capsys):
    docs = pathlib.Path(__file__).resolve().parents[2] / "docs/batch.md"
    example = re.search(r"```python\n(import numpy.*?)```", docs.read_text(), re.DOTALL)[1]
    monkeypatch.chdir(folder)
    names = {}
    exec(example, names)
    assert names["curves"].shape == (5, 10, 3)
    assert "hair.length" in capsys.readouterr().out
