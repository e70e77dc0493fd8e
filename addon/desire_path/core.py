"""The core, loaded when it is first asked for something: Blender lists and registers the add-on without it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

from . import lazy

_native = lazy.module("._native", __package__)
_futures = lazy.module("concurrent.futures")
Item = TypeVar("Item")
Result = TypeVar("Result")


def side_by_side(work: Callable[[Item], Result], items: Iterable[Item], threads: int = 0) -> Iterator[Result]:
    """What work(item) gives for each item, in their order; so many at once, 0 = one for each processor.

    For work of the core, which lets go of Python while it computes.
    """
    with _futures.ThreadPoolExecutor(threads or os.cpu_count() or 1) as workers:
        yield from workers.map(work, items)
