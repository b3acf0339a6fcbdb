#!/usr/bin/env python3
"""Makes the pictures of README.md and docs/ again, with the command frisure.

Usage: docs/pictures.py PATH/TO/frisure [--paths N] [--jobs N] [NAME...]

NAME is one of the groups below (heads, final, collisions, colours, looks, lights, wet, styling, tucked, braid, grooms), or a
picture of `final` such as final/afro; without a name all are made. `--paths` is the number of paths per pixel of a traced
picture (96: all pictures take about three hours of one processor), `--jobs` how many pictures are made at once (1: on few
processors each picture uses all of them). FRISURE_OIDN names the library of Open Image Denoise if the system does not know it. Needs Pillow.

Not made here: docs/pictures/fibre.jpg (`cargo run --release -p frisure-render --example fibre -- fibre.png`),
docs/pictures/validation (`frisure evidence`), docs/pictures/grooms/blender.jpg
(validation/clients/blender_picture.py), and docs/pictures/salon, which are photographs of the window.
"""
import argparse, math, pathlib, re, struct, subprocess, tempfile
from concurrent.futures import ThreadPoolExecutor
from PIL import Image, ImageDraw, ImageFont

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES, OUT = ROOT / "scenes", ROOT / "docs/pictures"
HEADS = """short-asian straight long-straight fringe parting bob wavy curly ringlets frizzy coils afro""".split()
FINAL = HEADS + "collisions-none collisions obj-head fringe-cut growth rollers".split()
CAPTION = 18  # pixels below a picture that has a caption
STRAIGHT = '[head]\nmodel = "european-woman"\n[hair]\ntype = "caucasian-straight"\nlength = "25 cm"\n[implantation]\nflow = "parted"\nparting = "2 cm"\n'
BEHIND = '[camera]\nazimuth = "150 deg"\n'
BOB = (
    '[head]\nmodel = "european-woman"\n[hair]\ntype = "asian-straight"\nlength = "33 cm"\n[look]\ncolour = "dark-brown"\n[camera]\nazimuth = "60 deg"\n'
    '[[step]]\ncut = { below = "chin", held = "hanging" }\n'
)
LOOKS = [
    ("dye, 5 cm grown", 'colour = "dark-brown"\ndye = { colour = "#a03040", strength = 0.9, regrowth = "5 cm" }'),
    ("grey", 'colour = "grey"'),
    ("salt-and-pepper", 'colour = "salt-and-pepper"'),
    ("dark roots", 'colour = "blond"\nroots = { pigment = 10.0, fade = "14 cm" }'),
    ("light tips", 'colour = "light-brown"\ntips = { pigment = 0.14, fade = "14 cm" }'),
]
SETUPS = "studio soft butterfly rembrandt rim daylight overcast".split()


def without(text, table):
    """The scene without one of its tables."""
    return re.sub(rf"(?ms)^\[{table}\].*?(?=^\[|\Z)", "", text)


class Maker:
    """Runs frisure in a folder of its own and saves what comes out as JPEG."""

    def __init__(self, program, paths, jobs, folder):
        self.program, self.paths, self.folder = program, paths, pathlib.Path(folder)
        self.pool = ThreadPoolExecutor(jobs)

    def each(self, make, items):
        """What `make` makes of each item, several at once."""
        return list(self.pool.map(make, items))

    def run(self, *arguments):
        done = subprocess.run([self.program, *map(str, arguments)], cwd=SCENES, capture_output=True, text=True)
        # A guide that has not converged ends with status 1, and the picture is there all the same; errors end with it, too.
        if done.returncode not in (0, 1) or done.stderr.startswith("error"):
            raise SystemExit(f"frisure {' '.join(map(str, arguments))}\n{done.stderr}")

    def traced(self, hair, size, look=None, share=0.85, scale=1):
        """A scene, or a groom with the scene `look`, by the path tracer; made `scale` times as large and then smaller, which keeps
        the hairs that the denoiser blurs."""
        width, height = scale * size[0], scale * size[1]
        out = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "traced.png"
        with_look = ["--look", look] if look else []
        self.run("render", hair, "-o", out, "--size", f"{width}x{height}", "--noise", 0, "--paths", self.paths,
                 f"--denoise={round(100 * share)}", "-q", *with_look)
        picture = Image.open(out).convert("RGB")
        return picture.resize(size, Image.LANCZOS) if scale > 1 else picture

    def small(self, hair, size, look=None):
        """The same in a small picture, whose pixels are the mean of four."""
        return self.traced(hair, size, look, scale=2)

    def scene(self, text, name="scene"):
        path = self.folder / f"{name}.toml"
        path.write_text(text)
        return path

    def groom(self, text, name):
        path = self.folder / f"{name}.hair"
        self.run("predict", self.scene(text, name), "-o", path)
        return path

    def steps(self, text, size, name):
        """Previews of a scene before its first step and after each."""
        text = without(text, "output") + f"\n[output]\nwidth = {2 * size[0]}\nheight = {2 * size[1]}\n"
        out = self.folder / f"{name}.png"
        self.run("predict", self.scene(text, name), "--each-step", "--image", out)
        pictures = sorted(self.folder.glob(f"{name}-*.png"))
        return [Image.open(p).convert("RGB").resize(size, Image.LANCZOS) for p in pictures]

    def save(self, image, name, quality=80):
        image.save(OUT / f"{name}.jpg", "JPEG", quality=quality, optimize=True, progressive=True)
        print(name, flush=True)


