"""Blender on top: operators collect, call and write; panels draw; arithmetic lives in the core."""

import atexit

import bpy

from . import (
    arrival,
    command_line,
    manual,
    messages,
    op_bake,
    op_balance,
    op_crowd,
    op_export,
    op_forces,
    op_ground,
    op_layers,
    op_material,
    op_place,
    op_plants,
    op_press,
    op_slow,
    op_track,
    op_walk_it,
    op_walkers,
    panels,
    panels_track,
    panels_walker,
    pictured,
    props,
    soil_presets,
    soils,
    translations,
)

_CLASSES = (
    op_ground.CLASSES
    + op_walkers.CLASSES
    + op_bake.CLASSES
    + op_export.CLASSES
    + op_forces.CLASSES
    + op_place.CLASSES
    + op_balance.CLASSES
    + op_slow.CLASSES
    + op_plants.CLASSES
    + op_walk_it.CLASSES
    + op_press.CLASSES
    + op_track.CLASSES
    + op_crowd.CLASSES
    + op_material.CLASSES
    + soils.CLASSES
    + messages.CLASSES
    + manual.CLASSES
    + soil_presets.CLASSES
    + panels.CLASSES
    + op_layers.CLASSES
    + panels_walker.CLASSES
    + panels_track.CLASSES
)


def register():
    props.register()
    for each in _CLASSES:
        bpy.utils.register_class(each)
    op_walk_it.register()
    op_press.register()
    op_export.register()
    translations.register()
    arrival.register()
    command_line.register()
    if not bpy.app.binary_path:
        # bpy as a module: 4.5 never ends while an operator or handler of Python is registered
        atexit.register(unregister)


def unregister():
    atexit.unregister(unregister)
    command_line.unregister()
    arrival.unregister()
    op_forces.hide()
    op_export.unregister()
    op_press.unregister()
    op_walk_it.unregister()
    translations.unregister()
    pictured.unregister()
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
    props.unregister()
