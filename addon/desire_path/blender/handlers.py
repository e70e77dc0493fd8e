"""handlers.py - after loading and undoing, grounds play what is whole of their bake.

A Blender that was killed in the middle of a bake leaves files that its .blend knows nothing of, and
undo brings back a playback whose files were baked anew. Playing and rendering need no handler.
"""
import os
from contextlib import suppress

import bpy
from bpy.app.handlers import persistent

from ..errors import DesirePathError
from . import ground, op_forces, op_plants, playback, show


def refresh(scene, obj):
    """Let a ground play its bake folder as it is now; nothing to do when it already does."""
    from ..bake import read_index
    settings = obj.desire_path
    if obj.library is not None:  # its own file looks after it
        return
    if not settings.folder or settings.folder.startswith("//") and not bpy.data.filepath:
        return
    try:
        index = read_index(show.folder(obj))
    except DesirePathError as problem:
        ours = playback.modifier(obj)
        if ours is not None and not _plays_from_elsewhere(obj, ours):
            settings.missing = str(problem)
        return
    ours = playback.modifier(obj)
    mark = playback.mark(index.folder, index, index.frames)
    if ours is not None and ours.node_group[playback.TAG] == mark:
        settings.missing = show.missing(index)
        return
    try:
        box = (index.x0, index.y0, index.x0 + index.nx * index.cell,
               index.y0 + index.ny * index.cell)
        surface = ground.read(scene, obj, index.cell, index.frame_start, box=box)
        show.play(obj, surface)
    except DesirePathError as problem:
        settings.missing = str(problem)


def _plays_from_elsewhere(obj, ours):
    """Whether the frames are there, but not in the object's folder: the file was saved to another
    place, and Blender keeps the way to its images."""
    image = playback.image_of(ours.node_group)
    path = os.path.abspath(bpy.path.abspath(image.filepath)) if image is not None else ""
    return os.path.exists(path) and not path.startswith(show.folder(obj) + os.sep)


@persistent
def after_load(*_):
    op_forces.hide()  # of the file before
    for scene in bpy.data.scenes:
        for obj in scene.objects:
            if obj.type == "MESH" and obj.desire_path.is_ground:
                refresh(scene, obj)


@persistent
def after_undo(*_):
    for scene in bpy.data.scenes:
        for obj in scene.objects:
            if (obj.type == "MESH" and obj.desire_path.is_ground
                    and playback.modifier(obj) is not None):
                refresh(scene, obj)
            if obj.type == "MESH" and obj.desire_path.is_ground and obj.library is None:
                with suppress(DesirePathError):  # the next bake says what is wrong
                    op_plants.refresh(scene, obj)


def register():
    bpy.app.handlers.load_post.append(after_load)
    bpy.app.handlers.undo_post.append(after_undo)
    bpy.app.handlers.redo_post.append(after_undo)
    if hasattr(bpy.data, "scenes"):  # not while Blender itself starts
        after_load()


def unregister():
    bpy.app.handlers.redo_post.remove(after_undo)
    bpy.app.handlers.undo_post.remove(after_undo)
    bpy.app.handlers.load_post.remove(after_load)
