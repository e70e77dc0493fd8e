"""The core as Python sees it: native/python/module.c names the files that hold each of these.

Buffers are arrays in C order of the type and shape said behind them; those that are filled must be writable. All
arguments but those of Simulation() are given by their place. Units and meaning stand with each function's docstring.
"""

from collections.abc import Callable, Sequence
from os import PathLike
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

# ---- base ----
def digest(buffer: _Array, /) -> bytes: ...
def memory_hold(path: str, limit: int, /) -> None: ...
def memory_release() -> None: ...
def memory_ease() -> None: ...
def memory_leave() -> None: ...
def memory_needs() -> int: ...
def memory_resident() -> int: ...
def block(size: int, /) -> Block: ...
def bytes_live() -> int: ...
def bytes_peak() -> int: ...

# ---- walker ----
def place_numbers() -> _Numbers: ...
def contact_numbers() -> _Numbers: ...
def load_numbers() -> _Numbers: ...
def resample_count(first: float, last: float, rate: float, /) -> int: ...
def resample(
    time: _Array, com: _Array, pose: _Array, rate: float, new_time: _Array, new_com: _Array, new_pose: _Array, /
) -> None: ...
def foot_contact(
    gait: _Gait,
    ground: _Array,  # (K, T) f8
    touching: _Array,  # filled (P, T) u1
    clearance: _Array,  # filled (K,) f8
    limits: dict[str, float] | None = None,
    /,
) -> None: ...
def foot_force(
    gait: _Gait,
    touching: _Array,  # (P, T) u1
    ground: _Array,  # (K, T) f8
    model: int,
    settle_time: float,
    half_sine: bool,
    force: _Array,  # filled (P, T, 3) f8
    point: _Array,  # filled (P, T, 3) f8
    options: dict[str, float] | None = None,
    settle: _Array | None = None,  # (K, T) f8
    /,
) -> None: ...
def foot_share(com: _Vec3, left: _Vec3, right: _Vec3, /) -> float: ...

# ---- imprint ----
def imprint_foot(
    soles: Sequence[tuple[_Array, _Array]],  # vertices (n, 3) f4, triangles (m, 3) i4
    poses: _Array,  # (count, 7) f8
    x0: float,
    y0: float,
    cell: float,
    samples: int,
    bottom: _Array,  # filled (ny, nx) f4
    cover: _Array,  # filled (ny, nx) f4
    /,
) -> _Box: ...
def imprint_rings(ring: _Array, rings: int, /) -> None: ...

# ---- soil ----
def soil_default() -> tuple[float, ...]: ...
def soil_numbers() -> _Numbers: ...
def soil_anisotropy(push: _Vec3, threshold: float, /) -> float: ...
def soil_compress(patch: _Patch, imprint: _Imprint, foot: tuple[Any, ...], law: int, dt: float, /) -> _Pressed: ...
def soil_carve(
    patch: _Patch, imprint: _Imprint, descent: tuple[float, float, float, float], dt: float, /
) -> dict[str, float]: ...
def soil_accumulate(
    patch: _Patch,
    imprint: _Imprint,
    foot: tuple[Any, ...],
    volume: float,
    law: int,
    rim_width: float,
    threshold: float,
    height: float,
    /,
) -> float: ...
def soil_stabilize(
    patch: _Patch, imprint: _Imprint | None, within: _Box | None, tolerance: float, most: int, /
) -> _Settled: ...
def soil_rebound(patch: _Patch, imprint: _Imprint | None, /) -> float: ...
def soil_noise(
    cell: float, x0: float, y0: float, i0: int, j0: int, longest: float, shortest: float, seed: int, out: _Array, /
) -> None: ...

