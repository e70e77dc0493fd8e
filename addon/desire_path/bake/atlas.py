"""Frames of a walk so large that only the ground near its prints is in their pictures. MODEL 8.4

    frames/trail_0001.exr ..  pages of TILE x TILE cells, in rows one above the other
    frames/pages.exr          which page lies where: a pixel for each page that the rectangle of the walk could have

Page (x, y) shows PAGE x PAGE cells from cell (x, y) * PAGE on, and EDGE cells of its neighbours all round, so that what
lies between two cells is found in one page.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass

import numpy as np

from ..arrays import Record
from ..core import _native
from ..errors import DesirePathError
from ..ground import maps
from ..ground.sim import TILE

PAGE: int = _native.PAGE  # cells of a page ..
EDGE: int = _native.PAGE_EDGE  # .. and those of its neighbours beyond each side
TABLE = "pages.exr"  # beside the frames: R, G column and row of the page in the pictures, B 1 where there is one


@dataclass(frozen=True, eq=False, repr=False)
class Atlas(Record):
    """The pages of a sparse picture, `columns` of them in a row, rows from its lower side."""

    wide: int  # pages the whole rectangle could have along x
    high: int  # .. along y
    columns: int
    rows: int
    pages: np.ndarray  # x and y of each, in their order in the picture, int32 (n, 2)

    @staticmethod
    def over(reached: np.ndarray) -> Atlas:
        """Of all pages that show a part of some tiles. reached: those of the rectangle, bool (ny, nx)"""
        high, wide = (-(-TILE * count // PAGE) for count in reached.shape)
        down, across = (_spans(count, tiles) for count, tiles in zip((high, wide), reached.shape))
        wanted = np.zeros((high, wide), bool)
        for a in down:
            for b in across:
                wanted |= reached[a][:, b]
        pages = np.argwhere(wanted)[:, ::-1].astype(np.int32)
        columns = max(math.ceil(math.sqrt(len(pages))), 1)
        return Atlas(wide, high, columns, max(-(-len(pages) // columns), 1), np.ascontiguousarray(pages))

    @property
    def cells(self) -> int:
        """Of one picture."""
        return self.columns * self.rows * TILE * TILE

    def data(self) -> dict[str, int]:
        """What the index of the frames says of it."""
        return {"columns": self.columns, "rows": self.rows, "page": PAGE, "edge": EDGE}

    def write(self, folder: str) -> None:
        """The table of its pages, beside the frames."""
        table = np.zeros((4, self.high, self.wide), np.float32)
        x, y = self.pages.T
        number = np.arange(len(self.pages))
        table[0, y, x], table[1, y, x], table[2, y, x] = number % self.columns, number // self.columns, 1.0
        table[3] = 1.0
        maps.write(os.path.join(folder, TABLE), dict(zip("RGBA", table)))

    @staticmethod
    def read(folder: str, columns: int, rows: int, nx: int, ny: int) -> Atlas:
        """From the table beside the frames, which show nx x ny cells. DesirePathError where it is none of these."""
        path = os.path.join(folder, TABLE)
        planes = maps.read(path).planes
        wide, high = -(-nx // PAGE), -(-ny // PAGE)
        if not {"R", "G", "B"} <= set(planes) or planes["B"].shape != (high, wide):
            raise DesirePathError(f"{path} is damaged: bake again.")
        found = np.argwhere(planes["B"] > 0.5)
        place = np.stack([planes[name][tuple(found.T)] for name in "GR"], axis=1)
        number = place @ (columns, 1)
        right = (place >= 0).all() and (place < (rows, columns)).all() and (np.sort(number) == range(len(found))).all()
        if not right:
            raise DesirePathError(f"{path} is damaged: bake again.")
        return Atlas(wide, high, columns, rows, found[np.argsort(number)][:, ::-1].astype(np.int32))

    def find(self, i: np.ndarray, j: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(row, column in the picture, whether there is a page) of cells of the whole rectangle."""
        slot = np.full((self.high, self.wide), -1)
        slot[self.pages[:, 1], self.pages[:, 0]] = np.arange(len(self.pages))
        x, y = i // PAGE, j // PAGE
        there = (x >= 0) & (x < self.wide) & (y >= 0) & (y < self.high)
        number = slot[np.where(there, y, 0), np.where(there, x, 0)]
        there &= number >= 0
        row, column = number // self.columns * TILE + EDGE + j % PAGE, number % self.columns * TILE + EDGE + i % PAGE
        return np.where(there, row, 0), np.where(there, column, 0), there

    def spread(self, picture: np.ndarray, nx: int, ny: int) -> np.ndarray:
        """All of the rectangle (ny, nx), zero where there is no page. picture: (rows, columns) * TILE"""
        out = np.zeros((ny, nx), picture.dtype)
        for number, (x, y) in enumerate(self.pages.tolist()):
            row, column = divmod(number, self.columns)
            there = out[y * PAGE : (y + 1) * PAGE, x * PAGE : (x + 1) * PAGE]
            high, wide = there.shape
            there[:] = picture[row * TILE + EDGE :, column * TILE + EDGE :][:high, :wide]
        return out


def _spans(pages: int, tiles: int) -> list[np.ndarray]:
    """The first and the last tile that each page along a side shows cells of."""
    start = PAGE * np.arange(pages)
    return [np.clip((start + cell) // TILE, 0, tiles - 1) for cell in (-EDGE, PAGE + EDGE - 1)]
