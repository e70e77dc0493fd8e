"""pressed.py - what was pressed into a ground by hand: where that lies, and who goes on from it.

    <folder of the ground's bake>/pressed_1/frames/.., maps_final.exr    a bake of its own, named by `pressed`
A ground that nobody walks on plays it; a bake of those who do begins with it. Each time something is kept it goes to
a new place, so that undo finds the one before; those that no ground names go when the file is saved.
"""

import os
from contextlib import suppress
from dataclasses import replace

import bpy

from ..bake.bake import read_index
from ..bake.output import free
from ..errors import DesirePathError
from ..ground import mesh
from ..ground.sim import Ground
from . import axes, ground, home, layered, playback

HAND = "pressed"  # in a bake's inputs: it was pressed by hand
TRACKS = "tracks"  # .. : tracks are in it, and what they were made from
MIXED = "mixed"  # .. : and something else that a hand has pressed, so that they cannot be pressed anew alone
SETTINGS = ("law", "heap")
_left = set()  # (folder, owner) of bakes that others have taken the place of in this session


def folder(obj):
    """Where what was pressed lies, as the system knows it; empty: nothing was."""
    settings = obj.desire_path
    if not settings.pressed:
        return ""
    path = os.path.abspath(bpy.path.abspath(settings.pressed))
    played = home.played(obj)
    if not os.path.isdir(path) and played and os.path.basename(played) == os.path.basename(path):
        return played  # the file was saved elsewhere
    return path


def next_place(obj):
    """A place for what is to be kept next, as Blender writes paths."""
    number = 1
    while True:
        place = playback.join(obj.desire_path.folder, f"pressed_{number}")
        if not os.path.lexists(bpy.path.abspath(place)):
            return place
        number += 1


def start(obj, given):
    """The Ground of an object as a walk meets it: as it was pressed, if it was."""
    path = folder(obj)
    if not path:
        return given
    try:
        return replace(given, trail=Ground.read(os.path.join(path, "maps_final.exr")).trail)
    except DesirePathError as problem:
        raise _unreadable(obj, problem) from None


def _unreadable(obj, problem):
    return DesirePathError(
        f"What was pressed into '{obj.name}' by hand cannot be read ({problem}) Press it again, or free the ground."
    )


def inputs(obj):
    """What is known of what was pressed into a ground, by part; empty where nothing was."""
    path = folder(obj)
    try:
        return read_index(path).inputs if path else {}
    except DesirePathError as problem:
        raise _unreadable(obj, problem) from None


def mixed(obj):
    """The same of the tracks, for what goes on from them; empty where there are none."""
    found = inputs(obj)
    return {TRACKS: found[TRACKS], MIXED: True} if TRACKS in found else {}


def plays(obj):
    """Whether a ground plays what was pressed into it."""
    path = folder(obj)
    return bool(path) and home.played(obj) == path


def marks(obj, surface):
    """A word for each part that pressed ground was made from."""
    settings = obj.desire_path
    chosen = [settings.cell_size, *(getattr(settings, name) for name in SETTINGS)]
    laid = [each.parameters() for each in ground.soils(obj)] + layered.parameters(obj)
    return {HAND: True, "ground": surface.mark, "settings": mesh.mark((), [*chosen, *laid])}


def changed(scene, obj, index):
    """A sentence about what has changed since a ground was pressed; empty where nothing has."""
    now = marks(obj, ground.read(scene, obj, axes.typed(obj.desire_path.cell_size), scene.frame_start))
    for name, words in (("ground", "The ground has"), ("settings", "The settings have")):
        if index.inputs.get(name) != now[name]:
            return f"{words} changed since it was pressed by hand: press it again."
    return ""


def replaced(obj):
    """What was pressed into a ground is no longer what it plays; it goes when the file is saved."""
    if obj.desire_path.pressed:
        _left.add((folder(obj), obj.desire_path.bake_id))


def forget(obj):
    """Nothing was pressed."""
    replaced(obj)
    obj.desire_path.pressed = ""


def tidy():
    """The file was saved: delete what no ground names any more."""
    named = {folder(obj) for obj in bpy.data.objects if obj.type == "MESH" and obj.desire_path.pressed}
    for path, owner in list(_left):
        if path not in named:
            with suppress(DesirePathError):  # it does no harm where it is
                free(path, owner)
    _left.clear()
