"""Feet of a crowd, pressed where it comes through. MODEL 12.7"""

import pytest
from scenes.crowds import Stopped, pressed, stop_after

from desire_path.crowd import feet as feet_of_crowds
from desire_path.crowd import scene as scenes
from desire_path.crowd.crowd import Crowd
from desire_path.crowd.feet import Feet
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
