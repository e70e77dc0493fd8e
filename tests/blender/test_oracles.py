"""How deep, how much, whatever the frame rate: MODEL 11.1-11.3, 11.7 and 11.11, of the pressed ground, from an
armature's keys to the mesh that plays. What is expected is reckoned here, not taken from a bake."""

import csv
import math

import bpy
import numpy as np
from scenes import gaits, meshes, stands

from desire_path.ground.soil import SOILS

LENGTH, WIDTH = 0.25, 0.11  # of the sole that is stood on: 0.0275 m^2
LAWS = ("sole", "uniform")


def within(found, wanted, share):
    assert abs(found - wanted) <= share * abs(wanted), (found, wanted)


def depth(mass, soil, area=LENGTH * WIDTH):
    """MODEL 11.1: c = m g L0 / (E A) [m]."""
    return mass * stands.GRAVITY * soil.layer_depth / (soil.young_modulus * area)


def one_legged(folder, mass=75.0, width=WIDTH, length=LENGTH, **ground):
    """(ground, figure): it stands on its left foot, the right one is held up."""
    ground = stands.ground(folder=folder, **ground)
    obj = stands.walks(stands.figure(), stands.plate(width, length), mass)
    stands.move(obj, "hips", 0.0)
    stands.move(obj, "foot.L", 0.0)
    stands.move(obj, "foot.R", 0.0, (0.0, 0.0, 0.5))
    return ground, obj


# ---- 1: at rest, stress over stiffness ------------------------------------------------------------------


def test_one_foot_sinks_by_stress_over_stiffness(folder):
    ground, _ = one_legged(folder)
    assert SOILS["dry-soil"].young_modulus == 0.35e6
    for law in LAWS:
        trail = stands.bake(ground, 0.6, law=law)
        assert trail.report["contacts"] == 1
        for found in (trail.drop.max(), trail.compression.max(), trail.report["deepest_m"]):
            within(found, 0.0229, 0.01)
        # flat all over, and as wide as the sole: half cells of doubt at the edge
        bottom = trail.drop > 0.99 * trail.drop.max()
        assert abs(bottom.sum() * trail.cell**2 - LENGTH * WIDTH) < 0.01 * (LENGTH + WIDTH)
        y, x = (trail.rest[..., k][bottom].mean() for k in (1, 0))
        assert abs(x - stands.ASIDE) < 0.005 and abs(y) < 0.005


def test_every_soil_gives_way_by_its_own_stiffness(folder):
    ground, _ = one_legged(folder)
    for name, soil in SOILS.items():
        if soil.snow_density > 0.0:
            continue  # packs, and is no spring
        trail = stands.bake(ground, 0.6, soil=name)
        deep = depth(75.0, soil)  # nothing has sprung back yet: it still stands there
        assert (1.0 - soil.rebound) * 0.99 * deep < trail.drop.max() < 1.01 * deep, name
        if soil.roughness == 0.0:
            within(trail.drop.max(), deep, 0.01)


def test_two_feet_sink_half_as_deep_each(folder):
    ground = stands.ground(folder=folder)
    obj = stands.walks(stands.figure(), stands.plate(WIDTH, LENGTH))
    for bone in ("hips", "foot.L", "foot.R"):
        stands.move(obj, bone, 0.0)
    for law in LAWS:
        trail = stands.bake(ground, 0.6, law=law)
        for side in (trail.rest[..., 0] > 0.0, trail.rest[..., 0] < 0.0):
            within(trail.drop[side].max(), depth(37.5, SOILS["dry-soil"]), 0.01)


def test_depth_is_proportional_to_mass_and_layer_and_softness(folder):
    ground, obj = one_legged(folder, mass=40.0)
    base = stands.bake(ground, 0.6).drop.max()
    for factor in (0.5, 2.0):
        obj.desire_path.mass = factor * 40.0
        within(stands.bake(ground, 0.6).drop.max(), factor * base, 0.01)
        obj.desire_path.mass = 40.0
        own = SOILS["dry-soil"]
        for numbers in ({"layer_depth": factor * own.layer_depth}, {"young_modulus": own.young_modulus / factor}):
            with stands.soil(**numbers):
                within(stands.bake(ground, 0.6).drop.max(), factor * base, 0.01)


