"""inputs.py - all a bake is made from, taken from Blender: the walk, the grounds, their soils and plants.

    walkers --sample--> Gait --------------\\
    ground meshes --read--> Surfaces -------> Bake, which only has to be run
    plants, settings --> Parcels ----------/
"""

import os
from dataclasses import replace

import numpy as np

from ..bake.bake import Bake
from ..bake.contents import MAPS_ALWAYS
from ..bake.options import BakeOptions, BakeOutput
from ..errors import DesirePathError
from ..ground import maps, mesh, parcels
from ..ground.options import SimulationOptions
from ..ground.parcels import Parcel
from ..ground.sim import Simulation, check_cell
from ..loads.force import GRAVITY
from ..rig import sole
from . import axes, bodies, ground, layered, paths, plants, playback, pressed, recordings, soil_keys, sprays, trodden

ALIKE = {  # settings that grounds baked together share
    "law": "contact law",
    "heap": "way to heap soil",
    "spray": "spray",
    "spray_amount": "amount of spray",
}
ROUNDED = 4e-7  # rounding moves points no farther, in shares of their distance from the origin


def taken(scene, company, folders, **more):
    """Take them in steps, between which others may work; returns the Bake and the Surface of each ground it presses, by
    name.

    company: the trodden.Company that is baked; folders: (path, id of its owner) of each of its grounds; more: for Bake
    """
    grounds, walkers, first, last = company.grounds, company.walkers, company.first, company.last
    settings = grounds[0].desire_path
    check(grounds, walkers)
    cells = [axes.typed(each.desire_path.cell_size) for each in grounds]
    for each in cells:
        check_cell(each)
    cell, end = min(cells), last
    on_paths = paths.goes(walkers)
    if on_paths:
        found = {}

        def land(box):
            found.update(_read(scene, company, cell, box))
            return _land(found, None, cell)

        gait = paths.carried(scene, walkers, first, last, land)
        last = None  # every pass is shown
    else:
        gait = company.gait or recordings.gaits(scene, walkers, first, last)
        yield
        found = _read(scene, company, cell, ground.under(gait))
        if any(np.ptp(each.vertices[:, 2]) >= ground.LEVEL for each in found.values()) or any(
            each.desire_path.place_feet for each in walkers
        ):
            gait = ground.walked(scene, walkers, gait, _land(found, gait, cell), first, last)
    gait = bodies.laws(walkers, gait, lambda: _land(found, gait, cell))
    keys = soil_keys.uncounted(grounds, on_paths)
    gait = replace(gait, warnings=(*gait.warnings, *sole.few_faces(gait, cell), *keys))
    origin = next((each.origin for each in found.values() if each.origin != (0.0, 0.0)), (0.0, 0.0))
    if len(found) > 1 and any(ground.smooth(each.vertices, cell, origin) for each in found.values()):
        found = {name: replace(each, between=True) for name, each in found.items()}
    yield
    parcels = []
    for each, (path, owner) in zip(grounds, folders):
        grown = plants.plantings(scene, each)
        own = soil_keys.of_ground(scene, each, first, first if on_paths else end)
        layered.check_keys(scene, each, own, first, first if on_paths else end)
        parcels.append(
            Parcel(
                pressed.start(each, found[each.name].ground),
                own,
                path,
                each.name,
                grown,
                each.desire_path.plant_mesh and bool(grown),
                owner,
            )
        )
        yield
    gait = bodies.wading(walkers, gait, parcels, cell, settings.law, origin)
    return Bake(
        gait,
        parcels,
        cell_size=cell,
        options=BakeOptions(
            law=settings.law,
            heap=settings.heap,
            origin=origin,
            threads=settings.threads,
            spray=sprays.of_ground(settings),
            load_model=walkers[0].desire_path.load_model,
            memory=1e9 * settings.memory_limit or None,
        ),
        output=BakeOutput(frame_start=first, frame_end=last, **more),
    ), found


def now(scene, obj):
    """The marks of what a ground would be baked from now, and the Surface of each ground baked with it, by name."""
    company = _all(trodden.company(scene, obj))
    if not company.walkers:
        raise DesirePathError(f"Nobody walks on '{obj.name}' any more.")
    bake, found = _all(taken(scene, company, [(str(number), "") for number in range(len(company.grounds))]))
    return marks(obj, company, bake, found), found


def was_applied(obj, index, now, found):
    """Whether all that was done to a ground that is baked alone is that its scale, rotation or location was applied:
    it has other numbers, and lies where it lay but for rounding.

    index: the FrameIndex of its bake; now, found: as now() gives them
    """
    before = index.inputs
    if before.get("placed") == now["placed"] or before.get("painted") != now["painted"] or len(found) > 1:
        return False  # bakes of earlier versions tell neither
    if playback.is_moved(obj):
        return False
    (surface,) = found.values()
    try:
        before = maps.read(os.path.join(os.path.dirname(index.folder), MAPS_ALWAYS[0])).planes["rest"]
        shape = replace(surface.ground, native=(*surface.ground.native[:3], None))
        land = Simulation(shape, cell_size=index.cell, options=SimulationOptions(origin=(index.x0, index.y0)))
        with land:
            base = land.read("rest", 0, 0, index.nx, index.ny)
    except (DesirePathError, KeyError):
        return False
    far = max(np.abs(surface.vertices).max(initial=1.0), 1.0)
    return before.shape == base.shape and bool(np.allclose(before, base, rtol=0.0, atol=ROUNDED * far, equal_nan=True))


