"""grass.py - plants that can be seen: native geometry nodes on the roots, bent by a bake's images.

The points are placed once, by the core, on the ground as it lies before any bake, so that no root ever jumps.
Everything is in metres and in the world's axes. Only tufts that the frame's images show as touched are made real and
bent; all others are instances: cost follows the feet. The nodes that do so are in grass_tree.py.
"""

import bpy
import numpy as np

from . import clock, grass_tree, playback, playback_tree, tree_numbers, tufts
from .grass_tree import PICK, SIZE, SLOPE, TURN
from .tufts import TONE

TAG = playback_tree.TAG
MODIFIER = "Desire Path Grass"


# ---- the object ------------------------------------------------------------------------------------


def make(ground, name):
    """An object for a ground's grass, a child of the ground; `fill` gives it roots."""
    mesh = bpy.data.meshes.new(f"{ground.name} {tufts.label(name)}")
    obj = bpy.data.objects.new(mesh.name, mesh)
    for collection in ground.users_collection:
        collection.objects.link(obj)
    obj[TAG] = 1
    obj.modifiers.new(MODIFIER, "NODES")
    return obj


def stand_on(obj, ground, scale):
    """Let an object's points be metres in the world, and go along where the ground is moved."""
    obj.parent = ground
    obj.matrix_parent_inverse = ground.matrix_world.inverted()
    obj.matrix_basis = ((1 / scale, 0, 0, 0), (0, 1 / scale, 0, 0), (0, 0, 1 / scale, 0), (0, 0, 0, 1))


def fill(obj, ground, place, slope, sizes, count, scale):
    """Let an object's points be these roots.

    place: world position (n, 3) [m]; slope: rise of the ground along x and y (n, 2)
    sizes: smallest and largest plant; count: how many tufts there are to choose of
    scale: metres in a unit [m]
    """
    stand_on(obj, ground, scale)
    mesh = obj.data
    mesh.clear_geometry()
    mesh.vertices.add(len(place))
    mesh.vertices.foreach_set("co", np.ascontiguousarray(place, np.float32).ravel())
    chance = _chances(place, 4)
    tufts.store(mesh, TURN, "FLOAT", 2 * np.pi * chance[0])
    tufts.store(mesh, SIZE, "FLOAT", sizes[0] + (sizes[1] - sizes[0]) * chance[1])
    tufts.store(mesh, TONE, "FLOAT", chance[2])
    tufts.store(mesh, PICK, "INT", np.minimum(chance[3] * count, count - 1))
    tufts.store(mesh, SLOPE, "FLOAT_VECTOR", np.concatenate([slope, np.zeros((len(slope), 1))], axis=1))
    mesh.update()


def _chances(place, count):
    """Even random numbers 0..1 (count, n) that belong to a place: a root keeps its own for good."""
    bits = np.ascontiguousarray(place[:, :2], np.float32).view(np.uint32).astype(np.uint64)
    mixed = bits[:, 0] * np.uint64(0x9E3779B97F4A7C15) ^ bits[:, 1] * np.uint64(0xC2B2AE3D27D4EB4F)
    out = []
    for k in range(count):
        value = mixed + np.uint64((k + 1) * 0xD6E8FEB86659FD93 & (1 << 64) - 1)
        for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
            value = (value ^ value >> np.uint64(shift)) * np.uint64(factor)
        out.append(((value ^ value >> np.uint64(31)) >> np.uint64(40)).astype(np.float64) / (1 << 24))
    return np.stack(out)


def of(obj, ground):
    """An object that was made for a ground, or None: a ground's duplicate only knows the other's."""
    parent = obj.parent if obj is not None else None
    return None if parent is not None and parent != ground and parent.desire_path.is_ground else obj


def remove(obj):
    """Take an object of grass away, with all that was made for it."""
    if obj is None:
        return
    old = _tree_of(obj)
    mesh = obj.data
    bpy.data.objects.remove(obj)
    tufts.discard_mesh(mesh)
    _discard_tree(old)


def stale(obj, name, kind):
    """Whether an object does not show this kind yet."""
    tree = _tree_of(obj)
    return tree is None or tree[TAG] != f"{name} {kind!r}"


def _tree_of(obj):
    """The grass tree of an object, or None."""
    for each in obj.modifiers:
        if each.type == "NODES" and each.node_group is not None and TAG in each.node_group:
            return each.node_group
    return None


def _discard_tree(tree):
    if tree is None or tree.users > 0:
        return
    collection = scattered(tree)
    playback.discard(tree)
    tufts.discard(collection)


def scattered(tree):
    """The collection a tree scatters: ours, or one the user chose instead; or None."""
    for node in tree.nodes:
        if node.bl_idname == "GeometryNodeCollectionInfo":
            return node.inputs["Collection"].default_value
    return None


def show(obj, name, kind, index=None, images=None, count=0, anew=True):
    """Let an object's roots grow: standing, or as a bake's images say. A tree that differs by numbers alone stays.

    kind: None where it cannot be known any more, for grass to stand as it is
    index, images, count: of the bake, see playback; images: {"trail": .., "lean": ..}
    anew: False where no datablock may come or go: what is there stays as it is then, if numbers are not enough
    """
    old = _tree_of(obj)
    chosen = scattered(old) if old is not None else None
    if kind is None:
        if chosen is None:
            return
        mark, height = old[TAG], 0.0
    else:
        mark, height = f"{name} {kind!r}", kind.height
    if chosen is None or kind is not None and TAG in chosen and chosen[TAG] != mark:  # the user's own stay
        if not anew:
            return
        chosen = tufts.collection(name, kind)
    playing = None if images is None else (index, images, count, clock.stretch_of(obj))
    tree = grass_tree.create(f"{MODIFIER} {obj.name}", chosen, height, playing)
    tree[TAG] = mark
    alike = (
        old is not None
        and old.users == 1
        and tree_numbers.form(old) == tree_numbers.form(tree)
        and tree_numbers.held(old) == tree_numbers.held(tree)
    )
    if alike:
        tree_numbers.copy(tree, old)
        old[TAG] = mark
        old.update_tag()
    if alike or not anew:
        _discard_tree(tree)
        return
    for each in obj.modifiers:
        if each.type == "NODES" and (each.node_group is None or each.node_group == old):
            use_tree(each, tree)
            break
    _discard_tree(old)
    tree.name = f"{MODIFIER} {obj.name}"


def use_tree(modifier, tree):
    """Let a modifier run a tree; older Blenders fill in a tree of their own."""
    group = modifier.node_group
    modifier.node_group = tree
    if group is not None and TAG not in group and group.users == 0:
        bpy.data.node_groups.remove(group)
