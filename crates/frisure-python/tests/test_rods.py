"""Many rods as arrays."""

from __future__ import annotations

import copy
import dataclasses
import pickle
import pydoc
import sys
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
    fine = rods.settle(0.1, tangent=fan(16), **{**CURL, "elements": 960})
    for elements in [30, 32]:
        coarse = rods.settle(0.1, tangent=fan(16), error=True, **{**CURL, "elements": elements})
        assert coarse.points is not None and fine.points is not None and coarse.error is not None
        true = np.linalg.norm(coarse.points - fine.points[:, :: 960 // elements], axis=2).max(axis=1)
        assert (coarse.error < 4 * true).all() and (coarse.error > true).all()


def test_there_is_no_estimate_of_an_error_where_elements_are_too_long_for_the_curl() -> None:
    coarse = rods.settle(0.1, tangent=fan(16), error=True, **{**CURL, "elements": 4})
    assert coarse.error is not None and np.isinf(coarse.error).all()


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
        ({"length": [0.1, -0.2]}, ValueError, r"`length\[1\]` is wrong: length is -0.2 m; it must be between 1 um and 100 m"),
        ({"length": 1e150}, ValueError, r"`length\[0\]` is wrong: length is 1e150 m; it must be between"),
        ({"length": 0.1, "youngs_modulus": 1e-300}, ValueError, r"`youngs_modulus\[0\]`.*1e-300 Pa; it must be between 1 kPa"),
        ({"length": 0.1, "diameter": 70}, ValueError, r"`diameter\[0\]`.*70.0 m; it must be between 10 nm and 10 cm"),
        ({"length": 0.1, "gravity": [9.81, 1e300]}, ValueError, r"`gravity\[1\]`.*1e300"),
        ({"length": 0.1, "curl_radius": 1e-300}, ValueError, r"`curl_radius\[0\]`.*rad/m"),
        ({"length": 0.1, "natural_strain": [1e12, 0, 0]}, ValueError, r"`natural_strain\[0\]`.*1e7 rad/m"),
        ({"length": 0.1, "root": [1e308, 0, 0]}, ValueError, r"`root\[0\]`.*1000 km"),
        ({"length": 0.1, "diameter": [7e-5, 0]}, ValueError, r"`diameter\[1\]`"),
        ({"length": 0.1, "axis_ratio": 0.5}, ValueError, r"`axis_ratio\[0\]`"),
        ({"length": 0.1, "youngs_modulus": [1e9, np.inf]}, ValueError, r"`youngs_modulus\[1\]`"),
        ({"length": 0.1, "shear_modulus": -1}, ValueError, r"`shear_modulus\[0\]`"),
        ({"length": 0.1, "density": np.nan}, ValueError, r"`density\[0\]`"),
        ({"length": 0.1, "gravity": [-9.81]}, ValueError, r"`gravity\[0\]`"),
        ({"length": 0.1, "curl_radius": -1}, ValueError, r"`curl_radius\[0\]`"),
        ({"length": 0.1, "tangent": [[0, 1, 0]], "d1": [0, 2, 0]}, ValueError, r"`d1\[0\]`"),
        ({"length": 0.1, "curl_radius": 1, "curl_pitch": np.nan}, ValueError, r"`curl_pitch\[0\]`"),
        ({"length": 0.1, "tangent": [[0, 0, 1], [0, 0, 0]]}, ValueError, r"`tangent\[1\]`"),
        ({"length": 0.1, "d1": [1, 0, 0]}, ValueError, r"`d1\[0\]`"),
        ({"length": 0.1, "root": [0, np.nan, 0]}, ValueError, r"root\[1\] is nan; it must be finite"),
        ({"length": [0.1, True]}, TypeError, "length has bools in it"),
        ({"length": [np.array(0.1), np.array(True)]}, TypeError, "length has bools in it"),
        ({"length": 0.1, "natural_strain": np.full((2, 3, 3), np.inf)}, ValueError, r"natural_strain\[0, 0, 0\] is inf"),
        ({"length": 0.1, "natural_strain": [0, np.inf, 0]}, ValueError, r"natural_strain\[1\] is inf"),
        ({"length": [0.1, 0.2], "diameter": [1e-4] * 3}, ValueError, "diameter has 3 values|length has 2"),
        ({"length": [[0.1]]}, ValueError, r"length has the shape \(1, 1\)"),
        ({"length": 0.1, "root": [1, 2]}, ValueError, "root has the shape"),
        ({"length": 0.1, "elements": 0}, ValueError, "elements is 0"),
        ({"length": 0.1, "elements": 10**20}, ValueError, "elements is 1000.*between 1 and 10000"),
        ({"length": 0.1, "elements": 15.5}, ValueError, "elements is 15.5; it must be a whole number"),
        ({"length": 0.1, "elements": True}, ValueError, "elements is True"),
        ({"length": 0.1, "elements": "a"}, ValueError, "elements is 'a'"),
        ({"length": 0.1, "tolerance": "a"}, ValueError, "tolerance is 'a'"),
        ({"length": 0.1, "curl_radius": 0.01, "natural_strain": [0, 0, 1]}, ValueError, "curl_radius and natural_strain"),
        ({"length": 0.1, "curl_pitch": 0.01, "natural_strain": [0, 0, 1]}, ValueError, "curl_pitch and natural_strain"),
        ({"length": 0.1, "curl_pitch": 0.01}, ValueError, "curl_pitch is given without curl_radius"),
        ({"length": 0.1, "elements": 15, "error": True}, ValueError, "even"),
        ({"length": 0.1, "tolerance": np.nan}, ValueError, "tolerance is nan"),
        ({"length": 0.1, "tolerance": 0.1}, ValueError, "tolerance is 0.1; it must be .* at most 1e-2"),
        ({"length": 0.1, "points": "no"}, TypeError, "points is 'no'; it must be True or False"),
        ({"length": 0.1, "error": []}, TypeError, r"error is \[\]"),
        ({"length": 0.1, "derivatives": np.zeros(2)}, TypeError, "derivatives is array"),
        ({"length": 0.1, "precision": np.zeros(2)}, ValueError, "precision is array"),
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


def packed(array: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """The same array as a field of packed records, which is not aligned."""
    table = np.zeros(len(array), dtype=[("id", "i1"), ("value", "f8", array.shape[1:])])
    table["value"] = array
    found: np.ndarray[Any, Any] = table["value"]
    assert not found.flags.aligned
    return found


def test_arrays_of_packed_records_are_copied() -> None:
    length, tangent = np.linspace(0.05, 0.1, 4), fan(4)
    plain = rods.settle(length, tangent=tangent, derivatives=True, **CURL)
    rest = rods.settle(packed(length), tangent=packed(tangent), derivatives=True, **CURL)
    assert plain.points is not None and np.array_equal(plain.energy, rest.energy)
    strain = packed(np.ones((4, 3, 3)))
    assert np.array_equal(rods.settle(length, natural_strain=strain).energy, rods.settle(length, natural_strain=np.ones((4, 3, 3))).energy)
    loss = np.random.default_rng(1).normal(size=plain.points.shape)
    assert np.array_equal(rest.vjp(packed(loss), packed(loss)).length, plain.vjp(loss, loss).length)
    assert np.array_equal(rest.jvp(length=packed(length)).points, rest.jvp(length=length).points)
    assert np.array_equal(rods.inverse(packed(plain.points)).length, rods.inverse(plain.points).length)
    found = frisure.fit(packed(plain.points), arc_length=packed(np.linspace(0, 1, 31)[:, np.newaxis] @ [[1.0]])[:, 0])
    assert len(found) == 4


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not tell how much memory is free")
def test_what_has_no_room_is_refused_before_it_is_taken() -> None:
    many, line = 2 * 10**8, np.linspace([0, 0, 0], [0, 0, -0.1], 2000)
    told = r"bytes.*GB of memory, and .* free[\s\S]*about \d+ {} have room"
    with pytest.raises(frisure.ArgumentError, match="200000000 rods need.*" + told.format("rods")):
        rods.settle(np.broadcast_to(0.1, (many,)), points=False)
    with pytest.raises(frisure.ArgumentError, match=told.format("rods")):
        rods.settle(np.broadcast_to(0.1, (10**7,)), elements=10_000)
    with pytest.raises(frisure.ArgumentError, match=told.format("lines")):
        rods.inverse(np.broadcast_to(line, (10**7, 2000, 3)))
    with pytest.raises(frisure.ArgumentError, match=told.format("points")):
        frisure.fit(np.broadcast_to(line, (10**7, 2000, 3)))
    with pytest.raises(frisure.ArgumentError, match=told.format("numbers of length")):
        rods.settle(np.broadcast_to(np.float32(0.1), (10**12,)))


def test_a_clamp_along_y_has_a_section_across_it() -> None:
    curl = {"curl_radius": 5e-3, "curl_pitch": 1e-2, "elements": 30}
    along = rods.settle(0.15, tangent=[[0, 1, 0], [1, 0, 0], [0, -2, 0]], **curl)
    chosen = rods.settle(0.15, tangent=[0, 1, 0], d1=[1, 0, 0], **curl)
    usual = rods.settle(0.15, tangent=[1, 0, 0], d1=[0, 1, 0], **curl)
    assert along.points is not None and chosen.points is not None and usual.points is not None
    assert along.stable.all() and np.array_equal(along.points[0], chosen.points[0])
    assert np.array_equal(along.points[1], usual.points[0])
    # A fan that meets y.
    assert rods.settle(0.15, tangent=fan(4)).stable.all()


def test_results_are_compared_as_objects_and_can_be_copied() -> None:
    rest = rods.settle([0.1, 0.2], curl_radius=5e-3, curl_pitch=0.01, derivatives=True)
    loss = np.ones((2, 16, 3))
    by = rest.vjp(loss)
    assert rest == rest and rest != copy.copy(rest) and hash(rest) != hash(by)
    for twin in (copy.copy(rest), copy.deepcopy(rest)):
        assert np.array_equal(twin.vjp(loss).length, by.length)
    assert copy.deepcopy(rest).energy is not rest.energy
    assert list(dataclasses.asdict(rest)) == ["points", "energy", "stable", "gradient_norm", "iterations", "error", "eigenvalue", "frames"]
    assert np.array_equal(dataclasses.asdict(by)["length"], by.length)
    again = pickle.loads(pickle.dumps(rest))
    assert again != rest and np.array_equal(again.energy, rest.energy)


def test_derivatives_are_those_of_what_was_given_then() -> None:
    tangent, radius = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.3]]), np.array([5e-3, 6e-3])
    rest = rods.settle(0.1, tangent=tangent, curl_radius=radius, curl_pitch=0.01, derivatives=True)
    loss = np.ones((2, 16, 3))
    before = rest.vjp(loss)
    tangent[:], radius[:] = 7.0, 7.0
    after = rest.vjp(loss)
    assert np.array_equal(before.tangent, after.tangent)
    assert before.curl_radius is not None and np.array_equal(before.curl_radius, after.curl_radius)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", [rods.Settled, rods.Gradient, rods.Motion, rods.Inverse, frisure.Fits, frisure.Measured])
