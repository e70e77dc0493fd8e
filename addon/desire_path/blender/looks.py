"""looks.py - node groups that show a ground as what it is made of, for Cycles and EEVEE.

    attribute `desire_path`, see playback.py --> compression, heap --\\
    shares of painted soils, see materials.py                         +--> colour, roughness, grain --> one shader
    place on the ground [m]                                        --/

Each look is a group of its own, and one group for a ground mixes those it needs: nobody's shader has to be rewired
to use them. Grain is a bump, since it is finer than any cell. Numbers are metres unless they are shares.
"""

from dataclasses import dataclass, field

import bpy

from . import compat, playback_tree, wiring

TAG = "desire_path_look"  # custom property on node groups and materials that are ours: what they are made for
SHARE = "desire_path_share_{}"  # float attribute of a painted soil, sum of all at most 1
VERSION = 4  # of the groups: an old one in a file is left to its users
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
        return self.math("MULTIPLY", self.between(node.outputs[0], 0.0, 0.7, 1.0, 0.0), self.math("POWER", size, 1.6))

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
class Spot:
    """A place on a ground, as sockets."""

    at: object  # where it is on the ground, vector [m]
    compression: object  # pressed below the first height [m]
    heap: object  # loose soil piled above it [m]
    wet: object  # share


def _pressed(n, spot, deep):
    """1 where the ground was pressed so deep and nothing loose lies on it, 0 where it was not."""
    bare = n.between(spot.heap, 0.0005, 0.004, 1.0, 0.0)
    return n.math("MULTIPLY", n.between(spot.compression, 0.06 * deep, deep), bare)


def _loose(n, spot):
    """1 where loose soil lies on the ground."""
    return n.between(spot.heap, 0.0004, 0.005)


def _wetted(n, wet, colour, rough, specular, shine=0.38):
    """A look as it is when it is wet: darker, and it shines."""
    dark = n.math("MULTIPLY_ADD", wet, -0.55, 1.0)
    colour = n.vector("SCALE", colour, scale=dark)
    return colour, n.blend(wet, rough, shine), n.blend(wet, specular, 0.5)


def _sand(n, spot):
    """Grains of many colours; what was below the surface is a little damp."""
    grain, single = n.noise(spot.at, 620.0, 1.0, 0.6), n.noise(spot.at, 1900.0, 0.0)
    wide, lumps = n.noise(spot.at, 2.3, 2.0), n.noise(spot.at, 120.0, 2.0, 0.6)
    pressed = _pressed(n, spot, 0.012)
    colour = n.mix(n.between(grain, 0.35, 0.68), (0.40, 0.27, 0.15, 1.0), (0.58, 0.43, 0.27, 1.0))
    colour = n.mix(n.between(single, 0.60, 0.72, 0.0, 0.5), colour, (0.20, 0.12, 0.065, 1.0))
    colour = n.mix(n.between(wide, 0.35, 0.7, 0.0, 0.35), colour, (0.38, 0.25, 0.135, 1.0))
    colour = n.mix(n.math("MULTIPLY", pressed, 0.42), colour, (0.21, 0.128, 0.066, 1.0))
    colour, rough, specular = _wetted(n, spot.wet, colour, 0.95, 0.12, 0.5)
    flat = n.math("MULTIPLY_ADD", pressed, -0.6, 1.0)
    height = n.sum((n.math("MULTIPLY", flat, 0.0009), grain), (n.math("MULTIPLY", flat, 0.0013), lumps))
    return colour, rough, specular, 0.0, height


def _snow(n, spot):
    """White, light goes a little into it; pressed it is denser, smoother and bluer."""
    grain, lumps = n.noise(spot.at, 520.0, 1.0, 0.6), n.noise(spot.at, 70.0, 3.0, 0.55)
    crumbs, pressed, loose = n.noise(spot.at, 190.0, 1.0), _pressed(n, spot, 0.03), _loose(n, spot)
    colour = n.mix(n.between(lumps, 0.3, 0.75, 0.0, 0.6), (0.86, 0.88, 0.91, 1.0), (0.79, 0.83, 0.88, 1.0))
    colour = n.mix(n.math("MULTIPLY", pressed, 0.55), colour, (0.62, 0.71, 0.80, 1.0))
    colour, rough, specular = _wetted(n, n.math("MULTIPLY", spot.wet, 0.3), colour, 0.75, 0.25)
    rough = n.blend(pressed, rough, 0.48)
    flat = n.math("MULTIPLY_ADD", pressed, -0.5, 1.0)
    height = n.sum(
        (n.math("MULTIPLY", flat, 0.0006), grain),
        (n.math("MULTIPLY", flat, 0.0034), lumps),
        (n.math("MULTIPLY", loose, 0.0035), crumbs),
    )
    return colour, rough, specular, n.math("MULTIPLY_ADD", pressed, -0.15, 0.45), height


