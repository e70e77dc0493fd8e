"""cover.py - final values on the mesh itself: float attributes, and vertex groups when asked for.

Playback needs neither. Attributes are for materials and nodes, groups for hair and for modifiers that
know nothing else. What we made is remembered by name and removed again; what was there stays.
"""

import os
import re

import numpy as np

from ..files import atomic_file
from ..ground import maps
from ..ground import mesh as meshes
from . import axes, compat, layered, playback, playback_tree, soils

HEAD = 1 << 14  # bytes of a file of maps in which all its channels are named
MORE = ("surface_", "carried_", "layer_")  # maps of ground in layers, and of soil that sticks
LEVELS = 1024  # of a weight in a vertex group
WIDE = 2.0  # a long print is this many times its area by its outline wide; points farther apart do not show it
PRINTS, WHERE = "the prints in", "where the prints are"  # words of few_points
COARSE = 4.0  # nor does what is farther apart than this show what was baked [cells]


def make_groups(obj):
    """Make the vertex groups that playback fills; returns the depth that counts as 1 [m]."""
    settings = obj.desire_path
    names = []
    for name in map(playback_tree.group_name, playback_tree.GROUPS):
        if name not in obj.vertex_groups:
            obj.vertex_groups.new(name=name)
            names.append(name)
    settings.made_groups = ",".join(names)
    return float(soils.soil_of(settings).layer_depth) + layered.above(obj)


def fill(obj, surface, index, depth, planes, standing=()):
    """Write the last frame's values, and off the images plants as they grew (`standing`: see playback_tree.Playing);
    returns sentences about what could not be written."""
    settings = obj.desire_path
    mesh = obj.data
    if not settings.attributes and depth == 0.0:
        return []
    if mesh.library is not None:
        return [f"The mesh of '{obj.name}' is linked from another file: no attributes were written."]
    value = values(obj, surface, index, planes, standing)
    warnings = []
    if settings.attributes:
        names = []
        for name in planes:
            if name in mesh.attributes:
                warnings.append(f"'{obj.name}' has an attribute '{name}' of its own: it was left alone.")
                continue
            if name in obj.vertex_groups:  # no attribute may be called as one of them
                warnings.append(f"'{obj.name}' has a vertex group '{name}' of its own: it was left alone.")
                continue
            names.append(mesh.attributes.new(name, "FLOAT", "POINT").name)
            if name in value:  # else it is 0 all over, as it is made
                mesh.attributes[name].data.foreach_set("value", value[name])
        settings.made_attributes = ",".join(names)
    if depth > 0.0:
        for name, full in (("plant_strength", 1.0), ("compression", depth)):
            if name in value:
                weigh(obj.vertex_groups[playback_tree.group_name(name)], value[name] / full)
    mesh.update_tag()
    return warnings


def values(obj, surface, index, planes, standing):
    """What the planes say at the points of an object that lies as the ground does, by name, float32 (n,) each; those
    that are zero all over are left out."""
    mesh = obj.data
    value = meshes.at_points(
        {name: plane for name, plane in planes.items() if plane.any()},
        index.cell,
        (index.x0, index.y0),
        compat.positions(mesh),
        surface.world[:3] * surface.scale,
        playback.ALIGNED,
    )
    if "plant_strength" in value and standing:
        at = axes.points(surface.world, compat.positions(mesh), surface.scale)[:, :2] - (index.x0, index.y0)
        off = ((at < 0.0) | (at > np.array((index.nx, index.ny)) * index.cell)).any(axis=1)
        if getattr(index, "columns", 0):
            i, j = np.floor(at / index.cell).astype(int).T
            off |= ~index.atlas.find(i, j)[2]
        value["plant_strength"] = np.where(
            off, grown(obj, surface.world, surface.scale, standing), value["plant_strength"]
        ).astype(np.float32)
    return value


def grown(obj, world, scale, standing):
    """Cover of every vertex where nobody walked, from (vertex group, attribute or Spread, cover where it is 1);
    world: the object's matrix (4, 4), scale: metres in a unit [m]"""
    out = np.zeros(len(obj.data.vertices), np.float32)
    for name, full in standing:
        if hasattr(name, "at"):
            at = axes.points(world, compat.positions(obj.data), scale)
            out += np.float32(full) * name.at(at[:, :2]).astype(np.float32)
            continue
        weight = np.float32(1.0)
        if name:
            painted = group_weights(obj, name)
            weight = compat.float_attribute(obj.data, name) if painted is None else painted
        if weight is not None:
            out += np.float32(full) * weight
    return np.minimum(out, 1.0)


