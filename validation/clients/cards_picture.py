"""Draws strands and their cards with Blender, one picture of each: those of docs/cards.md. With `all` behind it, each level's, too.

    frisure predict scene.toml -o out/hair.usdc
    frisure cards out/hair.usdc -o out/hair.glb
    PYTHON validation/clients/cards_picture.py out/hair.usdc out/hair.glb docs/pictures/cards

PYTHON is that of the environment that `validation/clients/run` makes. Not a test: the pictures are for eyes.
"""

import math
import pathlib
import sys

import bpy
from blender_picture import camera, lit
from mathutils import Vector


def opened(usd, glb):
    """Imports strands, head and the cards of all levels into an empty file; the strands get the colour of the preview material."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=usd, import_all_materials=True)
    hairs = bpy.data.objects["hairs"]
    hairs.data.materials.append(bpy.data.materials["hair"])
    bpy.ops.import_scene.gltf(filepath=glb)
    cards = sorted((o for o in bpy.data.objects if o.name.startswith("hair_LOD")), key=lambda o: o.name)
    # The same highlight on both: cards have a direction of hair that Blender does not read.
    for thing in [hairs, *cards]:
        for node in thing.data.materials[0].node_tree.nodes:
            if node.type == "BSDF_PRINCIPLED":
                node.inputs["Roughness"].default_value = 0.4
    return hairs, cards


def seen(hairs):
    """A camera in front, a little to the head's left, with all hair in the picture."""
    corners = [hairs.matrix_world @ Vector(corner) for corner in hairs.bound_box]
    middle = sum(corners, Vector()) / 8
    size = max((corner - middle).length for corner in corners)
    camera(middle, 30, 0.95 * size / math.tan(math.radians(12)))
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 48, False
    # Cards lie before each other: light passes many.
    scene.cycles.transparent_max_bounces = 128
    scene.cycles_curves.shape = "THICK"
    scene.render.resolution_x = scene.render.resolution_y = 420
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "JPEG"
    scene.render.image_settings.quality = 88


def main(usd, glb, folder, levels=""):
    hairs, cards = opened(usd, glb)
    lit((60, 25, 60), 0.5)
    seen(hairs)
    things = [hairs, *cards]
    names = ["strands", "cards", *(f"cards-level-{k}" for k in range(1, len(cards)))]
    for thing, name in list(zip(things, names))[: None if levels == "all" else 2]:
        for other in things:
            other.hide_render = other is not thing
        bpy.context.scene.render.filepath = str(pathlib.Path(folder).resolve() / f"{name}.jpg")
        bpy.ops.render.render(write_still=True)


main(*sys.argv[1:5])
