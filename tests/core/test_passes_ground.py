"""Passes over ground: they follow its height, and go on their toes uphill."""

from dataclasses import replace

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.ground.sim import Ground, Simulation
from desire_path.loads import walker
from desire_path.motion.gait import HEEL, Gait
from desire_path.placement import passes
from tests.core.test_passes import recorded_walk


@pytest.fixture(scope="module")
def walk():
    return recorded_walk()


def test_a_walk_follows_the_height_of_its_path(walk):
    gait = walk.along([(0, 0, 1.0), (6, 0, 2.2)])
    ground = lambda xy: 1.0 + 0.2 * np.clip(xy[:, 0], 0, 6)
    loads = walker.loads(gait, ground=ground)
    flat = walker.loads(walk.along([(0, 0), (6, 0)]))
    assert abs(loads.clearance).max() < 0.03
    assert abs((loads.touching != 0).mean() - (flat.touching != 0).mean()) < 0.05
    assert loads.mean[0] == pytest.approx(1.0, abs=0.05)


def test_a_walk_follows_the_ground(walk):
    ground = lambda xy: 0.5 + 0.15 * np.sin(xy[:, 0]) + 0.05 * xy[:, 1]
    gait = walk.along([(0, 0), (8, 1)], 2, ground=ground)
    loads = walker.loads(gait, ground=ground)
    assert abs(loads.clearance).max() < 0.03 and loads.mean[0] == pytest.approx(1.0, abs=0.05)
    assert not loads.warnings
    at = walker.point_places(gait)
    over = at[..., 2] - ground(at[..., :2].reshape(-1, 2)).reshape(at.shape[:2])
    assert over[loads.touching[gait.point_part] != 0].max() < 0.2 and over.min() > -0.08


def heels(gait, land):
    """How high heels are over the ground while their toes carry, in the middle of stances (n,) [m]."""
    loads = walker.loads(gait, ground=land.rest_height)
    at = walker.point_places(gait)
    over = at[..., 2] - land.rest_height(at[..., :2].reshape(-1, 2)).reshape(at.shape[:2])
    found = []
    for limb in range(len(gait.limb_walker)):
        mine = gait.part_limb[gait.point_part] == limb
        on = (loads.touching[gait.part_limb == limb] != 0).any(axis=0)
        edges = np.flatnonzero(np.diff(np.concatenate([[0], on, [0]])))
        middle = [(a + b) // 2 for a, b in zip(edges[::2], edges[1::2]) if b - a > 0.4 * gait.rate()]
        found += over[mine & (gait.point_role == HEEL)][:, middle].min(axis=0).tolist()
    return np.array(found)


@pytest.mark.parametrize("steep, high, low", [(0.0, 0.02, -0.02), (25.0, 0.12, 0.02), (-25.0, 0.02, -0.03)])
def test_passes_up_a_hill_go_on_their_toes(walk, steep, high, low):
    """TRAIL (2): heels stay up on slopes of more than 15 degrees, and only up the hill."""
    step = np.linspace(-3.0, 9.0, 49)
    hill = Ground.heights(np.broadcast_to(np.tan(np.radians(steep)) * step, (49, 49)), 0.25, -3.0, -6.0)
    land = Simulation(hill)
    gait = walk.along([(0, 0), (6, 0)], 3, back_and_forth=False, ground=hill)
    there = heels(gait, land)
    assert len(there) > 12 and np.quantile(there, 0.2) > low and np.quantile(there, 0.8) < high, there.round(3)
    flat = heels(walk.along([(0, 0), (6, 0)], 3, back_and_forth=False, ground=land.rest_height), land)
    assert np.median(abs(flat)) < 0.015  # by heights alone they lie flat


def test_holes_in_the_ground_do_no_harm(walk):
    ground = lambda xy: np.where(xy[:, 0] < 4, 0.3, np.nan)
    gait = walk.along([(0, 0), (8, 0)], ground=ground).check()
    assert abs(gait.com[0, :, 2] - walk.com[0, :, 2].mean() - 0.3).max() < 0.1
    walk.along([(0, 0), (8, 0)], ground=lambda xy: np.full(len(xy), np.nan)).check()


# ---- several walkers -------------------------------------------------------------------------------------


def test_walkers_go_in_turn(walk):
    heavy = replace(
        walk, mass=[110.0], walker_name=("Heavy",), com=walk.com + (3, 0, 0), pose=walk.pose + np.eye(7)[0] * 3
    )
    both = Gait.join([walk, heavy]).along([(0, 0), (4, 0)], 3, seed=2).check()
    alone = walk.along([(0, 0), (4, 0)], 3, seed=2)
    assert len(both.pieces()) == 6 and len(passes.turns_of(both)) == 6
    loads = walker.loads(both)
    assert loads.mean == pytest.approx([1.0, 1.0], abs=0.03) and not loads.warnings
    limbs = both.limb_walker[both.part_limb]
    for n, (first, after) in enumerate(both.pieces()):
        on = loads.touching[:, first:after].any(axis=1)
        assert on[limbs == n % 2].all() and not on[limbs != n % 2].any()
    first, after = both.pieces()[2]
    assert np.array_equal(both.pose[:4, first:after], alone.pose[:, slice(*alone.pieces()[1])])
    uneven = passes.in_turn([walk.along([(0, 0), (4, 0)], 3, pause=2.0), heavy.along([(0, 0), (0, 4)], 1)]).check()
    assert [turn[2] for turn in passes.turns_of(uneven)] == [0, 1, 0, 0]
    assert [turn[3] for turn in passes.turns_of(uneven)] == pytest.approx([0, 0, 2, 2])
    again = passes.in_turn([both, walk.along([(0, 0), (4, 0)], 2)]).check()
    assert [turn[2] for turn in passes.turns_of(again)] == [0, 2, 1, 2, 0, 1, 0, 1]
    with pytest.raises(DesirePathError, match="different rates"):
        passes.in_turn([alone, replace(heavy, frame_rate=48.0).along([(0, 0), (4, 0)])])
