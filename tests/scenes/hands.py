"""hands.py - a user's hands, for scripts in a Blender with a window: they point, click, type, wait and take pictures.

    blender --factory-startup --enable-event-simulate -noaudio -p 0 0 1280 800 --python-exit-code 1 -P SCRIPT -- FOLDER

A story is a generator that yields how long to wait [s]; `tell` runs it and closes Blender at its end.
"""

import contextlib
import os
import sys
import time
import traceback

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d

from desire_path.ground import sim

KEYS = {" ": "SPACE", "\n": "RET"}


def slowed(write_frame, seconds=0.02):
    """Film.write_frame that takes so long yet [s]: bakes in a test are over before anybody could press ESC."""

    def slowly(film, path, moment):
        write_frame(film, path, moment)
        time.sleep(seconds)

    return slowly


@contextlib.contextmanager
def full_disk(picture):
    """No disk has room for a picture of frames by this name, as trail_0007.exr."""
    write_frame = sim.Film.write_frame

    def full(film, path, moment):
        if path is not None and path.endswith(picture):
            raise OSError(28, "No space left on device", path)
        write_frame(film, path, moment)

    sim.Film.write_frame = full
    try:
        yield
    finally:
        sim.Film.write_frame = write_frame


class Hands:
    """What they did is counted: clicks, keys, digits among these."""

    def __init__(self, folder):
        self.folder, self.clicks, self.keys, self.digits = folder, 0, 0, 0

    @property
    def window(self):
        return bpy.context.window_manager.windows[0]

    def area(self, kind):
        return next(area for area in self.window.screen.areas if area.type == kind)

    def region(self, kind, name="WINDOW"):
        return next(region for region in self.area(kind).regions if region.type == name)

    def within(self, kind, name="WINDOW"):
        """A context in which operators run as if pressed there."""
        return bpy.context.temp_override(window=self.window, area=self.area(kind), region=self.region(kind, name))

    def event(self, kind, value, at, **more):
        self.window.event_simulate(type=kind, value=value, x=int(at[0]), y=int(at[1]), **more)

    def click(self, at, button="LEFTMOUSE", **more):
        """Press a button of the mouse at a pixel (x, y) of the window, counted from below."""
        self.clicks += 1
        self.event("MOUSEMOVE", "NOTHING", at)
        yield 0.3
        self.event(button, "PRESS", at, **more)
        yield 0.1
        self.event(button, "RELEASE", at, **more)
        yield 0.5

    def key(self, kind, at, **more):
        self.keys += 1
        for value in ("PRESS", "RELEASE"):
            self.event(kind, value, at, **more)
        yield 0.3

    def type(self, text, at):
        for letter in text:
            self.keys += 1
            self.digits += letter.isdigit()
            shown = {} if letter == "\n" else {"unicode": letter}
            self.event(KEYS.get(letter, letter.upper()), "PRESS", at, **shown)
            self.event(KEYS.get(letter, letter.upper()), "RELEASE", at)
            yield 0.05

    def place(self, point):
        """The pixel of the window at which a point of the world is seen in the 3D view."""
        region = self.region("VIEW_3D")
        seen = location_3d_to_region_2d(region, self.area("VIEW_3D").spaces[0].region_3d, point)
        return region.x + seen.x, region.y + seen.y

    def shot(self, name):
        screenshot(self.window, self.folder / f"{name}.png")
        return self.pixels(name)

    def pixels(self, name):
        """A picture that was taken, (height, width, 3), from below."""
        image = bpy.data.images.load(str(self.folder / f"{name}.png"))
        found = np.empty(len(image.pixels), np.float32)
        image.pixels.foreach_get(found)
        width, height = image.size
        bpy.data.images.remove(image)
        return found.reshape(height, width, 4)[:, :, :3]


def screenshot(window, path):
    """A picture of a window. Under some drivers Blender sees nothing but black in it: then it is what the screen shows,
    in the file that DESIRE_PATH_SCREEN names (Xvfb -fbdir)."""
    with bpy.context.temp_override(window=window, screen=window.screen):
        bpy.ops.screen.screenshot(filepath=str(path))
    taken, screen = bpy.data.images.load(str(path)), os.environ.get("DESIRE_PATH_SCREEN")
    found = np.empty(len(taken.pixels), np.float32)
    taken.pixels.foreach_get(found)
    if screen and not found.reshape(-1, 4)[:, :3].any():
        seen = on_screen(screen)
        picture = bpy.data.images.new("screen", seen.shape[1], seen.shape[0])
        picture.pixels.foreach_set(np.ascontiguousarray(seen, np.float32).ravel())
        picture.filepath_raw, picture.file_format = str(path), "PNG"
        picture.save()
        bpy.data.images.remove(picture)
    bpy.data.images.remove(taken)


def on_screen(path):
    """The picture in an XWD file of 32 bit a pixel: (height, width, 4) from below, 0..1."""
    with open(path, "rb") as file:
        data = file.read()
    head = np.frombuffer(data, ">u4", 25)
    size, width, height, first, bits, line, colours = (int(head[each]) for each in (0, 4, 5, 7, 11, 12, 19))
    assert bits == 32, bits
    start = size + 12 * colours
    rows = np.frombuffer(data, np.uint8, height * line, start).reshape(height, line)[::-1, : 4 * width]
    rows = rows.reshape(height, width, 4)
    colour = rows[:, :, 2::-1] if first == 0 else rows[:, :, 1:]  # least or most significant byte first
    return np.concatenate([colour / 255.0, np.ones((height, width, 1))], axis=2)


def until(condition, seconds=180, pause=0.05, told=None):
    """Wait for something; told: what to say of it, if it does not come."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"waited too long{f': {told()}' if told else ''}"
        yield pause


def tell(story):
    """Run a story; Blender ends with it, and says `all seen` where it came to its end."""
    steps = iter(story)

    def tick():
        try:
            return next(steps)
        except StopIteration:
            print("all seen", flush=True)
        except Exception:
            traceback.print_exc()
        sys.stdout.flush()
        bpy.ops.wm.quit_blender()
        return None

    bpy.app.timers.register(tick, first_interval=1.0, persistent=True)
