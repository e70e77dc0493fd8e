"""coarse.py - a bake that takes its time is shown in larger cells until it is made.

    the Bake that is wanted --the same in larger cells, in a folder of its own--> a modifier beside the one that plays
It is never in a file, nor in the folder of the ground's bake: remove() takes all of it away, and what played before
plays again. Plants are not in it.
"""

import os
import shutil
import tempfile
from dataclasses import replace

import bpy

from ..bake.bake import Bake, read_index
from ..bake.options import BakeOutput
from . import home, playback, playback_tree, press_view, refined, show

MAX_SIDE = 0.5  # side of a cell [m]


class Coarse:
    """What is shown of a Job's grounds until its bake is made. times: how much larger cells are"""

    def __init__(self, job, times):
        self.job, self.shown = job, []
        self.cell = min(times * job.bake.cell_size, MAX_SIDE)
        self.folder = tempfile.mkdtemp(prefix="coarse_", dir=home.temporary())
        bake = job.bake
        parcels = [
            replace(
                each, folder=os.path.join(self.folder, str(number)), plants=(), plant_mesh=False, owner="", inputs={}
            )
            for number, each in enumerate(bake.parcels)
        ]
        self.bake = Bake(
            bake.gait,
            parcels,
            cell_size=self.cell,
            options=replace(bake.options, spray=None),
            output=BakeOutput(
                frame_start=bake.frame_start, frame_end=bake.frame_end, film=bake.film, map_seconds=False, resume=False
            ),
        )

    def run(self, scene):
        """Bake and show it, in steps."""
        steps = self.bake.run()
        try:
            for _ in steps:
                yield
        finally:
            steps.close()
        for share in self.bake.shares:
            obj = bpy.data.objects.get(share.parcel.name)
            if obj is not None:
                self._show(scene, obj, share)
            yield

    def _show(self, scene, obj, share):
        surface = self.job.surfaces[obj.name]
        index = read_index(share.parcel.folder, just_baked=True)
        copy = refined.make(scene, obj, surface, index, share.final)
        shown = playback.pictures(index.folder, index, ("trail",))
        tree = playback_tree.create(obj, shown, show.as_read(surface, index, copy and copy.object))
        press_view.put(obj, tree, surface.place)
        self.shown.append(obj.name)

    def remove(self):
        """Take it away, files and all."""
        shown, self.shown = self.shown, []
        for name in shown:
            obj = bpy.data.objects.get(name)
            if obj is not None:
                press_view.clear(obj)
        self.bake.close()
        shutil.rmtree(self.folder, ignore_errors=True)
