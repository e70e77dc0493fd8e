"""From a recording to a folder of EXR files: frames for playback, maps, and a report.

    folder/frames/trail_0000.exr   the ground at rest (all zero)
    folder/frames/trail_0001.exr   the first frame, then one file a frame
    folder/frames/pages.exr        which ground they show, where that is not all: see atlas.py
    folder/frames/lean_0001.exr    with plants: how the grass lies, likewise from lean_0000.exr on
    folder/frames/spray_0001.exr   with spray: what flies, likewise; see ground/spray.py
    folder/frames/index.json       where the frames lie and which are there
    folder/maps/second_0001.exr    the maps after every simulated second, TRAIL 4.3
    folder/maps/pass_0001.exr      or after a pass, where a frame is a pass
    folder/maps_start.exr          a picture: young_modulus_in, plant_strength_in, plant_strength, rest
    folder/maps_final.exr          compression, heap, pressure_time, plant_strength, rest, pressure; lean_x ..
    folder/plants.pc2, plants.npz  when asked for: the plants themselves, see plant_mesh.py
    folder/report.json             what happened, in numbers

A bake grows in folder/bake.new and takes the place of an earlier one, which is shown until then, when it is
whole: output.py says how. One that was stopped stays: the same bake started again goes on from its last state, see
state.py. Files of others in these folders are left alone.
"""

from __future__ import annotations

import contextlib
import os
import time
import weakref
from collections.abc import Generator, Iterable, Iterator
from dataclasses import dataclass
from types import TracebackType
from typing import Any

from .. import memory
from ..bounds import check_reserve
from ..errors import DesirePathError
from ..ground.parcels import Parcel
from ..ground.sim import Ground, Simulation, check_cell
from ..ground.spray import Spray, check_soles
from ..keywords import fields_of
from ..loads.force import FootForce
from ..motion.gait import Gait
from .checks import check_grounds, check_walk, lost_soles
from .folder import FORMAT, FrameIndex, free, read_index  # noqa: F401  (found here by those who bake)
from .grounds import BESIDE, parcels_of, simulations
from .options import FILMS, BakeOptions, BakeOutput  # noqa: F401
from .output import Output
from .plan import SAMPLE_RATE, Plan  # noqa: F401
from .report import of_share, summary
from .share import Share
from .state import States


@dataclass(frozen=True)
class Progress:
    """How far a bake has come."""

    frame: int  # scene frame just simulated; it is written while the next ones are
    fraction: float  # 0..1


