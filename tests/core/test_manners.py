"""Manners that users of NumPy and SciPy expect: tables that are read only, arguments that have names and are alike
where they mean the same, blocks that close, sentences that name what failed. Records have test_records.py."""

import inspect
from dataclasses import is_dataclass, replace

import numpy as np
import pytest
from scenes import gaits
from scenes.modules import modules

from desire_path import KINDS, SOILS, Bake, Gait, Ground, Simulation, Soil, place_feet
from desire_path.bake.options import BakeOutput
from desire_path.errors import DesirePathError
from desire_path.ground.layers import Layer
from desire_path.ground.options import SimulationOptions
from desire_path.ground.plants import PAPER
from desire_path.ground.spray import Spray
from desire_path.loads import walker
from desire_path.motion.scatter import Scatter
from desire_path.placement import passes


@pytest.fixture(scope="module")
def gait():
    return gaits.strides(3.0)[0]


@pytest.fixture(scope="module")
def walked(gait):
    sim = Simulation(Ground.flat(), "mud", cell_size=0.03)
    sim.load(gait, walker.loads(gait))
    sim.run(30)
    return sim


@pytest.mark.parametrize("table", [SOILS, KINDS, PAPER])
def test_tables_of_presets_are_read_only(table):
    name, known = next(iter(table.items()))
    with pytest.raises(TypeError):
        table[name] = known
    with pytest.raises(TypeError):
        del table[name]
    assert dict(table)[name] is known and list(table)[0] == name


def test_a_soil_of_ones_own_needs_no_table():
    assert Simulation(Ground.flat(), Soil(layer_depth=0.1)).soils == [Soil(layer_depth=0.1)]


def test_along_names_its_keywords():
    own = inspect.signature(Gait.along).parameters
    there = inspect.signature(passes.along).parameters
    assert list(own)[1:] == list(there)[1:]
    assert [each.default for each in own.values()][1:] == [each.default for each in there.values()][1:]
    assert not any(each.kind is inspect.Parameter.VAR_KEYWORD for each in own.values())


def test_along_hands_on_every_keyword(gait, monkeypatch):
    seen = {}
    monkeypatch.setattr(passes, "along", lambda gait, path, passes, **more: seen.update(more))
    given = dict(back_and_forth=False, scatter=Scatter(0.2, 0.1, 0.02), seed=3, pause=1.0, ground=np.sum)
    gait.along([(0, 0), (4, 0)], 2, **given)
    assert seen == given


def test_loads_and_contacts_take_the_same_grounds(gait):
    hill = Simulation(Ground.heights(np.full((20, 60), 0.02), 0.1, -1.0, -1.0))
    for ground in (None, 0.02, hill, hill.rest_height):
        on, _ = walker.contacts(gait, ground=ground)
        np.testing.assert_array_equal(on, walker.Walker().contacts(gait, ground=ground)[0])
        np.testing.assert_array_equal(on != 0, walker.loads(gait, ground=ground).touching != 0)


def test_the_old_name_of_the_ground_of_contacts_warns(gait):
    with pytest.warns(DeprecationWarning, match="ground_height"):
        old = walker.contacts(gait, ground_height=0.02)
    for have, want in zip(old, walker.contacts(gait, 0.02)):
        np.testing.assert_array_equal(have, want)


def test_simulations_and_bakes_are_shown_on_one_short_line(gait, tmp_path):
    assert repr(Simulation(Ground.flat(), "mud")) == "Simulation(cells of 0.01 m, 1 soil, 0 plantings)"
    bake = Bake(gait, Ground.flat(), folder=str(tmp_path / "bake"))
    assert repr(bake).startswith("Bake(Gait(1 walker") and "frames 1 to" in repr(bake) and "\n" not in repr(bake)


def test_a_rectangle_that_bounds_tells_is_one_that_read_takes():
    heights = np.add.outer(np.zeros(5), np.arange(9.0))
    with Simulation(
        Ground.heights(heights, 0.1), cell_size=0.05, options=SimulationOptions(origin=(0.01, -0.02))
    ) as sim:
        whole = sim.read("rest", sim.bounds())
        i0, i1, j0, j1 = sim.cells(sim.bounds())
        np.testing.assert_array_equal(whole, sim.read("rest", i0, j0, i1 - i0, j1 - j0))
        assert sim.cells(sim.box((3, 9, -2, 4))) == (3, 9, -2, 4)
        assert sim.read("rest", sim.box((3, 9, -2, 4))).shape == (6, 6)
        assert sim.cells((0.012, -0.018, 0.013, -0.017)) == (0, 1, 0, 1)
        for bad in ((0, 0, 0, 1), (0, 0, 1), (0, 0, np.inf, 1), 3):
            with pytest.raises(DesirePathError, match="rectangle"):
                sim.read("rest", bad)
        with pytest.raises(DesirePathError, match="i0, j0, nx and ny"):
            sim.read("rest", 0, 0)
    with pytest.raises(DesirePathError, match="no end"):
        flat = Simulation(Ground.flat())
        flat.read("rest", flat.bounds())


def test_cells_of_a_box_are_the_cells_it_was_made_of():
    for cell, origin in ((0.01, (0.0, 0.0)), (0.03, (0.1, -0.7)), (0.007, (-3.3, 12.1))):
        sim = Simulation(Ground.flat(), cell_size=cell, options=SimulationOptions(origin=origin))
        for i in range(-300, 300, 7):
            cells = (i, i + 1 + i % 5, 3 * i, 3 * i + 2)
            assert sim.cells(sim.box(cells)) == cells


