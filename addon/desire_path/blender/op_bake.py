"""op_bake.py - bake, stop, free.

    walkers --sample--> Gait --\\
                                Bake --> files --> playback, attributes, vertex groups
    ground mesh --read---------/
The mesh is touched once, at the end. `execute` does all of it in one go (this is what `blender -b`
runs); with a window the same steps run in slices, so that Blender stays awake and ESC stops them.
"""
import json
import time
from contextlib import closing

import bpy

from ..errors import DesirePathError
from ..output import check_idle
from . import home, inputs, moves, op_plants, way
from .home import folder  # noqa: F401  (where others look for it)
from .op_walkers import Refusal, active, sentence, walkers
from .show import free, play

SLICE = 0.05  # of work between two looks at the keyboard [s]

_running = None  # the Job that runs in a window, for the panel and its Cancel button


def running():
    return _running


class Job:
    """One bake of one ground, in steps. Datablocks are looked up by name: undo replaces them."""

    def __init__(self, scene, obj):
        self.scene_name, self.name = scene.name, obj.name
        self.fraction, self.text, self.cancelled = 0.0, "Recording the walkers", False
        self.warnings = []
        self.bake = None
        settings = obj.desire_path
        if not settings.is_ground:
            raise DesirePathError(f"'{obj.name}' is no ground yet: press Add Ground first.")
        there = walkers(scene, obj)
        if not there:
            raise DesirePathError(f"Nobody walks on '{obj.name}': select the armature and press "
                                  "Add Walker.")
        models = {each.desire_path.load_model for each in there}
        if len(models) > 1:
            raise DesirePathError("The walkers of one ground need the same load model: choose one "
                                  "for all of them.")
        first, last = moves.follow(scene, obj, there)
        if last <= first:
            raise DesirePathError(f"The frames {first} to {last} of '{obj.name}' hold no motion: set "
                                  "an end after the start.")
        self.path = home.claim(obj)
        check_idle(self.path)
        self.begun = time.perf_counter()
        self.walkers = [each.name for each in there]

    def object(self):
        obj = bpy.data.objects.get(self.name)
        if obj is None:
            raise DesirePathError(f"'{self.name}' is gone: bake again when it is back.")
        return obj

    def run(self):
        """Steps; between two of them the user may do something else."""
        yield
        scene, obj = bpy.data.scenes[self.scene_name], self.object()
        there = [bpy.data.objects.get(name) for name in self.walkers]
        if None in there:
            raise DesirePathError("A walker was removed or renamed while it was to be recorded: bake "
                                  "again.")
        settings = obj.desire_path
        made, self.surface = yield from inputs.taken(scene, obj, there, settings.frame_start, settings.frame_end,
                                                     folder=self.path, owner=settings.bake_id, wait=0.0)
        made.inputs = inputs.marks(obj, there, made, self.surface)
        self.warnings += [*self.surface.warnings, *way.warnings(there)]
        self.recorded = time.perf_counter() - self.begun
        self.warnings += op_plants.refresh(scene, obj)
        yield
        self.bake = made
        self.text = "Baking"
        with closing(self.bake.run()) as frames:
            for progress in frames:
                self.fraction = progress.fraction
                self.text = f"Baking frame {progress.frame}"
                yield

    def finish(self):
        """Play what was baked and say what it is; returns a sentence."""
        if self.bake is None:
            return "Nothing was baked."
        obj = self.object()
        settings = obj.desire_path
        index, warnings = play(obj, self.surface, self.bake.final)
        self.warnings += warnings
        report = self.bake.report
        if report is None:
            settings.summary = ""
            return settings.missing or "Stopped."
        report = dict(report, seconds_recording=round(self.recorded, 3),
                      seconds_in_all=round(time.perf_counter() - self.begun, 3))
        self.warnings += [each for each in report["warnings"] if each not in self.warnings]
        settings.summary = json.dumps({name: report[name] for name in (
            "contacts", "deepest_m", "pressed_m3", "heaped_m3", "seconds_in_all")}
            | {"frames": [index.frame_start, index.frame_end], "warnings": self.warnings})
        return (f"Baked frames {index.frame_start} to {index.frame_end} in {report['seconds_in_all']:.1f} s: "
                f"{report['contacts']} contacts, deepest print "
                f"{1000 * report['deepest_m']:.0f} mm; files in {self.path}.")


