"""What a plant looks like: small meshes of stems that know how to bend. NumPy alone, SI units.

    LOOKS["fern"] --tuft(kind, look, seed)--> Tuft: vertices, faces, and how each stem is shaped

A stem is drawn straight, (x, y, s) with s along it, and bent then: at s it is tilted from upright by
the vector tilt + arch * s / length [rad], whose direction is where it tilts to. So any shape keeps its
length however it bends, and grass that is trodden bends by the same rule with other numbers.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Record
from .kinds import Kind

GAUSS = tuple((0.5 + 0.5 * x, 0.5 * w) for x, w in ((-math.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (math.sqrt(0.6), 5 / 9)))
SHORTEST = 0.001  # stem [m]
BURIED = 0.012  # how far a stem begins under the ground, so that none floats on a slope [m]


_Faces = list[tuple[int, ...]]
_Part = tuple[np.ndarray, _Faces]  # vertices (n, 3), faces
_Stem = tuple[np.ndarray, _Faces, np.ndarray]  # and which vertices are a head's (n,)


@dataclass(frozen=True)
class Stems:
    """Stems of one sort in a tuft; pairs are ranges."""

    count: int
    length: tuple  # in heights of the kind
    width: float  # at the widest [m]
    spread: float  # how far roots lie from the middle, in half widths of the kind
    tilt: tuple  # at the root, outwards [rad]
    arch: tuple  # more at the tip [rad]
    shape: str = "blade"  # blade, stalk, ear, panicle, frond or shoot
    rows: int = 5  # pieces along it
    leaves: int = 0  # of a frond (pairs) or shoot, grains of an ear or panicle
    leaf: float = 0.0  # length of a leaf, grain or awn [m]


@dataclass(frozen=True)
class Look:
    """Sorts of stems, and colours (linear red, green, blue): low and high on a stem, heads, dead."""

    stems: tuple
    low: tuple
    high: tuple
    head: tuple
    dead: tuple
    tufts: int = 8  # different ones
    sizes: tuple = (0.75, 1.2)


LOOKS = {
    "carex": Look(
        (Stems(80, (0.55, 1.5), 0.0027, 2.4, (0.02, 0.45), (0.4, 1.4), rows=5),),
        (0.055, 0.095, 0.020),
        (0.165, 0.265, 0.052),
        (0.20, 0.16, 0.06),
        (0.38, 0.29, 0.135),
    ),
    "lycopodium": Look(
        (Stems(11, (0.45, 1.1), 0.0022, 2.4, (0.0, 0.35), (-0.2, 0.3), "shoot", 4, 40, 0.0095),),
        (0.020, 0.060, 0.018),
        (0.050, 0.150, 0.040),
        (0.16, 0.17, 0.05),
        (0.24, 0.17, 0.075),
    ),
    "lawn": Look(
        (Stems(64, (0.5, 1.25), 0.0028, 2.0, (0.0, 0.4), (-0.1, 0.9), rows=3),),
        (0.045, 0.095, 0.022),
        (0.125, 0.270, 0.050),
        (0.2, 0.2, 0.1),
        (0.40, 0.33, 0.155),
        sizes=(0.8, 1.15),
    ),
    "meadow": Look(
        (
            Stems(52, (0.35, 1.25), 0.0040, 2.0, (0.0, 0.35), (0.15, 1.2), rows=6),
            Stems(3, (1.0, 1.4), 0.0016, 1.0, (0.0, 0.15), (0.1, 0.5), "panicle", 5, 14, 0.007),
            Stems(8, (0.2, 0.4), 0.011, 1.8, (0.3, 0.8), (0.2, 0.7), rows=4),
        ),
        (0.046, 0.088, 0.020),
        (0.165, 0.270, 0.055),
        (0.34, 0.265, 0.14),
        (0.42, 0.33, 0.16),
    ),
    "wheat": Look(
        (
            Stems(3, (0.95, 1.1), 0.0032, 0.7, (0.0, 0.08), (0.02, 0.25), "ear", 6, 18, 0.012),
            Stems(6, (0.45, 0.75), 0.010, 0.7, (0.05, 0.3), (0.5, 1.7), rows=6),
        ),
        (0.16, 0.135, 0.045),
        (0.42, 0.300, 0.100),
        (0.52, 0.350, 0.130),
        (0.44, 0.33, 0.16),
        sizes=(0.88, 1.1),
    ),
    "moss": Look(
        (Stems(28, (0.45, 1.0), 0.0014, 2.0, (0.0, 0.45), (-0.1, 0.4), "shoot", 1, 6, 0.0085),),
        (0.028, 0.050, 0.010),
        (0.120, 0.185, 0.028),
        (0.25, 0.14, 0.05),
        (0.22, 0.165, 0.07),
    ),
    "fern": Look(
        (Stems(8, (0.9, 1.55), 0.0040, 0.25, (0.15, 0.6), (0.4, 1.2), "frond", 8, 17, 0.085),),
        (0.040, 0.075, 0.018),
        (0.085, 0.190, 0.035),
        (0.1, 0.1, 0.05),
        (0.27, 0.155, 0.06),
    ),
}
_PLAIN = "meadow"  # the blades of kinds that are nobody's


@dataclass(frozen=True, eq=False, repr=False)
class Tuft(Record):
    """One plant's mesh and the shape of its stems, a row per vertex."""

    vertices: np.ndarray  # (n, 3) f4 [m], root at 0, bent as it grows
    faces: tuple  # of vertex numbers, 3 or 4 each
    root: np.ndarray  # (n, 3) f4: place of the stem's root x, y [m]; its length [m]
    at: np.ndarray  # (n, 3) f4: x, y across the straight stem, s along it [m]
    tilt: np.ndarray  # (n, 3) f4: tilt vector at the root [rad]; z = 0
    arch: np.ndarray  # (n, 3) f4: tilt vector added up to the tip [rad]; z = 0
    look: np.ndarray  # (n, 3) f4: share of the way along 0..1, stem's tone 0..1, 1 = head