def _mud(n, spot):
    """Damp lumps; a foot brings the water up, and leaves it smooth."""
    lumps, fine = n.noise(spot.at, 38.0, 3.0, 0.5), n.noise(spot.at, 210.0, 2.0, 0.55)
    wide, pressed, loose = n.noise(spot.at, 2.6, 2.0), _pressed(n, spot, 0.010), _loose(n, spot)
    colour = n.mix(n.between(lumps, 0.35, 0.7), (0.088, 0.054, 0.031, 1.0), (0.150, 0.098, 0.059, 1.0))
    colour = n.mix(n.between(fine, 0.55, 0.68, 0.0, 0.35), colour, (0.190, 0.130, 0.082, 1.0))
    colour = n.mix(n.between(wide, 0.4, 0.68, 0.0, 0.5), colour, (0.062, 0.039, 0.023, 1.0))
    wet = n.math("MAXIMUM", spot.wet, n.math("MULTIPLY", pressed, n.between(lumps, 0.25, 0.55, 0.7, 1.0)))
    wet = n.math("MAXIMUM", wet, n.between(wide, 0.5, 0.68, 0.0, 0.6))
    colour, rough, specular = _wetted(n, wet, colour, 0.62, 0.3, 0.27)
    flat = n.math("MULTIPLY_ADD", pressed, -0.86, 1.0)
    height = n.sum(
        (n.math("MULTIPLY", flat, 0.0065), lumps),
        (n.math("MULTIPLY", flat, 0.0016), fine),
        (n.math("MULTIPLY", loose, 0.0040), lumps),
    )
    return colour, rough, specular, 0.0, height


def _earth(n, spot):
    """Crumbs of dark earth, trodden flat and darker where feet went."""
    clods, crumbs = n.crumbs(spot.at, 42.0), n.crumbs(spot.at, 130.0)
    lumps, grain = n.noise(spot.at, 30.0, 4.0, 0.6), n.noise(spot.at, 420.0, 3.0, 0.65)
    wide, pressed, loose = n.noise(spot.at, 1.7, 2.0), _pressed(n, spot, 0.005), _loose(n, spot)
    colour = n.mix(n.between(grain, 0.3, 0.7), (0.150, 0.108, 0.070, 1.0), (0.262, 0.196, 0.132, 1.0))
    colour = n.mix(n.between(lumps, 0.35, 0.65, 0.45, 0.0), colour, (0.120, 0.084, 0.053, 1.0))
    colour = n.mix(n.between(wide, 0.4, 0.65, 0.0, 0.4), colour, (0.150, 0.112, 0.074, 1.0))
    colour = n.mix(n.math("MULTIPLY", loose, 0.5), colour, (0.120, 0.080, 0.048, 1.0))
    colour = n.mix(n.math("MULTIPLY", pressed, 0.6), colour, (0.100, 0.068, 0.042, 1.0))
    colour, rough, specular = _wetted(n, spot.wet, colour, 0.92, 0.1)
    rough = n.blend(n.math("MULTIPLY", pressed, spot.wet), rough, 0.3)
    flat = n.math("MULTIPLY_ADD", pressed, -0.8, 1.0)
    height = n.sum(
        (n.math("MULTIPLY", flat, 0.0060), lumps),
        (n.math("MULTIPLY", flat, 0.0040), clods),
        (n.math("MULTIPLY", flat, n.math("MULTIPLY_ADD", loose, 0.0018, 0.0020)), crumbs),
        (n.math("MULTIPLY_ADD", flat, 0.0009, 0.0003), grain),
    )
    return colour, rough, specular, 0.0, height


def _grass(n, spot):
    """The floor of a meadow, seen between its stems: moss, dead leaves, low green."""
    blades, leaves = n.noise(n.vector("MULTIPLY", spot.at, (1.0, 2.6, 1.0)), 130.0, 3.0, 0.65), n.noise(spot.at, 48.0)
    wide = n.noise(spot.at, 1.3, 2.0)
    colour = n.mix(n.between(blades, 0.34, 0.66), (0.020, 0.030, 0.009, 1.0), (0.072, 0.098, 0.028, 1.0))
    colour = n.mix(n.between(leaves, 0.52, 0.64, 0.0, 0.75), colour, (0.150, 0.112, 0.058, 1.0))
    colour = n.mix(n.between(wide, 0.4, 0.66, 0.0, 0.4), colour, (0.088, 0.092, 0.034, 1.0))
    colour, rough, specular = _wetted(n, spot.wet, colour, 0.85, 0.2)
    return colour, rough, specular, 0.0, n.sum((0.0075, blades), (0.0045, leaves))


LOOKS = {  # name -> (what it is called, how it is made)
    "SAND": ("Sand", _sand),
    "SNOW": ("Snow", _snow),
    "MUD": ("Mud", _mud),
    "EARTH": ("Earth", _earth),
    "GRASS": ("Grass Floor", _grass),
}


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
    label, make = LOOKS[name]
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
    results = make(n, Spot(*(given[each] for each in inputs)))
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
    spot = Spot(place, compression, heap, given["Wetness"])
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
    values["Pressed"], values["Loose"] = _pressed(n, spot, 0.01), _loose(n, spot)
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
            stands = n.math("SUBTRACT", 1.0, _pressed(n, spot, 0.006))
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
