"""What a simulation writes while it runs: one file a moment, by a thread of the core."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ..errors import DesirePathError
from . import maps
from . import notes as header
from .fields import FIELDS, Field


class Closed:
    """In place of the core of a Simulation that was closed."""

    def __getattr__(self, name: str) -> Any:
        raise DesirePathError("This simulation was closed: make a new one.")


class Film:
    """Frames and maps of a rectangle of tiles of a Simulation, as it changes: Simulation.open_frames() opens one.

    Files are written while the next steps run: OSError tells of one before, see Simulation.flush().
    """

    def __init__(self, core: Any, fields: Mapping[str, Field] = FIELDS) -> None:
        self._core, self._fields = core, fields

    def open_maps(
        self,
        names: Sequence[str],
        notes: Iterable[tuple[str, str | float]],
        called: Mapping[str, str] | None = None,
        layers: bool = True,
    ) -> None:
        """Maps written from now on have these fields, as in Simulation.read(), the first of them as maps.PICTURE, too,
        and notes (name, text or number). called: other names in the files, and whose fields they show; layers: False
        for plain pictures, as of maps.write_rows(), of these names alone."""
        shown = [(maps.channel(name, layers), self._fields[(called or {}).get(name, name)].number) for name in names]
        first = ((maps.PICTURE, shown[0][1]),) if layers else ()
        self._core.open_maps((*first, *shown), tuple(header.parts(notes)))

    def list_files(self, path: str | os.PathLike[str]) -> None:
        """Add each file of frames and maps from now on, when it is there, to the list in this file: its name, how many
        bytes it has, and their digest. After open_maps() and before the first frame."""
        self._core.list_files(str(path))

    def write_frame(self, path: str | os.PathLike[str] | None, time: float) -> None:
        """Write the ground as it is to one EXR, whole or not at all; path None: only take it in."""
        self._core.write_frame(None if path is None else str(path), float(time))

    def write_lean(self, path: str | os.PathLike[str] | None, time: float) -> None:
        """The same for how the grass lies: R lean_x, G lean_y, B crushed, A plant strength. Only with plants."""
        self._core.write_frame(None if path is None else str(path), float(time), True)

    def write_maps(self, path: str | os.PathLike[str], time: float) -> None:
        """Write the maps as they are, in the background like frames."""
        self._core.write_maps(str(path), float(time))
