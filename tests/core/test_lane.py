"""Lanes of plants that are trodden, and kinds that are found from what is left of them. MODEL 7.7, 11.10"""

import math
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.ground.plants import KINDS, Kind, share_below, vigour_at
from desire_path.study import calibrate, trampling

REPO = Path(__file__).resolve().parents[2]
COLE = REPO / "tests" / "scenes" / "lanes" / "cole.csv"
SHORT = trampling.Lane(length=1.0, density=200.0, cell_size=0.04)  # enough to see that something works
SEED = 2024  # of a lane that judges: none that a kind was fitted to
LANE = trampling.Lane(seed=SEED)
JUDGED = trampling.Lane(length=2.5, density=160.0, seed=SEED)  # a lane in half the time
FEW = (10, 30)


def side_by_side(*lanes):
    """Covers of several lanes, (kind, what differs in the lane, options) each: arrays, one number for each count."""
    with ThreadPoolExecutor(os.cpu_count() or 1) as workers:
        told = workers.map(
            lambda each: trampling.measure(each[0], lane=replace(JUDGED, **each[1]), threads=1, **each[2]), lanes
        )
        return [np.array([cover for _, cover in rows]) for rows in told]


# ---- MODEL 11.10: the longest tests there are ------------------------------------------------------------


@pytest.fixture(scope="module")
def cole():
    """{days: (counts, cover)} of the measured lanes."""
    rows = trampling.read(COLE)
    return {days: tuple(np.array([row[:2] for row in rows if row[2] == days]).T) for days in (0.0, 365.0)}


@pytest.fixture(scope="module")
def trodden():
    """Cover of one lane of carex after each of Cole's counts, and after its year."""
    sim, marks = trampling.trodden(KINDS["carex"], 500, lane=LANE)
    cover = trampling.read_at(sim, [marks[n - 1] for n in trampling.PASSES], marks[-1])
    sim.rest_plants(365 * trampling.DAY)
    return np.array(cover), trampling.cover(sim)


@pytest.mark.measured
def test_carex_keeps_the_cover_of_coles_lanes(cole, trodden):
    counts, wanted = cole[0.0]
    assert tuple(counts) == trampling.PASSES
    assert abs(trodden[0] - wanted).max() < 4.0, trodden[0]


@pytest.mark.measured
def test_finer_cells_keep_the_same_cover(cole, trodden):
    fine = np.array(
        [
            cover
            for _, cover in trampling.measure(
                "carex", passes=trampling.PASSES[:3], lane=trampling.Lane(seed=SEED, cell_size=0.01)
            )
        ]
    )
    assert abs(fine - cole[0.0][1][:3]).max() < 4.0, fine
    assert abs(fine - trodden[0][:3]).max() < 4.0, (fine, trodden[0])


@pytest.mark.measured
def test_a_year_later_it_has_grown_as_theirs_had(cole, trodden):
    counts, wanted = cole[365.0]
    (rested,) = side_by_side(("carex", {}, dict(passes=(25, 75, 200), rest_days=365.0)))
    reached = np.r_[rested, trodden[1]]
    assert abs(reached - wanted).max() < 8.0, reached


@pytest.mark.measured
def test_cover_falls_monotonically_and_convexly(trodden):
    counts, cover = np.r_[0, trampling.PASSES], np.r_[100.0, trodden[0]]
    slope = np.diff(cover) / np.diff(counts)
    assert (slope < 0).all() and (np.diff(slope) > 0).all()


@pytest.mark.measured
def test_what_must_not_matter_does_not():
    """The walkers' mass, the seed and the frame rate; the kind does."""
    seeds = [("carex", dict(seed=seed), dict(passes=FEW)) for seed in (SEED, 11, 12, 13, 14)]
    found = side_by_side(
        *seeds,
        ("carex", dict(mass=65.0), dict(passes=FEW)),
        ("carex", dict(mass=85.0), dict(passes=FEW)),
        ("carex", dict(frame_rate=30.0), dict(passes=FEW)),
        ("lycopodium", {}, dict(passes=FEW)),
    )
    by_seed, light, heavy, slow, lycopodium = np.array(found[:5]), *found[5:]
    assert np.ptp(by_seed, axis=0).max() < 4.0, by_seed
    assert abs(light - heavy).max() < 5.0, (light, heavy)
    assert abs(slow - by_seed[0]).max() < 3.0, (slow, by_seed[0])
    assert (lycopodium < by_seed[0] - 0.5).all()


def test_vigour_has_mean_0_and_deviation_1_and_the_law_it_says():
    share = (np.arange(100_000) + 0.5) / 100_000
    vigour = vigour_at(share)
    assert abs(vigour.mean()) < 1e-9 and vigour.std() == pytest.approx(1.0, abs=0.03)
    assert (np.diff(vigour) >= 0.0).all() and abs(vigour).max() <= 8.0
    within = abs(vigour) < 7.9
    assert share_below(vigour)[within] == pytest.approx(share[within], abs=1e-9)
    density = np.histogram(vigour, np.linspace(-4.0, 4.0, 81))[0] / (100_000 * 0.1)
    middle = np.linspace(-3.95, 3.95, 80)
    c = 120.0**-0.5
    law = np.exp(-np.sqrt(abs(middle) / c)) / (4.0 * c)
    assert density[abs(middle) > 0.5] == pytest.approx(law[abs(middle) > 0.5], rel=0.05)


