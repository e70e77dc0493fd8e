"""Sparse pictures: pages of the ground near prints are, cell for cell, what pictures of all of it are. MODEL 8.4"""

import os
from dataclasses import replace

import numpy as np
import pytest

from desire_path import DesirePathError, Gait, Ground, read_index
from desire_path.bake.atlas import EDGE, PAGE, Atlas
from desire_path.bake.bake import Bake, BakeOptions, BakeOutput
from desire_path.bake.checks import check_grounds
from desire_path.bake.grounds import simulations
from desire_path.bounds import Limits
from desire_path.farm.chunks import Frame
from desire_path.ground import maps
from desire_path.ground.planting import Planting
from desire_path.ground.sim import TILE, Simulation
from desire_path.placement import settle_feet
from desire_path.study.trampling import WALK

CELL = 0.01
FEW = Limits(cells=300_000)


def diagonal():
    return replace(Gait.load(WALK).along([[0.0, 0.0], [4.0, 3.5]]), frame_rate=12.0)


def baked(folder, limits=Limits(), gait=None, **more):
    bake = Bake(
        gait or diagonal(),
        Ground.flat(),
        "mud",
        folder,
        cell_size=CELL,
        options=BakeOptions(threads=2, limits=limits),
        **more,
    )
    for _ in bake.run():
        pass
    return read_index(folder)


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    """(all cells, pages alone) of one walk through a lawn."""
    grown = [Planting("lawn", 60.0)]
    folder = tmp_path_factory.mktemp("atlas")
    return (baked(folder / "all", plants=grown), baked(folder / "pages", FEW, plants=grown))


