"""watch.py - a baked ground that is changed goes on showing its prints where they were pressed.

    a modifier added, moved, switched, applied --> ours goes to its place again, for the points there now
    scale, rotation, location or origin applied --> the points' numbers have changed, not where they are: so do ours

What our tree was made for is kept on it, so that nothing is done where nothing has changed, and undo brings it back.
"""

import json
from contextlib import suppress
from dataclasses import replace

import bpy
import numpy as np
from bpy.app.handlers import persistent

from ..bake.bake import read_index
from ..errors import DesirePathError
from . import axes, compat, cover, ground, home, playback, playback_tree, refined, show, stack, undo_step

NEAR = 1e-5  # points this near to where they were have not moved, in shares of their distance from the origin

_lay = {}  # name of a ground -> its matrix when it was seen last
_edited = set()  # names of grounds whose mesh was changed somehow since they were looked at
_waiting = set()  # names of grounds to look at
_working = False


def look(scene, obj):
    """Let a ground show its bake where it belongs, whatever was done to it since."""
    global _working
    ours = playback.modifier(obj)
    if ours is None:
        playback.sweep()
        return
    if obj.mode == "EDIT" or playback.STACK not in ours.node_group:
        return
    tree, now = ours.node_group, np.array(obj.matrix_world, np.float64)
    before, _lay[obj.name_full] = _lay.get(obj.name_full), now
    baked_at, was = playback.lay_of(tree)
    world = _applied(obj, baked_at, was, before, now)
    _working = True
    try:
        if (
            world is not None
            or tree[playback.STACK] != playback.stacked(obj)
            or tree.get(playback.WISHES, playback.wishes(obj)) != playback.wishes(obj)
            or _edited_since(obj, tree)
        ):
            _again(scene, obj, baked_at if world is None else world)
        elif before is not None and np.array_equal(before, now) and not np.array_equal(was, playback.samples(obj)):
            playback.keep(obj, tree, baked_at)  # the mesh was edited
    finally:
        _working = False


def renew(scene, obj):
    """Something that lies on a ground's mesh was changed: a copy that stands for it is made anew."""
    if _is_ground(obj):
        _edited.add(obj.name_full)
        look(scene, obj)


def _edited_since(obj, tree):
    """Whether the mesh of a ground that a copy stands for was edited since that was made."""
    if obj.name_full not in _edited or obj.mode != "OBJECT" or playback_tree.copy_of(tree) is None:
        return False  # while it is sculpted or painted, it is not asked after every stroke
    _edited.discard(obj.name_full)
    return tree.get(playback.COPIED) != refined.mark(obj)


def _applied(obj, baked_at, was, before, now):
    """The matrix our tree is to be made for, where what an object's transform did was given to its mesh; else None."""
    there = playback.samples(obj)
    if len(there) != len(was) or np.array_equal(there, was):
        return None
    at = axes.points(now, there, 1.0)
    for old in (before, baked_at):
        if old is not None and np.abs(axes.points(old, was, 1.0) - at).max() <= NEAR * np.abs(at).max():
            with suppress(np.linalg.LinAlgError):
                return baked_at @ np.linalg.inv(old) @ now
    return None


def _again(scene, obj, world):
    """Play anew, on a ground that was at a place when it was baked."""
    try:
        index = read_index(home.played(obj))
        surface = ground.read(scene, obj, index.cell, index.frame_start)
        surface = ground.laid(surface, world)
        if playback.interpolates(playback.modifier(obj).node_group):  # as its neighbours may do
            surface = replace(surface, between=True)
        _, sentences = show.play(scene, obj, surface, place=home.place(obj))
        summary = obj.desire_path.summary
        if summary:
            found = json.loads(summary)
            found["warnings"] = [each for each in found["warnings"] if not cover.is_of_points(each)]
            found["warnings"] += [each for each in sentences if cover.is_of_points(each)]
            obj.desire_path.summary = json.dumps(found)
    except DesirePathError:  # the state says what is wrong
        place = stack.find(scene, obj, scene.frame_current)
        ours = playback.modifier(obj)
        compat.move_modifier(obj, ours, place.before)
        playback.keep(obj, ours.node_group, playback.lay_of(ours.node_group)[0])


# ---- handlers -----------------------------------------------------------------------------------------


def _is_ground(obj):
    return obj.type == "MESH" and obj.library is None and obj.desire_path.is_ground


def _grounds(scene):
    return [obj for obj in scene.objects if _is_ground(obj)]


def all_of(scene):
    """Look at all grounds of a scene."""
    for obj in _grounds(scene):
        look(scene, obj)


@persistent
def changed(scene, depsgraph):
    """Something was changed, or another frame is shown."""
    if _working or _renders():
        return
    hit = {each.id.original for each in depsgraph.updates if isinstance(each.id, bpy.types.Object)}
    shaped = {
        each.id.original
        for each in depsgraph.updates
        if isinstance(each.id, bpy.types.Mesh) and each.is_updated_geometry
    }
    edited = [obj for obj in _grounds(scene) if obj.data in shaped] if shaped else []
    _edited.update(obj.name_full for obj in edited)
    for obj in {*edited, *(obj for obj in hit if _is_ground(obj) and obj.name in scene.objects)}:
        if bpy.app.background:
            look(scene, obj)
        else:
            _wait_for(scene, obj)


def mark(obj):
    """Something of a ground was set that its tree is made for; a window looks at it as soon as Blender rests."""
    for scene in () if _working or not _is_ground(obj) else obj.users_scene:
        if bpy.app.background:
            look(scene, obj)
        else:
            _wait_for(scene, obj)


def _wait_for(scene, obj):
    _waiting.add((scene.name, obj.name))
    if not bpy.app.timers.is_registered(_look):
        bpy.app.timers.register(_look, first_interval=0.0)


def _look():
    """Look at what waits, outside of whatever Blender was doing."""
    while _waiting:
        scene, obj = _waiting.pop()
        scene, obj = bpy.data.scenes.get(scene), bpy.data.objects.get(obj)
        if scene is not None and obj is not None:
            with undo_step.where_needed("Prints Shown Anew"):
                look(scene, obj)


def _renders():
    return bpy.app.is_job_running("RENDER")


def forget():
    """Another file was opened."""
    _lay.clear()
    _waiting.clear()
    _edited.clear()


def register():
    bpy.app.handlers.depsgraph_update_post.append(changed)
    bpy.app.handlers.frame_change_post.append(changed)


def unregister():
    if bpy.app.timers.is_registered(_look):
        bpy.app.timers.unregister(_look)
    bpy.app.handlers.frame_change_post.remove(changed)
    bpy.app.handlers.depsgraph_update_post.remove(changed)
    forget()
