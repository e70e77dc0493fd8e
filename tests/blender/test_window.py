"""In a window: the bake runs in slices, shows how far it is, and ESC or Cancel stops it."""

import os
import pathlib
import subprocess
import time

import bpy
from run import Skip

SCRIPT = pathlib.Path(__file__).resolve().parent / "window.py"


def test_modal_bake(folder):
    if not bpy.app.binary_path:
        raise Skip("bpy as a module has no window")
    read, write = os.pipe()
    screen = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "900x900x24"],
        pass_fds=(write,),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(write)
    try:
        with os.fdopen(read) as pipe:
            display = pipe.readline().strip()
        assert display, "Xvfb did not start"
        log = folder / "log"
        with open(log, "w", encoding="utf-8") as out:
            child = subprocess.Popen(
                [
                    bpy.app.binary_path,
                    "--factory-startup",
                    "--enable-event-simulate",
                    "-noaudio",
                    "-p",
                    "0",
                    "0",
                    "900",
                    "900",
                    "--python-exit-code",
                    "1",
                    "--python",
                    str(SCRIPT),
                    "--",
                    str(folder),
                ],
                env={**os.environ, "PATH": "/usr/bin:/bin", "DISPLAY": f":{display}"},
                stdout=out,
                stderr=subprocess.STDOUT,
            )
            until = time.monotonic() + 180
            while child.poll() is None and time.monotonic() < until:
                time.sleep(0.1)
            if child.poll() is None:
                child.kill()
                child.wait()
        text = log.read_text(encoding="utf-8")
        assert "all seen" in text, text
    finally:
        screen.terminate()
        screen.wait()
