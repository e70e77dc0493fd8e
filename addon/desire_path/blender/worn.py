"""worn.py - what an armature wears, as renders show it: skin, clothes, shoes, rigid or bound, in its rest pose.

    objects that hang on the armature --rest pose, their modifiers--> points, and what bone each moves with

Bones that are named by vertex groups of an armature modifier move what the groups say. Whatever moves otherwise
(Surface Deform, constraints, lattices, parents of parents) is watched at some frames: a point belongs to the bone
that carries it along.
"""

import functools
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

import bpy
import numpy as np

from ..errors import DesirePathError
from ..rig import body
from ..rig.sole_mesh import Tread
from . import axes, clock, compat, stack, wiring
from .private import evaluated, off_in_renders, private_scene

LOOKS = 5  # frames of the walk at which points are watched
SAME = 1e-3  # places nearer than this share of the body's size are the same
WEIGHT = "desire_path_bone_{}"  # attributes of the private copies


def skin(scene, armature, feet, world, scale, frames=None):
    """Meshes that move with the feet, in the skeleton's rest space; None where there are none.

    Skins, clothes and shoes count alike. A bone below a foot or toe (a toe's tip, single toes)
    counts for the nearest one above it. feet None: all there is, every bone for itself. frames: of the walk, at
    the first of which the rest pose is taken; None: the scene's own one
    """
    owner = owners(armature, feet) if feet is not None else {bone.name: bone.name for bone in armature.data.bones}
    there = [each for each in hanging(scene, armature) if drawn(scene, each, frames)]
    size = axes.sizes(world)
    vertices, triangles, weights, count = [], [], [], 0
    for rest, faces, share in bound(scene, armature, there, owner, frames):
        any_share = np.zeros(len(rest), bool)
        for each in share.values():
            any_share |= each > 0.0
        faces = faces[any_share[faces].any(axis=1)]
        if not len(faces):
            continue
        used, faces = np.unique(faces, return_inverse=True)
        vertices.append(axes.points(size, rest[used], scale))
        triangles.append(faces.reshape(-1, 3) + count)
        weights.append({name: each[used] for name, each in share.items()})
        count += len(used)
    if not vertices:
        return None
    names = sorted(set().union(*weights))
    joined = {
        name: np.concatenate([w.get(name, np.zeros(len(v), np.float32)) for w, v in zip(weights, vertices)])
        for name in names
    }
    vertices = np.concatenate(vertices)
    if not (np.abs(vertices) < axes.FAR).all():
        raise DesirePathError(f"A mesh on '{armature.name}' has NaN or infinite vertices at its feet: repair the mesh.")
    return body.Skin(vertices, np.concatenate(triangles).astype(np.int32), joined)


def tread(scene, armature, feet, world, scale, frames=None):
    """The mesh chosen as the sole, as it lies in the rest pose; None where none was chosen."""
    obj = armature.desire_path.sole
    if obj is None:
        return None
    if obj.type != "MESH":
        raise DesirePathError(f"'{obj.name}' is no mesh: choose a mesh as the sole of '{armature.name}'.")
    parts = []
    if obj in hanging(scene, armature):
        parts = [each for each in bound(scene, armature, [obj], owners(armature, feet), frames) if each[2]]
    if not parts:  # it lies somewhere
        with _copies(scene, [obj], {obj: []}) as copies, private_scene(scene, armature, copies[obj]) as own:
            parts = [_seen(own, armature, copies[obj], None, scene.frame_current)]
    rest, faces = parts[0][:2]
    size = axes.sizes(world)
    if np.linalg.det(size[:3, :3]) < 0.0:  # mirrored: what was outside stays outside
        faces = faces[:, ::-1]
    return Tread(axes.points(size, rest, scale), faces, f"'{obj.name}'")


def owners(armature, feet):
    """Bone name -> the foot, toe or heel bone it moves with."""
    ends = {name for foot in feet for name in (foot.foot, foot.toe, foot.heel) if name}
    owner = {}
    for bone in armature.data.bones:
        above = bone
        while above is not None and above.name not in ends:
            above = above.parent
        if above is not None:
            owner[bone.name] = above.name
    return owner


