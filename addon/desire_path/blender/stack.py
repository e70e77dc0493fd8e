"""stack.py - where among a ground's modifiers our own belongs, and the ground as those before it make it.

    subdivision, displace, nodes that shape ..   OURS   hair, particles, scatters, collision ..

What a nodes modifier does is seen by what comes out of it: one that leaves the ground's own points and faces as
they were and adds something within their bounds scatters, any other shapes.
"""

import math
from contextlib import contextmanager
from dataclasses import dataclass

import bpy
import numpy as np

from . import axes, compat, moves, playback
from .private import evaluated, private_scene, visiting

STANDS = {
    "PARTICLE_SYSTEM",
    "COLLISION",
    "SURFACE",
    "WEIGHTED_NORMAL",
    "NORMAL_EDIT",
}  # on the ground, or for its looks
LEVELS = {
    "SUBSURF": ("levels", "render_levels"),
    "MULTIRES": ("levels", "render_levels"),
    "SCREW": ("steps", "render_steps"),
    "OCEAN": ("viewport_resolution", "resolution"),
}
SPREAD = 1.25  # what a scatter adds reaches over no more than this many times the ground's own rectangle
ALIKE = 16  # points in the place of a ground's first one that may be that one
MAX_FACES = 2e7  # subdivision goes no farther than this where the ground is read


@dataclass(frozen=True)
class Place:
    """Where our modifier goes."""

    before: int  # how many of the other modifiers come before it
    realise: bool = False  # the ground there is made of instances
    scattered: bool = False  # there are instances on it
    warnings: tuple = ()


def others(obj):
    """All modifiers but ours, in order."""
    own = playback.modifier(obj)
    return [each for each in obj.modifiers if each != own and not playback.is_by_hand(each)]


def find(scene, obj, frame):
    """The Place of our modifier on a ground, as it is at a frame."""
    last, realise, looked = -1, False, {}
    standing, scatters = set(), set()
    for k, each in enumerate(others(obj)):
        on = each.show_render or each.show_viewport or _is_led(obj, each)
        if not on or each.type == "NODES" and each.node_group is None:
            continue
        if each.type in STANDS:
            standing.add(k)
        elif each.type != "NODES":
            last = k
        else:
            for count in (k, k + 1):
                if count not in looked:
                    looked[count] = _look(scene, obj, count, frame)
            kind = _kind(looked[k], looked[k + 1])
            if len(looked[k + 1].instances) > len(looked[k].instances):
                scatters.add(k)
            if kind == "stands":
                standing.add(k)
            elif kind != "nothing":
                last = k
                realise |= kind == "instances"
    stack = others(obj)
    before = min((k for k in standing if k > last), default=len(stack))
    above = [stack[k] for k in sorted(standing) if k < last and stack[k].type == "PARTICLE_SYSTEM"]
    return Place(
        before,
        realise,
        not realise and any(k < before for k in scatters),
        tuple(
            f"The particles '{each.name}' of '{obj.name}' come before '{stack[last].name}' among its modifiers and "
            "do not follow the prints: move them below it."
            for each in above
        ),
    )


# ---- a ground as some of its modifiers make it -------------------------------------------------------


@contextmanager
def shaped(scene, obj, before, trees=()):
    """(a private scene, a copy of a ground in it with the first `before` of its other modifiers as renders have
    them, and geometry trees after those); all is gone afterwards, the trees too. What follows properties of `scene` is
    seen nowhere else: then it is that scene."""
    copy = obj.copy()
    try:
        copy.hide_viewport = False
        own = playback.modifier(copy)
        kept = [each for each in copy.modifiers if each != own][:before]
        for each in list(copy.modifiers):
            if each not in kept:
                copy.modifiers.remove(each)
            elif hasattr(each, "use_pin_to_last"):
                each.use_pin_to_last = False  # our trees come after it
        show(scene, copy, obj)
        for tree in trees:
            compat.nodes_modifier(copy, "desire_path", tree)
        with visiting(scene, copy) if moves.asks_scene(copy) else private_scene(scene, copy) as where:
            yield where, copy
    finally:
        bpy.data.objects.remove(copy)
        for tree in trees:
            bpy.data.node_groups.remove(tree)


def show(scene, copy, obj, render=True):
    """Let a copy's modifiers be as renders have them, or as the viewport does; returns how many times finer the
    faces would be than they are, since no more than MAX_FACES are made."""
    faces, left_out = max(len(obj.data.polygons), 1) if obj.type == "MESH" else 1, 1
    for each in copy.modifiers:
        source = obj.modifiers.get(each.name)
        if source is None or source.type != each.type:
            continue  # a tree of ours
        each.show_viewport = shows(source, render) and each.type != "PARTICLE_SYSTEM"
        if each.type not in LEVELS:
            continue
        level = fineness(scene, source, render)
        if each.type in ("SUBSURF", "MULTIRES") and each.show_viewport:
            while level > 0 and faces * 4**level > MAX_FACES:
                level, left_out = level - 1, left_out * 4
            faces *= 4**level
        setattr(each, LEVELS[each.type][0], level)
    return left_out


