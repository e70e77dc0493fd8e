"""state.py - what has become of a ground's bake: NONE, FRESH, OUTDATED, PARTIAL or MISSING.

    frames/index.json "inputs" <--at the bake-- marks of walk, ground, plants, settings
                               --compared with-- the same, taken anew from the scene
Scripts are told by looking anew every time they ask. A panel may not look while it is drawn: it shows the last
answer, and once something has changed a timer looks again as soon as Blender rests.
"""

import os
import time
from contextlib import contextmanager
from dataclasses import dataclass

import bpy
from bpy.app.handlers import persistent

from ..bake.bake import read_index
from ..errors import DesirePathError
from . import compat, home, inputs, playback, pressed, show, soil_keys
from .chosen import walkers
from .late import track
from .private import looked_at

NONE, FRESH, OUTDATED, PARTIAL, MISSING = STATES = "NONE", "FRESH", "OUTDATED", "PARTIAL", "MISSING"
BAKING = "BAKING"  # of what is baked again by itself; for panels
LOOKS = {  # the word and the icon of each in the panel
    NONE: ("Not Baked", "RADIOBUT_OFF"),
    FRESH: ("Baked", "CHECKMARK"),
    OUTDATED: ("Outdated", "FILE_REFRESH"),
    PARTIAL: ("Partly Baked", "PAUSE"),
    MISSING: ("Files Missing", "ERROR"),
    BAKING: ("Updating", "TIME"),
}
PARTS = {"walk": "the walk", "ground": "the ground", "plants": "the plants", "settings": "the settings"}
REST = 0.3  # without a change before the timer looks [s]
SHARE = 4.0  # looking takes a fifth of the time at most


@dataclass(frozen=True)
class Status:
    """A state and a sentence about it, empty where nothing is to be done."""

    state: str
    text: str = ""


# ---- looking ----------------------------------------------------------------------------------------


def found(obj):
    """What has become of the bake of a ground, looked up anew."""
    settings = obj.desire_path
    plays = playback.modifier(obj) is not None
    if not settings.is_ground or not plays and (not settings.folder or home.lost(obj)):
        return Status(NONE)
    try:
        index = read_index(plays and home.played(obj) or home.folder(obj))
    except DesirePathError as problem:
        return Status(MISSING, str(problem)) if plays else Status(NONE)
    if not plays and (index.frames > 0 or index.owner != settings.bake_id):
        return Status(NONE)
    if not index.complete:
        return Status(MISSING if show.was_complete(index) else PARTIAL, show.missing(index))
    gone = show.lost(index)
    if gone:
        return Status(MISSING, gone)
    text = _changed(obj, index)
    return Status(OUTDATED if text else FRESH, text)


def _changed(obj, index):
    """A sentence about what has changed since a bake; empty where nothing has."""
    if not index.inputs:
        return "This bake does not say what it was made from, as earlier versions did not: bake again."
    scene = _scene_of(obj)
    if pressed.HAND in index.inputs:
        if walkers(scene, obj):
            return f"'{obj.name}' is shown as it was pressed by hand, before anybody walks on it: bake it."
        try:
            return pressed.changed(scene, obj, index) or track.changed(scene, obj, index)
        except DesirePathError as problem:
            return f"The scene has changed since the ground was pressed: {problem}"
    if not walkers(scene, obj) and not home.is_own(obj):
        # who walked is in another file, which tells, or walks on the ground of which this is a copy
        return "This ground was moved since the bake: bake again." if playback.is_moved(obj) else ""
    try:
        with looked_at(*walkers(scene, obj)):
            bpy.context.view_layer.update()
            now, found = inputs.now(scene, obj)
    except DesirePathError as problem:
        return f"The scene has changed since the bake: {problem}"
    changed = [name for name in PARTS if index.inputs.get(name) != now[name]]
    if not changed or changed == ["ground"] and inputs.was_applied(obj, index, now, found):
        return ""
    changed = [PARTS[name] for name in changed]
    text = " and ".join(filter(None, (", ".join(changed[:-1]), changed[-1])))
    one = len(changed) == 1 and not changed[0].endswith("s")
    return f"{text.capitalize()} {'has' if one else 'have'} changed since the bake: bake again."


def _scene_of(obj):
    """The scene that tells about a ground: the one that is shown, unless somebody walks on it in another one only."""
    shown = bpy.context.scene
    there = sorted(obj.users_scene, key=lambda each: (not walkers(each, obj), each != shown))
    return there[0] if there else shown


# ---- for scripts ------------------------------------------------------------------------------------


def ask(obj):
    """The same; an evaluated copy, as drivers have it, is told what was found last."""
    if obj.is_evaluated:
        return _last.get(obj.name_full, (Status(NONE),))[0]
    status = found(obj)
    changes, sentence = refused.get(obj.name_full, (-1, ""))
    if changes == _changes and not status.text and status.state != FRESH:
        status = Status(status.state, sentence)
    note(obj, status)
    return status


# ---- for panels -------------------------------------------------------------------------------------

_last = {}  # name of a ground -> what was found, after which change of the scene, and its glance
_changes, _changed_at = 0, 0.0  # of the scene, since a panel was drawn first
_waiting = set()  # names of grounds to look at
_not_before = 0.0
_deaf = False  # while what happens is no change of the user's
_listener = None  # called after a change
baking = {}  # name of a ground that is baked again by itself -> how far that is
refused = {}  # name of a ground that could not be baked by itself -> after which change of the scene, and why not
held = False  # while live.py looks itself
at_hand = False  # while ground is pressed by hand


