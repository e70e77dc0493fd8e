"""A simulation that is stopped and goes on elsewhere is the one that never stopped, to the bit."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import desire_path
from desire_path import Gait
from desire_path.errors import DesirePathError
from desire_path.ground.options import SimulationOptions
from desire_path.ground.plants import Planting
from desire_path.ground.sim import Ground, Simulation
from desire_path.loads import walker
from desire_path.placement import passes

FIELDS = ("compression", "heap", "pressure_time", "plant_strength", "lean_x", "lean_y", "crushed", "pressure")


def make(planted=True, soils="mud", cell=0.02):
    walk = Gait.load(Path(desire_path.__file__).parent / "walks" / "walk.npz")
    gait = passes.in_turn([walk.along([(0, 0), (1.5, 0)], 2, seed=1), walk.along([(0, 0.2), (1.5, 0)], 1, seed=2)])
    plants = [Planting("carex", density=30, seed=3)] if planted else []
    sim = Simulation(Ground.flat(), soils, cell, options=SimulationOptions(threads=2), plants=plants)
    sim.load(gait, walker.loads(gait))
    return sim, len(gait.time)


def seen(sim):
    i0, i1, j0, j1 = sim.reach()
    fields = [sim.read(name, i0, j0, i1 - i0, j1 - j0) for name in FIELDS]
    plants = [each for stand, _, _ in sim.stands for each in (sim.plants_positions(stand), sim.plants_strength(stand))]
    return [*fields, *plants, np.array([*sim.report().values()], float)]


def test_it_goes_on_in_another_process(tmp_path):
    sim, count = make()
    sim.run(count // 2)
    sim.save_state(tmp_path / "half.state")
    here = seen(sim)
    code = (
        f"import sys; sys.path[:0] = {[str(Path(__file__).parent), *sys.path]!r}\n"
        "import numpy as np, test_state\n"
        "sim, count = test_state.make()\n"
        f"sim.load_state({str(tmp_path / 'half.state')!r})\n"
        "first = test_state.seen(sim)\n"
        "sim.run(count - 1)\n"
        f"np.savez({str(tmp_path / 'there.npz')!r}, *first, *test_state.seen(sim))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    sim.run(count - 1)
    want, found = [*here, *seen(sim)], np.load(tmp_path / "there.npz")
    assert len(found.files) == len(want) and here[0].max() > 0.005
    for n, each in enumerate(want):
        assert np.array_equal(found[f"arr_{n}"], each), n


def test_what_is_no_state_of_it_changes_nothing(tmp_path):
    sim, count = make(planted=False)
    sim.run(count // 2)
    path = tmp_path / "half.state"
    sim.save_state(path)
    good = path.read_bytes()
    fresh, _ = make(planted=False)
    before = seen(fresh)
    for bad in (b"", good[:-1], good[:100], good + b"x", good[:50] + b"\xff" + good[51:], b"no state at all"):
        path.write_bytes(bad)
        with pytest.raises(DesirePathError, match="is damaged, or the state of another"):
            fresh.load_state(path)
    assert all(np.array_equal(a, b) for a, b in zip(seen(fresh), before))
    path.write_bytes(good)
    for other in (make(planted=True)[0], make(planted=False, soils="snow")[0], make(planted=False, cell=0.03)[0]):
        with pytest.raises(DesirePathError, match="state of another ground, walk or plants"):
            other.load_state(path)
    with pytest.raises(DesirePathError, match="cannot be read"):
        fresh.load_state(tmp_path / "nothing.state")
    with pytest.raises(DesirePathError, match="before the first step"):
        sim.load_state(path)
    fresh.load_state(path)
    assert all(np.array_equal(a, b) for a, b in zip(seen(fresh), seen(sim)))
    with pytest.raises(DesirePathError):
        sim.save_state(tmp_path / "no folder" / "x.state")
