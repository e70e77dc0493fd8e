"""python -m desire_path track: marks of stamps, or ruts of wheels and vehicles, along a drawn curve."""

from __future__ import annotations

import argparse
import os

from .bake.options import FILMS
from .bake.stamping import TrackPress
from .command_bake import bar, cells, ground_options, press, press_options, read_ground
from .ground import layers
from .ground.options import SimulationOptions
from .ground.sim import Ground, Simulation
from .ground.soil import as_soil
from .motion.gait import Gait
from .needs import Need, Parser
from .placement import path as paths
from .placement import stamps, tyre, vehicle
from .placement.marks import SIDES, Drive, Marks, lay
from .placement.track import Wheel, rolled, stamped

STAMPED = Need(
    lambda args: args.wheel is None and args.vehicle is None, "is of stamps: leave --wheel and --vehicle out"
)
ROLLED = Need(lambda args: args.wheel is not None, "is of wheels: add --wheel RADIUS")
SCATTERED = Need(lambda args: bool(args.plants) or args.scatter is not None, "is of chance: add --scatter or --plants")
STAMP = Need(lambda args: args.stamp.endswith(".exr"), "is that of a picture: give --stamp a .exr")

MOVES = ("film", "plants", "spray", "soil_keys", "frame_start", "frame_end", "limit")  # of what comes down in time


def _track(args: argparse.Namespace) -> None:
    ground = read_ground(args.ground, args.ground_spacing).layered(*map(layers.read, args.layer))
    below = Simulation(ground, options=SimulationOptions(origin=args.origin or (0.0, 0.0)))
    at_once = STAMPED.met(args) and args.model == "inertia"
    if at_once and not any(getattr(args, name) for name in MOVES):
        _at_once(args, ground, below)
    else:
        args.film = args.film or "frames"
        press(args, _motion(args, below), ground)


def _numbers(args: argparse.Namespace) -> tuple[Marks, Drive]:
    marks = Marks(args.spacing, args.count, args.width, args.first, args.size, args.scatter or 0.0, args.seed)
    return marks, Drive(args.mass, args.depth, args.speed, args.end_speed, args.frame_rate)


def _stamp(args: argparse.Namespace) -> stamps.Stamp:
    if not args.stamp.endswith(".exr"):
        return stamps.find(args.stamp)
    return stamps.Stamp.read(args.stamp, args.stamp_length, args.stamp_height)


def _motion(args: argparse.Namespace, below: Simulation) -> Gait:
    curve, (marks, drive) = paths.read(args.along), _numbers(args)
    if args.vehicle is not None:
        return rolled(curve, vehicle.find(args.vehicle), drive, below)
    if args.wheel is not None:
        return rolled(curve, Wheel(args.wheel, args.tyre_width, args.tread, args.gauge), drive, below)
    return stamped(curve, _stamp(args), marks, drive, below)


def _at_once(args: argparse.Namespace, ground: Ground, below: Simulation) -> None:
    """Nothing is to be seen moving: the marks alone."""
    laid = lay(paths.read(args.along), _stamp(args), *_numbers(args), below)
    cell, origin = cells(args, ground)
    options = SimulationOptions(
        law=args.law, heap=args.heap, rim_width=args.rim_width, origin=origin, threads=args.threads
    )
    track = TrackPress(ground, laid, as_soil(args.soil).changed(args.soil_set), cell, options=options)
    for warning in track.warnings:
        print(f"warning       {warning}", flush=True)
    track.press(lambda share: bar(share, "of the marks"))
    deepest = float(track.read("compression").max())
    track.keep(args.out, frame_rate=args.frame_rate)
    print(f"marks         {track.strokes}")
    print(f"deepest       {1000 * deepest:.1f} mm")
    print(f"written to    {os.path.abspath(args.out)}")


def add(tasks: argparse._SubParsersAction[Parser]) -> None:
    track = tasks.add_parser("track", help="press a track of stamps or wheels along a curve and write EXR files")
    track.add_argument("--along", required=True, metavar="PATH.csv", help="the curve: columns x,y [m]")
    track.option(
        "--stamp",
        STAMPED,
        default="boot",
        metavar="NAME",
        help=f"{', '.join(stamps.STAMPS)}, or a picture (.exr): forward is up, the whiter the deeper, black does not "
        "touch (boot)",
    )
    track.option("--stamp-length", STAMP, type=float, default=0.3, help="of a picture, from top to bottom [m] (0.3)")
    track.option("--stamp-height", STAMP, type=float, default=0.01, help="from its grey to its white [m] (0.01)")
    track.option("--spacing", STAMPED, type=float, help="from mark to mark [m]; it grows with the root of the speed")
    track.option("--count", STAMPED, type=int, help="so many marks from end to end, instead of a spacing")
    track.option("--width", STAMPED, type=float, help="between the lines of left and right marks [m]")
    track.option("--first", STAMPED, default="left", choices=SIDES, help="the foot that begins (left)")
    track.option("--size", STAMPED, type=float, default=1.0, help="times as large as usual (1)")
    track.option("--scatter", STAMPED, type=float, help="by how much sizes differ, a share (0)")
    track.option("--seed", SCATTERED, type=int, default=0, help="of sizes and plants (0)")
    rolls = track.add_mutually_exclusive_group()
    rolls.add_argument("--wheel", type=float, metavar="RADIUS", help="a wheel rolls along, in place of stamps [m]")
    rolls.add_argument(
        "--vehicle", metavar="NAME", help=f"all wheels of a {', '.join(vehicle.VEHICLES)}, or of one saved as .json"
    )
    track.option("--tyre-width", ROLLED, type=float, default=0.2, help="how wide its tyre is [m] (0.2)")
    track.option("--tread", ROLLED, default="blocks", choices=tyre.TYRES, help="what its rim carries (blocks)")
    track.option("--gauge", ROLLED, type=float, default=0.0, help="two wheels, so far from middle to middle [m] (one)")
    track.add_argument("--mass", type=float, help="that rests on a mark, or on all wheels [kg] (what is usual)")
    track.add_argument("--depth", type=float, help="so deep, whatever it weighs, instead of a mass [m]")
    track.add_argument("--speed", type=float, help="at the start [m/s] (what is usual)")
    track.add_argument("--end-speed", type=float, help="at the end [m/s] (as at the start)")
    track.add_argument("--frame-rate", type=float, default=24.0, help="playback frames a second (24)")
    track.add_argument(
        "--film",
        choices=FILMS,
        help="show stamps as they come down one by one, in frames; usually all of them are there at once",
    )
    ground_options(track, "--ground-spacing")
    press_options(track)
    track.set_defaults(task=_track)
