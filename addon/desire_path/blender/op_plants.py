"""op_plants.py - plants are put on a ground and taken off it."""

import bpy
from bpy.props import BoolProperty, FloatProperty, StringProperty

from ..errors import DesirePathError
from . import props_parts
from .late import bake_job, picture, plants, replant, show
from .messages import tell
from .ops import Refusal, chosen_in, take_off


class _OfGround(Refusal):
    @classmethod
    def poll(cls, context):
        if not bake_job.idle_ground(cls, context):
            return False
        if not context.object.desire_path.is_ground:
            cls.poll_message_set("Press Add Ground first")
            return False
        return True


def _images(_self, _context, _text):
    return [image.name for image in bpy.data.images if picture.is_still(None, image)]


class OBJECT_OT_desire_path_plants_add(_OfGround, bpy.types.Operator):
    """Let plants grow on the active ground: they bend under the walkers, wear, and hold the soil"""

    bl_idname = "object.desire_path_plants_add"
    bl_label = "Add Plants"
    bl_options = {"REGISTER", "UNDO"}

    kind: StringProperty(
        name="Kind",
        default="carex",
        search=props_parts.plant_kinds,
        search_options={"SUGGESTION"},
        description="A kind of plant, or a .json file in which a kind was saved",
    )
    density: FloatProperty(
        name="Density [1/m2]",
        min=0.0,
        max=5e4,
        description="Plants on a square metre where the group is 1; 0 = as dense as the kind usually stands",
    )
    density_group: StringProperty(
        name="Density Group",
        description="A vertex group or float attribute that thins the plants out; empty = they grow everywhere",
    )
    density_image: StringProperty(
        name="Density Image",
        search=_images,
        description="Name of an image that thins the plants out, white = all of "
        "them; by the active UV map, else stretched over the ground seen from above; empty = none",
    )
    grass: BoolProperty(name="Grass", default=True, description="Make an object that shows the plants")

    def work(self, context):
        obj, scene = context.object, context.scene
        context.view_layer.update()
        its, image = plants.kind(self.kind), picture.named(self.density_image)
        settings = obj.desire_path
        each = settings.plants.add()
        try:
            with replant.quietly():
                each.kind, each.density_group, each.density_image = self.kind, self.density_group, image
                each.density, each.seed = self.density or its.density, len(settings.plants) - 1
            if self.grass:
                each.grass = plants.grass.make(obj, self.kind)
            sentences = plants.plant(scene, obj, [each])
        except DesirePathError:
            plants.forget(each)
            settings.plants.remove(len(settings.plants) - 1)
            raise
        settings.plants_index = len(settings.plants) - 1
        for sentence in sentences:
            tell(self, "WARNING", sentence)
        tell(self, "INFO", f"{each.count} plants of {self.kind} grow on '{obj.name}'.")
        return {"FINISHED"}


class OBJECT_OT_desire_path_grass_add(_OfGround, bpy.types.Operator):
    """Make an object that shows the chosen plants as grass"""

    bl_idname = "object.desire_path_grass_add"
    bl_label = "Show Grass"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(context.object.desire_path.plants)

    def work(self, context):
        obj = context.object
        context.view_layer.update()
        settings = obj.desire_path
        each = settings.plants[chosen_in(settings, "plants")]
        if plants.shown(each) is not None:
            raise DesirePathError(f"The {each.kind} on '{obj.name}' is shown already, by '{each.grass.name}'.")
        plants.forget(each)
        each.grass = plants.grass.make(obj, each.kind)
        plants.plant(context.scene, obj, [each])
        show.show_plants(obj)
        return {"FINISHED"}


class OBJECT_OT_desire_path_plants_update(_OfGround, bpy.types.Operator):
    """Put the plants of the active ground anew, after its mesh, a density group or a density image was changed"""

    bl_idname = "object.desire_path_plants_update"
    bl_label = "Update Plants"
    bl_options = {"REGISTER", "UNDO"}

    def work(self, context):
        obj = context.object
        context.view_layer.update()
        for sentence in plants.plant(context.scene, obj):
            tell(self, "WARNING", sentence)
        show.show_plants(obj)
        return {"FINISHED"}


class OBJECT_OT_desire_path_plants_remove(_OfGround, bpy.types.Operator):
    """Take the chosen plants off the ground, with the grass that shows them; the vertex group stays"""

    bl_idname = "object.desire_path_plants_remove"
    bl_label = "Remove Plants"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(context.object.desire_path.plants)

    def work(self, context):
        settings = context.object.desire_path
        plants.forget(settings.plants[chosen_in(settings, "plants")])
        take_off(settings, "plants")
        return {"FINISHED"}


CLASSES = (
    OBJECT_OT_desire_path_plants_add,
    OBJECT_OT_desire_path_grass_add,
    OBJECT_OT_desire_path_plants_update,
    OBJECT_OT_desire_path_plants_remove,
)
