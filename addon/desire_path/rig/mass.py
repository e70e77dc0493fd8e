"""How heavy a walker is when nobody said, and where its weight is when no table knows its body.

legs of the rest pose --Winter--> standing height --body mass index--> mass of a person
mesh of the rest pose --volume of each bone--> segments, mass of anything else
"""

from __future__ import annotations

import numpy as np

from ..errors import DesirePathError
from ..motion import rotation
from .rigs import Rig, Segment
from .skeleton import Skeleton, Skin

# Winter, Biomechanics and Motor Control of Human Movement, 4th ed., figure 4.1: hip joint at 0.530 of
# the height, ankle at 0.039.
LEG = 0.530 - 0.039  # hip to ankle of one who stands, in heights
# WHO Technical Report Series 894, Obesity (2000): the healthy median of grown people lies at 21 to 23.
BODY_MASS_INDEX = 22.0  # [kg/m^2]
FILLS = 14.0  # a grown person's mass over his height cubed [kg/m^3]
PEOPLE = (0.3, 4.0)  # nobody with two legs is shorter or taller, if he is no doll and no giant [m]
CREATURES = (0.008, 60.0)  # how tall anything on legs may be [m]
AMISS = (10.0, 300.0)  # times too heavy or too light for one's height: odd, and impossible
UNITS = ((0.01, "centimetres"), (0.001, "millimetres"), (0.0254, "inches"), (0.1, "decimetres"), (0.3048, "feet"))
SHRUNK = (100.0, 1000.0, 10.0)  # what undoes a scale that was applied once too often
DENSITY = 1000.0  # of living bodies, that of water within a few per cent [kg/m^3]
SMALL = 0.005  # bones that move less than this share of the volume are not worth sampling


def standing_height(skeleton: Skeleton, rig: Rig) -> float | None:
    """Height of a person with these legs, stretched [m]; None where legs tell none."""
    if len(rig.feet) != 2:
        return None
    row = {name: i for i, name in enumerate(skeleton.names)}
    at = np.asarray(skeleton.rest, float)[:, :3, 3]
    legs = []
    for foot in rig.feet:
        names = [name for name in (foot.thigh or rig.hips, foot.shank if foot.thigh else None, foot.foot) if name]
        joints = at[[row[name] for name in names]]
        legs.append(float(np.linalg.norm(np.diff(joints, axis=0), axis=1).sum()))
    leg = float(np.mean(legs))
    return leg / LEG if min(legs) > 0.0 else None


def by_volume(skeleton: Skeleton, rig: Rig, skin: Skin) -> tuple[tuple[Segment, ...], float] | None:
    """(segments, volume [m^3]) of a body whose mesh is bound to its bones: one segment a bone, with its
    share of what lies between the faces and the lines of their bones. None where the mesh holds nothing."""
    row = {name: i for i, name in enumerate(skeleton.names)}
    names = [name for name in skin.weights if name in row]
    corner = np.asarray(skin.vertices, float)[skin.triangles]  # (F, 3, 3)
    if not len(corner) or not names:
        return None
    share = np.stack([np.asarray(skin.weights[name], float)[skin.triangles].sum(axis=1) for name in names])
    owner = share.argmax(axis=0)
    rest = np.asarray(skeleton.rest, float)[[row[name] for name in names]]
    length = np.asarray(skeleton.length, float)[[row[name] for name in names]]
    head, axes = rest[:, :3, 3], rotation.unit(rest[:, :3, 1])
    middle = corner.mean(axis=1)
    along = np.clip(((middle - head[owner]) * axes[owner]).sum(axis=1), 0.0, length[owner])
    line = head[owner] + along[:, None] * axes[owner]
    a, b, c = (corner[:, k] - line for k in range(3))
    part = (np.cross(a, b) * c).sum(axis=1) / 4.0  # of the wedge from the bone's line to the face
    part = part * (np.sign(part.sum()) or 1.0)  # a mirrored mesh is inside out
    centre = (2.0 * middle + line) / 3.0
    volume = np.bincount(owner, part, len(names))
    total = volume.sum()
    inside = abs((np.cross(corner[:, 0], corner[:, 1]) * corner[:, 2]).sum()) / 6.0  # if it is closed
    feet = np.mean([np.asarray(skeleton.rest, float)[row[foot.foot], :3, 3] for foot in rig.feet], axis=0)
    segments = []
    for k, name in enumerate(names):
        if volume[k] <= SMALL * total or not length[k] > 0.0:
            continue
        at = np.stack([np.bincount(owner, part * centre[:, c], len(names))[k] for c in range(3)]) / volume[k]
        share_of_bone = float((at - head[k]) @ axes[k] / length[k])
        off = at - head[k] - (at - head[k]) @ axes[k] * axes[k]
        up = head.mean(axis=0) - feet
        axis = int(np.argmax(abs(up)))
        lift = float(off[axis] * np.sign(up[axis]))
        segments.append(Segment(name, float(volume[k] / total), 0.0, ((name, share_of_bone),), (), lift))
    if 0.5 * total < inside < 2.0 * total:
        total = inside
    return (tuple(segments), float(total)) if segments else None


