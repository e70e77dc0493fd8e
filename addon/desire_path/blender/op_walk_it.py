"""op_walk_it.py - one button from a character to its prints.

what is selected --> characters --forward.py--> they go ahead, along a curve that is selected, too --underfoot.py-->
the meshes they tread are grounds, or one is made --op_place.py--> on a hill their feet are placed --> bake
--materials.py--> a ground without a material looks like what it is made of
"""

import re

import bpy

from ..errors import DesirePathError
from . import op_ground, op_place, op_walkers
from .chosen import grounds
from .late import (
    axes,
    bounds,
    forward,
    ground,
    importers,
    materials,
    moves,
    np,
    paths,
    place,
    recordings,
    size,
    trodden,
    underfoot,
    watch,
    worn,
)
from .messages import tell
from .ops import Refusal
from .translations import say

MARGIN = 1.0  # a ground that is made reaches this far beyond the feet, in leg lengths
CELL = 0.011  # side of a cell, in leg lengths: 1 cm for a person


def characters(objects):
    """The armatures among objects, and those that meshes among them hang on; each once, in order."""
    found = []
    for obj in objects:
        rig = rig_of(obj)
        if rig is not None and rig not in found:
            found.append(rig)
    leaders = {forward.leader(each) for each in found if forward.leader(each) != each}
    return [each for each in found if each not in leaders]


def rig_of(obj):
    """The armature an object is, wears, hangs on, or holds as its only one; None where there is none."""
    if obj.type == "ARMATURE":
        return obj
    for each in obj.modifiers:
        if each.type == "ARMATURE" and each.object is not None:
            return each.object
    above = obj.parent
    while above is not None:
        if above.type == "ARMATURE":
            return above
        above = above.parent
    if obj.type == "EMPTY":  # what importers put above a character
        below = [each for each in obj.children_recursive if each.type == "ARMATURE"]
        return below[0] if len(below) == 1 else None
    return None


def who_is_missing():
    """Why nobody can walk; where none could be imported, how to mend that, in the 200 letters that Blender keeps."""
    for kind, command in importers.own_cures():
        return say("Select a character. To import {} here, call as root: {}", kind, command)
    return say("Select a character, its armature or a mesh it wears, and a ground if there is one")


def chosen_meshes(objects, who):
    """The meshes among objects that could be walked on: what belongs to a character or walks by itself is left out."""
    shapes = {bone.custom_shape for each in who if each.pose is not None for bone in each.pose.bones}
    return [
        obj
        for obj in objects
        if obj.type == "MESH" and rig_of(obj) is None and not obj.desire_path.is_walker and obj not in shapes
    ]


def chosen_path(objects):
    """The curve to go along among objects, or None; refuses several."""
    found = [each for each in objects if each.type == "CURVE"]
    if len(found) > 1:
        names = ", ".join(f"'{each.name}'" for each in found)
        raise DesirePathError(f"The curves {names} are selected: select the one to go along.")
    return found[0] if found else None


