"""Crowds: which paths emerge, and what is told of them. MODEL 12.5-12.7"""

import json
import math
import os
from dataclasses import replace

import numpy as np
import pytest
from reference import network
from scenes.crowds import EIGHT, park, small

from desire_path import commands
from desire_path.crowd import scene as scenes
from desire_path.crowd.choice import Choice
from desire_path.crowd.crowd import Crowd
from desire_path.ground import maps


def lines(worn, cell):
    return network.pruned(network.thin(network.filled(worn, int(6.0 / cell**2))), int(4.0 / cell))


def straight(scene):
    """The straight lines between all places, as wide as worn ones."""
    x, y = (part - scene.origin[k] for k, part in enumerate(scene.middles()))
    worn = np.zeros(scene.shape, bool)
    for a in scene.places:
        for b in scene.places:
            to = np.subtract(b.at, a.at)
            far = np.hypot(*to)
            if far == 0.0:
                continue
            along = ((x - a.at[0]) * to[0] + (y - a.at[1]) * to[1]) / far
            off = ((x - a.at[0]) * to[1] - (y - a.at[1]) * to[0]) / far
            worn |= (np.abs(off) < 0.7) & (along > 0.0) & (along < far)
    return worn


@pytest.fixture(scope="module")
def meadow(tmp_path_factory):
    """Ten thousand passages between four gates."""
    crowd = Crowd(scenes.of(park(film_every=1000)), tmp_path_factory.mktemp("meadow"))
    return crowd, crowd.run()


def test_a_meadow_shows_desire_paths(meadow):
    """Ways merge: fewer metres than the straight lines between gates have, for few more metres walked."""
    crowd, told = meadow
    scene = crowd.scene
    worn = lines(scene.ground.left(crowd.load) < 0.5, scene.cell)
    length, direct = (network.length(each, scene.cell) for each in (worn, lines(straight(scene), scene.cell)))
    assert length == pytest.approx(469.0, rel=0.03) and length < 0.98 * direct
    assert 4 <= network.junctions(worn) <= 6
    assert told["detour"] == pytest.approx(1.03, abs=0.01)
    assert told["area_below_half_cover"] == pytest.approx(472.0, rel=0.05)


def test_a_meadow_is_told_in_files(meadow):
    crowd, told = meadow
    final = maps.read(crowd.path("cover_final.exr"))
    assert np.array_equal(final.planes["cover"], crowd.scene.ground.left(crowd.load).astype(np.float32))
    assert final.notes["cell"] == 0.5 and final.notes["passages"] == 10_000
    films = sorted(os.listdir(crowd.path("frames")))
    assert films == [f"cover_{n:06d}.exr" for n in range(1000, 10_001, 1000)]
    areas = [(maps.read(crowd.path("frames", name)).planes["cover"] < 0.5).sum() for name in films]
    assert areas == sorted(areas) and areas[-1] > 2 * areas[0] > 0
    with open(crowd.path("crowd.json"), encoding="utf-8") as file:
        assert json.load(file) == told
    assert sum(trip["passages"] for trip in told["trips"]) == 10_000 and len(told["trips"]) == 12
    assert all(1.0 <= trip["walked"] / trip["direct"] < 1.15 for trip in told["trips"])
    with open(crowd.path("paths.csv"), encoding="utf-8") as file:
        rows = [line.split(",") for line in file.read().splitlines()]
    assert rows[0] == ["passage", "kind", "from", "to", "x", "y"]
    first = [row for row in rows[1:] if row[0] == "0"]
    ends = {place.name: place.at for place in crowd.scene.places}
    for row, name in ((first[0], first[0][2]), (first[-1], first[0][3])):
        assert math.dist((float(row[4]), float(row[5])), ends[name]) <= 1.26
    assert {int(row[0]) for row in rows[1:]} == set(range(10_000))


def test_a_year_without_walkers_closes_paths(meadow):
    """The area below half cover halves in about a year, and is gone after three."""
    crowd, _ = meadow
    ground = crowd.scene.ground
    areas = [(ground.left(ground.rested(crowd.load, 365.0 * years)) < 0.5).mean() for years in (0.0, 0.8, 1.6, 3.0)]
    assert areas[1] > 0.5 * areas[0] > areas[2] > 0.0 and areas[3] < 0.01 * areas[0]


