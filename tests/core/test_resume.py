"""A bake that is killed, wherever that is, and started again leaves the files of one that was let be, to the bit."""

import json
import os
import random
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from desire_path.bake import state
from desire_path.bake.bake import Bake, free, read_index
from desire_path.bake.options import BakeOptions, BakeOutput
from desire_path.ground.parcels import Parcel
from desire_path.ground.plants import Planting
from desire_path.ground.sim import Ground, Simulation
from desire_path.placement import passes
from tests.core.test_bake import standing
from tests.core.test_parcels import tile
from tests.scenes import gaits
from tests.scenes.kills import die_after

REPO = Path(__file__).resolve().parents[2]
CELL = 0.02


def painted():
    """Mud beside snow, the seam along the walk, so that both kinds are under one foot."""
    vertices, triangles = tile(-1, -1, 3, 1)
    mud = (vertices[:, 1] < 0.05).astype(float)
    return Ground.mesh(vertices, triangles, np.stack([mud, 1.0 - mud]))


def level(x, y):
    return 0.0 * x


def soils(folder):
    return Bake(
        gaits.strides(1.6, rate=24.0)[0],
        painted(),
        ["mud", "snow"],
        folder,
        cell_size=CELL,
        options=BakeOptions(threads=2),
    )


def grown(folder):
    plants = [Planting("carex", 40.0, seed=3), Planting("moss", 60.0, seed=4)]
    gait = gaits.strides(1.4, rate=24.0)[0]
    return Bake(
        gait,
        Ground.flat(),
        "mud",
        folder,
        cell_size=CELL,
        plants=plants,
        output=BakeOutput(plant_mesh=True),
        options=BakeOptions(threads=2),
    )


def tiles(folder):
    """Two beside each other, one of them planted, and a bridge over a part of them."""
    ground = [Ground.mesh(*tile(*where, height=level)) for where in ((-1, -1, 0.5, 1), (0.5, -1, 3, 1))]
    bridge = Ground.mesh(*tile(1.2, -1, 3, 1, height=level, shift=0.4))
    gait = gaits.strides(2.0, rate=24.0)[0]
    climbing = gait.pose.copy()
    climbing[..., 2] += 0.4 * (climbing[..., 0] > 1.3)
    gait = gaits.replace(gait, pose=climbing)
    parcels = [
        Parcel(ground[0], "mud", folder / "west", plants=[Planting("carex", 40.0, seed=3)], plant_mesh=True),
        Parcel(ground[1], "snow", folder / "east"),
        Parcel(bridge, "dry-sand", folder / "bridge", "bridge"),
    ]
    return Bake(gait, parcels, cell_size=CELL, options=BakeOptions(threads=2))


def trodden(folder):
    """Pass by pass, on the ground that another bake has left."""
    gait = gaits.strides(1.0, rate=24.0)[0]
    walk = passes.in_turn([gait] * 8)
    ground = Ground.read(folder.parent / "before" / "maps_final.exr")
    return Bake(walk, ground, "mud", folder, cell_size=CELL, options=BakeOptions(threads=2))


WORLDS = {each.__name__: each for each in (soils, grown, tiles, trodden)}


def child(world, folder, steps, last, calls):
    """Bake with a state after every frame; die at a number of steps in the folder, at a number of calls of the thread
    that bakes, or when a frame is `last`. Prints each frame, then how many steps and calls it took, and warnings."""
    calls_left = calls

    def call(stack, event, of):
        nonlocal calls_left
        calls_left -= 1
        if calls_left == 0:
            os.kill(os.getpid(), signal.SIGKILL)

    state.FIRST, state.SHARE = 0.0, 1e9
    bake = WORLDS[world](Path(folder))
    steps_taken = die_after(folder, steps)
    sys.setprofile(call)
    for progress in bake.run():
        print(progress.frame, flush=True)
        if progress.frame == last:
            os.kill(os.getpid(), signal.SIGKILL)
    sys.setprofile(None)
    print("steps", steps_taken(), calls - calls_left, *bake.report["warnings"], flush=True)


def started(world, folder, steps=0, last=None, calls=0):
    script = (
        f"import sys; sys.path[:0] = {[str(REPO / 'addon'), str(REPO)]!r}\n"
        f"from tests.core.test_resume import child; child({world!r}, {str(folder)!r}, {steps}, {last}, {calls})"
    )
    return subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def left_by(process):
    """(what it printed, whether it came to its end)."""
    out, problem = process.communicate()
    assert process.returncode in (0, -signal.SIGKILL), problem
    return out.split("\n")[:-1], process.returncode == 0


def content(folder):
    """Every file of a bake but what tells of time: name -> bytes, or what they say."""
    files = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if not path.is_file():
            continue
        files[name] = path.read_bytes()
        if path.name == "report.json":
            files[name] = {**json.loads(files[name]), "seconds": 0, "stages": 0}
    return files


