"""Ways that another program walked: a table frame,id,x,y, or JuPedSim's SQLite file. MODEL 12.7. Experimental.

recorded = Recorded(scene, read("station.sqlite"))
Crowd(recorded.scene, "station", ways=recorded).run()
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from .. import lazy
from ..core import _native
from ..errors import DesirePathError
from ..files import atomic_file, table
from .choice import Passage, kinds_of
from .scene import Scene
from .stays import Walked

sqlite3 = lazy.module("sqlite3")  # a Python may come without it

MAX_JUMP = 2.0  # a walker goes from sample to sample [m]
COLUMNS = ("frame", "id", "x", "y")
TABLE, PLACES = "trajectory_data", ("frame", "id", "pos_x", "pos_y")
MAGIC = b"SQLite format 3\0"
NAME = "recorded"  # where such walkers come from and go to


def read(path: str | os.PathLike[str]) -> list[np.ndarray]:
    """The path (n, 2) [m] of each walker of a file, in the order in which they come; a sentence for what is none."""
    path = os.fspath(path)
    try:
        with atomic_file.reader(path) as file:
            lite = file.read(len(MAGIC)) == MAGIC
    except FileNotFoundError:
        raise DesirePathError(f"There are no trajectories at {path}: check the path.") from None
    except (OSError, ValueError) as error:
        raise DesirePathError(
            f"{path} cannot be read ({getattr(error, 'strerror', None) or error}): give a table frame,id,x,y or a "
            "SQLite file of JuPedSim."
        ) from None
    rows = _rows(path) if lite else _lines(path)
    if not len(rows):
        raise DesirePathError(f"{path} holds no trajectory: nobody walked.")
    return _parted(path, rows)


def _rows(path: str) -> np.ndarray:
    """frame, id, x, y of a SQLite file (n, 4)."""
    problem: Any = None
    try:
        base = sqlite3.connect(f"{Path(path).resolve().as_uri()}?mode=ro", uri=True)
    except ImportError:
        raise DesirePathError(
            f"This Python cannot read {path}, for it has no SQLite: give a table frame,id,x,y."
        ) from None
    try:
        names = {row[1] for row in base.execute(f"PRAGMA table_info({TABLE})")}
        lacking = [name for name in PLACES if name not in names]
        if not names:
            raise DesirePathError(
                f"{path} is the database of another program, without a table {TABLE}: give one that JuPedSim wrote."
            )
        if lacking:
            raise DesirePathError(
                f"The table {TABLE} of {path} has no column {lacking[0]}: give one that JuPedSim wrote."
            )
        found = base.execute(f"SELECT {', '.join(PLACES)} FROM {TABLE}").fetchall()
    except sqlite3.Error as error:
        problem = error
    finally:
        base.close()
    if problem is not None:
        raise DesirePathError(f"The database {path} is damaged ({problem}): write it again.")
    return _numbers(path, found, "row {} of its table")


def _lines(path: str) -> np.ndarray:
    """frame, id, x, y of a table (n, 4)."""
    names, rows = table.read(path, COLUMNS)
    unknown = [name for name in names if name not in COLUMNS]
    if unknown:
        raise DesirePathError(f"{path} has a column '{unknown[0][:40]}', of which nothing is known: keep frame,id,x,y.")
    order = [names.index(name) for name in COLUMNS]
    return _numbers(path, [[row[k] if k < len(row) else "" for k in order] for row in rows], "line {} of it")


def _numbers(path: str, rows: Sequence[Sequence[Any]], where: str) -> np.ndarray:
    first = 2 if "line" in where else 1
    try:
        found = np.array(rows, float).reshape(len(rows), 4)
        good = np.isfinite(found).all(axis=1) & (found[:, :2] == np.round(found[:, :2])).all(axis=1)
        bad = int(np.argmin(good)) if not good.all() else -1
    except (TypeError, ValueError):
        found, bad = np.zeros((0, 4)), next(n for n, row in enumerate(rows) if not _is_row(row))
    if bad >= 0:
        raise DesirePathError(
            f"{path} is no trajectory, {where.format(bad + first)} is not a frame, an id and a place: mend it."
        )
    return found


def _is_row(row: Sequence[Any]) -> bool:
    try:
        return len([float(each) for each in row]) == 4
    except (TypeError, ValueError):
        return False


def _parted(path: str, rows: np.ndarray) -> list[np.ndarray]:
    """The paths of walkers, who comes first first."""
    rows = rows[np.lexsort((rows[:, 0], rows[:, 1]))]
    begins = np.r_[0, np.flatnonzero(np.diff(rows[:, 1])) + 1]
    steps = np.diff(rows[:, 0])
    steps = steps[np.diff(rows[:, 1]) == 0]
    usual = float(np.median(steps)) if len(steps) else 1.0
    walks = [(part[0, 0], part[0, 1], _checked(path, part, usual)) for part in np.split(rows, begins[1:])]
    return [walked for _, _, walked in sorted(walks, key=lambda walk: walk[:2])]


def _checked(path: str, part: np.ndarray, usual: float) -> np.ndarray:
    """Places of one walker; a sentence where it is in two at once, jumps, or is lost for a time."""
    frames, who = part[:, 0], int(part[0, 1])
    twice = np.flatnonzero(np.diff(frames) == 0)
    if len(twice):
        raise DesirePathError(f"Walker {who} of {path} is in two places in frame {int(frames[twice[0]])}: remove one.")
    far = np.hypot(*np.diff(part[:, 2:], axis=0).T)
    wild = np.flatnonzero(far > MAX_JUMP)
    if len(wild):
        at = int(wild[0])
        begin, end = int(frames[at]), int(frames[at + 1])
        what = f"jumps by {far[at]:.3g} m from frame {begin} to {end}"
        if end - begin > usual:
            what = f"is lost from frame {begin} to {end}, {far[at]:.3g} m farther on"
        raise DesirePathError(f"Walker {who} of {path} {what}: give those that come after an id of their own.")
    return part[:, 2:].copy()


class Recorded:
    """Trajectories in the place of walkers that choose, for Crowd; scene: the same, with as many passages."""

    def __init__(self, scene: Scene, trajectories: Iterable[np.ndarray]) -> None:
        self._ways = [np.asarray(walked, float) - scene.origin for walked in trajectories]
        self.scene = replace(scene, passages=len(self._ways)).check()
        self.names = [NAME]
        self.blocked, _, _ = scene.lie()
        self.digest = _native.digest(np.ascontiguousarray(np.concatenate(self._ways)))
        size = np.array(self.blocked.shape[::-1]) * scene.cell
        for walked in self._ways:
            out = ~((walked >= 0.0) & (walked < size)).all(axis=1)
            if out.any():
                x, y = walked[int(np.argmax(out))] + scene.origin
                raise DesirePathError(
                    f"A trajectory leaves the ground at ({x:g}, {y:g}): make that larger, by size and origin."
                )

    def passages(self, first: int, count: int) -> list[Passage]:
        return [Passage(n, kind, 0, 0, (0.0, 0.0)) for n, kind in enumerate(kinds_of(self.scene, first, count), first)]

    def ways(self, load: np.ndarray, passages: Iterable[Passage]) -> list[Walked]:
        return [Walked.straight(self._ways[each.number]) for each in passages]

    def direct(self, passage: Passage) -> float:
        """From end to end [m]."""
        walked = self._ways[passage.number]
        return float(np.hypot(*(walked[-1] - walked[0])))