class OBJECT_OT_desire_path_walk_it(Refusal, bpy.types.Operator):
    """Let the selected characters walk over the selected ground, or over one made for them, and show their prints"""

    bl_idname = "object.desire_path_walk_it"
    bl_label = "Walk It"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if context.mode != "OBJECT" and context.mode != "POSE":
            cls.poll_message_set("Leave Edit Mode first")
            return False
        if not characters(context.selected_objects or filter(None, [context.object])):
            cls.poll_message_set(who_is_missing())
            return False
        return True

    def work(self, context):
        posed = context.mode == "POSE"
        if posed:
            bpy.ops.object.mode_set(mode="OBJECT")
        try:
            with recordings.kept():
                sentences = self.begin(context)
        except BaseException:
            if posed:
                bpy.ops.object.mode_set(mode="POSE")
            raise
        for level, text in sentences:  # nothing is told of what was taken back
            tell(self, level, text)
        return {"FINISHED"}

    def begin(self, context):
        """Refuse what can be refused before anything is changed, and walk; returns what is to be told."""
        scene = context.scene
        there = list(context.selected_objects) or [context.object]
        who = characters(there)
        meshes = chosen_meshes(there, who) or list(filter(None, [self.known(scene, who)]))
        curve = chosen_path(there)
        line = paths.waypoints(scene, curve) if curve is not None else None
        for each in (*who, *meshes):
            if each.library is not None:
                raise DesirePathError(
                    f"'{each.name}' is linked from another file: make a library override of it (Object > Library "
                    "Override > Make) first."
                )
        for each in who:  # who has no feet is refused, too
            underfoot.upright(recordings.record(scene, each, *moves.frame_range(scene, each), samples=1))
            if not moves.has_motion(each):
                why = "it is keyed at one frame; give it an action" if moves.moves(each) else moves.why_still(each)
                raise DesirePathError(f"Nothing moves '{each.name}': {why}.")
        before = _Before(context, who, meshes)
        try:
            return self.walk(context, who, meshes, line)
        except BaseException:
            before.come_back()
            raise

    def walk(self, context, who, meshes, line):
        """Let characters walk over what they tread of some meshes; returns what is to be told."""
        scene, sentences = context.scene, []
        for each in who:
            text = forward.carry(scene, each, line)
            first, last = moves.frame_range(scene, each)
            bounds.Limits().check("frames", last - first + 1)
            sentences += [("INFO", text)] if text else []
        gaits, homes, new = [], meshes * len(who), []
        if len(meshes) != 1 or not meshes[0].desire_path.is_ground:
            gaits = [recordings.record(scene, each, *moves.frame_range(scene, each)) for each in who]
            homes, new, more = self.lands(context, who, meshes, gaits)
            sentences += more
        for each in new:
            sentences.append(("INFO", op_ground.add(scene, each)))
            each.desire_path.cell_size = cell_for(gaits)
        for each, land in zip(who, homes):
            each.desire_path.ground = land
            if each.type == "ARMATURE" and not each.desire_path.is_walker and not worn.hanging(scene, each):
                each.desire_path.tread = "lugs"  # who wears nothing has boots on
            sentences += op_walkers.add(context, each)
        for each, land in zip(who, homes):
            sentences += self.place(scene, each, land)
        self.bake(context, homes)
        if not bpy.app.background:
            for each in set(homes) & set(new):
                each.desire_path.auto_update = True  # whoever asks for one button wants no second one
        return sentences + look_like_soil(scene, [*homes, *new])

    def lands(self, context, who, meshes, gaits):
        """(the ground of each character, meshes that are to be grounds, what is to be told)"""
        scene = context.scene
        frame = min(moves.frame_range(scene, each)[0] for each in who)
        found = underfoot.choose(scene, meshes, gaits, frame, cell_for(gaits))
        sentences = [("INFO", each) for each in found.sentences]
        if found.grounds:
            return found.homes, [each for each in found.grounds if not each.desire_path.is_ground], sentences
        known = self.known(scene, who)
        if known is not None:
            return [known] * len(who), [], sentences
        new = make_ground(context, gaits)
        sentences += [("INFO", f"'{new.name}' is made to be walked on.")] if sentences else []
        return [new] * len(who), [new], sentences

    def bake(self, context, homes):
        """Bake what characters walk on: those of one walk together, those of several one after the other."""
        how = "INVOKE_DEFAULT" if not bpy.app.background else "EXEC_DEFAULT"
        context.view_layer.objects.active = homes[0]
        try:
            if len(set(homes)) > 1:
                bpy.ops.wm.desire_path_bake_all(how)
            else:
                bpy.ops.object.desire_path_bake(how, look=True)
        except RuntimeError as problem:
            raise DesirePathError(re.sub(r"^\w+: ", "", str(problem)).strip()) from None  # "Error: ", in any language

    @staticmethod
    def place(scene, armature, land):
        """Place the feet of who is carried ahead over ground that is not as level as the clip; returns what is told."""
        if not forward.is_carried(armature):
            return []
        frames = op_place.frames_of(scene, armature, land)
        gait = recordings.record(scene, armature, frames[0], frames[-1], samples=1)
        below, _, _ = trodden.under(scene, armature, land, gait, frames[0])
        if not place.carries(gait, below, 0):
            return []
        try:
            new, sentences = op_place.bake(scene, armature, land)
        except DesirePathError as problem:
            armature.desire_path.place_feet = True
            return [("WARNING", f"{problem} Its prints are pressed as if its feet were placed.")]
        forward.placed_anew(armature)
        text = f"The feet of '{armature.name}' are placed on '{land.name}': action '{new.name}'."
        return [*(("WARNING", each) for each in sentences), ("INFO", text)]

    @staticmethod
    def known(scene, who):
        """The ground that the characters walk on already."""
        found = {each.desire_path.ground for each in who} & set(grounds(scene))
        return found.pop() if len(found) == 1 else None


