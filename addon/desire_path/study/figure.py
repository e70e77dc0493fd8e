"""What an experiment gives: curves to be drawn, and the papers' sentences with what was measured."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Record


@dataclass(frozen=True, eq=False, repr=False)
class Curve(Record):
    """A line of a figure: a value y at each x, both (n,), in the units of its axes."""

    label: str
    x: np.ndarray
    y: np.ndarray
    points: bool = False  # drawn as marks, not as a line


@dataclass(frozen=True)
class Claim:
    """A sentence of a paper, and what was measured here."""

    source: str  # where the paper says it
    states: str
    seen: str
    holds: bool


@dataclass(frozen=True)
class Figure:
    """One experiment: its curves and what they show."""

    name: str
    title: str
    x: str  # label of the axis, with its unit
    y: str
    curves: tuple[Curve, ...]
    claims: tuple[Claim, ...]
    ticks: tuple[str, ...] = ()  # names along x in place of 0, 1, 2 ...
