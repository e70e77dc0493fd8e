"""playback_tree.py - the nodes by which a bake is played: frames' images --> attributes --> how high points stand.

All numbers are constants inside the tree, so the same tree works from 3.4 to 5.2.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from . import axes, clock, compat, paged, strengths, wiring

ATTRIBUTE = "desire_path"  # the colour attribute on the evaluated mesh
MODIFIER = "Desire Path"
TAG = "desire_path"  # custom property on the trees and images that are ours
LEAN = "desire_path_lean"  # vector attribute where plants grew: lean x, lean y, crushed
STRENGTH = "plant_strength"  # float attribute where plants grew
GROUPS = ("plant_strength", "compression")  # vertex groups, when asked for
DETAIL = "desire_path_detail"  # vector attribute of a copy: heights of veins, crumbs and grit [m]
STRAY = "desire_path_stray"  # vector attribute of a copy: how far prints are seen aside, which heap shows crumbs [m]
WALL = "desire_path_wall"  # float attribute of a copy: deviation by which walls are rough [m]
ACROSS = "desire_path_across"  # vector attribute of a copy: which way walls are rough, across them in the end
LEVEL = "desire_path_level"  # float attribute of a copy: height of standing water over the ground as it lay [m], < 0
WATER = "desire_path_water"  # float attribute on the evaluated mesh: how deep water stands [m]
MOVED = "desire_path_moved"  # float attribute where other soils are seen in the end: how much was moved by then [m]
PROGRESS = "desire_path_progress"  # float attribute on the evaluated mesh: how much of that was moved by now, 0..1
DRY = -1e6  # height of the water where there is none [m]
BARE = (0.3, 0.9)  # veins show where less soil has slid back than was pressed, by that
SUCKED = (0.002, 0.012)  # where it was pressed so deep [m]
DISTURBED = (0.0003, 0.003)  # grit shows where soil was pressed or heaped so far [m]
SMOOTH = 0.35  # share of it that is left where a sole pressed
CUT = (0.004, 0.020)  # walls are rough where it was pressed so deep [m]
SHALLOW = 0.002  # water so deep is level [m]
LEAST = 1e-5  # where less is moved in the end nothing else is seen [m]
LUMP = 0.022  # how far the lumps of a wall lie apart [m]
EVEN = 0.4  # what lies level is so much less rough than walls are
NOISE = 0.11  # deviation of Blender's noise, about 0.5
ROUNDED = 0.01  # of a frame is lost where time is stretched
COPY_NODE = "GeometryNodeObjectInfo"


def group_name(name):
    return f"{ATTRIBUTE}_{name}"


def file_number(wire, index, count, stretch=1.0):
    """Which file shows the frame: n = frame - frame_start + 1, file 0 before, the last one after.

    stretch: scene frames in one of the time that nodes know, see clock.py
    """
    now = wire.add("GeometryNodeInputSceneTime").outputs["Frame"]
    start = 1.0 - index.frame_start
    if stretch != 1.0:
        now, start = wire.math("MULTIPLY", now, stretch), start + ROUNDED
    now = wire.math("FLOOR", wire.math("ADD", now, start))
    return wire.math("MAXIMUM", wire.math("MINIMUM", now, float(count)), 0.0)


@dataclass(frozen=True, eq=False)
class Playing:
    """How the frames of a bake are played on an object."""

    index: Any  # cell, x0, y0 [m], nx, ny, frame_start of the images
    count: int  # frames there are, file 0 not counted
    world: np.ndarray  # the object's matrix when it was baked (4, 4)
    scale: float  # metres in a unit [m]
    smooth: bool  # interpolate between cells, for meshes whose points are not cell centres
    corners: np.ndarray  # the local box of the mesh's points (8, 3)
    layer_depth: float = 0.0  # > 0 fills the vertex groups, where compression 1 is a layer pressed flat [m]
    standing: Sequence = ()  # plants off the images: (vertex group, "" or plants.Spread, their strength where it is 1)
    place: Any = None  # where our modifier goes (stack.Place); None: where it was, or after all others
    moved: bool = False  # other soils are seen in the end
    copy: Any = None  # whose mesh is shown in place of the ground's own (refined.py); None: the ground's own is


def create(obj, shown, playing, into=None):
    """The tree that plays the images `shown` on an object. into: a tree of ours whose nodes are made anew, or None"""
    index, place, copy = playing.index, playing.place, playing.copy
    smooth, standing = playing.smooth, playing.standing
    world, scale = playing.world, playing.scale
    tree = _opened(obj, into)
    wire = wiring.Wiring(tree)
    entry = given = wire.add("NodeGroupInput")
    if place is not None and place.realise:  # the ground is made of instances, which cannot be pressed
        entry = wire.add("GeometryNodeRealizeInstances", Geometry=entry.outputs[0])
    if copy is not None:
        entry = _in_place(wire, entry, copy)
    leave = tree.nodes.new("NodeGroupOutput")
    number = file_number(wire, index, playing.count, clock.stretch_of(obj))

    # where in the image
    turn, shift = axes.image_axes(world, scale, index)
    at = _turned(wire, turn, shift)
    inside = None if _covers(playing.corners, turn, shift) else within(wire, at)
    detailed = copy is not None and DETAIL in copy.data.attributes
    if detailed:  # rims are round, and edges stray
        stray = wire.named(STRAY, "FLOAT_VECTOR")
        at = wire.vector("MULTIPLY_ADD", stray, (1.0 / (index.nx * index.cell), 1.0 / (index.ny * index.cell), 0.0), at)
        smooth = "Cubic"

    if paged.NAME in shown:
        at, inside = paged.place(wire, shown, index, at)

    # sample once, read everything from it
    texture = wire.image(shown["trail"], at, number, smooth)
    some = {} if inside is None else {"Selection": inside}
    scattered = place is not None and place.scattered  # before us: it goes down with the ground
    stored = _stored(wire, entry, texture.outputs["Color"], scattered, some)
    split = wire.add("FunctionNodeSeparateColor", {"mode": "RGB"}, Color=wire.named(ATTRIBUTE, "FLOAT_COLOR"))
    up, rise = axes.lift(world, scale), strengths.rise(wire, given, split.outputs[0], split.outputs[2])
    if detailed:
        rise = wire.math(
            "ADD", rise, strengths.of_prints(wire, given, _detail(wire, split.outputs, wire.split(stray)[2]))
        )
    level, ground = wire.named(LEVEL) if copy is not None and LEVEL in copy.data.attributes else None, rise
    if level is not None:  # flat, whatever lies below it
        rise = wire.math("MAXIMUM", rise, level)
    offset = _along(wire, up, rise)
    if compat.socket(stored.inputs, "Selection") is not None:
        some = {}  # what is not stored reads zero
    geometry = stored.outputs[0]
    if "lean" in shown:
        grown = _grown(wire, standing, world, scale) if inside is not None else None
        geometry = _lean(wire, geometry, wire.image(shown["lean"], at, number, smooth), inside, grown)
    if playing.moved:
        geometry = wire.store(geometry, PROGRESS, _progress(wire, split.outputs[0], split.outputs[2]))
    if level is not None:
        geometry = wire.store(geometry, WATER, wire.math("SUBTRACT", rise, ground))
    geometry = wire.add("GeometryNodeSetPosition", Geometry=geometry, Offset=offset, **some).outputs[0]
    if detailed and WALL in copy.data.attributes:
        share = strengths.of_prints(wire, given, wire.between(split.outputs[2], *CUT))
        if level is not None:
            share = wire.math("MULTIPLY", share, wire.between(wire.named(WATER), 0.0, SHALLOW, 1.0, 0.0))
        geometry = _rough(wire, geometry, share, np.linalg.norm(world[:3, :3], axis=0) * scale)

    geometry = strengths.painted(wire, given, geometry, split.outputs[0], split.outputs[2])

    # a group of that name on the object is filled instead of an attribute
    if playing.layer_depth > 0.0:
        strength = wire.named(STRENGTH) if "lean" in shown else split.outputs[1]
        weights = (strength, wire.math("MULTIPLY", split.outputs[2], 1.0 / playing.layer_depth))
        for name, weight in zip(GROUPS, weights):
            geometry = wire.store(geometry, group_name(name), weight)
    tree.links.new(geometry, leave.inputs[0])
    leave.location = (180 * wire.column, 0)
    return tree


def _opened(obj, into):
    """A tree for an object without nodes: `into`, or a new one."""
    if into is not None:
        into.nodes.clear()
        return into
    tree = compat.geometry_tree(MODIFIER + " " + obj.name, bpy.data.node_groups.new)
    strengths.declare(tree)
    return tree


def _along(wire, up, rise):
    """What lies `rise` in the direction `up` (3,)."""
    if up[0] == 0.0 and up[1] == 0.0 and up[2] == 1.0:
        return wire.add("ShaderNodeCombineXYZ", Z=rise).outputs[0]
    return wire.vector("MULTIPLY", tuple(up), rise)


def _stored(wire, entry, color, scattered, some):
    """The node after which points, and instances that are scattered, have a color where they are `some`."""
    for domain in ("INSTANCE", "POINT")[not scattered :]:
        entry = wire.add(
            "GeometryNodeStoreNamedAttribute",
            {"data_type": "FLOAT_COLOR", "domain": domain},
            Geometry=entry.outputs[0],
            Name=ATTRIBUTE,
            Value=color,
            **some,
        )
    return entry


def _detail(wire, baked, threshold):
    """How high what is finer than a cell stands, by how far soil was pressed and heaped at that frame. MODEL 8.3"""
    heap = wire.math("MAXIMUM", wire.math("ADD", baked[0], baked[2]), 0.0)
    bare = wire.math("DIVIDE", heap, wire.math("MAXIMUM", baked[2], SUCKED[0]))
    bare = wire.between(bare, *BARE, 1.0, 0.0)
    veins = wire.math("MULTIPLY", wire.between(baked[2], *SUCKED), bare)
    crumbs = wire.between(heap, threshold, wire.math("MULTIPLY", threshold, 2.0))
    grit = wire.math("MAXIMUM", wire.between(heap, *DISTURBED), wire.between(baked[2], *DISTURBED, 0.0, SMOOTH))
    shares = wire.xyz(veins, crumbs, grit)
    return wire.vector("DOT_PRODUCT", wire.named(DETAIL, "FLOAT_VECTOR"), shares)


def _progress(wire, change, compression):
    """How much of what is moved in the end, heaps, coats and what was pressed, was moved by now. MODEL 8.2"""
    now = wire.math("MULTIPLY_ADD", compression, 2.0, change)
    share = wire.math("DIVIDE", now, wire.math("MAXIMUM", wire.named(MOVED), LEAST))
    return wire.math("MAXIMUM", wire.math("MINIMUM", share, 1.0), 0.0)


def _rough(wire, geometry, share, metres):
    """Points of deep prints are moved across their walls by noise of the place where they stand, so that walls are
    lumpy: what is moved along a surface would fold, and so would what each follows a normal of its own. MODEL 8.3

    share: of it that shows; metres: in a unit of the object along its axes
    """
    here = wire.vector("MULTIPLY", wire.add("GeometryNodeInputPosition").outputs[0], tuple(metres))
    noise = wire.add(
        "ShaderNodeTexNoise", {"noise_dimensions": "3D"}, Vector=here, Scale=1.0 / LUMP, Detail=1.0, Roughness=0.6
    )
    # as high as it comes near 0, and no higher than 4/3 deviations: peaks would fold
    away = wire.between(noise.outputs[0], 0.5 - 2.0 * NOISE, 0.5 + 2.0 * NOISE, -4.0 / 3.0 * NOISE, 4.0 / 3.0 * NOISE)
    high = wire.named(WALL)
    away = wire.math("MULTIPLY", away, wire.math("MULTIPLY", high, share))
    across = wire.vector(
        "MULTIPLY", wire.named(ACROSS, "FLOAT_VECTOR"), tuple(np.array((1.0, 1.0, EVEN)) / (NOISE * metres))
    )
    deep = wire.math("GREATER_THAN", wire.math("MULTIPLY", high, share), 0.0)
    offset = wire.vector("SCALE", across, scale=away)
    return wire.add("GeometryNodeSetPosition", Geometry=geometry, Selection=deep, Offset=offset).outputs[0]


def _in_place(wire, entry, copy):
    """The mesh of an object in place of the one that comes in, with all that comes in beside a mesh."""
    info = wire.add(COPY_NODE, {"transform_space": "ORIGINAL"}, Object=copy)
    parts = wire.add("GeometryNodeSeparateComponents", Geometry=entry.outputs[0])
    join = wire.add("GeometryNodeJoinGeometry")
    for each in reversed(parts.outputs):  # the link made last comes first: the mesh
        if each.enabled and each.name != "Mesh":
            wire.tree.links.new(each, join.inputs[0])
    wire.tree.links.new(compat.socket(info.outputs, "Geometry"), join.inputs[0])
    return join


def copy_of(tree):
    """The object whose mesh a tree of ours shows in place of the ground's own, or None."""
    found = (node.inputs["Object"].default_value for node in tree.nodes if node.bl_idname == COPY_NODE)
    return next(filter(None, found), None)