def grid(pictures, columns, captions=None):
    """Pictures of one size in rows, each with a caption below it."""
    width, height = pictures[0].size
    cell = height + (CAPTION if captions else 0)
    sheet = Image.new("RGB", (columns * width, math.ceil(len(pictures) / columns) * cell), "white")
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default(12)
    for i, picture in enumerate(pictures):
        x, y = i % columns * width, i // columns * cell
        sheet.paste(picture, (x, y))
        if captions:
            draw.text((x + width / 2, y + height + CAPTION / 2), captions[i], "#202020", font, "mm")
    return sheet


def heads(maker):
    pictures = maker.each(lambda name: maker.small(SCENES / f"{name}.toml", (360, 440)), HEADS)
    maker.save(grid(pictures, 4), "heads")


def final(maker, names=FINAL):
    maker.each(lambda name: maker.save(maker.traced(SCENES / f"{name}.toml", (1024, 1024)), f"final/{name}"), names)


def collisions(maker):
    text = (SCENES / "collisions-none.toml").read_text()
    layers = maker.scene(re.sub(r'(?m)^hair = "none"', 'hair = "layers"', text))
    scenes = [SCENES / "collisions-none.toml", layers, SCENES / "collisions.toml"]
    maker.save(grid(maker.each(lambda scene: maker.small(scene, (360, 440)), scenes), 3), "collisions")


def swatches(maker, looks, name):
    """One straight head from behind in each of the looks, lines of `[look]`."""
    hair = maker.groom(STRAIGHT, "straight")
    scenes = [maker.scene(STRAIGHT + BEHIND + f"[look]\n{look}\n", f"look{i}") for i, (_, look) in enumerate(looks)]
    pictures = maker.each(lambda scene: maker.small(hair, (180, 216), scene), scenes)
    maker.save(grid(pictures, 5, [caption for caption, _ in looks]), name, 85)


def colours(maker):
    table = (ROOT / "docs/look.md").read_text().split("| name |")[1].split("\n\n")[0]
    names = re.findall(r"(?m)^\| `([a-z-]+)`", table)
    swatches(maker, [(name, f'colour = "{name}"') for name in names], "colours")


def looks(maker):
    swatches(maker, LOOKS, "looks")


def window(path):
    """A room with one bright window and a dark floor, as Radiance RGBE without compression."""
    width, height = 128, 64

    def light(x, y):
        if 40 <= x < 52 and 18 <= y < 34:
            return (14.0, 15.0, 17.0)
        return (0.28, 0.26, 0.23) if y < 33 else (0.12, 0.10, 0.09)

    def rgbe(colour):
        exponent = math.frexp(max(colour))[1]
        return struct.pack("4B", *(int(c * 256 / 2**exponent) for c in colour), exponent + 128)

    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode()
    path.write_bytes(head + b"".join(rgbe(light(x, y)) for y in range(height) for x in range(width)))


