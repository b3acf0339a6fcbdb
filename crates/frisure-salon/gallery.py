#!/usr/bin/env python3
"""Makes the pictures of the gallery, gallery/*.png, with the command frisure.

Usage: gallery.py PATH/TO/frisure. Needs Pillow, which gives each picture its own colours, 48 for a hair type and 80 for a
hairstyle, so that all together weigh less than the fonts of the page.
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
        start = subprocess.run([sys.argv[1], "new", name], capture_output=True, text=True, check=True).stdout
        model = re.search(r'(?m)^model = "([a-z-]+)"', start)[1]
        text = f'[head]\nmodel = "{model}"\n[hair]\ntype = "{name}"\n'
        out = here / f"gallery/{name}.png"
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
    colours = 48 if kind == "type" else 80
    image = image.quantize(colours, kmeans=3, dither=Image.Dither.NONE)
    bytes_ = io.BytesIO()
    image.save(bytes_, "PNG", optimize=True)
    out.write_bytes(bytes_.getvalue())
