"""Feet of a crowd, pressed where it comes through. MODEL 12.7"""

import numpy as np
import pytest
from scenes.crowds import Stopped, pressed, stop_after

from desire_path.crowd import feet as feet_of_crowds
from desire_path.crowd import scene as scenes
from desire_path.crowd.crowd import Crowd
from desire_path.crowd.feet import BEFORE, STRIDE, Feet
from desire_path.errors import DesirePathError
from desire_path.ground import maps
from desire_path.ground.sim import Ground


def test_feet_press_where_the_crowd_comes_through(tmp_path):
    scene = scenes.of(pressed(plants=["carex:60"]))
    with pytest.raises(DesirePathError, match="let one walk"):
        Feet(scene, tmp_path).press()
    Crowd(scene, tmp_path).run()
    told = Feet(scene, tmp_path).press()
    planes = maps.read(tmp_path / "trodden_final.exr").planes
    assert planes["compression"].shape == (80, 50) and told["passages"] == 12
    assert 0.001 < told["deepest_m"] == planes["compression"].max() < 0.1
    below = planes["compression"] > 1e-4
    assert 0.02 < below.mean() < 0.5 and below[:8].mean() < below[30:45].mean()  # along the middle
    assert told["contacts"] >= 12 * 2 and 50.0 < told["cover"] < 99.9
    assert Ground.read(tmp_path / "trodden_final.exr").trail is not None  # a walk goes on from there


def test_feet_that_were_stopped_go_on_to_the_same_bits(tmp_path, monkeypatch):
    scene = scenes.of(pressed(plants=["carex:20"]))
    Crowd(scene, tmp_path).run()
    Feet(scene, tmp_path).press()
    names = ["trodden_final.exr", "feet.json"]
    whole = [(tmp_path / name).read_bytes() for name in names]
    monkeypatch.setattr(feet_of_crowds, "EVERY", 0.0)
    for count in (3, 5):
        with pytest.raises(Stopped):
            Feet(scene, tmp_path).press(stop_after(count))
    begun = []
    Feet(scene, tmp_path).press(begun.append)
    assert begun[0] == 9 / 12
    assert [(tmp_path / name).read_bytes() for name in names] == whole


def test_feet_of_a_crowd_stand_on_the_hill_they_walk_over(tmp_path):
    """Up and down one of a fifth they press about as much as on level ground."""
    x = np.arange(-1.0, 18.01, 0.25)
    hill = np.tile(0.2 * np.abs(x - 7.0), (41, 1))  # a valley across the middle of the rectangle
    maps.write(tmp_path / "hill.exr", {"height": hill}, [("cell", 0.25), ("originX", -1.125), ("originY", -1.125)])
    told = []
    for name, more in (("level", {}), ("hill", {"heights": "hill.exr"})):
        scene = scenes.of({**pressed(), **more}, str(tmp_path))
        Crowd(scene, tmp_path / name).run()
        told.append(Feet(scene, tmp_path / name).press())
    level, steep = told
    assert steep["contacts"] == pytest.approx(level["contacts"], rel=0.2)
    assert steep["deepest_m"] == pytest.approx(level["deepest_m"], rel=0.4)


def test_no_two_walkers_step_into_the_same_prints(tmp_path):
    """Where many go by one path each comes in from another part of a stride before."""
    scene = scenes.of(pressed())
    feet = Feet(scene, tmp_path)
    path = np.stack([np.arange(0.0, 16.0, 0.01), np.full(1600, 4.0)], axis=1)
    begins = np.array([next(feet._through(number, path))[0, 0] for number in range(12)])
    assert len(set(begins.round(2))) > 8
    assert 0.5 * STRIDE < np.ptp(begins) <= STRIDE and begins.max() < scene.press.box[0] - BEFORE + 0.02


def test_who_hardly_moves_leaves_no_steps(tmp_path):
    """20 cm of a path are no walk: the others press as if nobody had been there."""
    scene = scenes.of(pressed())
    x0, y0, x1, y1 = scene.press.box
    x, y = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
    reports = []
    for far in (0.2, 0.0):
        Crowd(scene, folder := tmp_path / f"{far:g}").run()
        lines = (folder / "paths.csv").read_text().splitlines()
        head, others = lines[0], [line for line in lines[1:] if not line.startswith("0,")]
        mine = [f"0,0,0,1,{x:.3f},{y:.3f}", f"0,0,0,1,{x + far:.3f},{y:.3f}"] if far else []
        (folder / "paths.csv").write_text("\n".join([head, *mine, *others]) + "\n")
        reports.append(Feet(scene, folder).press())
    assert reports[0] == reports[1]


@pytest.mark.parametrize(
    "change, words",
    [
        ({"box": [1, 2, 3]}, "Feet press in a rectangle"),
        ({"box": [3, 2, 1, 4]}, "Feet cannot press"),
        ({"cell": 0.0}, "cell that feet press cannot be 0"),
        ({"box": [0, 0, 1e5, 1e5]}, "Feet cannot press"),
        ({"plants": "carex"}, "stand in a list"),
        ({"plants": ["carex:many"]}, "'carex:many' cannot be planted"),
        ({"plants": ["triffid"]}, "triffid"),
        ({"soil": "cheese"}, "no soil 'cheese'"),
        ({"depth": 1}, "press of a scene knows nothing of 'depth'"),
    ],
)
def test_feet_that_cannot_press_are_told(tmp_path, change, words):
    with pytest.raises(DesirePathError, match=words):
        Feet(scenes.of(pressed(**change)), tmp_path)