def test_least_effort_alone_does_not_bundle(tmp_path):
    """Without the pull ways stay as straight as they were."""
    scene = scenes.of(park(ground={"pull": 0.0}, passages=5000, renewals=50))
    told = (crowd := Crowd(scene, tmp_path)).run()
    worn = lines(scene.ground.left(crowd.load) < 0.5, scene.cell)
    direct = network.length(lines(straight(scene), scene.cell), scene.cell)
    assert network.length(worn, scene.cell) == pytest.approx(direct, rel=0.04)
    assert told["detour"] <= 1.015


def test_ways_through_snow_meet_squarely(tmp_path):
    """The first walkers decide, others go round by their tracks: long detours on few lines."""
    scene = scenes.of(park(EIGHT, ground="snow-25", passages=1000, renewals=20))
    told = (crowd := Crowd(scene, tmp_path)).run()
    worn = lines(scene.ground.left(crowd.load) < 0.5, scene.cell)
    assert network.length(worn, scene.cell) == pytest.approx(505.0, rel=0.05)
    assert 1.11 <= told["detour"] <= 1.21


def test_snow_asks_for_new_ways_as_seldom_as_one_may(tmp_path):
    """Every 5 % of the passages so far, or after each of them: within 2 %, the same lengths and tracks."""
    scene = scenes.of(small(ground="snow-25") | {"passages": 300, "renewals": 3})
    found = []
    for renewal in (scene.ground.renewal, 1e-9):
        crowd = Crowd(replace(scene, ground=replace(scene.ground, renewal=renewal)), tmp_path / str(renewal))
        found.append((crowd.run()["detour"], crowd.load))
    (seldom, load), (each, by_each) = found
    assert seldom == pytest.approx(each, rel=0.02) and not (load == by_each).all()
    assert (load > 0.5).sum() == pytest.approx((by_each > 0.5).sum(), rel=0.02)


def test_passages_depend_on_their_number_alone():
    choice = Choice(scenes.of(small()))
    every = choice.passages(0, 60)
    assert every[20:35] == choice.passages(20, 15)
    load = np.zeros(choice.blocked.shape)
    alone, among = choice.ways(load, every[7:8])[0].points, choice.ways(load, every)[7].points
    assert np.array_equal(alone, among)
    trips = [(each.start, each.goal) for each in choice.passages(0, 2000)]
    assert all(start != goal for start, goal in trips)
    assert trips.count((0, 1)) / 2000 == pytest.approx(1.0 / 4.0, abs=0.04)  # rates 1, 1 and 0.5: 4 parts of 2 and 2
    assert trips.count((0, 2)) / 2000 == pytest.approx(0.5 / 4.0, abs=0.04)


def test_nobody_walks_through_a_pond(tmp_path):
    pond = {"ellipse": [10, 6, 4, 2, 30]}
    crowd = Crowd(scenes.of(small(obstacles=[pond, {"polygon": [[4, 10], [7, 10], [7, 12]]}])), tmp_path)
    crowd.run()
    with open(crowd.path("paths.csv"), encoding="utf-8") as file:
        next(file)
        places = np.array([line.split(",")[4:] for line in file], float)
    blocked = crowd.ways.blocked
    assert blocked.sum() * 0.25 == pytest.approx(math.pi * 8.0 + 3.0, rel=0.1)
    within = np.ones(len(places), bool)
    for nudge in ((0.006, 0.006), (0.006, -0.006), (-0.006, 0.006), (-0.006, -0.006)):  # places are told in centimetres
        i, j = ((places + nudge) / 0.5).astype(int).T
        within &= blocked[j, i]
    assert not within.any() and len(within) > 3000


def test_heavier_walkers_wear_more(tmp_path):
    loads = []
    for mass in (75.0, 150.0):
        crowd = Crowd(
            scenes.of(small(walkers=[{"mass": mass}], ground={"pull": 0.0, "detour": 0.0})), tmp_path / f"{mass}"
        )
        crowd.run()
        loads.append(crowd.load.sum())
    assert loads[1] / loads[0] == pytest.approx(2.0, rel=1e-9)


def test_the_command_walks_a_scene(tmp_path, capsys):
    (tmp_path / "park.json").write_text(json.dumps(small()))
    assert commands.main(["crowd", str(tmp_path / "park.json"), "--out", str(tmp_path / "out")]) == 0
    assert "passages      240" in capsys.readouterr().out
    assert commands.main(["crowd", str(tmp_path / "none.json"), "--out", str(tmp_path / "out")]) == 1
    assert capsys.readouterr().err.count("\n") == 1