def test_a_simulation_is_closed_at_the_end_of_its_block():
    with Simulation(Ground.flat()) as sim:
        assert sim.read("rest", 0, 0, 2, 2).shape == (2, 2)
    with pytest.raises(DesirePathError, match="closed"):
        sim.read("rest", 0, 0, 2, 2)
    sim.close()  # once more does no harm
    with pytest.raises(KeyError), Simulation(Ground.flat()):
        raise KeyError("what went wrong in the block is told")


def test_a_bake_frees_its_folder_at_the_end_of_its_block(gait, tmp_path):
    with Bake(gait, Ground.flat(), folder=str(tmp_path / "bake"), cell_size=0.03) as bake:
        steps = bake.run()
        assert next(steps).frame == 1
    assert list(steps) == []
    with Bake(gait, Ground.flat(), folder=str(tmp_path / "bake"), cell_size=0.03, output=BakeOutput(wait=0.0)) as bake:
        assert [each.fraction for each in bake.run()][-1] == 1.0
    assert bake.report["contacts"] > 0


FAILS = {  # what is told of a call that cannot be: the argument, and why
    "layers": (lambda sim, gait: Ground.flat().layered(*[Layer("mud", 0.03)] * 4), "4 layers .* at most 3"),
    "layer": (lambda sim, gait: Layer("mud", 0.0), "A layer 0.0 m thick .* more than 0"),
    "layer soil": (lambda sim, gait: Layer("mist", 0.1), "mist"),
    "spray": (lambda sim, gait: Spray(particle_size=-1.0), "particle_size"),
    "spray speeds": (lambda sim, gait: Spray(slow_speed=9.0, fast_speed=2.0), "slow_speed of 9 .* fast_speed, 2"),
    "spray name": (lambda sim, gait: Simulation(Ground.flat(), options=SimulationOptions(spray="rain")), "rain"),
    "field": (lambda sim, gait: sim.read("height", 0, 0, 2, 2), "no field 'height'"),
    "cell": (lambda sim, gait: Simulation(Ground.flat(), cell_size=0.0), "cell"),
    "sample": (lambda sim, gait: sim.push(0.0, np.zeros((4, 7)), [1] * 4, np.zeros((4, 3)), np.zeros((4, 3))), "live"),
    "loads": (lambda sim, gait: sim.load(gait, replace(walker.loads(gait), force=np.full((4, 2, 3), np.nan))), "force"),
    "state": (lambda sim, gait: sim.restore(b"no state"), "state"),
    "place": (lambda sim, gait: place_feet(gait, sim, walkers=[9]), "9"),
    "rest": (lambda sim, gait: sim.rest_plants(-1.0), "-1.0 seconds"),
    "stand": (lambda sim, gait: sim.plants_positions(7), "no stand 7"),
    "rectangle": (lambda sim, gait: sim.read("heap", (1, 0, 0, 1)), "rectangle"),
}


@pytest.mark.parametrize("call", FAILS)
def test_what_fails_is_named_and_leaves_all_as_it_was(call, gait, walked):
    """The simulation goes on, to the bit, as if nobody had asked."""
    fails, words = FAILS[call]
    before = bytes(walked.state())
    with pytest.raises((ValueError, DesirePathError), match=words):
        fails(walked, gait)
    assert bytes(walked.state()) == before


def test_a_walk_goes_on_after_what_failed(gait, walked):
    alone = Simulation(Ground.flat(), "mud", cell_size=0.03)
    alone.load(gait, walker.loads(gait))
    alone.run(60)
    walked.run(60)
    assert bytes(alone.state()) == bytes(walked.state())


def public_functions():
    """(where, function) of all that the package has without Blender; records take as many numbers as they hold."""
    for module in modules():
        for name, each in vars(module).items():
            if name.startswith("_") or getattr(each, "__module__", "") != module.__name__:
                continue
            if inspect.isfunction(each):
                yield f"{module.__name__}.{name}", each
            elif inspect.isclass(each):
                own = {key: value for key, value in vars(each).items() if inspect.isfunction(value)}
                shown = [key for key in own if not key.startswith("_")]
                if "__init__" in own and not is_dataclass(each):
                    shown.append("__init__")
                for key in shown:
                    yield f"{module.__name__}.{name}.{key}", own[key]


def test_no_function_takes_more_than_eight_parameters():
    """More are a record of options."""
    many = {}
    for where, each in public_functions():
        count = len([name for name in inspect.signature(each).parameters if name not in ("self", "cls")])
        if count > 8:
            many[where] = count
    assert not many


@pytest.mark.parametrize(
    "window, words",
    [
        ((0, 0, 1), "give all four"),
        ((0, 0, 0, 1), "0 x 1 cells holds nothing"),
        (((1, 0, 0, 1),), "holds no cells"),
        (("here",), "give x0, y0, x1, y1 in metres"),
    ],
)
def test_a_window_that_is_none_is_named(window, words):
    with Simulation(Ground.flat(), cell_size=0.01) as sim, pytest.raises(DesirePathError, match=words):
        sim.read("heap", *window)


def test_a_window_is_rows_of_columns():
    with Simulation(Ground.flat(), cell_size=0.01) as sim:
        assert sim.read("heap", 0, 0, 3, 2).shape == sim.read("heap", (0.0, 0.0, 0.03, 0.02)).shape == (2, 3)
