"""How a body leans into slopes and swings on ground that gives way. SOFT22 (1), MODEL 4.5

where feet rest --grade: of the segment they stand on--> target --torque (1), a damped pendulum--> lean --turns-->
turns of the body about its mass centre, which stays over the feet as it was recorded
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from ..arrays import Record
from ..errors import DesirePathError
from ..keywords import fields_of
from ..loads import walker as walks
from ..loads.below import GroundHeights
from ..motion import rotation
from ..motion import size as sizes
from ..motion.gait import Gait
from ..motion.points import point_places

STIFFNESS = 30.0  # alpha [N], of a body of unit inertia whose mass centre is 1 m high
DAMPING = 6.0  # beta [N m s], of the same
SHARE = 0.5  # of the slope a body leans by
MOST = math.radians(30.0)  # nobody leans farther
BASE = 0.02  # feet closer together than this say little of a slope, in heights of the mass centre
SLOW = 0.2  # what rests is slower, of a body 1 m high [m/s]
NEAR = 0.25  # feet count that stand within about this before and after, of a body 1 m high [s]


@dataclass(frozen=True)
class BalanceOptions:
    """How a body answers to the ground. SOFT22 (1)"""

    share: float = SHARE  # of the slope under its feet that it leans by in the end [-] 0..1
    stiffness: float = STIFFNESS  # alpha: the larger, the sooner                    [N] 1..1000
    damping: float = DAMPING  # beta: the larger, the less it swings                 [N m s] 0.1..1000

    def check(self) -> BalanceOptions:
        """Itself, if a body can lean so; a sentence names the first number that is none."""
        for name, value, low, high in (
            ("share", self.share, 0.0, 1.0),
            ("stiffness", self.stiffness, 1.0, 1000.0),
            ("damping", self.damping, 0.1, 1000.0),
        ):
            if not low <= value <= high:
                raise DesirePathError(f"A body cannot lean with a {name} of {value:g}: give {low:g} to {high:g}.")
        return self


@dataclass(frozen=True, eq=False, repr=False)
class Lean(Record):
    """How a walker leans over time."""

    time: np.ndarray  # (T,) [s]
    grade: np.ndarray  # slope of what its feet stand on, up ahead > 0    (T,) [-]
    angle: np.ndarray  # theta: forward > 0                                (T,) [rad]
    heading: np.ndarray  # u: unit vectors along which it leans, level     (T, 2)

    def turns(self) -> np.ndarray:
        """Turns (T, 3, 3) that lean what stood upright."""
        x, y = self.heading.T
        return _about(np.stack([-y, x, np.zeros_like(x)], axis=1), self.angle)


def torque(
    target: np.ndarray, com: np.ndarray, along: np.ndarray, rate: np.ndarray, options: BalanceOptions
) -> np.ndarray:
    """T = alpha (p_target - p_com).u - beta dtheta/dt (T,) [N m]. SOFT22 (1)

    target, com: places (T, 3) [m]; along: u (T, 3), level; rate: dtheta/dt (T,) [rad/s]
    """
    apart = np.sum((target - com) * along, axis=-1)
    return np.asarray(options.stiffness * apart - options.damping * rate)  # SOFT22 (1)


def swing(wanted: np.ndarray, time: np.ndarray, height: float, options: BalanceOptions) -> np.ndarray:
    """theta (T,) [rad] of a damped pendulum after angles it is drawn to, from rest at the first. SOFT22 (1)

    I theta'' = alpha h (wanted - theta) - beta theta', exact for angles that go straight from sample to sample.
    I = h^2; alpha is told for h = 1 m, and beta grows with h^1.5, so that bodies of all sizes swing alike.
    """
    spring = options.stiffness / height  # omega^2 = alpha h / I
    damp = 0.5 * options.damping / math.sqrt(height)  # beta / (2 I)
    out, rate = np.empty(len(wanted)), 0.0
    out[:1] = wanted[:1]
    for k in range(1, len(wanted)):
        step = float(time[k] - time[k - 1])
        slope = float(wanted[k] - wanted[k - 1]) / step
        lag = 2.0 * damp * slope / spring  # it follows a slope at this distance
        off, speed = float(out[k - 1] - wanted[k - 1]) + lag, rate - slope
        off, speed = _decay(off, speed, spring, damp, step)
        out[k], rate = float(wanted[k]) - lag + off, speed + slope
    return out


def _decay(off: float, speed: float, spring: float, damp: float, step: float) -> tuple[float, float]:
    """What is left of x'' = -spring x - 2 damp x' after a step."""
    turn = cmath.sqrt(spring - damp * damp)
    fade = math.exp(-damp * step)
    c = cmath.cos(turn * step).real
    s = (cmath.sin(turn * step) / turn).real if abs(turn) * step > 1e-6 else step
    x = fade * (off * c + (speed + damp * off) * s)
    return x, fade * (speed * c - (spring * off + damp * speed) * s)


