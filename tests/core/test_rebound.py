"""Ground that comes back when a sole lifts, and ground that bulges: MODEL 6.3, 6.9, 11.17"""

import math
from dataclasses import replace

import numpy as np
import pytest

from desire_path import _native
from desire_path.ground import trail
from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import SOILS, Soil
from desire_path.loads import walker
from tests.core.test_jumps import recorded
from tests.core.test_soil_twins import Both, foot_of
from tests.reference import soil as twin
from tests.reference import soil_heaps as heaps
from tests.scenes import gaits
from tests.scenes.records import for_simulation

G = 9.81
FOOT = gaits.box(0.25, 0.11)
CLAY = Soil(young_modulus=0.5e6, poisson_ratio=0.3, settle_time=0.02, rest_angle=math.radians(80))
SPRINGY = replace(CLAY, rebound=0.1)
WINDOW = (-60, -60, 120, 120)
NAMES = ("compression", "heap")


def stand(sim, mass=75.0, at=(0.0, 0.0), until=None):
    gait, loads = gaits.pressed([FOOT], [[*at, 0, 1, 0, 0, 0]], [[0, 0, -mass * G]], mass=mass)
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1 if until is None else until)
    return {name: sim.read(name, *WINDOW) for name in NAMES}


def of(soil, **more):
    return Simulation(Ground.flat(), soil, 0.01, **for_simulation(**more))


def test_a_share_of_the_depth_comes_back_when_the_sole_lifts():
    plain = stand(of(CLAY))
    sim = of(SPRINGY)
    under = stand(sim, until=60)  # it still stands: nothing has come back
    np.testing.assert_allclose(under["compression"], plain["compression"], atol=1e-7)
    sim.run(83)
    after = {name: sim.read(name, *WINDOW) for name in NAMES}
    np.testing.assert_allclose(after["compression"], 0.9 * plain["compression"], atol=1e-7)
    np.testing.assert_allclose(after["heap"], plain["heap"], atol=1e-7)
    report = sim.report()
    assert report["rebounded_m3"] == pytest.approx(0.1 * report["pressed_m3"], rel=1e-5)
    pressed = after["compression"].sum(dtype=float) * 1e-4
    assert pressed == pytest.approx(report["pressed_m3"] - report["rebounded_m3"], rel=1e-6)


def test_the_same_load_again_presses_and_displaces_nothing_anew():
    sim = of(SPRINGY)
    once = stand(sim)
    pressed = sim.report()["pressed_m3"]
    for _ in range(3):
        again = stand(sim)
        for name in NAMES:
            np.testing.assert_allclose(again[name], once[name], atol=2e-6)
    assert sim.report()["pressed_m3"] == pytest.approx(pressed, rel=1e-4)
    heavy = stand(sim, 150.0)
    np.testing.assert_allclose(heavy["compression"], stand(of(SPRINGY), 150.0)["compression"], atol=2e-5)


def test_a_light_step_on_a_print_lifts_nothing():
    sim = of(SPRINGY)
    once = stand(sim)
    light = stand(sim, 20.0)
    assert np.array_equal(light["compression"], once["compression"])


def test_what_another_foot_stands_on_does_not_come_back():
    """Two feet side by side; one lifts, while the other stands on."""
    gait, loads = gaits.pressed([FOOT, FOOT], [[0, y, 0, 1, 0, 0, 0] for y in (0.08, -0.08)], [[0, 0, -400]] * 2)
    gait = gaits.writable(gait)
    count = len(gait.time)
    gait.pose[1, :, 2] = gait.pose[1, 0, 2]
    touching, force = np.array(loads.touching), np.array(loads.force)
    touching[1], force[1] = 1, [0, 0, -400]
    touching[0, count // 2 :], force[0, count // 2 :] = 0, 0
    sim = of(SPRINGY)
    loads.touching, loads.force = touching, force
    sim.load(gait, loads)
    sim.run(count // 2 - 2)
    before = sim.read("compression", *WINDOW)
    sim.run(count - 1)
    after = sim.read("compression", *WINDOW)
    assert np.array_equal(before[:60], after[:60])  # under the one that stands
    np.testing.assert_allclose(after[60:], 0.9 * before[60:], atol=1e-6)
    sim.settle()
    np.testing.assert_allclose(sim.read("compression", *WINDOW), 0.9 * before, atol=1e-6)


@pytest.mark.parametrize("threads", [2, 5])
def test_threads_and_states_do_not_matter(threads, tmp_path):
    rough = replace(SPRINGY, roughness=0.5, wall_angle=math.radians(60), heave=0.02)
    one = of(rough, threads=1)
    want = stand(one)
    many = of(rough, threads=threads)
    stand(many, until=40)
    many.save_state(tmp_path / "state")
    again = of(rough, threads=1)
    gait, loads = gaits.pressed([FOOT], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -75 * G]])
    again.load(gait, loads)
    again.load_state(tmp_path / "state")
    again.run(len(gait.time) - 1)
    many.run(len(gait.time) - 1)
    for sim in (many, again):
        assert all(np.array_equal(sim.read(name, *WINDOW), want[name]) for name in NAMES)
        assert sim.report() == one.report()


