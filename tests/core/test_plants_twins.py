"""native/plants against tests/reference/plants.py; kinds as data."""

import json
import math
from dataclasses import asdict, replace

import numpy as np
import pytest

from desire_path import _native
from desire_path.errors import DesirePathError
from desire_path.ground.plants import KINDS, PAPER, YEAR, Kind
from tests.reference import plants as twin


class Stand:
    """Plants far apart, at rest, and the same for the twin."""

    def __init__(self, kind, seed, n=9):
        kind = replace(kind, spread=0.0)
        self.kind, self.n, self.seed = kind, n, seed
        self.random = np.random.default_rng(seed)
        self.rows, self.stems, _, self.particles, self.bends = _native.plants_shape(kind.numbers())
        self.root = np.zeros((n, 3), np.float32)
        self.root[:, :2] = self.random.random((n, 2))
        self.heading = self.random.random(n, np.float32) * 6
        self.at = np.zeros((n, self.particles, 3), np.float32)
        _native.plants_rest_shape(kind.numbers(), seed, self.root, self.heading, self.at)
        self.speed = np.zeros_like(self.at)
        self.strength = np.full((n, self.bends), kind.strength)

    def twin(self):
        grid = (self.n, self.stems, self.rows, 3)
        return (
            self.at.astype(float).reshape(grid),
            self.speed.astype(float).reshape(grid),
            self.strength.reshape(self.n, self.stems, self.rows - 2).copy(),
        )

    def step(self, dt, steps=1, colliders=(), ground=None, workers=1):
        return _native.plants_step(
            self.kind.numbers(),
            self.seed,
            self.root,
            self.heading,
            self.at,
            self.speed,
            self.strength,
            ground,
            colliders,
            dt,
            steps,
            workers,
        )

    def free(self):
        return np.tile(np.arange(self.rows) >= 2, self.stems)


@pytest.mark.parametrize("name", KINDS)
def test_rest_shapes(name):
    stand = Stand(KINDS[name], 3)
    for k in range(stand.n):
        rest = twin.turned(twin.rest_shape(asdict(stand.kind)), stand.heading[k]) + stand.root[k]
        np.testing.assert_allclose(stand.at[k], rest.reshape(-1, 3), atol=2e-6)
    assert stand.at[..., 2].max() <= stand.kind.height + 1e-6
    if stand.kind.curl == 0:
        assert stand.at[..., 2].max() == pytest.approx(stand.kind.height, abs=1e-6)


@pytest.mark.parametrize("name", ("carex", "lycopodium", "meadow"))
@pytest.mark.parametrize("dt", (1 / 60, 1 / 24, 1 / 480))
def test_solve_trail_5_6(name, dt):
    stand = Stand(KINDS[name], 5, n=3)
    free = stand.free()
    stand.speed[:, free] = (2 * stand.random.random((stand.n, free.sum(), 3)) - 1).astype(np.float32)
    stand.strength *= 0.3 + 0.7 * stand.random.random(stand.strength.shape)
    stand.strength[0, 3] = stand.strength[1, 0] = 0.0
    at, speed, strength = stand.twin()
    for _ in range(4):
        stand.step(dt)
        for k in range(stand.n):
            twin.step(
                asdict(stand.kind),
                stand.root[k].astype(float),
                stand.heading[k],
                stand.kind.strength,
                at[k],
                speed[k],
                strength[k],
                dt,
            )
        np.testing.assert_allclose(stand.at, at.reshape(stand.at.shape), atol=3e-5)
        np.testing.assert_allclose(stand.strength, strength.reshape(stand.strength.shape), atol=1e-7)
    assert np.abs(stand.at - Stand(KINDS[name], 5, n=3).at).max() > 1e-3
    assert (stand.strength > 0).any()


@pytest.mark.parametrize("name", ("carex", "lycopodium"))
def test_a_plant_let_go_comes_to_where_the_printed_constraints_hold_trail_5(name):
    stand = Stand(replace(PAPER[name], form="surface"), 4, n=4)
    rest = stand.at.astype(float).reshape(stand.n, stand.stems, stand.rows, 3)
    free = stand.free()
    stand.at[:, free, :2] += 0.02 * (stand.at[:, free, 2:] / stand.kind.height) ** 2  # bent aside
    stretched, bent = twin.constraints(stand.twin()[0][0], rest[0])
    assert abs(bent).max() > 0.05
    longest = 0.0
    stand.step(0.1)  # it was stretched by bending it
    for _ in range(300):
        stand.step(1 / 60)
        for k in range(stand.n):
            own = stand.twin()[0][k]
            up = np.linalg.norm(np.diff(own, axis=1), axis=-1) / np.linalg.norm(np.diff(rest[k], axis=1), axis=-1) - 1
            longest = max(longest, abs(up).max())
    assert longest < 0.05  # stems keep their length on the way
    for k in range(stand.n):
        stretched, bent = twin.constraints(stand.twin()[0][k], rest[k])
        assert abs(stretched).max() < 0.01 and abs(bent).max() < math.radians(1)


