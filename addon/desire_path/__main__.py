"""python -m desire_path: bake a recording, list or draw its forces, on a machine without Blender."""

from __future__ import annotations

import argparse
import os
import sys

from . import maps, plot, walker
from .bake import Bake
from .errors import DesirePathError
from .gait import Gait
from .place import place_feet
from .report import sentences, summary, write_contacts
from .sim import HEAPS, LAWS, LOAD_MODELS, Ground
from .soil import SOILS
from .version import VERSION


def _ground(text, spacing):
    """Ground from the command line: "flat", "flat:0.3" or an EXR of heights."""
    if text == "flat" or text.startswith("flat:"):
        try:
            return Ground.flat(float(text[5:] or 0.0))
        except ValueError:
            raise DesirePathError(f"'{text}' is no ground: write flat or flat:HEIGHT in metres.") from None
    picture = maps.read(text)
    name = next((n for n in ("height", "Y", "R", "Z") if n in picture.planes), next(iter(picture.planes)))
    step = spacing or picture.notes.get("cell")
    if not isinstance(step, (int, float)):
        raise DesirePathError(f"{text} does not say how far its samples are apart: add --spacing METRES.")
    x0, y0 = (picture.notes.get(note, 0.0) for note in ("originX", "originY"))
    if isinstance(x0, str) or isinstance(y0, str):
        raise DesirePathError(f"{text} says in words where it lies: give originX and originY as numbers [m].")
    return Ground.heights(picture.planes[name], step, x0 + step / 2, y0 + step / 2)


def _bar(progress):
    if sys.stderr.isatty():
        full = int(40 * progress.fraction)
        line = f"\r[{'#' * full}{'.' * (40 - full)}] frame {progress.frame}"
        print(line, end="" if progress.fraction < 1 else "\n", file=sys.stderr, flush=True)


def _bake(args):
    gait, ground = Gait.load(args.walk), _ground(args.ground, args.spacing)
    if args.place_feet:
        gait = place_feet(gait, ground)
    bake = Bake(
        gait, ground, args.soil, args.out, cell_size=args.cell,
        frame_start=args.frame_start, frame_end=args.frame_end, load_model=args.model, law=args.law,
        heap=args.heap, threads=args.threads, origin=args.origin,
    )
    for progress in bake.run():
        _bar(progress)
    report = bake.report
    print(f"contacts      {report['contacts']}")
    print(f"deepest       {1000 * report['deepest_m']:.1f} mm")
    print(f"pressed       {1000 * report['pressed_m3']:.3f} l of firm ground, "
          f"{1000 * report['pressed_heap_m3']:.3f} l of loose heaps")
    print(f"heaped        {1000 * report['heaped_m3']:.3f} l")
    print(f"seconds       {report['seconds']:.2f}")
    for warning in report["warnings"]:
        print(f"warning       {warning}")
    print(f"written to    {os.path.abspath(args.out)}")


def _loads(args):
    gait = Gait.load(args.walk)
    loads = walker.loads(gait, args.model)
    walker.write_loads(args.out, gait, loads)
    if args.contacts:
        write_contacts(args.contacts, gait, loads)
    for each in summary(gait, loads):
        print(f"{each['walker']:13} {'; '.join(sentences(each))}")
    for warning in loads.warnings:
        print(f"warning       {warning}")
    print(f"written to    {os.path.abspath(args.out)}")


def _plot(args):
    gait = Gait.load(args.walk)
    loads = walker.loads(gait, args.model)
    plot.write(args.out, gait, loads)
    for warning in loads.warnings:
        print(f"warning       {warning}")
    print(f"written to    {os.path.abspath(args.out)}")


def _parser():
    parser = argparse.ArgumentParser(prog="python -m desire_path", description=__doc__)
    parser.add_argument("--version", action="version", version=VERSION)
    tasks = parser.add_subparsers(required=True, metavar="bake | loads | plot")

    bake = tasks.add_parser("bake", help="press a recorded walk into ground and write EXR files")
    bake.add_argument("walk", help="a recording (.npz), from object.desire_path_record or Gait.save")
    bake.add_argument("--ground", default="flat", help="flat, flat:HEIGHT, or an EXR of heights [m]")
    bake.add_argument("--spacing", type=float, help="distance of the EXR's samples [m], if it does not say")
    bake.add_argument("--soil", default="dry-sand", help=f"one of {', '.join(SOILS)}")
    bake.add_argument("--cell", type=float, default=0.01, help="side of a cell [m] (0.01)")
    bake.add_argument("--origin", type=float, nargs=2, default=(0.0, 0.0), metavar=("X", "Y"),
                      help="where cells begin [m] (0 0); a report.json says where another bake's did")
    bake.add_argument("--out", required=True, help="folder for the files")
    bake.add_argument("--place-feet", action="store_true",
                      help="turn the feet to the ground's slope first; a walk of a level floor is carried there")
    bake.add_argument("--frame-start", type=int, help="first scene frame (the recording's)")
    bake.add_argument("--frame-end", type=int, help="last scene frame (the recording's)")
    bake.add_argument("--model", choices=LOAD_MODELS, default="inertia", help="how forces are computed")
    bake.add_argument("--law", choices=LAWS, default="sole", help="how a sole presses")
    bake.add_argument("--heap", choices=HEAPS, default="rest", help="how displaced soil is laid")
    bake.add_argument("--threads", type=int, default=0, help="0 = all; the result does not depend on it")
    bake.set_defaults(task=_bake)

    loads = tasks.add_parser("loads", help="write the forces of every part as a table")
    loads.add_argument("walk", help="a recording (.npz)")
    loads.add_argument("--model", choices=LOAD_MODELS, default="inertia", help="how forces are computed")
    loads.add_argument("--out", required=True, help="the table (.csv)")
    loads.add_argument("--contacts", help="another table: when, where and how hard each foot stood (.csv)")
    loads.set_defaults(task=_loads)

    graph = tasks.add_parser("plot", help="draw the vertical force of every foot (needs Matplotlib)")
    graph.add_argument("walk", help="a recording (.npz)")
    graph.add_argument("--model", choices=LOAD_MODELS, default="inertia", help="how forces are computed")
    graph.add_argument("--out", required=True, help=f"the picture ({', '.join(plot.KINDS)})")
    graph.set_defaults(task=_plot)
    return parser


def main(arguments=None):
    """Run one command; 0 when it worked, 1 with one sentence on stderr when it did not."""
    args = _parser().parse_args(arguments)
    try:
        args.task(args)
    except DesirePathError as problem:
        print(problem, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("Stopped; what was baked so far is kept, and the same command goes on from there.", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
