"""plain.py - presets without what is for looks alone: the numbers of the papers, to be reckoned with by hand."""

from dataclasses import fields, replace

from desire_path.ground.soil import SOILS, Soil, as_soil

LOOKS = ("wall_angle", "roughness", "rebound", "heave", "flow_time")


def plain(soil):
    """A soil or a preset whose walls stand, alike everywhere, that does not spring back and lies in cones at once."""
    usual = {each.name: each.default for each in fields(Soil)}
    return replace(as_soil(soil), **{name: usual[name] for name in LOOKS})


def all_plain():
    """Every preset so, by name."""
    return {name: plain(name) for name in SOILS}
