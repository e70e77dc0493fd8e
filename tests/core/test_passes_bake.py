"""Passes are baked, and walked by the command line."""

import json
import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from desire_path.bake.bake import Bake, read_index
from desire_path.bake.options import BakeOptions, BakeOutput
from desire_path.errors import DesirePathError
from desire_path.ground import maps
from desire_path.ground.options import SimulationOptions
from desire_path.ground.plants import KINDS
from desire_path.ground.sim import Ground, Simulation
from desire_path.loads import walker
from desire_path.motion.scatter import Scatter
from tests.core.test_passes import REPO, recorded_walk

# ---- a bake of passes, and the command line --------------------------------------------------------------


@pytest.fixture(scope="module")
def walk():
    return recorded_walk()


def test_a_frame_may_be_a_pass(walk, tmp_path):
    gait = walk.along([(0, 0), (2, 0)], 3, pause=1.0)
    bake = Bake(gait, Ground.flat(), "mud", tmp_path / "passes", cell_size=0.02, options=BakeOptions(threads=1))
    told = list(bake.run())
    assert [progress.frame for progress in told] == [1, 2, 3] and told[-1].fraction == 1.0
    index = read_index(tmp_path / "passes")
    assert index.complete and index.frames == 3 and bake.report["passes"] == 3
    pressed = [maps.read(index.path(n)).planes["B"] for n in range(4)]
    assert not pressed[0].any()
    assert all((b >= a - 1e-7).all() and b.sum() > a.sum() for a, b in zip(pressed, pressed[1:]))
    names = sorted(path.name for path in (tmp_path / "passes" / "maps").iterdir())
    assert names == ["pass_0001.exr", "pass_0002.exr", "pass_0003.exr"]
    second = maps.read(tmp_path / "passes" / "maps" / "pass_0002.exr")
    assert np.array_equal(second.planes["compression"], pressed[2])
    assert second.notes["time"] == pytest.approx(gait.time[gait.cut[-1]] - gait.time[0], abs=1.1)

    every = Bake(
        gait,
        Ground.flat(),
        "mud",
        tmp_path / "frames",
        cell_size=0.02,
        options=BakeOptions(threads=1),
        output=BakeOutput(film="frames"),
    )
    for _ in every.run():
        pass
    last = read_index(tmp_path / "frames")
    assert last.frames == int((gait.time[-1] - gait.time[0]) * 60 + 1e-6) + 1
    final = [maps.read(tmp_path / name / "maps_final.exr").planes for name in ("passes", "frames")]
    volume = [planes["compression"].sum() for planes in final]
    assert volume[0] == pytest.approx(volume[1], rel=0.03)  # steps of 60 and of 120 a second
    with pytest.raises(DesirePathError, match="no film"):
        Bake(gait, Ground.flat(), output=BakeOutput(film="reel"))


def test_no_print_is_drawn_from_the_end_of_a_pass_to_the_start_of_the_next(walk):
    """Passes one way: a jump back over the whole path, and over bare ground to a second walker's path."""
    line = [(0, 0), (2, 0)]
    gait = walk.along(line, 2, back_and_forth=False, scatter=Scatter(lateral=0, timing=0, stride=0))
    sim = Simulation(Ground.flat(), "mud", 0.02, options=SimulationOptions(threads=1))
    sim.load(gait, walker.loads(gait))
    sim.run(gait.cut[0] - 1)
    window = sim.reach()
    window = (window[0], window[2], window[1] - window[0], window[3] - window[2])
    once = sim.read("pressure_time", *window)
    sim.run(gait.cut[0])
    assert once.any() and np.array_equal(sim.read("pressure_time", *window), once)
    sim.run(len(gait.time) - 1)
    twice = sim.read("pressure_time", *window)
    assert ((twice > 0) == (once > 0)).all()


def command(*words, cwd):
    env = {**os.environ, "PYTHONPATH": str(REPO / "addon")}
    return subprocess.run(
        [sys.executable, "-m", "desire_path", *map(str, words)], capture_output=True, text=True, env=env, cwd=cwd
    )


def test_the_command_line_walks_passes(walk, tmp_path):
    walk.save(tmp_path / "walk.npz")
    (tmp_path / "path.csv").write_text("x,y\n0,0\n1.5,0\n1.5,1.5\n")
    replace(KINDS["carex"], strength=0.1, break_angle=2.0).save(tmp_path / "frail.json")
    done = command(
        "bake",
        "walk.npz",
        "--passes",
        3,
        "--along",
        "path.csv",
        "--plants",
        "frail.json:30",
        "--cell",
        0.02,
        "--soil",
        "soil",
        "--out",
        "out",
        cwd=tmp_path,
    )
    assert done.returncode == 0, done.stderr
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["passes"] == 3 and report["contacts"] >= 9
    assert not [each for each in report["warnings"] if "jumps" not in each]  # the clip begins with a pose alone
    index = read_index(tmp_path / "out")
    assert index.frames == 3 and index.lean
    cover = [maps.read(index.path(n)).planes["G"].sum() for n in range(4)]
    assert cover[0] >= cover[1] >= cover[2] >= cover[3] and cover[0] > cover[3]
    final = maps.read(tmp_path / "out" / "maps_final.exr").planes
    assert {"compression", "heap", "pressure_time", "plant_strength", "lean_x", "lean_y", "crushed"} <= set(final)


def test_feet_are_placed_along_a_path_whether_asked_or_not(walk, tmp_path):
    walk.save(tmp_path / "walk.npz")
    (tmp_path / "path.csv").write_text("x,y\n0,0\n1.5,0\n")
    for more in ((), ("--place-feet",)):
        done = command("bake", "walk.npz", "--along", "path.csv", *more, "--out", f"out{len(more)}", cwd=tmp_path)
        assert done.returncode == 0, done.stderr
    one, two = (maps.read(tmp_path / f"out{k}" / "maps_final.exr").planes["compression"] for k in (0, 1))
    assert np.array_equal(one, two) and one.max() > 0.005


@pytest.mark.parametrize(
    "words, told",
    [
        (("--passes", 3), "--along"),
        (("--along", "nothing.csv"), "nothing.csv"),
        (("--along", "path.csv", "--passes", 0), "0 passes"),
        (("--plants", "nettle"), "nettle"),
        (("--plants", "carex:many"), "carex:many"),
        (("--along", "path.csv", "--seed", -1), "seed of -1"),
    ],
)
def test_bad_words_are_one_sentence(walk, tmp_path, words, told):
    walk.save(tmp_path / "walk.npz")
    (tmp_path / "path.csv").write_text("x,y\n0,0\n1.5,0\n")
    done = command("bake", "walk.npz", *words, "--out", "out", cwd=tmp_path)
    assert done.returncode == 1 and told in done.stderr and done.stderr.count("\n") == 1, done.stderr
