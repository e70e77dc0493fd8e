"""Kinds of ground, MODEL 9.1: presets for looks, from the papers' tables, in SI units."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING

from ..core import _native
from ..errors import DesirePathError
from ..files import record
from ..tables import check, from_words, table, with_numbers
from . import measured

_TAG, _VERSION = "desire_path_soil", 1  # of a soil's file
_ALWAYS = 7  # numbers of every soil; those that came later are told where they matter
NUMBERS = table(_native.soil_numbers())  # of a soil, by name: base/soil_numbers.h


@dataclass(frozen=True)
@with_numbers(NUMBERS)
class Soil:
    """One kind of ground: SI units, angles in radians."""

    if TYPE_CHECKING:

        def __init__(self, *numbers: float, **by_name: float) -> None: ...
        def __getattr__(self, name: str) -> float: ...

    def __post_init__(self) -> None:
        check(self, NUMBERS, "A soil's")
        if self.snow_density > 0.0 and (self.bekker_friction > 0.0 or self.bekker_cohesion > 0.0):
            raise DesirePathError(
                "A soil gives way as snow or as ground that was measured, not as both: set its snow_density to 0, or "
                "its bekker_friction and bekker_cohesion."
            )

    def parameters(self) -> dict[str, float]:
        """The numbers by name that tell this soil from others: those after the first seven where they are not usual."""
        usual = Soil()
        return {
            name: getattr(self, name)
            for place, name in enumerate(NUMBERS)
            if place < _ALWAYS or not math.isclose(getattr(self, name), getattr(usual, name), rel_tol=1e-6)
        }

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write this soil as JSON, whole or not at all; angles in radians, all else in SI units."""
        record.save(self, path, _TAG, _VERSION, "soil")

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Soil:
        """A soil that save() wrote; numbers it leaves out are those of Soil()."""
        return record.load(Soil, path, _TAG, _VERSION, "soil")

    def changed(self, texts: Iterable[str]) -> Soil:
        """This soil with numbers from words `name=value`, such as young_modulus=2e6."""
        return replace(self, **from_words(texts, NUMBERS, "soil", "young_modulus=2e6"))


def as_soil(soil: str | Soil) -> Soil:
    """A Soil, the name of a preset or of measured ground, or the path of a file that Soil.save() wrote, as a Soil."""
    if isinstance(soil, str):
        for known in (SOILS, MEASURED):
            if soil in known:
                return known[soil]
        if soil.lower().endswith(".json"):
            return Soil.load(soil)
        raise DesirePathError(
            f"There is no soil '{soil}': choose one of {', '.join((*SOILS, *MEASURED))}, or a .json file of one."
        )
    return soil


def _soil(megapascal: float, nu: float, rest_angle_deg: float, tau: float, shear: float = 0.0, **others: float) -> Soil:
    """others: numbers by name; wall_angle in degrees."""
    if "wall_angle" in others:
        others["wall_angle"] = math.radians(others["wall_angle"])
    return Soil(
        young_modulus=1e6 * megapascal,
        poisson_ratio=nu,
        rest_angle=math.radians(rest_angle_deg),
        settle_time=tau,
        shear_modulus=shear,
        **others,
    )


# By how much ground shears along with a sole before it flows off ahead of it (Wong, Theory of Ground Vehicles, K):
# fresh snow, loose sand, firm sandy ground, packed clay; of other ground that of the nearest to it [m]
POWDER, LOOSE, FIRM, CLAY = 0.0375, 0.025, 0.01, 0.006

