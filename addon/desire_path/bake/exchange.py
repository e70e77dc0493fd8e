"""How a bake that is whole takes the place of the one that is shown, at one moment.

All names change at one moment, though no system can exchange several names at once: each name that is
shown is first made a link through the one link `bake.shown`, which leads to bake.old, where what it named went
(exchanged with it, so that no name is ever missing and none shows anything new); then `bake.shown` is turned to
bake.new, in one rename; then each name is exchanged for the real file or folder again, and the links go at the end:
who was half way along one when that happened comes by it in bake.new, and through bake.new/bake.shown, which leads
back, to what is shown. A process that is killed in between leaves names that show the old bake, all of it, or the new
one. Every step looks at what is there, so that whoever comes next (a bake, free(), read_index()) takes the same way
from the beginning.
Where the disk cannot exchange names, a folder's own is missing for the time of one rename; where it has no links,
`bake.shown` is a list of what is new and names change one after the other, and whoever comes next ends that.
"""

from __future__ import annotations

import contextlib
import json
import os

from ..errors import DesirePathError
from ..files import disk
from .contents import INSIDE, NAMES, NEW, OLD, SHOWN, delete, is_link, move


def clear(folder: str, name: str) -> None:
    """Delete our files of bake.old or bake.new; others' files in its folders move to those that are shown."""
    top = os.path.join(folder, name)
    for inside in ("frames", "maps"):
        path = os.path.join(top, inside)
        if os.path.islink(path):
            os.unlink(path)
        delete(path, INSIDE[inside])
        if os.path.isdir(path):
            move(path, os.path.join(folder, inside))
    if os.path.islink(os.path.join(top, SHOWN)):
        os.unlink(os.path.join(top, SHOWN))
    delete(top, INSIDE[""])


def exchange(folder: str) -> None:
    """From wherever a publication is to its end."""
    shown = os.path.join(folder, SHOWN)
    if os.path.islink(shown):
        if os.readlink(shown) == OLD:
            for name in NAMES:
                _lead(folder, name)
            turned = f"{shown}.new"
            with contextlib.suppress(FileNotFoundError):
                os.unlink(turned)
            os.symlink(NEW, turned)
            disk.replace(turned, shown)  # this is the moment
        with contextlib.suppress(FileExistsError, FileNotFoundError):
            os.symlink("..", os.path.join(folder, NEW, SHOWN))
        for name in NAMES:
            _settle_name(folder, name)
    else:
        _one_by_one(folder, shown)
    disk.sync_one(folder)
    os.unlink(shown)
    clear(folder, OLD)
    clear(folder, NEW)


def _lead(folder: str, name: str) -> None:
    """Make a name that is shown a link through bake.shown to the same file or folder, in bake.old from now on."""
    here, old = os.path.join(folder, name), os.path.join(folder, OLD, name)
    if is_link(here, name):
        return
    link = f"{SHOWN}/{name}"
    if not os.path.lexists(here):
        if os.path.lexists(os.path.join(folder, NEW, name)) or os.path.lexists(old):
            os.symlink(link, here)
        return
    if is_link(old, name):
        os.unlink(old)  # of a try that was cut off
    os.symlink(link, old)
    if not disk.swap(here, old):
        os.unlink(old)
        disk.replace(here, old)
        os.symlink(link, here)


def _settle_name(folder: str, name: str) -> None:
    """Make a name that is shown the file or folder of bake.new itself again."""
    here, new = os.path.join(folder, name), os.path.join(folder, NEW, name)
    ours, there = is_link(here, name), os.path.lexists(new) and not is_link(new, name)
    if ours and there and disk.swap(here, new):
        return  # the link in bake.new goes with the others
    if there and (ours or not os.path.lexists(here)):
        if os.path.isdir(new) and ours:
            os.unlink(here)  # a folder cannot be renamed to a link's name
        disk.replace(new, here)
    elif ours:
        os.unlink(here)


def _one_by_one(folder: str, shown: str) -> None:
    """The same without links: each name in turn. `shown` lists those of the new bake."""
    try:
        with open(shown, encoding="utf-8") as file:
            fresh = list(json.load(file))
    except (ValueError, TypeError, RecursionError):
        raise DesirePathError(f"{shown} is damaged: delete it, and bake again.") from None
    for name in NAMES:
        here, old, new = (os.path.join(folder, place, name) for place in ("", OLD, NEW))
        waits = os.path.lexists(new)
        if os.path.lexists(here) and not os.path.lexists(old) and (waits or name not in fresh):
            disk.replace(here, old)
        if waits:
            disk.replace(new, here)
