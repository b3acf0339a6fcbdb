#!/usr/bin/env python3
"""Makes the picture of docs/blender.md: hair that the extension grew on a mesh, in Cycles.

    PYTHON-WITH-BPY blender/picture.py out/frisure-blender.zip blender.png
"""

import os
import sys
import tempfile
from pathlib import Path

os.environ["BLENDER_USER_RESOURCES"] = tempfile.mkdtemp(prefix="frisure-blender-")

import bpy
from mathutils import Vector

HEAD = Path(__file__).resolve().parents[1] / "scenes" / "heads" / "female-head.obj"


def main() -> None:
    extension, picture = (str(Path(argument).resolve()) for argument in sys.argv[1:])
    bpy.ops.extensions.package_install_files(filepath=extension, repo="user_default", enable_on_install=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="bl_ext.user_default.frisure")
    bpy.ops.wm.obj_import(filepath=str(HEAD))
    head = bpy.context.selected_objects[0]
    bpy.context.view_layer.objects.active = head
    bpy.ops.object.frisure_add(hair_type="caucasian-curly", length=0.2, guides=250, hairs=40_000)
    for face in head.data.polygons:
        face.use_smooth = True
    skin = bpy.data.materials.new("skin")
    skin.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.55, 0.36, 0.27, 1.0)
    head.data.materials.clear()
    head.data.materials.append(skin)
    corners = [head.matrix_world @ Vector(corner) for corner in head.bound_box]
    middle = sum(corners, Vector()) / 8
    middle.z = max(corner.z for corner in corners) - 0.13

    def aimed(name, data, place):
        thing = bpy.data.objects.new(name, data)
        bpy.context.scene.collection.objects.link(thing)
        thing.location = middle + Vector(place)
        thing.rotation_euler = (middle - thing.location).to_track_quat("-Z", "Y").to_euler()
        return thing

    for place, watts in (((-0.8, -1.0, 0.8), 30.0), ((1.0, -0.3, 0.3), 10.0), ((0.5, 1.0, 0.8), 25.0)):
        light = bpy.data.lights.new("light", "AREA")
        light.energy, light.size = watts, 0.5
        aimed("light", light, place)
    camera = bpy.data.cameras.new("camera")
    camera.lens = 85.0
    scene = bpy.context.scene
    scene.camera = aimed("camera", camera, (0.42, -0.85, 0.02))
    scene.world = bpy.data.worlds.new("world")
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.3, 0.32, 0.35, 1.0)
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 64, True
    scene.cycles_curves.shape = "THICK"
    scene.render.resolution_x, scene.render.resolution_y = 420, 500
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main()
