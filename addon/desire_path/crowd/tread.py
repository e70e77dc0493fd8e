"""Loads of ways on the cells of a ground: where feet may have stood, and how heavy. MODEL 12.6. Experimental."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .covers import LANE

BESIDE = 0.28  # standard deviation of feet beside a path [m]


def tread(ways: Sequence[np.ndarray], weights: Sequence[float], shape: tuple[int, int], cell: float) -> np.ndarray:
    """Passes over a lane LANE wide that ways (n, 2) [m] add to each cell, float64 (ny, nx).

    weights: of each, 1 = a pass of one body. What falls beyond the field is lost.
    """
    ny, nx = shape
    points, loads = [], []
    for walked, weight in zip(ways, weights):
        leg = np.hypot(*np.diff(walked, axis=0).T)
        points.append(0.5 * (walked[1:] + walked[:-1]))
        loads.append(leg * (weight * LANE / cell**2))
    total = np.zeros(ny * nx)
    if not points:
        return total.reshape(shape)
    at, load = np.concatenate(points) / cell - 0.5, np.concatenate(loads)
    low = np.floor(at).astype(np.int64)
    part = at - low
    for di in (0, 1):
        for dj in (0, 1):
            i, j = low[:, 0] + di, low[:, 1] + dj
            share = np.abs(1 - di - part[:, 0]) * np.abs(1 - dj - part[:, 1]) * load
            there = (i >= 0) & (i < nx) & (j >= 0) & (j < ny)
            total += np.bincount((j * nx + i)[there], share[there], ny * nx)
    spread = math.sqrt(max(BESIDE**2 - cell**2 / 6.0, 0.0)) / cell  # the mixing above spreads by the rest
    return _blurred(total.reshape(shape), spread)


def _blurred(field: np.ndarray, sigma: float) -> np.ndarray:
    """A field under a Gaussian of so many cells; beyond the rim there is nothing."""
    half = math.ceil(4.0 * sigma)
    if sigma < 0.15:
        return field
    weight = np.exp(-0.5 * (np.arange(-half, half + 1) / sigma) ** 2)
    weight /= weight.sum()
    for axis in (0, 1):
        wide = np.pad(field, [(half, half) if axis == each else (0, 0) for each in (0, 1)])
        length = field.shape[axis]
        field = np.zeros_like(field)
        for k, part in enumerate(weight.tolist()):
            field += part * (wide[k : k + length] if axis == 0 else wide[:, k : k + length])
    return field
