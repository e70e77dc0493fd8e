"""sample.py - Blender is asked what the armature did, once, in a scene of its own.

    armature --private scene, whole frames--> Skeleton, Motion, Skin --body.py--> Gait

The private scene holds only the armature (Blender brings along what it depends on), so that a heavy
character costs nothing and the user's frame stays where it is.
"""

import json
import math
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from ..errors import DesirePathError
from ..motion.gait import AUTO, Gait
from ..rig import body, limbs, mass, rigs, solid
from ..rig.foot import FootShape
from . import axes, bones, clock, compat, moves, physics, playback, ride, seams, soil_keys, worn_changes
from .private import evaluated, looked_at, off_in_renders
from .worn import skin, tread

FARTHEST = 1e6  # a body that is farther from the origin was lost [m]
USUAL_MASS = 75.0  # of who carves and has none, which nobody asks for [kg]
STIFF = 0.01  # a rigid body may change by so much of its size
PLACED = "desire_path_placed"  # on an action that Place Feet made: the FootShape of each foot bone


@contextmanager
def still(obj):
    """Grounds this rig is bound to (by shrinkwrap, say), or this body falls on, as they were before any bake."""
    bound = list(obj.constraints)
    for bone in obj.pose.bones if obj.pose else ():
        bound += bone.constraints
    targets = {getattr(each, "target", None) for each in bound} - {None} | physics.others(obj)
    ours = [m for m in map(playback.modifier, targets) if m is not None and m.show_viewport]
    for each in ours:
        each.show_viewport = False
    try:
        yield
    finally:
        for each in ours:
            each.show_viewport = True


# ---- the armature ----------------------------------------------------------------------------------


def rig(armature, shape):
    """The feet and the mass centre chosen for this walker, else those the rig table finds."""
    settings = armature.desire_path
    found = _chosen(armature, shape) if settings.feet else rigs.detect(shape)
    if settings.mass_center:
        _known(armature, shape, settings.mass_center)
        one_part = rigs.Segment("body", 1.0, 0.0, ((settings.mass_center, 0.0),))
        found = replace(found, segments=(one_part,))
    return found


def _known(armature, shape, name):
    if name not in shape.names:
        raise DesirePathError(
            f"'{armature.name}' has no bone '{name}', it may have been renamed or removed: press Find "
            "Feet to find the feet anew, or choose the bone by hand."
        )


def _chosen(armature, shape):
    settings = armature.desire_path
    feet = []
    for each in settings.feet:
        names = {name: getattr(each, name) or None for name in ("foot", "toe", "heel", "thigh", "shank")}
        for name in filter(None, list(names.values()) + [settings.hips]):
            _known(armature, shape, name)
        if names["foot"] is None:
            raise DesirePathError(
                f"The {each.limb} foot of '{armature.name}' has no foot bone: choose one, or press Find Feet."
            )
        if not (names["thigh"] or names["shank"]):
            names["thigh"], names["shank"] = rigs.legs(shape, names["foot"])
        for other in feet:
            if other.foot == names["foot"]:
                raise DesirePathError(
                    f"Bone '{other.foot}' of '{armature.name}' is both the {other.limb} foot and "
                    f"the {each.limb} foot: choose another for one of them."
                )
        feet.append(rigs.Foot(each.limb, **names))
    return rigs.build(shape, feet, settings.hips or None)


def poses(armature):
    """Refuse an armature that shows its rest pose whatever its keys say."""
    if armature.type == "ARMATURE" and armature.data.is_editmode:
        raise DesirePathError(f"'{armature.name}' is in Edit Mode, in which it stands still: leave Edit Mode first.")
    if armature.type == "ARMATURE" and armature.data.pose_position == "REST":
        raise DesirePathError(
            f"'{armature.name}' is set to Rest Position, in which it stands still: choose Pose Position "
            "in its Object Data properties."
        )


def odd_size(armature, shape, found):
    """mass.odd_size() of a walker with two legs, None of any other."""
    height = mass.standing_height(shape, found)
    if height is None or not (found.hips and all(foot.thigh for foot in found.feet)):
        return None
    return mass.odd_size(
        armature.name, height, armature.desire_path.mass or None, armature.desire_path.is_property_set("mass")
    )


def believed(armature, shape, found):
    """Sentences about a walker's size; one that cannot be is refused."""
    odd = odd_size(armature, shape, found)
    if odd is not None and odd[1]:
        raise DesirePathError(odd[0])
    return () if odd is None else odd[:1]


def weight(armature, shape, found, volume=None):
    """(mass [kg], what is to be told about it) of a walker; mass 0 is estimated.

    volume: of the mesh of one that is no person [m^3], None: of none
    """
    settings = armature.desire_path
    if not (math.isfinite(settings.mass) and settings.mass >= 0.0):
        raise DesirePathError(
            f"'{armature.name}' weighs {settings.mass:g} kg: give it a mass above 0, or 0 to have it estimated."
        )
    if settings.mass > 0.0:
        return axes.typed(settings.mass), ()
    if volume:
        settings.estimated_mass = mass.DENSITY * volume
        return mass.DENSITY * volume, (mass.sentence_by_volume(armature.name, mass.DENSITY * volume, volume),)
    kilograms, height = mass.estimate(shape, found, armature.name)
    settings.estimated_mass = kilograms
    return kilograms, (mass.sentence(armature.name, kilograms, height),)


