"""Ground that is pressed in pieces: some walkers for some of the time, and what others left of the tiles they tread on.

A Simulation follows the tracks of a few walkers of a walk, takes the tiles and limbs it needs from the states of
others, begins at a later sample, and is to the bit what the whole would be there. MODEL 13
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ..errors import DesirePathError
from .cast import cast_of, laws_of, pressing_of
from .sim import Simulation

if TYPE_CHECKING:
    from typing_extensions import Buffer

    from ..loads.force import FootForce
    from ..motion.gait import Gait

CAST = (
    "time",
    "mass",
    "limb_walker",
    "part_limb",
    "sole_vertices",
    "sole_vertex_count",
    "sole_triangles",
    "sole_triangle_count",
)
TRACKS = ("track", "pose", "touching", "force", "point")


def cast(gait: Gait) -> dict[str, np.ndarray]:
    """Who walks and when, as arrays by the names of CAST, with `laws` where walkers have their own."""
    found = dict(zip(CAST, cast_of(gait)))
    laws = laws_of(gait)
    return found if laws is None else {**found, "laws": laws}


def tracks(gait: Gait, loads: FootForce, spans: np.ndarray) -> dict[str, np.ndarray]:
    """What walkers do in spans (n, 3) of (walker, first sample, samples) in which they are there, by the names of
    TRACKS."""
    owner = np.asarray(gait.limb_walker)[np.asarray(gait.part_limb)]
    empty = (np.zeros((0, 7)), np.zeros(0, np.uint8), np.zeros((0, 3)), np.zeros((0, 3)))
    found = [empty]
    for walker, first, count in spans.tolist():
        mine, after = np.flatnonzero(owner == walker), first + count
        stays = None if loads.held is None else loads.held[mine, first:after]
        found.append(
            (
                np.asarray(gait.pose[mine, first:after]).reshape(-1, 7),
                pressing_of(np.asarray(loads.touching[mine, first:after]), stays).reshape(-1),
                np.asarray(loads.force[mine, first:after]).reshape(-1, 3),
                np.asarray(loads.point[mine, first:after]).reshape(-1, 3),
            )
        )
    pose, touching, force, point = (np.ascontiguousarray(np.concatenate(each)) for each in zip(*found))
    return dict(zip(TRACKS, (spans.astype(np.int32), pose, touching, force, point)))


def some(arrays: Mapping[str, np.ndarray], wanted: np.ndarray) -> dict[str, np.ndarray]:
    """The tracks of which `wanted` (n,) is true; arrays: by the names of TRACKS, and `limb_walker`, `part_limb`."""
    parts = np.bincount(arrays["limb_walker"][arrays["part_limb"]], minlength=int(arrays["limb_walker"].max()) + 1)
    sizes = parts[arrays["track"][:, 0]] * arrays["track"][:, 2]
    rows = np.repeat(wanted, sizes)
    return {name: arrays[name][wanted if name == "track" else rows] for name in TRACKS}


def join(*parts: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Tracks of several, one after the other."""
    return {name: np.concatenate([each[name] for each in parts]) for name in TRACKS}


def follow(sim: Simulation, cast: Mapping[str, np.ndarray], tracks: Mapping[str, np.ndarray]) -> None:
    """Let a simulation follow tracks; plants stand where these can reach them."""
    known = [np.ascontiguousarray(each) for each in (*map(cast.get, CAST), *map(tracks.get, TRACKS))]
    sim._core.load_tracks(*known, cast.get("laws"))
    if sim.plantings:
        sim._plant_window()


def tiles(sim: Simulation) -> np.ndarray:
    """Numbers (x, y) of the tiles that were touched (n, 2) i4, rising by (y, x)."""
    out = np.zeros((sim.report()["tiles"], 2), np.int32)
    sim._core.list_tiles(out)
    return out


def take(sim: Simulation, state: Buffer, tiles: np.ndarray, walkers: np.ndarray) -> None:
    """Take tiles (n, 2) rising by (y, x), and the limbs of walkers (W,) bool, of the state of another piece."""
    try:
        sim._core.join_state(state, np.ascontiguousarray(tiles, np.int32), np.ascontiguousarray(walkers, np.uint8))
    except ValueError as problem:
        raise DesirePathError(f"A piece of the ground cannot be taken ({problem}): run its task again.") from None


def begin_at(sim: Simulation, sample: int) -> None:
    """Let a simulation go on from this sample, before its first step."""
    sim._core.begin_at(int(sample))
