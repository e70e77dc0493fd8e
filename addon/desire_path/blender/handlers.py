"""handlers.py - after loading, undoing and the first save, grounds play what is whole of their bake.

A Blender that was killed in the middle of a bake leaves files that its .blend knows nothing of, and
undo brings back a playback whose files were baked anew. Playing and rendering need no handler, and files without a
ground have none, see arrival.py.
"""

import atexit
from contextlib import suppress

import bpy
from bpy.app.handlers import persistent

from ..bake.bake import read_index
from ..errors import DesirePathError
from . import (
    ground,
    home,
    live,
    op_forces,
    overrides,
    playback,
    playback_tree,
    press_view,
    pressed,
    replant,
    show,
    soils,
    state,
    timeline,
    trash,
    watch,
)

_unsaved = False  # whether the file that is being saved never was before
_played = {}  # name of an image of a bake -> its path, while a file is being saved


def refresh(scene, obj, play=show.play):
    """Let a ground play its bake folder as it is now; nothing to do when it already does."""
    settings = obj.desire_path
    if obj.library is not None:  # its own file looks after it
        return
    home.find(obj)
    if not settings.folder or home.lost(obj):
        return
    ours = playback.modifier(obj)
    try:
        if ours is not None and home.is_own(obj) and trash.back(home.folder(obj), settings.bake_id):
            for image in playback.images(ours.node_group).values():
                image.reload()  # Blender has looked for the files already
        index = read_index(home.folder(obj))
    except DesirePathError:
        return  # its state says so
    if index.owner and settings.bake_id and index.owner != settings.bake_id:
        return  # of another ground, whose folder it is now
    mark = playback.mark(index.folder, index, index.frames)
    if ours is not None and ours.node_group[playback_tree.TAG] == mark or show.plays_on(obj, index):
        return
    box = (index.x0, index.y0, index.x0 + index.nx * index.cell, index.y0 + index.ny * index.cell)
    with suppress(DesirePathError):  # its state says what is wrong
        play(scene, obj, ground.read(scene, obj, index.cell, index.frame_start, box=box))


@persistent
def before_load(*_):
    _played.clear()
    trash.empty()


def after_load():
    op_forces.hide()  # of the file before
    home.forget()
    watch.forget()
    state.doubt()
    overrides.restore()
    for scene in bpy.data.scenes:
        for obj in scene.objects:
            if obj.type == "MESH" and obj.desire_path.is_ground:
                if obj.library is None:
                    soils.refill(obj)
                refresh(scene, obj)
        watch.all_of(scene)
    live.loaded()
    timeline.loaded()


@persistent
def after_undo(*_):
    state.doubt()
    for scene in bpy.data.scenes:
        for obj in scene.objects:
            if obj.type != "MESH" or obj.library is not None:
                continue
            press_view.clear(obj)
            if not obj.desire_path.is_ground:
                continue
            if playback.modifier(obj) is not None:
                refresh(scene, obj, show.again)
            elif home.may_free(obj):
                with suppress(DesirePathError):  # it stays, and nothing shows it
                    trash.again(home.folder(obj), obj.desire_path.bake_id)
            replant.changed(obj)
            watch.mark(obj)


@persistent
def before_save(*_):
    global _unsaved
    after_failed_save()  # of a Blender that does not tell of it
    _unsaved = not bpy.data.filepath
    for obj in bpy.data.objects:
        if obj.type == "MESH" and obj.library is None and obj.desire_path.is_ground and home.is_own(obj):
            home.sign(obj)
    overrides.keep()
    for obj in bpy.data.objects:
        ours = playback.modifier(obj) if obj.type == "MESH" and obj.library is None else None
        if ours is not None:
            there = playback.images(ours.node_group).values()
            _played.update((image.name, image.filepath) for image in there if image.library is None)


@persistent
def after_failed_save(*_):
    """Blender has written the paths of images as seen from where the file was to go, and leaves them so."""
    for name, path in _played.items():
        image = bpy.data.images.get(name)
        if image is not None and image.filepath != path:
            image.filepath = path
    _played.clear()


@persistent
def after_save(*_):
    """A file saved for the first time: what was baked before moves beside it, and the file is to say so."""
    global _unsaved
    _played.clear()
    first, _unsaved = _unsaved and bool(bpy.data.filepath), False
    if bpy.data.filepath:
        trash.empty()
        pressed.tidy()
    there = (
        [
            obj
            for obj in bpy.data.objects
            if obj.type == "MESH"
            and obj.library is None
            and obj.desire_path.is_ground
            and obj.desire_path.bake_id
            and not obj.desire_path.bake_file
        ]
        if first
        else []
    )
    for obj in there:
        with suppress(OSError):  # then it stays where it is
            home.move_in(obj)
    if there:
        with suppress(RuntimeError):  # Blender has said why
            bpy.ops.wm.save_mainfile()


def register():
    watch.register()
    bpy.app.handlers.load_pre.append(before_load)
    atexit.register(trash.empty)
    bpy.app.handlers.save_pre.append(before_save)
    bpy.app.handlers.save_post.append(after_save)
    if hasattr(bpy.app.handlers, "save_post_fail"):  # 3.5 and later
        bpy.app.handlers.save_post_fail.append(after_failed_save)
    bpy.app.handlers.undo_post.append(after_undo)
    bpy.app.handlers.redo_post.append(after_undo)


def unregister():
    live.end()
    timeline.hide()
    state.unregister()
    watch.unregister()
    bpy.app.handlers.redo_post.remove(after_undo)
    bpy.app.handlers.undo_post.remove(after_undo)
    if hasattr(bpy.app.handlers, "save_post_fail"):
        bpy.app.handlers.save_post_fail.remove(after_failed_save)
    bpy.app.handlers.save_post.remove(after_save)
    bpy.app.handlers.save_pre.remove(before_save)
    bpy.app.handlers.load_pre.remove(before_load)
    atexit.unregister(trash.empty)
    trash.empty()
