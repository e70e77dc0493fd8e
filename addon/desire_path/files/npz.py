"""Arrays of an .npz file, read so that no file, however damaged or ill meant, costs more than it may.

What the file says of itself is held against what is there before memory is asked for: sizes, types, shapes. Packed
members may be no larger than `max_bytes` when unpacked; encrypted ones, pickled objects and bare .npy are refused.
"""

from __future__ import annotations

import ast
import math
import os
import zipfile
import zlib

import numpy as np

from . import atomic_file

MAX_BYTES = 2 << 30  # bytes of all arrays together
_MAX_ARRAYS = 64
_MAX_HEADER = 4096  # bytes
_MAX_PACKED = 1100  # times as long as packed; deflate's own bound is 1032
_KINDS = "biufU"  # types of arrays: truth, numbers, text
_DAMAGE = (
    OSError,
    ValueError,
    TypeError,
    KeyError,
    EOFError,
    RuntimeError,
    SyntaxError,
    OverflowError,
    MemoryError,
    RecursionError,
    NotImplementedError,
    zipfile.BadZipFile,
    zlib.error,
)


class Damaged(Exception):
    """The file is no .npz that may be read; the text is a clause that says why."""


def read(path: str | os.PathLike[str], max_bytes: int = MAX_BYTES) -> dict[str, np.ndarray]:
    """The arrays of a file by name. FileNotFoundError, PermissionError, or Damaged for whatever else is wrong."""
    try:
        with atomic_file.reader(path) as file:
            long = os.fstat(file.fileno()).st_size
            if long > max_bytes:
                raise Damaged(f"it is larger than {max_bytes / 1e9:.1f} GB")
            with zipfile.ZipFile(file) as box:
                return _unpacked(box, max_bytes, long)
    except (FileNotFoundError, PermissionError):
        raise
    except zipfile.BadZipFile:
        raise Damaged("it is no .npz") from None
    except MemoryError:
        raise Damaged("there is not enough memory for it") from None
    except _DAMAGE as problem:
        raise Damaged(_clause(problem)) from None


def _clause(problem: Exception) -> str:
    return " ".join(str(problem).split())[:100] or type(problem).__name__


def _unpacked(box: zipfile.ZipFile, max_bytes: int, long: int) -> dict[str, np.ndarray]:
    members = box.infolist()
    if len(members) > _MAX_ARRAYS:
        raise Damaged(f"it holds {len(members)} files")
    if sum(member.file_size for member in members) > max_bytes:
        raise Damaged(f"its arrays take more than {max_bytes / 1e9:.1f} GB")
    if any(member.file_size > _MAX_PACKED * member.compress_size for member in members) or long < sum(
        member.compress_size for member in members
    ):
        raise Damaged("it says that it holds more than it can")
    if any(member.flag_bits & 1 for member in members):
        raise Damaged("it is encrypted")
    heads = [_head(box, member) for member in members]  # all of them, before any of the numbers
    return {member.filename.removesuffix(".npy"): _array(box, member, *head) for member, head in zip(members, heads)}


def _head(box: zipfile.ZipFile, member: zipfile.ZipInfo) -> tuple[int, np.dtype, bool, tuple[int, ...]]:
    """(bytes before the numbers, type, whether columns come first, shape) of a member."""
    with box.open(member) as stream:
        begin = stream.read(10)
        if len(begin) < 10 or begin[:6] != b"\x93NUMPY" or begin[6] not in (1, 2, 3):
            raise Damaged(f"{member.filename[:40]} is no array")
        size = begin[8:] if begin[6] == 1 else begin[8:] + stream.read(2)
        long = int.from_bytes(size, "little")
        if long > _MAX_HEADER:
            raise Damaged(f"the head of {member.filename[:40]} is too long")
        header = ast.literal_eval(stream.read(long).decode("latin-1").strip())
    if not isinstance(header, dict) or set(header) != {"descr", "fortran_order", "shape"}:
        raise Damaged(f"the head of {member.filename[:40]} is damaged")
    shape, kind = header["shape"], np.dtype(str(header["descr"]))
    if not isinstance(shape, tuple) or not all(type(n) is int and n >= 0 for n in shape) or len(shape) > 4:
        raise Damaged(f"{member.filename[:40]} has no shape")
    if kind.kind not in _KINDS:
        raise Damaged(f"{member.filename[:40]} holds neither numbers nor text")
    before = 8 + len(size) + long
    if before + math.prod(shape) * kind.itemsize != member.file_size:
        raise Damaged(f"{member.filename[:40]} has not as many values as it says")
    return before, kind, bool(header["fortran_order"]), shape


def _array(
    box: zipfile.ZipFile, member: zipfile.ZipInfo, before: int, kind: np.dtype, columns: bool, shape: tuple[int, ...]
) -> np.ndarray:
    with box.open(member) as stream:
        stream.read(before)
        data = bytearray(member.file_size - before)
        if stream.readinto(data) != len(data) or stream.read(1):  # type: ignore[attr-defined]
            raise Damaged(f"{member.filename[:40]} ends early")
    if not kind.itemsize:  # text of no letters
        return np.zeros(shape, kind)
    return np.frombuffer(data, kind).reshape(shape, order="F" if columns else "C")