def last(obj):
    """What was found last, or None where the timer has to look first. Quick, and changes nothing."""
    if obj.name_full in baking:
        return Status(BAKING, baking[obj.name_full])
    status, changes, glance = _last.get(obj.name_full, (None, -1, None))
    if changes == _changes and glance == _glance(obj):
        return status
    _waiting.add(obj.name_full)
    hear()
    _wake()
    return None


def seen(obj):
    """What was found last, or None where something was changed since. For those who draw often: nobody looks for it."""
    status, changes, _ = _last.get(obj.name_full, (None, -1, None))
    return status if changes == _changes else None


def note(obj, status):
    """Somebody else has looked."""
    _last[obj.name_full] = status, _changes, _glance(obj)


def hear():
    """Count the changes of scenes from now on."""
    if _scene_changed not in bpy.app.handlers.depsgraph_update_post:
        bpy.app.handlers.depsgraph_update_post.append(_scene_changed)


def listen(listener):
    """Have a function called after every change of a scene; None: no more."""
    global _listener
    _listener = listener
    if listener is not None:
        hear()


def changes():
    """A number that is another one after every change of a scene, as far as somebody listens."""
    return _changes


def quiet_for():
    """How long nothing was changed [s]."""
    return time.monotonic() - _changed_at


@contextmanager
def unseen():
    """What is done inside is no change of the user's."""
    global _deaf
    _flush()
    _deaf = True
    try:
        yield
    finally:
        try:
            _flush()
        finally:
            _deaf = False


def _flush():
    """Let handlers hear now of what was changed."""
    windows = bpy.context.window_manager.windows
    for layer in {window.view_layer for window in windows} if len(windows) else (bpy.context.view_layer,):
        layer.update()


def _wake():
    if not bpy.app.timers.is_registered(_look):
        bpy.app.timers.register(_look, first_interval=REST)


def _glance(obj):
    """What can be seen at once of a ground, its walkers and its files."""
    there = [each for each in bpy.data.objects if each.type in {"ARMATURE", "MESH"} and each.desire_path.ground == obj]
    path = home.played(obj)
    ages = []
    for place in ((), ("frames",), ("frames", "index.json"), ("bake.new",)) if path else ():
        try:
            ages.append(os.stat(os.path.join(path, *place)).st_mtime_ns)
        except OSError:
            ages.append(0)
    keyed = soil_keys.names(obj) | set(soil_keys.MASSES)  # those are another number in every frame
    return path, ages, [_numbers(each.desire_path, keyed if soil_keys.keyed(each) else ()) for each in (obj, *there)]


def _numbers(group, but=()):
    """The plain properties of a property group, and of those in its lists, but some."""
    out = []
    for name, each in type(group).__annotations__.items():
        if "get" in each.keywords or name in but:
            continue  # found out each time it is asked for, from what is looked at anyway
        if each.function is bpy.props.CollectionProperty:
            out += [_numbers(one, but) for one in getattr(group, name)]
        elif compat.is_group(each):
            out.append(_numbers(getattr(group, name), but))
        else:
            out.append(getattr(group, name))
    return out


@persistent
def _scene_changed(_scene, depsgraph):
    """Whether anything was changed that may move, shape or time something; a frame that is shown is no change."""
    if _deaf:
        return
    for each in depsgraph.updates:
        if isinstance(each.id, (bpy.types.Scene, bpy.types.Collection)):
            continue
        if each.is_updated_geometry or each.is_updated_transform or not isinstance(each.id, bpy.types.Object):
            doubt()
            _wake()
            return


def doubt():
    """Anything may have changed: undo, another file, a setting."""
    global _changes, _changed_at
    _changes, _changed_at = _changes + 1, time.monotonic()
    if _listener is not None:
        _listener()


def _look():
    """Look at one ground that waits, when Blender rests."""
    global _not_before
    now = time.monotonic()
    if now < max(_not_before, _changed_at + REST) or held or busy():
        return REST
    obj = bpy.data.objects.get(_waiting.pop()) if _waiting else None
    if obj is not None:
        ask(obj)
        _not_before = time.monotonic() + SHARE * (time.monotonic() - now)
    for window in bpy.context.window_manager.windows:  # a panel that is drawn asks again
        for area in window.screen.areas:
            if area.type in {"PROPERTIES", "VIEW_3D"}:
                area.tag_redraw()
    return REST if _waiting else None


def busy(played=False):
    """Whether the user is in the middle of something. played: what plays does not count"""
    if at_hand:
        return True
    for window in bpy.context.window_manager.windows:
        active = window.view_layer.objects.active
        if (
            window.screen.is_animation_playing
            and not played
            or active is not None
            and active.mode == "EDIT"
            or len(getattr(window, "modal_operators", ()))
        ):
            return True
    return False


def unregister():
    if bpy.app.timers.is_registered(_look):
        bpy.app.timers.unregister(_look)
    if _scene_changed in bpy.app.handlers.depsgraph_update_post:
        bpy.app.handlers.depsgraph_update_post.remove(_scene_changed)
    listen(None)
    _last.clear()
    _waiting.clear()
    baking.clear()
    refused.clear()
