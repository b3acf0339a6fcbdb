"""The picture of a job by Blender's Cycles: `with_cycles.py JOB.json`, run by compare.py."""
import math
import os
import tempfile

import bpy
import numpy as np
from mathutils import Vector

import scene


def material(name, node_type):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    node, out = tree.nodes.new(node_type), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(node.outputs[0], out.inputs["Surface"])
    return made, node


def hair_material(job):
    made, node = material("hair", "ShaderNodeBsdfHairPrincipled")
    node.model = job.get("cycles_model", "CHIANG")
    node.parametrization = "ABSORPTION"
    # Sockets hidden by another option have no key, so the search is by name over all.
    inputs = {socket.name: socket for socket in node.inputs}
    inputs["Absorption Coefficient"].default_value = scene.absorption(job)
    for name, value in [("Roughness", 0.3), ("Radial Roughness", 0.3), ("Coat", 0), ("IOR", 1.55),
                        ("Offset", 0.035), ("Random Color", 0), ("Random Roughness", 0),
                        ("Aspect Ratio", job["axis_ratio"])]:
        inputs[name].default_value = value
    return made


def put(name, data, made):
    thing = bpy.data.objects.new(name, data)
    data.materials.append(made)
    bpy.context.scene.collection.objects.link(thing)


def hair(job):
    points, radius = scene.read_strands(job["strands"])
    curves = bpy.data.hair_curves.new("hair")
    curves.add_curves([points.shape[1]] * len(points))
    curves.position_data.foreach_set("vector", points.ravel())
    widths = curves.attributes.get("radius") or curves.attributes.new("radius", "FLOAT", "POINT")
    widths.data.foreach_set("value", np.full(points.shape[0] * points.shape[1], radius, np.float32))
    put("hair", curves, hair_material(job))


def ball(job):
    vertices, faces = scene.ball()
    mesh = bpy.data.meshes.new("ball")
    mesh.from_pydata(vertices.tolist(), [], faces.tolist())
    made, node = material("ball", "ShaderNodeBsdfDiffuse")
    node.inputs["Color"].default_value = [job["ball"]] * 3 + [1]
    put("ball", mesh, made)


def light(job, into):
    world = bpy.data.worlds.new("room")
    into.world = world
    world.use_nodes = True
    back = next(n for n in world.node_tree.nodes if n.type == "BACKGROUND")
    back.inputs["Color"].default_value = (1, 1, 1, 1)
    back.inputs["Strength"].default_value = job["room"]
    if job["lamp"] > 0:
        sun = bpy.data.lights.new("sun", "SUN")
        sun.energy, sun.angle = job["lamp"], 2 * scene.LAMP_RADIUS
        thing = bpy.data.objects.new("sun", sun)
        thing.rotation_euler = Vector(job["towards"]).to_track_quat("Z", "Y").to_euler()
        into.collection.objects.link(thing)


def camera(job, into):
    data = bpy.data.cameras.new("camera")
    data.angle, data.clip_start = math.radians(job["field_of_view"]), 0.01
    thing = bpy.data.objects.new("camera", data)
    eye, target = Vector(job["eye"]), Vector(job["target"])
    thing.location = eye
    thing.rotation_euler = (target - eye).to_track_quat("-Z", "Y").to_euler()
    into.collection.objects.link(thing)
    into.camera = thing


def settings(job, into):
    render, cycles = into.render, into.cycles
    render.engine, cycles.device = "CYCLES", "CPU"
    into.cycles_curves.shape = "THICK"
    render.resolution_x = render.resolution_y = job["size"]
    render.resolution_percentage = 100
    render.film_transparent = True
    render.use_persistent_data = True
    cycles.pixel_filter_type = "BOX"
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    # Cycles does not count direct light.
    deepest = job["bounces"] - 1
    cycles.max_bounces = cycles.diffuse_bounces = deepest
    cycles.glossy_bounces = cycles.transmission_bounces = deepest
    files = render.image_settings
    files.file_format, files.color_mode, files.color_depth = "OPEN_EXR", "RGBA", "32"


def prepare(job):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    into = bpy.context.scene
    settings(job, into)
    hair(job)
    ball(job)
    light(job, into)
    camera(job, into)
    out = os.path.join(tempfile.mkdtemp(), "picture.exr")

    def picture(seed, samples):
        into.cycles.seed, into.cycles.samples = seed, samples
        into.render.filepath = out
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(out)
        pixels = np.empty(4 * job["size"] ** 2, np.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
        return pixels.reshape(job["size"], job["size"], 4)[::-1]

    return picture


scene.run(prepare)
