"""Vehicles: axles led along a curve, tyres beside each other, what is no vehicle. MODEL 3.8"""

import json

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from desire_path import Ground
from desire_path.bake.stamping import TrackPress
from desire_path.errors import DesirePathError
from desire_path.placement import track, tyre, vehicle
from desire_path.placement.marks import Drive
from desire_path.placement.path import Path
from desire_path.placement.vehicle import VEHICLES, Axle, Vehicle
from tests.core.test_cli import run


def circle(radius, turns):
    a = np.linspace(0.0, 2.0 * np.pi * turns, int(400 * turns))
    return radius * np.column_stack([np.sin(a), 1.0 - np.cos(a)])


@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_the_axle_behind_cuts_the_corner(mirror):
    """Round a circle of radius R a bar of length L that is drawn by its front ends on one of sqrt(R^2 - L^2)."""
    path, long = Path(circle(6.0, 2.0) * (1.0, mirror)), 3.0
    car = Vehicle((Axle(0.0), Axle(long)))
    s = np.linspace(0.0, path.length, 2000)
    (front, _), (rear, heading) = car.steer(path, s)
    late = s > 0.8 * path.length
    late &= s < 0.98 * path.length  # a curve ends straight
    middle = np.array([0.0, 6.0 * mirror])
    np.testing.assert_allclose(np.linalg.norm(front[late] - middle, axis=1), 6.0, atol=0.01)
    np.testing.assert_allclose(np.linalg.norm(rear[late] - middle, axis=1), np.sqrt(36.0 - 9.0), atol=0.01)
    np.testing.assert_allclose(np.linalg.norm(front - rear, axis=1), long, atol=1e-9)
    moved = np.diff(rear, axis=0)
    aside = moved[:, 1] * np.cos(heading[1:]) - moved[:, 0] * np.sin(heading[1:])
    assert abs(aside).max() < 0.02 * np.linalg.norm(moved, axis=1).max(), "the axle behind slides to the side"


def test_the_body_follows_as_the_equation_says():
    """d theta / ds = sin(phi - theta) / L, solved by another hand."""
    x = np.linspace(0.0, 20.0, 200)
    path = Path(np.column_stack([x, 1.5 * np.sin(0.7 * x)]))
    long, s = 2.6, np.linspace(0.0, path.length, 300)
    (_, (_, heading)) = Vehicle((Axle(), Axle(long))).steer(path, s)

    def turns(at, theta):
        return np.sin(np.interp(at, path.s, path.heading) - theta) / long

    other = solve_ivp(turns, (0.0, path.length), [path.heading[0]], t_eval=s, rtol=1e-8, atol=1e-9, max_step=0.02).y[0]
    np.testing.assert_allclose(heading, other, atol=2e-3)


def test_dual_tyres_stand_beside_each_other_and_share_the_load():
    axle = Axle(0.0, 0.5, 0.28, gauge=1.85, tyres=2)
    names, aside = zip(*axle.sides())
    assert names == ("left outer", "left inner", "right outer", "right inner")
    half = 0.5 * 1.15 * 0.28
    np.testing.assert_allclose(aside, [0.925 + half, 0.925 - half, -0.925 - half, -0.925 + half])
    lorry = track.rolled([(0.0, 0.0), (9.0, 0.0)], VEHICLES["lorry"])
    assert len(lorry.soles) == 10 and lorry.mass.sum() == pytest.approx(25000.0)
    assert lorry.mass[0] == pytest.approx(25000.0 * 0.28 / 2) and lorry.mass[2] == pytest.approx(25000.0 * 0.36 / 4)
    assert lorry.walker_name[0] == "Track axle 1 left" and lorry.walker_name[-1] == "Track axle 3 right inner"
    start = np.asarray(lorry.pose)[:, 0]
    np.testing.assert_allclose(start[:, 0], [0.0] * 2 + [-4.4] * 4 + [-5.75] * 4, atol=1e-9)
    np.testing.assert_allclose(start[2:6, 1], aside, atol=1e-9)


def test_wheels_of_a_vehicle_roll_without_slip_each_by_its_own_radius():
    tractor = track.rolled([(0.0, 0.0), (6.0, 0.0)], VEHICLES["tractor"])
    for number, radius in enumerate((0.6, 0.6, 0.9, 0.9)):
        w, _, y, _ = np.asarray(tractor.pose)[number, :, 3:].T
        angle = 2.0 * np.unwrap(np.arctan2(y, w), period=np.pi)
        place = np.asarray(tractor.pose)[number, :, 0]
        np.testing.assert_allclose(angle, (place - place[0]) / radius, atol=1e-6)


def test_the_outer_wheel_of_a_tight_bend_is_sampled_as_finely_as_any():
    gait = track.rolled(circle(3.0, 0.5), track.Wheel(radius=0.3, gauge=3.0), Drive(speed=4.0))
    turned = [abs((pose[1:] * pose[:-1]).sum(axis=1)) for pose in np.asarray(gait.pose)[..., 3:]]
    angle = [2.0 * np.arccos(np.minimum(each, 1.0)).max() for each in turned]
    assert min(angle) < 0.7 * max(angle) and max(angle) < 1.05 * track.ROLLS  # with its turn about the bend


