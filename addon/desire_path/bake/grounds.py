"""The grounds of a bake, with the walk and its loads on them: a Simulation of each storey, a Share of each ground."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Sequence
from typing import Any

from ..errors import DesirePathError
from ..ground import parcels as fields
from ..ground.parcels import Parcel
from ..ground.sim import TILE, Ground, Simulation
from ..loads import walker
from ..loads.force import FootForce
from ..motion.gait import Gait
from .options import BakeOutput
from .plan import Plan
from .share import Share

CHANGE = 0.3  # around a sole a step can change the ground so far away [m]
BESIDE = "The walk passes beside the ground: move the walker or the ground so that one lies over the other."


def parcels_of(
    ground: Ground | Iterable[Parcel], soils: object, folder: str | os.PathLike[str], plants: object, output: BakeOutput
) -> list[Parcel]:
    """The Parcels of a bake, from one ground or a list of them."""
    if isinstance(ground, Ground):
        more = {"plant_mesh": output.plant_mesh, "owner": output.owner, "inputs": dict(output.inputs or {})}
        given: dict[str, Any] = {"soils": soils, "folder": os.fspath(folder), "plants": plants, **more}
        return [Parcel(ground, **given)]
    parcels = list(ground) if isinstance(ground, Iterable) else []
    if not parcels or not all(isinstance(each, Parcel) for each in parcels):
        raise DesirePathError("A bake needs a Ground, or a list of Parcels.")
    folders: dict[str, Parcel] = {}
    for each in parcels:
        other = folders.setdefault(each.folder, each)
        if other is not each:
            raise DesirePathError(
                f"'{other.name}' and '{each.name}' bake into the same folder: choose another one for either."
            )
    return parcels


def simulations(plan: Plan) -> tuple[list[Simulation], FootForce, list[Share]]:
    """(the Simulation of each storey with the walk on it, its loads on all, the Shares of grounds it reaches)."""
    gait = plan.stepped
    storeys = [[plan.parcels[number] for number in storey] for storey in fields.storeys(plan.parcels, plan.gait)]
    sims = [_simulation(plan, storey) for storey in storeys]
    tau: Any = sims[0].settle_time  # of TRAIL (3)
    walks = walker.Walker(plan.options.load_model, settle_time=tau, cell=plan.cell_size)
    if len(sims) == 1:
        loads = walks.loads(gait, sims[0].rest_height)
        each = [loads]
    else:
        over, below = fields.treads(gait, [sim.rest_height for sim in sims])
        loads = walks.loads(gait, below)
        each = [fields.on(loads, over, number) for number in range(len(sims))]
    shares = []
    for sim, storey, here in zip(sims, storeys, each):
        sim.load(gait, here)
        for parcel in storey:
            tiles = _tiles(plan, sim, parcel, gait, here)
            if tiles is not None:
                shares.append(Share(plan, parcel, sim, here, tiles))
    if not shares:
        if any(i0 < i1 for i0, i1, _, _ in (sim.reach() for sim in sims)):
            raise DesirePathError(BESIDE)
        raise DesirePathError(
            "No foot touches the ground in these frames: check that the walker stands on it and the scale is right."
        )
    return sims, loads, shares


def _simulation(plan: Plan, storey: Sequence[Parcel]) -> Simulation:
    """Of parcels that lie beside each other."""
    ground, soils = fields.sewn(storey, plan.cell_size)
    planted: list[Any] = [(parcel.plants, parcel.has) for parcel in storey]
    plants = [(planting, has) for plantings, has in planted for planting in plantings]
    return Simulation(
        ground,
        soils,
        plan.cell_size,
        plants=[each for each, _ in plants],
        areas=[has for _, has in plants] if len(storey) > 1 else None,
        options=plan.options,
    )


def _tiles(plan: Plan, sim: Simulation, parcel: Parcel, gait: Gait, loads: Any) -> tuple[int, int, int, int] | None:
    """Tiles (x, y, nx, ny) the frames of a parcel cover: what the walk can reach of it; None: nothing."""
    i0, i1, j0, j1 = sim.reach()
    x0, y0, x1, y1 = sim.bounds()
    cell, (ox, oy) = sim.cell_size, sim.origin
    if len(plan.parcels) > 1:
        wide = CHANGE + max((each.kind.reach + each.kind.height for each in sim.plantings), default=0.0)
        box = fields.under(parcel, gait, loads, wide)
        if box is None:
            return None
        x0, y0 = max(x0, box[0] - cell), max(y0, box[1] - cell)  # with a cell of its neighbours
        x1, y1 = min(x1, box[2] + cell), min(y1, box[3] + cell)
    if parcel.ground.trail is not None:  # what was pressed before is shown, too
        a0, a1, b0, b1 = parcel.ground.trail.cells(cell, sim.origin)
        if a0 < a1 and i0 < i1:
            i0, i1, j0, j1 = min(i0, a0), max(i1, a1), min(j0, b0), max(j1, b1)
            if len(plan.parcels) > 1:
                x0, x1 = min(x0, ox + a0 * cell), max(x1, ox + a1 * cell)
                y0, y1 = min(y0, oy + b0 * cell), max(y1, oy + b1 * cell)
    if math.isfinite(x0):
        i0 = max(i0, math.floor((x0 - ox) / cell))
        i1 = min(i1, math.ceil((x1 - ox) / cell))
        j0 = max(j0, math.floor((y0 - oy) / cell))
        j1 = min(j1, math.ceil((y1 - oy) / cell))
    if i0 >= i1 or j0 >= j1:
        return None
    tx0, ty0 = i0 // TILE, j0 // TILE
    tx1, ty1 = -(-i1 // TILE), -(-j1 // TILE)
    return tx0, ty0, tx1 - tx0, ty1 - ty0
