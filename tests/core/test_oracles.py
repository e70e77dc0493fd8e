"""What must hold of the ground whoever walks on it: MODEL 11.1-11.7, 11.11"""

import math
from dataclasses import replace

import numpy as np
import pytest

from desire_path.ground.options import SimulationOptions
from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import SOILS, Soil
from desire_path.loads import walker
from desire_path.study import bodies
from tests.scenes import gaits, slopes
from tests.scenes.plain import plain

G = 9.81
FIRM = Soil(layer_depth=0.3, young_modulus=0.35e6, poisson_ratio=0.35, settle_time=0.15, rest_angle=math.radians(20))


def press(soles, poses, forces, *, soil=FIRM, cell=0.01, law="sole", heap="rest", threads=1, **more):
    """The ground after standing and lifting off, and the report; a window of 4 m about the origin."""
    sim = Simulation(Ground.flat(), soil, cell, options=SimulationOptions(law=law, heap=heap, threads=threads))
    gait, loads = gaits.pressed(soles, poses, forces, **more)
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    half = int(round(2 / cell))
    window = (-half, -half, 2 * half, 2 * half)
    maps = {name: sim.read(name, *window) for name in ("compression", "heap", "pressure_time")}
    return maps, sim.report()


AT_ORIGIN = [0, 0, 0, 1, 0, 0, 0]
FOOT = gaits.box(0.25, 0.11)  # 0.0275 m^2


def ledger(report, nu):
    laid = 2 * nu * (report["pressed_m3"] + report["pressed_heap_m3"])
    return laid + report["loosened_m3"] - report["pressed_heap_m3"]  # what slides has cut some


@pytest.mark.parametrize("law", ["sole", "uniform"])
def test_single_support_at_rest_sinks_by_stress_over_stiffness(law):
    maps, report = press([FOOT], [AT_ORIGIN], [[0, 0, -75 * G]], law=law)
    want = 75 * G * 0.3 / (0.35e6 * 0.0275)
    assert want == pytest.approx(0.0229, abs=1e-4)
    assert report["deepest_m"] == pytest.approx(want, rel=0.01)


def rolled(soil, mass, law, heap):
    """The report of one foot that rolls from heel to toe under its whole weight."""
    gait, loads = gaits.pressed([FOOT], [AT_ORIGIN], [[0, 0, -mass * G]], mass=mass)
    tilt = np.linspace(0.15, -0.15, len(gait.time)) / 2
    gait = gaits.writable(gait)
    gait.pose[0, :, 2] += 0.125 * np.abs(np.sin(2 * tilt))
    gait.pose[0, :, 3], gait.pose[0, :, 5] = np.cos(tilt), np.sin(tilt)
    sim = Simulation(Ground.flat(), soil, 0.01, options=SimulationOptions(law=law, heap=heap))
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    return sim.report()


@pytest.mark.parametrize("heap", ["rest", "paper"])
@pytest.mark.parametrize("law", ["sole", "uniform"])
def test_firmer_ground_and_lighter_bodies_leave_less_down_to_nothing(law, heap):
    firm = [
        rolled(replace(FIRM, young_modulus=e), 75.0, law, heap)["pressed_m3"]
        for e in (0.3e6, 3e6, 30e6, 300e6, 3e9, 1e12)
    ]
    light = [rolled(FIRM, m, law, heap)["pressed_m3"] for m in (75.0, 7.5, 0.75, 0.075, 0.0075, 7.5e-6, 1e-300)]
    for volume in (firm, light):
        assert all(more > less for more, less in zip(volume, volume[1:]))
    assert firm[-1] < 1e-4 * firm[0] and light[-1] < 1e-9 * light[0]


@pytest.mark.parametrize("law", ["sole", "uniform"])
def test_two_feet_share_the_depth(law):
    places = [[0, 0.3, 0, 1, 0, 0, 0], [0, -0.3, 0, 1, 0, 0, 0]]
    one, _ = press([FOOT], [AT_ORIGIN], [[0, 0, -75 * G]], law=law)
    two, _ = press([FOOT, FOOT], places, [[0, 0, -37.5 * G]] * 2, law=law)
    assert two["compression"].max() == pytest.approx(one["compression"].max() / 2, rel=0.01)


