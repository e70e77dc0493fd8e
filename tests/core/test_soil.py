"""Kinds of ground: presets lie in the papers' ranges, and impossible numbers are refused with a sentence."""

import math

import pytest

from desire_path import _native
from desire_path.errors import DesirePathError
from desire_path.ground.soil import SOILS, Soil

TABLES = {  # E [MPa], nu, gamma_r [deg] (TRAIL Table 1), tau [s] (SOFT22 Table 1)
    "soft-soil": ((0.7, 2.0), (0.1, 0.3), (10, 15), None),
    "dry-soil": ((0.2, 0.5), (0.3, 0.4), (5, 10), None),
    "wet-soil": ((0.3, 0.7), (0.2, 0.4), (10, 15), None),
    "snow": ((0.25, 0.5), (0.05, 0.05), (38, 38), 0.2),
    "dry-sand": ((1.5, 3.0), (0.5, 0.5), (32, 32), 0.05),
    "mud": ((0.5, 0.75), (0.35, 0.35), (15, 15), 0.15),
    "soil": ((1.0, 1.5), (0.35, 0.35), None, 0.05),
}


@pytest.mark.parametrize("name", TABLES)
def test_presets_lie_in_the_tables(name):
    soil, (modulus, nu, angle, tau) = SOILS[name], TABLES[name]
    assert soil.layer_depth == pytest.approx(0.30)
    assert modulus[0] <= soil.young_modulus / 1e6 <= modulus[1]
    assert nu[0] <= soil.poisson_ratio <= nu[1]
    assert angle is None or angle[0] - 1e-9 <= math.degrees(soil.rest_angle) <= angle[1] + 1e-9
    assert tau is None or soil.settle_time == pytest.approx(tau)


def test_every_preset_is_in_the_tables():
    assert set(SOILS) == set(TABLES)


@pytest.mark.parametrize(
    "name, value",
    [
        ("layer_depth", 0.0),
        ("layer_depth", -1.0),
        ("young_modulus", 0.0),
        ("young_modulus", math.nan),
        ("young_modulus", math.inf),
        ("poisson_ratio", 0.51),
        ("poisson_ratio", -0.01),
        ("settle_time", 0.0),
        ("rest_angle", 0.0),
        ("rest_angle", math.radians(89.5)),
        ("push_threshold", -1.0),
        ("push_threshold", math.nan),
    ],
)
def test_impossible_soils_are_refused(name, value):
    with pytest.raises(DesirePathError, match=name):
        Soil(**{name: value})


def test_the_core_takes_what_python_takes():
    import numpy as np

    grid = np.zeros((3, 3), np.float32)
    for soil in [
        *SOILS.values(),
        Soil(),
        Soil(rest_angle=math.radians(88.9)),
        Soil(layer_depth=1e-4),
        Soil(settle_time=1e-5),
        Soil(*_native.soil_default()),
    ]:
        row = np.array(
            [
                [
                    soil.layer_depth,
                    soil.young_modulus,
                    soil.poisson_ratio,
                    soil.settle_time,
                    soil.rest_angle,
                    soil.push_threshold,
                    soil.shear_modulus,
                ]
            ],
            np.float32,
        )
        patch = (
            0.01,
            0.0,
            0.0,
            grid,
            grid.copy(),
            grid.copy(),
            grid.copy(),
            grid + row[0, 1],
            grid + 1,
            grid.astype(np.uint8),
            row,
        )
        assert _native.soil_stabilize(patch, None, None, 0.001, 1)["at_rest"]


def test_a_soil_cannot_be_changed():
    with pytest.raises(AttributeError):
        SOILS["mud"].young_modulus = 1.0
