"""One output folder: who may write there, and that a bake takes another one's place as a whole or not at all."""

import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from desire_path.bake import output
from desire_path.bake.bake import Bake, free, read_index
from desire_path.bake.options import BakeOptions, BakeOutput
from desire_path.bake.output import NAMES, Output
from desire_path.errors import DesirePathError
from desire_path.files import disk
from desire_path.ground.parcels import Parcel
from desire_path.ground.plants import Planting
from desire_path.ground.sim import Ground
from tests.core.test_bake import baked, content, sentence, standing

REPO = Path(__file__).resolve().parents[2]
FILES = {
    "frames/trail_0000.exr",
    "frames/index.json",
    "maps/second_0001.exr",
    "maps_start.exr",
    "maps_final.exr",
    "report.json",
}
OLD, NEW = FILES | {"plants.pc2"}, FILES | {"plants.npz", "frames/trail_0001.exr"}


def laid(folder):
    """A folder that shows one bake, with a file of somebody's, and has another ready."""
    for top, names, text in ((folder, OLD, "old"), (folder / "bake.new", NEW, "new")):
        for name in names:
            (top / name).parent.mkdir(parents=True, exist_ok=True)
            (top / name).write_text(text)
    (folder / "frames" / "notes.txt").write_text("mine")
    return folder


def shown(folder):
    """What every name of a bake leads to."""
    return {name: (folder / name).read_text() for name in OLD | NEW if (folder / name).exists()}


DYING = """
import os, signal, sys
sys.path[:0] = [{addon!r}]
from desire_path import disk, output
left = {steps}
def no_links(*_, **__):
    raise PermissionError(1, "Operation not permitted")
def dying(call):
    def counted(*args, **more):
        global left
        left -= 1
        if left < 0:
            os.kill(os.getpid(), signal.SIGKILL)
        return call(*args, **more)
    return counted
if {can!r} != "exchange":
    disk.swap = lambda one, other: False
if {can!r} == "neither":
    os.symlink = no_links
for name in ("rename", "replace", "symlink", "unlink", "rmdir", "mkdir"):
    setattr(os, name, dying(getattr(os, name)))
disk.swap = dying(disk.swap)
out = output.Output({folder!r})
out.open()
out.ready()
out.publish()
out.release()
"""


def killed_after(steps, folder, can):
    """Publish in a process that dies at its step number `steps`, on a disk that can so much; True: it came to that."""
    script = DYING.format(addon=str(REPO / "addon"), steps=steps, can=can, folder=str(folder))
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode in (0, -signal.SIGKILL), done.stderr
    return done.returncode != 0


def no_links(*_args, **_more):
    raise PermissionError(1, "Operation not permitted")


@pytest.mark.parametrize("can", ["exchange", "link", "neither"])
def test_killed_at_any_step_a_folder_shows_one_bake(tmp_path, monkeypatch, can):
    old, new = dict.fromkeys(OLD, "old"), dict.fromkeys(NEW, "new")
    if can != "exchange":
        monkeypatch.setattr(disk, "swap", lambda one, other: False)
    if can == "neither":
        monkeypatch.setattr(os, "symlink", no_links)
    seen = set()
    for steps in range(1000):
        folder = laid(tmp_path / str(steps))
        died = killed_after(steps, folder, can)
        found = shown(folder)
        if can == "exchange":
            assert found in (old, new), (steps, found)
        elif can == "link":  # a name may be missing for a moment
            assert found.items() <= old.items() or found.items() <= new.items(), (steps, found)
        begun = os.path.lexists(folder / "bake.shown")
        output.settle(folder)
        seen.add(found == new)
        assert shown(folder) == (new if begun or found == new else old), steps
        out = Output(folder)
        out.open()
        if (folder / "bake.new").exists():
            out.ready()
            out.publish()
        out.release()
        assert shown(folder) == new and (folder / "frames" / "notes.txt").read_text() == "mine"
        assert {path.name for path in folder.iterdir()} == {name.split("/")[0] for name in NEW}
        assert not any(path.is_symlink() for path in folder.rglob("*"))
        if not died:
            break
    assert not died and seen == {True, False}


