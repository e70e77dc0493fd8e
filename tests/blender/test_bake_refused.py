"""What cannot be baked is said in a sentence, and nothing that was baked is lost."""

import json
import os
import pathlib
import subprocess
import sys
import time

import bpy
import numpy as np
from scenes import hands, meshes, people
from test_bake import refused, scene
from test_playback import shown

from desire_path.bake import bake
from desire_path.blender import op_bake, playback
from desire_path.files import atomic_file

# ---- what is wrong is said in a sentence ------------------------------------------------------------


def test_what_is_missing_or_belongs_to_another(folder):
    operator = bpy.ops.object
    refused(operator.desire_path_ground_add, "mesh")
    refused(operator.desire_path_bake, "ground")
    stick = meshes.link(bpy.data.objects.new("Stick", bpy.data.armatures.new("Stick")))
    meshes.activate(stick)
    refused(operator.desire_path_walker_add, "no ground", "Add Ground")
    points = meshes.link(bpy.data.objects.new("Points", bpy.data.meshes.new("Points")))
    meshes.activate(points)
    refused(operator.desire_path_ground_add, "no faces")
    cube = meshes.grid(4, 4, 1.0, name="Plain")
    meshes.activate(cube)
    refused(operator.desire_path_walker_add, "no ground", "Add Ground")
    light = meshes.link(bpy.data.objects.new("Light", bpy.data.lights.new("Light", "POINT")))
    meshes.activate(light)
    refused(operator.desire_path_walker_add, "armature", "mesh")
    refused(operator.desire_path_record, "armature", "mesh")
    meshes.activate(cube)
    refused(operator.desire_path_bake, "no ground yet")
    refused(operator.desire_path_free, "no ground")
    ground, walker = scene(folder, frames=10)
    settings = ground.desire_path
    meshes.activate(stick)
    refused(operator.desire_path_walker_add, "no bones")
    second = meshes.grid(4, 4, 1.0, name="Second")
    meshes.activate(second)
    assert operator.desire_path_ground_add() == {"FINISHED"}
    refused(operator.desire_path_bake, "Nobody walks")
    lost = people.biped("Lost")
    meshes.activate(lost)
    refused(operator.desire_path_walker_add, "several grounds")
    second.select_set(True)
    assert operator.desire_path_walker_add() == {"FINISHED"}
    assert lost.desire_path.ground == second
    meshes.activate(second)
    second.desire_path.folder = settings.folder
    refused(operator.desire_path_bake, "same folder")
    second.desire_path.folder = str(folder / "second")
    bpy.data.objects.remove(lost)  # it stands on both
    meshes.activate(ground)


def test_bad_numbers_and_places(folder):
    ground, walker = scene(folder, frames=10)
    settings = ground.desire_path
    for first, last in ((5, 5), (9, 2)):
        settings.frame_start, settings.frame_end = first, last
        refused(bpy.ops.object.desire_path_bake, f"{first} to {last}")
    settings.frame_start, settings.frame_end = 1, 10
    for cell in (0.0, -1.0, 1e-7, 50.0, float("nan")):
        settings.cell_size = cell
        refused(bpy.ops.object.desire_path_bake, "A cell size of", "choose")
    settings.cell_size = 0.02
    walker.desire_path.mass = -70.0
    refused(bpy.ops.object.desire_path_bake, "mass")
    walker.desire_path.mass = float("inf")
    refused(bpy.ops.object.desire_path_bake, "mass")
    walker.desire_path.mass = 75.0
    walker.scale = (1e-5,) * 3
    refused(bpy.ops.object.desire_path_bake, "scale")
    walker.scale = (1.0,) * 3
    walker.desire_path.feet[0].foot = "foot.R"
    refused(bpy.ops.object.desire_path_bake, "'foot.R'", "both")
    walker.desire_path.feet[0].foot = "foot.L"
    walker.location.z = -30.0
    refused(bpy.ops.object.desire_path_bake, "below the ground", "roofs")
    walker.location.z = 0.0
    walker.location.x = 500.0
    refused(bpy.ops.object.desire_path_bake, "beside the ground")
    walker.location.x = 0.0


