"""Files that appear whole or not at all, and only where nothing but a plain file stood: the one door for writing.

A device, a FIFO, a link or a folder at the place is refused with a sentence, never replaced and never written
through; the file grows beside it under a name of its own, is synced, and takes the place at once.
"""

from __future__ import annotations

import contextlib
import errno
import json
import os
import re
import stat
import tempfile
from collections.abc import Iterator
from typing import IO, Any, BinaryIO

from ..errors import DesirePathError
from . import disk

KINDS = (
    (stat.S_ISLNK, "link"),
    (stat.S_ISDIR, "folder"),
    (stat.S_ISFIFO, "pipe"),
    (stat.S_ISSOCK, "socket"),
    (stat.S_ISCHR, "device"),
    (stat.S_ISBLK, "device"),
)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def kind_of(path: str | os.PathLike[str]) -> str:
    """What stands at a path: "file", "folder", "link", "pipe", "socket", "device"; "" = nothing."""
    try:
        mode = os.lstat(path).st_mode
    except FileNotFoundError:
        return ""
    return next((name for test, name in KINDS if test(mode)), "file")


def check(path: str | os.PathLike[str], what: str) -> None:
    """Refuse a path where something stands that is no plain file. what: as for file()."""
    try:
        found = kind_of(path)
    except (OSError, ValueError) as problem:
        raise DesirePathError(_sentence(what, path, problem)) from None
    if not os.path.isdir(os.path.dirname(os.path.abspath(path))):
        raise DesirePathError(
            f"{what} cannot be written to {path}, whose folder is not there: choose another folder or make this one."
        )
    if found not in ("", "file"):
        raise DesirePathError(f"{what} cannot be written to {path}, which is a {found}: choose the name of a file.")


def reader(path: str | os.PathLike[str]) -> BinaryIO:
    """Open a plain file, or a link to one, for reading bytes; OSError for what could wait or never end."""
    handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    try:
        if not stat.S_ISREG(os.fstat(handle).st_mode):
            raise OSError(errno.EINVAL, "it is no plain file", os.fspath(path))
        return os.fdopen(handle, "rb")
    except BaseException:
        os.close(handle)
        raise


@contextlib.contextmanager
def file(
    path: str | os.PathLike[str], what: str, mode: str = "wb", sync: bool = True, **more: Any
) -> Iterator[IO[Any]]:
    """Open a temporary file beside `path` that takes its place when the block ends well.

    what: "The recording", for the sentence that says why it could not be written. An earlier file stays as
    it was when anything goes wrong. `more` goes to open().
    sync: see that it is on the disk; False where disk.sync() will, before anybody relies on it.
    """
    path = os.fspath(path)
    check(path, what)
    temporary, folder = None, os.path.dirname(os.path.abspath(path))
    try:
        name = os.fsdecode(os.fsencode(os.path.basename(path))[:100])  # names may have 255 bytes
        handle, temporary = tempfile.mkstemp(".part", f"{name}.", folder)
        with os.fdopen(handle, mode, **more) as stream:
            yield stream
            stream.flush()
            if sync:
                os.fsync(stream.fileno())
        os.chmod(temporary, 0o666 & ~_umask())
        check(path, what)
        disk.replace(temporary, path)
        temporary = None
        if sync:
            disk.sync_one(folder)
    except OSError as problem:
        raise DesirePathError(_sentence(what, path, problem)) from None
    except MemoryError:
        raise DesirePathError(
            f"There is not enough memory to write {what.lower()}: close other programs or make less of it."
        ) from None
    finally:
        if temporary is not None:
            with contextlib.suppress(OSError):
                os.unlink(temporary)


def sweep(folder: str | os.PathLike[str], names: str) -> None:
    """Remove what a process that was killed left of files it had begun; nobody else may be writing them.

    names: a regular expression of their names.
    """
    begun = re.compile(rf"(?:{names})\.\w{{8}}\.part")
    with contextlib.suppress(OSError):
        for each in os.scandir(folder):
            if begun.fullmatch(each.name) and each.is_file(follow_symlinks=False):
                os.unlink(each.path)


def _sentence(what: str, path: str | os.PathLike[str], problem: Exception) -> str:
    return (
        f"{what} cannot be written to {path} ({getattr(problem, 'strerror', None) or problem}): choose another "
        "folder or make room."
    )


def write_json(path: str | os.PathLike[str], data: object, what: str, sync: bool = True) -> None:
    """Write a small file as JSON, whole or not at all; sync: as for file()."""
    with file(path, what, "w", sync, encoding="utf-8") as stream:
        json.dump(data, stream, indent=1)
        stream.write("\n")
