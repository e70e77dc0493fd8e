"""What walkers did, told by arrays that stay as they are, and what must hold of them. MODEL 3.1

Arrays carry the names, units and shapes of DpGait in native/base/types.h: W walkers own L limbs,
L limbs own P parts, P parts own K contact points, all over T times. A Gait is one that is saved and carried elsewhere.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from ..arrays import Record
from ..bounds import Limits
from ..core import _native
from ..errors import DesirePathError
from . import mass_keys as masses
from . import tracks
from .tracks import Array, TrackArray

if TYPE_CHECKING:
    from typing import Self

    from numpy.typing import ArrayLike

HEEL, BALL, TIP = 0, 1, 2  # point_role
CONTACT_LAWS = ("sole", "uniform", "carve")  # DpContactLaw in native/soil/soil.h
AUTO = "auto"  # as the simulation goes by

MAX_FRAME = 1 << 31  # a frame's number may be
MAX_TIME, MAX_RATE = 1e12, 1e6  # [s], [1/s]
MAX_MASS = 1e7  # of a walker; the heaviest machines on feet would weigh less [kg]
NUMBERS = (  # name, type, shape by letters
    ("time", "f8", "T"),
    ("com", "f8", "WT3"),
    ("mass", "f8", "W"),
    ("pose", "f8", "PT7"),
    ("limb_walker", "i4", "L"),
    ("part_limb", "i4", "P"),
    ("point", "f8", "K3"),
    ("point_part", "i4", "K"),
    ("point_role", "i4", "K"),
)
NAMES = (("limb_name", "L"), ("part_name", "P"), ("walker_name", "W"))


def _nothing() -> np.ndarray:
    """No cuts, no jumps, no legs."""
    return np.empty(0)


@dataclass(frozen=True, eq=False, repr=False)
class Sole(Record):
    """What presses the ground, in its part's frame."""

    vertices: np.ndarray  # (n, 3) f4 [m]
    triangles: np.ndarray  # (m, 3) i4

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertices", np.ascontiguousarray(self.vertices, "f4"))
        object.__setattr__(self, "triangles", np.ascontiguousarray(self.triangles, "i4"))
        super().__post_init__()

    def __repr__(self) -> str:
        return f"Sole({len(self.vertices)} vertices, {len(self.triangles)} triangles)"


