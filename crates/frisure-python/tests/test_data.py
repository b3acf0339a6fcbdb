"""Heads of a batch as arrays, and in the loaders of PyTorch."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import frisure
import numpy as np
import pytest
from frisure import data

if not os.environ.get("FRISURE_NEEDS_AUTODIFF"):
    # tests/run sets the variable where it has installed both.
    pytest.importorskip("pyarrow")

BATCH = """\
samples = 5
rows = 2
volume = false
[views]
cameras = ["front", "back", { azimuth = "70 deg", elevation = "25 deg" }]
size = [60, 50]
hairs = 100
[set]
wisps = { count = 6, hairs = 200, points = 32 }
[vary]
hair.length = { normal = ["9 cm", "1 cm"] }
hair.type = ["straight", "wavy"]
"""
H, W = 50, 60


def batch(folder: Path, text: str, *arguments: str) -> None:
    (folder / "batch.toml").write_text(text)
    command = [sys.executable, "-m", "frisure", "batch", "batch.toml", "-o", "heads", "--quiet", *arguments]
    subprocess.run(command, cwd=folder, check=True)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data")
    batch(folder, BATCH)
    return folder / "heads"


def test_heads_have_arrays_in_their_shapes(folder: Path) -> None:
    found = list(data.heads(folder))
    assert [head["index"] for head in found] == [0, 1, 2, 3, 4]
    for head in found:
        assert head["guides"].shape == (6, 32, 3) and head["guides"].dtype == np.float32
        assert 0.05 < head["hair.length"] < 0.13 and head["hair.type"] in ("straight", "wavy")
        assert np.isnan(head["volume"]) and head["error"] == ""
        assert head["camera"] == ["front", "back", "camera-02"]
        shapes = {name: (head[name].shape, head[name].dtype) for name in ("color", "mask", "depth", "direction", "strand")}
        assert shapes == {
            "color": ((3, H, W, 3), np.uint8),
            "mask": ((3, H, W), np.uint8),
            "depth": ((3, H, W), np.float32),
            "direction": ((3, H, W, 2), np.float32),
            "strand": ((3, H, W), np.int32),
        }
        assert head["rotation"].shape == (3, 3, 3) and head["to_world"].shape == (3, 4, 4)
        head["depth"][0] = 0


def test_the_maps_agree_with_each_other(folder: Path) -> None:
    for view in data.views(folder):
        hair, body = view["mask"] > 0, view["body"] > 0
        assert hair.sum() > 50 and body.sum() > 50
        assert (view["mask"].astype(int) + view["body"] <= 256).all()
        np.testing.assert_array_equal(view["strand"] >= 0, hair)
        np.testing.assert_array_equal(view["guide"] >= 0, hair)
        np.testing.assert_array_equal(np.isfinite(view["depth"]), hair | body)
        assert view["guide"].max() < 6 and view["strand"].max() < 200
        # Every second hair is drawn, since there are twice as many as the batch asks for.
        assert (view["strand"][hair] % 2 == 0).all()
        lengths = np.linalg.norm(view["tangent"], axis=2)
        np.testing.assert_allclose(lengths[hair], 1, atol=2e-3)
        assert not lengths[~hair].any() and not view["direction"][~hair].any()


def project(view: dict[str, Any], points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Columns and rows (pixels) and depths (m) of points, in the convention of OpenCV."""
    seen = points @ view["rotation"].T + view["translation"]
    pixels = seen @ view["intrinsics"].T
    return pixels[..., :2] / pixels[..., 2:], seen[..., 2]


def test_hairs_of_the_scene_are_projected_to_their_pixels(folder: Path) -> None:
    heads = {head["index"]: head for head in data.heads(folder, ["scene"])}
    hairs = {index: frisure.predict(head["scene"]).strands.curves.astype(float) for index, head in heads.items()}
    checked = 0
    for view in data.views(folder, ["strand", "depth", "direction", "intrinsics", "rotation", "translation"]):
        rows, columns = np.nonzero(view["strand"] >= 0)
        for row, column in zip(rows[::7], columns[::7], strict=True):
            # Finer points on the chords.
            line = hairs[view["index"]][view["strand"][row, column]]
            fine = np.concatenate([a + np.linspace(0, 1, 20)[:, None] * (b - a) for a, b in zip(line, line[1:], strict=False)])
            pixels, depths = project(view, fine)
            distance = np.linalg.norm(pixels - [column, row], axis=1)
            near = distance < 1
            assert near.any(), (view["index"], view["view"], row, column, distance.min())
            # A pixel is 7 mm wide here, and a hair is seen at an angle.
            assert np.abs(depths[near] - view["depth"][row, column]).min() < 3e-3
            checked += 1
    assert checked > 400


def test_both_conventions_are_one_camera(folder: Path) -> None:
    for view in data.views(folder, ["intrinsics", "rotation", "translation", "to_world", "lens", "sensor_width"]):
        place = view["to_world"][:3, 3]
        np.testing.assert_allclose(view["rotation"] @ place + view["translation"], 0, atol=1e-12)
        axes = view["to_world"][:3, :3] @ np.diag([1, -1, -1])
        np.testing.assert_allclose(axes, view["rotation"].T, atol=1e-12)
        np.testing.assert_allclose(np.linalg.det(axes), 1, atol=1e-12)
        focal = view["lens"] / view["sensor_width"] * view["width"]
        np.testing.assert_allclose(view["intrinsics"], [[focal, 0, (W - 1) / 2], [0, focal, (H - 1) / 2], [0, 0, 1]])