# ---- what renders show -------------------------------------------------------------------------------


def drawn(scene, obj, frames=None):
    """Whether renders show an object: it is on, at one of the frames if something switches it, and in a collection that
    is on in some view layer that is used."""
    off = obj.hide_render if frames is None else all(off_in_renders(scene, obj, frames))
    used = [each for each in scene.view_layers if each.use] or list(scene.view_layers)
    return not off and any(_within(each.layer_collection, obj) for each in used)


def walks(scene, obj):
    """Whether a walker leaves prints: renders show it, or what hangs on it. An armature itself is never rendered."""
    if obj.type != "ARMATURE":
        animation = obj.animation_data
        keyed = compat.curve(animation, "hide_render") if animation and not animation.nla_tracks else None
        times = [key.co.x * clock.stretch(scene) for key in keyed.keyframe_points] if keyed else []
        return drawn(scene, obj, times or None)
    used = [each for each in scene.view_layers if each.use] or list(scene.view_layers)
    return any(_within(each.layer_collection, obj) for each in used) or any(
        drawn(scene, each) for each in hanging(scene, obj)
    )


def _within(layer, obj):
    if layer.collection.hide_render:
        return False
    return (
        not layer.exclude
        and obj.name in layer.collection.objects
        and layer.collection.objects[obj.name] == obj
        or any(_within(each, obj) for each in layer.children)
    )


# ---- what hangs on an armature -------------------------------------------------------------------------


def hanging(scene, armature):
    """Meshes, and empties that show collections, which follow an armature in any way, in the scene's order."""
    wants = {
        obj: set(_led_by(obj))
        for obj in scene.objects
        if obj != armature and not (obj.type == "MESH" and obj.desire_path.is_ground)
    }
    found, more = set(), {armature}
    while more:
        more = {obj for obj, leaders in wants.items() if obj not in found and leaders & more}
        found |= more
    return [
        obj
        for obj in wants
        if obj in found
        and (
            obj.type == "MESH" or obj.type == "EMPTY" and obj.instance_type == "COLLECTION" and obj.instance_collection
        )
    ]


def _led_by(obj):
    """The objects that an object depends on for where and how it is."""
    if obj.parent is not None:
        yield obj.parent
    for each in list(obj.constraints) + [c for bone in (obj.pose.bones if obj.pose else ()) for c in bone.constraints]:
        yield from filter(None, [getattr(each, "target", None)])
        yield from (target.target for target in getattr(each, "targets", ()) if target.target is not None)
    for each in obj.modifiers:
        if not each.show_render:
            continue
        yield from filter(None, (getattr(each, name) for name in _pointers(type(each))))
        if each.type == "NODES" and each.node_group is not None:
            yield from compat.node_objects(each)


@functools.cache
def _pointers(kind):
    """Names of the properties of a kind of modifier that are objects."""
    return [
        prop.identifier
        for prop in kind.bl_rna.properties
        if prop.type == "POINTER" and prop.fixed_type.identifier == "Object"
    ]


# ---- points and bones ----------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Piece:
    """A mesh that is shown once: itself, or where an empty shows its collection."""

    holder: object
    source: object
    inside: np.ndarray  # from the collection's space to the holder's (4, 4), None: the holder is the mesh


