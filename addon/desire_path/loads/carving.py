"""Bodies that carve: they are where they were moved to, and no force tells how deep. MODEL 6.11"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import DesirePathError
from ..motion import tracks
from ..motion.gait import Gait
from ..motion.points import point_places
from .below import GivenHeights, ground_below
from .force import FootForce
from .turns import let_go

FARTHEST = 1e6  # a body that is farther away was lost by what moved it [m]
DEEPEST = 10.0  # .. that is deeper in the ground was put there out of sight [m]
NEAR = 0.1  # a body that is farther over the ground before any walker meets no heap on it [m]


def _check_near(gait: Gait, places: np.ndarray, part: int) -> None:
    """DesirePathError if what moves a body that carves has lost it. places: of contact points (K, T, 3)"""
    away = np.abs(places[gait.point_part == part]).max(axis=(0, 2))
    if away.max() > FARTHEST:
        name = gait.walker_name[gait.limb_walker[gait.part_limb[part]]]
        raise DesirePathError(
            f"{name} is {away.max():.3g} m away at frame {gait.frame(int(away.argmax())):g}, as when a simulation "
            "comes apart or a key is wrong: mend it, or let the frames end before."
        )


def carved(gait: Gait, ground: GivenHeights, found: FootForce) -> FootForce:
    """The FootForce of the other walkers, with those that carve: they touch where they are near the ground, and what
    they press with is not known. One that stays over the ground is told of."""
    carving = gait.carving()
    if not carving.any():
        return found
    places = np.asarray(point_places(gait))
    owner = gait.limb_walker[gait.part_limb]
    for part in np.flatnonzero(carving[owner]).tolist():
        _check_near(gait, places, part)
    heights, below = places[..., 2], ground_below(gait, ground)
    touching, warnings = tracks.writable(found.touching), list(found.warnings)
    for w in np.flatnonzero(carving):
        meets, lost = False, np.zeros(len(gait.time), bool)
        for part in np.flatnonzero(owner == w).tolist():
            own = gait.point_part == part
            highest = np.where(np.isfinite(below[own]), below[own], -np.inf).max(axis=0)
            gap = heights[own].min(axis=0) - highest
            buried = gap < -DEEPEST
            lost |= buried
            buried = np.convolve(buried, (1, 1, 1), "same") > 0  # nor is it on its way there or back
            near = (gap < NEAR) & ~buried
            tracks.put(touching, [part], np.arange(len(gait.time)), near[None].astype("u1"))
            meets = meets or bool((gap < 0.0).any())
        if lost.any():
            warnings.append(
                f"{gait.walker_name[w]} is more than {DEEPEST:g} m below the ground at frame "
                f"{gait.frame(int(lost.argmax())):g}, where it leaves no print: mend its motion if it was not put "
                "there out of sight."
            )
        if not meets:
            warnings.append(
                f"{gait.walker_name[w]} stays over the ground, so that it leaves no print by the contact law Carve: "
                "lower it, or let it press by its mass."
            )
    let_go(gait, touching)
    return replace(found, touching=touching, warnings=tuple(warnings))
