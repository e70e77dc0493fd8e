"""Slow, literal twin of what ground is like below a cell: one place at a time, by whole numbers. MODEL 8.3"""

import math

from tests.reference import noise
from tests.reference.noise import chance, unit

APART, STRAYS, SMALL, HIGH, STEEP = 2.6, 0.9, 0.6, 0.8, 1.6
VEIN, VEIN_MEAN = 0.55, 0.1513
AREA = 5.0 * math.tan(math.pi / 5.0)  # of a pentagon around a circle of radius 1


def wave(x, y, length, seed):
    """Gradient noise whose lattice begins somewhere by chance."""
    return noise.wave(x / length + unit(chance(0, 0, seed)), y / length + unit(chance(0, 1, seed)), seed)


def waves(x, y, length, seed):
    return (wave(x, y, length, seed) + 0.5 * wave(x, y, length / 2, seed + 1)) / math.sqrt(1.25)


def strays(x, y, length, seed, rough=0.7, finest=0.004):
    """Waves by halves, until they are no longer than is seen."""
    lengths = [length]
    while lengths[-1] / 2 > finest:
        lengths.append(lengths[-1] / 2)
    high = [rough**k for k in range(len(lengths))]
    return sum(each * wave(x, y, its, seed + k) for k, (each, its) in enumerate(zip(high, lengths))) / math.hypot(*high)


def crumbs(x, y, share, least, most, seed):
    """(height less its mean, threshold of the largest crumb there)."""
    threshold, high, radii = 0.5 * least, 0.0, []
    if not share:
        return 0.0, threshold
    while most > 0.99 * least:
        radii.append(most)
        most /= 2
    for k, radius in enumerate(radii):
        square = APART * radius
        mean_area = AREA * radius**2 * (1 - SMALL**3) / (3 * (1 - SMALL))
        there = share / len(radii) * square**2 / mean_area
        # a flat top where 1 - STEEP (1 - t) < 0, and flanks down to 0 at t = 1
        top = 1 - 1 / STEEP
        filled = top**2 + STEEP * (1 - top**2 - 2 * (1 - top**3) / 3)
        mean_cube = radius**3 * (1 - SMALL**4) / (4 * (1 - SMALL))
        high -= there * HIGH * filled * AREA * mean_cube / square**2
        at = seed + 3 * k
        for j in range(math.floor(y / square) - 1, math.floor(y / square) + 2):
            for i in range(math.floor(x / square) - 1, math.floor(x / square) + 2):
                if unit(chance(i, j, at + 1)) >= there:
                    continue
                size = radius * (SMALL + (1 - SMALL) * unit(chance(i, j, at + 1) >> 16))
                middle = [
                    square * (cell + 0.5 + STRAYS * (unit(bits) - 0.5))
                    for cell, bits in ((i, chance(i, j, at)), (j, chance(i, j, at) >> 16))
                ]
                turned = math.atan2(y - middle[1], x - middle[0])
                turned += 2 * math.atan(2 * unit(chance(i, j, at + 2)) - 1)
                reach = math.dist((x, y), middle) / size
                away = max(reach * math.cos(turned - 2 * math.pi * side / 5) for side in range(5))
                if away < 1:
                    high += HIGH * size * min(1, STEEP * (1 - away))
                    threshold = max(threshold, 0.5 * size)
    return high, threshold


def detail(x, y, its, seed):
    """What a place is like; its: a Detail."""
    near = max(0.0, 1 - abs(wave(x, y, its.vein_size, seed)) / VEIN)
    high, threshold = crumbs(x, y, its.crumb_share, its.min_crumb, its.max_crumb, seed + 7)
    return (
        its.vein_height * (near**2 - VEIN_MEAN) if its.vein_height else 0.0,
        high,
        its.grit_height * waves(x, y, its.grit_size, seed + 1),
        its.fray * strays(x, y, its.fray_size, seed + 1000),
        its.fray * strays(x, y, its.fray_size, seed + 1100),
        threshold,
    )
