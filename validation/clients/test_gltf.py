"""glTF: pygltflib and trimesh open the lines."""

import numpy as np
import pygltflib
import pytest
import trimesh

import sample


@pytest.fixture()
def glb(frisure, tmp_path):
    source, path = tmp_path / "sample.npz", tmp_path / "sample.glb"
    np.savez(source, **sample.arrays())
    frisure.convert(source, path)
    return path


def test_khronos_has_nothing_to_say(glb, khronos):
    assert khronos(glb) == []


def array(gltf, index):
    accessor = gltf.accessors[index]
    view = gltf.bufferViews[accessor.bufferView]
    kind, width = {5126: ("<f4", 3), 5125: ("<u4", 1)}[accessor.componentType]
    data = gltf.binary_blob()[view.byteOffset : view.byteOffset + view.byteLength]
    values = np.frombuffer(data, kind).reshape(-1, width)
    assert len(values) == accessor.count
    return values


def test_accessors_hold_the_hair(glb):
    gltf = pygltflib.GLTF2().load(str(glb))
    assert [m.name for m in gltf.meshes] == ["hair", "guides"]
    primitive = gltf.meshes[0].primitives[0]
    assert primitive.mode == pygltflib.LINES
    points = array(gltf, primitive.attributes.POSITION)
    expected = sample.y_up(sample.positions()).reshape(-1, 3)
    np.testing.assert_allclose(points, expected, atol=1e-7)
    accessor = gltf.accessors[primitive.attributes.POSITION]
    np.testing.assert_array_equal(np.array(accessor.min, "f4"), points.min(0))
    np.testing.assert_array_equal(np.array(accessor.max, "f4"), points.max(0))
    colours = array(gltf, primitive.attributes.COLOR_0)
    np.testing.assert_allclose(colours, sample.arrays()["color"].reshape(-1, 3), atol=1e-7)
    edges = array(gltf, primitive.indices).reshape(-1, 2)
    assert len(edges) == sample.STRANDS * (sample.POINTS - 1)
    assert (np.diff(edges) == 1).all()
    # The container has chunks of multiples of 4 bytes, with the stated total length.
    data = glb.read_bytes()
    assert len(data) % 4 == 0 and int.from_bytes(data[8:12], "little") == len(data)


def test_trimesh_opens_it(glb):
    scene = trimesh.load_scene(glb)
    paths = [g for g in scene.geometry.values() if isinstance(g, trimesh.path.Path3D)]
    lengths = sorted(len(p.vertices) for p in paths)
    assert lengths == [4 * sample.POINTS, sample.STRANDS * sample.POINTS]
