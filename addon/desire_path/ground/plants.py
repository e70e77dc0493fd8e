"""Plants, MODEL 7.1 and 9.2: kinds, as data in SI units that can be saved, changed and shared, and where they stand.

lawn = Planting(KINDS["lawn"], seed=3)                       # wherever the walk goes, 300 plants a m^2
meadow = Planting("meadow", weight=grid, rectangle=(0, 0, 8, 5))   # thinned by an image over 8 x 5 m
sim = Simulation(ground, soils, plants=[lawn, meadow])       # several kinds on one ground
bake = Bake(gait, ground, soils, folder, plants=[lawn])
"""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import read_only
from ..bounds import PLANT_BYTES, Limits
from ..core import _native
from ..errors import DesirePathError
from ..files import record
from ..tables import Number, check, is_number, table, with_numbers

FORMS = ("surface", "tuft")
YEAR = 365.25 * 86400.0  # [s]
_TAG, _VERSION = "desire_path_plant", 1  # of a kind's file


_NAMES = {"root_radius": "reach"}  # of the core's numbers, which say the same
_CORE = table(_native.plants_numbers())
# by name, in the core's order, and what it does not read
NUMBERS = MappingProxyType(
    {
        **table(_native.plants_numbers(), _NAMES),
        "density": Number("1/m^2", 1e-6, 1e9, 80.0, "of a stand, unless told otherwise"),
    }
)


@dataclass(frozen=True)
@with_numbers(NUMBERS)
class Kind:
    """One kind of plant. Its form is a "surface", the paper's, or a "tuft" of 2 or 3 crossed sheets of stems."""

    form: str = "surface"
    sheets: int = 2

    if TYPE_CHECKING:

        def __init__(self, form: str = "surface", sheets: int = 2, *numbers: float, **by_name: Any) -> None: ...
        def __getattr__(self, name: str) -> float: ...

    def __post_init__(self):
        if self.form not in FORMS:
            raise DesirePathError(f'There is no plant form "{str(self.form)[:40]}": choose surface or tuft.')
        if not isinstance(self.sheets, (int, np.integer)) or self.sheets not in (2, 3):
            raise DesirePathError(f"A tuft of {str(self.sheets)[:40]} sheets cannot be built: choose 2 or 3.")
        check(self, NUMBERS, "A plant's")
        if self.break_angle < self.degrade_angle:
            raise DesirePathError("A plant's break_angle lies below its degrade_angle: raise it.")
        rows, stems = self.height / self.spacing + 1, self.width / self.spacing + 1
        if rows > 64 or stems * (self.sheets if self.form == "tuft" else 1) > 96:
            raise DesirePathError(
                f"A plant {self.height:g} m high and {self.width:g} m wide has too many particles "
                f"{self.spacing:g} m apart: raise its spacing."
            )

    def numbers(self) -> dict[str, float]:
        """What the core reads of it, by the core's names; `form` is its place in FORMS."""
        numbers = {name: float(getattr(self, _NAMES.get(name, name))) for name in _CORE}
        return {"form": FORMS.index(self.form), "sheets": int(self.sheets), **numbers}

    def save(self, path):
        """Write this kind as JSON, whole or not at all."""
        record.save(self, path, _TAG, _VERSION, "plant kind")

    @staticmethod
    def load(path):
        """A kind that save() wrote; numbers it leaves out are those of the default kind."""
        return record.load(Kind, path, _TAG, _VERSION, "plant kind")


def _kind(height, width, spacing, sway, degrade_deg, break_deg, strength=0.1, *, curl_deg=0.0, hours=None, **more):
    if hours is not None:  # until strength that was lost is back, and trodden stems stand again
        more["recover_rate"] = strength / (3600.0 * hours)
    return Kind(
        height=height,
        width=width,
        depth=width,
        spacing=spacing,
        sway=sway,
        strength=strength,
        degrade_angle=math.radians(degrade_deg),
        break_angle=math.radians(break_deg),
        curl=math.radians(curl_deg),
        **more,
    )


