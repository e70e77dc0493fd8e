"""park_eye.py - a worn park from eye height: earth where it is bare, grass as dense as its cover."""

import bpy
import numpy as np

from . import demo, materials

EYE = 1.65  # [m]
AT, TOWARDS = (13.2, 27.2), (31.5, 43.5)  # the camera, and what it looks at
GRID = 0.125  # of the ground's mesh [m]
NEAR, TUFTS = 55.0, 70.0  # how far grass stands [m], and how dense close by [1/m^2]
HOLLOW = 0.04  # how deep bare ways lie [m]
KINDS, BLADES = 6, 9  # of tufts, of one
TREES, LEAVES = 70, 900  # behind the park, of one


def picture(cover, blocked, cell, path, size=(900, 450), samples=16):
    """Render the park to a picture. cover, blocked: of its cells (ny, nx), `cell` wide [m]."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    chance = np.random.default_rng(2)
    ground = _ground(cover, blocked, cell)
    ground.data.materials.append(_coloured("Park", "cover"))
    _water(blocked, cell)
    _grass(cover, blocked, cell, chance)
    _trees(cover.shape[1] * cell, chance)
    sun = demo.add_sun()
    sun.data.energy, sun.data.color, sun.location = 4.5, (1.0, 0.90, 0.76), (-3.0, 1.2, 2.2)
    demo.aim(sun, (0.0, 0.0, 0.0))
    materials.sky(scene, 0.9)
    scene.camera = demo.add_camera("Eye", (*AT, EYE), (*TOWARDS, -0.6), 26.0)
    demo.cycles(scene)
    scene.view_settings.exposure = 0.55
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.cycles.samples = samples
    scene.render.image_settings.file_format, scene.render.image_settings.quality = "JPEG", 88
    scene.render.filepath = str(path.resolve())
    bpy.ops.render.render(write_still=True)


def _at(field, cell, x, y):
    """A field of cells at places, straight in between."""
    ny, nx = field.shape
    u, v = np.clip(x / cell - 0.5, 0.0, nx - 1.001), np.clip(y / cell - 0.5, 0.0, ny - 1.001)
    i, j = u.astype(int), v.astype(int)
    a, b = u - i, v - j
    return (field[j, i] * (1 - a) + field[j, i + 1] * a) * (1 - b) + (
        field[j + 1, i] * (1 - a) + field[j + 1, i + 1] * a
    ) * b


def _ground(cover, blocked, cell):
    """The park and a wide rim around it, with its cover as an attribute."""
    side = cover.shape[1] * cell
    wide = np.geomspace(0.5, 200.0, 24)
    along = np.concatenate([-wide[::-1], np.arange(0.0, side + GRID, GRID), side + wide])

    def height(x, y):
        hollow = HOLLOW * (1.0 - _at(cover, cell, x, y)) ** 2
        return 0.6 * _at(blocked.astype(float), cell, x, y) * -1.0 - hollow

    ground = demo.add_mesh(along, along, height)
    x, y = np.meshgrid(along, along)
    inside = (x >= 0) & (x <= side) & (y >= 0) & (y <= side)
    attribute = ground.data.attributes.new("cover", "FLOAT", "POINT")
    attribute.data.foreach_set("value", np.where(inside, _at(cover, cell, x, y), 1.0).astype(np.float32).ravel())
    return ground


def _coloured(name, attribute):
    """Trodden earth to grass by an attribute."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Roughness"].default_value = 0.95
    of = tree.nodes.new("ShaderNodeAttribute")
    of.attribute_name = attribute
    grain = tree.nodes.new("ShaderNodeTexNoise")
    grain.inputs["Scale"].default_value, grain.inputs["Detail"].default_value = 900.0, 6.0
    mixed = tree.nodes.new("ShaderNodeMath")
    mixed.operation = "MULTIPLY_ADD"
    mixed.inputs[1].default_value, mixed.inputs[2].default_value = 0.5, -0.25
    add = tree.nodes.new("ShaderNodeMath")
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    stops = ramp.color_ramp.elements
    stops[0].color, stops[1].color = (0.26, 0.175, 0.105, 1.0), (0.075, 0.115, 0.026, 1.0)
    middle = stops.new(0.45)
    middle.color = (0.17, 0.145, 0.060, 1.0)
    place = tree.nodes.new("ShaderNodeTexCoord")
    for a, b in (
        (place.outputs["Generated"], grain.inputs["Vector"]),
        (grain.outputs[0], mixed.inputs[0]),
        (mixed.outputs[0], add.inputs[0]),
        (of.outputs["Fac"], add.inputs[1]),
        (add.outputs[0], ramp.inputs[0]),
        (ramp.outputs[0], shader.inputs["Base Color"]),
    ):
        tree.links.new(a, b)
    return material