def bound(scene, armature, objects, owner, frames=None):
    """(rest positions in armature space (n, 3), triangles, bone -> weights (n,)) of every mesh of objects that hang
    on an armature.

    owner: the bones that count, and those they count for
    """
    frames = list(frames) if frames is not None else [scene.frame_current]
    pieces = [piece for obj in objects for piece in _pieces(obj)]
    groups = {piece.source: _groups(piece.source, armature, owner) if piece.inside is None else {} for piece in pieces}
    on_bone = {
        obj: obj.parent_bone
        for obj in objects
        if obj.parent == armature and obj.parent_type == "BONE" and not groups.get(obj) and not len(obj.constraints)
    }
    pieces = [piece for piece in pieces if piece.holder not in on_bone or on_bone[piece.holder] in owner]
    if not pieces:
        return []
    with _copies(
        scene, {each for piece in pieces for each in (piece.holder, piece.source)}, groups, armature
    ) as copies:
        with _resting(armature), private_scene(scene, armature, *copies.values()) as own:
            for obj, copy in copies.items():
                stack.let_led(scene, own, copy, obj, frames[0])
            rest = [_seen(own, armature, copies[p.source], _placed(p, copies), frames[0]) for p in pieces]
        shares, watched = [], []
        for k, piece in enumerate(pieces):
            points, _, found = rest[k]
            if piece.holder in on_bone:
                shares.append({owner[on_bone[piece.holder]]: np.ones(len(points), np.float32)})
                continue
            share = {name: found[WEIGHT.format(name)] for name in groups[piece.source]}
            shares.append({name: each for name, each in share.items() if each.any()})
            if not share or not shares[-1] and any(each.type == "NODES" for each in piece.source.modifiers):
                watched.append(k)
        if watched:
            looks = [frames[int(round(at))] for at in np.linspace(0, len(frames) - 1, min(LOOKS, len(frames)))]
            followed = _watched(
                scene, armature, [pieces[k] for k in watched], copies, [rest[k][0] for k in watched], owner, looks
            )
            for k, share in zip(watched, followed):
                shares[k] = share
    return [(points, faces, share) for (points, faces, _), share in zip(rest, shares)]


def _pieces(obj):
    if obj.type == "MESH":
        return [_Piece(obj, obj, None)]
    return [_Piece(obj, source, inside) for source, inside in _shown(obj.instance_collection, np.eye(4))]


def _shown(collection, outer):
    """(mesh, the transform from its world to the space of what shows the collection) of all that renders show of it."""
    if collection.hide_render:
        return
    inside = outer.copy()
    inside[:3, 3] -= outer[:3, :3] @ np.array(collection.instance_offset)
    todo = [collection]
    for each in todo:
        todo += [child for child in each.children if not child.hide_render]
        for obj in each.objects:
            if obj.hide_render:
                continue
            if obj.type == "MESH":
                yield obj, inside
            elif obj.type == "EMPTY" and obj.instance_type == "COLLECTION" and obj.instance_collection:
                yield from _shown(obj.instance_collection, inside @ np.array(obj.matrix_world, np.float64))


def _groups(obj, armature, owner):
    """Bone that counts -> the vertex groups that move with it, of a mesh that the armature deforms by them."""
    deforms = (
        obj.parent == armature
        and obj.parent_type == "ARMATURE"
        or any(
            each.type == "ARMATURE" and each.object == armature and each.show_render and each.use_vertex_groups
            for each in obj.modifiers
        )
    )
    found = {}
    for group in obj.vertex_groups if deforms else ():
        if group.name in owner:
            found.setdefault(owner[group.name], []).append(group.name)
    return found


@contextmanager
def _copies(scene, objects, groups, armature=None):
    """Object -> a private copy that is as renders have it, without what the armature's own modifiers do to it and
    with the weights of its groups as attributes; gone afterwards."""
    with ExitStack() as after:
        copies = {}
        for obj in objects:
            copy = copies[obj] = obj.copy()
            after.callback(bpy.data.objects.remove, copy)
            copy.hide_viewport = False
            if obj.type != "MESH":
                continue
            stack.show(scene, copy, obj)
            for each in copy.modifiers:
                if each.type == "ARMATURE" and each.object == armature and groups.get(obj):
                    each.show_viewport = False
                if hasattr(each, "use_pin_to_last"):
                    each.use_pin_to_last = False
            trees = [stack.realised()] if any(each.type == "NODES" for each in copy.modifiers) else []
            trees += [_weights(groups[obj])] if groups.get(obj) else []
            for tree in trees:
                after.callback(bpy.data.node_groups.remove, tree)
                compat.nodes_modifier(copy, "desire_path", tree)
        yield copies


def _weights(groups):
    """A tree that writes the summed weights of groups as attributes, one for every bone."""
    tree = compat.geometry_tree("desire_path weights", bpy.data.node_groups.new)
    wire = wiring.Wiring(tree)
    geometry = wire.add("NodeGroupInput").outputs[0]
    for bone, names in groups.items():
        total = wire.named(names[0])
        for name in names[1:]:
            total = wire.math("ADD", total, wire.named(name))
        geometry = wire.store(geometry, WEIGHT.format(bone), total)
    tree.links.new(geometry, tree.nodes.new("NodeGroupOutput").inputs[0])
    return tree


