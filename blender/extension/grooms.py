"""Grooms in files, as other programs take them."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import frisure


def save(hairstyle: frisure.Hairstyle, path: str, program: str = "") -> None:
    """Writes a file in the format that its extension names; with a program as `frisure convert --for` writes it."""
    if not program:
        hairstyle.save(path)
        return
    folder = Path(path).absolute().parent
    if not folder.is_dir():
        raise ValueError(f"there is no folder {folder}")
    path = str(Path(path).absolute())
    with tempfile.TemporaryDirectory(prefix="frisure-") as folder:
        whole = os.path.join(folder, f"{Path(path).stem or 'hair'}.usdc")
        hairstyle.save(whole)
        convert(whole, path, program)


def convert(groom: str, path: str, program: str) -> None:
    """Runs `frisure convert --for`, the command of the wheel, in a process of its own: its errors go to a stream."""
    # In Blender `sys.executable` is its Python, which does not know the folder of the extension's wheels.
    paths = [str(Path(frisure.__file__).resolve().parents[1]), os.environ.get("PYTHONPATH", "")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))}
    words = [sys.executable, "-m", "frisure", "--quiet", "convert", groom, "--for", program, "-o", path]
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if done.returncode != 0:
        raise ValueError(done.stderr.strip() or f"frisure convert ended with status {done.returncode}")
