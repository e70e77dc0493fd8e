"""Arrows of the forces: where they begin, how long they are, and when there are none."""
import bpy
import numpy as np

import desire_path
from desire_path import walker
from desire_path.blender import op_forces, sample
from scenes import meshes, people

operator = bpy.ops.object


def shafts(forces, frame):
    """(start, vector) of each arrow."""
    lines = op_forces.arrows(forces, frame).reshape(-1, 5, 2, 3)
    return [(each[0, 0], each[0, 1] - each[0, 0]) for each in lines]


def standing(frames=24):
    obj = people.biped()
    for frame in (1, frames):
        obj.keyframe_insert("location", frame=frame)
    bpy.context.view_layer.update()
    return obj


def test_one_who_stands_is_carried():
    obj = standing()
    forces, warnings = op_forces.read(bpy.context.scene, obj)
    assert forces.frame_start == 1 and not warnings
    for frame in (1, 12, 23.5, 24):
        found = shafts(forces, frame)
        assert len(found) == 2
        assert abs(sum(v[2] for _, v in found) / forces.reach - 1.0) < 0.02  # body weight, upwards
        for (start, vector), x in zip(found, (0.10, -0.10)):
            assert abs(start[0] - x) < 0.03 and abs(start[2]) < 0.02
            assert np.abs(vector[:2]).max() < 0.1 * vector[2]
    assert 0.4 < forces.reach < 0.8  # of a person of 1.7 m
    assert not len(op_forces.arrows(forces, 0)) and not len(op_forces.arrows(forces, 26))


def test_arrows_are_what_the_loads_say():
    scene = bpy.context.scene
    obj = people.walk(people.biped())
    obj.desire_path.subframes = 2
    forces, _ = op_forces.read(scene, obj)
    gait = sample.record(scene, obj, *sample.frame_range(scene, obj))
    loads = walker.loads(gait)
    counts = set()
    for frame in range(1, 49):
        t = 2 * (frame - 1)
        found = shafts(forces, frame)
        counts.add(len(found))
        total = -loads.force[:, t].sum(axis=0) / (75.0 * 9.81) * forces.reach
        np.testing.assert_allclose(sum(v for _, v in found), total, atol=0.01)
    assert 1 in counts
    # heel and toe press as one, at the point that lies between theirs as their loads do
    weight = np.abs(loads.force[:2, :, 2]) * loads.touching[:2]
    t = int(weight.min(axis=0).argmax())
    assert weight[:, t].min() > 10.0
    wanted = (weight[:, t, None] * loads.point[:2, t]).sum(axis=0) / weight[:, t].sum()
    np.testing.assert_allclose(forces.point[0, t], wanted, atol=2e-3)
    assert np.isnan(forces.point[0, ~loads.touching[:2].any(axis=0)]).all()


def test_in_the_scenes_units_and_on_its_ground():
    scene = bpy.context.scene
    plain, _ = op_forces.read(scene, standing())
    scene.unit_settings.scale_length = 0.01
    ground = meshes.grid(41, 41, 5.0, -100.0, -100.0, height=lambda x, y: 0.0 * x + 30.0)
    operator.desire_path_ground_add()
    obj = people.biped("Cm", 100.0)
    obj.location.z = 30.0
    for frame in (1, 24):
        obj.keyframe_insert("location", frame=frame)
    operator.desire_path_walker_add()
    ground.desire_path.frame_start, ground.desire_path.frame_end = 1, 24
    bpy.context.view_layer.update()
    large, warnings = op_forces.read(scene, obj)
    assert abs(large.reach / plain.reach - 100.0) < 0.1 and not warnings
    for (start, vector), (wanted, along) in zip(shafts(large, 12), shafts(plain, 12)):
        np.testing.assert_allclose(start, 100.0 * wanted + (0, 0, 30.0), atol=0.2)
        np.testing.assert_allclose(vector, 100.0 * along, atol=0.5)


def test_without_a_window_a_sentence():
    obj = standing()
    meshes.activate(obj)
    if bpy.app.background:
        assert operator.desire_path_forces_show() == {"CANCELLED"}
    assert not op_forces.shows(obj) and op_forces._handle is None


def test_nothing_is_left_drawn():
    obj = standing()
    forces, _ = op_forces.read(bpy.context.scene, obj)
    op_forces.show(obj, forces)
    assert op_forces.shows(obj) and op_forces._handle is not None
    meshes.activate(obj)
    assert operator.desire_path_forces_show() == {"FINISHED"}  # hides, wherever it is pressed
    assert not op_forces.shows(obj) and op_forces._handle is None
    op_forces.show(obj, forces)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    assert not op_forces._shown and op_forces._handle is None
    op_forces.show(standing(), forces)
    desire_path.unregister()
    try:
        assert not op_forces._shown and op_forces._handle is None
    finally:
        desire_path.register()
