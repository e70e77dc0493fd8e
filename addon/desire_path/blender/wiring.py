"""wiring.py - nodes of a tree, put down and linked one after the other."""

import bpy

from . import compat

BETWEEN = ("Closest", "Linear")  # what is shown between cells


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

    def switch(self, kind, condition, no, yes):
        """`yes` where a condition holds, else `no`; if it is a plain number, the other of the two is not worked out."""
        node = self.add("GeometryNodeSwitch", {"input_type": kind}, Switch=condition)
        for name, value in (("False", no), ("True", yes)):
            self.tree.links.new(value, compat.socket(node.inputs, name))
        return compat.socket(node.outputs, "Output")

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
