"""Contacts and loads against slow twins, against force plates, and at any frame rate."""

import csv
import math
import os
from dataclasses import replace

import numpy as np
import pytest
from scenes import gaits

from desire_path import _native
from desire_path.errors import DesirePathError
from desire_path.loads import walker
from desire_path.motion import size
from desire_path.motion.gait import Gait, Sole

SOLE = Sole([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]], [[0, 2, 1]])


def on_two_feet(time, com, pose, rate):
    """What a person of 70 kg did on two rigid feet. com: (T, 3); pose: (2, T, 7)"""
    return Gait(
        time=time,
        com=com[None],
        mass=[70.0],
        pose=pose,
        limb_walker=[0, 0],
        part_limb=[0, 1],
        soles=(SOLE, SOLE),
        point=np.zeros((2, 3)),
        point_part=[0, 1],
        point_role=[0, 1],
        frame_rate=rate,
        leg=[size.LEG],
    )


def on_one_foot(time, com, pose, rate, **more):
    """What one of 70 kg did on one rigid foot of one point. com: (T, 3); pose: (T, 7); more: members that differ"""
    usual = {"mass": [70.0], "point": np.zeros((1, 3)), "point_part": [0], "point_role": [1]}
    return Gait(
        time=time,
        com=com[None],
        pose=pose[None],
        limb_walker=[0],
        part_limb=[0],
        soles=(SOLE,),
        frame_rate=rate,
        **{**usual, **more},
    )


def two_feet(seed=1, rate=120.0, count=300, hover=0.0):
    """A random walk of a body over two one-point feet that take turns."""
    random = np.random.default_rng(seed)
    time = np.arange(count) / rate
    wobble = [
        sum(random.normal(0, 0.02 / n) * np.sin(2 * np.pi * n * time + random.uniform(0, 6)) for n in (1, 2, 3))
        for _ in range(3)
    ]
    com = np.stack([1.1 * time + wobble[0], wobble[1], 1.0 + 0.5 * wobble[2]], axis=1)
    pose = np.zeros((2, count, 7))
    pose[..., 3] = 1.0
    for p in (0, 1):
        phase = time * 0.95 + 0.5 * p + random.uniform(0, 0.05)
        step, u = np.floor(phase), phase % 1.0
        swing = np.clip((u - 0.6) / 0.4, 0, 1)
        pose[p, :, 0] = 1.15 * (step + swing**2 * (3 - 2 * swing)) - 0.57 * p
        pose[p, :, 1] = 0.1 - 0.2 * p
        pose[p, :, 2] = hover + 0.12 * np.sin(np.pi * swing) ** 2
    return on_two_feet(time, com, pose, rate)


# ---- behaviour ---------------------------------------------------------------------------------------------


def test_mirrored_walk_has_mirrored_loads():
    gait = two_feet(2)
    flip = np.array([1, -1, 1])
    mirrored = replace(
        gait, com=gait.com * flip, pose=np.concatenate([gait.pose[..., :3] * flip, gait.pose[..., 3:]], axis=-1)
    )
    a, b = walker.loads(gait), walker.loads(mirrored)
    assert (a.touching == b.touching).all()
    assert (a.force * flip == b.force).all()


def test_nothing_carries_over_a_cut():
    a, b = two_feet(2), two_feet(3)
    n = len(a.time)
    both = replace(
        a,
        time=np.r_[a.time, a.time + a.time[-1] + a.time[1] - a.time[0]],
        com=np.concatenate([a.com, b.com + (9, 0, 0)], axis=1),
        pose=np.concatenate([a.pose, b.pose + np.eye(7)[0] * 9], axis=1),
        cut=[n],
    )
    loads, apart = walker.loads(both), (walker.loads(a), walker.loads(b))
    assert not loads.touching[:, n - 1 : n + 1].any()  # nobody stands on the ground from one clip to the next
    assert np.array_equal(loads.touching[:, : n - 1], apart[0].touching[:, :-1])
    assert np.array_equal(loads.force[:, :n], apart[0].force)  # up to the cut, and after it, as if there were no other
    assert abs(loads.force[:, n:] - apart[1].force).max() < 1e-6
    assert loads.mean == pytest.approx((apart[0].mean + apart[1].mean) / 2)
    on, _ = walker.contacts(both)
    assert np.array_equal(on, loads.touching)
    assert len(walker.loads(both, ground=lambda xy: np.full(len(xy), np.nan)).warnings) <= 1
    heights = walker.loads(both, ground=np.zeros((len(both.point), 2 * n)))
    assert np.array_equal(heights.force, loads.force)
    fine = walker.loads(both.resample(30.0))
    assert fine.force.shape[1] == len(fine.time)