def let_be(world, tmp_path):
    """(files of the bake that nobody disturbed, how many steps and calls it took, what it printed)."""
    if world == "trodden":
        for _ in Bake(standing(at=(0.3, 0.0)), Ground.flat(), "mud", tmp_path / "before", cell_size=CELL).run():
            pass
    words, whole = left_by(started(world, tmp_path / "whole"))
    assert whole and not [name for name in content(tmp_path / "whole") if "state" in name or "part" in name]
    return content(tmp_path / "whole"), *map(int, words[-1].split()[1:3]), words


def frames(words):
    return [int(each) for each in words if each.lstrip("-").isdigit()]


@pytest.mark.parametrize("world", WORLDS)
def test_killed_at_any_moment_it_ends_as_if_it_was_let_be(tmp_path, world):
    """Killed again and again in one folder: at frames, at steps that change the folder, at calls by chance."""
    want, steps, calls, words = let_be(world, tmp_path)
    folder, chance, all_frames = tmp_path / "killed", random.Random(world), frames(words)
    begin = all_frames[0]
    for number in sorted(chance.sample(range(len(all_frames) // 2), 2)):
        there, whole = left_by(started(world, folder, last=all_frames[number]))
        assert not whole and frames(there) == [*range(begin, all_frames[number] + 1)]  # from where it was killed
        begin = all_frames[number] + 1
    for part in chance.sample(range(1, steps), 4):
        there, _ = left_by(started(world, folder, part))
    for number in sorted(chance.sample(range(1, calls // 2), 3)):
        there, _ = left_by(started(world, folder, calls=number))
    there, whole = left_by(started(world, folder))
    assert whole and there[-1].split()[3:] == words[-1].split()[3:] and content(folder) == want


def stopped(folder, frames=20, world=soils):
    """A bake that was stopped after so many frames, with a state after each."""
    run = world(folder).run()
    for _ in range(frames):
        next(run)
    run.close()
    return sorted((folder / "frames").glob("*.state"))


@pytest.fixture
def each_frame(monkeypatch):
    """A state is kept after every frame."""
    monkeypatch.setattr(state, "FIRST", 0.0)
    monkeypatch.setattr(state, "SHARE", 1e9)


def finish(folder, world=soils):
    """(first frame simulated, warnings about states)."""
    bake = world(folder)
    first = [progress.frame for progress in bake.run()][0]
    return first, [each for each in bake.report["warnings"] if "state" in each]


def test_a_stopped_bake_goes_on_from_the_frame_it_was_stopped_at(tmp_path):
    for _ in soils(tmp_path / "whole").run():
        pass
    assert [path.name for path in stopped(tmp_path / "bake")] == ["bake_0020.state"]
    assert not read_index(tmp_path / "bake").complete
    assert finish(tmp_path / "bake") == (21, [])
    assert content(tmp_path / "bake") == content(tmp_path / "whole")


def test_states_of_storeys_count_once_the_last_of_them_is_written(tmp_path, monkeypatch, each_frame):
    """As if it was killed when but some of them were there."""
    written, write = [], state.write

    def writes(path, *more):
        written.append(Path(path).relative_to(tmp_path))
        write(path, *more)

    monkeypatch.setattr(state, "write", writes)
    run = tiles(tmp_path).run()
    for _ in range(4):
        next(run)
    run.close()
    names = [path.name for path in written[-4:]]
    assert names == ["bake_0003.state"] * 2 + ["bake_0004.state"] * 2, "one of each storey"
    last = written[-1]
    assert last.parts[0] != written[-2].parts[0]
    (there,) = (tmp_path / last.parts[0]).rglob(last.name)
    there.unlink()
    assert finish(tmp_path, tiles) == (4, [])


@pytest.mark.parametrize(
    "damage",
    [
        lambda good: b"",
        lambda good: good[:-1],
        lambda good: good + b"x",
        lambda good: good[:40] + b"#" + good[41:],
        lambda good: good[:300],
        *(lambda good, at=at: good[:-at] + bytes([good[-at] ^ 1]) + good[1 - at :] for at in (9, 400)),
        lambda good: b"no state at all",
    ],
)
def test_a_damaged_state_is_not_used(tmp_path, each_frame, damage):
    for _ in soils(tmp_path / "whole").run():
        pass
    folder = tmp_path / "bake"
    older, newer = stopped(folder)
    newer.write_bytes(damage(newer.read_bytes()))
    first, warnings = finish(folder)
    assert first == 20 and len(warnings) == 1 and warnings[0].startswith("The state after frame 20 in ")
    want, found = content(tmp_path / "whole"), content(folder)
    assert found.pop("report.json")["warnings"] == [*want.pop("report.json")["warnings"], *warnings]
    assert found == want


def test_no_bit_of_a_state_may_be_another(tmp_path):
    path = tmp_path / "bake_0001.state"
    state.write(path, {"frame": 1}, memoryview(bytes(range(200))))
    good = path.read_bytes()
    assert state.read(path, {"frame": 1})[1] == bytes(range(200))
    for at in range(len(good)):
        path.write_bytes(good[:at] + bytes([good[at] ^ 4]) + good[at + 1 :])
        with pytest.raises(state.Damaged):
            state.read(path, {"frame": 1})
    path.write_bytes(good)
    with pytest.raises(state.Damaged):
        state.read(path, {"frame": 2})


def test_without_a_state_that_can_be_used_it_begins_anew(tmp_path, each_frame):
    for _ in soils(tmp_path / "whole").run():
        pass
    for number, harm in enumerate(
        (
            lambda folder, older, newer: [each.write_bytes(b"x") for each in (older, newer)],
            lambda folder, older, newer: [each.unlink() for each in (older, newer)],
            lambda folder, older, newer: (folder / "frames" / "trail_0007.exr").write_bytes(b"x"),
            lambda folder, older, newer: (folder / "frames" / "trail_sums.txt").unlink(),
            lambda folder, older, newer: [
                each.rename(folder / "frames" / "bake_0011.state") for each in (older, newer)
            ],
        )
    ):
        folder = tmp_path / str(number)
        harm(folder, *stopped(folder))
        assert finish(folder)[0] == 1, number
        want, found = content(tmp_path / "whole"), content(folder)
        want.pop("report.json"), found.pop("report.json")
        assert found == want, number


def test_maps_and_plants_that_are_not_what_was_written_are_made_anew(tmp_path, each_frame):
    for _ in grown(tmp_path / "whole").run():
        pass
    folder = tmp_path / "bake"
    stopped(folder, 25, grown)
    (folder / "maps" / "second_0001.exr").write_bytes(b"x")
    assert finish(folder, grown) == (25, [])  # the map is of frame 25
    assert content(folder) == content(tmp_path / "whole")
    folder = tmp_path / "stems"
    stopped(folder, 20, grown)
    with open(folder / "frames" / "plants.pc2.part", "r+b") as file:
        file.seek(1000)
        file.write(b"\xff")
    assert finish(folder, grown) == (1, [])
    assert content(folder) == content(tmp_path / "whole")
    folder = tmp_path / "longer"
    stopped(folder, 20, grown)
    with open(folder / "frames" / "plants.pc2.part", "ab") as file:
        file.write(bytes(1 << 22))  # as a bake of which only that was written
    assert finish(folder, grown) == (21, [])
    assert content(folder) == content(tmp_path / "whole")


def test_a_state_of_another_bake_is_not_used(tmp_path, each_frame):
    """One that says it is of this bake, but whose ground is another's; with several, the first had gone on already."""
    for _ in tiles(tmp_path / "whole").run():
        pass
    folder = tmp_path / "bake"
    stop = 35
    run = tiles(folder).run()
    for _ in range(stop):
        next(run)
    run.close()
    kept = sorted(folder.glob("*/frames/*.state"))
    assert [path.parent.parent.name for path in kept] == ["bridge", "bridge", "west", "west"]
    other = Simulation(Ground.flat(0.4), "mud", CELL)
    path = kept[1]
    about = json.loads(path.read_bytes().split(b"\n", 1)[0].split(b" ", 4)[4])
    state.write(path, about, other.state())
    assert state.read(path, {"frame": stop})[0]["storey"] == 1
    first, warnings = finish(folder, tiles)
    assert first == stop and len(warnings) == 1 and f"after frame {stop} in" in warnings[0]
    want, found = content(tmp_path / "whole"), content(folder)
    for files in (want, found):
        for name in [name for name in files if "report" in name]:
            files.pop(name)
    assert found == want


def test_states_go_with_the_bake(tmp_path, each_frame):
    folder = tmp_path / "bake"
    assert len(stopped(folder)) == state.KEPT
    assert finish(folder)[0] == 21 and not [*folder.rglob("*.state*")]
    run = grown(folder).run()
    for _ in range(5):
        next(run)
    run.close()  # a whole one is shown: this one stays below bake.new
    assert len([*folder.rglob("*.state")]) == state.KEPT and (folder / "bake.new/frames/plants.pc2.part").exists()
    free(folder)
    assert not folder.exists()


def test_keeping_states_takes_a_small_share_of_the_time(tmp_path, monkeypatch):
    """By the rule it goes by, with a clock of its own: no state sooner than SHARE of the time since allows."""
    now = [0.0]
    monkeypatch.setattr(state.time, "perf_counter", lambda: now[0])
    kept = []

    class Sim:
        def flush(self):
            now[0] += 0.3

        def state(self):
            return memoryview(b"")

    class Share:
        sim = Sim()

        def plants_digest(self):
            return None

        class out:
            @staticmethod
            def path(*names):
                return str(tmp_path / names[-1])

    states = state.States([Share()], "", {})
    for frame in range(1, 1001):
        now[0] += 0.1
        before = now[0]
        states.after(frame)
        if now[0] > before:
            kept.append(frame)
    assert kept[0] in (10, 11) and len(kept) in (6, 7) and 0.3 * len(kept) < 0.025 * now[0]
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(map(state.name_of, kept[-state.KEPT :]))
