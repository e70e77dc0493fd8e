"""Kinds of plant, MODEL 7.1 and 9.2: as data in SI units that can be saved, changed and shared."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core import _native
from ..errors import DesirePathError
from ..files import record
from ..tables import Number, check, table, with_numbers

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

FORMS = ("surface", "tuft")
YEAR = 365.25 * 86400.0  # [s]
_TAG, _VERSION = "desire_path_plant", 1  # of a kind's file


_NAMES = {"root_radius": "reach"}  # of the core's numbers, which say the same
_CORE = table(_native.plants_numbers())
# by name, in the core's order, and what it does not read
NUMBERS = MappingProxyType(
    {
        **table(_native.plants_numbers(), _NAMES),
        "density": Number("1/m^2", 1e-6, 1e9, 80.0, "of a stand, unless told otherwise"),
    }
)


@dataclass(frozen=True)
@with_numbers(NUMBERS)
class Kind:
    """One kind of plant. Its form is a "surface", the paper's, or a "tuft" of 2 or 3 crossed sheets of stems."""

    form: str = "surface"
    sheets: int = 2

    if TYPE_CHECKING:

        def __init__(self, form: str = "surface", sheets: int = 2, *numbers: float, **by_name: Any) -> None: ...
        def __getattr__(self, name: str) -> float: ...

    def __post_init__(self) -> None:
        if self.form not in FORMS:
            raise DesirePathError(f'There is no plant form "{str(self.form)[:40]}": choose surface or tuft.')
        if not isinstance(self.sheets, (int, np.integer)) or self.sheets not in (2, 3):
            raise DesirePathError(f"A tuft of {str(self.sheets)[:40]} sheets cannot be built: choose 2 or 3.")
        check(self, NUMBERS, "A plant's")
        if self.break_angle < self.degrade_angle:
            raise DesirePathError("A plant's break_angle lies below its degrade_angle: raise it.")
        rows, stems = self.height / self.spacing + 1, self.width / self.spacing + 1
        if rows > 64 or stems * (self.sheets if self.form == "tuft" else 1) > 96:
            raise DesirePathError(
                f"A plant {self.height:g} m high and {self.width:g} m wide has too many particles "
                f"{self.spacing:g} m apart: raise its spacing."
            )

    def numbers(self) -> dict[str, float]:
        """What the core reads of it, by the core's names; `form` is its place in FORMS."""
        numbers = {name: float(getattr(self, _NAMES.get(name, name))) for name in _CORE}
        return {"form": FORMS.index(self.form), "sheets": int(self.sheets), **numbers}

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write this kind as JSON, whole or not at all."""
        record.save(self, path, _TAG, _VERSION, "plant kind")

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Kind:
        """A kind that save() wrote; numbers it leaves out are those of the default kind."""
        return record.load(Kind, path, _TAG, _VERSION, "plant kind")


def _kind(
    height: float,
    width: float,
    spacing: float,
    sway: float,
    degrade_deg: float,
    break_deg: float,
    strength: float = 0.1,
    *,
    hours: float | None = None,
    **more: Any,
) -> Kind:
    if hours is not None:  # until strength that was lost is back, and trodden stems stand again
        more["recover_rate"] = strength / (3600.0 * hours)
    return Kind(
        height=height,
        width=width,
        depth=width,
        spacing=spacing,
        sway=sway,
        strength=strength,
        degrade_angle=math.radians(degrade_deg),
        break_angle=math.radians(break_deg),
        **more,
    )


# As printed in TRAIL Table 1, with its phi_max of 70 and 50 degrees: a boot folds stems of pieces 15 mm long farther
# than that, so that one pass over a lane leaves 62 and 59 per cent of it and 25 leave 3 and 1, where measured lanes
# keep 86. For looks, and to compare with.
PAPER: Mapping[str, Kind] = MappingProxyType(
    {"carex": _kind(0.10, 0.05, 0.015, 3.0, 10, 70, 0.10), "lycopodium": _kind(0.10, 0.05, 0.015, 3.5, 5, 50, 0.08)}
)

# Wear of carex follows `python -m desire_path fit tests/scenes/lanes/cole.csv --kind carex`, from the cover of Cole's
# lanes; how it grows again is fitted likewise. tests/core/test_lane.py holds it to lanes of another seed, on
# cells of 1 and 2 cm. Lycopodium was not measured: it is carex with what tells the two apart in TRAIL Table 1, 0.8 of
# the reserve and wear from 5 degrees on.
#
# No kind here has the rupture angle of the table: with it no reserve can keep what the lanes keep (see PAPER). Stems
# break by wear alone, phi_max is 180 degrees, and have their reserve again after two weeks.
RESERVE, SPREAD = 2.95, 2.97
REGROWTH = {"regrow_rate": 0.77 / YEAR, "seed_share": 0.18}
TWO_WEEKS = 14 * 24.0  # [h]

# The others are for looks: heights and densities of common stands, sway falling with height (stems of cereals swing
# at about 1 Hz, short turf faster than the eye), and wear set by how well each is known to bear treading: some eighty
# footfalls for lawn grasses, three for ferns. Trodden turf stands again within the quarter of an hour, high grass
# within hours, straw and fronds hardly the next day.
_KINDS = {
    "carex": _kind(0.10, 0.05, 0.015, 3.0, 10, 180, RESERVE, spread=SPREAD, hours=TWO_WEEKS, **REGROWTH),
    "lycopodium": _kind(0.10, 0.05, 0.015, 3.5, 5, 180, 0.8 * RESERVE, spread=SPREAD, hours=TWO_WEEKS, **REGROWTH),
    "lawn": _kind(
        0.05,
        0.04,
        0.0125,
        6.0,
        20,
        180,
        0.4,
        form="tuft",
        radius=0.003,
        reach=0.08,
        full_density=150.0,
        density=300.0,
        modulus=12e6,
        hours=0.25,
        degrade_rate=0.007,
        spread=1.0,
    ),
    "meadow": _kind(
        0.30,
        0.08,
        0.04,
        1.8,
        15,
        180,
        0.2,
        form="tuft",
        sheets=3,
        curl=math.radians(6),
        radius=0.004,
        reach=0.18,
        full_density=30.0,
        density=60.0,
        hours=3.0,
        degrade_rate=0.012,
        spread=1.0,
    ),
    "wheat": _kind(
        0.80,
        0.06,
        0.06,
        1.1,
        12,
        180,
        0.1,
        form="tuft",
        curl=math.radians(1.0),
        radius=0.004,
        across=12.0,
        reach=0.12,
        full_density=50.0,
        density=100.0,
        modulus=6e6,
        hours=24.0,
        degrade_rate=0.03,
        spread=1.0,
    ),
    "moss": _kind(
        0.02,
        0.05,
        0.01,
        12.0,
        25,
        180,
        0.15,
        form="tuft",
        sheets=3,
        radius=0.003,
        damping=20.0,
        reach=0.06,
        full_density=250.0,
        density=500.0,
        modulus=2e6,
        hours=1.0,
        degrade_rate=0.01,
        spread=1.0,
    ),
    "fern": _kind(
        0.45,
        0.16,
        0.05,
        1.4,
        8,
        180,
        0.06,
        form="tuft",
        sheets=3,
        curl=math.radians(11),
        radius=0.006,
        across=10.0,
        reach=0.30,
        full_density=5.0,
        density=8.0,
        modulus=5e6,
        hours=24.0,
        degrade_rate=0.03,
        spread=1.0,
    ),
}
KINDS: Mapping[str, Kind] = MappingProxyType(_KINDS)  # by name, to be read: a kind of your own is a Kind


# ---- how they differ ---------------------------------------------------------------------------------------------

# Most plants of a kind are alike, a few give way at once, a few bear nearly anything: the density of their vigour z
# is as exp(-sqrt(|z| / c)), mean 0, deviation 1. Reserves are exp(spread z) times the kind's.
_VIGOUR = 120.0**-0.5  # c
MAX_VIGOUR = 8.0  # no plant is farther out


def share_below(vigour: ArrayLike) -> np.ndarray:
    """Share of plants, 0..1, whose vigour is below some; an array."""
    t = np.sqrt(abs(np.asarray(vigour, float)) / _VIGOUR)
    tail = 0.5 * (1.0 + t) * np.exp(-t)
    return np.where(np.asarray(vigour) < 0.0, tail, 1.0 - tail)


def vigour_at(share: ArrayLike) -> np.ndarray:
    """The vigour below which a share 0..1 of plants is, -8 to 8; an array. The inverse of share_below()."""
    share = np.asarray(share, float)
    far = -np.log(np.clip(2.0 * np.minimum(share, 1.0 - share), 1e-30, 1.0))
    t = far + np.sqrt(2.0 * far) + 1e-12  # beyond the root of t - log(1 + t) = far, from where Newton comes down
    for _ in range(8):
        t = t - (t - np.log1p(t) - far) * (1.0 + t) / t
        t = np.maximum(t, 1e-12)
    size = np.minimum(t * t * _VIGOUR, MAX_VIGOUR)
    return np.where(share < 0.5, -size, size)


def as_kind(kind: str | Kind) -> Kind:
    """A Kind from a Kind or the name of one."""
    if isinstance(kind, str):
        if kind not in KINDS:
            raise DesirePathError(f"There is no plant '{kind}': choose one of {', '.join(KINDS)}.")
        return KINDS[kind]
    if not isinstance(kind, Kind):
        raise DesirePathError(f"{kind!r} is no kind of plant: give a Kind or one of {', '.join(KINDS)}.")
    return kind
