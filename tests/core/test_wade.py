"""Feet that go through what they sink into: MODEL 3.9"""

from dataclasses import replace

import numpy as np
import pytest

import desire_path
from desire_path import DesirePathError, Ground, Simulation, SimulationOptions
from desire_path.ground.soil import snow
from desire_path.loads import walker
from desire_path.motion import rotation
from desire_path.motion import size as sizes
from desire_path.motion.gait import Gait
from desire_path.motion.tracks import TrackArray
from desire_path.placement import shank
from desire_path.placement.wade import wade
from tests.scenes import bvh, plates

CELL = 0.02
SNOW = snow(100.0)


@pytest.fixture(scope="module")
def walk():
    gait = replace(plates.trial("gait_bmc_walk1", every=2), mass=np.array([80.0]))
    return gait.piece(0, int(0.75 * len(gait.time)))


def trial(soil=SNOW, cell=CELL, **options):
    return Simulation(Ground.flat(), soil, cell, options=SimulationOptions(**options))


def pressed(gait, **options):
    sim = trial(**options)
    sim.load(gait, walker.loads(gait, ground=sim))
    sim.run(len(gait.time) - 1)
    return sim


def surface(sim, gait):
    """Below the rest height [m], around where a walk goes."""
    low, high = gait.pose[..., :2].min(axis=(0, 1)) - 0.4, gait.pose[..., :2].max(axis=(0, 1)) + 0.4
    return sim.read("compression", (*low, *high)) - sim.read("heap", (*low, *high))


@pytest.fixture(scope="module")
def waded(walk):
    return wade(walk, trial())


def test_feet_drag_out_of_their_prints_and_into_the_next(walk, waded):
    plain, drags = (surface(pressed(gait), walk) for gait in (walk, waded))
    prints = plain > 0.12
    assert np.median(drags[prints]) == pytest.approx(np.median(plain[prints]), abs=0.04)  # some snow falls back in
    opened = (drags > 0.03) & (plain < 1e-6)  # where snow lay untouched beside the prints
    assert 0.5 * prints.sum() < opened.sum() < 2.0 * prints.sum()
    # along the walk: nothing is opened in the middle of a step
    assert (drags.max(axis=0) < 0.03).any() or (drags.max(axis=1) < 0.03).any()
    pushed, slid = (-np.minimum(each, 0.0).sum(dtype=float) for each in (drags, plain))
    assert drags.min() < -0.02 and pushed > 2.0 * slid  # what was in the way lies in front


def test_who_does_not_lift_his_feet_ploughs_a_furrow(walk):
    sim = pressed(wade(walk, trial(cell=0.04), lift=0.0), cell=0.04)
    drags, lifted = surface(sim, walk), surface(pressed(wade(walk, trial(cell=0.04)), cell=0.04), walk)
    along = 1 if drags.shape[1] > drags.shape[0] else 0
    deep, clear = (each.max(axis=1 - along) for each in (drags, lifted))
    inside = np.flatnonzero(clear > 0.15)
    between = slice(inside[0], inside[-1])
    # what is ploughed up while the other foot stands is laid beside that, into the furrow, too
    assert deep[between].min() > 0.045 and clear[between].min() < 0.03


def test_nothing_is_lost(waded):
    told = pressed(waded).report()
    laid = told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"]
    assert told["heaped_m3"] == pytest.approx(laid, rel=1e-6) and told["heaped_m3"] > 1e-3


def test_it_is_the_same_for_any_number_of_threads(walk, waded):
    other = wade(walk, trial(threads=4))
    assert np.array_equal(other.pose, waded.pose)
    assert np.array_equal(surface(pressed(other, threads=4), walk), surface(pressed(waded, threads=1), walk))


def test_who_does_not_sink_walks_as_before(walk):
    same = wade(walk, trial("packed-earth"))
    assert len(same.mass) == 1 and np.array_equal(same.pose, walk.pose)


