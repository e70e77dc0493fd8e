"""arrival.py - handlers come with the first ground or walker, and go when a file without any is opened.

Before, one handler looks whether a file that was read holds a ground, and one at what was appended or linked, where
Blender tells of that (4.5 and 5.2 do); elsewhere a ground of another file is met by its panel, or by an operator.
"""

import bpy
from bpy.app.handlers import persistent

from . import ops
from .late import handlers

_begun = False


def begin():
    """There is a ground or a walker: look after it from now on."""
    global _begun
    if not _begun:
        _begun = True
        handlers.register()


def end():
    global _begun
    if _begun:
        _begun = False
        handlers.unregister()


def _there():
    return any(
        obj.is_property_set("desire_path") and (obj.desire_path.is_ground or obj.desire_path.is_walker)
        for obj in bpy.data.objects
    )


@persistent
def read(*_):
    """A file was read."""
    there = _there()
    if there:
        begin()
    if _begun:
        handlers.after_load()
    if not there:
        end()


@persistent
def imported(*_):
    """Something of another file was."""
    if _there():
        begin()


def _handlers():
    """(handlers of Blender, ours) of what is told of."""
    pairs = (("load_post", read), ("blend_import_post", imported))
    return [(getattr(bpy.app.handlers, name), ours) for name, ours in pairs if hasattr(bpy.app.handlers, name)]


def register():
    ops.before.insert(0, begin)  # whoever presses a button may make the first ground
    for each, ours in _handlers():
        each.append(ours)
    if hasattr(bpy.data, "objects"):  # not while Blender itself starts
        read()


def unregister():
    end()
    ops.before.remove(begin)
    for each, ours in _handlers():
        each.remove(ours)
