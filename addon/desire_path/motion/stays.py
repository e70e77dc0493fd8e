"""How long a pose is held tells nothing: what is known of a clip counts stays, not samples.

runs     where a mask begins and ends
still    samples at which the whole body keeps its pose: one who holds it there, or waits for his turn
votes    a weight for each sample of a mask, so that each stay in it counts the same
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

HELD = 0.3  # a pose is held when the mass centre keeps its place for so long [s] ..
SPOT = 0.01  # .. within this, of a grown person [m]
VOTE = 0.2  # longer stays count as much as one of this [s]


def still(com: np.ndarray, time: np.ndarray, size: float = 1.0) -> np.ndarray:
    """Samples (T,) within a stretch over which the mass centre (T, 3) keeps its place.

    size: leg length in those of a grown person; lengths go with it, times with its root.
    """
    held = np.zeros(len(time), bool)
    if len(time) < 3:
        return held
    after = np.searchsorted(time, time + HELD * np.sqrt(size) - 1e-9)
    for first in np.flatnonzero(after < len(time)):
        here = com[first : after[first] + 1]
        if np.ptp(here, axis=0).max() < SPOT * size:
            held[first : after[first] + 1] = True
    return held


def runs(mask: np.ndarray, cut: Sequence[int] = ()) -> list[tuple[int, int]]:
    """(first, after) of every run of samples in a mask (T,); one ends before a cut, where a new piece begins."""
    found = list[tuple[int, int]]()
    for start, end in zip([0, *cut], [*cut, len(mask)]):
        edge = start + np.flatnonzero(np.diff(np.concatenate([[0], mask[start:end].astype("i1"), [0]])))
        found += zip(edge[::2].tolist(), edge[1::2].tolist())
    return found


def votes(mask: np.ndarray, time: np.ndarray, size: float = 1.0, cut: Sequence[int] = ()) -> np.ndarray:
    """Weights (T,) [s] of the samples in a mask (T,): every run of them sums to its length, to VOTE at most."""
    weight = np.zeros(len(mask))
    if len(time) < 2:
        return mask * 1.0
    step = (time[-1] - time[0]) / (len(time) - 1)
    for first, after in runs(mask, cut):
        weight[first:after] = min(step, VOTE * np.sqrt(size) / (after - first))
    return weight


def thinned(mask: np.ndarray, time: np.ndarray, size: float = 1.0) -> np.ndarray:
    """The mask (T,) with VOTE of every stay in it, spread over its length: samples that count the same."""
    max_samples = max(2, round(VOTE * np.sqrt(size) * (len(time) - 1) / max(time[-1] - time[0], 1e-9)))
    few = np.zeros(len(mask), bool)
    for first, after in runs(mask):
        few[np.linspace(first, after - 1, min(after - first, max_samples)).round().astype(int)] = True
    return few


def median(values: ArrayLike, weight: ArrayLike) -> np.ndarray:
    """The weighted median of values (T, ...) along their first axis."""
    values, weight = np.asarray(values, float), np.asarray(weight, float)
    keep = weight > 0.0
    values, weight = values[keep], weight[keep]
    flat = values.reshape(len(values), -1)
    order = np.argsort(flat, axis=0, kind="stable")
    share = np.cumsum(weight[order], axis=0) / weight.sum()
    row = (share < 0.5 - 1e-9).sum(axis=0)
    column = np.arange(flat.shape[1])
    low = flat[order[row, column], column]
    even = abs(share[row, column] - 0.5) < 1e-9  # half way between two, as ever
    high = flat[order[np.minimum(row + 1, len(flat) - 1), column], column]
    return np.asarray(np.where(even, (low + high) / 2.0, low).reshape(values.shape[1:]))
