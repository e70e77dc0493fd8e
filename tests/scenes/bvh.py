"""Reads a BVH clip the way Blender's importer lays it out: Z up, bones along +Y, world matrices.

skeleton, motion, rate = bvh.load("walk.bvh", scale=0.056444)
"""

from pathlib import Path

import numpy as np

from desire_path.rig.body import Motion, Skeleton

WALKS = Path(__file__).parent / "walks"  # clips without force plates
Z_UP = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])  # BVH (x, y up, z) to (x, -z, y)


class _Joint:
    def __init__(self, name, parent):
        self.name, self.parent = name, parent
        self.offset, self.channels, self.first, self.end = np.zeros(3), [], 0, None


def _parse(text):
    words = iter(text.split())
    joints, stack, in_end, columns = [], [], False, 0
    for word in words:
        if word in ("ROOT", "JOINT"):
            joints.append(_Joint(next(words), stack[-1] if stack else -1))
        elif word == "End":
            next(words)
            in_end = True
        elif word == "{":
            stack.append(-2 if in_end else len(joints) - 1)
        elif word == "}":
            in_end = in_end and stack[-1] != -2
            stack.pop()
        elif word == "OFFSET":
            offset = np.array([float(next(words)) for _ in range(3)])
            if in_end:
                joints[stack[-2]].end = offset
            else:
                joints[stack[-1]].offset = offset
        elif word == "CHANNELS":
            count = int(next(words))
            joints[stack[-1]].channels = [next(words) for _ in range(count)]
            joints[stack[-1]].first = columns
            columns += count
        elif word == "MOTION":
            break
    next(words)
    frames = int(next(words))
    next(words), next(words)
    step = float(next(words))
    values = np.array([float(w) for w in words]).reshape(frames, columns)
    return joints, step, values


def _about(axis, degrees):
    angle = np.radians(degrees)
    c, s, o, e = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    rows = {
        "X": [[e, o, o], [o, c, -s], [o, s, c]],
        "Y": [[c, o, s], [o, e, o], [-s, o, c]],
        "Z": [[c, -s, o], [s, c, o], [o, o, e]],
    }[axis]
    return np.moveaxis(np.array(rows), -1, 0)


def _along(direction):
    """A rotation whose +Y lies along a direction, as near to upright as that allows."""
    y = direction / np.linalg.norm(direction)
    x = np.cross(y, [0.0, 0.0, 1.0])
    x = x / np.linalg.norm(x) if np.linalg.norm(x) > 1e-6 else np.array([1.0, 0, 0])
    return np.stack([x, y, np.cross(x, y)], axis=1)


def load(path, scale=1.0, turn=np.eye(3), every=1):
    """(Skeleton, Motion, frames a second). `turn` is the armature object's rotation; `every` thins
    the frames."""
    with open(path) as file:
        joints, step, values = _parse(file.read())
    values = values[::every]
    step *= every
    count, frames = len(joints), len(values)
    local = np.zeros((count, frames, 3, 3))
    world_turn = np.zeros((count, frames, 3, 3))
    world_at = np.zeros((count, frames, 3))
    rest_at = np.zeros((count, 3))
    for j, joint in enumerate(joints):
        local[j] = np.eye(3)
        shift = np.tile(joint.offset, (frames, 1))
        for c, channel in enumerate(joint.channels):
            column = values[:, joint.first + c]
            if channel.endswith("position"):
                shift[:, "XYZ".index(channel[0])] = column
            else:
                local[j] = local[j] @ _about(channel[0], column)
        if joint.parent < 0:
            world_turn[j], world_at[j], rest_at[j] = local[j], shift, joint.offset
        else:
            p = joint.parent
            world_turn[j] = world_turn[p] @ local[j]
            world_at[j] = world_at[p] + np.einsum("tij,tj->ti", world_turn[p], shift)
            rest_at[j] = rest_at[p] + joint.offset
    rest = np.tile(np.eye(4), (count, 1, 1))
    length = np.zeros(count)
    matrix = np.tile(np.eye(4), (frames, count, 1, 1))
    for j, joint in enumerate(joints):
        children = [k for k in joints if k.parent == j]
        if joint.end is not None:
            tail = joint.end
        elif children:
            tail = np.mean([k.offset for k in children], axis=0)
        else:
            tail = np.array([0.0, 1.0, 0.0])
        if np.linalg.norm(tail) < 1e-6:
            tail = np.array([0.0, 0.1, 0.0])
        length[j] = np.linalg.norm(tail) * scale
        bone = _along(Z_UP @ tail)
        rest[j, :3, :3] = bone
        rest[j, :3, 3] = Z_UP @ rest_at[j] * scale
        matrix[:, j, :3, :3] = turn @ Z_UP @ world_turn[j] @ Z_UP.T @ bone
        matrix[:, j, :3, 3] = world_at[j] * scale @ (turn @ Z_UP).T
    names = tuple(j.name for j in joints)
    skeleton = Skeleton(names, np.array([j.parent for j in joints], "i4"), rest, length)
    time = np.arange(frames) * step
    return skeleton, Motion(time, names, matrix), 1.0 / step
