"""Plants on the ground that is walked on: Simulation and Bake with plants. TRAIL (5)-(9), MODEL 7 and MODEL 8"""

import struct
from dataclasses import replace

import numpy as np
import pytest
from reference import soil as twin
from scenes import gaits

from desire_path.bake.bake import Bake, free, read_index
from desire_path.errors import DesirePathError
from desire_path.ground import maps
from desire_path.ground.options import SimulationOptions
from desire_path.ground.plants import KINDS, PAPER, Planting
from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import SOILS
from tests.scenes.records import for_bake

TOUGH = KINDS["lawn"]
FIELDS = ("compression", "heap", "pressure_time", "plant_strength", "young_modulus")


def stand(plants=(), at=(0.0, 0.0), *, newtons=735.0, threads=1, ground=None, cell=0.01, origin=(0.0, 0.0)):
    """A box of 28 x 10 cm stands on soft ground, then lifts off."""
    sim = Simulation(
        ground or Ground.flat(), "snow", cell, plants=plants, options=SimulationOptions(threads=threads, origin=origin)
    )
    gait, loads = gaits.pressed([gaits.box(0.28, 0.10)], [[*at, 0.0, 1, 0, 0, 0]], [[0, 0, -newtons]])
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    sim.settle()
    return sim


def fields(sim, window=(-64, -64, 128, 128)):
    return {name: sim.read(name, *window) for name in FIELDS}


def test_bare_ground_knows_nothing_of_plants():
    bare = fields(stand())
    assert not bare["plant_strength"].any()
    away = fields(stand([Planting("carex", rectangle=(5, 5, 6, 6))]))  # out of reach: not even planted
    for name in FIELDS:
        np.testing.assert_array_equal(bare[name], away[name])


def test_roots_make_prints_shallower():
    bare, grown = stand().report(), stand([Planting(TOUGH)]).report()
    assert grown["deepest_m"] < 0.6 * bare["deepest_m"]
    assert grown["plants"] > 1000 and bare["plants"] == 0


def test_same_bits_for_any_number_of_threads():
    one, four = (fields(stand([Planting("carex"), Planting("moss", seed=4)], threads=n)) for n in (1, 4))
    for name in FIELDS:
        assert one[name].tobytes() == four[name].tobytes(), name


def test_the_same_seed_gives_the_same_roots_wherever_the_walk_goes():
    planting = Planting("carex", seed=11)
    near, far = planting.within(-1, -1, 1, 1), planting.within(-7, -1, 1, 3)
    known = {tuple(root) for root in far.tolist()}
    assert len(near) > 100 and all(tuple(root) in known for root in near.tolist())
    assert not np.array_equal(near, Planting("carex", seed=12).within(-1, -1, 1, 1)[: len(near)])


@pytest.mark.parametrize("density", [0.02, 3.0, 80.0])
def test_squares_have_no_seams(density):
    wide = 6.0 if density > 1 else 40.0
    roots = Planting("carex", density=density, seed=5).within(-wide, -wide, wide, wide).astype(float)
    inside = roots[(abs(roots) < wide).all(1)]
    assert abs(len(inside) / (4 * wide * wide * density) - 1.0) < max(0.02, 1.5 / np.sqrt(len(inside)))
    apart = min(np.hypot(*(roots[k + 1 :] - root).T).min() for k, root in enumerate(roots[:-1]))
    assert apart >= np.sqrt(0.5 / density) - 1e-5


def test_weight_thins_and_rectangles_end():
    weight = np.array([[1.0, 0.0], [1.0, 0.25]], np.float32)
    roots = Planting("lawn", weight=weight, rectangle=(0.5, 0.5, 4.5, 4.5)).within(-10, -10, 10, 10)
    assert roots.min() >= 0.5 and roots.max() < 4.5
    left, right = roots[roots[:, 0] < 2.5], roots[roots[:, 0] >= 2.5]
    assert abs(len(left) / 8.0 / 300.0 - 1.0) < 0.03
    assert (right[:, 1] >= 2.5).all() and abs(len(right) / 4.0 / 75.0 - 1.0) < 0.15


