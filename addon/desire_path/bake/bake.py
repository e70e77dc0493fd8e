"""From a recording to a folder of EXR files: frames for playback, maps, and a report.

    folder/frames/trail_0000.exr   the ground at rest (all zero)
    folder/frames/trail_0001.exr   the first frame, then one file a frame
    folder/frames/lean_0001.exr    with plants: how the grass lies, likewise from lean_0000.exr on
    folder/frames/index.json       where the frames lie and which are there
    folder/maps/second_0001.exr    the maps after every simulated second, TRAIL 4.3
    folder/maps/pass_0001.exr      or after a pass, where a frame is a pass
    folder/maps_start.exr          plant_strength_in, young_modulus_in, plant_strength, rest
    folder/maps_final.exr          compression, heap, pressure_time, plant_strength, rest, pressure; lean_x ..
    folder/plants.pc2, plants.npz  when asked for: the plants themselves, see plant_mesh.py
    folder/report.json             what happened, in numbers

A bake grows in folder/bake.new and takes the place of an earlier one, which is shown until then, when it is
whole: output.py says how. One that was stopped stays: the same bake started again goes on from its last state, see
state.py. Files of others in these folders are left alone.
"""

from __future__ import annotations

import contextlib
import hashlib
import math
import time
import weakref
from dataclasses import dataclass

import numpy as np

from .. import bounds
from ..bounds import Limits
from ..core import _native
from ..errors import DesirePathError
from ..ground import parcels as fields
from ..ground import plant_mesh
from ..ground.parcels import Parcel
from ..ground.sim import LOAD_MODELS, TILE, Ground, Simulation, check_cell
from ..loads import walker
from ..motion import jumps, size, tracks
from ..motion.rotation import turned
from ..placement.passes import turns_of
from ..rig.sole import coarse_cells
from ..version import VERSION
from .folder import FORMAT, FrameIndex, free, read_index  # noqa: F401  (found here by those who bake)
from .output import Output
from .share import Share
from .state import States

SAMPLE_RATE = 120.0  # at least so many steps a second, more for small creatures (size.hurry) [1/s]
RIGID = 0.94  # share of the layer: pressed this deep, soil is nearly as deep as it can be
SOLE_STEP = 0.0025  # soles are sampled so closely, or four times a cell [m]
LEAST_SAMPLES = 4  # a sole that fewer fall on leaves no print
MOST_SOLE = 1_000_000  # cells one sole may cover
PASS_RATE = 60.0  # the same where a frame is a pass: there are many, and each print is trodden again [1/s]
FILMS = ("frames", "passes")  # what a frame is: a scene frame | a whole pass of a walk along a path
REACH = 0.3  # around a sole a step can change the ground so far away [m]
BESIDE = "The walk passes beside the ground: move the walker or the ground so that one lies over the other."


@dataclass(frozen=True)
class Progress:
    """How far a bake has come."""

    frame: int  # scene frame just simulated; it is written while the next ones are
    fraction: float  # 0..1


def _passes(gait):
    """(first sample, sample after the last) of each pass in time: who walk at once make one together."""
    return list(dict.fromkeys((first, after) for first, after, _, _ in turns_of(gait)))


