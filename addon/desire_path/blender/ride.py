"""ride.py - a ground that moves: a ship, a lift, a turning platform. The walk is taken as it is seen from it.

matrices of walker and ground at a frame --carried--> the walker's, as if the ground lay as at the first frame
"""

from contextlib import contextmanager

import bpy
import numpy as np

from . import axes, moves
from .private import evaluated, private_scene, shown_scene

TILT = 3.0  # ground that tilts by less keeps the walker's weight where it was [deg]
SWAY = 0.1  # and one that is accelerated by less leaves its forces as they are [9.81 m/s^2]


class Ride:
    """How a ground moves; `now` is asked after each frame of its private scene was set."""

    def __init__(self, own, copy, name, frame):
        self.own, self.copy, self.name = own, copy, name
        self.first = axes.matrix(evaluated(own, copy, frame).matrix_world, name)
        self.back = []  # from the world as it is to the world as the ground sees it (T, 4, 4)

    def now(self):
        """The move that brings the world of this frame back, (4, 4)."""
        found = self.copy.evaluated_get(self.own.view_layers[0].depsgraph)
        world = axes.matrix(found.matrix_world, self.name)
        back = np.eye(4) if np.array_equal(world, self.first) else self.first @ np.linalg.inv(world)
        self.back.append(back)
        return back

    def notes(self, centre, frames, rate, scale):
        """Sentences about what riding leaves out. centre: of the walker as seen from the ground (T, 3) [m]; frames
        (T,), of which there are `rate` in a second; scale: metres in a unit [m]."""
        back = np.array(self.back)
        if (
            np.abs(back - np.eye(4)).max(axis=(0, 1)) < 1e-6 * np.array((1, 1, 1, max(1.0, np.abs(self.first).max())))
        ).all():
            return ()
        out = [f"'{self.name}' moves: its prints stay on it, and the walk is taken as it is seen from it."]
        up = axes.rigid(back, 1.0)[:, 2, 2]
        tilt = np.degrees(np.arccos(np.clip(up.min(), -1.0, 1.0)))
        if tilt > TILT:
            out.append(
                f"'{self.name}' tilts by up to {tilt:.0f} degrees under the walk: the walker's weight is taken "
                "as if it did not; tilt it less where forces matter."
            )
        size = np.cbrt(np.abs(np.linalg.det(back[:, :3, :3])))
        if abs(size - 1.0).max() > 0.01:
            out.append(f"'{self.name}' changes its size under the walk: key its location and rotation only.")
        steps = (np.array(frames) - frames[0]) / np.median(np.diff(frames))
        even = abs(steps - np.round(steps)) < 1e-3  # not what was looked at besides
        back, centre, frames = back[even], centre[even], np.array(frames)[even]
        if len(back) > 2:
            there, at = np.linalg.inv(back), np.c_[centre / scale, np.ones(len(centre))][1:-1]
            before, here, after = (np.einsum("tij,tj->ti", each, at) for each in (there[:-2], there[1:-1], there[2:]))
            swerve = np.linalg.norm(after - 2.0 * here + before, axis=1) * scale / 9.81
            swerve *= (rate / (frames[1] - frames[0])) ** 2
            k = int(swerve.argmax())
            if swerve[k] > SWAY:
                out.append(
                    f"'{self.name}' speeds up, slows down or turns with {swerve[k]:.2g} times gravity near frame "
                    f"{frames[k + 1]:g}: forces are found as if it moved evenly."
                )
        return tuple(out)


def path(scene, ground, frames):
    """The moves that a ground makes with what stands on it since the first frame (T, 4, 4); None: it never moves."""
    where = shown_scene(scene) if moves.asks_scene(ground) else private_scene(scene)
    with where as own, on(own, ground, frames[0]) as carry:
        if carry is None:
            return None
        for frame in frames:
            evaluated(own, carry.copy, frame)
            carry.now()
        return np.linalg.inv(carry.back)


@contextmanager
def on(own, ground, frame):
    """The Ride of a ground in a private scene, from a frame on; None for one that never moves."""
    if ground is None or not moves.moves(ground):
        yield None
        return
    copy, mesh = ground.copy(), bpy.data.meshes.new("desire_path ride")  # where it is, without what it is
    try:
        copy.modifiers.clear()
        copy.data = mesh
        copy.hide_viewport = False
        own.collection.objects.link(copy)
        yield Ride(own, copy, ground.name, frame)
    finally:
        bpy.data.objects.remove(copy)
        bpy.data.meshes.remove(mesh)
