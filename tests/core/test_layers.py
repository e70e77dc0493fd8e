"""Ground in layers: mud on asphalt, snow on earth. MODEL 6.17, MODEL 11.26, PEYRAT11 3.1"""

from dataclasses import replace

import numpy as np
import pytest
from test_plough import dragged

from desire_path import SOILS, Bake, BakeOptions, DesirePathError, Ground, Simulation, SimulationOptions, Soil, SoilKeys
from desire_path.__main__ import main
from desire_path.ground import maps
from desire_path.ground.layers import Layer
from desire_path.ground.spray import Spray
from desire_path.loads import walker
from tests.golden.worlds import walk
from tests.scenes import gaits

SAND = Soil(young_modulus=5e5, poisson_ratio=0.35, rest_angle=0.5)
MUD = replace(SAND, young_modulus=1e5, poisson_ratio=0.2)
ROCK = Soil(young_modulus=5e10, layer_depth=1.0)
WINDOW = (-0.3, -0.4, 2.0, 0.4)


def trodden(soil, *layers, cell=0.01, **options):
    gait, loads = walk(1.5)
    sim = Simulation(Ground.flat().layered(*layers), soil, cell, options=SimulationOptions(**options))
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    sim.settle()
    return sim


@pytest.fixture(scope="module")
def mud_on_sand():
    return trodden(SAND, Layer(MUD, 0.05))


@pytest.mark.parametrize("law", ("sole", "uniform"))
def test_two_layers_of_one_soil_are_that_soil(law):
    whole = trodden(SAND, law=law)
    parts = trodden(replace(SAND, layer_depth=0.1), Layer(SAND, 0.05), Layer(SAND, 0.15), law=law)
    for name, slack in (("compression", 1e-6), ("pressure_time", 1e-6), ("heap", 1e-3)):  # heaps slide at a threshold
        one, other = whole.read(name, WINDOW), parts.read(name, WINDOW)
        assert one.max() > 0.0
        np.testing.assert_allclose(other, one, atol=slack * one.max(), err_msg=name)
    assert parts.report()["heaped_m3"] == pytest.approx(whole.report()["heaped_m3"], rel=1e-6)


def test_a_soft_layer_on_rock_is_pressed_no_deeper_than_it_is():
    soft = replace(MUD, young_modulus=1e4)
    thin, deep = trodden(ROCK, Layer(soft, 0.01)), trodden(ROCK, Layer(soft, 0.2))
    assert 0.9 * 0.01 < thin.read("compression", WINDOW).max() <= 0.95 * 0.01 + 1e-6
    assert deep.read("compression", WINDOW).max() > 0.06
    assert thin.read("layer_1", WINDOW).min() >= 0.05 * 0.01 - 1e-6


def test_layers_tell_how_thick_they_still_are(mud_on_sand):
    """Springs in series: of a depth each yields in proportion to its thickness over its stiffness."""
    pressed, left = mud_on_sand.read("compression", WINDOW), mud_on_sand.read("layer_1", WINDOW)
    share = (0.05 / 1e5) / (0.05 / 1e5 + 0.3 / 5e5)
    deep = pressed > 0.004
    assert deep.sum() > 100 and pressed.max() < 0.0475
    np.testing.assert_allclose((0.05 - left)[deep], share * pressed[deep], rtol=1e-4)
    np.testing.assert_allclose(left[pressed == 0.0], 0.05, rtol=1e-6)


def test_what_is_pushed_aside_comes_of_each_layer_by_its_own_share(mud_on_sand):
    told = mud_on_sand.report()
    share = (0.05 / 1e5) / (0.05 / 1e5 + 0.3 / 5e5)
    nu = share * 0.2 + (1.0 - share) * 0.35
    first = told["displaced_m3"] - 2 * 0.2 * told["pressed_heap_m3"]
    assert first == pytest.approx(2 * nu * told["pressed_m3"], rel=0.02)
    heaped = told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"]
    assert told["heaped_m3"] == pytest.approx(heaped, rel=1e-6)


def test_the_softest_layer_gives_way_wherever_it_lies():
    top, below = trodden(SAND, Layer(MUD, 0.05), Layer(SAND, 0.05)), trodden(SAND, Layer(SAND, 0.05), Layer(MUD, 0.05))
    a, b = (sim.read("compression", WINDOW).max() for sim in (top, below))
    assert a == pytest.approx(b, rel=0.02)
    assert below.read("layer_2", WINDOW).min() < below.read("layer_1", WINDOW).min()


