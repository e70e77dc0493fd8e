"""picture.py - an image as a number for every place of a ground: 1 where it is white, 0 where it is black.

Image --pixels as stored--> brightness (rows, columns) --UV map, or seen from above--> 0..1 at places
"""

import bpy
import numpy as np

from ..errors import DesirePathError
from ..ground.sim import Ground, Simulation
from . import compat

BRIGHT = np.array((0.2126, 0.7152, 0.0722), np.float32)  # of red, green, blue, Rec. 709


def named(name):
    """The image of that name; None without a name."""
    if not name:
        return None
    image = bpy.data.images.get(name)
    if image is None:
        raise DesirePathError(
            f"There is no image '{name}' in this file: open it in the Image Editor, or leave the density image empty."
        )
    return image


def is_still(_self, image):
    return image.source in {"FILE", "GENERATED"}


def brightness(image, what="density image"):
    """Rec. 709 luminance of an image's pixels as they are stored, float32 (rows, columns) 0..1, row 0 below.

    what: it is, where it cannot be read
    """
    if not is_still(None, image):
        raise DesirePathError(
            f"The {what} '{image.name}' is no single picture but a {image.source.lower()}: "
            "save the picture that is meant as a file of its own and choose that."
        )
    count, (width, height) = len(image.pixels), image.size
    if not count or count % (width * height):
        path = bpy.path.abspath(image.filepath)
        raise DesirePathError(
            f"The {what} '{image.name}' cannot be loaded"
            + (f" from {path}" if path else "")
            + ": mend its path in the Image Editor, or choose another image."
        )
    pixels = np.empty(count, np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, -1)
    light = pixels[..., :3] @ BRIGHT if pixels.shape[2] > 2 else pixels[..., 0]
    if image.is_float and image.colorspace_settings.name == "sRGB":  # held in linear light, stored otherwise
        colour = np.clip(pixels[..., :3], 0.0, 1.0)
        colour = np.where(colour <= 0.0031308, 12.92 * colour, 1.055 * colour ** (1 / 2.4) - 0.055)
        light = colour @ BRIGHT if pixels.shape[2] > 2 else colour[..., 0]
    return np.clip(np.nan_to_num(light, nan=0.0), 0.0, 1.0).astype(np.float32)


def sampled(light, at):
    """An image's brightness at image coordinates (n, 2): between pixels, and again beyond 0..1; NaN where they are."""
    size = np.array(light.shape[::-1])
    known = np.isfinite(at).all(axis=1)
    place = np.where(known[:, None], at, 0.0)
    place = np.clip((place - np.floor(place)) * size - 0.5, 0.0, size - 1.0)  # each tile keeps to itself
    low = np.minimum(place.astype(np.int64), np.maximum(size - 2, 0))
    (x, y), (a, b) = low.T, (place - low).T
    right, above = np.minimum(x + 1, size[0] - 1), np.minimum(y + 1, size[1] - 1)
    below = (1.0 - a) * light[y, x] + a * light[y, right]
    return np.where(known, (1.0 - b) * below + b * ((1.0 - a) * light[above, x] + a * light[above, right]), np.nan)


class Lay:
    """How images lie on a ground: by its active UV map, else stretched over the rectangle around it."""

    def __init__(self, obj, mesh, vertices, triangles):
        """obj: whose active UV map counts; mesh: its evaluated mesh; vertices: of that, in the world [m]"""
        layer = obj.data.uv_layers.active
        corners = compat.uv(mesh, layer.name) if layer is not None else None
        self.low, self.size = vertices[:, :2].min(axis=0), np.ptp(vertices[:, :2], axis=0)
        self.uv = corners[compat.triangle_corners(mesh)] if corners is not None else None
        self.vertices, self.triangles = vertices, triangles

    def __call__(self, at, height):
        """Image coordinates (n, 2) of places (n, 2) [m] at which the ground is so high (n,) [m]."""
        if self.uv is None:
            return (at - self.low) / self.size
        # each face is raised by a hair of its own, so that the height tells which of them is seen from above
        corner = self.vertices[self.triangles]
        hair = 1e-4 / len(corner)
        level = corner[..., 2].mean()
        for_face = np.arange(len(corner))
        raised = corner - (0.0, 0.0, level) + (hair * for_face)[:, None, None] * (0.0, 0.0, 1.0)
        asked = Simulation(Ground.mesh(raised.reshape(-1, 3), np.arange(corner.size // 3).reshape(-1, 3)))
        of = (asked.rest_height(at) - (height - level)) / hair
        there = np.isfinite(of)
        face = np.clip(np.round(np.where(there, of, 0.0)), 0, len(corner) - 1).astype(np.int64)
        share = _shares(corner[face][..., :2], at)
        return np.where(there[:, None], np.einsum("nk,nkd->nd", share, self.uv[face]), np.nan)


def _shares(corner, at):
    """How near places (n, 2) are to the corners (n, 3, 2) of their triangles, seen from above; (n, 3), sum 1."""
    a, b, c = (corner[:, k] for k in range(3))

    def area(p, q, r):
        return (q[:, 0] - p[:, 0]) * (r[:, 1] - p[:, 1]) - (q[:, 1] - p[:, 1]) * (r[:, 0] - p[:, 0])

    share = np.clip(
        np.stack([area(at, b, c), area(a, at, c), area(a, b, at)], axis=1) * np.sign(area(a, b, c))[:, None], 0.0, None
    )
    return share / np.maximum(share.sum(axis=1, keepdims=True), 1e-30)
