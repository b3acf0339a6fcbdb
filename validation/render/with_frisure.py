"""The picture of a job by frisure: `with_frisure.py JOB.json`, run by compare.py."""
import os
import resource
import subprocess
import tempfile

import numpy as np

import scene

KEYS = ["size", "bounces", "field_of_view", "room", "lamp", "eumelanin", "axis_ratio", "ball"]


def prepare(job):
    out = os.path.join(tempfile.mkdtemp(), "picture.f32")
    keys = [f"{key}={job[key]}" for key in KEYS]
    keys += [f"{key}={','.join(map(str, job[key]))}" for key in ["eye", "target", "towards"]]

    def picture(seed, samples):
        subprocess.run([job["frisure"], "picture", job["strands"], out, *keys,
                        f"seed={seed}", f"samples={samples}"], check=True, stdout=subprocess.DEVNULL)
        return np.fromfile(out, "<f4").reshape(job["size"], job["size"], 4)

    return picture


# A child process does all the work.
own = scene.cpu
scene.cpu = lambda: own(resource.RUSAGE_CHILDREN)
scene.run(prepare)
