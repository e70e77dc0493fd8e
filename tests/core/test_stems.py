"""Stems as they are shown: down where the grass is, without a jump, for any number of threads."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import gaits

from desire_path.ground.options import SimulationOptions
from desire_path.ground.plants import KINDS, Planting
from desire_path.ground.sim import Ground, Simulation
from tests.core.test_meadow import FIELDS, lean

# ---- stems as they are shown -------------------------------------------------------------------------------------


def stepping(kind, seconds=2.0, *, threads=1, newtons=735.0, lay=True):
    """A box of 28 x 10 cm comes down at an angle, stands from 0.3 to 0.8 s and leaves: (sim, time, look).

    look() tells of every stem: `shown` and `own` particles from the foot up (plants, stems, rows, 3), its foot's cell
    as an index into maps read with WINDOW.
    """
    sim = Simulation(
        Ground.flat(),
        "wet-soil",
        0.01,
        options=SimulationOptions(threads=threads),
        plants=[Planting(kind, density=max(kind.density, 150.0), rectangle=(-0.6, -0.6, 0.6, 0.6))],
    )
    if lay:
        sim.lay_plants()
    gait, loads = gaits.pressed(
        [gaits.box(0.28, 0.10, 0.1)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -newtons]], seconds=1.0 + seconds
    )
    away = np.where(gait.time < 0.3, gait.time - 0.3, np.maximum(gait.time - 0.8, 0.0))
    gait = gaits.writable(gait)
    gait.pose[:, :, 0], gait.pose[:, :, 2] = 0.7 * away, 1.5 * abs(away)
    loads.force[:, away != 0.0], loads.touching[:, away != 0.0] = 0.0, 0
    sim.load(gait, loads)
    ((stand, _, count),) = sim.stands
    rows, stems = sim.plants_shape(stand)[:2]

    def look():
        shown, own = (
            at(stand).reshape(count, stems, rows, 3)[:, :, 1:].astype(float)
            for at in (sim.plants_shown, sim.plants_positions)
        )
        i, j = np.floor(shown[:, :, 0, :2] / 0.01).astype(int).transpose(2, 0, 1)
        return shown, own, (j + 128, i + 128)

    return sim, gait.time, look


WINDOW = (-128, -128, 256, 256)


WHOLE = {
    name: replace(
        KINDS[name],
        strength=100.0,
        spread=0.0,
        recover_rate=100.0 * KINDS[name].recover_rate / KINDS[name].strength,
        break_angle=10.0,
    )
    for name in ("carex", "lawn", "meadow")
}


def tall(stems):
    """Height of stems (.., rows, 3) over their feet."""
    return (stems[..., 2] - stems[..., :1, 2]).max(axis=-1)


@pytest.mark.parametrize("name", WHOLE)
def test_trodden_stems_are_shown_down_as_the_grass_is(name):
    sim, time, look = stepping(WHOLE[name])
    rest, _, (j, i) = look()
    high = tall(rest)
    under = (abs(rest[:, :, 0, 0]) < 0.13) & (abs(rest[:, :, 0, 1]) < 0.045)
    assert under.sum() > 10
    # under the boot, a frame after it has left, later
    for moment, risen in ((0.75, 0.3), (0.8 + 1 / 24, 0.7), (1.2, 1.2), (2.8, 1.2)):
        sim.run(int(np.searchsorted(time, moment)))
        shown, own, _ = look()
        down = 1.0 - sim.read("crushed", *WINDOW)[j, i]
        assert abs((tall(shown) / high)[under].mean() - down[under].mean()) < 0.15, moment
        assert (tall(own) / high)[under].mean() < risen
        beside = ~under & (down < 0.98)
        if moment > 1.0:  # what the simulation does is another thing
            assert (tall(own) / high)[under].mean() > 0.6
            assert abs((tall(shown) / high)[beside].mean() - down[beside].mean()) < 0.15
        # nobody else moves by it, to the bit
        none = sim.read("crushed", *WINDOW)[j, i] == 0.0
        assert none.mean() > 0.5 and (shown[none] == own[none]).all()
        # nothing is stretched, or under the ground
        edge, was = (np.linalg.norm(np.diff(stems, axis=2), axis=-1) for stems in (shown, rest))
        assert (edge <= 1.0501 * was + 1e-6).all()
        if moment > 2.0:
            np.testing.assert_allclose(edge, was, rtol=0.05)
        ground = sim.read("height_change", *WINDOW)
        k, m = np.floor(shown[..., 1::-1] / 0.01 - 0.5).astype(int).transpose(3, 0, 1, 2) + 128
        least = np.minimum.reduce([ground[k + a, m + b] for a in (0, 1) for b in (0, 1)])
        assert (shown[..., 2] > least - 2e-5).all()


def test_stems_go_over_without_a_jump():
    """From frame to frame no stem moves much farther than what the simulation does."""
    sim, time, look = stepping(WHOLE["carex"], seconds=0.5)
    was, most = None, []
    for sample in range(int(np.searchsorted(time, 0.75)), len(time) - 1, 2):
        sim.run(sample)
        now = look()[:2]
        if was is not None:
            way, own = (np.linalg.norm(a - b, axis=-1).max(axis=-1) for a, b in zip(now, was))
            most.append((way - own).max())
        was = now
    assert 1e-4 < max(most) < 0.4 * WHOLE["carex"].height, max(most)
    assert np.median(most) < 0.02 * WHOLE["carex"].height


def test_limp_stems_are_shown_as_they_lie():
    brittle = replace(KINDS["carex"], break_angle=KINDS["carex"].degrade_angle, reach=0.02)
    sim, time, look = stepping(brittle)
    rest, _, _ = look()
    sim.run(len(time) - 1)
    shown, own, _ = look()
    ((stand, _, _),) = sim.stands
    broken = (sim.plants_strength(stand).reshape(*rest.shape[:2], -1) <= 0.0)[:, :, 0]  # at the foot
    high = tall(rest)[broken]
    assert broken.sum() > 5 and (tall(own)[broken] / high).mean() < 0.3
    assert abs((tall(shown) - tall(own))[broken] / high).mean() < 0.05


def test_shown_stems_are_the_same_for_any_number_of_threads():
    told = []
    for threads in (1, 3):
        sim, time, look = stepping(KINDS["lawn"], seconds=0.3, threads=threads)
        sim.run(len(time) - 1)
        told.append(look()[0].tobytes())
    assert told[0] == told[1]


def test_laying_stems_changes_nothing_else():
    told = []
    for lay in (False, True):
        sim, time, look = stepping(KINDS["carex"], seconds=0.5, lay=lay)
        sim.run(len(time) - 1)
        shown, own, _ = look()
        assert (shown == own).all() != lay  # nobody asked: as they are
        ((stand, _, _),) = sim.stands
        told.append(
            (
                own.tobytes(),
                sim.plants_strength(stand).tobytes(),
                sim.report(),
                *(sim.read(name, *WINDOW).tobytes() for name in FIELDS),
                *(p.tobytes() for p in lean(sim, WINDOW)),
            )
        )
    assert told[0] == told[1]
