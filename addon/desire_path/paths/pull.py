"""What pulls walkers aside: ground that is worn, as far as they see it. MODEL 12.4. Experimental: names may change."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..errors import DesirePathError
from .arrival import check_cell, field

SIGHT = 2.0  # sigma, how far wear is seen [m]
STRENGTH = 0.5  # l, how far it pulls, against 1 for the direction [-]
MIN_GRADIENT = 0.05  # g0, gradients below it pull less [m]
MAX_SIGHTS = 8.0  # sights beyond which nothing is seen


def seen(wear: Any, cell: float, sight: float = SIGHT) -> np.ndarray:
    """How much wear is seen around each cell: V = wear * exp(-r / sigma), beyond the field there is none. MODEL 12.4

    wear: 0 = untouched, 1 = bare (ny, nx); cell, sight: [m]
    Returns float64 (ny, nx) [m^2].
    """
    worn = field(wear, "Numbers of wear")
    cell = check_cell(cell)
    if not ((worn >= 0.0) & (worn <= 1.0)).all():
        j, i = np.argwhere(~((worn >= 0.0) & (worn <= 1.0)))[0]
        raise DesirePathError(f"The wear of cell ({i}, {j}) is {worn[j, i]:g}: give a number from 0 to 1.")
    if not 0.1 * cell <= sight <= 1e4 * cell:
        raise DesirePathError(f"A sight of {sight:g} m does not fit cells of {cell:g} m: give a tenth to 10,000 cells.")
    ny, nx = worn.shape
    far = math.ceil(MAX_SIGHTS * sight / cell)
    rows, columns = min(far, ny - 1), min(far, nx - 1)  # nothing lies farther apart than the field is large
    across = np.hypot(*np.meshgrid(np.arange(-columns, columns + 1), np.arange(-rows, rows + 1))) * cell
    kernel = np.where(across <= MAX_SIGHTS * sight, np.exp(-across / sight), 0.0) * cell**2  # MODEL 12.4
    shape = (ny + 2 * rows, nx + 2 * columns)
    spectrum = np.fft.rfft2(worn.astype(np.float64), shape) * np.fft.rfft2(kernel, shape)
    return np.fft.irfft2(spectrum, shape)[rows : rows + ny, columns : columns + nx]


def pull(
    wear: Any, cell: float, strength: float = STRENGTH, sight: float = SIGHT, least: float = MIN_GRADIENT
) -> np.ndarray:
    """Where worn ground pulls: l grad V / max(|grad V|, g0). MODEL 12.4

    wear: 0 = untouched, 1 = bare (ny, nx); cell: [m]
    strength: l, 0 to below 1; sight: sigma [m]; least: g0, > 0 [m]
    Returns float32 (ny, nx, 2), x and y, no longer than `strength` anywhere.
    """
    if not 0.0 <= strength < 1.0:
        raise DesirePathError(f"A pull cannot be {strength:g} strong: give a number from 0 to below 1.")
    if not 0.0 < least < math.inf:
        raise DesirePathError(f"The least gradient cannot be {least:g} m: give a number above 0.")
    view = seen(wear, cell, sight)
    rise = np.zeros((*view.shape, 2))
    for axis, k in ((1, 0), (0, 1)):
        if view.shape[axis] > 1:
            rise[..., k] = np.gradient(view, cell, axis=axis)
    return (strength * rise / np.maximum(np.hypot(rise[..., 0], rise[..., 1]), least)[..., None]).astype(np.float32)