@pytest.mark.parametrize("seed", range(3))
def test_columns_come_back_as_their_twins(seed):
    both = Both(seed, loose=0.0, holes=False)
    both.native["compression"][:] = 0
    both.native["kind"][:] = 0
    both.native["rest"][:] = 0
    share = both.native["soils"][0]["rebound"] = 0.15
    uneven = (0.2 * both.random.standard_normal(both.shape)).astype(np.float32)
    spring = np.zeros(both.shape, np.float32)
    walls = np.full(both.shape, np.inf, np.float32)
    patch = (*both.patch(), walls, uneven, spring)
    columns = [[Springy(min(max(share * (1 + 1.6 * float(u)), 0), 0.9)) for u in row] for row in uneven]
    bottom, cover = both.sole()
    cover[:] = cover > 0.5
    anew = again = back = 0.0
    for load in (300.0, 900.0, 200.0, 900.0, 1200.0):
        ring = np.zeros(both.shape, np.int32)
        before = both.native["compression"].astype(float)
        pressed = _native.soil_compress(patch, (bottom, cover, ring), foot_of(load), 0, 5.0)
        now = both.native["compression"].astype(float)
        parts = np.array([[c.press(to) for c, to in zip(*rows)] for rows in zip(columns, now)])
        assert (now >= before - 1e-9).all()
        assert pressed["firm"] == pytest.approx(parts[..., 0].sum() * both.cell**2, abs=1e-9)
        assert pressed["elastic"] == pytest.approx(parts[..., 1].sum() * both.cell**2, abs=1e-9)
        assert pressed["displaced"] == pytest.approx(0.7 * pressed["firm"], rel=1e-5, abs=1e-12)
        assert _native.soil_rebound(patch, (bottom, cover, np.zeros_like(ring))) == 0  # it stands there
        got = _native.soil_rebound(patch, None)
        want = np.array([[c.lift() for c in row] for row in columns])
        assert got == pytest.approx(want.sum() * both.cell**2, abs=1e-9)
        np.testing.assert_allclose(both.native["compression"], now - want, atol=1e-8)
        anew, again, back = anew + pressed["firm"], again + pressed["elastic"], back + got
    assert anew > 0 and again > 0 and back > again


Springy = twin.Springy


def test_what_fell_from_a_wall_does_not_come_back():
    """Ground that was pressed 20 mm, and of which 10 mm fell while the sole stood there: 15 % of 20 mm come back."""
    both = Both(0, loose=0.0, holes=False)
    for name in ("kind", "rest", "heap"):
        both.native[name][:] = 0
    both.native["soils"][0]["rebound"] = 0.15
    spring = np.full(both.shape, -0.02, np.float32)
    fields = np.full(both.shape, np.inf, np.float32), np.zeros(both.shape, np.float32), spring
    for c, stays in ((0.02, 0.017), (0.03, 0.027), (0.018, 0.017), (0.012, 0.012)):
        spring[:] = -0.02
        both.native["compression"][:] = c
        back = _native.soil_rebound((*both.patch(), *fields), None)
        np.testing.assert_allclose(both.native["compression"], stays, atol=1e-8)
        assert back == pytest.approx((c - stays) * both.cell**2 * both.native["compression"].size, rel=1e-6, abs=1e-12)
        np.testing.assert_allclose(spring, max(0.02 - stays, 0.0), atol=1e-8)


