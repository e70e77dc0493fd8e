"""What callers hand to _native that it cannot use: a sentence, never a crash."""

import numpy as np
import pytest

from desire_path import _native
from desire_path.sim import Ground, Simulation

from tests.scenes import gaits


def standing():
    """A simulation with a box on it, and its recording."""
    sim = Simulation(Ground.flat(), "mud", 0.02)
    gait, loads = gaits.pressed([gaits.box(0.25, 0.1)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -600]], seconds=0.1)
    sim.load(gait, loads)
    return sim._core


def test_plants_cannot_be_opened_once_a_recording_is_loaded():
    core = standing()
    with pytest.raises(ValueError, match="open_plants"):
        core.open_plants(0)
    core.run(6)  # and goes on as if nobody had asked
    assert core.report()["deepest_m"] > 0
