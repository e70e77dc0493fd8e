"""grass_tree.py - the nodes that scatter tufts on roots, and bend those that were trodden on.

roots (a mesh of points) --instances of tufts--> the meadow
                         \\-where trodden: real tufts, stem by stem bent--/
"""

from dataclasses import dataclass
from typing import Any

import bpy

from ..ground import tuft
from . import compat, grass_nodes, playback_tree, tufts, wiring
from .tufts import ARCH, AT, LOOK, ROOT, STRENGTH, TILT, TONE

# of a root: turn about +Z [rad], size, rise of the ground along x and y, which tuft
TURN, SIZE, SLOPE, PICK = "tuft_turn", "tuft_size", "tuft_slope", "tuft_pick"
PLACE = "tuft_place"  # of a trodden tuft: where its root stands at rest [m]
TOUCHED = 0.004  # lean and crush from which a tuft is bent stem by stem
GRIND = 1.2e5  # pressure over time that grinds most broken stems away, some six footfalls [Pa s]
STEM_LIFT = 0.0015, 0.005  # how far trodden stems lie over the ground, the lowest and the highest [m]


def create(name, collection, height, playing):
    """A tree of that name that scatters a collection on roots: standing, or as a bake's images say.

    height: of the stems [m]; playing: (index, images, count, stretch) of the bake, None = nothing is pressed
    """
    tree = compat.geometry_tree(name, bpy.data.node_groups.new)
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
    if playing is None or "lean" not in playing[1]:
        grown = _instances(wire, points, info)
    else:
        field = grass_nodes.Field(wire, *playing)
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
            Selection=_touched(wire, field, here, tufts.root_radius(collection)),
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
