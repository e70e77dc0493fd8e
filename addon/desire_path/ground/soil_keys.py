"""A soil that changes while it is walked on, as it freezes, thaws or gets wet. MODEL 6.10

    SoilKeys(soil, {"young_modulus": [(0.0, 2e6), (5.0, 4e5)]})    wherever a Soil can be given

What is pressed already stays; who presses later obeys the numbers of that time.
"""

from __future__ import annotations

import bisect
import json
import math
import os
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..errors import DesirePathError
from ..files import atomic_file, record
from ..tables import check_some, is_number
from .soil import NUMBERS, Soil, as_soil

FIXED = {  # numbers that cannot change over time, and why
    "grain_size": "places that differ would wander",
    "clod_size": "crumbs would jump",
    "water_depth": "what is shown has one level for all frames",
}
_TAG, _VERSION = "desire_path_soil_keys", 1  # of a file
_MAX_BYTES = 1 << 24  # bytes of a file


@dataclass(frozen=True, init=False)
class SoilKeys:
    """A soil with keys: some of its numbers at times of the walk, each as pairs (time [s], value).

    Times count as those of the recording (Gait.time). Between two keys a number goes evenly from one to the other,
    before the first and after the last it stays; two keys at one time are a switch. Numbers without keys are `soil`'s.
    """

    soil: Soil
    keys: tuple[tuple[str, tuple[tuple[float, float], ...]], ...] = field(default=())

    def __init__(self, soil: str | Soil, keys: Mapping[str, Iterable[Sequence[float]]]) -> None:
        object.__setattr__(self, "soil", as_soil(soil))
        if not isinstance(keys, Mapping):
            raise DesirePathError('Keys of a soil go by name: give {"young_modulus": [[0, 2e6], [5, 4e5]]}.')
        object.__setattr__(self, "keys", tuple((name, _pairs(name, keys[name])) for name in NUMBERS if name in keys))
        for name in keys:
            if name not in NUMBERS:
                raise DesirePathError(f"No soil has '{str(name)[:40]}': choose keys of {', '.join(NUMBERS)}.")

    def at(self, time: float, after: bool = True) -> Soil:
        """The soil as it has become by a time [s]; after=False: where it switches then, as it was before."""
        return replace(self.soil, **{name: _value(pairs, time, after) for name, pairs in self.keys})

    def times(self) -> list[float]:
        """Of its keys, rising [s]; twice where it switches."""
        return _times(pairs for _, pairs in self.keys)

    def parameters(self) -> dict[str, Any]:
        """The numbers that tell this soil from others, and `keys`: of each number [[time, value], ..]."""
        return {**self.soil.parameters(), "keys": {name: [list(pair) for pair in pairs] for name, pairs in self.keys}}

    def changed(self, texts: Iterable[str]) -> SoilKeys:
        """The same keys on a soil with numbers from words `name=value`, as Soil.changed."""
        return SoilKeys(self.soil.changed(texts), dict(self.keys))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the keys alone as JSON, whole or not at all, for load()."""
        text = json.dumps({_TAG: _VERSION, **dict(self.keys)}, indent=2, default=float) + "\n"
        with atomic_file.file(path, "The keys of the soil", "w", encoding="utf-8") as stream:
            stream.write(text)

    @staticmethod
    def load(path: str | os.PathLike[str], soil: str | Soil) -> SoilKeys:
        """A soil with the keys of a file that save() wrote: `{"young_modulus": [[0, 2e6], [5, 4e5]]}` is one, too."""
        text = record.text_of(path, "file of a soil's keys", _MAX_BYTES)
        try:
            given = json.loads(text.decode("utf-8")) if len(text) <= _MAX_BYTES else None
        except (ValueError, RecursionError, MemoryError):
            given = None
        if not isinstance(given, dict) or given.pop(_TAG, _VERSION) != _VERSION or not given:
            raise DesirePathError(
                f'{path} holds no keys of a soil: write {{"young_modulus": [[0, 2e6], [5, 4e5]]}}, each key a time [s] '
                "and a value."
            )
        return SoilKeys(soil, given)


AnySoil = Soil | SoilKeys


def _pairs(name: str, keys: Any) -> tuple[tuple[float, float], ...]:
    """Keys of a number, checked."""
    try:
        pairs = tuple((time, value) for time, value in keys)
    except (TypeError, ValueError):
        pairs = ()
    if not pairs or not all(is_number(each) for pair in pairs for each in pair):
        raise DesirePathError(f"The keys of {name} are no pairs of a time and a value: give [[0, 2e6], [5, 4e5]].")
    times = [float(time) for time, _ in pairs]
    if not all(map(math.isfinite, times)) or times != sorted(times) or any(times.count(t) > 2 for t in set(times)):
        raise DesirePathError(
            f"The keys of {name} need times in seconds that rise: give each one once, or twice where it switches."
        )
    for _, value in pairs:
        check_some({name: value}, NUMBERS, "A soil's")
    values = {value for _, value in pairs}
    if name in FIXED and len(values) > 1:
        raise DesirePathError(f"A soil's {name} cannot change over time, since {FIXED[name]}: give it no keys.")
    return tuple((time, float(value)) for time, (_, value) in zip(times, pairs))


def _value(pairs: tuple[tuple[float, float], ...], time: float, after: bool) -> float:
    """Of a number at a time, between its keys."""
    side = bisect.bisect_right if after else bisect.bisect_left
    k = side(pairs, time, key=lambda pair: pair[0])
    if k == 0 or k == len(pairs):
        return pairs[max(k - 1, 0)][1]
    (t0, value), (t1, later) = pairs[k - 1 : k + 1]
    return later if t1 == time else value + (time - t0) / (t1 - t0) * (later - value)  # MODEL 6.10


def _times(keys: Iterable[Sequence[tuple[float, float]]]) -> list[float]:
    """All times of several keyed numbers, rising; twice where one of them switches."""
    most: Counter[float] = Counter()
    for pairs in keys:
        most |= Counter(time for time, _ in pairs)
    return sorted(most.elements())


def settle_times(
    soils: Sequence[AnySoil], read: Callable[[str, int, int, int, int], np.ndarray], at: np.ndarray
) -> np.ndarray:
    """tau of the soil in some cells at (n, 2) [s], as Simulation.settle_time tells it; read: Simulation.read."""
    taus = np.array([rows(soil)[0].settle_time for soil in soils])
    if len(taus) == 1:
        return np.full(len(at), taus[0])
    cells, number = np.unique(at, axis=0, return_inverse=True)
    kinds = np.array([int(read("soil", i, j, 1, 1)[0, 0]) for i, j in cells.tolist()])
    on = np.flatnonzero([np.isfinite(read("rest", i, j, 1, 1)[0, 0]) for i, j in cells.tolist()])
    for beside in np.setdiff1d(np.arange(len(cells)), on) if len(on) else ():
        away = ((cells[on] - cells[beside]) ** 2).sum(axis=1)
        kinds[beside] = kinds[on[away.argmin()]]
    return taus[kinds][number.reshape(-1)]


def rows(soil: AnySoil) -> list[Soil]:
    """All that it ever is, from key to key."""
    return table([soil])[0]


def table(soils: Sequence[AnySoil]) -> tuple[list[Soil], np.ndarray | None]:
    """(soils, times (T,) [s]) as the core takes them: with times, all soils at each of them; None: none changes."""
    times = _times(pairs for soil in soils if isinstance(soil, SoilKeys) for _, pairs in soil.keys)
    if not times:
        return [soil.soil if isinstance(soil, SoilKeys) else soil for soil in soils], None
    found: list[Soil] = []
    for time, later in zip(times, [*times[1:], math.inf]):
        found += [soil.at(time, later > time) if isinstance(soil, SoilKeys) else soil for soil in soils]
    return found, np.array(times)