@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_depth_is_proportional_to_load_and_layer_and_softness(factor):
    _, base = press([FOOT], [AT_ORIGIN], [[0, 0, -40 * G]])
    for soil, load in [
        (FIRM, 40 * factor),
        (replace(FIRM, layer_depth=0.3 * factor), 40),
        (replace(FIRM, young_modulus=0.35e6 / factor), 40),
    ]:
        _, other = press([FOOT], [AT_ORIGIN], [[0, 0, -load * G]], soil=soil)
        assert other["deepest_m"] == pytest.approx(factor * base["deepest_m"], rel=0.01)


def test_half_the_area_is_twice_as_deep():
    _, whole = press([gaits.box(0.24, 0.1)], [AT_ORIGIN], [[0, 0, -50 * G]])
    _, half = press([gaits.box(0.12, 0.1)], [AT_ORIGIN], [[0, 0, -50 * G]])
    assert half["deepest_m"] == pytest.approx(2 * whole["deepest_m"], rel=0.01)


def test_the_print_does_not_depend_on_the_rate():
    deep = [press([FOOT], [AT_ORIGIN], [[0, 0, -75 * G]], rate=rate)[1] for rate in (24.0, 60.0, 240.0)]
    for report in deep[1:]:
        assert report["deepest_m"] == pytest.approx(deep[0]["deepest_m"], rel=0.01)
        assert report["heaped_m3"] == pytest.approx(deep[0]["heaped_m3"], rel=0.01)


@pytest.mark.parametrize("heap", ["rest", "paper"])
@pytest.mark.parametrize("name", ["dry-sand", "snow", "mud"])
def test_the_ledger_balances_after_crossing_prints(heap, name):
    soil = SOILS[name]
    sim = Simulation(Ground.flat(), soil, 0.01, options=SimulationOptions(heap=heap))
    for k in range(6):
        turned = gaits.turn_z(0.7 * k)
        gait, loads = gaits.pressed(
            [FOOT], [[0.05 * k, 0.03 * (k % 3), 0, *turned]], [[60 * (k % 2), 40, -700]], seconds=0.4
        )
        sim.load(gait, loads)
        sim.run(len(gait.time) - 1)
        report = sim.report()
        assert report["heaped_m3"] == pytest.approx(ledger(report, soil.poisson_ratio), rel=1e-6)
    assert report["pressed_heap_m3"] > 0


def test_a_first_print_heaps_two_nu_of_its_volume():
    _, report = press([FOOT], [AT_ORIGIN], [[0, 0, -75 * G]])
    assert report["heaped_m3"] == pytest.approx(2 * 0.35 * report["pressed_m3"], rel=1e-6)


def test_a_mirrored_foot_leaves_a_mirrored_print():
    tilted = np.array([0.05, 0.02, 0, math.cos(0.1), 0.04, 0.03, math.sin(0.1)])
    tilted[3:] /= np.linalg.norm(tilted[3:])
    mirrored = tilted * [1, -1, 1, 1, -1, 1, -1]  # across the plane y = 0
    left, _ = press([FOOT], [tilted], [[50, 80, -600]])
    right, _ = press([FOOT], [mirrored], [[50, -80, -600]])
    assert left["heap"].max() > 0.002
    for name in ("compression", "heap"):
        assert np.abs(left[name] - right[name][::-1]).max() < 1e-5


def test_a_turned_scene_leaves_the_same_print_turned():
    base, _ = press([FOOT], [AT_ORIGIN], [[90, 20, -600]])
    quarter, _ = press([FOOT], [[0, 0, 0, *gaits.turn_z(math.pi / 2)]], [[-20, 90, -600]])
    for name in ("compression", "heap"):
        assert (
            np.abs(np.rot90(base[name], -1) - quarter[name]).max() < 1e-5
            or np.abs(np.rot90(base[name], 1) - quarter[name]).max() < 1e-5
        )


def test_every_loose_slope_rests():
    for name in ("dry-sand", "mud", "soft-soil"):
        soil = plain(name)
        maps, _ = press([FOOT], [AT_ORIGIN], [[120, 0, -900]], soil=soil)
        heap, surface = maps["heap"], maps["heap"] - maps["compression"]
        assert heap.max() > 0.001
        assert slopes.excess(surface, heap, 0.01, soil.rest_angle) < 1e-5, name
        assert slopes.excess(surface, heap, 0.01, soil.rest_angle / 1.5) > 0.01  # it would be seen


