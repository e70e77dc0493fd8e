"""Arrival times, literally: the earliest of all cells that were told a time is known next. Slow."""

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
