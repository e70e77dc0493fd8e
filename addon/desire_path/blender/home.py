"""home.py - where a ground's bake lies, and whose it is.

    //desire_path/<file>/<object>/frames/index.json   "bake_folder_owner": the id kept on the ground
The id belongs to one ground of one file. A file saved under another name, a copy of the object, and a ground
that was appended elsewhere all carry it along: whichever bakes in another place, or second, gets an id and
a folder of its own, so that a bake is replaced and freed by its own ground only.
"""

import contextlib
import os
import posixpath
import shutil
import stat
import tempfile
import uuid

import bpy

from ..bake.folder import owner_of
from ..errors import DesirePathError
from . import auto, playback
from .chosen import grounds

_temporary = ""  # where bakes of files that were never saved go
_holder = {}  # id -> the object that had it first in this session, whatever copies are called
_given = {}  # (file, object) -> the id it was given in this session, which undo may have taken away


def folder(obj):
    """The bake folder of a ground as the system knows it."""
    return os.path.abspath(bpy.path.abspath(obj.desire_path.folder))


def place(obj):
    """The bake folder a ground plays from, as Blender writes paths; empty: none."""
    ours = playback.modifier(obj)
    image = playback.image_of(ours.node_group) if ours is not None else None
    if image is None:
        return ""
    frames = posixpath.dirname(image.filepath.replace(os.sep, "/"))
    above = posixpath.dirname(frames)
    return above if playback.is_published(_absolute(frames, image)) else posixpath.dirname(above)


def played(obj):
    """The same as the system knows it; after its file was saved elsewhere it is another one than its own."""
    found = place(obj)
    return found and _absolute(found, playback.image_of(playback.modifier(obj).node_group))


def _absolute(path, image):
    return os.path.abspath(bpy.path.abspath(path, library=image.library))


def sharing(obj):
    """Other grounds of the file with the same bake folder."""
    own = folder(obj)
    return [
        other
        for scene in bpy.data.scenes
        for other in grounds(scene)
        if other != obj and other.desire_path.folder and folder(other) == own
    ]


def lost(obj):
    """Whether the folder lies beside a file that was never saved."""
    return obj.desire_path.folder.startswith("//") and not bpy.data.filepath


# ---- folders nobody chose ---------------------------------------------------------------------------


def temporary():
    """A folder that only this user can look into, made when it is first needed [path]."""
    global _temporary
    if not _is_private(_temporary):
        _temporary = tempfile.mkdtemp(prefix="desire_path_")
    return _temporary


def _is_private(path):
    try:
        found = os.lstat(path)
    except (OSError, ValueError):
        return False
    mine = not hasattr(os, "getuid") or found.st_uid == os.getuid() and not found.st_mode & 0o077
    return stat.S_ISDIR(found.st_mode) and mine


def leave(path):
    """Take away the folders above one nobody chose that hold nothing any more."""
    with contextlib.suppress(OSError):
        os.rmdir(os.path.dirname(path))  # of the file
        if os.path.dirname(path) != _temporary:
            os.rmdir(os.path.dirname(os.path.dirname(path)))  # `desire_path`


def beside():
    """The folder of a file's bakes as Blender writes paths; a temporary one until it is saved."""
    if not bpy.data.filepath:
        return temporary()
    file = os.path.splitext(os.path.basename(bpy.data.filepath))[0]
    return f"//desire_path/{bpy.path.clean_name(file)}"


def default(obj):
    """Where an object's bake goes when nobody chose: a place that no other bake has."""
    name, own = bpy.path.clean_name(obj.name), obj.desire_path.bake_id
    taken = {
        folder(other)
        for scene in bpy.data.scenes
        for other in grounds(scene)
        if other != obj and other.desire_path.folder
    }
    number = 1
    while True:
        place = f"{beside()}/{name}" + (f"_{number}" if number > 1 else "")
        path = os.path.abspath(bpy.path.abspath(place))
        if path not in taken and (not os.path.lexists(path) or own and owner_of(path) == own):
            return place
        number += 1


def fits(obj):
    """Whether a folder nobody chose may stay: it is this file's, and no other ground has its bake there."""
    settings = obj.desire_path
    return (
        settings.folder.startswith(f"{beside()}/")
        and not sharing(obj)
        and owner_of(folder(obj)) in ("", settings.bake_id)
    )


# ---- whose a bake is --------------------------------------------------------------------------------


def _file():
    return os.path.realpath(bpy.data.filepath) if bpy.data.filepath else ""


