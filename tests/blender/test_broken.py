"""Scenes that cannot be walked: Walk It says in a sentence what is wrong and how to mend it, before it bakes, and
changes nothing."""

import re

import bpy
import numpy as np
from scenes import meshes
from test_bake import refused
from test_refined import plane
from test_walk_it import character, curve, select


def fine():
    """A character over a plane, both selected."""
    rig, ground = character(), plane(side=12.0)
    select(rig, ground)
    return rig, ground


def _flat(rig, ground):
    ground.scale = (1.0, 0.0, 0.0)


def _upright(rig, ground):
    ground.rotation_euler = (np.pi / 2, 0.0, 0.0)


def _no_faces(rig, ground):
    ground.data.clear_geometry()


def _one_vertex(rig, ground):
    ground.data.clear_geometry()
    ground.data.vertices.add(1)


def _nowhere(rig, ground):
    ground.location.x = float("nan")


def _points_nowhere(rig, ground):
    for vertex in ground.data.vertices:
        vertex.co.z = float("inf")


def _rest(rig, ground):
    rig.data.pose_position = "REST"


def _squashed(rig, ground):
    rig.scale = (1.0, 1.0, 0.0)


def _off(rig, ground):
    rig.location.y = float("inf")


def _held(rig, ground):
    post = bpy.data.objects.new("Post", None)
    bpy.context.scene.collection.objects.link(post)
    rig.constraints.new("COPY_LOCATION").target = post


def _still(rig, ground):
    rig.animation_data_clear()
    bpy.context.scene.frame_end = bpy.context.scene.frame_start


def _bones_left(rig, count):
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    for bone in list(rig.data.edit_bones)[count:]:
        rig.data.edit_bones.remove(bone)
    bpy.ops.object.mode_set(mode="OBJECT")


def _footless(rig, ground):
    _bones_left(rig, 1)
    rig.data.bones[0].name = "stick"


def _boneless(rig, ground):
    _bones_left(rig, 0)


def _edited(rig, ground):
    bpy.ops.object.mode_set(mode="EDIT")


def _nobody(rig, ground):
    select(ground)


def _at_odds(rig, ground):
    other = character()
    other.desire_path.load_model = "impulse"
    select(rig, other, ground)


def _two_ways(rig, ground):
    select(rig, ground, curve((0, 0), (0, -4)), curve((1, 0), (1, -4)))


def _short_way(rig, ground):
    select(rig, ground, curve((0, 0), (0, 0)))


def _no_way(rig, ground):
    way = curve((0, 0), (0, -4))
    way.data.splines.clear()
    select(rig, ground, way)


def _axis_angle(rig, ground):
    rig.rotation_mode = "AXIS_ANGLE"
    select(rig, ground, curve((0, 0), (0, -4)))


def _tiny_cells(rig, ground):
    ground.desire_path.is_ground = True
    ground.desire_path.cell_size = 1e-6


def _no_cells(rig, ground):
    ground.desire_path.is_ground = True
    ground.desire_path.cell_size = -1.0


def _for_ever(rig, ground):
    bpy.context.scene.frame_end = 900000


def _end_before_start(rig, ground):
    ground.desire_path.is_ground = True
    ground.desire_path.frame_start, ground.desire_path.frame_end = 50, 10


def _no_soil_file(rig, ground):
    ground.desire_path.is_ground = True
    ground.desire_path.soil_file = "/nowhere/mine.json"


def _folder_is_file(rig, ground, folder):
    ground.desire_path.is_ground = True
    (folder / "bake").write_text("mine")
    ground.desire_path.folder = str(folder / "bake")


def _folder_of_others(rig, ground, folder):
    ground.desire_path.is_ground = True
    (folder / "bake").mkdir()
    (folder / "bake" / "report.json").write_text("{}")
    ground.desire_path.folder = str(folder / "bake")


def _no_such_bone(rig, ground):
    rig.desire_path.mass_center = "nobody"


def _no_foot(rig, ground):
    foot = rig.desire_path.feet.add()
    foot.limb = "left"


