"""The picture of a job by Mitsuba 3: `with_mitsuba.py JOB.json`, run by compare.py."""
import math
import os
import tempfile

import mitsuba as mi
import numpy as np

mi.set_variant(os.environ.get("MITSUBA_VARIANT", "llvm_ad_rgb"))
import scene  # noqa: E402


def control_points(points):
    """Each segment of the Catmull-Rom splines as a uniform cubic B-spline of its own: the same curve."""
    ends = np.concatenate([2 * points[:, :1] - points[:, 1:2], points, 2 * points[:, -1:] - points[:, -2:-1]], 1)
    a, b, c, d = (ends[:, k:k + points.shape[1] - 1].astype(np.float64) for k in range(4))
    # Bézier points of the segment, then those of the B-spline.
    q0, q1, q2, q3 = b, b + (c - a) / 6, c - (d - b) / 6, c
    return np.stack([6 * q0 - 7 * q1 + 2 * q2, 2 * q1 - q2, 2 * q2 - q1, 2 * q1 - 7 * q2 + 6 * q3], 2).reshape(-1, 4, 3)


def curves(strands):
    """Writes the strands in Mitsuba's format to a file beside them."""
    path = strands + ".txt"
    if os.path.exists(path):
        return path
    points, radius = scene.read_strands(strands)
    with open(path, "w") as f:
        for curve in control_points(points):
            (a, b, c), (d, e, g), (h, i, j), (k, l, m) = curve.tolist()
            f.write(f"{a:.8f} {b:.8f} {c:.8f} {radius}\n{d:.8f} {e:.8f} {g:.8f} {radius}\n"
                    f"{h:.8f} {i:.8f} {j:.8f} {radius}\n{k:.8f} {l:.8f} {m:.8f} {radius}\n\n")
    return path


def light(job):
    if job["lamp"] == 0:
        return {"type": "constant", "radiance": {"type": "rgb", "value": [job["room"]] * 3}}
    towards = np.array(job["towards"], float)
    towards /= np.linalg.norm(towards)
    far = 50.0
    radiance = job["lamp"] / (math.pi * math.sin(scene.LAMP_RADIUS) ** 2)
    place = mi.ScalarTransform4f().look_at((far * towards).tolist(), [0, 0, 0], [0.3, 0.5, 0.8])
    place = place @ mi.ScalarTransform4f().scale(far * math.tan(scene.LAMP_RADIUS))
    return {"type": "disk", "to_world": place,
            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": [radiance] * 3}}}


def ball(reflectance):
    vertices, faces = scene.ball()
    mesh = mi.Mesh("ball", len(vertices), len(faces), has_vertex_normals=False)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = vertices.ravel()
    parameters["faces"] = faces.ravel()
    parameters.update()
    path = tempfile.mktemp(suffix=".ply")
    mesh.write_ply(path)
    colour = {"type": "rgb", "value": [reflectance] * 3}
    return {"type": "ply", "filename": path,
            "bsdf": {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": colour}}}


def prepare(job):
    hair = {"type": "hair", "longitudinal_roughness": 0.3, "azimuthal_roughness": 0.3,
            "scale_tilt": math.degrees(0.035), "int_ior": 1.55, "ext_ior": 1.0,
            "sigma_a": {"type": "rgb", "value": scene.absorption(job)}}
    camera = {"type": "perspective", "fov": job["field_of_view"], "fov_axis": "y",
              "near_clip": 0.01, "far_clip": 100.0,
              "to_world": mi.ScalarTransform4f().look_at(job["eye"], job["target"], [0, 0, 1]),
              "film": {"type": "hdrfilm", "width": job["size"], "height": job["size"],
                       "pixel_format": "rgba", "rfilter": {"type": "box"}},
              "sampler": {"type": "independent"}}
    world = mi.load_dict({
        "type": "scene", "sensor": camera, "light": light(job), "ball": ball(job["ball"]),
        # The first segment of a path starts at the camera.
        "integrator": {"type": "path", "max_depth": job["bounces"] + 1, "hide_emitters": True},
        "curves": {"type": "bsplinecurve", "filename": curves(job["strands"]), "bsdf": hair}})
    return lambda seed, samples: np.array(mi.render(world, spp=samples, seed=seed))


scene.run(prepare)