def sentence_by_volume(name: str, mass: float, volume: float) -> str:
    """What is told where a mass was estimated from a mesh."""
    return (
        f"{name} weighs {mass:.3g} kg by an estimate from the {volume * 1000:.3g} litres of its mesh: set a "
        "mass to use another."
    )


def estimate(skeleton: Skeleton, rig: Rig, name: str = "Walker") -> tuple[float, float]:
    """(mass [kg], height [m]) of a walker, or a DesirePathError where there is no telling."""
    height = standing_height(skeleton, rig)
    if height is None:
        raise DesirePathError(
            f"The mass of {name} cannot be estimated, since only people with two legs below their hips "
            "tell their height, and no mesh is bound to it: give it a mass in kilograms."
        )
    return BODY_MASS_INDEX * height**2, height


def sentence(name: str, mass: float, height: float) -> str:
    """What is told where a mass was estimated."""
    return f"{name} weighs {mass:.3g} kg by an estimate from its height of {height:.2f} m: set a mass to use another."


def odd_size(name: str, height: float, kilograms: float | None = None, chosen: bool = True) -> tuple[str, bool] | None:
    """(a sentence about one with two legs who is of no person's size, can that not be?), None where all is well.

    kilograms: the mass that was given, None: none. One whose mass goes with the size is meant to be as large. chosen:
    is it somebody's choice? What nobody chose refuses no creature of a possible size.
    """
    if PEOPLE[0] <= height <= PEOPLE[1]:
        return None
    off = 1.0 if kilograms is None else kilograms / (FILLS * height**3)
    off = max(off, 1.0 / off)
    if kilograms is not None and off < AMISS[0]:
        return None
    units = UNITS if height > 1.0 else tuple((by, "") for by in SHRUNK)
    fits = [(by, unit) for by, unit in units if 0.5 <= height * by <= 2.6]
    seems = (
        f"apply a scale of {fits[0][0]:.4g} to it" + (f", as it seems to be in {fits[0][1]}" if fits[0][1] else "")
        if fits
        else "check its scale and the scene's unit scale"
    )
    size = f"'{name}' is {height:.3g} m tall"
    if off < AMISS[1]:
        return f"{size}: if that is not meant, {seems}.", False
    if not chosen and CREATURES[0] <= height <= CREATURES[1]:
        return (
            f"{size} and weighs {kilograms:.3g} kg, since nobody gave it another mass: give it the mass of its size, "
            f"or, if that size is not meant, {seems}."
        ), False
    return f"{size} and weighs {kilograms:.3g} kg, which cannot be: {seems}, or give it the mass of its size.", True