# As printed in TRAIL Table 1, with its phi_max of 70 and 50 degrees: a boot folds stems of pieces 15 mm long farther
# than that, so that one pass over a lane leaves 62 and 59 per cent of it and 25 leave 3 and 1, where measured lanes
# keep 86. For looks, and to compare with.
PAPER: Mapping[str, Kind] = MappingProxyType(
    {"carex": _kind(0.10, 0.05, 0.015, 3.0, 10, 70, 0.10), "lycopodium": _kind(0.10, 0.05, 0.015, 3.5, 5, 50, 0.08)}
)

# Wear of carex follows `python -m desire_path fit tests/scenes/lanes/cole.csv --kind carex`, from the cover of Cole's
# lanes; how it grows again is fitted in the same way. tests/core/test_lane.py holds it to lanes of another seed, on
# cells of 1 and 2 cm. Lycopodium was not measured: it is carex with what tells the two apart in TRAIL Table 1, 0.8 of
# the reserve and wear from 5 degrees on.
#
# No kind here has the rupture angle of the table: with it no reserve can keep what the lanes keep (see PAPER). Stems
# break by wear alone, phi_max is 180 degrees, and have their reserve again after two weeks.
RESERVE, SPREAD = 2.95, 2.97
REGROWTH = {"regrow_rate": 0.77 / YEAR, "seed_share": 0.18}
TWO_WEEKS = 14 * 24.0  # [h]

# The others are for looks: heights and densities of common stands, sway falling with height (stems of cereals swing
# at about 1 Hz, short turf faster than the eye), and wear set by how well each is known to bear treading: some eighty
# footfalls for lawn grasses, three for ferns. Trodden turf stands again within the quarter of an hour, high grass
# within hours, straw and fronds hardly the next day.
_KINDS = {
    "carex": _kind(0.10, 0.05, 0.015, 3.0, 10, 180, RESERVE, spread=SPREAD, hours=TWO_WEEKS, **REGROWTH),
    "lycopodium": _kind(0.10, 0.05, 0.015, 3.5, 5, 180, 0.8 * RESERVE, spread=SPREAD, hours=TWO_WEEKS, **REGROWTH),
    "lawn": _kind(
        0.05,
        0.04,
        0.0125,
        6.0,
        20,
        180,
        0.4,
        form="tuft",
        radius=0.003,
        reach=0.08,
        full_density=150.0,
        density=300.0,
        modulus=12e6,
        hours=0.25,
        degrade_rate=0.007,
        spread=1.0,
    ),
    "meadow": _kind(
        0.30,
        0.08,
        0.04,
        1.8,
        15,
        180,
        0.2,
        form="tuft",
        sheets=3,
        curl_deg=6,
        radius=0.004,
        reach=0.18,
        full_density=30.0,
        density=60.0,
        hours=3.0,
        degrade_rate=0.012,
        spread=1.0,
    ),
    "wheat": _kind(
        0.80,
        0.06,
        0.06,
        1.1,
        12,
        180,
        0.1,
        form="tuft",
        curl_deg=1.0,
        radius=0.004,
        across=12.0,
        reach=0.12,
        full_density=50.0,
        density=100.0,
        modulus=6e6,
        hours=24.0,
        degrade_rate=0.03,
        spread=1.0,
    ),
    "moss": _kind(
        0.02,
        0.05,
        0.01,
        12.0,
        25,
        180,
        0.15,
        form="tuft",
        sheets=3,
        radius=0.003,
        damping=20.0,
        reach=0.06,
        full_density=250.0,
        density=500.0,
        modulus=2e6,
        hours=1.0,
        degrade_rate=0.01,
        spread=1.0,
    ),
    "fern": _kind(
        0.45,
        0.16,
        0.05,
        1.4,
        8,
        180,
        0.06,
        form="tuft",
        sheets=3,
        curl_deg=11,
        radius=0.006,
        across=10.0,
        reach=0.30,
        full_density=5.0,
        density=8.0,
        modulus=5e6,
        hours=24.0,
        degrade_rate=0.03,
        spread=1.0,
    ),
}
KINDS: Mapping[str, Kind] = MappingProxyType(_KINDS)  # by name, to be read: a kind of your own is a Kind


