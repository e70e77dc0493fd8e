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
    "place_feet",
    "balance",
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
    assert first[1] and first[2] == 1 + hasattr(bpy.app.handlers, "blend_import_post")
    for name in OPERATORS:
        getattr(bpy.ops.object, f"desire_path_{name}").get_rna_type()
    for _ in range(3):
        desire_path.unregister()
        assert there() == ([], False, 0), there()
        desire_path.register()
        assert there() == first


def test_handlers_come_with_a_ground_and_go_with_its_file(folder):
    idle = there()[2]
    obj = bpy.data.objects.new("a", bpy.data.meshes.new("a"))
    bpy.context.scene.collection.objects.link(obj)
    obj.desire_path.mass = 80.0
    assert there()[2] == idle
    obj.desire_path.is_ground = True
    needed = there()[2]
    assert needed >= idle + 7
    path = str(folder / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    assert there()[2] == idle
    bpy.ops.wm.open_mainfile(filepath=path)
    assert there()[2] == needed
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path) as (held, wanted):
        wanted.objects = held.objects
    assert there()[2] == (needed if hasattr(bpy.app.handlers, "blend_import_post") else idle)
    desire_path.unregister()
    assert there()[2] == 0
    desire_path.register()
    assert there()[2] == needed  # a ground is there


def test_enabling_loads_neither_numpy_nor_the_core():
    import pathlib

    place = pathlib.Path(desire_path.__file__).parent.parent
    script = (
        f"import sys, bpy; sys.path.insert(0, {str(place)!r}); before = set(sys.modules); import desire_path; "
        "desire_path.register(); new = set(sys.modules) - before; print('loaded', *sorted(new)); "
        "desire_path.unregister()"
    )
    run = [sys.executable, "-c", script]
    if bpy.app.binary_path:
        run = [bpy.app.binary_path, "-b", "--factory-startup", "--python-exit-code", "1", "--python-expr", script]
    done = subprocess.run(run, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    loaded = next(line for line in done.stdout.splitlines() if line.startswith("loaded")).split()
    heavy = ("numpy", "json", "concurrent", "tempfile", "ctypes", "desire_path.bake", "desire_path.motion")
    heavy += ("desire_path.loads", "desire_path.placement", "desire_path.rig", "desire_path.blender.handlers")
    missed = [each for each in loaded if each.startswith(heavy)]
    assert not missed and len([each for each in loaded if each.startswith("desire_path")]) < 57, missed


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
    assert desire_path.bl_info["version"] == tuple(int(part) for part in desire_path.__version__.split("."))


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
