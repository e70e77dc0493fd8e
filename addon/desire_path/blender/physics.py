"""physics.py - what Blender's own rigid bodies move, frame by frame."""

import numpy as np


def simulated(obj):
    """Whether Blender's rigid bodies move an object or one that it hangs on."""
    while obj is not None:
        if obj.rigid_body is not None and obj.rigid_body.type == "ACTIVE":
            return True
        obj = obj.parent
    return False


def others(obj):
    """What may meet an object that rigid bodies move: all bodies of its scenes."""
    worlds = [scene.rigidbody_world for scene in obj.users_scene] if simulated(obj) else []
    return {each for world in worlds if world is not None and world.collection for each in world.collection.objects}


def fallen(scene, obj, frames, samples):
    """World matrices of what is simulated: its own scene is stepped through, and left as it was."""
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
    placed = np.array(out)
    if samples == 1:
        return placed
    at = np.arange(len(frames)) / samples  # between whole frames, straight
    low = np.minimum(at.astype(int), len(placed) - 2)
    share = (at - low)[:, None, None]
    return (1.0 - share) * placed[low] + share * placed[low + 1]
