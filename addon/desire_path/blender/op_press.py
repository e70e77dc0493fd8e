"""op_press.py - Press: objects are taken in hand and pressed into a ground, which shows it at once.

    the mouse, the animation that plays --press.py--> the ground answers      Enter keeps, ESC drops, Ctrl Z undoes
With a window it is a tool; `execute` presses the objects once where they stand, and keeps that.
"""

import math

import bpy
from bpy.app.handlers import persistent
from bpy.props import EnumProperty, FloatProperty
from bpy_extras import view3d_utils

from ..errors import DesirePathError
from .late import bake_job, live, np, press, sentences, state, timeline
from .messages import tell
from .ops import Refusal, begins, sentence

TICK = 0.04  # between two looks at what moves by itself [s]
DEEPER = 1.15  # a notch of the wheel
DEEPER_BY = {"WHEELDOWNMOUSE": 1, "PAGE_DOWN": 1, "WHEELUPMOUSE": -1, "PAGE_UP": -1}
TURN = math.radians(15.0)
ALONG = 512  # places looked at along the mouse's ray
KEYS = (
    "LMB: press    Wheel, PageUp/Down: {}    Shift Wheel: turn    F: follow the animation    Ctrl Z: undo stroke    "
    "Enter: keep    ESC: drop"
)
STOPS = ("undo_pre", "redo_pre", "save_pre", "load_pre")
_running = None  # the operator that is at work


def running():
    """Whether something is pressed by hand now."""
    return _running is not None


