"""framing.py - a walk that has just been baked is looked at: the view goes near where prints would be too small.

where the walk first treads the ground --> the 3D view that was used, unless it shows that --> play from there
"""

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d

from ..motion import size
from . import axes

FAR = 12.0  # prints seen from so far off are too small, in leg lengths
NEAR = 4.0  # the view comes as near as this
PATH = 3.0  # so much of the walk is to be seen
UP = 0.6  # this far above the ground the view is centred: who walks is seen, too


def look(context, obj, bake, frame):
    """Show the first steps on a ground in the largest 3D view of the window, and play from a frame on."""
    view = max(_views(context), key=lambda area: area.width * area.height, default=None)
    if view is not None:
        spot, leg = steps(context.scene, obj, bake.gait)
        _go(view, spot, leg)
    context.scene.frame_set(max(frame, context.scene.frame_start))
    if not context.screen.is_animation_playing:
        bpy.ops.screen.animation_play()


def steps(scene, obj, gait):
    """(middle of the first steps that a recording takes over an object, length of a leg), in units of the scene."""
    scale = axes.unit_scale(scene)
    leg = float(size.legs(gait).max())
    corners = axes.points(axes.matrix(obj.matrix_world, obj.name), np.array(obj.bound_box), scale)
    low, high = corners.min(axis=0), corners.max(axis=0)
    path = gait.com[0, :, :2]
    there = path[((path >= low[:2]) & (path <= high[:2])).all(axis=1)]
    path = there if len(there) else path
    path = path[np.linalg.norm(path - path[0], axis=1) <= PATH * leg]
    return np.array((*(0.5 * (path[0] + path[-1])), high[2] + UP * leg)) / scale, leg / scale


def _views(context):
    return [area for area in context.screen.areas if area.type == "VIEW_3D"]


def _go(area, spot, leg):
    """Let a view come near to a spot, where it does not show that already."""
    space = area.spaces.active
    region = next(each for each in area.regions if each.type == "WINDOW")
    view = space.region_3d
    if view.view_perspective == "CAMERA" or space.region_quadviews:
        return
    seen = location_3d_to_region_2d(region, view, spot)
    inside = seen is not None and 0.1 < seen.x / region.width < 0.9 and 0.1 < seen.y / region.height < 0.9
    if not inside or view.view_distance > FAR * leg:
        view.view_location = spot
        view.view_distance = NEAR * leg
