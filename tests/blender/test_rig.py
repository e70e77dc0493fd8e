"""What a walker's rig is taken for: found, shown in slots, overridden by hand, and heeded."""

import json

import bpy
import numpy as np
from scenes import beasts, meshes, people

import desire_path
from desire_path.blender import bones, panels, private, sample
from desire_path.errors import DesirePathError

operator = bpy.ops.object


def refused(call, *words, **arguments):
    """The sentence an operator or function is refused with."""
    try:
        call(**arguments)
    except (RuntimeError, DesirePathError) as problem:
        text = str(problem)
        assert "Traceback" not in text, text
        for word in words:
            assert word in text, text
        return text
    raise AssertionError("not refused")


def record(obj, last=24):
    return sample.record(bpy.context.scene, obj, 1, last)


def slots(obj):
    return [(f.limb, f.foot, f.toe, f.heel) for f in obj.desire_path.feet]


def add_bones(obj, *bones):
    """(name, parent, head, tail) more."""
    meshes.activate(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    for name, parent, head, tail in bones:
        made = obj.data.edit_bones.new(name)
        made.head, made.tail = head, tail
        made.parent = obj.data.edit_bones[parent] if parent else None
    bpy.ops.object.mode_set(mode="OBJECT")


def test_detect_fills_the_slots():
    obj = people.biped()
    add_bones(obj, ("heel.L", "foot.L", (0.07, 0.06, 0.0), (0.13, 0.06, 0.0)))
    assert operator.desire_path_rig_detect() == {"FINISHED"}
    assert slots(obj) == [("left", "foot.L", "toe.L", "heel.L"), ("right", "foot.R", "toe.R", "")]
    assert obj.desire_path.hips == "hips" and not obj.desire_path.is_walker
    obj.desire_path.feet[0].foot = "hips"
    obj.desire_path.feet.remove(1)
    assert operator.desire_path_rig_detect() == {"FINISHED"}
    assert [foot[1] for foot in slots(obj)] == ["foot.L", "foot.R"]
    assert [foot.shank for foot in obj.desire_path.feet] == ["shin.L", "shin.R"]


def test_slots_set_by_hand_are_heeded():
    obj = people.walk(people.biped())
    operator.desire_path_rig_detect()
    before = record(obj)
    settings = obj.desire_path
    add_bones(
        obj,
        ("other", "shin.L", (0.10, 0.02, 0.08), (0.10, -0.11, 0.02)),
        ("other toe", "other", (0.10, -0.09, 0.02), (0.10, -0.16, 0.02)),
        ("belly", "hips", (0, 0, 1.2), (0, 0, 1.3)),
    )
    settings.feet[0].foot = "other"
    assert settings.feet[0].shank == "" and settings.feet[1].shank == "shin.R"
    settings.feet[0].toe = ""
    after = record(obj)
    assert after.limb_name == ("other", "foot.R")
    # the new foot's leg is the one above it, so that the mass centre has its segments
    np.testing.assert_allclose(after.com, before.com, atol=2e-3)
    assert not np.allclose(after.pose[:2], before.pose[:2], atol=1e-3)
    np.testing.assert_array_equal(after.pose[2:], before.pose[2:])
    ball = record(obj).point
    settings.feet[0].toe = "other toe"
    assert not np.allclose(record(obj).point, ball, atol=1e-3)
    settings.hips = "belly"
    assert not np.allclose(record(obj).com, after.com, atol=1e-3)
    # what was chosen before Add Walker stays chosen
    meshes.grid(20, 20, 0.1, -1, -1)
    operator.desire_path_ground_add()
    meshes.activate(obj)
    assert operator.desire_path_walker_add() == {"FINISHED"}
    assert slots(obj)[0][1:3] == ("other", "other toe") and settings.hips == "belly"
    # pressed once more it finds them anew
    assert operator.desire_path_walker_add() == {"FINISHED"}
    assert slots(obj)[0][1] == "foot.L" and settings.hips == "hips"


def test_a_heel_set_by_hand_brings_its_faces():
    obj = people.walk(people.biped())
    add_bones(obj, ("spur", "shin.L", (0.10, 0.02, 0.08), (0.10, 0.06, 0.01)))
    mesh = meshes.grid(8, 16, 0.02, 0.03, -0.22, height=lambda x, y: 0.0 * x + 0.005, name="Shoe")
    rows = np.arange(8 * 16) // 8
    for bone, mine in (("foot.L", (rows > 4) & (rows < 12)), ("toe.L", rows <= 4), ("spur", rows >= 12)):
        mesh.vertex_groups.new(name=bone).add(np.flatnonzero(mine).tolist(), 1.0, "REPLACE")
    mesh.modifiers.new("Armature", "ARMATURE").object = obj
    mesh.parent = obj
    bpy.context.view_layer.update()
    meshes.activate(obj)
    operator.desire_path_rig_detect()
    assert obj.desire_path.feet[0].heel == ""
    without = np.ptp(record(obj).soles[0].vertices[:, 0])
    obj.desire_path.feet[0].heel = "spur"
    assert np.ptp(record(obj).soles[0].vertices[:, 0]) - without > 0.05


def test_feet_are_added_and_removed_by_hand():
    obj = people.walk(people.biped())
    for name in ("foot.L", "foot.R", "toe.L", "toe.R", "shin.L", "shin.R", "thigh.L", "thigh.R", "neck", "hips"):
        obj.data.bones[name].name = "b" + str(len(name) * 7 + ord(name[0])) + name[-1].lower() + "x"  # nothing to go by
    names = {bone.name: bone for bone in obj.data.bones}
    low = sorted(names, key=lambda name: names[name].head_local.z)
    feet = [
        name
        for name in low
        if names[name].children and names[name].head_local.z < 0.09 and names[name].head_local.y > 0.0
    ]
    assert len(feet) == 2
    settings = obj.desire_path
    settings.feet.clear()
    for name in feet:
        obj.data.bones.active = obj.data.bones[name]
        assert operator.desire_path_foot_add() == {"FINISHED"}
    assert [each.foot for each in settings.feet] == feet and settings.feet[1].limb == "foot 2"
    assert operator.desire_path_foot_add() == {"FINISHED"}  # the active bone is a foot already
    assert settings.feet[2].foot == ""
    refused(lambda: record(obj), "foot 3", "choose one")
    assert operator.desire_path_foot_remove(index=2) == {"FINISHED"}
    refused(operator.desire_path_foot_remove, "no foot 5", index=5)
    assert record(obj).limb_name == tuple(feet)
    # chosen feet are what Add Walker takes, and a leg set by hand is heeded
    meshes.grid(20, 20, 0.1, -1, -1)
    operator.desire_path_ground_add()
    meshes.activate(obj)
    assert operator.desire_path_walker_add() == {"FINISHED"}
    assert [each.foot for each in settings.feet] == feet
    before = record(obj).com
    settings.feet[0].thigh = settings.feet[0].shank = names[feet[0]].parent.name
    assert not np.allclose(record(obj).com, before, atol=1e-3)
    operator.desire_path_foot_remove(index=0)
    assert record(obj).limb_name == (feet[1],)


def test_slots_that_name_no_bone():
    obj = people.walk(people.biped())
    operator.desire_path_rig_detect()
    settings = obj.desire_path
    for slot in ("foot", "toe", "heel"):
        kept = getattr(settings.feet[1], slot)
        setattr(settings.feet[1], slot, "nowhere")
        refused(lambda: record(obj), "'nowhere'", "Walker", "Find Feet")
        setattr(settings.feet[1], slot, kept)
    settings.feet[1].foot = ""
    refused(lambda: record(obj), "right foot", "choose one")
    settings.feet[1].foot = "foot.R"
    settings.hips = "nowhere"
    refused(lambda: record(obj), "'nowhere'")
    settings.hips = "hips"
    assert record(obj).limb_name == ("foot.L", "foot.R")


def overridden(file):
    """Library overrides of a walker and a ground in a file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(file, link=True) as (_, wanted):
        wanted.objects = ["Walker", "Ground"]
    found = []
    for linked in wanted.objects:
        bpy.context.scene.collection.objects.link(linked)
        meshes.activate(linked)
        add = operator.desire_path_walker_add if linked.type == "ARMATURE" else operator.desire_path_ground_add
        refused(add, "is linked from another file", "library override")
        found.append(linked.override_create(remap_local_usages=True))
    meshes.activate(found[1])
    assert operator.desire_path_ground_add() == {"FINISHED"}
    meshes.activate(found[0])
    assert operator.desire_path_walker_add() == {"FINISHED"}
    return found


def test_library_overrides_keep_what_they_were_told(folder):
    file = str(folder / "library.blend")
    desire_path.unregister()
    meshes.grid(40, 60, 0.05, -1, -2).vertex_groups.new(name="wet").add(list(range(300)), 1.0, "REPLACE")
    people.walk(people.biped(), frames=8)
    bpy.ops.wm.save_as_mainfile(filepath=file)
    desire_path.register()
    for once_told in (False, True):  # whether the library knows of walkers and grounds itself
        shot = str(folder / f"shot{once_told:d}.blend")
        walker, ground = overridden(file)
        assert operator.desire_path_rig_detect() == {"FINISHED"}
        assert [foot[1] for foot in slots(walker)] == ["foot.L", "foot.R"]  # found anew, none twice
        walker.desire_path.mass, walker.desire_path.feet[1].toe = 50.0, ""
        ground.desire_path.cell_size, ground.desire_path.soil = 0.03, "snow"
        meshes.activate(ground)
        assert operator.desire_path_paint_add() == {"FINISHED"}
        assert operator.desire_path_plants_add(kind="moss", density=20.0, grass=False) == {"FINISHED"}
        assert operator.desire_path_bake() == {"FINISHED"}
        bpy.ops.wm.save_as_mainfile(filepath=shot)
        legs = [(each.thigh, each.shank) for each in walker.desire_path.feet]
        for _ in range(2):
            bpy.ops.wm.open_mainfile(filepath=shot)
            walker, ground = (
                next(each for each in bpy.context.scene.objects if each.override_library and each.type == kind)
                for kind in ("ARMATURE", "MESH")
            )
            settings = walker.desire_path
            assert settings.is_walker and settings.mass == 50.0 and settings.ground == ground
            assert slots(walker) == [("left", "foot.L", "toe.L", ""), ("right", "foot.R", "", "")]
            assert [(each.thigh, each.shank) for each in settings.feet] == legs
            settings = ground.desire_path
            assert settings.is_ground and settings.soil == "snow" and abs(settings.cell_size - 0.03) < 1e-6
            assert (
                settings.frames_auto
                and settings.folder_auto
                and settings.folder == f"//desire_path/shot{once_told:d}/Ground"
            )
            assert [each.vertex_group for each in settings.painted] == ["wet"]
            assert [(each.kind, each.density, each.count > 10) for each in settings.plants] == [("moss", 20.0, True)]
            assert settings.bake_state == "FRESH", settings.missing
            bpy.ops.wm.save_mainfile()
        bpy.ops.wm.open_mainfile(filepath=file)
        for name, add in (("Ground", operator.desire_path_ground_add), ("Walker", operator.desire_path_walker_add)):
            meshes.activate(bpy.data.objects[name])
            add()
        bpy.ops.wm.save_as_mainfile(filepath=file)


def test_numbers_of_a_soil_that_an_override_changed_are_kept(folder):
    file, shot = str(folder / "library.blend"), str(folder / "shot.blend")
    for known in (False, True):  # whether the library has numbers of its own
        bpy.ops.wm.read_factory_settings(use_empty=True)
        ground = meshes.grid(10, 10, 0.1)
        meshes.activate(ground)
        assert operator.desire_path_ground_add() == {"FINISHED"}
        if known:
            ground.desire_path.soil_numbers.young_modulus = 7e5
        bpy.ops.wm.save_as_mainfile(filepath=file)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        with bpy.data.libraries.load(file, link=True) as (_, found):
            found.objects = ["Ground"]
        bpy.context.scene.collection.objects.link(found.objects[0])
        ground = found.objects[0].override_create(remap_local_usages=True)
        ground.desire_path.soil_numbers.young_modulus = 3e5
        bpy.ops.wm.save_as_mainfile(filepath=shot)
        for _ in range(2):
            bpy.ops.wm.open_mainfile(filepath=shot)
            numbers = next(each for each in bpy.context.scene.objects if each.override_library).desire_path.soil_numbers
            assert numbers.changed and abs(numbers.young_modulus - 3e5) < 1.0, (known, numbers.young_modulus)
            bpy.ops.wm.save_mainfile()


def test_no_rig_to_speak_of():
    armature = bpy.data.armatures.new("Stick")
    obj = meshes.link(bpy.data.objects.new("Stick", armature))
    refused(operator.desire_path_rig_detect, "no bones")
    add_bones(obj, ("pole", None, (0, 0, 0), (0, 0, 1)))
    refused(operator.desire_path_rig_detect, "No foot bones were found", "by hand")
    assert not obj.desire_path.feet
    meshes.grid(4, 4, 0.1, 0, 0)
    refused(operator.desire_path_rig_detect, "poll")


def test_mass_centre_bone():
    obj = people.walk(people.biped())
    segments = record(obj).com
    obj.desire_path.mass_center = "neck"
    found = record(obj).com
    with private.private_scene(bpy.context.scene, obj) as own:
        neck = bones.motion(own, obj, ["neck"], list(range(1, 25)), 24.0, 1.0)[0].matrix[:, 0, :3, 3]
    np.testing.assert_allclose(found[0], neck, atol=1e-9)
    obj.desire_path.mass_center = "nowhere"
    refused(lambda: record(obj), "'nowhere'", "Walker")
    obj.desire_path.mass_center = ""
    np.testing.assert_array_equal(record(obj).com, segments)


def test_mass_is_estimated(folder):
    ground = meshes.grid(40, 100, 0.02, -0.4, -1.6)
    operator.desire_path_ground_add()
    obj = people.walk(people.biped())
    operator.desire_path_walker_add()
    settings = obj.desire_path
    assert panels.weight(settings) == "75 kg"
    assert record(obj).mass[0] == 75.0
    settings.mass = 0.0
    assert "estimated" in panels.weight(settings)
    gait = record(obj)
    leg = np.hypot(0.42, 0.01) + np.hypot(0.42, 0.03)
    assert abs(gait.mass[0] - 22.0 * (leg / 0.491) ** 2) < 0.01
    told = [each for each in gait.warnings if "estimate" in each]
    assert len(told) == 1 and "Walker" in told[0] and f"{gait.mass[0]:.3g} kg" in told[0]
    assert panels.weight(settings) == f"about {gait.mass[0]:.3g} kg"
    # the report and the panel's summary tell it
    meshes.activate(ground)
    ground.desire_path.folder = str(folder / "bake")
    ground.desire_path.cell_size = 0.02
    ground.desire_path.frame_start, ground.desire_path.frame_end = 1, 8
    assert operator.desire_path_bake() == {"FINISHED"}
    report = json.loads((folder / "bake" / "report.json").read_text())
    assert told[0] in report["warnings"]
    assert abs(report["parameters"]["mass_kg"][0] - gait.mass[0]) < 1e-9
    assert told[0] in json.loads(ground.desire_path.summary)["warnings"]
    # a rig twice as large weighs four times as much
    meshes.activate(obj)
    obj.scale = (2, 2, 2)
    assert abs(record(obj).mass[0] / gait.mass[0] - 4.0) < 1e-3
    settings.mass = -0.5
    refused(lambda: record(obj), "-0.5 kg", "Walker", "estimated")


def beast():
    """A four-legged armature of boxes, and its mesh; the limbs' order is that of the feet found."""
    bones = beasts.skeleton()
    hide, volume = beasts.skin(bones)
    armature = bpy.data.armatures.new("Dog")
    obj = meshes.link(bpy.data.objects.new("Dog", armature))
    meshes.activate(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    for k, name in enumerate(bones.names):
        made = armature.edit_bones.new(name)
        made.head = bones.rest[k, :3, 3]
        made.tail = bones.rest[k, :3, 3] + bones.rest[k, :3, 1] * bones.length[k]
        if bones.parents[k] >= 0:
            made.parent = armature.edit_bones[bones.names[bones.parents[k]]]
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = bpy.data.meshes.new("Hide")
    mesh.from_pydata(hide.vertices.tolist(), [], hide.triangles.tolist())
    worn = meshes.link(bpy.data.objects.new("Hide", mesh))
    worn.modifiers.new("Armature", "ARMATURE").object = obj
    for name, share in hide.weights.items():
        worn.vertex_groups.new(name=name).add(np.flatnonzero(share).tolist(), 1.0, "REPLACE")
    return obj, worn, sum(volume.values())


def test_a_beast_weighs_what_its_mesh_holds(folder):
    obj, worn, volume = beast()
    obj.desire_path.mass = 0.0
    gait = record(obj, 8)
    assert len(gait.limb_walker) == 4
    assert abs(gait.mass[0] - 1000.0 * volume) < 0.01 * gait.mass[0], (gait.mass, volume)
    assert any("litres" in told and "Dog" in told for told in gait.warnings), gait.warnings
    assert -0.3 < gait.com[0, 0, 1] < 0.0 and 0.7 < gait.com[0, 0, 2] < 0.85  # the neck pulls it ahead
    obj.desire_path.mass = 30.0
    told = record(obj, 8)
    assert told.mass[0] == 30.0 and abs(told.com - gait.com).max() < 1e-6
    obj.desire_path.mass = 0.0
    bpy.data.objects.remove(worn)
    refused(lambda: record(obj, 8), "Dog", "no mesh is bound", "kilograms")
