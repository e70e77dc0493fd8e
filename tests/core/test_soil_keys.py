"""Soils that change while they are walked on: MODEL 6.10, MODEL 11.18"""

import json
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from desire_path import SOILS, Bake, BakeOptions, DesirePathError, Ground, Parcel, SimulationOptions, Soil, SoilKeys
from desire_path.ground import trail
from desire_path.ground.pressing import PressBody, Pressing
from desire_path.ground.sim import Simulation
from tests.scenes import gaits

SOFT = Soil(young_modulus=3e5, poisson_ratio=0.3, rest_angle=0.4, settle_time=0.02)
HARD = replace(SOFT, young_modulus=2e6, poisson_ratio=0.1, rest_angle=0.6)
CELL = 0.01
NAMES = ("compression", "heap", "pressure_time")


def two_stamps():
    """A box that stands, is lifted and set down again a little aside: (Gait, loads, sample between)."""
    first, loads = gaits.pressed([gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -75 * 9.81]], lift=0.4)
    count = len(first.time)
    back = first.pose[:, ::-1] + np.array([0.1, 0.05, 0, 0, 0, 0, 0])
    pose = np.concatenate([first.pose, back, first.pose + np.array([0.1, 0.05, 0, 0, 0, 0, 0])], axis=1)
    time = np.arange(3 * count) / first.frame_rate
    gait = replace(first, time=time, pose=pose, com=np.concatenate([first.com] * 3, axis=1))
    three = [np.concatenate([each, each[:, ::-1], each], axis=1) for each in (loads.touching, loads.force, loads.point)]
    loads = SimpleNamespace(touching=three[0], force=three[1], point=three[2])
    return gait, loads, count


def of(soil, run=None, **more):
    gait, loads, _ = two_stamps()
    sim = Simulation(Ground.flat(), soil, CELL, **more)
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1 if run is None else run)
    return sim


def fields(sim):
    return [sim.read(name, -40, -40, 80, 80) for name in NAMES]


def alike(a, b):
    return all(np.array_equal(x, y) for x, y in zip(fields(a), fields(b)))


def test_keys_that_do_not_change_are_none_to_the_bit():
    names = ("young_modulus", "rest_angle", "settle_time", "layer_depth")
    for soil in (SOFT, SOILS["fresh-snow"]):
        keyed = SoilKeys(soil, {name: [(0.1, getattr(soil, name)), (1.7, getattr(soil, name))] for name in names})
        assert alike(of(keyed), of(soil))


@pytest.mark.parametrize("rough", [0.0, 0.4])
def test_a_switch_is_two_bakes_joined_to_the_bit(rough):
    soft, hard = replace(SOFT, roughness=rough), replace(HARD, roughness=rough)
    gait, loads, between = two_stamps()
    keys = {
        name: [(gait.time[between], getattr(soft, name)), (gait.time[between], getattr(hard, name))]
        for name in ("young_modulus", "poisson_ratio", "rest_angle")
    }
    whole = of(SoilKeys(soft, keys))
    half = of(soft, between)
    joined = Simulation(Ground.flat(), hard, CELL)
    joined._core.lay(-64, -64, *(half.read(name, -64, -64, 128, 128) for name in trail.LEFT))
    on = np.where(np.arange(len(gait.time)) < between, 0, loads.touching)
    later = SimpleNamespace(touching=on.astype(loads.touching.dtype), force=loads.force, point=loads.point)
    joined.load(gait, later)
    joined.run(len(gait.time) - 1)
    assert alike(whole, joined)
    assert not alike(whole, of(soft)) and not alike(whole, of(hard))


def test_what_is_pressed_stays_and_later_contacts_obey_the_new_numbers():
    _, _, between = two_stamps()
    gait = two_stamps()[0]
    keyed = SoilKeys(SOFT, {"young_modulus": [(gait.time[between], 3e5), (gait.time[between], 3e7)]})
    early, late = of(keyed, between), of(keyed)
    before = early.read("compression", -12, -5, 24, 10)
    after = late.read("compression", -12, -5, 24, 10)
    assert before.max() > 0.02 and (after >= before - 1e-9).all()
    assert late.read("compression", 14, 0, 8, 8).max() == pytest.approx(0.01 * before.max(), rel=1e-3)


def test_numbers_go_evenly_between_two_keys():
    soil = SoilKeys("mud", {"young_modulus": [(1.0, 2e6), (3.0, 4e5)], "rest_angle": [(2.0, 0.5), (2.0, 0.3)]})
    assert soil.at(0.0).young_modulus == soil.at(1.0).young_modulus == 2e6
    assert soil.at(1.5).young_modulus == pytest.approx(1.6e6)
    assert soil.at(9.0).young_modulus == 4e5 and soil.at(1.9).rest_angle == 0.5 and soil.at(2.0).rest_angle == 0.3
    assert soil.at(2.0, after=False).rest_angle == 0.5 and soil.at(0.0).poisson_ratio == SOILS["mud"].poisson_ratio
    assert soil.times() == [1.0, 2.0, 2.0, 3.0]


