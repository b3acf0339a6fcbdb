"""The input of all renderers: the strands, the ball below them, and a job (a dictionary)."""
import json
import os
import resource
import sys

import numpy as np

LAMP_RADIUS = 0.09  # rad; what the tracer takes for a distant lamp


def read_strands(path):
    """Points (strands, points, 3) and the radius, in metres."""
    with open(path, "rb") as f:
        count, points = np.fromfile(f, "<u4", 2)
        radius = float(np.fromfile(f, "<f4", 1)[0])
        return np.fromfile(f, "<f4").reshape(count, points, 3), radius


def ball(radius=0.09, n=96):
    """Vertices and triangles of the ball below the hair of `wig.rs`."""
    i, j = np.meshgrid(np.arange(n + 1), np.arange(n), indexing="ij")
    theta, phi = i * np.pi / n, j * 2 * np.pi / n
    p = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1)
    i, j = i[:-1].ravel(), j[:-1].ravel()
    k = (j + 1) % n
    a, b, c, d = i * n + j, i * n + k, (i + 1) * n + j, (i + 1) * n + k
    faces = np.concatenate([np.stack([a, c, d], 1)[i < n - 1], np.stack([a, d, b], 1)[i > 0]])
    return (radius * p.reshape(-1, 3)).astype(np.float32), faces.astype(np.uint32)


def absorption(job):
    """Per radius, linear sRGB."""
    return [job["eumelanin"] * s for s in (0.419, 0.697, 1.37)]


def cpu(who=resource.RUSAGE_SELF):
    """CPU seconds so far, user and system."""
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def run(prepare):
    """Main program of a renderer: `prepare(job)` gives `picture(seed, samples) -> (h, w, 4)`.

    Writes one picture per seed; prints CPU seconds per sample, from the difference between
    many samples and one.
    """
    job = json.load(open(sys.argv[1]))
    picture = prepare(job)
    picture(99, 1)  # what happens only once
    seconds = []
    for seed, out in job["pictures"]:
        start = cpu()
        picture(seed + 1000, 1)
        middle = cpu()
        pixels = picture(seed, job["samples"])
        many, one = cpu() - middle, middle - start
        seconds.append((many - one) / (job["samples"] - 1))
        np.save(out, np.asarray(pixels, np.float32))
    json.dump(seconds, open(job["seconds"], "w"))
    sys.stdout.flush()
    os._exit(0)  # some renderers take long to take leave
