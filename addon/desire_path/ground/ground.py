"""The ground a simulation presses: flat, heights on a grid, or a mesh; and the soils it is made of."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Record
from ..bounds import CELLS
from ..errors import DesirePathError
from . import trail
from .layers import Layer, checked
from .soil import Soil, as_soil
from .soil_keys import AnySoil, SoilKeys


@dataclass(frozen=True, eq=False, repr=False)
class Ground(Record):
    """Where the ground is before anybody walks on it. Use flat(), heights(), mesh() or read()."""

    native: tuple = field(repr=False)
    name: str = "ground"
    trail: trail.Trail | None = field(default=None, repr=False)  # what walkers left of it before
    layers: tuple[Layer, ...] = ()  # that lie on its soils, from the top down

    def __post_init__(self) -> None:
        object.__setattr__(self, "native", tuple(self.native))
        super().__post_init__()

    def __repr__(self) -> str:
        kind, *numbers = self.native
        said = kind
        if kind == "flat":
            said += f", {numbers[0]:g} m"
        elif kind == "heights":
            said += f", {numbers[0].shape[1]} x {numbers[0].shape[0]} samples {numbers[1]:g} m apart"
        elif kind == "mesh":
            said += f", {len(numbers[0])} vertices, {len(numbers[1])} triangles"
        return f"Ground({said}{'' if self.trail is None else f', {self.trail!r}'})"

    def layered(self, *layers: Layer) -> Ground:
        """The same ground with these layers on its soils, from the top down; the first there is is seen."""
        return replace(self, layers=checked(layers, self.native))

    @staticmethod
    def flat(height: float = 0.0) -> Ground:
        """Level ground without end at `height` [m]."""
        if not math.isfinite(height):
            raise DesirePathError("The height of the flat ground is not a number: give it in metres.")
        return Ground(("flat", float(height)), "flat")

    @staticmethod
    def heights(
        heights: ArrayLike, spacing: float, x0: float = 0.0, y0: float = 0.0, kind_weight: ArrayLike | None = None
    ) -> Ground:
        """Ground from a regular grid.

        heights: (ny, nx) [m], row 0 at the lowest y, NaN = no ground; bilinear between samples.
        spacing: distance of samples [m] > 0; sample (0, 0) lies at (x0, y0).
        kind_weight: (kinds, ny, nx) >= 0, how much of each soil; the heaviest wins.
        """
        heights, base = np.asarray(heights), 0.0
        if heights.dtype == np.float64 and heights.size and np.isfinite(heights).any():
            # what a float32 has no digits for, far up, counts from a height of the ground's own
            base = 16.0 * round(float(heights[np.isfinite(heights)][0]) / 16.0)
            heights = heights - base
        heights = np.ascontiguousarray(heights, np.float32)
        if heights.ndim != 2 or min(heights.shape) < 2:
            raise DesirePathError("A ground of heights needs at least 2 x 2 samples.")
        if np.isinf(heights).any():
            raise DesirePathError("The ground has infinite heights: mark holes with NaN instead.")
        if np.isnan(heights).all():
            raise DesirePathError("The ground has no height anywhere: every sample is NaN.")
        if not (spacing > 0 and math.isfinite(spacing) and math.isfinite(x0) and math.isfinite(y0)):
            raise DesirePathError("The ground's sample spacing must be a positive number of metres.")
        if kind_weight is not None:
            kind_weight = np.ascontiguousarray(kind_weight, np.float32)
            if kind_weight.ndim != 3 or kind_weight.shape[1:] != heights.shape:
                raise DesirePathError(
                    f"The soils' weights have shape {kind_weight.shape}: give one for each soil and height."
                )
            kind_weight = kind_weight.reshape(len(kind_weight), -1)
        native = ("heights", heights, float(spacing), float(x0), float(y0), base, kind_weight)
        return Ground(native, "heights")

    @staticmethod
    def mesh(vertices: ArrayLike, triangles: ArrayLike, kind_weight: ArrayLike | None = None) -> Ground:
        """Ground from triangles seen from above.

        vertices: (n, 3) world position [m]; triangles: (m, 3) indices.
        kind_weight: (kinds, n) >= 0, how much of each soil at each vertex; the heaviest wins.
        """
        vertices, triangles = np.asarray(vertices, np.float64), np.asarray(triangles)
        if triangles.size == 0:
            raise DesirePathError("The ground has no faces: give it at least one.")
        if vertices.ndim != 2 or triangles.ndim != 2 or vertices.shape[1] != 3 or triangles.shape[1] != 3:
            raise DesirePathError(
                f"The ground has vertices of shape {vertices.shape} and triangles of shape "
                f"{triangles.shape}: give (n, 3) positions and (m, 3) indices."
            )
        if triangles.min() < 0 or triangles.max() >= len(vertices):
            raise DesirePathError("A triangle of the ground names a vertex that is not there: mend its indices.")
        vertices = np.ascontiguousarray(vertices)
        triangles = np.ascontiguousarray(triangles, np.int32)
        bad = np.flatnonzero(~np.isfinite(vertices).all(axis=1))
        if len(bad):
            raise DesirePathError(
                f"Vertex {bad[0]} of the ground is not a finite position: repair the mesh and bake again."
            )
        if kind_weight is not None:
            kind_weight = np.ascontiguousarray(kind_weight, np.float32)
            if kind_weight.ndim != 2 or kind_weight.shape[1] != len(vertices):
                raise DesirePathError(
                    f"The soils' weights have shape {kind_weight.shape}: give one for each soil and vertex."
                )
        return Ground(("mesh", vertices, triangles, kind_weight), "mesh")

    @staticmethod
    def read(path: str | os.PathLike[str], spacing: float | None = None) -> Ground:
        """Ground from an image: a height map, or the trail in a map of a bake (maps_final.exr, one of maps/).

        A trail goes on as it was left: base height, compression, heap and pressure_time, not its plants. It lies on
        level ground without end if it was pressed there, else there is no ground beyond the map. Give the simulation
        the map's own cell size and origin (`trail.cell`, `trail.x0`, `trail.y0`); on others the trail is averaged.
        A height map is an OpenEXR that holds its heights [m] in the channel height, Z, V, Y, or in a grey picture, NaN
        = no ground; or a GeoTIFF, which is read by rasterio.

        spacing: distance of a height map's samples [m], if its header does not say
        """
        found = trail.read(path, spacing)
        if not isinstance(found, trail.Trail):
            return Ground.heights(*found)
        if found.flat:
            return Ground(("flat", float(found.rest[0, 0])), "flat", found)
        half = found.cell / 2
        ground = Ground.heights(found.rest, found.cell, found.x0 + half, found.y0 + half)
        return Ground(ground.native, "trail", found)

    def arrays(self) -> list[np.ndarray]:
        """The arrays the ground is made of, for telling one ground from another."""
        return [
            *(part for part in self.native if isinstance(part, np.ndarray)),
            *(layer.share for layer in self.layers if layer.share is not None),
            *(self.trail.arrays() if self.trail else []),
        ]


def as_soils(soils: str | AnySoil | Iterable[str | AnySoil]) -> list[AnySoil]:
    """A list of Soil and SoilKeys from one of them, one preset's name, or a sequence of any."""
    if isinstance(soils, (str, Soil, SoilKeys)):
        soils = [soils]
    found: list[AnySoil] = []
    for soil in soils:
        found.append(soil if isinstance(soil, SoilKeys) else as_soil(soil))
    if not 1 <= len(found) <= 255:
        raise DesirePathError("Give the ground between 1 and 255 soils.")
    return found


def as_lasting_soils(soils: str | Soil | Iterable[str | Soil]) -> list[Soil]:
    """The same of soils that do not change: DesirePathError for SoilKeys, where no walk tells the time."""
    found = []
    for soil in as_soils(soils):
        if isinstance(soil, SoilKeys):
            raise DesirePathError(
                "Ground that is pressed by hand takes no SoilKeys: give it the Soil of one moment, keys.at(2.0)."
            )
        found.append(soil)
    return found


def soil_numbers(soils: Iterable[Soil]) -> list[dict[str, float]]:
    return [asdict(soil) for soil in soils]  # by name


def check_cell(cell_size: float) -> None:
    """Refuse sides of a cell that cannot be worked with [m]."""
    if not (math.isfinite(cell_size) and CELLS[0] <= cell_size <= CELLS[1]):
        raise DesirePathError(
            f"A cell size of {cell_size:g} m cannot be worked with: choose {CELLS[0]:g} to {CELLS[1]:g} m "
            "(0.01 is usual)."
        )
