"""ops.py - what operators have in common: sentences where they refuse, and when they can be pressed."""

import bpy

from ..errors import DesirePathError
from .late import playback
from .messages import tell
from .translations import say

before = []  # called before an operator of ours does its work; arrival.py is the first


def begins():
    """An operator of ours begins its work."""
    for each in before:  # those that come by the first are called, too
        each()


class Refusal:
    """Operators that tell what is wrong in one sentence."""

    def execute(self, context):
        begins()
        try:
            return self.work(context)
        except (DesirePathError, OSError, MemoryError) as problem:
            tell(self, "ERROR", sentence(problem))
            return {"CANCELLED"}


class TakenOff(Refusal):
    """Operators that let an armature that walks play its action otherwise, or, with *Take Off*, as before."""

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"ARMATURE"}, "the armature that walks")

    def work(self, context):
        obj = context.object
        context.view_layer.update()
        if self.remove:
            tell(self, "INFO", f"'{obj.name}' plays '{self.take_off(obj)}' again.")
            return {"FINISHED"}
        land = obj.desire_path.ground
        if land is None:
            raise DesirePathError(f"'{obj.name}' walks on no ground yet: press Add Walker, or choose its ground.")
        warnings, said = self.change(context.scene, obj, land)
        for each in warnings:
            tell(self, "WARNING", each)
        tell(self, "INFO", said)
        return {"FINISHED"}


class AsksFirst:
    """Operators that give up the bake of the active ground: in a window they ask."""

    def invoke(self, context, event):
        obj = context.object
        if bpy.app.background or context.window is None or obj.type != "MESH" or playback.modifier(obj) is None:
            return self.execute(context)
        ask = context.window_manager.invoke_confirm
        words = {
            "title": say("Free the bake of '{}'?", obj.name),
            "confirm_text": say("Free"),
            "message": say("Undo brings it back until the file is saved or closed."),
        }
        known = bpy.types.WindowManager.bl_rna.functions["invoke_confirm"].parameters
        return ask(self, event, **{name: text for name, text in words.items() if name in known})


def sentence(problem):
    if isinstance(problem, MemoryError):
        return "There is not enough memory: choose a larger cell size or fewer frames."
    return str(problem)


def active(cls, context, kind, words, *, changed=True):
    """Whether the active object is of a type (or of several), not being edited and, where it will be changed, of this
    file; else poll's message."""
    obj = context.object
    if obj is None or obj.type not in kind:
        cls.poll_message_set(f"Select {words} first")
        return False
    if obj.mode == "EDIT":
        cls.poll_message_set("Leave Edit Mode first")
        return False
    if changed and obj.library is not None:
        cls.poll_message_set(
            say(
                "'{}' is linked from another file: make a library override of it (Object > Library Override > Make), "
                "or open that file",
                obj.name,
            )
        )
        return False
    return True


def chosen_in(settings, items):
    """The place of the item that is chosen in a list of a ground (`painted`, `layers` or `plants`), 0 without any."""
    place = max(0, min(getattr(settings, f"{items}_index"), len(getattr(settings, items)) - 1))
    setattr(settings, f"{items}_index", place)
    return place


def take_off(settings, items):
    """Remove the chosen item of such a list; the one after it is chosen, or the last."""
    getattr(settings, items).remove(chosen_in(settings, items))
    chosen_in(settings, items)
