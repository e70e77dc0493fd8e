"""Crowds that another program walked: tables and databases of trajectories. MODEL 12.7"""

import contextlib
import json
import sqlite3

import numpy as np
import pytest

from desire_path import commands
from desire_path.crowd import scene as scenes
from desire_path.crowd import trajectories
from desire_path.crowd.trajectories import Recorded
from desire_path.errors import DesirePathError
from desire_path.ground import maps


def recorded(path, rows):
    path.write_text("frame,id,x,y\n" + "".join(f"{f},{n},{x},{y}\n" for f, n, x, y in rows))
    return path


def test_trajectories_tread_the_ground_they_go_over(tmp_path):
    """A table and a database of the same walkers leave the same cover; who comes first is first."""
    rows = [(f, n, 2.0 + 0.5 * (f - 3 * n), 3.0 + 2.0 * n) for n in (2, 0, 1) for f in range(3 * n, 3 * n + 30)]
    table = recorded(tmp_path / "walk.csv", rows)
    with contextlib.closing(sqlite3.connect(tmp_path / "walk.sqlite")) as base:
        base.execute("CREATE TABLE metadata (key TEXT, value TEXT)")
        base.execute(
            "CREATE TABLE trajectory_data (frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL, ori_x REAL, ori_y REAL)"
        )
        base.executemany("INSERT INTO trajectory_data VALUES (?, ?, ?, ?, 1, 0)", rows)
        base.commit()
    scene = {"size": [20, 16], "ground": "snow-25"}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    for name in ("walk.csv", "walk.sqlite"):
        out = tmp_path / f"out {name}"
        told = commands.main(
            ["crowd", str(tmp_path / "scene.json"), "--trajectories", str(tmp_path / name), "--out", str(out)]
        )
        assert told == 0
    planes = [maps.read(tmp_path / f"out {name}" / "cover_final.exr").planes for name in ("walk.csv", "walk.sqlite")]
    assert np.array_equal(planes[0]["load"], planes[1]["load"])
    assert planes[0]["load"].sum() * 0.25 == pytest.approx(3 * 14.5 * 0.5, rel=1e-3)
    assert planes[0]["cover"][[6, 10, 14], 20].max() < 0.97 and planes[0]["cover"][24, 20] > 0.9999
    ways = trajectories.read(table)
    assert [walked[0].tolist() for walked in ways] == [[2.0, 3.0], [2.0, 5.0], [2.0, 7.0]]


@pytest.mark.parametrize(
    "rows, words",
    [
        ([], "holds no trajectory"),
        ([(0, 4, 1, 1), (1, 4, 9, 1)], "Walker 4 of .* jumps by 8 m from frame 0 to 1"),
        ([(0, 4, 1, 1), (1, 4, 1.5, 1), (2, 4, 2, 1), (40, 4, 9, 1)], "Walker 4 of .* is lost from frame 2 to 40"),
        ([(0, 4, 1, 1), (0, 4, 1.5, 1)], "is in two places in frame 0"),
        ([(0, 4, 1, 1), (1, 4, "nan", 1)], "line 3 of it is not"),
        ([(0, 4, 1, 1), (1, 4, "here", 1)], "line 3 of it is not"),
        ([(0, 4, 1, 1), (0.5, 4, 1, 1)], "line 3 of it is not"),
        ([(0, 4, 19, 1), (1, 4, 20.5, 1)], r"leaves the ground at \(20.5, 1\)"),
    ],
)
def test_trajectories_that_cannot_be_are_told(tmp_path, rows, words):
    with pytest.raises(DesirePathError, match=words) as told:
        Recorded(scenes.of({"size": [20, 16]}), trajectories.read(recorded(tmp_path / "walk.csv", rows)))
    assert "\n" not in str(told.value)


def test_files_that_are_no_trajectories_are_told(tmp_path):
    with pytest.raises(DesirePathError, match="no trajectories at"):
        trajectories.read(tmp_path / "none.csv")
    none = "no columns|no table"
    for text, words in (("frame,id,x\n1,2,3\n", none), ("frame,id,x,y,z\n", "a column 'z'"), ("\0", none)):
        (tmp_path / "bad.csv").write_text(text)
        with pytest.raises(DesirePathError, match=words):
            trajectories.read(tmp_path / "bad.csv")
    for tables, words in (
        (["songs (title TEXT)"], "another program"),
        (["trajectory_data (frame INTEGER)"], "no column id"),
    ):
        with contextlib.closing(sqlite3.connect(tmp_path / f"{len(words)}.sqlite")) as base:
            for each in tables:
                base.execute(f"CREATE TABLE {each}")
            base.commit()
        with pytest.raises(DesirePathError, match=words):
            trajectories.read(tmp_path / f"{len(words)}.sqlite")
    whole = (tmp_path / f"{len(words)}.sqlite").read_bytes()
    (tmp_path / "cut.sqlite").write_bytes(whole[:100] + b"\xff" * (len(whole) - 100))
    with pytest.raises(DesirePathError, match="damaged"):
        trajectories.read(tmp_path / "cut.sqlite")
