"""python -m desire_path bake, and what others share with it: grounds, soils, plants, what is told of a bake."""

from __future__ import annotations

import argparse
import os
import sys
from typing import Any

from .bake.bake import Bake
from .bake.options import FILMS, BakeOptions, BakeOutput
from .bake.output import check_idle
from .bounds import ADVICE, Limits
from .errors import DesirePathError
from .ground import layers
from .ground.options import CONTACT_LAWS, HEAPS, SimulationOptions
from .ground.plants import KINDS, Kind, Planting
from .ground.sim import LOAD_MODELS, Ground, Simulation
from .ground.soil import MEASURED, SOILS, as_soil
from .ground.soil_keys import AnySoil, SoilKeys
from .ground.spray import SPRAYS, Spray, as_spray
from .motion import jumps
from .motion.gait import Gait
from .motion.scatter import Scatter
from .needs import Need, Parser
from .placement import path as paths
from .placement.place import place_feet
from .placement.wade import wade

SOIL_HELP = f"one of {', '.join(SOILS)}, {', '.join(MEASURED)}, or a .json file that Soil.save or Save Soil wrote"
KEYS_HELP = 'numbers of that soil that change over time, as {"young_modulus": [[0, 2e6], [5, 4e5]]}: seconds, values'
TRIAL_CELL = 0.02  # how deep feet sink is tried in cells of this side, or those of the bake if they are larger [m]
MEMORY_HELP = "how much memory it may take, as 4G or 800M: what does not fit waits on the disk, in its folder"
SET_HELP = "another number for that soil, as young_modulus=2e6, in SI units and radians; repeatable"


def is_flat(text: str | None) -> bool:
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
SPRAYED = Need(lambda args: args.spray is not None, "is one of a spray: add --spray sand")
PAPER = Need(lambda args: args.heap == "paper", "is that of a paper heap: add --heap paper")
WEIGHT = Need(lambda args: args.law != "carve", "is of walkers whom their weight lets sink: leave out --law carve")
SAMPLES = Need(
    lambda args: args.ground is not None and not is_flat(args.ground),
    "is that of an EXR's samples: add --ground HILL.exr",
)


def read_ground(text: str, spacing: float | None) -> Ground:
    """Ground from the command line: "flat", "flat:0.3", or an EXR of heights or of a bake's maps."""
    if is_flat(text):
        try:
            return Ground.flat(float(text[5:]) if text != "flat" else 0.0)
        except ValueError:
            raise DesirePathError(f"'{text}' is no ground: write flat or flat:HEIGHT in metres.") from None
    return Ground.read(text, spacing)


def cells(args: argparse.Namespace, ground: Ground) -> tuple[float, tuple[float, float]]:
    """Side and origin of the cells: as they are told, else those of the trail that goes on, else 1 cm from (0, 0)."""
    left = ground.trail
    cell = args.cell if args.cell is not None else left.cell if left else 0.01
    return cell, args.origin or ((left.x0, left.y0) if left else (0.0, 0.0))


def read_kind(text: str) -> str | Kind:
    """A kind's name, or a file that Kind.save or the fit wrote."""
    return Kind.load(text) if text.endswith(".json") else text


def read_soil(args: argparse.Namespace) -> AnySoil:
    """The soil of the command line, with its keys."""
    soil = as_soil(args.soil).changed(args.soil_set)
    return SoilKeys.load(args.soil_keys, soil) if args.soil_keys else soil


def read_spray(args: argparse.Namespace) -> Spray | None:
    """What sticks and flies, by the command line."""
    spray = as_spray(args.spray)
    return spray.changed(args.spray_set) if spray else None


def walk(path: str) -> Gait:
    return jumps.found(Gait.load(path))


def _planting(text: str, seed: int) -> Planting:
    """A planting from the command line: KIND or KIND:DENSITY."""
    name, colon, density = text.partition(":")
    try:
        return Planting(read_kind(name), float(density) if colon else None, seed=seed)
    except ValueError as problem:
        if isinstance(problem, DesirePathError):
            raise
        raise DesirePathError(f"'{text}' cannot be planted: write KIND or KIND:PLANTS for each m^2.") from None


