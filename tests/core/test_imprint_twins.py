"""Imprint, rings and ground heights against their slow twins."""

import numpy as np
import pytest

from desire_path import _native
from tests.reference import imprint as slow


def unit(q):
    return q / np.linalg.norm(q)


def shoe(rng, around=9, along=7):
    """A closed, bumpy lump about as large as a foot."""
    u = np.pi * np.arange(along + 1)[:, None] / along
    v = 2 * np.pi * np.arange(around) / around
    vertices = np.stack(
        np.broadcast_arrays(-0.14 * np.cos(u), 0.05 * np.sin(u) * np.cos(v), 0.03 * np.sin(u) * np.sin(v)), axis=-1
    )
    vertices = vertices.reshape(-1, 3) + rng.normal(0, 0.003, (vertices.size // 3, 3))
    a, b = np.mgrid[0:along, 0:around]
    p, q = a * around + b, a * around + (b + 1) % around
    faces = np.stack([np.stack([p, q, p + around], -1), np.stack([q, q + around, p + around], -1)])
    return vertices.astype(np.float32), faces.reshape(-1, 3).astype(np.int32)


def press(soles, poses, x0, y0, cell, samples, shape):
    bottom, cover = np.full((2, *shape), -7, np.float32)
    box = _native.imprint_foot(soles, poses, x0, y0, cell, samples, bottom, cover)
    return bottom, cover, box


@pytest.mark.parametrize("samples", [1, 2, 3, 4])
@pytest.mark.parametrize("parts", [1, 2])
def test_imprint_agrees(samples, parts):
    rng = np.random.default_rng(10 * samples + parts)
    soles = [shoe(rng) for _ in range(parts)]
    poses = np.array([[*rng.normal(0, 0.04, 3), *unit(rng.normal(0, 1, 4))] for _ in range(parts)])
    grid = (-0.151, -0.127, 0.0117, samples)
    bottom, cover, box = press(soles, poses, *grid, (22, 27))
    min_bottom, least = slow.foot(soles, poses, *grid, (22, 27), slack=-1e-9)
    _, most = slow.foot(soles, poses, *grid, (22, 27), slack=1e-9)
    assert np.all(cover >= least - 1e-6) and np.all(cover <= most + 1e-6)
    sure = (least == most) & (least > 0)
    assert sure.sum() > 50
    assert np.abs(bottom[sure] - min_bottom[sure]).max() < 1e-6
    assert np.all(np.isposinf(bottom) == (cover == 0))
    j, i = np.nonzero(cover)
    assert box == (i.min(), i.max() + 1, j.min(), j.max() + 1)


@pytest.mark.parametrize("samples", [1, 2, 3, 4])
def test_mirrored_foot_mirrored_print(samples):
    rng = np.random.default_rng(samples)
    vertices, triangles = shoe(rng)
    pose = np.array([[0.013, 0.021, 0.4, *unit(rng.normal(0, 1, 4))]])
    twin = (vertices * np.float32([1, -1, 1])).astype(np.float32), triangles[:, ::-1].copy()
    other = pose * [1, -1, 1, 1, -1, 1, -1]
    grid = (-0.5 * 33 * 0.01, -0.5 * 30 * 0.01, 0.01, samples)
    bottom, cover, _ = press([(vertices, triangles)], pose, *grid, (31, 34))
    flipped_bottom, flipped_cover, _ = press([twin], other, *grid, (31, 34))
    assert cover.any()
    assert cover.tobytes() == flipped_cover[::-1].tobytes()
    assert bottom.tobytes() == flipped_bottom[::-1].tobytes()


def test_rings_agree():
    rng = np.random.default_rng(5)
    for count in range(8):
        shape = rng.integers(1, 40, 2)
        touched = rng.random(shape) < 0.02
        ring = np.where(touched, 0, 99).astype(np.int32)
        _native.imprint_rings(ring, count)
        assert np.array_equal(ring, slow.rings(touched, count))


def test_ground_heights_agree():
    rng = np.random.default_rng(6)
    for _ in range(8):
        vertices = rng.normal(0, 2, (60, 3)) + [1000, -500, 3]
        triangles = rng.integers(0, 60, (70, 3)).astype(np.int32)
        xy = rng.normal(0, 2.5, (2000, 2)) + [1000, -500]
        height = np.empty(len(xy))
        _native.terrain_base_height(vertices, triangles, xy, height)
        want = slow.envelope(vertices, triangles, xy[:, 0], xy[:, 1], np.fmax)
        assert np.isfinite(want).sum() > 500
        np.testing.assert_allclose(height, want, atol=1e-9)


def test_bad_arguments_are_refused():
    vertices, triangles = shoe(np.random.default_rng(0))
    grid = np.zeros((9, 9), np.float32)
    good = [(vertices, triangles)], np.array([[0, 0, 0, 1, 0, 0, 0.0]]), 0.0, 0.0, 0.01, 2

    def call(place, value):
        arguments = list(good)
        arguments[place] = value
        return _native.imprint_foot(*arguments, grid, grid.copy())

    for place, value in [
        (0, [(vertices, triangles + 70)]),
        (1, good[1] * np.nan),
        (2, np.nan),
        (4, 0.0),
        (4, -1.0),
        (5, 0),
        (5, 5),
        (0, [(vertices,)]),
        (0, good[0] * 17),
        (1, np.zeros((2, 7))),
    ]:
        with pytest.raises(ValueError):
            call(place, value)
    for place, value in [(0, 3), (0, [(vertices.astype(float), triangles)]), (1, None)]:
        with pytest.raises(TypeError):
            call(place, value)
    with pytest.raises(ValueError):
        _native.imprint_foot(*good, grid, np.zeros((9, 8), np.float32))
    with pytest.raises(ValueError):
        _native.imprint_rings(np.zeros((3, 3), np.int32), -1)
    wall = np.array([[0, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    with pytest.raises(ValueError, match="no ground"):
        _native.terrain_base_height(wall, np.array([[0, 1, 2]], np.int32), np.zeros((1, 2)), np.zeros(1))
