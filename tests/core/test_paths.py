"""Arrival times, pulls and ways: against a literal twin, exact solutions, and what cannot be. MODEL 11.22"""

import numpy as np
import pytest
from reference import paths as slow

from desire_path import _native
from desire_path.errors import DesirePathError
from desire_path.paths.arrival import arrival, descend, direction, goal_around, way
from desire_path.paths.pull import pull, seen


def ground(seed, ny=24, nx=31, obstacles=0.2):
    rng = np.random.default_rng(seed)
    cost = rng.uniform(1.0, 3.0, (ny, nx)).astype(np.float32)
    cost[rng.random((ny, nx)) < obstacles] = np.inf
    cost[rng.random((ny, nx)) < 0.02] = np.nan
    return cost, rng


def middles(n, cell):
    return np.meshgrid((np.arange(n) + 0.5) * cell, (np.arange(n) + 0.5) * cell)


@pytest.mark.parametrize("seed", range(8))
def test_times_are_those_of_the_twin(seed):
    cost, rng = ground(seed, obstacles=0.05 * seed)
    goals = [(int(i), int(j)) for j, i in rng.permutation(np.argwhere(np.isfinite(cost)))[: 1 + seed]]
    starts = rng.uniform(0.0, 4.0, len(goals)).astype(np.float32) if seed % 2 else None
    got = arrival(cost, goals, 0.3, starts)
    want = slow.arrival(cost, goals, 0.3, starts)
    assert np.array_equal(np.isinf(got), np.isinf(want)) and np.isinf(got).any() == (~np.isfinite(cost)).any()
    assert np.allclose(got, want, rtol=1e-5, atol=0.0)


def circle_error(cells):
    """The largest error of times around a goal of 3 m in a field of 32 m, in metres."""
    cell = 32.0 / cells
    cost = np.ones((cells, cells))
    time = arrival(cost, *_goal(cost, (16.0, 16.0), 3.0, cell))
    x, y = middles(cells, cell)
    return np.abs(time - np.hypot(x - 16.0, y - 16.0)).max()


def _goal(cost, at, radius, cell):
    goals, starts = goal_around(cost, at, radius, cell)
    return goals, cell, starts


def test_even_ground_is_a_circle_of_second_order():
    errors = [circle_error(cells) for cells in (64, 128, 256)]
    assert errors[0] < 0.05
    assert errors[0] / errors[1] > 3.0 and errors[1] / errors[2] > 3.0  # 4 is second order, 2 would be first


def test_costs_that_rise_bend_the_rays():
    """Cost 1 / (a + b y): rays are arcs of circles, and times are known. Slotnick 1959"""
    errors = []
    for cells in (80, 160):
        cell = 20.0 / cells
        x, y = middles(cells, cell)
        speed = 1.0 + 0.1 * y
        far = np.hypot(x - 10.0, y - 10.0)
        exact = np.arccosh(1.0 + 0.01 * far**2 / (2.0 * speed * 2.0)) / 0.1
        j, i = np.nonzero(far <= 3.0)
        time = arrival(1.0 / speed, np.stack([i, j], 1), cell, exact[j, i])
        errors.append(np.abs(time - exact).max())
    assert errors[0] < 0.005 and errors[0] / errors[1] > 3.0


def refracted(angle, ratio):
    """Angle to the normal at which a way leaves slow ground, sin a = ratio sin b, by the crossing of least time."""
    cell, cells = 0.1, 240
    x, y = middles(cells, cell)
    cost = np.where(y < 12.0, 1.0, ratio)
    goal = (12.0 - 8.0 * np.tan(angle), 4.0)
    time = arrival(cost, *_goal(cost, goal, 0.6, cell))
    beyond = np.arcsin(np.sin(angle) / ratio)
    start = (12.0 + 8.0 * np.tan(beyond), 20.0)
    walked = descend(time, start, cell)
    crossing = walked[np.argmin(np.abs(walked[:, 1] - 12.0)), 0]
    upper, lower = walked[walked[:, 1] > 13.0], walked[(walked[:, 1] < 11.0) & (walked[:, 1] > 5.0)]
    lean = [np.arctan2(*np.abs(part[-1] - part[0])) for part in (upper, lower)]
    return crossing - 12.0, lean[0] - beyond, lean[1] - angle


