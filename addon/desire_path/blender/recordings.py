"""recordings.py - while one button works, what a walker does is recorded once, however many parts of it ask.

    asked for --_depends--> a key --> a recording of before, else sample.record
Outside of kept() everything is recorded anew. A key holds all that the work of a button changes: the rest of the
scene is as it was until it ends.
"""

from contextlib import contextmanager

import numpy as np

from ..errors import DesirePathError
from ..motion.gait import Gait
from . import axes, bones, clock, compat, moves, sample, seams, worn

_kept = None  # recordings by key, while there is one to keep them


@contextmanager
def kept(store=None):
    """Keep recordings from here on: in those of before, where there are any, else in `store`, or in new ones."""
    global _kept
    before = _kept
    if _kept is None:
        _kept = {} if store is None else store
    try:
        yield
    finally:
        _kept = before


def current():
    """The recordings that are kept now, to be handed on; None where none are."""
    return _kept


def within(store, steps):
    """Go through steps with the recordings of a `store`, which others who work between two of them do not see."""
    if store is None:
        return (yield from steps)
    try:
        while True:
            with kept(store):
                try:
                    next(steps)
                except StopIteration as end:
                    return end.value
            yield
    finally:
        steps.close()


def record(scene, armature, frame_start, frame_end, samples=None, besides=seams.NOTHING):
    """sample.record() without a land, or what it was."""
    if _kept is None:
        return sample.record(scene, armature, frame_start, frame_end, samples, besides=besides)
    samples = samples or sample.samples_of(scene, [armature])
    try:
        key = (frame_start, frame_end, samples, besides, *_depends(scene, armature))
    except (DesirePathError, AttributeError):  # who cannot be recorded is told so below
        return sample.record(scene, armature, frame_start, frame_end, samples, besides=besides)
    if key not in _kept:
        _kept[key] = sample.record(scene, armature, frame_start, frame_end, samples, besides=besides)
    return _kept[key]


def gaits(scene, walkers, frame_start, frame_end):
    """sample.gaits() without a land, of what is kept."""
    samples = sample.samples_of(scene, walkers)
    besides = moves.besides(scene, walkers, frame_start, frame_end)
    found = [record(scene, each, frame_start, frame_end, samples, besides) for each in walkers]
    return Gait.join(seams.closed(found, besides))


def _depends(scene, armature):
    """What a recording is made from, as far as the work of a button may change it."""
    settings, feet = armature.desire_path, None
    sample.poses(armature)
    if armature.type == "ARMATURE" and settings.limbs != "ALL":
        shape = bones.skeleton(armature, axes.matrix(armature.matrix_world, armature.name), axes.unit_scale(scene))
        feet = repr(sample.rig(armature, shape))
    hanging = worn.hanging(scene, armature)
    movers = set().union(*(moves.movers(each) for each in (armature, *hanging)))
    rides = settings.ground if settings.ground is not None and moves.moves(settings.ground) else None
    return (
        scene.name_full,
        armature.name_full,
        (axes.unit_scale(scene), clock.frame_rate(scene), clock.stretch(scene)),
        feet,
        (settings.limbs, settings.mass, settings.mass_center, settings.contact_law, settings.tread),
        rides and rides.name_full,
        tuple(each.name_full for each in hanging),
        tuple(_motion(each) for each in scene.objects if each.type == "ARMATURE" and each in movers),
    )


def _motion(obj):
    """How an object is moved by its action, and where it is beside that."""
    animation = obj.animation_data
    action = animation.action if animation is not None else None
    facts = [obj.name_full, obj.delta_location[:], obj.delta_rotation_euler[:], obj.delta_rotation_quaternion[:]]
    if action is None:
        return tuple(facts)
    facts += [action.name_full, action.get(sample.PLACED)]
    for curve in compat.curves_played(animation):
        keys = np.empty((len(curve.keyframe_points), 2), np.float32)
        curve.keyframe_points.foreach_get("co", keys.ravel())
        cycles = [(each.cycles_before, each.cycles_after) for each in curve.modifiers if each.type == "CYCLES"]
        facts += [curve.data_path, curve.array_index, curve.extrapolation, keys.tobytes(), *cycles]
    return tuple(facts)
