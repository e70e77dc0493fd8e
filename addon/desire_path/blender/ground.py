"""ground.py - any mesh, with its modifiers, as ground for the core.

The mesh is taken as it stands at the first frame, with every modifier but the one that plays our own
bake: a subdivided or displaced ground is walked on as it looks.
"""
from dataclasses import dataclass

import bpy
import numpy as np

from ..errors import DesirePathError
from . import axes, compat, playback, sample

STEEP = 0.02  # faces that rise more than this cosine count as ground, about 89 degrees
BLOCK = 1 << 16  # faces looked at in one go
WEIGHT = "desire_path_kind_{}"  # attributes of the private copy


@dataclass(frozen=True)
class Surface:
    """A ground mesh read once."""

    ground: object  # sim.Ground, ready to bake
    world: np.ndarray  # the object's matrix (4, 4)
    scale: float  # metres in a unit [m]
    vertices: np.ndarray  # in the world, float64 (n, 3) [m]
    corners: np.ndarray  # the local box of the points (8, 3)
    origin: tuple  # corner of cell (0, 0): puts a regular mesh on cell centres if that can be [m]
    warnings: tuple


def read(scene, obj, cell, frame_start, frame_end=None):
    """The ground an object is, or a sentence that says why it is none."""
    if obj is None or obj.type != "MESH":
        raise DesirePathError("There is no ground: select the mesh that is walked on.")
    scale = axes.unit_scale(scene)
    warnings = []
    groups = [each.vertex_group for each in obj.desire_path.painted]
    for name in groups:
        if name not in obj.vertex_groups:
            raise DesirePathError(f"'{obj.name}' has no vertex group '{name}' to paint a soil with: "
                                  "choose another group or remove the soil from the list.")
    copy = obj.copy()
    tree = None
    try:
        copy.hide_viewport = False
        ours = playback.modifier(copy)
        if ours is not None:
            copy.modifiers.remove(ours)
        if groups:
            tree = _weights(copy, groups)
        with sample.private_scene(scene, copy) as own:
            if frame_end is not None:
                last = np.array(sample.evaluated(own, copy, frame_end).matrix_world)
            found = sample.evaluated(own, copy, frame_start)
            world = axes.matrix(found.matrix_world, obj.name)
            if frame_end is not None and np.isfinite(last).all() and not np.allclose(last, world):
                warnings.append(f"'{obj.name}' moves between the frames: it is walked on as it lies "
                                f"at frame {frame_start}.")
            local = compat.positions(found.data)
            triangles = compat.triangles(found.data)
            weights = [compat.float_attribute(found.data, WEIGHT.format(k))
                       for k in range(len(groups))]
    finally:
        bpy.data.objects.remove(copy)
        if tree is not None:
            bpy.data.node_groups.remove(tree)
    if not len(triangles):
        raise DesirePathError(f"'{obj.name}' has no faces: give it some to walk on.")
    bad = np.flatnonzero(~(np.abs(local) < axes.FAR).all(axis=1))
    if len(bad):
        raise DesirePathError(f"Vertex {bad[0]} of '{obj.name}' is NaN or infinite: move or remove "
                              "it in Edit Mode.")
    vertices = axes.points(world, local, scale)
    _faces_up(obj, world, vertices, triangles)
    kinds = _kinds(weights, len(vertices)) if groups else None
    from ..sim import Ground  # the core is loaded when it is first needed
    low, high = local.min(axis=0), local.max(axis=0)
    corners = np.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1])
                        for z in (low[2], high[2])], np.float64)
    return Surface(Ground.mesh(vertices, triangles, kinds), world, scale, vertices, corners,
                   _cell_corner(vertices, cell), tuple(warnings))


def under(obj, surface, gait):
    """Refuse a walk that never comes over the ground."""
    feet = gait.pose[..., :2].reshape(-1, 2)
    low, high = surface.vertices[:, :2].min(axis=0), surface.vertices[:, :2].max(axis=0)
    if not ((feet >= low) & (feet <= high)).all(axis=1).any():
        raise DesirePathError(f"The walk passes beside the ground '{obj.name}': move the walker or the "
                              "ground so that one lies over the other.")


def _faces_up(obj, world, vertices, triangles):
    """Refuse walls and ceilings: look at faces until one can be walked on."""
    hand = np.sign(np.linalg.det(world[:3, :3]))
    has_area = looks_down = False
    for first in range(0, len(triangles), BLOCK):
        a, b, c = (vertices[triangles[first:first + BLOCK, k]] for k in range(3))
        normal = np.cross(b - a, c - a) * hand
        area = np.linalg.norm(normal, axis=1)
        rise = normal[:, 2] / np.maximum(area, 1e-300)
        if (rise > STEEP).any():
            return
        has_area |= bool((area > 0.0).any())
        looks_down |= bool((rise < -STEEP).any())
    if not has_area:
        raise DesirePathError(f"The faces of '{obj.name}' have no area: give it faces to walk on.")
    if looks_down:
        raise DesirePathError(f"All faces of '{obj.name}' look down or sideways: flip its normals "
                              "(Mesh > Normals > Flip) or turn it over.")
    raise DesirePathError(f"'{obj.name}' stands upright like a wall: turn it so that it can be "
                          "walked on.")


def _cell_corner(vertices, cell):
    """Where cells begin: so that a regular mesh, its spacing a whole number of cells, has its points
    on their centres; any other mesh lies between them anyway."""
    if not (np.isfinite(cell) and cell > 0.0):
        return (0.0, 0.0)  # the bake refuses it
    origin = tuple(float(each) for each in np.mod(vertices[0, :2] / cell - 0.5, 1.0) * cell)
    return (0.0, 0.0) if smooth(vertices, cell, origin) else origin


def smooth(vertices, cell, corner):
    """Whether points lie between the centres of cells, so that playback must interpolate."""
    return axes.cell_offset(vertices, cell, corner) >= playback.ALIGNED


# ---- painted soils ---------------------------------------------------------------------------------


def _weights(copy, groups):
    """Have the copy's vertex groups written as attributes behind all its modifiers."""
    tree = compat.geometry_tree("desire_path weights", bpy.data.node_groups.new)
    wire = playback.Wiring(tree)
    geometry = wire.add("NodeGroupInput").outputs[0]
    for k, name in enumerate(groups):
        weight = wire.add("GeometryNodeInputNamedAttribute", {"data_type": "FLOAT"}, Name=name)
        geometry = wire.add("GeometryNodeStoreNamedAttribute",
                            {"data_type": "FLOAT", "domain": "POINT"}, Geometry=geometry,
                            Name=WEIGHT.format(k),
                            Value=compat.socket(weight.outputs, "Attribute")).outputs[0]
    leave = tree.nodes.new("NodeGroupOutput")
    tree.links.new(geometry, leave.inputs[0])
    modifier = copy.modifiers.new("weights", "NODES")
    made = modifier.node_group
    modifier.node_group = tree
    if made is not None and made.users == 0:
        bpy.data.node_groups.remove(made)
    return tree


def _kinds(weights, count):
    """Weight of each soil per vertex (1 + painted, n): the unpainted rest is the ground's own."""
    painted = [w if w is not None else np.zeros(count, np.float32) for w in weights]
    base = np.maximum(1.0 - np.sum(painted, axis=0), 0.0)
    return np.stack([base] + painted).astype(np.float32)


def soils(obj):
    """Names of the soils: the ground's own, then the painted ones."""
    settings = obj.desire_path
    return [settings.soil] + [each.soil for each in settings.painted]
