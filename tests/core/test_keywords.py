"""Options in records, and their fields given one by one."""

import inspect
import warnings
from dataclasses import dataclass

import pytest

from desire_path import Bake, BakeOptions, BakeOutput, Ground, Simulation, SimulationOptions
from desire_path.errors import DesirePathError
from desire_path.keywords import fields_of
from tests.core.test_bake import standing


@dataclass(frozen=True)
class Pace:
    speed: float = 1.0
    stride: float = 0.7


@dataclass(frozen=True, kw_only=True)
class Body:
    mass: float
    name: str = "walker"


@fields_of("speed", "stride", pace=Pace, body=Body)
def walk(path, passes=1, *, seed=0, pace=Pace(stride=0.8), body=None):
    """Walks."""
    return path, passes, seed, pace, body


class Herd:
    @fields_of(pace=Pace)
    def __init__(self, count, *, pace=None):
        self.count, self.pace = count, pace


def test_a_record_is_taken_without_a_word():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert walk("p", seed=3, pace=Pace(2.0), body=Body(mass=80)) == ("p", 1, 3, Pace(2.0), Body(mass=80))
        assert walk("p", 2) == ("p", 2, 0, Pace(stride=0.8), None)
        assert Herd(3).pace is None


def test_fields_are_taken_and_told_where_they_are_written():
    with pytest.warns(DeprecationWarning) as told:
        assert walk("p", seed=1, speed=2.0, mass=70) == ("p", 1, 1, Pace(2.0, 0.8), Body(mass=70))
    assert [str(each.message) for each in told] == [
        "walk(speed=.., mass=..) is written walk(pace=Pace(speed=..), body=Body(mass=..))."
    ]
    assert told[0].filename == __file__
    with pytest.warns(DeprecationWarning, match=r"Herd\(stride=\.\.\) is written Herd\(pace=Pace\(stride=\.\.\)\)"):
        assert Herd(2, stride=0.5).pace == Pace(1.0, 0.5)
    with pytest.warns(DeprecationWarning):
        assert walk("p", 2, 3.0, 0.4)[3] == Pace(3.0, 0.4)
    with pytest.warns(DeprecationWarning):
        assert walk("p", 2, 3.0, stride=0.4, body=Body(mass=1))[3:] == (Pace(3.0, 0.4), Body(mass=1))


def test_what_is_given_twice_or_is_unknown_is_refused():
    with pytest.warns(DeprecationWarning), pytest.raises(TypeError, match="got speed and pace: give them in pace"):
        walk("p", speed=1.0, pace=Pace())
    with pytest.raises(TypeError, match="got speed twice"):
        walk("p", 1, 2.0, speed=3.0)
    with pytest.raises(TypeError, match="'sped'"):
        walk("p", sped=1.0)
    with pytest.warns(DeprecationWarning), pytest.raises(TypeError, match="positional"):
        walk("p", 1, 2.0, 0.4, 5)
    with pytest.raises(TypeError, match="path"):
        walk()


def test_it_looks_as_it_is_written():
    assert list(inspect.signature(walk).parameters) == ["path", "passes", "seed", "pace", "body"]
    assert walk.__doc__ == "Walks."


@pytest.mark.parametrize("door", [Bake, Simulation])
def test_no_door_takes_more_than_eight(door):
    assert len(inspect.signature(door).parameters) <= 8


def test_options_of_a_bake_one_by_one(tmp_path):
    with pytest.warns(
        DeprecationWarning, match=r"Bake\(law=\.\., wait=\.\.\) is written Bake\(options=BakeOptions\(law"
    ):
        bake = Bake(standing(), Ground.flat(), "mud", tmp_path, law="uniform", wait=3)
    assert bake.options == BakeOptions(law="uniform") and bake.output == BakeOutput(wait=3) and bake.wait == 3
    with pytest.warns(DeprecationWarning, match=r"SimulationOptions\(origin=\.\.\)"):
        assert Simulation(Ground.flat(), origin=(0.5, 1)).origin == (0.5, 1.0)


@pytest.mark.parametrize(
    "words, sentence",
    [
        ({"law": "hard"}, "no contact law 'hard': choose sole or uniform"),
        ({"heap": "high"}, "no heap law 'high'"),
        ({"rim_width": 0}, "A rim width of 0 m cannot be used"),
        ({"rim_width": "wide"}, "A rim width of 'wide' is no number"),
        ({"origin": (0, float("nan"))}, "origin of the cells is not a finite point"),
        ({"origin": 3}, "origin of the cells is not a finite point"),
        ({"threads": 65}, "number of threads must be 0"),
        ({"threads": "two"}, "number of threads must be 0"),
    ],
)
def test_options_that_cannot_be_are_refused_when_they_are_made(words, sentence):
    for record in (SimulationOptions, BakeOptions):
        with pytest.raises(DesirePathError, match=sentence):
            record(**words)