def test_bad_bones_and_folders(folder):
    operator = bpy.ops.object
    ground, walker = scene(folder, frames=10)
    settings = ground.desire_path
    walker.data.bones["foot.L"].name = "renamed"
    refused(operator.desire_path_bake, "'foot.L'", "renamed")
    meshes.activate(walker)
    refused(operator.desire_path_record, "'foot.L'", filepath=str(folder / "walk.npz"))
    walker.data.bones["renamed"].name = "foot.L"
    refused(operator.desire_path_record, "cannot be written", filepath=str(folder / "nowhere" / "walk.npz"))
    meshes.activate(ground)
    (folder / "file").write_text("in the way")
    settings.folder = str(folder / "file")
    refused(operator.desire_path_bake, str(folder / "file"))
    settings.folder = "//somewhere"
    refused(operator.desire_path_bake, "save the file")
    settings.folder = str(folder / "bake")
    ground.rotation_euler.x = np.pi / 2
    refused(operator.desire_path_bake, "upright")
    ground.rotation_euler.x = 0.0
    assert operator.desire_path_bake() == {"FINISHED"}
    assert len(bpy.data.scenes) == 1


def test_names_that_are_taken(folder):
    ground, _ = scene(folder, frames=8, cell=0.03)
    for name in ("compression", "heap"):
        ground.vertex_groups.new(name=name).add((0, 1), 0.5, "REPLACE")
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    told = " ".join(json.loads(ground.desire_path.summary)["warnings"])
    for name in ("compression", "heap"):
        assert f"has a vertex group '{name}' of its own: it was left alone" in told, told
        assert name not in ground.data.attributes and ground.vertex_groups[name].weight(1) == 0.5
    assert "pressure_time" in ground.data.attributes and shown(ground, 8)[0][:, 2].min() < -0.004

    for name in ("desire_path", "desire_path_lean"):
        taken = ground.data.attributes.new(name, "FLOAT", "POINT")
        group = ground.vertex_groups.new(name=name)
        if name in ground.data.attributes:
            refused(bpy.ops.object.desire_path_bake, f"attribute and a vertex group '{name}'", "rename or remove")
        ground.vertex_groups.remove(group)
        ground.data.attributes.remove(taken)
    assert ground.desire_path.bake_state == "FRESH", ground.desire_path.missing


def test_full_disk_keeps_what_was_baked(folder):
    ground, _ = scene(folder, frames=12)
    with hands.full_disk("trail_0007.exr"):
        refused(bpy.ops.object.desire_path_bake, "No space left", "room")
    assert "frames 1 to 6 play" in ground.desire_path.missing
    sixth, _ = shown(ground, 6)
    later, _ = shown(ground, 12)
    assert sixth.tobytes() == later.tobytes()
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert not ground.desire_path.missing
    index = bake.read_index(str(folder / "bake"))
    assert index.complete and index.frames == 12


KILLED = """
import sys, bpy
sys.path.insert(0, sys.argv[-2])
import desire_path
desire_path.register()
bpy.ops.wm.open_mainfile(filepath=sys.argv[-1])
import time
from desire_path import bake, sim
real = sim.Film.write_frame
def slow(self, path, moment):
    real(self, path, moment)
    time.sleep(0.05)
sim.Film.write_frame = slow
bpy.context.view_layer.objects.active = bpy.data.objects["Ground"]
bpy.ops.object.desire_path_bake()
"""