def test_wear_trail_6():
    random = np.random.default_rng(1)
    for kind in KINDS.values():
        for _ in range(200):
            reserve = 0.5 + random.random()
            strength, angle, dt = reserve * random.random(), 2 * random.random(), 3 * random.random()
            told = _native.plants_wear(kind.numbers(), reserve, strength, angle, dt)
            assert told == pytest.approx(twin.wear(asdict(kind), reserve, strength, angle, dt), abs=1e-6)


def test_oracle_8_any_dt():
    carex = PAPER["carex"].numbers()
    for dt in (1 / 240, 1 / 60, 0.3):
        strength, time = 0.1, 0.0
        while strength > 0:
            strength = _native.plants_wear(carex, 0.1, strength, math.radians(30), dt)
            time += dt
            assert strength == pytest.approx(max(0.1 - 0.1 * time, 0), abs=1e-7)
        assert 1 - 1e-6 <= time <= 1 + dt + 1e-6


@pytest.mark.parametrize("law", (0, 1))
def test_cover_trail_7_8(law):
    kind = replace(KINDS["carex"], spread=0.0)
    stand = Stand(kind, 8, n=60)
    stand.strength[stand.random.random(stand.strength.shape) < 0.4] = 0.0
    alpha, modulus = np.zeros((12, 14), np.float32), np.zeros((12, 14), np.float32)
    _native.plants_cover(kind.numbers(), stand.root, stand.strength, (-0.1, -0.1, 0.1), law, alpha, modulus)
    stems = stand.strength.reshape(stand.n, stand.stems, -1)
    whole = np.minimum.accumulate(stems > 0, axis=2).mean(axis=(1, 2))
    expected = twin.cover(asdict(kind), stand.root.astype(float), whole, -0.1, -0.1, 0.1, 14, 12, law == 1)
    np.testing.assert_allclose(alpha, expected[0], atol=2e-6)
    np.testing.assert_allclose(modulus, expected[1], atol=20)
    assert 0 < alpha.max() <= 1 and alpha.min() == 0


def test_regrowth_follows_its_twin():
    carex = PAPER["carex"]
    for share in (0.0, 0.3, 1.0):
        kind = replace(carex, seed_share=share)
        for alpha in (0.863, 0.704, 0.398, 0.2, 0.0):
            told = _native.plants_regrow(kind.numbers(), alpha, YEAR)
            assert told == pytest.approx(twin.regrow(asdict(kind), alpha, YEAR), abs=1e-4)
    # Cole 1995, one year: within 4.6 points by one rate
    for two_weeks, year in ((0.863, 0.962), (0.704, 0.838), (0.398, 0.602), (0.2, 0.455)):
        assert _native.plants_regrow(carex.numbers(), two_weeks, YEAR) == pytest.approx(year, abs=0.047)


@pytest.mark.parametrize("name", KINDS)
def test_every_kind_bears_a_boot(name):
    """Nothing stretches by more than 5 %, nothing is lost; what stands outside keeps standing."""
    kind = KINDS[name]
    stand = Stand(kind, 2, n=12)
    stand.root[:, :2] *= 0.4
    stand.root[11, :2] = (3, 3)
    stand = _restand(stand)
    bottom = np.full((21, 41), np.inf, np.float32)
    bottom[5:16, 5:36] = 0.0
    gap = kind.height / (stand.rows - 2)
    for frame in range(40):
        z = max(0.3 - 0.02 * frame, 0.0)
        bottom[5:16, 5:36] = z
        sole = (0.0, 0.1, 0.01, bottom, 0.12, (0.0, 0.0, -1.2 if z > 0 else 0.0), 0.5)
        stand.step(1 / 60, colliders=(sole,))
        at = stand.at.reshape(stand.n, stand.stems, stand.rows, 3)
        length = np.linalg.norm(np.diff(at[:, :, 1:], axis=2), axis=-1)
        assert np.isfinite(at).all() and length.max() <= 1.0501 * gap
        assert at[:, :, 1:, 2].min() >= -1e-6
    rest = np.zeros_like(stand.at)
    _native.plants_rest_shape(kind.numbers(), 2, stand.root, stand.heading, rest)
    np.testing.assert_allclose(stand.at[11], rest[11], atol=0.01 * kind.height)
    assert np.abs(stand.at - rest).max() > 0.3 * kind.height


def _restand(stand):
    _native.plants_rest_shape(stand.kind.numbers(), stand.seed, stand.root, stand.heading, stand.at)
    return stand


def test_workers_change_nothing():
    answers = []
    for workers in (1, 2, 3):
        stand = Stand(replace(KINDS["meadow"], spread=1.0), 4, n=300)
        stand.strength[:] = 1e-3
        stand.speed[:, stand.free()] = 0.4
        stand.step(1 / 60, steps=5, workers=workers)
        answers.append((stand.at.tobytes(), stand.speed.tobytes(), stand.strength.tobytes()))
    assert answers[0] == answers[1] == answers[2]


