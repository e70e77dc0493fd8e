"""private.py - a scene of our own, in which something is looked at while the user's scene stays as it is."""

import math
from contextlib import contextmanager

import bpy

from ..errors import DesirePathError


@contextmanager
def private_scene(scene, *objects):
    """A scene with some objects in it and the clock of `scene`; gone afterwards."""
    own = bpy.data.scenes.new("desire_path sampling")
    try:
        for name in ("fps", "fps_base", "frame_map_old", "frame_map_new"):
            setattr(own.render, name, getattr(scene.render, name))
        for each in objects:
            own.collection.objects.link(each)
        yield own
    finally:
        bpy.data.scenes.remove(own)


@contextmanager
def looked_at(*objects):
    """Objects that are disabled in viewports are looked at all the same: renders show them."""
    hidden = [each for each in objects if each.hide_viewport]
    for each in hidden:
        each.hide_viewport = False
    try:
        yield
    finally:
        for each in hidden:
            each.hide_viewport = True


def evaluated(own, obj, frame):
    """The object as it is at a frame (a float: sub-frames are evaluated) of a private scene."""
    whole = math.floor(frame)
    own.frame_set(whole, subframe=frame - whole)
    found = obj.evaluated_get(own.view_layers[0].depsgraph)
    if not found.is_evaluated:
        raise DesirePathError(
            f"'{obj.name}' is disabled in viewports: enable it (the screen icon in the Outliner) and try again."
        )
    return found
