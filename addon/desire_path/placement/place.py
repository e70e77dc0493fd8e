"""Feet put on the ground they walk over, and the walker carried there. TRAIL (1) (2), MODEL 4.1

Gait of a level floor --carry: feet and body rise with the ground--> --tilt: (1), (2)--> Gait of the hill
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from ..errors import DesirePathError
from ..ground.sim import Ground, Simulation
from ..keywords import fields_of
from ..loads import walker as walks
from ..motion import rotation, stays
from ..motion import size as sizes
from ..motion.gait import Gait
from ..motion.points import point_places
from ..rig import leg

REACH = 0.20  # d_max: feet this high over the ground are as recorded [m]
TOE_SLOPE = math.radians(15.0)  # theta_0: up steeper slopes the heels stay up [rad]
BODY = 0.5  # the body follows the ground smoothed over this, in heights of the mass centre
SLOW = 0.25  # points that rest are slower [m/s]
ROLL = 0.5  # a trunk leans sideways by this share of the slope across it, and along it by all; legs do the rest
SWAY = 0.25  # it leans as over this long before and after [s]
CLEARLY = 0.01  # the floor fits a clip better than the ground only by more than this [m]
GROWN = 0.2  # shorter feet rest slower and fit better, in proportion [m]


@dataclass(frozen=True)
class PlaceOptions:
    """How ground turns and lifts the feet that are put on it. TRAIL (1) (2)"""

    reach: float = REACH  # d_max: feet this high over the ground are as recorded [m] > 0
    toe_slope: float = TOE_SLOPE  # theta_0: up steeper slopes the heels stay up [rad] 0..pi/2
    foot_radius: float | None = None  # the ground is smoothed over this under a foot [m] > 0; None: a foot's length
    body_radius: float | None = None  # and over this under the body [m] > 0; None: half the mass centre's height

    def check(self) -> None:
        """Refuse numbers that no feet can be placed by, naming which."""
        for name, value in (
            ("reach", self.reach),
            ("smoothing radius of a foot", self.foot_radius),
            ("smoothing radius of the body", self.body_radius),
        ):
            if value is not None and not (math.isfinite(value) and value > 0.0):
                raise DesirePathError(f"A {name} of {value:g} m cannot be used: give one above 0.")
        if not 0.0 <= self.toe_slope <= math.pi / 2:
            raise DesirePathError(f"A toe slope of {self.toe_slope:g} rad cannot be used: give 0 to {math.pi / 2:.2f}.")


@fields_of(options=PlaceOptions)
def place_feet(
    gait: Gait,
    ground: Ground | Simulation,
    *,
    roll: bool = True,
    carry: bool | None = None,
    floor: float | None = None,
    walkers: Iterable[int] | None = None,
    options: PlaceOptions = PlaceOptions(),
) -> Gait:
    """The same walk with its feet on this ground, as a new Gait. TRAIL (1) (2)

    ground: a Ground or a Simulation. roll: feet keep the roll they have over their floor; False: they lie flat near
    the ground, as the paper prints (1). carry: the clip was recorded on a level floor, so that feet and body rise and
    sink with the ground; None: where the floor fits it better, or it is far from the ground. One who is not carried
    and whose feet lie on the ground already is left as it is. floor: its height [m], None: where the feet rest.
    walkers: their indices, None: all.
    """
    gait.check()
    land = Simulation(ground) if isinstance(ground, Ground) else ground
    if not isinstance(land, Simulation):
        raise DesirePathError("Feet are placed on a Ground or a Simulation: make one of the ground first.")
    options.check()
    if floor is not None and not math.isfinite(floor):
        raise DesirePathError("The floor's height is not a number: give it in metres, or none.")
    rows = range(len(gait.mass)) if walkers is None else walkers
    pose, com = gait.pose.copy(), gait.com.copy()
    for row in rows:
        if not 0 <= row < len(gait.mass):
            raise DesirePathError(f"There is no walker {row}: the recording has {len(gait.mass)}.")
        carried = carries(gait, land, row) if carry is None else bool(carry)
        if roll and not carried and lies(gait, land, row):
            continue
        clearance, stood = _stands(gait, land, row, carried, floor)
        high = sizes.TALL * float(sizes.legs(gait)[row])
        numbers = {
            "max_clearance": options.reach,
            "toe_slope": options.toe_slope,
            "foot_radius": options.foot_radius or _foot_length(gait, row),
            "body_radius": options.body_radius or BODY * high,
            "floor": stood,
        }
        try:
            land.place(walks.native_gait(gait), row, numbers, clearance, pose, com, flat=not roll, carry=carried)
        except ValueError as problem:
            if "no ground" not in str(problem):
                raise
            raise DesirePathError(
                f"{gait.walker_name[row]} walks beside the ground: move the walker or the "
                "ground so that one lies over the other."
            ) from None
    return replace(gait, pose=pose, com=com)


def tilt(gait: Gait, placed: Gait, row: int = 0) -> np.ndarray | None:
    """How the trunk of one that walks on more than two feet leans with the ground under them: turns (T, 3, 3).

    placed: the same walk with its feet on the ground. None: a trunk on one foot or two stays upright.
    """
    limbs = np.flatnonzero(gait.limb_walker == row)
    if len(limbs) < 3:
        return None
    lead = [int(np.flatnonzero(gait.part_limb == limb)[0]) for limb in limbs]
    at = placed.pose[lead, :, :2] - placed.pose[lead, :, :2].mean(axis=0)
    rise = placed.pose[lead, :, 2] - gait.pose[lead, :, 2]
    rise = rise - rise.mean(axis=0)
    spread = np.einsum("lti,ltj->tij", at, at)
    size = np.trace(spread, axis1=1, axis2=2)[:, None, None]
    rate = np.linalg.solve(spread + (1e-4 * size + 1e-12) * np.eye(2), np.einsum("lti,lt->ti", at, rise)[..., None])
    ahead = rotation.matrix(gait.pose[lead, :, 3:])[..., :2, 0].mean(axis=0)

    def calm(values: np.ndarray) -> np.ndarray:
        return _calm(values, round(SWAY * gait.frame_rate))

    ahead = gait.by_piece(calm, ahead)
    ahead = ahead / np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    along = np.sum(rate[..., 0] * ahead, axis=1, keepdims=True) * ahead
    rate = gait.by_piece(calm, along + ROLL * (rate[..., 0] - along))
    up = np.zeros((len(rate), 3))
    up[:, 2] = 1.0
    return leg.turn_between(up, rotation.unit(np.concatenate([-rate, up[:, 2:]], axis=1)))


def _calm(values: np.ndarray, frames: int) -> np.ndarray:
    """The mean of values (T, n) over so many samples before and after, held at the ends."""
    padded = np.pad(values, ((frames, frames), (0, 0)), mode="edge")
    return np.asarray(np.lib.stride_tricks.sliding_window_view(padded, 2 * frames + 1, axis=0).mean(axis=-1))


def carries(gait: Gait, land: Simulation, row: int) -> bool:
    """Was this walker recorded on a level floor rather than on this ground?"""
    own = _points_of(gait, row)
    places = point_places(gait)[own]
    flat = places[..., 2]
    over = flat - land.rest_height(places[..., :2].reshape(-1, 2)).reshape(flat.shape)
    small = min(1.0, _foot_length(gait, row) / GROWN)
    if len(gait.time) > 1:
        rests = np.linalg.norm(np.gradient(places[..., :2], gait.time, axis=1), axis=2) < SLOW * small
    else:
        rests = np.ones(flat.shape, bool)
    rests &= np.isfinite(over)
    if len(gait.time) > 1:  # where one waits counts as much as where one steps
        rests = np.array([stays.thinned(each, gait.time, small) for each in rests])
    if rests.sum() < 3:
        return True
    if abs(float(np.median(over[rests]))) > walks.HOVER * sizes.legs(gait)[row] / sizes.LEG:
        return True
    return _spread(over, rests) > _spread(flat, rests) + CLEARLY * small


def lies(gait: Gait, land: Simulation, row: int) -> bool:
    """Do this walker's feet, where they stand, lie on this ground rather than level?"""
    touching, _ = walks.contacts(gait, land.rest_height)
    nearer = []
    for part in np.flatnonzero(gait.limb_walker[gait.part_limb] == row):
        at = gait.pose[part]
        rests = touching[part] != 0
        if len(gait.time) > 1:
            rests &= np.linalg.norm(np.gradient(at[:, :3], gait.time, axis=0), axis=1) < SLOW
            rests = stays.thinned(rests, gait.time)
        for x, y, _, w, i, j, k in at[rests]:
            up = (2 * (i * k + w * j), 2 * (j * k - w * i), 1 - 2 * (i * i + j * j))
            nearer.append(float(np.dot(up, land.normal((x, y), _foot_length(gait, row)))) - up[2])
    return bool(nearer) and float(np.mean(nearer)) > 0.0


