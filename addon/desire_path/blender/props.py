"""props.py - what a ground and a walker remember: Object.desire_path."""

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from . import arrival, compat, props_parts, props_track, soils, units
from .late import forward, live, state, watch


def is_ground(_self, obj):
    return obj.type == "MESH" and obj.desire_path.is_ground


def is_sole(_self, obj):
    return obj.type == "MESH" and not obj.desire_path.is_ground


def is_path(_self, obj):
    return obj.type in {"CURVE", "EMPTY"} or obj.type == "MESH" and not obj.desire_path.is_ground


def _arrives(self, context):
    arrival.begin()
    props_parts.changed(self, context)


def _frames_by_hand(self, _context):
    self.frames_auto = False


def _folder_by_hand(self, _context):
    self.folder_auto = False


def _is_carried(self):
    return forward.is_carried(self.id_data)


def _carry(self, on):
    forward.ask(self.id_data, on)


def _show_anew(self, _context):
    watch.mark(self.id_data)


def _switched(self, _context):
    live.switched(self.id_data)


@props_parts.followed
@props_parts.overridable
class DesirePathSettings(bpy.types.PropertyGroup):
    # ---- a ground
    is_ground: BoolProperty(name="Ground", update=_arrives, description="Walkers leave prints in this mesh")
    soil: soils.preset("What the ground is made of where nothing else is painted")
    soil_numbers: PointerProperty(
        type=soils.DesirePathSoil, name="Soil Numbers", description="The numbers of this soil, by the names of Soil"
    )
    soil_file: soils.file()
    soil_name: StringProperty(options={"HIDDEN"}, description="The soil of one's own that the numbers are from")
    cell_size: FloatProperty(
        name="Cell Size [m]",
        default=0.01,
        soft_min=0.002,
        soft_max=0.1,
        step=0.1,
        precision=4,
        description="Side of a cell of the pressed ground, in metres: smaller shows finer prints",
    )
    cell_length: units.length(
        "cell_size",
        "Cell Size",
        "Side of a cell of the pressed ground: smaller shows finer prints",
        min=0.0,
        soft_min=0.002,
        soft_max=0.1,
        precision=4,
    )
    frame_start: IntProperty(name="Start", default=1, update=_frames_by_hand, description="First frame that is baked")
    frame_end: IntProperty(name="End", default=250, update=_frames_by_hand, description="Last frame that is baked")
    frames_auto: BoolProperty(
        default=True, options={"HIDDEN"}, description="The frames follow the walkers until set by hand"
    )
    folder: StringProperty(
        name="Folder",
        subtype="DIR_PATH",
        update=_folder_by_hand,
        options=compat.RELATIVE,
        description="Where the baked frames, maps and the report are written",
    )
    folder_auto: BoolProperty(
        default=True, options={"HIDDEN"}, description="The folder follows the file until set by hand"
    )
    painted: CollectionProperty(
        type=props_parts.DesirePathPaint,
        name="Painted Soils",
        description="Soils that lie where a vertex group is painted",
    )
    painted_index: IntProperty(options={"HIDDEN"})
    layers: props_parts.layers()
    layers_index: IntProperty(options={"HIDDEN"})
    plants: CollectionProperty(
        type=props_parts.DesirePathPlants,
        name="Plants",
        description="What grows on this ground, bends under feet and wears",
    )
    plants_index: IntProperty(options={"HIDDEN"})
    plant_mesh: BoolProperty(
        name="Plant Mesh",
        description="Also bake the simulated plants as a mesh of stems, for close-ups: "
        "where feet come near, in place of the grass, and down as long as that where trodden; large files",
    )
    plant_object: PointerProperty(
        type=bpy.types.Object, options={"HIDDEN"}, description="The mesh of the simulated plants"
    )
    refine: BoolProperty(
        name="Refine",
        default=True,
        update=_show_anew,
        description="Show the prints on a copy of the mesh that is fine along the trail, so that they are seen on any "
        "mesh; the mesh itself stays as it is. Off: prints move the mesh's own points alone",
    )
    refine_size: FloatProperty(
        name="Refined Size [m]",
        default=0.0,
        min=0.0,
        soft_max=0.1,
        max=100.0,
        precision=4,
        step=0.1,
        update=_show_anew,
        description="Shortest edge of the refined copy, in metres; 0 = the cell size",
    )
    refine_length: units.length(
        "refine_size",
        "Edges",
        "Shortest edge of the refined copy; 0 = the cell size",
        min=0.0,
        soft_max=0.1,
        precision=4,
    )
    refine_pixels: FloatProperty(
        name="Refined Pixels",
        default=0.0,
        min=0.0,
        soft_max=10.0,
        max=1000.0,
        precision=1,
        update=_show_anew,
        description="Edges of the refined copy are no shorter than so many pixels of the scene's camera, as near as it "
        "comes over the baked frames; 0 = the same everywhere",
    )
    detail_size: FloatProperty(
        name="Detail Size [m]",
        default=0.0,
        min=0.0,
        soft_max=0.01,
        max=1.0,
        precision=4,
        step=0.1,
        update=_show_anew,
        description="Show crumbs, grit and frayed edges, finer than a cell, on edges so long where feet went, in "
        "metres: 0.002 for close-ups, slower to play. Nothing of them is baked; 0 = none",
    )
    vertex_group: BoolProperty(
        name="Vertex Groups",
        description="Also fill vertex groups with plant strength and "
        "compression (1 = the loose layer pressed flat), for hair and modifiers; slower to play",
    )
    auto_update: BoolProperty(
        name="Auto Update",
        update=_switched,
        description="Bake again by itself, while you go on working, once the walk, the soil, the mesh or a setting was "
        "changed; what was baked before plays until then",
    )
    attributes: BoolProperty(
        name="Attributes",
        default=True,
        description="Also write the final compression, heap, "
        "pressure and plant strength as attributes of the mesh, for materials and nodes",
    )
    law: EnumProperty(
        name="Contact",
        description="How a sole presses the ground",
        items=(
            ("sole", "Rigid sole", "A tread prints its tread, a tilted sole digs in its edge"),
            ("uniform", "Even pressure", "The same pressure under the whole sole"),
        ),
    )
    heap: EnumProperty(
        name="Rims",
        description="How displaced soil is laid around a print",
        items=(
            ("rest", "At rest", "At once in the shape it comes to rest in"),
            ("paper", "Falling off", "On the rim, falling off over its width, then sliding"),
        ),
    )
    spray: EnumProperty(
        name="Spray",
        description="What sticks to soles and wheels, and flies off them where they are moved fast",
        items=props_parts.SPRAYS,
    )
    spray_amount: FloatProperty(
        name="Amount",
        default=1.0,
        min=0.0,
        soft_max=4.0,
        max=20.0,
        precision=2,
        description="How much of it sticks, against what is usual",
    )
    spray_object: PointerProperty(
        type=bpy.types.Object, options={"HIDDEN"}, description="The points of what flies in each frame"
    )
    threads: IntProperty(
        name="Threads", min=0, max=64, default=0, description="Processors to bake with, 0 = all; the result is the same"
    )
    memory_limit: props_parts.memory_limit()
    bake_id: StringProperty(options={"HIDDEN"}, description="Whose a bake is, see home.py")
    bake_file: StringProperty(options={"HIDDEN"}, description="The file the id was given in")
    bake_seen: StringProperty(options={"HIDDEN"}, description="The same, seen from the folder")
    bake_name: StringProperty(options={"HIDDEN"}, description="The object it was given to")
    made_groups: StringProperty(options={"HIDDEN"})
    made_attributes: StringProperty(options={"HIDDEN"})
    summary: StringProperty(options={"HIDDEN"}, description="What the last bake did")
    pressed: StringProperty(options={"HIDDEN"}, description="The folder of what was pressed by hand, see pressed.py")

    # plain Python: Blender reads properties of its own while it saves and loads overrides, when nobody may look around
    @property
    def bake_state(self):
        """What has become of the bake, NONE, FRESH, OUTDATED, PARTIAL or MISSING: found anew whenever asked for."""
        return state.ask(self.id_data).state

    @property
    def missing(self):
        """The same in a sentence, which says what to do; empty where all is well."""
        return state.ask(self.id_data).text

    # ---- a walker
    is_walker: BoolProperty(name="Walker", update=_arrives, description="This armature, or rigid body, leaves prints")
    ground: PointerProperty(
        name="Ground", type=bpy.types.Object, poll=is_ground, description="The mesh this walker leaves prints in"
    )
    mass: FloatProperty(
        name="Mass [kg]",
        default=75.0,
        soft_min=1.0,
        soft_max=1000.0,
        precision=1,
        description="How heavy the walker is, in kilograms; 0 = estimated from its height",
    )
    weight: units.mass(
        "mass",
        "Mass",
        "How heavy the walker is; 0 = estimated from its height",
        keyed=True,
        min=0.0,
        soft_max=1000.0,
        precision=1,
    )
    estimated_mass: FloatProperty(options={"HIDDEN"}, description="What mass 0 came to [kg]")
    mass_center: StringProperty(
        name="Centre",
        description="A bone that begins at the body's mass centre; empty = found from the segments of the body",
    )
    sole: PointerProperty(
        name="Sole",
        type=bpy.types.Object,
        poll=is_sole,
        description="A mesh whose underside is the sole of every foot, mirrored for the other side; "
        "place it at a foot of the rest pose. Empty = the walker's own feet or shoes",
    )
    tread: EnumProperty(
        name="Tread",
        items=(
            ("plain", "Plain", "A smooth sole"),
            ("lugs", "Lugs", "Bars and blocks, as under a boot"),
            ("waves", "Waves", "Low ridges, as under a running shoe"),
        ),
        description="What built-in soles have below: those of a walker without feet or shoes of its own, or a sole",
    )
    carried: BoolProperty(
        name="Carried",
        get=_is_carried,
        set=_carry,
        description="A clip that walks in place goes ahead with the character, at the speed of its feet, by an action "
        "of its own. Off: the clip as it was",
    )
    place_feet: BoolProperty(
        name="Prints Only",
        description="Prints are pressed as if the feet were placed on the ground's "
        "slopes; the character stays as it is. Place Feet changes the character too",
    )
    path: PointerProperty(
        name="Path",
        type=bpy.types.Object,
        poll=is_path,
        description="A curve, a mesh of edges or an empty with empties: the walk's cycle is carried along it. Empty "
        "= the walker goes where its keys lead it",
    )
    passes: IntProperty(
        name="Passes", default=1, min=1, soft_max=500, max=100000, description="How often the path is walked"
    )
    back_and_forth: BoolProperty(
        name="Back and Forth", default=True, description="Every other pass goes back; else all go one way"
    )
    lateral: FloatProperty(
        name="Scatter [m]",
        default=0.1,
        min=0.0,
        soft_max=1.0,
        max=100.0,
        precision=3,
        step=1,
        description="How far passes lie beside the path, as a standard deviation in metres",
    )
    scatter: units.length(
        "lateral",
        "Scatter",
        "How far passes lie beside the path, as a standard deviation",
        min=0.0,
        soft_max=1.0,
        precision=3,
    )
    path_seed: IntProperty(name="Seed", min=0, description="Another number scatters the passes otherwise")
    load_model: EnumProperty(
        name="Load",
        description="How the weight on each foot is found",
        items=(
            ("inertia", "In Motion", "From how the body's mass centre moves: walks, runs, jumps, landings"),
            ("impulse", "Impulse", "Weight, and an impulse at every touch-down"),
        ),
    )
    limbs: EnumProperty(
        name="Limbs",
        description="Which limbs of an armature press the ground",
        items=(
            ("FEET", "Feet", "The feet that were found"),
            ("ALL", "All", "Every bone that a mesh hangs on, as of who falls; it carves, unless told otherwise"),
        ),
    )
    wade: BoolProperty(
        name="Wade",
        description="Feet go through what they sink into, as through deep snow, and push ahead what they do not clear",
    )
    contact_law: EnumProperty(
        name="Presses",
        description="How the walker presses the ground",
        items=(
            ("AUTO", "Automatic", "As the ground says; a mesh that is moved into the ground goes where it is moved to"),
            ("SOLE", "By Weight", "As a rigid sole that its weight presses"),
            ("CARVE", "Carve", "Down to where it is, whatever it weighs, and what is in its way is pushed ahead"),
            ("UNIFORM", "Even Pressure", "The same pressure everywhere under it"),
        ),
    )
    subframes: IntProperty(
        name="Subframes",
        default=1,
        min=1,
        max=16,
        description="How often the armature is looked at in a frame; between, it is interpolated",
    )
    feet: CollectionProperty(
        type=props_parts.DesirePathFoot,
        name="Feet",
        description="The bones of the walker's feet, found by Add Walker or Find Feet",
    )
    forces: StringProperty(options={"HIDDEN"}, description="What the forces of the walk came to")
    hips: StringProperty(name="Hips", description="The bone the body hangs on")

    # ---- a curve
    track: PointerProperty(
        type=props_track.DesirePathTrack, name="Track", description="What leaves a track along a curve"
    )


CLASSES = (*props_parts.CLASSES, *props_track.CLASSES, DesirePathSettings)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Object.desire_path = PointerProperty(
        name="Desire Path", type=DesirePathSettings, override={"LIBRARY_OVERRIDABLE"}
    )


def unregister():
    del bpy.types.Object.desire_path
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
