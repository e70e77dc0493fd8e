"""What sticks, flies and lands: nothing is lost, it is the same wherever and however it is computed. MODEL 11.24"""

import json
import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from desire_path.bake.bake import Bake, read_index
from desire_path.errors import DesirePathError
from desire_path.ground import maps, spray
from desire_path.ground.options import SimulationOptions
from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.spray import SPRAYS, Spray
from tests.scenes import gaits
from tests.scenes.records import for_bake

REPO = Path(__file__).resolve().parents[2]
FAST = {"speed": 3.2, "rate": 120.0}
GRAINS = Spray(adhesion=0.002, hold_time=0.04, slow_speed=1.0, fast_speed=4.0, particle_size=0.006)


def run(length=2.4, *, cell=0.02, spray=GRAINS, ground=None, threads=1, turn=0.0, mirror=False, rate=120.0, y=0.0):
    """A Simulation that has been walked over at a run's speed, its last grains still in the air."""
    gait, loads = gaits.strides(length, **{**FAST, "rate": rate, "y": y})
    if mirror:
        pose = np.array(gait.pose)
        pose[:, :, 1] *= -1.0
        loads.point[:, :, 1] *= -1.0
        soles = []
        for sole in gait.soles:
            vertices = np.array(sole.vertices)
            vertices[:, 1] *= -1.0
            soles.append(replace(sole, vertices=vertices))
        gait = replace(gait, pose=pose, soles=soles)
    if turn:
        c, s = math.cos(turn), math.sin(turn)
        to = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]).round(12)
        pose = np.array(gait.pose)
        pose[:, :, :3] = gait.pose[:, :, :3] @ to.T
        pose[:, :, 3], pose[:, :, 6] = math.cos(0.5 * turn), math.sin(0.5 * turn)
        gait = replace(gait, pose=pose)
        loads.point, loads.force = loads.point @ to.T, loads.force @ to.T
    sim = Simulation(ground or Ground.flat(), "dry-sand", cell, options=SimulationOptions(spray=spray, threads=threads))
    sim.load(gait, loads)
    sim.run(len(gait.time))
    return sim


@pytest.fixture(scope="module")
def walked():
    return run()


def test_the_ledger_balances_with_what_is_in_the_air(walked):
    told = walked.report()
    assert told["thrown_m3"] > 5e-5 and told["airborne_m3"] > 0.0 and told["beside_m3"] == 0.0
    laid = told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"]
    away = told["stuck_m3"] + told["airborne_m3"]
    assert told["heaped_m3"] + away == pytest.approx(laid, rel=1e-6)
    assert len(walked.grains()) * GRAINS.volume == pytest.approx(told["airborne_m3"])


def test_a_mirrored_walk_throws_mirrored_grains(walked):
    mirrored = run(mirror=True).grains()
    at = walked.grains()
    assert len(at) == len(mirrored) > 50
    np.testing.assert_allclose(mirrored.position, at.position * [1.0, -1.0, 1.0], atol=1e-9)
    np.testing.assert_allclose(mirrored.velocity, at.velocity * [1.0, -1.0, 1.0], atol=1e-7)


def test_a_turned_walk_throws_turned_grains(walked):
    turned = run(turn=0.5 * math.pi).grains()
    at = walked.grains()
    assert abs(len(at) - len(turned)) <= 0.01 * len(at)
    both = np.isin(at.name, turned.name), np.isin(turned.name, at.name)
    np.testing.assert_allclose(
        turned.position[both[1]].mean(axis=0),
        (at.position[both[0]] @ [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]).mean(axis=0),
        atol=0.02,
    )


def test_threads_change_no_bit(walked):
    more = run(threads=4)
    for name in ("position", "velocity", "soil", "name"):
        np.testing.assert_array_equal(getattr(more.grains(), name), getattr(walked.grains(), name))
    window = -60, -40, 300, 80
    np.testing.assert_array_equal(more.read("heap", *window), walked.read("heap", *window))


@pytest.mark.parametrize("more", [{"cell": 0.01}, {"rate": 240.0}, {"spray": replace(GRAINS, particle_size=0.004)}])
def test_cells_rates_and_sizes_hardly_change_how_much_flies(walked, more):
    """Of the same adhesion."""
    told, other = walked.report()["thrown_m3"], run(**more).report()["thrown_m3"]
    assert other == pytest.approx(told, rel=0.06)


def test_it_flies_back_and_up_from_feet_that_swing_ahead(walked):
    """A foot is lifted at its rear and swung ahead: what comes off has its speed, and no more."""
    grains = walked.grains()
    fastest = np.linalg.norm(grains.velocity, axis=1).max()
    assert 0.0 < fastest < 1.5 * 3.2 / 0.4 * 1.4
    assert (grains.velocity[:, 0] > 0.0).mean() > 0.9
    assert (grains.position[:, 2] >= -0.05).all() and grains.position[:, 2].max() < 3.0


def test_beside_the_ground_it_is_counted():
    """Ground so narrow that much of it falls by."""
    vertices = np.array([[-1, -0.15, 0], [1.7, -0.15, 0], [1.7, 0.15, 0], [-1, 0.15, 0]], float)
    told = run(ground=Ground.mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]])), length=4.5).report()
    laid = told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"]
    away = told["stuck_m3"] + told["airborne_m3"] + told["beside_m3"]
    assert told["beside_m3"] > 0.05 * told["thrown_m3"]
    assert told["heaped_m3"] + away == pytest.approx(laid, rel=1e-6)


