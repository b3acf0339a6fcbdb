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

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from frisure._frisure import RodsAtRest, inverse_rods, settle_rods
from frisure.errors import ArgumentError

__all__ = ["Gradient", "Inverse", "Settled", "inverse", "settle"]

Float64 = NDArray[np.float64]
Progress = Callable[[str, float], object]

MAX_ELEMENTS = 10_000
"""Most elements of a rod."""

EXACT = 1e-10
"""Largest tolerance with derivatives: farther from rest they are slower to compute."""


@dataclass(frozen=True)
class Gradient:
    """The derivatives of a loss by what H rods are made of, one row for each rod, also where an argument of `settle` was
    one for all: its derivative is then the sum of the rows. Units are those of the loss over those of the argument."""

    length: Float64
    """(H,); all elements become longer in proportion, each with its natural strain."""
    diameter: Float64
    axis_ratio: Float64
    youngs_modulus: Float64
    shear_modulus: Float64
    density: Float64
    gravity: Float64
    """(H,)"""
    curl_radius: Float64 | None
    curl_pitch: Float64 | None
    """(H,); None with `natural_strain`."""
    natural_strain: Float64
    """By the argument, (H, 3) or (H, K, 3); (H, 3) with a curl: by a strain that is the same all along."""
    root: Float64
    tangent: Float64
    d1: Float64
    """(H, 3)"""
    root_rotation: Float64
    """By a rotation of the clamp about the root (loss per rad, world), (H, 3)."""
    half_strain: Float64
    """By the natural strain of each half of an element, (H, 2 elements, 3)."""
    eigenvalue_bound: Float64
    """At least the smallest eigenvalue of the second variation over that of the elastic energy, 1 without loads and 0 where
    stability is lost: the derivatives grow as one over it, (H,)."""
    regular: NDArray[np.bool_]
    """Whether the smallest eigenvalue itself is at least 1e-3; nearer to a loss of stability derivatives are large and hold for tiny
    changes only, (H,)."""
    exists: NDArray[np.bool_]
    """Whether the shape is a minimum and has derivatives; where not, they are zero, (H,)."""

    def __len__(self) -> int:
        return len(self.length)


@dataclass(frozen=True)
class _Kept:
    """What the derivatives of settled rods need."""

    at_rest: RodsAtRest
    nodes: int
    tangent: Float64
    d1: Float64
    curl_radius: Float64
    curl_pitch: Float64
    natural_strain: Float64 | None
    knots: bool
    """Whether the natural strain was given at knots, (H, K, 3)."""


@dataclass(frozen=True)
class Settled:
    """H rods at rest, with P = elements + 1 nodes each."""

    points: Float64 | None
    """Nodes from root to tip (m), (H, P, 3); None with `points=False`."""
    energy: Float64
    """Elastic energy and that of the weight (J), (H,)."""
    stable: NDArray[np.bool_]
    """Whether the shape is a minimum of the energy, (H,)."""
    gradient_norm: Float64
    """Largest derivative of the energy, as a fraction of the moment of the weight, (H,)."""
    iterations: NDArray[np.uint32]
    """Iterations of the solver, (H,)."""
    error: Float64 | None
    """Estimated largest error (m) of a node from the division into elements, (H,); None without `error=True`."""
    _kept: _Kept | None = field(default=None, repr=False, compare=False)

    def __len__(self) -> int:
        return len(self.energy)

    def __getstate__(self) -> dict[str, Any]:
        # What derivatives need stays in this process.
        return {**self.__dict__, "_kept": None}

    def vjp(
        self, by_points: ArrayLike, by_frames: ArrayLike | None = None, *, progress: Progress | None = None
    ) -> Gradient:
        """The derivatives of a loss by all arguments of `settle`, which was called with `derivatives=True`.

        `by_points` are the derivatives of the loss by `points` (loss per m), (H, P, 3); `by_frames` those by rotations of the
        frames at the nodes (loss per rad, world). They are exact to rounding: by the adjoint of the equilibrium, not by
        differences.

        >>> rest = settle(0.1, curl_radius=0.01, curl_pitch=0.02, derivatives=True)
        >>> height_of_the_tip = np.zeros((1, 16, 3))
        >>> height_of_the_tip[:, -1, 2] = 1
        >>> bool(rest.vjp(height_of_the_tip).density[0] < 0)
        True
        """
        kept = self._kept
        if kept is None:
            raise ArgumentError("there is nothing to differentiate; call settle(..., derivatives=True) in this process")
        shape = (len(self), kept.nodes, 3)
        loss = _loss("by_points", by_points, shape)
        frames = None if by_frames is None else _loss("by_frames", by_frames, shape)
        halves, vectors, material, section, numbers, flags = kept.at_rest.vjp(loss, frames, progress)
        _, root, rotation, _ = vectors
        length, gravity, bound = numbers
        uniform = np.asarray(halves.sum(axis=1), dtype=np.float64)
        strain, by_radius, by_pitch = uniform, None, None
        if kept.natural_strain is None:
            by_radius, by_pitch = _by_curl(uniform, kept.curl_radius, kept.curl_pitch)
        elif kept.natural_strain.shape[1] > 1:
            weights = _knot_weights(halves.shape[1], kept.natural_strain.shape[1])
            strain = np.asarray(np.einsum("hnc,nk->hkc", halves, weights), dtype=np.float64)
        elif kept.knots:
            strain = uniform[:, np.newaxis]
        tangent, d1 = _by_clamp(rotation, kept.tangent, kept.d1)
        return Gradient(
            length=length,
            diameter=section[:, 0],
            axis_ratio=section[:, 1],
            youngs_modulus=material[:, 0],
            shear_modulus=material[:, 1],
            density=material[:, 2],
            gravity=gravity,
            curl_radius=by_radius,
            curl_pitch=by_pitch,
            natural_strain=strain,
            root=root,
            tangent=tangent,
            d1=d1,
            root_rotation=rotation,
            half_strain=halves,
            eigenvalue_bound=bound,
            regular=flags[0],
            exists=flags[1],
        )


