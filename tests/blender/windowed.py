"""windowed.py - a script in a Blender with a window, on a screen of its own that nobody sees."""

import os
import pathlib
import subprocess
import time

import bpy
from run import Skip


def story(script, folder, width=900, height=900, seconds=600, words=()):
    """Let Blender run a script (a path) to its end, with a folder for its pictures, or other words; raises with what it
    printed unless it says `all seen`; returns that."""
    if not bpy.app.binary_path:
        raise Skip("bpy as a module has no window")
    screen, display = _screen(width, height, folder)
    log = pathlib.Path(folder) / "log"
    size = [str(each) for each in (width, height)]
    start = ["--factory-startup", "--enable-event-simulate", "-noaudio", "-p", "0", "0", *size]
    start += ["--python-exit-code", "1", "--python", str(script), "--", *(words or [str(folder)])]
    try:
        with open(log, "w", encoding="utf-8") as out:
            child = subprocess.Popen(
                [bpy.app.binary_path, *start],
                env={
                    **os.environ,
                    "PATH": "/usr/bin:/bin",
                    "DISPLAY": f":{display}",
                    "DESIRE_PATH_SCREEN": f"{folder}/Xvfb_screen0",
                },
                stdout=out,
                stderr=subprocess.STDOUT,
            )
            until = time.monotonic() + seconds
            while child.poll() is None and time.monotonic() < until:
                time.sleep(0.1)
            if child.poll() is None:
                child.kill()
                child.wait()
        text = log.read_text(encoding="utf-8")
        assert "all seen" in text and "Traceback" not in text, text
        return text
    finally:
        screen.terminate()
        screen.wait()


def _screen(width, height, folder):
    """A screen that nobody sees, whose picture is a file in a folder: (its process, its number)."""
    read, write = os.pipe()
    screen = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-fbdir", str(folder)],
        pass_fds=(write,),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(write)
    with os.fdopen(read) as pipe:
        display = pipe.readline().strip()
    assert display, "Xvfb did not start"
    return screen, display
