"""Vehicles: axles with tyres, the foremost led along a curve; those behind it cut the corners. MODEL 3.8

Vehicle + Path ---steer---> where the middle of each axle is and how it heads, by lengths along the curve
"""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from ..errors import DesirePathError
from ..files import record
from ..motion.recording import MAX_MASS
from . import tyre
from .pace import ahead_of
from .path import Path

LONGEST = 100.0  # an axle may lie behind the foremost, or be wide [m]
MAX_AXLES, MAX_TYRES = 12, 2
MAX_STEER = math.radians(60.0)  # wheels of the foremost axle turn against the body, at most
BESIDE = 1.15  # middles of dual tyres lie apart, in their widths
STEER_STEP = 0.02  # the body's heading is followed so often [m]


@dataclass(frozen=True)
class Axle:
    """Wheels on one axle, a left and a right one, or one in the middle."""

    behind: float = 0.0  # the foremost axle [m], 0..100; those that are not 0 do not steer
    radius: float = 0.5  # of its wheels [m] > 0
    width: float = 0.3  # of a tyre [m] > 0
    tread: str = "blocks"  # one of tyre.TYRES
    gauge: float = 0.0  # between the middles of what stands left and right [m]; 0: one wheel
    tyres: int = 1  # side by side at each end: 1, or 2 (dual tyres)
    share: float = 1.0  # of the mass, against the shares of the other axles > 0

    def sides(self) -> list[tuple[str, float]]:
        """Each tyre's name and how far it stands left of the middle [m]."""
        ends = [("left", 0.5), ("right", -0.5)] if self.gauge > 0.0 else [("", 0.0)]
        if self.tyres == 1:
            return [(name, side * self.gauge) for name, side in ends]
        half = 0.5 * BESIDE * self.width
        outward = ("outer", 1.0), ("inner", -1.0)
        return [
            (f"{name} {which}".strip(), side * self.gauge + (out if side >= 0.0 else -out) * half)
            for name, side in ends
            for which, out in outward
        ]


