#!/usr/bin/env python3
"""Makes the pictures of the gallery, gallery/*.jpg, that are not there, with the command frisure.

Usage: gallery.py PATH/TO/frisure. Needs Pillow. All together weigh less than the fonts of the page.
"""
import pathlib, re, subprocess, sys, tempfile
from PIL import Image

here = pathlib.Path(__file__).parent
scenes = here / "../../scenes"
cards = (here / "src/state/gallery.rs").read_text()
lights = (here / "src/window/lights.rs").read_text()
CAMERA = "\n[camera]\nazimuth = \"35 deg\"\nelevation = \"5 deg\"\n"


def without(text, table):
    return re.sub(rf"(?ms)^\[{table}\].*?(?=^\[|\Z)", "", text)


def make(name, text, size=(352, 432), crop=None, shown=(176, 216)):
    """A preview of a scene, cropped to a box of its pixels and made smaller."""
    out = here / f"gallery/{name}.jpg"
    if out.exists():
        return
    with tempfile.TemporaryDirectory() as folder:
        scene, picture = pathlib.Path(folder, "s.toml"), pathlib.Path(folder, "s.png")
        scene.write_text(without(text, "output") + f"\n[output]\nwidth = {size[0]}\nheight = {size[1]}\nsamples = 4\n")
        # A guide that has not converged is reported, not fatal.
        subprocess.run([sys.argv[1], "predict", scene, "--image", picture])
        image = Image.open(picture).convert("RGB").crop(crop).resize(shown, Image.LANCZOS)
    image.save(out, "JPEG", quality=80, optimize=True)


for kind, name in re.findall(r'card!\((type|scene) "([^"]+)"', cards):
    if kind == "type":
        start = subprocess.run([sys.argv[1], "new", name], capture_output=True, text=True, check=True).stdout
        model = re.search(r'(?m)^model = "([a-z-]+)"', start)[1]
        make(name, f'[head]\nmodel = "{model}"\n[hair]\ntype = "{name}"\n' + CAMERA)
    else:
        make(f"scene-{name}", without((scenes / f"{name}.toml").read_text(), "camera") + CAMERA)
for path in sorted((here / "exercises").glob("*.toml")):
    make(f"exercise-{path.stem}", path.read_text(), (528, 648))
bob = (here / "exercises/bob.toml").read_text().split("[[step]]")[0]
bob = bob.replace('length = "44 cm"', 'length = "26 cm"').replace('"straight"', '"caucasian-wavy"')
for name in re.findall(r'light!\("([^"]+)"', lights):
    make(f"light-{name}", bob + f'\n[light]\nsetup = "{name}"\n', (420, 420), (90, 15, 330, 255), (72, 72))
