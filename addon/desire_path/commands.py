"""python -m desire_path: bake a recording, list or draw its forces, wear a lane, on a machine without Blender."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from typing import Any

from .bake.bake import Bake
from .bake.options import FILMS, BakeOptions, BakeOutput
from .bake.output import check_idle
from .bounds import ADVICE, Limits
from .errors import DesirePathError
from .files import atomic_file
from .ground.options import CONTACT_LAWS, HEAPS, SimulationOptions
from .ground.plants import KINDS, Kind, Planting
from .ground.sim import LOAD_MODELS, Ground, Simulation
from .ground.soil import SOILS, as_soil
from .ground.soil_keys import AnySoil, SoilKeys
from .loads import plot, walker
from .loads.force import FootForce
from .loads.report import sentences, summary, write_contacts
from .motion import jumps
from .motion.gait import Gait
from .motion.scatter import Scatter
from .needs import Need, Parser, settled
from .placement import path as paths
from .placement.place import place_feet
from .study import calibrate, trampling
from .version import VERSION

SOIL_HELP = f"one of {', '.join(SOILS)}, or a .json file that Soil.save or Save Soil wrote"
KEYS_HELP = 'numbers of that soil that change over time, as {"young_modulus": [[0, 2e6], [5, 4e5]]}: seconds, values'
SET_HELP = "another number for that soil, as young_modulus=2e6, in SI units and radians; repeatable"


def _is_flat(text: str | None) -> bool:
    return text is not None and (text == "flat" or text.startswith("flat:"))


ALONG = Need(lambda args: args.along is not None, "needs a path to walk on: add --along PATH.csv with the columns x,y")
PASSES = Need(
    lambda args: args.along is not None and args.passes != 1,
    "tells how passes differ: add --along PATH.csv with the columns x,y and --passes 2 or more",
)
CHANCE = Need(
    lambda args: bool(args.plants) or args.along is not None,
    "is of scattered passes and plants: add --along or --plants",
)
PAPER = Need(lambda args: args.heap == "paper", "is that of a paper heap: add --heap paper")
IMPULSE = Need(lambda args: args.model == "impulse", "is that of the model impulse: add --model impulse")
SAMPLES = Need(
    lambda args: args.ground is not None and not _is_flat(args.ground),
    "is that of an EXR's samples: add --ground HILL.exr",
)


def _ground(text: str, spacing: float | None) -> Ground:
    """Ground from the command line: "flat", "flat:0.3", or an EXR of heights or of a bake's maps."""
    if _is_flat(text):
        try:
            return Ground.flat(float(text[5:]) if text != "flat" else 0.0)
        except ValueError:
            raise DesirePathError(f"'{text}' is no ground: write flat or flat:HEIGHT in metres.") from None
    return Ground.read(text, spacing)


def _cells(args: argparse.Namespace, ground: Ground) -> tuple[float, tuple[float, float]]:
    """Side and origin of the cells: as they are told, else those of the trail that goes on, else 1 cm from (0, 0)."""
    left = ground.trail
    cell = args.cell if args.cell is not None else left.cell if left else 0.01
    return cell, args.origin or ((left.x0, left.y0) if left else (0.0, 0.0))


def _kind(text: str) -> str | Kind:
    """A kind's name, or a file that Kind.save or the fit wrote."""
    return Kind.load(text) if text.endswith(".json") else text


def _soil(args: argparse.Namespace) -> AnySoil:
    """The soil of the command line, with its keys."""
    soil = as_soil(args.soil).changed(args.soil_set)
    return SoilKeys.load(args.soil_keys, soil) if args.soil_keys else soil


def _walk(path: str) -> Gait:
    return jumps.found(Gait.load(path))


def _planting(text: str, seed: int) -> Planting:
    """A planting from the command line: KIND or KIND:DENSITY."""
    name, colon, density = text.partition(":")
    try:
        return Planting(_kind(name), float(density) if colon else None, seed=seed)
    except ValueError as problem:
        if isinstance(problem, DesirePathError):
            raise
        raise DesirePathError(f"'{text}' cannot be planted: write KIND or KIND:PLANTS for each m^2.") from None


