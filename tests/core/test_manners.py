"""Manners that users of NumPy and SciPy expect: records that print, compare and keep what they hold, tables that are
read only, arguments that have names, and are alike where they mean the same."""

import inspect

import numpy as np
import pytest
from scenes import gaits

from desire_path import KINDS, SOILS, Gait, Ground, Simulation, Soil
from desire_path.ground.plants import PAPER
from desire_path.loads import walker
from desire_path.placement import passes


@pytest.fixture(scope="module")
def gait():
    return gaits.strides(3.0)[0]


@pytest.mark.parametrize("table", [SOILS, KINDS, PAPER])
def test_tables_of_presets_are_read_only(table):
    name, known = next(iter(table.items()))
    with pytest.raises(TypeError):
        table[name] = known
    with pytest.raises(TypeError):
        del table[name]
    assert dict(table)[name] is known and list(table)[0] == name


def test_a_soil_of_ones_own_needs_no_table():
    assert Simulation(Ground.flat(), Soil(layer_depth=0.1)).soils == [Soil(layer_depth=0.1)]


def test_along_names_its_keywords():
    own = inspect.signature(Gait.along).parameters
    there = inspect.signature(passes.along).parameters
    assert list(own)[1:] == list(there)[1:]
    assert [each.default for each in own.values()][1:] == [each.default for each in there.values()][1:]
    assert not any(each.kind is inspect.Parameter.VAR_KEYWORD for each in own.values())


def test_along_hands_on_every_keyword(gait, monkeypatch):
    seen = {}
    monkeypatch.setattr(passes, "along", lambda gait, path, passes, **more: seen.update(more))
    given = dict(back_and_forth=False, lateral=0.2, timing=0.1, stride=0.02, seed=3, pause=1.0, ground=2.0)
    gait.along([(0, 0), (4, 0)], 2, **given)
    assert seen == given


def test_loads_and_contacts_take_the_same_grounds(gait):
    hill = Simulation(Ground.heights(np.full((20, 60), 0.02), 0.1, -1.0, -1.0))
    for ground in (None, 0.02, hill, hill.rest_height):
        on, _ = walker.contacts(gait, ground=ground)
        np.testing.assert_array_equal(on, walker.Walker().contacts(gait, ground=ground)[0])
        np.testing.assert_array_equal(on != 0, walker.loads(gait, ground=ground).touching != 0)


def test_the_old_name_of_the_ground_of_contacts_warns(gait):
    with pytest.warns(DeprecationWarning, match="ground_height"):
        old = walker.contacts(gait, ground_height=0.02)
    for have, want in zip(old, walker.contacts(gait, 0.02)):
        np.testing.assert_array_equal(have, want)
