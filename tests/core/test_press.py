"""Pressed by hand: bodies that are moved press ground at once, strokes are taken back, and what is kept is a bake."""

from dataclasses import replace

import numpy as np
import pytest

from desire_path.bake.bake import Bake, read_index
from desire_path.bake.press import LivePress, PressBody
from desire_path.errors import DesirePathError
from desire_path.ground import maps
from desire_path.ground.parcels import Parcel
from desire_path.ground.sim import Ground, SimulationOptions
from desire_path.ground.soil import SOILS
from tests.scenes import gaits

STILL = (1.0, 0.0, 0.0, 0.0)
FIRM = replace(SOILS["wet-sand"], rebound=0.0)  # what was pressed stays so
FIELDS = ("compression", "heap", "pressure_time")


def body(mass=None, size=0.2):
    box = gaits.box(size, size, 0.05)
    return PressBody(box.vertices, box.triangles, mass=mass, name="Box")


def ball(mass=None, radius=0.125):
    sphere = gaits.sphere(radius)
    return PressBody(sphere.vertices, sphere.triangles, mass=mass, name="Ball")


def square(x):
    """Points and triangles of flat ground, 2 m wide from x on."""
    points = [[x, -1.0, 0.0], [x + 2.0, -1.0, 0.0], [x + 2.0, 1.0, 0.0], [x, 1.0, 0.0]]
    return np.array(points), np.array([[0, 1, 2], [0, 2, 3]])


def at(x, y, z):
    return (x, y, z, *STILL)


def dragged(press, y=0.0, z=-0.02):
    press.move(at(0.0, y, z))
    press.move(at(0.3, y, z))
    press.lift()


def test_a_body_without_a_mass_presses_to_its_own_shape():
    press = LivePress(Ground.flat(0.0), body(), FIRM)
    assert press.move(at(0.0, 0.0, 0.01)) is False and press.window is None, "it hovers"
    assert press.move(at(0.0, 0.0, -0.03)) is True
    press.lift()
    deep = press.read("compression")
    assert deep.max() == pytest.approx(0.03, abs=2e-4)
    assert (deep > 0.029).sum() == pytest.approx((0.2 / 0.01) ** 2, rel=0.06)
    assert press.gap(at(0.0, 0.0, 0.0), rest=True) == pytest.approx(0.0, abs=1e-6)
    assert 0.03 < press.gap(at(0.0, 0.0, 0.05)) < 0.05, "its rim is not seen"


def test_a_ball_leaves_a_groove_as_deep_as_it_was_held_and_no_dashes():
    press = LivePress(Ground.flat(2.0), ball(), FIRM)
    press.move(at(0.0, 0.0, 2.0 + 0.125 - 0.04))
    press.move(at(0.8, 0.0, 2.0 + 0.125 - 0.04))  # in one go
    press.lift()
    i0, _, j0, _ = press.window
    along = press.read("compression")[-j0 - 1, -i0 : -i0 + 80]
    assert np.abs(along - 0.04).max() < 2e-3, along
    assert press.sim.report()["heaped_m3"] > 0.0


def test_a_mass_sinks_until_the_ground_carries_it():
    press = LivePress(Ground.flat(), body(20.0), FIRM)
    for _ in range(60):
        press.move(at(0.0, 0.0, 0.0))
    press.lift()
    expected = 20.0 * 9.81 * FIRM.layer_depth / (FIRM.young_modulus * 0.2**2)  # MODEL 11.1
    assert press.read("compression").max() == pytest.approx(expected, rel=0.01)


def test_a_slope_is_pressed_as_deep_as_a_level_ground():
    x = np.linspace(-1.0, 1.0, 41)
    heights = np.tile(0.3 * x, (41, 1))
    press = LivePress(Ground.heights(heights, 0.05, -1.0, -1.0), ball(), FIRM)
    z = -press.gap(at(0.0, 0.0, 0.0), rest=True)
    press.move(at(0.0, 0.0, z - 0.03))
    press.lift()
    assert press.read("compression").max() == pytest.approx(0.03, rel=0.06)


