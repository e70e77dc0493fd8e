"""Soil that sticks to soles and wheels is carried on and left along the way. MODEL 6.16, MODEL 11.25, PEYRAT11 3.4"""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from desire_path import SOILS, Bake, BakeOptions, DesirePathError, Ground, Simulation, SimulationOptions, Soil, Sole
from desire_path.bake.stamping import TrackPress
from desire_path.ground import layers, maps, materials
from desire_path.placement import track
from desire_path.placement.marks import lay
from desire_path.placement.track import Wheel
from tests.golden.worlds import walk

MUD = replace(SOILS["mud"], adhesion=0.004)
ROAD = Soil(young_modulus=5e9)
CELL = 0.01


def road(ends=(1.0,), length=8.0):
    """Level ground from x = -1 on, mud up to the first end, road up to the second, and so on."""
    x = -1.0 + 0.25 * np.arange(int(4 * (length + 1)) + 1)
    kind = np.searchsorted(ends, x) % 2
    weight = np.repeat(np.stack([kind == 0, kind == 1])[:, None].astype(float), 9, axis=1)
    return Ground.heights(np.zeros(weight.shape[1:]), 0.25, -1.0, -1.0, weight)


def pressed(gait, loads, ground, soils=(MUD, ROAD), until=None, **options):
    sim = Simulation(ground, soils, CELL, options=SimulationOptions(**options))
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1 if until is None else until)
    return sim


def litres(grid):
    return 1e3 * float(grid.astype(float).sum()) * CELL * CELL


def closes(sim, name="mud"):
    told, carried = sim.report(), sim.carried()
    own = carried[name]
    assert own["taken_m3"] == pytest.approx(own["carried_m3"] + own["left_m3"], rel=1e-6)
    moved = sum(each["carried_m3"] + each["left_m3"] for each in carried.values())
    laid = told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"]
    assert told["heaped_m3"] + moved == pytest.approx(laid, rel=1e-6)
    return own


@pytest.fixture(scope="module")
def trodden():
    gait, loads = walk(7.5)
    sim = pressed(gait, loads, road())
    sim.settle()
    return sim


def test_nothing_is_lost(trodden):
    own = closes(trodden)
    assert own["left_m3"] > 5e-5 and own["carried_m3"] > 1e-5
    coat = trodden.read("carried_mud", (-1, -1, 8, 1))
    assert litres(coat) == pytest.approx(1e3 * own["left_m3"], rel=1e-6)
    assert not coat[:, :190].any()  # on mud nothing is left
    i0, i1, _, _ = trodden.cells((2, -1, 7, 1))
    shown = trodden.read("height_change", i0, -100, i1 - i0, 200)
    stacked = sum(s * trodden.read(n, i0, -100, i1 - i0, 200) for n, s in (("heap", 1), ("compression", -1)))
    np.testing.assert_allclose(shown, stacked + trodden.read("carried_mud", i0, -100, i1 - i0, 200), atol=1e-9)


def test_deposits_along_a_road_fall_geometrically(trodden):
    """Steps of one foot are 1 m apart; each leaves the same share of what it still carries."""
    left = np.array([litres(trodden.read("carried_mud", (x - 0.25, 0.0, x + 0.75, 1))) for x in (2, 3, 4, 5, 6)])
    ratio = left[1:] / left[:-1]
    assert (ratio < 0.95).all() and (ratio > 0.6).all()
    assert np.ptp(ratio) < 0.05


def test_what_is_seen_sums_to_one(trodden):
    box = (-1, -1, 8, 1)
    mud, hard = trodden.read("surface_mud", box), trodden.read("surface_soil", box)
    np.testing.assert_allclose(mud + hard, 1.0, atol=1e-6)
    coat = trodden.read("carried_mud", box)
    assert (mud[:, :190] == 1.0).all() and 0.0 < mud[:, 230:].max() <= 1.0
    np.testing.assert_allclose(mud[:, 230:], np.minimum(coat[:, 230:] / 0.002, 1.0), atol=1e-6)


def test_a_sole_that_trod_half_into_mud_leaves_half_a_print():
    """Mud lies before x = 1, beside the middle line of the foot at y = -0.09."""
    x, y = np.array([-1.0, 1.0, 1.001, 6.0]), np.array([-1.0, -0.091, -0.09, 1.0])
    at = np.array([(u, v, 0.0) for v in y for u in x])
    corner = np.array([4 * j + i for j in range(3) for i in range(3)])
    faces = np.concatenate([corner[:, None] + (0, 1, 5), corner[:, None] + (0, 5, 4)])
    soft = np.array([float(i < 2 and j < 2) for j in range(4) for i in range(4)])
    sim = pressed(*walk(4.0), Ground.mesh(at, faces, np.stack([soft, 1.0 - soft])), (MUD, SOILS["mud"]))
    coat = sim.read("carried_mud", (1.5, -0.3, 4.0, 0.3))
    assert litres(coat[:21]) > 0.005 and litres(coat[23:]) < 1e-6


@pytest.mark.parametrize("threads", (2, 5))
def test_workers_do_not_change_a_bit(trodden, threads):
    gait, loads = walk(7.5)
    sim = pressed(gait, loads, road(), threads=threads)
    sim.settle()
    for name in ("carried_mud", "compression", "heap", "surface_mud"):
        assert np.array_equal(sim.read(name, (-1, -1, 8, 1)), trodden.read(name, (-1, -1, 8, 1))), name
    assert sim.carried() == trodden.carried()


