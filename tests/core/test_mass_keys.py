"""Walkers whose mass changes while they walk."""

import math
import os
from dataclasses import replace

import numpy as np
import pytest

import desire_path
from desire_path import Bake, DesirePathError, Gait, Ground
from desire_path.loads import walker
from tests.scenes import gaits

WALK = os.path.join(os.path.dirname(desire_path.__file__), "walks", "walk.npz")


def stands(mass, keys=(), **more):
    gait, _ = gaits.pressed([gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -1.0]], seconds=2.0, mass=mass)
    return replace(gait, mass_keys=keys, **more)


def test_keys_on_a_mass_change_the_load_over_time():
    gait = stands(70.0, [[(0.5, 70.0), (1.5, 140.0)]])
    plain, keyed = (-walker.loads(each).force[0, :, 2] / 9.81 for each in (stands(70.0), gait))
    at = np.searchsorted(gait.time, [0.3, 1.0, 1.7])
    assert np.allclose(keyed[at] / plain[at], [1.0, 1.5, 2.0], atol=1e-6)
    assert np.allclose(plain[at], 70.0, rtol=0.02)


def test_a_mass_whose_keys_do_not_change_is_that_mass_to_the_bit():
    steady = walker.loads(stands(80.0, [[(0.0, 80.0), (2.0, 80.0)]]))
    assert np.array_equal(steady.force, walker.loads(stands(80.0)).force)


def test_keys_on_a_mass_are_saved_joined_and_chosen(tmp_path):
    keyed, plain = stands(70.0, [[(0.5, 70.0), (1.5, 140.0)]]), stands(60.0)
    keyed.save(tmp_path / "walk.npz")
    assert Gait.load(tmp_path / "walk.npz").mass_keys == keyed.mass_keys
    both = Gait.join([plain, keyed])
    assert both.mass_keys == ((), *keyed.mass_keys)
    assert both.only([0]).mass_keys == () and both.only([1]).mass_keys == keyed.mass_keys
    assert both.resample(240.0).mass_keys == both.mass_keys
    one, other = (Bake(each, Ground.flat(), folder=tmp_path / "a") for each in (keyed, stands(70.0)))
    assert one.signature() != other.signature()


@pytest.mark.parametrize(
    "keys, words",
    [
        ([[(0.0, 70.0)], [(0.0, 70.0)]], "not those of its walkers"),
        ([[(1.0, 70.0), (0.0, 70.0)]], "times that rise"),
        ([[(0.0, 0.0)]], "mass of 0 kg at 0 s"),
        ([[(0.0, math.nan)]], "mass of nan kg"),
    ],
)
def test_keys_no_mass_can_have_are_refused(keys, words):
    with pytest.raises(DesirePathError, match=words):
        stands(70.0, keys).check()


def test_along_a_path_they_do_not_count_and_it_says_so():
    keyed = replace(Gait.load(WALK), mass_keys=[[(0.0, 70.0), (1.0, 90.0)]])
    carried = keyed.along([[0.0, 0.0], [3.0, 0.0]])
    assert carried.mass_keys == () and "keys on the mass" in carried.warnings[0]
