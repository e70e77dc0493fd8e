"""The folder of a bake: what can be played from it, how a fresh bake takes its place, and how it goes.

    frames/     trail_0000.exr .., index.json      frames.new/   the bake that is being made
                lean_0000.exr .., with plants
    maps/       second_0001.exr .., pass_0001.exr  maps.new/     its maps
Files of others in these folders are left alone. bake.py says what each file holds.
"""

from __future__ import annotations

import contextlib
import json
import os
import struct
from dataclasses import dataclass
from pathlib import Path

from .errors import DesirePathError

_MAGIC = (20000630).to_bytes(4, "little")  # of OpenEXR files
OWNER = "bake_folder_owner"  # in index.json
FORMAT = 1  # of index.json; a folder of another format is refused, not guessed at
FRAMES = ("trail_*.exr", "trail_*.part", "lean_*.exr", "lean_*.part", "index.json", "index.json.part")
MAPS = ("second_*.exr", "second_*.part", "pass_*.exr", "pass_*.part")
OURS = {"frames": FRAMES, "frames.new": FRAMES, "frames.old": FRAMES, "maps": MAPS, "maps.new": MAPS,
        "": ("maps_start.exr", "maps_final.exr", "maps_*.part", "report.json", "report.json.part",
             "plants.pc2", "plants.pc2.part", "plants.npz")}


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
    complete: bool
    lean: bool = False  # with lean_0000.exr .., how the grass lies
    owner: str = ""  # id of the ground the bake belongs to; empty = nobody's

    @property
    def missing(self):
        """How many frames are still to be baked."""
        return self.frame_end - self.frame_start + 1 - self.frames

    def path(self, number):
        """File of playback frame `number`: 0 = at rest, 1 = frame_start, .."""
        return frame_path(self.folder, number)

    def lean_path(self, number):
        """The same of how the grass lies, if `lean`."""
        return frame_path(self.folder, number, "lean")


def frame_path(frames_folder, number, film="trail"):
    """trail_0001.exr or lean_0001.exr and so on."""
    return os.path.join(frames_folder, f"{film}_{number:04d}.exr")


def frames_there(frames_folder, lean):
    """How many frames are whole, counted from number 1 on; -1 without the ground at rest."""
    films = ("trail", "lean") if lean else ("trail",)
    number = -1
    while all(_is_whole_frame(frame_path(frames_folder, number + 1, film)) for film in films):
        number += 1
    return number