def test_workers_and_a_stop_do_not_change_a_bit(mud_on_sand):
    more = trodden(SAND, Layer(MUD, 0.05), threads=3)
    for name in ("compression", "heap", "layer_1"):
        assert np.array_equal(more.read(name, WINDOW), mud_on_sand.read(name, WINDOW))
    gait, loads = walk(1.5)
    half, again, other = (
        Simulation(Ground.flat().layered(Layer(MUD, thick)), SAND, 0.01) for thick in (0.05, 0.05, 0.06)
    )
    for sim in (half, again, other):
        sim.load(gait, loads)
    half.run(40)
    again.restore(half.state())
    again.run(len(gait.time) - 1)
    again.settle()
    assert np.array_equal(again.read("compression", WINDOW), mud_on_sand.read("compression", WINDOW))
    with pytest.raises(DesirePathError):
        other.restore(half.state())


def test_a_bake_has_the_maps_of_its_layers(tmp_path):
    gait, _ = walk(1.5)
    ground = Ground.flat().layered(Layer("mud", 0.03))
    bake = Bake(gait, ground, "packed-earth", tmp_path / "bake", cell_size=0.02, options=BakeOptions(threads=1))
    for _ in bake.run():
        pass
    left = maps.read(tmp_path / "bake" / "maps_final.exr").planes["layer_1"]
    assert left.max() == pytest.approx(0.03, rel=1e-5) and left.min() < 0.0295
    assert bake.report["parameters"]["layers"][0][1] == 0.03


@pytest.mark.parametrize(
    "layer, says",
    [
        ("mud:0", "A layer 0.0 m thick"),
        ("mud:-0.1", "A layer -0.1 m thick"),
        ("mud:11", "give more than 0 and up to 10 m"),
        ("mud:nan", "A layer nan m thick"),
        ("mudd:0.1", "There is no soil 'mudd'"),
        ("mud", "write SOIL:METRES, as mud:0.03"),
    ],
)
def test_a_layer_that_cannot_be_is_refused_before_anything_is_written(tmp_path, capsys, layer, says):
    gait, _ = walk(1.5)
    gait.save(tmp_path / "walk.npz")
    code = main(["bake", str(tmp_path / "walk.npz"), "--layer", layer, "--out", str(tmp_path / "bake")])
    said = capsys.readouterr()
    assert code and says in said.err + said.out and len((said.err + said.out).strip().splitlines()) == 1
    assert not (tmp_path / "bake").exists()


def test_what_cannot_lie_in_layers_is_refused():
    ground = Ground.flat().layered(Layer("mud", 0.1))
    with pytest.raises(DesirePathError, match="takes no soil that changes over time"):
        Simulation(ground, SoilKeys("mud", {"young_modulus": [(0.0, 1e5), (1.0, 1e6)]}))
    with pytest.raises(DesirePathError, match="5 layers lie on the ground: give at most 3"):
        Ground.flat().layered(*[Layer("mud", 0.1)] * 5)


# ---- painted -------------------------------------------------------------------------------------------

STICKY = replace(SOILS["mud"], adhesion=0.004)
HARD = Soil(young_modulus=5e9)


X = -1.0 + 0.25 * np.arange(29)


def strip(share, weight=None):
    """Level ground of triangles from (-1, -1) to (6, 1), and `share(x)` at each of its vertices."""
    at = np.array([(x, y, 0.0) for y in (-1.0, 1.0) for x in X])
    low = np.arange(28)[:, None]
    faces = np.concatenate([low + (0, 1, 30), low + (0, 30, 29)])
    return Ground.mesh(at, faces, weight), np.tile(share(X), 2)


def on_strip(share, soil, layer, soils=(HARD,), until=4.5):
    ground, shares = strip(share)
    gait, loads = walk(until)
    sim = Simulation(ground.layered(Layer(soil, layer, shares)), soils, 0.01)
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    sim.settle()
    return sim


@pytest.fixture(scope="module")
def muddy():
    """Mud that thins out towards x = 1, where the road is bare."""
    return on_strip(lambda x: np.clip(0.5 - 0.5 * x, 0.0, 1.0), STICKY, 0.04)


