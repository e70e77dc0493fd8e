"""op_forces.py - what the forces of a walk are: in the viewport, as a graph, as a report and as tables.

    record -> loads -> Forces --lines, graph--> drawn over every 3D viewport while they are shown
                       report --> the panel, loads.csv, contacts.csv

An arrow begins where the foot presses and points the way the ground pushes back. The mass centre has a ring, and
a plumb line down to the ground; a cross tells where all feet press together.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, replace

import bpy
from bpy.props import StringProperty

from . import soils
from .chosen import WALKERS, walkers
from .drawing import batch, gpu
from .late import axes, force_graph, ground, json, moves, np, report, ride, sample, trodden, walker
from .messages import tell
from .ops import Refusal, active

COLOURS = {"force": (1.0, 0.62, 0.05, 1.0), "mass": (0.2, 0.8, 1.0, 1.0), "pressure": (0.3, 1.0, 0.35, 1.0)}
WIDTH = 3.0  # of a line [pixel]
WEIGHT_LENGTH = 0.6  # an arrow of one body weight, in heights of the mass centre over the feet
HEAD = 0.12  # of the arrow's length
RING = 0.04  # radius of marks, in heights of the mass centre
ROUND = 16  # sides of a ring

_shown = {}  # name of the armature -> Forces
_graphs = set()  # names of the armatures whose graph is shown
_handles = {}  # "POST_VIEW", "POST_PIXEL" -> handle of the drawing, while there is something to draw


@dataclass(frozen=True, eq=False)
class Forces:
    """The loads of one recording, a limb each."""

    time: np.ndarray  # (T,) [s]
    force: np.ndarray  # of the ground on the limb, 1 = body weight (L, T, 3)
    point: np.ndarray  # centre of pressure in the scene's units, NaN in the air (L, T, 3)
    mass: np.ndarray  # mass centre in the scene's units (T, 3)
    foot: np.ndarray  # height of the ground below it in the scene's units, NaN = none (T,)
    pressure: np.ndarray  # where all feet press together in the scene's units, NaN in the air (T, 3)
    touching: np.ndarray  # (L, T) bool
    names: tuple  # of the limbs
    weight_length: float  # length of one body weight in the scene's units
    frame_start: int
    frame_rate: float
    carry: np.ndarray = None  # what a ground that moves has done since the first sample (T, 4, 4)

    def lines(self, t, points):
        """Pairs of points (2 n, 3) of a sample, where they are seen."""
        points = np.array(points, np.float64).reshape(-1, 3)
        if self.carry is not None:
            points = points @ self.carry[t][:3, :3].T + self.carry[t][:3, 3]
        return points.astype(np.float32)

    def sample(self, frame):
        """The sample at a scene frame, None before and after the recording."""
        at = self.time[0] + (frame - self.frame_start) / self.frame_rate
        half = 0.5 / self.frame_rate
        if not self.time[0] - half <= at <= self.time[-1] + half:
            return None
        return int(np.abs(self.time - at).argmin())


@dataclass(frozen=True)
class Reading:
    """One armature's walk with its loads."""

    gait: object
    loads: object
    forces: Forces
    warnings: tuple


def read(scene, armature):
    """A Reading of what an armature does now."""
    settings, land = armature.desire_path, armature.desire_path.ground
    first, last = (
        moves.frames(scene, land, walkers(scene, land)) if land is not None else moves.frame_range(scene, armature)
    )
    gait = sample.record(scene, armature, first, last)
    below, yields = None, {}
    if land is not None:
        yields = {"settle_time": soils.soil_of(land.desire_path).settle_time}  # as when it is baked
        shape, _, _ = trodden.under(scene, armature, land, gait, first)
        gait = ground.walked(scene, [armature], gait, shape, first, last)
        below = shape.rest_height
    loads = walker.loads(gait, settings.load_model, ground=below, **yields)
    forces = replace(
        limbs(gait, loads, axes.unit_scale(scene), below),
        carry=ride.path(scene, land, gait.frame(np.arange(len(gait.time))).tolist()),
    )
    return Reading(gait, loads, forces, tuple(dict.fromkeys(gait.warnings + loads.warnings)))


def limbs(gait, loads, scale, below=None):
    """Loads of parts as Forces of limbs, of a recording of one walker. below: height of the ground at (n, 2)."""
    count = len(gait.limb_walker)
    force = np.zeros((count, len(loads.time), 3))
    touching = np.zeros(force.shape[:2], bool)
    for part, limb in enumerate(gait.part_limb):
        force[limb] -= loads.force[part]
        touching[limb] |= loads.touching[part] != 0
    point = np.array([report.pressure_centre(gait, loads, limb) for limb in range(count)])
    centre = gait.com[0]
    under = below(centre[:, :2]) if below is not None else np.zeros(len(centre))
    tall = float(np.median(centre[:, 2]) - np.quantile(gait.pose[..., 2], 0.05))
    return Forces(
        loads.time,
        force / (gait.mass[0] * 9.81),
        point / scale,
        centre / scale,
        under / scale,
        report.pressure_centre(gait, loads, *range(count)) / scale,
        touching,
        gait.limb_name,
        WEIGHT_LENGTH * max(tall, 0.1) / scale,
        gait.frame_start,
        gait.frame_rate,
    )