def test_parts_of_a_limb_carry_what_the_limb_carries():
    gait = two_feet(3)
    loads = walker.loads(gait)
    total = loads.force.sum(axis=0)[:, 2]
    assert total.mean() / (70 * 9.81) == pytest.approx(-1.0, abs=0.05)
    assert np.isnan(loads.point[loads.touching == 0]).all()
    assert np.isfinite(loads.point[loads.touching == 1]).all()
    assert (loads.force[loads.touching == 0] == 0).all()


def test_ground_can_be_a_function_a_number_or_an_array():
    gait = two_feet(1)
    flat, up = walker.loads(gait), replace(gait, pose=gait.pose + [0, 0, 2, 0, 0, 0, 0], com=gait.com + [0, 0, 2])
    for ground in (2.0, lambda xy: np.full(len(xy), 2.0), np.full((2, 300), 2.0)):
        moved = walker.loads(up, ground=ground)
        assert (moved.touching == flat.touching).all()
        assert moved.force == pytest.approx(flat.force, abs=1e-6)
    slow = replace(up.resample(30.0))
    assert walker.loads(slow, ground=np.full((2, len(slow.time)), 2.0)).touching.any()
    nowhere = walker.loads(gait, ground=lambda xy: np.full(len(xy), np.nan))
    assert not nowhere.touching.any() and nowhere.warnings


def test_floating_and_sunken_walkers_are_told():
    gait = two_feet(1)
    light = replace(gait, com=np.concatenate([gait.com[..., :2], gait.com[..., 2:] * 0 + 1], axis=-1))
    assert walker.loads(light).mean[0] == pytest.approx(1.0, abs=0.01)
    light = gaits.writable(light)
    light.pose[:, 120:180, 2] += 0.4 * np.sin(
        np.pi * (np.arange(60) + 0.5) / 60
    )  # both feet in the air, and the body does not fall
    odd = walker.loads(light, limits={"support_fall": 0.0})
    assert odd.mean[0] < 0.9 and any("of its weight on average" in w for w in odd.warnings)
    for ground, word in ((-3.0, "3.00 m above"), (0.4, "0.40 m deep"), (-0.04, "")):
        told = [w for w in walker.loads(gait, ground=ground).warnings if "the ground" in w]
        assert len(told) == bool(word) and all(word in w for w in told), told
    with pytest.raises(DesirePathError, match="below the ground all the time"):
        walker.loads(replace(gait, com=gait.com - [0, 0, 9], pose=gait.pose - [0, 0, 9, 0, 0, 0, 0]))


def test_feet_beside_the_ground_carry_their_own_share():
    # an edge along the walk, one across it, and a hole: what stands on the ground feels nothing of it
    gait = two_feet(2)
    whole = walker.loads(gait)
    both = whole.touching.all(axis=0)
    for gap in (lambda xy: xy[:, 1] < 0.02, lambda xy: xy[:, 0] < 1.2, lambda xy: abs(xy[:, 0] - 1.5) < 0.4):
        loads = walker.loads(gait, ground=lambda xy: np.where(gap(xy), np.nan, 0.0))
        out = np.stack([[gap(gait.pose[p, :, :2] + at[:2]) for at in SOLE.vertices] for p in (0, 1)]).all(axis=1)
        assert (out & (whole.touching != 0))[:, both].any()
        assert (loads.touching == np.where(out, 0, whole.touching)).all()
        assert (loads.force == np.where(out[..., None], 0.0, whole.force)).all()
        assert np.isnan(loads.point[out]).all() and loads.mean == whole.mean
        count = lambda on: int((np.diff(on.astype(int), axis=1, prepend=0) > 0).sum())  # here a limb is a part
        stands, away = whole.touching != 0, 0
        for on, over in zip(stands, out):
            edges = np.flatnonzero(np.diff(np.r_[False, on, False]))
            away += sum(over[a:b].any() for a, b in zip(edges[::2], edges[1::2]))
        words = f"{away} of {count(stands)} steps of"
        assert any(words in each for each in loads.warnings), (words, loads.warnings)
        at = np.concatenate([gait.pose[p, stands[p], :2] for p in (0, 1)])
        takes = " x ".join(f"{each:.1f}" for each in np.ptp(at, axis=0))  # of all steps, beside the ground or not
        assert any(f"which takes up {takes} m." in each for each in loads.warnings), (takes, loads.warnings)
        assert not any("beside the ground" in each for each in whole.warnings)
        on, _ = walker.contacts(gait, lambda xy: np.where(gap(xy), np.nan, 0.0))
        assert (on == loads.touching).all()


