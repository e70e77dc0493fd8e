"""What a bake takes is estimated before anything is written, and refused with the numbers where it is too much."""

import math
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from desire_path import bounds
from desire_path.bake.bake import Bake, read_index
from desire_path.bake.options import BakeOptions
from desire_path.bounds import Limits
from desire_path.errors import DesirePathError
from desire_path.files import disk
from desire_path.ground.options import SimulationOptions
from desire_path.ground.plants import Planting
from desire_path.ground.sim import Ground, Simulation
from desire_path.loads import walker
from desire_path.motion.gait import Gait
from desire_path.study.trampling import WALK
from tests.core.test_bake import baked, sentence, standing

REPO = Path(__file__).resolve().parents[2]


def refused(folder, gait=None, **more):
    """The sentence; nothing is written, and no ground was looked at for it."""
    with pytest.MonkeyPatch.context() as patch, pytest.raises(DesirePathError) as error:
        patch.setattr(Simulation, "read", lambda *_: pytest.fail("the work began before its bounds were held"))
        baked(folder, gait, **more)
    assert not os.path.exists(folder)
    return sentence(error)


def striding(seconds):
    """Somebody who stands for as long as wanted, in two samples."""
    gait = standing()
    ends = [0, -1]
    return replace(gait, time=[0.0, seconds], com=gait.com[:, ends], pose=gait.pose[:, ends])


def test_frames_without_end_are_refused(tmp_path):
    text = refused(tmp_path / "bake", frame_end=10**9)
    assert "1,000,000,000 frames" in text and "250,000 are the limit" in text
    text = refused(tmp_path / "bake", limits=Limits(frames=10))
    assert "49 frames, and 10 are the limit" in text
    baked(tmp_path / "bake", limits=Limits(frames=49))


def test_a_walk_without_end_is_refused_before_its_samples_are_made(tmp_path):
    text = refused(tmp_path / "bake", striding(1e7), frame_end=20)
    assert "10,000,000 seconds of walking, and 86,400 are the limit" in text
    text = refused(tmp_path / "bake", striding(1e7), frame_end=20, limits=Limits(seconds=1e12, memory=8e9))
    assert "GB of memory, and 8 GB are the limit" in text
    with pytest.raises(DesirePathError, match="GB of memory"):
        striding(1e10).resample(240.0)


def test_pauses_between_passes_are_no_walking(tmp_path):
    """A week in which nobody comes is not simulated."""
    week = 7 * 86400.0
    bake = Bake(Gait.load(WALK).along([[0, 0], [3, 0]], 2, pause=week), Ground.flat(), "mud", tmp_path, cell_size=0.05)
    assert bake.gait.time[-1] > week
    for _ in bake.run():
        pass
    assert read_index(tmp_path).complete


@pytest.mark.parametrize("frames", [(1, math.inf), (math.nan, 5), ("x", 5), (1, [2])])
def test_frames_that_are_no_numbers_are_a_sentence(tmp_path, frames):
    assert "whole numbers" in refused(tmp_path / "bake", frame_start=frames[0], frame_end=frames[1])


def test_a_recording_out_of_all_time_is_a_sentence():
    gait = standing()
    for wrong in (replace(gait, time=np.linspace(0.0, 1e308, len(gait.time))), replace(gait, frame_rate=1e300)):
        with pytest.raises(DesirePathError, match="which no scene does") as error:
            wrong.check()
        sentence(error)


def test_a_picture_that_is_too_large_is_refused(tmp_path):
    """Two feet far apart: what lies between them need not be in the picture, but is in maps."""
    there = standing()

    def apart(x):
        other = replace(there, pose=there.pose + [x, x, 0, 0, 0, 0, 0], com=there.com + [x, x, 0])
        return Gait.join([there, other])

    text = refused(tmp_path / "bake", apart(700), limits=Limits(memory=1e12, disk=1e15))
    assert "4,294,967,296 are the most: choose cells of" in text
    far = apart(200)
    text = refused(tmp_path / "bake", far, cell_size=0.05, limits=Limits(cells=1000))
    assert "cells in a picture" in text and "1,000 are the limit" in text
    text = refused(tmp_path / "bake", far, cell_size=0.05, limits=Limits(memory=1e8))
    assert "GB of memory, and 0.1 GB are the limit" in text


def test_the_disk_counts(tmp_path, monkeypatch):
    text = refused(tmp_path / "bake", limits=Limits(disk=1e4))
    assert "kB on the disk, and 10 kB are the limit" in text
    monkeypatch.setattr(bounds.shutil, "disk_usage", lambda folder: type("usage", (), {"free": 20_000})())
    text = refused(tmp_path / "bake")
    assert "on the disk, and 20 kB are free" in text and "make room" in text
    baked(tmp_path / "bake", limits=Limits(disk=1e9))


