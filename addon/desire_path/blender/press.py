"""press.py - a hand that presses objects into a ground: what is behind the tool, without a window.

ground, objects --Press--> LivePress, View
objects' places --follow--> the ground answers and shows it      --undo, keep, drop-->
"""

from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix

from ..bake.press import LivePress, PressBody
from ..errors import DesirePathError
from ..ground.options import SimulationOptions
from ..motion import rotation
from . import axes, compat, ground, home, layered, op_ground, physics, playback, press_view, pressed, show
from .chosen import walkers

SHAPES = {"MESH", "CURVE", "SURFACE", "FONT", "META"}
DEEP = 0.2  # of its height a body is pressed down, if nobody says ..
LAYER = 0.8  # .. and no deeper than this share of the loose layer
CELL = 0.04  # side of a cell of a new ground, in widths of the body
FAR = 1e4  # the mouse reaches no farther [m]
SAME = 1e-6  # matrices whose numbers differ less are the same
WAS = ("is_ground", "cell_size", "bake_id", "bake_file", "bake_seen", "bake_name", "folder", "folder_auto")


@dataclass(eq=False)
class _Held:
    """An object that presses."""

    name: str
    turn: np.ndarray  # its matrix where it was taken up (4, 4)
    shape: PressBody
    low: float  # its lowest point under its origin [m]
    radius: float  # its farthest point from its origin [m]


def choose(context):
    """(the ground, the objects to press into it) among what is selected; DesirePathError where there are none.

    The ground is a selected one, or the widest mesh, or the only ground of the scene."""
    there = [each for each in context.selected_objects if each.type in SHAPES]
    known = [each for each in there if each.type == "MESH" and each.desire_path.is_ground]
    if not known:
        meshes = [each for each in there if each.type == "MESH" and not each.desire_path.is_walker]
        if len(there) > 1 and meshes:
            known = [max(meshes, key=lambda each: max(each.dimensions.x, each.dimensions.y))]
        elif there:
            known = [each for each in context.scene.objects if each.type == "MESH" and each.desire_path.is_ground]
    if len(known) != 1:
        raise DesirePathError("Select a ground, and beside it the objects to press into it.")
    bodies = [each for each in there if each != known[0]]
    if not bodies:
        raise DesirePathError(f"Select something to press into '{known[0].name}', too: any object with faces.")
    return known[0], bodies


def cell_for(wide):
    """A round side of cells that suits bodies so wide [m]."""
    power = 10.0 ** np.floor(np.log10(max(CELL * wide, 0.001)))
    return axes.typed(min((step * power for step in (1.0, 2.0, 5.0, 10.0)), key=lambda c: abs(np.log(c / CELL / wide))))


