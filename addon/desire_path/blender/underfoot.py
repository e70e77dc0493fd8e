"""underfoot.py - which of some meshes a walk goes over, and why it does not go over the others.

meshes, recordings of who walks --ground.read--> heights below the feet --> grounds, whose each is, reasons
"""

from dataclasses import dataclass

import numpy as np

from ..errors import DesirePathError
from ..ground import parcels
from ..ground.parcels import Parcel
from ..motion import size
from ..motion.points import point_places
from ..placement import cycle
from . import axes, ground

ABOVE = 0.5  # what is nowhere less far over the feet is not walked on [leg lengths]
STEP = 0.7  # of a walk [leg lengths]


@dataclass(frozen=True)
class Found:
    """Meshes to walk on."""

    grounds: tuple  # objects
    homes: tuple  # the one of them that each walker treads most
    sentences: tuple  # sentences about meshes that are not walked on


def choose(scene, meshes, gaits, frame, cell):
    """Which of some meshes recordings of one walker each go over; grounds of old stay grounds.

    frame: the first of the walk; cell: side of a cell [m]. Raises where none can be walked on and one is faulty.
    """
    boxes = np.array([ground.under(each) for each in gaits])
    box = (*boxes[:, :2].min(axis=0), *boxes[:, 2:].max(axis=0))
    feet = [_lowest(each) for each in gaits]
    legs = [float(size.legs(each).max()) for each in gaits]
    found, sentences, problem = {}, [], None
    for obj in meshes:
        try:
            why, below = _look(scene, obj, (feet, legs), frame, (cell, box))
        except ground.Beside:
            why, below = "the walk passes beside it", [np.full(len(each), np.nan) for each in feet]
        except DesirePathError as fault:
            problem = problem or fault
            sentences.append(f"'{obj.name}' is not walked on: {fault}")
            continue
        if why and not obj.desire_path.is_ground:
            sentences.append(f"'{obj.name}' is not walked on: {why}.")
        else:
            found[obj] = below
    if not found and problem is not None:
        raise problem
    there = tuple(found)
    homes = tuple(_home(there, [found[each][k] for each in there], feet[k]) for k in range(len(gaits)))
    return Found(there, homes, tuple(sentences))


def _lowest(gait):
    """Where the lowest point of the feet is (T, 3) [m]."""
    places = point_places(gait)
    return places[places[..., 2].argmin(axis=0), np.arange(places.shape[1])]


def _look(scene, obj, walks, frame, extent):
    """(why a mesh is not walked on or "", its heights below the feet of each walker (T,) [m], NaN beside it)

    walks: lowest points of the feet and leg lengths of all; extent: side of a cell [m], and the box to look at
    """
    feet, legs = walks
    wide = max(obj.dimensions.x, obj.dimensions.y) * axes.unit_scale(scene)
    parcel = Parcel(ground.read(scene, obj, extent[0], frame, box=extent[1]).ground, name=obj.name)
    below = [parcels.heights([parcel], each[:, :2])[0] for each in feet]
    if wide < STEP * min(legs):
        return f"it is {wide:.2g} m wide, which is less than a step", below
    if not any(np.isfinite(each).any() for each in below):
        return "the walk passes beside it", below
    over = [np.nanmin(up) for up in (h - each[:, 2] for h, each in zip(below, feet)) if np.isfinite(up).any()]
    if all(each > ABOVE * leg for each, leg in zip(over, legs)):
        return f"it lies {min(over):.2f} m above the feet", below
    return "", below


def _home(there, below, feet):
    """The ground that is nearest to the feet of a walker most of the time; None where there is none."""
    if not there:
        return None
    nearest = parcels.nearest(np.array(below), feet[:, 2])
    return there[int(np.bincount(nearest[nearest >= 0], minlength=len(there)).argmax())]


def upright(gait):
    """Refuse a walker whose feet are above its body most of the time."""
    if (point_places(gait)[..., 2].mean(axis=0) > gait.com[0, :, 2]).mean() > 0.5:
        raise DesirePathError(
            f"'{gait.walker_name[0]}' is turned over, its feet are above its body: turn it so that it stands upright."
        )


def level(gaits):
    """The height at which all of some recordings walk [m]; refuses those that walk at heights far apart."""
    floors = [cycle.floor(each) for each in gaits]
    low, high = int(np.argmin(floors)), int(np.argmax(floors))
    apart = floors[high] - floors[low]
    if apart > ABOVE * min(float(size.legs(each).min()) for each in gaits):
        raise DesirePathError(
            f"'{gaits[high].walker_name[0]}' walks {apart:.2f} m higher than '{gaits[low].walker_name[0]}', and no "
            "ground can be made for both: bring them to one height, or select the ground they walk on, too."
        )
    return floors[low]
