"""Treads of built-in soles: how far what lies between their lugs stands back. Ours, for looks.

A sole's outline, its length --which tread--> grooves, so many millimetres deep, by where they are
"""

from __future__ import annotations

import numpy as np

from ..errors import DesirePathError

TREADS = ("plain", "lugs", "waves")  # smooth | bars and blocks of a boot | low ridges of a running shoe
STEP = 0.014  # points of a tread lie so far apart, in shares of a sole's length
PITCH = 0.11  # from bar to bar, in shares of it ..
BAR = 0.58  # .. and how much of that is bar
BENT = 0.35  # bars run back so far aside
SLIT = 0.02  # between left and right bars, half of it
FRAME = (0.045, 0.065)  # blocks along the rim end, and bars begin, so far from it
DEEP = 0.016  # how deep lugs are
WAVE = 0.045  # from ridge to ridge of waves, ..
LOW = 0.009  # .. and how deep they are


def check(tread: str) -> str:
    """The name of a tread, if there is such a one."""
    if tread not in TREADS:
        raise DesirePathError(f"There is no tread '{tread}': choose one of {', '.join(TREADS)}.")
    return tread


def grooves(tread: str, along: np.ndarray, aside: np.ndarray, rim: np.ndarray) -> np.ndarray:
    """How far an underside stands back.

    along: from the heel end; aside: from the middle; rim: from the nearest edge; all, and what is returned, in shares
    of the length of the sole. The same left and right of the middle.
    """
    if tread == "waves":
        return np.asarray(0.5 * LOW * (1.0 - np.cos(2.0 * np.pi * (along + 0.5 * BENT * abs(aside)) / WAVE)))
    if tread != "lugs":
        return np.zeros(np.broadcast(along, aside, rim).shape)
    bar = (np.mod(along + BENT * abs(aside), PITCH) < BAR * PITCH) & (abs(aside) > SLIT) & (rim > FRAME[1])
    block = (rim < FRAME[0]) & (np.mod(along, PITCH) < 0.65 * PITCH)
    return np.where(bar | block, 0.0, DEEP)
