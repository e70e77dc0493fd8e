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
from . import axes, compat, paged, playback_tree, strengths, tree_numbers

COPIED = "desire_path_copied"  # on a tree: which mesh the copy it shows was made of
WISHES = "desire_path_wishes"  # on a tree: how fine the mesh was wanted; trees of before lack it
BY_HAND = "desire_path_by_hand"  # on a tree that shows ground while it is pressed by hand
STACK, LIE = "desire_path_stack", "desire_path_lie"  # and what a tree was made for, see keep
STACKED = ("show_viewport", "show_render", "levels", "render_levels", "subdivision_type")  # of modifiers
MOVED = 1e-5  # points this near to where they were have not moved, in shares of their distance from the origin
HIDDEN = "desire_path_hidden"  # on a tree: the files it plays are others now, and it is not shown
SAMPLES = 24  # points of the mesh that tell whether it was changed
ALIGNED = 0.02  # points this near to cell centres need no interpolation [cell]


def modifier(obj):
    """Our modifier on the object, by its tree's mark, or None."""
    for each in obj.modifiers:
        if each.type == "NODES" and each.node_group is not None and playback_tree.TAG in each.node_group:
            return each
    return None


def is_by_hand(modifier):
    """Whether a modifier shows ground while it is pressed by hand."""
    return modifier.type == "NODES" and modifier.node_group is not None and BY_HAND in modifier.node_group


def image_of(tree):
    """The image sequence of the ground a tree of ours plays, or None."""
    return images(tree).get("trail")


def images(tree):
    """The images a tree plays, what there is: the sequences "trail" and "lean", and "pages" and "grown", stills."""
    found = {}
    for node in tree.nodes:
        if node.bl_idname == "GeometryNodeImageTexture":
            image = node.inputs["Image"].default_value
            if image is not None:
                found[image.get(playback_tree.TAG, "trail")] = image
    return found


def attach(obj, frames, playing, anew=True):
    """Play the frames of a bake on the object; replaces what it played before.

    frames: the folder of the images as Blender writes paths (`//` for beside the .blend file); playing: Playing, how.
    anew: False where no datablock may come or go: None then, unless what is there can play the frames
    """
    place = playing.place
    old = modifier(obj)
    before = list(obj.modifiers).index(old) if old is not None else len(obj.modifiers)
    lean = has_lean(playing.index) and (anew or "lean" in images(old.node_group))
    shown = pictures(frames, playing.index, ("trail", "lean")[: 1 + lean])
    tree = playback_tree.create(obj, shown, playing)
    if _taken_over(obj, tree) or not anew and _rebuilt(obj, tree, playing):
        discard(tree)
        ours, tree = old, old.node_group
    elif not anew:
        discard(tree)
        return None
    else:
        kept = strengths.values(old) if old is not None else {}
        detach(obj)
        tree.name = f"{playback_tree.MODIFIER} {obj.name}"
        for name, image in shown.items():
            image.name = f"desire_path {name}"
        ours = compat.nodes_modifier(obj, playback_tree.MODIFIER, tree)
        ours.show_expanded = False
        strengths.give(ours, kept)
    tree[playback_tree.TAG] = mark(frames, playing.index, playing.count)
    show(ours, True)
    compat.move_modifier(obj, ours, place.before if place is not None else before)
    keep(obj, tree, playing.world)
    return ours


def show(ours, on):
    """Hide our modifier, or show it again if it was hidden so."""
    tree = ours.node_group
    if on == (HIDDEN in tree):
        ours.show_viewport = ours.show_render = on
        if on:
            del tree[HIDDEN]
        else:
            tree[HIDDEN] = True