def test_its_legs_are_called_its_own_and_carve(walk, waded):
    assert waded.walker_name == (walk.walker_name[0], f"{walk.walker_name[0]}'s legs")
    assert waded.contact_law == ("auto", "carve")
    deep = walk.pose[..., 2] - waded.pose[len(walk.part_limb) : 2 * len(walk.part_limb), :, 2]
    assert deep.min() >= 0.0 and 0.2 < deep.max() < 0.22
    again = wade(waded, trial())  # who carves has legs enough
    assert len(again.mass) == 3


def test_shanks_are_where_the_bones_are():
    """A recording knows feet and a mass centre; the knee that follows is that of the markers, within some degrees."""
    skeleton, motion, _ = bvh.load(plates.DATA / "gait_bmc_walk1" / "armature.bvh")
    gait = sizes.known(plates.trial("gait_bmc_walk1"))
    for limb, side in enumerate(("Left", "Right")):
        ankle, knee = (motion.matrix[:, motion.bones.index(side + bone), :3, 3] for bone in ("Foot", "Leg"))
        found = shank.stands(gait.pose[2 * limb], gait.com[0], float(gait.leg[0]), 1.0 - 2.0 * limb)
        assert np.abs(found[:, :3] - ankle).max() < 0.02
        apart = (rotation.turned(found[:, 3:], np.array([0.0, 0.0, 1.0])) * rotation.unit(knee - ankle)).sum(axis=1)
        assert np.degrees(np.arccos(np.quantile(apart, 0.1))) < 8.0 and np.degrees(np.arccos(apart.min())) < 12.0


def test_what_is_deeper_than_a_foot_is_high_meets_its_shank(walk, waded, monkeypatch):
    own = len(walk.part_limb)
    assert waded.part_name[2 * own :] == ("shank",) * 2 and (waded.limb_walker[4:] == 1).all()
    low = waded.pose[2 * own :, :, 2]  # the ankle, between 5 and 9 cm over its sole
    assert (
        (low - waded.pose[own : 2 * own : 2, :, 2] > 0.0) & (low - waded.pose[own : 2 * own : 2, :, 2] < 0.09)
    ).all()
    assert low.min() < -0.1
    with monkeypatch.context() as only:
        only.setattr(shank, "persons", lambda _: np.zeros(0, int))
        feet = wade(walk, trial())
    assert len(feet.part_limb) == 2 * own
    thin, wide = (surface(pressed(gait), walk) for gait in (feet, waded))
    assert (wide > 0.03).sum() > 1.05 * (thin > 0.03).sum()  # the shaft is wider above
    assert wide.max() == pytest.approx(thin.max(), abs=0.01)  # and as deep
    shallow = wade(walk, trial(snow(400.0)))
    assert len(shallow.mass) == 2 and len(shallow.part_limb) == 2 * own, "it does not reach the ankle"


def test_only_those_who_are_told_wade(walk):
    beside = walk.pose.copy()
    beside[..., 1] += 1.5
    both = Gait.join([walk, replace(walk, pose=beside, com=walk.com + [0.0, 1.5, 0.0], walker_name=("Other",))])
    waded = wade(both, trial(), walkers=[1])
    assert waded.walker_name == (*both.walker_name, "Other's legs")
    assert wade(both, trial(), walkers=[]).walker_name == both.walker_name


def test_walkers_who_go_in_turn_wade_in_turn(walk):
    many = walk.along([[0.0, 0.0], [6.0, 0.0]], 2, pause=1.0)
    waded = wade(many, trial())
    assert isinstance(waded.pose, TrackArray) == isinstance(many.pose, TrackArray)
    own = len(many.part_limb)
    assert (np.asarray(many.pose)[..., 2] - np.asarray(waded.pose)[own : 2 * own, :, 2]).max() > 0.15
    sim = pressed(waded)
    assert sim.report()["deepest_m"] < 0.26


@pytest.mark.parametrize("lift", (-0.1, float("nan")))
def test_a_lift_that_is_none_is_refused(walk, lift):
    with pytest.raises(DesirePathError, match="cannot be lifted"):
        wade(walk, trial(), lift)


def test_it_is_at_hand_by_its_name():
    assert desire_path.wade is wade
