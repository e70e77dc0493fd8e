"""blender --command desire_path bake: grounds of a file are baked without a window; Blender 4.2 and later.

    blender --command desire_path bake beach.blend --ground Beach --save --report beach.json

Code 0: all was baked; 1: something was not, as the report and stderr say; 2: the words were no command.
"""

import argparse
import os
import sys

import bpy

from ..errors import DesirePathError
from .chosen import grounds, walkers
from .late import atomic_file, bake_job, home
from .ops import sentence

NAME = "desire_path"
_handle = None


def run(words):
    """What Blender calls with the words behind `--command desire_path`; returns the code."""
    parser = argparse.ArgumentParser(prog=f"blender --command {NAME}", description=__doc__.splitlines()[0])
    tasks = parser.add_subparsers(required=True, metavar="bake")
    bake = tasks.add_parser("bake", help="bake grounds of a file")
    bake.add_argument("file", help="the .blend file")
    bake.add_argument("--ground", action="append", default=[], metavar="NAME", help="a ground; may be repeated (all)")
    bake.add_argument("--scene", metavar="NAME", help="a scene of the file (the one that it shows)")
    bake.add_argument("--save", action="store_true", help="save the file, so that it plays what was baked")
    bake.add_argument("--report", metavar="FILE", help="what was baked and what was not (.json)")
    try:
        args = parser.parse_args(words)
    except SystemExit as end:
        return end.code or 0
    report = {"file": os.path.abspath(args.file), "saved": False, "grounds": [], "warnings": [], "problems": []}
    try:
        if args.report:
            atomic_file.check(args.report, "The report")
        _bake(args, report)
    except (DesirePathError, OSError, MemoryError, RuntimeError) as problem:
        report["problems"].append(sentence(problem))
    try:
        if args.report:
            atomic_file.write_json(args.report, report, "The report")
    except DesirePathError as problem:
        report["problems"].append(str(problem))
    for each in report["warnings"]:
        print(f"Warning: {each}", file=sys.stderr)
    for each in dict.fromkeys(report["problems"]):
        print(each, file=sys.stderr)
    return 1 if report["problems"] else 0


def _bake(args, report):
    if not os.path.isfile(args.file):
        raise DesirePathError(f"{args.file} is not there: give the path of a .blend file.")
    bpy.ops.wm.open_mainfile(filepath=report["file"])
    scene = bpy.data.scenes.get(args.scene) if args.scene else bpy.context.scene
    if scene is None:
        raise DesirePathError(f"There is no scene '{args.scene}' in {args.file}: give the name of one.")
    if bpy.context.window is not None:
        bpy.context.window.scene = scene
    names = {each.name for each in grounds(scene)}
    for name in args.ground:
        if name not in names:
            known = ", ".join(f"'{each}'" for each in sorted(names)) or "none"
            raise DesirePathError(f"There is no ground '{name}' in '{scene.name}', whose grounds are: {known}.")
    asked = list(dict.fromkeys(args.ground)) or [each.name for each in grounds(scene) if walkers(scene, each)]
    if not asked:
        raise DesirePathError(
            f"Nobody walks on a ground of '{scene.name}': add a ground and a walker, and save the file."
        )
    done = set()
    for name in asked:
        if name not in done:  # else it was baked with one that the same walk crosses
            done |= _job(scene, name, report)
    if args.save and report["grounds"]:
        bpy.ops.wm.save_mainfile()
        report["saved"] = True


def _job(scene, name, report):
    """Bake a ground, and those that the same walk crosses, and note what became of them; returns their names."""
    job = None
    try:
        bpy.context.view_layer.update()
        job = bake_job.Job(scene, scene.objects[name])
        for _ in job.run():
            pass
        print(job.finish())
    except (DesirePathError, OSError, MemoryError) as problem:
        if job is not None and job.bake is not None:
            job.play()
        report["problems"].append(f"'{name}' was not baked: {sentence(problem)}")
        return {name}
    report["warnings"] += [each for each in job.warnings if each not in report["warnings"]]
    report["grounds"] += [{"name": each, "folder": home.folder(bpy.data.objects[each])} for each in job.grounds]
    return {name, *job.grounds}


def register():
    global _handle
    if hasattr(bpy.utils, "register_cli_command"):
        _handle = bpy.utils.register_cli_command(NAME, run)


def unregister():
    global _handle
    if _handle is not None:
        bpy.utils.unregister_cli_command(_handle)
        _handle = None
