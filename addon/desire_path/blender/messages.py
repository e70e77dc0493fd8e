"""messages.py - what was told in this session, kept to be copied: a report is gone from the screen in seconds."""

import time
from collections import deque

import bpy

from ..version import VERSION
from .late import platform, sentences

MAX_KEPT = 500  # messages that are kept
NAME = "Desire Path Messages"  # of the text that holds them

_kept = deque(maxlen=MAX_KEPT)  # (time, level, sentence)


def add(level, sentence):
    """Keep a sentence. level: "ERROR", "WARNING" or "INFO" """
    _kept.append((time.strftime("%Y-%m-%d %H:%M:%S"), level, sentence))


def tell(operator, level, sentence):
    """Keep a sentence, and let an operator report it in the language of the interface."""
    add(level, sentence)
    operator.report({level}, sentences.translated(sentence))


def text(obj=None):
    """All of them, with what is needed to make sense of them, and how the bake of a ground is."""
    lines = [f"Desire Path {VERSION}, Blender {bpy.app.version_string}, {platform.system()} {platform.machine()}"]
    if obj is not None and obj.type == "MESH" and obj.desire_path.is_ground:
        settings = obj.desire_path
        lines += [f"'{obj.name}': {settings.bake_state}. {settings.missing}".rstrip(), settings.summary]
    lines += [f"{when}  {level:7}  {sentence}" for when, level, sentence in _kept]
    return "\n".join(filter(None, lines)) + "\n"


class WM_OT_desire_path_messages_copy(bpy.types.Operator):
    """Copy all messages of this session, and the state of the active ground's bake, to the clipboard and into a text"""

    bl_idname = "wm.desire_path_messages_copy"
    bl_label = "Copy Messages"
    bl_options = {"REGISTER"}

    def execute(self, context):
        found = text(context.object)
        there = bpy.data.texts.get(NAME) or bpy.data.texts.new(NAME)
        there.clear()
        there.write(found)
        context.window_manager.clipboard = found
        tell(self, "INFO", f"The messages are in the clipboard and in the text '{NAME}'.")
        return {"FINISHED"}


CLASSES = (WM_OT_desire_path_messages_copy,)
