"""What a bake goes by, and what it writes, in two records."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from .. import memory
from ..errors import DesirePathError
from ..ground.options import SimulationOptions
from ..ground.sim import LOAD_MODELS

FILMS = ("frames", "passes")  # what a frame is: a scene frame | a whole pass of a walk along a path


@dataclass(frozen=True)
class BakeOptions(SimulationOptions):
    """How a Bake presses the ground: as SimulationOptions, and by which loads. `limits` are those of all it takes, and
    run() refuses more before anything is written."""

    load_model: str = "inertia"  # one of LOAD_MODELS
    memory: float | str | None = None  # that the program may take, in bytes or as "4G"; what does not fit waits on disk

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "memory", memory.size_of(self.memory))
        if self.load_model not in LOAD_MODELS:
            raise DesirePathError(f"There is no load model '{self.load_model}': choose {' or '.join(LOAD_MODELS)}.")


@dataclass(frozen=True)
class BakeOutput:
    """What a Bake writes, and for whom. Of several grounds each has its own plant_mesh, owner, inputs: a Parcel's."""

    frame_start: int | None = None  # first scene frame that is written; None = the recording's
    frame_end: int | None = None  # last one
    film: str | None = (
        None  # one of FILMS, "passes": frame n is the ground after pass n; None = it, if there are several
    )
    map_seconds: bool = True  # maps after every second, or pass
    plant_mesh: bool = False  # the plants themselves as a mesh and its point cache, for close-ups
    resume: bool = True  # go on where the same bake was stopped
    owner: str = ""  # id of the ground the folder belongs to; a folder with another's bake is refused. Empty: anybody's
    inputs: Mapping[str, object] | None = None  # words for what it is made from, kept in index.json for whoever asks
    wait: float = 30.0  # so long another program may end its bake into the folder before this one is refused [s]

    def __post_init__(self) -> None:
        if self.film not in (None, *FILMS):
            raise DesirePathError(f"There is no film '{self.film}': choose {' or '.join(FILMS)}.")
        for frame in (self.frame_start, self.frame_end):
            try:
                fits = frame is None or abs(int(frame)) >= 0
            except (ValueError, OverflowError, TypeError):
                fits = False
            if not fits:
                raise DesirePathError(
                    f"Frames {self.frame_start} to {self.frame_end} cannot be baked: give whole numbers."
                )
