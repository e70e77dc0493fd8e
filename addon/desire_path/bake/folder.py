"""What can be played from the folder of a bake: its index, its frames, and whether they are whole.

output.py says where they lie while a bake is made and how it takes the place of another one; bake.py what each
file holds.
"""

from __future__ import annotations

import contextlib
import math
import os
import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from .. import memory
from ..core import _native, side_by_side
from ..errors import DesirePathError
from ..files import atomic_file, disk
from ..ground import maps
from .atlas import TABLE, Atlas
from .contents import NEW, OWNER, index_data, owner_of  # noqa: F401  (found here, too)
from .output import check_owner, free, settle  # noqa: F401

_MAGIC = (20000630).to_bytes(4, "little")  # of OpenEXR files
INPUTS = "inputs"  # in index.json
FORMAT = 1  # of index.json; a folder of another format is refused, not guessed at
SPARSE = 2  # the same where pictures hold some pages of the ground alone
ATLAS = "atlas"  # in index.json: how many pages they hold
SUMS = "trail_sums.txt"  # beside the frames: name and checksum, a line each
SPRAY_SUMS = "spray_sums.txt"  # the same of what flies, each with how many grains
ZIP_LINES = 16  # packed together in a file without tiles
MAX_SIDE = 1 << 30  # cells of a frame
AT_ONCE = 64  # frames are looked at
MAX_FRAME = 1 << 31  # a frame's number may be


@dataclass(frozen=True)
class FrameIndex:
    """Where a bake's frames lie: the picture's lower left corner, its size, and its frames."""

    folder: str  # holds trail_0000.exr ..
    cell: float  # [m]
    x0: float  # [m]
    y0: float  # [m]
    nx: int
    ny: int
    frame_start: int  # scene frame of trail_0001.exr
    frame_end: int  # scene frame of the last file when the bake is whole
    frame_rate: float  # [1/s]
    frames: int  # files that are there and whole, counted from trail_0001.exr on
    complete: bool  # all frames are there, and the bake came to its end
    lean: bool = False  # with lean_0000.exr .., how the grass lies
    grain_size: float = 0.0  # > 0: with spray_0000.exr .., what flies: grains so wide [m]
    owner: str = ""  # id of the ground the bake belongs to; empty = nobody's
    inputs: dict[str, Any] = field(default_factory=dict)  # words for what it was made from, as Bake was given them
    columns: int = 0  # of pages in a picture that shows the ground near prints alone; 0: it shows all of nx x ny cells
    rows: int = 0  # .. of pages

    @property
    def missing(self) -> int:
        """How many frames are still to be baked."""
        return self.frame_end - self.frame_start + 1 - self.frames

    def path(self, number: int) -> str:
        """File of playback frame `number`: 0 = at rest, 1 = frame_start, .."""
        return frame_path(self.folder, number)

    def lean_path(self, number: int) -> str:
        """The same of how the grass lies, if `lean`."""
        return frame_path(self.folder, number, "lean")

    def spray_path(self, number: int) -> str:
        """The same of what flies, if `grain_size`: for ground.spray.read_frame."""
        return frame_path(self.folder, number, "spray")

    @cached_property
    def atlas(self) -> Atlas | None:
        """Where the pages of the pictures lie; None: the pictures show all."""
        if not self.columns:
            return None
        return Atlas.read(self.folder, self.columns, self.rows, self.nx, self.ny)

    def planes(self, number: int, film: str = "trail") -> dict[str, np.ndarray]:
        """Channels R, G, B, A of playback frame `number`, of all cells (ny, nx); beside the pages of a sparse one 0."""
        found = dict(maps.read(frame_path(self.folder, number, film)).planes)
        if self.atlas is None:
            return found
        return {name: self.atlas.spread(plane, self.nx, self.ny) for name, plane in found.items()}

    def most_grains(self) -> int:
        """As many fly at most in any frame."""
        return max((count for _, count in spray_sums(self.folder).values()), default=0)


def frame_path(frames_folder: str, number: int, film: str = "trail") -> str:
    """trail_0001.exr or lean_0001.exr and so on."""
    return os.path.join(frames_folder, frame_name(number, film))