def _covers(corners, turn, shift):
    """Whether the image reaches beyond the whole mesh, so that no point need be left out."""
    corners = np.asarray(corners, np.float64) @ turn.T + shift
    return bool((corners >= 0.0).all() and (corners <= 1.0).all())


def _turned(wire, turn, shift):
    """Image coordinates of the points, see axes.image_axes."""
    here = wire.add("GeometryNodeInputPosition").outputs[0]
    if turn[0, 1] == 0.0 and turn[0, 2] == 0.0 and turn[1, 0] == 0.0 and turn[1, 2] == 0.0:
        return wire.vector("MULTIPLY_ADD", here, (turn[0, 0], turn[1, 1], 0.0), (*shift, 0.0))
    u, v = (wire.math("ADD", wire.vector("DOT_PRODUCT", here, tuple(turn[k])), shift[k]) for k in (0, 1))
    return wire.add("ShaderNodeCombineXYZ", X=u, Y=v).outputs[0]


def _grown(wire, standing, world, scale):
    """How strong plants are where nobody walked."""
    grown = 0.0
    for where, full in standing:
        share = full
        if hasattr(where, "weight"):
            at = _turned(wire, *axes.rectangle_axes(world, scale, where.low, where.size))
            light = wire.image(_still(where), at, 0, True, "EXTEND").outputs["Color"]
            share = wire.math("MULTIPLY", wire.split(light)[0], full)
        elif where:
            share = wire.math("MULTIPLY", wire.named(where), full)
        grown = wire.math("ADD", grown, share)
    return wire.math("MINIMUM", grown, 1.0)