def test_a_rigid_sole_sinks_evenly_and_even_pressure_by_each_soil(folder):
    """The foot stands with one half of its width on another soil. So light that even pressure leaves both
    halves within the centimetre in which cells touch."""
    mass = 25.0
    ground, obj = one_legged(folder, mass, width=0.12)
    soft, firm = SOILS["dry-soil"], SOILS["soil"]
    group = ground.vertex_groups.new(name="firm")
    group.add([v.index for v in ground.data.vertices if v.co.x > stands.ASIDE], 1.0, "REPLACE")
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_paint_add() == {"FINISHED"}
    ground.desire_path.painted[0].soil = "soil"
    half = 0.5 * 0.12 * LENGTH
    together = mass * stands.GRAVITY / sum(each.young_modulus / each.layer_depth * half for each in (soft, firm))
    for law, wanted in (
        ("sole", (together, together)),
        ("uniform", (depth(mass, soft, 2.0 * half), depth(mass, firm, 2.0 * half))),
    ):
        trail = stands.bake(ground, 0.6, law=law)
        for side, deep in zip((-1.0, 1.0), wanted):
            at = np.abs(trail.rest[..., 0] - stands.ASIDE - 0.03 * side) < 0.02
            within(trail.drop[at].max(), deep, 0.01)


# ---- 7: half the area ----------------------------------------------------------------------------------------


def test_half_the_area_is_twice_as_deep(folder):
    ground, obj = one_legged(folder, mass=50.0, width=0.12, length=0.24)
    for law in LAWS:
        obj.desire_path.sole = stands.plate(0.12, 0.24)
        whole = stands.bake(ground, 0.6, law=law).drop.max()
        obj.desire_path.sole = stands.plate(0.06, 0.24)
        half = stands.bake(ground, 0.6, law=law).drop.max()
        within(half, 2.0 * whole, 0.01)
        within(half, depth(50.0, SOILS["dry-soil"], 0.06 * 0.24), 0.01)


# ---- 2: frame rates -----------------------------------------------------------------------------------------


def stepping(folder, rate, subframes=1):
    """The trail of a step: the left foot comes down, carries and leaves, the right one moves on."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = rate
    ground = stands.ground(folder=folder / str(rate), name="soil")
    obj = stands.walks(stands.figure(), stands.plate(WIDTH, LENGTH))
    stands.move(obj, "hips", 0.0)
    up, aside, there = (0.0, 0.0, 0.25), (0.0, 0.3, 0.25), (0.0, 0.35, 0.0)
    for bone, keys in (
        ("foot.L", ((0.0, up), (0.25, (0, 0, 0)), (1.0, (0, 0, 0)), (1.25, aside))),
        ("foot.R", ((0.0, (0, 0, 0)), (0.5, (0, 0, 0)), (0.75, aside), (1.0, there))),
    ):
        for seconds, offset in keys:
            stands.move(obj, bone, seconds, offset)
    return stands.bake(ground, 1.25)


def test_the_print_does_not_depend_on_the_frame_rate(folder):
    trails = [stepping(folder, rate) for rate in (24, 60, 240)]
    fine = trails[-1]
    left = fine.rest[..., 0] > 0.0
    within(fine.drop[left].max(), depth(75.0, SOILS["soil"]), 0.01)  # it carried all the weight
    assert fine.report["contacts"] == 3
    for trail in trails[:-1]:
        for side in (left, ~left):
            within(trail.drop[side].max(), fine.drop[side].max(), 0.01)
            # what is cut by a foot that goes aside as it leaves depends on when it is seen to leave
            within(trail.compression[side].sum(), fine.compression[side].sum(), 0.015)
            within(trail.heap[side].sum(), fine.heap[side].sum(), 0.02)
        for name in ("deepest_m", "pressed_m3", "heaped_m3"):
            within(trail.report[name], fine.report[name], 0.01)


# ---- 3: the ledger ------------------------------------------------------------------------------------------


def balanced(trail, nu):
    """Soil in heaps is what left firm ground and other heaps, sum b cell^2 = 2 nu (Vc + Vb) - Vb + Vl, Vl what soles
    that slide cut; and the mesh holds what the report says."""
    told = trail.report
    area = trail.cell**2
    within(trail.compression.sum() * area, told["pressed_m3"] + told["loosened_m3"], 1e-6)
    within(trail.heap.sum() * area, told["heaped_m3"], 1e-6)
    moved = 2.0 * nu * (told["pressed_m3"] + told["pressed_heap_m3"])
    within(told["displaced_m3"], moved, 1e-6)
    within(told["heaped_m3"], moved - told["pressed_heap_m3"] + told["loosened_m3"], 1e-6)


def test_a_first_print_heaps_two_nu_of_its_volume(folder):
    ground, _ = one_legged(folder)
    for name in ("dry-sand", "snow", "mud"):
        for heap in ("rest", "paper"):
            trail = stands.bake(ground, 0.6, soil=name, heap=heap)
            balanced(trail, SOILS[name].poisson_ratio)
            assert trail.report["pressed_heap_m3"] == 0.0
            volume = depth(75.0, SOILS[name]) * LENGTH * WIDTH
            within(trail.heap.sum() * trail.cell**2, 2.0 * SOILS[name].poisson_ratio * volume, 0.01)


def test_the_ledger_balances_when_prints_cross(folder):
    """One foot stands; the other treads three times, turned and tilted, each over the rim of the last."""
    ground = stands.ground(folder=folder)
    obj = stands.walks(stands.figure(), stands.plate(WIDTH, LENGTH))
    stands.move(obj, "hips", 0.0)
    stands.move(obj, "foot.R", 0.0, (-0.1, 0.0, 0.0))
    for k in range(3):
        turn = (0.03 * k, 0.05 * (k % 2), 0.5 * k)
        for seconds, lift in ((0.0, 0.2), (0.15, 0.0), (0.45, 0.0)):
            stands.move(obj, "foot.L", 0.6 * k + seconds, (0.06 * k, 0.09 * k, lift), turn)
    stands.move(obj, "foot.L", 1.8, (0.1, 0.1, 0.3))
    for name in ("dry-sand", "snow", "mud"):
        for heap in ("rest", "paper"):
            trail = stands.bake(ground, 1.8, soil=name, heap=heap)
            assert trail.report["contacts"] == 4 and trail.report["pressed_heap_m3"] > 0.0, trail.report
            balanced(trail, SOILS[name].poisson_ratio)


# ---- 11: a sphere falls -----------------------------------------------------------------------------------

RADIUS, HEIGHT, MASS = 0.15, 2.5, 50.0


def drop(folder, mass=MASS, rate=60):
    """(ground, ball) before the bake: a ball that falls on ground of 1 MPa."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = rate
    ground = stands.ground(folder=folder)
    sole = stands.mesh_of(gaits.sphere(RADIUS), "Ball", (stands.ASIDE, 0.0, RADIUS))
    obj = stands.walks(stands.figure("L"), sole, mass)
    obj.desire_path.load_model = "impulse"
    for frame in range(math.ceil(1.3 * rate)):
        height = max(HEIGHT - 0.5 * stands.GRAVITY * (frame / rate) ** 2, 0.0)
        for bone in ("hips", "foot.L"):
            stands.move(obj, bone, frame / rate, (0.0, 0.0, height))
    ground.desire_path.frame_start, ground.desire_path.frame_end = 1, math.ceil(1.3 * rate)
    return ground, obj


