"""trodden.py - which grounds a walk reaches, and who else walks on those: what is baked together.

    the active ground --walkers that tread it--> other grounds they tread --their walkers--> .. --> Company
A terrain cut into objects is one ground to those who cross it. Grounds nobody goes over to are left alone.
"""

from dataclasses import dataclass, field, replace

import bpy
import numpy as np

from ..errors import DesirePathError
from ..ground import parcels
from ..ground import parcels as fields
from ..ground.parcels import Parcel
from ..ground.sim import Simulation
from ..motion.gait import Gait
from . import auto, axes, ground, moves, paths, recordings, ride, sample, worn
from .chosen import grounds, walkers

ROUGH = 0.5  # a ground this near to the feet is looked at [m]
LOOKS = 8  # at how many frames grounds are looked at to see whether they move together ..
ALIKE = 1e-5  # .. that is, by the same but for rounding
SAME = 1e-4  # grounds that differ less are in the same place [m]
SCATTER = 3.0  # passes stray this far from their path [standard deviations]


@dataclass(frozen=True)
class Company:
    """Grounds that are baked together, and who walks on them, in the order of the scene."""

    grounds: tuple  # objects
    walkers: tuple  # armatures
    first: int  # scene frames
    last: int
    gait: object = None  # their recording, where it was made already
    warnings: tuple = ()
    beside: float = 0.0  # so far beside the feet some of the grounds may lie [m]


@dataclass(frozen=True, eq=False)
class _Track:
    """Where one walker goes in the frames of its ground."""

    walker: object
    first: int
    last: int
    gait: object = None
    places: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))  # (n, 3) [m]
    beside: float = 0.0  # so far beside the feet they are [m]
    problem: object = None  # why they are not known


def others(scene, obj):
    """Grounds of the scene that a bake of this one could reach: a walk is taken as its ground sees it, so that one that
    moves is left to those that move with it."""
    return [
        each for each in grounds(scene) if each != obj and worn.drawn(scene, each) and _move_alike(scene, obj, each)
    ]


def _barred(obj):
    """Why a ground takes no prints now; empty: it does."""
    if obj.library is not None:
        return (
            f"'{obj.name}' is linked from another file, and what is trodden of it stays as it is: make a library "
            "override of it."
        )
    if obj.mode == "EDIT":
        return f"'{obj.name}' is in Edit Mode, and what is trodden of it stays as it is: leave Edit Mode."
    return ""


def _move_alike(scene, one, other):
    if not (moves.moves(one) or moves.moves(other)):
        return True
    first, last = moves.frames(scene, one, walkers(scene, one))
    frames = sorted({first, *(round(first + k * (last - first) / LOOKS) for k in range(LOOKS + 1))})
    paths = [ride.path(scene, each, frames) if moves.moves(each) else np.eye(4) for each in (one, other)]
    return bool(np.abs(paths[0] - paths[1]).max() < ALIKE * max(1.0, np.abs(paths[0]).max()))


def company(scene, obj):
    """The Company of a ground, in steps between which others may work."""
    near = others(scene, obj)
    there = walkers(scene, obj)
    alone = Company((obj,), tuple(there), *moves.frames(scene, obj, there))
    homes = {walker: home for home in (obj, *near) for walker in walkers(scene, home)}
    if not near or not homes:
        return alone
    tracks = {}
    for walker, home in homes.items():
        tracks[walker] = _track(scene, walker, home, homes)
        if tracks[walker].problem is not None and home == obj:
            raise tracks[walker].problem
        yield
    parcels, warnings = {}, []
    for each in (obj, *near):
        try:
            parcel = _parcel(scene, each, tracks.values())
            if parcel is not None:
                parcels[each] = parcel
        except DesirePathError as problem:
            if each == obj:
                raise
            warnings.append(f"{problem} It is left as it is.")
        yield
    trodden = _trodden(tracks.values(), parcels)
    barred = {each for each in parcels if each != obj and _barred(each)}
    chosen, crew = _closure(obj, {walker: those - barred for walker, those in trodden.items()})
    warnings += [_barred(each) for each in barred if any(each in trodden[walker] for walker in crew)]
    crew |= {walker for walker in there if not trodden[walker]}  # who is told that nothing is there
    for walker in crew:
        if tracks[walker].problem is not None:
            raise tracks[walker].problem
    if len(chosen) == 1 and crew == set(there):
        return replace(alone, warnings=tuple(warnings))
    if not any(obj in trodden[walker] for walker in crew):
        if not there:
            return alone
        raise ground.Beside(
            f"The walk passes beside the ground '{obj.name}': move the walker or the ground so that one "
            "lies over the other."
        )
    # in an order that is the same for all of them
    crew = [tracks[each] for each in scene.objects if each in crew]
    chosen = tuple(each for each in scene.objects if each in chosen)
    first, last = _frames(chosen, crew)
    gait = None
    if all((each.first, each.last) == (first, last) and each.gait is not None for each in crew):
        gait = Gait.join([each.gait for each in crew])
    return Company(
        chosen,
        tuple(each.walker for each in crew),
        first,
        last,
        gait,
        tuple(warnings),
        max(each.beside for each in crew),
    )