@pytest.mark.parametrize("angle, ratio", [(20, 1.3), (45, 1.3), (20, 2.15), (45, 2.15)])
def test_ways_are_refracted_by_snells_law(angle, ratio):
    """A way's points lie within half a cell of 0.1 m of the ray: so does the crossing, and a part of 6 m and more
    leans by no more than a cell over it."""
    aside, above, below = refracted(np.radians(angle), ratio)
    assert abs(aside) < 0.05
    assert abs(above) < 0.1 / 7.0 and abs(below) < 0.1 / 6.0


@pytest.mark.parametrize("k", [0.3, 0.92, 2.15])
@pytest.mark.parametrize("turn", [0, 20, 45])
def test_a_strip_is_left_at_the_critical_angle(k, turn):
    """A walker on a strip of cost 1 in ground of cost 1 + k leaves it at arccos(1 / (1 + k))."""
    cell, cells = 0.25, 400
    x, y = middles(cells, cell)
    along = np.array([np.cos(np.radians(turn)), np.sin(np.radians(turn))])
    off = -(x - 50.0) * along[1] + (y - 50.0) * along[0]
    cost = np.where(np.abs(off) < 1.0, 1.0, 1.0 + k)
    goal = np.array([50.0, 50.0]) + 18.0 * along + 18.0 * np.array([-along[1], along[0]])
    walked = descend(arrival(cost, *_goal(cost, goal, 2.0, cell)), np.array([50.0, 50.0]) - 40.0 * along, cell)
    away = (walked - 50.0) @ np.array([-along[1], along[0]])
    part = walked[(away > 3.0) & (away < 15.0)]
    lean = np.degrees(np.arccos((part[-1] - part[0]) @ along / np.linalg.norm(part[-1] - part[0])))
    assert lean == pytest.approx(np.degrees(np.arccos(1.0 / (1.0 + k))), abs=3.0)


def test_times_go_around_an_obstacle():
    """Behind a wall, times are those round its end, by half a cell aside."""
    cell, cells = 0.1, 200
    cost = np.ones((cells, cells))
    cost[100:102, :120] = np.inf  # y from 10 to 10.2, its end at x = 12
    goal = (6.0, 6.0)
    time = arrival(cost, *_goal(cost, goal, 1.0, cell))
    x, y = middles(cells, cell)
    behind = (y > 10.4) & (x < 11.0)
    round_ = np.hypot(12.0 - 6.0, 10.0 - 6.0) + 0.2 + np.hypot(12.0 - x, y - 10.2)
    assert np.abs(time - round_)[behind].max() < 2.0 * cell
    assert np.isinf(time[100:102, :120]).all()
    walked = descend(time, (2.0, 15.0), cell)
    i, j = (walked / cell).astype(int).T
    assert np.isfinite(cost[j, i]).all()
    length = np.linalg.norm(np.diff(walked, axis=0), axis=1).sum()
    assert length == pytest.approx(round_[150, 20], rel=0.02)


def test_islands_have_no_time_and_no_way():
    cost = np.ones((20, 30))
    cost[:, 15] = np.nan
    time = arrival(cost, [(3, 3)], 0.5)
    assert np.isinf(time[:, 15:]).all() and np.isfinite(time[:, :15]).all()
    assert not direction(time, 0.5)[:, 15:].any()
    with pytest.raises(DesirePathError, match=r"No way leads from \(10, 5\).*island.*gap"):
        descend(time, (10.0, 5.0), 0.5)


def test_directions_follow_times():
    cost = np.ones((80, 80))
    time = arrival(cost, *_goal(cost, (20.0, 10.0), 2.0, 0.5))
    x, y = middles(80, 0.5)
    to = np.stack([20.0 - x, 10.0 - y], axis=-1)
    far = np.linalg.norm(to, axis=-1)
    along = (direction(time, 0.5) * to / far[..., None]).sum(axis=-1)
    assert along[far > 1.0].min() > np.cos(np.radians(2.5))


