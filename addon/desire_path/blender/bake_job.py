"""bake_job.py - one bake of one ground, in steps, and the one that runs in a window.

    walkers --sample--> Gait --\\
                                Bake --> files --> playback, attributes, vertex groups
    ground mesh --read---------/
The mesh is touched once, at the end.
"""

import json
import os
import time
from contextlib import closing, suppress

import bpy

from ..bake.bake import read_index
from ..bake.output import check_idle
from ..bounds import Limits
from ..errors import DesirePathError
from . import home, inputs, moves, paths, recordings, replant, sample, trash, trodden
from .chosen import absent, elsewhere, walkers
from .home import folder
from .ops import active
from .show import lost, play, plays_on
from .translations import say

LOOK_EVERY = 0.4  # between two looks at how far it is [s]
NOBODY = "Nobody walks on '{}': select the armature and press Add Walker."
_running = None  # the Job that runs in a window, for the panel and its Cancel button
_again = None  # the one that live.py runs


def running():
    """The Job that runs in a window, or None."""
    return _running


def again(job):
    """Note which Job bakes again by itself; None: none does."""
    global _again
    _again = job


def in_progress():
    """The Jobs that have something to show of how far they are."""
    return [job for job in (_running, _again) if job is not None and job.bake is not None]


def run(job):
    """Note which Job runs in a window; None: it has come to its end."""
    global _running
    _running = job


class Job:
    """One bake of one ground, in steps. Datablocks are looked up by name: undo replaces them.

    unless_fresh: nothing is baked where the bakes that are there were made from the same; `fresh` tells it then
    """

    def __init__(self, scene, obj, *, unless_fresh=False):
        self.scene_name, self.name = scene.name, obj.name
        self.unless_fresh, self.fresh = unless_fresh, False
        self.fraction, self.text, self.cancelled = 0.0, "Recording the walkers", False
        self.warnings, self.early = [], []
        self.bake, self.frame = None, None
        self.grounds = [obj.name]
        settings = obj.desire_path
        if not settings.is_ground:
            raise DesirePathError(f"'{obj.name}' is no ground yet: press Add Ground first.")
        there = walkers(scene, obj)
        if not there and not any(walkers(scene, each) for each in trodden.others(scene, obj)):
            raise DesirePathError(" ".join(absent(scene, obj) + elsewhere(scene, obj)) or NOBODY.format(obj.name))
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
        self.recordings = recordings.current()  # of who has made them to bake

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
        company = yield from recordings.within(self.recordings, trodden.company(scene, obj))
        if not company.walkers:
            raise DesirePathError(NOBODY.format(obj.name))
        self.grounds = [each.name for each in company.grounds]
        folders = [(home.claim(each), each.desire_path.bake_id) for each in company.grounds]
        for path, _ in folders:
            check_idle(path)
        trodden.follow(company)
        for each in company.walkers:
            sample.poses(each)
        steps = inputs.taken(scene, company, folders, wait=0.0)
        bake, self.surfaces = yield from recordings.within(self.recordings, steps)
        self.recordings = None
        for each, parcel in zip(company.grounds, bake.parcels):
            parcel.inputs.update(inputs.marks(each, company, bake, self.surfaces))
        self.fresh = self.unless_fresh and all(map(_is_fresh, company.grounds, bake.parcels))
        if self.fresh:
            return
        odd = [*inputs.gravity_of(scene), *moves.still(company.walkers)]
        self.early += [*odd, *bake.warnings]
        self.warnings += [
            *odd,
            *bake.warnings,
        ]  # what is told of the walkers themselves comes before what follows from it
        for each in self.surfaces.values():
            self.warnings += each.warnings
        self.warnings += [*company.warnings, *inputs.warnings_of(company), *paths.warnings(company.walkers)]
        for each in company.grounds:
            self.warnings += replant.refresh(scene, each)
        yield
        for path, _ in folders:
            trash.drop(path)  # another bake takes its place
        self.bake = bake
        self.text, self._bakes_since, self._looked_at = "Baking", time.perf_counter(), 0.0
        with closing(self.bake.run()) as frames:
            for progress in frames:
                self._how_far(progress)
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

    def _how_far(self, progress):
        """How far it is, how long it takes from here on, and how large the files are that are there."""
        now = time.perf_counter()
        self.fraction, self.frame = progress.fraction, progress.frame
        if now < self._looked_at + LOOK_EVERY and self.fraction < 1.0:
            return
        self._looked_at = now
        left = (now - self._bakes_since) * (1.0 - self.fraction) / max(self.fraction, 1e-6)
        size = sum(disk_size(share.out.new) for share in self.bake.shares)
        self.text = say("Frame {}, {} left, {:.1f} MB", self.frame, duration(left), size / 1e6)

    def play(self):
        """Play what a bake that was not whole has left, on all its grounds that play no whole one."""
        for share in self.bake.shares:
            obj = bpy.data.objects.get(share.parcel.name)
            if obj is not None:
                try:
                    index = read_index(folder(obj))
                    ended = not index.complete and not index.missing  # what belongs to its frames could not be written
                    if not ended and not plays_on(obj, index):
                        play(bpy.data.scenes[self.scene_name], obj, self.surfaces[obj.name])
                except DesirePathError:
                    pass  # nothing was written


def _is_fresh(obj, parcel):
    """Whether a ground plays a whole bake that was made from what this one would be made from."""
    try:
        index = read_index(folder(obj))
    except DesirePathError:
        return False
    complete = index.complete and not lost(index)
    return complete and home.played(obj) == folder(obj) and {**index.inputs, **parcel.inputs} == index.inputs


def duration(seconds):
    """Seconds in words."""
    minutes, seconds = divmod(int(seconds + 0.5), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {seconds} s" if minutes else f"{seconds} s"


def disk_size(path):
    """Bytes of all files below a folder [B]."""
    found = 0
    for above, _, names in os.walk(path):
        for name in names:
            with suppress(OSError):
                found += os.lstat(os.path.join(above, name)).st_size
    return found


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
