"""A limit of memory is kept to: what does not fit waits on the disk, and comes back to the bit."""

import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pytest

from desire_path import memory
from desire_path.bake.bake import Bake, read_index
from desire_path.bake.options import BakeOptions
from desire_path.core import _native
from desire_path.crowd import scene as scenes
from desire_path.crowd.crowd import Crowd
from desire_path.crowd.feet import Feet
from desire_path.errors import DesirePathError
from desire_path.farm import merge, plan, task
from desire_path.farm.job import Job
from desire_path.ground import maps
from desire_path.ground.sim import Ground
from desire_path.motion.gait import Gait
from desire_path.study.trampling import WALK
from tests.core.test_bake import sentence
from tests.scenes.crowds import park, pressed

REPO = Path(__file__).resolve().parents[2]
MB = 1e6
CHILD = """
import sys
sys.path[:0] = [{addon!r}, {repo!r}]
from tests.core import test_memory
test_memory.{call}
with open("/proc/self/status") as status:  # getrusage tells that of whoever began it, too
    print("peak", *(1024 * int(line.split()[1]) for line in status if line.startswith("VmHWM")))
"""


def bake(folder, limit=None, plants=()):
    """Two passes along a bent way in small cells, which take twice the memory that Python takes."""
    gait = Gait.load(WALK).along(np.array([[0, 0], [9, 6], [0, 6]]), 2)
    options = BakeOptions(memory=limit, threads=2)
    return Bake(gait, Ground.flat(), "dry-sand", folder, cell_size=0.004, plants=plants, options=options)


def run(folder, limit=None):
    for _ in bake(Path(folder), limit).run():
        pass


def grow(folder, limit=None):
    for _ in bake(Path(folder), limit, "carex").run():
        pass


WIDE = [(1, 1), (13, 1.5), (1, 6.5), (13, 7), (7, 0.6), (7, 7.4)]


def tread(folder, limit=None):
    """Feet of a crowd in cells so small that they take more memory than Python does."""
    places = [{"name": f"gate {n}", "at": list(at), "radius": 0.5} for n, at in enumerate(WIDE)]
    ground, press = {"pull": 0.0, "detour": 0.0}, {"box": [2, 1, 12, 7], "cell": 0.003}
    given = {"size": [14, 8], "places": places, "passages": 4, "renewals": 1, "ground": ground, "press": press}
    with memory.held(limit, folder):
        Crowd(scenes.of(given), folder).run()
        Feet(scenes.of(given), folder).press()


def farm(folder, limit=None):
    """The same bake as two tasks that follow each other."""
    plan.plan(bake(Path(folder) / "other", limit), folder, (1, 1), 2)
    job = Job(folder)
    for window in (0, 1):
        task.run(job, window, 0, limit=limit)
    merge.merge(job, limit=limit)


def choose(folder, limit=None):
    """A crowd on so many cells that their fields take more memory than Python does."""
    with memory.held(limit, folder):
        Crowd(scenes.of(park(size=[400, 400], passages=4, renewals=2)), folder).run()


def child(call, **more):
    """Python that does it, after it has come to its end."""
    code = CHILD.format(addon=str(REPO / "addon"), repo=str(REPO), call=call)
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, **more)


def peak(call):
    """The most memory of a Python that did it [bytes]."""
    done = child(call)
    assert done.returncode == 0, done.stderr
    return int(done.stdout.split()[-1])


def files(folder):
    """What a bake left, but for the seconds it took."""
    found = {str(path.relative_to(folder)): path.read_bytes() for path in Path(folder).rglob("*") if path.is_file()}
    report = json.loads(found.pop("report.json"))
    return found, {name: report[name] for name in report if name not in ("seconds", "stages")}


def least(work="run", low=1e7):
    """The smallest limit [bytes] that a Python of its own says it keeps to, asked for a lower one."""
    with tempfile.TemporaryDirectory() as folder:
        told = child(f"{work}({folder!r}, {low})").stderr
    return int(memory.size_of(told.rsplit("at least ", 1)[1].split(",")[0]))


@pytest.mark.parametrize("work", ["run", "grow"])
def test_a_bake_keeps_to_its_limit_and_leaves_the_same_bits(tmp_path, work):
    free, limit = tmp_path / "free", least(work)
    assert peak(f"{work}({str(free)!r})") > 1.5 * limit  # so that something has to leave
    assert peak(f"{work}({str(tmp_path / 'held')!r}, {limit})") < 1.1 * limit
    assert files(free) == files(tmp_path / "held")


def test_feet_of_a_crowd_keep_to_their_limit_and_leave_the_same_bits(tmp_path):
    free, held, limit = tmp_path / "free", tmp_path / "held", 120e6
    assert peak(f"tread({str(free)!r})") > 1.3 * limit
    assert peak(f"tread({str(held)!r}, {limit})") < 1.1 * limit
    for name in ("trodden_final.exr", "feet.json", "paths.csv"):
        assert (held / name).read_bytes() == (free / name).read_bytes()


