"""What a crowd's ground costs, how it wears and grows again. MODEL 12.6"""

import math

import numpy as np
import pytest
from scenes.crowds import park

from desire_path.crowd import scene as scenes
from desire_path.crowd.choice import Choice
from desire_path.crowd.covers import COVERS, snow, steep
from desire_path.crowd.tread import tread
from desire_path.paths.arrival import arrival, descend, goal_around


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
