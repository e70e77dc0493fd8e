"""What flies in a bake as OpenVDB volumes, one a frame, for renderers and tools that know volumes.

    trail_0001.vdb ..    grid `density`: the share of each voxel that grains fill, so that values times a voxel's volume
                         sum to what is in the air [m^3]; world frame, metres

Needs the module openvdb: Blender 4.4 and later have it.
"""

from __future__ import annotations

import math
import os
from typing import Any

import numpy as np

from .. import lazy
from ..errors import DesirePathError
from ..files import atomic_file, disk
from ..ground.spray import Grains, read_frame
from .folder import read_index

KIND = ".vdb"
WIDTH = 4.0  # grains along a voxel, where nobody says

openvdb: Any = lazy.module("openvdb")  # a machine may lack it


def check(path: str | os.PathLike[str]) -> str:
    """The path without its ending; DesirePathError where nothing can be written, or openvdb is not there."""
    start, kind = os.path.splitext(os.fspath(path))
    if kind.lower() != KIND:
        raise DesirePathError(f"{path} is of no kind that is written: give it a name that ends with {KIND}.")
    try:
        lazy.load(openvdb)
    except ImportError:
        raise DesirePathError(
            "VDB is written by the module openvdb, which is not there: export from Blender 4.4 or later."
        ) from None
    return start


def voxels(grains: Grains, volume: float, size: float) -> tuple[np.ndarray, np.ndarray]:
    """(voxels (n, 3), the share of each that is filled (n,)): those of `size` [m] around whole multiples of it, in
    which grains lie of so much `volume` [m^3] each."""
    place, count = np.unique(np.round(grains.position / size).astype(np.int64), axis=0, return_counts=True)
    return place.reshape(-1, 3), count * (volume / size**3)


def write(folder: str | os.PathLike[str], path: str | os.PathLike[str], size: float | None = None) -> dict[str, int]:
    """Write a file a frame of the bake in a folder, <path>_0001.vdb and so on by scene frames; returns how many
    `frames`, and how many `grains` fly in all of them. size: of a voxel [m]; None: a few grains wide"""
    start, index = check(path), read_index(folder)
    if not index.grain_size > 0.0:
        raise DesirePathError(f"Nothing flies in the bake in {folder}: choose a spray and bake again.")
    size = WIDTH * index.grain_size if size is None else float(size)
    volume = math.pi / 6.0 * index.grain_size**3
    grains = 0
    for number in range(1, index.frames + 1):
        there = read_frame(index.spray_path(number))
        grid = openvdb.FloatGrid()
        grid.name, grid.transform = "density", openvdb.createLinearTransform(voxelSize=size)
        cells = grid.getAccessor()
        for place, share in zip(*(each.tolist() for each in voxels(there, volume, size))):
            cells.setValueOn(tuple(place), share)
        to = f"{start}_{index.frame_start + number - 1:04d}{KIND}"
        atomic_file.check(to, "The volume")
        openvdb.write(f"{to}.part", grids=[grid])
        disk.replace(f"{to}.part", to)
        grains += len(there)
    return {"frames": index.frames, "grains": grains}
