"""How ground is pressed, in one record."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..bounds import Limits
from ..errors import DesirePathError
from ..motion.recording import CONTACT_LAWS
from .spray import Spray, as_spray

LAWS = CONTACT_LAWS[:2]  # how a sole presses by its load: one sink for the limb | one stress, as in TRAIL (10)
HEAPS = ("rest", "paper")  # how displaced soil is laid: in its resting shape | TRAIL (12) and (16)
MAX_THREADS = 64
FARTHEST = 1e7  # cells may begin from the origin of the scene [m]


@dataclass(frozen=True)
class SimulationOptions:
    """What a Simulation goes by; DesirePathError when it is made of what cannot be."""

    law: str = "sole"  # how walkers press that do not say it themselves (Gait.contact_law), one of CONTACT_LAWS
    heap: str = "rest"  # how displaced soil is laid, one of HEAPS
    rim_width: float = 0.04  # of the rim of a "paper" heap [m] > 0
    origin: tuple[float, float] = (0.0, 0.0)  # where cells begin [m]
    threads: int = 0  # 0 = as many as the machine has, to 64; the result is the same for any number
    limits: Limits = Limits()  # how many plants, and how much memory for them
    spray: str | Spray | None = (
        None  # what sticks to soles and flies off them: a Spray, one's name or file; None: nothing
    )

    def __post_init__(self) -> None:
        if self.law not in CONTACT_LAWS:
            raise DesirePathError(f"There is no contact law '{self.law}': choose {' or '.join(CONTACT_LAWS)}.")
        if self.heap not in HEAPS:
            raise DesirePathError(f"There is no heap law '{self.heap}': choose {' or '.join(HEAPS)}.")
        try:
            fits = 0 <= self.threads <= MAX_THREADS and self.threads == int(self.threads)
        except (TypeError, ValueError, OverflowError):
            fits = False
        if not fits:
            raise DesirePathError("The number of threads must be 0 (all) to 64.")
        try:
            width = float(self.rim_width)
        except (TypeError, ValueError):
            raise DesirePathError(
                f"A rim width of {self.rim_width!r} is no number: give more than 0 m (0.04 is usual)."
            ) from None
        if not (math.isfinite(width) and width > 0):
            raise DesirePathError(f"A rim width of {width:g} m cannot be used: choose more than 0 (0.04 is usual).")
        try:
            x, y = (float(value) for value in self.origin)
        except (TypeError, ValueError):
            x = y = math.nan
        if not (math.isfinite(x) and math.isfinite(y)):
            raise DesirePathError("The origin of the cells is not a finite point: give two numbers in metres.")
        if max(abs(x), abs(y)) > FARTHEST:
            raise DesirePathError(
                f"The origin of the cells, {x:g} {y:g}, lies too far away: give one within {FARTHEST:g} m."
            )
        if not isinstance(self.limits, Limits):
            raise DesirePathError(
                f"Limits of {self.limits!r} are none: give Limits(), or leave them out for the usual ones."
            )
        object.__setattr__(self, "spray", as_spray(self.spray))
        object.__setattr__(self, "rim_width", width)
        object.__setattr__(self, "origin", (x, y))
        object.__setattr__(self, "threads", int(self.threads))
