"""A walker that is moved as no feet and no fall move it is told: a pose was blended in, or a fall is too short."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import trials
from test_jumps import CLIPS, before, moved, recorded
from test_size import clip, scaled

from desire_path.bake.bake import Bake
from desire_path.ground.sim import Ground
from desire_path.loads import checks, walker
from desire_path.loads.force import PRESSES
from desire_path.motion.gait import Gait
from desire_path.rig import body

HELD = 8  # frames of a pose before the walk


def blended(gait, frames, by):
    """The walk after a pose that stands elsewhere (3,) [m], which goes over into it within some frames, eased."""
    long = before(gait, HELD + frames - 1, (0.0, 0.0, 0.0))
    done = np.clip((np.arange(len(long.time)) - (HELD - 1)) / frames, 0.0, 1.0)
    left = 1.0 - done * done * (3.0 - 2.0 * done)
    return moved(long, slice(None), left[:, None] * np.array(by))


def told(gait, word, **options):
    """The sentences of this walk's loads in which a word stands."""
    return [each for each in walker.loads(gait, **options).warnings if word in each]


@pytest.mark.parametrize("fps", (24, 30))
@pytest.mark.parametrize("frames", (5, 6, 8))
@pytest.mark.parametrize("way", (1.7, 0.8))
def test_a_pose_that_is_blended_in_along_the_ground_is_told(fps, frames, way):
    gait = blended(recorded(fps=fps), frames, (way, 0.0, 0.0))
    (sentence,) = told(gait, "push along the ground")
    frame = int(sentence.split("near frame ")[1].split(",")[0])
    assert HELD - fps // 8 <= frame <= HELD + frames + fps // 8  # forces are filtered over a tenth of a second and more
    # as far there as back again: twice the displacement over the square of half the time, and less for the filter
    needs = 4.0 * way / (frames / fps) ** 2 / 9.81
    assert 0.3 * needs < float(sentence.split("with ")[1].split(" times")[0]) < 1.5 * needs
    assert not told(gait, "gravity")


# pose (m higher) and frames it comes down in: all faster than a fall, and not so fast that they are cuts
DROPS = ((0.1, 2), (0.2, 2), (0.2, 3), (0.3, 3), (0.4, 3), (0.4, 4), (0.4, 5), (0.6, 6), (1.0, 5), (1.0, 8))


@pytest.mark.parametrize(("height", "frames"), DROPS)
def test_a_fall_that_is_harder_than_gravity_draws_is_told(height, frames):
    gait = blended(recorded(), frames, (0.0, 0.0, height))
    (sentence,) = told(gait, "gravity")
    assert abs(int(sentence.split("near frame ")[1].split(",")[0]) - HELD) <= 1
    frame = np.clip(np.arange(-2, frames + 3) / frames, 0.0, 1.0)
    hardest = height * np.diff(frame * frame * (3.0 - 2.0 * frame), 2).max() * 24.0**2 / 9.81
    assert float(sentence.split("falls ")[1].split(" times")[0]) == pytest.approx(hardest, rel=0.02)
    assert not told(gait, "push along the ground")
    assert told(gait, "gravity", model="impulse") == [sentence]


@pytest.mark.parametrize("fps", (24, 30, 60, 120))
@pytest.mark.parametrize("harder", (1.0, 1.95, 2.05))
def test_a_fall_is_told_from_twice_as_hard_on(fps, harder):
    """From rest 1 m up, onto the walk's first pose, with nothing that gives way."""
    gait = recorded(fps=fps)
    long = before(gait, fps, (0.0, 0.0, 0.0))
    height = np.maximum(1.0 - harder * 0.5 * 9.81 * (long.time - 8.0 / 24.0).clip(0.0) ** 2, 0.0)
    assert len(told(moved(long, slice(None), height[:, None] * (0.0, 0.0, 1.0)), "gravity")) == (harder > 2.0)


@pytest.mark.parametrize(
    ("along", "carried", "is_told"),
    ((1.15, 1.0, False), (1.25, 1.0, True), (2.3, 2.0, False), (2.5, 2.0, True), (1.1, 0.2, False), (1.3, 0.2, True)),
)
def test_feet_push_no_more_than_soles_hold(along, carried, is_told):
    """Body weights along the ground, and those carried at the time, in one sample."""
    gait = recorded()
    force = np.zeros((len(gait.part_limb), len(gait.time), 3))
    force[0, 20] = np.array([0.0, -along, -carried]) * gait.mass[0] * 9.81
    sentences = checks.pushes(gait, gait, force)
    assert len(sentences) == is_told
    assert all(f"with {along:.1f} times its weight near frame 21," in each for each in sentences)


