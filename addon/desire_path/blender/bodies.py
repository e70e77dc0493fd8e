"""bodies.py - how walkers press: as it was chosen, and where nothing was, as a body's motion says."""

from dataclasses import replace

import numpy as np

from ..errors import DesirePathError
from ..ground import parcels
from ..ground.options import SimulationOptions
from ..ground.sim import Simulation
from ..motion.points import point_places
from ..motion.recording import AUTO
from ..placement import wade
from . import physics

TRIAL_CELL = 0.02  # how deep feet sink is tried in cells of this side, or larger ones [m]
SUNK = 0.02  # what is moved deeper into the ground does not stand on it by its weight [m]


def laws(walkers, gait, below):
    """A recording with the contact law of each walker. A mesh for which none was chosen carves where it is moved into
    the ground, if no rigid-body simulation lets it lie there.

    below: tells of the Simulation of the ground, when it is asked
    """
    chosen, sentences = [], []
    for number, obj in enumerate(walkers):
        law = gait.contact_law[number] if gait.contact_law else AUTO
        if law == AUTO and obj.type == "MESH" and not physics.simulated(obj):
            deep = _depth(gait.only([number]), below())
            if deep > SUNK:
                law = "carve"
                sentences.append(
                    f"'{obj.name}' is moved {deep:.2f} m deep into the ground: it carves, whatever it weighs. Choose "
                    "what it presses by in its panel to have it otherwise."
                )
        chosen.append(law)
    return replace(gait, contact_law=tuple(chosen), warnings=gait.warnings + tuple(sentences))


def _depth(gait, below):
    """How far the contact points of one walker go below the ground at most [m]."""
    places = point_places(gait).reshape(-1, 3)
    deep = below.rest_height(places[:, :2]) - places[:, 2]
    return float(np.nanmax(deep)) if np.isfinite(deep).any() else 0.0


def wading(walkers, gait, grounds, cell, law, origin):
    """A recording with legs of the walkers who wade. grounds: the Parcels that are baked, cell: theirs [m]"""
    wade_numbers = [number for number, obj in enumerate(walkers) if obj.desire_path.wade]
    if not wade_numbers:
        return gait
    if len(parcels.storeys(grounds, gait)) > 1:
        raise DesirePathError(
            f"'{walkers[wade_numbers[0]].name}' walks over grounds of which one lies over the other, and wades through "
            "one alone: untick Wade, or bake each ground by itself."
        )
    side = max(cell, TRIAL_CELL)
    land, soils = parcels.sewn(grounds, side)
    with Simulation(land, soils, side, options=SimulationOptions(law=law, origin=origin)) as trial:
        return wade.wade(gait, trial, walkers=wade_numbers)
