"""props_track.py - what a curve remembers that is a track: what leaves it, and how that goes along."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty

from . import props_parts, units
from .late import track

KINDS = (
    ("STAMPS", "Stamps", "Marks of one shape after the other"),
    ("WHEEL", "Wheel", "A wheel that rolls along, two, or those of a vehicle"),
    ("SOLE", "Sole", "Marks of a mesh, one after the other"),
)
STAMPS = (
    ("boot", "Boot", "A boot with lugs"),
    ("shoe", "Shoe", "A running shoe"),
    ("foot", "Bare Foot", "A bare foot"),
    ("horse-shoe", "Horseshoe", "A horse that is shod"),
    ("wolf", "Wolf", "The paw of a wolf, or of a large dog"),
    ("deer", "Deer", "The cloven hoof of a deer"),
    ("gull", "Gull", "The webbed foot of a gull"),
    ("image", "Image", "A picture of your own"),
)
SIDES = (("left", "Left", "The left foot begins"), ("right", "Right", "The right foot begins"))
TREADS = (
    ("plain", "Plain", "A smooth tyre"),
    ("blocks", "Blocks", "Rows of blocks, as on roads"),
    ("bars", "Bars", "Bars that meet in the middle, as of a tractor"),
)
VEHICLES = (
    ("none", "Wheels", "One wheel, or two, as set below"),
    ("bicycle", "Bicycle", "Two narrow tyres, one behind the other"),
    ("motorcycle", "Motorcycle", "Two tyres, one behind the other"),
    ("car", "Car", "Four wheels"),
    ("tractor", "Tractor", "Bars on its tyres, the larger behind"),
    ("truck", "Truck", "Two axles, with dual tyres behind"),
    ("lorry", "Lorry", "Three axles, with dual tyres on the two behind"),
)


def _preview(self, context):
    props_parts.changed(self, context)
    track.preview_again(self.id_data)


def _is_sole(_self, obj):
    return obj.type == "MESH" and not obj.desire_path.is_ground


def _length(label, description, **more):
    return FloatProperty(name=label, description=description, min=0.0, precision=3, step=1, update=_preview, **more)


@props_parts.followed
@props_parts.overridable
class DesirePathTrack(bpy.types.PropertyGroup):
    """What leaves a track along a curve. 0 = as is usual for the stamp, where it is said."""

    is_track: BoolProperty(name="Track", description="Marks lie along this curve")
    kind: EnumProperty(name="Leaves", items=KINDS, update=_preview, description="What leaves the track")
    stamp: EnumProperty(name="Stamp", items=STAMPS, update=_preview, description="The shape of the marks")
    image: PointerProperty(
        name="Image",
        type=bpy.types.Image,
        update=_preview,
        description="The shape of the marks, seen from above, forward is up: white is lowest, black does not touch",
    )
    image_length: _length("Length [m]", "How long the image is, in metres", default=0.3)
    image_height: _length("Height [m]", "From what is nearly black to what is white, in metres", default=0.01)
    sole: PointerProperty(
        name="Sole",
        type=bpy.types.Object,
        poll=_is_sole,
        update=_preview,
        description="A mesh whose underside leaves the marks: its own X is forward, Z is up, of a left foot",
    )
    spacing: _length("Apart [m]", "From mark to mark, in metres; 0 = as is usual")
    width: _length("Width [m]", "Between the lines of left and right marks, in metres; 0 = as is usual")
    size: FloatProperty(
        name="Size", default=1.0, min=0.01, soft_max=3.0, update=_preview, description="Times as large as usual"
    )
    scatter: FloatProperty(
        name="Size Scatter", min=0.0, max=0.5, update=_preview, description="By how much sizes differ, a share"
    )
    seed: IntProperty(name="Seed", min=0, update=_preview, description="Another number scatters the sizes otherwise")
    first: EnumProperty(name="First", items=SIDES, update=_preview, description="The foot that begins")
    depth: FloatProperty(
        name="Depth [m]",
        min=0.0,
        precision=3,
        step=1,
        description="How deep marks are, whatever presses weighs, in metres; 0 = as the weight makes them",
    )
    mass: FloatProperty(
        name="Mass [kg]",
        min=0.0,
        description="What rests on a mark, or on all wheels, in kilograms, where no depth is set; 0 = as is usual",
    )
    weight: units.mass("mass", "Mass", "What rests on a mark, or on all wheels; 0 = as is usual", min=0.0)
    speed: FloatProperty(
        name="Speed [m/s]",
        min=0.0,
        update=_preview,
        description="At the start of the curve, in metres a second; 0 = as is usual",
    )
    end_speed: FloatProperty(
        name="End [m/s]",
        min=0.0,
        update=_preview,
        description="At the end of the curve, in metres a second: steps grow with it; 0 = as at the start",
    )
    vehicle: EnumProperty(name="Vehicle", items=VEHICLES, update=_preview, description="Whose wheels roll along")
    radius: _length("Radius [m]", "Of the wheel, in metres", default=0.33)
    tyre_width: _length("Tyre [m]", "How wide the tyre is, in metres", default=0.2)
    gauge: _length("Gauge [m]", "Two wheels, so far from middle to middle, in metres; 0 = one wheel")
    tread: EnumProperty(name="Tread", items=TREADS, default="blocks", description="What the tyre carries")
    marks: PointerProperty(
        type=bpy.types.Object, options={"HIDDEN"}, description="The object that shows where marks will lie"
    )


CLASSES = (DesirePathTrack,)
