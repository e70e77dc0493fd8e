"""Slow twin of native/base/noise.c: one place at a time, in float64 and whole numbers. MODEL 6.7"""

import math

WORD = 2**32


def chance(i, j, seed):
    """32 bits for a corner of a lattice."""
    h = (i * 0x9E3779B1 + j * 0x85EBCA6B + seed * 0xC2B2AE35) % WORD
    h = ((h ^ (h >> 16)) * 0x7FEB352D) % WORD
    h = ((h ^ (h >> 15)) * 0x846CA68B) % WORD
    return h ^ (h >> 16)


def unit(bits):
    return ((bits & 0xFFFF) + 0.5) / 65536


def fade(t):
    return 6 * t**5 - 15 * t**4 + 10 * t**3


def wave(u, v, seed):
    """Gradient noise (Perlin 2002) on a lattice of squares 1 wide, of variance 1."""
    m, n = math.floor(u), math.floor(v)
    total = 0.0
    for j in (0, 1):
        for i in (0, 1):
            bits = chance(m + i, n + j, seed)
            a, b = u - m - i, v - n - j
            plane = (2 * unit(bits) - 1) * a + (2 * unit(bits >> 16) - 1) * b
            total += plane * (1 - fade(abs(a))) * (1 - fade(abs(b)))
    return 5.677717 * total


def waves(x, y, cell, longest, shortest, seed):
    """Waves from longest down by halves, each 0.6 as high; those under two cells are left out."""
    lengths = [longest / 2**k for k in range(40) if longest / 2**k > 0.99 * shortest]
    norm = math.sqrt(sum(0.36**k for k in range(len(lengths))))
    total = 0.0
    for k, length in enumerate(lengths):
        if length < 2 * cell:
            break
        away, aside = unit(chance(0, 0, seed + k)), unit(chance(0, 1, seed + k))
        total += 0.6**k / norm * wave(x / length + away, y / length + aside, seed + k)
    return total


def piece(x, y, size, seed):
    """The number of the nearest point of a lattice whose points stray."""
    u, v = x / size, y / size
    best, number = math.inf, 0.0
    for j in range(math.floor(v) - 1, math.floor(v) + 2):
        for i in range(math.floor(u) - 1, math.floor(u) + 2):
            bits = chance(i, j, seed)
            at = (i + 0.5 + 0.9 * (unit(bits) - 0.5), j + 0.5 + 0.9 * (unit(bits >> 16) - 0.5))
            if math.dist(at, (u, v)) < best:
                best, number = math.dist(at, (u, v)), unit(chance(i, j, seed + 1))
    return math.sqrt(3) * (2 * number - 1)
