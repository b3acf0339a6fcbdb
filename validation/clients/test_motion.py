"""Pixar's USD, the Alembic library and Blender read the steps of a scene as hair that moves, sample by sample."""

import bpy
import numpy as np
import pytest
import usd_validation_nvidia
from alembic3d import Abc, AbcGeom
from pxr import Usd, UsdGeom, UsdValidation

SCENE = """\
name = "Steps"
[hair]
type = "caucasian-wavy"
length = "22 cm"
[wisps]
count = 40
hairs = 200
points = 12
[[step]]
wet = {}
[[step]]
cut = { below = "chin" }
[[step]]
grow = { months = 2, stages = 2 }
"""
SAMPLES = 5
INTERVAL = 0.5


@pytest.fixture(scope="module")
def steps(frisure, tmp_path_factory):
    """A folder with the steps as time samples, and as a file of each."""
    folder = tmp_path_factory.mktemp("steps")
    scene = folder / "scene.toml"
    scene.write_text(SCENE)
    moving = [word for kind in ("abc", "usda", "usdc", "usdz") for word in ("-o", folder / f"moving.{kind}")]
    frisure.run("predict", scene, "--each-step", "--time-samples", "--interval", INTERVAL, *moving)
    frisure.run("predict", scene, "--each-step", "-o", folder / "step.npz")
    return folder


@pytest.fixture(scope="module")
def expected(steps):
    """Positions of hairs and of guides at each step (m, z up)."""
    files = [np.load(steps / f"step-{k:02}.npz") for k in range(SAMPLES)]
    hairs = [f["positions"].reshape(-1, 3) for f in files]
    guides = [f["guide_positions"].reshape(-1, 3) for f in files]
    # Wet hair, cut hair and longer hair lie elsewhere.
    assert all(np.abs(a - b).max() > 1e-3 for a, b in zip(hairs, hairs[1:]))
    return {"hairs": hairs, "guides": guides}


def assert_same_points(found, there):
    """Compares points (m) in any order."""
    assert len(found) == len(there)
    apart = np.linalg.norm(found[:, None] - there[None], axis=2)
    assert max(apart.min(0).max(), apart.min(1).max()) < 1e-6


@pytest.mark.parametrize("kind", ("usda", "usdc", "usdz"))
def test_a_stage_has_every_step(steps, expected, kind):
    path = str(steps / f"moving.{kind}")
    stage = Usd.Stage.Open(path)
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    faults = UsdValidation.ValidationContext(validators).Validate(stage)
    assert [f"{fault.GetName()}: {fault.GetMessage()}" for fault in faults] == []
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (0.0, 24 * INTERVAL * (SAMPLES - 1))
    assert (stage.GetTimeCodesPerSecond(), stage.GetFramesPerSecond()) == (24.0, 24.0)
    for name, points in expected.items():
        curves = UsdGeom.BasisCurves(stage.GetPrimAtPath(f"/groom/{name}"))
        codes = [24 * INTERVAL * k for k in range(SAMPLES)]
        assert curves.GetPointsAttr().GetTimeSamples() == codes
        for code, there in zip(codes, points):
            np.testing.assert_array_equal(np.array(curves.GetPointsAttr().Get(code)), there)
            low, high = np.array(curves.GetExtentAttr().Get(code))
            assert (low <= there.min(0)).all() and (high >= there.max(0)).all()
            assert len(curves.GetWidthsAttr().Get(code)) == len(there)
        # Between two samples hair is half-way.
        middle = np.array(curves.GetPointsAttr().Get(0.5 * codes[1]))
        np.testing.assert_allclose(middle, 0.5 * (points[0] + points[1]), atol=1e-7)


def test_nvidia_has_nothing_to_say_of_steps(steps):
    issues = usd_validation_nvidia.ValidationEngine().validate(str(steps / "moving.usdc")).issues()
    found = {f"{issue.rule.__name__}: {issue.message}" for issue in issues}
    assert {f for f in found if not f.startswith(("UsdAsciiPerformanceChecker", "IndexedPrimvarChecker"))} == set()


def curves_of(archive):
    top = AbcGeom.IXform(archive.getTop(), archive.getTop().getChild(0).getName())
    for i in range(top.getNumChildren()):
        below = AbcGeom.IXform(top, top.getChild(i).getName())
        yield below.getName(), AbcGeom.ICurves(below, below.getChild(0).getName()).getSchema()


def test_an_archive_has_every_step(steps, expected):
    archive = Abc.IArchive(str(steps / "moving.abc"))
    found = dict(curves_of(archive))
    assert "guides" in found and len(found) > 2
    hairs = [[] for _ in range(SAMPLES)]
    for name, schema in found.items():
        assert schema.getNumSamples() == SAMPLES and not schema.isConstant()
        # Unreal takes a groom cache only of strands that keep their number of points.
        assert str(schema.getTopologyVariance()).endswith("kHomogenousTopology"), schema.getTopologyVariance()
        sampling = schema.getTimeSampling()
        assert sampling.getTimeSamplingType().isUniform()
        assert sampling.getTimeSamplingType().getTimePerCycle() == INTERVAL
        for k in range(SAMPLES):
            assert sampling.getSampleTime(k) == INTERVAL * k
            value = schema.getValue(Abc.ISampleSelector(INTERVAL * k))
            points = np.array([list(p) for p in value.getPositions()])
            assert sum(value.getCurvesNumVertices()) == len(points)
            # Centimetres, y up, into metres, z up.
            points = 0.01 * points @ np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
            box = value.getSelfBounds()
            assert not box.isEmpty()
            if name == "guides":
                np.testing.assert_allclose(points, expected["guides"][k], atol=2e-7)
            else:
                hairs[k].append(points)
    for k, of_groups in enumerate(hairs):
        # Hairs are in groups: the same points in another order.
        assert_same_points(np.concatenate(of_groups), expected["hairs"][k])


def points_in_blender():
    """Points of hairs (m, z up) as the modifiers leave them at the frame that is set, in no order."""
    graph = bpy.context.evaluated_depsgraph_get()
    found = []
    for thing in bpy.data.objects:
        if thing.type == "CURVES" and thing.name != "guides":
            curves = thing.evaluated_get(graph).data
            flat = np.empty(3 * len(curves.points), "f4")
            curves.attributes["position"].data.foreach_get("vector", flat)
            matrix = np.array(thing.matrix_world)
            found.append(flat.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3])
    return np.concatenate(found)


@pytest.mark.parametrize("kind", ("abc", "usdc"))
def test_blender_plays_every_step(steps, expected, kind):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = 24
    path = str(steps / f"moving.{kind}")
    if kind == "abc":
        bpy.ops.wm.alembic_import(filepath=path, scale=0.01, set_frame_range=True)
    else:
        bpy.ops.wm.usd_import(filepath=path, set_frame_range=True)
        assert bpy.context.scene.frame_end == 24 * INTERVAL * (SAMPLES - 1)
    for k in range(SAMPLES):
        bpy.context.scene.frame_set(int(24 * INTERVAL * k))
        assert_same_points(points_in_blender(), expected["hairs"][k])


def test_the_first_step_is_read_where_one_is(steps, expected, hair_of):
    for kind in ("abc", "usda", "usdc", "usdz"):
        points, _, _ = hair_of(steps / f"moving.{kind}")
        np.testing.assert_allclose(points, expected["hairs"][0], atol=2e-7)
