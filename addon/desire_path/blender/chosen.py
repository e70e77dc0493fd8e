"""chosen.py - which objects are grounds, and who walks on them."""

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
        f"'{obj.name}' is off in renders, by itself or by its collection, and leaves no prints."
        for obj in _chosen(scene, ground)
        if not worn.walks(scene, obj)
    ]


def _chosen(scene, ground):
    return [
        obj
        for obj in scene.objects
        if obj.type in WALKERS and obj.desire_path.is_walker and obj.desire_path.ground == ground
    ]