def _along(args: argparse.Namespace, gait: Gait, ground: Ground) -> Gait:
    """The walk carried along a path over this ground, if it is to be."""
    if not args.along:
        return place_feet(gait, ground) if args.place_feet else gait
    cell, origin = cells(args, ground)
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


def bar(fraction: float, what: str) -> None:
    if sys.stderr.isatty():
        full = int(40 * fraction)
        line = f"\r[{'#' * full}{'.' * (40 - full)}] {what}"
        print(line, end="" if fraction < 1 else "\n", file=sys.stderr, flush=True)


def walked(args: argparse.Namespace) -> tuple[Gait, Ground]:
    """The walk as it is to be pressed, and the ground."""
    gait, ground = walk(args.walk), read_ground(args.ground, args.spacing).layered(*map(layers.read, args.layer))
    gait = _along(args, gait, ground)
    return _wading(args, gait, ground) if args.wade else gait, ground


def _bake(args: argparse.Namespace) -> None:
    press(args, *walked(args))


def _wading(args: argparse.Namespace, gait: Gait, ground: Ground) -> Gait:
    """The walk through ground as deep as it sinks there, tried in coarse cells."""
    cell, origin = cells(args, ground)
    options = SimulationOptions(
        law=args.law, heap=args.heap, rim_width=args.rim_width, origin=origin, threads=args.threads
    )
    return wade(gait, Simulation(ground, read_soil(args), max(cell, TRIAL_CELL), options=options))


def bake_of(args: argparse.Namespace, gait: Gait, ground: Ground, folder: str) -> Bake:
    """The bake of a motion on a ground as it was asked for."""
    limits = Limits.read(args.limit)
    plants = [_planting(text, args.seed) for text in args.plants]
    cell, origin = cells(args, ground)
    return Bake(
        gait,
        ground,
        read_soil(args),
        folder,
        cell_size=cell,
        plants=plants,
        options=BakeOptions(
            law=args.law,
            heap=args.heap,
            rim_width=args.rim_width,
            origin=origin,
            threads=args.threads,
            limits=limits,
            spray=read_spray(args),
            load_model=args.model,
            memory=args.memory,
        ),
        output=BakeOutput(frame_start=args.frame_start, frame_end=args.frame_end, film=args.film),
    )


def press(args: argparse.Namespace, gait: Gait, ground: Ground) -> None:
    """Bake a motion on a ground as it was asked for, and tell of it."""
    bake = bake_of(args, gait, ground, args.out)
    try:
        check_idle(args.out)
    except DesirePathError as problem:
        print(f"{problem}\nWaiting for up to {bake.wait:g} s.", file=sys.stderr)
    for warning in bake.warnings:
        print(f"warning       {warning}", flush=True)
    word = "pass" if bake.film == "passes" else "frame"
    for progress in bake.run():
        bar(progress.fraction, f"{word} {progress.frame}")
    report: dict[str, Any] = bake.report or {}
    print(f"contacts      {report['contacts']}")
    print(f"deepest       {1000 * report['deepest_m']:.1f} mm")
    print(
        f"pressed       {1000 * report['pressed_m3']:.3f} l of firm ground, "
        f"{1000 * report['pressed_heap_m3']:.3f} l of loose heaps"
    )
    print(f"heaped        {1000 * report['heaped_m3']:.3f} l")
    if "spray_thrown_m3" in report:
        litres = {name: 1000 * report[f"spray_{name}_m3"] for name in ("thrown", "airborne", "beside", "stuck")}
        print(
            "thrown        {thrown:.3f} l, of which {airborne:.3f} l fly and {beside:.3f} l fell by the ground; "
            "{stuck:.3f} l stick".format(**litres)
        )
    print(f"seconds       {report['seconds']:.2f}")
    for warning in report["warnings"]:
        if warning not in bake.warnings:
            print(f"warning       {warning}")
    print(f"written to    {os.path.abspath(args.out)}")


def add(tasks: argparse._SubParsersAction[Parser]) -> None:
    bake = tasks.add_parser("bake", help="press a recorded walk into ground and write EXR files")
    bake_options(bake)
    bake.set_defaults(task=_bake)


