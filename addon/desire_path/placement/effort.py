"""What walking on giving ground costs, and how much slower one walks at equal effort. SOFT22 3.2, MODEL 4.6

depth of one's own prints --effort: eta--> speed v0 / sqrt(eta) --time_curve--> when each pose would come
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from ..errors import DesirePathError
from ..motion.gait import Gait
from ..motion.tracks import Array
from .settle_feet import PRESSED, Film, Films

FIRM = 1.0  # eta of ground that does not give
SNOW, PER_CM = 1.3, 0.08  # eta = 1.3 + 0.08 z, z [cm], of snow and mud in which feet sink
DEEP = 0.03  # from this depth on; up to it eta rises evenly from that of firm ground [m]
MOST = 4.1  # nobody is slowed more, from 35 cm on
SAND = 2.1  # of loose sand, where no depth says more
BRUSH = (1.2, 1.5)  # of plants that stand in the way, thin and whole
GROUNDS: Mapping[str, float] = MappingProxyType({"firm": FIRM, "sand": SAND})  # eta by name, to be read
CALM = 0.5  # a speed changes over about this long [s]


def effort(depth: ArrayLike, ground: str = "firm", cover: ArrayLike = 0.0) -> np.ndarray:
    """eta, by how much more walking costs than on firm ground, 1 to MOST. SOFT22 3.2

    depth: of prints [m], >= 0; ground: a name in GROUNDS; cover: of brush that is waded, 0 = none to 1
    """
    if ground not in GROUNDS:
        raise DesirePathError(f"Nothing is known of the effort on {ground!r}: name one of {', '.join(GROUNDS)}.")
    deep, thick = np.asarray(depth, float), np.asarray(cover, float)
    if not ((deep >= 0.0) & np.isfinite(deep)).all():
        raise DesirePathError("Prints have a depth that is none: give numbers of 0 and more, in metres.")
    if not ((thick >= 0.0) & (thick <= 1.0)).all():
        raise DesirePathError("Plants have a cover that is none: give numbers from 0 to 1.")
    sunk = SNOW + PER_CM * 100.0 * np.maximum(deep, DEEP)  # SOFT22 3.2
    sunk = np.where(deep < DEEP, FIRM + (sunk - FIRM) * deep / DEEP, sunk)
    waded = np.where(thick > 0.0, BRUSH[0] + (BRUSH[1] - BRUSH[0]) * thick, FIRM)
    return np.asarray(np.minimum(np.maximum(np.maximum(sunk, waded), GROUNDS[ground]), MOST))


def print_depths(gait: Gait, touching: Array, film: Film | Films) -> np.ndarray:
    """How deep the ground is pressed under each limb that touches it (L, T) >= 0 [m]; NaN in the air.

    touching (P, T) as loads have it; film: the frames of a bake
    """
    out = np.full((len(gait.limb_walker), len(gait.time)), np.nan)
    for t in range(len(gait.time)):
        for limb in range(len(out)):
            parts = np.flatnonzero((gait.part_limb == limb) & (touching[:, t] != 0))
            if len(parts):
                change, pressed = film.at(gait.frame(t), np.concatenate([gait.pose[p, t : t + 1, :2] for p in parts]))
                under = pressed > PRESSED
                out[limb, t] = float(np.maximum(-change[under], 0.0).max()) if under.any() else 0.0
    return out


def depth_of(gait: Gait, depths: np.ndarray, walker: int = 0) -> np.ndarray:
    """How deep a walker wades (T,) [m]: the mean of its feet that stand, in the air that of those before and after."""
    own = depths[gait.limb_walker == walker]
    stands = np.isfinite(own)
    count = stands.sum(axis=0)
    mean = np.where(stands, own, 0.0).sum(axis=0) / np.maximum(count, 1)
    known = np.flatnonzero(count)
    return np.interp(np.arange(len(count)), known, mean[known]) if len(known) else np.zeros(len(count))


def time_curve(time: ArrayLike, eta: ArrayLike) -> np.ndarray:
    """When each sample would come at equal effort (T,) [s]: speeds are v0 / sqrt(eta), eased over CALM. SOFT22 3.2

    time: of samples, rising (T,) [s]; eta: of effort(), at each (T,)
    Poses stay as they are: only when they come changes. It begins with the recording, and is it where eta is 1.
    """
    when, cost = np.asarray(time, float), np.asarray(eta, float)
    if when.ndim != 1 or not len(when) or cost.shape != when.shape or not (np.diff(when) > 0.0).all():
        raise DesirePathError("A time curve needs times that rise, and an effort at each: give two rows as long.")
    if not ((cost >= 1.0) & np.isfinite(cost)).all():
        raise DesirePathError("An effort is below that on firm ground: give numbers from 1 on.")
    slow = np.sqrt(cost)  # dt' / dt = v0 / v
    calm = np.empty_like(slow)
    for k, now in enumerate(when):
        a, b = np.searchsorted(when, (now - CALM, now + CALM))
        weight = 1.0 - np.abs(when[a:b] - now) / CALM
        calm[k] = weight @ slow[a:b] / weight.sum()
    return np.concatenate([when[:1], when[0] + np.cumsum(0.5 * (calm[1:] + calm[:-1]) * np.diff(when))])