def test_who_is_half_way_along_a_link_comes_by_the_new_bake(tmp_path, monkeypatch):
    folder = laid(tmp_path / "bake")
    found = []

    def looked(call):
        def done(*args):
            link = folder / output.SHOWN
            turned = link.is_symlink() and os.readlink(link) == output.NEW
            result = call(*args)
            if turned:  # a reader that has read the link before looks on from there
                found.append({name: (folder / output.NEW / name).read_text() for name in NEW})
            return result

        return done

    monkeypatch.setattr(disk, "swap", looked(disk.swap))
    monkeypatch.setattr(disk, "sync_one", looked(disk.sync_one))
    out = Output(str(folder))
    out.open()
    out.ready()
    out.publish()
    out.release()
    assert len(found) > 5 and all(set(each.values()) == {"new"} for each in found)
    assert shown(folder) == dict.fromkeys(NEW, "new")
    assert sorted(each.name for each in folder.iterdir()) == sorted({name.split("/")[0] for name in NEW})


def test_folders_of_one_bake_are_shown_together(tmp_path):
    """Once all are ready, whoever comes next shows them; before, what is ready is taken back."""
    for name, whole_bake in (("ready", True), ("taken back", False)):
        outs = [Output(laid(tmp_path / name / tile)) for tile in ("east", "west")]
        for out in outs:
            out.open()
            out.ready()
        for out in outs:
            if not whole_bake:
                out.withdraw()
            assert shown(Path(out.folder)) == dict.fromkeys(OLD, "old")
            out.release()  # and no more: killed here
        for out in outs:
            output.settle(out.folder)
            assert shown(Path(out.folder)) == (dict.fromkeys(NEW, "new") if whole_bake else dict.fromkeys(OLD, "old"))


def test_a_ground_that_cannot_be_ready_holds_back_the_others(tmp_path, monkeypatch):
    """Two grounds of a bake, and no room for the second one's last step: both show what they did."""
    parcels = lambda soil: [
        Parcel(
            Ground.mesh([[x, -1, 0], [x + 1, -1, 0], [x + 1, 1, 0], [x, 1, 0]], [[0, 1, 2], [0, 2, 3]]),
            [soil],
            tmp_path / name,
        )
        for x, name in ((-1.0, "west"), (0.0, "east"))
    ]
    ready = Output.ready

    def full(out):
        if out.folder.endswith("east"):
            raise OSError(28, "No space left on device", out.folder)
        ready(out)

    for _ in Bake(standing(), parcels("mud"), options=BakeOptions(threads=1)).run():
        pass
    before = [content(tmp_path / name) for name in ("west", "east")]
    monkeypatch.setattr(Output, "ready", full)
    with pytest.raises(DesirePathError, match="No space left"):
        for _ in Bake(standing(), parcels("snow"), options=BakeOptions(threads=1)).run():
            pass
    for name in ("west", "east"):
        output.settle(tmp_path / name)
    assert [content(tmp_path / name) for name in ("west", "east")] == before


KILLED = """
import sys
sys.path[:0] = [{addon!r}, {repo!r}]
from tests.core.test_output import grown
for progress in grown({folder!r}, {soil!r}).run():
    print(progress.frame, flush=True)
"""


def grown(folder, soil):
    return Bake(
        standing(),
        Ground.flat(),
        soil,
        folder,
        options=BakeOptions(threads=1),
        output=BakeOutput(plant_mesh=True),
        plants=[Planting("carex", 60.0, seed=len(soil))],
    )


def in_a_process(folder, soil):
    script = KILLED.format(addon=str(REPO / "addon"), repo=str(REPO), folder=str(folder), soil=soil)
    return subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )


