"""show.py - what a ground plays of the bake in its folder, and how it is given back as it was."""

import os

import bpy

from ..bake.bake import read_index
from ..bake.contents import MAPS_ALWAYS, is_complete
from ..errors import DesirePathError
from . import (
    cover,
    ground,
    home,
    materials,
    plants,
    playback,
    playback_tree,
    pressed,
    refined,
    sprays,
    stems,
    surfaces,
    trash,
)
from .home import folder


def play(scene, obj, surface, baked=None, place=""):
    """Play the bake in the object's folder, as far as it is whole. Returns its FrameIndex and
    sentences about what could not be written.

    baked: the final maps by name, where the bake was made just now and is whole; place: another folder, as Blender
    writes paths
    """
    settings = obj.desire_path
    place = place or settings.folder
    path = os.path.abspath(bpy.path.abspath(place))
    index = read_index(path, just_baked=baked is not None)
    cover.remove(obj)
    materials.refresh(obj)
    if index.frames:
        standing = plants.standing(obj)
        depth = cover.make_groups(obj) if settings.vertex_group else 0.0
        frames = playback.join(place, *os.path.relpath(index.folder, path).split(os.sep))
        planes = surfaces.with_progress(baked or cover.planes(index))
        copy = refined.make(scene, obj, surface, index, planes, standing, _copy(obj))
        carrier = copy and copy.object
        moved = playback_tree.MOVED in planes
        playing = as_read(surface, index, carrier, layer_depth=depth, standing=standing, moved=moved)
        playback.attach(obj, frames, playing)
        warnings = cover.fill(obj, surface, index, depth, planes, standing)
        if carrier is not None:
            playback.modifier(obj).node_group[playback.COPIED] = refined.mark(obj)
        if copy is not None:
            warnings += copy.warnings
        if carrier is None and index.complete:
            warnings += cover.few_points(obj, surface, index, planes)
    else:
        playback.detach(obj)
        warnings = []
    plants.show(obj, index)
    stems.remove(plants.grass.of(settings.plant_object, obj))
    settings.plant_object = stems.show(obj, place, path, index.frame_start, surface.scale) if index.complete else None
    frames = playback.join(place, *os.path.relpath(index.folder, path).split(os.sep))
    old = plants.grass.of(settings.spray_object, obj)
    settings.spray_object = sprays.show(obj, frames, index, surface.scale, old)
    return index, warnings


def as_read(surface, index, carrier, **more):
    """How the frames of an index are played on a ground that was read; carrier: the object of its copy, or None."""
    points = (surface.vertices, surface.drawn)
    smooth = (
        carrier is not None
        or surface.between
        or any(ground.smooth(each, index.cell, (index.x0, index.y0)) for each in points)
    )
    return playback_tree.Playing(
        index,
        count=index.frames,
        world=surface.world,
        scale=surface.scale,
        smooth=smooth,
        corners=surface.corners,
        place=surface.place,
        copy=carrier,
        **more,
    )


def again(scene, obj, surface):
    """Let the tree that undo has brought back play the files that are there now, with the datablocks that are there;
    where it cannot, it is hidden. Undo steps know no datablock that comes between two of them."""
    settings, ours = obj.desire_path, playback.modifier(obj)
    index = read_index(folder(obj))
    had = playback_tree.copy_of(ours.node_group) is not None
    if not index.frames or had and _copy(obj) is None:
        playback.show(ours, False)
        return
    frames = playback.join(settings.folder, *os.path.relpath(index.folder, folder(obj)).split(os.sep))
    planes, standing = surfaces.with_progress(cover.planes(index)), plants.standing(obj)
    copy = refined.make(scene, obj, surface, index, planes, standing, _copy(obj)) if had else None
    carrier = copy and copy.object
    depth = cover.make_groups(obj) if settings.vertex_group else 0.0
    moved = playback_tree.MOVED in planes
    playing = as_read(surface, index, carrier, layer_depth=depth, standing=standing, moved=moved)
    if had == (carrier is not None) and playback.attach(obj, frames, playing, anew=False):
        cover.fill(obj, surface, index, depth, planes, standing)
        plants.show(obj, index, anew=False)
    else:
        playback.show(ours, False)


def _copy(obj):
    """The refined copy a ground shows that nothing else does, or None."""
    ours = playback.modifier(obj)
    copy = playback_tree.copy_of(ours.node_group) if ours is not None and ours.node_group.users == 1 else None
    return copy if copy is not None and copy.users == 1 and copy.data.users == 1 else None


def plays_on(obj, index):
    """Whether a ground goes on with what it plays: the whole bake in its folder, whose index this is, or a whole one
    from elsewhere as long as the one in its folder is not."""
    ours, place = playback.modifier(obj), home.played(obj)
    if ours is None or not place:
        return False
    if place == folder(obj):
        return index.complete and ours.node_group[playback_tree.TAG] == playback.mark(index.folder, index, index.frames)
    try:
        return not index.complete and read_index(place).complete
    except DesirePathError:
        return False


def show_plants(obj):
    """Let the grass of a ground follow what it plays."""
    plants.show(obj, read_index(folder(obj)) if playback.modifier(obj) is not None else None)


def missing(index):
    """What a stopped bake lacks, in one sentence; empty for a whole one."""
    if index.complete:
        return ""
    if not index.frames:
        return "The last bake was stopped before its first frame, or has lost it since: bake again."
    last = index.frame_start + index.frames - 1
    if not index.missing:
        return (
            f"The last bake was stopped when its frames {index.frame_start} to {last} were there, before its maps "
            "were: bake again to go on."
        )
    return (
        f"The last bake was stopped, or lost files since: frames {index.frame_start} to {last} play, "
        f"{last + 1} to {index.frame_end} are missing or damaged; bake again to go on."
    )


def lost(index):
    """What is gone from beside the frames of a whole bake, in one sentence; empty where nothing is."""
    above = os.path.dirname(index.folder)
    gone = [name for name in MAPS_ALWAYS if not os.path.exists(os.path.join(above, name))]
    return (
        f"{' and '.join(gone)} of the last bake {'is' if len(gone) == 1 else 'are'} gone: bake again." if gone else ""
    )


def was_complete(index):
    """Whether a bake came to its end, whatever has become of its files."""
    return is_complete(index.folder)


def free(obj):
    """Give the mesh back as it was and delete the files of its bake; those of another ground or file stay."""
    settings = obj.desire_path
    if settings.folder and home.may_free(obj):  # first: it may be refused
        trash.free(folder(obj), settings.bake_id, home.leave if settings.folder_auto else str)
    playback.detach(obj)
    plants.show(obj)
    stems.remove(plants.grass.of(settings.plant_object, obj))
    sprays.remove(plants.grass.of(settings.spray_object, obj))
    cover.remove(obj)
    materials.forget(obj)
    pressed.forget(obj)
    settings.summary = ""
