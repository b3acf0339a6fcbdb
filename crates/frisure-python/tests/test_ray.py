"""A batch on a local Ray cluster of two workers, one of which is killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import frisure
import frisure.ray
import pytest

BATCH = """\
samples = 8
rows = 1
volume = false
[views]
cameras = ["front"]
size = [32, 32]
outputs = ["color", "strand"]
hairs = 50
[set]
wisps = { count = 30, hairs = 100, points = 12 }
[vary]
hair.length = { from = "8 cm", to = "12 cm" }
"""


def files(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*.parquet")}


def workers() -> list[int]:
    """Processes below this one that compute heads: Ray gives them the name of their task."""
    parents: dict[int, int] = {}
    names: dict[int, bytes] = {}
    for process in Path("/proc").glob("[0-9]*"):
        try:
            fields = (process / "stat").read_text().rpartition(")")[2].split()
            names[int(process.name)] = (process / "cmdline").read_bytes()
            parents[int(process.name)] = int(fields[1])
        except (OSError, ValueError):
            continue

    def is_ours(process: int) -> bool:
        while process in parents:
            process = parents[process]
            if process == os.getpid():
                return True
        return False

    return [process for process, name in names.items() if name.startswith(b"ray::Map") and is_ours(process)]


@pytest.fixture(scope="module")
def cluster() -> Iterator[None]:
    if os.environ.get("FRISURE_NEEDS_AUTODIFF"):
        import ray
    else:
        ray = pytest.importorskip("ray")
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, object_store_memory=100 << 20)
    yield
    ray.shutdown()


def test_a_killed_worker_leaves_the_bytes_of_one_machine(cluster: None, tmp_path: Path) -> None:
    spec = tmp_path / "batch.toml"
    spec.write_text(BATCH)
    command = [sys.executable, "-m", "frisure", "batch", str(spec), "-o", str(tmp_path / "one"), "--quiet"]
    subprocess.run(command, check=True)

    killed: list[int] = []
    finished = threading.Event()
    folder = tmp_path / "cluster"

    def kill() -> None:
        """Kills a worker that computes, once there is a part."""
        while not killed and not finished.wait(0.02):
            if len(files(folder)) >= 2 and (found := workers()):
                os.kill(found[0], signal.SIGKILL)
                killed.extend(found[:1])

    killer = threading.Thread(target=kill)
    killer.start()
    heard: list[float] = []
    try:
        done = frisure.ray.batch(spec, folder, progress=lambda stage, part: heard.append(part))
    finally:
        finished.set()
        killer.join()
    assert killed, "no worker was found"
    assert done.heads == 8 and done.failed == 0
    assert len(heard) == 8 and heard[-1] == 1
    assert files(folder) == files(tmp_path / "one")

    # A part that is missing is made again, and no other.
    (folder / "part-000000004.parquet").unlink()
    assert frisure.ray.batch(spec, folder) == frisure.ray.Done(heads=1, new=1, failed=0)
    assert files(folder) == files(tmp_path / "one")
    assert frisure.ray.batch(spec, folder) == frisure.ray.Done(0, 0, 0)


def test_errors_come_before_any_task(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    spec = tmp_path / "batch.toml"
    monkeypatch.setitem(sys.modules, "ray.data", None)
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(ImportError, match=r'pip install "ray\[data\]"'):
        frisure.ray.batch(spec, tmp_path / "heads")
    monkeypatch.undo()
    if not os.environ.get("FRISURE_NEEDS_AUTODIFF"):
        pytest.importorskip("ray")
    with pytest.raises(frisure.SceneNotFoundError):
        frisure.ray.batch(spec, tmp_path / "heads")
    spec.write_text("samples = 0\n")
    with pytest.raises(frisure.SceneError, match="samples"):
        frisure.ray.batch(spec, tmp_path / "heads")
    with pytest.raises(frisure.ArgumentError, match="cpus_per_task"):
        frisure.ray.batch(spec, tmp_path / "heads", cpus_per_task=0)