def test_killed_in_the_middle(folder):
    (folder / "here").mkdir()
    file = str(folder / "here" / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    ground, _ = scene(frames=30)
    bpy.ops.wm.save_mainfile()
    addon = pathlib.Path(op_bake.__file__).parents[2]
    path = os.environ["PATH"]
    if bpy.app.binary_path:
        command = [bpy.app.binary_path, "-b", "--factory-startup", "--python-expr", KILLED, "--", str(addon), file]
        path = "/usr/bin:/bin"
    else:
        command = [sys.executable, "-c", KILLED, str(addon), file]
    child = subprocess.Popen(
        command, env={**os.environ, "PATH": path}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    place = folder / "here" / "desire_path" / "a" / "Ground"
    until = time.monotonic() + 60
    while not list(place.rglob("trail_0006.exr")) and time.monotonic() < until:
        assert child.poll() is None, child.stdout.read().decode()
        time.sleep(0.01)
    child.kill()
    child.wait()
    child.stdout.close()
    bpy.ops.wm.open_mainfile(filepath=file)
    ground = bpy.data.objects["Ground"]
    index = bake.read_index(str(place))
    assert not index.complete and 6 <= index.frames < 30
    assert playback.modifier(ground) is not None
    assert f"frames 1 to {index.frames} play" in ground.desire_path.missing
    position, colour = shown(ground, index.frames)
    assert colour.any()
    assert shown(ground, 30)[0].tobytes() == position.tobytes()
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert not ground.desire_path.missing
    assert bake.read_index(str(place)).complete
    assert shown(ground, index.frames)[0].tobytes() == position.tobytes()


def test_lost_and_foreign_files_are_said(folder):
    (folder / "here").mkdir()
    file = str(folder / "here" / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    ground, _ = scene(frames=6)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.ops.wm.save_mainfile()
    place = folder / "here" / "desire_path" / "a" / "Ground" / "frames"
    text = (place / "index.json").read_text()
    (place / "index.json").write_text(text.replace('"format": 1', '"format": 99'))
    bpy.ops.wm.open_mainfile(filepath=file)
    assert "another form" in bpy.data.objects["Ground"].desire_path.missing
    (place / "index.json").write_text("{")
    bpy.ops.wm.open_mainfile(filepath=file)
    assert "damaged" in bpy.data.objects["Ground"].desire_path.missing
    (place / "index.json").write_text(text)
    data = (place / "trail_0004.exr").read_bytes()
    for wrong in (None, data[:-1], bytes(len(data))):  # gone, cut short, nothing but zeros
        (place / "trail_0004.exr").unlink()
        if wrong is not None:
            (place / "trail_0004.exr").write_bytes(wrong)
        bpy.ops.wm.open_mainfile(filepath=file)
        ground = bpy.data.objects["Ground"]
        assert "1 to 3 play, 4 to 6 are missing" in ground.desire_path.missing, ground.desire_path.missing
        assert shown(ground, 4)[0].tobytes() == shown(ground, 3)[0].tobytes()
        (place / "trail_0004.exr").write_bytes(data)
    (place / "trail_0004.exr").unlink()
    bpy.ops.wm.open_mainfile(filepath=file)
    ground = bpy.data.objects["Ground"]
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert not ground.desire_path.missing


def test_full_disk_after_the_last_frame_is_said_and_leaves_what_was(folder):
    """The frames are there, their report cannot be written: nothing plays that is half, and the state is as before."""
    ground, _ = scene(folder, frames=12)
    real = atomic_file.file

    def full(path, *more, **options):
        if str(path).endswith("report.json"):
            raise OSError(28, "No space left on device", str(path))
        return real(path, *more, **options)

    for state in ("NONE", "OUTDATED"):
        atomic_file.file = full
        try:
            refused(bpy.ops.object.desire_path_bake, "report", "No space left", "room")
        finally:
            atomic_file.file = real
        assert ground.desire_path.bake_state == state
        assert (playback.modifier(ground) is None) == (state == "NONE")
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        assert ground.desire_path.bake_state == "FRESH"
        ground.desire_path.soil = "mud"