class OBJECT_OT_desire_path_press(Refusal, bpy.types.Operator):
    """Take the selected objects in hand and press them into the selected ground, or into the widest selected mesh"""

    bl_idname = "object.desire_path_press"
    bl_label = "Press"
    bl_options = {"UNDO"}

    depth: FloatProperty(
        name="Depth",
        min=0.0,
        soft_max=1.0,
        subtype="DISTANCE",
        options={"SKIP_SAVE"},
        description="How deep they are pressed; 0 = a fifth of their height",
    )
    mass: FloatProperty(
        name="Mass [kg]",
        min=-1.0,
        soft_max=1000.0,
        default=-1.0,
        options={"SKIP_SAVE"},
        description="What each weighs, in kilograms: it sinks until the ground carries it. 0 = the ground gives way to "
        "its shape; -1 = what a rigid body or walker weighs, else 0",
    )

    @classmethod
    def poll(cls, context):
        if context.mode != "OBJECT":
            cls.poll_message_set("Leave Edit Mode first")
            return False
        if running() or bake_job.running() is not None:
            cls.poll_message_set("A bake is running, or something is pressed already")
            return False
        if not context.selected_objects:
            cls.poll_message_set("Select a ground, and beside it the objects to press into it")
            return False
        return True

    def make(self, context):
        obj, bodies = press.choose(context)
        depth = self.depth * press.axes.unit_scale(context.scene)
        return press.Press(context, obj, bodies, depth=depth or None, mass=None if self.mass < 0.0 else self.mass)

    def work(self, context):
        hand = self.make(context)
        try:
            hand.follow()
            if not hand.live.strokes:
                raise DesirePathError("What is selected touches no ground: move it down into the ground first.")
            text = hand.keep()
        except BaseException:
            hand.drop()
            raise
        self.tell(hand, text)
        return {"FINISHED"}

    def tell(self, hand, text):
        for each in dict.fromkeys(hand.sentences):
            tell(self, "INFO", each)
        tell(self, "INFO", text)

    # ---- the tool --------------------------------------------------------------------------------

    def invoke(self, context, event):
        global _running
        if bpy.app.background or context.window is None:
            return self.execute(context)
        begins()
        try:
            self.hand = self.make(context)
        except (DesirePathError, OSError, MemoryError) as problem:
            tell(self, "ERROR", sentence(problem))
            return {"CANCELLED"}
        self.turn, self.place, self.down, self.follows, self.wanted = 0.0, None, False, False, ""
        self.timer = context.window_manager.event_timer_add(TICK, window=context.window)
        context.window_manager.modal_handler_add(self)
        _running, state.at_hand = self, True
        for name in STOPS:
            getattr(bpy.app.handlers, name).append(_stop)
        self.under(context, event)
        self.status(context)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        try:
            return self.event(context, event)
        except (DesirePathError, OSError, MemoryError, ReferenceError) as problem:
            tell(self, "ERROR", sentence(problem))
            return self.end(context, keep=False)

    def event(self, context, event):
        if self.wanted:
            wanted, self.wanted = self.wanted, ""
            if wanted == "UNDO":
                return self.undo(context)
            return self.end(context, keep=wanted == "KEEP")
        kind, value = event.type, event.value
        if kind == "TIMER":
            return self.tick(context)
        if value == "PRESS" and kind == "ESC":
            return self.end(context, keep=False)
        if value == "PRESS" and kind in {"RET", "NUMPAD_ENTER"}:
            return self.end(context, keep=True)
        if value == "PRESS" and kind == "Z" and (event.ctrl or event.oskey):
            return self.undo(context)
        if kind == "LEFTMOUSE" and value == "RELEASE" and self.down:
            self.down = False
            self.hand.lift()
            self.hover(context)
            return {"RUNNING_MODAL"}
        view = _view(context, event)
        if view is None:
            return {"PASS_THROUGH"}
        if value == "PRESS" and kind == "F":
            self.follows = not self.follows
            if not self.follows:
                self.hand.lift()
            self.status(context)
            return {"RUNNING_MODAL"}
        if value == "PRESS" and kind == "RIGHTMOUSE":
            context.window_manager.popup_menu(_menu, title="Press")
            return {"RUNNING_MODAL"}
        if value == "PRESS" and kind in DEEPER_BY and not event.ctrl:
            self.change(context, DEEPER_BY[kind], event.shift)
            return {"RUNNING_MODAL"}
        if self.follows:
            return {"PASS_THROUGH"}
        if kind == "MOUSEMOVE":
            self.under(context, event)
            return {"RUNNING_MODAL"} if self.down else {"PASS_THROUGH"}
        if kind == "LEFTMOUSE" and value == "PRESS":
            self.under(context, event)
            self.down = self.place is not None
            if self.down:
                self.press()
            return {"RUNNING_MODAL"}
        return {"PASS_THROUGH"}

    def under(self, context, event):
        """The objects go where the mouse is."""
        view = _view(context, event)
        found = None if view is None else _hit(self.hand, *view, event)
        if found is None:
            return
        self.place = found
        if self.down:
            self.press()
        else:
            self.hover(context)

    def hover(self, context):
        if self.place is None or self.follows:
            return
        there = self.hand.at(*self.place, self.turn)
        if there is not None:
            self.hand.put(there)

    def press(self):
        there = self.hand.at(*self.place, self.turn, down=True)
        if there is not None:
            self.hand.step(there, TICK)
            self.hand.put(there)

    def tick(self, context):
        """Time passes: what has a weight sinks on, and what moves by itself presses."""
        if self.follows:
            self.hand.follow(TICK)
        elif self.down and self.hand.weighs:
            self.press()
        return {"PASS_THROUGH"}

    def change(self, context, notches, turns):
        """The wheel was turned: deeper, heavier, or round."""
        if turns:
            self.turn += TURN * notches
        elif self.hand.weighs:
            self.hand.weigh(DEEPER**notches)
        else:
            self.hand.depth = min(max(self.hand.depth * DEEPER**notches, 0.0005), 10.0)
        if self.down:
            self.press()
        else:
            self.hover(context)
        self.status(context)

    def undo(self, context):
        self.down = False
        if not self.hand.undo():
            tell(self, "INFO", "Nothing is left to undo: ESC drops the tool.")
        self.hover(context)
        return {"RUNNING_MODAL"}

    def status(self, context):
        hand = self.hand
        if hand.weighs:
            what = "weight " + ", ".join(f"{mass:.3g} kg" for mass in hand.masses())
        else:
            what = f"depth {1000 * hand.depth:.3g} mm"
        text = KEYS.format(what)
        if self.follows:
            text = f"Follows the animation.    {text}"
        text = sentences.translated(text)
        context.workspace.status_text_set(text)
        for area in context.screen.areas:
            if area.type == "VIEW_3D":
                area.header_text_set(text)

    def end(self, context, *, keep):
        hand, self.down = self.hand, False
        kept = keep and hand.live.strokes > 0
        if kept:
            try:
                self.tell(hand, hand.keep())
            except (DesirePathError, OSError, MemoryError) as problem:
                tell(self, "ERROR", sentence(problem))
                if hand.live.strokes:  # nothing is lost: one may go on, or try again
                    return {"RUNNING_MODAL"}
                kept = False
        else:
            hand.drop()
        self.leave(context)
        return {"FINISHED"} if kept else {"CANCELLED"}

    def leave(self, context):
        global _running
        _running, state.at_hand = None, False
        for name in STOPS:
            handlers = getattr(bpy.app.handlers, name)
            if _stop in handlers:
                handlers.remove(_stop)
        live.pause()
        context.window_manager.event_timer_remove(self.timer)
        context.workspace.status_text_set(None)
        for window in context.window_manager.windows:
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    area.header_text_set(None)
                area.tag_redraw()
        timeline.show()

    def cancel(self, context):
        """Blender closes, or loads another file."""
        if _running is self:
            self.hand.drop()
            self.leave(context)


