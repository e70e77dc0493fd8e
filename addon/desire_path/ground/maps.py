"""Maps in and out: named float32 grids in OpenEXR files, row 0 at the lowest y. TRAIL 4.3, (17)

    from desire_path import maps
    picture = maps.read("bake/maps_final.exr")
    picture.planes["compression"]      # (ny, nx) float32, [m]
    picture.notes["cell"]              # side of a cell [m]

In the file a map is a layer of one channel, `compression.V`: Blender opens layers as they are, and takes
channels of other names for colours. Here it is called by its layer, so that bare names of other writers
read alike. `Y` repeats a file's first map for programs that know no layers, as ffmpeg. A file without layers is a
picture, `R`, `G` and `B`: what Blender opens as layers has no pixels for scripts.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..arrays import Record
from ..core import _native
from ..errors import DesirePathError
from ..files import atomic_file
from . import fields
from . import notes as header
from .fields import FIELDS

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class Map(NamedTuple):
    """A field that leaves the simulation."""

    name: str
    unit: str
    equation: str
    meaning: str


MAX_CELLS = 1 << 32  # of one file, as native/maps has it
LAYER = ".V"  # the one channel of a layer, as Blender calls a value
ROWS: int = _native.TILE  # of planes that are written some at a time
PICTURE = "Y"  # the channel that every program shows, grey


def _maps(*names: str) -> tuple[Map, ...]:
    return tuple(Map(name, *FIELDS[name][1:]) for name in names)


# float32 (ny, nx) each; what they mean stands in native/terrain/terrain_fields.h and native/sim/sim_film.h
MAPS = _maps("compression", "heap", "pressure_time", "plant_strength")
GROUND = _maps("rest", "pressure")  # beside them: what another bake goes on from, and what is no sum
LEAN = _maps(*fields.LEAN)  # beside them where plants grow


def channel(name: str, layers: bool = True) -> str:
    """What a map is called in a file; letters (R, Y ..) and names with a layer are channels already, and where there
    are no layers all names are."""
    return name if len(name) < 2 or "." in name or not layers else name + LAYER


@dataclass(frozen=True, eq=False, repr=False)
class Picture(Record):
    """What a file holds: planes by name, float32 (ny, nx); notes by name, text or number."""

    planes: Mapping[str, np.ndarray]
    notes: Mapping[str, str | float]

    @property
    def shape(self) -> tuple[int, int]:
        return next(iter(self.planes.values())).shape


def write(
    path: str | os.PathLike[str],
    planes: Mapping[str, ArrayLike],
    notes: Mapping[str, str | float] | Iterable[tuple[str, str | float]] = (),
) -> None:
    """Write planes to one file, whole or not at all; an old file stays when this fails.

    planes: dict of name -> (ny, nx) array, all of one shape.
    notes: dict, or list of (name, text or number), for the file's header; a text of over 255 bytes is written in parts
        `name`, `name_2` .., which read() joins: FFmpeg 5 loses its way in longer ones.
    """
    path = os.fspath(path)
    if not planes:
        raise DesirePathError(f"There is nothing to write to {path}: give at least one map.")
    grids = {}
    for name, plane in planes.items():
        grid = np.ascontiguousarray(plane, np.float32)
        if grid.ndim != 2 or 0 in grid.shape:
            raise DesirePathError(f"The map '{name}' for {path} has the shape {grid.shape}: give it rows and columns.")
        grids[name] = grid
    _write(path, grids, notes)


def write_rows(
    path: str | os.PathLike[str],
    names: Iterable[str],
    shape: tuple[int, int],
    rows: Callable[[str, int, int], np.ndarray],
    notes: Mapping[str, str | float] | Iterable[tuple[str, str | float]] = (),
    layers: bool = True,
) -> None:
    """The same of planes that are never in memory as a whole.

    shape: (ny, nx); rows(name, j, count): float32 (count, nx) of a plane from its row j on
    layers: False for a plain picture: no name becomes a layer, and R, G and B are seen
    """
    ny, nx = shape
    grids = {name: np.zeros((ROWS, nx), np.float32) for name in names}

    def fill(j: int) -> None:
        first, after = max(j, 0), min(j + ROWS, ny)
        for name, grid in grids.items():
            grid[first - j : after - j] = rows(name, first, after - first)

    _write(os.fspath(path), grids, notes, layers, fill, ny)


def _write(
    path: str,
    grids: Mapping[str, np.ndarray],
    notes: Mapping[str, str | float] | Iterable[tuple[str, str | float]],
    layers: bool = True,
    *rows: Any,
) -> None:
    if len({grid.shape for grid in grids.values()}) > 1:
        shapes = ", ".join(f"{name} {grid.shape}" for name, grid in grids.items())
        raise DesirePathError(f"The maps for {path} differ in shape ({shapes}): give all the same.")
    pairs = header.parts(notes)
    atomic_file.check(path, "The maps")
    try:
        _native.maps_write(path, [channel(name, layers) for name in grids], list(grids.values()), pairs, *rows)
    except OSError as problem:
        raise DesirePathError(
            f"{path} cannot be written ({_clause(problem)}): make room or choose another folder."
        ) from None
    except ValueError as problem:
        raise DesirePathError(
            f"{path} cannot be written ({_clause(problem)}): give up to 64 maps of at most 2^32"
            " cells, and maps and notes with different names of 1 to 29 characters that OpenEXR"
            " does not use itself."
        ) from None


def read(path: str | os.PathLike[str]) -> Picture:
    """Read a flat OpenEXR file of any writer as a Picture."""
    path = os.fspath(path)
    try:
        nx, ny, names, data, notes = _native.maps_read(path)
    except OSError:
        raise DesirePathError(f"{path} cannot be opened: check that the file is there and may be read.") from None
    except ValueError as problem:
        if "packing" in str(problem):
            raise DesirePathError(
                f"{path} has a packing unknown here, of a newer OpenEXR: write it again with ZIP, PIZ or none."
            ) from None
        raise DesirePathError(
            f"{path} is damaged or no flat OpenEXR image: write it again, or choose another file."
        ) from None
    grids = np.frombuffer(data, np.float32).reshape(len(names), ny, nx)
    return Picture({name.removesuffix(LAYER): grid for name, grid in zip(names, grids)}, header.joined(notes))


def _clause(problem: Exception) -> str:
    """The core's words without the name of what it was doing."""
    return str(problem).split(": ", 1)[-1]
