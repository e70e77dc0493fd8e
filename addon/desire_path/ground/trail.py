"""Ground out of an OpenEXR image or a GeoTIFF: heights of any writer, or a trail as a bake left it.

maps_final.exr, maps/..   rest, compression, heap and pressure_time by name: another walk goes on from there
any other image           the channel height, Z, V, Y, or a grey picture
"""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass

import numpy as np

from ..arrays import Record
from ..bounds import CELLS
from ..errors import DesirePathError
from . import geotiff, maps

LEFT = ("compression", "heap", "pressure_time")  # of a trail, beside the height before it
HEIGHTS = ("height", "Z", "V", "Y")  # what a height may be called
FAR = 1e9  # ground lies nearer than this [m]
SAME = 1e-6  # cells nearer to each other than this are the same [cell]


@dataclass(frozen=True, eq=False, repr=False)
class Trail(Record):
    """What walkers left of a ground: float32 (ny, nx) each, row 0 at the lowest y."""

    path: str
    cell: float  # [m]
    x0: float  # lower left corner of cell (0, 0) [m]
    y0: float  # [m]
    rest: np.ndarray  # height before anybody walked, NaN = no ground [m]
    compression: np.ndarray  # [m] >= 0
    heap: np.ndarray  # [m] >= 0
    pressure_time: np.ndarray  # [Pa s] >= 0
    flat: bool  # level ground without end
    planted: bool  # plants grew on it, which a map does not hold

    def __repr__(self) -> str:
        return f"Trail({self.path!r}, {self.rest.shape[1]} x {self.rest.shape[0]} cells of {self.cell:g} m)"

    def arrays(self) -> list[np.ndarray]:
        """What tells it from another trail."""
        return [np.array([self.cell, self.x0, self.y0]), *(getattr(self, name) for name in ("rest", *LEFT))]

    def cells(self, cell: float, origin: tuple[float, float]) -> tuple[int, int, int, int]:
        """Cells (i0, i1, j0, j1) of another size or place [m] in which something is left; empty where i0 >= i1."""
        j, i = np.nonzero((self.compression > 0.0) | (self.heap > 0.0))
        if not len(i):
            return 0, 0, 0, 0
        ends = [
            (start + self.cell * at - low) / cell
            for start, low, of in ((self.x0, origin[0], i), (self.y0, origin[1], j))
            for at in (of.min(), of.max() + 1)
        ]
        i0, i1, j0, j1 = (round(end) if abs(end - round(end)) < SAME * 1e3 else end for end in ends)
        return math.floor(i0), math.ceil(i1), math.floor(j0), math.ceil(j1)

    def on(self, cell: float, origin: tuple[float, float]) -> tuple[int, int, dict[str, np.ndarray], list[str]]:
        """The trail on cells of another size or place [m]: (i0, j0, its grids by name, sentences)."""
        sentences = (
            [f"The plants of {self.path} are not in the map: what grows here now was not trodden before."]
            if self.planted
            else []
        )
        i0, j0 = (self.x0 - origin[0]) / cell, (self.y0 - origin[1]) / cell
        grids = {name: getattr(self, name) for name in LEFT}
        if (
            abs(cell / self.cell - 1.0) * max(self.rest.shape) < SAME
            and max(abs(i0 - round(i0)), abs(j0 - round(j0))) < SAME
        ):
            return round(i0), round(j0), grids, sentences
        sentences.append(
            f"The cells of {self.path} ({self.cell:g} m from {self.x0:g}, {self.y0:g}) are not those of this "
            f"bake: the trail was averaged over cells of {cell:g} m."
        )
        i0, j0 = math.floor(i0), math.floor(j0)
        ny, nx = (math.ceil(count * self.cell / cell) + 1 for count in self.rest.shape)
        if nx * ny > 1 << 28:
            raise DesirePathError(f"{self.path} covers too many cells of {cell:g} m: choose a larger cell size.")
        at = [
            _shares(start + k * cell - low, cell, self.cell, count)
            for start, low, k, count in (
                (origin[1], self.y0, j0 + np.arange(ny), self.rest.shape[0]),
                (origin[0], self.x0, i0 + np.arange(nx), self.rest.shape[1]),
            )
        ]
        return i0, j0, {name: _averaged(grid, *at) for name, grid in grids.items()}, sentences


def _shares(low: np.ndarray, wide: float, cell: float, count: int) -> tuple[np.ndarray, float]:
    """How far a sum over the first cells goes at both ends of intervals from `low` on, 0..count."""
    return np.clip(np.stack((low, low + wide)) / cell, 0.0, count), wide / cell


