"""worn_changes.py - what moves with the feet and is not the same all the time: a walk has one pair of soles.

objects worn --off at some frames, another shape at some--> sentences
"""

import numpy as np

from . import moves
from .private import off_in_renders
from .worn import hanging, owners, skin

STIFF = 0.01  # a sole may change by so much of its size
LOOKS = (0.38, 1.0)  # shares of the walk after which the soles are looked at again


def sentences(scene, armature, feet, world, scale, frames, worn):
    """Sentences about what an armature wears at its feet and is off, or has another shape, at some frames of the walk
    only. worn: the worn.skin() it walks in, taken at the first frame, or None"""
    owner, notes = owners(armature, feet), []
    there = [
        obj
        for obj in hanging(scene, armature)
        if obj.parent_bone in owner or any(group.name in owner for group in obj.vertex_groups)
    ]
    for obj in there:
        if len(set(off_in_renders(scene, obj, frames))) > 1:
            notes.append(
                f"'{obj.name}' is off in renders at some of the frames: '{armature.name}' wears it at all of them "
                "where it walks."
            )
    if worn is not None and not notes and any(map(_may_change, there)):
        for share in LOOKS:
            later = skin(scene, armature, feet, world, scale, [frames[round(share * (len(frames) - 1))]])
            if later is None or not _alike(worn.vertices, later.vertices):
                notes.append(
                    f"What '{armature.name}' wears at its feet changes its shape between the frames, by keys, drivers "
                    f"or a modifier: its soles are as at frame {frames[0]:g}."
                )
                break
    return tuple(notes)


def _may_change(obj):
    """Whether keys, drivers or modifiers may make another shape of an object, beside the bones that carry it."""
    keys = obj.data.shape_keys if obj.type == "MESH" else None
    led = [
        each.animation_data for each in (obj, obj.data, keys) if each is not None and each.animation_data is not None
    ]
    return bool(led) or any(each.type != "ARMATURE" and moves.shapes_by_time(each) for each in obj.modifiers)


def _alike(one, other):
    size = float(np.ptp(one, axis=0).max())
    return one.shape == other.shape and float(np.abs(one - other).max()) <= STIFF * size
