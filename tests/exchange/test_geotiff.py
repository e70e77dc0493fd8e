"""Terrain that another library wrote as GeoTIFF: heights and places are those that it was given."""

import numpy as np
import pytest
import rasterio
from rasterio.transform import Affine, from_origin

from desire_path.commands import main
from desire_path.errors import DesirePathError
from desire_path.ground import geotiff, height16
from desire_path.ground.sim import Ground
from desire_path.motion.gait import Gait
from tests.core.test_bake import standing


def stored(path, grid, turn=from_origin(300.0, 2000.0, 0.5, 0.5), crs="EPSG:25832", **more):
    said = {name: more.pop(name) for name in ("units", "scales", "offsets") if name in more}
    about = {"driver": "GTiff", "count": 1, "dtype": grid.dtype, "height": grid.shape[0], "width": grid.shape[1]}
    with rasterio.open(path, "w", crs=crs, transform=turn, **about, **more) as file:
        file.write(grid, 1)
        for name, value in said.items():
            setattr(file, name, (value,))
    return path


def hill():
    """Heights from the north, the same in no two places."""
    return (40.0 + 0.1 * np.arange(12)[:, None] + 0.013 * np.arange(20)).astype(np.float32)


def test_heights_lie_where_the_map_says(tmp_path):
    grid = hill()
    heights, step, x, y = geotiff.read(stored(tmp_path / "a.tif", grid))
    assert (step, x, y) == (0.5, 300.25, 2000.0 - 6.0 + 0.25) and heights.dtype == np.float32
    assert np.array_equal(heights[::-1], grid)
    with rasterio.open(tmp_path / "a.tif") as file:  # another reading of the same places
        for j, i in ((0, 0), (3, 17), (11, 5)):
            assert next(file.sample([(x + step * i, y + step * j)]))[0] == heights[j, i]


def test_rows_may_go_north(tmp_path):
    heights, step, x, y = geotiff.read(stored(tmp_path / "a.tif", hill(), Affine(2.0, 0, 10.0, 0, 2.0, -7.0)))
    assert np.array_equal(heights, hill()) and (step, x, y) == (2.0, 11.0, -6.0)


def test_none_is_no_ground_and_whole_numbers_have_a_scale(tmp_path):
    grid = np.arange(200, 320, dtype=np.int16).reshape(10, 12)
    grid[2, 3] = -9999
    heights, *_ = geotiff.read(stored(tmp_path / "a.tiff", grid, nodata=-9999, scales=0.01, offsets=5.0))
    wanted = np.where(grid == -9999, np.nan, 5.0 + 0.01 * grid)[::-1]
    assert np.allclose(heights, wanted, equal_nan=True) and np.isnan(heights).sum() == 1


def test_feet_are_told_in_metres(tmp_path):
    _, step, x, _ = geotiff.read(stored(tmp_path / "a.tif", hill(), crs="EPSG:2263"))  # New York, US survey feet
    assert step == pytest.approx(0.5 * 1200 / 3937) and x == pytest.approx(300.25 * 1200 / 3937)


def test_it_is_walked_on_and_exported(tmp_path):
    path = stored(tmp_path / "a.TIF", np.zeros((40, 40), np.float32), from_origin(-5.0, 5.0, 0.25, 0.25))
    standing().save(tmp_path / "walk.npz")
    assert Gait.load(tmp_path / "walk.npz")
    words = [
        "bake",
        str(tmp_path / "walk.npz"),
        "--ground",
        str(path),
        "--cell",
        "0.02",
        "--out",
        str(tmp_path / "bake"),
    ]
    assert main(words) == 0 and (tmp_path / "bake" / "maps_final.exr").exists()
    assert Ground.read(path).arrays()
    told = height16.write(stored(tmp_path / "b.tif", hill()), tmp_path / "b.png")
    assert told["highest"] == pytest.approx(float(hill().max()))
    assert main(["export", str(tmp_path / "b.tif"), "--format", "usd", "--out", str(tmp_path / "b.usdc")]) == 0


@pytest.mark.parametrize(
    ("more", "word"),
    [
        ({"crs": "EPSG:4326", "turn": from_origin(9.0, 48.0, 0.001, 0.001)}, "in degrees"),
        ({"turn": from_origin(0.0, 0.0, 0.5, 0.7)}, "not square"),
        ({"turn": Affine(0.5, 0.1, 0.0, 0.1, -0.5, 0.0)}, "along x and y"),
        ({"turn": Affine.identity(), "crs": None}, "--spacing"),
        ({"units": "ft"}, "in ft"),
    ],
)
def test_what_is_no_terrain_is_said_in_a_sentence(tmp_path, more, word):
    with pytest.raises(DesirePathError, match=word):
        geotiff.read(stored(tmp_path / "a.tif", hill(), **more))


def test_samples_without_a_place_lie_as_they_are_told(tmp_path):
    heights, step, x, y = geotiff.read(stored(tmp_path / "a.tif", hill(), Affine.identity(), None), 0.3)
    assert (step, x, y) == (0.3, 0.15, 0.15) and np.array_equal(heights[::-1], hill())


@pytest.mark.parametrize("data", [b"", b"II*\0", b"not a picture", None])
def test_damage_is_said_in_a_sentence(tmp_path, data):
    if data is None:
        data = stored(tmp_path / "whole.tif", hill()).read_bytes()[:-200]
    (tmp_path / "a.tif").write_bytes(data)
    with pytest.raises(DesirePathError, match="damaged or no GeoTIFF"):
        geotiff.read(tmp_path / "a.tif")


@pytest.mark.parametrize("name", ["none.tif", "folder.tif", "/vsimem/a.tif"])
def test_only_files_are_opened(tmp_path, name):
    (tmp_path / "folder.tif").mkdir()
    with pytest.raises(DesirePathError, match="cannot be opened"):
        geotiff.read(tmp_path / name)
