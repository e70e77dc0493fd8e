"""soils.py - the soil a ground is made of: a preset, numbers of one's own, or a file of them.

    soil_file, if one is set; else soil_numbers, where one was changed by hand; else the preset `soil`

A preset that is chosen is shown by its numbers, which begin anew then. EASY has words of people for them, WORDS the
numbers themselves with their units.
"""

import math
from dataclasses import replace

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from ..errors import DesirePathError
from ..ground.soil import BY_DEPTH, NUMBERS, SOILS, Soil
from . import compat, units
from .compat import prop
from .late import axes
from .messages import tell

# what people call a number, and what it is
WORDS = {
    "layer_depth": ("Depth [m]", "How thick the soft soil lies over rigid ground, in metres"),
    "young_modulus": ("Stiff [Pa]", "How hard it resists, in pascal: half of it, prints twice as deep"),
    "poisson_ratio": ("Rim Share", "How much of what is pressed is pushed aside: 0 nothing, 0.5 all of it"),
    "settle_time": ("Yields In [s]", "How long it takes to give way, in seconds"),
    "rest_angle": ("Slope", "Loose soil that is steeper slides"),
    "push_threshold": (
        "Push [N]",
        "A sideways push this strong leaves the rim on one side alone, in newtons; 0 = half the walker's weight",
    ),
    "shear_modulus": ("Shear [m]", "How far it shears before it carries sideways, in metres; 0 = no slip"),
    "wall_angle": ("Max Wall", "Firm walls of prints that are steeper come loose and slide; 90 degrees = all stand"),
    "roughness": ("Ragged", "By how much walls, slopes and rims differ from place to place; 0 = as from a mould"),
    "grain_size": ("Lumps [m]", "How far apart places are that differ, in metres"),
    "rebound": ("Spring Back", "Share of a print's depth that comes back when the foot lifts"),
    "heave": ("Bulge [m]", "How wide it bulges around a print, in metres; 0 = loose soil in a heap"),
    "flow_time": ("Slides In [s]", "How long what slides takes for 10 cm, in seconds; 0 = it comes to rest at once"),
    "crust_depth": ("Crust [m]", "How thick a crust lies on top, in metres; 0 = none"),
    "crust_strength": (
        "Breaks At [Pa]",
        "What bending the crust bears before it breaks into pieces, in pascal; 0 = none",
    ),
    "wetness": ("Wetness", "How full of water it is: damp walls stand, soaked ones slide; 0 = dry, 1 = it flows"),
    "snow_density": (
        "Snow [kg/m³]",
        "How heavy a cubic metre of this snow is, which packs under feet: 100 powder, 350 by wind; 0 = no snow",
    ),
    "bekker_friction": (
        "Bekker Friction",
        "Bekker's k_phi of ground that was measured, in N/m^(n+2), in place of its stiffness; 0 = none",
    ),
    "bekker_cohesion": ("Bekker Cohesion", "Bekker's k_c of ground that was measured, in N/m^(n+1); 0 = none"),
    "bekker_power": ("Bekker Power", "Bekker's n: how sinkage grows with pressure"),
    "clod_size": ("Clods [m]", "How large the crumbs of its rims are at most, in metres; 0 = as usual for its kind"),
    "adhesion": ("Sticks [m]", "How thick it sticks to a sole or wheel that lifts, in metres; 0 = not at all"),
    "release_pressure": (
        "Off At [Pa]",
        "Pressure under which most of what sticks comes off on other ground, in pascal: more carries it farther",
    ),
    "water_depth": (
        "Water [m]",
        "How deep below the ground water stands, which shows in deeper prints, in metres; 0 = none",
    ),
    "flow_shear": (
        "Holds For [m]",
        "How far a sole may slide before soil flows off ahead of it, in metres: before, it shears along; 0 = at once",
    ),
}
FINE = {  # lengths that are often millimetres
    "layer_depth",
    "shear_modulus",
    "settle_time",
    "grain_size",
    "heave",
    "crust_depth",
    "clod_size",
    "adhesion",
    "water_depth",
    "flow_shear",
}
HARD, SOFT = 7.4, 5.0  # powers of ten of the stiffness that Softness 0 and 1 stand for [Pa]
WEAK, STRONG = 1e4, 1e7  # bending that a crust breaks at, of Crust Bears 0 and 1 [Pa]
LOOSE = math.pi / 2  # walls that stand at this angle do not crumble [rad]


def _soften(self, value):
    self.young_modulus = axes.typed(10.0 ** (HARD + value * (SOFT - HARD)))