# ---- lines: pairs of points (2 n, 3) --------------------------------------------------------------------


def arrows(forces, frame):
    """Lines of the arrows at a frame."""
    t, lines = forces.sample(frame), []
    for force, point in zip(forces.force[:, t], forces.point[:, t]) if t is not None else ():
        size = np.linalg.norm(force)
        if not np.isfinite(point).all() or size < 1e-3:
            continue
        along = force / size
        tip = point + forces.weight_length * force
        side = np.cross(along, (1.0, 0.0, 0.0) if abs(along[0]) < 0.7 else (0.0, 1.0, 0.0))
        side /= np.linalg.norm(side)
        lines += [point, tip]
        for barb in (side, -side, np.cross(along, side), -np.cross(along, side)):
            lines += [tip, tip - HEAD * forces.weight_length * size * (along - 0.4 * barb)]
    return forces.lines(t, lines) if t is not None else _pairs(lines)


def mass_marks(forces, frame):
    """Lines of the mass centre at a frame: a ring about it, and the plumb line with its foot on the ground."""
    t = forces.sample(frame)
    if t is None:
        return _pairs([])
    centre, foot, size = forces.mass[t], forces.foot[t], RING / WEIGHT_LENGTH * forces.weight_length
    lines = _ring(centre, size, (0, 2)) + _ring(centre, size, (1, 2)) + _ring(centre, size, (0, 1))
    if np.isfinite(foot):
        below = np.array((centre[0], centre[1], foot))
        lines += [centre, below] + _ring(below, 0.5 * size, (0, 1))
    return forces.lines(t, lines)


def pressure_marks(forces, frame):
    """Lines of the centres of pressure at a frame: a ring for each foot, a cross for all together."""
    t = forces.sample(frame)
    if t is None:
        return _pairs([])
    size = 0.5 * RING / WEIGHT_LENGTH * forces.weight_length
    lines = []
    for point in forces.point[:, t]:
        if np.isfinite(point).all():
            lines += _ring(point, size, (0, 1))
    together = forces.pressure[t]
    if np.isfinite(together).all():
        for arm in ((2.5 * size, 0.0, 0.0), (0.0, 2.5 * size, 0.0)):
            lines += [together - arm, together + arm]
    return forces.lines(t, lines)


def _ring(centre, radius, plane):
    angle = np.linspace(0.0, 2.0 * np.pi, ROUND + 1)
    points = np.tile(np.asarray(centre, float), (ROUND + 1, 1))
    points[:, plane[0]] += radius * np.cos(angle)
    points[:, plane[1]] += radius * np.sin(angle)
    return [each for pair in zip(points[:-1], points[1:]) for each in pair]


def _pairs(lines):
    return np.array(lines, np.float32).reshape(-1, 3)


# ---- drawing ------------------------------------------------------------------------------------------


def _seen(scene, names):
    return [name for name in names if name in _shown and name in scene.objects and scene.objects[name].visible_get()]


def _draw():
    context = bpy.context
    scene = context.scene
    frame = scene.frame_current + scene.frame_subframe
    for name in _seen(scene, _shown):
        for kind, marks_of in (("mass", mass_marks), ("pressure", pressure_marks), ("force", arrows)):
            lines = marks_of(_shown[name], frame)
            if len(lines):
                _draw_lines(context, lines, COLOURS[kind])


def _draw_lines(context, lines, colour):
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    shader.bind()
    shader.uniform_float("viewportSize", (context.region.width, context.region.height))
    shader.uniform_float("lineWidth", WIDTH * context.preferences.system.ui_scale)
    shader.uniform_float("color", colour)
    gpu.state.blend_set("ALPHA")
    batch.batch_for_shader(shader, "LINES", {"pos": lines.tolist()}).draw(shader)
    gpu.state.blend_set("NONE")


def _draw_graphs():
    context = bpy.context
    scene = context.scene
    frame = scene.frame_current + scene.frame_subframe
    for row, name in enumerate(_seen(scene, sorted(_graphs))):
        force_graph.draw(context, name, _shown[name], frame, row)


def shows(obj):
    return obj.name in _shown


def shows_graph(obj):
    return obj.name in _graphs


def show(obj, forces, graph=False):
    """Draw an armature's forces from now on, with their graph if asked for."""
    _shown[obj.name] = forces
    (_graphs.add if graph else _graphs.discard)(obj.name)
    for kind, draw in (("POST_VIEW", _draw), ("POST_PIXEL", _draw_graphs)):
        if kind not in _handles:
            _handles[kind] = bpy.types.SpaceView3D.draw_handler_add(draw, (), "WINDOW", kind)
    _redraw()


