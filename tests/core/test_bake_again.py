"""A bake that was stopped, killed or damaged goes on, and an earlier one plays meanwhile."""

import json
import os
import shutil
import struct

import pytest

from desire_path.bake import bake as bakes
from desire_path.bake.bake import Bake, read_index
from desire_path.bake.options import BakeOptions, BakeOutput
from desire_path.errors import DesirePathError
from desire_path.files import atomic_file
from desire_path.ground import maps, sim
from desire_path.ground.sim import Ground
from tests.core.test_bake import baked, content, sentence, standing


def test_a_killed_bake_plays_what_is_whole(tmp_path):
    """Killed: no clean-up at all ran, and a temporary file lies about."""
    bake = Bake(standing(), Ground.flat(), "mud", tmp_path, options=BakeOptions(threads=1))
    run = bake.run()
    for _ in range(7):
        next(run)
    killed = tmp_path.parent / "killed"
    shutil.copytree(tmp_path, killed, ignore=shutil.ignore_patterns("*.part"))  # one may be being written
    (killed / "bake.new" / "frames" / "trail_0008.exr.part").write_bytes(b"half")
    run.close()
    index = read_index(killed)
    assert 2 <= index.frames <= 7 and not index.complete  # the last ones may have been on their way
    assert maps.read(index.path(index.frames)).planes["R"].min() < 0
    baked(killed)
    assert read_index(killed).complete


