"""The line a walker follows over the ground: waypoints become a smooth curve, measured along itself."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np

from ..errors import DesirePathError
from ..files import table

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

ROUNDING = 0.3  # corners are rounded over about this length [m]
STEP = 0.01  # distance of the curve's samples, where the path is not too long [m]
MAX_SAMPLES = 400_000  # samples
FARTHEST = 1e7  # a place may lie from the origin [m]
FADED = 16.0  # a bend is felt so many lean lengths before it and after it
FINE = 32  # samples in a lean length


class Path:
    """A smooth curve through waypoints (n, 2 or 3) [m], straight on beyond both ends.

    length [m]; has_height: the waypoints had a z. Corners are rounded off, ends stay where they are.
    """

    def __init__(self, points: ArrayLike) -> None:
        points = _checked(points)
        legs = np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1)
        points = points[np.r_[True, legs > 1e-6]]
        if len(points) < 2:
            raise DesirePathError("The path has no length: give it at least two places that lie apart.")
        self.has_height = points.shape[1] == 3
        along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1))]
        step = max(STEP, along[-1] / MAX_SAMPLES)
        count = max(int(np.ceil(along[-1] / step)), 8) + 1
        even = np.linspace(0.0, along[-1], count)
        line = np.stack([np.interp(even, along, column) for column in points.T], axis=1)
        line = _smoothed(line, min(0.5 * ROUNDING, 0.1 * along[-1]) / (even[1] - even[0]))
        run = np.diff(line[:, :2], axis=0)
        self.s = np.r_[0.0, np.cumsum(np.linalg.norm(run, axis=1))]
        self.length = float(self.s[-1])
        heading = np.unwrap(np.arctan2(run[:, 1], run[:, 0]))
        self.heading = np.r_[heading[0], 0.5 * (heading[1:] + heading[:-1]), heading[-1]]
        self.line = line
        self.bend = np.gradient(self.heading, self.s)

    def backwards(self) -> Path:
        """The same curve from its end to its start."""
        other = object.__new__(Path)
        other.has_height, other.length = self.has_height, self.length
        other.s = self.length - self.s[::-1]
        other.heading = self.heading[::-1] + np.pi
        other.line, other.bend = self.line[::-1], -self.bend[::-1]
        return other

    def at(self, s: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Places (.., 2) [m] and headings (..) [rad] at lengths s along the curve."""
        s = np.asarray(s, float)
        heading = np.interp(s, self.s, self.heading)
        inside = np.clip(s, 0.0, self.length)
        place = np.stack([np.interp(inside, self.s, self.line[:, c]) for c in (0, 1)], axis=-1)
        beyond = (s - inside)[..., None]
        return place + beyond * np.stack([np.cos(heading), np.sin(heading)], axis=-1), heading

    def height(self, s: np.ndarray) -> np.ndarray:
        """Height of the curve [m]; level beyond its ends."""
        return np.asarray(np.interp(s, self.s, self.line[:, 2]))

    def bend_at(self, s: np.ndarray) -> np.ndarray:
        """Curvature [1/m], positive to the left; straight beyond the ends."""
        return np.asarray(np.interp(s, self.s, self.bend, left=0.0, right=0.0))

    def led(self, s: np.ndarray, lean: float) -> tuple[np.ndarray, np.ndarray]:
        """Places (.., 2) [m] and headings (..) [rad] of a body whose feet go along the curve. MODEL 3.6

        c - lean^2 c'' = p, bounded for any bend: c the body, p the curve; lean: speed sqrt(height / g) [m]. What
        solves it is p weighted by exp(-|u| / lean), so the body leans into a bend before it and after it.
        """
        place, _ = self.at(s)
        step = max(lean / FINE, self.length / MAX_SAMPLES)
        count = int(FADED * lean / step) + 1
        every = np.arange(-count, int(self.length / step) + count + 2) * step
        heading = np.interp(every, self.s, self.heading)
        weight = np.exp(-np.arange(count + 1) * step / lean) if lean > 0.0 else np.eye(1, count + 1)[0]
        both = np.r_[weight[:0:-1], weight]
        ahead = np.r_[weight[:0:-1], 0.0, -weight[1:]] * (0.5 * step)
        inward = [np.interp(s, every, _weighted(run, ahead)) for run in (np.cos(heading), np.sin(heading))]
        return place + np.stack(inward, axis=-1), heading[0] + np.interp(
            s, every, _weighted(heading, both / both.sum())
        )


def _weighted(values: np.ndarray, kernel: np.ndarray) -> np.ndarray:
    """What a kernel makes of values less the first of them, held at both ends."""
    return np.convolve(np.pad(values - values[0], len(kernel) // 2, mode="edge"), kernel, "valid")


def _checked(points: ArrayLike) -> np.ndarray:
    try:
        points = np.array(points, float)
    except (TypeError, ValueError):
        raise DesirePathError("The path is no list of places: give rows of x, y or x, y, z in metres.") from None
    if points.ndim != 2 or points.shape[1] not in (2, 3) or len(points) < 2:
        raise DesirePathError(
            f"The path has the shape {points.shape}: give at least two rows of x, y or x, y, z in metres."
        )
    if not np.isfinite(points).all():
        raise DesirePathError(
            f"Row {int(np.argmin(np.isfinite(points).all(axis=1))) + 1} of the path is not a finite place: mend it."
        )
    far = abs(points).max(axis=1)
    if far.max() > FARTHEST:
        raise DesirePathError(
            f"Row {int(np.argmax(far > FARTHEST)) + 1} of the path lies {far.max():.3g} m away: give "
            f"places within {FARTHEST:g} m."
        )
    return points


def _smoothed(line: np.ndarray, sigma: float) -> np.ndarray:
    """The line under a Gaussian of so many samples; mirrored through its ends, so that they stay."""
    half = min(int(np.ceil(3.0 * sigma)), len(line) - 1)
    if half < 1:
        return line
    weight = np.exp(-0.5 * (np.arange(-half, half + 1) / sigma) ** 2)
    weight /= weight.sum()
    before = 2.0 * line[0] - line[half:0:-1]
    after = 2.0 * line[-1] - line[-2 : -half - 2 : -1]
    long = np.concatenate([before, line, after])
    return np.stack([np.convolve(column, weight, "valid") for column in long.T], axis=1)


def read(file: str | os.PathLike[str]) -> np.ndarray:
    """Waypoints (n, 2 or 3) [m] of a table with the columns x,y or x,y,z."""
    names, rows = table.read(file, ("x", "y"), columns="x,y or x,y,z")
    columns = [names.index(name) for name in ("x", "y", "z") if name in names]
    points = []
    for number, row in enumerate(rows, 2):
        try:
            points.append([float(row[column]) for column in columns])
        except (ValueError, IndexError):
            raise DesirePathError(f"Line {number} of {file} is not a place in numbers: mend it.") from None
    return _checked(points) if points else _checked(np.zeros((0, 2)))
