"""tree_numbers.py - node trees that are alike but for their numbers.

A tree that plays another bake of the same ground is that of before with other numbers: it stays, and takes them.
"""

import bpy

from . import compat

FOREIGN = {"IMAGE", "OBJECT", "COLLECTION", "MATERIAL"}  # sockets that hold datablocks
CHANGED = ("interpolation",)  # settings that are changed as numbers are


def form(tree):
    """The nodes of a tree, what is chosen on them, and their links, but no numbers."""
    common = {*bpy.types.Node.bl_rna.properties.keys(), *CHANGED}
    number = {node.name: k for k, node in enumerate(tree.nodes)}
    nodes = [
        (
            node.bl_idname,
            *(
                (each.identifier, str(getattr(node, each.identifier)))
                for each in node.bl_rna.properties
                if each.type in {"ENUM", "BOOLEAN"} and each.identifier not in common
            ),
        )
        for node in tree.nodes
    ]
    links = {
        (number[each.from_node.name], each.from_socket.identifier, number[each.to_node.name], each.to_socket.identifier)
        for each in tree.links
    }
    return nodes, links


def held(tree):
    """The datablocks that the nodes of a tree hold, in their order."""
    return [
        socket.default_value
        for node in tree.nodes
        for socket in node.inputs
        if socket.type in FOREIGN and hasattr(socket, "default_value")
    ]


def copy(source, target):
    """Give a tree the numbers and words of another one of the same form; datablocks stay as they are."""
    for node, other in zip(target.nodes, source.nodes):
        for name in CHANGED:
            if getattr(node, name, None) != getattr(other, name, None):
                setattr(node, name, getattr(other, name))
        for socket, wanted in zip(node.inputs, other.inputs):
            if hasattr(socket, "default_value") and socket.type not in FOREIGN:
                compat.set_default(socket, wanted.default_value)
