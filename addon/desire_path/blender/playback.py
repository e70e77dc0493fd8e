"""playback.py - a bake plays in any Blender, with or without this add-on.

    frames/trail_0000.exr ..  --image texture-->  attribute `desire_path`  --> position, groups
    frames/lean_0000.exr ..   --image texture-->  attributes `desire_path_lean`, `plant_strength`

One geometry-nodes modifier samples the frame's image once per point, by world position, into one
colour attribute (height change, plant strength, compression, pressure_time) and moves the points by it;
where plants grew, a second image says how they lie. All numbers are constants inside the tree, so the
same tree works from 3.4 to 5.2. File 0 is the untouched ground, file n the frame
`frame_start + n - 1`.
"""

import os

import bpy
import numpy as np

from ..bake.output import NEW
from . import axes, clock, compat, strengths, tree_numbers

ATTRIBUTE = "desire_path"  # the colour attribute on the evaluated mesh
MODIFIER = "Desire Path"
DETAIL = "desire_path_detail"  # vector attribute of a copy: heights of veins, crumbs and grit [m]
STRAY = "desire_path_stray"  # vector attribute of a copy: how far prints are seen aside, which heap shows crumbs [m]
BARE = (0.0005, 0.004)  # veins show where less loose soil lies [m]
SUCKED = (0.002, 0.012)  # where it was pressed so deep [m]
DISTURBED = (0.0003, 0.003)  # grit shows where soil was pressed or heaped so far [m]
COPIED = "desire_path_copied"  # on a tree: which mesh the copy it shows was made of
WISHES = "desire_path_wishes"  # on a tree: how fine the mesh was wanted; trees of before lack it
STACK, LIE = "desire_path_stack", "desire_path_lie"  # and what a tree was made for, see keep
STACKED = ("show_viewport", "show_render", "levels", "render_levels", "subdivision_type")  # of modifiers
MOVED = 1e-5  # points this near to where they were have not moved, in shares of their distance from the origin
SAMPLES = 24  # points of the mesh that tell whether it was changed
TAG = "desire_path"  # custom property on the trees and images that are ours
ALIGNED = 0.02  # points this near to cell centres need no interpolation [cell]
ROUNDED = 0.01  # of a frame is lost where time is stretched
COPY_NODE = "GeometryNodeObjectInfo"
BETWEEN = ("Closest", "Linear")  # what is shown between cells
GROUPS = ("plant_strength", "compression")  # vertex groups, when asked for
LEAN = "desire_path_lean"  # vector attribute where plants grew: lean x, lean y, crushed
STRENGTH = "plant_strength"  # float attribute where plants grew


def modifier(obj):
    """Our modifier on the object, by its tree's mark, or None."""
    for each in obj.modifiers:
        if each.type == "NODES" and each.node_group is not None and TAG in each.node_group:
            return each
    return None


def image_of(tree):
    """The image sequence of the ground a tree of ours plays, or None."""
    return images(tree).get("trail")


def images(tree):
    """The images a tree plays, what there is: the sequences "trail" and "lean", and "grown", a still."""
    found = {}
    for node in tree.nodes:
        if node.bl_idname == "GeometryNodeImageTexture":
            image = node.inputs["Image"].default_value
            if image is not None:
                found[image.get(TAG, "trail")] = image
    return found


