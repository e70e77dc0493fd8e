"""ground.py - any mesh, with its modifiers, as ground for the core.

The mesh is taken as renders have it at the first frame, with the modifiers that come before the one that plays
our own bake: a subdivided or displaced ground is walked on as it looks, without the hair that grows on it.
"""

from dataclasses import dataclass, replace
from itertools import product

import bpy
import numpy as np

from ..errors import DesirePathError
from ..ground import mesh as meshes
from ..ground.sim import Ground, Simulation
from ..placement import place
from ..rig import slope
from . import axes, compat, layered, moves, playback, playback_tree, sample, stack, wiring
from . import soils as soils_of

STEEP = 0.02  # faces that rise more than this cosine count as ground, about 89 degrees
NEAR = 0.6  # ground this far around the feet is read: soles, rims and smoothed slopes [m]
LEVEL = 0.01  # ground that rises less than this is level [m]
FINE = 4.5  # cells between the points of a mesh whose points matter to where cells lie
SOON = 0.38  # the shape is looked at after this share of the frames, too: what comes and goes is seen
LOOKS = 8  # and at so many of the frames at which it is keyed
BLOCK = 1 << 16  # faces looked at in one go, at most
WEIGHT = "desire_path_kind_{}"  # attributes of the private copy


class Beside(DesirePathError):
    """No face of the ground lies near the walk."""


@dataclass(frozen=True, eq=False)
class Surface:
    """A ground mesh read once."""

    ground: object  # sim.Ground, ready to bake
    world: np.ndarray  # the object's matrix (4, 4)
    scale: float  # metres in a unit [m]
    vertices: np.ndarray  # in the world, float64 (n, 3) [m]
    corners: np.ndarray  # the local box of the points (8, 3)
    origin: tuple  # corner of cell (0, 0): puts a regular mesh on cell centres if that can be [m]
    warnings: tuple
    place: stack.Place  # of our modifier
    drawn: np.ndarray  # the points the viewport has, in the world (m, 3) [m]
    mark: str  # another one when anything of the mesh, its place or its painted soils is
    painted: str  # another one when its painted soils are
    finer: int = 1  # times as many points as were read are in renders
    between: bool = False  # its points are to be shown between cells, as those of its neighbours are


def read(scene, obj, cell, frame_start, frame_end=None, *, box=None):
    """The ground an object is, or a sentence that says why it is none.

    box: (x0, y0, x1, y1) of the world: faces that do not reach into it are left out [m]
    """
    if obj is None or obj.type != "MESH":
        raise DesirePathError("There is no ground: select the mesh that is walked on.")
    _name_taken(obj)
    scale = axes.unit_scale(scene)
    layers = layered.of_ground(obj)
    painted = _painted_groups(obj)
    warnings, groups = [], [*painted, *layered.groups(layers)]
    if obj.instance_type in {"VERTS", "FACES"} and obj.children:
        warnings.append(
            f"'{obj.name}' shows instances of its children, in which there are no prints: make them real "
            "(Object > Apply > Make Instances Real) if they are walked on."
        )
    place = stack.find(scene, obj, frame_start)
    trees = [stack.realised()] if place.realise else []
    trees += [weights_tree(groups)] if groups else []
    with stack.shaped(scene, obj, place.before, trees) as (own, copy):
        later = []
        bare = not copy.modifiers and obj.data.shape_keys is None and obj.data.animation_data is None
        if frame_end is not None and not bare:  # a bare mesh keeps its shape
            for frame in _looks(scene, obj, frame_start, frame_end):
                stack.let_led(scene, own, copy, obj, frame, again=True)
                found = sample.evaluated(own, copy, frame)
                later.append(compat.positions(found.data))
        finer = stack.show(scene, copy, obj)
        stack.let_led(scene, own, copy, obj, frame_start)
        found = sample.evaluated(own, copy, frame_start)
        world = axes.matrix(found.matrix_world, obj.name)
        if not len(found.data.polygons):
            raise DesirePathError(f"'{obj.name}' has no faces: give it some to walk on.")
        if any(not _same(each, compat.positions(found.data)) for each in later):
            warnings.append(
                f"The shape of '{obj.name}' changes between the frames, by keys, drivers or a modifier: "
                f"it is walked on as it is at frame {frame_start}."
            )
        del later
        near = _near(found.data, world * scale, box)
        weights = [compat.float_attribute(found.data, WEIGHT.format(k)) for k in range(len(groups))]
        there = [each for each in weights if each is not None]
        mark = _mark(found.data, world * scale, there)
        drawn = None
        if stack.differs(scene, obj, place.before):
            stack.show(scene, copy, obj, render=False)
            drawn = _near(sample.evaluated(own, copy, frame_start).data, world * scale, box).vertices
    if near.bad >= 0:
        raise DesirePathError(f"Vertex {near.bad} of '{obj.name}' is NaN or infinite: move or remove it in Edit Mode.")
    if not len(near.triangles):
        raise Beside(
            f"The walk passes beside the ground '{obj.name}': move the walker or the ground so that one lies "
            "over the other."
        )
    vertices, triangles = near.vertices, near.triangles
    _faces_up(obj, world, vertices, triangles)
    weights = [w[near.of] if w is not None else None for w in weights]
    kinds = _kinds(weights[: len(painted)], len(vertices)) if painted else None
    return Surface(
        layered.laid(Ground(("mesh", vertices, triangles, kinds), "mesh"), layers, weights[len(painted) :]),
        world,
        scale,
        vertices,
        np.array(list(product(*zip(near.low, near.high))), np.float64),
        _cell_corner(vertices, cell),
        (*warnings, *place.warnings),
        place,
        vertices if drawn is None else drawn,
        mark,
        meshes.mark(there),
        finer,
    )


