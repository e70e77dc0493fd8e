"""Tiles of the files of a film, as they are packed: what a task changed of a frame, and a frame made of such tiles.

A frame is its header and the packed bytes of its tiles in a row, and the same numbers are packed into the same bytes.
So a frame whose tiles were made here and there is, to the bit, the one that was made at once.
"""

from __future__ import annotations

import io
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import DesirePathError
from ..files import atomic_file

TIME = b"time"  # attribute of a frame
ENTRY = np.dtype([("frame", "<i4"), ("x", "<i4"), ("y", "<i4"), ("size", "<i4")])


@dataclass(frozen=True)
class Frame:
    """A file of a film: what stands before its tiles, and the packed bytes of each by (column, row from below)."""

    head: bytes
    columns: int
    rows: int
    tiles: dict[tuple[int, int], bytes]

    @staticmethod
    def read(path: str) -> Frame:
        """A file that Film wrote; ValueError or struct.error if it is not whole."""
        with atomic_file.reader(path) as stream:
            data = stream.read()
        attributes, end = _attributes(data)
        x0, y0, x1, y1 = struct.unpack_from("<4i", data, attributes[b"dataWindow"][0])
        wide, high = struct.unpack_from("<2I", data, attributes[b"tiles"][0])
        columns, rows = (x1 - x0 + 1) // wide, (y1 - y0 + 1) // high
        tiles = {}
        for at in struct.unpack_from(f"<{columns * rows}Q", data, end):
            column, row, _, _, size = struct.unpack_from("<5i", data, at)
            if len(data) < at + 20 + size:
                raise ValueError("a tile is cut off")
            tiles[column, rows - 1 - row] = data[at + 20 : at + 20 + size]
        return Frame(data[:end], columns, rows, tiles)

    def write(self, path: str, time: float, changed: Mapping[tuple[int, int], bytes]) -> bytes:
        """Write it as of a time [s], with some tiles in place of its own; returns the bytes of the file."""
        attributes, _ = _attributes(self.head)
        at, kind = attributes[TIME]
        head = bytearray(self.head)
        struct.pack_into("<f" if kind == b"float" else "<d", head, at, time)
        out, places, chunks = io.BytesIO(), [], []
        place = len(head) + 8 * self.columns * self.rows
        for row in range(self.rows):
            for column in range(self.columns):
                key = (column, self.rows - 1 - row)
                tile = changed.get(key) or self.tiles[key]
                places.append(place)
                chunks += [struct.pack("<5i", column, row, 0, 0, len(tile)), tile]
                place += 20 + len(tile)
        out.write(head)
        out.write(struct.pack(f"<{len(places)}Q", *places))
        out.writelines(chunks)
        with atomic_file.file(path, "A frame", sync=False) as stream:
            stream.write(out.getbuffer())
        return out.getvalue()


def _attributes(data: bytes) -> tuple[dict[bytes, tuple[int, bytes]], int]:
    """({name: (where its value lies, type)}, where the header ends) of an OpenEXR file."""
    found, at = {}, 8
    while data[at] != 0:
        end = data.index(b"\0", at)
        kind_end = data.index(b"\0", end + 1)
        (size,) = struct.unpack_from("<i", data, kind_end + 1)
        found[data[at:end]] = (kind_end + 5, data[end + 1 : kind_end])
        at = kind_end + 5 + size
    return found, at + 1


class Changes:
    """Tiles of a film that are new, frame after frame; tile (0, 0) lies at `corner` in the world's tiles."""

    def __init__(self, corner: tuple[int, int]) -> None:
        self.corner = corner
        self._entries: list[tuple[int, int, int, int]] = []
        self._bytes: list[bytes] = []
        self._last: dict[tuple[int, int], bytes] = {}

    def begin(self, frame: Frame) -> None:
        """What is known already."""
        self._last = dict(frame.tiles)

    def add(self, number: int, frame: Frame) -> None:
        """Take in what differs from the frame before."""
        for (column, row), tile in frame.tiles.items():
            if self._last.get((column, row)) != tile:
                self._last[column, row] = tile
                self._entries.append((number, column + self.corner[0], row + self.corner[1], len(tile)))
                self._bytes.append(tile)

    def packed(self) -> tuple[bytes, bytes]:
        """(table, tiles) for unpack()."""
        return np.array(self._entries, ENTRY).tobytes(), b"".join(self._bytes)


def unpack(table: bytes | memoryview, tiles: bytes | memoryview) -> list[tuple[int, int, int, bytes]]:
    """[(number of the frame, x, y, packed bytes), ..], in the order of the frames."""
    found, at = [], 0
    for number, x, y, size in np.frombuffer(table, ENTRY).tolist():
        found.append((number, x, y, bytes(tiles[at : at + size])))
        at += size
    if at != len(tiles):
        raise DesirePathError("The result of a task is not whole: run it again.")
    return found


def box_of(tiles: np.ndarray, film: Sequence[int]) -> tuple[int, int, int, int] | None:
    """(x, y, columns, rows) around tiles (n, 2), of those that a film (x, y, columns, rows) shows; None: none."""
    low, high = np.array(film[:2]), np.array(film[:2]) + film[2:]
    inside = tiles[((tiles >= low) & (tiles < high)).all(axis=1)]
    if not len(inside):
        return None
    x, y = inside.min(axis=0).tolist()
    nx, ny = (inside.max(axis=0) - inside.min(axis=0) + 1).tolist()
    return x, y, nx, ny
