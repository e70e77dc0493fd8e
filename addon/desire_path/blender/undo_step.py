"""undo_step.py - what happens between two undo steps must not exchange datablocks.

Undo takes an object that is the same in both steps as it is, with the node trees, meshes and images it names. One that
came in between is in neither step: it is gone then, and Blender ends. So it gets a step of its own.
"""

from contextlib import contextmanager

import bpy

LISTS = ("node_groups", "images", "objects", "meshes", "materials")


@contextmanager
def where_needed(message):
    """Make an undo step of what is done inside, where that has made or removed datablocks; only in a window."""
    before = _there()
    yield
    if not bpy.app.background and _there() != before:
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            bpy.ops.ed.undo_push(message=message)


def _there():
    return [{each.as_pointer() for each in getattr(bpy.data, name)} for name in LISTS]