def lights(maker):
    hair = maker.groom(STRAIGHT, "straight")
    window(maker.folder / "window.hdr")
    kinds = [(s, f'setup = "{s}"') for s in SETUPS] + [("environment (a window)", 'environment = "window.hdr"')]
    scenes = [maker.scene(f"{STRAIGHT}[look]\ncolour = \"light-brown\"\n[light]\n{light}\n", f"light{i}")
              for i, (_, light) in enumerate(kinds)]
    pictures = maker.each(lambda scene: maker.small(hair, (200, 240), scene), scenes)
    maker.save(grid(pictures, 4, [caption for caption, _ in kinds]), "lights", 85)


def wet(maker):
    dry = without((SCENES / "wavy.toml").read_text(), "look") + '\n[look]\ncolour = "light-brown"\n'
    soaked = dry + "\n[[step]]\nwet = {}\n"
    locks = soaked.replace("[hair]\n", '[hair]\nwetting = "capillary"\n')
    scenes = [maker.scene(dry, "dry"), maker.scene(soaked, "wet"), maker.scene(locks, "locks")]
    captions = ["dry", "wet, as in the paper", "wet, with locks"]
    maker.save(grid(maker.each(lambda scene: maker.small(scene, (260, 312)), scenes), 3, captions), "wet", 85)


def styling(maker):
    def row(text, size, name, which=None):
        pictures = maker.steps(text, size, name)
        return grid([pictures[i] for i in which] if which else pictures, len(which or pictures))

    def of(scene):
        return (SCENES / f"{scene}.toml").read_text()

    rows = [
        (of("fringe-cut"), (400, 489), "fringe-cut"),
        (of("growth"), (266, 325), "growth", (0, 2, 3, 5, 7, 11)),
        (of("rollers"), (320, 391), "rollers", (0, 2, 4)),
        (BOB, (320, 391), "bob", (0, 1)),
    ]
    sheet = Image.new("RGB", (1600, 489 + 325 + 391), "white")
    for picture, place in zip(maker.each(lambda of_row: row(*of_row), rows), [(0, 0), (2, 489), (0, 814), (960, 814)]):
        sheet.paste(picture, place)
    maker.save(sheet, "styling", 77)


def tucked(maker):
    size, pictures = (320, 391), []
    for name in ["tucked", "slicked-back"]:
        steps = maker.steps((SCENES / f"{name}.toml").read_text(), size, name)
        pictures += [steps[0], steps[-1]]
    captions = ["as it falls", "tucked behind the ears", "as it falls", "gel, combed back, dried, let go"]
    maker.save(grid(pictures, 4, captions), "tucked", 80)


def braid(maker):
    text = (ROOT / "crates/frisure-salon/exercises/braid.toml").read_text()
    scenes = [maker.scene(re.sub(r'azimuth = "[^"]*"', f'azimuth = "{a} deg"', text), f"braid{a}") for a in (150, 90)]
    maker.save(grid(maker.each(lambda scene: maker.small(scene, (420, 500)), scenes), 2), "braid", 85)


def grooms(maker):
    out = maker.folder / "predict.png"
    text = without((SCENES / "curly.toml").read_text(), "output") + "\n[output]\nwidth = 500\nheight = 600\n"
    maker.run("predict", maker.scene(text), "--image", out)
    maker.save(Image.open(out).convert("RGB"), "grooms/predict", 85)


GROUPS = [heads, collisions, colours, looks, lights, wet, styling, tucked, braid, grooms, final]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("frisure")
    arguments.add_argument("--paths", type=int, default=96)
    arguments.add_argument("--jobs", type=int, default=1)
    arguments.add_argument("names", nargs="*", metavar="NAME")
    asked = arguments.parse_intermixed_args()
    single = [name[6:] for name in asked.names if name.startswith("final/")]
    groups = [g for g in GROUPS if not asked.names or g.__name__ in asked.names]
    known = {g.__name__ for g in GROUPS} | {f"final/{name}" for name in FINAL}
    for name in asked.names:
        if name not in known:
            arguments.error(f"no picture `{name}`: {', '.join(sorted(known))}")
    program = pathlib.Path(asked.frisure).resolve()
    with tempfile.TemporaryDirectory() as folder:
        maker = Maker(program, asked.paths, asked.jobs, folder)
        for group in groups:
            group(maker)
        final(maker, single)


if __name__ == "__main__":
    main()
