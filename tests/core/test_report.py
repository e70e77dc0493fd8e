"""What a walk's forces come to: contacts one by one, cadence, mean, and the table of contacts."""

import csv
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from scenes import trials

from desire_path.loads import report, walker
from desire_path.rig import body
from tests.core.test_cli import REPO
from tests.core.test_place import cmu
from tests.core.test_walker import two_feet


@pytest.fixture(scope="module")
def walk():
    gait = two_feet()
    return gait, walker.loads(gait)


def test_contacts_are_what_touches(walk):
    gait, loads = walk
    found = report.contacts(gait, loads)
    for limb in (0, 1):
        own = [each for each in found if each.limb == limb]
        assert len(own) == np.count_nonzero(np.diff(loads.touching[limb].astype(int), prepend=0) == 1)
        seconds = sum(each.end - each.start for each in own)
        assert seconds == pytest.approx(np.count_nonzero(loads.touching[limb]) / 120.0, abs=1e-6)
        # every newton second is somebody's
        assert sum(each.impulse for each in own) == pytest.approx(-loads.force[limb, :, 2].sum() / 120.0, rel=1e-6)
        for each in own:
            inside = (loads.time >= each.start) & (loads.time <= each.end)
            assert each.peak == pytest.approx(-loads.force[limb, inside, 2].min())
            assert each.mean <= each.peak
            stands = gait.pose[limb, inside, :2]
            assert (stands.min(axis=0) - 1e-3 <= each.place[:2]).all()
            assert (stands.max(axis=0) + 1e-3 >= each.place[:2]).all()
    assert [each.start for each in found] == sorted(each.start for each in found)


def test_a_walkers_numbers(walk):
    gait, loads = walk
    (told,) = report.summary(gait, loads)
    assert told["contacts"] == len(report.contacts(gait, loads)) and told["mass_kg"] == 70.0
    assert told["cadence_per_min"] == pytest.approx(2 * 0.95 * 60, rel=0.05)  # two steps a cycle
    assert told["mean_force_bw"] == loads.mean[0] and told["speed_m_s"] == pytest.approx(1.1, rel=0.1)
    assert told["air_share"] == 0.0 and told["peak_force_bw"] > 1.0
    lines = report.sentences(told)
    assert f"{told['contacts']} contacts" in lines[0] and "body weights" in lines[1] and len(lines) == 2
    warned = replace(loads, warnings=("It floats.",))
    assert report.summary(gait, warned)[0]["warnings"] == ["It floats."]


def test_one_who_stands_has_no_cadence():
    gait = two_feet(count=60)
    still = replace(gait, com=np.repeat(gait.com[:, :1], 60, axis=1), pose=np.repeat(gait.pose[:, :1], 60, axis=1))
    (told,) = report.summary(still, walker.loads(still))
    assert told["cadence_per_min"] is None and told["speed_m_s"] == 0.0
    assert told["mean_force_bw"] == pytest.approx(1.0, abs=0.02)


def test_feet_press_together_between_them():
    gait = cmu()
    loads = walker.loads(gait)
    both, left, right = (report.pressure_centre(gait, loads, *limbs) for limbs in ((0, 1), (0,), (1,)))
    parts = np.isfinite(left).all(axis=1) & np.isfinite(right).all(axis=1)
    assert parts.sum() > 20
    weight = [-loads.force[np.flatnonzero(gait.part_limb == k), :, 2].sum(axis=0)[parts, None] for k in (0, 1)]
    want = (weight[0] * left[parts] + weight[1] * right[parts]) / (weight[0] + weight[1])
    np.testing.assert_allclose(both[parts], want, atol=1e-6)
    assert np.isnan(left[~np.isfinite(loads.point[gait.part_limb == 0]).any(axis=(0, 2))]).all()


def test_the_table_of_contacts(tmp_path, walk):
    gait, loads = walk
    report.write_contacts(tmp_path / "contacts.csv", gait, loads)
    with open(tmp_path / "contacts.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    found = report.contacts(gait, loads)
    assert list(rows[0]) == report.COLUMNS.split(",") and len(rows) == len(found)
    for row, each in zip(rows, found):
        assert row["limb"] == gait.limb_name[each.limb]
        assert float(row["start"]) == pytest.approx(each.start, abs=1e-6)
        assert float(row["impulse"]) == pytest.approx(each.impulse, rel=1e-6)


def test_the_command_writes_both_tables(tmp_path, walk):
    walk[0].save(tmp_path / "walk.npz")
    done = subprocess.run(
        [sys.executable, "-m", "desire_path", "loads", "walk.npz", "--out", "loads.csv", "--contacts", "contacts.csv"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        env={"PYTHONPATH": str(REPO / "addon")},
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "loads.csv").exists() and (tmp_path / "contacts.csv").exists()
    assert "contacts, 1" in done.stdout and "Mean force" in done.stdout


def test_feet_that_land_together_have_no_cadence():
    """Off a box, one foot a blink after the other: two touch-downs, but no steps."""
    trial = trials.make("landing, uneven")
    gait = body.gait_from_bones(trial.skeleton, trial.motion, mass=trial.mass, frame_rate=trial.rate)
    loads = walker.loads(gait, ground=0.0)
    (told,) = report.summary(gait, loads)
    downs = [each.start for each in report.contacts(gait, loads) if each.start > loads.time[0]]
    assert len(downs) == 2 and 0.0 < downs[1] - downs[0] < 0.1
    assert told["cadence_per_min"] is None and "a minute" not in report.sentences(told)[0]
