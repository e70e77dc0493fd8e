"""python -m desire_path: bake a recording, a track or a crowd, on a farm too, list or draw forces, without Blender."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence

from . import command_bake, command_crowd, command_export, command_farm, command_study, command_track
from .bounds import check_reserve
from .command_bake import SAMPLES, SET_HELP, SOIL_HELP, bar, read_ground, read_kind, walk
from .errors import DesirePathError
from .files import atomic_file
from .ground.plants import KINDS
from .ground.sim import LOAD_MODELS, Simulation
from .ground.soil import as_soil
from .loads import plot, walker
from .loads.force import FootForce
from .loads.report import sentences, summary, write_contacts
from .motion.gait import Gait
from .needs import Need, Parser, settled
from .study import calibrate, trampling
from .version import VERSION

TASKS = ("bake", "track", "crowd", "loads", "plot", "lane", "fit", "study", "export")
IMPULSE = Need(lambda args: args.model == "impulse", "is that of the model impulse: add --model impulse")


def _counts(text: str) -> list[int]:
    try:
        return [int(word) for word in text.split(",")]
    except ValueError:
        raise DesirePathError(f"'{text}' are no counts of passes: write whole numbers with commas.") from None


def _pressed(args: argparse.Namespace) -> tuple[Gait, FootForce]:
    """The walk and its loads, as they are asked for."""
    gait, more = walk(args.walk), {}
    if args.settle_time is not None:
        more["settle_time"] = args.settle_time
    if args.ground is not None:
        more["ground"] = Simulation(read_ground(args.ground, args.spacing)).rest_height
    return gait, walker.loads(gait, args.model, **more)


def _loads(args: argparse.Namespace) -> None:
    gait, loads = _pressed(args)
    walker.write_loads(args.out, gait, loads)
    if args.contacts:
        write_contacts(args.contacts, gait, loads)
    for each in summary(gait, loads):
        print(f"{each['walker']:13} {'; '.join(sentences(each))}")
    for warning in loads.warnings:
        print(f"warning       {warning}")
    print(f"written to    {os.path.abspath(args.out)}")


def _plot(args: argparse.Namespace) -> None:
    gait, loads = _pressed(args)
    plot.write(args.out, gait, loads)
    for warning in loads.warnings:
        print(f"warning       {warning}")
    print(f"written to    {os.path.abspath(args.out)}")


def _lane(args: argparse.Namespace) -> None:
    rows = trampling.measure(
        read_kind(args.kind),
        lane=trampling.Lane(
            length=args.length,
            width=args.width,
            mass=args.mass,
            seed=args.seed,
            soil=as_soil(args.soil).changed(args.soil_set),
            cell_size=args.cell,
        ),
        passes=_counts(args.passes),
        rest_days=args.rest_days,
        threads=args.threads,
        progress=lambda done: bar(done, "of the passes"),
    )
    for count, cover in rows:
        print(f"{count:5} passes  {cover:5.1f} % cover")
    trampling.write(args.out, rows)
    print(f"written to    {os.path.abspath(args.out)}")


def _fit(args: argparse.Namespace) -> None:
    found = calibrate.fit(
        trampling.read(args.cover),
        read_kind(args.kind),
        lane=trampling.Lane(length=args.length, width=args.width, mass=args.mass),
        progress=lambda done: bar(done, "of the lanes, at most"),
    )
    for count, wanted, reached in zip(found.passes, found.wanted, found.reached):
        print(f"{count:5} passes  {wanted:5.1f} % wanted  {reached:5.1f} % reached")
    print(f"fit           {found.rms:.1f} points off on average (rms), {found.worst:.1f} at worst")
    print(f"strength      {found.kind.strength:.4g}")
    print(f"spread        {found.kind.spread:.4g}")
    found.kind.save(args.out)
    print(f"written to    {os.path.abspath(args.out)}")


def _load_options(task: Parser) -> None:
    task.option(
        "--settle-time",
        IMPULSE,
        type=float,
        metavar="T",
        help="tau of the model impulse, in which the soil yields [s] (0.2)",
    )
    task.add_argument(
        "--ground", help="what is walked on: flat, flat:HEIGHT, or an EXR of heights (where the feet rest)"
    )
    task.option("--spacing", SAMPLES, type=float, help="distance of the EXR's samples [m], if its header does not say")


def _parser() -> Parser:
    parser = Parser(prog="python -m desire_path", description=__doc__)
    parser.add_argument("--version", action="version", version=VERSION)
    tasks = parser.add_subparsers(
        required=True, metavar="bake | track | crowd | farm | loads | plot | lane | fit | study | export"
    )
    for add in (
        command_bake.add,
        command_track.add,
        command_crowd.add,
        command_farm.add,
        _add_loads,
        _add_plot,
        _add_lane,
        _add_fit,
        command_study.add,
        command_export.add,
    ):
        add(tasks)
    return parser


def _add_loads(tasks: argparse._SubParsersAction[Parser]) -> None:
    loads = tasks.add_parser("loads", help="write the forces of every part as a table")
    loads.add_argument("walk", help="a recording (.npz)")
    loads.add_argument("--model", choices=LOAD_MODELS, default="inertia", help="how forces are computed")
    loads.add_argument("--out", required=True, help="the table (.csv)")
    loads.add_argument("--contacts", help="another table: when, where and how hard each foot stood (.csv)")
    _load_options(loads)
    loads.set_defaults(task=_loads)


def _add_plot(tasks: argparse._SubParsersAction[Parser]) -> None:
    graph = tasks.add_parser("plot", help="draw the vertical force of every foot (needs Matplotlib)")
    graph.add_argument("walk", help="a recording (.npz)")
    graph.add_argument("--model", choices=LOAD_MODELS, default="inertia", help="how forces are computed")
    graph.add_argument("--out", required=True, help=f"the picture ({', '.join(plot.KINDS)})")
    _load_options(graph)
    graph.set_defaults(task=_plot)


def _add_lane(tasks: argparse._SubParsersAction[Parser]) -> None:
    tread = tasks.add_parser("lane", help="measure the cover that is left of a planted lane after so many passes")
    tread.add_argument("--kind", default="carex", help=f"{', '.join(KINDS)}, or a kind's file (.json)")
    tread.add_argument("--length", type=float, default=5.0, help="of the lane [m] (5)")
    tread.add_argument("--width", type=float, default=0.5, help="of the lane [m] (0.5)")
    tread.add_argument(
        "--passes", default=",".join(map(str, trampling.PASSES)), help="counts to measure at (25,75,200,500)"
    )
    tread.add_argument("--mass", type=float, default=75.0, help="of who walks [kg] (75)")
    tread.add_argument("--seed", type=int, default=0, help="of the plants and the walkers' scatter (0)")
    tread.add_argument("--rest-days", type=float, default=0.0, help="days of growth before every count (0)")
    tread.add_argument("--soil", default="soil", help=SOIL_HELP)
    tread.add_argument("--soil-set", action="append", default=[], metavar="NAME=VALUE", help=SET_HELP)
    tread.add_argument("--cell", type=float, default=0.02, help="side of a cell [m] (0.02)")
    tread.add_argument("--threads", type=int, default=0, help="0 = all; the result does not depend on it")
    tread.add_argument("--out", required=True, help="the table passes,cover (.csv)")
    tread.set_defaults(task=_lane)


def _add_fit(tasks: argparse._SubParsersAction[Parser]) -> None:
    kinds = tasks.add_parser("fit", help="find the kind of plant that wears as a table of cover says (needs SciPy)")
    kinds.add_argument("cover", help="a table with the columns passes,cover [per cent] and, if it likes, days of rest")
    kinds.add_argument("--kind", default="carex", help="a kind that looks like it: a name or a file (.json)")
    kinds.add_argument("--length", type=float, default=5.0, help="of the lane [m] (5)")
    kinds.add_argument("--width", type=float, default=0.5, help="of the lane [m] (0.5)")
    kinds.add_argument("--mass", type=float, default=75.0, help="of who walked [kg] (75)")
    kinds.add_argument("--out", required=True, help="the kind (.json)")
    kinds.set_defaults(task=_fit)


FILES = (_loads, _plot, _lane, _fit)  # tasks that write one file; the others fill a folder


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; 0 when it worked, 1 with one sentence on stderr when it did not."""
    try:
        args = _parser().parse_args(arguments)
        settled(args)
        check_reserve()
        for path in (args.out, getattr(args, "contacts", None)):
            if path is not None and args.task in FILES:
                atomic_file.check(path, "The result")  # before minutes of work
        args.task(args)
    except DesirePathError as problem:
        print(problem, file=sys.stderr)
        return 1
    except MemoryError:
        print("There is not enough memory: choose a larger cell size, fewer frames or a shorter walk.", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("Stopped; what was baked so far is kept, and the same command goes on from there.", file=sys.stderr)
        return 130
    return 0
