"""Ground in layers: mud on asphalt, snow on earth. PEYRAT11 3.1, MODEL 6.17

    Ground.flat().layered(Layer("mud", 0.03)), soils "packed-earth"     3 cm of mud on packed earth

The surface is that of the topmost. All of them bear the same load, and the softest yields most.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace

from ..errors import DesirePathError
from .soil import NUMBERS, Soil, as_soil
from .soil_keys import AnySoil, SoilKeys

MOST, THICKEST = 3, 10.0  # layers on a ground, and how thick one may be [m]


@dataclass(frozen=True)
class Layer:
    """One soil that lies on the ground. soil: a Soil, a preset's name or a .json file; thickness: of it [m]."""

    soil: Soil
    thickness: float

    def __init__(self, soil: str | Soil, thickness: float) -> None:
        try:
            thick = float(thickness)
        except (TypeError, ValueError):
            thick = math.nan
        if not 0.0 < thick <= THICKEST:
            raise DesirePathError(
                f"A layer {thickness} m thick cannot lie on the ground: give more than 0 and up to {THICKEST:g} m."
            )
        object.__setattr__(self, "soil", as_soil(soil))
        object.__setattr__(self, "thickness", thick)


def read(text: str) -> Layer:
    """A layer from the command line, SOIL:THICKNESS."""
    name, _, thickness = text.rpartition(":")
    try:
        return Layer(name, float(thickness))
    except ValueError as problem:
        if isinstance(problem, DesirePathError):
            raise
        raise DesirePathError(f"'{text}' is no layer: write SOIL:METRES, as mud:0.03.") from None


def checked(layers: Sequence[Layer]) -> tuple[Layer, ...]:
    """Layers for one ground; DesirePathError where they cannot lie on it."""
    if len(layers) > MOST:
        raise DesirePathError(f"{len(layers)} layers lie on the ground: give at most {MOST}.")
    return tuple(layers)


def stacked(
    soils: Sequence[AnySoil], layers: Sequence[Layer]
) -> tuple[list[AnySoil], list[list[tuple[Soil, float]]] | None]:
    """(soils, layers) of each soil: the topmost, as deep as all of them, and what the core is told of those."""
    if not layers:
        return list(soils), None
    stacks: list[list[tuple[Soil, float]]] = []
    tops: list[AnySoil] = []
    for soil in soils:
        if isinstance(soil, SoilKeys):
            raise DesirePathError("Ground in layers takes no soil that changes over time: give it that of one moment.")
        stack = [*((layer.soil, layer.thickness) for layer in layers), (soil, soil.layer_depth)]
        depth = min(sum(thickness for _, thickness in stack), NUMBERS["layer_depth"].high)
        tops.append(replace(layers[0].soil, **{"layer_depth": depth}))
        stacks.append(stack)
    return tops, stacks


def numbers(stacks: list[list[tuple[Soil, float]]] | None) -> list[list[tuple[dict[str, float], float]]] | None:
    """stacked()'s layers, as the core takes them."""
    if stacks is None:
        return None
    return [[(asdict(soil), thickness) for soil, thickness in stack] for stack in stacks]
