"""Who stays a while wears the ground there. MODEL 12.9"""

import math

import numpy as np
import pytest
from scenes.crowds import park, pressed

from desire_path.crowd import scene as scenes
from desire_path.crowd.choice import Choice
from desire_path.crowd.crowd import Crowd
from desire_path.crowd.feet import Feet
from desire_path.crowd.stays import EACH, PACE, stay
from desire_path.errors import DesirePathError
from desire_path.ground import maps

BENCH = (18.0, 14.0)


def benched(linger, visit=0.5, **more):
    """Two gates, and a bench beside the way between them."""
    scene = park([(2, 4, 1.0), (34, 4, 1.0)], size=[36, 20], passages=400, renewals=4, **more)
    bench = {"name": "bench", "at": list(BENCH), "rate": 0, "visit": visit, "linger": linger, "radius": 2.0}
    return scenes.of({**scene, "places": [*scene["places"], bench], "ground": {"pull": 0.0, "regrow": 0.0}})


def walked(scene, folder):
    crowd = Crowd(scene, folder)
    return crowd, crowd.run()


def test_what_stands_wears_by_its_paces(tmp_path):
    """A pace in half a minute for everybody who stays: so much load more than of those who only come by."""
    base, passing = walked(benched(0.0), tmp_path / "0")
    crowd, staying = walked(benched(600.0), tmp_path / "600")
    longer, _ = walked(benched(1200.0), tmp_path / "1200")
    visits = sum(each.by == 2 for each in crowd.ways.passages(0, 400))
    assert visits == pytest.approx(200, abs=30)
    area = crowd.scene.cell**2
    more = [(each.load.sum() - base.load.sum()) * area for each in (crowd, longer)]
    per_stay = 600.0 / EACH * PACE * 0.5  # [passes m^2]
    assert (more[1] - more[0]) / visits == pytest.approx(per_stay, rel=0.1)
    x, y = crowd.scene.middles()
    near = np.hypot(x - BENCH[0], y - BENCH[1]) < 3.0
    assert ((longer.load - crowd.load)[near].sum() * area) / (more[1] - more[0]) > 0.97
    assert staying["detour"] == pytest.approx(passing["detour"], abs=0.02)  # what is paced is no detour


def test_a_stay_keeps_to_its_place_and_to_free_ground():
    chance = np.random.default_rng(4)

    def free(points):
        return bool((points[:, 0] > 0.3).all())  # water on one side

    paced = stay(np.array([0.9, 0.0]), (0.0, 0.0), 2.0, 40_000.0, chance, free)
    assert free(paced) and (np.hypot(*paced.T) <= 2.0).all()
    legs = np.hypot(*np.diff(paced, axis=0).T)
    assert legs[1:] == pytest.approx(PACE) and len(legs) == pytest.approx(40_000 / EACH, rel=0.05)
    halves = np.histogram(paced[:, 1], [-2.0, 0.0, 2.0])[0]
    assert halves.min() > 0.35 * halves.sum()  # here and there, not in one spot
    nowhere = stay(np.array([0.5, 0.0]), (0.0, 0.0), 2.0, 600.0, chance, lambda points: False)
    assert nowhere.tolist() == [[0.5, 0.0]]


def test_ways_lead_by_what_is_visited():
    scene = benched(300.0, visit=1.0)
    choice = Choice(scene)
    passages = choice.passages(0, 20)
    assert {each.by for each in passages} == {2}
    for each, way in zip(passages, choice.ways(np.zeros(scene.shape), passages)):
        assert [stays for _, stays in way.parts] == [False, True, False]
        ends = [scene.places[k].at for k in (each.start, each.by, each.goal)]
        assert math.dist(way.points[0], ends[0]) <= 1.25 and math.dist(way.points[-1], ends[2]) <= 1.25
        assert (np.hypot(*(way.parts[1][0] - ends[1]).T) <= 2.0 + 1e-9).all()
        straight = math.dist(ends[0], ends[1]) + math.dist(ends[1], ends[2])
        assert 0.8 * straight < way.length < 1.1 * straight
        assert choice.direct(each) == pytest.approx(straight, rel=0.15)
        kept = way.thin(4).tolist()
        assert all(place in kept for place in way.parts[1][0].tolist())  # each pace
        steps = np.hypot(*np.diff(way.thin(4), axis=0).T)
        assert steps.max() < 4.01 and (steps > 0.0).all()
    without = Choice(benched(300.0, visit=0.0))
    assert {each.by for each in without.passages(0, 20)} == {-1}
    starts = [(each.start, each.goal, each.aside) for each in passages]
    assert [(each.start, each.goal, each.aside) for each in without.passages(0, 20)] == starts


def test_feet_of_who_stays_are_pressed(tmp_path):
    """A goal inside the rectangle: who stays there presses more of it."""
    share = []
    for linger in (0.0, 240.0):
        given = pressed(box=[13, 2, 16, 6])
        given["places"][1].update(at=[14.5, 4], linger=linger)
        scene = scenes.of({**given, "passages": 6, "renewals": 2})
        Crowd(scene, tmp_path / f"{linger}").run()
        told = Feet(scene, tmp_path / f"{linger}").press()
        planes = maps.read(tmp_path / f"{linger}" / "trodden_final.exr").planes
        share.append(((planes["compression"] > 1e-3).mean(), told["contacts"]))
    assert share[1][0] > 1.3 * share[0][0] and share[1][1] > share[0][1] + 6


@pytest.mark.parametrize(
    "change, words",
    [
        ({"linger": -1}, "linger at 'bench' cannot be -1"),
        ({"linger": 1e9}, "linger at 'bench' cannot be"),
        ({"visit": 1.5}, "share of walkers that visit 'bench' cannot be 1.5"),
        ({"visit": math.nan}, "share of walkers that visit 'bench' cannot be nan"),
    ],
)
def test_stays_that_cannot_be_are_told(change, words):
    places = park([(2, 4, 1.0), (34, 4, 1.0)])["places"]
    with pytest.raises(DesirePathError, match=words):
        scenes.of({"places": [*places, {"name": "bench", "at": [18, 14], **change}]})


def test_visits_are_shares_of_one_crowd():
    places = park([(2, 4, 1.0), (34, 4, 1.0)])["places"]
    both = [{"name": f"bench {n}", "at": [18, 14 + n], "rate": 0, "visit": 0.6} for n in (0, 1)]
    with pytest.raises(DesirePathError, match="add up to 1.2"):
        scenes.of({"places": places + both})
    island = {"name": "island", "at": [50, 50], "rate": 0, "visit": 0.1}
    ring = [{"box": [40, 40, 60, 42]}, {"box": [40, 58, 60, 60]}, {"box": [40, 40, 42, 60]}, {"box": [58, 40, 60, 60]}]
    with pytest.raises(DesirePathError, match="No way leads from 'gate 0' to 'island'"):
        Choice(scenes.of({"places": [*places, island], "obstacles": ring}))
