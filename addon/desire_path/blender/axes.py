"""axes.py - Blender's object matrices and unit scale become metres here, once.

Blender's world is right-handed with +Z up like ours, so that only lengths change: a position in
the scene times `unit_scale` is in metres.
"""

import numpy as np

from ..errors import DesirePathError

FAR = 1e30  # Blender stores an infinite number as the largest it knows


def typed(value):
    """The number a user typed: Blender keeps 0.01 as 0.0099999998."""
    return float(f"{value:.7g}")


def unit_scale(scene):
    """Metres in one unit of the scene [m]."""
    units = scene.unit_settings
    return 1.0 if units.system == "NONE" else typed(units.scale_length)


def matrix(value, name):
    """A Blender matrix as float64 (4, 4); refuses NaN, infinity and a squashed object."""
    out = np.array(value, dtype=np.float64).reshape(4, 4)
    if not (np.abs(out) < FAR).all():
        raise DesirePathError(
            f"The transform of '{name}' has NaN or infinite numbers: set its location, rotation and scale anew."
        )
    size = np.linalg.norm(out[:3, :3], axis=0).max()
    if size == 0.0 or abs(np.linalg.det(out[:3, :3])) < 1e-9 * size**3:
        raise DesirePathError(f"'{name}' is scaled to nothing along an axis: give it a scale other than 0.")
    return out


def points(world, local, scale):
    """Local points (n, 3) to the world, float64 [m]."""
    x, y, z = np.asarray(local, np.float64).reshape(-1, 3).T.copy()
    out = np.empty((len(x), 3))
    for axis in range(3):  # written out: a matrix product's last bits differ from machine to machine
        a, b, c, at = world[axis] * scale
        out[:, axis] = x * a + y * b + z * c + at
    return out


def sizes(world):
    """The scale of an object's axes as a matrix (4, 4); a mirrored object is mirrored along X."""
    out = np.eye(4)
    out[(0, 1, 2), (0, 1, 2)] = np.linalg.norm(world[:3, :3], axis=0)
    out[0, 0] *= np.sign(np.linalg.det(world[:3, :3]))
    return out


def rigid(world, scale):
    """Take the scale out of matrices (.., 4, 4): a pure turn, and positions in metres.

    The bone's own axis, +Y, keeps its direction, X is made square to it, Z
    completes a right-handed turn.
    """
    world = np.asarray(world, np.float64)
    out = np.zeros_like(world)
    y = world[..., :3, 1] / np.linalg.norm(world[..., :3, 1], axis=-1, keepdims=True)
    x = world[..., :3, 0] - np.sum(world[..., :3, 0] * y, axis=-1, keepdims=True) * y
    x = x / np.linalg.norm(x, axis=-1, keepdims=True)
    out[..., :3, 0] = x
    out[..., :3, 1] = y
    out[..., :3, 2] = np.cross(x, y)
    out[..., :3, 3] = world[..., :3, 3] * scale
    out[..., 3, 3] = 1.0
    return out


def lift(world, scale):
    """What one metre upwards in the world is in the object's own space, float64 (3,)."""
    return np.linalg.solve(world[:3, :3], np.array((0.0, 0.0, 1.0 / scale)))


def image_axes(world, scale, index):
    """Linear map from local positions to image coordinates: (u, v) = turn @ local + shift.

    (0, 0) is the image's lower left corner (index.x0, index.y0), (1, 1) its upper right one.
    """
    return rectangle_axes(world, scale, (index.x0, index.y0), np.array((index.nx, index.ny)) * index.cell)


def rectangle_axes(world, scale, low, size):
    """The same for an image that lies over a rectangle of the world: its lower left corner and its sides [m]."""
    turn = world[:2, :3] * scale / np.asarray(size)[:, None]
    shift = (world[:2, 3] * scale - np.asarray(low)) / size
    return turn, shift