def test_damaged_frames_count_as_missing_and_are_written_again(tmp_path):
    """A copy that stopped, a disk that failed: what is left of a frame is no frame."""
    whole = tmp_path / "whole"
    baked(whole)
    good = content(whole)
    frame = whole / "frames" / "trail_0005.exr"
    data = frame.read_bytes()
    for wrong in (b"", data[:8], data[: len(data) // 2], data[:-1], bytes(len(data)), b"text" + data[4:], data + b"x"):
        frame.write_bytes(wrong)
        index = read_index(whole)
        assert index.frames == 4 and not index.complete
    baked(whole)
    assert content(whole) == good and read_index(whole).complete
    # the same in a bake that goes on
    stopped = tmp_path / "stopped"
    run = Bake(standing(), Ground.flat(), "mud", stopped, options=BakeOptions(threads=1)).run()
    for _ in range(10):
        next(run)
    run.close()
    (stopped / "frames" / "trail_0003.exr").write_bytes(data[:100])
    assert read_index(stopped).frames == 2
    baked(stopped)
    assert content(stopped) == good


def test_a_frame_with_a_tile_that_was_never_written_is_none(tmp_path):
    """Its last tile ends where the file does, but the place of another is 0, as where a disk kept no more of it."""
    baked(tmp_path, standing(0.3))
    frame = tmp_path / "frames" / "trail_0005.exr"
    data = frame.read_bytes()
    head = data.index(b"\0", data.index(b"tiles\0tiledesc\0")) - 5
    for at in range(head, len(data)):  # the table begins behind the header's last zero, with the first tile behind it
        (first,) = struct.unpack_from("<Q", data, at)
        if at < first < at + 8 * 4096 and (first - at) % 8 == 0 and data[at - 1] == 0:
            break
    frame.write_bytes(data[:at] + bytes(8) + data[at + 8 :])
    assert (first - at) // 8 > 1, "one tile alone is its last, too"
    assert read_index(tmp_path).frames == 4


def test_an_index_with_numbers_that_cannot_be_is_damaged(tmp_path):
    baked(tmp_path, standing(0.1))
    path = tmp_path / "frames" / "index.json"
    good = json.loads(path.read_text())
    for name in ("cell", "frame_rate"):
        for value in (0.0, -1.0, float("nan"), "1", True, None):
            path.write_text(json.dumps({**good, name: value}))
            with pytest.raises(DesirePathError, match="damaged: bake again"):
                read_index(tmp_path)


def test_an_index_of_nonsense_is_baked_over(tmp_path):
    for text in ("[]", "null", "3", "{", "[" * 100_000):
        os.makedirs(tmp_path / "bake.new" / "frames")
        (tmp_path / "bake.new" / "frames" / "index.json").write_text(text)
        baked(tmp_path)
        assert read_index(tmp_path).complete


@pytest.mark.parametrize("name", ["frames", "bake.new", "maps", "bake.old"])
def test_a_file_where_a_folder_belongs_is_a_sentence(tmp_path, name):
    (tmp_path / name).write_text("somebody's")
    with pytest.raises(DesirePathError) as error:
        baked(tmp_path)
    sentence(error)
    assert str(tmp_path / name) in str(error.value)
    assert (tmp_path / name).read_text() == "somebody's"


def read_index_of(folder):
    baked(folder)
    return read_index(folder)


def test_an_earlier_bake_plays_until_the_new_one_is_whole(tmp_path):
    baked(tmp_path)
    before = content(tmp_path)
    second = (tmp_path / "maps" / "second_0001.exr").read_bytes()
    bake = Bake(standing(), Ground.flat(), "snow", tmp_path, options=BakeOptions(threads=1))
    run = bake.run()
    for _ in range(5):
        next(run)
    run.close()
    assert content(tmp_path) == before and read_index(tmp_path).complete
    assert (tmp_path / "maps" / "second_0001.exr").read_bytes() == second
    for _ in Bake(standing(), Ground.flat(), "snow", tmp_path, options=BakeOptions(threads=1)).run():
        pass
    assert content(tmp_path) != before and read_index(tmp_path).complete
    assert (tmp_path / "maps" / "second_0001.exr").read_bytes() != second
    assert {path.name for path in tmp_path.iterdir() if path.is_dir()} == {"frames", "maps"}


def test_a_bake_belongs_to_its_ground(tmp_path):
    baked(tmp_path, owner="the meadow")
    assert (
        read_index(tmp_path).owner
        == json.loads((tmp_path / "frames/index.json").read_text())["bake_folder_owner"]
        == "the meadow"
    )
    before = content(tmp_path)
    with pytest.raises(DesirePathError, match="another ground.*the meadow.*choose another folder"):
        baked(tmp_path, owner="the lane", cell_size=0.02)
    with pytest.raises(DesirePathError, match="another ground"):
        bakes.free(tmp_path, "the lane")
    assert content(tmp_path) == before and not (tmp_path / "bake.new").exists()
    baked(tmp_path, owner="the meadow", cell_size=0.02)
    assert content(tmp_path) != before
    bakes.free(tmp_path, "the meadow")
    assert not tmp_path.exists()


@pytest.mark.parametrize("owner", ["the lane", ""])
def test_a_stopped_bake_of_another_ground_is_not_gone_on_with(tmp_path, owner):
    run = Bake(
        standing(),
        Ground.flat(),
        "mud",
        tmp_path,
        options=BakeOptions(threads=1),
        output=BakeOutput(owner="the meadow"),
    ).run()
    for _ in range(5):
        next(run)
    run.close()
    again = Bake(
        standing(), Ground.flat(), "mud", tmp_path, options=BakeOptions(threads=1), output=BakeOutput(owner=owner)
    )
    if owner:
        with pytest.raises(DesirePathError, match="another ground"):
            next(again.run())
        assert read_index(tmp_path).frames == 5
    else:
        next(run := again.run())
        run.close()
        assert read_index(tmp_path).frames == 1 and read_index(tmp_path).owner == ""


def test_free_deletes_what_was_baked_and_nothing_else(tmp_path):
    baked(tmp_path)
    mine = tmp_path / "notes.txt"
    mine.write_text("keep")
    bakes.free(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]
    with pytest.raises(DesirePathError, match="no bake"):
        read_index(tmp_path)


def test_frames_beyond_the_recording_are_refused(tmp_path):
    last = read_index_of(tmp_path / "whole").frame_end
    for first, end in ((last + 1, last + 20), (-20, 0)):
        with pytest.raises(DesirePathError, match=f"frames 1 to {last}"):
            Bake(
                standing(), Ground.flat(), "mud", tmp_path / "none", output=BakeOutput(frame_start=first, frame_end=end)
            )
    _, frames = baked(tmp_path / "more", frame_start=-5, frame_end=last + 5)
    assert frames == list(range(-5, last + 6))


@pytest.mark.parametrize("fails", ["maps_final.exr", "trail_sums.txt", "report.json", "index.json"])
def test_a_disk_that_is_full_after_the_last_frame_shows_nothing_half(tmp_path, monkeypatch, fails):
    """All frames are there, and what belongs to them cannot be written: what was shown before is, and the next bake
    goes on from there."""
    whole, folder = tmp_path / "whole", tmp_path / "bake"
    baked(whole)
    good = content(whole)
    opened, write_maps = atomic_file.file, sim.Film.write_maps

    def full(path):
        if os.path.basename(path) == fails and len(os.listdir(os.path.join(folder, "bake.new", "frames"))) > 50:
            raise OSError(28, "No space left on device", str(path))

    def no_file(path, *more, **options):
        full(path)
        return opened(path, *more, **options)

    def no_maps(self, path, *more):
        full(path)
        return write_maps(self, path, *more)

    for before in (False, True):
        if before:
            baked(folder, threads=2, cell_size=0.02)  # another bake is shown
            shown = content(folder)
        with monkeypatch.context() as patch:
            patch.setattr(atomic_file, "file", no_file)
            patch.setattr(sim.Film, "write_maps", no_maps)
            with pytest.raises(DesirePathError, match="No space left on device") as problem:
                baked(folder)
        assert "make room" in sentence(problem)
        if before:
            assert content(folder) == shown and read_index(folder).complete
        else:
            assert os.listdir(folder) == ["bake.new"]
            index = read_index(folder)
            assert not index.complete and not index.missing
        baked(folder)
        assert content(folder) == good and read_index(folder).complete
        shutil.rmtree(folder)