def let_led(scene, own, copy, obj, frame, again=False):
    """Let what keys, strips and drivers switch of a copy's modifiers be as renders have it at a frame of its private
    scene, and not as it is at the frame that is shown. again: it was let for another frame before"""
    if not _are_led(obj):
        return
    if again:
        show(scene, copy, obj)
    own.frame_set(math.floor(frame))
    there = copy.evaluated_get(own.view_layers[0].depsgraph)
    for each in copy.modifiers:
        shown, now = obj.modifiers.get(each.name), there.modifiers.get(each.name)
        if shown is None or now is None or each.type == "PARTICLE_SYSTEM":
            continue
        if now.show_render != shown.show_render:
            each.show_viewport = now.show_render
        if each.type in LEVELS and fineness(scene, now, True) != fineness(scene, shown, True):
            setattr(each, LEVELS[each.type][0], fineness(scene, now, True))


def _are_led(obj):
    """Whether something may lead which modifiers of an object are on, or how finely they cut."""
    animation = obj.animation_data
    return animation is not None and (
        any(len(track.strips) for track in animation.nla_tracks) or any(_is_led(obj, each) for each in obj.modifiers)
    )


def _is_led(obj, modifier):
    """Whether keys or a driver do so with one of them."""
    path = f'modifiers["{bpy.utils.escape_identifier(modifier.name)}"].'
    names = ("show_render", "show_viewport", *LEVELS.get(modifier.type, ()))
    return any(compat.is_keyed(obj.animation_data, path + name) for name in names)


def shows(modifier, render):
    return modifier.show_render if render else modifier.show_viewport


def fineness(scene, modifier, render):
    """How finely a modifier of LEVELS cuts in renders, or in the viewport."""
    level = getattr(modifier, LEVELS[modifier.type][render])
    if scene.render.use_simplify and modifier.type in ("SUBSURF", "MULTIRES"):
        most = scene.render.simplify_subdivision_render if render else scene.render.simplify_subdivision
        level = min(level, most)
    return level


def differs(scene, obj, before):
    """Whether the viewport has another ground at our place than renders have."""
    for each in others(obj)[:before]:
        if each.show_render != each.show_viewport:
            return True
        if each.type in LEVELS and fineness(scene, each, True) != fineness(scene, each, False):
            return True
    return False


# ---- trees of a private copy --------------------------------------------------------------------------


def realised():
    """A tree that makes instances real."""
    return _tree("desire_path realised", "GeometryNodeRealizeInstances")


def _tree(name, *kinds):
    """Nodes in a row, each fed by the one before it; out of parts the instances are taken."""
    tree = compat.geometry_tree(name, bpy.data.node_groups.new)
    at = tree.nodes.new("NodeGroupInput").outputs[0]
    for kind in kinds:
        node = tree.nodes.new(kind)
        tree.links.new(at, node.inputs[0])
        at = compat.socket(node.outputs, "Instances") or node.outputs[0]
    tree.links.new(at, tree.nodes.new("NodeGroupOutput").inputs[0])
    return tree


# ---- what a nodes modifier does -------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Evaluated:
    points: np.ndarray  # of the mesh (n, 3)
    corners: np.ndarray  # the point of every corner of its faces (c,)
    instances: np.ndarray  # where instances are (m, 3)
    world: np.ndarray  # (4, 4)

    def area(self, *more):
        """Area of the rectangle of the world around points."""
        at = np.concatenate([self.points, *more])
        at = axes.points(self.world, at[np.isfinite(at).all(axis=1)], 1.0)
        return float(np.prod(np.ptp(at[:, :2], axis=0))) if len(at) else 0.0


def _look(scene, obj, count, frame):
    """What the first modifiers make of a ground."""
    with shaped(scene, obj, count) as (own, copy):
        let_led(scene, own, copy, obj, frame)
        found = evaluated(own, copy, frame)
        world = np.array(found.matrix_world, np.float64)
        points, corners = compat.positions(found.data), np.empty(len(found.data.loops), np.int32)
        if len(corners):
            found.data.loops.foreach_get("vertex_index", corners)
    tail = _tree(
        "desire_path instances",
        "GeometryNodeSeparateComponents",
        "GeometryNodeInstancesToPoints",
        "GeometryNodePointsToVertices",
    )
    with shaped(scene, obj, count, [tail]) as (own, copy):
        let_led(scene, own, copy, obj, frame)
        instances = compat.positions(evaluated(own, copy, frame).data)
    return _Evaluated(points, corners, instances, world)


def _kind(was, now):
    """What a modifier does: "nothing", "stands" (on the ground), "shapes" it or makes it of "instances"."""
    more = len(now.instances) > len(was.instances)
    extra = _added(was, now)
    if extra is not None and not len(extra) and not more:
        return "nothing"
    within = was.area(now.instances) <= SPREAD * was.area()
    if extra is not None and len(was.corners) and within and was.area(extra) <= SPREAD * was.area():
        return "stands"
    return "instances" if more and not (within and len(now.corners)) else "shapes"


def _added(was, now):
    """Points that come on top of a mesh that is still there as it was; None where it is not."""
    count, sides = len(was.points), len(was.corners)
    first = np.flatnonzero((now.points == was.points[0]).all(axis=1))[:ALIKE] if count else [0]
    for at in first:
        corner = np.flatnonzero(now.corners == was.corners[0] + at)[:1] if sides else [0]
        if (
            len(corner)
            and np.array_equal(now.points[at : at + count], was.points)
            and np.array_equal(now.corners[corner[0] : corner[0] + sides] - at, was.corners)
        ):
            return np.concatenate([now.points[:at], now.points[at + count :]])
    return None
