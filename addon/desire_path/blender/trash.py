"""trash.py - freed bakes lie beside their folder, as `<folder>.freed`, until the file is saved or closed.

So undo brings them back; redo puts them aside again.
"""

import os
from contextlib import suppress

from ..bake import output
from ..errors import DesirePathError

_freed = {}  # bake folders that were freed in this session -> how to leave them when they are empty


def _aside(folder):
    return folder + ".freed"


def free(folder, owner, leave):
    """Put a bake aside. leave: takes away the folders above that hold nothing any more"""
    drop(folder)
    _freed[folder] = leave
    output.free(folder, owner, _aside(folder) if owner else "")
    leave(folder)


def again(folder, owner):
    """Put a bake aside again whose freeing was undone and redone."""
    if folder in _freed and owner and output.owner_of(folder) == owner:
        output.free(folder, owner, _aside(folder))


def back(folder, owner):
    """Bring a bake back that a ground plays and that was put aside; returns whether there was one."""
    return bool(owner) and os.path.isdir(_aside(folder)) and output.bring_back(_aside(folder), folder, owner)


def drop(folder):
    """Delete what was put aside from one folder."""
    output.free(_aside(folder))
    _freed.pop(folder, str)(folder)


def empty():
    """Delete all that was put aside in this session."""
    for folder in list(_freed):
        with suppress(DesirePathError):  # it does no harm where it is
            drop(folder)
    _freed.clear()