@pytest.mark.parametrize("mass", [None, 6.0])
def test_undo_takes_one_stroke_back_to_the_bit(mass):
    once = LivePress(Ground.flat(0.5), ball(mass), "mud")
    dragged(once, z=0.6)
    twice = LivePress(Ground.flat(0.5), ball(mass), "mud")
    dragged(twice, z=0.6)
    dragged(twice, 0.1, 0.58)
    both = twice.read("compression").sum()
    assert twice.strokes == 2 and twice.undo() and twice.strokes == 1
    assert twice.window == once.window
    for name in FIELDS:
        assert np.array_equal(once.read(name), twice.read(name)), name
    dragged(twice, 0.1, 0.58)  # and it goes on from there
    assert twice.read("compression").sum() == pytest.approx(both, rel=1e-5)
    assert twice.undo() and twice.undo() and not twice.undo()
    assert twice.window is None
    twice.move(at(0.0, 0.0, 0.6))
    assert twice.undo() and twice.window is None, "a stroke on its way is one"


def test_soil_is_kept_and_pressed_the_same_way_at_every_thread():
    found = []
    for threads in (1, 3):
        press = LivePress(Ground.flat(), ball(), "mud", options=SimulationOptions(threads=threads))
        dragged(press, z=0.1)
        found.append([press.read(name) for name in FIELDS])
        report = press.sim.report()
        assert report["heaped_m3"] == pytest.approx(
            report["displaced_m3"] + report["loosened_m3"] - report["pressed_heap_m3"], rel=1e-6
        )
    assert all(np.array_equal(*pair) for pair in zip(*found))


def test_what_is_kept_plays_and_another_walk_goes_on_from_it(tmp_path):
    press = LivePress(Ground.flat(), ball(), "mud")
    dragged(press, z=0.08)
    for rate in (0.0, float("nan")):
        with pytest.raises(DesirePathError, match="frames a second cannot be made"):
            press.keep(tmp_path / "pressed", frame_rate=rate)
    assert not (tmp_path / "pressed").exists()
    index = press.keep(tmp_path / "pressed", frame=7, frame_rate=25.0, owner="me", inputs={"pressed": "so"})
    assert (index.frames, index.frame_start, index.frame_end, index.complete) == (1, 7, 7, True)
    assert read_index(tmp_path / "pressed").inputs == {"pressed": "so"} and index.owner == "me"
    final = maps.read(tmp_path / "pressed" / "maps_final.exr").planes
    x, y, nx, ny = (64 * each for each in press.tiles())
    for name in FIELDS:
        assert np.array_equal(final[name], press.sim.read(name, x, y, nx, ny)), name
    for number in (0, 1):  # before and after its frame: a hand has no time
        shown = maps.read(index.path(number)).planes
        assert np.array_equal(shown["R"], final["heap"] - final["compression"])

    trail = Ground.read(tmp_path / "pressed" / "maps_final.exr")
    again = LivePress(trail, ball(), "mud")
    before = again.read("compression").sum()
    assert before == pytest.approx(press.read("compression").sum())
    dragged(again, 0.5, 0.08)
    assert again.read("compression").sum() > 1.5 * before
    assert again.undo() and again.read("compression").sum() == before

    gait, _ = gaits.pressed([gaits.box(0.2, 0.1)], [[0, 0, 0, *STILL]], [[0, 0, -600]], seconds=0.5)
    bake = Bake(gait, trail, "mud", tmp_path / "walked")
    for _ in bake.run():
        pass
    assert bake.report["deepest_m"] >= final["compression"].max() - 1e-6


