"""A bake in windows and tiles, by tasks that know nothing of each other, is the whole bake, to the bit."""

import os
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import desire_path
from desire_path import SOILS, Bake, BakeOptions, BakeOutput, Gait, Ground, Planting
from desire_path.commands import main
from desire_path.errors import DesirePathError
from desire_path.farm import merge, plan, task
from desire_path.farm.job import Job

WALK = Path(desire_path.__file__).parent / "walks" / "walk.npz"
FRAMES = 84


def shifted(gait, x, y):
    pose, com = np.array(gait.pose), np.array(gait.com)
    pose[..., :2] += (x, y)
    com[..., :2] += (x, y)
    return replace(gait, pose=pose, com=com).check()


@pytest.fixture(scope="module")
def crowd():
    """Two walkers whose prints meet, and two far away whose prints meet, too."""
    one = Gait.load(WALK).along([(0, 0), (1.6, 0.5)], 1)
    return Gait.join([shifted(one, *at) for at in ((0, 0), (0.4, 0.3), (0, 6), (0.3, 5.8))])


def bake(gait, folder, soil="soil", plants=(), end=FRAMES, spray=None):
    return Bake(
        gait,
        Ground.flat(),
        soil,
        folder,
        cell_size=0.02,
        plants=plants,
        options=BakeOptions(threads=1, spray=spray),
        output=BakeOutput(frame_end=gait.frame_start + end - 1),
    )


@pytest.fixture(scope="module")
def whole(crowd, tmp_path_factory):
    made = bake(crowd, tmp_path_factory.mktemp("whole") / "bake")
    list(made.run())
    return made


def files(folder):
    """All that a bake says but its report, which tells of seconds."""
    found = {str(path.relative_to(folder)): path.read_bytes() for path in Path(folder).rglob("*") if path.is_file()}
    assert found.pop("report.json")
    return found


def work(folder):
    """Do all tasks, those of a window in no order."""
    job = Job(folder)
    for window in range(len(job.windows)):
        for tile in reversed(range(job.columns * job.rows)):
            task.run(job, window, tile, threads=1 + tile % 2)
    return job


@pytest.mark.parametrize(("tiles", "windows"), [((1, 1), 1), ((2, 2), 3), ((3, 3), 4)])
def test_tiles_are_the_whole_bake_to_the_bit(crowd, whole, tmp_path, tiles, windows):
    told = plan.plan(bake(crowd, tmp_path / "other"), tmp_path / "job", tiles, windows)
    assert not told.chained and told.most == 2
    job = work(tmp_path / "job")
    report = merge.merge(job)
    assert files(job.path("bake")) == files(whole.folder)
    assert len(files(whole.folder)) > FRAMES
    for name, value in whole.report.items():
        if name not in ("seconds", "stages", "parameters"):
            assert report[name] == (pytest.approx(value, rel=1e-12) if isinstance(value, float) else value), name


@pytest.mark.parametrize(("soil", "plants"), [("snow", ()), ("soil", (Planting("carex", 15.0, seed=2),))])
def test_what_moves_by_itself_goes_from_window_to_window(crowd, tmp_path, soil, plants):
    made = bake(crowd, tmp_path / "whole", soil, plants, end=24)
    list(made.run())
    told = plan.plan(bake(crowd, tmp_path / "other", soil, plants, end=24), tmp_path / "job", (2, 1), 3)
    assert told.chained and told.tasks == 3
    job = work(tmp_path / "job")
    merge.merge(job)
    assert files(job.path("bake")) == files(made.folder)


@pytest.mark.parametrize(("law", "deep"), [("sole", 0.0), ("carve", 0.03), ("carve", 0.0)])
def test_what_bodies_push_across_tiles_is_the_whole_bake_to_the_bit(tmp_path, law, deep):
    """Two crates dragged 1.3 m through tiles of 1.28 m, by their weight, 3 cm deep, and just over the ground."""
    from test_plough import dragged  # here: who takes files() from elsewhere has no folder of core tests to look in

    one = shifted(dragged(law, far=1.3, seconds=2.6), 0.0, 0.0)
    pose = np.array(one.pose)
    pose[..., 2] -= deep
    one = replace(one, pose=pose)
    gait = Gait.join([one, shifted(one, 0.3, 5.0)])
    made = bake(gait, tmp_path / "whole", end=80)
    list(made.run())
    assert made.report["loosened_m3"] > 1e-3 or (law, deep) == ("carve", 0.0)
    told = plan.plan(bake(gait, tmp_path / "other", end=80), tmp_path / "job", (3, 2), 3)
    assert not told.chained and told.most <= 2
    job = work(tmp_path / "job")
    assert merge.merge(job)["heaped_m3"] == pytest.approx(made.report["heaped_m3"], rel=1e-9)
    assert files(job.path("bake")) == files(made.folder)