def test_memory_that_is_not_there_counts(tmp_path, monkeypatch):
    assert 1e6 < disk.memory_free() < 1e15
    monkeypatch.setattr(disk, "memory_free", lambda: 1e5)
    assert "memory, and 0.1 MB are free" in refused(tmp_path / "bake")


def test_plants_count(tmp_path):
    grown = [Planting("lawn", 50_000.0)]
    text = refused(tmp_path / "bake", plants=grown, limits=Limits(plants=100_000))
    assert "plants, and 100,000 are the limit" in text and "density" in text
    text = refused(tmp_path / "bake", plants=[Planting("lawn", 100_000.0)], limits=Limits(plants=1e9, memory=1e6))
    assert "GB of memory" in text
    text = refused(tmp_path / "bake", plants=[Planting("lawn", 3000.0)], plant_mesh=True, limits=Limits(disk=5e6))
    assert "GB on the disk, and 5 MB are" in text


@pytest.mark.parametrize("cell", [0.005, 0.02])
def test_frames_take_about_what_is_estimated(tmp_path, cell):
    """Not more than twice what they take, so that a bake that would fit is not refused, and not a tenth."""
    bake = Bake(Gait.load(WALK), Ground.flat(), "mud", tmp_path, cell_size=cell, options=BakeOptions(threads=2))
    for _ in bake.run():
        pass
    index = read_index(tmp_path)
    taken = sum(os.path.getsize(index.path(n)) for n in range(index.frames + 1))
    area = bounds.pressed_area(bake.gait, bake.loads.touching)
    told = index.frames * bounds.frame_bytes(index.nx * index.ny, area / cell**2, False)
    assert 0.1 * taken < told < 2.0 * taken, (told, taken)


def test_limits_are_read_from_words():
    assert Limits.read(["frames=12", "memory=3", "disk=0.5"]) == Limits(frames=12, memory=3e9, disk=5e8)
    assert Limits.read([]) == Limits()
    for words in ("frames", "frames=", "frames=x", "tiles=3", "=3", "frames=-1", "memory=0", "cells=nan"):
        with pytest.raises(DesirePathError) as error:
            Limits.read([words])
        sentence(error)
    with pytest.raises(DesirePathError):
        Limits(memory=True)
    Limits(frames=math.inf).check("frames", 10**12)


def test_the_command_says_what_is_too_much(tmp_path):
    run = lambda *more: subprocess.run(
        [
            sys.executable,
            "-m",
            "desire_path",
            "bake",
            str(WALK),
            "--cell",
            "0.05",
            "--out",
            str(tmp_path / "bake"),
            *more,
        ],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(REPO / "addon")},
    )
    done = run("--limit", "frames=20", "memory=100")
    assert done.returncode == 1 and "20 are the limit" in done.stderr and not (tmp_path / "bake").exists()
    assert run("--limit", "frames=2000").returncode == 0 and read_index(tmp_path / "bake").complete


STARVED = """
import resource, sys
import numpy, desire_path.bake.bake, desire_path.study.trampling, desire_path._native
from desire_path.__main__ import main
def deep(calls):  # the stack has grown as far as it needs to: a system that refuses that ends the process itself
    return calls and sorted([calls], key=lambda _: deep(calls - 1))
sys.setrecursionlimit(4000)
deep(400)
pages = int(open("/proc/self/statm").read().split()[0])
resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + (int(sys.argv[1]) << 20),) * 2)
sys.exit(main(sys.argv[2:]))
"""


@pytest.mark.parametrize("megabytes", [0, 2, 7, 9, 12, 16, 24, 32])
def test_a_command_without_memory_is_a_sentence(tmp_path, megabytes):
    """The system gives no more at some point: whatever asks first says so."""
    done = subprocess.run(
        [
            sys.executable,
            "-c",
            STARVED,
            str(megabytes),
            "bake",
            str(WALK),
            "--cell",
            "0.005",
            "--threads",
            "1",
            "--frame-end",
            "9",
            "--out",
            str(tmp_path / "bake"),
        ],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(REPO / "addon"), "OPENBLAS_NUM_THREADS": "1"},
    )
    assert "Traceback" not in done.stderr, done.stderr[-2000:]
    if done.returncode == 127 and "thread-local" in done.stderr:
        return  # the C library found no memory for a thread, and ends the process itself
    if done.returncode:
        assert done.returncode == 1 and "memory" in done.stderr and len(done.stderr.strip().splitlines()) == 1, done
    assert megabytes >= bounds.RESERVE >> 20 or done.returncode


def test_a_simulation_keeps_its_limits_too():
    with pytest.raises(DesirePathError, match="limit of plants"):
        sim = Simulation(Ground.flat(), "mud", plants=["lawn"], options=SimulationOptions(limits=Limits(plants=10)))
        gait = standing().resample(120.0)
        sim.load(gait, walker.loads(gait, ground=sim.rest_height))
