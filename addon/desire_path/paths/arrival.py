"""How long it takes from everywhere to a goal, and in which direction. MODEL 12. Experimental: names may change.

    costs, goals --arrival--> times --direction--> unit vectors
                                |
                wear --pull-----+--descend--> the path of one walker

Fields are grids with x along a row and y from row to row. Cell (i, j), column i of row j, has its centre at
((i + 0.5) cell, (j + 0.5) cell). A cost is that of a metre; times are in metres of cost 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any
from warnings import warn

import numpy as np

from ..core import _native
from ..errors import DesirePathError

MAX_COST = 1e20  # of a metre; the least is 1 / MAX_COST
MAX_START = 1e30
MAX_CELLS = 2**31 - 1
MAX_INERTIA = 1e6  # [m]
CELLS = (1e-6, 1e6)  # how wide cells may be [m]


def field(values: Any, name: str) -> np.ndarray:
    """A grid as float32 (ny, nx), in C order; a sentence where it is none."""
    try:
        found = np.ascontiguousarray(values, np.float32)
    except (TypeError, ValueError):
        raise DesirePathError(f"{name} are numbers in rows and columns: give an array of them.") from None
    if np.ndim(values) != 2 or not found.size or (found.shape[0] + 8) * (found.shape[1] + 8) > MAX_CELLS:
        raise DesirePathError(
            f"{name} of shape {np.shape(values)} are no field: give rows and columns, of one cell to 2^31 in all."
        )
    return found


def check_cell(cell: float) -> float:
    """How wide a cell is, in a range that can be computed with [m]."""
    if not CELLS[0] <= cell <= CELLS[1]:
        raise DesirePathError(f"Cells cannot be {cell:g} m wide: give a number from {CELLS[0]:g} to {CELLS[1]:g}.")
    return float(cell)


def _check_costs(cost: np.ndarray) -> np.ndarray:
    """Which cells are free; a sentence where a cost is none."""
    free = ~(np.isnan(cost) | (cost == np.inf))
    wrong = free & ~((cost >= 1.0 / MAX_COST) & (cost <= MAX_COST))
    if wrong.any():
        j, i = np.argwhere(wrong)[0]
        raise DesirePathError(
            f"The cost of cell ({i}, {j}) is {cost[j, i]:g}: write a number above 0, at most {MAX_COST:g}, or inf for "
            "an obstacle."
        )
    if not free.any():
        raise DesirePathError("Every cell is an obstacle: write numbers where walkers may go.")
    return free


def _check_goals(goals: Any, free: np.ndarray) -> np.ndarray:
    """Goals as int32 (g,), j nx + i; a sentence for the first that is none."""
    found = np.asarray(goals)
    if not found.size:
        raise DesirePathError("There is no goal: name one cell at least, by its column and row.")
    if found.ndim != 2 or found.shape[1] != 2 or found.dtype.kind not in "iu":
        raise DesirePathError(
            f"Goals of shape {found.shape} and type {found.dtype} are no cells: give whole numbers, a column and a row "
            "for each."
        )
    ny, nx = free.shape
    inside = ((found >= 0) & (found < (nx, ny))).all(axis=1)
    if not inside.all():
        bad = int(np.argmin(inside))
        raise DesirePathError(
            f"Goal {bad}, cell ({found[bad, 0]}, {found[bad, 1]}), lies outside the field of {nx} x {ny} cells: move "
            "it."
        )
    open_ = free[found[:, 1], found[:, 0]]
    if not open_.all():
        bad = int(np.argmin(open_))
        raise DesirePathError(
            f"Goal {bad}, cell ({found[bad, 0]}, {found[bad, 1]}), lies in an obstacle: move it, or give that "
            "cell a cost."
        )
    return (found[:, 1].astype(np.int64) * nx + found[:, 0]).astype(np.int32)


def arrival(cost: Any, goals: Any, cell: float, starts: Any = None) -> np.ndarray:
    """How long it takes from each cell to the goal that is nearest, |grad T| = cost. MODEL 12.1

    cost: of a metre, > 0 (ny, nx); inf or NaN = an obstacle
    goals: cells, column and row of each, int (g, 2); see goal_around()
    cell: how wide cells are [m]
    starts: times at the goals, >= 0 (g,); each holds but where another goal is nearer by more than a cell; None = 0
    Returns float32 (ny, nx) in metres of cost 1: inf in obstacles and on islands, from which no way leads to a goal.
    Raises DesirePathError for a goal outside or in an obstacle, and for a cost, a start or a width that is none.
    """
    costs = field(cost, "Costs")
    cell = check_cell(cell)
    places = _check_goals(goals, _check_costs(costs))
    begin = np.zeros(len(places), np.float32) if starts is None else np.ascontiguousarray(starts, np.float32)
    if begin.shape != places.shape:
        raise DesirePathError(f"There are {len(places)} goals, and starts of shape {begin.shape}: give one for each.")
    good = (begin >= 0.0) & (begin <= MAX_START)
    if not good.all():
        bad = int(np.argmin(good))
        raise DesirePathError(f"Goal {bad} starts at {begin[bad]:g}: give a number from 0 to {MAX_START:g}.")
    time = np.empty_like(costs)
    _native.arrival(costs, cell, places, begin, time)
    return time


def goal_around(cost: Any, at: Sequence[float], radius: float, cell: float) -> tuple[np.ndarray, np.ndarray]:
    """The free cells around a place, as goals and starts for arrival(): times are then those to the place itself.

    at: x and y [m]; radius: how far around [m], a few cells: times are more exact the larger it is
    Returns cells int64 (g, 2), column and row, and starts float32 (g,): the distance times the cost there.
    Raises DesirePathError where no free cell has its centre within the radius.
    """
    costs = field(cost, "Costs")
    free = _check_costs(costs)
    cell = check_cell(cell)
    x, y = float(at[0]), float(at[1])
    rows, columns = np.arange(costs.shape[0])[:, None], np.arange(costs.shape[1])
    far = np.hypot((columns + 0.5) * cell - x, (rows + 0.5) * cell - y)
    j, i = np.nonzero((far <= radius) & free)
    if not len(i):
        raise DesirePathError(
            f"No free cell lies within {radius:g} m around ({x:g}, {y:g}): move the goal, or make it wider."
        )
    return np.stack([i, j], axis=1), (far[j, i] * costs[j, i]).astype(np.float32)


def direction(time: Any, cell: float) -> np.ndarray:
    """The direction in which times of arrival() fall steepest: e = unit(-grad T). MODEL 12.2

    Returns float32 (ny, nx, 2), x and y of unit vectors; 0 in obstacles, on islands and at a goal.
    """
    times = field(time, "Times")
    out = np.empty((*times.shape, 2), np.float32)
    _native.direction(times, check_cell(cell), out)
    return out


def descend(
    time: Any,
    start: Sequence[float],
    cell: float,
    pull: Any = None,
    step: float | None = None,
    *,
    turn: Any = None,
    inertia: float = 0.0,
) -> np.ndarray:
    """The path of one walker from a place to the goal, down times of arrival(), pulled aside. MODEL 12.3, MODEL 12.5

    start: x and y [m]; pull: of pull(), float (ny, nx, 2), or None; step: its length, cell / 100 to cell [m];
    None = half a cell
    turn: by how much each step errs to the left (n,) [rad], again from the first when they end; None = no step errs
    inertia: over which length a heading is kept [m], 0 = not at all
    Returns float64 (n, 2) [m], the start first; the last lies in the cell of a goal. It ends at any pull.
    Raises DesirePathError where it starts outside, in an obstacle or on an island, and for a pull of 1 and more.
    """
    times = field(time, "Times")
    cell = check_cell(cell)
    ny, nx = times.shape
    x, y = float(start[0]), float(start[1])
    step = 0.5 * cell if step is None else float(step)
    if not 0.01 * cell < step <= cell:
        raise DesirePathError(
            f"Steps cannot be {step:g} m long where cells are {cell:g} m wide: give a number from {0.01 * cell:g} "
            f"to {cell:g}."
        )
    if not (0.0 <= x < nx * cell and 0.0 <= y < ny * cell):
        raise DesirePathError(
            f"({x:g}, {y:g}) lies outside the field of {nx * cell:g} x {ny * cell:g} m: start within it."
        )
    pulls = None
    if pull is not None:
        pulls = np.ascontiguousarray(pull, np.float32)
        if pulls.shape != (ny, nx, 2):
            raise DesirePathError(f"A pull of shape {pulls.shape} does not fit: it has to be {(ny, nx, 2)}.")
        most = float(np.hypot(pulls[..., 0], pulls[..., 1]).max())
        if not most < 1.0:
            raise DesirePathError(f"The pull is {most:g} long somewhere: keep it below 1, or nobody gets to the goal.")
    turns = None if turn is None else np.ascontiguousarray(turn, np.float32)
    if turns is not None and (turns.ndim != 1 or not np.isfinite(turns).all()):
        raise DesirePathError("Steps err by angles that are no row of numbers: give one for each step, in radians.")
    if not 0.0 <= inertia <= MAX_INERTIA:
        raise DesirePathError(f"A heading cannot be kept over {inertia:g} m: give 0 to {MAX_INERTIA:g}.")
    if not times[min(int(y / cell), ny - 1), min(int(x / cell), nx - 1)] < np.inf:
        raise DesirePathError(
            f"No way leads from ({x:g}, {y:g}) to the goal, for it lies in an obstacle or on an island: start "
            "elsewhere, or leave a gap."
        )
    return np.frombuffer(_native.descend(times, cell, pulls, x, y, step, turns, float(inertia)), np.float64).reshape(
        -1, 2
    )


def way(*given: Any, **named: Any) -> np.ndarray:
    """An old name of descend()."""
    warn("way is an old name: ask arrival.descend.", DeprecationWarning, stacklevel=2)
    return descend(*given, **named)
