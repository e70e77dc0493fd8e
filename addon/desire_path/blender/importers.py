"""importers.py - whether importers of characters that came with this Blender fail on the Python that runs it.

Those of Blender 3.4 do in Debian 12, whose Python and NumPy have dropped what they use; README tells of it, too.
"""

import functools
import os
import shlex
import sys

import bpy

FAULTS = (  # (what is imported, file among the add-ons, what newer ones do not know, what sed is to do)
    ("BVH", "io_anim_bvh/import_bvh.py", "'rU'", "s/rU/r/"),
    ("glTF", "io_scene_gltf2/blender/imp/gltf2_blender_mesh.py", "np.bool)", "s/np.bool)/bool)/"),
)


def cures(folders):
    """(what is imported, the command that mends it) of importers in folders of add-ons that fail."""
    found = []
    for folder in folders:
        for kind, name, fault, change in FAULTS:
            path = os.path.join(folder, *name.split("/"))
            try:
                with open(path, encoding="utf-8") as file:
                    if fault in file.read():
                        found.append((kind, f"sed -i {shlex.quote(change)} {shlex.quote(path)}"))
            except (OSError, UnicodeDecodeError):
                continue
    return found


@functools.cache
def own_cures():
    """The same of this Blender, as it was when it was first asked for."""
    old = bpy.app.version < (4, 0) and sys.version_info >= (3, 11)
    return cures(bpy.utils.script_paths(subdir="addons")) if old else []
