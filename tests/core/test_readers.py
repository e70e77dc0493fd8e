"""Files of people: whatever they hold, a reader comes back with what they say or with one sentence, and soon."""

import io
import json
import os
import struct
import subprocess
import sys
import tracemalloc
import zipfile
from pathlib import Path

import numpy as np
import pytest

from desire_path.bake.bake import Bake, read_index
from desire_path.bake.options import BakeOptions
from desire_path.errors import DesirePathError
from desire_path.files import npz
from desire_path.ground.plants import Kind
from desire_path.ground.sim import Ground
from desire_path.motion.gait import Gait
from desire_path.placement import path
from desire_path.study import trampling
from tests.core.test_bake import baked, content, sentence, standing

REPO = Path(__file__).resolve().parents[2]


def told(call, *args):
    """The sentence a reader refuses with; it can be written anywhere."""
    with pytest.raises(DesirePathError) as error:
        call(*args)
    text = sentence(error)
    assert len(text.encode("utf-8")) < 700
    return text


# ---- recordings -------------------------------------------------------------------------------------------------


def head(shape, descr="'<f8'", order="False"):
    text = f"{{'descr': {descr}, 'fortran_order': {order}, 'shape': {shape}, }}\n".encode()
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text


def packed(file, members, compression=zipfile.ZIP_STORED):
    with zipfile.ZipFile(file, "w", compression) as box:
        for name, data in members.items():
            box.writestr(f"{name}.npy", data)
    return file


def members_of(file):
    with zipfile.ZipFile(file) as box:
        return {name.removesuffix(".npy"): box.read(name) for name in box.namelist()}


def wrong_recordings(tmp_path):
    """(what is wrong, file) of files that are no recordings, made from one that is."""
    good = tmp_path / "good.npz"
    standing().save(good)
    held = members_of(good)
    make = lambda name, **more: (name, packed(tmp_path / f"{name}.npz", {**held, **more}))
    yield make("billion", time=head("(1000000000,)"))
    yield make("overflow", time=head("(4294967296, 4294967296, 4294967296)"))
    yield make("negative", time=head("(-5,)"))
    yield make("nested", time=b"\x93NUMPY\x01\x00" + struct.pack("<H", 4000) + b"(" * 4000)
    yield make("long head", time=b"\x93NUMPY\x02\x00" + struct.pack("<I", 1 << 30))
    yield make("pickled", time=head("(1,)", "'|O'") + bytes(8))
    yield make("record", time=head("(1,)", "[('a', '<f8')]") + bytes(8))
    yield make("complex", time=head("(1,)", "'<c16'") + bytes(16))
    yield make("call", time=head("__import__('os').getcwd()"))
    yield make("short", time=held["time"][:-8])
    yield make("more", time=held["time"] + bytes(8))
    yield make("text", time=b"time")
    yield make("infinite", frame_start=head("()", "'<f8'") + struct.pack("<d", float("inf")))
    yield make("year", frame_start=head("()", "'<i8'") + struct.pack("<q", 1 << 62))
    yield make("counts", sole_vertex_count=head("(1,)", "'<i4'") + struct.pack("<i", -7))
    for number in range(3):
        yield "cut", tmp_path / f"cut{number}.npz"
        (tmp_path / f"cut{number}.npz").write_bytes(good.read_bytes()[: 1000 * number])
    bare = io.BytesIO()
    np.save(bare, np.zeros(8))
    (tmp_path / "bare.npz").write_bytes(bare.getvalue())
    yield "bare", tmp_path / "bare.npz"
    many = packed(tmp_path / "many.npz", {f"a{n}": head("(0,)") for n in range(200)})
    yield "many", many
    locked = bytearray(good.read_bytes())
    for mark, place in ((b"PK\x01\x02", 8), (b"PK\x03\x04", 6)):  # the bit that says a member is encrypted
        locked[locked.index(mark) + place] |= 1
    (tmp_path / "locked.npz").write_bytes(locked)
    yield "encrypted", tmp_path / "locked.npz"
    method = bytearray(good.read_bytes())
    for mark, place in ((b"PK\x01\x02", 10), (b"PK\x03\x04", 8)):  # a packing that does not exist
        method[method.index(mark) + place] = 77
    (tmp_path / "method.npz").write_bytes(method)
    yield "method", tmp_path / "method.npz"
    yield "folder", tmp_path
    os.mkfifo(tmp_path / "pipe.npz")
    yield "pipe", tmp_path / "pipe.npz"