def test_threads_do_not_matter():
    places = [[0.5 * k - 1, 0.4 * (k % 3), 0, *gaits.turn_z(0.3 * k)] for k in range(6)]
    runs = [press([FOOT] * 6, places, [[30, 0, -500]] * 6, threads=threads)[0] for threads in (1, 2, 4)]
    for name in ("compression", "heap", "pressure_time"):
        assert runs[0][name].tobytes() == runs[1][name].tobytes() == runs[2][name].tobytes()


@pytest.mark.parametrize("turn", [0.0, 0.2, 0.4, 0.6, math.pi / 4])
def test_volume_and_rim_do_not_depend_on_the_cell(turn):
    """A wide stamp in mud, so that its rim is several of the coarsest cells wide."""
    mud = SOILS["mud"]
    stamp, load = gaits.box(0.8, 0.6), mud.young_modulus * 0.48 * 0.12 / mud.layer_depth
    place = [0.013, 0.021, 0, *gaits.turn_z(turn)]
    runs = {cell: press([stamp], [place], [[0, 0, -load]], soil=mud, cell=cell) for cell in (0.04, 0.02, 0.01)}
    fine_maps, fine = runs[0.01]
    assert fine_maps["heap"].max() > 0.05
    for cell in (0.04, 0.02):
        maps, report = runs[cell]
        assert report["pressed_m3"] == pytest.approx(fine["pressed_m3"], rel=0.03)
        assert maps["heap"].max() == pytest.approx(fine_maps["heap"].max(), rel=0.10)


@pytest.mark.parametrize("turn", [0.0, 0.3])
@pytest.mark.parametrize("name", ["dry-sand", "wet-sand", "mud", "fresh-snow"])
def test_the_volume_under_a_standing_foot_does_not_depend_on_the_cell(name, turn):
    """What it presses, and the hole it leaves once its walls have slid: cells from a third of its width to a 22nd."""
    pressed, hole = [], []
    for cell in (0.04, 0.02, 0.01, 0.005):
        place = [0.013, 0.021, 0, *gaits.turn_z(turn)]
        maps, report = press([FOOT], [place], [[0, 0, -75 * G]], soil=SOILS[name], cell=cell)
        pressed.append(report["pressed_m3"])
        hole.append(maps["compression"].sum(dtype=float) * cell * cell)
    np.testing.assert_allclose(pressed, pressed[-1], rtol=0.001)
    np.testing.assert_allclose(hole, hole[-1], rtol=0.03)


def rim(cell, *, sole=FOOT, load=75 * G, soil=FIRM, width=0.04, turn=0.0):
    """The height of a `paper` rim while the foot still stands [m], and how far it reaches beyond the sole [m]."""
    sim = Simulation(Ground.flat(), soil, cell, options=SimulationOptions(heap="paper", rim_width=width))
    gait, loads = gaits.pressed([sole], [[0.013, 0.021, 0, *gaits.turn_z(turn)]], [[0, 0, -load]])
    sim.load(gait, loads)
    sim.run(len(gait.time) - 20)
    half = int(round(0.8 / cell))
    heap = sim.read("heap", -half, -half, 2 * half, 2 * half)
    along = (np.flatnonzero(heap[half] > 0.05 * heap.max()) + 0.5 - half) * cell
    return float(heap.max()), along.max() - 0.013 - np.ptp(sole.vertices[:, 0]) / 2


@pytest.mark.parametrize("turn", [0.0, 0.4, 1.1])
def test_a_paper_rim_does_not_depend_on_the_cell(turn):
    heights = [rim(cell, turn=turn)[0] for cell in (0.04, 0.02, 0.01, 0.005)]
    assert max(heights) < 1.1 * min(heights)


def test_a_paper_rim_is_as_wide_as_it_is_told_in_metres():
    steep = replace(FIRM, rest_angle=math.radians(60))
    for width in (0.02, 0.04, 0.08, 0.15):
        for cell in (0.01, 0.005):
            height, reach = rim(cell, soil=steep, width=width)
            assert reach == pytest.approx(width, abs=0.005 + cell)
    assert rim(0.01, soil=steep, width=0.02)[0] > 2.5 * rim(0.01, soil=steep, width=0.08)[0]


