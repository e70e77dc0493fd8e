"""The ground after a walk as heights of 16 bit, for game engines and makers of terrain: a picture or bare numbers.

    height = offset + scale * value        [m]

A file beside it says offset and scale, where the ground lies, and how large it is. Rows go from the highest y to
the lowest, as pictures are seen from above; no height is further from its own than half a scale.
"""

from __future__ import annotations

import os
import struct
import zlib
from typing import Any

import numpy as np

from ..errors import DesirePathError
from ..files import atomic_file
from . import trail

KINDS = (".png", ".raw", ".r16")  # a grey picture; little-endian numbers, row after row
TOP = 65535  # the largest value [-]
WIDEST = 1 << 24  # a side of a picture [pixel]


def heights(path: str | os.PathLike[str], spacing: float | None = None) -> tuple[np.ndarray, float, float, float]:
    """(heights, spacing, x, y) of a bake's folder, its maps or any image of heights; float64 (ny, nx) [m], NaN = none.

    spacing: distance of the samples, if the file does not say [m]; x, y: of the sample at row 0, the lowest y [m]
    """
    path = os.fspath(path)
    if os.path.isdir(path):
        path = os.path.join(path, "maps_final.exr")
        if not os.path.isfile(path):
            raise DesirePathError(f"{path} is not there: bake with maps, or give the file of maps itself.")
    found = trail.read(path, spacing)
    if not isinstance(found, trail.Trail):
        plane, step, x, y = found
        return plane.astype(np.float64), step, x, y
    now = found.rest.astype(np.float64) - found.compression + found.heap
    return now, found.cell, found.x0 + found.cell / 2, found.y0 + found.cell / 2


def values(grid: np.ndarray) -> tuple[np.ndarray, float, float]:
    """(values, offset, scale) of heights [m]: uint16 (ny, nx). Where there is none it is 0, and 1 the lowest."""
    there = np.isfinite(grid)
    if not there.any():
        raise DesirePathError("There is no ground in these heights: give a map of some.")
    low, high = float(grid[there].min()), float(grid[there].max())
    first = 0 if there.all() else 1
    scale = (high - low) / (TOP - first)
    if not np.isfinite(scale):
        raise DesirePathError("These heights are too far apart to be told: give a map of ground.")
    offset = low - first * scale
    steps = (grid - low) / scale if scale > 0.0 else np.where(there, 0.0, np.nan)
    return np.where(there, np.rint(steps) + first, 0.0).astype(np.uint16), offset, scale


def check(path: str | os.PathLike[str]) -> str:
    """The name of the file beside `path`; DesirePathError where either cannot be written."""
    start, kind = os.path.splitext(os.fspath(path))
    if kind.lower() not in KINDS:
        raise DesirePathError(
            f"{path} is of no kind that is written: give it a name that ends with {', '.join(KINDS)}."
        )
    beside = f"{start}.json"
    for each in (path, beside):
        atomic_file.check(each, "The heights")
    return beside


def write(source: str | os.PathLike[str], path: str | os.PathLike[str], spacing: float | None = None) -> dict[str, Any]:
    """Write heights of a bake's folder, its maps or any image of heights, and what is said beside them; returns that.

    path: a picture (.png, grey, 16 bit) or bare numbers (.raw, .r16); beside it the same name with .json
    spacing: as for heights()
    """
    beside = check(path)
    grid, step, x, y = heights(source, spacing)
    coded, offset, scale = values(grid)
    rows, columns = coded.shape
    about = {
        "format": "height16",
        "columns": columns,
        "rows": rows,
        "spacing": step,  # of the samples [m]
        "x": x,  # of the first column [m]
        "y": y + step * (rows - 1),  # of the first row, the highest [m]
        "offset": offset,  # [m]
        "scale": scale,  # [m]
        "lowest": offset + scale * int(coded[np.isfinite(grid)].min()),  # [m]
        "highest": offset + scale * int(coded.max()),  # [m]
        "holes": int(coded.size - np.isfinite(grid).sum()),  # samples without ground: their value is 0
    }
    from_above = coded[::-1]
    picture = os.fspath(path).lower().endswith(".png")
    if picture and max(rows, columns) > WIDEST:
        raise DesirePathError(f"{path} cannot be so large: write .raw, or bake with a larger cell size.")
    with atomic_file.file(path, "The heights") as file:
        file.write(_png(from_above) if picture else from_above.astype("<u2").tobytes())
    atomic_file.write_json(beside, about, "What is said of the heights")
    return about


def _png(grid: np.ndarray) -> bytes:
    """A grey picture of 16 bit; ISO/IEC 15948."""
    rows, columns = grid.shape
    lines = np.zeros((rows, 1 + 2 * columns), np.uint8)  # each behind its filter, none
    lines[:, 1:] = np.ascontiguousarray(grid, ">u2").view(np.uint8).reshape(rows, -1)
    header = struct.pack(">IIBBBBB", columns, rows, 16, 0, 0, 0, 0)
    parts = ((b"IHDR", header), (b"IDAT", zlib.compress(lines.tobytes(), 6)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)) for name, data in parts
    )
