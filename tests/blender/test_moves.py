"""The frames of a bake are those in which anything moves the walker, asked anew at every bake."""

import json

import bpy
import numpy as np
from scenes import meshes, people
from test_bake import scene as strip
from test_playback import shown
from test_trails import meadow

from desire_path.bake import bake
from desire_path.blender import bake_job, compat, moves, posing, sample, stems
from desire_path.ground import maps

SHOT = (200, 230)  # the scene's range


def empty(name="Empty", keys=()):
    obj = meshes.link(bpy.data.objects.new(name, None))
    slide(obj, keys)
    return obj


def slide(obj, keys):
    """Key a way along X."""
    for frame in keys:
        obj.location.x = 0.1 * frame
        obj.keyframe_insert("location", index=0, frame=frame)


def still():
    """An armature without a key in a scene of some range."""
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = SHOT
    return people.biped()


def test_a_pose_that_is_keyed_once_moves_nobody():
    obj = still()
    slide(obj, (7,))
    assert moves.moves(obj) and not moves.has_motion(obj)
    slide(obj, (9,))
    assert moves.has_motion(obj)


def frames(obj):
    return moves.frame_range(bpy.context.scene, obj)


def strip_of(obj, start, keys=(1, 41)):
    """A strip of a clip of these keys, on a track of its own."""
    slide(obj, keys)
    data = obj.animation_data
    action, slot = data.action, getattr(data, "action_slot", None)
    data.action = None
    made = data.nla_tracks.new().strips.new("clip", start, action)
    if slot is not None and made.action_slot is None:
        made.action_slot = slot
    return made


def test_frames_hold_all_of_a_clip_that_ends_between_two():
    obj = people.walk(people.biped(), frames=20)
    for curve in compat.curves_played(obj.animation_data):
        for key in curve.keyframe_points:
            for at in (key.co, key.handle_left, key.handle_right):
                at.x = 1.0 + (at.x - 1.0) * 0.5
        curve.update()
    assert moves.frame_range(bpy.context.scene, obj) == (1, 11)  # it ends at 10.5


def test_a_clip_between_frames_presses_what_it_does_on_whole_ones(folder):
    """60 keys a second in 24 frames, from frame 1 on and from 1.6: what is shown before and after is no part of it."""
    pressed = []
    for number, shift in enumerate((0.0, 0.6)):
        ground, walker = strip(folder / str(number))
        ground.desire_path.soil = "mud"  # which is the same everywhere
        people.walk(walker, frames=60, rate=60, period=60)
        for curve in compat.curves_played(walker.animation_data):
            for key in curve.keyframe_points:
                for at in (key.co, key.handle_left, key.handle_right):
                    at.x = 1.0 + (at.x - 1.0) * 0.4 + shift
            curve.update()
        assert sample.gaits(bpy.context.scene, [walker], 1, 26).time[-1] == 25 / 24
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        pressed.append(json.loads((folder / str(number) / "bake" / "report.json").read_text())["pressed_m3"])
        bpy.ops.wm.read_factory_settings(use_empty=True)
    assert abs(pressed[1] / pressed[0] - 1.0) < 0.01, pressed


def test_strips_count_where_they_lie_and_are_heard():
    obj = still()
    strip_of(obj, 11)
    assert frames(obj) == (11, 51)
    late = strip_of(obj, 101)
    assert frames(obj) == (11, 141)  # layers over layers
    late.scale, late.repeat = 2.0, 1.5
    assert frames(obj) == (11, 221)
    late.mute = True
    assert frames(obj) == (11, 51)
    late.mute = False
    first, second = obj.animation_data.nla_tracks
    first.mute = True
    assert frames(obj) == (101, 221)
    first.mute = False
    slide(obj, (300, 320))  # an action over the strips
    assert frames(obj) == (11, 320)
    first.is_solo = True  # silences the other track and the action
    assert frames(obj) == (11, 51)
    first.is_solo = False
    obj.animation_data.use_nla = False
    assert frames(obj) == (300, 320)


