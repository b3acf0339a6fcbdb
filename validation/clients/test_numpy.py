"""NumPy: `.npz` and `.data`."""

import numpy as np
import pytest

import sample


@pytest.fixture()
def written(tmp_path):
    path = tmp_path / "sample.npz"
    np.savez(path, **sample.arrays())
    return path


def test_every_array_comes_back(frisure, written, tmp_path):
    back = tmp_path / "back.npz"
    frisure.convert(written, back)
    expected = sample.arrays()
    with np.load(back, allow_pickle=False) as found:
        assert set(found.files) == set(expected)
        for name, array in expected.items():
            assert found[name].shape == array.shape, name
            if array.dtype.kind == "U":
                assert found[name] == array
            else:
                assert found[name].dtype == array.dtype, name
                np.testing.assert_allclose(found[name], array, rtol=2e-7, atol=1e-9, err_msg=name)


def test_packed_doubles_are_read(frisure, tmp_path):
    path, back = tmp_path / "packed.npz", tmp_path / "back.npz"
    points = sample.positions().astype("f8")
    np.savez_compressed(path, strands=points * 100, metres=0.01, other=np.zeros(7))
    frisure.convert(path, back)
    with np.load(back, allow_pickle=False) as found:
        np.testing.assert_allclose(found["positions"], points, atol=1e-7)
        assert found["metres"] == 1 and "other" not in found.files


def test_strands_of_any_length(frisure, tmp_path):
    path, back = tmp_path / "uneven.npz", tmp_path / "back.npz"
    points = sample.positions().reshape(-1, 3)[:100]
    offsets = np.array([0, 2, 50, 53, 100])
    np.savez(path, points=points, offsets=offsets, wetness=np.linspace(0, 1, 100, dtype="f4"))
    frisure.convert(path, back)
    with np.load(back, allow_pickle=False) as found:
        np.testing.assert_array_equal(found["offsets"], offsets)
        np.testing.assert_allclose(found["points"], points, atol=1e-7)
        assert found["wetness"].shape == (100,)


def test_fortran_and_pickles_are_told(frisure, tmp_path):
    path = tmp_path / "order.npz"
    np.savez(path, positions=np.asfortranarray(sample.positions()))
    with pytest.raises(AssertionError, match="Fortran"):
        frisure.convert(path, tmp_path / "a.hair")
    np.savez(path, points=sample.positions()[0], offsets=np.array([0, None], dtype=object))
    with pytest.raises(AssertionError, match="offsets"):
        frisure.convert(path, tmp_path / "a.hair")


def read_data(path):
    """Reads a file as users of USC-HairSalon do."""
    words = np.fromfile(path, "<i4")
    strands, at = [], 1
    for _ in range(words[0]):
        count = words[at]
        strands.append(words[at + 1 : at + 1 + 3 * count].view("<f4").reshape(-1, 3))
        at += 1 + 3 * count
    assert at == len(words)
    return strands


def test_data_has_a_hundred_points_y_up(frisure, written, tmp_path):
    path = tmp_path / "sample.data"
    frisure.convert(written, path)
    strands = read_data(path)
    assert [len(s) for s in strands] == [100] * sample.STRANDS
    ends = np.array([[s[0], s[-1]] for s in strands])
    np.testing.assert_allclose(ends, sample.y_up(sample.positions()[:, [0, -1]]), atol=1e-7)
    # Evenly spaced.
    steps = np.linalg.norm(np.diff(np.array(strands), axis=1), axis=-1)
    assert (steps < 1.001 * np.median(steps, axis=1)[:, None]).all()


def test_data_is_read_without_bare_roots(tmp_path, hair_of):
    path = tmp_path / "usc.data"
    points = sample.y_up(sample.positions()).astype("<f4")
    with path.open("wb") as file:
        file.write(np.int32(len(points) + 1).tobytes())
        file.write(np.int32(1).tobytes() + np.zeros(3, "<f4").tobytes())
        for strand in points:
            file.write(np.int32(len(strand)).tobytes() + strand.tobytes())
    found, _, counts = hair_of(path)
    assert list(counts) == [sample.POINTS] * sample.STRANDS
    np.testing.assert_allclose(found, sample.positions().reshape(-1, 3), atol=1e-7)
