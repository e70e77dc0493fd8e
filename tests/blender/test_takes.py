"""Where another take begins at once, the one before is recorded to its end, though no frame shows it."""

import math

import bpy
import numpy as np
from scenes import meshes, people

from desire_path.blender import compat, moves, sample, seams
from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import Soil
from desire_path.loads import walker

ASIDE = 2.0  # [m]
CELL = 0.02


def recording():
    """A recorded walk of 86 frames, at 30 a second."""
    return people.bvh(people.SCENES / "walks" / "cmu_02_01_walk_mixamo_cm_30fps.bvh", global_scale=0.01)


def clip(obj=None):
    """A walker with a clip that is played by no action."""
    obj = obj or people.walk(people.biped(), frames=40)
    data = obj.animation_data
    action, slot = data.action, getattr(data, "action_slot", None)
    data.action = None
    return obj, action, slot


def strip(obj, action, slot, start, **numbers):
    made = obj.animation_data.nla_tracks.new().strips.new("take", round(start), action)
    if slot is not None and made.action_slot is None:
        made.action_slot = slot
    for name, value in numbers.items():
        setattr(made, name, value)
    return made


def second_half(obj, action, slot, first, last):
    part = {"action_frame_start": first, "action_frame_end": last, "frame_end": last}
    return strip(obj, action, slot, first, **part, extrapolation="HOLD_FORWARD")


def carried(obj, at):
    """On a carrier that goes aside at once at a frame."""
    carrier = meshes.link(bpy.data.objects.new("Carrier", None))
    obj.parent = carrier
    for frame, x in ((1, 0.0), (at, ASIDE)):
        carrier.location.x = x
        carrier.keyframe_insert("location", index=0, frame=frame)
    for curve in compat.curves_played(carrier.animation_data):
        for key in curve.keyframe_points:
            key.interpolation = "CONSTANT"


def recorded(obj, first, last):
    return sample.gaits(bpy.context.scene, [obj], first, last)


def prints(gait):
    gait = gait.resample(120.0)
    land = Simulation(Ground.heights(np.zeros((300, 300)), CELL, -2.0, -4.0), Soil(), CELL)
    land.load(gait, walker.loads(gait, ground=land.rest_height))
    land.run(len(gait.time) - 1)
    return land.read("compression", -100, -200, 300, 300)


def test_rounds_of_a_repeated_strip_press_as_the_clip_alone():
    for start in (1, 5):
        obj, action, slot = clip(recording())
        first = strip(obj, action, slot, start)
        alone = prints(recorded(obj, start, start + 85))
        assert alone.max() > 5e-3
        first.repeat = 2.0
        carried(obj, start + 85)
        gait = recorded(obj, start, start + 170)
        assert len(gait.cut) == 1 and "taken as a cut" in " ".join(gait.warnings)
        assert abs(gait.frame(gait.cut[0] - 1) - (start + 85 - seams.ASIDE)) < 1e-6
        pressed = prints(gait)
        for back in (0, -round(ASIDE / CELL)):
            assert abs(np.roll(pressed, back, axis=1) - alone)[alone > 1e-4].max() < 1e-3, (start, back)
        bpy.ops.wm.read_factory_settings(use_empty=True)


def test_rounds_that_begin_between_frames_press_as_the_clip_alone():
    """A clip whose length is no whole number of frames is looked at by its own poses in every round."""
    for last, scale in ((75.3, 1.0), (86, 0.93), (60.7, 0.8)):
        obj, action, slot = clip(recording())
        first = strip(obj, action, slot, 1, action_frame_end=last, scale=scale)
        length = first.frame_end - first.frame_start
        alone = prints(recorded(obj, 1, math.ceil(1 + length)))
        first.repeat = 2.0
        carried(obj, 1 + length)
        gait = recorded(obj, 1, math.ceil(1 + 2 * length))
        assert len(gait.cut) == 1, gait.warnings
        pressed = prints(gait)
        for back in (0, -round(ASIDE / CELL)):
            assert abs(np.roll(pressed, back, axis=1) - alone)[alone > 1e-4].max() < 1e-3, (last, scale, back)
        bpy.ops.wm.read_factory_settings(use_empty=True)


