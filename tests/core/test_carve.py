"""Bodies that go where they are moved to. MODEL 6.11, MODEL 11.19, SUMNER99"""

from dataclasses import replace

import numpy as np
import pytest
from test_solid import box

from desire_path import Bake, BakeOptions, DesirePathError, Gait, Ground, Simulation, SimulationOptions, Soil
from desire_path.loads import walker
from desire_path.rig import solid

SAND = Soil(young_modulus=2.25e6, poisson_ratio=0.5, rest_angle=np.radians(32.0), settle_time=0.05)
MUD = Soil(young_modulus=0.6e6, poisson_ratio=0.35, rest_angle=np.radians(15.0))
AT = (0.0137, 0.0081)  # nothing lies on the cells by chance


def sphere(radius, rings=24):
    """A closed ball about the origin."""
    angle = np.arange(2 * rings) * np.pi / rings
    around = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    height = np.arange(1, rings) * np.pi / rings
    body = [np.c_[radius * np.sin(h) * around, np.full(2 * rings, -radius * np.cos(h))] for h in height]
    vertices = np.concatenate([[[0, 0, -radius]], *body, [[0, 0, radius]]])
    k, n, faces = np.arange(2 * rings), np.roll(np.arange(2 * rings), -1), []
    faces.append(np.stack([np.zeros_like(k), 1 + n, 1 + k], 1))
    for ring in range(rings - 2):
        a, b = 1 + 2 * rings * ring, 1 + 2 * rings * (ring + 1)
        faces += [np.stack([a + k, a + n, b + n], 1), np.stack([a + k, b + n, b + k], 1)]
    last = 1 + 2 * rings * (rings - 2)
    faces.append(np.stack([last + k, last + n, np.full_like(k, len(vertices) - 1)], 1))
    return vertices, np.concatenate(faces)


def moved(mesh, way, *, seconds=1.0, rate=120.0, mass=10.0, turn=None, law="carve"):
    """A body whose origin goes along way(t) (T,) -> (T, 3)."""
    time = np.arange(round(seconds * rate) + 1) / rate
    matrix = np.tile(np.eye(4), (len(time), 1, 1))
    matrix[:, :3, 3] = way(time)
    if turn is not None:
        matrix[:, :3, :3] = turn(time)
    gait = solid.gait_from_solid(time, matrix, *mesh, mass=mass, frame_rate=24.0)
    return replace(gait, contact_law=(law,))


def pressed(gait, soil=SAND, cell=0.01, **options):
    sim = Simulation(Ground.flat(), soil, cell, options=SimulationOptions(**options))
    loads = walker.loads(gait, ground=sim)
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    sim.settle()
    return sim


def balances(sim):
    told = sim.report()
    laid = told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"]
    return told["heaped_m3"] == pytest.approx(laid, rel=1e-6)


def down(depth, radius=0.2, at=AT):
    """Down, a stay, and up again."""
    return lambda t: np.c_[
        np.full_like(t, at[0]),
        np.full_like(t, at[1]),
        np.interp(t, (0, 0.4, 0.6, 1.0), (radius + 0.05, radius - depth, radius - depth, radius + 0.1)),
    ]


@pytest.mark.parametrize("mass", (1.0, 20.0))
def test_a_ball_leaves_its_depth_whatever_it_weighs(mass):
    sim = pressed(moved(sphere(0.2), down(0.1), mass=mass))
    assert sim.report()["deepest_m"] == pytest.approx(0.1, abs=0.0005)
    assert balances(sim) and sim.report()["contacts"] == 1


@pytest.mark.parametrize("soil", (SAND, MUD), ids=("sand", "mud"))
def test_volume_and_rim_do_not_depend_on_the_cell(soil):
    volume, rim = [], []
    for cell in (0.04, 0.02, 0.01, 0.005):
        sim = pressed(moved(sphere(0.2), down(0.1)), soil, cell)
        volume.append(sim.report()["pressed_m3"])
        rim.append(sim.report()["heaped_m3"])
        assert balances(sim)
    np.testing.assert_allclose(volume, volume[-1], rtol=0.03)
    np.testing.assert_allclose(rim, rim[-1], rtol=0.1)


def dragged(depth=0.03, far=1.0, size=(0.3, 0.3, 0.2)):
    """A box set down and dragged along +X."""
    return moved(
        box(size),
        lambda t: np.c_[
            AT[0] + far * np.clip((t - 0.2) / 0.7, 0.0, 1.0),
            np.full_like(t, AT[1]),
            np.interp(t, (0, 0.2), (0.15, size[2] / 2 - depth)),
        ],
    )


