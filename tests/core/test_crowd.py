"""Crowds: how ground wears and costs, which paths emerge, how they go on after a stop. MODEL 12.5-12.7"""

import contextlib
import filecmp
import json
import math
import os
import sqlite3

import numpy as np
import pytest
from reference import network

from desire_path import commands
from desire_path.crowd import crowd as crowds
from desire_path.crowd import feet as feet_of_crowds
from desire_path.crowd import scene as scenes
from desire_path.crowd import trajectories
from desire_path.crowd.choice import Choice
from desire_path.crowd.covers import COVERS, as_cover, snow, steep
from desire_path.crowd.crowd import Crowd
from desire_path.crowd.feet import Feet
from desire_path.crowd.trajectories import Recorded
from desire_path.crowd.tread import tread
from desire_path.errors import DesirePathError
from desire_path.ground import maps
from desire_path.ground.sim import Ground
from desire_path.paths.arrival import arrival, descend, goal_around

FOUR = [(3, 18, 1.0), (97, 30, 0.8), (66, 97, 0.6), (10, 90, 0.4)]
RATES = [1, 0.5, 0.8, 0.5, 0.7, 0.4, 0.6, 0.4]
EIGHT = [
    (*at, rate)
    for at, rate in zip([(3, 18), (40, 3), (97, 30), (97, 72), (66, 97), (35, 97), (10, 90), (3, 55)], RATES)
]


def park(gates=FOUR, **more):
    places = [{"name": f"gate {n}", "at": [x, y], "rate": rate} for n, (x, y, rate) in enumerate(gates)]
    return {"places": places, "seed": 1, **more}


def small(**more):
    """A meadow of 20 x 16 m between three places, walked in a second."""
    gates = [(2, 3, 1.0), (18, 5, 1.0), (9, 14, 0.5)]
    return park(gates, size=[20, 16], passages=240, renewals=24, **more)


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


@pytest.mark.parametrize("k, cut", [(0.38, True), (0.45, False)])
def test_corners_are_cut_below_the_critical_cost(k, cut):
    """A right-angled paved corner is cut where k < sqrt(2) - 1."""
    scene = scenes.of(
        park(
            [(5, 5, 1.0), (45, 45, 1.0)],
            size=[50, 50],
            cell=0.25,
            ground={"detour": k, "half_passes": 1e9},
            paved=[{"box": [3, 4, 47, 6]}, {"box": [44, 3, 46, 47]}],
        )
    )
    choice = Choice(scene)
    cost = choice.costs(np.zeros(scene.shape))
    cells, far = goal_around(cost, (45.0, 45.0), 0.9, 0.25)
    walked = descend(arrival(cost, cells, 0.25, far), (5.0, 5.0), 0.25)
    assert (np.hypot(*(walked - (45.0, 5.0)).T).min() > 10.0) == cut


def test_ground_wears_as_measured_and_grows_by_its_logit():
    """Cole's lanes: 86, 70, 40 and 20 per cent after 25, 75, 200 and 500 passes."""
    ground = COVERS["meadow"]
    assert 100.0 * ground.left([25, 75, 200, 500]) == pytest.approx([88, 69, 42, 20], abs=1.0)
    load = np.array([0.0, 30.0, 400.0, 5000.0])
    logit = [
        np.log(alpha / (1.0 - alpha))
        for alpha in (ground.left(ground.rested(load, days)[1:]) for days in (0, 100, 300))
    ]
    assert logit[1] - logit[0] == pytest.approx(1.02 * 100 / 365) and logit[2] - logit[0] == pytest.approx(
        1.02 * 300 / 365
    )
    once, twice = ground.rested(load, 50.0), ground.rested(ground.rested(load, 20.0), 30.0)
    assert np.allclose(once, twice, rtol=1e-12)
    assert ground.cost(0.0) == 1.3 and ground.cost(1e9) == pytest.approx(1.0, abs=1e-6)
    assert COVERS["sand"].cost([0.0, 1e6]).tolist() == [1.9, 1.9]
    assert [round(snow(depth).detour, 2) for depth in (0.15, 0.25, 0.35)] == [0.92, 1.54, 2.15]
    slope = steep(np.outer(np.ones(5), 0.1 * np.arange(5.0)), 1.0)  # 10 per cent
    assert slope == pytest.approx(1.0 + 0.5 * 0.35 * 1.33 * 10.0 / (1.5 + 1.5 * 1.33**2))


