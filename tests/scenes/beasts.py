"""A four-legged body: a skeleton, a mesh of boxes bound to it, and how it stands, walks and trots along -Y."""

import numpy as np

from desire_path.rig.body import Motion, Skeleton, Skin
from scenes import gaits

LEGS = (("front_", -0.45), ("", 0.45))  # place word, y of the leg
SIDES = ((0.13, "L"), (-0.13, "R"))
HEIGHT = 0.75


def skeleton():
    """(Skeleton, heads, tails, owner leg or None of each bone)."""
    bones = [
        ("hips", None, (0, 0.5, 0.8), (0, 0.2, 0.82)),
        ("spine", "hips", (0, 0.2, 0.82), (0, -0.45, 0.82)),
        ("neck", "spine", (0, -0.45, 0.85), (0, -0.75, 1.1)),
        ("head", "neck", (0, -0.75, 1.1), (0, -0.95, 1.05)),
    ]
    for word, y in LEGS:
        for x, mark in SIDES:
            spots = [(x, y, HEIGHT), (x, y, 0.4), (x, y, 0.08), (x, y - 0.07, 0.02), (x, y - 0.12, 0.02)]
            above = "hips" if not word else "spine"
            for part, head, tail in zip(("thigh", "shin", "foot", "toe"), spots, spots[1:]):
                name = f"{word}{part}.{mark}"
                bones.append((name, above, head, tail))
                above = name
    names = [b[0] for b in bones]
    rest, length = np.tile(np.eye(4), (len(bones), 1, 1)), np.zeros(len(bones))
    for k, (_, _, head, tail) in enumerate(bones):
        way = np.subtract(tail, head)
        length[k] = np.linalg.norm(way)
        y = way / length[k]
        x = np.cross(y, [0.2, 0.1, 0.9])
        x /= np.linalg.norm(x)
        rest[k, :3, :3] = np.stack([x, y, np.cross(x, y)], axis=1)
        rest[k, :3, 3] = head
    parents = np.array([names.index(b[1]) if b[1] else -1 for b in bones], "i4")
    return Skeleton(tuple(names), parents, rest, length)


def skin(bones):
    """Boxes along the bones, 0.3 m wide for the trunk, 0.12 m for the neck, 0.06 m for legs; (Skin, volumes)."""
    vertices, triangles, weights, volume = [], [], {}, {}
    wide = lambda name: 0.3 if name in ("hips", "spine") else 0.12 if name in ("neck", "head") else 0.06
    for k, name in enumerate(bones.names):
        box = gaits.box(bones.length[k], wide(name), wide(name))
        along = box.vertices[:, [1, 0, 2]] * (1, 1, -1) + [0, bones.length[k] / 2, wide(name) / 2]
        first = sum(len(v) for v in vertices)
        vertices.append(along @ bones.rest[k, :3, :3].T + bones.rest[k, :3, 3])
        triangles.append(box.triangles + first)
        volume[name] = bones.length[k] * wide(name) ** 2
    count = sum(len(v) for v in vertices)
    at = 0
    for k, name in enumerate(bones.names):
        weights[name] = np.zeros(count, "f4")
        weights[name][at : at + len(vertices[k])] = 1.0
        at += len(vertices[k])
    return Skin(np.concatenate(vertices), np.concatenate(triangles), weights), volume


def motion(bones, *, speed=0.0, stride=0.5, duty=0.45, bob=0.0, phases=(0.0, 0.5, 0.5, 0.0), seconds=2.0, rate=120.0):
    """Feet in the order front left, front right, hind left, hind right; legs as rigid as stilts that lift."""
    count = int(seconds * rate) + 1
    time = np.arange(count) / rate
    world = np.tile(bones.rest, (count, 1, 1, 1))
    rise = bob * np.cos(4 * np.pi * (time / stride - duty / 2)) * -1.0
    leg = 0
    shift = {}
    for word, _ in LEGS:
        for _, mark in SIDES:
            phase = time / stride + phases[leg]
            step, u = np.floor(phase), phase % 1.0
            swing = np.clip((u - duty) / (1 - duty), 0, 1)
            # where the foot stands, it does so under the hip in the middle of its stance
            ahead = speed * stride * (step + swing**2 * (3 - 2 * swing) - phases[leg] + duty / 2)
            lift = 0.10 * np.sin(np.pi * swing) ** 2 * (speed > 0)
            shift[f"{word}{mark}"] = (ahead if speed else 0 * time, lift)
            leg += 1
    for b, name in enumerate(bones.names):
        body = not name.endswith((".L", ".R")) or "thigh" in name
        if body:
            world[:, b, 1, 3] -= speed * time
            world[:, b, 2, 3] += rise
        else:
            ahead, lift = shift[("front_" if name.startswith("front_") else "") + name[-1]]
            world[:, b, 1, 3] -= ahead
            world[:, b, 2, 3] += lift
    return Motion(time, bones.names, world)
