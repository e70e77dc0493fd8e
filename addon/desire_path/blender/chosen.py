"""chosen.py - which objects are grounds, and who walks on them."""

import bpy

from .late import worn

WALKERS = {"ARMATURE", "MESH"}


def grounds(scene):
    return [obj for obj in scene.objects if obj.type == "MESH" and obj.desire_path.is_ground]


def walkers(scene, ground):
    """Who walks on a ground: armatures, and meshes that move as rigid bodies, unless renders leave them out."""
    return [obj for obj in _chosen(scene, ground) if worn.walks(scene, obj)]


def absent(scene, ground):
    """Sentences about walkers of a ground that renders leave out."""
    return [
        f"'{obj.name}' is off in renders or in the view layer, by itself or by its collection, and leaves no prints."
        for obj in _chosen(scene, ground)
        if not worn.walks(scene, obj)
    ]


def elsewhere(scene, ground):
    """Sentences about walkers of a ground that other scenes show, and this one does not."""
    return [
        f"'{obj.name}' walks on '{ground.name}' in the scene '{obj.users_scene[0].name}' only: link it to "
        f"'{scene.name}', or bake there."
        for obj in bpy.data.objects
        if _walks_on(obj, ground) and obj.users_scene and scene not in obj.users_scene
    ]


def _chosen(scene, ground):
    return [obj for obj in scene.objects if _walks_on(obj, ground)]


def _walks_on(obj, ground):
    return obj.type in WALKERS and obj.desire_path.is_walker and obj.desire_path.ground == ground