def test_a_walk_over_several_grounds_goes_on_from_what_was_pressed_into_one(tmp_path):
    press = LivePress(Ground.flat(), body(), FIRM)
    press.move(at(-1.5, 0.0, -0.03))
    press.lift()
    press.keep(tmp_path / "pressed")
    trail = Ground.read(tmp_path / "pressed" / "maps_final.exr").trail
    west, east = (Ground.mesh(*square(x)) for x in (-2.0, 0.0))
    gait, _ = gaits.pressed([gaits.box(0.2, 0.1)], [[0.0, 0.0, 0.0, *STILL]], [[0, 0, -600]], seconds=0.5)

    def baked(*grounds):
        parcels = [Parcel(each, FIRM, tmp_path / name, name) for each, name in zip(grounds, ("west", "east"))]
        for _ in Bake(gait, parcels).run():
            pass
        return maps.read(tmp_path / "west" / "maps_final.exr").planes["compression"]

    alone = baked(west, east)
    left = baked(replace(west, trail=trail), east)
    assert 0.0 < alone.max() < 0.02
    assert left.sum() == pytest.approx(alone.sum() + press.read("compression").sum(), rel=1e-4), (
        "far from the walk, too"
    )
    with pytest.raises(DesirePathError, match="'west' and 'east' both have a trail"):
        baked(replace(west, trail=trail), replace(east, trail=trail))


def test_a_fault_in_keeping_loses_nothing(tmp_path, monkeypatch):
    press = LivePress(Ground.flat(), ball(), "mud")
    with pytest.raises(DesirePathError, match="nothing can be kept"):
        press.keep(tmp_path / "pressed")
    assert not (tmp_path / "pressed").exists()
    dragged(press, z=0.08)
    press.keep(tmp_path / "pressed")
    before = (tmp_path / "pressed" / "maps_final.exr").read_bytes()
    dragged(press, 0.4, 0.08)

    def full(*_):
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as broken:
        broken.setattr("desire_path.bake.share.Share.end", full)
        with pytest.raises(OSError, match="No space"):
            press.keep(tmp_path / "pressed")
    assert (tmp_path / "pressed" / "maps_final.exr").read_bytes() == before
    assert read_index(tmp_path / "pressed").complete and not (tmp_path / "pressed" / "bake.new").exists()
    press.keep(tmp_path / "pressed")
    assert (tmp_path / "pressed" / "maps_final.exr").read_bytes() != before
    press.drop()
    with pytest.raises(DesirePathError, match="closed"):
        press.sim.report()


@pytest.mark.parametrize(
    ("words", "ask"),
    [
        ("no faces", lambda: PressBody(np.zeros((3, 3)), np.zeros((0, 3), int))),
        ("NaN", lambda: PressBody(np.full((3, 3), np.nan), [[0, 1, 2]])),
        ("without its vertices", lambda: PressBody(np.zeros((3, 3)), [[0, 1, 3]])),
        ("A mass of -1 kg", lambda: PressBody(np.eye(3), [[0, 1, 2]], mass=-1.0)),
        ("no body", lambda: LivePress(Ground.flat(), ())),
        ("7 finite numbers", lambda: LivePress(Ground.flat(), ball()).move((0.0, 0.0, np.inf, 1.0, 0.0, 0.0, 0.0))),
        ("as many poses", lambda: LivePress(Ground.flat(), ball()).move(np.zeros((2, 7)))),
        ("unit quaternion", lambda: LivePress(Ground.flat(), ball()).move(np.zeros(7))),
        ("0 seconds", lambda: LivePress(Ground.flat(), ball()).move(at(0, 0, 0), 0)),
        ("larger ones", lambda: LivePress(Ground.flat(), ball(radius=20.0)).move(at(0, 0, 0))),
        ("7 finite numbers", lambda: LivePress(Ground.flat(), ball()).gap((0.0,))),
    ],
)
def test_what_cannot_be_is_told_in_a_sentence(words, ask):
    with pytest.raises(DesirePathError, match=words):
        ask()


def test_beside_the_ground_nothing_is_pressed():
    press = LivePress(Ground.heights(np.zeros((5, 5)), 0.1), ball(), "mud")
    assert press.move(at(5.0, 5.0, -1.0)) is False
    assert press.gap(at(5.0, 5.0, 0.0)) == np.inf
    press.lift()
    with pytest.raises(DesirePathError, match="nothing can be kept"):
        press.keep("never")
