"""Importers that fail on the Python of this Blender are told of by Walk It, with what mends them."""

import os
import shutil
import subprocess
import sys
import tempfile

import bpy
from scenes import meshes
from test_bake import refused
from test_walk_it import select

from desire_path.blender import importers

FAILING = {  # file: (a line of it, the same mended)
    "io_anim_bvh/import_bvh.py": ("    file = open(file_path, 'rU')\n", "    file = open(file_path, 'r')\n"),
    "io_scene_gltf2/blender/imp/gltf2_blender_mesh.py": (
        "    smooths = np.empty(number, dtype=np.bool)\n",
        "    smooths = np.empty(number, dtype=bool)\n",
    ),
}


def test_what_is_told_mends_them():
    home = os.path.join(tempfile.mkdtemp(), "add ons")  # a shell parts the words
    try:
        assert importers.cures([home]) == []
        for name, (line, _) in FAILING.items():
            os.makedirs(os.path.dirname(os.path.join(home, name)))
            with open(os.path.join(home, name), "w") as file:
                file.write(line)
        cures = importers.cures([home])
        assert [kind for kind, _ in cures] == ["BVH", "glTF"]
        for _, command in cures:
            subprocess.run(command, shell=True, check=True)
        for name, (_, mended) in FAILING.items():
            with open(os.path.join(home, name)) as file:
                assert file.read() == mended
        assert importers.cures([home]) == []
    finally:
        shutil.rmtree(os.path.dirname(home))


def test_walk_it_tells_of_those_of_this_blender():
    select(meshes.grid(4, 4, 1.0))
    cures = importers.own_cures()
    refused(bpy.ops.object.desire_path_walk_it, "Select a character", *cures[0] if cures else ["if there is one"])
    if cures:
        assert bpy.app.version < (4, 0) and sys.version_info >= (3, 11)