def marks(folder):
    return [(folder / name).read_bytes() for name in ("frames/trail_0020.exr", "maps_final.exr", "plants.pc2")]


def test_a_killed_bake_leaves_the_old_one_whole_and_the_next_leaves_nothing_of_it(tmp_path):
    for soil in ("mud", "snow"):
        for _ in grown(tmp_path / soil, soil).run():
            pass
    old, new, folder = marks(tmp_path / "mud"), marks(tmp_path / "snow"), tmp_path / "mud"
    for frames in (1, 12, 36):  # a killed bake is gone on with by the next
        child = in_a_process(folder, "snow")
        for _ in range(frames):
            child.stdout.readline()
        child.kill()
        child.wait()
        assert marks(folder) in (old, new) and read_index(folder).complete
    for _ in grown(folder, "snow").run():
        pass
    assert marks(folder) == new
    assert {path.name for path in folder.iterdir()} == set(NAMES)
    free(folder)
    assert not folder.exists()


@pytest.mark.parametrize("frames", [1, 20, 36])
def test_free_takes_away_what_a_killed_bake_left(tmp_path, frames):
    child = in_a_process(tmp_path / "bake", "snow")
    for _ in range(frames):
        child.stdout.readline()
    child.kill()
    child.wait()
    free(tmp_path / "bake")
    assert not list(tmp_path.iterdir())


def test_a_second_bake_into_a_folder_is_refused(tmp_path):
    """In this process or another one, and so is freeing it; the first one goes on."""
    run = Bake(standing(), Ground.flat(), "mud", tmp_path, options=BakeOptions(threads=1)).run()
    next(run)
    other = Bake(standing(), Ground.flat(), "snow", tmp_path, options=BakeOptions(threads=1))
    with pytest.raises(DesirePathError, match=f"running .process {os.getpid()} on {socket.gethostname()}") as error:
        next(other.run())
    assert str(tmp_path) in sentence(error)
    with pytest.raises(DesirePathError, match="running"):
        free(tmp_path)
    assert (
        "process"
        in subprocess.run(
            [
                sys.executable,
                "-c",
                f"import sys; sys.path[:0] = [{str(REPO / 'addon')!r}]\n"
                f"from desire_path.folder import free\ntry: free({str(tmp_path)!r})\nexcept ValueError as e: print(e)",
            ],
            capture_output=True,
            text=True,
        ).stdout
    )
    for _ in run:
        pass
    assert read_index(tmp_path).complete and not (tmp_path / "bake.lock").exists()
    for _ in other.run():
        pass


def test_a_bake_of_another_program_is_waited_for_and_then_this_one_takes_its_place(tmp_path):
    child = in_a_process(tmp_path, "snow")
    child.stdout.readline()
    with pytest.raises(DesirePathError, match=f"running .process {child.pid} on"):
        baked(tmp_path, wait=0.0)
    baked(tmp_path)
    assert child.wait() == 0 and read_index(tmp_path).complete
    alone = tmp_path / "alone"
    baked(alone)
    assert content(tmp_path) == content(alone)


@pytest.mark.parametrize("locks", [True, False])
def test_the_lock_of_a_killed_bake_is_taken_over(tmp_path, monkeypatch, locks):
    if not locks:
        monkeypatch.setattr(disk, "fcntl", None)
    child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
    (tmp_path / "bake.lock").write_text(f"{child.pid} {socket.gethostname()} 2020-01-01T00:00:00\n")
    if not locks:
        with pytest.raises(DesirePathError, match=f"process {child.pid} on .* since 2020"):
            baked(tmp_path, wait=0.0)
    child.kill()
    child.wait()
    baked(tmp_path)
    assert read_index(tmp_path).complete and not (tmp_path / "bake.lock").exists()


