"""A clip's cycle carried along a path: the feet stand still, passes differ, seeds repeat."""

from dataclasses import replace
from pathlib import Path as File

import numpy as np
import pytest
from scenes import bvh, ship_walk

from desire_path.bake.bake import Bake
from desire_path.errors import DesirePathError
from desire_path.ground.sim import Ground
from desire_path.loads import walker
from desire_path.motion.gait import Gait
from desire_path.motion.scatter import Scatter
from desire_path.placement import cycle, passes, path
from desire_path.placement.path import Path
from desire_path.rig import body
from desire_path.study import trampling

REPO = File(__file__).resolve().parents[2]
WALK = REPO / "tests" / "scenes" / "walks" / "cmu_12_01_walk.bvh"


def recorded_walk():
    """The recorded walk at 60 frames a second."""
    skeleton, motion, rate = bvh.load(WALK, scale=0.056444, every=2)
    return body.gait_from_bones(skeleton, motion, mass=75.0, frame_rate=round(rate))


@pytest.fixture(scope="module")
def walk():
    return recorded_walk()


def in_place(gait):
    """The same walk on a belt: the body stays, the feet slide back."""
    speed = (gait.com[0, -1] - gait.com[0, 0]) / (gait.time[-1] - gait.time[0]) * (1, 1, 0)
    back = gait.time[:, None] * speed
    pose = gait.pose.copy()
    pose[..., :3] -= back
    return replace(gait, com=gait.com - back, pose=pose), float(np.hypot(*speed[:2]))


def slides(gait):
    """How far contact points move while they touch and are at their lowest [m] for each stance and point."""
    loads = walker.loads(gait)
    on, at = loads.touching, walker.point_places(gait)
    found = []
    for k, part in enumerate(gait.point_part):
        low = (at[k, :, 2] < loads.clearance[k] + 0.01) & (on[part] != 0)
        edges = np.flatnonzero(np.diff(np.r_[0, low.astype(int), 0]))
        found += [np.ptp(at[k, a:b, :2], axis=0).max() for a, b in zip(edges[::2], edges[1::2])]
    return np.array(found)


# ---- the cycle -------------------------------------------------------------------------------------------


def test_the_cycle_closes(walk):
    found = cycle.find(walk)
    assert found.speed == pytest.approx(0.89, abs=0.03) and 3.0 < found.seconds < 4.3
    wild = abs(np.diff(walk.resample(120.0).com[0], n=2, axis=0)).max() * 120.0**2  # [m/s^2]
    for phase in (np.linspace(0.999, 1.001, 41), np.linspace(0, 3, 1501)):
        com, pose, stand = found.at(phase)
        step = found.seconds * np.diff(phase)[0]
        assert abs(np.diff(com, n=2, axis=0)).max() / step**2 < 1.3 * wild  # no kick at the seam
        assert np.linalg.norm(np.diff(pose[..., :3], axis=1), axis=-1).max() / step < 6.0
    com, pose, stand = found.at([0.25, 1.25, 7.25])
    assert np.diff(com[:, 0]) == pytest.approx([found.length, 6 * found.length])
    assert pose[:, 1] - pose[:, 0] == pytest.approx(np.tile([found.length] + [0] * 6, (4, 1)), abs=1e-9)


def test_where_a_limb_stands_is_still_while_it_touches(walk):
    found = cycle.find(walk)
    phase = np.arange(2000) / 500
    com, pose, stand = found.at(phase)
    carried = replace(walk, time=phase * found.seconds, com=com[None], pose=pose)
    on = walker.contacts(carried)[0]
    for limb in range(2):
        touch = on[walk.part_limb == limb].any(axis=0)
        both = touch[1:] & touch[:-1]
        assert abs(np.diff(stand[limb], axis=0)[both]).max() < 1e-4


def test_a_clip_in_place_is_carried_by_its_own_speed(walk):
    still, speed = in_place(walk)
    carried = still.carried()
    assert "in place" in carried.warnings[-1]
    went = carried.com[0, -1, :2] - carried.com[0, 0, :2]
    wanted = walk.com[0, -1, :2] - walk.com[0, 0, :2]
    assert went == pytest.approx(wanted, abs=0.08 * np.hypot(*wanted))
    assert walk.carried() is walk
    assert cycle.find(still).speed == pytest.approx(speed, rel=0.05)