def test_a_foot_whose_points_lie_beside_an_edge_stands_on_what_its_sole_reaches():
    gait = replace(two_feet(2), soles=(gaits.box(0.28, 0.10),) * 2)
    whole = walker.loads(gait)
    for edge, slope in ((0.13, 0.0), (0.13, 0.02), (0.16, 0.0)):  # the left sole ends at 0.15
        ground = lambda xy: np.where(xy[:, 1] < edge, np.nan, slope * xy[:, 1])
        reaches = edge < 0.15
        below = walker.ground_below(gait, ground)
        assert np.isnan(below[1]).all() and np.isnan(below[0]).all() != reaches
        loads = walker.loads(gait, ground=ground)
        assert not loads.touching[1].any() and loads.touching[0].any() == reaches
        if reaches:
            assert below[0] == pytest.approx(slope * 0.15)  # of the nearest place of its sole that is over ground
            assert (loads.touching[0] == whole.touching[0]).all()
            assert loads.force[0] == pytest.approx(whole.force[0], rel=0.02, abs=1.0)


def test_bad_words_get_a_sentence():
    gait = two_feet(1)
    with pytest.raises(DesirePathError, match="no load model"):
        walker.loads(gait, "magic")
    with pytest.raises(DesirePathError, match="settle time"):
        walker.loads(gait, "impulse", settle_time=0)
    with pytest.raises(DesirePathError, match="no setting"):
        walker.loads(gait, options={"mu": 1})
    with pytest.raises(DesirePathError, match="An option's ramp_alone of 0 cannot be used: choose one from 0.001"):
        walker.loads(gait, options={"ramp_alone": 0.0})
    with pytest.raises(DesirePathError, match="A limit's shortest of 'long' is no number"):
        walker.loads(gait, limits={"shortest": "long"})
    with pytest.raises(DesirePathError, match="heights have shape"):
        walker.loads(gait, ground=np.zeros((3, 3)))
    with pytest.raises(DesirePathError, match=r"heights of shape \(3,\) for .* places"):
        walker.loads(gait, ground=lambda xy: np.zeros(3))
    for ground in ("flat", object()):
        with pytest.raises(DesirePathError, match="no ground to stand on"):
            walker.loads(gait, ground=ground)
    for value in (-1.0, math.nan, math.inf, "3", True):
        with pytest.raises(DesirePathError, match="cutoff_low of .* (no number|cannot be used)"):
            walker.loads(gait, options={"cutoff_low": value})
        with pytest.raises(DesirePathError, match="touch_speed of .* (no number|cannot be used)"):
            walker.contacts(gait, limits={"touch_speed": value})
    for tau in (0.0, math.nan):
        with pytest.raises(DesirePathError, match="settle time of the soil"):
            walker.loads(gait, "impulse", settle_time=lambda xy, tau=tau: np.full(len(xy), tau))