def test_cycles_that_begin_between_frames_are_looked_at_as_the_clip_alone():
    for stretched in (1.0, 1.1):
        obj, end = recording(), 1.0 + 85.0 * stretched
        for curve in compat.curves_played(obj.animation_data):
            for key in curve.keyframe_points:
                key.co.x = 1.0 + (key.co.x - 1.0) * stretched
        alone = recorded(obj, 1, math.ceil(end))
        for curve in compat.curves_played(obj.animation_data):
            curve.modifiers.new("CYCLES").mode_after = "REPEAT"
        gait = recorded(obj, 1, math.ceil(2 * end) - 3)
        (cut,) = gait.cut
        assert abs(gait.frame(cut) - end) < 2.0 * seams.ASIDE, gait.warnings
        for first, since in ((0, 0), (cut + 1, 1)):  # the first pose of a round is seen just after it begins
            found, plain = gait.pose[:, first : first + 82], alone.pose[:, since : since + 82]
            np.testing.assert_allclose(found, plain, atol=2e-3)
        bpy.ops.wm.read_factory_settings(use_empty=True)


def test_keys_between_frames_are_looked_at_and_others_as_before():
    obj = meshes.link(bpy.data.objects.new("Empty", None))
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 12
    for k in range(8):
        obj.location.x = k
        obj.keyframe_insert("location", index=0, frame=1.0 + 1.4 * k)
    keys = [1.0 + 1.4 * k for k in range(8)]
    besides = moves.besides(scene, [obj])
    np.testing.assert_allclose(besides.frames(1, 12, 1), [*keys, 11.0, 12.0], atol=1e-3)
    both = moves.besides(scene, [obj, meshes.link(bpy.data.objects.new("Other", None))])
    np.testing.assert_allclose(both.frames(1, 12, 1), np.union1d(np.arange(1, 13), np.round(keys, 1)), atol=1e-3)
    obj.location.x = 9
    obj.keyframe_insert("location", index=0, frame=30.0)  # far from the one before: frames between tell more
    assert set(range(12, 30)) < set(moves.besides(scene, [obj], 1, 30).frames(1, 30, 1))
    for curve in compat.curves_played(obj.animation_data):
        curve.keyframe_points.remove(curve.keyframe_points[-1])
        for key in curve.keyframe_points:
            key.co.x = round(key.co.x)
    assert moves.besides(scene, [obj]).frames(1, 12, 1) == list(range(1, 13))
    assert moves.besides(scene, [obj]) == seams.Besides((1.0, 11.0))  # recorded once, also where no ends are asked for


def test_a_take_right_after_another_presses_as_alone():
    """Two clips, of which the second begins in the frame in which the first ends."""
    obj, action, slot = clip(recording())
    strip(obj, action, slot, 1)
    alone = prints(recorded(obj, 1, 86))
    strip(obj, action, slot, 86, extrapolation="HOLD_FORWARD")
    carried(obj, 86)
    pressed = prints(recorded(obj, 1, 171))
    for back in (0, -round(ASIDE / CELL)):
        assert abs(np.roll(pressed, back, axis=1) - alone)[alone > 1e-4].max() < 1e-3, back


def test_a_clip_that_is_cut_into_strips_is_recorded_as_one():
    obj, action, slot = clip(recording())
    one = strip(obj, action, slot, 1)
    whole = recorded(obj, 1, 86)
    one.action_frame_end = 40.0
    second_half(obj, action, slot, 40, 86)
    besides = moves.besides(bpy.context.scene, [obj])
    assert besides.seams == (1.0, 40.0, 86.0)
    parts = recorded(obj, 1, 86)
    assert not len(parts.cut) and parts.time.tolist() == whole.time.tolist()
    places, turns = (whole.pose - parts.pose)[..., :3], (whole.pose * parts.pose)[..., 3:]
    assert abs(places).max() < 5e-4 and abs(abs(turns.sum(axis=-1)) - 1.0).max() < 1e-5, abs(places).max()


