"""starts.py - the benches of this folder run, as small as they go: that they start, not what they tell.

starts.python(with_blender=False)            {name of a bench: its file}
starts.run(starts.python(False)["lane"], "1")   what it printed
"""

import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def python(with_blender):
    """The benches that are written in Python: those that need Blender, or those that do not."""
    found = {path.stem[6:]: path for path in sorted(HERE.glob("bench_*.py"))}
    return {name: path for name, path in found.items() if ("\nimport bpy" in path.read_text("utf-8")) == with_blender}


def command(path, *words, blender=""):
    """What runs a bench with words of its own: in a Blender (its path), else in this Python."""
    if blender:
        return [blender, "-b", "--factory-startup", "--python-exit-code", "1", "-P", str(path), "--", *words]
    return [sys.executable, str(path), *words]


def run(path, *words, blender=""):
    """Run a bench as command() says; returns what it told, raises where it fails."""
    done = subprocess.run(
        command(path, *words, blender=blender),
        env={**os.environ, "PYTHONPATH": f"{ROOT / 'addon'}{os.pathsep}{ROOT / 'tests'}"},
        capture_output=True,
        text=True,
        timeout=600,
    )
    said = done.stdout + done.stderr
    assert done.returncode == 0 and "Traceback" not in said, f"{path.name}: {said}"
    return done.stdout
