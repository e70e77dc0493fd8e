"""Experiments on soil alone: dropped, pressed, pushed, at rest. TRAIL (10)-(16), SOFT22 (9)-(14)"""

from __future__ import annotations

import math

import numpy as np

from ..ground.sim import Ground, Simulation
from ..loads import walker
from ..loads.force import GRAVITY
from . import bodies
from .figure import Claim, Curve, Figure
from .rigs import CELL, FOOT, HALF, PERSON, TAUS, firm, listed, plain, read, rises, stood_on, sunk, walked

PAPERS = ("dry-sand", "snow", "mud", "soil")  # soils of both papers' tables


def _dropped(mass: float = 50.0, modulus: float = 1e6, nu: float = 0.35) -> tuple[float, float, float]:
    """A ball of 0.3 m dropped from 2.5 m: (peak force [N], depth, height of its rim [m])."""
    soil = firm(young_modulus=modulus, poisson_ratio=nu)
    gait = bodies.dropped(mass, 2.5, 0.15)
    sim = Simulation(Ground.flat(), soil, CELL)
    loads = walker.loads(gait, "impulse", ground=sim.rest_height, settle_time=soil.settle_time)
    walked(sim, gait, loads)
    return -float(np.min(loads.force[0, :, 2])), sim.report()["deepest_m"], float(read(sim, "heap").max())


def sphere() -> Figure:
    """A ball dropped on soils and of masses of all kinds. SOFT22 Fig. 7"""
    shares = (0.5, 1.0, 2.0)
    by_mass = [_dropped(mass=50.0 * share) for share in shares]
    by_modulus = [_dropped(modulus=1e6 * share) for share in shares]
    nus = (0.1, 0.25, 0.45)
    by_nu = [_dropped(nu=nu) for nu in nus]
    depth = [[1000.0 * depth for _, depth, _ in runs] for runs in (by_mass, by_modulus, by_nu)]
    rims = [1000.0 * rim for _, _, rim in by_nu]
    impact = by_mass[1][0]
    same = max(depth[2]) / min(depth[2]) - 1.0
    return Figure(
        "sphere",
        "A ball of 50 kg dropped from 2.5 m, E 1 MPa, tau 0.2 s",
        "mass, E, nu as shares of 50 kg, 1 MPa, 0.25",
        "depth, height of the rim [mm]",
        (
            Curve("depth by mass", np.array(shares), np.array(depth[0])),
            Curve("depth by E", np.array(shares), np.array(depth[1])),
            Curve("depth by nu", np.array(nus) / 0.25, np.array(depth[2])),
            Curve("rim by nu", np.array(nus) / 0.25, np.array(rims)),
        ),
        (
            Claim(
                "SOFT22 (6)-(8)",
                "It hits with its weight and m v/tau, 2241 N.",
                f"{impact:.0f} N",
                abs(impact / 2241.0 - 1.0) < 0.01,
            ),
            Claim("SOFT22 Fig. 7", "The heavier, the deeper.", f"{listed(depth[0])} mm", rises(depth[0])),
            Claim("SOFT22 Fig. 7", "The stiffer, the shallower.", f"{listed(depth[1])} mm", rises(depth[1][::-1])),
            Claim("SOFT22 Fig. 7", "The depth does not depend on nu.", f"{listed(depth[2])} mm", same < 1e-3),
            Claim("SOFT22 Fig. 7", "The rim grows with nu.", f"{listed(rims)} mm", rises(rims)),
        ),
    )


def sinking() -> Figure:
    """How a foot goes down over the time in which the ground stops it. SOFT22 (11)"""
    curves, ends, most = [], [], []
    for tau in TAUS:
        soil = firm(settle_time=tau)
        sim = Simulation(Ground.flat(), soil, CELL)
        gait, loads = bodies.pressed([bodies.box(*FOOT)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -PERSON * GRAVITY]])
        sim.load(gait, loads)
        time, depth = [0.0], [0.0]
        for sample in range(1, int(0.4 * bodies.RATE)):
            sim.run(sample)
            time.append(sample / bodies.RATE)
            depth.append(1000.0 * float(read(sim, "compression").max()))
        curves.append(Curve(f"tau {tau:g} s", np.array(time), np.array(depth)))
        ends.append(depth[-1])
        most.append(float(np.interp(0.99 * depth[-1], depth, time)))
    want = 1000.0 * sunk(firm(), PERSON, FOOT[0] * FOOT[1])
    return Figure(
        "sinking",
        "A foot of 75 kg on E 1 MPa",
        "time on the ground [s]",
        "depth [mm]",
        tuple(curves),
        (
            Claim(
                "SOFT22 (9)(10)",
                f"It sinks by sigma L0/E, {want:.2f} mm.",
                f"{listed(ends)} mm",
                max(abs(end / want - 1.0) for end in ends) < 0.02,
            ),
            Claim(
                "SOFT22 (11)",
                "It takes tau to sink.",
                f"{listed(most, '.2f')} s to 99 % for tau {listed(TAUS)} s",
                max(abs(seen - tau) for seen, tau in zip(most, TAUS)) < 0.03,
            ),
        ),
    )