def _looks(scene, obj, first, last):
    """Frames at which the shape of a ground is compared with that at the first one: it may come and go between."""
    keyed = moves.keys(scene, obj, first, last)
    some = np.linspace(0, len(keyed) - 1, min(len(keyed), LOOKS)).round().astype(int)
    return sorted({first + round(SOON * (last - first)), last, *(keyed[k] for k in some)})


def _name_taken(obj):
    """Refuse a mesh on which what plays the prints cannot be stored: nodes find the vertex group in its place."""
    for name in (playback_tree.ATTRIBUTE, playback_tree.LEAN):
        if name in obj.vertex_groups and name in obj.data.attributes:
            raise DesirePathError(
                f"'{obj.name}' has both an attribute and a vertex group '{name}', by which prints are played: "
                "rename or remove one of them."
            )


def _painted_groups(obj):
    """The vertex groups that soils are painted by."""
    groups = [each.vertex_group for each in obj.desire_path.painted]
    for name in groups:
        if name not in obj.vertex_groups:
            raise DesirePathError(
                f"'{obj.name}' has no vertex group '{name}' to paint a soil with: "
                "choose another group or remove the soil from the list."
            )
    return groups


def laid(surface, world):
    """A ground as if its object had another matrix."""
    if np.array_equal(surface.world, world):
        return surface
    move = world @ np.linalg.inv(surface.world)
    move[:3, 3] *= surface.scale
    vertices, drawn = (axes.points(move, each, 1.0) for each in (surface.vertices, surface.drawn))
    return replace(surface, world=world, vertices=vertices, drawn=drawn)


def _same(one, other):
    """Whether points are where others are, but for rounding."""
    if one.shape != other.shape:
        return False
    if np.array_equal(one, other):  # nearly always, and much sooner found
        return True
    size = float(np.abs(other).max(initial=0.0))
    return (
        bool(np.isfinite(size)) and bool(np.allclose(one, other, rtol=0.0, atol=1e-5 * size)) or not np.isfinite(size)
    )


def _near(mesh, place, box):
    """The faces of a mesh that reach into a box; place: from its own space to the world (4, 4) [m]."""
    return meshes.near(compat.positions(mesh), *compat.faces(mesh), place[:3], box)


def _mark(mesh, place, painted):
    """A word for all of a mesh, where it is, and what is painted on it."""
    corners, _, _ = compat.faces(mesh)
    return meshes.mark([compat.positions(mesh), corners, *painted], [len(mesh.polygons), place.tolist()])