def test_what_falls_from_a_wall_takes_of_what_came_back():
    """A wall of 50 mm, of which 8 mm had come back: what falls is no more there to be pressed again."""
    both = Both(0, loose=0.0, holes=False)
    for name in ("kind", "rest", "heap"):
        both.native[name][:] = 0
    compression = both.native["compression"]
    compression[:] = 0.012
    compression[:, compression.shape[1] // 2 :] = 0.062
    spring = np.full(both.shape, 0.008, np.float32)
    before = compression.astype(float)
    fields = np.full(both.shape, 1.0, np.float32), np.zeros(both.shape, np.float32), spring  # walls stand at 45 degrees
    _native.soil_stabilize((*both.patch(), *fields), None, None, 1e-3, 1000)
    fell = compression - before
    assert fell.max() > 0.002 and (fell > 0).any() and (fell == 0).any()
    np.testing.assert_allclose(spring, np.maximum(0.008 - fell, 0.0), atol=1e-8)


@pytest.mark.parametrize("soil", ("wet-sand", "fresh-snow"))
def test_where_walls_fall_nothing_comes_back_that_was_not_pressed(soil):
    """Feet that roll tread on what fell beside them: all of it is new, and displaces."""
    walk = recorded("cmu_12_01_walk", fps=30)
    pressed = {}
    for cell in (0.02, 0.01):
        sim = Simulation(Ground.flat(), SOILS[soil], cell)
        sim.load(walk, walker.loads(walk))
        for sample in range(len(walk.time)):
            sim.run(sample)
            report = sim.report()
            assert 0.0 <= report["rebounded_m3"] <= 1.5 * SOILS[soil].rebound * report["pressed_m3"]
        sim.settle()
        report = sim.report()
        assert report["loosened_m3"] > 0.05 * report["pressed_m3"]
        assert report["rebounded_m3"] > 0.5 * SOILS[soil].rebound * report["pressed_m3"]
        whole = sim.read("compression", sim.box(sim.reach())).sum(dtype=float) * cell**2
        firm = report["pressed_m3"] + report["loosened_m3"] - report["rebounded_m3"]
        assert whole == pytest.approx(firm, rel=1e-5)
        pressed[cell] = report["pressed_m3"]
    assert pressed[0.01] == pytest.approx(pressed[0.02], rel=0.03)


def test_a_trail_that_is_laid_comes_back_as_one_that_was_pressed():
    """Who goes on from maps has no record of what came back: it is as if one sole had left all of it."""
    sim = of(SPRINGY)
    once = stand(sim)
    left = {name: once[name] for name in NAMES} | {"pressure_time": np.zeros_like(once["heap"])}
    again = of(SPRINGY)
    again._core.lay(WINDOW[0], WINDOW[1], *(left[name] for name in trail.LEFT))
    stand(again)
    assert again.report()["pressed_m3"] < 1e-3 * sim.report()["pressed_m3"]
    np.testing.assert_allclose(again.read("compression", *WINDOW), once["compression"], atol=2e-6)


# ---- bulges ------------------------------------------------------------------------------------


@pytest.mark.parametrize("push", ((0, 0), (60, -25)))
@pytest.mark.parametrize("seed", range(3))
def test_a_bulge_is_that_of_its_twin(seed, push):
    both = Both(seed, holes=seed == 2)
    for soil in both.native["soils"]:
        soil["heave"] = 0.03
    uneven = (0.3 * both.random.standard_normal(both.shape)).astype(np.float32)
    patch = (*both.patch(), np.full(both.shape, np.inf, np.float32), uneven)
    bottom, cover = both.sole()
    ring = heaps.rings(cover > 0, 1).astype(np.int32)
    foot = foot_of(700.0, push)
    for volume in (1e-5, 3e-4):
        _native.soil_accumulate(patch, (bottom, cover, ring), foot, volume, 0, 0.05, 200.0, 0.0)
        heaps.accumulate_bulge(both.twin, ring, cover, foot, volume, 0.03, 200.0, uneven.astype(float))
    np.testing.assert_allclose(both.native["heap"], both.twin["heap"], rtol=2e-3, atol=2e-7)


@pytest.mark.parametrize("width", [0.02, 0.03])
def test_a_bulge_falls_off_as_said_and_holds_the_volume(width):
    """Beside the middle of a long sole; so flat that nothing slides."""
    soil = replace(CLAY, heave=width)
    sim = Simulation(Ground.flat(), soil, 0.004)
    gait, loads = gaits.pressed([gaits.box(1.2, 0.2)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -2000]])
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    heap = sim.read("heap", -300, -100, 600, 200).astype(float)
    across = heap[125:155, 300]  # from the edge on, cell middles at e = 2, 6 .. mm
    e = (np.arange(30) + 0.5) * 0.004
    want = np.exp(-((e / width) ** 1.4))
    inside = want > 0.02
    np.testing.assert_allclose(across[inside] / across[0], want[inside] / want[0], rtol=0.02, atol=2e-3)
    report = sim.report()
    assert heap.sum() * 0.004**2 == pytest.approx(report["displaced_m3"] - report["pressed_heap_m3"], rel=1e-6)


def test_a_bulge_is_mirrored_and_does_not_depend_on_the_cell():
    soil = replace(CLAY, heave=0.03)
    maps = stand(of(soil))
    assert np.array_equal(maps["heap"], maps["heap"][::-1]) and np.array_equal(maps["heap"], maps["heap"][:, ::-1])
    fine = Simulation(Ground.flat(), soil, 0.005)
    gait, loads = gaits.pressed([FOOT], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -75 * G]])
    fine.load(gait, loads)
    fine.run(len(gait.time) - 1)
    heap = fine.read("heap", -120, -120, 240, 240)
    assert heap.sum(dtype=float) / 4 == pytest.approx(maps["heap"].sum(dtype=float), rel=0.03)
    assert heap.max() == pytest.approx(maps["heap"].max(), rel=0.1)
