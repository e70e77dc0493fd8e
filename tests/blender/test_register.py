"""The add-on comes, goes and comes back without leftovers."""

import subprocess
import sys

import bpy

import desire_path

OPERATORS = (
    "ground_add",
    "walker_add",
    "bake",
    "free",
    "record",
    "cancel",
    "remove",
    "paint_add",
    "paint_remove",
    "rig_detect",
    "forces_show",
)


def there():
    known = [name for name in dir(bpy.types) if "desire_path" in name.lower()]
    handlers = [
        f
        for group in dir(bpy.app.handlers)
        if isinstance(getattr(bpy.app.handlers, group), list)
        for f in getattr(bpy.app.handlers, group)
        if getattr(f, "__module__", "").startswith("desire_path")
    ]
    return known, hasattr(bpy.types.Object, "desire_path"), len(handlers)


def test_comes_and_goes():
    first = there()
    assert first[1] and first[2] == 8
    for name in OPERATORS:
        getattr(bpy.ops.object, f"desire_path_{name}").get_rna_type()
    for _ in range(3):
        desire_path.unregister()
        assert there() == ([], False, 0), there()
        desire_path.register()
        assert there() == first


def test_descriptions_are_sentences():
    for name in OPERATORS:
        words = getattr(bpy.ops.object, f"desire_path_{name}").get_rna_type().description
        assert len(words) > 20 and words[0].isupper() and not words.endswith("."), words
    settings = bpy.types.Object.bl_rna.properties["desire_path"].fixed_type
    assert len(settings.properties) > 15
    for name, prop in settings.properties.items():
        if name not in {"rna_type", "name"} and not prop.is_hidden:
            assert prop.description, name


def test_defaults():
    obj = bpy.data.objects.new("a", None)
    settings = obj.desire_path
    assert settings.mass == 75.0 and settings.load_model == "inertia"
    assert settings.soil == "dry-sand" and abs(settings.cell_size - 0.01) < 1e-9
    for number, soil in enumerate(("dry-sand", "snow", "mud", "soil", "soft-soil", "dry-soil", "wet-soil")):
        settings.soil = soil
        assert settings.soil == soil and settings["soil"] == number  # as files of before have it


def test_version_is_a_literal():
    assert desire_path.bl_info["version"] == (0, 1, 0)
    assert desire_path.__version__ == "0.1.0"


def test_importable_without_bpy():
    import pathlib

    place = pathlib.Path(desire_path.__file__).parent.parent
    script = (
        "import sys; sys.modules['bpy'] = None; sys.path.insert(0, sys.argv[1]); "
        "import desire_path; print(desire_path.bl_info['version'])"
    )
    python = sys.executable
    done = subprocess.run([python, "-c", script, str(place)], capture_output=True, text=True)
    assert done.returncode == 0 and "(0, 1, 0)" in done.stdout, done.stdout + done.stderr


def test_a_script_that_only_registers_ends(folder):
    # with bpy as a module a registered class must not keep Python from ending
    import pathlib

    if bpy.app.binary_path:
        return
    place = pathlib.Path(desire_path.__file__).parent.parent
    script = "import sys, bpy; sys.path.insert(0, sys.argv[1]); import desire_path; desire_path.register()"
    done = subprocess.run([sys.executable, "-c", script, str(place)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
