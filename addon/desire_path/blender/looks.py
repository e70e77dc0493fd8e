"""looks.py - node groups that show a ground as what it is made of, for Cycles and EEVEE.

    attribute `desire_path`, see playback.py --> compression, heap --\\
    shares of painted soils, see materials.py                         +--> colour, roughness, grain --> one shader
    place on the ground [m]                                        --/

Each look is a group of its own, and one group for a ground mixes those it needs: nobody's shader has to be rewired
to use them. Grain is a bump, since it is finer than any cell. Numbers are metres unless they are shares.
"""

from dataclasses import dataclass, field

import bpy

from . import compat, look_soils, playback_tree, wiring

TAG = "desire_path_look"  # custom property on node groups and materials that are ours: what they are made for
SHARE = "desire_path_share_{}"  # float attribute of a painted soil, sum of all at most 1
VERSION = 6  # of the groups: an old one in a file is left to its users
FRAYED = 34.0  # lumps in a metre at the border of two soils
OUTPUTS = {
    "Color": "NodeSocketColor",
    "Roughness": "NodeSocketFloat",
    "Specular": "NodeSocketFloat",
    "Subsurface": "NodeSocketFloat",
    "Height": "NodeSocketFloat",
}


class Shade(wiring.Wiring):
    """Nodes of a shader in a row."""

    def noise(self, at, scale, detail=2.0, rough=0.5):
        """Noise 0..1 with so many bumps in a metre."""
        node = self.add("ShaderNodeTexNoise", Vector=at, Scale=scale, Detail=detail, Roughness=rough)
        return node.outputs[0]

    def crumbs(self, at, scale):
        """Round lumps side by side, so many in a metre: 0 between them, up to 1 on top of the largest."""
        node = self.add("ShaderNodeTexVoronoi", Vector=at, Scale=scale)
        size = self.split(node.outputs[1])[0]  # by chance
        # where lumps meet they end: a step from one to another would be a scratch
        edge = self.add("ShaderNodeTexVoronoi", {"feature": "DISTANCE_TO_EDGE"}, Vector=at, Scale=scale)
        round_so = self.between(node.outputs[0], 0.0, 0.7, 1.0, 0.0)
        ends = self.between(compat.socket(edge.outputs, "Distance"), 0.0, 0.2)
        return self.math("MULTIPLY", self.math("MULTIPLY", round_so, ends), self.math("POWER", size, 1.6))

    def plates(self, at, wide, gap):
        """Ground that has cracked into plates so wide, with gaps half of which are up to so wide [m].

        Returns (1 in a gap and 0 beside it, how high the plates stand that lie askew: about zero, by their width)
        """
        stray = self.add("ShaderNodeTexNoise", Vector=at, Scale=2.2 / wide, Detail=3.0, Roughness=0.6).outputs[1]
        stray = self.vector("SUBTRACT", stray, (0.5, 0.5, 0.5))
        at = self.vector("MULTIPLY_ADD", stray, (0.5 * wide,) * 3, at)
        inside = self.add("ShaderNodeTexVoronoi", Vector=at, Scale=1.0 / wide).outputs
        edge = self.add("ShaderNodeTexVoronoi", {"feature": "DISTANCE_TO_EDGE"}, Vector=at, Scale=1.0 / wide)
        edge = self.math("MULTIPLY", compat.socket(edge.outputs, "Distance"), wide)
        open_so = self.between(self.noise(at, 0.6 / wide, 1.0), 0.42, 0.68, 0.0, gap)
        askew = self.vector("SUBTRACT", inside[1], (0.5, 0.5, 0.5))
        away = self.vector("SUBTRACT", at, compat.socket(inside, "Position"))
        high = self.math("MULTIPLY", self.vector("DOT_PRODUCT", askew, away), 1.0 / wide)
        gaps = self.between(self.math("DIVIDE", edge, self.math("MAXIMUM", open_so, 1e-5)), 0.4, 1.0, 1.0, 0.0)
        return gaps, high

    def mix(self, share, first, last):
        """Colours; numbers by `blend`."""
        return self.add("ShaderNodeMixRGB", _0=share, _1=first, _2=last).outputs[0]

    def blend(self, share, first, last):
        return self.math("MULTIPLY_ADD", share, self.math("SUBTRACT", last, first), first)

    def sum(self, *parts):
        """Sum of (how high, noise 0..1), each about zero."""
        total = 0.0
        for high, noise in parts:
            total = self.math("MULTIPLY_ADD", self.math("SUBTRACT", noise, 0.5), high, total)
        return total


@dataclass(frozen=True)
class Recipe:
    """What a ground is made of, as far as it can be seen."""

    base: tuple  # (look, wetness)
    painted: tuple = ()  # (attribute of its share, look, wetness) of each soil that is painted
    floor: str = ""  # grass between: "plants" as they stand, "trodden" all over but where the ground was pressed
    scale: tuple = (1.0, 1.0, 1.0)  # metres in a unit of the object along its axes
    unit: float = 1.0  # metres in a unit of the scene
    lain: tuple = field(default=(), repr=False)  # the same of layers, from the lowest up: each hides that share
    seen: tuple = field(default=(), repr=False)  # the same of all soils, as a bake tells what is seen in the end

    def mark(self):
        """A word that tells it from others."""
        return f"{VERSION} {self!r}" + (f" {self.lain!r} {self.seen!r}" if self.seen else "")


