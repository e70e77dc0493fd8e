"""A job as farms take it: an Open Job Description template, and what the Flamenco job type asks for. MODEL 13

job/openjd.json      openjd run job/openjd.json, or deadline bundle submit: steps are windows, tasks their tiles
job/flamenco.json    the settings of flamenco/desire_path.js, which goes into the scripts folder of a Flamenco Manager
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

from ..files import atomic_file

TEMPLATE, SETTINGS = "openjd.json", "flamenco.json"
MAX_STEPS = 100  # of an Open Job Description
LIMIT = ("--memory", "{{Param.Memory}}")  # empty = none


def openjd(name: str, tasks: Sequence[Sequence[int]]) -> dict[str, Any] | None:
    """The template of a job, with tiles of each window that have something to do; None: too many windows. It lies in
    the folder of its job.

    A step for each window, which waits for the one before, and one that merges.
    """
    steps: list[dict[str, Any]] = []
    for window, tiles in enumerate(tasks):
        if tiles:
            tile = {"name": "Tile", "type": "INT", "range": ",".join(map(str, tiles))}
            args = ["tile", "{{Param.Job}}", "--window", str(window), "--tile", "{{Task.Param.Tile}}"]
            steps.append(_step(f"Window {window}", args, steps))
            steps[-1]["parameterSpace"] = {"taskParameterDefinitions": [tile]}
    steps.append(_step("Merge", ["merge", "{{Param.Job}}"], steps))
    if len(steps) > MAX_STEPS:
        return None
    return {
        "specificationVersion": "jobtemplate-2023-09",
        "name": name[:100],
        "parameterDefinitions": [
            {"name": "Job", "type": "PATH", "objectType": "DIRECTORY", "dataFlow": "INOUT", "default": "."},
            {"name": "Python", "type": "STRING", "default": "python"},
            {"name": "Memory", "type": "STRING", "default": ""},
        ],
        "steps": steps,
    }


def _step(name: str, args: list[str], before: list[dict[str, Any]]) -> dict[str, Any]:
    run = {"command": "{{Param.Python}}", "args": ["-m", "desire_path", "farm", *args, *LIMIT]}
    step: dict[str, Any] = {"name": name, "script": {"actions": {"onRun": run}}}
    if before:
        step["dependencies"] = [{"dependsOn": before[-1]["name"]}]
    return step


def flamenco(folder: str, tasks: Sequence[Sequence[int]]) -> dict[str, Any]:
    """Settings of the Flamenco job type, by key."""
    return {"job": folder, "tasks": ";".join(",".join(map(str, tiles)) for tiles in tasks)}


def write(folder: str, tasks: Sequence[Sequence[int]]) -> bool:
    """Write both to a job's folder; returns whether there is a template: not of more windows than it may have."""
    template = openjd(f"Desire Path, {os.path.basename(folder)}", tasks)
    if template is not None:
        atomic_file.write_json(os.path.join(folder, TEMPLATE), template, "The template")
    atomic_file.write_json(os.path.join(folder, SETTINGS), flamenco(folder, tasks), "The settings")
    return template is not None
