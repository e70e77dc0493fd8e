"""What all tasks of a job have made, as the bake it was planned from: to the bit, but for the seconds it took. MODEL 13

job/results --merge(job, "bake")--> bake/frames, bake/maps, bake/report.json ..
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from .. import memory
from ..bake import report as reports
from ..bake.contents import MAPS_ALWAYS
from ..bake.folder import frame_name, list_sums, order_sums
from ..bake.output import Output
from ..core import _native
from ..errors import DesirePathError
from ..files import atomic_file
from ..ground import pieces
from ..version import VERSION
from .chunks import Frame, unpack
from .job import WALKERS, Job
from .task import take, with_datum

Tiles = dict[tuple[int, int], bytes]
LEDGER = 1e-6  # what was heaped is what was displaced, MODEL 11.3 [-]
LITTLE = (
    1e-6  # .. of what is displaced, this at least: a body that glides over the ground presses a rounding error [m^3]
)
FINAL = MAPS_ALWAYS[1]


def tasks(job: Job) -> list[list[int]]:
    """Of each window the tiles that have something to do."""
    return [sorted({each.owner for each in job.components(window)}) for window in range(len(job.windows))]


def missing(job: Job) -> list[tuple[int, int]]:
    """(window, tile) of the tasks that are still to be done."""
    found = []
    for window, tiles in enumerate(tasks(job)):
        for tile in tiles:
            try:
                job.needed(window, tile, "")
            except DesirePathError:
                found.append((window, tile))
    return found


def merge(
    job: Job,
    folder: str | os.PathLike[str] | None = None,
    progress: Callable[[float], object] | None = None,
    *,
    limit: float | str | None = None,
) -> dict[str, Any]:
    """Write the bake to a folder, by default the job's own `bake`; returns its report.

    limit: of memory, in bytes or as "4G"; what does not fit waits in the job's folder
    DesirePathError where tasks are still to be done, or the limit is too low.
    """
    with memory.held(limit, job.folder):
        return _merge(job, folder, progress)


def _merge(
    job: Job, folder: str | os.PathLike[str] | None, progress: Callable[[float], object] | None
) -> dict[str, Any]:
    gone = missing(job)
    if gone:
        first = ", ".join(f"window {window} tile {tile}" for window, tile in gone[:3])
        raise DesirePathError(
            f"{len(gone)} tasks of {job.folder} are still to be done ({first}{', ..' if len(gone) > 3 else ''}): "
            "run them with farm tile, then merge again."
        )
    out = Output(folder if folder is not None else job.path("bake"))
    out.open()
    try:
        out.fresh()
        report = _Merge(job, out).write(progress)
        out.ready()
        out.publish()
    except OSError as problem:
        raise DesirePathError(
            f"The bake cannot be written to {out.folder} ({problem.strerror or problem}): make room, then merge again."
        ) from None
    finally:
        out.release()
    return report


class _Merge:
    """The files of a bake, as they come to be."""

    def __init__(self, job: Job, out: Output) -> None:
        self.job, self.out = job, out
        self.sums: dict[str, str] = {}
        self.kinds = ("trail", "lean") if job.about["plants"] else ("trail",)
        self.rest = {kind: Frame.read(job.path("rest", frame_name(0, kind))) for kind in self.kinds}
        self.rest["maps"] = Frame.read(job.path("rest", "maps.exr"))
        self.now: dict[str, Tiles] = {kind: {} for kind in self.rest}
        self.found: list[dict[str, Any]] = []  # reports of all tasks
        self.carried: dict[str, float] = {}  # by the last of all
        self.seconds = 0.0

    def write(self, progress: Callable[[float], object] | None) -> dict[str, Any]:
        job = self.job
        for kind in self.kinds:
            self._frame(kind, 0)
        for window, tiles in enumerate(tasks(job)):
            changes = self._changes(window, tiles)
            for number in range(job.windows[window].first, job.windows[window].last + 1):
                for kind, name in self._due(number):
                    self._take(changes[kind], kind, number)
                    self._frame(kind, number, name)
                memory.check_kept()
                if progress:
                    progress(number / job.windows[-1].last)
            for kind in self.rest:
                self._take(changes[kind], kind, job.windows[window].last)
        self._frame("maps", job.windows[-1].last, FINAL)
        shutil.copyfile(job.path("rest", MAPS_ALWAYS[0]), self.out.path(MAPS_ALWAYS[0]))
        report = self._report()
        frames = self.out.path("frames")
        list_sums(frames, self.sums)
        order_sums(frames)
        index = {**job.about["index"], "complete": True}
        for names, data, what in (
            (("report.json",), report, "The report"),
            (("frames", "index.json"), index, "The index of the frames"),
        ):
            atomic_file.write_json(self.out.path(*names), data, what, sync=False)
        return report

    def _due(self, number: int) -> Iterator[tuple[str, str]]:
        """(film, name of its file) of those that have a frame of a number."""
        for kind in self.kinds:
            yield kind, os.path.join("frames", frame_name(number, kind))
        if self.job.about["maps"][number]:
            yield "maps", os.path.join("maps", self.job.about["maps"][number])

    def _changes(self, window: int, tiles: list[int]) -> dict[str, list[tuple[int, int, int, bytes]]]:
        """What the tasks of a window changed, film by film, in the order of the frames, the last one first."""
        found: dict[str, list[tuple[int, int, int, bytes]]] = {kind: [] for kind in self.rest}
        for tile in tiles:
            about, parts = self.job.needed(window, tile, "The bake needs")
            self.found.append(about["report"])
            self.carried = about["carried"]
            self.seconds += about["seconds"]
            for kind in self.rest:
                if f"{kind}_table" in parts:
                    found[kind] += unpack(parts[f"{kind}_table"], parts[f"{kind}_tiles"])
        return {kind: sorted(each, key=lambda entry: -entry[0]) for kind, each in found.items()}

    def _take(self, changes: list[tuple[int, int, int, bytes]], kind: str, number: int) -> None:
        """What changed up to a frame."""
        x0, y0 = self.job.film[:2]
        while changes and changes[-1][0] <= number:
            _, x, y, tile = changes.pop()
            self.now[kind][x - x0, y - y0] = tile

    def _frame(self, kind: str, number: int, name: str = "") -> None:
        name = name or os.path.join("frames", frame_name(number, kind))
        data = self.rest[kind].write(self.out.path(name), self.job.about["times"][number], self.now[kind])
        self.sums[os.path.basename(name)] = f"{len(data)}:{_native.digest(data).hex()}"

    # ---- numbers ----------------------------------------------------------------------------------------

    def _report(self) -> dict[str, Any]:
        """As report.py tells of a bake, the ledger checked."""
        about = self.job.about
        report = self.found[-1] if self.job.chained else self._together()
        given = report["displaced_m3"] + report["loosened_m3"] - report["pressed_heap_m3"]
        if abs(report["heaped_m3"] - given) > LEDGER * max(report["displaced_m3"], LITTLE) and not about["trail"]:
            raise DesirePathError(
                "The ledger of the results does not balance: soil was lost between tasks. Plan the job anew, with a "
                "larger --margin."
            )
        warnings = about["report"]["warnings"]
        return {
            "passes": about["report"]["passes"],
            **reports.happened([report], bool(about["plants"]), False, self.carried),
            "seconds": round(self.seconds, 3),
            "stages": {"tasks": round(self.seconds, 3)},
            "warnings": [*warnings, *reports.hints([report], [about["layer"]], warnings)],
            "version": VERSION,
            "parameters": about["report"]["parameters"],
        }

    def _together(self) -> dict[str, Any]:
        """What all pieces of ground together tell, and the sums of what their tasks did."""
        job, walkers = self.job, self.job.arrays(WALKERS)
        sim = job.simulation(1)
        nobody = {name: walkers[f"first_{name}"][:0] for name in pieces.TRACKS}
        pieces.follow(sim, walkers, with_datum(nobody, walkers))
        last: dict[tuple[int, int], tuple[int, int]] = {}
        start = np.frombuffer(job.needed(-1, 0, "")[1]["tiles"], np.int32).reshape(-1, 2)
        last.update(((x, y), (-1, 0)) for x, y in start.tolist())
        for window in range(len(job.windows)):
            for each in job.components(window):
                last.update(((x, y), (window, each.owner)) for x, y in each.tiles.tolist())
        of: dict[tuple[int, int], list[tuple[int, int]]] = {}
        for tile, source in last.items():
            of.setdefault(source, []).append(tile)
        for source, tiles in of.items():
            take(sim, job.needed(*source, "The bake needs")[1], np.array(tiles), np.zeros(len(walkers["mass"]), bool))
        report = sim.report()
        for name in ("contacts", "off_ground", "broke", *(set(reports.VOLUMES) - {"heaped_m3"})):
            report[name] = sum(each[name] for each in self.found)
        report["deepest_m"] = max([report["deepest_m"], *(each["deepest_m"] for each in self.found)])
        return report
