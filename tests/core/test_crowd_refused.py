"""Scenes that no crowd can walk are told in a sentence."""

import pytest
from scenes.crowds import small

from desire_path.crowd import scene as scenes
from desire_path.crowd.choice import Choice
from desire_path.crowd.covers import as_cover, snow
from desire_path.crowd.crowd import Crowd
from desire_path.errors import DesirePathError

WALL = [{"box": [11, -1, 13, 21]}]


@pytest.mark.parametrize(
    "change, words",
    [
        ({"places": []}, "at least two places"),
        (
            {"places": [{"name": "a", "at": [1, 1]}, {"name": "b", "at": [5, 5], "rate": 0}]},
            "two places a rate above 0",
        ),
        ({"places": [{"name": "a", "at": [1, 1]}, {"name": "b", "at": [5, 5], "rate": 1e9}]}, "rate of 'b' cannot be"),
        ({"places": [{"name": "a", "at": [1, 1]}, {"name": "b", "at": [5, 5], "rate": -1}]}, "rate of 'b' cannot be"),
        ({"places": [{"name": "a", "at": [1, 1]}, {"name": "a", "at": [5, 5]}]}, "Two places are called 'a'"),
        ({"places": [{"name": "a", "at": [1, 1]}, {"name": "b", "at": [1, 1]}]}, "'a' and 'b' have no ground between"),
        ({"places": [{"name": "a", "at": [1, 1], "radius": 4}, {"name": "b", "at": [4, 3]}]}, "no ground between them"),
        ({"places": [{"name": "a", "at": [1, 1]}, {"name": "b", "at": [50, 5]}]}, "'b' lies outside the ground"),
        ({"places": [{"name": "a"}, {"name": "b", "at": [50, 5]}]}, "A place does not say its at"),
        ({"places": [{"name": "a", "at": [1, 1, 2]}, {"name": "b", "at": [5, 5]}]}, "place 'a' cannot be"),
        ({"places": [{"name": "a,b", "at": [1, 1]}, {"name": "b", "at": [5, 5]}]}, "without commas"),
        ({"places": [{"name": "a", "at": [1, 1], "speed": 2}]}, "place knows nothing of 'speed'"),
        ({"places": {"a": 1}}, "Places of a scene stand in a list"),
        ({"obstacles": WALL}, "No way leads from 'gate 0' to 'gate 1'.*leave a gap"),
        ({"obstacles": [{"box": [0, 0, 4, 6]}]}, "'gate 0' lies in an obstacle"),
        ({"obstacles": [{"star": [1, 2]}]}, "An obstacle cannot be"),
        ({"obstacles": [{"circle": [1, 2, -3]}]}, "An obstacle cannot be"),
        ({"obstacles": [{"polygon": [[1, 2], [3, float("nan")], [4, 5]]}]}, "An obstacle cannot be"),
        ({"ground": "cheese"}, "no ground called 'cheese'"),
        ({"ground": {"detour": -1}}, "cannot have a detour of -1"),
        ({"ground": {"colour": 1}}, "no number called 'colour'"),
        ({"ground": 7}, "cannot walk on 7"),
        ({"cell": 1.0}, "side of a cell cannot be 1"),
        ({"size": [20, 1e5]}, "cannot be walked in cells"),
        ({"passages": 0}, "number of passages cannot be 0"),
        ({"passages": 1.5}, "whole number"),
        ({"per_day": 0}, "passages a day cannot be 0"),
        ({"per_day": 1e9}, "passages a day cannot be"),
        ({"seed": -1}, "seed cannot be -1"),
        ({"walkers": []}, "Nobody walks here"),
        ({"walkers": [{"share": 0}]}, "Nobody walks here"),
        ({"walkers": [{"mass": 0}]}, "mass of walkers cannot be 0"),
        ({"rest_days": float("inf")}, "days at rest cannot be inf"),
        ({"colour": 1}, "scene knows nothing of 'colour'"),
        ({"heights": 3}, "heights of a scene are no name"),
    ],
)
def test_what_cannot_be_is_told_in_a_sentence(change, words):
    with pytest.raises(DesirePathError, match=words) as told:
        Choice(scenes.of({**small(), **change}))
    assert str(told.value).count("\n") == 0 and str(told.value).endswith(".")


def test_files_that_are_no_scenes_are_told(tmp_path):
    with pytest.raises(DesirePathError, match="There is no scene at"):
        scenes.read(tmp_path / "none.json")
    for text, words in (("{", "no scene in JSON, line 1"), ("[1]", "scene cannot be"), ("\0", "no scene in JSON")):
        (tmp_path / "bad.json").write_text(text)
        with pytest.raises(DesirePathError, match=words):
            scenes.read(tmp_path / "bad.json")
    with pytest.raises(DesirePathError, match="cannot be read"):
        scenes.read(tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(DesirePathError, match="cannot be written"):
        Crowd(scenes.of(small()), tmp_path / "file").run()
    with pytest.raises(DesirePathError, match="give a depth"):
        snow(0.01)
    assert as_cover({"kind": "snow-25", "renewal": 0.1}).renewal == 0.1
