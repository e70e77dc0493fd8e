"""meshes.py - grounds and other meshes built by arrays."""

import contextlib

import bpy
import numpy as np


def link(obj):
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    return obj


def grid(nx, ny, spacing, x0=0.0, y0=0.0, height=None, name="Ground"):
    """A grid of nx x ny vertices, the first at (x0, y0); height: a function of x and y arrays."""
    x, y = np.meshgrid(x0 + spacing * np.arange(nx), y0 + spacing * np.arange(ny))
    z = np.zeros_like(x) if height is None else height(x, y)
    co = np.stack((x, y, z), axis=-1).reshape(-1, 3).astype(np.float32)
    i = np.arange(nx * ny, dtype=np.int32).reshape(ny, nx)
    quads = np.stack((i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]), axis=-1).reshape(-1, 4)
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(co))
    mesh.loops.add(quads.size)
    mesh.polygons.add(len(quads))
    mesh.vertices.foreach_set("co", co.ravel())
    mesh.loops.foreach_set("vertex_index", quads.ravel())
    mesh.polygons.foreach_set("loop_start", np.arange(0, quads.size, 4, dtype=np.int32))
    with contextlib.suppress(Exception):  # later Blenders read it off loop_start
        mesh.polygons.foreach_set("loop_total", np.full(len(quads), 4, np.int32))
    mesh.update(calc_edges=True)
    return link(bpy.data.objects.new(name, mesh))


def activate(obj):
    for each in list(bpy.context.view_layer.objects):  # which are gathered anew while they are chosen
        if each is not None:  # one that was removed since
            each.select_set(False)
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