# ---- all of it --------------------------------------------------------------------------------------


def placed(armature):
    """How feet were shaped before Place Feet put them on a ground, by foot bone; None where it did not."""
    animation = armature.animation_data
    action = animation.action if animation is not None else None
    kept = action.get(PLACED) if action is not None else None
    if not kept:
        return None
    return {
        bone: FootShape(
            **{name: np.array(value) if isinstance(value, list) else value for name, value in shape.items()}
        )
        for bone, shape in json.loads(kept).items()
    }


def samples_of(scene, walkers):
    """How often walkers are looked at in a scene frame, so that no frame of a sped-up animation is left out."""
    return max(each.desire_path.subframes for each in walkers) * math.ceil(1.0 / clock.stretch(scene) - 1e-6)


def record(scene, armature, frame_start, frame_end, samples=None, land=None, besides=seams.NOTHING):
    """What one armature did from frame to frame, as a Gait of one walker.

    land: a Simulation of its ground, for feet that lie on slopes
    besides: frames at which it is looked at besides
    """
    if armature is None or armature.type not in {"ARMATURE", "MESH"}:
        raise DesirePathError("There is nobody to record: select the armature that walks, or a mesh that moves.")
    if frame_end <= frame_start:
        raise DesirePathError(f"The frames {frame_start} to {frame_end} hold no motion: set an end after the start.")
    settings = armature.desire_path
    poses(armature)
    samples = samples or samples_of(scene, [armature])
    scale, rate = axes.unit_scale(scene), clock.frame_rate(scene)
    frames = besides.frames(frame_start, frame_end, samples)
    if armature.type == "MESH":
        gait = _solid(scene, armature, frames, samples, rate, scale)
        if len(set(off_in_renders(scene, armature, frames))) > 1:
            late = f"'{armature.name}' is off in renders at some of the frames: it presses the ground at all of them."
            gait = replace(gait, warnings=(*gait.warnings, late))
        return soil_keys.weighed(scene, gait, armature, frame_end)
    with (
        looked_at(armature),
        still(armature),
        moves.scene_of(scene, armature) as own,
        ride.on(own, settings.ground, frame_start) as carry,
    ):
        world = axes.matrix(evaluated(own, armature, frame_start).matrix_world, armature.name)
        shape = bones.skeleton(armature, world, scale)
        if settings.limbs == "ALL":
            return soil_keys.weighed(scene, _limbs(scene, armature, shape, own, carry, frames), armature, frame_end)
        found, volume = rig(armature, shape), None
        size = believed(armature, shape, found)
        if len(found.feet) > 2:  # no table knows this body: its mesh does
            hide = skin(scene, armature, None, world, scale, frames)
            full = mass.by_volume(shape, found, hide) if hide is not None else None
            if full:
                found = found if settings.mass_center else replace(found, segments=full[0])
                volume = full[1]
        kilograms, notes = weight(armature, shape, found, volume)
        moved, grown = bones.motion(own, armature, found.bones, frames, rate, scale, carry)
    worn = skin(scene, armature, found.feet, world, scale, frames)
    notes += grown + worn_changes.sentences(scene, armature, found.feet, world, scale, frames, worn)
    gait = body.gait_from_bones(
        shape,
        moved,
        mass=kilograms,
        name=armature.name,
        rig=found,
        frame_rate=rate,
        frame_start=frame_start,
        soles=body.SoleSource(
            skin=worn,
            tread=tread(scene, armature, found.feet, world, scale, frames) or settings.tread,
            land=land,
            shapes=placed(armature),
        ),
    )
    rode = carry.notes(gait.com[0], frames, rate, scale) if carry is not None else ()
    law = (settings.contact_law.lower(),)
    gait = replace(gait, warnings=size + gait.warnings + notes + rode, contact_law=law)
    return soil_keys.weighed(scene, gait, armature, frame_end)


def _limbs(scene, armature, shape, own, carry, frames):
    """What an armature did all of whose limbs press; it carves, unless it is to press by its weight."""
    scale, rate = axes.unit_scale(scene), clock.frame_rate(scene)
    settings, world = armature.desire_path, axes.matrix(evaluated(own, armature, frames[0]).matrix_world, armature.name)
    worn = skin(scene, armature, None, world, scale, frames)
    names = limbs.bones_of(shape, worn) if worn is not None else ()
    if not names:
        raise DesirePathError(
            f"No mesh hangs on the bones of '{armature.name}', so that its limbs have nothing to press with: bind one "
            "to it, or let its feet press."
        )
    moved, grown = bones.motion(own, armature, names, frames, rate, scale, carry)
    gait = limbs.gait_from_limbs(
        shape,
        moved,
        worn,
        mass=axes.typed(settings.mass) if settings.mass > 0.0 else USUAL_MASS,
        frame_rate=rate,
        options=solid.SolidOptions(armature.name, round(frames[0])),
    )
    rode = carry.notes(gait.com[0], frames, rate, scale) if carry is not None else ()
    law = "carve" if settings.contact_law == "AUTO" else settings.contact_law.lower()
    return replace(gait, warnings=gait.warnings + grown + tuple(rode), contact_law=(law,))


