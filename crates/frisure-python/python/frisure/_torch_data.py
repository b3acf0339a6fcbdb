"""Heads as a data set of PyTorch, for `frisure.data.torch_dataset`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Optional

import torch.distributed  # type: ignore[import-not-found, unused-ignore]
import torch.utils.data  # type: ignore[import-not-found, unused-ignore]

from frisure._check import whole

Rows = Callable[[Optional[int], tuple[int, int]], Iterator[dict[str, Any]]]
"""Makes the rows of an order and a shard."""


class TorchDataset(torch.utils.data.IterableDataset):  # type: ignore[misc, type-arg, unused-ignore]
    """Different rows in each worker of a loader, and in each process of `torch.distributed`."""

    def __init__(
        self,
        rows: Rows,
        shuffle: Optional[int],
        shard: Optional[tuple[int, int]],
        transform: Optional[Callable[[dict[str, Any]], Any]],
    ) -> None:
        super().__init__()
        self._rows = rows
        self._shuffle = shuffle
        self._shard = shard
        self._transform = transform
        self._epoch = 0

    def set_epoch(self, epoch: int) -> None:
        """Chooses another order for the next iteration, if rows are shuffled; the same in all processes."""
        self._epoch = whole("epoch", epoch, 0)

    def __iter__(self) -> Iterator[Any]:
        rank, processes = _process() if self._shard is None else self._shard
        worker = torch.utils.data.get_worker_info()
        place, workers = (worker.id, worker.num_workers) if worker else (0, 1)
        seed = None if self._shuffle is None else self._shuffle + self._epoch
        rows = self._rows(seed, (rank * workers + place, processes * workers))
        return rows if self._transform is None else map(self._transform, rows)


def _process() -> tuple[int, int]:
    """The rank of this process and how many there are."""
    distributed = torch.distributed
    if distributed.is_available() and distributed.is_initialized():
        return distributed.get_rank(), distributed.get_world_size()
    return 0, 1
