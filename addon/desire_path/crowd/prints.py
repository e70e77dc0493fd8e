"""Ground in which feet sink, as the prints of a crowd's own walkers tell of it. MODEL 12.10. Experimental.

    "ground": {"kind": "prints", "soil": "deep-snow"}

A strip of the soil is walked over by the core, pass after pass: how much less each presses than the first is how much
less it sinks, and from it come the numbers that a Cover has, in closed form.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..errors import DesirePathError
from ..ground.options import SimulationOptions
from ..ground.sim import Ground, Simulation
from ..ground.soil import Soil, as_soil
from ..loads import walker
from ..motion.gait import Gait
from ..motion.scatter import Scatter
from ..study.trampling import walk
from .covers import LANE, Cover, snow
from .tread import BESIDE

PASSES = 24
LONG = 5.0  # strip [m]
CELL = 0.02  # [m]


def gait_of(name: str, mass: float) -> Gait:
    """A recording of somebody of such a mass [kg]; name: its file, empty = the walk that comes with Desire Path."""
    gait = Gait.load(name) if name else walk(mass)
    return replace(gait, mass=np.full(len(gait.mass), mass)).check()


def prints(soil: Soil | str, name: str, mass: float) -> Cover:
    """A Cover of a soil under walkers of one kind: how deep they sink, and how soon it is trodden. MODEL 12.10

    soil: a name in SOILS or a soil's file; name, mass: see gait_of()
    Raises DesirePathError for ground that is not waded: less than 3 cm deep, or more than 50.
    """
    depth, share = _sinking(soil, gait_of(name, mass))
    try:
        fresh = snow(depth)
    except DesirePathError:
        raise DesirePathError(
            f"Feet sink {100.0 * depth:.2g} cm into '{soil}', and 3 to 50 cm are waded: choose another ground."
        ) from None
    half, steep = _fitted(share)
    return replace(fresh, half_passes=half, steepness=steep).check()


def _sinking(soil: Soil | str, gait: Gait) -> tuple[float, np.ndarray]:
    """How deep the first pass of a strip sinks [m], and how deep each does against it (PASSES,)."""
    passed = gait.along([(0.0, 0.0), (LONG, 0.0)], PASSES, scatter=Scatter(BESIDE), seed=0)
    sim = Simulation(Ground.flat(), as_soil(soil), CELL, options=SimulationOptions())
    sim.load(passed, walker.loads(passed))
    i0, i1, j0, j1 = sim.reach()
    before, contacts = np.zeros((j1 - j0, i1 - i0)), 0
    depth, pressed = 0.0, []
    for sample in (*passed.cut.tolist(), len(passed.time) - 1):
        sim.run(sample)
        now = sim.read("compression", i0, j0, i1 - i0, j1 - j0).astype(float)
        more, before = np.maximum(now - before, 0.0), now
        steps, contacts = sim.report()["contacts"] - contacts, sim.report()["contacts"]
        pressed.append(more.sum() / max(steps, 1))
        if len(pressed) == 1:
            depth = float((more**2).sum() / max(more.sum(), 1e-12))  # the mean over what is pressed
    return depth, np.array(pressed) / max(pressed[0], 1e-12)


def _fitted(share: np.ndarray) -> tuple[float, float]:
    """half_passes and steepness by which passes sink so much, least squares; each sinks into what those before left."""
    across = np.linspace(-3.0, 3.0, 121)
    chance = np.exp(-0.5 * across**2)
    chance /= chance.sum()
    peak = LANE / (BESIDE * math.sqrt(2.0 * math.pi))  # of the load of one pass, over the middle of the strip
    load = np.outer(np.arange(1, len(share)), peak * np.exp(-0.5 * across**2))

    def off(half: float, steep: float) -> float:
        sunk = (1.0 / (1.0 + (load / half) ** steep)) @ chance
        return float(((sunk - share[1:]) ** 2).sum())

    best, wide = (10.0, 1.0), 1.0
    while wide > 1e-3:  # a smaller and smaller net around the best so far
        around = np.exp(wide * np.linspace(-1.0, 1.0, 9)).tolist()
        net = [(best[0] * a, best[1] * b) for a in around for b in around]
        found = min(net, key=lambda at: off(*at))
        wide *= 0.8 if found != best else 0.5
        best = found
    return float(f"{min(max(best[0], 0.1), 1e6):.3g}"), float(f"{min(max(best[1], 0.1), 10.0):.3g}")