def attach(
    obj, frames, index, *, count, world, scale, smooth, corners, layer_depth=0.0, standing=(), place=None, copy=None
):
    """Play the frames of a bake on the object; replaces what it played before.

    frames: the folder of the images as Blender writes paths (`//` for beside the .blend file)
    index: cell, x0, y0 [m], nx, ny, frame_start of the images
    count: frames there are, file 0 not counted
    world: the object's matrix when it was baked (4, 4); scale: metres in a unit [m]
    smooth: interpolate between cells, for meshes whose points are not cell centres
    corners: the local box of the mesh's points (8, 3)
    layer_depth: > 0 fills the vertex groups, where compression 1 is a layer pressed flat [m]
    standing: plants off the images, (vertex group, "" or plants.Spread, their strength where that is 1) each
    place: where our modifier goes (stack.Place); None: where it was, or after all others
    copy: an object whose mesh is shown in place of the ground's own (refined.py); None: the ground's own is
    """
    old = modifier(obj)
    before = list(obj.modifiers).index(old) if old is not None else len(obj.modifiers)
    shown = {name: _image(frames, name) for name in ("trail", "lean")[: 1 + has_lean(index)]}
    tree = _tree(obj, shown, index, count, world, scale, smooth, corners, layer_depth, standing, place, copy)
    if _taken_over(obj, tree):
        discard(tree)
        ours, tree = old, old.node_group
    else:
        kept = strengths.values(old) if old is not None else {}
        detach(obj)
        tree.name = f"{MODIFIER} {obj.name}"
        for name, image in shown.items():
            image.name = f"desire_path {name}"
        ours = compat.nodes_modifier(obj, MODIFIER, tree)
        ours.show_expanded = False
        strengths.give(ours, kept)
    tree[TAG] = mark(frames, index, count)
    compat.move_modifier(obj, ours, place.before if place is not None else before)
    keep(obj, tree, world)
    return ours


def _taken_over(obj, tree):
    """Let the tree an object plays show what another one would, where they differ by numbers alone; returns whether it
    does. Undo steps know the datablocks that were there before, and none that came between two of them."""
    there = [each for each in obj.modifiers if each.type == "NODES" and each.node_group and TAG in each.node_group]
    if len(there) != 1 or there[0].node_group.users != 1:
        return False
    old, played, wanted = there[0].node_group, images(there[0].node_group), images(tree)
    if (
        played.keys() != wanted.keys()
        or "grown" in wanted
        or any(each.filepath != wanted[name].filepath for name, each in played.items())
        or copy_of(old) != copy_of(tree)
        or tree_numbers.form(old) != tree_numbers.form(tree)
    ):
        return False
    tree_numbers.copy(tree, old)
    for each in played.values():
        each.reload()
    old.update_tag()
    obj.update_tag(refresh={"DATA"})
    return True


def animates_ours(obj, path):
    """Whether a data path of an object leads into our modifier, which changes nothing that is walked on."""
    ours = modifier(obj) if isinstance(obj, bpy.types.Object) else None
    return ours is not None and path.startswith(strengths.start(ours))


def interpolates(tree):
    """Whether a tree of ours shows what lies between cells."""
    return any(node.interpolation != "Closest" for node in tree.nodes if node.bl_idname == "GeometryNodeImageTexture")


def keep(obj, tree, world):
    """Write down on a tree for which modifiers, points and place of the ground it was made."""
    tree[STACK] = stacked(obj)
    tree[WISHES] = wishes(obj)
    tree[LIE] = [float(each) for part in (world, samples(obj)) for each in np.asarray(part, np.float64).ravel()]


def wishes(obj):
    """How fine the user wants the mesh shown, in a word."""
    settings = obj.desire_path
    fine = [settings.detail_size] if settings.detail_size else []
    return str([settings.refine, settings.refine_size, settings.refine_pixels, *fine])


def made_for(tree):
    """(the object's matrix (4, 4), the samples of its points (n, 3)) a tree was made for."""
    numbers = np.array(tree[LIE], np.float64)
    return numbers[:16].reshape(4, 4), numbers[16:].reshape(-1, 3)


def is_moved(obj):
    """Whether the points of a ground lie elsewhere than those its tree was made for."""
    ours = modifier(obj)
    if ours is None or LIE not in ours.node_group:
        return False
    world, was = made_for(ours.node_group)
    now = samples(obj)
    if len(was) != len(now):
        return True
    there, here = (
        axes.points(np.array(place, np.float64), each, 1.0) for place, each in ((world, was), (obj.matrix_world, now))
    )
    return bool(len(now)) and np.abs(there - here).max() > MOVED * max(np.abs(there).max(), 1.0)