def test_pages_hold_what_all_cells_do(pair):
    dense, sparse = pair
    assert dense.atlas is None and sparse.atlas is not None and sparse.complete
    assert sparse.atlas.cells < 0.85 * sparse.nx * sparse.ny
    assert (dense.nx, dense.ny, dense.x0, dense.y0) == (sparse.nx, sparse.ny, sparse.x0, sparse.y0)
    i, j = np.meshgrid(np.arange(sparse.nx), np.arange(sparse.ny))
    _, _, there = sparse.atlas.find(i, j)
    assert 0.1 < there.mean() < 0.8
    for number in (0, 1, sparse.frames // 2, sparse.frames):
        for film in ("trail", "lean"):
            seen, found = dense.planes(number, film), sparse.planes(number, film)
            for name in "RGBA":
                np.testing.assert_array_equal(found[name], np.where(there, seen[name], 0.0))
                if (film, name) != ("trail", "G") and (film, name) != ("lean", "A"):  # plants stand beside it, too
                    np.testing.assert_array_equal(found[name], seen[name])


def test_edges_are_the_neighbours_cells(pair):
    """Who looks between cells finds in one page what all cells would have shown."""
    dense, sparse = pair
    picture = maps.read(sparse.path(sparse.frames)).planes["R"]
    all_of_it = np.pad(dense.planes(dense.frames)["R"], TILE)
    atlas = sparse.atlas
    assert picture.shape == (atlas.rows * TILE, atlas.columns * TILE)
    for number, (x, y) in enumerate(atlas.pages.tolist()):
        row, column = divmod(number, atlas.columns)
        page = picture[row * TILE : (row + 1) * TILE, column * TILE : (column + 1) * TILE]
        j, i = TILE + y * PAGE - EDGE, TILE + x * PAGE - EDGE
        inside = all_of_it[j : j + TILE, i : i + TILE]
        np.testing.assert_array_equal(page[: inside.shape[0], : inside.shape[1]], inside)


@pytest.mark.parametrize("turned", [False, True])
def test_pages_are_those_that_show_a_tile(turned):
    """A tile wherever it lies among the narrower pages: all that show a cell of it, and no other."""
    tiles = 34
    for tile in range(tiles):
        reached = np.zeros((1, tiles), bool)
        reached[0, tile] = True
        cells = np.zeros(tiles * TILE + 2 * EDGE, bool)
        cells[EDGE + tile * TILE : EDGE + (tile + 1) * TILE] = True
        count = -(-tiles * TILE // PAGE)
        shows = [x for x in range(count) if cells[x * PAGE : x * PAGE + PAGE + 2 * EDGE].any()]
        pages = Atlas.over(reached.T if turned else reached).pages
        found = {tuple(each) for each in (pages[:, ::-1] if turned else pages).tolist()}
        assert found == {(x, y) for x in shows for y in (0, 1)}  # a tile is wider than a page


def test_maps_show_all(pair):
    dense, sparse = ({n: maps.read(f"{os.path.dirname(each.folder)}/{n}") for n in NAMES} for each in pair)
    for name in NAMES:
        assert dense[name].planes.keys() == sparse[name].planes.keys()
        assert dense[name].notes.keys() == sparse[name].notes.keys()
        for plane, value in dense[name].planes.items():
            np.testing.assert_array_equal(value, sparse[name].planes[plane], err_msg=plane)
    assert not [each for each in os.listdir(os.path.dirname(pair[1].folder)) if each.endswith(".part")]


NAMES = ("maps_start.exr", "maps_final.exr")


def test_feet_find_their_prints_in_pages(pair):
    xy = np.random.default_rng(3).uniform((-1.0, -1.0), (5.0, 4.5), (4000, 2))
    seen = [settle_feet.Film(each).at(each.frame_start + each.frames - 1, xy) for each in pair]
    assert (seen[0] != 0.0).any()
    np.testing.assert_array_equal(*seen)


def test_a_trail_of_before_has_pages(tmp_path):
    first = baked(tmp_path / "first", FEW)
    there = diagonal()
    off = replace(there, pose=there.pose + [0, 1.5, 0, 0, 0, 0, 0], com=there.com + [0, 1.5, 0])
    ground = Ground.read(tmp_path / "first" / "maps_final.exr")
    for name, limits in (("all", Limits()), ("pages", FEW)):
        bake = Bake(off, ground, "mud", tmp_path / name, cell_size=CELL, options=BakeOptions(threads=2, limits=limits))
        for _ in bake.run():
            pass
    dense, sparse = read_index(tmp_path / "all"), read_index(tmp_path / "pages")
    assert sparse.atlas is not None and first.atlas is not None
    np.testing.assert_array_equal(dense.planes(0)["B"], sparse.planes(0)["B"])
    assert dense.planes(0)["B"].any()


def stop(folder, frames):
    """Bake so many frames in pages."""
    bake = Bake(diagonal(), Ground.flat(), "mud", folder, cell_size=CELL, options=BakeOptions(threads=2, limits=FEW))
    steps = bake.run()
    for _ in range(frames):
        next(steps)
    steps.close()


def test_a_bake_goes_on_in_the_form_it_was_begun(tmp_path):
    """Another limit is another form of the frames: those of the first do not count."""
    whole = baked(tmp_path / "whole", FEW)
    stop(tmp_path / "cut", 30)
    stopped = read_index(tmp_path / "cut")
    assert stopped.atlas is not None and 0 < stopped.frames < whole.frames
    again = baked(tmp_path / "cut", FEW)
    for number in (10, whole.frames):
        with open(whole.path(number), "rb") as a, open(again.path(number), "rb") as b:
            assert a.read() == b.read()
    stop(tmp_path / "cut2", 1)
    other = baked(tmp_path / "cut2")
    assert other.complete and other.atlas is None and other.planes(0)["R"].shape == (other.ny, other.nx)


def test_a_table_of_pages_that_is_not_theirs_is_refused(pair, tmp_path):
    sparse = pair[1]
    atlas = sparse.atlas
    atlas.write(str(tmp_path))
    assert (Atlas.read(str(tmp_path), atlas.columns, atlas.rows, sparse.nx, sparse.ny).pages == atlas.pages).all()
    for columns, nx in ((1, sparse.nx), (atlas.columns, sparse.nx + PAGE)):
        with pytest.raises(DesirePathError, match=r"pages\.exr is damaged: bake again"):
            Atlas.read(str(tmp_path), columns, atlas.rows, nx, sparse.ny)
    maps.write(tmp_path / "pages.exr", {"R": np.zeros((atlas.high, atlas.wide))})
    with pytest.raises(DesirePathError, match="damaged"):
        Atlas.read(str(tmp_path), atlas.columns, atlas.rows, sparse.nx, sparse.ny)


def test_pages_of_nowhere_are_refused():
    with Simulation(Ground.flat(), "mud", 0.01) as sim:
        for pages in ([[2, 0]], [[0, 0], [0, 0]], [[-1, 0]], np.zeros((0, 2))):
            with pytest.raises(ValueError, match="pages must lie on them"):
                sim.open_frames(0, 0, 1, 1, (2, 1, np.array(pages, np.int32)))
        with pytest.raises(ValueError, match="pages must lie on them"):
            sim.open_frames(0, 0, 1, 1, (1, 1, np.array([[0, 0], [1, 0]], np.int32)))


def far(*at):
    """One who stands in two places."""
    there = Gait.load(WALK)
    return Gait.join([there, replace(there, pose=there.pose + [*at, 0, 0, 0, 0, 0], com=there.com + [*at, 0])])


def test_a_long_diagonal_is_taken_and_a_longer_one_is_not(tmp_path):
    """400 m at 1 cm: more cells than a picture may have lie in the rectangle around it, and no more than a map may."""
    limits = Limits(memory=4e9, disk=1e9)
    bake = Bake(far(400.0, 400.0), Ground.flat(), "mud", tmp_path, output=BakeOutput(map_seconds=False))
    _, _, shares = simulations(bake)
    assert shares[0].cells > 1 << 27
    shares[0].thin(limits.cells)
    assert shares[0].cells < 1 << 22
    check_grounds(limits, bake.stepped, shares, bake.count)
    bake = Bake(far(700.0, 700.0), Ground.flat(), "mud", tmp_path)
    with pytest.raises(DesirePathError, match=r"4,294,967,296 are the most: choose cells of 0\.011 m or more") as error:
        next(bake.run())
    assert "spans 70" in str(error.value)


def test_a_map_of_more_than_2_to_the_28_cells_holds_every_print(tmp_path):
    """Two who stand 180 m apart, and the same two 6 m apart: prints in the same tiles, and nothing between."""
    found = []
    for apart in (6.4, 179.2):
        bake = Bake(
            far(apart, apart),
            Ground.flat(),
            "mud",
            tmp_path / f"{apart}",
            output=BakeOutput(frame_end=4, map_seconds=False),
        )
        list(bake.run())
        found.append(Frame.read(str(tmp_path / f"{apart}" / "maps_final.exr")))
    near, wide = found
    assert wide.columns * wide.rows * 4096 > 1 << 28
    zero = wide.tiles[wide.columns // 2, wide.rows // 4]
    prints = [{at: tile for at, tile in each.tiles.items() if tile != zero} for each in found]
    tiles = round((179.2 - 6.4) / 0.64)
    half = near.columns // 2
    assert len(prints[0]) >= 4
    assert set(prints[1]) == {(x + tiles * (x >= half), y + tiles * (x >= half)) for x, y in prints[0]}
    assert {at for at in prints[0] if prints[1].get(at) == prints[0][at]} == {at for at in prints[0] if at[0] < half}
