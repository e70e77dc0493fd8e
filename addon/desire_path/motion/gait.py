"""The recording of what the walkers did: everything after it runs without Blender. MODEL 3.1

    .npz <---save, load---> Gait ---resample, join---> Gait ---along---> Gait of many passes

What its arrays are stands with Recording, in recording.py.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import lazy
from ..core import _native
from ..errors import DesirePathError
from ..files import atomic_file, npz
from ..keywords import fields_of
from . import freeze, size, tracks
from . import mass_keys as masses
from .recording import AUTO, BALL, CONTACT_LAWS, HEEL, NAMES, NUMBERS, TIP, Recording, Sole
from .scatter import Scatter
from .tracks import TrackArray

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["AUTO", "BALL", "CONTACT_LAWS", "HEEL", "TIP", "Gait", "Sole"]

# what carries a recording elsewhere knows recordings: Gait.carried and Gait.along only name it
_cycle = lazy.module("..placement.cycle", __package__)
_passes = lazy.module("..placement.passes", __package__)

_VERSION = 1
_TRACKS = 2  # of a recording whose walkers are not always there
_TEXTS = (*(name for name, _ in NAMES), "warnings")


@dataclass(frozen=True, eq=False, repr=False)
class Gait(Recording):
    """A recording of walkers, which is saved, joined with others, resampled and carried along paths."""

    # ---- to disk and back ----------------------------------------------------------------------

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write one .npz; the file appears whole or not at all."""
        path = os.fspath(path)
        arrays = {name: getattr(self, name) for name, _, _ in NUMBERS}
        for name in _TEXTS:
            arrays[name] = np.array(getattr(self, name), dtype="U")
        arrays["cut"], arrays["jump"], arrays["leg"] = self.cut, self.jump, self.leg
        if self.contact_law:
            arrays["contact_law"] = np.array(self.contact_law, dtype="U")
        if self.mass_keys:
            arrays["mass_keys"] = np.array([(w, *key) for w, keys in enumerate(self.mass_keys) for key in keys])
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
    def load(path: str | os.PathLike[str]) -> Gait:
        """Read what save() wrote; a damaged file is a DesirePathError."""
        path = os.fspath(path)
        try:
            arrays: dict[str, Any] = npz.read(path)  # and TrackArrays of it
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
        none = np.empty(0)
        try:
            version = int(arrays["version"])
            if version not in (_VERSION, _TRACKS):
                raise DesirePathError(f"{path} was recorded by another version ({version}): record the walk again.")
            if version == _TRACKS:
                for name, count in (("com", "mass"), ("pose", "part_limb")):
                    arrays[name] = TrackArray.from_arrays(arrays, name, len(arrays[count]), len(arrays["time"]))
            wanted: dict[str, Any] = {name: arrays[name] for name, _, _ in NUMBERS}
            for name in _TEXTS:
                wanted[name] = tuple(arrays[name].tolist())
            gait = Gait(
                soles=_unstack(arrays),
                frame_rate=float(arrays["frame_rate"]),
                frame_start=int(arrays["frame_start"]),
                cut=arrays.get("cut", none),
                jump=arrays.get("jump", none),
                leg=arrays.get("leg", none),
                contact_law=tuple(arrays["contact_law"].tolist()) if "contact_law" in arrays else (),
                mass_keys=_mass_keys(arrays),
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
    def join(gaits: Iterable[Gait]) -> Gait:
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

        def chain(name: str) -> tuple[Any, ...]:
            return tuple(x for g in gaits for x in getattr(g, name))

        def shifted(name: str, by: np.ndarray) -> np.ndarray:
            return np.concatenate([getattr(g, name) + b for g, b in zip(gaits, by)])

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
            mass_keys=tuple(keys for g in gaits for keys in g.mass_keys or [()] * len(g.mass)),
            cut=np.unique(np.concatenate([g.cut for g in gaits])),
            jump=np.concatenate([g.jump + (0, before) for g, before in zip(gaits, walkers)]),
            contact_law=tuple(law for g in gaits for law in g.contact_law or (AUTO,) * len(g.mass)),
            leg=np.concatenate([size.legs(g) for g in gaits]) if any(len(g.leg) for g in gaits) else np.empty(0),
        )

    def resample(self, rate: float) -> Gait:
        """The same recording at an even rate [1/s]: cubic positions and rotations.

        A pose that is held in mid-step is held, and the motion on either side of it is one: see freeze.
        """
        if not (np.isfinite(rate) and rate > 0):
            raise DesirePathError(f"A rate of {rate:g} samples a second cannot be used: give one above 0.")
        if len(self.cut):
            return self._resampled_pieces(rate)
        held = freeze.holds(self)
        return freeze.resampled(self, rate, held) if any(held) else self.evenly(rate)

    def carried(self) -> Gait:
        """Walkers that walk in place carried ahead by their own speed; itself if there are none."""
        carried: Gait = _cycle.carried(self)
        return carried

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

    def _resampled_pieces(self, rate: float) -> Gait:
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

    def _resampled_tracks(self, rate: float) -> Gait:
        """Each piece for those who are there."""
        times, coms, poses, at = [], [], [], 0
        owner = self.limb_walker[self.part_limb]
        for first, after in self.pieces():
            there = self.there(first, after)
            if len(there):
                piece = self.only(there).piece(first, after).resample(rate)
                coms.append((there, at, np.asarray(piece.com)))
                poses.append((np.flatnonzero(np.isin(owner, there)), at, np.asarray(piece.pose)))
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


def _let_in(gait: Gait) -> Gait:
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


def _mass_keys(arrays: Mapping[str, np.ndarray]) -> masses.Keys:
    """The keys on masses that save() wrote, of each walker."""
    rows = np.asarray(arrays.get("mass_keys", np.empty((0, 3))), float).reshape(-1, 3).tolist()
    walkers = range(len(arrays["mass"])) if rows else ()
    return tuple(tuple((time, kg) for at, time, kg in rows if at == w) for w in walkers)


def _stack(blocks: Sequence[np.ndarray], kind: str) -> np.ndarray:
    """Rows of arrays (n, 3) as one."""
    return np.concatenate(blocks).astype(kind) if blocks else np.zeros((0, 3), kind)


def _unstack(arrays: Mapping[str, np.ndarray]) -> tuple[Sole, ...]:
    """The soles that save() wrote; ValueError where they make no sense."""
    blocks = []
    for rows, counts in (("sole_vertices", "sole_vertex_count"), ("sole_triangles", "sole_triangle_count")):
        count = arrays[counts].astype("i8")
        if count.ndim != 1 or count.min(initial=0) < 0 or count.sum() != len(arrays[rows]):
            raise ValueError(f"{counts} does not fit {rows}")
        blocks.append(np.split(arrays[rows], np.cumsum(count)[:-1]))
    return tuple(Sole(v, t) for v, t in zip(*blocks, strict=True))