def samples(obj):
    """Some points of an object's mesh, always the same ones (n, 3)."""
    vertices = obj.data.vertices
    if not len(vertices):
        return np.zeros((0, 3))
    return np.array(
        [vertices[k].co for k in np.unique(np.linspace(0, len(vertices) - 1, SAMPLES).astype(int))], np.float64
    )


def stacked(obj):
    """All that the place of our modifier, and which points there are, follow from, in a word; what is keyed is not
    among it."""
    out = [str(len(obj.data.vertices))]
    for each in obj.modifiers:
        tree = each.node_group if each.type == "NODES" else None
        if tree is not None and TAG in tree:
            out.append("ours")
            continue
        of = f'modifiers["{bpy.utils.escape_identifier(each.name)}"].'
        values = {
            name: getattr(each, name)
            for name in STACKED
            if hasattr(each, name) and not compat.is_keyed(obj.animation_data, of + name)
        }
        seen = values.pop("show_viewport", False), values.pop("show_render", False)
        out.append(f"{each.name} {each.type} {any(seen)} {tree.name if tree is not None else ''} {[*values.values()]}")
    return "; ".join(out)


def detach(obj):
    """Take our modifier off, with its tree and image if nobody else uses them."""
    while True:
        ours = modifier(obj)
        if ours is None:
            return
        tree = ours.node_group
        obj.modifiers.remove(ours)
        discard(tree)


def sweep():
    """Remove trees of ours that nobody uses any more, as once they were applied."""
    for tree in [each for each in bpy.data.node_groups if each.library is None and each.users == 0 and STACK in each]:
        discard(tree)


def discard(tree):
    """Remove a tree of ours that nobody uses, and its images if nobody else does."""
    if tree.users > 0:
        return
    played, copy = images(tree).values(), copy_of(tree)
    bpy.data.node_groups.remove(tree)
    if copy is not None and copy.users == 0:
        mesh = copy.data
        bpy.data.objects.remove(copy)
        if mesh.users == 0:
            bpy.data.meshes.remove(mesh)
    for image in played:
        if TAG in image and image.users == 0:
            bpy.data.images.remove(image)


def repoint(old, new):
    """Let what plays from a folder play from another one, to which the files were moved.

    old: as the system writes paths; new: as Blender does
    """
    stems = [each for obj in bpy.data.objects for each in obj.modifiers if each.type == "MESH_CACHE"]
    for each in [image for image in bpy.data.images if TAG in image] + stems:
        path = os.path.abspath(bpy.path.abspath(each.filepath))
        if each.id_data.library is None and path.startswith(old + os.sep):
            each.filepath = join(new, *path[len(old) + 1 :].split(os.sep))


def has_lean(index):
    """Whether a bake says how plants lie."""
    return bool(getattr(index, "lean", False))


def is_published(frames):
    """Whether a folder of frames is that of a bake that is shown, not of one that was cut off in the making."""
    return os.path.basename(os.path.dirname(frames)) != NEW


def mark(frames, index, count):
    """What a tree plays, in a word, to tell whether the files are still the same."""
    place = "frames" if is_published(frames) else NEW
    return (
        f"{place} {index.cell!r} {index.x0!r} {index.y0!r} {index.nx} "
        f"{index.ny} {index.frame_start} {count}" + has_lean(index) * " lean"
    )


def _image(frames, name):
    """A fresh datablock for the sequence: an old one would show frames out of its cache."""
    path = join(frames, f"{name}_0001.exr")
    image = bpy.data.images.new(f"desire_path {name}", 1, 1, float_buffer=True)
    image.source = "FILE"
    image.filepath = path
    image.source = "SEQUENCE"
    image.colorspace_settings.name = "Non-Color"
    image.alpha_mode = "CHANNEL_PACKED"
    image[TAG] = name
    return image


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


