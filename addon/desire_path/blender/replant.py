"""replant.py - plants are put anew when a number of theirs was changed."""

import functools
from contextlib import contextmanager, suppress

import bpy

from ..errors import DesirePathError
from . import plants, show, undo_step

DELAY = 0.25  # of the grass behind a number that is dragged [s]
_waiting = {}  # ground's name -> what the timer calls
_quiet = False


@contextmanager
def quietly():
    """Set numbers of plants without putting them anew at each."""
    global _quiet
    _quiet = True
    try:
        yield
    finally:
        _quiet = False


def changed(obj):
    """A number of a ground's plants was changed: put them anew, in a window once it rests."""
    if _quiet:
        return
    if bpy.app.background:
        _replant(obj.name)
        return
    before = _waiting.pop(obj.name, None)
    if before is not None and bpy.app.timers.is_registered(before):
        bpy.app.timers.unregister(before)
    _waiting[obj.name] = functools.partial(_replant, obj.name)
    bpy.app.timers.register(_waiting[obj.name], first_interval=DELAY)


def _replant(name):
    obj = bpy.data.objects.get(name)
    if obj is None or not obj.desire_path.is_ground or obj.mode == "EDIT":
        return
    # half typed: the next bake or Update says what is wrong
    with suppress(DesirePathError), undo_step.where_needed("Plants Put Anew"):
        refresh(bpy.context.scene, obj)


def refresh(scene, obj):
    """Put those plants anew whose numbers have changed; returns sentences."""
    late = plants.stale(obj)
    if not late:
        return []
    sentences = plants.plant(scene, obj, late)
    show.show_plants(obj)
    return sentences