def test_a_dragged_box_carries_what_it_cut():
    sim = pressed(dragged())
    told = sim.report()
    assert balances(sim)
    track = 0.03 * 0.3 * 1.0  # of firm ground
    assert told["loosened_m3"] == pytest.approx(track, rel=0.05)
    assert told["pressed_m3"] == pytest.approx(0.03 * 0.3 * 0.3, rel=0.05)
    assert told["heaped_m3"] == pytest.approx(told["loosened_m3"] + 2.0 * 0.5 * told["pressed_m3"], rel=1e-6)
    assert_heap_ahead(sim)


def assert_heap_ahead(sim):
    front = AT[0] + 1.0 + 0.15
    heap = sim.read("heap", (-0.5, -0.6, 2.0, 0.6))
    x = -0.5 + (np.arange(heap.shape[1]) + 0.5) * 0.01
    across = heap.sum(axis=0, dtype=float)  # most lies just ahead of it, the rest beside its way
    assert across[(x > front) & (x < front + 0.1)].mean() > 2.0 * across[(x > 0.3) & (x < 0.9)].mean()
    assert heap[:, x < -0.3].max() == 0.0 and abs(x[heap.max(axis=0).argmax()] - front) < 0.1
    ahead = heap[:, x > front]
    assert ahead.sum(dtype=float) > 0.3 * heap.sum(dtype=float)
    assert ahead.max() > 2.2 * heap[:, (x > 0.3) & (x < 0.8)].max()  # the windrows are lower
    middle, side = (round((AT[1] + y + 0.6) / 0.01) for y in (0.0, 0.13))
    assert ahead[middle].max() > 1.3 * ahead[side].max() and ahead[side].max() > 0.03
    furrow = sim.read("compression", (0.3, -0.05, 0.7, 0.05))
    np.testing.assert_allclose(furrow, 0.03, atol=0.001)


def test_a_ball_that_rolls_presses_and_one_that_is_dragged_ploughs():
    radius, depth, far = 0.2, 0.03, 1.0

    def way(t):
        return np.c_[AT[0] + far * t, np.full_like(t, AT[1]), np.full_like(t, radius - depth)]

    def roll(t):
        angle = far * t / radius
        out = np.tile(np.eye(3), (len(t), 1, 1))
        out[:, 0, 0], out[:, 0, 2], out[:, 2, 0], out[:, 2, 2] = (
            np.cos(angle), np.sin(angle), -np.sin(angle), np.cos(angle)
        )  # fmt: skip
        return out

    rolled, drawn = (pressed(moved(sphere(radius), way, turn=turn)) for turn in (roll, None))
    assert balances(rolled) and balances(drawn)
    track = rolled.report()["pressed_m3"] + rolled.report()["loosened_m3"]
    assert rolled.report()["loosened_m3"] < 0.3 * track
    assert drawn.report()["loosened_m3"] > 0.7 * track
    for sim in (rolled, drawn):
        np.testing.assert_allclose(sim.read("compression", (0.3, 0.0, 0.7, 0.01)).max(axis=0), depth, atol=0.002)


def test_a_fast_body_leaves_no_gaps():
    """A ball of 8 cm at 30 m/s: 25 cm from sample to sample, three times its width on the ground."""
    radius, depth = 0.04, 0.02
    gait = moved(
        sphere(radius),
        lambda t: np.c_[AT[0] + 30.0 * t, np.full_like(t, AT[1]), np.full_like(t, radius - depth)],
        seconds=0.1,
    )
    sim = pressed(gait, cell=0.005)
    depths = sim.read("compression", (0.0, 0.0, 3.0, 0.02)).max(axis=0)
    assert depths.min() > 0.9 * depth and balances(sim)


def test_threads_and_mirrors_do_not_matter():
    gait = Gait.join([dragged(), moved(sphere(0.2), down(0.1, at=(-0.9, 0.8)))])
    one, many = (pressed(gait, threads=threads) for threads in (1, 4))
    window = (-2.0, -2.0, 2.0, 2.0)
    for name in ("compression", "heap", "pressure_time"):
        assert np.array_equal(one.read(name, window), many.read(name, window)), name
    mirror = moved(
        box((0.3, 0.3, 0.2)),
        lambda t: np.c_[
            -(AT[0] + np.clip((t - 0.2) / 0.7, 0.0, 1.0)), np.full_like(t, AT[1]), np.interp(t, (0, 0.2), (0.15, 0.07))
        ],
    )
    here, there = pressed(dragged()).read("heap", window), pressed(mirror).read("heap", window)
    np.testing.assert_allclose(there[:, ::-1], here, atol=2e-6)


