"""Where plants stand, MODEL 7.1: by density and seed, thinned by an image, or root by root."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ..arrays import Record
from ..bounds import PLANT_BYTES, Limits
from ..core import _native
from ..errors import DesirePathError
from ..tables import is_number
from .kinds import Kind, as_kind

SQUARE = 2.0  # side of the squares in which ground is planted [m]; the same seed gives each the same roots
MAX_PLANTS = 4_000_000  # of one planting


@dataclass(frozen=True, eq=False, repr=False)
class Planting(Record):
    """Plants of one kind on a ground: by density and seed, thinned by weight, or roots given outright.

    kind: a Kind, or a name in KINDS. density [1/m^2] > 0: None = the kind's own. seed: whole number >= 0; the same
    seed puts the same plants in the same places, whatever part of the ground is walked on.
    rectangle: (x0, y0, x1, y1) [m], where they may stand: None = everywhere on the ground.
    weight: (ny, nx), 0..1, over the rectangle, row 0 at the lowest y: thins the density; None = 1.
    roots: (n, 2) [m]: exactly these plants, in place of density, rectangle and weight.
    vigour: (n,) one for each of the roots, about -4 to 4: its reserves are exp(spread vigour) times the kind's;
    None = a number from the seed and the plant's place, as vigour_at() tells.
    """

    kind: Any  # a Kind, once it is made
    density: Any = None  # a number, once it is made
    seed: int = 0
    weight: np.ndarray | None = None
    rectangle: tuple | None = None
    roots: np.ndarray | None = None
    vigour: np.ndarray | None = None

    def __post_init__(self) -> None:
        put = functools.partial(object.__setattr__, self)
        put("kind", as_kind(self.kind))
        if self.density is not None and not (is_number(self.density) and 1e-6 <= self.density <= 1e5):
            raise DesirePathError(
                f"A density of {self.density} plants a m^2 cannot be planted: choose one from 1e-6 "
                "to 100000, or None for the kind's own."
            )
        put("density", float(self.kind.density if self.density is None else self.density))
        if isinstance(self.seed, bool) or not isinstance(self.seed, (int, np.integer)) or not 0 <= self.seed < 1 << 64:
            raise DesirePathError(f"A seed of {self.seed} cannot be used: choose a whole number from 0 to 2^64 - 1.")
        if self.rectangle is not None:
            box = tuple(float(value) for value in self.rectangle)
            if len(box) != 4 or not all(map(math.isfinite, box)) or box[0] >= box[2] or box[1] >= box[3]:
                raise DesirePathError(f"The rectangle {self.rectangle} holds no ground: give x0, y0, x1, y1 in metres.")
            put("rectangle", box)
        if self.weight is not None:
            weight = np.ascontiguousarray(self.weight, np.float32)
            if weight.ndim != 2 or 0 in weight.shape or self.rectangle is None:
                raise DesirePathError("The weight of a planting needs rows and columns, and a rectangle to lie over.")
            if not (np.isfinite(weight).all() and weight.min() >= 0):
                raise DesirePathError("The weight of a planting must be 0 to 1 everywhere: mend what is not.")
            put("weight", weight)
        if self.roots is not None:
            roots = np.ascontiguousarray(self.roots, np.float32)
            if roots.ndim != 2 or roots.shape[1] != 2 or not np.isfinite(roots).all():
                raise DesirePathError(f"Roots of shape {roots.shape} cannot be planted: give finite x, y [m], (n, 2).")
            put("roots", roots)
        if self.vigour is not None:
            vigour = np.ascontiguousarray(self.vigour, np.float32)
            if self.roots is None or vigour.shape != (len(self.roots),) or not (abs(vigour) <= 8).all():
                raise DesirePathError("The vigour of a planting needs roots, and one number from -8 to 8 for each.")
            put("vigour", vigour)
        super().__post_init__()

    def within(self, x0: float, y0: float, x1: float, y1: float) -> np.ndarray:
        """Roots (n, 2) float32 [m] of the squares that a rectangle [m] meets: what may stand there."""
        return self.in_squares(self.squares(x0, y0, x1, y1))

    def squares(self, x0: float, y0: float, x1: float, y1: float, limits: Limits = Limits()) -> list[tuple[int, int]]:
        """Squares (column, row) of `side` that a rectangle [m] and the planting's own have in common, if their plants
        keep the limits."""
        if self.roots is not None:
            return []
        if self.rectangle is not None:
            x0, y0 = max(x0, self.rectangle[0]), max(y0, self.rectangle[1])
            x1, y1 = min(x1, self.rectangle[2]), min(y1, self.rectangle[3])
        if x0 >= x1 or y0 >= y1:
            return []
        side = self.side
        columns = range(math.floor(x0 / side), math.ceil(x1 / side))
        rows = range(math.floor(y0 / side), math.ceil(y1 / side))
        plants = len(columns) * len(rows) * side**2 * self.density
        limits.check("plants", plants)
        limits.check("memory", PLANT_BYTES * plants)
        return [(column, row) for row in rows for column in columns]

    def in_squares(self, squares: Iterable[tuple[int, int]]) -> np.ndarray:
        """Roots (n, 2) float32 [m] that stand in squares."""
        known: dict[tuple[int, int], np.ndarray] = {}
        roots = np.concatenate([np.zeros((0, 2), np.float32)] + [self._square(at, known) for at in squares])
        if self.rectangle is not None:
            x0, y0, x1, y1 = self.rectangle
            inside = (roots[:, 0] >= x0) & (roots[:, 0] < x1) & (roots[:, 1] >= y0) & (roots[:, 1] < y1)
            roots = roots[inside]
        if self.weight is not None and len(roots):
            rows, columns = self.weight.shape
            i = np.clip(((roots[:, 0] - x0) / (x1 - x0) * columns).astype(int), 0, columns - 1)
            j = np.clip(((roots[:, 1] - y0) / (y1 - y0) * rows).astype(int), 0, rows - 1)
            roots = roots[_chances(self.seed, roots) < self.weight[j, i]]
        return np.ascontiguousarray(roots)

    def _square(self, at: tuple[int, int], known: dict[tuple[int, int], np.ndarray]) -> np.ndarray:
        """Roots (n, 2) of a whole square at (column, row), and of others it needs to know into `known`.

        Squares come in four turns, so that neighbours never have the same: each keeps its distance from those that
        had theirs before, and needs to know no others.
        """
        if at in known:
            return known[at]
        column, row = at
        turn, side = column % 2 + 2 * (row % 2), self.side
        apart = 1.0 / math.sqrt(self.density)
        low = np.array([column * side, row * side])
        around = [np.zeros((0, 2), np.float32)]
        for near in ((column + i, row + j) for j in (-1, 0, 1) for i in (-1, 0, 1)):
            if near[0] % 2 + 2 * (near[1] % 2) < turn:
                roots = self._square(near, known)
                around.append(roots[((roots > low - apart) & (roots < low + side + apart)).all(1)])
        given = np.concatenate(around)
        room = np.zeros((len(given) + int(side * side * self.density) + 2, 2), np.float32)
        room[: len(given)] = given
        count = _native.plants_place(
            *low, *(low + side), self.density, None, _mixed(self.seed, column, row), room, len(given)
        )
        known[at] = room[len(given) : count]
        return known[at]

    @property
    def side(self) -> float:
        """Side of the squares [m]: SQUARE, or twice that and so on for plants that stand far apart."""
        return SQUARE * 2.0 ** max(0, math.ceil(math.log2(4.0 / (SQUARE * math.sqrt(self.density)))))

    def parameters(self) -> dict[str, Any]:
        """What it is, for a report: numbers and words only."""
        numbers: dict[str, Any] = {"kind": asdict(self.kind), "density": self.density, "seed": int(self.seed)}
        if self.rectangle is not None:
            numbers["rectangle"] = list(self.rectangle)
        return numbers

    def arrays(self) -> list[np.ndarray]:
        """The arrays that tell one planting from another."""
        return [array for array in (self.weight, self.roots, self.vigour) if array is not None]


Plants = None | str | Kind | Planting | Iterable[str | Kind | Planting]  # what may be given for them


def as_plantings(plants: Plants) -> list[Planting]:
    """A list of Planting from one, one kind or its name, or a sequence of any of these."""
    if plants is None:
        return []
    if isinstance(plants, (str, Kind, Planting)):
        plants = [plants]
    return [planted if isinstance(planted, Planting) else Planting(planted) for planted in plants]


def seed_of(plantings: Iterable[Planting]) -> int:
    """One seed for what differs from plant to plant in a stand of several plantings."""
    seed = 0
    for planting in plantings:
        seed = _mixed(seed, int(planting.seed), 0)
    return seed


def _mixed(seed: int, a: int, b: int) -> int:
    """A seed from three whole numbers (splitmix64)."""
    for value in (a, b):
        seed = (int(seed) ^ (value & _WORD)) + 0x9E3779B97F4A7C15 & _WORD
        seed = (seed ^ seed >> 30) * 0xBF58476D1CE4E5B9 & _WORD
        seed = (seed ^ seed >> 27) * 0x94D049BB133111EB & _WORD
        seed ^= seed >> 31
    return seed


def _chances(seed: int, roots: np.ndarray) -> np.ndarray:
    """A number 0..1 for every root (n, 2), from its place."""
    mixed = roots.view(np.uint32).astype(np.uint64) * np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F], np.uint64)
    mixed = mixed[:, 0] ^ mixed[:, 1] ^ np.uint64(_mixed(seed, 1, 0))
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
        mixed = (mixed ^ mixed >> np.uint64(shift)) * np.uint64(factor)
    return (mixed >> np.uint64(11)).astype(float) / (1 << 53)


_WORD = (1 << 64) - 1