def test_the_core_reads_them_as_they_are():
    soil = SoilKeys(SOFT, {"young_modulus": [(0.0, 1e6), (2.0, 3e6)]})
    gait, loads, _ = two_stamps()
    sim = of(soil, 61)
    assert sim.read("young_modulus", 0, 0, 1, 1)[0, 0] == np.float32(soil.at(gait.time[60]).young_modulus)


@pytest.mark.parametrize("threads", [1, 3])
def test_painted_soils_change_each_by_itself_whatever_the_threads(threads):
    weight = np.zeros((2, 41, 41), np.float32)
    weight[0, :, :21], weight[1, :, 21:] = 1, 1
    ground = Ground.heights(np.zeros((41, 41)), 0.02, -0.4, -0.4, kind_weight=weight)
    gait, loads, between = two_stamps()
    rough = replace(SOILS["wet-sand"], rebound=0.2)
    soils = [
        SoilKeys(SOFT, {"rest_angle": [(0.0, 0.6), (2.0, 0.1)]}),
        SoilKeys(rough, {"roughness": [(0, 0), (2, 0.5)]}),
    ]
    found = []
    for count in (1, threads):
        sim = Simulation(ground, soils, CELL, options=SimulationOptions(threads=count))
        sim.load(gait, loads)
        sim.run(len(gait.time) - 1)
        found.append(sim)
    assert alike(*found)


def test_a_state_goes_on_to_the_bit_and_knows_its_keys():
    soil = SoilKeys(
        SOILS["fresh-snow"],
        {"young_modulus": [(0, 2e5), (2, 9e5)], "rebound": [(0, 0.0), (2, 0.3)], "wall_angle": [(0, 1.4), (2, 1.0)]},
    )
    gait, loads, between = two_stamps()
    whole, half = of(soil), of(soil, between + 70)
    again = Simulation(Ground.flat(), soil, CELL)
    again.load(gait, loads)
    again.restore(half.state())
    again.run(len(gait.time) - 1)
    assert alike(again, whole)
    other = Simulation(Ground.flat(), SoilKeys(soil.soil, {"young_modulus": [(0, 2e5), (2, 8e5)]}), CELL)
    other.load(gait, loads)
    with pytest.raises(DesirePathError):
        other.restore(half.state())


def test_a_bake_tells_keys_and_the_same_bake_without_them_apart(tmp_path):
    gait = two_stamps()[0]
    keyed = SoilKeys(SOFT, {"young_modulus": [(0, 3e5), (1, 1e6)]})
    one, other = (Bake(gait, Ground.flat(), soil, tmp_path / "a") for soil in (keyed, SOFT))
    assert one.signature() != other.signature() and one.warnings == other.warnings
    assert one.parameters(one.parcels[0])["soils"][0]["keys"] == {"young_modulus": [[0.0, 3e5], [1.0, 1e6]]}
    told = Bake(
        gait,
        Ground.flat(),
        SoilKeys(SOFT, {"settle_time": [(0, 0.1), (1, 0.2)]}),
        tmp_path / "b",
        options=BakeOptions(load_model="impulse"),
    )
    assert "settle_time" in told.warnings[-1] and len(told.warnings) == len(one.warnings) + 1
    assert Parcel(Ground.flat(), [keyed, "mud"]).soils == (keyed, SOILS["mud"])


def test_ground_that_is_pressed_by_hand_takes_none():
    box = gaits.box(0.2, 0.1)
    with pytest.raises(DesirePathError, match="by hand"):
        Pressing(Ground.flat(), PressBody(box.vertices, box.triangles), SoilKeys("mud", {"rest_angle": [(0, 0.3)]}))


def test_keys_are_saved_and_come_back(tmp_path):
    soil = SoilKeys("mud", {"young_modulus": [(0, 2e6), (5, 4e5)], "rest_angle": [(1, 0.2)]})
    soil.save(tmp_path / "keys.json")
    assert SoilKeys.load(tmp_path / "keys.json", "mud") == soil
    (tmp_path / "short.json").write_text('{"rest_angle": [[0, 0.5], [2, 0.2]]}')
    assert SoilKeys.load(tmp_path / "short.json", SOFT).at(1.0).rest_angle == pytest.approx(0.35)


@pytest.mark.parametrize(
    "keys, words",
    [
        ({"softness": [[0, 1]]}, "No soil has 'softness'"),
        ({"young_modulus": []}, "no pairs"),
        ({"young_modulus": 3}, "no pairs"),
        ({"young_modulus": [[0, "x"]]}, "no pairs"),
        ({"young_modulus": [[1, 1e6], [0, 1e6]]}, "rise"),
        ({"young_modulus": [[0, 1e6], [0, 1e6], [0, 2e6]]}, "rise"),
        ({"young_modulus": [[math.nan, 1e6]]}, "rise"),
        ({"young_modulus": [[0, -1]]}, "young_modulus of -1"),
        ({"grain_size": [[0, 0.01], [1, 0.02]]}, "grain_size cannot change over time"),
        ([], "go by name"),
    ],
)
def test_keys_that_cannot_be_are_refused_in_words(keys, words, tmp_path):
    with pytest.raises(DesirePathError, match=words):
        SoilKeys(SOFT, keys)
    (tmp_path / "keys.json").write_text(json.dumps(keys))
    with pytest.raises(DesirePathError):
        SoilKeys.load(tmp_path / "keys.json", SOFT)