def _averaged(grid: np.ndarray, rows: tuple[np.ndarray, float], columns: tuple[np.ndarray, float]) -> np.ndarray:
    """Means of a grid over a lattice of rectangles, what lies outside counted as 0."""
    for (ends, wide), axis in ((rows, 0), (columns, 1)):
        total = np.insert(np.cumsum(grid, axis=axis, dtype=np.float64), 0, 0.0, axis=axis)
        first = np.minimum(ends.astype(int), total.shape[axis] - 2)
        part = np.expand_dims(ends - first, 2 - axis)
        low = np.take(total, first, axis=axis)
        high = np.take(total, first + 1, axis=axis)
        if axis == 0:
            sums = low + (high - low) * part
            grid = (sums[1] - sums[0]) / wide
        else:
            sums = low + (high - low) * part.reshape(1, *ends.shape)
            grid = (sums[:, 1] - sums[:, 0]) / wide
    return np.ascontiguousarray(np.maximum(grid, 0.0), np.float32)


def read(path: str | os.PathLike[str], spacing: float | None = None) -> Trail | tuple[np.ndarray, float, float, float]:
    """What an image says of a ground: a Trail, or (heights, spacing, x0, y0) as Ground.heights takes them.

    spacing: distance of the samples [m], if the file does not say
    """
    path = os.fspath(path)
    if geotiff.is_one(path):
        return geotiff.read(path, spacing)
    picture = maps.read(path)
    if any(name in picture.planes for name in ("rest", *LEFT)):
        return _trail(path, picture)
    plane = _heights(path, picture)
    step = spacing or picture.notes.get("cell")
    if not isinstance(step, (int, float)):
        raise DesirePathError(f"{path} does not say how far its samples are apart: add --spacing METRES.")
    x0, y0 = _place(path, picture)
    return plane, step, x0 + step / 2, y0 + step / 2


def _place(path: str, picture: maps.Picture) -> tuple[float, float]:
    found = [picture.notes.get(name, 0.0) for name in ("originX", "originY")]
    if not all(isinstance(each, float) and abs(each) < FAR for each in found):
        raise DesirePathError(f"{path} does not say where it lies: give originX and originY as numbers [m].")
    x0, y0 = (float(each) for each in found)
    return x0, y0


def _trail(path: str, picture: maps.Picture) -> Trail:
    planes, notes = picture.planes, picture.notes
    if "rest" not in planes:
        raise DesirePathError(
            f"{path} is a map without the height before the walk (no rest.V): bake it again, and go on from that."
        )
    cell = notes.get("cell")
    if not isinstance(cell, float) or not CELLS[0] <= cell <= CELLS[1]:
        raise DesirePathError(f"{path} does not say how large its cells are: give the map as the bake wrote it.")
    nothing = np.zeros_like(planes["rest"])
    left = {name: planes.get(name, nothing) for name in LEFT}
    for name, grid in left.items():
        if not (np.isfinite(grid).all() and (grid >= 0.0).all()):
            raise DesirePathError(f"{path} is damaged: its {name} holds values that no bake writes.")
    rest = planes["rest"]
    if np.isinf(rest).any() or np.isnan(rest).all():
        raise DesirePathError(f"{path} is damaged: its rest heights are no ground.")
    try:
        said = json.loads(str(notes.get("parameters", "{}")))["ground"]
    except (ValueError, TypeError, KeyError, RecursionError):
        said = None
    flat = said == "flat" and bool((rest == rest[0, 0]).all())
    x0, y0 = _place(path, picture)
    grown = any(name in planes and planes[name].any() for name in ("plant_strength", "crushed"))
    return Trail(path, cell, x0, y0, rest, **left, flat=flat, planted=grown)


def _heights(path: str, picture: maps.Picture) -> np.ndarray:
    """The plane of an image that is a height, by its name."""
    planes = picture.planes
    words = ", ".join(sorted(planes)[:8])
    if "channelR" in picture.notes:
        raise DesirePathError(f"{path} is a frame for playback, not a height map: give the bake's maps_final.exr.")
    for name, plane in planes.items():
        if "height" in name.lower().split("."):
            return plane
    for name in HEIGHTS:
        if name in planes:
            return planes[name]
    if "R" in planes and all(
        np.array_equal(planes["R"], planes.get(name, planes["R"]), equal_nan=True) for name in "GB"
    ):
        return planes["R"]
    raise DesirePathError(f"{path} has no channel of heights among {words}: call it height, Z, V or Y [m].")