def _is_whole_frame(path):
    """Whether a tiled OpenEXR file is there to its end: its last tile ends where the file does. Files appear
    whole, but a disk that fails and a copy that stops leave less; what the tiles hold is not looked at."""
    try:
        with open(path, "rb") as file:
            head = file.read(1 << 16)
            found, at = {}, 8
            if head[:4] != _MAGIC:
                return False
            while head[at] != 0:  # attributes: name, type, size, value
                end = head.index(b"\0", at)
                value = head.index(b"\0", end + 1) + 5
                size, = struct.unpack_from("<i", head, value - 4)
                found[head[at:end]] = head[value:value + size]
                at = value + size
            x0, y0, x1, y1 = struct.unpack("<4i", found[b"dataWindow"])
            wide, high = struct.unpack_from("<2I", found[b"tiles"])
            tiles = -((x0 - x1 - 1) // wide) * -((y0 - y1 - 1) // high)
            file.seek(at + 1)
            starts = struct.unpack(f"<{tiles}Q", file.read(8 * tiles))
            file.seek(max(starts) + 16)  # behind the tile's place
            size, = struct.unpack("<i", file.read(4))
            return min(starts) > at and max(starts) + 20 + size == os.fstat(file.fileno()).st_size
    except (OSError, ValueError, IndexError, KeyError, ZeroDivisionError, OverflowError, struct.error):
        return False


def read_index(folder, just_baked=False):
    """What can be played from a bake folder: its FrameIndex. A bake that was stopped counts, with
    complete False. Raises DesirePathError when there is nothing to play.

    just_baked: every frame was written a moment ago, so that their files need no look
    """
    for name in ("frames", "frames.new"):
        frames = os.path.join(folder, name)
        path = os.path.join(frames, "index.json")
        if not os.path.exists(path):
            continue
        try:
            with open(path, encoding="utf-8") as file:
                data = json.load(file)
            form = data["format"]
        except (OSError, ValueError, KeyError, TypeError):
            raise DesirePathError(f"{path} is damaged: bake again.") from None
        if form != FORMAT:
            raise DesirePathError(
                f"The bake in {folder} was written by version {data.get('version', 'unknown')} in another form: bake again."
            )
        try:
            count = int(data["frame_end"]) - int(data["frame_start"]) + 1
            lean = bool(data.get("lean", False))
            there = count if just_baked else max(0, min(count, frames_there(frames, lean)))
            return FrameIndex(
                frames, float(data["cell"]), float(data["x0"]), float(data["y0"]), int(data["nx"]),
                int(data["ny"]), int(data["frame_start"]), int(data["frame_end"]),
                float(data["frame_rate"]), there, there == count, lean,
                owner if isinstance(owner := data.get(OWNER, ""), str) else "",
            )
        except (KeyError, TypeError, ValueError):
            raise DesirePathError(f"{path} is damaged: bake again.") from None
    raise DesirePathError(f"There is no bake in {folder}: bake the ground first.")


def owner_of(folder):
    """Id of the ground whose bake, whole or not, lies in a folder; empty: nobody's, or there is none."""
    for name in ("frames", "frames.new"):
        with contextlib.suppress(OSError, ValueError, RecursionError, AttributeError):
            with open(os.path.join(folder, name, "index.json"), encoding="utf-8") as file:
                found = json.load(file).get(OWNER, "")
            if found and isinstance(found, str):
                return found
    return ""


def check_owner(folder, owner):
    """Refuse a folder with the bake of another ground; who says no owner may have any."""
    other = owner_of(folder)
    if owner and other and owner != other:
        raise DesirePathError(f"The folder {folder} holds the bake of another ground ({other}): choose another folder.")


def free(folder, owner=""):
    """Delete the files a bake wrote, and the folders they leave empty; nothing else is touched.

    owner: id of the ground that frees; another one's bake is refused
    """
    check_owner(folder, owner)
    try:
        for place, patterns in OURS.items():
            delete(os.path.join(folder, place), patterns)
    except OSError as problem:
        raise DesirePathError(
            f"{problem.filename} cannot be deleted ({problem.strerror}): delete the folder {folder} by hand."
        ) from None


def delete(folder, patterns):
    """Delete our files from a folder, and the folder if that leaves it empty."""
    for pattern in patterns:
        for path in Path(folder).glob(pattern):
            path.unlink()
    with contextlib.suppress(OSError):  # not there, or holds somebody else's files
        os.rmdir(folder)


def _move(folder, into):
    """Move what a folder holds into another one, and remove it; what is there already stays."""
    os.makedirs(into, exist_ok=True)
    for path in Path(folder).glob("*"):
        if not os.path.lexists(os.path.join(into, path.name)):
            os.rename(path, os.path.join(into, path.name))
    with contextlib.suppress(OSError):
        os.rmdir(folder)


def write_json(path, data):
    """Write a small file, whole or not at all."""
    part = f"{path}.part"
    with open(part, "w", encoding="utf-8") as file:
        json.dump(data, file, indent=1)
        file.write("\n")
    os.replace(part, path)


def is_whole(frames):
    """Whether a folder of frames holds a bake that came to its end."""
    try:
        with open(os.path.join(frames, "index.json"), encoding="utf-8") as file:
            return bool(json.load(file).get("complete"))
    except (OSError, ValueError, AttributeError):
        return False


def publish(folder, only_if_free=False):
    """Let the fresh frames take the place of the old ones; only_if_free: not of a whole bake."""
    fresh, frames, old = (os.path.join(folder, name) for name in ("frames.new", "frames", "frames.old"))
    if os.path.exists(frames):
        if only_if_free and is_whole(frames):
            return
        delete(old, FRAMES)
        if os.path.exists(old):
            _move(old, frames)
        os.rename(frames, old)
    os.rename(fresh, frames)
    with contextlib.suppress(OSError):  # what cannot be deleted does no harm
        delete(old, FRAMES)
        if os.path.exists(old):
            _move(old, frames)  # somebody else's files
    seconds, there = (os.path.join(folder, name) for name in ("maps.new", "maps"))
    if os.path.exists(seconds):
        delete(there, MAPS)
        _move(seconds, there)