def test_an_action_counts_as_far_as_its_slot_and_its_range():
    obj = still()
    slide(obj, (4, 9))
    action = obj.animation_data.action
    if hasattr(action, "slots"):
        other = empty("Other")
        other.animation_data_create().action = action
        other.animation_data.action_slot = action.slots.new("OBJECT", "other")
        slide(other, (1, 99))
        assert frames(other) == (1, 99)
    assert frames(obj) == (4, 9)
    action.use_frame_range, action.frame_start, action.frame_end = True, 5, 8
    assert frames(obj) == (5, 8)
    compat.curves(obj.animation_data, obj)[0].mute = True
    assert frames(obj) == SHOT


def test_a_clip_that_goes_on_by_itself_goes_on_to_the_end_of_the_shot():
    for change in (
        lambda curve: curve.modifiers.new("CYCLES"),
        lambda curve: curve.modifiers.new("NOISE"),
        lambda curve: setattr(curve, "extrapolation", "LINEAR"),
    ):
        obj = still()
        slide(obj, (1, 41))
        assert frames(obj) == (1, 41)
        change(compat.curves(obj.animation_data, obj)[0])
        assert frames(obj) == (1, 230)


def follow_path(obj):
    line = bpy.data.curves.new("Line", "CURVE")
    line.splines.new("POLY").points.add(1)
    line.eval_time = 0.0
    line.keyframe_insert("eval_time", frame=50)
    line.eval_time = 100.0
    line.keyframe_insert("eval_time", frame=240)
    obj.constraints.new("FOLLOW_PATH").target = meshes.link(bpy.data.objects.new("Line", line))


def child_of_a_child(obj):
    between = empty("Between")
    between.parent = empty("Carrier", (50, 240))
    obj.constraints.new("CHILD_OF").target = between


def copied(obj):
    first = empty("First", (50, 240))
    second = empty("Second")
    second.constraints.new("COPY_TRANSFORMS").target = first
    obj.pose.bones["hips"].constraints.new("COPY_LOCATION").target = second


def reached_for(obj):
    obj.pose.bones["shin.L"].constraints.new("IK").target = empty("Target", (50, 240))


def held_by_armature(obj):
    other = people.biped("Other")
    slide(other, (50, 240))
    obj.pose.bones["hips"].constraints.new("ARMATURE").targets.new().target = other


def driven(obj):
    driver = obj.driver_add("location", 1).driver
    variable = driver.variables.new()
    variable.type, variable.targets[0].id = "TRANSFORMS", empty("Slider", (50, 240))
    driver.expression = variable.name


def test_what_ties_the_walker_to_others_moves_it():
    for tie in (follow_path, child_of_a_child, copied, reached_for, held_by_armature, driven):
        obj = still()
        slide(obj, (60, 100))
        assert frames(obj) == (60, 100)
        tie(obj)
        assert frames(obj) == (50, 240), tie
        bpy.context.scene.frame_end = 300
        assert frames(obj) == (50, 300), tie


def test_a_driver_that_tells_the_time_goes_on():
    obj = still()
    slide(obj, (60, 100))
    driver = obj.pose.bones["hips"].driver_add("location", 1).driver
    variable = driver.variables.new()
    variable.targets[0].id, variable.targets[0].data_path = obj, "location.x"
    driver.expression = f"0.1 * sin({variable.name}) if {variable.name} > 0 else 0"
    assert frames(obj) == (60, 100)  # of the walker's own keys
    driver.expression = "0.02 * frame"
    assert frames(obj) == (60, 230)


def test_what_does_not_move_does_not_count():
    obj = still()
    slide(obj, (60, 100))
    obj.constraints.new("COPY_ROTATION").target = empty("Still")
    muted = obj.constraints.new("CHILD_OF")
    muted.target, muted.mute = empty("Carrier", (1, 500)), True
    assert frames(obj) == (60, 100)
    muted.keyframe_insert("mute", frame=70)
    assert frames(obj) == (1, 500)


def test_keys_lie_where_the_timeline_shows_them():
    obj = still()
    slide(obj, (10, 50))
    render = bpy.context.scene.render
    render.frame_map_old, render.frame_map_new = 100, 200
    assert frames(obj) == (20, 100)
    render.frame_map_old, render.frame_map_new = 100, 50
    assert frames(obj) == (5, 25)


