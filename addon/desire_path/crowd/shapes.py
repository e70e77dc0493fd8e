"""Shapes that lie on a crowd's ground, obstacles and paved ways, as cells. Experimental."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..errors import DesirePathError

HOW = (
    'write {"box": [x0, y0, x1, y1]}, {"circle": [x, y, r]}, {"ellipse": [x, y, a, b, degrees]} or '
    '{"polygon": [[x, y], ..]} in metres'
)
NUMBERS = {"box": 4, "circle": 3, "ellipse": 5}
MAX_CORNERS = 10_000


def _wrong(shape: Any, what: str) -> DesirePathError:
    return DesirePathError(f"{what} cannot be {str(shape)[:60]}: {HOW}.")


def inside(shape: Any, x: np.ndarray, y: np.ndarray, what: str) -> np.ndarray:
    """Which places (ny, nx) lie in a shape as scenes write it; what: "An obstacle", for the sentence if it is none."""
    if not isinstance(shape, dict) or len(shape) != 1:
        raise _wrong(shape, what)
    ((kind, numbers),) = shape.items()
    try:
        found = np.array(numbers, float)
    except (TypeError, ValueError):
        raise _wrong(shape, what) from None
    if not np.isfinite(found).all():
        raise _wrong(shape, what)
    if kind == "polygon" and found.ndim == 2 and found.shape[1] == 2 and 3 <= len(found) <= MAX_CORNERS:
        return _polygon(found, x, y)
    if found.shape != (NUMBERS.get(kind, -1),):
        raise _wrong(shape, what)
    if kind == "box":
        x0, y0, x1, y1 = found
        return np.asarray((x >= x0) & (x < x1) & (y >= y0) & (y < y1))
    a, b, turn = (found[2], found[2], 0.0) if kind == "circle" else (found[2], found[3], math.radians(found[4]))
    if not (a > 0.0 and b > 0.0):
        raise _wrong(shape, what)
    c, s = math.cos(turn), math.sin(turn)
    u, v = (x - found[0]) * c + (y - found[1]) * s, -(x - found[0]) * s + (y - found[1]) * c
    return np.asarray((u / a) ** 2 + (v / b) ** 2 < 1.0)


def _polygon(corners: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Even and odd crossings of a ray along x, edge by edge."""
    within = np.zeros(x.shape, bool)
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0)):
        if y0 == y1:
            continue
        between = (y >= min(y0, y1)) & (y < max(y0, y1))
        within ^= between & (x < x0 + (y - y0) * (x1 - x0) / (y1 - y0))
    return within


def mask(shapes: Sequence[Any], x: np.ndarray, y: np.ndarray, what: str) -> np.ndarray:
    """Which places lie in any of the shapes."""
    if not isinstance(shapes, (list, tuple)):
        raise DesirePathError(f"{what} stands in a list: {HOW}.")
    found = np.zeros(np.broadcast_shapes(x.shape, y.shape), bool)
    for shape in shapes:
        found |= inside(shape, np.broadcast_to(x, found.shape), np.broadcast_to(y, found.shape), what)
    return found
