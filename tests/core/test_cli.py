"""python -m desire_path, as a farm calls it."""

import csv
import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from desire_path.bake.bake import Bake
from desire_path.bake.options import BakeOptions
from desire_path.errors import DesirePathError
from desire_path.ground import maps
from desire_path.ground.sim import Ground
from desire_path.ground.soil import SOILS
from desire_path.loads import walker
from tests.core.test_bake import standing

REPO = Path(__file__).resolve().parents[2]


def run(*arguments, cwd=None):
    environment = {**os.environ, "PYTHONPATH": str(REPO / "addon")}
    return subprocess.run(
        [sys.executable, "-m", "desire_path", *map(str, arguments)],
        cwd=cwd,
        capture_output=True,
        text=True,
        env=environment,
    )


@pytest.fixture
def walk(tmp_path):
    path = tmp_path / "walk.npz"
    standing().save(path)
    return path


def test_bake_on_flat_ground(tmp_path, walk):
    done = run("bake", walk, "--ground", "flat", "--soil", "dry-sand", "--cell", "0.01", "--out", tmp_path / "folder")
    assert done.returncode == 0, done.stderr
    assert "contacts      1" in done.stdout and "deepest" in done.stdout
    report = json.loads((tmp_path / "folder" / "report.json").read_text())
    assert report["contacts"] == 1
    assert (tmp_path / "folder" / "maps_final.exr").exists()


def test_a_soil_is_taken_from_a_file_and_changed(tmp_path, walk):
    replace(SOILS["mud"], layer_depth=0.5).save(tmp_path / "mine.json")
    done = run(
        *("bake", walk, "--soil", tmp_path / "mine.json", "--soil-set", "young_modulus=2.5e5", "--soil-set"),
        *("settle_time=0.2", "--cell", "0.02", "--out", tmp_path / "folder"),
    )
    assert done.returncode == 0, done.stderr
    told = json.loads((tmp_path / "folder" / "report.json").read_text())["parameters"]["soils"]
    assert told == [replace(SOILS["mud"], layer_depth=0.5, young_modulus=2.5e5, settle_time=0.2).parameters()]


def test_a_soil_changes_over_the_walk(tmp_path, walk):
    (tmp_path / "keys.json").write_text('{"young_modulus": [[0, 2.5e5], [0.3, 1e6]]}')
    words = ("--soil", "mud", "--soil-keys", tmp_path / "keys.json", "--cell", "0.02", "--out", tmp_path / "folder")
    done = run("bake", walk, *words)
    assert done.returncode == 0, done.stderr
    told = json.loads((tmp_path / "folder" / "report.json").read_text())["parameters"]["soils"]
    assert told == [{**SOILS["mud"].parameters(), "keys": {"young_modulus": [[0.0, 2.5e5], [0.3, 1e6]]}}]


def test_kinds_add_up_however_they_are_listed(tmp_path, walk):
    told = []
    for words in (("--plants", "carex:20", "moss:40"), ("--plants", "carex:20", "--plants", "moss:40")):
        done = run("bake", walk, *words, "--cell", "0.02", "--out", tmp_path / "folder")
        assert done.returncode == 0, done.stderr
        told.append(json.loads((tmp_path / "folder" / "report.json").read_text())["plants"])
    assert told[0] == told[1] > 0


def test_feet_are_placed_on_a_hill(tmp_path, walk):
    step = np.arange(-2.0, 2.01, 0.1)
    hill = 3.0 + 0.3 * np.broadcast_to(step, (len(step), len(step)))
    maps.write(
        tmp_path / "hill.exr", {"height": hill.astype("f4")}, [("cell", 0.1), ("originX", -2.05), ("originY", -2.05)]
    )
    on_hill = ("bake", walk, "--ground", tmp_path / "hill.exr", "--out", tmp_path / "folder")
    assert run(*on_hill).returncode == 1  # it stands three metres deep in the hill
    done = run(*on_hill, "--place-feet")
    assert done.returncode == 0, done.stderr
    report = json.loads((tmp_path / "folder" / "report.json").read_text())
    assert report["contacts"] == 1 and 0.005 < report["deepest_m"] < 0.1 and not report["warnings"]


