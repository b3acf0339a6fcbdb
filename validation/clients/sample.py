"""A groom with all attributes, as arrays, for the tests of formats."""

import numpy as np

STRANDS, POINTS = 12, 16
REGIONS = ["fringe", "top", "crown", "sides", "back", "nape"]


def positions(strands=STRANDS, points=POINTS):
    """Points of hanging curls (m, z up)."""
    turn = 2.399 * np.arange(strands)[:, None]
    s = np.linspace(0, 0.2, points)[None, :]
    r = 0.08 * np.sqrt((np.arange(strands)[:, None] + 1) / strands)
    x = r * np.cos(turn) + 0.006 * np.sin(60 * s + turn)
    y = r * np.sin(turn) - 0.3 * s**2
    z = 0.1 - 8 * r**2 - s + 0.004 * np.cos(60 * s)
    return np.stack(np.broadcast_arrays(x, y, z), -1).astype("f4")


def arrays(strands=STRANDS, points=POINTS):
    """All arrays of a `.npz`."""
    i = np.arange(strands, dtype="u4")
    along = np.linspace(0, 1, strands * points, dtype="f4").reshape(strands, points)
    hairs = positions(strands, points)
    directions = np.tile(np.array([0, 0.6, -0.8], "f4"), (strands, points, 1))
    return {
        "positions": hairs,
        "radii": (4e-5 - 1e-5 * along).astype("f4"),
        "guide": i % 4,
        "closest_guides": np.stack([i % 4, (i + 1) % 4, (i + 2) % 4], -1),
        "guide_weights": np.tile(np.array([0.5, 0.3, 0.2], "f4"), (strands, 1)),
        "id": i,
        "group": i % 3 * 2,
        "root_uv": np.stack([i / strands, 1 - i / strands], -1).astype("f4"),
        "axis_ratio": np.linspace(1, 2, strands, dtype="f4"),
        "color": np.stack([along, along**2, 0.5 * along], -1),
        "wetness": along,
        "d1": directions,
        "natural_strain": np.stack([100 * along, -along, 7 + along], -1),
        "guide_positions": hairs[:4],
        "guide_radii": np.full((4, points), 4e-5, "f4"),
        "guide_guide": i[:4],
        "guide_group": i[:4] % 3 * 2,
        "metres": np.float64(1),
        "up": np.array("z"),
        "name": np.array("sample"),
        "hair_color": np.array([0.2, 0.1, 0.05], "f4"),
    }


def groups():
    """The group of each hair in files for Unreal: that of its guide with the largest weight."""
    all_arrays = arrays()
    return all_arrays["guide_group"][all_arrays["guide"]]


def y_up(points, unit=1.0):
    """Points (m, z up) in the axes of a file with y up."""
    return np.stack([points[..., 0], points[..., 2], -points[..., 1]], -1) / unit
