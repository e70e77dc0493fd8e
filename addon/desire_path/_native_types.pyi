"""The types of the core, and what its functions take and give: for who reads or checks, as no module has this name."""

from collections.abc import Sequence
from typing import Any, TypeAlias, TypedDict, final

import numpy as np
from typing_extensions import Buffer

_Array: TypeAlias = np.ndarray | Buffer
_Vec3: TypeAlias = tuple[float, float, float]
_Soil: TypeAlias = dict[str, float]  # numbers by name, of soil_numbers()
_Kind: TypeAlias = dict[str, float]  # form, sheets, plants_numbers(), by name
_Numbers: TypeAlias = tuple[tuple[str, str, float, float, float, str], ...]  # name, unit, low, high, usual, meaning
_Box: TypeAlias = tuple[int, int, int, int]  # i0, i1, j0, j1
_Gait: TypeAlias = tuple[  # native_gait(): float64, and int32 where things are counted
    _Array,  # time (T,)
    _Array,  # com (W, T, 3)
    _Array,  # mass (W,)
    _Array,  # pose (P, T, 7)
    _Array,  # limb_walker (L,)
    _Array,  # part_limb (P,)
    _Array,  # point (K, 3)
    _Array,  # point_part (K,)
    _Array,  # point_role (K,)
]
_Ground: TypeAlias = (
    tuple[str, float]  # "flat", height
    | tuple[
        str, _Array, float, float, float, float, _Array | None
    ]  # "heights", (ny, nx) f4, spacing, x0, y0, height, kinds
    | tuple[str, _Array, _Array, _Array | None]  # "mesh", vertices (n, 3) f8, triangles (m, 3) i4, kinds (k, n) f4
)
_Patch: TypeAlias = (
    tuple[  # cell, x0, y0; (ny, nx) f4: rest, compression, heap, pressure_time, modulus, rest_slope; kind u1; soils
        float, float, float, _Array, _Array, _Array, _Array, _Array, _Array, _Array, Sequence[_Soil]
    ]
    | tuple[Any, ...]  # and behind them (ny, nx) f4 wall_slope, uneven, spring
)
_Imprint: TypeAlias = tuple[_Array, _Array, _Array]  # (ny, nx): bottom f4, cover f4, ring i4
_Notes: TypeAlias = Sequence[tuple[str, str | float]]

class _Pressed(TypedDict):
    firm: float
    elastic: float
    loose: float
    displaced: float
    area: float
    sink: float
    deepest: float

class _Settled(TypedDict):
    sweeps: int
    at_rest: bool
    at_edge: bool
    changed: _Box
    loosened: float

class _Moved(TypedDict):
    awake: int
    broke: int

@final
class Block:
    def __buffer__(self, flags: int, /) -> memoryview: ...

@final
class Film:
    def open_maps(self, fields: tuple[tuple[str, int], ...], notes: tuple[tuple[str, str | float], ...], /) -> None: ...
    def list_files(self, path: str, /) -> None: ...
    def write_frame(self, path: str | None, time: float, lean: bool = False, /) -> None: ...
    def write_maps(self, path: str, time: float, /) -> None: ...

