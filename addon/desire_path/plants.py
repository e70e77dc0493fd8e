"""Kinds of plants, design 7 and 9: data in SI units that can be saved, changed and shared."""

import json
import math
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np

from . import whole
from .errors import DesirePathError

FORMS = ("surface", "tuft")
YEAR = 365.25 * 86400.0  # [s]
_VERSION = 1
_RANGES = {  # what native/plants refuses, said by name; angles in radians
    "height": (0, 10), "width": (0, 10), "depth": (0, 10), "spacing": (1e-4, 10), "radius": (0, 1),
    "curl": (0, math.pi / 2), "sway": (1e-3, 1e3), "across": (1e-3, 1e4), "damping": (0, 1e4),
    "strength": (1e-9, 1e9), "degrade_angle": (0, math.pi), "break_angle": (0, 1e3), "degrade_rate": (0, 1e9),
    "recover_rate": (0, 1e9), "spread": (0, 4), "regrow_rate": (0, 1e3), "reach": (1e-3, 100),
    "full_density": (1e-6, 1e9), "modulus": (0, 1e12), "density": (1e-6, 1e9),
}


@dataclass(frozen=True)
class Kind:
    """One kind of plant; names, units and ranges as in DpPlantKind of native/plants/plants.h."""

    form: str = "surface"  # "surface", the paper's, or "tuft": crossed sheets of stems
    sheets: int = 2  # of a tuft, 2 or 3
    height: float = 0.10  # over the ground [m]
    width: float = 0.05  # of the first sheet [m]
    depth: float = 0.05  # of the sheets that cross it [m]
    spacing: float = 0.015  # between particles, about [m]
    radius: float = 0.005  # of a particle [m]
    curl: float = 0.0  # phi_0, rest angle between neighbouring edges of a stem [rad]
    sway: float = 3.0  # frequency at which a whole stem swings [Hz]
    across: float = 20.0  # stiffness of the edges between stems, as a frequency [Hz]
    damping: float = 6.0  # of speed [1/s]
    strength: float = 0.1  # eps_b, reserve of a bend, TRAIL (6)
    degrade_angle: float = math.radians(10)  # phi_deg, from here on a bend wears [rad]
    break_angle: float = math.radians(70)  # phi_max, beyond it a bend breaks [rad]
    degrade_rate: float = 0.1  # mu_deg [1/s]
    recover_rate: float = 0.1  # mu_rec [1/s]
    spread: float = 0.0  # s, reserves differ by exp(s z) from plant to plant
    regrow_rate: float = 1.02 / YEAR  # r of d alpha/dt = r alpha (1 - alpha) [1/s]
    reach: float = 0.15  # R, of a plant's roots, TRAIL (7) [m]
    full_density: float = 40.0  # plants from which on the ground is fully covered [1/m^2]
    modulus: float = 10e6  # E_v0, of soil full of healthy roots, TRAIL (8) [Pa]
    density: float = 80.0  # of a stand, unless told otherwise [1/m^2]

    def __post_init__(self):
        if self.form not in FORMS:
            raise DesirePathError(f'There is no plant form "{self.form}": choose surface or tuft.')
        if self.sheets not in (2, 3):
            raise DesirePathError(f"A tuft of {self.sheets} sheets cannot be built: choose 2 or 3.")
        for name, (low, high) in _RANGES.items():
            value = getattr(self, name)
            if isinstance(value, bool) or not isinstance(value, (int, float)) or not low <= value <= high:
                raise DesirePathError(f"A plant's {name} of {value} cannot be used: choose one from {low:.4g} "
                                      f"to {high:.4g}.")
        if self.break_angle < self.degrade_angle:
            raise DesirePathError("A plant's break_angle lies below its degrade_angle: raise it.")
        rows, stems = self.height / self.spacing + 1, self.width / self.spacing + 1
        if rows > 64 or stems * (self.sheets if self.form == "tuft" else 1) > 96:
            raise DesirePathError(f"A plant {self.height:g} m high and {self.width:g} m wide has too many particles "
                                  f"{self.spacing:g} m apart: raise its spacing.")

    def numbers(self):
        """What the core reads: float64 (21) in the order of DpPlantKind."""
        values = [FORMS.index(self.form) if f.name == "form" else getattr(self, f.name) for f in fields(self)[:-1]]
        return np.array(values, float)

    def save(self, path):
        """Write this kind as JSON, whole or not at all."""
        text = json.dumps({"desire_path_plant": _VERSION, **asdict(self)}, indent=2) + "\n"
        with whole.file(path, "The kind", "w", encoding="utf-8") as stream:
            stream.write(text)

    @staticmethod
    def load(path):
        """A kind that save() wrote; numbers it leaves out are those of the default kind."""
        try:
            told = json.loads(Path(path).read_text(encoding="utf-8"))
        except FileNotFoundError:
            raise DesirePathError(f"There is no plant kind at {path}: check the path.") from None
        except (UnicodeDecodeError, json.JSONDecodeError):
            raise DesirePathError(f"{path} is not a plant kind: save one with Kind.save().") from None
        if not isinstance(told, dict) or told.pop("desire_path_plant", None) != _VERSION:
            raise DesirePathError(f"{path} is not a plant kind of this version: save one with Kind.save().")
        unknown = sorted(set(told) - {f.name for f in fields(Kind)})
        if unknown:
            raise DesirePathError(f"{path} says {unknown[0]}, which no plant has: remove it.")
        return Kind(**told)


def _kind(height, width, spacing, sway, degrade_deg, break_deg, strength=0.1, *, curl_deg=0.0, **more):
    return Kind(height=height, width=width, depth=width, spacing=spacing, sway=sway, strength=strength,
                degrade_angle=math.radians(degrade_deg), break_angle=math.radians(break_deg),
                curl=math.radians(curl_deg), **more)


# Wear of the first two as in TRAIL Table 1. The others are for looks: heights and densities of common stands,
# sway falling with height (stems of cereals swing at about 1 Hz, short turf faster than the eye), and wear set
# between the paper's two by how well each is known to bear treading: lawn grasses best, ferns worst.
KINDS = {
    "carex": _kind(0.10, 0.05, 0.015, 3.0, 10, 70, 0.10),
    "lycopodium": _kind(0.10, 0.05, 0.015, 3.5, 5, 50, 0.08),
    "lawn": _kind(0.05, 0.04, 0.0125, 6.0, 20, 110, 0.4, form="tuft", radius=0.003, reach=0.08, full_density=150.0,
                  density=300.0, modulus=12e6),
    "meadow": _kind(0.30, 0.08, 0.04, 1.8, 15, 85, 0.2, form="tuft", sheets=3, curl_deg=6, radius=0.004, reach=0.18,
                    full_density=30.0, density=60.0),
    "wheat": _kind(0.80, 0.06, 0.06, 1.1, 12, 60, 0.1, form="tuft", curl_deg=1.0, radius=0.004, across=12.0,
                   reach=0.12, full_density=50.0, density=100.0, modulus=6e6),
    "moss": _kind(0.02, 0.05, 0.01, 12.0, 25, 120, 0.15, form="tuft", sheets=3, radius=0.003, damping=20.0, reach=0.06,
                  full_density=250.0, density=500.0, modulus=2e6),
    "fern": _kind(0.45, 0.16, 0.05, 1.4, 8, 50, 0.06, form="tuft", sheets=3, curl_deg=11, radius=0.006, across=10.0,
                  reach=0.30, full_density=5.0, density=8.0, modulus=5e6),
}
