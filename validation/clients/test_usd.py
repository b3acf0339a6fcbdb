"""Pixar's USD library opens and validates files of frisure, and frisure reads its files."""

import subprocess
import sys

import numpy as np
import pytest
import usd_validation_nvidia
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, UsdUtils, UsdValidation, Vt

KINDS = ("usda", "usdc")


def complaints(path):
    """What NVIDIA's validator says, less what is as it should be, each once."""
    issues = usd_validation_nvidia.ValidationEngine().validate(str(path)).issues()
    found = {f"{issue.rule.__name__}: {issue.message}" for issue in issues}
    # Text is text; values of which less than half are the same are larger with indices.
    return {f for f in found if not f.startswith(("UsdAsciiPerformanceChecker", "IndexedPrimvarChecker"))}


def faults(stage):
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) > 20
    found = UsdValidation.ValidationContext(validators).Validate(stage)
    return [f"{fault.GetName()}: {fault.GetMessage()}" for fault in found]


def test_the_validators_find_faults():
    stage = Usd.Stage.CreateInMemory()
    UsdShade.Shader.Define(stage, "/a")
    assert faults(stage)


@pytest.mark.parametrize("kind", KINDS)
def test_stages_are_valid(head, kind):
    stage = Usd.Stage.Open(str(head / f"head.{kind}"))
    assert faults(stage) == []
    assert str(stage.GetDefaultPrim().GetPath()) == "/groom"
    assert Usd.ModelAPI(stage.GetDefaultPrim()).GetKind() == "component"
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    assert UsdGeom.GetStageUpAxis(stage) == "Z"


@pytest.mark.parametrize("kind", KINDS)
def test_nvidia_has_nothing_to_say(head, kind):
    assert complaints(head / f"head.{kind}") == set()


@pytest.mark.parametrize("kind", KINDS)
def test_values_of_which_half_are_the_same_are_written_once(head, kind):
    stage = Usd.Stage.Open(str(head / f"head.{kind}"))
    for path in ("/groom/hairs", "/groom/guides"):
        for primvar in UsdGeom.PrimvarsAPI(stage.GetPrimAtPath(path)).GetPrimvars():
            # Programs that read integers do not know indices.
            if "float" not in str(primvar.GetTypeName()) or primvar.GetInterpolation() == "constant":
                continue
            all_values = np.array(primvar.ComputeFlattened())
            distinct = np.unique(all_values.reshape(len(all_values), -1), axis=0)
            assert primvar.IsIndexed() == (2 * len(distinct) <= len(all_values)), primvar.GetName()


def test_text_and_binary_are_the_same_layer(head):
    text, binary = (Sdf.Layer.FindOrOpen(str(head / f"head.{kind}")) for kind in KINDS)
    assert text.ExportToString() == binary.ExportToString()


def test_nothing_is_said_when_opened(head):
    for kind in KINDS:
        code = "import sys; from pxr import Usd; s = Usd.Stage.Open(sys.argv[1]); list(s.TraverseAll())"
        words = [sys.executable, "-c", code, str(head / f"head.{kind}")]
        done = subprocess.run(words, capture_output=True, text=True, check=True)
        assert done.stdout + done.stderr == ""


@pytest.mark.parametrize("kind", KINDS)
def test_hairs_are_those_of_other_formats(head, kind, hair_of):
    stage = Usd.Stage.Open(str(head / f"head.{kind}"))
    hairs = UsdGeom.BasisCurves.Get(stage, "/groom/hairs")
    points, widths = np.array(hairs.GetPointsAttr().Get()), np.array(hairs.GetWidthsAttr().Get())
    positions, thickness, counts = hair_of(head / "head.hair")
    assert np.array_equal(hairs.GetCurveVertexCountsAttr().Get(), counts)
    assert np.abs(points - positions).max() < 2e-7
    assert np.abs(widths - thickness).max() < 1e-9
    low, high = UsdGeom.Boundable.ComputeExtentFromPlugins(hairs, Usd.TimeCode.Default())
    assert np.allclose(hairs.GetExtentAttr().Get(), [low, high], atol=1e-6)
    assert hairs.GetWidthsInterpolation() == "vertex"
    assert (hairs.GetTypeAttr().Get(), hairs.GetBasisAttr().Get()) == ("cubic", "catmullRom")


