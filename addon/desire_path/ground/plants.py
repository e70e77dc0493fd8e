"""Plants, MODEL 7.1 and 9.2: kinds, as data in SI units that can be saved, changed and shared, and where they stand.

lawn = Planting(KINDS["lawn"], seed=3)                       # wherever the walk goes, 300 plants a m^2
meadow = Planting("meadow", weight=grid, rectangle=(0, 0, 8, 5))   # thinned by an image over 8 x 5 m
sim = Simulation(ground, soils, plants=[lawn, meadow])       # several kinds on one ground
bake = Bake(gait, ground, soils, folder, plants=[lawn])
"""

from .kinds import FORMS, KINDS, MAX_VIGOUR, NUMBERS, PAPER, YEAR, Kind, as_kind, share_below, vigour_at
from .planting import MAX_PLANTS, SQUARE, Planting, as_plantings, seed_of

__all__ = [
    "FORMS",
    "KINDS",
    "MAX_PLANTS",
    "MAX_VIGOUR",
    "NUMBERS",
    "PAPER",
    "SQUARE",
    "YEAR",
    "Kind",
    "Planting",
    "as_kind",
    "as_plantings",
    "seed_of",
    "share_below",
    "vigour_at",
]
