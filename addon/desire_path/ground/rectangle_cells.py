"""Rectangles of the world [m] and the cells of a ground that they have a part of."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import cast

from ..errors import DesirePathError

ON_EDGE = 1e-6  # a rectangle that ends so near to the edge of a cell ends there [cells]


def cells(rectangle: Sequence[float], cell: float, origin: Sequence[float]) -> tuple[int, int, int, int]:
    """Cells (i0, i1, j0, j1), ends left out, that a rectangle (x0, y0, x1, y1) [m] has a part of.

    cell: their size [m]; origin: where cell 0, 0 begins (x, y) [m]
    """
    try:
        x0, y0, x1, y1 = (float(value) for value in rectangle)
    except (TypeError, ValueError):
        raise DesirePathError(f"rectangle is {rectangle!r}: give x0, y0, x1, y1 in metres.") from None
    if not (all(map(math.isfinite, (x0, y0, x1, y1))) and x0 < x1 and y0 < y1):
        raise DesirePathError(
            f"The rectangle {x0:g}, {y0:g} to {x1:g}, {y1:g} holds no cells, or has no end: give finite "
            "x0 < x1 and y0 < y1 in metres, as box(reach()) does."
        )
    ox, oy = origin
    low = [math.floor((at - start) / cell + ON_EDGE) for at, start in ((x0, ox), (y0, oy))]
    high = [math.ceil((at - start) / cell - ON_EDGE) for at, start in ((x1, ox), (y1, oy))]
    return low[0], max(high[0], low[0] + 1), low[1], max(high[1], low[1] + 1)


def box(cells: Sequence[int], cell: float, origin: Sequence[float]) -> tuple[float, float, float, float]:
    """Rectangle (x0, y0, x1, y1) [m] of cells (i0, i1, j0, j1)."""
    i0, i1, j0, j1 = cells
    ox, oy = origin
    return ox + i0 * cell, oy + j0 * cell, ox + i1 * cell, oy + j1 * cell


def window(given: Sequence[object], cell: float, origin: Sequence[float]) -> tuple[int, int, int, int]:
    """Cells (i0, j0, nx, ny) of a rectangle [m] that is given alone, or as they are given one by one."""
    first, *more = given
    if all(each is None for each in more):
        i0, i1, j0, j1 = cells(cast("Sequence[float]", first), cell, origin)
        return i0, j0, i1 - i0, j1 - j0
    if any(each is None for each in more):
        raise DesirePathError("read() takes a rectangle (x0, y0, x1, y1) [m], or i0, j0, nx and ny: give all four.")
    i0, j0, nx, ny = (int(cast("int", each)) for each in given)
    if nx < 1 or ny < 1:
        raise DesirePathError(f"A window of {nx} x {ny} cells holds nothing: read at least one.")
    return i0, j0, nx, ny
