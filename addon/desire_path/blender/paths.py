"""paths.py - walkers that go along a curve, as often as wanted, instead of where their keys lead them.

path object --waypoints--> passes.along --in turn--> one recording, baked a frame a pass
"""

from dataclasses import replace

import bpy
import numpy as np

from ..errors import DesirePathError
from ..motion.scatter import Scatter
from ..placement.passes import in_turn
from . import axes, clock, ground, private, sample

BESIDE = 1.0  # ground this far beside the path is read, and five times the scatter [m]


def waypoints(scene, obj, frame=None):
    """Places in the world along a curve, the edges of a mesh, or an empty's children by name, (n, 3) [m]; at a frame,
    else as they are now."""
    frame = scene.frame_current if frame is None else frame
    scale = axes.unit_scale(scene)
    if obj.type == "EMPTY":
        there = sorted((child for child in obj.children if child.type == "EMPTY"), key=lambda each: each.name)
        if len(there) < 2:
            raise DesirePathError(
                f"The path '{obj.name}' is an empty without empties: parent two or more to it, named "
                "in the order they are walked to."
            )
        copies = [each.copy() for each in there]
        try:
            for each in copies:
                each.hide_viewport = False
            with private.private_scene(scene, *copies) as own:
                places = [sample.evaluated(own, each, frame).matrix_world.translation[:] for each in copies]
        finally:
            for each in copies:
                bpy.data.objects.remove(each)
        return np.array(places, np.float64) * scale
    if obj.type not in {"CURVE", "MESH"}:
        raise DesirePathError(f"'{obj.name}' is no path: choose a curve, a mesh of edges, or an empty with empties.")
    copy = obj.copy()
    data = None
    try:
        copy.hide_viewport = False
        if obj.type == "CURVE":
            data = copy.data = obj.data.copy()
            data.bevel_depth = data.extrude = data.offset = 0.0  # the line, without its thickness
            data.bevel_object = None
            if data.dimensions == "2D":
                data.fill_mode = "NONE"
        with private.private_scene(scene, copy) as own:
            found = sample.evaluated(own, copy, frame)
            world = axes.matrix(found.matrix_world, obj.name)
            mesh = found.to_mesh()
            there = mesh is not None  # a curve without splines has none
            local = np.array([vertex.co[:] for vertex in mesh.vertices] if there else [], np.float64).reshape(-1, 3)
            edges = [tuple(edge.vertices) for edge in mesh.edges] if there else []
            found.to_mesh_clear()
    finally:
        bpy.data.objects.remove(copy)
        if data is not None:
            bpy.data.curves.remove(data)
    order = _chain(len(local), edges)
    if len(order) < 2:
        raise DesirePathError(f"The path '{obj.name}' has no length: give it two or more points.")
    edges_of = np.bincount(np.array(edges, int).ravel(), minlength=1)  # from each vertex
    if len(set(order)) < np.count_nonzero(edges_of) or edges_of.max() > 2:
        raise DesirePathError(f"The path '{obj.name}' is not one line: join its pieces, or take off branches.")
    return axes.points(world, local[order], scale)


def _chain(count, edges):
    """Vertices in the order one meets them along the edges from the first end on; all of them without edges."""
    if not edges:
        return list(range(count))
    near = {}
    for a, b in edges:
        near.setdefault(a, []).append(b)
        near.setdefault(b, []).append(a)
    ends = sorted(v for v, others in near.items() if len(others) == 1)
    at = ends[0] if ends else min(near)
    order, seen = [at], {at}
    while True:
        ahead = [v for v in near[at] if v not in seen]
        if not ahead:
            break
        at = min(ahead)
        order.append(at)
        seen.add(at)
    return order + order[:1] if not ends else order


def goes(walkers):
    """Whether any of the walkers goes along a path."""
    return any(each.desire_path.path is not None for each in walkers)


def warnings(walkers):
    """Sentences about walkers whose passes go nowhere."""
    return [
        f"'{each.name}' has {each.desire_path.passes} passes and no path to go along: it walks once as keyed; set "
        "its Path."
        for each in walkers
        if each.desire_path.path is None and each.desire_path.passes > 1
    ]


def carried(scene, walkers, first, last, read):
    """Recording of walkers along their paths.

    read: gives a Simulation of the ground within a box (x0, y0, x1, y1) [m]

    Who has no path walks once as keyed. The walkers go one after the other, pass by pass.
    """
    alone = [sample.record(scene, each, first, last) for each in walkers]
    lines = [
        waypoints(scene, each.desire_path.path, first) if each.desire_path.path is not None else None
        for each in walkers
    ]
    boxes = []
    for each, line, gait in zip(walkers, lines, alone):
        if line is None:
            boxes.append(ground.under(gait))
        else:
            beside = BESIDE + 5.0 * each.desire_path.lateral
            boxes.append((*(line[:, :2].min(axis=0) - beside), *(line[:, :2].max(axis=0) + beside)))
    boxes = np.array(boxes)
    box = (*boxes[:, :2].min(axis=0), *boxes[:, 2:].max(axis=0))
    land = read(box)
    walked = []
    for each, line, gait in zip(walkers, lines, alone):
        settings = each.desire_path
        if line is not None:
            gait = gait.along(
                line[:, :2],
                settings.passes,
                back_and_forth=settings.back_and_forth,
                scatter=Scatter(axes.typed(settings.lateral)),
                seed=settings.path_seed,
                ground=land,
            )
        walked.append(gait)
    rate = max(gait.rate() or gait.frame_rate for gait in walked)
    walked = [gait if gait.rate() == rate else gait.resample(rate) for gait in walked]
    return replace(in_turn(walked), frame_start=first, frame_rate=clock.frame_rate(scene))
