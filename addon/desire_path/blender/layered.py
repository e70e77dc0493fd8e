"""layered.py - the layers of a ground as a bake takes them."""

import numpy as np

from ..errors import DesirePathError
from ..ground.layers import Layer, checked
from ..ground.soil_keys import SoilKeys
from . import soil_keys


def of_ground(obj):
    """(Layer, vertex group, empty = it lies everywhere) from the top down; a sentence where they cannot lie there."""
    found, layers = [], obj.desire_path.layers
    for each, (soil, thickness) in zip(layers, soil_keys.laid(obj) if layers else ()):
        if each.group and each.group not in obj.vertex_groups:
            raise DesirePathError(
                f"'{obj.name}' has no vertex group '{each.group}' by which a layer lies: choose another group, or none."
            )
        found.append((Layer(soil, thickness), each.group))
    for (one, _), (other, _) in zip(found, found[1:]):
        if one.soil == other.soil:
            raise DesirePathError(
                f"Two layers of one soil lie on each other on '{obj.name}': remove one, and make the other thicker."
            )
    checked([layer for layer, _ in found], ("mesh",))
    return found


def groups(found):
    """The vertex groups that layers lie by, each once."""
    return list(dict.fromkeys(group for _, group in found if group))


def laid(ground, found, weights):
    """A Ground with layers as of_ground() has them. weights: of groups(found) at its points, None = 0 all over"""
    if not found:
        return ground
    count = len(ground.native[1])
    share = {
        group: np.zeros(count, np.float32) if weight is None else np.clip(weight, 0.0, 1.0)
        for group, weight in zip(groups(found), weights)
    }
    return ground.layered(*(Layer(each.soil, each.thickness, share.get(group)) for each, group in found))


def parameters(obj):
    """The numbers that tell the layers of a ground from others."""
    return [[layer.soil.parameters(), layer.thickness, group != ""] for layer, group in of_ground(obj)]


def above(obj):
    """How thick all layers are together where they are thickest [m]."""
    return sum(layer.thickness for layer, _ in of_ground(obj))


def check_keys(scene, obj, own, first, last):
    """Refuse soils that change over time below layers, and layers that do. own: soils of the ground"""
    if obj.desire_path.layers and any(isinstance(each, SoilKeys) for each in own):
        raise DesirePathError(
            f"The soil of '{obj.name}' has keys, which ground in layers does not take: remove the keys, or the layers."
        )
    if obj.desire_path.layers and soil_keys.change_layers(scene, obj, first, last):
        raise DesirePathError(
            f"The layers of '{obj.name}' change between frames {first} and {last}, by keys or drivers, which layers do "
            "not take: remove or mute these."
        )