class Bake(Plan):
    """One bake: create it, run it, read its report.

    gait: Gait; ground: Ground; soils as for Simulation; folder: where the files go.
    ground may be a list of Parcels, as the tiles of a terrain, which are pressed as one: each has its own soils,
    folder, plants and owner then, those named here are not asked for, and `shares` tells which were trodden.
    cell_size [m]; plants: as for Simulation.
    options: BakeOptions, how it is pressed; output: BakeOutput, what is written.
    warnings: sentences about it that are known before it runs; the report tells them, too.
    """

    @fields_of(options=BakeOptions, output=BakeOutput)
    def __init__(
        self,
        gait: Gait,
        ground: Ground | Iterable[Parcel],
        soils: object = "dry-sand",
        folder: str | os.PathLike[str] = "bake",
        *,
        cell_size: float = 0.01,
        plants: object = (),
        options: BakeOptions = BakeOptions(),
        output: BakeOutput = BakeOutput(),
    ) -> None:
        super().__init__(gait, parcels_of(ground, soils, folder, plants, output), cell_size, options, output)
        self.loads: FootForce | None = None
        self.report: dict[str, Any] | None = None
        self._steps: Any = lambda: None  # the generator of a run on its way
        self.shares: list[Share] = []  # of each parcel that the walk reaches; in the end: that it has trodden

    # ---- the bake -------------------------------------------------------------------------------

    def __repr__(self) -> str:
        return f"Bake({self.gait!r}, frames {self.frame_start} to {self.frame_end}, {self.folder!r})"

    def __enter__(self) -> Bake:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, problem: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Stop a run that is on its way, as if its generator was closed: its folder is free, what was written stays."""
        steps = self._steps()
        if steps is not None:
            steps.close()

    def run(self) -> Generator[Progress, None, None]:
        """Bake, yielding Progress after every frame. Stopping early (closing the generator, or the Bake) keeps
        what was written. DesirePathError says in one sentence what went wrong."""
        steps = self._in_sentences()
        self._steps = weakref.ref(steps)  # who drops the generator has stopped the bake
        return steps

    def _in_sentences(self) -> Generator[Progress, None, None]:
        """_run() with every way to fail as a sentence."""
        try:
            yield from self._run()
        except OSError as problem:
            raise DesirePathError(
                f"{_plain(problem)}. What was baked before is still there; make room or choose another folder, "
                "then bake again."
            ) from None
        except MemoryError:
            raise DesirePathError("There is not enough memory: choose a larger cell size or fewer frames.") from None
        except DesirePathError:
            raise
        except ValueError as problem:
            raise DesirePathError(
                f"The walk cannot be simulated ({problem}): check the walker's place and scale and the frame rate."
            ) from None

    def _run(self) -> Iterator[Progress]:
        check_reserve()
        check_cell(self.cell_size)
        check_walk(self.options.limits, self.gait, self.count, self.rate(), self._most)
        with contextlib.ExitStack() as folders:
            for parcel in sorted(
                self.parcels, key=lambda each: each.folder
            ):  # in one order, so that no two wait in turn
                out = Output(parcel.folder, parcel.owner)
                out.open(self.wait)
                folders.callback(out.release)
            folders.enter_context(memory.held(self._most, self.parcels[0].folder))
            yield from self._into()

    @property
    def _most(self) -> float | None:
        """Of memory that may be taken [bytes]."""
        return memory.size_of(self.options.memory)

    def _into(self) -> Iterator[Progress]:
        seconds = {"total": time.perf_counter()}
        self.lost = lost_soles(self.gait, self.cell_size)
        if isinstance(self.options.spray, Spray):
            names = [f"the sole of bone {self.gait.bone(part)}" for part in range(len(self.gait.soles))]
            check_soles(self.options.spray, self.gait.soles, names)
        sims, states = self._restored()
        seconds["loads"] = time.perf_counter() - seconds["total"]
        seconds["step"] = seconds["write"] = 0.0
        ends = False
        try:
            for share in self.shares:
                share.begin(states.frame, states.names(share))
            yield from self._frames(sims, states, seconds)
            ends = True
            self._end(sims, states, seconds)
        except BaseException:
            for sim in sims:
                with contextlib.suppress(OSError):
                    sim.flush()
            self.report = None
            for share in self.shares:
                share.stop(ends)
            raise
        try:
            states.drop()
            for share in self.shares:
                share.ready()
        except BaseException:
            for share in self.shares:
                share.out.withdraw()
            raise
        for share in self.shares:
            share.out.publish()

    def _restored(self) -> tuple[list[Simulation], States]:
        """(simulations, their States) as they were when the same bake was stopped; else at their begin."""
        name, refused = self.signature(), dict[int, str]()
        while True:
            sims, self.loads, self.shares = simulations(self)
            for share in self.shares:
                share.thin(self.options.limits.cells)
                share.find(name)
            check_grounds(self.options.limits, self.gait, self.shares, self.count, self._most)
            for share in self.shares:
                share.look()
            states = States(self.shares, name, refused)
            if states.restore():
                return sims, states

    def _frames(self, sims: list[Simulation], states: States, seconds: dict[str, float]) -> Iterator[Progress]:
        """Simulate and write what comes after the frame at which the States stand."""
        if not states.frame:
            for share in self.shares:
                share.write(0, 0.0)
        for number in range(states.frame + 1, self.count + 1):
            frame = self.frame_start + number - 1
            begun = time.perf_counter()
            for sim in sims:
                sim.run(self.sample(frame))
            memory.check_kept()
            stepped = time.perf_counter()
            for share in self.shares:
                share.write(number, self.time(frame))
                share.map(frame)
            if number < self.count:
                states.after(number)
            seconds["step"] += stepped - begun
            seconds["write"] += time.perf_counter() - stepped
            try:
                yield Progress(frame, number / self.count)
            except GeneratorExit:  # stopped by who has started it
                with contextlib.suppress(OSError):
                    states.keep(number)
                raise
        for sim in sims:
            sim.flush()

    def _end(self, sims: list[Simulation], states: States, seconds: dict[str, float]) -> None:
        """The last maps and the reports; grounds nobody has pressed are as they were."""
        if len(self.parcels) > 1:
            pressed = [share for share in self.shares if share.is_pressed()]
            for share in self.shares:
                if share not in pressed:
                    for sim in sims:
                        sim.flush()
                    share.leave()
            self.shares = pressed
            if not pressed:
                raise DesirePathError(BESIDE)
        for share in self.shares:
            share.end()
        for sim in sims:
            sim.flush()
        seconds["total"] = time.perf_counter() - seconds["total"]
        before = [*self.warnings, *(self.loads.warnings if self.loads else ()), *self.lost]
        self.report = summary(self, sims, seconds, before, states.warnings)
        for share in self.shares:
            share.conclude(of_share(self, share, self.shares, self.report))


def _plain(problem: OSError) -> str:
    """One clause about an OSError, whoever raised it."""
    if problem.strerror and problem.filename:
        return f"{problem.filename} cannot be written ({problem.strerror})"
    return str(problem)