def idle_ground(operator, context):
    """Whether a mesh is active and nothing bakes; else the button says why not."""
    if _running is not None:
        operator.poll_message_set("A bake is running")
        return False
    return active(operator, context, {"MESH"}, "the ground")


class OBJECT_OT_desire_path_bake(Refusal, bpy.types.Operator):
    """Press the walkers' prints into the active ground, in files that play without this add-on"""

    bl_idname = "object.desire_path_bake"
    bl_label = "Bake Trail"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return idle_ground(cls, context)

    def work(self, context):
        """All at once."""
        context.view_layer.update()
        job = Job(context.scene, context.object)
        window = context.window_manager
        window.progress_begin(0, 1000)
        try:
            for _ in job.run():
                window.progress_update(int(1000 * job.fraction))
        except DesirePathError as problem:
            if job.bake is not None:
                self.salvage(job)
            raise problem
        finally:
            window.progress_end()
        self.tell(job)
        return {"FINISHED"}

    def salvage(self, job):
        """What a failed bake left behind is played."""
        try:
            play(job.object(), job.surface)
        except DesirePathError:
            pass  # nothing was written

    def tell(self, job):
        text = job.finish()
        for each in job.warnings:
            self.report({"WARNING"}, each)
        self.report({"INFO"}, text)

    # ---- in a window ----------------------------------------------------------------------------

    def invoke(self, context, _event):
        global _running
        if bpy.app.background or context.window is None:
            return self.execute(context)
        context.view_layer.update()
        try:
            self.job = Job(context.scene, context.object)
        except DesirePathError as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        _running = self.job
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
        except StopIteration:
            self.leave(context)
            try:
                self.tell(job)
            except DesirePathError as problem:
                self.report({"ERROR"}, str(problem))
                return {"CANCELLED"}
            return {"FINISHED"}
        except (DesirePathError, OSError, MemoryError) as problem:
            self.leave(context)
            if job.bake is not None:
                self.salvage(job)
            self.report({"ERROR"}, sentence(problem))
            return {"CANCELLED"}
        context.window_manager.progress_update(int(1000 * job.fraction))
        context.workspace.status_text_set(f"{job.text} ({100 * job.fraction:.0f} %)    ESC: stop")
        for area in context.screen.areas:
            if area.type == "PROPERTIES":
                area.tag_redraw()
        return {"RUNNING_MODAL"}

    def stop(self, context):
        """Close the bake; its whole frames stay and play."""
        self.steps.close()
        self.leave(context)
        if self.job.bake is not None:
            self.salvage(self.job)
            bpy.ops.ed.undo_push(message="Stopped Bake")
        obj = bpy.data.objects.get(self.job.name)
        text = obj.desire_path.missing if obj is not None else ""
        self.report({"WARNING"}, text or "The bake was stopped.")
        return {"CANCELLED"}

    def leave(self, context):
        global _running
        _running = None
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        for area in context.screen.areas:
            area.tag_redraw()

    def cancel(self, context):
        """Blender closes, or loads another file."""
        self.steps.close()
        self.leave(context)


class OBJECT_OT_desire_path_cancel(bpy.types.Operator):
    """Stop the bake that is running; what was baked stays"""

    bl_idname = "object.desire_path_cancel"
    bl_label = "Cancel"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, _context):
        return _running is not None

    def execute(self, _context):
        _running.cancelled = True
        return {"FINISHED"}


class OBJECT_OT_desire_path_free(Refusal, bpy.types.Operator):
    """Give the ground back as it was before the bake, and delete the baked files"""

    bl_idname = "object.desire_path_free"
    bl_label = "Free Bake"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return idle_ground(cls, context)

    def work(self, context):
        obj = context.object
        if not obj.desire_path.is_ground:
            raise DesirePathError(f"'{obj.name}' is no ground, so there is nothing to free.")
        free(obj)
        return {"FINISHED"}


CLASSES = (OBJECT_OT_desire_path_bake, OBJECT_OT_desire_path_cancel, OBJECT_OT_desire_path_free)