def look_of(name: object, kind: Kind) -> Look:
    """The Look of a kind by its name (a file's name may begin with it), else blades of its height."""
    word = Path(str(name)).stem.lower()
    for known, look in LOOKS.items():
        if word.startswith(known):
            return look
    blades = LOOKS[_PLAIN]
    return replace(
        blades,
        stems=tuple(
            replace(each, width=max(0.001, each.width * (kind.height / 0.3) ** 0.5)) for each in blades.stems[:1]
        ),
    )


def tuft(kind: Kind, look: Look, seed: int) -> Tuft:
    """One plant of a kind; other seeds are other plants of the same sort."""
    random = np.random.default_rng((seed, 20))
    blocks, faces, count = [], [], 0
    for sort in look.stems:
        for number in range(sort.count):
            length = max(SHORTEST, kind.height * random.uniform(*sort.length))
            out = 2 * math.pi * (number + random.uniform(-0.35, 0.35)) * 0.381966  # evenly round
            away = math.sqrt(random.uniform(0.0, 1.0))
            place = 0.5 * kind.width * sort.spread * away
            heading = out + random.normal(0.0, 0.35)
            towards = np.array((math.cos(heading), math.sin(heading)))
            # outer stems lean out, inner ones stand
            tilt = (sort.tilt[0] + (sort.tilt[1] - sort.tilt[0]) * away * random.uniform(0.4, 1.0)) * towards
            arch = random.uniform(*sort.arch) * towards
            straight, cut, head = _SHAPES[sort.shape](sort, length, random)
            turn = heading + math.pi / 2 + random.normal(0.0, 0.5)
            c, s = math.cos(turn), math.sin(turn)
            at = np.stack(
                [c * straight[:, 0] - s * straight[:, 1], s * straight[:, 0] + c * straight[:, 1], straight[:, 2]],
                axis=1,
            )
            rows = np.ones((len(at), 1))
            blocks.append(
                (
                    rows * (place * math.cos(out), place * math.sin(out), length),
                    at,
                    rows * (*tilt, 0.0),
                    rows * (*arch, 0.0),
                    np.stack([np.clip(at[:, 2] / length, 0.0, 1.0), rows[:, 0] * random.uniform(), head], axis=1),
                )
            )
            faces += [tuple(v + count for v in face) for face in cut]
            count += len(at)
    root, at, tilt, arch, apart = (np.concatenate(each).astype(np.float32) for each in zip(*blocks, strict=True))
    return Tuft(bent(root, at, tilt, arch).astype(np.float32), tuple(faces), root, at, tilt, arch, apart)


