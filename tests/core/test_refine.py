"""The mesh that shows prints: no gaps, fine where the trail bends, what lies on the faces interpolated."""

from dataclasses import replace

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.ground import refine

CELL = 0.01


def plane(side=8.0, height=0.0):
    """A square of one face of four corners, as Blender cuts it."""
    points = np.array([[0, 0, 0], [side, 0, 0], [side, side, height], [0, side, height]], float)
    triangles = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    return refine.Triangles(points, triangles, triangles, np.zeros(2, np.int32), np.array([0, 4], np.int32))


def print_of(nx=60, ny=40, depth=0.03):
    """Heights of a bowl, and where they changed."""
    y, x = np.mgrid[0:ny, 0:nx]
    inside = ((x - nx / 2) / (0.4 * nx)) ** 2 + ((y - ny / 2) / (0.4 * ny)) ** 2
    return -depth * np.maximum(1.0 - inside, 0.0) ** 2, inside < 1.0


def border_length(made, points):
    sides = np.sort(np.concatenate([made.triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    found, count = np.unique(sides, axis=0, return_counts=True)
    assert count.max() == 2
    alone = found[count == 1]
    return np.linalg.norm(points[alone[:, 0]] - points[alone[:, 1]], axis=1).sum()


def test_prints_are_shown_as_they_are_and_nothing_gapes():
    height, changed = print_of()
    corner = (3.0, 3.0)
    mesh = plane()
    made = refine.refine(mesh, refine.wishes(height, changed, CELL, corner))
    points = made.on_points(mesh.points)
    assert made.valid and len(made.kept) == 0
    assert border_length(made, points) == pytest.approx(32.0, abs=1e-9)
    at = (points[:, :2] - corner) / CELL - 0.5

    def baked(at):
        i, j = np.clip(at[:, 0], 0, 58.999).astype(int), np.clip(at[:, 1], 0, 38.999).astype(int)
        u, v = at[:, 0] - i, at[:, 1] - j
        inside = (at >= 0).all(axis=1) & (at[:, 0] <= 59) & (at[:, 1] <= 39)
        z = (
            height[j, i] * (1 - u) * (1 - v)
            + height[j, i + 1] * u * (1 - v)
            + height[j + 1, i] * (1 - u) * v
            + height[j + 1, i + 1] * u * v
        )
        return np.where(inside, z, 0.0)

    shown = baked(at)[made.triangles]
    middle = at[made.triangles].mean(axis=1)
    assert np.abs(shown.mean(axis=1) - baked(middle)).max() < 2.0 * refine.DEVIATION * CELL
    assert shown.min() < -0.0295  # the deepest is there
    assert made.point_count < 0.7 * height.size  # and the shallow slopes cost little


def test_what_lies_on_the_faces_is_interpolated():
    height, changed = print_of()
    mesh = plane(height=2.0)
    made = refine.refine(mesh, refine.wishes(height, changed, CELL, (3.0, 3.0)))
    points = made.on_points(mesh.points)
    uv = made.on_corners(mesh.points[:, :2] / 8.0)  # a corner for each point
    at = made.corner_points(np.arange(4, dtype=np.int32))
    assert np.allclose(uv * 8.0, points[at][:, :2], atol=1e-6)
    assert (made.on_faces(np.array([7])) == 7).all()
    assert np.allclose(made.on_points(mesh.points[:, 2])[4:], points[4:, 2], atol=1e-6)
    # an edge of the old mesh that is sharp is sharp all along, and no other
    new = np.unique(np.sort(np.concatenate([made.triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1), axis=0)
    old = np.array([[0, 1], [1, 2], [2, 3], [0, 3]])
    sharp = made.on_edges(np.array([True, False, False, False]), old, new)
    on = (points[new][:, :, 1] == 0.0).all(axis=1)
    assert np.array_equal(sharp, on) and on.sum() >= 1


def test_faces_far_from_the_trail_stay():
    count = 40
    x, y = np.meshgrid(np.arange(count + 1.0), np.arange(count + 1.0))
    points = np.stack((x.ravel(), y.ravel(), 0.0 * x.ravel()), axis=1)
    first = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    quads = np.stack((first, first + 1, first + count + 2, first + count + 1), axis=1).astype(np.int32)
    corner = np.arange(4 * len(quads), dtype=np.int32).reshape(-1, 4)
    cut = [[0, 1, 2], [0, 2, 3]]
    mesh = refine.Triangles(
        points,
        quads[:, cut].reshape(-1, 3),
        corner[:, cut].reshape(-1, 3),
        np.repeat(np.arange(len(quads), dtype=np.int32), 2),
        np.arange(0, 4 * len(quads) + 1, 4, dtype=np.int32),
    )
    height, changed = print_of()
    made = refine.refine(mesh, refine.wishes(height, changed, CELL, (20.1, 20.1)))
    assert len(made.kept) > len(quads) - 60
    assert made.sizes.sum() == len(made.corner_points(quads.ravel()))
    assert np.array_equal(made.corner_points(quads.ravel())[: 4 * len(made.kept)], quads[made.kept].ravel())


def test_too_fine_a_wish_stops_and_says_so():
    height, changed = print_of()
    made = refine.refine(plane(), refine.wishes(height, changed, CELL, (3.0, 3.0), size=1e-4 * CELL), 500)
    assert not made.valid
    assert border_length(made, made.on_points(plane().points)) == pytest.approx(32.0, abs=1e-9)


def test_points_that_are_nowhere_are_named():
    mesh = plane()
    points = mesh.points.copy()
    points[2, 1] = np.nan
    mesh = replace(mesh, points=points)
    height, changed = print_of()
    with pytest.raises(DesirePathError, match="Vertex 2"):
        refine.refine(mesh, refine.wishes(height, changed, CELL, (3.0, 3.0)))
