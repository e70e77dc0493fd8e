"""What the soils of a ground are called, and the maps that tell which of them is seen. MODEL 6.16

A soil is called as the preset it is, however deep it lies and sticks; others are soil, soil_2 ..
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from ..core import _native
from ..errors import DesirePathError
from .fields import Field
from .layers import Lain
from .soil import MEASURED, SOILS, Soil
from .soil_keys import AnySoil, SoilKeys, rows

MAX_STICKY = 16  # soils of one ground that stick to soles
ASIDE = ("adhesion", "release_pressure", "layer_depth")  # numbers that do not make another soil of it


def names(soils: Sequence[AnySoil]) -> tuple[str, ...]:
    """What they are called in maps and attributes: no name twice."""
    found: list[str] = []
    for soil in soils:
        name = _name(soil.soil if isinstance(soil, SoilKeys) else soil)
        count = 1 + sum(each == name or each.startswith(f"{name}_") for each in found)
        found.append(name if count == 1 else f"{name}_{count}")
    return tuple(found)


def _name(soil: Soil) -> str:
    usual = Soil()
    plain = replace(soil, **{name: getattr(usual, name) for name in ASIDE})
    for known in (SOILS, MEASURED):
        for name, preset in known.items():
            if plain == replace(preset, **{each: getattr(usual, each) for each in ASIDE}):
                return name.replace(".", "_")
    return "soil"


def sticky(soils: Sequence[AnySoil]) -> list[int]:
    """Numbers of those that stick to soles, at one time at least."""
    return [k for k, soil in enumerate(soils) if any(row.adhesion > 0.0 for row in rows(soil))]


def fields(lain: Lain, layers: int = 0) -> dict[str, Field]:
    """The maps beside FIELDS that a simulation of this ground has: layer_1 .. where so many layers lie on it, and where
    some do or something sticks surface_<soil>, and carried_<soil> of what sticks and is on top anywhere.

    DesirePathError where too many soils stick.
    """
    on_top, called = set(lain.names), names(lain.soils)
    stick = [k for k in sticky(lain.soils) if k in on_top]
    if len(stick) > MAX_STICKY:
        raise DesirePathError(f"More than {MAX_STICKY} soils here stick to soles: set the adhesion of some to 0.")
    surface, coat, layer = _native.soil_fields()
    left_of = {
        f"layer_{k + 1}": Field(layer + k, "m", "PEYRAT11 3.1", f"how thick layer {k + 1} still is, >= 0")
        for k in range(layers)
    }
    if not stick and not layers:
        return left_of
    seen = {
        f"surface_{name}": Field(surface + k, "-", "PEYRAT11 3.4", f"how much of what is seen is {name}, 0..1")
        for k, name in enumerate(called)
    }
    left = {
        f"carried_{called[k]}": Field(coat + k, "m", "PEYRAT11 3.4", f"{called[k]} that soles have left, >= 0")
        for k in stick
    }
    return {**seen, **left, **left_of}


def carried(lain: Lain, volumes: Iterable[tuple[int, float, float, float]]) -> dict[str, dict[str, float]]:
    """volumes: of each kind of ground whose top sticks, as the core tells them; here by the soil's name [m^3]."""
    called = names(lain.soils)
    return {
        called[lain.names[kind]]: {"taken_m3": taken, "carried_m3": now, "left_m3": left}
        for kind, taken, now, left in volumes
    }
