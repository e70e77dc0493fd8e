"""Tracks by the command line."""

import json

import numpy as np
import pytest

from desire_path.ground import maps
from desire_path.placement.path import Path
from tests.core.test_cli import run

# ---- the command ----------------------------------------------------------------------------------


@pytest.fixture
def curve(tmp_path):
    path = tmp_path / "path.csv"
    path.write_text("x,y\n0,0\n2,0\n3,1\n")
    return path


def test_track_bakes_a_folder(tmp_path, curve):
    done = run("track", "--along", curve, "--stamp", "boot", "--spacing", 0.7, "--mass", 80, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    length = Path([(0, 0), (2, 0), (3, 1)]).length
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["contacts"] == int(length / 0.7) + 1 and report["deepest_m"] > 0.005 and not report["warnings"]
    assert (tmp_path / "out" / "maps_final.exr").exists()


def test_track_shows_stamps_that_come_down_one_by_one(tmp_path, curve):
    more = ("--count", 3, "--film", "frames", "--cell", 0.02, "--frame-rate", 12)
    done = run("track", "--along", curve, *more, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["contacts"] == 3 and len(list((tmp_path / "out" / "frames").glob("trail_*.exr"))) > 10


def test_what_sticks_to_a_stamp_flies_off_it(tmp_path, curve):
    more = ("--count", 3, "--spray", "sand", "--spray-set", "slow_speed=0.01", "--cell", 0.02, "--frame-rate", 12)
    done = run("track", "--along", curve, *more, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "out" / "report.json").read_text())["spray_thrown_m3"] > 0.0


def test_track_presses_a_picture(tmp_path, curve):
    maps.write(tmp_path / "stamp.exr", {"Y": np.ones((30, 10))})
    more = ("--stamp", tmp_path / "stamp.exr", "--stamp-length", 0.2, "--depth", 0.02, "--count", 2)
    done = run("track", "--along", curve, *more, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "out" / "report.json").read_text())["deepest_m"] == pytest.approx(0.02, abs=1e-4)
    (tmp_path / "none.exr").write_text("no picture")
    done = run("track", "--along", curve, "--stamp", tmp_path / "none.exr", "--out", tmp_path / "none")
    assert done.returncode == 1 and "no flat OpenEXR image" in done.stderr and not (tmp_path / "none").exists()


def test_track_rolls_a_pair_of_wheels(tmp_path, curve):
    more = ("--wheel", 0.3, "--tyre-width", 0.15, "--tread", "bars", "--gauge", 1.2, "--depth", 0.02, "--cell", 0.02)
    done = run("track", "--along", curve, *more, "--soil", "mud", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "out" / "report.json").read_text())["deepest_m"] == pytest.approx(0.02, abs=0.002)


@pytest.mark.parametrize(
    "more, says",
    [
        (("--stamp", "slipper"), "no stamp 'slipper'"),
        (("--spacing", "0"), "spacing of 0 m"),
        (("--mass", "-3"), "mass of -3 kg"),
        (("--wheel", "0"), "radius of 0 m"),
        (("--wheel", "0.3", "--spacing", "1"), "--spacing is of stamps"),
        (("--gauge", "1"), "--gauge is of wheels"),
        (("--seed", "1"), "--seed is of chance"),
        (("--seed", "-1", "--scatter", "0.1"), "seed of -1"),
        (("--frame-rate", "0"), "0 frames a second"),
        (("--spray", "dust"), "no spray 'dust'"),
    ],
)
def test_track_refuses_in_one_sentence(tmp_path, curve, more, says):
    done = run("track", "--along", curve, *more, "--out", tmp_path / "out")
    assert done.returncode == 1 and says in done.stderr and len(done.stderr.splitlines()) == 1
    assert not (tmp_path / "out").exists()


def test_track_refuses_an_empty_table(tmp_path):
    (tmp_path / "none.csv").write_text("x,y\n")
    done = run("track", "--along", tmp_path / "none.csv", "--out", tmp_path / "out")
    assert done.returncode == 1 and "at least two rows" in done.stderr