def test_a_stopped_bake_is_shown_while_it_goes_on(tmp_path):
    run = Bake(standing(), Ground.flat(), "mud", tmp_path, options=BakeOptions(threads=1)).run()
    for _ in range(10):
        next(run)
    run.close()
    before = content(tmp_path)
    run = Bake(standing(), Ground.flat(), "mud", tmp_path, options=BakeOptions(threads=1)).run()
    next(run)
    assert content(tmp_path) == before and len(before) == 11 and read_index(tmp_path).frames == 10
    for _ in run:
        pass
    assert content(tmp_path).items() > before.items() and read_index(tmp_path).complete


def test_a_stopped_second_bake_goes_on_where_it_was_stopped(tmp_path):
    """The first one is shown all the time; frames of the second that are there are not written again."""
    baked(tmp_path)
    first = content(tmp_path)
    run = Bake(standing(), Ground.flat(), "snow", tmp_path, options=BakeOptions(threads=1)).run()
    for _ in range(10):
        next(run)
    run.close()
    kept = tmp_path / "bake.new" / "frames" / "trail_0005.exr"
    written = kept.stat().st_mtime_ns
    assert content(tmp_path) == first and read_index(tmp_path).complete
    for _ in Bake(standing(), Ground.flat(), "snow", tmp_path, options=BakeOptions(threads=1)).run():
        pass
    assert content(tmp_path) != first and (tmp_path / "frames" / "trail_0005.exr").stat().st_mtime_ns == written
    assert not (tmp_path / "bake.new").exists()


def test_a_bake_that_is_whole_but_not_shown_yet_is_not_made_again(tmp_path, monkeypatch):
    """As when the last moment of a bake is the one in which it is killed."""
    baked(tmp_path)
    with monkeypatch.context() as cut:
        cut.setattr(Output, "ready", lambda out: 1 / 0)
        with pytest.raises(ZeroDivisionError):
            baked(tmp_path, cell_size=0.02)
    kept = tmp_path / "bake.new" / "frames" / "trail_0005.exr"
    written, first = kept.stat().st_mtime_ns, content(tmp_path)
    baked(tmp_path, cell_size=0.02)
    assert content(tmp_path) != first and (tmp_path / "frames" / "trail_0005.exr").stat().st_mtime_ns == written


def test_a_frame_damaged_inside_is_written_again(tmp_path):
    """One bit of what the tiles hold: the file's form is whole, its checksum tells."""
    baked(tmp_path / "good")
    good = content(tmp_path / "good")
    folder = tmp_path / "bake"
    run = Bake(standing(), Ground.flat(), "mud", folder, options=BakeOptions(threads=1)).run()
    for _ in range(10):
        next(run)
    run.close()
    frame = folder / "frames" / "trail_0004.exr"
    data = bytearray(frame.read_bytes())
    data[-1] ^= 1
    frame.write_bytes(data)
    assert read_index(folder).frames == 10  # nothing to be seen
    baked(folder)
    assert content(folder) == good


def test_a_bake_leaves_no_maps_of_the_one_before(tmp_path):
    baked(tmp_path)
    assert (tmp_path / "maps" / "second_0001.exr").exists()
    baked(tmp_path, cell_size=0.02, map_seconds=False)
    assert not (tmp_path / "maps").exists() and read_index(tmp_path).complete


def test_what_is_shown_is_on_the_disk_first(tmp_path, monkeypatch):
    order = []
    sync, replace = disk.sync, os.replace
    monkeypatch.setattr(disk, "sync", lambda folder: (order.append(f"sync {os.path.basename(folder)}"), sync(folder)))
    monkeypatch.setattr(os, "replace", lambda one, other: (order.append(os.path.basename(other)), replace(one, other)))
    baked(tmp_path)
    assert order.index("index.json") < order.index("sync bake.new") < order.index("bake.shown")
    monkeypatch.setattr(disk, "_syncfs", None)
    synced = []
    monkeypatch.setattr(os, "fsync", synced.append)
    disk.sync(tmp_path)
    assert len(synced) == sum(1 for _ in tmp_path.rglob("*")) + 1