def test_only_who_is_moved_so_is_told():
    quiet = replace(blended(recorded(), 6, (0.0, 0.0, 0.0)), walker_name=("Quiet",))
    other = replace(blended(recorded(), 6, (0.8, 0.0, 0.0)), walker_name=("Other",))
    falling = replace(blended(recorded(), 6, (0.0, 0.0, 1.0)), walker_name=("Falling",))
    sentences = told(Gait.join([quiet, other, falling]), "blended")
    assert sorted(each.split(" would")[0].split(" falls")[0] for each in sentences) == ["Falling", "The feet of Other"]


@pytest.mark.parametrize("by", (0.0172, 1.0, 30.0))
@pytest.mark.parametrize("name", (*CLIPS, *trials.TRIALS, "beast"))
def test_what_bodies_do_is_not_told(name, by):
    """From an insect to a dinosaur, at as many samples a second as films have, and as recordings have."""
    skeleton, motion, rate = clip(name)
    for step in (max(round(rate / 24), 1), 1):
        fewer = replace(motion, time=motion.time[1::step] - motion.time[1], matrix=motion.matrix[1::step])
        rig, moving = scaled(skeleton, fewer, by)
        gait = body.gait_from_bones(rig, moving, mass=75.0 * by**3, frame_rate=rate / step / np.sqrt(by))
        assert not told(gait, "blended")


@pytest.mark.parametrize("by", ((1.7, 0.0, 0.0), (0.0, 0.0, 1.0)))
def test_bodies_of_one_piece_may_be_moved_by_others(by):
    gait = blended(recorded(), 6, by)
    assert told(gait, "blended")
    assert not told(replace(gait, part_name=("body",) * len(gait.part_name)), "blended")


def test_what_stops_a_fall_at_its_end_makes_it_no_harder():
    """Feet that come down within a sample of where the fall is hardest."""
    gait = recorded()
    count = len(gait.time)
    com, touching = gait.com.copy(), np.zeros((len(gait.part_limb), count), np.uint8)
    com[0, :, 2] = np.where(np.arange(count) < 20, 1.0, np.where(np.arange(count) < 21, 0.94, 0.88))
    touching[:, 20:] = PRESSES
    assert [each.split(" times")[0] for each in checks.falls(replace(gait, com=com), touching, 1.0)] == [
        "Walker falls 3.5"
    ]
    touching[:, 19:] = PRESSES
    assert not checks.falls(replace(gait, com=com), touching, 1.0)


def test_a_bake_tells_of_it(tmp_path):
    bake = Bake(blended(recorded(), 6, (1.7, 0.0, 0.0)), Ground.flat(), folder=tmp_path / "bake", cell_size=0.05)
    list(bake.run())
    assert any("more than soles hold" in each for each in bake.report["warnings"])


@pytest.mark.parametrize("name", CLIPS)
@pytest.mark.parametrize("fps", (8, 12, 24, 120))
def test_feet_that_slide_are_told_and_none_of_recorded_people(name, fps):
    """Whatever carries it aside: a driver, a parent, an offset that is keyed."""
    gait = recorded(name, fps)
    assert not told(gait, " slide at ")
    if "jump" in name or fps == 8:  # a jump is on the ground for a moment; 8 samples a second show no run's step
        return
    drift = np.outer(gait.time, (0.35, 0.0, 0.0))
    (sentence,) = told(moved(gait, slice(None), drift), " slide at ")
    assert "slide at 0.3 m/s" in sentence or "slide at 0.4 m/s" in sentence


def test_how_fast_feet_may_slide_goes_with_the_size():
    skeleton, motion, rate = clip("cmu_12_01_walk")
    for by in (0.05, 17.0):
        gait = body.gait_from_bones(*scaled(skeleton, motion, by), mass=75.0, frame_rate=rate / np.sqrt(by))
        for speed, is_told in ((0.2, False), (0.35, True)):
            drift = np.outer(gait.time * np.sqrt(by), (speed, 0.0, 0.0))
            assert bool(told(moved(gait, slice(None), drift), " slide at ")) == is_told, (by, speed)