def test_a_recording_keeps_its_laws(tmp_path):
    gait = Gait.join([dragged(), moved(sphere(0.2), down(0.05, at=(-1.0, 0.0)), law="auto")])
    assert gait.contact_law == ("carve", "auto") and gait.only([1]).contact_law == ()
    gait.save(tmp_path / "two.npz")
    assert Gait.load(tmp_path / "two.npz").contact_law == gait.contact_law
    with pytest.raises(DesirePathError, match="no contact law 'plough'"):
        replace(gait, contact_law=("carve", "plough")).check()
    with pytest.raises(DesirePathError, match="1 contact laws for 2 walkers"):
        replace(gait, contact_law=("carve",)).check()


def test_a_bake_carves_and_says_what_stays_over_the_ground(tmp_path):
    gait = replace(moved(sphere(0.2), down(0.1)), contact_law=())
    bake = Bake(gait, Ground.flat(), SAND, tmp_path / "a", options=BakeOptions(law="carve"))
    list(bake.run())
    assert bake.report["deepest_m"] == pytest.approx(0.1, abs=0.001) and bake.report["contacts"] == 1
    over = Bake(moved(sphere(0.2), down(-0.02)), Ground.flat(), SAND, tmp_path / "b", options=BakeOptions(law="carve"))
    list(over.run())
    assert over.report["deepest_m"] == 0.0
    assert any("stays over the ground" in each for each in over.report["warnings"])


def test_stopped_and_resumed_is_the_same(tmp_path):
    gait = dragged()
    whole, first = pressed(gait), Simulation(Ground.flat(), SAND)
    first.load(gait, walker.loads(gait))
    first.run(60)
    second = Simulation(Ground.flat(), SAND)
    second.load(gait, walker.loads(gait))
    second.restore(first.state())
    second.run(len(gait.time) - 1)
    second.settle()
    window = (-1.0, -1.0, 2.0, 1.0)
    assert np.array_equal(whole.read("heap", window), second.read("heap", window))
    assert whole.report() == second.report()


def test_a_long_way_comes_to_rest_behind_the_body():
    """Aslant over 17 m: the ground behind is settled bit by bit, not all of it at the end, and loose soil rests."""
    radius, depth = 0.2, 0.04
    gait = moved(
        sphere(radius, 12),
        lambda t: np.c_[AT[0] + 6.0 * t, AT[1] + 6.0 * t, np.full_like(t, radius - depth)],
        seconds=2.0,
    )
    sim = Simulation(Ground.flat(), SAND, 0.02)
    sim.load(gait, walker.loads(gait, ground=sim))
    sim.run(len(gait.time) - 1)
    heap, firm = sim.read("heap", (3.0, 3.0, 6.0, 6.0)), sim.read("compression", (3.0, 3.0, 6.0, 6.0))
    surface, slope = heap - firm, np.tan(np.radians(32.1)) * 0.02
    drop = np.maximum(surface[:, :-1] - surface[:, 1:], 0.0) > slope + 1e-5
    assert heap.max() > 0.005 and not (drop & (heap[:, :-1] > 1e-5)).any()
    assert balances(sim)


def test_a_body_that_was_lost_is_told_of_by_its_frame():
    """NaN, or farther away than anything is: before anything is pressed."""

    def put(where):
        return moved(box((0.3, 0.3, 0.2)), lambda t: np.where((t > 0.5)[:, None], where, (AT[0], AT[1], 0.07)))

    for where in ((np.nan, 0.0, 0.0), (1e9, 0.0, 0.0), (0.0, 0.0, -1e9), (0.0, np.inf, 0.0)):
        with pytest.raises(DesirePathError, match="frame 13"):
            pressed(put(where))
    with pytest.raises(DesirePathError, match="Body is 1e.09 m away .* mend it"):
        pressed(put((0.0, -1e9, 0.0)))


def test_a_body_that_is_put_away_far_below_leaves_its_print_and_no_shaft():
    gait = moved(box((0.3, 0.3, 0.2)), lambda t: np.c_[0 * t + AT[0], 0 * t + AT[1], np.where(t > 0.5, -1e3, 0.07)])
    loads = walker.loads(gait)
    assert any(
        "more than 10 m below the ground at frame 13.2, where it leaves no print" in each for each in loads.warnings
    )
    sim = pressed(gait)
    assert sim.report()["deepest_m"] == pytest.approx(0.03, abs=1e-6) and balances(sim)