class Press:
    """Objects in hand, over a ground that answers.

    depth: how deep they are pressed [m], None = a share of their height; mass: of each [kg], 0 = the ground gives way
    to their shape, None = as they say themselves. sentences: sentences for the user
    """

    def __init__(self, context, obj, bodies, *, depth=None, mass=None):
        self.scene, self.name = context.scene, obj.name
        for each in (obj, *bodies):
            if each.library is not None:
                raise DesirePathError(
                    f"'{each.name}' is linked from another file: make a library override of it (Object > Library "
                    "Override > Make) first."
                )
        if obj.desire_path.plants:
            raise DesirePathError(
                f"Plants grow on '{obj.name}', which a hand does not bend: press before they are sown."
            )
        self.scale, self.sentences = axes.unit_scale(self.scene), []
        depsgraph = context.evaluated_depsgraph_get()
        self.held = [taken(each, depsgraph, self.scale, mass) for each in bodies]
        self.weighs = any(each.shape.mass is not None for each in self.held)
        height = min(float(np.ptp(each.shape.vertices[:, 2])) for each in self.held)
        layer = min(soil.layer_depth for soil in ground.soils(obj)) + layered.above(obj)
        self.depth = depth if depth else max(axes.typed(round(min(DEEP * height, LAYER * layer), 3)), 0.001)
        settings = obj.desire_path
        self.was = {name: getattr(settings, name) for name in WAS}
        try:
            self._begin(obj)
        except BaseException:
            self._give_back()
            raise

    def _begin(self, obj):
        settings = obj.desire_path
        if not settings.is_ground:
            self.sentences.append(op_ground.add(self.scene, obj))
            settings.cell_size = cell_for(min(np.ptp(each.shape.vertices, axis=0).max() for each in self.held))
        cell = axes.typed(settings.cell_size)
        self.surface = ground.read(self.scene, obj, cell, self.scene.frame_current)
        self.sentences += self.surface.warnings
        base, self.beneath = pressed.start(obj, self.surface.ground), pressed.mixed(obj)
        options = SimulationOptions(
            law=settings.law, heap=settings.heap, origin=self.surface.origin, threads=settings.threads
        )
        bodies = [each.shape for each in self.held]
        self.live = LivePress(base, bodies, ground.soils(obj), cell, options=options)
        self.view = press_view.View(self.scene, obj, self.surface, self.live)
        self.sentences += [*self.live.warnings, *self.view.warnings]
        if playback.modifier(obj) is not None and not pressed.plays(obj):
            self.sentences.append(f"'{obj.name}' is pressed as it is before its walk: bake again to see both.")
        self.before = None  # where the objects were in the last step
        plays = playback.modifier(obj) is not None
        self.view.show(self._boxes([each.turn[:2, 3] * self.scale for each in self.held]) if plays else ())

    # ---- the objects -----------------------------------------------------------------------------

    def objects(self):
        found = [bpy.data.objects.get(each.name) for each in self.held]
        if None in found or bpy.data.objects.get(self.name) is None:
            raise DesirePathError("The ground or what presses it is gone: nothing more can be pressed.")
        return found

    def matrices(self):
        """Where the objects are, as Blender has worked it out (B, 4, 4)."""
        depsgraph = bpy.context.evaluated_depsgraph_get()
        return np.array([each.evaluated_get(depsgraph).matrix_world for each in self.objects()], np.float64)

    def poses(self, matrices):
        """The same as poses (B, 7) [m]."""
        rigid = axes.rigid(matrices, self.scale)
        turn = rotation.quaternion(rotation.square(rigid[:, :3, :3]))
        return np.concatenate([rigid[:, :3, 3], turn], axis=1)

    def at(self, x, y, turn=0.0, *, down=False):
        """Matrices of the objects when the first one is over (x, y) [m], turned by `turn` about the vertical [rad]: on
        the ground, or down in it as far as they are to be pressed; None beside the ground."""
        first = self.held[0]
        spin = np.array(Matrix.Rotation(turn, 4, "Z"))
        out = []
        for number, each in enumerate(self.held):
            own = each.turn.copy()
            own[:3, 3] = 0.0
            own = spin @ own
            away = spin[:3, :3] @ (each.turn[:3, 3] - first.turn[:3, 3])
            own[:3, 3] = (x / self.scale + away[0], y / self.scale + away[1], 0.0)
            pose = self.poses(own[None])[0]
            gap = self.live.gap(pose, number, rest=down and each.shape.mass is None)
            if not np.isfinite(gap):
                if number == 0:
                    return None
                gap = 0.0
            lower = self.depth if down and each.shape.mass is None else 0.0
            own[2, 3] -= (gap + lower) / self.scale
            out.append(own)
        return np.array(out)

    def put(self, matrices):
        """Bring the objects there."""
        for obj, matrix in zip(self.objects(), matrices):
            obj.matrix_world = Matrix(matrix.tolist())

    def hit(self, origin, along, places):
        """Where a ray meets the ground before anybody pressed it (x, y) [m], or None; origin [m], along: unit vector;
        places: how many are looked at."""
        tops = self.surface.vertices[:, 2]
        low, high = float(tops.min()) - 0.01, float(tops.max()) + 0.01
        if abs(along[2]) > 1e-6:
            ends = sorted(((low - origin[2]) / along[2], (high - origin[2]) / along[2]))
        else:
            ends = [0.0, FAR]
        begin, end = max(ends[0], 0.0), min(ends[1], FAR)
        for _ in range(3):  # finer and finer around where it goes below
            if not begin < end:
                return None
            distances = np.linspace(begin, end, places)
            at = origin + distances[:, None] * along
            below = at[:, 2] - self.live.sim.rest_height(at[:, :2])
            under = np.flatnonzero((below[1:] <= 0.0) & (below[:-1] > 0.0))
            if not len(under):
                return None
            begin, end = distances[under[0]], distances[under[0] + 1]
        return float(at[under[0] + 1, 0]), float(at[under[0] + 1, 1])

    def masses(self):
        """Of those that have one [kg]."""
        return [each.mass for each in self.live.bodies if each.mass is not None]

    def weigh(self, times):
        """Make all that have a mass so many times heavier."""
        for number, each in enumerate(self.live.bodies):
            if each.mass is not None:
                self.live.weigh(number, min(max(each.mass * times, 0.001), 1e6))

    # ---- pressing --------------------------------------------------------------------------------

    def step(self, matrices, seconds=0.04):
        """Press with the objects where these matrices are; returns whether they touch the ground."""
        poses = self.poses(np.asarray(matrices, np.float64))
        touches = self.live.move(poses, seconds)
        self.before = np.array(matrices)
        if touches:
            self.view.show(self._boxes(poses[:, :2]))
        return touches

    def _boxes(self, places):
        """Rectangles (x0, y0, x1, y1) that the objects reach into from places (x, y) [m]."""
        return [
            (x - each.radius, y - each.radius, x + each.radius, y + each.radius)
            for each, (x, y) in zip(self.held, places)
        ]

    def follow(self, seconds=0.04):
        """Press with the objects where they are, if they were moved since; returns whether they were."""
        now = self.matrices()
        if self.before is not None and np.abs(now - self.before).max() < SAME:
            return False
        if self.live.pressing or any(self.live.gap(p, k) < 0.0 for k, p in enumerate(self.poses(now))):
            self.step(now, seconds)
        self.before = now
        return True

    def lift(self):
        """The stroke has ended."""
        self.live.lift()
        self.before = None
        self.view.show()

    def undo(self):
        """Take the last stroke back; returns whether there was one."""
        done = self.live.undo()
        if done:
            self.before = None
            self.view.show()
        return done

    # ---- the end ---------------------------------------------------------------------------------

    def keep(self):
        """What was pressed stays: a bake of its own, which plays where nobody walks; returns a sentence."""
        self.live.lift()
        obj = bpy.data.objects[self.name]
        inputs = pressed.marks(obj, self.surface) | self.beneath
        return stay(self.scene, obj, self.surface, self.live, self.sentences, inputs, self.view)

    def drop(self):
        """Nothing was pressed: the ground, and the objects, are as they were."""
        self.view.remove()
        self.live.drop()
        for each in self.held:
            obj = bpy.data.objects.get(each.name)
            if obj is not None:
                obj.matrix_world = Matrix(each.turn.tolist())
        self._give_back()

    def _give_back(self):
        obj = bpy.data.objects.get(self.name)
        if obj is None:
            return
        settings = obj.desire_path
        for name in sorted(self.was, key=lambda each: each == "folder_auto"):  # last: the folder says it was chosen
            if getattr(settings, name) != self.was[name]:
                setattr(settings, name, self.was[name])


