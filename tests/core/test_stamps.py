"""Stamps: of pictures, of meshes, and those that come with Desire Path. MODEL 3.8"""

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.placement import stamps, track
from desire_path.placement.marks import Drive, Marks, lay
from tests.core.test_track import LINE, at_once, marks


def test_a_picture_is_a_stamp():
    """Two bars, the front one whole, the other half as deep and on the left, lie where they are painted."""
    pixels = np.zeros((30, 10))
    pixels[:6], pixels[24:, :5] = 1.0, 0.5
    own = stamps.Stamp.picture(pixels, 0.3, 0.02)
    found, press = at_once(lay([(0.0, 0.0), (1.0, 0.0)], own, Marks(count=1, width=0.0), Drive(depth=0.03)))
    i0, _, j0, _ = press.window
    front, behind, right = (found[-j0 - 3 - j, -i0 + i] for i, j in ((12, 0), (-14, -5), (-14, 2)))
    assert front == pytest.approx(0.03, abs=1e-3) and behind == pytest.approx(0.02, abs=1e-3) and right == 0.0


def test_large_pictures_are_made_coarser():
    own = stamps.Stamp.picture(np.ones((1000, 300)), 0.3)
    sole = own.sole()
    assert len(sole.triangles) <= 2 * stamps.MAX_PIXELS**2
    assert np.ptp(sole.vertices[:, 0]) == pytest.approx(0.3, rel=0.03)


@pytest.mark.parametrize(
    "given, says",
    [
        ((np.zeros((4, 4)),), "black all over"),
        ((np.zeros((0, 4)),), "rows and columns"),
        ((np.ones(4),), "rows and columns"),
        ((np.full((4, 4), np.nan),), "NaN"),
        ((np.ones((4, 4)), 0.0), "length of 0 m"),
        ((np.ones((4, 4)), 0.3, -1.0), "height of -1 m"),
        ((np.ones((4, 4)), np.nan), "length of nan"),
    ],
)
def test_pictures_that_are_no_stamps_are_refused(given, says):
    with pytest.raises(DesirePathError, match=says):
        stamps.Stamp.picture(*given)


def test_a_mesh_of_ones_own_is_a_stamp():
    corner = np.array([(x, y, z) for z in (5, 6) for y in (0, 1) for x in (2, 2.5)], float)
    faces = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2)]
    own = stamps.Stamp.mesh(corner, faces, spacing=1.5)
    sole = track.stamped(LINE, own).soles[0]
    np.testing.assert_allclose(sole.vertices.min(axis=0), (-0.25, -0.5, 0.0), atol=1e-6)
    np.testing.assert_allclose(sole.vertices.max(axis=0), (0.25, 0.5, 1.0), atol=1e-6)
    assert len(marks(track.stamped(LINE, own))[0]) == 5
    with pytest.raises(DesirePathError, match="no length along x"):
        stamps.Stamp.mesh(corner * (0, 1, 1), faces)
    with pytest.raises(DesirePathError, match="no faces"):
        stamps.Stamp.mesh(corner, [])
    with pytest.raises(DesirePathError, match="NaN"):
        stamps.Stamp.mesh(corner * np.nan, faces)


@pytest.mark.parametrize("name", stamps.STAMPS)
def test_stamps_look_down_and_are_as_long_as_they_say(name):
    stamp = stamps.STAMPS[name]
    left, right = stamp.sole(True), stamp.sole(False)
    for sole in (left, right):
        corner = sole.vertices[sole.triangles].astype(float)
        normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        assert (normal[:, 2] < 1e-12).all()
        assert sole.vertices[:, 2].min() == pytest.approx(0.0, abs=1e-6)
        assert np.ptp(sole.vertices[:, 0]) == pytest.approx(stamp.length, rel=0.01)
        assert abs(sole.vertices[:, 0].min() + sole.vertices[:, 0].max()) < 0.01 * stamp.length
    np.testing.assert_array_equal(left.vertices, right.vertices * np.float32((1, -1, 1)))
