"""Slow, literal twins of native/plants: one plant, one constraint at a time, in float64.

A kind is a dict of Kind's fields; particle = stem * rows + row, rows 0 and 1 are held.
"""

import math

import numpy as np

# ---- as printed ---------------------------------------------------------------------------------


def constraints(stems, rest):
    """TRAIL (5) of one plant, (stems, rows, 3) each: C_s = l - l_0 of vertical, horizontal and diagonal edges in
    one sheet, over l_0, and C_b = phi - phi_0 between consecutive edges of a stem."""

    def lengths(at):
        pairs = [at[:, 1:] - at[:, :-1], at[1:] - at[:-1], at[1:, 1:] - at[:-1, :-1], at[1:, :-1] - at[:-1, 1:]]
        return np.concatenate([np.linalg.norm(pair, axis=-1).ravel() for pair in pairs])

    def angles(at):
        a, b = at[:, 1:-1] - at[:, :-2], at[:, 2:] - at[:, 1:-1]
        size = np.linalg.norm(a, axis=-1) * np.linalg.norm(b, axis=-1)
        return np.arccos(np.clip((a * b).sum(-1) / size, -1, 1))

    return lengths(stems) / lengths(rest) - 1, angles(stems) - angles(rest)


# ---- the solver: ours, written down again from the design ----------------------------------------

HELD = 2
SUBSTEP = 1 / 480
BEYOND = 1.02
LONGEST = 1.05
FASTEST = 6.0


def shape(kind):
    rows = max(math.floor(kind["height"] / kind["spacing"] + 1e-4) + 1, HELD + 1)
    columns = math.floor(kind["width"] / kind["spacing"] + 1e-4) + 1
    sheets = kind["sheets"] if kind["form"] == "tuft" else 1
    return rows, columns, sheets


def rest_shape(kind):
    """(stems, rows, 3) in the plant's frame."""
    rows, columns, sheets = shape(kind)
    gap = kind["height"] / (rows - HELD)
    at = np.zeros((sheets * columns, rows, 3))
    for s in range(sheets):
        for c in range(columns):
            along = np.array([math.cos(math.pi * s / sheets), math.sin(math.pi * s / sheets)])
            wide = kind["width"] if s == 0 else kind["depth"]
            off = wide * (c / (columns - 1) - 0.5) if columns > 1 else 0.0
            out = np.sign(off if abs(off) > 1e-9 else 0) * along
            if kind["form"] == "surface":
                out = np.array([-along[1], along[0]])
            stem = at[s * columns + c]
            stem[0] = (*(off * along), -gap)
            for r in range(1, rows):
                lean = min(kind["curl"] * (r - 1), 0.9 * math.pi) if out.any() else 0.0
                stem[r, :2] = stem[r - 1, :2] + gap * math.sin(lean) * out
                stem[r, 2] = stem[r - 1, 2] + gap * math.cos(lean)
                if r > 1:
                    stem[r, 2] = max(stem[r, 2], 0.0)
    return at


def turned(at, heading):
    c, s = math.cos(heading), math.sin(heading)
    return at @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])


def bend_rate(kind):
    """Stiffness over mass at which the lowest mode of a stem swings at kind["sway"]."""
    n = shape(kind)[0] - HELD
    bends = np.zeros((n, n))
    for k in range(n):
        for j, w in ((k, 1), (k - 1, -2), (k - 2, 1)):
            if j >= 0:
                bends[k, j] = w
    return (2 * math.pi * kind["sway"]) ** 2 / np.linalg.eigvalsh(bends.T @ bends)[0]


def edges(kind):
    """(stem a, row a, stem b, row b, stiffness over mass); 0 = rigid. In the order of the kernel."""
    rows, columns, sheets = shape(kind)
    rate = (2 * math.pi * kind["across"]) ** 2
    pairs = [s for odd in (0, 1) for s in range(odd, sheets * columns, 2) if s % columns + 1 < columns]
    found = [(s, r, s + 1, r, rate) for s in pairs for r in range(rows)]
    for s in pairs:
        for r in range(rows - 1):
            found += [(s, r, s + 1, r + 1, 4 * rate), (s + 1, r, s, r + 1, 4 * rate)]
    found += [(s, r, s, r + 1, 0.0) for r in range(1, rows - 1) for s in range(sheets * columns)]
    return [e for e in found if e[1] >= HELD or e[3] >= HELD]


