"""A walk at another size, its time scaled with the root of the size, is the same walk."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import beasts, bvh, trials

from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import SOILS
from desire_path.loads import walker
from desire_path.motion import size
from desire_path.motion.gait import Gait
from desire_path.rig import body
from desire_path.rig.body import Motion, Skeleton


def scaled(skeleton, motion, by):
    """Both as large by a factor, time as slow by its root."""
    rest, matrix = np.array(skeleton.rest, float), np.array(motion.matrix, float)
    rest[:, :3, 3] *= by
    matrix[..., :3, 3] *= by
    return (
        Skeleton(skeleton.names, skeleton.parents, rest, skeleton.length * by),
        Motion(motion.time * np.sqrt(by), motion.bones, matrix),
    )


def clip(name):
    if name == "beast":
        skeleton = beasts.skeleton()
        return skeleton, beasts.motion(skeleton, speed=0.9, stride=0.6, duty=0.6), 120.0
    if name in trials.TRIALS:
        trial = trials.make(name, 120.0)
        return trial.skeleton, trial.motion, 120.0
    skeleton, motion, rate = bvh.load(bvh.WALKS / f"{name}.bvh", scale=0.056444)
    return skeleton, motion, rate


@pytest.mark.parametrize(
    "name", ["walk 1.25 m/s", "run 3.8 m/s", "landing, uneven", "cmu_12_01_walk", "cmu_02_04_jump", "beast"]
)
def test_contacts_and_forces_scale(name):
    """From a creature of 1.7 cm to one of 30 m."""
    skeleton, motion, rate = clip(name)
    plain = body.gait_from_bones(skeleton, motion, mass=75.0, frame_rate=rate)
    want = walker.loads(plain)
    assert want.touching.any()
    for by in (0.01, 0.05, 0.3, 17.0):
        gait = body.gait_from_bones(*scaled(skeleton, motion, by), mass=2.0, frame_rate=rate / np.sqrt(by))
        assert gait.leg == pytest.approx(plain.leg * by)
        found = walker.loads(gait)
        assert (found.touching != want.touching).mean() < 1e-3, by
        assert found.clearance == pytest.approx(want.clearance * by, abs=1e-4 * by)
        assert np.sqrt(((found.force / 2.0 - want.force / 75.0) ** 2).mean()) < 0.02, by
        assert [w.split(" of ")[0] for w in found.warnings] == [w.split(" of ")[0] for w in want.warnings]
        on, _ = walker.contacts(gait)
        assert np.array_equal(on != 0, found.touching != 0)


def test_small_feet_change_ground_as_small_as_they_are():
    """Cells of a sole's share: a walk of a twentieth reaches about as many as the walk it is made of."""
    skeleton, motion, rate = clip("cmu_12_01_walk")
    reach = []
    for by in (1.0, 0.05):
        gait = body.gait_from_bones(*scaled(skeleton, motion, by), mass=75.0 * by**3, frame_rate=rate / np.sqrt(by))
        land = Simulation(Ground.flat(), replace(SOILS["soft-soil"], young_modulus=1.35e6 * by), 0.02 * by)
        land.load(gait, walker.loads(gait, ground=land.rest_height))
        i0, i1, j0, j1 = land.reach()
        reach.append((i1 - i0, j1 - j0))
    assert np.abs(np.subtract(*reach)).max() < 200, reach


def test_prints_scale():
    """Built-in soles of a creature of 1.7 cm and one of 30 m, on soil of their size, print what a person's do."""
    skeleton, motion, rate = clip("cmu_12_01_walk")
    found = []
    for by in (1.0, 0.5, 0.01, 2.0, 17.0):
        gait = body.gait_from_bones(*scaled(skeleton, motion, by), mass=75.0 * by**3, frame_rate=rate / np.sqrt(by))
        soft = SOILS["soft-soil"]
        soil = replace(
            soft,
            young_modulus=soft.young_modulus * by,
            layer_depth=soft.layer_depth * by,
            flow_shear=soft.flow_shear * by,
            settle_time=soft.settle_time * np.sqrt(by),
        )
        gait = gait.resample(240.0 / np.sqrt(by))
        land = Simulation(Ground.flat(), soil, 0.01 * by)
        land.load(gait, walker.loads(gait, ground=land.rest_height))
        land.run(len(gait.time) - 1)
        i0, i1, j0, j1 = land.reach()
        pressed, heap = (
            land.read(name, i0, j0, i1 - i0, j1 - j0).astype(float) / by for name in ("compression", "heap")
        )
        found.append((pressed.max(), pressed.sum(), heap.sum()))
    for each in found:
        assert each[1:] == pytest.approx(found[0][1:], rel=0.02)
        assert each[0] == pytest.approx(found[0][0], rel=0.05)  # one cell, which a sole's edge may just reach


def test_recordings_of_before_tell_their_legs():
    """A file without them: by how high the mass centre rises over the feet."""
    skeleton, motion, rate = clip("walk 1.25 m/s")
    gait = body.gait_from_bones(skeleton, motion, mass=75.0, frame_rate=rate)
    assert size.legs(replace(gait, leg=())) == pytest.approx(gait.leg, rel=0.1)


def test_walkers_of_two_sizes_share_a_recording(tmp_path):
    skeleton, motion, rate = clip("walk 1.25 m/s")
    small, _ = scaled(skeleton, motion, 0.25)
    short = Motion(motion.time, motion.bones, scaled(skeleton, motion, 0.25)[1].matrix)  # hurries not
    gaits = [
        body.gait_from_bones(s, m, mass=kg, frame_rate=rate, name=name)
        for s, m, kg, name in ((skeleton, motion, 75.0, "tall"), (small, short, 1.2, "small"))
    ]
    both = Gait.join(gaits)
    path = tmp_path / "both.npz"
    both.save(path)
    both = Gait.load(path)
    assert both.leg == pytest.approx([gaits[0].leg[0], gaits[1].leg[0]])
    loads, apart = walker.loads(both), [walker.loads(g) for g in gaits]
    assert np.array_equal(loads.touching, np.concatenate([a.touching for a in apart]))
    assert np.array_equal(loads.force, np.concatenate([a.force for a in apart]))
    assert np.array_equal(loads.clearance, np.concatenate([a.clearance for a in apart]))
    assert np.array_equal(both.only([1]).leg, both.leg[1:])


def test_sentences_tell_real_sizes():
    skeleton, motion, rate = clip("walk 1.25 m/s")
    gait = body.gait_from_bones(*scaled(skeleton, motion, 0.1), mass=0.1, frame_rate=rate)
    assert not any("above" in w for w in walker.loads(gait).warnings)
    high = walker.loads(gait, ground=-0.03).warnings
    assert any("0.03 m above the ground" in w for w in high)
