"""Bodies that carve: they are where they were moved to, and no force tells how deep. MODEL 6.11"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..motion import tracks
from ..motion.gait import Gait
from ..motion.points import point_places
from .below import GivenHeights, ground_below
from .force import FootForce
from .turns import let_go

NEAR = 0.1  # a body that is farther over the ground before any walker meets no heap on it [m]


def carved(gait: Gait, ground: GivenHeights, found: FootForce) -> FootForce:
    """The FootForce of the other walkers, with those that carve: they touch where they are near the ground, and what
    they press with is not known. One that stays over the ground is told of."""
    carving = gait.carving()
    if not carving.any():
        return found
    places, below = point_places(gait)[..., 2], ground_below(gait, ground)
    touching, warnings = found.touching, list(found.warnings)
    if isinstance(touching, np.ndarray):
        touching = touching.copy()
    owner = gait.limb_walker[gait.part_limb]
    for w in np.flatnonzero(carving):
        meets = False
        for part in np.flatnonzero(owner == w).tolist():
            own = gait.point_part == part
            highest = np.where(np.isfinite(below[own]), below[own], -np.inf).max(axis=0)
            gap = places[own].min(axis=0) - highest
            tracks.put(touching, [part], np.arange(len(gait.time)), (gap < NEAR)[None].astype("u1"))
            meets = meets or bool((gap < 0.0).any())
        if not meets:
            warnings.append(
                f"{gait.walker_name[w]} stays over the ground, so that it leaves no print by the contact law Carve: "
                "lower it, or let it press by its mass."
            )
    let_go(gait, touching)
    return replace(found, touching=touching, warnings=tuple(warnings))
