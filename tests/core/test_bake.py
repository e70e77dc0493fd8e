"""A bake folder: what is in it, that it is the same every time, and that nothing is lost on the way."""

import json
import math
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from desire_path.bake import bake as bakes
from desire_path.bake.bake import Bake, read_index
from desire_path.bake.options import BakeOptions
from desire_path.errors import DesirePathError
from desire_path.ground import maps
from desire_path.ground.sim import Ground
from desire_path.ground.soil import SOILS
from desire_path.motion.gait import Gait, Sole
from tests.scenes import gaits
from tests.scenes.records import for_bake

REPO = Path(__file__).resolve().parents[2]


def standing(seconds=1.5, rate=24.0, at=(0.0, 0.0)):
    """A box of 0.25 x 0.11 m that stands and is lifted, recorded at `rate`."""
    gait, _ = gaits.pressed(
        [gaits.box(0.25, 0.11)], [[*at, 0, 1, 0, 0, 0]], [[0, 0, -700]], seconds=seconds, rate=rate, lift=0.5
    )
    return gait


def baked(folder, gait=None, **more):
    bake = Bake(gait or standing(), Ground.flat(), "mud", folder, **for_bake(**{"threads": 1, **more}))
    frames = [progress.frame for progress in bake.run()]
    return bake, frames


def content(folder):
    return {path.name: path.read_bytes() for path in Path(folder, "frames").glob("*.exr")}


@pytest.mark.parametrize(
    "length, cell, good",
    [(0.25, 0.5, False), (0.25, 0.2, True), (0.002, 0.01, False), (0.002, 0.0002, True), (0.25, 0.05, True)],
)
def test_feet_lost_between_cells_are_named_before_the_bake(tmp_path, length, cell, good):
    """Not as a walk beside the ground; the cell size that is proposed shows them."""
    gait, _ = gaits.pressed(
        [gaits.box(length, 0.44 * length)],
        [[0.011, 0.007, 0, 1, 0, 0, 0]],
        [[0, 0, -7]],
        rate=24.0,
        mass=70 * (length / 0.25) ** 2,
    )
    if not good:
        with pytest.raises(DesirePathError, match=f"lost between cells of {cell:g} m: choose a cell size of") as said:
            baked(tmp_path, gait, cell_size=cell)
        cell = float(str(said.value).split("cell size of ")[1].split(" m")[0])
        assert not list(tmp_path.glob("frames*"))
    bake, _ = baked(tmp_path, gait, cell_size=cell)
    assert bake.report["pressed_m3"] > 0 and not any("beside" in each for each in bake.report["warnings"])


def test_soles_of_few_cells_are_told_before_the_bake(tmp_path):
    """With cells that would do, of which nothing is told."""
    gait = standing()
    bake = Bake(gait, Ground.flat(), "mud", tmp_path, cell_size=0.06)
    (told,) = bake.warnings
    assert "cells of 0.06 m wide, too few for a print to have their shape: choose a cell size of" in told
    cell = float(told.split("cell size of ")[1].split(" m")[0])
    assert not Bake(gait, Ground.flat(), "mud", tmp_path, cell_size=cell).warnings and 0.005 < cell < 0.02
    for _ in bake.run():
        pass
    assert bake.report["warnings"].count(told) == 1


def test_one_foot_of_many_that_is_lost_is_a_warning(tmp_path):
    gait, _ = gaits.pressed(
        [gaits.box(0.25, 0.11), gaits.box(0.003, 0.003)],
        [[0, 0, 0, 1, 0, 0, 0], [0, 0.3, 0, 1, 0, 0, 0]],
        [[0, 0, -7]] * 2,
        rate=24.0,
    )
    bake, _ = baked(tmp_path, gait)
    assert [each for each in bake.report["warnings"] if "lost between cells of 0.01 m" in each]
    assert not any("beside" in each for each in bake.report["warnings"])