def test_seen_wear_is_that_of_the_twin():
    rng = np.random.default_rng(4)
    wear = rng.random((9, 14)) * (rng.random((9, 14)) < 0.4)
    assert np.allclose(seen(wear, 0.5, 0.4), slow.seen(np.float32(wear).astype(float), 0.5, 0.4), rtol=0.0, atol=1e-12)
    assert np.allclose(seen(wear, 0.5), slow.seen(np.float32(wear).astype(float), 0.5, 2.0), rtol=0.0, atol=1e-12)


def test_a_worn_line_pulls_from_both_sides_as_strong_as_said():
    wear = np.zeros((60, 60))
    wear[30] = 1.0
    to = pull(wear, 0.5)
    assert np.hypot(to[..., 0], to[..., 1]).max() <= 0.5 + 1e-6
    assert to[26, 30] == pytest.approx([0.0, 0.5], abs=1e-4) and to[34, 30] == pytest.approx([0.0, -0.5], abs=1e-4)
    assert abs(to[30, 30, 1]) < 1e-6 and not pull(np.zeros((60, 60)), 0.5).any()
    faint = pull(wear * 1e-3, 0.5)
    assert 0.0 < faint[26, 30, 1] < 0.05


def test_a_worn_line_gathers_ways_that_costs_alone_do_not():
    wear = np.zeros((100, 100))
    wear[50] = 1.0
    cost = np.ones((100, 100))
    time = arrival(cost, *_goal(cost, (47.0, 25.25), 1.5, 0.5))
    alone, pulled = (descend(time, (5.0, 29.0), 0.5, to) for to in (None, pull(wear, 0.5)))
    aside = [np.interp(25.0, walked[:, 0], walked[:, 1]) - 25.25 for walked in (alone, pulled)]
    assert aside[0] > 1.5 and abs(aside[1]) < 0.6


@pytest.mark.parametrize("seed", range(6))
def test_ways_are_those_of_the_twin(seed):
    cost, rng = ground(seed, obstacles=0.04 * seed)
    cell = 0.4
    goal = np.argwhere(np.isfinite(cost))[rng.integers(0, np.isfinite(cost).sum())][::-1]
    time = arrival(cost, [goal], cell)
    to = rng.normal(size=(*cost.shape, 2)).astype(np.float32)
    to *= np.float32(0.6) / np.maximum(np.linalg.norm(to, axis=-1, keepdims=True), 1.0)
    turn = rng.normal(scale=0.3, size=40).astype(np.float32)
    reached = np.argwhere(np.isfinite(time))
    for j, i in reached[rng.integers(0, len(reached), 12)]:
        start = ((i + rng.uniform(0.1, 0.9)) * cell, (j + rng.uniform(0.1, 0.9)) * cell)
        for more in ({}, {"turn": turn}, {"turn": turn, "inertia": 0.7}, {"inertia": 0.7}):
            got = descend(time, start, cell, to, 0.17, **more)
            want = slow.descend(time, start, cell, to, 0.17, **more)
            assert got.shape == want.shape and np.allclose(got, want, rtol=0.0, atol=1e-9), (seed, start, more)


