"""python -m desire_path study: the papers' experiments made again, on one page."""

from __future__ import annotations

import argparse
import os

from .command_bake import bar
from .errors import DesirePathError
from .loads.plot import sheet
from .needs import Parser
from .study import figure_page
from .study.figures import FIGURES


def _figures(args: argparse.Namespace) -> None:
    names = list(FIGURES) if args.only is None else args.only.split(",")
    for name in names:
        if name not in FIGURES:
            raise DesirePathError(f"There is no figure '{name}': choose of {', '.join(FIGURES)}.")
    sheet(1.0, 1.0)  # before minutes of work
    figures = []
    for done, name in enumerate(names):
        bar(done / len(names), "of the figures")
        figures.append(FIGURES[name]())
    bar(1.0, "of the figures")
    figure_page.write(args.out, figures)
    claims = [claim for figure in figures for claim in figure.claims]
    for claim in claims:
        print(f"{'holds' if claim.holds else 'NOT SEEN':8}  {claim.source}: {claim.states} Here {claim.seen}.")
    print(f"{sum(claim.holds for claim in claims)} of {len(claims)} claims hold")
    print(f"written to    {os.path.abspath(args.out)}")


def add(tasks: argparse._SubParsersAction[Parser]) -> None:
    study = tasks.add_parser("study", help="make the papers' experiments again (needs Matplotlib)")
    kinds = study.add_subparsers(required=True, metavar="figures")
    figures = kinds.add_parser("figures", help="one page of plots, with what the papers state and what was seen")
    figures.add_argument("--out", required=True, help="the folder: figures.png, claims.csv and a table for each figure")
    figures.add_argument("--only", metavar="NAME,..", help=f"some of them: {','.join(FIGURES)}")
    figures.set_defaults(task=_figures)
