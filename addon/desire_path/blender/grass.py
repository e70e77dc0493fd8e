"""grass.py - plants that can be seen: native geometry nodes on the roots, bent by a bake's images.

    roots (a mesh of points) --instances of tufts--> the meadow
                             \\-where trodden: real tufts, stem by stem bent--/
The points are placed once, by the core, on the ground as it lies before any bake, so that no root
ever jumps. Everything is in metres and in the world's axes. Only tufts that the frame's images show
as touched are made real and bent; all others are instances: cost follows the feet.
"""

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ..ground import tuft
from . import clock, compat, grass_nodes, playback, playback_tree, tree_numbers, tufts, wiring
from .tufts import ARCH, AT, LOOK, ROOT, STRENGTH, TILT, TONE

TAG = playback_tree.TAG
MODIFIER = "Desire Path Grass"
# of a root: turn about +Z [rad], size, rise of the ground along x and y, which tuft
TURN, SIZE, SLOPE, PICK = "tuft_turn", "tuft_size", "tuft_slope", "tuft_pick"
PLACE = "tuft_place"  # of a trodden tuft: where its root stands at rest [m]
TOUCHED = 0.004  # lean and crush from which a tuft is bent stem by stem
GRIND = 1.2e5  # pressure over time that grinds most broken stems away, some six footfalls [Pa s]
STEM_LIFT = 0.0015, 0.005  # how far trodden stems lie over the ground, the lowest and the highest [m]


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
    tree = _tree(obj, chosen, height, index, images, count)
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


# ---- the nodes -------------------------------------------------------------------------------------


def _tree(obj, collection, height, index, images, count):
    tree = compat.geometry_tree(f"{MODIFIER} {obj.name}", bpy.data.node_groups.new)
    wire = wiring.Wiring(tree)
    points = wire.add("NodeGroupInput").outputs[0]
    points = wire.store(points, STRENGTH, 1.0)
    leave = tree.nodes.new("NodeGroupOutput")
    info = wire.add(
        "GeometryNodeCollectionInfo",
        {"transform_space": "ORIGINAL"},
        Collection=collection,
        **{"Separate Children": True, "Reset Children": True},
    ).outputs[0]
    if images is None or "lean" not in images:
        grown = _instances(wire, points, info)
    else:
        field = grass_nodes.Field(wire, index, images, count, clock.stretch_of(obj))
        here = wire.add("GeometryNodeInputPosition").outputs[0]
        beside = wire.add(
            "GeometryNodeSeparateGeometry",
            {"domain": "POINT"},
            Geometry=points,
            Selection=playback_tree.within(wire, field.where(here)),
        )
        parted = wire.add(
            "GeometryNodeSeparateGeometry",
            {"domain": "POINT"},
            Geometry=beside.outputs[0],
            Selection=_touched(wire, field, here, tufts.reach(collection)),
        )
        risen = wire.add(
            "GeometryNodeSetPosition", Geometry=parted.outputs[1], Offset=wire.xyz(z=field.ground(here)[0])
        ).outputs[0]
        standing = _instances(wire, _join(wire, risen, beside.outputs[1]), info)
        grown = _join(wire, standing, _trodden(wire, parted.outputs[0], info, field, height))
    tree.links.new(grown, leave.inputs[0])
    leave.location = (180 * wire.column, 0)
    return tree


def _join(wire, one, other):
    node = wire.add("GeometryNodeJoinGeometry", Geometry=one)
    wire.tree.links.new(other, node.inputs[0])
    return node.outputs[0]


def _instances(wire, points, info):
    size = wire.named(SIZE)
    return wire.add(
        "GeometryNodeInstanceOnPoints",
        Points=points,
        Instance=info,
        Rotation=wire.xyz(z=wire.named(TURN)),
        Scale=wire.xyz(size, size, size),
        **{"Pick Instance": True, "Instance Index": wire.named(PICK, "INT")},
    ).outputs[0]


def _touched(wire, field, here, far):
    """Whether any stem of a tuft is out of its shape: asked in its middle and around it."""
    most = field.broken(here)
    for x, y in ((0, 0), (far, 0), (-far, 0), (0, far), (0, -far)):
        lean, _ = field.lean(wire.vector("ADD", here, (x, y, 0.0)) if x or y else here)
        most = wire.math("MAXIMUM", most, wire.vector("DOT_PRODUCT", wire.vector("ABSOLUTE", lean), (1, 1, 1)))
    return wire.math("GREATER_THAN", most, TOUCHED)