def _group(name, mark, inputs, outputs):
    """(a new group of shader nodes, its Shade, its node of inputs, its node of outputs)."""
    tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
    tree[TAG] = mark
    for socket, (kind, value, low, high) in inputs.items():
        item = compat.group_socket(tree, "INPUT", kind, socket)
        if value is not None:
            item.default_value = value
        if low is not None:
            item.min_value, item.max_value = low, high
    for socket, kind in outputs.items():
        compat.group_socket(tree, "OUTPUT", kind, socket)
    n = Shade(tree)
    return tree, n, n.add("NodeGroupInput").outputs, tree.nodes.new("NodeGroupOutput")


def _known(mark):
    """The group of this file that was made for the same."""
    return next((each for each in bpy.data.node_groups if each.library is None and each.get(TAG) == mark), None)


def _leave(n, leave, values):
    """Give values by name to a group's outputs."""
    leave.location = (180 * n.column, 0)
    for name, value in values.items():
        if isinstance(value, bpy.types.NodeSocket):
            n.tree.links.new(value, leave.inputs[name])
        else:
            leave.inputs[name].default_value = value


def look(name):
    """The group of a look; inputs Position, Compression, Heap, Wetness, outputs OUTPUTS."""
    label, make = look_soils.LOOKS[name]
    mark = f"{name} {VERSION}"
    tree = _known(mark)
    if tree is not None:
        return tree
    number = "NodeSocketFloat"
    inputs = {
        "Position": ("NodeSocketVector", None, None, None),
        "Compression": (number, 0.0, None, None),
        "Heap": (number, 0.0, None, None),
        "Wetness": (number, 0.0, 0.0, 1.0),
    }
    tree, n, given, leave = _group(f"Desire Path {label}", mark, inputs, OUTPUTS)
    results = make(n, look_soils.Spot(*(given[each] for each in inputs)))
    _leave(n, leave, dict(zip(OUTPUTS, results)))
    return tree


def ground(recipe, name):
    """The group that shows a whole ground."""
    mark = recipe.mark()
    tree = _known(mark)
    if tree is not None:
        return tree
    number = "NodeSocketFloat"
    inputs = {
        "Wetness": (number, 0.0, 0.0, 1.0),
        "Grain": (number, 1.0, 0.0, 10.0),
        "Tint": ("NodeSocketColor", (1.0, 1.0, 1.0, 1.0), None, None),
    }
    shown = {"Shader": "NodeSocketShader", **OUTPUTS, "Normal": "NodeSocketVector"}
    marks = dict.fromkeys(("Pressed", "Loose", "Disturbed"), number)
    tree, n, given, leave = _group(name, mark, inputs, {**shown, **marks})
    place = n.add("ShaderNodeTexCoord").outputs["Object"]
    place = n.vector("MULTIPLY", place, recipe.scale)
    baked = n.add("ShaderNodeSeparateColor", Color=_attribute(n, playback_tree.ATTRIBUTE, 0)).outputs
    compression = baked[2]
    heap = n.math("MAXIMUM", n.math("ADD", baked[0], compression), 0.0)
    spot = look_soils.Spot(place, compression, heap, given["Wetness"])
    values = _trodden(n, recipe, spot, _mixed(n, recipe, spot))
    _flooded(n, values)
    values["Color"] = n.add(
        "ShaderNodeMixRGB", {"blend_type": "MULTIPLY"}, _0=1.0, _1=values["Color"], _2=given["Tint"]
    ).outputs[0]
    # the mesh has the lumps of walls: a bump on top turns their light into streaks
    upward = n.split(n.add("ShaderNodeNewGeometry").outputs["True Normal"])[2]
    level = n.between(upward, 0.15, 0.7, 0.1, 1.0)
    high = n.math("MULTIPLY", n.math("MULTIPLY", values["Height"], given["Grain"]), 1.0 / recipe.unit)
    high = n.math("MULTIPLY", high, level)
    values["Normal"] = n.add("ShaderNodeBump", Height=high, Distance=1.0, Strength=1.0).outputs[0]
    values["Shader"] = _shader(n, values, recipe.unit)
    values["Pressed"], values["Loose"] = look_soils.pressed_so(n, spot, 0.01), look_soils.loose_there(n, spot)
    values["Disturbed"] = n.between(n.math("MAXIMUM", compression, heap), 0.0003, 0.003)
    _leave(n, leave, values)
    return tree


def _attribute(n, name, output):
    return n.add("ShaderNodeAttribute", {"attribute_name": name}).outputs[output]


