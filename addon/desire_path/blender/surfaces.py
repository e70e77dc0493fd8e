"""surfaces.py - which soil is seen of ground in layers, and of ground on which soil was left, as materials read it.

groups of layers --shares--> attributes: what lies on top before anybody walks
maps surface_<soil> ------> attributes of that name: what is seen in the end, MODEL 6.16, 6.17
playback_tree.PROGRESS: how much of the way from one to the other a place has gone in a frame
"""

import numpy as np

from ..ground import layers as grounds_layers
from ..ground import materials as names_of
from . import cover, ground, layered, looks, playback_tree

COVERS = 0.002  # so thick a layer hides what lies below, MODEL 6.17 [m]
MARKS = 0.01  # what hides the ground is as fine in the copy as prints that are so deep [m]


def share_name(place):
    """The attribute of how much a layer is seen before anybody walks."""
    return looks.SHARE.format(f"layer_{place + 1}")


def shares(obj):
    """Of each layer how much it hides what lies below it, by attribute, float32 (n,)."""
    count, found = len(obj.data.vertices), {}
    for place, each in enumerate(obj.desire_path.layers):
        weight = cover.group_weights(obj, each.group) if each.group else np.ones(count, np.float32)
        weight = np.zeros(count, np.float32) if weight is None else weight
        found[share_name(place)] = np.clip(weight * each.thickness / COVERS, 0.0, 1.0).astype(np.float32)
    return found


def looked(obj, look):
    """(lain, seen) of a looks.Recipe. look: (look, wetness) of a ground's settings, a painted soil or a layer"""
    settings = obj.desire_path
    lie = [(share_name(place), *look(each)) for place, each in enumerate(settings.layers)]
    laid = [layer for layer, _ in layered.of_ground(obj)]
    soils, its = ground.soils(obj), [settings, *settings.painted]
    lain = grounds_layers.lain(("flat", 0.0), soils, laid)
    if not names_of.fields(lain, len(laid)):
        return (), ()
    first = {}
    for soil, each in zip([*(layer.soil for layer in laid), *soils], [*settings.layers, *its]):
        first.setdefault(soil, look(each))
    called = names_of.names(lain.soils)
    seen = [(f"surface_{name}", *first[soil]) for name, soil in zip(called, lain.soils)]
    return tuple(reversed(lie)), tuple(seen)


def with_progress(planes):
    """The planes of a bake, and how much was moved in each cell where something else is seen than before [m]."""
    if not any(name.startswith(cover.MORE[0]) for name in planes):
        return planes
    return {**planes, playback_tree.MOVED: planes["heap"] + planes["compression"] + coats(planes)}


def coats(planes):
    """Thickness of all that soles have left, 0 where nothing was [m]."""
    return sum(
        (plane for name, plane in planes.items() if name.startswith(cover.MORE[1])), np.zeros_like(planes["heap"])
    )


def shape(planes):
    """How high the ground is seen, with what soles have left as if it were a print [m]."""
    lies = coats(planes)
    return planes["heap"] - planes["compression"] + lies + MARKS * np.minimum(lies / COVERS, 1.0)