@pytest.mark.parametrize("kind", KINDS)
def test_primvars_have_as_many_values_as_they_need(head, kind):
    stage = Usd.Stage.Open(str(head / f"head.{kind}"))
    for name in ("hairs", "guides"):
        curves = UsdGeom.BasisCurves.Get(stage, f"/groom/{name}")
        strands, points = len(curves.GetCurveVertexCountsAttr().Get()), len(curves.GetPointsAttr().Get())
        found = {}
        for primvar in UsdGeom.PrimvarsAPI(curves).GetPrimvarsWithValues():
            each = {"constant": 1, "uniform": strands, "vertex": points}[primvar.GetInterpolation()]
            value = primvar.ComputeFlattened()
            found[primvar.GetPrimvarName()] = value
            if hasattr(value, "__len__"):
                assert len(value) == each * primvar.GetElementSize(), primvar.GetName()
        assert found["groom_guide"] == (name == "guides")
        assert "frisure:natural_strain" in found and "frisure:d1" in found
    hairs = UsdGeom.PrimvarsAPI(stage.GetPrimAtPath("/groom/hairs"))
    assert sorted(hairs.GetPrimvar("groom_id").Get()) == list(range(600))
    weights = np.array(hairs.GetPrimvar("groom_guide_weights").ComputeFlattened())
    assert np.allclose(weights.sum(axis=1), 1.0, atol=1e-5)
    uv = np.array(hairs.GetPrimvar("surface_uv_coordinate").Get())
    assert uv.min() >= 0.0 and uv.max() <= 1.0


def test_guides_guide_and_hair_and_skin_have_materials(head):
    stage = Usd.Stage.Open(str(head / "head.usdc"))
    purpose = {n: UsdGeom.Imageable.Get(stage, f"/groom/{n}").ComputePurpose() for n in ("hairs", "guides", "head")}
    assert purpose == {"hairs": "default", "guides": "guide", "head": "default"}
    for prim, material in (("hairs", "hair"), ("head", "skin")):
        bound, _ = UsdShade.MaterialBindingAPI(stage.GetPrimAtPath(f"/groom/{prim}")).ComputeBoundMaterial()
        assert bound.GetPath() == f"/groom/materials/{material}"
        shader, _, _ = bound.ComputeSurfaceSource()
        assert shader.GetShaderId() == "UsdPreviewSurface"


def test_other_units_and_axes(head, frisure, tmp_path):
    out = tmp_path / "cm.usda"
    frisure.convert(head / "head.usdc", out, unit="cm", up="y")
    stage = Usd.Stage.Open(str(out))
    assert (UsdGeom.GetStageMetersPerUnit(stage), UsdGeom.GetStageUpAxis(stage)) == (0.01, "Y")
    assert faults(stage) == []
    whole = Usd.Stage.Open(str(head / "head.usdc"))
    old = UsdGeom.BasisCurves.Get(whole, "/groom/hairs")
    new = UsdGeom.BasisCurves.Get(stage, "/groom/hairs")
    x, y, z = np.array(old.GetPointsAttr().Get()).T
    assert np.allclose(np.array(new.GetPointsAttr().Get()).T, np.array([x, z, -y]) * 100, atol=1e-4)


def test_a_groom_goes_round_unchanged(head, frisure, tmp_path):
    # Text to binary to text gives the same bytes, except for the head's normals, which follow from its rounded points.
    binary, text = tmp_path / "a.usdc", tmp_path / "b.usda"
    frisure.convert(head / "head.usda", binary)
    frisure.convert(binary, text)
    hair = [path.read_text().split('def Mesh "head"')[0] for path in (text, head / "head.usda")]
    assert hair[0] == hair[1]


