"""The times loads are found at, and back to those of the recording."""

from __future__ import annotations

import numpy as np

from ..motion.gait import Gait

RATE = 240.0  # a person's loads are found at this rate at least, the least multiple of the recording's own [1/s]


def even_rate(gait: Gait, size: float) -> tuple[Gait, int]:
    """(gait at a rate fit for filters, each how many samples of which are the recording's; 0: they lie elsewhere)."""
    rate, min_rate = gait.rate(), float(RATE / np.sqrt(size))
    if len(gait.time) == 1:
        return gait, 1
    if rate is None:
        return gait.evenly(min_rate), 0
    finer = int(np.ceil(min_rate / rate - 1e-6))
    return (gait.evenly(rate * finer), finer) if finer > 1 else (gait, 1)


def frame_rate_of(gait: Gait) -> float:
    """Frames a second that were recorded: the scene's, or the recording's if those are fewer."""
    span = gait.time[-1] - gait.time[0]
    return min(gait.frame_rate, (len(gait.time) - 1) / span) if span > 0 else gait.frame_rate


def nearest(have: np.ndarray, want: np.ndarray) -> np.ndarray:
    """Which of rising times (n,) is nearest to each that is wanted."""
    after = np.clip(np.searchsorted(have, want), 1, len(have) - 1) if len(have) > 1 else np.zeros(len(want), int)
    before = np.maximum(after - 1, 0)
    return np.where(abs(have[before] - want) <= abs(have[after] - want), before, after)


def at_times(
    want: np.ndarray, have: np.ndarray, touching: np.ndarray, force: np.ndarray, point: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Loads at other times: the nearest contact, forces between their neighbours.

    At an edge of contact a force jumps: beside one it is that of the nearest sample, as its contact is.
    """
    near = nearest(have, want)
    on = np.ascontiguousarray(touching[:, near])
    after = np.clip(np.searchsorted(have, want), 1, len(have) - 1)
    edge = touching[:, after] != touching[:, after - 1]
    new_force, new_point = np.zeros(on.shape + (3,)), point[:, near].copy()
    for p in range(len(on)):
        for c in range(3):
            new_force[p, :, c] = np.where(edge[p], force[p, near, c], np.interp(want, have, force[p, :, c]))
            known = np.isfinite(point[p, :, c])
            if known.any():
                new_point[p, :, c] = np.interp(want, have[known], point[p, known, c])
    new_force[on == 0] = 0.0
    new_point[on == 0] = np.nan
    return on, new_force, new_point
