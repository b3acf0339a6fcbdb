"""Draws a prediction with Blender by the steps of docs/grooms.md: import, material, lights, Cycles.

    frisure predict scenes/curly.toml -o out/curly.usdc
    PYTHON validation/clients/blender_picture.py out/curly.usdc docs/pictures/grooms/blender.jpg 1.0 0.5

The numbers are `look.eumelanin` and `look.pheomelanin` of the scene. PYTHON is that of the environment that `validation/clients/run` makes. Not a test: the picture is for eyes.
"""

import math
import os
import sys

import bpy
from mathutils import Vector


def opened(path):
    """Imports the prediction into an empty file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=path)
    return bpy.data.objects["hairs"], bpy.data.objects["head"]


def dyed(hairs, brown, red):
    """A Principled Hair BSDF with the pigments of the scene's look; Blender ignores primvars of the whole prim."""
    material = bpy.data.materials.new("pigments")
    nodes, links = material.node_tree.nodes, material.node_tree.links
    hair = nodes.new("ShaderNodeBsdfHairPrincipled")
    hair.parametrization = "MELANIN"
    hair.inputs["Melanin"].default_value = 1 - math.exp(-(brown + red))
    hair.inputs["Melanin Redness"].default_value = red / (brown + red)
    links.new(hair.outputs["BSDF"], nodes["Material Output"].inputs["Surface"])
    hairs.data.materials.append(material)


def lit(watts, room):
    """A light high at the left, a weak one at the right, one behind, of these watts, and a room of this grey."""
    places = ((0.9, -1.1, 0.9), 0.5), ((-1.2, -0.8, 0.2), 0.8), ((-0.6, 1.1, 0.8), 0.4)
    for (place, size), watts in zip(places, watts):
        lamp = bpy.data.objects.new("lamp", bpy.data.lights.new("lamp", "AREA"))
        lamp.data.energy, lamp.data.size = watts, size
        lamp.location = place
        lamp.rotation_euler = Vector(place).to_track_quat("Z", "Y").to_euler()
        bpy.context.collection.objects.link(lamp)
    world = bpy.data.worlds.new("room")
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (room, room, room, 1)
    bpy.context.scene.world = world


def camera(middle, azimuth, distance):
    """A camera that looks at a point from so many degrees to the head's left, a little from above."""
    made = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    made.data.angle = math.radians(24)
    azimuth = math.radians(azimuth)
    made.location = middle + distance * Vector((math.sin(azimuth), -math.cos(azimuth), 0.1))
    made.rotation_euler = (made.location - middle).to_track_quat("Z", "Y").to_euler()
    bpy.context.collection.objects.link(made)
    bpy.context.scene.camera = made


def seen(hairs, head, width=500, height=600):
    """A camera in front, a little to its left, with the hair and the shoulders in the picture."""
    heights = [(thing.matrix_world @ Vector(corner)).z for thing in (hairs, head) for corner in thing.bound_box]
    size, middle = max(heights) - min(heights), Vector((0, 0, 0.5 * (max(heights) + min(heights))))
    camera(middle, 35, 0.56 * size / math.tan(math.radians(12)))
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = width, height


def rendered(path, samples=40):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = samples, True
    scene.cycles_curves.shape = "THICK"
    scene.render.image_settings.file_format = "JPEG"
    scene.render.image_settings.quality = 88
    # Blender has a different current folder.
    scene.render.filepath = os.path.abspath(path)
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    groom, picture, eumelanin, pheomelanin = sys.argv[1:]
    hairs, head = opened(groom)
    dyed(hairs, float(eumelanin), float(pheomelanin))
    lit((90, 20, 90), 0.2)
    seen(hairs, head)
    rendered(picture)
