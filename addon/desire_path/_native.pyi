"""The core as Python sees it: native/python/module.c names the files that hold each of these.

Buffers are arrays in C order of the type and shape said behind them; those that are filled must be writable. All
arguments but those of Simulation() are given by their place. Units and meaning stand with each function's docstring.
"""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any

from ._native_types import Block as Block
from ._native_types import Film as Film
from ._native_types import Simulation as Simulation
from ._native_types import (
    _Array,
    _Box,
    _Gait,
    _Imprint,
    _Kind,
    _Moved,
    _Notes,
    _Numbers,
    _Patch,
    _Pressed,
    _Settled,
    _Vec3,
)

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