def test_plantings_that_make_no_sense_are_refused():
    for wrong in (
        dict(kind="cactus"),
        dict(kind=3),
        dict(kind="carex", density=0),
        dict(kind="carex", seed=-1),
        dict(kind="carex", rectangle=(1, 0, 0, 1)),
        dict(kind="carex", weight=np.ones((2, 2))),
        dict(kind="carex", weight=np.full((2, 2), np.nan), rectangle=(0, 0, 1, 1)),
        dict(kind="carex", roots=np.zeros((3, 3))),
    ):
        with pytest.raises(DesirePathError) as problem:
            Planting(**wrong)
        assert str(problem.value).count(".") >= 1


# ---- how grass lies, cell by cell --------------------------------------------------------------------------------


def lean(sim, window=(-64, -64, 128, 128)):
    return [sim.read(name, *window) for name in ("lean_x", "lean_y", "crushed")]


def standing(kind, seconds_after):
    """A lawn under a standing box (cells -14..13, -5..4), and so long after it has left."""
    sim = Simulation(Ground.flat(), "wet-soil", 0.01, plants=[kind])
    gait, loads = gaits.pressed(
        [gaits.box(0.28, 0.10, 0.1)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -735]], seconds=0.5 + seconds_after
    )
    loads.force[:, 60:] = 0.0
    loads.touching[:, 60:] = 0
    gait = gaits.writable(gait)
    gait.pose[:, 60:, 2] = 1.0
    sim.load(gait, loads)
    sim.run(58)
    down = lean(sim)
    sim.run(60 + int(120 * seconds_after))
    return sim, down, lean(sim)


def test_grass_is_flat_under_the_sole_and_leans_away_beside_it():
    kind = KINDS["lawn"]
    _, (x, y, crushed), _ = standing(kind, 0.1)
    size = np.hypot(x, y)
    assert size.max() <= 1.0 + 1e-6 and crushed.min() >= 0.0 and crushed.max() <= 1.0
    assert (crushed[60:68, 51:77] > 0.999).all() and (size[60:68, 51:77] > 0.95).all()
    above, below = (slice(69, 71), slice(54, 74)), (slice(57, 59), slice(54, 74))
    assert (y[above] > 0.05).all() and (y[below] < -0.05).all()  # away from the sole
    reach = int(np.ceil(kind.height / 2 / 0.01)) + 1
    far = np.ones_like(crushed, bool)
    far[59 - reach : 69 + reach, 50 - reach : 78 + reach] = False
    assert not crushed[far].any() and not size[far].any()
    assert (np.diff(size[69 : 69 + reach, 64]) <= 0.0).all()  # less and less


def test_grass_stands_up_with_its_kinds_time_to_the_share_that_is_whole():
    whole = replace(KINDS["lawn"], break_angle=10.0, degrade_rate=0.0)  # nothing wears
    _, down, up = standing(whole, 0.4)
    before, after = down[2][60:68, 51:77], up[2][60:68, 51:77]
    np.testing.assert_allclose(after, np.exp(-whole.damping / 2 * 0.4) * before, rtol=0.05)
    _, _, later = standing(whole, 4.0)
    assert not any(plane.any() for plane in later)
    brittle = replace(whole, break_angle=whole.degrade_angle)  # what bends breaks
    sim, down, up = standing(brittle, 4.0)
    alpha = sim.read("plant_strength", -64, -64, 128, 128)  # dense: 1 to begin with
    np.testing.assert_allclose(up[2][60:68, 51:77], 1.0 - alpha[60:68, 51:77], atol=0.02)
    assert up[2][60:68, 51:77].mean() > 0.3


def test_trodden_grass_stays_down_until_its_strength_is_back():
    lawn = replace(KINDS["lawn"], break_angle=10.0)  # nothing breaks
    sole = (slice(60, 68), slice(51, 77))
    _, down, up = standing(lawn, 3.0)
    slow = np.exp(-lawn.recover_rate / lawn.strength * 3.0)
    np.testing.assert_allclose(up[2][sole], slow * down[2][sole], atol=0.015)
    assert slow > 0.99
    quick = replace(lawn, recover_rate=2.0 * lawn.strength)
    _, down, up = standing(quick, 0.5)
    np.testing.assert_allclose(up[2][sole], np.exp(-2.0 * 0.5) * down[2][sole], rtol=0.08)
    # what is bent less than phi_deg swings back at once
    gentle = replace(lawn, degrade_angle=np.pi / 2)
    _, down, up = standing(gentle, 3.0)
    assert down[2][sole].min() > 0.9 and not up[2].any()


