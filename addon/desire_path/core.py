"""The core, loaded when it is first asked for something: Blender lists and registers the add-on without it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from typing import Protocol, TypeVar

from . import lazy

_native = lazy.module("._native", __package__)
_futures = lazy.module("concurrent.futures")
Item = TypeVar("Item")
Result = TypeVar("Result")
Result_co = TypeVar("Result_co", covariant=True)


def side_by_side(work: Callable[[Item], Result], items: Iterable[Item], threads: int = 0) -> Iterator[Result]:
    """What work(item) gives for each item, in their order; so many at once, 0 = one for each processor.

    For work of the core, which lets go of Python while it computes.
    """
    with _futures.ThreadPoolExecutor(threads or os.cpu_count() or 1) as workers:
        yield from workers.map(work, items)


class Begun(Protocol[Result_co]):
    """Work that goes on beside others."""

    def done(self) -> bool: ...
    def result(self) -> Result_co: ...


def begun(work: Callable[..., Result], *given: object) -> Begun[Result]:
    """Begin work(*given) beside what goes on: done() tells whether it has come to its end, result() waits for it.

    For work of the core, which lets go of Python while it computes.
    """
    workers = _futures.ThreadPoolExecutor(1)
    try:
        return workers.submit(work, *given)
    finally:
        workers.shutdown(wait=False)
