"""How large a walker is. Lengths of a gait go with the leg, times and speeds with its root (Froude). MODEL 3.3

A recording of any walker, as large as a grown person, moves as a grown person does who walks alike: limits on
heights, speeds and times are given for a person's leg and asked of that recording. Accelerations stay what they
are, and so do forces.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import numpy as np

from .points import point_places
from .recording import Recording
from .tracks import TrackArray

LEG = 0.86  # from the hip joints to the ankles of a grown person [m]
TALL = 1.15  # whose mass centre is at most so high over his feet, in legs
QUICK = 0.6  # shorter legs step so quickly that they need more samples [m]
MAX_HURRY = 16.0  # but no more than so many times as many

R = TypeVar("R", bound=Recording)


def legs(gait: Recording) -> np.ndarray:
    """Leg length of each walker (W,) [m]: as recorded, else by how high its mass centre rises over its feet.

    What has one foot only is a thing rather than a walker, and meets the ground as it did for a person.
    """
    if len(gait.leg):
        return gait.leg
    if isinstance(gait.com, TrackArray):  # the tallest each ever is while it is there
        alone = (gait.only([w]) for w in range(len(gait.mass)))
        spans = ([each.piece(*span) for span in each.stays(0)] for each in alone)
        tall = [max((_tall(piece)[0] for piece in own), default=0.0) for own in spans]
    else:
        tall = _tall(gait)
    return np.array([high / TALL if high > 0.0 else LEG for high in tall])


def _tall(gait: Recording) -> list[float]:
    """How high the mass centre of each walker rises over its feet [m]; 0 for a thing."""
    height, owner = point_places(gait)[..., 2], gait.limb_walker[gait.part_limb[gait.point_part]]
    return [
        float((gait.com[w, :, 2] - height[owner == w].min(axis=0)).max()) if (gait.limb_walker == w).sum() > 1 else 0.0
        for w in range(len(gait.mass))
    ]


def known(gait: R) -> R:
    """The recording with its walkers' legs."""
    return gait if len(gait.leg) else replace(gait, leg=legs(gait))


def as_person(gait: R, size: float) -> R:
    """The recording of walkers whose legs are `size` persons' legs, as large as a person."""
    if size == 1.0:
        return gait
    pose = gait.pose.copy()
    pose[..., :3] /= size
    return replace(
        gait,
        time=gait.time / np.sqrt(size),
        com=gait.com / size,
        pose=pose,
        point=gait.point / size,
        frame_rate=gait.frame_rate * np.sqrt(size),
        leg=gait.leg / size,
    )


def hurry(gait: Recording) -> float:
    """How many times as many samples a second the smallest walker needs as a person does, 1 or more."""
    return float(np.clip(np.sqrt(QUICK / legs(gait).min()), 1.0, MAX_HURRY))
