"""What sticks to soles and wheels, falls off, flies and lands: its numbers, what is in the air, its files. MODEL 6.15

    SimulationOptions(spray="sand")    Bake(.., options=BakeOptions(spray=Spray(adhesion=0.004)))

A bake writes folder/frames/spray_0000.exr .. beside its frames: `read_frame` tells what flies in one.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import Record
from ..core import _native
from ..errors import DesirePathError
from ..files import record
from ..tables import check, from_words, table, with_numbers
from . import maps

NUMBERS = table(_native.spray_numbers())
MAX_PLACES = 1 << 20  # for grains, on one part of a foot
WIDTH = 256  # grains side by side in a file
_TAG, _VERSION = "desire_path_spray", 1  # of a file


@dataclass(frozen=True)
@with_numbers(NUMBERS)
class Spray:
    """How soil sticks to what presses it and flies off it: SI units."""

    if TYPE_CHECKING:

        def __init__(self, *numbers: float, **by_name: float) -> None: ...
        def __getattr__(self, name: str) -> float: ...

    def __post_init__(self) -> None:
        check(self, NUMBERS, "A spray's")
        if not self.slow_speed < self.fast_speed:
            raise DesirePathError(
                f"A spray's slow_speed of {self.slow_speed:g} m/s is not below its fast_speed, {self.fast_speed:g} m/s"
                ": lower it."
            )

    @property
    def volume(self) -> float:
        """Of one grain [m^3]."""
        return float(np.pi / 6.0 * self.particle_size**3)

    def parameters(self) -> dict[str, float]:
        """Its numbers by name."""
        return {name: float(value) for name, value in asdict(self).items()}

    def changed(self, texts: Iterable[str]) -> Spray:
        """This spray with numbers from words `name=value`, such as adhesion=0.004."""
        return replace(self, **from_words(texts, NUMBERS, "spray", "adhesion=0.004"))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write this spray as JSON, whole or not at all, in SI units."""
        record.save(self, path, _TAG, _VERSION, "spray")

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Spray:
        """A spray that save() wrote; numbers it leaves out are those of Spray()."""
        return record.load(Spray, path, _TAG, _VERSION, "spray")


# for looks: dry grains come off at once, mud holds on and flies in lumps, snow is light
SPRAYS: Mapping[str, Spray] = MappingProxyType(
    {
        "sand": Spray(
            adhesion=0.0025, hold_time=0.06, slow_speed=1.2, fast_speed=5.0, particle_size=0.004, scatter=0.4
        ),
        "mud": Spray(
            adhesion=0.005,
            hold_time=0.25,
            slow_speed=2.5,
            fast_speed=8.0,
            particle_size=0.008,
            particle_density=1900.0,
            scatter=0.2,
        ),
        "snow": Spray(
            adhesion=0.004,
            hold_time=0.08,
            slow_speed=1.0,
            fast_speed=5.0,
            particle_size=0.006,
            particle_density=250.0,
            scatter=0.4,
        ),
    }
)


def as_spray(spray: str | Spray | None) -> Spray | None:
    """A Spray, the name of one, or the path of a file that Spray.save() wrote, as a Spray; None: nothing sticks."""
    if spray is None or isinstance(spray, Spray):
        return spray
    if isinstance(spray, str):
        if spray in SPRAYS:
            return SPRAYS[spray]
        if spray.lower().endswith(".json"):
            return Spray.load(spray)
    raise DesirePathError(
        f"There is no spray '{str(spray)[:40]}': choose one of {', '.join(SPRAYS)}, or a .json file of one."
    )


def check_soles(spray: Spray, soles: Iterable[Any], names: Iterable[str]) -> None:
    """Refuse grains so small that a sole holds more of them than can be followed; names: of the soles, for people."""
    for sole, name in zip(soles, names):
        corner = sole.vertices.astype(float)[sole.triangles]
        sides = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        area = 0.5 * float(np.sqrt((sides**2).sum(axis=1)).sum())
        if area * spray.adhesion / spray.volume > MAX_PLACES:
            fits = (6.0 / np.pi * area * spray.adhesion / MAX_PLACES) ** (1.0 / 3.0)
            raise DesirePathError(
                f"Grains of {spray.particle_size:g} m are too many on {name}: choose a particle_size of "
                f"{1.1 * fits:.2g} m or more, or less adhesion."
            )


# ---- what is in the air --------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, repr=False)
class Grains(Record):
    """What flies at one moment, each as much as another."""

    position: np.ndarray  # of their middles, world frame [m] (n, 3)
    velocity: np.ndarray  # [m/s] (n, 3)
    soil: np.ndarray  # number of the soil they are of (n,)
    name: np.ndarray  # a number of its own each, in the order in which they came off (n,)

    def __post_init__(self) -> None:
        for name in ("position", "velocity", "soil", "name"):
            object.__setattr__(self, name, np.asarray(getattr(self, name)))
        super().__post_init__()

    def __len__(self) -> int:
        return len(self.name)

    def some(self, chosen: np.ndarray) -> Grains:
        """Those of some rows."""
        return Grains(self.position[chosen], self.velocity[chosen], self.soil[chosen], self.name[chosen])


def grains_of(core: Any) -> Grains:
    """What flies in a simulation of the core."""
    count = core.grains()
    found = np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count, np.int32), np.zeros(count, np.int32)
    core.read_grains(*found)
    return Grains(*found)


# ---- files ---------------------------------------------------------------------------------------
#
# Rows of WIDTH pixels, from the lowest on: (how many, rows of places, 0, 0), then R, G, B a place and A a soil for
# each; above them as many rows of velocities, with the name in A.


def write_frame(path: str | os.PathLike[str], grains: Grains, seconds: float) -> None:
    """One frame's file, whole or not at all; seconds: its time."""
    count = len(grains)
    rows = -(-(count + 1) // WIDTH)
    pixels = np.zeros((2, rows * WIDTH, 4), np.float32)
    pixels[0, 0, :2] = count, rows
    pixels[0, 1 : count + 1, :3], pixels[0, 1 : count + 1, 3] = grains.position, grains.soil
    pixels[1, 1 : count + 1, :3], pixels[1, 1 : count + 1, 3] = grains.velocity, grains.name
    planes = {name: pixels[..., k].reshape(2 * rows, WIDTH) for k, name in enumerate("RGBA")}
    maps.write(path, planes, {"time": seconds, "count": float(count)})


def read_frame(path: str | os.PathLike[str]) -> Grains:
    """What flies in a frame, of a file spray_0001.exr of a bake."""
    planes = maps.read(path).planes
    try:
        pixels = np.stack([planes[name] for name in "RGBA"], axis=-1)
        count, rows = (int(each) for each in pixels[0, 0, :2])
        if pixels.shape[:2] != (2 * rows, WIDTH) or not 0 <= count < rows * WIDTH:
            raise ValueError
    except (KeyError, ValueError, OverflowError):
        raise DesirePathError(f"{os.fspath(path)} is no frame of a spray: choose spray_0001.exr of a bake.") from None
    place, velocity = pixels.reshape(2, rows * WIDTH, 4)[:, 1 : count + 1]
    return Grains(place[:, :3], velocity[:, :3], place[:, 3].astype(np.int32), velocity[:, 3].astype(np.int32))
