"""What ground is like below a cell: grit, crumbs, veins in mud, edges that are not clean. MODEL 8.3

    places on the ground --details--> heights and shifts, which what shows the ground adds where it was disturbed

Only shown: nothing of it is pressed, kept or told. The same place is always like this, whatever was pressed, so that
nothing jumps from frame to frame.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import astuple, dataclass, fields
from types import MappingProxyType

import numpy as np

from ..core import _native
from ..errors import DesirePathError

FAR = 1e9  # no ground lies farther out [m]
SHOWN = ("vein", "crumb", "grit", "stray_x", "stray_y", "threshold")  # what a point is like, in order


@dataclass(frozen=True)
class Detail:
    """What ground is like where it was disturbed; names, units and ranges as in DpDetail of native/refine/refine.h."""

    grit_height: float = 0.0  # deviation of grains that are seen [m] 0..1
    grit_size: float = 0.005  # how long they are [m]
    crumb_share: float = 0.0  # share of a heap that lies under crumbs 0..0.5
    crumb_least: float = 0.002  # radius of the smallest .. [m]
    crumb_most: float = 0.004  # .. and of the largest [m]
    vein_height: float = 0.0  # of what a sole sucks up when it is lifted [m] 0..1
    vein_size: float = 0.02  # how far veins lie apart [m]
    fray: float = 0.0  # deviation by which edges of prints stray, each way [m] 0..1
    fray_size: float = 0.02  # over which length [m]

    def __post_init__(self) -> None:
        for each in fields(self):
            value = getattr(self, each.name)
            low, high = (1e-4, 1.0) if each.name.endswith(("size", "least", "most")) else (0.0, 1.0)
            if each.name == "crumb_share":
                high = 0.5
            if not (math.isfinite(value) and low <= value <= high):
                raise DesirePathError(
                    f"A detail's {each.name} of {value:g} cannot be used: choose one from {low:g} to {high:g}."
                )
        if self.crumb_least > self.crumb_most:
            raise DesirePathError("A detail's crumb_least is above its crumb_most: exchange them.")


# For looks: tried by eye on prints of a boot, sun at 20 degrees.
DETAILS: Mapping[str, Detail] = MappingProxyType(
    {
        "sand": Detail(0.00035, 0.006, 0.02, 0.0015, 0.0025, fray=0.0016, fray_size=0.020),
        "wet-sand": Detail(0.0003, 0.008, 0.10, 0.0015, 0.004, fray=0.0018, fray_size=0.012),
        "earth": Detail(0.0006, 0.007, 0.24, 0.002, 0.007, fray=0.0026, fray_size=0.018),
        "mud": Detail(0.0, 0.010, 0.0, vein_height=0.0035, vein_size=0.030, fray=0.0030, fray_size=0.050),
        "snow": Detail(0.0006, 0.010, 0.22, 0.003, 0.009, fray=0.0030, fray_size=0.022),
    }
)


def details(points: np.ndarray, detail: Detail, seed: int = 0) -> np.ndarray:
    """What points are like, by where they are seen from above.

    points: in the world, float (n, 3) [m]; seed: another number puts every crumb somewhere else.
    Returns float32 (n, 6), SHOWN in order [m]: heights of mean 0, shifts of mean 0, and how high a heap has to be for
    the crumb there to show. Raises DesirePathError where a point is not finite.
    """
    points = np.ascontiguousarray(points, np.float64)
    if not (np.abs(points) < FAR).all():
        raise DesirePathError(f"A point is NaN, infinite or farther out than {FAR:g} m: move or remove it.")
    shown = np.empty((len(points), len(SHOWN)), np.float32)
    _native.refine_detail(points, astuple(detail), seed, shown)
    return shown
