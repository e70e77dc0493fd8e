"""Walk It records a walk once, and what was recorded serves all who ask; bare ground looks like its soil."""

import os

import bpy
import numpy as np
from scenes import meshes
from test_refined import copy_of, plane
from test_underfoot import heard
from test_walk_it import character, curve, hill, select, summary

from desire_path.bake.bake import read_index
from desire_path.bake.contents import MAPS_ALWAYS
from desire_path.blender import forward, home, materials, recordings, sample
from desire_path.ground import maps


def counted(*selected, fresh=False):
    """(the recordings that Walk It makes, the summary of its ground); fresh: none of them is kept"""
    made, real, kept = [], sample.record, recordings._kept
    sample.record = lambda *asked, **more: made.append((asked[2:4], len(asked) > 5)) or real(*asked, **more)
    keys = recordings._depends
    if fresh:
        recordings._depends = lambda *_: (object(),)
    try:
        select(*selected)
        assert bpy.ops.object.desire_path_walk_it() == {"FINISHED"}
    finally:
        sample.record, recordings._depends = real, keys
    assert recordings._kept is kept is None  # nothing outlives the button
    found = summary(next(each for each in selected if each.type == "ARMATURE").desire_path.ground)
    return made, {name: value for name, value in found.items() if name != "seconds_in_all"}


def level():
    return [character()]


def crossed():
    """Two grounds that one walk crosses, two characters."""
    one, other = character(), character()
    other.location.x = 0.5
    for y in (-6.0, -11.0):
        made = plane(side=1.0)
        made.scale, made.location.y = (3.0, 2.5, 1.0), y + 5.0
    bpy.context.view_layer.update()
    return [one, other, *(each for each in bpy.data.objects if each.type == "MESH" and each.parent is None)]


def hilly():
    return [character(), hill(lambda x, y: 0.3 * np.sin(y))]


def elsewhere():
    """Who is carried along one line already goes along another one that is as long."""
    rig = character()
    forward.carry(bpy.context.scene, rig, np.array([(0.0, 0.0), (0.0, 2.0), (2.0, 2.0)]))
    return [rig, curve((0.0, 0.0), (0.0, -2.0), (-2.0, -2.0))]


def test_the_clip_and_the_walk_are_recorded_once_each():
    # placed feet are another walk, then on their slopes; what went along a curve before did so for as many frames
    for setting, wanted in ((level, 2), (crossed, 4), (hilly, 4), (elsewhere, 3)):
        prints = []
        for fresh in (False, True):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            made, found = counted(*setting(), fresh=fresh)
            assert fresh or len(made) == wanted, (setting.__name__, made)
            assert not fresh or len(made) > wanted, (setting.__name__, made)
            prints.append((found, marks()))
        assert prints[0] == prints[1], setting.__name__


def marks():
    """What each ground was baked from, and what came of it."""
    out = []
    for each in sorted((obj for obj in bpy.data.objects if obj.desire_path.is_ground), key=lambda obj: obj.name):
        index = read_index(home.folder(each))
        final = maps.read(os.path.join(os.path.dirname(index.folder), MAPS_ALWAYS[1]))
        out.append((index.inputs, {name: plane.tobytes() for name, plane in final.planes.items()}))
    return out


def test_a_ground_without_a_material_looks_like_its_soil():
    rig, land = character(), hill(lambda x, y: 0.0 * x)
    land.data.materials.append(None)
    select(rig, land)
    told = heard(bpy.ops.object.desire_path_walk_it)
    assert [each.name for each in land.data.materials] == ["Desire Path Sand"], land.data.materials[:]
    assert told.rstrip().endswith("'Ground' is made of 'Desire Path Sand'."), told
    assert copy_of(land).data.materials[0] == land.data.materials[0]
    assert land.desire_path.bake_state == "FRESH"


def test_what_is_made_to_be_walked_on_has_a_material_and_undo_takes_both():
    rig = character()
    select(rig)
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.object.desire_path_walk_it("EXEC_DEFAULT", True) == {"FINISHED"}
    land = bpy.data.objects["Rig"].desire_path.ground
    assert materials.is_ours(land.data.materials[0]) and land.desire_path.bake_state == "FRESH"
    bpy.ops.ed.undo()
    assert "Ground" not in bpy.data.objects and not [each for each in bpy.data.materials if materials.is_ours(each)]


def test_a_material_of_the_users_is_not_touched():
    rig, land = character(), plane(side=8.0)
    own = bpy.data.materials.new("Own")
    own.use_nodes = True
    land.data.materials.append(None)
    land.data.materials.append(own)
    nodes = len(own.node_tree.nodes)
    select(rig, land)
    assert "is made of" not in heard(bpy.ops.object.desire_path_walk_it)
    assert land.data.materials[:] == [None, own] and len(own.node_tree.nodes) == nodes
    assert not [each for each in bpy.data.materials if materials.is_ours(each)]


def test_what_cannot_be_given_a_material_is_walked_on_and_told(folder):
    path = str(folder / "library.blend")
    bpy.data.libraries.write(path, {plane(side=8.0).data})
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (there, here):
        here.meshes = there.meshes
    rig, land = character(), meshes.link(bpy.data.objects.new("Land", here.meshes[0]))
    select(rig, land)
    told = heard(bpy.ops.object.desire_path_walk_it)
    assert "is linked from another file and has no material slot" in told, told
    assert rig.desire_path.ground == land and land.desire_path.bake_state == "FRESH", told
