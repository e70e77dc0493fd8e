"""A walk over several grounds is pressed as one; each ground keeps its own share of the bake."""

import json

import numpy as np
import pytest

from desire_path.bake.bake import Bake, read_index
from desire_path.bake.options import BakeOptions, BakeOutput
from desire_path.errors import DesirePathError
from desire_path.ground import maps
from desire_path.ground.parcels import Parcel
from desire_path.ground.plants import Planting
from desire_path.ground.sim import TILE, Ground
from tests.core.test_parcels import hill, tile
from tests.scenes import gaits
from tests.scenes.records import for_bake

CELL = 0.02


def level(x, y):
    return 0.0 * x


def soft(x, y):
    return 0.1 * hill(x, y)


def mesh(*where, height=level, **more):
    return Ground.mesh(*tile(*where, height=height, **more))


def walk(length=4.0, y=0.0):
    return gaits.strides(length, y=y)[0]


def run(gait, parcels, **more):
    bake = Bake(gait, parcels, **for_bake(**{"cell_size": CELL, "threads": 2, "map_seconds": False, **more}))
    for _ in bake.run():
        pass
    return bake


def in_world(folder, name="compression"):
    """(dict of world cell -> value) of a final map, cells that are 0 left out."""
    index = read_index(folder)
    plane = maps.read(folder / "maps_final.exr").planes[name]
    j, i = np.nonzero(plane)
    first = np.round(np.array([index.x0, index.y0]) / index.cell).astype(int)
    return {(int(a), int(b)): float(plane[d, c]) for a, b, c, d in zip(i + first[0], j + first[1], i, j)}


def report(folder):
    return json.loads((folder / "report.json").read_text())


@pytest.mark.parametrize("height", [level, soft])
def test_two_tiles_are_pressed_as_the_ground_they_are_cut_from(tmp_path, height):
    gait = walk()
    one = run(gait, mesh(-1, -1, 5, 1, height=height), folder=tmp_path / "one")
    two = run(
        gait,
        [
            Parcel(mesh(-1, -1, 2, 1, height=height), folder=tmp_path / "west", name="west"),
            Parcel(mesh(2, -1, 5, 1, height=height), folder=tmp_path / "east", name="east"),
        ],
    )
    whole = in_world(tmp_path / "one")
    west, east = (in_world(tmp_path / name) for name in ("west", "east"))
    for at, depth in whole.items():
        own, other = (west, east) if (at[0] + 0.5) * CELL < 2 else (east, west)
        assert own[at] == pytest.approx(depth, abs=1e-6)
        assert other.get(at, depth) == pytest.approx(depth, abs=1e-6)
    seen = [report(tmp_path / name) for name in ("west", "east")]
    assert [each["with"] for each in seen] == [["east"], ["west"]]
    assert min(each["contacts"] for each in seen) >= 2
    assert one.report["contacts"] <= sum(each["contacts"] for each in seen) <= one.report["contacts"] + 1
    assert sum(each["pressed_m3"] for each in seen) == pytest.approx(one.report["pressed_m3"], rel=0.02)
    assert sum(each["heaped_m3"] for each in seen) == pytest.approx(one.report["heaped_m3"], rel=0.02)
    assert two.report["deepest_m"] == pytest.approx(one.report["deepest_m"], abs=1e-6)
    assert max(each["deepest_m"] for each in seen) == pytest.approx(two.report["deepest_m"], abs=1e-9)


@pytest.mark.parametrize("edge", [2.0, TILE * CELL])
def test_every_frame_of_both_sides_shows_the_same_seam(tmp_path, edge):
    gait, _ = gaits.pressed(
        [gaits.box(0.3, 0.12)], [[edge, 0.0, 0, 1, 0, 0, 0]], [[0, 0, -700]], seconds=0.5, rate=24.0, lift=0.5
    )
    run(
        gait,
        [
            Parcel(mesh(-1, -1, edge, 1), folder=tmp_path / "west"),
            Parcel(mesh(edge, -1, 5, 1), folder=tmp_path / "east"),
        ],
    )
    sides = [read_index(tmp_path / name) for name in ("west", "east")]
    assert [side.frames for side in sides] == [sides[0].frames] * 2 and all(side.complete for side in sides)
    last = sides[0].frames
    for number in range(last + 1):
        columns = []
        for side in sides:
            plane = maps.read(side.path(number)).planes["R"]
            i = round((edge - side.x0) / CELL)
            j = round((-0.5 - side.y0) / CELL)
            assert 0 < i < side.nx
            columns.append(plane[j : j + 50, i - 1 : i + 1])  # the cells on either side of the seam
        assert columns[0].tobytes() == columns[1].tobytes()
    assert columns[0].min() < -0.002