class Bake:
    """One bake: make it, run it, read its report.

    gait: Gait; ground: Ground; soils as for Simulation; folder: where the files go.
    ground may be a list of Parcels, as the tiles of a terrain, which are pressed as one: each has its own soils,
    folder, plants and owner then, those named here are not asked for, and `shares` tells which were trodden.
    cell_size [m]; frame_start, frame_end: scene frames to write, default: the whole recording.
    load_model: "inertia" or "impulse"; law, heap, rim_width, threads, plants: as for Simulation.
    plant_mesh: write the plants themselves as a mesh and its point cache, for close-ups.
    resume: go on where the same bake was stopped. map_seconds: write maps after every second, or pass.
    film: "frames", or "passes": frame n is the ground after pass n of Gait.along; None = "passes" if there are several.
    owner: id of the ground the folder belongs to; run() refuses a folder with the bake of another. Empty: anybody's.
    inputs: words for what it is made from, kept in index.json for whoever wants to know whether that has changed.
    wait: so long run() lets another program end its bake into the folder before it refuses, which it does at once where
    this program bakes there [s].
    warnings: sentences about it that are known before it runs; the report tells them, too.
    limits: what it may take of memory, disk and so on: run() refuses more before anything is written.
    """

    def __init__(
        self,
        gait,
        ground,
        soils="dry-sand",
        folder="bake",
        *,
        cell_size=0.01,
        frame_start=None,
        frame_end=None,
        load_model="inertia",
        law="sole",
        heap="rest",
        rim_width=0.04,
        threads=0,
        origin=(0.0, 0.0),
        resume=True,
        map_seconds=True,
        plants=(),
        plant_mesh=False,
        film=None,
        owner="",
        inputs=None,
        wait=30.0,
        limits=Limits(),
    ):
        if load_model not in LOAD_MODELS:
            raise DesirePathError(f"There is no load model '{load_model}': choose {' or '.join(LOAD_MODELS)}.")
        if film not in (None, *FILMS):
            raise DesirePathError(f"There is no film '{film}': choose {' or '.join(FILMS)}.")
        self.gait = gait = jumps.found(gait.check())
        self.passes = _passes(gait)
        self.film = film or FILMS[len(self.passes) > 1]
        self.parcels = _parcels(ground, soils, folder, plants, plant_mesh, owner, inputs)
        self.folder = self.parcels[0].folder
        self.wait, self.limits = float(wait), limits
        self.frame_rate = float(gait.frame_rate)
        frames = (
            len(self.passes) - 1
            if self.film == "passes"
            else math.floor((gait.time[-1] - gait.time[0]) * self.frame_rate + 1e-6)
        )
        last = gait.frame_start + frames
        try:
            self.frame_start = gait.frame_start if frame_start is None else int(frame_start)
            self.frame_end = last if frame_end is None else int(frame_end)
        except (ValueError, OverflowError, TypeError):
            raise DesirePathError(f"Frames {frame_start} to {frame_end} cannot be baked: give whole numbers.") from None
        if self.frame_end <= self.frame_start and self.film == "frames" or self.frame_end < self.frame_start:
            raise DesirePathError(
                f"The frame range {self.frame_start} to {self.frame_end} holds no motion: let it end after it starts."
            )
        if self.frame_start > last or self.frame_end < gait.frame_start:
            raise DesirePathError(
                f"The recording holds frames {gait.frame_start} to {last} and none of {self.frame_start} to "
                f"{self.frame_end}: choose frames among them."
            )
        self.load_model = load_model
        self.resume = resume
        self.map_seconds = map_seconds
        self.options = {"law": law, "heap": heap, "rim_width": rim_width, "origin": tuple(origin)}
        self.cell_size = float(cell_size)
        self.warnings = (*gait.warnings, *coarse_cells(gait, self.cell_size))
        self.threads = threads
        self.loads = None
        self.report = None
        self._steps = lambda: None  # the generator of a run on its way
        self.shares = []  # a Share of each parcel that the walk reaches; when the bake is whole: that it has trodden

    # ---- what is baked --------------------------------------------------------------------------

    def parameters(self, parcel):
        """What is baked, for the report of a parcel."""
        return {
            "cell_size": self.cell_size,
            "frame_start": self.frame_start,
            "frame_end": self.frame_end,
            "frame_rate": self.frame_rate,
            "load_model": self.load_model,
            "soils": [soil.told() for soil in parcel.soils],
            "ground": parcel.ground.name,
            **({"trail": parcel.ground.trail.path} if parcel.ground.trail else {}),
            "walkers": list(self.gait.walker_name),
            "mass_kg": [float(mass) for mass in self.gait.mass],
            **self.options,
            **({"plants": [planting.told() for planting in parcel.plants]} if parcel.plants else {}),
            **({"film": self.film} if self.film != "frames" else {}),
        }

    def _signature(self):
        """The same for two bakes exactly when they write the same files."""
        digest = hashlib.sha256(f"{VERSION} {FORMAT}".encode())
        gait = self.gait
        arrays = [
            gait.time,
            gait.com,
            gait.pose,
            gait.point,
            gait.part_limb,
            gait.limb_walker,
            gait.cut,
            gait.jump,
            gait.leg,
        ]
        for sole in gait.soles:
            arrays += [sole.vertices, sole.triangles]
        for parcel in self.parcels:
            digest.update(f"{self.parameters(parcel)} {parcel.ground.native[0]}".encode())
            digest.update(repr([part for part in parcel.ground.native if isinstance(part, float)]).encode())
            arrays += parcel.ground.arrays()
            for planting in parcel.plants:
                arrays += planting.arrays()
        for array in [part for each in arrays for part in tracks.parts(each)]:
            digest.update(f"{array.shape} {array.dtype}".encode())
            digest.update(_native.digest(np.ascontiguousarray(array)))
        return digest.hexdigest()

    def _rate(self):
        """Samples a second: a whole number of them a frame [1/s]."""
        least = (PASS_RATE if self.film == "passes" else SAMPLE_RATE) * size.hurry(self.gait)
        return self.frame_rate * max(1, math.ceil(least / self.frame_rate - 1e-6))

    def _check_walk(self):
        """Refuse what is too long, before its samples are made."""
        seconds = sum(float(self.gait.time[after - 1] - self.gait.time[first]) for first, after in self.gait.pieces())
        self.limits.check("frames", self.frame_end - self.frame_start + 1)
        self.limits.check("seconds", seconds)
        there = sum(
            len(values) for part in range(len(self.gait.part_limb)) for _, values in tracks.pieces(self.gait.pose, part)
        )
        self.limits.check("memory", bounds.SAMPLE_BYTES * there * (seconds * self._rate() + 1.0) / len(self.gait.time))

    def _check_grounds(self):
        """Refuse what is too large, before its pictures are made."""
        cells = [share.tiles[2] * share.tiles[3] * TILE * TILE for share in self.shares]
        self.limits.check("cells", max(cells))
        self.limits.check("memory", bounds.CELL_BYTES * sum(cells))
        count, taken = self.frame_end - self.frame_start + 1, 0.0
        for share, held in zip(self.shares, cells):
            pressed = bounds.pressed_area(self.gait, share.loads.touching) / self.cell_size**2 / len(self.shares)
            left = count - max(share.found, 0)
            taken += left * bounds.frame_bytes(held, pressed, bool(share.plants))
            taken += bounds.STATES * bounds.STATE_BYTES * pressed
            if share.parcel.plant_mesh:
                taken += plant_mesh.size(share.sim, count, share.plants)
        self.limits.check("disk", taken, self.folder)

    def _simulations(self):
        """The grounds with the recording on them, at a whole number of samples a frame: the Simulation of each storey,
        and the Shares of those that the walk reaches."""
        gait = self.stepped = self.gait.resample(self._rate())
        self.times = gait.time - gait.time[0]
        self.ends = [min(after, len(gait.time) - 1) for _, after in _passes(gait)]
        storeys = [[self.parcels[number] for number in storey] for storey in fields.storeys(self.parcels, self.gait)]
        sims = [self._simulation(storey) for storey in storeys]
        walks = walker.Walker(self.load_model, settle_time=sims[0].settle_time, cell=self.cell_size)  # tau of TRAIL (3)
        if len(sims) == 1:
            self.loads = walks.loads(gait, sims[0].rest_height)
            each = [self.loads]
        else:
            over, below = fields.treads(gait, [sim.rest_height for sim in sims])
            self.loads = walks.loads(gait, below)
            each = [fields.on(self.loads, over, number) for number in range(len(sims))]
        self.shares = []
        for sim, storey, loads in zip(sims, storeys, each):
            sim.load(gait, loads)
            for parcel in storey:
                tiles = self._rectangle(sim, parcel, gait, loads)
                if tiles is not None:
                    self.shares.append(Share(self, parcel, sim, loads, tiles))
        if not self.shares:
            if any(i0 < i1 for i0, i1, _, _ in (sim.reach() for sim in sims)):
                raise DesirePathError(BESIDE)
            raise DesirePathError(
                "No foot touches the ground in these frames: check that the walker stands on it and the scale is right."
            )
        return sims

    def _simulation(self, storey):
        """Of parcels that lie beside each other."""
        ground, soils = fields.sewn(storey, self.cell_size)
        plants = [(planting, parcel.has) for parcel in storey for planting in parcel.plants]
        return Simulation(
            ground,
            soils,
            self.cell_size,
            threads=self.threads,
            plants=[each for each, _ in plants],
            areas=[has for _, has in plants] if len(storey) > 1 else None,
            limits=self.limits,
            **self.options,
        )

    def _rectangle(self, sim, parcel, gait, loads):
        """Tiles (x, y, nx, ny) the frames of a parcel cover: what the walk can reach of it; None: nothing."""
        i0, i1, j0, j1 = sim.reach()
        x0, y0, x1, y1 = sim.bounds()
        cell, (ox, oy) = self.cell_size, self.options["origin"]
        if len(self.parcels) > 1:
            wide = REACH + max((each.kind.reach + each.kind.height for each in sim.plantings), default=0.0)
            box = fields.under(parcel, gait, loads, wide)
            if box is None:
                return None
            x0, y0 = max(x0, box[0] - cell), max(y0, box[1] - cell)  # with a cell of its neighbours
            x1, y1 = min(x1, box[2] + cell), min(y1, box[3] + cell)
        if math.isfinite(x0):
            i0 = max(i0, math.floor((x0 - ox) / cell))
            i1 = min(i1, math.ceil((x1 - ox) / cell))
            j0 = max(j0, math.floor((y0 - oy) / cell))
            j1 = min(j1, math.ceil((y1 - oy) / cell))
        if i0 >= i1 or j0 >= j1:
            return None
        tx0, ty0 = i0 // TILE, j0 // TILE
        tx1, ty1 = -(-i1 // TILE), -(-j1 // TILE)
        return tx0, ty0, tx1 - tx0, ty1 - ty0

    # ---- the bake -------------------------------------------------------------------------------

    def __repr__(self):
        return f"Bake({self.gait!r}, frames {self.frame_start} to {self.frame_end}, {self.folder!r})"

    def __enter__(self):
        return self

    def __exit__(self, kind, problem, trace):
        self.close()

    def close(self):
        """Stop a run that is on its way, as if its generator was closed: its folder is free, what was written stays."""
        steps = self._steps()
        if steps is not None:
            steps.close()

    def run(self):
        """Bake, yielding Progress after every frame. Stopping early (closing the generator, or the Bake) keeps
        what was written. DesirePathError says in one sentence what went wrong."""
        steps = self._told_plainly()
        self._steps = weakref.ref(steps)  # who drops the generator has stopped the bake
        return steps

    def _told_plainly(self):
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

    def _check_soles(self):
        """Refuse feet of so many cells that a step would take minutes, as of a rig in the wrong unit, and walkers whose
        every foot is lost between cells; name single feet that are."""
        area = np.zeros(len(self.gait.soles))
        for part, sole in enumerate(self.gait.soles):
            size = np.sort(np.ptp(sole.vertices.astype(float), axis=0))
            lowest = self.gait.pose[part, self.gait.pose[part, :, 2].argmin(), 3:]
            area[part] = np.prod(np.ptp(turned(lowest, sole.vertices.astype(float))[:, :2], axis=0))
            if size[1] * size[2] > MOST_SOLE * self.cell_size**2:
                raise DesirePathError(
                    f"The sole of bone {self.gait.bone(part)} is {size[2]:.1f} m long, too large for cells of "
                    f"{self.cell_size:g} m: check the walker's scale or choose a larger cell size."
                )
        step = self.cell_size / min(max(round(self.cell_size / SOLE_STEP), 1), 4)  # as the core samples soles
        self.lost = []
        for walker_number, name in enumerate(self.gait.walker_name):
            limbs = np.flatnonzero(np.asarray(self.gait.limb_walker) == walker_number)
            largest = [
                max(np.flatnonzero(np.asarray(self.gait.part_limb) == limb), key=lambda part: area[part])
                for limb in limbs
            ]
            lost = [part for part in largest if area[part] < LEAST_SAMPLES * step**2]
            if lost and len(lost) == len(largest):
                least = max(math.sqrt(area[lost].max()) / 8, 0.0005)
                raise DesirePathError(
                    f"The feet of {name} are lost between cells of {self.cell_size:g} m: choose a cell size of "
                    f"{least:.1g} m or so, or check the walker's scale."
                )
            self.lost += [
                f"The sole of bone {self.gait.bone(part)} is lost between cells of {self.cell_size:g} m and leaves no "
                "print: choose smaller cells."
                for part in lost
            ]

    def _run(self):
        check_cell(self.cell_size)
        self._check_walk()
        with contextlib.ExitStack() as folders:
            for parcel in sorted(
                self.parcels, key=lambda each: each.folder
            ):  # in one order, so that no two wait in turn
                out = Output(parcel.folder, parcel.owner)
                out.open(self.wait)
                folders.callback(out.release)
            yield from self._into()

    def _into(self):
        seconds = {"total": time.perf_counter()}
        self._check_soles()
        sims, states = self._restored()
        seconds["loads"] = time.perf_counter() - seconds["total"]
        seconds["step"] = seconds["write"] = 0.0
        try:
            for share in self.shares:
                share.begin(states)
            yield from self._frames(sims, states, seconds)
            self._end(sims, states, seconds)
        except BaseException:
            for sim in sims:
                with contextlib.suppress(OSError):
                    sim.flush()
            self.report = None
            for share in self.shares:
                share.stop()
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

    def _restored(self):
        """(simulations, their States) as they were when the same bake was stopped; else at their begin."""
        signature, refused = self._signature(), {}
        while True:
            sims = self._simulations()
            for share in self.shares:
                share.find(signature)
            self._check_grounds()
            states = States(self.shares, signature, refused)
            if states.restore():
                return sims, states

    def _frames(self, sims, states, seconds):
        """Simulate and write what comes after the frame at which the States stand."""
        count = self.frame_end - self.frame_start + 1
        if not states.frame:
            for share in self.shares:
                share.write(0, 0.0)
        for number in range(states.frame + 1, count + 1):
            frame = self.frame_start + number - 1
            begun = time.perf_counter()
            for sim in sims:
                sim.run(self._sample(frame))
            stepped = time.perf_counter()
            for share in self.shares:
                share.write(number, self.time(frame))
                share.map(frame)
            if number < count:
                states.after(number)
            seconds["step"] += stepped - begun
            seconds["write"] += time.perf_counter() - stepped
            try:
                yield Progress(frame, number / count)
            except GeneratorExit:  # stopped by who has started it
                with contextlib.suppress(OSError):
                    states.keep(number)
                raise
        for sim in sims:
            sim.flush()

    def _end(self, sims, states, seconds):
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
        self.report = self._report(sims, states, seconds)
        for share in self.shares:
            share.tell(self._told(share))

    def _sample(self, frame):
        """Sample of the recording that shows this scene frame."""
        number = max(frame - self.gait.frame_start, 0)
        if self.film == "passes":
            return self.ends[min(number, len(self.ends) - 1)]
        return int(np.searchsorted(self.times, number / self.frame_rate + 1e-6, "right")) - 1

    def time(self, frame):
        """Of a scene frame since the recording began [s]."""
        if self.film == "passes":
            return float(self.times[self._sample(frame)])
        return (frame - self.gait.frame_start) / self.frame_rate

    def _report(self, sims, states, seconds):
        found = [sim.report() for sim in sims]
        total = {name: sum(each[name] for each in found) for name in found[0]}
        left = [each for sim in sims for each in sim.warnings]
        warnings = list(dict.fromkeys([*self.warnings, *self.loads.warnings, *self.lost, *left, *states.warnings]))
        if any(
            each["deepest_m"] >= RIGID * min(soil.layer_depth for soil in sim.soils) for sim, each in zip(sims, found)
        ):
            warnings.append(
                "A print reaches the rigid ground under the soil: check the walker's mass, or choose a firmer soil."
            )
        if total["off_ground"] and walker.BESIDE not in warnings:
            warnings.append(walker.BESIDE)
        return {
            "passes": len(self.passes),
            "contacts": total["contacts"],
            "deepest_m": max(each["deepest_m"] for each in found),
            "pressed_m3": total["pressed_m3"],
            "pressed_heap_m3": total["pressed_heap_m3"],
            "heaped_m3": total["heaped_m3"],
            "displaced_m3": total["displaced_m3"],
            **(
                {"plants": total["plants"], "broken_bends": total["broke"]}
                if any(parcel.plants for parcel in self.parcels)
                else {}
            ),
            "seconds": round(seconds["total"], 3),
            "stages": {name: round(spent, 3) for name, spent in seconds.items()},
            "warnings": warnings,
            "version": VERSION,
            "parameters": self.parameters(self.parcels[0]),
        }

    def _told(self, share):
        """The report of a share: of several grounds what happened on it, and on all of them."""
        if len(self.parcels) == 1:
            return self.report
        end = self._sample(self.frame_end) + 1
        numbers = {"contacts": fields.contacts(share.parcel, self.stepped, share.loads, end), **share.numbers()}
        whole = {
            name: self.report[name]
            for name in ("contacts", "deepest_m", "pressed_m3", "pressed_heap_m3", "heaped_m3", "displaced_m3")
        }
        rest = {name: value for name, value in self.report.items() if name not in whole}
        return {
            **numbers,
            "with": [each.parcel.name for each in self.shares if each is not share],
            "in_all": whole,
            **rest,
            "parameters": self.parameters(share.parcel),
        }


def _parcels(ground, soils, folder, plants, plant_mesh, owner, inputs):
    """The Parcels of a bake, from one ground or a list of them."""
    if isinstance(ground, Ground):
        return [
            Parcel(ground, soils, folder, plants=plants, plant_mesh=plant_mesh, owner=owner, inputs=dict(inputs or {}))
        ]
    parcels = list(ground)
    if not parcels or not all(isinstance(each, Parcel) for each in parcels):
        raise DesirePathError("A bake needs a Ground, or a list of Parcels.")
    folders = {}
    for each in parcels:
        other = folders.setdefault(each.folder, each)
        if other is not each:
            raise DesirePathError(
                f"'{other.name}' and '{each.name}' bake into the same folder: choose another one for either."
            )
    return parcels


def _plain(problem):
    """One clause about an OSError, whoever raised it."""
    if problem.strerror and problem.filename:
        return f"{problem.filename} cannot be written ({problem.strerror})"
    return str(problem)
