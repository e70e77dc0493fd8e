"""The one doorway to the core: ground, soils and a recording go in, pressed ground comes out.

SI units, world frame, +Z up. Arrays that cross to the core are C-ordered float64 (recordings) or
float32 (grids). Nothing here knows Blender.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ..core import _native
from ..errors import DesirePathError
from ..keywords import fields_of
from ..motion.recording import CONTACT_LAWS
from ..motion.tracks import TrackArray
from ..version import VERSION
from . import layers, materials, rectangle_cells, state_file, trail
from .cast import cast_of, laws_of, pressing_of, tracks_of
from .fields import FIELDS, LEAN, Field
from .film import Closed, Film
from .ground import Ground, as_soils, check_cell, soil_numbers
from .options import HEAPS, LAWS, SimulationOptions
from .planting import Plants, as_plantings, seed_of
from .soil_keys import AnySoil, settle_times, table
from .spray import Grains, Spray, grains_of
from .standing import Standing

if TYPE_CHECKING:
    from typing_extensions import Buffer

    from ..loads.force import FootForce
    from ..motion.gait import Gait

__all__ = [
    "Film",
    "Ground",
    "HEAPS",
    "LAWS",
    "LOAD_MODELS",
    "Simulation",
    "SimulationOptions",
    "TILE",
    "as_soils",
    "check_cell",
]


TILE: int = _native.TILE  # cells along one side of a tile of ground and of a playback frame

LOAD_MODELS = ("inertia", "impulse")
Area = Callable[[np.ndarray], np.ndarray]  # at which places (n, 2) [m] something stands
Pages = tuple[int, int, np.ndarray]  # of a sparse picture: columns, rows, x and y of each


class Simulation(Standing):
    """Ground that walkers press.

    ground: Ground; soils: a preset's name, a Soil, SoilKeys where it changes over time, or a list (painted ground
        counts through it).
    cell_size: side of a cell [m], 0.0001 to 1.
    plants: what grows here: a Planting, a kind's name, or a list of either; see plants.Planting. They stand where
        a loaded walk can reach them and cost nothing elsewhere.
    areas: for each of the plants a function that tells at which places (n, 2) [m] they stand; default: anywhere.
    options: SimulationOptions: how it is pressed.
    """

    @fields_of(options=SimulationOptions)
    def __init__(
        self,
        ground: Ground,
        soils: str | AnySoil | Iterable[str | AnySoil] = "dry-sand",
        cell_size: float = 0.01,
        *,
        plants: Plants = (),
        areas: Sequence[Area | None] | None = None,
        options: SimulationOptions = SimulationOptions(),
    ) -> None:
        check_cell(cell_size)
        self.limits = options.limits
        self.cell_size = float(cell_size)
        self.origin = options.origin
        lain = self._lain = layers.lain(ground.native, as_soils(soils), ground.layers)
        self.soils = lain.tops
        self.more_fields = materials.fields(lain, len(ground.layers))  # beside those that all grounds have
        self.fields: Mapping[str, Field] = {**FIELDS, **self.more_fields}  # by name
        self.plantings = as_plantings(plants)
        self._areas = areas or [None] * len(self.plantings)
        self.warnings: list[str] = []  # sentences about what could not be taken as it was given
        self.stands = []  # (stand, number of the planting, plants), in the order they were planted
        self._planted: list[set[tuple[int, int]]] = [set() for _ in self.plantings]  # squares
        now, times = table(self.soils)
        try:
            self._core = _native.Simulation(
                lain.native,
                soil_numbers(now),
                self.cell_size,
                self.origin,
                law=CONTACT_LAWS.index(options.law),
                heap=HEAPS.index(options.heap),
                rim_width=options.rim_width,
                workers=options.threads,
                times=times,
                layers=lain.numbers(),
            )
        except ValueError as problem:
            if "no ground" in str(problem):
                raise DesirePathError(
                    "The ground has no area seen from above: it stands upright. Lay it down and bake again."
                ) from None
            raise DesirePathError(f"The ground cannot be used: {problem}.") from None
        if isinstance(options.spray, Spray):
            self._core.spray(options.spray.parameters())
        if self.plantings:
            self._core.open_plants(seed_of(self.plantings))
        if ground.trail is not None:
            i0, j0, left, self.warnings = ground.trail.on(self.cell_size, self.origin)
            self._core.lay(i0, j0, *(left[name] for name in trail.LEFT))
        for number, planting in enumerate(self.plantings):
            if planting.roots is not None:
                self._plant(number, planting.roots, planting.vigour)

    def _plant(self, number: int, roots: np.ndarray, vigour: np.ndarray | None = None) -> None:
        """Plant roots (n, 2) of a planting where there is ground."""
        area = self._areas[number]
        if area is not None:
            there = area(roots)
            roots, vigour = roots[there], vigour if vigour is None else vigour[there]
        stand, count = self._core.plant(self.plantings[number].kind.numbers(), np.ascontiguousarray(roots))
        if count:
            self.stands.append((stand, number, count))
            if vigour is not None:
                there = np.isfinite(self.rest_height(roots))
                self._core.vary_plants(stand, np.ascontiguousarray(vigour[there]))

    def _plant_window(self) -> None:
        """Plant the tiles that the loaded recording can reach, as far as they are not planted yet."""
        i0, i1, j0, j1 = self.reach()
        cell, (ox, oy), bounds = self.cell_size, self.origin, self.bounds()
        if i0 >= i1:
            return
        i0, j0, i1, j1 = i0 // TILE * TILE, j0 // TILE * TILE, -(-i1 // TILE) * TILE, -(-j1 // TILE) * TILE
        for number, planting in enumerate(self.plantings):
            wide = planting.kind.reach + planting.kind.height
            box = (ox + i0 * cell - wide, oy + j0 * cell - wide, ox + i1 * cell + wide, oy + j1 * cell + wide)
            box = (*np.maximum(box[:2], bounds[:2]), *np.minimum(box[2:], bounds[2:]))
            fresh = [at for at in planting.squares(*box, self.limits) if at not in self._planted[number]]
            self._planted[number].update(fresh)
            roots = planting.in_squares(fresh)
            if len(roots):
                self._plant(number, roots)

    def rest_height(self, xy: ArrayLike) -> np.ndarray:
        """Height of the ground before any walker [m] at points xy (n, 2); NaN where there is none."""
        xy = np.ascontiguousarray(xy, np.float64).reshape(-1, 2)
        height = np.empty(len(xy))
        self._core.rest(xy, height)
        return height

    def settle_time(self, xy: ArrayLike) -> np.ndarray:
        """tau of the soil at points xy (n, 2), float64 (n,) [s]; where it changes over time, as it is at first. A point
        beside the ground or over a hole has that of the nearest point which is on it, if any is.
        """
        at = np.floor((np.asarray(xy) - self.origin) / self.cell_size).astype(np.int64)
        return settle_times(self.soils, self._read, at)

    def normal(self, xy: Sequence[float], radius: float) -> tuple[float, float, float]:
        """Unit normal of the ground before any walker at (x, y), smoothed over `radius` [m]."""
        return self._core.normal(float(xy[0]), float(xy[1]), float(radius))

    def __repr__(self) -> str:
        soils = f"{len(self.soils)} soil{'' if len(self.soils) == 1 else 's'}"
        return f"Simulation(cells of {self.cell_size:g} m, {soils}, {len(self.plantings)} plantings)"

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, kind: object, problem: object, trace: object) -> None:
        with contextlib.suppress(*((OSError,) if kind else ())):  # what went wrong first is told
            self.close()

    def close(self) -> None:
        """Wait until all is written, and give the ground back; OSError when a file could not be."""
        core, self._core = self._core, Closed()
        if not isinstance(core, Closed):
            core.flush()

    def bounds(self) -> tuple[float, float, float, float]:
        """World box of the ground (x0, y0, x1, y1) [m]; infinite for flat ground."""
        return self._core.bounds()

    def cells(self, rectangle: Sequence[float]) -> tuple[int, int, int, int]:
        """Cells (i0, i1, j0, j1), as reach() tells them, that a rectangle (x0, y0, x1, y1) [m] has a part of."""
        return rectangle_cells.cells(rectangle, self.cell_size, self.origin)

    def box(self, cells: Sequence[int]) -> tuple[float, float, float, float]:
        """Rectangle (x0, y0, x1, y1) [m] of cells (i0, i1, j0, j1), as bounds() tells it and read() takes it."""
        return rectangle_cells.box(cells, self.cell_size, self.origin)

    def place(
        self,
        gait: tuple[np.ndarray | TrackArray, ...],
        walker: int,
        numbers: Mapping[str, float],
        clearance: np.ndarray,
        pose: np.ndarray,
        com: np.ndarray,
        *,
        flat: bool,
        carry: bool,
    ) -> None:
        """Turn a walker's feet to the ground, changing pose and com: place.place_feet is the door.

        gait: walker.native_gait() of one. numbers: of DpPlaceOptions, by name.
        """
        self._core.place(
            gait,
            int(walker),
            bool(flat),
            bool(carry),
            {name: float(value) for name, value in numbers.items()},
            np.ascontiguousarray(clearance, np.float64),
            pose,
            com,
        )

    def load(self, gait: Gait, loads: FootForce) -> None:
        """Take an evenly sampled Gait and its FootForce (walker.loads); earlier prints stay."""
        time, mass, *cast = cast_of(gait)
        held = getattr(loads, "held", None)
        if isinstance(gait.pose, TrackArray):
            track, poses, pressing = tracks_of(gait, loads, held)
            self._core.load_tracks(time, mass, *cast, track, poses, *pressing, laws_of(gait))
        else:
            touching = pressing_of(np.asarray(loads.touching), None if held is None else np.asarray(held))
            force, point = np.ascontiguousarray(loads.force), np.ascontiguousarray(loads.point)
            pose = np.ascontiguousarray(gait.pose)
            self._core.load(time, mass, pose, *cast, touching, force, point, laws_of(gait))
        if self.plantings:
            self._plant_window()

    def load_live(self, gait: Gait) -> None:
        """Follow poses as they are made: the walkers and soles of a Gait, whose own poses are not looked at.

        Each sample comes by push(); run() steps up to it, and forgets what is behind. Of plants only those in areas of
        their own are there, since nobody knows where the walk will go.
        """
        time, *cast = cast_of(gait)
        self._core.load_live(time[:0], *cast, laws_of(gait))

    def push(
        self,
        time: float,
        pose: ArrayLike,
        touching: ArrayLike,
        force: ArrayLike,
        point: ArrayLike,
        present: ArrayLike | None = None,
    ) -> None:
        """The next sample of a live motion, later than those before [s].

        pose (P, 7) and force (P, 3), point (P, 3) of each part as in Gait and FootForce; touching (P,).
        present (W,): which walkers are there; None: all.
        """
        self._core.push(
            float(time),
            None if present is None else np.ascontiguousarray(present, np.uint8),
            np.ascontiguousarray(pose, np.float64),
            np.ascontiguousarray(np.asarray(touching) == 1, np.uint8),
            np.ascontiguousarray(force, np.float64),
            np.ascontiguousarray(point, np.float64),
        )

    def reach(self) -> tuple[int, int, int, int]:
        """Cells (i0, i1, j0, j1) the loaded recording can change; empty if i0 >= i1."""
        return self._core.reach()

    def reach_tiles(self, tile_x: int, tile_y: int, tiles_x: int, tiles_y: int) -> np.ndarray:
        """Which of these tiles the loaded recording can change, or hold a trail already, bool (tiles_y, tiles_x)."""
        out = np.zeros((tiles_y, tiles_x), np.uint8)
        self._core.reach_tiles(tile_x, tile_y, out)
        there = np.zeros((int(self._core.report()["tiles"]), 2), np.int32)
        self._core.list_tiles(there)
        x, y = (there - (tile_x, tile_y)).T
        inside = (x >= 0) & (x < tiles_x) & (y >= 0) & (y < tiles_y)
        out[y[inside], x[inside]] = 1
        return out.astype(bool)

    def run(self, sample: int) -> None:
        """Step to the state at this sample of the loaded recording."""
        self._core.run(int(sample))

    def settle(self) -> None:
        """Lift all feet and let everything loose come to rest."""
        self._core.settle()

    def state(self) -> memoryview:
        """What the ground has become, as bytes (a buffer), for restore()."""
        return memoryview(self._core.save_state())

    def restore(self, state: Buffer) -> None:
        """Go on from a state(): in a simulation that is made alike and has loaded the same walk, before its first step.

        What follows is the same, to the bit, as if it had never stopped. DesirePathError, and nothing has changed, if
        the state is damaged or of another simulation.
        """
        state_file.restore(self._core, state, "This")

    def save_state(self, path: str | os.PathLike[str]) -> None:
        """Write state() to one file, whole or not at all, for load_state()."""
        state_file.write(path, self.state())

    def load_state(self, path: str | os.PathLike[str]) -> None:
        """restore() from a file that save_state() wrote."""
        state_file.restore(self._core, state_file.read(path), os.fspath(path))

    def report(self) -> dict[str, Any]:
        """Contacts, depths [m] and volumes [m^3] so far, as a dict."""
        return self._core.report()

    def carried(self) -> dict[str, dict[str, float]]:
        """Of each soil that sticks to soles: `taken_m3` so far = `carried_m3` on them now + `left_m3` on the ground."""
        return materials.carried(self._lain, self._core.carried())

    def read(
        self, name: str, i0: Any, j0: int | None = None, nx: int | None = None, ny: int | None = None
    ) -> np.ndarray:
        """A field as float32 (ny, nx): of a rectangle (x0, y0, x1, y1) [m] as bounds() and box() tell it, or from cell
        (i0, j0) on.

        name: one of maps.MAPS or maps.LEAN, "rest", "young_modulus", "soil", or "pressure": under the soles now [Pa].
        Where a soil sticks, or lies in layers: surface_<soil>, how much of what is seen it is; carried_<soil> [m] of
        those that stick, and layer_1 .. [m]. "soil" is which of the ground's own soils lies there, below all layers.
        """
        window = rectangle_cells.window((i0, j0, nx, ny), self.cell_size, self.origin)
        if name not in self.fields:
            raise DesirePathError(f"There is no field '{name}': choose one of {', '.join(self.fields)}.")
        found = self._read(name, *window)
        return self._lain.own[found.astype(np.intp)].astype(np.float32) if name == "soil" else found

    def _read(self, name: str, *window: int) -> np.ndarray:
        """The same from cell (i0, j0) on, as the core tells it: "soil" is the kind of ground."""
        out = np.zeros(window[:1:-1], np.float32)
        if name not in LEAN:
            self._core.read(self.fields[name].number, *window[:2], out)
        elif self.plantings:
            self._core.read_lean(LEAN.index(name), *window[:2], out)
        return out

    def grains(self) -> Grains:
        """What flies now; nothing, where the options have no spray. On ground in layers their soils count as the maps
        surface_<soil> do, by the one that was on top."""
        found = grains_of(self._core)
        return replace(found, soil=np.array(self._lain.names, found.soil.dtype)[found.soil])

    def open_frames(self, tile_x: int, tile_y: int, tiles_x: int, tiles_y: int, pages: Pages | None = None) -> Film:
        """A Film of these tiles (TILE cells a side); several may be open, of the same tiles or others.

        pages: (columns, rows, which (n, 2)) of frames that show some pages of them alone, see bake/atlas.py
        """
        core = self._core.open_frames(tile_x, tile_y, tiles_x, tiles_y, f"Desire Path {VERSION}", *(pages or ()))
        return Film(core, self.fields)

    def flush(self) -> None:
        """Wait until all frames and maps are written; OSError when one could not be."""
        self._core.flush()
