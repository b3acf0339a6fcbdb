#!/usr/bin/env python3
"""Makes the extension for Blender, a zip with the wheel of the Python package in it.

    python3 blender/build.py WHEEL [-o out/frisure-blender.zip]

The wheel is that of `crates/frisure-python` (`pip wheel crates/frisure-python`), bundled as it is. The same wheel gives the same zip.
"""

import argparse
import re
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).parent

# The pictures of the hair types in the salon.
GALLERY = HERE.parent / "crates" / "frisure-salon" / "gallery"

# Blender's names of the platforms in a wheel's name, by how they begin and end.
PLATFORMS = {
    ("manylinux", "x86_64"): "linux-x64",
    ("linux", "x86_64"): "linux-x64",
    ("manylinux", "aarch64"): "linux-arm64",
    ("win", "amd64"): "windows-x64",
    ("macosx", "arm64"): "macos-arm64",
}

# The earliest time of a zip: a build depends on nothing but its files.
TIME = (1980, 1, 1, 0, 0, 0)


def version() -> str:
    """The version of the workspace."""
    manifest = (HERE.parent / "Cargo.toml").read_text()
    found = re.search(r'^version = "([^"]+)"', manifest, re.MULTILINE)
    if found is None:
        sys.exit("Cargo.toml has no version")
    return found[1]


def platform(wheel: Path) -> str:
    """Blender's name of the platform of a wheel."""
    tag = wheel.stem.split("-")[-1]
    for (start, end), name in PLATFORMS.items():
        if tag.startswith(start) and tag.endswith(end):
            return name
    sys.exit(f"{wheel.name}: Blender runs on no platform `{tag}`; one of: {', '.join(sorted(set(PLATFORMS.values())))}")


def manifest(wheel: Path) -> str:
    """The manifest with version, platform and wheel."""
    text = (HERE / "extension" / "blender_manifest.toml").read_text()
    for key, value in {
        "version": f'"{version()}"',
        "platforms": f'["{platform(wheel)}"]',
        "wheels": f'["./wheels/{wheel.name}"]',
    }.items():
        text, count = re.subn(rf"^{key} = .*$", f"{key} = {value}", text, flags=re.MULTILINE)
        assert count == 1, key
    return text.split("\n", 1)[1]


def presets() -> list[str]:
    """The names of the hair types that have a picture."""
    return sorted(p.stem for p in GALLERY.glob("*.jpg") if not p.stem.startswith(("scene-", "exercise-", "light-")))


def build(wheel: Path, out: Path) -> None:
    """Writes the zip."""
    files = {"blender_manifest.toml": manifest(wheel).encode(), f"wheels/{wheel.name}": wheel.read_bytes()}
    for path in (HERE / "extension").glob("*.py"):
        files[path.name] = path.read_bytes()
    for name in presets():
        files[f"thumbnails/{name}.jpg"] = (GALLERY / f"{name}.jpg").read_bytes()
    files["LICENSE"] = (HERE.parent / "LICENSE").read_bytes()
    out.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(out, "w") as archive:
        for name in sorted(files):
            entry = zipfile.ZipInfo(name, TIME)
            # Wheels and pictures are compressed already.
            entry.compress_type = zipfile.ZIP_STORED if name.endswith((".whl", ".jpg")) else zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, files[name])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("wheel", type=Path, help="the wheel of crates/frisure-python")
    parser.add_argument("-o", "--output", type=Path, default=HERE.parent / "out" / "frisure-blender.zip", help="the zip")
    arguments = parser.parse_args()
    if not arguments.wheel.is_file():
        sys.exit(f"there is no wheel {arguments.wheel}; `pip wheel crates/frisure-python --no-deps -w out` makes one")
    build(arguments.wheel, arguments.output)
    print(arguments.output)


if __name__ == "__main__":
    main()
