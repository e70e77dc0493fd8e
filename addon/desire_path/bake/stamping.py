"""Tracks pressed at once: marks of stamps, each straight down and up again in one step, and wheels that roll along.

    Laid, or a Gait of wheels --TrackPress.press--> ground with its tracks --keep--> folder/frames, maps_final.exr ..

    tracks = [lay([(0, 0), (20, 0)], "boot"), rolled([(5, -5), (5, 5)], Wheel(0.33))]
    TrackPress(Ground.flat(), tracks, "wet-sand", 0.005).press().keep("pressed")

Marks are pressed in their order; some that do not meet come down in one step. PEYRAT11, MODEL 3.8
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from ..errors import DesirePathError
from ..ground import materials
from ..ground.options import SimulationOptions
from ..ground.pressing import AROUND, GRAVITY, TOUCH, PressBody
from ..ground.sim import Ground, as_soils
from ..ground.soil import Soil
from ..motion.gait import Gait
from ..placement import tyre
from ..placement.marks import SIDES, Laid
from .press import LivePress

__all__ = ["TrackPress"]

AT_ONCE = 8  # feet that press in one step
HEAPS = 1.35  # soles are so many times wider with their heaps, for telling which marks meet
LIFTS = 0.01  # time from one step to the next [s]
MAX_CELLS = 1 << 28  # the rectangle around all marks may have so many

Kind = tuple[int, bool, float]  # track, left foot, size


class TrackPress(LivePress):
    """Ground and the tracks to be pressed into it, one after the other.

    tracks: marks.lay() or track.rolled(), or several of them; the others as for Simulation
    """

    def __init__(
        self,
        ground: Ground,
        tracks: Laid | Gait | Iterable[Laid | Gait],
        soils: str | Soil | Iterable[str | Soil] = "dry-sand",
        cell_size: float = 0.01,
        *,
        options: SimulationOptions = SimulationOptions(),
    ) -> None:
        self.tracks = (tracks,) if isinstance(tracks, (Laid, Gait)) else tuple(tracks)
        self._marks = {n: _marks_of(n, each) for n, each in enumerate(self.tracks) if isinstance(each, Laid)}
        if not self.tracks or not all(self._marks.values()):
            raise DesirePathError("There is no mark to press: lay a track first.")
        self._done = self._pressed = 0
        self._feet: dict[Kind, list[int]] = {kind: [] for marks in self._marks.values() for kind, _ in marks}
        sticky = materials.sticky([*as_soils(soils), *(each.soil for each in ground.layers)])
        of_each = 1 if sticky else AT_ONCE // max(len(self._feet), 1)  # one foot carries on
        self._kinds = list(self._feet) * max(of_each, 1)
        for number, kind in enumerate(self._kinds):
            self._feet[kind].append(number)
        soles = {kind: self._body(kind) for kind in self._feet}
        bodies = [soles[kind] for kind in self._kinds]
        self._wheels: dict[int, range] = {}  # bodies of each track of wheels
        for n, each in enumerate(self.tracks):
            if isinstance(each, Gait):
                self._wheels[n] = range(len(bodies), len(bodies) + len(each.soles))
                bodies += _wheels_of(each)
        super().__init__(ground, bodies, soils, cell_size, options=options)
        for wheels in self._wheels.values():
            for number in wheels:  # stands on its lugs as a drum would
                vertices, triangles = tyre.drum(bodies[number].vertices)
                self._under[number] = vertices.astype(np.float32), triangles
        yields = [*self.soils, *(layer.soil for layer in ground.layers)]
        self._stands = max(float(soil.settle_time) for soil in yields)

    def _body(self, kind: Kind) -> PressBody:
        number, left, size = kind
        track = self.tracks[number]
        assert isinstance(track, Laid)
        sole = track.stamp.sole(left, size)
        return PressBody(
            sole.vertices, sole.triangles, None if track.depth > 0.0 else track.mass, f"{track.name} {SIDES[not left]}"
        )

    @property
    def strokes(self) -> int:
        """How many marks were pressed, and wheels rolled."""
        return self._pressed

    def press(self, progress: Callable[[float], object] | None = None) -> TrackPress:
        """Press all tracks that are not pressed yet; progress is told the share that is. Returns itself."""
        radius = self._widen()
        for number in range(self._done, len(self.tracks)):

            def report(share: float, before: int = number) -> None:
                if progress is not None:
                    progress((before + share) / len(self.tracks))

            track = self.tracks[number]
            if isinstance(track, Laid):
                self._stamp(self._marks[number], radius, report)
            else:
                self._roll(track, self._wheels[number], report)
            self._done = number + 1
        return self

    def _widen(self) -> list[float]:
        """The window reaches as far as tracks change the ground; returns how far each body reaches itself [m]."""
        radius = [float(np.linalg.norm(body.vertices[:, :2], axis=1).max()) for body in self.bodies]
        boxes = []
        for number, track in enumerate(self.tracks):
            if isinstance(track, Laid):
                places = np.array([pose[:2] for _, pose in self._marks[number]])
                wide = max(radius[self._feet[kind][0]] for kind, _ in self._marks[number])
            else:
                places, wide = np.asarray(track.pose)[..., :2].reshape(-1, 2), max(radius)
            boxes.append((*(places.min(axis=0) - wide - AROUND), *(places.max(axis=0) + wide + AROUND)))
        box = np.array(boxes)
        i0, i1, j0, j1 = self._clipped(self.sim.cells((*box[:, :2].min(axis=0), *box[:, 2:].max(axis=0))))
        if (i1 - i0) * (j1 - j0) > MAX_CELLS:
            raise DesirePathError(
                f"The tracks lie in {(i1 - i0) * (j1 - j0):.3g} cells of {self.cell_size:g} m: choose larger cells."
            )
        if self.window is not None:
            a0, a1, b0, b1 = self.window
            i0, i1, j0, j1 = min(i0, a0), max(i1, a1), min(j0, b0), max(j1, b1)
        self.window = (i0, i1, j0, j1)
        return radius

    # ---- stamps ----------------------------------------------------------------------------------

    def _stamp(
        self, marks: Sequence[tuple[Kind, np.ndarray]], radius: Sequence[float], report: Callable[[float], None]
    ) -> None:
        step: dict[int, np.ndarray] = {}  # the pose of each foot that presses
        for number, (kind, pose) in enumerate(marks):
            foot = next((each for each in self._feet[kind] if each not in step), None)
            near = [HEAPS * (radius[self._feet[kind][0]] + radius[other]) for other in step]
            if foot is None or _meets(pose, step.values(), near):
                self._stand(step)
                step, foot = {}, self._feet[kind][0]
                report(number / len(marks))
            step[foot] = pose
        self._stand(step)

    def _stand(self, step: dict[int, np.ndarray]) -> None:
        """Some feet come down at once, stand until the ground has yielded, and are lifted; all lies still then."""
        count = len(self.bodies)
        pose, there, force, point = _nowhere(count)
        for number, at in step.items():
            pose[number], point[number], there[number] = at, at[:3], 1
            force[number, 2] = -(self.bodies[number].mass or 0.0) * GRAVITY
        nobody = np.zeros(count, np.uint8)
        for seconds, present in ((LIFTS, there), (self._stands, there), (max(LIFTS, self.slides), nobody)):
            self._next(seconds, pose, present, force, point, present)
        self.sim.run(self._samples - 1)
        self._pressed += len(step)

    # ---- wheels ----------------------------------------------------------------------------------

    def _roll(self, gait: Gait, wheels: range, report: Callable[[float], None]) -> None:
        """Wheels roll along; each touches where it meets the ground, as that was or as it is then."""
        pose, there, force, point = _nowhere(len(self.bodies))
        touching = there.copy()
        there[wheels.start : wheels.stop] = 1
        times, poses = gait.time, np.asarray(gait.pose)
        for t in range(len(times)):
            for number, at in zip(wheels, poses[:, t]):
                body, found = self.bodies[number], self._contact(number, at)
                pose[number], point[number] = at, found.point
                touching[number] = min(found.gap, found.rest_gap) <= TOUCH or body.mass is None
                force[number, 2] = -(body.mass or 0.0) * GRAVITY * touching[number]
            self._next(times[t] - times[t - 1] if t else LIFTS, pose, touching, force, point, there)
            self.sim.run(self._samples - 1)
            report((t + 1) / len(times))
        nobody = np.zeros_like(there)
        self._next(LIFTS, pose, nobody, 0.0 * force, point, nobody)
        self.sim.run(self._samples - 1)
        self._pressed += len(wheels)

    def _next(
        self,
        seconds: float,
        pose: np.ndarray,
        touching: np.ndarray,
        force: np.ndarray,
        point: np.ndarray,
        there: np.ndarray,
    ) -> None:
        """The next sample, so much later."""
        self._time += seconds
        self.sim.push(self._time, pose, touching, force, point, there)
        self._samples += 1


def _marks_of(number: int, laid: Laid) -> list[tuple[Kind, np.ndarray]]:
    """Which foot presses each mark, and its pose (7,)."""
    feet = zip(laid.left.tolist(), laid.size.tolist())
    return [((number, *foot), pose) for foot, pose in zip(feet, laid.pressed_pose())]


def _wheels_of(gait: Gait) -> list[PressBody]:
    owner = gait.limb_walker[gait.part_limb]
    return [
        PressBody(sole.vertices, sole.triangles, None if carves else float(gait.mass[owner[part]]), gait.bone(part))
        for part, (sole, carves) in enumerate(zip(gait.soles, gait.carving()[owner]))
    ]


def _nowhere(count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Poses, who is there, forces and points of bodies that are not there."""
    pose = np.zeros((count, 7))
    pose[:, 3] = 1.0
    return pose, np.zeros(count, np.uint8), np.zeros((count, 3)), np.full((count, 3), np.nan)


def _meets(pose: np.ndarray, others: Iterable[np.ndarray], near: Sequence[float]) -> bool:
    """Whether a pose is nearer to one of others than is told of each [m]."""
    return any(np.hypot(*(pose[:2] - other[:2])) < wide for other, wide in zip(others, near))
