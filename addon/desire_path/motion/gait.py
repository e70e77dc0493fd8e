"""The recording of what the walkers did: everything after it runs without Blender. MODEL 3.1

Arrays carry the names, units and shapes of DpGait in native/base/types.h: W walkers own L limbs,
L limbs own P parts, P parts own K contact points, all over T times.
"""

from __future__ import annotations

import contextlib
import os
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import lazy
from ..arrays import Record, read_only
from ..bounds import Limits
from ..core import _native
from ..errors import DesirePathError
from ..files import atomic_file, npz
from ..keywords import fields_of
from . import freeze, size, tracks
from .scatter import Scatter
from .tracks import TrackArray

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

# what carries a recording elsewhere knows recordings: Gait.carried and Gait.along only name it
_cycle = lazy.module("..placement.cycle", __package__)
_passes = lazy.module("..placement.passes", __package__)

HEEL, BALL, TIP = 0, 1, 2  # point_role

MOST_FRAME = 1 << 31  # a frame's number may be
MOST_TIME, MOST_RATE = 1e12, 1e6  # [s], [1/s]
MOST_MASS = 1e7  # of a walker; the heaviest machines on feet would weigh less [kg]
_VERSION = 1
_TRACKS = 2  # of a recording whose walkers are not always there
_NUMBERS = (  # name, type, shape by letters
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
_NAMES = (("limb_name", "L"), ("part_name", "P"), ("walker_name", "W"))


def _nothing() -> np.ndarray:
    return np.empty(0)


@dataclass(frozen=True, eq=False, repr=False)
class Sole(Record):
    """What presses the ground, in its part's frame."""

    vertices: np.ndarray  # (n, 3) f4 [m]
    triangles: np.ndarray  # (m, 3) i4

    def __post_init__(self):
        object.__setattr__(self, "vertices", read_only(np.ascontiguousarray(self.vertices, "f4")))
        object.__setattr__(self, "triangles", read_only(np.ascontiguousarray(self.triangles, "i4")))

    def __repr__(self):
        return f"Sole({len(self.vertices)} vertices, {len(self.triangles)} triangles)"


@dataclass(frozen=True, eq=False, repr=False)
class Gait(Record):
    time: np.ndarray  # (T,) [s], strictly increasing
    com: np.ndarray  # centre of mass (W, T, 3) [m]
    mass: np.ndarray  # (W,) [kg] > 0
    pose: np.ndarray  # x y z, unit quaternion w x y z, of each part (P, T, 7) [m, -]
    limb_walker: np.ndarray  # walker of each limb (L,)
    part_limb: np.ndarray  # limb of each part (P,)
    soles: tuple  # Sole of each part (P)
    point: np.ndarray  # contact points in their part's frame (K, 3) [m]
    point_part: np.ndarray  # (K,)
    point_role: np.ndarray  # HEEL, BALL or TIP (K,)
    limb_name: tuple = ()  # the foot bone's name (L)
    part_name: tuple = ()  # "heel", "toe" .. (P)
    walker_name: tuple = ()  # (W)
    frame_rate: float = 24.0  # scene frames a second
    frame_start: int = 1  # scene frame at time[0]
    warnings: tuple = ()
    cut: np.ndarray = field(default_factory=_nothing)  # samples at which a new piece begins, rising (C,)
    jump: np.ndarray = field(default_factory=_nothing)  # those at which one walker only jumps: sample, walker (J, 2)
    leg: np.ndarray = field(default_factory=_nothing)  # hips to ankles (W,) [m] > 0; empty: size.legs() finds it

    def __post_init__(self):
        for name, kind, _ in _NUMBERS:
            value = getattr(self, name)
            if not isinstance(value, TrackArray):
                value = read_only(np.ascontiguousarray(value, kind))
            object.__setattr__(self, name, value)
        object.__setattr__(self, "cut", read_only(np.array(self.cut, "i8").reshape(-1)))
        object.__setattr__(self, "jump", read_only(np.array(self.jump, "i8").reshape(-1, 2)))
        object.__setattr__(self, "leg", read_only(np.array(self.leg, "f8").reshape(-1)))
        object.__setattr__(self, "soles", tuple(self.soles))
        object.__setattr__(self, "warnings", tuple(str(w) for w in self.warnings))
        for name, letter in _NAMES:
            names = tuple(str(n) for n in getattr(self, name))
            if not names:
                kind = {"L": "limb", "P": "part", "W": "walker"}[letter]
                names = tuple(f"{kind} {i + 1}" for i in range(self._count(letter)))
            object.__setattr__(self, name, names)
        object.__setattr__(self, "frame_rate", float(self.frame_rate))
        object.__setattr__(self, "frame_start", int(self.frame_start))

    def __repr__(self):
        counted = ((len(self.mass), "walker"), (len(self.limb_walker), "limb"), (len(self.time), "sample"))
        told = [f"{count} {word}{'' if count == 1 else 's'}" for count, word in counted]
        with contextlib.suppress(IndexError, TypeError, ValueError):  # one that check() would refuse is shown, too
            told.append(f"{self.time[-1] - self.time[0]:.6g} s")
            rate = self.rate()
            told.append("no even rate" if rate is None else f"{rate:.6g} a second")
        return f"Gait({', '.join(told)})"

    def _count(self, letter):
        source = {"T": self.time, "W": self.mass, "L": self.limb_walker, "P": self.part_limb, "K": self.point_part}[
            letter
        ]
        return len(source) if source.ndim else 0

    def frame(self, sample):
        """Scene frame of a sample, a fraction between frames."""
        return self.frame_start + (self.time[sample] - self.time[0]) * self.frame_rate

    def bone(self, part):
        return self.limb_name[self.part_limb[part]]

    # ---- pieces: between two cuts the motion is one ----------------------------------------------

    def pieces(self, cut=None):
        """(first sample, sample after the last) of each piece, or of those that these cuts alone make."""
        ends = [0, *(self.cut if cut is None else cut).tolist(), len(self.time)]
        return list(zip(ends[:-1], ends[1:]))

    def cuts_of(self, walkers):
        """The cuts that these walkers have: those of all, and where they jump themselves."""
        own = self.jump[np.isin(self.jump[:, 1], walkers), 0]
        return self.cut[~np.isin(self.cut, self.jump[:, 0]) | np.isin(self.cut, own)]

    def by_piece(self, work, values):
        """work() of the samples of each piece of values (T, ..), together again."""
        return np.concatenate([work(values[first:after]) for first, after in self.pieces()])

    def there(self, first, after):
        """Numbers of the walkers that are there in samples first..after-1, rising."""
        if isinstance(self.com, TrackArray):
            return np.flatnonzero(self.com.there(first, after))
        return np.arange(len(self.mass))

    def stays(self, walker):
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

    def piece(self, first, after):
        """Samples first..after-1, which hold no cut, as a recording of their own."""
        return replace(
            self,
            time=self.time[first:after],
            com=self.com[:, first:after],
            pose=self.pose[:, first:after],
            cut=(),
            jump=(),
            frame_start=round(self.frame(first)),
            warnings=(),
        )

    # ---- what a recording must be ------------------------------------------------------------

    def check(self):
        """Refuse what cannot be worked with, naming bone and frame; return self."""
        for name, _, letters in _NUMBERS:
            value = getattr(self, name)
            want = tuple(int(c) if c.isdigit() else self._count(c) for c in letters)
            if value.shape != want:
                raise DesirePathError(
                    f"The recording's {name} has shape {value.shape} where {want} is needed: record the walk again."
                )
        for name, letter in _NAMES:
            if len(getattr(self, name)) != self._count(letter):
                raise DesirePathError(
                    f"The recording's {name} has {len(getattr(self, name))} entries where "
                    f"{self._count(letter)} are needed: record the walk again."
                )
        if len(self.soles) != self._count("P"):
            raise DesirePathError("The recording has not one sole for each part: record the walk again.")
        if not len(self.time):
            raise DesirePathError("The recording has no frames: choose a frame range in which the character walks.")
        if not len(self.part_limb) or not len(self.mass):
            raise DesirePathError("The recording has no feet: choose the foot bones and record again.")
        self._check_numbers()
        self._check_owners()
        return self

    def _check_numbers(self):
        if len(self.cut) and (self.cut[0] < 1 or self.cut[-1] >= len(self.time) or (np.diff(self.cut) < 1).any()):
            raise DesirePathError(
                "The recording's cuts do not rise from its second sample to its last: record the walk again."
            )
        if not (np.isin(self.jump[:, 0], self.cut).all() and np.isin(self.jump[:, 1], range(len(self.mass))).all()):
            raise DesirePathError("The recording's jumps are not among its cuts and walkers: record the walk again.")
        if not np.isfinite(self.time).all() or (np.diff(self.time) <= 0).any():
            raise DesirePathError("The recording's times do not increase: record the walk again.")
        if abs(self.time).max() > MOST_TIME or not self.frame_rate <= MOST_RATE:
            raise DesirePathError(
                f"The recording reaches {abs(self.time).max():.3g} s at {self.frame_rate:g} frames a "
                "second, which no scene does: record the walk again."
            )
        if abs(self.frame_start) > MOST_FRAME:
            raise DesirePathError(
                f"The recording begins at frame {self.frame_start}, where no scene is: record the walk again."
            )
        if not (np.isfinite(self.frame_rate) and self.frame_rate > 0):
            raise DesirePathError(
                f"A frame rate of {self.frame_rate:g} cannot be used: set the scene's frames a second to more than 0."
            )
        for w, mass in enumerate(self.mass):
            if not 0 < mass <= MOST_MASS:
                raise DesirePathError(
                    f"{self.walker_name[w]} has a mass of {mass:g} kg: give it one above 0 and up to {MOST_MASS:g}."
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
            raise DesirePathError("A contact point has no finite position: record the walk again.")

    def _check_owners(self):
        for name, owners, count in (
            ("limb_walker", self.limb_walker, len(self.mass)),
            ("part_limb", self.part_limb, len(self.limb_walker)),
            ("point_part", self.point_part, len(self.part_limb)),
            ("point_role", self.point_role, 3),
        ):
            if len(owners) and (owners.min() < 0 or owners.max() >= count):
                raise DesirePathError(
                    f"The recording's {name} points at something that is not there: record the walk again."
                )
        if set(range(len(self.part_limb))) - set(self.point_part.tolist()):
            raise DesirePathError("A part of the recording has no contact point: record the walk again.")

    def only(self, walkers):
        """Some walkers of the recording, by their numbers."""
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
            pose=tracks.some(self.pose, parts),
            leg=self.leg[walkers] if len(self.leg) else (),
            limb_walker=np.searchsorted(walkers, self.limb_walker[limbs]),
            part_limb=np.searchsorted(limbs, self.part_limb[parts]),
            soles=[self.soles[p] for p in parts],
            point=self.point[points],
            point_part=np.searchsorted(parts, self.point_part[points]),
            point_role=self.point_role[points],
            limb_name=[self.limb_name[limb] for limb in limbs],
            part_name=[self.part_name[p] for p in parts],
            walker_name=[self.walker_name[w] for w in walkers],
        )

    # ---- to disk and back ----------------------------------------------------------------------

    def save(self, path):
        """Write one .npz; the file appears whole or not at all."""
        path = os.fspath(path)
        arrays = {name: getattr(self, name) for name, _, _ in _NUMBERS}
        for name in ("limb_name", "part_name", "walker_name", "warnings"):
            arrays[name] = np.array(getattr(self, name), dtype="U")
        arrays["cut"], arrays["jump"], arrays["leg"] = self.cut, self.jump, self.leg
        arrays["version"] = np.array(_VERSION)
        if isinstance(self.com, TrackArray):  # only those who are there
            arrays["version"] = np.array(_TRACKS)
            for name in ("com", "pose"):
                arrays.update(getattr(self, name).to_arrays(name))
        arrays["frame_rate"] = np.array(self.frame_rate)
        arrays["frame_start"] = np.array(self.frame_start)
        arrays["sole_vertex_count"] = np.array([len(s.vertices) for s in self.soles], "i4")
        arrays["sole_triangle_count"] = np.array([len(s.triangles) for s in self.soles], "i4")
        arrays["sole_vertices"] = _stack([s.vertices for s in self.soles], "f4")
        arrays["sole_triangles"] = _stack([s.triangles for s in self.soles], "i4")
        with atomic_file.file(path, "The recording") as stream:
            np.savez(stream, **arrays)

    @staticmethod
    def load(path):
        """Read what save() wrote; a damaged file is a DesirePathError."""
        path = os.fspath(path)
        try:
            arrays = npz.read(path)
        except FileNotFoundError:
            raise DesirePathError(
                f"There is no recording at {path}: record the walk first or check the name."
            ) from None
        except PermissionError as error:
            raise DesirePathError(
                f"The recording {path} cannot be read ({error.strerror}): check whose file it is."
            ) from None
        except npz.Damaged as error:
            raise DesirePathError(f"{path} is damaged or no recording ({error}): record the walk again.") from None
        try:
            version = int(arrays["version"])
            if version not in (_VERSION, _TRACKS):
                raise DesirePathError(f"{path} was recorded by another version ({version}): record the walk again.")
            if version == _TRACKS:
                for name, count in (("com", "mass"), ("pose", "part_limb")):
                    arrays[name] = TrackArray.from_arrays(arrays, name, len(arrays[count]), len(arrays["time"]))
            wanted = {name: arrays[name] for name, _, _ in _NUMBERS}
            for name in ("limb_name", "part_name", "walker_name", "warnings"):
                wanted[name] = tuple(arrays[name].tolist())
            gait = Gait(
                soles=_unstack(arrays),
                frame_rate=float(arrays["frame_rate"]),
                frame_start=int(arrays["frame_start"]),
                cut=arrays.get("cut", ()),
                jump=arrays.get("jump", ()),
                leg=arrays.get("leg", ()),
                **wanted,
            )
        except DesirePathError:
            raise
        except (KeyError, ValueError, TypeError, IndexError, OverflowError) as error:
            raise DesirePathError(
                f"{path} is damaged or no recording ({str(error)[:100]}): record the walk again."
            ) from None
        except MemoryError:
            raise DesirePathError(
                f"There is not enough memory for the recording {path}: record fewer frames."
            ) from None
        return _let_in(gait.check())

    # ---- several walkers, other rates ----------------------------------------------------------

    @staticmethod
    def join(gaits):
        """Several walkers of the same time base as one recording."""
        gaits = list(gaits)
        if not gaits:
            raise DesirePathError("There is no walker to record: choose an armature first.")
        first = gaits[0]
        for other in gaits[1:]:
            if other.time.shape != first.time.shape or abs(other.time - first.time).max() > 1e-9:
                raise DesirePathError("The walkers were recorded at different times: record them over one frame range.")
        limbs = np.cumsum([0] + [len(g.limb_walker) for g in gaits])
        parts = np.cumsum([0] + [len(g.part_limb) for g in gaits])
        walkers = np.cumsum([0] + [len(g.mass) for g in gaits])
        chain = lambda name: tuple(x for g in gaits for x in getattr(g, name))
        shifted = lambda name, by: np.concatenate([getattr(g, name) + b for g, b in zip(gaits, by)])
        return Gait(
            time=first.time,
            com=tracks.joined([g.com for g in gaits]),
            mass=np.concatenate([g.mass for g in gaits]),
            pose=tracks.joined([g.pose for g in gaits]),
            limb_walker=shifted("limb_walker", walkers),
            part_limb=shifted("part_limb", limbs),
            soles=chain("soles"),
            point=np.concatenate([g.point for g in gaits]),
            point_part=shifted("point_part", parts),
            point_role=np.concatenate([g.point_role for g in gaits]),
            limb_name=chain("limb_name"),
            part_name=chain("part_name"),
            walker_name=chain("walker_name"),
            frame_rate=first.frame_rate,
            frame_start=first.frame_start,
            warnings=tuple(dict.fromkeys(chain("warnings"))),
            cut=np.unique(np.concatenate([g.cut for g in gaits])),
            jump=np.concatenate([g.jump + (0, first) for g, first in zip(gaits, walkers)]),
            leg=np.concatenate([size.legs(g) for g in gaits]) if any(len(g.leg) for g in gaits) else (),
        )

    def rate(self):
        """Samples a second if they are even within every piece, else None."""
        steps = np.delete(np.diff(self.time), self.cut - 1)
        if not len(steps):
            return None
        step = steps.mean()
        return 1.0 / step if abs(steps - step).max() < 1e-3 * step else None

    def resample(self, rate):
        """The same recording at an even rate [1/s]: cubic positions and rotations.

        A pose that is held in mid-step is held, and the motion on either side of it is one: see freeze.
        """
        if not (np.isfinite(rate) and rate > 0):
            raise DesirePathError(f"A rate of {rate:g} samples a second cannot be used: give one above 0.")
        if len(self.cut):
            return self._resampled_pieces(rate)
        held = freeze.holds(self)
        return freeze.resampled(self, rate, held) if any(held) else self.evenly(rate)

    def evenly(self, rate):
        """resample() of a recording without cuts and holds."""
        asked = (self.time[-1] - self.time[0]) * rate + 1.0
        Limits().check("memory", asked * (24.0 * len(self.mass) + 56.0 * len(self.part_limb)))
        count = _native.resample_count(self.time[0], self.time[-1], float(rate))
        time = np.empty(count)
        com = np.empty((len(self.mass), count, 3))
        pose = np.empty((len(self.part_limb), count, 7))
        _native.resample(self.time, self.com, self.pose, float(rate), time, com, pose)
        return replace(self, time=time, com=com, pose=pose)

    def carried(self):
        """Walkers that walk in place carried ahead by their own speed; itself if there are none."""
        return _cycle.carried(self)

    @fields_of(scatter=Scatter)
    def along(
        self,
        path: ArrayLike,
        passes: int = 1,
        *,
        back_and_forth: bool = True,
        scatter: Scatter = Scatter(),
        seed: int = 0,
        pause: float = 0.0,
        ground: Any = None,
    ) -> Gait:
        """The walk's cycle carried along a path (n, 2 or 3) [m] as often as wanted, there and back or one way.

        scatter: how passes differ; pause: between them [s]; ground: what is walked on. See passes.along().
        """
        carried: Gait = _passes.along(
            self, path, passes, back_and_forth=back_and_forth, scatter=scatter, seed=seed, pause=pause, ground=ground
        )
        return carried

    def _resampled_pieces(self, rate):
        """Each piece begins when it began; in between may be a gap."""
        have = self.rate()
        if have is not None and abs(rate / have - 1.0) < 1e-9:
            return self
        if isinstance(self.com, TrackArray):
            return self._resampled_tracks(rate)
        parts = [self.piece(*ends).resample(rate) for ends in self.pieces()]
        cut = np.cumsum([len(p.time) for p in parts])[:-1]
        jump = self.jump.copy()
        jump[:, 0] = cut[np.searchsorted(self.cut, jump[:, 0])]
        return replace(
            self,
            time=np.concatenate([p.time for p in parts]),
            com=np.concatenate([p.com for p in parts], axis=1),
            pose=np.concatenate([p.pose for p in parts], axis=1),
            cut=cut,
            jump=jump,
        )

    def _resampled_tracks(self, rate):
        """Each piece for those who are there."""
        times, coms, poses, at = [], [], [], 0
        owner = self.limb_walker[self.part_limb]
        for first, after in self.pieces():
            there = self.there(first, after)
            if len(there):
                piece = self.only(there).piece(first, after).resample(rate)
                coms.append((there, at, piece.com))
                poses.append((np.flatnonzero(np.isin(owner, there)), at, piece.pose))
                times.append(piece.time)
            else:
                count = _native.resample_count(self.time[first], self.time[after - 1], float(rate))
                times.append(self.time[first] + np.arange(count) / rate)
            at += len(times[-1])
        cut = np.cumsum([len(time) for time in times])[:-1]
        jump = self.jump.copy()
        jump[:, 0] = cut[np.searchsorted(self.cut, jump[:, 0])]
        return replace(
            self,
            time=np.concatenate(times),
            com=TrackArray(len(self.mass), at, coms),
            pose=TrackArray(len(owner), at, poses),
            cut=cut,
            jump=jump,
        )


def _let_in(gait):
    """A recording as it was kept when who was not there was held up in the sky for whole pieces."""
    sky = 1e5  # [m]
    if isinstance(gait.com, TrackArray) or not (gait.com[..., 2] >= sky).any():
        return gait
    owner, coms, poses = gait.limb_walker[gait.part_limb], [], []
    for first, after in gait.pieces():
        there = np.flatnonzero(gait.com[:, first:after, 2].min(axis=1) < sky)
        if len(there):
            mine = np.flatnonzero(np.isin(owner, there))
            coms.append((there, first, gait.com[there, first:after]))
            poses.append((mine, first, gait.pose[mine, first:after]))
    if not coms:
        return gait
    times = len(gait.time)
    return replace(gait, com=TrackArray(len(gait.mass), times, coms), pose=TrackArray(len(owner), times, poses))


def _broken(array, row, test):
    """The first sample of a row at which a test of its values (n, ..) says so; None: nowhere."""
    for first, values in tracks.pieces(array, row):
        bad = test(values)
        if bad.any():
            return first + int(bad.argmax())
    return None


def _stack(blocks, kind):
    return np.concatenate(blocks).astype(kind) if blocks else np.zeros((0, 3), kind)


def _unstack(arrays):
    blocks = []
    for rows, counts in (("sole_vertices", "sole_vertex_count"), ("sole_triangles", "sole_triangle_count")):
        count = arrays[counts].astype("i8")
        if count.ndim != 1 or count.min(initial=0) < 0 or count.sum() != len(arrays[rows]):
            raise ValueError(f"{counts} does not fit {rows}")
        blocks.append(np.split(arrays[rows], np.cumsum(count)[:-1]))
    return tuple(Sole(v, t) for v, t in zip(*blocks, strict=True))
