"""Figures on one page, and as tables: figures.png, claims.csv and a table for each figure. Needs Matplotlib."""

from __future__ import annotations

import csv
import os
import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import DesirePathError
from ..files import atomic_file
from ..loads.plot import COLOURS, sheet
from .figure import Figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PAGE, CLAIMS = "figures.png", "claims.csv"
ACROSS = 3  # figures beside each other
WIDE, HIGH = 6.2, 4.6  # of one figure with its claims [inch]
LETTERS = 84  # a line of a claim holds


def write(folder: str | os.PathLike[str], figures: Sequence[Figure]) -> None:
    """Write the page and its tables into a folder, which is made; files of the same names are replaced."""
    into = Path(folder)
    try:
        into.mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        raise DesirePathError(
            f"{into} cannot be made a folder ({problem.strerror}): choose another with --out."
        ) from None
    rows = [
        (each.name, claim.source, claim.states, claim.seen, "yes" if claim.holds else "no")
        for each in figures
        for claim in each.claims
    ]
    _table(into / CLAIMS, ["figure", "source", "states", "seen", "holds"], rows)
    for each in figures:
        points = [(curve.label, f"{x:.6g}", f"{y:.6g}") for curve in each.curves for x, y in zip(curve.x, curve.y)]
        _table(into / f"{each.name}.csv", ["curve", each.x, each.y], points)
    page = sheet(WIDE * ACROSS, HIGH * -(-len(figures) // ACROSS))
    places = page.subplots(-(-len(figures) // ACROSS), ACROSS, squeeze=False).ravel()
    for place, each in zip(places, figures):
        _draw(place, each)
    for place in places[len(figures) :]:
        place.axis("off")
    with atomic_file.file(into / PAGE, "The page of figures") as stream:
        page.savefig(stream, format="png", dpi=80)


def _table(path: Path, head: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    with atomic_file.file(path, "The table of a figure", "w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(head)
        table.writerows(rows)


def _draw(place: Axes, figure: Figure) -> None:
    """One figure, what the papers state and what was seen under it."""
    for k, curve in enumerate(figure.curves):
        style = {"marker": "o", "linestyle": "none"} if curve.points else {}
        place.plot(curve.x, curve.y, color=COLOURS[k % len(COLOURS)], label=curve.label, **style)
    if figure.ticks:
        place.set_xticks(range(len(figure.ticks)), figure.ticks)
    place.set_title(figure.title, loc="left", fontsize="medium")
    lines = []
    for claim in figure.claims:
        for text in (f"{claim.source}: {claim.states}", f"{'here' if claim.holds else 'NOT SEEN'}: {claim.seen}"):
            lines += textwrap.wrap(text, LETTERS, subsequent_indent="    ")
    place.set_xlabel("\n".join([figure.x, "", *lines]), loc="left", fontsize="x-small")
    place.set_ylabel(figure.y, fontsize="small")
    place.tick_params(labelsize="small")
    place.legend(frameon=False, fontsize="x-small")
