"""Maps: what is written is what is read, here and by other programs; errors are sentences."""

import hashlib
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from desire_path import _native
from desire_path.errors import DesirePathError
from desire_path.ground import maps


@pytest.fixture
def grids():
    rng = np.random.default_rng(3)
    grids = {entry.name: rng.normal(size=(37, 83)).astype(np.float32) for entry in maps.MAPS}
    grids["heap"][5:20] = 0
    grids["heap"][0, :4] = [np.nan, np.inf, -0.0, 1e-42]
    return grids


def same_bits(a, b):
    return a.dtype == b.dtype == np.float32 and a.shape == b.shape and a.tobytes() == b.tobytes()


def test_what_is_written_is_what_is_read(tmp_path, grids):
    path = tmp_path / "maps ä.exr"
    notes = {"software": "Desire Path ü", "cell": 0.01, "count": 3, "empty": ""}
    maps.write(path, grids, notes)
    picture = maps.read(path)
    assert sorted(picture.planes) == sorted(grids)
    assert picture.shape == (37, 83)
    for name, grid in grids.items():
        assert same_bits(picture.planes[name], grid)
    assert picture.notes == notes
    assert [entry.name for entry in tmp_path.iterdir()] == ["maps ä.exr"]


def test_long_texts_are_written_in_parts_that_a_player_has_room_for(tmp_path):
    path, grid = tmp_path / "long.exr", np.arange(6, dtype=np.float32).reshape(2, 3)
    for first in range(5):  # letters of 1, 2, 3 and 4 bytes end parts
        notes = {"parameters": "." * first + 300 * "aü€\U0001f97e", "full": "f" * 255, "over": "o" * 256, "cell": 1.0}
        maps.write(path, {"Y": grid}, notes)
        assert maps.read(path).notes == notes
        written = dict(_native.maps_read(str(path))[4])
        sizes = [len(text.encode()) for text in written.values() if isinstance(text, str)]
        assert max(sizes) == 255 and len(sizes) == 12 + 1 + 2 and written["full"] == "f" * 255
        shown = subprocess.run(
            ["ffmpeg", "-v", "error", "-i", str(path), "-f", "rawvideo", "-"], check=True, capture_output=True
        )
        assert np.array_equal(np.frombuffer(shown.stdout, np.float32).reshape(2, 3), grid[::-1])


def test_maps_are_layers_and_letters_are_channels(tmp_path):
    path, grid = tmp_path / "layers.exr", np.ones((2, 3), np.float32)
    maps.write(path, {"heap": grid, "Y": grid, "depth.Z": grid})
    assert sorted(_native.maps_read(str(path))[2]) == ["Y", "depth.Z", "heap.V"]
    assert sorted(maps.read(path).planes) == ["Y", "depth.Z", "heap"]


def test_files_of_before_with_bare_names_are_read(tmp_path):
    path, grid = tmp_path / "old.exr", np.ones((2, 3), np.float32)
    _native.maps_write(str(path), ["compression", "heap"], [grid, 2 * grid], [])
    assert {name: plane.max() for name, plane in maps.read(path).planes.items()} == {"compression": 1, "heap": 2}


def test_any_array_becomes_float32(tmp_path):
    path = tmp_path / "any.exr"
    plane = np.arange(12.0).reshape(3, 4)
    maps.write(path, {"Y": plane.T, "list": np.arange(12).reshape(4, 3)})
    picture = maps.read(str(path))
    assert (picture.planes["Y"] == plane.T).all()
    assert (picture.planes["list"].ravel() == np.arange(12)).all()


def test_oiiotool_reads_the_same_bits(tmp_path, grids):
    path = tmp_path / "maps.exr"
    maps.write(path, grids, {"cell": 0.25, "soil": "mud"})
    told = subprocess.run(["oiiotool", "--info", "-v", str(path)], capture_output=True, text=True)
    assert "83 x   37, 4 channel, float openexr" in told.stdout
    assert "compression.V, heap.V, plant_strength.V, pressure_time.V" in told.stdout
    assert "cell: 0.25" in told.stdout and 'soil: "mud"' in told.stdout
    # the fingerprint of what it holds in memory: pixel by pixel, highest row first
    told = subprocess.run(["oiiotool", "--hash", str(path)], capture_output=True, text=True)
    pixels = np.stack([grids[name][::-1] for name in sorted(grids)], axis=-1)
    assert hashlib.sha1(pixels.tobytes()).hexdigest() in told.stdout.lower()