@final
class Simulation:
    def __new__(
        cls,
        ground: _Ground,
        soils: Sequence[_Soil],
        cell: float,
        origin: tuple[float, float] = (0.0, 0.0),
        law: int = 0,
        heap: int = 0,
        rim_width: float = ...,
        max_sweeps: int = ...,
        normal_radius: float = ...,
        workers: int = 0,
        times: _Array | None = None,  # (T,) f8; then soils of each, T times as many
        layers: Sequence[Sequence[tuple[dict[str, float], float, int, int]]] | None = None,  # see DpLayer
    ) -> Simulation: ...
    def rest(self, xy: _Array, out: _Array, /) -> None: ...
    def normal(self, x: float, y: float, radius: float, /) -> _Vec3: ...
    def bounds(self) -> tuple[float, float, float, float]: ...
    def place(
        self,
        gait: _Gait,
        walker: int,
        flat: bool,
        carry: bool,
        numbers: dict[str, float],
        clearance: _Array,
        pose: _Array,  # changed (P, T, 7) f8
        com: _Array,  # changed (W, T, 3) f8
        /,
    ) -> None: ...
    def load(
        self,
        time: _Array,
        mass: _Array,
        pose: _Array,
        limb_walker: _Array,
        part_limb: _Array,
        sole_vertex: _Array,
        sole_vertex_count: _Array,
        sole_triangle: _Array,
        sole_triangle_count: _Array,
        touching: _Array,
        force: _Array,
        point: _Array,
        contact_law: _Array | None = None,  # (W,) u1
        /,
    ) -> None: ...
    def load_tracks(
        self,
        time: _Array,
        mass: _Array,
        limb_walker: _Array,
        part_limb: _Array,
        sole_vertex: _Array,
        sole_vertex_count: _Array,
        sole_triangle: _Array,
        sole_triangle_count: _Array,
        track: _Array,  # (n, 3) i4
        pose: _Array,  # (N, 7) f8
        touching: _Array,
        force: _Array,
        point: _Array,
        contact_law: _Array | None = None,  # (W,) u1
        /,
    ) -> None: ...
    def load_live(
        self,
        time: _Array,
        mass: _Array,
        limb_walker: _Array,
        part_limb: _Array,
        sole_vertex: _Array,
        sole_vertex_count: _Array,
        sole_triangle: _Array,
        sole_triangle_count: _Array,
        contact_law: _Array | None = None,  # (W,) u1
        /,
    ) -> None: ...
    def push(
        self,
        time: float,
        present: _Array | None,  # (W,) u1
        pose: _Array,  # (P, 7) f8
        touching: _Array,
        force: _Array,
        point: _Array,
        /,
    ) -> None: ...
    def reach(self) -> _Box: ...
    def run(self, sample: int, /) -> None: ...
    def spray(self, numbers: dict[str, float], /) -> None: ...
    def grains(self) -> int: ...
    def read_grains(self, position: _Array, velocity: _Array, soil: _Array, name: _Array, /) -> None: ...
    def save_state(self) -> Block: ...
    def load_state(self, state: _Array, /) -> None: ...
    def join_state(self, state: _Array, tiles: _Array, walkers: _Array, /) -> None: ...
    def begin_at(self, sample: int, /) -> None: ...
    def list_tiles(self, out: _Array, /) -> None: ...
    def reach_tiles(self, tile_x: int, tile_y: int, out: _Array, /) -> None: ...  # out (ny, nx) u1
    def settle(self) -> None: ...
    def report(self) -> dict[str, Any]: ...
    def carried(self) -> tuple[tuple[int, float, float, float], ...]: ...  # soil, taken, carried, left [m^3]
    def read(self, field: int, i0: int, j0: int, out: _Array, /) -> None: ...
    def lay(self, i0: int, j0: int, compression: _Array, heap: _Array, pressure_time: _Array, /) -> None: ...
    def open_plants(self, seed: int, /) -> None: ...
    def plant(self, kind: _Kind, root: _Array, /) -> tuple[int, int]: ...
    def vary_plants(self, stand: int, vigour: _Array, /) -> None: ...
    def rest_plants(self, seconds: float, /) -> None: ...
    def read_plants(
        self,
        stand: int,
        first: int,
        position: _Array | None,  # filled (n, particles, 3) f4
        strength: _Array | None,  # filled (n, bends) f8
        alpha: _Array | None,  # filled (n,) f8
        /,
    ) -> None: ...
    def lay_plants(self) -> None: ...
    def read_shown(self, stand: int, first: int, position: _Array, /) -> None: ...
    def read_lean(self, axis: int, i0: int, j0: int, out: _Array, /) -> None: ...
    def open_frames(
        self,
        tile_x: int,
        tile_y: int,
        tiles_x: int,
        tiles_y: int,
        software: str,
        columns: int = 0,
        rows: int = 0,
        pages: _Array | None = None,  # (n, 2) i4
        /,
    ) -> Film: ...
    def flush(self) -> None: ...