@dataclass(frozen=True)
class Vehicle:
    """What drives along a track: axles from the foremost to the last."""

    axles: tuple[Axle, ...] = (Axle(),)
    mass: float = 200.0  # of all of it, where no other is given [kg] > 0
    speed: float = 2.0  # where no other is given [m/s] > 0

    def __post_init__(self) -> None:
        given = self.axles if isinstance(self.axles, (list, tuple)) else ()
        object.__setattr__(self, "axles", tuple(map(_axle, given)))
        _number("vehicle's mass", self.mass, 1e-6, MAX_MASS)
        _number("vehicle's speed", self.speed, 1e-3, 1e3)
        if not 1 <= len(self.axles) <= MAX_AXLES:
            raise DesirePathError(f"A vehicle has {len(self.axles)} axles: give it from 1 to {MAX_AXLES}.")
        if [axle.behind for axle in self.axles if axle.behind == 0.0] != [0.0] or self.axles[0].behind != 0.0:
            raise DesirePathError(
                "A vehicle's first axle is its foremost, 0 m behind itself, and the others lie behind it: "
                "mend `behind`."
            )

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it as JSON, to be changed and shared."""
        record.save(self, path, "desire_path_vehicle", 1, "vehicle")

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Vehicle:
        """A vehicle out of a file that save() wrote."""
        return record.load(Vehicle, path, "desire_path_vehicle", 1, "vehicle")

    def plain(self) -> Vehicle:
        """The same without treads."""
        return replace(self, axles=tuple(replace(axle, tread="plain") for axle in self.axles))

    @property
    def base(self) -> float:
        """From the foremost axle to the middle of those that do not steer [m]; 0: there is none."""
        behind = [axle.behind for axle in self.axles[1:]]
        return float(np.mean(behind)) if behind else 0.0

    def steer(self, path: Path, s: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
        """For each axle where its middle is (n, 2) [m] and how it heads (n,) [rad] when the foremost is at s (n,).

        The body follows as a bar that is drawn: its heading turns by sin(steering angle) over its base a metre
        (the tractrix), and it comes straight from before the curve.
        """
        front, led = path.at(s)
        if not self.base:
            return [(front, led)]
        along, body = _drawn(path, self.base, float(np.max(s)))
        turned = np.interp(along, path.s, path.heading) - body
        worst = int(np.argmax(abs(turned)))
        if abs(turned[worst]) > MAX_STEER:
            (x, y), _ = path.at(along[worst])
            raise DesirePathError(
                f"The curve bends too tightly for this vehicle at x {x:.3g} m, y {y:.3g} m, where its front wheels "
                f"would stand at {math.degrees(abs(turned[worst])):.0f} degrees: draw it wider, or choose a shorter "
                "vehicle."
            )
        heading = np.interp(s, along, body)
        return [(front, led)] + [(front - axle.behind * ahead_of(heading), heading) for axle in self.axles[1:]]


def _drawn(path: Path, base: float, farthest: float) -> tuple[np.ndarray, np.ndarray]:
    """Lengths along a curve and the heading of a bar that is drawn by its front along it. MODEL 3.8

    Exact for a front that heads straight from place to place: tan(steering angle / 2) falls by exp(-ds / base).
    """
    count = max(math.ceil(max(farthest, path.length) / STEER_STEP), 1)
    along = np.linspace(0.0, max(farthest, path.length), count + 1)
    ahead = np.interp(0.5 * (along[1:] + along[:-1]), path.s, path.heading)
    kept = math.exp(-along[1] / base)
    body = [float(path.heading[0])]
    for led in ahead.tolist():
        body.append(led - 2.0 * math.atan(kept * math.tan(0.5 * (led - body[-1]))))
    return along, np.array(body)


def _number(name: str, value: object, least: float, most: float) -> None:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not least <= value <= most:
        raise DesirePathError(f"The {name} is {value!s:.40}: give a number from {least:g} to {most:g}.")


def _axle(given: Axle | Mapping[str, Any]) -> Axle:
    """An axle whose numbers can be; from a file it is a mapping."""
    if isinstance(given, Mapping):
        unknown = sorted(set(given) - {each.name for each in fields(Axle)})
        if unknown:
            raise DesirePathError(f"An axle has no {str(unknown[0])[:40]}: remove it.")
        given = Axle(**given)
    if not isinstance(given, Axle):
        raise DesirePathError("A vehicle's axles are a list of Axle: give it so.")
    tyre.check(given.tread)
    for name, least, most in (("behind", 0.0, LONGEST), ("gauge", 0.0, LONGEST), ("share", 1e-6, 1e6)):
        _number(f"axle's {name}", getattr(given, name), least, most)
    for name in ("radius", "width"):  # how large they may be is the tyre's to say
        value = getattr(given, name)
        _number(f"axle's {name}", 0.0 if value != value else value, -math.inf, math.inf)
    if type(given.tyres) is not int or not 1 <= given.tyres <= MAX_TYRES:
        raise DesirePathError(f"An axle has {given.tyres!s:.40} tyres side by side: give 1 or {MAX_TYRES}.")
    if given.gauge > 0.0 and given.tyres > 1 and given.gauge < (BESIDE + 1.0) * given.width:
        raise DesirePathError(
            f"Dual tyres {given.width:g} m wide do not fit in a gauge of {given.gauge:g} m: widen it."
        )
    return given


VEHICLES: Mapping[str, Vehicle] = MappingProxyType(
    {
        "bicycle": Vehicle((Axle(0.0, 0.34, 0.05, share=0.42), Axle(1.05, 0.34, 0.05, share=0.58)), 90.0, 4.0),
        "motorcycle": Vehicle((Axle(0.0, 0.32, 0.12, share=0.47), Axle(1.45, 0.32, 0.17, share=0.53)), 280.0, 8.0),
        "car": Vehicle(
            (Axle(0.0, 0.32, 0.205, gauge=1.55, share=0.55), Axle(2.65, 0.32, 0.205, gauge=1.55, share=0.45)),
            1500.0,
            5.0,
        ),
        "tractor": Vehicle(
            (Axle(0.0, 0.6, 0.42, "bars", 1.8, share=0.4), Axle(2.75, 0.9, 0.58, "bars", 1.8, share=0.6)), 6500.0, 3.0
        ),
        "truck": Vehicle(
            (Axle(0.0, 0.5, 0.3, gauge=2.05, share=0.38), Axle(4.5, 0.5, 0.28, gauge=1.85, tyres=2, share=0.62)),
            12000.0,
            4.0,
        ),
        "lorry": Vehicle(
            (
                Axle(0.0, 0.5, 0.3, gauge=2.05, share=0.28),
                Axle(4.4, 0.5, 0.28, gauge=1.85, tyres=2, share=0.36),
                Axle(5.75, 0.5, 0.28, gauge=1.85, tyres=2, share=0.36),
            ),
            25000.0,
            4.0,
        ),
    }
)


def find(name: str | os.PathLike[str]) -> Vehicle:
    """A vehicle by its name, or out of a .json file."""
    if str(name).endswith(".json"):
        return Vehicle.load(name)
    if name not in VEHICLES:
        raise DesirePathError(
            f"There is no vehicle '{str(name)[:40]}': choose one of {', '.join(VEHICLES)}, or a .json file of one."
        )
    return VEHICLES[str(name)]
