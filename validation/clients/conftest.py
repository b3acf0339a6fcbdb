"""Fixtures of all clients: the program, and a small head of hair from it."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]

SCENE = """\
name = "Clients"
[hair]
type = "curly"
length = "12 cm"
[look]
colour = "auburn"
[wisps]
hairs = 600
points = 12
count = 80
"""


class Frisure:
    """The program `frisure`."""

    def __init__(self, path):
        self.path = path

    def run(self, *arguments):
        """Runs it; a failure fails the test."""
        words = [str(self.path), *map(str, arguments)]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{' '.join(words)}\n{done.stderr}"
        return done.stdout

    def convert(self, groom, *outputs, **options):
        """Converts a groom; `unit="cm"` is `--unit cm`."""
        words = []
        for output in outputs:
            words += ["-o", output]
        for name, value in options.items():
            words += ["--" + name.replace("_", "-"), value]
        return self.run("convert", groom, *words)


@pytest.fixture(scope="session")
def frisure():
    path = pathlib.Path(os.environ.get("FRISURE", ROOT / "target/release/frisure"))
    assert path.exists(), f"build it first: cargo build --release -p frisure-cli --features batch ({path})"
    return Frisure(path.resolve())


@pytest.fixture(scope="session")
def head(frisure, tmp_path_factory):
    """A folder with `head.usda`, `head.usdc` and `head.hair`: 600 curly hairs, guides, a head."""
    folder = tmp_path_factory.mktemp("head")
    scene = folder / "scene.toml"
    scene.write_text(SCENE)
    grooms = [folder / f"head.{kind}" for kind in ("usda", "usdc", "hair")]
    words = [word for groom in grooms for word in ("-o", groom)]
    frisure.run("predict", scene, "--fibres", *words)
    return folder


@pytest.fixture(scope="session")
def khronos():
    """Codes and messages of Khronos' validator of glTF for a file, the worst first; those about what is not used or not known to it
    are no faults."""
    folder = pathlib.Path(sys.prefix) / "node_modules"
    node = shutil.which("node")
    if not node or not (folder / "gltf-validator").exists():
        pytest.skip("there is no Node or no gltf-validator: see `install`")
    code = """
        const file = require("fs").readFileSync(process.argv[1]);
        require("gltf-validator").validateBytes(new Uint8Array(file)).then((r) => console.log(JSON.stringify(r.issues)));"""

    def khronos(path):
        words = [node, "-e", code, str(path)]
        done = subprocess.run(words, capture_output=True, text=True, check=True, env={**os.environ, "NODE_PATH": str(folder)})
        issues = json.loads(done.stdout)["messages"]
        known = ("UNSUPPORTED_EXTENSION", "UNUSED_OBJECT")
        return [f"{i['code']}: {i['message']}" for i in issues if i["code"] not in known]

    return khronos


def read_hair(path):
    """A .hair file: points and thickness in metres, and the number of points of each strand."""
    data = pathlib.Path(path).read_bytes()
    assert data[:4] == b"HAIR"
    strands, points, arrays, segments = np.frombuffer(data, "<u4", 4, 4)
    at = 128
    if arrays & 1:
        counts = np.frombuffer(data, "<u2", strands, at).astype(int) + 1
        at += 2 * int(strands)
    else:
        counts = np.full(strands, segments + 1, int)
    positions = np.frombuffer(data, "<f4", 3 * int(points), at).reshape(-1, 3)
    at += 12 * int(points)
    thickness = np.frombuffer(data, "<f4", int(points), at)
    return positions * 0.01, thickness * 0.01, counts


@pytest.fixture(scope="session")
def hair_of(frisure, tmp_path_factory):
    """The groom that frisure reads from a file: points and thickness (m, z up), and the number of points of each strand."""
    folder = tmp_path_factory.mktemp("read")

    def hair_of(path, **options):
        out = folder / (pathlib.Path(path).name + ".hair")
        frisure.convert(path, out, **options)
        return read_hair(out)

    return hair_of