def join(folder, *names):
    """Join below a folder that may begin with Blender's `//`."""
    return "/".join((folder.replace("\\", "/").rstrip("/"),) + names)


class Wiring:
    """Nodes in a row; `add` returns the node, links what is given by socket name or number."""

    def __init__(self, tree):
        self.tree = tree
        self.column = 0

    def add(self, kind, settings=None, **inputs):
        node = self.tree.nodes.new(kind)
        node.location = (180 * self.column, -40 * (self.column % 3))
        self.column += 1
        for name, value in (settings or {}).items():
            setattr(node, name, value)
        for name, value in inputs.items():
            target = node.inputs[int(name[1:])] if name.startswith("_") else compat.socket(node.inputs, name)
            if target is None:
                continue  # this Blender's node has no such input
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, target)
            else:
                target.default_value = value
        return node

    def math(self, operation, *values):
        node = self.add("ShaderNodeMath", {"operation": operation}, **{f"_{i}": v for i, v in enumerate(values)})
        return node.outputs[0]

    def vector(self, operation, *values, scale=None):
        node = self.add(
            "ShaderNodeVectorMath",
            {"operation": operation},
            **{f"_{i}": v for i, v in enumerate(values)},
            **({} if scale is None else {"Scale": scale}),
        )
        return compat.socket(node.outputs, "Vector") or compat.socket(node.outputs, "Value")

    def image(self, image, at, number, smooth, beyond="CLIP"):
        """Sample file `number` of an image sequence; outputs Color and Alpha. smooth: whether between cells, or
        how; beyond: what lies around it"""
        return self.add(
            "GeometryNodeImageTexture",
            {"interpolation": smooth if isinstance(smooth, str) else BETWEEN[bool(smooth)], "extension": beyond},
            Image=image,
            Vector=at,
            Frame=number,
        )

    def named(self, name, kind="FLOAT"):
        """The field of a named attribute."""
        node = self.add("GeometryNodeInputNamedAttribute", {"data_type": kind}, Name=name)
        return compat.socket(node.outputs, "Attribute")

    def store(self, geometry, name, value, kind="FLOAT", domain="POINT"):
        """Store a field as a named attribute; returns the geometry."""
        return self.add(
            "GeometryNodeStoreNamedAttribute",
            {"data_type": kind, "domain": domain},
            Geometry=geometry,
            Name=name,
            Value=value,
        ).outputs[0]

    def xyz(self, x=0.0, y=0.0, z=0.0):
        return self.add("ShaderNodeCombineXYZ", X=x, Y=y, Z=z).outputs[0]

    def between(self, value, low, high, first=0.0, last=1.0):
        """`first` below low, `last` above high, a smooth step between."""
        node = self.add(
            "ShaderNodeMapRange",
            {"interpolation_type": "SMOOTHSTEP"},
            Value=value,
            **{"From Min": low, "From Max": high, "To Min": first, "To Max": last},
        )
        return compat.socket(node.outputs, "Result")

    def split(self, vector):
        """The x, y and z of a vector."""
        return self.add("ShaderNodeSeparateXYZ", Vector=vector).outputs


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