def _holds(obj, tree):
    """The tree an object plays, where it alone plays it and it holds the datablocks that another one does; or None."""
    there = [
        each
        for each in obj.modifiers
        if each.type == "NODES" and each.node_group and playback_tree.TAG in each.node_group
    ]
    if len(there) != 1 or there[0].node_group.users != 1:
        return None
    old, played, wanted = there[0].node_group, images(there[0].node_group), images(tree)
    if (
        played.keys() != wanted.keys()
        or "grown" in wanted
        or any(each.filepath != wanted[name].filepath for name, each in played.items())
        or playback_tree.copy_of(old) != playback_tree.copy_of(tree)
    ):
        return None
    return old


def _taken_over(obj, tree):
    """Let the tree an object plays show what another one would, where they differ by numbers alone; returns whether it
    does. Undo steps know the datablocks that were there before, and none that came between two of them."""
    old = _holds(obj, tree)
    if old is None or tree_numbers.form(old) != tree_numbers.form(tree):
        return False
    tree_numbers.copy(tree, old)
    _look_again(obj, old)
    return True


def _rebuilt(obj, tree, playing):
    """The same by other nodes in the tree that is there."""
    old = _holds(obj, tree)
    if old is None or not strengths.declared(old):
        return False
    playback_tree.create(obj, images(old), playing, into=old)
    _look_again(obj, old)
    return True


def _look_again(obj, tree):
    """The files that a tree plays are others now."""
    for each in images(tree).values():
        each.reload()
    tree.update_tag()
    obj.update_tag(refresh={"DATA"})


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


def lay_of(tree):
    """(the object's matrix (4, 4), the samples of its points (n, 3)) a tree was made for."""
    numbers = np.array(tree[LIE], np.float64)
    return numbers[:16].reshape(4, 4), numbers[16:].reshape(-1, 3)


def is_moved(obj):
    """Whether the points of a ground lie elsewhere than those its tree was made for."""
    ours = modifier(obj)
    if ours is None or LIE not in ours.node_group:
        return False
    world, was = lay_of(ours.node_group)
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
        if tree is not None and playback_tree.TAG in tree:
            out.append("ours")
            continue
        if is_by_hand(each):
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
    played, copy = images(tree).values(), playback_tree.copy_of(tree)
    bpy.data.node_groups.remove(tree)
    if copy is not None and copy.users == 0:
        mesh = copy.data
        bpy.data.objects.remove(copy)
        if mesh.users == 0:
            bpy.data.meshes.remove(mesh)
    for image in played:
        if playback_tree.TAG in image and image.users == 0:
            bpy.data.images.remove(image)


def repoint(old, new):
    """Let what plays from a folder play from another one, to which the files were moved.

    old: as the system writes paths; new: as Blender does
    """
    stems = [each for obj in bpy.data.objects for each in obj.modifiers if each.type == "MESH_CACHE"]
    for each in [image for image in bpy.data.images if playback_tree.TAG in image] + stems:
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
        f"{index.ny} {index.frame_start} {count}"
        + has_lean(index) * " lean"
        + (f" pages {index.columns} {index.rows}" if paged.names(index) else "")
    )


def pictures(frames, index, names):
    """Fresh datablocks of all that a tree needs to play these films of an index, by name."""
    found = {name: sequence(frames, name) for name in names}
    return {**found, **{name: still(frames, name, file) for name, file in paged.names(index).items()}}


def sequence(frames, name):
    """A fresh datablock for the sequence: an old one would show frames out of its cache."""
    image = still(frames, name, f"{name}_0001.exr")
    image.source = "SEQUENCE"
    return image


def still(frames, name, file):
    """The same of one file."""
    image = bpy.data.images.new(f"desire_path {name}", 1, 1, float_buffer=True)
    image.source = "FILE"
    image.filepath = join(frames, file)
    image.colorspace_settings.name = "Non-Color"
    image.alpha_mode = "CHANNEL_PACKED"
    image[playback_tree.TAG] = name
    return image


def join(folder, *names):
    """Join below a folder that may begin with Blender's `//`."""
    above = folder.replace("\\", "/")
    beside = above.startswith("//") and not above.strip("/")  # the .blend file itself, whose slashes are no end
    return "//" + "/".join(names) if beside else "/".join((above.rstrip("/"), *names))