def _loss(name: str, value: ArrayLike, shape: tuple[int, int, int]) -> Float64:
    array = _array(name, value)
    if array.shape != shape:
        raise ArgumentError(f"{name} has the shape {array.shape}; it must be {shape}, as `points`")
    if not np.isfinite(array).all():
        index = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise ArgumentError(f"{name}{list(index)} is {array[index]}; it must be finite")
    return array


def _by_curl(by_strain: Float64, radius: Float64, pitch: Float64) -> tuple[Float64, Float64]:
    """The derivatives by radius and pitch of a helix, (H,), from those by its strain, (H, 3)."""
    # kappa1 = R/(R² + p²) and tau = p/(R² + p²) with p = pitch/2π; infinitely far away nothing changes.
    p = pitch / (2 * np.pi)
    finite = np.isfinite(radius)
    r = np.where(finite, radius, 1.0)
    square = (r**2 + p**2) ** 2
    away, twice = p**2 - r**2, 2 * r * p
    by_radius = np.where(finite, (by_strain[:, 0] * away - by_strain[:, 2] * twice) / square, 0.0)
    by_p = np.where(finite, (-by_strain[:, 0] * twice - by_strain[:, 2] * away) / square, 0.0)
    return by_radius, by_p / (2 * np.pi)


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


def _by_clamp(by_rotation: Float64, tangent: Float64, d1: Float64) -> tuple[Float64, Float64]:
    """The derivatives by the tangent and by d1, (H, 3), from those by a rotation of the frame that they make."""
    size = np.linalg.norm(tangent, axis=1, keepdims=True)
    t = tangent / size
    along = (d1 * t).sum(axis=1, keepdims=True)
    side = d1 - along * t
    width = np.linalg.norm(side, axis=1, keepdims=True)
    e1 = side / width
    e2 = np.cross(t, e1)
    about = [(by_rotation * axis).sum(axis=1, keepdims=True) for axis in (e1, e2, t)]
    # The tangent turns the frame about e1 and e2; d1, and the tangent by what of it d1 has, about the tangent.
    by_tangent = (-about[0] * e2 + about[1] * e1 - about[2] * along / width * e2) / size
    return by_tangent, np.broadcast_to(about[2] / width * e2, by_tangent.shape).copy()


@dataclass(frozen=True)
class Inverse:
    """The fibres that hang in H given shapes of P points."""

    length: Float64
    """Length (m), (H,)."""
    natural_strain: Float64
    """Natural curvatures about d1 and d2, and natural twist (rad/m), at P knots that divide the length evenly, (H, P, 3)."""
    frame: Float64
    """Frame of the root, rows d1, d2 and tangent, (H, 3, 3)."""
    stable: NDArray[np.bool_]
    """Whether the fibre is stable in the given shape, (H,)."""
    error: Float64
    """Largest distance (m) of a given point from where the fibre rests, (H,)."""
    stiffness_needed: Float64
    """Least factor on the stiffness with which the given shape is stable; 1 if it is stable as it is, (H,)."""

    def __len__(self) -> int:
        return len(self.length)


def _array(name: str, value: ArrayLike) -> Float64:
    """Real numbers as float64, without a copy where they are that already."""
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise ArgumentError(f"{name} is no array of numbers: {error}") from None
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} has the dtype {array.dtype}; it must be real numbers in SI units")
    return array.astype(np.float64, copy=False)


def _numbers(name: str, value: ArrayLike) -> Float64:
    """(H,) or, for all rods, (1,)."""
    array = np.atleast_1d(_array(name, value))
    if array.ndim != 1:
        raise ArgumentError(f"{name} has the shape {array.shape}; it must be a number or (H,)")
    return array


def _vectors(name: str, value: ArrayLike) -> Float64:
    """(H, 3) or, for all rods, (1, 3)."""
    array = np.atleast_2d(_array(name, value))
    if array.ndim != 2 or array.shape[1] != 3:
        raise ArgumentError(f"{name} has the shape {array.shape}; it must be (3,) or (H, 3)")
    return array


