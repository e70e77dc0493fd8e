"""props_parts.py - parts of what a ground and a walker remember: a painted soil, a layer, plants of a kind, a foot."""

import bpy
from bpy.props import CollectionProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import compat, pictured, soils, units
from .compat import WORDS
from .late import kinds, picture, replant, state

SPRAYS = (
    ("NONE", "No Spray", "Nothing sticks"),
    ("SAND", "Sand", "Dry grains, which come off at once"),
    ("MUD", "Mud", "Lumps that hold on, and fly off what turns or swings fast"),
    ("SNOW", "Snow", "Light flakes, which the air slows down"),
)


def _foot_by_hand(self, _context):
    self.thigh = self.shank = ""  # the leg above another foot is another leg


def overridable(group):
    """Let a library override of an object change what it remembers, and keep it; its words are ours."""
    for each in group.__annotations__.values():
        inserts = {"USE_INSERTION"} if each.function is CollectionProperty else set()
        each.keywords["override"] = {"LIBRARY_OVERRIDABLE"} | inserts
        if compat.CONTEXTS:
            each.keywords["translation_context"] = WORDS
    return group


def changed(_self, _context):
    state.doubt()


def memory_limit():
    return FloatProperty(
        name="Memory Limit [GB]",
        default=0.0,
        min=0.0,
        soft_max=64.0,
        precision=1,
        description="Memory that Blender may take while it bakes, 0 = all there is: what does not fit waits in the "
        "bake's folder, and the result is the same",
    )


def followed(group):
    """Let what is set of a group count as a change, as what is moved in the scene does."""
    for each in group.__annotations__.values():
        hidden = "HIDDEN" in each.keywords.get("options", ()) or "get" in each.keywords
        if not hidden and each.function is not CollectionProperty and not compat.is_group(each):
            each.keywords.setdefault("update", changed)
    return group


@followed
@overridable
class DesirePathPaint(bpy.types.PropertyGroup):
    """A soil painted by a vertex group."""

    vertex_group: StringProperty(name="Vertex Group", description="Where this soil lies: weights above one half")
    soil: soils.preset("The soil that lies where the group is painted")
    soil_numbers: PointerProperty(
        type=soils.DesirePathSoil, name="Soil Numbers", description="The numbers of this soil, by the names of Soil"
    )
    soil_file: soils.file()
    soil_name: StringProperty(options={"HIDDEN"}, description="The soil of one's own that the numbers are from")


@followed
@overridable
class DesirePathLayer(bpy.types.PropertyGroup):
    """A soil that lies on the ground, thick or thin."""

    soil: soils.preset("What this layer is made of")
    soil_numbers: PointerProperty(
        type=soils.DesirePathSoil, name="Soil Numbers", description="The numbers of this soil, by the names of Soil"
    )
    soil_file: soils.file()
    soil_name: StringProperty(options={"HIDDEN"}, description="The soil of one's own that the numbers are from")
    thickness: FloatProperty(
        name="Thickness [m]", default=0.03, precision=4, step=0.1, description="How thick it lies, in metres"
    )
    thickness_length: units.length(
        "thickness", "Thickness", "How thick it lies", min=0.0, soft_min=0.001, soft_max=1.0, precision=4
    )
    group: StringProperty(
        name="Group",
        description="A vertex group that scales the thickness: 1 = all of it, 0 = it does not lie there. Empty = it "
        "lies everywhere",
    )


def layers():
    return CollectionProperty(
        type=DesirePathLayer,
        name="Layers",
        description="Soils that lie on the ground's own, from the top down: snow on earth, mud on a road",
    )


def plant_kinds(_self, _context, _text):
    return list(kinds.KINDS)


def _is_still(_self, image):
    return picture.is_still(_self, image)


def _replant(self, context):
    replant.changed(self.id_data)


@followed
@overridable
class DesirePathPlants(bpy.types.PropertyGroup):
    """Plants of one kind that grow on a ground."""

    kind: StringProperty(
        name="Kind",
        default="carex",
        search=plant_kinds,
        search_options={"SUGGESTION"},
        update=_replant,
        description="A kind of plant, or a .json file in which a kind was saved",
    )
    pictured: pictured.choice()
    density: FloatProperty(
        name="Density [1/m2]",
        default=80.0,
        min=0.001,
        soft_max=1000.0,
        max=5e4,
        precision=1,
        step=100,
        update=_replant,
        description="How many plants grow on a square metre where the group is 1",
    )
    density_group: StringProperty(
        name="Density Group",
        update=_replant,
        description="A vertex group or float attribute that thins "
        "the plants out: 1 = all of them, 0 = none. Empty = they grow everywhere",
    )
    density_image: PointerProperty(
        name="Density Image",
        type=bpy.types.Image,
        poll=_is_still,
        update=_replant,
        description="An image that thins the plants out, times the group if both are set: white = all of them, black = "
        "none, by the brightness of its pixels as they are stored. It lies on the ground by the active UV map; where "
        "there is none, it is stretched over the ground's bounding rectangle seen from above. Update Plants takes over "
        "what was painted since",
    )
    seed: IntProperty(name="Seed", min=0, update=_replant, description="Another number puts every plant somewhere else")
    count: IntProperty(options={"HIDDEN"}, description="How many plants there are")
    mark: StringProperty(options={"HIDDEN"}, description="What the roots were placed for")
    grass: PointerProperty(
        name="Grass",
        type=bpy.types.Object,
        description="The object that shows these plants; empty = they are not shown",
    )


@followed
@overridable
class DesirePathFoot(bpy.types.PropertyGroup):
    """The bones of one foot."""

    limb: StringProperty(name="Limb", description="Which foot this is")
    foot: StringProperty(name="Foot", update=_foot_by_hand, description="The bone that begins at the ankle")
    toe: StringProperty(
        name="Toe", description="The bone that begins at the ball of the foot; empty where the rig has none"
    )
    heel: StringProperty(name="Heel", description="A bone that lies at the heel, if there is one")
    thigh: StringProperty(
        name="Thigh",
        description="The bone that begins at the hip of this leg; with neither "
        "thigh nor shank both are found above the foot",
    )
    shank: StringProperty(name="Shank", description="The bone that begins at the knee of this leg")


overridable(soils.DesirePathSoil)
CLASSES = (soils.DesirePathSoil, DesirePathPaint, DesirePathLayer, DesirePathPlants, DesirePathFoot)
