"""Shared code of the peers: the hairs, processor time, and reports of runs."""
import json
import os
import sys
import time

# One thread for all libraries, set before they are loaded.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np  # noqa: E402

# Distance of the tip from the true one, over the length, beyond which the hair is in another equilibrium.
ELSEWHERE = 0.1


class Hair:
    """One hair in units of its length, of the weight per length and of its time of fall: L = w = g = 1."""

    def __init__(self, case):
        hair, truth = case["hair"], case["truth"]
        self.length = hair["length"]
        scale = hair["weight_per_length"] * self.length**3
        # EI1, EI2, GJ over w L^3: the first is 1/Gamma.
        self.stiffness = np.array(hair["stiffness"]) / scale
        self.natural = np.array(hair["natural"]) * self.length
        # Directors d1, d2, t in columns.
        self.root = np.array(hair["root"]).T
        self.tip = np.array(truth["tip"]) / self.length

    def error(self, tip):
        """Distance (m) of a tip, in lengths, from the true one."""
        return float(np.linalg.norm(np.asarray(tip) - self.tip)) * self.length

    def natural_frames(self, s):
        """Positions and frames of the natural shape, a helix, at arc lengths s."""
        s = np.asarray(s, dtype=float)
        w = np.linalg.norm(self.natural)
        k = cross_matrix(self.natural / w)
        k2 = k @ k
        a, b = np.sin(w * s)[:, None, None], np.cos(w * s)[:, None, None]
        frames = np.eye(3) + a * k + (1 - b) * k2
        moved = s[:, None, None] * np.eye(3) + (1 - b) / w * k + (s[:, None, None] - a / w) * k2
        return moved[:, :, 2] @ self.root.T, self.root @ frames


def cross_matrix(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def read_hairs(path):
    with open(path, encoding="utf8") as file:
        cases = json.load(file)
    return Hair(cases["one"]), [Hair(c) for c in cases["many"] if c["truth"]]


def cpu(work):
    """The result of `work`, and its processor time (s)."""
    start = time.process_time()
    found = work()
    return found, time.process_time() - start


def summary(setting, one, many, length):
    """A point of a peer's table. `one` and each of `many` is (error in m or None if it failed, seconds)."""
    errors = np.array([np.inf if e is None or not np.isfinite(e) else e for e, _ in many])
    quantile = lambda q: float(np.sort(errors)[int(round(q * (len(errors) - 1)))])  # noqa: E731
    finite = np.isfinite(errors)
    return {
        "setting": setting,
        "error_one": one[0],
        "seconds_one": one[1],
        "hairs": len(many),
        "failed": int((~finite).sum()),
        "elsewhere": int((finite & (errors > ELSEWHERE * length)).sum()),
        "median": quantile(0.5),
        "p95": quantile(0.95),
        "largest": quantile(1.0),
        "seconds_many": float(np.mean([t for _, t in many])),
    }


def reported(point):
    """Prints one line about a point, and returns the point."""
    mm = lambda x: "failed" if x is None or not np.isfinite(x) else f"{1e3 * x:.4f} mm"  # noqa: E731
    print(
        f"  {point['setting']}: one {mm(point['error_one'])} in {1e3 * point['seconds_one']:.2f} ms; of {point['hairs']}"
        f" {point['failed']} failed, {point['elsewhere']} elsewhere, median {mm(point['median'])},"
        f" p95 {mm(point['p95'])}, {1e3 * point['seconds_many']:.2f} ms each",
        file=sys.stderr,
        flush=True,
    )
    return point


class Division:
    """A hair divided so that joints are in the middles of the pieces that they represent, which makes a chain of segments exact to second
    order: the first vertex is half an element before the root, where the first segment is clamped, and the last segment has its
    middle at the tip."""

    # Lagrange's weights of the last four vertices at the middle of the last segment.
    TIP = np.array([1.0, -5.0, 15.0, 5.0]) / 16.0

    def __init__(self, hair, elements):
        self.h = 1.0 / elements
        self.points, _ = hair.natural_frames((np.arange(elements + 2) - 0.5) * self.h)
        # Frames in the middles of segments.
        _, self.frames = hair.natural_frames(np.arange(elements + 1) * self.h)
        self.chord = np.linalg.norm(np.diff(self.points, axis=0), axis=1).mean()
        # Half of the last segment is hair: its weight is a quarter of the segment before the tip.
        self.mass = np.full(elements + 2, self.h)
        self.mass[-2:] = 0.875 * self.h, 0.125 * self.h

    @classmethod
    def tip(cls, points):
        return cls.TIP @ points[-4:]


def come_to_rest(hair, path):
    """The final error (m) of a hair in motion, or None if it does not converge, and the processor time after which its tip stays
    within 1.1 times that error of the true one. `path` has its tips and the seconds spent on each. The search ends when the
    tip hardly moves."""
    times, tips, spent = [], [], 0.0
    for tip, seconds in path:
        spent += seconds
        if not np.all(np.isfinite(tip)) or np.abs(tip).max() > 2.0:
            return None, spent
        times.append(spent)
        tips.append(tip)
        if at_rest(tips):
            break
    else:
        if moved(tips[-len(tips) // 10 :]) > 1e-3:
            return None, spent
    error = hair.error(tips[-1])
    far = [k for k, tip in enumerate(tips) if hair.error(tip) > 1.1 * error]
    return error, times[far[-1] + 1] if far else times[0]


def at_rest(tips):
    return len(tips) > 20 and moved(tips[-15:]) < 1e-5


def moved(tips):
    return float(np.linalg.norm(np.ptp(tips, axis=0)))


def write(path, peer, version, points):
    # JSON has no infinity.
    clean = lambda v: None if isinstance(v, float) and not np.isfinite(v) else v  # noqa: E731
    points = [{k: clean(v) for k, v in p.items()} for p in points]
    with open(path, "w", encoding="utf8") as file:
        json.dump({"peer": peer, "version": version, "points": points}, file, indent=1)