def test_recordings_of_nonsense_are_a_sentence(tmp_path):
    seen = {}
    for name, file in wrong_recordings(tmp_path):
        seen[name] = told(Gait.load, file)
    assert "encrypted" in seen["encrypted"] and "no .npz" in seen["bare"], seen
    assert Gait.load(tmp_path / "good.npz").time.shape == standing().time.shape


BOMB = """
import sys, tracemalloc
sys.path[:0] = [{addon!r}]
from desire_path import Gait
tracemalloc.start()
try:
    Gait.load({file!r})
except ValueError as problem:
    print(tracemalloc.get_traced_memory()[1], problem)
"""


def test_a_recording_that_would_fill_the_memory_is_refused_before_it_is_unpacked(tmp_path):
    """64 MB of zeros in 64 kB, in a file that says they are 3 GB, 1.5 GB, or less than there is."""
    grown = {}
    for count in (400_000_000, 200_000_000, 40):
        file = packed(tmp_path / f"{count}.npz", {"time": head(f"({count},)") + bytes(1 << 26)}, zipfile.ZIP_DEFLATED)
        data = bytearray(file.read_bytes())
        at = data.index(b"PK\x01\x02")
        data[at + 24 : at + 28] = data[22:26] = struct.pack("<I", len(head(f"({count},)")) + 8 * count)
        file.write_bytes(data)
        done = subprocess.run(
            [sys.executable, "-c", BOMB.format(addon=str(REPO / "addon"), file=str(file))],
            capture_output=True,
            text=True,
        )
        grown[count], _, text = done.stdout.partition(" ")
        assert "damaged or no recording" in text, done
    assert all(int(most) < 1 << 23 for most in grown.values()), grown  # bytes; far less than what is packed


def test_arrays_come_as_numpy_writes_them(tmp_path):
    wanted = {
        "a": np.arange(24.0).reshape(2, 3, 4),
        "b": np.asfortranarray(np.arange(12, dtype=">i4").reshape(3, 4)),
        "c": np.array(["one", "", "drei"]),
        "d": np.array(True),
        "e": np.zeros((0, 3), "f4"),
        "f": np.array([""]),
        "g": np.arange(3, dtype="u1"),
    }
    for save in (np.savez, np.savez_compressed):
        save(tmp_path / "x.npz", **wanted)
        found = npz.read(tmp_path / "x.npz")
        assert set(found) == set(wanted)
        for name, array in wanted.items():
            assert found[name].dtype == array.dtype and found[name].shape == array.shape
            assert np.array_equal(found[name], array)
    with pytest.raises(npz.Damaged, match="larger"):
        npz.read(tmp_path / "x.npz", 100)
    np.savez_compressed(tmp_path / "x.npz", zeros=np.zeros(100_000))
    with pytest.raises(npz.Damaged, match="take more than"):
        npz.read(tmp_path / "x.npz", 100_000)


# ---- kinds of plants, tables -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "null",
        "[" * 60_000,
        '{"desire_path_plant": 1, "height": %s}' % ("1" * 4500),
        '{"desire_path_plant": 1, "height": %s}' % ("1" * 4000),
        '{"desire_path_plant": 1, "height": 1e999}',
        '{"desire_path_plant": 1, "height": NaN}',
        '{"desire_path_plant": 1, "height": [[1]]}',
        '{"desire_path_plant": 1, "height": {"a": 1}}',
        '{"desire_path_plant": 1, "height": true}',
        '{"desire_path_plant": true}',
        '{"desire_path_plant": 1.0}',
        '{"desire_path_plant": 1, "sheets": 2.0}',
        '{"desire_path_plant": 1, "sheets": true}',
        '{"desire_path_plant": 1, "form": ["tuft"]}',
        '{"desire_path_plant": 1, "form": "%s"}' % ("x" * 5000),
        '{"desire_path_plant": 1, "%s": 1}' % ("x" * 5000),
        '{"desire_path_plant": 1, "\\udcff": 1}',
        '{"desire_path_plant": 1, "spacing": 1e-300}',
        "\x00",
        "\xff\xfe",
        '{"desire_path_plant": 1}' + " " * 100_000,
    ],
)
def test_kinds_of_nonsense_are_a_sentence(tmp_path, text):
    file = tmp_path / "kind.json"
    file.write_bytes(text.encode("latin-1"))
    told(Kind.load, file)