def test_without_spray_nothing_is_thrown():
    sim = run(spray=None)
    assert len(sim.grains()) == 0 and "thrown_m3" not in sim.report()


# ---- bakes ---------------------------------------------------------------------------------------


def bake_of(folder, **more):
    gait, _ = gaits.strides(2.4, speed=3.2, rate=24.0)
    options = for_bake(**{"threads": 1, "cell_size": 0.02, "spray": GRAINS, **more})
    return Bake(gait, Ground.flat(), "dry-sand", folder, **options)


@pytest.fixture(scope="module")
def baked(tmp_path_factory):
    folder = tmp_path_factory.mktemp("spray")
    bake = bake_of(folder)
    for _ in bake.run():
        pass
    return folder, bake


def test_a_bake_writes_what_flies_in_each_frame(baked):
    folder, bake = baked
    index = read_index(folder)
    counts = [len(spray.read_frame(index.spray_path(number))) for number in range(index.frames + 1)]
    assert index.complete and index.grain_size == pytest.approx(0.006)
    assert counts[0] == 0 and max(counts) == index.most_grains() > 100
    told = bake.report
    assert counts[-1] * GRAINS.volume == pytest.approx(told["spray_airborne_m3"])
    assert told["parameters"]["spray"]["adhesion"] == 0.002
    laid = told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"]
    heaped = maps.read(folder / "maps_final.exr").planes["heap"].astype(float).sum() * 0.02**2
    assert heaped + told["spray_airborne_m3"] + told["spray_stuck_m3"] == pytest.approx(laid, rel=1e-5)


def test_a_bake_that_goes_on_leaves_the_same_files(baked, tmp_path):
    steps = bake_of(tmp_path).run()
    for _ in range(9):
        next(steps)
    steps.close()
    assert read_index(tmp_path).frames == 9
    bake = bake_of(tmp_path)
    for _ in bake.run():
        pass
    assert bake.report["contacts"] == baked[1].report["contacts"]
    first, second = (
        {path.name: path.read_bytes() for path in Path(folder, "frames").glob("*") if path.name != "index.json"}
        for folder in (baked[0], tmp_path)
    )
    assert first == second


def test_frames_that_are_damaged_are_no_frames(baked, tmp_path):
    index = read_index(baked[0])
    at = Path(index.spray_path(5))
    whole = at.read_bytes()
    try:
        at.write_bytes(whole[:-3])
        assert read_index(baked[0]).frames == 4
    finally:
        at.write_bytes(whole)
    with pytest.raises(DesirePathError, match="no frame of a spray"):
        spray.read_frame(index.path(5))


# ---- what is asked for ---------------------------------------------------------------------------


def test_files_and_words_of_a_spray(tmp_path):
    mine = SPRAYS["mud"].changed(["adhesion=0.004", "scatter=0"])
    mine.save(tmp_path / "mine.json")
    assert Spray.load(tmp_path / "mine.json") == mine == spray.as_spray(str(tmp_path / "mine.json"))
    assert spray.as_spray("snow") is SPRAYS["snow"] and spray.as_spray(None) is None


@pytest.mark.parametrize(
    "what, said",
    [
        (lambda: SimulationOptions(spray="dust"), "There is no spray 'dust': choose one of sand, mud, snow"),
        (lambda: SimulationOptions(spray=3), "There is no spray '3'"),
        (lambda: Spray(particle_size=0.0), "particle_size of 0 cannot be used"),
        (lambda: Spray(adhesion=math.nan), "adhesion of nan cannot be used"),
        (lambda: Spray(slow_speed=5.0), "slow_speed of 5 m/s is not below its fast_speed"),
        (lambda: Spray().changed(["stickiness=1"]), "No spray has 'stickiness'"),
        (lambda: Spray().changed(["adhesion=much"]), "'much' is no number"),
    ],
)
def test_what_cannot_be_is_said_in_a_sentence(what, said):
    with pytest.raises(DesirePathError, match=said):
        what()


def test_grains_too_small_are_refused_before_anything_is_written(tmp_path):
    fine = Spray(adhesion=0.01, particle_size=0.0005)
    with pytest.raises(DesirePathError, match="too many on the sole of bone .*: choose a particle_size of") as told:
        next(bake_of(tmp_path, spray=fine).run())
    assert not list(tmp_path.glob("frames*"))
    size = float(str(told.value).split("particle_size of ")[1].split(" m")[0])
    gait, _ = gaits.strides(1.0)
    spray.check_soles(replace(fine, particle_size=size), gait.soles, ["a", "b"])


def test_the_command_line_tells_what_was_thrown(tmp_path):
    gait, _ = gaits.strides(1.6, speed=3.2, rate=24.0)
    gait.save(tmp_path / "walk.npz")
    command = [sys.executable, "-m", "desire_path", "bake", str(tmp_path / "walk.npz"), "--cell", "0.02"]
    command += ["--out", str(tmp_path / "out"), "--spray", "sand", "--spray-set", "particle_size=0.006"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=REPO / "addon", check=False)
    assert done.returncode == 0, done.stderr
    assert "thrown  " in done.stdout and " l stick" in done.stdout
    told = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert told["parameters"]["spray"]["particle_size"] == 0.006 and told["spray_thrown_m3"] > 0.0
    wrong = subprocess.run(
        [*command[:-4], "--spray-set", "adhesion=0.001"],
        capture_output=True,
        text=True,
        cwd=REPO / "addon",
        check=False,
    )
    assert wrong.returncode == 1 and "add --spray sand" in wrong.stderr
