"""Slow, literal twins of native/soil: one cell, one neighbour, one step at a time, in float64.

Patches are dicts of float64 arrays (ny, nx): rest, compression, heap, pressure_time, modulus, rest_slope,
depth (L0), tau, nu; and `cell`. Functions change them in place, as the kernels do.
"""

import heapq
import math

import numpy as np

RIGID = 0.95  # share of L0 that can be pressed
STIFFER = 100.0  # how much harder the ground is below it


def spring(t, depth):
    """Length by which a column is pressed when its target lies t below h0."""
    rigid = RIGID * depth
    x = t if t <= rigid else rigid + STIFFER * (t - rigid)
    return max(x, 0.0)


def _columns(patch, bottom, cover):
    for j, i in np.argwhere((cover > 0) & ~np.isnan(patch["rest"])):
        e = patch["compression"][j, i] - patch["heap"][j, i]
        yield j, i, cover[j, i], patch["rest"][j, i] - bottom[j, i], e


def _push_back(patch, bottom, cover, sink):
    """Force of the ground on the sole, and the area that carries."""
    force = area = 0.0
    for j, i, a, gap, e in _columns(patch, bottom, cover):
        x = spring(gap + sink, patch["depth"][j, i])
        sigma = patch["modulus"][j, i] / patch["depth"][j, i] * x
        force += a * sigma * patch["cell"] ** 2
        area += a * patch["cell"] ** 2 * (x > 0)
    return force, area


def balance(patch, bottom, cover, load):
    """The sink s at which the columns carry the load: bisection."""
    low = -max(gap for _, _, _, gap, _ in _columns(patch, bottom, cover))
    high = low + 1e-3
    while _push_back(patch, bottom, cover, high)[0] < load:
        high = low + 2 * (high - low)
    for _ in range(200):
        middle = 0.5 * (low + high)
        if _push_back(patch, bottom, cover, middle)[0] < load:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def _yield(patch, j, i, a, t, sigma, dt):
    """Lower one cell for dt seconds; returns what came from firm ground, what from the heap."""
    t = min(t, RIGID * patch["depth"][j, i])
    e = patch["compression"][j, i] - patch["heap"][j, i]
    press = max(min(a * t * min(dt / patch["tau"][j, i], 1.0), a * t - e), 0.0)  # SOFT22 (11)
    loose = min(press, patch["heap"][j, i])
    patch["heap"][j, i] -= loose
    patch["compression"][j, i] += press - loose
    patch["pressure_time"][j, i] += sigma * a * dt  # TRAIL (17)
    return press - loose, loose


def compress(patch, bottom, cover, load, dt, law="sole"):
    """TRAIL (9) (10), SOFT22 (9)-(12). Returns (touched, firm, loose, displaced, sink)."""
    cell2 = patch["cell"] ** 2
    sole = sum(a for _, _, a, _, _ in _columns(patch, bottom, cover)) * cell2
    least = min(max(4 * cell2, 0.05 * sole), sole)
    touched = np.zeros(cover.shape, bool)
    firm = loose = displaced = 0.0
    if law == "sole":
        sink = balance(patch, bottom, cover, load)
        area = _push_back(patch, bottom, cover, sink)[1]
        if 0 < area < least:
            sink = balance(patch, bottom, cover, load * area / least)
    else:
        def overlap(a, gap, e, j, i):
            return gap - (min(e / a, RIGID * patch["depth"][j, i]) if e > 0 else e)
        high = max(overlap(a, gap, e, j, i) for j, i, a, gap, e in _columns(patch, bottom, cover))
        lowest = [(j, i) for j, i, a, gap, e in _columns(patch, bottom, cover)
                  if overlap(a, gap, e, j, i) >= high - 0.01]
        area = sum(cover[j, i] for j, i in lowest) * cell2
        sigma_all = load / max(area, least)  # SOFT22 (9)
        sink = -high
    for j, i, a, gap, e in list(_columns(patch, bottom, cover)):
        stiffness = patch["modulus"][j, i] / patch["depth"][j, i]  # E/L0
        if law == "sole":
            t = gap + sink
            sigma = stiffness * spring(t, patch["depth"][j, i])
            carries = sigma > 0
        else:
            sigma = sigma_all
            t = sigma / stiffness  # TRAIL (10)
            carries = (j, i) in lowest
        if not carries:
            continue
        touched[j, i] = True
        c, b = _yield(patch, j, i, a, t, sigma, dt)
        firm += c * cell2
        loose += b * cell2
        displaced += 2 * patch["nu"][j, i] * (c + b) * cell2  # SOFT22 (12)
    return touched, firm, loose, displaced, sink


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


def accumulate_paper(patch, ring, foot, volume, width, threshold):
    """TRAIL (11)-(13) on a rim `width` wide."""
    cells = [(j, i) for j, i in np.argwhere((ring >= 1) & (ring < 32767)) if not np.isnan(patch["rest"][j, i])]
    falloff = np.array([1.0 if ring[c] == 1 else max(1 - (ring[c] - 1) * patch["cell"] / width, 0.0)
                        for c in map(tuple, cells)])
    edge = [c for c in cells if ring[tuple(c)] == 1]
    omega = shares(cells, patch, *foot, threshold)
    if not shares(edge, patch, *foot, threshold).any():
        omega[:] = 1.0
    weight = omega * falloff
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
    near = [math.hypot(j - c[0], i - c[1]) - cover[j, i] for j, i in np.argwhere(ring == 0)
            if max(abs(j - c[0]), abs(i - c[1])) == 1]
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


def sweep(patch, touched=None, tolerance=1e-5):
    """One sweep of TRAIL (14)-(16) with both stencils, by loops."""
    slack = math.tan(tolerance) * patch["cell"]
    ny, nx = patch["rest"].shape
    height = patch["rest"] - patch["compression"] + patch["heap"]
    stands = np.isnan(patch["rest"]) | (touched if touched is not None else False)
    moved = np.zeros((ny, nx))
    for j in range(ny):
        for i in range(nx):
            if stands[j, i]:
                continue
            excess = {}
            for dj in (-1, 0, 1):
                for di in (-1, 0, 1):
                    q = (j + dj, i + di)
                    if not (dj or di) or not (0 <= q[0] < ny and 0 <= q[1] < nx) or stands[q]:
                        continue
                    far = patch["cell"] * math.hypot(dj, di)
                    over = height[j, i] - height[q] - patch["rest_slope"][j, i] * far  # TRAIL (14)
                    if over > 0:
                        excess[q] = over
            if not excess:
                continue
            steepest = max(over / math.hypot(q[0] - j, q[1] - i) for q, over in excess.items())
            hold = 0.25 * slack * (1 + patch["rest_slope"][j, i] ** 2)
            eager = min(max(steepest - hold, 0.0) / hold, 1.0) * min(patch["heap"][j, i] / (0.1 * slack), 1.0)
            n = sum(min(1.0, over / (0.1 * slack)) for over in excess.values())
            out = sum(excess.values()) / (n + 1)
            a = min(1.0, patch["heap"][j, i] / out) / (n + 1) * eager  # TRAIL (15)
            for q, over in excess.items():  # TRAIL (16)
                moved[q] += a * over
                moved[j, i] -= a * over
    patch["heap"] += moved
