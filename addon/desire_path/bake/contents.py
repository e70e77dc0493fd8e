"""How the files of a bake are named, what they say of themselves, and how they are deleted and moved.

frames/ maps/ maps_final.exr ..   the bake that is shown: NAMES
bake.new/                         the one that is being made, under the same names
bake.lock                         while one is made: its process, computer and time
bake.old/ bake.shown              for a moment, while the new one takes the place of the old one: exchange.py
"""

from __future__ import annotations

import contextlib
import fnmatch
import json
import os
from collections.abc import Container, Iterable
from pathlib import Path
from typing import Any

from ..files import atomic_file, disk

FRAMES = (
    "trail_*.exr",
    "pages.exr",
    "pages.*part",
    "trail_*.part",
    "lean_*.exr",
    "lean_*.part",
    "spray_*.exr",
    "spray_*.part",
    "index.json",
    "index.json.*part",
    "trail_sums.txt",
    "trail_sums.txt.*part",
    "spray_sums.txt",
    "spray_sums.txt.*part",
    "bake_*.state",
    "bake_*.state.*part",
    "plants.pc2.part",
)
MAPS = ("second_*.exr", "second_*.part", "pass_*.exr", "pass_*.part")
FILES = ("maps_start.exr", "maps_final.exr", "report.json", "plants.pc2", "plants.npz")
MAPS_ALWAYS = FILES[:3]  # every whole bake has these
NAMES = ("frames", "maps", *FILES)
NEW, OLD, SHOWN, LOCK = "bake.new", "bake.old", "bake.shown", "bake.lock"
PARTS = tuple(f"{name}*.part" for name in (*FILES, SHOWN))
INSIDE = {"frames": FRAMES, "maps": MAPS, "": FILES + PARTS}
EARLIER = {"frames.new": FRAMES, "frames.old": FRAMES, "maps.new": MAPS}  # of earlier versions: stopped bakes
OWNER = "bake_folder_owner"  # in index.json
MAX_JSON = 1 << 22  # bytes of an index.json


def index_data(frames: str | os.PathLike[str]) -> dict[str, Any]:
    """What the index.json of a folder of frames says; empty where there is none that can be read."""
    return _json(os.path.join(frames, "index.json"))


def _json(path: str) -> dict[str, Any]:
    """The dict in a JSON file of a bake; empty where there is none."""
    try:
        with atomic_file.reader(path) as file:
            text = file.read(MAX_JSON + 1)
        data = json.loads(text.decode("utf-8")) if len(text) <= MAX_JSON else {}
    except (OSError, ValueError, RecursionError, MemoryError):
        return {}
    return data if isinstance(data, dict) else {}


def holds_bake(folder: str) -> bool:
    """Whether the files in a folder that are named as those of a bake are a bake's, or what is left of one."""
    there = (os.path.join(folder, "frames"), os.path.join(folder, NEW, "frames"))
    return any(
        os.path.isfile(os.path.join(each, name)) for each in there for name in ("index.json", "trail_sums.txt")
    ) or {"parameters", "version"} <= set(_json(os.path.join(folder, "report.json")))


def is_complete(frames: str | os.PathLike[str]) -> bool:
    """Whether a folder of frames holds a bake that came to its end."""
    return index_data(frames).get("complete") is True


def owner_of(folder: str | os.PathLike[str]) -> str:
    """Id of the ground whose bake, whole or not, lies in a folder; empty: nobody's, or there is none."""
    for name in ("frames", f"{NEW}/frames"):
        found = index_data(os.path.join(folder, name)).get(OWNER, "")
        if found and isinstance(found, str):
            return found
    return ""


def delete(folder: str, patterns: Iterable[str], keep: Container[str] = (), itself: bool = True) -> None:
    """Delete our files from a folder but those named in `keep`, and `itself` if that leaves it empty."""
    if os.path.islink(folder) or not os.path.isdir(folder):
        return
    for name in os.listdir(folder):
        path = Path(folder, name)
        ours = name not in keep and any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)
        if ours and (path.is_symlink() or not path.is_dir()):
            path.unlink()
    if itself:
        with contextlib.suppress(OSError):  # not there, or holds somebody else's files
            os.rmdir(folder)


def move(folder: str, into: str) -> None:
    """Move what a folder holds into another one, under a free name, and remove it."""
    os.makedirs(into, exist_ok=True)
    for name in os.listdir(folder):
        path, number = Path(folder, name), 1
        while os.path.lexists(os.path.join(into, name)):
            number += 1
            name = f"{path.stem} {number}{path.suffix}"
        disk.replace(path, os.path.join(into, name))
    with contextlib.suppress(OSError):
        os.rmdir(folder)


def is_link(path: str, name: str) -> bool:
    """Whether a path is our link for `name` while a bake takes its place."""
    try:
        return os.readlink(path) == f"{SHOWN}/{name}"
    except (OSError, ValueError):
        return False
