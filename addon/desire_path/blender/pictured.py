"""pictured.py - kinds of plants as a list with pictures: files of the package, read once somebody sees them."""

import os

import bpy
from bpy.props import EnumProperty

from .late import kinds, previews, tufts

FOLDER = os.path.join(os.path.dirname(__file__), "pictures")  # tests/scenes/kinds.py makes them
OWN = "own"  # stands for a kind that is in a file

_icons = None  # of the pictures, once one was seen
_items = []  # Blender keeps no words of a list that is made while it is drawn


def icon(name):
    """The number of a kind's picture; 0 without one, and where nothing is drawn."""
    global _icons
    if bpy.app.background:
        return 0
    if _icons is None:
        _icons = previews.new()
    if name not in _icons:
        path = os.path.join(FOLDER, f"{name}.png")
        if not os.path.isfile(path):
            return 0
        _icons.load(name, path, "IMAGE")
    return _icons[name].icon_id


def _list(self, _context):
    known = list(kinds.KINDS)
    _items[:] = [(name, tufts.label(name), "", icon(name), number) for number, name in enumerate(known)]
    if self.kind not in kinds.KINDS:
        _items.append((OWN, tufts.label(self.kind) or OWN, "", 0, len(known)))
    return _items


def _get(self):
    known = list(kinds.KINDS)
    return known.index(self.kind) if self.kind in kinds.KINDS else len(known)


def _set(self, number):
    known = list(kinds.KINDS)
    if number < len(known):
        self.kind = known[number]


def choice():
    """A property that shows `kind` of its group by pictures."""
    return EnumProperty(
        name="Kind", items=_list, get=_get, set=_set, options=set(), description="The kind of plant, by its picture"
    )


def unregister():
    global _icons
    if _icons is not None:
        previews.remove(_icons)
        _icons = None
    _items.clear()
