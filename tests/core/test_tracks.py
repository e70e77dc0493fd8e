"""Walkers who go in turn: memory grows with who is there, and nothing else changes."""

import gc
import tracemalloc
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import desire_path
from desire_path import Gait, _native
from desire_path.bake import grounds
from desire_path.bake.bake import Bake
from desire_path.bake.options import BakeOptions
from desire_path.errors import DesirePathError
from desire_path.files import npz
from desire_path.ground import maps, parcels
from desire_path.ground.options import SimulationOptions
from desire_path.ground.parcels import Parcel
from desire_path.ground.sim import Ground, Simulation
from desire_path.loads import walker
from desire_path.motion.tracks import TrackArray, joined, values
from desire_path.placement import passes
from tests.scenes.records import for_simulation


@pytest.fixture(scope="module")
def walk():
    return Gait.load(Path(desire_path.__file__).parent / "walks" / "walk.npz")


@pytest.fixture(scope="module")
def eight(walk):
    """Eight walkers in turn, five passes each, on paths of their own."""
    return passes.in_turn([walk.along([(0, 0.3 * n), (2, 0.3 * n)], 5, seed=n) for n in range(8)])


def pressed(gait, loads, **options):
    sim = Simulation(Ground.flat(), "mud", 0.02, **for_simulation(threads=1, **options))
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    i0, i1, j0, j1 = sim.reach()
    return [sim.read(name, i0, j0, i1 - i0, j1 - j0) for name in ("compression", "heap", "pressure_time")]


def dense(gait):
    return replace(gait, com=np.asarray(gait.com), pose=np.asarray(gait.pose))


def dense_loads(loads):
    arrays = {name: np.asarray(getattr(loads, name)) for name in ("touching", "force", "point", "held")}
    return replace(loads, **arrays)


# ---- the array -------------------------------------------------------------------------------------------


def some_array(random, missing=None):
    """A TrackArray of five rows over 40 samples, and the same dense."""
    blocks, want = [], np.full((5, 40, 3), np.nan if missing is None else missing)
    for rows in ([0, 3], [1], [4]):  # row 2 is never there
        at = int(random.integers(0, 6))
        while at < 34:
            count = int(random.integers(1, 7))
            values = random.random((len(rows), min(count, 40 - at), 3))
            blocks.append((rows, at, values))
            want[rows, at : at + values.shape[1]] = values
            at += count + int(random.integers(0, 5))
    if missing is None:
        for row in want:
            known = np.flatnonzero(np.isfinite(row[:, 0]))
            if not len(known):
                row[:] = 0.0
                continue
            last = np.searchsorted(known, np.arange(40), "right") - 1
            row[:] = row[known[np.maximum(last, 0)]]
    random.shuffle(blocks)
    return TrackArray(5, 40, blocks, missing), want


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("missing", [None, 0.0])
def test_it_is_read_like_an_array(seed, missing):
    random = np.random.default_rng(seed)
    array, want = some_array(random, missing)
    assert array.shape == want.shape and array.ndim == 3 and len(array) == 5
    assert np.array_equal(np.asarray(array), want) and array.nbytes < want.nbytes
    a, b = sorted(random.integers(0, 41, 2).tolist())
    rows, mask = np.array([3, 0]), np.array([True, False, True, True, False])
    for key in (
        (slice(None), slice(a, b)),
        (rows, slice(a, b), 2),
        (2, slice(a, b)),
        (-1,),
        (mask, slice(a, None), slice(0, 2)),
        (slice(None), 7),
        (3, 39, 1),
        (slice(None), slice(None, None, 3)),
        (slice(None), slice(None, None, -1)),
        (..., 1),
        (..., slice(0, 2)),
        np.ix_(rows, np.array([2, 9, 5])),
        (np.array([0, 4, 1]), np.array([1, 2, 3])),
        (rows,),
        (slice(None), None, 3),
    ):
        assert np.array_equal(array[key], want[key]), key
    assert np.array_equal(array + 1.0, want + 1.0) and np.array_equal(array != 0, want != 0)
    assert array.sum() == pytest.approx(want.sum()) and np.array_equal(array.copy(), want)
    assert [np.array_equal(one, other) for one, other in zip(array, want)] == [True] * 5


