"""What a print looks like, however the scene stands and the work is cut: MODEL 11.4-11.6, of the pressed
ground, from an armature's keys to the mesh that plays."""

import math

import bpy
import mathutils
import numpy as np
from scenes import gaits, meshes, slopes, stands

from desire_path.bake import bake
from desire_path.ground.soil import SOILS

SECONDS, JUMP = 1.5, 1.2  # the dance ends, and leaves the ground [s]
CELL = 1.0 / 64.0  # mirrored and turned without rounding [m]
FIRM = 1e-6  # firm ground that should be one is this near [m]
LOOSE = CELL * math.tan(slopes.SLACK)  # and heaps, by the slack in which they count as at rest [m]


def near(found, wanted, limit):
    apart = float(np.abs(found - wanted).max())
    assert apart < limit, apart


def dance(folder, mirrored=False, apart=0.0, name="soil", **ground):
    """(ground, figure): a foot comes down aslant and tilted and turns on the spot under a swaying body, the
    other one treads on its rim or, `apart` [m], beside it, then it jumps off. Mirrored: the same with left
    and right exchanged."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    land = stands.ground(folder=folder, name=name, **ground)
    obj = stands.walks(stands.figure())
    hand = -1.0 if mirrored else 1.0

    def key(bone, seconds, offset, turn=(0.0, 0.0, 0.0)):
        if mirrored and "." in bone:
            bone = bone[:-1] + {"L": "R", "R": "L"}[bone[-1]]
        stands.move(obj, bone, seconds, (hand * offset[0], *offset[1:]), (turn[0], hand * turn[1], hand * turn[2]))

    for frame in range(37):
        seconds = frame / 24.0
        flown = max(seconds - JUMP, 0.0)
        key(
            "hips",
            seconds,
            (
                0.04 * math.sin(6.8 * seconds),
                0.03 * math.cos(8.4 * seconds),
                1.5 * flown - 0.5 * stands.GRAVITY * flown**2,
            ),
        )
    for seconds, lift, turn in ((0.0, 0.0, 0.3), (0.5, 0.0, 0.3), (0.8, 0.0, 0.5), (1.0, 0.25, 0.5)):
        key("foot.L", seconds, (0.03, 0.05, lift), (0.04, 0.06, turn))
    for seconds, lift in ((0.0, 0.3), (0.3, 0.0), (JUMP, 0.0), (1.5, 0.25)):
        key("foot.R", seconds, (0.19 - apart, -0.1, lift), (0.0, -0.05, -0.4))
    return land, obj


# ---- 4: mirrored and turned ---------------------------------------------------------------------------------


def test_a_mirrored_armature_leaves_mirrored_prints(folder):
    ground, obj = dance(folder, cell=CELL)
    base = stands.bake(ground, SECONDS)
    assert base.report["contacts"] == 2 and base.heap.max() > 0.01
    assert np.abs(base.drop - base.drop[:, ::-1]).max() > 0.01  # its own mirror image it is not
    obj.scale.x = -1.0
    other = stands.bake(ground, SECONDS)
    for name in ("compression", "heap", "drop"):  # to the bit
        assert (getattr(other, name)[:, ::-1] == getattr(base, name)).all(), name


def test_a_step_of_the_other_foot_leaves_the_mirrored_print(folder):
    base, other = (
        stands.bake(dance(folder / str(mirrored), mirrored, apart=0.3, cell=CELL)[0], SECONDS)
        for mirrored in (False, True)
    )
    near(other.compression[:, ::-1], base.compression, FIRM)
    near(other.drop[:, ::-1], base.drop, LOOSE)


def test_a_turned_scene_leaves_the_same_prints_turned(folder):
    ground, obj = dance(folder, cell=CELL)
    base = stands.bake(ground, SECONDS)
    assert np.abs(base.drop - np.rot90(base.drop)).max() > 0.01
    quarter = mathutils.Matrix(((0, -1, 0, 0), (1, 0, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)))
    obj.parent = ground.parent = carrier = meshes.link(bpy.data.objects.new("Carrier", None))
    obj.matrix_parent_inverse = quarter
    alone = stands.bake(ground, SECONDS)
    ground.matrix_parent_inverse = quarter
    both = stands.bake(ground, SECONDS)
    obj.matrix_parent_inverse = ground.matrix_parent_inverse = mathutils.Matrix()
    carrier.rotation_euler.z = 0.5 * math.pi  # as users turn it: with rounding
    rounded = stands.bake(ground, SECONDS)
    for other, wanted, loose in (
        (alone, lambda x: np.rot90(x, -1), LOOSE),  # rows go up: +x becomes +y
        (both, lambda x: x, LOOSE),
        (rounded, lambda x: x, 0.01 * base.drop.max()),
    ):
        near(other.compression, wanted(base.compression), FIRM)
        near(other.drop, wanted(base.drop), loose)


# ---- 5: at rest, whatever the threads ------------------------------------------------------------------------


def test_every_loose_slope_rests(folder):
    for name in ("dry-sand", "mud", "dry-soil"):
        ground, _ = dance(folder, name=name)
        for heap in ("rest", "paper"):
            trail = stands.bake(ground, SECONDS, heap=heap)
            assert -trail.drop.min() > 0.002  # a rim stands over the ground that the mesh shows
            over = slopes.excess(-trail.drop, trail.heap, trail.cell, SOILS[name].rest_angle)
            assert over < 1e-4, (name, heap, over)
            # the test would see it: nothing rests at two thirds of the angle
            assert slopes.excess(-trail.drop, trail.heap, trail.cell, SOILS[name].rest_angle / 1.5) > 0.01


def test_threads_do_not_change_a_bit(folder):
    ground, _ = dance(folder)
    files = []
    for threads in (1, 2, 3):
        place = folder / str(threads)
        stands.bake(ground, SECONDS, threads=threads, folder=str(place))
        index = bake.read_index(str(place))
        frames = [(place / "frames" / f"trail_{n:04d}.exr").read_bytes() for n in range(index.frames + 1)]
        files.append(
            frames + [stands.planes(ground)[name].tobytes() for name in ("compression", "heap", "pressure_time")]
        )
        assert len(set(frames)) > 20  # the frames differ from each other
    assert files[0] == files[1] == files[2]


# ---- 6: cells -----------------------------------------------------------------------------------------------


def finer(folder, sole, mass, soil, half):
    """Trails of a figure that stands on its left foot, on cells of 4, 2 and 1 cm."""
    trails = []
    for cell in (0.04, 0.02, 0.01):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        ground = stands.ground(cell, half, soil, folder / f"{cell:g}")
        obj = stands.walks(stands.figure("L"), stands.mesh_of(sole), mass)
        turn = (0.0, 0.0, 0.4)
        stands.move(obj, "hips", 0.0)
        stands.move(obj, "foot.L", 0.0, (-0.137, 0.021, 0.0), turn)
        trails.append(stands.bake(ground, 0.8))
    return trails


def same_volume(trails):
    fine = trails[-1]
    for trail in trails[:-1]:
        found, wanted = ((each.compression.sum() * each.cell**2) for each in (trail, fine))
        assert abs(found / wanted - 1.0) < 0.03, (found, wanted)
        assert abs(trail.report["pressed_m3"] / fine.report["pressed_m3"] - 1.0) < 0.03


def test_a_foot_s_volume_does_not_depend_on_the_cell(folder):
    trails = finer(folder, gaits.box(0.11, 0.25), 75.0, "dry-soil", (0.6, 0.6))
    same_volume(trails)
    assert abs(trails[-1].drop.max() / 0.0229 - 1.0) < 0.05


def test_a_stamp_s_volume_and_rim_do_not_depend_on_the_cell(folder):
    """A stamp so wide that its rim is several of the coarsest cells wide, pressed 12 cm into mud."""
    mud = SOILS["mud"]
    mass = mud.young_modulus * 0.8 * 0.6 * 0.12 / mud.layer_depth / stands.GRAVITY
    trails = finer(folder, gaits.box(0.8, 0.6), mass, "mud", (1.2, 1.2))
    same_volume(trails)
    assert abs(trails[-1].drop.max() / 0.12 - 1.0) < 0.01
    rims = [-trail.drop.min() for trail in trails]
    assert rims[-1] > 0.04
    for rim in rims[:-1]:
        assert abs(rim / rims[-1] - 1.0) < 0.10, rims