def group_weights(obj, name):
    """Weights of a vertex group, float32 (n,), or None where there is none of that name."""
    group = obj.vertex_groups.get(name)
    if group is None:
        return None
    weight = np.zeros(len(obj.data.vertices), np.float32)
    for vertex in obj.data.vertices:
        for member in vertex.groups:
            if member.group == group.index:
                weight[vertex.index] = member.weight
    return weight


def remove(obj):
    """Take away the attributes and groups that were made for a bake."""
    settings = obj.desire_path
    attributes = obj.data.attributes
    for name in filter(None, settings.made_attributes.split(",")):
        if name in attributes:
            attributes.remove(attributes[name])
    for name in filter(None, settings.made_groups.split(",")):
        if name in obj.vertex_groups:
            obj.vertex_groups.remove(obj.vertex_groups[name])
    settings.made_attributes = settings.made_groups = ""


def few_points(obj, surface, index, planes):
    """Sentences: one where the mesh has too few points in the prints to show them, in renders or in the viewport."""
    printed = planes["compression"] > 0.0
    cells = np.count_nonzero(printed)
    if not cells:
        return []
    edges = sum(np.count_nonzero(np.diff(printed, axis=axis, prepend=False, append=False)) for axis in (0, 1))
    render, drawn = (_apart(points, index, printed) for points in (surface.vertices, surface.drawn))
    render /= np.sqrt(surface.finer)
    wide = WIDE * cells / edges  # in cells
    apart = lambda cells: f"{cells * index.cell:.2g} m apart" if np.isfinite(cells) else "too far apart"
    if min(render, drawn) > wide:
        return [
            f"'{obj.name}' has hardly a point {WHERE}, so that they cannot be seen: "
            f"subdivide it there, to about {index.cell:g} m."
        ]
    if render > wide:
        return [
            f"The viewport shows {PRINTS} '{obj.name}', renders do not, where its points lie "
            f"{apart(render)}: let its modifiers make it as fine in renders."
        ]
    if drawn > wide:
        return [
            f"Renders show {PRINTS} '{obj.name}', the viewport does not, where its points lie "
            f"{apart(drawn)}: let its modifiers make it as fine in the viewport if you want to see them there."
        ]
    if render > COARSE:
        return [
            f"The points of '{obj.name}' lie {apart(render)} {WHERE}, which are baked in cells of "
            f"{index.cell:g} m: make it as fine as those there to see prints as they are."
        ]
    return []


def is_of_points(sentence):
    """Whether few_points said it."""
    return any(words in sentence for words in (PRINTS, WHERE))


def spacing(surface, index, planes):
    """How far points lie apart where the prints are, in renders or in the viewport, whichever is more [cells]."""
    printed = planes["compression"] > 0.0
    render, drawn = (_apart(points, index, printed) for points in (surface.vertices, surface.drawn))
    return max(render / np.sqrt(surface.finer), drawn)


def _apart(points, index, printed):
    """How far points lie apart where the prints are, infinite where there is none [cells]."""
    there = np.count_nonzero(
        meshes.at_points({"printed": printed}, index.cell, (index.x0, index.y0), points, still=1.0)["printed"]
    )
    return np.sqrt(np.count_nonzero(printed) / there) if there else np.inf


def planes(index):
    """The maps after the last frame that is there, by name."""
    final = os.path.join(os.path.dirname(index.folder), "maps_final.exr")
    if index.complete and os.path.exists(final) and not (index.columns and is_plain(final)):
        found = maps.read(final).planes
        more = [name for name in found if name.startswith(MORE)]
        return {name: found[name] for name in (*(each.name for each in maps.MAPS), *more)}
    frame = maps.read(index.path(index.frames)).planes
    found = {
        "compression": frame["B"],
        "heap": frame["R"] + frame["B"],
        "pressure_time": frame["A"],
        "plant_strength": frame["G"],
    }
    if index.atlas is None:
        return found
    return {name: index.atlas.spread(plane, index.nx, index.ny) for name, plane in found.items()}


def is_plain(final):
    """Whether maps tell of no more than frames do: nothing of layers, or of soil that was carried on."""
    with atomic_file.reader(final) as file:
        head = file.read(HEAD)
    return re.search(rb"\0(%b)[^\0]*\.V\0" % "|".join(MORE).encode(), head) is None


def weigh(group, weight):
    """Write a weight per vertex, vertices of one level together."""
    level = np.clip(np.round(weight * LEVELS), 0, LEVELS).astype(np.int32)
    order = np.argsort(level, kind="stable")
    edges = np.flatnonzero(np.diff(level[order])) + 1
    for block in np.split(order, edges):
        if len(block) and level[block[0]] > 0:
            group.add(block.tolist(), float(level[block[0]]) / LEVELS, "REPLACE")