def test_a_walk_goes_on_from_its_state():
    gait, loads = walk(4.5)
    whole = pressed(gait, loads, road())
    half = pressed(gait, loads, road(), until=130)  # in mid-step
    again = Simulation(road(), (MUD, ROAD), CELL)
    again.load(gait, loads)
    again.restore(half.state())
    assert again.carried() == half.carried() and half.carried()["mud"]["carried_m3"] > 0.0
    again.run(len(gait.time) - 1)
    assert np.array_equal(again.read("carried_mud", (-1, -1, 8, 1)), whole.read("carried_mud", (-1, -1, 8, 1)))
    assert again.carried() == whole.carried()
    with pytest.raises(DesirePathError):
        other = Simulation(road(), (SOILS["mud"], ROAD), CELL)
        other.load(gait, loads)
        other.restore(half.state())


def test_a_mirrored_walk_leaves_mirrored_coats():
    gait, loads = walk(3.0, turn=0.2)
    flip, soils = np.array([1.0, -1.0, 1.0]), (replace(MUD, roughness=0.0), ROAD)
    soles = [Sole(each.vertices * flip, each.triangles[:, ::-1]) for each in gait.soles]
    pose = gait.pose * np.r_[flip, [1.0, -1.0, 1.0, -1.0]]
    mirrored = replace(gait, pose=pose, com=gait.com * flip, soles=soles)
    turned = SimpleNamespace(**{**vars(loads), "force": loads.force * flip, "point": loads.point * flip})
    here = pressed(gait, loads, road(), soils).read("carried_soil", -100, -100, 500, 200)
    there = pressed(mirrored, turned, road(), soils).read("carried_soil", -100, -100, 500, 200)
    assert here.max() > 1e-4
    assert np.array_equal(there, here[::-1])


def rolled(tread, end, mass=150.0, law="sole"):
    """Coats on the road from x = 1.3 on, of a wheel that has rolled out of mud."""
    gait = replace(track.rolled([(-0.5, 0.0), (end, 0.0)], Wheel(radius=0.3, tread=tread)), contact_law=(law,))
    low = gait.pose[..., :3] * (1.0, 1.0, 0.0) - (0.0, 0.0, 0.01 if law == "carve" else 0.0)
    if law == "carve":
        gait = replace(gait, pose=gait.pose - np.r_[0.0, 0.0, 0.01, np.zeros(4)])
    force = np.zeros_like(low) - (0.0, 0.0, 9.81 * mass)
    loads = SimpleNamespace(touching=np.ones(low.shape[:2], "u1"), force=force, point=low, warnings=(), held=None)
    sim = pressed(gait, loads, road(length=9.0))
    sim.settle()
    closes(sim)
    return sim.read("carried_mud", (1.3, -0.11, end - 0.2, 0.11))


@pytest.mark.parametrize("law", ("sole", "carve"))
def test_a_wheel_leaves_its_tread(law):
    blocks, plain = rolled("blocks", 2.4, law=law), rolled("plain", 2.4, law=law)
    inside = (plain > 1e-6)[2:-2].mean()
    assert inside > 0.9 if law == "carve" else inside > 0.5
    assert (blocks > 1e-6).mean() < (0.9 if law == "carve" else 0.4)


def test_a_wheel_fades_turn_by_turn():
    coat, turn = rolled("plain", 5.3), round(200 * np.pi * 0.3)
    first, second = (litres(coat[:, n * turn : (n + 1) * turn]) for n in range(2))
    assert second < 0.8 * first and first > 0.05


def test_stamps_carry_too():
    laid = lay([(-0.6, 0.0), (5.0, 0.0)], "boot")
    press = TrackPress(road(), laid, (MUD, ROAD), CELL)
    press.press()
    left = [litres(press.sim.read("carried_mud", (x, -0.5, x + 1.4, 0.5))) for x in (1.2, 2.6, 4.0)]
    assert left[0] > left[1] > left[2] > 0.0


def test_a_bake_has_the_maps_and_says_what_is_carried(tmp_path):
    gait, _ = walk(2.4)
    bake = Bake(gait, road(), (MUD, ROAD), tmp_path / "bake", cell_size=0.02, options=BakeOptions(threads=1))
    for _ in bake.run():
        pass
    planes = maps.read(tmp_path / "bake" / "maps_final.exr").planes
    assert {"surface_mud", "surface_soil", "carried_mud"} <= set(planes)
    assert planes["carried_mud"].max() > 0.0
    report = bake.report
    laid = report["displaced_m3"] + report["loosened_m3"] - report["pressed_heap_m3"]
    assert report["left_m3"] > 0.0
    assert report["heaped_m3"] + report["left_m3"] + report["carried_m3"] == pytest.approx(laid, rel=1e-6)


def test_soils_are_called_once():
    assert materials.names([SOILS["mud"], MUD, ROAD, replace(ROAD, adhesion=0.1 / 4)]) == (
        "mud",
        "mud_2",
        "soil",
        "soil_2",
    )
    plain, stick = (layers.lain(("flat", 0.0), soils, ()) for soils in ([SOILS["mud"], ROAD], [MUD, ROAD]))
    assert not materials.fields(plain) and "carried_mud" in materials.fields(stick)
    with pytest.raises(DesirePathError, match="More than 16 soils here stick"):
        Simulation(Ground.flat(), [replace(MUD, young_modulus=4e5 + k) for k in range(17)])
