"""What stands on the ground of a simulation: its plants as they are now, and how they recover."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..core import _native
from ..errors import DesirePathError
from .planting import Planting

Stand = tuple[int, int, int]  # its number, that of its planting, plants


class Standing:
    """The plants of a Simulation: of all that it has these readers use `plantings` and `stands` alone."""

    _core: Any
    plantings: list[Planting]
    stands: list[Stand]

    def rest_plants(self, seconds: float) -> None:
        """Time passes without walkers [s]: bent stems recover, broken ones grow again."""
        if not (math.isfinite(seconds) and 0 <= seconds < 1e12):
            raise DesirePathError(f"Plants cannot rest for {seconds} seconds: give 0 or more.")
        if self.plantings:
            self._core.rest_plants(float(seconds))

    def plants_count(self) -> int:
        """How many plants stand on the ground so far."""
        return sum(count for _, _, count in self.stands)

    def plants_shape(self, stand: int) -> tuple[int, int, int, int, int]:
        """(rows, stems, stems of a sheet, particles, bends) of a plant of a stand in `stands`."""
        return _native.plants_shape(self.plantings[self._stand(stand)[1]].kind.numbers())

    def plants_positions(self, stand: int) -> np.ndarray:
        """Particles of all plants of a stand, float32 (n, particles, 3) [m]; particle = stem * rows + row."""
        out = np.zeros((self._stand(stand)[2], self.plants_shape(stand)[3], 3), np.float32)
        self._core.read_plants(stand, 0, out, None, None)
        return out

    def lay_plants(self) -> None:
        """Remember from now on how soles lay the stems, so that plants_shown() tells more than plants_positions()."""
        if self.plantings:
            self._core.lay_plants()

    def plants_shown(self, stand: int) -> np.ndarray:
        """Particles of all plants of a stand as they are to be shown, float32 (n, particles, 3) [m]: a stem that was
        trodden swings up when the foot has left, but is down for as long as the grass of its cell lies (`crushed`)."""
        out = np.zeros((self._stand(stand)[2], self.plants_shape(stand)[3], 3), np.float32)
        self._core.read_shown(stand, 0, out)
        return out

    def plants_strength(self, stand: int) -> np.ndarray:
        """eps_b of every bend, float64 (n, bends), TRAIL (6); 0 = broken."""
        out = np.zeros((self._stand(stand)[2], self.plants_shape(stand)[4]))
        self._core.read_plants(stand, 0, None, out, None)
        return out

    def plants_alpha(self, stand: int) -> np.ndarray:
        """alpha_k of every plant, float64 (n,), TRAIL (7): its share of bends with nothing broken below."""
        out = np.zeros(self._stand(stand)[2])
        self._core.read_plants(stand, 0, None, None, out)
        return out

    def _stand(self, name: int) -> Stand:
        for stand in self.stands:
            if stand[0] == name:
                return stand
        raise DesirePathError(f"There is no stand {name}: choose one of those in `stands`.")