def bent(root: np.ndarray, at: np.ndarray, tilt: np.ndarray, arch: np.ndarray) -> np.ndarray:
    """Where the vertices of straight stems come to lie, (n, 3) [m]; arguments as in Tuft."""
    share = (at[:, 2:] / root[:, 2:]).astype(np.float64)
    out = np.zeros((len(at), 3))
    for place, weight in GAUSS:
        direction, rise, _ = _towards(tilt + arch * share * place)
        out += weight * at[:, 2:] * (direction * rise[:, :1] + (0.0, 0.0, 1.0) * rise[:, 1:])
    direction, rise, _ = _towards(tilt + arch * share)
    across = at * (1.0, 1.0, 0.0)
    along = (across * direction).sum(axis=1, keepdims=True)
    out += across - direction * along * (1.0 - rise[:, 1:]) - (0.0, 0.0, 1.0) * along * rise[:, :1]
    return out + root * (1.0, 1.0, 0.0)


def _towards(vector: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A tilt vector's direction (n, 3), the sine and cosine of its angle (n, 2), the angle (n, 1)."""
    angle = np.linalg.norm(vector, axis=1, keepdims=True)
    return vector / np.maximum(angle, 1e-9), np.concatenate([np.sin(angle), np.cos(angle)], axis=1), angle


# ---- straight stems: vertices (x, y, s), faces, 1 where a vertex belongs to a head --------------------


def _strip(places: np.ndarray, width: np.ndarray, x0: float = 0.0) -> _Part:
    """A ribbon along s, as wide as told at each place; the last may be a point."""
    points: list[Any] = []
    faces: _Faces = []
    for row, (s, half) in enumerate(zip(places, 0.5 * width, strict=True)):
        points += [(x0 - half, 0.0, s), (x0 + half, 0.0, s)]
        if row:
            k = 2 * row
            faces.append((k - 2, k - 1, k + 1, k))
    return np.array(points), faces


def _join(parts: Iterable[tuple[_Part, float]]) -> _Stem:
    points, faces, heads, count = [], [], [], 0
    for (each, cut), head in parts:
        points.append(each)
        faces += [tuple(v + count for v in face) for face in cut]
        heads.append(np.full(len(each), float(head)))
        count += len(each)
    return np.concatenate(points), faces, np.concatenate(heads)


def _rows(sort: Stems, length: float, end: float = 1.0) -> np.ndarray:
    return np.concatenate([[-BURIED], np.linspace(0.0, length * end, sort.rows + 1)])


def _blade(sort: Stems, length: float, random: np.random.Generator) -> _Stem:
    """Widest at a third, pointed."""
    places = _rows(sort, length)
    u = np.clip(places / length, 0.0, 1.0)
    width = sort.width * random.uniform(0.75, 1.2) * np.minimum(1.0, 0.62 + 1.3 * u) * (1.0 - u**2.6) ** 0.8
    return _join([(_strip(places, np.maximum(width, 1e-5)), 0)])


def _stalk(sort: Stems, length: float, random: np.random.Generator) -> list[tuple[_Part, float]]:
    """Two ribbons that cross."""
    places = _rows(sort, length)
    width = sort.width * (1.0 - 0.5 * np.clip(places / length, 0.0, 1.0))
    points, faces = _strip(places, width)
    other = points[:, (1, 0, 2)]
    return [((points, faces), 0), ((other, faces), 0)]


def _leaf(start: ArrayLike, along: ArrayLike, side: ArrayLike, width: float) -> _Part:
    """A pointed leaf of two triangles from `start`, `along` long, `side` the direction of its width."""
    start, along, half = np.asarray(start, float), np.asarray(along, float), 0.5 * width * np.asarray(side, float)
    middle = start + 0.4 * along
    return np.array([start, middle - half, start + along, middle + half]), [(0, 1, 2, 3)]


def _around(angle: float) -> tuple[np.ndarray, np.ndarray]:
    return np.array((math.cos(angle), math.sin(angle), 0.0)), np.array((-math.sin(angle), math.cos(angle), 0.0))


def _ear(sort: Stems, length: float, random: np.random.Generator) -> _Stem:
    """A stalk with grains in rows and their awns."""
    parts = _stalk(sort, length, random)
    ear = 0.10 * length
    for k in range(sort.leaves):
        s = length - ear * (1.0 - k / sort.leaves)
        out, side = _around(math.pi / 2 * (k % 4) + 0.3)
        grain = sort.leaf * (0.8 + 0.4 * math.sin(math.pi * k / sort.leaves))
        parts.append(
            (_leaf((0.001 * out[0], 0.001 * out[1], s), 0.42 * grain * out + (0, 0, grain), side, 0.62 * grain), 1)
        )
        if k % 3 == 0:
            parts.append(
                (_leaf((0.003 * out[0], 0.003 * out[1], s + 0.6 * grain), 0.014 * out + (0, 0, 0.045), side, 0.0011), 1)
            )
    return _join(parts)


def _panicle(sort: Stems, length: float, random: np.random.Generator) -> _Stem:
    """A stalk with a loose head of seeds."""
    parts = _stalk(sort, length, random)
    head = 0.28 * length
    for k in range(sort.leaves):
        share = k / sort.leaves
        out, side = _around(2.4 * k + random.uniform(-0.4, 0.4))
        twig = 0.14 * head * (1.0 - share) * random.uniform(0.5, 1.1) + 0.0015
        s = length - head * (1.0 - share)
        parts.append(
            (
                _leaf(
                    twig * out + (0, 0, s + 0.5 * twig),
                    0.35 * sort.leaf * out + (0, 0, sort.leaf),
                    side,
                    0.42 * sort.leaf,
                ),
                1,
            )
        )
    return _join(parts)


def _frond(sort: Stems, length: float, random: np.random.Generator) -> _Stem:
    """A rib with leaves to both sides, longest at a third, each a row of leaflets."""
    parts: list[tuple[_Part, float]] = [
        (_strip(_rows(sort, length), np.linspace(sort.width, 0.0006, sort.rows + 2)), 0)
    ]
    size = length / 0.55  # leaves grow with the frond
    for k in range(sort.leaves):
        u = 0.14 + 0.84 * k / sort.leaves
        pinna = sort.leaf * size * (1.0 - u) ** 0.75 * min(1.0, 0.45 + 2.2 * (u - 0.14)) * random.uniform(0.9, 1.08)
        step = 0.84 * length / sort.leaves
        for side in (-1.0, 1.0):
            along = np.array((side, -0.16, 0.42)) * pinna
            start = np.array((0.0, 0.0, u * length + (0.3 * step if side > 0 else 0.0)))
            parts.append((_pinna(start, along, 0.98 * step), 0))
    return _join(parts)


def _pinna(start: np.ndarray, along: np.ndarray, width: float) -> _Part:
    """A toothed leaf: a strip whose edge goes in and out."""
    points: list[Any] = []
    faces: _Faces = []
    teeth = 5
    for k in range(teeth + 1):
        u = k / teeth
        half = 0.5 * width * (1.0 - u**2) ** 0.8
        for at, wide in ((u, 1.0), (u + 0.55 / teeth, 0.45)):
            if at > 1.0:
                continue
            middle = start + along * at
            points += [middle - (0, 0, half * wide), middle + (0, 0, half * wide)]
            if len(points) > 2:
                n = len(points)
                faces.append((n - 4, n - 3, n - 1, n - 2))
    return np.array(points), faces


def _shoot(sort: Stems, length: float, random: np.random.Generator) -> _Stem:
    """A stem with small leaves all around."""
    parts = _stalk(sort, length, random)
    for k in range(sort.leaves):
        u = (k + 0.5) / sort.leaves
        out, side = _around(2.39996 * k)
        size = sort.leaf * (1.0 - 0.45 * u) * random.uniform(0.8, 1.1)
        up = 0.35 + 0.75 * u
        parts.append(
            (
                _leaf((0, 0, u * length), size * (out + (0, 0, up)) / math.hypot(1.0, up), side, 0.34 * size),
                1 if u > 0.86 else 0,
            )
        )
    return _join(parts)


_SHAPES = {
    "blade": _blade,
    "ear": _ear,
    "panicle": _panicle,
    "frond": _frond,
    "shoot": _shoot,
    "stalk": lambda *each: _join(_stalk(*each)),
}