def test_help_has_every_field_with_its_meaning(kind: type) -> None:
    text = pydoc.plain(pydoc.render_doc(kind)).split("Method resolution")[0].split("Methods defined")[0]
    for field in dataclasses.fields(kind):
        name = field.name.removesuffix("_sd")
        assert f"`{name}`" in text, field.name


def test_masked_values_are_refused_by_name() -> None:
    masked: Any = np.ma.masked_array([0.1, 99.0], mask=[False, True])  # type: ignore[no-untyped-call]
    masked_strain: Any = np.ma.masked_array([10.0, 500.0, 0.0], mask=[False, True, False])  # type: ignore[no-untyped-call]
    points: Any = np.ma.masked_invalid(np.full((1, 6, 3), np.nan))  # type: ignore[no-untyped-call]
    rest = rods.settle([0.1, 0.1], derivatives=True)
    loss: Any = np.ma.masked_greater(np.ones((2, 16, 3)), 0)  # type: ignore[no-untyped-call]
    wrong: list[tuple[Any, str]] = [
        (lambda: rods.settle(masked), "length has masked"),
        (lambda: rods.settle(0.1, curl_radius=masked), "curl_radius has masked"),
        (lambda: rods.inverse(points), "points has masked"),
        (lambda: rods.settle(0.1, natural_strain=[[[1.0, 2.0, 3.0], masked_strain]]), "natural_strain has masked"),
        (lambda: rest.vjp(loss), "by_points has masked"),
        (lambda: rest.jvp(length=masked), "length has masked"),
        (lambda: frisure.fit(points), "strands has masked"),
        (lambda: frisure.fit([points[0]]), r"strands\[?0?\]? has masked"),
        (lambda: frisure.fit(np.zeros((2, 6, 3)), length=masked), "length has masked"),
    ]
    for call, words in wrong:
        with pytest.raises(frisure.ArgumentError, match=words):
            call()
    assert rods.settle(np.ma.masked_array([0.1, 0.2])).stable.all()  # type: ignore[no-untyped-call]


