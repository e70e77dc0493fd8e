"""The height of the ground under contact points, beside its edge and over its holes too."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias, TypeGuard, runtime_checkable

import numpy as np

from ..errors import DesirePathError
from ..motion.gait import Gait
from ..motion.points import below_sole, point_places
from ..motion.tracks import Array, TrackArray

Heights: TypeAlias = Callable[[np.ndarray], np.ndarray]  # points (n, 2) -> (n,) [m], NaN where there is no ground


@runtime_checkable
class Land(Protocol):
    """What has heights of its own, as a Simulation."""

    def rest_height(self, xy: np.ndarray) -> np.ndarray: ...


GivenHeights: TypeAlias = float | Array | Heights | None
GroundHeights: TypeAlias = GivenHeights | Land  # see ground_below()


def ground_below(gait: Gait, ground: GroundHeights) -> np.ndarray:
    """Height of the ground below each contact point (K, T) [m].

    ground: None = flat at 0; a number; heights (K, T); a function of points (n, 2) -> (n,); or what has one by the
    name of rest_height, as a Simulation. NaN where there is none: feet that step there carry their share and leave it
    to nobody else. A function is asked for the whole sole of a part none of whose points is over ground.
    """
    heights = heights_of(ground)
    shape = (len(gait.point), len(gait.time))
    if callable(heights):
        places = point_places(gait)
        xy = places[..., :2].reshape(-1, 2)
        found = np.asarray(heights(np.ascontiguousarray(xy)), float)
        if found.size != len(xy):
            raise DesirePathError(
                f"The ground gave heights of shape {found.shape} for {len(xy)} places: let it give one for each."
            )
        found = _under_soles(gait, places, found.reshape(shape), heights)
    else:
        found = np.asarray(0.0 if heights is None else heights, float)
        if found.shape not in ((), shape):
            raise DesirePathError(
                f"The ground's heights have shape {found.shape} where {shape} is "
                "needed: give one height for each contact point and sample."
            )
    return np.ascontiguousarray(np.broadcast_to(found, shape), "f8").copy()


def _under_soles(gait: Gait, places: np.ndarray, below: np.ndarray, land: Heights) -> np.ndarray:
    """Heights below points (K, T), with those of parts whose soles reach over an edge all their points are beside."""
    if np.isfinite(below).all():
        return below
    below = below.copy()
    for part in np.unique(gait.point_part):
        rows = np.flatnonzero(gait.point_part == part)
        beside = np.flatnonzero(~np.isfinite(below[rows]).any(axis=0))
        if len(beside):
            at = np.ix_(rows, beside)
            below[at] = below_sole(gait.soles[part], np.asarray(gait.pose[part])[beside], places[at], land)
    return below


def heights_of(ground: GroundHeights) -> GivenHeights:
    """A ground as ground_below() takes it, with a Simulation's function of places in its stead."""
    if isinstance(ground, TrackArray):
        return ground
    if isinstance(ground, Land):
        return ground.rest_height
    if not callable(ground):
        try:
            np.asarray(0.0 if ground is None else ground, float)
        except (TypeError, ValueError):
            raise DesirePathError(
                f"A {type(ground).__name__} is no ground to stand on: give a height, heights (K, T), a function of "
                "points (n, 2), or a Simulation, as Simulation(Ground.flat())."
            ) from None
    return ground


def heights_given(gait: Gait, heights: GivenHeights) -> Array:
    """Heights as ground_below() tells them, or those (K, T) that are given of who is there, as they are."""
    if not isinstance(heights, TrackArray):
        return ground_below(gait, heights)
    if heights.shape != (len(gait.point), len(gait.time)):
        return ground_below(gait, np.asarray(heights))  # says what is wrong
    return heights


def is_alike(ground: GivenHeights) -> TypeGuard[float | Heights | None]:
    """Whether a ground is told without naming the points and samples of a recording."""
    return ground is None or callable(ground) or np.ndim(ground) == 0


def on_even(gait: Gait, even: Gait, ground: GivenHeights) -> np.ndarray:
    """Ground heights for the even recording; heights given for the recording itself are carried over."""
    if even is gait or is_alike(ground):
        return ground_below(even, ground)
    return np.stack([np.interp(even.time, gait.time, row) for row in ground_below(gait, ground)])


def carried_on(gait: Gait, below: np.ndarray) -> np.ndarray:
    """Heights as if the ground went on beside its edge and over its holes, between those the same
    point finds before and after, else those of its walker. Who is never over it keeps NaN."""
    if np.isfinite(below).all():
        return below
    below, sample = below.copy(), np.arange(len(gait.time))
    owner = gait.limb_walker[gait.part_limb[gait.point_part]]
    for w in range(len(gait.mass)):
        rows = np.flatnonzero(owner == w)
        there = np.isfinite(below[rows])
        some = there.any(axis=0)
        if not some.any():
            continue
        mean = np.where(there, below[rows], 0.0).sum(axis=0)[some] / there.sum(axis=0)[some]
        for row, known in zip(rows, there):
            if known.any():
                below[row] = np.interp(sample, sample[known], below[row, known])
            else:
                below[row] = np.interp(sample, sample[some], mean)
    return below


def off_ground(gait: Gait, below: np.ndarray) -> np.ndarray:
    """Where the whole limb of a part is beside the ground (P, T)."""
    over: np.ndarray = np.zeros((len(gait.limb_walker), len(gait.time)), bool)
    np.logical_or.at(over, gait.part_limb[gait.point_part], np.isfinite(below))
    return np.asarray(~over[gait.part_limb])