def test_of_nine_tiles_those_are_made_that_are_trodden(tmp_path):
    parcels = [
        Parcel(mesh(2 * i - 1, 2 * j - 3, 2 * i + 1, 2 * j - 1), folder=tmp_path / f"{i}{j}", name=f"{i}{j}")
        for i in range(3)
        for j in range(3)
    ]
    (tmp_path / "00").mkdir()
    (tmp_path / "00" / "mine.txt").write_text("stays")
    bake = run(walk(4.0), parcels)
    assert sorted(share.parcel.name for share in bake.shares) == ["01", "11", "21"]
    assert {each.name for each in tmp_path.iterdir()} == {"00", "01", "11", "21"}
    assert [each.name for each in (tmp_path / "00").iterdir()] == ["mine.txt"]


def test_a_tile_nobody_trod_keeps_the_bake_it_has(tmp_path):
    near, far = Parcel(mesh(-1, -1, 2, 1), folder=tmp_path / "near"), Parcel(mesh(2, -1, 9, 1), folder=tmp_path / "far")
    run(walk(4.0), [near, far])
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "far").rglob("*") if path.is_file()}
    short = walk(1.0)
    bake = run(short, [near, far])
    assert [share.parcel.folder for share in bake.shares] == [str(tmp_path / "near")]
    assert before == {path: path.stat().st_mtime_ns for path in (tmp_path / "far").rglob("*") if path.is_file()}


def test_only_the_storey_that_is_trodden_is_pressed(tmp_path):
    ground, bridge = mesh(-1, -1, 5, 1), Ground.mesh(*tile(0.5, -0.5, 3, 0.5, height=level, shift=2.5))
    run(walk(), ground, folder=tmp_path / "alone")
    bake = run(
        walk(),
        [
            Parcel(bridge, folder=tmp_path / "bridge", name="bridge"),
            Parcel(ground, folder=tmp_path / "ground", name="ground"),
        ],
    )
    assert [share.parcel.name for share in bake.shares] == ["ground"]
    assert not (tmp_path / "bridge").exists()
    assert in_world(tmp_path / "ground") == in_world(tmp_path / "alone")


def test_a_walk_over_a_bridge_leaves_the_bed_below_alone(tmp_path):
    """Bank, bridge, bank; the bed of the river lies 0.8 m under the bridge."""
    banks = [mesh(-1, -1, 1, 1), mesh(3, -1, 5, 1)]
    bridge = mesh(1, -0.5, 3, 0.5)
    bed = Ground.mesh(*tile(0.9, -1, 3.1, 1, height=level, shift=-0.8))
    names = ("bed", "bank a", "bank b", "bridge")
    bake = run(
        walk(), [Parcel(each, folder=tmp_path / name, name=name) for name, each in zip(names, (bed, *banks, bridge))]
    )
    assert sorted(share.parcel.name for share in bake.shares) == ["bank a", "bank b", "bridge"]
    whole = run(walk(), mesh(-1, -1, 5, 1), folder=tmp_path / "whole")
    assert bake.report["contacts"] == whole.report["contacts"]
    middle = {at: depth for at, depth in in_world(tmp_path / "whole").items() if 55 < at[0] < 145}
    assert middle and all(
        in_world(tmp_path / "bridge")[at] == pytest.approx(depth, abs=1e-6) for at, depth in middle.items()
    )


