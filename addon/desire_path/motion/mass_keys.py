"""Keys on the masses of walkers, who get heavier or lighter while they walk: forces are as their mass."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..errors import DesirePathError

Keys = tuple[tuple[tuple[float, float], ...], ...]  # of each walker (time [s], mass [kg]), rising


def taken(keys: Sequence[Sequence[Sequence[float]]]) -> Keys:
    """Keys as they are kept; () where nobody has any."""
    found = tuple(tuple((float(time), float(kilograms)) for time, kilograms in each) for each in keys)
    return found if any(found) else ()


def check(keys: Keys, names: Sequence[str], come_and_go: bool, max_mass: float) -> None:
    """DesirePathError for keys that cannot be; come_and_go: walkers are not there all the time; max_mass: [kg]"""
    if len(keys) not in (0, len(names)):
        raise DesirePathError("The recording's mass keys are not those of its walkers: give some for each, or ().")
    if keys and come_and_go:
        raise DesirePathError("Only walkers who are there all the time can have keys on their mass: remove them.")
    for name, pairs in zip(names, keys):
        times = [time for time, _ in pairs]
        if not np.isfinite(times).all() or any(b <= a for a, b in zip(times, times[1:])):
            raise DesirePathError(f"The keys on the mass of {name} need times that rise.")
        for time, kilograms in pairs:
            if not 0 < kilograms <= max_mass:
                raise DesirePathError(
                    f"{name} has a mass of {kilograms:g} kg at {time:g} s: give it one above 0 and up to {max_mass:g}."
                )


def heavier(keys: Keys, mass: np.ndarray, time: np.ndarray) -> np.ndarray | None:
    """By how much each walker is heavier than its `mass` (W, T), evenly between two keys; None where nobody has any."""
    if not keys:
        return None
    out = np.ones((len(mass), len(time)))
    for w, pairs in enumerate(keys):
        if pairs:
            out[w] = np.interp(time, *np.array(pairs).T) / mass[w]
    return out