def _mixed(n, recipe, spot):
    """Outputs of the looks of a ground, by the shares of its soils."""
    fray = n.noise(spot.at, FRAYED, 3.0, 0.6) if recipe.painted or recipe.floor else None
    values, so_far = _look(n, *recipe.base, spot), None
    for name, *its in recipe.painted:
        share = _attribute(n, name, 2)
        before = n.math("SUBTRACT", 1.0, _painted(n, recipe)) if so_far is None else so_far
        so_far = n.math("ADD", before, share)
        part = n.math("DIVIDE", share, n.math("MAXIMUM", so_far, 1e-6))
        values = _over(n, _frayed(n, part, fray), values, _look(n, *its, spot))
    if recipe.floor:
        if recipe.floor == "plants":
            stands = n.between(_attribute(n, playback_tree.STRENGTH, 2), 0.02, 0.55)
        else:
            stands = n.math("SUBTRACT", 1.0, look_soils.pressed_so(n, spot, 0.006))
        values = _over(n, _frayed(n, stands, fray), values, _look(n, "GRASS", 0.0, spot))
    return values


def _trodden(n, recipe, spot, values):
    """The same with the layers that lie on it, and as what was left on it, or shows in prints, makes it."""
    if not recipe.seen:
        return values
    fray = n.noise(spot.at, FRAYED, 3.0, 0.6)
    for name, *its in recipe.lain:
        values = _over(n, _frayed(n, _attribute(n, name, 2), fray), values, _look(n, *its, spot))
    known, after = 0.0, None
    for name, *its in recipe.seen:
        share = _attribute(n, name, 2)
        known = n.math("ADD", known, share)
        its = _look(n, *its, spot)
        part = n.math("DIVIDE", share, n.math("MAXIMUM", known, 1e-6))
        after = its if after is None else _over(n, _flecked(n, part, fray), after, its)
    moved = n.math("MULTIPLY", n.math("MINIMUM", known, 1.0), _attribute(n, playback_tree.PROGRESS, 2))
    return _over(n, moved, values, after)


def _flooded(n, values):
    """Where water stands it is turbid, smooth and level."""
    water = n.between(_attribute(n, playback_tree.WATER, 2), 0.0, playback_tree.SHALLOW)
    values["Color"] = n.mix(n.math("MULTIPLY", water, 0.8), values["Color"], (0.060, 0.042, 0.027, 1.0))
    values["Roughness"] = n.blend(water, values["Roughness"], 0.03)
    values["Specular"] = n.blend(water, values["Specular"], 0.5)
    dry = n.math("SUBTRACT", 1.0, water)
    values["Subsurface"], values["Height"] = (
        n.math("MULTIPLY", values[each], dry) for each in ("Subsurface", "Height")
    )


def _painted(n, recipe):
    """Sum of the shares of all painted soils."""
    total = 0.0
    for name, *_ in recipe.painted:
        total = n.math("ADD", total, _attribute(n, name, 2))
    return n.math("MINIMUM", total, 1.0)


def _look(n, name, wetness, spot):
    """Outputs of one look by name."""
    wet = spot.wet
    if wetness:
        wet = n.math("MAXIMUM", wet, wetness)
    node = n.add("ShaderNodeGroup", {"node_tree": look(name)})
    for socket, value in (("Position", spot.at), ("Compression", spot.compression), ("Heap", spot.heap)):
        n.tree.links.new(value, node.inputs[socket])
    n.tree.links.new(wet, node.inputs["Wetness"])
    return {each: node.outputs[each] for each in OUTPUTS}


def _frayed(n, share, fray):
    """A share whose border follows lumps of the ground; all and nothing stay."""
    border = n.math("MULTIPLY", share, n.math("SUBTRACT", 1.0, share))
    moved = n.math("MULTIPLY_ADD", n.math("MULTIPLY", border, 2.5), n.math("SUBTRACT", fray, 0.5), share)
    return n.between(moved, 0.40, 0.60)


def _flecked(n, share, fray):
    """A share as flecks, of which there are more the larger it is; all and nothing stay."""
    border = n.math("MULTIPLY", share, n.math("SUBTRACT", 1.0, share))
    moved = n.math("MULTIPLY_ADD", n.math("MULTIPLY", border, 5.0), n.math("SUBTRACT", fray, 0.5), share)
    return n.between(moved, 0.25, 0.75)


def _over(n, share, below, above):
    return {
        name: n.mix(share, below[name], above[name]) if name == "Color" else n.blend(share, below[name], above[name])
        for name in OUTPUTS
    }


def _shader(n, values, unit):
    """The one shader; its inputs go by other names in later Blenders, and those it has not are left out."""
    inside = tuple(each / unit for each in (0.0055, 0.0075, 0.0100))  # blue light goes deepest into snow [units]
    inputs = {
        "Base Color": values["Color"],
        "Roughness": values["Roughness"],
        "Normal": values["Normal"],
        "Specular": values["Specular"],
        "Specular IOR Level": values["Specular"],
        "Subsurface": values["Subsurface"],
        "Subsurface Weight": values["Subsurface"],
        "Subsurface Color": values["Color"],
        "Subsurface Radius": inside,
        "Subsurface Scale": 1.0,
    }
    return n.add("ShaderNodeBsdfPrincipled", **inputs).outputs[0]