def _profiles(name: str, value: ArrayLike) -> Float64:
    """Strains at K knots, (H, K, 3); from (3,) or (H, 3) at one knot."""
    array = _array(name, value)
    if array.ndim in (1, 2):
        array = np.atleast_2d(array)[:, np.newaxis, :]
    if array.ndim != 3 or array.shape[2] != 3 or array.shape[1] == 0:
        raise ArgumentError(f"{name} has the shape {array.shape}; it must be (3,), (H, 3) or (H, K, 3)")
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
    curl_radius: ArrayLike = np.inf,
    curl_pitch: ArrayLike = 0.0,
    natural_strain: ArrayLike | None = None,
    root: ArrayLike = (0.0, 0.0, 0.0),
    tangent: ArrayLike = (1.0, 0.0, 0.0),
    d1: ArrayLike = (0.0, 1.0, 0.0),
    elements: int = 15,
    tolerance: float = 1e-8,
    precision: Literal["double", "single"] = "double",
    points: bool = True,
    error: bool = False,
    derivatives: bool = False,
    progress: Progress | None = None,
) -> Settled:
    """The shapes in which H rods hang.

    Each argument is a number or a vector for all rods, or an array with a row for each, (H,) or (H, 3); contiguous or
    not, it is not copied if it is float64.

    - `length` (m); `diameter` (m), of the circle of the same area; `axis_ratio` of the section, at least 1.
    - `youngs_modulus`, `shear_modulus` (Pa), `density` (kg/m³), `gravity` (m/s², along -z). The defaults are those of the
      hair types.
    - The natural shape: a helix with `curl_radius` (m, infinite for straight hair) and `curl_pitch` (m per turn, negative
      for a left-handed one); or `natural_strain` (rad/m): curvatures about d1 and d2 and twist, (3,), (H, 3), or
      (H, K, 3) at K knots that divide the length evenly.
    - The clamp: `root` (m), the `tangent` there, and `d1`, the direction of the section's longer axis; they
      need not be normalised, nor at right angles.
    - `elements` of each rod: 3.5 per turn of a curl keep the whole rod within some tenths of a millimetre.
    - `tolerance`: the `gradient_norm` at which a rod is at rest. `precision="single"` iterates in single precision first,
      to the same result within the tolerance.
    - `points=False` leaves out the nodes; `error=True` estimates their error from half as many elements.
    - `derivatives=True` keeps the rods for `Settled.vjp`, and brings them to rest to 1e-10 at least.

    Raises `ArgumentError` with the argument and the index of the first rod that cannot be made.
    """
    fibres = _fibres(diameter, axis_ratio, youngs_modulus, shear_modulus, density, gravity)
    clamped: dict[str, Any] = {
        "length": _numbers("length", length),
        "root": _vectors("root", root),
        "tangent": _vectors("tangent", tangent),
        "d1": _vectors("d1", d1),
        "curl_radius": _numbers("curl_radius", curl_radius),
        "curl_pitch": _numbers("curl_pitch", curl_pitch),
    }
    if natural_strain is not None:
        clamped["natural_strain"] = _profiles("natural_strain", natural_strain)
    count = _count(fibres | clamped)
    clamped.setdefault("natural_strain", None)
    if not 1 <= elements <= MAX_ELEMENTS:
        raise ArgumentError(f"elements is {elements}; it must be between 1 and {MAX_ELEMENTS}")
    if error and elements % 2:
        raise ArgumentError(f"elements is {elements}; with error=True it must be even")
    if not tolerance > 0:
        raise ArgumentError(f"tolerance is {tolerance}; it must be greater than 0")
    if precision not in ("double", "single"):
        raise ArgumentError(f'precision is {precision!r}; it must be "double" or "single"')
    options = {
        "elements": int(elements),
        "tolerance": min(float(tolerance), EXACT) if derivatives else float(tolerance),
        "single": precision == "single",
        "points": bool(points),
        "error": bool(error),
        "derivatives": bool(derivatives),
    }
    arrays = settle_rods(count, fibres, clamped, options, progress)
    rods = arrays[-1]
    kept = rods and _Kept(
        rods,
        elements + 1,
        clamped["tangent"],
        clamped["d1"],
        clamped["curl_radius"],
        clamped["curl_pitch"],
        clamped["natural_strain"],
        knots=np.ndim(natural_strain if natural_strain is not None else 0) == 3,
    )
    return Settled(*arrays[:-1], kept)


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
    threads, in milliseconds each.
    """
    lines = _array("points", points)
    if lines.ndim == 2:
        lines = lines[np.newaxis]
    if lines.ndim != 3 or lines.shape[2] != 3 or lines.shape[1] < 2:
        raise ArgumentError(f"points has the shape {lines.shape}; it must be (P, 3) or (H, P, 3), P at least 2")
    fibres = _fibres(diameter, axis_ratio, youngs_modulus, shear_modulus, density, gravity)
    for name, array in fibres.items():
        if len(array) not in (1, len(lines)):
            raise ArgumentError(f"{name} has {len(array)} values for {len(lines)} lines; it must have as many, or one")
    if not 1e-9 <= accuracy <= 1:
        raise ArgumentError(f"accuracy is {accuracy}; it must be between 1e-9 and 1 m")
    return Inverse(*inverse_rods(lines, fibres, float(accuracy), progress))