def under(gait):
    """The rectangle of the world the feet come near (x0, y0, x1, y1) [m]."""
    feet = gait.pose[..., :2].reshape(-1, 2)
    beside = NEAR + max(np.linalg.norm(sole.vertices, axis=1).max() for sole in gait.soles)
    return (*(feet.min(axis=0) - beside), *(feet.max(axis=0) + beside))


def _faces_up(obj, world, vertices, triangles):
    """Refuse walls and ceilings: look at faces until one can be walked on."""
    hand = np.sign(np.linalg.det(world[:3, :3]))
    has_area = looks_down = False
    first, block = 0, 64
    while first < len(triangles):
        a, b, c = (vertices[triangles[first : first + block, k]] for k in range(3))
        first, block = first + block, min(2 * block, BLOCK)
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
        raise DesirePathError(
            f"All faces of '{obj.name}' look down or sideways: flip its normals "
            "(Mesh > Normals > Flip) or turn it over."
        )
    raise DesirePathError(f"'{obj.name}' stands upright like a wall: turn it so that it can be walked on.")


def _cell_corner(vertices, cell):
    """Where cells begin: so that a fine regular mesh, its spacing a few whole cells, has its points on
    their centres; any other mesh lies between them anyway."""
    if not (np.isfinite(cell) and cell > 0.0):
        return (0.0, 0.0)  # the bake refuses it
    if len(vertices) < 2 or np.abs(vertices[1, :2] - vertices[0, :2]).max() > FINE * cell:
        return (0.0, 0.0)
    origin = tuple(float(each) for each in np.mod(vertices[0, :2] / cell - 0.5, 1.0) * cell)
    return (0.0, 0.0) if smooth(vertices, cell, origin) else origin


def smooth(vertices, cell, corner):
    """Whether points lie between the centres of cells, so that playback must interpolate."""
    return not meshes.are_centres(vertices, cell, corner, playback.ALIGNED)


def land(surface, cell):
    """A Simulation of a ground's shape alone, to ask for heights and slopes; its soils do not matter."""
    shape = surface.ground.native[:3]
    return Simulation(Ground((*shape, None), surface.ground.name), cell_size=cell)


def walked(scene, walkers, gait, below, frame_start, frame_end):
    """A recording as it is on a ground, `below` a Simulation of it: feet that lie on slopes have soles that do, and
    the feet of walkers that ask for it are placed."""
    asks = [row for row, each in enumerate(walkers) if each.desire_path.place_feet]
    if slope.steep(below, gait):
        gait = sample.gaits(scene, walkers, frame_start, frame_end, below)
    return place.place_feet(gait, below, walkers=asks) if asks else gait


# ---- painted soils ---------------------------------------------------------------------------------


def weights_tree(groups):
    """A tree that writes vertex groups as attributes."""
    tree = compat.geometry_tree("desire_path weights", bpy.data.node_groups.new)
    wire = wiring.Wiring(tree)
    geometry = wire.add("NodeGroupInput").outputs[0]
    for k, name in enumerate(groups):
        weight = wire.add("GeometryNodeInputNamedAttribute", {"data_type": "FLOAT"}, Name=name)
        geometry = wire.add(
            "GeometryNodeStoreNamedAttribute",
            {"data_type": "FLOAT", "domain": "POINT"},
            Geometry=geometry,
            Name=WEIGHT.format(k),
            Value=compat.socket(weight.outputs, "Attribute"),
        ).outputs[0]
    leave = tree.nodes.new("NodeGroupOutput")
    tree.links.new(geometry, leave.inputs[0])
    return tree


def _kinds(weights, count):
    """Weight of each soil per vertex (1 + painted, n): the unpainted rest is the ground's own."""
    painted = [w if w is not None else np.zeros(count, np.float32) for w in weights]
    base = np.maximum(1.0 - np.sum(painted, axis=0), 0.0)
    return np.stack([base] + painted).astype(np.float32)


def soils(obj):
    """The soils as they are now, as Soil: the ground's own, then the painted ones."""
    settings = obj.desire_path
    return [soils_of.soil_of(each) for each in (settings, *settings.painted)]
