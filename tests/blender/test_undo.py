"""Undo finds files that were baked anew: what plays them is what the step holds, for one that came in between would be
gone with the next step, and Blender with it."""

import bpy
from scenes import meshes, people

from desire_path.blender import playback


def baked(folder):
    ground = meshes.grid(60, 130, 0.02, -0.6, -2.2)
    bpy.ops.object.desire_path_ground_add()
    ground.desire_path.folder = str(folder / "bake")
    meshes.activate(people.walk(people.biped(), frames=30))
    bpy.ops.object.desire_path_walker_add()
    bpy.context.object.desire_path.ground = ground
    meshes.activate(ground)
    return ground


def bake(message):
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.ops.ed.undo_push(message=message)


def other_steps():
    """Steps in which the ground is the same: Blender leaves it as it is then."""
    bpy.context.collection.objects.link(bpy.data.objects.new("Other", None))
    for step in range(3):
        bpy.data.objects["Other"].location.x = step
        bpy.ops.ed.undo_push(message=f"Step {step}")


def step(which):
    """Undo or redo; (the images that are played, whether they are seen)."""
    assert which() == {"FINISHED"}
    ours = playback.modifier(bpy.data.objects["Ground"])
    bpy.context.scene.frame_set(20)
    return sorted(playback.images(ours.node_group)), ours.show_viewport and ours.show_render


def there_and_back(then, now):
    undo, redo = bpy.ops.ed.undo, bpy.ops.ed.redo
    assert [step(each) for each in (undo, undo, undo)] == [then] * 3
    assert [step(each) for each in (redo, redo, redo)] == [then, then, now]
    assert [step(each) for each in (undo, undo)] == [then] * 2


def test_a_walk_without_plants_plays_of_one_with_them(folder):
    baked(folder)
    bake("bare")
    other_steps()
    bpy.ops.object.desire_path_plants_add()
    bake("planted")
    there_and_back((["trail"], True), (["lean", "trail"], True))


def test_what_cannot_play_is_hidden_until_it_is_baked_again(folder):
    ground = baked(folder)
    bpy.ops.object.desire_path_plants_add()
    bake("planted")
    other_steps()
    bpy.ops.object.desire_path_plants_remove()
    bake("bare")
    assert not ground.desire_path.plants
    there_and_back((["lean", "trail"], False), (["trail"], True))
    ground = bpy.data.objects["Ground"]
    assert ground.desire_path.bake_state == "OUTDATED"
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    ours = playback.modifier(ground)
    assert ours.show_viewport and ours.show_render and sorted(playback.images(ours.node_group)) == ["lean", "trail"]
