"""A mass nobody gave is estimated from the legs, and said."""

from dataclasses import replace

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.rig import body, mass, rigs
from tests.core.test_body import person


def test_height_from_legs():
    bones = person()
    # hip to knee 0.42, knee to ankle 0.41: 0.491 of the height, Winter
    leg = np.hypot(0.42, 0.01) + np.hypot(0.41, 0.03)
    assert mass.standing_height(bones, rigs.detect(bones)) == pytest.approx(leg / 0.491, rel=1e-6)
    kilograms, height = mass.estimate(bones, rigs.detect(bones))
    assert 1.6 < height < 1.8 and kilograms == pytest.approx(22.0 * height**2)
    words = mass.sentence("Ann", kilograms, height)
    assert "Ann" in words and f"{kilograms:.3g} kg" in words and f"{height:.2f} m" in words


def test_a_bent_rest_pose_is_no_shorter():
    bones = person()
    rest = bones.rest.copy()
    row = {name: i for i, name in enumerate(bones.names)}
    bent = [row[n] for n in ("shin.L", "foot.L", "toe.L", "shin.R", "foot.R", "toe.R")]
    knees = rest[[row["shin.L"], row["shin.R"]], :3, 3].copy()
    rest[bent, 1, 3] -= 0.2  # the knees go forward, the thighs get longer by as much as they slant
    longer = np.linalg.norm(knees[0] + (0, -0.2, 0) - rest[row["thigh.L"], :3, 3]) - np.hypot(0.42, 0.01)
    found = rigs.detect(bones)
    plain = mass.standing_height(bones, found)
    assert mass.standing_height(replace(bones, rest=rest), found) == pytest.approx(plain + longer / 0.491)


def test_without_legs_the_hips_tell():
    bones = person()
    found = rigs.detect(bones)
    feet = tuple(replace(foot, thigh=None, shank=None) for foot in found.feet)
    assert mass.standing_height(bones, replace(found, feet=feet)) == pytest.approx(0.916 / 0.491, rel=0.02)


def test_no_telling():
    bones = person()
    found = rigs.detect(bones)
    many = replace(found, feet=found.feet * 2)
    with pytest.raises(DesirePathError, match="mass of Rex cannot be estimated.*kilograms"):
        mass.estimate(bones, many, "Rex")
    bare = replace(found, hips=None, feet=tuple(replace(f, thigh=None, shank=None) for f in found.feet))
    with pytest.raises(DesirePathError, match="cannot be estimated"):
        mass.estimate(bones, bare)


def test_the_legs_above_a_foot():
    bones = person()
    assert rigs.legs(bones, "foot.R") == ("thigh.R", "shin.R")
    assert rigs.legs(bones, "hips") == (None, None)
    unnamed = replace(bones, names=tuple(f"b{i}" for i in range(len(bones.names))))
    names = dict(zip(bones.names, unnamed.names))
    assert rigs.legs(unnamed, names["foot.L"]) == (names["thigh.L"], names["shin.L"])


def test_the_mass_centre_may_be_a_bone():
    bones = person()
    whole = rigs.Segment("body", 1.0, 0.0, (("neck", 0.0),))
    found = replace(rigs.detect(bones), segments=(whole,))
    assert "neck" in found.bones
    still = body.Motion(np.arange(4) / 24.0, bones.names, np.tile(bones.rest, (4, 1, 1, 1)))
    g = body.gait_from_bones(bones, still, mass=70.0, rig=found, frame_rate=24.0)
    np.testing.assert_allclose(g.com[0], np.tile((0, 0, 1.5), (4, 1)), atol=1e-6)


@pytest.mark.parametrize(
    "height, kilograms, chosen, words, cannot_be",
    [
        (1.75, 75.0, True, None, None),
        (10.0, 14.0 * 10.0**3, True, None, None),  # a giant who weighs as one
        (10.0, 14.0 * 10.0**3 / 9.0, True, None, None),  # .. or ten times less
        (10.0, 14.0 * 10.0**3 / 11.0, True, "10 m tall: if that is not meant", False),
        (10.0, 14.0 * 10.0**3 * 299.0, True, "if that is not meant", False),
        (10.0, 14.0 * 10.0**3 * 301.0, True, "which cannot be", True),
        (175.0, 75.0, True, "apply a scale of 0.01 to it, as it seems to be in centimetres", True),
        (59.0, 75.0, False, "since nobody gave it another mass", False),  # a creature of that size may be
        (61.0, 75.0, False, "which cannot be", True),
        (0.02, 75.0, False, "since nobody gave it another mass", False),
        (0.0175, None, True, "apply a scale of 100 to it", False),
    ],
)
def test_who_is_of_no_persons_size_is_told_or_refused(height, kilograms, chosen, words, cannot_be):
    found = mass.odd_size("Ann", height, kilograms, chosen)
    if words is None:
        assert found is None
    else:
        assert found is not None and words in found[0] and found[1] is cannot_be
