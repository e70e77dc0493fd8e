"""What a bake says of what happened: on all its grounds together, and on each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..ground import parcels as fields
from ..ground.sim import Simulation
from ..ground.soil_keys import AnySoil, rows
from ..version import VERSION
from .plan import Plan
from .share import Share

RIGID = 0.94  # share of the layer: pressed this deep, soil is nearly as deep as it can be
RIGID_GROUND = "A print reaches the rigid ground under the soil: check the walker's mass, or choose a firmer soil."
BESIDE = "reach over its edge, and leave no print there"  # also of those that are counted step by step
VOLUMES = (  # of a run's ledger: heaped + carried + left = displaced + loosened - pressed heaps [m^3], MODEL 11.3
    "pressed_m3",
    "pressed_heap_m3",
    "heaped_m3",
    "displaced_m3",
    "loosened_m3",
    "rebounded_m3",
)
SPRAY = ("thrown_m3", "stuck_m3", "airborne_m3", "beside_m3")  # what came off, sticks, flies, fell by the ground
CARRIED = ("carried_m3", "left_m3")  # of soils that stick: on soles at the end, and where they left it [m^3]
OF_ONE = ("contacts", "deepest_m", *VOLUMES)


def summary(
    plan: Plan, sims: Sequence[Simulation], seconds: Mapping[str, float], before: Sequence[str], after: Sequence[str]
) -> dict[str, Any]:
    """Of all grounds together. seconds: spent, by stage; before, after: sentences beside those about the grounds."""
    found = [sim.report() for sim in sims]
    left = [each for sim in sims for each in sim.warnings]
    warnings = list(dict.fromkeys([*before, *left, *after]))
    layers = [layer_of(sim.soils) for sim in sims]
    planted = any(parcel.plants for parcel in plan.parcels)
    return {
        "passes": len(plan.passes),
        **happened(found, planted, bool(plan.options.spray), carried(sims)),
        "seconds": round(seconds["total"], 3),
        "stages": {name: round(spent, 3) for name, spent in seconds.items()},
        "warnings": [*warnings, *hints(found, layers, warnings)],
        "version": VERSION,
        "parameters": plan.parameters(plan.parcels[0]),
    }


def layer_of(soils: Sequence[AnySoil]) -> float:
    """How deep the thinnest of some soils ever is [m]."""
    return min(row.layer_depth for soil in soils for row in rows(soil))


def carried(sims: Sequence[Simulation]) -> dict[str, float]:
    """How much sticks to soles and was carried on, of all soils that stick; empty: none does."""
    stick = [soil for sim in sims for soil in sim.carried().values()]
    return {name: sum(soil[name] for soil in stick) for name in CARRIED} if stick else {}


def happened(
    found: Sequence[Mapping[str, Any]], planted: bool, sprayed: bool, carried: Mapping[str, float]
) -> dict[str, Any]:
    """What several Simulations tell of themselves, together, and what is carried()."""
    total = {name: sum(each[name] for each in found) for name in found[0]}
    return {
        "contacts": total["contacts"],
        "deepest_m": max(each["deepest_m"] for each in found),
        **{name: total[name] for name in VOLUMES},
        **({f"spray_{name}": total[name] for name in SPRAY} if sprayed else {}),
        **carried,
        **({"plants": total["plants"], "broken_bends": total["broke"]} if planted else {}),
    }


def hints(found: Sequence[Mapping[str, Any]], layers: Sequence[float], warnings: Sequence[str]) -> list[str]:
    """Sentences about what they tell, beside those there are; layers: as deep as each can be pressed [m]."""
    more = []
    if any(each["deepest_m"] >= RIGID * layer for layer, each in zip(layers, found)):
        more.append(RIGID_GROUND)
    if any(each["off_ground"] for each in found) and not any(BESIDE in each for each in warnings):
        more.append(f"Feet on the ground {BESIDE}: make the ground larger, or move it under the walk.")
    return more


def of_share(plan: Plan, share: Share, shares: Sequence[Share], in_all: dict[str, Any]) -> dict[str, Any]:
    """The report of one of the shares: of several grounds what happened on it, and `in_all`, that of all of them."""
    if len(plan.parcels) == 1:
        return in_all
    end = plan.sample(plan.frame_end) + 1
    return {
        "contacts": fields.contacts(share.parcel, plan.stepped, share.loads, end, plan.parcels),
        **share.numbers(),
        "with": [each.parcel.name for each in shares if each is not share],
        "in_all": {name: in_all[name] for name in OF_ONE},
        **{name: value for name, value in in_all.items() if name not in OF_ONE},
        "parameters": plan.parameters(share.parcel),
    }
