"""On which days a crowd's passages fall, and how much grows from one to the next. MODEL 12.8. Experimental.

    "spans": [{"days": 5, "per_day": 40}, {"days": 2, "per_day": 150}]                     a week, again and again
    "spans": [{"days": 245, "per_day": 30}, {"days": 120, "per_day": 5, "growth": 0.0}]    a year with its winter

A day of growth is one on which cover grows as fast as the ground says.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ..errors import DesirePathError
from .numbers import number

MAX_SPANS = 1000
NEAR = 1e-9  # shares of a passage that are none


@dataclass(frozen=True)
class Span:
    """Days that are alike."""

    days: float  # how many [day] above 0 to 1e6
    per_day: float  # passages [1/day] 0.001..1e6; 0 = nobody comes
    growth: float = 1.0  # how fast cover grows, against the ground's own rate [-] 0..100; 0 = winter

    def check(self) -> Span:
        """Itself, if its numbers are in their ranges; else a sentence."""
        number(self.days, "The days of a span", 1e-3, 1e6)
        if self.per_day != 0.0:
            number(self.per_day, "The number of passages a day of a span", 1e-3, 1e6)
        number(self.growth, "The growth of a span", 0.0, 100.0)
        return self


class Calendar:
    """When each passage goes: spans in turn, again from the first. DesirePathError where nobody ever comes."""

    def __init__(self, spans: Sequence[Span]) -> None:
        if len(spans) > MAX_SPANS:
            raise DesirePathError(f"There are {len(spans)} spans: give up to {MAX_SPANS}.")
        self.spans = [span.check() for span in spans]
        self._passages = math.fsum(span.days * span.per_day for span in self.spans)  # of one turn
        self._days = math.fsum(span.days for span in self.spans)
        self._grown = math.fsum(span.days * span.growth for span in self.spans)
        if self._passages <= 0.0:
            raise DesirePathError("Nobody comes in any span: give one of them passages a day.")

    def until(self, passages: int, idle: bool = True) -> tuple[float, float]:
        """(days, days of growth) until so many passages have gone; idle: days after them without any count, too."""
        turns = math.floor(passages / self._passages)
        left = passages - turns * self._passages
        if not idle and turns and left <= NEAR:
            turns, left = turns - 1, left + self._passages
        days, grown = turns * self._days, turns * self._grown
        for span in self.spans:
            here = span.days * span.per_day
            if not idle and left <= NEAR:
                break
            if here > left + NEAR:
                part = max(left, 0.0) / span.per_day
                return days + part, grown + part * span.growth
            days, grown, left = days + span.days, grown + span.days * span.growth, left - here
        return days, grown

    def pause(self, passages: int) -> int | None:
        """How many passages will have gone, more than so many, when next nobody comes for a span; None = never."""
        if all(span.per_day for span in self.spans):
            return None
        found, gone = [], 0.0
        for span in self.spans:
            if not span.per_day:
                turns = max(math.ceil((passages + 1 - NEAR - gone) / self._passages), 0)
                found.append(math.floor(turns * self._passages + gone + NEAR))
            gone += span.days * span.per_day
        return max(min(found), passages + 1)