def test_placement():
    root = np.zeros((4000, 2), np.float32)
    weight = np.array([[0, 1]], np.float32)
    count = _native.plants_place(0, 0, 4, 2, 100, weight, 3, root)
    assert count == 400 and root[:count, 0].min() >= 2
    again = np.zeros_like(root)
    _native.plants_place(0, 0, 4, 2, 100, weight, 3, again)
    assert np.array_equal(root, again)
    with pytest.raises(ValueError, match="placing plants"):
        _native.plants_place(0, 0, 0, 2, 100, None, 3, root)


def test_the_door_checks_what_comes_in():
    stand = Stand(KINDS["carex"], 1)
    numbers = stand.kind.numbers()
    with pytest.raises(ValueError, match="kind: height of 11 m is out of its range, 0 to 10"):
        _native.plants_shape({**numbers, "height": 11.0})
    with pytest.raises(ValueError, match="kind: it has no number 'hight'"):
        _native.plants_shape({**numbers, "hight": 0.1})
    with pytest.raises(TypeError, match="kind: height is no number"):
        _native.plants_shape({**numbers, "height": "tall"})
    with pytest.raises(ValueError, match="kind: sheets is neither 2 nor 3"):
        _native.plants_shape({**numbers, "sheets": 4})
    with pytest.warns(DeprecationWarning, match="kind: numbers in a row are an old way"):
        row = _native.plants_shape(_native.plants_default())
    assert _native.plants_shape({}) == row
    for row in (_native.plants_default()[1:], 7, None, ()):
        with pytest.raises(TypeError, match="kind: not a dict by name"):
            _native.plants_shape(row)
    with pytest.raises(ValueError, match="strength"):
        stand.strength *= 2
        stand.step(0.1)
    stand.strength /= 2
    with pytest.raises(ValueError, match="moving plants"):
        stand.step(0.0)
    with pytest.raises(TypeError, match="bottom"):
        stand.step(0.1, colliders=((0.0, 0.0, 0.1, np.zeros((3, 3)), 0.1, (0.0, 0.0, 0.0), 0.1),))
    with pytest.raises(TypeError, match="collider"):
        stand.step(0.1, colliders=(7,))
    with pytest.raises(ValueError, match="out of its range"):
        _native.plants_wear(numbers, 0.1, 0.1, math.nan, 0.1)


# ---- kinds as data -----------------------------------------------------------------------------


def test_kinds_are_the_papers_and_what_a_film_needs():
    assert {"carex", "lycopodium", "lawn", "meadow", "wheat", "moss", "fern"} <= set(KINDS)
    carex, lycopodium = PAPER["carex"], PAPER["lycopodium"]
    degrees = [round(math.degrees(a), 6) for k in (carex, lycopodium) for a in (k.degrade_angle, k.break_angle)]
    assert degrees == [10, 70, 5, 50]
    assert (carex.strength, lycopodium.strength) == (0.1, 0.08)
    np.testing.assert_allclose(list(carex.numbers().values()), _native.plants_default(), rtol=1e-6)
    assert _native.plants_shape(carex.numbers())[3] == 28
    for kind in KINDS.values():
        assert kind.density > kind.full_density


def test_a_kind_is_saved_and_shared(tmp_path):
    path = tmp_path / "rye.json"
    rye = replace(KINDS["wheat"], height=1.4, spacing=0.1, spread=0.5)
    rye.save(path)
    assert Kind.load(path) == rye and [p.name for p in tmp_path.iterdir()] == ["rye.json"]
    path.write_text(json.dumps({"desire_path_plant": 1, "height": 0.3}))
    assert Kind.load(path) == Kind(height=0.3)


@pytest.mark.parametrize(
    "text, words",
    [
        ("", "not a plant kind"),
        ("[]", "not a plant kind"),
        ('{"height": 1}', "of this version"),
        ('{"desire_path_plant": 1, "wings": 2}', "says wings"),
        ('{"desire_path_plant": 1, "height": "x"}', "height of 'x'"),
        ('{"desire_path_plant": 1, "height": -1}', "height of -1"),
        ('{"desire_path_plant": 1, "form": "tree"}', "form"),
        ('{"desire_path_plant": 1, "spacing": 0.001}', "too many particles"),
        ('{"desire_path_plant": 1, "break_angle": 0.01}', "below its degrade_angle"),
        ('{"desire_path_plant": 1, "sheets": 7}', "sheets"),
        ('{"desire_path_plant": 1, "sway": NaN}', "sway of nan"),
    ],
)
def test_bad_kinds_get_a_sentence(tmp_path, text, words):
    path = tmp_path / "kind.json"
    path.write_text(text)
    with pytest.raises(DesirePathError, match=words):
        Kind.load(path)
    with pytest.raises(DesirePathError, match="check the path"):
        Kind.load(tmp_path / "nothing.json")
    with pytest.raises(DesirePathError, match="cannot be read"):
        Kind.load(tmp_path)
