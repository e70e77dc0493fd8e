"""On which days a crowd's passages fall, and what grows between them. MODEL 12.8"""

import math

import numpy as np
import pytest
from scenes.crowds import Stopped, pressed, small, stop_after

from desire_path.crowd import crowd as crowds
from desire_path.crowd import scene as scenes
from desire_path.crowd.crowd import Crowd
from desire_path.crowd.feet import DAY, Feet
from desire_path.crowd.spans import Calendar, Span
from desire_path.errors import DesirePathError
from desire_path.ground import maps

WEEK = (Span(5.0, 40.0), Span(2.0, 0.0))
YEAR = (Span(200.0, 3.0), Span(100.0, 1.0, 0.0), Span(65.0, 0.0, 2.0))


def test_one_span_is_so_many_passages_a_day():
    for per_day in (0.001, 0.7, 30.0, 1e6):
        days = Calendar([Span(1.0, per_day)])
        for passages in (0, 1, 17, 10_000):
            assert days.until(passages) == pytest.approx((passages / per_day,) * 2, abs=1e-6)
            assert days.pause(passages) is None


def test_weeks_and_years_come_again_and_again():
    week, year = Calendar(WEEK), Calendar(YEAR)
    told = {0: 0.0, 40: 1.0, 199: 4.975, 200: 7.0, 201: 7.025, 400: 14.0, 2000: 70.0}
    assert {n: week.until(n)[0] for n in told} == pytest.approx(told)
    assert week.until(200, idle=False)[0] == pytest.approx(5.0) and week.until(0, idle=False)[0] == 0.0
    assert [week.pause(n) for n in (0, 199, 200, 399)] == [200, 200, 400, 400]
    assert year.until(600) == pytest.approx((200.0, 200.0)) and year.until(650) == pytest.approx((250.0, 200.0))
    assert year.until(700) == pytest.approx((365.0, 330.0))  # nothing grows in winter, and twice as much in spring
    assert year.until(700, idle=False) == pytest.approx((300.0, 200.0)) and year.pause(650) == 700
    assert year.until(1400)[1] == pytest.approx(2.0 * 330.0)
    slow = Calendar([Span(1.5, 1.0), Span(1.0, 0.0)])  # a passage and a half, then nobody
    assert [slow.pause(n) for n in range(5)] == [1, 3, 3, 4, 6]


def test_nobody_and_nothing_are_told():
    with pytest.raises(DesirePathError, match="Nobody comes in any span"):
        Calendar([Span(3.0, 0.0)])
    for wrong, words in (
        ({"days": 0, "per_day": 3}, "days of a span cannot be 0"),
        ({"days": 1, "per_day": 1e9}, "passages a day of a span cannot be"),
        ({"days": 1, "per_day": 1e-9}, "passages a day of a span cannot be"),
        ({"days": 1, "per_day": 3, "growth": math.nan}, "growth of a span cannot be nan"),
        ({"days": 1}, "A span does not say its per_day"),
        ({"days": 1, "per_day": 3, "rain": 1}, "span knows nothing of 'rain'"),
    ):
        with pytest.raises(DesirePathError, match=words):
            scenes.of(small(spans=[wrong]))
    with pytest.raises(DesirePathError, match="Spans of a scene stand in a list"):
        scenes.of(small(spans={"days": 1}))


def test_cover_grows_while_nobody_comes(tmp_path):
    """What a crowd has trodden before a pause is, after it, what another one left that rested for so long. Paths are
    chosen anew every 18 passages, and after the pause."""
    before = Crowd(scenes.of({**small(), "passages": 120, "renewals": 7, "per_day": 30.0}), tmp_path / "before")
    before.run()
    spans = [{"days": 4, "per_day": 30}, {"days": 500, "per_day": 0, "growth": 0.5}]
    whole = Crowd(scenes.of({**small(film_every=120), "renewals": 14, "spans": spans}), tmp_path / "whole")
    told = whole.run()
    film = maps.read(whole.path("frames", "cover_000120.exr")).planes["load"]
    rested = before.scene.ground.rested(before.load, 250.0)
    assert np.allclose(film, rested, rtol=1e-4) and (film < 0.55 * before.load + 1e-9).all()
    assert told["days"] == pytest.approx(4 + 500 + 4)
    assert whole.load.sum() > 1.3 * before.load.sum()  # nothing has grown since the last passage


def test_in_a_winter_nothing_grows(tmp_path):
    loads = []
    for growth in (0.0, 1.0):
        spans = [{"days": 2, "per_day": 12, "growth": growth}]
        crowd = Crowd(scenes.of({**small(ground={"pull": 0.0, "detour": 0.0}), "spans": spans}), tmp_path / f"{growth}")
        crowd.run()
        loads.append(crowd.load)
    assert (loads[1] <= loads[0]).all() and loads[1].sum() < 0.99 * loads[0].sum()
    rows = np.loadtxt(tmp_path / "0.0" / "paths.csv", delimiter=",", skiprows=1, usecols=(0, 4, 5))
    far = sum(np.hypot(*np.diff(rows[rows[:, 0] == n, 1:], axis=0).T).sum() for n in range(240))
    assert loads[0].sum() * 0.25 == pytest.approx(0.5 * far, rel=0.01)  # all of it is there still


def test_a_crowd_that_was_stopped_in_a_pause_goes_on_to_the_same_bits(tmp_path, monkeypatch):
    monkeypatch.setattr(crowds, "EVERY", 0.0)
    scene = scenes.of({**small(), "spans": [{"days": 1, "per_day": 25}, {"days": 30, "per_day": 0}]})
    whole = Crowd(scene, tmp_path / "whole").run()
    for count in (3, 4, 5):
        with pytest.raises(Stopped):
            Crowd(scene, tmp_path / "stopped").run(stop_after(count))
    assert Crowd(scene, tmp_path / "stopped").run() == whole
    for name in ("paths.csv", "cover_final.exr"):
        assert (tmp_path / "stopped" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()


def test_plants_under_feet_grow_in_the_same_days(tmp_path, monkeypatch):
    spans = [{"days": 2, "per_day": 2}, {"days": 50, "per_day": 0, "growth": 0.5}]
    scene = scenes.of({**pressed(plants=["carex:20"]), "spans": spans})
    Crowd(scene, tmp_path).run()
    feet, rests = Feet(scene, tmp_path), []
    monkeypatch.setattr(feet.sim, "rest_plants", rests.append)
    assert feet.press()["passages"] == 12
    assert sum(rests) / DAY == pytest.approx(2 * (2 + 25) + 1.5)  # from the first passage to the last
