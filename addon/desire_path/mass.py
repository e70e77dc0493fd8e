"""How heavy a walker is when nobody said: from the height its legs tell.

    legs of the rest pose --Winter--> standing height --body mass index--> mass
"""

import numpy as np

from .errors import DesirePathError

# Winter, Biomechanics and Motor Control of Human Movement, 4th ed., figure 4.1: hip joint at 0.530 of
# the height, ankle at 0.039.
LEG = 0.530 - 0.039  # hip to ankle of one who stands, in heights
# WHO Technical Report Series 894, Obesity (2000): the healthy median of grown people lies at 21 to 23.
BODY_MASS_INDEX = 22.0  # [kg/m^2]


def standing_height(skeleton, rig):
    """Height of a person with these legs, stretched [m]; None where legs tell none."""
    if len(rig.feet) != 2:
        return None
    row = {name: i for i, name in enumerate(skeleton.names)}
    at = np.asarray(skeleton.rest, float)[:, :3, 3]
    legs = []
    for foot in rig.feet:
        joints = [name for name in (foot.thigh or rig.hips, foot.shank if foot.thigh else None,
                                    foot.foot) if name]
        joints = at[[row[name] for name in joints]]
        legs.append(float(np.linalg.norm(np.diff(joints, axis=0), axis=1).sum()))
    leg = float(np.mean(legs))
    return leg / LEG if min(legs) > 0.0 else None


def estimate(skeleton, rig, name="Walker"):
    """(mass [kg], height [m]) of a walker, or a DesirePathError where there is no telling."""
    height = standing_height(skeleton, rig)
    if height is None:
        raise DesirePathError(
            f"The mass of {name} cannot be estimated, since only people with two legs below their hips "
            "tell their height: give it a mass in kilograms.")
    return BODY_MASS_INDEX * height ** 2, height


def sentence(name, mass, height):
    """What is told where a mass was estimated."""
    return (f"{name} weighs {mass:.3g} kg by an estimate from its height of {height:.2f} m: set a mass "
            "to use another.")