def dropped(folder, mass=MASS, **numbers):
    with stands.soil(**{"young_modulus": 1e6, "settle_time": 0.2, **numbers}):
        return stands.bake(drop(folder, mass)[0])


def test_a_dropped_sphere_hits_with_weight_and_impulse(folder):
    """m (g + v0 / tau) at the end of the fall, 2241 N, whatever the frame rate; as the tables tell."""
    speed = math.sqrt(2.0 * stands.GRAVITY * HEIGHT)
    assert abs(MASS * (stands.GRAVITY + speed / 0.2) - 2241.0) < 1.0
    for rate, tau in ((24, 0.2), (60, 0.2), (60, 0.1)):
        with stands.soil(young_modulus=1e6, settle_time=tau):
            _, obj = drop(folder, rate=rate)
            meshes.activate(obj)
            assert bpy.ops.object.desire_path_forces_write(directory=str(folder)) == {"FINISHED"}
        total = {}
        with open(folder / "loads.csv", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                total[row["time"]] = total.get(row["time"], 0.0) - float(row["fz"])
        within(max(total.values()), MASS * (stands.GRAVITY + speed / tau), 0.02)
        # and of the momentum nothing is lost: the force over weight, summed over time
        within(sum(f - MASS * stands.GRAVITY for f in total.values() if f > 0.0) / rate, MASS * speed, 0.1)


def test_a_dropped_sphere_goes_deeper_with_mass_and_shallower_with_stiffness(folder):
    deep = [dropped(folder, mass=mass).drop.max() for mass in (25.0, 50.0, 100.0)]
    assert deep[0] < 0.9 * deep[1] and deep[1] < 0.9 * deep[2], deep
    deep = [dropped(folder, young_modulus=modulus).drop.max() for modulus in (0.5e6, 1e6, 2e6)]
    assert deep[1] < 0.9 * deep[0] and deep[2] < 0.9 * deep[1], deep


def test_a_dropped_sphere_s_rim_grows_with_poisson_s_ratio_and_its_depth_does_not(folder):
    trails = [dropped(folder, poisson_ratio=nu) for nu in (0.1, 0.25, 0.45)]
    deep = [trail.drop.max() for trail in trails]
    rims = [-trail.drop.min() for trail in trails]
    for each in deep:
        within(each, deep[0], 1e-3)
    assert 0.0 < rims[0] < 0.9 * rims[1] and rims[1] < 0.9 * rims[2], rims