def test_what_cannot_be_is_told():
    cost = np.ones((10, 20), np.float32)
    cost[4, 7] = np.inf
    for goals, words in (
        ([], "no goal"),
        ([(7, 4)], r"Goal 0, cell \(7, 4\), lies in an obstacle"),
        ([(0, 0), (20, 3)], r"Goal 1, cell \(20, 3\), lies outside the field of 20 x 10"),
        ([(-1, 3)], "outside"),
        ([(1.5, 3.0)], "whole numbers"),
        ([1, 2], "no cells"),
    ):
        with pytest.raises(DesirePathError, match=words):
            arrival(cost, goals, 0.5)
    for number in (0.0, -2.0, -np.inf, 1e25):
        wrong = cost.copy()
        wrong[2, 3] = number
        with pytest.raises(DesirePathError, match=r"cost of cell \(3, 2\) is .*above 0"):
            arrival(wrong, [(0, 0)], 0.5)
    with pytest.raises(DesirePathError, match="Every cell is an obstacle"):
        arrival(np.full((3, 3), np.nan), [(0, 0)], 0.5)
    for shape in ((0, 3), (5,), (2, 2, 2)):
        with pytest.raises(DesirePathError, match="are no field"):
            arrival(np.ones(shape), [(0, 0)], 0.5)
    with pytest.raises(DesirePathError, match="are numbers"):
        arrival([["a", "b"]], [(0, 0)], 0.5)
    for cell in (0.0, -1.0, np.nan, 1e9):
        with pytest.raises(DesirePathError, match="m wide"):
            arrival(cost, [(0, 0)], cell)
    for start, words in (([np.nan], "starts at nan"), ([-1.0], "starts at -1"), ([0.0, 1.0], "one for each")):
        with pytest.raises(DesirePathError, match=words):
            arrival(cost, [(0, 0)], 0.5, start)
    with pytest.raises(DesirePathError, match="No free cell"):
        goal_around(cost, (50.0, 50.0), 1.0, 0.5)


def test_ways_and_pulls_that_cannot_be_are_told():
    time = arrival(np.ones((10, 20)), [(0, 0)], 0.5)
    for start in ((-0.1, 1.0), (10.0, 1.0), (np.nan, 1.0), (1.0, np.inf)):
        with pytest.raises(DesirePathError, match="outside the field of 10 x 5 m"):
            descend(time, start, 0.5)
    for step in (0.0, 0.6, np.nan):
        with pytest.raises(DesirePathError, match="m long"):
            descend(time, (1.0, 1.0), 0.5, step=step)
    for strong in (1.0, np.nan):
        with pytest.raises(DesirePathError, match="keep it below 1"):
            descend(time, (1.0, 1.0), 0.5, np.full((10, 20, 2), strong))
    with pytest.raises(DesirePathError, match="does not fit"):
        descend(time, (1.0, 1.0), 0.5, np.zeros((10, 20)))
    for turn in (np.full(3, np.nan), np.zeros((2, 2))):
        with pytest.raises(DesirePathError, match="no row of numbers"):
            descend(time, (1.0, 1.0), 0.5, turn=turn)
    for inertia in (-1.0, np.nan, 1e9):
        with pytest.raises(DesirePathError, match="heading cannot be kept"):
            descend(time, (1.0, 1.0), 0.5, inertia=inertia)
    for wear in (np.full((4, 4), 1.5), np.full((4, 4), np.nan)):
        with pytest.raises(DesirePathError, match=r"wear of cell \(0, 0\)"):
            pull(wear, 0.5)
    for wrong in ({"strength": 1.0}, {"strength": np.nan}, {"sight": 0.0}, {"least": 0.0}):
        with pytest.raises(DesirePathError):
            pull(np.zeros((4, 4)), 0.5, **wrong)


def test_the_core_checks_its_door():
    cost, time = np.ones((4, 5), np.float32), np.zeros((4, 5), np.float32)
    goal, start = np.zeros(1, np.int32), np.zeros(1, np.float32)
    with pytest.raises(ValueError):
        _native.arrival(cost, 0.5, goal + 20, start, time)
    with pytest.raises((ValueError, TypeError)):
        _native.arrival(cost, 0.5, goal, start, np.zeros((5, 4), np.float32))
    with pytest.raises((ValueError, TypeError)):
        _native.descend(time, 0.5, np.zeros((4, 5), np.float32), 1.0, 1.0, 0.2, None, 0.0)
    assert len(bytes(_native.descend(time, 0.5, None, 1.0, 1.0, 0.2, None, 0.0))) == 16  # flat times: there it is


def test_the_old_name_of_descending_is_told():
    cost = np.ones((8, 8), np.float32)
    time = arrival(cost, *_goal(cost, (2.0, 2.0), 0.5, 0.5))
    with pytest.warns(DeprecationWarning, match="descend"):
        np.testing.assert_array_equal(way(time, (1.0, 1.0), 0.5), descend(time, (1.0, 1.0), 0.5))
