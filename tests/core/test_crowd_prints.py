"""Prints of a crowd's own walkers tell what its ground costs, and how soon ways are trodden. MODEL 12.10"""

from dataclasses import replace

import numpy as np
import pytest
from scenes.crowds import EIGHT, park

from desire_path.crowd import prints
from desire_path.crowd import scene as scenes
from desire_path.crowd.covers import LANE
from desire_path.crowd.crowd import Crowd
from desire_path.crowd.tread import BESIDE
from desire_path.errors import DesirePathError
from desire_path.ground.soil import SOILS
from desire_path.placement.effort import PER_CM, SNOW


@pytest.fixture(scope="module")
def deep():
    return prints.prints("deep-snow", "", 75.0)


def test_fresh_snow_costs_by_the_depth_of_a_print(deep):
    """eta = 1.3 + 0.08 z: a print of the walk that comes with the add-on is 16 cm deep there."""
    depth, share = prints._sinking("deep-snow", prints.gait_of("", 75.0))
    assert 0.12 < depth < 0.21 and share[0] == 1.0
    assert deep.cost(0.0) == pytest.approx((SNOW + PER_CM * 100.0 * depth) / SNOW)
    assert deep.cost(1e9) == pytest.approx(1.0, abs=1e-3) and deep.pull == 0.0
    heavy = prints.prints("deep-snow", "", 110.0)
    assert heavy.detour > 1.05 * deep.detour


def test_a_trodden_way_costs_what_the_next_pass_sinks(deep):
    """The core presses pass after pass; the cost of a strip that so many went over is that of the next one's depth."""
    _, share = prints._sinking("deep-snow", prints.gait_of("", 75.0))
    across = np.linspace(-3.0, 3.0, 61) * BESIDE
    chance = np.exp(-0.5 * (across / BESIDE) ** 2)
    peak = LANE / (BESIDE * np.sqrt(2.0 * np.pi))
    passes = np.arange(len(share))
    sunk = (deep.cost(np.outer(passes, peak * chance)) - 1.0) @ chance / chance.sum() / deep.detour
    assert np.sqrt(np.mean((sunk - share) ** 2)) < 0.12
    groups = [slice(1, 8), slice(8, 16), slice(16, 24)]
    assert [sunk[each].mean() for each in groups] == pytest.approx([share[each].mean() for each in groups], abs=0.05)
    assert share[groups[2]].mean() < 0.8 * share[groups[0]].mean()


@pytest.mark.parametrize("half, steep", [(2.0, 2.1), (12.0, 1.4), (60.0, 0.8)])
def test_passes_that_sink_by_a_law_tell_its_numbers(half, steep):
    across = np.linspace(-3.5, 3.5, 401) * BESIDE
    chance = np.exp(-0.5 * (across / BESIDE) ** 2)
    load = np.outer(np.arange(40), LANE / (BESIDE * np.sqrt(2.0 * np.pi)) * chance)
    share = (1.0 / (1.0 + (load / half) ** steep)) @ chance / chance.sum()
    assert prints._fitted(share) == pytest.approx((half, steep), rel=0.03)


def test_a_crowd_keeps_to_the_way_it_has_trodden(tmp_path, deep):
    """In deep snow later walkers go by prints of those before; where prints tell nothing, each goes its own way."""
    found = []
    for ground in (deep, replace(deep, half_passes=1e9)):
        scene = replace(scenes.of(park(EIGHT, passages=300)), ground=ground)
        crowd = Crowd(scene, tmp_path / f"{len(found)}")
        found.append((crowd.run()["detour"], (crowd.load > 1.0).sum()))
    assert found[0][0] > found[1][0] + 0.005 and found[0][1] < 0.7 * found[1][1]


def test_scenes_name_the_soil_of_their_prints(tmp_path, deep):
    SOILS["deep-snow"].save(tmp_path / "mine.json")
    for soil in ("deep-snow", "mine.json"):
        scene = scenes.of(park(ground={"kind": "prints", "soil": soil, "pull": 0.1}), str(tmp_path))
        assert scene.ground == replace(deep, pull=0.1)
    many = [{"mass": 110, "share": 3}, {"mass": 75}]
    heavy = scenes.of(park(ground={"kind": "prints", "soil": "deep-snow"}, walkers=many)).ground
    assert heavy == prints.prints("deep-snow", "", 110.0)


@pytest.mark.parametrize(
    "ground, words",
    [
        ({"kind": "prints"}, "Ground that prints tell of has a soil"),
        ({"kind": "prints", "soil": 3}, "Ground that prints tell of has a soil"),
        ({"kind": "prints", "soil": "cheese"}, "no soil 'cheese'"),
        ({"kind": "prints", "soil": "packed-earth"}, "3 to 50 cm are waded"),
        ({"kind": "prints", "soil": "deep-snow", "colour": 1}, "no number called 'colour'"),
    ],
)
def test_prints_that_tell_nothing_are_told(ground, words):
    with pytest.raises(DesirePathError, match=words):
        scenes.of(park(ground=ground))
