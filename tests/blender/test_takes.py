"""Where another take begins at once, the one before is recorded to its end, though no frame shows it."""

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
    assert moves.besides(scene, [obj]).seams == (11.0, 21.0, 31.0)
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