def _seen_from(path):
    """Where the file lies, seen from a bake folder: it stays when both are moved."""
    try:
        return os.path.relpath(_file(), os.path.realpath(path)) if bpy.data.filepath else ""
    except ValueError:  # on another drive
        return _file()


def is_own(obj):
    """Whether the id on a ground is its own, and did not come along with a copy of the object or the file."""
    settings = obj.desire_path
    if not settings.bake_id:
        return False
    same_file = (
        settings.bake_file == _file() or bool(settings.bake_seen) and settings.bake_seen == _seen_from(folder(obj))
    )
    return same_file and _first(obj)


def _first(obj):
    """Whether an object is the first of those that carry its id."""
    own = obj.desire_path.bake_id
    there = [
        each
        for each in bpy.data.objects
        if each.type == "MESH"
        and each.library is None
        and each.desire_path.is_ground
        and each.desire_path.bake_id == own
    ]
    holder = _holder.get(own)
    if holder in map(_session, there):
        return _session(obj) == holder
    return len(there) == 1 or obj.name == obj.desire_path.bake_name


def _session(obj):
    """What tells an object from its copies as long as Blender runs."""
    return getattr(obj, "session_uid", 0) or obj.as_pointer()


def may_free(obj):
    """Whether the bake in a ground's folder is its own, or nobody's in a folder chosen by hand."""
    if lost(obj) or sharing(obj):
        return False
    owner = owner_of(folder(obj))
    return owner == obj.desire_path.bake_id and is_own(obj) if owner else not obj.desire_path.folder_auto


def _fresh_id(obj):
    """An id for a ground that has none of its own: the same one again, should it be asked for again."""
    before = obj.desire_path.bake_id
    if before:
        found = uuid.uuid5(uuid.NAMESPACE_URL, f"{before} {_file()} {obj.name}").hex
    else:
        found = _given.setdefault((_file(), obj.name), uuid.uuid4().hex)
    there = {other.desire_path.bake_id for other in bpy.data.objects if other != obj}
    return found if found not in there else uuid.uuid4().hex


def settle(obj):
    """Give a ground an id and a folder of its own, where it has none."""
    settings = obj.desire_path
    if not is_own(obj):
        settings.bake_id = _fresh_id(obj)
    if not settings.folder or settings.folder_auto and not fits(obj):
        auto.set_auto(settings, folder=default(obj))
    settings.bake_file, settings.bake_seen = _file(), _seen_from(folder(obj))
    sign(obj)


def sign(obj):
    """Note which of the objects with this id had it first."""
    obj.desire_path.bake_name = obj.name
    _holder[obj.desire_path.bake_id] = _session(obj)


def claim(obj):
    """The folder a ground may bake into, with an id of its own; or a sentence that says whose it is."""
    settings = obj.desire_path
    settle(obj)
    if lost(obj):
        raise DesirePathError(
            "The folder lies beside a file that was never saved: save the file or choose another folder."
        )
    for other in sharing(obj):
        raise DesirePathError(f"'{other.name}' bakes into the same folder: choose another one for either.")
    if owner_of(folder(obj)) not in ("", settings.bake_id):
        raise DesirePathError(
            f"The folder {folder(obj)} holds the bake of another ground or of another file: choose "
            f"another folder for '{obj.name}'."
        )
    return folder(obj)


def forget():
    """Another file was read."""
    _given.clear()
    _holder.clear()


# ---- the first save ---------------------------------------------------------------------------------


def move_in(obj):
    """Let the bake of a ground whose file was just saved for the first time move beside it."""
    settings = obj.desire_path
    old = folder(obj)
    place = settings.folder
    by_hand = settings.pressed.startswith(f"{place}/")
    there = (by_hand or owner_of(old) == settings.bake_id) and not sharing(obj)
    settings.bake_file = _file()
    settle(obj)
    new = folder(obj)
    if there and new != old:
        os.makedirs(os.path.dirname(new), exist_ok=True)
        shutil.move(old, new)
        playback.repoint(old, settings.folder)
        if by_hand:
            settings.pressed = settings.folder + settings.pressed[len(place) :]
        leave(old)


def find(obj):
    """Go to where the bake was moved, after undo brought back the folder it was in."""
    settings = obj.desire_path
    if settings.folder_auto and settings.bake_id and not fits(obj) and owner_of(folder(obj)) != settings.bake_id:
        old, place = folder(obj), default(obj)
        if owner_of(bpy.path.abspath(place)) == settings.bake_id:
            auto.set_auto(settings, folder=place)
            playback.repoint(old, place)
