"""What a bake will take, estimated before anything is written, and what it may take.

    BakeOptions(limits=Limits(frames=1_000_000, memory=32e9))   python -m desire_path bake .. --limit frames=1000000

Memory and disk are those the computer has free, unless a limit says otherwise. Estimates are of what will be needed
at least, about: a bake that is refused could not have ended.
"""

from __future__ import annotations

import math
import os
import shutil
from collections.abc import Iterable
from dataclasses import dataclass, fields
from typing import Any

from .errors import DesirePathError
from .files import disk

CELLS = (0.0001, 1.0)  # sides of cells that can be worked with [m]
MAX_PIXELS = 1 << 27  # of one frame
SAMPLE_BYTES = 285  # of memory, for each part of a foot at each sample of the walk
CELL_BYTES = 60  # of memory, for each cell of a frame
TILE_BYTES = 200  # .. and for each tile of ground in its maps
PLANT_BYTES = 64  # of memory, for each plant that nobody treads on
RESERVE = 6 << 20  # bytes of memory without which nothing is begun
REST_BYTES = 0.028  # of a frame's file, for each cell of untouched ground
PRINT_BYTES = 8.0  # of a frame's file, for each cell of a print
HELD_BYTES = 100.0  # of the disk, for each cell of a print, where ground waits there for a memory limit
STATES, STATE_BYTES = 2, 12.0  # of those that are kept to go on from, for each cell of a print
ADVICE = {  # name: (unit, what to do)
    "frames": ("frames", "let it end earlier"),
    "seconds": ("seconds of walking", "let it end earlier"),
    "cells": ("cells in a picture", "choose a larger cell size or a shorter walk"),
    "plants": ("plants", "choose a lower density, or plant a rectangle"),
    "memory": ("GB of memory", "choose a larger cell size, fewer frames or fewer plants"),
    "disk": ("GB on the disk", "choose a larger cell size or fewer frames, or make room"),
}
SIZES = {"GB": 1e9, "MB": 1e6, "kB": 1e3}  # [bytes]
SMALL = {  # what is told in smaller units, by these
    "memory": {"MB": "MB of memory", "kB": "kB of memory"},
    "disk": {"MB": "MB on the disk", "kB": "kB on the disk"},
}


@dataclass(frozen=True)
class Limits:
    """What one bake may take; what would take more is refused."""

    frames: float = 250_000  # files it writes for playback, one a frame
    seconds: float = 86_400.0  # of the walk
    cells: float = MAX_PIXELS  # of one frame
    plants: float = 4_000_000  # of one planting
    memory: float | None = None  # [bytes]; None = what is free
    disk: float | None = None  # [bytes]; None = what is free where the files go

    def __post_init__(self) -> None:
        for each in fields(self):
            value = getattr(self, each.name)
            if value is None and each.default is None:
                continue
            if isinstance(value, bool) or not isinstance(value, (int, float)) or not value > 0:
                raise DesirePathError(
                    f"A limit of {str(value)[:40]} {each.name} cannot be kept: give a number above 0."
                )

    @staticmethod
    def read(words: Iterable[str]) -> Limits:
        """Limits from words NAME=NUMBER; memory and disk in GB."""
        found = {}
        for word in words:
            name, _, number = word.partition("=")
            try:
                found[name] = float(number) * (1e9 if name in ("memory", "disk") else 1.0)
            except ValueError:
                name = ""
            if name not in ADVICE:
                raise DesirePathError(
                    f"There is no limit '{word}': write one of {', '.join(ADVICE)} and a number, as in "
                    "frames=1000000; memory and disk in GB."
                )
        return Limits(**found)

    def check(self, name: str, amount: float, folder: str | None = None) -> None:
        """Refuse a bake that takes more of something than it may.

        folder: where the files go, for `disk`
        """
        most, free = getattr(self, name), False
        if most is None:
            most, free = _free(name, folder or os.curdir), True
        if amount <= most:
            return
        unit, advice = ADVICE[name]
        has, about = "are free" if free else "are the limit", "" if name == "frames" else "about "
        taken, there = _number(amount), _number(most)
        if name in SMALL:
            (taken, word), there = _bytes(amount), size_text(most)
            unit = SMALL[name].get(word, unit)
        raise DesirePathError(
            f"This would take {about}{taken} {unit}, and {there} {has}: {advice}, or raise the limit of {name}."
        )


def _number(value: float) -> str:
    if not value < 1e15:
        return f"{value:.3g}"
    return f"{value:,.0f}" if value >= 100 or value == int(value) else f"{value:.3g}"


def _bytes(value: float) -> tuple[str, str]:
    """A size as it is read, and its unit."""
    unit = next((name for name, size in SIZES.items() if value >= 0.1 * size), "kB")
    return _number(value / SIZES[unit]), unit


def size_text(value: float) -> str:
    """A size as it is read: 4.2 GB."""
    return " ".join(_bytes(value))


def _free(name: str, folder: str) -> float:
    """Bytes of memory or disk that may still be had; no end of them where nobody knows."""
    if name == "memory":
        return disk.memory_free()
    while not os.path.isdir(folder):
        folder = os.path.dirname(folder)
    try:
        return shutil.disk_usage(folder).free
    except OSError:
        return math.inf


def check_reserve() -> None:
    """MemoryError where the system gives nothing more.

    Python and the core say in a sentence what they were refused; NumPy's loops over mixed types end the process when
    they are refused their buffers, which are small. So these must be there before anything is begun.
    """
    bytearray(RESERVE)


def frame_bytes(cells: float, pressed: float, lean: bool) -> float:
    """Bytes of an average frame's files. pressed: cells of all prints; lean: with a second picture of grass."""
    return (2.0 if lean else 1.0) * (REST_BYTES * cells + 0.5 * PRINT_BYTES * min(pressed, cells))


def pressed_area(gait: Any, touching: Iterable[Any]) -> float:
    """Of all prints of a walk together, about [m^2]: each time a part comes down it leaves its sole's.

    touching: (P, T), whether each part of the recording's feet is on the ground
    """
    area = 0.0
    for sole, down in zip(gait.soles, touching):
        size = sorted((sole.vertices.max(axis=0) - sole.vertices.min(axis=0)).tolist())
        times = int(down[0] != 0) + int(((down[1:] != 0) & (down[:-1] == 0)).sum())
        area += 0.7 * size[1] * size[2] * times
    return area
