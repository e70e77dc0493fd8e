"""Ground out of an image: a trail goes on as it was left, heights are taken by name, and nothing else is a height."""

import json

import numpy as np
import pytest

from desire_path.bake.bake import Bake
from desire_path.errors import DesirePathError
from desire_path.ground import maps
from desire_path.ground.options import SimulationOptions
from desire_path.ground.sim import Ground, Simulation
from tests.core.test_bake import standing
from tests.core.test_cli import run
from tests.scenes import gaits

WINDOW = (-128, -128, 384, 256)  # cells: all of both walks, and the ground around them
CELL = 0.01


def walked(sim, walk):
    sim.load(*walk)
    sim.run(len(walk[0].time) - 1)
    sim.settle()
    return sim


def left(sim, path, ground="heights", window=WINDOW):
    """The map that a bake would have written."""
    i0, j0, nx, ny = window
    names = [each.name for each in maps.MAPS + maps.GROUND]
    maps.write(
        path,
        {"Y": sim.read("compression", *window), **{name: sim.read(name, *window) for name in names}},
        {"cell": CELL, "originX": i0 * CELL, "originY": j0 * CELL, "parameters": json.dumps({"ground": ground})},
    )
    return path


def hill(hole=True):
    x, y = np.meshgrid(np.arange(-3, 4, 0.1), np.arange(-3, 3, 0.1))
    height = (5.0 + 0.05 * x + 0.03 * np.sin(3 * y)).astype(np.float32)
    if hole:
        height[(np.abs(x - 0.9) < 0.3) & (np.abs(y - 0.5) < 0.15)] = np.nan
    return Ground.heights(height, 0.1, -3, -3)


@pytest.mark.parametrize("ground", [Ground.flat(0.25), hill()], ids=["flat", "hill"])
def test_two_walks_in_turn_are_one_walk_and_then_the_other_on_its_map(tmp_path, ground):
    first, second = gaits.strides(1.4), gaits.strides(1.4, y=0.06, shift=0.3)
    first, second = ((gaits.writable(gait), loads) for gait, loads in (first, second))
    for gait, _ in (first, second):
        gait.pose[:, :, 2] += float(np.nanmax(ground.native[1])) if ground.name == "heights" else 0.25
    whole = walked(walked(Simulation(ground, "mud", CELL), first), second)
    path = left(walked(Simulation(ground, "mud", CELL), first), tmp_path / "a.exr", ground.name)
    again = Ground.read(path)
    assert again.name == ("flat" if ground.name == "flat" else "trail")
    sim = Simulation(again, "mud", CELL)
    assert not sim.warnings
    before = maps.read(path).planes
    for name in ("rest", "compression", "heap", "pressure_time"):
        assert np.array_equal(sim.read(name, *WINDOW), before[name], equal_nan=True), name
    assert before["compression"].max() > 0.01 and before["heap"].max() > 0.002
    assert ground.name == "flat" or np.isnan(before["rest"]).any()
    walked(sim, second)
    for name, most in (("compression", 1e-5), ("heap", 5e-5), ("pressure_time", 1.0)):
        there, wanted = sim.read(name, *WINDOW), whole.read(name, *WINDOW)
        assert np.abs(there - wanted).max() <= most, name
        assert np.abs(wanted - before[name]).max() > most  # the second walk did something


