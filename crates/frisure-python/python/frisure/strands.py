"""Strands as arrays."""

from __future__ import annotations

import operator
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any, Union, overload

import numpy as np
from numpy.typing import NDArray

from frisure._check import shown
from frisure._frisure import Memory, StrandData
from frisure.errors import ArgumentError, ArgumentTypeError

Float32 = NDArray[np.float32]
UInt32 = NDArray[np.uint32]


def _array(memory: Memory) -> NDArray[Any]:
    """The array at some memory, without a copy."""
    return np.asarray(memory)


def _attribute(data: StrandData, name: str) -> NDArray[Any]:
    memory = data.attribute(name)
    assert memory is not None
    return _array(memory)


class Strands:
    """Many curves from root to tip: the drawn hairs or the guides of a hairstyle.

    With H strands of N points in all:

    - `points` (N, 3) float32, metres, one strand after the other;
    - `radii` (N,) float32, mean radius of the fibre at each point, metres;
    - `offsets` (H + 1,) uint32: strand h has the points `offsets[h]` to `offsets[h + 1]`, without the last;
    - `attributes`: arrays by name, (H,) or (H, k) for a value per strand, (N,) or (N, k) for a value per point.

    `strands[h]` are the points of one strand, and `strands.curves` all of them as (H, P, 3), where every strand has P
    points. No array is a copy, and none can be written to or replaced; `array.copy()` can.
    """

    points: Float32
    radii: Float32
    offsets: UInt32
    attributes: Mapping[str, Union[Float32, UInt32]]
    per_point: frozenset[str]
    """The names of the attributes with a value per point."""

    def __init__(self, data: StrandData) -> None:
        attributes = {name: _attribute(data, name) for name, _ in data.attributes()}
        per_point = frozenset(n for n, point in data.attributes() if point)
        self._set(_array(data.points()), _array(data.radii()), _array(data.offsets()), attributes, per_point)

    def _set(
        self,
        points: Float32,
        radii: Float32,
        offsets: UInt32,
        attributes: Mapping[str, Union[Float32, UInt32]],
        per_point: frozenset[str],
    ) -> None:
        found = {"points": points, "radii": radii, "offsets": offsets, "per_point": per_point}
        self.__dict__.update(found, attributes=MappingProxyType(dict(attributes)))

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"`{name}` of strands cannot be set: hair is changed by its scene and its steps")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"`{name}` of strands cannot be deleted")

    @property
    def counts(self) -> UInt32:
        """Number of points of each strand, (H,) uint32."""
        return np.diff(self.offsets)

    @property
    def curves(self) -> Float32:
        """Points (m) as (H, P, 3) float32, if every strand has as many points P; `ArgumentError` otherwise."""
        counts = self.counts
        if counts.size and np.any(counts != counts[0]):
            least, most = counts.min(), counts.max()
            raise ArgumentError(
                f"strands have {least} to {most} points each, and no array (H, P, 3); use `points` and `offsets`"
            )
        points = int(counts[0]) if counts.size else 0
        return self.points.reshape(len(self), points, 3)

    def __len__(self) -> int:
        return int(self.offsets.size) - 1

    @overload
    def __getitem__(self, strand: int) -> Float32: ...
    @overload
    def __getitem__(self, strand: slice) -> list[Float32]: ...
    def __getitem__(self, strand: int | slice) -> Float32 | list[Float32]:
        if isinstance(strand, slice):
            return [self[i] for i in range(*strand.indices(len(self)))]
        try:
            place = operator.index(strand)
        except TypeError:
            raise ArgumentTypeError(f"the index of a strand is {shown(strand)}; it must be a whole number or a slice") from None
        index = place + len(self) if place < 0 else place
        if not 0 <= index < len(self):
            raise IndexError(f"strand {place} of {len(self)}")
        return self.points[self.offsets[index] : self.offsets[index + 1]]

    def __iter__(self) -> Iterator[Float32]:
        return (self[i] for i in range(len(self)))

    def __contains__(self, strand: object) -> bool:
        # Python would compare arrays.
        raise ArgumentTypeError("strands are found by their index: `strands[h]`, with h below `len(strands)`")

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.points, self.radii, self.offsets, dict(self.attributes), self.per_point)

    def __repr__(self) -> str:
        names = ", ".join(self.attributes)
        return f"<frisure.Strands: {len(self)} strands, {len(self.points)} points; {names}>"


def _restored(
    points: Float32,
    radii: Float32,
    offsets: UInt32,
    attributes: dict[str, Union[Float32, UInt32]],
    per_point: frozenset[str],
) -> Strands:
    """Strands that were pickled or copied, which own their arrays."""
    strands = Strands.__new__(Strands)
    strands._set(points, radii, offsets, attributes, per_point)
    for array in (points, radii, offsets, *attributes.values()):
        array.flags.writeable = False
    return strands
