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

from ..bake.output import check_idle
from ..bounds import Limits
from ..errors import DesirePathError
from . import home, inputs, moves, op_plants, reach, sample, trash, way
from .home import folder  # noqa: F401  (where others look for it)
from .op_walkers import AsksFirst, Refusal, absent, active, sentence, walkers
from .show import free, play, plays_on

NOBODY = "Nobody walks on '{}': select the armature and press Add Walker."
SLICE = 0.05  # of work between two looks at the keyboard [s]

_running = None  # the Job that runs in a window, for the panel and its Cancel button


def running():
    return _running


class Job:
    """One bake of one ground, in steps. Datablocks are looked up by name: undo replaces them."""

    def __init__(self, scene, obj):
        self.scene_name, self.name = scene.name, obj.name
        self.fraction, self.text, self.cancelled = 0.0, "Recording the walkers", False
        self.warnings, self.early = [], []
        self.bake = None
        settings = obj.desire_path
        if not settings.is_ground:
            raise DesirePathError(f"'{obj.name}' is no ground yet: press Add Ground first.")
        there = walkers(scene, obj)
        if not there and not any(walkers(scene, each) for each in reach.others(scene, obj)):
            raise DesirePathError(" ".join(absent(scene, obj)) or NOBODY.format(obj.name))
        self.warnings += absent(scene, obj)
        inputs.check((obj,), there)
        first, last = moves.follow(scene, obj, there)
        if there and last <= first:
            raise DesirePathError(
                f"The frames {first} to {last} of '{obj.name}' hold no motion: set an end after the start."
            )
        Limits().check("frames", last - first + 1)
        check_idle(home.claim(obj))
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
            raise DesirePathError("A walker was removed or renamed while it was to be recorded: bake again.")
        company = yield from reach.company(scene, obj)
        if not company.walkers:
            raise DesirePathError(NOBODY.format(obj.name))
        folders = [(home.claim(each), each.desire_path.bake_id) for each in company.grounds]
        for path, _ in folders:
            check_idle(path)
        reach.follow(company)
        for each in company.walkers:
            sample.poses(each)
        made, self.surfaces = yield from inputs.taken(scene, company, folders, wait=0.0)
        for each, parcel in zip(company.grounds, made.parcels):
            parcel.inputs.update(inputs.marks(each, company, made, self.surfaces))
        self.early += made.warnings
        self.warnings += made.warnings  # what is told of the walkers themselves comes before what follows from it
        for each in self.surfaces.values():
            self.warnings += each.warnings
        self.warnings += [*company.warnings, *inputs.told(company), *way.warnings(company.walkers)]
        for each in company.grounds:
            self.warnings += op_plants.refresh(scene, each)
        yield
        for path, _ in folders:
            trash.drop(path)  # another bake takes its place
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
        settings = self.object().desire_path
        if self.bake.report is None:
            self.play()
            settings.summary = ""
            return settings.missing or "Stopped."
        spent = round(time.perf_counter() - self.begun, 3)
        self.warnings += [each for each in self.bake.report["warnings"] if each not in self.warnings]
        shares = self.bake.shares
        for share in shares:
            obj = bpy.data.objects.get(share.parcel.name)
            if obj is None:
                raise DesirePathError(f"'{share.parcel.name}' is gone: bake again when it is back.")
            index, warnings = play(bpy.data.scenes[self.scene_name], obj, self.surfaces[obj.name], share.final)
            self.warnings += warnings
            obj.desire_path.summary = json.dumps(
                {name: share.report[name] for name in ("contacts", "deepest_m", "pressed_m3", "heaped_m3")}
                | {
                    "seconds_in_all": spent,
                    "frames": [index.frame_start, index.frame_end],
                    "with": share.report.get("with", []),
                    "warnings": self.warnings,
                }
            )
        names = [share.parcel.name for share in shares]
        if self.name not in names:
            self.warnings.append(f"No foot has trodden '{self.name}': it is as it was.")
        report = self.bake.report
        return (
            f"Baked frames {index.frame_start} to {index.frame_end}{_on(names)} in {spent:.1f} s: "
            f"{report['contacts']} contacts, deepest print {1000 * report['deepest_m']:.0f} mm; files in "
            f"{', '.join(share.out.folder for share in shares)}."
        )

    def play(self):
        """Play what a bake that was not whole has left, on all its grounds that play no whole one."""
        from ..bake.bake import read_index

        for share in self.bake.shares:
            obj = bpy.data.objects.get(share.parcel.name)
            if obj is not None:
                try:
                    if not plays_on(obj, read_index(folder(obj))):
                        play(bpy.data.scenes[self.scene_name], obj, self.surfaces[obj.name])
                except DesirePathError:
                    pass  # nothing was written


def _on(names):
    """Names of several grounds as a sentence has them; empty for one."""
    if len(names) < 2:
        return ""
    *some, last = (f"'{name}'" for name in names)
    return f" on {', '.join(some)} and {last}"


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
                job.play()
            raise problem
        finally:
            window.progress_end()
        self.tell(job)
        return {"FINISHED"}

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
        except (DesirePathError, OSError, MemoryError) as problem:
            self.report({"ERROR"}, sentence(problem))
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
                while job.early:  # before it is made: it may be stopped and mended
                    self.report({"WARNING"}, job.early.pop(0))
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
                job.play()
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
            self.job.play()
            bpy.ops.ed.undo_push(message="Stopped Bake")
        obj = bpy.data.objects.get(self.job.name)
        text = obj.desire_path.missing if obj is not None else ""
        self.report({"WARNING"}, text or "The bake was stopped; the one from before plays on.")
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


class OBJECT_OT_desire_path_free(AsksFirst, Refusal, bpy.types.Operator):
    """Give the ground back as it was before the bake, and delete the baked files once the file is saved or closed"""

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