def told(ground):
    found = json.loads(ground.desire_path.summary)
    return found["frames"], found["contacts"]


def test_a_clip_changed_after_add_walker_is_baked_as_it_is(folder):
    ground, walker = strip(folder)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    frames, contacts = told(ground)
    assert frames == [1, 30]
    for curve in compat.curves(walker.animation_data, walker):
        for key in curve.keyframe_points:
            for point in (key.co, key.handle_left, key.handle_right):
                point.x += 70.0
        curve.update()
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert told(ground) == ([71, 100], contacts)
    ground.desire_path.frame_start = 75  # by hand: from now on it stays
    walker.location.y = -9.0
    walker.keyframe_insert("location", index=1, frame=150)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert told(ground)[0] == [75, 100]


def test_a_walker_that_nothing_moves_is_told(folder):
    ground, walker = strip(folder)
    assert moves.still([walker]) == []
    for curve in compat.curves(walker.animation_data, walker):
        curve.mute = True
    (text,) = moves.still([walker])
    assert walker.animation_data.action.name in text and "unmute them in the Graph Editor" in text
    job = bake_job.Job(bpy.context.scene, ground)
    before = []
    for _ in job.run():
        before.append(text in job.early)
        if any(before):
            break
    assert job.warnings[0] == text and job.fraction == 0.0
    for curve in compat.curves(walker.animation_data, walker):
        curve.mute = False
    strip_of(walker, 1)
    assert moves.still([walker]) == []
    walker.animation_data.nla_tracks[0].mute = True
    assert "NLA Editor" in moves.still([walker])[0]
    walker.animation_data.use_nla = False
    assert "NLA" in moves.still([walker])[0]
    walker.animation_data_clear()
    assert "give it an action" in moves.still([walker])[0]


def test_all_walkers_of_a_ground_are_baked(folder):
    ground, walker = strip(folder)
    other = people.walk(people.biped("Other"), frames=20)
    for curve in compat.curves(other.animation_data, other):
        for key in curve.keyframe_points:
            key.co.x += 25.0
        curve.update()
    meshes.activate(other)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert told(ground)[0] == [1, 45]


def stretched(old, new):
    render = bpy.context.scene.render
    render.frame_map_old, render.frame_map_new = old, new


def test_stretched_time_is_slow_motion():
    walker = people.walk(people.biped())
    plain = sample.record(bpy.context.scene, walker, 5, 30)
    stretched(100, 200)
    slow = sample.record(bpy.context.scene, walker, 10, 60)
    assert np.isclose(slow.time[-1], plain.time[-1]) and slow.frame(50) == 60  # as many seconds in twice the frames
    np.testing.assert_allclose(slow.pose[:, ::2, :3], plain.pose[..., :3], atol=5e-3)  # its lowest samples level a sole
    np.testing.assert_allclose(slow.com[:, ::2], plain.com, atol=1e-6)
    stretched(300, 100)
    fast = sample.record(bpy.context.scene, walker, 2, 10)
    assert len(fast.time) == 25 and np.isclose(fast.time[-1], 1.0)  # no frame of the animation is left out
    np.testing.assert_allclose(fast.com[:, 0, 1], plain.com[:, 1, 1], atol=1e-6)


