"""inputs.py - all a bake is made from, taken from Blender: the walk, the ground, its soils and plants.

    walkers --sample--> Gait --\\
    ground mesh --read--> Surface --> Bake, which only has to be run
    plants, settings ----------/
"""
from . import axes, ground, plants, sample, way


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
    yield
    grown = plants.plantings(scene, obj)
    yield
    return Bake(gait, surface.ground, ground.soils(obj), cell_size=cell, frame_start=first, frame_end=last,
                load_model=there[0].desire_path.load_model, law=settings.law, heap=settings.heap,
                threads=settings.threads, origin=surface.origin, plants=grown,
                plant_mesh=settings.plant_mesh and bool(grown), **more), surface