def test_tasks_of_a_farm_keep_to_their_limit_and_leave_the_same_bits(tmp_path):
    free, held, limit = tmp_path / "free", tmp_path / "held", 130e6
    assert peak(f"farm({str(free)!r})") > 1.3 * limit
    assert peak(f"farm({str(held)!r}, {limit})") < 1.1 * limit
    assert files(free / "bake") == files(held / "bake")
    with pytest.raises(DesirePathError, match="give at least"):
        task.run(Job(held), 0, 0, limit="40M")


def test_fields_of_a_crowd_that_a_limit_has_no_room_for_are_refused_before(tmp_path):
    """They cannot leave: who asks for less than they take is told how much that is, and it is enough."""
    assert "cannot be done in 0.15 GB" in child(f"choose({str(tmp_path / 'low')!r}, 1.5e8)").stderr
    limit = least("choose", 1.5e8)
    assert 1.6e8 < limit < 2.4e8
    assert peak(f"choose({str(tmp_path / 'held')!r}, {limit})") < 1.1 * limit


def test_a_killed_bake_leaves_its_state_alone_and_goes_on(tmp_path):
    held, limit = tmp_path / "held", least()
    code = CHILD.format(addon=str(REPO / "addon"), repo=str(REPO), call=f"run({str(held)!r}, {limit})")
    process = subprocess.Popen([sys.executable, "-c", code])
    while not list(held.glob("bake.new/frames/bake_*.state")):
        assert process.poll() is None
        time.sleep(0.05)
    assert not list(held.glob("memory*"))
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert peak(f"run({str(held)!r}, {limit})") < 1.1 * limit
    run(tmp_path / "free")
    assert files(held) == files(tmp_path / "free") and read_index(held).complete


def test_a_limit_below_what_is_needed_is_refused_before_anything_is_written(tmp_path):
    with pytest.raises(DesirePathError) as error:
        run(tmp_path / "bake", "40M")
    text = sentence(error)
    assert "cannot be done in 40 MB of memory: give at least" in text
    assert not (tmp_path / "bake").exists()


def test_a_full_disk_is_told(tmp_path):
    def small():
        resource.setrlimit(resource.RLIMIT_FSIZE, (20 << 20, 20 << 20))

    done = child(f"run({str(tmp_path / 'bake')!r}, {least()})", preexec_fn=small)
    assert done.returncode != 0 and "the disk is full" in done.stderr and "make room" in done.stderr
    assert not list(tmp_path.rglob("memory*"))


def over(folder):
    """What is not the core's own comes over a limit, and goes."""
    limit = _native.memory_resident() + memory.LEAST
    with memory.held(limit, Path(folder)):
        memory.check_kept()
        mine = np.ones(int(2 * memory.LEAST / 8))  # Python's own
        _native.memory_ease()
        with pytest.raises(DesirePathError, match="give at least"):
            memory.check_kept()
        del mine
    memory.check_kept()


def test_what_comes_over_the_limit_and_cannot_leave_is_told(tmp_path):
    done = child(f"over({str(tmp_path)!r})")  # a process that has run other tests gives up memory of theirs instead
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    "text, size", [("4G", 4e9), ("800M", 8e8), (" 1.5 gb ", 1.5e9), ("2GiB", 2e9), ("5000000", 5e6), (7e8, 7e8)]
)
def test_limits_are_read(text, size):
    assert memory.size_of(text) == size and BakeOptions(memory=text).memory == size


@pytest.mark.parametrize("text", ["", "much", "-4G", "0", 0, -1.0, float("nan"), float("inf"), True, "4 4G", [4]])
def test_limits_that_are_none_are_told(text):
    with pytest.raises(DesirePathError, match="write one as 4G or 800M"):
        BakeOptions(memory=text)


def test_the_commands_keep_to_it(tmp_path):
    def command(*words):
        words = [sys.executable, "-m", "desire_path", *map(str, words)]
        return subprocess.run(words, cwd=REPO / "addon", capture_output=True, text=True, env={**os.environ})

    (tmp_path / "scene.json").write_text(json.dumps(pressed()))
    words = {"bake": [WALK, "--cell", 0.02], "crowd": [tmp_path / "scene.json"]}
    for name, more in words.items():
        refused = command(name, *more, "--out", tmp_path / name, "--memory", "30M")
        assert refused.returncode == 1 and "give at least" in refused.stderr, refused
        assert not (tmp_path / name).exists()
        done = command(name, *more, "--out", tmp_path / name, "--memory", "4G")
        assert done.returncode == 0, done.stderr
    assert not list(tmp_path.rglob("memory*"))
    assert maps.read(tmp_path / "crowd" / "trodden_final.exr").planes["compression"].max() > 0.001
    assert scenes.read(tmp_path / "scene.json").press
