"""materials.py - what the demo is made of: three soils in one shader, cloth, skin, shoes.

The soils follow the painted groups through the colour attribute `soil` (red sand, green snow, blue
mud) and what was baked through the colour attribute `desire_path` (red height change, blue
compression), which the playback modifier stores at every frame.
"""

import bpy

SOIL = "soil"  # colour attribute of the ground: shares of sand, snow, mud
BAKED = "desire_path"  # colour attribute stored by the playback
DEEP = 0.030  # compression at which the ground looks fully pressed [m]
HIGH = 0.010  # heap at which the ground looks fully turned [m]


class _Nodes:
    """A shader tree by function calls: every call makes one node and returns its output."""

    def __init__(self, material):
        material.use_nodes = True
        self.tree = material.node_tree
        self.tree.nodes.clear()
        self.made = 0

    def new(self, kind, inputs=(), **settings):
        node = self.tree.nodes.new(kind)
        node.location = (200 * (self.made % 12), -220 * (self.made // 12))
        self.made += 1
        for name, value in settings.items():
            setattr(node, name, value)
        for name, value in dict(inputs).items():
            if value is None:
                continue
            target = node.inputs[name]
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, target)
            else:
                target.default_value = value
        return node

    def attribute(self, name):
        return self.new("ShaderNodeAttribute", attribute_name=name).outputs["Color"]

    def split(self, colour):
        return self.new("ShaderNodeSeparateColor", {"Color": colour}).outputs

    def math(self, operation, a, b=0.0, clamp=False):
        return self.new("ShaderNodeMath", {0: a, 1: b}, operation=operation, use_clamp=clamp).outputs[0]

    def between(self, value, low, high, a=0.0, b=1.0):
        """a below `low`, b above `high`, a smooth step between."""
        node = self.new(
            "ShaderNodeMapRange",
            {"Value": value, "From Min": low, "From Max": high, "To Min": a, "To Max": b},
            interpolation_type="SMOOTHSTEP",
        )
        return node.outputs["Result"]

    def noise(self, at, scale, detail=2.0, rough=0.5):
        node = self.new("ShaderNodeTexNoise", {"Vector": at, "Scale": scale, "Detail": detail, "Roughness": rough})
        return node.outputs["Fac"]

    def mix(self, share, a, b):
        """Colours or numbers."""
        if isinstance(a, (float, int)) or getattr(a, "type", "") == "VALUE":
            more = self.math("MULTIPLY", share, self.math("SUBTRACT", b, a))
            return self.math("ADD", more, a)
        node = self.new("ShaderNodeMixRGB", {"Fac": share, "Color1": a, "Color2": b})
        return node.outputs["Color"]


def ground():
    """Sand, snow and mud by their shares; pressed ground is darker, heaps are crumbly."""
    material = bpy.data.materials.new("Soils")
    n = _Nodes(material)
    at = n.new("ShaderNodeNewGeometry").outputs["Position"]
    shares = n.split(n.attribute(SOIL))
    baked = n.split(n.attribute(BAKED))
    pressed = n.between(baked["Blue"], 0.002, DEEP)
    heap = n.between(n.math("ADD", baked["Red"], baked["Blue"]), 0.0015, HIGH)

    lumps = n.noise(at, 26.0, 3.0, 0.6)  # a few centimetres
    grain = n.noise(at, 420.0, 1.0, 0.6)  # a few millimetres
    clods = n.noise(at, 95.0, 1.0, 0.55)  # a centimetre
    wide = n.noise(at, 2.3, 2.0)
    # the border between soils is frayed, the thin snow there lets the ground through
    fray = n.math(
        "ADD",
        n.math("MULTIPLY", n.math("SUBTRACT", lumps, 0.5), 1.5),
        n.math("MULTIPLY", n.math("SUBTRACT", grain, 0.5), 0.8),
    )
    snow = n.between(n.math("ADD", shares["Green"], fray), 0.38, 0.62)
    below = n.math("ADD", n.math("SUBTRACT", shares["Blue"], shares["Red"]), fray)
    mud = n.math("MULTIPLY", n.between(below, -0.12, 0.12), n.math("SUBTRACT", 1.0, snow))

    # colours, dry and pressed
    spot = n.between(grain, 0.35, 0.7)
    sand_dry = n.mix(spot, (0.42, 0.27, 0.135, 1), (0.62, 0.44, 0.25, 1))
    sand_dry = n.mix(n.between(wide, 0.35, 0.7, 0.0, 0.35), sand_dry, (0.38, 0.235, 0.115, 1))
    sand = n.mix(n.math("MULTIPLY", pressed, 0.5), sand_dry, (0.25, 0.145, 0.068, 1))
    snow_dry = n.mix(n.between(lumps, 0.3, 0.75, 0.0, 0.5), (0.80, 0.82, 0.86, 1), (0.72, 0.76, 0.82, 1))
    snow_at = n.mix(n.math("MULTIPLY", pressed, 0.5), snow_dry, (0.62, 0.68, 0.75, 1))
    mud_dry = n.mix(n.between(clods, 0.35, 0.7), (0.085, 0.051, 0.030, 1), (0.150, 0.095, 0.057, 1))
    mud_dry = n.mix(n.between(wide, 0.42, 0.66, 0.0, 0.45), mud_dry, (0.066, 0.040, 0.023, 1))
    mud_at = n.mix(n.math("MULTIPLY", pressed, 0.7), mud_dry, (0.040, 0.023, 0.013, 1))
    colour = n.mix(mud, n.mix(snow, sand, snow_at), mud_at)

    # roughness: mud is damp, wet where it was pressed
    wet = n.math("MAXIMUM", pressed, n.between(wide, 0.46, 0.66, 0.0, 0.12))
    mud_rough = n.between(wet, 0.0, 1.0, 0.90, 0.62)
    roughness = n.mix(mud, n.mix(snow, 0.95, 0.60), mud_rough)
    specular = n.mix(mud, n.mix(snow, 0.10, 0.30), n.between(wet, 0.0, 1.0, 0.08, 0.09))

    # heights too small for the mesh [m]: how high the grain, the clods and the lumps are, by soil
    crumbs = n.math("MULTIPLY", heap, 0.0035)
    flat = n.math("SUBTRACT", 1.0, n.math("MULTIPLY", pressed, 0.78))
    grain_high = n.math("MULTIPLY", n.mix(shares["Green"], 0.0011, 0.0004), flat)
    clod_high = n.math("ADD", n.mix(shares["Blue"], n.mix(shares["Green"], 0.0010, 0.0018), 0.0060), crumbs)
    height = n.math(
        "ADD", n.math("MULTIPLY", grain, grain_high), n.math("MULTIPLY", clods, n.math("MULTIPLY", clod_high, flat))
    )
    bump = n.new("ShaderNodeBump", {"Height": height, "Distance": 1.0, "Strength": 0.9}).outputs[0]

    shader = n.new("ShaderNodeBsdfPrincipled", {"Base Color": colour, "Roughness": roughness, "Normal": bump})
    _set(shader, ("Specular", "Specular IOR Level"), specular)
    n.tree.links.new(shader.outputs[0], n.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def earth():
    """Dark earth with crumbs and dead leaves, bare and trodden smooth where plants were worn away."""
    material = bpy.data.materials.new("Earth")
    n = _Nodes(material)
    at = n.new("ShaderNodeNewGeometry").outputs["Position"]
    baked = n.split(n.attribute(BAKED))
    pressed = n.between(baked["Blue"], 0.001, 0.012)
    clods, grain, wide = n.noise(at, 60.0, 2.0, 0.6), n.noise(at, 300.0, 1.0, 0.6), n.noise(at, 1.7, 2.0)
    dry = n.mix(n.between(clods, 0.35, 0.68), (0.050, 0.033, 0.020, 1), (0.115, 0.080, 0.048, 1))
    dry = n.mix(n.between(grain, 0.56, 0.66, 0.0, 0.6), dry, (0.17, 0.125, 0.070, 1))
    dry = n.mix(n.between(wide, 0.4, 0.65, 0.0, 0.5), dry, (0.045, 0.040, 0.018, 1))
    # a trodden path is pale: fine dust on hard ground
    colour = n.mix(
        n.math("MULTIPLY", pressed, 0.75),
        dry,
        n.mix(n.between(grain, 0.35, 0.7), (0.150, 0.108, 0.070, 1), (0.235, 0.175, 0.115, 1)),
    )
    flat = n.math("SUBTRACT", 1.0, n.math("MULTIPLY", pressed, 0.7))
    high = n.math("MULTIPLY", n.math("ADD", n.math("MULTIPLY", clods, 0.006), n.math("MULTIPLY", grain, 0.0012)), flat)
    bump = n.new("ShaderNodeBump", {"Height": high, "Distance": 1.0, "Strength": 0.9}).outputs[0]
    shader = n.new("ShaderNodeBsdfPrincipled", {"Base Color": colour, "Roughness": 0.92, "Normal": bump})
    _set(shader, ("Specular", "Specular IOR Level"), 0.1)
    n.tree.links.new(shader.outputs[0], n.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def _set(shader, names, value):
    """The input goes by different names in different Blenders."""
    for name in names:
        if name in shader.inputs:
            target = shader.inputs[name]
            if isinstance(value, bpy.types.NodeSocket):
                value.id_data.links.new(value, target)
            else:
                target.default_value = value
            return


def plain(name, colour, roughness, weave=0.0):
    """One colour; weave: height of a fine cloth texture [m]."""
    material = bpy.data.materials.new(name)
    n = _Nodes(material)
    normal = None
    if weave:
        at = n.new("ShaderNodeTexCoord").outputs["Generated"]
        normal = n.new("ShaderNodeBump", {"Height": n.noise(at, 320.0), "Distance": weave}).outputs[0]
    shader = n.new("ShaderNodeBsdfPrincipled", {"Base Color": (*colour, 1), "Roughness": roughness, "Normal": normal})
    n.tree.links.new(shader.outputs[0], n.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def clothes():
    """Materials of the mannequin's slots: jacket, trousers, skin, uppers, outsoles."""
    return (
        plain("Jacket", (0.42, 0.055, 0.032), 0.80, 0.002),
        plain("Trousers", (0.040, 0.055, 0.090), 0.85, 0.002),
        plain("Skin", (0.46, 0.27, 0.18), 0.55),
        plain("Uppers", (0.085, 0.042, 0.020), 0.50),
        plain("Outsoles", (0.022, 0.020, 0.019), 0.70),
    )


def sky(scene, strength=0.55):
    """A hazy morning: pale low, blue above."""
    world = bpy.data.worlds.new("Morning")
    world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    way = tree.nodes.new("ShaderNodeTexCoord")
    split = tree.nodes.new("ShaderNodeSeparateXYZ")
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    light = tree.nodes.new("ShaderNodeBackground")
    out = tree.nodes.new("ShaderNodeOutputWorld")
    ramp.color_ramp.elements[0].color = (0.93, 0.76, 0.58, 1)
    ramp.color_ramp.elements[1].color = (0.40, 0.50, 0.66, 1)
    ramp.color_ramp.elements[1].position = 0.38
    light.inputs["Strength"].default_value = strength
    tree.links.new(way.outputs["Generated"], split.inputs[0])
    tree.links.new(split.outputs["Z"], ramp.inputs[0])
    tree.links.new(ramp.outputs[0], light.inputs["Color"])
    tree.links.new(light.outputs[0], out.inputs["Surface"])
    world.cycles.sampling_method = "NONE"  # smooth enough to be met by chance
    scene.world = world