def test_a_layer_is_as_thick_as_it_is_painted(muddy):
    thick = muddy.read("layer_1", (-1.0, 0.5, 1.5, 0.9)).mean(axis=0)
    x = -1.0 + 0.01 * (0.5 + np.arange(250))
    np.testing.assert_allclose(thick, 0.04 * np.clip(0.5 - 0.5 * x, 0.0, 1.0), atol=0.04 / 32 + 1e-6)
    assert not thick[-40:].any()


def test_what_is_painted_is_pressed_as_what_is_not():
    all_over = on_strip(np.ones_like, STICKY, 0.04, until=2.0)
    plain = Simulation(strip(np.ones_like)[0].layered(Layer(STICKY, 0.04)), HARD, 0.01)
    gait, loads = walk(2.0)
    plain.load(gait, loads)
    plain.run(len(gait.time) - 1)
    plain.settle()
    for name in ("compression", "heap", "layer_1", "surface_mud", "carried_mud"):
        assert np.array_equal(all_over.read(name, WINDOW), plain.read(name, WINDOW)), name
    assert not on_strip(np.zeros_like, STICKY, 0.04, until=2.0).read("layer_1", WINDOW).any()


def test_mud_of_a_layer_is_carried_onto_the_road_and_nothing_is_lost(muddy):
    own = muddy.carried()["mud"]
    assert set(muddy.carried()) == {"mud"} and own["left_m3"] > 1e-6
    assert own["taken_m3"] == pytest.approx(own["carried_m3"] + own["left_m3"], rel=1e-6)
    coat = muddy.read("carried_mud", (1.2, -1, 5, 1))
    assert coat[:, :90].sum() > 1.1 * coat[:, 180:270].sum() > 0.0
    told = muddy.report()
    laid = told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"]
    assert told["heaped_m3"] + own["left_m3"] + own["carried_m3"] == pytest.approx(laid, rel=1e-6)


def test_what_is_seen_of_layers_sums_to_one(muddy):
    names = [name for name in muddy.fields if name.startswith("surface_")]
    assert names == ["surface_mud", "surface_soil"]
    mud, road = (muddy.read(name, (-1, -1, 5, 1)) for name in names)
    np.testing.assert_allclose(mud + road, 1.0, atol=1e-6)
    assert mud[:, :100].min() > 0.9 and not mud[2, 220:].any() and mud[:, 230:].max() > 0.05


def test_earth_shows_where_thin_snow_is_trodden():
    thin, deep = (trodden("packed-earth", Layer("powder-snow", thick)) for thick in (0.005, 0.2))
    for sim, least, most in ((thin, 0.1, 0.9), (deep, 1.0, 1.0)):
        white, brown = (sim.read(f"surface_{name}", WINDOW) for name in ("powder-snow", "packed-earth"))
        np.testing.assert_allclose(white + brown, 1.0, atol=1e-6)
        assert white.max() == 1.0 and least <= white.min() <= most


def test_the_soil_that_is_read_is_that_below_all_layers():
    far = np.tile(X > 2.0, 2)
    ground, shares = strip(lambda x: np.clip(x, 0.0, 1.0), np.stack([~far, far]))
    sim = Simulation(ground.layered(Layer(MUD, 0.1, shares)), (SAND, ROCK), 0.02)
    assert set(np.unique(sim.read("soil", (-0.9, -0.9, 5.9, 0.9)))) == {0.0, 1.0}


@pytest.mark.parametrize(
    "share, says",
    [([0.5], "has 1 values"), (np.full(58, 1.5), "not between 0 and 1"), (np.full(58, np.nan), "not between")],
)
def test_a_share_that_cannot_be_is_refused(share, says):
    ground, _ = strip(np.ones_like)
    with pytest.raises(DesirePathError, match=says):
        ground.layered(Layer(MUD, 0.1, share))
    with pytest.raises(DesirePathError, match="Flat ground has no vertices"):
        Ground.flat().layered(Layer(MUD, 0.1, [1.0]))


# ---- what flies off ------------------------------------------------------------------------------------

FLIES = Spray(adhesion=0.002, hold_time=0.04, slow_speed=0.1, fast_speed=0.5, particle_size=0.006)
GRAINS = Spray(adhesion=0.002, hold_time=0.04, slow_speed=1.0, fast_speed=4.0, particle_size=0.006)


