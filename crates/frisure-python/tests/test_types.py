"""Types: the stubs fit the module, and what a user writes passes `mypy --strict`."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import example

pytest.importorskip("mypy")


def check(*arguments: str) -> None:
    folder = str(Path(example.__file__).parent)
    environment = {**os.environ, "MYPY_CACHE_DIR": os.devnull, "MYPYPATH": folder}
    command = [sys.executable, "-m", *arguments]
    ran = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    assert ran.returncode == 0, ran.stdout + ran.stderr


def test_the_example_runs(tmp_path: Path) -> None:
    assert example.main(tmp_path).shape == (110, 90, 3)


def test_the_example_and_the_package_have_strict_types() -> None:
    check("mypy", "--strict", "-p", "frisure", "-m", "example")


def test_the_stubs_are_those_of_the_module() -> None:
    check("mypy.stubtest", "frisure._frisure")