def bake_options(bake: Parser) -> None:
    """Which walk is pressed into which ground, and how."""
    bake.add_argument("walk", help="a recording (.npz), from object.desire_path_record or Gait.save")
    ground_options(bake, "--spacing")
    press_options(bake)
    _path_options(bake)
    bake.add_argument(
        "--film",
        choices=FILMS,
        help="a playback frame for every scene frame, or for every pass; passes, if there are several",
    )


def ground_options(command: Parser, spacing: str) -> None:
    """What is pressed; spacing: the name of the option for the distance of an EXR's samples."""
    command.add_argument(
        "--ground",
        default="flat",
        help="flat, flat:HEIGHT, an EXR of heights [m] (channel height, Z, "
        "V or Y), a GeoTIFF of them (needs rasterio), or a bake's maps_final.exr: its trail goes on",
    )
    command.option(spacing, SAMPLES, type=float, help="distance of the EXR's samples [m], if it does not say")


def press_options(command: Parser) -> None:
    """How press() presses it, and where the files go."""
    command.add_argument("--soil", default="dry-sand", help=SOIL_HELP)
    command.add_argument("--soil-set", action="append", default=[], metavar="NAME=VALUE", help=SET_HELP)
    command.add_argument(
        "--layer",
        action="append",
        default=[],
        metavar="SOIL:METRES",
        help="a layer of another soil on that one, as mud:0.03; repeatable, from the top down",
    )
    command.add_argument("--soil-keys", metavar="KEYS.json", help=KEYS_HELP)
    command.add_argument("--cell", type=float, help="side of a cell [m] (0.01, or that of the trail that goes on)")
    command.add_argument(
        "--origin",
        type=float,
        nargs=2,
        metavar=("X", "Y"),
        help="where cells begin [m] (0 0, or as in "
        "the trail that goes on); a report.json says where another bake's did",
    )
    command.add_argument("--out", required=True, help="folder for the files")
    command.add_argument(
        "--plants",
        nargs="+",
        action="extend",
        default=[],
        metavar="KIND[:DENSITY]",
        help=f"what grows here: {', '.join(KINDS)}, or a kind's file (.json); plants for each m^2",
    )
    command.add_argument("--frame-start", type=int, help="first scene frame (the recording's)")
    command.add_argument("--frame-end", type=int, help="last scene frame (the recording's)")
    command.add_argument("--model", choices=LOAD_MODELS, default="inertia", help="how forces are computed")
    command.add_argument(
        "--law",
        choices=CONTACT_LAWS,
        default="sole",
        help="how walkers press that do not say it themselves: carve = down to where they are, whatever they weigh",
    )
    command.add_argument("--heap", choices=HEAPS, default="rest", help="how displaced soil is laid")
    command.option(
        "--rim-width", PAPER, type=float, default=0.04, metavar="METRES", help="how wide the rim of a paper heap is"
    )
    command.add_argument(
        "--spray",
        metavar="SPRAY",
        help=f"soil sticks to soles and wheels and flies off them: {', '.join(SPRAYS)}, or a spray's file (.json)",
    )
    command.option(
        "--spray-set",
        SPRAYED,
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="another number for that spray, as adhesion=0.004, in SI units; repeatable",
    )
    command.add_argument("--threads", type=int, default=0, help="0 = all; the result does not depend on it")
    command.add_argument("--memory", metavar="SIZE", help=MEMORY_HELP)
    command.add_argument(
        "--limit",
        nargs="+",
        action="extend",
        default=[],
        metavar="NAME=NUMBER",
        help=f"how much a bake may take before it is refused: {', '.join(ADVICE)} (GB of memory and disk)",
    )


def _path_options(bake: Parser) -> None:
    bake.add_argument(
        "--place-feet",
        action="store_true",
        help="turn the feet to the ground's slope first; a walk of a level floor is carried there. Along a path this "
        "is always done",
    )
    bake.option(
        "--wade",
        WEIGHT,
        default=False,
        action="store_true",
        help="feet go through what they sink into, as through deep snow: they push ahead what they do not clear",
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
