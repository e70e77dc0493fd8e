"""What is known of a character before its feet are: bones at rest, bones over time, skin."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Record
from ..motion import rotation


@dataclass(frozen=True, eq=False, repr=False)
class Skeleton(Record):
    """An armature at rest."""

    names: tuple[str, ...]
    parents: np.ndarray  # (B,) i4, -1 for roots
    rest: np.ndarray  # bone to armature, +Y along the bone (B, 4, 4) [m]
    length: np.ndarray  # (B,) [m]
    mirrored: bool = False  # its left is on its right, by a negative scale


@dataclass(frozen=True, eq=False, repr=False)
class Motion(Record):
    """Where bones were over time."""

    time: np.ndarray  # (T,) [s]
    bones: tuple[str, ...]
    matrix: np.ndarray  # bone to world, rotation free of scale (T, B', 4, 4) [m]


@dataclass(frozen=True, eq=False, repr=False)
class Skin(Record):
    """The mesh that is bound to the bones, at rest."""

    vertices: np.ndarray  # rest pose, in the skeleton's rest space (V, 3) [m]
    triangles: np.ndarray  # (F, 3)
    weights: Mapping[str, np.ndarray]  # bone name -> (V,) f4


class SampledBones:
    """Looks up what was sampled of a skeleton, by bone name."""

    def __init__(self, skeleton: Skeleton, motion: Motion) -> None:
        self.row = {n: i for i, n in enumerate(skeleton.names)}
        self.column = {n: i for i, n in enumerate(motion.bones)}
        self.rest = np.asarray(skeleton.rest, float)
        self.length = np.asarray(skeleton.length, float)
        self.matrix = np.asarray(motion.matrix, float)
        self.turns: dict[str, np.ndarray] = {}
        self.tell = np.ones(len(self.matrix), bool)  # samples from which contacts can be judged (T,)
        self.cut: tuple[int, ...] = ()  # samples at which a new piece begins, over which nothing moves

    def point(self, name: str, along: float = 0.0) -> np.ndarray:
        """A point on a bone's axis, from its head 0 to its tail 1, over time (T, 3) [m]."""
        m = self.matrix[:, self.column[name]]
        return np.asarray(m[:, :3, 3] + m[:, :3, 1] * (along * self.length[self.row[name]]))

    def turn(self, name: str) -> np.ndarray:
        """How a bone is turned over time (T, 3, 3)."""
        if name not in self.turns:
            self.turns[name] = rotation.square(self.matrix[:, self.column[name], :3, :3])
        return self.turns[name]

    def rest_point(self, name: str, along: float = 0.0) -> np.ndarray:
        """point() of the rest pose (3,) [m]."""
        m = self.rest[self.row[name]]
        return np.asarray(m[:3, 3] + m[:3, 1] * (along * self.length[self.row[name]]))

    def mean(self, points: Sequence[tuple[str, float]], rest: bool = False) -> np.ndarray:
        """The mean of points (bone, along), over time or at rest."""
        at = self.rest_point if rest else self.point
        return np.asarray(np.mean([at(n, a) for n, a in points], axis=0))
