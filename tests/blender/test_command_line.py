"""`blender --command desire_path bake`: what a farm calls bakes a file, tells what it did, and ends with a code."""

import json
import pathlib
import subprocess

import bpy
from test_bake_all import land

from desire_path.blender import command_line


def saved(folder, *names):
    """A file with grounds that somebody walks on, and nothing baked."""
    for x, name in enumerate(names):
        land(name, 5.0 * x, folder)
    path = folder / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return path


def asked(path, folder, *words):
    code = command_line.run(["bake", str(path), "--report", str(folder / "told.json"), *words])
    return code, json.loads((folder / "told.json").read_text(encoding="utf-8"))


def test_one_ground_is_baked_and_the_file_plays_it(folder):
    path = saved(folder, "Beach", "Field")
    code, told = asked(path, folder, "--ground", "Field", "--save")
    assert code == 0 and told["problems"] == [] and told["saved"], told
    assert [each["name"] for each in told["grounds"]] == ["Field"]
    assert (pathlib.Path(told["grounds"][0]["folder"]) / "report.json").exists()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=str(path))
    assert bpy.data.objects["Field"].desire_path.bake_state == "FRESH"
    assert bpy.data.objects["Beach"].desire_path.bake_state == "NONE"


def test_without_a_name_all_are_baked_and_the_file_stays(folder):
    path = saved(folder, "Beach", "Field")
    before = path.read_bytes()
    code, told = asked(path, folder)
    assert code == 0 and not told["saved"], told
    assert sorted(each["name"] for each in told["grounds"]) == ["Beach", "Field"]
    assert path.read_bytes() == before


def test_what_cannot_be_baked_is_told_and_the_rest_is_baked(folder):
    land("Beach", 0.0, folder)
    alone, walker = land("Field", 5.0, folder)
    bpy.data.objects.remove(walker)
    path = folder / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    code, told = asked(path, folder, "--ground", "Field", "--ground", "Beach")
    assert code == 1 and [each["name"] for each in told["grounds"]] == ["Beach"], told
    assert len(told["problems"]) == 1 and "'Field' was not baked: Nobody walks" in told["problems"][0]


def test_wrong_words_are_told_in_a_sentence(folder):
    path = saved(folder, "Beach")
    for words, part in (
        ((path, "--ground", "Sea"), "There is no ground 'Sea' in 'Scene', whose grounds are: 'Beach'."),
        ((path, "--scene", "Night"), "There is no scene 'Night'"),
        ((folder / "none.blend",), "is not there"),
    ):
        code, told = asked(words[0], folder, *words[1:])
        assert code == 1 and part in told["problems"][0] and told["grounds"] == [], (words, told)
    assert command_line.run([]) == 2 and command_line.run(["bake"]) == 2
    assert command_line.run(["bake", "--help"]) == 0
    assert command_line.run(["bake", str(path), "--report", str(folder / "no" / "a.json")]) == 1


def test_blender_itself_calls_it(folder):
    """Where a whole Blender of 4.2 or later runs this."""
    if not bpy.app.binary_path or bpy.app.version < (4, 2):
        assert (command_line._handle is None) == (bpy.app.version < (4, 2))
        return
    path = saved(folder, "Beach")
    addon = pathlib.Path(command_line.__file__).parents[2]
    start = folder / "scripts" / "startup"
    start.mkdir(parents=True)
    (start / "start.py").write_text(
        f"import sys\nsys.path.insert(0, {str(addon)!r})\nimport desire_path\n"
        "def register():\n    desire_path.register()\n"
    )
    words = ["bake", str(path), "--ground", "Beach", "--report", str(folder / "told.json")]
    for extra, code in (([], 0), (["--ground", "Sea"], 1)):
        done = subprocess.run(
            [bpy.app.binary_path, "--command", "desire_path", *words, *extra],
            env={"PATH": "/usr/bin:/bin", "HOME": str(folder), "BLENDER_USER_SCRIPTS": str(folder / "scripts")},
            capture_output=True,
            text=True,
            timeout=300,
        )
        told = json.loads((folder / "told.json").read_text(encoding="utf-8"))
        assert done.returncode == code and bool(told["problems"]) == bool(code), done.stdout + done.stderr
