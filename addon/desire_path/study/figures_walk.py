"""Experiments with who walks: forces, landings, bodies, hills, plants. TRAIL (1)-(9), SOFT22 (2)-(8)"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from ..ground.plants import KINDS, Planting
from ..ground.sim import Ground, Simulation
from ..loads import walker
from ..loads.force import GRAVITY
from ..loads.plot import foot_loads
from ..placement import place
from . import bodies, trampling
from .figure import Claim, Curve, Figure
from .rigs import CELL, FOOT, PERSON, TAUS, firm, listed, plain, rises, stood_on

HILL = math.radians(25.0)
COLE = MappingProxyType({25: 86.3, 75: 70.4, 200: 39.8, 500: 20.0})  # Carex bigelowii: cover [per cent] after passes
COLE_MARGIN = 4.0  # [per cent of cover]
# who: mass [kg], share of it on one foot at its hardest, length and width of that foot [m]
WALKERS: Mapping[str, tuple[float, float, float, float]] = MappingProxyType(
    {
        "walks": (75.0, 1.2, 0.25, 0.11),
        "runs": (75.0, 2.5, 0.25, 0.11),
        "snowshoes": (75.0, 1.2, 0.6, 0.22),
        "heavy, big feet": (150.0, 1.2, 0.38, 0.2),
        "small": (25.0, 1.2, 0.17, 0.08),
    }
)


def forces() -> Figure:
    """Feet of a walk: by Newton on the mass centre, and as weight and impulse of landing."""
    gait = trampling.walk(PERSON)
    models = [("mass centre (Newton)", walker.loads(gait))]
    models += [(f"impulse, tau {tau:g} s", walker.loads(gait, "impulse", settle_time=tau)) for tau in TAUS]
    feet = [foot_loads(gait, loads)[0] for _, loads in models]
    total = [float(force.sum(axis=0).mean()) for force in feet]
    return Figure(
        "forces",
        "One foot of a walk",
        "time [s]",
        "vertical force [body weights]",
        tuple(Curve(label, gait.time, force[0]) for (label, _), force in zip(models, feet)),
        (
            Claim(
                "SOFT22 (3)",
                "Both feet together carry the weight.",
                f"{total[0]:.3f} body weights on average",
                abs(total[0] - 1.0) < 0.05,
            ),
        ),
    )


def impact() -> Figure:
    """What lands on grounds that stop it sooner or later. TRAIL (3) (4), SOFT22 (6)-(8)"""
    speeds, curves, worst = np.array([0.5, 1.0, 2.0, 4.0]), [], 0.0
    peaks = np.array([[_impact(float(speed), tau) for speed in speeds] for tau in TAUS])
    for tau, seen in zip(TAUS, peaks):
        curves.append(Curve(f"tau {tau:g} s", speeds, seen))
        worst = max(worst, float(np.abs(seen / (1.0 + speeds / (GRAVITY * tau)) - 1.0).max()))
    return Figure(
        "impact",
        "A ball that lands",
        "speed [m/s]",
        "peak of the force [body weights]",
        tuple(curves),
        (
            Claim(
                "TRAIL (3) (4)",
                "It is m g + m v/tau, v that just before it lands.",
                f"within {100.0 * worst:.1f} % at {listed(speeds)} m/s and tau {listed(TAUS)} s",
                worst < 0.03,
            ),
            Claim(
                "SOFT22 (8)",
                "The faster the ground stops it, the harder it presses.",
                f"{listed(peaks[:, 2])} body weights at 2 m/s and tau {listed(TAUS)} s",
                rises(peaks[::-1, 2]),
            ),
        ),
    )


def _impact(speed: float, tau: float) -> float:
    """Peak [body weights] of a ball that lands at `speed` [m/s]."""
    gait = bodies.landed(PERSON, speed, 0.15)
    loads = walker.loads(gait, "impulse", ground=0.0, settle_time=tau)
    return -float(np.min(loads.force[0, :, 2])) / (PERSON * GRAVITY)


def walkers() -> Figure:
    """Who leaves deep prints, and who does not. SOFT22 Fig. 4"""
    curves, depths = [], {}
    for ground in ("snow", "dry-sand"):
        soil = plain(ground)
        depths[ground] = [
            1000.0
            * stood_on(soil, bodies.box(length, width), (0.0, 0.0, -share * mass * GRAVITY)).report()["deepest_m"]
            for mass, share, length, width in WALKERS.values()
        ]
        curves.append(Curve(ground, np.arange(len(WALKERS)), np.array(depths[ground]), points=True))
    walks, runs, shoes, heavy, small = depths["snow"]
    return Figure(
        "walkers",
        "Under one foot at its hardest",
        "who",
        "depth [mm]",
        tuple(curves),
        (
            Claim(
                "SOFT22 Fig. 4", "Who runs sinks deeper than who walks.", f"{runs:.3g} and {walks:.3g} mm", runs > walks
            ),
            Claim("SOFT22 Fig. 4", "Snowshoes carry.", f"{shoes:.3g} mm", shoes < 0.3 * walks),
            Claim(
                "SOFT22 Fig. 4",
                "Big feet make up for a heavy body.",
                f"{heavy:.3g} mm under 150 kg, {small:.3g} mm under 25 kg, {walks:.3g} mm under 75 kg",
                heavy < walks and small < walks,
            ),
            Claim(
                "SOFT22 Table 1",
                "Snow gives way to everybody more than sand.",
                f"{listed(depths['snow'])} and {listed(depths['dry-sand'])} mm",
                all(a > b for a, b in zip(depths["snow"], depths["dry-sand"])),
            ),
        ),
        tuple(WALKERS),
    )


def _hill(rise: float) -> tuple[float, float, np.ndarray, np.ndarray]:
    """A walk along x over dry sand that rises by `rise` [radians] along it.

    (median length of a print [m], how far ahead of the prints their heaps lie [m], places along [m], profile [m^2])
    """
    gait = trampling.walk(PERSON)
    gait = gait.along([(0.0, 0.0), (5.0, 0.0)], ground=None)
    slope, half = math.tan(rise), 4.0
    step = np.linspace(-half, 2.0 * half, 25)
    land = Simulation(
        Ground.heights(np.broadcast_to(slope * step, (25, 25)), step[1] - step[0], -half, -half), "dry-sand", CELL
    )
    placed = place.place_feet(gait, land)
    land.load(placed, walker.loads(placed, ground=land.rest_height))
    i0, i1, j0, j1 = land.reach()
    land.run(len(placed.time) - 1)
    land.settle()
    firm, heap = (np.asarray(land.read(name, i0, j0, i1 - i0, j1 - j0)) for name in ("compression", "heap"))
    along = CELL * (np.arange(i0, i1) + 0.5)
    places = np.sort(np.broadcast_to(along, firm.shape)[firm > 0.25 * firm.max()])
    prints = np.split(places, np.flatnonzero(np.diff(places) > 0.2) + 1)[1:-1]
    length = float(np.median([np.ptp(each) for each in prints])) * math.hypot(1.0, slope)
    centre = [float((each * along).sum() / each.sum()) for each in (heap, firm)]
    return length, centre[0] - centre[1], along, (heap - firm).sum(axis=0) * CELL


def _between(start: float, end: float, along: np.ndarray, value: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A stretch of a profile."""
    inside = (along > start) & (along < end)
    return along[inside], value[inside]