def test_prints_come_at_the_frames_their_feet_do(folder):
    ground, walker = meadow(folder)
    ground.desire_path.plant_mesh = True
    rest = compat.positions(ground.data)
    for old, new in ((100, 200), (100, 77), (9, 900)):
        stretched(old, new)
        ground.desire_path.frame_start, ground.desire_path.frame_end = 3, 30
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        index = bake.read_index(str(folder / "bake"))
        assert (index.frame_start, index.frame_end) == (3, 30)
        place = (rest[:, :2].astype(np.float64) - (index.x0, index.y0)) / index.cell - 0.5
        i, j = np.round(place).astype(int).T
        inside = (i >= 0) & (i < index.nx) & (j >= 0) & (j < index.ny)
        plants = ground.desire_path.plant_object
        plants.modifiers[stems.BLADES].show_viewport = False
        points = np.frombuffer((folder / "bake" / "plants.pc2").read_bytes()[32:], "<f4").reshape(28, -1, 3)
        for frame in (1, 2, 3, 4, 9, 16, 23, 29, 30, 32, 200):
            number = min(max(frame - 2, 0), 28)
            high = maps.read(index.path(number)).planes["R"]
            lifted = shown(ground, frame)[0][:, 2] - rest[:, 2]
            assert (lifted[inside] == high[j[inside], i[inside]]).all(), (new, frame)
            mesh = plants.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
            assert np.abs(compat.positions(mesh) - points[max(number - 1, 0)]).max() < 2e-3, (new, frame)
        played = {frame: maps.read(index.path(frame - 2)).planes["R"].tobytes() for frame in (3, 30)}
    assert played[3] != played[30]


def test_feet_are_placed_in_stretched_time():
    stretched(100, 200)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 2, 60
    ground = meshes.grid(20, 30, 0.12, -1.2, -3.2, height=lambda x, y: -0.2 * y)
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_ground_add() == {"FINISHED"}
    walker = people.walk(people.biped(), frames=30)
    meshes.activate(walker)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    before = posing.look(bpy.context.scene, walker, ["hips"], [2, 30, 60])
    assert bpy.ops.object.desire_path_place_feet() == {"FINISHED"}
    after = posing.look(bpy.context.scene, walker, ["hips"], [2, 30, 60])
    risen = (after.at("hips") - before.at("hips"))[:, 2, 3]
    ahead = before.at("hips")[:, 1, 3]
    assert np.abs(np.diff(risen) + 0.2 * np.diff(ahead)).max() < 0.03, (risen, ahead)


def test_a_pose_before_the_walk_is_cut_off(folder):
    found = []
    for pose, looks in ((False, 1), (True, 1), (True, 4)):
        ground, walker = strip(folder / f"{pose} {looks}")
        walker.desire_path.subframes = looks
        if pose:  # as converters leave it, far from where the walk begins and with straight legs
            for curve in compat.curves(walker.animation_data, walker):
                curve.keyframe_points.insert(0, 1.5 if curve.data_path == "location" else 0.0)
                curve.update()
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        report = json.loads((folder / f"{pose} {looks}" / "bake" / "report.json").read_text())
        told = [each for each in report["warnings"] if "jumps" in each]
        assert len(told) == pose and (not pose or "between frames 0 and 1: taken as a cut" in told[0]), told
        found.append((report["contacts"], shown(ground, 30)[0][:, 2].min()))
        bpy.ops.wm.read_factory_settings(use_empty=True)
    assert found[0][0] == found[1][0] == found[2][0], found
    assert abs(found[0][1] - found[1][1]) < 2e-3, found


def test_placed_feet_and_hips_know_nothing_of_a_pose_before_the_walk():
    hips = []
    for pose in (False, True):
        ground = meshes.grid(30, 40, 0.12, -1.8, -3.2, height=lambda x, y: -0.2 * y)
        meshes.activate(ground)
        assert bpy.ops.object.desire_path_ground_add() == {"FINISHED"}
        walker = people.walk(people.biped(), frames=30)
        if pose:
            walker.location.z = 0.0
            walker.keyframe_insert("location", index=2, frame=1)
            for curve in compat.curves(walker.animation_data, walker):  # far ahead, its feet high over the ground
                curve.keyframe_points.insert(
                    0, {1: -2.0, 2: 3.0}.get(curve.array_index, 0.0) if curve.data_path == "location" else 0.0
                )
                curve.update()
        meshes.activate(walker)
        assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
        assert bpy.ops.object.desire_path_place_feet() == {"FINISHED"}
        hips.append(posing.look(bpy.context.scene, walker, ["hips"], list(range(1, 31))).at("hips")[:, :3, 3])
        bpy.ops.wm.read_factory_settings(use_empty=True)
    assert np.abs(hips[1] - hips[0]).max() < 0.01, np.abs(hips[1] - hips[0]).max(axis=1).round(3)
