"""physics.py - what Blender's own rigid bodies move, frame by frame."""

from contextlib import contextmanager

import numpy as np

from . import playback


@contextmanager
def _unpressed(scene):
    """Grounds as they lay before they were baked, for what falls on them meanwhile: a bake follows from the fall, and
    not the fall from the bake that is shown."""
    shown = [playback.modifier(each) for each in scene.objects if each.type == "MESH" and not each.library]
    shown = [each for each in shown if each is not None and each.show_viewport]
    for each in shown:
        each.show_viewport = False
    try:
        yield
    finally:
        for each in shown:
            each.show_viewport = True


def simulated(obj):
    """Whether Blender's rigid bodies move an object or one that it hangs on."""
    while obj is not None:
        if obj.rigid_body is not None and obj.rigid_body.type == "ACTIVE":
            return True
        obj = obj.parent
    return False


def fallen(scene, obj, frames, samples):
    """World matrices of what is simulated: its own scene is stepped through, and left as it was."""
    with _unpressed(scene):
        placed = _stepped(scene, obj, frames)
    if samples == 1:
        return placed
    at = np.arange(len(frames)) / samples  # between whole frames, straight
    low = np.minimum(at.astype(int), len(placed) - 2)
    share = (at - low)[:, None, None]
    return (1.0 - share) * placed[low] + share * placed[low + 1]


def _stepped(scene, obj, frames):
    """The same at whole frames."""
    world = scene.rigidbody_world
    before, keep, out = scene.frame_current, scene.frame_subframe, []
    first, last = round(frames[0]), round(frames[-1])
    try:
        for frame in range(min(first, world.point_cache.frame_start if world is not None else first), last + 1):
            scene.frame_set(frame)
            if frame >= first:
                depsgraph = scene.view_layers[0].depsgraph
                out.append(np.array(obj.evaluated_get(depsgraph).matrix_world, np.float64))
    finally:
        scene.frame_set(before, subframe=keep)
    return np.array(out)