def test_a_slipping_foot_combs_the_grass_its_way():
    sim = Simulation(Ground.flat(), "wet-soil", 0.01, plants=["moss"])
    gait, loads = gaits.pressed([gaits.box(0.28, 0.20, 0.1)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -100]], seconds=0.4)
    gait = gaits.writable(gait)
    gait.pose[:, :, 0] += 1.5 * gait.time
    loads.point[:, :, 0] += 1.5 * gait.time
    sim.load(gait, loads)
    sim.run(40)
    x, y, crushed = lean(sim)
    trail = (slice(58, 70), slice(60, 100))
    assert (x[trail] > 0.05).all() and (np.abs(y[trail]) < 0.5 * x[trail]).all()


# ---- baked -------------------------------------------------------------------------------------------------------


def bake(folder, plants, **more):
    gait, _ = gaits.pressed(
        [gaits.box(0.28, 0.10)] * 2, [[0, 0, 0, 1, 0, 0, 0], [0.1, 0.3, 0, 1, 0, 0, 0]], [[0, 0, -370]] * 2, seconds=1.2
    )
    made = Bake(gait, Ground.flat(), "snow", folder, plants=plants, **for_bake(**more))
    for _ in made.run():
        pass
    return made


def test_frames_and_maps_show_the_plants(tmp_path):
    made = bake(tmp_path, [Planting("lawn", seed=2), "moss"])
    assert made.report["plants"] > 1000 and made.report["broken_bends"] >= 0
    index = read_index(tmp_path)
    assert index.lean and index.complete
    rest, last = (maps.read(index.path(number)).planes for number in (0, index.frames))
    flat, pressed = (maps.read(index.lean_path(number)).planes for number in (0, index.frames // 2))
    assert rest["G"].min() > 0.7 and rest["G"].mean() > 0.95 and not rest["R"].any()  # up to the frame's edge
    assert not flat["R"].any() and not flat["B"].any() and pressed["B"].max() > 0.9
    np.testing.assert_array_equal(flat["A"], rest["G"])
    np.testing.assert_array_equal(maps.read(index.lean_path(index.frames)).planes["A"], last["G"])
    assert rest["R"].shape == pressed["R"].shape == (index.ny, index.nx)
    start, final = (maps.read(tmp_path / f"maps_{name}.exr") for name in ("start", "final"))
    assert set(final.planes) == {"Y", *(entry.name for entry in maps.MAPS + maps.GROUND + maps.LEAN)}
    assert start.planes["young_modulus_in"].max() > 5e6 and start.planes["plant_strength_in"].mean() > 0.95
    np.testing.assert_array_equal(final.planes["plant_strength"], last["G"])
    assert {"plant_strength", "lean_x", "lean_y", "crushed"} <= set(start.planes)
    free(tmp_path)
    assert not list(tmp_path.rglob("*.exr"))


def test_a_stopped_bake_with_plants_goes_on_and_other_plants_are_another_bake(tmp_path):
    whole = bake(tmp_path / "whole", ["carex"])
    gait = whole.gait
    stopped = Bake(gait, Ground.flat(), "snow", tmp_path / "stopped", plants=["carex"])
    run = stopped.run()
    for _ in range(60):
        next(run)
    run.close()
    again = Bake(gait, Ground.flat(), "snow", tmp_path / "stopped", plants=["carex"])
    for _ in again.run():
        pass
    one, two = read_index(tmp_path / "whole"), read_index(tmp_path / "stopped")
    for number in (0, 30, 61, one.frames):
        for film in ("path", "lean_path"):
            with open(getattr(one, film)(number), "rb") as a, open(getattr(two, film)(number), "rb") as b:
                assert a.read() == b.read()
    signatures = {
        Bake(gait, Ground.flat(), "snow", tmp_path, plants=plants).signature()
        for plants in (
            (),
            ["carex"],
            ["lawn"],
            [Planting("carex", seed=1)],
            [Planting("carex", density=9)],
            [Planting("carex", roots=[[0, 0]])],
            [Planting("carex", roots=[[0, 1]])],
        )
    }
    assert len(signatures) == 7


def test_the_plants_themselves_play_as_a_mesh_cache(tmp_path):
    made = bake(
        tmp_path, [Planting("carex", rectangle=(-0.3, -0.3, 0.4, 0.6)), Planting("fern", seed=3)], plant_mesh=True
    )
    mesh = np.load(tmp_path / "plants.npz")
    raw = (tmp_path / "plants.pc2").read_bytes()
    magic, version, count, start, rate, samples = struct.unpack("<12siiffi", raw[:32])
    assert (magic, version, start, rate) == (b"POINTCACHE2\0", 1, made.frame_start, 1.0)
    frames = np.frombuffer(raw[32:], "<f4").reshape(samples, count, 3)
    assert samples == read_index(tmp_path).frames and len(mesh["vertices"]) == count
    assert np.isfinite(frames).all() and list(mesh["kinds"]) == ["carex", "fern"]
    np.testing.assert_allclose(mesh["vertices"][mesh["along"] == 0, 2], 0.0, atol=1e-6)  # feet on flat ground
    for name, corners in (("edges", 2), ("faces", 4)):
        assert mesh[name].shape[1] == corners and mesh[name].min() >= 0 and mesh[name].max() < count
        assert (mesh["plant"][mesh[name]] == mesh["plant"][mesh[name][:, :1]]).all()
    a, b = mesh["edges"].T
    rest = np.linalg.norm(mesh["vertices"][a] - mesh["vertices"][b], axis=1)
    for frame in frames[::20]:  # stems keep their length, under the boxes too
        assert (np.linalg.norm(frame[a] - frame[b], axis=1) <= 1.05 * rest + 1e-6).all()
    moved = np.abs(frames - mesh["vertices"]).max(axis=(0, 2))
    assert moved.max() > 0.05 and (moved < 1e-6).mean() > 0.2  # some are trodden, others never touched
    assert not mesh["unbroken"].all() and mesh["unbroken"][moved < 1e-6].all()
    free(tmp_path)
    assert not tmp_path.exists()


def test_a_mesh_of_no_plants_is_refused(tmp_path):
    with pytest.raises(DesirePathError):
        bake(tmp_path, [], plant_mesh=True)
    with pytest.raises(DesirePathError):
        bake(tmp_path, [Planting("carex", rectangle=(50, 50, 51, 51))], plant_mesh=True)


def test_vigour_is_each_plants_own():
    roots = np.array([[0.0, 0.0], [0.1, 0.0], [9.0, 9.0], [0.2, 0.0]])
    kind = replace(KINDS["carex"], spread=0.5)
    ground = Ground.heights(np.zeros((5, 5)), 1.0, -2.0, -2.0)  # the third root has none
    sim = Simulation(ground, plants=Planting(kind, roots=roots, vigour=[1.0, -2.0, 3.0, 0.0]))
    strength = sim.plants_strength(0)[:, 0]
    assert strength == pytest.approx(kind.strength * np.exp([0.5, -1.0, 0.0]), rel=1e-5)
    for bad in (dict(vigour=[1.0]), dict(roots=roots, vigour=[1.0]), dict(roots=roots, vigour=[0, 0, 0, np.nan])):
        with pytest.raises(DesirePathError, match="vigour"):
            Planting("carex", **bad)


# ---- oracles: cover, prints and rates, through the whole simulation ----------------------------------------------


def walked(plants, rate=60.0, passes=4, soil="dry-sand"):
    """Two box feet walk 2.5 m along x, back and forth in y by a few centimetres from pass to pass."""
    sim = Simulation(Ground.flat(), soil, 0.01, plants=plants)
    for number in range(passes):
        sim.load(*gaits.strides(2.5, rate=rate, y=0.04 * (number % 3 - 1), shift=0.23 * number))
        sim.run(10**6)
        sim.settle()
    return sim


WEARS = replace(KINDS["lawn"], strength=0.6, break_angle=10.0, degrade_rate=1.0, recover_rate=0.0, spread=1.3)


@pytest.mark.parametrize("kind", [PAPER["carex"], WEARS])
def test_cover_does_not_depend_on_the_frame_rate(kind):
    cover = [walked([kind], rate).read("plant_strength", 0, -25, 250, 50).mean() for rate in (30.0, 60.0)]
    assert cover[0] < 0.97 and abs(cover[0] - cover[1]) < 0.03


def roots_of_cover(kind, share):
    """Roots on a square lattice so dense that cover is about `share`."""
    apart = 1.0 / np.sqrt(share * kind.full_density)
    x = np.arange(-1.0, 1.0, apart)
    return np.stack(np.meshgrid(x, x), -1).reshape(-1, 2)


def test_prints_follow_the_stiffness_of_soil_and_roots():
    """Bare, half and full cover of plants too low to bend: depth is m g L0 / ((E_g + alpha E_v0) A), TRAIL (8)-(10)."""
    kind = replace(KINDS["carex"], height=0.0, reach=0.3, modulus=4e6)
    soil = SOILS["snow"]
    for share in (0.0, 0.5, 1.5):
        plants = [Planting(kind, roots=roots_of_cover(kind, share))] if share else []
        sim = Simulation(Ground.flat(), soil, 0.01, plants=plants)
        sim.load(*gaits.pressed([gaits.box(0.28, 0.10)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -735]], seconds=1.0))
        window = (-14, -5, 28, 10)
        alpha, modulus = (sim.read(name, *window) for name in ("plant_strength", "young_modulus"))
        np.testing.assert_allclose(modulus, twin.modulus(soil.young_modulus, alpha * kind.modulus), rtol=1e-5)
        assert abs(alpha.mean() - min(share, 1.0)) < 0.1
        sim.run(110)
        depth = sim.read("compression", *window)
        expected = 735.0 * soil.layer_depth / (modulus.mean() * 0.28 * 0.10)
        np.testing.assert_allclose(depth, expected, rtol=0.01)


def test_where_plants_broke_prints_are_nearly_as_deep_as_on_bare_ground():
    x = np.arange(-0.25, 0.25, 0.01)
    roots = np.stack(np.meshgrid(x, x), -1).reshape(-1, 2)
    brittle = replace(
        KINDS["carex"], degrade_angle=0.02, break_angle=0.02, reach=0.02, full_density=5000.0, modulus=1e6
    )
    tough = replace(brittle, break_angle=4.0, degrade_rate=0.0)
    depth = []
    for plants in ([], [Planting(tough, roots=roots)], [Planting(brittle, roots=roots)]):
        sim = Simulation(Ground.flat(), "snow", 0.01, plants=plants)
        for _ in range(2):
            sim.load(*gaits.pressed([gaits.box(0.28, 0.10)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -300]]))
            sim.run(10**6)
        depth.append(sim.read("compression", -14, -5, 28, 10).mean())
    under, beside = (sim.read("plant_strength", -12, j, 24, 6) for j in (-3, 10))
    assert under.max() < 0.01 and beside.min() > 0.99
    assert depth[1] < 0.35 * depth[0] and 0.75 * depth[0] < depth[2] <= depth[0]


