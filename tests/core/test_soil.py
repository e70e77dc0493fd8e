"""Kinds of ground: presets lie in the papers' ranges, and impossible numbers are refused with a sentence."""

import math
from dataclasses import asdict, fields, replace

import numpy as np
import pytest

from desire_path import _native
from desire_path.errors import DesirePathError
from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import BY_DEPTH, SOILS, Soil, as_soil
from tests.scenes import gaits

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


def test_a_soil_has_the_numbers_of_the_core():
    """Names, order, defaults and ranges: base/soil_numbers.h tells them to both."""
    table = _native.soil_numbers()
    assert [(each.name, each.default) for each in fields(Soil)] == [(n, default) for n, _, _, _, default, _ in table]
    for name, unit, lowest, highest, _, meaning in table:
        assert unit and meaning
        for value in (lowest, highest):
            assert getattr(replace(Soil(), **{name: value}), name) == value
        with pytest.raises(DesirePathError, match=name):
            replace(Soil(), **{name: highest * 1.001})
        with pytest.raises(DesirePathError, match=name):
            replace(Soil(), **{name: lowest - 0.001 * (lowest or 1.0)})


def test_presets_of_the_papers_come_first_and_the_others_are_for_looks():
    assert set(list(SOILS)[: len(TABLES)]) == set(TABLES)  # files keep their places
    for name in list(SOILS)[len(TABLES) :]:
        if name.startswith("sumner-"):
            continue
        assert SOILS[name].roughness > 0 and SOILS[name].wall_angle < math.radians(86)


@pytest.mark.parametrize(
    "name, inside, outside, alpha",  # SUMNER99 Table 1 [rad, rad, -], as the review arXiv 2302.08683 tells it
    [("sumner-sand", 0.8, 0.436, 0.3), ("sumner-mud", 1.57, 1.1, 0.41), ("sumner-snow", 1.57, 1.57, 0.0)],
)
def test_presets_of_sumner_have_the_numbers_of_the_table(name, inside, outside, alpha):
    soil = SOILS[name]
    assert soil.wall_angle == pytest.approx(inside, abs=1e-3)
    assert soil.rest_angle == pytest.approx(min(outside, math.radians(89.0)), abs=1e-6)  # no soil is steeper
    assert soil.roughness == 0.2 and 2.0 * soil.poisson_ratio == pytest.approx(alpha)


def test_prints_are_as_deep_as_people_know_them():
    """A person of 80 kg on one foot, in the order of design and README."""
    order = ["deep-snow", "fresh-snow", "crust-snow", "mud", "wet-soil", "dry-sand", "wet-sand"]
    order += ["packed-snow", "packed-earth"]
    depths = []
    for name in order:
        sim = Simulation(Ground.flat(), name, 0.01)
        gait, loads = gaits.pressed([gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -80 * 9.81]])
        sim.load(gait, loads)
        sim.run(len(gait.time) - 1)
        depths.append(np.median(sim.read("compression", -9, -2, 18, 4)))
    assert depths == sorted(depths, reverse=True) and min(-np.diff(depths)) > 1e-4, depths
    assert 0.08 < depths[0] < 0.2 and depths[-1] > 3e-4
    assert [name for name in BY_DEPTH if name in order] == order


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
    ]:
        patch = (
            0.01,
            0.0,
            0.0,
            grid,
            grid.copy(),
            grid.copy(),
            grid.copy(),
            grid + np.float32(soil.young_modulus),
            grid + 1,
            grid.astype(np.uint8),
            [asdict(soil)],
        )
        assert _native.soil_stabilize(patch, None, None, 0.001, 1)["at_rest"]


def test_a_soil_cannot_be_changed():
    with pytest.raises(AttributeError):
        SOILS["mud"].young_modulus = 1.0


def test_a_soil_is_saved_and_comes_back(tmp_path):
    mine = replace(SOILS["mud"], young_modulus=2.5e5, layer_depth=0.5)
    mine.save(tmp_path / "mine.json")
    assert Soil.load(tmp_path / "mine.json") == mine
    assert as_soil(str(tmp_path / "mine.json")) == mine and as_soil("mud") is SOILS["mud"] and as_soil(mine) is mine
    (tmp_path / "short.json").write_text('{"desire_path_soil": 1, "young_modulus": 3e5}')
    assert Soil.load(tmp_path / "short.json") == Soil(young_modulus=3e5)


@pytest.mark.parametrize(
    "text, word",
    [
        ("", "not a soil"),
        ("[1]", "of this version"),
        ('{"desire_path_soil": 2}', "of this version"),
        ('{"desire_path_plant": 1}', "of this version"),
        ('{"desire_path_soil": 1, "softness": 3}', "says softness, which no soil has"),
        ('{"desire_path_soil": 1, "young_modulus": -1}', "young_modulus"),
        ('{"desire_path_soil": 1, "young_modulus": NaN}', "young_modulus"),
        ('{"desire_path_soil": 1, "young_modulus": "soft"}', "is no number"),
        ('{"desire_path_soil": 1, "rest_angle": null}', "is no number"),
        ('{"desire_path_soil": 1, "rest_angle": 1' + 400 * "0" + "}", "more than 1e300"),
        ('{"desire_path_soil": 1, "rest_angle": true}', "is no number"),
        ('{"desire_path_soil": 1, "settle_time": [1, 2]}', "is no number"),
    ],
)
def test_files_that_hold_no_soil_are_refused_in_words(tmp_path, text, word):
    (tmp_path / "bad.json").write_text(text)
    with pytest.raises(DesirePathError, match=word):
        Soil.load(tmp_path / "bad.json")


def test_numbers_are_set_by_name():
    assert SOILS["mud"].changed(["young_modulus=2e6", "layer_depth=.5"]) == replace(
        SOILS["mud"], young_modulus=2e6, layer_depth=0.5
    )
    for text, word in (("softness=1", "No soil has 'softness'"), ("young_modulus=soft", "no number"), ("", "No soil")):
        with pytest.raises(DesirePathError, match=word):
            SOILS["mud"].changed([text])
    with pytest.raises(DesirePathError, match="There is no soil 'Mud'"):
        as_soil("Mud")


def test_numbers_in_a_row_are_a_soil_still_and_warn():
    row = _native.soil_default()
    assert row == tuple(number[4] for number in _native.soil_numbers())
    old = lambda soils: _native.Simulation(("flat", 0.0), soils, 0.01, (0.0, 0.0))
    told = r"soil \d: numbers in a row are an old way"
    for soils in ([row], np.array([row, row], "f4")):
        with pytest.warns(DeprecationWarning, match=told):
            old(soils)
    with pytest.raises(TypeError, match="not a dict of numbers by name"):
        old([row[:-1]])
    with pytest.warns(DeprecationWarning, match=told), pytest.raises(ValueError, match="out of its range"):
        old([(-1.0, *row[1:])])
    with pytest.warns(DeprecationWarning, match=told), pytest.raises(TypeError):
        old([("soft",) * len(row)])
