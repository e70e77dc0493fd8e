"""The height of the ground under contact points, beside its edge and over its holes too."""

import numpy as np

from ..errors import DesirePathError
from ..motion.points import point_places


def ground_below(gait, ground):
    """Height of the ground below each contact point (K, T) [m].

    ground: None = flat at 0; a number; heights (K, T); a function of points (n, 2) -> (n,); or what has one by the
    name of rest_height, as a Simulation. NaN where there is none: feet that step there carry their share and leave it
    to nobody else.
    """
    ground = heights_of(ground)
    shape = (len(gait.point), len(gait.time))
    if callable(ground):
        xy = point_places(gait)[..., :2].reshape(-1, 2)
        heights = np.asarray(ground(np.ascontiguousarray(xy)), float).reshape(shape)
    else:
        heights = np.asarray(0.0 if ground is None else ground, float)
        if heights.shape not in ((), shape):
            raise DesirePathError(
                f"The ground's heights have shape {heights.shape} where {shape} is "
                "needed: give one height for each contact point and sample."
            )
    return np.ascontiguousarray(np.broadcast_to(heights, shape), "f8").copy()


def heights_of(ground):
    """A ground as ground_below() takes it, with a Simulation's function of places in its stead."""
    return getattr(ground, "rest_height", ground)


def on_even(gait, even, ground):
    """Ground heights for the even recording; heights given for the recording itself are carried over."""
    if even is gait or callable(ground) or np.ndim(ground) == 0:
        return ground_below(even, ground)
    return np.stack([np.interp(even.time, gait.time, row) for row in ground_below(gait, ground)])


def carried_on(gait, below):
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


def off_ground(gait, below):
    """Where the whole limb of a part is beside the ground (P, T)."""
    over = np.zeros((len(gait.limb_walker), len(gait.time)), bool)
    np.logical_or.at(over, gait.part_limb[gait.point_part], np.isfinite(below))
    return ~over[gait.part_limb]