def _tree(obj, shown, index, count, world, scale, smooth, corners, layer_depth, standing, place, copy):
    tree = compat.geometry_tree(MODIFIER + " " + obj.name, bpy.data.node_groups.new)
    strengths.declare(tree)
    wire = Wiring(tree)
    entry = given = wire.add("NodeGroupInput")
    if place is not None and place.realise:  # the ground is made of instances, which cannot be pressed
        entry = wire.add("GeometryNodeRealizeInstances", Geometry=entry.outputs[0])
    if copy is not None:
        entry = _in_place(wire, entry, copy)
    leave = tree.nodes.new("NodeGroupOutput")
    number = file_number(wire, index, count, clock.stretch_of(obj))

    # where in the image
    turn, shift = axes.image_axes(world, scale, index)
    at = _turned(wire, turn, shift)
    inside = None if _covers(corners, turn, shift) else within(wire, at)
    detailed = copy is not None and DETAIL in copy.data.attributes
    if detailed:  # rims are round, and edges stray
        stray = wire.named(STRAY, "FLOAT_VECTOR")
        at = wire.vector("MULTIPLY_ADD", stray, (1.0 / (index.nx * index.cell), 1.0 / (index.ny * index.cell), 0.0), at)
        smooth = "Cubic"

    # sample once, read everything from it
    texture = wire.image(shown["trail"], at, number, smooth)
    some = {} if inside is None else {"Selection": inside}
    stored = entry
    scattered = place is not None and place.scattered  # before us: it goes down with the ground
    for domain in ("INSTANCE", "POINT")[not scattered :]:
        stored = wire.add(
            "GeometryNodeStoreNamedAttribute",
            {"data_type": "FLOAT_COLOR", "domain": domain},
            Geometry=stored.outputs[0],
            Name=ATTRIBUTE,
            Value=texture.outputs["Color"],
            **some,
        )
    split = wire.add("FunctionNodeSeparateColor", {"mode": "RGB"}, Color=wire.named(ATTRIBUTE, "FLOAT_COLOR"))
    up, rise = axes.lift(world, scale), strengths.rise(wire, given, split.outputs[0], split.outputs[2])
    if detailed:
        rise = wire.math(
            "ADD", rise, strengths.of_prints(wire, given, _detail(wire, split.outputs, wire.split(stray)[2]))
        )
    if up[0] == 0.0 and up[1] == 0.0 and up[2] == 1.0:
        offset = wire.add("ShaderNodeCombineXYZ", Z=rise).outputs[0]
    else:
        offset = wire.vector("MULTIPLY", tuple(up), rise)
    if compat.socket(stored.inputs, "Selection") is not None:
        some = {}  # what is not stored reads zero
    geometry = stored.outputs[0]
    if "lean" in shown:
        grown = _grown(wire, standing, world, scale) if inside is not None else None
        geometry = _lean(wire, geometry, wire.image(shown["lean"], at, number, smooth), inside, grown)
    geometry = wire.add("GeometryNodeSetPosition", Geometry=geometry, Offset=offset, **some).outputs[0]

    geometry = strengths.painted(wire, given, geometry, split.outputs[0], split.outputs[2])

    # a group of that name on the object is filled instead of an attribute
    if layer_depth > 0.0:
        strength = wire.named(STRENGTH) if "lean" in shown else split.outputs[1]
        weights = (strength, wire.math("MULTIPLY", split.outputs[2], 1.0 / layer_depth))
        for name, weight in zip(GROUPS, weights):
            geometry = wire.store(geometry, group_name(name), weight)
    tree.links.new(geometry, leave.inputs[0])
    leave.location = (180 * wire.column, 0)
    return tree


def _detail(wire, baked, threshold):
    """How high what is finer than a cell stands, by how far soil was pressed and heaped at that frame. MODEL 8.3"""
    heap = wire.math("MAXIMUM", wire.math("ADD", baked[0], baked[2]), 0.0)
    bare = wire.between(heap, *BARE, 1.0, 0.0)
    veins = wire.math("MULTIPLY", wire.between(baked[2], *SUCKED), bare)
    crumbs = wire.between(heap, threshold, wire.math("MULTIPLY", threshold, 2.0))
    grit = wire.between(wire.math("MAXIMUM", baked[2], heap), *DISTURBED)
    shares = wire.xyz(veins, crumbs, grit)
    return wire.vector("DOT_PRODUCT", wire.named(DETAIL, "FLOAT_VECTOR"), shares)


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


def group_name(name):
    return f"{ATTRIBUTE}_{name}"


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
