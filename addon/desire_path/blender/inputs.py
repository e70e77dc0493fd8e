"""inputs.py - all a bake is made from, taken from Blender: the walk, the ground, its soils and plants.

    walkers --sample--> Gait --\\
    ground mesh --read--> Surface --> Bake, which only has to be run
    plants, settings ----------/
"""
from dataclasses import asdict, replace

from .. import sole
from ..errors import DesirePathError
from . import axes, ground, moves, plants, sample, way
from .op_walkers import walkers


def taken(scene, obj, there, first, last, **more):
    """Take them in steps, between which others may work; returns the Bake and the Surface it presses.

    there: the walkers; first, last: frames to bake; more: for the Bake
    """
    from ..bake import Bake  # the core is loaded when it is first needed
    settings = obj.desire_path
    cell = axes.typed(settings.cell_size)
    if way.goes(there):
        gait, surface = way.carried(scene, obj, there, cell, first, last)
        last = None  # every pass is shown
    else:
        gait = sample.gaits(scene, there, first, last)
        yield
        surface = ground.read(scene, obj, cell, first, last, box=ground.under(gait))
        gait = ground.walked(scene, there, gait, surface, cell, first, last)
    gait = replace(gait, warnings=(*gait.warnings, *sole.few_faces(gait, cell)))
    yield
    grown = plants.plantings(scene, obj)
    yield
    return Bake(gait, surface.ground, ground.soils(obj), cell_size=cell, frame_start=first, frame_end=last,
                load_model=there[0].desire_path.load_model, law=settings.law, heap=settings.heap,
                threads=settings.threads, origin=surface.origin, plants=grown,
                plant_mesh=settings.plant_mesh and bool(grown), **more), surface


def now(scene, obj):
    """The marks of what a ground would be baked from now."""
    there = walkers(scene, obj)
    if not there:
        raise DesirePathError(f"Nobody walks on '{obj.name}' any more.")
    steps = taken(scene, obj, there, *moves.frames(scene, obj, there))
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return marks(obj, there, *end.value)


def marks(obj, there, made, surface):
    """A word for each part a bake is made from, another one when that part is; names do not count."""
    from .. import mesh
    gait, settings = made.gait, obj.desire_path
    walk = [gait.time, gait.com, gait.mass, gait.pose, gait.limb_walker, gait.part_limb, gait.point, gait.point_part,
            gait.point_role, gait.cut]
    for sole in gait.soles:
        walk += [sole.vertices, sole.triangles]
    grown = [each for planting in made.plants for each in planting.arrays()]
    options = {name: value for name, value in made.options.items() if name != "origin"}  # follows from the ground
    chosen = [made.cell_size, made.frame_start, made.frame_end, made.frame_rate, made.film, options,
              sorted({each.desire_path.load_model for each in there}), [asdict(soil) for soil in made.soils],
              made.plant_mesh, settings.attributes, settings.vertex_group]
    return {"walk": mesh.mark(walk), "ground": surface.mark,
            "plants": mesh.mark(grown, [planting.told() for planting in made.plants]),
            "settings": mesh.mark((), chosen)}