@pytest.mark.parametrize("closing", (True, False))
@pytest.mark.parametrize("fps", (24, 30))
def test_a_loop_is_taken_whole(walk, closing, fps):
    """As libraries sell them: whole strides at the scene's rate, in place, the last frame the first or not."""
    found = cycle.find(walk)
    count = int(fps * found.seconds)
    seconds = count / fps
    phase = np.arange(count + closing) / count
    com, pose, _ = found.at(phase)
    way = found.length * phase[:, None] * (1, 0, 0)
    pose[..., :3] -= way
    clip = replace(
        walk, time=np.arange(len(phase)) / fps, com=(com - way)[None], pose=pose, frame_rate=fps, cut=(), jump=()
    )
    again = cycle.find(clip)
    assert again.seconds == pytest.approx(seconds, rel=1e-6)
    assert again.speed == pytest.approx(found.length / seconds, rel=0.08)


def test_who_does_not_walk_is_told(walk):
    still = replace(walk, com=walk.com[:, :1] + 0 * walk.com, pose=walk.pose[:, :1] + 0 * walk.pose)
    with pytest.raises(DesirePathError, match="does not walk ahead"):
        still.along([(0, 0), (5, 0)])
    with pytest.raises(DesirePathError, match="too short"):
        walk.piece(0, 10).along([(0, 0), (5, 0)])


# ---- along -----------------------------------------------------------------------------------------------


def test_feet_do_not_slide_more_than_in_the_clip(walk):
    recorded = slides(walk)
    straight = slides(walk.along([(0, 0), (6, 0)], 3))
    bend = slides(walk.along([(0, 0), (3, 0), (3, 3), (0, 3)], 3, scatter=Scatter(stride=0.1, timing=0.1)))
    for found in (straight, bend):
        assert len(found) > 20
        assert np.quantile(found, 0.75) < 1.1 * np.quantile(recorded, 0.75) + 0.001
        assert found.max() < 1.3 * recorded.max() + 0.001


def test_passes_follow_the_path_there_and_back(walk):
    gait = walk.along([(1, 2), (7, 2)], 4, scatter=Scatter(lateral=0.05)).check()
    assert len(gait.cut) == 3
    for n, (first, after) in enumerate(gait.pieces()):
        x, y = gait.com[0, first:after, 0], gait.com[0, first:after, 1]
        ends = (1, 7) if n % 2 == 0 else (7, 1)
        assert (x[0], x[-1]) == pytest.approx(ends, abs=0.1)
        assert abs(y - 2).max() < 0.4
        speed = abs(x[-1] - x[0]) / (gait.time[after - 1] - gait.time[first])
        assert speed == pytest.approx(0.89, rel=0.25)
    loads = walker.loads(gait)
    assert loads.mean[0] == pytest.approx(1.0, abs=0.03) and not loads.warnings
    one_way = walk.along([(1, 2), (7, 2)], 3, back_and_forth=False)
    assert all(one_way.com[0, first, 0] < 2 for first, _ in one_way.pieces())


def test_how_passes_scatter_may_be_given_number_by_number(walk):
    line = [(0, 0), (3, 0)]
    many = walk.along(line, 2, scatter=Scatter(0.3, 0.1, 0.2), seed=3)
    for carry in (Gait.along, passes.along):
        with pytest.warns(DeprecationWarning, match=r"scatter=Scatter\(lateral=.*timing=.*stride=") as told:
            assert carry(walk, line, 2, lateral=0.3, timing=0.1, stride=0.2, seed=3) == many
        assert told[0].filename == __file__
    for other in (Scatter(0.0, 0.1, 0.2), Scatter(0.3, 0.0, 0.2), Scatter(0.3, 0.1, 0.0)):
        assert walk.along(line, 2, scatter=other, seed=3) != many


def test_a_cycles_length_has_an_old_name(walk):
    found = cycle.find(walk)
    with pytest.warns(DeprecationWarning, match="length"):
        assert found.way == found.length


def test_the_first_pass_keeps_to_the_line_and_seeds_repeat(walk):
    line = [(0, 0), (5, 0)]
    first = walk.along(line, 1, scatter=Scatter(lateral=0.3), seed=3)
    assert abs(first.com[0, :, 1]).max() < 0.1
    few, many = walk.along(line, 3, seed=3), walk.along(line, 5, seed=3)
    n = len(few.time)
    assert np.array_equal(few.pose, many.pose[:, :n]) and np.array_equal(few.com, many.com[:, :n])
    other = walk.along(line, 3, seed=4)
    assert other.com.shape != few.com.shape or not np.array_equal(other.com, few.com)