def test_cells_begin_where_they_are_told(tmp_path, walk):
    for origin, folder in ((("0", "0"), "a"), (("0.005", "-0.005"), "b")):
        done = run("bake", walk, "--soil", "mud", "--origin", *origin, "--out", tmp_path / folder)
        assert done.returncode == 0, done.stderr
        told = json.loads((tmp_path / folder / "report.json").read_text())["parameters"]["origin"]
        assert told == [float(each) for each in origin]
    places = [maps.read(tmp_path / folder / "maps_final.exr").notes["originX"] for folder in "ab"]
    assert abs((places[1] - places[0]) % 0.64 - 0.005) < 1e-9


def test_bake_on_a_height_map(tmp_path, walk):
    y, x = np.mgrid[-1:1:81j, -1:1:81j]
    maps.write(
        tmp_path / "height.exr",
        {"height": (0.05 * x).astype(np.float32)},
        [("cell", 0.025), ("originX", -1.0125), ("originY", -1.0125)],
    )
    done = run("bake", walk, "--ground", tmp_path / "height.exr", "--soil", "mud", "--out", tmp_path / "folder")
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "folder" / "report.json").read_text())["deepest_m"] > 0.005


def test_a_height_map_that_lies_nowhere_is_one_sentence(tmp_path, walk):
    maps.write(
        tmp_path / "height.exr",
        {"height": np.zeros((9, 9), np.float32)},
        [("cell", 0.5), ("originX", "left"), ("originY", -2.0)],
    )
    done = run("bake", walk, "--ground", tmp_path / "height.exr", "--out", tmp_path / "folder")
    assert done.returncode == 1 and "originX" in done.stderr and "Traceback" not in done.stderr


