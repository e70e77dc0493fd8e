"""What a bake refuses before anything is written: feet out of proportion, and more than it may take."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .. import bounds, memory
from ..bounds import CELLS, Limits
from ..errors import DesirePathError
from ..ground import maps, plant_mesh
from ..motion import tracks
from ..motion.gait import Gait
from ..motion.rotation import turned
from .share import Share

SOLE_STEP = 0.0025  # soles are sampled so closely, or four times a cell [m]
MIN_SAMPLES = 4  # a sole that fewer fall on leaves no print
MAX_SOLE = 1_000_000  # cells one sole may cover


def lost_soles(gait: Gait, cell_size: float) -> list[str]:
    """Sentences about single feet that are lost between cells [m]. DesirePathError for feet of so many cells that a
    step would take minutes, as of a rig in the wrong unit, and for a walker whose every foot is lost."""
    area = np.zeros(len(gait.soles))
    for part, sole in enumerate(gait.soles):
        size = np.sort(np.ptp(sole.vertices.astype(float), axis=0))
        lowest = gait.pose[part, gait.pose[part, :, 2].argmin(), 3:]
        area[part] = np.prod(np.ptp(turned(lowest, sole.vertices.astype(float))[:, :2], axis=0))
        if size[1] * size[2] > MAX_SOLE * cell_size**2:
            raise DesirePathError(
                f"The sole of bone {gait.bone(part)} is {size[2]:.1f} m long, too large for cells of "
                f"{cell_size:g} m: check the walker's scale or choose a larger cell size."
            )
    step = cell_size / min(max(round(cell_size / SOLE_STEP), 1), 4)  # as the core samples soles
    sentences = []
    for number, name in enumerate(gait.walker_name):
        limbs = np.flatnonzero(np.asarray(gait.limb_walker) == number)
        largest = [
            max(np.flatnonzero(np.asarray(gait.part_limb) == limb).tolist(), key=lambda part: area[part])
            for limb in limbs
        ]
        lost = [part for part in largest if area[part] < MIN_SAMPLES * step**2]
        if lost and len(lost) == len(largest):
            fine = max(math.sqrt(area[lost].max()) / 8, CELLS[0])
            raise DesirePathError(
                f"The feet of {name} are lost between cells of {cell_size:g} m: choose a cell size of "
                f"{fine:.1g} m or so, or check the walker's scale."
            )
        sentences += [
            f"The sole of bone {gait.bone(part)} is lost between cells of {cell_size:g} m and leaves no "
            "print: choose smaller cells."
            for part in lost
        ]
    return sentences


def check_walk(limits: Limits, gait: Gait, frames: int, rate: float, most: float | None = None) -> None:
    """Refuse what is too long, before its samples are made. frames: how many are written; rate: samples a second;
    most: of memory, if it is limited [bytes]."""
    seconds = sum(float(gait.time[after - 1] - gait.time[first]) for first, after in gait.pieces())
    limits.check("frames", frames)
    limits.check("seconds", seconds)
    there = sum(len(values) for part in range(len(gait.part_limb)) for _, values in tracks.pieces(gait.pose, part))
    needed = bounds.SAMPLE_BYTES * there * (seconds * rate + 1.0) / len(gait.time)
    limits.check("memory", needed)
    memory.check(most, needed)


def check_grounds(limits: Limits, gait: Gait, shares: Sequence[Share], frames: int, most: float | None = None) -> None:
    """Refuse what is too large, before its pictures are made; frames that Shares have found already count no more.
    most: of memory, if it is limited [bytes]."""
    cells = [share.cells for share in shares]
    for share in shares:
        _check_maps(share)
    limits.check("cells", max(cells))
    tiles = sum(share.tiles[2] * share.tiles[3] for share in shares)
    if most is None:
        limits.check("memory", bounds.CELL_BYTES * sum(cells) + bounds.TILE_BYTES * tiles)
    memory.check_rest()
    disk = 0.0
    for share, held in zip(shares, cells):
        pressed = bounds.pressed_area(gait, share.loads.touching) / share.sim.cell_size**2 / len(shares)
        if share.atlas:
            disk += (2 + _maps(share)) * bounds.REST_BYTES * share.window[2] * share.window[3]
        disk += (frames - max(share.found, 0)) * bounds.frame_bytes(held, pressed, bool(share.plants))
        disk += bounds.STATES * bounds.STATE_BYTES * pressed + (bounds.HELD_BYTES * pressed if most else 0.0)
        if share.parcel.plant_mesh:
            disk += plant_mesh.size(share.sim, frames, share.plants)
    limits.check("disk", disk, shares[0].out.folder)


def _maps(share: Share) -> int:
    """How many maps are written while it runs."""
    plan = share.plan
    return sum(plan.map_name(frame) is not None for frame in range(plan.frame_start, plan.frame_end + 1))


def _check_maps(share: Share) -> None:
    """Refuse ground whose maps would have more cells than one file may have, as no reader could take them."""
    _, _, nx, ny = share.window
    if nx * ny > maps.MAX_CELLS:
        cell = share.sim.cell_size
        raise DesirePathError(
            f"The walk spans {nx * cell:.0f} x {ny * cell:.0f} m, and a map of it would have {nx * ny:,} cells, where "
            f"{maps.MAX_CELLS:,} are the most: choose cells of {cell * math.sqrt(nx * ny / maps.MAX_CELLS):.2g} m or "
            "more, or bake it in parts."
        )