def test_loads_are_passes_over_a_lane():
    """A way adds one pass over a lane of half a metre, wherever it lies on the cells."""
    for cell in (0.5, 0.25):
        for start, end in (((2.0, 8.1), (18.0, 8.1)), ((3.0, 2.0), (13.0, 14.0))):
            walked = np.linspace(start, end, 200)
            load = tread([walked], [2.0], (int(16 / cell), int(20 / cell)), cell)
            assert load.sum() * cell**2 == pytest.approx(2.0 * 0.5 * math.dist(start, end), rel=1e-6)
    walked = np.linspace((0.0, 8.1), (20.0, 8.1), 400)
    column = tread([walked], [1.0], (64, 80), 0.25)[:, 40]
    y = (np.arange(64) + 0.5) * 0.25
    assert (column * y).sum() / column.sum() == pytest.approx(8.1, abs=1e-6)
    assert math.sqrt((column * (y - 8.1) ** 2).sum() / column.sum()) == pytest.approx(0.28, abs=0.01)
    assert tread([], [], (3, 4), 0.5).tolist() == np.zeros((3, 4)).tolist()


def same(a, b):
    names = ["paths.csv", "cover_final.exr", "crowd.json", *(f"frames/{name}" for name in os.listdir(a / "frames"))]
    assert len(names) > 5 and sorted(os.listdir(a / "frames")) == sorted(os.listdir(b / "frames"))
    return filecmp.cmpfiles(a, b, names, shallow=False)[0] == names


class Stopped(Exception):
    pass


def stop_after(count):
    told = []

    def progress(share):
        told.append(share)
        if len(told) == count:
            raise Stopped

    return progress


def test_a_crowd_that_was_stopped_goes_on_to_the_same_bits(tmp_path, monkeypatch):
    scene = scenes.of(small(film_every=40))
    Crowd(scene, tmp_path / "whole").run()
    for every in (0.0, 1e9):  # with a state after each renewal, and with none
        monkeypatch.setattr(crowds, "EVERY", every)
        folder = tmp_path / f"stopped {every:g}"
        for count in (1, 3, 2):
            with pytest.raises(Stopped):
                Crowd(scene, folder).run(stop_after(count))
            with open(folder / "paths.csv", "ab") as file:
                file.write(b"17,0,half a li")
        begun = []
        Crowd(scene, folder).run(begun.append)
        assert same(tmp_path / "whole", folder)
        assert (begun[0] > 0.2) == (every == 0.0)
        assert not os.path.exists(folder / "crowd.lock")


def test_a_folder_of_another_crowd_begins_anew(tmp_path, monkeypatch):
    monkeypatch.setattr(crowds, "EVERY", 0.0)
    Crowd(scenes.of(small(film_every=40)), tmp_path / "whole").run()
    with pytest.raises(Stopped):
        Crowd(scenes.of({**small(film_every=20), "seed": 7}), tmp_path / "other").run(stop_after(12))
    Crowd(scenes.of(small(film_every=40)), tmp_path / "other").run()
    assert same(tmp_path / "whole", tmp_path / "other")
    state = (tmp_path / "other" / "crowd.state").read_bytes()
    (tmp_path / "other" / "crowd.state").write_bytes(state[:-9] + b"x" + state[-8:])  # damaged: it begins anew
    Crowd(scenes.of(small(film_every=40)), tmp_path / "other").run()
    assert same(tmp_path / "whole", tmp_path / "other")


def test_passages_depend_on_their_number_alone():
    choice = Choice(scenes.of(small()))
    every = choice.passages(0, 60)
    assert every[20:35] == choice.passages(20, 15)
    load = np.zeros(choice.blocked.shape)
    alone, among = choice.ways(load, every[7:8])[0], choice.ways(load, every)[7]
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


def pressed(**more):
    """Some walkers, half of them from left to right through a rectangle, half to and fro."""
    places = [{"name": "left", "at": [1, 4]}, {"name": "right", "at": [15, 4]}]
    press = {"box": [6, 2.4, 8, 5.6], "cell": 0.04, **more}
    return {"places": places, "size": [16, 8], "passages": 12, "renewals": 3, "seed": 3, "press": press}


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


def test_the_command_walks_a_scene(tmp_path, capsys):
    (tmp_path / "park.json").write_text(json.dumps(small()))
    assert commands.main(["crowd", str(tmp_path / "park.json"), "--out", str(tmp_path / "out")]) == 0
    assert "passages      240" in capsys.readouterr().out
    assert commands.main(["crowd", str(tmp_path / "none.json"), "--out", str(tmp_path / "out")]) == 1
    assert capsys.readouterr().err.count("\n") == 1
