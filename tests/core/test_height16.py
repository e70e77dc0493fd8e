"""Heights of 16 bit: another library reads them back to half a step, and they lie as they are seen from above."""

import json

import numpy as np
import pytest

from desire_path.bake.bake import Bake
from desire_path.commands import main
from desire_path.errors import DesirePathError
from desire_path.ground import height16, maps
from desire_path.ground.sim import Ground
from tests.core.test_bake import standing

image = pytest.importorskip("PIL.Image")


def hill(holes=False):
    """Float32 heights that are the same in no two corners, far from 0."""
    y, x = np.mgrid[0:37, 0:53]
    grid = (800.0 + 0.31 * np.sin(0.2 * x) + 0.07 * y + 0.01 * x).astype(np.float32)
    if holes:
        grid[5:9, 40:] = np.nan
    return grid


def stored(folder, grid, spacing=0.25):
    maps.write(folder / "hill.exr", {"height": grid}, [("cell", spacing), ("originX", -3.0), ("originY", 2.0)])
    return folder / "hill.exr"


def again(path, told):
    """Values as another program reads them, row 0 at the lowest y."""
    if path.suffix == ".png":
        with image.open(path) as picture:
            assert picture.mode.startswith("I;16") and picture.size == (told["columns"], told["rows"])
            values = np.array(picture)
    else:
        values = np.fromfile(path, "<u2").reshape(told["rows"], told["columns"])
    return values[::-1]


@pytest.mark.parametrize("name", ["a.png", "a.raw", "a.R16"])
def test_heights_are_read_back_to_half_a_step(tmp_path, name):
    grid = hill()
    told = height16.write(stored(tmp_path, grid), tmp_path / name)
    assert json.loads((tmp_path / "a.json").read_text()) == told
    values = again(tmp_path / name, told)
    assert values.min() == 0 and values.max() == 65535 and told["holes"] == 0
    far = np.abs(told["offset"] + told["scale"] * values - grid.astype(float)).max()
    width = float(grid.max()) - float(grid.min())
    assert far <= width / 131070 * (1 + 1e-6) and far > width / 200000
    assert (told["x"], told["spacing"]) == (pytest.approx(-2.875), 0.25)
    assert told["y"] == pytest.approx(2.125 + 36 * 0.25)


def test_holes_have_a_value_of_their_own(tmp_path):
    grid = hill(holes=True)
    told = height16.write(stored(tmp_path, grid), tmp_path / "a.png")
    values = again(tmp_path / "a.png", told)
    assert np.array_equal(values == 0, np.isnan(grid)) and told["holes"] == 4 * 13
    there = ~np.isnan(grid)
    far = np.abs(told["offset"] + told["scale"] * values[there] - grid[there].astype(float)).max()
    assert far <= (np.nanmax(grid) - np.nanmin(grid)) / 131068 * (1 + 1e-6)


def test_level_ground_is_level(tmp_path):
    told = height16.write(stored(tmp_path, np.full((4, 6), 1.5, np.float32)), tmp_path / "a.png")
    assert (told["offset"], told["scale"]) == (1.5, 0.0) and not again(tmp_path / "a.png", told).any()


def test_a_bake_is_exported_with_its_prints(tmp_path, capsys):
    for _ in Bake(standing(), Ground.flat(0.5), "dry-sand", tmp_path / "bake", cell_size=0.02).run():
        pass
    assert main(["export", str(tmp_path / "bake"), "--format", "height16", "--out", str(tmp_path / "trail.png")]) == 0
    assert "written to" in capsys.readouterr().out
    planes = maps.read(tmp_path / "bake" / "maps_final.exr").planes
    wanted = planes["rest"].astype(float) - planes["compression"] + planes["heap"]
    told = json.loads((tmp_path / "trail.json").read_text())
    got = told["offset"] + told["scale"] * again(tmp_path / "trail.png", told)
    assert wanted.min() < 0.5 < wanted.max()
    assert np.abs(got - wanted).max() <= (wanted.max() - wanted.min()) / 131070 * (1 + 1e-6)


@pytest.mark.parametrize(
    ("source", "out", "word"),
    [
        ("hill.exr", "a.tif", "ends with"),
        ("hill.exr", "none/a.png", "folder is not there"),
        (".", "a.png", "maps_final.exr is not there"),
        ("nothing.exr", "a.png", "nothing.exr"),
        ("empty.exr", "a.png", "no ground"),
    ],
)
def test_what_cannot_be_is_said_in_a_sentence(tmp_path, source, out, word):
    stored(tmp_path, hill())
    maps.write(tmp_path / "empty.exr", {"height": np.full((3, 3), np.nan, np.float32)}, [("cell", 1.0)])
    before = sorted(path.name for path in tmp_path.iterdir())
    with pytest.raises(DesirePathError, match=word):
        height16.write(tmp_path / source, tmp_path / out)
    assert sorted(path.name for path in tmp_path.iterdir()) == before
