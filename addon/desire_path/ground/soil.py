"""Kinds of ground, MODEL 9.1: presets for looks, from the papers' tables, in SI units."""

import math
from dataclasses import dataclass

from ..errors import DesirePathError


@dataclass(frozen=True)
class Soil:
    """One kind of ground; names, units and ranges as in DpSoil of native/base/types.h."""

    layer_depth: float = 0.3  # L0, loose layer over rigid ground [m] > 0
    young_modulus: float = 1.0e6  # E_g, without roots [Pa] > 0
    poisson_ratio: float = 0.35  # nu, share pushed sideways, SOFT22 (12) 0..0.5
    settle_time: float = 0.1  # tau, time to yield fully, SOFT22 (11) [s] > 0
    rest_angle: float = math.radians(30)  # gamma_r, steepest slope that stays [rad] > 0, up to 89 degrees
    push_threshold: float = 0.0  # F_threshold, TRAIL (13) [N]; 0 = half the walker's weight
    shear_modulus: float = 0.0  # K, how far it shears before it carries sideways [m] 0..0.1; 0: soles do not slip

    def __post_init__(self):
        ranges = {
            "layer_depth": (1e-4, 100),
            "young_modulus": (1, 1e12),
            "settle_time": (1e-5, 1e4),
            "rest_angle": (1e-3, math.radians(89)),
        }
        for name, (low, high) in ranges.items():
            value = getattr(self, name)
            if not low <= value <= high:
                raise DesirePathError(
                    f"A soil's {name} of {value:g} cannot be used: choose one from {low:.4g} to {high:.4g}."
                )
        if not 0 <= self.poisson_ratio <= 0.5:
            raise DesirePathError(f"A soil's poisson_ratio of {self.poisson_ratio:g} cannot be used: choose 0 to 0.5.")
        if not (self.push_threshold >= 0 and math.isfinite(self.push_threshold)):
            raise DesirePathError("A soil's push_threshold must be 0 or more newtons.")
        if not 0 <= self.shear_modulus <= 0.1:
            raise DesirePathError(
                f"A soil's shear_modulus of {self.shear_modulus:g} cannot be used: choose 0 to 0.1 m."
            )


def _soil(megapascal, nu, rest_angle_deg, tau, shear=0.0):
    return Soil(
        young_modulus=1e6 * megapascal,
        poisson_ratio=nu,
        rest_angle=math.radians(rest_angle_deg),
        settle_time=tau,
        shear_modulus=shear,
    )


# Middle of each range in TRAIL Table 1 and SOFT22 Table 1. Loose grains shear by 1 to 2.5 cm before they carry
# (Janosi and Hanamoto 1961; Wong, Theory of Ground Vehicles); what holds together by more than friction does not slip.
SOILS = {
    "dry-sand": _soil(2.25, 0.5, 32.0, 0.05, 0.01),
    "snow": _soil(0.375, 0.05, 38.0, 0.2, 0.01),
    "mud": _soil(0.625, 0.35, 15.0, 0.15),
    "soil": _soil(1.25, 0.35, 30.0, 0.05),
    "soft-soil": _soil(1.35, 0.2, 12.5, 0.1),
    "dry-soil": _soil(0.35, 0.35, 7.5, 0.1),
    "wet-soil": _soil(0.5, 0.3, 12.5, 0.1),
}
