"""Ground whose sinkage was measured by plates, Bekker's law: MODEL 6.14

M. G. Bekker, Introduction to Terrain-Vehicle Systems, 1969; the numbers are of Wong, Theory of Ground Vehicles, 4th ed.
2008, Table 2.3, read at second hand. Per cent are of water.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

PLATE = 0.09  # width of a shoe [m]

# name: k_c [kN/m^(n+1)], k_phi [kN/m^(n+2)], n, angle of friction [degrees]
_ROWS: dict[str, tuple[float, float, float, float]] = {
    "measured-dry-sand-lll": (0.99, 1528.43, 1.1, 28),
    "measured-sandy-loam-15-lll": (5.27, 1515.04, 0.7, 29),
    "measured-sandy-loam-22-lll": (2.56, 43.12, 0.2, 38),
    "measured-sandy-loam-11-michigan": (52.53, 1127.97, 0.9, 20),
    "measured-sandy-loam-23-michigan": (11.42, 808.96, 0.4, 35),
    "measured-sandy-loam-26-hanamoto": (2.79, 141.11, 0.3, 22),
    "measured-sandy-loam-32-hanamoto": (0.77, 51.91, 0.5, 11),
    "measured-clayey-soil-38-thailand": (13.19, 692.15, 0.5, 13),
    "measured-clayey-soil-55-thailand": (16.03, 1262.53, 0.7, 10),
    "measured-heavy-clay-25": (12.7, 1555.95, 0.13, 34),
    "measured-heavy-clay-40": (1.84, 103.27, 0.11, 6),
    "measured-lean-clay-22-wes": (16.43, 1724.69, 0.2, 20),
    "measured-lean-clay-32-wes": (1.52, 119.61, 0.15, 11),
    "measured-lete-sand-wong": (102, 5301, 0.79, 31.1),
    "measured-upland-sandy-loam-51": (74.6, 2080, 1.1, 33.7),
    "measured-rubicon-sandy-loam-43": (6.9, 752, 0.66, 29.8),
    "measured-north-gower-clayey-loam-46": (41.6, 2471, 0.73, 26.6),
    "measured-grenville-loam-24": (0.06, 5880, 1.01, 29.8),
    "measured-snow-us": (4.37, 196.72, 1.6, 19.7),
    "measured-snow-us-harrison": (2.49, 245.9, 1.6, 23.2),
    "measured-snow-sweden": (10.55, 66.08, 1.44, 20.7),
}
ROWS: Mapping[str, tuple[float, float, float, float]] = MappingProxyType(_ROWS)


def sinks(name: str, pressure: float, width: float = PLATE) -> float:
    """How deep a plate of that width [m] is pressed by a pressure [Pa], as far as the ground goes [m]."""
    cohesion, friction, power, _ = ROWS[name]
    return float((pressure / 1e3 / (cohesion / width + friction)) ** (1.0 / power))