def test_a_bake_leaves_frames_maps_and_a_report(tmp_path):
    bake, frames = baked(tmp_path)
    index = read_index(tmp_path)
    assert index.complete and index.missing == 0
    assert frames == list(range(index.frame_start, index.frame_end + 1))
    assert len(content(tmp_path)) == len(frames) + 1
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["contacts"] == 1
    assert {
        "deepest_m",
        "pressed_m3",
        "pressed_heap_m3",
        "loosened_m3",
        "rebounded_m3",
        "heaped_m3",
        "seconds",
        "warnings",
        "version",
        "parameters",
    } <= set(report)
    assert 0.005 < report["deepest_m"] < 0.05
    final = maps.read(tmp_path / "maps_final.exr")
    assert set(final.planes) == {"Y", *(entry.name for entry in maps.MAPS + maps.GROUND)}
    assert float(final.planes["compression"].max()) == pytest.approx(report["deepest_m"], rel=1e-6)
    cell = report["parameters"]["cell_size"]
    assert float(final.planes["heap"].astype(float).sum()) * cell**2 == pytest.approx(report["heaped_m3"], rel=1e-6)
    assert (tmp_path / "maps" / "second_0001.exr").exists()
    start = maps.read(tmp_path / "maps_start.exr")
    assert np.all(start.planes["young_modulus_in"] > 1e5)
    assert set(start.planes) == {*"RGB", "young_modulus_in", "plant_strength_in", "plant_strength", "rest"}
    for colour, shown in zip("RGB", ("young_modulus_in", "plant_strength_in", None)):
        assert np.array_equal(start.planes[colour], start.planes[shown] if shown else np.zeros(start.shape)), colour
    assert start.notes["unit_young_modulus_in"] == "Pa" and start.notes["unit_plant_strength_in"] == "-"


def test_the_report_of_ragged_ground_that_springs_back_closes_its_ledger(tmp_path):
    ragged = replace(SOILS["soil"], young_modulus=1e5, wall_angle=math.radians(40), roughness=0.4, rebound=0.3)
    bake = Bake(standing(), Ground.flat(), ragged, tmp_path, options=BakeOptions(threads=1))
    for _ in bake.run():
        pass
    report = bake.report
    assert report["loosened_m3"] > 0.0 and report["rebounded_m3"] > 0.0
    heaped = report["displaced_m3"] - report["pressed_heap_m3"] + report["loosened_m3"]
    assert report["heaped_m3"] == pytest.approx(heaped, rel=1e-6)
    pressed = report["pressed_m3"] + report["loosened_m3"] - report["rebounded_m3"]
    final = maps.read(tmp_path / "maps_final.exr").planes["compression"].astype(float)
    assert final.sum() * report["parameters"]["cell_size"] ** 2 == pytest.approx(pressed, rel=1e-5)


def test_the_first_file_is_ground_at_rest_and_the_last_the_final_map(tmp_path):
    baked(tmp_path)
    index = read_index(tmp_path)
    rest = maps.read(index.path(0))
    assert rest.planes["R"].shape == (index.ny, index.nx)
    assert not any(plane.any() for plane in rest.planes.values())
    last = maps.read(index.path(index.frames))
    final = maps.read(tmp_path / "maps_final.exr")
    assert np.array_equal(last.planes["B"], final.planes["compression"])
    assert np.array_equal(last.planes["A"], final.planes["pressure_time"])
    assert np.array_equal(last.planes["R"], final.planes["heap"] - final.planes["compression"])