def _counts(text: str) -> list[int]:
    try:
        return [int(word) for word in text.split(",")]
    except ValueError:
        raise DesirePathError(f"'{text}' are no counts of passes: write whole numbers with commas.") from None


def _along(args: argparse.Namespace, gait: Gait, ground: Ground) -> Gait:
    """The walk carried along a path over this ground, if it is to be."""
    if not args.along:
        return place_feet(gait, ground) if args.place_feet else gait
    cell, origin = _cells(args, ground)
    below = Simulation(ground, as_soil(args.soil), cell, options=SimulationOptions(origin=origin))
    return gait.along(
        paths.read(args.along)[:, :2],
        args.passes,
        back_and_forth=not args.one_way,
        scatter=Scatter(args.lateral, args.timing, args.stride),
        seed=args.seed,
        pause=args.pause,
        ground=below,
    )


def _bar(fraction: float, what: str) -> None:
    if sys.stderr.isatty():
        full = int(40 * fraction)
        line = f"\r[{'#' * full}{'.' * (40 - full)}] {what}"
        print(line, end="" if fraction < 1 else "\n", file=sys.stderr, flush=True)


def _bake(args: argparse.Namespace) -> None:
    limits = Limits.read(args.limit)
    gait, ground = _walk(args.walk), _ground(args.ground, args.spacing)
    plants = [_planting(text, args.seed) for text in args.plants]
    cell, origin = _cells(args, ground)
    bake = Bake(
        _along(args, gait, ground),
        ground,
        _soil(args),
        args.out,
        cell_size=cell,
        plants=plants,
        options=BakeOptions(
            law=args.law,
            heap=args.heap,
            rim_width=args.rim_width,
            origin=origin,
            threads=args.threads,
            limits=limits,
            load_model=args.model,
        ),
        output=BakeOutput(frame_start=args.frame_start, frame_end=args.frame_end, film=args.film),
    )
    try:
        check_idle(args.out)
    except DesirePathError as problem:
        print(f"{problem}\nWaiting for up to {bake.wait:g} s.", file=sys.stderr)
    for warning in bake.warnings:
        print(f"warning       {warning}", flush=True)
    word = "pass" if bake.film == "passes" else "frame"
    for progress in bake.run():
        _bar(progress.fraction, f"{word} {progress.frame}")
    report: dict[str, Any] = bake.report or {}
    print(f"contacts      {report['contacts']}")
    print(f"deepest       {1000 * report['deepest_m']:.1f} mm")
    print(
        f"pressed       {1000 * report['pressed_m3']:.3f} l of firm ground, "
        f"{1000 * report['pressed_heap_m3']:.3f} l of loose heaps"
    )
    print(f"heaped        {1000 * report['heaped_m3']:.3f} l")
    print(f"seconds       {report['seconds']:.2f}")
    for warning in report["warnings"]:
        if warning not in bake.warnings:
            print(f"warning       {warning}")
    print(f"written to    {os.path.abspath(args.out)}")


def _pressed(args: argparse.Namespace) -> tuple[Gait, FootForce]:
    """The walk and its loads, as they are asked for."""
    gait, more = _walk(args.walk), {}
    if args.settle_time is not None:
        more["settle_time"] = args.settle_time
    if args.ground is not None:
        more["ground"] = Simulation(_ground(args.ground, args.spacing)).rest_height
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
        _kind(args.kind),
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
        progress=lambda done: _bar(done, "of the passes"),
    )
    for count, cover in rows:
        print(f"{count:5} passes  {cover:5.1f} % cover")
    trampling.write(args.out, rows)
    print(f"written to    {os.path.abspath(args.out)}")


