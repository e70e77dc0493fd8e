"""Tracks: where marks lie along a curve, how wheels roll, what presses by weight or by depth. MODEL 3.8"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from desire_path import Ground, Simulation, Soil
from desire_path.bake import stamping
from desire_path.bake.stamping import TrackPress
from desire_path.errors import DesirePathError
from desire_path.ground.options import SimulationOptions
from desire_path.loads import checks, walker
from desire_path.motion.points import point_places
from desire_path.placement import track, tyre
from desire_path.placement.marks import Drive, Marks, lay
from desire_path.placement.pace import Pace
from desire_path.placement.track import Wheel
from desire_path.rig import solid

LINE = [(0.0, 0.0), (6.0, 0.0)]
ARC = 4.0 * np.column_stack([np.sin(np.linspace(0, 1.5, 60)), 1.0 - np.cos(np.linspace(0, 1.5, 60))])  # to the left


def marks(gait):
    """Where feet stand still for some time: places (n, 3), headings (n,) and soles (n,), by time."""
    found = []
    for part, pose in enumerate(gait.pose):
        still = np.r_[False, np.abs(np.diff(pose, axis=0)).max(axis=1) < 1e-9, False]
        edges = np.flatnonzero(np.diff(still.astype(int)))
        for a in edges[::2]:
            w, x, y, z = pose[a, 3:]
            found.append((a, pose[a, :3], 2.0 * np.arctan2(z, w), part))
    found.sort(key=lambda each: each[0])
    return np.array([f[1] for f in found]), np.array([f[2] for f in found]), np.array([f[3] for f in found])


def pressed(gait, soil="mud"):
    """What a track leaves: the compression, the cell it begins with, and the loads."""
    sim = Simulation(Ground.flat(), soil, 0.01)
    loads = walker.loads(gait, ground=sim.rest_height)
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    i0, i1, j0, j1 = sim.reach()
    return sim.read("compression", i0, j0, i1 - i0, j1 - j0), (i0, j0), loads


# ---- where marks lie ------------------------------------------------------------------------------


def test_marks_lie_spacing_by_spacing_left_and_right():
    gait = track.stamped(LINE, "boot", Marks(spacing=0.7, width=0.2))
    at, turn, part = marks(gait)
    assert len(at) == 9  # 6 m / 0.7 m and the first
    np.testing.assert_allclose(at[:, 0], 0.7 * np.arange(9), atol=1e-6)
    np.testing.assert_allclose(at[:, 1], 0.1 * (-1.0) ** np.arange(9), atol=1e-6)
    np.testing.assert_allclose(turn, np.radians(7.0) * (-1.0) ** np.arange(9), atol=1e-6)
    assert gait.limb_name == ("Track left", "Track right") and part.tolist() == [0, 1] * 4 + [0]
    other, _, part = marks(track.stamped(LINE, "boot", Marks(spacing=0.7, width=0.2, first="right")))
    np.testing.assert_allclose(other, at * (1, -1, 1), atol=1e-9)
    assert part.tolist() == [1, 0] * 4 + [1]


def test_marks_follow_an_arc():
    at, turn, _ = marks(track.stamped(ARC, "boot", Marks(count=9, width=0.3)))
    assert len(at) == 9
    radius = np.hypot(at[:, 0], at[:, 1] - 4.0)
    np.testing.assert_allclose(radius, np.where(np.arange(9) % 2 == 0, 3.85, 4.15), atol=0.006)  # left is inside
    angle = np.arctan2(at[:, 0], 4.0 - at[:, 1])
    np.testing.assert_allclose(angle, np.linspace(0, 1.5, 9), atol=0.005)
    np.testing.assert_allclose(
        turn - np.radians(7.0) * (-1.0) ** np.arange(9), angle, atol=0.035
    )  # a curve ends straight


def test_a_mirrored_curve_has_mirrored_marks_and_prints():
    one = track.stamped(ARC, "foot", Marks(count=4), Drive(depth=0.03))
    two = track.stamped(ARC * (1, -1), "foot", Marks(count=4, first="right"), Drive(depth=0.03))
    a, b = marks(one), marks(two)
    np.testing.assert_allclose(a[0], b[0] * (1, -1, 1), atol=1e-9)
    np.testing.assert_allclose(a[1], -b[1], atol=1e-9)
    for mine, other in ((0, 1), (1, 0)):
        np.testing.assert_array_equal(one.soles[mine].vertices, two.soles[other].vertices * np.float32((1, -1, 1)))
    (print_one, (_, j0), _), (print_two, (_, j1), _) = pressed(one), pressed(two)
    assert print_one.shape == print_two.shape and j1 == -(j0 + len(print_one))
    assert np.abs(print_one - print_two[::-1]).max() < 1e-4 and print_one.max() == pytest.approx(0.03, abs=1e-4)


def test_faster_steps_are_longer():
    """Spacings go with the root of the speed, and times between marks with its inverse."""
    curve = [(0.0, 0.0), (30.0, 0.0)]
    at, _, _ = marks(track.stamped(curve, "boot", Marks(spacing=0.5), Drive(speed=1.0, end_speed=4.0)))
    steps, middle = np.diff(at[:, 0]), 0.5 * (at[1:, 0] + at[:-1, 0])
    np.testing.assert_allclose(steps, 0.5 * np.sqrt(1.0 + 3.0 * middle / 30.0), rtol=2e-3)
    counted, _, _ = marks(track.stamped(curve, "boot", Marks(count=21), Drive(speed=1.0, end_speed=4.0)))
    assert len(counted) == 21 and counted[-1, 0] == pytest.approx(30.0, abs=1e-6)
    pace = Pace(30.0, 1.0, 4.0)
    s = np.linspace(0.0, 30.0, 7)
    np.testing.assert_allclose(pace.place(pace.time(s)), s, atol=1e-9)
    assert pace.time(30.0) == pytest.approx(10.0 * np.log(4.0))  # the integral of ds / (1 + s / 10)


def test_sizes_scatter_by_their_seed():
    gait = track.stamped([(0, 0), (70, 0)], "shoe", Marks(count=101, scatter=0.1, seed=4))
    _, _, part = marks(gait)
    long = np.array([np.ptp(sole.vertices[:, 0]) for sole in gait.soles])[part] / 0.28
    assert len(long) == 101 and abs(np.log(long).mean()) < 0.03 and 0.07 < np.log(long).std() < 0.13
    assert gait == track.stamped([(0, 0), (70, 0)], "shoe", Marks(count=101, scatter=0.1, seed=4))
    assert gait != track.stamped([(0, 0), (70, 0)], "shoe", Marks(count=101, scatter=0.1, seed=5))
    twice = track.stamped(LINE, "shoe", Marks(size=2.0))
    assert np.ptp(twice.soles[0].vertices[:, 0]) == pytest.approx(0.56, rel=1e-3)


def test_marks_lie_on_a_slope_as_it_slopes():
    hill = lambda at: 0.3 * at[:, 0] + 0.1 * at[:, 1]
    gait = track.stamped(LINE, "boot", Marks(spacing=0.7), ground=hill)
    at, _, _ = marks(gait)
    np.testing.assert_allclose(at[:, 2], hill(at), atol=1e-9)
    up = np.cross((1.0, 0.0, 0.3), (0.0, 1.0, 0.1))
    turned = Rotation.from_quat(gait.pose[0, 0, [4, 5, 6, 3]]).apply((0.0, 0.0, 1.0))
    np.testing.assert_allclose(turned, up / np.linalg.norm(up), atol=1e-6)
    assert track.stamped(LINE, ground=0.5).pose[0, 0, 2] == pytest.approx(0.5)


# ---- pressed at once ------------------------------------------------------------------------------


def at_once(laid, soil="mud", cell=0.01, **options):
    """What a track leaves that is pressed at once: the compression, and the press."""
    track = TrackPress(Ground.flat(), laid, soil, cell, options=SimulationOptions(**options)).press()
    return track.read("compression"), track


def test_marks_pressed_at_once_are_those_of_feet_that_come_down_one_by_one():
    """The same weights on the same places: volumes alike, and nowhere deeper by more than a millimetre."""
    given = (LINE, "shoe", Marks(spacing=0.6, width=0.3), Drive(mass=80.0))
    slow, (i0, j0), _ = pressed(track.stamped(*given))
    fast, press = at_once(lay(*given))
    both = np.zeros((2, 400, 900))
    for grid, found, (i, j) in zip(both, (slow, fast), ((i0, j0), press.window[::2])):
        grid[j + 200 : j + 200 + len(found), i + 100 : i + 100 + found.shape[1]] = found
    assert press.strokes == 11 and fast.max() > 0.01
    assert both[1].sum() == pytest.approx(both[0].sum(), rel=0.03) and np.abs(both[0] - both[1]).max() < 1.5e-3


@pytest.mark.parametrize("depth", [0.01, 0.06])
def test_a_depth_is_pressed_at_once_whatever_the_soil(depth):
    for soil in ("mud", Soil(young_modulus=5e7)):
        found, press = at_once(lay(LINE, "boot", Marks(count=5), Drive(depth=depth)), soil)
        assert found.max() == pytest.approx(depth, abs=1e-4) and press.strokes == 5


@pytest.mark.parametrize("soil", ["fresh-snow", "deep-snow"])
def test_walls_that_take_their_time_lie_still_before_the_next_mark(soil):
    """Else every mark would wait for all those before it, and the ground between them be gone through each time."""
    _, press = at_once(lay(LINE, "boot", Marks(spacing=2.0)), soil)
    before = {name: press.read(name) for name in ("compression", "heap")}
    assert before["compression"].max() > 0.05 and press.soils[0].flow_time > 0.0
    press.wait(20.0)
    for name, value in before.items():
        np.testing.assert_array_equal(press.read(name), value, err_msg=name)


def test_what_is_displaced_is_heaped_to_the_gram():
    _, press = at_once(lay(LINE, "boot", Marks(spacing=0.4), Drive(depth=0.05)), "dry-sand")
    press.sim.settle()
    told = press.sim.report()
    displaced = told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"]
    assert told["displaced_m3"] > 1e-3 and told["heaped_m3"] == pytest.approx(displaced, rel=1e-6)


@pytest.mark.parametrize("spacing", [0.15, 0.7])  # marks that lie on each other, and apart
def test_workers_do_not_change_a_bit_of_a_track(spacing):
    laid = lay(ARC, "boot", Marks(spacing=spacing, scatter=0.1))
    fields = []
    for threads in (1, 4):
        _, press = at_once(laid, "dry-sand", threads=threads)
        fields.append([press.read(name) for name in ("compression", "heap")])
    np.testing.assert_array_equal(fields[0], fields[1])


def test_crossing_tracks_are_pressed_in_their_order(monkeypatch):
    """Which comes last is seen, and marks that come down in one step are as if they came one by one."""
    one = lay([(-1.0, 0.0), (1.0, 0.0)], "shoe", Marks(count=3, width=0.0), Drive(depth=0.05))
    two = lay([(0.0, -1.0), (0.0, 1.0)], "shoe", Marks(count=3, width=0.0), Drive(depth=0.03))
    (deep, in_order), (_, other_way) = (at_once(both, "dry-sand") for both in ([one, two], [two, one]))
    monkeypatch.setattr(stamping, "AT_ONCE", 1)
    _, one_by_one = at_once([one, two], "dry-sand")
    wanted, found, turned = (each.read("heap") for each in (one_by_one, in_order, other_way))
    assert one_by_one.strokes == 6 and deep.max() == pytest.approx(0.05, abs=2e-3)
    assert np.abs(found - wanted).sum() < 1e-3 * np.abs(turned - wanted).sum()


def test_progress_is_told_and_a_track_is_pressed_once():
    told = []
    press = TrackPress(Ground.flat(), lay(LINE, "gull", Marks(count=40)), "mud", 0.005).press(told.append)
    once = press.read("compression")
    assert told == sorted(told) and len(told) >= 3 and 0.0 < told[0] < told[-1] < 1.0
    np.testing.assert_array_equal(press.press().read("compression"), once)
    with pytest.raises(DesirePathError, match="no mark"):
        TrackPress(Ground.flat(), [])


def test_wheels_roll_at_once_beside_stamps():
    """A rut as deep as it is told, one by weight, and marks, one after the other into the same ground."""
    line = np.array([(0.0, 0.0), (1.2, 0.0)])
    smooth = Wheel(radius=0.3, tread="plain")
    tracks = [
        track.rolled(line, smooth, Drive(depth=0.03)),
        lay(line + (0.0, 1.0), "shoe", Marks(count=3), Drive(depth=0.02)),
        track.rolled(line + (0.0, 2.0), smooth, Drive(mass=150.0)),
    ]
    found, press = at_once(tracks)
    i0, _, j0, _ = press.window
    along = [found[y - 40 - j0 : y + 40 - j0, 20 - i0 : 100 - i0].max(axis=0) for y in (0, 100, 200)]
    assert press.strokes == 5 and along[0].min() > 0.0285 and along[0].max() < 0.0301
    assert along[1].max() == pytest.approx(0.02, abs=2e-3) and along[1].min() == 0.0
    slow, (i0, _), _ = pressed(track.rolled(line, smooth, Drive(mass=150.0)))
    assert along[2].min() > 0.5 * along[2].max()
    assert along[2].mean() == pytest.approx(slow.max(axis=0)[20 - i0 : 100 - i0].mean(), rel=0.1)


# ---- pictures -------------------------------------------------------------------------------------


def test_a_weight_sinks_as_it_does_on_feet():
    """Twice the weight goes twice as deep; all marks of a straight track are alike."""
    one, _, _ = pressed(track.stamped(LINE, "shoe", Marks(count=5), Drive(mass=40.0)))
    two, _, _ = pressed(track.stamped(LINE, "shoe", Marks(count=5), Drive(mass=80.0)))
    assert two.sum() == pytest.approx(2.0 * one.sum(), rel=0.1)


@pytest.mark.parametrize("depth", [0.02, 0.1])
def test_a_depth_is_kept_whatever_the_soil(depth):
    gait = track.stamped(LINE, "boot", Marks(count=4), Drive(depth=depth))
    for soil in ("mud", Soil(young_modulus=5e7)):
        found, _, loads = pressed(gait, soil)
        assert found.max() == pytest.approx(depth, abs=1e-4) and not loads.warnings


def test_prints_come_from_above():
    """A foot that is told its depth is inside the ground straight over its mark alone: it cuts no walls."""
    gait = track.stamped(LINE, "boot", Marks(count=5), Drive(depth=0.08))
    for pose in gait.pose:
        low = pose[:, 2] < 0.0
        both = low[1:] & low[:-1]
        assert both.sum() > 20 and np.abs(np.diff(pose[:, :2], axis=0)[both]).max() < 1e-9


# ---- wheels ---------------------------------------------------------------------------------------


def test_a_wheel_rolls_without_slip():
    gait = track.rolled([(0.0, 0.0), (5.0, 0.0)], Wheel(radius=0.3))
    w, _, y, _ = gait.pose[0, :, 3:].T
    angle = 2.0 * np.unwrap(np.arctan2(y, w), period=np.pi)
    np.testing.assert_allclose(angle, gait.pose[0, :, 0] / 0.3, atol=1e-6)
    assert 5.0 <= np.ptp(gait.pose[0, :, 0]) < 5.0 + 2.0 / 120.0
    np.testing.assert_allclose(gait.pose[0, :, 2], 0.3)


@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_both_wheels_roll_by_their_own_way(mirror):
    """Round an arc of 4 m and 1.5 rad, 1.6 m apart: 3.2 m and 4.8 m radius."""
    gait = track.rolled(ARC * (1.0, mirror), Wheel(radius=0.3, gauge=1.6))
    assert gait.walker_name == ("Track left", "Track right") and gait.mass.tolist() == [100.0, 100.0]
    ways = []
    for pose in gait.pose:
        turn = Rotation.from_quat(pose[:, [4, 5, 6, 3]])
        spin = (turn[:-1].inv() * turn[1:]).as_rotvec()[:, 1]  # about its axle
        way = np.linalg.norm(np.diff(pose[:, :2], axis=0), axis=1)
        np.testing.assert_allclose(spin, way / 0.3, atol=1e-4)
        ways.append(way.sum())
    assert ways[mirror < 0] == pytest.approx(1.5 * 3.2, rel=0.015)  # the curve's ends are straight
    assert ways[mirror > 0] == pytest.approx(1.5 * 4.8, rel=0.015)


def test_a_wheel_leaves_a_rut_as_deep_as_it_is_told():
    gait = track.rolled([(0.0, 0.0), (3.0, 0.0)], Wheel(tread="plain"), Drive(depth=0.03))
    rut, (i0, j0), loads = pressed(gait)
    along = rut.max(axis=0)[-i0 : 300 - i0]  # over the curve
    assert not loads.warnings and along.min() > 0.0285 and along.max() < 0.0301
    aside = np.flatnonzero((rut > 0.001).any(axis=1)) + j0
    assert 0.19 <= (np.ptp(aside) + 1) * 0.01 <= 0.22


def test_a_heavy_wheel_rolls_in_a_rut_and_does_not_slide():
    gait = track.rolled([(0.0, 0.0), (3.0, 0.0)], Wheel(tread="plain"), Drive(mass=150.0))
    rut, (i0, _), loads = pressed(gait)
    assert not loads.warnings and loads.touching.all() and loads.mean[0] == pytest.approx(1.0, abs=0.02)
    along = rut.max(axis=0)[20 - i0 : 280 - i0]
    assert along.min() > 0.5 * along.max() > 0.0
    locked = replace(gait, pose=np.concatenate([gait.pose[..., :3], 0 * gait.pose[..., 3:] + (1, 0, 0, 0)], axis=2))
    on = np.ones((1, len(locked.time)), "u1")
    assert "slide at 2.0 m/s" in checks.slides(locked, point_places(locked), on, 1.0)[0]
    assert not checks.slides(gait, point_places(gait), on, 1.0)


def test_a_wheel_climbs_with_the_slope():
    gait = track.rolled([(0.0, 0.0), (3.0, 0.0)], Wheel(radius=0.5), ground=lambda at: 0.75 * at[:, 0])
    gap = (gait.pose[0, :, 2] - 0.75 * gait.pose[0, :, 0]) / np.hypot(1.0, 0.75)  # from the axle to the slope
    np.testing.assert_allclose(gap, 0.5, atol=1e-6)


@pytest.mark.parametrize("tread", tyre.TYRES)
def test_tyres_are_closed_and_reach_their_radius(tread):
    vertices, faces = tyre.wheel(0.3, 0.2, tread)
    assert solid.is_closed(faces) and np.ptp(vertices[:, 1]) == pytest.approx(0.2)
    corner = vertices[faces]
    volume = (np.cross(corner[:, 0], corner[:, 1]) * corner[:, 2]).sum() / 6.0
    assert 0.85 < volume / (np.pi * 0.09 * 0.2) < 1.0  # faces look outward
    out = np.hypot(vertices[:, 0], vertices[:, 2])[:-2]
    assert out.max() == pytest.approx(0.3) and (np.isclose(out, 0.3).mean() < 0.8) and out.min() > 0.28


# ---- what is refused ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "curve, says",
    [
        ([], "at least two"),
        ([(1.0, 2.0)], "at least two"),
        ([(0.0, 0.0), (np.nan, 1.0)], "Row 2"),
        ([(0.0, 0.0), (0.0, 0.0)], "no length"),
        ([(1.0, 1.0, 0.0), (1.0, 1.0, 3.0)], "stands upright"),
        ([(0.0, 0.0), (1e9, 0.0)], "Row 2"),
        ("abc", "no list"),
    ],
)
def test_a_curve_that_is_none_is_refused(curve, says):
    for make in (track.stamped, track.rolled):
        with pytest.raises(DesirePathError, match=says) as told:
            make(curve)
        assert str(told.value).count(". ") == 0
