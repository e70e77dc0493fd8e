"""A bake belongs to one ground of one file: nobody else replaces it, frees it, or plays another's for it."""

import json
import os
import resource
import shutil
import signal
import stat

import bpy
import numpy as np
from scenes import meshes
from test_bake import PLAYS, refused, scene
from test_playback import fresh, shown

from desire_path.bake import bake
from desire_path.blender import compat, home, playback, trash


def saved(path, **more):
    """A scene of its own in a file of its own."""
    path.parent.mkdir(exist_ok=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return scene(**more)


def opened(path):
    bpy.ops.wm.open_mainfile(filepath=str(path))
    ground = bpy.data.objects["Ground"]
    meshes.activate(ground)
    return ground


def free():
    """Free the active ground, for good."""
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    trash.empty()


def owner(place):
    return json.loads((place / "frames" / "index.json").read_text())["bake_folder_owner"]


def files(place):
    """Every file below a folder, with what is in it."""
    return {str(path.relative_to(place)): path.read_bytes() for path in place.rglob("*") if path.is_file()}


def test_two_files_in_one_folder(folder):
    ground, _ = saved(folder / "one.blend", frames=12)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    wanted, _ = shown(ground, 12)
    bpy.ops.wm.save_mainfile()
    kept = files(folder / "desire_path" / "one" / "Ground")

    # another file with a ground of the same name
    ground, walker = saved(folder / "two.blend", frames=12)
    walker.desire_path.mass = 30.0
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.folder == "//desire_path/two/Ground"
    free()
    assert files(folder / "desire_path") == {f"one/Ground/{name}": data for name, data in kept.items()}
    assert shown(opened(folder / "one.blend"), 12)[0].tobytes() == wanted.tobytes()


def test_save_as_makes_the_next_bake_its_own(folder):
    ground, walker = saved(folder / "one.blend", frames=12)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    wanted, _ = shown(ground, 12)
    bpy.ops.wm.save_mainfile()
    first = folder / "desire_path" / "one" / "Ground"
    kept = files(first)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "two.blend"))
    ground = opened(folder / "two.blend")
    assert shown(ground, 12)[0].tobytes() == wanted.tobytes()  # it plays the bake there is
    free()
    assert files(first) == kept
    bpy.data.objects["Walker"].desire_path.mass = 30.0
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    second = folder / "desire_path" / "two" / "Ground"
    assert files(first) == kept and owner(second) != owner(first)
    other, _ = shown(ground, 12)
    assert other.tobytes() != wanted.tobytes()

    # closed without being saved: the same place is found again
    again = owner(second)
    ground = opened(folder / "two.blend")
    bpy.data.objects["Walker"].desire_path.mass = 30.0
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.folder == "//desire_path/two/Ground" and owner(second) == again
    bpy.ops.wm.save_mainfile()
    assert shown(opened(folder / "one.blend"), 12)[0].tobytes() == wanted.tobytes()
    assert shown(opened(folder / "two.blend"), 12)[0].tobytes() != wanted.tobytes()


def test_a_folder_chosen_by_hand_holds_one_bake(folder):
    ground, _ = saved(folder / "one.blend", folder=folder, frames=8)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.ops.wm.save_mainfile()
    kept = files(folder / "bake")
    (folder / "there").mkdir()
    for other in (folder / "two.blend", folder / "there" / "one.blend"):
        bpy.ops.wm.save_as_mainfile(filepath=str(other))
        ground = opened(other)
        refused(bpy.ops.object.desire_path_bake, str(folder / "bake"), "another file", "choose another folder")
        free()
        assert files(folder / "bake") == kept
        ground.desire_path.folder = str(folder / "other")
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        free()
        opened(folder / "one.blend")
    ground = opened(folder / "one.blend")
    ground.desire_path.folder = str(folder / "other")  # to and fro
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    ground.desire_path.folder = str(folder / "bake")
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    saved(folder / "three.blend", folder=folder, frames=8)
    refused(bpy.ops.object.desire_path_bake, "another ground")


def test_copies_in_one_file(folder):
    ground, walker = saved(folder / "one.blend", frames=8)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    wanted, _ = shown(ground, 8)
    kept = files(folder / "desire_path")
    for name in ("Meadow", "Ground"):  # which of them carries the old name does not matter
        ground.name = "Renamed"
        copy = meshes.link(ground.copy())
        copy.data = ground.data.copy()
        copy.name = name
        walker.desire_path.ground = copy
        walker.desire_path.mass = 40.0
        meshes.activate(copy)
        if name == "Ground":
            copy.desire_path.folder = ground.desire_path.folder
            refused(bpy.ops.object.desire_path_bake, "same folder")
            copy.desire_path.folder_auto = True
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        assert shown(ground, 8)[0].tobytes() == wanted.tobytes() != shown(copy, 8)[0].tobytes()
        assert files(folder / "desire_path").items() >= kept.items()
        assert copy.desire_path.bake_id != ground.desire_path.bake_id
        free()
        assert files(folder / "desire_path") == kept
        bpy.data.objects.remove(copy)
    walker.desire_path.ground = ground
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.folder == "//desire_path/one/Ground"


def test_appended_grounds_leave_the_files_where_they_come_from(folder):
    ground, _ = saved(folder / "one.blend", frames=8)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    wanted, _ = shown(ground, 8)
    bpy.ops.wm.save_mainfile()
    kept = files(folder / "desire_path")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "two.blend"))
    with bpy.data.libraries.load(str(folder / "one.blend")) as (_, wants):
        wants.objects = ["Ground", "Walker"]
    for each in wants.objects:
        meshes.link(each)
    ground = bpy.data.objects["Ground"]
    bpy.context.scene.render.fps = 24
    assert shown(ground, 8)[0].tobytes() == wanted.tobytes()
    meshes.activate(ground)
    bpy.data.objects["Walker"].desire_path.mass = 30.0
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    free()
    assert files(folder / "desire_path") == kept


