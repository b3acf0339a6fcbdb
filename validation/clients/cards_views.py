"""Renders strands and their cards with Blender from six sides, and prints how far each level is from the strands: the second table of
docs/cards.md.

    frisure predict scenes/curly.toml -o out/curly.usdc
    frisure cards out/curly.usdc -o out/curly.glb
    PYTHON validation/clients/cards_views.py out/curly.usdc out/curly.glb

Views and measures are those of crates/frisure-cards/src/compare.rs, but Cycles draws both: every strand of the file with its own width,
and cards with their textures. PYTHON is that of the environment that `validation/clients/run` makes. Not a test: it takes minutes.
"""

import pathlib
import sys
import tempfile

import bpy
import numpy as np
from mathutils import Matrix, Vector

# The direction in which each view looks (z up, the face towards -y).
VIEWS = {
    "front": (0, 1, 0),
    "back": (0, -1, 0),
    "left": (-1, 0, 0),
    "right": (1, 0, 0),
    "top": (0, 0, -1),
    "three-quarter": (-0.55, 0.75, -0.37),
}

# Pixels along a side of a view, and of its margin.
PIXELS, MARGIN = 256, 4

# Samples of a pixel: a covered part of one half is known within 0.06.
SAMPLES = 64


def opened(usd, glb):
    """Imports strands, head and the cards of all levels into an empty file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=usd)
    if "head" in bpy.data.objects:
        # It hides what is behind it, and is not in the picture.
        bpy.data.objects["head"].is_holdout = True
    bpy.ops.import_scene.gltf(filepath=glb)
    cards = sorted((o for o in bpy.data.objects if o.name.startswith("hair_LOD")), key=lambda o: o.name)
    shown = bpy.context.scene.collection.objects
    for level in cards:
        # Coarser levels are in a collection that is not rendered.
        if level.name not in shown:
            shown.link(level)
    bpy.context.view_layer.update()
    return bpy.data.objects["hairs"], cards


def prepare(folder):
    """Pictures of what is covered, without light, and the path of the picture."""
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("dark")
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.max_bounces = SAMPLES, False, 0
    scene.cycles.use_adaptive_sampling = False
    # A sample counts for its own pixel alone.
    scene.cycles.pixel_filter_type = "BOX"
    # Cards lie before each other: light passes many.
    scene.cycles.transparent_max_bounces = 128
    scene.cycles_curves.shape = "RIBBONS"
    scene.render.film_transparent = True
    scene.render.resolution_x = scene.render.resolution_y = PIXELS
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.filepath = str(pathlib.Path(folder) / "view.exr")
    scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.camera.data.type = "ORTHO"
    scene.collection.objects.link(scene.camera)


def world_points(hairs):
    points = np.empty(3 * len(hairs.data.points), dtype=np.float32)
    hairs.data.attributes["position"].data.foreach_get("vector", points)
    matrix = np.array(hairs.matrix_world)
    return points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def look(forward, points):
    """Places the camera so that all points are in the view."""
    forward = Vector(forward).normalized()
    up = Vector((0, -1, 0)) if abs(forward.z) > 0.99 else Vector((0, 0, 1))
    right = forward.cross(up).normalized()
    axes = np.array([right, right.cross(forward), -forward])
    flat = points @ axes.T
    low, high = flat.min(axis=0), flat.max(axis=0)
    middle = 0.5 * (low + high)
    # In front of everything.
    middle[2] = high[2] + 1.0
    camera = bpy.context.scene.camera
    camera.data.ortho_scale = float((high - low)[:2].max()) * PIXELS / (PIXELS - 2 * MARGIN)
    camera.matrix_world = Matrix.Translation(Vector(middle @ axes)) @ Matrix(axes.T.tolist()).to_4x4()


def covered(thing, things):
    """The covered part of each pixel with one object alone."""
    for other in things:
        other.hide_render = other is not thing
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(bpy.context.scene.render.filepath, check_existing=False)
    pixels = np.empty(4 * PIXELS * PIXELS, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels[3::4]


def difference(strands, cards):
    """Silhouette, coverage and covered area, as the program has them."""
    if not strands.any():
        # Straight hair along which the camera looks: there is nothing to compare with.
        return 0.0, 0.0, 1.0
    a, b = strands >= 0.5, cards >= 0.5
    return (a != b).sum() / max((a | b).sum(), 1), np.abs(strands - cards).sum() / strands.sum(), cards.sum() / strands.sum()


def main(usd, glb):
    hairs, levels = opened(usd, glb)
    points = world_points(hairs)
    found = np.empty((len(levels), len(VIEWS), 3))
    with tempfile.TemporaryDirectory() as folder:
        prepare(folder)
        for v, forward in enumerate(VIEWS.values()):
            look(forward, points)
            strands = covered(hairs, [hairs, *levels])
            for k, level in enumerate(levels):
                found[k, v] = difference(strands, covered(level, [hairs, *levels]))
    print("| level | silhouette | coverage | covered area | silhouette of " + ", ".join(VIEWS) + " |")
    print("| --- | --- | --- | --- | --- |")
    for k, level in enumerate(100 * found):
        means = " | ".join(f"{mean:.1f} %" for mean in level.mean(axis=0))
        print(f"| {k} | {means} | {', '.join(f'{s:.1f}' for s in level[:, 0])} |")


main(*sys.argv[1:3])
