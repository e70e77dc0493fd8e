"""What the forces of a recording come to: each contact of each foot, and a walker's numbers.

Gait, FootForce ---contacts---> [Contact] ---summary---> a dict for each walker, contacts.csv
"""

from __future__ import annotations

import csv
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..files import atomic_file
from ..motion.gait import Gait
from .force import FootForce
from .plot import foot_loads, spans
from .walker import GRAVITY

COLUMNS = "walker,limb,start,end,duration,peak,mean,impulse,x,y,z"


@dataclass(frozen=True)
class Contact:
    """One stay of one limb on the ground."""

    walker: int
    limb: int
    start: float  # [s]
    end: float  # [s]
    peak: float  # largest vertical force on the ground [N]
    mean: float  # mean vertical force [N]
    impulse: float  # of the vertical force [N s]
    place: tuple[float, float, float]  # mean centre of pressure, by force; NaN without force [m]


def contacts(gait: Gait, loads: FootForce) -> list[Contact]:
    """Every Contact, in the order in which they begin."""
    force, touching = foot_loads(gait, loads)
    found = []
    for limb, walker in enumerate(gait.limb_walker):
        newtons = force[limb] * gait.mass[walker] * GRAVITY
        middle = pressure_centre(gait, loads, limb)
        for start, end in spans(touching[limb], loads.time):
            during = (loads.time >= start) & (loads.time <= end)
            weight = np.where(np.isfinite(middle[during, 0]), np.maximum(newtons[during], 0.0), 0.0)
            place = np.full(3, np.nan)
            if weight.sum() > 0.0:
                place = (weight[:, None] * np.nan_to_num(middle[during])).sum(axis=0) / weight.sum()
            mean = float(newtons[during].mean())
            found.append(
                Contact(
                    int(walker),
                    limb,
                    start,
                    end,
                    float(newtons[during].max()),
                    mean,
                    mean * (end - start),
                    (float(place[0]), float(place[1]), float(place[2])),
                )
            )
    return sorted(found, key=lambda each: (each.start, each.limb))


def pressure_centre(gait: Gait, loads: FootForce, *limbs: int) -> np.ndarray:
    """Where these limbs press together: their parts' centres of pressure by vertical force (T, 3) [m]; NaN in
    the air."""
    moment, weight = np.zeros((len(loads.time), 3)), np.zeros((len(loads.time), 1))
    for part in np.flatnonzero(np.isin(gait.part_limb, limbs)):
        known = np.isfinite(loads.point[part]).all(axis=1) & (loads.touching[part] != 0)
        share = np.where(known, np.maximum(-loads.force[part, :, 2], 0.0), 0.0)[:, None]
        moment += share * np.where(known[:, None], loads.point[part], 0.0)
        weight += share
    return np.where(weight > 0.0, moment / np.maximum(weight, 1e-12), np.nan)


def summary(gait: Gait, loads: FootForce) -> list[dict[str, Any]]:
    """For each walker a dict: contacts, cadence [1/min], mean force and peak [body weights], speed [m/s], share
    of the time in the air, and the warnings of all."""
    force, touching = foot_loads(gait, loads)
    stays = contacts(gait, loads)
    lasts = float(loads.time[-1] - loads.time[0])
    numbers: list[dict[str, Any]] = []
    for w, name in enumerate(gait.walker_name):
        limbs = gait.limb_walker == w
        steps = [each for each in stays if each.walker == w and each.start > loads.time[0]]
        starts = [each.start for each in steps]
        # a cadence is known once a foot comes down again: two that land together are no steps
        again = len({each.limb for each in steps}) < len(steps)
        travelled = np.linalg.norm(np.diff(gait.com[w, :, :2], axis=0), axis=1)
        travelled[gait.cuts_of([w]) - 1] = 0.0
        total = force[limbs].sum(axis=0)
        numbers.append(
            {
                "walker": name,
                "mass_kg": float(gait.mass[w]),
                "contacts": sum(each.walker == w for each in stays),
                "cadence_per_min": (
                    60.0 * (len(starts) - 1) / (starts[-1] - starts[0]) if again and starts[-1] > starts[0] else None
                ),
                "mean_force_bw": float(loads.mean[w]) if loads.mean is not None else float(total.mean()),
                "peak_force_bw": float(force[limbs].max(initial=0.0)),
                "speed_m_s": float(travelled.sum() / lasts) if lasts > 0.0 else 0.0,
                "air_share": float((~touching[limbs].any(axis=0)).mean()),
                "warnings": list(dict.fromkeys(gait.warnings + tuple(loads.warnings))),
            }
        )
    return numbers


def sentences(numbers: Mapping[str, Any]) -> list[str]:
    """A walker's numbers in words, a line each."""
    lines = [
        f"{numbers['contacts']} contacts"
        + (f", {numbers['cadence_per_min']:.0f} a minute" if numbers["cadence_per_min"] else "")
        + f", {numbers['speed_m_s']:.2f} m/s",
        f"Mean force {numbers['mean_force_bw']:.2f} body weights, largest of a foot {numbers['peak_force_bw']:.2f}",
    ]
    if numbers["air_share"] >= 0.005:
        lines.append(f"In the air for {100 * numbers['air_share']:.0f} % of the time")
    return lines


def write_contacts(path: str | os.PathLike[str], gait: Gait, loads: FootForce) -> None:
    """The table `walker,limb,start,end,duration,peak,mean,impulse,x,y,z`, a row a contact; s, N, N s, m."""

    def number(x: float) -> str:
        return f"{x + 0.0:.9g}" if np.isfinite(x) else ""

    with atomic_file.file(path, "The table of contacts", "w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(COLUMNS.split(","))
        for each in contacts(gait, loads):
            table.writerow(
                [gait.walker_name[each.walker], gait.limb_name[each.limb]]
                + [
                    number(x)
                    for x in (
                        each.start,
                        each.end,
                        each.end - each.start,
                        each.peak,
                        each.mean,
                        each.impulse,
                        *each.place,
                    )
                ]
            )
