"""What callers hand to _native that it cannot use: a sentence, never a crash."""

import threading

import numpy as np
import pytest

from desire_path import _native
from desire_path.ground.kinds import Kind
from desire_path.ground.sim import Ground, Simulation
from tests.scenes import gaits


def standing():
    """A simulation with a box on it, and its recording."""
    sim = Simulation(Ground.flat(), "mud", 0.02)
    gait, loads = gaits.pressed([gaits.box(0.25, 0.1)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -600]], seconds=0.1)
    sim.load(gait, loads)
    return sim._core


def test_plants_cannot_be_opened_once_a_recording_is_loaded():
    core = standing()
    with pytest.raises(ValueError, match="open_plants"):
        core.open_plants(0)
    core.run(6)  # and goes on as if nobody had asked
    assert core.report()["deepest_m"] > 0


def bare():
    return _native.Simulation(("flat", 0.0), [{}], 0.02)


@pytest.mark.parametrize("at", [2**63 - 1, 2**63 - 4, -(2**63), 2**55])
def test_windows_at_the_end_of_all_numbers_are_refused(at):
    core, out = bare(), np.zeros((8, 8), "f4")
    for i0, j0 in ((at, 0), (0, at)):
        for field in range(8):
            with pytest.raises(ValueError, match="reading a map"):
                core.read(field, i0, j0, out)
        with pytest.raises(ValueError, match="opening the frames"):
            core.open_frames(i0, j0, 2, 2, "")
        with pytest.raises(ValueError, match="laying a trail"):
            core.lay(i0, j0, out, out, out)
    core.open_plants(1)
    with pytest.raises(ValueError, match="grass"):
        core.read_lean(0, at, 0, out)
    core.read(0, 5, -5, out)


def test_what_is_refused_is_named_with_what_it_must_be():
    """A status of the core is a sentence about the arguments, never about all of them at once."""
    core, out, root = bare(), np.zeros((8, 8), "f4"), np.zeros((5, 2), "f4")
    core.open_plants(1)
    for words, ask in (
        ("out must hold a cell at least", lambda: core.read(0, 2**62, 0, out)),
        ("axis must be 0 to 2", lambda: core.read_lean(3, 0, 0, out)),
        ("compression, heap and pressure_time must be numbers of 0 or more", lambda: core.lay(0, 0, out, out - 1, out)),
        ("tiles_x and tiles_y must be 1 or more", lambda: core.open_frames(0, 0, 0, 3, "")),
        ("seconds must be 0 or more", lambda: core.rest_plants(-1.0)),
        ("vigour needs a number for each plant", lambda: core.vary_plants(3, np.zeros(2, "f4"))),
        ("a density above 0", lambda: _native.plants_place(0, 0, 1, 1, -3.0, None, 1, root)),
        ("0 to len.root. given roots", lambda: _native.plants_place(0, 0, 1, 1, 3.0, None, 1, root, 6)),
    ):
        with pytest.raises(ValueError, match=words):
            ask()


def test_more_tiles_than_can_be_are_refused():
    core = bare()
    for nx, ny in ((2**31 - 1, 1), (1 << 16, 1 << 16), (0, 3), (-2, -2)):
        with pytest.raises(ValueError, match="opening the frames"):
            core.open_frames(0, 0, nx, ny, "")
    with pytest.raises(OverflowError):
        core.open_frames(0, 0, 2**40, 1, "")


@pytest.mark.parametrize("field", ["ab", ["a", 0], 7, None, ("a",), ("a", "b"), ("a", 99), (3, 0)])
def test_what_is_no_field_of_a_map_is_named(field):
    film = bare().open_frames(0, 0, 1, 1, "")
    with pytest.raises(ValueError, match="not open"):
        film.write_maps("nowhere.exr", 0.0)
    with pytest.raises((TypeError, ValueError), match="open_maps|argument|str"):
        film.open_maps((("compression", 0), field), ())


@pytest.mark.parametrize("place, value", [(0, 1e12), (2, -1e300), (3, 0.0), (3, 1e200), (0, np.nan)])
def test_recordings_out_of_reach_are_refused(place, value):
    core = bare()
    gait, loads = gaits.pressed([gaits.box(0.25, 0.1)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -600]], seconds=0.1)
    sole = gait.soles[0]

    def load(pose):
        core.load(
            gait.time,
            gait.mass,
            pose,
            np.zeros(1, "i4"),
            np.zeros(1, "i4"),
            sole.vertices.astype("f4"),
            np.array([len(sole.vertices)], "i4"),
            sole.triangles.astype("i4"),
            np.array([len(sole.triangles)], "i4"),
            loads.touching,
            np.ascontiguousarray(loads.force),
            loads.point,
        )

    bad = gait.pose.copy()
    bad[0, 3, place] = value
    with pytest.raises(ValueError, match="loading the recording"):
        load(bad)
    with pytest.raises(ValueError, match="stepping"):
        core.run(5)  # nothing is loaded
    load(gait.pose.copy())
    core.run(5)


def test_a_simulation_in_use_says_so_to_other_threads():
    """Whoever comes second gets a sentence or waits; nobody gets half of a step."""
    core = standing()
    said, stop = set(), threading.Event()

    def ask():
        while not stop.wait(0.0005):  # who asked leaves room: else nobody's turn need ever come
            try:
                core.report()
                core.read(0, -8, -8, np.zeros((16, 16), "f4"))
            except RuntimeError as problem:
                said.add(str(problem))

    others = [threading.Thread(target=ask) for _ in range(3)]
    for other in others:
        other.start()
    for sample in range(1, 20):
        while True:
            try:
                core.run(sample)
                break
            except RuntimeError as problem:
                said.add(str(problem))
    stop.set()
    for other in others:
        other.join()
    assert said <= {"this simulation is already running in another thread"}
    alone = standing()
    alone.run(19)
    assert alone.report() == core.report()


@pytest.mark.parametrize("shape", [(2**31, 0), (0, 2**31), (2**33, 0), (0, 0), (0, 5)])
def test_windows_of_more_cells_than_there_are_numbers_for_are_refused(shape):
    core, out = bare(), np.zeros(shape, "f4")
    with pytest.raises(ValueError, match="reading a map"):
        core.read(0, 0, 0, out)
    core.open_plants(1)
    with pytest.raises(ValueError, match="grass"):
        core.read_lean(0, 0, 0, out)


def test_laws_that_there_are_not_are_refused():
    soils = [{}]
    for law, heap in ((3, 0), (-1, 0), (0, 7)):
        with pytest.raises(ValueError, match="law, heap"):
            _native.Simulation(("flat", 0.0), soils, 0.02, (0.0, 0.0), law, heap)


def test_steps_without_end_are_refused():
    kind = Kind().numbers()
    _, _, _, particles, bends = _native.plants_shape(kind)
    root, at = np.zeros((1, 3), "f4"), np.zeros((1, particles, 3), "f4")
    for steps in (-1, 2**31 - 1):
        with pytest.raises(ValueError, match="steps"):
            _native.plants_step(kind, 1, root, None, at, at.copy(), np.full((1, bends), 0.1), None, (), 0.01, steps, 1)
