"""Checks of arguments, with errors that name them."""

from __future__ import annotations

import operator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from frisure._frisure import check_room
from frisure.errors import ArgumentError

Float64 = NDArray[np.float64]


def array(name: str, value: Any) -> Float64:
    """Real numbers as aligned float64, without a copy where they are that already."""
    try:
        found = np.asarray(value)
    except ValueError as error:
        raise ArgumentError(f"{name} is no array of numbers: {error}") from None
    if found.dtype.kind not in "fiu":
        raise TypeError(f"{name} has the dtype {found.dtype}; it must be real numbers in SI units")
    if found.dtype != np.float64 or not found.flags.aligned:
        check_room(f"numbers of {name}", found.size, 8)
    # A field of a packed record is not aligned.
    return np.require(found, np.float64, ["ALIGNED"])


def whole(name: str, value: Any, least: int, most: int | None = None) -> int:
    """A whole number in a range; bools and floats are none."""
    allowed = f"at least {least}" if most is None else f"between {least} and {most}"
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        number = operator.index(value)
    except TypeError:
        raise ArgumentError(f"{name} is {value!r}; it must be a whole number, {allowed}") from None
    if number < least or most is not None and number > most:
        raise ArgumentError(f"{name} is {value!r}; it must be {allowed}")
    return number


def real(name: str, value: Any, allowed: str, least: float = -np.inf, most: float = np.inf) -> float:
    """A finite number in a range, which `allowed` tells."""
    number = isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool)
    if not (number and np.isfinite(value) and least <= value <= most):
        raise ArgumentError(f"{name} is {value!r}; it must be {allowed}")
    return float(value)
