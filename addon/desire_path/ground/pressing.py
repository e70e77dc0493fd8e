"""Ground that answers at once: bodies are moved over it by hand, one step after the other, through a live motion.

    PressBody, pose --move--> as many steps as the path is long --Simulation.push, run--> ground pressed so far
                    --lift--> the stroke has ended, its rims rest        --undo--> as it was before that stroke

A body with a mass sinks until the ground carries it; one without carves: the ground makes way, whatever it weighs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Record
from ..core import _native
from ..errors import DesirePathError
from ..motion.gait import HEEL, Gait, Sole
from ..motion.recording import AUTO
from ..motion.rotation import turned
from .ground import as_lasting_soils
from .options import SimulationOptions
from .sim import TILE, Ground, Simulation
from .trail import LEFT, Trail

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import ArrayLike

    from .soil import Soil

TOUCH = 5e-4  # a body that hovers no higher than this touches [m]
AROUND = 0.3  # a body changes the ground no farther away than this [m]
STEP = 0.04  # how long a step takes, if nobody says [s]
MAX_STEPS = 64  # that one move is cut into
SWEPT = 12.0  # a body that carves is swept so far in a step [cells]
MAX_CELLS = 1 << 20  # a body may cover
SLIDES = 30.0  # walls that take their time come to rest in so many times what a slide of 0.1 m takes them
SAMPLE = 0.0025  # undersides are sampled so closely, or four times a cell [m]
GRAVITY = 9.81  # [m/s^2]


@dataclass(frozen=True, eq=False, repr=False)
class PressBody(Record):
    """A rigid body that presses."""

    vertices: np.ndarray  # in its own axes (n, 3) [m]
    triangles: np.ndarray  # (m, 3)
    mass: float | None = None  # [kg] > 0; None: the ground gives way to its shape, whatever it weighs
    name: str = "Body"

    def __post_init__(self) -> None:
        vertices, triangles = np.asarray(self.vertices, np.float64), np.asarray(self.triangles)
        if triangles.size == 0 or vertices.ndim != 2 or vertices.shape[1] != 3 or triangles.ndim != 2:
            raise DesirePathError(f"'{self.name}' has no faces to press the ground with: give it some.")
        if triangles.shape[1] != 3 or triangles.min() < 0 or triangles.max() >= len(vertices):
            raise DesirePathError(f"'{self.name}' has a face without its vertices: repair the mesh.")
        if not np.isfinite(vertices).all():
            raise DesirePathError(f"'{self.name}' has NaN or infinite vertices: repair the mesh.")
        if self.mass is not None and not (math.isfinite(self.mass) and 0.0 < self.mass < 1e9):
            raise DesirePathError(f"A mass of {self.mass:g} kg for '{self.name}' is none: give more than 0, or none.")
        object.__setattr__(self, "vertices", np.ascontiguousarray(vertices, np.float32))
        object.__setattr__(self, "triangles", np.ascontiguousarray(triangles, np.int32))
        super().__post_init__()


@dataclass(frozen=True)
class _Contact:
    """A body over the ground."""

    gap: float  # from the ground up to its underside, < 0 where it reaches into it; inf beside the ground [m]
    rest_gap: float  # the same from the ground before anybody pressed it [m]
    point: tuple[float, float, float]  # where it presses [m]


class Pressing:
    """Ground under bodies that are moved by hand.

    ground, soils, cell_size, options: as for Simulation; bodies: PressBody, or several of them
    sim: the Simulation as it is now; window: cells (i0, i1, j0, j1) that may have changed, None before the first stroke
    """

    def __init__(
        self,
        ground: Ground,
        bodies: PressBody | Iterable[PressBody],
        soils: str | Soil | Iterable[str | Soil] = "dry-sand",
        cell_size: float = 0.01,
        *,
        options: SimulationOptions = SimulationOptions(),
    ) -> None:
        self.ground, self.soils = ground, as_lasting_soils(soils)
        self.cell_size, self.options = float(cell_size), options
        self.bodies = (bodies,) if isinstance(bodies, PressBody) else tuple(bodies)
        if not self.bodies:
            raise DesirePathError("There is no body to press the ground with: give one at least.")
        flows = [*self.soils, *(layer.soil for layer in ground.layers)]
        self.slides = SLIDES * max(float(soil.flow_time) for soil in flows)  # until all lies still [s]
        self.window: tuple[int, int, int, int] | None = None
        self._before: list[tuple[tuple[int, int, int, int] | None, Trail | None]] = []  # of each stroke
        self._under = [(each.vertices, each.triangles) for each in self.bodies]  # what finds where a body stands
        self._turned: list[tuple[np.ndarray, np.ndarray] | None] = [None] * len(self.bodies)
        self._at: np.ndarray | None = None  # poses of the stroke on its way (B, 7)
        self._open(ground)
        self.warnings = list(self.sim.warnings)
        if ground.trail is not None:
            left = ground.trail
            x0, y0 = left.x0, left.y0
            ny, nx = left.rest.shape
            self.window = self._clipped(self.sim.cells((x0, y0, x0 + nx * left.cell, y0 + ny * left.cell)))

    def __repr__(self) -> str:
        names = ", ".join(f"'{each.name}'" for each in self.bodies)
        return f"{type(self).__name__}({names}, {self.strokes} strokes)"

    @property
    def strokes(self) -> int:
        """How many there were, with the one on its way."""
        return len(self._before)

    @property
    def pressing(self) -> bool:
        """Whether a stroke is on its way."""
        return self._at is not None

    def _open(self, ground: Ground) -> None:
        count = len(self.bodies)
        self.sim = Simulation(ground, self.soils, self.cell_size, options=self.options)
        self._time, self._samples = 0.0, 0
        still = np.zeros((count, 2, 7))
        still[..., 3] = 1.0
        one = np.arange(count)
        self.sim.load_live(
            Gait(
                time=np.arange(2.0),
                com=np.zeros((count, 2, 3)),
                mass=np.array([each.mass or 1.0 for each in self.bodies]),
                pose=still,
                limb_walker=one,
                part_limb=one,
                soles=tuple(Sole(each.vertices, each.triangles) for each in self.bodies),
                point=np.zeros((count, 3)),
                point_part=one,
                point_role=np.full(count, HEEL),
                contact_law=tuple("carve" if each.mass is None else AUTO for each in self.bodies),
                limb_name=tuple(each.name for each in self.bodies),
                part_name=("body",) * count,
                walker_name=tuple(each.name for each in self.bodies),
                frame_rate=1.0 / STEP,
                frame_start=1,
            )
        )

    # ---- strokes ---------------------------------------------------------------------------------

    def move(self, pose: ArrayLike, seconds: float = STEP) -> bool:
        """Move the bodies to a pose (7,), or one of each (B, 7): place [m] and unit quaternion (w, x, y, z), in a
        straight line from where the stroke has come to, or begin one there. Returns whether anything touches the
        ground there. seconds: how long it takes [s] > 0
        """
        poses = self._checked(pose)
        if not (math.isfinite(seconds) and 0.0 < seconds < 1e4):
            raise DesirePathError(f"A move of {seconds} seconds cannot be made: give more than 0.")
        if self._at is None:
            self._before.append((self.window, self._left()))
            self._at = poses
            self._step(poses, STEP)
            return self._step(poses, seconds)
        start, steps = self._at, self._steps(self._at, poses)
        touches = False
        for number in range(1, steps + 1):
            share = number / steps
            between = (1.0 - share) * start + share * poses if number < steps else poses
            between[:, 3:] /= np.linalg.norm(between[:, 3:], axis=1)[:, None]
            touches = self._step(between, seconds / steps)
        return touches

    def lift(self) -> None:
        """Lift the bodies: the stroke has ended, and its rims come to rest."""
        if self._at is None:
            return
        at, self._at = self._at, None
        nothing = np.zeros((len(at), 3))
        self._push(at, np.zeros(len(at), bool), nothing, nothing, STEP)
        self.wait(max(STEP, self.slides))

    def wait(self, seconds: float = STEP) -> None:
        """Let time pass in which nothing presses: what takes its time slides on [s]."""
        if self._at is not None or not self._samples:
            return
        nowhere = np.zeros((len(self.bodies), 7))
        nowhere[:, 3] = 1.0
        nothing = np.zeros((len(self.bodies), 3))
        self._push(nowhere, np.zeros(len(nowhere), bool), nothing, nothing, seconds, present=False)

    def undo(self) -> bool:
        """Take the last stroke back; returns whether there was one."""
        if not self._before:
            return False
        window, left = self._before.pop()
        self._at = None
        self.sim.close()
        self._open(self.ground if left is None else replace(self.ground, trail=left))
        self.window = window
        return True

    def weigh(self, body: int, mass: float) -> None:
        """Let a body (its number) that has a mass have another one from now on [kg]."""
        if self.bodies[body].mass is None:
            raise DesirePathError(f"'{self.bodies[body].name}' presses by its shape: give it a mass when it is made.")
        heavier = replace(self.bodies[body], mass=float(mass))
        self.bodies = (*self.bodies[:body], heavier, *self.bodies[body + 1 :])

    def drop(self) -> None:
        """Give all of it up."""
        self._before.clear()
        self._at = None
        self.sim.close()

    # ---- what can be asked -----------------------------------------------------------------------

    def gap(self, pose: ArrayLike, body: int = 0, *, rest: bool = False) -> float:
        """How far a body (its number) at a pose (7,) stands above the ground, as that is now or, `rest`, as it was
        before anybody pressed it: less than 0 where it reaches into it; inf beside the ground [m]."""
        at = np.asarray(pose, np.float64)
        if at.shape != (7,) or not np.isfinite(at).all():
            raise DesirePathError("A pose is a place and a unit quaternion: give 7 finite numbers.")
        found = self._contact(body, at)
        return found.rest_gap if rest else found.gap

    def read(self, name: str) -> np.ndarray:
        """A field of the window, as Simulation.read() gives it, float32 (ny, nx)."""
        if self.window is None:
            raise DesirePathError("Nothing was pressed yet: move a body first.")
        i0, i1, j0, j1 = self.window
        return self.sim.read(name, i0, j0, i1 - i0, j1 - j0)

    def picture(self, i0: int, j0: int, nx: int, ny: int) -> np.ndarray:
        """What a frame for playback shows of cells: height change [m], plant strength, compression [m], pressure_time
        [Pa s]; float32 (ny, nx, 4)."""
        out = np.empty((ny, nx, 4), np.float32)
        out[..., 2] = self.sim.read("compression", i0, j0, nx, ny)
        out[..., 0] = self.sim.read("heap", i0, j0, nx, ny) - out[..., 2]
        out[..., 1] = self.sim.read("plant_strength", i0, j0, nx, ny)
        out[..., 3] = self.sim.read("pressure_time", i0, j0, nx, ny)
        return out

    def tiles(self) -> tuple[int, int, int, int]:
        """Tiles (x, y, nx, ny) of TILE cells a side around what may have changed."""
        if self.window is None:
            raise DesirePathError("Nothing was pressed yet: move a body first.")
        i0, i1, j0, j1 = self.window
        x, y = i0 // TILE, j0 // TILE
        return x, y, -(-i1 // TILE) - x, -(-j1 // TILE) - y

    # ---- steps -----------------------------------------------------------------------------------

    def _checked(self, pose: ArrayLike) -> np.ndarray:
        poses = np.array(pose, np.float64)
        if poses.ndim == 1:
            poses = poses[None]
        if poses.shape != (len(self.bodies), 7) or not np.isfinite(poses).all() or np.abs(poses[:, :3]).max() > 1e9:
            raise DesirePathError(
                f"{len(self.bodies)} bodies need as many poses of 7 finite numbers: a place and a unit quaternion."
            )
        size = np.linalg.norm(poses[:, 3:], axis=1)
        if (np.abs(size - 1.0) > 1e-3).any():
            raise DesirePathError("A pose has a rotation that is no unit quaternion: give (w, x, y, z) of length 1.")
        poses[:, 3:] /= size[:, None]
        before = poses if self._at is None else self._at
        poses[(poses[:, 3:] * before[:, 3:]).sum(axis=1) < 0.0, 3:] *= -1.0  # the same turn, the short way round
        return poses

    def _steps(self, start: np.ndarray, end: np.ndarray) -> int:
        """Into how many steps a move is cut so that no body jumps over ground; who carves sweeps it by itself."""
        distance = np.linalg.norm(end[:, :3] - start[:, :3], axis=1)
        wide = np.array([float(np.ptp(each.vertices[:, :3], axis=0).max()) for each in self.bodies])
        turn = np.linalg.norm(end[:, 3:] - start[:, 3:], axis=1) * wide
        carves = np.array([each.mass is None for each in self.bodies])
        long = np.where(carves, SWEPT * self.cell_size, np.maximum(2.0 * self.cell_size, 0.1 * wide))
        return int(np.clip(math.ceil(float(((distance + turn) / long).max())), 1, MAX_STEPS))

    def _step(self, poses: np.ndarray, seconds: float) -> bool:
        """One step of a stroke; returns whether anything touches."""
        found = [self._contact(number, pose) for number, pose in enumerate(poses)]
        touching = np.array([each.gap <= TOUCH for each in found])
        force, point = np.zeros((len(found), 3)), np.array([each.point for each in found])
        for number, body in enumerate(self.bodies):
            if touching[number]:
                self._grow(body, poses[number])
                force[number, 2] = -body.mass * GRAVITY if body.mass is not None else 0.0
        carves = np.array([body.mass is None for body in self.bodies])  # wherever it meets ground
        self._push(poses, touching | carves, force, point, seconds)
        self._at = poses
        return bool(touching.any())

    def _push(
        self,
        poses: np.ndarray,
        touching: np.ndarray,
        force: np.ndarray,
        point: np.ndarray,
        seconds: float,
        *,
        present: bool = True,
    ) -> None:
        self._time += seconds
        there = np.full(len(poses), present)
        self.sim.push(self._time, poses, touching, force, point, there)
        self.sim.run(self._samples)
        self._samples += 1

    def _left(self) -> Trail | None:
        """The ground as it is, None: as it was given."""
        if self.window is None or self.strokes == 0 and self.ground.trail is not None:
            return self.ground.trail
        i0, _, j0, _ = self.window
        (ox, oy), cell = self.options.origin, self.cell_size
        rest = self.read("rest")
        grids = {name: self.read(name) for name in LEFT}
        return Trail("", cell, ox + i0 * cell, oy + j0 * cell, rest, **grids, flat=False, planted=False)

    def _grow(self, body: PressBody, pose: np.ndarray) -> None:
        """The window reaches as far as a body can change the ground."""
        wide = float(np.linalg.norm(body.vertices, axis=1).max()) + AROUND
        x, y = pose[:2]
        i0, i1, j0, j1 = self._clipped(self.sim.cells((x - wide, y - wide, x + wide, y + wide)))
        if self.window is not None:
            a0, a1, b0, b1 = self.window
            i0, i1, j0, j1 = min(i0, a0), max(i1, a1), min(j0, b0), max(j1, b1)
        self.window = (i0, i1, j0, j1)

    def _clipped(self, cells: Sequence[int]) -> tuple[int, int, int, int]:
        """What of some cells lies within the ground's bounds."""
        i0, i1, j0, j1 = cells
        box = self.sim.bounds()
        if math.isfinite(box[0]):
            a0, a1, b0, b1 = self.sim.cells(box)
            i0, j0 = min(max(i0, a0), a1 - 1), min(max(j0, b0), b1 - 1)
            i1, j1 = max(min(i1, a1), i0 + 1), max(min(j1, b1), j0 + 1)
        return i0, i1, j0, j1

    # ---- where a body stands ---------------------------------------------------------------------

    def _contact(self, number: int, pose: np.ndarray) -> _Contact:
        """A body over the ground as it is now."""
        body, cell, (ox, oy) = self.bodies[number], self.cell_size, self.options.origin
        vertices, triangles = self._under[number]
        known = self._turned[number]
        if known is None or not np.array_equal(known[0], pose[3:]):
            known = self._turned[number] = (pose[3:].copy(), turned(pose[3:], vertices.astype(np.float64)))
        at = known[1][:, :2]
        low, high = at.min(axis=0) + pose[:2], at.max(axis=0) + pose[:2]
        i0, j0 = math.floor((low[0] - ox) / cell) - 1, math.floor((low[1] - oy) / cell) - 1
        nx, ny = math.floor((high[0] - ox) / cell) + 2 - i0, math.floor((high[1] - oy) / cell) + 2 - j0
        if nx * ny > MAX_CELLS:
            raise DesirePathError(
                f"'{body.name}' is {max(high - low):.3g} m wide, too large for cells of {cell:g} m: choose larger ones."
            )
        rest, pressed, heap = (self.sim.read(name, i0, j0, nx, ny) for name in ("rest", "compression", "heap"))
        there = np.isfinite(rest)
        base = float(rest[there].mean()) if there.any() else 0.0
        bottom, cover = np.empty((ny, nx), np.float32), np.empty((ny, nx), np.float32)
        lifted = pose.copy()
        lifted[2] -= base
        _native.imprint_foot(
            [(vertices, triangles)],
            lifted[None],
            ox + (i0 + 0.5) * cell,
            oy + (j0 + 0.5) * cell,
            cell,
            min(max(round(cell / SAMPLE), 1), 4),
            bottom,
            cover,
        )
        on = (cover > 0.0) & there
        if not on.any():
            return _Contact(math.inf, math.inf, (float(pose[0]), float(pose[1]), base))
        below = rest.astype(np.float64) - base
        gap = float((bottom - below - heap + pressed)[on].min())
        rest_gap = float((bottom - below)[on].min())
        j, i = np.nonzero(on)
        weight = np.maximum(-(bottom - below)[on].astype(np.float64), 0.0) * cover[on] + 1e-9
        x, y = ((weight * k).sum() / weight.sum() for k in (i, j))
        point = (ox + (i0 + 0.5 + x) * cell, oy + (j0 + 0.5 + y) * cell, base)
        return _Contact(gap, rest_gap, point)