def _fit(args: argparse.Namespace) -> None:
    found = calibrate.fit(
        trampling.read(args.cover),
        _kind(args.kind),
        lane=trampling.Lane(length=args.length, width=args.width, mass=args.mass),
        progress=lambda done: _bar(done, "of the lanes, at most"),
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
    tasks = parser.add_subparsers(required=True, metavar="bake | loads | plot | lane | fit")
    for add in (_add_bake, _add_loads, _add_plot, _add_lane, _add_fit):
        add(tasks)
    return parser


def _add_bake(tasks: argparse._SubParsersAction[Parser]) -> None:
    bake = tasks.add_parser("bake", help="press a recorded walk into ground and write EXR files")
    bake.add_argument("walk", help="a recording (.npz), from object.desire_path_record or Gait.save")
    bake.add_argument(
        "--ground",
        default="flat",
        help="flat, flat:HEIGHT, an EXR of heights [m] (channel height, Z, "
        "V or Y), or a bake's maps_final.exr: its trail goes on",
    )
    bake.option("--spacing", SAMPLES, type=float, help="distance of the EXR's samples [m], if it does not say")
    bake.add_argument("--soil", default="dry-sand", help=SOIL_HELP)
    bake.add_argument("--soil-set", action="append", default=[], metavar="NAME=VALUE", help=SET_HELP)
    bake.add_argument("--soil-keys", metavar="KEYS.json", help=KEYS_HELP)
    bake.add_argument("--cell", type=float, help="side of a cell [m] (0.01, or that of the trail that goes on)")
    bake.add_argument(
        "--origin",
        type=float,
        nargs=2,
        metavar=("X", "Y"),
        help="where cells begin [m] (0 0, or as in "
        "the trail that goes on); a report.json says where another bake's did",
    )
    bake.add_argument("--out", required=True, help="folder for the files")
    _path_options(bake)
    bake.add_argument(
        "--film",
        choices=FILMS,
        help="a playback frame for every scene frame, or for every pass; passes, if there are several",
    )
    bake.add_argument(
        "--plants",
        nargs="+",
        action="extend",
        default=[],
        metavar="KIND[:DENSITY]",
        help=f"what grows here: {', '.join(KINDS)}, or a kind's file (.json); plants for each m^2",
    )
    bake.add_argument("--frame-start", type=int, help="first scene frame (the recording's)")
    bake.add_argument("--frame-end", type=int, help="last scene frame (the recording's)")
    bake.add_argument("--model", choices=LOAD_MODELS, default="inertia", help="how forces are computed")
    bake.add_argument(
        "--law",
        choices=CONTACT_LAWS,
        default="sole",
        help="how walkers press that do not say it themselves: carve = down to where they are, whatever they weigh",
    )
    bake.add_argument("--heap", choices=HEAPS, default="rest", help="how displaced soil is laid")
    bake.option(
        "--rim-width", PAPER, type=float, default=0.04, metavar="METRES", help="how wide the rim of a paper heap is"
    )
    bake.add_argument("--threads", type=int, default=0, help="0 = all; the result does not depend on it")
    bake.add_argument(
        "--limit",
        nargs="+",
        action="extend",
        default=[],
        metavar="NAME=NUMBER",
        help=f"how much a bake may take before it is refused: {', '.join(ADVICE)} (GB of memory and disk)",
    )
    bake.set_defaults(task=_bake)


def _path_options(bake: Parser) -> None:
    bake.add_argument(
        "--place-feet",
        action="store_true",
        help="turn the feet to the ground's slope first; a walk of a level floor is carried there. Along a path this "
        "is always done",
    )
    bake.add_argument("--along", metavar="PATH.csv", help="carry the walk along this path: columns x,y [m]")
    bake.option("--passes", ALONG, type=int, default=1, help="how often it goes along the path (1)")
    bake.option(
        "--one-way", PASSES, default=False, action="store_true", help="every pass from the start, not there and back"
    )
    bake.option("--lateral", PASSES, type=float, default=0.1, help="how far passes scatter to the side [m] (0.1)")
    bake.option("--timing", PASSES, type=float, default=0.05, help="by how much their pace differs, a share (0.05)")
    bake.option("--stride", PASSES, type=float, default=0.05, help="by how much their strides differ, a share (0.05)")
    bake.option("--pause", ALONG, type=float, default=0.0, help="time between passes [s] (0)")
    bake.option("--seed", CHANCE, type=int, default=0, help="of the scatter and the plants (0)")


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


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; 0 when it worked, 1 with one sentence on stderr when it did not."""
    try:
        args = _parser().parse_args(arguments)
        settled(args)
        for path in (args.out, getattr(args, "contacts", None)):
            if path is not None and args.task is not _bake:
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
