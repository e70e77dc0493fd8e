"""python -m desire_path crowd: walkers between places, who choose their ways by what is worn."""

from __future__ import annotations

import argparse
import os

from . import memory
from .command_bake import MEMORY_HELP, bar
from .crowd import scene as scenes
from .crowd import trajectories
from .crowd.crowd import Crowd
from .crowd.feet import Feet
from .crowd.trajectories import Recorded
from .needs import Parser


def _crowd(args: argparse.Namespace) -> None:
    most = memory.size_of(args.memory)
    memory.check(most)
    with memory.held(most, args.out):
        _walk(args)


def _walk(args: argparse.Namespace) -> None:
    scene = scenes.read(args.scene)
    if args.trajectories is None:
        crowd = Crowd(scene, args.out)
    else:
        recorded = Recorded(scene, trajectories.read(args.trajectories))
        crowd = Crowd(recorded.scene, args.out, ways=recorded)
    feet = Feet(scene, args.out) if scene.press else None  # before minutes of work
    report = crowd.run(lambda share: bar(share, "of the passages"))
    print(f"passages      {report['passages']}")
    print(f"detour        {report['detour']:.3f}")
    print(f"worn          {report['area_below_half_cover']:.0f} m^2 below half cover")
    if feet is not None:
        pressed = feet.press(lambda share: bar(share, "of the feet"))
        print(f"pressed       {pressed['passages']} passages, {1000 * pressed['deepest_m']:.1f} mm deep")
        if "cover" in pressed:
            print(f"plants        {pressed['cover']:.0f} % cover left")
    print(f"written to    {os.path.abspath(args.out)}")


def add(tasks: argparse._SubParsersAction[Parser]) -> None:
    crowd = tasks.add_parser("crowd", help="let a crowd walk between places, and wear the paths it chooses")
    crowd.add_argument("scene", help="places, ground and walkers (.json)")
    crowd.add_argument("--out", required=True, help="the folder: paths.csv, cover_final.exr, frames, crowd.json")
    crowd.add_argument(
        "--trajectories",
        metavar="FILE",
        help="walkers go as another program told: a table frame,id,x,y (.csv), or JuPedSim's (.sqlite)",
    )
    crowd.add_argument("--memory", metavar="SIZE", help=MEMORY_HELP)
    crowd.set_defaults(task=_crowd)