@pytest.mark.parametrize("version", ["0.4.0", "0.5.0", "0.6.0", "0.7.0", "0.8.0", "0.9.0", "0.10.0", "0.12.0", "0.13.0"])
def test_every_version_of_binary_files_is_read(head, version, hair_of, tmp_path):
    out = tmp_path / f"v{version}.usdc"
    code = """if True:
        import sys
        from pxr import Sdf
        layer = Sdf.Layer.CreateNew(sys.argv[2])
        layer.TransferContent(Sdf.Layer.FindOrOpen(sys.argv[1]))
        layer.Save()"""
    words = [sys.executable, "-c", code, str(head / "head.usda"), str(out)]
    subprocess.run(words, check=True, env={"USD_WRITE_NEW_USDC_FILES_AS_VERSION": version})
    assert ".".join(map(str, out.read_bytes()[8:11])) == version
    for told, found in zip(hair_of(head / "head.hair"), hair_of(out)):
        assert np.allclose(told, found, atol=2e-7)


@pytest.mark.parametrize("kind", KINDS)
def test_what_the_library_writes_is_read(kind, hair_of, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / f"made.{kind}"))
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    UsdGeom.SetStageUpAxis(stage, "Y")
    folder = UsdGeom.Xform.Define(stage, "/set/person")
    folder.AddTranslateOp().Set(Gf.Vec3d(0, 150, 0))
    folder.AddOrientOp().Set(Gf.Quatf(0.5**0.5, Gf.Vec3f(0, 0.5**0.5, 0)))
    folder.AddScaleOp().Set(Gf.Vec3f(2))
    folder.GetPrim().SetCustomDataByKey("pipeline:step", {"a": [1.5, 2.5], "b": "c"})
    curves = UsdGeom.BasisCurves.Define(stage, "/set/person/hair")
    curves.CreateTypeAttr("cubic")
    curves.CreateBasisAttr("bspline")
    curves.CreateWrapAttr("pinned")
    points = [(i, 10 * j, j * j) for i in range(40) for j in range(5)]
    curves.CreatePointsAttr().Set(Vt.Vec3fArray([Gf.Vec3f(*p) for p in points]), 1)
    curves.CreateCurveVertexCountsAttr([5] * 40)
    curves.CreateWidthsAttr([0.006, 0.002] * 20)
    curves.SetWidthsInterpolation("uniform")
    positions, thickness, counts = hair_of(tmp_path / f"made.{kind}") if stage.GetRootLayer().Save() else None
    assert list(counts) == [5] * 40
    # The ends of pinned B-splines are their vertices; then a quarter turn about y, a factor of two, z up.
    x, y, z = np.array(points, float).T
    world = np.array([2 * z, 2 * y + 150, -2 * x])
    inside = np.array([world[0], -world[2], world[1]]).T * 0.01
    assert np.abs(positions[::5] - inside[::5]).max() < 1e-6
    assert np.abs(positions[4::5] - inside[4::5]).max() < 1e-6
    middle = (inside[1::5] + 4 * inside[2::5] + inside[3::5]) / 6
    assert np.abs(positions[2::5] - middle).max() < 1e-6
    assert np.allclose(thickness.reshape(40, 5)[:2], [[1.2e-4] * 5, [4e-5] * 5], atol=1e-9)


def test_packages_are_read(head, hair_of, tmp_path):
    out = tmp_path / "head.usdz"
    assert UsdUtils.CreateNewUsdzPackage(str(head / "head.usdc"), str(out))
    for told, found in zip(hair_of(head / "head.hair"), hair_of(out)):
        assert np.allclose(told, found, atol=2e-7)


def test_packages_are_opened(head, frisure, tmp_path):
    out = tmp_path / "head.usdz"
    frisure.convert(head / "head.usdc", out)
    stage = Usd.Stage.Open(str(out))
    assert faults(stage) == []
    assert len(UsdGeom.BasisCurves.Get(stage, "/groom/hairs").GetCurveVertexCountsAttr().Get()) == 600