def test_shards_and_orders_have_each_head_once(folder: Path) -> None:
    def indices(**arguments: Any) -> list[int]:
        return [head["index"] for head in data.heads(folder, ["drop"], **arguments)]

    for count in (2, 3, 4, 7):
        parts = [indices(shuffle=4, shard=(which, count)) for which in range(count)]
        assert sorted(sum(parts, [])) == [0, 1, 2, 3, 4], parts
    orders = {tuple(indices(shuffle=seed)) for seed in range(8)}
    assert len(orders) > 2 and indices(shuffle=3) == indices(shuffle=3)
    assert all(sorted(order) == [0, 1, 2, 3, 4] for order in orders)
    assert set(next(data.heads(folder, ["drop"]))) == {"index", "status", "drop"}


def test_failed_heads_are_left_out(tmp_path: Path) -> None:
    batch(tmp_path, BATCH.replace('["9 cm", "1 cm"]', '["2 cm", "2 cm"]'))
    lengths = [head["hair.length"] for head in data.heads(tmp_path / "heads", ["hair.length"])]
    assert 0 < len(lengths) < 5 and min(lengths) > 1e-3
    seen = Counter(view["index"] for view in data.views(tmp_path / "heads", ["mask"]))
    assert len(seen) == len(lengths) and set(seen.values()) == {3}


def test_errors_name_folder_file_and_column(folder: Path, tmp_path: Path) -> None:
    with pytest.raises(frisure.ArgumentError, match="`nowhere` has no heads: `frisure batch"):
        data.heads("nowhere")
    with pytest.raises(frisure.ArgumentError, match="has no column `colour`; there are .*color"):
        data.heads(folder, ["colour"])
    with pytest.raises(frisure.ArgumentError, match="from 0 to n - 1"):
        data.heads(folder, shard=(2, 2))
    with pytest.raises(frisure.ArgumentError, match=r"`shard` is 3; it must be \(i, n\)"):
        data.views(folder, shard=3)  # type: ignore[arg-type]
    for wrong in (-1, 1.5, True):
        with pytest.raises(frisure.ArgumentError, match=f"shuffle is {wrong}"):
            data.heads(folder, shuffle=wrong)  # type: ignore[arg-type]
    with pytest.raises(frisure.ArgumentError, match="columns is 'guides'; it must be a list of names"):
        data.heads(folder, "guides")
    broken = tmp_path / "part-000000000.parquet"
    broken.write_bytes((folder / broken.name).read_bytes()[:-100])
    with pytest.raises(frisure.ArgumentError, match="part-000000000.parquet` cannot be read"):
        data.heads(tmp_path)
    broken.write_bytes((folder / broken.name).read_bytes())
    assert len(list(data.heads(tmp_path))) == 2
    with pytest.raises(frisure.ArgumentError, match=r"has no views: its batch has no table `\[views\]`"):
        data.views(tmp_path)


def test_the_recipe_has_the_heads_of_its_hashes(tmp_path: Path) -> None:
    scenes = Path(__file__).resolve().parents[3] / "scenes/batch"
    spec = importlib.util.spec_from_file_location("people", scenes / "people.py")
    assert spec is not None and spec.loader is not None
    people = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(people)
    text = (scenes / "people-10000.toml").read_text().replace("samples = 10000", "samples = 2\nvolume = false")
    before, views, after = text.partition("[views]")
    assert views
    text = before + after[after.index("[set]") :]
    # The rows that are drawn depend on the path of the table as it is written.
    (tmp_path / "people.csv").write_bytes((scenes / "people.csv").read_bytes())
    batch(tmp_path, text)
    assert people.check(str(tmp_path / "heads")) == []


@pytest.mark.parametrize("missing", ["pyarrow", "torch"])
def test_what_is_not_installed_is_named(missing: str, monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    monkeypatch.setitem(sys.modules, missing, None)
    if missing == "pyarrow":
        monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)
    with pytest.raises(ImportError, match=f"pip install {missing}"):
        data.torch_dataset(folder) if missing == "torch" else data.heads(folder)


def test_workers_of_a_loader_share_the_heads(folder: Path) -> None:
    if not os.environ.get("FRISURE_NEEDS_AUTODIFF"):
        pytest.importorskip("torch")
    import torch.utils.data

    dataset = data.torch_dataset(folder, ["guides", "drop"], shuffle=1)
    loader = torch.utils.data.DataLoader(dataset, batch_size=2, num_workers=2, multiprocessing_context="spawn")
    batches = list(loader)
    assert sorted(int(index) for batch in batches for index in batch["index"]) == [0, 1, 2, 3, 4]
    assert batches[0]["guides"].shape[1:] == (6, 32, 3) and batches[0]["guides"].dtype == torch.float32

    seen = data.torch_dataset(folder, ["strand"], per="view", transform=lambda view: (view["index"], view["view"]))
    assert sorted(seen) == [(index, view) for index in range(5) for view in range(3)]
    with pytest.raises(frisure.ArgumentError, match=r"`shard` is \(\)"):
        data.torch_dataset(folder, shard=())  # type: ignore[arg-type]
    with pytest.raises(frisure.ArgumentTypeError, match="`transform` is 3; it must be a function"):
        data.torch_dataset(folder, transform=3)  # type: ignore[arg-type]
    ranks = [data.torch_dataset(folder, ["drop"], shard=(rank, 2)) for rank in range(2)]
    assert sorted(head["index"] for rank in ranks for head in rank) == [0, 1, 2, 3, 4]
    orders = set()
    for epoch in range(6):
        dataset.set_epoch(epoch)
        orders.add(tuple(head["index"] for head in dataset))
    assert len(orders) > 1