def test_wrong_types_are_errors_of_the_package() -> None:
    for call, words in (
        (lambda: rods.settle("a"), "length has the dtype"),  # type: ignore[arg-type]
        (lambda: rods.settle(0.1, diameter=None), "diameter has the dtype object"),  # type: ignore[arg-type]
        (lambda: rods.settle(0.1, progress=1), "progress is 1; it must be a function"),  # type: ignore[arg-type]
        (lambda: rods.settle(0.1, tolerance=10**400), "tolerance is 1000"),
        (lambda: rods.settle(0.1, elements=10**5000), "elements is of the type int"),
        (lambda: rods.settle(0.1, root=[1, 0]), r"root has the shape \(2,\)"),
    ):
        with pytest.raises(frisure.ArgumentError, match=words):
            call()


def test_results_are_told_in_a_line() -> None:
    rest = rods.settle([0.1, 0.2], elements=8, derivatives=True)
    assert repr(rest) == "<frisure.rods.Settled: 2 of 2 rods stable, points (2, 9, 3), with derivatives>"
    assert repr(rods.settle(0.1, points=False)) == "<frisure.rods.Settled: 1 of 1 rods stable>"
    assert repr(rest.vjp(np.ones((2, 9, 3)))) == "<frisure.rods.Gradient: 2 of 2 rods with derivatives, 2 regular>"
    assert "2 rods" in repr(rest.jvp(length=1.0)) and "of 2 fibres" in repr(rods.inverse(rest.points))


def test_lines_in_another_unit_are_refused_at_once() -> None:
    hanging = np.zeros((2, 10, 3))
    hanging[:, :, 2] = -np.linspace(0, 0.15, 10)
    hanging[1] *= 300
    with pytest.raises(frisure.ArgumentError, match=r"`points\[1\]` is wrong: its length is 45.000 m, .*in metres"):
        rods.inverse(hanging)
    with pytest.raises(frisure.ArgumentError, match=r"points\[0, 9, 2\] is nan"):
        rods.inverse(np.where(hanging < -0.149, np.nan, hanging))