def _sole_without_faces(rig, ground):
    rig.desire_path.sole = meshes.link(bpy.data.objects.new("Sole", bpy.data.meshes.new("Sole")))


def _no_kind(rig, ground):
    ground.desire_path.is_ground = True
    ground.desire_path.plants.add().kind = "triffid"


BROKEN = {
    "the ground is scaled to nothing": (_flat, "scaled to nothing"),
    "the ground stands upright": (_upright, "upright|steep|faces"),
    "the ground has no faces": (_no_faces, "no faces"),
    "the ground is one point": (_one_vertex, "no faces"),
    "the ground is nowhere": (_nowhere, "NaN"),
    "points of the ground are nowhere": (_points_nowhere, "NaN|infinite"),
    "the character is at rest": (_rest, "Rest Position"),
    "the character is squashed": (_squashed, "scaled to nothing"),
    "the character is nowhere": (_off, "NaN|infinite"),
    "the character is held in place": (_held, "holds it"),
    "nothing moves": (_still, "no motion"),
    "the character has no feet": (_footless, "feet|foot"),
    "the character has no bones": (_boneless, "no bones"),
    "the ground is being edited": (_edited, "Edit Mode"),
    "nobody is selected": (_nobody, "Select a character"),
    "characters are loaded in two ways": (_at_odds, "same load model"),
    "there are two curves": (_two_ways, "select the one"),
    "the curve has no length": (_short_way, "no length"),
    "the curve has no points": (_no_way, "no length"),
    "it turns by axis and angle": (_axis_angle, "rotation mode"),
    "cells are too small": (_tiny_cells, "cell"),
    "cells are below nothing": (_no_cells, "[Cc]ell"),
    "the walk lasts for days": (_for_ever, "frames"),
    "the end lies before the start": (_end_before_start, "end after the start"),
    "the soil's file is gone": (_no_soil_file, "mine.json"),
    "the folder is a file": (_folder_is_file, "bake"),
    "the folder is somebody else's": (_folder_of_others, "folder"),
    "the mass centre is no bone": (_no_such_bone, "no bone 'nobody'"),
    "a foot has no bone": (_no_foot, "no foot bone"),
    "the sole has no faces": (_sole_without_faces, "[Ss]ole"),
    "the kind of plant is unknown": (_no_kind, "triffid"),
}


def state():
    """All that Walk It may change."""
    return {
        "objects": sorted(each.name for each in bpy.data.objects),
        "actions": sorted(each.name for each in bpy.data.actions),
        "meshes": sorted((each.name, len(each.vertices)) for each in bpy.data.meshes),
        "settings": sorted(
            (
                each.name,
                each.desire_path.is_ground,
                each.desire_path.is_walker,
                each.desire_path.place_feet,
                each.desire_path.ground.name if each.desire_path.ground else "",
                each.desire_path.cell_size,
                len(each.modifiers),
                each.animation_data.action.name if each.animation_data and each.animation_data.action else "",
                str(tuple(each.location)),
                tuple(each.delta_location),
            )
            for each in bpy.data.objects
        ),
    }


def test_broken_scenes_are_told_and_left_alone(folder):
    wrong = []
    assert len(BROKEN) >= 30
    for number, (name, (breaks, words)) in enumerate(BROKEN.items()):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        rig, ground = fine()
        own = folder / str(number)
        own.mkdir()
        breaks(*(rig, ground, own)[: breaks.__code__.co_argcount])
        bpy.context.view_layer.update()
        before, files = state(), sorted(own.rglob("*"))
        try:
            told = refused(bpy.ops.object.desire_path_walk_it)
            assert re.search(words, told), told
        except AssertionError as problem:
            wrong.append(f"{name}: {problem}")
            continue
        after = state()
        wrong += [f"{name}: {key} {before[key]} -> {after[key]}" for key in before if before[key] != after[key]]
        if sorted(own.rglob("*")) != files:
            wrong.append(f"{name}: files {sorted(own.rglob('*'))}")
    assert not wrong, "\n".join(wrong)
