"""strengths.py - how strongly a bake is shown: inputs of our modifier, which keys and drivers may move.

    Prints           1 = as deep as they are, 0 = none         they are plain numbers of a nodes modifier, so that
    Rims             1 = as high as they are, 0 = none         they work in renders and without this add-on
    Material Index   slot of the faces that were pressed, -1 = as they are

A bake that takes the place of another one leaves them as they are, with their keys and drivers.
"""

from dataclasses import dataclass

import bpy

from . import compat

TRODDEN = 1e-5  # ground that was changed by more than this takes the material [m]


@dataclass(frozen=True)
class Input:
    """One of them."""

    name: str
    socket: str
    value: float
    low: float
    high: float
    words: str


INPUTS = (
    Input("Prints", "NodeSocketFloat", 1.0, 0.0, 100.0, "How deep prints are shown: 1 = as they are, 0 = none"),
    Input("Rims", "NodeSocketFloat", 1.0, 0.0, 100.0, "How high rims and heaps are shown: 1 = as they are, 0 = none"),
    Input(
        "Material Index",
        "NodeSocketInt",
        -1,
        -1,
        32767,
        "The material slot of faces that were pressed or heaped on; -1 = as they are",
    ),
)


def declare(tree):
    """Give a tree the inputs."""
    for each in INPUTS:
        socket = compat.tree_input(tree, each.name, each.socket)
        socket.default_value, socket.min_value, socket.max_value = each.value, each.low, each.high
        if hasattr(socket, "description"):
            socket.description = each.words


def declared(tree):
    """Whether a tree has the inputs; those of earlier versions lack them."""
    return all(compat.input_identifier(tree, each.name) for each in INPUTS)


def rise(wire, entry, change, compression):
    """The field of how far the ground is shown above its first height: its change, and nothing worked out, where all
    inputs are 1.

    entry: the node of the tree's inputs; change, compression: fields [m]
    """
    prints, rims = (entry.outputs[each.name] for each in INPUTS[:2])
    heap = wire.math("MAXIMUM", wire.math("ADD", change, compression), 0.0)
    more = wire.math("MULTIPLY", heap, wire.math("SUBTRACT", rims, prints))
    scaled = wire.math("ADD", wire.math("MULTIPLY", change, prints), more)
    off = (wire.math("ABSOLUTE", wire.math("SUBTRACT", each, 1.0)) for each in (prints, rims))
    other = wire.math("GREATER_THAN", wire.math("MAXIMUM", *off), 0.0)
    return wire.switch("FLOAT", other, change, scaled)


def of_prints(wire, entry, field):
    """A field as strong as the prints are shown."""
    return wire.math("MULTIPLY", field, entry.outputs[INPUTS[0].name])


def painted(wire, entry, geometry, change, compression):
    """The geometry with another material where it was changed, if that is asked for; else nothing is worked out."""
    index = entry.outputs[INPUTS[2].name]
    trodden = wire.math("MAXIMUM", wire.math("ABSOLUTE", change), compression)
    other = wire.add(
        "GeometryNodeSetMaterialIndex",
        Geometry=geometry,
        Selection=wire.math("GREATER_THAN", trodden, TRODDEN),
        **{"Material Index": index},
    )
    return wire.switch("GEOMETRY", wire.math("GREATER_THAN", index, -0.5), geometry, other.outputs[0])


def values(modifier):
    """What is set on a modifier of ours, by the names of INPUTS, and those that are animated, as they are now."""
    found = {}
    for each in INPUTS:
        identifier = compat.input_identifier(modifier.node_group, each.name)
        if identifier:
            found[each.name] = compat.modifier_input(modifier, identifier)
    return found


def give(modifier, values):
    """Set them on a modifier of ours."""
    for name, value in values.items():
        compat.set_modifier_input(modifier, compat.input_identifier(modifier.node_group, name), value)


def path(modifier, name):
    """The data path of one of INPUTS, from the object, for keys and drivers."""
    identifier = compat.input_identifier(modifier.node_group, name)
    return start(modifier) + compat.input_path(modifier, identifier)


def start(modifier):
    """How data paths of a modifier begin."""
    return f'modifiers["{bpy.utils.escape_identifier(modifier.name)}"]'