def test_a_trail_of_other_cells_is_averaged_and_told(tmp_path):
    sim = walked(Simulation(Ground.flat(), "mud", CELL), gaits.strides(1.4))
    ground = Ground.read(left(sim, tmp_path / "a.exr", "flat"))
    wanted = {name: float(sim.read(name, *WINDOW).astype(float).sum()) * CELL**2 for name in ("compression", "heap")}
    for cell, origin in ((0.02, (0.0, 0.0)), (0.01, (0.004, -0.003)), (0.007, (0.1, 0.1))):
        other = Simulation(ground, "mud", cell, options=SimulationOptions(origin=origin))
        assert len(other.warnings) == 1 and "averaged over cells" in other.warnings[0]
        side = int(4.5 / cell)
        for name, volume in wanted.items():
            grid = other.read(name, -side // 2, -side // 2, side, side)
            assert float(grid.astype(float).sum()) * cell**2 == pytest.approx(volume, rel=1e-5), (name, cell)
        middle = other.read("compression", round((0.1 - origin[0]) / cell), round((-0.08 - origin[1]) / cell), 1, 1)
        assert middle[0, 0] > 0.005  # the foot at x = 0.1
    assert not Simulation(ground, "mud", CELL, options=SimulationOptions(origin=(3 * CELL, -5 * CELL))).warnings


def test_the_command_line_goes_on_from_a_map(tmp_path):
    standing().save(tmp_path / "a.npz")
    standing(at=(0.1, 0.03)).save(tmp_path / "b.npz")
    first = (
        "bake",
        tmp_path / "a.npz",
        "--ground",
        "flat:0.02",
        "--soil",
        "mud",
        "--cell",
        "0.008",
        "--out",
        tmp_path / "a",
    )
    assert run(*first, "--origin", "0.003", "0").returncode == 0
    done = run(
        "bake",
        tmp_path / "b.npz",
        "--ground",
        tmp_path / "a" / "maps_final.exr",
        "--soil",
        "mud",
        "--out",
        tmp_path / "b",
    )
    assert done.returncode == 0 and "warning" not in done.stdout, done.stdout + done.stderr
    report = json.loads((tmp_path / "b" / "report.json").read_text())
    assert report["parameters"]["cell_size"] == 0.008 and report["contacts"] == 1
    pair = []
    for folder in "ab":
        picture = maps.read(tmp_path / folder / "maps_final.exr")
        at = [round((0.003 - picture.notes["originX"]) / 0.008), round(-picture.notes["originY"] / 0.008)]
        pair.append(picture.planes["compression"][at[1] - 5 : at[1] + 15, at[0] - 14 : at[0] + 40])
    trodden = pair[0] > 0
    assert (pair[1][trodden] >= pair[0][trodden]).all() and pair[1].sum() > 1.2 * pair[0].sum()
    chain = Ground.read(tmp_path / "b" / "maps_final.exr")
    assert chain.name == "flat" and chain.trail.cell == 0.008


def test_a_bake_tells_what_a_map_does_not_hold(tmp_path):
    for _ in Bake(standing(), Ground.flat(), "mud", tmp_path / "a", plants=["lawn"], cell_size=0.02).run():
        pass
    bake = Bake(standing(), Ground.read(tmp_path / "a" / "maps_final.exr"), "mud", tmp_path / "b", cell_size=0.01)
    for _ in bake.run():
        pass
    assert any("not in the map" in each for each in bake.report["warnings"])
    assert any("averaged" in each for each in bake.report["warnings"])
    trodden = Ground.read(tmp_path / "a" / "maps_start.exr")  # nobody has walked yet
    assert np.array_equal(trodden.trail.rest, maps.read(tmp_path / "a" / "maps_start.exr").planes["rest"])
    assert not trodden.trail.compression.any()


def test_the_first_map_has_the_trail_of_before(tmp_path):
    """As a picture and by name: who goes on from it goes on from that trail."""
    for folder, ground in (("a", None), ("b", "a/maps_final.exr")):
        where = Ground.flat() if ground is None else Ground.read(tmp_path / ground)
        for _ in Bake(standing(), where, "mud", tmp_path / folder, cell_size=0.02).run():
            pass
    before = maps.read(tmp_path / "a" / "maps_final.exr")
    start = maps.read(tmp_path / "b" / "maps_start.exr")
    for name in ("compression", "heap", "pressure_time"):
        assert before.planes[name].any() and np.array_equal(start.planes[name], before.planes[name]), name
    assert np.array_equal(start.planes["B"], before.planes["compression"])
    assert np.array_equal(Ground.read(tmp_path / "b" / "maps_start.exr").trail.heap, before.planes["heap"])


@pytest.mark.parametrize("name", ["height", "Height", "Z", "V", "Y", "height.Z", "shot.height", "R"])
def test_heights_go_by_their_names(tmp_path, name):
    height = np.random.default_rng(1).normal(size=(9, 12)).astype(np.float32)
    maps.write(
        tmp_path / "h.exr", {"A": np.ones_like(height), name: height}, {"cell": 0.5, "originX": 1.0, "originY": 2.0}
    )
    _, there, spacing, x0, y0, _, _ = Ground.read(tmp_path / "h.exr").native
    assert np.array_equal(there, height) and (spacing, x0, y0) == (0.5, 1.25, 2.25)


@pytest.mark.parametrize(
    "planes, notes, words",
    [
        (("compression", "heap"), {}, "without the height before the walk"),
        (("heap",), {}, "without the height before the walk"),
        (("plant_strength", "lean_x"), {}, "no channel of heights among lean_x, plant_strength"),
        (("albedo", "A"), {}, "no channel of heights"),
        (("R", "G", "B", "A"), {}, "no channel of heights"),
        (("ViewLayer.Depth.Z", "ViewLayer.Combined.R"), {}, "no channel of heights"),
        (("R", "G", "B", "A"), {"channelR": "height change [m]"}, "a frame for playback"),
        (("height",), {}, "does not say how far"),
        (("height",), {"cell": "wide"}, "does not say how far"),
        (("height",), {"cell": 1.0, "originX": "left"}, "does not say where it lies"),
        (("height",), {"cell": 1.0, "originY": 1e300}, "does not say where it lies"),
        (("rest", "compression"), {"cell": 1.0, "originX": -1e12}, "does not say where it lies"),
        (("rest", "compression"), {"cell": 1e-300}, "does not say how large its cells"),
        (("rest", "compression"), {}, "does not say how large its cells"),
        (("rest", "compression"), {"cell": -1.0}, "does not say how large its cells"),
    ],
)
def test_what_is_no_height_is_refused(tmp_path, planes, notes, words):
    rng = np.random.default_rng(5)
    maps.write(tmp_path / "h.exr", {name: rng.random((4, 5)).astype(np.float32) for name in planes}, notes)
    with pytest.raises(DesirePathError, match=words) as told:
        Ground.read(tmp_path / "h.exr")
    assert str(told.value).endswith(".") and str(tmp_path / "h.exr") in str(told.value)


@pytest.mark.parametrize(
    "name, bad", [("compression", -1.0), ("heap", np.nan), ("pressure_time", np.inf), ("rest", np.inf)]
)
def test_a_damaged_trail_is_refused(tmp_path, name, bad):
    planes = {each: np.zeros((4, 5), np.float32) for each in ("rest", "compression", "heap", "pressure_time")}
    planes[name][1, 2] = bad
    maps.write(tmp_path / "h.exr", planes, {"cell": 1.0})
    with pytest.raises(DesirePathError, match="damaged"):
        Ground.read(tmp_path / "h.exr")
