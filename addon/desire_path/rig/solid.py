"""Rigid bodies as walkers: a crate that hops, a ball, a wheel. One limb of one part, whose sole is the whole mesh.

positions and faces, matrices over time ---gait_from_solid---> Gait
"""

import numpy as np

from ..errors import DesirePathError
from ..motion import rotation
from ..motion.gait import HEEL, Gait, Sole

ROUND = np.radians(5.0)  # whatever rolls about an axis of its own touches with a point every so often [rad]
SPREAD = 256  # other ways in which the farthest point of the body is a contact point
FLAT = 1e-3  # of the cube of its size: a body that holds less has no inside to speak of


def gait_from_solid(time, matrix, vertices, triangles, *, mass, name="Body", frame_rate, frame_start=1, warnings=()):
    """What a rigid body did, as a Gait of one walker. Refuses bad recordings with a sentence.

    time: (T,) [s], rising; matrix: body to world, rotation free of scale (T, 4, 4) [m]; vertices: in the body's axes,
    its scale applied (V, 3) [m]; triangles: (F, 3). mass [kg] > 0.
    """
    vertices, triangles = np.asarray(vertices, float), np.asarray(triangles).reshape(-1, 3)
    if not len(triangles):
        raise DesirePathError(f"'{name}' has no faces to press the ground with: give it some.")
    if not np.isfinite(vertices).all():
        raise DesirePathError(f"'{name}' has NaN or infinite vertices: repair the mesh.")
    used, faces = np.unique(triangles, return_inverse=True)
    vertices, triangles = vertices[used], faces.reshape(-1, 3)
    matrix = np.asarray(matrix, float)
    at, turn = matrix[:, :3, 3], rotation.square(matrix[:, :3, :3])
    middle, _ = centre(vertices, triangles)
    points = outermost(vertices)
    return Gait(
        time=time,
        com=(at + turn @ middle)[None],
        mass=[mass],
        pose=np.concatenate([at, rotation.quaternion(turn)], axis=1)[None],
        limb_walker=[0],
        part_limb=[0],
        soles=[Sole(vertices, triangles)],
        point=points,
        point_part=np.zeros(len(points)),
        point_role=np.full(len(points), HEEL),
        limb_name=[name],
        part_name=["body"],
        walker_name=[name],
        frame_rate=frame_rate,
        frame_start=frame_start,
        warnings=warnings,
    ).check()


def centre(vertices, triangles):
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


def is_closed(triangles):
    """Whether every edge of a mesh has a face on both sides."""
    edges = np.sort(np.concatenate([triangles[:, (0, 1)], triangles[:, (1, 2)], triangles[:, (2, 0)]]), axis=1)
    return bool((np.unique(edges, axis=0, return_counts=True)[1] % 2 == 0).all())


def outermost(vertices):
    """The points a body can touch with (K, 3): the farthest ones all round, around its own axes every 5 degrees."""
    angle = np.arange(0.0, 2.0 * np.pi, ROUND)
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)
    k = np.arange(SPREAD)  # evenly over the sphere, by the golden angle
    z = (2.0 * k + 1.0) / SPREAD - 1.0
    turn = k * np.pi * (3.0 - np.sqrt(5.0))
    ball = np.stack([np.sqrt(1.0 - z * z) * np.cos(turn), np.sqrt(1.0 - z * z) * np.sin(turn), z], axis=1)
    ways = np.concatenate([ring, np.roll(ring, 1, axis=1), np.roll(ring, 2, axis=1), ball])
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2.0
    # of several that are as far, as on a face or a rim, both ends count: a little aside to either side finds them
    tilt = 1e-3 * np.roll(ways, 1, axis=1) * (1.0, -1.0, 1.0)
    far = [((vertices - middle) @ way.T).argmax(axis=0) for way in (ways + tilt, ways - tilt)]
    return vertices[np.unique(np.concatenate(far))]