@pytest.fixture(scope="module")
def planned(crowd, tmp_path_factory):
    folder = tmp_path_factory.mktemp("farm") / "job"
    plan.plan(bake(crowd, folder / "bake"), folder, (1, 2), 2)
    return folder


def test_a_task_that_was_killed_is_done_again_to_the_bit(planned, tmp_path):
    job = tmp_path / "job"
    shutil.copytree(planned, job)
    code = (
        f"import sys, os; sys.path[:0] = {sys.path!r}\n"
        "from desire_path.farm import task\nfrom desire_path.farm.job import Job\n"
        f"task.run(Job({str(job)!r}), 0, 0, progress=lambda share: share > 0.5 and os._exit(9))\n"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 9
    assert not os.listdir(job / "results")
    task.run(Job(job), 0, 0)
    task.run(Job(planned), 0, 0, threads=1)
    name = "w000_t000.bin"
    again, before = (Job(each).result(0, 0)[1] for each in (job, planned))
    assert again == before and len(before["state"]) > 1000
    stamp = os.stat(job / "results" / name).st_ino
    task.run(Job(job), 0, 0)  # done already
    assert os.stat(job / "results" / name).st_ino == stamp


def refused(*words):
    with pytest.raises(DesirePathError) as problem:
        words[0](*words[1:])
    text = str(problem.value)
    assert text.count(". ") <= 1 and text.endswith(".")
    return text


def test_ground_whose_soil_moves_on_soles_or_lies_in_layers_is_baked_whole(crowd, tmp_path):
    whole = bake(crowd, tmp_path / "bake", soil=replace(SOILS["mud"], adhesion=0.004))
    assert "A farm bakes no ground in layers and no soil that sticks" in refused(
        plan.plan, whole, tmp_path / "job", (2, 1), 2
    )
    assert not (tmp_path / "job").exists()


def test_what_cannot_be_done_is_said(planned, crowd, tmp_path, capsys):
    job = Job(planned)
    assert "has no window 2: choose 0 to 1" in refused(task.run, job, 2, 0)
    assert "has no tile -1: choose 0 to 1" in refused(task.run, job, 0, -1)
    copy = tmp_path / "job"
    shutil.copytree(planned, copy)
    shutil.rmtree(copy / "results")
    (copy / "results").mkdir()
    assert "needs the result of window 0, tile" in refused(task.run, Job(copy), 1, 0)
    assert "tasks of" in refused(merge.merge, Job(copy)) and not (copy / "bake").exists()
    (copy / "results" / "w000_t000.bin").write_bytes(b"of another job")
    assert "not whole, or of another job" in refused(Job(copy).needed, 0, 0, "Window 1 needs")
    assert "another walk" in refused(plan.plan, bake(shifted(crowd, 1, 0), copy), copy, (1, 2), 2)
    assert "another walk, ground or cut" in refused(plan.plan, bake(crowd, copy), copy, (2, 2), 2)
    (copy / "windows" / "w000.npz").write_bytes(b"")
    assert "not as it was planned" in refused(task.run, Job(copy), 0, 0)
    (copy / "job.json").write_text('{"format": 1}')
    assert "is damaged, or no job" in refused(Job, copy)
    assert "no job in" in refused(Job, tmp_path)
    assert "cut into 85 windows" in refused(plan.plan, bake(crowd, copy), tmp_path / "x", (1, 1), FRAMES + 1)
    assert "0 x 1 tiles" in refused(plan.plan, bake(crowd, copy), tmp_path / "x", (0, 1), 1)
    assert "no spray" in refused(plan.plan, bake(crowd, copy, spray="mud"), tmp_path / "x", (1, 1), 1)
    assert not (tmp_path / "x").exists()
    assert main(["farm", "plan", str(WALK), "--tiles", "many", "--out", str(tmp_path / "x")]) == 1
    assert "write columns x rows" in capsys.readouterr().err


def test_soil_that_goes_too_far_is_told(crowd, tmp_path, monkeypatch):
    monkeypatch.setattr(plan, "margin", lambda *_: -0.07)  # a step that is taken to change less than its sole
    plan.plan(bake(crowd, tmp_path / "bake"), tmp_path / "job", (1, 1), 1)
    assert "plan the job anew with --margin 1" in refused(task.run, Job(tmp_path / "job"), 0, 0)


def test_the_commands_do_it(tmp_path, capsys):
    job = str(tmp_path / "job")
    walk = [str(WALK), "--soil", "mud", "--cell", "0.03", "--frame-end", "12"]
    assert main(["farm", "plan", *walk, "--tiles", "2x1", "--windows", "2", "--out", job]) == 0
    for window in "01":
        for tile in "01":
            assert main(["farm", "tile", job, "--window", window, "--tile", tile]) == 0
    assert main(["farm", "merge", job]) == 0
    assert "written to" in capsys.readouterr().out
    assert main(["bake", *walk, "--out", str(tmp_path / "bake")]) == 0
    assert files(tmp_path / "bake") == files(os.path.join(job, "bake"))