# ---- how they differ ---------------------------------------------------------------------------------------------

# Most plants of a kind are alike, a few give way at once, a few bear nearly anything: the density of their vigour z
# is as exp(-sqrt(|z| / c)), mean 0, deviation 1. Reserves are exp(spread z) times the kind's.
_VIGOUR = 120.0**-0.5  # c
MOST_VIGOUR = 8.0  # no plant is farther out


def share_below(vigour):
    """Share of plants, 0..1, whose vigour is below some; an array."""
    t = np.sqrt(abs(np.asarray(vigour, float)) / _VIGOUR)
    tail = 0.5 * (1.0 + t) * np.exp(-t)
    return np.where(np.asarray(vigour) < 0.0, tail, 1.0 - tail)


def vigour_at(share):
    """The vigour below which a share 0..1 of plants is, -8 to 8; an array. The inverse of share_below()."""
    share = np.asarray(share, float)
    far = -np.log(np.clip(2.0 * np.minimum(share, 1.0 - share), 1e-30, 1.0))
    t = far + np.sqrt(2.0 * far) + 1e-12  # beyond the root of t - log(1 + t) = far, from where Newton comes down
    for _ in range(8):
        t = t - (t - np.log1p(t) - far) * (1.0 + t) / t
        t = np.maximum(t, 1e-12)
    size = np.minimum(t * t * _VIGOUR, MOST_VIGOUR)
    return np.where(share < 0.5, -size, size)


# ---- where they stand ------------------------------------------------------------------------------------------

SQUARE = 2.0  # side of the squares in which ground is planted [m]; the same seed gives each the same roots
MOST_PLANTS = 4_000_000  # of one planting


@dataclass(frozen=True, eq=False)
class Planting:
    """Plants of one kind on a ground: by density and seed, thinned by weight, or roots given outright.

    kind: a Kind, or a name in KINDS. density [1/m^2] > 0: None = the kind's own. seed: whole number >= 0; the same
    seed puts the same plants in the same places, whatever part of the ground is walked on.
    rectangle: (x0, y0, x1, y1) [m], where they may stand: None = everywhere on the ground.
    weight: (ny, nx), 0..1, over the rectangle, row 0 at the lowest y: thins the density; None = 1.
    roots: (n, 2) [m]: exactly these plants, in place of density, rectangle and weight.
    vigour: (n,) one for each of the roots, about -4 to 4: its reserves are exp(spread vigour) times the kind's;
    None = a number from the seed and the plant's place, as vigour_at() tells.
    """

    kind: Kind
    density: float | None = None
    seed: int = 0
    weight: np.ndarray | None = None
    rectangle: tuple | None = None
    roots: np.ndarray | None = None
    vigour: np.ndarray | None = None

    def __post_init__(self):
        put = functools.partial(object.__setattr__, self)
        put("kind", as_kind(self.kind))
        if self.density is not None and not (is_number(self.density) and 1e-6 <= self.density <= 1e5):
            raise DesirePathError(
                f"A density of {self.density} plants a m^2 cannot be planted: choose one from 1e-6 "
                "to 100000, or None for the kind's own."
            )
        put("density", float(self.kind.density if self.density is None else self.density))
        if isinstance(self.seed, bool) or not isinstance(self.seed, (int, np.integer)) or not 0 <= self.seed < 1 << 64:
            raise DesirePathError(f"A seed of {self.seed} cannot be used: choose a whole number, 0 or more.")
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
            put("weight", read_only(weight))
        if self.roots is not None:
            roots = np.ascontiguousarray(self.roots, np.float32)
            if roots.ndim != 2 or roots.shape[1] != 2 or not np.isfinite(roots).all():
                raise DesirePathError(f"Roots of shape {roots.shape} cannot be planted: give finite x, y [m], (n, 2).")
            put("roots", read_only(roots))
        if self.vigour is not None:
            vigour = np.ascontiguousarray(self.vigour, np.float32)
            if self.roots is None or vigour.shape != (len(self.roots),) or not (abs(vigour) <= 8).all():
                raise DesirePathError("The vigour of a planting needs roots, and one number from -8 to 8 for each.")
            put("vigour", read_only(vigour))

    def within(self, x0, y0, x1, y1):
        """Roots (n, 2) float32 [m] of the squares that a rectangle [m] meets: what may stand there."""
        return self.in_squares(self.squares(x0, y0, x1, y1))

    def squares(self, x0, y0, x1, y1, limits=Limits()):
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

    def in_squares(self, squares):
        """Roots (n, 2) float32 [m] that stand in squares."""
        known = {}
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

    def _square(self, at, known):
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
        given = [np.zeros((0, 2), np.float32)]
        for near in ((column + i, row + j) for j in (-1, 0, 1) for i in (-1, 0, 1)):
            if near[0] % 2 + 2 * (near[1] % 2) < turn:
                roots = self._square(near, known)
                given.append(roots[((roots > low - apart) & (roots < low + side + apart)).all(1)])
        given = np.concatenate(given)
        room = np.zeros((len(given) + int(side * side * self.density) + 2, 2), np.float32)
        room[: len(given)] = given
        count = _native.plants_place(
            *low, *(low + side), self.density, None, _mixed(self.seed, column, row), room, len(given)
        )
        known[at] = room[len(given) : count]
        return known[at]

    @property
    def side(self):
        """Side of the squares [m]: SQUARE, or twice that and so on for plants that stand far apart."""
        return SQUARE * 2.0 ** max(0, math.ceil(math.log2(4.0 / (SQUARE * math.sqrt(self.density)))))

    def told(self):
        """What it is, for a report: numbers and words only."""
        told = {"kind": asdict(self.kind), "density": self.density, "seed": int(self.seed)}
        if self.rectangle is not None:
            told["rectangle"] = list(self.rectangle)
        return told

    def arrays(self):
        """The arrays that tell one planting from another."""
        return [array for array in (self.weight, self.roots, self.vigour) if array is not None]


