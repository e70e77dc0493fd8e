"""The lines of a trodden ground, thinned to one cell (Zhang and Suen 1984), and how long they are (Kulpa 1977)."""

import numpy as np


def _around(mask):
    """The eight neighbours of each cell, from above, clockwise."""
    wide = np.pad(mask, 1)
    ny, nx = mask.shape
    ring = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1))
    return [wide[1 + b : 1 + b + ny, 1 + a : 1 + a + nx] for b, a in ring]


def _crossings(around):
    return sum((~around[k] & around[(k + 1) % 8]).astype(int) for k in range(8))


def thin(mask):
    mask = mask.copy()
    changed = True
    while changed:
        changed = False
        for first in (True, False):
            p = _around(mask)
            count = sum(each.astype(int) for each in p)
            n, e, s, w = p[0], p[2], p[4], p[6]
            keep = (n & e & s) | (e & s & w) if first else (n & e & w) | (n & s & w)
            gone = mask & (count >= 2) & (count <= 6) & (_crossings(p) == 1) & ~keep
            mask &= ~gone
            changed |= bool(gone.any())
    for corner in ((0, 2), (2, 4), (4, 6), (6, 0)):  # stairs become diagonals
        p = _around(mask)
        alone = mask & p[corner[0]] & p[corner[1]] & ~p[(corner[0] + 4) % 8] & ~p[(corner[1] + 4) % 8]
        mask &= ~(alone & ~p[(corner[0] + 5) % 8])
    return mask


def filled(mask, cells):
    """A mask without holes of fewer cells."""
    mask, seen = mask.copy(), mask.copy()
    ny, nx = mask.shape
    for start in map(tuple, np.argwhere(~mask)):
        if seen[start]:
            continue
        hole, rim = [start], [start]
        seen[start] = True
        while rim:
            j, i = rim.pop()
            for place in ((j - 1, i), (j + 1, i), (j, i - 1), (j, i + 1)):
                if 0 <= place[0] < ny and 0 <= place[1] < nx and not seen[place]:
                    seen[place] = True
                    hole.append(place)
                    rim.append(place)
        if len(hole) < cells:
            mask[tuple(np.transpose(hole))] = True
    return mask


def pruned(line, cells):
    """A thinned mask without branches that end after so few cells."""
    short = line.copy()
    for _ in range(cells):
        short &= ~(short & (sum(each.astype(int) for each in _around(short)) <= 1))
    grown = short & (sum(each.astype(int) for each in _around(short)) <= 1)
    for _ in range(cells):
        near = grown | np.any(_around(grown), axis=0)
        grown = near & line
    return thin(short | grown)


def length(line, cell):
    """Of a thinned mask: orthogonal links, and diagonal ones where no others join the same cells; right on average
    over all directions."""
    straight = (line[1:] & line[:-1]).sum() + (line[:, 1:] & line[:, :-1]).sum()
    rising = line[1:, 1:] & line[:-1, :-1] & ~(line[1:, :-1] | line[:-1, 1:])
    falling = line[1:, :-1] & line[:-1, 1:] & ~(line[1:, 1:] | line[:-1, :-1])
    return 0.948 * cell * (straight + np.sqrt(2.0) * (rising.sum() + falling.sum()))


def junctions(line):
    """Cells where three or more branches meet, those near each other once: how many."""
    meets = line & (_crossings(_around(line)) >= 3)
    places = []
    for place in np.argwhere(meets):
        if all(np.abs(place - other).max() > 3 for other in places):
            places.append(place)
    return len(places)
