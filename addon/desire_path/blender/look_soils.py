"""look_soils.py - what each kind of ground looks like: colour, roughness, grain, by how far it was pressed and heaped.

    the name of a soil --look_of--> its look
    place, compression, heap, wetness, as sockets (Spot) --> colour, roughness, specular, subsurface, height [m]

Grain is a height for a bump, since it is finer than any cell; so are cracks, which a mesh would show as beads. n: a
looks.Shade, which makes the nodes. Numbers are metres unless they are shares.
"""

from dataclasses import dataclass

SOILS = {  # soil -> (look, how wet)
    "dry-sand": ("SAND", 0.0),
    "wet-sand": ("SAND", 0.85),
    "mud": ("MUD", 0.35),
    "wet-soil": ("EARTH", 0.7),
    "dry-soil": ("EARTH", 0.0),
}
WORDS = (  # in other names, the first that is found; else it is earth
    ("crust-snow", "CRUST"),
    ("snow", "SNOW"),
    ("sand", "SAND"),
    ("mud", "MUD"),
    ("clay", "MUD"),
    ("packed", "PACKED"),
)
WET = 0.7  # what has that word in its name
SNOWY = {"SNOW", "CRUST"}
SOLID = {  # what a look is in solid view; the others are as earth
    "SAND": (0.45, 0.32, 0.19),
    "SNOW": (0.85, 0.88, 0.92),
    "CRUST": (0.85, 0.88, 0.92),
    "MUD": (0.09, 0.057, 0.035),
    "PACKED": (0.23, 0.165, 0.11),
}


def look_of(name):
    """(look, wetness 0..1) of a soil by its name."""
    known = SOILS.get(name)
    if known is not None:
        return known
    found = next((each for word, each in WORDS if word in name), "EARTH")
    return found, WET if "wet" in name and found not in SNOWY else 0.0


@dataclass(frozen=True)
class Spot:
    """A place on a ground, as sockets."""

    at: object  # where it is on the ground, vector [m]
    compression: object  # pressed below the first height [m]
    heap: object  # loose soil piled above it [m]
    wet: object  # share


def pressed_so(n, spot, deep):
    """1 where the ground was pressed so deep and nothing loose lies on it, 0 where it was not."""
    bare = n.between(spot.heap, 0.0005, 0.004, 1.0, 0.0)
    return n.math("MULTIPLY", n.between(spot.compression, 0.06 * deep, deep), bare)


def loose_there(n, spot):
    """1 where loose soil lies on the ground."""
    return n.between(spot.heap, 0.0004, 0.005)


def _wetted(n, wet, colour, rough, specular, shine=0.38):
    """A look as it is when it is wet: darker, and it shines."""
    dark = n.math("MULTIPLY_ADD", wet, -0.55, 1.0)
    colour = n.vector("SCALE", colour, scale=dark)
    return colour, n.blend(wet, rough, shine), n.blend(wet, specular, 0.5)


def _sand(n, spot):
    """Grains of many colours; what was below the surface is a little damp."""
    grain, single = n.noise(spot.at, 620.0, 1.0, 0.6), n.noise(spot.at, 1900.0, 0.0)
    wide, lumps = n.noise(spot.at, 2.3, 2.0), n.noise(spot.at, 120.0, 2.0, 0.6)
    pressed = pressed_so(n, spot, 0.012)
    colour = n.mix(n.between(grain, 0.35, 0.68), (0.40, 0.27, 0.15, 1.0), (0.58, 0.43, 0.27, 1.0))
    colour = n.mix(n.between(single, 0.60, 0.72, 0.0, 0.5), colour, (0.20, 0.12, 0.065, 1.0))
    colour = n.mix(n.between(wide, 0.35, 0.7, 0.0, 0.35), colour, (0.38, 0.25, 0.135, 1.0))
    colour = n.mix(n.math("MULTIPLY", pressed, 0.42), colour, (0.21, 0.128, 0.066, 1.0))
    colour, rough, specular = _wetted(n, spot.wet, colour, 0.95, 0.12, 0.5)
    flat = n.math("MULTIPLY_ADD", pressed, -0.6, 1.0)
    height = n.sum((n.math("MULTIPLY", flat, 0.0009), grain), (n.math("MULTIPLY", flat, 0.0013), lumps))
    return colour, rough, specular, 0.0, height


def _snow(n, spot):
    """White, light goes a little into it; pressed it is denser, smoother and bluer."""
    grain, lumps = n.noise(spot.at, 520.0, 1.0, 0.6), n.noise(spot.at, 70.0, 3.0, 0.55)
    crumbs, pressed, loose = n.noise(spot.at, 190.0, 1.0), pressed_so(n, spot, 0.03), loose_there(n, spot)
    colour = n.mix(n.between(lumps, 0.3, 0.75, 0.0, 0.6), (0.86, 0.88, 0.91, 1.0), (0.79, 0.83, 0.88, 1.0))
    colour = n.mix(n.math("MULTIPLY", pressed, 0.55), colour, (0.62, 0.71, 0.80, 1.0))
    colour, rough, specular = _wetted(n, n.math("MULTIPLY", spot.wet, 0.3), colour, 0.75, 0.25)
    rough = n.blend(pressed, rough, 0.48)
    flat = n.math("MULTIPLY_ADD", pressed, -0.5, 1.0)
    height = n.sum(
        (n.math("MULTIPLY", flat, 0.0006), grain),
        (n.math("MULTIPLY", flat, 0.0034), lumps),
        (n.math("MULTIPLY", loose, 0.0035), crumbs),
    )
    return colour, rough, specular, n.math("MULTIPLY_ADD", pressed, -0.15, 0.45), height


