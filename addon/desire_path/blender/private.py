"""private.py - a scene of our own, in which something is looked at while the user's scene stays as it is."""

import math
import os
import re
from contextlib import contextmanager

import bpy
import numpy as np

from ..errors import DesirePathError
from . import clock, compat

MAX_LOOKS = 24  # frames at which one is looked at that something switches on and off


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
def shown_scene(scene):
    """The scene itself, which shows the same frame again afterwards: what follows its own properties (its frame's
    number, a property that is keyed) does so nowhere else."""
    frame, between = scene.frame_current, scene.frame_subframe
    try:
        yield scene
    finally:
        scene.frame_set(frame, subframe=between)


@contextmanager
def visiting(scene, obj):
    """The scene itself, likewise, with an object in it that is in none."""
    scene.collection.objects.link(obj)
    try:
        with shown_scene(scene):
            yield scene
    finally:
        scene.collection.objects.unlink(obj)


@contextmanager
def following(scene, obj):
    """(scene, object) to look at for how properties of an object follow its keys, strips and drivers: a bare copy in a
    scene of its own, or itself in `scene` where its drivers ask that."""
    drivers = obj.animation_data.drivers if obj.animation_data is not None else ()
    asks = any(compat.asks_scene(each.driver) for each in drivers if not each.mute)
    if asks and obj.name in scene.view_layers[0].objects:
        with looked_at(obj), shown_scene(scene):
            yield scene, obj
        return
    copy = obj.copy()
    try:
        copy.parent = None  # what moves and shapes it costs time and does not matter
        copy.modifiers.clear()
        copy.constraints.clear()
        with private_scene(scene, copy) as own:
            yield own, copy
    finally:
        bpy.data.objects.remove(copy)


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


def check_library(obj):
    """Refuse an object whose data are in a library that is not there, of which Blender shows an empty stand-in."""
    library = obj.data.library if obj.data is not None else None
    if library is not None and not os.path.exists(bpy.path.abspath(library.filepath)):
        raise DesirePathError(
            f"The library of '{obj.name}', {library.filepath}, is not there: relocate it in the Outliner, where its "
            "Display Mode is Blender File."
        )


def evaluated(own, obj, frame):
    """The object as it is at a frame (a float: sub-frames are evaluated) of a private scene."""
    integer = math.floor(frame)
    own.frame_set(integer, subframe=frame - integer)
    found = obj.evaluated_get(own.view_layers[0].depsgraph)
    if not found.is_evaluated:
        raise DesirePathError(
            f"'{obj.name}' is disabled in viewports: enable it (the screen icon in the Outliner) and try again."
        )
    return found


def off_in_renders(scene, obj, frames):
    """Whether an object is off in renders, at frames (scene's, floats) if that is keyed, in strips or led by a driver;
    a list, of one where it is the same all the time."""
    animation = obj.animation_data
    if animation is None:
        return [obj.hide_render]
    led = animation.drivers.find("hide_render")
    if not any(len(track.strips) for track in animation.nla_tracks) and (led is None or _is_timeless(led.driver)):
        keyed = compat.curve(animation, "hide_render")
        if keyed is None or led is not None:
            return [obj.hide_render]
        return [keyed.evaluate(frame / clock.stretch(scene)) > 0.5 for frame in frames]
    pick = np.linspace(0, len(frames) - 1, min(len(frames), MAX_LOOKS)).round().astype(int)
    found = []
    with following(scene, obj) as (own, each):
        for number in pick:
            integer = math.floor(frames[number])
            own.frame_set(integer, subframe=frames[number] - integer)
            found.append(each.evaluated_get(own.view_layers[0].depsgraph).hide_render)
    return found


def _is_timeless(driver):
    """Whether what a driver comes to surely is the same at every frame: it asks for properties that nothing moves."""
    if driver.type == "SCRIPTED" and re.search(r"\b(frame|self|depsgraph)\b", driver.expression):
        return False
    targets = [target for variable in driver.variables for target in variable.targets]
    return all(variable.type == "SINGLE_PROP" for variable in driver.variables) and not any(
        isinstance(target.id, bpy.types.Scene) or _may_move(target.id, target.data_path) for target in targets
    )


def _may_move(owner, path):
    animation = getattr(owner, "animation_data", None)
    return animation is not None and (
        any(len(track.strips) for track in animation.nla_tracks) or compat.is_keyed(animation, path)
    )
