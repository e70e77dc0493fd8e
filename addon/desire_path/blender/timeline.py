"""timeline.py - which frames of a ground are baked, as a bar in the Timeline, the Dope Sheet and the Graph Editor.

faint      the frames it is to be baked over          as Blender shows its point caches, at the lower edge
strong     whole and made from the scene as it is     paler: nobody has looked since something was changed
grey       whole, but outdated                        bright: just being baked, the earlier ones play on
"""

import os

import bpy

from ..bake import contents
from ..bake.folder import frame_name
from . import bake_job, compat, home, playback, state
from .drawing import batch, gpu

RANGE, FRESH, UNSURE, OUTDATED, MAKING = "RANGE", "FRESH", "UNSURE", "OUTDATED", "MAKING"
COLOURS = {  # red, green, blue, alpha
    RANGE: (1.0, 0.55, 0.1, 0.12),
    FRESH: (1.0, 0.55, 0.1, 0.9),
    UNSURE: (1.0, 0.55, 0.1, 0.5),
    OUTDATED: (0.6, 0.6, 0.6, 0.45),
    MAKING: (1.0, 0.85, 0.3, 1.0),
}
HIGH, ABOVE = 4, 16  # of the bar, and of the scroll bar below it [px]
SHOWING = {("PROPERTIES", "WINDOW"), ("VIEW_3D", "UI"), ("DOPESHEET_EDITOR", "WINDOW"), ("GRAPH_EDITOR", "WINDOW")}
EDITORS = ("SpaceDopeSheetEditor", "SpaceGraphEditor")

_handles = {}  # name of an editor -> its draw handler
_read = {}  # bake folder -> when its index was written, and what was read of it


def spans(obj):
    """(kind, first, last scene frame) of each stretch of a ground's bar, in the order they are drawn."""
    settings, found = obj.desire_path, []
    job = _job(obj)
    there = _frames(home.played(obj))
    first, last = (job.bake.frame_start, job.bake.frame_end) if job else (settings.frame_start, settings.frame_end)
    if job is None and there is not None:
        first, last = min(first, there[0]), max(last, there[1])
    found.append((RANGE, first, last))
    if there is not None and there[1] >= there[0]:
        status = state.seen(obj)
        kind = UNSURE if status is None else FRESH if status.state in {state.FRESH, state.PARTIAL} else OUTDATED
        found.append((OUTDATED if job else kind, *there))
    if job is not None and job.frame is not None:
        found.append((MAKING, job.bake.frame_start, job.frame))
    return found


def ground_of(obj):
    """The ground whose bar is shown while an object is active: itself, or the one it walks on; None: there is none."""
    if obj is None or obj.type not in {"MESH", "ARMATURE"}:
        return None
    if obj.desire_path.is_walker:
        obj = obj.desire_path.ground
    return obj if obj is not None and obj.desire_path.is_ground else None


def _job(obj):
    """The bake that is on its way for a ground, or None."""
    return next((job for job in bake_job.in_progress() if obj.name in job.grounds), None)


def _frames(folder):
    """First and last scene frame that play from a bake folder, without a look into every file; None: nothing does."""
    for name in ("frames", os.path.join(contents.NEW, "frames")) if folder else ():
        frames = os.path.join(folder, name)
        try:
            mark = [os.stat(each).st_mtime_ns for each in (os.path.join(frames, "index.json"), frames)]
        except OSError:
            continue
        if _read.get(frames, (None,))[0] != mark:
            _read[frames] = mark, _range(frames)
        return _read[frames][1]
    return None


def _range(frames):
    data = contents.index_data(frames)
    try:
        first, last = int(data["frame_start"]), int(data["frame_end"])
    except (KeyError, TypeError, ValueError):
        return None
    if data.get("complete") is True:
        return first, last
    number = 0
    while first + number <= last and os.path.exists(os.path.join(frames, frame_name(number + 1))):
        number += 1
    return first, first + number - 1


# ---- drawing ------------------------------------------------------------------------------------------------


def _draw():
    context = bpy.context
    obj = ground_of(context.object)
    if obj is None or playback.modifier(obj) is None and _job(obj) is None:
        return
    scale = context.preferences.system.ui_scale
    low = (ABOVE + HIGH * sum(hasattr(each, "point_cache") for each in obj.modifiers)) * scale
    view = context.region.view2d
    shader, room = compat.flat_shader()
    gpu.state.blend_set("ALPHA")
    for kind, first, last in spans(obj):
        left, right = (view.view_to_region(x, 0.0, clip=False)[0] for x in (first - 0.5, last + 0.5))
        left, right = max(left, 0), min(right, context.region.width)
        if right <= left:
            continue
        corners = [(x, y, 0.0)[:room] for x in (left, right) for y in (low, low + HIGH * scale)]
        shader.bind()
        shader.uniform_float("color", COLOURS[kind])
        batch.batch_for_shader(shader, "TRI_STRIP", {"pos": corners}).draw(shader)
    gpu.state.blend_set("NONE")


def redraw():
    """Show in every open editor how far a bake is."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions:
                if (area.type, region.type) in SHOWING:
                    region.tag_redraw()


def show():
    """Draw the bar from now on, where a window is."""
    if bpy.app.background or _handles:
        return
    state.hear()
    for name in EDITORS:
        _handles[name] = getattr(bpy.types, name).draw_handler_add(_draw, (), "WINDOW", "POST_PIXEL")


def hide():
    """Draw it no more."""
    _read.clear()
    while _handles:
        name, handle = _handles.popitem()
        getattr(bpy.types, name).draw_handler_remove(handle, "WINDOW")


def loaded():
    """Another file was read: the bar is drawn if it holds a bake."""
    hide()
    if any(obj.type == "MESH" and playback.modifier(obj) is not None for obj in bpy.data.objects):
        show()
