"""Films of one ground: several may be open, each sees its own rectangle of the same ground."""

import numpy as np
import pytest

from desire_path.ground import maps
from desire_path.ground.options import SimulationOptions
from desire_path.ground.sim import TILE, Ground, Simulation
from tests.scenes import gaits


@pytest.fixture
def trodden():
    """A simulation whose foot stands over the corner of four tiles, and the samples of its walk."""
    gait, loads = gaits.pressed(
        [gaits.box(0.25, 0.11)], [[0.02, 0.01, 0, 1, 0, 0, 0]], [[0, 0, -700]], seconds=0.5, rate=60.0, lift=0.5
    )
    sim = Simulation(Ground.flat(), "mud", 0.01, options=SimulationOptions(threads=2))
    sim.load(gait, loads)
    return sim, len(gait.time)


def test_films_side_by_side_are_the_film_of_the_whole(trodden, tmp_path):
    sim, samples = trodden
    whole = sim.open_frames(-1, -1, 2, 2)
    parts = {(tx, ty): sim.open_frames(tx, ty, 1, 1) for tx in (-1, 0) for ty in (-1, 0)}
    for number, sample in enumerate((samples // 3, samples - 1)):
        sim.run(sample)
        whole.write_frame(tmp_path / f"whole{number}.exr", 0.0)
        for at, film in parts.items():
            film.write_frame(tmp_path / f"part{number}{at}.exr", 0.0)
    sim.flush()
    for number in (0, 1):
        planes = maps.read(tmp_path / f"whole{number}.exr").planes
        for (tx, ty), _ in parts.items():
            part = maps.read(tmp_path / f"part{number}{(tx, ty)}.exr").planes
            j, i = (ty + 1) * TILE, (tx + 1) * TILE
            for name, plane in part.items():
                assert plane[...].tobytes() == np.ascontiguousarray(planes[name][j : j + TILE, i : i + TILE]).tobytes()
            assert part["B"].any()


def test_a_film_opened_late_or_closed_early_leaves_the_others_be(trodden, tmp_path):
    sim, samples = trodden
    early, first = sim.open_frames(-1, -1, 2, 2), sim.open_frames(0, 0, 1, 1)
    sim.run(samples // 2)
    first.write_frame(tmp_path / "first.exr", 0.0)
    del first
    late = sim.open_frames(-1, -1, 2, 2)
    sim.run(samples - 1)
    for name, film in (("early", early), ("late", late)):
        film.write_frame(tmp_path / f"{name}.exr", 1.0)
        film.open_maps(["compression", "heap"], [("cell", 0.01)])
        film.write_maps(tmp_path / f"{name}_maps.exr", 1.0)
    sim.flush()
    assert (tmp_path / "first.exr").exists()
    for name in ("{}.exr", "{}_maps.exr"):
        assert (tmp_path / name.format("early")).read_bytes() == (tmp_path / name.format("late")).read_bytes()


def test_a_film_outlives_its_simulation(trodden, tmp_path):
    film = trodden[0].open_frames(0, 0, 1, 1)
    del trodden
    film.write_frame(tmp_path / "a.exr", 0.0)
    with pytest.raises(ValueError, match="not open"):
        film.write_maps(tmp_path / "b.exr", 0.0)


def test_pressure_is_there_while_somebody_stands_and_nowhere_else(trodden, tmp_path):
    sim, samples = trodden
    film = sim.open_frames(-1, -1, 2, 2)
    film.open_maps(["compression", "pressure"], [("cell", 0.01)])
    window = (-TILE, -TILE, 2 * TILE, 2 * TILE)
    for name, sample in (("before", 0), ("stands", 12), ("still", 20), ("gone", samples - 1)):
        sim.run(sample)
        film.write_maps(tmp_path / f"{name}.exr", 0.0)
        now = sim.read("pressure", *window)
        assert now.sum(dtype=float) * 1e-4 == pytest.approx(700.0 if name in ("stands", "still") else 0.0, abs=1e-3), (
            name
        )
        assert not now.any() or (np.count_nonzero(now) * 1e-4 == pytest.approx(0.25 * 0.11, rel=0.2))
    sim.flush()
    planes = {name: maps.read(tmp_path / f"{name}.exr").planes for name in ("before", "stands", "still", "gone")}
    for name, there in planes.items():
        assert there["pressure"].any() == (name in ("stands", "still")), name
    assert planes["gone"]["compression"].any()
    sim.run(samples - 1)
    sim.settle()
    assert not sim.read("pressure", *window).any()


def test_pressure_of_every_step_is_that_of_who_presses_then(trodden, tmp_path):
    """Where a sole has left, and nothing else changed, its tile is written once more."""
    sim, samples = trodden
    film = sim.open_frames(-1, -1, 2, 2)
    film.open_maps(["pressure"], [("cell", 0.01)])
    wanted = []
    for sample in range(samples):
        sim.run(sample)
        film.write_maps(tmp_path / f"{sample}.exr", 0.0)
        wanted.append(sim.read("pressure", -TILE, -TILE, 2 * TILE, 2 * TILE))
    sim.flush()
    assert any(each.any() for each in wanted) and not wanted[-1].any()
    for sample, each in enumerate(wanted):
        np.testing.assert_array_equal(maps.read(tmp_path / f"{sample}.exr").planes["pressure"], each)
