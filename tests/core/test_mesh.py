"""Meshes near a walk and maps at points, beside slow twins."""

import numpy as np
import pytest

from desire_path.ground import mesh

TURN = np.array([[0.6, -0.8, 0.1, 3.0], [0.8, 0.6, 0.0, -2.0], [0.0, 0.1, 1.0, 0.5]])


def squares(count, rng):
    """A wavy grid with moved points: points, corners."""
    x, y = np.meshgrid(np.arange(count, dtype=float), np.arange(count, dtype=float))
    points = np.stack([x, y, np.sin(x)], axis=-1).reshape(-1, 3) + rng.uniform(-0.3, 0.3, (count * count, 3))
    a = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    return points.astype(np.float32), np.stack([a, a + 1, a + count + 1, a + count], 1).astype(np.int32).ravel()


def slow_near(points, faces, box):
    """Which faces reach into the box, by looking at each."""
    world = points.astype(float) @ TURN[:, :3].T + TURN[:, 3]
    kept = []
    for face in faces:
        x, y = world[face, 0], world[face, 1]
        if (x < box[0]).all() or (x > box[2]).all() or (y < box[1]).all() or (y > box[3]).all():
            continue
        kept.append(face)
    return world, kept


def test_near_a_walk():
    rng = np.random.default_rng(3)
    points, corners = squares(24, rng)
    box = (1.0, 2.0, 6.5, 9.0)
    world, kept = slow_near(points, corners.reshape(-1, 4), box)
    found = mesh.near(points, corners, None, 4, TURN, box)
    assert found.bad == -1 and len(found.triangles) == 2 * len(kept) > 50
    used = np.unique(np.concatenate(kept))
    assert (found.of == used).all()
    assert np.abs(found.vertices - world[used]).max() < 1e-12
    halves = found.of[found.triangles].reshape(-1, 6)
    assert all(set(half) == set(face) for half, face in zip(halves, kept))
    assert np.allclose(found.low, points.min(axis=0)) and np.allclose(found.high, points.max(axis=0))
    starts = np.arange(0, len(corners) + 1, 4, dtype=np.int32)
    same = mesh.near(points, corners, starts, 0, TURN, box)
    assert (same.triangles == found.triangles).all() and same.vertices.tobytes() == found.vertices.tobytes()
    whole = mesh.near(points, corners, None, 4, TURN)
    assert len(whole.vertices) == len(points) and len(whole.triangles) == 2 * 23 * 23


def test_points_that_are_not_finite():
    points, corners = squares(5, np.random.default_rng(1))
    points[7, 1] = np.nan
    found = mesh.near(points, corners, None, 4, TURN)
    assert found.bad == 7 and len(found.vertices) == len(found.triangles) == 0
    with pytest.raises(ValueError):
        mesh.near(points[:6], corners, None, 4, TURN)


def slow_at(planes, cell, corner, at, still):
    out = {name: np.zeros(len(at), np.float32) for name in planes}
    for n, point in enumerate(at):
        x, y = (np.asarray(point[:2]) - corner) / cell - 0.5
        x, y = (round(v) if abs(v - round(v)) < still else v for v in (x, y))
        i, j = int(np.floor(x)), int(np.floor(y))
        for dj, v in ((0, 1 - (y - j)), (1, y - j)):
            for di, u in ((0, 1 - (x - i)), (1, x - i)):
                for name, plane in planes.items():
                    if 0 <= i + di < plane.shape[1] and 0 <= j + dj < plane.shape[0]:
                        out[name][n] += np.float32(u) * np.float32(v) * plane[j + dj, i + di]
    return out


@pytest.mark.parametrize("still", (0.0, 0.02, 1.0))
def test_maps_at_points(still):
    rng = np.random.default_rng(8)
    planes = {"a": rng.normal(size=(9, 13)).astype(np.float32), "b": rng.normal(size=(9, 13)).astype(np.float32)}
    local = rng.uniform(-1.0, 4.0, (500, 3)).astype(np.float32)
    world = np.einsum("ij,nj->ni", TURN[:, :3], local.astype(float)) + TURN[:, 3]
    corner, cell = world[:, :2].min(axis=0) + 1.0, 0.3
    want = slow_at(planes, cell, corner, world, still)
    got = mesh.at_points(planes, cell, corner, local, TURN, still)
    direct = mesh.at_points(planes, cell, corner, world, still=still)
    assert np.count_nonzero(want["a"]) > 50 and np.count_nonzero(want["a"] == 0.0) > 50
    for name in planes:
        assert np.abs(got[name] - want[name]).max() < 1e-5
        assert np.abs(direct[name] - want[name]).max() < 1e-5
    if still == 1.0:  # the cell a point lies in
        assert np.isin(direct["a"], np.append(planes["a"], np.float32(0.0))).all()
    assert mesh.at_points({}, cell, corner, world) == {}


def test_marks_tell_what_differs_and_no_last_digits():
    rng = np.random.default_rng(5)
    walked, points = rng.normal(size=(40, 3)) + 2.0, rng.normal(size=(50, 3)).astype(np.float32)
    words = {"soil": [1e-3, "snow"], "passes": 3}
    first = mesh.mark([walked, points], words)
    assert first == mesh.mark([walked * (1.0 + 1e-14), points], dict(reversed(words.items())))
    assert mesh.mark([np.array([0.0])]) == mesh.mark([np.array([-1e-12])])
    moved, nudged = walked.copy(), points.copy()
    moved[17, 2] += 1e-5
    nudged[17, 2] = np.nextafter(nudged[17, 2], np.float32(9.0))
    others = {
        mesh.mark(*each)
        for each in (
            ([moved, points], words),
            ([walked, nudged], words),
            ([walked, points[:-1]], words),
            ([points, walked], words),
            ([walked, points], words | {"passes": 4}),
            ([walked, points], words | {"soil": [1e-3, "mud"]}),
            ([walked.reshape(3, 40), points], words),
        )
    }
    assert len(others) == 7 and first not in others
