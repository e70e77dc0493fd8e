"""The core, loaded when it is first asked for something: Blender lists and registers the add-on without it."""

import os
from concurrent.futures import ThreadPoolExecutor

from . import lazy

_native = lazy.module("._native", __package__)


def side_by_side(work, items, threads=0):
    """What work(item) gives for each item, in their order; so many at once, 0 = one for each processor.

    For work of the core, which lets go of Python while it computes.
    """
    with ThreadPoolExecutor(threads or os.cpu_count() or 1) as workers:
        yield from workers.map(work, items)