def _water(blocked, cell):
    """A sheet that fills the pond."""
    material = bpy.data.materials.new("Water")
    material.use_nodes = True
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value, shader.inputs["Roughness"].default_value = (0.03, 0.05, 0.06, 1.0), 0.04
    j, i = np.nonzero(blocked)
    low, high = (i.min() * cell, j.min() * cell), ((i.max() + 1) * cell, (j.max() + 1) * cell)
    water = demo.add_mesh(np.array([low[0], high[0]]), np.array([low[1], high[1]]), lambda x, y: 0.0 * x - 0.12)
    water.data.materials.append(material)


def _tuft(name, chance, dry):
    """Some bent blades."""
    points, faces = [], []
    for _ in range(BLADES):
        turn, long = chance.uniform(0, 2 * np.pi), chance.uniform(0.10, 0.24) * (0.6 if dry else 1.0)
        out = np.array([np.cos(turn), np.sin(turn), 0.0])
        side = np.array([-out[1], out[0], 0.0]) * chance.uniform(0.003, 0.006)
        root = np.append(chance.normal(0.0, 0.03, 2), -0.01)
        lean = chance.uniform(0.15, 0.7) * (1.6 if dry else 1.0)
        middle = root + 0.6 * long * (out * 0.4 * lean + np.array([0, 0, 1.0]))
        tip = root + long * (out * lean + np.array([0, 0, 1.0 - 0.4 * lean]))
        k = len(points)
        points += [root - side, root + side, middle + 0.7 * side, middle - 0.7 * side, tip]
        faces += [(k, k + 1, k + 2, k + 3), (k + 3, k + 2, k + 4)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(p) for p in points], [], faces)
    return mesh


def _trees(side, chance):
    """Some trees behind the park, each a heap of leaves."""
    shade = bpy.data.materials.new("Leaves")
    shade.use_nodes = True
    shader = next(node for node in shade.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (0.045, 0.080, 0.020, 1.0)
    for _ in range(TREES):
        turn = chance.uniform(-0.25, 0.75) * np.pi
        away = side * chance.uniform(0.85, 1.6)
        high = chance.uniform(6.0, 13.0)
        root = np.array([0.5 * side + away * np.cos(turn), 0.5 * side + away * np.sin(turn), 0.0])
        at = chance.standard_normal((LEAVES, 3))
        at *= (chance.random(LEAVES) ** 0.25 / np.linalg.norm(at, axis=1))[:, None]
        at = root + (at + (0.0, 0.0, 1.05)) * (0.42 * high, 0.42 * high, 0.5 * high)
        a, b = chance.normal(0.0, 0.3, (2, LEAVES, 3))
        corners = np.stack([at - a, at - b, at + a, at + b], axis=1).reshape(-1, 3)
        mesh = bpy.data.meshes.new("Tree")
        mesh.from_pydata(corners.tolist(), [], np.arange(4 * LEAVES).reshape(-1, 4).tolist())
        mesh.materials.append(shade)
        bpy.context.scene.collection.objects.link(bpy.data.objects.new("Tree", mesh))


def _grass(cover, blocked, cell, chance):
    """Tufts before the camera, fewer and drier where the cover is worn."""
    greens = [(0.075, 0.130, 0.025, 1.0), (0.110, 0.150, 0.035, 1.0), (0.20, 0.175, 0.070, 1.0)]
    shades = []
    for n, colour in enumerate(greens):
        shade = bpy.data.materials.new(f"Blades {n}")
        shade.use_nodes = True
        shader = next(node for node in shade.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
        shader.inputs["Base Color"].default_value, shader.inputs["Roughness"].default_value = colour, 0.7
        shades.append(shade)
    count = int(TUFTS * np.pi * NEAR**2 / 4.0)
    far = NEAR * chance.random(count) ** 0.75  # denser close by
    ahead = np.arctan2(TOWARDS[1] - AT[1], TOWARDS[0] - AT[0])
    turn = ahead + np.radians(44.0) * chance.uniform(-1.0, 1.0, count)
    x, y = AT[0] + far * np.cos(turn), AT[1] + far * np.sin(turn)
    left = _at(cover, cell, x, y)
    there = (chance.random(count) < left**1.5) & (_at(blocked.astype(float), cell, x, y) < 0.35) & (far > 0.7)
    kind = chance.integers(0, KINDS, count)
    for n in range(KINDS):
        mine = there & (kind == n)
        dry = n == KINDS - 1
        tuft = bpy.data.objects.new(f"Tuft {n}", _tuft(f"Tuft {n}", chance, dry))
        tuft.data.materials.append(shades[2 if dry else n % 2])
        z = -HOLLOW * (1.0 - left[mine]) ** 2
        roots = bpy.data.meshes.new(f"Roots {n}")
        roots.vertices.add(int(mine.sum()))
        roots.vertices.foreach_set("co", np.stack([x[mine], y[mine], z], axis=1).astype(np.float32).ravel())
        stand = bpy.data.objects.new(f"Stand {n}", roots)
        stand.instance_type = "VERTS"
        tuft.parent = stand
        for obj in (stand, tuft):
            bpy.context.scene.collection.objects.link(obj)
