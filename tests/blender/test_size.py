"""Sizes that cannot be are asked about first, small creatures step as people do, and a held pose is no step."""

import bpy
from scenes import meshes, people
from test_people import CMU, ground_under, walk_over
from test_playback import shown

from desire_path.blender import compat, inputs, sample
from desire_path.errors import DesirePathError

WALK = "cmu_12_01_walk.bvh"


def person(by=1.0):
    """The recorded walk at another size, its frames as much quicker as Froude has it."""
    walker = people.bvh(people.SCENES.joinpath("walks", WALK), global_scale=CMU * by)
    render = bpy.context.scene.render
    render.fps, render.fps_base = round(render.fps / by**0.5), 1.0
    return walker


def refused(work):
    try:
        work()
    except (DesirePathError, RuntimeError) as problem:
        return str(problem)
    raise AssertionError("was not refused")


def record(walker):
    return sample.record(bpy.context.scene, walker, 1, 60)


def test_a_person_in_centimetres_is_asked_about_before_the_bake(folder):
    walker = person(100.0)
    walker.desire_path.mass = 75.0
    words = refused(lambda: record(walker))
    assert f"'{walker.name}' is 1" in words and "m tall and weighs 75 kg" in words and "scale of 0.01" in words
    ground = meshes.grid(30, 30, 20.0, -300.0, -300.0, name="Ground")
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    ground.desire_path.folder = str(folder / "bake")
    meshes.activate(walker)
    bpy.ops.object.desire_path_walker_add()
    meshes.activate(ground)
    assert "scale of 0.01" in refused(bpy.ops.object.desire_path_bake)
    assert not (folder / "bake" / "frames").exists()
    walker.scale = (0.01, 0.01, 0.01)
    bpy.context.view_layer.update()
    assert not any("tall" in each for each in record(walker).warnings)


def test_who_is_meant_to_be_a_giant_or_a_dwarf_walks():
    walker = person(3.0)
    walker.desire_path.mass = 75.0
    told = record(walker).warnings
    assert "m tall: if that is not meant" in told[0], told
    walker.desire_path.mass = 1500.0
    assert not any("tall" in each for each in record(walker).warnings)


def test_whose_mass_nobody_chose_walks_at_any_size_a_creature_can_have():
    for size in (0.01, 17.0):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        walker = person(size)
        told = record(walker).warnings
        assert "m tall and weighs 75 kg, since nobody gave it another mass" in told[0], told
    bpy.ops.wm.read_factory_settings(use_empty=True)
    assert "which cannot be" in refused(lambda: record(person(100.0)))


def test_a_dwarf_with_a_persons_mass_is_asked_about():
    walker = person(0.04)
    walker.desire_path.mass = 75.0
    assert "which cannot be" in refused(lambda: record(walker))
    walker.desire_path.mass = 0.005
    assert not any("tall" in each for each in record(walker).warnings)


def test_an_armature_at_rest_is_named():
    walker = person()
    walker.data.pose_position = "REST"
    assert "is set to Rest Position" in refused(lambda: record(walker))
    walker.data.pose_position = "POSE"
    record(walker)


def test_an_armature_that_is_edited_is_named():
    walker = person()
    meshes.activate(walker)
    bpy.ops.object.mode_set(mode="EDIT")
    assert "is in Edit Mode" in refused(lambda: record(walker))
    bpy.ops.object.mode_set(mode="OBJECT")
    record(walker)


def test_a_small_creature_has_the_contacts_of_a_person(folder):
    found = []
    for by, mass in ((1.0, 75.0), (0.04, 75.0 * 0.04**3)):
        for each in list(bpy.data.objects):
            bpy.data.objects.remove(each)
        walker = person(by)
        walker.desire_path.mass = mass
        ground, _ = ground_under(walker, 0.0, 0.6 * by, 0.05 * by)
        ground.desire_path.cell_size = 0.02 * by
        (folder / f"{by}").mkdir()
        found.append(walk_over(walker, ground, folder / f"{by}", mass))
    assert found[0]["contacts"] == found[1]["contacts"] > 3
    assert not any("tall" in each or "coarse" in each for each in found[1]["warnings"])


def test_who_is_animated_on_twos_steps_as_on_ones(folder):
    found = []
    for name in ("ones", "twos"):
        for each in list(bpy.data.objects):
            bpy.data.objects.remove(each)
        walker = person()
        for curve in compat.curves_played(walker.animation_data) if name == "twos" else ():
            stepped = curve.modifiers.new("STEPPED")
            stepped.frame_step, stepped.frame_offset = 10.0, 2.0  # twelve poses a second
        ground, _ = ground_under(walker, 0.0)
        (folder / name).mkdir()
        found.append(walk_over(walker, ground, folder / name))
    assert any("are held for 10 frames each" in each for each in found[1]["warnings"])
    assert abs(found[0]["contacts"] - found[1]["contacts"]) <= 1, (found[0]["contacts"], found[1]["contacts"])
    assert abs(found[1]["pressed_m3"] / found[0]["pressed_m3"] - 1.0) < 0.1


def test_the_last_pose_may_be_held(folder):
    walker = person()
    ground, _ = ground_under(walker, 0.0)
    last = int(walker.animation_data.action.frame_range[1])
    pressed = []
    for end in (last, last + 200):
        if end > last:
            settings = ground.desire_path
            settings.frame_start, settings.frame_end = 1, end
        (folder / f"{end}").mkdir()
        walk_over(walker, ground, folder / f"{end}")
        pressed.append(shown(ground, end)[0][:, 2])
        meshes.activate(ground)
        bpy.ops.object.desire_path_free()
    assert pressed[0].min() < -0.005
    assert abs(pressed[1] - pressed[0]).max() < 1e-3


def test_who_grows_is_told():
    walker = person()
    assert not any("changes its size" in each for each in record(walker).warnings)
    for frame, by in ((1, 1.0), (60, 1.5)):
        walker.scale = (by, by, by)
        walker.keyframe_insert("scale", frame=frame)
    (told,) = [each for each in record(walker).warnings if "changes its size" in each]
    assert "1.5 times as large at frame 60 as at frame 1" in told


def test_another_gravity_than_ours_is_told(folder):
    scene = bpy.context.scene
    for gravity, units, told in (
        (9.81, 1.0, None),
        (9.7, 1.0, None),
        (9.81, 0.01, None),
        (981.0, 0.01, None),
        (1.62, 1.0, "is 1.62 m/s2, but"),
        (162.0, 0.01, "is 1.62 m/s2, but"),
        (0.0, 1.0, "is 0 m/s2, but"),
    ):
        scene.gravity, scene.unit_settings.scale_length = (0.0, 0.0, -gravity), units
        found = inputs.gravity_of(scene)
        assert (told in found[0] and "0.17 times" in found[0] or gravity == 0.0) if told else not found, found
    scene.use_gravity = False
    assert not inputs.gravity_of(scene)
    walker = person()
    scene.use_gravity, scene.gravity, scene.unit_settings.scale_length = True, (0.0, 0.0, -1.62), 1.0
    ground, _ = ground_under(walker, 0.0)
    walk_over(walker, ground, folder)
    assert "The gravity of the scene" in ground.desire_path.summary