def test_the_pressure_now_and_its_sum_are_told_apart(tmp_path):
    """A box of 75 kg that carries its weight all the time; test_film.py has one that is lifted."""
    bake, _ = baked(tmp_path)
    index, weight = read_index(tmp_path), 75 * 9.81
    second = maps.read(tmp_path / "maps" / "second_0001.exr")
    cell = second.notes["cell"]
    assert second.planes["pressure"].astype(float).sum() * cell**2 == pytest.approx(weight, rel=1e-5)
    assert second.notes["unit_pressure"] == "Pa" and second.notes["unit_pressure_time"] == "Pa s"
    sums = []
    for number in (0, 24, 25, index.frames):
        frame = maps.read(index.path(number))
        assert frame.notes["channelA"] == "pressure_time [Pa s]"
        sums.append(frame.planes["A"].astype(float).sum() * cell**2)
    assert sums[0] == 0 and sums[2] - sums[1] == pytest.approx(weight / 24, rel=1e-3)
    assert sums[3] == pytest.approx(
        maps.read(tmp_path / "maps_final.exr").planes["pressure_time"].sum() * cell**2, rel=1e-5
    )
    assert sums[3] > 1.5 * weight  # until it is lifted


def test_frames_do_not_depend_on_threads(tmp_path):
    folders = [tmp_path / str(threads) for threads in (1, 2, 4)]
    for folder, threads in zip(folders, (1, 2, 4)):
        baked(folder, threads=threads)
    assert content(folders[0]) == content(folders[1]) == content(folders[2])


def test_a_stopped_bake_plays_what_is_whole_and_goes_on(tmp_path):
    whole = tmp_path / "whole"
    baked(whole)
    stopped = tmp_path / "stopped"
    bake = Bake(standing(), Ground.flat(), "mud", stopped, options=BakeOptions(threads=1))
    run = bake.run()
    for _ in range(10):
        next(run)
    run.close()
    index = read_index(stopped)
    assert not index.complete and index.frames == 10 and index.missing > 0
    first = (stopped / "frames" / "trail_0005.exr").stat().st_mtime_ns
    baked(stopped)
    assert read_index(stopped).complete
    assert content(stopped) == content(whole)
    assert (stopped / "frames" / "trail_0005.exr").stat().st_mtime_ns == first  # not written again


def test_walkers_out_of_proportion_are_refused(tmp_path):
    gait = standing()
    giant = replace(gait, soles=tuple(Sole(200 * sole.vertices, sole.triangles) for sole in gait.soles))
    lost = replace(gait, pose=gait.pose + [1e15, 0, 0, 0, 0, 0, 0], com=gait.com + [1e15, 0, 0])
    for wrong, words in ((giant, "50.0 m long.*scale"), (lost, "place and scale")):
        with pytest.raises(DesirePathError, match=words):
            baked(tmp_path / "none", wrong)
    baked(tmp_path / "coarse", giant, cell_size=0.5)


def test_files_of_others_stay(tmp_path):
    """A folder that holds somebody's rendered frames and maps is chosen for a bake."""
    theirs = [tmp_path / name for name in ("frames/0001.png", "maps/town.exr", "bake.old/frames/a/b.txt")]
    for path in theirs:
        path.parent.mkdir(parents=True)
        path.write_text("theirs")
    theirs[2] = tmp_path / "frames" / "a" / "b.txt"
    for cell in (0.01, 0.02):
        baked(tmp_path, cell_size=cell)
        assert all(path.read_text() == "theirs" for path in theirs)
        assert sorted(path.name for path in tmp_path.iterdir() if path.is_dir()) == ["frames", "maps"]
    bakes.free(tmp_path)
    left = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert sorted(left) == sorted(theirs)
    for path in theirs:
        path.unlink()
    (tmp_path / "frames" / "a").rmdir()
    (tmp_path / "frames").rmdir(), (tmp_path / "maps").rmdir()
    baked(tmp_path)
    bakes.free(tmp_path)
    assert not tmp_path.exists()


def test_free_says_what_cannot_be_deleted(tmp_path, monkeypatch):
    def locked(path):
        raise PermissionError(13, "Permission denied", str(path))

    baked(tmp_path)
    monkeypatch.setattr(Path, "unlink", locked)
    with pytest.raises(DesirePathError, match="trail_.*cannot be deleted .Permission denied.: delete the folder"):
        bakes.free(tmp_path)