def stay(scene, obj, surface, live, sentences, inputs, view=None):
    """What was pressed into a ground becomes a bake of its own, which plays where nobody walks; returns a sentence.

    sentences: gets what is to be said of it; inputs: a word for each part it was made from; view: what has shown it
    """
    settings = obj.desire_path
    walked = playback.modifier(obj) is not None and not pressed.plays(obj)
    home.claim(obj)
    place = pressed.next_place(obj)
    index = live.keep(
        bpy.path.abspath(place),
        frame=scene.frame_start,
        frame_rate=scene.render.fps / scene.render.fps_base,
        owner=settings.bake_id,
        inputs=inputs,
    )
    deepest = float(live.read("compression").max())
    if view is not None:
        view.remove()
    live.drop()
    pressed.replaced(obj)
    settings.pressed = place
    if not walked:
        settings.summary = ""
        _, warnings = show.play(scene, obj, surface, place=place)
        sentences += warnings
    text = f"'{obj.name}' stays as it was pressed, {1000 * deepest:.0f} mm deep at most; files in {index.folder}."
    if walkers(scene, obj):
        text += " Bake it again to walk over that."
    return text


def taken(obj, depsgraph, scale, mass):
    """An object as a body, as modifiers and its scale make it."""
    found = obj.evaluated_get(depsgraph)
    world = axes.matrix(found.matrix_world, obj.name)
    shown = found.to_mesh()
    if shown is None or not len(shown.polygons):
        found.to_mesh_clear()
        raise DesirePathError(f"'{obj.name}' has no faces to press the ground with: give it some, or select another.")
    points, faces = compat.positions(shown), compat.triangles(shown)
    found.to_mesh_clear()
    turned = axes.rigid(world[None], scale)[0]
    shape = np.eye(4)
    shape[:3, :3] = turned[:3, :3].T @ world[:3, :3]  # scale, mirror and shear
    vertices = axes.points(shape, points, scale)
    body = PressBody(vertices, faces, mass=_mass(obj) if mass is None else mass or None, name=obj.name)
    low = -float((vertices @ turned[:3, :3].T)[:, 2].min())
    return _Held(obj.name, world, body, low, float(np.linalg.norm(vertices, axis=1).max()))


def _mass(obj):
    """What an object says it weighs [kg]; None: nothing that is to be believed."""
    if obj.desire_path.is_walker and obj.desire_path.mass > 0.0:
        return axes.typed(obj.desire_path.mass)
    if physics.simulated(obj) and obj.rigid_body is not None:
        return axes.typed(obj.rigid_body.mass)
    return None