def test_four_ruts_of_a_car_in_a_bend_and_two_where_it_goes_straight():
    smooth = VEHICLES["car"].plain()
    for curve, ruts in (([(0.0, 0.0), (3.0, 0.0)], 2), (circle(7.0, 0.25), 4)):
        gait = track.rolled(curve, smooth, Drive(depth=0.03))
        pressed = TrackPress(Ground.flat(), gait, "mud", 0.02).press()
        deep = pressed.read("compression")
        i0, _, j0, _ = pressed.window
        if ruts == 2:
            across = deep[:, int(1.5 / 0.02) - i0]
        else:  # along a ray at 60 degrees
            out = np.arange(4.0, 9.0, 0.01)
            x, y = out * np.sin(np.pi / 3), 7.0 - out * np.cos(np.pi / 3)
            across = deep[(y / 0.02).astype(int) - j0, (x / 0.02).astype(int) - i0]
        edges = np.diff((across > 0.02).astype(int))
        assert (edges == 1).sum() == ruts, (ruts, edges)


@pytest.mark.parametrize("tread", tyre.TYRES)
def test_a_wheel_touches_to_both_sides_of_its_tread(tread):
    """As far out as the tyre reaches, all round: no more of them the finer its tread."""
    vertices, _ = tyre.wheel(0.5, 0.28, tread)
    points = tyre.touching(vertices)
    assert len(points) == 2 * 72 and np.hypot(points[:, 0], points[:, 2]) == pytest.approx(0.5, rel=2e-3)
    assert np.unique(points[:, 1]).sum() == pytest.approx(0.0, abs=1e-9)
    assert 0.5 * 0.14 < abs(points[0, 1]) < 0.14


def test_a_drum_is_the_wheel_without_its_grooves():
    for tread in tyre.TYRES:
        vertices, _ = tyre.wheel(0.4, 0.2, tread)
        round_, faces = tyre.drum(vertices)
        assert np.hypot(round_[:, 0], round_[:, 2]).max() == pytest.approx(0.4, rel=1e-6)
        assert np.ptp(round_[:, 1]) == pytest.approx(0.2) and faces.max() == len(round_) - 1
    narrow = track.rolled([(0.0, 0.0), (2.0, 0.0)], VEHICLES["bicycle"])
    deep = TrackPress(Ground.flat(), narrow, "mud", 0.01).press().read("compression")
    along = deep.max(axis=0)
    middle = along[len(along) // 2 - 40 : len(along) // 2 + 40]
    assert middle.min() > 0.25 * middle.max() > 0.0, "it lost the ground between its blocks"


def test_a_saved_vehicle_comes_back(tmp_path):
    VEHICLES["truck"].save(tmp_path / "mine.json")
    assert vehicle.find(tmp_path / "mine.json") == VEHICLES["truck"]
    given = json.loads((tmp_path / "mine.json").read_text())
    assert given["axles"][1]["tyres"] == 2 and given["mass"] == 12000.0


@pytest.mark.parametrize(
    "axles, words",
    [
        ((), "0 axles"),
        (7, "0 axles"),
        ((Axle(1.0),), "first axle is its foremost"),
        ((Axle(), Axle(0.0)), "first axle is its foremost"),
        ((Axle(), Axle(-1.0)), "behind is -1.0"),
        ((Axle(), Axle(float("nan"))), "behind is nan"),
        ((Axle(tyres=3),), "3 tyres side by side"),
        ((Axle(share=0.0),), "share is 0.0"),
        ((Axle(radius="wide"),), "radius is wide"),
        ((Axle(tread="spikes"),), "no tread 'spikes'"),
        ((Axle(gauge=0.4, tyres=2),), "do not fit"),
        (({"wings": 2},), "An axle has no wings"),
        (("front",), "a list of Axle"),
    ],
)
def test_no_vehicle_is_said(axles, words):
    with pytest.raises(DesirePathError, match=words):
        Vehicle(axles)


@pytest.mark.parametrize("mass, speed", [(-5.0, 2.0), (float("nan"), 2.0), ("heavy", 2.0), (90.0, 0.0), (90.0, True)])
def test_what_a_vehicle_weighs_and_how_fast_it_is_are_numbers(mass, speed):
    with pytest.raises(DesirePathError, match="The vehicle's (mass|speed) is"):
        Vehicle((Axle(),), mass, speed)


def test_a_bend_too_tight_is_said_before_anything_is_pressed():
    with pytest.raises(DesirePathError, match="bends too tightly .* draw it wider"):
        track.rolled([(0, 0), (8, 0), (8, 8)], VEHICLES["lorry"])
    with pytest.raises(DesirePathError, match="no vehicle 'sledge': choose one of bicycle"):
        vehicle.find("sledge")
    with pytest.raises(DesirePathError, match="radius of 0 m"):
        track.rolled([(0, 0), (8, 0)], Vehicle((Axle(radius=0.0),)))


def test_the_command_rolls_a_vehicle(tmp_path):
    (tmp_path / "path.csv").write_text("x,y\n0,0\n4,0\n")
    along = "track", "--along", "path.csv", "--out", "ruts", "--vehicle"
    out = run(*along, "bicycle", "--soil", "mud", "--cell", "0.02", cwd=tmp_path)
    assert out.returncode == 0 and (tmp_path / "ruts/maps_final.exr").exists(), out.stderr
    both = run(*along, "car", "--wheel", "0.3", cwd=tmp_path)
    assert both.returncode == 2 and "not allowed with" in both.stderr
    spaced = run(*along, "car", "--spacing", "0.3", cwd=tmp_path)
    assert spaced.returncode == 1 and "leave --wheel and --vehicle out" in spaced.stderr