@dataclass(frozen=True)
class _Stem:
    """The straight stem of a vertex, turned and sized as its plant is: sockets."""

    place: Any  # of its plant
    foot: Any  # of itself
    along: Any  # how far up the vertex is ..
    across: Any  # .. and how far off its middle
    length: Any
    tilt: Any
    arch: Any
    chance: Any  # three numbers 0..1 of its own


@dataclass(frozen=True)
class _Fate:
    """What happened at the root of a stem: sockets."""

    is_broken: Any
    own: Any  # how far this one is crushed 0..1
    lean: Any  # of all that stand there
    aside: Any  # how far its tip is said to be off its root


def _trodden(wire, points, info, field, high):
    """Real tufts, every stem bent as the images say at its root; a mesh of somebody else is one stem."""
    points = wire.store(points, PLACE, wire.add("GeometryNodeInputPosition").outputs[0], "FLOAT_VECTOR")
    real = wire.add("GeometryNodeRealizeInstances", Geometry=_instances(wire, points, info)).outputs[0]

    stem = _straight(wire, high)
    fate = _fate(wire, field, stem)
    across, tilt, arch = _leaning(wire, stem, fate)

    # broken stems turn to straw and are ground away foot by foot
    level, pressure = _surface(wire, field, stem.place, stem.foot)
    ground = wire.math("SUBTRACT", 1.0, wire.math("EXPONENT", wire.math("MULTIPLY", pressure, -1.0 / GRIND)))
    gone = wire.math("SUBTRACT", ground, wire.math("MULTIPLY_ADD", stem.chance[2], 0.55, 0.30))
    gone = wire.math("MINIMUM", wire.math("MAXIMUM", wire.math("MULTIPLY", gone, 7.0), 0.0), 0.97)
    left = wire.math("SUBTRACT", 1.0, wire.math("MULTIPLY", gone, fate.is_broken))
    along, across = wire.math("MULTIPLY", stem.along, left), wire.vector("SCALE", across, scale=left)
    length = wire.math("MULTIPLY", stem.length, left)

    where = grass_nodes.bent(wire, length, along, across, tilt, arch)
    where = wire.vector(
        "ADD", wire.vector("ADD", where, wire.vector("MULTIPLY", stem.foot, (1, 1, 0))), wire.xyz(z=level)
    )
    # nothing lies under the ground, but the buried end
    low, high = STEM_LIFT
    lift = wire.math(
        "MULTIPLY",
        wire.math("MULTIPLY_ADD", stem.chance[1], high - low, low),
        wire.math("MINIMUM", wire.math("MULTIPLY", along, 50.0), 1.0),
    )
    least = wire.math("ADD", _surface(wire, field, stem.place, where)[0], lift)
    least = grass_nodes.mix(wire, wire.math("GREATER_THAN", along, 1e-4), -1e6, least)
    x, y, z = wire.split(where)
    real = wire.add(
        "GeometryNodeSetPosition", Geometry=real, Position=wire.xyz(x, y, wire.math("MAXIMUM", z, least))
    ).outputs[0]
    pale = wire.math("MULTIPLY", fate.is_broken, wire.math("MULTIPLY_ADD", ground, 0.70, 0.25))
    return wire.store(real, STRENGTH, wire.math("SUBTRACT", 1.0, pale))


def _straight(wire, high):
    """The straight stem of the vertex at hand; of a mesh of somebody else, which is `high` [m], one for all of it."""
    turn, size = wire.named(TURN), wire.named(SIZE)

    def turned(name):
        return wire.add(
            "ShaderNodeVectorRotate", {"rotation_type": "Z_AXIS"}, Vector=wire.named(name, "FLOAT_VECTOR"), Angle=turn
        ).outputs[0]

    root = wire.vector("SCALE", turned(ROOT), scale=size)
    across = wire.vector("SCALE", turned(AT), scale=size)
    tilt, arch = turned(TILT), turned(ARCH)
    place = wire.named(PLACE, "FLOAT_VECTOR")
    foreign = wire.math("LESS_THAN", wire.split(root)[2], 1e-6)
    as_it_is = wire.vector("SUBTRACT", wire.add("GeometryNodeInputPosition").outputs[0], place)
    across = wire.vector("ADD", across, wire.vector("SCALE", as_it_is, scale=foreign))
    length = wire.math(
        "ADD",
        wire.split(root)[2],
        wire.math("MULTIPLY", foreign, wire.math("MULTIPLY", size, max(high, tuft.SHORTEST))),
    )
    along = wire.split(across)[2]
    root, across = (wire.vector("MULTIPLY", each, (1, 1, 0)) for each in (root, across))
    foot = wire.vector("ADD", place, root)
    tone = wire.split(wire.named(LOOK, "FLOAT_VECTOR"))[1]
    chance = [
        wire.math("FRACT", wire.math("MULTIPLY_ADD", tone, factor, wire.named(TONE))) for factor in (61.7, 173.3, 331.9)
    ]
    return _Stem(place, foot, along, across, length, tilt, arch, chance)


