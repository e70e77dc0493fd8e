"""What the experiments share: a ground that somebody stood on, what was left, and how numbers are told."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from ..ground.plants import Planting
from ..ground.sim import Ground, Simulation
from ..ground.soil import SOILS, Soil
from ..loads.force import GRAVITY, FootForce
from ..motion.gait import Gait, Sole
from . import bodies

CELL = 0.01  # of the grounds pressed here [m]
HALF = 100  # cells on each side of the origin that are looked at
FOOT = (0.25, 0.11)  # length and width of a block like a foot [m]
PERSON = 75.0  # [kg]
TAUS = (0.05, 0.1, 0.2)  # times in which a ground stops a foot [s]


def firm(**numbers: float) -> Soil:
    """A soil of E 1 MPa, nu 0.35, tau 0.2 s that rests at 30 degrees, but for some numbers."""
    usual = {"layer_depth": 0.3, "young_modulus": 1e6, "poisson_ratio": 0.35, "settle_time": 0.2}
    return Soil(**{**usual, "rest_angle": math.radians(30.0), **numbers})


def stood_on(soil: Soil, sole: Sole, force: Sequence[float], plants: Sequence[Planting] = ()) -> Simulation:
    """A ground on which a sole stood and was lifted. force on the ground (3,) [N]"""
    sim = Simulation(Ground.flat(), soil, CELL, plants=plants)
    gait, loads = bodies.pressed([sole], [[0, 0, 0, 1, 0, 0, 0]], [force])
    return walked(sim, gait, loads)


def walked(sim: Simulation, gait: Gait, loads: FootForce) -> Simulation:
    """The ground after a whole recording."""
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    return sim


def read(sim: Simulation, name: str) -> np.ndarray:
    """A map of the ground around the origin (2 HALF, 2 HALF)."""
    return np.asarray(sim.read(name, -HALF, -HALF, 2 * HALF, 2 * HALF))


def sunk(soil: Soil, mass: float, area: float) -> float:
    """Depth that Hooke's law gives [m]. SOFT22 (9)(10)"""
    return mass * GRAVITY / area * soil.layer_depth / soil.young_modulus


def plain(name: str) -> Soil:
    """A preset with the papers' numbers alone: its walls stand, it is alike everywhere and does not slip."""
    usual = Soil()
    ours = ("wall_angle", "roughness", "rebound", "heave", "flow_time", "shear_modulus")
    return replace(SOILS[name], **{each: getattr(usual, each) for each in ours})


def rises(values: Sequence[float] | np.ndarray) -> bool:
    """Whether each is more than the one before."""
    return bool(np.all(np.diff(values) > 0.0))


def listed(values: Iterable[float], form: str = ".3g") -> str:
    """Numbers in a sentence."""
    return ", ".join(format(each, form) for each in values)