class OBJECT_OT_desire_path_press_end(bpy.types.Operator):
    """Keep or drop what is pressed by hand, or take its last stroke back"""

    bl_idname = "object.desire_path_press_end"
    bl_label = "End Press"
    bl_options = {"INTERNAL"}

    action: EnumProperty(
        items=(
            ("KEEP", "Keep", "It stays, as a bake of its own"),
            ("UNDO", "Undo Stroke", "Take the last stroke back"),
            ("DROP", "Drop", "The ground is as it was before"),
        )
    )

    @classmethod
    def poll(cls, _context):
        return running()

    def execute(self, _context):
        _running.wanted = self.action
        return {"FINISHED"}


def _menu(self, _context):
    for action, words, icon in (
        ("KEEP", "Keep", "CHECKMARK"),
        ("UNDO", "Undo Stroke", "LOOP_BACK"),
        ("DROP", "Drop", "X"),
    ):
        self.layout.operator("object.desire_path_press_end", text=words, icon=icon).action = action


@persistent
def _stop(*_):
    """Something goes through all data: nothing of the tool is in it then."""
    if _running is not None:
        _running.hand.drop()
        _running.leave(bpy.context)


def _view(context, event):
    """(region, its 3D view) under the mouse, or None: elsewhere, or over what lies over the view."""
    for area in context.window.screen.areas:
        if area.type == "VIEW_3D":
            there = [each for each in area.regions if each.width > 1 and each.height > 1 and _inside(each, event)]
            if [each.type for each in there] == ["WINDOW"]:
                return there[0], area.spaces.active.region_3d
    return None


def _inside(region, event):
    return region.x <= event.mouse_x < region.x + region.width and region.y <= event.mouse_y < region.y + region.height


def _hit(hand, region, view, event):
    """Where the ground is under the mouse (x, y) [m], or None."""
    at = (event.mouse_x - region.x, event.mouse_y - region.y)
    origin = np.array(view3d_utils.region_2d_to_origin_3d(region, view, at), np.float64) * hand.scale
    along = np.array(view3d_utils.region_2d_to_vector_3d(region, view, at), np.float64)
    return hand.hit(origin, along, ALONG)


def draw_menu(self, _context):
    self.layout.operator("object.desire_path_press", icon="MOD_DYNAMICPAINT")


MENUS = ("VIEW3D_MT_object", "VIEW3D_MT_object_context_menu")
CLASSES = (OBJECT_OT_desire_path_press, OBJECT_OT_desire_path_press_end)


def register():
    for name in MENUS:
        getattr(bpy.types, name).append(draw_menu)


def unregister():
    if _running is not None:
        _stop()
    for name in MENUS:
        getattr(bpy.types, name).remove(draw_menu)