def test_scatter_is_what_was_asked_for(walk):
    gait = walk.along([(0, 0), (4, 0)], 200, scatter=Scatter(lateral=0.2, timing=0.1, stride=0.1), seed=1)
    spans = gait.pieces()[1:]
    side = [gait.com[0, (a + b) // 2, 1] * (1 if gait.com[0, a, 0] < 2 else -1) for a, b in spans]
    assert np.std(side) == pytest.approx(0.2, rel=0.15) and abs(np.mean(side)) < 0.05
    lasted = np.log([gait.time[b - 1] - gait.time[a] for a, b in spans])
    assert np.std(lasted) == pytest.approx(np.hypot(0.1, 0.1), rel=0.2)


def test_in_a_pause_nobody_is_there(walk):
    gait = walk.along([(0, 0), (3, 0)], 3, pause=5.0).check()
    steps = np.diff(gait.time)
    assert steps.max() == pytest.approx(5.0) and gait.rate() == pytest.approx(60.0)
    pieces = gait.pieces()
    assert [b - a for a, b in pieces[1::2]] == [1, 1] and len(pieces) == 5
    assert [len(gait.there(a, b)) for a, b in pieces] == [1, 0, 1, 0, 1]
    turns = passes.turns_of(gait)
    assert [turn[:2] for turn in turns] == pieces[::2]
    assert [turn[3] for turn in turns] == pytest.approx([0, 5, 5])
    loads, without = walker.loads(gait), walker.loads(walk.along([(0, 0), (3, 0)], 3))
    assert loads.force.sum() == pytest.approx(without.force.sum()) and not loads.warnings


def test_who_goes_round_a_bend_leans_into_it(walk):
    angle = np.linspace(0, np.pi, 80)
    gait = walk.along(3.0 * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    middle = slice(len(gait.time) // 4, 3 * len(gait.time) // 4)
    feet = gait.pose[:, middle, :2].mean(axis=0)
    inside = np.hypot(*feet.T).mean() - np.hypot(*gait.com[0, middle, :2].T).mean()
    assert 0.005 < inside < 0.1
    heights = np.hypot(*gait.com[0, middle, :2].T)
    assert abs(heights - 3.0).max() < 0.2


def test_a_body_follows_the_feet_round_any_corner():
    """c - reach^2 c'' = p: a line, a circle, and the sum over the curve before and after. MODEL 3.6"""
    reach = 0.4
    straight = Path([(0, 0), (7, 0)])
    s = np.linspace(-1, 8, 500)
    place, heading = straight.led(s, reach)
    assert (place == straight.at(s)[0]).all() and (heading == 0).all()
    angle = np.linspace(0, 2 * np.pi, 4000)
    ring = Path(3.0 * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    place, _ = ring.led(np.array([0.5 * ring.length]), reach)
    assert np.hypot(*place[0]) == pytest.approx(
        np.hypot(*ring.at(0.5 * ring.length)[0]) / (1 + (reach / 3) ** 2), abs=2e-3
    )
    for turn in (np.pi / 2, np.pi):
        corner = Path([(0, 0), (4, 0), (4 + 4 * np.cos(turn), 4 * np.sin(turn))])
        s = np.linspace(2, corner.length - 2, 41)
        place, _ = corner.led(s, reach)
        u = np.linspace(-8, 8, 16001)
        weight = np.exp(-abs(u) / reach) / (2 * reach) * (u[1] - u[0])
        assert place == pytest.approx(np.array([weight @ corner.at(each + u)[0] for each in s]), abs=0.01)
        assert np.hypot(*(place - corner.at(s)[0]).T).max() < reach
    assert (corner.led(s, 0.0)[0] == corner.at(s)[0]).all()


def test_a_corner_is_pressed_as_deep_as_a_straight_path(walk, tmp_path):
    def pressed(name, points, **more):
        gait = walk.along(points, **more)
        bake = Bake(gait, Ground.flat(), "dry-sand", tmp_path / name, cell_size=0.02)
        for _ in bake.run():
            pass
        sideways = np.hypot(*walker.loads(gait).force.sum(axis=0)[..., :2].T)
        return bake.report["deepest_m"], sideways.max() / (9.81 * gait.mass[0])

    straight, push = pressed("straight", [(0, 0), (7, 0)])
    for name, points in (("corner", [(0, 0), (4, 0), (4, 3.6)]), ("back", [(0, 0), (4, 0), (1, 0)])):
        deep, sideways = pressed(name, points)
        assert deep == pytest.approx(straight, abs=0.003) and sideways < push + 0.6
    beside, sideways = pressed("beside", [(0, 0), (2, 0), (2, 2)], passes=2, scatter=Scatter(lateral=0.3))
    # one cell between feet that stand side by side there, which nothing falls into, lies lower
    assert beside == pytest.approx(straight, abs=0.006) and sideways < push + 0.6


def test_many_passes_are_made_at_once(walk):
    gait = walk.along([(0, 0), (5, 0)], 500)
    assert len(gait.cut) == 499 and gait.pose.nbytes < 100e6


# ---- paths -----------------------------------------------------------------------------------------------


def test_a_path_is_measured_along_itself():
    line = Path([(0, 0), (0, 0), (3, 0), (3, 4)])
    assert line.length == pytest.approx(7.0, abs=0.15)
    place, heading = line.at([0.0, line.length, -1.0, line.length + 2.0])
    assert place == pytest.approx(np.array([(0, 0), (3, 4), (-1, 0), (3, 6)]), abs=1e-3)
    assert heading == pytest.approx([0, np.pi / 2] * 2, abs=1e-3)
    back = line.backwards()
    s = np.linspace(0, line.length, 50)
    assert back.at(s)[0] == pytest.approx(line.at(line.length - s)[0], abs=1e-9)
    assert back.bend_at(s) == pytest.approx(-line.bend_at(line.length - s), abs=1e-9)
    turned = np.trapezoid if hasattr(np, "trapezoid") else np.trapz
    assert turned(line.bend, line.s) == pytest.approx(np.pi / 2, abs=0.01)
    assert Path([(0, 0, 1), (2, 0, 3)]).height([0.0, 1.0, 9.0]) == pytest.approx([1, 2, 3], abs=1e-3)


def test_paths_are_read(tmp_path):
    file = tmp_path / "path.csv"
    file.write_text("x,y,z\n0,0,1\n2,0,1.5\n\n")
    assert path.read(file).tolist() == [[0, 0, 1], [2, 0, 1.5]]
    file.write_text("\ufeffname, Y ,X\na,1,2\nb,3,4\n", encoding="utf-8")
    assert path.read(file).tolist() == [[2, 1], [4, 3]]
    for text, words in (
        ("", "no columns"),
        ("a,b\n1,2\n", "no columns"),
        ("x,y\n1,2\n", "at least two"),
        ("x,y\n1,2\n3\n", "Line 3"),
        ("x,y\n1,2\n3,four\n", "Line 3"),
        ("x,y\n1,2\nnan,4\n", "Row 2"),
    ):
        file.write_text(text)
        with pytest.raises(DesirePathError, match=words):
            path.read(file)
    with pytest.raises(DesirePathError, match="cannot be read"):
        path.read(tmp_path / "nothing.csv")


@pytest.mark.parametrize(
    "bad, words",
    [
        (dict(path=[(0, 0)]), "two rows"),
        (dict(path=[(0, 0), (0, 0)]), "no length"),
        (dict(path="abc"), "list of places"),
        (dict(path=[(0, 0), (np.nan, 1)]), "Row 2"),
        (dict(passes=0), "0 passes"),
        (dict(passes=1.5), "1.5 passes"),
        (dict(scatter=Scatter(lateral=-1)), "lateral of -1"),
        (dict(scatter=Scatter(stride=2)), "stride of 2"),
        (dict(scatter=Scatter(timing=np.nan)), "timing of nan"),
        (dict(pause=-1), "pause"),
        (dict(passes=10**7), "too long for one recording"),
        (dict(passes=np.inf), "inf passes"),
        (dict(passes=np.nan), "nan passes"),
        (dict(seed=-1), "seed of -1"),
        (dict(seed=0.5), "seed of 0.5"),
        (dict(passes="3"), "3 passes"),
        (dict(seed=None), "None"),
        (dict(ground=2.0), "float is no ground to walk on"),
        (dict(path=[(0, 0), (1e308, 0)]), "Row 2"),
    ],
)
def test_what_cannot_be_walked_gets_a_sentence(walk, bad, words):
    with pytest.raises(DesirePathError, match=words):
        walk.along(**{"path": [(0, 0), (5, 0)], **bad})


# ---- the walk that comes with the package ----------------------------------------------------------------


def test_the_walk_that_comes_along_repeats():
    shipped, made = trampling.walk(75.0), ship_walk.made()
    assert shipped.mass.tolist() == [75.0] and trampling.walk(60.0).mass.tolist() == [60.0]
    for walked in (shipped, made):
        found = cycle.find(walked)
        assert found.seconds == pytest.approx(walked.time[-1]) and abs(found.floor) < 0.005
        assert found.speed == pytest.approx(0.9, abs=0.03)
        loads = walker.loads(walked.along([(0, 0), (5, 0)], 2))
        assert loads.mean[0] == pytest.approx(1.0, abs=0.02) and not loads.warnings
