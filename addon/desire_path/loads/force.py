"""What feet do to the ground: the force of every part over time, and a table of it."""

from __future__ import annotations

import csv
import os
from dataclasses import dataclass

import numpy as np

from ..arrays import Record
from ..files import atomic_file
from ..motion.gait import Gait
from ..motion.tracks import Array

GRAVITY = 9.81
PRESSES, ELSEWHERE = 1, 2  # touching: the ground | something else, which carries and takes no print


@dataclass(frozen=True, eq=False, repr=False)
class FootForce(Record):
    """What every part of a recording's feet does to the ground, at the recording's samples."""

    time: np.ndarray  # (T,) [s]
    # 1 where the part touches (P, T) u1; at the samples beside a cut 0: who touches at one end of an interval does all
    # the way, and over a cut nobody does
    touching: Array
    force: Array  # of the part on the ground (P, T, 3) [N]
    point: Array  # centre of pressure, NaN in the air (P, T, 3) [m]
    clearance: np.ndarray  # resting height of each contact point over the ground (K,) [m]
    mean: np.ndarray | None = None  # mean vertical force of each walker (W,) [body weights]
    warnings: tuple[str, ...] = ()
    held: Array | None = None  # parts held in mid-step from these samples to the next press no deeper (P, T)

    def __repr__(self) -> str:
        parts, samples = np.shape(self.touching)
        return f"FootForce({parts} parts, {samples} samples, {len(self.warnings)} warnings)"


def native_gait(gait: Gait) -> tuple[Array, ...]:
    """The arrays of a recording as the core takes them, in the order of DpGait."""
    return (
        gait.time,
        gait.com,
        gait.mass,
        gait.pose,
        gait.limb_walker,
        gait.part_limb,
        gait.point,
        gait.point_part,
        gait.point_role,
    )


def write_loads(path: str | os.PathLike[str], gait: Gait, loads: FootForce) -> None:
    """The table `time,walker,limb,part,touching,fx,fy,fz,px,py,pz`, a row a part and sample."""

    def number(x: float) -> str:
        return f"{x + 0.0:.9g}" if np.isfinite(x) else ""

    with atomic_file.file(path, "The table of loads", "w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(["time", "walker", "limb", "part", "touching", "fx", "fy", "fz", "px", "py", "pz"])
        names = [
            (gait.walker_name[gait.limb_walker[limb]], gait.limb_name[limb], part)
            for limb, part in zip(gait.part_limb, gait.part_name)
        ]
        for t, time in enumerate(loads.time):
            for p, name in enumerate(names):
                table.writerow(
                    [
                        number(time),
                        *name,
                        int(loads.touching[p, t]),
                        *map(number, loads.force[p, t]),
                        *map(number, loads.point[p, t]),
                    ]
                )