def hill() -> Figure:
    """Prints up a hill, on the level and down it. TRAIL Fig. 12"""
    runs = {"up": _hill(HILL), "level": _hill(0.0), "down": _hill(-HILL)}
    length = {name: run[0] for name, run in runs.items()}
    ahead = {name: run[1] for name, run in runs.items()}
    found = ", ".join(f"{100 * each:.1f} cm {name}" for name, each in length.items())
    shifted = ", ".join(f"{100 * each:+.1f} cm {name}" for name, each in ahead.items())
    return Figure(
        "hill",
        f"A walk over dry sand that rises or falls by {math.degrees(HILL):.0f} degrees",
        "along the walk [m]",
        "heaps less prints, across the trail [cm^2]",
        tuple(Curve(name, *_between(2.0, 4.0, run[2], 1e4 * run[3])) for name, run in runs.items()),
        (
            Claim(
                "TRAIL Fig. 12", "Prints uphill are those of toes alone.", found, length["up"] < 0.75 * length["level"]
            ),
            Claim("TRAIL Fig. 12", "Prints downhill are longer.", found, length["down"] > 1.03 * length["level"]),
            Claim(
                "TRAIL Fig. 12",
                "The heap lies behind uphill, ahead downhill.",
                shifted,
                ahead["up"] < ahead["level"] - 0.02 < ahead["down"] - 0.04,
            ),
        ),
    )


def roots() -> Figure:
    """What plants carry: the same foot where more and more of them grow. TRAIL (7)-(9)"""
    densities = np.array([0.0, 5.0, 10.0, 20.0, 40.0])
    depths = []
    for density in densities:
        stands = [Planting("carex", float(density), rectangle=(-0.5, -0.5, 0.5, 0.5))] if density else []
        sim = stood_on(firm(), bodies.box(*FOOT), (0.0, 0.0, -PERSON * GRAVITY), plants=stands)
        depths.append(1000.0 * sim.report()["deepest_m"])
    return Figure(
        "roots",
        "A foot of 75 kg among Carex, E 1 MPa",
        "plants a m^2",
        "depth [mm]",
        (Curve("depth", densities, np.array(depths)),),
        (
            Claim(
                "TRAIL (8)(9)",
                "The denser the plants, the less the ground gives.",
                f"{listed(depths)} mm at {listed(densities)} a m^2",
                rises(depths[::-1]),
            ),
        ),
    )


def cover() -> Figure:
    """What is left of Carex along a lane that is trodden. TRAIL (7); Cole 1995"""
    rows = trampling.measure(KINDS["carex"], passes=tuple(COLE))
    passes, left = (np.array(each, float) for each in zip(*rows))
    want = np.array(list(COLE.values()))
    worst = float(np.abs(left - want).max())
    return Figure(
        "cover",
        "Carex along a lane, two weeks after",
        "passes",
        "cover [per cent]",
        (Curve("here", passes, left), Curve("Cole 1995", passes, want, points=True)),
        (
            Claim(
                "Cole 1995, as TRAIL shows it",
                f"{listed(want)} per cent after {listed(passes)} passes.",
                f"{listed(left)} per cent, {worst:.1f} off at most",
                worst < COLE_MARGIN,
            ),
        ),
    )
