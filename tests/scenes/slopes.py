"""slopes.py - how much loose soil lies steeper than it stays. MODEL 11.5"""

import math

import numpy as np

SLACK = math.radians(0.1)  # soil this much over its rest angle counts as at rest [rad]
FILM = 0.1 * math.tan(SLACK)  # and so does a film this thin, in cells


def excess(surface, heap, cell, rest_angle):
    """The most by which a loose slope, towards any of 8 neighbours, is over `rest_angle` [rad] and the
    slack, as a slope; 0 where all is at rest. surface, heap: (ny, nx) [m]; edges are taken as joined."""
    steepest = 0.0
    for dj in (-1, 0, 1):
        for di in (-1, 0, 1):
            if di or dj:
                way = cell * math.hypot(di, dj)
                over = surface - np.roll(surface, (dj, di), (0, 1)) - math.tan(rest_angle + SLACK) * way
                loose = heap - FILM * cell  # firm ground may stand as it likes
                steepest = max(steepest, float(np.minimum(over, loose).max()) / way)
    return steepest