def as_kind(kind):
    """A Kind from a Kind or the name of one."""
    if isinstance(kind, str):
        if kind not in KINDS:
            raise DesirePathError(f"There is no plant '{kind}': choose one of {', '.join(KINDS)}.")
        return KINDS[kind]
    if not isinstance(kind, Kind):
        raise DesirePathError(f"{kind!r} is no kind of plant: give a Kind or one of {', '.join(KINDS)}.")
    return kind


def as_plantings(plants):
    """A list of Planting from one, one kind or its name, or a sequence of any of these."""
    if plants is None:
        return []
    if isinstance(plants, (str, Kind, Planting)):
        plants = [plants]
    return [planted if isinstance(planted, Planting) else Planting(planted) for planted in plants]


def seed_of(plantings):
    """One seed for what differs from plant to plant in a stand of several plantings."""
    seed = 0
    for planting in plantings:
        seed = _mixed(seed, int(planting.seed), 0)
    return seed


def _mixed(seed, a, b):
    """A seed from three whole numbers (splitmix64)."""
    for value in (a, b):
        seed = (int(seed) ^ (value & _WORD)) + 0x9E3779B97F4A7C15 & _WORD
        seed = (seed ^ seed >> 30) * 0xBF58476D1CE4E5B9 & _WORD
        seed = (seed ^ seed >> 27) * 0x94D049BB133111EB & _WORD
        seed ^= seed >> 31
    return seed


def _chances(seed, roots):
    """A number 0..1 for every root (n, 2), from its place."""
    mixed = roots.view(np.uint32).astype(np.uint64) * np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F], np.uint64)
    mixed = mixed[:, 0] ^ mixed[:, 1] ^ np.uint64(_mixed(seed, 1, 0))
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
        mixed = (mixed ^ mixed >> np.uint64(shift)) * np.uint64(factor)
    return (mixed >> np.uint64(11)).astype(float) / (1 << 53)


_WORD = (1 << 64) - 1
