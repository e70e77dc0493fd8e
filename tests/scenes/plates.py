"""Measured walks and what force plates said of them, and the errors of computed loads against those.

gait = plates.trial("gait_bmc_walk1")
found = plates.errors("gait_bmc_walk1", walker.loads(gait), gait)
"""

import os
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from desire_path.rig import body
from scenes import bvh

DATA = Path(os.environ.get("DESIRE_PATH_DATA") or Path(__file__).parent / "measured")  # of TRIALS, or of others
FEET = "LR"
CARRIES = 20.0  # a plate is stepped on above this [N]


@dataclass(frozen=True)
class Trial:
    mass: float  # [kg]
    window: tuple  # both feet are on plates [s]
    within: float = 0.08  # RMSE of a foot [body weights]


_KNOWN = {
    "gait_bmc_walk1": Trial(77.3, (0.31, 2.0)),  # from 2.0 s on the right foot leaves its plate
    "gait_opensim_walk": Trial(72.6, (0.05, 2.45)),
    "gait_opencap_walk": Trial(62.6, (0.1, 1.2)),
    "gait_rajagopal_run": Trial(72.84, (0.1, 2.5), 0.10),
    "gait_opencap_dropjump": Trial(62.6, (1.22, 2.66), 0.13),  # off a box that stands on no plate
}
TRIALS = {name: trial for name, trial in _KNOWN.items() if (DATA / name).is_dir()}
WALKS = tuple(name for name in TRIALS if "walk" in name)


def trial(name, every=1, without=()):
    """The trial as a Gait; `every` thins its frames, bones whose names hold a word of `without` are left out."""
    skeleton, motion, rate = bvh.load(DATA / name / "armature.bvh", every=every)
    gone = [b for b in skeleton.names if any(word in b for word in without)]
    if gone:
        skeleton, motion = leave_out(skeleton, motion, gone)
    return body.gait_from_bones(skeleton, motion, mass=TRIALS[name].mass, frame_rate=rate)


def leave_out(skeleton, motion, gone):
    """A skeleton without some bones: their children hang on what those hung on."""
    keep = [k for k, name in enumerate(skeleton.names) if name not in gone]
    parents = []
    for k in keep:
        up = int(skeleton.parents[k])
        while up >= 0 and up not in keep:
            up = int(skeleton.parents[up])
        parents.append(keep.index(up) if up >= 0 else -1)
    column = [motion.bones.index(skeleton.names[k]) for k in keep]
    return (
        body.Skeleton(
            tuple(skeleton.names[k] for k in keep), np.array(parents, "i4"), skeleton.rest[keep], skeleton.length[keep]
        ),
        body.Motion(motion.time, tuple(skeleton.names[k] for k in keep), motion.matrix[:, column]),
    )


@dataclass(frozen=True)
class Plates:
    """Ground on foot, left and right (2, T), at given times."""

    weight: np.ndarray  # upward [body weights]
    drive: np.ndarray  # forward, +X [body weights]
    on: np.ndarray
    point: np.ndarray  # centre of pressure along X [m], where it is known


def measured(name, time):
    table = np.genfromtxt(DATA / name / "grf.csv", delimiter=",", names=True)
    weight = TRIALS[name].mass * 9.81
    since = table["time"] - table["time"][0]  # a clip begins at 0
    at = lambda column: np.stack([np.interp(time, since, column(s)) for s in FEET])
    return Plates(
        at(lambda s: table[f"{s}_fz"]) / weight,
        at(lambda s: table[f"{s}_fx"]) / weight,
        at(lambda s: (table[f"{s}_fz"] > CARRIES) * 1.0) > 0.5,
        at(lambda s: np.nan_to_num(table[f"{s}_cop_x"])),
    )


def by_foot(gait, loads):
    """(ground on foot (2, T, 3) [body weights], touching (2, T), centre of pressure (2, T, 3) [m])."""
    rows = [gait.part_limb == limb for limb in (0, 1)]
    force = np.stack([-loads.force[r].sum(axis=0) for r in rows])
    on = np.stack([loads.touching[r].any(axis=0) for r in rows])
    load = np.stack([np.nansum(loads.point[r] * -loads.force[r][..., 2:], axis=0) for r in rows])
    point = load / np.maximum(force[..., 2:], 1e-9)
    return force / (gait.mass[0] * 9.81), on, point


@dataclass(frozen=True)
class Errors:
    rmse: np.ndarray  # vertical force of each foot (2,) [body weights]
    r: np.ndarray  # its correlation (2,)
    drive: np.ndarray  # RMSE of the forward force of each foot (2,) [body weights]
    mean: float  # mean vertical force of both [body weights]
    late: np.ndarray  # found minus measured contact times [s], one each edge inside the window
    apart: np.ndarray  # mean distance of the centres of pressure of each foot (2,) [m]


def errors(name, loads, gait, window=None):
    force, on, point = by_foot(gait, loads)
    plate = measured(name, loads.time)
    first, last = window or TRIALS[name].window
    inside = (loads.time >= first) & (loads.time <= last)
    rms = lambda e: np.sqrt(np.mean(e[:, inside] ** 2, axis=1))
    apart = [
        abs(point[k, :, 0] - plate.point[k])[inside & (plate.weight[k] > 0.15) & (force[k, :, 2] > 0.13)].mean()
        for k in (0, 1)
    ]
    return Errors(
        rms(force[..., 2] - plate.weight),
        np.array([np.corrcoef(force[k, inside, 2], plate.weight[k, inside])[0, 1] for k in (0, 1)]),
        rms(force[..., 0] - plate.drive),
        float(force[:, inside, 2].sum(axis=0).mean()),
        late(loads.time, on, plate.on, inside),
        np.array(apart),
    )


def late(time, found, true, inside):
    """How much later than the true ones the found edges of contact come [s]; infinite where there is none."""
    out = []
    for mine, real in zip(found, true):
        for rises in (True, False):
            edges = lambda on: np.flatnonzero((on[1:] != on[:-1]) & (on[1:] == rises)) + 1
            have = time[edges(mine)]
            for edge in edges(real):
                if 2 < edge < len(time) - 2 and inside[edge]:
                    out.append(have[abs(have - time[edge]).argmin()] - time[edge] if len(have) else np.inf)
    return np.array(out)


# ---- the same trial seen otherwise -----------------------------------------------------------------------


def noisy(gait, size, seed=1):
    """Every joint jitters by `size` [m]; the mass centre by what is left of it over the segments."""
    random = np.random.default_rng(seed)
    pose = gait.pose.copy()
    pose[..., :3] += random.normal(0, size, pose[..., :3].shape)
    return replace(gait, pose=pose, com=gait.com + random.normal(0, size / 3, gait.com.shape))


def tilted(gait, angle):
    """The walk up a floor that rises ahead by `angle` [rad], as of a capture room that is not level."""
    pose, com = gait.pose.copy(), gait.com.copy()
    for at in (pose, com):
        at[..., 2] += np.tan(angle) * at[..., 0]
    return replace(gait, pose=pose, com=com)


def raised(gait, height):
    return replace(gait, pose=gait.pose + [0, 0, height, 0, 0, 0, 0], com=gait.com + [0, 0, height])


def mirrored(gait):
    """Left and right changed; the limbs keep their order."""
    return replace(
        gait, com=gait.com * (1, -1, 1), pose=gait.pose * (1, -1, 1, 1, -1, 1, -1), point=gait.point * (1, -1, 1)
    )