def test_loads_are_a_table(tmp_path, walk):
    done = run("loads", walk, "--model", "inertia", "--out", tmp_path / "loads.csv")
    assert done.returncode == 0, done.stderr
    with open(tmp_path / "loads.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == ["time", "walker", "limb", "part", "touching", "fx", "fy", "fz", "px", "py", "pz"]
    stands = [float(row["fz"]) for row in rows if 0.3 < float(row["time"]) < 1.2]
    assert np.mean(stands) == pytest.approx(-75 * 9.81, rel=0.02)


@pytest.mark.parametrize(
    "arguments, words",
    [
        (("bake", "nowhere.npz", "--out", "x"), "nowhere.npz"),
        (("bake", "{walk}", "--soil", "cheese", "--out", "x"), "cheese"),
        (("bake", "{walk}", "--soil", "cheese.json", "--out", "x"), "cheese.json"),
        (("bake", "{walk}", "--soil-set", "softness=2", "--out", "x"), "softness"),
        (("bake", "{walk}", "--soil-set", "young_modulus=-2", "--out", "x"), "young_modulus"),
        (("bake", "{walk}", "--soil-keys", "keys.json", "--out", "x"), "keys.json"),
        (("bake", "{walk}", "--cell", "-1", "--out", "x"), "cell size"),
        (("bake", "{walk}", "--ground", "missing.exr", "--out", "x"), "missing.exr"),
        (("bake", "{walk}", "--ground", "flat:high", "--out", "x"), "flat"),
        (("loads", "{walk}", "--out", "no/such/folder/loads.csv"), "loads.csv"),
        (("plot", "{walk}", "--out", "no/such/folder/forces.png"), "forces.png"),
        (("plot", "{walk}", "--out", "forces.gif"), "forces.gif"),
        (("plot", "nowhere.npz", "--out", "forces.png"), "nowhere.npz"),
    ],
)
def test_bad_input_is_one_sentence(tmp_path, walk, arguments, words):
    done = run(*(text.replace("{walk}", str(walk)) for text in arguments), cwd=tmp_path)
    assert done.returncode == 1
    assert words in done.stderr and done.stderr.count("\n") == 1, done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("cut", [0, 100, -200])
def test_a_damaged_recording_is_one_sentence(tmp_path, walk, cut):
    data = walk.read_bytes()
    broken = tmp_path / "broken.npz"
    broken.write_bytes(data[:cut] if cut else bytes(reversed(data)))
    done = run("bake", broken, "--out", tmp_path / "x")
    assert done.returncode == 1 and "broken.npz" in done.stderr and done.stderr.count("\n") == 1


def test_law_heap_and_rim_reach_the_bake(tmp_path, walk):
    def baked(name, *choice):
        done = run("bake", walk, "--ground", "flat", "--soil", "mud", "--out", tmp_path / name, *choice)
        assert done.returncode == 0, done.stderr
        report = json.loads((tmp_path / name / "report.json").read_text())
        return report["parameters"], maps.read(tmp_path / name / "maps_final.exr").planes["heap"]

    chosen, wide = baked("wide", "--heap", "paper", "--rim-width", "0.15", "--law", "uniform")
    assert (chosen["heap"], chosen["rim_width"], chosen["law"]) == ("paper", 0.15, "uniform")
    usual, narrow = baked("narrow", "--heap", "paper")
    assert (usual["rim_width"], usual["law"]) == (0.04, "sole")
    assert (wide > 1e-4).sum() > 1.5 * (narrow > 1e-4).sum()


def test_feet_wade_through_snow_when_told(tmp_path, walk):
    words = ("--soil", "powder-snow", "--cell", "0.04", "--wade")
    done = run("bake", walk, *words, "--out", tmp_path / "through")
    assert done.returncode == 0, done.stderr
    report = json.loads((tmp_path / "through" / "report.json").read_text())
    assert [name.endswith("'s legs") for name in report["parameters"]["walkers"]] == [False, True]
    assert report["deepest_m"] > 0.1


@pytest.mark.parametrize(
    "words, told",
    [
        (("--cell", "0"), "cell"),
        (("--lateral", "0.2"), "--lateral tells how passes differ"),
        (("--one-way",), "--one-way tells how passes differ"),
        (("--one-way", "--along", "path.csv"), "--passes 2"),
        (("--timing", "0.1", "--stride", "0.1"), "--timing tells"),
        (("--pause", "5"), "--pause needs a path"),
        (("--rim-width", "0.1"), "--heap paper"),
        (("--wade", "--law", "carve"), "leave out --law carve"),
        (("--spacing", "0"), "--spacing is that of an EXR"),
        (("--spacing", "0.1", "--ground", "flat:1"), "--spacing is that of an EXR"),
        (("--seed", "5"), "--seed is of"),
        (("--seed", "99999999999999999999", "--plants", "carex"), "seed of 99999999999999999999"),
        (("--seed", "99999999999999999999", "--along", "path.csv"), "seed of 99999999999999999999"),
        (("--ground", "flat:"), "flat:HEIGHT"),
        (("--plants", "carex:"), "KIND:PLANTS"),
        (("--origin", "1e300", "0"), "origin"),
    ],
)
def test_what_nobody_would_use_is_refused(tmp_path, walk, words, told):
    (tmp_path / "path.csv").write_text("x,y\n0,0\n1.5,0\n")
    done = run("bake", walk, *words, "--out", tmp_path / "out", cwd=tmp_path)
    assert done.returncode == 1 and told in done.stderr and done.stderr.count("\n") == 1, done.stderr
    assert not (tmp_path / "out").exists()


def test_words_that_cannot_be_read_are_one_sentence(tmp_path, walk):
    for words in (("--cell", "x"), ("--law", "nobody"), ("--nothing", "1"), ()):
        done = run("bake", walk, *words, *(("--out", "out") if words else ()), cwd=tmp_path)
        assert done.returncode == 2 and done.stderr.count("\n") == 1 and "--help" in done.stderr, done.stderr
    assert run("loads", walk, "--out", "a.csv", "--spacing", "0.1", cwd=tmp_path).returncode == 1


def test_without_numpy_it_says_so(tmp_path):
    (tmp_path / "numpy.py").write_text("raise ModuleNotFoundError('No module named numpy', name='numpy')")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(tmp_path), str(REPO / "addon")))}
    words = [sys.executable, "-m", "desire_path", "--help"]
    done = subprocess.run(words, capture_output=True, text=True, env=environment)
    assert done.returncode == 1 and "install it" in done.stderr and done.stderr.count("\n") == 1, done.stderr


def test_what_is_no_ground_and_no_limits_is_a_sentence(tmp_path):
    with pytest.raises(DesirePathError, match="Simulation"):
        walker.contacts(standing(), Ground.flat())
    with pytest.raises(DesirePathError, match="Limits"):
        Bake(standing(), Ground.flat(), "mud", tmp_path / "out", options=BakeOptions(limits=None))