@pytest.mark.parametrize("seed", range(6))
def test_it_is_written_where_somebody_is(seed):
    random = np.random.default_rng(seed)
    array, _ = some_array(random)
    other, want = array.like((2,), float, np.nan), np.full((5, 40, 2), np.nan)
    rows, samples = np.array([0, 1, 4]), np.sort(random.choice(40, 9, replace=False))
    values = random.random((3, 9, 2))
    there = np.array([array.there(k, k + 1) for k in samples]).T
    other.put(rows, samples, values)
    want[np.ix_(rows, samples)] = np.where(there[rows][..., None], values, np.nan)
    assert np.array_equal(np.asarray(other), want, equal_nan=True)
    some = array.rows([1, 3])
    assert np.array_equal(np.asarray(some), array[[1, 3]])
    both = joined([array, np.ones((1, 40, 3))])
    assert np.array_equal(np.asarray(both)[:5], np.asarray(array)) and (both[5] == 1.0).all()


# ---- recordings ------------------------------------------------------------------------------------------


def test_memory_is_that_of_who_is_there(eight):
    alone = sum(len(eight.time[a:b]) for a, b, _, _ in passes.turns_of(eight)) * 4 * 7 * 8
    assert len(eight.mass) == 8 and len(passes.turns_of(eight)) == 40
    assert np.prod(eight.pose.shape) * 8 == 8 * alone  # what all of them would take all the time
    assert eight.pose.nbytes == alone  # 7 doubles for each of 4 parts and sample of a stay: who is away takes nothing
    loads = walker.loads(eight)
    assert loads.force.nbytes == alone * 3 / 7
    sim = Simulation(Ground.flat(), "mud", 0.02, options=SimulationOptions(threads=1))
    before = _native.bytes_live()
    sim.load(eight, loads)
    held = _native.bytes_live() - before - eight.time.nbytes
    # the core takes 13 doubles (pose, force, centre of pressure) and a byte each, and once for each walker its limbs
    # and their soles with the lists of corners, some 13 kB, which is what is over 1
    assert held <= 1.2 * alone * (13 * 8 + 1) / (7 * 8)


def places(folder, bridge=0.5):
    """Two tiles of ground side by side, and one that lies over both."""

    def tile(x0, x1, z, soil, name):
        corner = [(x0, -1.0, z), (x1, -1.0, z), (x1, 4.0, z), (x0, 4.0, z)]
        return Parcel(Ground.mesh(np.array(corner), [[0, 1, 2], [0, 2, 3]]), soil, folder / name, name)

    return [tile(-1, 1, 0.0, "mud", "a"), tile(1, 4, 0.0, "snow", "b"), tile(0.5, 1.5, bridge, "mud", "c")]