def test_limits_and_options_are_those_of_the_core():
    """By their names, at its door too; all in a row and old names still do, and warn."""
    for known, rows in ((walker.LIMITS, _native.contact_numbers()), (walker.OPTIONS, _native.load_numbers())):
        assert known == {name: usual for name, _, _, _, usual, _ in rows}
    gait = two_feet(1).check()
    native, (parts, samples) = walker.native_gait(gait), gait.pose.shape[:2]
    below, on = np.zeros((len(gait.point), samples)), np.zeros((parts, samples), "u1")
    for given, kind, words in (
        ({"shortest": -1.0}, ValueError, "limits: shortest of -1 s is out of its range"),
        ({"shortness": 1.0}, ValueError, "limits: it has no number 'shortness'"),
        ({"shortest": "long"}, TypeError, "limits: shortest is no number"),
        (np.zeros(5), TypeError, "limits: not a dict of numbers by name"),
    ):
        with pytest.raises(kind, match=words):
            _native.foot_contact(native, below, on, np.zeros(len(gait.point)), given)
    with pytest.warns(DeprecationWarning, match="limits: numbers in a row are an old way"):
        _native.foot_contact(native, below, on, np.zeros(len(gait.point)), np.array(list(walker.LIMITS.values())))
    with pytest.warns(DeprecationWarning, match="call it max_overlap"):
        old = walker.loads(gait, options={"overlap_most": 0.2})
    assert old == walker.loads(gait, options={"max_overlap": 0.2})


def test_table_has_a_row_a_part_and_sample(tmp_path):
    gait = two_feet(1)
    loads = walker.loads(gait)
    path = tmp_path / "loads.csv"
    walker.write_loads(path, gait, loads)
    with open(path) as file:
        rows = list(csv.DictReader(file))
    assert ",".join(rows[0]) == "time,walker,limb,part,touching,fx,fy,fz,px,py,pz"
    assert len(rows) == 2 * len(gait.time)
    fz = np.array([float(r["fz"]) for r in rows]).reshape(-1, 2).T
    assert fz == pytest.approx(loads.force[..., 2], rel=1e-6, abs=1e-6)
    for row in rows:
        assert (row["px"] == "") == (row["touching"] == "0")
    assert sorted(os.listdir(tmp_path)) == ["loads.csv"]
    with pytest.raises(DesirePathError, match="cannot be written"):
        walker.write_loads(tmp_path / "nowhere" / "loads.csv", gait, loads)


def test_native_door_checks():
    gait = two_feet(1)
    good = walker.native_gait(gait)
    on, clear, ground = np.zeros((2, 300), "u1"), np.zeros(2), np.zeros((2, 300))
    _native.foot_contact(good, ground, on, clear)
    for bad in (
        good[:8],
        good[:3] + (gait.pose[:, :-1].copy(),) + good[4:],
        (gait.time.astype("f4"),) + good[1:],
        "gait",
    ):
        with pytest.raises((TypeError, ValueError)):
            _native.foot_contact(bad, ground, on, clear)
    with pytest.raises((TypeError, ValueError)):
        _native.foot_contact(good, ground[:1], on, clear)
    with pytest.raises(ValueError), pytest.warns(DeprecationWarning, match="numbers in a row are an old way"):
        _native.foot_contact(good, ground, on, clear, np.full(12, -1.0))
    broken = gait.pose.copy()
    broken[1, 7, 2] = np.nan
    with pytest.raises(ValueError, match="pose"):
        _native.foot_contact(good[:3] + (broken,) + good[4:], ground, on, clear)
    with pytest.raises(ValueError):
        _native.foot_force(good, on, ground, 7, 0.2, False, np.zeros((2, 300, 3)), np.zeros((2, 300, 3)))
    with pytest.raises(ValueError):
        _native.resample_count(0.0, 1.0, -5.0)


# ---- the record ------------------------------------------------------------------------------------------------


def test_a_walker_remembers_its_model():
    gait = gaits.pressed([gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -700]])[0]
    plain, papers = walker.Walker(), walker.Walker("impulse", settle_time=0.1, limits={"touch_height": 0.02})
    assert plain.loads(gait).force.tobytes() == walker.loads(gait).force.tobytes()
    want = walker.loads(gait, "impulse", settle_time=0.1, limits={"touch_height": 0.02})
    assert papers.loads(gait).force.tobytes() == want.force.tobytes()
    touching, clearance = papers.contacts(gait)
    assert np.array_equal(touching != 0, want.touching != 0) and clearance == pytest.approx(want.clearance)
    with pytest.raises(DesirePathError, match="magic"):
        walker.Walker("magic").loads(gait)
