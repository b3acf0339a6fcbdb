#!/usr/bin/env python3
"""Makes the pictures of the gallery, gallery/*.png, with the command frisure.

Usage: gallery.py PATH/TO/frisure. Needs Pillow, which gives each picture its own colours, 40 where the head is the
mannequin and 80 where it is a person, so that all together weigh less than the fonts of the page.
"""
import io, pathlib, re, subprocess, sys, tempfile
from PIL import Image

here = pathlib.Path(__file__).parent
scenes = here / "../../scenes"
cards = (here / "src/state/gallery.rs").read_text()
SIZE = "\n[output]\nwidth = 352\nheight = 432\nsamples = 4\n"
CAMERA = "\n[camera]\nazimuth = \"35 deg\"\nelevation = \"5 deg\"\n"


def without(text, table):
    return re.sub(rf"(?ms)^\[{table}\].*?(?=^\[|\Z)", "", text)


for kind, name in re.findall(r'card!\((type|scene) "([^"]+)"', cards):
    if kind == "type":
        text, out = f'[hair]\ntype = "{name}"\n', here / f"gallery/{name}.png"
    else:
        text, out = (scenes / f"{name}.toml").read_text(), here / f"gallery/scene-{name}.png"
    if out.exists():
        continue
    out.parent.mkdir(exist_ok=True)
    text = without(without(text, "output"), "camera") + CAMERA + SIZE
    with tempfile.TemporaryDirectory() as folder:
        scene, picture = pathlib.Path(folder, "s.toml"), pathlib.Path(folder, "s.png")
        scene.write_text(text)
        subprocess.run([sys.argv[1], "predict", scene, "--image", picture])
        # A guide that has not converged is reported, not fatal.
        image = Image.open(picture).convert("RGB").resize((176, 216), Image.LANCZOS)
    colours = 80 if "[head]" in text else 40
    image = image.quantize(colours, kmeans=3, dither=Image.Dither.NONE)
    bytes_ = io.BytesIO()
    image.save(bytes_, "PNG", optimize=True)
    out.write_bytes(bytes_.getvalue())