def test_a_file_of_oiiotool_is_read(tmp_path):
    path = tmp_path / "theirs.exr"
    subprocess.run(
        [
            "oiiotool",
            "--pattern",
            "fill:topleft=0,0.5,1:topright=1,0.5,0:bottomleft=0,0,0:bottomright=1,1,1",
            "65x33",
            "3",
            "-d",
            "half",
            "--tile",
            "16",
            "16",
            "--compression",
            "piz",
            "-o",
            str(path),
        ],
        check=True,
    )
    picture = maps.read(path)
    assert picture.shape == (33, 65) and sorted(picture.planes) == ["B", "G", "R"]
    red, blue = picture.planes["R"], picture.planes["B"]
    assert red[-1, 0] == 0 and red[-1, -1] == 1 and blue[-1, 0] == 1  # the highest row
    assert red[0, 0] == 0 and blue[0, -1] == 1  # the lowest


@pytest.mark.parametrize("packing", ["none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"])
def test_heights_of_every_packing_are_read(tmp_path, packing):
    y, x = np.mgrid[0:70, 0:150]
    height = (0.3 * np.sin(x / 20) + 0.2 * np.cos(y / 13)).astype(np.float32)
    maps.write(tmp_path / "own.exr", {"Y": height})
    path = tmp_path / "theirs.exr"
    for name in ("height", "Z", "V", "Y"):
        for kind, tiles in (
            ("float", []),
            ("half", []),
            ("float", ["--tile", "32", "32"]),
            ("half", ["--tile", "64", "64"]),
        ):
            subprocess.run(
                [
                    "oiiotool",
                    str(tmp_path / "own.exr"),
                    "--chnames",
                    name,
                    "-d",
                    kind,
                    *tiles,
                    "--compression",
                    packing,
                    "-o",
                    str(path),
                ],
                check=True,
            )
            (plane,) = maps.read(path).planes.values()
            assert np.abs(plane - height).max() < (0.02 if packing.startswith("b44") else 0.005), (name, kind, tiles)


def test_a_packing_of_a_newer_openexr_is_named(tmp_path, grids):
    path = tmp_path / "tomorrow.exr"
    maps.write(path, grids)
    named = b"compression\0compression\0\1\0\0\0"
    for packing in (10, 11, 12, 13, 200):
        head, rest = path.read_bytes().split(named)
        path.write_bytes(head + named + bytes([packing]) + rest[1:])
        with pytest.raises(DesirePathError, match="packing unknown here.* write it again with ZIP"):
            maps.read(path)


@pytest.mark.parametrize(
    "planes, words",
    [
        ({}, "nothing to write"),
        ({"heap": np.zeros(4)}, "rows and columns"),
        ({"heap": np.zeros((0, 4))}, "rows and columns"),
        ({"heap": np.zeros((2, 2)), "rest": np.zeros((2, 3))}, "differ in shape"),
        ({"": np.zeros((2, 2))}, "different names"),
        ({"x" * 30: np.zeros((2, 2))}, "different names"),
        ({f"n{k}": np.zeros((2, 2)) for k in range(65)}, "up to 64 maps"),
    ],
)
def test_bad_planes_are_told(tmp_path, planes, words):
    path = tmp_path / "never.exr"
    with pytest.raises(DesirePathError, match=words) as told:
        maps.write(path, planes)
    assert str(path) in str(told.value) and str(told.value).endswith(".")
    assert not path.exists()


@pytest.mark.parametrize("notes", [{"dataWindow": "mine"}, {"": 1.0}, [("a", 1.0), ("a", 2.0)], {"zero": "a\0b"}])
def test_bad_notes_are_told(tmp_path, notes):
    with pytest.raises(DesirePathError, match="cannot be written"):
        maps.write(tmp_path / "never.exr", {"heap": np.zeros((2, 2))}, notes)
    assert not list(tmp_path.iterdir())