def _raise_rim(self, value):
    self.poisson_ratio = axes.typed(0.5 * value)


def _crumble(self, value):
    self.wall_angle = max(LOOSE * (1.0 - value), NUMBERS["wall_angle"].low)


def _strengthen(self, value):
    self.crust_strength = axes.typed(WEAK * (STRONG / WEAK) ** value) if value > 0.0 else 0.0


# numbers as people say them, each a property of its own or one of WORDS, in the order of the panel
EASY = {
    "softness": units.share(
        lambda self: (HARD - math.log10(self.young_modulus)) / (HARD - SOFT),
        _soften,
        "Softness",
        "0 like a trodden path, 1 like powder: each tenth more, prints three quarters deeper",
    ),
    "loose_layer": units.length(
        "layer_depth",
        "Loose Layer",
        "How thick the soft soil lies over rigid ground",
        min=0.0,
        soft_max=1.0,
        precision=3,
    ),
    "rim": units.share(
        lambda self: self.poisson_ratio / 0.5,
        _raise_rim,
        "Rim",
        "How much of what is pressed is pushed aside: 0 nothing, 1 all of it",
    ),
    "wetness": None,
    "rest_angle": None,
    "crumble": units.share(
        lambda self: 1.0 - self.wall_angle / LOOSE,
        _crumble,
        "Crumble",
        "How soon walls of prints come loose and slide: 0 = all stand",
    ),
    "rebound": None,
    "bulge": units.length(
        "heave",
        "Bulge",
        "How wide it bulges around a print; 0 = loose soil in a heap",
        min=0.0,
        soft_max=0.5,
        precision=3,
    ),
    "crust": units.length(
        "crust_depth",
        "Crust",
        "How thick a crust lies on top, which carries until it breaks into pieces; 0 = none",
        min=0.0,
        soft_max=0.1,
        precision=4,
    ),
    "crust_bears": units.share(
        lambda self: math.log10(max(self.crust_strength, WEAK) / WEAK) / math.log10(STRONG / WEAK),
        _strengthen,
        "Crust Bears",
        "0 = it breaks under anything, 0.4 = under a person where it is 2 cm thick, 1 = like ice",
    ),
    "roughness": None,
    "lump_size": units.length(
        "grain_size", "Lumps", "How far apart places are that differ", min=0.0, soft_max=0.1, precision=4
    ),
    "clods": units.length(
        "clod_size",
        "Clods",
        "How large the crumbs of its rims are at most, where details are shown; 0 = as usual for its kind",
        min=0.0,
        soft_max=0.1,
        precision=4,
    ),
    "water": units.length(
        "water_depth",
        "Water",
        "How deep below the ground water stands: it fills deeper prints up to there; 0 = none",
        min=0.0,
        soft_max=0.3,
        precision=4,
    ),
    "sticks": units.length(
        "adhesion",
        "Sticks",
        "How thick it sticks to a sole or wheel that lifts, to be left along the way; 0 = not at all",
        min=0.0,
        soft_max=0.02,
        precision=4,
    ),
    "settle_time": None,
    "slip": units.length(
        "shear_modulus",
        "Slip",
        "How far soles shear it before it carries sideways; 0 = they do not slip",
        min=0.0,
        soft_max=0.1,
        precision=4,
    ),
}
for _word in filter(None, EASY.values()):
    _word.keywords["options"] = {"ANIMATABLE"}  # keys: soil_keys.py
_filling = False


DESCRIBED = "{} MPa, stays at slopes up to {} degrees, yields in {} s"


def described(soil, words):
    """A soil in a sentence. words: DESCRIBED, in any language"""
    return words.format(
        f"{soil.young_modulus / 1e6:.3g}", f"{math.degrees(soil.rest_angle):.0f}", f"{soil.settle_time:.2g}"
    )


def items():
    """The presets for an EnumProperty, the softest first; their numbers, which files keep, are those of SOILS."""
    return tuple(
        (name, name.replace("-", " ").capitalize(), described(soil, DESCRIBED), list(SOILS).index(name))
        for name, soil in ((name, SOILS[name]) for name in BY_DEPTH)
    )


USUAL = "dry-sand"
ITEMS = items()


def chosen(self, _context):
    """Another preset: its numbers are shown, and those of one's own are gone."""
    self.soil_file = self.soil_name = ""
    fill(self)


def preset(description):
    return EnumProperty(name="Soil", description=description, items=ITEMS, default=USUAL, update=chosen)


def file():
    return StringProperty(
        name="Soil File",
        subtype="FILE_PATH",
        options=compat.RELATIVE,
        description="A .json file in which a soil was saved, in place of the preset and the numbers; empty = none",
    )


