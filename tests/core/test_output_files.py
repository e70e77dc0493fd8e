"""Single files: what is no plain file of ours is never replaced, and Windows is waited for."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from desire_path.bake.bake import Bake, free, read_index
from desire_path.bake.options import BakeOptions
from desire_path.bake.output import NAMES
from desire_path.errors import DesirePathError
from desire_path.files import atomic_file, disk
from desire_path.ground import maps
from desire_path.ground.sim import Ground
from tests.core.test_bake import baked, sentence, standing
from tests.core.test_output import REPO, grown


def _lies(path):
    """What lies there: all that `lstat` says but when it was last read, which looking changes."""
    stat = os.lstat(path)
    return stat.st_mode, stat.st_ino, stat.st_size, stat.st_mtime_ns, stat.st_ctime_ns


@pytest.mark.parametrize("name", [*NAMES, "bake.new", "bake.lock", "bake.shown"])
@pytest.mark.parametrize("kind", ["link", "pipe"])
def test_what_is_no_plain_file_of_ours_is_never_replaced(tmp_path, name, kind):
    """A link into somebody's folder, a pipe: refused before anything is written, through it or over it."""
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    (theirs / "trail_0001.exr").write_text("precious")
    folder = tmp_path / "bake"
    folder.mkdir()
    if kind == "link":
        folded = name in ("frames", "maps", "bake.new")
        (folder / name).symlink_to(theirs if folded else theirs / "trail_0001.exr")
    else:
        os.mkfifo(folder / name)
    before = _lies(folder / name)
    with pytest.raises(DesirePathError, match="stands where the bake keeps") as error:
        baked(folder)
    assert str(folder / name) in sentence(error)
    with pytest.raises(DesirePathError, match="stands where the bake keeps"):
        free(folder)
    assert _lies(folder / name) == before and (theirs / "trail_0001.exr").read_text() == "precious"
    assert [path.name for path in folder.iterdir()] == [name]


@pytest.mark.parametrize(("winerror", "busy", "tries"), [(32, 3, 4), (5, 3, 4), (32, 99, 50), (None, 99, 1)])
def test_a_place_that_is_open_in_windows_is_waited_for(tmp_path, monkeypatch, winerror, busy, tries):
    (tmp_path / "new").write_text("new")
    (tmp_path / "old").write_text("old")
    asked, replace = [], os.replace

    def held(one, other):
        asked.append(other)
        if len(asked) <= busy:
            problem = PermissionError(13, "Permission denied", one)
            problem.winerror = winerror
            raise problem
        replace(one, other)

    monkeypatch.setattr(os, "replace", held)
    monkeypatch.setattr(disk, "_PATIENCE", 0.0)
    if busy < 50:
        disk.replace(tmp_path / "new", tmp_path / "old")
    else:
        with pytest.raises(PermissionError):
            disk.replace(tmp_path / "new", tmp_path / "old")
    assert len(asked) == tries
    assert (tmp_path / "old").read_text() == ("new" if busy < 50 else "old")


# ---- single files ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["link", "pipe", "folder", "dangling link"])
def test_a_table_never_replaces_what_is_no_file(tmp_path, kind):
    path, target = tmp_path / "out.csv", tmp_path / "target"
    if kind == "link":
        target.write_text("precious")
    if "link" in kind:
        path.symlink_to(target)
    elif kind == "pipe":
        os.mkfifo(path)
    else:
        path.mkdir()
    before = os.lstat(path)
    match = f"which is a {kind.split()[-1]}"
    with pytest.raises(DesirePathError, match=match) as error, atomic_file.file(path, "The table", "w") as stream:
        stream.write("new")
    sentence(error)
    assert os.lstat(path).st_mode == before.st_mode and os.lstat(path).st_ino == before.st_ino
    assert target.exists() == (kind == "link") and (kind != "link" or target.read_text() == "precious")
    assert not list(tmp_path.glob("*.part"))


