"""Slow, literal twins of the imprint and the ground mesh: every sample asks every triangle."""

import numpy as np

FAR = 32767


def turn(q, points):
    """Points turned by the unit quaternion (w, x, y, z)."""
    w, x, y, z = q
    matrix = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    return points @ matrix.T


def over_triangle(corners, x, y, slack=0.0):
    """Height of a triangle over points, NaN where it is not."""
    a, b, c = corners
    whole = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    if whole == 0.0:
        return np.full(np.shape(x), np.nan)
    with_c = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / whole
    with_b = ((a[0] - c[0]) * (y - c[1]) - (a[1] - c[1]) * (x - c[0])) / whole
    with_a = 1.0 - with_b - with_c
    inside = (with_a >= -slack) & (with_b >= -slack) & (with_c >= -slack)
    return np.where(inside, with_a * a[2] + with_b * b[2] + with_c * c[2], np.nan)


def envelope(vertices, triangles, x, y, best, slack=0.0):
    """Lowest (best = np.fmin) or highest (np.fmax) height of a mesh over points."""
    height = np.full(np.shape(x), np.nan)
    for triangle in triangles:
        height = best(height, over_triangle(vertices[triangle], x, y, slack))
    return height


def foot(soles, poses, x0, y0, cell, samples, shape, slack=0.0):
    """bottom and cover of posed soles. TRAIL 4.2.1."""
    ny, nx = shape
    inside = ((np.arange(samples) + 0.5) / samples - 0.5) * cell
    x = x0 + np.arange(nx)[:, None] * cell + inside
    y = y0 + np.arange(ny)[:, None] * cell + inside
    x, y = np.meshgrid(x.ravel(), y.ravel())
    low = np.full(x.shape, np.nan)
    for (vertices, triangles), pose in zip(soles, poses):
        placed = pose[:3] + turn(pose[3:], vertices.astype(float))
        low = np.fmin(low, envelope(placed, triangles, x, y, np.fmin, slack))
    low = low.reshape(ny, samples, nx, samples)
    covered = np.isfinite(low).sum(axis=(1, 3))
    bottom = np.full(shape, np.inf)
    bottom[covered > 0] = np.nansum(low, axis=(1, 3))[covered > 0] / covered[covered > 0]
    return bottom, covered / samples**2


def rings(touched, count):
    """Ring numbers outward from touched cells. TRAIL 4.2.2."""
    ring = np.where(touched, 0, FAR).astype(np.int32)
    for number in range(1, count + 1):
        here = np.pad(ring == number - 1, 1)
        near = np.zeros_like(touched)
        for dj in (0, 1, 2):
            for di in (0, 1, 2):
                near |= here[dj : dj + ring.shape[0], di : di + ring.shape[1]]
        ring[near & (ring == FAR)] = number
    return ring
