"""cover.py - final values on the mesh itself: float attributes, and vertex groups when asked for.

Playback needs neither. Attributes are for materials and nodes, groups for hair and for modifiers that
know nothing else. What we made is remembered by name and removed again; what was there stays.
"""
import os

import numpy as np

from ..soil import SOILS
from . import axes, compat, playback

LEVELS = 1024  # of a weight in a vertex group
COARSE = 0.05  # points farther apart than this do not show a foot [m]


def make_groups(obj):
    """Make the vertex groups that playback fills; returns the depth that counts as 1 [m]."""
    settings = obj.desire_path
    made = []
    for name in map(playback.group_name, playback.GROUPS):
        if name not in obj.vertex_groups:
            obj.vertex_groups.new(name=name)
            made.append(name)
    settings.made_groups = ",".join(made)
    return float(SOILS[settings.soil].layer_depth)


def fill(obj, surface, index, depth):
    """Write the last frame's values; returns sentences about what could not be written."""
    settings = obj.desire_path
    mesh = obj.data
    if not settings.attributes and depth == 0.0:
        return []
    if mesh.library is not None:
        return [f"The mesh of '{obj.name}' is linked from another file: no attributes were written."]
    planes = _planes(index)
    local = compat.positions(mesh)
    box = (index.x0 - index.cell, index.y0 - index.cell, index.x0 + (index.nx + 1) * index.cell,
           index.y0 + (index.ny + 1) * index.cell)
    over = np.flatnonzero(axes.beyond(surface.world, local, surface.scale, box) == 0)
    at = axes.points(surface.world, local[over], surface.scale)[:, :2]
    value = {}
    for name, each in _sample(planes, at, index).items():
        value[name] = np.zeros(len(local), np.float32)
        value[name][over] = each
    warnings = []
    if settings.attributes:
        made = []
        for name, each in value.items():
            if name in mesh.attributes:
                warnings.append(f"'{obj.name}' has an attribute '{name}' of its own: it was left "
                                "alone.")
                continue
            made.append(mesh.attributes.new(name, "FLOAT", "POINT").name)
            mesh.attributes[name].data.foreach_set("value", each)
        settings.made_attributes = ",".join(made)
    if depth > 0.0:
        _weigh(obj.vertex_groups[playback.group_name("plant_strength")], value["plant_strength"])
        _weigh(obj.vertex_groups[playback.group_name("compression")], value["compression"] / depth)
    mesh.update_tag()
    return warnings


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


def few_points(obj, surface, index):
    """Sentences: one where the mesh has too few points in the prints to show them."""
    printed = _planes(index)["compression"] > 0.0
    place = (surface.vertices[:, :2] - (index.x0, index.y0)) / index.cell
    rows, columns = (np.flatnonzero(printed.any(axis=k)) for k in (1, 0))
    if not len(rows):
        return []
    near = ((place >= (columns[0], rows[0])) & (place < (columns[-1] + 1, rows[-1] + 1))).all(axis=1)
    i, j = place[near].astype(np.int64).T
    if np.count_nonzero(printed[j, i]) * COARSE ** 2 >= np.count_nonzero(printed) * index.cell ** 2:
        return []
    return [f"'{obj.name}' has hardly a point where the prints are, so that they cannot be seen: "
            f"subdivide it there, to about {index.cell:g} m."]


def _planes(index):
    """The maps after the last frame that is there, by name."""
    from .. import maps
    final = os.path.join(os.path.dirname(index.folder), "maps_final.exr")
    if index.complete and os.path.exists(final):
        found = maps.read(final).planes
        return {each.name: found[each.name] for each in maps.MAPS}
    frame = maps.read(index.path(index.frames)).planes
    return {"compression": frame["B"], "heap": frame["R"] + frame["B"],
            "pressure_time": frame["A"], "plant_strength": frame["G"]}


def _sample(planes, at, index):
    """Values of every plane at world points (n, 2) [m], between cell centres in proportion; 0 outside."""
    place = (at - (index.x0, index.y0)) / index.cell - 0.5
    near = np.round(place)
    place = np.where(np.abs(place - near) < playback.ALIGNED, near, place)
    low = np.floor(place).astype(np.int64)
    part = (place - low).astype(np.float32)
    out = {name: np.zeros(len(at), np.float32) for name in planes}
    for dj in (0, 1):
        for di in (0, 1):
            i, j = low[:, 0] + di, low[:, 1] + dj
            share = ((part[:, 0] if di else 1.0 - part[:, 0])
                     * (part[:, 1] if dj else 1.0 - part[:, 1]))
            there = np.flatnonzero((i >= 0) & (i < index.nx) & (j >= 0) & (j < index.ny) & (share > 0.0))
            cell, share = j[there] * index.nx + i[there], share[there]
            for name, plane in planes.items():
                out[name][there] += share * plane.ravel()[cell]
    return out


def _weigh(group, weight):
    """Write a weight per vertex, vertices of one level together."""
    level = np.clip(np.round(weight * LEVELS), 0, LEVELS).astype(np.int32)
    order = np.argsort(level, kind="stable")
    edges = np.flatnonzero(np.diff(level[order])) + 1
    for block in np.split(order, edges):
        if len(block) and level[block[0]] > 0:
            group.add(block.tolist(), float(level[block[0]]) / LEVELS, "REPLACE")