def grade(gait: Gait, touching: np.ndarray, clearance: np.ndarray, walker: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """(slope of what a walker's feet stand on (T,) [-], their direction (T, 2)) at each sample.

    touching (P, T), clearance (K,): as contacts() has them
    A plane through the places where its feet rest, those of now most of all.
    """
    high = _height(gait, walker)
    near = NEAR * math.sqrt(high)
    lead = [int(np.flatnonzero(gait.part_limb == limb)[0]) for limb in np.flatnonzero(gait.limb_walker == walker)]
    ahead = rotation.matrix(gait.pose[lead, :, 3:])[..., :2, 0].sum(axis=0)
    own = np.flatnonzero(gait.limb_walker[gait.part_limb[gait.point_part]] == walker)
    places = point_places(gait)[own]
    rests = _rests(places, gait, math.sqrt(high)) * (touching[gait.point_part[own]] != 0)
    places[..., 2] -= clearance[own, None]
    rise, heading = np.zeros(len(gait.time)), np.zeros((len(gait.time), 2))
    for first, after in gait.pieces():
        time = gait.time[first:after]
        for t, now in enumerate(time, first):
            a, b = first + np.searchsorted(time, (now - 3.0 * near, now + 3.0 * near))
            weight = np.exp(-0.5 * ((gait.time[a:b] - now) / near) ** 2)
            heading[t] = weight @ ahead[a:b]
            heading[t] /= max(float(np.hypot(*heading[t])), 1e-9)
            share = (rests[:, a:b] * weight).ravel()
            total = float(share.sum())
            if total <= 0.0:
                rise[t] = np.nan
                continue
            rise[t] = _plane(places[:, a:b].reshape(-1, 3), share / total, heading[t], BASE * high)
        known = np.flatnonzero(np.isfinite(rise[first:after]))
        rise[first:after] = np.interp(np.arange(after - first), known, rise[first + known]) if len(known) else 0.0
    return rise, heading


@fields_of(options=BalanceOptions)
def lean(
    gait: Gait, ground: GroundHeights = None, *, walker: int = 0, options: BalanceOptions = BalanceOptions()
) -> Lean:
    """How a walker on two feet leans: forward where they climb, back where they go down. SOFT22 (1)

    gait: with its feet where they rest, as place_feet() and into_prints() leave them; ground: see contacts()
    Its feet and its mass centre stay where they are, and so do the prints it presses; Lean.turns() is how the rest
    turns about the mass centre. Raises DesirePathError for what has not two feet, and for options out of range.
    """
    options.check()
    if not 0 <= walker < len(gait.mass):
        raise DesirePathError(f"There is no walker {walker}: the recording has {len(gait.mass)}.")
    if int((gait.limb_walker == walker).sum()) != 2:
        raise DesirePathError(
            f"{gait.walker_name[walker]} does not go on two feet: only such a body leans, one on more feet lies along "
            "the ground."
        )
    rise, heading = grade(gait, *walks.contacts(gait, ground), walker)
    high = _height(gait, walker)
    wanted = np.clip(np.arctan(options.share * rise), -MOST, MOST)
    angle = np.empty(len(wanted))
    for first, after in gait.pieces():
        angle[first:after] = swing(wanted[first:after], gait.time[first:after], high, options)
    return Lean(np.asarray(gait.time), rise, angle, heading)


def _rests(places: np.ndarray, gait: Gait, quick: float) -> np.ndarray:
    """How much each point rests (K, T), 0 to 1."""
    fast = gait.by_piece(lambda at: np.gradient(at, axis=0) if len(at) > 1 else 0.0 * at, places.swapaxes(0, 1))
    step = float(np.median(np.diff(gait.time))) if len(gait.time) > 1 else 1.0
    return np.asarray(np.exp(-((np.linalg.norm(fast, axis=2) / (step * SLOW * quick)) ** 2)).T)


def _plane(at: np.ndarray, weight: np.ndarray, ahead: np.ndarray, base: float) -> float:
    """How far a plane through places (n, 3) rises along a direction; level where they are closer than `base`."""
    off = at - weight @ at
    aside = np.stack([off[:, :2] @ ahead, off[:, :2] @ (-ahead[1], ahead[0])])
    spread = (aside * weight) @ aside.T + base**2 * np.eye(2)
    return float(np.linalg.solve(spread, (aside * weight) @ off[:, 2])[0])


def _height(gait: Gait, walker: int) -> float:
    """Of a walker's mass centre over its feet [m]."""
    return float(sizes.TALL * sizes.legs(gait)[walker])


def _about(axis: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Turns (T, 3, 3) about unit vectors (T, 3) by angles (T,)."""
    half = 0.5 * angle[:, None]
    return rotation.matrix(np.concatenate([np.cos(half), np.sin(half) * axis], axis=1))
