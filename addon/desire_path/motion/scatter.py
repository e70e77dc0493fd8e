"""How passes over one path differ from each other."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from ..errors import DesirePathError

MAX = {"lateral": 100.0, "timing": 0.3, "stride": 0.3}


@dataclass(frozen=True)
class Scatter:
    """Standard deviations of what passes over a path differ in; the first pass differs in nothing."""

    lateral: float = 0.1  # how far beside the path they go [m] 0..100
    timing: float = 0.05  # their pace, as a share 0..0.3
    stride: float = 0.05  # the length of their strides, as a share 0..0.3

    def check(self) -> None:
        """Refuse numbers that no passes have, naming which."""
        for each in fields(self):
            value, largest = getattr(self, each.name), MAX[each.name]
            if not (math.isfinite(value) and 0.0 <= value <= largest):
                raise DesirePathError(f"A {each.name} of {value:g} cannot be used: choose one from 0 to {largest:g}.")
