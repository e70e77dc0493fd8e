"""The add-on in a zip comes to a Blender, bakes, goes, comes back and is removed; nothing of it is left.

    blender -b --factory-startup --python-exit-code 1 -P tests/package/coming.py -- ZIP VERSION [FOLDER]
    python tests/package/coming.py ZIP VERSION [FOLDER]       (with the bpy module)

Run with a home of its own. What was baked stays in FOLDER (bake/ here), scene.blend beside it is the scene
before. The last line is INSTALLED.
"""

import importlib
import pathlib
import sys

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from scenes import meshes, people

BUTTONS = {"bake", "free", "ground_add", "walker_add", "record", "plants_add", "walk_it"}
FRAMES = 16
EXTENSIONS = bpy.app.version >= (4, 2)


def names(of):
    return {name for name in dir(of) if "desire_path" in name.lower()}


def traces():
    """What an add-on can leave in a running Blender."""
    lists = [getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)]
    functions = [each for entry in lists if isinstance(entry, list) for each in entry]
    for name in dir(bpy.types):
        kind = getattr(bpy.types, name)
        functions += getattr(getattr(kind, "draw", None), "_draw_funcs", ())
    ours = {str(each) for each in functions if "desire_path" in str(getattr(each, "__module__", ""))}
    for kind in ("Object", "Scene", "Mesh", "Curve", "WindowManager", "Collection", "Armature", "PoseBone", "Material"):
        ours |= {f"{kind}.{name}" for name in names(getattr(bpy.types, kind).bl_rna.properties)}
    for spaces in ("object", "wm", "scene", "export_scene", "export_mesh"):
        ours |= {f"{spaces}.{name}" for name in names(getattr(bpy.ops, spaces))}
    for maps in bpy.context.window_manager.keyconfigs:
        ours |= {item.idname for each in maps.keymaps for item in each.keymap_items if "desire_path" in item.idname}
    return ours | names(bpy.types)


def installed(path):
    if EXTENSIONS:
        bpy.ops.extensions.package_install_files(filepath=path, repo="user_default", enable_on_install=False)
        return "bl_ext.user_default.desire_path"
    bpy.ops.preferences.addon_install(filepath=path)
    return "desire_path"


def removed(module):
    home = pathlib.Path(sys.modules[module].__file__).parent
    if EXTENSIONS:
        number = [each.module for each in bpy.context.preferences.extensions.repos].index("user_default")
        bpy.ops.extensions.package_uninstall(repo_index=number, pkg_id="desire_path")
    elif bpy.context.area is not None:
        bpy.ops.preferences.addon_remove(module=module)
    else:
        return  # this operator wants a window
    if sys.platform != "win32":  # Windows keeps a module that was loaded until Blender ends
        assert not home.exists(), home


def baked(module, folder):
    """Somebody walks over a ground with moss, and its maps hold a print."""
    ground = meshes.grid(60, 110, 0.02, -0.6, -1.7)
    assert bpy.ops.object.desire_path_ground_add() == {"FINISHED"}
    ground.desire_path.cell_size, ground.desire_path.folder = 0.02, str(folder)
    assert bpy.ops.object.desire_path_plants_add(kind="moss", density=200.0) == {"FINISHED"}
    walker = people.walk(people.biped(), frames=FRAMES)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    meshes.activate(ground)
    flat = shown(ground)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder.with_name("scene.blend")))
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.bake_state == "FRESH"
    assert len(list((folder / "frames").glob("*.exr"))) >= FRAMES, sorted(folder.iterdir())
    maps = importlib.import_module(module + ".ground.maps")
    whole = maps.read(folder / "maps_final.exr")
    assert whole.planes["compression"].max() > 0.005
    bpy.context.scene.frame_set(FRAMES)
    assert np.abs(shown(ground) - flat).max() > 0.005
    return ground, walker


def shown(ground):
    """Heights of a ground's points, as renders have them."""
    mesh = ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    points = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    return points[2::3].copy() if len(mesh.vertices) == len(ground.data.vertices) else points[2::3].max()


def main():
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    path, version = words[:2]
    folder = pathlib.Path(*words[2:] or ["bake"]).resolve()
    assert bpy.app.version_string.startswith(version), bpy.app.version_string
    bpy.ops.wm.read_factory_settings(use_empty=True)
    before = traces()
    assert not before, before
    module = installed(path)
    assert not traces(), traces()
    for turn in range(3):
        bpy.ops.preferences.addon_enable(module=module)
        assert module in bpy.context.preferences.addons
        assert names(bpy.ops.object) >= {f"desire_path_{name}" for name in BUTTONS}, names(bpy.ops.object)
        if turn == 0:
            ground, walker = baked(module, folder)
        assert ground.desire_path.bake_state == "FRESH" and walker.desire_path.is_walker
        last = shown(ground)
        bpy.ops.preferences.addon_disable(module=module)
        assert module not in bpy.context.preferences.addons
        assert not traces(), traces()
        bpy.context.scene.frame_set(1)  # what was baked plays without it
        bpy.context.scene.frame_set(FRAMES)
        assert np.array_equal(shown(ground), last)
    removed(module)
    assert not traces(), traces()
    bpy.ops.preferences.addon_enable(module=installed(path))  # Blender ends with it
    assert traces()
    if not bpy.app.binary_path:  # which frees its classes before the add-ons that have them
        bpy.ops.preferences.addon_disable(module=module)
    print("INSTALLED")


if __name__ == "__main__":
    main()
