"""Where the marks of a stamp lie along a drawn curve, and how a track is gone along. PEYRAT11, MODEL 3.8

    curve + Stamp + Marks ---lay---> Laid, pressed at once by bake/stamping.py, or as a motion by track.stamped()

What presses weighs something, or goes as deep as it is told.
"""

from __future__ import annotations

from dataclasses import dataclass
from statistics import NormalDist
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Record
from ..errors import DesirePathError
from ..loads.below import GroundHeights
from ..motion import rotation
from ..motion.recording import MAX_MASS
from . import stamps
from .pace import Pace, laid, land_of, left_of
from .path import Path
from .stamps import Stamp

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

SIDES = ("left", "right")
MAX_MARKS = 100_000  # marks of a track
LONGEST, SLOWEST, FASTEST = 1e4, 1e-3, 1e3  # a track's numbers may be: lengths [m], speeds [m/s]
DEEPEST = 10.0  # [m]
SIZES = 5  # that marks have whose size scatters


@dataclass(frozen=True)
class Drive:
    """How a track is gone along, whatever leaves it. None: as is usual for the stamp; wheels: 200 kg, 2 m/s."""

    mass: float | None = None  # that rests on a mark, or on all wheels together [kg] > 0
    depth: float | None = None  # marks are so deep, whatever presses weighs [m] > 0
    speed: float | None = None  # at the start of the curve [m/s] > 0
    end_speed: float | None = None  # and at its end, even in between; None: the same
    frame_rate: float = 24.0  # scene frames a second
    frame_start: int = 1
    name: str = "Track"


@dataclass(frozen=True)
class Marks:
    """Where the marks of a stamp lie. None: as is usual for the stamp."""

    spacing: float | None = None  # along the curve, at its first speed; it grows with the root of the speed [m] > 0
    count: int | None = None  # so many marks from end to end, instead of a spacing
    width: float | None = None  # between the lines of left and right marks [m] >= 0
    first: str = "left"
    size: float = 1.0  # times as large as usual > 0
    scatter: float = 0.0  # by how much sizes differ, a share, 0..0.5
    seed: int = 0  # of that


@dataclass(frozen=True, eq=False, repr=False)
class Laid(Record):
    """Marks of a stamp on the ground, in the order in which they are pressed."""

    stamp: Stamp
    path: Path
    pace: Pace
    time: np.ndarray  # when each is pressed (n,) [s]
    at: np.ndarray  # where it lies on the ground (n, 3) [m]
    turn: np.ndarray  # how, as matrices (n, 3, 3)
    left: np.ndarray  # of the left foot (n,)
    size: np.ndarray  # times as large as usual (n,)
    times: float  # the mean of that
    gap: float  # from a lone mark to the next, if there was one [s]
    mass: float  # that rests on each [kg] > 0
    depth: float  # how deep it is, whatever presses weighs; 0: as deep as the mass makes it [m]
    name: str

    def pressed_at(self) -> np.ndarray:
        """Where the stamp is when it is down (n, 3) [m]."""
        return np.asarray(self.at - self.depth * self.turn[:, :, 2])

    def pressed_pose(self) -> np.ndarray:
        """The same as poses (n, 7)."""
        return np.column_stack([self.pressed_at(), rotation.quaternion(self.turn)])

    def outlines(self) -> np.ndarray:
        """A rectangle around each mark (n, 4, 3) [m]."""
        sole = np.asarray(self.stamp.sole().vertices[:, :2], float)
        (x0, y0), (x1, y1) = sole.min(axis=0), sole.max(axis=0)
        corner = np.array([(x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)]) * self.size[:, None, None]
        corner[~self.left, :, 1] *= -1.0
        return np.asarray(self.at[:, None] + np.einsum("nij,ncj->nci", self.turn, corner))


def lay(
    curve: ArrayLike,
    stamp: str | Stamp = "boot",
    marks: Marks = Marks(),
    drive: Drive = Drive(),
    ground: GroundHeights = None,
) -> Laid:
    """Where the marks of a stamp lie along a curve (n, 2 or 3) [m], left and right in turn, turned as the curve goes.

    The first lies at the curve's start. ground: heights that marks lie on, sloping as it does, as for ground_below();
    None: level, at 0. Refuses bad input with a sentence.
    """
    path, stamp = path_of(curve), stamps.find(stamp)
    rate_of(drive)
    pace = Pace(path.length, *speeds_of(drive, stamp.speed))
    size = number_of("size", marks.size, stamps.SMALLEST / stamp.length, stamps.LARGEST / stamp.length, "times")
    width = stamp.width * size if marks.width is None else number_of("width", marks.width, 0.0, LONGEST)
    if marks.first not in SIDES:
        raise DesirePathError(f"There is no foot '{str(marks.first)[:40]}' to begin with: choose left or right.")
    spacing = _spacing(marks, stamp.spacing * size, pace)
    s = pace.marks(spacing, marks.count)
    side = np.where((np.arange(len(s)) % 2 == 0) == (marks.first == "left"), 1.0, -1.0)
    place, heading = path.at(s)
    place = place + (0.5 * width * side)[:, None] * left_of(heading)
    at, turn = laid(place, heading + stamp.toe_out * side, land_of(ground), 0.5 * stamp.length * size)
    return Laid(
        stamp=stamp,
        path=path,
        pace=pace,
        time=pace.time(s),
        at=at,
        turn=turn,
        left=side > 0.0,
        size=_sizes(marks, len(s)),
        times=size,
        gap=spacing / pace.start,
        mass=mass_of(drive, stamp.mass),
        depth=depth_of(drive),
        name=drive.name,
    )