def soils() -> Figure:
    """The papers' soils under one foot: sections along its print. TRAIL Table 1, SOFT22 Table 1"""
    curves, depths, wants, ratios, nus = [], [], [], [], []
    for name in PAPERS:
        soil = plain(name)
        sim = stood_on(soil, bodies.box(*FOOT), (0.0, 0.0, -PERSON * GRAVITY))
        height = 1000.0 * (read(sim, "heap") - read(sim, "compression"))[HALF]
        x = CELL * (np.arange(-HALF, HALF) + 0.5)
        near = np.abs(x) < 0.3
        curves.append(Curve(name, x[near], height[near]))
        report = sim.report()
        depths.append(1000.0 * report["deepest_m"])
        wants.append(1000.0 * sunk(soil, PERSON, FOOT[0] * FOOT[1]))
        ratios.append(float(read(sim, "heap").sum() * CELL**2 / report["pressed_m3"]))
        nus.append(soil.poisson_ratio)
    return Figure(
        "soils",
        "One foot of 75 kg on the papers' soils, a section along it",
        "along the foot [m]",
        "height [mm]",
        tuple(curves),
        (
            Claim(
                "SOFT22 (9)(10)",
                f"{', '.join(PAPERS)}: sigma L0/E, {listed(wants)} mm deep.",
                f"{listed(depths)} mm",
                max(abs(seen / want - 1.0) for seen, want in zip(depths, wants)) < 0.02,
            ),
            Claim(
                "SOFT22 (12)",
                f"Heaps of 2 nu, {listed([2.0 * nu for nu in nus])}, times what was pressed.",
                listed(ratios),
                max(abs(seen - 2.0 * nu) for seen, nu in zip(ratios, nus)) < 0.02,
            ),
        ),
    )


def push() -> Figure:
    """Where the heap lies when a foot pushes along the ground. TRAIL (11)-(13)"""
    threshold = 200.0  # [N]
    soil = firm(push_threshold=threshold, rest_angle=math.radians(80.0))
    shares = np.linspace(0.0, 2.0, 9)
    ahead = []
    for share in shares:
        sim = stood_on(soil, bodies.box(0.15, 0.15), (share * threshold, 0.0, -PERSON * GRAVITY))
        heap = read(sim, "heap")
        ahead.append(float(heap[:, HALF:].sum() / heap.sum()))
    capped = ahead[len(shares) // 2 :]
    return Figure(
        "push",
        "What a square foot that pushes heaps up ahead of it",
        "F_par/F_threshold",
        "share of the heap that lies ahead",
        (Curve("share ahead", shares, np.array(ahead)),),
        (
            Claim(
                "TRAIL (12)",
                "Without a push it lies alike on all sides.",
                f"{ahead[0]:.3f} of it ahead",
                abs(ahead[0] - 0.5) < 0.01,
            ),
            Claim(
                "TRAIL (11)(13)",
                "The harder the push, the more lies ahead; from the threshold on all that may.",
                f"{listed(ahead[: len(shares) // 2 + 1], '.2f')}, then {listed(capped[1:], '.2f')}",
                rises(ahead[: len(shares) // 2 + 1]) and max(capped) - min(capped) < 0.01,
            ),
        ),
    )


def _steepest(surface: np.ndarray, heap: np.ndarray) -> float:
    """Steepest fall from a cell of loose soil to one beside it [degrees]. heights (ny, nx) [m]"""
    falls = [
        float(np.where(loose > 1e-4, high - low, 0.0).max())
        for loose, high, low in (
            (heap[:, 1:], surface[:, 1:], surface[:, :-1]),
            (heap[:, :-1], surface[:, :-1], surface[:, 1:]),
            (heap[1:], surface[1:], surface[:-1]),
            (heap[:-1], surface[:-1], surface[1:]),
        )
    ]
    return math.degrees(math.atan(max(falls) / CELL))


def repose() -> Figure:
    """How steep loose heaps stand when they have come to rest. TRAIL (14)-(16)"""
    angles = np.array([10.0, 15.0, 20.0, 25.0, 30.0, 35.0])
    steepest = []
    for angle in angles:
        soil = firm(rest_angle=math.radians(angle), young_modulus=0.2e6, poisson_ratio=0.5)
        sim = stood_on(soil, bodies.box(*FOOT), (0.0, 0.0, -PERSON * GRAVITY))
        sim.settle()
        heap = read(sim, "heap")
        steepest.append(_steepest(heap - read(sim, "compression"), heap))
    return Figure(
        "repose",
        "Loose heaps at rest",
        "rest angle [degrees]",
        "steepest slope of loose soil [degrees]",
        (Curve("seen", angles, np.array(steepest), points=True), Curve("rest angle", angles, angles)),
        (
            Claim(
                "TRAIL (14)(16)",
                f"No loose slope stays steeper than the rest angle, {listed(angles)} degrees.",
                f"{listed(steepest, '.2f')} degrees",
                bool(np.all(np.abs(np.array(steepest) - angles) < 0.1)),
            ),
        ),
    )
