"""From measured fibres to their natural strain and stiffness, with error bars."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from frisure._check import converted, real, unmasked, whole, without_bools
from frisure._frisure import check_room, fit_fibres
from frisure.errors import ArgumentError, ArgumentTypeError
from frisure.strands import Strands

__all__ = ["Fits", "fit"]

Float64 = NDArray[np.float64]
Progress = Callable[[str, float], object]

KNOWN = ("stiffness_over_weight", "torsion_ratio", "curvature", "torsion", "axis_ratio")
"""What can be known of a fibre before it is measured."""

FEWEST_POINTS = 5
"""Fewest points of a line, as `frisure_fit` has it."""

MOST_KNOTS = 16
"""Most knots of a natural strain, as `frisure_fit` has it."""

MOST_STATES = 100
"""Most states of wetness."""

FARTHEST = 5000.0
"""Longest arc length (m), as `frisure_fit` has it."""

STRONGEST = 1e5
"""Largest component of gravity (m/s²): a centrifuge."""

POINT = 400.0
"""Memory of a point with what is found of it (bytes): three coordinates in NumPy, twice in the library, and a list of three floats."""

GRAVITY = 9.81
"""Acceleration of gravity (m/s²) that stiffness over weight refers to."""


@dataclass(frozen=True, eq=False)
class Fits:
    """What was found of F fibres, in S states of wetness. Each number has its standard deviation in the array of the same name with
    `_sd`: from the Fisher information of the points and what was known before.

    - `curl_radius`, `curl_pitch` (F,), m: of the natural helix, without weight; a negative pitch is left-handed.
    - `curvature`, `torsion` (F,), rad/m: natural curvature, the mean if it varies, and natural torsion.
    - `stiffness_over_weight` (F, S): EI/(ρSg) (m³) with the smaller bending stiffness and g = 9.81 m/s²; NaN for a state that a fibre
      was not seen in.
    - `torsion_ratio` (F,): GJ/EI in the first state; `torsion_ratio_by_state` (F, S) has it in each.
    - `axis_ratio` (F,): longer over shorter axis of the section: that of `known`, or what the line tells of it, which is seldom much.
    - `length` (F, S), m.
    - `profile` (F, K, 2, 2), rad/m: natural curvature and torsion at K knots with their deviations; the last axis is value, deviation.
      None with one knot.
    - `covariance` (F, 4, 4): of curvature, torsion (rad/m), ln stiffness_over_weight and ln torsion_ratio in the first state.
    - `noise` (F,), m: standard deviation of a coordinate, given, or what the fit leaves over.
    - `reduced_square` (F,): mean square of the distance of the points from the fibre over that of the noise, about 1.
    - `fitted` (F,) bool: whether the fit converged and the points deviate no more than the noise does; where not, the other numbers say
      nothing.
    - `iterations` (F,) int64: how often the rods were solved.
    - `statements`: what the lines of each fibre do not tell, in sentences; empty lists where all was told.
    - `lines`: where the points of each pose are on the fitted fibre (m), (P, 3) for each.

    Two results are equal if they are the same object: compare their arrays.
    """

    curl_radius: Float64
    curl_radius_sd: Float64
    curl_pitch: Float64
    curl_pitch_sd: Float64
    curvature: Float64
    curvature_sd: Float64
    torsion: Float64
    torsion_sd: Float64
    stiffness_over_weight: Float64
    stiffness_over_weight_sd: Float64
    torsion_ratio: Float64
    torsion_ratio_sd: Float64
    torsion_ratio_by_state: Float64
    torsion_ratio_by_state_sd: Float64
    axis_ratio: Float64
    axis_ratio_sd: Float64
    length: Float64
    length_sd: Float64
    profile: Float64 | None
    covariance: Float64
    noise: Float64
    reduced_square: Float64
    fitted: NDArray[np.bool_]
    iterations: NDArray[np.int64]
    statements: list[list[str]]
    lines: list[list[Float64]]

    def __len__(self) -> int:
        return len(self.curl_radius)

    def __repr__(self) -> str:
        return f"<frisure.Fits: {int(self.fitted.sum())} of {len(self)} fibres fitted>"

    def _repr_html_(self) -> str:
        """A table of the first fibres, for notebooks."""

        def cell(value: float, deviation: float, unit: float) -> str:
            return f"<td>{value * unit:.4g} ± {deviation * unit:.2g}</td>"

        rows = "".join(
            f"<tr><td>{i}</td>"
            + cell(self.curl_radius[i], self.curl_radius_sd[i], 1e3)
            + cell(self.curl_pitch[i], self.curl_pitch_sd[i], 1e3)
            + cell(self.stiffness_over_weight[i, 0], self.stiffness_over_weight_sd[i, 0], 1e6)
            + cell(self.torsion_ratio[i], self.torsion_ratio_sd[i], 1)
            + f"<td>{'; '.join(self.statements[i])}</td></tr>"
            for i in range(min(len(self), 10))
        )
        head = "<th>fibre<th>radius (mm)<th>pitch (mm)<th>EI/(ρSg) (cm³)<th>GJ/EI<th>"
        return f"<table><tr>{head}</tr>{rows}</table><p>{repr(self)[1:-1]}</p>"


def fit(
    strands: Strands | ArrayLike | Sequence[ArrayLike],
    *,
    noise: float | None = None,
    arc_length: ArrayLike | Sequence[ArrayLike] | None = None,
    gravity: ArrayLike = (0.0, 0.0, -GRAVITY),
    fibre: ArrayLike | None = None,
    state: ArrayLike = 0,
    length: ArrayLike | None = None,
    known: Mapping[str, ArrayLike | tuple[ArrayLike, ArrayLike]] | None = None,
    knots: int = 1,
    progress: Progress | None = None,
) -> Fits:
    """The natural strain and the stiffness over weight of fibres from the lines in which they hang, with error bars.

    A line is a fibre that is clamped at its first point, hangs in its own weight and touches nothing.

    - `strands` (m): (H, P, 3), a list of H arrays (P, 3) with P at least 5, (P, 3) for one line, or `Strands`.
    - `noise` (m): standard deviation of each coordinate. Without it, what the fit leaves over is taken for noise, and nothing tells that a
      fibre does not fit.
    - `arc_length` (m): of each point from the clamp, (P,) for all lines, (H, P), or a list. Without it, only the distance of a point from the
      line counts, the last point is the tip, and the length is fitted.
    - `gravity` (m/s², in the axes of the points): (3,) or (H, 3). Zero: without weight, in water or lying flat.
    - `fibre`: which fibre each line shows, (H,) integers; by default each another. Several poses tell more than one. Rows of the result, and of what is
      given for each fibre, are in ascending order of these numbers.
    - `state`: state of wetness of each line, 0, 1, …; each has stiffnesses of its own, and natural strain and section are the same.
    - `length` (m): of each fibre from the clamp to the tip, () or (F,). By default its last arc length.
    - `known`: numbers that are known, by name: `stiffness_over_weight` (m³) and `torsion_ratio`, both of state 0, `curvature`, `torsion` (rad/m),
      `axis_ratio`; a number, (F,), or a pair of those: value and standard deviation. Without it EI/(ρSg) is taken to be 1e-4 m³ within a
      factor of 4.5, GJ/EI that of a round fibre, 0.46, within 30 %, with a factor 2 r²/(1 + r²) for the axis ratio r, and r 1.25 within 20 % (standard
      deviations of the logarithms); GJ/EI of further states within a factor of 2.
    - `knots`: the natural strain is linear between so many, for curls that vary along the fibre.

    >>> import numpy as np
    >>> from frisure import fit, rods
    >>> rest = rods.settle(0.12, diameter=80e-6, curl_radius=6e-3, curl_pitch=15e-3, elements=120)
    >>> found = fit(rest.points[:, ::3], arc_length=np.linspace(0, 0.12, 41), noise=1e-5)
    >>> bool(abs(found.curl_radius[0] / 6e-3 - 1) < 0.01)
    True
    """
    knots = whole("knots", knots, 1, MOST_KNOTS)
    if noise is not None:
        noise = real("noise", noise, "a number greater than 0 (m), or None", np.nextafter(0, 1))
    if known is not None and not isinstance(known, Mapping):
        raise ArgumentError(f"known is {known!r}; it must be a dict of numbers, or pairs of value and deviation, by name")
    points, offsets = _lines("strands", strands, 3)
    count = len(offsets) - 1
    for i in np.flatnonzero(np.diff(offsets) < FEWEST_POINTS)[:1]:
        raise ArgumentError(f"strands[{i}] has {offsets[i + 1] - offsets[i]} points; a line must have at least {FEWEST_POINTS}")
    arcs = None
    if arc_length is not None:
        arcs = _arcs(arc_length, offsets)
    fibres = np.arange(count) if fibre is None else _integers("fibre", fibre, count)
    names, order = np.unique(fibres, return_inverse=True)
    lengths = np.full(len(names), np.nan) if length is None else _numbers("length", length, len(names))
    given: dict[str, Any] = {name: None for name in KNOWN}
    for name, value in (known or {}).items():
        if name not in given:
            raise ArgumentError(f"known has {name!r}; it can have {', '.join(KNOWN)}")
        given[name] = _known(f"known[{name!r}]", value, len(names))
    numbers = np.ascontiguousarray(order.reshape(-1), dtype=np.int64)
    states = _states(state, numbers, len(names))
    if arcs is not None:
        _long_enough(lengths, arcs, offsets, numbers)
    lines: dict[str, Any] = {
        "points": points,
        "offsets": offsets,
        "arc_length": arcs,
        "gravity": _vectors("gravity", gravity, count),
        "state": states,
        "fibre": numbers,
        "length": lengths,
    }
    rows = {len(array) for array in given.values() if array is not None}
    broadcast = max(rows, default=1)
    for name, array in given.items():
        if array is not None and len(array) not in (1, broadcast):
            raise ArgumentError(f"known[{name!r}] has {len(array)} rows, others {broadcast}")
    return _fits(fit_fibres(lines, given, noise, knots, progress), len(names), knots)


def _fits(found: dict[str, Any], count: int, knots: int) -> Fits:
    numbers = np.asarray(found["numbers"], dtype=np.float64).reshape(count, 16)
    states = len(found["length"][0]) if count else 1
    stiffness = np.asarray(found["stiffness"], dtype=np.float64).reshape(count, states, 2)
    length = np.asarray(found["length"], dtype=np.float64).reshape(count, states, 2)
    ratio = np.asarray(found["torsion_ratio"], dtype=np.float64).reshape(count, states, 2)
    profile = np.asarray(found["profile"], dtype=np.float64).reshape(count, knots, 2, 2) if knots > 1 else None
    return Fits(
        curvature=numbers[:, 0],
        curvature_sd=numbers[:, 1],
        torsion=numbers[:, 2],
        torsion_sd=numbers[:, 3],
        curl_radius=numbers[:, 4],
        curl_radius_sd=numbers[:, 5],
        curl_pitch=numbers[:, 6],
        curl_pitch_sd=numbers[:, 7],
        torsion_ratio=numbers[:, 8],
        torsion_ratio_sd=numbers[:, 9],
        torsion_ratio_by_state=ratio[:, :, 0],
        torsion_ratio_by_state_sd=ratio[:, :, 1],
        axis_ratio=numbers[:, 10],
        axis_ratio_sd=numbers[:, 11],
        noise=numbers[:, 12],
        reduced_square=numbers[:, 13],
        fitted=numbers[:, 14] == 0,
        iterations=numbers[:, 15].astype(np.int64),
        stiffness_over_weight=stiffness[:, :, 0],
        stiffness_over_weight_sd=stiffness[:, :, 1],
        length=length[:, :, 0],
        length_sd=length[:, :, 1],
        profile=profile,
        covariance=np.asarray(found["covariance"], dtype=np.float64).reshape(count, 4, 4),
        statements=found["statements"],
        lines=[[np.asarray(line, dtype=np.float64) for line in lines] for lines in found["lines"]],
    )


def _array(name: str, value: Any) -> Float64:
    """A float64 array of real numbers, as it is if it is one."""
    unmasked(name, value)
    array = converted(name, value)
    if array.dtype.kind not in "fiu":
        raise ArgumentTypeError(f"{name} is no array of real numbers: its type is {array.dtype}")
    # A field of a packed record is not aligned.
    return np.require(array, np.float64, ["ALIGNED"])


def _lines(name: str, value: Any, columns: int) -> tuple[Float64, NDArray[np.int64]]:
    """The points of all lines, one after the other, and where each begins."""
    if isinstance(value, Strands):
        return value.points.astype(np.float64), value.offsets.astype(np.int64)
    if isinstance(value, (list, tuple)) and value and _array(f"{name}[0]", value[0]).ndim == 2:
        rows = [_array(f"{name}[{i}]", row) for i, row in enumerate(value)]
        for i, row in enumerate(rows):
            if row.ndim != 2 or row.shape[1] != columns:
                raise ArgumentError(f"{name}[{i}] has the shape {row.shape}; it must be (P, {columns})")
        offsets = np.cumsum([0, *(len(row) for row in rows)], dtype=np.int64)
        check_room("points", int(offsets[-1]), POINT)
        return np.concatenate(rows), offsets
    given = array = _array(name, value)
    if array.shape == (0,):
        return np.zeros((0, columns)), np.zeros(1, dtype=np.int64)
    if array.ndim == 2:
        array = array[np.newaxis]
    if array.ndim != 3 or array.shape[2] != columns:
        raise ArgumentError(f"{name} has the shape {given.shape}; it must be (H, P, {columns}) or (P, {columns}), or a list of those")
    count, points = array.shape[:2]
    check_room("points", count * points, POINT)
    return array.reshape(-1, columns), np.arange(count + 1, dtype=np.int64) * points


def _arcs(value: Any, offsets: NDArray[np.int64]) -> Float64:
    """The arc length of each point of all lines."""
    counts = np.diff(offsets)
    if isinstance(value, (list, tuple)) and value and _array("arc_length[0]", value[0]).ndim == 1:
        rows = [_array(f"arc_length[{i}]", row) for i, row in enumerate(value)]
        called = [f"arc_length[{i}]" for i in range(len(rows))]
    else:
        array = _array("arc_length", value)
        if array.ndim not in (1, 2):
            raise ArgumentError(f"arc_length has the shape {array.shape}; it must be (P,) or (H, P), or a list of (P,)")
        rows = list(array) if array.ndim == 2 else [array] * len(counts)
        called = [f"arc_length[{i}]" if array.ndim == 2 else "arc_length" for i in range(len(rows))]
    if len(rows) != len(counts):
        raise ArgumentError(f"arc_length has {len(rows)} rows for {len(counts)} lines; it must have as many")
    for i, (row, points) in enumerate(zip(rows, counts)):
        if row.shape != (points,):
            raise ArgumentError(f"{called[i]} has the shape {row.shape}; line {i} has {points} points")
        wrong = ~((row >= 0) & (row <= FARTHEST))
        wrong[1:] |= ~(row[1:] > row[:-1])
        for j in np.flatnonzero(wrong)[:1]:
            allowed = f"finite, between 0 and {FARTHEST:g} m, and greater than the one before"
            raise ArgumentError(f"{called[i]}[{j}] is {row[j]}; it must be {allowed}")
    return np.concatenate(rows) if rows else np.zeros(0)


def _numbers(name: str, value: Any, count: int) -> Float64:
    array = _array(name, value)
    if array.ndim == 0:
        array = np.full(count, float(array))
    if array.shape != (count,):
        raise ArgumentError(f"{name} has the shape {array.shape}; it must be () or ({count},)")
    for i in np.flatnonzero(~((array > 0) & (array <= FARTHEST)))[:1]:
        raise ArgumentError(f"{name}[{i}] is {array[i]}; it must be greater than 0 and at most {FARTHEST:g} m")
    return np.ascontiguousarray(array)


def _states(value: Any, fibres: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    """The state of each line; each fibre has a line in every state up to its last."""
    states = _integers("state", value, len(fibres))
    for i in np.flatnonzero(~((states >= 0) & (states < MOST_STATES)))[:1]:
        raise ArgumentError(f"state[{i}] is {states[i]}; it must be between 0 and {MOST_STATES - 1}: states are counted from 0")
    seen = np.zeros((count, int(states.max(initial=0)) + 1), dtype=bool)
    seen[fibres, states] = True
    gaps = ~np.logical_and.accumulate(seen, axis=1)
    for i in np.flatnonzero(gaps[fibres, states])[:1]:
        missing = int(np.argmin(seen[fibres[i]]))
        raise ArgumentError(
            f"state[{i}] is {states[i]}, and no line of its fibre is in state {missing}; states are counted from 0, and each has a line"
        )
    return states


def _long_enough(
    lengths: Float64, arcs: Float64, offsets: NDArray[np.int64], fibres: NDArray[np.int64]
) -> None:
    """Refuses a length that ends before a point of the fibre."""
    last = np.zeros(len(lengths))
    filled = np.flatnonzero(np.diff(offsets) > 0)
    np.maximum.at(last, fibres[filled], arcs[offsets[1:][filled] - 1])
    for i in np.flatnonzero(lengths < last)[:1]:
        raise ArgumentError(f"length[{i}] is {lengths[i]}; it must be at least the last arc_length of the fibre, {last[i]} m")


def _integers(name: str, value: Any, count: int) -> NDArray[np.int64]:
    unmasked(name, value)
    without_bools(name, value)
    array = np.asarray(value)
    if array.dtype.kind not in "iu":
        raise ArgumentTypeError(f"{name} has the type {array.dtype}; it must have integers")
    if array.ndim == 0:
        array = np.full(count, array)
    if array.shape != (count,):
        raise ArgumentError(f"{name} has the shape {array.shape}; it must be () or ({count},): one for each line")
    return np.require(array, np.int64, ["C", "ALIGNED"])


def _vectors(name: str, value: Any, count: int) -> Float64:
    array = _array(name, value)
    if array.shape == (3,):
        array = np.broadcast_to(array, (count, 3))
    if array.shape != (count, 3):
        raise ArgumentError(f"{name} has the shape {array.shape}; it must be (3,) or ({count}, 3): one for each line")
    for row, column in np.argwhere(~np.isfinite(array))[:1]:
        raise ArgumentError(f"{name}[{row}, {column}] is {array[row, column]}; it must be finite (m/s²)")
    size = np.abs(array).max(axis=1, initial=0.0)
    for row in np.flatnonzero(size > STRONGEST)[:1]:
        raise ArgumentError(f"{name}[{row}] is {array[row].tolist()}; its components must be within {STRONGEST:g} m/s²")
    return array


def _known(name: str, value: Any, count: int) -> Float64:
    """Rows of a value and a deviation."""
    pair = value if isinstance(value, tuple) else (value, 0.0)
    if len(pair) != 2:
        raise ArgumentError(f"{name} has {len(pair)} entries; it must be a number, or a pair of the number and its deviation")
    columns = [_array(name, column) for column in pair]
    for column in columns:
        if column.shape not in ((), (1,), (count,)):
            raise ArgumentError(f"{name} has the shape {column.shape}; it must be () or ({count},): one for each fibre")
    first, second = np.broadcast_arrays(*(np.atleast_1d(column) for column in columns))
    return np.stack([first, second], axis=1)

