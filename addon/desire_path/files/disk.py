"""What differs from one system and one kind of disk to the next; the rest of the add-on asks here.

Linux can exchange two places at once and sync a whole disk; both have a plain way for where it cannot, or for a
disk that cannot. Nothing here knows what a bake is.
"""

from __future__ import annotations

import contextlib
import ctypes
import errno
import os
import socket
import stat
import time
from typing import Any

try:
    import fcntl
except ImportError:  # Windows has other locks
    fcntl = None  # type: ignore[assignment]
try:
    import msvcrt
except ImportError:
    msvcrt = None  # type: ignore[assignment]

_HERE = -100  # AT_FDCWD
_EXCHANGE = 2  # RENAME_EXCHANGE
_BINARY = getattr(os, "O_BINARY", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_NOINHERIT", 0)
_LOCKED_BYTE = 1 << 30  # of a lock's file, where Windows locks it: far behind its text, which others read
_OPEN = (5, 32, 33)  # Windows: access denied, sharing violation, lock violation
_TRIES, _PATIENCE = 50, 0.02  # at a place that is open [-], and between two of them [s]
_CANNOT = (errno.ENOSYS, errno.EINVAL, errno.ENOTSUP, errno.EXDEV, errno.EPERM)


def _system(name: str) -> Any:
    """A function of the C library; None where there is none."""
    try:
        return getattr(ctypes.CDLL(None, use_errno=True), name)
    except (OSError, AttributeError, TypeError):
        return None


_renameat2, _syncfs = _system("renameat2"), _system("syncfs")


def swap(one: str | os.PathLike[str], other: str | os.PathLike[str]) -> bool:
    """Exchange what two paths name, files or folders, at once; False where system or disk cannot do that."""
    if _renameat2 is None:
        return False
    if _renameat2(_HERE, os.fsencode(one), _HERE, os.fsencode(other), _EXCHANGE) == 0:
        return True
    number = ctypes.get_errno()
    if number in _CANNOT:
        return False
    raise OSError(number, os.strerror(number), os.fspath(one))


def replace(path: str | os.PathLike[str], place: str | os.PathLike[str]) -> None:
    """Give a file or folder the name `place`, where a file may stand, at once.

    Windows refuses while somebody has either open, a search or a scanner for a moment: it is asked again for a second.
    """
    for left in reversed(range(_TRIES)):
        try:
            return os.replace(path, place)
        except PermissionError as problem:
            if left == 0 or getattr(problem, "winerror", None) not in _OPEN or os.path.isdir(place):
                raise
        time.sleep(_PATIENCE)


def link(to: str, path: str) -> None:
    """Make a link to a name beside it; OSError where there are none, as on Windows, where few may make them."""
    if os.name == "nt":
        raise OSError(errno.ENOSYS, "links are not made here", path)
    os.symlink(to, path)


def sync(folder: str | os.PathLike[str]) -> None:
    """Return when everything below a folder is on the disk."""
    if _syncfs is not None:
        handle = os.open(folder, os.O_RDONLY)
        try:
            if _syncfs(handle) == 0:
                return
        finally:
            os.close(handle)
    for place, _, names in os.walk(folder):
        for name in names:
            sync_one(os.path.join(place, name))
        sync_one(place)


def sync_one(path: str | os.PathLike[str]) -> None:
    """Return when one file's bytes, or one folder's names, are on the disk."""
    try:
        how = os.O_RDWR if os.name == "nt" else os.O_RDONLY  # Windows syncs what it may write
        handle = os.open(path, how | getattr(os, "O_NOFOLLOW", 0))
    except OSError:  # a link, or a folder on a system that does not open them
        return
    try:
        os.fsync(handle)
    except OSError as problem:
        if problem.errno not in (errno.EINVAL, errno.ENOTSUP):  # disks that sync no folders
            raise
    finally:
        os.close(handle)


def is_plain(path: str | os.PathLike[str]) -> bool:
    """Whether a path names a regular file; a link to one is none."""
    try:
        return stat.S_ISREG(os.lstat(path).st_mode)
    except OSError:
        return False


def memory_free() -> float:
    """Bytes of memory that programs may still have, about; infinite where the system does not say."""
    if os.name == "nt":
        return _memory_free_windows()
    try:
        with open("/proc/meminfo", encoding="ascii") as file:
            amounts = dict(line.split(":", 1) for line in file)
        return 1024.0 * sum(int(amounts[name].split()[0]) for name in ("MemAvailable", "SwapFree"))
    except (OSError, KeyError, ValueError, IndexError):
        return float("inf")


class _MemoryStatus(ctypes.Structure):  # MEMORYSTATUSEX
    _fields_ = [(name, ctypes.c_uint32) for name in ("size", "load")] + [
        (name, ctypes.c_uint64) for name in ("all", "free", "all_paged", "free_paged", "space", "free_space", "more")
    ]


def _memory_free_windows() -> float:
    status = _MemoryStatus(size=ctypes.sizeof(_MemoryStatus))
    succeeded = getattr(ctypes, "windll").kernel32.GlobalMemoryStatusEx(ctypes.byref(status))  # noqa: B009
    return float(status.free_paged) if succeeded else float("inf")


# ---- locks -------------------------------------------------------------------------------------------------


class Held(Exception):
    """A lock is held; its text says by whom."""


def lock(path: str | os.PathLike[str], text: str) -> int:
    """Make a file ours until unlock(); Held(its text) while another, in this process or not, has it.

    The system drops the lock of a process that ends, however it ends, so that its file is taken over. On a disk
    without locks the file itself is one, and the process named first in it has to be alive, here or elsewhere.
    """
    while True:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | _BINARY | getattr(os, "O_NOFOLLOW", 0), 0o666)
        try:
            if not stat.S_ISREG(os.fstat(handle).st_mode):
                raise OSError(errno.EEXIST, "it is no plain file", os.fspath(path))
            before = os.read(handle, 4096).decode("utf-8", "replace")
            if not _locked(handle, before):
                raise Held(before)
            if _same(handle, path):  # else it was released, and is another file by now
                mine, handle = handle, -1
                os.ftruncate(mine, 0)
                os.lseek(mine, 0, os.SEEK_SET)
                os.write(mine, f"{os.getpid()} {socket.gethostname()} {text}\n".encode())
                return mine
        finally:
            if handle >= 0:
                os.close(handle)


def unlock(handle: int, path: str | os.PathLike[str]) -> None:
    """Give up a lock and its file."""
    if msvcrt is not None:  # no open file is removed there, nor one that somebody opened since
        ours = _same(handle, path)
        os.close(handle)
        with contextlib.suppress(OSError):
            if ours:
                os.unlink(path)
        return
    if _same(handle, path):
        os.unlink(path)
    os.close(handle)


def _locked(handle: int, before: str) -> bool:
    """Whether the lock is ours now."""
    try:
        if fcntl is not None:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return True
        if msvcrt is not None:
            os.lseek(handle, _LOCKED_BYTE, os.SEEK_SET)
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
            return True
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        pass  # no locks on this disk
    process, host, *_ = before.split() + ["", ""]
    return not before or host == socket.gethostname() and not _alive(process)


def _alive(process: str) -> bool:
    if os.name == "nt":  # where to ask is to interrupt
        return True
    try:
        os.kill(int(process), 0)
    except (ProcessLookupError, ValueError, OverflowError):
        return False
    except PermissionError:
        pass
    return True


def _same(handle: int, path: str | os.PathLike[str]) -> bool:
    try:
        return os.path.samestat(os.fstat(handle), os.lstat(path))
    except OSError:
        return False