def _by_hand(self, _context):
    if not _filling:
        self.changed = True


def _number(name):
    label, words = WORDS[name]
    of = NUMBERS[name]
    return FloatProperty(
        name=label,
        description=words,
        default=getattr(SOILS[USUAL], name),
        min=of.low,
        max=of.high,
        precision=4 if name in FINE else 2,
        step=1,
        subtype="ANGLE" if name.endswith("_angle") else "NONE",
        update=_by_hand,
    )


class DesirePathSoil(bpy.types.PropertyGroup):
    """The numbers of a soil, by the names of Soil."""

    changed: BoolProperty(options={"HIDDEN"}, description="Whether a number was changed since the preset was chosen")


DesirePathSoil.__annotations__.update({name: _number(name) for name in WORDS})
DesirePathSoil.__annotations__.update({name: shown for name, shown in EASY.items() if shown is not None})


def fill(settings):
    """Show the numbers of the preset."""
    global _filling
    _filling = True
    try:
        for name in WORDS:
            setattr(settings.soil_numbers, name, getattr(SOILS[settings.soil], name))
        settings.soil_numbers.changed = False
    finally:
        _filling = False


def take(settings, soil):
    """Take the numbers of a Soil for one's own."""
    settings.soil_file = ""
    for name in WORDS:
        setattr(settings.soil_numbers, name, getattr(soil, name))
    settings.soil_numbers.changed = True


def refill(obj):
    """The same for a ground of a file that does not hold them, as those of earlier versions, or holds another's."""
    for each in (obj.desire_path, *obj.desire_path.painted, *obj.desire_path.layers):
        numbers, usual = each.soil_numbers, SOILS[each.soil]
        shown = all(axes.typed(getattr(numbers, name)) == axes.typed(getattr(usual, name)) for name in WORDS)
        if not numbers.changed and not shown:
            fill(each)


def soil_of(settings):
    """The Soil that a ground's settings, or a painted soil's, come to."""
    if settings.soil_file:
        return Soil.load(bpy.path.abspath(settings.soil_file))
    usual = SOILS[settings.soil]
    if not settings.soil_numbers.changed:
        return usual
    return with_numbers(settings, usual, {name: getattr(settings.soil_numbers, name) for name in WORDS})


def with_numbers(settings, soil, numbers):
    """A Soil with some numbers, by name, as properties hold them."""
    # what was set to the preset's own number is that, to the last bit: library overrides set all of them on reading
    usual = SOILS[settings.soil]
    kept = {name: getattr(usual, name) for name in numbers}
    numbers = {name: axes.typed(each) for name, each in numbers.items()}
    numbers = {name: kept[name] if axes.typed(kept[name]) == each else each for name, each in numbers.items()}
    return replace(soil, **numbers)


class OBJECT_OT_desire_path_soil_save(bpy.types.Operator, ExportHelper):
    """Save the soil of the active ground as a file, for other grounds, scripts and people"""

    bl_idname = "object.desire_path_soil_save"
    bl_label = "Save Soil"
    bl_options = {"REGISTER"}

    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        obj = context.object
        if obj is None or obj.type != "MESH" or not obj.desire_path.is_ground:
            cls.poll_message_set("Select a ground first")
            return False
        return True

    def execute(self, context):
        try:
            soil_of(context.object.desire_path).save(bpy.path.abspath(self.filepath))
        except (DesirePathError, OSError) as problem:
            tell(self, "ERROR", str(problem))
            return {"CANCELLED"}
        tell(self, "INFO", f"The soil is saved as {self.filepath}.")
        return {"FINISHED"}


def draw(layout, settings, save=True):
    """A soil as people describe it."""
    column = layout.column()
    prop(column, settings, "soil_file")
    if settings.soil_file:
        return
    for name in EASY:
        prop(column, settings.soil_numbers, name)
    if settings.soil_numbers.changed:
        word = settings.soil.replace("-", " ").capitalize()
        translate = bpy.app.translations.pgettext_iface
        column.label(text=translate("Changed from {}").format(translate(word)), icon="GREASEPENCIL")
    if save:
        column.operator("object.desire_path_soil_save", icon="EXPORT")


def draw_numbers(layout, settings):
    """The physical numbers of a soil, with their units."""
    column = layout.column()
    column.use_property_split = False  # their words need the width of the panel
    column.active = not settings.soil_file
    for name in WORDS:
        if name not in EASY:  # those are said above
            prop(column, settings.soil_numbers, name)


CLASSES = (OBJECT_OT_desire_path_soil_save,)