def _spread(height: np.ndarray, rests: np.ndarray) -> float:
    """How far a point's resting places are apart in height, for three of four of them [m]."""
    apart = [np.abs(row[on] - np.median(row[on])) for row, on in zip(height, rests) if on.any()]
    return float(np.quantile(np.concatenate(apart), 0.75))


def _points_of(gait: Gait, row: int) -> np.ndarray:
    return np.flatnonzero(gait.limb_walker[gait.part_limb[gait.point_part]] == row)


def _foot_length(gait: Gait, row: int) -> float:
    """Of one walker's soles, the parts of a limb end to end [m]."""
    length = np.zeros(len(gait.limb_walker))
    for part, limb in enumerate(gait.part_limb):
        length[limb] += float(np.ptp(gait.soles[part].vertices[:, 0]))
    return max(float(np.median(length[gait.limb_walker == row])), 0.02)


def _stands(gait: Gait, land: Simulation, row: int, carried: bool, floor: float | None) -> tuple[np.ndarray, float]:
    """Resting clearance of each point over what it stood on (K,), and the height of a level floor [m]."""
    touching, clearance = walks.contacts(gait, None if carried else land.rest_height)
    if not carried:
        return clearance, 0.0
    own = _points_of(gait, row)
    used = own[touching[gait.point_part[own]].any(axis=1)]
    stood = float(np.median(clearance[used if len(used) else own])) if floor is None else float(floor)
    return clearance - stood, stood
