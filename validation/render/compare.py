#!/usr/bin/env python3
"""Compares frisure's path tracer with Mitsuba 3 and Blender's Cycles: see README.md.

usage: compare.py OUT.md [--with frisure,mitsuba,cycles] [--cases white,...] [--size N] [--samples N]
                  [--strands N] [--points N] [--style curly] [--rounds N] [--bounces 8,100] [--light room,lamp]
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
CASES = {"white": 0.0, "blond": 0.3, "brown": 1.3, "black": 8.0}
BLOCK = 16


def arguments():
    p = argparse.ArgumentParser()
    p.add_argument("out")
    p.add_argument("--renderers", default="frisure,mitsuba,cycles")
    p.add_argument("--cases", default=",".join(CASES))
    p.add_argument("--bounces", default="8,100")
    p.add_argument("--light", default="room")
    p.add_argument("--style", default="curly")
    for name, default in [("size", 256), ("samples", 16), ("strands", 100_000), ("points", 16), ("rounds", 2)]:
        p.add_argument("--" + name, type=int, default=default)
    p.add_argument("--axis-ratio", type=float, default=1.0)
    p.add_argument("--cycles-model", default="CHIANG")
    return p.parse_args()


def program():
    path = os.environ.get("FRISURE_TRACE_STRANDS")
    if not path or not os.path.exists(path):
        sys.exit("set FRISURE_TRACE_STRANDS to the built example: "
                 "cargo build --release -p frisure-render --example trace_strands")
    return os.path.abspath(path)


def job(args, case, bounces, light, folder):
    lamp = light == "lamp"
    return {
        "frisure": program(), "strands": os.path.join(folder, "wig.strands"),
        "size": args.size, "samples": args.samples, "bounces": bounces, "eumelanin": CASES[case],
        "axis_ratio": args.axis_ratio, "cycles_model": args.cycles_model,
        "eye": [0.45, 0.78, 0.2], "target": [0.0, 0.0, -0.03], "field_of_view": 20.0,
        "room": 0.0 if lamp else 1.0, "lamp": 3.14159265 if lamp else 0.0, "towards": [0.8, 0.3, 0.6],
        # A white ball in a white room must be invisible; in other cases it is out of the picture.
        "ball": 1.0 if case == "white" and not lamp else 0.3,
    }


def render(renderer, asked, seed, folder):
    """One picture and its CPU seconds per sample."""
    out, seconds = os.path.join(folder, "out.npy"), os.path.join(folder, "seconds.json")
    path = os.path.join(folder, "job.json")
    json.dump({**asked, "pictures": [[seed, out]], "seconds": seconds}, open(path, "w"))
    script = os.path.join(HERE, f"with_{renderer}.py")
    done = subprocess.run([sys.executable, script, path], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    if done.returncode != 0:
        sys.exit(f"{renderer} failed:\n{done.stderr.decode()[-3000:]}")
    return np.load(out).astype(np.float64), json.load(open(seconds))[0]


def blocks(picture):
    n = picture.shape[0] // BLOCK
    return picture[:n * BLOCK, :n * BLOCK].reshape(n, BLOCK, n, BLOCK, 4).sum((1, 3))


def measure(pictures, seconds, samples):
    """Mean by channel, its standard error, variance of one pixel at these samples, cost."""
    both = np.array(pictures)
    mean = both.mean(0)
    hair = mean[..., 3] > 0.99
    light = mean[..., :3].sum((0, 1)) / mean[..., 3].sum()
    each = both[..., :3].sum((1, 2)) / both[..., 3].sum((1, 2))[:, None]
    variance = both[:, hair, :3].var(0, ddof=1).mean() if len(both) > 1 else float("nan")
    cost = float(np.median(seconds))
    return {"light": light, "error": (each.std(0, ddof=1) / len(both) ** 0.5 / light).max(),
            "variance": variance, "seconds": cost, "to_noise": variance * cost * samples, "mean": mean}


def difference(a, b):
    """Root mean square of the relative difference of blocks that are mostly hair."""
    x, y = blocks(a["mean"]), blocks(b["mean"])
    full = y[..., 3] > 0.9 * BLOCK ** 2
    x, y = x[full][:, :3], y[full][:, :3]
    return float(np.sqrt((((x - y) / y.mean(0)) ** 2).mean()))


def rows(results, case, bounces, light):
    ours = results["frisure"]
    for name, r in results.items():
        ratio = ours["light"] / r["light"] - 1
        light_text = " / ".join(f"{v:.4f}" for v in r["light"])
        ratio_text = " / ".join(f"{100 * v:+.2f}" for v in ratio)
        yield (f"| {light}, {case}, {bounces} | {name} | {light_text} | {ratio_text} | {100 * r['error']:.2f} | "
               f"{100 * difference(ours, r):.1f} | {r['seconds']:.2f} | {r['seconds'] / ours['seconds']:.2f} | "
               f"{r['to_noise'] / ours['to_noise']:.2f} |")


def main():
    args = arguments()
    renderers = args.renderers.split(",")
    if renderers[0] != "frisure":
        sys.exit("the first renderer must be frisure: others are compared with it")
    lines = [f"{args.strands} {args.style} strands of {args.points} points, {args.size}², {args.samples} samples, "
             f"{args.rounds} rounds, axis ratio {args.axis_ratio}, Cycles {args.cycles_model}", "",
             "| light, hair, bounces | renderer | mean light R / G / B | frisure's differs (%) | error of the mean (%) | "
             "blocks (%) | CPU s per sample | × frisure's | CPU s to equal noise × frisure's |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    with tempfile.TemporaryDirectory() as folder:
        wig = [program(), "wig", args.style, str(args.strands), str(args.points), os.path.join(folder, "wig.strands")]
        subprocess.run(wig, check=True)
        for light in args.light.split(","):
            for case in args.cases.split(","):
                for bounces in map(int, args.bounces.split(",")):
                    asked = job(args, case, bounces, light, folder)
                    taken = {name: ([], []) for name in renderers}
                    for seed in range(1, args.rounds + 1):
                        for name in renderers:
                            picture, seconds = render(name, asked, seed, folder)
                            taken[name][0].append(picture)
                            taken[name][1].append(seconds)
                    results = {name: measure(*t, args.samples) for name, t in taken.items()}
                    for row in rows(results, case, bounces, light):
                        print(row, flush=True)
                        lines.append(row)
                    with open(args.out, "w") as f:
                        f.write("\n".join(lines) + "\n")


main()
