"""Many single fibres at once, as arrays.

A fibre is an elastic rod with an elliptical section and a natural curl, clamped at its root, free at its tip, in its own
weight; nothing else touches it. All arrays are float64 in SI units; z points up.

>>> import numpy as np
>>> from frisure import rods
>>> angle = np.linspace(0, 2 * np.pi, 1000)
>>> rest = rods.settle(0.15, diameter=70e-6, axis_ratio=1.4, curl_radius=5e-3, curl_pitch=1e-2,
...                    tangent=np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1), elements=30)
>>> rest.points.shape, bool(rest.stable.all())
((1000, 31, 3), True)
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from frisure._check import array as _array
from frisure._check import flag, real, whole
from frisure._frisure import RodsAtRest, check_rods, inverse_rods, settle_rods
from frisure.errors import ArgumentError

__all__ = ["Gradient", "Inverse", "Motion", "Settled", "inverse", "settle"]

Float64 = NDArray[np.float64]
Progress = Callable[[str, float], object]

MAX_ELEMENTS = 10_000
"""Most elements of a rod."""

EXACT = 1e-10
"""Largest tolerance with derivatives: farther from rest they are slower to compute."""


@dataclass(frozen=True, eq=False, repr=False)
class Gradient:
    """The derivatives of a loss by what H rods are made of, one row for each rod, also where an argument of `settle` was
    one for all: its derivative is then the sum of the rows. Units are those of the loss over those of the argument.

    - `length` (H,), loss per m: all elements become longer in proportion, each with its natural strain.
    - `diameter` (H,), loss per m, and `axis_ratio` (H,), loss per 1.
    - `youngs_modulus`, `shear_modulus` (H,), loss per Pa, and `density` (H,), loss per kg/m³.
    - `gravity` (H,), loss per m/s²: by its size, along -z; `gravity_vector` (H, 3), loss per m/s², by each component of the
      acceleration (world).
    - `curl_radius`, `curl_pitch` (H,), loss per m; None with `natural_strain`.
    - `natural_strain`, loss per rad/m, in the shape of the argument: (H, 3) or (H, K, 3); with a curl (H, 3), by a strain that is the
      same all along.
    - `root` (H, 3), loss per m; `tangent`, `d1` (H, 3), loss per unit of the vector that was given.
    - `root_rotation` (H, 3), loss per rad: by a rotation of the clamp about the root (world).
    - `half_strain` (H, 2 elements, 3), loss per rad/m: by the natural strain of each half of an element.
    - `eigenvalue_bound` (H,), without unit: the second variation of the whole energy over that of the elastic energy, along the change of
      shape by which the loss meets the rod; the derivatives are as one over it. It is at least the smallest of all such quotients,
      `Settled.eigenvalue`. Without weight it is 1; weight that stretches the rod along that change makes it greater, and where stability is lost it is 0.
      It is 1 for a loss that asks nothing of the shape, such as one of the energy alone, and 0 where there are no derivatives.
    - `regular` (H,) bool: whether the smallest quotient is at least 1e-3 and all derivatives are finite. False means a fold (or another loss of
      stability) is near, where the shape goes on along one side of the parameter only: there derivatives are large, grow as one over the
      quotient, and hold for tiny changes, towards the fold for none. Nothing else is one-sided in a single rod, which touches nothing.
    - `exists` (H,) bool: whether the shape is a minimum and has derivatives; where not, they are zero.

    Two gradients are equal if they are the same object: compare their arrays.
    """

    length: Float64
    diameter: Float64
    axis_ratio: Float64
    youngs_modulus: Float64
    shear_modulus: Float64
    density: Float64
    gravity: Float64
    curl_radius: Float64 | None
    curl_pitch: Float64 | None
    natural_strain: Float64
    root: Float64
    tangent: Float64
    d1: Float64
    root_rotation: Float64
    half_strain: Float64
    gravity_vector: Float64
    eigenvalue_bound: Float64
    regular: NDArray[np.bool_]
    exists: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.length)

    def __repr__(self) -> str:
        regular, exists = int(self.regular.sum()), int(self.exists.sum())
        return f"<frisure.rods.Gradient: {exists} of {len(self)} rods with derivatives, {regular} regular>"


@dataclass(frozen=True, eq=False, repr=False)
class Motion:
    """How H rods at rest, with P nodes each, move along a change of what they are made of, to first order.

    - `points` (H, P, 3), m: how far each node moves, per unit of the change.
    - `frames` (H, P, 3), rad: the rotation of the frame of each node (world).
    - `energy` (H,), J: by how much `Settled.energy` changes.
    - `regular` (H,) bool: whether `Settled.eigenvalue` is at least 1e-3 and all numbers are finite. False means a fold (or another loss of stability)
      is near: there a rod moves far, and as given for tiny changes only, towards the fold for none.
    - `exists` (H,) bool: whether the shape is a minimum and has derivatives; where not, nothing moves.
    """

    points: Float64
    frames: Float64
    energy: Float64
    regular: NDArray[np.bool_]
    exists: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        regular, exists = int(self.regular.sum()), int(self.exists.sum())
        return f"<frisure.rods.Motion: {exists} of {len(self)} rods with derivatives, {regular} regular, points {self.points.shape}>"


@dataclass(frozen=True, eq=False)
class _Kept:
    """What the derivatives of settled rods need. It never changes, and stays in its process."""

    at_rest: RodsAtRest
    nodes: int
    curl_radius: Float64
    curl_pitch: Float64
    strains: int
    """Natural strains of each rod, K; 0 for a curl."""
    knots: bool
    """Whether they were given at knots, (H, K, 3)."""


@dataclass(frozen=True, eq=False, repr=False)
class Settled:
    """H rods at rest, with P = elements + 1 nodes each.

    - `points` (H, P, 3), m: nodes from root to tip; None with `points=False`.
    - `energy` (H,), J: elastic energy and that of the weight, which is 0 at the height of the root.
    - `stable` (H,) bool: whether the shape is known to be a minimum of the energy; never where the weight is more than 1e10 times the stiffness
      (ρSgL³/EI with the smaller EI), whose shapes rounding decides.
    - `gradient_norm` (H,): largest derivative of the energy by a turn, as a fraction of EI/L + ρSgL² (N m).
    - `iterations` (H,) uint32: iterations of the solver.
    - `error` (H,), m: estimated largest error of a node from the division into elements, mostly one and a half to four times as large as the error itself,
      infinite where there is no estimate; None without `error=True`.
    - `eigenvalue` (H,), without unit: the smallest quotient of the second variation of the whole energy over that of the elastic energy, along
      all changes of shape: 1 without weight, 0 where stability is lost, and negative at a saddle; NaN for a
      rod that is not at rest. None without `eigenvalue=True`.
    - `frames` (H, P, 3, 3): the frame at each node, rows d1, d2 and tangent, unit vectors (world); None without `frames=True`.

    With `derivatives=True`, `vjp` and `jvp` give the derivatives; copies have them, too, and what is pickled has not. Two results
    are equal if they are the same object: compare their arrays.
    """

    points: Float64 | None
    energy: Float64
    stable: NDArray[np.bool_]
    gradient_norm: Float64
    iterations: NDArray[np.uint32]
    error: Float64 | None
    eigenvalue: Float64 | None = None
    frames: Float64 | None = None

    def __len__(self) -> int:
        return len(self.energy)

    def __repr__(self) -> str:
        told = f"{int(self.stable.sum())} of {len(self)} rods stable"
        if self.points is not None:
            told += f", points {self.points.shape}"
        if "_kept" in self.__dict__:
            told += ", with derivatives"
        return f"<frisure.rods.Settled: {told}>"

    def __getstate__(self) -> dict[str, Any]:
        # What derivatives need stays in this process.
        return {name: value for name, value in self.__dict__.items() if name != "_kept"}

    def __copy__(self) -> Settled:
        new = object.__new__(Settled)
        new.__dict__.update(self.__dict__)
        return new

    def __deepcopy__(self, memo: dict[int, Any]) -> Settled:
        new = self.__copy__()
        new.__dict__.update({name: copy.deepcopy(value, memo) for name, value in self.__getstate__().items()})
        return new

    def _differentiable(self) -> _Kept:
        # No field: it is nothing that a user reads, and a copy of it has no use.
        kept: _Kept | None = self.__dict__.get("_kept")
        if kept is None:
            raise ArgumentError("there is nothing to differentiate; call settle(..., derivatives=True) in this process")
        return kept

    def vjp(
        self,
        by_points: ArrayLike | None = None,
        by_frames: ArrayLike | None = None,
        *,
        by_energy: ArrayLike | None = None,
        progress: Progress | None = None,
    ) -> Gradient:
        """The derivatives of a loss by all arguments of `settle`, which was called with `derivatives=True`.

        `by_points` are the derivatives of the loss by `points` (loss per m), (H, P, 3); `by_frames` those by rotations of the
        frames at the nodes (loss per rad, world), (H, P, 3); `by_energy` those by `energy` (loss per J), (H,) or one for all. What is left
        out has no part in the loss. They are exact to rounding: by the adjoint of the equilibrium, not by differences.

        Raises `ArgumentError` without any of the three, for a wrong shape, and for the first number that is not finite.

        >>> rest = settle(0.1, curl_radius=0.01, curl_pitch=0.02, derivatives=True)
        >>> height_of_the_tip = np.zeros((1, 16, 3))
        >>> height_of_the_tip[:, -1, 2] = 1
        >>> bool(rest.vjp(height_of_the_tip).density[0] < 0)
        True
        >>> bool(rest.vjp(by_energy=1.0).gravity[0] < 0)              # the tip is lower than the root
        True
        """
        kept = self._differentiable()
        if by_points is None and by_frames is None and by_energy is None:
            raise ArgumentError("there is no loss: give by_points, by_frames or by_energy")
        shape = (len(self), kept.nodes, 3)
        points = None if by_points is None else _loss("by_points", by_points, shape)
        frames = None if by_frames is None else _loss("by_frames", by_frames, shape)
        energy = None if by_energy is None else _change("by_energy", _numbers("by_energy", by_energy), len(self))
        halves, table, regular, exists = kept.at_rest.vjp(points, frames, energy, progress)
        by_gravity, root, rotation, uniform, tangent, d1 = (table[:, first : first + 3] for first in range(8, 26, 3))
        strain, by_radius, by_pitch = uniform, None, None
        if kept.strains == 0:
            by_radius, by_pitch = _by_curl(uniform, kept.curl_radius, kept.curl_pitch)
        elif kept.strains > 1:
            weights = _knot_weights(halves.shape[1], kept.strains)
            strain = np.asarray(np.einsum("hnc,nk->hkc", halves, weights), dtype=np.float64)
        elif kept.knots:
            strain = uniform[:, np.newaxis]
        finite = np.ones(len(self), dtype=bool)
        # The table is looked at where it is made.
        for array in (by_radius, by_pitch):
            if array is not None:
                finite &= np.isfinite(array)
        return Gradient(
            length=table[:, 0],
            diameter=table[:, 1],
            axis_ratio=table[:, 2],
            youngs_modulus=table[:, 3],
            shear_modulus=table[:, 4],
            density=table[:, 5],
            gravity=table[:, 6],
            curl_radius=by_radius,
            curl_pitch=by_pitch,
            natural_strain=strain,
            root=root,
            tangent=tangent,
            d1=d1,
            root_rotation=rotation,
            half_strain=halves,
            gravity_vector=by_gravity,
            eigenvalue_bound=table[:, 7],
            regular=regular & finite,
            exists=exists,
        )

    def jvp(
        self,
        *,
        length: ArrayLike | None = None,
        diameter: ArrayLike | None = None,
        axis_ratio: ArrayLike | None = None,
        youngs_modulus: ArrayLike | None = None,
        shear_modulus: ArrayLike | None = None,
        density: ArrayLike | None = None,
        gravity: ArrayLike | None = None,
        gravity_vector: ArrayLike | None = None,
        curl_radius: ArrayLike | None = None,
        curl_pitch: ArrayLike | None = None,
        natural_strain: ArrayLike | None = None,
        half_strain: ArrayLike | None = None,
        root: ArrayLike | None = None,
        tangent: ArrayLike | None = None,
        d1: ArrayLike | None = None,
        root_rotation: ArrayLike | None = None,
        progress: Progress | None = None,
    ) -> Motion:
        """How the nodes move along changes of the arguments of `settle`, which was called with `derivatives=True`.

        Each argument is a change in its unit, in the shape of the same field of `Gradient` or one for all rods: a number or (H,), (3,) or
        (H, 3), and for `natural_strain` (3,), (H, 3) or, at the K knots that were given, (H, K, 3). Changes of several arguments
        add up. The products are exact to rounding: of them and a loss, as the derivatives of that loss by `vjp` and the changes.

        >>> rest = settle(0.1, curl_radius=0.01, curl_pitch=0.02, derivatives=True)
        >>> bool(rest.jvp(density=1.0).points[0, -1, 2] < 0)              # m per kg/m³: the tip of a heavier hair is lower
        True
        """
        kept = self._differentiable()
        changes: dict[str, Any] = {}
        numbers = {
            "length": length, "diameter": diameter, "axis_ratio": axis_ratio, "youngs_modulus": youngs_modulus,
            "shear_modulus": shear_modulus, "density": density, "gravity": gravity, "curl_radius": curl_radius,
            "curl_pitch": curl_pitch,
        }
        vectors = {
            "gravity_vector": gravity_vector, "root": root, "tangent": tangent, "d1": d1, "root_rotation": root_rotation,
        }
        for name, value in numbers.items():
            changes[name] = None if value is None else _change(name, _numbers(name, value), len(self))
        for name, value in vectors.items():
            changes[name] = None if value is None else _change(name, _vectors(name, value), len(self))
        radius, pitch = changes.pop("curl_radius"), changes.pop("curl_pitch")
        if kept.strains and not (radius is None and pitch is None):
            raise ArgumentError("the rods have a natural_strain, and no curl_radius or curl_pitch to change")
        strain = None
        if radius is not None or pitch is not None:
            strain = _strain_of_curl(radius, pitch, kept.curl_radius, kept.curl_pitch)[:, np.newaxis]
        if natural_strain is not None:
            strain = _sum(strain, _by_halves(kept, _change("natural_strain", _profiles("natural_strain", natural_strain), len(self))))
        if half_strain is not None:
            halves = _change("half_strain", _profiles("half_strain", half_strain), len(self))
            if halves.shape[1] != 2 * (kept.nodes - 1):
                raise ArgumentError(f"half_strain has the shape {halves.shape}; it must be (H, {2 * (kept.nodes - 1)}, 3)")
            strain = _sum(strain, halves)
        changes["strain"] = strain
        return Motion(*kept.at_rest.jvp(changes, progress))


def _loss(name: str, value: ArrayLike, shape: tuple[int, int, int]) -> Float64:
    array = _array(name, value)
    if array.shape != shape:
        raise ArgumentError(f"{name} has the shape {array.shape}; it must be {shape}, as `points`")
    # Whether the numbers are finite is looked at where they are read.
    return array


def _change(name: str, value: Float64, count: int) -> Float64:
    """A change with a row for each rod, or one for all."""
    if len(value) not in (1, count):
        raise ArgumentError(f"{name} has {len(value)} values for {count} rods; it must have as many, or one")
    if not np.isfinite(value).all():
        index = tuple(int(i) for i in np.argwhere(~np.isfinite(value))[0])
        raise ArgumentError(f"{name}{list(index)} is {value[index]}; it must be finite")
    return value


def _sum(a: Float64 | None, b: Float64 | None) -> Float64 | None:
    if a is None or b is None:
        return b if a is None else a
    return np.asarray(a + b, dtype=np.float64)


def _strain_of_curl(
    by_radius: Float64 | None, by_pitch: Float64 | None, radius: Float64, pitch: Float64
) -> Float64:
    """The change of the strain of a helix, (H, 3), by changes of radius and pitch, (H,): the transpose of `_by_curl`."""
    away, twice = _curl_derivatives(radius, pitch)
    dr = 0.0 if by_radius is None else by_radius
    dp = 0.0 if by_pitch is None else by_pitch / (2 * np.pi)
    curvature, torsion = dr * away - dp * twice, -dr * twice - dp * away
    return np.asarray(np.stack([curvature, 0 * curvature, torsion], axis=1), dtype=np.float64)


def _by_halves(kept: _Kept, change: Float64) -> Float64:
    """The change of the natural strain of the halves of elements, (H, 2 elements, 3) or all along (H, 1, 3), by one of the argument."""
    if change.shape[1] == 1:
        return change
    if change.shape[1] != kept.strains:
        raise ArgumentError(f"natural_strain has {change.shape[1]} knots; the rods have {max(kept.strains, 1)}")
    weights = _knot_weights(2 * (kept.nodes - 1), kept.strains)
    return np.asarray(np.einsum("hkc,nk->hnc", change, weights), dtype=np.float64)


def _by_curl(by_strain: Float64, radius: Float64, pitch: Float64) -> tuple[Float64, Float64]:
    """The derivatives by radius and pitch of a helix, (H,), from those by its strain, (H, 3)."""
    away, twice = _curl_derivatives(radius, pitch)
    by_radius = by_strain[:, 0] * away - by_strain[:, 2] * twice
    by_p = -by_strain[:, 0] * twice - by_strain[:, 2] * away
    return by_radius, by_p / (2 * np.pi)


def _curl_derivatives(radius: Float64, pitch: Float64) -> tuple[Float64, Float64]:
    """The derivatives of the curvature R/(R² + p²) of a helix by R, and of p/(R² + p²) by R with the other sign; p is pitch/2π."""
    p = pitch / (2 * np.pi)
    # Infinitely far away nothing changes. Divided one by one: powers of a large radius are no numbers.
    finite = np.isfinite(radius)
    size = np.where(finite, np.hypot(radius, p), np.inf)
    r, p = np.where(finite, radius, 0.0) / size, p / size
    return (p**2 - r**2) / size / size, 2 * r * p / size / size


def _knot_weights(halves: int, knots: int) -> Float64:
    """How much the mean natural strain of each half of an element has of each knot, (halves, knots)."""
    # Linear between knots that divide the length evenly: integrals of the hat functions up to each end, in parts of the length.
    x = np.linspace(0, 1, halves + 1) * (knots - 1)
    segment = np.minimum(x.astype(int), knots - 2)
    t = x - segment
    index = np.arange(knots)
    whole = np.where(index < segment[:, np.newaxis], 0.5, 0.0)
    whole[:, 1:] += np.where(index[1:] <= segment[:, np.newaxis], 0.5, 0.0)
    rows = np.arange(halves + 1)
    whole[rows, segment] += t - t**2 / 2
    whole[rows, segment + 1] += t**2 / 2
    return np.asarray(np.diff(whole, axis=0) * halves / (knots - 1), dtype=np.float64)


@dataclass(frozen=True, eq=False, repr=False)
class Inverse:
    """The fibres that hang in H given shapes of P points.

    - `length` (H,), m.
    - `natural_strain` (H, P, 3), rad/m: natural curvatures about d1 and d2, and natural twist, at P knots that divide the length evenly.
    - `frame` (H, 3, 3): the frame of the root, rows d1, d2 and tangent, unit vectors.
    - `stable` (H,) bool: whether the fibre is stable in the given shape.
    - `error` (H,), m: largest distance of a given point from where the fibre rests.
    - `stiffness_needed` (H,): least factor on the stiffness with which the given shape is stable; 1 if it is stable as it is.

    Two results are equal if they are the same object: compare their arrays.
    """

    length: Float64
    natural_strain: Float64
    frame: Float64
    stable: NDArray[np.bool_]
    error: Float64
    stiffness_needed: Float64

    def __len__(self) -> int:
        return len(self.length)

    def __repr__(self) -> str:
        return f"<frisure.rods.Inverse: {int(self.stable.sum())} of {len(self)} fibres stable, natural_strain {self.natural_strain.shape}>"


def _numbers(name: str, value: ArrayLike) -> Float64:
    """(H,) or, for all rods, (1,)."""
    array = np.atleast_1d(_array(name, value))
    if array.ndim != 1:
        raise ArgumentError(f"{name} has the shape {array.shape}; it must be a number or (H,)")
    return array


def _vectors(name: str, value: ArrayLike) -> Float64:
    """(H, 3) or, for all rods, (1, 3)."""
    given = _array(name, value)
    array = np.atleast_2d(given)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ArgumentError(f"{name} has the shape {given.shape}; it must be (3,) or (H, 3)")
    _finite(name, given)
    return array


def _finite(name: str, given: Float64) -> None:
    """Refuses numbers that are none, by their index in what was given."""
    # Rows that are one and the same in memory are looked at once: there may be more of them than memory has room for.
    given = given[tuple(slice(0, 1) if step == 0 else slice(None) for step in given.strides)]
    if not np.isfinite(given).all():
        index = np.argwhere(~np.isfinite(given))[0]
        raise ArgumentError(f"{name}[{', '.join(map(str, index))}] is {given[tuple(index)]}; it must be finite")


def _profiles(name: str, value: ArrayLike) -> Float64:
    """Strains at K knots, (H, K, 3); from (3,) or (H, 3) at one knot."""
    given = array = _array(name, value)
    if array.ndim in (1, 2):
        array = np.atleast_2d(array)[:, np.newaxis, :]
    if array.ndim != 3 or array.shape[2] != 3 or array.shape[1] == 0:
        raise ArgumentError(f"{name} has the shape {given.shape}; it must be (3,), (H, 3) or (H, K, 3)")
    _finite(name, given)
    return array


def _count(arrays: Mapping[str, Float64]) -> int:
    """The number of rods H: every array has H rows, or one for all rods."""
    named = {name: len(array) for name, array in arrays.items() if len(array) != 1}
    if not named:
        return 1
    first = next(iter(named))
    for name, count in named.items():
        if count != named[first]:
            raise ArgumentError(f"{name} has {count} values and {first} has {named[first]}; they must have as many, or one")
    return named[first]


def _fibres(
    diameter: ArrayLike,
    axis_ratio: ArrayLike,
    youngs_modulus: ArrayLike,
    shear_modulus: ArrayLike,
    density: ArrayLike,
    gravity: ArrayLike,
) -> dict[str, Float64]:
    return {
        "diameter": _numbers("diameter", diameter),
        "axis_ratio": _numbers("axis_ratio", axis_ratio),
        "youngs_modulus": _numbers("youngs_modulus", youngs_modulus),
        "shear_modulus": _numbers("shear_modulus", shear_modulus),
        "density": _numbers("density", density),
        "gravity": _numbers("gravity", gravity),
    }


def settle(
    length: ArrayLike,
    *,
    diameter: ArrayLike = 70e-6,
    axis_ratio: ArrayLike = 1.0,
    youngs_modulus: ArrayLike = 3.9e9,
    shear_modulus: ArrayLike = 0.9e9,
    density: ArrayLike = 1300.0,
    gravity: ArrayLike = 9.81,
    curl_radius: ArrayLike | None = None,
    curl_pitch: ArrayLike | None = None,
    natural_strain: ArrayLike | None = None,
    root: ArrayLike = (0.0, 0.0, 0.0),
    tangent: ArrayLike = (1.0, 0.0, 0.0),
    d1: ArrayLike | None = None,
    elements: int = 15,
    tolerance: float = 1e-8,
    precision: Literal["double", "single"] = "double",
    points: bool = True,
    error: bool = False,
    eigenvalue: bool = False,
    frames: bool = False,
    derivatives: bool = False,
    progress: Progress | None = None,
) -> Settled:
    """The shapes in which H rods hang.

    Each argument is a number or a vector for all rods, or an array with a row for each, (H,) or (H, 3); contiguous or
    not, it is not copied if it is float64.

    - `length` (m); `diameter` (m), of the circle of the same area; `axis_ratio` of the section, at least 1.
    - `youngs_modulus`, `shear_modulus` (Pa), `density` (kg/m³), `gravity` (m/s², along -z). The defaults are those of the
      hair types.
    - The natural shape: straight; a helix with `curl_radius` (m, infinite for straight hair) and `curl_pitch` (m per turn, negative
      for a left-handed one, 0 for a circle); or `natural_strain` (rad/m): curvatures about d1 and d2 and twist, (3,), (H, 3), or
      (H, K, 3) at K knots that divide the length evenly.
    - The clamp: `root` (m), the `tangent` there, and `d1`, the direction of the section's longer axis; they
      need not be normalised, nor at right angles. By default d1 is y, and x where the tangent is along y.
    - `elements` of each rod: 3.5 per turn of a curl keep the middle one of many rods within some tenths of a millimetre, and nearly all within 3 mm; the error
      falls with the square of their number.
    - `tolerance`: the `gradient_norm` at which a rod is at rest, at most 1e-2. `precision="single"` iterates in single precision first,
      to the same result within the tolerance.
    - `points=False` leaves out the nodes; `error=True` estimates their error from a half and, where it divides, a quarter as many elements, which must be
      even: the estimate is infinite for rods that are not stable and where an element turns by more than half a turn with the natural
      curl, and does not know of other equilibria that only more elements have; `frames=True` adds the frames there.
    - `eigenvalue=True` adds the smallest eigenvalue of each rod; this takes three to four times as long as the rest.
    - `derivatives=True` keeps the rods for `Settled.vjp` and `Settled.jvp`, and brings them to rest to 1e-10 at least.

    Lengths may be 1 um to 100 m, diameters 10 nm to 10 cm, moduli 1 kPa to 10 TPa, gravity up to 10 000 m/s².

    Raises `ArgumentError` with the argument and the index of the first rod that cannot be made, and if the rods have no room in memory.
    """
    elements, precision = _options(elements, precision)
    if flag("error", error) and elements % 2:
        raise ArgumentError(f"elements is {elements}; with error=True it must be even")
    tolerance = real("tolerance", tolerance, "a number greater than 0, at most 1e-2", np.nextafter(0, 1), 1e-2)
    fibres = _fibres(diameter, axis_ratio, youngs_modulus, shear_modulus, density, gravity)
    clamped = _clamped(length, root, tangent, d1, curl_radius, curl_pitch, natural_strain)
    count = _count({name: array for name, array in (fibres | clamped).items() if array is not None})
    options = {
        "elements": elements,
        "tolerance": min(tolerance, EXACT) if flag("derivatives", derivatives) else tolerance,
        "single": precision == "single",
        "points": flag("points", points),
        "error": flag("error", error),
        "eigenvalue": flag("eigenvalue", eigenvalue),
        "frames": flag("frames", frames),
        "derivatives": flag("derivatives", derivatives),
    }
    arrays = settle_rods(count, fibres, clamped, options, progress)
    settled, rods = Settled(*arrays[:-1]), arrays[-1]
    if rods is not None and options["derivatives"]:
        # Copies: the caller may change the arguments before it asks for derivatives.
        radii, pitches = (clamped[name].copy() for name in ("curl_radius", "curl_pitch"))
        strains = 0 if natural_strain is None else clamped["natural_strain"].shape[1]
        knots = natural_strain is not None and np.ndim(natural_strain) == 3
        settled.__dict__["_kept"] = _Kept(rods, elements + 1, radii, pitches, strains, knots)
    return settled


def _options(elements: Any, precision: Any) -> tuple[int, Any]:
    if not isinstance(precision, str) or precision not in ("double", "single"):
        raise ArgumentError(f'precision is {precision!r}; it must be "double" or "single"')
    return whole("elements", elements, 1, MAX_ELEMENTS), precision


def _natural(given: Mapping[str, Any]) -> None:
    """Refuses a curl beside a natural strain, and a pitch of no curl; `given` has those that are given."""
    if "natural_strain" in given:
        for name in ("curl_radius", "curl_pitch"):
            if name in given:
                raise ArgumentError(f"{name} and natural_strain are both given; the natural shape is one or the other")
    elif "curl_pitch" in given and "curl_radius" not in given:
        raise ArgumentError("curl_pitch is given without curl_radius; a curl has both")


def _clamped(
    length: ArrayLike,
    root: ArrayLike,
    tangent: ArrayLike,
    d1: ArrayLike | None,
    curl_radius: ArrayLike | None,
    curl_pitch: ArrayLike | None,
    natural_strain: ArrayLike | None,
) -> dict[str, Any]:
    natural = {"curl_radius": curl_radius, "curl_pitch": curl_pitch, "natural_strain": natural_strain}
    _natural({name: value for name, value in natural.items() if value is not None})
    along = _vectors("tangent", tangent)
    return {
        "length": _numbers("length", length),
        "root": _vectors("root", root),
        "tangent": along,
        "d1": _across(along) if d1 is None else _vectors("d1", d1),
        "curl_radius": _numbers("curl_radius", np.inf if curl_radius is None else curl_radius),
        "curl_pitch": _numbers("curl_pitch", 0.0 if curl_pitch is None else curl_pitch),
        "natural_strain": None if natural_strain is None else _profiles("natural_strain", natural_strain),
    }


def _across(tangent: Float64) -> Float64:
    """The d1 of those that are given none, (1, 3) or (H, 3): y, or x where the tangent is along y."""
    y = np.array([[0.0, 1.0, 0.0]])
    aside = np.maximum(np.abs(tangent[:, 0]), np.abs(tangent[:, 2]))
    along = (aside <= 1e-6 * np.abs(tangent[:, 1])) & (tangent[:, 1] != 0)
    if not along.any():
        return y
    return np.where(along[:, np.newaxis], [[1.0, 0.0, 0.0]], y)


def _check(arguments: dict[str, Any]) -> None:
    """Checks arguments of `settle` without solving anything."""
    fibre = {name: arguments.get(name, value) for name, value in _FIBRE.items()}
    fibres = _fibres(**fibre)
    clamped = _clamped(
        arguments["length"],
        arguments.get("root", (0.0, 0.0, 0.0)),
        arguments.get("tangent", (1.0, 0.0, 0.0)),
        *(arguments.get(name) for name in ("d1", "curl_radius", "curl_pitch", "natural_strain")),
    )
    count = _count({name: array for name, array in (fibres | clamped).items() if array is not None})
    check_rods(count, fibres, clamped)


_FIBRE = {
    "diameter": 70e-6,
    "axis_ratio": 1.0,
    "youngs_modulus": 3.9e9,
    "shear_modulus": 0.9e9,
    "density": 1300.0,
    "gravity": 9.81,
}
"""The fibre of `settle` by default."""


def inverse(
    points: ArrayLike,
    *,
    diameter: ArrayLike = 70e-6,
    axis_ratio: ArrayLike = 1.0,
    youngs_modulus: ArrayLike = 3.9e9,
    shear_modulus: ArrayLike = 0.9e9,
    density: ArrayLike = 1300.0,
    gravity: ArrayLike = 9.81,
    accuracy: float = 1e-4,
    progress: Progress | None = None,
) -> Inverse:
    """The natural strains with which fibres hang in given shapes: inverse statics.

    `points` (m) are lines from root to tip, (H, P, 3) or (P, 3) for one, with P at least 2. The fibre is that of `settle`:
    each argument is a number or (H,). `accuracy` (m) is that of the equilibrium from which `error` is measured.

    A line says nothing of the turn of the sections about it; they are taken to turn as evenly as possible. A soft fibre
    cannot stand in every shape: see `stable` and `stiffness_needed`. This solves one line after another, on all
    threads, in milliseconds each for hair of 15 cm and in seconds for hair of a metre. A line whose weight is more than 1e8 times the
    stiffness of the fibre (ρSgL³/EI; a hair of a metre has 1e4) is an `ArgumentError`: mostly its points are not in metres.
    """
    given = lines = _array("points", points)
    if lines.ndim == 2:
        lines = lines[np.newaxis]
    if lines.ndim != 3 or lines.shape[2] != 3 or lines.shape[1] < 2:
        raise ArgumentError(f"points has the shape {given.shape}; it must be (P, 3) or (H, P, 3), P at least 2")
    _finite("points", given)
    fibres = _fibres(diameter, axis_ratio, youngs_modulus, shear_modulus, density, gravity)
    for name, array in fibres.items():
        if len(array) not in (1, len(lines)):
            raise ArgumentError(f"{name} has {len(array)} values for {len(lines)} lines; it must have as many, or one")
    accuracy = real("accuracy", accuracy, "a number between 1e-9 and 1 m", 1e-9, 1)
    return Inverse(*inverse_rods(lines, fibres, accuracy, progress))
