"""Hair cards: validators have nothing to say, and Blender and trimesh open them."""

import json
import os

import bpy
import numpy as np
import pytest
import trimesh
import usd_validation_nvidia
from pxr import Usd, UsdGeom, UsdShade, UsdValidation

CARDS, LEVELS = 40, 3


@pytest.fixture(scope="module")
def cards(head, frisure, tmp_path_factory):
    """A folder with cards of the head of hair in all formats."""
    folder = tmp_path_factory.mktemp("cards")
    outputs = [word for kind in ("glb", "obj", "usdc", "usda") for word in ("-o", folder / f"hair.{kind}")]
    options = ["--cards", CARDS, "--lods", LEVELS, "--texture-size", 512]
    folder.joinpath("said.txt").write_text(frisure.run("cards", head / "head.usdc", *outputs, *options))
    return folder


def parts(path):
    """The JSON and the bytes of a .glb."""
    data = path.read_bytes()
    length = int.from_bytes(data[12:16], "little")
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def test_khronos_has_nothing_to_say(cards, khronos):
    assert khronos(cards / "hair.glb") == []


@pytest.mark.parametrize("kind", ["usdc", "usda"])
def test_pixar_and_nvidia_have_nothing_to_say(cards, kind):
    path = cards / f"hair.{kind}"
    stage = Usd.Stage.Open(str(path))
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    found = UsdValidation.ValidationContext(validators).Validate(stage)
    assert [f"{fault.GetName()}: {fault.GetMessage()}" for fault in found] == []
    issues = usd_validation_nvidia.ValidationEngine().validate(str(path)).issues()
    # Text is text; few normals of a card are the same.
    usual = ("UsdAsciiPerformanceChecker", "IndexedPrimvarChecker")
    assert [str(i.message) for i in issues if i.rule.__name__ not in usual] == []
    meshes = [UsdGeom.Mesh.Get(stage, f"/cards/hair_LOD{k}") for k in range(LEVELS)]
    seen = [mesh.ComputeVisibility() for mesh in meshes]
    assert seen == ["inherited"] + ["invisible"] * (LEVELS - 1)
    bound, _ = UsdShade.MaterialBindingAPI(meshes[0].GetPrim()).ComputeBoundMaterial()
    assert bound.GetPath() == "/cards/materials/hair_LOD0"


def test_each_level_has_fewer_cards(cards):
    document, _ = parts(cards / "hair.glb")
    counts = [
        document["accessors"][mesh["primitives"][0]["indices"]]["count"] // 3 for mesh in document["meshes"]
    ]
    assert len(counts) == LEVELS and all(a > 1.8 * b for a, b in zip(counts, counts[1:]))
    assert document["scenes"][0]["nodes"] == [0]
    assert document["nodes"][0]["extensions"]["MSFT_lod"]["ids"] == [1, 2]


@pytest.mark.parametrize("hair", ["straight", "curly", "african-coily"])
def test_trimesh_finds_no_card_without_area_and_none_folded(frisure, tmp_path, hair):
    scene = tmp_path / "scene.toml"
    scene.write_text(f'[hair]\ntype = "{hair}"\nlength = "10 cm"\n[wisps]\nhairs = 600\npoints = 48\ncount = 40\n')
    frisure.run("cards", scene, "-o", tmp_path / "hair.obj", "--cards", CARDS, "--lods", LEVELS, "--texture-size", 512)
    scene = trimesh.load_scene(tmp_path / "hair.obj", group_material=False, split_object=True)
    meshes = list(scene.geometry.values())
    assert len(meshes) == LEVELS
    for mesh in meshes:
        assert (mesh.area_faces > 0).mean() > 0.99
        # Every face looks where its normals do: a strip that cannot follow a curl runs along its axis (docs/cards.md).
        normals = mesh.vertex_normals[mesh.faces].mean(axis=1)
        right = (normals * mesh.face_normals).sum(axis=1) > 0
        assert mesh.area_faces[right].sum() > 0.995 * mesh.area


def test_blender_opens_the_same_mesh_with_its_textures(cards, head):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(cards / "hair.glb"))
    first = next(o for o in bpy.data.objects if o.name.startswith("hair_LOD0"))
    bpy.context.view_layer.update()
    world = np.array([first.matrix_world @ v.co for v in first.data.vertices])
    stage = Usd.Stage.Open(str(cards / "hair.usdc"))
    points = np.array(UsdGeom.Mesh.Get(stage, "/cards/hair_LOD0").GetPointsAttr().Get())
    assert np.abs(np.sort(world, axis=0) - np.sort(points, axis=0)).max() < 1e-5
    # The cards are where the hair is.
    groom = Usd.Stage.Open(str(head / "head.usdc"))
    hairs = UsdGeom.BasisCurves.Get(groom, "/groom/hairs")
    hair = np.array(hairs.GetPointsAttr().Get())
    assert np.abs(hair.min(0) - world.min(0)).max() < 0.03 and np.abs(hair.max(0) - world.max(0)).max() < 0.03
    images = {image.name: tuple(image.size) for image in bpy.data.images if image.name.startswith("lod")}
    assert images["lod0-color"] == (512, 512) and images["lod1-color"] == (256, 256)
    material = first.data.materials[0]
    shader = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    assert shader.inputs["Base Color"].is_linked and shader.inputs["Alpha"].is_linked


def test_the_texture_is_covered_where_cards_are(cards):
    image = bpy.data.images.load(str(cards / "hair-lod0-color.png"))
    texels = np.array(image.pixels[:]).reshape(512, 512, 4)
    covered = texels[:, :, 3]
    # 600 hairs are thinner than a texel.
    assert 0.01 < covered.mean() < 0.9 and covered.max() > 0.3
    # Nothing at the edge: no card touches it.
    assert covered[0].max() == covered[-1].max() == covered[:, 0].max() == covered[:, -1].max() == 0
    first = (cards / "said.txt").read_text().splitlines()[2].split()
    # Some locks have two cards: as many as were asked for, about.
    assert first[0] == "0" and abs(int(first[1]) - CARDS) < 0.25 * CARDS
    assert os.path.getsize(cards / "hair-lod0-flow.png") > 1000
