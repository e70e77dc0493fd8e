"""python -m desire_path farm: cut a bake into tasks, do one of them, and put together what all of them made."""

from __future__ import annotations

import argparse
import os
from typing import Any

from .command_bake import MEMORY_HELP, bake_of, bake_options, bar, walked
from .errors import DesirePathError
from .farm import merge, plan, send, task
from .farm.job import Job
from .needs import Parser


def _grid(text: str) -> tuple[int, int]:
    try:
        columns, rows = (int(word) for word in text.lower().split("x"))
        return columns, rows
    except ValueError:
        raise DesirePathError(f"'{text}' are no tiles: write columns x rows, as 4x4.") from None


def _plan(args: argparse.Namespace) -> None:
    gait, ground = walked(args)
    bake = bake_of(args, gait, ground, os.path.join(args.out, "bake"))
    for warning in bake.warnings:
        print(f"warning       {warning}", flush=True)
    summary = plan.plan(bake, args.out, _grid(args.tiles), args.windows, args.margin)
    print(f"windows       {summary.windows}, of which each needs those before")
    print(f"tiles         {summary.tiles}")
    print(f"components    {summary.components}, {summary.most} at most in one window")
    print(f"tasks         {summary.tasks} with something to do")
    print(f"seconds       {summary.seconds:.1f} of one core, about; {summary.longest:.1f} one after the other")
    for_farms = f"{send.TEMPLATE} and {send.SETTINGS}"
    print(f"for farms     {for_farms if summary.template else send.SETTINGS + ': too many windows for OpenJD'}")
    print(f"bytes         {summary.bytes:,} as it was planned")
    if summary.chained:
        print(f"one by one    {summary.chained}: everybody is one component, and windows alone are tasks")
    print(f"written to    {os.path.abspath(args.out)}")


def _tile(args: argparse.Namespace) -> None:
    result: dict[str, Any] = task.run(
        Job(args.job),
        args.window,
        args.tile,
        args.threads,
        lambda share: bar(share, "of the window"),
        limit=args.memory or None,
    )
    did = result["report"].get("contacts")
    print(f"window        {args.window}")
    print(f"tile          {args.tile}")
    print("did           nothing: nobody walks there" if did is None else f"contacts      {did}")
    print(f"seconds       {result['seconds']:.2f}")


def _merge(args: argparse.Namespace) -> None:
    job = Job(args.job)
    folder = args.out or job.path("bake")
    report = merge.merge(job, folder, lambda share: bar(share, "of the frames"), limit=args.memory or None)
    print(f"contacts      {report['contacts']}")
    print(f"deepest       {1000 * report['deepest_m']:.1f} mm")
    print(f"seconds       {report['seconds']:.2f} of all tasks")
    for warning in report["warnings"]:
        print(f"warning       {warning}")
    print(f"written to    {os.path.abspath(folder)}")


def add(tasks: argparse._SubParsersAction[Parser]) -> None:
    farm = tasks.add_parser("farm", help="bake on many machines: plan a job, do one of its tasks, merge them")
    parts = farm.add_subparsers(required=True, metavar="plan | tile | merge")
    cut = parts.add_parser("plan", help="cut a bake into windows and tiles, and write them to a job's folder")
    bake_options(cut)
    cut.add_argument("--tiles", default="1x1", metavar="COLUMNSxROWS", help="tasks of a window (1x1)")
    cut.add_argument("--windows", type=int, default=1, help="that follow each other (1)")
    cut.add_argument(
        "--margin",
        type=float,
        default=0.0,
        help="so much more ground counts as changed by a step, for soil that goes far [m] (0)",
    )
    cut.set_defaults(task=_plan)
    one = parts.add_parser("tile", help="do the task of one window and tile; those of the windows before are needed")
    one.add_argument("job", help="the folder that farm plan wrote")
    one.add_argument("--window", type=int, required=True, help="its number, from 0 on")
    one.add_argument("--tile", type=int, required=True, help="its number, from 0 on, row by row from the lowest y")
    one.add_argument("--threads", type=int, default=0, help="0 = all; the result does not depend on it")
    one.add_argument("--memory", metavar="SIZE", help=MEMORY_HELP)
    one.set_defaults(task=_tile, out=None)
    all_of = parts.add_parser("merge", help="write the bake that all tasks have made together")
    all_of.add_argument("job", help="the folder that farm plan wrote")
    all_of.add_argument("--out", help="folder for the files (bake, in the job's)")
    all_of.add_argument("--memory", metavar="SIZE", help=MEMORY_HELP)
    all_of.set_defaults(task=_merge)
