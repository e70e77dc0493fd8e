"""A picture of the forces: how hard each foot presses over time, against the weight of the body.

Needs Matplotlib, which nothing else here does: pip install desire-path[plot].
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np

from .. import lazy
from ..errors import DesirePathError
from ..files import atomic_file
from ..motion.gait import Gait
from .force import FootForce
from .walker import GRAVITY

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_figure = lazy.module("matplotlib.figure")  # a machine may lack it

KINDS = (".png", ".pdf", ".svg")
COLOURS = ("#1f6fb4", "#c4501b", "#2f8f4e", "#8a4fb0", "#a8861a", "#4b8f9c")
WIDE, HIGH = 10.0, 3.2  # of one walker's graph [inch]


def foot_loads(gait: Gait, loads: FootForce) -> tuple[np.ndarray, np.ndarray]:
    """For each limb: vertical force on the ground (L, T) [body weights], whether it touches (L, T)."""
    limbs = len(gait.limb_walker)
    force = np.zeros((limbs, len(loads.time)))
    touching = np.zeros(force.shape, bool)
    for part, limb in enumerate(gait.part_limb):
        force[limb] -= loads.force[part, :, 2]
        touching[limb] |= loads.touching[part] != 0
    return force / (gait.mass[gait.limb_walker] * GRAVITY)[:, None], touching


def spans(touching: np.ndarray, time: np.ndarray) -> list[tuple[float, float]]:
    """(start, end) [s] of each contact of one limb; half a sample is added on either side."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], touching.astype("i1"), [0]])))
    half = 0.5 * float(np.median(np.diff(time))) if len(time) > 1 else 0.0
    return [(float(time[first]) - half, float(time[last - 1]) + half) for first, last in zip(edges[::2], edges[1::2])]


def sheet(wide: float, high: float) -> Figure:
    """An empty Matplotlib figure [inch], or the sentence that says how to get Matplotlib."""
    try:
        return lazy.load(_figure).Figure(figsize=(wide, high), layout="constrained")
    except ImportError:
        raise DesirePathError(
            "Drawing needs Matplotlib, which is not here: install it with "
            "pip install desire-path[plot], or pip install matplotlib."
        ) from None


def figure(gait: Gait, loads: FootForce) -> Figure:
    """A Matplotlib figure: a graph for each walker, a line for each foot, its contacts shaded."""
    force, touching = foot_loads(gait, loads)
    walkers = len(gait.mass)
    drawn = sheet(WIDE, 0.6 + HIGH * walkers)
    graphs = drawn.subplots(walkers, 1, sharex=True, squeeze=False)[:, 0]
    for w, graph in enumerate(graphs):
        limbs = np.flatnonzero(gait.limb_walker == w)
        for k, limb in enumerate(limbs):
            colour = COLOURS[k % len(COLOURS)]
            graph.plot(loads.time, force[limb], color=colour, label=gait.limb_name[limb])
            for start, end in spans(touching[limb], loads.time):
                graph.axvspan(start, end, color=colour, alpha=0.12, linewidth=0)
        if len(limbs) > 1:
            graph.plot(loads.time, force[limbs].sum(axis=0), color="0.45", linewidth=0.8, label="all feet")
        graph.axhline(1.0, color="black", linewidth=0.9, linestyle="--", label="body weight")
        graph.set_ylim(bottom=min(0.0, float(force[limbs].min(initial=0.0))))
        graph.set_ylabel("vertical force [body weights]")
        graph.set_title(f"{gait.walker_name[w]}, {gait.mass[w]:.3g} kg", loc="left")
        graph.legend(
            loc="lower right", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize="small", ncols=len(limbs) + 2
        )
    if len(loads.time) > 1:
        graphs[-1].set_xlim(float(loads.time[0]), float(loads.time[-1]))
    graphs[-1].set_xlabel("time [s]")
    return drawn


def write(path: str | os.PathLike[str], gait: Gait, loads: FootForce) -> None:
    """Draw the forces to a file (.png, .pdf or .svg), whole or not at all."""
    path = os.fspath(path)
    kind = os.path.splitext(path)[1].lower()
    if kind not in KINDS:
        raise DesirePathError(
            f"{path} is no picture this can draw: let its name end in " + ", ".join(KINDS[:-1]) + f" or {KINDS[-1]}."
        )
    drawn = figure(gait, loads)
    with atomic_file.file(path, "The picture") as stream:
        drawn.savefig(stream, format=kind[1:], dpi=120)
