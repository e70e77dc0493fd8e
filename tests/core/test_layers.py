"""Ground in layers: mud on asphalt, snow on earth. MODEL 6.17, MODEL 11.26, PEYRAT11 3.1"""

from dataclasses import replace

import numpy as np
import pytest

from desire_path import Bake, BakeOptions, DesirePathError, Ground, Simulation, SimulationOptions, Soil, SoilKeys
from desire_path.__main__ import main
from desire_path.ground import maps
from desire_path.ground.layers import Layer
from tests.golden.worlds import walk

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
