"""sprays.py - what flies over a ground in each frame of its bake, as points.

    frames/spray_0000.exr .. --image texture--> as many points as fly, where they are --> spheres with a material

A mesh of as many vertices as ever fly at once is led by one geometry-nodes modifier, without this add-on too. Points
carry `velocity` [m/s], which Cycles blurs motion by, and `desire_path_soil`, the number of the soil they are of.
"""

from dataclasses import replace

import bpy

from ..ground.spray import SPRAYS, WIDTH
from . import clock, compat, grass, playback, playback_tree, wiring

MODIFIER = "Desire Path Spray"
SOIL, VELOCITY = "desire_path_soil", "velocity"
SMALLEST, LARGEST = 0.55, 1.25  # of what is shown, in widths of a grain
MOST_ADHESION = 0.05  # [m]
LOOKS = {  # colour, roughness
    "SAND": ((0.58, 0.46, 0.31), 0.9),
    "MUD": ((0.075, 0.052, 0.034), 0.35),
    "SNOW": ((0.84, 0.87, 0.92), 0.6),
}


def of_ground(settings):
    """The Spray a ground asks for, or None."""
    if settings.spray == "NONE":
        return None
    spray = SPRAYS[settings.spray.lower()]
    return replace(spray, adhesion=min(spray.adhesion * settings.spray_amount, MOST_ADHESION))


def show(ground, frames, index, scale, old=None):
    """An object for what flies in a bake's frames, a child of the ground; None where nothing ever does.

    frames: their folder as Blender writes paths; scale: metres in a unit [m]; old: the one before, which it replaces
    and whose material it takes over
    """
    material = _material_of(old)
    most = index.most_grains() if index.grain_size > 0.0 and index.frames else 0
    if not most:
        remove(old)
        return None
    image = playback.sequence(frames, "spray")
    mesh = bpy.data.meshes.new(f"{ground.name} Spray")
    mesh.vertices.add(most)
    obj = bpy.data.objects.new(mesh.name, mesh)
    for collection in ground.users_collection:
        collection.objects.link(obj)
    obj[playback_tree.TAG] = 1
    grass.stand_on(obj, ground, scale)
    if material is None:
        material = _material(ground.desire_path.spray)
    tree = _tree(obj.name, image, index, clock.stretch_of(ground), material)
    remove(old)
    mesh.name = obj.name = f"{ground.name} Spray"
    grass.use_tree(obj.modifiers.new(MODIFIER, "NODES"), tree)
    return obj


def _tree(name, image, index, stretch, material):
    """The nodes by which points are where the frame's image says."""
    tree = compat.geometry_tree(f"{MODIFIER} {name}", bpy.data.node_groups.new)
    tree[playback_tree.TAG] = 1
    wire = wiring.Wiring(tree)
    geometry = wire.add("NodeGroupInput").outputs[0]
    number = playback_tree.file_number(wire, index, index.frames, stretch)

    # the first pixel: how many fly, and how many rows their places take
    head = wire.image(image, (0.5 / WIDTH, 1e-7, 0.0), number, False).outputs["Color"]
    count, rows, _ = wire.split(head)
    point = wire.add("GeometryNodeInputIndex").outputs[0]
    beyond = wire.add(
        "FunctionNodeCompare", {"data_type": "FLOAT", "operation": "GREATER_EQUAL"}, A=point, B=count
    ).outputs[0]
    geometry = wire.add("GeometryNodeDeleteGeometry", Geometry=geometry, Selection=beyond).outputs[0]

    # each point its pixel, and one as many rows higher
    pixel = wire.math("ADD", point, 1.0)
    column = wire.math("MODULO", pixel, float(WIDTH))
    row = wire.math("DIVIDE", wire.math("SUBTRACT", pixel, column), float(WIDTH))
    u = wire.math("DIVIDE", wire.math("ADD", column, 0.5), float(WIDTH))
    v = wire.math("DIVIDE", wire.math("ADD", row, 0.5), wire.math("MULTIPLY", rows, 2.0))
    place = wire.image(image, wire.xyz(u, v), number, False)
    speed = wire.image(image, wire.xyz(u, wire.math("ADD", v, 0.5)), number, False)
    geometry = wire.store(geometry, VELOCITY, speed.outputs["Color"], "FLOAT_VECTOR")
    geometry = wire.store(geometry, SOIL, place.outputs["Alpha"])
    geometry = wire.add("GeometryNodeSetPosition", Geometry=geometry, Position=place.outputs["Color"]).outputs[0]

    # each as large as its name says, whatever flies beside it
    some = wire.math("FRACT", wire.math("MULTIPLY", wire.math("MODULO", speed.outputs["Alpha"], 997.0), 0.618034))
    low, high = (0.5 * each * index.grain_size for each in (SMALLEST, LARGEST))
    radius = wire.math("MULTIPLY_ADD", some, high - low, low)
    geometry = wire.add("GeometryNodeMeshToPoints", Mesh=geometry, Radius=radius).outputs[0]
    geometry = wire.add("GeometryNodeSetMaterial", Geometry=geometry, Material=material).outputs[0]
    leave = tree.nodes.new("NodeGroupOutput")
    tree.links.new(geometry, leave.inputs[0])
    leave.location = (180 * wire.column, 0)
    return tree


def _material(spray):
    """What grains look like, to be changed at will."""
    colour, rough = LOOKS.get(spray, LOOKS["SAND"])
    new = bpy.data.materials.new(MODIFIER)
    new[playback_tree.TAG] = 1
    new.diffuse_color = (*colour, 1.0)
    new.use_nodes = True
    shader = next(node for node in new.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = rough
    return new


def _trees(obj):
    """The trees of ours that an object goes by."""
    return [
        each.node_group
        for each in (obj.modifiers if obj is not None else ())
        if each.type == "NODES" and each.node_group is not None and playback_tree.TAG in each.node_group
    ]


def _material_of(obj):
    """The material an object's grains have, or None."""
    found = (
        node.inputs["Material"].default_value
        for tree in _trees(obj)
        for node in tree.nodes
        if node.bl_idname == "GeometryNodeSetMaterial"
    )
    return next(filter(None, found), None)


def remove(obj):
    """Take the object away, with all that was made for it."""
    if obj is None:
        return
    trees, material, mesh = _trees(obj), _material_of(obj), obj.data
    bpy.data.objects.remove(obj)
    if mesh.users == 0:
        bpy.data.meshes.remove(mesh)
    for tree in trees:
        playback.discard(tree)
    if material is not None and playback_tree.TAG in material and material.users == 0:
        bpy.data.materials.remove(material)