def _fate(wire, field, stem):
    """By b, the share that is broken at its root: this stem is broken, or one of the others."""
    lean, _ = field.lean(stem.foot)
    broken = field.broken(stem.foot)
    is_broken = wire.math("LESS_THAN", stem.chance[0], broken)
    crushed = wire.split(lean)[2]
    lean = wire.vector("MULTIPLY", lean, (1, 1, 0))
    of_broken = wire.math("DIVIDE", crushed, wire.math("MAXIMUM", broken, 0.02))
    of_others = wire.math(
        "DIVIDE", wire.math("SUBTRACT", crushed, broken), wire.math("MAXIMUM", wire.math("SUBTRACT", 1.0, broken), 0.05)
    )
    own = grass_nodes.mix(wire, is_broken, of_others, of_broken)
    own = wire.math("MINIMUM", wire.math("MAXIMUM", own, 0.0), 1.0)
    share = wire.math("DIVIDE", wire.math("ADD", own, 0.05), wire.math("ADD", crushed, 0.05))
    aside = wire.math("MINIMUM", wire.math("MULTIPLY", wire.vector("LENGTH", lean), share), 1.0)
    return _Fate(is_broken, own, lean, aside)


def _leaning(wire, stem, fate):
    """(across, tilt, arch) of a stem that leans as far as it is crushed."""
    # whither it leans: as all do, and a little its own
    spread = wire.math("MULTIPLY_ADD", stem.chance[1], 0.9, -0.45)
    ahead = wire.add("ShaderNodeVectorRotate", {"rotation_type": "Z_AXIS"}, Vector=fate.lean, Angle=spread).outputs[0]
    outward = wire.vector(
        "SCALE", wire.vector("ADD", stem.arch, stem.tilt), scale=wire.math("MULTIPLY", fate.own, 0.12)
    )
    ahead = wire.vector("NORMALIZE", wire.vector("ADD", ahead, outward))
    # how far its tip is off the root: as far as it is said, or as the height it lost lets it be
    height = wire.math("SUBTRACT", 1.0, fate.own)
    fallen = wire.math(
        "SQRT", wire.math("MAXIMUM", wire.math("SUBTRACT", 1.0, wire.math("MULTIPLY", height, height)), 0.0)
    )
    angle = wire.math("ARCTAN2", wire.math("MAXIMUM", fate.aside, fallen), height)
    angle = wire.math("MULTIPLY", angle, wire.math("MULTIPLY_ADD", stem.chance[2], 0.16, 0.92))
    # a leaning stem is an arc, more bent towards its tip; a crushed one lies straight from its root on
    stiff = wire.math("POWER", fate.own, 1.5)
    first = wire.math("MULTIPLY", angle, stiff)
    last = wire.math("MINIMUM", wire.math("SUBTRACT", wire.math("MULTIPLY", angle, 2.0), first), 1.72)
    keep = wire.math("MULTIPLY_ADD", fate.own, -0.85, 1.0)
    tilt = wire.vector("ADD", wire.vector("SCALE", stem.tilt, scale=keep), wire.vector("SCALE", ahead, scale=first))
    arch = wire.vector(
        "ADD",
        wire.vector("SCALE", stem.arch, scale=keep),
        wire.vector("SCALE", ahead, scale=wire.math("SUBTRACT", last, first)),
    )

    # what lay across it is pressed flat, to the sides of where it leans
    aside = wire.vector("CROSS_PRODUCT", (0, 0, 1), ahead)
    wide = wire.math(
        "MULTIPLY",
        wire.vector("LENGTH", stem.across),
        wire.math("SIGN", wire.vector("DOT_PRODUCT", stem.across, aside)),
    )
    across = wire.vector(
        "ADD",
        wire.vector("SCALE", stem.across, scale=height),
        wire.vector("SCALE", aside, scale=wire.math("MULTIPLY", wide, fate.own)),
    )
    return across, tilt, arch


def _surface(wire, field, place, at):
    """Height of the pressed ground at a place near a root, by its slope and what was pressed there [m], and
    the pressure over time it bore [Pa s]."""
    away = wire.vector("SUBTRACT", at, place)
    slope = wire.vector("DOT_PRODUCT", away, wire.named(SLOPE, "FLOAT_VECTOR"))
    rise, pressure = field.ground(at)
    return wire.math("ADD", wire.math("ADD", wire.split(place)[2], slope), rise), pressure