@dataclass(frozen=True, eq=False, repr=False)
class Recording(Record):
    """Walkers over time; check() refuses what cannot be worked with."""

    time: np.ndarray  # (T,) [s], strictly increasing
    com: Array  # centre of mass (W, T, 3) [m]
    mass: np.ndarray  # (W,) [kg] > 0
    pose: Array  # x y z, unit quaternion w x y z, of each part (P, T, 7) [m, -]
    limb_walker: np.ndarray  # walker of each limb (L,)
    part_limb: np.ndarray  # limb of each part (P,)
    soles: tuple[Sole, ...]  # Sole of each part (P)
    point: np.ndarray  # contact points in their part's frame (K, 3) [m]
    point_part: np.ndarray  # (K,)
    point_role: np.ndarray  # HEEL, BALL or TIP (K,)
    limb_name: tuple[str, ...] = ()  # the foot bone's name (L)
    part_name: tuple[str, ...] = ()  # "heel", "toe" .. (P)
    walker_name: tuple[str, ...] = ()  # (W)
    frame_rate: float = 24.0  # scene frames a second
    frame_start: int = 1  # scene frame at time[0]
    warnings: tuple[str, ...] = ()
    cut: np.ndarray = field(default_factory=_nothing)  # samples at which a new piece begins, rising (C,)
    jump: np.ndarray = field(default_factory=_nothing)  # those at which one walker only jumps: sample, walker (J, 2)
    leg: np.ndarray = field(default_factory=_nothing)  # hips to ankles (W,) [m] > 0; empty: size.legs() finds it
    contact_law: tuple[str, ...] = ()  # how each walker presses: AUTO or one of CONTACT_LAWS (W); empty: AUTO for all
    mass_keys: masses.Keys = ()  # of each walker (time [s], mass [kg]) .., rising (W); empty: all keep their mass

    def __post_init__(self) -> None:
        for name, kind, _ in NUMBERS:
            value = getattr(self, name)
            if not isinstance(value, TrackArray):
                value = np.ascontiguousarray(value, kind)
            object.__setattr__(self, name, value)
        object.__setattr__(self, "cut", np.array(self.cut, "i8").reshape(-1))
        object.__setattr__(self, "jump", np.array(self.jump, "i8").reshape(-1, 2))
        object.__setattr__(self, "leg", np.array(self.leg, "f8").reshape(-1))
        object.__setattr__(self, "soles", tuple(self.soles))
        laws = tuple(str(law) for law in self.contact_law)
        object.__setattr__(self, "contact_law", laws if set(laws) - {AUTO} else ())
        object.__setattr__(self, "mass_keys", masses.taken(self.mass_keys))
        object.__setattr__(self, "warnings", tuple(str(w) for w in self.warnings))
        for name, letter in NAMES:
            names = tuple(str(n) for n in getattr(self, name))
            if not names:
                kind = {"L": "limb", "P": "part", "W": "walker"}[letter]
                names = tuple(f"{kind} {i + 1}" for i in range(self._count(letter)))
            object.__setattr__(self, name, names)
        object.__setattr__(self, "frame_rate", float(self.frame_rate))
        object.__setattr__(self, "frame_start", int(self.frame_start))
        super().__post_init__()

    def __repr__(self) -> str:
        counted = ((len(self.mass), "walker"), (len(self.limb_walker), "limb"), (len(self.time), "sample"))
        words = [f"{count} {word}{'' if count == 1 else 's'}" for count, word in counted]
        with contextlib.suppress(IndexError, TypeError, ValueError):  # one that check() would refuse is shown, too
            words.append(f"{self.time[-1] - self.time[0]:.6g} s")
            rate = self.rate()
            words.append("no even rate" if rate is None else f"{rate:.6g} a second")
        return f"{type(self).__name__}({', '.join(words)})"

    def _count(self, letter: str) -> int:
        source: np.ndarray = {
            "T": self.time,
            "W": self.mass,
            "L": self.limb_walker,
            "P": self.part_limb,
            "K": self.point_part,
        }[letter]
        return len(source) if source.ndim else 0

    @overload
    def frame(self, sample: int | np.integer[Any]) -> float: ...

    @overload
    def frame(self, sample: np.ndarray) -> np.ndarray: ...

    def frame(self, sample: Any) -> Any:
        """Scene frame of a sample, or of each of several (n,), a fraction between frames."""
        return self.frame_start + (self.time[sample] - self.time[0]) * self.frame_rate

    def bone(self, part: int) -> str:
        """The foot bone of a part's limb."""
        return str(self.limb_name[self.part_limb[part]])

    def carving(self) -> np.ndarray:
        """Which walkers press by "carve" (W,), whatever they weigh."""
        laws = self.contact_law or (AUTO,) * len(self.mass)
        return np.array([law == "carve" for law in laws], bool)

    # ---- pieces: between two cuts the motion is one ----------------------------------------------

    def pieces(self, cut: np.ndarray | None = None) -> list[tuple[int, int]]:
        """(first sample, sample after the last) of each piece, or of those that these cuts alone make."""
        ends = [0, *(self.cut if cut is None else cut).tolist(), len(self.time)]
        return list(zip(ends[:-1], ends[1:]))

    def cuts_of(self, walkers: ArrayLike) -> np.ndarray:
        """The cuts that these walkers have: those of all, and where they jump themselves."""
        own = self.jump[np.isin(self.jump[:, 1], walkers), 0]
        return self.cut[~np.isin(self.cut, self.jump[:, 0]) | np.isin(self.cut, own)]

    def by_piece(self, work: Callable[[np.ndarray], np.ndarray], values: np.ndarray) -> np.ndarray:
        """work() of the samples of each piece of values (T, ..), together again."""
        return np.concatenate([work(values[first:after]) for first, after in self.pieces()])

    def there(self, first: int, after: int) -> np.ndarray:
        """Numbers of the walkers that are there in samples first..after-1, rising."""
        if isinstance(self.com, TrackArray):
            return np.flatnonzero(self.com.there(first, after))
        return np.arange(len(self.mass))

    def stays(self, walker: int) -> list[tuple[int, int]]:
        """(first sample, sample after the last) of each piece of a walker in which it is there."""
        pieces = self.pieces(self.cuts_of([walker]))
        if not isinstance(self.com, TrackArray):
            return pieces
        spans = self.com.spans(walker)
        ends = np.array([b for _, b in spans])
        found = []
        for first, after in pieces:
            n = int(np.searchsorted(ends, after))
            if n < len(spans) and spans[n][0] <= first:
                found.append((first, after))
        return found

    def piece(self, first: int, after: int) -> Self:
        """Samples first..after-1, which hold no cut, as a recording of their own."""
        return replace(
            self,
            time=self.time[first:after],
            com=self.com[:, first:after],
            pose=self.pose[:, first:after],
            cut=_nothing(),
            jump=_nothing(),
            frame_start=round(self.frame(first)),
            warnings=(),
        )

    # ---- what a recording must be ------------------------------------------------------------

    def check(self) -> Self:
        """Refuse what cannot be worked with, naming bone and frame; return self."""
        for name, _, letters in NUMBERS:
            value = getattr(self, name)
            want = tuple(int(c) if c.isdigit() else self._count(c) for c in letters)
            if value.shape != want:
                raise DesirePathError(
                    f"The recording's {name} has shape {value.shape} where {want} is needed: record the walk again."
                )
        for name, letter in NAMES:
            if len(getattr(self, name)) != self._count(letter):
                raise DesirePathError(
                    f"The recording's {name} has {len(getattr(self, name))} entries where "
                    f"{self._count(letter)} are needed: record the walk again."
                )
        if len(self.soles) != self._count("P"):
            raise DesirePathError(
                f"The recording has {len(self.soles)} soles for {self._count('P')} parts: give one for each."
            )
        if not len(self.time):
            raise DesirePathError("The recording has no frames: choose a frame range in which the character walks.")
        if not len(self.part_limb) or not len(self.mass):
            raise DesirePathError("The recording has no feet: choose the foot bones and record again.")
        self._check_numbers()
        masses.check(self.mass_keys, self.walker_name, isinstance(self.com, TrackArray), MAX_MASS)
        self._check_owners()
        return self

    def _check_numbers(self) -> None:
        if len(self.cut) and (self.cut[0] < 1 or self.cut[-1] >= len(self.time) or (np.diff(self.cut) < 1).any()):
            raise DesirePathError(
                "The recording's cuts do not rise from its second sample to its last: record the walk again."
            )
        if not (np.isin(self.jump[:, 0], self.cut).all() and np.isin(self.jump[:, 1], range(len(self.mass))).all()):
            raise DesirePathError("The recording's jumps are not among its cuts and walkers: record the walk again.")
        if not np.isfinite(self.time).all() or (np.diff(self.time) <= 0).any():
            raise DesirePathError("The recording's times do not increase: record the walk again.")
        if abs(self.time).max() > MAX_TIME or not self.frame_rate <= MAX_RATE:
            raise DesirePathError(
                f"The recording reaches {abs(self.time).max():.3g} s at {self.frame_rate:g} frames a "
                "second, which no scene does: record the walk again."
            )
        if abs(self.frame_start) > MAX_FRAME:
            raise DesirePathError(
                f"The recording begins at frame {self.frame_start}, where no scene is: record the walk again."
            )
        if not (np.isfinite(self.frame_rate) and self.frame_rate > 0):
            raise DesirePathError(
                f"A frame rate of {self.frame_rate:g} cannot be used: set the scene's frames a second to more than 0."
            )
        for w, mass in enumerate(self.mass):
            if not 0 < mass <= MAX_MASS:
                raise DesirePathError(
                    f"{self.walker_name[w]} has a mass of {mass:g} kg: give it one above 0 and up to {MAX_MASS:g}."
                )
            bad = _broken(self.com, w, lambda at: ~np.isfinite(at).all(axis=1))
            if bad is not None:
                raise DesirePathError(
                    f"The mass centre of {self.walker_name[w]} has no finite position at frame "
                    f"{self.frame(bad):g}: mend the animation there or leave the frame "
                    "out."
                )
        if len(self.leg) not in (0, len(self.mass)) or not ((self.leg > 0) & np.isfinite(self.leg)).all():
            raise DesirePathError("The recording's legs have no length above 0 for each walker: record the walk again.")
        for law in self.contact_law:
            if law not in (AUTO, *CONTACT_LAWS):
                raise DesirePathError(f"There is no contact law '{law}': choose {AUTO} or {' or '.join(CONTACT_LAWS)}.")
        if len(self.contact_law) not in (0, len(self.mass)):
            raise DesirePathError(
                f"The recording has {len(self.contact_law)} contact laws for {len(self.mass)} walkers: give each one."
            )
        for p in range(len(self.part_limb)):
            bad = _broken(self.pose, p, lambda at: ~np.isfinite(at).all(axis=1))
            if bad is not None:
                raise DesirePathError(
                    f"Bone {self.bone(p)} has no finite position at frame "
                    f"{self.frame(bad):g}: mend the animation there or leave the frame "
                    "out."
                )
            bad = _broken(self.pose, p, lambda at: abs(np.linalg.norm(at[:, 3:], axis=1) - 1) > 1e-3)
            if bad is not None:
                raise DesirePathError(
                    f"Bone {self.bone(p)} has a broken rotation at frame {self.frame(bad):g}: record the walk again."
                )
            sole = self.soles[p]
            if not len(sole.triangles) or not np.isfinite(sole.vertices).all():
                raise DesirePathError(
                    f"The sole of bone {self.bone(p)} has no faces or a broken vertex: choose another sole."
                )
            if sole.triangles.min() < 0 or sole.triangles.max() >= len(sole.vertices):
                raise DesirePathError(
                    f"The sole of bone {self.bone(p)} has a face without its vertices: choose another sole."
                )
        if not np.isfinite(self.point).all():
            bad = int(np.argmin(np.isfinite(self.point).all(axis=1)))
            raise DesirePathError(f"The recording's contact point {bad} has no finite position: record the walk again.")

    def _check_owners(self) -> None:
        for name, owners, count in (
            ("limb_walker", self.limb_walker, len(self.mass)),
            ("part_limb", self.part_limb, len(self.limb_walker)),
            ("point_part", self.point_part, len(self.part_limb)),
            ("point_role", self.point_role, 3),
        ):
            if len(owners) and (owners.min() < 0 or owners.max() >= count):
                bad = int(np.argmax((owners < 0) | (owners >= count)))
                raise DesirePathError(
                    f"The recording's {name} says {owners[bad]} at {bad}, where 0 to {count - 1} are there: record the "
                    "walk again."
                )
        for part in sorted(set(range(len(self.part_limb))) - set(self.point_part.tolist())):
            raise DesirePathError(
                f"Part {part} of the recording, of bone {self.bone(part)}, has no contact point: give it one."
            )

    def only(self, walkers: ArrayLike) -> Self:
        """Some walkers of the recording, by their numbers, rising."""
        walkers = np.asarray(walkers)
        if not np.isin(walkers, np.arange(len(self.mass))).all() or (np.diff(walkers) <= 0).any():
            raise DesirePathError(
                f"Walkers {walkers.tolist()} cannot be taken of {len(self.mass)}: give their numbers from 0 on, rising."
            )
        limbs = np.flatnonzero(np.isin(self.limb_walker, walkers))
        parts = np.flatnonzero(np.isin(self.part_limb, limbs))
        points = np.flatnonzero(np.isin(self.point_part, parts))
        jump = self.jump[np.isin(self.jump[:, 1], walkers)]
        jump[:, 1] = np.searchsorted(walkers, jump[:, 1])
        return replace(
            self,
            cut=self.cuts_of(walkers),
            jump=jump,
            com=tracks.some(self.com, walkers),
            mass=self.mass[walkers],
            mass_keys=tuple(self.mass_keys[w] for w in walkers) if self.mass_keys else (),
            pose=tracks.some(self.pose, parts),
            leg=self.leg[walkers] if len(self.leg) else _nothing(),
            contact_law=tuple(self.contact_law[w] for w in walkers) if self.contact_law else (),
            limb_walker=np.searchsorted(walkers, self.limb_walker[limbs]),
            part_limb=np.searchsorted(limbs, self.part_limb[parts]),
            soles=tuple(self.soles[p] for p in parts),
            point=self.point[points],
            point_part=np.searchsorted(parts, self.point_part[points]),
            point_role=self.point_role[points],
            limb_name=tuple(self.limb_name[limb] for limb in limbs),
            part_name=tuple(self.part_name[p] for p in parts),
            walker_name=tuple(self.walker_name[w] for w in walkers),
        )

    def rate(self) -> float | None:
        """Samples a second if they are even within every piece, else None."""
        steps = np.delete(np.diff(self.time), self.cut - 1)
        if not len(steps):
            return None
        step = float(steps.mean())
        return 1.0 / step if abs(steps - step).max() < 1e-3 * step else None

    def evenly(self, rate: float) -> Self:
        """The recording at an even rate [1/s], as if it had neither cuts nor holds: Gait.resample() minds them."""
        asked = (self.time[-1] - self.time[0]) * rate + 1.0
        Limits().check("memory", asked * (24.0 * len(self.mass) + 56.0 * len(self.part_limb)))
        count = _native.resample_count(self.time[0], self.time[-1], float(rate))
        time = np.empty(count)
        com = np.empty((len(self.mass), count, 3))
        pose = np.empty((len(self.part_limb), count, 7))
        _native.resample(self.time, self.com, self.pose, float(rate), time, com, pose)
        return replace(self, time=time, com=com, pose=pose)


def _broken(array: Array, row: int, test: Callable[[np.ndarray], np.ndarray]) -> int | None:
    """The first sample of a row at which a test of its values (n, ..) says so; None: nowhere."""
    for first, values in tracks.pieces(array, row):
        bad = test(values)
        if bad.any():
            return first + int(bad.argmax())
    return None