def test_takes_that_fit_badly_are_no_kick():
    """A strip that begins 1 cm beside the one before: no cut, and no forces as of a body that is hit."""
    obj, action, slot = clip()
    one = strip(obj, action, slot, 1)
    one.action_frame_end = 20.0
    second_half(obj, action, slot, 20, 40)
    carrier = meshes.link(bpy.data.objects.new("Carrier", None))
    obj.parent = carrier
    for frame, x in ((1, 0.0), (20, 0.01)):
        carrier.location.x = x
        carrier.keyframe_insert("location", index=0, frame=frame)
    for curve in compat.curves_played(carrier.animation_data):
        for key in curve.keyframe_points:
            key.interpolation = "CONSTANT"
    besides = moves.besides(bpy.context.scene, [obj])
    assert 20.0 in besides.seams
    gait = recorded(obj, 1, 40)
    assert not len(gait.cut)
    plain = sample.record(bpy.context.scene, obj, 1, 40)
    kick, usual = (abs(walker.loads(each.resample(120.0)).force[..., 0]).max() for each in (gait, plain))
    assert kick < 1.2 * usual, (kick, usual)


def test_only_keys_that_hold_another_value_within_the_frames_are_seams():
    obj = meshes.link(bpy.data.objects.new("Empty", None))
    for frame, value, form in (
        (1, 0.0, "LINEAR"),
        (11, 1.0, "CONSTANT"),
        (21, 1.0, "CONSTANT"),
        (31, 3.0, "CONSTANT"),
        (45, 5.0, "LINEAR"),
    ):
        obj.location.x = value
        obj.keyframe_insert("location", index=0, frame=frame)
        (curve,) = compat.curves_played(obj.animation_data)
        curve.keyframe_points[-1].interpolation = form
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 40
    assert moves.besides(scene, [obj]).seams == (31.0,)
    assert moves.besides(scene, [obj], 1, 60).seams == (31.0, 45.0)


def test_seams_of_cycles_and_of_keys_that_hold():
    obj = meshes.link(bpy.data.objects.new("Empty", None))
    for frame in (1, 11):
        obj.location.x = frame
        obj.keyframe_insert("location", index=0, frame=frame)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 40
    assert moves.besides(scene, [obj]).seams == ()
    (curve,) = compat.curves_played(obj.animation_data)
    cycle = curve.modifiers.new("CYCLES")
    cycle.mode_before, cycle.mode_after = "NONE", "REPEAT"
    assert moves.besides(scene, [obj]).seams == (11.0002, 21.0002, 31.0002)
    cycle.mode_after = "REPEAT_OFFSET"  # goes on where it ended
    assert moves.besides(scene, [obj]).seams == ()
    curve.modifiers.remove(cycle)
    for key in curve.keyframe_points:
        key.interpolation = "CONSTANT"
    assert moves.besides(scene, [obj]).seams == (11.0,)
    for frame in range(12, 36, 2):  # and on twos
        obj.location.x = frame
        obj.keyframe_insert("location", index=0, frame=frame)
        curve.keyframe_points[-1].interpolation = "CONSTANT"
    assert moves.besides(scene, [obj]).seams == ()


def held_keys(obj):
    curves = compat.curves_played(obj.animation_data)
    return [(each.data_path, each.array_index, compat.held(each.keyframe_points).tolist()) for each in curves]


def test_a_linked_clip_holds_the_keys_that_it_holds(folder):
    file, walker = str(folder / "library.blend"), people.walk(people.biped(), frames=40)
    for key in compat.curves_played(walker.animation_data)[0].keyframe_points[10:20]:
        key.interpolation = "CONSTANT"
    wanted, name = held_keys(walker), walker.name
    assert sum(sum(held) for *_, held in wanted) == 10
    bpy.ops.wm.save_as_mainfile(filepath=file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(file, link=True) as (_, found):
        found.objects = [name]
    for _ in range(20):
        spoilt = [np.zeros(40, np.int32) for _ in range(50)]  # 0 is CONSTANT where memory is handed out as it was
        del spoilt
        assert held_keys(found.objects[0]) == wanted
