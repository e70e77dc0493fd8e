"""Plants on the ground that is walked on: Simulation and Bake with plants. TRAIL (5)-(9), design 7 and 8."""

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.plants import KINDS, Planting
from desire_path.sim import Ground, Simulation
from scenes import gaits

TOUGH = KINDS["lawn"]
FIELDS = ("compression", "heap", "pressure_time", "plant_strength", "young_modulus")


def stand(plants=(), at=(0.0, 0.0), *, newtons=735.0, threads=1, ground=None, cell=0.01, origin=(0.0, 0.0)):
    """A box of 28 x 10 cm stands on soft ground, then lifts off."""
    sim = Simulation(ground or Ground.flat(), "snow", cell, plants=plants, threads=threads, origin=origin)
    gait, loads = gaits.pressed([gaits.box(0.28, 0.10)], [[*at, 0.0, 1, 0, 0, 0]], [[0, 0, -newtons]])
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    sim.settle()
    return sim


def fields(sim, window=(-64, -64, 128, 128)):
    return {name: sim.read(name, *window) for name in FIELDS}


def test_bare_ground_knows_nothing_of_plants():
    bare = fields(stand())
    assert not bare["plant_strength"].any()
    away = fields(stand([Planting("carex", rectangle=(5, 5, 6, 6))]))  # out of reach: not even planted
    for name in FIELDS:
        np.testing.assert_array_equal(bare[name], away[name])


def test_roots_make_prints_shallower():
    bare, grown = stand().report(), stand([Planting(TOUGH)]).report()
    assert grown["deepest_m"] < 0.6 * bare["deepest_m"]
    assert grown["plants"] > 1000 and bare["plants"] == 0


def test_same_bits_for_any_number_of_threads():
    one, four = (fields(stand([Planting("carex"), Planting("moss", seed=4)], threads=n)) for n in (1, 4))
    for name in FIELDS:
        assert one[name].tobytes() == four[name].tobytes(), name


def test_the_same_seed_gives_the_same_roots_wherever_the_walk_goes():
    planting = Planting("carex", seed=11)
    near, far = planting.within(-1, -1, 1, 1), planting.within(-7, -1, 1, 3)
    known = {tuple(root) for root in far.tolist()}
    assert len(near) > 100 and all(tuple(root) in known for root in near.tolist())
    assert not np.array_equal(near, Planting("carex", seed=12).within(-1, -1, 1, 1)[:len(near)])


def test_weight_thins_and_rectangles_end():
    weight = np.array([[1.0, 0.0], [1.0, 0.25]], np.float32)
    roots = Planting("lawn", weight=weight, rectangle=(0.5, 0.5, 4.5, 4.5)).within(-10, -10, 10, 10)
    assert roots.min() >= 0.5 and roots.max() < 4.5
    left, right = roots[roots[:, 0] < 2.5], roots[roots[:, 0] >= 2.5]
    assert abs(len(left) / 8.0 / 300.0 - 1.0) < 0.03
    assert (right[:, 1] >= 2.5).all() and abs(len(right) / 4.0 / 75.0 - 1.0) < 0.15


def test_plantings_that_make_no_sense_are_refused():
    for wrong in (dict(kind="cactus"), dict(kind=3), dict(kind="carex", density=0), dict(kind="carex", seed=-1),
                  dict(kind="carex", rectangle=(1, 0, 0, 1)), dict(kind="carex", weight=np.ones((2, 2))),
                  dict(kind="carex", weight=np.full((2, 2), np.nan), rectangle=(0, 0, 1, 1)),
                  dict(kind="carex", roots=np.zeros((3, 3)))):
        with pytest.raises(DesirePathError) as problem:
            Planting(**wrong)
        assert str(problem.value).count(".") >= 1