def _solid(scene, obj, frames, samples, rate, scale):
    """What a mesh did as one rigid body, as it is at the first frame, with its modifiers."""
    with (
        looked_at(obj),
        still(obj),
        moves.scene_of(scene, obj) as own,
        ride.on(own, obj.desire_path.ground, frames[0]) as carry,
    ):
        (first, faces), (last, _) = (_shape(evaluated(own, obj, frame)) for frame in (frames[0], frames[-1]))
        placed = np.array([bones.world_of(evaluated(own, obj, frame), carry) for frame in frames])
        if physics.simulated(obj):
            placed = physics.fallen(scene, obj, frames, samples)
            placed = placed if carry is None else np.array(carry.back) @ placed
    away = np.abs(placed[:, :3, 3]).max(axis=1) * scale
    if FARTHEST < away.max() < axes.FAR:
        raise DesirePathError(
            f"'{obj.name}' is {away.max():.3g} m away at frame {frames[away.argmax()]:g}, as when a simulation comes "
            "apart or a key is wrong: mend it, or let the frames end before."
        )
    bad = ~(np.abs(placed) < axes.FAR).all(axis=(1, 2)) | ~(np.linalg.norm(placed[:, :3, :3], axis=1) > 0.0).all(axis=1)
    if bad.any():
        raise DesirePathError(
            f"'{obj.name}' has no usable transform at frame {frames[bad.argmax()]:g} (NaN, infinite, "
            "or scaled to nothing): look at its keys and drivers there."
        )
    turned = axes.rigid(placed, scale)
    size = np.swapaxes(turned[:, :3, :3], 1, 2) @ placed[:, :3, :3]  # what the turn leaves: scale, mirror, shear
    shape = np.eye(4)
    shape[:3, :3] = size[0]
    vertices = axes.points(shape, first, scale)
    faces = faces[:, ::-1] if np.linalg.det(size[0]) < 0.0 else faces
    notes, apart = [], np.abs(size - size[0]).max() / np.abs(size[0]).max()
    if apart > STIFF or len(last) != len(first) or (len(first) and np.abs(last - first).max() > STIFF * np.ptp(first)):
        notes.append(
            f"'{obj.name}' changes its shape or size between the frames: it presses as it is at frame {frames[0]:g}."
        )
    kilograms, estimated, law = _solid_weight(obj, vertices, faces)
    time = (np.asarray(frames) - frames[0]) / rate
    gait = solid.gait_from_solid(
        time,
        turned,
        vertices,
        faces,
        mass=kilograms,
        frame_rate=rate,
        options=solid.SolidOptions(obj.name, round(frames[0]), notes + estimated),
    )
    rode = carry.notes(gait.com[0], frames, rate, scale) if carry is not None else ()
    return replace(gait, warnings=gait.warnings + rode, contact_law=(law,))


def _shape(found):
    """Vertices and triangles of an evaluated mesh, in its own axes."""
    return compat.positions(found.data), compat.triangles(found.data)


def _solid_weight(obj, vertices, faces):
    """(mass [kg], sentences about it, contact law) of a rigid body; mass 0 is estimated from its volume, and what has
    none carves, unless it is to press by its weight."""
    settings = obj.desire_path
    law = settings.contact_law.lower()
    if settings.mass > 0.0:
        return axes.typed(settings.mass), [], law
    volume = solid.centre(vertices, faces)[1] if len(faces) else 0.0
    if law == "carve" or not volume > 0.0 and law == AUTO and len(faces):
        return mass.DENSITY * volume or 1.0, [], "carve"
    if not volume > 0.0:
        raise DesirePathError(
            f"The mass of '{obj.name}' cannot be estimated, since its mesh is not closed: give it a mass in kilograms."
        )
    settings.estimated_mass = mass.DENSITY * volume
    return mass.DENSITY * volume, [mass.sentence_by_volume(obj.name, mass.DENSITY * volume, volume)], law


def gaits(scene, walkers, frame_start, frame_end, land=None):
    """All walkers of a ground as one recording; land: a Simulation of it, for feet that lie on slopes."""
    samples = samples_of(scene, walkers)
    besides = moves.besides(scene, walkers, frame_start, frame_end)
    found = [record(scene, each, frame_start, frame_end, samples, land, besides) for each in walkers]
    return Gait.join(seams.closed(found, besides))
