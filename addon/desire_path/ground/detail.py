"""What ground is like below a cell: grit, crumbs, veins in mud, edges that are not clean. MODEL 8.3

    places on the ground --details--> heights and shifts, which what shows the ground adds where it was disturbed

Only shown: nothing of it is pressed, kept or told. The same place is always like this, whatever was pressed, so that
nothing jumps from frame to frame.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from ..core import _native
from ..errors import DesirePathError
from ..tables import check, table, with_numbers

FAR = 1e9  # no ground lies farther out [m]
CLODDY = 0.1  # share of a heap that clods lie on at least, where a soil says how large they are
SHOWN = ("vein", "crumb", "grit", "stray_x", "stray_y", "threshold")  # what a point is like, in order


NUMBERS = table(_native.detail_numbers())  # of a detail, by name: native/refine/refine.h


@dataclass(frozen=True)
@with_numbers(NUMBERS)
class Detail:
    """What ground is like where it was disturbed, in SI units."""

    if TYPE_CHECKING:

        def __init__(self, *numbers: float, **by_name: float) -> None: ...
        def __getattr__(self, name: str) -> float: ...

    def __post_init__(self) -> None:
        check(self, NUMBERS, "A detail's")
        if self.min_crumb > self.max_crumb:
            raise DesirePathError("A detail's min_crumb is above its max_crumb: exchange them.")


# For looks: tried by eye on prints of a boot, sun at 20 degrees.
DETAILS: Mapping[str, Detail] = MappingProxyType(
    {
        "sand": Detail(0.0003, 0.004, 0.0, fray=0.0006, fray_size=0.020),
        "wet-sand": Detail(0.0003, 0.006, 0.10, 0.0015, 0.003, fray=0.0008, fray_size=0.012),
        "earth": Detail(0.0006, 0.007, 0.24, 0.002, 0.007, fray=0.0026, fray_size=0.018),
        "wet-soil": Detail(0.0003, 0.006, 0.04, 0.002, 0.006, fray=0.0015, fray_size=0.018),
        "mud": Detail(0.0, 0.010, 0.0, vein_height=0.0026, vein_size=0.036, fray=0.0030, fray_size=0.050),
        "snow": Detail(0.0010, 0.010, 0.24, 0.003, 0.011, fray=0.0050, fray_size=0.050),
        "crust-snow": Detail(0.0005, 0.010, 0.06, 0.003, 0.009, fray=0.0030, fray_size=0.030),
        "packed-earth": Detail(0.0004, 0.006, 0.14, 0.0015, 0.004, fray=0.0010, fray_size=0.012),
    }
)

WALLS = MappingProxyType(
    {"snow": 0.0026, "earth": 0.0022, "mud": 0.0018}
)  # deviation by which high walls are rough [m]


def with_clods(detail: Detail, clod_size: float) -> Detail:
    """A detail whose largest crumbs are as wide as a soil's clod_size [m], the others in proportion; 0: as it is."""
    if not clod_size > 0.0:
        return detail
    lowest = NUMBERS["max_crumb"].low
    largest = max(0.5 * clod_size, lowest)
    return Detail(
        **asdict(detail)
        | {
            "crumb_share": max(detail.crumb_share, CLODDY),
            "min_crumb": max(largest * detail.min_crumb / detail.max_crumb, lowest),
            "max_crumb": largest,
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
    _native.refine_detail(points, asdict(detail), seed, shown)
    return shown
