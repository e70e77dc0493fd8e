"""Feet in their prints: how deep they stand, how they come up, and the body that goes with them."""

import numpy as np
import pytest

from desire_path import Bake, Ground, read_index
from desire_path.bake.options import BakeOutput
from desire_path.errors import DesirePathError
from desire_path.ground.sim import Simulation
from desire_path.loads import walker
from desire_path.placement import place, settle_feet
from tests.core.test_place import cmu, plane


@pytest.fixture(scope="module", params=["level", "hill"])
def baked(request, tmp_path_factory):
    """(walk, its loads, Film of its bake, rest height)."""
    folder = tmp_path_factory.mktemp("bake")
    gait = cmu()
    ground = Ground.flat() if request.param == "level" else plane(0.15, 0.2, 1.0)
    if request.param == "hill":
        gait = place.place_feet(gait, ground)
    for _ in Bake(gait, ground, "mud", folder, cell_size=0.01, output=BakeOutput(map_seconds=False)).run():
        pass
    land = Simulation(ground)
    return gait, walker.loads(gait, ground=land.rest_height), settle_feet.Film(read_index(folder)), land.rest_height


def gaps(gait, touching, film, rest_height):
    """Of points of soles that touch, over the ground as it is pressed, by limb and sample."""
    from desire_path.motion import rotation

    for t in range(0, len(gait.time), 7):
        for limb in range(2):
            parts = np.flatnonzero((gait.part_limb == limb) & (touching[:, t] != 0))
            if len(parts):
                at = np.concatenate(
                    [
                        gait.soles[p].vertices @ rotation.matrix(gait.pose[p, t, 3:]).T + gait.pose[p, t, :3]
                        for p in parts
                    ]
                )
                change, pressed = film.at(gait.frame(t), at[:, :2])
                if (pressed > 0.005).sum() > 5:
                    yield (at[:, 2] - rest_height(at[:, :2]) - change)[pressed > 0.5 * np.median(pressed)]


def test_soles_lie_on_the_ground_they_pressed(baked):
    gait, loads, film, rest_height = baked
    sunk = settle_feet.into_prints(gait, loads, film, rest_height)
    before, after = (
        [float(np.quantile(each, 0.1)) for each in gaps(g, loads.touching, film, rest_height)] for g in (gait, sunk)
    )
    assert np.median(before) > 0.015  # it stood over its prints
    low, high = np.quantile(after, (0.1, 0.9))
    assert abs(np.median(after)) < 0.0015 and high < 0.008, (np.median(after), high)
    assert low > min(np.quantile(before, 0.1), 0.0) - 0.006  # toes that dipped into the floor still do
    down = gait.pose[..., 2] - sunk.pose[..., 2]
    assert down.min() >= -1e-12 and 0.02 < down.max() < 0.12
    np.testing.assert_array_equal(sunk.pose[..., :2], gait.pose[..., :2])
    np.testing.assert_array_equal(sunk.pose[..., 3:], gait.pose[..., 3:])
    body = gait.com[0, :, 2] - sunk.com[0, :, 2]
    body = body[gait.cut.max(initial=0) :]  # not the pose the clip begins with
    assert 0.2 * down.max() < body.mean() < down.max() and np.abs(np.diff(body)).max() < 0.001


def test_feet_come_up_in_the_air():
    time = np.arange(10) / 20.0
    depth = np.full((2, 10), np.nan)
    depth[0, 2:5] = 0.02, 0.03, 0.04
    out = settle_feet.eased(depth, time)
    np.testing.assert_array_equal(out[0, :5], [0.0, 0.0, 0.02, 0.03, 0.04])
    assert (np.diff(out[0, 4:9]) < 0.0).all() and out[0, 8:].max() == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_array_equal(out[1], 0.0)


def test_it_stands_as_firmly(baked):
    gait, loads, film, rest_height = baked
    sunk = settle_feet.into_prints(gait, loads, film, rest_height)
    again = walker.loads(sunk, ground=rest_height)
    assert again.mean == pytest.approx(loads.mean, abs=0.03)
    assert (again.touching != loads.touching).mean() < 0.08


def test_without_prints_a_sentence(baked):
    gait, loads, film, rest_height = baked
    far = type(film)(film.index)
    far.at = lambda frame, xy: [np.zeros(len(xy))] * 2
    with pytest.raises(DesirePathError, match="bake the trail"):
        settle_feet.into_prints(gait, loads, far, rest_height)
