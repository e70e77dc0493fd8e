"""Walk It: which of the selected meshes are walked on, who cannot walk, and what is told of it."""

import ctypes
import os
import sys
import tempfile

import bpy
import numpy as np
from test_bake import refused
from test_refined import plane
from test_walk_it import at, character, select, summary

from desire_path.blender import compat


def heard(call):
    """What Blender prints of its reports while something is called, refused or not."""
    c_flush = ctypes.CDLL(None).fflush if os.name != "nt" else ctypes.cdll.msvcrt.fflush

    def flush():  # some Blenders print by C, some by Python
        sys.stdout.flush()
        c_flush(None)

    with tempfile.TemporaryFile() as file:
        flush()
        kept = os.dup(1)
        os.dup2(file.fileno(), 1)
        try:
            call()
        except RuntimeError:
            pass
        finally:
            flush()
            os.dup2(kept, 1)
            os.close(kept)
        file.seek(0)
        return file.read().decode()


def tile(name, y=0.0, z=0.0, side=4.0):
    made = plane(side=side)
    made.name, made.location = name, (0.0, y, z)
    return made


def cube():
    """As in Blender's default scene."""
    bpy.ops.mesh.primitive_cube_add(size=2.0)
    return bpy.context.object


def walk_it():
    return bpy.ops.object.desire_path_walk_it()


def test_all_selected_tiles_are_walked_on_and_baked_together():
    rig = character()
    tiles = [tile(f"Tile {n}", -1.0 - 4.0 * n) for n in range(3)]
    select(*tiles, rig)
    assert walk_it() == {"FINISHED"}
    assert [each.desire_path.is_ground for each in tiles] == [True] * 3
    assert [each.desire_path.bake_state for each in tiles] == ["FRESH"] * 3
    assert len({each.desire_path.cell_size for each in tiles}) == 1
    assert sum(summary(each)["contacts"] for each in tiles) >= 15
    assert rig.desire_path.ground in tiles


def test_two_walk_on_tiles_of_their_own():
    one, other = character(), character()
    other.location.x = 30.0
    here, there = tile("Here", -5.0, side=16.0), tile("There", -5.0, side=16.0)
    there.location.x = 30.0
    select(there, here, one, other)
    assert walk_it() == {"FINISHED"}
    assert (one.desire_path.ground, other.desire_path.ground) == (here, there)
    assert {here.desire_path.bake_state, there.desire_path.bake_state} == {"FRESH"}


def test_what_lies_above_or_beside_or_is_too_small_is_left_alone():
    rig = character()
    others = [cube(), tile("Aside", 20.0), tile("Crumb", -0.3, side=0.3), tile("Roof", -5.0, 0.8, 30.0)]
    select(*others, rig)
    told = heard(walk_it)
    ground = rig.desire_path.ground
    assert ground is not None and ground not in others and ground.name == "Ground"
    assert not any(each.desire_path.is_ground for each in others)
    assert "'Cube' is not walked on: it lies 1.00 m above the feet." in told, told
    assert "'Aside' is not walked on: the walk passes beside it." in told
    assert "'Crumb' is not walked on: it is 0.3 m wide, which is less than a step." in told
    assert "'Ground' is made to be walked on." in told


def test_the_one_under_the_feet_is_preferred():
    rig = character()
    under, box = tile("Under", -5.0, side=30.0), cube()
    select(under, rig, box)  # the box is the active one
    assert walk_it() == {"FINISHED"}
    assert rig.desire_path.ground == under and not box.desire_path.is_ground


def test_a_faulty_mesh_alone_is_refused_and_nothing_is_told_of_what_was_taken_back():
    rig = character()
    ground = tile("Flipped", -5.0, side=30.0)
    ground.data.flip_normals()
    first = rig.animation_data.action
    select(ground, rig)
    bpy.ops.object.mode_set(mode="POSE")
    told = heard(walk_it)
    assert "flip its normals" in told and "Info:" not in told and "Warning:" not in told, told
    assert bpy.context.mode == "POSE" and bpy.context.object == rig
    assert rig.animation_data.action == first and not ground.desire_path.is_ground and not rig.desire_path.is_walker
    bpy.context.view_layer.update()
    assert np.abs(np.array(rig.matrix_world) - np.eye(4)).max() < 1e-6, rig.matrix_world
    ground.data.flip_normals()
    told = heard(walk_it)
    assert told.count("'Flipped' is a ground") == told.count("is carried ahead") == 1, told


def test_whom_nothing_moves_is_refused():
    rig = character()
    for each in rig.animation_data.nla_tracks:
        each.mute = True
    action = rig.animation_data.action
    known = set(bpy.data.objects)
    for still in ("no action", "muted curves"):
        if still == "no action":
            rig.animation_data.action = None
        else:
            rig.animation_data.action = action
            for curve in compat.curves_played(rig.animation_data):
                curve.mute = True
        select(rig)
        refused(walk_it, f"Nothing moves '{rig.name}': ", "muted; unmute them in")
        assert set(bpy.data.objects) == known and not rig.desire_path.is_walker, still


def test_who_is_turned_over_is_refused():
    rig = character()
    rig.rotation_mode, rig.rotation_euler = "XYZ", (np.pi, 0.0, 0.0)
    known = set(bpy.data.objects)
    select(rig)
    refused(walk_it, "turned over", "turn it so that it stands upright")
    assert set(bpy.data.objects) == known and not rig.desire_path.carried
    rig.rotation_euler = (0.0, 0.0, 0.0)


def test_no_ground_is_made_for_two_at_heights_far_apart():
    one, other = character(), character()
    other.location = (2.0, 0.0, 3.0)
    select(one, other)
    refused(walk_it, "3.00 m higher than", "bring them to one height")
    assert not one.desire_path.carried and not [each for each in bpy.data.objects if each.name == "Ground"]
    bpy.context.view_layer.update()
    assert np.allclose(at(other, 1), (2.0, 0.0, 3.0), atol=1e-6)