def _crust(n, spot):
    """Snow under a plate of ice: it shines a little, and is cracked where it was lifted around prints."""
    colour, rough, specular, inside, height = _snow(n, spot)
    unbroken = n.between(spot.compression, 0.0005, 0.006, 1.0, 0.0)
    gap, askew = n.plates(spot.at, 0.075, 0.0036)
    lifted = n.math("MULTIPLY", n.between(spot.heap, 0.0004, 0.0022), unbroken)
    gap = n.math("MULTIPLY", gap, lifted)
    colour = n.mix(n.math("MULTIPLY", gap, 0.75), colour, (0.30, 0.40, 0.52, 1.0))
    rough, specular = n.blend(unbroken, rough, 0.42), n.blend(unbroken, specular, 0.4)
    height = n.math("MULTIPLY", height, n.math("MULTIPLY_ADD", unbroken, -0.45, 1.0))
    height = n.math("MULTIPLY_ADD", n.math("MULTIPLY", askew, lifted), 0.016, height)
    return colour, rough, specular, inside, n.math("MULTIPLY_ADD", gap, -0.009, height)


def _mud(n, spot):
    """Damp lumps; where a foot went it is stirred: wet, smooth, and what slid back in as wet as the rest."""
    lumps, fine = n.noise(spot.at, 38.0, 3.0, 0.5), n.noise(spot.at, 210.0, 2.0, 0.55)
    wide, broad = n.noise(spot.at, 2.6, 2.0), n.noise(spot.at, 24.0, 1.0)
    deep = n.between(spot.compression, 0.001, 0.010)
    stirred = n.math("MAXIMUM", deep, n.between(spot.heap, 0.0008, 0.006))
    colour = n.mix(n.between(lumps, 0.35, 0.7), (0.088, 0.054, 0.031, 1.0), (0.150, 0.098, 0.059, 1.0))
    colour = n.mix(n.between(fine, 0.55, 0.68, 0.0, 0.35), colour, (0.190, 0.130, 0.082, 1.0))
    colour = n.mix(n.between(wide, 0.4, 0.68, 0.0, 0.5), colour, (0.062, 0.039, 0.023, 1.0))
    colour = n.mix(n.math("MULTIPLY", stirred, 0.7), colour, (0.105, 0.070, 0.042, 1.0))
    # a film of water: all of it in the print, in patches on what came up beside
    film = n.math("MULTIPLY", stirred, n.between(broad, 0.40, 0.60, 0.35, 1.0))
    film = n.math("MAXIMUM", film, n.math("MULTIPLY", deep, n.between(broad, 0.30, 0.50, 0.7, 1.0)))
    wet = n.math("MAXIMUM", n.math("MAXIMUM", spot.wet, film), n.between(wide, 0.5, 0.68, 0.0, 0.6))
    colour, rough, specular = _wetted(n, wet, colour, 0.62, 0.3, 0.30)
    rough = n.blend(n.math("MULTIPLY", film, stirred), rough, 0.16)
    rough = n.math("ADD", rough, n.between(fine, 0.4, 0.7, 0.0, 0.10))
    flat = n.math("MULTIPLY_ADD", stirred, -0.90, 1.0)
    height = n.sum(
        (n.math("MULTIPLY", flat, 0.0065), lumps),
        (n.math("MULTIPLY", flat, 0.0016), fine),
        (n.math("MULTIPLY", stirred, 0.0030), broad),
    )
    return colour, rough, specular, 0.0, height


def _earth(n, spot):
    """Crumbs of dark earth, trodden flat and darker where feet went."""
    clods, crumbs = n.crumbs(spot.at, 42.0), n.crumbs(spot.at, 130.0)
    lumps, grain = n.noise(spot.at, 30.0, 4.0, 0.6), n.noise(spot.at, 420.0, 3.0, 0.65)
    wide, pressed, loose = n.noise(spot.at, 1.7, 2.0), pressed_so(n, spot, 0.005), loose_there(n, spot)
    colour = n.mix(n.between(grain, 0.3, 0.7), (0.150, 0.108, 0.070, 1.0), (0.262, 0.196, 0.132, 1.0))
    colour = n.mix(n.between(lumps, 0.35, 0.65, 0.45, 0.0), colour, (0.120, 0.084, 0.053, 1.0))
    colour = n.mix(n.between(wide, 0.4, 0.65, 0.0, 0.4), colour, (0.150, 0.112, 0.074, 1.0))
    colour = n.mix(n.math("MULTIPLY", loose, 0.5), colour, (0.120, 0.080, 0.048, 1.0))
    colour = n.mix(n.math("MULTIPLY", pressed, 0.6), colour, (0.100, 0.068, 0.042, 1.0))
    colour, rough, specular = _wetted(n, spot.wet, colour, 0.92, 0.1)
    rough = n.blend(n.math("MULTIPLY", pressed, spot.wet), rough, 0.3)
    flat = n.math("MULTIPLY_ADD", pressed, -0.8, 1.0)
    height = n.sum(
        (n.math("MULTIPLY", flat, 0.0042), lumps),
        (n.math("MULTIPLY", flat, 0.0030), clods),
        (n.math("MULTIPLY", flat, n.math("MULTIPLY_ADD", loose, 0.0018, 0.0020)), crumbs),
        (n.math("MULTIPLY_ADD", flat, 0.0009, 0.0003), grain),
    )
    return colour, rough, specular, 0.0, height