@contextmanager
def _resting(armature):
    """The armature in its rest pose."""
    data = armature.data
    before = data.pose_position
    try:
        if before != "REST":
            data.pose_position = "REST"
        yield
    finally:
        if before != "REST":
            data.pose_position = before
            bpy.context.view_layer.update()  # nothing is left to be done that looks like a change later


def _placed(piece, copies):
    return None if piece.inside is None else (copies[piece.holder], piece.inside)


def _seen(own, armature, copy, placed, frame):
    """(positions in the armature's space, triangles that face as they are seen, attributes of ours) of a copy."""
    found = evaluated(own, copy, frame)
    depsgraph = own.view_layers[0].depsgraph
    world = np.array(found.matrix_world, np.float64)
    if placed is not None:
        world = np.array(placed[0].evaluated_get(depsgraph).matrix_world, np.float64) @ placed[1] @ world
    local = np.linalg.inv(np.array(armature.evaluated_get(depsgraph).matrix_world, np.float64)) @ world
    faces = compat.triangles(found.data)
    if np.linalg.det(local[:3, :3]) < 0.0:
        faces = faces[:, ::-1]
    ours = {
        each.name: compat.float_attribute(found.data, each.name)
        for each in found.data.attributes
        if each.name.startswith(WEIGHT.format(""))
    }
    return axes.points(local, compat.positions(found.data), 1.0), faces, ours


def _watched(scene, armature, pieces, copies, rest, owner, frames):
    """Bone -> weights for every piece, by what bone carries its points along."""
    bones = [bone for bone in armature.data.bones if bone.use_deform or bone.name in owner]
    heads, tails = (np.array([getattr(bone, at) for bone in bones], np.float64) for at in ("head_local", "tail_local"))
    back = np.linalg.inv(np.array([bone.matrix_local for bone in bones], np.float64))
    apart = [np.zeros((len(bones) + 2, len(points))) for points in rest]  # the last two: the object, and the world
    used = {each for piece in pieces for each in (piece.holder, piece.source)}
    with private_scene(scene, armature, *(copies[each] for each in used)) as own:
        first = None
        for frame in frames:
            pose = evaluated(own, armature, frame)
            world = np.array(pose.matrix_world, np.float64)
            first = world if first is None else first
            moves = np.array([pose.pose.bones[bone.name].matrix for bone in bones], np.float64) @ back
            moves = np.concatenate([moves, [np.eye(4), np.linalg.inv(world) @ first]])
            for piece, points, far in zip(pieces, rest, apart):
                now = _seen(own, armature, copies[piece.source], _placed(piece, copies), frame)[0]
                if now.shape != points.shape:
                    far[:] = np.inf
                    continue
                for k, move in enumerate(moves):
                    np.maximum(far[k], np.linalg.norm(axes.points(move, points, 1.0) - now, axis=1), out=far[k])
    same = SAME * np.ptp(np.concatenate([heads, tails]), axis=0).max()
    return [_carried(points, far, bones, heads, tails, owner, same) for points, far in zip(rest, apart)]


def _carried(points, far, bones, heads, tails, owner, same):
    """Of the bones that carry a point along best, the nearest one has it."""
    best = far.min(axis=0)
    near = np.full(len(points), np.inf)
    which = np.full(len(points), -1)
    for k in range(len(bones)):
        bone = tails[k] - heads[k]
        along = np.clip((points - heads[k]) @ bone / max(bone @ bone, 1e-30), 0.0, 1.0)
        off = np.linalg.norm(points - heads[k] - along[:, None] * bone, axis=1)
        better = np.isfinite(best) & (far[k] <= best + same) & (off < near)
        near[better], which[better] = off[better], k
    share = {}
    for k in np.unique(which[which >= 0]):
        name = owner.get(bones[k].name)
        if name is not None:
            share.setdefault(name, np.zeros(len(points), np.float32))[which == k] = 1.0
    return share