# ---- plants ----
def plants_default() -> tuple[float, ...]: ...
def spray_numbers() -> _Numbers: ...
def plants_numbers() -> _Numbers: ...
def plants_shape(kind: _Kind, /) -> tuple[int, int, int, int, int]: ...
def plants_wear(kind: _Kind, reserve: float, strength: float, angle: float, dt: float, /) -> float: ...
def plants_regrow(kind: _Kind, alpha: float, seconds: float, /) -> float: ...
def plants_place(
    x0: float,
    y0: float,
    x1: float,
    y1: float,
    density: float,
    weight: _Array | None,  # (wy, wx) f4
    seed: int,
    root: _Array,  # filled (most, 2) f4
    given: int = 0,
    /,
) -> int: ...
def plants_rest_shape(kind: _Kind, seed: int, root: _Array, heading: _Array | None, position: _Array, /) -> None: ...
def plants_step(
    kind: _Kind,
    seed: int,
    root: _Array,  # (n, 2) f4
    heading: _Array | None,
    position: _Array,  # changed (n, particles, 3) f4
    velocity: _Array,  # changed (n, particles, 3) f4
    strength: _Array,  # changed (n, bends) f8
    ground: tuple[float, float, float, _Array] | None,  # x0, y0, cell, height (ny, nx) f4
    colliders: Sequence[tuple[Any, ...]],
    dt: float,
    steps: int,
    workers: int,
    /,
) -> _Moved: ...
def plants_cover(
    kind: _Kind,
    root: _Array,
    strength: _Array,
    window: _Vec3,  # x0, y0, cell
    law: int,
    alpha: _Array,  # filled (ny, nx) f4
    modulus: _Array,  # filled (ny, nx) f4
    /,
) -> None: ...

# ---- terrain ----
TILE: int  # cells along one side of a tile
PAGE: int  # .. and of a page of a sparse picture
PAGE_EDGE: int  # .. and so many of its neighbours' beyond each side

def soil_fields() -> tuple[int, int, int]: ...  # surface_, carried_ of soil 0, layer_1: from which others count
def fields() -> tuple[tuple[str, int, str, str, str], ...]: ...  # name, number, unit, equation, meaning
def terrain_base_height(vertices: _Array, triangles: _Array, xy: _Array, height: _Array, /) -> None: ...
def mesh_cut(
    points: _Array,  # (n, 3) f4
    corners: _Array,  # (c,) i4
    starts: _Array | None,  # (f + 1,) i4
    sides: int,
    place: _Array,  # (3, 4) f8
    box: _Array | None,  # (4,) f8
    /,
) -> tuple[_Vec3, _Vec3, int, Any, Any, Any]: ...  # Blocks; None where a point is not finite
def are_quads(corners: _Array, corner_edges: _Array, edges: _Array, /) -> bool: ...
def are_centres(vertices: _Array, cell: float, x0: float, y0: float, most: float, /) -> bool: ...

# ---- maps ----
def planes_at(
    planes: Sequence[_Array],  # (ny, nx) f4 each
    x0: float,
    y0: float,
    cell: float,
    still: float,
    points: _Array,  # (n, 3) f8, f4 with a place
    place: _Array | None,  # (3, 4) f8
    out: _Array,  # added to (planes, n) f4
    /,
) -> None: ...
def maps_write(
    path: str | bytes | PathLike[str],
    names: Sequence[str],
    planes: Sequence[_Array],
    notes: _Notes,
    fill: Callable[[int], object] = ...,
    ny: int = ...,
    /,
) -> None: ...
def maps_read(
    path: str | bytes | PathLike[str], /
) -> tuple[int, int, tuple[str, ...], bytearray, tuple[tuple[str, str | float], ...]]: ...

# ---- refine ----
def refine(
    points: _Array,  # (n, 3) f8
    triangles: _Array,  # (t, 3) i4
    corners: _Array,  # (w, 2) f8
    sizes: _Array,  # (w,) f8
    block: float,
    max_triangles: int,
    /,
) -> tuple[Any, ...]: ...
def refine_detail(
    points: _Array,  # (n, 3) f8
    detail: dict[str, float],  # of detail_numbers(), by name
    seed: int,
    shown: _Array,  # (n, 6) f4
    /,
) -> None: ...
def detail_numbers() -> _Numbers: ...

# ---- paths ----
def arrival(
    cost: _Array,  # (ny, nx) f4
    cell: float,
    goals: _Array,  # (g,) i4
    starts: _Array,  # (g,) f4
    time: _Array,  # (ny, nx) f4
    /,
) -> None: ...
def direction(time: _Array, cell: float, direction: _Array, /) -> None: ...  # (ny, nx) f4, (ny, nx, 2) f4
def descend(
    time: _Array,  # (ny, nx) f4
    cell: float,
    pull: _Array | None,  # (ny, nx, 2) f4
    x: float,
    y: float,
    step: float,
    turn: _Array | None,  # (n,) f4
    inertia: float,
    /,
) -> Block: ...

# ---- types ----
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
