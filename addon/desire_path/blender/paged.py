"""paged.py - nodes that find the page of a sparse picture in which a place is shown (bake/atlas.py).

The table of the pages is an image of its own: a pixel for each page that there could be.
"""

from ..bake.atlas import EDGE, PAGE, TABLE
from ..ground.sim import TILE

NAME = "pages"  # of the table among the images of a tree
AWAY = 4.0  # image coordinates of what no page shows lie so far off the picture


def names(index):
    """The stills a tree needs to play the frames of an index, by name: their files beside the frames."""
    return {NAME: TABLE} if getattr(index, "columns", 0) else {}


def place(wire, images, index, at):
    """(image coordinates in the pictures, whether anything is shown there) of coordinates over the whole rectangle."""
    wide, high = -(-index.nx // PAGE), -(-index.ny // PAGE)
    cells = wire.vector("MULTIPLY", at, (float(index.nx), float(index.ny), 0.0))
    page = wire.vector("FLOOR", wire.vector("MULTIPLY", cells, (1.0 / PAGE, 1.0 / PAGE, 0.0)))
    look = wire.vector("MULTIPLY_ADD", page, (1.0 / wide, 1.0 / high, 0.0), (0.5 / wide, 0.5 / high, 0.0))
    found = wire.image(images[NAME], look, 0, "Closest").outputs["Color"]
    slot = wire.split(found)
    middle = wire.split(wire.vector("ABSOLUTE", wire.vector("SUBTRACT", at, (0.5, 0.5, 0.0))))
    within = wire.math("LESS_THAN", wire.math("MAXIMUM", middle[0], middle[1]), 0.5)  # 3.4 repeats the last pixel once
    shown = wire.math("MULTIPLY", slot[2], within)
    inner = wire.vector("MULTIPLY_ADD", page, (-float(PAGE), -float(PAGE), 0.0), cells)
    corner = wire.vector("MULTIPLY_ADD", found, (float(TILE), float(TILE), 0.0), (float(EDGE), float(EDGE), 0.0))
    size = (1.0 / (index.columns * TILE), 1.0 / (index.rows * TILE), 0.0)
    there = wire.vector("MULTIPLY", wire.vector("ADD", inner, corner), size)
    off = wire.math("MULTIPLY", wire.math("SUBTRACT", 1.0, shown), AWAY)
    return wire.vector("ADD", there, wire.xyz(off, off)), wire.math("GREATER_THAN", shown, 0.5)
