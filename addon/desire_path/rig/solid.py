"""Rigid bodies as walkers: a crate that hops, a ball, a wheel. One limb of one part, whose sole is the whole mesh.

positions and faces, matrices over time ---gait_from_solid---> Gait
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..errors import DesirePathError
from ..keywords import fields_of
from ..motion import drawn, jumps, rotation
from ..motion.gait import HEEL, Gait, Sole

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

ROUND = np.radians(5.0)  # whatever rolls about an axis of its own touches with a point every so often [rad]
SPREAD = 256  # other directions in which the farthest point of the body is a contact point
FLAT = 1e-3  # of the cube of its size: a body that holds less has no inside to speak of


@dataclass(frozen=True)
class SolidOptions:
    """What a recording says of a body besides its motion."""

    name: str = "Body"
    frame_start: int = 1  # scene frame at the first time
    warnings: Iterable[str] = ()


@fields_of(options=SolidOptions)
def gait_from_solid(
    time: ArrayLike,
    matrix: ArrayLike,
    vertices: ArrayLike,
    triangles: ArrayLike,
    *,
    mass: float,
    frame_rate: float,
    options: SolidOptions = SolidOptions(),
) -> Gait:
    """What a rigid body did, as a Gait of one walker. Refuses bad recordings with a sentence.

    time: (T,) [s], rising; matrix: body to world, rotation free of scale (T, 4, 4) [m]; vertices: in the body's axes,
    its scale applied (V, 3) [m]; triangles: (F, 3). mass [kg] > 0. frame_rate: scene frames a second.
    """
    name, time = options.name, np.asarray(time, float)
    given, faces = np.asarray(vertices, float), np.asarray(triangles).reshape(-1, 3)
    if not len(faces):
        raise DesirePathError(f"'{name}' has no faces to press the ground with: give it some.")
    if not np.isfinite(given).all():
        raise DesirePathError(f"'{name}' has NaN or infinite vertices: repair the mesh.")
    if faces.min() < 0 or faces.max() >= len(given):
        raise DesirePathError(f"'{name}' has a face without its vertices: repair the mesh.")
    used, packed = np.unique(faces, return_inverse=True)
    corners, faces = given[used], packed.reshape(-1, 3)
    matrix = np.asarray(matrix, float)
    if matrix.shape != (len(time), 4, 4):
        raise DesirePathError(
            f"The matrices of '{name}' have shape {matrix.shape} where {(len(time), 4, 4)} is needed: give one a time."
        )
    far = float(np.linalg.norm(corners, axis=1).max())
    moving, sentences = between_poses(name, time, matrix[:, None], far, frame_rate)
    at, turn = moving[:, 0, :3, 3], rotation.square(moving[:, 0, :3, :3])
    middle, _ = centre(corners, faces)
    points = outermost(corners)
    return Gait(
        time=time,
        com=(at + turn @ middle)[None],
        mass=np.array([mass]),
        pose=np.concatenate([at, rotation.quaternion(turn)], axis=1)[None],
        limb_walker=np.array([0]),
        part_limb=np.array([0]),
        soles=(Sole(corners, faces),),
        point=points,
        point_part=np.zeros(len(points)),
        point_role=np.full(len(points), HEEL),
        limb_name=(name,),
        part_name=("body",),
        walker_name=(name,),
        frame_rate=frame_rate,
        frame_start=options.frame_start,
        warnings=(*options.warnings, *sentences),
    ).check()


def between_poses(
    name: str, time: np.ndarray, matrix: np.ndarray, size: float, frame_rate: float
) -> tuple[np.ndarray, list[str]]:
    """(matrices (T, B, 4, 4) of the motion that poses of a body are drawn from, as on twos, and what is told of it);
    the same and nothing where it moves in every frame. size: of the body [m]"""
    places = matrix[..., :3, 3]
    leaps = jumps.between(time, places.mean(axis=1), places.swapaxes(0, 1), frame_rate, time[0], size)
    cut = [sample for a, b, _ in leaps for sample in range(a + 1, b + 1)]
    found, lasts = drawn.moving(time, matrix, cut)
    return found, drawn.sentences(name, lasts * frame_rate)


def centre(vertices: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, float]:
    """(middle of what a mesh holds (3,) [m], its volume [m^3]); of its faces, and 0, where it holds nothing."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    corner = vertices[triangles] - (low + high) / 2.0
    a, b, c = corner[:, 0], corner[:, 1], corner[:, 2]
    part = (np.cross(a, b) * c).sum(axis=1) / 6.0  # of the wedge from the middle of the box to the face
    volume = part.sum()
    if is_closed(triangles) and abs(volume) > FLAT * np.prod(high - low):
        at = (part[:, None] * corner.sum(axis=1)).sum(axis=0) / (4.0 * volume)
    else:
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        at, volume = np.average(corner.mean(axis=1), axis=0, weights=np.maximum(area, 1e-300)), 0.0
    return at + (low + high) / 2.0, float(abs(volume))


def is_closed(triangles: np.ndarray) -> bool:
    """Whether every edge of a mesh has a face on both sides."""
    edges = np.sort(np.concatenate([triangles[:, (0, 1)], triangles[:, (1, 2)], triangles[:, (2, 0)]]), axis=1)
    return bool((np.unique(edges, axis=0, return_counts=True)[1] % 2 == 0).all())


def outermost(vertices: np.ndarray) -> np.ndarray:
    """The points a body can touch with (K, 3): the farthest ones all round, around its own axes every 5 degrees."""
    angle = np.arange(0.0, 2.0 * np.pi, ROUND)
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)
    k = np.arange(SPREAD)  # evenly over the sphere, by the golden angle
    z = (2.0 * k + 1.0) / SPREAD - 1.0
    turn = k * np.pi * (3.0 - np.sqrt(5.0))
    ball = np.stack([np.sqrt(1.0 - z * z) * np.cos(turn), np.sqrt(1.0 - z * z) * np.sin(turn), z], axis=1)
    directions = np.concatenate([ring, np.roll(ring, 1, axis=1), np.roll(ring, 2, axis=1), ball])
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2.0
    # of several that are as far, as on a face or a rim, both ends count: a little aside to either side finds them
    tilt = 1e-3 * np.roll(directions, 1, axis=1) * (1.0, -1.0, 1.0)
    far = [((vertices - middle) @ toward.T).argmax(axis=0) for toward in (directions + tilt, directions - tilt)]
    return np.asarray(vertices[np.unique(np.concatenate(far))])
