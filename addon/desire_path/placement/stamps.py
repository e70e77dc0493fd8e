"""Shapes that press one mark each: boots, a bare foot, a horse-shoe, paws. Ours, drawn from pads and strokes.

    ellipses, strokes, polygons, in shares of a length ---Stamp.sole---> Sole, of a left foot or mirrored
    a picture, a mesh of one's own -----Stamp.picture, Stamp.mesh-----^

A stamp lies flat: x forward, y left, z up, its middle at x = 0, its lowest places at z = 0. MODEL 3.8
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from ..errors import DesirePathError
from ..ground import maps
from ..motion.gait import Sole
from ..rig import sole as soles
from ..rig.sole import Faces

CORNERS = 28  # of a pad's outline
RINGS = (1.0, 0.92, 0.75, 0.5, 0.25)  # from a pad's rim inwards, in shares of its size
MAX_PIXELS = 128  # of a picture from side to side that are told apart
DARK = 1.0 / 64.0  # pixels below do not touch
LARGEST, SMALLEST = 100.0, 1e-3  # a stamp may be so long [m]

Outline: TypeAlias = np.ndarray  # (n, 2), once round, counter-clockwise from above, seen from its mean as a star


@dataclass(frozen=True)
class Stamp:
    """A shape that presses one mark, and how those usually go that leave such marks.

    draw: (vertices (V, 3) [m], triangles (F, 3)) of a left one that is so long [m], laid as the module says
    """

    draw: Callable[[float], Faces]
    length: float  # [m]
    leg: float  # of who goes on it, hips to ankles [m]
    mass: float  # that rests on one mark [kg]
    spacing: float  # from mark to mark along the curve [m]
    width: float  # between the lines of left and right marks [m]
    speed: float  # [m/s]
    toe_out: float = 0.0  # marks are turned outward by this [rad]

    @staticmethod
    def mesh(vertices: np.ndarray, triangles: np.ndarray, **numbers: float) -> Stamp:
        """A stamp of a mesh of one's own, of a left foot, x forward and z up [m]; numbers: others than a boot's.

        Its middle is put at x = y = 0 and its lowest place at z = 0.
        """
        vertices, triangles = np.array(vertices, float).reshape(-1, 3), np.array(triangles, "i8").reshape(-1, 3)
        if not len(triangles) or triangles.min() < 0 or triangles.max() >= len(vertices):
            raise DesirePathError("The stamp's mesh has no faces, or one without its vertices: repair the mesh.")
        if not np.isfinite(vertices).all():
            raise DesirePathError("The stamp's mesh has NaN or infinite vertices: repair the mesh.")
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        length = float(high[0] - low[0])
        if not length > 0.0:
            raise DesirePathError("The stamp's mesh has no length along x: turn it, so that x is forward and z up.")
        laid = (vertices - (*(low + high)[:2] / 2.0, low[2])) / length
        own = STAMPS["boot"]
        usual = {name: getattr(own, name) for name in ("leg", "mass", "spacing", "width", "speed", "toe_out")}
        return Stamp(lambda long: (laid * long, triangles), **{**usual, "length": length, **numbers})

    @staticmethod
    def picture(pixels: np.ndarray, length: float = 0.3, height: float = 0.01, **numbers: float) -> Stamp:
        """A stamp of a picture (ny, nx) from 0 to 1, its first row foremost: 0 = does not touch, 1 = lowest.

        length: from the first row to the last [m]; height: from what is nearly black to what is white [m] >= 0;
        numbers: others than a boot's.
        """
        pixels = np.array(pixels, float)
        if pixels.ndim != 2 or 0 in pixels.shape:
            raise DesirePathError(f"The stamp's picture has the shape {pixels.shape}: give it rows and columns.")
        if not np.isfinite(pixels).all():
            raise DesirePathError("The stamp's picture has NaN or infinite pixels: mend the picture.")
        for name, size, least in (("length", length, SMALLEST), ("height", height, 0.0)):
            if not least <= size <= LARGEST:
                raise DesirePathError(
                    f"A stamp with a {name} of {size:g} m is none: give one from {least:g} to {LARGEST:g} m."
                )
        pixels = _coarser(np.clip(pixels, 0.0, 1.0))
        if not (pixels >= DARK).any():
            raise DesirePathError("The stamp's picture is black all over, and touches nothing: paint its shape white.")
        vertices, triangles = _relief(pixels, length / len(pixels), height)
        return Stamp.mesh(vertices, triangles, **numbers)

    @staticmethod
    def read(path: str | os.PathLike[str], length: float = 0.3, height: float = 0.01) -> Stamp:
        """The same from an OpenEXR picture, its first channel of Y, V, Z, R or else the mean of all."""
        planes = maps.read(path).planes
        named = next((planes[name] for name in ("Y", "V", "Z", "R") if name in planes), None)
        return Stamp.picture(np.mean(list(planes.values()), axis=0) if named is None else named, length, height)

    def sole(self, left: bool = True, size: float = 1.0) -> Sole:
        """What presses, `size` times as large as usual."""
        vertices, triangles = self.draw(self.length * size)
        if left:
            return Sole(vertices, triangles)
        return Sole(vertices * (1.0, -1.0, 1.0), triangles[:, ::-1])


def find(stamp: str | Stamp) -> Stamp:
    """A stamp, by its name or itself."""
    if isinstance(stamp, Stamp):
        return stamp
    if stamp not in STAMPS:
        raise DesirePathError(f"There is no stamp '{str(stamp)[:40]}': choose one of {', '.join(STAMPS)}.")
    return STAMPS[stamp]


# ---- pictures -------------------------------------------------------------------------------------


def _coarser(pixels: np.ndarray) -> np.ndarray:
    """The means of blocks of pixels, where there are more than MAX_PIXELS from side to side."""
    block = -(-max(pixels.shape) // MAX_PIXELS)
    ny, nx = (-(-size // block) for size in pixels.shape)
    padded = np.zeros((ny * block, nx * block))
    padded[: pixels.shape[0], : pixels.shape[1]] = pixels
    return np.asarray(padded.reshape(ny, block, nx, block).mean(axis=(1, 3)))


def _relief(pixels: np.ndarray, side: float, height: float) -> Faces:
    """A square for each pixel that touches, so wide [m]; corners lie as deep as the pixels around, in the mean."""
    on = np.pad(pixels >= DARK, 1)
    deep = np.where(on, np.pad(pixels, 1), 0.0)
    around = ((0, 0), (0, 1), (1, 0), (1, 1))
    ny, nx = pixels.shape
    count = sum(on[j : j + ny + 1, i : i + nx + 1].astype(float) for j, i in around)
    mean = sum(deep[j : j + ny + 1, i : i + nx + 1] for j, i in around) / np.maximum(count, 1.0)
    row, column = np.mgrid[: ny + 1, : nx + 1]
    corner = np.stack([-row * side, -column * side, height * (1.0 - mean)], axis=-1).reshape(-1, 3)
    j, i = np.nonzero(on[1:-1, 1:-1])
    first = j * (nx + 1) + i  # ahead and left; the others to the right and behind
    right, behind = first + 1, first + nx + 1
    faces = np.concatenate([np.stack([first, right, behind], 1), np.stack([behind, right, behind + 1], 1)])
    used, faces = np.unique(faces, return_inverse=True)
    return corner[used], faces.reshape(-1, 3)


# ---- pads -----------------------------------------------------------------------------------------


def _ellipse(x: float, y: float, long: float, wide: float, turn: float = 0.0) -> Outline:
    """Half axes `long` along x and `wide` along y, turned [rad]."""
    angle = np.arange(CORNERS) * (2.0 * np.pi / CORNERS)
    u, v = long * np.cos(angle), wide * np.sin(angle)
    return np.stack([x + u * np.cos(turn) - v * np.sin(turn), y + u * np.sin(turn) + v * np.cos(turn)], axis=1)


def _stroke(x0: float, y0: float, r0: float, x1: float, y1: float, r1: float) -> Outline:
    """What a brush leaves that goes from one place to another, of a radius there and another here."""
    ahead = np.arctan2(y1 - y0, x1 - x0)
    half = np.linspace(-np.pi / 2.0, np.pi / 2.0, CORNERS // 2)
    end = np.stack([np.cos(ahead + half), np.sin(ahead + half)], axis=1)
    return np.concatenate([(x1, y1) + r1 * end, (x0, y0) - r0 * end])


def _pads(*pads: tuple[Outline, float, float]) -> Callable[[float], Faces]:
    """A stamp of pads, each (outline, how high its underside begins, how much its rim stands higher), in shares."""
    vertices, triangles, count = [], [], 0
    for outline, low, rise in pads:
        own, faces = _pad(outline, low, rise)
        vertices.append(own)
        triangles.append(faces + count)
        count += len(own)
    drawn, faces = np.concatenate(vertices), np.concatenate(triangles)
    drawn[:, 2] -= drawn[:, 2].min()
    first, last = drawn[:, 0].min(), drawn[:, 0].max()
    drawn[:, 0] -= (first + last) / 2.0
    drawn /= last - first
    return lambda length: (drawn * length, faces)


def _pad(outline: Outline, low: float, rise: float) -> Faces:
    """A bowl over an outline: rings to its middle, which is lowest; normals look down."""
    n, middle = len(outline), outline.mean(axis=0)
    rings = [np.column_stack([middle + s * (outline - middle), np.full(n, low + rise * s**4)]) for s in RINGS]
    k, after = np.arange(n), np.roll(np.arange(n), -1)
    faces: list[np.ndarray] = []
    for ring in range(len(RINGS) - 1):
        out, inner = ring * n, (ring + 1) * n
        faces.append(np.stack([out + k, inner + k, out + after], axis=1))
        faces.append(np.stack([out + after, inner + k, inner + after], axis=1))
    last = (len(RINGS) - 1) * n
    faces.append(np.stack([last + after, last + k, np.full(n, last + n)], axis=1))
    return np.concatenate([*rings, [[*middle, low]]]), np.concatenate(faces)


def _both(*pads: tuple[Outline, float, float]) -> list[tuple[Outline, float, float]]:
    """Pads, and the same on the other side."""
    return [*pads, *((outline[::-1] * (1.0, -1.0), low, rise) for outline, low, rise in pads)]


# ---- the library ----------------------------------------------------------------------------------


def _shoe(tread: str) -> Callable[[float], Faces]:
    """A built-in sole, heel and toe part as one."""

    def draw(length: float) -> Faces:
        ball = 0.66 * length
        heel, toe = soles.built_in(0.0, ball, length, True, tread)
        vertices = np.concatenate([heel.vertices, toe.vertices + np.array((ball, 0.0, 0.0), "f4")]).astype(float)
        vertices[:, 0] -= length / 2.0
        return vertices, np.concatenate([heel.triangles, toe.triangles + len(heel.vertices)])

    return draw


_FOOT = _pads(
    (_ellipse(0.135, 0.0, 0.135, 0.115), 0.0, 0.05),
    (_stroke(0.16, 0.035, 0.085, 0.56, 0.075, 0.085), 0.012, 0.04),
    (_stroke(0.50, 0.04, 0.10, 0.63, 0.0, 0.12), 0.008, 0.03),
    (_stroke(0.66, -0.10, 0.095, 0.61, 0.105, 0.078), 0.0, 0.05),
    (_ellipse(0.91, -0.115, 0.080, 0.058, -0.05), 0.0, 0.05),
    (_ellipse(0.915, -0.018, 0.048, 0.034), 0.004, 0.04),
    (_ellipse(0.885, 0.048, 0.042, 0.031, 0.1), 0.004, 0.04),
    (_ellipse(0.845, 0.104, 0.038, 0.029, 0.2), 0.004, 0.04),
    (_ellipse(0.795, 0.150, 0.034, 0.028, 0.3), 0.004, 0.04),
)


def _horse_shoe() -> Callable[[float], Faces]:
    """An iron that is open behind, and the frog in it."""
    angle = np.radians(np.linspace(-142.0, 142.0, 19))
    x, y = 0.43 * np.cos(angle), 0.40 * np.sin(angle)
    wide = 0.078 - 0.018 * abs(np.linspace(-1.0, 1.0, 19))
    iron = [(_stroke(x[i], y[i], wide[i], x[i + 1], y[i + 1], wide[i + 1]), 0.0, 0.02) for i in range(18)]
    return _pads(*iron, (_stroke(-0.36, 0.0, 0.11, 0.05, 0.0, 0.025), 0.06, 0.04))


_WOLF = _pads(
    (_ellipse(-0.24, 0.0, 0.17, 0.20), 0.0, 0.08),
    *_both(
        (_stroke(-0.30, 0.14, 0.09, -0.22, 0.06, 0.12), 0.0, 0.06),
        (_ellipse(0.10, 0.265, 0.145, 0.092, -0.12), 0.0, 0.08),
        (_ellipse(0.29, 0.105, 0.150, 0.088, -0.04), 0.0, 0.08),
        (_ellipse(0.49, 0.105, 0.035, 0.016), 0.02, 0.03),
        (_ellipse(0.29, 0.270, 0.033, 0.016, -0.1), 0.02, 0.03),
    ),
)
_DEER = _pads(
    *_both(
        (_stroke(-0.36, 0.14, 0.12, 0.10, 0.13, 0.11), 0.0, 0.05),
        (_stroke(0.05, 0.13, 0.11, 0.44, 0.055, 0.028), 0.0, 0.04),
    )
)
_GULL = _pads(
    (_stroke(-0.42, 0.0, 0.060, 0.56, 0.0, 0.026), 0.0, 0.03),
    *_both(
        (_stroke(-0.42, 0.0, 0.055, 0.42, 0.44, 0.024), 0.0, 0.03),
        (np.array([(-0.38, 0.02), (0.52, 0.01), (0.44, 0.18), (0.39, 0.42)]), 0.035, 0.01),
    ),
)

STAMPS: Mapping[str, Stamp] = MappingProxyType(
    {
        "boot": Stamp(_shoe("lugs"), 0.30, 0.86, 80.0, 0.72, 0.12, 1.4, np.radians(7.0)),
        "shoe": Stamp(_shoe("waves"), 0.28, 0.86, 75.0, 0.70, 0.10, 1.4, np.radians(7.0)),
        "foot": Stamp(_FOOT, 0.26, 0.86, 75.0, 0.66, 0.10, 1.3, np.radians(7.0)),
        "horse-shoe": Stamp(_horse_shoe(), 0.13, 1.2, 250.0, 0.85, 0.25, 1.6),
        "wolf": Stamp(_WOLF, 0.11, 0.65, 20.0, 0.65, 0.10, 1.6, np.radians(3.0)),
        "deer": Stamp(_DEER, 0.075, 0.8, 60.0, 0.60, 0.14, 1.2, np.radians(5.0)),
        "gull": Stamp(_GULL, 0.055, 0.09, 0.9, 0.14, 0.04, 0.45, np.radians(-10.0)),
    }
)
"""Stamps by name. Of those on four feet a mark is that of the hind foot in that of the fore foot, as they walk."""


def names(known: Sequence[str] = tuple(STAMPS)) -> str:
    """The names of all stamps in one line."""
    return ", ".join(known)
