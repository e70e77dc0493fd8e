"""bake_all.py - the bakes of all grounds of a scene as one Job: one after the other, with one progress.

Grounds that a walk crosses are baked together; the others of them need no bake of their own then. A ground that cannot
be baked is told and left as it is.
"""

import bpy

from ..errors import DesirePathError
from . import recordings
from .bake_job import Job
from .chosen import grounds, walkers


class AllJobs:
    """Takes the place of a Job. Datablocks are looked up by name: undo replaces them."""

    def __init__(self, scene):
        there = [obj for obj in grounds(scene) if obj.library is None]
        if not there:
            raise DesirePathError("There is no ground in this scene: select a mesh and press Add Ground first.")
        # one that nobody is told to walk on may be crossed, and is baked with those that are
        self.scene_name, self.names = scene.name, [obj.name for obj in there if walkers(scene, obj)]
        if not self.names:
            raise DesirePathError("Nobody walks on the grounds of this scene: select an armature and press Add Walker.")
        self.job, self.recordings = None, recordings.current()
        self.cancelled, self.warnings, self.early = False, [], []
        self.done, self.reports, self.problems = [], [], []

    # ---- what a Job tells, of the one that is baked now -------------------------------------------------

    @property
    def name(self):
        return self.job.name if self.job else self.names[0]

    @property
    def bake(self):
        return self.job and self.job.bake

    @property
    def frame(self):
        return self.job and self.job.frame

    @property
    def grounds(self):
        return self.job.grounds if self.job else []

    @property
    def fraction(self):
        return min(1.0, (len(self.done) + (self.job.fraction if self.job else 0.0)) / len(self.names))

    @property
    def text(self):
        return f"'{self.job.name}': {self.job.text}" if self.job else "Recording the walkers"

    def object(self):
        return self.job.object()

    def run(self):
        """Steps; between two of them the user may do something else."""
        yield
        for name in self.names:
            if name in self.done:
                continue
            try:
                scene, obj = bpy.data.scenes[self.scene_name], bpy.data.objects.get(name)
                if obj is None:
                    raise DesirePathError(f"'{name}' is gone: bake again when it is back.")
                if obj.mode == "EDIT":
                    raise DesirePathError(f"'{name}' is in Edit Mode: leave it and bake again.")
                self.job = Job(scene, obj)
                yield from recordings.within(self.recordings, self.job.run())
                self.reports.append(self.job.finish())
                self.warnings += [each for each in self.job.warnings if each not in self.warnings]
            except (DesirePathError, OSError) as problem:
                self.play()
                self.problems.append(f"'{name}' was not baked: {problem}")
            baked = {name, *self.grounds} - {*self.done}
            self.done += [each for each in self.names if each in baked]
            self.job = None
            yield

    def finish(self):
        """What became of them, in a sentence; DesirePathError where nothing could be baked."""
        if self.problems and not self.reports:
            raise DesirePathError(" ".join(self.problems))
        self.warnings += self.problems
        return f"{len(self.reports)} bake{'s' if len(self.reports) > 1 else ''}. {' '.join(self.reports)}"

    def play(self):
        """Play what a bake that was not whole has left."""
        if self.bake is not None:
            self.job.play()