def test_a_paper_rim_too_high_for_its_width_slides_out_to_rest_while_the_foot_stands():
    mud = replace(plain("mud"), poisson_ratio=0.45)
    height, reach = rim(0.01, sole=gaits.box(0.5, 0.4), load=8000, soil=mud)
    assert reach > 2 * 0.04
    assert height == pytest.approx(reach * math.tan(mud.rest_angle), rel=0.15)


def test_a_foot_half_over_an_edge_digs_no_deeper_than_a_whole_one():
    """A ledge along y = 0: of a foot that crosses it, and of one whose toe hangs over it."""
    ledge = Ground.mesh([[-2, 0, 0], [2, 0, 0], [2, 2, 0], [-2, 2, 0]], [[0, 1, 2], [0, 2, 3]])
    gait, loads = gaits.pressed([FOOT], [AT_ORIGIN], [[0, 0, -75 * G]])
    tip = gait.pose.copy()
    tip[0, :, 3:] = [math.cos(0.06), math.sin(0.06), 0, 0]  # the side over the edge hangs down
    tip[0, :, 3], tip[0, :, 4] = math.cos(-0.06), math.sin(-0.06)
    for pose in (gait.pose, tip, tip * [1, 1, 1, 1, -1, 1, 1]):
        for law in ("sole", "uniform"):
            found = []
            for ground in (Ground.flat(), ledge):
                sim = Simulation(ground, FIRM, 0.01, options=SimulationOptions(law=law))
                sim.load(replace(gait, pose=pose), loads)
                sim.run(len(gait.time) - 1)
                found.append(sim.read("compression", -50, 1, 100, 50))
            whole, half = found
            assert half.max() <= whole.max() + 1e-4
            assert half.sum() == pytest.approx(whole.sum(), rel=0.02, abs=0.01)


def test_a_print_of_millimetres_is_that_of_a_foot_at_its_scale():
    found = []
    for scale in (1.0, 0.01):
        foot, at = gaits.box(0.25 * scale, 0.11 * scale, 0.02 * scale), [0.003 * scale, 0.002 * scale, *AT_ORIGIN[2:]]
        gait, loads = gaits.pressed([foot], [at], [[0, 0, -75 * G * scale**3]], mass=75 * scale**3, rate=60)
        sim = Simulation(Ground.flat(), FIRM, 0.02 * scale)  # cells of 2 cm, and of 0.2 mm
        sim.load(gait, loads)
        sim.run(len(gait.time) - 1)
        report = sim.report()
        found.append([report[name] / scale**3 for name in ("pressed_m3", "heaped_m3")] + [report["deepest_m"] / scale])
    assert found[1][:2] == pytest.approx(found[0][:2], rel=1e-3)
    assert found[1][2] == pytest.approx(found[0][2], rel=0.1)  # rims of soles are sampled otherwise


def test_a_load_beside_an_edge_meets_the_soil_of_the_ground_it_is_nearest_to():
    corner, faces = [[-2, 0, 0], [2, 0, 0], [2, 2, 0], [-2, 2, 0]], [[0, 1, 2], [0, 2, 3]]
    slips = replace(FIRM, shear_modulus=0.03, push_threshold=200.0)
    gait, loads = gaits.pressed([FOOT], [[0, -0.02, 0, 1, 0, 0, 0]], [[150, 0, -75 * G]])
    found = []
    for soils, weights in (([slips], None), ([FIRM, slips], [[0] * 4, [1] * 4])):
        sim = Simulation(Ground.mesh(corner, faces, weights), soils, 0.01)
        sim.load(gait, loads)
        sim.run(len(gait.time) - 1)
        found.append([sim.read(name, -50, 0, 100, 50) for name in ("compression", "heap")])
    assert found[0][0].max() > 0.01
    assert all((alone == of_two).all() for alone, of_two in zip(*found))


