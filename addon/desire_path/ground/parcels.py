"""Grounds side by side that one walk crosses, as the tiles of a terrain: pressed as one, each with a bake of its own.

Parcels --storeys--> those that lie beside each other | those that lie over others
a storey --sewn--> one Ground and its soils, without a gap where two of them meet
a recording --treads--> which storey each foot is on: the one whose height is nearest to it
"""

from __future__ import annotations

import functools
import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import DesirePathError
from ..motion import tracks
from ..motion.points import below_sole, moved_points
from ..motion.tracks import TrackArray
from .layers import Layer
from .planting import as_plantings
from .sim import Ground, Simulation, as_soils
from .soil_keys import AnySoil

if TYPE_CHECKING:
    from ..loads.force import FootForce
    from ..motion.gait import Gait
    from ..motion.tracks import Array

RATE = 10.0  # feet are looked at so often to find what they pass over [1/s]
APART = 0.25  # grounds whose heights differ more than this at one place lie over each other [lengths of a sole]
BELOW, AROUND = 9, 17  # places looked at below and around a foot
SEAM = 1e-3  # rims reach this far beyond, so that no place is lost between two [cells] ..
ROUNDING = 4e-7  # .. or this share of where they lie: what single precision loses


@dataclass(frozen=True, eq=False)
class Parcel:
    """One ground of several that a walk crosses. Only grounds of triangles can lie beside each other.

    ground: Ground; soils, plants: as for Simulation, plants stand on this ground only.
    folder, plant_mesh, owner, inputs: as for Bake, of its own files; name: for sentences and reports.
    """

    ground: Ground
    soils: Any = "dry-sand"
    folder: str = "bake"
    name: str = "ground"
    plants: Any = ()
    plant_mesh: bool = False
    owner: str = ""
    inputs: dict = field(default_factory=dict)

    def __post_init__(self) -> None:
        put = functools.partial(object.__setattr__, self)
        put("soils", tuple(as_soils(self.soils)))
        put("plants", tuple(as_plantings(self.plants)))
        put("folder", os.path.abspath(os.fspath(self.folder)))
        put("owner", str(self.owner))
        if self.plant_mesh and not self.plants:
            raise DesirePathError("There are no plants to write as a mesh: give the bake plants, or no plant_mesh.")

    @cached_property
    def land(self) -> Simulation:
        """A Simulation of its shape alone, to ask for heights."""
        native = self.ground.native
        return Simulation(Ground(native if native[0] == "flat" else (*native[:-1], None), self.ground.name))

    @property
    def box(self) -> tuple[float, float, float, float]:
        """World box (x0, y0, x1, y1) [m]; infinite for flat ground."""
        return self.land.bounds()

    def has(self, xy: np.ndarray) -> np.ndarray:
        """Whether it lies below places (n, 2)."""
        return np.isfinite(self.land.rest_height(xy))


# ---- what lies beside what ------------------------------------------------------------------------------


def around(gait: Gait) -> np.ndarray:
    """Places (n, 3) below and around the feet of a recording, at the height of the feet [m]: BELOW of them as far as
    half a sole is long, then the others, AROUND in all for each foot. Who is not there treads nowhere.
    """
    span = gait.time[-1] - gait.time[0]
    step = max(1, int(len(gait.time) / max(1.0, span * RATE)))
    found = []
    for _, first, places in _points_there(gait):
        seen = places[:, -first % step :: step]
        found.append((seen if seen.size else places[:, :1]).reshape(-1, 3))
    at = np.concatenate(found)
    radius = length(gait)
    turn = np.arange(8) * np.pi / 4
    ring = radius * np.stack([np.cos(turn), np.sin(turn)], 1)
    ring = np.concatenate([np.zeros((1, 2)), 0.5 * ring, ring])
    out = np.repeat(at, len(ring), axis=0)
    out[:, :2] += np.tile(ring, (len(at), 1))
    return out


def _points_there(gait: Gait) -> Iterator[tuple[np.ndarray, int, np.ndarray]]:
    """(contact points (k,), first sample, their places (k, n, 3) [m]) while their walkers are there."""
    for rows, first, poses in tracks.blocks(gait.pose):
        points = np.flatnonzero(np.isin(gait.point_part, rows))
        yield points, first, moved_points(poses[np.searchsorted(rows, gait.point_part[points])], gait.point[points])


def length(gait: Gait) -> float:
    """Of the longest sole [m]."""
    return max(float(np.ptp(sole.vertices.astype(float), axis=0).max()) for sole in gait.soles)