class _Before:
    """What Walk It changes, as it was before."""

    def __init__(self, context, who, meshes):
        self.context, self.who = context, who
        self.active, self.objects = context.object, set(bpy.data.objects)
        self.carried = [forward.is_carried(each) for each in who]
        self.walkers = [
            (each.desire_path.is_walker, each.desire_path.ground, each.desire_path.place_feet, each.desire_path.tread)
            for each in who
        ]
        self.grounds = [(each, each.desire_path.is_ground, each.desire_path.cell_size) for each in meshes]

    def come_back(self):
        for each, carried, (walks, land, placed, tread) in zip(self.who, self.carried, self.walkers):
            if forward.is_carried(each) and not carried:
                forward.switch(each, False)
            each.desire_path.is_walker, each.desire_path.ground = walks, land
            each.desire_path.place_feet, each.desire_path.tread = placed, tread
        for each, is_ground, cell in self.grounds:
            each.desire_path.is_ground, each.desire_path.cell_size = is_ground, cell
        for each in set(bpy.data.objects) - self.objects:
            if each.type == "MESH" and each.desire_path.is_ground:
                mesh = each.data
                bpy.data.objects.remove(each)
                bpy.data.meshes.remove(mesh)
        self.context.view_layer.objects.active = self.active


def look_like_soil(scene, lands):
    """Grounds that have no material get one of what they are made of; returns what is to be told."""
    sentences = []
    for each in dict.fromkeys(lands):
        if any(slot.material is not None for slot in each.material_slots):
            continue
        try:
            sentences.append(("INFO", materials.add(scene, each)))
        except DesirePathError as problem:
            sentences.append(("WARNING", str(problem)))
            continue
        watch.renew(scene, each)
    return sentences


def make_ground(context, gaits):
    """A plane under recordings, as low as their feet come."""
    scale = axes.unit_scale(context.scene)
    floor = underfoot.level(gaits)
    boxes = np.array([ground.under(each) for each in gaits])
    margin = MARGIN * max(float(size.legs(each).max()) for each in gaits)
    low, high = boxes[:, :2].min(axis=0) - margin, boxes[:, 2:].max(axis=0) + margin
    middle, half = 0.5 * (low + high) / scale, 0.5 * (high - low) / scale
    mesh = bpy.data.meshes.new("Ground")
    corners = [(x * half[0], y * half[1], 0.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="UVMap")
    new = bpy.data.objects.new("Ground", mesh)
    new.location = (*middle, floor / scale)
    context.collection.objects.link(new)
    new.select_set(True)
    context.view_layer.update()
    return new


def cell_for(gaits):
    """A round cell size that suits the smallest walker of recordings [m]: 1, 2 or 5 times a power of ten."""
    wanted = CELL * min(float(size.legs(each).min()) for each in gaits)
    power = 10.0 ** np.floor(np.log10(wanted))
    return axes.typed(
        min((step * power for step in (1.0, 2.0, 5.0, 10.0)), key=lambda cell: abs(np.log(cell / wanted)))
    )


def draw_menu(self, _context):
    self.layout.separator()
    self.layout.operator("object.desire_path_walk_it", icon="MOD_DYNAMICPAINT")


MENUS = ("VIEW3D_MT_object", "VIEW3D_MT_object_context_menu")
CLASSES = (OBJECT_OT_desire_path_walk_it,)


def register():
    for name in MENUS:
        getattr(bpy.types, name).append(draw_menu)


def unregister():
    for name in MENUS:
        getattr(bpy.types, name).remove(draw_menu)
