"""A jump is a cut and no motion, and nothing that bodies do is taken for one."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import bvh, gaits

from desire_path.bake.bake import Bake
from desire_path.ground.sim import Ground
from desire_path.loads import walker
from desire_path.motion import jumps
from desire_path.motion.gait import Gait
from desire_path.rig import body

CLIPS = ("cmu_02_03_run", "cmu_02_04_jump", "cmu_12_01_walk")
SCALE = 0.056444


def motion(name, fps=24):
    """A clip at about this many samples a second, without its first sample, which is a T-pose in some."""
    skeleton, found, rate = bvh.load(bvh.WALKS / f"{name}.bvh", scale=SCALE)
    step = max(round(rate / fps), 1)
    return skeleton, replace(found, time=found.time[1::step] - found.time[1], matrix=found.matrix[1::step]), rate / step


def recorded(name="cmu_12_01_walk", fps=24):
    skeleton, found, rate = motion(name, fps)
    return body.gait_from_bones(skeleton, found, mass=75.0, frame_rate=rate)


def moved(gait, samples, by):
    """Some samples of a recording somewhere else."""
    com, pose = gait.com.copy(), gait.pose.copy()
    com[:, samples] += by
    pose[:, samples, :3] += by
    return replace(gait, com=com, pose=pose)


def before(gait, count, by):
    """A recording with its first pose held for some samples before it, elsewhere."""
    pick = np.r_[np.zeros(count, int), np.arange(len(gait.time))]
    long = replace(gait, time=np.arange(len(pick)) / gait.frame_rate, com=gait.com[:, pick], pose=gait.pose[:, pick])
    return moved(long, slice(0, count), by)


def test_samples_between_frames_for_a_while_are_no_jump():
    """As of a clip that is played half a frame late: whole frames are far apart there."""
    gait = recorded()
    fine = gait.resample(4 * gait.frame_rate)
    end = len(fine.time) - 1
    pick = np.r_[np.arange(0, 40, 4), np.arange(42, end - 24, 4), np.arange(end - end % 4 - 16, end, 4)]
    late = replace(fine, time=fine.time[pick], com=fine.com[:, pick], pose=fine.pose[:, pick])
    assert not len(jumps.found(late).cut), jumps.found(late).warnings


def test_a_pose_that_stands_alone_presses_nothing_and_changes_nothing():
    plain = recorded()
    whole = walker.loads(plain)
    for by in ((1.7, 0.3, 0.0), (0.0, -0.5, 0.0), (0.0, 0.0, 0.4), (0.0, 0.0, -5.0)):
        cut = jumps.found(before(plain, 1, by))
        assert cut.cut.tolist() == [1] and cut.jump.tolist() == [[1, 0]]
        assert f"jumps {np.linalg.norm(by):.2g} m between frames 1 and 2: taken as a cut" in cut.warnings[-1]
        loads = walker.loads(cut)
        assert not loads.touching[:, :2].any() and not loads.force[:, :1].any()
        np.testing.assert_array_equal(loads.touching[:, 2:], whole.touching[:, 1:])
        np.testing.assert_allclose(loads.force[:, 1:], whole.force, atol=1e-6)
        np.testing.assert_allclose(loads.clearance, whole.clearance, atol=1e-9)
        assert jumps.found(cut) is cut


def test_soles_lie_as_they_do_without_a_pose_that_stands_alone():
    skeleton, found, rate = motion("cmu_12_01_walk")
    alone = found.matrix[:1].copy()
    alone[..., :3, 3] += (0.0, 1.0, -0.6)  # sunk into the floor
    posed = replace(found, matrix=np.concatenate([alone, found.matrix]), time=np.arange(len(found.time) + 1) / rate)
    plain = body.gait_from_bones(skeleton, found, mass=75.0, frame_rate=rate)
    other = body.gait_from_bones(skeleton, posed, mass=75.0, frame_rate=rate)
    assert other.cut.tolist() == [1] and "jumps" in " ".join(other.warnings)
    np.testing.assert_allclose(other.pose[:, 1:], plain.pose, atol=4e-3)


@pytest.mark.parametrize("fps", (12, 24, 60, 120))
def test_a_teleport_a_change_of_take_and_a_frozen_end_are_cuts(fps):
    gait = recorded(fps=fps)
    middle, end = len(gait.time) // 2, len(gait.time)
    assert not len(jumps.found(gait).cut)
    assert jumps.found(moved(gait, slice(middle, end), (0.0, 1.2, 0.0))).cut.tolist() == [middle]
    frozen = moved(gait, slice(middle, end), (0.0, 0.0, 0.0))
    frozen = gaits.writable(frozen)
    frozen.com[:, middle:] = frozen.com[:, :1] + (0.9, 0.0, 0.0)
    frozen.pose[:, middle:] = frozen.pose[:, :1] + np.r_[0.9, np.zeros(6)]
    assert jumps.found(frozen).cut.tolist() == [middle]
    stray = jumps.found(moved(gait, slice(middle, middle + 1), (0.8, 0.8, 0.0)))
    assert stray.cut.tolist() == [middle, middle + 1] and "and 1 more" in stray.warnings[-1]
    pick = np.r_[np.arange(middle), np.arange(fps // 4, middle)]  # it starts again where it began
    again = replace(gait, time=gait.time[: len(pick)], com=gait.com[:, pick], pose=gait.pose[:, pick])
    assert jumps.found(again).cut.tolist() == [middle]
    statue = np.repeat([0, middle], (middle, end - middle))
    put = replace(gait, com=gait.com[:, statue], pose=gait.pose[:, statue])
    assert jumps.found(moved(put, slice(middle, end), (0.0, 1.2, 0.0))).cut.tolist() == [middle]


@pytest.mark.parametrize("fps", (8, 12, 15, 24, 30, 60, 120))
@pytest.mark.parametrize("name", CLIPS)
def test_what_bodies_do_is_no_jump(name, fps):
    gait = recorded(name, fps)
    assert not len(jumps.found(gait).cut)
    fast = replace(gait, time=gait.time / 1.5, frame_rate=gait.frame_rate * 1.5)
    for size in (0.01, 0.1, 30.0):  # of another size, its motion as long as animators make it, or as physics does
        for slower in (1.0, np.sqrt(size)):
            other = replace(
                fast,
                com=size * fast.com,
                time=slower * fast.time,
                frame_rate=fast.frame_rate / slower,
                pose=np.concatenate([size * fast.pose[..., :3], fast.pose[..., 3:]], axis=-1),
            )
            assert not len(jumps.found(other).cut), (size, slower)


def test_an_animation_on_twos_and_threes_is_no_jump():
    for name in CLIPS:
        gait = recorded(name, 24)
        for held in (2, 3, 4):
            pick = np.arange(len(gait.time)) // held * held
            assert not len(jumps.found(replace(gait, com=gait.com[:, pick], pose=gait.pose[:, pick])).cut), (name, held)


def test_a_fall_that_ends_dead_and_a_leap_from_rest_are_no_jumps():
    gait = recorded(fps=24)
    t = np.arange(60) / 24.0
    first = np.zeros(60, int)
    still = replace(gait, time=t, com=gait.com[:, first], pose=gait.pose[:, first])
    fall = np.maximum(-4.9 * np.maximum(t - 0.5, 0.0) ** 2, -4.0)  # from 4 m, with nothing that gives way
    dash = 12.0 * np.maximum(t - 0.5, 0.0)
    for way in (fall[:, None] * (0.0, 0.0, 1.0), dash[:, None] * (1.0, 0.0, 0.0)):
        assert not len(jumps.found(moved(still, slice(None), way)).cut)


def test_a_jump_spread_over_the_samples_of_a_frame_is_one():
    gait = recorded(fps=120)
    ends = np.arange(0, len(gait.time), 5)
    fine = replace(gait, frame_rate=24.0)
    assert not len(jumps.found(fine).cut)
    way = np.clip((np.arange(len(gait.time)) - ends[10]) / 5.0, 0.0, 1.0)  # from frame to frame, in between straight
    cut = jumps.found(moved(fine, slice(None), way[:, None] * (0.0, -1.5, 0.0)))
    assert cut.cut.tolist() == list(range(ends[10] + 1, ends[11] + 1)) and len(cut.warnings) == len(fine.warnings) + 1
    loads, first = walker.loads(cut), walker.loads(fine.piece(0, ends[10] + 1))
    assert not loads.touching[:, ends[10] : ends[11] + 1].any()
    np.testing.assert_array_equal(loads.touching[:, : ends[10]], first.touching[:, :-1])


def test_who_does_not_jump_is_not_cut():
    quiet, other = recorded(), recorded()
    count = len(quiet.time)
    both = jumps.found(Gait.join([moved(other, slice(count // 2, count), (2.0, 0.0, 0.0)), quiet]))
    assert both.jump.tolist() == [[count // 2, 0]]
    loads, alone = walker.loads(both), walker.loads(quiet)
    np.testing.assert_array_equal(loads.touching[4:], alone.touching)
    np.testing.assert_array_equal(loads.force[4:], alone.force)
    assert not loads.touching[:4, count // 2].any()
    touching, _ = walker.contacts(both)
    np.testing.assert_array_equal(touching[4:], walker.contacts(quiet)[0])
    assert not len(both.only([1]).cut) and both.only([0]).jump.tolist() == [[count // 2, 0]]
    fine = both.resample(120.0)
    assert len(fine.jump) == 1 and abs(fine.time[fine.jump[0, 0]] - both.time[count // 2]) < 1e-9
    assert fine.cut.tolist() == fine.jump[:, 0].tolist()


def test_who_is_put_aside_in_the_air_or_below_the_ground_presses_nothing():
    gait = recorded()
    plain = walker.loads(gait)
    for height in (1.0, -2.5):
        loads = walker.loads(jumps.found(before(gait, 12, (0.0, 3.0, height))))
        assert not loads.touching[:, :12].any()
        np.testing.assert_array_equal(loads.touching[:, 13:], plain.touching[:, 1:])
        assert not any("above the ground" in each or "deep in" in each for each in loads.warnings)
        assert walker.contacts(jumps.found(before(gait, 12, (0.0, 3.0, height))))[0][:, :12].sum() == 0
    beside = walker.loads(jumps.found(before(gait, 12, (0.0, 3.0, 0.0))))  # who waits on the ground does stand there
    assert beside.touching[:, 2:10].any()


def test_a_bake_shows_frames_and_the_prints_of_the_walk(tmp_path):
    gait = recorded()
    depth = []
    for made in (gait, before(gait, 1, (1.7, 0.0, 0.0))):
        made.save(tmp_path / "walk.npz")
        bake = Bake(Gait.load(tmp_path / "walk.npz"), Ground.flat(), folder=tmp_path / "bake", cell_size=0.02)
        assert bake.film == "frames"
        list(bake.run())
        depth.append((bake.report["contacts"], bake.report["deepest_m"], bake.report["pressed_m3"]))
        assert bake.report["passes"] == 1
    assert any("jumps 1.7 m between frames 1 and 2" in each for each in bake.report["warnings"])
    assert depth[0] == pytest.approx(depth[1], rel=0.02)


def test_jumps_are_kept_in_the_file(tmp_path):
    cut = jumps.found(before(recorded(), 1, (1.7, 0.0, 0.0)))
    cut.save(tmp_path / "walk.npz")
    again = Gait.load(tmp_path / "walk.npz")
    assert again.jump.tolist() == cut.jump.tolist() and again.cut.tolist() == cut.cut.tolist()
    assert jumps.found(again) is again


def test_passes_are_of_one_piece_and_tell_of_the_jump():
    gait = recorded()
    plain = gait.along([(0, 0), (4, 0)], 2)
    passes = jumps.found(before(gait, 1, (1.7, 0.0, 0.0))).along([(0, 0), (4, 0)], 2)
    assert passes.frame_start == gait.frame_start and not len(passes.jump) and len(passes.cut) == len(plain.cut) == 1
    assert any("jumps 1.7 m" in each for each in passes.warnings)
    np.testing.assert_allclose(passes.com, plain.com, atol=1e-6)


def test_loads_of_a_recording_are_cut_where_it_jumps():
    gait = recorded()
    whole, loads = walker.loads(gait), walker.loads(before(gait, 1, (1.7, 0.3, 0.0)))
    assert "jumps 1.7 m" in loads.warnings[0] and loads.warnings[1:] == whole.warnings
    np.testing.assert_allclose(loads.force[:, 2:], whole.force[:, 1:], atol=1e-6)
    np.testing.assert_array_equal(walker.contacts(before(gait, 1, (1.7, 0.3, 0.0)))[0] != 0, loads.touching != 0)


def test_who_has_no_feet_does_not_jump():
    gait = recorded()
    ghost = replace(
        gait,
        com=np.concatenate([gait.com, gait.com]),
        mass=[75.0, 75.0],
        walker_name=("Walker", "Ghost"),
        leg=np.r_[gait.leg, gait.leg],
        limb_walker=np.r_[gait.limb_walker, 1],
        limb_name=(*gait.limb_name, "none"),
    )
    ghost = gaits.writable(ghost)
    ghost.com[1, 40:] += 3.0
    assert jumps.found(ghost.check()) is ghost


@pytest.mark.parametrize("samples", (1, 2, 3, 4))
@pytest.mark.parametrize("off", (0.25, 0.5, 0.75))
def test_a_jump_spread_over_two_frames_is_one(samples, off):
    """Keys half a frame off: what is shown between them lies half in this frame, half in the next."""
    gait = recorded(fps=120)
    step = 5 // samples if samples == 1 else 1
    fps = gait.frame_rate / (step * samples)
    fine = replace(gait, time=gait.time[::step], com=gait.com[:, ::step], pose=gait.pose[:, ::step], frame_rate=fps)
    at = (np.arange(len(fine.time)) / samples - 10.0 - off).clip(0.0, 1.0)
    cut = jumps.found(moved(fine, slice(None), at[:, None] * (0.0, -2.0, 0.0)))
    inside = np.flatnonzero((at > 0.0) & (at < 1.0))
    assert len(cut.cut) and set(inside) <= set(range(int(cut.cut[0]), int(cut.cut[-1]) + 1)), (inside, cut.cut)
    assert int(cut.cut[-1]) - int(cut.cut[0]) <= 2 * samples
    assert not walker.loads(cut).touching[:, inside].any()


def test_who_walks_in_one_piece_is_not_said_to_touch_nothing_in_another():
    gait = recorded(fps=60)
    up = moved(gait, slice(0, 20), (0.0, 0.5, 0.6))  # waits in the air
    loads = walker.loads(up)
    assert loads.touching[:, 30:].any() and not loads.touching[:, :20].any()
    assert not any("never touches" in each for each in loads.warnings), loads.warnings
