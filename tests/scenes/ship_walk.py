"""Make addon/desire_path/walks/walk.npz anew: whole strides of the recorded walk that repeat, 75 kg.

python tests/scenes/ship_walk.py [OUT.npz]
"""

import pathlib
import sys
import tempfile
from dataclasses import replace

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]

from desire_path.motion.gait import Gait  # noqa: E402
from desire_path.placement import cycle  # noqa: E402
from desire_path.rig import body  # noqa: E402
from scenes import bvh  # noqa: E402

CLIP = ROOT / "tests" / "scenes" / "walks" / "cmu_12_01_walk.bvh"
UNIT = 0.056444  # metres in a unit of the clip
RATE = 60  # [1/s]
MASS = 75.0  # [kg]
FINE = 1e-6  # places are rounded to this [m]


def made():
    """The walk, along +X from the origin, its floor at z = 0, its last sample as its first."""
    skeleton, motion, rate = bvh.load(CLIP, scale=UNIT)
    clip = body.gait_from_bones(skeleton, motion, mass=MASS, frame_rate=rate)
    found = cycle.find(clip)
    count = round(found.seconds * RATE)
    com, pose, _ = found.at(np.arange(count + 1) / count)
    com[:, 2] -= found.floor
    pose[..., 2] -= found.floor
    pose[..., :3] = pose[..., :3].round(6)
    return replace(
        clip,
        time=np.arange(count + 1) / RATE,
        com=com.round(6)[None],
        pose=pose,
        frame_rate=RATE,
        frame_start=1,
        walker_name=("Walker",),
        warnings=(),
    ).check()


def write(path):
    """The recording, packed."""
    with tempfile.TemporaryDirectory() as folder:
        plain = pathlib.Path(folder) / "walk.npz"
        made().save(plain)
        with np.load(plain) as file:
            np.savez_compressed(path, **{name: file[name] for name in file.files})
    Gait.load(path)


if __name__ == "__main__":
    write(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "addon" / "desire_path" / "walks" / "walk.npz")
