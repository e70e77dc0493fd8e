"""Ground in layers: mud on asphalt, snow on earth. PEYRAT11 3.1, MODEL 6.17

    Ground.flat().layered(Layer("mud", 0.03)), soils "packed-earth"     3 cm of mud on packed earth
    Layer("mud", 0.03, share)                                           .. so much of 3 cm at each vertex or sample

All layers bear the same load, and the softest yields most; the surface is that of the topmost there is.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Record
from ..errors import DesirePathError
from .soil import NUMBERS, Soil, as_soil
from .soil_keys import AnySoil, SoilKeys

MOST, THICKEST = 3, 10.0  # layers on a ground, and how thick one may be [m]
STEPS = 16  # in which a thickness that differs from place to place is told, fewer where there are many soils
KINDS = 255  # of ground that the core tells apart


@dataclass(frozen=True, eq=False)
class Layer(Record):
    """One soil that lies on the ground. soil: a Soil, a preset's name or a .json file; thickness: of it [m].

    share: how much of the thickness there is at each vertex or sample of the ground, 0..1; None: all of it everywhere
    """

    soil: Soil
    thickness: float
    share: np.ndarray | None = field(default=None, repr=False)

    def __init__(self, soil: str | Soil, thickness: float, share: ArrayLike | None = None) -> None:
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
        object.__setattr__(self, "share", None if share is None else _checked_share(share))
        self.__post_init__()


def _checked_share(share: ArrayLike) -> np.ndarray:
    found = np.ascontiguousarray(share, np.float32).reshape(-1)
    if not ((found >= 0.0) & (found <= 1.0)).all():
        raise DesirePathError("The share of a layer is not between 0 and 1 everywhere: give 0 where it does not lie.")
    return found


def read(text: str) -> Layer:
    """A layer from the command line, SOIL:THICKNESS."""
    name, _, thickness = text.rpartition(":")
    try:
        return Layer(name, float(thickness))
    except ValueError as problem:
        if isinstance(problem, DesirePathError):
            raise
        raise DesirePathError(f"'{text}' is no layer: write SOIL:METRES, as mud:0.03.") from None


def checked(layers: Sequence[Layer], native: tuple) -> tuple[Layer, ...]:
    """Layers for one ground of these numbers (Ground.native); DesirePathError where they cannot lie on it."""
    if len(layers) > MOST:
        raise DesirePathError(f"{len(layers)} layers lie on the ground: give at most {MOST}.")
    for each in layers:
        if each.share is not None and native[0] == "flat":
            raise DesirePathError("Flat ground has no vertices to tell a layer's share at: give heights or a mesh.")
        if each.share is not None and len(each.share) != (native[1].size if native[0] == "heights" else len(native[1])):
            raise DesirePathError(
                f"The share of a layer has {len(each.share)} values: give one for each vertex or sample of the ground."
            )
    return tuple(layers)


@dataclass(frozen=True, eq=False, repr=False)
class Lain(Record):
    """What a ground is made of, as the core takes it: kinds of ground, of which each cell is one."""

    native: tuple  # Ground.native, whose weights are those of the kinds
    tops: list[AnySoil]  # of each kind the topmost soil, as deep as all its layers
    soils: list[AnySoil]  # all that lie anywhere, none twice
    names: list[int]  # of each kind, which of `soils` is on top
    own: np.ndarray  # .. and which of the ground's own soils lies below
    stacks: list[list[tuple[Soil, float, int, int]]] | None  # .. and (soil, thickness, name, place) from the top down

    def numbers(self) -> list[list[tuple[dict[str, float], float, int, int]]] | None:
        """The stacks as the core takes them."""
        if self.stacks is None:
            return None
        return [[(asdict(soil), thick, name, place) for soil, thick, name, place in stack] for stack in self.stacks]


def lain(native: tuple, soils: Sequence[AnySoil], layers: Sequence[Layer]) -> Lain:
    """Layers on soils. Where a thickness differs from place to place there is a kind of ground for each step of it."""
    if not layers:
        count = range(len(soils))
        return Lain(native, list(soils), list(soils), [*count], np.array(count), None)
    below = _lasting(soils)
    every: list[AnySoil] = list(dict.fromkeys([*(layer.soil for layer in layers), *below]))
    steps = [_steps(layer, layers, len(soils)) for layer in layers]
    kinds = [(own, each) for own in range(len(soils)) for each in itertools.product(*steps)]
    stacks: list[list[tuple[Soil, float, int, int]]] = []
    tops: list[AnySoil] = []
    for own, shares in kinds:
        stack = [
            (layer.soil, share * layer.thickness, every.index(layer.soil), place)
            for place, (layer, share) in enumerate(zip(layers, shares))
            if share > 0.0
        ]
        stack.append((below[own], below[own].layer_depth, every.index(below[own]), len(layers)))
        stacks.append(stack)
        depth = min(sum(thickness for _, thickness, *_ in stack), NUMBERS["layer_depth"].high)
        tops.append(replace(stack[0][0], **{"layer_depth": depth}))
    if len(kinds) > len(soils):
        native = (*native[:-1], _weights(native, kinds, layers))
    names = [stack[0][2] for stack in stacks]
    return Lain(native, tops, every, names, np.array([own for own, _ in kinds]), stacks)


def _lasting(soils: Sequence[AnySoil]) -> list[Soil]:
    found = []
    for soil in soils:
        if isinstance(soil, SoilKeys):
            raise DesirePathError("Ground in layers takes no soil that changes over time: give it that of one moment.")
        found.append(soil)
    return found


def _steps(layer: Layer, layers: Sequence[Layer], soils: int) -> list[float]:
    """Shares of a thickness that are told apart."""
    painted = sum(each.share is not None for each in layers)
    if layer.share is None:
        return [1.0]
    most = min(STEPS, int((KINDS / soils) ** (1.0 / painted) + 1e-9) - 1)
    if most < 1:
        raise DesirePathError(
            f"{soils} soils and {painted} painted layers make too many kinds of ground: paint fewer of them."
        )
    low, high = (round(float(each) * most) for each in (layer.share.min(), layer.share.max()))
    return [step / most for step in range(low, high + 1)]


def _weights(native: tuple, kinds: Sequence[tuple[int, tuple[float, ...]]], layers: Sequence[Layer]) -> np.ndarray:
    """Of each kind at each vertex or sample (kinds, n): between them the heaviest is of the heaviest soil, and of the
    step that is nearest to the share there, since 2 s t - s^2 is even in t and greatest for the nearest s."""
    shares = [layer.share for layer in layers]
    count = next(len(share) for share in shares if share is not None)
    weight = np.zeros((len(kinds), count), np.float32)
    for row, (own, steps) in zip(weight, kinds):
        if native[-1] is not None:
            row += native[-1][own]
        for share, step in zip(shares, steps):
            if share is not None:
                row += 1.0 + 2.0 * step * share - step * step
    return weight