# ---- the experiment --------------------------------------------------------------------------------------


def test_a_lane_repeats_and_counts_apart():
    rows = trampling.measure("carex", passes=(12, 4), lane=replace(SHORT, seed=3), threads=1)
    assert [count for count, _ in rows] == [4, 12] and 100.0 > rows[0][1] > rows[1][1] > 50.0
    told = []
    assert (
        trampling.measure("carex", passes=(4,), lane=replace(SHORT, seed=3), progress=told.append, threads=1)
        == rows[:1]
    )
    assert told == sorted(told) and told[-1] == 1.0
    rested = trampling.measure("carex", passes=(4, 12), lane=replace(SHORT, seed=3), rest_days=365.0, threads=1)
    assert all(later > before for (_, later), (_, before) in zip(rested, rows))
    assert trampling.measure("carex", passes=(4, 12), lane=replace(SHORT, seed=4), threads=1) != rows


def test_few_plants_are_as_mixed_as_many():
    assert len(trampling.planted(KINDS["carex"], 5.0, 0.5, 1).roots) == 400  # enough to measure by
    assert len(trampling.planted(KINDS["carex"], 20.0, 0.5, 1).roots) == 800
    assert len(trampling.planted(KINDS["fern"], 5.0, 0.5, 1).roots) == 40
    planted = trampling.planted(KINDS["carex"], 5.0, 0.5, 1, density=80.0)
    assert len(planted.roots) == 200
    low, high = planted.roots.min(axis=0), planted.roots.max(axis=0)
    assert (low > (-1e-3, -0.2501)).all() and (high < (5.001, 0.2501)).all()
    assert np.sort(share_below(planted.vigour)) == pytest.approx((np.arange(200) + 0.5) / 200, abs=0.02)
    assert abs(np.corrcoef(planted.vigour, abs(planted.roots[:, 1]))[0, 1]) < 0.1


def command(*words, cwd):
    env = {**os.environ, "PYTHONPATH": str(REPO / "addon")}
    return subprocess.run(
        [sys.executable, "-m", "desire_path", *map(str, words)], capture_output=True, text=True, env=env, cwd=cwd
    )


def test_the_command_line_measures_a_lane(tmp_path):
    done = command(
        "lane",
        "--kind",
        "lycopodium",
        "--length",
        1,
        "--width",
        0.5,
        "--passes",
        "2,5",
        "--mass",
        75,
        "--seed",
        7,
        "--cell",
        0.04,
        "--out",
        "cover.csv",
        cwd=tmp_path,
    )
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "cover.csv").read_text()
    assert text.startswith("passes,cover\n2,") and text.count("\n") == 3
    rows = trampling.read(tmp_path / "cover.csv")
    assert [row[0] for row in rows] == [2, 5] and 100.0 >= rows[0][1] >= rows[1][1] > 50.0


@pytest.mark.parametrize(
    "words, told",
    [
        (("--passes", "some"), "some"),
        (("--passes", "0,5"), "whole numbers"),
        (("--kind", "nettle"), "nettle"),
        (("--length", "0"), "length"),
        (("--mass", "-5"), "mass"),
        (("--soil", "cheese"), "cheese"),
        (("--kind", "nothing.json"), "nothing.json"),
        (("--rest-days", "-1"), "rest"),
        (("--seed", "-1"), "seed of -1"),
    ],
)
def test_bad_words_are_one_sentence(tmp_path, words, told):
    done = command("lane", "--passes", "1", *words, "--out", "cover.csv", cwd=tmp_path)
    assert done.returncode == 1 and told in done.stderr and done.stderr.count("\n") == 1, done.stderr


@pytest.mark.parametrize("density", [0.0, -1.0, math.nan, 1e9])
def test_a_lane_that_cannot_be_planted_gets_a_sentence(density):
    with pytest.raises(DesirePathError, match="density"):
        trampling.measure("carex", passes=(1,), lane=trampling.Lane(density=density))


def test_what_cannot_be_written_is_told_before_the_work(tmp_path):
    done = command("lane", "--passes", "1", "--length", 0.5, "--cell", 0.04, "--out", "nowhere/cover.csv", cwd=tmp_path)
    assert done.returncode == 1 and "cannot be written" in done.stderr and done.stderr.count("\n") == 1
    assert not done.stdout


def test_tables_are_read(tmp_path):
    file = tmp_path / "cover.csv"
    for text, words in (
        ("", "no columns"),
        ("a,b\n", "no columns"),
        ("passes,cover\nten,3\n", "Line 2"),
        ("passes,cover\n10\n", "Line 2"),
        ("passes,cover\n10,101\n", "Line 2"),
        ("passes,cover\n1.5,90\n", "Line 2"),
        ("passes,cover\n5,nan\n", "Line 2"),
    ):
        file.write_text(text)
        with pytest.raises(DesirePathError, match=words):
            trampling.read(file)
    file.write_text("Cover,passes,days\n90,10,0\n95,10,365\n")
    assert trampling.read(file) == [(10, 90.0, 0.0), (10, 95.0, 365.0)]
    with pytest.raises(DesirePathError, match="cannot be read"):
        trampling.read(tmp_path / "nothing.csv")