def test_memory_over_several_grounds_is_that_of_who_is_there(walk, tmp_path):
    def taken(count):
        """(samples, bytes that are held, most that are, bytes of the core) of 16 passes by so many walkers in turn."""
        gait = passes.in_turn([walk.along([(0, 0.3 * n), (2, 0.3 * n)], 16 // count, seed=n) for n in range(count)])
        bake = Bake(gait, places(tmp_path / str(count)), cell_size=0.02)
        assert bake.stepped.pose.nbytes > 0  # it is made now
        gc.collect()  # what others left
        core = _native.bytes_live()
        tracemalloc.start()
        try:
            sims, loads, _ = grounds.simulations(bake)
            held, peak = tracemalloc.get_traced_memory()
        finally:
            tracemalloc.stop()
        assert len(sims) == 2 and loads.force.nbytes <= 1.2 * bake.stepped.pose.nbytes * 3 / 7
        return len(bake.stepped.time), held, peak, _native.bytes_live() - core

    (samples, *alone), (of_eight, *eight) = taken(1), taken(8)
    assert 0.9 * samples < of_eight < 1.1 * samples
    for one, other in zip(alone, eight):
        assert other <= 1.2 * one, (alone, eight)


@pytest.mark.parametrize("bridge", [0.5, -0.004])  # feet pass below it, or tread it
def test_several_grounds_are_told_of_tracks_what_they_are_of_a_dense_recording(walk, tmp_path, bridge):
    gait = passes.in_turn([walk.along([(0, 0.3 * n), (2, 0.3 * n)], 2, seed=n) for n in range(2)])
    bake = Bake(gait, places(tmp_path, bridge), cell_size=0.02)
    tracks, same = bake.stepped, dense(bake.stepped)
    _, loads, shares = grounds.simulations(bake)
    there = np.asarray(tracks.pose.alike([np.ones(each.shape[:2], bool) for _, _, each in tracks.pose.blocks], False))
    assert isinstance(loads.force, TrackArray) and 0.4 < there.mean() < 0.6
    lands = [parcel.land.rest_height for parcel in bake.parcels[1:]]
    for found, want, here in zip(
        parcels.treads(tracks, lands), parcels.treads(same, lands), (there, there[tracks.point_part])
    ):
        assert np.array_equal(np.asarray(found)[here], want[here], equal_nan=True)
        assert len(np.unique(want[here & np.isfinite(want)])) == 2
    over, _ = parcels.treads(same, lands)
    for storey in (0, 1):
        found = dense_loads(parcels.on(loads, parcels.treads(tracks, lands)[0], storey))
        want = parcels.on(dense_loads(loads), over, storey)
        for name in ("touching", "force", "point"):
            assert np.array_equal(getattr(found, name), getattr(want, name), equal_nan=True)
        assert found.touching.any()
    for share in shares:
        own, end = dense_loads(share.loads), len(tracks.time) * 3 // 4
        assert share.loads.force.nbytes < 0.6 * own.force.nbytes
        box = parcels.under(share.parcel, tracks, share.loads, 0.1)
        assert box is not None and box == parcels.under(share.parcel, same, own, 0.1)
        count = parcels.contacts(share.parcel, tracks, share.loads, end)
        assert count == parcels.contacts(share.parcel, same, own, end)
        assert count < parcels.contacts(share.parcel, tracks, share.loads, len(tracks.time))


def test_tracks_leave_the_bits_of_a_dense_recording(eight):
    loads = walker.loads(eight)
    tracks, whole = pressed(eight, loads), pressed(dense(eight), dense_loads(loads))
    assert all(np.array_equal(a, b) for a, b in zip(tracks, whole)) and tracks[0].max() > 0.005
    one = eight.only([0])
    single = walker.loads(one)
    assert np.array_equal(single.force[:, : eight.cut[0]], loads.force[:4, : eight.cut[0]])


def test_a_recording_is_the_same_as_one_track(walk):
    gait = walk.along([(0, 0), (2, 0)], 1)
    n = len(gait.time)
    track = replace(
        gait,
        com=TrackArray(1, n, [([0], 0, gait.com)]),
        pose=TrackArray(len(gait.pose), n, [(np.arange(len(gait.pose)), 0, gait.pose)]),
    )
    loads = walker.loads(gait)
    again = walker.loads(track.check())
    assert np.array_equal(again.force, loads.force) and np.array_equal(again.touching, loads.touching)
    assert all(np.array_equal(a, b) for a, b in zip(pressed(gait, loads), pressed(track, again)))


def test_a_live_motion_leaves_the_same_bits(walk):
    gait = walk.along([(0, 0), (2, 0)], 1)
    loads = walker.loads(gait)
    want = pressed(gait, loads)
    ahead = Simulation(Ground.flat(), "mud", 0.02, options=SimulationOptions(threads=1))
    ahead.load(gait, loads)
    i0, i1, j0, j1 = ahead.reach()
    sim = Simulation(Ground.flat(), "mud", 0.02, options=SimulationOptions(threads=1))
    sim.load_live(gait)
    for t, time in enumerate(gait.time):
        now = (loads.touching[:, t], loads.force[:, t], loads.point[:, t])
        sim.push(time, gait.pose[:, t], *now)
        sim.run(t)
    found = [sim.read(name, i0, j0, i1 - i0, j1 - j0) for name in ("compression", "heap", "pressure_time")]
    assert all(np.array_equal(a, b) for a, b in zip(found, want)) and want[0].max() > 0.005
    with pytest.raises(ValueError):  # no later than the last one
        sim.push(gait.time[-1], gait.pose[:, -1], *now)
    with pytest.raises(ValueError):
        sim.push(gait.time[-1] + 1.0, gait.pose[:2, -1], *now)
    sim.load(gait, loads)
    with pytest.raises(ValueError):  # a recording takes no more poses
        sim.push(gait.time[-1] + 1.0, gait.pose[:, -1], *now)


def test_a_thousand_walkers_go_in_turn(walk):
    short = walk.along([(0, 0), (2, 0)], 1).piece(10, 30)
    many = passes.in_turn([short] * 1000)
    assert many.pose.shape == (4000, 20_000, 7) and many.pose.nbytes == 1000 * short.pose.nbytes
    touching, force = many.pose.like((), "u1", 0), many.pose.like((3,), float, 0.0)
    for on, pressing in zip(values(touching), values(force)):
        on[0, 5:15], pressing[0, 5:15, 2] = 1, -500.0
    point = many.pose.like((3,), float, np.nan)
    loads = walker.FootForce(many.time, touching, force, point, np.zeros(len(many.point)))
    sim = Simulation(Ground.flat(), "mud", 0.02, options=SimulationOptions(threads=1))
    before = _native.bytes_live()
    sim.load(many, loads)
    soles = sum(sole.vertices.nbytes + sole.triangles.nbytes for sole in many.soles)
    limbs = 2000 * 1000
    assert _native.bytes_live() - before < 1.2 * 1000 * 4 * 20 * (13 * 8 + 1) + soles + limbs
    sim.run(len(many.time) - 1)
    assert sim.report()["contacts"] == 1000


def test_it_comes_back_from_disk(eight, tmp_path):
    path = tmp_path / "walk.npz"
    eight.save(path)
    assert path.stat().st_size < 1.3 * (eight.pose.nbytes + eight.com.nbytes)
    again = Gait.load(path)
    assert isinstance(again.pose, TrackArray) and np.array_equal(again.cut, eight.cut)
    assert np.array_equal(again.pose, eight.pose) and np.array_equal(again.com, eight.com)
    assert [again.there(a, b).tolist() for a, b in again.pieces()] == [
        eight.there(a, b).tolist() for a, b in eight.pieces()
    ]
    arrays = npz.read(path)
    for name, value in (
        ("pose_span", arrays["pose_span"] + (0, 1, 0)),
        ("pose_span", arrays["pose_span"][1:]),
        ("pose_rows", arrays["pose_rows"] + 8),
        ("pose_rows", arrays["pose_rows"] - 1),
        ("com", arrays["com"][1:]),
        ("com_span", arrays["com_span"] * 0),
    ):
        np.savez(path, **{**arrays, name: value})
        with pytest.raises(DesirePathError, match="damaged or no recording"):
            Gait.load(path)


def test_who_was_held_in_the_sky_is_not_there(eight, tmp_path):
    """As recordings were kept before: absent walkers at 2e5 m for whole pieces."""
    owner, com, pose = eight.limb_walker[eight.part_limb], np.asarray(eight.com), np.asarray(eight.pose)
    for a, b in eight.pieces():
        away = np.setdiff1d(np.arange(8), eight.there(a, b))
        com[away, a:b] = (0, 0, 2e5)
        pose[np.isin(owner, away), a:b] = (0, 0, 2e5, 1, 0, 0, 0)
    replace(eight, com=com, pose=pose).save(tmp_path / "old.npz")
    again = Gait.load(tmp_path / "old.npz")
    assert np.array_equal(again.pose, eight.pose) and again.pose.nbytes == eight.pose.nbytes


def test_they_are_resampled_piece_by_piece(eight):
    finer = eight.resample(120.0)
    assert isinstance(finer.pose, TrackArray) and finer.rate() == pytest.approx(120.0)
    for (a, b), (c, d) in list(zip(eight.pieces(), finer.pieces()))[::7]:
        there = eight.there(a, b)
        own = eight.only(there).piece(a, b).resample(120.0)
        assert np.array_equal(finer.com[there, c:d], own.com) and finer.there(c, d).tolist() == there.tolist()


def test_a_bake_of_them_is_that_of_a_dense_recording(walk, tmp_path):
    gait = passes.in_turn([walk.along([(0, 0.3 * n), (1, 0.3 * n)], 2, seed=n) for n in range(3)])
    for _ in Bake(gait, Ground.flat(), "mud", tmp_path / "out", cell_size=0.02, options=BakeOptions(threads=1)).run():
        pass
    found = maps.read(tmp_path / "out" / "maps_final.exr")
    assert found.planes["compression"].max() > 0.005
    broken = gait.pose.like((7,), float, 0.0)
    for (_, _, to), (_, _, own) in zip(broken.blocks, gait.pose.blocks):
        to[...] = own
    broken.blocks[1][2][0, 3, 2] = np.nan
    with pytest.raises(DesirePathError, match="no finite position at frame"):
        replace(gait, pose=broken).check()