def heights(parcels: Sequence[Parcel], xy: np.ndarray) -> np.ndarray:
    """Of each parcel at places (n, 2), NaN where it is not (parcels, n) [m]."""
    xy = np.ascontiguousarray(xy)
    return np.array([parcel.land.rest_height(xy) for parcel in parcels]).reshape(len(parcels), len(xy))


def nearest(height: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Which of several grounds (n,) is nearest in height to z, of heights (grounds, n); -1 where there is none."""
    return least(np.abs(height - z))


def least(away: np.ndarray) -> np.ndarray:
    """Which of several is the least at each place, of (grounds, n); -1 where all are NaN."""
    away = np.where(np.isfinite(away), away, np.inf)
    found = away.argmin(axis=0)
    return np.where(np.isfinite(away.min(axis=0)), found, -1)


def storeys(parcels: Sequence[Parcel], gait: Gait) -> list[list[int]]:
    """Numbers of the parcels that lie beside each other, storey by storey; those trodden most come first."""
    if len(parcels) == 1:
        return [[0]]
    at = around(gait)
    height = heights(parcels, at[:, :2])
    trodden = np.bincount(nearest(height, at[:, 2]) + 1, minlength=len(parcels) + 1)[1:]
    max_apart = APART * length(gait)
    there = np.isfinite(height)
    below = there.reshape(len(parcels), -1, AROUND)[..., :BELOW]

    def apart(a: int, b: int) -> bool:
        """Whether one lies over the other: at another height, or below all of a foot."""
        return (np.abs(height[a] - height[b]) > max_apart).any() or (below[a] & below[b]).all(axis=1).any()

    found: list[list[int]] = []
    for number in sorted(range(len(parcels)), key=lambda n: (-trodden[n], n)):
        for storey in found:
            if not any(apart(other, number) for other in storey):
                storey.append(number)
                break
        else:
            found.append([number])
    return [sorted(storey) for storey in found]


def treads(gait: Gait, lands: Sequence[Callable[[np.ndarray], np.ndarray]]) -> tuple[Array, Array]:
    """(storey of each part (P, T), height of the ground each contact point treads (K, T) [m]) among storeys.

    lands: rest_height of each. A part none of whose points is over ground treads what its sole reaches over; who is
    over none of them is on the first. Of who is not there nothing is told: storey 0, height NaN.
    """
    found, below = [], []
    for (points, first, at), (rows, _, poses) in zip(_points_there(gait), tracks.blocks(gait.pose)):
        height = np.array([land(np.ascontiguousarray(at[..., :2].reshape(-1, 2))) for land in lands])
        height = height.reshape(len(lands), *at.shape[:2])
        parts = np.zeros(poses.shape[:2], np.int64)
        own = np.searchsorted(rows, gait.point_part[points])
        for part in np.unique(own):
            mine = np.flatnonzero(own == part)
            beside = np.flatnonzero(~np.isfinite(height[:, mine]).any(axis=(0, 1)))
            if len(beside):
                here = np.ix_(mine, beside)
                for each, land in zip(height, lands):
                    each[here] = below_sole(gait.soles[rows[part]], poses[part, beside], at[here], land)
            away = np.abs(height[:, mine] - at[mine, :, 2])
            away = np.where(np.isfinite(away), away, np.inf).min(axis=1)
            parts[part] = away.argmin(axis=0)
        found.append(parts)
        below.append((points, first, np.take_along_axis(height, parts[own][None], axis=0)[0]))
    if not isinstance(gait.pose, TrackArray):
        return found[0], below[0][2]
    samples = len(gait.time)
    return gait.pose.alike(found, 0), TrackArray(len(gait.point), samples, below, np.nan)


# ---- one ground of several -------------------------------------------------------------------------------


def sewn(parcels: Sequence[Parcel], cell: float) -> tuple[Ground, list[AnySoil]]:
    """(Ground, soils) of parcels that lie beside each other: all triangles, and all soils by their own names; with the
    trail of the one that has one."""
    if len(parcels) == 1:
        return parcels[0].ground, list(parcels[0].soils)
    trodden = [parcel for parcel in parcels if parcel.ground.trail is not None]
    if len(trodden) > 1:
        raise DesirePathError(
            f"'{trodden[0].name}' and '{trodden[1].name}' both have a trail already, and a walk over several grounds "
            "goes on from one: free what was pressed into the others, or bake each ground by itself."
        )
    for parcel in parcels:
        if parcel.ground.layers != parcels[0].ground.layers:
            raise DesirePathError(
                f"'{parcels[0].name}' and '{parcel.name}' have different layers: give both the same, painted where "
                "they lie, or bake each ground by itself."
            )
        if parcel.ground.native[0] != "mesh":
            raise DesirePathError(f"'{parcel.name}' is no mesh: only meshes can be baked together.")
    vertices = [parcel.ground.native[1] for parcel in parcels]
    triangles = [parcel.ground.native[2] for parcel in parcels]
    soils = list(dict.fromkeys(soil for parcel in parcels for soil in parcel.soils))
    kinds = [_kinds(parcel, soils) for parcel in parcels]
    shares = [_shares(parcel) for parcel in parcels]
    beyond = max(SEAM * cell, ROUNDING * max(np.abs(each[:, :2]).max() for each in vertices))
    boxes = [(each[:, :2].min(axis=0) - beyond, each[:, :2].max(axis=0) + beyond) for each in vertices]
    for number in range(len(parcels)):
        near = np.zeros(len(triangles[number]), bool)
        corner = vertices[number][:, :2][triangles[number]]
        low, high = corner.min(axis=1), corner.max(axis=1)
        for other, (x, y) in enumerate(boxes):
            if other != number:
                near |= (high >= x).all(axis=1) & (low <= y).all(axis=1)
        rim = _rim(triangles[number])
        more, faces = _hem(vertices[number], triangles[number], rim & near[:, None], beyond)
        kinds[number] = np.concatenate([kinds[number], kinds[number][:, more[1]]], axis=1)
        shares[number] = np.concatenate([shares[number], shares[number][:, more[1]]], axis=1)
        vertices[number] = np.concatenate([vertices[number], more[0]])
        triangles[number] = np.concatenate([triangles[number], faces])
    first = np.cumsum([0] + [len(each) for each in vertices[:-1]])
    ground = Ground.mesh(
        np.concatenate(vertices),
        np.concatenate([each + start for each, start in zip(triangles, first)]),
        np.concatenate(kinds, axis=1) if len(soils) > 1 else None,
    )
    share = np.concatenate(shares, axis=1)
    painted = [any(each.share is not None for each in lie) for lie in zip(*(p.ground.layers for p in parcels))]
    layers = zip(parcels[0].ground.layers, share, painted)
    ground = ground.layered(*(Layer(each.soil, each.thickness, row if some else None) for each, row, some in layers))
    if trodden:
        ground = replace(ground, trail=trodden[0].ground.trail)
    return ground, as_soils(soils)


def _kinds(parcel: Parcel, soils: list[AnySoil]) -> np.ndarray:
    """Weights of all soils at the vertices of a parcel (soils, n): the heaviest of its own is still the same."""
    own = parcel.soils
    count = len(parcel.ground.native[1])
    weight = parcel.ground.native[3]
    if weight is None:
        weight = np.zeros((len(own), count), np.float32)
        weight[0] = 1.0
    out = np.zeros((len(soils), count), np.float32)
    for soil, row in zip(own, weight):
        at = soils.index(soil)
        out[at] = np.maximum(out[at], row)
    return out


def _shares(parcel: Parcel) -> np.ndarray:
    """How much of each layer lies at the vertices of a parcel (layers, n)."""
    shares = [layer.share for layer in parcel.ground.layers]
    count = len(parcel.ground.native[1])
    rows = [np.ones(count, np.float32) if share is None else share for share in shares]
    return np.array(rows, np.float32).reshape(len(rows), count)


def _rim(triangles: np.ndarray) -> np.ndarray:
    """Which edges of triangles (m, 3), from each corner to the next, belong to one triangle only (m, 3)."""
    edge = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1).reshape(-1, 2).astype(np.int64)
    edge.sort(axis=1)
    _, of, count = np.unique(
        edge[:, 0] * (edge.max(initial=0) + 1) + edge[:, 1], return_inverse=True, return_counts=True
    )
    return (count[of.reshape(-1)] == 1).reshape(-1, 3)


def _hem(
    vertices: np.ndarray, triangles: np.ndarray, rim: np.ndarray, wide: float
) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray]:
    """((new vertices, number of the old one at each), triangles) of strips along rim edges, `wide` [m], level."""
    face, side = np.nonzero(rim)
    a, b, c = (triangles[face, (side + k) % 3] for k in range(3))
    along = (vertices[b] - vertices[a])[:, :2]
    out = np.stack([along[:, 1], -along[:, 0]], axis=1)
    size = np.linalg.norm(out, axis=1)
    inward = np.einsum("ni,ni->n", out, (vertices[c] - vertices[a])[:, :2]) > 0.0
    out *= (np.where(inward, -wide, wide) / np.maximum(size, 1e-300))[:, None]
    along *= (wide / np.maximum(size, 1e-300))[:, None]
    fresh = np.concatenate([vertices[a], vertices[b]])
    fresh[:, :2] += np.concatenate([out - along, out + along])  # past its ends: corners are closed, too
    p = len(vertices) + np.arange(len(a))
    q = p + len(a)
    faces = np.concatenate([np.stack(each, axis=1) for each in ((a, b, q), (a, q, p))]).astype(np.int32)
    return (fresh, np.concatenate([a, b])), faces


# ---- what one of several bears -----------------------------------------------------------------------------


def on(loads: FootForce, over: Array, storey: int) -> FootForce:
    """The loads of the parts that tread one of several storeys; over: of each part (P, T), see treads()."""
    here = [each == storey for each in tracks.values(over)]

    def borne(array: Array, elsewhere: float) -> Array:
        found = [
            np.where(on if values.ndim == 2 else on[..., None], values, elsewhere).astype(values.dtype)
            for on, values in zip(here, tracks.values(array))
        ]
        return array.alike(found, array.missing) if isinstance(array, TrackArray) else found[0]

    return replace(
        loads, touching=borne(loads.touching, 0), force=borne(loads.force, 0.0), point=borne(loads.point, np.nan)
    )


def under(parcel: Parcel, gait: Gait, loads: FootForce, wide: float) -> tuple[float, ...] | None:
    """Rectangle (x0, y0, x1, y1) [m] of a parcel that feet which touch can change, `wide` [m] around their soles; None
    where they do not reach it."""
    size = np.array([np.linalg.norm(sole.vertices.astype(float), axis=1).max() for sole in gait.soles])
    own = np.array(parcel.box)
    lows, highs = [], []
    for rows, first, poses in tracks.blocks(gait.pose):
        before = min(first, 1)
        near = loads.touching[rows, first - before : first + poses.shape[1] + 1] != 0
        touching = near.copy()  # a step presses where either of its ends touches
        touching[:, :-1] |= near[:, 1:]
        touching[:, 1:] |= near[:, :-1]
        part, sample = np.nonzero(touching[:, before : before + poses.shape[1]])
        radius = size[rows[part], None] + wide
        at = poses[part, sample, :2]
        low, high = np.maximum(at - radius, own[:2]), np.minimum(at + radius, own[2:])
        there = (low < high).all(axis=1)
        lows.append(low[there])
        highs.append(high[there])
    low, high = np.concatenate(lows), np.concatenate(highs)
    return (*low.min(axis=0), *high.max(axis=0)) if len(low) else None


def contacts(parcel: Parcel, gait: Gait, loads: FootForce, end: int, every: Sequence[Parcel] = ()) -> int:
    """How many stances, begun before sample `end`, put load on a parcel: one over an edge counts on both sides.

    every: all parcels of the walk; a load that is over none of them is on those its sole reaches over.
    """
    limbs, samples, bearing = [], [], []
    for (rows, first, touching), values in zip(tracks.blocks(loads.touching), tracks.values(loads.point)):
        part, sample = np.nonzero(touching[:, : max(end - first, 0)])
        point = values[part, sample]
        bears = _over(parcel, point)
        beside = np.isfinite(point).all(axis=1) & ~np.logical_or.reduce(
            [bears, *(_over(each, point) for each in every)]
        )
        for own in np.unique(part[beside]):
            mine = np.flatnonzero(beside & (part == own))
            pose = np.asarray(gait.pose[int(rows[own])])[first + sample[mine]]
            below = below_sole(gait.soles[rows[own]], pose, point[None, mine], parcel.land.rest_height)
            bears[mine] = np.isfinite(below[0])
        limbs.append(gait.part_limb[rows[part]])
        samples.append(first + sample)
        bearing.append(bears)
    limb, sample, bears = (np.concatenate(each) for each in (limbs, samples, bearing))
    order = np.lexsort((sample, limb))
    limb, sample, bears = limb[order], sample[order], bears[order]
    begins = (np.diff(limb, prepend=-1) != 0) | (np.diff(sample, prepend=0) > 2)  # as the core tells stances apart
    return len(np.unique(np.cumsum(begins)[bears]))


def _over(parcel: Parcel, point: np.ndarray) -> np.ndarray:
    """Whether a parcel lies below points (n, 3); not where they are NaN."""
    found, known = np.zeros(len(point), bool), np.isfinite(point).all(axis=1)
    found[known] = parcel.has(np.ascontiguousarray(point[known, :2]))
    return found
