"""Checks of arguments, with errors that name them."""

from __future__ import annotations

import operator
import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from frisure._frisure import check_room
from frisure.errors import ArgumentError, ArgumentTypeError

Float64 = NDArray[np.float64]


def array(name: str, value: Any) -> Float64:
    """Real numbers as aligned float64, without a copy where they are that already."""
    unmasked(name, value)
    found = converted(name, value)
    if found.dtype.kind not in "fiu":
        raise ArgumentTypeError(f"{name} has the dtype {found.dtype}; it must be real numbers in SI units")
    if found.dtype != np.float64 or not found.flags.aligned:
        check_room(f"numbers of {name}", found.size, 8)
    # A field of a packed record is not aligned.
    return np.require(found, np.float64, ["ALIGNED"])


def converted(name: str, value: Any) -> NDArray[Any]:
    """A value as an array of whatever kind; NumPy would take the bools in a list of numbers for 0 and 1."""
    try:
        found = np.asarray(value)
    except (ValueError, TypeError, RuntimeError, NotImplementedError) as error:
        # What other packages say about arrays of theirs that are no plain ones.
        kind = ArgumentError if isinstance(error, ValueError) else ArgumentTypeError
        raise kind(f"{name} is no array of numbers: {error}") from None
    without_bools(name, value)
    return found


def without_bools(name: str, value: Any) -> None:
    """Refuses lists with bools in them."""
    if isinstance(value, (list, tuple)) and _has_bool(value, 3):
        raise ArgumentTypeError(f"{name} has bools in it; it must be real numbers in SI units")


def _has_bool(value: Any, deep: int) -> bool:
    """Whether a bool is in a list, or in lists in it so many levels deep."""
    if deep > 0 and isinstance(value, (list, tuple)):
        return any(_has_bool(part, deep - 1) for part in value)
    # Arrays in the list have a dtype, whichever package they are of.
    return isinstance(value, bool) or str(getattr(value, "dtype", "")) in ("bool", "torch.bool")


def unmasked(name: str, value: Any) -> None:
    """Refuses arrays of `numpy.ma`, and lists of them, in which a value is masked: NumPy would give the number beneath the mask."""
    if _is_masked(value, 3):
        raise ArgumentError(f"{name} has masked values; leave them out, or fill them (`filled()`)")


def _is_masked(value: Any, deep: int) -> bool:
    """Whether a value is masked in an array, or in lists of arrays so many levels deep: arguments have three dimensions at most."""
    if isinstance(value, np.ma.MaskedArray):
        return bool(np.ma.is_masked(value))
    listed = deep > 0 and isinstance(value, (list, tuple))
    return listed and any(_is_masked(part, deep - 1) for part in value)


def flag(name: str, value: Any) -> bool:
    """A bool of Python or NumPy."""
    if not isinstance(value, (bool, np.bool_)):
        raise ArgumentTypeError(f"{name} is {shown(value)}; it must be True or False")
    return bool(value)


def text(name: str, value: Any, allowed: str = "a text") -> str:
    """A text that has UTF-8; `allowed` says which."""
    if not isinstance(value, str):
        raise ArgumentTypeError(f"{name} is {shown(value)}; it must be {allowed}")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise _lone_surrogate(name, value) from None
    return value


def _lone_surrogate(name: str, value: Any) -> ArgumentError:
    return ArgumentError(f"{name} is {shown(value)}; it has a lone surrogate, which is no character")


def path(name: str, value: Any) -> Path:
    """The path of a file or a folder."""
    if not isinstance(value, (str, os.PathLike)):
        raise ArgumentTypeError(f"{name} is {shown(value)}; it must be a path")
    try:
        os.fsencode(value)
    except UnicodeEncodeError:
        raise _lone_surrogate(name, value) from None
    return Path(value)


def names(name: str, value: Any) -> list[str] | None:
    """A list of names, from any iterable of texts, or None."""
    if value is None:
        return None
    try:
        found = None if isinstance(value, str) else list(value)
    except TypeError:
        found = None
    if found is None or not all(isinstance(item, str) for item in found):
        raise ArgumentTypeError(f"{name} is {shown(value)}; it must be a list of names, or None for all")
    return found


def shown(value: Any) -> str:
    """A value as errors show it."""
    try:
        found = repr(value)
    except ValueError:
        # Python writes no whole number of more than 4300 digits.
        return f"of the type {type(value).__name__}"
    return found if len(found) <= 200 else f"{found[:200]}…"


def whole(name: str, value: Any, least: int, most: int | None = None) -> int:
    """A whole number in a range; bools and floats are none."""
    allowed = f"at least {least}" if most is None else f"between {least} and {most}"
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        number = operator.index(value)
    except TypeError:
        raise ArgumentTypeError(f"{name} is {shown(value)}; it must be a whole number, {allowed}") from None
    if number < least or most is not None and number > most:
        raise ArgumentError(f"{name} is {shown(value)}; it must be {allowed}")
    return number


def real(name: str, value: Any, allowed: str, least: float = -np.inf, most: float = np.inf) -> float:
    """A finite number in a range, which `allowed` tells."""
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise ArgumentTypeError(f"{name} is {shown(value)}; it must be {allowed}")
    try:
        found = float(value)
    except OverflowError:
        found = np.inf
    if not (np.isfinite(found) and least <= found <= most):
        raise ArgumentError(f"{name} is {shown(value)}; it must be {allowed}")
    return found