@pytest.mark.parametrize("plants", [(), "carex"])
@pytest.mark.parametrize("kind", ["flat", "heights", "mesh"])
def test_a_print_far_up_is_that_of_one_at_sea_level(kind, plants):
    """On a slope, at the height of ships, of planes, and of the edge of space."""

    def ground(up):
        x, y = np.meshgrid(np.arange(-2, 2.01, 0.5), np.arange(-2, 2.01, 0.5))
        z = up + 0.1 * x
        if kind == "flat":
            return Ground.flat(up)
        if kind == "heights":
            return Ground.heights(z, 0.5, -2.0, -2.0)
        n = x.shape[1]
        at = np.arange(x.size).reshape(x.shape)[:-1, :-1].ravel()
        faces = np.concatenate([np.stack([at, at + 1, at + n + 1], -1), np.stack([at, at + n + 1, at + n], -1)])
        return Ground.mesh(np.stack([x.ravel(), y.ravel(), z.ravel()], -1), faces)

    found = {}
    for up in (0.0, 0.37, -11.0, 12e3 + 0.37, 90e3 + 0.1, -90e3):
        sim = Simulation(ground(up), FIRM, 0.01, plants=plants)
        tilt = 0.0 if kind == "flat" else math.atan(0.1) / 2
        gait, loads = gaits.pressed([FOOT], [[0, 0, up, math.cos(tilt), 0, -math.sin(tilt), 0]], [[20, 0, -75 * G]])
        sim.load(gait, loads)
        sim.run(len(gait.time) - 1)
        found[up] = sim.report()["pressed_m3"], sim.read("heap", -50, -50, 100, 100)
        assert sim.read("rest", 5, 5, 1, 1)[0, 0] == np.float32(sim.rest_height([[0.055, 0.055]])[0])
        if plants:
            broken = [sim.plants_alpha(stand[0]).sum() for stand in sim.stands]
            assert abs(sim.plants_positions(sim.stands[0][0])[:, :, 2] - up).max() < 1.0
            found[up] += (sum(broken),)
    for up in found:
        assert found[up][0] == pytest.approx(found[0.0][0], rel=1e-5)
        assert np.abs(found[up][1] - found[0.0][1]).max() < 1e-4
        assert found[up][2:] == pytest.approx(found[0.0][2:], rel=1e-3)


def test_a_foot_s_volume_does_not_depend_on_the_cell():
    turned = [0.013, 0.021, 0, *gaits.turn_z(0.4)]
    runs = [press([FOOT], [turned], [[0, 0, -75 * G]], cell=cell)[1] for cell in (0.04, 0.02, 0.01, 0.005)]
    for report in runs[:-1]:
        assert report["pressed_m3"] == pytest.approx(runs[-1]["pressed_m3"], rel=0.03)


def drop(mass=50.0, modulus=1e6, nu=0.35, law="sole"):
    soil = Soil(layer_depth=0.3, young_modulus=modulus, poisson_ratio=nu, settle_time=0.2, rest_angle=math.radians(30))
    gait = bodies.dropped(mass, 2.5, 0.15)  # lands with 7 m/s, MODEL 11.11
    sim = Simulation(Ground.flat(), soil, 0.01, options=SimulationOptions(law=law))
    loads = walker.loads(gait, "impulse", ground=sim.rest_height, settle_time=soil.settle_time)
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    heap = sim.read("heap", -100, -100, 200, 200)
    return loads, sim.report(), heap


def test_a_dropped_sphere_hits_with_weight_and_impulse():
    loads, _, _ = drop()
    peak = -loads.force[0, :, 2].min()
    assert peak == pytest.approx(2241, rel=0.01)


def test_a_dropped_sphere_goes_deeper_with_mass_and_shallower_with_stiffness():
    depth = [drop(mass=m)[1]["deepest_m"] for m in (25, 50, 100)]
    assert depth[0] < depth[1] < depth[2]
    depth = [drop(modulus=e)[1]["deepest_m"] for e in (0.5e6, 1e6, 2e6)]
    assert depth[0] > depth[1] > depth[2]


@pytest.mark.parametrize("law", ["sole", "uniform"])
def test_a_dropped_sphere_s_rim_grows_with_poisson_s_ratio_and_its_depth_does_not(law):
    """SOFT22 Fig. 7"""
    runs = [drop(nu=nu, law=law) for nu in (0.1, 0.25, 0.45)]
    depths = [report["deepest_m"] for _, report, _ in runs]
    rims = [float(heap.max()) for _, _, heap in runs]
    assert depths[0] == pytest.approx(depths[2], rel=1e-3) and depths[0] == pytest.approx(depths[1], rel=1e-3)
    assert rims[0] < rims[1] < rims[2]
