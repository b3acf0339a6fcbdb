"""Many rods as arrays."""

from __future__ import annotations

from typing import Any

import frisure
import numpy as np
import pytest
from frisure import rods


def fan(count: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Directions all around in the horizontal, (count, 3)."""
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return np.stack([np.cos(angle), np.sin(angle), np.zeros(count)], axis=1)


CURL: dict[str, Any] = {"axis_ratio": 1.4, "curl_radius": 5e-3, "curl_pitch": 1e-2, "elements": 30}


def test_shapes_and_dtypes() -> None:
    rest = rods.settle(0.15, tangent=fan(40), **CURL)
    assert rest.points is not None and rest.error is None
    assert (rest.points.shape, rest.points.dtype) == ((40, 31, 3), np.float64)
    assert (rest.energy.shape, rest.energy.dtype) == ((40,), np.float64)
    assert (rest.stable.shape, rest.stable.dtype) == ((40,), np.bool_)
    assert rest.iterations.dtype == np.uint32 and len(rest) == 40
    assert rest.stable.all() and (rest.gradient_norm <= 1e-8).all()
    assert rods.settle(0.15).energy.shape == (1,)
    assert rods.settle(0.15, points=False).points is None


def test_a_weightless_rod_has_its_natural_shape() -> None:
    # A quarter of a circle of radius 10 cm about d1 = y, from the root along x: the centre is above or below the root.
    arc = 0.1 * np.pi / 2
    rest = rods.settle(arc, curl_radius=0.1, gravity=0.0, elements=400)
    assert rest.points is not None
    centre = rest.points[0, 0] + np.array([0, 0, np.sign(rest.points[0, -1, 2]) * 0.1])
    assert np.allclose(np.linalg.norm(rest.points[0] - centre, axis=1), 0.1, atol=1e-6)
    assert abs(rest.energy[0]) < 1e-15


def test_a_stiff_cantilever_sags_as_beam_theory_says() -> None:
    # Euler and Bernoulli: w = ρ S g L⁴ / 8 E I for a small deflection.
    length, diameter, e, density = 0.02, 80e-6, 4e9, 1300.0
    rest = rods.settle(length, diameter=diameter, youngs_modulus=e, density=density, elements=200)
    assert rest.points is not None
    area, moment = np.pi * diameter**2 / 4, np.pi * diameter**4 / 64
    expected = density * area * 9.81 * length**4 / (8 * e * moment)
    assert -rest.points[0, -1, 2] == pytest.approx(expected, rel=1e-3)


def test_a_rod_does_not_depend_on_those_beside_it() -> None:
    length = np.linspace(0.05, 0.3, 1500)
    together = rods.settle(length, tangent=fan(1500), **CURL)
    alone = rods.settle(length[700], tangent=fan(1500)[700], **CURL)
    assert together.points is not None and alone.points is not None
    assert np.array_equal(together.points[700], alone.points[0])
    assert together.energy[700] == alone.energy[0]


def test_strains_say_the_same_as_a_curl() -> None:
    radius, pitch = 5e-3, 1e-2 / (2 * np.pi)
    d = radius**2 + pitch**2
    strain = np.array([radius / d, 0.0, pitch / d])
    keys = {"axis_ratio": 1.4, "elements": 30}
    curl = rods.settle(0.15, tangent=fan(5), **CURL)
    uniform = rods.settle(0.15, tangent=fan(5), natural_strain=strain, **keys)
    varying = rods.settle(0.15, tangent=fan(5), natural_strain=np.tile(strain, (5, 7, 1)), **keys)
    assert curl.points is not None and uniform.points is not None and varying.points is not None
    assert np.array_equal(curl.points, uniform.points)
    assert np.allclose(curl.points, varying.points, atol=1e-9)


def test_the_error_is_what_a_fine_division_shows() -> None:
    coarse = rods.settle(0.1, tangent=fan(16), error=True, **CURL)
    fine = rods.settle(0.1, tangent=fan(16), **{**CURL, "elements": 960})
    assert coarse.points is not None and fine.points is not None and coarse.error is not None
    true = np.linalg.norm(coarse.points - fine.points[:, ::32], axis=2).max(axis=1)
    assert (coarse.error < 3 * true).all() and (coarse.error > true / 3).all()


def test_arrays_may_be_strided_reversed_and_read_only_and_stay_unchanged() -> None:
    plain = rods.settle(np.linspace(0.1, 0.2, 8), tangent=fan(8), **CURL)
    spread = np.zeros(16)
    spread[::2] = np.linspace(0.1, 0.2, 8)
    columns = np.asfortranarray(fan(8))
    columns.flags.writeable = False
    strided = rods.settle(spread[::2], tangent=columns, **CURL)
    assert np.array_equal(plain.energy, strided.energy)
    backwards = rods.settle(spread[::2][::-1], tangent=columns[::-1], **CURL)
    assert np.array_equal(plain.energy, backwards.energy[::-1])
    whole = rods.settle(np.array([1, 2]), elements=4)
    single = rods.settle(np.array([1, 2], dtype=np.float32), elements=4)
    assert np.array_equal(whole.energy, single.energy)


def test_float64_is_read_where_it_is_and_results_are_not_copied() -> None:
    length = np.full(10, 0.1)
    assert rods._numbers("length", length).ctypes.data == length.ctypes.data
    tangent = fan(20)[::2]
    assert rods._vectors("tangent", tangent).ctypes.data == tangent.ctypes.data
    points = rods.settle(length).points
    # The array is memory of the library under another shape: its base owns what it shows.
    assert points is not None and points.base is not None and points.flags.writeable
    assert points.flags.c_contiguous


def test_no_rods_are_no_error() -> None:
    rest = rods.settle(np.empty(0), tangent=np.empty((0, 3)))
    assert rest.points is not None and rest.points.shape == (0, 16, 3) and len(rest) == 0
    assert len(rods.inverse(np.empty((0, 5, 3)))) == 0


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"length": [0.1, 0.2, np.nan]}, ValueError, r"`length\[2\]`.*NaN"),
        ({"length": [0.1, -0.2]}, ValueError, r"`length\[1\]`.*greater than zero"),
        ({"length": 0.1, "diameter": [7e-5, 0]}, ValueError, r"`diameter\[1\]`"),
        ({"length": 0.1, "axis_ratio": 0.5}, ValueError, r"`axis_ratio\[0\]`"),
        ({"length": 0.1, "youngs_modulus": [1e9, np.inf]}, ValueError, r"`youngs_modulus\[1\]`"),
        ({"length": 0.1, "shear_modulus": -1}, ValueError, r"`shear_modulus\[0\]`"),
        ({"length": 0.1, "density": np.nan}, ValueError, r"`density\[0\]`"),
        ({"length": 0.1, "gravity": [-9.81]}, ValueError, r"`gravity\[0\]`"),
        ({"length": 0.1, "curl_radius": -1}, ValueError, r"`curl_radius\[0\]`"),
        ({"length": 0.1, "curl_radius": 1, "curl_pitch": np.nan}, ValueError, r"`curl_pitch\[0\]`"),
        ({"length": 0.1, "tangent": [[0, 0, 1], [0, 0, 0]]}, ValueError, r"`tangent\[1\]`"),
        ({"length": 0.1, "d1": [1, 0, 0]}, ValueError, r"`d1\[0\]`"),
        ({"length": 0.1, "root": [0, np.nan, 0]}, ValueError, r"`root\[0\]`"),
        ({"length": 0.1, "natural_strain": [0, np.inf, 0]}, ValueError, r"`natural_strain\[0\]`"),
        ({"length": [0.1, 0.2], "diameter": [1e-4] * 3}, ValueError, "diameter has 3 values|length has 2"),
        ({"length": [[0.1]]}, ValueError, r"length has the shape \(1, 1\)"),
        ({"length": 0.1, "root": [1, 2]}, ValueError, "root has the shape"),
        ({"length": 0.1, "elements": 0}, ValueError, "elements is 0"),
        ({"length": 0.1, "elements": 15, "error": True}, ValueError, "even"),
        ({"length": 0.1, "tolerance": np.nan}, ValueError, "tolerance is nan"),
        ({"length": 0.1, "precision": "half"}, ValueError, "precision is 'half'"),
        ({"length": "25 cm"}, TypeError, "SI units"),
        ({"length": 1j}, TypeError, "complex"),
        ({"length": [None]}, TypeError, "object"),
    ],
)
def test_wrong_arguments_are_named(
    arguments: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        rods.settle(**arguments)


def test_the_inverse_hangs_in_the_given_shape() -> None:
    rest = rods.settle(0.12, tangent=fan(6), **{**CURL, "elements": 120})
    assert rest.points is not None
    found = rods.inverse(rest.points, axis_ratio=1.4)
    assert found.natural_strain.shape == (6, 121, 3) and found.frame.shape == (6, 3, 3)
    assert found.stable.all() and (found.error < 1e-4).all()
    assert np.allclose(found.length, 0.12, rtol=1e-3)
    again = rods.settle(
        found.length,
        axis_ratio=1.4,
        natural_strain=found.natural_strain,
        tangent=found.frame[:, 2],
        d1=found.frame[:, 0],
        elements=120,
    )
    assert again.points is not None
    assert np.linalg.norm(again.points - rest.points, axis=2).max() < 1e-3


def test_a_soft_fibre_does_not_stand_upright() -> None:
    line = np.linspace([0, 0, 0], [0, 0, 0.3], 20)
    found = rods.inverse(line)
    assert not found.stable[0] and found.stiffness_needed[0] > 2
    with pytest.raises(frisure.ArgumentError, match=r"points\[1\]"):
        rods.inverse(np.stack([line, np.zeros((20, 3))]))
    with pytest.raises(frisure.ArgumentError, match="diameter has 2 values for 1 lines"):
        rods.inverse(line, diameter=[1e-4, 1e-4])
