"""Pictures, curves, numbers and wheels that make no track are refused in a sentence."""

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.loads import walker
from desire_path.placement import stamps, track
from desire_path.placement.marks import Drive, Marks
from desire_path.placement.track import Wheel
from tests.core.test_track import LINE

# ---- what they press ------------------------------------------------------------------------------


@pytest.mark.parametrize("name", stamps.STAMPS)
def test_each_stamp_stands_where_it_is_put_and_nowhere_else(name):
    """Every mark is one contact, all of the weight is carried, and nothing is odd."""
    gait = track.stamped([(0.0, 0.0), (8 * stamps.STAMPS[name].spacing, 0.0)], name)
    loads = walker.loads(gait)
    on = np.diff((loads.touching != 0).astype(int), axis=1, prepend=0)
    assert (on == 1).sum() == 9 and set(np.unique(loads.touching)) == {0, 1}
    assert loads.mean[0] == pytest.approx(1.0, abs=0.02) and not loads.warnings


@pytest.mark.parametrize(
    "given, says",
    [
        (dict(marks=Marks(spacing=0.0)), "spacing of 0 m"),
        (dict(marks=Marks(spacing=np.nan)), "spacing of nan"),
        (dict(marks=Marks(spacing=1e-6)), "larger spacing"),
        (dict(marks=Marks(spacing=0.5, count=3)), "either"),
        (dict(marks=Marks(count=0)), "0 marks"),
        (dict(marks=Marks(width=-1.0)), "width of -1 m"),
        (dict(marks=Marks(first="up")), "left or right"),
        (dict(marks=Marks(size=0.0)), "size of 0"),
        (dict(marks=Marks(scatter=2.0)), "scatter"),
        (dict(drive=Drive(mass=-1.0)), "mass of -1 kg"),
        (dict(drive=Drive(mass=1.0, depth=0.1)), "either"),
        (dict(drive=Drive(depth=0.0)), "depth of 0 m"),
        (dict(drive=Drive(speed=0.0)), "speed of 0"),
        (dict(drive=Drive(end_speed=np.inf)), "speed of inf"),
        (dict(drive=Drive(frame_rate=0.0)), "frames a second"),
        (dict(marks=Marks(seed=-1)), "seed of -1"),
        (dict(marks=Marks(seed=0.5)), "seed of 0.5"),
        (dict(stamp="slipper"), "no stamp 'slipper'"),
        (dict(ground=lambda at: np.where(at[:, 0] < 3.0, 0.0, np.nan)), "leaves the ground at x 3"),
        (dict(ground=np.nan), "ground is a height"),
    ],
)
def test_numbers_that_make_no_track_are_refused(given, says):
    with pytest.raises(DesirePathError, match=says):
        track.stamped(LINE, **given)


@pytest.mark.parametrize(
    "wheel, says",
    [
        (Wheel(radius=0.0), "radius of 0 m"),
        (Wheel(radius=np.nan), "radius of nan"),
        (Wheel(width=-1.0), "width of -1 m"),
        (Wheel(tread="spikes"), "no tread 'spikes'"),
        (Wheel(gauge=-1.0), "gauge of -1 m"),
        (Wheel(radius=1e-6), "on larger wheels"),
    ],
)
def test_wheels_that_cannot_roll_are_refused(wheel, says):
    with pytest.raises(DesirePathError, match=says):
        track.rolled(LINE, wheel)


def test_a_wheel_deeper_than_its_radius_is_refused():
    with pytest.raises(DesirePathError, match="0.4 m deep"):
        track.rolled(LINE, Wheel(radius=0.3), Drive(depth=0.4))