@pytest.mark.parametrize("read", [path.read, trampling.read])
def test_tables_of_nonsense_are_a_sentence(tmp_path, read):
    first = "x,y\n" if read is path.read else "passes,cover\n"
    file = tmp_path / "table.csv"
    for text in (
        "",
        "\x00",
        "\xff\xfe",
        first,
        first + "1\n",
        first + "inf,1\n-inf,2\n",
        first + "nan,1\n2,2\n",
        first + "1e400,1\n2,2\n",
        first + "1e300,1\n2,2\n",
        first + "a,b\n",
        first + '"' + "1" * 200_000,
        first * 2,
        "x" * 200_000,
        first + "9" * 5000 + ",1\n",
    ):
        file.write_bytes(text.encode("latin-1"))
        if text == first and read is trampling.read:
            assert read(file) == []
        else:
            told(read, file)
    with open(file, "wb") as stream:  # 40 MB of rows, none of them read
        stream.write(first.encode())
        stream.truncate(40 << 20)
    assert "larger than" in told(read, file)
    file.unlink()
    told(read, file)
    told(read, tmp_path)
    os.mkfifo(file)
    told(read, file)


# ---- the index and the frames -------------------------------------------------------------------------------------


def test_whatever_an_index_says_is_a_sentence_or_an_index(tmp_path):
    baked(tmp_path, cell_size=0.02)
    file = tmp_path / "frames" / "index.json"
    good = json.loads(file.read_text())
    for name in ("cell", "x0", "y0", "nx", "ny", "frame_start", "frame_end", "frame_rate"):
        for value in ("1e999", "NaN", '"7"', "true", "null", "[1]", "{}", "9" * 400, "-" + "9" * 400):
            file.write_text(json.dumps({**good, name: "HERE"}).replace('"HERE"', value))
            assert "damaged: bake again" in told(read_index, tmp_path), (name, value)
    for name, value in (
        ("cell", 0),
        ("cell", -1),
        ("nx", 0),
        ("ny", -4),
        ("nx", 2.5),
        ("ny", 1e30),
        ("frame_rate", 0),
        ("frame_end", good["frame_start"] - 1),
    ):
        file.write_text(json.dumps({**good, name: value}))
        assert "damaged" in told(read_index, tmp_path), name
    file.write_text(json.dumps({**good, "format": ["x" * 5000], "version": "y" * 5000}))
    told(read_index, tmp_path)
    file.write_text(json.dumps({**good, "frame_end": 10**9}))  # counted as far as files are there
    assert read_index(tmp_path).frames == good["frame_end"] - good["frame_start"] + 1
    file.write_text(json.dumps(good) + " " * (1 << 23))
    told(read_index, tmp_path)
    file.unlink()
    os.mkfifo(file)
    told(read_index, tmp_path)


def test_frames_with_damaged_heads_end(tmp_path):
    """Every byte of a frame's head, one at a time, becomes something else; and sizes lead backwards."""
    baked(tmp_path, cell_size=0.02)
    frame = Path(read_index(tmp_path).path(3))
    good, last = frame.read_bytes(), read_index(tmp_path).frames
    end = good.index(b"tiles\0") + 40
    for at in range(8, end):
        for value in (0, 0xFF, good[at] ^ 0x80):
            frame.write_bytes(good[:at] + bytes([value]) + good[at + 1 :])
            assert read_index(tmp_path).frames in (2, last)
    value = good.index(b"\0", good.index(b"\0", 8) + 1) + 5
    frame.write_bytes(good[: value - 4] + struct.pack("<i", 8 - value) + good[value:])
    assert read_index(tmp_path).frames == 2
    tiles = good.index(b"tiledesc\0") + 13
    window = good.index(b"box2i\0", good.index(b"dataWindow\0")) + 10
    many = good[:tiles] + struct.pack("<2I", 1, 1) + good[tiles + 8 :]
    frame.write_bytes(many[:window] + struct.pack("<4i", 0, 0, 29_999, 29_999) + many[window + 16 :])
    tracemalloc.start()
    assert read_index(tmp_path).frames == 2  # 900 million tiles, more than the file has bytes
    assert tracemalloc.get_traced_memory()[1] < 10_000_000
    tracemalloc.stop()
    frame.unlink()
    os.mkfifo(frame)
    assert read_index(tmp_path).frames == 2


def test_checksums_of_nonsense_are_none(tmp_path):
    good = tmp_path / "good"
    baked(good)
    for number, text in enumerate((b"", b"\xff\xfe\x00", b"trail_0000.exr\n" * 3, b"x" * 100_000)):
        folder = tmp_path / str(number)
        run = Bake(standing(), Ground.flat(), "mud", folder, options=BakeOptions(threads=1)).run()
        for _ in range(5):
            next(run)
        run.close()
        (folder / "frames" / "trail_sums.txt").write_bytes(text)
        baked(folder)
        assert content(folder) == content(good)


def test_sentences_can_be_printed_whatever_is_in_a_name(tmp_path):
    name = os.fsdecode(b"walk\xff.npz")
    assert "\\udcff" in told(Gait.load, str(tmp_path / name))