@pytest.mark.parametrize("words", [("loads",), ("loads", "--contacts"), ("plot",), ("lane",), ("bake",)])
def test_no_command_replaces_a_pipe(tmp_path, words):
    """Nor would it a device, which the tests leave alone."""
    walk = str(Path(atomic_file.__file__).parents[1] / "walks" / "walk.npz")
    pipe = tmp_path / ("out.png" if words == ("plot",) else "out")
    os.mkfifo(pipe)
    more = {
        "loads": [walk],
        "plot": [walk],
        "bake": [walk, "--cell", "0.05"],
        "lane": ["--passes", "1", "--length", "2", "--cell", "0.05"],
    }[words[0]]
    out = ["--out", str(tmp_path / "table"), "--contacts", str(pipe)] if words[1:] else ["--out", str(pipe)]
    done = subprocess.run(
        [sys.executable, "-m", "desire_path", words[0], *more, *out],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(REPO / "addon")},
    )
    assert done.returncode == 1 and len(done.stderr.strip().splitlines()) == 1, done
    assert str(pipe) in done.stderr and "Traceback" not in done.stderr
    assert pipe.is_fifo() and {path.name for path in tmp_path.iterdir()} <= {pipe.name, "table"}


def test_names_may_be_long_and_folders_missing(tmp_path):
    long = tmp_path / ("\u8db3" * 80 + ".csv")  # 244 bytes
    with atomic_file.file(long, "The table", "w") as stream:
        stream.write("1")
    assert long.read_text() == "1"
    for wrong in (tmp_path / "none" / "x.csv", f"{tmp_path}/a\0b.csv"):
        refused = pytest.raises(DesirePathError, match="cannot be written")
        with refused as error, atomic_file.file(wrong, "The table", "w"):
            pass
        sentence(error)
    with pytest.raises(DesirePathError, match="cannot be made"):
        baked(f"{tmp_path}/a\0b")


def test_a_link_in_place_of_a_frame_is_no_frame_to_go_on_from(tmp_path):
    run = Bake(standing(), Ground.flat(), "mud", tmp_path / "bake", options=BakeOptions(threads=1)).run()
    for _ in range(10):
        next(run)
    run.close()
    frame, moved = tmp_path / "bake" / "frames" / "trail_0004.exr", tmp_path / "theirs.exr"
    frame.rename(moved)
    frame.symlink_to(moved)
    before = moved.read_bytes()
    baked(tmp_path / "bake")
    assert not frame.is_symlink() and frame.read_bytes() == before == moved.read_bytes()


def test_maps_never_replace_what_is_no_file(tmp_path):
    (tmp_path / "map.exr").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(DesirePathError, match="which is a link"):
        maps.write(tmp_path / "map.exr", {"height": np.zeros((2, 2))})
    assert not (tmp_path / "elsewhere").exists()


@pytest.mark.parametrize(
    "make, word",
    [
        (os.mkfifo, "pipe"),
        (lambda path: os.symlink("nowhere", path), "link"),
        (lambda path: open(path, "w").close(), "file"),
    ],
)
def test_what_stands_where_the_folder_is_to_be_is_named(tmp_path, make, word):
    place = str(tmp_path / "bake")
    make(place)
    with pytest.raises(DesirePathError, match=f"is a {word}"):
        for _ in Bake(standing(), Ground.flat(), "mud", place, cell_size=0.02).run():
            pass
    assert os.path.lexists(place) and os.listdir(tmp_path) == ["bake"]


@pytest.mark.parametrize(
    "name", ["frames/trail_0001.exr", "maps/second_0001.exr", "maps_final.exr", "report.json", "frames/lean_0000.exr"]
)
def test_files_of_others_named_as_ours_are_not_replaced(tmp_path, name):
    """Nor freed. What is left of a bake, without its index or without all of its frames, is the bake's."""
    path = tmp_path / "others" / name
    path.parent.mkdir(parents=True)
    path.write_bytes(b"a picture of the cat")
    with pytest.raises(DesirePathError, match="is named as a file of a bake, of which there is nothing else: move it"):
        next(grown(tmp_path / "others", "mud").run())
    with pytest.raises(DesirePathError, match="move it, or choose another folder"):
        free(tmp_path / "others")
    assert path.read_bytes() == b"a picture of the cat"
    assert [each for each in (tmp_path / "others").rglob("*") if each.is_file()] == [path]
    for gone in ("frames/index.json", "frames"):
        list(grown(tmp_path / "ours", "mud").run())
        left = tmp_path / "ours" / gone
        left.unlink() if left.is_file() else shutil.rmtree(left)
        list(grown(tmp_path / "ours", "snow").run())
        assert read_index(tmp_path / "ours").complete