def test_a_failed_write_leaves_the_old_file(tmp_path, grids):
    path = tmp_path / "maps.exr"
    maps.write(path, grids)
    before = path.read_bytes()
    with pytest.raises(DesirePathError):
        maps.write(path, grids, {"channels": "mine"})
    assert path.read_bytes() == before
    with pytest.raises(DesirePathError, match="cannot be written .*choose another folder"):
        maps.write(tmp_path / "no" / "folder.exr", grids)
    with pytest.raises(DesirePathError, match="cannot be written"):
        maps.write(tmp_path, grids)
    assert [entry.name for entry in tmp_path.iterdir()] == ["maps.exr"]


def test_a_linked_copy_is_never_written_into(tmp_path, grids):
    path, link = tmp_path / "a.exr", tmp_path / "b.exr"
    maps.write(path, grids)
    os.link(path, link)
    before = link.read_bytes()
    maps.write(path, {"heap": np.ones((3, 3))})
    assert link.read_bytes() == before and maps.read(path).shape == (3, 3)


def test_damaged_files_are_told(tmp_path, grids):
    path = tmp_path / "maps.exr"
    with pytest.raises(DesirePathError, match="cannot be opened"):
        maps.read(path)
    maps.write(path, grids)
    whole = path.read_bytes()
    for damaged in (b"", whole[:100], whole[:-1], b"no image at all"):
        path.write_bytes(damaged)
        with pytest.raises(DesirePathError, match="damaged or no flat OpenEXR image") as told:
            maps.read(path)
        assert str(path) in str(told.value)
    with pytest.raises(DesirePathError, match="damaged"):
        maps.read(tmp_path)


def test_the_door_refuses_what_it_cannot_take(tmp_path):
    path, grid = str(tmp_path / "door.exr"), np.zeros((2, 2), np.float32)
    for arguments in [
        (path, ["a"], [grid.astype(np.float64)], []),
        (path, ["a"], [grid[:, ::2]], []),
        (path, ["a"], [grid.ravel()], []),
        (path, ["a", "b"], [grid], []),
        (path, [1], [grid], []),
        (path, ["a"], [grid], [("n",)]),
        (path, ["a"], [grid], [("n", None)]),
        (path, ["a"], [grid], 5),
        (path, 5, [grid], []),
        (None, ["a"], [grid], []),
        (path,),
    ]:
        with pytest.raises((TypeError, ValueError)):
            _native.maps_write(*arguments)
    with pytest.raises(TypeError):
        _native.maps_read(5.0)
    assert not list(tmp_path.iterdir())


def test_the_table_names_every_map_once():
    names = [entry.name for entry in maps.MAPS]
    assert names[:4] == ["compression", "heap", "pressure_time", "plant_strength"] and len(set(names)) == len(names)
    assert all(entry.equation.startswith("TRAIL (") for entry in maps.MAPS[:4])
    assert all(entry.unit and entry.meaning for entry in maps.MAPS + maps.GROUND + maps.LEAN)
    fields = {name: of for name, *of in _native.fields()}
    assert len(fields) == len(_native.fields()) == len({number for number, *_ in fields.values()})
    for entry in maps.MAPS + maps.GROUND + maps.LEAN:
        assert entry[1:] == tuple(fields[entry.name][1:])


@pytest.mark.parametrize("page, row", [("README.md", "| `maps_final.exr` |"), ("native/model.md", "| every second,")])
def test_pages_name_every_map_with_its_unit(page, row):
    text = (Path(__file__).resolve().parents[2] / page).read_text("utf-8")
    line = next(line for line in text.splitlines() if line.startswith(row)).split("|", 2)[2]
    told = line.split("`")[1:]
    units = {name.removesuffix(maps.LAYER): behind for name, behind in zip(told[::2], told[1::2])}
    known = {entry.name: entry.unit for entry in maps.MAPS + maps.GROUND + maps.LEAN}
    assert set(units) == set(known)
    for name, unit in known.items():
        assert (f"[{unit}]" in units[name]) == (unit != "-"), name
