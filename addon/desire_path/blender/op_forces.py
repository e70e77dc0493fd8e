"""op_forces.py - how the ground carries each foot, as arrows in the viewport at the current frame.

    record -> loads -> Forces --arrows--> lines, drawn over every 3D viewport while they are shown

An arrow begins where the foot presses and points the way the ground pushes back.
"""
from dataclasses import dataclass

import bpy
import numpy as np

from . import axes, ground, sample
from .op_walkers import Refusal, active

COLOUR = (1.0, 0.62, 0.05, 1.0)
WIDTH = 3.0  # of a line [pixel]
REACH = 0.6  # an arrow of one body weight, in heights of the mass centre over the feet
HEAD = 0.12  # of the arrow's length

_shown = {}  # name of the armature -> Forces
_handle = None  # of the drawing, while anything is shown


@dataclass(frozen=True)
class Forces:
    """The loads of one recording, a limb each."""

    time: np.ndarray  # (T,) [s]
    force: np.ndarray  # of the ground on the limb, 1 = body weight (L, T, 3)
    point: np.ndarray  # centre of pressure in the scene's units, NaN in the air (L, T, 3)
    reach: float  # length of one body weight in the scene's units
    frame_start: int
    frame_rate: float


def read(scene, armature):
    """(Forces, warnings) of what an armature does now."""
    from .. import walker
    from ..sim import Simulation
    settings = armature.desire_path
    land = settings.ground
    first, last = ((land.desire_path.frame_start, land.desire_path.frame_end) if land is not None
                   else sample.frame_range(scene, armature))
    gait = sample.record(scene, armature, first, last)
    below = None
    if land is not None:
        cell = axes.typed(land.desire_path.cell_size)
        surface = ground.read(scene, land, cell, first, box=ground.under(gait))
        gait = ground.walked(scene, [armature], gait, surface, cell, first, last)
        below = Simulation(surface.ground, cell_size=cell).rest_height
    loads = walker.loads(gait, settings.load_model, ground=below)
    return limbs(gait, loads, axes.unit_scale(scene)), gait.warnings + loads.warnings


def limbs(gait, loads, scale):
    """Loads of parts as Forces of limbs, of a recording of one walker."""
    shape = (len(gait.limb_walker), len(loads.time), 3)
    force, moment, weight = np.zeros(shape), np.zeros(shape), np.zeros(shape[:2] + (1,))
    for part, limb in enumerate(gait.part_limb):
        share = np.where(loads.touching[part] != 0, np.linalg.norm(loads.force[part], axis=1), 0.0)
        known = np.isfinite(loads.point[part]).all(axis=1)
        share = np.where(known, share, 0.0)[:, None]
        force[limb] -= loads.force[part]
        moment[limb] += share * np.where(known[:, None], loads.point[part], 0.0)
        weight[limb] += share
    point = np.where(weight > 0.0, moment / np.maximum(weight, 1e-12), np.nan)
    tall = float(np.median(gait.com[0, :, 2]) - np.quantile(gait.pose[..., 2], 0.05))
    return Forces(loads.time, force / (gait.mass[0] * 9.81), point / scale,
                  REACH * max(tall, 0.1) / scale, gait.frame_start, gait.frame_rate)


def arrows(forces, frame):
    """Lines of the arrows at a frame: pairs of points (2 n, 3)."""
    at = forces.time[0] + (frame - forces.frame_start) / forces.frame_rate
    half = 0.5 / forces.frame_rate
    if not forces.time[0] - half <= at <= forces.time[-1] + half:
        return np.zeros((0, 3), np.float32)
    t = int(np.abs(forces.time - at).argmin())
    lines = []
    for force, point in zip(forces.force[:, t], forces.point[:, t]):
        size = np.linalg.norm(force)
        if not np.isfinite(point).all() or size < 1e-3:
            continue
        along = force / size
        tip = point + forces.reach * force
        side = np.cross(along, (1.0, 0.0, 0.0) if abs(along[0]) < 0.7 else (0.0, 1.0, 0.0))
        side /= np.linalg.norm(side)
        lines += [point, tip]
        for barb in (side, -side, np.cross(along, side), -np.cross(along, side)):
            lines += [tip, tip - HEAD * forces.reach * size * (along - 0.4 * barb)]
    return np.array(lines, np.float32).reshape(-1, 3)


# ---- drawing ------------------------------------------------------------------------------------------


def _draw():
    context = bpy.context
    scene = context.scene
    frame = scene.frame_current + scene.frame_subframe
    lines = [arrows(forces, frame) for name, forces in _shown.items()
             if name in scene.objects and scene.objects[name].visible_get()]
    lines = np.concatenate(lines) if lines else ()
    if not len(lines):
        return
    import gpu
    from gpu_extras.batch import batch_for_shader
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    shader.bind()
    shader.uniform_float("viewportSize", (context.region.width, context.region.height))
    shader.uniform_float("lineWidth", WIDTH * context.preferences.system.ui_scale)
    shader.uniform_float("color", COLOUR)
    gpu.state.blend_set("ALPHA")
    batch_for_shader(shader, "LINES", {"pos": lines.tolist()}).draw(shader)
    gpu.state.blend_set("NONE")


def shows(obj):
    return obj.name in _shown


def show(obj, forces):
    """Draw an armature's forces from now on."""
    global _handle
    _shown[obj.name] = forces
    if _handle is None:
        _handle = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")
    _redraw()


def hide(name=None):
    """Draw an armature's forces no more; nobody's without a name."""
    global _handle
    if name is None:
        _shown.clear()
    else:
        _shown.pop(name, None)
    if not _shown and _handle is not None:
        bpy.types.SpaceView3D.draw_handler_remove(_handle, "WINDOW")
        _handle = None
    _redraw()


def _redraw():
    manager = getattr(bpy.context, "window_manager", None)  # none while Blender starts or ends
    for window in manager.windows if manager is not None else ():
        for area in window.screen.areas:
            if area.type in {"VIEW_3D", "PROPERTIES"}:
                area.tag_redraw()


class OBJECT_OT_desire_path_forces_show(Refusal, bpy.types.Operator):
    """Show or hide how hard the ground carries each foot, as arrows at the current frame"""

    bl_idname = "object.desire_path_forces_show"
    bl_label = "Show Forces"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        return active(cls, context, "ARMATURE", "the armature that walks")

    def work(self, context):
        obj = context.object
        if shows(obj):
            hide(obj.name)
            return {"FINISHED"}
        if bpy.app.background:
            self.report({"WARNING"}, "Forces are shown in a viewport, and Blender runs without a "
                                     "window: draw them to a picture with python -m desire_path plot.")
            return {"CANCELLED"}
        context.view_layer.update()
        forces, warnings = read(context.scene, obj)
        show(obj, forces)
        for each in warnings:
            self.report({"WARNING"}, each)
        last = forces.frame_start + forces.time[-1] * forces.frame_rate
        self.report({"INFO"}, f"The forces of '{obj.name}' are shown from frame {forces.frame_start} to "
                              f"{last:.0f}; after a change of the walk show them anew.")
        return {"FINISHED"}


CLASSES = (OBJECT_OT_desire_path_forces_show,)
