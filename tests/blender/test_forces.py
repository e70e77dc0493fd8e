"""Arrows of the forces: where they begin, how long they are, and when there are none."""

import json

import bpy
import numpy as np
from scenes import meshes, people

import desire_path
from desire_path.blender import force_graph, moves, op_forces, sample
from desire_path.loads import report, walker

operator = bpy.ops.object


def read(scene, obj):
    found = op_forces.read(scene, obj)
    return found.forces, found.warnings


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
    forces, warnings = read(bpy.context.scene, obj)
    assert forces.frame_start == 1 and not warnings
    for frame in (1, 12, 23.5, 24):
        found = shafts(forces, frame)
        assert len(found) == 2
        assert abs(sum(v[2] for _, v in found) / forces.weight_length - 1.0) < 0.02  # body weight, upwards
        for (start, vector), x in zip(found, (0.10, -0.10)):
            assert abs(start[0] - x) < 0.03 and abs(start[2]) < 0.02
            assert np.abs(vector[:2]).max() < 0.1 * vector[2]
    assert 0.4 < forces.weight_length < 0.8  # of a person of 1.7 m
    assert not len(op_forces.arrows(forces, 0)) and not len(op_forces.arrows(forces, 26))


def test_arrows_are_what_the_loads_say():
    scene = bpy.context.scene
    obj = people.walk(people.biped())
    obj.desire_path.subframes = 2
    forces, _ = read(scene, obj)
    gait = sample.record(scene, obj, *moves.frame_range(scene, obj))
    loads = walker.loads(gait)
    counts = set()
    for frame in range(1, 49):
        t = 2 * (frame - 1)
        found = shafts(forces, frame)
        counts.add(len(found))
        total = -loads.force[:, t].sum(axis=0) / (75.0 * 9.81) * forces.weight_length
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
    plain, _ = read(scene, standing())
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
    large, warnings = read(scene, obj)
    assert abs(large.weight_length / plain.weight_length - 100.0) < 0.1 and not warnings
    for (start, vector), (wanted, along) in zip(shafts(large, 12), shafts(plain, 12)):
        np.testing.assert_allclose(start, 100.0 * wanted + (0, 0, 30.0), atol=0.2)
        np.testing.assert_allclose(vector, 100.0 * along, atol=0.5)


def test_the_mass_centre_and_where_feet_press():
    forces, _ = read(bpy.context.scene, standing())
    lines = op_forces.mass_marks(forces, 12)
    centre = forces.mass[11]
    plumb = lines[3 * 2 * op_forces.ROUND :][:2]
    np.testing.assert_allclose(plumb, [centre, (centre[0], centre[1], 0.0)], atol=1e-6)
    assert 0.7 < centre[2] < 1.2
    around = np.linalg.norm(lines[: 2 * op_forces.ROUND] - centre, axis=1)
    np.testing.assert_allclose(around, around[0], rtol=1e-4)
    marks = op_forces.pressure_marks(forces, 12)
    assert len(marks) == 2 * (2 * op_forces.ROUND + 2)  # a ring for each foot, and the cross
    # one who stands presses below the mass centre
    np.testing.assert_allclose(marks[-4:].mean(axis=0), (centre[0], centre[1], 0.0), atol=0.02)
    for each in (op_forces.mass_marks, op_forces.pressure_marks):
        assert not len(each(forces, 0)) and not len(each(forces, 26))


def test_the_graph_shows_what_the_loads_say():
    scene = bpy.context.scene
    obj = people.walk(people.biped())
    found = op_forces.read(scene, obj)
    made = force_graph.layout(found.forces, "Walker", 20, (900, 700), 1.0)
    x, y, width, height = made.paper
    curves = [points for points, _, size in made.lines if size == 2.0]
    assert len(curves) == 2
    body = next(
        points[0][1] for points, colour, _ in made.lines if colour == force_graph.INK and points[0][1] == points[1][1]
    )
    zero = next(y for _, y, text, _, _ in made.labels if text == "0") + 4.0
    vertical = -np.array([found.loads.force[found.gait.part_limb == k, :, 2].sum(axis=0) for k in (0, 1)])
    for curve, force in zip(curves, vertical / (75.0 * 9.81)):
        assert (curve[:, 0] >= x).all() and (curve[:, 0] <= x + width).all()
        assert (curve[:, 1] >= y - 1e-6).all() and (curve[:, 1] <= y + height).all()
        np.testing.assert_allclose((curve[:, 1] - zero) / (body - zero), force, atol=1e-6)
    assert len(made.bands) == op_forces.keep(obj, found)["contacts"]
    now = next(points[0][0] for points, colour, _ in made.lines if colour == (1.0, 1.0, 1.0, 0.9))
    assert abs(now - np.interp(20, range(1, 49), curves[0][:, 0])) < 1e-6
    texts = [each[2] for each in made.labels]
    assert {"foot.L", "foot.R", "frame"} <= set(texts) and any("body weights" in each for each in texts)
    # in a small region there is none, and several lie one over the other
    assert not force_graph.layout(found.forces, "Walker", 20, (900, 100), 1.0).lines
    assert force_graph.layout(found.forces, "Walker", 20, (900, 700), 1.0, 1).paper[1] > y + height


def test_the_report_is_told_and_written(folder):
    obj = people.walk(people.biped())
    meshes.activate(obj)
    assert operator.desire_path_forces_report() == {"FINISHED"}
    told = json.loads(obj.desire_path.forces)
    found = op_forces.read(bpy.context.scene, obj)
    assert told["contacts"] == len(report.contacts(found.gait, found.loads)) and told["walker"] == "Walker"
    assert 0.8 < told["mean_force_bw"] < 1.2 and not list(folder.iterdir())
    assert operator.desire_path_forces_write(directory=str(folder / "tables")) == {"FINISHED"}
    assert {each.name for each in (folder / "tables").iterdir()} == {"loads.csv", "contacts.csv"}
    with open(folder / "tables" / "contacts.csv", encoding="utf-8") as file:
        assert len(file.readlines()) == told["contacts"] + 1
    obj.desire_path.mass = -1.0
    try:
        operator.desire_path_forces_report()
    except RuntimeError as problem:
        assert "-1 kg" in str(problem)
    else:
        raise AssertionError("not refused")


def test_without_a_window_a_sentence():
    obj = standing()
    meshes.activate(obj)
    if bpy.app.background:
        assert operator.desire_path_forces_show() == {"CANCELLED"}
        assert operator.desire_path_forces_graph() == {"CANCELLED"}
    assert not op_forces.shows(obj) and not op_forces._handles


def test_nothing_is_left_drawn():
    obj = standing()
    forces, _ = read(bpy.context.scene, obj)
    op_forces.show(obj, forces)
    assert op_forces.shows(obj) and op_forces._handles
    meshes.activate(obj)
    assert operator.desire_path_forces_show() == {"FINISHED"}  # hides, wherever it is pressed
    assert not op_forces.shows(obj) and not op_forces._handles
    op_forces.show(obj, forces)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    assert not op_forces._shown and not op_forces._handles
    op_forces.show(standing(), forces)
    desire_path.unregister()
    try:
        assert not op_forces._shown and not op_forces._handles
    finally:
        desire_path.register()
