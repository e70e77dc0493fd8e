"""forward_curve.py - a clip in place goes along a curve: where its object is, and how it is turned, at every frame.

places along a line --Course--> turn and place on the floor --the object's matrix--> delta location and rotation
"""

from dataclasses import dataclass

import numpy as np
from mathutils import Matrix, Quaternion

from ..errors import DesirePathError
from . import axes, posing

AHEAD = 0.3  # s: a walker looks so far ahead, and back, for where the curve goes
TURNS = {"QUATERNION": "delta_rotation_quaternion"}
TURN = "delta_rotation_euler"


@dataclass(frozen=True, eq=False)
class Course:
    """A path over the floor, walked at an even speed."""

    line: np.ndarray  # places (n, 2) [m]
    start: np.ndarray  # where the clip begins (2,) [m]
    velocity: np.ndarray  # of the clip (2,) [m/s]

    @property
    def along(self):
        """How far along the line its places lie (n,) [m]."""
        return np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(self.line, axis=0), axis=1))]

    @property
    def seconds(self):
        """How long it takes, for ever on a line that is closed [s]."""
        return np.inf if self.closed else float(self.along[-1] / np.hypot(*self.velocity))

    @property
    def closed(self):
        return len(self.line) > 3 and bool(np.allclose(self.line[0], self.line[-1]))

    def at(self, time):
        """Places (T, 2) [m] and headings (T,) [rad], the latter from that of the clip on."""
        ahead = np.asarray(time, float) * np.hypot(*self.velocity)
        look = AHEAD * np.hypot(*self.velocity)
        chord = self._place(ahead + look) - self._place(ahead - look)
        heading = np.unwrap(np.arctan2(chord[:, 1], chord[:, 0])) - np.arctan2(*self.velocity[::-1])
        heading -= 2.0 * np.pi * np.round(heading[0] / (2.0 * np.pi))
        return self._place(ahead), heading

    def _place(self, ahead):
        along = self.along
        over = 0.0
        if self.closed:
            ahead = ahead % along[-1]
        else:  # straight on beyond its ends
            over = (ahead - np.clip(ahead, 0.0, along[-1]))[:, None]
            first, last = self.line[1] - self.line[0], self.line[-1] - self.line[-2]
            over = over * np.where(over < 0.0, first / np.hypot(*first), last / np.hypot(*last))
        return np.stack([np.interp(ahead, along, axis) for axis in self.line.T], axis=1) + over

    def moves(self, time):
        """The matrices (T, 4, 4) that bring what stands in the clip to its place on the path [m]."""
        place, heading = self.at(time)
        out = np.tile(np.eye(4), (len(place), 1, 1))
        out[:, 0, 0] = out[:, 1, 1] = np.cos(heading)
        out[:, 1, 0] = np.sin(heading)
        out[:, 0, 1] = -out[:, 1, 0]
        out[:, :2, 3] = place - np.einsum("tij,j->ti", out[:, :2, :2], self.start)
        return out


def course(line, gait, velocity):
    """The Course of a recording of one walker in place along a line (n, 2 or 3) [m]."""
    line = np.asarray(line, float)[:, :2]
    step = np.linalg.norm(np.diff(line, axis=0), axis=1)
    line = line[np.r_[True, step > 1e-6]]
    if len(line) < 2:
        raise DesirePathError("The curve has no length seen from above: give it two or more points apart.")
    return Course(line, gait.com[0, 0, :2], np.asarray(velocity, float))


def key(rig, curves, course, frames, seconds, scale, goes_on):
    """Key delta location and delta rotation so that the object is on the path at frames; seconds: since the first one.

    scale: metres in a unit; raises where the object's rotation has no delta of its own kind
    """
    mode = rig.rotation_mode
    if mode == "AXIS_ANGLE":
        raise DesirePathError(
            f"'{rig.name}' turns by axis and angle, which cannot go along a curve: choose another rotation mode."
        )
    world = axes.matrix(rig.matrix_world, rig.name)
    above = world @ np.linalg.inv(np.array(rig.matrix_basis, np.float64))
    moves = course.moves(seconds)
    moves[:, :3, 3] /= scale
    basis = np.linalg.inv(above) @ moves @ world
    own = rig.rotation_quaternion if mode == "QUATERNION" else rig.rotation_euler.to_quaternion()
    places, turns, last = [], [], None
    for each in basis:
        at, turn, _ = Matrix(each.tolist()).decompose()
        turn = turn @ Quaternion(own).normalized().inverted()
        if mode == "QUATERNION":
            if last is not None and last.dot(turn) < 0.0:
                turn.negate()
            last = turn
        else:
            last = turn.to_euler(mode, last) if last is not None else turn.to_euler(mode)
        places.append(tuple(at - rig.location))
        turns.append(tuple(last))
    for path, rows, beyond in (
        ("delta_location", places, "LINEAR" if goes_on else "CONSTANT"),
        (TURNS.get(mode, TURN), turns, "CONSTANT"),
    ):
        for axis, values in enumerate(np.array(rows, np.float32).T):
            posing.set_curve(curves, path, axis, frames, np.ascontiguousarray(values))
            curves.find(path, index=axis).extrapolation = beyond