def test_the_folder_of_the_file_itself_may_be_chosen(folder):
    ground, _ = saved(folder / "one.blend", frames=8)
    ground.desire_path.folder = "//"
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    wanted, _ = shown(ground, 8)
    assert wanted[:, 2].min() < -0.004 and ground.desire_path.bake_state == "FRESH"
    bpy.ops.wm.save_mainfile()
    ground = opened(folder / "one.blend")
    assert shown(ground, 8)[0].tobytes() == wanted.tobytes()
    free()
    bpy.ops.wm.save_mainfile()
    assert all(name.startswith("one.blend") for name in os.listdir(folder))


def test_moved_and_renamed_it_keeps_its_folder(folder):
    ground, _ = saved(folder / "here" / "one.blend", frames=8)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.ops.wm.save_mainfile()
    (folder / "here").rename(folder / "there")
    ground = opened(folder / "there" / "one.blend")
    before = owner(folder / "there" / "desire_path" / "one" / "Ground")
    ground.name = "Beach"
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.folder == "//desire_path/one/Ground"
    assert owner(folder / "there" / "desire_path" / "one" / "Ground") == before
    free()
    assert not (folder / "there" / "desire_path").exists()


def test_an_unsaved_bake_moves_beside_the_file(folder):
    bpy.ops.ed.undo_push(message="start")
    ground, _ = scene(frames=24)
    place = ground.desire_path.folder
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    top = os.stat(os.path.dirname(place))
    assert stat.S_IMODE(top.st_mode) == 0o700 and top.st_uid == os.getuid()
    wanted, _ = shown(ground, 20)
    bpy.ops.ed.undo_push(message="baked")
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "copy.blend"), copy=True)
    assert ground.desire_path.folder == place and os.path.isdir(place)
    bpy.ops.ed.undo_push(message="saved a copy")
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "one.blend"))
    assert ground.desire_path.folder == "//desire_path/one/Ground" and not os.path.exists(place)
    assert bake.read_index(str(folder / "desire_path" / "one" / "Ground")).owner == ground.desire_path.bake_id
    assert shown(ground, 20)[0].tobytes() == wanted.tobytes()
    bpy.ops.ed.undo_push(message="saved")
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    ground = bpy.data.objects["Ground"]
    assert shown(ground, 20)[0].tobytes() == wanted.tobytes() and not ground.desire_path.missing
    assert ground.desire_path.folder == "//desire_path/one/Ground"

    bpy.ops.wm.read_factory_settings(use_empty=True)
    fresh(PLAYS, folder / "one.blend", folder / "out.npy")
    assert np.load(folder / "out.npy").tobytes() == wanted.tobytes()
    ground = opened(folder / "one.blend")
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.folder == "//desire_path/one/Ground"


def test_a_folder_others_can_look_into_is_not_used(folder):
    first = home.temporary()
    os.chmod(first, 0o755)
    second = home.temporary()
    assert second != first and stat.S_IMODE(os.stat(second).st_mode) == 0o700
    shutil.rmtree(first)  # bakes of before may lie in it
    os.rmdir(second)
    os.symlink(folder, second)
    third = home.temporary()
    assert third not in (first, second)
    os.unlink(second)
    os.rmdir(third)


def test_bakes_of_before_play_on_and_are_left_alone(folder):
    ground, _ = saved(folder / "one.blend", frames=12)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    wanted, _ = shown(ground, 12)
    (folder / "desire_path" / "one" / "Ground").rename(folder / "desire_path" / "Ground")
    old = folder / "desire_path" / "Ground"
    playback.repoint(str(folder / "desire_path" / "one" / "Ground"), "//desire_path/Ground")
    ground.desire_path.folder, ground.desire_path.folder_auto = "//desire_path/Ground", True
    ground.desire_path.bake_id = ground.desire_path.bake_file = ground.desire_path.bake_seen = ""
    index = json.loads((old / "frames" / "index.json").read_text())
    del index["bake_folder_owner"]
    (old / "frames" / "index.json").write_text(json.dumps(index))
    bpy.ops.wm.save_mainfile()
    kept = files(old)
    ground = opened(folder / "one.blend")
    assert shown(ground, 12)[0].tobytes() == wanted.tobytes() != compat.positions(ground.data).tobytes()
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.folder == "//desire_path/one/Ground" and files(old) == kept


def test_a_save_that_fails_takes_no_bake_away(folder):
    """A full disk, played by a limit on the size of files: Blender leaves paths as seen from where it did not get."""
    ground, _ = saved(folder / "one.blend", frames=12)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"} and ground.desire_path.bake_state == "FRESH"
    (folder / "far" / "away").mkdir(parents=True)
    away = str(folder / "far" / "away" / "two.blend")
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4_000, before[1]))
    try:
        refused(lambda: bpy.ops.wm.save_as_mainfile(filepath=away, compress=False), "")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    if hasattr(bpy.app.handlers, "save_post_fail"):
        assert ground.desire_path.bake_state == "FRESH"
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "far" / "two.blend"))
    assert ground.desire_path.bake_state == "FRESH"
    assert opened(folder / "far" / "two.blend").desire_path.bake_state == "FRESH"
