"""What was pressed by hand becomes a bake: one that plays, and that another walk goes on from.

    LivePress --move, lift, undo--> ground as it was pressed --keep--> folder/frames, maps_final.exr, report.json
                                                             --drop--> nothing has been

    press = LivePress(Ground.flat(), PressBody(vertices, triangles, mass=4.0), "wet-sand")
    press.move((0, 0, 0.1, 1, 0, 0, 0)), press.move((0.4, 0, 0.1, 1, 0, 0, 0)), press.lift()
    press.keep("pressed")
    Bake(gait, Ground.read("pressed/maps_final.exr"), "wet-sand", "walked")

Its frame 0 is the ground as it was pressed, and so is its only other one: a hand has no time.
"""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Mapping
from typing import Any, cast

from ..errors import DesirePathError
from ..ground.parcels import Parcel
from ..ground.pressing import PressBody, Pressing
from ..loads.force import FootForce
from ..version import VERSION
from .folder import FrameIndex, read_index
from .options import BakeOptions, BakeOutput
from .plan import Plan
from .share import Share

__all__ = ["LivePress", "PressBody"]


class _Pressed(Plan):
    """What a bake of pressed ground says of itself."""

    def __init__(self, press: Pressing, parcel: Parcel, frame: int, frame_rate: float) -> None:
        self.press, self.parcels, self.folder = press, [parcel], parcel.folder
        self.output = BakeOutput(resume=False)
        self.options = BakeOptions(law=press.options.law, heap=press.options.heap, origin=press.options.origin)
        self.film, self.warnings, self.passes = "frames", (), []
        self.frame_start = self.frame_end = frame
        self.frame_rate, self.cell_size = frame_rate, press.cell_size

    def sample(self, frame: int) -> int:
        return 0

    def time(self, frame: int) -> float:
        return 0.0

    def map_name(self, frame: int) -> str | None:
        return None

    def signature(self) -> str:
        return "pressed"

    def parameters(self, parcel: Parcel) -> dict[str, Any]:
        soils: Any = parcel.soils
        options = self.options
        return {
            "cell_size": self.cell_size,
            "frame_start": self.frame_start,
            "frame_end": self.frame_end,
            "frame_rate": self.frame_rate,
            "soils": [soil.parameters() for soil in soils],
            "ground": parcel.ground.name,
            **({"trail": parcel.ground.trail.path} if parcel.ground.trail else {}),
            "pressed_by": [body.name for body in self.press.bodies],
            "mass_kg": [body.mass for body in self.press.bodies],
            "law": options.law,
            "heap": options.heap,
            "rim_width": self.press.options.rim_width,
            "origin": options.origin,
        }


class LivePress(Pressing):
    """Bodies that are moved over ground by hand, as Pressing tells, and a bake of what they leave there."""

    def keep(
        self,
        folder: str | os.PathLike[str],
        *,
        frame: int = 1,
        frame_rate: float = 24.0,
        owner: str = "",
        inputs: Mapping[str, object] | None = None,
    ) -> FrameIndex:
        """Write the ground as it is as a whole bake, in place of an earlier one there; returns what plays of it.

        A stroke on its way ends. Nothing of an earlier bake is lost where this fails, with a DesirePathError or an
        OSError, and one may go on pressing after it.
        frame: scene frame that shows it; frame_rate [1/s]; owner, inputs: as BakeOutput has them
        """
        if not 0.0 < frame_rate <= 1e4:
            raise DesirePathError(f"{frame_rate:g} frames a second cannot be made: give a number above 0.")
        self.lift()
        if self.window is None:
            raise DesirePathError("Nothing was pressed, and nothing can be kept: move a body into the ground first.")
        begun = time.perf_counter()
        self.sim.settle()
        parcel = Parcel(self.ground, self.soils, os.fspath(folder), owner=owner, inputs=dict(inputs or {}))
        plan = _Pressed(self, parcel, int(frame), float(frame_rate))
        share = Share(plan, parcel, self.sim, cast(FootForce, None), self.tiles())
        share.out.open(plan.wait)
        try:
            share.find(plan.signature())
            share.look()
            share.begin(0, ())
            share.write(0, 0.0)
            share.write(1, 0.0)
            share.end()
            self.sim.flush()
            share.conclude(self._report(plan, share, begun))
            share.ready()
            share.out.publish()
        except BaseException:
            with contextlib.suppress(OSError):
                self.sim.flush()  # what is written in the background has come to its end
            share.out.drop()
            raise
        finally:
            share.out.release()
        return read_index(folder, just_baked=True)

    def _report(self, plan: _Pressed, share: Share, begun: float) -> dict[str, Any]:
        return {
            "passes": 0,
            "contacts": self.strokes,
            **share.numbers(),
            "seconds": round(time.perf_counter() - begun, 3),
            "warnings": list(self.warnings),
            "version": VERSION,
            "parameters": plan.parameters(share.parcel),
        }
