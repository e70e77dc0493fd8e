"""What a crowd's ground is like to walk on, how it wears, and how it grows again. MODEL 12.6. Experimental.

A cell knows its load: passes over a lane LANE wide, as many as would have worn it as far. Cover, cost and regrowth
follow from it in closed form.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import DesirePathError
from ..placement.effort import PER_CM, SNOW

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

LANE = 0.5  # how wide the lane is on which loads are counted [m], as Cole's were
BODY = 75.0  # who counts as one pass weighs so much [kg]
DAYS = 365.0  # of a year
PACE = 1.33  # of walkers, for what slopes cost [m/s]
MAX_LOAD = 1e12  # passes
MIN_LOAD = 1e-9  # passes; less is none


@dataclass(frozen=True)
class Cover:
    """How one kind of ground answers to a crowd."""

    detour: float  # k, by how much a metre of it costs more than a bare one          [-]  0..100
    faint: float = 1.0  # p: the less, the earlier a faint line is followed            [-]  0.1..10
    half_passes: float = math.inf  # that leave half the cover, on a lane of LANE      [-]  > 0, inf = it does not wear
    steepness: float = 1.0  # b, of cover over the logarithm of passes                 [-]  0.1..10
    regrow: float = 0.0  # r, rate at which cover grows again                          [1/year] 0..1000
    pull: float = 0.0  # l, how strong worn ground pulls, against 1 for the goal       [-]  0..below 1
    renewal: float = 0.0  # ways are chosen anew after such a share of all passages so far [-] 0..1; 0 = at even steps

    def check(self) -> Cover:
        """Itself, if its numbers are in their ranges; a sentence names the first that is not."""
        for name, low, high in (
            ("detour", 0.0, 100.0),
            ("faint", 0.1, 10.0),
            ("half_passes", 1e-3, math.inf),
            ("steepness", 0.1, 10.0),
            ("regrow", 0.0, 1000.0),
            ("pull", 0.0, 0.99),
            ("renewal", 0.0, 1.0),
        ):
            value = getattr(self, name)
            if isinstance(value, bool) or not isinstance(value, (int, float)) or not low <= value <= high:
                raise DesirePathError(
                    f"A crowd's ground cannot have a {name} of {value!r}: give a number from {low:g} to {high:g}."
                )
        return self

    def left(self, load: ArrayLike) -> np.ndarray:
        """Cover after so many passes: alpha = 1 / (1 + (L / N)^b), 1 = untouched. MODEL 12.6"""
        return np.asarray(1.0 / (1.0 + (np.asarray(load, float) / self.half_passes) ** self.steepness))

    def cost(self, load: ArrayLike) -> np.ndarray:
        """Of a metre: c = 1 + k (1 - (1 - alpha)^p), 1 where it is bare. MODEL 12.6"""
        return np.asarray(1.0 + self.detour * (1.0 - (1.0 - self.left(load)) ** self.faint))

    def rested(self, load: np.ndarray, days: float) -> np.ndarray:
        """Loads after days without walkers: the logit of cover grows by r t, so that loads shrink alike. MODEL 12.6"""
        if not (self.regrow and days) or math.isinf(self.half_passes):
            return load
        kept = load * math.exp(-self.regrow * days / DAYS / self.steepness)
        return np.where(kept > MIN_LOAD, kept, 0.0)


def snow(depth: float) -> Cover:
    """Snow in which feet sink so deep [m] until it is trodden: k = eta / 1.3 - 1, eta = 1.3 + 0.08 z. MODEL 12.6"""
    if not 0.03 < depth <= 0.5:
        raise DesirePathError(f"Snow of {depth:g} m cannot be waded: give a depth from 0.03 to 0.5.")
    return Cover(100.0 * PER_CM * depth / SNOW, 1.0, 2.0, 2.13, renewal=0.05)


COVERS: Mapping[str, Cover] = MappingProxyType(  # by name, to be read: ground of your own is a Cover
    {
        "meadow": Cover(0.3, 0.5, 150.0, 1.135, 1.02, 0.5),
        "lawn": Cover(0.2, 0.5, 150.0, 1.135, 1.02, 0.5),
        "brush": Cover(0.5, 0.5, 150.0, 1.135, 1.02, 0.5),
        "sand": Cover(0.9),
        "snow-15": snow(0.15),
        "snow-25": snow(0.25),
        "snow-35": snow(0.35),
    }
)


def as_cover(given: Any) -> Cover:
    """A name in COVERS, or a dict of numbers: those of its "kind", else of a meadow, and others in their place."""
    if isinstance(given, Cover):
        return given.check()
    numbers = {"kind": given} if isinstance(given, str) else given
    if not isinstance(numbers, dict):
        raise DesirePathError(f"A crowd cannot walk on {given!r}: name one of {', '.join(COVERS)}.")
    numbers = dict(numbers)
    name = numbers.pop("kind", "meadow")
    if not isinstance(name, str) or name not in COVERS:
        raise DesirePathError(f"A crowd knows no ground called {name!r}: name one of {', '.join(COVERS)}.")
    known = COVERS[name]
    unknown = sorted(set(numbers) - set(known.__dataclass_fields__))
    if unknown:
        raise DesirePathError(f"A crowd's ground has no number called '{unknown[0]}': remove it.")
    return Cover(**{**known.__dict__, **numbers}).check()


def steep(heights: np.ndarray, cell: float) -> np.ndarray:
    """What slopes cost, a factor >= 1 (ny, nx): the mean of up and down, as nobody knows who goes which. MODEL 12.6"""
    along, across = (np.gradient(heights, cell, axis=k) if heights.shape[k] > 1 else 0.0 * heights for k in (0, 1))
    rise = np.hypot(along, across)
    level = 1.5 + 1.5 * PACE**2
    return np.asarray(1.0 + 0.5 * 0.35 * PACE * 100.0 * rise / level)  # of V G, Pandolf 1977