def frame_name(number: int, film: str = "trail") -> str:
    return f"{film}_{number:04d}.exr"


def _films(lean: bool, spray: bool) -> tuple[str, ...]:
    return ("trail", *(["lean"] if lean else []), *(["spray"] if spray else []))


def frames_there(frames_folder: str, lean: bool, up_to: int = MAX_FRAME, spray: bool = False) -> int:
    """How many frames, up to number `up_to`, are whole, counted from number 1 on; -1 without the ground at rest."""
    number = -1
    while number < up_to and all(
        _is_entire(frame_path(frames_folder, number + 1, film)) for film in _films(lean, spray)
    ):
        number += 1
    return number


def _is_entire(path: str) -> bool:
    """Whether an OpenEXR file is there to its end: its last tile, or lines, end where the file does. Files appear
    whole, but a disk that fails and a copy that stops leave less; what the tiles hold is not looked at."""
    try:
        with atomic_file.reader(path) as file:
            long = os.fstat(file.fileno()).st_size
            head = file.read(1 << 16)
            found: dict[bytes, bytes] = {}
            at = 8
            if head[:4] != _MAGIC:
                return False
            while head[at] != 0:  # attributes: name, type, size, value
                end = head.index(b"\0", at)
                value = head.index(b"\0", end + 1) + 5
                (size,) = struct.unpack_from("<i", head, value - 4)
                if size < 0:
                    return False
                found[head[at:end]] = head[value : value + size]
                at = value + size
            x0, y0, x1, y1 = struct.unpack("<4i", found[b"dataWindow"])
            is_tiled = b"tiles" in found
            wide, high = struct.unpack_from("<2I", found[b"tiles"]) if is_tiled else (x1 - x0 + 1, ZIP_LINES)
            tiles = -((x0 - x1 - 1) // wide) * -((y0 - y1 - 1) // high)
            if not 0 < 8 * tiles < long:
                return False
            file.seek(at + 1)
            starts = struct.unpack(f"<{tiles}Q", file.read(8 * tiles))
            before = 16 if is_tiled else 4  # the tile's place, or the line
            file.seek(max(starts) + before)
            (size,) = struct.unpack("<i", file.read(4))
            return min(starts) > at and max(starts) + before + 4 + size == long
    except (OSError, ValueError, IndexError, KeyError, ZeroDivisionError, OverflowError, struct.error):
        return False


# ---- checksums -----------------------------------------------------------------------------------------------


def list_sums(frames: str, known: Mapping[str, str]) -> None:
    """Begin the list of checksums with those of frames and maps that are there already, a dict by name. The core adds
    each file as soon as it is there (Film.list_files): what a bake that goes on may rely on."""
    with atomic_file.file(os.path.join(frames, SUMS), "The list of checksums", "w", False, encoding="utf-8") as file:
        file.writelines(f"{name} {found}\n" for name, found in known.items())


def order_sums(frames: str) -> None:
    """Put the list of a whole bake in the order of its names: files are listed as they come to be written."""
    with atomic_file.reader(os.path.join(frames, SUMS)) as file:
        known = dict(line.decode("ascii").split() for line in sorted(file))
    list_sums(frames, known)


def _sum(path: str) -> str:
    """How many bytes a file has, and their digest, as the core lists it."""
    with atomic_file.reader(path) as file:
        content = memory.contents(file)
    return f"{len(content)}:{_native.digest(content).hex()}"


def spray_sums(frames: str) -> dict[str, tuple[str, int]]:
    """(checksum, how many fly) of frames of a spray by name, as they were written."""
    found = {}
    with contextlib.suppress(OSError, ValueError), atomic_file.reader(os.path.join(frames, SPRAY_SUMS)) as file:
        for line in file:
            name, checksum, count = line.decode("ascii").split()
            found[name] = checksum, int(count)
    return found


def add_spray(frames: str, name: str, count: int) -> None:
    """A frame of a spray is there, in which so many fly."""
    with open(os.path.join(frames, SPRAY_SUMS), "a", encoding="ascii") as file:
        file.write(f"{name} {_sum(os.path.join(frames, name))} {count}\n")


def frames_sound(frames: str, lean: bool, spray: bool = False) -> tuple[int, dict[str, str], dict[str, str]]:
    """(how many frames are bit for bit what was written, from number 1 on, -1 without the ground at rest; their
    checksums by name; those of all files that were written)."""
    known: dict[str, str] = {}
    sound: dict[str, str] = {}
    number = -1
    try:
        with atomic_file.reader(os.path.join(frames, SUMS)) as file:
            for line in file:
                name, _, found = line.decode("ascii", "replace").strip().partition(" ")
                known[name] = found
    except OSError:
        return -1, {}, {}
    known.update({name: checksum for name, (checksum, _) in spray_sums(frames).items()})
    while True:
        next_ones = range(number + 1, number + 1 + AT_ONCE)
        names = [[frame_name(each, film) for film in _films(lean, spray)] for each in next_ones]
        for several, good in zip(names, side_by_side(lambda of: all(is_sound(frames, n, known) for n in of), names)):
            if not good:
                return number, sound, known
            sound.update((name, known[name]) for name in several)
            number += 1


def is_sound(folder: str, name: str, known: Mapping[str, str]) -> bool:
    """Whether a file is bit for bit what was written; known: checksums by name."""
    path = os.path.join(folder, name)
    try:
        return name in known and disk.is_plain(path) and _sum(path) == known[name]
    except OSError:
        return False


# ---- the index ----------------------------------------------------------------------------------------------


def read_index(folder: str | os.PathLike[str], just_baked: bool = False) -> FrameIndex:
    """What can be played from a bake folder: its FrameIndex. A bake that was stopped counts, with
    complete False. Raises DesirePathError when there is nothing to play.

    just_baked: every frame was written a moment ago, so that their files need no look
    """
    settle(folder)
    for name in ("frames", os.path.join(NEW, "frames")):
        frames = os.path.join(folder, name)
        path = os.path.join(frames, "index.json")
        if not os.path.exists(path):
            continue
        data = index_data(frames)
        if "format" not in data:
            raise DesirePathError(f"{path} is damaged: bake again.")
        if data["format"] not in (FORMAT, SPARSE):
            raise DesirePathError(
                f"The bake in {folder} was written by version {str(data.get('version'))[:40]} in "
                "another form: bake again."
            )
        try:
            return _index(frames, data, just_baked)
        except (KeyError, TypeError, ValueError, OverflowError):
            raise DesirePathError(f"{path} is damaged: bake again.") from None
    raise DesirePathError(f"There is no bake in {folder}: bake the ground first.")


def _index(frames: str, data: Mapping[str, Any], just_baked: bool) -> FrameIndex:
    cell, rate = _number(data["cell"]), _number(data["frame_rate"])
    nx, ny = (_count(data[name], 1, MAX_SIDE) for name in ("nx", "ny"))
    first = _count(data["frame_start"], -MAX_FRAME, MAX_FRAME)
    last = _count(data["frame_end"], first, MAX_FRAME)
    if cell <= 0.0 or rate <= 0.0:
        raise ValueError
    pages = data[ATLAS] if data["format"] == SPARSE else {"columns": 0, "rows": 0}
    columns, rows = (_count(pages[name], 0, MAX_SIDE) for name in ("columns", "rows"))
    if columns and not _is_entire(os.path.join(frames, TABLE)):
        raise ValueError
    count, lean, owner = last - first + 1, data.get("lean", False) is True, data.get(OWNER, "")
    size = _number(data.get("grain_size", 0.0))
    there = count if just_baked else max(0, frames_there(frames, lean, count, size > 0.0))
    return FrameIndex(
        frames,
        cell,
        _number(data["x0"]),
        _number(data["y0"]),
        nx,
        ny,
        first,
        last,
        rate,
        there,
        there == count and data.get("complete", True) is True,
        lean,
        size,
        owner if isinstance(owner, str) else "",
        inputs if isinstance(inputs := data.get(INPUTS), dict) else {},
        columns,
        rows,
    )


def _number(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ValueError
    return float(value)


def _count(value: object, low: int, high: int) -> int:
    number = _number(value)
    if not low <= number <= high or number != int(number):
        raise ValueError
    return int(number)
