"""stems.py - the simulated plants themselves as a mesh, for close-ups.

plants.npz, plants.pc2 --edges, Mesh Cache--> stems in motion --native nodes--> blades of some width
"""

import math
import os

import bpy
import numpy as np

from ..errors import DesirePathError
from ..files import npz
from ..ground import tuft
from . import clock, compat, grass, playback, playback_tree, tufts, wiring

MODIFIER, BLADES = "Desire Path Plants", "Desire Path Blades"
KIND = "kind"  # attribute: which of the kinds a point belongs to
WIDTH = 0.0035  # of a blade at its foot [m]


def show(ground, folder, path, frame_start, scale):
    """An object for the plants in a bake's folder, a child of the ground; None where there are none.

    folder: as Blender writes paths; path: the same for the system; scale: metres in a unit [m]
    """
    try:
        found = npz.read(os.path.join(path, "plants.npz"), 16 << 30)
    except FileNotFoundError:
        return None
    except (PermissionError, npz.Damaged) as problem:
        raise DesirePathError(f"plants.npz in {path} is damaged ({problem}): bake again.") from None
    if not os.path.exists(os.path.join(path, "plants.pc2")):
        return None
    mesh = bpy.data.meshes.new(f"{ground.name} Plants")
    mesh.vertices.add(len(found["vertices"]))
    mesh.vertices.foreach_set("co", np.ascontiguousarray(found["vertices"], np.float32).ravel())
    mesh.edges.add(len(found["edges"]))
    mesh.edges.foreach_set("vertices", np.ascontiguousarray(found["edges"], np.int32).ravel())
    plant = found["plant"].astype(np.uint32)
    tone = ((plant * np.uint32(2654435761)) >> np.uint32(8)).astype(np.float64) / (1 << 24)
    foot = np.flatnonzero(found["along"] == 0.0)
    stem = np.repeat(np.arange(len(foot)), np.diff(np.append(foot, len(plant))))
    own = np.mod(tone + 0.618034 * stem, 1.0)
    tufts.store(mesh, tufts.LOOK, "FLOAT_VECTOR", np.column_stack([found["along"], own, np.zeros(len(own))]))
    tufts.store(mesh, tufts.TONE, "FLOAT", tone)
    tufts.store(mesh, tufts.STRENGTH, "FLOAT", np.where(found["unbroken"], 1.0, 0.45))
    tufts.store(mesh, KIND, "INT", found["kind"])
    mesh.update()
    obj = bpy.data.objects.new(mesh.name, mesh)
    for collection in ground.users_collection:
        collection.objects.link(obj)
    obj[playback_tree.TAG] = 1
    grass.stand_on(obj, ground, scale)
    cache = obj.modifiers.new(MODIFIER, "MESH_CACHE")
    cache.cache_format, cache.filepath = "PC2", playback.join(folder, "plants.pc2")
    cache.forward_axis, cache.up_axis = "POS_Y", "POS_Z"
    cache.frame_start, cache.frame_scale = float(frame_start), clock.stretch_of(ground)
    grass.use_tree(obj.modifiers.new(BLADES, "NODES"), _blades(obj.name, found["kinds"]))
    return obj


def _blades(name, kinds):
    """A tree that makes edges along stems blades that taper to their tips."""
    tree = compat.geometry_tree(f"{BLADES} {name}", bpy.data.node_groups.new)
    tree[playback_tree.TAG] = 1
    wire = wiring.Wiring(tree)
    line = wire.add("GeometryNodeMeshToCurve", Mesh=wire.add("NodeGroupInput").outputs[0]).outputs[0]
    along, own, _ = wire.split(wire.named(tufts.LOOK, "FLOAT_VECTOR"))
    thin = wire.math("SUBTRACT", 1.02, wire.math("POWER", along, 2.0))
    line = wire.add("GeometryNodeSetCurveRadius", Curve=line, Radius=thin).outputs[0]
    # sheets that cross may share a stem: blades in one place and one plane would shade each other black
    turn = wire.math("MULTIPLY", own, math.pi)
    line = wire.add("GeometryNodeSetCurveTilt", Curve=line, Tilt=turn).outputs[0]
    half = (0.5 * WIDTH, 0.0, 0.0)
    across = wire.add("GeometryNodeCurvePrimitiveLine", Start=tuple(-x for x in half), End=half).outputs[0]
    # from 4.5 on the node takes the radius only where it is told to
    blades = wire.add("GeometryNodeCurveToMesh", Curve=line, Scale=thin, **{"Profile Curve": across}).outputs[0]
    for number, kind in enumerate(kinds):
        its = wire.add(
            "FunctionNodeCompare", {"data_type": "INT", "operation": "EQUAL"}, A=wire.named(KIND, "INT"), B=number
        ).outputs[0]
        material = tufts.material(str(kind), tuft.LOOKS.get(str(kind), tuft.LOOKS["meadow"]))
        blades = wire.add("GeometryNodeSetMaterial", Geometry=blades, Selection=its, Material=material).outputs[0]
    leave = tree.nodes.new("NodeGroupOutput")
    tree.links.new(blades, leave.inputs[0])
    leave.location = (180 * wire.column, 0)
    return tree


def remove(obj):
    """Take the object away, with all that was made for it."""
    if obj is None:
        return
    trees = [
        each.node_group
        for each in obj.modifiers
        if each.type == "NODES" and each.node_group is not None and playback_tree.TAG in each.node_group
    ]
    mesh = obj.data
    bpy.data.objects.remove(obj)
    if mesh.users == 0:
        bpy.data.meshes.remove(mesh)
    for tree in trees:
        used = {
            node.inputs["Material"].default_value for node in tree.nodes if node.bl_idname == "GeometryNodeSetMaterial"
        }
        playback.discard(tree)
        for each in used - {None}:
            tufts.discard_material(each)
