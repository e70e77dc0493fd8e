"""Slow twins of native/soil's heaps: rings around a sole, and how what was displaced is laid on them. MODEL 6.3

Patches are those of soil.py beside.
"""

import heapq
import math

import numpy as np


def rings(touched, most):
    """Ring number of every cell: 0 touched, 1 border, 2.. outward; 32767 beyond `most`."""
    ring = np.where(touched, 0, 32767)
    for r in range(1, most + 1):
        grown = np.zeros_like(touched)
        for dj in (-1, 0, 1):
            for di in (-1, 0, 1):
                grown |= np.roll(np.pad(ring == r - 1, 1), (dj, di), (0, 1))[1:-1, 1:-1]
        ring[grown & (ring == 32767)] = r
    return ring


def shares(cells, patch, force, point, normal, threshold):
    """omega of each (j, i), not yet normalised."""
    push = force - force.dot(normal) * normal
    size = np.linalg.norm(push)
    beta = min(size / threshold, 1.0)  # TRAIL (13)
    found = []
    for j, i in cells:
        to_cell = np.array([patch["x0"] + i * patch["cell"], patch["y0"] + j * patch["cell"]]) - point[:2]
        to_cell /= np.linalg.norm(to_cell)
        ahead = max(push[:2].dot(to_cell), 0.0) / size if size > 0 else 0.0  # TRAIL (11)
        found.append(beta * ahead + (1.0 - beta))  # TRAIL (12)
    return np.array(found)


def accumulate_paper(patch, ring, cover, foot, volume, width, threshold):
    """TRAIL (11)-(13) on a rim `width` wide, full but for its outer fifth, from midway through the cells that the
    sole covers in part."""
    wide = max(width / patch["cell"], 1.0)
    far = np.full(ring.shape, np.inf)
    for c in map(tuple, np.argwhere(ring == 0)):
        far = np.minimum(far, _distances(c, np.zeros(ring.shape, bool), 1.0) - 0.5 * cover[c])
    cells = [tuple(c) for c in np.argwhere((ring > 0) & ~np.isnan(patch["rest"]))]
    steps = (np.arange(2000) + 0.5) / 2000 - 0.5  # across a cell
    full = np.array(
        [np.mean(np.where((x := (far[c] + steps) / wide) > 0, np.clip((1 - x) / 0.2, 0, 1), 0)) for c in cells]
    )
    omega = shares(cells, patch, *foot, threshold)
    if not any(w > 0 for c, w in zip(cells, omega) if ring[c] == 1):
        omega[:] = 1.0
    weight = omega * full
    for (j, i), w in zip(cells, weight):
        patch["heap"][j, i] += w / weight.sum() * volume / patch["cell"] ** 2


def _distances(start, wall, cell):
    """Chamfer distance (1, sqrt 2) from one cell to all, around walls: Dijkstra."""
    far = np.full(wall.shape, np.inf)
    far[start] = 0.0
    queue = [(0.0, start)]
    while queue:
        d, (j, i) = heapq.heappop(queue)
        if d > far[j, i]:
            continue
        for dj in (-1, 0, 1):
            for di in (-1, 0, 1):
                q = (j + dj, i + di)
                if (dj or di) and 0 <= q[0] < wall.shape[0] and 0 <= q[1] < wall.shape[1] and not wall[q]:
                    step = d + cell * math.hypot(dj, di)
                    if step < far[q] - 1e-12:
                        far[q] = step
                        heapq.heappush(queue, (step, q))
    return far


def _edge(c, ring, cover, cell):
    """How much farther than half a cell the edge of the sole is from the middle of a border cell."""
    near = [
        math.hypot(j - c[0], i - c[1]) - cover[j, i]
        for j, i in np.argwhere(ring == 0)
        if max(abs(j - c[0]), abs(i - c[1])) == 1
    ]
    return cell * min(near)


def accumulate_rest(patch, ring, cover, foot, volume, threshold, slope):
    """Cones of height T sqrt(omega) on the border cells, filled up to their envelope; returns T.

    Untouched cells pressed to half the deepest under the sole are the hollow it has left: no cone
    stands in them or reaches through them, unless there is no other cell with a share. A cone falls from
    the edge of the sole on, which lies within the touched cells beside it: as far in as they are covered.
    """
    border = [tuple(c) for c in np.argwhere((ring == 1) & ~np.isnan(patch["rest"]))]
    omega = shares(border, patch, *foot, threshold)
    if not omega.any():
        omega[:] = 1.0
    deepest = patch["compression"][ring == 0].max()
    hollow = (patch["compression"] >= 0.5 * deepest) & (ring != 0) & (deepest > 0)
    outside = np.array([not hollow[c] for c in border])
    if omega[outside].any():
        border, omega = [c for c, out in zip(border, outside) if out], omega[outside]
    else:
        hollow[:] = False
    wall = (ring == 0) | np.isnan(patch["rest"]) | hollow
    border = [c for c, w in zip(border, omega) if w > 0]
    root = np.sqrt(omega[omega > 0])
    firm = patch["rest"] - patch["compression"]
    surface = np.where(wall, np.inf, firm + patch["heap"])
    cell = patch["cell"]
    falls = [firm[c] - slope * (_edge(c, ring, cover, cell) + _distances(c, wall, cell)) for c in border]

    def laid(height):
        fill = np.max([fall + height * w for fall, w in zip(falls, root)], axis=0)
        return np.maximum(fill - surface, 0.0)

    low, high = 0.0, 1e-3
    while laid(high).sum() * patch["cell"] ** 2 < volume:
        high *= 2
    for _ in range(100):
        middle = 0.5 * (low + high)
        if laid(middle).sum() * patch["cell"] ** 2 < volume:
            low = middle
        else:
            high = middle
    more = laid(high)
    patch["heap"] += more * (volume / (more.sum() * patch["cell"] ** 2))
    return high


def accumulate_bulge(patch, ring, cover, foot, volume, width, threshold, uneven=None):
    """exp(-(e/w)^1.4) around the sole, e the distance from its edge; none on the hollow it has left."""
    far = np.full(ring.shape, np.inf)
    for c in map(tuple, np.argwhere(ring == 0)):
        far = np.minimum(far, _distances(c, np.zeros(ring.shape, bool), 1.0) + 0.5 - cover[c])
    deepest = patch["compression"][ring == 0].max()
    takes = (ring > 0) & ~np.isnan(patch["rest"])
    if (takes & (patch["compression"] < 0.5 * deepest)).any() and deepest > 0:
        takes &= patch["compression"] < 0.5 * deepest
    cells = [tuple(c) for c in np.argwhere(takes)]
    x = np.array([max(far[c], 0.0) * patch["cell"] / width for c in cells])
    full = np.maximum(np.exp(-(x**1.4)) - math.exp(-(4.0**1.4)), 0.0)
    omega = shares(cells, patch, *foot, threshold)
    if uneven is not None:
        omega = omega * np.exp(1.6 * np.array([uneven[c] for c in cells]))
    weight = omega * full
    for (j, i), w in zip(cells, weight):
        patch["heap"][j, i] += w / weight.sum() * volume / patch["cell"] ** 2
