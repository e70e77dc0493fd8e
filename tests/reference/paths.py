"""Arrival times, literally: the earliest of all cells that were told a time is known next; and ways down them. Slow."""

import math

import numpy as np


def upwind(time, known, i, j, di, dj):
    """(T1, T2) of one axis: the earlier known neighbour, and the known one behind it if that is earlier still."""
    sides = []
    for sign in (-1, 1):
        near, far = (i + sign * di, j + sign * dj), (i + 2 * sign * di, j + 2 * sign * dj)
        if near in known:
            sides.append((float(time[near]), float(time[far]) if far in known else math.inf))
    if not sides:
        return None
    first, second = min(sides)
    return first, second if second < first else None


def solve(axes, f):
    """The least T, not before any u, of sum w (T - u)^2 = f^2 over the axes [(u, w)]."""
    w = sum(w for _, w in axes)
    b = sum(w * u for u, w in axes)
    c = sum(w * u * u for u, w in axes) - f * f
    root = b * b - w * c
    if root < 0.0:
        return None
    time = (b + math.sqrt(root)) / w
    return time if all(time >= u for u, _ in axes) else None


def tell(time, known, i, j, f):
    axes = [found for found in (upwind(time, known, i, j, 1, 0), upwind(time, known, i, j, 0, 1)) if found]
    second = [((4.0 * a - b) / 3.0, 2.25) if b is not None else (a, 1.0) for a, b in axes]  # MODEL 12.1
    first = [(a, 1.0) for a, _ in axes]
    for tried in (second, first):
        told = solve(tried, f)
        if told is not None:
            return told
    return min(solve([axis], f) for axis in second)


def arrival(cost, goals, cell, starts=None):
    """float32 (ny, nx); goals are (column, row)."""
    ny, nx = cost.shape
    time = np.full((ny, nx), np.inf, np.float32)
    told, known = {}, set()
    start = dict(zip(((j, i) for i, j in goals), starts if starts is not None else [0.0] * len(goals)))
    told.update(start)
    while told:
        place = min(told, key=lambda at: (told[at], at))
        time[place] = told.pop(place)
        known.add(place)
        j, i = place
        for at in ((j - 1, i), (j + 1, i), (j, i - 1), (j, i + 1)):
            if not (0 <= at[0] < ny and 0 <= at[1] < nx) or at in known or not np.isfinite(cost[at]):
                continue
            new = np.float32(max(tell(time, known, *at, float(cost[at]) * cell), float(time[place])))
            if at in start:
                if new + float(cost[at]) * cell >= start[at]:
                    continue
                del start[at]
            told[at] = new
    return time


def seen(wear, cell, sight):
    """V, cell by cell."""
    ny, nx = wear.shape
    out = np.zeros((ny, nx))
    for j in range(ny):
        for i in range(nx):
            for b in range(ny):
                for a in range(nx):
                    far = math.hypot(a - i, b - j) * cell
                    if far <= 8.0 * sight:
                        out[j, i] += wear[b, a] * math.exp(-far / sight) * cell**2  # MODEL 12.4
    return out


def unit(v):
    length = math.hypot(*v)
    return (v[0] / length, v[1] / length) if length > 0.0 else (0.0, 0.0)


def down(time, i, j):
    """unit(-grad T) at a cell's middle. MODEL 12.2"""
    ny, nx = time.shape

    def at(i, j):
        return float(time[j, i]) if 0 <= i < nx and 0 <= j < ny else math.inf

    def rise(before, behind):
        here = at(i, j)
        if math.isfinite(before) and math.isfinite(behind):
            return 0.5 * (behind - before)
        return behind - here if math.isfinite(behind) else here - before if math.isfinite(before) else 0.0

    return unit((-rise(at(i - 1, j), at(i + 1, j)), -rise(at(i, j - 1), at(i, j + 1))))


def look(time, pull, x, y, cell):
    """(T, unit(-grad T), pull) between the middles of four cells."""
    ny, nx = time.shape
    u, v = x / cell - 0.5, y / cell - 0.5
    total, mean, to, aside = 0.0, 0.0, np.zeros(2), np.zeros(2)
    for j in (math.floor(v), math.floor(v) + 1):
        for i in (math.floor(u), math.floor(u) + 1):
            share = (1.0 - abs(u - i)) * (1.0 - abs(v - j))
            if not (0 <= i < nx and 0 <= j < ny and share > 0.0 and np.isfinite(time[j, i])):
                continue
            total += share
            mean += share * float(time[j, i])
            to += share * np.array(down(time, i, j))
            aside += share * pull[j, i].astype(float)
    return mean / total, unit(to), aside / total


def descend(time, start, cell, pull, step, turn=None, inertia=0.0):
    """MODEL 12.3, MODEL 12.5, step by step."""
    ny, nx = time.shape
    points, heading, stuck = [tuple(map(float, start))], None, math.inf
    while True:
        x, y = points[-1]
        i, j = int(x // cell), int(y // cell)
        gains = {}
        for a, b in ((i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1)):
            if 0 <= a < nx and 0 <= b < ny and np.isfinite(time[b, a]):
                gains[a, b] = float(time[j, i]) - float(time[b, a])
        if not gains or max(gains.values()) <= 0.0:
            return np.array(points)
        fall = max(gains.values())
        here, straight, aside = look(time, pull, x, y, cell)
        meant = unit(np.add(straight, aside))  # MODEL 12.3
        if heading is not None and inertia > 0.0:
            kept = math.exp(-step / inertia)
            meant = unit(kept * np.array(heading) + (1.0 - kept) * np.array(meant))  # MODEL 12.5
        heading = meant
        angle = float(turn[(len(points) - 1) % len(turn)]) if turn is not None else 0.0
        erred = complex(*meant) * complex(math.cos(angle), math.sin(angle))  # MODEL 12.5
        tries = [(erred.real, erred.imag), straight] if here < stuck else []
        for number, to in enumerate(tries):
            a, b = x + step * to[0], y + step * to[1]
            c, d = math.floor(a / cell), math.floor(b / cell)
            free = 0 <= c < nx and 0 <= d < ny and np.isfinite(time[d, c])
            if free and look(time, pull, a, b, cell)[0] <= here - 0.02 * fall * step / cell:
                points.append((a, b))
                heading = heading if number == 0 else straight
                break
        else:
            heading = straight
            stuck = here if here < stuck else stuck
            a, b = max(gains, key=gains.get)
            points.append(((a + 0.5) * cell, (b + 0.5) * cell))