def substep(kind, at, speed, share, rest, limp, ground, h):
    """TRAIL (5) for one plant: at, speed, rest (stems, rows, 3), share of strength (stems, rows - 2)."""
    stems, rows = at.shape[:2]
    before = at.copy()
    speed[:, HELD:, 2] -= 9.81 * h * limp[:, HELD:]
    speed[:, HELD:] /= 1 + kind["damping"] * h
    at[:, HELD:] += h * speed[:, HELD:]
    compliance = 1 / (bend_rate(kind) * h * h)
    for r in range(rows - 2):
        for s in range(stems):
            w = [float(r >= HELD), float(r + 1 >= HELD), 1.0]
            bend = at[s, r] - 2 * at[s, r + 1] + at[s, r + 2]
            off = bend - (rest[s, r] - 2 * rest[s, r + 1] + rest[s, r + 2])  # C_b, TRAIL (5)
            if share[s, r] <= 0:
                continue
            step = off / (w[0] + 4 * w[1] + w[2] + compliance / share[s, r])
            at[s, r] -= w[0] * step
            at[s, r + 1] += 2 * w[1] * step
            at[s, r + 2] -= step
    for sa, ra, sb, rb, rate in edges(kind):
        if rate > 0 and limp[sa, ra] + limp[sb, rb] > 0:
            continue
        wa, wb = float(ra >= HELD), float(rb >= HELD)
        arm = at[sb, rb] - at[sa, ra]
        length, wanted = np.linalg.norm(arm), np.linalg.norm(rest[sb, rb] - rest[sa, ra])
        if length < 1e-9:
            continue
        stretch = (length - wanted) / length  # C_s, TRAIL (5)
        if rate > 0:
            stretch *= (wa + wb) / (wa + wb + 1 / (rate * h * h))
            stretch = max(stretch, (length - BEYOND * wanted) / length)
        at[sa, ra] += wa / (wa + wb) * stretch * arm
        at[sb, rb] -= wb / (wa + wb) * stretch * arm
    for s in range(stems):
        for r in range(HELD, rows):
            if at[s, r, 2] > ground:
                continue
            at[s, r, :2] += 0.95 * limp[s, r] * (before[s, r, :2] - at[s, r, :2])
            at[s, r, 2] = ground
    speed[:, HELD:] = np.clip((at - before)[:, HELD:] / h, -FASTEST, FASTEST)


def limp_of(share):
    """1 above a broken bend: (stems, rows)."""
    broken = np.maximum.accumulate(share <= 0, axis=1)
    return np.concatenate([np.zeros((len(share), 2)), broken], axis=1).astype(float)


def wear(kind, reserve, strength, angle, dt):
    """TRAIL (6) for one bend, its angle taken from rest."""
    if strength <= 0 or angle > kind["break_angle"]:
        return 0.0
    if angle >= kind["degrade_angle"]:
        return max(strength - kind["degrade_rate"] * dt, 0.0)
    return min(strength + kind["recover_rate"] * dt, reserve)


def angle_at(stem, r):
    a, b = stem[r + 1] - stem[r], stem[r + 2] - stem[r + 1]
    size = np.linalg.norm(a) * np.linalg.norm(b)
    return math.acos(np.clip(a @ b / size, -1, 1)) if size > 0 else 0.0


def step(kind, root, heading, reserve, at, speed, strength, dt):
    """One plant lives for dt on level ground, without walkers; changes all three in place."""
    rest = turned(rest_shape(kind), heading) + root
    at[:, :HELD] = rest[:, :HELD]
    n = min(max(math.ceil(dt / SUBSTEP - 1e-9), 1), 64)
    for _ in range(n):
        substep(kind, at, speed, strength / reserve, rest, limp_of(strength), root[2], dt / n)
    limp = limp_of(strength)
    for sa, ra, sb, rb, _ in 2 * edges(kind):  # rows hold together, stems keep their length
        arm, wanted = at[sb, rb] - at[sa, ra], np.linalg.norm(rest[sb, rb] - rest[sa, ra])
        if ra == rb and limp[sa, ra] + limp[sb, rb] == 0 and np.linalg.norm(arm) > BEYOND * wanted:
            over = 0.5 * (1 - BEYOND * wanted / np.linalg.norm(arm)) * arm
            at[sa, ra] += over
            at[sb, rb] -= over
    gap = kind["height"] / (at.shape[1] - HELD)
    for s in range(len(at)):
        for r in range(HELD, at.shape[1]):
            arm = at[s, r] - at[s, r - 1]
            if np.linalg.norm(arm) > LONGEST * gap:
                at[s, r] = at[s, r - 1] + arm * LONGEST * gap / np.linalg.norm(arm)
    for s in range(len(at)):
        for r in range(at.shape[1] - 2):
            angle = angle_at(at[s], r) - angle_at(rest[s], r)
            if limp[s, r + 1] > 0:
                continue
            strength[s, r] = wear(kind, reserve, strength[s, r], angle, dt)


def cover(kind, root, alpha, x0, y0, cell, nx, ny, paper):
    """alpha_veg, TRAIL (7), and E_v, TRAIL (8)."""
    strength = np.zeros((ny, nx))
    full = kind["full_density"] * math.pi * kind["reach"] ** 2 / 3
    for j in range(ny):
        for i in range(nx):
            d = np.hypot(root[:, 0] - (x0 + i * cell), root[:, 1] - (y0 + j * cell))
            near = d < kind["reach"]
            if not near.any():
                continue
            kernel = 1 - d[near] / kind["reach"]
            if paper:
                strength[j, i] = (kernel * alpha[near]).sum() / near.sum()  # TRAIL (7)
            else:
                strength[j, i] = min(1, (kernel * alpha[near]).sum() / max(kernel.sum(), full))
    return strength, strength * kind["modulus"]  # TRAIL (8)


def regrow(kind, alpha, seconds, steps=20000):
    for _ in range(steps):
        source = kind["seed_share"] + (1 - kind["seed_share"]) * alpha
        alpha += kind["regrow_rate"] * source * (1 - alpha) * seconds / steps
    return alpha