def under(scene, walker, home, gait, frame):
    """(a Simulation of what lies below the recording of a walker of a ground, grounds it treads besides, sentences)."""
    cell = axes.typed(home.desire_path.cell_size)
    near = others(scene, home)
    track = _Track(walker, frame, frame, gait, parcels.around(gait), parcels.length(gait))
    found = {}
    for each in (home, *near) if near else ():
        parcel = _parcel(scene, each, [track])
        if parcel is not None:
            found[each] = parcel
    trodden = _trodden([track], found)[walker] if found else set()
    beside = tuple(each for each in scene.objects if each in trodden and each != home)
    if not beside:
        surface = ground.read(scene, home, cell, frame, box=ground.under(gait))
        return ground.land(surface, cell), (), surface.warnings
    there = [found[each] for each in scene.objects if each in trodden]
    there = [there[number] for number in parcels.storeys(there, gait)[0]]
    return Simulation(parcels.sewn(there, cell)[0], cell_size=cell), beside, ()


def follow(company):
    """Show the frames of a company in the panels of its grounds from now on, until they are set by hand."""
    for each in company.grounds:
        if each.desire_path.frames_auto:
            auto.set_auto(each.desire_path, frame_start=company.first, frame_end=company.last)


def _frames(chosen, crew):
    """The frames of grounds that are baked together: those set by hand, else those of all walkers."""
    hand = [each.desire_path for each in chosen if not each.desire_path.frames_auto]
    spans = [(each.frame_start, each.frame_end) for each in hand] or [(each.first, each.last) for each in crew]
    return min(span[0] for span in spans), max(span[1] for span in spans)


def _track(scene, walker, home, all_walkers):
    first, last = moves.frames(scene, home, walkers(scene, home))
    try:
        samples, besides = sample.samples_of(scene, all_walkers), moves.besides(scene, all_walkers, first, last)
        gait = recordings.record(scene, walker, first, last, samples, besides)
        if walker.desire_path.path is None:
            return _Track(walker, first, last, gait, parcels.around(gait), parcels.length(gait))
        line = paths.waypoints(scene, walker.desire_path.path, first)
        return _Track(
            walker,
            first,
            last,
            None,
            _beside(line, parcels.length(gait) + SCATTER * walker.desire_path.lateral),
            parcels.length(gait),
        )
    except DesirePathError as problem:
        return _Track(walker, first, last, problem=problem)


def _beside(line, wide):
    """Places along a line of points (n, 3), and `wide` [m] to both sides."""
    places = []
    for a, b in zip(line[:-1], line[1:]):
        steps = max(1, int(np.ceil(np.linalg.norm(b - a) / max(0.5 * wide, 0.01))))
        at = a + (b - a) * np.linspace(0.0, 1.0, steps + 1)[:, None]
        side = np.array([a[1] - b[1], b[0] - a[0], 0.0])
        side *= wide / max(np.linalg.norm(side), 1e-12)
        places += [at, at + side, at - side]
    return np.concatenate(places)


def _parcel(scene, obj, tracks):
    """The shape of a ground near the tracks; None: it is not near any."""
    scale = axes.unit_scale(scene)
    seen = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    world = np.array(seen.matrix_world, np.float64) * scale
    box = np.array([world[:2, :3] @ np.array(each[:]) + world[:2, 3] for each in seen.bound_box])
    close = [each.places[:, :2] for each in tracks if len(each.places)]
    close = [
        each
        for each in close
        if moves.moves(obj)  # it lies elsewhere now than at the first frame
        or (each.max(axis=0) + ROUGH >= box.min(axis=0)).all()
        and (each.min(axis=0) - ROUGH <= box.max(axis=0)).all()
    ]
    if not close:
        return None
    close = np.concatenate(close)
    first = min(each.first for each in tracks)
    try:
        surface = ground.read(
            scene,
            obj,
            axes.typed(obj.desire_path.cell_size),
            first,
            None,
            box=(*(close.min(axis=0) - ROUGH), *(close.max(axis=0) + ROUGH)),
        )
    except ground.Beside:
        return None
    return Parcel(surface.ground, name=obj.name)


def _trodden(tracks, parcels):
    """The grounds each walker goes over: those that are nearest to its feet in height somewhere. Of two in the same
    place it treads its own."""
    grounds_there = list(parcels)
    found = {}
    for track in tracks:
        found[track.walker] = set()
        if len(track.places) and grounds_there:
            height = fields.heights(list(parcels.values()), track.places[:, :2])
            away = np.abs(height - track.places[:, 2])
            home = track.walker.desire_path.ground
            if home in parcels:
                away[grounds_there.index(home)] -= SAME
            numbers = np.unique(fields.least(away))
            found[track.walker] = {grounds_there[number] for number in numbers if number >= 0}
    return found


def _closure(obj, trodden):
    """(grounds, walkers) that a ground is linked to: those who tread one of the grounds, and all they tread."""
    chosen, crew = {obj}, set()
    while True:
        more = {walker for walker, grounds_there in trodden.items() if grounds_there & chosen} - crew
        if not more:
            return chosen, crew
        crew |= more
        chosen = chosen.union(*(trodden[walker] for walker in more))