def test_a_lanes_numbers_may_be_given_one_by_one():
    rows = trampling.measure("carex", passes=(4,), lane=replace(SHORT, seed=3), threads=1)
    with pytest.warns(
        DeprecationWarning, match=r"measure\(lane=Lane\(length=\.\., density=\.\., cell_size=\.\., seed=\.\.\)\)"
    ):
        assert trampling.measure("carex", passes=(4,), length=1.0, density=200.0, cell_size=0.04, seed=3) == rows
    with pytest.warns(DeprecationWarning):
        sim, marks = trampling.trodden(KINDS["carex"], 2, **{**trampling.USUAL, "length": 1.0})
    assert len(marks) == 2 and sim.cell_size == 0.02


@pytest.mark.parametrize("passes", [(), (0,), (2.5,), (3, math.nan), (math.inf,), ("25",), iter([4, 2.5])])
def test_passes_that_cannot_be_counted_get_a_sentence(passes):
    with pytest.raises(DesirePathError, match="passes .* whole numbers"):
        trampling.measure("carex", passes=passes)


@pytest.mark.parametrize("name, value", [("length", 0.4), ("width", math.nan), ("mass", 0.0), ("rest_days", -1.0)])
def test_a_lane_that_cannot_be_trodden_names_the_number(name, value):
    lane = trampling.Lane(**{name: value} if name != "rest_days" else {})
    with pytest.raises(DesirePathError, match=f"A {name.split('_')[0]} of"):
        trampling.measure("carex", lane=lane, rest_days=value if name == "rest_days" else 0.0)


# ---- the fit ---------------------------------------------------------------------------------------------


def test_a_fit_finds_the_kind_a_lane_was_planted_with():
    kind = replace(KINDS["carex"], strength=0.3, spread=1.2)
    few = (3, 8, 18, 45)  # the last tells how long the strong ones bear
    rows = [
        (count, cover, 0.0)
        for count, cover in trampling.measure(kind, passes=few, lane=replace(SHORT, seed=5), threads=1)
    ]
    rows.append((45, 100.0 - 0.5 * (100.0 - rows[-1][1]), 365.0))
    found = calibrate.fit(rows, seeds=(5,), rounds=2, lane=SHORT, threads=1)
    assert found.worst < 4.0 and found.rms <= found.worst
    assert found.kind.strength == pytest.approx(kind.strength, rel=0.3)
    assert found.kind.spread == pytest.approx(kind.spread, rel=0.35)
    assert found.kind.regrow_rate > 0.0 and found.kind.height == kind.height
    assert [
        count for count, _ in trampling.measure(found.kind, passes=few, lane=replace(SHORT, seed=5), threads=1)
    ] == list(few)


def test_a_count_that_was_taken_twice_counts_by_its_mean():
    rows = [(3, 95.0, 0.0), (8, 90.0, 0.0), (3, 97.0, 0.0), (8, 80.0, 0.0)]
    found = calibrate.fit(rows, seeds=(5,), rounds=1, lane=SHORT, threads=1)
    assert found.passes == (3, 8) and found.wanted == (96.0, 85.0)


def test_a_fit_needs_a_table_it_can_work_with():
    for rows, words in (([(10, 90.0, 0.0)], "at least two"), ([(10, 0.9, 0.0), (20, 0.8, 0.0)], "per cent")):
        with pytest.raises(DesirePathError, match=words):
            calibrate.fit(rows)
    rows = [(10, 90.0, 0.0), (20, 80.0, 0.0)]
    for none in (dict(rounds=0), dict(seeds=())):
        with pytest.raises(DesirePathError, match="at least one of rounds and one of seeds"):
            calibrate.fit(rows, **none)


def test_without_scipy_a_sentence_says_how_to_get_it(tmp_path):
    (tmp_path / "cover.csv").write_text("passes,cover\n2,99\n4,98\n")
    code = (
        "import sys; sys.modules['scipy'] = None; sys.path.insert(0, sys.argv[1]); "
        "from desire_path.__main__ import main; sys.exit(main(sys.argv[2:]))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(REPO / "addon"), "fit", "cover.csv", "--out", "kind.json"],
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert done.returncode == 1 and "desire-path[fit]" in done.stderr and done.stderr.count("\n") == 1
    assert not (tmp_path / "kind.json").exists()


def test_the_shipped_kinds_are_fitted_ones():
    carex, lycopodium = KINDS["carex"], KINDS["lycopodium"]
    assert carex.spread == lycopodium.spread > 1.0 and lycopodium.strength == pytest.approx(0.8 * carex.strength)
    for kind in (carex, lycopodium):
        assert kind.strength / kind.recover_rate == pytest.approx(14 * trampling.DAY)
    assert Kind().spread == 0.0  # the paper's