def sentence(error):
    text = str(error.value)
    assert "\n" not in text and text.endswith(".") and text[0].isupper() or text.startswith("/"), text
    return text


FULL = """
import os, resource, sys
sys.path[:0] = [{addon!r}, {repo!r}]
from tests.core.test_bake import standing
from desire_path.bake import Bake
from desire_path.errors import DesirePathError
from desire_path.gait import Gait, Sole
from desire_path.sim import Ground, Simulation
bake = Bake(standing(), Ground.flat(), "snow", {folder!r}, threads=1, cell_size=0.002)
run = bake.run()
for _ in range(3):
    next(run)
least = os.path.getsize(os.path.join({folder!r}, "bake.new", "frames", "trail_0002.exr")) // 2
resource.setrlimit(resource.RLIMIT_FSIZE, (least, least))
try:
    for _ in run:
        pass
except DesirePathError as problem:
    print(problem)
"""


def test_a_write_that_fails_in_the_middle_loses_nothing(tmp_path):
    """Files may grow to half a frame only: what a full disk or a quota does to a bake."""
    folder = str(tmp_path / "bake")
    script = FULL.format(addon=str(REPO / "addon"), repo=str(REPO), folder=folder)
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert "make room or choose another folder" in done.stdout, done.stdout + done.stderr
    index = read_index(folder)
    assert 2 <= index.frames < index.frames + index.missing
    maps.read(index.path(index.frames))
    leftovers = [
        name
        for name in os.listdir(os.path.join(folder, "frames"))
        if not name.startswith("trail_") and name != "index.json"
    ]
    assert not leftovers, leftovers


def test_another_program_reads_the_same_bits(tmp_path):
    """MODEL 11.14"""
    baked(tmp_path)
    final = maps.read(tmp_path / "maps_final.exr").planes
    for name, plane in final.items():
        raw = tmp_path / f"{name}.exr"
        subprocess.run(
            [
                "oiiotool",
                str(tmp_path / "maps_final.exr"),
                "--ch",
                maps.channel(name),
                "--compression",
                "none",
                "-o",
                str(raw),
            ],
            check=True,
            env={**os.environ, "LD_LIBRARY_PATH": ""},
        )
        again = maps.read(raw).planes
        assert np.array_equal(next(iter(again.values())), plane)


def test_a_player_shows_the_first_map(tmp_path):
    baked(tmp_path)
    for name, shown in (("maps_final", ["compression"]), ("maps_start", "GBR")):  # planes as this player has them
        planes = maps.read(tmp_path / f"{name}.exr").planes
        plane = np.stack([planes[each][::-1] for each in shown])
        told = subprocess.run(
            ["ffmpeg", "-v", "error", "-i", str(tmp_path / f"{name}.exr"), "-f", "rawvideo", "-"],
            check=True,
            capture_output=True,
        )
        assert np.array_equal(np.frombuffer(told.stdout, np.float32).reshape(plane.shape), plane)


def test_a_print_down_to_the_rigid_ground_is_told(tmp_path):
    heavy, _ = gaits.pressed(
        [gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -700]], seconds=1.0, rate=24.0, lift=0.5, mass=1e5
    )
    bake, _ = baked(tmp_path / "heavy", heavy)
    assert any("rigid ground" in warning for warning in bake.report["warnings"])
    bake, _ = baked(tmp_path / "light")
    assert not any("rigid ground" in warning for warning in bake.report["warnings"])


def test_who_walk_at_once_are_filmed_frame_by_frame(tmp_path):
    one, _ = gaits.pressed([gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -700]], seconds=1.0, rate=24.0)
    two = replace(one, pose=one.pose + np.array([2.0, 0, 0, 0, 0, 0, 0]), com=one.com + (2.0, 0, 0))
    job = Bake(Gait.join([one, two]), Ground.flat(), "mud", tmp_path, cell_size=0.02)
    assert job.film == "frames" and len(job.passes) == 1
    assert (job.frame_start, job.frame_end) == (1, len(one.time))