def _all(steps):
    """What steps come to, taken at once."""
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value


def marks(obj, company, bake, found):
    """A word for each part a bake is made from, another one when that part is; names do not count.

    made, found: the Bake and its Surfaces, as taken() gives them
    """
    gait, settings = bake.gait, obj.desire_path
    walk = [
        gait.time,
        gait.com,
        gait.pose,
        gait.limb_walker,
        gait.part_limb,
        gait.point,
        gait.point_part,
        gait.point_role,
        gait.cut,
    ]
    laws = repr(gait.contact_law) if gait.contact_law else ""
    for each in gait.soles:
        walk += [each.vertices, each.triangles]
    plantings = sorted(
        (each for parcel in bake.parcels for each in parcel.plants), key=lambda each: repr(each.parameters())
    )
    grown = [each for planting in plantings for each in planting.arrays()]
    options = {name: getattr(bake.options, name) for name in ("law", "heap", "rim_width")}  # the rest does not show
    if bake.options.spray is not None:
        options["spray"] = bake.options.spray.parameters()
    soils = sorted(([soil.parameters() for soil in parcel.soils] for parcel in bake.parcels), key=repr)
    lie = [each for each in map(layered.parameters, company.grounds) if each]
    chosen = [
        bake.cell_size,
        bake.frame_start,
        bake.frame_end,
        bake.frame_rate,
        bake.film,
        options,
        sorted({each.desire_path.load_model for each in company.walkers}),
        soils,
        settings.plant_mesh and bool(settings.plants),
        settings.attributes,
        settings.vertex_group,
        sum(each.desire_path.place_feet for each in company.walkers),
        *([sorted(lie, key=repr)] if lie else []),
    ]
    trails = [parcel.ground.trail for parcel in bake.parcels if parcel.ground.trail is not None]
    left = [array for trail in trails for array in trail.arrays()]
    return {
        "walk": mesh.mark(
            walk, [*(f"{mass:.9g}" for mass in gait.mass), *map(repr, gait.mass_keys), *filter(None, [laws])]
        ),
        "ground": mesh.mark(left, sorted(found[parcel.name].mark for parcel in bake.parcels)),
        "painted": mesh.mark(left, sorted(found[parcel.name].painted for parcel in bake.parcels)),
        "placed": mesh.mark((), sorted((each.world * each.scale).tolist() for each in found.values())),
        "plants": mesh.mark(grown, [planting.parameters() for planting in plantings]),
        "settings": mesh.mark((), chosen),
    }


def check(grounds, walkers):
    """Refuse grounds and walkers that cannot be baked together, in a sentence."""
    if len({each.desire_path.load_model for each in walkers}) > 1:
        raise DesirePathError("The walkers of one ground need the same load model: choose one for all of them.")
    one = grounds[0]
    for other in grounds[1:]:
        for name, words in ALIKE.items():
            if getattr(one.desire_path, name) != getattr(other.desire_path, name):
                raise DesirePathError(
                    f"The walk crosses '{one.name}' and '{other.name}', which need the same {words}: "
                    "choose one for both."
                )


def gravity_of(scene):
    """A sentence where somebody gave the scene another gravity than prints are pressed by."""
    if not scene.use_gravity:
        return []
    typed = float(np.linalg.norm(scene.gravity))
    drawn = typed * axes.unit_scale(scene)
    if min(abs(typed - GRAVITY), abs(drawn - GRAVITY)) < 0.05 * GRAVITY:  # in small units many leave it as it is
        return []
    return [
        f"The gravity of the scene is {drawn:.3g} m/s2, but prints are pressed by the Earth's, {GRAVITY:g} m/s2: for "
        f"the prints of that weight give walkers {drawn / GRAVITY:.2g} times their mass."
    ]


def warnings_of(company):
    """Sentences about what grounds that are baked together do not keep of their own."""
    cells = {each.name: axes.typed(each.desire_path.cell_size) for each in company.grounds}
    finest = min(cells, key=cells.get)
    coarser = [f"'{name}'" for name, cell in cells.items() if cell > cells[finest]]
    if not coarser:
        return []
    return [
        f"The walk crosses '{finest}' with cells of {cells[finest]:g} m and {', '.join(coarser)} with larger ones: "
        f"all are pressed in cells of {cells[finest]:g} m."
    ]


def _read(scene, company, cell, box):
    """The Surface of each ground of a company within a box of the world, by name."""
    wide = company.beside
    box = (box[0] - wide, box[1] - wide, box[2] + wide, box[3] + wide)
    return {each.name: ground.read(scene, each, cell, company.first, company.last, box=box) for each in company.grounds}


def _land(found, gait, cell):
    """A Simulation of the shape of surfaces; of those over each other the ones that feet tread most."""
    if len(found) == 1:
        return ground.land(*found.values(), cell)
    there = [parcels.Parcel(each.ground, name=name) for name, each in found.items()]
    if gait is not None:
        there = [there[number] for number in parcels.storeys(there, gait)[0]]
    return Simulation(parcels.sewn(there, cell)[0], cell_size=cell)