def all_is_there(sim):
    """What was displaced lies, sticks, flies or fell beside; what sticks is carried or was left. The report"""
    told, own = sim.report(), sim.carried()["mud"]
    assert own["taken_m3"] == pytest.approx(own["carried_m3"] + own["left_m3"], rel=1e-6)
    laid = told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"]
    away = told["stuck_m3"] + told["airborne_m3"] + told["beside_m3"]
    assert told["heaped_m3"] + away + own["left_m3"] + own["carried_m3"] == pytest.approx(laid, rel=1e-6)
    return told


@pytest.mark.parametrize(("law", "deep"), (("sole", 0.0), ("uniform", 0.0), ("carve", 0.06)))
def test_nothing_is_lost_of_layers_that_are_ploughed(law, deep):
    """A crate dragged from mud that sticks, on snow, onto bare sand, throwing what sticks."""
    gait = dragged(law, far=2.0, seconds=3.0)
    pose = np.array(gait.pose)
    pose[..., 2] -= deep
    gait = replace(gait, pose=pose)
    ground, share = strip(lambda x: np.clip(0.5 * (2.0 - x), 0.0, 1.0))
    layers = Layer(STICKY, 0.03, share), Layer("snow", 0.05)
    sim = Simulation(ground.layered(*layers), SAND, 0.02, options=SimulationOptions(spray=FLIES))
    sim.load(gait, walker.loads(gait, ground=sim))
    for until in (60, 300, len(gait.time) - 1):  # it stands, slides, and has slid
        sim.run(until)
        told = all_is_there(sim)
        assert (told["loosened_m3"] > 1e-3) == (until > 60)
        assert told["airborne_m3"] > 0.0 or until != 300
    sim.settle()
    assert all_is_there(sim)["airborne_m3"] == 0.0 and sim.carried()["mud"]["taken_m3"] > 5e-5


@pytest.mark.parametrize("painted", (False, True))
def test_nothing_is_lost_of_layers_that_stick_and_fly(painted):
    """A run over mud that sticks, on snow, on sand: ground, soles and air hold all that was displaced."""
    gait, loads = gaits.strides(2.4, speed=3.2, rate=120.0)
    ground, share = strip(lambda x: np.clip(0.5 * (3.0 - x), 0.0, 1.0))
    layers = Layer(STICKY, 0.03, share if painted else None), Layer("snow", 0.05)
    sim = Simulation(ground.layered(*layers), SAND, 0.02, options=SimulationOptions(spray=GRAINS))
    sim.load(gait, loads)
    sim.run(len(gait.time))
    for landed in (False, True):
        if landed:
            sim.settle()
        told = all_is_there(sim)
        flies = np.bincount(sim.grains().soil, minlength=3) * GRAINS.volume
        assert flies.sum() == pytest.approx(told["airborne_m3"], rel=1e-6) and (flies[0] > 0.0) != landed
        assert flies[1:].any() <= painted  # numbers count as the maps: mud, snow, sand


# ---- springs beside what is none -----------------------------------------------------------------------


@pytest.mark.parametrize("beside", ("layer", "snow"))
def test_springs_press_back_as_alone_beside_ground_that_is_none(beside):
    """A walk over sand, whose feet roll over what they have pressed; a layer lies nowhere, or snow far off."""
    gait, _ = walk(4.5)
    off = np.tile(X > 5.5, 2).astype(float)
    layered, none = strip(lambda x: 0.0 * x)
    ground, soils = {
        "layer": (layered.layered(Layer("mud", 0.04, none)), (SAND,)),
        "snow": (strip(lambda x: 0.0 * x, np.stack([1.0 - off, off]))[0], (SAND, SOILS["powder-snow"])),
    }[beside]
    found = []
    for each, own in ((layered, (SAND,)), (ground, soils)):
        sim = Simulation(each, own, 0.01)
        sim.load(gait, walker.loads(gait, ground=sim))
        sim.run(len(gait.time) - 1)
        found.append([sim.read(name, (-1, -1, 5, 1)) for name in ("compression", "heap")])
    for slack, alone, together in zip((1e-6, 5e-3), *found):  # heaps slide at a threshold
        np.testing.assert_allclose(together, alone, atol=slack * alone.max())
    assert found[0][0].max() > 0.02