def test_several_kinds_share_a_ground():
    brittle = replace(KINDS["carex"], break_angle=KINDS["carex"].degrade_angle + 0.2)
    sim = walked(["moss", Planting(brittle, seed=1), Planting("fern", density=4.0, seed=2)], passes=1)
    kinds = [sim.plantings[number].kind for _, number, _ in sim.stands]
    assert kinds == [KINDS["moss"], brittle, KINDS["fern"]]
    alpha = [np.array(sim.plants_alpha(stand)) for stand, _, _ in sim.stands]
    worst = [each.min() for each in alpha]
    assert (alpha[0] < 0.8).mean() < 1e-3 and worst[1] < 0.5 and worst[2] > 0.0  # moss bears it, the brittle break
    strength = sim.read("plant_strength", 0, -25, 250, 50)
    assert 0.0 <= strength.min() < strength.max() <= 1.0


def test_bent_stems_return_to_their_rest_shape():
    """Swept aside by a foot in the air, below phi_deg at every bend: back within 1 % of the height."""
    kind = replace(KINDS["meadow"], degrade_angle=np.pi, break_angle=4.0)
    sim = Simulation(Ground.flat(), "dry-sand", 0.01, plants=[Planting(kind, rectangle=(-0.5, -0.5, 1.0, 0.5))])
    gait, loads = gaits.pressed([gaits.box(0.28, 0.10, 0.1)], [[-0.6, 0, 0.12, 1, 0, 0, 0]], [[0, 0, -1]], seconds=12.0)
    gait = gaits.writable(gait)
    gait.pose[:, :, 0] += np.minimum(gait.time, 1.0) * 1.5
    gait.pose[:, :, 2] = np.where(gait.time < 1.0, 0.12, 2.0)
    loads.touching[:, 60:] = 0
    loads.force[:] = 0.0
    sim.load(gait, loads)
    rest = sim.plants_positions(0)
    sim.run(90)
    bent = np.abs(sim.plants_positions(0) - rest).max(axis=(1, 2))
    sim.run(len(gait.time))
    away = np.abs(sim.plants_positions(0) - rest).max()
    assert bent.max() > 0.1 and away < 0.01 * kind.height and sim.report()["broke"] == 0
