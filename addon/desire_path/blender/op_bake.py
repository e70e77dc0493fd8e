"""op_bake.py - bake, stop, free, and show the files.

`execute` takes all steps of a Job in one go (this is what `blender -b` runs); with a window the same steps run in
slices, so that Blender stays awake and ESC stops them.
"""

import os
import time

import bpy
from bpy.props import BoolProperty

from ..errors import DesirePathError
from .chosen import grounds
from .late import bake_all, bake_job, framing, home, live, show, timeline
from .messages import tell
from .ops import AsksFirst, Refusal, active, begins, sentence
from .translations import say

SLICE = 0.05  # of work between two looks at the keyboard [s]


class _Bakes(Refusal):
    """Operators that run a Job: all at once, or in slices in a window."""

    look = False

    def make(self, context):
        """The Job."""
        raise NotImplementedError

    def work(self, context):
        """All at once."""
        context.view_layer.update()
        job = self.make(context)
        window = context.window_manager
        window.progress_begin(0, 1000)
        try:
            for _ in job.run():
                window.progress_update(int(1000 * job.fraction))
        except DesirePathError as problem:
            if job.bake is not None:
                job.play()
            raise problem
        finally:
            window.progress_end()
        timeline.show()
        self.tell(job)
        return {"FINISHED"}

    def tell(self, job):
        text = job.finish()
        for each in job.warnings:
            tell(self, "WARNING", each)
        tell(self, "INFO", text)

    # ---- in a window ----------------------------------------------------------------------------

    def invoke(self, context, _event):
        if bpy.app.background or context.window is None:
            return self.execute(context)
        begins()
        context.view_layer.update()
        try:
            self.job = self.make(context)
        except (DesirePathError, OSError, MemoryError) as problem:
            tell(self, "ERROR", sentence(problem))
            return {"CANCELLED"}
        bake_job.run(self.job)
        timeline.show()
        self.steps = self.job.run()
        manager = context.window_manager
        self.timer = manager.event_timer_add(0.01, window=context.window)
        manager.progress_begin(0, 1000)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        job = self.job
        if event.type == "ESC" and event.value == "PRESS" or job.cancelled:
            return self.stop(context)
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        until = time.perf_counter() + SLICE
        try:
            while time.perf_counter() < until:
                next(self.steps)
                while job.early:  # before it is made: it may be stopped and mended
                    tell(self, "WARNING", job.early.pop(0))
        except StopIteration:
            self.leave(context)
            try:
                self.tell(job)
            except DesirePathError as problem:
                tell(self, "ERROR", str(problem))
                return {"CANCELLED"}
            if self.look:
                framing.look(context, job.object(), job.bake, context.scene.frame_start)
            return {"FINISHED"}
        except (DesirePathError, OSError, MemoryError) as problem:
            self.leave(context)
            if job.bake is not None:
                job.play()
            tell(self, "ERROR", sentence(problem))
            return {"CANCELLED"}
        context.window_manager.progress_update(int(1000 * job.fraction))
        done = f"{job.text} ({100 * job.fraction:.0f} %)"
        context.workspace.status_text_set(f"{done}    {say('ESC: stop')}")
        timeline.redraw()
        return {"RUNNING_MODAL"}

    def stop(self, context):
        """Close the bake; its whole frames stay and play."""
        self.steps.close()
        self.leave(context)
        if self.job.bake is not None:
            self.job.play()
            bpy.ops.ed.undo_push(message="Stopped Bake")
        obj = bpy.data.objects.get(self.job.name)
        text = obj.desire_path.missing if obj is not None else ""
        tell(self, "WARNING", text or "The bake was stopped; the one from before plays on.")
        return {"CANCELLED"}

    def leave(self, context):
        bake_job.run(None)
        live.pause()
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        for area in context.screen.areas:
            area.tag_redraw()

    def cancel(self, context):
        """Blender closes, or loads another file."""
        self.steps.close()
        self.leave(context)


class OBJECT_OT_desire_path_bake(_Bakes, bpy.types.Operator):
    """Press the walkers' prints into the active ground, in files that play without this add-on"""

    bl_idname = "object.desire_path_bake"
    bl_label = "Bake Trail"
    bl_options = {"REGISTER", "UNDO"}

    look: BoolProperty(
        name="Look",
        options={"HIDDEN", "SKIP_SAVE"},
        description="Play the walk when it is baked, seen from near enough",
    )

    @classmethod
    def poll(cls, context):
        return bake_job.idle_ground(cls, context)

    def make(self, context):
        return bake_job.Job(context.scene, context.object)


class WM_OT_desire_path_bake_all(_Bakes, bpy.types.Operator):
    """Bake all grounds of the scene, one after the other; those that a walk crosses are baked together"""

    bl_idname = "wm.desire_path_bake_all"
    bl_label = "Bake All Grounds"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if bake_job.running() is not None:
            cls.poll_message_set("A bake is running")
            return False
        if not grounds(context.scene):
            cls.poll_message_set("There is no ground in this scene")
            return False
        return True

    def make(self, context):
        return bake_all.AllJobs(context.scene)


class OBJECT_OT_desire_path_show_files(Refusal, bpy.types.Operator):
    """Show the files of the active ground's bake in the system's file browser"""

    bl_idname = "object.desire_path_show_files"
    bl_label = "Show in File Browser"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"MESH"}, "the ground", changed=False)

    def work(self, context):
        obj = context.object
        place = home.played(obj) or (home.folder(obj) if obj.desire_path.folder and not home.lost(obj) else "")
        if not os.path.isdir(place):
            raise DesirePathError(f"There are no files of '{obj.name}' yet: bake it first.")
        if not bpy.app.background:
            bpy.ops.wm.path_open(filepath=place)
        self.report({"INFO"}, place)
        return {"FINISHED"}


class OBJECT_OT_desire_path_cancel(bpy.types.Operator):
    """Stop the bake that is running; what was baked stays"""

    bl_idname = "object.desire_path_cancel"
    bl_label = "Cancel"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, _context):
        return bake_job.running() is not None

    def execute(self, _context):
        bake_job.running().cancelled = True
        return {"FINISHED"}


class OBJECT_OT_desire_path_free(AsksFirst, Refusal, bpy.types.Operator):
    """Give the ground back as it was before the bake, and delete the baked files once the file is saved or closed"""

    bl_idname = "object.desire_path_free"
    bl_label = "Free Bake"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return bake_job.idle_ground(cls, context)

    def work(self, context):
        obj = context.object
        if not obj.desire_path.is_ground:
            raise DesirePathError(f"'{obj.name}' is no ground, so there is nothing to free.")
        show.free(obj)
        obj.desire_path.auto_update = False  # else it would be baked again
        return {"FINISHED"}


CLASSES = (
    OBJECT_OT_desire_path_bake,
    WM_OT_desire_path_bake_all,
    OBJECT_OT_desire_path_cancel,
    OBJECT_OT_desire_path_free,
    OBJECT_OT_desire_path_show_files,
)
