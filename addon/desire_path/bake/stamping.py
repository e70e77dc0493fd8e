"""Tracks of stamps, pressed at once: each mark straight down and up again, one step a mark. PEYRAT11, MODEL 3.8

    Laid --TrackPress.press--> ground with its marks --keep--> folder/frames, maps_final.exr, report.json

    laid = track.lay([(0, 0), (20, 0)], "boot")
    TrackPress(Ground.flat(), laid, "wet-sand", 0.005).press().keep("pressed")

Marks are pressed in their order; some that do not meet come down in one step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from ..errors import DesirePathError
from ..ground.options import SimulationOptions
from ..ground.pressing import AROUND, GRAVITY, PressBody
from ..ground.sim import Ground
from ..ground.soil import Soil
from ..placement.marks import SIDES, Laid
from .press import LivePress

__all__ = ["TrackPress"]

AT_ONCE = 8  # feet that press in one step
HEAPS = 1.35  # soles are so many times wider with their heaps, for telling which marks meet
LIFTS = 0.01  # time from one step to the next [s]
MOST_CELLS = 1 << 28  # the rectangle around all marks may have so many

Kind = tuple[int, bool, float]  # track, left foot, size


class TrackPress(LivePress):
    """Ground and the marks of tracks to be pressed into it.

    laid: track.lay(), or several of them, one pressed after the other; the others as for Simulation
    """

    def __init__(
        self,
        ground: Ground,
        laid: Laid | Iterable[Laid],
        soils: str | Soil | Iterable[str | Soil] = "dry-sand",
        cell_size: float = 0.01,
        *,
        options: SimulationOptions = SimulationOptions(),
    ) -> None:
        self.tracks = (laid,) if isinstance(laid, Laid) else tuple(laid)
        self._marks = [
            ((number, bool(left), float(size)), pose)
            for number, each in enumerate(self.tracks)
            for left, size, pose in zip(each.left, each.size, each.pressed_pose())
        ]
        if not self._marks:
            raise DesirePathError("There is no mark to press: lay a track first.")
        self._pressed = 0
        self._feet: dict[Kind, list[int]] = {kind: [] for kind, _ in self._marks}
        bodies = [self._body(kind) for kind in self._feet]
        for number, kind in enumerate(list(self._feet) * max(AT_ONCE // len(bodies), 1)):
            self._feet[kind].append(number)
        super().__init__(ground, bodies * max(AT_ONCE // len(bodies), 1), soils, cell_size, options=options)
        self._stands = max(float(soil.settle_time) for soil in self.soils)

    def _body(self, kind: Kind) -> PressBody:
        number, left, size = kind
        track = self.tracks[number]
        sole = track.stamp.sole(left, size)
        return PressBody(
            sole.vertices, sole.triangles, None if track.depth > 0.0 else track.mass, f"{track.name} {SIDES[not left]}"
        )

    @property
    def strokes(self) -> int:
        """How many marks were pressed."""
        return self._pressed

    def press(self, progress: Callable[[float], object] | None = None) -> TrackPress:
        """Press all marks that are not pressed yet; progress is told the share that is. Returns itself."""
        reach = self._widen()
        step: dict[int, np.ndarray] = {}  # the pose of each foot that presses
        for number, (kind, pose) in enumerate(self._marks[self._pressed :], self._pressed):
            foot = next((each for each in self._feet[kind] if each not in step), None)
            near = [HEAPS * (reach[kind] + reach[other]) for other in self._kinds(step)]
            if foot is None or _meets(pose, step.values(), near):
                self._press_step(step)
                self._pressed, step, foot = number, {}, self._feet[kind][0]
                if progress is not None:
                    progress(number / len(self._marks))
            step[foot] = pose
        if step:
            self._press_step(step)
        self._pressed = len(self._marks)
        return self

    def _kinds(self, feet: Iterable[int]) -> list[Kind]:
        kinds = list(self._feet)
        return [kinds[foot % len(kinds)] for foot in feet]

    def _widen(self) -> dict[Kind, float]:
        """The window reaches as far as marks change the ground; returns how far each kind reaches itself [m]."""
        reach = {
            kind: float(np.linalg.norm(self.bodies[feet[0]].vertices[:, :2], axis=1).max())
            for kind, feet in self._feet.items()
        }
        places = np.array([pose[:2] for _, pose in self._marks])
        wide = np.array([reach[kind] + AROUND for kind, _ in self._marks])[:, None]
        (x0, y0), (x1, y1) = (places - wide).min(axis=0), (places + wide).max(axis=0)
        i0, i1, j0, j1 = self._clipped(self.sim.cells((x0, y0, x1, y1)))
        if (i1 - i0) * (j1 - j0) > MOST_CELLS:
            raise DesirePathError(
                f"The tracks lie in {(i1 - i0) * (j1 - j0):.3g} cells of {self.cell_size:g} m: choose larger cells."
            )
        if self.window is not None:
            a0, a1, b0, b1 = self.window
            i0, i1, j0, j1 = min(i0, a0), max(i1, a1), min(j0, b0), max(j1, b1)
        self.window = (i0, i1, j0, j1)
        return reach

    def _press_step(self, step: dict[int, np.ndarray]) -> None:
        """Some feet come down at once, stand until the ground has yielded, and are lifted."""
        count = len(self.bodies)
        pose, there = np.zeros((count, 7)), np.zeros(count, np.uint8)
        pose[:, 3] = 1.0
        force, point = np.zeros((count, 3)), np.full((count, 3), np.nan)
        for number, at in step.items():
            pose[number], point[number], there[number] = at, at[:3], 1
            force[number, 2] = -(self.bodies[number].mass or 0.0) * GRAVITY
        nobody = np.zeros(count, np.uint8)
        for seconds, present in ((LIFTS, there), (self._stands, there), (LIFTS, nobody)):
            self._time += seconds
            self.sim.push(self._time, pose, present, force, point, present)
            self._samples += 1
        self.sim.run(self._samples - 1)


def _meets(pose: np.ndarray, others: Iterable[np.ndarray], near: Sequence[float]) -> bool:
    """Whether a pose is nearer to one of others than is told of each [m]."""
    return any(np.hypot(*(pose[:2] - other[:2])) < wide for other, wide in zip(others, near))
