"""noise.py - smooth random heights from a seed, the same on every machine."""

import numpy as np


def _lattice(i, j, seed):
    """A number in -1..1 for every lattice point, by mixing bits."""
    h = i.astype(np.int64) * 374761393 + j.astype(np.int64) * 668265263 + seed * 974634777
    h = (h & 0xFFFFFFFF).astype(np.uint64)
    for shift, factor in ((15, 0x2C1B3C6D), (12, 0x297A2D39)):
        h = ((h ^ (h >> np.uint64(shift))) * np.uint64(factor)) & np.uint64(0xFFFFFFFF)
    h ^= h >> np.uint64(15)
    return h.astype(np.float64) / 2147483647.5 - 1.0


def smooth(x, y, wavelength, seed):
    """Value noise, about -1..1, with continuous slope and curvature; wavelength [m]."""
    u, v = np.asarray(x) / wavelength, np.asarray(y) / wavelength
    # turned a little, so that no lattice line runs along an axis
    u, v = 0.8 * u - 0.6 * v + 17.3 * seed, 0.6 * u + 0.8 * v - 11.7 * seed
    i, j = np.floor(u), np.floor(v)
    s, t = u - i, v - j
    s, t = (w * w * w * (w * (6 * w - 15) + 10) for w in (s, t))
    low = _lattice(i, j, seed) * (1 - s) + _lattice(i + 1, j, seed) * s
    high = _lattice(i, j + 1, seed) * (1 - s) + _lattice(i + 1, j + 1, seed) * s
    return low * (1 - t) + high * t


def rough(x, y, wavelength, seed, octaves=3, fall=0.5):
    """Several wavelengths, each half as long and `fall` times as high as the one before."""
    total, height = 0.0, 1.0
    for k in range(octaves):
        total = total + height * smooth(x, y, wavelength / 2**k, seed + 31 * k)
        height *= fall
    return total