def _still(spread):
    """A packed image of a Spread: it needs no file."""
    ny, nx = spread.weight.shape
    image = bpy.data.images.new("desire_path grown", nx, ny, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    pixels = np.ones((ny, nx, 4), np.float32)
    pixels[..., :3] = spread.weight[..., None]
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    image.pack()
    image[TAG] = "grown"
    return image


def _lean(wire, geometry, texture, inside, grown):
    """Store how plants lie and how strong they are; off the image they stand as they grew."""
    strength = texture.outputs["Alpha"]
    if inside is not None:
        strength = wire.math(
            "ADD",
            wire.math("MULTIPLY", strength, inside),
            wire.math("MULTIPLY", grown, wire.math("SUBTRACT", 1.0, inside)),
        )
        lean = wire.vector("SCALE", texture.outputs["Color"], scale=inside)
    else:
        lean = texture.outputs["Color"]
    geometry = wire.store(geometry, LEAN, lean, "FLOAT_VECTOR")
    return wire.store(geometry, STRENGTH, strength)


def within(wire, at):
    """A field that is true for points inside the image."""
    from_middle = wire.vector("ABSOLUTE", wire.vector("SUBTRACT", at, (0.5, 0.5, 0.0)))
    split = wire.add("ShaderNodeSeparateXYZ", Vector=from_middle)
    return wire.math("LESS_THAN", wire.math("MAXIMUM", split.outputs[0], split.outputs[1]), 0.5)