# ---- along the curve ------------------------------------------------------------------------------


def _spacing(marks: Marks, usual: float, pace: Pace) -> float:
    """The first spacing [m], as it is told or as the count makes it."""
    if marks.count is not None:
        if not 1 <= marks.count <= MAX_MARKS:
            raise DesirePathError(f"{marks.count} marks cannot be made: give a number from 1 to {MAX_MARKS}.")
        if marks.spacing is not None:
            raise DesirePathError("A track has either a spacing or a number of marks: leave one of them out.")
        return pace.spacings(1.0) / max(marks.count - 1, 1)
    spacing = usual if marks.spacing is None else _above("spacing", marks.spacing, LONGEST)
    wanted = pace.spacings(spacing) + 1.0
    if wanted > MAX_MARKS:
        raise DesirePathError(f"This would be {wanted:.0f} marks, and {MAX_MARKS} are the most: give a larger spacing.")
    return spacing


def _sizes(marks: Marks, count: int) -> np.ndarray:
    """How large each mark is (n,), one of a few sizes, whose logarithms scatter normally."""
    scatter = number_of("scatter of sizes", marks.scatter, 0.0, 0.5, "")
    if not isinstance(marks.seed, (int, np.integer)) or not 0 <= marks.seed < 1 << 64:
        raise DesirePathError(f"A seed of {marks.seed} cannot be used: choose a whole number from 0 to 2^64 - 1.")
    z = np.array([NormalDist().inv_cdf((k + 0.5) / SIZES) for k in range(SIZES)])
    chosen = np.random.default_rng(marks.seed).integers(SIZES, size=count)
    return np.asarray(marks.size * np.exp(scatter * z / z.std())[chosen])


# ---- what is refused ------------------------------------------------------------------------------


def path_of(curve: ArrayLike) -> Path:
    try:
        rows = np.array(curve, float)
    except (TypeError, ValueError):
        return Path(curve)  # says what is wrong
    if rows.ndim == 2 and rows.shape[1:] == (3,) and len(rows) > 1 and np.isfinite(rows).all():
        wide = np.ptp(rows, axis=0)
        if wide[:2].max() < 1e-6 < wide[2]:
            raise DesirePathError("The curve stands upright, and no track goes along it: lay it over the ground.")
    return Path(curve)


def speeds_of(drive: Drive, usual: float) -> tuple[float, float]:
    start = usual if drive.speed is None else number_of("speed", drive.speed, SLOWEST, FASTEST, "m/s")
    return start, start if drive.end_speed is None else number_of("speed", drive.end_speed, SLOWEST, FASTEST, "m/s")


def depth_of(drive: Drive) -> float:
    if drive.depth is not None and drive.mass is not None:
        raise DesirePathError("A track has either a mass or a depth: leave one of them out.")
    return 0.0 if drive.depth is None else _above("depth", drive.depth, DEEPEST)


def mass_of(drive: Drive, usual: float) -> float:
    return usual if drive.mass is None else _above("mass", drive.mass, MAX_MASS, "kg")


def rate_of(drive: Drive) -> float:
    if not 0.0 < drive.frame_rate <= 1e4:
        raise DesirePathError(f"{drive.frame_rate:g} frames a second cannot be made: give a number above 0.")
    return drive.frame_rate


def _above(name: str, value: float, maximum: float, unit: str = "m") -> float:
    if not 0.0 < value <= maximum:
        raise DesirePathError(
            f"A track with a {name} of {value:g} {unit} is none: give one above 0 and up to {maximum:g}."
        )
    return float(value)


def number_of(name: str, value: float, minimum: float, maximum: float, unit: str = "m") -> float:
    if not minimum <= value <= maximum:
        text = f"{value:g} {unit}".strip()
        raise DesirePathError(f"A track with a {name} of {text} is none: give one from {minimum:.3g} to {maximum:.3g}.")
    return float(value)