def test_each_tile_has_its_own_soil_and_plants(tmp_path):
    lawn = Planting("carex", seed=3)
    run(
        walk(),
        [
            Parcel(mesh(-1, -1, 2, 1), "mud", tmp_path / "west", plants=[lawn], plant_mesh=True),
            Parcel(mesh(2, -1, 5, 1), "snow", tmp_path / "east"),
        ],
    )
    deep = [report(tmp_path / name) for name in ("west", "east")]
    assert deep[1]["deepest_m"] > 2 * deep[0]["deepest_m"]
    assert [each["parameters"]["soils"][0]["young_modulus"] for each in deep] == sorted(
        (each["parameters"]["soils"][0]["young_modulus"] for each in deep), reverse=True
    )
    assert read_index(tmp_path / "west").lean and not read_index(tmp_path / "east").lean
    start = maps.read(tmp_path / "east" / "maps_start.exr")
    index = read_index(tmp_path / "east")
    beyond = start.planes["plant_strength"][:, round((2.5 - index.x0) / CELL) :]
    assert not beyond.any()
    stems = np.load(tmp_path / "west" / "plants.npz")
    assert stems["vertices"][:, 0].min() < 1 and not (tmp_path / "east" / "plants.npz").exists()


def test_a_stopped_bake_of_two_goes_on_in_both(tmp_path):
    def parcels(top):
        return [Parcel(mesh(-1, -1, 2, 1), folder=top / "west"), Parcel(mesh(2, -1, 5, 1), folder=top / "east")]

    run(walk(), parcels(tmp_path / "whole"))
    stopped = Bake(
        walk(),
        parcels(tmp_path / "stopped"),
        cell_size=CELL,
        options=BakeOptions(threads=2),
        output=BakeOutput(map_seconds=False),
    ).run()
    for progress in stopped:
        if progress.fraction > 0.8:
            break
    stopped.close()
    index = read_index(tmp_path / "stopped" / "west")
    assert index.frames > 0 and not index.complete
    run(walk(), parcels(tmp_path / "stopped"))
    for name in ("west", "east"):
        one, other = (read_index(tmp_path / kind / name) for kind in ("whole", "stopped"))
        assert other.complete
        for number in (0, one.frames // 2, one.frames):
            with open(one.path(number), "rb") as a, open(other.path(number), "rb") as b:
                assert a.read() == b.read()


def test_what_cannot_be_is_told(tmp_path):
    with pytest.raises(DesirePathError, match="'a' and 'b' bake into the same folder"):
        Bake(
            walk(),
            [Parcel(mesh(0, 0, 1, 1), folder=tmp_path, name="a"), Parcel(mesh(1, 0, 2, 1), folder=tmp_path, name="b")],
        )
    with pytest.raises(DesirePathError, match="list of Parcels"):
        Bake(walk(), [])
    far = [Parcel(mesh(50, 50, 51, 51), folder=tmp_path / "a"), Parcel(mesh(51, 50, 52, 51), folder=tmp_path / "b")]
    with pytest.raises(DesirePathError):
        run(walk(), far)
    assert not list(tmp_path.iterdir())


def test_a_foot_half_over_an_edge_prints_the_half_that_is_on_the_ground(tmp_path):
    """Edges that run along the feet, under their contact points and beside them: alone, and under a bridge."""
    gait = walk(3.0)
    run(gait, Ground.flat(), folder=tmp_path / "whole")
    whole = in_world(tmp_path / "whole")
    for number, edge in enumerate((0.05, 0.09)):  # left soles reach from 0.03 to 0.13, their points lie at 0.08
        ledge, bridge = mesh(-1, edge, 4, 1), mesh(-1, edge, 4, 1, shift=2.0)
        alone, under = tmp_path / f"alone{number}", tmp_path / f"under{number}"
        run(gait, ledge, folder=alone)
        run(gait, [Parcel(ledge, folder=under, name="ledge"), Parcel(bridge, folder=tmp_path / "over", name="bridge")])
        want = {cell: depth for cell, depth in whole.items() if cell[1] * CELL > edge + CELL}
        for folder in (alone, under):
            found = in_world(folder)
            assert all(cell[1] * CELL > edge - CELL for cell in found)
            found = {cell: depth for cell, depth in found.items() if cell[1] * CELL > edge + CELL}
            assert sum(want.values()) > 0.01 and max(found.values()) <= max(want.values()) + 1e-4
            assert sum(found.values()) == pytest.approx(sum(want.values()), rel=0.05)
            assert report(folder)["contacts"] == 3
        assert not (tmp_path / "over").exists()
