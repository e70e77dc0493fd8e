"""grass_nodes.py - what the nodes of a meadow ask and reckon: a bake's images at a place, how a stem is bent."""

from ..ground import tuft
from . import paged, playback_tree


class Field:
    """What a bake's images say at places of the world."""

    def __init__(self, wire, index, images, count, stretch):
        self.wire, self.images, self.index = wire, images, index
        self.number = playback_tree.file_number(wire, index, count, stretch)
        self.size = (index.nx * index.cell, index.ny * index.cell)
        self.corner = (index.x0, index.y0)

    def where(self, place):
        """Image coordinates of a place."""
        at = self.wire.vector(
            "MULTIPLY_ADD",
            place,
            (1 / self.size[0], 1 / self.size[1], 0.0),
            (-self.corner[0] / self.size[0], -self.corner[1] / self.size[1], 0.0),
        )
        return paged.place(self.wire, self.images, self.index, at)[0] if paged.NAME in self.images else at

    def ground(self, place):
        """How much higher the ground is than at rest [m], and the pressure over time it bore [Pa s]."""
        found = self.wire.image(self.images["trail"], self.where(place), self.number, True)
        return self.wire.split(found.outputs["Color"])[0], found.outputs["Alpha"]

    def lean(self, place, *, at_rest=False):
        """(lean x, lean y, crushed), strength."""
        found = self.wire.image(self.images["lean"], self.where(place), 0 if at_rest else self.number, True)
        return found.outputs["Color"], found.outputs["Alpha"]

    def broken(self, place):
        """Share of the stems that stood at first and are broken, 0..1."""
        wire = self.wire
        now, first = self.lean(place)[1], self.lean(place, at_rest=True)[1]
        shrunk = wire.math("DIVIDE", wire.math("ADD", now, 0.01), wire.math("ADD", first, 0.01))
        return wire.math("MAXIMUM", wire.math("SUBTRACT", 1.0, shrunk), 0.0)


def mix(wire, share, a, b):
    """a where share is 0, b where it is 1."""
    return wire.math(
        "ADD", wire.math("MULTIPLY", wire.math("SUBTRACT", 1.0, share), a), wire.math("MULTIPLY", share, b)
    )


def bent(wire, length, along, across, tilt, arch):
    """tuft.bent() in nodes: where a point of a straight stem comes to lie, from the stem's root."""
    share = wire.math("DIVIDE", along, wire.math("MAXIMUM", length, 1e-6))

    def towards(part):
        """Sine and cosine of the tilt there, the sine along its direction."""
        vector = wire.vector("MULTIPLY_ADD", arch, wire.xyz(part, part, part), tilt)
        angle = wire.math("MAXIMUM", wire.vector("LENGTH", vector), 1e-6)
        sine = wire.math("SINE", angle)
        return vector, angle, sine, wire.math("COSINE", angle)

    out = None
    for part, weight in tuft.GAUSS:
        vector, angle, sine, cosine = towards(wire.math("MULTIPLY", share, part))
        piece = wire.vector(
            "ADD", wire.vector("SCALE", vector, scale=wire.math("DIVIDE", sine, angle)), wire.xyz(z=cosine)
        )
        piece = wire.vector("SCALE", piece, scale=wire.math("MULTIPLY", along, weight))
        out = piece if out is None else wire.vector("ADD", out, piece)
    # what lies across the stem is turned with it
    vector, angle, sine, cosine = towards(share)
    direction = wire.vector("SCALE", vector, scale=wire.math("DIVIDE", 1.0, angle))
    ahead = wire.vector("DOT_PRODUCT", across, direction)
    back = wire.math("MULTIPLY", ahead, wire.math("SUBTRACT", cosine, 1.0))
    turned = wire.vector("ADD", across, wire.vector("SCALE", direction, scale=back))
    turned = wire.vector("SUBTRACT", turned, wire.xyz(z=wire.math("MULTIPLY", ahead, sine)))
    return wire.vector("ADD", out, turned)
