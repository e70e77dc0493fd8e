"""What a bake is to do: which walk over which grounds, which frames, by which numbers."""

from __future__ import annotations

import hashlib
import math
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from ..core import _native
from ..errors import DesirePathError
from ..ground.parcels import Parcel
from ..ground.soil_keys import rows
from ..ground.spray import Spray
from ..motion import jumps, size, tracks
from ..motion.gait import AUTO, Gait
from ..placement.passes import turns_of
from ..rig.sole import coarse_cells
from ..version import VERSION
from .folder import FORMAT
from .options import FILMS, BakeOptions, BakeOutput

SAMPLE_RATE = 120.0  # at least so many steps a second, more for small creatures (size.hurry) [1/s]
PASS_RATE = 60.0  # the same where a frame is a pass: there are many, and each print is trodden again [1/s]
MAX_PASS_MAPS = 50  # of a bake of passes; with more passes than these, maps of some


def _passes(gait: Gait) -> list[tuple[int, int]]:
    """(first sample, sample after the last) of each pass in time: who walk at once make one together."""
    return list(dict.fromkeys((first, after) for first, after, _, _ in turns_of(gait)))


class Plan:
    """What a Bake is to do, its parameters as Bake tells them; nothing of it changes while it runs."""

    def __init__(
        self, gait: Gait, parcels: list[Parcel], cell_size: float, options: BakeOptions, output: BakeOutput
    ) -> None:
        gait = gait.check()
        if options.law == "carve":
            laws = gait.contact_law or (AUTO,) * len(gait.mass)
            gait = replace(gait, contact_law=tuple("carve" if law == AUTO else law for law in laws))
        self.gait = gait = jumps.found(gait)
        self.options, self.output = options, output
        self.passes = _passes(gait)
        self.film = output.film or FILMS[len(self.passes) > 1]
        self.parcels = parcels
        self.folder = parcels[0].folder
        self.frame_rate = float(gait.frame_rate)
        self.frame_start, self.frame_end = self._frame_range()
        self.cell_size = float(cell_size)
        self.warnings: tuple[str, ...] = (*gait.warnings, *coarse_cells(gait, self.cell_size), *self._unkeyed())

    def _unkeyed(self) -> list[str]:
        """A sentence about keys on soils that do not count."""
        soils: list[Any] = [soil for parcel in self.parcels for soil in parcel.soils]
        taus = [len({row.settle_time for row in rows(soil)}) for soil in soils]
        if self.options.load_model != "impulse" or max(taus) < 2:
            return []
        return [
            "The model impulse takes settle_time as it is at first, and its keys count for the depth of prints alone: "
            "choose the model inertia."
        ]

    def _frame_range(self) -> tuple[int, int]:
        """First and last scene frame that are written."""
        gait, output = self.gait, self.output
        frames = (
            len(self.passes) - 1
            if self.film == "passes"
            else math.floor((gait.time[-1] - gait.time[0]) * self.frame_rate + 1e-6)
        )
        last = gait.frame_start + frames
        start = gait.frame_start if output.frame_start is None else int(output.frame_start)
        end = last if output.frame_end is None else int(output.frame_end)
        if end <= start and self.film == "frames" or end < start:
            raise DesirePathError(f"The frame range {start} to {end} holds no motion: let it end after it starts.")
        if start > last or end < gait.frame_start:
            raise DesirePathError(
                f"The recording holds frames {gait.frame_start} to {last} and none of {start} to "
                f"{end}: choose frames among them."
            )
        return start, end

    @property
    def wait(self) -> float:
        """So long run() lets another program end its bake into the folder before it refuses [s]; where this program
        bakes there it does so at once."""
        return float(self.output.wait)

    @property
    def count(self) -> int:
        """How many frames are written for playback, but for the ground at rest."""
        return self.frame_end - self.frame_start + 1

    def rate(self) -> float:
        """Samples a second: a whole number of them a frame [1/s]."""
        at_least = (PASS_RATE if self.film == "passes" else SAMPLE_RATE) * size.hurry(self.gait)
        return self.frame_rate * max(1, math.ceil(at_least / self.frame_rate - 1e-6))

    @cached_property
    def stepped(self) -> Gait:
        """The walk at rate()."""
        return self.gait.resample(self.rate())

    @cached_property
    def times(self) -> np.ndarray:
        """Of the samples of `stepped` (T,) since it began [s]."""
        return self.stepped.time - self.stepped.time[0]

    @cached_property
    def ends(self) -> list[int]:
        """Last sample of `stepped` of each pass."""
        return [min(after, len(self.times) - 1) for _, after in _passes(self.stepped)]

    def sample(self, frame: int) -> int:
        """Sample of the recording that shows this scene frame."""
        number = max(frame - self.gait.frame_start, 0)
        if self.film == "passes":
            return self.ends[min(number, len(self.ends) - 1)]
        return int(np.searchsorted(self.times, number / self.frame_rate + 1e-6, "right")) - 1

    def time(self, frame: int) -> float:
        """Of a scene frame since the recording began [s]."""
        if self.film == "passes":
            return float(self.times[self.sample(frame)])
        return (frame - self.gait.frame_start) / self.frame_rate

    def map_name(self, frame: int) -> str | None:
        """Of the map of a scene frame, if it has one: after every whole simulated second, TRAIL (17); after a pass,
        where a frame is one."""
        if not self.output.map_seconds:
            return None
        if self.film == "passes":
            number = frame - self.gait.frame_start + 1
            return None if number % -(-len(self.passes) // MAX_PASS_MAPS) else f"pass_{number:04d}.exr"
        elapsed = frame - self.frame_start
        before, now = ((elapsed - 1) / self.frame_rate, elapsed / self.frame_rate)
        if elapsed > 0 and math.floor(now + 1e-9) > math.floor(before + 1e-9):
            return f"second_{math.floor(now + 1e-9):04d}.exr"
        return None

    def parameters(self, parcel: Parcel) -> dict[str, Any]:
        """What is baked, for the report of a parcel."""
        options = self.options
        soils: Any = parcel.soils
        plants: Any = parcel.plants
        layers = parcel.ground.layers
        return {
            "cell_size": self.cell_size,
            "frame_start": self.frame_start,
            "frame_end": self.frame_end,
            "frame_rate": self.frame_rate,
            "load_model": options.load_model,
            "soils": [soil.parameters() for soil in soils],
            "ground": parcel.ground.name,
            **({"layers": [[each.soil.parameters(), each.thickness] for each in layers]} if layers else {}),
            **({"trail": parcel.ground.trail.path} if parcel.ground.trail else {}),
            "walkers": list(self.gait.walker_name),
            "mass_kg": [float(mass) for mass in self.gait.mass],
            **({"mass_keys": self.gait.mass_keys} if self.gait.mass_keys else {}),
            "law": options.law,
            "heap": options.heap,
            "rim_width": options.rim_width,
            "origin": options.origin,
            **({"plants": [planting.parameters() for planting in plants]} if plants else {}),
            **({"spray": options.spray.parameters()} if isinstance(options.spray, Spray) else {}),
            **({"film": self.film} if self.film != "frames" else {}),
        }

    def signature(self) -> str:
        """The same for two bakes exactly when they write the same files."""
        digest = hashlib.sha256(f"{VERSION} {FORMAT}".encode())
        gait = self.gait
        arrays = [
            gait.time,
            gait.com,
            gait.pose,
            gait.point,
            gait.part_limb,
            gait.limb_walker,
            gait.cut,
            gait.jump,
            gait.leg,
        ]
        if gait.contact_law:
            digest.update(repr(gait.contact_law).encode())
        for sole in gait.soles:
            arrays += [sole.vertices, sole.triangles]
        for parcel in self.parcels:
            digest.update(f"{self.parameters(parcel)} {parcel.ground.native[0]}".encode())
            digest.update(repr([part for part in parcel.ground.native if isinstance(part, float)]).encode())
            arrays += parcel.ground.arrays()
            plants: Any = parcel.plants
            for planting in plants:
                arrays += planting.arrays()
        for array in [part for each in arrays for part in tracks.parts(each)]:
            digest.update(f"{array.shape} {array.dtype}".encode())
            digest.update(_native.digest(np.ascontiguousarray(array)))
        return digest.hexdigest()