# Middle of each range in TRAIL Table 1 and SOFT22 Table 1. Loose grains shear by 1 to 2.5 cm before they carry
# (Janosi and Hanamoto 1961; Wong, Theory of Ground Vehicles); what holds together by more than friction does not slip.
# Walls, roughness and how it bulges, ours, are for looks: depths and volumes are those of the tables.
_SOILS = {
    "dry-sand": _soil(2.25, 0.5, 32.0, 0.05, 0.01, wall_angle=34.0, roughness=0.12, grain_size=0.01, flow_shear=LOOSE),
    "snow": _soil(
        0.375, 0.05, 38.0, 0.2, 0.01, wall_angle=80.0, roughness=0.4, grain_size=0.012, flow_time=0.3, flow_shear=POWDER
    ),
    "mud": _soil(
        0.625, 0.35, 15.0, 0.15, roughness=0.25, grain_size=0.02, heave=0.03, water_depth=0.024, flow_shear=FIRM
    ),
    "soil": _soil(1.25, 0.35, 30.0, 0.05, wall_angle=65.0, roughness=0.5, grain_size=0.01, flow_shear=FIRM),
    "soft-soil": _soil(1.35, 0.2, 12.5, 0.1, flow_shear=LOOSE),
    "dry-soil": _soil(0.35, 0.35, 7.5, 0.1, flow_shear=LOOSE),
    "wet-soil": _soil(
        0.5, 0.3, 12.5, 0.1, wall_angle=80.0, roughness=0.3, grain_size=0.015, rebound=0.25, flow_shear=FIRM
    ),
}
# For looks alone: as close-ups of prints show them, and as deep beside the others as people know them.
_SOILS |= {
    "deep-snow": _soil(
        0.108,
        0.01,
        38.0,
        0.1,
        layer_depth=0.4,
        wall_angle=78.0,
        roughness=0.12,
        grain_size=0.03,
        rebound=0.02,
        flow_time=0.3,
        flow_shear=POWDER,
    ),
    "fresh-snow": _soil(
        0.17,
        0.03,
        38.0,
        0.1,
        wall_angle=78.0,
        roughness=0.25,
        grain_size=0.025,
        rebound=0.03,
        flow_time=0.3,
        flow_shear=POWDER,
    ),
    "wet-sand": _soil(
        3.5, 0.25, 42.0, 0.05, 0.002, wall_angle=76.0, roughness=0.3, grain_size=0.008, rebound=0.08, flow_shear=FIRM
    ),
    "packed-snow": _soil(
        5.0, 0.05, 40.0, 0.1, wall_angle=75.0, roughness=0.4, grain_size=0.008, rebound=0.05, flow_shear=LOOSE
    ),
    "packed-earth": _soil(
        20.0,
        0.3,
        38.0,
        0.05,
        wall_angle=65.0,
        roughness=0.35,
        grain_size=0.015,
        rebound=0.12,
        flow_shear=CLAY,
        heave=0.02,
    ),
}
# Sumner, O'Brien and Hodgins 1999, Table 1, read at second hand (in the review arXiv 2302.08683): inside slope as the
# wall angle, outside slope as the rest angle, roughness, and compression alpha = 2 nu. Their ground has no stiffness:
# those are of the presets above. Their liquidity, the slope at which sliding may stop, is not used: soil rests.
_SOILS |= {
    f"sumner-{kind}": Soil(
        young_modulus=_SOILS[stiff].young_modulus,
        settle_time=_SOILS[stiff].settle_time,
        wall_angle=inside,
        rest_angle=min(outside, NUMBERS["rest_angle"].high),
        roughness=0.2,
        poisson_ratio=alpha / 2.0,
        flow_shear=_SOILS[stiff].flow_shear,
    )
    for kind, stiff, inside, outside, alpha in (
        ("sand", "dry-sand", 0.8, 0.436, 0.3),
        ("mud", "mud", 1.57, 1.1, 0.41),
        ("snow", "fresh-snow", 1.57, 1.57, 0.0),
    )
}
_SOILS |= {
    "crust-snow": _soil(
        0.2,
        0.02,
        38.0,
        0.1,
        wall_angle=85.0,
        roughness=0.25,
        grain_size=0.012,
        flow_time=0.3,
        crust_depth=0.02,
        crust_strength=3e5,
        flow_shear=POWDER,
        heave=0.05,
    )
}  # it bears a fox, not a person
WIND = 350.0  # density of snow that wind has packed [kg/m^3]
PACKED, PACKED_BY = 499.5, 35e3  # density to which a foot packs snow, and its pressure: MODEL 6.14 [kg/m^3], [Pa]


def snow(density: float, depth: float = 0.3, **others: float) -> Soil:
    """Snow that packs under its load, MODEL 6.14: no rim, walls that stand. Its stiffness, of which depths do not ask,
    is that with which a spring would be pressed as deep by a foot, so that roots and crusts are as on other ground.

    density: as it lies [kg/m^3], 10 to 490; depth: over firm ground [m]; others: numbers of the Soil by name
    """
    sinks = depth * (1.0 - density / PACKED)
    usual = {
        "young_modulus": PACKED_BY * depth / max(sinks, 0.01 * depth),
        "poisson_ratio": 0.0,
        "rest_angle": math.radians(38.0),
        "settle_time": 0.05,
        "flow_shear": POWDER if density < WIND else LOOSE,
    }
    return Soil(layer_depth=depth, snow_density=density, **{**usual, **others})


# Snow by its density, MODEL 6.14: as it has just fallen, as wind has packed it, as feet and machines have. For looks,
# the edges of what is deep crumble a little.
_SOILS |= {
    name: snow(density, wall_angle=math.radians(85.5), roughness=0.2, grain_size=0.02)
    for name, density in (("powder-snow", 100.0), ("wind-snow", WIND), ("trodden-snow", 450.0))
}
BY_DEPTH = tuple(
    sorted(
        _SOILS, key=lambda name: _SOILS[name].young_modulus / _SOILS[name].layer_depth / (1.0 - _SOILS[name].rebound)
    )
)
SOILS: Mapping[str, Soil] = MappingProxyType(_SOILS)  # by name, to be read: a soil of your own is a Soil


def _measured(name: str) -> Soil:
    """Stiffness: of a spring that a foot's 35 kPa would press as deep, as in snow()."""
    cohesion, friction, power, angle = measured.ROWS[name]
    is_snow = "snow" in name
    depth = 0.6 if is_snow else 0.3
    return Soil(
        layer_depth=depth,
        young_modulus=PACKED_BY * depth / max(measured.sinks(name, PACKED_BY), 1e-4),
        poisson_ratio=0.02 if is_snow else 0.35,
        rest_angle=math.radians(angle),
        settle_time=0.05,
        bekker_cohesion=1e3 * cohesion,
        bekker_friction=1e3 * friction,
        bekker_power=power,
        flow_shear=POWDER if is_snow else FIRM,
    )


MEASURED: Mapping[str, Soil] = MappingProxyType({name: _measured(name) for name in measured.ROWS})  # as SOILS is
