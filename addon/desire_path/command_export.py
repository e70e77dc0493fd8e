"""python -m desire_path export: what a bake left, for other programs."""

from __future__ import annotations

import argparse
import os

from .ground import height16, stage
from .needs import Parser

FORMATS = ("height16", "usd")


def add(tasks: argparse._SubParsersAction[Parser]) -> None:
    """Give the command to the parser of commands."""
    export = tasks.add_parser("export", help="write what a bake left for other programs")
    export.add_argument("bake", help="the folder of a bake, its maps_final.exr, or an EXR of heights")
    export.add_argument(
        "--format",
        choices=FORMATS,
        default="height16",
        help="height16: heights in 16 bit, a .json beside them tells what a value is; "
        "usd: a mesh with all maps, and plants that were baked as a mesh; needs usd-core",
    )
    export.add_argument("--spacing", type=float, help="distance of an EXR's samples [m], if its header does not say")
    export.add_argument(
        "--out",
        required=True,
        help=f"the file: {', '.join(height16.KINDS)} of height16, {', '.join(stage.KINDS)} of usd",
    )
    export.set_defaults(task=run)


def run(args: argparse.Namespace) -> None:
    """Write it, and tell what it is."""
    (_heights if args.format == "height16" else _stage)(args)
    print(f"written to    {os.path.abspath(args.out)}")


def _heights(args: argparse.Namespace) -> None:
    report = height16.write(args.bake, args.out, args.spacing)
    print(f"samples       {report['columns']} x {report['rows']}, {report['spacing']:g} m apart")
    print(f"heights       {report['lowest']:.6g} m to {report['highest']:.6g} m")
    if report["holes"]:
        print(f"holes         {report['holes']} samples without ground have the value 0")


def _stage(args: argparse.Namespace) -> None:
    report = stage.write(args.bake, args.out, args.spacing)
    print(f"ground        {report['points']} points, {report['faces']} faces")
    print(f"maps          {', '.join(report['primvars']) or 'none'}")
    print(f"plants        {report['stems']} stems" if report["stems"] else "plants        none were baked as a mesh")
    if report["beside"]:
        print(f"displacement  {report['beside']}")