def _packed(n, spot):
    """Earth trodden hard: dust over a smooth crust with small stones, which flakes and cracks around prints."""
    grain, fine = n.noise(spot.at, 900.0, 2.0, 0.6), n.noise(spot.at, 240.0, 3.0, 0.6)
    wide, lumps, stones = n.noise(spot.at, 3.1, 3.0), n.noise(spot.at, 26.0, 3.0, 0.55), n.crumbs(spot.at, 95.0)
    pressed = n.between(spot.compression, 0.0004, 0.0025)
    rim = n.math("MAXIMUM", n.math("MULTIPLY", pressed, n.math("SUBTRACT", 1.0, pressed)), 0.0)
    beside = n.math("MULTIPLY", n.between(spot.heap, 0.00015, 0.0010), n.math("SUBTRACT", 1.0, pressed))
    strained = n.math("MAXIMUM", n.math("MULTIPLY", rim, 2.4), beside)
    gap, askew = n.plates(spot.at, 0.021, 0.0012)
    gap = n.math("MULTIPLY", gap, strained)
    stone = n.between(stones, 0.70, 0.95)
    colour = n.mix(n.between(fine, 0.3, 0.7), (0.215, 0.150, 0.096, 1.0), (0.300, 0.222, 0.150, 1.0))
    colour = n.mix(n.between(grain, 0.55, 0.75, 0.0, 0.5), colour, (0.145, 0.098, 0.062, 1.0))
    colour = n.mix(n.between(wide, 0.35, 0.7, 0.0, 0.45), colour, (0.205, 0.150, 0.102, 1.0))
    colour = n.mix(n.math("MULTIPLY", stone, 0.7), colour, (0.245, 0.205, 0.165, 1.0))
    colour = n.mix(n.math("MULTIPLY", pressed, 0.65), colour, (0.150, 0.102, 0.065, 1.0))
    colour = n.mix(n.math("MULTIPLY", gap, 0.85), colour, (0.040, 0.026, 0.016, 1.0))
    colour, rough, specular = _wetted(n, spot.wet, colour, 0.95, 0.08)
    rough, specular = n.blend(pressed, rough, 0.62), n.blend(pressed, specular, 0.25)
    flat = n.math("MULTIPLY_ADD", pressed, -0.85, 1.0)
    height = n.sum(
        (n.math("MULTIPLY", flat, 0.0016), lumps),
        (n.math("MULTIPLY", flat, 0.0008), fine),
        (n.math("MULTIPLY_ADD", flat, 0.00025, 0.0001), grain),
    )
    height = n.math("MULTIPLY_ADD", n.math("MULTIPLY", flat, stone), 0.0007, height)
    height = n.math("MULTIPLY_ADD", n.math("MULTIPLY", askew, strained), 0.0050, height)
    return colour, rough, specular, 0.0, n.math("MULTIPLY_ADD", gap, -0.0020, height)


def _grass(n, spot):
    """The floor of a meadow, seen between its stems: moss, dead leaves, low green."""
    blades, leaves = n.noise(n.vector("MULTIPLY", spot.at, (1.0, 2.6, 1.0)), 130.0, 3.0, 0.65), n.noise(spot.at, 48.0)
    wide = n.noise(spot.at, 1.3, 2.0)
    colour = n.mix(n.between(blades, 0.34, 0.66), (0.020, 0.030, 0.009, 1.0), (0.072, 0.098, 0.028, 1.0))
    colour = n.mix(n.between(leaves, 0.52, 0.64, 0.0, 0.75), colour, (0.150, 0.112, 0.058, 1.0))
    colour = n.mix(n.between(wide, 0.4, 0.66, 0.0, 0.4), colour, (0.088, 0.092, 0.034, 1.0))
    colour, rough, specular = _wetted(n, spot.wet, colour, 0.85, 0.2)
    return colour, rough, specular, 0.0, n.sum((0.0075, blades), (0.0045, leaves))


LOOKS = {  # name -> (what it is called, how it is made)
    "SAND": ("Sand", _sand),
    "SNOW": ("Snow", _snow),
    "CRUST": ("Crusted Snow", _crust),
    "MUD": ("Mud", _mud),
    "EARTH": ("Earth", _earth),
    "PACKED": ("Packed Earth", _packed),
    "GRASS": ("Grass Floor", _grass),
}
