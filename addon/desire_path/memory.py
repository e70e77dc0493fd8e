"""A limit of memory that a program keeps to: what does not fit waits on the disk, and nothing else changes.

    with memory.held("4G", "bake"):            Bake(.., options=BakeOptions(memory="4G"))
        Bake(..).run()                         python -m desire_path bake walk.npz --out bake --memory 4G

The limit is of all that the program takes, Python and Blender too. What the core works with lies in a file without a
name in the folder, and leaves memory where the program comes near its limit; it is gone with the program, however that
ends.
"""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Iterator, Sequence
from typing import Any

from .bounds import size_text
from .core import _native
from .errors import DesirePathError

LEAST = 48e6  # that work needs beside what a program takes before it [bytes]
ROOM = 32e6  # .. and beside what cannot leave, once all is there
_limits: list[float] = []  # that are kept to now
STRETCH = 1 << 20  # bytes that are read or written at once
UNITS = {"": 1.0, "K": 1e3, "M": 1e6, "G": 1e9, "T": 1e12}


def size_of(limit: float | str | None) -> float | None:
    """Bytes of a limit: a number of them, or a text as 4G, 800M; None: there is none. DesirePathError for others."""
    if limit is None:
        return None
    size = 0.0
    if isinstance(limit, str):
        found = re.fullmatch(r"\s*(\d+\.?\d*|\.\d+)\s*([KMGT]?)(?:I?B)?\s*", limit.upper())
        size = float(found[1]) * UNITS[found[2]] if found else 0.0
    elif isinstance(limit, (int, float)) and not isinstance(limit, bool):
        size = float(limit)
    if not 0.0 < size < 1e18:
        raise DesirePathError(f"A memory limit of {str(limit)[:40]} cannot be kept: write one as 4G or 800M.")
    return size


def check(limit: float | None, more: float = 0.0) -> None:
    """Refuse a limit [bytes] below what the program takes now, what is yet to come, and what work needs."""
    if limit is not None:
        _refuse_below(_native.memory_resident() + more + LEAST, limit)


def check_rest(more: float = 0.0) -> None:
    """Refuse a limit that leaves too little for work beside what cannot leave, more of which is yet to come [bytes];
    nothing where none is kept to."""
    if _limits:
        _native.memory_leave()
        _refuse_below(_native.memory_needs() + more + ROOM, min(_limits))


def check_kept() -> None:
    """Refuse to go on where what cannot leave has come over the limit there is now."""
    if _limits and _native.memory_needs() > min(_limits):
        _refuse_below(_native.memory_needs() + LEAST, min(_limits))


def _refuse_below(needed: float, limit: float) -> None:
    if needed > limit:
        enough = size_text(1.02 * needed)
        raise DesirePathError(
            f"This cannot be done in {size_text(limit)} of memory: give at least {enough}, or no limit."
        )


def contents(file: Any) -> memoryview:
    """What is left of a file that was opened to read bytes, in memory that may leave."""
    size = os.fstat(file.fileno()).st_size - file.tell()
    found = memoryview(_native.block(size))
    for first in range(0, size, STRETCH):
        file.readinto(found[first : first + STRETCH])
        _native.memory_ease()
    return found


def joined(parts: Sequence[bytes | memoryview]) -> memoryview:
    """Bytes one after the other, in memory that may leave."""
    found = memoryview(_native.block(sum(len(part) for part in parts)))
    at = 0
    for part in parts:
        for first in range(0, len(part), STRETCH):
            piece = part[first : first + STRETCH]
            found[at : at + len(piece)] = piece
            at += len(piece)
            _native.memory_ease()
    return found


def write(file: Any, found: memoryview) -> None:
    """Write bytes of such memory."""
    for first in range(0, found.nbytes, STRETCH):
        file.write(found[first : first + STRETCH])
        _native.memory_ease()


@contextlib.contextmanager
def held(limit: float | str | None, folder: str | os.PathLike[str]) -> Iterator[None]:
    """Keep to a limit meanwhile. folder: where what leaves memory waits, made if it is not there; it needs as much
    room.

    Within another limit the smaller one counts. DesirePathError where the limit is below what is taken already, OSError
    where the folder cannot be written; a full disk later is an OSError of whatever was done then.
    """
    size = size_of(limit)
    if size is None:
        yield
        return
    check(size)
    os.makedirs(folder, exist_ok=True)
    try:
        _native.memory_hold(os.path.join(os.fspath(folder), f"memory.{os.getpid()}.part"), int(size))
    except ValueError:
        raise DesirePathError(
            "This system does not say how much memory a program takes: leave out the memory limit."
        ) from None
    _limits.append(size)
    try:
        yield
    finally:
        _limits.remove(size)
        _native.memory_release()