def hide(name=None):
    """Draw an armature's forces no more; nobody's without a name."""
    if name is None:
        _shown.clear()
        _graphs.clear()
    else:
        _shown.pop(name, None)
        _graphs.discard(name)
    if not _shown:
        while _handles:
            bpy.types.SpaceView3D.draw_handler_remove(_handles.popitem()[1], "WINDOW")
    _redraw()


def _redraw():
    manager = getattr(bpy.context, "window_manager", None)  # none while Blender starts or ends
    for window in manager.windows if manager is not None else ():
        for area in window.screen.areas:
            if area.type in {"VIEW_3D", "PROPERTIES"}:
                area.tag_redraw()


# ---- operators ----------------------------------------------------------------------------------------


def keep(obj, reading):
    """Keep what the forces came to on the walker, for the panel."""
    (numbers,) = report.summary(reading.gait, reading.loads)
    obj.desire_path.forces = json.dumps(numbers)
    return numbers


class _Forces(Refusal):
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        return active(cls, context, WALKERS, "the armature that walks, or a mesh that moves")

    def read(self, context):
        context.view_layer.update()
        reading = read(context.scene, context.object)
        for each in reading.warnings:
            tell(self, "WARNING", each)
        return reading

    def windowless(self):
        if not bpy.app.background:
            return False
        tell(
            self,
            "WARNING",
            "Forces are shown in a viewport, and Blender runs without a window: draw them to "
            "a picture with python -m desire_path plot.",
        )
        return True


class OBJECT_OT_desire_path_forces_show(_Forces, bpy.types.Operator):
    """Show or hide how hard the ground carries each foot, as arrows at the current frame, and the mass centre"""

    bl_idname = "object.desire_path_forces_show"
    bl_label = "Show Forces"

    def work(self, context):
        obj = context.object
        if shows(obj):
            hide(obj.name)
            return {"FINISHED"}
        if self.windowless():
            return {"CANCELLED"}
        reading = self.read(context)
        keep(obj, reading)
        forces = reading.forces
        show(obj, forces)
        last = forces.frame_start + forces.time[-1] * forces.frame_rate
        tell(
            self,
            "INFO",
            f"The forces of '{obj.name}' are shown from frame {forces.frame_start} to "
            f"{last:.0f}; after a change of the walk show them anew.",
        )
        return {"FINISHED"}


class OBJECT_OT_desire_path_forces_graph(_Forces, bpy.types.Operator):
    """Show or hide a graph of each foot's vertical force over time, in the corner of the 3D viewport"""

    bl_idname = "object.desire_path_forces_graph"
    bl_label = "Force Graph"

    def work(self, context):
        obj = context.object
        if shows_graph(obj):
            show(obj, _shown[obj.name])
            return {"FINISHED"}
        if self.windowless():
            return {"CANCELLED"}
        if shows(obj):
            show(obj, _shown[obj.name], graph=True)
            return {"FINISHED"}
        reading = self.read(context)
        keep(obj, reading)
        show(obj, reading.forces, graph=True)
        return {"FINISHED"}


class _Report(_Forces):
    directory: StringProperty(
        name="Folder",
        subtype="DIR_PATH",
        options={"SKIP_SAVE"},
        description="Where loads.csv and contacts.csv are written; empty = nowhere",
    )

    def work(self, context):
        obj = context.object
        reading = self.read(context)
        numbers = keep(obj, reading)
        where = ""
        if self.directory:
            folder = bpy.path.abspath(self.directory)
            os.makedirs(folder, exist_ok=True)
            walker.write_loads(os.path.join(folder, "loads.csv"), reading.gait, reading.loads)
            report.write_contacts(os.path.join(folder, "contacts.csv"), reading.gait, reading.loads)
            where = f" Tables in {folder}."
        if shows(obj):
            show(obj, reading.forces, graph=shows_graph(obj))
        tell(self, "INFO", f"'{obj.name}': {'; '.join(report.sentences(numbers))}.{where}")
        return {"FINISHED"}


class OBJECT_OT_desire_path_forces_report(_Report, bpy.types.Operator):
    """Tell contacts, cadence, mean force and what is odd about the walk"""

    bl_idname = "object.desire_path_forces_report"
    bl_label = "Force Report"


class OBJECT_OT_desire_path_forces_write(_Report, bpy.types.Operator):
    """Write every force and every contact of the walk as tables, loads.csv and contacts.csv"""

    bl_idname = "object.desire_path_forces_write"
    bl_label = "Write Tables"

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}


CLASSES = (
    OBJECT_OT_desire_path_forces_show,
    OBJECT_OT_desire_path_forces_graph,
    OBJECT_OT_desire_path_forces_report,
    OBJECT_OT_desire_path_forces_write,
)
